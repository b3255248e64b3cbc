"""Lab 2, the IRB-140 from joints to pose and back: its exercises and predictions.

Above stand the programs, below the tables: OBJECTIVES, EXERCISES, PREDICTIONS.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .._arrays import Floats
from ..arms import IRB140, explain, within
from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, mm
from .exercises import words
from .mistakes import DEGREES, METRES, Mistake, Program, Tools
from .old import Exercise, Fault, Function, Value
from .questions import Option, Prediction
from .told import apart, one_number
from .variants import Numbers, dice

LAB = "irb140_kinematics"
X, Y, Z = np.eye(3)
L4 = 65 * mm  # from the wrist centre to the flange
turned = Quaternion.from_angle_axis

OBJECTIVES = (
    "build the IRB-140 joint by joint from transforms, and compute the pose of its flange",
    "derive the inverse step by step, with every configuration and with the cases where textbook "
    "formulas fail",
    "follow a moving target with the joints, say which limits it breaks, and compute joint speeds "
    "without false spikes",
)


# --- Exercise 1: the tip of a gripper -------------------------------------------------------------


def tip(tools: Tools, q: Floats, length: float, turn: float) -> Any:
    """The right program: the flange's pose, then the gripper seen from the flange."""
    return tools.product(IRB140.fk(q), gripper(length, turn))


def gripper(length: float, turn: float, along: Any = Z, about: Any = Z) -> Transform:
    """The tip seen from the flange."""
    return Transform(turned(turn, about), length * np.asarray(along))


def tip_cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    """Home first, then one joint at a time, then anything inside the limits."""
    home = np.zeros(6)
    cases: list[tuple[Any, ...]] = [
        (home, 100 * mm, 0.0),
        (home, 100 * mm, 90 * deg),
        (home, 0.0, -30 * deg),
        (home, 0.0, 0.0),
    ]
    for k in range(6):
        q = np.zeros(6)
        q[k] = (90, 45, -60, 90, 30, 45)[k] * deg
        cases.append((q, 150 * mm, 60 * deg))
    low, high = IRB140.limits.T
    for _ in range(14):
        length, turn = float(rng.uniform(20, 300)) * mm, float(rng.uniform(-170, 170)) * deg
        cases.append((rng.uniform(low, high), length, turn))
    return cases


def tip_form(result: Any, case: tuple[Any, ...]) -> Transform:
    """One pose."""
    if isinstance(result, Transform) and result.shape == ():
        return result
    hint = ""
    if isinstance(result, Transform):
        hint = "; q is one posture (6,)"
    elif isinstance(result, Quaternion):
        hint = ": an orientation without a place"
    elif np.shape(result) == (3,):
        hint = ": a place without an orientation"
    elif np.shape(result) == (4, 4):
        hint = "; Transform.from_matrix makes one of it"
    raise ValueError(f"Wanted one Transform, got {words(result)}{hint}.")


def tip_law(case: tuple[Any, ...], result: Transform) -> str | None:
    """Seen from the flange the tip is where the gripper has it."""
    q, length, turn = case
    seen = IRB140.fk(q).inverse() @ result
    if abs(seen.translation - [0, 0, length]).max() > 1e-7:
        tip_at = in_mm((IRB140.fk(q) @ gripper(length, turn)).translation)
        wanted, yours = apart(np.array([0, 0, length]) / mm, seen.translation / mm)
        return (
            f"should be at {tip_at} mm: seen from the flange the tip is at ({wanted}) mm, yours is "
            f"at ({yours}) mm"
        )
    off = float(seen.rotation.angle_to(turned(turn, Z)))
    if off > 1e-7:
        return (
            "stands in the right place, but not turned as it should be: seen from the flange by "
            f"{turn / deg:.1f}° about z; yours is {apart(off / deg, 0)[0]}° away from that"
        )
    return None


def in_mm(place: Any) -> str:
    """A place in words."""
    return "(" + ", ".join(f"{x / mm + 0.0:.1f}" for x in np.round(place, 9)) + ")"


def tip_same(a: Transform, b: Transform) -> bool:
    """One and the same pose, rounding left out."""
    return bool(np.allclose(a.as_matrix(), b.as_matrix(), rtol=0, atol=1e-7))


def other(axis: Any, along: bool, about: bool) -> Program:
    """The gripper stretches or turns along another axis of the flange."""
    first, second = axis if along else Z, axis if about else Z
    return lambda q, length, turn: IRB140.fk(q) @ gripper(length, turn, first, second)


def fed(change: Program) -> Program:
    """The right program for another posture."""
    return lambda q, length, turn: IRB140.fk(change(np.array(q))) @ gripper(length, turn)


def flipped(k: int) -> Program:
    return fed(lambda q: np.where(np.arange(6) == k, -q, q))


def at_frame(k: int) -> Program:
    """The gripper on another frame of the arm."""
    return lambda q, length, turn: IRB140.frames(q)[k] @ gripper(length, turn)


def from_base(shift: bool, spin: bool, moved: bool = False) -> Program:
    """Shift or turn taken in base coordinates; `moved`: the turn takes the place along."""

    def program(q: Floats, length: float, turn: float) -> Transform:
        flange = IRB140.fk(q)
        tool = Transform(turned(0.0 if spin else turn, Z), (0.0 if shift else length) * Z)
        pose = flange @ tool
        place, rotation = pose.translation, pose.rotation
        if shift:
            place = place + length * Z
        if spin:
            rotation = turned(turn, Z) @ rotation
            place = turned(turn, Z) @ place if moved else place
        return Transform(rotation, place)

    return program


def unturned(along_x: bool) -> Program:
    """The chain without its last fixed turn, so that the flange's x axis looks ahead."""
    axis = X if along_x else Z
    back = Transform(turned(-90 * deg, Y))
    return lambda q, length, turn: IRB140.fk(q) @ back @ gripper(length, turn, axis, axis)


def row_for_column(q: Floats, length: float, turn: float) -> Transform:
    flange = IRB140.fk(q)
    place = flange.translation + length * flange.rotation.as_matrix()[2]
    return Transform(flange.rotation @ turned(turn, Z), place)


def back_turned(q: Floats, length: float, turn: float) -> Transform:
    flange = IRB140.fk(q)
    back = Transform(flange.rotation.inverse(), flange.translation)
    return back @ gripper(length, turn)


def ahead_at_home(q: Floats, length: float, turn: float) -> Transform:
    flange = IRB140.fk(q)
    return Transform(flange.rotation @ turned(turn, Z), flange.translation + length * X)


