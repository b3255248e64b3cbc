"""Cases, form and law of exercise 3; its text is in the Markdown file beside it, and its wrong
programs also use `deg`, `mm` and `wrapped`.
"""

from typing import Any

import numpy as np

from robokin import SCARA, deg, mm
from robokin.course.exercises import in_words
from robokin.course.told import apart, floats
from robokin.units import wrapped

from .shared import MINUS, Floats

__all__ = ["cases", "deg", "form", "law", "mm", "same", "wrapped"]
Case = tuple[float, int, int, Floats]
ANGLE, LENGTH = (" rad", "°", deg), (" m", " mm", mm)
NAMES = (ANGLE, ANGLE, ANGLE, LENGTH)


def cases(rng: np.random.Generator) -> list[Case]:
    """Radius, turns, elbow, and limits that some joint exceeds, on either side."""
    own = SCARA.limits
    tight = np.array([(-60, 80), (-110, 140), (-100, 300), (0, 115)])
    other = np.array([(-35, 150), (20, 160), (-400, 90), (125, 180)])
    late = np.array([(-140, 140), (-150, 150), (0, 400), (0, 180)])
    units = np.array([deg, deg, deg, mm])[:, None]
    found: list[Case] = [
        (0.1, 0, +1, own),  # only joint 2, in the hole
        (0.07, 4, +1, own),  # only joint 3
        (0.07, -4, -1, own),
        (0.07, 1, -1, own),
        (0.07, 1, +1, late * units),  # joint 3 at the start only
        (0.05, 0, -1, tight * units),
        (0.12, 1, +1, tight * units),
        (0.06, -2, +1, other * units),
        (0.03, 2, -1, other * units),
    ]
    for _ in range(6):
        half = rng.uniform([40, 90, 60, 20], [120, 150, 500, 80]).round()
        middle = rng.uniform([-40, -30, -100, 90], [40, 30, 100, 130]).round()
        limits = np.stack([middle - half, middle + half], axis=-1) * units
        radius = float(rng.integers(3, 14)) / 100
        found.append((radius, int(rng.integers(-3, 4)), int(rng.choice([-1, 1])), limits))
    return found


def form(result: Any, case: Case) -> Floats:
    wanted = "wanted four numbers (rad, rad, rad, m), one for each joint"
    try:
        values = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {in_words(result)}") from None
    if values.size != 4 or sum(n > 1 for n in values.shape) != 1:
        raise ValueError(f"{wanted}, got {in_words(result)}")
    return values.ravel()


def law(case: Case, yours: Floats, right: Floats) -> str | None:
    for k, (unit, shown, size) in enumerate(NAMES):
        if not abs(yours[k] - right[k]) <= 1e-6:
            most, got = apart(right[k], yours[k], 3)
            most_shown, got_shown = apart(right[k] / size, yours[k] / size)
            told = (
                f"joint {k + 1} exceeds its limits by up to {most}{unit} ({most_shown}{shown}); "
                f"you have {got}{unit} ({got_shown}{shown})"
            )
            return told.translate(MINUS)
    return None


def same(a: Floats, b: Floats) -> bool:
    return bool(np.allclose(a, b, rtol=0, atol=1e-7, equal_nan=True))
