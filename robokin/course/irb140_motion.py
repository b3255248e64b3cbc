"""Lab 03, straight lines, joint moves and rounded corners: its exercises and predictions.

The answers to each exercise come first, right and wrong, then the predictions' numbers and views;
the tables stand at the end.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np

from .._arrays import Floats
from ..arms import IRB140, follow, nearest
from ..motion import blend, differentiate, lin, linear, ptp, quintic, trapezoidal
from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, mm, wrapped
from .exercises import words
from .mistakes import METRES, Mistake, Program, Tools
from .old import Catch, Function
from .questions import Option, Prediction
from .told import apart, floats, one_number

OBJECTIVES = (
    "compute the joint motion for a straight line in space (LIN) and for a straight line in the "
    "joints (PTP), and tell from the task which one to use",
    "round a corner with a curve of your own, and choose the blend from the distance you can allow",
    "differentiate sampled joint angles, and tell a real acceleration from an artefact of the "
    "method",
)


def _pose(x: float, y: float, z: float, angle: float, axis: list[float]) -> Transform:
    return Transform(Quaternion.from_angle_axis(angle * deg, axis), np.array([x, y, z]) * mm)


# source 001, listings 11 (three poses) and 7 (two), as in the lab
START, VIA = _pose(200, 400, 200, 90, [-1, 0, 0]), _pose(650, -100, 800, 45, [0, 1, 0])
GOAL = _pose(300, 300, 500, 90, [0, 1, 0])
LEFT, RIGHT = _pose(200, 400, 600, 90, [-1, 0, 0]), _pose(200, -300, 800, 90, [0, 1, 0])
ROW = IRB140.branch(+1, +1, -1)
DURATION = 20.0  # s
T = np.linspace(0, DURATION, 1001)
S = T / DURATION


# --- 1: the blend from a distance -----------------------------------------------------------------

P0, P1, P2 = START.translation, VIA.translation, GOAL.translation


def _length(vector: Floats) -> float:
    return float(np.linalg.norm(vector))


D = _length(P0 - 2 * P1 + P2)
SHARES = {"parabola": 1 / 2, "quintic": 3 / 8}  # distance in the middle = share * blend * |D|


def _fraction(distance: float, corner: str) -> float:
    """The blend that passes via at `distance` in the middle of the corner; above 0.5: none does."""
    return distance / (SHARES[corner] * D)


def _limited(fraction: float) -> float:
    return fraction if fraction <= 0.5 else np.nan


def _fraction_for(tools: Tools, distance: float, corner: str) -> float:
    return _limited(_fraction(distance, corner))


def _fraction_cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    both = [0.05, 0.1, 0.001, 0.25, 0.3, 0.35, 0.45, 0.6, 1.0, 2.0]
    cases = [(d, corner) for d in both for corner in SHARES]
    cases += [(0.0002, "parabola"), (0.37, "parabola"), (0.38, "parabola")]
    cases += [(0.0, "parabola"), (0.0, "quintic")]
    cases += [(0.28, "quintic"), (0.29, "quintic")]
    for corner, share in SHARES.items():
        cases += [(float(d), corner) for d in rng.uniform(0.01, 0.49 * share * D, 6).round(4)]
    return cases


def _number(result: Any, case: tuple[Any, ...]) -> float:
    try:
        return one_number(result)
    except (TypeError, ValueError):
        raise ValueError(f"wanted a number from 0 to 0.5, or NaN, got {words(result)}") from None


def _fraction_law(case: tuple[Any, ...], yours: float) -> str | None:
    distance, corner = case
    wanted = _fraction_for(Tools(), distance, corner)
    if np.isnan(wanted):
        if np.isnan(yours):
            return None
        most, asked = apart(SHARES[corner] * 0.5 * D / mm, distance / mm)
        return (
            f"should be NaN: the largest blend, 0.5, passes via at {most} mm, and {asked} mm are "
            "asked for"
        )
    should = f"should be {wanted:.4g}: in the middle of the {corner} the tool is then"
    if not 0 <= yours <= 0.5:
        return f"{should} {distance / mm:.1f} mm from via"
    middle = blend(START, VIA, GOAL, yours, 0.5, corner=corner)
    gap = _length(middle.translation - P1)
    if abs(gap - distance) <= 0.05 * mm:
        return None
    asked, is_at = apart(distance / mm, gap / mm)
    return f"{should} {asked} mm from via; with {yours:.6g} it is {is_at} mm"


def _same_number(a: float, b: float) -> bool:
    # names a mistake, also one that was searched on samples; `_fraction_law` judges
    both = a == b or (np.isnan(a) and np.isnan(b))
    return bool(both or abs(a - b) <= 2e-4 + 2e-4 * abs(b))


@cache
def _nearest_share(corner: str) -> float:
    """The smallest distance on the way from via, as a share of blend times |D|."""
    place = blend(START, VIA, GOAL, 0.5, np.linspace(0, 1, 8001), corner=corner).translation
    return float(np.linalg.norm(place - P1, axis=-1).min()) / (0.5 * D)


def _instead(length: float) -> Program:
    return lambda d, corner: d / (SHARES[corner] * length)


def _inverse(distance: float, corner: str) -> float:
    return float(np.divide(1, _fraction(distance, corner)))


def _acceleration(distance: float, corner: str) -> float:
    return float(np.divide(D, distance))


# name, sentence, (distance, corner) -> blend, before its limit is looked at
FORMULAS: tuple[tuple[str, str, Program], ...] = (
    (
        "3/4 forgotten",
        "The quintic passes at 3/4 of the parabola's distance: for the same distance it needs "
        "more blend.",
        lambda d, corner: 2 * d / D,
    ),
    (
        "3/4 on the wrong side",
        "The quintic passes nearer to via, at 3/4 of the distance: it needs 4/3 of the blend, not "
        "3/4 of it.",
        lambda d, corner: 2 * d / D * (0.75 if corner == "quintic" else 1),
    ),
    (
        "3/4 for the wrong corner",
        "The factor 3/4 belongs to the quintic; the formula with b/2 is the parabola's.",
        lambda d, corner: 2 * d / D / (0.75 if corner == "parabola" else 1),
    ),
    (
        "3/4 for both corners",
        "The factor 3/4 belongs to the quintic alone.",
        lambda d, corner: 2 * d / D / 0.75,
    ),
    (
        "3/4 squared",
        "The factor 3/4 of the quintic is there twice.",
        lambda d, corner: 2 * d / D / (0.75**2 if corner == "quintic" else 1),
    ),
    (
        "3/4 instead of 3/8",
        "The quintic's 3/4 is a share of the parabola's distance, and that is b/2 times |D|: the "
        "1/2 belongs to both corners.",
        lambda d, corner: d / D * (2 if corner == "parabola" else 4 / 3),
    ),
    (
        "3/8 of b/2",
        "The quintic's distance is 3/4 of b/2 times |D|, which is 3/8 of b times |D|: the 1/2 is "
        "in the 3/8 already.",
        lambda d, corner: d / D * (2 if corner == "parabola" else 16 / 3),
    ),
    (
        "a factor of two",
        "Half of what it should be: the distance is b/2 times |D|, so b is twice the distance "
        "over |D|.",
        lambda d, corner: _fraction(d, corner) / 2,
    ),
    (
        "1/2 on the wrong side",
        "The distance is b/2 times |D|: solved for b, the 2 stands above the line, not below.",
        lambda d, corner: _fraction(d, corner) / 4,
    ),
    (
        "a factor of two too much",
        "Twice what it should be: the distance in the middle is b/2 times |D|, with |D| = "
        "|start - 2 via + goal|.",
        lambda d, corner: 2 * _fraction(d, corner),
    ),
    (
        "the first line for |D|",
        "The length of the line from start to via stands where |start - 2 via + goal| belongs.",
        _instead(_length(P1 - P0)),
    ),
    (
        "the second line for |D|",
        "The length of the line from via to goal stands where |start - 2 via + goal| belongs.",
        _instead(_length(P2 - P1)),
    ),
    (
        "start to goal for |D|",
        "|goal - start| does not know where via is: wanted is |start - 2 via + goal|.",
        _instead(_length(P2 - P0)),
    ),
    (
        "the sum of both lines for |D|",
        "The lengths of the two lines are added. |start - 2 via + goal| is the length of a sum of "
        "vectors, not the sum of lengths.",
        _instead(_length(P1 - P0) + _length(P2 - P1)),
    ),
    (
        "the mean of both lines for |D|",
        "The mean length of the two lines stands where |start - 2 via + goal| belongs.",
        _instead((_length(P1 - P0) + _length(P2 - P1)) / 2),
    ),
    (
        "the wrong sign of via in D",
        "D is start - 2 via + goal: via is subtracted. With a plus D depends on where the base is.",
        _instead(_length(P0 + 2 * P1 + P2)),
    ),
    (
        "via counted once in D",
        "D is start - 2 via + goal: without the 2 it depends on where the base is.",
        _instead(_length(P0 - P1 + P2)),
    ),
    (
        "a wrong length of D",
        "The components of D are added; the length is the root of the sum of their squares "
        "(np.linalg.norm).",
        _instead(float(abs(P0 - 2 * P1 + P2).sum())),
    ),
    (
        "D squared",
        "|D| is a length, the root of the sum of squares: yours is its square.",
        _instead(D**2),
    ),
    (
        "the end of the corner, not its middle, and 3/4",
        "This blend begins the corner at that distance from via. Asked is how near the tool comes "
        "in the middle of the corner.",
        lambda d, corner: d / (2 * _length(P1 - P0)) / (0.75 if corner == "quintic" else 1),
    ),
    (
        "0.4 and 0.8 from the wrong end",
        "The quintic's control poses stand at 0, 0.4 and 0.8 of the way to via, not at these "
        "distances from it.",
        lambda d, corner: d / ((0.625 if corner == "quintic" else 0.5) * D),
    ),
    (
        "the end of the corner, not its middle",
        "This blend begins the corner at that distance from via. Asked is how near the tool comes "
        "in the middle of the corner.",
        lambda d, corner: d / (2 * _length(P1 - P0)),
    ),
    (
        "the share of the line",
        "This is the distance over the length of the first line. The formula of section 6 has |D| "
        "in it, and a factor 2.",
        lambda d, corner: d / _length(P1 - P0),
    ),
    (
        "the smallest distance on the path",
        "The tool is nearest to via a little beside the middle of the corner. Asked is the "
        "distance in the middle.",
        lambda d, corner: d / (_nearest_share(corner) * D),
    ),
    (
        "the smallest distance on the path (of the parabola)",
        "The tool is nearest to via a little beside the middle of the corner. Asked is the "
        "distance in the middle.",
        lambda d, corner: d / (_nearest_share("parabola") * 2 * SHARES[corner] * D),
    ),
    (
        "the rotations in D",
        "D is made of the three places, not of the whole matrices: `.translation`.",
        _instead(_length(START.as_matrix() - 2 * VIA.as_matrix() + GOAL.as_matrix())),
    ),
    ("mm for m", METRES, lambda d, corner: _fraction(d, corner) * mm),
    ("mm for m", METRES, lambda d, corner: _fraction(d, corner) / mm),
    (
        "rounded",
        "Two digits are too few: the distance is off by millimetres.",
        lambda d, corner: round(_fraction(d, corner), 2),
    ),
    (
        "rounded",
        "Three digits are too few: the distance is off by tenths of a millimetre.",
        lambda d, corner: round(_fraction(d, corner), 3),
    ),
    (
        "taken from a coarse grid",
        "The nearest of the blends of the player is not exact: solve the formula for b.",
        lambda d, corner: 0.025 * round(_fraction(d, corner) / 0.025),
    ),
    ("percent", "A blend is a number from 0 to 0.5 here.", lambda d, c: 100 * _fraction(d, c)),
    (
        "distance and blend exchanged",
        "This is the distance of a blend; asked is the blend of a distance.",
        lambda d, corner: SHARES[corner] * d * D,
    ),
    (
        "inverse proportion",
        "Twice the distance needs twice the blend: the distance stands above the line.",
        _inverse,
    ),
    (
        "the formula of the acceleration",
        "|D| / b is the acceleration. The distance in the middle is b / 2 times |D|.",
        _acceleration,
    ),
)


def _raised(fraction: float) -> float:
    if fraction > 0.5:
        raise ValueError("too far")
    return fraction


# name, sentence, what is made of a blend
LIMITS: tuple[tuple[str, str, Program], ...] = (
    (
        "the limit is not looked at",
        "A blend above 0.5 does not exist: the corner would be longer than the motion. Return NaN.",
        lambda fraction: fraction,
    ),
    (
        "clipped at 0.5",
        "Where the distance is too large the answer is NaN: with 0.5 the tool passes nearer than "
        "asked, and nobody is told.",
        lambda fraction: min(fraction, 0.5),
    ),
    (
        "0 instead of NaN",
        "The blend 0 is the sharp corner. Where no blend will do the answer is NaN.",
        lambda fraction: fraction if fraction <= 0.5 else 0.0,
    ),
    (
        "limit 1 instead of 0.5",
        "A blend goes to 0.5: the corner then takes the whole motion, from 0 to 1.",
        lambda fraction: fraction if fraction <= 1 else np.nan,
    ),
    (
        "an error instead of NaN",
        "Where no blend will do the answer is NaN; no error is raised.",
        _raised,
    ),
)


def _beyond(most: float) -> Program:
    """The right formula with a limit of its own on the distance."""
    return lambda d, corner: np.nan if d > most else _fraction(d, corner)


def _fraction_mistakes() -> list[Mistake]:
    """Every wrong formula with the right limit, the right formula with every wrong limit, and both
    wrong.
    """
    found = [
        Mistake(name, says, lambda d, c, f=f: _limited(f(d, c)))
        for name, says, f in FORMULAS
        if f not in (_inverse, _acceleration)  # NaN always
    ]
    found += [
        Mistake(name, says, lambda d, c, limit=limit: limit(_fraction(d, c)))
        for name, says, limit in LIMITS
    ]
    found += [
        Mistake(
            "the limit of the parabola for both",
            "The quintic passes nearer to via: it comes to its limit at 3/4 of the parabola's "
            "distance. Look at the blend, not at the distance.",
            _beyond(D / 4),
        ),
        Mistake(
            "the limit of the quintic for both",
            "The parabola passes farther from via: it has room for more than the quintic. Look at "
            "the blend, not at the distance.",
            _beyond(3 / 16 * D),
        ),
        Mistake(
            "the distance compared with 0.5",
            "0.5 is the limit of the blend, not of the distance in metres.",
            _beyond(0.5),
        ),
        Mistake(
            "NaN at distance 0",
            "The distance 0 has an answer: the blend 0, the sharp corner through via.",
            lambda d, c: _limited(_fraction(d, c)) if d > 0 else np.nan,
        ),
        Mistake(
            "searched in steps of 0.001",
            "You try blends 0.001 apart. That is too coarse: solve for it, or search on between "
            "the two best.",
            lambda d, c: float(np.ceil(1000 * _limited(_fraction(d, c)))) / 1000,
        ),
        *(
            Mistake(
                "a value of the slider",
                "You take the best of a few blends. The right one mostly lies between two of them: "
                "solve for it.",
                lambda d, c, step=step: (
                    round(_limited(_fraction(d, c)) / step) * step
                    if _fraction(d, c) <= 0.5
                    else np.nan
                ),
            )
            for step in (0.025, 0.05)
        ),
    ]
    for name, says, f in FORMULAS:
        for also, more, limit in LIMITS[:3]:
            if f(0.05, "parabola") < 1e-3 or (f is _acceleration and also != LIMITS[0][0]):
                continue  # never above 0.5, or always: no limit, or the limit alone, is seen
            both, why = f"{name}, and {also}", f"{says} {more}"
            found.append(Mistake(both, why, lambda d, c, f=f, limit=limit: limit(f(d, c))))
    return found


# --- 2: the short way -----------------------------------------------------------------------------

TURN = 2 * np.pi
LOW, HIGH = IRB140.limits.T
SLACK = 1e-9


def _into(end: Floats) -> Floats:
    """By whole turns into the limits."""
    end = end + TURN * np.maximum(np.ceil((LOW - SLACK - end) / TURN), 0)
    inside: Floats = end - TURN * np.maximum(np.ceil((end - HIGH - SLACK) / TURN), 0)
    return inside


def _straight(q0: Floats, end: Floats, s: Floats) -> Floats:
    motion: Floats = q0 + s[:, None] * (end - q0)
    return motion


def _short_end(q0: Floats, q1: Floats) -> Floats:
    return _into(wrapped(q1, q0))


def _ptp_short(tools: Tools, q0: Floats, q1: Floats, s: Floats) -> Floats:
    return _straight(q0, _into(tools.short(q1, q0)), s)


def _short_cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    def case(q0: list[float], q1: list[float], s: Any) -> tuple[Any, ...]:
        return np.array(q0) * deg, np.array(q1) * deg, np.array(s, dtype=float)

    six, home = np.linspace(0, 1, 6), [10.0, 20.0, -40.0, 5.0, 30.0, 15.0]
    cases = [
        case(home, [40, 20, -40, 5, 30, 15], six),  # joint 1 alone, nothing to choose
        case(home, [10, 20, -40, 5, 30, -170], six),  # joint 6 through 180
        case([0, 0, 0, 0, 30, 170], [0, 0, 0, 0, 30, -170], [0, 0.5, 1]),  # the short way over 180
        case([0, 0, 0, 0, 30, -170], [0, 0, 0, 0, 30, 170], [0, 0.5, 1]),
        case([170, 0, 0, 0, 30, 0], [-170, 0, 0, 0, 30, 0], [0, 0.5, 1]),  # outside: no short way
        case([-170, 0, 0, 0, 30, 0], [170, 0, 0, 0, 30, 0], [0, 0.5, 1]),
        case([0, 0, 0, 190, 30, 0], [0, 0, 0, -175, 30, 0], [0, 0.5, 1]),  # joint 4: ±200
        case([0, 0, 0, 190, 30, 0], [0, 0, 0, -150, 30, 0], [0, 0.5, 1]),
        case([0, 0, 0, -190, 30, 0], [0, 0, 0, 150, 30, 0], [0, 0.5, 1]),
        case([0, 0, -150, 0, 30, 0], [0, 0, 150, 0, 30, 0], [0, 0.5, 1]),  # joint 3: -230 to 50
        case([0, 0, 20, 0, 30, 0], [0, 0, 160, 0, 30, 0], [0, 0.5, 1]),
        case([3, 5, -220, 2, 30, 4], [8, 5, 40, 2, 35, 9], [0, 0.5, 1]),
        case([0, 0, 0, 0, 30, 350], [0, 0, 0, 0, 30, -350], [0, 0.5, 1]),  # two turns
        case([0, 0, 0, 0, 30, -350], [0, 0, 0, 0, 30, 350], [0, 0.5, 1]),
        case([0, 0, 0, 0, 30, 350], [0, 0, 0, 0, 30, 60], [0, 0.5, 1]),  # 420 is outside
        case([0, 0, 0, 0, 30, -350], [0, 0, 0, 0, 30, -60], [0, 0.5, 1]),
        case([0, 0, 0, 0, 30, 350], [0, 0, 0, 0, 30, -300], [0, 0.5, 1]),
        case([0, 0, 0, 0, 30, 300], [0, 0, 0, 0, 30, 20], [0, 0.5, 1]),  # 380 is inside
        case([0, 0, 0, 0, 30, -300], [0, 0, 0, 0, 30, -20], [0, 0.5, 1]),
        case(home, home, [0, 0.5, 1]),  # stays
        case(home, [400, 380, 320, 365, 390, 375], [0, 0.5, 1]),  # all a turn on
        case([0, 0, 0, 0, 30, 380], [0, 0, 0, 0, 30, -340], [0, 0.3, 1]),  # stays, two turns on
        case([0, 0, 0, 0, 30, 350], [0, 0, 0, 0, 30, -710], [0, 0.5, 1]),  # three turns
        case([0, 0, 0, 0, 30, -350], [0, 0, 0, 0, 30, 710], [0, 0.5, 1]),
        case([0, 0, 0, -190, 30, 0], [0, 0, 0, -565, 30, 0], [0, 0.5, 1]),  # -205 is outside
        case([0, 0, 0, 190, 30, 0], [0, 0, 0, 565, 30, 0], [0, 0.5, 1]),
        case(home, [-60, 50, -90, 170, -40, -100], [0.5]),
        case(home, [-60, 50, -90, -170, -40, 120], [0.2, 0.25, 0.9]),
        case([100, -30, -200, 190, 60, 370], [-160, 40, 170, -179, -60, 30], np.linspace(1, 0, 5)),
    ]
    while len(cases) < 36:
        q0 = rng.uniform(LOW, HIGH).round(2)
        q1 = wrapped(rng.uniform(LOW, HIGH).round(2))
        if (abs(abs(wrapped(q1 - q0)) - np.pi) > 0.05).all():  # a half turn: two short ways
            cases.append((q0, q1, rng.uniform(0, 1, 7).round(3)))
    return cases


def _joint_values(result: Any, case: tuple[Any, ...]) -> Floats:
    wanted = f"wanted joint values of shape ({len(case[2])}, 6)"
    try:
        values = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {words(result)}") from None
    if values.ndim not in (1, 2) or 6 not in values.shape:
        raise ValueError(f"{wanted}, got {values.shape}")
    return values


def _short_law(case: tuple[Any, ...], yours: Floats) -> str | None:
    q0, q1, s = case
    end = _short_end(q0, q1)
    wanted = _straight(q0, end, s)
    if yours.shape != wanted.shape:
        return f"should have the shape {wanted.shape}: a row for each s, six joints in it"
    wrong = ~(abs(yours - wanted) <= 1e-6)
    if not wrong.any():
        return None
    i = int(wrong.any(axis=0).argmax())
    k = int(wrong[:, i].argmax())
    a, b, low, high = (round(float(x) / deg, 1) + 0.0 for x in (q0[i], end[i], LOW[i], HIGH[i]))
    at, is_at = apart(wanted[k, i] / deg, yours[k, i] / deg)
    return (
        f"joint {i + 1} should turn from {a:g}° to {b:g}° (its limits are {low:g}° and {high:g}°): "
        f"at s = {s[k]:.3g} it should be at {at}°, and is at {is_at}°"
    )


def _same_values(a: Floats, b: Floats) -> bool:
    """Where something is wrapped, rounding decides between 180° and -180°."""
    if a.shape != b.shape:
        return False
    at_180 = (abs(abs(a) - np.pi) < 1e-6) & (abs(abs(b) - np.pi) < 1e-6)
    return bool(np.all(at_180 | np.isclose(a, b, rtol=0, atol=1e-6, equal_nan=True)))


def _among(
    q0: Floats, q1: Floats, turns: Any, fits: Callable[[Floats], Any], step: float = TURN
) -> Floats:
    """The nearest to q0 of q1 + k * step that fits; the first k where none does."""
    values = q1 + step * np.reshape(np.array(list(turns), dtype=float), (-1, 1))
    travel = np.where(fits(values), abs(values - q0), np.inf)
    best = travel.argmin(axis=0)
    found: Floats = values[best, np.arange(6)]
    return found


def _fits(q: Floats) -> Any:
    return (q >= LOW - SLACK) & (q <= HIGH + SLACK)


def _one_turn_for_all(q0: Floats, q1: Floats) -> Floats:
    ends = [q1 + k * TURN for k in (0, -1, 1, -2, 2)]
    return min(ends, key=lambda end: float(abs(end - q0).sum()))


def _longest(q0: Floats, q1: Floats) -> Floats:
    ends = _short_end(q0, q1) + TURN * np.arange(-2, 3)[:, None]
    travel = np.where(_fits(ends), abs(ends - q0), -np.inf)
    longest: Floats = ends[travel.argmax(axis=0), np.arange(6)]
    return longest


def _line(q0: Floats, q1: Floats, s: Floats, row: int | None = None) -> Floats:
    path = lin(IRB140.fk(q0), IRB140.fk(q1), s)
    rows = IRB140.ik(path)
    first = abs(wrapped(rows[0] - q0)).sum(axis=-1)
    return follow(IRB140, rows, int(first.argmin()) if row is None else row)


def _ends(end: Program) -> Program:
    return lambda q0, q1, s: _straight(q0, end(q0, q1), s)


def _common(q0: Floats, q1: Floats) -> Floats:
    """One number of turns for all joints, all of them inside."""
    ends = [q1 + k * TURN for k in range(-4, 5)]
    inside = [end for end in ends if _fits(end).all()]
    return min(inside, key=lambda end: float(abs(end - q0).sum()), default=q1)


def _floored(q0: Floats, q1: Floats) -> Floats:
    return q1 + TURN * np.floor((q0 - q1) / TURN)


def _pinned(q0: Floats, q1: Floats, s: Floats) -> Floats:
    motion = _ptp_short(Tools(), q0, q1, s)
    motion[0], motion[-1] = q0, _short_end(q0, q1)
    return motion


def _first_allowed(q0: Floats, q1: Floats, s: Floats) -> Floats:
    """As `_symmetric`; the first of the values tried where none is allowed."""
    return _straight(q0, _among(q0, q1, range(-6, 7), lambda q: abs(q) <= HIGH), s)


def _symmetric(q0: Floats, q1: Floats, s: Floats) -> Floats:
    """As if each joint could go as far down as up."""
    turns = q1 + TURN * np.arange(-12, 13)[:, None]
    allowed = abs(turns) <= HIGH + SLACK
    allowed |= ~allowed.any(axis=0)
    best = np.where(allowed, abs(turns - q0), np.inf).argmin(axis=0)
    return _straight(q0, turns[best, np.arange(6)], s)


def _few(name: str, says: str, end: Callable[[Floats, Floats, int], Floats]) -> tuple[Mistake, ...]:
    """A wrong choice among q1 + 2 pi k, for k up to any number and for k up to two only."""
    also = f"{says} And q1 may be more than two turns away."
    return (
        Mistake(name, says, _ends(lambda q0, q1: end(q0, q1, 9))),
        Mistake(name, also, _ends(lambda q0, q1: end(q0, q1, 2))),
    )


def _upto(most: int) -> range:
    return range(-most, most + 1)


SHORT_MISTAKES = (
    Mistake(
        "the lower limit taken for minus the upper one",
        "The limits are not symmetric: joint 3 goes from -230° to 50°. Look at both.",
        _symmetric,
    ),
    Mistake(
        "the lower limit taken for minus the upper one",
        "The limits are not symmetric: joint 3 goes from -230° to 50°. Look at both.",
        _first_allowed,
    ),
    Mistake(
        "np.unwrap of the finished motion",
        "np.unwrap mends jumps from one sample to the next. Your motion has none: it is the end "
        "that has to be chosen, before the motion is made.",
        lambda q0, q1, s: np.unwrap(_straight(q0, q1, s), axis=0),
    ),
    Mistake(
        "one number of turns for all joints",
        "All joints are moved by the same number of turns. Each has a k of its own.",
        _ends(_common),
    ),
    Mistake(
        "floor for round",
        "Whole turns are counted with floor: that is a way of 0 to 360° in one direction. The "
        "nearest value takes round.",
        _ends(lambda q0, q1: _into(_floored(q0, q1))),
    ),
    Mistake(
        "floor for round, without the limits",
        "Whole turns are counted with floor: that is a way of 0 to 360° in one direction. The "
        "nearest value takes round. And the limits are not looked at.",
        _ends(_floored),
    ),
    Mistake(
        "the start is wrapped",
        "q0 is where the arm stands: it may not be moved by whole turns.",
        lambda q0, q1, s: _ptp_short(Tools(), wrapped(q0), q1, s),
    ),
    Mistake(
        "the first and the last sample are set to the ends",
        "s comes in any order, and need not hold 0 and 1: the first sample is not always the "
        "start, nor the last the end.",
        _pinned,
    ),
    Mistake(
        "the long way round",
        "The joints go to the values of q1 as they are. The arm stands the same at q1 + 2 pi k: "
        "take the value nearest to q0. (A whole turn is 2 pi here, and not 360.)",
        _ends(lambda q0, q1: q1),
    ),
    Mistake(
        "the limits are not looked at",
        "The way is the shortest, and leads out of the limits. Only values inside "
        "IRB140.limits count.",
        _ends(lambda q0, q1: wrapped(q1, q0)),
    ),
    Mistake(
        "wrapped into -180 to 180 degrees",
        "q1 is wrapped into -180° to 180°: that is the value nearest to 0, not nearest to q0.",
        _ends(lambda q0, q1: wrapped(q1)),
    ),
    Mistake(
        "wrapped into 0 to 360 degrees",
        "q1 is taken modulo 360°. Wanted is the value nearest to q0.",
        _ends(lambda q0, q1: q1 % TURN),
    ),
    Mistake(
        "both ends wrapped into 0 to 360 degrees",
        "q0 is where the arm stands: it may not be moved by whole turns.",
        lambda q0, q1, s: _straight(q0 % TURN, q1 % TURN, s),
    ),
    Mistake(
        "both ends wrapped into -180 to 180 degrees",
        "q0 is where the arm stands: it may not be moved by whole turns.",
        lambda q0, q1, s: _straight(wrapped(q0), wrapped(q1), s),
    ),
    Mistake(
        "nearest to zero",
        "Of the values inside the limits the one nearest to 0 is taken. Wanted is the one nearest "
        "to q0.",
        _ends(lambda q0, q1: _among(0 * q0, q1, (0, -1, 1, -2, 2), _fits)),
    ),
    Mistake(
        "always in the positive direction",
        "The difference modulo 360° is never negative: every joint turns in the positive "
        "direction.",
        _ends(lambda q0, q1: q0 + (q1 - q0) % TURN),
    ),
    Mistake(
        "the motion is wrapped",
        "The motion itself is wrapped into -180° to 180°: a joint that passes 180° jumps by a "
        "whole turn.",
        lambda q0, q1, s: wrapped(_straight(q0, q1, s)),
    ),
    Mistake(
        "the motion is wrapped",
        "The short way is found, and then the motion is wrapped into -180° to 180°: a joint that "
        "passes 180° jumps by a whole turn.",
        lambda q0, q1, s: wrapped(_straight(q0, _short_end(q0, q1), s)),
    ),
    Mistake(
        "only joint 6",
        "Only joint 6 takes the short way. Joints 1, 3 and 4 can turn by more than a half turn, "
        "too.",
        _ends(lambda q0, q1: np.append(q1[:5], _short_end(q0, q1)[5])),
    ),
    Mistake(
        "only joints 4 and 6",
        "Only joints 4 and 6 take the short way. Joints 1 and 3 can turn by more than a half turn, "
        "too.",
        _ends(lambda q0, q1: np.where([0, 0, 0, 1, 0, 1], _short_end(q0, q1), q1)),
    ),
    Mistake(
        "only one turn down",
        "Only q1 and q1 - 360° are tried. It may need a turn up.",
        _ends(lambda q0, q1: _among(q0, q1, (0, -1), _fits)),
    ),
    Mistake(
        "only one turn up",
        "Only q1 and q1 + 360° are tried. It may need a turn down.",
        _ends(lambda q0, q1: _among(q0, q1, (0, 1), _fits)),
    ),
    Mistake(
        "only one turn",
        "Joint 6 has 800°: from -400° to 400° it may need two whole turns.",
        _ends(lambda q0, q1: _among(q0, q1, (0, -1, 1), _fits)),
    ),
    Mistake(
        "only one turn, without the limits",
        "One whole turn is added or taken away where the way is longer than a half turn. Joint 6 "
        "may need two, and the limits are not looked at.",
        _ends(lambda q0, q1: _among(q0, q1, (0, -1, 1), lambda q: q == q)),
    ),
    Mistake(
        "only two turns",
        "q1 - 720° to q1 + 720° are tried. The values of q1 may be more turns away: the way to a "
        "value near q0 may need three of them.",
        _ends(lambda q0, q1: _among(q0, q1, (0, -1, 1, -2, 2), _fits)),
    ),
    Mistake(
        "only two turns, without the limits",
        "q1 - 720° to q1 + 720° are tried. The values of q1 may be more turns away. And only "
        "values inside IRB140.limits count.",
        _ends(lambda q0, q1: _among(q0, q1, (0, -1, 1, -2, 2), lambda q: q == q)),
    ),
    Mistake(
        "two turns up are left out",
        "range(-2, 2) ends at 1: two turns up are not tried.",
        _ends(lambda q0, q1: _among(q0, q1, (0, -1, 1, -2), _fits)),
    ),
    Mistake(
        "q1 where the short way leads out",
        "Where the short way leads out of the limits q1 is taken as it is. It may be outside "
        "itself, and of the values inside another one may be nearer.",
        _ends(lambda q0, q1: np.where(_fits(wrapped(q1, q0)), wrapped(q1, q0), q1)),
    ),
    *_few(
        "the limits of joint 6 for all",
        "Every joint has limits of its own, a row of IRB140.limits: -400° to 400° is joint 6.",
        lambda q0, q1, n: _among(q0, q1, _upto(n), lambda q: abs(q) <= HIGH[5] + SLACK),
    ),
    *_few(
        "the lowest value inside the limits",
        "Of the values inside the limits the lowest is taken. Wanted is the least abs(value - q0).",
        lambda q0, q1, n: _among(LOW, q1, _upto(n), _fits),
    ),
    *_few(
        "the highest value inside the limits",
        "Of the values inside the limits the highest is taken. Wanted is the least "
        "abs(value - q0).",
        lambda q0, q1, n: _among(HIGH, q1, _upto(n), _fits),
    ),
    *_few(
        "half turns",
        "Half turns are tried: q1 + pi k is another posture.",
        lambda q0, q1, n: _among(q0, q1, _upto(2 * n), _fits, np.pi),
    ),
    *_few(
        "only the upper limit",
        "The upper limits are looked at, the lower ones are not.",
        lambda q0, q1, n: _among(q0, q1, _upto(n), lambda q: q <= HIGH + SLACK),
    ),
    *_few(
        "only the lower limit",
        "The lower limits are looked at, the upper ones are not.",
        lambda q0, q1, n: _among(q0, q1, _upto(n), lambda q: q >= LOW - SLACK),
    ),
    Mistake(
        "clipped at the limit",
        "The end is clipped at the limit: it is another posture then. Where the short way leads "
        "out, the joint takes the other way.",
        _ends(lambda q0, q1: np.clip(wrapped(q1, q0), LOW, HIGH)),
    ),
    Mistake(
        "one number of turns for all joints",
        "All joints are moved by the same number of turns. Each has a k of its own.",
        _ends(_one_turn_for_all),
    ),
    Mistake(
        "the longest way",
        "Of the values inside the limits the one farthest from q0 is taken.",
        _ends(_longest),
    ),
    Mistake(
        "another configuration",
        "This ends in the same pose in another configuration, another row of ik. Wanted is the "
        "posture q1, up to whole turns.",
        _ends(lambda q0, q1: nearest(IRB140, IRB140.ik(IRB140.fk(q1)), q0)),
    ),
    Mistake(
        "unwrapped along the wrong axis",
        "np.unwrap goes along the last axis if it is not told: from joint to joint. Wanted is from "
        "q0 to q1, axis=0 (and the limits).",
        lambda q0, q1, s: _straight(np.unwrap(q0), np.unwrap(q1), s),
    ),
    Mistake(
        "a straight line in space",
        "The tool moves straight: that is LIN. In PTP the joint values move straight.",
        _line,
    ),
    Mistake(
        "a straight line in space",
        "The tool moves straight: that is LIN. In PTP the joint values move straight.",
        lambda q0, q1, s: _line(q0, q1, s, ROW),
    ),
    Mistake(
        "the start moves by whole turns",
        "q0 is where the arm stands. Choose among the values of q1, not of q0.",
        lambda q0, q1, s: _straight(_short_end(q1, q0), q1, s),
    ),
    Mistake(
        "start and end exchanged",
        "The motion begins at q1: at s = 0 it has to be q0.",
        lambda q0, q1, s: _straight(_short_end(q0, q1), q0, s),
    ),
    Mistake(
        "the start is left out",
        "s times the difference is the way: add it to q0.",
        lambda q0, q1, s: s[:, None] * (_short_end(q0, q1) - q0),
    ),
    Mistake(
        "the end for the difference",
        "s multiplies the difference of end and start, not the end.",
        lambda q0, q1, s: q0 + s[:, None] * _short_end(q0, q1),
    ),
    Mistake(
        "s is not looked at",
        "The samples are spread evenly from 0 to 1. Take s as it is given.",
        lambda q0, q1, s: _straight(q0, _short_end(q0, q1), np.linspace(0, 1, len(s))),
    ),
    Mistake(
        "a time law for s",
        "s is the progress already: no time law is wanted here.",
        lambda q0, q1, s: _straight(q0, _short_end(q0, q1), quintic(1)(s)),
    ),
    Mistake(
        "s is not a column",
        "s times a posture multiplies sample by joint. With s[:, None] each sample gets a row of "
        "six.",
        lambda q0, q1, s: q0 + s * (_short_end(q0, q1) - q0),
    ),
    Mistake(
        "s is not a column, and the long way round",
        "s times a posture multiplies sample by joint. With s[:, None] each sample gets a row of "
        "six. And q1 + 2 pi k is the same posture: take the one that is nearest to q0.",
        lambda q0, q1, s: q0 + s * (q1 - q0),
    ),
    Mistake(
        "the end alone",
        "This is the end of the motion. Wanted are the joint values at each s.",
        lambda q0, q1, s: _short_end(q0, q1),
    ),
)


# --- 3: a test for speeds -------------------------------------------------------------------------


def _middle(q: Floats, t: Floats) -> Floats:
    """From the mean speeds of the intervals, which belong to their middles."""
    between = wrapped(np.diff(q, axis=0)) / np.diff(t)[:, None]
    middles = (t[1:] + t[:-1]) / 2
    return np.stack([np.interp(t, middles, joint) for joint in between.T], axis=1)


def _parabolas(q: Floats, t: Floats) -> Floats:
    """Sample by sample, the slope of the parabola through it and its two neighbours."""
    speeds = []
    for k in range(len(t)):
        a = min(max(k - 1, 0), len(t) - 3)
        x = t[a : a + 3] - t[k]
        near = q[k] + wrapped(q[a : a + 3] - q[k])
        speeds.append(np.linalg.solve(np.stack([x**0, x, x**2], axis=1), near)[1])
    return np.array(speeds)


def _turned(q: Floats, t: Floats) -> Floats:
    """Angles as points of the unit circle; their turns are added up."""
    circle = np.exp(1j * q)
    turns = np.angle(circle[1:] / circle[:-1])
    return differentiate(np.concatenate([q[:1], q[0] + turns.cumsum(axis=0)]), t)


RIGHT_SPEEDS: tuple[tuple[str, Program], ...] = (
    (
        "np.unwrap, then robokin's differentiate",
        lambda q, t: differentiate(np.unwrap(q, axis=0), t),
    ),
    (
        "np.unwrap, then np.gradient, which is less exact in the first and last sample",
        lambda q, t: np.gradient(np.unwrap(q, axis=0), t, axis=0),
    ),
    ("the mean speeds of the intervals, interpolated in between", _middle),
    ("a parabola through three neighbours, sample by sample", _parabolas),
    ("turns of points of the unit circle", _turned),
    (
        "rounded to five digits after the point",
        lambda q, t: differentiate(np.unwrap(q, axis=0), t).round(5),
    ),
)


def _slopes(q: Floats, t: Floats) -> Floats:
    return np.diff(q, axis=0) / np.diff(t)[:, None]


def _good(q: Floats, t: Floats) -> Floats:
    return differentiate(np.unwrap(q, axis=0), t)


def _smoothed(q: Floats, t: Floats) -> Floats:
    v = _good(q, t)
    return np.stack([v[max(k - 25, 0) : k + 26].mean(axis=0) for k in range(len(v))])


def _one_way(q: Floats, t: Floats) -> Floats:
    """Falls by a turn are mended, rises are not."""
    falls = np.cumsum(np.diff(q, axis=0, prepend=q[:1]) < -np.pi, axis=0)
    return differentiate(q + TURN * falls, t)


def _cut(q: Floats, t: Floats) -> Floats:
    """No unwrapping: what is too fast is set to zero."""
    v = differentiate(q, t)
    return np.where(abs(v) > 50, 0.0, v)


def _ended(value: float) -> Program:
    def program(q: Floats, t: Floats) -> Floats:
        v = _good(q, t).copy()
        v[[0, -1]] = value
        return v

    return program


def _off(rows: Sequence[int]) -> Program:
    """These rows are 1 rad/s too fast."""

    def program(q: Floats, t: Floats) -> Floats:
        v = _good(q, t).copy()
        v[rows] += 1.0
        return v

    return program


def _between_the_ends(q: Floats, t: Floats) -> Floats:
    """The speeds go evenly from the first to the last one."""
    v, share = _good(q, t), (t - t[0]) / (t[-1] - t[0])
    even: Floats = v[0] + share[:, None] * (v[-1] - v[0])
    return even


def _last_unwrapped(q: Floats, t: Floats) -> Floats:
    q = q.copy()
    q[:, 5] = np.unwrap(q[:, 5])
    return differentiate(q, t)


SPEED_MISTAKES = (
    Mistake(
        "no unwrap",
        "It differentiates wrapped angles: where one passes 180° the speed is wrong. Let every "
        "joint of your motion pass 180°, which is pi here.",
        lambda q, t: differentiate(q, t),
    ),
    Mistake(
        "unwrapped along the wrong axis",
        "It unwraps from joint to joint instead of from sample to sample. Let every joint pass "
        "180°, the first one, too.",
        lambda q, t: differentiate(np.unwrap(q), t),
    ),
    Mistake(
        "only joint 6 is unwrapped",
        "It unwraps joint 6 alone. Let every joint of your motion pass 180°.",
        _last_unwrapped,
    ),
    Mistake(
        "unwrapped in one direction only",
        "It mends the fall from 180° to -180°, not the rise from -180° to 180°. Let joints pass "
        "180° in both directions.",
        _one_way,
    ),
    Mistake(
        "spikes are cut away",
        "It does not unwrap; it sets what is too fast to zero. Look at the samples where a joint "
        "passes 180°.",
        _cut,
    ),
    Mistake(
        "one sample less",
        "It returns one row less than there are samples (np.diff). Look at the shape first.",
        lambda q, t: _slopes(np.unwrap(q, axis=0), t),
    ),
    Mistake(
        "off by half a sample (forward)",
        "It is the mean speed up to the next sample. Where the joint accelerates that is not the "
        "speed at the sample: your motion needs acceleration, and your tolerance has to be fine.",
        lambda q, t: _slopes(
            np.unwrap(np.concatenate([q, 2 * q[-1:] - q[-2:-1]]), axis=0),
            np.append(t, 2 * t[-1] - t[-2]),
        ),
    ),
    Mistake(
        "off by half a sample (backward)",
        "It is the mean speed since the sample before. Where the joint accelerates that is not the "
        "speed at the sample: your motion needs acceleration, and your tolerance has to be fine.",
        lambda q, t: _slopes(
            np.unwrap(np.concatenate([2 * q[:1] - q[1:2], q]), axis=0),
            np.append(2 * t[0] - t[1], t),
        ),
    ),
    Mistake(
        "the step is forgotten",
        "It does not divide by the time: differences in rad, not speeds in rad/s.",
        lambda q, t: np.gradient(np.unwrap(q, axis=0), axis=0),
    ),
    Mistake(
        "the step is always 0.01 s",
        "It takes every step for 0.01 s. Your times should have other steps.",
        lambda q, t: np.gradient(np.unwrap(q, axis=0), 0.01, axis=0),
    ),
    Mistake(
        "the first step for all",
        "It takes every step to be as long as the first. Your times should not be evenly spaced.",
        lambda q, t: np.gradient(np.unwrap(q, axis=0), t[1] - t[0], axis=0),
    ),
    Mistake(
        "the mean step for all",
        "It takes all steps to be equally long. Your times should not be evenly spaced.",
        lambda q, t: np.gradient(np.unwrap(q, axis=0), (t[-1] - t[0]) / (len(t) - 1), axis=0),
    ),
    Mistake(
        "times that begin at 0",
        "It takes the last time for the duration. Let your times begin somewhere else than at 0.",
        lambda q, t: _good(q, t) * (t[-1] - t[0]) / (t[-1] or 1.0),
    ),
    Mistake("degrees", "It returns degrees per second.", lambda q, t: _good(q, t) / deg),
    Mistake("sign", "Every sign is turned round.", lambda q, t: -_good(q, t)),
    Mistake(
        "no sign",
        "It returns how fast a joint turns, not which way. Some joint has to turn back.",
        lambda q, t: abs(_good(q, t)),
    ),
    Mistake(
        "smoothed",
        "It takes the mean of up to 51 samples: peaks become flat. Your motion needs peaks of the "
        "speed, inside, and your tolerance has to be fine.",
        _smoothed,
    ),
    Mistake(
        "the ends are zero",
        "Its first and last rows are zero. Your motion should not begin and end at rest, and you "
        "have to look at the ends, too.",
        _ended(0.0),
    ),
    Mistake(
        "the ends are NaN",
        "Its first and last rows are NaN. A comparison with NaN is always False: ask whether the "
        "error is small, not whether it is large.",
        _ended(np.nan),
    ),
    Mistake(
        "the ends are off by 1 rad/s",
        "Its first and last rows are 1 rad/s too large. Look at the ends, too: they have to be "
        "right to 0.1 rad/s.",
        _off([0, -1]),
    ),
    Mistake(
        "the last row is off by 1 rad/s",
        "Its last row is 1 rad/s too large. Look at both ends: they have to be right to 0.1 rad/s.",
        _off([-1]),
    ),
    Mistake(
        "right at the ends only",
        "Its first and last rows are right; in between the speeds go evenly from one to the "
        "other. Look at every sample.",
        _between_the_ends,
    ),
    Mistake(
        "it stops half way",
        "It returns the first half of the rows. Look at the shape first.",
        lambda q, t: _good(q, t)[: len(t) // 2],
    ),
    Mistake(
        "only the first joint",
        "The other five columns are zero. All six joints should move.",
        lambda q, t: _good(q, t) * [1, 0, 0, 0, 0, 0],
    ),
    Mistake(
        "the last row is missing",
        "Its rows are right, but the last one is missing. Look at the shape first: a loop over "
        "pairs stops where the shorter one ends.",
        lambda q, t: _good(q, t)[:-1],
    ),
    Mistake(
        "a little too small",
        "Every speed is 0.003 rad/s too small. An error may have either sign: take its absolute "
        "value.",
        lambda q, t: _good(q, t) - 0.003,
    ),
    Mistake(
        "a little too large",
        "Every speed is 0.003 rad/s too large, three times what is promised.",
        lambda q, t: _good(q, t) + 0.003,
    ),
    Mistake(
        "accelerations",
        "It differentiates twice.",
        lambda q, t: differentiate(np.unwrap(q, axis=0), t, 2),
    ),
)


# --- The predictions' numbers and views -----------------------------------------------------------

MINUS = str.maketrans("-", "\N{MINUS SIGN}")
POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
STYLES = ("--", "-", ":")


class _Power(float):
    """A number that is written with one digit and a power of ten."""

    def __str__(self) -> str:
        digit, power = f"{float(self):.0e}".split("e")
        return f"{digit}·10{str(int(power)).translate(POWERS)}"

    def __format__(self, spec: str) -> str:
        return str(self)


def _posture(pose: Transform) -> Floats:
    q: Floats = IRB140.ik(pose)[ROW]
    return q


@cache
def _along() -> Floats:
    """The joints on the straight line of section 2."""
    return follow(IRB140, IRB140.ik(lin(LEFT, RIGHT, S)), ROW)


@cache
def _lin_facts() -> dict[str, Any]:
    v = abs(differentiate(_along(), T)) / deg
    low, high = v.min(axis=0), v.max(axis=0)
    tool = _length(RIGHT.translation - LEFT.translation) / mm / DURATION
    steady = [i + 1 for i in range(6) if high[i] - low[i] < 0.01 * high[i]]
    facts = {"tool": tool, "steady": steady}
    return facts | {
        f"{k}{i + 1}": x[i] for k, x in (("low", low), ("high", high)) for i in range(6)
    }


def _lin_right(facts: Mapping[str, Any]) -> int:
    return [[], [4, 5, 6], [1, 2, 3], [1, 2, 3, 4, 5, 6]].index(facts["steady"])


def _lin_view() -> Any:
    from ..show import plot_joints

    title = "A straight line at constant speed asks for curved joint motion"
    return plot_joints(IRB140, T, _along(), differentiate(_along(), T), title=title)


def _joint_move() -> Floats:
    """PTP between the poses of section 2."""
    return ptp(_posture(LEFT), _posture(RIGHT), S)


@cache
def _ptp_facts() -> dict[str, Any]:
    facts: dict[str, Any] = {}
    for name, q in (("lin", _along()), ("ptp", _joint_move())):
        share = abs(differentiate(q, T)).max(axis=0) / IRB140.speed_limits
        step = np.linalg.norm(np.diff(IRB140.fk(q).translation, axis=0), axis=-1)
        facts[f"{name}_joint"] = int(share.argmax()) + 1
        facts[f"{name}_share"] = 100 * share.max()
        facts[f"{name}_time"] = DURATION * share.max()
        facts[f"{name}_way"] = step.sum() / mm
    facts["by_way"] = facts["lin_time"] * facts["ptp_way"] / facts["lin_way"]
    return facts


def _ptp_view() -> Any:
    from ..show import animate

    title = "The same start and goal: straight in space, straight in the joints"
    motions, names = [_along(), _joint_move()], ["LIN", "PTP"]
    arms, targets = [IRB140, IRB140], [LEFT, RIGHT]
    return animate(arms, T, motions, names=names, targets=targets, title=title)


FROM, TO = 350.0, 60.0  # degrees, joint 6


def _turn_facts() -> dict[str, Any]:
    q0, q1 = np.zeros(6), np.zeros(6)
    q0[5], q1[5] = FROM * deg, TO * deg
    turn = (_short_end(q0, q1) - q0)[5] / deg
    short = float(wrapped(q1 - q0)[5]) / deg
    limit = HIGH[5] / deg
    return {"a": FROM, "b": TO, "limit": limit, "turn": turn, "back": -turn, "short": short}


def _turn_view() -> str:
    lines = [
        f"Values of joint 6 at which the arm stands the same, and the turn from {FROM:g}° to each:"
    ]
    for k in (-2, -1, 0, 1):
        value = TO + 360 * k
        inside = LOW[5] <= value * deg <= HIGH[5]
        lines.append(f"{value:g}°: turn {value - FROM:+g}°, {'inside' if inside else 'outside'}")
    return "\n".join(lines).translate(MINUS)


LAWS = {"linear": linear, "trapezoidal": trapezoidal, "quintic": quintic}


def _law_facts() -> dict[str, Any]:
    facts = {
        name: 100 * DURATION * differentiate(law(DURATION)(T), T).max()
        for name, law in LAWS.items()
    }
    return facts | {"excess": facts["quintic"] - 100, "factor": facts["quintic"] / 100}


def _law_view() -> Any:
    from ..show import figure

    fig = figure(
        "Progress, speed and acceleration of three time laws over 20 s. The linear law starts and "
        "ends at full speed, the trapezoidal law's acceleration jumps, the quintic law's does not; "
        "its speed has the highest peak.",
        height=3.4,
    )
    axes = fig.subplots(1, 3)
    for (name, law), style in zip(LAWS.items(), STYLES, strict=True):
        progress = law(DURATION)(T)
        curves = progress, differentiate(progress, T), differentiate(progress, T, 2)
        for ax, curve in zip(axes, curves, strict=True):
            ax.plot(T, curve, style, label=name, linewidth=2)
    labels = "progress s", "speed of s, 1/s", "acceleration of s, 1/s²"
    for ax, label in zip(axes, labels, strict=True):
        ax.set(title=label, xlabel="time t, s")
    axes[0].legend()
    fig.tight_layout()
    return fig


def _clock(step: float) -> Floats:
    return np.linspace(0, DURATION, round(DURATION / step) + 1)


def _sharp(step: float) -> Floats:
    """Joint 3 of two straight motions that meet, a sample every `step` seconds: (samples, 1)."""
    rows = IRB140.ik(blend(START, VIA, GOAL, 0.0, _clock(step) / DURATION))
    return follow(IRB140, rows, ROW)[:, 2:3]


def _corner_change(step: float) -> tuple[float, float]:
    """The greatest change of joint 3's speed from one interval to the next, rad/s, and what it
    gives divided by the step, where two straight motions meet.
    """
    v = np.diff(_sharp(step)[:, 0]) / step
    change = float(abs(np.diff(v)).max())
    return change, change / step


@cache
def _step_facts() -> dict[str, Any]:
    change, a = _corner_change(0.02)
    half, found = _corner_change(0.01)
    guesses = {"half": a / 2, "same": a, "double": 2 * a, "four": 4 * a}
    return guesses | {"change": change, "half_change": half, "found": found}


def _step_right(facts: Mapping[str, Any]) -> int:
    guesses = [facts[name] for name in ("half", "same", "double", "four")]
    return int(np.argmin([abs(np.log(guess / facts["found"])) for guess in guesses]))


def _step_view() -> str:
    lines = ["Joint 3 at t = 10 s, by differences of samples:"]
    for step in (0.02, 0.01, 0.005):
        change, a = _corner_change(step)
        twice = abs(differentiate(_sharp(step), _clock(step), 2)[:, 0]).max()
        lines.append(
            f"step {step:g} s: the speed changes by {change:.3f} rad/s; second differences "
            f"{a:.1f} rad/s²; differentiate(q, t, 2) {twice:.1f} rad/s²"
        )
    lines.append(
        "The change of the speed stays, the quotients do not: the first belongs to the robot's "
        "motion, the others to the method. (differentiate spreads the change over two steps: half "
        "the number.)"
    )
    return "\n".join(lines)


def _tool_acceleration(fraction: float, duration: float) -> float:
    """In the middle of the parabola's corner, measured, mm/s²."""
    t = np.linspace(0, duration, 1001)
    place = blend(START, VIA, GOAL, fraction, t / duration).translation
    return _length(differentiate(place, t, 2)[500]) / mm