TIP_MISTAKES = (
    Mistake(
        "the length added in base coordinates",
        "The tip is put straight above the flange. The length counts along the flange's own z "
        "axis: let the flange's pose act on (0, 0, length).",
        from_base(shift=True, spin=False),
    ),
    Mistake(
        "ahead taken as the base's x",
        "The tip is put along the base's x axis: right only while the tool points along it.",
        ahead_at_home,
    ),
    *(
        Mistake(
            "along another axis of the flange",
            f"The tip is put along the flange's {name} axis. A tool looks along the flange's z "
            "axis.",
            other(axis, True, False),
        )
        for name, axis in (("x", X), ("y", Y))
    ),
    *(
        Mistake(
            "about another axis of the flange",
            f"The gripper is turned about the flange's {name} axis, not about its z axis.",
            other(axis, False, True),
        )
        for name, axis in (("x", X), ("y", Y))
    ),
    Mistake(
        "x for z",
        "Shift and turn both go along the flange's x axis. After the last fixed turn by 90° it is "
        "the flange's z axis that looks ahead.",
        other(X, True, True),
    ),
    Mistake(
        "y for z",
        "Shift and turn both go along the flange's y axis. They belong to its z axis.",
        other(Y, True, True),
    ),
    Mistake(
        "turned about the base's z",
        "The turn stands to the left of the flange's rotation: the orientation is turned about the "
        "z axis of the base.",
        from_base(shift=False, spin=True),
    ),
    Mistake(
        "turned about the base's z",
        "The turn stands to the left of the whole product: it swings the arm about the z axis of "
        "the base.",
        from_base(shift=False, spin=True, moved=True),
    ),
    Mistake(
        "length and turn in base coordinates",
        "The tip is put straight above the flange and turned about the base's z axis: both belong "
        "to the flange.",
        from_base(shift=True, spin=True),
    ),
    Mistake(
        "the turn left out",
        "The tip is in its place, but the gripper is not turned about the flange's z axis.",
        lambda q, length, turn: IRB140.fk(q) @ gripper(length, 0.0),
    ),
    Mistake(
        "the length left out",
        "The gripper is turned, but its tip is left at the flange.",
        lambda q, length, turn: IRB140.fk(q) @ gripper(0.0, turn),
    ),
    Mistake(
        "the flange for the tip",
        "This is the flange's own pose: length and turn are not used.",
        lambda q, length, turn: IRB140.fk(q),
    ),
    Mistake(
        "the last fixed turn forgotten",
        "The 90° about y at the end of the chain is missing, so your tool looks another way.",
        unturned(along_x=False),
    ),
    Mistake(
        "the last fixed turn forgotten",
        "The 90° about y at the end of the chain is missing: the tip is right, but your frame's x "
        "axis looks where the flange's z axis should.",
        unturned(along_x=True),
    ),
    Mistake(
        "the last fixed turn twice",
        "The flange has the 90° about y already. With another 90° the tool looks sideways.",
        lambda q, length, turn: (
            IRB140.fk(q) @ Transform(turned(90 * deg, Y)) @ gripper(length, turn)
        ),
    ),
    Mistake(
        "the last fixed turn twice",
        "The flange has the 90° about y already. Another 90° turns the gripper's frame away.",
        lambda q, length, turn: (
            IRB140.fk(q) @ gripper(length, turn) @ Transform(turned(90 * deg, Y))
        ),
    ),
    Mistake(
        "the wrist for the flange",
        "From the wrist frame on joint 6 and the last fixed turn are missing: start at the flange.",
        lambda q, length, turn: IRB140.frames(q)[5] @ gripper(L4 + length, turn, X, X),
    ),
    Mistake(
        "the wrist for the flange",
        "From the wrist frame on, joint 6 and the last fixed turn are missing, and its z axis does "
        "not look ahead. Begin at the flange.",
        lambda q, length, turn: IRB140.frames(q)[5] @ gripper(L4 + length, turn),
    ),
    Mistake(
        "measured from the wrist centre",
        "The tip is 65 mm too near: the length counts from the flange, not from the wrist centre.",
        lambda q, length, turn: IRB140.fk(q) @ gripper(length - L4, turn),
    ),
    Mistake(
        "the last link twice",
        "The tip is 65 mm too far: the flange already stands 65 mm ahead of the wrist centre.",
        lambda q, length, turn: IRB140.fk(q) @ gripper(length + L4, turn),
    ),
    *(
        Mistake(
            f"the sign of joint {k + 1}",
            f"Joint {k + 1} turns the other way"
            + (": its axis is minus y, a positive angle leans the arm back." if k == 1 else "."),
            flipped(k),
        )
        for k in range(6)
    ),
    Mistake(
        "joint 3 not relative",
        "Joint 3 counts from the upper arm. Your forearm does not lean along with joint 2.",
        fed(lambda q: q + q[1] * np.array([0, 0, 1, 0, 0, 0])),
    ),
    Mistake(
        "joints counted from 0",
        "The joints come one place too late: the first joint is q[0].",
        fed(lambda q: np.roll(q, 1)),
    ),
    Mistake(
        "joints counted from 0",
        "The joints come one place too early: the first joint is q[0], not q[1].",
        fed(lambda q: np.roll(q, -1)),
    ),
    Mistake(
        "the joints backwards",
        "The joints come in the wrong order: q[0] is the one next to the base.",
        fed(lambda q: q[::-1]),
    ),
    Mistake(
        "the home posture for q",
        "The posture is not used: this is the tip of the arm at q = 0.",
        fed(lambda q: 0 * q),
    ),
    Mistake(
        "joint 6 left out",
        "Joint 6 makes no difference here. The turn of the gripper comes on top of it.",
        fed(lambda q: q * np.array([1, 1, 1, 1, 1, 0])),
    ),
    Mistake(
        "the gripper on the base",
        "The gripper stands on the base: the arm is not used.",
        at_frame(0),
    ),
    *(
        Mistake(
            f"the gripper on the {name} frame",
            f"The gripper stands on the {name} frame of the chain. The flange is the last one.",
            at_frame(k),
        )
        for k, name in ((1, "column"), (2, "shoulder"), (3, "elbow"), (4, "joint 4"), (5, "wrist"))
    ),
    Mistake(
        "the gripper's inverse",
        "You multiply by the flange seen from the tip. Wanted is the tip seen from the flange.",
        lambda q, length, turn: IRB140.fk(q) @ gripper(length, turn).inverse(),
    ),
    Mistake(
        "the flange's inverse",
        "You multiply by the base seen from the flange. Wanted is the flange seen from the base.",
        lambda q, length, turn: IRB140.fk(q).inverse() @ gripper(length, turn),
    ),
    Mistake(
        "360 mm for the upper arm",
        "Your upper arm has 360 mm, as other models of this robot have. Here it has 350 mm.",
        lambda q, length, turn: (
            Transform(translation=IRB140.frames(q)[2].rotation @ (10 * mm * Z))
            @ IRB140.fk(q)
            @ gripper(length, turn)
        ),
    ),
    Mistake(
        "the order of a quaternion",
        "A quaternion is (w, x, y, z) here, the cosine first. Yours is (x, y, z, w).",
        lambda q, length, turn: (
            IRB140.fk(q)
            @ Transform(Quaternion((0, 0, np.sin(turn / 2), np.cos(turn / 2))), length * Z)
        ),
    ),
    Mistake(
        "twice the turn",
        "The turn is twice what it should be. In a quaternion stand cosine and sine of half the "
        "angle; from_angle_axis takes the whole one.",
        lambda q, length, turn: IRB140.fk(q) @ gripper(length, 2 * turn),
    ),
    Mistake(
        "half the turn",
        "The turn is half of what it should be: from_angle_axis takes the whole angle.",
        lambda q, length, turn: IRB140.fk(q) @ gripper(length, turn / 2),
    ),
    Mistake(
        "the flange's orientation left out",
        "The tip is in its place, but its orientation is the turn alone, as if the flange stood "
        "like the base.",
        lambda q, length, turn: Transform(turned(turn, Z), IRB140.fk(q) @ (length * Z)),
    ),
    Mistake(
        "orientation left out",
        "The tip is in its place, but your result has no orientation.",
        lambda q, length, turn: Transform(translation=IRB140.fk(q) @ (length * Z)),
    ),
    Mistake(
        "the flange's place left out",
        "The orientation is right, but the tip is measured from the base: the flange's own place "
        "is missing.",
        lambda q, length, turn: Transform(IRB140.fk(q).rotation) @ gripper(length, turn),
    ),
    Mistake(
        "a row for a column",
        "The flange's z axis is the third column of its matrix. You take the third row.",
        row_for_column,
    ),
    Mistake(
        "a row for a column",
        "The flange's matrix is transposed: its columns are the flange's axes, not its rows.",
        back_turned,
    ),
    Mistake(
        "ahead taken as the base's x",
        "Shift and turn are taken in base coordinates, and ahead as the base's x. Both belong to "
        "the flange.",
        lambda q, length, turn: Transform(
            turned(turn, Z) @ IRB140.fk(q).rotation, IRB140.fk(q).translation + length * X
        ),
    ),
    Mistake(
        "a fixed number for the length",
        "Your gripper is always 100 mm long. Use the input `length`.",
        lambda q, length, turn: IRB140.fk(q) @ gripper(100 * mm, turn),
    ),
    Mistake(
        "a fixed number for the turn",
        "Your gripper is always turned by 90°. Use the input `angle`.",
        lambda q, length, turn: IRB140.fk(q) @ gripper(length, 90 * deg),
    ),
    Mistake(
        "the length twice",
        "The tip is twice as far from the flange as it should be: the shift is made twice.",
        lambda q, length, turn: IRB140.fk(q) @ gripper(2 * length, turn),
    ),
    Mistake(
        "the sign of the turn lost",
        "A negative turn goes the other way. Your gripper turns by its absolute value.",
        lambda q, length, turn: IRB140.fk(q) @ gripper(length, abs(turn)),
    ),
    Mistake(
        "the radians taken for degrees",
        f"{DEGREES} The inputs come in radians: multiply nothing.",
        lambda q, length, turn: IRB140.fk(q * deg) @ gripper(length, turn * deg),
    ),
    Mistake(
        "the radians turned into degrees",
        f"{DEGREES} The inputs come in radians: divide by nothing.",
        lambda q, length, turn: IRB140.fk(q / deg) @ gripper(length, turn / deg),
    ),
)


