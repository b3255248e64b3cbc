"""What the right and wrong programs of exercise 3, a test for phases, use."""

from typing import Any

import numpy as np

from robokin.jobs.steppers import energised, phases

__all__ = ["energised", "phases", "sums", "walk"]


def sums(signs: Any) -> Any:
    """The row before the first pulse, 0, and after every pulse, not taken round the ring."""
    return np.concatenate([[0], np.cumsum(np.asarray(signs, dtype=int))])


def walk(signs: Any, count: int, lost: bool) -> list[int]:
    """The rows of a walk that goes wrong where the direction changes: it begins with the first row
    again, or the pulse is lost.
    """
    at, rows, before = 0, [0], 0
    for sign in np.asarray(signs, dtype=int).tolist():
        turned = before and sign != before
        if not (turned and lost):
            at = ((0 if turned else at) + sign) % count
        before = sign
        rows.append(at)
    return rows
