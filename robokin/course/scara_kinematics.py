"""Lab 04, the SCARA: one triangle, two elbows, and a zone with a hole: its exercises and
predictions.

The answers to each exercise come first, right and wrong, then the predictions' numbers and views;
the tables stand at the end.
"""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np

from .._arrays import Floats
from ..arms import SCARA, ScaraPose, explain, follow, within
from ..units import deg, mm, wrapped
from .exercises import words
from .mistakes import DEGREES, METRES, Mistake, Program, Tools
from .old import Catch, Fault, Function, Value
from .questions import Option, Prediction
from .told import apart, floats, one_number
from .variants import Numbers, dice

LAB = "scara_kinematics"
OBJECTIVES = (
    "build a SCARA's chain, and derive both elbows of its inverse from one triangle",
    "draw the zone that an arm reaches inside its limits, and place a workpiece in it",
    "follow a moving target, and tell which limit it breaks, in the unit of that joint",
)

L0, L1, L2 = 220.2 * mm, 200 * mm, 250 * mm  # source 001, listing 4
LOW, HIGH = SCARA.limits.T
MINUS = str.maketrans("-", "\N{MINUS SIGN}")


def _place(q: Floats) -> Floats:
    """x, y of the tool, in metres: q (..., 4) -> (..., 2)."""
    q1, both = q[..., 0], q[..., 0] + q[..., 1]
    x, y = L1 * np.cos(q1) + L2 * np.cos(both), L1 * np.sin(q1) + L2 * np.sin(both)
    return np.stack([x, y], axis=-1)


def _angle(x: float) -> str:
    return f"{round(x / deg, 1) + 0.0:.1f}°".translate(MINUS)


# --- 1: the other elbow ---------------------------------------------------------------------------


def _inside(q2: float, tools: Tools) -> float:
    """The angle of the triangle at joint 1, from the line to the target to the first lever."""
    return float(tools.atan2(L2 * np.sin(q2), L1 + L2 * np.cos(q2)))


def _other(tools: Tools, q: Floats) -> Floats:
    q1, q2, q3, q4 = q
    inside = _inside(q2, tools)
    return np.array([q1 + 2 * inside, -q2, q3 + 2 * q2 - 2 * inside, q4])


def _other_cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    shown = [
        (0, 90, 0, 0),
        (0, -90, 0, 0),
        (40, 60, -70, 120),
        (40, -60, -70, 120),
        (-30, 0, 20, 50),  # stretched: its own mirror image
        (0, 148, 0, 100),  # the angle inside the triangle is obtuse
        (20, -147, 30, 100),
        (100, 30, 390, 180),  # more than one turn
        (-100, -30, -390, 10),
        (130, 100, 300, 60),
        (-130, -100, -300, 60),
        (90, 143.2, 0, 20),
    ]
    cases = [(np.array([a * deg, b * deg, c * deg, d * mm]),) for a, b, c, d in shown]
    for q in rng.uniform(LOW, HIGH, (12, 4)).round(3):
        cases.append((q,))
    return cases


def _posture(result: Any, case: tuple[Any, ...]) -> Floats:
    wanted = "wanted four numbers [q1, q2, q3, q4] (rad, rad, rad, m)"
    try:
        values = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {words(result)}") from None
    if values.size != 4 or sum(n > 1 for n in values.shape) != 1:
        raise ValueError(f"{wanted}, got {words(result)}")
    return values.ravel()


def _other_law(case: tuple[Any, ...], yours: Floats) -> str | None:
    [q] = case
    there, wanted = _place(yours) / mm, _place(q) / mm
    if not np.linalg.norm(there - wanted) <= 1e-4:
        place, is_at = apart(wanted[:2], there[:2])
        return (
            f"the tool should stay at ({place}) mm; with your joints it stands at ({is_at}) mm"
        ).translate(MINUS)
    if not abs(wrapped(yours[1] + q[1])) <= 1e-6:
        return f"joint 2 should stand at {_angle(-q[1])}, the elbow on the other side"
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


def _same_posture(a: Floats, b: Floats) -> bool:
    """Whole turns of joints 1 and 2 make no difference, the tool's angle as a number does."""
    off = np.array([*wrapped((a - b)[:2]), (a - b)[:3].sum(), (a - b)[3]])
    if np.isnan(off).any():  # what is no number there is none in the other, the rest is as near
        off = np.append(wrapped((a - b)[:3]), (a - b)[3])
        return bool((np.isnan(a) == np.isnan(b)).all() and np.nanmax(abs(off), initial=0) <= 1e-7)
    return bool((abs(off) <= 1e-7).all())


def _with(change: Program) -> Program:
    """A wrong program: (q, angle inside the triangle) -> the joints."""
    return lambda q: np.array(change(*q, _inside(q[1], Tools())), dtype=float)


def _by(inside: Program) -> Program:
    """The right program with another angle inside the triangle."""

    def program(q: Floats) -> Floats:
        i = inside(q[1])
        return np.array([q[0] + 2 * i, -q[1], q[2] + 2 * q[1] - 2 * i, q[3]])

    return program


def _by_atan(q: Floats) -> Floats:
    """Joints 1 to 3 from the direction of the tool less the angle inside, that by a quotient."""
    x, y = _place(q)[:2]
    inside = np.arctan(L2 * np.sin(q[1]) / (L1 + L2 * np.cos(q[1])))
    first = np.arctan2(y, x) + inside
    return np.array([first, -q[1], q[:3].sum() - first + q[1]])


def _distance(q2: float) -> float:
    return float(np.sqrt(L1**2 + L2**2 + 2 * L1 * L2 * np.cos(q2)))


def _corner(q2: float) -> float:
    """The angle inside the triangle by the law of cosines: it has no sign."""
    d = _distance(q2)
    return float(np.arccos(np.clip((L1**2 + d**2 - L2**2) / (2 * L1 * d), -1, 1)))


def _by_rows(q: Floats, row: int | None = None) -> Floats:
    """By SCARA.ik, which wraps."""
    x, y = _place(q)
    rows = SCARA.ik(ScaraPose([x, y, L0 - q[3]], q[:3].sum()))
    return np.array(rows[(1 if q[1] >= 0 else 0) if row is None else row])