@cache
def _slow_facts() -> dict[str, Any]:
    before, after = _tool_acceleration(0.1, DURATION), _tool_acceleration(0.05, DURATION)
    longer = DURATION * np.sqrt(after / before)  # the acceleration goes with 1 / duration²
    times = {"same": DURATION, "root": longer, "twice": 2 * DURATION, "four": 4 * DURATION}
    return times | {"before": before, "after": after}


def _slow_right(facts: Mapping[str, Any]) -> int:
    times = [facts[name] for name in ("same", "root", "twice", "four")]
    found = [_tool_acceleration(0.05, time) for time in times]
    return int(np.argmin([abs(a - facts["before"]) for a in found]))


def _slow_view() -> str:
    lines = ["The tool's acceleration in the middle of the corner:"]
    facts = _slow_facts()
    tried = [(0.1, facts["same"])]
    tried += [(0.05, facts[name]) for name in ("same", "root", "twice", "four")]
    for fraction, time in tried:
        a = _tool_acceleration(fraction, time)
        lines.append(f"blend {fraction:.2f}, duration {time:.1f} s: {a:.2f} mm/s²")
    return "\n".join(lines)


def _joint_3(fractions: Floats, corner: str) -> Floats:
    path = blend(START, VIA, GOAL, fractions[:, None], S, corner=corner)
    a = differentiate(follow(IRB140, IRB140.ik(path), ROW), T, 2)
    greatest: Floats = abs(a[..., 2]).max(axis=-1)
    return greatest


