"""Numbers, conditions and sentences of exercise 3; its text is in the Markdown file beside it."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from robokin import ScaraPose, blend, mm
from robokin.course.forms import numbers_of
from robokin.course.told import apart
from robokin.course.variants import Numbers, dice

from .shared import HIGH, LEVEL

COUNT = 4
STROKE = float(HIGH[3])
Given = Mapping[str, float]
UNITS = {name: ("mm", mm) for name in ("start_z", "via_z", "goal_z", "miss")}
UNITS["acceleration"] = ("mm/s²", mm)


def given(who: Any) -> Numbers:
    """A via point too low for the stroke. Joints 1 to 3 do not depend on heights, so they stay
    inside as in the lab; by construction the smallest blend that keeps q4 inside (0.12 to 0.29)
    meets the other conditions, and so do all blends up to 1.1 times as large.
    """
    roll = dice("scara_motion", who)
    heights = {
        "start_z": (100 + 10 * roll.randrange(7)) * mm,
        # at least 10: heights above the table then give a duration more than 2 % too long
        "via_z": (10 + 2 * roll.randrange(6)) * mm,
        "goal_z": (140 + 10 * roll.randrange(9)) * mm,
    }
    most = (3 + roll.randrange(4)) * mm
    fraction = 1.1 * (LEVEL - STROKE - heights["via_z"]) / lift(heights)
    miss = np.ceil(gap(heights, fraction) / mm) * mm
    return Numbers(heights | {"miss": float(miss), "acceleration": most}, UNITS)


def over_via(mine: Given) -> tuple[float, float]:
    """The heights of start and goal above via, m."""
    return mine["start_z"] - mine["via_z"], mine["goal_z"] - mine["via_z"]


def lift(mine: Given) -> float:
    """How far the parabola of a blend of 1 would lift the deepest point, m."""
    h1, h2 = over_via(mine)
    return 2 * h1 * h2 / (h1 + h2)


def gap(mine: Given, fraction: float) -> float:
    """How near the path comes to via, m: the lab's x, y and angles, the student's own heights."""
    start = ScaraPose([0.2, 0.3, mine["start_z"]], 0.0)
    via = ScaraPose([0.4, 0.1, mine["via_z"]], np.pi)
    goal = ScaraPose([0.2, -0.2, mine["goal_z"]], np.pi / 2)
    path = blend(start, via, goal, fraction, np.linspace(0, 1, 2001))
    return float(np.linalg.norm(path.position - via.position, axis=-1).min())


def form(answer: Any, mine: Given) -> dict[str, float]:
    found = numbers_of(answer, ("blend", "duration"))
    if found["blend"] > 1:
        raise ValueError(f"blend: wanted a fraction from 0 to 0.5, got {found['blend']:g}.")
    return found


def faults(answer: Given, mine: Given) -> list[tuple[str, str]]:
    b, duration, most, found = answer["blend"], answer["duration"], mine["acceleration"], []
    if not 0 < b <= 0.5:
        says = f"A blend must be greater than 0 (a sharp corner) and at most 0.5. Yours is {b:g}."
        return [("no such blend", says)] * COUNT
    if duration <= 0:
        return [("no such duration", f"A motion takes time. Yours takes {duration:g} s.")] * COUNT
    deepest = LEVEL - mine["via_z"] - b * lift(mine)
    if deepest > STROKE + 1e-9:  # joints 1 to 3 stay inside for every blend, see `given`
        says = (
            f"The stroke goes {apart((deepest - STROKE) / mm, 0, 2)[0]} mm past its limit of "
            f"{STROKE / mm:.0f} mm. A larger blend lifts the tool more."
        )
        found.append(("past the stroke's limit", says))
    passes = gap(mine, b)
    if passes > mine["miss"] * (1 + 1e-6):
        near, allowed = apart(passes / mm, mine["miss"] / mm)
        says = f"The tool passes {near} mm from via; at most {allowed} mm is allowed. "
        found.append(("too far from via", says + "A smaller blend brings it closer."))
    a = sum(over_via(mine)) / (b * duration**2)  # in the parabola's corner, where it is constant
    shortest = float(np.sqrt(sum(over_via(mine)) / b / most))
    needs, allowed = apart(a / mm, most / mm, 2)
    told = (
        f"In {duration:g} s the stroke accelerates at {needs} mm/s² in the corner of your blend, "
        f"but at most {allowed} mm/s² is allowed"
    )
    fast, slow = a > most * 1.002, duration > 1.02 * shortest
    if fast or slow:
        name, says = slip(duration / shortest, shortest, mine) or (
            ("too fast", "A longer duration or a larger blend helps.")
            if fast
            else ("slower than needed", "A shorter duration is enough.")
        )
        found.append((name, f"{told}. {says}"))
    return found


def slip(ratio: float, shortest: float, mine: Given) -> tuple[str, str] | None:
    """The likely slip if the duration is a known multiple of the shortest one, else None."""
    unit = "mm instead of m", "Use the same unit of length for heights and acceleration."
    whole = "T in the formula is the duration of the whole motion."
    one = (
        "the height of one line alone",
        "You used the height of one line alone. The speed of the stroke changes from 2 h1 / T to "
        "\N{MINUS SIGN}2 h2 / T, so the acceleration depends on h1 + h2.",
    )
    shares = [h / sum(over_via(mine)) for h in over_via(mine)]
    slips = {
        shortest: ("the root is forgotten", "You used T² as the duration. Take the square root."),
        1000**0.5: unit,
        1000**-0.5: unit,
        0.5: ("half of the duration", whole),
        2.0: ("twice the duration", whole),
    }
    slips |= {float(np.sqrt(k * share)): one for share in shares for k in (1, 2)}
    return next((told for factor, told in slips.items() if abs(ratio / factor - 1) < 0.003), None)
