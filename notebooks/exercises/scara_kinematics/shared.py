"""Code that exercises and predictions of this lab share."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from robokin import SCARA, deg, mm

Floats = NDArray[np.float64]
MINUS = str.maketrans("-", "\N{MINUS SIGN}")
L0, L1, L2 = 220.2 * mm, 200 * mm, 250 * mm  # source 001, listing 4
LOW, HIGH = SCARA.limits.T


def place(q: Any) -> Floats:
    """x, y of the tool, in metres: q (..., 4) -> (..., 2)."""
    q1, both = q[..., 0], q[..., 0] + q[..., 1]
    x, y = L1 * np.cos(q1) + L2 * np.cos(both), L1 * np.sin(q1) + L2 * np.sin(both)
    return np.stack([x, y], axis=-1)


def third(one: float, two: float, bend: float) -> float:
    """The third side of a triangle with two sides, the second turned by `bend` from the first."""
    return float(np.sqrt(one**2 + two**2 + 2 * one * two * np.cos(bend)))


def corner(one: float, two: float, bend: float) -> float:
    """The angle between the first and the third side by the law of cosines, which has no sign."""
    d = third(one, two, bend)
    return float(np.arccos(np.clip((one**2 + d**2 - two**2) / (2 * one * d), -1, 1)))


def distance(q2: float) -> float:
    """The distance of the tool from joint 1."""
    return third(L1, L2, q2)


def shown(x: float) -> str:
    """An angle in degrees."""
    return f"{round(x / deg, 1) + 0.0:.1f}°".translate(MINUS)
