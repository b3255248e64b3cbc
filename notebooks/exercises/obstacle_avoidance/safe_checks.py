"""Helpers for the correct and wrong programs of exercise 3 of this lab."""

from typing import Any

import numpy as np

from robokin import deg, mm
from robokin.course.told import apart
from robokin.jobs.obstacles import clearance, keeps

from .shared import ARM, Floats, L, distances, gap_to, joints, sampled

__all__ = ["deg", "distances", "halved", "joints", "mm", "np", "proven", "sampled", "gap_to"]


MARGIN = 20 * mm  # if the true clearance is nearer to the distance, both answers are right
TURN = 90 * deg  # the same, if a joint turns by more than this between two postures
EITHER = "so a correct program may give either answer."


def rejection(inputs: tuple[Any, ...], result: Any) -> str:
    """The last motion that a correct program was given, and why its answer is right."""
    path, H, distance = inputs
    turn = float(abs(np.diff(np.asarray(path, dtype=float), axis=0)).max())
    if turn > TURN:
        return f"In the last motion of your test, a joint turns by {turn / deg:.0f}°, {EITHER}"
    true = float(clearance(ARM, path, H).min())
    away, asked = apart(true / mm, float(distance) / mm)
    says = f"In the last motion of your test, the true clearance is {away} mm and the distance "
    if abs(true - distance) <= MARGIN:
        return f"{says}{asked} mm, {EITHER}"
    says += f"{asked} mm. The program answered {bool(result)}, which is right."
    if isinstance(result, np.bool_):
        says += f" But it is NumPy's {bool(result)}, for which `is {bool(result)}` does not hold: "
        says += "write bool(safe(...))."
    return says


def proven(path: Any, H: Any, distance: float) -> bool:
    path = np.asarray(path, dtype=float)
    return bool(keeps(ARM, path[:-1], path[1:], H, distance).all())


def halved(path: Any, H: Any, distance: float) -> bool:
    """Halve the parts until the postures at their ends prove or disprove the distance."""
    path = np.asarray(path, dtype=float)
    parts = np.stack([path[:-1], path[1:]], axis=1)
    for _ in range(30):
        d = distances(parts.reshape(-1, 3), H).min(axis=-1).reshape(-1, 2)
        if (d < distance).any():
            return False
        move = abs(parts[:, 1] - parts[:, 0]) @ np.array([3.0, 2.0, 1.0]) * L
        parts = parts[(d.sum(axis=-1) - move) / 2 < distance]
        if not len(parts):
            return True
        middle = parts.mean(axis=1)
        parts = np.concatenate(
            [np.stack([parts[:, 0], middle], 1), np.stack([middle, parts[:, 1]], 1)]
        )
    return False


def ends_away(q: Floats, H: Any) -> Floats:
    """The distances of H from the far ends of the levers: (n, 3)."""
    gap = joints(q)[:, 1:] - H
    return np.asarray(np.hypot(gap[..., 0], gap[..., 1]))


class Late:
    """A wrong program: each call returns the result of the call before it."""

    def __init__(self, first: bool) -> None:
        self.found = first

    def __call__(self, path: Any, H: Any, distance: float) -> bool:
        before = self.found
        self.found = bool(distances(sampled(path, 301), H).min() >= distance)
        return before
