"""What the right and wrong programs of exercise 3 use; its words stand beside it."""

from math import atan2, cos, hypot, inf, nan, sin, sqrt

import numpy as np

from robokin import two_link


def over(a: float, b: float) -> float:
    """As NumPy divides: inf and NaN, no error."""
    return float(np.divide(a, b))


def root(h2: float) -> float:
    """NaN below 0, no error."""
    return sqrt(h2) if h2 >= 0 else nan


def between(h2: float, way: tuple[float, float], near: float = 0.0, far: float = inf) -> float:
    """The root, 0 where rounding takes h2 below 0; NaN: the way is shorter or longer than that."""
    return sqrt(max(h2, 0.0)) if near <= hypot(*way) <= far else nan


def halved(a: float, h: float) -> tuple[float, float]:
    """The place at half of the angle."""
    angle, length = atan2(h, a) / 2, hypot(a, h)
    return length * cos(angle), length * sin(angle)


def by_angles(*case: float) -> list[float]:
    x1, y1, x3, y3, l1, l2 = case
    rows = two_link(l1, l2, (x1, y1))
    found: list[float] = rows.frames(rows.ik((x3, y3)))[..., 1].translation[:, :2].ravel().tolist()
    return found
