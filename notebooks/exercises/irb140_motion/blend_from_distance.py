"""Cases, form and law of exercise 1; its text is in the Markdown file beside it, and its wrong
programs also use the helpers here.
"""

from functools import cache
from typing import Any

import numpy as np

from robokin import blend, differentiate, mm
from robokin.course.exercises import in_words
from robokin.course.told import apart, one_number

from .shared import GOAL, P1, START, VIA, D, Floats, length

__all__ = ["cases", "form", "law", "length", "measured", "mm", "nearest_share", "raised", "same"]
SHARES = {"parabola": 1 / 2, "quintic": 3 / 8}  # distance in the middle = share * blend * |D|
FACTORS = {"parabola": 1.0, "quintic": 1.5}  # greatest acceleration = factor * |D| / (blend * T²)
DURATION = 20.0  # seconds


def cases(rng: np.random.Generator) -> list[tuple[float, str]]:
    both = [0.05, 0.1, 0.001, 0.25, 0.3, 0.35, 0.45, 0.6, 1.0, 2.0]
    found = [(d, corner) for d in both for corner in SHARES]
    found += [(0.0002, "parabola"), (0.37, "parabola"), (0.38, "parabola")]
    found += [(0.28, "quintic"), (0.29, "quintic")]
    for corner, share in SHARES.items():
        found += [(float(d), corner) for d in rng.uniform(0.01, 0.49 * share * D, 6).round(4)]
    return found


def form(result: Any, case: tuple[float, str]) -> Floats:
    try:
        values = np.array([one_number(each) for each in result])
    except (TypeError, ValueError):
        values = np.empty(0)
    if values.size != 2:
        wanted = "wanted two numbers, the blend and the acceleration"
        raise ValueError(f"{wanted}, got {in_words(result)}")
    return values


def law(case: tuple[float, str], yours: Floats, wanted: Floats) -> str | None:
    distance, corner = case
    fraction, acceleration = yours.tolist()
    if np.isnan(wanted[0]):
        if np.isnan(yours).all():
            return None
        most, asked = apart(SHARES[corner] * 0.5 * D / mm, distance / mm)
        return (
            f"both should be NaN: even with the largest blend, 0.5, the tool passes {most} mm from "
            f"via, but the task asks for {asked} mm"
        )
    should = f"the blend should be {wanted[0]:.4g}, so that the tool is {{}} mm from via in the "
    should += f"middle of the {corner}"
    if not 0 < fraction <= 0.5:
        return should.format(f"{distance / mm:.1f}")
    middle = blend(START, VIA, GOAL, fraction, 0.5, corner=corner)
    gap = length(middle.translation - P1)
    if not abs(gap - distance) <= 0.05 * mm:
        asked, is_at = apart(distance / mm, gap / mm)
        return f"{should.format(asked)}; with {fraction:.6g}, it is {is_at} mm from via"
    needs = FACTORS[corner] * D / (fraction * DURATION**2)
    if not abs(acceleration - needs) <= 0.01 * needs:
        return (
            "the blend is right, but with it the tool's greatest acceleration in the corner is "
            f"{needs:.4g} m/s², not {acceleration:.4g} m/s²"
        )
    return None


def same(a: Floats, b: Floats) -> bool:
    """Whether two results are equal, even if they were searched on samples; `law` is stricter for
    the blend. The acceleration with a blend that does not exist has no value to compare.
    """
    (one, pushed), (other, pushes) = a.tolist(), b.tolist()
    if not np.isclose(one, other, rtol=2e-4, atol=2e-4, equal_nan=True):
        return False
    exists = np.isnan(one) or 0 < one <= 0.5
    return not exists or bool(np.isclose(pushed, pushes, rtol=0.01, atol=0, equal_nan=True))


@cache
def nearest_share(corner: str) -> float:
    """The smallest distance of the path from via, as a fraction of blend times |D|."""
    place = blend(START, VIA, GOAL, 0.5, np.linspace(0, 1, 8001), corner=corner).translation
    return float(np.linalg.norm(place - P1, axis=-1).min()) / (0.5 * D)


def raised(fraction: float) -> float:
    if fraction > 0.5:
        raise ValueError("too far")
    return fraction


def measured(fraction: float, corner: str, samples: int = 1001) -> float:
    """The greatest acceleration of the tool, from samples of the whole motion."""
    if np.isnan(fraction):
        return fraction
    t = np.linspace(0, DURATION, samples)
    place = blend(START, VIA, GOAL, min(fraction, 0.5), t / DURATION, corner=corner).translation
    return float(np.linalg.norm(differentiate(place, t, 2), axis=-1).max())