PHI = "The tool's angle q1 + q2 + q3 has to stay what it was, so q3 makes up for q1 and q2."
OTHER_MISTAKES = (
    Mistake(
        "joint 1 left as it is",
        "With q2 turned round alone the second lever points elsewhere: the whole triangle is "
        "mirrored, and its first side is the first lever.",
        _with(lambda a, b, c, d, i: (a, -b, c + 2 * b, d)),
    ),
    Mistake(
        "only the sign of joint 2",
        "The mirror image of the triangle moves both levers, and the tool's angle has to stay.",
        _with(lambda a, b, c, d, i: (a, -b, c, d)),
    ),
    Mistake(
        "the angle inside the triangle counted once",
        "One time that angle brings the lever onto the line to the target, so it points there. The "
        "mirror image is as far again on the other side.",
        _with(lambda a, b, c, d, i: (a + i, -b, c + 2 * b - i, d)),
    ),
    Mistake(
        "away from the line, not through it",
        "Joint 1 turns the wrong way: the other elbow is on the other side of the line to the "
        "target.",
        _with(lambda a, b, c, d, i: (a - 2 * i, -b, c + 2 * b + 2 * i, d)),
    ),
    Mistake("joint 3 left as it is", PHI, _with(lambda a, b, c, d, i: (a + 2 * i, -b, c, d))),
    Mistake(
        "joint 3 makes up for joint 1 alone",
        PHI,
        _with(lambda a, b, c, d, i: (a + 2 * i, -b, c - 2 * i, d)),
    ),
    Mistake(
        "joint 3 makes up for joint 2 alone",
        PHI,
        _with(lambda a, b, c, d, i: (a + 2 * i, -b, c + 2 * b, d)),
    ),
    Mistake(
        "joint 3 turned the wrong way",
        "Joint 3 goes with joints 1 and 2 where it should go against them.",
        _with(lambda a, b, c, d, i: (a + 2 * i, -b, c - 2 * b + 2 * i, d)),
    ),
    *(
        Mistake(
            "joint 3 turned the wrong way",
            "Joint 3 has to go against what joints 1 and 2 have done, with both signs turned.",
            _with(change),
        )
        for change in (
            lambda a, b, c, d, i: (a + 2 * i, -b, c + 2 * i, d),
            lambda a, b, c, d, i: (a + 2 * i, -b, c - 2 * b, d),
            lambda a, b, c, d, i: (a + 2 * i, -b, c + 2 * b + 2 * i, d),
            lambda a, b, c, d, i: (a + 2 * i, -b, c - 2 * b - 2 * i, d),
        )
    ),
    Mistake(
        "q3 for the tool's angle",
        "The tool's angle is q1 + q2 + q3 of the given posture, not its q3.",
        _with(lambda a, b, c, d, i: (a + 2 * i, -b, c + b - a - 2 * i, d)),
    ),
    Mistake(
        "q3 left out of the tool's angle",
        "The tool's angle is q1 + q2 + q3, not q1 + q2: that is the direction of the second lever.",
        _with(lambda a, b, c, d, i: (a + 2 * i, -b, 2 * b - 2 * i, d)),
    ),
    Mistake(
        "l2 cos q2 left out of the triangle",
        "Along the first lever the target is l1 + l2 cos q2 away, not l1.",
        _by(lambda b: np.arctan2(L2 * np.sin(b), L1)),
    ),
    Mistake(
        "joint 1 added to the mirror, not taken off",
        "With the direction to the target t the mirror image of q1 is 2 t − q1, not 2 t + q1.",
        _with(lambda a, b, c, d, i: (3 * a + 2 * i, -b, c + 2 * b - 2 * a - 2 * i, d)),
    ),
    Mistake(
        "mirrored in the y axis",
        "The triangle is mirrored in the line from joint 1 to the target, not in the y axis.",
        _with(lambda a, b, c, d, i: (np.pi - a, -b, 2 * a + 2 * b + c - np.pi, d)),
    ),
    Mistake(
        "half a turn of joint 1",
        "Joint 1 turned by 180° brings the tool to the other side of the column.",
        _with(lambda a, b, c, d, i: (a + np.pi, -b, c + 2 * b - np.pi, d)),
    ),
    Mistake(
        "levers taken as equal, and joint 3 left as it is",
        "q1 + q2 is right for two equal levers. Here they are 200 and 250 mm long. And q3 has to "
        "keep the tool's angle.",
        _with(lambda a, b, c, d, i: (a + b, -b, c, d)),
    ),
    Mistake(
        "the sign of joint 3",
        "Joint 3 is turned round, too. It is not mirrored: it makes up for joints 1 and 2.",
        _with(lambda a, b, c, d, i: (a + 2 * i, -b, -c, d)),
    ),
    Mistake(
        "the tool's angle for joint 3",
        "q1 + q2 + q3 stands where q3 belongs.",
        _with(lambda a, b, c, d, i: (a + 2 * i, -b, a + b + c, d)),
    ),
    Mistake(
        "the tool's angle set to zero",
        "q3 = -q1 - q2 gives the tool's angle 0. It should stay what it was: q1 + q2 + q3 of the "
        "given posture.",
        _with(lambda a, b, c, d, i: (a + 2 * i, -b, b - a - 2 * i, d)),
    ),
    Mistake(
        "the tool's angle wrapped",
        "`ik` wraps q3 into −180° to 180°. As a number the tool's angle has to stay the same: "
        "take q3 from q1 + q2 + q3 of the given posture.",
        _by_rows,
    ),
    Mistake(
        "arcsine for atan2",
        "An arcsine never exceeds 90°, and this angle does near joint 1. Use arctan2.",
        _by(lambda b: np.arcsin(np.clip(L2 * np.sin(b) / _distance(b), -1, 1))),
    ),
    Mistake(
        "atan for atan2 in the triangle",
        "Beyond q2 = 143° the tool is behind joint 1, seen along the first lever, and a quotient "
        "cannot tell: half a turn is lost. Use arctan2.",
        lambda q: np.array([*_by_atan(q), q[3]]),
    ),
    Mistake(
        "arccosine without the sign",
        "An arccosine is never negative: from elbow −1 to +1 joint 1 has to turn the other way.",
        _by(_corner),
    ),
    Mistake(
        "the levers exchanged",
        "l1 and l2 are exchanged: the first lever is 200 mm long, the second one 250 mm.",
        _by(lambda b: np.arctan2(L1 * np.sin(b), L2 + L1 * np.cos(b))),
    ),
    Mistake(
        "levers taken as equal",
        "q1 + q2 is right for two equal levers: then the four of them make a rhombus. Here they "
        "are 200 and 250 mm long.",
        _with(lambda a, b, c, d, i: (a + b, -b, c + b, d)),
    ),
    Mistake(
        "sine and cosine exchanged",
        "arctan2 takes the part across first, then the part along.",
        _by(lambda b: np.arctan2(L1 + L2 * np.cos(b), L2 * np.sin(b))),
    ),
    Mistake(
        "the first lever left out of the triangle",
        "Along the first lever the target is l1 + l2 cos q2 away, not l2 cos q2.",
        _by(lambda b: np.arctan2(L2 * np.sin(b), L2 * np.cos(b))),
    ),
    Mistake(
        "always elbow −1",
        "Asked is the other elbow: for a posture with the elbow −1 that is +1.",
        lambda q: _other(Tools(), q) if q[1] > 0 else np.array(q),
    ),
    Mistake(
        "always elbow +1",
        "Asked is the other elbow: for a posture with the elbow +1 that is −1.",
        lambda q: _other(Tools(), q) if q[1] < 0 else np.array(q),
    ),
    *(
        Mistake(
            f"always elbow {flag}, and the tool's angle wrapped",
            "Asked is the elbow that q does not have. And `ik` wraps q3: take it from q1 + q2 + q3 "
            "of the given posture.",
            lambda q, row=row: _by_rows(q, row),
        )
        for row, flag in ((0, "+1"), (1, "−1"))
    ),
    Mistake(
        "mirrored in the x axis",
        "The triangle is mirrored in the line from joint 1 to the target, not in the x axis.",
        _with(lambda a, b, c, d, i: (-a, -b, -c, d)),
    ),
    Mistake(
        "mirrored in the x axis, the tool's angle kept",
        "The triangle is mirrored in the line from joint 1 to the target, not in the x axis.",
        _with(lambda a, b, c, d, i: (-a, -b, c + 2 * a + 2 * b, d)),
    ),
    Mistake(
        "the direction to the target left out",
        "The angle inside the triangle is counted from the line to the target, not from the x "
        "axis: atan2(y, x) is missing.",
        _with(lambda a, b, c, d, i: (i, -b, a + 2 * b + c - i, d)),
    ),
    Mistake(
        "joint 2 left as it is",
        "The other elbow has the other sign of q2.",
        _with(lambda a, b, c, d, i: (a + 2 * i, b, c - 2 * i, d)),
    ),
    Mistake(
        "180° less joint 2",
        "The angle between the directions of the levers changes its sign; 180° − q2 is the corner "
        "of the triangle.",
        _with(lambda a, b, c, d, i: (a + 2 * i, np.pi - b, c + 2 * b - np.pi - 2 * i, d)),
    ),
    Mistake(
        "height for stroke",
        "The last number is the stroke q4, not the height z = l0 − q4.",
        _with(lambda a, b, c, d, i: (a + 2 * i, -b, c + 2 * b - 2 * i, L0 - d)),
    ),
    Mistake(
        "the stroke left out",
        "The stroke stays what it was; yours is 0.",
        _with(lambda a, b, c, d, i: (a + 2 * i, -b, c + 2 * b - 2 * i, 0.0)),
    ),
)