# --- Exercise 2: a pose with four ways ------------------------------------------------------------


def pose_form(answer: Any, given: Any) -> Transform:
    """One pose."""
    if isinstance(answer, Transform) and answer.shape == ():
        return answer
    hint = ""
    with np.errstate(all="ignore"):
        if np.shape(answer) == (6,):
            hint = ": six numbers are a posture, IRB140.fk(q) is its pose"
        elif np.shape(answer) == (3,):
            hint = ": a place without an orientation"
        elif np.shape(answer) == (4, 4):
            hint = "; Transform.from_matrix makes one of it"
    raise ValueError(f"Wanted one Transform, got {words(answer)}{hint}.")


def pose_faults(pose: Transform, given: Any) -> list[Fault]:
    """Exactly four rows have to exist, and no two of them may be one posture."""
    distance = float(np.linalg.norm(pose.translation))
    if distance > 5:
        far = f"Your place is {distance:.0f} m away from the base. {METRES}"
        return [("mm for m", far)]
    rows = IRB140.ik(pose)
    exists = ~np.isnan(rows).any(axis=-1)
    count = int(exists.sum())
    if count == 0:
        return [("no way: out of reach", f"No row of ik exists. {explain(IRB140, pose, 0)}")]
    usable = int(within(IRB140, rows).all(axis=-1).sum())
    if count == 8 and usable == 4:
        says = (
            "Four rows are inside the limits, but all eight exist. A row that is past a limit "
            "counts here: it does reach the pose."
        )
        return [("limits counted", says)]
    if count != 4:
        inside = "none" if usable == 0 else f"{usable} of them"
        says = (
            f"{count} rows of ik exist, {inside} inside the limits. Which step of the inverse can "
            "fail for one front and hold for the other?"
        )
        return [("all eight ways" if count == 8 else f"{count} ways", says)]
    names = [
        name for name, holds in IRB140.geometry.singularities(rows[exists]).items() if holds.any()
    ]
    if names:
        says = (
            f"Four rows exist, but at a singularity ({', '.join(names)}): rows there are the same "
            "posture twice, or joints are free. Move the pose a little."
        )
        return [("rows twice: a singular pose", says)]
    return []


# --- Exercise 3: a target of one's own ------------------------------------------------------------

SLACK = 1.2  # the duration may be so many times the shortest
SAMPLES = 2001
EASE = 1.005  # other samples find another greatest speed, by up to 0.2 %
UNITS = {
    **dict.fromkeys(("x_start", "x_end", "y_start", "y_end"), ("mm", mm)),
    "turn": ("° about y", deg),
    "share": ("% of every speed limit", 0.01),
    "longest": ("times the shortest duration", 1.0),
}


def given(who: Any) -> Numbers:
    """A target that moves behind the arm, across the line where joint 1 stands at half a turn. The
    arm can follow it with its back to it alone, from some height on.
    """
    roll = dice(LAB, who)
    side = 1 - 2 * roll.randrange(2)
    x_start = -320 + 10 * roll.randrange(5)
    x_end = x_start + 80 + 10 * roll.randrange(5)
    y_start = -side * (200 + 20 * roll.randrange(4))
    y_end = side * (150 + 10 * roll.randrange(6))
    turn = 90 - 180 * roll.randrange(2)
    share = 20 + 5 * roll.randrange(7)
    values = {
        "x_start": x_start * mm,
        "x_end": x_end * mm,
        "y_start": y_start * mm,
        "y_end": y_end * mm,
        "turn": turn * deg,
        "share": share / 100,
        "longest": SLACK,
    }
    return Numbers(values, UNITS)


def target(numbers: Mapping[str, Any], p: Floats, height: float) -> Transform:
    """The moving target at progress p (N,) from 0 to 1: along y, then along x, turning all the
    while.
    """
    x = numbers["x_start"] + (numbers["x_end"] - numbers["x_start"]) * np.clip(2 * p - 1, 0, 1)
    y = numbers["y_start"] + (numbers["y_end"] - numbers["y_start"]) * np.clip(2 * p, 0, 1)
    place = np.stack([x, y, np.full_like(x, height)], axis=-1)
    return Transform(turned(numbers["turn"] * p, Y), place)


def design_form(answer: Any, given: Any) -> dict[str, Any]:
    """Height and duration as floats, flags as three of +1 and -1."""
    if not isinstance(answer, Mapping):
        raise ValueError(f"Wanted a dict with height, flags and duration, got {words(answer)}.")
    missing = [key for key in ("height", "flags", "duration") if key not in answer]
    if missing:
        raise ValueError(f"Your dict has no {' and no '.join(repr(key) for key in missing)}.")
    flags = np.asarray(answer["flags"], dtype=object).ravel().tolist()
    if len(flags) != 3 or any(isinstance(x, bool) or x not in (1, -1) for x in flags):
        got = words(answer["flags"])
        raise ValueError(f"flags: wanted three of +1 and -1, (+1, -1, +1), got {got}.")
    design: dict[str, Any] = {"flags": tuple(int(x) for x in flags)}
    for key, unit in (("height", "metres"), ("duration", "seconds")):
        try:
            value = one_number(answer[key])
        except (TypeError, ValueError):
            value = np.nan
        if not np.isfinite(value) or (key == "duration" and value <= 0):
            raise ValueError(f"{key}: wanted a number of {unit}, got {words(answer[key])}.")
        design[key] = value
    return design


def design_faults(design: Mapping[str, Any], given: Mapping[str, Any]) -> list[Fault]:
    """It exists everywhere; inside all limits; not too fast; not too slow."""
    height, duration = design["height"], design["duration"]
    if height > 5:
        name = "mm for m" if height >= 200 else "cm for m"
        return [(name, f"The height is {height:g} m. {METRES}")] * 4
    row = IRB140.branch(*design["flags"])
    p = np.linspace(0, 1, SAMPLES)
    poses = target(given, p, height)
    rows = IRB140.ik(poses)[:, row]
    missing = np.isnan(rows).any(axis=-1)
    if missing.any():
        i = int(missing.argmax())
        says = (
            f"Out of reach in {missing.mean():.0%} of the time, first at t = {p[i] * duration:.2f} "
            f"s. {explain(IRB140, poses[i], row)}"
        )
        return [("out of reach", says)] * 4
    q = np.unwrap(rows, axis=0)
    return [*past_limits(q, p * duration), *speeds(q, duration, given)]


