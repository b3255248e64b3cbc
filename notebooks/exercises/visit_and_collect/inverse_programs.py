"""Exercise 1: helpers for its programs, and the sentence about the last call of a refused one."""

from math import acos, asin, atan2, hypot, pi
from typing import Any

import numpy as np

from robokin.course.exercises import in_words
from robokin.jobs.visit_collect import out_of_workspace, workspace

from .shared import ARM, L1, L2, Floats

LIMITS = np.array([pi, pi / 2, pi / 2])


def rejection(inputs: tuple[Any, ...], result: Any) -> str:
    """The last point that a correct program was given, and its result."""
    p, q = np.array(inputs[0], dtype=float).reshape(3), np.asarray(result, dtype=float)
    if not workspace(L1, L2, p).all():
        why = f"this point is not in the workspace: it {out_of_workspace(L1, L2, p)[0]}."
    else:
        off = float(np.linalg.norm(ARM.fk(q).translation - p))
        why = f"inside the limits, with the tool {off:.1g} m from the point."
    called = f"Your test last called it with the point {in_words(p)} m"
    return f"{called}. It returned {in_words(q)} rad: {why}"


def point(p: Any) -> Floats:
    """Return one point (3,). ValueError: it is not one."""
    place = np.asarray(p, dtype=float)
    if place.size != 3:
        raise ValueError(f"p: wanted one point (3,) at a time, got shape {place.shape}")
    return place.reshape(3)


def clipped(x: float) -> float:
    return min(1.0, max(-1.0, x))


def principal(p: Any) -> Floats:
    """The first correct program again, for use in the others."""
    x, y, z = point(p).tolist()
    rho = hypot(x, y)
    d = max(hypot(rho, z), 1e-12)
    beta = acos(clipped((L1**2 + d**2 - L2**2) / (2 * L1 * d)))
    bend = asin(clipped((L1**2 + L2**2 - d**2) / (2 * L1 * L2)))
    return np.array([atan2(y, x), atan2(rho, z) - beta, bend])


def mirrored(p: Any) -> Floats:
    """The arm faces away from the point and leans over its back; within two turns."""
    x, y, z = point(p).tolist()
    q1, q2, q3 = principal(p).tolist()
    return np.array([q1 - pi if q1 > 0 else q1 + pi, q2 - 2 * atan2(hypot(x, y), z), q3])


def lower(p: Floats) -> Floats:
    """The point with every coordinate 0.1 m smaller, if the arm reaches it."""
    found = np.maximum(p - 0.1, [-np.inf, -np.inf, 0.0])
    return found if L1 - L2 < np.linalg.norm(found) < L1 + L2 else p


def short(p: Any, gap: float) -> Floats:
    """The point moved towards the origin by this many metres."""
    place = point(p)
    return np.asarray(place * (1 - gap / max(float(np.linalg.norm(place)), 1.0)))