# --- 2: a circle of one's own ---------------------------------------------------------------------

UNITS = {"radius": ("mm", mm), "bearing": ("°", deg), "turns": ("whole turns", 1.0)}
AWAY = 25 * deg  # how far joint 2 has to keep from stretched
LEVEL = 100 * mm
SAMPLES = 361
SLACK = 1e-6


def given(who: Any) -> Numbers:
    """A circle in a direction where joint 1 runs short of room, and two turns of the tool."""
    roll = dice(LAB, who)
    side = 1 - 2 * roll.randrange(2)
    values = {
        "radius": (60 + 5 * roll.randrange(7)) * mm,
        "bearing": side * (100 + 5 * roll.randrange(6)) * deg,
        "turns": 2 - 4 * roll.randrange(2),
    }
    return Numbers(values, UNITS)


def own_circle(given: Mapping[str, Any], distance: float, angle: float) -> ScaraPose:
    """Once around, with the centre at `distance`; the tool's angle begins at `angle`."""
    omega = np.linspace(0, 2 * np.pi, SAMPLES)
    x = distance * np.cos(given["bearing"]) + given["radius"] * np.cos(omega)
    y = distance * np.sin(given["bearing"]) + given["radius"] * np.sin(omega)
    place = np.stack([x, y, np.full_like(x, LEVEL)], axis=-1)
    return ScaraPose(place, angle + given["turns"] * omega)


def circle_form(answer: Any, given: Any) -> dict[str, Any]:
    """Distance and angle as floats, the elbow as +1 or -1."""
    if not isinstance(answer, Mapping):
        raise ValueError(f"Wanted a dict with distance, elbow and angle, got {words(answer)}.")
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
            raise ValueError(f"{key}: wanted {wanted}, got {words(answer[key])}.")
        design[key] = value
    if design["elbow"] not in (1, -1):
        raise ValueError(f"elbow: wanted the flag +1 or -1, got {words(answer['elbow'])}.")
    return design


def _circle_joints(design: Mapping[str, Any], given: Mapping[str, Any]) -> Floats:
    """The joints (samples, 4) on the circle; q3 as a number, from the tool's angle as a number."""
    targets = own_circle(given, design["distance"], design["angle"])
    rows = SCARA.ik(targets)[:, SCARA.branch(int(design["elbow"]))]
    q1, q2 = np.unwrap(rows[:, 0]), rows[:, 1]
    return np.stack([q1, q2, targets.angle - q1 - q2, rows[:, 3]], axis=-1)


def _over(q: Floats) -> Floats:
    """How far each joint is past its limits at the most; negative: inside."""
    over: Floats = np.maximum(q - HIGH, LOW - q).max(axis=0)
    return over


def circle_faults(design: Mapping[str, Any], given: Mapping[str, Any]) -> list[Fault]:
    """In reach; joints 1, 2 and 3 inside; not nearly stretched."""
    distance, angle = design["distance"], design["angle"]
    if abs(distance) > 5:
        name = "mm for m" if abs(distance) >= 60 else "cm for m"
        return [(name, f"The distance is {distance:g} m. {METRES}")] * 5
    if abs(angle) > 8 * np.pi:
        return [("degrees for radians", f"An angle of {angle / deg:.0f}°. {DEGREES}")] * 5
    if distance < 0:
        says = "A distance is not negative: the direction is given, it is your bearing."
        return [("a negative distance", says)] * 5
    targets = own_circle(given, distance, angle)
    q = _circle_joints(design, given)
    missing = np.isnan(q).any(axis=-1)
    if missing.any():
        i = int(missing.argmax())
        row = SCARA.branch(int(design["elbow"]))
        says = f"{missing.mean():.0%} of the circle is out of reach. "
        return [("out of reach", says + explain(SCARA, targets[i], row))] * 5
    found: list[Fault] = []
    over = _over(q)
    if over[0] > SLACK:
        says = f"Joint 1 passes its limit of ±{HIGH[0] / deg:.0f}° by "
        says += f"{apart(over[0] / deg, 0)[0]}°."
        name = "past a limit: joint 1"
        if _over(_circle_joints({**design, "elbow": -design["elbow"]}, given))[0] <= SLACK:
            name = "the wrong elbow"
            says += " The other elbow reaches the same places with another angle of joint 1."
        found.append((name, says))
    d = np.linalg.norm(targets.position[:, :2], axis=-1)
    if over[1] > SLACK:
        says = (
            f"Joint 2 passes its limit of ±{HIGH[1] / deg:.0f}° by {apart(over[1] / deg, 0)[0]}°: "
            f"the circle comes as near as {d.min() / mm:.1f} mm to joint 1, into the hole."
        )
        found.append(("past a limit: joint 2", says))
    if abs(q[:, 1]).min() < AWAY - SLACK:
        near, asked = apart(abs(q[:, 1]).min() / deg, AWAY / deg)
        says = (
            f"Joint 2 comes as near as {near}° to the stretched arm, and {asked}° are asked for: "
            f"the circle goes out to {d.max() / mm:.1f} mm."
        )
        found.append(("too near to the stretched arm", says))
    if over[2] > SLACK:
        low, high = q[:, 2].min(), q[:, 2].max()
        says = (
            f"Joint 3 runs from {low / deg:.1f}° to {high / deg:.1f}°; its limits are "
            f"±{HIGH[2] / deg:.0f}°, and it passes them by {apart(over[2] / deg, 0)[0]}°."
        ).translate(MINUS)
        name = "past a limit: joint 3"
        if any(_over(q + [0, 0, 2 * np.pi * k, 0])[2] <= SLACK for k in (-2, -1, 1, 2)):
            name = "joint 3 begins a whole turn off"
            says += " A whole turn more or less at the start is the same pose, and fits."
        found.append((name, says))
    return found


# --- 3: a test for limits -------------------------------------------------------------------------


def _all_inside(q: Any, limits: Any) -> bool:
    q, (low, high) = np.asarray(q, dtype=float), np.transpose(limits)
    return bool(((q >= low) & (q <= high)).all())


def _one_by_one(q: Any, limits: Any) -> bool:
    for sample in np.asarray(q, dtype=float):
        for value, (low, high) in zip(sample, limits, strict=True):
            if not low <= value <= high:
                return False
    return True


def _by_extremes(q: Any, limits: Any) -> bool:
    q, (low, high) = np.asarray(q, dtype=float), np.transpose(limits)
    return bool((q.min(axis=0) >= low - 1e-9).all() and (q.max(axis=0) <= high + 1e-9).all())


