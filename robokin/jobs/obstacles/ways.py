"""Paths that may be unsafe (`planner` checks safety), and the point of a path where a lever comes
nearest to the obstacle.
"""

import numpy as np

from ..._arrays import Floats
from ...arms.planar import ThreeLeverArm
from .collision import lever_distances
from .planner import along, best_circle


def unchecked_path(
    arm: ThreeLeverArm, way: str, q0: Floats, K1: Floats, H: Floats, distance: float
) -> Floats:
    """The path (k, 3) from posture q0 to the target for the way "direct" or "via points", whether
    it is safe or not. It contains only q0, (1, 3), if there is no such path. The via points are
    those of `best_circle`, which the words of a plan are about.
    """
    direct = np.stack([q0, arm.least(K1, q0)[0]])
    if np.isnan(direct).any():
        return q0[None]
    if way == "direct":
        return direct
    try:
        found = best_circle(arm, direct, K1, H[None, None], distance)
    except ValueError:  # H coincides with K or K1
        return q0[None]
    return q0[None] if found is None else found[0]


def nearest_approach(
    arm: ThreeLeverArm, path: Floats, clearances: Floats, H: Floats
) -> tuple[int, float, Floats]:
    """The lever that comes nearest to H (2,) on the path (k, 3), its distance in metres, and its
    point (2,) that is nearest to H. `clearances` (k - 1, 3) is the `clearance` of the path. A path
    (1, 3) is a single posture. The point is found by sampling, which is accurate enough for a
    figure.
    """
    each = clearances.min(axis=0) if len(path) > 1 else lever_distances(arm, path[0], H)
    lever, near = int(each.argmin()), float(each.min())
    q = along(path, np.linspace(0, 1, 121)) if len(path) > 1 else path
    k = lever_distances(arm, q, H)[:, lever].argmin()
    P, Q = arm.points(q[k])[lever : lever + 2]
    share = np.clip((H - P) @ (Q - P) / ((Q - P) @ (Q - P)), 0, 1)
    return lever, near, P + share * (Q - P)