@cache
def _cost_facts() -> dict[str, Any]:
    parabola = float(_joint_3(np.array([0.1]), "parabola")[0])
    same_blend, same_distance = _joint_3(np.array([0.1, 0.1 / 0.75]), "quintic")
    return {
        "gap": 0.1 / 2 * D / mm,
        "parabola": parabola,
        "quintic": float(same_distance),
        "less": 0.75 * parabola,
        "at_blend": float(same_blend),
        "more": 100 * (same_distance / parabola - 1),
    }


def _cost_right(facts: Mapping[str, Any]) -> int:
    guesses = [facts[name] for name in ("less", "parabola", "quintic", "at_blend")]
    return int(np.argmin([abs(guess - facts["quintic"]) for guess in guesses]))


def _cost_view() -> str:
    lines = ["Joint 3's greatest acceleration where both corners pass via at the same distance:"]
    blends = np.array([0.05, 0.1, 0.15, 0.2])
    found = zip(
        blends, _joint_3(blends, "parabola"), _joint_3(blends / 0.75, "quintic"), strict=True
    )
    for b, parabola, quintic_ in found:
        more = f"{100 * (quintic_ / parabola - 1):+.0f} %".translate(MINUS)
        lines.append(
            f"{b / 2 * D / mm:.1f} mm: parabola (blend {b:.2f}) {parabola:.4f} rad/s², quintic "
            f"(blend {b / 0.75:.3f}) {quintic_:.4f} rad/s², {more}"
        )
    return "\n".join(lines)


