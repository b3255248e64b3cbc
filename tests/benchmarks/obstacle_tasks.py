"""Compare our plan with the document's method on random tasks with an obstacle in the path.

    python tests/benchmarks/obstacle_tasks.py [tasks]
    python tests/benchmarks/obstacle_tasks.py tasks --two        with a second obstacle anywhere
    python tests/benchmarks/obstacle_tasks.py tasks --moving     with the moving obstacles of
                                                                 test_moving.py
    python tests/benchmarks/obstacle_tasks.py tasks --brute

The tasks (2000) are those of tests/test_obstacles.py: on the direct path, lever AK hits the
obstacle. A task counts as open if the start posture and the target themselves keep a clearance of
L/7; for the others the plan must report that no path can keep it. With --brute, the script prints
the least movement of every open task on a grid of 2 degrees (3 s each), as in `BRUTE` of the tests,
next to that of our plan.
"""

import os
import sys
from collections import Counter
from itertools import product
from pathlib import Path
from time import process_time

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent))

from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra
from test_moving import least_on_the_way, moving_tasks
from test_obstacles import ARM, KEPT, dense, seen, tasks

from robokin import deg
from robokin.jobs.moving import plan_moving
from robokin.jobs.obstacles import clearance, plan, via_path


def verdict(path, H):
    """Describe the document's path by its least clearance, or as out of reach."""
    if np.isnan(path).any():
        return "via points out of reach"
    least = clearance(ARM, path, H).min()
    return (
        "sweeps the obstacle" if least <= 0 else "nearer than L/7" if least < KEPT else "keeps L/7"
    )


def brute_force(q0, K1, H, step=2 * deg):
    """The least S of a path around the obstacle on a grid of postures, computed with SciPy's
    Dijkstra and the distances of the tests. Along an edge, which is one step of one joint, no lever
    comes nearer than L/7: a point moves by at most the step times the number of turning levers, and
    is at most half of that from its place at the nearer end.
    """
    axes = [np.unique(np.r_[np.arange(v, 0, -step), np.arange(v, np.pi, step)]) for v in q0]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    near, number = seen(grid, H).min(axis=-1), np.arange(grid[..., 0].size).reshape(grid.shape[:3])
    edges = []
    for axis in range(3):
        a, b = (np.moveaxis(number, axis, 0)[cut].ravel() for cut in (slice(-1), slice(1, None)))
        kept = (near.flat[a] + near.flat[b] - (3 - axis) * step) / 2 >= KEPT
        edges.append(np.stack([a[kept], b[kept]]))
    graph = coo_matrix((np.ones(sum(e.shape[1] for e in edges)), np.hstack(edges)))
    graph.resize(near.size, near.size)
    start = number[tuple(abs(axis - v).argmin() for axis, v in zip(axes, q0, strict=True))]
    steps = dijkstra(graph.tocsr(), directed=False, indices=start, unweighted=True)
    goals = ARM.family(K1, np.linspace(*ARM.alpha_range(K1), 1500))
    goals = goals[seen(goals, H).min(axis=-1) >= KEPT]
    below = [
        np.clip(np.searchsorted(axis, goals[:, i]) - 1, 0, len(axis) - 2)
        for i, axis in enumerate(axes)
    ]
    nodes = np.stack([number[tuple(np.add(below, c))] for c in product(*[[[0], [1]]] * 3)])
    S = steps[nodes] * step + abs(grid.reshape(-1, 3)[nodes] - goals).sum(axis=-1)
    for i in np.argsort(S, axis=None):
        corner, goal = np.unravel_index(i, S.shape)
        if not np.isfinite(S[corner, goal]):
            break
        last = grid.reshape(-1, 3)[nodes[corner, goal]]
        if seen(dense([last, goals[goal]], 60), H).min() >= KEPT:
            return S[corner, goal]
    return np.inf


def beside_brute_force(n):
    for i, (q0, K1, H) in enumerate(tasks(n)):
        answer = plan(ARM, q0, K1, H)
        if "No path keeps" not in answer.words:
            ours = answer.cost if answer.found else np.inf
            print(f"{i:4d}: brute force {brute_force(q0, K1, H):.4f}, plan {ours:.4f} rad")


def share(counts, total):
    return ", ".join(
        f"{name} {count} ({count / total:.1%})" for name, count in counts.most_common()
    )


def print_times(times):
    for way, each in times.items():
        median, most, longest = 1e3 * np.percentile(each, (50, 95, 100))
        print(
            f"CPU time of a plan that ends in {way!r}, ms: median {median:.0f}, 95 % {most:.0f}, "
            f"longest {longest:.0f}"
        )


def past_two(n):
    rng, found, broken, times = np.random.default_rng(16), Counter(), 0, {}
    for q0, K1, H in tasks(n, seed=17):
        both = np.array([H, rng.uniform(-2.5, 2.5, 2)])
        start = process_time()
        answer = plan(ARM, q0, K1, both)
        times.setdefault(answer.way, []).append(process_time() - start)
        too_near = "No path keeps" in answer.words
        found["start or target too near" if too_near else answer.way] += 1
        if answer.found:
            broken += min(seen(dense(answer.path), h).min() for h in both) < KEPT
    print_found(n, found, broken)
    print_times(times)


def past_moving(n):
    found, broken, times = Counter(), 0, {}
    for q0, K1, H, v in moving_tasks(n):
        start = process_time()
        answer, when = plan_moving(ARM, q0, K1, H, v, 1.0)
        times.setdefault(answer.way, []).append(process_time() - start)
        too_near = "At the start" in answer.words
        found["start too near" if too_near else answer.way] += 1
        if answer.found:
            broken += least_on_the_way(answer.path, when, H, v, 4001).min() < KEPT
    print_found(n, found, broken)
    print_times(times)


def print_found(n, found, broken):
    open_tasks = n - sum(count for name, count in found.items() if "too near" in name)
    print(f"{n} tasks: {share(found, n)}")
    print(
        f"open tasks {open_tasks}: solved {1 - found['none'] / open_tasks:.1%}; plans that break "
        f"their clearance: {broken}"
    )


def main(n):
    found, circles, broken, rows = Counter(), [Counter() for _ in range(3)], 0, []
    times, radii = {}, Counter()
    for q0, K1, H in tasks(n):
        start = process_time()
        answer = plan(ARM, q0, K1, H)
        times.setdefault(answer.way, []).append(process_time() - start)
        if answer.way == "via points":
            radii[f"{1000 * answer.radius:.0f} mm"] += 1
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
        f"movement relative to the direct path: median {np.median(cost / least):.2f}, "
        f"total {cost.sum() / least.sum():.2f}; corners: {Counter(corners.astype(int).tolist())}"
    )
    print(f"via points that win, by radius: {dict(radii.most_common())}")
    print_times(times)
    for factor, counts in zip((1, 1.5, 2), circles, strict=True):
        print(f"document's via points, circle {factor} L/7: {share(counts, open_tasks)}")
    wide = Counter(
        verdict(via_path(ARM, q0, K1, H, limited=False), H)
        for q0, K1, H in tasks(n // 2, 7, limited=False)
    )
    print(f"document's method, gamma not limited, {n // 2} tasks: {share(wide, n // 2)}")


if __name__ == "__main__":
    runs = {"--brute": beside_brute_force, "--two": past_two, "--moving": past_moving}
    run = next((runs[word] for word in sys.argv if word in runs), main)
    run(int(sys.argv[1]) if len(sys.argv) > 1 else 2000)
