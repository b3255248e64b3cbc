"""Code that exercises and predictions of this lab share."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robokin import SCARA, ScaraPose, blend, deg, follow, mm

Floats = NDArray[np.float64]
MINUS = str.maketrans("-", "\N{MINUS SIGN}")

# source 001, task 5 (listings 12 and 14), as in the lab
START = ScaraPose([0.2, 0.3, 0.12], 0)
VIA = ScaraPose([0.4, 0.1, 0], 180 * deg)
GOAL = ScaraPose([0.2, -0.2, 0.2], 90 * deg)
ROW = SCARA.branch(+1)
T = np.linspace(0, 20, 1001)  # s
S = T / 20
LOW, HIGH = SCARA.limits.T
LEVEL = 220.2 * mm  # l0: the height of the tool at q4 = 0, listing 4


def joints(path: ScaraPose) -> Floats:
    return follow(SCARA, SCARA.ik(path), ROW)


def stroke(fraction: float, s: Any, corner: str = "parabola") -> Any:
    """Joint 4 on the lab's path past its via point, m."""
    return SCARA.ik(blend(START, VIA, GOAL, fraction, s, corner=corner))[:, ROW, 3]


class Shown(float):
    """A number that is printed with a typographic minus sign."""

    def __format__(self, spec: str) -> str:
        return format(float(self), spec).translate(MINUS)


def plus(names: Iterable[str]) -> str:
    """Join names as in the name of an option: "q3+q4"."""
    return "+".join(names) or "none"
