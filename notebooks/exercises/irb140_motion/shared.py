"""Code that exercises and predictions of this lab share."""

import numpy as np
from numpy.typing import NDArray

from robokin import IRB140, Quaternion, Transform, deg, mm
from robokin.units import wrapped

Floats = NDArray[np.float64]
MINUS = str.maketrans("-", "\N{MINUS SIGN}")
TURN = 2 * np.pi
LOW, HIGH = IRB140.limits.T
SLACK = 1e-9


def pose(x: float, y: float, z: float, angle: float, axis: list[float]) -> Transform:
    return Transform(Quaternion.from_angle_axis(angle * deg, axis), np.array([x, y, z]) * mm)


# source 001, listings 11 (three poses) and 7 (two), as in the lab
START, VIA = pose(200, 400, 200, 90, [-1, 0, 0]), pose(650, -100, 800, 45, [0, 1, 0])
GOAL = pose(300, 300, 500, 90, [0, 1, 0])
LEFT, RIGHT = pose(200, 400, 600, 90, [-1, 0, 0]), pose(200, -300, 800, 90, [0, 1, 0])
ROW = IRB140.branch(+1, +1, -1)
P0, P1, P2 = START.translation, VIA.translation, GOAL.translation


def length(vector: Floats) -> float:
    return float(np.linalg.norm(vector))


D = length(P0 - 2 * P1 + P2)


def into(end: Floats, limits: Floats = IRB140.limits) -> Floats:
    """Move a posture into the limits by whole turns."""
    low, high = limits.T
    end = end + TURN * np.maximum(np.ceil((low - SLACK - end) / TURN), 0)
    inside: Floats = end - TURN * np.maximum(np.ceil((end - high - SLACK) / TURN), 0)
    return inside


def short_end(q0: Floats, q1: Floats, limits: Floats = IRB140.limits) -> Floats:
    """The posture q1, each joint as near to q0 as its limits allow."""
    return into(wrapped(q1, q0), limits)
