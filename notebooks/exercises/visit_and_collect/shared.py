"""Code that exercises and predictions of this lab share."""

import numpy as np
from numpy.typing import NDArray

from robokin import spbu_arm
from robokin.jobs.visit_collect import Task, travel_time, workspace

Floats = NDArray[np.float64]
L1, L2 = 5.0, 4.0  # m, source 000, examples 2 and 3
ARM = spbu_arm(L1, L2)
FOUR = [[2.16, 3.37, 2], [1.81, -3.56, 2], [1.45, -3.73, 2], [1.07, -3.85, 2]]  # m, of the opening


def filled(q: Floats) -> Floats:
    """Fill in joint 1: on the axis it keeps its angle; at the beginning, the first known one."""
    q = q.copy()
    known = ~np.isnan(q[:, 0])
    source = np.where(known, np.arange(len(q)), known.argmax())
    q[:, 0] = q[np.maximum.accumulate(source), 0]
    return q


def each_needs(q: Floats, speeds: Floats) -> Floats:
    """The time that each joint needs for each move: (n, 3)."""
    return np.asarray(abs(np.diff(filled(q), axis=0)) / speeds)


def costs(task: Task) -> Floats:
    """The time that it takes to bring each object."""
    return np.asarray(2 * travel_time(task.q[0], task.q[1:], task.speeds))


def drawn(seed: int, count: int = 7, kind: str = "visit") -> Task:
    """The random task of the lab."""
    rng = np.random.default_rng(seed)
    points = rng.uniform([-9, -9, 0], [9, 9, 9], size=(12 * count, 3))
    points = points[workspace(L1, L2, points).all(axis=-1)][: count + 1]
    return Task(L1, L2, rng.uniform(15, 40), [0.2] * 3, points[0], points[1:], kind)