RIGHT_LIMITS: tuple[tuple[str, Program], ...] = (
    ("all values compared at once", _all_inside),
    ("two loops, sample by sample and joint by joint", _one_by_one),
    ("smallest and greatest value of each joint, with 1e-9 to spare", _by_extremes),
    (
        "clipped to the limits and compared, the answer a NumPy bool",
        lambda q, limits: (np.clip(q, *np.transpose(limits)) == q).all(),
    ),
)


def _compared(change: Program) -> Program:
    """A wrong test: (q (samples, joints), low, high) -> bool."""

    def program(q: Any, limits: Any) -> bool:
        low, high = np.transpose(np.asarray(limits, dtype=float))
        return bool(change(np.asarray(q, dtype=float), low, high))

    return program


def _both(q: Floats, low: Floats, high: Floats) -> Any:
    return (q >= low) & (q <= high)


LIMIT_MISTAKES = (
    Mistake(
        "the last joint is never looked at",
        "Its loop runs over range(n - 1), so it stops before the last joint, here the stroke.",
        _compared(lambda q, low, high: _both(q, low, high)[:, :-1].all()),
    ),
    Mistake(
        "the first joint is never looked at",
        "Its loop counts joints from 1 where Python counts from 0.",
        _compared(lambda q, low, high: _both(q, low, high)[:, 1:].all()),
    ),
    Mistake(
        "upper limits only",
        "It never looks at the lower limits.",
        _compared(lambda q, low, high: (q <= high).all()),
    ),
    Mistake(
        "lower limits only",
        "It never looks at the upper limits.",
        _compared(lambda q, low, high: (q >= low).all()),
    ),
    Mistake(
        "limits taken as symmetric",
        "It compares abs(q) with the upper limit. The stroke goes from 0 to 180 mm, not from −180.",
        _compared(lambda q, low, high: (abs(q) <= high).all()),
    ),
    Mistake(
        "wrapped before it is compared",
        "It wraps angles into −180° to 180° first: so no motion ever passes 400°.",
        _compared(lambda q, low, high: _both(wrapped(q), low, high).all()),
    ),
    Mistake(
        "one joint inside is enough",
        "It says True if in every sample any joint is inside.",
        _compared(lambda q, low, high: _both(q, low, high).any(axis=1).all()),
    ),
    Mistake(
        "one sample inside is enough",
        "It says True if the motion is inside at any time.",
        _compared(lambda q, low, high: _both(q, low, high).all(axis=1).any()),
    ),
    Mistake(
        "start and end only",
        "It looks at the first and the last sample, not at the way between them.",
        _compared(lambda q, low, high: _both(q[[0, -1]], low, high).all()),
    ),
    Mistake(
        "every tenth sample",
        "It looks at one sample in ten: a short excursion slips through.",
        _compared(lambda q, low, high: _both(q[::10], low, high).all()),
    ),
    Mistake(
        "a NaN counts as inside",
        "It asks whether any value is outside. A NaN is neither below nor above.",
        _compared(lambda q, low, high: not ((q < low) | (q > high)).any()),
    ),
    Mistake(
        "the limit itself counts as outside",
        "It compares with < where <= belongs: a stroke of 0 is allowed.",
        _compared(lambda q, low, high: ((q > low) & (q < high)).all()),
    ),
    Mistake(
        "every limit through deg2rad",
        "It takes all limits for degrees, so that 180 mm become 3.1 and ±2.4 rad become ±0.04.",
        _compared(lambda q, low, high: _both(q, np.deg2rad(low), np.deg2rad(high)).all()),
    ),
    Mistake(
        "a degree of slack for every joint",
        "It allows 0.0175 more everywhere: for the stroke that is 17 mm.",
        _compared(lambda q, low, high: _both(q, low - deg, high + deg).all()),
    ),
    Mistake(
        "a slack of a thousandth for every joint",
        "It allows 0.001 more everywhere. Up to 1e-9 beyond may pass, no more: put a value a "
        "millionth past a limit.",
        _compared(lambda q, low, high: _both(q, low - 1e-3, high + 1e-3).all()),
    ),
    Mistake(
        "np.isclose with its own tolerances",
        "It lets pass what np.isclose takes for a limit: 1e-5 of the number and 1e-8, so 7.00007 "
        "rad for 7. Up to 1e-9 beyond may pass: put a value a millionth past a large limit.",
        _compared(
            lambda q, low, high: (
                _both(q, low, high) | np.isclose(q, low) | np.isclose(q, high)
            ).all()
        ),
    ),
    Mistake(
        "only the first four joints",
        "It never looks at a fifth or sixth joint. The limits may be those of any arm: try six "
        "joints.",
        _compared(lambda q, low, high: _both(q, low, high)[:, :4].all()),
    ),
    Mistake(
        "this SCARA's limits, whatever it is given",
        "It never reads its second input.",
        lambda q, limits: _all_inside(np.atleast_2d(q)[:, :4], SCARA.limits[: np.shape(q)[-1]]),
    ),
    Mistake(
        "the mean of the motion",
        "It looks at the mean of each joint.",
        _compared(lambda q, low, high: _both(q.mean(axis=0), low, high).all()),
    ),
)


# --- Predictions: the numbers behind them, and what opens after the choice ------------------------


def _whole(x: float) -> str:
    """An angle as people read it, a whole number of degrees."""
    return f"{round(x / deg) + 0:d}°".translate(MINUS)


def _turned_facts() -> dict[str, Any]:
    before = np.array([40, 60, -70, 120]) * [deg, deg, deg, mm]
    after = before + [30 * deg, 30 * deg, 0, 0]
    angle = [SCARA.fk(q).rotation.as_angle_axis()[0] for q in (before, after)]
    change = float(angle[1] - angle[0])
    return {"by": 30, "change": round(change / deg), "answer": f"−{change / deg:.0f}°"}


def _turned_right(facts: Mapping[str, Any]) -> int:
    return [0, -facts["by"], -facts["change"], facts["change"]].index(-facts["change"])


def _turned_view() -> str:
    lines = ["The tool's angle, by the product of the frames:"]
    for q1, q2, q3 in ((40, 60, -70), (70, 90, -70), (70, 90, -130)):
        angle, axis = SCARA.fk([q1 * deg, q2 * deg, q3 * deg, 0.12]).rotation.as_angle_axis()
        line = f"joints 1 to 3 at {q1}°, {q2}°, {q3}°: {float(angle) * axis[2] / deg:.0f}°"
        lines.append(line)
    return "\n".join(lines).translate(MINUS)


ASKED = 540 * deg


def _lerp_facts() -> dict[str, Any]:
    start, goal = ScaraPose([0.3, 0, 0.1], 0.0), ScaraPose([0.3, 0, 0.1], ASKED)
    poses = start.as_transform(), goal.as_transform()
    apart, _ = (poses[0].rotation.inverse() @ poses[1].rotation).as_angle_axis()
    half = start.lerp(goal, 0.5).angle
    return {"asked": ASKED / deg, "short": float(apart) / deg, "half": float(half) / deg}


def _lerp_right(facts: Mapping[str, Any]) -> int:
    guesses = [(540.0, 540.0), (540.0, 180.0), (180.0, 180.0), (180.0, 540.0)]
    return guesses.index((round(2 * facts["half"]), round(facts["short"])))


