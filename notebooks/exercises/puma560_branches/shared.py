"""The dimensions of the PUMA 560, and code that exercises, predictions and pictures share."""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from robokin import PUMA560, deg, distance_from_singularity, follow, mm, within

Floats: TypeAlias = NDArray[np.float64]

X, Y, Z = np.eye(3)
LOW, HIGH = PUMA560.limits.T
# lengths of P. Corke's model, as in the lab's table
D3, UPPER, FORE = 150.05 * mm, 431.8 * mm, float(np.hypot(431.8, 20.3)) * mm
# the direction of the wrist centre seen from the elbow, at q3 = 0
OFFSET = float(np.arctan2(431.8, 20.3))
REST = np.array([0, 90, -90, 0, 0, 0]) * deg


def tracks(rows: Floats) -> Floats:
    """The motions (..., 8, samples, 6) along every row of ik, (..., samples, 8, 6)."""
    return follow(PUMA560, np.stack([np.roll(rows, -k, -2) for k in range(8)], axis=-4), 0)


def excess(q: Floats) -> Floats:
    """How far past the limits, rad: negative inside."""
    return np.asarray(np.maximum(q - HIGH, LOW - q))


def serves(motions: Floats) -> NDArray[np.bool_]:
    """Whether motions (..., samples, 6) stay inside the limits."""
    return np.asarray((excess(motions) <= 1e-9).all(axis=(-2, -1)))


def near(q: Floats) -> Floats:
    """The distance from singularity."""
    return np.asarray(distance_from_singularity(PUMA560, q))


def usable(q: Floats) -> NDArray[np.bool_]:
    """Whether postures are inside the limits."""
    return np.asarray(np.all(within(PUMA560, q), axis=-1))