def past_limits(q: Floats, t: Floats) -> list[Fault]:
    """The joints that no choice of whole turns keeps inside their limits."""
    turns = 2 * np.pi * np.arange(-3, 4)
    names, lines, ends = [], [], True
    for k, (low, high) in enumerate(IRB140.limits):
        track = q[:, k, None] + turns
        over = np.maximum(track - high, low - track)  # (samples, whole turns)
        best = int(over.max(axis=0).argmin())
        i = int(over[:, best].argmax())
        if over[i, best] <= 1e-6:
            continue
        limit = high if track[i, best] > high else low
        names.append(k + 1)
        past = over[:, best] > 1e-6
        ends &= not past[[0, -1]].any()
        lines.append(
            f"Joint {k + 1} is past its limit of {limit / deg:.0f}° by "
            f"{apart(over[i, best] / deg, 0)[0]}° at t = {t[i]:.2f} s (past it from "
            f"{t[past][0]:.2f} to {t[past][-1]:.2f} s)."
        )
        if within(IRB140, q)[:, k].all():
            ends = False
            ways = track[:, best] / deg
            lines.append(
                f"Each sample alone has a value inside, and the motion has not: without a jump it "
                f"goes from {ways.min():.1f}° to {ways.max():.1f}°, or whole turns away, past a "
                "limit wherever it starts."
            )
    if not names:
        return []
    which = f"joint {names[0]}" if len(names) == 1 else f"joints {listed(names)}"
    if ends:
        lines.append("At both ends every joint is inside: look at the whole way.")
    return [(f"past a limit: {which}", " ".join(lines))]


def listed(numbers: Sequence[Any]) -> str:
    """One, two and three."""
    return ", ".join(str(n) for n in numbers[:-1]) + f" and {numbers[-1]}"


def speeds(q: Floats, duration: float, given: Mapping[str, Any]) -> list[Fault]:
    """Whether the busiest joint keeps its share, and is not far below it."""
    dt = duration / (len(q) - 1)
    steps = abs(np.diff(q, axis=0))
    if steps.max() > 1.5:
        i, k = np.unravel_index(int(steps.argmax()), steps.shape)
        says = (
            f"Joint {k + 1} jumps by {steps[i, k] / deg:.0f}° at t = {i * dt:.2f} s: with these "
            "flags the arm passes a singularity."
        )
        return [(f"a jump: joint {k + 1}", says)] * 2
    assert IRB140.speed_limits is not None
    used = steps / dt / IRB140.speed_limits
    i, k = np.unravel_index(int(used.argmax()), used.shape)
    most, share = float(used[i, k]), given["share"]
    reached, asked = apart(100 * most, 100 * share, 0)
    busiest = (
        f"Joint {k + 1} is the busiest: it reaches {reached} % of its speed limit at "
        f"t = {i * dt:.2f} s; asked is at most {asked} %"
    )
    if most > EASE * share:
        return [(f"too fast: joint {k + 1}", f"{busiest}. More time is needed.")]
    if most * SLACK * EASE < share:
        says = (
            f"{busiest}, and the duration may be {SLACK} times the shortest one. Speeds go with 1 "
            "/ duration: less time will do."
        )
        return [("slower than asked", says)]
    return []


# --- Predictions: the numbers behind them, and what opens after the choice ------------------------


def signed(angle: float, digits: int = 0) -> str:
    """Radians in degrees, with a minus sign that is one."""
    return f"{round(angle / deg, digits) + 0.0:.{digits}f}°".replace("-", "−")


def moved(q: Any, k: int, by: float, point: Any = (0, 0, 0)) -> float:
    """How far a point fixed to the flange goes when joint k (from 0) turns, in mm."""
    a = np.array(q, dtype=float)
    b = a + by * (np.arange(6) == k)
    return float(np.linalg.norm(IRB140.fk(b) @ point - IRB140.fk(a) @ point)) / mm


def still_facts() -> dict[str, Any]:
    """Joints that turn the home posture's flange on the spot."""
    home, bent = np.zeros(6), np.array([0, 0, 0, 0, 45, 0]) * deg
    at_home = [moved(home, k, 45 * deg) for k in range(6)]
    return {
        "still": tuple(k + 1 for k, x in enumerate(at_home) if x < 1e-6),
        "wrist": at_home[4],
        "column": at_home[0],
        "bent": moved(bent, 3, 45 * deg),
        "tipped": moved(home, 4, 45 * deg, 200 * mm * Z),
    }


def still_right(facts: Mapping[str, Any]) -> int:
    return ((4, 5, 6), (4, 6), (6,), (1, 6)).index(facts["still"])


def still_view() -> Any:
    from ..show import plot_postures

    bent = np.zeros((41, 6))
    bent[:, 4] = np.linspace(0, 90, 41) * deg
    return plot_postures(IRB140, bent, title="Joint 5 swings the flange on an arc of 65 mm")


CENTRE_Q = np.array([10, 20, -30, 40, 50, 60]) * deg


def centre_facts() -> dict[str, Any]:
    """Two points that turn with joint 5: the flange and the wrist centre behind it."""
    behind = -L4 * Z
    return {
        "flange": moved(CENTRE_Q, 4, 90 * deg),
        "centre": moved(CENTRE_Q, 4, 90 * deg, behind),
        "others": max(moved(CENTRE_Q, k, 90 * deg, behind) for k in (3, 5)),
        "elbow": moved(CENTRE_Q, 2, 90 * deg, behind),
        "zero": 0.0,
    }


def centre_right(facts: Mapping[str, Any]) -> int:
    if facts["centre"] > 1e-6:
        return 0
    return 2 if facts["others"] < 1e-6 else 1


def centre_view() -> str:
    lines = [
        "The point 65 mm behind the flange, and the flange itself, when one joint turns by 90°:"
    ]
    for k in range(3, 6):
        point, flange = (moved(CENTRE_Q, k, 90 * deg, at) for at in (-L4 * Z, 0 * Z))
        lines.append(f"joint {k + 1}: the point moves {point:.1f} mm, the flange {flange:.1f} mm")
    return "\n".join(lines)


AWAY_AT = np.array([400, -230.94, 500]) * mm  # a wrist centre 30 degrees to the right


def away_pose() -> Transform:
    """The tool looks up, so that the flange stands 65 mm above its wrist centre."""
    return Transform(translation=AWAY_AT + L4 * Z)


def away_facts() -> dict[str, Any]:
    """Joint 1 of the arm that looks at a point, and of the one that faces away."""
    rows = IRB140.ik(away_pose())
    front, back = (float(rows[IRB140.branch(f, 1, 1), 0]) for f in (+1, -1))
    x, y, _ = AWAY_AT
    options = [np.arctan2(-y, x), back, np.arctan2(y, -x), front]
    return {
        "away": back,
        "options": options,
        "front": signed(front),
        "back": signed(back),
        "mirrored": signed(options[0]),
        "one_sign": signed(options[2]),
    }


def away_right(facts: Mapping[str, Any]) -> int:
    """The option with which joints 2 and 3 can stay in one plane with the wrist centre, in front
    (`front`) or behind.
    """
    (x, y, _), found = AWAY_AT, []
    for k, q1 in enumerate(facts["options"]):
        ahead, aside = np.cos(q1) * x + np.sin(q1) * y, -np.sin(q1) * x + np.cos(q1) * y
        if ahead < 0 and abs(aside) < 1e-9:
            found.append(k)
    return found[0]


