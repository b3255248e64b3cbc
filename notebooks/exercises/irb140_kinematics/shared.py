"""Code that exercises and predictions of this lab share."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robokin import Quaternion, Transform, mm

Floats = NDArray[np.float64]
X, Y, Z = np.eye(3)
L0, L1 = 352 * mm, 70 * mm  # the shoulder: its height and its distance from axis 1
L4 = 65 * mm  # from the wrist centre to the flange
turned = Quaternion.from_angle_axis


def target(numbers: Mapping[str, Any], p: Floats, height: float) -> Transform:
    """The moving target at progress p (N,) from 0 to 1: along y, then along x, turning all the
    time.
    """
    x = numbers["x_start"] + (numbers["x_end"] - numbers["x_start"]) * np.clip(2 * p - 1, 0, 1)
    y = numbers["y_start"] + (numbers["y_end"] - numbers["y_start"]) * np.clip(2 * p, 0, 1)
    place = np.stack([x, y, np.full_like(x, height)], axis=-1)
    return Transform(turned(numbers["turn"] * p, Y), place)


def listed(numbers: Sequence[Any]) -> str:
    """A list in words: "1, 2 and 3"."""
    return ", ".join(str(n) for n in numbers[:-1]) + f" and {numbers[-1]}"
