"""Code that exercises and predictions of this lab share."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from robokin import ITMO6R, Quaternion, Transform, deg, lin, mm

Floats = NDArray[np.float64]
X, Y, Z = np.eye(3)
turned = Quaternion.from_angle_axis
# source 004, table 1; lengths as in the lab
A = np.array([0, 100, 0, 0, 0, 0]) * mm
ALPHA = np.array([90, 0, 90, -90, 90, 0]) * deg
D = np.array([100, 0, 0, 200, 0, 200]) * mm
OFFSET = np.array([0, 0, 90, 0, 0, 0]) * deg
ROW = ITMO6R.branch(+1, -1, -1)
HALF = 113 * mm  # half the length of the line of exercise 3


def posture(*degrees: float) -> Floats:
    q: Floats = np.array(degrees) * deg
    return q


def rot(axis: int, angle: float) -> Floats:
    """The 4 x 4 matrix of a rotation about a coordinate axis (0, 1, 2)."""
    matrix, (i, j) = np.eye(4), [(1, 2), (2, 0), (0, 1)][axis]
    c, s = np.cos(angle), np.sin(angle)
    matrix[i, i], matrix[i, j], matrix[j, i], matrix[j, j] = c, -s, s, c
    return matrix


def trans(x: float, y: float, z: float) -> Floats:
    """The 4 x 4 matrix of a translation."""
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def zyz(phi: Any, theta: Any, psi: Any) -> Floats:
    """Rot(z, phi) Rot(y, theta) Rot(z, psi): angles (...) -> (..., 3, 3)."""
    turns = turned(phi, Z) @ turned(theta, Y) @ turned(psi, Z)
    return turns.as_matrix()


def textbook(h: Floats, wrist: int) -> Floats:
    """The wrist angles (..., 3) of matrices (..., 3, 3) by the regular formulas alone."""
    c = h[..., 2, 2]
    with np.errstate(invalid="ignore"):
        theta = np.arctan2(wrist * np.sqrt(1 - c**2), c)
    phi = np.arctan2(wrist * h[..., 1, 2], wrist * h[..., 0, 2])
    psi = np.arctan2(wrist * h[..., 2, 1], -wrist * h[..., 2, 0])
    return np.stack([phi, theta, psi], axis=-1)


def mended(h: Floats, wrist: int) -> Floats:
    """The wrist angles (..., 3) of matrices (..., 3, 3), correct everywhere: psi depends on phi."""
    s = np.hypot(h[..., 0, 2], h[..., 1, 2])
    theta = np.arctan2(wrist * s, h[..., 2, 2])
    phi = np.where(s < 1e-13, 0.0, np.arctan2(wrist * h[..., 1, 2], wrist * h[..., 0, 2]))
    c, s = np.cos(phi), np.sin(phi)
    psi = np.arctan2(c * h[..., 1, 0] - s * h[..., 0, 0], c * h[..., 1, 1] - s * h[..., 0, 1])
    return np.stack([phi, theta, psi], axis=-1)


def tilted_line(slope: float, miss: float, up: float, side: float, s: Any) -> Transform:
    """Poses on a straight line that rises by `slope` and passes the singular pose at a distance
    of `miss`: the tool points ahead along x, tilted up and to the side.
    """
    along = np.array([0, np.cos(slope), np.sin(slope)])
    across = np.array([0, -np.sin(slope), np.cos(slope)])
    tilt = turned(-up, Y) @ turned(side, Z)
    level = turned(90 * deg, Y) @ turned(180 * deg, Z)
    middle = np.array([400, 0, 200]) * mm + miss * across
    start, goal = (Transform(tilt @ level, middle + e * HALF * along) for e in (-1, 1))
    return lin(start, goal, s)
