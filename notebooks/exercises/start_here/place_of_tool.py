"""The conditions of exercise 1; its text is in the Markdown file beside it."""

from contextlib import suppress
from typing import Any

import numpy as np

from robokin import IRB140, deg
from robokin.course.exercises import in_words
from robokin.course.function import Fault
from robokin.course.slips import DEGREES

from .shared import minus, place

COUNT = 3
HEIGHT = 600  # mm
NEAR = 5  # mm: whole degrees are enough, since one degree of joint 2 is about 9 mm
A_PLACE = (
    "a place instead of angles",
    "These three numbers are a place. Give the six joint angles that bring the tool there: "
    "`my_posture = yours`.",
)


class Angles:
    """Angles in radians that are shown in degrees."""

    def __init__(self, q: Any) -> None:
        self.q = q

    def __repr__(self) -> str:
        return minus(f"[{', '.join(f'{x:.4g}°' for x in np.round(self.q / deg, 6) + 0.0)}]")


def plain(answer: Any) -> Any:
    """Six angles in degrees, which is what the case shows."""
    with suppress(TypeError, ValueError):
        return Angles(form(answer, None)) if np.shape(answer) == (6,) else answer
    return answer


def form(answer: Any, given: Any) -> Any:
    q = np.asarray(answer, dtype=float) if np.shape(answer) in ((6,), (3,)) else None
    if q is None or not np.isfinite(q).all():
        raise ValueError(f"Wanted six angles in radians, q1 to q6, got {in_words(answer)}.")
    return q


def holds(q: Any, given: Any) -> tuple[str, ...]:
    """Where the tool is, and which joints brought it there."""
    x, y, z = place(q)
    return (
        minus(f"The tool is at x = {x:.0f} mm, y = {y:.0f} mm, z = {z:.0f} mm."),
        "Joint 1 turns the whole arm to the left or to the right; only other joints can change the "
        "height.",
    )


def faults(q: Any, given: Any) -> list[Fault]:
    if q.shape == (3,):
        return [A_PLACE] * COUNT  # no condition holds
    if abs(q).max() > 4 * np.pi:  # two turns
        return [("degrees for radians", DEGREES)]
    found = missed(q)
    if found and (abs(q / deg) <= abs(IRB140.limits).max()).all() and not missed(q / deg):
        return [("`deg` twice", "The angles are right, but you multiplied them by `deg` twice.")]
    return found


def missed(q: Any) -> list[Fault]:
    """The conditions that the posture q does not meet."""
    found: list[Fault] = []
    for k, (angle, (low, high)) in enumerate(zip(q, IRB140.limits, strict=True), 1):
        if not low <= angle <= high:
            says = (
                f"Joint {k} is at {angle / deg:.0f}°, but its limits are {low / deg:.0f}° and "
                f"{high / deg:.0f}°."
            )
            found.append(("past a limit", minus(says)))
            break
    x, y, z = place(q)
    if abs(z - HEIGHT) > NEAR:
        name = "too low" if z < HEIGHT else "too high"
        says = (
            f"The tool should be at a height of {HEIGHT} mm, but it is at {z:.0f} mm. Use joint 2."
        )
        found.append((name, says))
    if x <= 0 or abs(x - y) > NEAR:
        name = "x and y differ"
        says = f"x is {x:.0f} mm and y is {y:.0f} mm, but they should be equal and positive."
        if x > 0 and abs(x + y) <= NEAR:
            name, says = "right instead of left", f"{says} On the left, y is positive."
        elif abs(x - y) <= NEAR:
            name = "behind the arm"
        found.append((name, minus(says)))
    return found