def away_view() -> Any:
    from ..show import plot_postures

    rows = IRB140.ik(away_pose())[[IRB140.branch(+1, 1, 1), IRB140.branch(-1, 1, 1)]]
    return plot_postures(
        IRB140,
        rows,
        targets=[away_pose()],
        title=f"Joint 1 at {signed(rows[0, 0])} and at {signed(rows[1, 0])}: one plane, two fronts",
    )


UPPER, FORE = 350 * mm, 380 * mm


def arcsin_miss(d: float) -> float:
    """How far listing 1's law of sines puts the wrist centre from its place, in mm, for a wrist
    centre at the distance d from joint 2.
    """
    cos_inner = (UPPER**2 + FORE**2 - d**2) / (2 * UPPER * FORE)
    inner = np.arccos(cos_inner)  # the angle inside the triangle, at the elbow
    at_shoulder = np.arcsin(FORE * np.sin(inner) / d)
    elbow = UPPER * np.array([np.cos(at_shoulder), np.sin(at_shoulder)])
    bend = at_shoulder + inner - np.pi
    return (
        float(np.linalg.norm(elbow + FORE * np.array([np.cos(bend), np.sin(bend)]) - [d, 0])) / mm
    )


def arcsin_facts() -> dict[str, Any]:
    """What the formula gives for a wrist centre 100 mm from joint 2."""
    d = 100 * mm
    inner = np.arccos((UPPER**2 + FORE**2 - d**2) / (2 * UPPER * FORE))
    return {
        "miss": arcsin_miss(d),
        "sine": FORE * np.sin(inner) / d,
        "least": np.sqrt(FORE**2 - UPPER**2) / mm,
        "obtuse": np.arccos((UPPER**2 + d**2 - FORE**2) / (2 * UPPER * d)) / deg,
        "acute": np.arcsin(FORE * np.sin(inner) / d) / deg,
    }


def arcsin_right(facts: Mapping[str, Any]) -> int:
    if not np.isfinite(facts["miss"]):
        return 0
    return 3 if facts["miss"] > 0.1 else 2


def arcsin_view() -> Any:
    from ..show import figure

    distance = np.linspace(30.1, 300, 400)
    missed = [arcsin_miss(d * mm) for d in distance]
    least = np.sqrt(FORE**2 - UPPER**2) / mm
    fig = figure(
        f"The arcsine formula misses by up to {max(missed):.0f} mm where the wrist centre is "
        f"nearer to joint 2 than {least:.0f} mm; farther away it is right.",
        9,
        3.2,
    )
    ax = fig.subplots()
    ax.plot(distance, missed, color="#D55E00", lw=2)
    ax.axvline(least, color="black", lw=1, ls="--")
    ax.text(least + 4, 45, "shoulder angle 90°")
    ax.set(
        xlabel="d, from joint 2 to the wrist centre, mm",
        ylabel="miss, mm",
        xlim=(0, 300),
        ylim=(0, 65),
        title=f"Nearer than {least:.0f} mm the arcsine misses in silence",
    )
    fig.subplots_adjust(bottom=0.18)
    return fig


WRIST_Q = np.array([-20, 15, -40, 25, 35, -50]) * deg


def wrist_facts() -> dict[str, Any]:
    """The last three joints of a posture, of its other wrist, and three confusions."""
    rows = IRB140.ik(IRB140.fk(WRIST_Q))
    q = WRIST_Q[3:]
    distances = abs(np.angle(np.exp(1j * (rows - WRIST_Q)))).max(axis=-1)
    mine = int(np.nanargmin(distances))
    flags = IRB140.branches[mine] * [1, 1, -1]
    partner = rows[IRB140.branch(*(int(x) for x in flags)), 3:]
    options = [
        q * [1, -1, 1],
        -q,
        partner,
        np.array([q[0] + np.pi, q[1] - np.pi, q[2]]),
    ]
    texts = [", ".join(signed(float(x)) for x in each) for each in options]
    shift = abs(np.angle(np.exp(1j * (rows[:, :3] - WRIST_Q[:3])))).max(axis=-1)
    return {
        "options": options,
        "mine": texts_of(q),
        "flip": texts[0],
        "negative": texts[1],
        "other": texts[2],
        "half": texts[3],
        "same": int((shift < 1e-9).sum()),
    }


def texts_of(q: Any) -> str:
    """Joint angles in words; half a turn is +180°, whatever rounding made of it."""
    half = np.isclose(q, -np.pi, rtol=0, atol=1e-9)
    return ", ".join(signed(float(x)) for x in np.where(half, np.pi, q))


def wrist_right(facts: Mapping[str, Any]) -> int:
    """The option that gives the same pose, by the forward kinematics."""
    goal = IRB140.fk(WRIST_Q).as_matrix()
    found = [
        k
        for k, wrist in enumerate(facts["options"])
        if np.allclose(IRB140.fk(np.array([*WRIST_Q[:3], *wrist])).as_matrix(), goal, atol=1e-9)
    ]
    return found[0]


def wrist_view() -> str:
    facts, lines = wrist_facts(), ["q4, q5, q6, and how far the orientation is from the target's:"]
    goal = IRB140.fk(WRIST_Q).rotation
    for wrist in (WRIST_Q[3:], *facts["options"]):
        got = IRB140.fk(np.array([*WRIST_Q[:3], *wrist])).rotation
        lines.append(f"{texts_of(wrist)}: {float(goal.angle_to(got)) / deg:.1f}° off")
    return "\n".join(lines)


def home_facts() -> dict[str, Any]:
    """The ways to the pose of the posture 0, 0, 0, 0, 0, 0."""
    pose = IRB140.fk(np.zeros(6))
    rows = IRB140.ik(pose)
    exist = rows[~np.isnan(rows).any(axis=-1)]
    different = np.unique(np.round(np.exp(1j * exist), 9), axis=0)
    turn = IRB140.fk(np.array([0, 0, 0, 20, 0, -20]) * deg)
    return {
        "rows": len(exist),
        "different": len(different),
        "free": bool(np.allclose(turn.as_matrix(), pose.as_matrix(), atol=1e-12)),
        "usable": int(within(IRB140, rows).all(axis=-1).sum()),
    }


def home_right(facts: Mapping[str, Any]) -> int:
    return 3 if facts["free"] else 2


def home_view() -> str:
    pose = IRB140.fk(np.zeros(6))
    rows, lines = IRB140.ik(pose), ["The rows of ik at the home pose, q1 to q6:"]
    lines += [f"row {k}: {texts_of(row)}" for k, row in enumerate(rows)]
    lines.append(explain(IRB140, pose, 0))
    for q4 in (20, 110):
        q = np.array([0, 0, 0, q4, 0, -q4]) * deg
        off = abs(IRB140.fk(q).as_matrix() - pose.as_matrix()).max()
        lines.append(f"{texts_of(q)} reaches the same pose: {off < 1e-12}")
    return "\n".join(lines)


JOINT_6 = 30 * deg


def turns_facts() -> dict[str, Any]:
    """The values of joint 6 that are one posture and inside its limits."""
    low, high = IRB140.limits[5]
    values = JOINT_6 + 2 * np.pi * np.arange(-5, 6)
    inside = values[(values >= low) & (values <= high)]
    return {
        "q6": signed(JOINT_6),
        "count": len(inside),
        "values": listed([signed(float(x)) for x in inside]),
        "back": signed(JOINT_6 - 2 * np.pi),
        "high": signed(high),
        "q1": int(sum(-180 <= 30 + 360 * k <= 180 for k in range(-5, 6))),
    }


