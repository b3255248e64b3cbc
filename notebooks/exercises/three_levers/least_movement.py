"""Helpers for the correct and wrong programs of a test for least movement."""

from functools import lru_cache
from typing import Any

import numpy as np

from robokin import deg as deg  # the programs use it
from robokin.course.exercises import in_words
from robokin.course.told import floats

from .shared import ARM

JOINTS = ("gamma", "beta", "alpha")


def rejection(inputs: tuple[Any, ...], result: Any) -> str:
    """The last task that a correct program was given, and how well it solved it."""
    K, previous, q = map(floats, (*inputs, result))
    called = f"Your test last called it with K = {in_words(K)} m"
    best = exact(K, previous)
    if np.isnan(best).any():
        return f"{called}, which `arm.least` does not reach (NaN). Leave such tasks out."
    called += f" and previous = {in_words(previous)} rad."
    joint = int(np.maximum(q - np.pi, -q).argmax())
    if (past := float(max(q[joint] - np.pi, -q[joint]))) > 0:
        edge = "above 180°" if q[joint] > 1 else "below 0°"
        return (
            f"{called} It returned a {JOINTS[joint]} that is {past:.0e} rad {edge}: computed "
            "angles have rounding errors, and the specification allows 1e-6 rad."
        )
    off, apart = float(np.hypot(*(ARM.points(q)[3] - K))), float(abs(q - best).max()) / deg
    above = float(abs(q - previous).sum() - abs(best - previous).sum()) / deg
    return (
        f"{called} The gripper was {off:.1g} m from K, S was {max(above, 0.0):.3f}° above the "
        f"minimum, and the angles differed by up to {apart:.1g}° from those of `arm.least`. That "
        "meets the specification."
    )


@lru_cache(maxsize=2000)  # many of the programs begin with this, for the same tasks
def remembered(K: tuple[float, ...], previous: tuple[float, ...]) -> Any:
    return ARM.least(np.array(K), np.array(previous))[0]


def exact(K: Any, previous: Any) -> Any:
    """The posture with the least movement, from the package."""
    place, before = (tuple(np.asarray(x, dtype=float).tolist()) for x in (K, previous))
    return remembered(place, before).copy()


def rows(K: Any, step: float, limited: bool = True) -> Any:
    """The postures that reach K, for values of alpha in steps; a row of NaN if there are none."""
    low, high = (float(x) for x in ARM.alpha_range(K, limited=limited))
    if np.isnan(low):
        return np.full((1, 3), np.nan)
    return rows_at(K, np.append(np.arange(low, high, step), high))


def rows_at(K: Any, alphas: Any) -> Any:
    """The postures of `ARM.family` without its checks, which saves hundreds of microseconds."""

    def angle_between(a: Any, b: Any, c: Any) -> Any:
        return np.arccos(np.clip((a**2 + b**2 - c**2) / (2 * a * b), -1, 1))

    KO, KB = np.hypot(*K), 2 * np.sin(alphas / 2)
    gamma = angle_between(KO, 1, KB) + np.arctan2(K[1], K[0])
    return np.stack([gamma, angle_between(KB, 1, KO) + (np.pi - alphas) / 2, alphas], axis=-1)


def nearest(found: Any, previous: Any) -> Any:
    """The posture with the least S."""
    return found[abs(found - previous).sum(axis=-1).argmin()]


class Forgets:
    """A wrong program: it believes that the arm is still where it was at the first call."""

    def __init__(self) -> None:
        self.first: Any = None

    def __call__(self, K: Any, previous: Any) -> Any:
        self.first = np.array(previous) if self.first is None else self.first
        return exact(K, self.first)
