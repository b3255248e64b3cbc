"""Measure how long the jobs take: python tests/benchmarks/bench_jobs.py

Aims: greedy `visit` of 100 points in milliseconds, the exact optimum of 12 points within a second,
and a sweep of the three-lever arm's free angle in steps of 0.001 degrees within 50 ms. The exact
optimum is compared with the greedy answer, and the sweep with the exact minimum.
"""

import time

import numpy as np

from robokin import deg, spbu_arm, three_lever
from robokin.jobs.visit_collect import Task, best_visit, visit


def milliseconds(call, repeats=5):
    spans = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        spans.append(time.perf_counter() - start)
    return 1000 * float(np.median(spans))


def drawn(count, T):
    rng = np.random.default_rng(count)
    q = rng.uniform([-np.pi, -0.4, -0.9], [np.pi, 0.9, 0.5], (3 * count, 3))
    places = spbu_arm(5.0, 4.0).fk(q).translation
    places = places[places[:, 2] > 0][: count + 1]  # above the floor
    return Task(5.0, 4.0, T, (0.2, 0.2, 0.2), places[0], places[1:], "visit")


def main():
    many, twelve, sixteen = drawn(100, 1e6), drawn(12, 60), drawn(16, 60)
    print(f"greedy visit, 100 points: {milliseconds(lambda: visit(many)):.1f} ms")
    for task in (twelve, sixteen):
        exact, greedy = (
            milliseconds(lambda t=task: best_visit(t), 3),
            milliseconds(lambda t=task: visit(t)),
        )
        print(
            f"exact optimum, {len(task.points)} points: {exact:.0f} ms, {exact / greedy:.0f} "
            f"times as long as the greedy answer"
        )
    arm, point, before = three_lever(1.0), (0.9, 0.6), np.array([1.0, 2.0, 2.0])
    sweep = milliseconds(lambda: arm.sweep(point, before, 0.001 * deg))
    least = milliseconds(lambda: arm.least(point, before))
    print(
        f"sweep in steps of 0.001 degrees: {sweep:.1f} ms; exact minimum {least:.1f} ms: ratio "
        f"{sweep / least:.0f}"
    )


if __name__ == "__main__":
    main()
