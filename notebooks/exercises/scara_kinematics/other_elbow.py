"""Cases, form and law of exercise 1; its text is in the Markdown file beside it, and its wrong
programs also use `corner`, `third` and `wrapped`.
"""

from typing import Any

import numpy as np

from robokin import deg, mm
from robokin.course.exercises import in_words
from robokin.course.told import apart, floats
from robokin.units import wrapped

from .shared import MINUS, Floats, corner, shown, third

__all__ = ["cases", "corner", "form", "law", "same", "third", "wrapped"]
Case = tuple[float, float, float, float, float]


def cases(rng: np.random.Generator) -> list[Case]:
    """Joints 1 and 2, the first link, and the place of the camera along and beside the second."""
    postures = [
        (0, 90, 200, 250, 0),  # the camera at the end of the lab's second link
        (0, 90, 200, 250, 100),
        (0, -90, 200, 250, 100),
        (40, 60, 300, 150, 60),
        (40, 60, 300, 150, -60),
        (-30, -50, 300, 150, 60),
        (25, -np.degrees(np.arctan2(80, 200)), 250, 200, 80),  # straight: its own mirror image
        (0, 140, 200, 260, 40),  # the angle inside the triangle is obtuse
        (20, -160, 200, 240, 50),
        (130, 100, 350, 100, 200),  # the camera is more beside the link than along it
        (-130, 80, 350, -50, 120),
    ]
    found = [(a * deg, b * deg, c * mm, d * mm, e * mm) for a, b, c, d, e in postures]
    for first, second, one, ahead, beside in rng.uniform(-1, 1, (12, 5)).round(3).tolist():
        lengths = 0.3 + 0.1 * one, 0.2 + 0.1 * ahead, 0.15 * beside
        found.append((2.4 * first, 2.6 * second, *(round(x, 4) for x in lengths)))
    return found


def camera(angles: Any, case: Case) -> Floats:
    """The place of the camera in metres, for the angles of joints 1 and 2."""
    q1, q2 = angles
    *_, l1, along, side = case
    lever = np.array([[np.cos(q1 + q2), -np.sin(q1 + q2)], [np.sin(q1 + q2), np.cos(q1 + q2)]])
    place: Floats = l1 * np.array([np.cos(q1), np.sin(q1)]) + lever @ [along, side]
    return place


def form(result: Any, case: Case) -> Floats:
    wanted = "wanted two angles [q1, q2] in radians"
    try:
        values = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {in_words(result)}") from None
    if values.size != 2 or sum(n > 1 for n in values.shape) != 1:
        raise ValueError(f"{wanted}, got {in_words(result)}")
    return values.ravel()


def law(case: Case, yours: Floats, right: Floats) -> str | None:
    there, wanted = camera(yours, case) / mm, camera(case[:2], case) / mm
    if not np.linalg.norm(there - wanted) <= 1e-4:
        at, is_at = apart(wanted, there)
        return (
            f"the camera should be at ({at}) mm again; with your angles it is at ({is_at}) mm"
        ).translate(MINUS)
    if not abs(wrapped(yours[1] - right[1])) <= 1e-6:
        second = shown(float(wrapped(right[1])))
        return f"joint 2 should be at {second}, with the elbow on the other side"
    return None


def same(a: Floats, b: Floats) -> bool:
    """Whether two results are equal; whole turns make no difference."""
    off = wrapped(a - b)
    if np.isnan(off).any():  # NaN in the same joints, and the others are close
        return bool((np.isnan(a) == np.isnan(b)).all() and np.nanmax(abs(off), initial=0) <= 1e-7)
    return bool((abs(off) <= 1e-7).all())