def _too_much_misses(b: float) -> tuple[float, float]:
    """How far from start and goal the formula of the corner begins and ends, mm."""
    a, c = START.lerp(VIA, 1 - 2 * b), VIA.lerp(GOAL, 2 * b)

    def off(s: float, wanted: Transform) -> float:
        x = (s - 0.5 + b) / (2 * b)
        found = a.lerp(VIA, x).lerp(VIA.lerp(c, x), x)
        return _length(found.translation - wanted.translation) / mm

    return off(0.0, START), off(1.0, GOAL)


@cache
def _too_much_facts() -> dict[str, Any]:
    b = 0.55
    begins, ends = _too_much_misses(b)
    before = _length(START.lerp(VIA, 1 - 2 * b).translation - P0) / mm
    return {"x": (b - 0.5) / (2 * b), "before": before, "begins": begins, "ends": ends}


def _too_much_view() -> str:
    lines = ["Where the motion begins and ends, from start and goal:"]
    for b in (0.5, 0.51, 0.55, 0.6):
        begins, ends = _too_much_misses(b)
        lines.append(f"b = {b:.2f}: {begins:.2f} mm and {ends:.2f} mm")
    return "\n".join(lines)


def _too_much_right(facts: Mapping[str, Any]) -> int:
    guesses = [0.0, facts["before"], facts["begins"]]
    return int(np.argmin([abs(guess - facts["begins"]) for guess in guesses]))