def turns_right(facts: Mapping[str, Any]) -> int:
    return (1, 2, 3).index(facts["count"])


def turns_view() -> str:
    facts, lines = turns_facts(), []
    for k, (low, high) in enumerate(IRB140.limits):
        values = JOINT_6 + 2 * np.pi * np.arange(-5, 6)
        inside = [signed(float(x)) for x in values if low <= x <= high]
        lines.append(
            f"joint {k + 1}, {signed(low)} to {signed(high)}: {len(inside)} ({', '.join(inside)})"
        )
    return f"Values of a joint that stand for {facts['q6']}, inside its limits:\n" + "\n".join(
        lines
    )


PULL_FROM = (250 * mm, -50 * mm, 950 * mm)
PULL_TURN = np.array([-30, 15, -15]) * deg  # roll, pitch, yaw: where the explorer begins


def pull(x: float) -> Transform:
    """The explorer's target, pulled to x."""
    return Transform(
        Quaternion.from_roll_pitch_yaw(*PULL_TURN.tolist()), (x, PULL_FROM[1], PULL_FROM[2])
    )


def pull_facts() -> dict[str, Any]:
    """Which rows vanish first when x grows in steps of 1 mm."""
    xs = np.arange(250, 900) * mm
    exists = ~np.isnan(IRB140.ik(Transform(pull(0).rotation, [(x, *PULL_FROM[1:]) for x in xs])))
    whole: Any = exists.all(axis=-1)
    ends = [float(xs[track.argmin()]) / mm for track in whole.T]
    first = IRB140.branches[np.array(ends) == min(ends)]
    return {
        "shared": [k for k in range(3) if len(set(first[:, k].tolist())) == 1],
        "flag": first[0].tolist(),
        "first": min(ends),
        "last": max(ends),
        "gone": len(first),
    }


def pull_right(facts: Mapping[str, Any]) -> int:
    """Front -1, elbow -1 or wrist -1; or all at once."""
    if facts["gone"] == 8:
        return 3
    (k,) = facts["shared"]
    return int(k) if facts["flag"][k] == -1 else 3


def pull_view() -> str:
    facts = pull_facts()
    lines = [
        f"The four rows with front −1 are gone from x = {facts['first']:.0f} mm on, the other "
        f"four from {facts['last']:.0f} mm on. At x = {facts['first'] + 1:.0f} mm:"
    ]
    lines += [explain(IRB140, pull((facts["first"] + 1) * mm), row) for row in (0, 4)]
    return "\n".join(lines)


def task_1() -> tuple[Floats, Floats, Transform]:
    """Task 1 of source 001: times, the row (+1, +1, +1) of all samples, and the poses."""
    t = np.linspace(0, 20, 2001)
    numbers = {
        "x_start": 200 * mm,
        "x_end": 450 * mm,
        "y_start": 50 * mm,
        "y_end": 550 * mm,
        "turn": 90 * deg,
    }
    poses = target(numbers, t / 20, 500 * mm)
    q = IRB140.ik(poses)[:, IRB140.branch(+1, +1, +1)]
    q[0, 3] = -180 * deg  # half a turn: +180 or -180, rounding decides; here we decide
    return t, q, poses


def task_facts() -> dict[str, Any]:
    """How much of task 1 is inside all limits, and which joints break them."""
    t, q, _ = task_1()
    inside = within(IRB140, q)
    past: Any = ~inside.all(axis=-1)
    samples = [
        f"joint {k + 1} in {(~inside[:, k]).sum()}" for k in range(6) if not inside[:, k].all()
    ]
    (_, _, high3, _, high5, _) = IRB140.limits[:, 1]
    return {
        "exists": bool(np.isfinite(q).all()),
        "past": int(past.sum()),
        "first": float(t[past][0]),
        "last": float(t[past][-1]),
        "count": len(past),
        "samples": " and ".join(samples),
        "corner": bool(past[1000]),
        "q3": signed(float(q[:, 2].max()), 1),
        "q5": signed(float(q[:, 4].max()), 1),
        "high3": signed(high3),
        "high5": signed(high5),
    }


def task_right(facts: Mapping[str, Any]) -> int:
    if facts["past"] == 0:
        return 0
    if facts["past"] == facts["count"]:
        return 3
    return 1 if facts["corner"] else 2


def task_view() -> Any:
    from ..show import plot_joints

    t, q, _ = task_1()
    facts = task_facts()
    return plot_joints(
        IRB140,
        t,
        q,
        title=f"Flags 1, 1, 1: past a limit from {facts['first']:.2f} to {facts['last']:.2f} s",
    )


def spike_facts() -> dict[str, Any]:
    """The greatest forward difference of joint 4 across a wrap, at two steps of time."""
    found = {}
    for name, step in (("coarse", 0.01), ("fine", 0.005)):
        t = np.arange(0, 1, step)
        turning = 179.5 * deg + 10 * deg * t  # 10 degrees a second, through half a turn
        shown = np.angle(np.exp(1j * turning))
        found[name] = float(abs(np.diff(shown)).max() / step)
        found[f"true {name}"] = float(abs(np.diff(np.unwrap(shown))).max() / step)
        found[f"central {name}"] = float(abs(np.gradient(shown, step)).max())
    found["true"] = found["true coarse"]
    return found


def spike_right(facts: Mapping[str, Any]) -> int:
    ratio = facts["fine"] / facts["coarse"]
    return min(range(3), key=lambda k: abs((0.5, 1.0, 2.0)[k] - ratio))


def spike_view() -> str:
    facts = spike_facts()
    return (
        f"A joint turns at {facts['true']:.3f} rad/s through half a turn.\n"
        f"Step 10 ms: the wrapped angle gives {facts['coarse']:.0f} rad/s, the unwrapped one "
        f"{facts['true coarse']:.3f} rad/s.\n"
        f"Step 5 ms: the wrapped angle gives {facts['fine']:.0f} rad/s, the unwrapped one "
        f"{facts['true fine']:.3f} rad/s."
    )


# --- Tables ---------------------------------------------------------------------------------------

