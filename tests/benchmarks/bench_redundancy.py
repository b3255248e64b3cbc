"""Compare the methods of robokin/jobs/redundancy.py on the same 1000 targets, one after another:
python tests/benchmarks/bench_redundancy.py [targets] [seed]

The script measures which method moves the arm least over many tasks; no test asserts this. The
method of least movement is optimal only for a single task (tests/test_redundancy.py): the posture
that it chooses may be a bad start for the next task.
"""

import sys

import numpy as np

from robokin import deg, three_lever
from robokin.jobs.obstacles import distances
from robokin.jobs.redundancy import methods, race


def targets(arm, n, seed):
    """Gripper positions of random postures within the arm's limits."""
    K = arm.points(np.random.default_rng(seed).uniform(0, np.pi, (4 * n, 3)))[:, 3]
    return K[~np.isnan(arm.alpha_range(K)[0])][:n]


def main(n=1000, seed=4):
    H = np.array([1.2, 1.2])
    for levers in (1.0, (0.9, 1.1, 0.6)):
        arm = three_lever(levers)
        places = targets(arm, n, seed)
        start = np.array([60, 120, 120]) * deg
        runs = race(methods(H, seed), arm, places, start)
        least = runs["least movement"].turns.sum()
        print(f"levers {levers} m, {len(places)} targets, obstacle {H.tolist()}")
        print("method                 turns, °   of least   failed   ends within L/7 ms per target")
        for name, run in runs.items():
            near = (distances(arm, run.postures, H).min(axis=-1) < arm.lever / 7).sum()
            print(
                f"{name:20s} {run.turns.sum() / deg:10.0f} {run.turns.sum() / least:10.3f} "
                f"{run.failed.sum():8d} {near:17d} {1000 * run.seconds:13.2f}"
            )


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