def _exact_speed(seconds: float) -> Floats:
    """Joint speeds on the line of section 2, by the Jacobian, rad/s."""
    angle, axis = (RIGHT.rotation @ LEFT.rotation.inverse()).as_angle_axis()
    way = RIGHT.translation - LEFT.translation
    velocity = np.concatenate([way, angle * axis]) / DURATION
    q = _posture(LEFT.lerp(RIGHT, seconds / DURATION))
    return np.asarray(np.linalg.solve(IRB140.jacobian(q), velocity), dtype=float)


def _errors(steps: Floats) -> dict[str, Floats]:
    """The largest errors of three difference formulas at t = 5 s."""
    now, tiny = 5.0, 1e-4
    v = _exact_speed(now)
    a = (_exact_speed(now + tiny) - _exact_speed(now - tiny)) / (2 * tiny)  # good to 1e-11
    at = [IRB140.ik(LEFT.lerp(RIGHT, (now + k * steps) / DURATION))[:, ROW] for k in (-1, 0, 1)]
    before, here, after = at
    h = steps[:, None]
    found = {
        "speed, forward": (after - here) / h - v,
        "speed, central": (after - before) / (2 * h) - v,
        "acceleration": (after - 2 * here + before) / h**2 - a,
    }
    return {name: abs(error).max(axis=-1) for name, error in found.items()}


