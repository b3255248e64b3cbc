"""What several exercises and predictions of scara motion use."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from robokin import SCARA, ScaraPose, blend, deg, follow, mm

Floats = NDArray[np.float64]
MINUS = str.maketrans("-", "\N{MINUS SIGN}")


def posed(x: float, y: float, z: float, angle: float) -> ScaraPose:
    """A pose by its place in mm and its tool angle in degrees."""
    return ScaraPose(np.array([x, y, z]) * mm, angle * deg)


# source 001, task 5 (listings 12 and 14), as in the lab
START, VIA, GOAL = posed(200, 300, 120, 0), posed(400, 100, 0, 180), posed(200, -200, 200, 90)
ROW = SCARA.branch(+1)
DURATION = 20.0  # s
T = np.linspace(0, DURATION, 1001)
S = T / DURATION
LOW, HIGH = SCARA.limits.T
LEVEL = 220.2 * mm  # l0: the height of the tool at q4 = 0, listing 4
STROKE = float(HIGH[3])


def joints(path: ScaraPose) -> Floats:
    return follow(SCARA, SCARA.ik(path), ROW)


class Shown(float):
    """A number that is written with a minus sign."""

    def __format__(self, spec: str) -> str:
        return format(float(self), spec).translate(MINUS)


def behind(x: Any) -> ScaraPose:
    """Goals on the other side of the column, x in mm (section 4)."""
    places = np.stack(np.broadcast_arrays(np.multiply(x, mm), -0.4, 0.2), axis=-1)
    return ScaraPose(places, np.full(np.shape(x), 90 * deg))


def stroke(fraction: float, s: Any, corner: str = "parabola") -> Floats:
    """Joint 4 on the lab's way past its via point, m."""
    found: Floats = SCARA.ik(blend(START, VIA, GOAL, fraction, s, corner=corner))[:, ROW, 3]
    return found
