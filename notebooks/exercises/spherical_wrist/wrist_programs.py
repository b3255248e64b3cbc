"""Helpers for the correct and wrong programs of exercise 2 of this lab."""

import numpy as np

from robokin import Quaternion, deg

from .shared import Floats, mended, textbook

__all__ = ["Quaternion", "deg", "mended"]


def singular(h: Floats) -> bool:
    return bool(np.hypot(h[0, 2], h[1, 2]) < 1e-13)


def regular(h: Floats, wrist: int) -> Floats:
    """The regular formulas; the singular ones only if sin theta is exactly 0."""
    return mended(h, wrist) if singular(h) else textbook(h, wrist)


def theta_alone(h: Floats, wrist: int) -> Floats:
    """The better root for theta, and phi and psi by the regular formulas: `better_root` of the lab,
    with the singular formulas at sin theta = 0 exactly.
    """
    right = mended(h, wrist)
    if singular(h):
        return right
    phi, _, psi = textbook(h, wrist)
    return np.array([phi, right[1], psi])


def coarse(h: Floats, wrist: int) -> Floats:
    """Treats every theta below 1e-3 rad as singular."""
    if np.hypot(h[0, 2], h[1, 2]) > 1e-3:
        return mended(h, wrist)
    theta = 0.0 if h[2, 2] > 0 else wrist * np.pi
    return np.array([0.0, theta, np.arctan2(h[1, 0], h[1, 1])])


def atan(y: float, x: float) -> float:
    with np.errstate(divide="ignore", invalid="ignore"):
        return float(np.arctan(np.divide(y, x)))