def _lerp_view() -> str:
    start, goal = ScaraPose([0.3, 0, 0.1], 0.0), ScaraPose([0.3, 0, 0.1], ASKED)
    lines = ["The tool's angle on the way, s from 0 to 1:"]
    for s in (0.25, 0.5, 0.75, 1.0):
        q = start.as_transform().rotation.slerp(goal.as_transform().rotation, s)
        angle, _ = q.as_angle_axis()
        target = start.lerp(goal, s)
        lines.append(
            f"s = {s:.2f}: ScaraPose.lerp {float(target.angle) / deg:.0f}°, "
            f"slerp has turned by {float(angle) / deg:.0f}°"
        )
    return "\n".join(lines)


MIRRORED = np.array([200, 200]) * mm


@cache
def _mirror_facts() -> dict[str, Any]:
    plus, minus = SCARA.ik(ScaraPose([*MIRRORED, 100 * mm]))
    towards = float(np.arctan2(MIRRORED[1], MIRRORED[0]))
    return {
        "q1": _angle(plus[0]),
        "q2": _angle(plus[1]),
        "turned": _angle(-plus[1]),
        "right": _angle(minus[0]),
        "negative": _angle(-plus[0]),
        "towards": _angle(towards),
        "inside": _angle(towards - plus[0]),
        "sum": _angle(plus[0] + plus[1]),
        "miss": f"{_missed([plus[0], -plus[1]]):.0f}",
        "miss_x": f"{_missed([-plus[0], -plus[1]]):.0f}",
        "miss_sum": f"{_missed([plus[0] + plus[1], -plus[1]]):.0f}",
    }


def _missed(q: Any) -> float:
    return float(np.linalg.norm(_place(np.array(q)) - MIRRORED)) / mm


def _mirror_right(facts: Mapping[str, Any]) -> int:
    guesses = [facts[name] for name in ("q1", "negative", "right", "sum")]
    return guesses.index(facts["right"])


def _mirror_view() -> Any:
    from ..show import Sketch

    fig = Sketch(
        "From above: the two elbows of one target are mirror images in the line from joint 1 to "
        "the target. The first levers stand at the same angle on either side of that line.",
        title="Mirror images in the line to the target",
    )
    target = MIRRORED
    rows = SCARA.ik(ScaraPose([*target, 100 * mm]))
    for row, dashed in zip(rows, (False, True), strict=True):
        corner = L1 * np.array([np.cos(row[0]), np.sin(row[0])])
        fig.levers(np.array([np.zeros(2), corner, target]), dashed=dashed)
    fig.length([0, 0], target, "d")
    towards = np.pi / 4
    fig.angle([0, 0], towards, rows[0, 0], _angle(towards - rows[0, 0]), radius=80 * mm)
    fig.angle([0, 0], towards, rows[1, 0], _angle(rows[1, 0] - towards), radius=80 * mm)
    return fig


def _sine_angles(d: float) -> tuple[float, float, float]:
    """q2, the angle inside the triangle at joint 1, and what the law of sines makes of it."""
    q2 = float(np.arccos((d**2 - L1**2 - L2**2) / (2 * L1 * L2)))
    sine = float(np.arcsin(np.clip(L2 * np.sin(q2) / d, -1, 1)))
    return q2, _corner(q2), sine


@cache
def _sine_facts() -> dict[str, Any]:
    _, corner, sine = _sine_angles(130 * mm)
    return {
        "near": 2 * 130 * abs(np.sin((corner - sine) / 2)),
        "corner": _angle(corner),
        "sine": _angle(sine),
        "border": float(np.sqrt(L2**2 - L1**2)) / mm,
    }


def _sine_right(facts: Mapping[str, Any]) -> int:
    if not np.isfinite(facts["near"]):
        return 2
    return int(round(facts["near"]) == 28)


def _sine_view() -> Any:
    from ..show import Sketch

    d = 130 * mm
    q2, corner, sine = _sine_angles(d)
    fig = Sketch(
        "A target 130 mm from joint 1: with the right angle the second lever ends at the target, "
        "with the one of the arcsine it ends beside it.",
        title="The arcsine's arm (dashed) ends beside the target",
    )
    for inside, dashed in ((corner, False), (sine, True)):
        joint_2 = L1 * np.array([np.cos(-inside), np.sin(-inside)])
        end = joint_2 + L2 * np.array([np.cos(q2 - inside), np.sin(q2 - inside)])
        fig.levers(np.array([np.zeros(2), joint_2, end]), dashed=dashed)
    fig.point([d, 0], "target", away=(1, 0))
    fig.ax.set(xlim=(-220, 260))
    return fig


BEHIND = ScaraPose([-320 * mm, 140 * mm, 120 * mm], 0.0)


@cache
def _behind_facts() -> dict[str, Any]:
    plus, minus = SCARA.ik(BEHIND)
    towards = float(np.arctan2(BEHIND.position[1], BEHIND.position[0]))
    return {
        "towards": _angle(towards),
        "plus": _angle(plus[0]),
        "minus": _angle(minus[0]),
        "limit": _whole(HIGH[0]),
        "fits": np.all(within(SCARA, SCARA.ik(BEHIND)), axis=-1).tolist(),
    }


def _behind_right(facts: Mapping[str, Any]) -> int:
    return [[True, True], [True, False], [False, True], [False, False]].index(facts["fits"])


def _behind_view() -> Any:
    from ..show import Sketch

    fig = Sketch(
        "From above: a place behind the arm and both elbows. The first lever of elbow +1 stands "
        "inside the stops of joint 1, that of elbow −1 (dashed) in the shaded sector beyond them.",
        title="The shaded sector is closed to the first lever",
    )
    closed = np.linspace(HIGH[0], 2 * np.pi - HIGH[0], 40)
    x, y = 230 * np.cos(closed), 230 * np.sin(closed)
    fig.ax.fill([0, *x], [0, *y], color="0.85", zorder=0)
    target = BEHIND.position[:2]
    for q, dashed in zip(SCARA.ik(BEHIND), (False, True), strict=True):
        joint_2 = L1 * np.array([np.cos(q[0]), np.sin(q[0])])
        fig.levers(np.array([np.zeros(2), joint_2, target]), dashed=dashed)
        fig.point(joint_2, "elbow −1" if dashed else "elbow +1", away=joint_2)
    fig.point(target, "target", away=(-1, 0))
    fig.ax.set(xlim=(-420, 120))
    return fig


STOP = 120 * deg


@cache
def _hole_facts() -> dict[str, Any]:
    return {
        "stop": STOP / deg,
        "hole": _distance(STOP) / mm,
        "folded": (L2 - L1) / mm,
        "wrong": _distance(np.pi - STOP) / mm,
        "square": _distance(np.pi / 2) / mm,
        "bent": _distance(100 * deg) / mm,
        "reach": (L1 + L2) / mm,
        "zero": 0.0,
    }


def _hole_right(facts: Mapping[str, Any]) -> int:
    bends = np.linspace(-STOP, STOP, 2401)
    near = np.linalg.norm(_place(np.stack([0 * bends, bends], axis=-1)), axis=-1).min() / mm
    names = ("hole", "folded", "wrong", "square", "reach", "zero")
    return int(np.argmin([abs(facts[name] - near) for name in names]))


def _hole_view() -> str:
    lines = ["Distance of the tool from joint 1:"]
    for q2 in (0, 90, 120, 150, 180):
        lines.append(f"q2 = {q2}°: {_distance(q2 * deg) / mm:.1f} mm")
    return "\n".join(lines)


