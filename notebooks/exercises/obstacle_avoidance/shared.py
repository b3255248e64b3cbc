"""Code that exercises and predictions of this lab share."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from robokin import deg, three_lever

Floats = NDArray[np.float64]
MINUS = str.maketrans("-", "\N{MINUS SIGN}")
L = 1.0  # m: the length of each lever
ARM = three_lever(L)
WANTED = L / 7  # m, source 003, III.3.2
K, K1 = np.array([1.2, 1.7]), np.array([1.9, 0.3])  # m: the gripper and its target, as in the lab
START = ARM.family(K, 118 * deg)


def sides(corners: Any) -> list[tuple[Any, Any]]:
    """Each corner (n, 2) with the next one."""
    return list(zip(corners, np.roll(corners, -1, axis=0), strict=True))


def crossing(P: Any, Q: Any, y: float) -> float:
    """x of the line PQ at the height y."""
    return float(P[0] + (y - P[1]) / (Q[1] - P[1]) * (Q[0] - P[0]))


def count(corners: Any, H: Any) -> int:
    """The number of sides that a ray from H to the right crosses."""
    return sum(
        (P[1] > H[1]) != (Q[1] > H[1]) and H[0] < crossing(P, Q, H[1]) for P, Q in sides(corners)
    )


def drawing(corners: Any, H: Any) -> bool:
    """Whether H is between f1 (upper) and f2 (lower), and between f3 (left) and f4 (right)."""
    A, K_, K1_, A1 = corners
    between = height(A1, K1_, H[0]) < H[1] < height(A, K_, H[0])
    return bool(between and crossing(A, A1, H[1]) < H[0] < crossing(K_, K1_, H[1]))


def height(P: Any, Q: Any, x: float) -> float:
    """y of the line PQ at x."""
    return float(P[1] + (Q[1] - P[1]) / (Q[0] - P[0]) * (x - P[0]))


def gap_to(P: Floats, Q: Floats, H: Floats) -> float:
    """The distance of H from a side or a lever PQ."""
    share = np.clip((H - P) @ (Q - P) / ((Q - P) @ (Q - P)), 0, 1)
    return float(np.hypot(*(P + share * (Q - P) - H)))


def direct(start: Floats = START, target: Floats = K1) -> Floats:
    """The path with the least S."""
    return np.stack([start, ARM.least(target, start)[0]])


def joints(q: Floats) -> Floats:
    """The points O, B, A, K (n, 4, 2) of postures (n, 3): fast, without any checks."""
    direction = np.cumsum(q, axis=-1) - np.array([0, np.pi, 2 * np.pi])
    steps = L * np.stack([np.cos(direction), np.sin(direction)], axis=-1)
    return np.concatenate([np.zeros((len(q), 1, 2)), steps.cumsum(axis=-2)], axis=-2)


def distances(q: Floats, H: Any, clip: tuple[float, float] = (0, 1)) -> Floats:
    """The distances (n, 3) of H from the levers in postures (n, 3). An infinite `clip` extends
    them.
    """
    points = joints(q)
    P, way = points[:, :-1], np.diff(points, axis=1)
    share = np.clip(((H - P) * way).sum(axis=-1) / L**2, *clip)
    gap = P + share[..., None] * way - H
    found: Floats = np.hypot(gap[..., 0], gap[..., 1])
    return found


def sampled(path: Any, many: int) -> Floats:
    """Postures (m, 3) along all parts of a path."""
    path = np.asarray(path, dtype=float)
    s = np.linspace(0, 1, many)
    return np.concatenate([a + s[:, None] * (b - a) for a, b in zip(path, path[1:], strict=False)])
