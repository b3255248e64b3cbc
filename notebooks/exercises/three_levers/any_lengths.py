"""Levers of any length: the cases, and the sentences of the verdict."""

from typing import Any

import numpy as np

from robokin import deg
from robokin.course.exercises import in_words
from robokin.course.told import apart, floats
from robokin.units import wrapped

from .shared import direction

Case = tuple[Any, ...]


def third(b: float, c: float, alpha: float) -> float:
    """The third side of a triangle: KB from BA, AK and alpha."""
    return float(np.sqrt(b**2 + c**2 - 2 * b * c * np.cos(alpha)))


def chain(q: Any, lengths: Any) -> Any:
    """The points O, B, A, K: (4, 2)."""
    gamma, beta, alpha = q
    ways = np.array([gamma, gamma + beta - np.pi, gamma + beta + alpha - 2 * np.pi])
    steps = np.asarray(lengths)[:, None] * direction(ways)
    return np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])


def cases(rng: np.random.Generator) -> list[Case]:
    def case(x: float, y: float, alpha: float, lengths: list[float]) -> Case:
        return np.array([x, y]), alpha * deg, np.array(lengths)

    found = [
        case(1.5, 1.0, 120, [1, 1, 1]),  # as in the lab
        case(2.0, 0.0, 150, [1, 1, 1]),
        case(1.5, 1.0, 120, [1, 1, 0.5]),
        case(1.0, 0.5, 90, [1, 0.6, 0.8]),
        case(-1.0, 1.5, 150, [1, 1, 1]),  # left of O
        case(0.0, 1.4, 100, [0.9, 0.8, 0.6]),  # x is 0
        case(-1.2, -0.6, 110, [0.8, 1.0, 0.7]),
        case(2.5, 0.0, 60, [1, 1, 1]),  # K is too far away: no posture
        case(0.1, 0.1, 150, [0.5, 0.9, 0.8]),  # K is too near: no posture
        case(3.0, 1.0, 170, [0.6, 1.0, 0.9]),
        case(0.9, 0.2, 20, [1.0, 0.9, 0.4]),  # a small alpha: BA and AK lie nearly on each other
        case(0.6, -0.3, 40, [0.9, 0.5, 0.9]),
        case(1.4, 0.6, 179, [0.7, 0.6, 0.5]),
        case(0.25, 0.1, 75, [0.35, 0.3, 0.2]),  # a table-top arm
        case(0.3, -0.4, 60, [0.5, 0.3, 0.45]),  # K is nearer than a lever is long
        case(1.9, 0.0, 60, [1, 1, 1]),  # beta is above 180 degrees
        case(1.2, 0.8, 50, [0.9, 0.8, 0.7]),
        case(0.9, 0.4, 40, [0.8, 0.4, 1.0]),  # beta_2 is above 90 degrees
        case(-0.7, 0.5, 30, [0.7, 0.5, 0.9]),
        case(0.2, -0.3, 130, [1.2, 0.3, 0.4]),  # K is nearer than any alpha allows
    ]
    # a few mm inside or outside the border: far, near, and near with OB longer than KB
    found += [case(KO, 0.0, 120, [1, 1, 1]) for KO in (2.72, 2.745, 0.738, 0.726)]
    found += [case(0.0, KO, 60, [1.2, 0.5, 0.5]) for KO in (0.705, 0.695)]
    while len(found) < 41:
        lengths = rng.uniform(0.3, 1.2, 3).round(2)
        alpha = rng.uniform(15, 175)
        r, phi = rng.uniform(0.2, 2.8), rng.uniform(-180, 180) * deg
        x, y = (r * direction(phi)).round(2)
        a, b, c = lengths
        KB, KO = third(b, c, alpha * deg), float(np.hypot(x, y))
        gap = min(KB + a - KO, KO - abs(KB - a))
        if gap > 0.02 or (gap < -0.02 and len(found) % 5 == 0):
            found.append(case(float(x), float(y), round(float(alpha), 1), lengths.tolist()))
    return found


def form(result: Any, case: Case) -> Any:
    try:
        q = floats(result).ravel()
    except (TypeError, ValueError):
        q = np.empty(0)
    if q.size != 3 and not (q.size == 1 and np.isnan(q).all()):
        wanted = "wanted three angles (gamma, beta, alpha) in radians, or NaN"
        raise ValueError(f"{wanted}, got {in_words(result)}")
    return np.full(3, np.nan) if np.isnan(q[:2]).any() else q  # also for [nan, nan, alpha]


def law(case: Case, yours: Any, wanted: Any) -> str | None:
    point, alpha, lengths = case
    if np.isnan(wanted).any():
        if np.isnan(yours).all():
            return None
        KO, KB = np.hypot(*point), third(lengths[1], lengths[2], alpha)
        return (
            f"should be NaN: with alpha = {alpha / deg:.2f}°, OB = {lengths[0]:g} m, KB = "
            f"{KB:.3f} m and KO = {KO:.3f} m form no triangle"
        )
    told, yours_told = apart(wanted / deg, yours / deg, 2)
    if np.isnan(yours).any():
        return f"gamma, beta, alpha should be ({told})°: this posture exists"
    gripper = chain(yours, lengths)[3]
    miss = float(np.hypot(*(gripper - point)))
    if miss > 1e-6:
        is_at, off = apart(gripper, point, 3)[0], apart(miss, 0, 3)[0]
        return (
            f"gamma, beta, alpha should be ({told})°; yours, ({yours_told})°, puts the gripper at "
            f"({is_at}) m, {off} m from K"
        )
    if abs(wrapped(yours - wanted)).max() <= 1e-5:
        return None
    return (
        f"gamma, beta, alpha should be ({told})°; yours, ({yours_told})°, reaches K, too, but it "
        "is a different posture"
    )


def same(a: Any, b: Any) -> bool:
    if a.shape != b.shape or (np.isnan(a) != np.isnan(b)).any():
        return False
    return bool(np.isnan(a).all() or np.nanmax(abs(wrapped(a - b))) <= 1e-7)