def _areas(a: float, most: float) -> tuple[float, float]:
    """What elbow +1 alone and both elbows reach, cm², with the stops of joints 1 and 2."""
    one = 2 * a * L1 * L2 * (1 - np.cos(most))
    b = np.pi - a
    notch = L1 * np.cos(b) + np.sqrt(L2**2 - (L1 * np.sin(b)) ** 2)
    beta = np.arccos((notch**2 - L1**2 - L2**2) / (2 * L1 * L2))
    both = a * (L1 + L2) ** 2 + L2**2 * beta + L1 * notch * np.sin(b) - np.pi * _distance(most) ** 2
    return one * 1e4, both * 1e4


@cache
def _area_facts() -> dict[str, Any]:
    a, most, more = float(HIGH[0]), float(HIGH[1]), 10 * deg
    now, first, second = _areas(a, most), _areas(a + more, most), _areas(a, most + more)
    full = _areas(np.pi, most)
    return {
        "one_1": 100 * (first[0] / now[0] - 1),
        "one_2": 100 * (second[0] / now[0] - 1),
        "both_1": 100 * (first[1] / now[1] - 1),
        "both_2": 100 * (second[1] / now[1] - 1),
        "rest": 100 * (full[1] - first[1]) / now[1],
    }


def _area_right(facts: Mapping[str, Any]) -> int:
    first, second = facts["both_1"], facts["both_2"]
    if max(first, second) < 0.1:
        return 3
    return 2 if abs(first - second) < 0.1 else int(second > first)


def _area_view() -> str:
    lines = ["Area that the tool reaches, elbow +1 alone and both elbows together:"]
    for a, most in ((140, 150), (150, 150), (140, 160)):
        one, both = _areas(a * deg, most * deg)
        lines.append(f"stops ±{a}° and ±{most}°: {one:.0f} cm² and {both:.0f} cm²")
    return "\n".join(lines)


@cache
def _lap(elbow: int, turns: int = 1) -> Floats:
    """Joint 3 along a circle of 70 mm about (200, 0) mm, with so many turns of the tool."""
    omega = np.linspace(0, 2 * np.pi, 361)
    x, y = 200 + 70 * np.cos(omega), 70 * np.sin(omega)
    targets = ScaraPose(np.stack([x, y, np.full_like(x, 100)], axis=-1) * mm, turns * omega)
    return follow(SCARA, SCARA.ik(targets), SCARA.branch(elbow))[:, 2]


@cache
def _lap_facts() -> dict[str, Any]:
    tracks = {"plus": _lap(+1), "minus": _lap(-1)}
    facts: dict[str, Any] = {"limit": _whole(HIGH[2])}
    for name, q3 in tracks.items():
        facts[name] = _angle(q3[0])
        facts[f"{name}_end"] = _angle(q3[-1])
        facts[f"{name}_fits"] = bool(abs(q3).max() <= HIGH[2])
    facts["back"] = _angle(_lap(-1, -1)[-1])
    facts["three"] = _angle(_lap(+1, 3)[-1])
    return facts


def _lap_right(facts: Mapping[str, Any]) -> int:
    fits = facts["plus_fits"], facts["minus_fits"]
    return [(True, True), (False, False), (True, False), (False, True)].index(fits)


def _lap_view() -> Any:
    from ..show import figure

    fig = figure(
        "Joint 3 along the circle for both elbows: two parallel curves; that of elbow −1 begins "
        "higher and ends beyond 400°.",
        height=3.4,
    )
    ax = fig.subplots()
    degrees = np.linspace(0, 360, 361)
    for elbow, line in ((+1, "-"), (-1, "--")):
        name = f"elbow {elbow:+d}".translate(MINUS)
        ax.plot(degrees, _lap(elbow) / deg, line, color="#009E73", lw=2, label=name)
    ax.axhspan(HIGH[2] / deg, 450, color="0.85")
    ax.text(8, 425, "past the limit", va="center")
    ax.set(
        xlabel="way around the circle, °",
        ylabel="joint 3, °",
        ylim=(-80, 450),
        title="One turn of the tool, two elbows",
    )
    ax.legend(loc="lower right")
    fig.tight_layout()
    return fig


def _bend(r: float) -> float:
    """q2 of the elbow +1 at the distance r, in mm."""
    return float(SCARA.ik(ScaraPose([r * mm, 0, 100 * mm]))[0, 1]) / deg


@cache
def _last_facts() -> dict[str, Any]:
    return {
        "last": _bend(440) - _bend(450),
        "middle": _bend(300) - _bend(310),
        "before": _bend(430) - _bend(440),
        "one": _bend(449),
    }


def _last_right(facts: Mapping[str, Any]) -> int:
    guesses = [facts["middle"], facts["last"], 90.0, 0.0]
    return int(np.argmin([abs(guess - facts["last"]) for guess in guesses]))


def _last_view() -> str:
    lines = ["Joint 2, elbow +1:"]
    for start in (300, 400, 420, 430, 440):
        change = _bend(start) - _bend(start + 10)
        lines.append(f"from {start} to {start + 10} mm: {change:.1f}°")
    return "\n".join(lines)


# --- The tables -----------------------------------------------------------------------------------

EXERCISES = {
    "1": Function(
        title="The other elbow",
        task="The posture with the other elbow: same place, same angle of the tool as a number, "
        "same stroke.",
        objective=1,
        hints=(
            "The two elbows are mirror images in the line from joint 1 to the target. Which of the "
            "four joints change, and which of them by how much?",
            "q2 changes its sign. The first lever stands at the angle "
            "i = arctan2(l2 sin q2, l1 + l2 cos q2) before the line to the target; afterwards it "
            "stands as far behind it. Then let q3 keep q1 + q2 + q3.",
            "i = np.arctan2(L2 * np.sin(q2), L1 + L2 * np.cos(q2)); the new joints are "
            "[q1 + 2 * i, -q2, q3 + 2 * q2 - 2 * i, q4].",
        ),
        inputs=("q",),
        right=_other,
        cases=_other_cases,
        form=_posture,
        law=_other_law,
        same=_same_posture,
        mistakes=OTHER_MISTAKES,
    ),
    "2": Value(
        title="A circle of your own",
        task="Distance, elbow and first angle of the tool for a circle of your own",
        objective=2,
        hints=(
            "Three separate questions. The distance: hole on one side, the stretched arm on the "
            "other. The elbow: on which side of the direction does joint 1 have room? The angle: "
            "where must joint 3 begin to have room for two turns?",
            "The nearest point of the circle is distance − radius from joint 1, the farthest one "
            "distance + radius. At q2 = 25° the tool is at "
            "sqrt(l1² + l2² + 2 l1 l2 cos 25°), about 440 mm. Joint 1 is atan2(y, x) less the "
            "elbow's angle inside the triangle. For the last: 800° are there, 720° are needed.",
            "Take distance = 0.29 and the elbow whose sign is that of the bearing. Compute q3 for "
            "the angle 0: q3 = angle − q1 − q2 along the circle, with q1 and q2 of ik. Its "
            "smallest and greatest value have a middle: angle = −middle puts it at 0.",
        ),
        form=circle_form,
        faults=circle_faults,
        count=5,
        given=given,
    ),
    "3": Catch(
        title="A test for limits",
        task="A test: whether the program inside(q, limits) tells motions inside their limits.",
        objective=3,
        hints=(
            "Take one motion that is inside and one value of it that is not, then move that value: "
            "to another joint, to the other side, to another sample. Which wrong program does each "
            "of these catch?",
            "Make a good motion of 25 samples and limits of unlike size, one of them from 0. Then "
            "spoil one number at a time: each joint above, each joint below, in the middle and at "
            "an odd place. Add values that equal a limit (True), a NaN (False), one angle of 7.5 "
            "rad where 7 is the limit (False), and limits other than the SCARA's, also of six "
            "joints.",
            "good = np.tile([0.1, -0.2, 0.3, 0.05], (25, 1)); for joint in range(4): "
            "for value in (high[joint] + 1e-6, low[joint] - 1e-6, np.nan): bad = good.copy(); "
            "bad[7, joint] = value; inside(bad, limits) has to be False. With bad[7, joint] = "
            "high[joint] or low[joint] it has to be True. Do it for a table of six joints, too.",
        ),
        rights=RIGHT_LIMITS,
        promise="A right program says True if every value of every sample is at least its lower "
        "and at most its upper limit; up to 1e-9 beyond may pass.",
        mistakes=LIMIT_MISTAKES,
    ),
}