@cache
def _best_facts() -> dict[str, Any]:
    tiny, middle, large = _errors(np.array([1e-7, 1e-3, 1e-1]))["acceleration"]
    size = abs(_exact_speed(5.1) - _exact_speed(4.9)).max() / 0.2
    return {
        "tiny": _Power(tiny),
        "middle": _Power(middle),
        "large": _Power(large),
        "size": _Power(size),
    }


def _best_right(facts: Mapping[str, Any]) -> int:
    errors = [facts[name] for name in ("large", "middle", "tiny")]
    stays = errors[2] < 10 * errors[1]
    return 3 if stays else int(np.argmin(errors))


def _best_view() -> Any:
    from ..show import figure

    steps = 10.0 ** np.arange(-8, 0.6, 0.25)
    fig = figure(
        "Error of three difference formulas against the step, both axes logarithmic. Each curve is "
        "a V: the error falls with the step, until rounding makes it rise again.",
        height=3.8,
    )
    ax = fig.subplots()
    for (name, error), style in zip(_errors(steps).items(), ("--", "-", ":"), strict=True):
        ax.loglog(steps, error, style, linewidth=2, label=name)
    ax.axvline(0.01, color="0.6", linewidth=1)
    ax.set(
        xlabel="step h, s",
        ylabel="largest error of six joints, rad/s and rad/s²",
        title="A step can be too small: left of the V the error is rounding",
    )
    ax.legend()
    fig.tight_layout()
    return fig


