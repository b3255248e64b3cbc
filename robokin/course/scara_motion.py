"""Lab 05, a SCARA moves: its exercises and predictions.

The answers to each exercise come first, right and wrong, then the predictions' numbers and views;
the tables stand at the end.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np

from .._arrays import Floats
from ..arms import SCARA, ScaraPose, follow, nearest
from ..motion import blend, differentiate, lin, ptp
from ..units import deg, mm, wrapped
from .exercises import words
from .mistakes import Mistake, Program, Tools
from .old import Fault, Function, Value
from .questions import Option, Prediction
from .told import apart, floats, one_number
from .variants import Numbers, dice

LAB = "scara_motion"
OBJECTIVES = (
    "tell the tool's angle, a sum of joint values, from joint 3, and choose the way round for the "
    "tool",
    "write a limit test that no sample deceives, with each joint in its own unit",
    "bring a motion back inside its limits with a blend, and keep its price (distance from via, "
    "acceleration, time) within bounds",
)


def _pose(x: float, y: float, z: float, angle: float) -> ScaraPose:
    return ScaraPose(np.array([x, y, z]) * mm, angle * deg)


# source 001, task 5 (listings 12 and 14), as in the lab
START, VIA, GOAL = _pose(200, 300, 120, 0), _pose(400, 100, 0, 180), _pose(200, -200, 200, 90)
ROW = SCARA.branch(+1)
DURATION = 20.0  # s
T = np.linspace(0, DURATION, 1001)
S = T / DURATION
LEVEL = 220.2 * mm  # l0: the height of the tool at q4 = 0, listing 4
STROKE = float(SCARA.limits[3, 1])
TURN = 2 * np.pi
MINUS = str.maketrans("-", "\N{MINUS SIGN}")


def _joints(path: ScaraPose) -> Floats:
    return follow(SCARA, SCARA.ik(path), ROW)


# --- 1: the least turn of the tool ----------------------------------------------------------------

LOW3, HIGH3 = (float(x) for x in SCARA.limits[2])
SLACK = 1e-9


def _short(to: Any, near: Any = 0.0) -> float:
    """The value of an angle, whole turns left out, nearest to another."""
    return float(wrapped(np.asarray(to, dtype=float), np.asarray(near, dtype=float)))


def _into(q3: float) -> float:
    """By whole turns into the limits of joint 3."""
    up = TURN * max(np.ceil((LOW3 - SLACK - q3) / TURN), 0)
    return float(q3 + up - TURN * max(np.ceil((q3 - HIGH3 - SLACK) / TURN), 0))


def _same_elbow(q0: Floats, position: Floats, angle: float) -> Floats:
    row: Floats = SCARA.ik(ScaraPose(position, angle))[SCARA.branch(1 if q0[1] >= 0 else -1)]
    return row


def _with(q: Floats, q3: float) -> Floats:
    return np.array([q[0], q[1], q3, q[3]])


def _least_turn(tools: Tools, q0: Floats, position: Floats, angle: float) -> Floats:
    q = _same_elbow(q0, position, angle)
    now = float(q0[:3].sum())
    end = float(tools.short(angle, now))
    return _with(q, _into(end - float(q[0]) - float(q[1])))


def _turn_cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    def case(q0: Sequence[float], place: Sequence[float], angle: float) -> tuple[Any, ...]:
        return np.array(q0) * [deg, deg, deg, mm], np.array(place) * mm, angle * deg

    cases = [
        case([0, 90, 0, 100], [200, 250, 120.2], 110),  # the arm stays, the tool turns by 20
        case([0, 90, 0, 100], [200, 250, 120.2], -110),  # 160 to the left, through 180
        case([0, 90, 0, 100], [200, 250, 120.2], 450),  # one turn on: it stays
        case([0, 90, -90, 150], [200, 250, 70.2], -176),  # joint 4 is no angle
        case([-100, 40, 0, 20], [-150, 300, 150.2], 150),  # joints 1 and 2 turn by 200
        case([120, -50, 30, 20], [-100, -300, 150.2], -80),
        case([30, 60, 80, 50], [300, 200, 170.2], -170),  # the left way over 180
        case([30, -60, -130, 50], [300, -200, 100.2], 170),  # the right way, the other elbow
        case([-90, 40, 0, 20], [100, 350, 150.2], 100),  # joints 1 and 2 turn much
        case([-110, 60, 20, 20], [-150, 300, 150.2], 60),
        case([110, -60, -20, 20], [-150, -300, 150.2], -60),
        case([100, 60, 150, 0], [300, 150, 220.2], -20),  # 310 now, 340 is nearer than -20
        case([100, 60, 390, 0], [300, 150, 220.2], 170),  # 550 now
        case([-100, -60, -390, 0], [300, -150, 220.2], -170),
        case([20, 60, 380, 90], [150, 300, 100.2], 160),  # the limit of joint 3 counts
        case([60, 90, 385, 90], [300, -150, 100.2], 190),
        case([60, 90, 395, 90], [250, -250, 60.2], 150),
        case([-20, -60, -380, 90], [150, -300, 100.2], -160),
        case([-60, -90, -385, 90], [300, 150, 100.2], -190),
        case([100, -60, -230, 90], [-214, 81, 100.2], -20),  # joints 1 and 2 turn by -290
        case([60, 90, 300, 90], [300, -150, 100.2], 1170),  # three turns on
        case([60, 90, -300, 90], [300, -150, 100.2], -1000),
        case([30, 60, 80, 50], [300, 200, 170.2], -1250),  # four turns on
        case([30, -60, -130, 50], [300, -200, 100.2], 1250),
        case([0, 90, -90, 20], [200, 250, 50.2], 176),  # joint 4 moves by 150 mm: no angle, either
        case([0, 90, -90, 170], [200, 250, 200.2], -176),
        case([0, 0, 90, 100], [200, 250, 120.2], 110),  # the arm is stretched: 0 is positive
        case([120, 0, -30, 50], [200, 250, 120.2], -110),  # the other elbow would be nearer
    ]
    while len(cases) < 46:
        q0 = np.array([*rng.uniform([-139, 20, -399], [139, 140, 399]).round(1), 30.0])
        q0[1] *= rng.choice([-1, 1])
        q0 = q0 * [deg, deg, deg, mm]
        q = np.array([*rng.uniform([-135, 25], [135, 140]).round(1) * deg, 0.0, 0.1])
        q[1] *= np.sign(q0[1])
        if len(cases) % 2:  # joints 1 and 2 turn much
            q[0], q0[2] = -np.sign(q0[0]) * abs(q[0]), q0[2] / 2
        place = SCARA.fk(q).translation.round(4)
        angle = round(rng.uniform(-400, 400), 1) * deg
        end = angle - _same_elbow(q0, place, angle)[:2].sum()
        clear = abs(abs(_short(angle - q0[:3].sum())) - np.pi) > 0.05  # a half turn: two ways
        clear &= abs(_short(end - HIGH3)) > 0.02 and abs(_short(end - LOW3)) > 0.02
        if clear:
            cases.append((q0, place, angle))
    return cases


def _posture_form(result: Any, case: tuple[Any, ...]) -> Floats:
    wanted = "wanted four joint values, q1 to q3 in radians and q4 in metres"
    try:
        values = np.squeeze(floats(result))
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {words(result)}") from None
    if values.shape != (4,):
        raise ValueError(f"{wanted}, got {words(result)}")
    return values


def _units_told(wanted: Floats, yours: Floats) -> str | None:
    """A sentence if joints 1 and 2 are right in degrees."""
    if not (abs(yours[:2] * deg - wanted[:2]) <= 1e-6).all():
        return None
    if (abs(yours[:2] - wanted[:2]) <= 1e-6).all():
        return None
    return (
        f"joint 2 is {yours[1]:.1f}, which is right in degrees; wanted are radians, "
        f"{wanted[1]:.4f}, and metres for joint 4"
    ).translate(MINUS)


def _elbow_changed(case: tuple[Any, ...], yours: Floats) -> bool:
    """Whether joints 1 and 2 are those of the other row of ik, up to whole turns."""
    q0, position, angle = case
    other = SCARA.ik(ScaraPose(position, angle))[SCARA.branch(-1 if q0[1] >= 0 else 1)]
    return bool((abs(wrapped(yours[:2] - other[:2])) <= 1e-6).all())


def _turn_law(case: tuple[Any, ...], yours: Floats) -> str | None:
    q0, _, _ = case
    wanted = _least_turn(Tools(), *case)
    if (abs(yours - wanted) <= 1e-6).all():
        return None
    now, end, got = (float(q[:3].sum()) / deg for q in (q0, wanted, yours))
    told = _units_told(wanted, yours)
    if told:
        return told
    for k in (0, 1):
        if not abs(yours[k] - wanted[k]) <= 1e-6:
            if _elbow_changed(case, yours):
                counts = ", which counts as positive" if q0[1] == 0 else ""
                return (
                    f"the elbow has changed its side: joint 2 stands at {q0[1] / deg:.1f}° in q0"
                    f"{counts}, and yours ends at {yours[1] / deg:.1f}°; {wanted[1] / deg:.1f}° is "
                    f"right, with joint 1 at {wanted[0] / deg:.1f}°"
                ).translate(MINUS)
            at, is_at = apart(wanted[k] / deg, yours[k] / deg)
            return (
                f"joint {k + 1} should be at {at}° (with the elbow of q0), and is at {is_at}°"
            ).translate(MINUS)
    if not abs(yours[3] - wanted[3]) <= 1e-6:
        at, is_at = apart(wanted[3] / mm, yours[3] / mm)
        return f"joint 4 should be at {at} mm, and is at {is_at} mm".translate(MINUS)
    turns, yours_turns = apart(end - now, got - now)
    third, yours_third = apart(wanted[2] / deg, yours[2] / deg)
    return (
        f"the tool stands at {now:.1f}°; it should turn by {turns}°, and then stands at "
        f"{end:.1f}°, with joint 3 at {third}°; yours turns it by {yours_turns}°, with joint 3 at "
        f"{yours_third}°"
    ).translate(MINUS)


def _same_posture(a: Floats, b: Floats) -> bool:
    return bool(np.allclose(a, b, rtol=0, atol=1e-6, equal_nan=True))


Third = Callable[[Floats, Floats, float], float]


def _third(choose: Third) -> Program:
    """A program that is right but for joint 3: choose(q0, ik's row, angle)."""

    def program(q0: Floats, position: Floats, angle: float) -> Floats:
        q = _same_elbow(q0, position, angle)
        return _with(q, choose(q0, q, angle))

    return program


def _turned(q0: Floats, q: Floats, angle: float) -> float:
    """Joint 3 for the least turn of the tool, limits or not."""
    return float(_short(angle, q0[:3].sum()) - q[0] - q[1])


def _tried(turns: Sequence[int], limits: bool) -> Callable[[Floats, Floats, float], float]:
    """The least turn among the angle and so many whole turns of it."""

    def choose(q0: Floats, q: Floats, angle: float) -> float:
        ends = [float(angle + TURN * k - q[0] - q[1]) for k in turns]
        inside = [x for x in ends if LOW3 <= x <= HIGH3] if limits else ends
        now = float(q0[:3].sum() - q[0] - q[1])
        return min(inside or ends, key=lambda x: abs(x - now))

    return choose


def _among(cost: Callable[[float, float], float]) -> Callable[[Floats, Floats, float], float]:
    """The cheapest value of joint 3 inside the limits; `now`: where it would not turn the tool."""

    def choose(q0: Floats, q: Floats, angle: float) -> float:
        ends = [float(q[2] + TURN * k) for k in range(-2, 3)]
        now = float(q0[:3].sum() - q[0] - q[1])
        return min((x for x in ends if LOW3 <= x <= HIGH3), key=lambda x: cost(x, now))

    return choose


def _tried_else_as_given(q0: Floats, q: Floats, angle: float) -> float:
    """One turn up and down, and where none of them suits, the angle as it is given."""
    ends = [float(angle + TURN * k - q[0] - q[1]) for k in (-1, 0, 1)]
    inside = [x for x in ends if LOW3 <= x <= HIGH3]
    now = float(q0[:3].sum() - q[0] - q[1])
    return min(inside, key=lambda x: abs(x - now)) if inside else ends[1]


def _by_lin(q0: Floats, position: Floats, angle: float) -> Floats:
    """The end of a LIN: the angle goes from its number at the start to the number given."""
    row = SCARA.branch(1 if q0[1] >= 0 else -1)
    here = ScaraPose(SCARA.fk(q0).translation, float(q0[:3].sum()))
    path = lin(here, ScaraPose(position, angle), S)
    end: Floats = follow(SCARA, SCARA.ik(path), row)[-1]
    return end


def _nearest_two(q0: Floats, position: Floats, angle: float) -> Floats:
    """The row whose first two joints are nearest; the rest is right."""
    rows = SCARA.ik(ScaraPose(position, angle))
    q = rows[np.nanargmin(abs(rows[:, :2] - q0[:2]).sum(axis=-1))]
    return _with(q, _into(_turned(q0, q, angle)))


def _any_elbow(q0: Floats, position: Floats, angle: float) -> Floats:
    found: Floats = nearest(SCARA, SCARA.ik(ScaraPose(position, angle)), q0)
    return found


def _nearer(count: int, order: float, whole: bool, third: Third) -> Program:
    """The row whose first joints are nearest to q0, by sum, length or greatest change."""

    def program(q0: Floats, position: Floats, angle: float) -> Floats:
        rows = SCARA.ik(ScaraPose(position, angle))
        change = rows[:, :count] - q0[:count]
        change = wrapped(change) if whole else change
        q = rows[np.nanargmin(np.linalg.norm(change, ord=order, axis=-1))]
        return _with(q, third(q0, q, angle))

    return program


def _nearer_of_package(third: Third) -> Program:
    """The row that `nearest` takes, then joint 3 anew."""

    def program(q0: Floats, position: Floats, angle: float) -> Floats:
        q = _any_elbow(q0, position, angle)
        return _with(q, third(q0, q, angle))

    return program


def _in_other_units(mistakes: Sequence[Mistake]) -> Iterator[Mistake]:
    """These mistakes, and the posture in degrees: three joints, with the stroke in mm, or all."""
    for units in ([deg, deg, deg, 1], [deg, deg, deg, mm], [deg] * 4):
        for name, says, program in mistakes:

            def spoilt(*case: Any, units: Any = units, program: Program = program) -> Any:
                return program(*case) / np.array(units)

            yield Mistake(f"degrees for radians, and {name}", f"{IN_DEGREES} And: {says}", spoilt)


def _zero_negative(program: Program) -> Program:
    """The same program, but for a stretched arm: there it takes joint 2 at 0 for negative."""
    return lambda q0, position, angle: program(
        np.where([False, q0[1] == 0, False, False], -1e-12, q0), position, angle
    )


def _elbow(sign: int, *, limits: bool = True) -> Program:
    def program(q0: Floats, position: Floats, angle: float) -> Floats:
        q = SCARA.ik(ScaraPose(position, angle))[SCARA.branch(sign)]
        q3 = _turned(q0, q, angle)
        return _with(q, _into(q3) if limits else q3)

    return program


def _changed(what: Callable[[Floats, Floats], Any]) -> Program:
    """The right posture, then spoilt: what(right, q0)."""

    def program(q0: Floats, position: Floats, angle: float) -> Any:
        return what(_least_turn(Tools(), q0, position, angle), q0)

    return program


NO_LIMITS = "The limits of joint 3, -400° to 400°, are not looked at: take the next way round then."
NEARER = (
    "Of both rows of ik the nearer one is taken: now and then that is the other elbow, and the arm "
    "would have to pass the stretched posture. Choose the row by the sign of q0[1]."
)
IN_DEGREES = "The angles are returned in degrees; radians are wanted, as SCARA.ik gives them."
ZERO = "Joint 2 at 0 counts as positive here, the arm stretched: ask for q0[1] >= 0, not for > 0."
ANY_TURN = "Then choose joint 3 among its values q3 + 2 pi k."
NEARER_MISTAKES = tuple(
    Mistake("the nearer posture, elbow changed", f"{NEARER} {also}".strip(), program)
    for third, also in (
        (lambda q0, q, angle: _into(_turned(q0, q, angle)), ""),
        (_turned, NO_LIMITS),
        (lambda q0, q, angle: float(q[2]), ANY_TURN),
    )
    for program in (
        *(
            _nearer(count, order, whole, third)
            for count, order in ((1, 1), (2, 1), (2, 2), (2, np.inf), (3, 1), (3, 2), (3, np.inf))
            for whole in (False, True)
            if (count, order, whole, also) != (2, 1, False, "")  # stands below by itself
            if (order, also) != (np.inf, ANY_TURN)
        ),
        *(() if also == ANY_TURN else (_nearer_of_package(third),)),
    )
)
TURN_MISTAKES = (
    *NEARER_MISTAKES,
    Mistake(
        "joint 2 at 0 taken for negative",
        ZERO,
        _zero_negative(lambda q0, position, angle: _least_turn(Tools(), q0, position, angle)),
    ),
    Mistake(
        "the least turn of joint 3",
        "Joint 3 turns as little as it can. The tool is turned by joints 1 and 2 as well: its "
        "angle is q1 + q2 + q3, and that is what should turn least.",
        _third(lambda q0, q, angle: _into(float(_short(q[2], q0[2])))),
    ),
    Mistake(
        "the least turn of joint 3, without the limits",
        "Joint 3 turns as little as it can. The tool is turned by joints 1 and 2 as well: its "
        "angle is q1 + q2 + q3, and that is what should turn least. " + NO_LIMITS,
        _third(lambda q0, q, angle: float(_short(q[2], q0[2]))),
    ),
    Mistake(
        "the row of ik as it is",
        "Joint 3 stays between -180° and 180°, as ik gives it, whatever the tool does now. Choose "
        "among its values q3 + 2 pi k.",
        _third(lambda q0, q, angle: float(q[2])),
    ),
    Mistake(
        "the limits are not looked at",
        "The tool turns least, and joint 3 is led past 400° or -400°. Take the next way round "
        "then.",
        _third(_turned),
    ),
    Mistake(
        "clipped at the limit",
        "Joint 3 is clipped at its limit: the tool then has another angle. Take the next way "
        "round.",
        _third(lambda q0, q, angle: float(np.clip(_turned(q0, q, angle), LOW3, HIGH3))),
    ),
    Mistake(
        "the angle as it is given",
        "The tool goes to the number that is given. It looks the same at angle + 2 pi k: take the "
        "one nearest to where it stands.",
        _third(lambda q0, q, angle: float(angle - q[0] - q[1])),
    ),
    Mistake(
        "the angle as a number, by LIN",
        "LIN takes the angle as a number: it turns the tool to the one that is given. Choose k "
        "first: of angle + 2 pi k the one nearest to where the tool stands.",
        _by_lin,
    ),
    Mistake(
        "the angle as it is given, put into the limits",
        "The tool goes to the number that is given, moved by whole turns only where joint 3 is "
        "past its limit. Take the angle + 2 pi k nearest to where the tool stands.",
        _third(lambda q0, q, angle: _into(float(angle - q[0] - q[1]))),
    ),
    Mistake(
        "the angle wrapped into -180 to 180 degrees",
        "The angle is wrapped: that is the value nearest to 0, not nearest to where the tool "
        "stands.",
        _third(lambda q0, q, angle: _into(float(_short(angle) - q[0] - q[1]))),
    ),
    Mistake(
        "the angle wrapped into 0 to 360 degrees",
        "The angle is taken modulo 360°. Wanted is the value nearest to where the tool stands.",
        _third(lambda q0, q, angle: _into(float(angle % TURN - q[0] - q[1]))),
    ),
    Mistake(
        "always to the left",
        "The turn modulo 360° is never negative: the tool always turns to the left.",
        _third(
            lambda q0, q, angle: _into(
                float(q0[:3].sum() + (angle - q0[:3].sum()) % TURN - q[0] - q[1])
            )
        ),
    ),
    Mistake(
        "always to the left, without the limits",
        "The turn modulo 360° is never negative: the tool always turns to the left. " + NO_LIMITS,
        _third(
            lambda q0, q, angle: float(q0[:3].sum() + (angle - q0[:3].sum()) % TURN - q[:2].sum())
        ),
    ),
    Mistake(
        "the tool's angle taken for joint 3",
        "Joint 3 is set to the tool's angle. The angle is q1 + q2 + q3: joint 3 has to make up for "
        "what joints 1 and 2 turn.",
        _third(lambda q0, q, angle: _into(float(_short(angle, q0[2])))),
    ),
    Mistake(
        "the tool's angle taken for joint 3, at the start",
        "The turn is counted from joint 3. Where the tool stands is q1 + q2 + q3 of q0.",
        _third(lambda q0, q, angle: _into(float(_short(angle, q0[2]) - q[0] - q[1]))),
    ),
    Mistake(
        "joint 2 is left out",
        "The tool's angle is q1 + q2 + q3: joint 2 is missing in it.",
        _third(lambda q0, q, angle: _into(float(_short(angle, q0[0] + q0[2]) - q[0]))),
    ),
    Mistake(
        "joint 4 is added to an angle",
        "The sum of q0 holds joint 4, which is a length: sum the first three only.",
        _third(lambda q0, q, angle: _into(float(_short(angle, q0.sum()) - q[0] - q[1]))),
    ),
    Mistake(
        "joint 4 is added to both angles",
        "The tool's angle is q1 + q2 + q3, at the start and at the end: joint 4 is a length.",
        _third(
            lambda q0, q, angle: _into(float(_short(angle + q[3], q0.sum()) - q[3] - q[0] - q[1]))
        ),
    ),
    Mistake(
        "joints 1 and 2 of the start",
        "Joint 3 turns by as much as the tool should: it makes up for joints 1 and 2 where they "
        "are now. At the end they stand elsewhere.",
        _third(lambda q0, q, angle: _into(float(_short(angle, q0[:3].sum()) - q0[0] - q0[1]))),
    ),
    Mistake(
        "the limits of the tool's angle",
        "The limits -400° and 400° are those of joint 3, not of the tool's angle.",
        _third(lambda q0, q, angle: _into(float(_short(angle, q0[:3].sum()))) - q[0] - q[1]),
    ),
    Mistake(
        "only one turn",
        "Only one whole turn up and down is tried. The tool's angle and joint 3 go farther: take "
        "more of them.",
        _third(_tried((0, 1, -1), True)),
    ),
    *(
        Mistake(
            f"only {name} turns",
            f"Only {name} whole turns up and down are tried. The angle given may be more turns "
            "away from where the tool stands.",
            _third(_tried(sorted(range(-most, most + 1), key=abs), True)),
        )
        for name, most in (("two", 2), ("three", 3))
    ),
    Mistake(
        "only one turn up or down, else the angle as it is given",
        "Only one whole turn up and down is tried. The tool's angle and joint 3 go farther: take "
        "more of them.",
        _third(_tried_else_as_given),
    ),
    Mistake(
        "the nearest two joints choose the elbow",
        "The row is chosen by joints 1 and 2: now and then that is the other elbow, and the arm "
        "would have to pass the stretched posture. Choose the row by the sign of q2.",
        _nearest_two,
    ),
    Mistake(
        "only one turn, without the limits",
        "Only one whole turn up and down is tried; there may be need of more. " + NO_LIMITS,
        _third(_tried((0, 1, -1), False)),
    ),
    Mistake(
        "only turns up",
        "Whole turns are added only. It may need a turn down.",
        _third(_tried((0, 1, 2, 3), True)),
    ),
    Mistake(
        "only turns down",
        "Whole turns are taken away only. It may need a turn up.",
        _third(_tried((0, -1, -2, -3), True)),
    ),
    Mistake(
        "half turns",
        "pi is half a turn: the tool would stand the other way. Whole turns are 2 pi.",
        _third(lambda q0, q, angle: float(_half_turns(q0, angle) - q[0] - q[1])),
    ),
    Mistake(
        "another elbow",
        "Of both rows of ik the one with the least travel is taken. The elbow should stay on the "
        "side where it is: the sign of q0[1].",
        _any_elbow,
    ),
    Mistake(
        "elbow +1 always",
        "The elbow should stay on the side where it is: row SCARA.branch(+1) for q0[1] >= 0, "
        "SCARA.branch(-1) else.",
        _elbow(+1),
    ),
    Mistake(
        "elbow +1 always, without the limits",
        "The elbow should stay on the side where it is: row SCARA.branch(+1) for q0[1] >= 0, "
        "SCARA.branch(-1) else. " + NO_LIMITS,
        _elbow(+1, limits=False),
    ),
    Mistake(
        "joints 1 and 2 of the start, without the limits",
        "Joint 3 turns by as much as the tool should: it makes up for joints 1 and 2 where they "
        "are now. Joints 1 and 2 turn the tool as well: joint "
        "3 is the tool's angle at the end less q1 and q2. " + NO_LIMITS,
        _third(lambda q0, q, angle: float(q0[2]) + _short(angle - q0[:3].sum())),
    ),
    Mistake(
        "the other elbow",
        "It ends with the elbow on the other side: look at the sign of q0[1] again.",
        lambda q0, position, angle: _elbow(-1 if q0[1] >= 0 else 1)(q0, position, angle),
    ),
    Mistake(
        "elbow -1 always",
        "The elbow should stay on the side where it is: row SCARA.branch(+1) for q0[1] >= 0, "
        "SCARA.branch(-1) else.",
        _elbow(-1),
    ),
    Mistake(
        "the height for the stroke",
        "Joint 4 is set to the height z. It is a stroke downwards: q4 = l0 - z, as ik gives it.",
        _changed(lambda q, q0: [*q[:3], LEVEL - q[3]]),
    ),
    Mistake(
        "the turn for the end",
        "This is by how much each joint turns. Wanted is the posture at the end.",
        _changed(lambda q, q0: q - q0),
    ),
    Mistake(
        "the tool's angle taken for joint 3, as it is given",
        "Joint 3 is set to the tool's angle. The angle is q1 + q2 + q3: joint 3 has to make up for "
        "what joints 1 and 2 turn.",
        _third(lambda q0, q, angle: angle),
    ),
    Mistake(
        "the tool's angle taken for joint 3, without the limits",
        "Joint 3 is set to the tool's angle. The angle is q1 + q2 + q3: joint 3 has to make up for "
        "what joints 1 and 2 turn. " + NO_LIMITS,
        _third(lambda q0, q, angle: _short(angle, q0[2])),
    ),
    Mistake(
        "the tool's angle in place of joint 3",
        "The way round is right, and the third number is the tool's angle at its end. Take q1 and "
        "q2 away from it: that leaves joint 3.",
        _changed(lambda q, q0: [q[0], q[1], q[:3].sum(), q[3]]),
    ),
    Mistake(
        "the start is wrapped",
        "The turn is counted from a wrapped angle. The tool stands at q1 + q2 + q3 of q0 as it is: "
        "a joint that is a turn on has to turn back for a turn.",
        _third(
            lambda q0, q, angle: _into(_short(angle, _short(q0[:3].sum())) - float(q[0] + q[1]))
        ),
    ),
    Mistake(
        "the start is wrapped, without the limits",
        "The turn is counted from a wrapped angle. The tool stands at q1 + q2 + q3 of q0 as it is. "
        + NO_LIMITS,
        _third(lambda q0, q, angle: _short(angle, _short(q0[:3].sum())) - float(q[0] + q[1])),
    ),
    Mistake(
        "the longest way",
        "Of the values inside the limits the one with the greatest turn is taken.",
        _third(_among(lambda x, now: -abs(x - now))),
    ),
    Mistake(
        "the lowest value inside the limits",
        "Of the values inside the limits the lowest is taken. Wanted is the least abs(turn).",
        _third(_among(lambda x, now: x)),
    ),
    Mistake(
        "the highest value inside the limits",
        "Of the values inside the limits the highest is taken. Wanted is the least abs(turn).",
        _third(_among(lambda x, now: -x)),
    ),
    Mistake(
        "joint 2 is left out at the end",
        "Joint 3 is the tool's angle less q1 and q2: joint 2 is missing.",
        _third(lambda q0, q, angle: _into(_short(angle, q0[:3].sum()) - float(q[0]))),
    ),
    Mistake(
        "joint 2 is left out at the end, without the limits",
        "Joint 3 is the tool's angle less q1 and q2: joint 2 is missing. " + NO_LIMITS,
        _third(lambda q0, q, angle: _short(angle, q0[:3].sum()) - float(q[0])),
    ),
    Mistake(
        "joints 1 and 2 are added",
        "Joint 3 is the tool's angle less q1 and q2, not plus: the three add up to the angle.",
        _third(lambda q0, q, angle: _into(_short(angle, q0[:3].sum()) + float(q[0] + q[1]))),
    ),
    Mistake(
        "joints 1 and 2 are added, without the limits",
        "Joint 3 is the tool's angle less q1 and q2, not plus: the three add up to the angle. "
        + NO_LIMITS,
        _third(lambda q0, q, angle: _short(angle, q0[:3].sum()) + float(q[0] + q[1])),
    ),
    Mistake(
        "ik's value where the short way leads out",
        "Where the least turn leads joint 3 out of its limits you take ik's own value. Another one "
        "inside the limits may turn the tool less.",
        _third(
            lambda q0, q, angle: x if LOW3 <= (x := _turned(q0, q, angle)) <= HIGH3 else float(q[2])
        ),
    ),
    Mistake(
        "one turn of ik's value, without the limits",
        "Of ik's joint 3 and one turn up and down the least turn of the tool is taken. "
        + NO_LIMITS,
        _third(lambda q0, q, angle: _near_row(q0, q)),
    ),
    Mistake(
        "360 for 2 pi",
        "A whole turn is 2 pi here: angles are in radians.",
        _third(lambda q0, q, angle: _by_360(_turned(q0, q, angle))),
    ),
    Mistake(
        "joint 4 in mm",
        "Joint 4 is in metres here.",
        _changed(lambda q, q0: [*q[:3], q[3] / mm]),
    ),
    Mistake(
        "degrees and mm",
        "Angles are in radians here, and joint 4 in metres.",
        _changed(lambda q, q0: [*(q[:3] / deg), q[3] / mm]),
    ),
    Mistake(
        "joint 3 in degrees",
        "Angles are in radians here.",
        _changed(lambda q, q0: [q[0], q[1], q[2] / deg, q[3]]),
    ),
    Mistake(
        "all angles in degrees",
        "The angles are returned in degrees; radians are wanted, as SCARA.ik gives them.",
        _changed(lambda q, q0: [*(q[:3] / deg), q[3]]),
    ),
)


_NAMES = (
    "the least turn of joint 3",
    "the least turn of joint 3, without the limits",
    "the row of ik as it is",
    "the limits are not looked at",
    "the angle as it is given",
    "only one turn",
    "only one turn, without the limits",
    "elbow +1 always",
)
TURN_MISTAKES += (
    *_in_other_units([m for m in TURN_MISTAKES if m.name in _NAMES]),
    *(
        Mistake(f"joint 2 at 0 taken for negative, and {name}", f"{ZERO} And: {says}", spoilt)
        for name, says, program in TURN_MISTAKES
        if name in _NAMES[:-1]
        for spoilt in [_zero_negative(program)]
    ),
)


def _near_row(q0: Floats, q: Floats) -> float:
    now = float(q0[:3].sum() - q[0] - q[1])
    return min((float(q[2] + TURN * k) for k in (-1, 0, 1)), key=lambda x: abs(x - now))


def _by_360(q3: float) -> float:
    """Down and then up by 360, as degrees would be, until it is inside: two loops of `while`."""
    while q3 > HIGH3:
        q3 -= 360
    while q3 < LOW3:
        q3 += 360
    return q3


def _half_turns(q0: Floats, angle: float) -> float:
    now = float(q0[:3].sum())
    return float(angle + np.pi * np.round((now - angle) / np.pi))


# --- 2: a limit test ------------------------------------------------------------------------------

LOW, HIGH = SCARA.limits.T


def _inside(q: Floats, low: Floats, high: Floats) -> bool:
    return bool(((q >= low) & (q <= high)).all())


def _limits(joint: int, low: float, high: float) -> Program:
    """Right, but for the limits of one joint."""
    lows, highs = LOW.copy(), HIGH.copy()
    lows[joint - 1], highs[joint - 1] = low, high
    return lambda q: _inside(q, lows, highs)


def _wrap(q: Floats) -> Floats:
    return np.concatenate([wrapped(q[:, :3]), q[:, 3:]], axis=1)


def _margin(size: float, *, nan: bool) -> Mistake:
    """Every limit moved outwards, in rad and m alike; with NaN seen or not."""
    says = (
        "Every limit is moved outwards by more than the 10^-6 rad or m that may pass: a thousandth "
        "is 1 mm for the stroke."
    )
    if nan:
        return Mistake("a margin too wide", says, lambda q: _inside(q, LOW - size, HIGH + size))
    return Mistake(
        "a margin too wide, and NaN passes",
        says + " And a comparison with NaN is always False: ask whether all values are inside.",
        lambda q: not ((q < LOW - size) | (q > HIGH + size)).any(),
    )


def _left_out(step: int, *, nan: bool, last: bool) -> Mistake:
    """Not every sample is asked; with NaN seen or not, the last sample asked or not."""

    def program(q: Floats) -> bool:
        asked = np.append(q[::step], q[-1:], axis=0) if last else q[::step]
        return _inside(asked, LOW, HIGH) and not (nan and np.isnan(q).any())

    return Mistake(
        "samples are left out",
        "It does not look at every sample. A single one past a limit is too much: ask every one.",
        program,
    )


LEFT_OUT = tuple(
    _left_out(step, nan=nan, last=last)
    for step, last in ((2, False), (3, False), (10, False), (10, True))  # 5 is found as 10, 4 as 3
    for nan in (False, True)
)
LIMIT_MISTAKES = (
    *(_margin(size, nan=nan) for size in (1e-5, 1e-3, 1e-2) for nan in (True, False)),
    Mistake(
        "the stroke is never tested",
        "It looks at three joints and leaves out the last. The last joint has its limits, too, in "
        "metres.",
        lambda q: _inside(q[:, :3], LOW[:3], HIGH[:3]),
    ),
    *(
        Mistake(
            f"joint {joint} is never tested",
            f"Joint {joint} passes wherever it is. All four joints have limits." + more,
            _limits(joint, -np.inf, np.inf),
        )
        for joint, more in (
            (1, ""),
            (2, ""),
            (3, " Wrapped into -180° to 180° it would never pass 400°: compare it as it is."),
        )
    ),
    Mistake(
        "the stroke's lower limit is never tested",
        "A stroke below 0 passes. Each joint has two limits.",
        _limits(4, -np.inf, STROKE),
    ),
    Mistake(
        "the stroke's upper limit is never tested",
        "Any stroke above 0 passes. Each joint has two limits, the stroke's is 0.18 m.",
        _limits(4, 0.0, np.inf),
    ),
    Mistake(
        "the stroke's limit in mm",
        "It compares metres with 180. Limits and strokes are both in metres: 0.18.",
        _limits(4, 0.0, 180.0),
    ),
    Mistake(
        "the stroke's limit turned into radians",
        "It takes 180 mm for 180°, and that is 3.14. Its limit is a length, 0.18 m.",
        _limits(4, 0.0, 180 * deg),
    ),
    Mistake(
        "the height for the stroke",
        "It tests the height l0 - q4 instead of q4. SCARA.limits are limits of the joint values.",
        lambda q: _inside(np.append(q[:, :3], LEVEL - q[:, 3:], axis=1), LOW, HIGH),
    ),
    Mistake(
        "only the ends",
        "It looks at the first and the last sample. Good ends do not make "
        "a good path: ask every sample.",
        lambda q: _inside(q[[0, -1]], LOW, HIGH),
    ),
    Mistake(
        "only the ends",
        "It asks the first and the last sample for the limits. Good ends do not make a good path "
        "(section 4): ask every sample.",
        lambda q: bool(np.isfinite(q).all()) and _inside(q[[0, -1]], LOW, HIGH),
    ),
    *LEFT_OUT,
    Mistake(
        "only the first sample",
        "It looks at the first sample only. Ask every sample.",
        lambda q: _inside(q[:1], LOW, HIGH),
    ),
    Mistake(
        "only the last sample",
        "It looks at the last sample only. Ask every sample.",
        lambda q: _inside(q[-1:], LOW, HIGH),
    ),
    Mistake(
        "angles wrapped first",
        "It wraps the angles into -180° to 180° and compares then: 410° passes for 50°. (So does "
        "robokin's within, which judges postures.) Compare the angles as they "
        "are.",
        lambda q: _inside(_wrap(q), LOW, HIGH),
    ),
    Mistake(
        "joint 3 kept in -180 to 180 degrees",
        "It allows joint 3 from -180° to 180° only. It may turn to 400°: the angles are unwrapped.",
        _limits(3, -np.pi, np.pi),
    ),
    Mistake(
        "only upper limits",
        "It does not look at the lower limits. Each joint has two.",
        lambda q: bool((q <= HIGH).all()),
    ),
    Mistake(
        "only lower limits",
        "It does not look at the upper limits. Each joint has two.",
        lambda q: bool((q >= LOW).all()),
    ),
    Mistake(
        "the lower limit taken for minus the upper one",
        "It compares abs(q) with the upper limit, and the stroke begins at 0. Compare "
        "with both limits.",
        lambda q: bool((abs(q) <= HIGH).all()),
    ),
    Mistake(
        "the limits themselves are refused",
        "It asks for less, not for less or equal. A joint at its limit is inside: q4 = 0, say.",
        lambda q: bool(((q > LOW) & (q < HIGH)).all()),
    ),
    Mistake(
        "NaN passes",
        "A row of NaN, out of reach, is not inside. A comparison with NaN is always False: ask of "
        "every row whether all its values are inside.",
        lambda q: not ((q < LOW) | (q > HIGH)).any(),
    ),
    Mistake(
        "single NaN samples are left out",
        "A row of NaN passes if other rows are numbers. A sample out of reach is not inside, be it "
        "a single one.",
        lambda q: bool(
            np.isfinite(q).any()
            and (np.fmin.reduce(q) >= LOW).all()
            and (np.fmax.reduce(q) <= HIGH).all()
        ),
    ),
    Mistake(
        "any joint for all joints",
        "It is content if one joint is inside. All four have to be.",
        lambda q: bool(((q >= LOW) & (q <= HIGH)).any(axis=1).all()),
    ),
    Mistake(
        "any sample for all samples",
        "It is content if one sample is inside. All of them have to be.",
        lambda q: bool(((q >= LOW) & (q <= HIGH)).all(axis=1).any()),
    ),
    Mistake(
        "the limits of joint 1 for joint 2",
        "It holds joint 2 in -140° to 140°. Its own limits are -150° and 150°.",
        _limits(2, float(LOW[0]), float(HIGH[0])),
    ),
    Mistake(
        "the limits of joint 2 for joint 1",
        "It lets joint 1 turn to 150°. Its own limits are -140° and 140°.",
        _limits(1, float(LOW[1]), float(HIGH[1])),
    ),
    Mistake(
        "the limits of joint 3 for every angle",
        "It lets every angle go to 400°. Joints 1 and 2 have their own limits.",
        lambda q: _inside(q, np.array([LOW3, LOW3, LOW3, 0]), np.array([HIGH3] * 3 + [STROKE])),
    ),
    Mistake(
        "the mean of the motion",
        "It tests the mean of all samples. A short time past a limit is too much.",
        lambda q: _inside(q.mean(axis=0), LOW, HIGH),
    ),
    Mistake(
        "a slack of one millimetre",
        "It lets the stroke go 1 mm too far. Asked is 10^-6 m.",
        _limits(4, -1 * mm, STROKE + 1 * mm),
    ),
    Mistake(
        "a tolerance that is too loose",
        "A value may be past its limit by more than 10^-6 here. np.allclose with its own "
        "tolerances does that, since it allows 1e-5 of the number (at 400° that is 7e-5 rad), and "
        "rounding does it, too: compare with <= and with your own tolerance.",
        lambda q: bool(np.isfinite(q).all()) and np.allclose(q, np.clip(q, LOW, HIGH)),
    ),
    Mistake(
        "the last sample is left out",
        "It never asks the last sample: range(len(q) - 1) ends one too early.",
        lambda q: _inside(q[:-1], LOW, HIGH),
    ),
    Mistake(
        "a slack of one degree",
        "It lets the angles go 1° too far. Asked is 10^-6 rad.",
        lambda q: _inside(q, LOW - [deg, deg, deg, 0], HIGH + [deg, deg, deg, 0]),
    ),
    Mistake(
        "True and False swapped",
        "It says True where a limit is broken. Asked is whether the motion is inside.",
        lambda q: not _inside(q, LOW, HIGH),
    ),
    Mistake(
        "limits in degrees and mm",
        "It compares radians and metres with the numbers 140, 150, 400 and 180. SCARA.limits are "
        "in radians and metres.",
        lambda q: _inside(q, LOW / [deg, deg, deg, mm], HIGH / [deg, deg, deg, mm]),
    ),
)


def _limit_right(tools: Tools, q: Floats) -> bool:
    return _inside(q, LOW, HIGH)


def _limit_cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    """Motions: limits reached, limits broken, NaN, at the first, a middle and the last sample."""
    still = np.array([0.1, 0.5, 0.2, 0.1])

    def one(sample: int, joint: int, value: float, count: int = 25) -> tuple[Any, ...]:
        q = np.tile(still, (count, 1))
        q[sample, joint] = value
        return (q,)

    unit = np.array([deg, deg, deg, mm])
    cases: list[tuple[Any, ...]] = [(np.tile(still, (3, 1)),)]
    for joint in (3, 0, 1, 2):
        for limit, side in ((LOW[joint], -1), (HIGH[joint], 1)):
            # exactly only for the stroke: an angle turned into degrees is rounded
            edge = float(limit) if joint == 3 else float(limit) - side * 1e-7
            cases += [one(k, joint, edge, count=3) for k in (0, 1, 2)]
            cases.append(one(1, joint, float(limit) + side * 2e-6, count=3))
            for past in (0.5, 20.0):
                value = float(limit + side * past * unit[joint])
                cases += [one(0, joint, value, 3), one(13, joint, value), one(24, joint, value)]
    cases += [one(1, 1, 145 * deg, 3), one(1, 0, 145 * deg, 3), one(1, 2, 300 * deg, 3)]
    cases += [one(1, 0, 370 * deg, 3), one(1, 1, -350 * deg, 3)]  # a whole turn on: joint 3 may be
    for sample in (10, 12):  # every fifth or tenth sample shows the one, every third the other
        cases += [one(sample, 3, 0.2), one(sample, 0, 145 * deg)]
    cases += [one(1, 3, 5.0, 3), one(1, 3, 100.0, 3)]  # a stroke in mm
    cases += [one(1, 3, 200.0, 3), one(1, 3, -0.25, 3)]  # past every limit that may stand for it
    cases += [one(1, 2, float(HIGH[2]) + 0.8 * deg, 3)]  # rounded to a degree, or one too far
    for row in (0, 13, 24):
        q = np.tile(still, (25, 1))
        q[row] = np.nan
        cases.append((q,))
    cases.append((np.full((3, 4), np.nan),))
    for _ in range(12):
        ends = rng.uniform(LOW, HIGH, (2, 4))
        cases.append((np.linspace(ends[0], ends[1], 25),))  # inside
        beyond = ends + np.eye(4)[rng.integers(4)] * (HIGH - LOW) * 1.1
        cases.append((np.linspace(ends[0], beyond[1], 25),))
    return cases


def _limit_form(result: Any, case: tuple[Any, ...]) -> bool:
    if not isinstance(result, (bool, np.bool_)):
        raise ValueError(f"wanted True or False for the whole motion, got {words(result)}")
    return bool(result)


def _limit_law(case: tuple[Any, ...], yours: bool) -> str | None:
    (q,) = case
    wrong = ~((q >= LOW) & (q <= HIGH))
    if yours == (not wrong.any()):
        return None
    if not wrong.any():
        says = "every value of this motion keeps its limits (the limits included): True is right"
        sample, joint = _at(np.argmin(np.minimum(q - LOW, HIGH - q)), q)
        value = float(q[sample, joint])
        limit = float(min(LOW[joint], HIGH[joint], key=lambda x: abs(x - value)))
        if abs(value - limit) > 1e-6:
            return says
        if value == limit:
            return f"{says}; sample {sample} has joint {joint + 1} at its limit"
        si = "m" if joint == 3 else "rad"
        at = f"sample {sample} has joint {joint + 1} at {value:.7f} {si}, its limit is {limit:.7f}"
        return f"{says}; {at} {si}".translate(MINUS)
    sample, joint = _at(np.argmax(wrong), q)
    where = f"sample {sample} of {len(q)} (counted from 0)"
    if np.isnan(q[sample, joint]):
        return f"{where} is a row of NaN, out of reach: False is right"
    si, size, unit = ("m", mm, " mm") if joint == 3 else ("rad", deg, "°")
    value, low, high = (x / size for x in (q[sample, joint], LOW[joint], HIGH[joint]))
    limit, side = (low, "below") if value < low else (high, "above")
    excess = abs(value - limit)
    digits = 1 if excess > 0.05 else 4 if unit == "°" else 3
    return (
        f"{where} has joint {joint + 1} at {value * size:.7f} {si}, {excess:.{digits}f}{unit} "
        f"{side} its limit of {limit:.0f}{unit}: False is right"
    ).translate(MINUS)


def _at(flat: Any, q: Floats) -> tuple[int, int]:
    """Sample and joint of a place in the motion, all values counted."""
    sample, joint = np.unravel_index(int(flat), q.shape)
    return int(sample), int(joint)


# --- 3: a blend of one's own ----------------------------------------------------------------------

UNITS = {
    "start_z": ("mm", mm),
    "via_z": ("mm", mm),
    "goal_z": ("mm", mm),
    "miss": ("mm", mm),
    "acceleration": ("mm/s²", mm),
}


def _stations(numbers: Mapping[str, Any]) -> tuple[ScaraPose, ScaraPose, ScaraPose]:
    """The lab's places and angles at heights of one's own."""
    return (
        ScaraPose([0.2, 0.3, numbers["start_z"]], 0.0),
        ScaraPose([0.4, 0.1, numbers["via_z"]], np.pi),
        ScaraPose([0.2, -0.2, numbers["goal_z"]], np.pi / 2),
    )


def _lift(numbers: Mapping[str, Any]) -> float:
    """By how much the parabola of a whole blend of 1 would lift the deepest point, m."""
    h1, h2 = (numbers[name] - numbers["via_z"] for name in ("start_z", "goal_z"))
    return float(2 * h1 * h2 / (h1 + h2))


def _least(numbers: Mapping[str, Any]) -> float:
    """The smallest blend that keeps the stroke."""
    return (LEVEL - STROKE - float(numbers["via_z"])) / _lift(numbers)


def _gap(numbers: Mapping[str, Any], fraction: float) -> float:
    """How near the path comes to via, m."""
    path = blend(*_stations(numbers), fraction, np.linspace(0, 1, 2001))
    return float(np.linalg.norm(path.position - _stations(numbers)[1].position, axis=-1).min())


def _stroke_acceleration(numbers: Mapping[str, Any], fraction: float, duration: float) -> float:
    """In the parabola's corner, where it is constant, m/s²."""
    h1, h2 = (numbers[name] - numbers["via_z"] for name in ("start_z", "goal_z"))
    return float((h1 + h2) / (fraction * duration**2))


def given(who: Any) -> Numbers:
    """A via point too low for the stroke. Joints 1 to 3 do not depend on heights, so they stay
    inside as in the lab; the smallest blend that keeps the stroke (0.12 to 0.29) fulfils the rest
    by construction, and so do all up to 1.1 times as much.
    """
    roll = dice(LAB, who)
    heights = {
        "start_z": (100 + 10 * roll.randrange(7)) * mm,
        # at least 10: with heights over the table the duration is more than 2 % too long
        "via_z": (10 + 2 * roll.randrange(6)) * mm,
        "goal_z": (140 + 10 * roll.randrange(9)) * mm,
    }
    most = (3 + roll.randrange(4)) * mm
    fraction = 1.1 * _least(heights)
    miss = np.ceil(_gap(heights, fraction) / mm) * mm
    return Numbers(heights | {"miss": float(miss), "acceleration": most}, UNITS)


def _shortest(numbers: Mapping[str, Any], fraction: float) -> float:
    """The duration in which the corner of this blend takes all of the acceleration allowed, s."""
    return float(np.sqrt(_stroke_acceleration(numbers, fraction, 1.0) / numbers["acceleration"]))


def _design_form(answer: Any, given: Any) -> dict[str, float]:
    if not isinstance(answer, Mapping):
        raise ValueError(f"Wanted a dict with blend and duration, got {words(answer)}.")
    missing = [key for key in ("blend", "duration") if key not in answer]
    if missing:
        raise ValueError(f"Your dict has no {' and no '.join(repr(key) for key in missing)}.")
    found = {}
    for key in ("blend", "duration"):
        value = answer[key]
        try:
            found[key] = one_number(value)
        except (TypeError, ValueError):
            raise ValueError(f"{key}: wanted one number, got {words(value)}.") from None
        if not np.isfinite(found[key]):
            raise ValueError(f"{key}: wanted a finite number, got {words(value)}.")
    if found["blend"] > 1:
        raise ValueError(f"blend: wanted a share from 0 to 0.5, got {found['blend']:g}.")
    return found


def _design_faults(answer: Mapping[str, float], given: Any) -> list[Fault]:
    b, duration, found = answer["blend"], answer["duration"], []
    if not 0 < b <= 0.5:
        says = f"A blend is above 0 (that is the sharp corner) and at most 0.5; yours is {b:g}."
        return [("no such blend", says)] * 4
    if duration <= 0:
        return [("no such duration", f"A motion takes time; yours takes {duration:g} s.")] * 4
    deepest = LEVEL - float(given["via_z"]) - b * _lift(given)
    if deepest > STROKE + 1e-9:  # joints 1 to 3 stay inside for every blend, see `given`
        says = (
            f"The stroke goes {apart((deepest - STROKE) / mm, 0, 2)[0]} mm past its limit of "
            f"{STROKE / mm:.0f} mm. More blend lifts the tool."
        )
        found.append(("past the stroke's limit", says))
    gap = _gap(given, b)
    if gap > given["miss"] * (1 + 1e-6):
        near, allowed = apart(gap / mm, given["miss"] / mm)
        says = f"The tool passes via at {near} mm, and {allowed} mm are allowed. "
        says += "Less blend comes nearer."
        found.append(("too far from via", says))
    a = _stroke_acceleration(given, b, duration)
    needs, allowed = apart(a / mm, given["acceleration"] / mm, 2)
    told = (
        f"In {duration:g} s the stroke accelerates with {needs} mm/s² in the corner of your blend, "
        f"and {allowed} mm/s² are allowed"
    )
    fast, slow = a > given["acceleration"] * 1.002, duration > 1.02 * _shortest(given, b)
    slip = _slip(duration / _shortest(given, b), _shortest(given, b)) if fast or slow else None
    if fast:
        name, says = slip or ("too fast", "More time, or more blend, helps.")
        found.append((name, f"{told}. {says}"))
    if slow:
        name, says = slip or ("slower than needed", "A shorter duration would do.")
        found.append((name, f"{told}. {says}"))
    return found


def _slip(ratio: float, shortest: float) -> tuple[str, str] | None:
    """Where a duration is the shortest one times a number that a slip of the pen gives."""
    slips = (
        (shortest, "the root is forgotten", "The formula has T²: your duration is its square."),
        (1000**0.5, "mm for m", "Heights and acceleration have to be in one unit of length."),
        (1000**-0.5, "mm for m", "Heights and acceleration have to be in one unit of length."),
        (0.5, "half of the duration", "The formula's T is the whole duration."),
        (2.0, "twice the duration", "The formula's T is the whole duration."),
    )
    near = (slip for slip in slips if abs(ratio / slip[0] - 1) < 0.003)
    return next(((name, says) for _, name, says in near), None)


# --- The predictions' numbers and views -----------------------------------------------------------


def _changes() -> Floats:
    """How much each joint of the LIN changes where the tool starts turned by 45°, rad and m."""
    turned = ScaraPose(START.position, START.angle + 45 * deg)
    found: Floats = abs(_joints(lin(turned, GOAL, S)) - _joints(lin(START, GOAL, S))).max(axis=0)
    return found


def _angle_facts() -> dict[str, Any]:
    changed = _changes()
    return {"changed": [i + 1 for i in range(4) if changed[i] > 1e-9], "most": changed[2] / deg}


FEW = T[::10]  # every 0.2 s: enough for a view that shows a shape


def _angle_view() -> Any:
    from ..show import JOINT_STYLES, figure

    fig = figure(
        "The four joints over time on the line, with a tool angle of 0, 45 and 90 degrees at the "
        "start. Joint 3 has three curves, which meet at the goal; joints 1, 2 and 4 have one.",
        height=2.9,
    )
    for i, ax in enumerate(fig.subplots(1, 4)):
        color, unit = JOINT_STYLES[i]["color"], mm if i == 3 else deg
        for angle, style in ((0, "-"), (45, "--"), (90, ":")):
            start = ScaraPose(START.position, angle * deg)
            q = _joints(lin(start, GOAL, FEW / DURATION))[:, i] / unit
            ax.plot(FEW, q, style, color=color, lw=2)
            if i == 2:
                ax.text(0.6, q[0] + 7, f"{angle}°", fontsize=9)
        ax.set(xlabel="t, s", title=f"q{i + 1}, {'mm' if i == 3 else '°'}")
    fig.suptitle("Another tool angle at the start (0°, 45°, 90°): joint 3 alone moves differently")
    fig.tight_layout()
    return fig


@cache
def _line_facts() -> dict[str, Any]:
    q = _joints(lin(START, GOAL, S))
    v = differentiate(q, T) / [deg, deg, deg, mm]
    low, high = v.min(axis=0), v.max(axis=0)
    steady = [i + 1 for i in range(4) if high[i] - low[i] < 1e-6 * abs(high[i])]
    facts: dict[str, Any] = {"steady": steady, "stroke": v[0, 3]}
    for i in range(3):
        facts |= {f"low{i + 1}": low[i], f"high{i + 1}": high[i]}
    return _signed(facts)


def _signed(facts: Mapping[str, Any]) -> dict[str, Any]:
    """Numbers with a minus sign where they are shown."""
    return {k: _Shown(v) if isinstance(v, float) else v for k, v in facts.items()}


class _Shown(float):
    """A number that is written with a minus sign."""

    def __format__(self, spec: str) -> str:
        return format(float(self), spec).translate(MINUS)


def _line_view() -> Any:
    from ..show import plot_joints

    q = _joints(lin(START, GOAL, S))
    title = "A line at constant speed: the stroke runs evenly, three joints do not"
    return plot_joints(SCARA, T, q, differentiate(q, T), title=title)


@cache
def _apart_facts() -> dict[str, Any]:
    line = lin(START, GOAL, S)
    q = ptp(SCARA.ik(START)[ROW], SCARA.ik(GOAL)[ROW], S)
    tool, turned = SCARA.fk(q).translation, q[:, :3].sum(axis=-1)
    apart = abs(tool - line.position).max(axis=0)
    differ = [name for name, gap in zip("xyz", apart, strict=True) if gap > 1e-9]
    differ += ["angle"] if abs(turned - line.angle).max() > 1e-9 else []
    far = np.linalg.norm(tool - line.position, axis=-1).max()
    return {"differ": differ, "x": apart[0] / mm, "y": apart[1] / mm, "far": far / mm}


def _apart_view() -> Any:
    from ..show import animate

    lower = np.array([0, 60, 120])  # the goal lowered by so many mm
    ends = ScaraPose([[0.2, -0.2, (200 - z) * mm] for z in lower], 90 * deg)
    share = FEW / DURATION
    line = _joints(lin(START, ends[:, None], share))
    joint = ptp(SCARA.ik(START)[ROW], SCARA.ik(ends)[:, None, ROW], share)
    return animate(
        [SCARA, SCARA],
        FEW,
        [line, joint],
        names=["LIN", "PTP"],
        slider=("goal lowered by, mm", lower),
        title="Two motions with the same ends, at the same heights at all times",
    )


def _behind(x: Any) -> ScaraPose:
    """Goals on the other side of the column, x in mm (section 4)."""
    places = np.stack(np.broadcast_arrays(np.multiply(x, mm), -0.4, 0.2), axis=-1)
    return ScaraPose(places, np.full(np.shape(x), 90 * deg))


def _past(q: Floats) -> Floats:
    """Samples past the limits, joint by joint."""
    found: Floats = ((q < LOW) | (q > HIGH)).sum(axis=-2)
    return found


@cache
def _ends_facts() -> dict[str, Any]:
    goal = _behind(0)
    line = lin(START, goal, S)
    bad = _past(_joints(line))
    even = _past(ptp(SCARA.ik(START)[ROW], SCARA.ik(goal)[ROW], S))
    near = np.linalg.norm(line.position[:, :2], axis=-1).min()
    facts = {"leaves": [bool(bad.any()), bool(even.any())], "near": near / mm}
    return facts | {f"bad{i + 1}": int(bad[i]) for i in range(2)}


def _ends_view() -> Any:
    from ..show import animate

    values = np.array([0.0, 50.0, 100.0])
    goals, share = _behind(values), FEW / DURATION
    line = _joints(lin(START, goals[:, None], share))
    joint = ptp(SCARA.ik(START)[ROW], SCARA.ik(goals)[:, None, ROW], share)
    return animate(
        [SCARA, SCARA],
        FEW,
        [line, joint],
        names=["LIN", "PTP"],
        slider=("goal x, mm", values),
        title="The same good ends: LIN depends on what lies between, PTP does not",
    )


@cache
def _blind_facts() -> dict[str, Any]:
    """Which joints can leave their limit, coming from inside, and a test of wrapped angles never
    says so: even motions from the middle to 50 ends, 1001 samples each.
    """
    blind = []
    for i in range(4):
        middle, span = (LOW[i] + HIGH[i]) / 2, HIGH[i] - LOW[i]
        ends = HIGH[i] + span * np.linspace(0.02, 1, 50)
        q = middle + (ends[:, None] - middle) * S
        seen = wrapped(q) if i < 3 else q
        if not ((seen < LOW[i]) | (seen > HIGH[i])).any():
            blind.append(i + 1)
    return {"blind": blind}


def _blind_view() -> Any:
    from ..show import figure

    fig = figure(
        "Two motions that leave a limit, wrapped. Joint 1 turns from 0 to 350 degrees: on the way "
        "it is seen between 140 and 180 degrees, past its limit. Joint 3 turns from 300 to 410 "
        "degrees: wrapped it runs from -60 to 50 degrees, never past its limit of 400.",
        height=3.4,
    )
    for ax, i, first, last in zip(fig.subplots(1, 2), (0, 2), (0, 300), (350, 410), strict=True):
        q = first + (last - first) * S
        seen, limit = wrapped(q * deg) / deg, HIGH[i] / deg
        shown = np.where(abs(np.diff(seen, append=seen[-1])) > 180, np.nan, seen)
        caught = abs(seen) > limit
        ax.plot(S, q, "--", color="0.5", lw=1.5)
        ax.text(0.97, q[-1] - 75, "as it turns", ha="right", va="top", color="0.4")
        ax.plot(S, shown, color="#0072B2" if i == 0 else "#009E73", lw=2)
        ax.text(0.97, seen[-1] - 45, "wrapped", ha="right", va="top")
        if caught.any():
            ax.plot(S[caught], seen[caught], ".", color="#B3261E", ms=5)
            ax.text(
                S[caught][0] - 0.02, seen[caught][0] + 15, "caught", ha="right", color="#B3261E"
            )
        ax.axhspan(limit, 500, color="#CC79A7", alpha=0.22, lw=0)
        ax.axhspan(-500, -limit, color="#CC79A7", alpha=0.22, lw=0)
        told = "caught on its way out" if caught.any() else "no sample is caught"
        ax.set(xlim=(0, 1), ylim=(-450, 450), yticks=range(-360, 361, 180), xlabel="progress s")
        ax.set(ylabel=f"q{i + 1}, °", title=f"Joint {i + 1}, limit ±{limit:.0f}°: {told}")
    fig.tight_layout()
    return fig


DOWN, UP, HALF = 90.0, 60.0, 5.0  # mm, mm, s: the corner of prediction 6


@cache
def _corner_facts() -> dict[str, Any]:
    before, after = DOWN / HALF, -UP / HALF
    via = ScaraPose([0.3, 0.1, 0.05], 0.0)
    start = ScaraPose([0.2, 0.2, 0.05 + DOWN * mm], 0.0)
    goal = ScaraPose([0.3, -0.1, 0.05 + UP * mm], 0.0)
    t = np.array([4.8, 4.9, 5.0, 5.1, 5.2])
    q4 = SCARA.ik(blend(start, via, goal, 0.0, t / (2 * HALF)))[:, ROW, 3] / mm
    measured = (q4[4] - q4[3] - q4[1] + q4[0]) / 0.1
    facts = {
        "jump": measured,
        "sign": -measured,
        "sizes": abs(after) - before,
        "less": before - abs(after),
        "first": before,
        "mean": measured / 2,
        "way": -(DOWN + UP),
    }
    return (
        facts
        | {"down": DOWN, "up": UP, "half": HALF, "before": before, "after": _Shown(after)}
        | {"slower": abs(after)}
    )


def _corner_view() -> Any:
    from ..show import figure

    t = np.array([0, HALF, 2 * HALF])
    fig = figure(
        f"Joint 4 over time: its value rises by {DOWN:g} mm and falls by {UP:g} mm; its speed is "
        f"{DOWN / HALF:g} mm/s, then {-UP / HALF:g} mm/s.",
        height=2.6,
    )
    place, speed = fig.subplots(1, 2)
    place.plot(t, [0, DOWN, DOWN - UP], color="#CC79A7", linestyle="-.", lw=2)
    for side, value in ((t[:2], DOWN / HALF), (t[1:], -UP / HALF)):
        speed.plot(side, [value, value], color="#CC79A7", linestyle="-.", lw=2)
    place.set(xlabel="time t, s", ylabel="q4 since the start, mm", title="Lower is more stroke")
    jump = _Shown(-(DOWN + UP) / HALF)
    speed.set(xlabel="time t, s", ylabel="speed of q4, mm/s", title=f"A jump of {jump:g} mm/s")
    fig.tight_layout()
    return fig


OFF = 0.01  # degrees


def _tool_angle(pose: Any) -> Floats:
    x_axis = pose.rotation @ np.array([1.0, 0, 0])
    return np.asarray(np.arctan2(x_axis[..., 1], x_axis[..., 0]), dtype=float)


def _near(off: float) -> ScaraPose:
    return ScaraPose(START.position, off * deg)


@cache
def _half_facts() -> dict[str, Any]:
    ways = [
        float(_tool_angle(_near(off).as_transform().lerp(VIA.as_transform(), 0.5))) / deg
        for off in (-OFF, OFF)
    ]
    apart = abs(ways[0] - ways[1])
    facts = {
        "none": 0.0,
        "off": OFF,
        "apart": apart,
        "starts": 2 * OFF,
        "mean": OFF,
        "one": apart / 2,
        "minus": -apart,
    }
    return facts | {"whole": 360.0, "right": _Shown(ways[0]), "left": _Shown(ways[1])}


def _half_view() -> Any:
    from ..show import figure

    fig = figure(
        "Tool angle over the progress. By the rotation, a start at +0.01 degrees turns to the left "
        "and one at -0.01 degrees to the right. By the number, both turn to the left.",
        height=3.4,
    )
    axes = fig.subplots(1, 2, sharey=True)
    for off, style in ((-OFF, "-"), (OFF, "--")):
        angle = np.unwrap(_tool_angle(_near(off).as_transform().lerp(VIA.as_transform(), S)))
        name = f"start at {off:+.2f}°".translate(MINUS)
        axes[0].plot(S, angle / deg, style, lw=2, label=name)
        axes[1].plot(S, _near(off).lerp(VIA, S).angle / deg, style, lw=2, label=name)
    axes[0].set(
        title="As a rotation: 0.02° decides", ylabel="tool angle, °", yticks=range(-180, 181, 90)
    )
    axes[1].set(title="As a number: the number decides")
    for ax in axes:
        ax.set_xlabel("progress s")
    axes[1].legend()
    fig.tight_layout()
    return fig


H1, H2, B0, B1 = 60.0, 180.0, 0.1, 0.4  # heights over via in mm, and two blends: prediction 8


def _deepest(b: float) -> float:
    """Measured on the path, mm over via."""
    via = ScaraPose([0.4, 0.1, 0], 0.0)
    start, goal = ScaraPose([0.2, 0.3, H1 * mm], 0.0), ScaraPose([0.2, -0.2, H2 * mm], 0.0)
    return float(blend(start, via, goal, b, np.linspace(0, 1, 4001)).position[:, 2].min()) / mm


@cache
def _photo_facts() -> dict[str, Any]:
    first, last, factor = _deepest(B0), _deepest(B1), B1 / B0
    guesses = {"square": first * factor**2, "twice": first * 2, "less": first / factor}
    guesses |= {"times": factor, "half": 2 * B0}
    return guesses | {"h1": H1, "h2": H2, "b0": B0, "b1": B1, "first": first, "last": last}


def _photo_view() -> Any:
    from ..show import figure

    fig = figure(
        "Side view of the corner for blends 0.1 to 0.4: the four curves are copies of one another, "
        "enlarged from the via point.",
        height=3.4,
    )
    ax = fig.subplots()
    x = np.linspace(0, 1, 101)
    ax.plot([-1, 0, 1], [H1, 0, H2], color="0.6", lw=1)
    for b, style in zip((0.1, 0.2, 0.3, 0.4), (":", "-.", "--", "-"), strict=True):
        across, height = 2 * b * (x**2 - (1 - x) ** 2), 2 * b * (H1 * (1 - x) ** 2 + H2 * x**2)
        ax.plot(across, height, style, lw=2, label=f"blend {b}")
        k = height.argmin()
        ax.plot(across[k], height[k], "o", color="0.2", ms=4)
    ax.plot(0, 0, "o", color="0.4")
    for place, name, off in (
        ((-2 * B1, 2 * B1 * H1), "A", (-4, 8)),
        ((0, 0), "B = via", (12, -4)),
        ((2 * B1, 2 * B1 * H2), "C", (-14, 2)),
    ):
        ax.plot(*place, "o", color="0.2", ms=4)
        ax.annotate(name, place, off, textcoords="offset points", fontsize=11)
    for at, tall, name, side in ((-1, H1, "$h_1$", 6), (1, H2, "$h_2$", -20)):
        ax.annotate("", (at, 0), (at, tall), arrowprops={"arrowstyle": "<->", "color": "0.4"})
        ax.annotate(name, (at, tall / 2), (side, 0), textcoords="offset points", fontsize=11)
    ax.axhline(0, color="0.8", lw=0.8, zorder=0)
    ax.set(
        title="Every corner is an enlargement of the same one, from the via point",
        xlabel="share of the line before (−) and after (+) via",
        ylabel="height over via, mm",
    )
    ax.legend()
    fig.tight_layout()
    return fig


def _acceleration(b: float, duration: float) -> float:
    """Measured in the middle of the lab's corner, mm/s²."""
    t = np.linspace(0, duration, 1001)
    q4 = SCARA.ik(blend(START, VIA, GOAL, b, t / duration))[:, ROW, 3]
    return float(abs(differentiate(q4[:, None], t, 2)[500, 0])) / mm


@cache
def _cost_facts() -> dict[str, Any]:
    before = _acceleration(0.4, 10.0)
    return {"before": before, "after": _acceleration(0.2, 20.0), "short": _acceleration(0.2, 10.0)}


def _cost_right(facts: Mapping[str, Any]) -> int:
    guesses = np.array([0.25, 0.5, 1.0, 2.0]) * facts["before"]
    return int(abs(np.log(guesses / facts["after"])).argmin())


def _cost_view() -> str:
    lines = ["The stroke's acceleration in the corner, measured:"]
    for b, duration in ((0.4, 10.0), (0.2, 10.0), (0.4, 20.0), (0.2, 20.0)):
        a = _acceleration(b, duration)
        lines.append(f"blend {b:g}, duration {duration:g} s: {a:.2f} mm/s²")
    return "\n".join(lines)


@cache
def _quintic_facts() -> dict[str, Any]:
    wanted = (LEVEL - STROKE) / mm
    lifted = [
        float(blend(START, VIA, GOAL, 0.5, np.linspace(0, 1, 4001), corner=c).position[:, 2].min())
        for c in ("parabola", "quintic")
    ]
    parabola, quintic = (wanted / (z / 0.5 / mm) for z in lifted)
    facts = {"parabola": parabola, "less": 0.75 * parabola, "quintic": quintic}
    return facts | {"largest": 0.5}


def _quintic_right(facts: Mapping[str, Any]) -> int:
    if facts["quintic"] > 0.5:
        return 3
    guesses = [facts[name] for name in ("less", "parabola")]
    more = facts["quintic"] > 1.05 * facts["parabola"]
    return 2 if more else int(np.argmin([abs(x - facts["quintic"]) for x in guesses]))


def _quintic_view() -> Any:
    from ..show import figure

    facts = _quintic_facts()
    fig = figure(
        "Stroke over time at the same blend: the parabola touches the limit of 180 mm, the quintic "
        "is past it; with more blend the quintic touches it, too.",
        height=3.2,
    )
    ax = fig.subplots()
    tried = (("parabola", "parabola", "-"), ("quintic", "parabola", "--"))
    for corner, of, style in (*tried, ("quintic", "quintic", ":")):
        q4 = SCARA.ik(blend(START, VIA, GOAL, facts[of], S, corner=corner))[:, ROW, 3]
        ax.plot(T, q4 / mm, style, lw=2, label=f"{corner}, blend {facts[of]:.3f}")
    ax.axhspan(STROKE / mm, 200, color="#CC79A7", alpha=0.22, lw=0)
    ax.text(5.1, 192, "past the limit of 180 mm")
    ax.set(xlim=(5, 15), ylim=(120, 200), xlabel="time t, s", ylabel="stroke q4, mm")
    ax.set_title(f"The quintic goes deeper: it needs a blend of {facts['quintic']:.3f}")
    ax.legend(loc="lower center")
    fig.tight_layout()
    return fig


# --- The tables -----------------------------------------------------------------------------------

EXERCISES = {
    "1": Function(
        title="The least turn of the tool",
        task="The posture (q1, q2, q3, q4) for a place and a tool angle, elbow as in q0, in which "
        "the tool has turned least from q0 and joint 3 is inside its limits.",
        objective=1,
        hints=(
            "What turns is the tool, not joint 3. At which angle does the tool stand now, in "
            "q0? And which numbers mean the same tool angle as the one wanted?",
            "The tool stands at q0[0] + q0[1] + q0[2]. The wanted angle is angle + 2 pi k for any "
            "k. Joints 1, 2 and 4 come from SCARA.ik (row SCARA.branch(+1) if q0[1] >= 0, else "
            "-1), and joint 3 is the tool's angle less q1 and q2.",
            "For k in range(-5, 6): q3 = angle + 2 pi k - q1 - q2. Keep those with "
            "SCARA.limits[2][0] <= q3 <= SCARA.limits[2][1]. Of these take the one with the least "
            "abs(q1 + q2 + q3 - (q0[0] + q0[1] + q0[2])).",
        ),
        inputs=("q0", "position", "angle"),
        right=_least_turn,
        cases=_turn_cases,
        form=_posture_form,
        law=_turn_law,
        same=_same_posture,
        mistakes=TURN_MISTAKES,
    ),
    "2": Function(
        title="A limit test",
        task="Whether a motion q (samples, 4) with unwrapped angles keeps SCARA.limits in every "
        "sample and every joint.",
        objective=2,
        hints=(
            "Which values have to be asked, and of how many samples? Which unit does each have, "
            "and which unit have its limits?",
            "SCARA.limits is (4, 2): a lower and an upper limit for each joint, in the units of q. "
            "A motion is inside if all values are at least the lower one and at most the upper "
            "one. What does a comparison with NaN say?",
            "low, high = SCARA.limits.T; then q >= low and q <= high compare all samples at once. "
            "Join both with & and ask whether np.all of them hold: a NaN never does.",
        ),
        inputs=("q",),
        right=_limit_right,
        cases=_limit_cases,
        form=_limit_form,
        law=_limit_law,
        same=lambda a, b: a is b,
        mistakes=LIMIT_MISTAKES,
    ),
    "3": Value(
        title="A blend of your own",
        task="Choose a blend, and the shortest duration that it allows, for a via point of your "
        "own that is too low",
        objective=3,
        hints=(
            "Begin with the stroke: by how much has the corner to lift the tool over the via "
            "point? Section 7 has the blend that does it.",
            "h1 and h2 are the heights of start and goal over via. The blend is at least "
            "(40.2 mm - via_z) / 2 * (h1 + h2) / (h1 * h2). More of it passes via farther away: "
            "take little more than the least.",
            "With this blend b the stroke accelerates with (h1 + h2) / (b * T**2). The shortest "
            "duration is the one in which that is all of the acceleration allowed: T = "
            "np.sqrt((h1 + h2) / (b * acceleration)), at most 2 % more. "
            "dict(blend=..., duration=...).",
        ),
        form=_design_form,
        faults=_design_faults,
        count=4,
        given=given,
    ),
}

# Objective 1: p1, p2, p3, p6. Objective 2: p4, p7. Objective 3: p5, p8, p9, p10.
PREDICTIONS = {
    "p1": Prediction(
        question="The tool moves on a straight line from start to goal. Now it starts turned by "
        "45° more; places and goal stay as they were. Which joints move in another way than "
        "before?",
        options=(
            Option(
                "Joint 3 alone.",
                "Joints 1 and 2 carry the tool's axis to its place, joint 4 gives the height. The "
                "angle is left to joint 3, and at the start it differs by {most:.0f}°. In the "
                "picture three motions lie on one another, but for joint 3.",
            ),
            Option(
                "Joints 1, 2 and 3: their sum is the tool's angle.",
                "The sum changes, and it is joint 3 that changes it: joints 1 and 2 are fixed by "
                "the place, and nothing is left for them to choose.",
                "a sum that all of its parts have to change",
                "Turn the cup in your hand on a straight shelf: shoulder and elbow stay.",
            ),
            Option(
                "Joints 3 and 4, the wrist.",
                "Joint 4 shifts along the axis about which joint 3 turns: a shift does not turn, "
                "and a turn about the axis does not lift.",
                "joints of one axis taken for one joint",
                "A drill press lowers its drill whether the spindle turns or not.",
            ),
            Option(
                "All four: it is another pose.",
                "It is so for a six-axis arm, whose wrist carries the flange about. Here the "
                "tool's axis goes through the same points.",
                "the six-axis arm carried over",
                "On the IRB-140 another rotation of the tool moves the wrist centre, and joints 1 "
                "to 3 have to follow.",
            ),
        ),
        facts=_angle_facts,
        right=lambda facts: [[3], [1, 2, 3], [3, 4], [1, 2, 3, 4]].index(facts["changed"]),
        view=_angle_view,
    ),
    "p2": Prediction(
        question="In lab 3 the tool ran along a straight line at constant speed and turned at a "
        "constant rate, and no joint of the six kept its speed. Now the SCARA does the same, from "
        "start to goal. Which of its joints keep their speed?",
        options=(
            Option(
                "None, as in lab 3.",
                "Three of them do not. The stroke is the height itself, up to a constant: it runs "
                "at {stroke:.0f} mm/s all the time.",
                "the six-axis arm carried over",
                "A lift goes up evenly if the cabin does: nothing bends between them.",
            ),
            Option(
                "Joint 3 and joint 4: the tool turns and sinks or rises evenly.",
                "The tool turns evenly, and joint 3 makes up for joints 1 and 2, which do not: it "
                "goes between {low3:.1f} and {high3:.1f}°/s.",
                "joint 3 taken for the tool's angle",
                "Walk round a tower and keep facing north: your hips turn as unevenly as you walk.",
            ),
            Option(
                "Joint 4 alone.",
                "q4 = l0 − z: what is straight and even in space is so in joint 4, at "
                "{stroke:.0f} mm/s. Joint 1 goes between {low1:.1f} and {high1:.1f}°/s, joint 3 "
                "between {low3:.1f} and {high3:.1f}°/s.",
            ),
            Option(
                "All four: all its axes are parallel.",
                "The line passes axis 1 nearer and farther away: joint 1 goes between {low1:.1f} "
                "and {high1:.1f}°/s.",
                "parallel axes taken for a linear arm",
                "A lighthouse beam that follows a ship on a straight course does not turn evenly.",
            ),
        ),
        facts=_line_facts,
        right=lambda facts: [[], [3, 4], [4], [1, 2, 3, 4]].index(facts["steady"]),
        view=_line_view,
    ),
    "p3": Prediction(
        question="One motion goes from start to goal straight in space (LIN), the other straight "
        "in the joints (PTP), both in 20 s. Compare x, y, z and the angle of the tool at the same "
        "times. Which differ?",
        options=(
            Option(
                "All four.",
                "That is the six-axis arm. Here z = l0 − q4 and the angle q1 + q2 + q3 are sums of "
                "joint values: what is linear in the joints is linear in them, too.",
                "the six-axis arm carried over",
                "A gantry crane: x, y and z are one joint each, so there LIN and PTP agree in all.",
            ),
            Option(
                "x, y and z: the path bends, and the angle does not.",
                "The path bends as seen from above. The height is l0 − q4, and that is the same "
                "straight line in time for both.",
                "a path that bends in every direction",
                "Let joints 1 to 3 stand still: then LIN and PTP are one and the same lift.",
            ),
            Option(
                "x, y and the angle: the joints that turn.",
                "The angle is q1 + q2 + q3, a sum: if each term is linear in time, so is the sum.",
                "a sum of turns taken for something bent",
                "Two hands of a clock turn evenly; the sum of their angles does, too.",
            ),
            Option(
                "x and y.",
                "Height and angle are sums of joint values, so they are linear in both motions. x "
                "and y are sums of sines and cosines: up to {x:.0f} mm and {y:.0f} mm apart. (Both "
                "have to turn the same way round, in unwrapped angles.)",
            ),
        ),
        facts=_apart_facts,
        right=lambda facts: [
            ["x", "y", "z", "angle"],
            ["x", "y", "z"],
            ["x", "y", "angle"],
            ["x", "y"],
        ].index(facts["differ"]),
        view=_apart_view,
    ),
    "p4": Prediction(
        question="A start and a goal stand inside all limits, on the same branch, and the straight "
        "line between them can be reached everywhere. The arm goes once by LIN, once by PTP. On "
        "which of the two can a joint leave its limits on the way?",
        options=(
            Option(
                "On neither: both ends are inside, and so is what lies between.",
                "That holds joint by joint, for PTP. On the line to the goal with x_goal = 0 "
                "joint 1 is past its limit in {bad1} samples of 1001, and joint 2 in {bad2}.",
                "good ends taken for a good path",
                "Two houses on a lake: the straight way between them is wet.",
            ),
            Option(
                "On PTP alone: nobody looks after its path.",
                "Nobody looks after its path in space. Each joint runs evenly between two allowed "
                "values, and so it stays between them.",
                "the path in space taken for the joints",
                "A lift from floor 2 to floor 5 never comes to floor 6.",
            ),
            Option(
                "On LIN alone.",
                "Each joint of PTP runs between two allowed values. On LIN the joints do what the "
                "line asks for: it passes axis 1 at {near:.0f} mm, so joint 2 has to fold far, and "
                "past the column joint 1 turns too far. Drag the goal's x: away from axis 1 both "
                "are good.",
            ),
            Option(
                "On both: a limit does not ask for the kind of motion.",
                "PTP between two postures inside the limits cannot: each joint runs between two "
                "allowed values.",
                "the joints of PTP taken for those of LIN",
                "Whoever walks from 2 to 5 on a line of numbers does not meet 6.",
            ),
        ),
        facts=_ends_facts,
        right=lambda facts: [
            [False, False],
            [False, True],
            [True, False],
            [True, True],
        ].index(facts["leaves"]),
        view=_ends_view,
    ),
    "p5": Prediction(
        question="The tool of another motion sinks by {down:.0f} mm on the way to its via point, "
        "in {half:.0f} s, and rises by {up:.0f} mm on the way from it, in {half:.0f} s, both at "
        "constant speed. By how much does the speed of joint 4 change at the via point? (After "
        "less before.)",
        options=(
            Option(
                "{jump:.0f}",
                "Down is more stroke: joint 4 runs at +{before:.0f} mm/s, then at {after:.0f} "
                "mm/s.",
            ),
            Option(
                "{sign:.0f}",
                "The size is right. Joint 4 counts downwards: its speed falls from +{before:.0f} "
                "to {after:.0f} mm/s.",
                "the height taken for the stroke",
                "A tool that only sinks has a falling height and a rising q4.",
            ),
            Option(
                "{sizes:.0f}",
                "Those are speeds without their directions: {up:.0f} mm up and {down:.0f} mm down.",
                "speeds without a sign",
                "A ball that comes back from a wall as fast as it came has changed its velocity.",
            ),
            Option(
                "{less:.0f}",
                "{before:.0f} − {slower:.0f} leaves the directions out: down, then up.",
                "the smaller speed taken from the larger",
                "A ball comes back as fast as it came: its velocity has changed by twice as much.",
            ),
            Option(
                "{first:.0f}",
                "That is the speed before via. After it the joint does not stand, it runs the "
                "other way at {after:.0f} mm/s.",
                "a stop for a return",
                "At a via point the lift does not stop: it turns back.",
            ),
            Option(
                "{mean:.0f}",
                "Each line takes {half:.0f} s; both together take twice as long.",
                "the whole duration for one line",
                "Two lines of 10 s each at 1 mm/s are 20 mm in 20 s.",
            ),
            Option(
                "{way:.0f}",
                "Those are the ways; a speed is a way divided by its time.",
                "the way taken for the speed",
                "The same ways in twice the time: half the jump.",
            ),
        ),
        facts=_corner_facts,
        right=lambda facts: 0,
        view=_corner_view,
        unit="mm/s",
        within=0.02,
    ),
    "p6": Prediction(
        question="The tool turns from about 0° to 180°: one motion starts at −{off:.2f}°, the "
        "other at +{off:.2f}°. Both are interpolated as rotations, each on the shortest arc "
        "(Transform.lerp). How far apart are their tool angles half way?",
        options=(
            Option(
                "{apart:.0f}",
                "The one at −{off:.2f}° has a little more than half a turn to the left, so it "
                "goes to the right, through {right:.0f}°; the other goes to the left, through "
                "{left:.0f}°. As a number both turn to the left.",
            ),
            Option(
                "{mean:.2f}",
                "That is so if both turn the same way: half of the difference at the start.",
                "both arcs taken for one",
                "Two people go from the north pole to the south pole along the shortest way: they "
                "may meet nowhere between.",
            ),
            Option(
                "{starts:.2f}",
                "That is the difference at the start. The goals are the same, so it could only "
                "shrink, if both turned the same way.",
                "the difference of the starts",
                "At the goal they are 0° apart.",
            ),
            Option(
                "{none:.0f}",
                "They are together at the end, at 180°. Half way one stands at {right:.0f}°, the "
                "other at {left:.0f}°: they go round on different sides.",
                "the end for the whole way",
                "Two walkers round a lake, one to the left and one to the right, meet at the end "
                "only.",
            ),
            Option(
                "{one:.0f}",
                "That is how far each has turned: one to the left, one to the right.",
                "one turn for the difference of two",
                "+30° and −30° are 60° apart.",
            ),
            Option(
                "{minus:.0f}",
                "The size is right. How far apart two angles are is a distance, and it has no "
                "sign.",
                "a distance with a sign",
                "From here to the lake it is 2 km, and from the lake to here it is 2 km as well.",
            ),
            Option(
                "{whole:.0f}",
                "That is what the turns differ by at the end; asked is half way.",
                "the end for the middle",
                "+180° and −180° are 360° apart as numbers, and one pose.",
            ),
        ),
        facts=_half_facts,
        right=lambda facts: 0,
        view=_half_view,
        unit="°",
        within=0.002,
    ),
    "p7": Prediction(
        question="A motion begins inside all limits and has many samples. A limit test wraps each "
        "angle into −180° to 180° first, and compares then: joints 1 to 3 with ±140°, ±150° and "
        "±400°, joint 4 with 0 to 180 mm, as it is. Which joint can leave its limits, and the test "
        "passes every sample?",
        options=(
            Option(
                "Joint 1: 350° becomes −10°.",
                "The sample at 350° slips through. But the motion begins inside, so joint 1 comes "
                "by 150° first: that stays 150° and is found.",
                "one posture for a motion",
                "Who leaves a garden comes through its gate, and there a guard sees them.",
            ),
            Option(
                "Joint 3.",
                "Nothing between −180° and 180° is past ±400°. A limit of more than half a turn "
                "has to be tested on angles that are unwrapped. (robokin.within judges postures: "
                "there whole turns are free. A motion cannot give them away.)",
            ),
            Option(
                "Joint 4: it cannot be wrapped.",
                "It is compared as it is, and that is right: a length has no turns.",
                "a length taken for an angle",
                "A stroke of 220 mm is past 180 mm, whatever happens to the angles.",
            ),
            Option(
                "None: a value past a limit stays past it.",
                "Wrapping changes values: 410° becomes 50°.",
                "wrapping taken for harmless",
                "The hose on joint 3 knows the turns that the wrapped angle forgets.",
            ),
        ),
        facts=_blind_facts,
        right=lambda facts: [[1], [3], [4], []].index(facts["blind"]),
        view=_blind_view,
    ),
    "p8": Prediction(
        question="A start {h1:.0f} mm over the via point, a goal {h2:.0f} mm over it. With a blend "
        "of {b0:.1f} the parabola's deepest point is {first:.0f} mm over via. How far over via is "
        "it with a blend of {b1:.1f}, in mm?",
        options=(
            Option(
                "{last:.0f}",
                "Every control pose of the corner is four times as far from via, so the whole "
                "corner is: it is the same picture, enlarged from via.",
            ),
            Option(
                "{square:.0f}",
                "The corner is four times as long and four times as high. A square would be right "
                "for an area.",
                "the square of a length",
                "A photo enlarged twice shows a man twice as high, not four times.",
            ),
            Option(
                "{twice:.0f}",
                "That is twice as high. The blend is {times:.0f} times as large, so each end of "
                "the corner is {times:.0f} times as far from via, and so is the deepest point.",
                "a doubling taken for the factor of the blend",
                "From blend {b0:.1f} to {half:.1f} it is twice, from {half:.1f} to {b1:.1f} twice "
                "again.",
            ),
            Option(
                "{less:.2f}",
                "More blend begins the corner earlier and leaves via farther away.",
                "more blend taken for a sharper corner",
                "Blend 0 goes through via.",
            ),
            Option(
                "{first:.0f}",
                "The deepest point moves: the ends of the corner do.",
                "the deepest point fixed",
                "Blend 0 goes down to via, 0 mm over it.",
            ),
            Option(
                "12",
                "Nothing is added: all lengths of the corner, seen from via, grow by the factor of "
                "the blend, {times:.0f}.",
                "something added",
                "Blend 0 passes through via, 0 mm over it: nothing is left to add.",
            ),
            Option(
                "24",
                "Each length of the corner, seen from via, grows by the factor of the blend, and "
                "{b1:.1f} is {times:.0f} times {b0:.1f}.",
                "another factor",
                "From blend {b0:.1f} to {half:.1f} the factor is 2: {twice:.0f} mm.",
            ),
        ),
        facts=_photo_facts,
        right=lambda facts: 0,
        view=_photo_view,
        unit="mm",
        within=0.02,
    ),
    "p9": Prediction(
        question="The parabola keeps the stroke of this lab's motion from a blend of "
        "{parabola:.3f} on. The quintic corner of lab 3, whose acceleration does not jump: from "
        "which blend on?",
        options=(
            Option(
                "Less, about {less:.2f}: it is the smoother curve.",
                "Smoother in its acceleration, and nearer to via: it hugs the corner and goes "
                "deeper.",
                "smooth taken for gentle",
                "In lab 3 the quintic passed via at 3/4 of the parabola's distance.",
            ),
            Option(
                "The same, about {parabola:.2f}: the corner begins and ends at the same places.",
                "They do: both corners begin and end there. In between it is another curve.",
                "the ends taken for the curve",
                "A detour and the road it replaces begin and end together, too.",
            ),
            Option(
                "More, about {quintic:.2f}: it cuts off less of the corner.",
                "At the same blend the quintic stays nearer to via, so it goes deeper. Its least "
                "blend is {quintic:.4f}.",
            ),
            Option(
                "None, not even {largest:.2f}: it goes through via.",
                "It comes nearer than the parabola, and it does not go through: the poses that "
                "draw it to via stop at 0.8 of the way there (lab 3, where the quintic is made).",
                "a control pose taken for a point of the curve",
                "The parabola has via itself as a control pose, and misses it.",
            ),
        ),
        facts=_quintic_facts,
        right=_quintic_right,
        view=_quintic_view,
    ),
    "p10": Prediction(
        question="You need to pass nearer to via: the blend goes from 0.4 to 0.2. To make up for "
        "it you allow 20 s instead of 10 s. What becomes of the stroke's acceleration in the "
        "corner?",
        options=(
            Option(
                "A quarter of it.",
                "The duration alone would do that. Half the blend costs twice the acceleration: "
                "the same turn in half the time.",
                "the blend left out",
                "At the same duration the blend 0.2 has {short:.2f} mm/s² instead of {before:.2f}.",
            ),
            Option(
                "Half of it.",
                "Half the blend doubles it, twice the time divides it by four: "
                "{before:.2f} mm/s² become {after:.2f} mm/s².",
            ),
            Option(
                "The same: half and double.",
                "The duration counts with its square: speeds are halved, and the time in which "
                "they change is doubled.",
                "an acceleration in proportion to the speed",
                "Play a film at half speed: every speed is half, every acceleration a quarter.",
            ),
            Option(
                "Twice as much.",
                "That is the blend alone; the longer time divides it by four.",
                "the duration left out",
                "Motions that take for ever need no acceleration.",
            ),
        ),
        facts=_cost_facts,
        right=_cost_right,
        view=_cost_view,
    ),
}
