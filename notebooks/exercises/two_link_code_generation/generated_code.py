"""Helpers for the correct and wrong programs of exercise 3; its text is in the Markdown file beside
it.
"""

from math import atan2, cos, hypot, inf, nan, sin, sqrt

import numpy as np

from robokin import two_link


def over(a: float, b: float) -> float:
    """The quotient as in NumPy: inf or NaN instead of an error."""
    return float(np.divide(a, b))


def root(h2: float) -> float:
    """The square root, NaN below 0 instead of an error."""
    return sqrt(h2) if h2 >= 0 else nan


def between(h2: float, way: tuple[float, float], near: float = 0.0, far: float = inf) -> float:
    """The square root, 0 if h2 < 0 by rounding; NaN if the length of `way` is out of range."""
    return sqrt(max(h2, 0.0)) if near <= hypot(*way) <= far else nan


def halved(a: float, h: float) -> tuple[float, float]:
    """The point (a, h) at half its angle."""
    angle, length = atan2(h, a) / 2, hypot(a, h)
    return length * cos(angle), length * sin(angle)


def by_angles(*case: float) -> list[float]:
    x1, y1, x3, y3, l1, l2 = case
    rows = two_link(l1, l2, (x1, y1))
    found: list[float] = rows.frames(rows.ik((x3, y3)))[..., 1].translation[:, :2].ravel().tolist()
    return found