@cache
def _hole_facts() -> dict[str, Any]:
    far = _pose(900, -100, 800, 45, [0, 1, 0])
    rows = IRB140.ik(blend(START, far, GOAL, 0.0, S))
    there = np.isfinite(rows[:, ROW]).all(axis=-1)
    missing = np.flatnonzero(~there)
    left = np.isfinite(np.unwrap(rows[:, ROW], axis=0)).all(axis=-1).sum()
    beside = np.isfinite(np.gradient(rows[:, ROW], axis=0)).all(axis=-1) & there
    return {
        "count": len(T),
        "first": int(missing[0]),
        "last": int(missing[-1]),
        "there": int(there.sum()),
        "beside": int(beside.sum()),
        "left": int(left),
    }


def _hole_right(facts: Mapping[str, Any]) -> int:
    return [0, facts["left"], facts["beside"], facts["there"]].index(facts["left"])


def _hole_view() -> str:
    facts = _hole_facts()
    return (
        f"np.unwrap(q, axis=0): {facts['left']} of {facts['count']} samples usable\n"
        f"follow: {facts['there']} of {facts['count']} samples usable"
    )


# --- The tables -----------------------------------------------------------------------------------

EXERCISES = {
    "1": Function(
        title="The blend from a distance",
        task="The blend (0 to 0.5) with which the tool passes at `distance` metres from via in the "
        "middle of the corner; NaN where even the blend 0.5 does not come so far away.",
        objective=2,
        hints=(
            "Section 6 has the distance of a blend: b/2 times |D|. Solve it for b. Then look at "
            "what the other corner changes, and at the largest b there is.",
            "D = start - 2 via + goal, of the three places (`.translation`, metres); |D| is its "
            "length, np.linalg.norm. The quintic passes at 3/4 of the parabola's distance with the "
            "same blend: with the same distance, does it need more blend or less?",
            "b = distance / (share * |D|) with share = 1/2 for the parabola and 3/8 for the "
            "quintic. Then `return b if b <= 0.5 else np.nan`. Check it with "
            "blend(start, via, goal, b, 0.5, corner).",
        ),
        inputs=("distance", "corner"),
        right=_fraction_for,
        cases=_fraction_cases,
        form=_number,
        law=_fraction_law,
        same=_same_number,
        mistakes=_fraction_mistakes(),
    ),
    "2": Function(
        title="PTP the short way",
        task="The PTP motion from q0 to the posture q1, each joint to that of the values "
        "q1 + 2 pi k inside its limits that is nearest to q0: (samples, 6).",
        objective=1,
        hints=(
            "PTP is two steps: choose the end, then go there straight in the joints. Only the "
            "first step is new: which values of a joint are the same posture?",
            "For each joint the values q1 + 2 pi k with k from -9 to 9, say, are the same posture. "
            "Keep those inside IRB140.limits, and of these take the one nearest to q0. Joint 6 may "
            "need three turns; joint 1 has to take the long way from 170° to -170°.",
            "`nearest` of section 3 does the first step if you give it one row: "
            "end = nearest(IRB140, q1[None], q0). Then q0 + s[:, None] * (end - q0).",
        ),
        inputs=("q0", "q1", "s"),
        right=_ptp_short,
        cases=_short_cases,
        form=_joint_values,
        law=_short_law,
        same=_same_values,
        mistakes=SHORT_MISTAKES,
    ),
    "3": Catch(
        title="A test for speeds",
        task="A test: whether the program speeds(q, t) makes right speeds of wrapped angles.",
        objective=3,
        hints=(
            "Take a motion of which you know the exact speeds by a formula, for instance "
            "a + b sin(c t + d). Then each wrong program is wrong on SOME motion: what must a "
            "motion have so that a forgotten unwrap shows? A wrong step? A half sample?",
            "Let all six joints move, pass 180° in both directions, turn back, and be under way "
            "at the first and the last sample. Let the times be uneven, and begin somewhere. Then "
            "look at the shape, at the inner samples (0.001 rad/s) and at both ends (0.1 rad/s).",
            "t = 3 + np.cumsum(rng.uniform(0.004, 0.01, 1000)) and q = pi + 2 sin(t + phase) with "
            "six phases, exact = 2 cos(t + phase); give the program (q + pi) % (2 pi) - pi. Return "
            "False for another shape; else whether abs(error) is below 0.001 inside and below 0.1 "
            "at the ends, in all samples.",
        ),
        rights=RIGHT_SPEEDS,
        promise="A right program may err by up to 0.001 rad/s inside, and by up to 0.1 rad/s in "
        "the first and the last sample.",
        mistakes=SPEED_MISTAKES,
    ),
}