# Objective 1: p1, p3, p4. Objective 2: p5, p6, p7. Objective 3: p2, p8, p9.
PREDICTIONS = {
    "p1": Prediction(
        question="Joints 1 and 2 both turn on by +{by}°. The tool shall keep its direction as seen "
        "from above. How does joint 3 turn?",
        options=(
            Option(
                "Not at all: its axis is vertical, and stays so.",
                "The axis keeps its direction, the tool does not: joint 3 sits on the second "
                "lever and is carried round by both joints, {change}° in all.",
                "a kept axis taken for a kept tool",
                "A cup in your hand: turn your whole body, and its handle points elsewhere.",
            ),
            Option(
                "By −{by}°: it makes up for joint 2, on whose lever it sits.",
                "Joint 2 sits on the first lever, and that one has turned, too: {change}° in all.",
                "only the joint before counts",
                "With joint 2 at rest and joint 1 turning, the tool turns as well.",
            ),
            Option(
                "By {answer}.",
                "Angles about parallel axes add up: the tool has turned by {change}°, and joint 3 "
                "takes that back.",
            ),
            Option(
                "By +{change}°: it has to go along with both.",
                "Then the tool would turn by twice {change}°. Joint 3 has to go against them.",
                "the sign of making up",
                "A steward on a turning carousel who keeps facing north turns against it.",
            ),
        ),
        facts=_turned_facts,
        right=_turned_right,
        view=_turned_view,
    ),
    "p2": Prediction(
        question="A tool shall go from 0° to {asked:.0f}° about the vertical. Once we interpolate "
        "between two ScaraPoses, by lerp; once we turn both into Transforms first and use slerp. "
        "How far does the tool turn?",
        options=(
            Option(
                "{asked:.0f}° both times: start and goal are the same.",
                "They are not: as rotations the goal is {short:.0f}° away from the start, for "
                "{asked:.0f}° is one whole turn more. The Transform has forgotten that turn.",
                "a rotation taken for a number of degrees",
                "0° and 720° give one and the same Transform: slerp between them does not move.",
            ),
            Option(
                "{asked:.0f}° with lerp, {short:.0f}° with slerp.",
                "A ScaraPose keeps its angle as a number: lerp passes {half:.0f}° half-way. A "
                "Transform keeps a rotation, and there the goal is half a turn away.",
            ),
            Option(
                "{short:.0f}° both times: a tool turned by {asked:.0f}° points where one turned by "
                "{short:.0f}° does.",
                "It points there, but a ScaraPose does not ask where the tool points. It carries "
                "the number {asked:.0f}°, and half-way it is {half:.0f}°.",
                "a number of degrees taken for a rotation",
                "A screw turned by 540° sits deeper than one turned by 180°.",
            ),
            Option(
                "{short:.0f}° with lerp, {asked:.0f}° with slerp.",
                "The other way round: the number is in the ScaraPose, the rotation in the "
                "Transform.",
                "lerp and slerp exchanged",
                "slerp never turns by more than 180°: it takes the short way.",
            ),
        ),
        facts=_lerp_facts,
        right=_lerp_right,
        view=_lerp_view,
    ),
    "p3": Prediction(
        question="The place (200, 200) mm lies in the direction {towards}. One solution has "
        "q1 = {q1} and q2 = {q2}. The other one has the elbow on the other side, q2 = {turned}. "
        "What is its q1?",
        options=(
            Option(
                "{q1}: only the elbow changes sides.",
                "Then the first lever stays, and the second one misses the place by {miss} mm.",
                "one lever mirrored instead of the triangle",
                "Fold your forearm to the other side without moving your upper arm: the hand is "
                "somewhere else.",
            ),
            Option(
                "{negative}: every angle changes its sign.",
                "That mirrors the arm in the x axis, and the tool comes to (200, −200), "
                "{miss_x} mm away.",
                "the x axis taken for the mirror",
                "For a place on the x axis it would be right: there the line to the place is the "
                "x axis.",
            ),
            Option(
                "{right}.",
                "The triangle is mirrored in the line to the place. Its first side stood {inside} "
                "before {towards}, now it stands as much behind it.",
            ),
            Option(
                "{sum}: the levers change roles, as in a parallelogram.",
                "That holds for equal levers. With 200 and 250 mm the tool misses by {miss_sum} "
                "mm.",
                "levers taken as equal",
                "With levers of 200 and 50 mm the first one turns by 29° at most.",
            ),
        ),
        facts=_mirror_facts,
        right=_mirror_right,
        view=_mirror_view,
    ),
    "p4": Prediction(
        question="Somebody takes the angle of the triangle at joint 1 from the law of sines, "
        "arcsin(l2 sin q2 / d). At d = 300, 200 and 160 mm the table below finds it right. And at "
        "d = 130 mm, inside all limits?",
        options=(
            Option(
                "Right, too: the law of sines holds in every triangle.",
                "The law holds, but an angle is not known from its sine: here it is {corner}, and "
                "the arcsine says {sine}. The tool ends {near:.0f} mm beside the target.",
                "the sine taken for the angle",
                "sin 80° and sin 100° are the same number.",
            ),
            Option(
                "Wrong, and nothing says so: the tool ends about 28 mm beside the target.",
                "The angle is {corner}, more than a right one, and an arcsine never exceeds 90°: "
                "it says {sine}, and the tool misses by {near:.1f} mm. This begins where l2 is the "
                "longest side of a triangle with an obtuse angle, d² < l2² − l1², below "
                "{border:.0f} mm.",
            ),
            Option(
                "An error, or NaN: no angle has such a sine.",
                "NaN comes where l2 sin q2 / d is above 1, and in a triangle it never is. The "
                "arcsine always answers; here it says {sine} for {corner}.",
                "an error expected where there is none",
                "arcsin(sin 100°) is 80°: a number like any other.",
            ),
            Option(
                "Right, but with the other elbow.",
                "The other elbow has the angle on the other side of the line to the target, "
                "−{corner}. The arcsine gives {sine}, which is neither: {near:.0f} mm beside.",
                "180° less an angle taken for its negative",
                "For an angle of 60° the arcsine gives 60°, not −60°.",
            ),
        ),
        facts=_sine_facts,
        right=_sine_right,
        view=_sine_view,
    ),
    "p5": Prediction(
        question="The place (−320, 140) mm lies behind the arm, in the direction {towards}. Joint "
        "1 stops at ±{limit}, joint 2 at ±150°. Which elbow reaches it?",
        options=(
            Option(
                "Both: the two are mirror images, what one can the other can.",
                "They are mirror images in the line to the target, and the limits are not: one "
                "needs q1 = {plus}, the other {minus}.",
                "limits taken for symmetric about the target",
                "Scratch your left shoulder blade with either hand.",
            ),
            Option(
                "Elbow +1 alone, which bends to the left.",
                "It comes round with q1 = {plus}. The other one needs q1 = {minus}, past the stop.",
            ),
            Option(
                "Elbow −1 alone, which bends to the right.",
                "It needs q1 = {minus}, past the stop. Elbow +1 has its first lever before the "
                "target's direction: q1 = {plus}.",
                "the sides of the elbow exchanged",
                "At q2 = +90° the second lever points to the left of the first one.",
            ),
            Option(
                "Neither: {towards} is more than {limit}.",
                "The first lever does not point at the target, except when the arm is stretched. "
                "Bent to the left, it stands at {plus}.",
                "the direction of the target taken for q1",
                "Behind your back your upper arm does not point at your hand, either.",
            ),
        ),
        facts=_behind_facts,
        right=_behind_right,
        view=_behind_view,
    ),
    "p6": Prediction(
        question="The levers are 200 and 250 mm long. Suppose joint 2 stopped at ±{stop:.0f}°. How "
        "near to the axis of joint 1 could the tool come, in mm?",
        options=(
            Option(
                "{hole:.1f}",
                "At q2 = {stop:.0f}° the law of cosines gives {hole:.1f} mm. The folded arm would "
                "come to {folded:.0f} mm.",
            ),
            Option(
                "{folded:.0f}",
                "That is the folded arm, q2 = 180°. Joint 2 stops at {stop:.0f}°: {hole:.1f} mm.",
                "the limit forgotten",
                "A door that opens to 120° does not lie against the wall.",
            ),
            Option(
                "{wrong:.1f}",
                "You have taken {stop:.0f}° for the angle inside the triangle. q2 is counted from "
                "the stretched arm, so the triangle has 60° there.",
                "q2 taken for the angle inside the triangle",
                "At q2 = 0 the arm is stretched: 450 mm, not 50 mm.",
            ),
            Option(
                "{square:.1f}",
                "That is the distance at q2 = 90°. The arm bends farther, and comes nearer.",
                "a right angle taken for the most bent arm",
                "At q2 = 100° it is {bent:.1f} mm already.",
            ),
            Option(
                "{reach:.0f}",
                "That is the farthest place, with the arm stretched. The nearest is asked.",
                "outer for inner border",
                "At q2 = 90° the tool is {square:.1f} mm away.",
            ),
            Option(
                "{zero:.0f}",
                "Unlike levers never close: even folded, at q2 = 180°, {folded:.0f} mm are left.",
                "the tool taken to reach the axis",
                "A ladder of 250 mm folded onto one of 200 mm sticks out by 50 mm.",
            ),
        ),
        facts=_hole_facts,
        right=_hole_right,
        view=_hole_view,
        unit="mm",
        within=0.03,
    ),
    "p7": Prediction(
        question="You may move one stop by 10°: that of joint 1 from ±140° to ±150°, or that of "
        "joint 2 from ±150° to ±160°. Which gains more area for the arm with both its elbows?",
        options=(
            Option(
                "Joint 1: it swings the whole arm.",
                "That is so for one elbow alone, {one_1:.1f} % against {one_2:.1f} %. With two "
                "elbows the other one reaches most of these places already: {both_1:.1f} %.",
                "one elbow taken for both",
                "From ±150° to ±180° joint 1 gains {rest:.1f} % more, and then nothing.",
            ),
            Option(
                "Joint 2: it makes the hole smaller.",
                "{both_2:.1f} % against {both_1:.1f} %. Behind the arm the two elbows help each "
                "other out; in the hole neither can.",
            ),
            Option(
                "Both the same: 10° are 10°.",
                "Area does not go with angle: joint 2 gains {both_2:.1f} %, joint 1 {both_1:.1f} "
                "%. The factor l1 l2 sin q2 stands between the two.",
                "equal angles taken for equal areas",
                "Nearly stretched, 10° of joint 2 hardly move the tool outwards.",
            ),
            Option(
                "Neither: the reach stays 450 mm.",
                "The outer border stays where it is there already; area is won in the hole "
                "({both_2:.1f} %) and behind the arm ({both_1:.1f} %).",
                "reach taken for area",
                "A ring and a disc of the same outer radius have unlike areas.",
            ),
        ),
        facts=_area_facts,
        right=_area_right,
        view=_area_view,
    ),
    "p8": Prediction(
        question="Around the circle of radius 70 mm the tool turns once, by +360°, and its angle "
        "begins at 0. Then joint 3 begins at {plus} with the elbow +1, and at {minus} with the "
        "elbow −1. Its limits are ±{limit}. Which elbow can do it?",
        options=(
            Option(
                "Both: one turn is 360°, and the limit is {limit}.",
                "What counts is where joint 3 ends, not how far it goes: with the elbow −1 at "
                "{minus_end}.",
                "travel compared with a limit",
                "From 300° not even a third of a turn is left.",
            ),
            Option(
                "Neither: after 180° an angle goes on at −180°.",
                "In a table it does, a motor does not: joint 3 runs on to {plus_end} or "
                "{minus_end}.",
                "a wrapped angle taken for the joint",
                "A cable around joint 3 knows how many turns it has made.",
            ),
            Option(
                "Elbow +1 alone.",
                "It ends at {plus_end}, inside. The elbow −1 ends at {minus_end}, past the limit.",
            ),
            Option(
                "Elbow −1 alone: it has more room before it.",
                "It begins at {minus}, so it is nearer to the upper limit, and ends at "
                "{minus_end}. It has more room the other way.",
                "room on the wrong side",
                "With −360° the elbow −1 ends at {back}.",
            ),
        ),
        facts=_lap_facts,
        right=_lap_right,
        view=_lap_view,
    ),
    "p9": Prediction(
        question="The tool runs straight outwards. From 300 to 310 mm, joint 2 turns by "
        "{middle:.1f}°. How far does it turn on the last 10 mm, from 440 mm to full reach?",
        options=(
            Option(
                "By about as much: 10 mm are 10 mm.",
                "By {last:.1f}°. How far the tool moves for a degree depends on the posture, and "
                "near full reach it hardly moves outwards at all.",
                "a constant ratio of joint and tool",
                "From 430 to 440 mm it is {before:.1f}° already.",
            ),
            Option(
                "By about 24°.",
                "{last:.1f}°. At full reach a small turn of joint 2 moves the tool across, not "
                "outwards: the distance changes with the square of q2.",
            ),
            Option(
                "By about 90°: it must unfold.",
                "It has unfolded long before: at 440 mm it stands at {last:.1f}°.",
                "the arm taken to be bent to the end",
                "At q2 = 90° the tool is at {square:.0f} mm.",
            ),
            Option(
                "By less: the arm is nearly straight, so little is left to turn.",
                "It is nearly straight in length, not in angle: 1 mm short of full reach joint 2 "
                "still stands at {one:.1f}°.",
                "length taken for angle",
                "A rope 1 % longer than the distance of its ends: its middle can be pulled aside "
                "by 7 % of that distance.",
            ),
        ),
        facts=lambda: _last_facts() | {"square": _distance(np.pi / 2) / mm},
        right=_last_right,
        view=_last_view,
    ),
}
