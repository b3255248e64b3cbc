"""Cases, form and law of exercise 1; its text is in the Markdown file beside it, and its wrong
programs also use the helpers here.
"""

from functools import cache
from typing import Any

import numpy as np

from robokin import blend, mm
from robokin.course.exercises import in_words
from robokin.course.told import apart, one_number

from .shared import GOAL, P1, START, VIA, D, length

__all__ = ["cases", "form", "law", "length", "mm", "nearest_share", "raised", "same"]
SHARES = {"parabola": 1 / 2, "quintic": 3 / 8}  # distance in the middle = share * blend * |D|


def cases(rng: np.random.Generator) -> list[tuple[float, str]]:
    both = [0.05, 0.1, 0.001, 0.25, 0.3, 0.35, 0.45, 0.6, 1.0, 2.0]
    found = [(d, corner) for d in both for corner in SHARES]
    found += [(0.0002, "parabola"), (0.37, "parabola"), (0.38, "parabola")]
    found += [(0.0, "parabola"), (0.0, "quintic")]
    found += [(0.28, "quintic"), (0.29, "quintic")]
    for corner, share in SHARES.items():
        found += [(float(d), corner) for d in rng.uniform(0.01, 0.49 * share * D, 6).round(4)]
    return found


def form(result: Any, case: tuple[float, str]) -> float:
    try:
        return one_number(result)
    except (TypeError, ValueError):
        raise ValueError(f"wanted a number from 0 to 0.5, or NaN, got {in_words(result)}") from None


def law(case: tuple[float, str], yours: float, wanted: float) -> str | None:
    distance, corner = case
    if np.isnan(wanted):
        if np.isnan(yours):
            return None
        most, asked = apart(SHARES[corner] * 0.5 * D / mm, distance / mm)
        return (
            f"should be NaN: even with the largest blend, 0.5, the tool passes {most} mm from via, "
            f"but the task asks for {asked} mm"
        )
    should = f"should be {wanted:.4g}, so that the tool is {{}} mm from via in the middle of the "
    should += corner
    if not 0 <= yours <= 0.5:
        return should.format(f"{distance / mm:.1f}")
    middle = blend(START, VIA, GOAL, yours, 0.5, corner=corner)
    gap = length(middle.translation - P1)
    if abs(gap - distance) <= 0.05 * mm:
        return None
    asked, is_at = apart(distance / mm, gap / mm)
    return f"{should.format(asked)}; with {yours:.6g}, it is {is_at} mm from via"


def same(a: float, b: float) -> bool:
    """Whether two results are equal, even if one was searched on samples; `law` is stricter."""
    both = a == b or (np.isnan(a) and np.isnan(b))
    return bool(both or abs(a - b) <= 2e-4 + 2e-4 * abs(b))


@cache
def nearest_share(corner: str) -> float:
    """The smallest distance of the path from via, as a fraction of blend times |D|."""
    place = blend(START, VIA, GOAL, 0.5, np.linspace(0, 1, 8001), corner=corner).translation
    return float(np.linalg.norm(place - P1, axis=-1).min()) / (0.5 * D)


def raised(fraction: float) -> float:
    if fraction > 0.5:
        raise ValueError("too far")
    return fraction
