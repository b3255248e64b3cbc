"""What becomes of random tasks with an obstacle in the way: our plan, and the document's method on
the same tasks.

    python tests/benchmarks/obstacle_tasks.py [tasks]

The tasks (2000) are those of tests/test_obstacles.py: lever AK sweeps the obstacle on the direct
way. A task counts as open if the start posture and the target themselves keep L/7; of others the
plan has to say that nothing can be kept.
"""

import os
import sys
from collections import Counter
from pathlib import Path
from time import perf_counter

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent))

from test_obstacles import ARM, KEPT, dense, seen, tasks

from robokin import deg
from robokin.jobs.obstacles import clearance, plan, via_path


def verdict(path, H):
    """What the document's path is worth: out of reach, sweeps the obstacle, nearer than L/7, keeps
    it.
    """
    if np.isnan(path).any():
        return "via points out of reach"
    least = clearance(ARM, path, H).min()
    return (
        "sweeps the obstacle" if least <= 0 else "nearer than L/7" if least < KEPT else "keeps L/7"
    )


def share(counts, total):
    return ", ".join(
        f"{name} {count} ({count / total:.1%})" for name, count in counts.most_common()
    )


def main(n):
    found, circles, broken, times, rows = Counter(), [Counter() for _ in range(3)], 0, [], []
    for q0, K1, H in tasks(n):
        start = perf_counter()
        answer = plan(ARM, q0, K1, H)
        times.append(perf_counter() - start)
        if "No path keeps" in answer.words:
            found["start or target too near"] += 1
            continue
        found[answer.way] += 1
        for factor, counts in zip((1, 1.5, 2), circles, strict=True):
            counts[verdict(via_path(ARM, q0, K1, H, factor * KEPT), H)] += 1
        if answer.found:
            broken += seen(dense(answer.path), H).min() < KEPT
            rows.append((answer.least, answer.cost, len(answer.via)))
    open_tasks = n - found["start or target too near"]
    least, cost, corners = np.array(rows).T
    added = (cost - least) / deg
    print(f"{n} tasks: {share(found, n)}")
    print(
        f"open tasks {open_tasks}: solved {len(rows) / open_tasks:.1%}; plans that break their "
        f"clearance: {broken}"
    )
    print(
        f"added movement in degrees: none in {(added < 1e-6).mean():.0%}, median "
        f"{np.median(added):.1f}, "
        f"mean {added.mean():.1f}, nine in ten below {np.percentile(added, 90):.0f}"
    )
    print(
        f"movement over that of the direct way: median {np.median(cost / least):.2f}, "
        f"total {cost.sum() / least.sum():.2f}; corners: {Counter(corners.astype(int).tolist())}"
    )
    print(
        "time per plan in ms: median {:.0f}, 95 % {:.0f}, longest {:.0f}".format(
            *(1e3 * np.percentile(times, (50, 95, 100)))
        )
    )
    for factor, counts in zip((1, 1.5, 2), circles, strict=True):
        print(f"document's via points, circle {factor} L/7: {share(counts, open_tasks)}")
    wide = Counter(
        verdict(via_path(ARM, q0, K1, H, limited=False), H)
        for q0, K1, H in tasks(n // 2, 7, limited=False)
    )
    print(f"document's method, gamma not limited, {n // 2} tasks: {share(wide, n // 2)}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 2000)