EXERCISES: dict[str, Exercise] = {
    "1": Function(
        title="The tip of a gripper",
        task="Where is the tip of a gripper on the flange?",
        objective=1,
        hints=(
            "You know the flange seen from the base. What is the tip, seen from the flange?",
            "The tip seen from the flange is one transform: the place (0, 0, length), turned by "
            "`angle` about Z. In A @ B the frame B is given in the coordinates of A.",
            "return my_chain(q)[-1] @ Transform(Quaternion.from_angle_axis(angle, Z), ...): what "
            "is the place of the tip, as three numbers in flange coordinates?",
        ),
        inputs=("q", "length", "angle"),
        right=tip,
        cases=tip_cases,
        form=tip_form,
        law=tip_law,
        same=tip_same,
        mistakes=TIP_MISTAKES,
    ),
    "2": Value(
        title="Four ways",
        task="Find a pose that the IRB-140 reaches in exactly four ways",
        objective=2,
        hints=(
            "Rows vanish when a triangle does not close. Which of the three flags changes the "
            "triangle that joints 2 and 3 have to close?",
            "The shoulder stands 70 mm ahead of axis 1. At its height a wrist centre more than 70 "
            "mm ahead is 140 mm farther away from the shoulder of an arm that faces away.",
            "Stretched, the arm reaches 730 mm from joint 2 to the wrist centre. Put the wrist "
            "centre at the shoulder's height (352 mm), more than 660 mm and less than 800 mm "
            "ahead of axis 1, and let the tool look down: the flange is 65 mm below it. "
            "Transform(turn(180 * deg, Y), [..., 0, ...]).",
        ),
        form=pose_form,
        faults=pose_faults,
        count=1,
        goal={
            "wanted": 4,
            "holds": "Fulfilled: {count} ways exist.",
            "open": "{count} ways exist, wanted are {wanted}.",
        },
    ),
    "3": Value(
        title="A target of your own",
        task="Choose height, flags and duration for a moving target of your own",
        objective=3,
        hints=(
            "Begin with any duration: whether the motion exists and stays inside the limits is "
            "no matter of time. Which flags let the arm turn its back to the target?",
            "Try every row and the heights from 400 to 900 mm in steps of 25 mm. within asks each "
            "sample alone; the joints make one motion. With\n\n"
            "    t = np.linspace(0, 1, 2001)\n"
            "    q = np.unwrap(IRB140.ik(my_target(t, 1, height))[:, row], axis=0)\n"
            "    low, high = IRB140.limits.T\n"
            "    up = 360 * deg * np.ceil((low - q.min(axis=0)) / (360 * deg))  # whole turns\n"
            "    stays = (q.max(axis=0) + up <= high).all()\n"
            "    smooth = abs(np.diff(q, axis=0)).max() < 1.5\n\n"
            "take a height and a row for which `stays` and `smooth` are True.",
            "Then the speeds, for one second: v = differentiate(np.unwrap(rows, axis=0), t) with t "
            "from 0 to 1. The busiest joint has used = (abs(v) / IRB140.speed_limits).max(), and "
            "the shortest duration is used / share. Take 1.1 times that.",
        ),
        form=design_form,
        faults=design_faults,
        count=4,
        given=given,
    ),
}

