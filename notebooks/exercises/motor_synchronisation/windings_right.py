"""Helpers for the correct and wrong programs of exercise 3 of this lab."""

from typing import Any

import numpy as np

from robokin.jobs.steppers import energised, phases

__all__ = ["energised", "phases", "sums", "walk"]


def sums(signs: Any) -> Any:
    """The row before the first pulse, 0, and after every pulse, not wrapped at the last row."""
    return np.concatenate([[0], np.cumsum(np.asarray(signs, dtype=int))])


def walk(signs: Any, count: int, lost: bool) -> list[int]:
    """The rows of a walk that goes wrong when the direction changes: it starts again from the first
    row, or the pulse is lost.
    """
    at, rows, before = 0, [0], 0
    for sign in np.asarray(signs, dtype=int).tolist():
        turned = before and sign != before
        if not (turned and lost):
            at = ((0 if turned else at) + sign) % count
        before = sign
        rows.append(at)
    return rows
