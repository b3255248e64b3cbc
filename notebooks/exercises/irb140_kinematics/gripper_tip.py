"""Cases, form and law of exercise 1; its text is in the Markdown file beside it, and its wrong
programs also use `X`, `Z`, `L4` and `LAST_TURN`.
"""

from typing import Any

import numpy as np

from robokin import IRB140, Quaternion, Transform, deg, mm
from robokin.course.exercises import in_words
from robokin.course.told import apart

from .shared import L4, Floats, X, Y, Z, turned

__all__ = ["L4", "LAST_TURN", "X", "cases", "form", "law", "same"]

LAST_TURN = Transform(turned(90 * deg, Y))  # the rotation at the end of the chain


def flange(q: Floats, upper: float) -> Transform:
    """The flange pose of an arm whose upper arm has the length `upper`: the pose of the IRB-140,
    shifted along the upper arm.
    """
    more = IRB140.frames(q)[2].rotation @ ((upper - 350 * mm) * Z)
    return Transform(translation=more) @ IRB140.fk(q)


def cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    """Home, then one joint at a time, then random postures inside the limits."""
    home = np.zeros(6)
    found: list[tuple[Any, ...]] = [
        (home, 350 * mm, 100 * mm, 0.0),
        (home, 360 * mm, 100 * mm, 90 * deg),
        (home, 360 * mm, 0.0, -30 * deg),
        (home, 300 * mm, 0.0, 0.0),
    ]
    for k in range(6):
        q = np.zeros(6)
        q[k] = (90, 45, -60, 90, 30, 45)[k] * deg
        found.append((q, 360 * mm, 150 * mm, 60 * deg))
    low, high = IRB140.limits.T
    for _ in range(14):
        length, turn = float(rng.uniform(20, 300)) * mm, float(rng.uniform(-170, 170)) * deg
        upper = float(rng.uniform(250, 450)) * mm
        found.append((rng.uniform(low, high), upper, length, turn))
    return found


def form(result: Any, case: tuple[Any, ...]) -> Transform:
    """Return the answer if it is one pose. ValueError: it is not."""
    if isinstance(result, Transform) and result.shape == ():
        return result
    hint = ""
    if isinstance(result, Transform):
        hint = "; q is one posture (6,)"
    elif isinstance(result, Quaternion):
        hint = ": an orientation without a position"
    elif np.shape(result) == (3,):
        hint = ": a position without an orientation"
    elif np.shape(result) == (4, 4):
        hint = "; Transform.from_matrix turns it into one"
    raise ValueError(f"Wanted one Transform, got {in_words(result)}{hint}.")


def law(case: tuple[Any, ...], yours: Transform, wanted: Transform) -> str | None:
    """How the answer differs from the gripper's tip, in flange coordinates."""
    q, upper, length, turn = case
    seen = flange(q, upper).inverse() @ yours
    if abs(seen.translation - [0, 0, length]).max() > 1e-7:
        tip_at = in_mm(wanted.translation)
        there, is_at = apart(np.array([0, 0, length]) / mm, seen.translation / mm)
        return (
            f"should be at {tip_at} mm: in flange coordinates, the tip is at ({there}) mm, but "
            f"yours is at ({is_at}) mm"
        )
    off = float(seen.rotation.angle_to(turned(turn, Z)))
    if off > 1e-7:
        return (
            "is in the right place, but seen from the flange, it should be turned by "
            f"{turn / deg:.1f}° about z; your orientation is {apart(off / deg, 0)[0]}° away from "
            "that"
        )
    return None


def in_mm(place: Any) -> str:
    """A position as text, in mm."""
    return "(" + ", ".join(f"{x / mm + 0.0:.1f}" for x in np.round(place, 9)) + ")"


def same(a: Transform, b: Transform) -> bool:
    """Whether two poses are equal up to rounding."""
    return bool(np.allclose(a.as_matrix(), b.as_matrix(), rtol=0, atol=1e-7))
