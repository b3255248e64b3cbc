"""Numbers, conditions and sentences of exercise 2; its text is in the Markdown file beside it."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from robokin import SCARA, ClosedFormArm, ScaraPose, deg, explain, mm, scara_arm
from robokin.course.exercises import in_words
from robokin.course.slips import DEGREES, METRES
from robokin.course.told import apart, one_number
from robokin.course.variants import Numbers, dice

from .shared import L0, L1, L2, MINUS, Floats, distance

COUNT = 6
UNITS = {
    "stop": ("° (joint 2 stops at plus and minus this)", deg),
    "radius": ("mm", mm),
    "bearing": ("°", deg),
    "turns": ("whole turns", 1.0),
}
AWAY = 25 * deg  # joint 2 has to stay this far from 0
LEVEL = 100 * mm
SAMPLES = 361
SLACK = 1e-6
CLOSE = 0.5 * mm  # of the radius of the hole
Given = Mapping[str, Any]
Fault = tuple[str, str]


def given(who: Any) -> Numbers:
    """A stop of joint 2, and a circle in a direction where joint 1 is close to its limit, with two
    turns of the tool.
    """
    roll = dice("scara_kinematics", who)
    side = 1 - 2 * roll.randrange(2)
    values = {
        "radius": (60 + 5 * roll.randrange(7)) * mm,
        "bearing": side * (100 + 5 * roll.randrange(6)) * deg,
        "turns": 2 - 4 * roll.randrange(2),
        "stop": (125 + 5 * roll.randrange(5)) * deg,
    }
    return Numbers({name: values[name] for name in UNITS}, UNITS)


def own_arm(given: Given) -> ClosedFormArm:
    """The SCARA whose joint 2 stops at the student's own angle."""
    limits = SCARA.limits.copy()
    limits[1] = -given["stop"], given["stop"]
    return scara_arm("your SCARA", L0, L1, L2, limits)


def own_circle(given: Given, distance: float, angle: float) -> ScaraPose:
    """One lap, with the centre at `distance`; the tool's angle begins at `angle`."""
    omega = np.linspace(0, 2 * np.pi, SAMPLES)
    x = distance * np.cos(given["bearing"]) + given["radius"] * np.cos(omega)
    y = distance * np.sin(given["bearing"]) + given["radius"] * np.sin(omega)
    place = np.stack([x, y, np.full_like(x, LEVEL)], axis=-1)
    return ScaraPose(place, angle + given["turns"] * omega)


def form(answer: Any, given: Given) -> dict[str, Any]:
    """Hole, distance and angle as floats, the elbow as +1 or -1."""
    names = {"hole": "metres", "distance": "metres", "elbow": "+1 or -1", "angle": "radians"}
    if not isinstance(answer, Mapping):
        told = "hole, distance, elbow and angle"
        raise ValueError(f"Wanted a dict with {told}, got {in_words(answer)}.")
    missing = [key for key in names if key not in answer]
    if missing:
        raise ValueError(f"Your dict has no {' and no '.join(repr(key) for key in missing)}.")
    design: dict[str, Any] = {}
    for key, unit in names.items():
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
    rows = SCARA.ik(targets)[:, SCARA.branch(int(design["elbow"]))]  # limits make no difference
    q1, q2 = np.unwrap(rows[:, 0]), rows[:, 1]
    return np.stack([q1, q2, targets.angle - q1 - q2, rows[:, 3]], axis=-1)


def past(q: Floats, given: Given) -> Floats:
    """The most by which each joint exceeds its limits; negative: inside."""
    low, high = own_arm(given).limits.T
    over: Floats = np.maximum(q - high, low - q).max(axis=0)
    return over


def faults(design: Given, given: Given) -> list[Fault]:
    """What is wrong with the hole, the reach, the limits of joints 1, 2 and 3, and how straight
    the arm is.
    """
    wrong = about_hole(design["hole"], given)
    return [*([wrong] if wrong else []), *circle(design, given)]


