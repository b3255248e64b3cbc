"""The PUMA 560 in numbers: what exercises, predictions and pictures share."""

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from robokin import PUMA560, Transform, deg, follow, mm

Floats: TypeAlias = NDArray[np.float64]

X, Y, Z = np.eye(3)
LOW, HIGH = PUMA560.limits.T
# lengths of P. Corke's model, as in the lab's table
D3, UPPER, FORE = 150.05 * mm, 431.8 * mm, float(np.hypot(431.8, 20.3)) * mm
OFFSET = float(np.arctan2(431.8, 20.3))  # of the wrist centre seen from the elbow, at q3 = 0
REST = np.array([0, 90, -90, 0, 0, 0]) * deg
SLACK = 1e-9


def tracks(poses: Transform) -> Floats:
    """The motions (8, samples, 6) along every row."""
    rows = PUMA560.ik(poses)
    return follow(PUMA560, np.stack([np.roll(rows, -k, axis=1) for k in range(8)]), 0)


def excess(q: Floats) -> Floats:
    """How far past the limits, rad: negative inside."""
    over: Any = np.maximum(q - HIGH, LOW - q)
    return over
