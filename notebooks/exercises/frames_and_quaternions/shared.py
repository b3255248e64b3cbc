"""Code that the exercises and predictions of this lab share."""

import numpy as np
from numpy.typing import NDArray

from robokin import deg

Floats = NDArray[np.float64]
X, Y, Z = np.eye(3)
NEAR = 0.1 * deg  # rotations that are closer count as equal
MINUS = str.maketrans("-", "\N{MINUS SIGN}")


def trans(x: float, y: float, z: float) -> Floats:
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def rot(axis: Floats, angle: float) -> Floats:
    c, s, cross = np.cos(angle), np.sin(angle), np.cross(axis, np.eye(3)).T
    matrix = np.eye(4)
    matrix[:3, :3] = c * np.eye(3) + s * cross + (1 - c) * np.outer(axis, axis)
    return matrix


def arc(a: Floats, b: Floats, s: float) -> Floats:
    """Slerp towards b without changing the sign of b."""
    beta = angle(a, b)
    if beta < 1e-12:
        return a.copy()
    if np.pi - beta < 1e-9:  # b is -a: no unique arc
        return a.copy()
    return weighted(a, b, s, beta)


def angle(a: Floats, b: Floats) -> float:
    """The angle of the arc between two quaternions, in four dimensions."""
    return 2 * float(np.arctan2(np.linalg.norm(a - b), np.linalg.norm(a + b)))


def weighted(a: Floats, b: Floats, s: float, beta: float) -> Floats:
    """The formula of slerp."""
    found: Floats = (np.sin((1 - s) * beta) * a + np.sin(s * beta) * b) / np.sin(beta)
    return found


def chord(a: Floats, b: Floats, s: float) -> Floats:
    found: Floats = (1 - s) * a + s * b
    return found


def unit(q: Floats) -> Floats:
    length = np.linalg.norm(q)
    found: Floats = q / length if length > 0 else q
    return found