# Every objective has its predictions: 1: p1, p2, p3 (and p4); 2: p6, p7; 3: p5, p8. p9 (of
# objective 2) and p10 (of 3) stand in "Deeper".
PREDICTIONS = {
    "p1": Prediction(
        question="The tool moves along a straight line at a constant {tool:.1f} mm/s and turns "
        "about a fixed axis at a constant rate. Which joints keep their speed?",
        options=(
            Option(
                "None of them.",
                "The inverse kinematics is not linear: a straight line in space is a bent line in "
                "the joints. Joint 1 goes between {low1:.1f} and {high1:.1f}°/s, joint 6 between "
                "{low6:.1f} and {high6:.1f}°/s.",
            ),
            Option(
                "Joints 4 to 6, the wrist: the tool turns at a constant rate.",
                "The wrist turns against the forearm, and the forearm turns, too: joint 6 goes "
                "between {low6:.1f} and {high6:.1f}°/s.",
                "place and rotation taken apart",
                "Carry a cup round a corner and keep it upright and facing north: your wrist works "
                "although the cup does not turn at all.",
            ),
            Option(
                "Joints 1 to 3, which carry the wrist along the line.",
                "The wrist centre goes on a path of its own, and even a straight one needs another "
                "speed at every place: joint 3 goes between {low3:.1f} and {high3:.1f}°/s.",
                "a straight path taken for a straight joint motion",
                "A piston that goes straight at a constant speed: its crank does not turn at a "
                "constant rate.",
            ),
            Option(
                "All six: what is constant at the tool is constant in the joints.",
                "Joint 1 turns by the wrist centre's speed round axis 1 over its distance from "
                "axis 1, and both change: it goes between {low1:.1f} and {high1:.1f}°/s.",
                "the tool's speed taken for the joints'",
                "A lighthouse beam that follows a ship on a straight course at a constant speed "
                "turns fastest when the ship is nearest.",
            ),
        ),
        facts=_lin_facts,
        right=_lin_right,
        view=_lin_view,
    ),
    "p2": Prediction(
        question="With PTP the tool travels {ptp_way:.0f} mm, with LIN {lin_way:.0f} mm. Both at "
        "constant progress, LIN takes at least {lin_time:.2f} s: then joint {lin_joint} is at its "
        "speed limit. How long does PTP take at least?",
        options=(
            Option(
                "{ptp_time:.2f} s: every joint keeps one speed.",
                "On a straight line joint {lin_joint} is slow for most of the time and fast at one "
                "place, {lin_share:.2f} % of its limit at a duration of 20 s; in PTP it keeps one "
                "speed, and no joint is above {ptp_share:.2f} %. So it is whenever the end values "
                "are equal: each joint makes the same turn in the same time, so its mean speed is "
                "the same. In PTP the mean is the greatest, too, and no motion has its greatest "
                "speed below its mean: PTP never takes longer.",
            ),
            Option(
                "{lin_time:.2f} s, too: the joints start and end at the same values.",
                "The ends are the same, and so are the mean speeds; the greatest speeds are not.",
                "the mean speed taken for the greatest",
                "Two cars cover the same road in the same hour; the one that waits half of it has "
                "to drive twice as fast.",
            ),
            Option(
                "{by_way:.2f} s: in proportion to the longer way.",
                "The limits are those of the joints, not of the tool: the tool's way does not "
                "count.",
                "the tool's way taken for the joints'",
                "Turn joint 1 alone by 90°: with the arm stretched the tool goes much farther than "
                "with the arm folded, and needs the same time.",
            ),
        ),
        facts=_ptp_facts,
        right=lambda facts: int(
            np.argmin(
                [abs(facts[k] - facts["ptp_time"]) for k in ("ptp_time", "lin_time", "by_way")]
            )
        ),
        view=_ptp_view,
    ),
    "p3": Prediction(
        question="Joint 6 may turn from −{limit:.0f}° to {limit:.0f}°. It stands at {a:.0f}°, and "
        "ik gives {b:.0f}° for the goal. By how many degrees does it turn, with the least travel "
        "that is allowed? (A turn down is negative.)",
        options=(
            Option(
                "{turn:.0f}",
                "{b:.0f}° + 360° would be nearer, and is past the limit of {limit:.0f}°. Of the "
                "values inside the limits {b:.0f}° itself is the nearest.",
            ),
            Option(
                "{short:.0f}",
                "That ends at 420°, past the limit of {limit:.0f}°.",
                "the limits forgotten",
                "Joint 1 may turn from −180° to 180°: from 170° to −170° it has to go back by "
                "340°.",
            ),
            Option(
                "{b:.0f}",
                "That is where it ends; asked is by how much it turns.",
                "the end for the difference",
                "From 350° to 350° it turns by 0°, not by 350°.",
            ),
            Option(
                "{back:.0f}",
                "The size is right: it turns down.",
                "start and end exchanged",
                "From 10° to 40° it turns by +30°: end minus start.",
            ),
        ),
        facts=_turn_facts,
        right=lambda facts: 0,
        view=_turn_view,
        unit="°",
        within=0.02,
    ),
    "p4": Prediction(
        question="The quintic law, s = 10x³ − 15x⁴ + 6x⁵ with x = t/T, covers the same way in the "
        "same time as the linear law, s = x. Its greatest speed, in percent of the linear law's?",
        options=(
            Option(
                "{quintic:.1f}",
                "The derivative of 10x³ − 15x⁴ + 6x⁵ is 30x²(1 − x)², and that is 30/16 in the "
                "middle: what is lost at the soft ends is made up for there.",
            ),
            Option(
                "{linear:.1f}",
                "That is the mean. Who is slow at both ends has to be faster in between.",
                "the mean speed taken for the greatest",
                "A train between two stops an hour and 60 km apart passes 60 km/h on its way.",
            ),
            Option(
                "{trapezoidal:.1f}",
                "That is the trapezoidal law's: it brakes harder than the quintic does at the end.",
                "the trapezoidal law's peak",
                "A trapezoid that speeds up for a quarter of the time: 1 / (1 − 1/4) = 133.3 %.",
            ),
            Option(
                "200",
                "That is a speed that rises straight up to the middle and falls straight down.",
                "the peak of a triangle",
                "The area below the curve is the way: a triangle needs twice the mean height, a "
                "bell needs less.",
            ),
            Option(
                "150",
                "That is the cubic law's, 3x² − 2x³. The quintic is softer at the ends.",
                "the cubic law's peak",
                "The derivative of the cubic is 6x(1 − x): 6/4 in the middle.",
            ),
            Option(
                "{factor:.3f}",
                "That is the factor; asked is the percentage.",
                "the factor for the percentage",
                "Twice as fast is 200 %.",
            ),
            Option(
                "{excess:.1f}",
                "That is by how much it is more.",
                "the excess for the whole",
                "Twice as fast is 200 %, not 100 %.",
            ),
        ),
        facts=_law_facts,
        right=lambda facts: 0,
        view=_law_view,
        unit="% of the linear law's speed",
        within=0.02,
    ),
    "p5": Prediction(
        question="We sample joint 3 every h = 0.02 s. Second differences, (q(t + h) − 2q(t) + "
        "q(t − h)) / h², give {same:.1f} rad/s² at via. What do they give there with h = 0.01 s?",
        options=(
            Option(
                "{half:.1f} rad/s²: finer samples see less of a change.",
                "The speed changes by {change:.3f} rad/s from one interval to the next, and by no "
                "less from a shorter one.",
                "the change divided in two",
                "Photograph a step of a staircase from nearer and nearer: it does not become "
                "lower.",
            ),
            Option(
                "{same:.1f} rad/s²: an acceleration does not depend on how we sample.",
                "True of an acceleration. This number is the jump of the speed divided by the "
                "step.",
                "a jump taken for an acceleration",
                "On the straight lines the same differences give the same number with both steps: "
                "there it is an acceleration.",
            ),
            Option(
                "About {double:.1f} rad/s²: the same change, in half the time.",
                "From one interval to the next the speed changes by {half_change:.3f} rad/s, and "
                "that is divided by half the step: {found:.1f} rad/s². A number that depends on "
                "the step says nothing about the robot.",
            ),
            Option(
                "About {four:.1f} rad/s²: the formula divides by the step squared.",
                "It does, and the second difference of q shrinks with the step: jump times step. "
                "One of the two steps remains.",
                "the step squared",
                "Of q = t² the second difference is 2h²: divided by h² it does not depend on h.",
            ),
        ),
        facts=_step_facts,
        right=_step_right,
        view=_step_view,
    ),
    "p6": Prediction(
        question="You may pass via at half the distance only: the blend goes from 0.1 to 0.05. The "
        "motion may take longer than {same:.0f} s. How long, so that the tool's acceleration in "
        "the corner stays what it was?",
        options=(
            Option(
                "{same:.0f} s: the path decides, not the time.",
                "Half the distance at the same time costs twice the acceleration: {after:.1f} "
                "instead of {before:.1f} mm/s².",
                "the distance left out",
                "A car in a tighter bend at the same speed: the side force grows.",
            ),
            Option(
                "{root:.1f} s: the root of 2 times as long.",
                "The acceleration is |D| / (b T²): half the blend doubles it, and a duration "
                "longer by the root of 2 makes up for that.",
            ),
            Option(
                "{twice:.0f} s: half the distance, twice the time.",
                "The acceleration goes with the square of the speed: at half the speed it is a "
                "quarter, more than is needed.",
                "acceleration in proportion to the speed",
                "At half the speed a car needs a quarter of the braking distance, not half of it.",
            ),
            Option(
                "{four:.0f} s: an acceleration goes with the square.",
                "The square belongs to the time: twice the acceleration is made up for by the "
                "root of 2, not by 2 squared.",
                "the square on the wrong side",
                "Four times the duration is a sixteenth of the acceleration.",
            ),
        ),
        facts=_slow_facts,
        right=_slow_right,
        view=_slow_view,
    ),
    "p7": Prediction(
        question="With the parabola and a blend of 0.1 the tool is {gap:.1f} mm from via in the "
        "middle of the corner, and joint 3 needs up to {parabola:.3f} rad/s². Now the quintic, "
        "with as much more blend as it "
        "needs to be as far from it. What does joint 3 need?",
        options=(
            Option(
                "Less, about {less:.2f} rad/s²: it is the smoother curve.",
                "Smooth means that the acceleration does not jump. To rise and fall gently within "
                "the corner it has to go higher in the middle.",
                "smooth taken for gentle",
                "The quintic time law is smoother than a trapezoid that speeds up for half of the "
                "time and brakes for the other half, and its greatest acceleration is 44 % higher.",
            ),
            Option(
                "The same {parabola:.3f} rad/s²: the distance decides.",
                "The parabola has a constant acceleration in the corner, the least that turns the "
                "velocity in that time. Another curve through the same point has another one.",
                "the distance alone decides",
                "Two ways round the same lamp post: one with the steering wheel held still, one "
                "with a wheel that turns in and out.",
            ),
            Option(
                "A little more, {quintic:.3f} rad/s²: a higher peak, in a longer corner.",
                "{more:.0f} % more than the parabola. The corner is longer, 4/3 of the blend, and "
                "that pays for most of the higher peak.",
            ),
            Option(
                "Much more, {at_blend:.3f} rad/s²: smooth ends are paid for in the middle.",
                "That is the quintic at the same blend, 0.1: it passes nearer to via then.",
                "compared at the same blend",
                "At the same blend the quintic has the greater acceleration: compare what the "
                "task fixes, the distance.",
            ),
        ),
        facts=_cost_facts,
        right=_cost_right,
        view=_cost_view,
    ),
    "p8": Prediction(
        question="We want the acceleration of the joints on the line of section 2, from samples: "
        "(q(t + h) − 2q(t) + q(t − h)) / h², in ordinary double precision (16 digits). Which step "
        "h gives the most exact result?",
        options=(
            Option(
                "0.1 s: a large step averages the rounding out.",
                "Rounding is small here already; the curve bends within 0.2 s, and that error is "
                "{large} rad/s².",
                "large steps taken for exact ones",
                "With h = 10 s three samples are the whole motion.",
            ),
            Option(
                "About 0.001 s: neither large nor small.",
                "There the error is {middle} rad/s²: truncation falls with h², rounding rises "
                "with 1/h², and they meet. At 0.1 s it is {large}, at 10⁻⁷ s {tiny}. (The "
                "grey line is at h = 0.01 s: truncation decides there.)",
            ),
            Option(
                "10⁻⁷ s: the smaller the step, the better.",
                "The rounding of the last digits is divided by h²: at 10⁻⁷ s the error is "
                "{tiny} rad/s², more than the acceleration itself, {size} rad/s².",
                "smaller is always better",
                "With h = 10⁻⁹ s q(t + h) and q(t) differ in their last digits only.",
            ),
            Option(
                "Any step below 0.001 s: the error has become as small as it can, and stays.",
                "It does not stay: rounding is divided by h², a hundred times more for a tenth of "
                "the step.",
                "it converges and stays",
                "At 10⁻⁷ s the error is {tiny} rad/s², at 0.001 s {middle}.",
            ),
        ),
        facts=_best_facts,
        right=_best_right,
        view=_best_view,
    ),
    "p9": Prediction(
        optional=True,
        question="With b = 0.55 the first control pose A lies {before:.1f} mm before the start, on "
        "the line from via to start and beyond. Where does the motion begin at s = 0?",
        options=(
            Option(
                "At the start pose: s = 0 is the start.",
                "The formula of the corner holds from the first sample on, and nothing in it keeps "
                "the curve at the start.",
                "the name of s taken for its place",
                "With b = 0.5 it does begin at the start: there A is the start, and x = 0.",
            ),
            Option(
                "{before:.1f} mm before the start, at A.",
                "The curve is at A for x = 0. At s = 0 it is x = {x:.3f} already.",
                "x taken for s",
                "With b = 0.1 the curve is at A for s = 0.4, not for s = 0.",
            ),
            Option(
                "{begins:.2f} mm away from the start: a little way along the curve from A.",
                "At s = 0 the curve is on its way from A, at x = {x:.3f}. It ends {ends:.2f} mm "
                "away from the goal, too. In a figure that is hard to see: the curves look "
                "smoother than ever. So a blend goes from 0 to 0.5, and robokin.blend says so.",
            ),
            Option(
                "Nowhere: lerp beyond the start is an error.",
                "Transform.lerp goes on beyond both ends without complaint.",
                "extrapolation taken for an error",
                "start.lerp(via, -1) is a pose as far before the start as via is behind it.",
            ),
        ),
        facts=_too_much_facts,
        right=_too_much_right,
        view=_too_much_view,
    ),
    "p10": Prediction(
        optional=True,
        question="q holds {count} samples of a motion, as ik gives them. Samples {first} to "
        "{last}, counted from 0, are out of reach: their rows are NaN. How many samples are "
        "usable after np.unwrap(q, axis=0), along time?",
        options=(
            Option(
                "0: one NaN spoils the array.",
                "What comes before the hole does not know of it.",
                "NaN taken to spread backwards",
                "np.cumsum([1, nan, 1]) begins with 1.",
            ),
            Option(
                "{left}: those before the hole.",
                "np.unwrap works by summing up, so after the first NaN everything is NaN. follow "
                "goes on from the last finite sample: {there} are usable.",
            ),
            Option(
                "{beside}: the neighbours of the hole are lost, too.",
                "That is what differences do. np.unwrap sums up.",
                "a sum taken for a difference",
                "np.diff([1, nan, 1, 2]) is [nan, nan, 1]: after the hole it is well again.",
            ),
            Option(
                "{there}: all that were numbers before.",
                "np.unwrap sums up the corrections from the first sample on, and a sum with a NaN "
                "in it is NaN.",
                "NaN taken for local",
                "np.cumsum([1, nan, 1]) is [1, nan, nan].",
            ),
        ),
        facts=_hole_facts,
        right=_hole_right,
        view=_hole_view,
    ),
}
