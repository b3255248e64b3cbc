"""Lab 0, start here: its exercise and its prediction, one of each."""

from functools import cache
from typing import Any

import numpy as np

from .._arrays import Floats
from ..arms import IRB140
from ..units import deg, mm
from .exercises import words
from .mistakes import DEGREES
from .old import Fault, Value
from .questions import Option, Prediction

OBJECTIVES = ("change a number and see what follows from it",)
YOURS = (-20, -10, 0, 30, 0)  # q2 to q6, in degrees, as the lab has them


def _place(q: Floats) -> Floats:
    """Where the flange is, in mm."""
    place: Floats = IRB140.fk(q).translation / mm
    return place


# --- 1: a place for the tool ----------------------------------------------------------------------

HEIGHT = 600  # mm
NEAR = 5  # mm: whole degrees are enough, since one degree of joint 2 is some 9 mm


def _posture_form(answer: Any, given: Any) -> Floats:
    q = np.asarray(answer, dtype=float) if np.shape(answer) == (6,) else None
    if q is None or not np.isfinite(q).all():
        raise ValueError(f"wanted six angles in radians, got {words(answer)}")
    return q


def _posture_faults(q: Floats, given: Any) -> list[Fault]:
    if abs(q).max() > 4 * np.pi:  # two turns
        return [("degrees for radians", DEGREES)]
    found = _missed(q)
    if found and (abs(q / deg) <= abs(IRB140.limits).max()).all() and not _missed(q / deg):
        return [("`deg` twice", "These are the right angles, multiplied by `deg` twice.")]
    return found


def _missed(q: Floats) -> list[Fault]:
    """The conditions that the posture q misses."""
    found: list[Fault] = []
    for k, (angle, (low, high)) in enumerate(zip(q, IRB140.limits, strict=True), 1):
        if not low <= angle <= high:
            says = (
                f"Joint {k} is at {angle / deg:.0f}°, and its limits are {low / deg:.0f}° and "
                f"{high / deg:.0f}°."
            )
            found.append(("past a limit", _minus(says)))
            break
    x, y, z = _place(q)
    if abs(z - HEIGHT) > NEAR:
        name = "too low" if z < HEIGHT else "too high"
        says = f"The tool is at a height of {z:.0f} mm; {HEIGHT} mm are wanted. Joint 2 changes it."
        found.append((name, says))
    if x <= 0 or abs(x - y) > NEAR:
        name = "x and y differ"
        says = f"x is {x:.0f} mm and y is {y:.0f} mm; wanted are equal numbers, both positive."
        if x > 0 and abs(x + y) <= NEAR:
            name, says = "right for left", f"{says} To the left y is positive."
        elif abs(x - y) <= NEAR:
            name = "behind the arm"
        found.append((name, _minus(says)))
    return found


# --- Predictions ----------------------------------------------------------------------------------

ANGLE = 40  # degrees, joint 1


def _turned(angle: float) -> Floats:
    return np.array([angle, *YOURS]) * deg


@cache
def _mirror_facts() -> dict[str, Any]:
    (x, y, z), (x1, y1, _) = _place(_turned(ANGLE)), _place(_turned(-ANGLE))
    options = [(-x, y), (x, -y), (-x, -y), (y, x)]
    facts: dict[str, Any] = {"angle": ANGLE, "x": f"{x:.0f}", "y": f"{y:.0f}", "z": f"{z:.0f}"}
    facts |= {
        f"option{k}": _minus(f"x = {a:.0f} mm, y = {b:.0f} mm") for k, (a, b) in enumerate(options)
    }
    for a, b in options:  # where joint 1 stands then
        name = f"at{options.index((a, b))}"
        facts[name] = _minus(f"{np.arctan2(b, a) / deg:.0f}°")
    facts["right"] = int(np.argmin([np.hypot(a - x1, b - y1) for a, b in options]))
    return facts


def _mirror_view() -> Any:
    from ..show import joint_explorer

    return joint_explorer(IRB140, _turned(-ANGLE))


def _minus(text: str) -> str:
    return text.replace("-", "\N{MINUS SIGN}")


# --- The tables -----------------------------------------------------------------------------------

EXERCISES = {
    "1": Value(
        title="A place for the tool",
        task=f"Bring the tool to a height of {HEIGHT} mm, as far to the left as to the front",
        objective=1,
        hints=(
            "Take one number after the other: joint 1 turns the whole arm about a vertical line, "
            "so it changes x and y and leaves the height as it is.",
            "As far to the left as to the front is the direction halfway between x and y: half of "
            "90°. Then change the second number of `yours`: by one degree the height changes by "
            "some 9 mm.",
            "`angle = 45` makes x and y equal. Between -20 and -15 in the place of -20 the height "
            f"passes {HEIGHT} mm. Put the six numbers into `my_posture = np.array([...]) * deg`.",
        ),
        form=_posture_form,
        faults=_posture_faults,
        count=3,
    ),
}

PREDICTIONS = {
    "p1": Prediction(
        question="Joint 1 stands at {angle}°, and the tool is at x = {x} mm, y = {y} mm, z = {z} "
        "mm: x counts to the front, y to the left, z upwards. Now joint 1 turns to −{angle}°, and "
        "the other joints stay. So does z. What are x and y?",
        options=(
            Option(
                "{option0}",
                "The tool would be behind the arm: there joint 1 stands at {at0}.",
                "the sign of the angle taken for the sign of x",
                "At 0° the tool is straight ahead: a little to the left or to the right of that, "
                "x stays positive.",
            ),
            Option(
                "{option1}",
                "Left becomes right, so y changes its sign. How far ahead the tool is, and how "
                "high, is the same on both sides.",
            ),
            Option(
                "{option2}",
                "Both signs change after half a turn: there joint 1 stands at {at2}.",
                "turning to the other side taken for half a turn",
                "A door that opens to the left or to the right is in front of you both times.",
            ),
            Option(
                "{option3}",
                "Exchanged numbers belong to joint 1 at {at3}: they mirror the place in the line "
                "halfway between x and y.",
                "mirrored in the wrong line",
                "At 0° y is 0; exchanged, x would be 0, and the tool to the left of the arm.",
            ),
        ),
        facts=_mirror_facts,
        right=lambda facts: int(facts["right"]),
        view=_mirror_view,
    ),
}