def about_hole(hole: float, given: Given) -> Fault | None:
    stop = given["stop"]
    right = distance(stop)
    if abs(hole - right) <= CLOSE:
        return None
    named = (
        (1000 * right, "mm for m", f"The hole is {hole:g} m. {METRES}"),
        (L2 - L1, "the hole of an arm that folds", "50 mm is right if the arm folds completely."),
        (
            distance(np.pi - stop),
            "the stop used as the angle inside the triangle",
            "Joint 2 is measured from the straight arm: at your stop, the angle inside the "
            f"triangle is 180° − {stop / deg:.0f}°.",
        ),
        (
            distance(SCARA.limits[1, 1]),
            "the hole of the lab's arm",
            f"Joint 2 of the lab's arm stops at ±150°, yours at ±{stop / deg:.0f}°.",
        ),
    )
    for value, name, says in named:
        if abs(hole - value) <= CLOSE * value / right:
            return name, says if name == "mm for m" else f"{says} Your hole has another radius."
    says = f"At your stop of ±{stop / deg:.0f}°, the tool is not {hole / mm:.1f} mm from joint 1."
    return "another radius of the hole", says


def circle(design: Given, given: Given) -> list[Fault]:
    """What is wrong with the circle: five conditions."""
    away, angle, count = design["distance"], design["angle"], COUNT - 1
    if abs(away) > 5:
        name = "mm for m" if abs(away) >= 60 else "cm for m"
        return [(name, f"The distance is {away:g} m. {METRES}")] * count
    if abs(angle) > 8 * np.pi:
        return [("degrees for radians", f"Your angle is {angle / deg:.0f}°. {DEGREES}")] * count
    if away < 0:
        says = "A distance cannot be negative: your bearing already gives the direction."
        return [("a negative distance", says)] * count
    targets = own_circle(given, away, angle)
    q = joints(design, given)
    row = SCARA.branch(int(design["elbow"]))
    missing = np.isnan(SCARA.ik(targets)[:, row]).any(axis=-1)
    if missing.any():
        says = f"{missing.mean():.0%} of the circle is out of reach. "
        says += explain(SCARA, targets[int(missing.argmax())], row)
        return [("out of reach", says)] * count
    from_joint_1 = np.linalg.norm(targets.position[:, :2], axis=-1) / mm
    nearest, farthest = from_joint_1.min(), from_joint_1.max()
    found = [joint_1(q, design, given), *joint_2(q, nearest, farthest, given), joint_3(q, given)]
    return [fault for fault in found if fault]


def joint_1(q: Floats, design: Given, given: Given) -> Fault | None:
    over = past(q, given)[0]
    if over <= SLACK:
        return None
    limit = SCARA.limits[0, 1] / deg
    says = f"Joint 1 passes its limit of ±{limit:.0f}° by {apart(over / deg, 0)[0]}°."
    if past(joints({**design, "elbow": -design["elbow"]}, given), given)[0] > SLACK:
        return "past a limit: joint 1", says
    says += " With the other elbow, the arm reaches the same places with other angles of joint 1."
    return "the wrong elbow", says


def joint_2(q: Floats, nearest: float, farthest: float, given: Given) -> list[Fault]:
    found, over, bent = [], past(q, given)[1], abs(q[:, 1]).min()
    if over > SLACK:
        limit, most = given["stop"] / deg, apart(over / deg, 0)[0]
        says = (
            f"Joint 2 passes its limit of ±{limit:.0f}° by {most}°: the circle enters the hole, "
            f"because it comes as close as {nearest:.1f} mm to joint 1."
        )
        found.append(("past a limit: joint 2", says))
    if bent < AWAY - SLACK:
        near, asked = apart(bent / deg, AWAY / deg)
        says = (
            f"Joint 2 comes within {near}° of 0°, where the arm is straight, but at least {asked}° "
            f"is required: the circle goes out to {farthest:.1f} mm."
        )
        found.append(("too close to the straight arm", says))
    return found


def joint_3(q: Floats, given: Given) -> Fault | None:
    over = past(q, given)[2]
    if over <= SLACK:
        return None
    low, high, limit = q[:, 2].min(), q[:, 2].max(), SCARA.limits[2, 1]
    says = (
        f"Joint 3 turns from {low / deg:.1f}° to {high / deg:.1f}°. Its limits are "
        f"±{limit / deg:.0f}°, and it passes them by {apart(over / deg, 0)[0]}°."
    ).translate(MINUS)
    for turns, name in ((1, "A whole turn"), (2, "Two whole turns")):
        moved = (q + [0, 0, 2 * np.pi * k, 0] for k in (-turns, turns))
        if any(past(each, given)[2] <= SLACK for each in moved):
            says += f" If it starts {name.lower()} further on or back, the pose is the same and "
            return f"joint 3 starts {name.lower()} off", f"{says}joint 3 stays inside."
    return "past a limit: joint 3", says
