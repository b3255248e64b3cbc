"""Exercise 2: its cases, its law, and the values that wrong programs use for a free angle."""

from contextlib import suppress
from typing import Any

import numpy as np

from robokin.course import forms
from robokin.course.exercises import in_words
from robokin.course.told import apart, floats

from .shared import Floats, each_needs

Case = tuple[Floats, Floats]


def cases(rng: np.random.Generator) -> list[Case]:
    nan = np.nan

    def case(q: Any, speeds: Any = (0.5, 0.5, 0.5)) -> Case:
        return np.array(q, dtype=float), np.array(speeds, dtype=float)

    found = [
        case([[0, 0, 0], [0.2, 0.4, -0.6]]),
        case([[0.4, 0.2, 0.1], [0.1, 0.5, 0.2]], [0.5, 0.2, 1]),
        case([[0, 0, 0], [1, 0.2, 0.1], [0.5, 0.9, 0.3]], [0.5, 1, 0.25]),
        case([[0, 0, 0], [0.6, 0.1, 0.2], [0, 0, 0]], [0.2, 0.4, 0.5]),  # out and back
        case([[0.3, 0.1, 0.2], [0.3, 0.1, 0.2], [0.5, 0.1, 0.2]]),  # the first stop is the start
        case([[0.8, 0.1, 0.2], [nan, 0.4, 0.2], [-0.4, 0.1, 0.2]]),  # over the axis
        case([[-0.9, 0.2, 0.3], [nan, 0.3, 0.1], [0.3, 0.1, 0.2]], [0.3, 0.5, 0.2]),
        case([[nan, 0.3, 0.2], [1.2, 0.2, 0.1]]),  # begins on the axis
        case([[nan, 0.3, 0.2], [-1.2, 0.5, 0.1], [0.3, 0.2, 0.2]]),
        case([[0.9, 0.3, 0.2], [nan, 0.1, 0.5]]),  # ends on the axis
        case([[0.9, 0.3, 0.2], [nan, 0.1, 0.5], [nan, 0.4, 0.1], [-0.6, 0.2, 0.2]]),  # two in a row
        case([[nan, 0.3, 0.2], [nan, 0.6, 0.5], [2, 0.4, 0.1], [1, 0.2, 0.2]]),
        case([[0.7, 0.3, 0.2], [nan, 0.1, 0.5], [0.7, 0.2, 0.2], [nan, 0.3, 0.3], [-1, 0.1, 0]]),
        case([[3.1, 0.2, 0.2], [-3.1, 0.2, 0.2]]),  # across the half turn
        case([[-3.1, 0.2, 0.2], [nan, 0.3, 0.4], [3.1, 0.2, 0.2]], [0.4, 0.5, 0.3]),
    ]
    while len(found) < 30:
        n = int(rng.integers(2, 7))
        q = rng.uniform([-3, -1.4, -1.4], [3, 1.4, 1.4], size=(n, 3)).round(2)
        q[rng.uniform(size=n) < 0.25, 0] = nan
        if not np.isnan(q[:, 0]).all():
            found.append(case(q, rng.uniform(0.1, 1, 3).round(2)))
    return found


def form(result: Any, case: Case) -> Floats:
    n = len(case[0]) - 1
    wanted = f"wanted {n} time{'s' * (n > 1)}, one for each stop after the start"
    values: Floats = np.zeros(0)
    with suppress(TypeError, ValueError):
        values = floats(result)
    if values.shape in ((n, 1), (1, n)) or (n == 1 and values.ndim == 0):
        values = values.reshape(n)
    if values.shape == (n + 1,) and values[0] == 0:
        raise ValueError(f"{wanted}: the start has none; yours begins with 0 for it")
    if values.shape != (n,):
        raise ValueError(f"{wanted}, got {in_words(result)}")
    return values


def law(case: Case, yours: Floats, wanted: Floats) -> str | None:
    q, speeds = case
    wrong = ~(abs(yours - wanted) <= 1e-6 * (1 + wanted))
    if not wrong.any():
        return None
    k = int(wrong.argmax())
    needs = each_needs(q, speeds)[k]
    j = int(needs.argmax())
    kept = " (on the axis joint 1 keeps its angle)" if np.isnan(q[: k + 2, 0]).any() else ""
    at, is_at = apart(wanted[k], yours[k], 3)
    return (
        f"stop {k + 1} should be reached at {at} s: the move to it takes {needs[j]:.4g} s, set by "
        f"joint {j + 1}{kept}; you have {is_at} s"
    )


def same(a: Floats, b: Floats) -> bool:
    """As the default, but faster if all are numbers, since a thousand programs are compared."""
    if a.shape == b.shape and np.isfinite(a).all() and np.isfinite(b).all():
        return bool((abs(a - b) <= 1e-6 * (1 + abs(b))).all())
    return forms.same(a, b)


def between(q: Floats) -> Floats:
    """For a wrong program: half of the turn before a stop on the axis, half after it."""
    known = np.flatnonzero(~np.isnan(q[:, 0]))
    return np.asarray(np.interp(range(len(q)), known, q[known, 0]))


def nearest(q: Floats) -> Floats:
    """For another wrong program: the known angle of the nearest stop, before or after."""
    known = np.flatnonzero(~np.isnan(q[:, 0]))
    away = abs(np.arange(len(q))[:, None] - known)
    return np.asarray(q[known[away.argmin(axis=-1)], 0])