# Objective 1: p1, p2. Objective 2: p3 to p6, p9. Objective 3: p7, p8, p10. In Deeper: p9, p10.
PREDICTIONS = {
    "p1": Prediction(
        question=(
            "All joints of the IRB-140 stand at zero. One joint after another turns by 45° and "
            "back. Which joints turn the flange without moving its origin?"
        ),
        options=(
            Option(
                "joints 4, 5 and 6, the whole wrist",
                "The three axes meet in the wrist centre, 65 mm behind the flange. Joint 5 moves "
                "the flange by {wrist:.1f} mm.",
                "wrist centre and flange are one",
                "On a gripper of 200 mm joint 5 moves the tip by {tipped:.1f} mm.",
            ),
            Option(
                "joints 4 and 6",
                "At zero both axes run along the forearm and on through the flange's origin. Every "
                "other axis passes it at a distance.",
            ),
            Option(
                "joint 6 alone",
                "Axis 6 goes through the flange's origin always, and at zero axis 4 does, too: the "
                "two are one line.",
                "an axis acts on its own link alone",
                "With joint 5 at 45° joint 4 does move the flange, by {bent:.1f} mm.",
            ),
            Option(
                "joints 1 and 6, the first and the last",
                "Joint 1 swings the whole arm about the column: the flange moves by {column:.1f} "
                "mm.",
                "a turn moves nothing",
                "The flange stays on a circle about axis 1, but a circle is a way.",
            ),
        ),
        facts=still_facts,
        right=still_right,
        view=still_view,
    ),
    "p2": Prediction(
        question=(
            "Take the point 65 mm behind the flange's origin, on the flange's z axis and fixed to "
            "the flange. Joint 5 turns by 90°, then joints 4 and 6 do the same. Where does the "
            "point go?"
        ),
        options=(
            Option(
                "on arcs of 65 mm, as the flange does",
                "It is the flange's origin that goes on such an arc when joint 5 turns, by "
                "{flange:.1f} mm. The point behind it lies on the axis.",
                "wrist centre and flange are one",
                "Joint 3 does move the point, by {elbow:.1f} mm: it carries the whole forearm.",
            ),
            Option(
                "it stays when joint 5 turns, but joints 4 and 6 move it",
                "Axes 4, 5 and 6 meet in this one point. Whichever of them turns, it stays.",
                "one axis for three",
                "The farthest that joints 4 and 6 move it is {others:.1f} mm.",
            ),
            Option(
                "nowhere: it stays, whichever of the three turns",
                "Axes 4, 5 and 6 meet there: it is the wrist centre. So its place depends on "
                "joints 1 to 3 alone, and six unknowns become three and three.",
            ),
            Option(
                "it moves, and joints 1 to 3 have to make up for it",
                "It lies on all three axes. Nothing has to be made up for: that is why this wrist "
                "is built so.",
                "all joints move all points",
                "It moves {centre:.1f} mm when joint 5 turns by 90°.",
            ),
        ),
        facts=centre_facts,
        right=centre_right,
        view=centre_view,
    ),
    "p3": Prediction(
        question=(
            "A wrist centre stands at x = 400, y = −231 mm. The arm looks at it with q1 = {front}. "
            "It can also face away from it and bend back over itself. What is q1 then?"
        ),
        options=(
            Option(
                "{mirrored}",
                "There the arm's plane passes the wrist centre by: it is mirrored in the x axis.",
                "the mirrored side",
                "With the wrist centre at y = 0 this would be the same q1 = 0 once more.",
            ),
            Option(
                "{back}",
                "Half a turn on: the same upright plane, seen from its other side. Both signs "
                "change in atan2(−y, −x).",
            ),
            Option(
                "{one_sign}",
                "One sign changed, atan2(y, −x), mirrors the point in the y axis. The arm's plane "
                "has to hold the point itself: both signs change.",
                "one sign instead of two",
                "A point on the y axis, x = 0, would get the same q1 twice.",
            ),
            Option(
                "{front}, only the elbow changes",
                "The elbow has its own flag: both elbows exist for either front.",
                "front and elbow are one choice",
                "With q1 = {front} the point is in front of the arm, whatever joints 2 and 3 do.",
            ),
        ),
        facts=away_facts,
        right=away_right,
        view=away_view,
    ),
    "p4": Prediction(
        question=(
            "An arm reaches a pose with q4, q5, q6 = {mine}. Joints 1 to 3 stay. With which other "
            "three angles does the wrist give the same orientation?"
        ),
        options=(
            Option(
                "{flip}",
                "Joint 5 the other way alone tips the tool to the other side. Joint 4 has to turn "
                "the bend back by half a turn, and joint 6 the tool.",
                "joint 5 alone",
                "At q5 = 90° the tool would look the opposite way.",
            ),
            Option(
                "{negative}",
                "Back to where the wrist came from is another way: with all three signs turned the "
                "tool looks elsewhere.",
                "all signs",
                "With q4 = 0 and q6 = 0 it would be joint 5 the other way alone.",
            ),
            Option(
                "{other}",
                "Joint 4 turns the bend to the other side, joint 5 bends the other way, and joint "
                "6 turns the tool back: q4 ± 180°, −q5, q6 ± 180°.",
            ),
            Option(
                "{half}",
                "cos q5 is the part of the tool's direction along the forearm. Half a turn of "
                "joint 5 makes it negative: the tool looks back.",
                "half a turn for a sign",
                "At q5 = 0 the tool would look into the forearm.",
            ),
        ),
        facts=wrist_facts,
        right=wrist_right,
        view=wrist_view,
    ),
    "p5": Prediction(
        question=(
            "The target below has eight rows. You pull it away from the arm along x. Four rows "
            "vanish first, the other four later. What have the first four in common?"
        ),
        options=(
            Option(
                "they face away: front −1",
                "The shoulder stands 70 mm ahead of axis 1. An arm that faces away has its "
                "shoulder on the far side: up to 140 mm more to reach. They are gone from x = "
                "{first:.0f} mm on, the others from {last:.0f} mm on.",
            ),
            Option(
                "the elbow: −1",
                "The two elbows are mirror images in the line from the shoulder to the wrist "
                "centre: one triangle, and both vanish together.",
                "an elbow has a reach of its own",
                "At the end of the reach both elbows are one: the arm is stretched.",
            ),
            Option(
                "the wrist: −1",
                "Both wrists start from the same wrist centre. Whether it is reached is settled "
                "before joints 4 to 6 turn.",
                "the wrist decides the reach",
                "No turn of the target about its wrist centre makes a row vanish.",
            ),
            Option(
                "nothing: it depends on the orientation",
                "The orientation shifts the wrist centre, for all rows alike. The shoulder's 70 mm "
                "make the difference.",
                "rows vanish one by one",
                "They vanish in fours in every orientation: two elbows times two wrists.",
            ),
        ),
        facts=pull_facts,
        right=pull_right,
        view=pull_view,
    ),
    "p6": Prediction(
        question=(
            "Two fronts, two elbows, two wrists: eight rows. The home pose is the pose of the "
            "posture 0, 0, 0, 0, 0, 0. In how many different ways does the arm reach it, limits "
            "left out?"
        ),
        options=(
            Option(
                "in one: all zeros",
                "{different} rows differ: the other fronts and elbows bring the wrist centre to "
                "its place as well.",
                "one posture for one pose",
                "Row 4 of the same pose faces away, with q1 = 180°.",
            ),
            Option(
                "in eight, as every pose that it can reach",
                "Rows 0 and 1 are the same posture here, so that {different} rows differ. And more "
                "ways exist than rows.",
                "always eight",
                "A pose far ahead has four rows, and one out of reach none.",
            ),
            Option(
                "in {different}: two rows are one",
                "{different} rows differ indeed. But the row that stands for two of them is no "
                "single way: joint 4 is free.",
                "every way is a row",
                "q4 = 20° with q6 = −20° gives the same pose, and no row holds it.",
            ),
            Option(
                "in no end of ways",
                "With joint 5 at zero axes 4 and 6 are one line. Turn joint 4 forward and joint 6 "
                "back by the same angle: the flange does not move. ik gives one of these ways, "
                "with q4 = 0.",
            ),
        ),
        facts=home_facts,
        right=home_right,
        view=home_view,
    ),
    "p7": Prediction(
        question=(
            "The target of this section moves for 20 s, and the arm follows with the flags 1, 1, "
            "1. Every pose exists. How much of the motion is inside all joint limits?"
        ),
        options=(
            Option(
                "all of it",
                "To exist is one thing, to be allowed another: the inverse knows no limits. {past} "
                "of {count} samples are past one.",
                "what exists is allowed",
                "At the start q5 stands at {q5}, its limit is {high5}.",
            ),
            Option(
                "all but a moment at the corner, at 10 s",
                "At the corner speeds jump, angles do not: every joint is inside there.",
                "a corner is a limit",
                "The last sample past a limit is at {last:.2f} s.",
            ),
            Option(
                "the last two thirds",
                "Past a limit: {past} of {count} samples, t = {first:.2f} to {last:.2f} s; "
                "{samples}. Joint 3 reaches {q3} (limit {high3}) and joint 5 {q5} (limit {high5}).",
            ),
            Option(
                "nothing: another configuration is needed",
                "From {last:.2f} s on every joint is inside its limits with these flags.",
                "one bad sample spoils the row",
                "A motion that begins at 7 s is inside all limits to its end.",
            ),
        ),
        facts=task_facts,
        right=task_right,
        view=task_view,
    ),
    "p8": Prediction(
        question=(
            "A joint turns slowly through half a turn, and the program writes its angle between "
            "−180° and 180°: 179.99°, then −179.99°. The difference quotient makes a false speed "
            "of it. You take samples twice as dense. What becomes of the false speed?"
        ),
        options=(
            Option(
                "it is halved: finer samples come nearer to the truth",
                "The step of the angle stays a whole turn, however dense the samples are. It is "
                "divided by half the time.",
                "finer is truer",
                "A real speed does not change with the step: {true:.3f} rad/s at both.",
            ),
            Option(
                "it stays",
                "The step of the angle stays, and the time between two samples is halved.",
                "a speed does not depend on the step",
                "{coarse:.0f} rad/s at 10 ms, {fine:.0f} rad/s at 5 ms.",
            ),
            Option(
                "it doubles",
                "A whole turn is divided by the step of time: {coarse:.0f} rad/s at 10 ms, "
                "{fine:.0f} rad/s at 5 ms. What grows with denser samples is no speed. (A central "
                "difference divides it by two steps: {central coarse:.0f} and {central fine:.0f} "
                "rad/s.) "
                "Unwrap first, then differentiate.",
            ),
            Option(
                "it is gone as soon as no sample falls on 180°",
                "No sample has to fall on it: the angle passes from one side to the other between "
                "two samples.",
                "a wrap needs a sample of its own",
                "179.99° and −179.99° are both away from 180°, and differ by almost a whole turn.",
            ),
        ),
        facts=spike_facts,
        right=spike_right,
        view=spike_view,
    ),
    "p9": Prediction(
        optional=True,
        question=(
            "A program finds the angle inside the triangle at the shoulder by the law of sines, "
            "with arcsin. The wrist centre comes to 100 mm from joint 2, and that angle is "
            "{obtuse:.0f}°. What does the program do?"
        ),
        options=(
            Option(
                "it stops, or gives NaN",
                "The sine is {sine:.2f}, and arcsin takes it without a complaint. NaN comes only "
                "above 1.",
                "a wrong formula shows itself",
                "The sine of {obtuse:.0f}° is the sine of {acute:.0f}° as well.",
            ),
            Option(
                "it reaches the place with the other elbow",
                "The other elbow mirrors the whole triangle. Here one angle is replaced, and the "
                "triangle does not close.",
                "a lost sign and a lost quadrant",
                "A mirrored triangle would miss by 0 mm, this one misses by {miss:.0f} mm.",
            ),
            Option(
                "it is right: sides and angles of a triangle fix each other",
                "Two angles have the same sine. The law of sines cannot tell {obtuse:.0f}° from "
                "{acute:.0f}°.",
                "the sine fixes the angle",
                "The angle is acute only while d is above {least:.0f} mm.",
            ),
            Option(
                "it gives a wrong place, without a word",
                "arcsin gives {acute:.0f}° for {obtuse:.0f}°: no error, no NaN, and the wrist "
                "centre {miss:.0f} mm away from its place.",
            ),
        ),
        facts=arcsin_facts,
        right=arcsin_right,
        view=arcsin_view,
    ),
    "p10": Prediction(
        optional=True,
        question=(
            "A row of ik says q6 = {q6}. Joint 6 may stand between −400° and 400°. At how many "
            "values may it stand so that the arm is in the same posture?"
        ),
        options=(
            Option(
                "at one: {q6}",
                "An angle and the same angle after a whole turn are one posture, and joint 6 has "
                "room for more than one turn.",
                "an angle is its number",
                "{back} is inside the limits as well.",
            ),
            Option(
                "at two: {q6} and {back}",
                "A whole turn the other way fits, too: the limit is {high}, not 360°.",
                "limits of one turn",
                "Joint 1, from −180° to 180°, has {q1} such value.",
            ),
            Option(
                "at three",
                "{values}: {q6} plus whole turns, as long as they lie inside the limits.",
            ),
            Option(
                "at no end of values",
                "Whole turns can be added without an end, but limits end them: two turns make "
                "750°.",
                "limits left out",
                "Without limits it would be so: a wheel has no end of values.",
            ),
        ),
        facts=turns_facts,
        right=turns_right,
        view=turns_view,
    ),
}
