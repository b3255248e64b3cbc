"""Numbers, conditions and sentences of exercise 2; its text is in the Markdown file beside it."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from robokin import SCARA, ScaraPose, deg, explain, mm
from robokin.course.exercises import in_words
from robokin.course.slips import DEGREES, METRES
from robokin.course.told import apart, one_number
from robokin.course.variants import Numbers, dice

from .shared import HIGH, LOW, MINUS, Floats

COUNT = 5
UNITS = {"radius": ("mm", mm), "bearing": ("°", deg), "turns": ("whole turns", 1.0)}
AWAY = 25 * deg  # joint 2 has to stay this far from the stretched arm
LEVEL = 100 * mm
SAMPLES = 361
SLACK = 1e-6
Given = Mapping[str, Any]
Fault = tuple[str, str]


def given(who: Any) -> Numbers:
    """A circle in a direction where joint 1 is close to its limit, and two turns of the tool."""
    roll = dice("scara_kinematics", who)
    side = 1 - 2 * roll.randrange(2)
    values = {
        "radius": (60 + 5 * roll.randrange(7)) * mm,
        "bearing": side * (100 + 5 * roll.randrange(6)) * deg,
        "turns": 2 - 4 * roll.randrange(2),
    }
    return Numbers(values, UNITS)


def own_circle(given: Given, distance: float, angle: float) -> ScaraPose:
    """One lap, with the centre at `distance`; the tool's angle begins at `angle`."""
    omega = np.linspace(0, 2 * np.pi, SAMPLES)
    x = distance * np.cos(given["bearing"]) + given["radius"] * np.cos(omega)
    y = distance * np.sin(given["bearing"]) + given["radius"] * np.sin(omega)
    place = np.stack([x, y, np.full_like(x, LEVEL)], axis=-1)
    return ScaraPose(place, angle + given["turns"] * omega)


def form(answer: Any, given: Given) -> dict[str, Any]:
    """Distance and angle as floats, the elbow as +1 or -1."""
    if not isinstance(answer, Mapping):
        raise ValueError(f"Wanted a dict with distance, elbow and angle, got {in_words(answer)}.")
    missing = [key for key in ("distance", "elbow", "angle") if key not in answer]
    if missing:
        raise ValueError(f"Your dict has no {' and no '.join(repr(key) for key in missing)}.")
    design: dict[str, Any] = {}
    for key, unit in (("distance", "metres"), ("elbow", "+1 or -1"), ("angle", "radians")):
        try:
            value = one_number(answer[key])
        except (TypeError, ValueError):
            value = np.nan
        if not np.isfinite(value):
            wanted = unit if key == "elbow" else f"a number of {unit}"
            raise ValueError(f"{key}: wanted {wanted}, got {in_words(answer[key])}.")
        design[key] = value
    if design["elbow"] not in (1, -1):
        raise ValueError(f"elbow: wanted the flag +1 or -1, got {in_words(answer['elbow'])}.")
    return design


def joints(design: Given, given: Given) -> Floats:
    """The joint values (samples, 4) on the circle; q3 and the tool's angle are not wrapped."""
    targets = own_circle(given, design["distance"], design["angle"])
    rows = SCARA.ik(targets)[:, SCARA.branch(int(design["elbow"]))]
    q1, q2 = np.unwrap(rows[:, 0]), rows[:, 1]
    return np.stack([q1, q2, targets.angle - q1 - q2, rows[:, 3]], axis=-1)


def past(q: Floats) -> Floats:
    """The most by which each joint exceeds its limits; negative: inside."""
    over: Floats = np.maximum(q - HIGH, LOW - q).max(axis=0)
    return over


def faults(design: Given, given: Given) -> list[Fault]:
    """What is wrong with the reach, the limits of joints 1, 2 and 3, and the stretch of the arm."""
    distance, angle = design["distance"], design["angle"]
    if abs(distance) > 5:
        name = "mm for m" if abs(distance) >= 60 else "cm for m"
        return [(name, f"The distance is {distance:g} m. {METRES}")] * COUNT
    if abs(angle) > 8 * np.pi:
        return [("degrees for radians", f"An angle of {angle / deg:.0f}°. {DEGREES}")] * COUNT
    if distance < 0:
        says = "A distance is not negative: the direction is given, it is your bearing."
        return [("a negative distance", says)] * COUNT
    targets = own_circle(given, distance, angle)
    q = joints(design, given)
    row = SCARA.branch(int(design["elbow"]))
    missing = np.isnan(SCARA.ik(targets)[:, row]).any(axis=-1)
    if missing.any():
        says = f"{missing.mean():.0%} of the circle is out of reach. "
        says += explain(SCARA, targets[int(missing.argmax())], row)
        return [("out of reach", says)] * COUNT
    away = np.linalg.norm(targets.position[:, :2], axis=-1) / mm
    found = [joint_1(q, design, given), *joint_2(q, away.min(), away.max()), joint_3(q)]
    return [fault for fault in found if fault]


def joint_1(q: Floats, design: Given, given: Given) -> Fault | None:
    over = past(q)[0]
    if over <= SLACK:
        return None
    says = f"Joint 1 passes its limit of ±{HIGH[0] / deg:.0f}° by {apart(over / deg, 0)[0]}°."
    if past(joints({**design, "elbow": -design["elbow"]}, given))[0] > SLACK:
        return "past a limit: joint 1", says
    says += " The other elbow reaches the same places with another angle of joint 1."
    return "the wrong elbow", says


def joint_2(q: Floats, nearest: float, farthest: float) -> list[Fault]:
    found, over, bent = [], past(q)[1], abs(q[:, 1]).min()
    if over > SLACK:
        says = (
            f"Joint 2 passes its limit of ±{HIGH[1] / deg:.0f}° by {apart(over / deg, 0)[0]}°: "
            f"the circle comes as near as {nearest:.1f} mm to joint 1, into the hole."
        )
        found.append(("past a limit: joint 2", says))
    if bent < AWAY - SLACK:
        near, asked = apart(bent / deg, AWAY / deg)
        says = (
            f"Joint 2 comes as near as {near}° to the stretched arm, and {asked}° are asked for: "
            f"the circle goes out to {farthest:.1f} mm."
        )
        found.append(("too near to the stretched arm", says))
    return found


def joint_3(q: Floats) -> Fault | None:
    over = past(q)[2]
    if over <= SLACK:
        return None
    low, high = q[:, 2].min(), q[:, 2].max()
    says = (
        f"Joint 3 runs from {low / deg:.1f}° to {high / deg:.1f}°; its limits are "
        f"±{HIGH[2] / deg:.0f}°, and it passes them by {apart(over / deg, 0)[0]}°."
    ).translate(MINUS)
    for turns, name in ((1, "A whole turn"), (2, "Two whole turns")):
        if any(past(q + [0, 0, 2 * np.pi * k, 0])[2] <= SLACK for k in (-turns, turns)):
            says += f" {name} more or less at the start {'is' if turns == 1 else 'are'} the same "
            return f"joint 3 begins {name.lower()} off", f"{says}pose, and fit{'s' * (turns == 1)}."
    return "past a limit: joint 3", says
