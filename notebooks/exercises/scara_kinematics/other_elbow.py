"""Cases, form and law of exercise 1; its text is in the Markdown file beside it, and its wrong
programs also use `L0`, `corner` and `distance`.
"""

from typing import Any

import numpy as np

from robokin import deg, mm
from robokin.course.exercises import in_words
from robokin.course.told import apart, floats
from robokin.units import wrapped

from .shared import HIGH, L0, LOW, MINUS, Floats, corner, distance, place, shown

__all__ = ["L0", "cases", "corner", "distance", "form", "law", "same"]


def cases(rng: np.random.Generator) -> list[tuple[Floats]]:
    postures = [
        (0, 90, 0, 0),
        (0, -90, 0, 0),
        (40, 60, -70, 120),
        (40, -60, -70, 120),
        (-30, 0, 20, 50),  # stretched: its own mirror image
        (0, 148, 0, 100),  # the angle inside the triangle is obtuse
        (20, -147, 30, 100),
        (100, 30, 390, 180),  # joint 3: more than one turn
        (-100, -30, -390, 10),
        (130, 100, 300, 60),
        (-130, -100, -300, 60),
        (90, 143.2, 0, 20),
    ]
    found = [(np.array([a * deg, b * deg, c * deg, d * mm]),) for a, b, c, d in postures]
    for q in rng.uniform(LOW, HIGH, (12, 4)).round(3):
        found.append((q,))
    return found


def form(result: Any, case: tuple[Floats]) -> Floats:
    wanted = "wanted four numbers [q1, q2, q3, q4] (rad, rad, rad, m)"
    try:
        values = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {in_words(result)}") from None
    if values.size != 4 or sum(n > 1 for n in values.shape) != 1:
        raise ValueError(f"{wanted}, got {in_words(result)}")
    return values.ravel()


def law(case: tuple[Floats], yours: Floats, right: Floats) -> str | None:
    (q,) = case
    there, wanted = place(yours) / mm, place(q) / mm
    if not np.linalg.norm(there - wanted) <= 1e-4:
        at, is_at = apart(wanted[:2], there[:2])
        return (
            f"the tool should stay at ({at}) mm; with your joints it stands at ({is_at}) mm"
        ).translate(MINUS)
    if not abs(wrapped(yours[1] + q[1])) <= 1e-6:
        return f"joint 2 should stand at {shown(-q[1])}, the elbow on the other side"
    turn, asked = float(yours[:3].sum()), float(q[:3].sum())
    if not abs(turn - asked) <= 1e-6:
        stays, is_at = apart(asked / deg, turn / deg)
        return (f"the tool's angle q1 + q2 + q3 should stay {stays}°; yours is {is_at}°").translate(
            MINUS
        )
    if not abs(yours[3] - q[3]) <= 1e-7:
        stays, is_at = apart(q[3] / mm, yours[3] / mm)
        return f"the stroke should stay {stays} mm; yours is {is_at} mm".translate(MINUS)
    return None


def same(a: Floats, b: Floats) -> bool:
    """Whether two results are equal: whole turns of joints 1 and 2 make no difference, but those of
    the tool's angle do.
    """
    off = np.array([*wrapped((a - b)[:2]), (a - b)[:3].sum(), (a - b)[3]])
    if np.isnan(off).any():  # NaN in the same joints, and the others are close
        off = np.append(wrapped((a - b)[:3]), (a - b)[3])
        return bool((np.isnan(a) == np.isnan(b)).all() and np.nanmax(abs(off), initial=0) <= 1e-7)
    return bool((abs(off) <= 1e-7).all())
