"""Lab 08, visit and collect: its exercises and predictions.

The answers to each exercise come first, right and wrong, then the predictions' numbers and views;
the tables stand at the end.
"""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cache
from itertools import permutations
from math import acos, asin, atan, atan2, hypot, pi
from typing import Any

import numpy as np

from .._arrays import Floats, Ints
from ..arms import spbu_arm, within
from ..jobs.conveyor import serve, spaced
from ..jobs.visit_collect import (
    Task,
    best_visit,
    collect,
    lowest,
    out_of_workspace,
    principal_postures,
    travel_time,
    visit,
    workspace,
)
from ..motion import ptp
from ..units import deg, mm
from .answers import run
from .exercises import Verdict, words
from .mistakes import DEGREES, Mistake, Program, Tools
from .old import Catch, Exercise, Fault, Function, Value
from .questions import Option, Prediction
from .told import apart, floats
from .variants import Numbers, dice

LAB = "visit_and_collect"
L1, L2 = 5.0, 4.0  # m, source 000, examples 2 and 3
ARM = spbu_arm(L1, L2)

OBJECTIVES = (
    "check a program that computes joint values for a point, with points of every kind that the "
    "arm serves",
    "compute how long a move takes, and from that when an arm is where",
    "tell when a greedy rule is the best and when it is not, and build a case that breaks it",
)


# --- 1: a test for inverse programs ---------------------------------------------------------------

Inverse = Callable[[Any], Any]
Joints = tuple[float, float, float]


def _triangle(x: float, y: float, z: float) -> tuple[float, float, float]:
    """The angle between vertical and the line to the point; beta; sin q3."""
    rho = hypot(x, y)
    d = max(hypot(rho, z), 1e-12)
    cos_beta = (L1**2 + d**2 - L2**2) / (2 * L1 * d)
    sin_3 = (L1**2 + L2**2 - d**2) / (2 * L1 * L2)
    return atan2(rho, z), acos(min(1, max(-1, cos_beta))), min(1, max(-1, sin_3))


def _principal(x: float, y: float, z: float) -> Joints:
    lean, beta, sin_3 = _triangle(x, y, z)
    return atan2(y, x), lean - beta, asin(sin_3)


def _mirrored(x: float, y: float, z: float) -> Joints:
    """The arm faces away from the point and leans over its back; within two turns."""
    lean, beta, sin_3 = _triangle(x, y, z)
    q1 = atan2(y, x)
    return q1 - pi if q1 > 0 else q1 + pi, -lean - beta, asin(sin_3)


def _inside(q: Joints) -> bool:
    return abs(q[0]) <= pi and abs(q[1]) <= pi / 2 and abs(q[2]) <= pi / 2


def _of_point(solve: Callable[[float, float, float], Any]) -> Inverse:
    def program(p: Any) -> Any:
        place = np.asarray(p, dtype=float)
        if place.size != 3:
            raise ValueError(f"p: wanted one point (3,) at a time, got shape {place.shape}")
        x, y, z = (float(c) for c in place.reshape(3))
        return np.array(solve(x, y, z), dtype=float)

    return program


def _changed(change: Callable[[float, float, float, float, float, float], Joints]) -> Inverse:
    """A program that has x, y, z and the principal q1, q2, q3, and makes something else of it."""
    return _of_point(lambda x, y, z: change(x, y, z, *_principal(x, y, z)))


def _mirrored_if_it_can(x: float, y: float, z: float) -> Joints:
    other = _mirrored(x, y, z)
    return other if _inside(other) else _principal(x, y, z)


def _now_and_then(x: float, y: float, z: float) -> Joints:
    other = _mirrored(x, y, z)
    return other if _inside(other) and int(1000 * abs(x)) % 2 else _principal(x, y, z)


def _spoiled_on_axis(x: float, y: float, z: float) -> Joints:
    q1, q2, q3 = _principal(x, y, z)
    return (float("nan") if hypot(x, y) < 1e-12 else q1), q2, q3


def _lost_on_border(x: float, y: float, z: float) -> Joints:
    """No answer where the arm is stretched or folded back, and none on the floor."""
    d = hypot(x, y, z)
    if min(L1 + L2 - d, d - (L1 - L2), z) < 1e-6:
        return float("nan"), float("nan"), float("nan")
    return _principal(x, y, z)


def _too_small(x: float, y: float, z: float) -> Joints:
    lower = x - 0.1, y - 0.1, max(z - 0.1, 0.0)
    return _principal(*lower) if L1 - L2 < hypot(*lower) < L1 + L2 else _principal(x, y, z)


def _short_by(gap: float) -> Callable[[float, float, float], Joints]:
    """Short of the point by so many metres."""

    def solve(x: float, y: float, z: float) -> Joints:
        share = 1 - gap / max(hypot(x, y, z), 1.0)
        return _principal(share * x, share * y, share * z)

    return solve


def _with(l1: float, l2: float, x: float, y: float, z: float) -> Joints:
    """The formulas with other links."""
    lean, d = atan2(hypot(x, y), z), max(hypot(x, y, z), 1e-12)
    cos_beta, sin_3 = (l1**2 + d**2 - l2**2) / (2 * l1 * d), (l1**2 + l2**2 - d**2) / (2 * l1 * l2)
    return atan2(y, x), lean - acos(min(1, max(-1, cos_beta))), asin(min(1, max(-1, sin_3)))


def _d_not_squared(x: float, y: float, z: float) -> Joints:
    lean, beta, _ = _triangle(x, y, z)
    sin_3 = (L1**2 + L2**2 - hypot(x, y, z)) / (2 * L1 * L2)
    return atan2(y, x), lean - beta, asin(min(1, max(-1, sin_3)))


RIGHT_INVERSES: tuple[tuple[str, Program], ...] = (
    ("the formulas of section 2", _of_point(_principal)),
    (
        "it takes the mirrored posture where that is inside the limits",
        _of_point(_mirrored_if_it_can),
    ),
    ("it takes now this posture, now that one", _of_point(_now_and_then)),
    ("its answer is a list", lambda p: _of_point(_principal)(p).tolist()),
    (
        "it searches, and stops 1e-8 m from the point",
        _changed(
            lambda x, y, z, q1, q2, q3: (q1 * (1 - 1e-10), q2 * (1 - 1e-10), q3 * (1 - 1e-10))
        ),
    ),
    ("it searches, and stops 5e-7 m from the point", _of_point(_short_by(5e-7))),
    (
        "it leaves joint 1 at 2 rad where the point is on axis 1",
        _changed(lambda x, y, z, q1, q2, q3: (2.0 if hypot(x, y) == 0 else q1, q2, q3)),
    ),
)

INVERSE_MISTAKES = (
    Mistake(
        "the answer of one example",
        "It always gives the joint values of (2, 3, 2). One point is no test.",
        lambda p: _of_point(_principal)([2, 3, 2]),
    ),
    Mistake("degrees for radians", DEGREES, lambda p: _of_point(_principal)(p) / deg),
    Mistake(
        "arctan for atan2",
        "Joint 1 comes from arctan(y / x): behind the base, at negative x, it faces the wrong way. "
        "Your test accepts it: a wrong answer at such a point has to make it say False.",
        _changed(lambda x, y, z, q1, q2, q3: (atan(y / x) if x else np.sign(y) * pi / 2, q2, q3)),
    ),
    Mistake(
        "arccos for atan2",
        "Joint 1 comes from arccos(x / rho): at negative y it turns to the wrong side. Try points "
        "there.",
        _changed(lambda x, y, z, q1, q2, q3: (abs(q1), q2, q3)),
    ),
    Mistake(
        "joint 1 turned the other way",
        "The sign of joint 1 is wrong. In the arm's own plane nothing of that is seen: compare all "
        "three coordinates.",
        _changed(lambda x, y, z, q1, q2, q3: (-q1, q2, q3)),
    ),
    Mistake(
        "x and y exchanged",
        "Joint 1 is atan2(x, y). On the line x = y nothing of that is seen.",
        _changed(lambda x, y, z, q1, q2, q3: (atan2(x, y), q2, q3)),
    ),
    Mistake(
        "joint 1 always zero",
        "Joint 1 is forgotten: it serves points with y = 0 and positive x alone.",
        _changed(lambda x, y, z, q1, q2, q3: (0.0, q2, q3)),
    ),
    Mistake(
        "the other elbow",
        "The tool arrives, with the elbow on the other side and joint 3 past its limit. Look at "
        "the limits, too.",
        _changed(lambda x, y, z, q1, q2, q3: (q1, 2 * _triangle(x, y, z)[0] - q2, pi - q3)),
    ),
    Mistake(
        "the mirrored posture, always",
        "The tool arrives, but for many points joint 2 is past its limit then. Look at the limits, "
        "at points far out and low.",
        _of_point(_mirrored),
    ),
    Mistake(
        "joint 1 from 0 to 360 degrees",
        "The tool arrives, but at negative y joint 1 is past its limit of 180 degrees: a whole "
        "turn less is another joint value. `within` takes whole turns off first: compare the "
        "numbers themselves with the limits.",
        _changed(lambda x, y, z, q1, q2, q3: (q1 % (2 * pi), q2, q3)),
    ),
    Mistake(
        "beta on the wrong side",
        "Link 1 leans by the angle of the line plus beta, and joint 3 does not fit to that.",
        _changed(lambda x, y, z, q1, q2, q3: (q1, 2 * _triangle(x, y, z)[0] - q2, q3)),
    ),
    Mistake(
        "beta left out",
        "Link 1 points at the target itself.",
        _changed(lambda x, y, z, q1, q2, q3: (q1, _triangle(x, y, z)[0], q3)),
    ),
    Mistake(
        "measured from the floor",
        "The angle of the line is taken from the floor, joint 2 is counted from the vertical. "
        "Where the line rises by 45 degrees nothing of that is seen.",
        _changed(lambda x, y, z, q1, q2, q3: (q1, q2 + pi / 2 - 2 * _triangle(x, y, z)[0], q3)),
    ),
    Mistake(
        "arccos for arcsin",
        "Joint 3 is the angle between the links, not what it is short of 90 degrees.",
        _changed(lambda x, y, z, q1, q2, q3: (q1, q2, pi / 2 - q3)),
    ),
    Mistake(
        "the sign of joint 3",
        "Joint 3 bends up where it should bend down.",
        _changed(lambda x, y, z, q1, q2, q3: (q1, q2, -q3)),
    ),
    Mistake(
        "joint 3 never negative",
        "The sign of joint 3 is lost: wrong beyond 6.4 m from the origin. Try points far out.",
        _changed(lambda x, y, z, q1, q2, q3: (q1, q2, abs(q3))),
    ),
    Mistake(
        "joint 3 never positive",
        "The sign of joint 3 is lost: wrong nearer than 6.4 m to the origin. Try points near it.",
        _changed(lambda x, y, z, q1, q2, q3: (q1, q2, -abs(q3))),
    ),
    Mistake(
        "d for d squared",
        "Joint 3 takes d where its square belongs: right at d = 1 m and nowhere else.",
        _of_point(_d_not_squared),
    ),
    Mistake(
        "the links exchanged",
        "l1 and l2 are exchanged.",
        _of_point(lambda x, y, z: _with(L2, L1, x, y, z)),
    ),
    Mistake(
        "y left out of rho",
        "The distance from the axis is taken as |x|.",
        _of_point(lambda x, y, z: (atan2(y, x), *_principal(abs(x), 0.0, z)[1:])),
    ),
    Mistake(
        "1 % too near",
        "The tool stops 1 % short of the point.",
        _of_point(lambda x, y, z: _principal(0.99 * x, 0.99 * y, 0.99 * z)),
    ),
    Mistake(
        "every coordinate too small",
        "The tool is 0.1 m off, with every coordinate too small. A test that asks whether a "
        "difference is less than 1e-6 lets negative differences pass: take the absolute value, or "
        "the length.",
        _of_point(_too_small),
    ),
    Mistake(
        "rounded to three digits",
        "The joint values are rounded to thousandths: the tool is off by millimetres, and 1e-6 m "
        "is asked.",
        _changed(lambda x, y, z, q1, q2, q3: (round(q1, 3), round(q2, 3), round(q3, 3))),
    ),
    Mistake(
        "0.003 mm too near",
        "The tool stops 3e-6 m short of the point, and 1e-6 m is asked. np.allclose and np.isclose "
        "allow 1e-5 of the number on top: give them rtol=0, atol=1e-6.",
        _of_point(_short_by(3e-6)),
    ),
    Mistake(
        "not a number on axis 1",
        "It divides by the distance from axis 1, so it has no answer at (0, 0, 6). A test finds "
        "that with a point on the axis, and with a comparison that NaN does not pass.",
        _of_point(_spoiled_on_axis),
    ),
    Mistake(
        "not a number on the border",
        "It has no answer where the arm is stretched or folded back, nor on the floor, though "
        "these points belong to the workspace. A test finds that with a point there, as (9, 0, 0), "
        "and with a comparison that NaN does not pass.",
        _of_point(_lost_on_border),
    ),
    Mistake(
        "a matrix of one row",
        "It returns shape (1, 3) where three numbers (3,) are wanted. Look at the shape, too.",
        lambda p: _of_point(_principal)(p)[None],
    ),
)


class InverseTest(Catch):
    """Says about which point a right program was asked last, and what it answered."""

    def refusal(self, answer: Program, program: Program) -> Sequence[str]:
        calls: list[tuple[Any, Any]] = []

        def recorded(p: Any) -> Any:
            calls.append((np.array(p, dtype=float), program(p)))
            return calls[-1][1]

        run(answer, [(recorded,)])
        if not calls:
            return ["It never calls the program."]
        p, q = calls[-1][0].reshape(3), np.asarray(calls[-1][1], dtype=float)
        if not workspace(L1, L2, p).all():
            why = f"this point is not in the workspace: it {out_of_workspace(L1, L2, p)[0]}."
        else:
            off = float(np.linalg.norm(ARM.fk(q).translation - p))
            why = f"inside the limits, with the tool {off:.1g} m from the point."
        return [f"The last point before its no: {words(p)} m. The answer: {words(q)} rad; {why}"]


# --- 2: when the arm is where ---------------------------------------------------------------------


def _filled(q: Floats) -> Floats:
    """Joint 1 keeps its angle on the axis; at the beginning it has the first angle known."""
    q = q.copy()
    known = ~np.isnan(q[:, 0])
    source = np.where(known, np.arange(len(q)), known.argmax())
    q[:, 0] = q[np.maximum.accumulate(source), 0]
    return q


def _each(q: Floats, speeds: Floats) -> Floats:
    """What each joint needs for each move: (n, 3)."""
    needs: Floats = abs(np.diff(q, axis=0)) / speeds
    return needs


def _arrivals(tools: Tools, q: Floats, speeds: Floats) -> Any:
    return np.cumsum(_each(_filled(q), speeds).max(axis=-1))


def _arrivals_cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    nan = np.nan

    def case(q: Any, speeds: Any = (0.5, 0.5, 0.5)) -> tuple[Any, ...]:
        return np.array(q, dtype=float), np.array(speeds, dtype=float)

    cases = [
        case([[0, 0, 0], [0.2, 0.4, -0.6]]),
        case([[0.4, 0.2, 0.1], [0.1, 0.5, 0.2]], [0.5, 0.2, 1]),
        case([[0, 0, 0], [1, 0.2, 0.1], [0.5, 0.9, 0.3]], [0.5, 1, 0.25]),
        case([[0, 0, 0], [0.6, 0.1, 0.2], [0, 0, 0]], [0.2, 0.4, 0.5]),  # there and back
        case([[0.3, 0.1, 0.2], [0.3, 0.1, 0.2], [0.5, 0.1, 0.2]]),  # a stop where it stands
        case([[0.8, 0.1, 0.2], [nan, 0.4, 0.2], [-0.4, 0.1, 0.2]]),  # over the axis
        case([[-0.9, 0.2, 0.3], [nan, 0.3, 0.1], [0.3, 0.1, 0.2]], [0.3, 0.5, 0.2]),
        case([[nan, 0.3, 0.2], [1.2, 0.2, 0.1]]),  # begins on the axis
        case([[nan, 0.3, 0.2], [-1.2, 0.5, 0.1], [0.3, 0.2, 0.2]]),
        case([[0.9, 0.3, 0.2], [nan, 0.1, 0.5]]),  # ends there
        case([[0.9, 0.3, 0.2], [nan, 0.1, 0.5], [nan, 0.4, 0.1], [-0.6, 0.2, 0.2]]),  # two of them
        case([[nan, 0.3, 0.2], [nan, 0.6, 0.5], [2, 0.4, 0.1], [1, 0.2, 0.2]]),
        case([[0.7, 0.3, 0.2], [nan, 0.1, 0.5], [0.7, 0.2, 0.2], [nan, 0.3, 0.3], [-1, 0.1, 0]]),
        case([[3.1, 0.2, 0.2], [-3.1, 0.2, 0.2]]),  # across the half turn
        case([[-3.1, 0.2, 0.2], [nan, 0.3, 0.4], [3.1, 0.2, 0.2]], [0.4, 0.5, 0.3]),
    ]
    while len(cases) < 30:
        n = int(rng.integers(2, 7))
        q = rng.uniform([-3, -1.4, -1.4], [3, 1.4, 1.4], size=(n, 3)).round(2)
        q[rng.uniform(size=n) < 0.25, 0] = nan
        if not np.isnan(q[:, 0]).all():
            cases.append(case(q, rng.uniform(0.1, 1, 3).round(2)))
    return cases


def _times(result: Any, case: tuple[Any, ...]) -> Floats:
    n = len(case[0]) - 1
    wanted = f"wanted {n} time{'s' * (n > 1)}, one for each stop after the start"
    try:
        values = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {words(result)}") from None
    if values.shape in ((n, 1), (1, n)):
        values = values.reshape(n)
    if n == 1 and values.ndim == 0:
        values = values.reshape(1)
    if values.shape == (n + 1,) and values[0] == 0:
        raise ValueError(f"{wanted}: the start has none; yours begins with 0 for it")
    if values.shape != (n,):
        raise ValueError(f"{wanted}, got {words(result)}")
    return values


def _arrivals_law(case: tuple[Any, ...], yours: Floats) -> str | None:
    q, speeds = case
    wanted = _arrivals(Tools(), q, speeds)
    wrong = ~(abs(yours - wanted) <= 1e-6 * (1 + wanted))
    if not wrong.any():
        return None
    k = int(wrong.argmax())
    needs = _each(_filled(q), speeds)[k]
    j = int(needs.argmax())
    kept = " (on the axis joint 1 keeps its angle)" if np.isnan(q[: k + 2, 0]).any() else ""
    at, is_at = apart(wanted[k], yours[k], 3)
    return (
        f"stop {k + 1} should be reached at {at} s: the move to it takes {needs[j]:.4g} s, set by "
        f"joint {j + 1}{kept}; you have {is_at} s"
    )


def _same_times(a: Floats, b: Floats) -> bool:
    return a.shape == b.shape and bool(np.allclose(a, b, rtol=1e-6, atol=1e-6, equal_nan=True))


# what is made of the moves (n, 3) -> times (n,); q and speeds as given, free angles filled
Moves = Callable[[Floats, Floats], Floats]


def _busiest(q: Floats, speeds: Floats) -> Floats:
    turns = abs(np.diff(q, axis=0))
    j = turns.argmax(axis=-1)
    legs: Floats = turns.max(axis=-1) / speeds[j]
    return legs


def _short(q: Floats, speeds: Floats) -> Floats:
    turns = abs(np.diff(q, axis=0))
    turns[:, 0] = abs((turns[:, 0] + pi) % (2 * pi) - pi)
    legs: Floats = (turns / speeds).max(axis=-1)
    return legs


def _back_filled(q: Floats) -> Floats:
    """Joint 1 turns on the way to the axis, to the angle wanted after it."""
    back = _filled(q[::-1])[::-1]
    return back.copy()


def _next_only(q: Floats) -> Floats:
    """The same, and a NaN at the end stays."""
    q = q.copy()
    for k in range(len(q) - 2, -1, -1):
        if np.isnan(q[k, 0]):
            q[k, 0] = q[k + 1, 0]
    return q


def _halfway(q: Floats) -> Floats:
    q = q.copy()
    k, known = np.arange(len(q)), ~np.isnan(q[:, 0])
    q[:, 0] = np.interp(k, k[known], q[known, 0])
    return q


def _one_before(q: Floats) -> Floats:
    """Only from the stop before, as it was given."""
    q = q.copy()
    before = np.concatenate([q[:1, 0], q[:-1, 0]])
    q[:, 0] = np.where(np.isnan(q[:, 0]), before, q[:, 0])
    return q


def _start_zero(q: Floats) -> Floats:
    q = q.copy()
    q[0, 0] = np.nan_to_num(q[0, 0])
    return _filled(q)


def _first_known(q: Floats) -> Floats:
    """One angle, the first known, for every stop on the axis."""
    q = q.copy()
    q[:, 0] = np.where(np.isnan(q[:, 0]), q[~np.isnan(q[:, 0]), 0][0], q[:, 0])
    return q


def _start_left(q: Floats) -> Floats:
    """Carried on from the start, which stays NaN where it is."""
    filled = _filled(q)
    filled[: int((~np.isnan(q[:, 0])).argmax()), 0] = np.nan
    return filled


def _mean_known(q: Floats) -> Floats:
    """The mean of all angles known."""
    q = q.copy()
    q[:, 0] = np.where(np.isnan(q[:, 0]), np.nanmean(q[:, 0]), q[:, 0])
    return q


def _start_last(q: Floats) -> Floats:
    """A start on the axis gets the last angle known."""
    q = q.copy()
    if np.isnan(q[0, 0]):
        q[0, 0] = q[~np.isnan(q[:, 0]), 0][-1]
    return _filled(q)


def _start_next(q: Floats) -> Floats:
    """A start on the axis gets what stands at the next stop, NaN or not; then carried on."""
    q = q.copy()
    if np.isnan(q[0, 0]):
        q[0, 0] = q[1, 0]
    return _filled(q) if not np.isnan(q[0, 0]) else _start_left(q)


def _nearest_known(q: Floats) -> Floats:
    """The angle known at the nearest stop, before or after."""
    q = q.copy()
    known = np.flatnonzero(~np.isnan(q[:, 0]))
    away = abs(np.arange(len(q))[:, None] - known)
    q[:, 0] = q[known[away.argmin(axis=-1)], 0]
    return q


def _as_given(q: Floats) -> Floats:
    return q


def _quiet(needs: Floats) -> Floats:
    """A NaN counts as 0."""
    counted: Floats = np.nan_to_num(needs)
    return counted


def _loud(needs: Floats) -> Floats:
    """A NaN stays."""
    return needs


Fill = tuple[str, str, Callable[[Floats], Floats], Callable[[Floats], Floats]]
# what is made of a free joint 1: name, sentence, q with fewer NaN, what a NaN that is left becomes
FILLS: tuple[Fill, ...] = (
    (
        "NaN costs nothing, both ways",
        "The move to the axis costs joint 1 nothing, and so does yours from it. But joint 1 stands "
        "where it stood: carry its angle along.",
        _as_given,
        _quiet,
    ),
    (
        "NaN taken for 0",
        "On the axis joint 1 does not turn to 0: it keeps the angle it arrives with.",
        lambda q: np.nan_to_num(q),
        _loud,
    ),
    (
        "NaN goes through",
        "A NaN in joint 1 makes the time NaN, and all times after it. Put in the angle that joint "
        "1 keeps before you subtract.",
        _as_given,
        _loud,
    ),
    *(
        (
            "turned on the way to the axis",
            "A stop on the axis takes the angle of the next stop: filled backward, joint 1 turns "
            "before it is there. The joint keeps the last angle, and turns when the arm goes on.",
            fill,
            needs,
        )
        for fill, needs in (
            (_back_filled, _quiet),
            (_next_only, _loud),
            (lambda q: np.nan_to_num(_next_only(q)), _loud),
        )
    ),
    (
        "half of the turn on each side",
        "Joint 1 makes half of its turn on the way to the axis. It keeps its angle there.",
        _halfway,
        _quiet,
    ),
    (
        "kept for one stop only",
        "Of two stops on the axis, one after the other, the second has no angle: carry on the one "
        "that you filled in.",
        _one_before,
        _quiet,
    ),
    (
        "kept for one stop only, and NaN goes through",
        "Of two stops on the axis, one after the other, the second has no angle: carry on the one "
        "that you filled in. And a start on the axis needs one, too.",
        _one_before,
        _loud,
    ),
    (
        "a start on the axis taken as 0",
        "An arm that starts on the axis may have joint 1 anywhere: it has the angle of the first "
        "stop that has one.",
        _start_zero,
        _loud,
    ),
    (
        "a start on the axis left out",
        "The angle is carried on from the start, but a start on the axis has none to carry: it has "
        "the angle of the first stop that has one.",
        _start_left,
        _loud,
    ),
    (
        "one angle for every stop on the axis",
        "Every stop on the axis gets the first angle known. Joint 1 keeps the angle it arrives "
        "with, and that is the one of the stop before.",
        _first_known,
        _loud,
    ),
    (
        "the mean of the known angles",
        "On the axis joint 1 does not turn to a mean: it keeps the angle it arrives with.",
        _mean_known,
        _loud,
    ),
    (
        "the nearest known angle",
        "Joint 1 cannot know the angle of a stop to come: on the axis it keeps the angle it "
        "arrives with. Only a start on the axis looks ahead.",
        _nearest_known,
        _loud,
    ),
    (
        "a start on the axis takes the last angle",
        "A start on the axis has the angle of the first stop that has one, not of the last.",
        _start_last,
        _loud,
    ),
    (
        "a start on the axis looks one stop ahead",
        "The stop after the start may be on the axis, too, and has no angle either: look on to the "
        "first stop that has one.",
        _start_next,
        _loud,
    ),
)
# what is made of a move: name, sentence, (q without NaN, speeds) -> times of the moves
LEGS: tuple[tuple[str, str, Moves], ...] = (
    (
        "the sum over the joints",
        "All joints move at once: the slowest decides, not the sum.",
        lambda q, speeds: _each(q, speeds).sum(axis=-1),
    ),
    (
        "the mean over the joints",
        "All joints have to arrive: the slowest decides, not the mean.",
        lambda q, speeds: _each(q, speeds).mean(axis=-1),
    ),
    (
        "the fastest joint",
        "The move ends when the last joint arrives: the greatest time, not the least.",
        lambda q, speeds: _each(q, speeds).min(axis=-1),
    ),
    (
        "a length in joint space",
        "The root of the sum of squares is a length. Joints move side by side: the slowest "
        "decides.",
        lambda q, speeds: np.linalg.norm(_each(q, speeds), axis=-1),
    ),
    (
        "a length in joint space over the greatest speed",
        "The joints move side by side, each at its own speed: the slowest decides, not a length.",
        lambda q, speeds: np.linalg.norm(np.diff(q, axis=0), axis=-1) / speeds.max(),
    ),
    (
        "a length in joint space over the mean speed",
        "The joints move side by side, each at its own speed: the slowest decides, not a length.",
        lambda q, speeds: np.linalg.norm(np.diff(q, axis=0), axis=-1) / speeds.mean(),
    ),
    (
        "joint 1 alone",
        "Only joint 1 is looked at.",
        lambda q, speeds: _each(q, speeds)[:, 0],
    ),
    (
        "joint 1 left out",
        "Joint 1 is not looked at.",
        lambda q, speeds: _each(q, speeds)[:, 1:].max(axis=-1),
    ),
    (
        "no absolute value",
        "A joint that turns back takes time as well: take abs before the greatest.",
        lambda q, speeds: (np.diff(q, axis=0) / speeds).max(axis=-1),
    ),
    (
        "the absolute value too late",
        "You take abs of the greatest difference: a large negative one is lost. First abs, then "
        "max.",
        lambda q, speeds: abs((np.diff(q, axis=0) / speeds).max(axis=-1)),
    ),
    (
        "times the speed",
        "A faster joint needs less time: divide by the speed.",
        lambda q, speeds: (abs(np.diff(q, axis=0)) * speeds).max(axis=-1),
    ),
    (
        "speed over angle",
        "Time is angle over speed, not speed over angle.",
        lambda q, speeds: np.nan_to_num(speeds / abs(np.diff(q, axis=0)), nan=0.0, posinf=0.0).max(
            axis=-1
        ),
    ),
    (
        "the speeds left out",
        "This is the greatest angle, not a time: divide by the joint's speed.",
        lambda q, speeds: abs(np.diff(q, axis=0)).max(axis=-1),
    ),
    (
        "the joint that turns most",
        "The joint that turns most is not always the one that needs longest: divide first, then "
        "take the greatest.",
        _busiest,
    ),
    (
        "the first joint's speed for all",
        "Each joint has its own speed.",
        lambda q, speeds: abs(np.diff(q, axis=0)).max(axis=-1) / speeds[0],
    ),
    (
        "the least speed for all",
        "Each joint has its own speed; the slowest joint need not be the one that turns most.",
        lambda q, speeds: abs(np.diff(q, axis=0)).max(axis=-1) / speeds.min(),
    ),
    (
        "the greatest speed for all",
        "Each joint has its own speed.",
        lambda q, speeds: abs(np.diff(q, axis=0)).max(axis=-1) / speeds.max(),
    ),
    (
        "the mean speed for all",
        "Each joint has its own speed.",
        lambda q, speeds: abs(np.diff(q, axis=0)).max(axis=-1) / speeds.mean(),
    ),
    (
        "all angles over all speeds",
        "Angles are added, and speeds are added. Each joint has its own time: angle over speed.",
        lambda q, speeds: abs(np.diff(q, axis=0)).sum(axis=-1) / speeds.sum(),
    ),
    (
        "squared",
        "The square of the angle belongs to a length; the time is the angle itself over the speed.",
        lambda q, speeds: (np.diff(q, axis=0) ** 2 / speeds).max(axis=-1),
    ),
    (
        "the short way round",
        "Joint 1 has a stop at 180 degrees here: from 3.1 to −3.1 rad it turns nearly all the way.",
        _short,
    ),
    (
        "there and back",
        "You count each way twice. That is collecting; here the arm goes on from stop to stop.",
        lambda q, speeds: 2 * _each(q, speeds).max(axis=-1),
    ),
    (
        "15/8 of it",
        "15/8 belongs to a gentle start and stop, as at the conveyor. Here every joint turns at "
        "its greatest speed at once.",
        lambda q, speeds: 15 / 8 * _each(q, speeds).max(axis=-1),
    ),
)
NOT_ADDED = "This is what each move takes. Asked is when each stop is reached: add them up."


def _slowest(q: Floats, speeds: Floats) -> Floats:
    legs: Floats = _each(q, speeds).max(axis=-1)
    return legs


def _made(fill: Fill, legs: Moves, added: bool) -> Program:
    """A program that has a wrong angle on the axis, a wrong time of a move, or does not add up."""

    def program(q: Floats, speeds: Floats) -> Floats:
        filled = fill[2](q)
        if fill[3] is _quiet:  # a joint that is free at one end of a move stands still
            a, b = filled[:-1], filled[1:]
            pairs = np.stack([np.where(np.isnan(a), b, a), np.where(np.isnan(b), a, b)], axis=1)
            times = legs(np.nan_to_num(pairs.reshape(-1, 3)), speeds)[::2]
        else:
            times = legs(filled, speeds)
        return np.cumsum(times) if added else times

    return program


def _around(q: Floats) -> Floats:
    """Joint 1 from 0 to a whole turn."""
    q = q.copy()
    q[:, 0] %= 2 * pi
    return q


def _left(times: Floats) -> Floats:
    return np.append(0.0, times[:-1])


RIGHTLY: Fill = ("", "", _filled, _loud)


def _arrival_mistakes() -> list[Mistake]:
    """Every mistake alone; on the axis and not added up; the three commonest on the axis with
    every wrong time of a move.
    """
    found = [
        Mistake(
            "times of the moves, not added up",
            NOT_ADDED,
            _made(RIGHTLY, _slowest, False),
        ),
        Mistake(
            "each joint added up for itself",
            "You add up the times of each joint and take the greatest sum. At every stop all "
            "joints wait for the slowest: first the greatest, then the sum.",
            lambda q, speeds: _each(_filled(q), speeds).cumsum(axis=0).max(axis=-1),
        ),
        Mistake(
            "each time from the start",
            "You take each stop's distance from the start. The arm goes from stop to stop.",
            lambda q, speeds: (abs(_filled(q)[1:] - _filled(q)[0]) / speeds).max(axis=-1),
        ),
        Mistake(
            "each time from the start, and added up",
            "You take each stop's distance from the start, as if the arm went back between two "
            "stops.",
            lambda q, speeds: np.cumsum(
                (abs(_filled(q)[1:] - _filled(q)[0]) / speeds).max(axis=-1)
            ),
        ),
        Mistake(
            "when the arm leaves",
            "Your times begin with 0 and lack the last: they say when the arm leaves each stop for "
            "the next. Asked is when it reaches it.",
            lambda q, speeds: _left(np.cumsum(_slowest(_filled(q), speeds))),
        ),
        Mistake(
            "counted from the first stop",
            "The clock starts with the move to the first stop: it takes time, too.",
            lambda q, speeds: (
                np.cumsum(_slowest(_filled(q), speeds)) - _slowest(_filled(q), speeds)[0]
            ),
        ),
        Mistake(
            "a move from or to the axis takes no time",
            "The NaN of joint 1 makes the whole move NaN, and you count it as 0. Joints 2 and 3 "
            "turn, and joint 1 keeps its angle: put that in before you subtract.",
            lambda q, speeds: np.nancumsum(_slowest(q, speeds)),
        ),
        Mistake(
            "a move from or to the axis takes no time, and not added up",
            "The NaN of joint 1 makes the whole move NaN, and you count it as 0: put in the angle "
            f"that joint 1 keeps before you subtract. {NOT_ADDED}",
            lambda q, speeds: np.nan_to_num(_slowest(q, speeds)),
        ),
        Mistake(
            "joint 1 from 0 to 360 degrees",
            "The angles of joint 1 are wrapped to 0 to 360 degrees: from −0.2 to 0.2 rad it would "
            "turn nearly all the way. Take them as they are, between −180 and 180 degrees.",
            lambda q, speeds: np.cumsum(_slowest(_around(_filled(q)), speeds)),
        ),
        Mistake(
            "rounded",
            "Your times are rounded to two digits; 1e-6 s is asked. Round only to print.",
            lambda q, speeds: np.cumsum(_slowest(_filled(q), speeds)).round(2),
        ),
        Mistake(
            "rounded",
            "Your times are rounded to three digits; 1e-6 s is asked. Round only to print.",
            lambda q, speeds: np.cumsum(_slowest(_filled(q), speeds)).round(3),
        ),
        Mistake(
            "the angle of the start on the axis",
            "Every stop on the axis gets the angle of the start. Joint 1 keeps the angle it "
            "arrives with, and that is the one of the stop before.",
            lambda q, speeds: np.cumsum(
                _slowest(np.where(np.isnan(q), np.nan_to_num(q[0, 0]), q), speeds)
            ),
        ),
    ]
    for fill in FILLS:
        name, says = fill[:2]
        found.append(Mistake(name, says, _made(fill, _slowest, True)))
        both, why = f"{name}, and not added up", f"{says} {NOT_ADDED}"
        found.append(Mistake(both, why, _made(fill, _slowest, False)))
    for name, says, legs in LEGS:
        found.append(Mistake(name, says, _made(RIGHTLY, legs, True)))
        if name in ("joint 1 left out", "speed over angle"):
            continue  # the axis makes no difference, or no sense
        for fill in FILLS[:3]:
            both, why = f"{name}, and {fill[0]}", f"{says} {fill[1]}"
            found.append(Mistake(both, why, _made(fill, legs, True)))
    return found


# --- 3: a trap for the nearest-first rule ---------------------------------------------------------

APART = 0.3  # m
LOST = 2  # points
TASKS = ("visit", "collect", "worth")
NO_TRAP = "no trap"
NOBODY = "your name"  # as it stands in the lab
KNOWN = 4 * np.array([[np.cos(a), np.sin(a), 0.5] for a in (1.0, -1.1, -1.2, -1.3)])  # the opening
UNITS = {
    "T": ("s", 1.0),
    "T_collect": ("s", 1.0),
    "worth": ("(of object 0, 1, 2, 3)", 1.0),
    "speed": ("rad/s, of every joint", 1.0),
    "p0": ("m", 1.0),
    "apart": ("m", 1.0),
}


def given(who: Any) -> Numbers:
    """Times, worths, speed and start for traps of one's own. Solvable for everybody: points on the
    circle through p0 about axis 1 do it, since joint 1 has room for 2.7 rad to both sides.
    """
    roll = dice(LAB, who)
    speed = 0.2 + 0.05 * roll.randrange(5)
    budget = 1.2 + 0.05 * roll.randrange(9)  # rad that a joint can turn in the time T
    x, y = 3.5 + 0.25 * roll.randrange(5), -1.5 + 0.25 * roll.randrange(13)
    height = 1.0 + 0.25 * roll.randrange(7)
    worth = [3 + roll.randrange(3) for _ in range(4)]  # no one is half of another ...
    worth[roll.randrange(4)] = 11 + roll.randrange(5)  # ... but of the dear one
    values = {
        "T": round(budget / speed, 1),
        "T_collect": round(3 * budget / speed, 1),
        "worth": worth,
        "speed": round(speed, 2),
        "p0": [x, y, height],
        "apart": APART,
    }
    return Numbers(values, UNITS)


Traps = dict[str, "Floats | None"]  # None: no trap


def _traps_form(answer: Any, given: Any) -> Traps:
    if not isinstance(answer, Mapping) or set(answer) != set(TASKS):
        wanted = 'Wanted {"visit": ..., "collect": ..., "worth": ...}'
        raise ValueError(f"{wanted}, got {words(answer)}.")
    return {task: _points_form(task, answer[task]) for task in TASKS}


def _points_form(task: str, answer: Any) -> Floats | None:
    wanted = (
        f'"{task}": wanted four points, [[x, y, z], [x, y, z], [x, y, z], [x, y, z]] in metres, '
        f'or "{NO_TRAP}"'
    )
    if isinstance(answer, str) and " ".join(answer.casefold().strip(" .!'\"").split()) == NO_TRAP:
        return None
    try:
        points = floats(answer)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {words(answer)}.") from None
    if points.shape != (4, 3) or not np.isfinite(points).all():
        raise ValueError(f"{wanted}, got {words(answer)}.")
    if abs(points).max() > 50:
        raise ValueError(f"{wanted}; yours are up to {abs(points).max():.4g} m away")
    return points


def _task(task: str, points: Floats, numbers: Any) -> Task:
    T, kind = (numbers["T"], "visit") if task == "visit" else (numbers["T_collect"], "collect")
    return Task(L1, L2, T, [numbers["speed"]] * 3, numbers["p0"], points.tolist(), kind)


def _both(task: str, points: Floats, numbers: Any) -> tuple[list[int], list[int]]:
    """What the greedy rule takes, in order, and what is best."""
    made = _task(task, points, numbers)
    if task == "visit":
        return list(visit(made).order), list(best_visit(made).order)
    worth = np.array(numbers["worth"] if task == "worth" else [1, 1, 1, 1])
    choices = (np.arange(16)[:, None] >> np.arange(4)) & 1
    fits = choices[choices @ _costs(made) <= made.T + 1e-9]
    return list(collect(made).order), np.flatnonzero(fits[(fits @ worth).argmax()]).tolist()


def _scores(task: str, points: Floats, numbers: Any) -> str:
    greedy, best = _both(task, points, numbers)
    if task == "visit":
        return (
            f'"visit": nearest first visits {len(greedy)} of 4 (order {greedy}), the best order '
            f"{len(best)} ({best})."
        )
    if task == "collect":
        return (
            f'"collect": cheapest first brings {len(greedy)} of 4 ({greedy}), the best choice '
            f"{len(best)}."
        )
    first, most = (sum(numbers["worth"][k] for k in taken) for taken in (greedy, best))
    return (
        f'"worth": cheapest first brings {greedy}, worth {first}; the best choice {best}, worth '
        f"{most}."
    )


def _places_fault(task: str, points: Floats, numbers: Any) -> Fault | None:
    for k, point in enumerate(points):
        if reasons := out_of_workspace(L1, L2, point):
            return "out of the workspace", f'"{task}": point {k} {reasons[0]}.'
    places = np.vstack([numbers["p0"], points])
    gaps = np.linalg.norm(places[:, None] - places, axis=-1) + 100 * np.eye(5)
    if gaps.min() < APART - 1e-9:
        a, b = (int(k) for k in np.unravel_index(gaps.argmin(), gaps.shape))
        names = ["p0", *(f"point {k}" for k in range(4))]
        near, wanted = apart(gaps.min(), APART, 2)
        says = f"{names[a]} and {names[b]} are {near} m apart, wanted are {wanted} m."
        return "too near to each other", f'"{task}": {says}'
    return None


def _known(points: Floats) -> bool:
    """The four points of the opening, in any order, or their mirror images, or nearly so."""
    for mirror in (1, -1):
        gaps = np.linalg.norm(points[:, None] - KNOWN * [1, mirror, 1], axis=-1)
        if gaps.min(axis=0).max() < 0.15 and gaps.min(axis=1).max() < 0.15:
            return True
    return False


def _trap_fault(task: str, points: Floats | None, numbers: Any) -> Fault | None:
    """What does not hold of the answer for one task; None: it is right."""
    if points is None:
        if task == "collect":
            return None
        why = {
            "visit": "What a point costs depends on where the arm comes from: the opening has such "
            "a case, for other numbers.",
            "worth": "The cheapest objects are the most of them, and need not be worth the most: "
            "let a cheap one use up the time that a dear one needs.",
        }[task]
        return "given up, where there is a trap", f'"{task}": there is a trap. {why}'
    if task == "collect":
        says = (
            f"{_scores(task, points, numbers)} No four points change that: any k objects cost at "
            f"least as much as the k cheapest (section 6)."
            if not _places_fault(task, points, numbers)
            else '"collect": look at the proof of section 6 before you build.'
        )
        return "a trap against a proof", says
    if fault := _places_fault(task, points, numbers):
        return fault
    if _known(points):
        says = "these are the four points of the opening. Build your own, for your start and time."
        return "the lab's own points", f'"{task}": {says}'
    greedy, best = _both(task, points, numbers)
    told = _scores(task, points, numbers)
    if not best:
        return "nothing in time", f"{told} Not even the nearest one is in time: come nearer."
    if len(greedy) == 4:
        return "all in time", f"{told} There is time for all of them: spread them."
    if task == "visit" and len(best) - len(greedy) < LOST:
        if len(best) == len(greedy):
            return "the rule is not beaten", f"{told} No order does better."
        return "one point lost, not two", f"{told} One more, and it is a trap."
    if task == "worth":
        first, most = (sum(numbers["worth"][k] for k in taken) for taken in (greedy, best))
        if first == most:
            return "the rule is not beaten", f"{told} No choice is worth more."
        if 2 * first > most:
            return "less than half is lost", f"{told} Wanted is at most half."
    return None


def _traps_faults(traps: Traps, numbers: Any) -> list[Fault]:
    found = (_trap_fault(task, traps[task], numbers) for task in TASKS)
    return [fault for fault in found if fault]


def _plain(points: Any) -> Any:
    """Lists of numbers as an array, which is told in few digits."""
    if isinstance(points, (list, tuple)):
        with suppress(TypeError, ValueError):
            return floats(points)
    return points


class Trap(Value):
    """Says what the rules and the best choices bring."""

    def judge(self, name: str, answer: Any, who: Any) -> Verdict:
        if isinstance(answer, Mapping):
            answer = {task: _plain(points) for task, points in answer.items()}
        verdict = super().judge(name, answer, who)
        if not verdict.holds:
            return verdict
        traps, numbers = _traps_form(answer, given(who)), given(who)
        told = [_scores(t, p, numbers) for t, p in traps.items() if p is not None]
        told.append('"collect": no trap, and the proof of section 6 says why.')
        if who == NOBODY:
            told.append(f'These numbers belong to "{NOBODY}": give your own name.')
        return replace(verdict, says=(*verdict.says, *told))


# --- What the predictions ask ---------------------------------------------------------------------


def _tool_facts() -> Mapping[str, Any]:
    x, y, z = (float(c) for c in ARM.fk(np.array([90, 90, 0]) * deg).translation.round(9) + 0.0)
    return {"x": x, "y": y, "z": abs(z), "l1": L1, "l2": L2, "both": L1 + L2}


def _tool_view() -> Any:
    from ..show import Sketch

    facts = _tool_facts()
    sketch = Sketch(
        f"Side view at q1 = q2 = 90 degrees and q3 = 0: link 1 lies flat, {L1:g} m long, link 2 "
        f"hangs from its end, and the tool is {facts['z']:g} m under the floor.",
        title="Link 1 flat, link 2 square to it: downwards",
        unit="m",
        x="y",
        y="height",
        height=3.6,
    )
    sketch.levers([(0, 0), (L1, 0), (L1, -L2)], ["O1", "O2", "tool"])
    sketch.ax.axhline(0, color="0.6", lw=1)
    sketch.ax.margins(0.22)
    return sketch


def _stretched_facts() -> Mapping[str, Any]:
    q = principal_postures(L1, L2, [L1 + L2, 0, 0])
    return {"q3": float(q[2]) / deg, "zero": 0.0, "plus": 90.0, "half": 180.0, "reach": L1 + L2}


def _stretched_view() -> Any:
    from ..show import Sketch

    q3 = _stretched_facts()["q3"]
    sketch = Sketch(
        f"The stretched arm, flat: link 2 is {abs(q3):.0f} degrees above the square to link 1.",
        title=f"Stretched: link 2 is {abs(q3):.0f}° above its square to link 1",
        unit="m",
        x="distance from the axis",
        y="height",
        height=3.6,
    )
    sketch.levers([(0, 0), (L1, 0), (L1 + L2, 0)], ["O1", "", "tool"])
    sketch.ax.text(L1, 0.25, "O2", ha="center", fontsize=12)
    sketch.levers([(L1, 0), (L1, -L2)], dashed=True)
    sketch.angle((L1, 0), -pi / 2, 0, "−q3", radius=1.5)
    return sketch


@cache
def _two_facts() -> Mapping[str, Any]:
    """How many random points of the workspace have two postures inside the limits."""
    box = np.random.default_rng(0).uniform([-9, -9, 0], [9, 9, 9], size=(20000, 3))
    cloud = box[workspace(L1, L2, box).all(axis=-1)]
    count = within(ARM, ARM.ik(cloud)).all(axis=-1).sum(axis=-1)
    radius = np.hypot(cloud[:, 0], cloud[:, 1]).astype(int)
    shares = [float(100 * (count[radius == k] == 2).mean()) for k in range(9)]
    return {
        "n": len(cloud),
        "one": int((count == 1).sum()),
        "two": int((count == 2).sum()),
        "share": 100 * float((count == 2).mean()),
        "near": shares[0],
        "far": shares[-1],
        "shares": shares,
    }


def _two_right(facts: Mapping[str, Any]) -> int:
    share = facts["share"]
    return 0 if share == 0 else 1 if share < 25 else 2 if share < 75 else 3


def _two_view() -> Any:
    from ..show import figure

    facts = _two_facts()
    shares = facts["shares"]
    fig = figure(
        f"Bars: of the points nearer than 1 m to the axis {shares[0]:.0f} percent have a second "
        f"posture inside the limits, of those farther than 8 m {shares[-1]:.0f} percent.",
        height=3,
    )
    ax = fig.subplots()
    ax.bar(np.arange(9) + 0.5, shares, width=0.92, color="#0072B2")
    ax.set(
        title="The nearer to the axis, the easier it is to lean over backwards",
        xlabel="distance from axis 1, m",
        ylabel="points with a second posture, %",
        xlim=(0, 9),
        ylim=(0, 105),
    )
    fig.tight_layout()
    return fig


LOW1, LOW2 = 4.0, 5.0  # m, so that the answer is a round number


def _axis_facts() -> Mapping[str, Any]:
    heights = np.linspace(0, 8, 8001)
    served = workspace(LOW1, LOW2, np.stack([0 * heights, 0 * heights, heights], -1)).all(axis=-1)
    return {
        "l1": LOW1,
        "l2": LOW2,
        "height": float(heights[served.argmax()]),
        "triangle": LOW2 - LOW1,
        "floor": 0.0,
        "square": float(np.hypot(LOW1, LOW2)),
        "top": LOW1 + LOW2,
    }


def _axis_view() -> Any:
    from ..show import Sketch

    height = _axis_facts()["height"]
    sketch = Sketch(
        f"Side view: link 1 lies on the floor behind the axis, link 2 reaches from there to the "
        f"axis, {height:g} m above the origin.",
        title=f"The elbow lies on the floor, the tool is {height:g} m above the origin",
        unit="m",
        x="distance from the axis",
        y="height",
    )
    sketch.levers([(0, 0), (-LOW1, 0), (0, height)], ["O1", "O2", "tool"])
    sketch.ax.axhline(0, color="0.6", lw=1)
    sketch.ax.axvline(0, color="0.6", lw=1, ls=":")
    sketch.ax.text(-0.1, 0.15 * height, "axis 1", ha="right")
    sketch.ax.margins(0.22)
    return sketch


def _halves_facts() -> Mapping[str, Any]:
    q = principal_postures(L1, L2, [[-2, 0.01, 2], [-2, -0.01, 2]])
    return {
        "long": float(travel_time(q[0], q[1], [0.2] * 3)),
        "short": float(travel_time(q[0], q[1], [0.2] * 3, short_way=True)),
        "half": pi / 0.2,
        "speed": 0.2,
    }


def _halves_right(facts: Mapping[str, Any]) -> int:
    return 2 if facts["long"] > 1.5 * facts["half"] else 0


def _halves_view() -> Any:
    from ..show import Sketch

    q = principal_postures(L1, L2, [[-2, 0.01, 2], [-2, -0.01, 2]])[:, 0]
    turned = (q[0] - q[1]) / deg
    sketch = Sketch(
        f"Seen from above: joint 1 turns from {q[0] / deg:.1f} to {q[1] / deg:.1f} degrees, away "
        f"from the stop at 180 degrees and all the way round, {turned:.0f} degrees.",
        title=f"Joint 1 turns away from its stop and goes round, {turned:.0f}°",
        unit="m",
        height=3.6,
    )
    sketch.levers([(0, 0), (-2, 0.01)], ["axis 1", ""])
    turn = np.linspace(q[0], q[1], 200)
    sketch.ax.plot(np.cos(turn), np.sin(turn), color="black", lw=1.3)
    sketch.ax.annotate(
        "", (-1, -0.02), (-0.985, -0.17), arrowprops={"arrowstyle": "-|>", "color": "black"}
    )
    sketch.ax.text(-2.1, 0.15, "both points", ha="right")
    sketch.ax.text(-2.1, -0.25, "stop at ±180°", ha="right")
    sketch.ax.text(0.85, 0.85, "joint 1")
    sketch.ax.set(xlim=(-4, 2), ylim=(-1.3, 1.4))
    return sketch


DIP = np.array([[6.0, 0, 1], [1.05, 0, 0.1]])  # m


def _dip_facts() -> Mapping[str, Any]:
    q = principal_postures(L1, L2, DIP)
    low = float(lowest(L1, L2, q[0], q[1]))
    return {"low": low, "deep": abs(low), "a": DIP[0, 2], "b": DIP[1, 2]}


def _dip_right(facts: Mapping[str, Any]) -> int:
    return 1 if facts["low"] >= facts["b"] - 1e-9 else 2 if facts["low"] >= 0 else 0


def _dip_view() -> Any:
    from ..show import Sketch

    q = principal_postures(L1, L2, DIP)
    way = ptp(q[0], q[1], np.linspace(0, 1, 200))
    side = ARM.fk(way).translation[:, [0, 2]]
    deep = -_dip_facts()["low"]
    sketch = Sketch(
        f"Side view of the move: the arm at its start, dashed, and where its tool is lowest; the "
        f"path of the tool goes {deep:.2f} m under the floor.",
        title=f"Between two allowed points: {deep:.2f} m under the floor",
        unit="m",
        x="distance from the axis",
        y="height",
    )
    for k, dashed in ((0, True), (int(side[:, 1].argmin()), False)):
        lean = way[k, 1]
        elbow = L1 * np.array([np.sin(lean), np.cos(lean)])
        sketch.levers([np.zeros(2), elbow, side[k]], dashed=dashed)
    sketch.ax.plot(*side.T, color="black", lw=1.5)
    sketch.ax.axhline(0, color="#009E73", lw=2)
    sketch.ax.text(6.2, -0.3, "floor", color="#009E73")
    sketch.point(DIP[0, [0, 2]], "start", away=(1, 0))
    sketch.point(DIP[1, [0, 2]], "goal", away=(1, 1))
    sketch.ax.margins(0.18)
    return sketch


def _drawn(seed: int, count: int = 7, kind: str = "visit", **changed: Any) -> Task:
    """The random task of the lab."""
    rng = np.random.default_rng(seed)
    points = rng.uniform([-9, -9, 0], [9, 9, 9], size=(12 * count, 3))
    points = points[workspace(L1, L2, points).all(axis=-1)][: count + 1]
    T = rng.uniform(15, 40)
    given = {"T": T, "speeds": [0.2] * 3, "p0": points[0]} | changed
    return Task(L1, L2, given["T"], given["speeds"], given["p0"], points[1:], kind)


SUBSETS = (np.arange(2**5)[:, None] >> np.arange(5)) & 1  # (32, 5)
ORDERS = np.array(list(permutations(range(5))))  # (120, 5)


def _costs(task: Task) -> Floats:
    legs: Floats = 2 * travel_time(task.q[0], task.q[1:], task.speeds)
    return legs


def _beaten_by_subset(task: Task, values: Floats) -> bool:
    """Whether some choice is worth more than the cheapest ones that fit."""
    fits = task.T + 1e-9 >= SUBSETS @ _costs(task)
    mine = values[list(collect(task).order)].sum()
    return bool((SUBSETS[fits] @ values).max() > mine + 1e-9)


def _beaten_by_order(task: Task) -> bool:
    """With the container on axis 1: whether some order brings more than the cheapest next."""
    best = 0
    for order in ORDERS:
        q = np.repeat(task.q[:1], 11, axis=0)
        q[1::2] = task.q[1:][order]
        arrivals = _arrivals(Tools(), q, task.speeds)[1::2]
        best = max(best, int((arrivals <= task.T + 1e-9).sum()))
    return best > len(collect(task).order)


@cache
def _change_facts() -> Mapping[str, Any]:
    """Of 30 random tasks: in how many is cheapest (or nearest) first beaten, under each change?"""
    seeds = range(30)
    plain = np.ones(5)
    axis = sum(_beaten_by_order(_drawn(s, 5, "collect", p0=[0, 0, 6.5], T=40.0)) for s in seeds)
    speeds = sum(
        _beaten_by_subset(_drawn(s, 5, "collect", speeds=[0.1, 0.3, 0.5]), plain) for s in seeds
    )
    prices = sum(
        _beaten_by_subset(
            _drawn(s, 5, "collect"), np.random.default_rng(s).integers(1, 10, 5).astype(float)
        )
        for s in seeds
    )
    onward = sum(
        len(best_visit(task).order) > len(visit(task).order)
        for task in (_drawn(s, 5) for s in seeds)
    )
    return {"n": len(seeds), "axis": axis, "speeds": speeds, "prices": prices, "onward": onward}


def _change_right(facts: Mapping[str, Any]) -> int:
    return [facts[key] > 0 for key in ("axis", "prices", "speeds", "onward")].index(False)


SEVEN = np.array(list(permutations(range(1, 8))))
STOPS = np.hstack([np.zeros((len(SEVEN), 1), dtype=int), SEVEN])


@cache
def _lost_facts() -> Mapping[str, Any]:
    """Points lost by nearest first in 200 random tasks, against all 5040 orders of each."""
    lost = []
    for seed in range(200):
        task = _drawn(seed)
        legs = travel_time(task.q[:, None], task.q, task.speeds)
        arrivals = legs[STOPS[:, :-1], STOPS[:, 1:]].cumsum(axis=-1)
        lost.append(int((arrivals <= task.T).sum(axis=-1).max()) - len(visit(task).order))
    counts = np.bincount(lost, minlength=4).tolist()
    p, z2 = 1 - counts[0] / 200, 1.96**2 / 200  # Wilson's interval for a share
    middle, half = p + z2 / 2, np.sqrt(z2 * (p * (1 - p) + z2 / 4))
    return {
        "n": 200,
        "last": 199,
        "low": 100 * (middle - half) / (1 + z2),
        "high": 100 * (middle + half) / (1 + z2),
        "some": 200 - counts[0],
        "counts": counts,
        "none": counts[0],
        "one": counts[1],
        "more": sum(counts[2:]),
        "share": (200 - counts[0]) / 2,
    }


def _lost_right(facts: Mapping[str, Any]) -> int:
    share = facts["share"]
    return 0 if share < 3 else 1 if share < 20 else 2 if share < 50 else 3


def _lost_view() -> Any:
    from ..show import figure

    facts = _lost_facts()
    counts = facts["counts"]
    fig = figure(
        f"Bars: nearest first loses no point in {counts[0]} of 200 random tasks, one in "
        f"{counts[1]}, two in {counts[2]}, three in {counts[3]}.",
        height=2.8,
    )
    ax = fig.subplots()
    names = ["none", "1 point", "2 points", "3 points"]
    bars = ax.barh(names, counts[:4], color=["#9DB7C9", "#E69F00", "#D55E00", "#CC79A7"])
    ax.bar_label(bars, padding=4)
    ax.invert_yaxis()
    ax.set(
        xlabel="tasks of 200, seven random points each",
        xlim=(0, 200),
        title=f"Nearest first loses a point or more in {facts['some']} of 200 tasks",
    )
    ax.spines[["top", "right"]].set_visible(False)
    fig.tight_layout()
    return fig


GAP = 150 * mm
WINDOW = np.linspace(-400, 400, 161) * mm
COUNT = 200
UNEVEN = 0.5  # spread of the gaps


@cache
def _belt_ways() -> Floats:
    """How long one way from the bin to each place of the window takes: (161,) in s."""
    places = np.stack([0 * WINDOW + 600 * mm, WINDOW, 0 * WINDOW + 50 * mm], axis=-1)
    l1, l2 = 500 * mm, 400 * mm
    q = principal_postures(l1, l2, np.vstack([np.array([150, -450, 250]) * mm, places]))
    ways: Floats = 15 / 8 * travel_time(q[0], q[1:], [2, 2, 2])
    return ways


def _missed(v: float, spread: float = UNEVEN, seed: int = 8, first_come: bool = False) -> int:
    """How many of the objects one arm does not take, at v mm/s."""
    offsets = spaced(COUNT, GAP, spread, seed=seed)
    (trips,) = serve(offsets, v * mm, WINDOW, _belt_ways(), first_come=first_come)
    return COUNT - len(trips.objects)


@cache
def _belt_facts() -> Mapping[str, Any]:
    speeds = np.arange(60, 141, 5)  # mm/s
    lost = {
        "uneven": [_missed(v) for v in speeds.tolist()],
        "even": [_missed(v, spread=0) for v in speeds.tolist()],
        "first": [_missed(v, first_come=True) for v in speeds.tolist()],
    }
    others = [[_missed(v, seed=seed) for v in speeds.tolist()] for seed in (9, 10)]
    most = {name: _most(speeds, n) for name, n in lost.items()}
    band = [most["uneven"], *(_most(speeds, n) for n in others)]
    return {
        **most,
        "least": min(band),
        "greatest": max(band),
        "half": round(most["even"] / 2),
        "rule": float(GAP / (2 * _belt_ways().min()) / mm),
        "speeds": speeds.tolist(),
        "lost": lost,
        "at_even": lost["uneven"][speeds.tolist().index(most["even"])],
    }


def _most(speeds: Ints, lost: list[int]) -> int:
    """The speed up to which none is lost."""
    return int(speeds[np.flatnonzero(np.cumsum(lost) == 0)[-1]])


def _belt_right(facts: Mapping[str, Any]) -> int:
    share = facts["uneven"] / facts["even"]
    return 3 if share > 1.02 else 0 if share > 0.95 else 1 if share > 0.6 else 2


def _belt_view() -> Any:
    from ..show import figure

    facts = _belt_facts()
    fig = figure(
        f"Objects missed of 200 over the belt speed. Evenly spaced: none up to {facts['even']} "
        f"mm/s. Uneven: none up to {facts['uneven']} mm/s, then more and more.",
        height=3.4,
    )
    ax = fig.subplots()
    for name, line, color in (("even", "-", "#0072B2"), ("uneven", "--", "#D55E00")):
        lost = facts["lost"][name]
        ax.plot(facts["speeds"], lost, line, color=color, lw=2.2, marker="o", ms=4)
        higher = lost[-1] == max(facts["lost"]["even"][-1], facts["lost"]["uneven"][-1])
        ax.text(142, lost[-1] + (3 if higher else -3), name, color=color, va="center")
    ax.axvline(facts["rule"], color="0.4", ls=":", lw=1.3)
    ax.text(facts["rule"] - 1, 45, "c v / g = 1", color="0.4", ha="right")
    ax.set(
        xlabel="belt speed, mm/s",
        ylabel="objects missed of 200",
        xlim=(58, 150),
        ylim=(-2, 58),
        title=f"One arm: even objects up to {facts['even']} mm/s, uneven up to {facts['uneven']}",
    )
    fig.tight_layout()
    return fig


# --- The tables -----------------------------------------------------------------------------------

EXERCISES: dict[str, Exercise] = {
    "1": InverseTest(
        title="A test for inverses",
        task="A test: whether the program inverse(p) gives right joint values for the arm.",
        objective=1,
        hints=(
            "Put the answer back: arm.fk(q).translation, or your own my_fk(q, 5, 4), should be p. "
            "Is that all that a right answer promises?",
            "The limits, too: |q1| ≤ 180°, |q2| ≤ 90°, |q3| ≤ 90°. And each wrong program is wrong "
            "for SOME points: where must they lie so that arctan, a lost sign, a division by the "
            "distance from the axis, or a border left out shows?",
            "Draw 300 points in the box from (−9, −9, 0) to (9, 9, 9), keep those where "
            "workspace(5, 4, points).all(axis=-1) holds, add (0, 0, 6) and (9, 0, 0). For each: "
            "q = np.asarray(inverse(p)); return False unless q.shape == (3,) and "
            "np.linalg.norm(my_fk(q, 5, 4) - p) <= 1e-6 and (abs(q) <= [pi, pi/2, pi/2]).all(), "
            "with 1e-9 of slack. A NaN fails both.",
        ),
        rights=RIGHT_INVERSES,
        promise="A right program may take any posture that is inside the limits and has the tool "
        "within 1e-6 m of the point; on axis 1 joint 1 may be anything inside its limits.",
        mistakes=INVERSE_MISTAKES,
    ),
    "2": Function(
        title="When is the arm where?",
        task="When the arm reaches each stop, with joint 1 free on the axis.",
        objective=2,
        hints=(
            "First put a number in the place of each NaN: which angle does joint 1 have there? "
            "Then every move is the formula of section 5.",
            "Go through the stops in order and carry the angle of joint 1 along: where the next "
            "one is NaN, it stays. Only a start on the axis looks ahead, to the first stop that "
            "has an angle.",
            "q = q.copy(); angle = q[~np.isnan(q[:, 0]), 0][0]; then for each row: if its q1 is "
            "NaN, put angle in, else angle = row[0]. Moves: "
            "(abs(np.diff(q, axis=0)) / speeds).max(axis=-1). Arrivals: their np.cumsum.",
        ),
        inputs=("q", "speeds"),
        right=_arrivals,
        cases=_arrivals_cases,
        form=_times,
        law=_arrivals_law,
        same=_same_times,
        mistakes=_arrival_mistakes(),
    ),
    "3": Trap(
        title="A trap, or none?",
        task="For three tasks: four points on which the greedy rule is beaten, or that there are "
        "none.",
        objective=3,
        hints=(
            "Which of the three rules has a proof? For the other two look at the player at the "
            "top: one point lures the arm to one side, and something better stands on the other. "
            "What has to be true of the times?",
            "Stay on the circle through your p0 about axis 1 (same distance from the axis, same "
            "height): then joint 1 alone sets the time. With B = speed * T, the angle for which "
            "there is time, visit: put one point a bit less than B away to one side, and three "
            "just behind a point farther away on the other. Worth: there is time for 1.5 B there "
            "and back; a cheap object must leave too little of it for the dear one.",
            "Angles from p0, visit: +0.66 B, and −0.73 B, −0.83 B, −0.93 B. To the lure and back "
            "to the first of the three takes 0.66 + 0.66 + 0.73 = 2.05 times T; straight to the "
            "three takes 0.93 T. Worth: a cheap one at +0.5 B (there and back: T of the 3 T), the "
            "dear one at −1.2 B (2.4 T), the others beyond, at −1.35 B and −1.5 B. A point is "
            "(r cos a, r sin a, z) with r and a of p0 by np.hypot and np.arctan2.",
        ),
        form=_traps_form,
        faults=_traps_faults,
        count=3,
        given=given,
    ),
}

# Objective 1: p1 to p3, p7. Objective 2: p4, p8, p9. Objective 3: p5, p6. In Deeper: p7 to p9.
PREDICTIONS = {
    "p1": Prediction(
        question="Joint 1 turns the arm about the vertical. Joint 2 tilts link 1 ({l1:g} m) away "
        "from the vertical. At q3 = 0 link 2 ({l2:g} m) is square to link 1; it points straight "
        "ahead while link 1 stands upright. Where is the tool at q = (90°, 90°, 0°)?",
        options=(
            Option(
                "(0, {both:g}, 0) m: the arm lies stretched on the floor.",
                "Link 1 lies flat, and link 2 is still square to it.",
                "zero taken for stretched",
                "At q = (0, 0, 0) the arm would then stand {both:g} m high; it is {l1:g} m high.",
            ),
            Option(
                "(0, {y:g}, −{z:g}) m: {z:g} m under the floor.",
                "Link 1 lies flat along y, link 2 hangs from its end. The joints are inside their "
                "limits, and the tool is where no tool may be: limits of joints do not know of a "
                "floor.",
            ),
            Option(
                "(0, {l1:g}, {l2:g}) m: link 1 flat, link 2 upright.",
                "Link 2 tilts with link 1. From straight ahead it turns by 90° the same way: "
                "downwards.",
                "tilted the wrong way",
                "At q2 = 45° link 1 leans forward, and link 2 points forward and down.",
            ),
            Option(
                "({l1:g}, 0, −{l2:g}) m: flat ahead, then down.",
                "That is the place in the arm's own plane; joint 1 has turned this plane from the "
                "x axis to the y axis.",
                "joint 1 forgotten",
                "At q1 = 180° the tool is at x = −{l1:g} m.",
            ),
        ),
        facts=_tool_facts,
        right=lambda facts: 1,
        view=_tool_view,
    ),
    "p2": Prediction(
        question="The point (9, 0, 0) m is as far as the arm reaches: both links lie in one line. "
        "What does joint 3 say there?",
        options=(
            Option(
                "{q3:.0f}",
                "Stretched, link 2 is 90° above its square to link 1, and q3 counts downwards. So "
                "sin q3 = (25 + 16 − 81) / 40 = −1: the arcsine is at its end where the triangle "
                "is, and so is the joint.",
            ),
            Option(
                "{zero:.0f}",
                "At q3 = 0 the links are square to each other: the tool is then √41 = 6.4 m away.",
                "zero taken for stretched",
                "At (5, 0, −4) link 1 is flat, link 2 hangs, and q3 = 0.",
            ),
            Option(
                "{plus:.0f}",
                "At +90° link 2 is folded back onto link 1: the tool is 1 m away.",
                "the sign of joint 3",
                "sin q3 falls as d grows: the farther, the more negative.",
            ),
            Option(
                "{half:.0f}",
                "That is the angle between the links. It is 90° − q3.",
                "the angle between the links",
                "Where the links are square to each other, the angle between them is 90° and q3 "
                "is 0.",
            ),
        ),
        facts=_stretched_facts,
        right=lambda facts: 0,
        view=_stretched_view,
        unit="°",
        within=0.01,
    ),
    "p3": Prediction(
        question="Joint 1 may turn by ±180°, joints 2 and 3 by ±90°. We draw {n} random points "
        "that the arm serves. For how many of them is there a second posture inside these limits?",
        options=(
            Option(
                "None: the limits leave one.",
                "They leave one elbow. But the arm can turn its back to the point and lean over "
                "backwards: joint 2 goes to −90°.",
                "limits taken for uniqueness",
                "(0.1, 0, 5) has one in front and one from behind, almost mirror images.",
            ),
            Option(
                "A few: about 1 in 10.",
                "Leaning backwards needs no more than q2 ≥ −90°, and high up that is enough at any "
                "distance from the axis.",
                "only near the axis",
                "Even of those more than 8 m from the axis {far:.0f} % have two.",
            ),
            Option(
                "About half.",
                "{two} of {n}. Near the axis nearly all have two, far out and low most have one, "
                "since there the arm would have to lean back by more than 90°. The second posture "
                "may be the nearer one: a program that knows row 0 alone can be slower than the "
                "arm.",
            ),
            Option(
                "All of them: it is the mirror image.",
                "Every point has the row, but where the line to the point leans by more than "
                "90° − β the mirrored link 1 would be below the floor.",
                "a row taken for a usable one",
                "(9, 0, 0): leaning back, joint 2 would stand at −90°, on the border; with the "
                "target a little nearer and on the floor it is past it.",
            ),
        ),
        facts=_two_facts,
        right=_two_right,
        view=_two_view,
    ),
    "p4": Prediction(
        question="Two points stand behind the base, 2 cm apart: (−2, 0.01, 2) and (−2, −0.01, 2) "
        "m. Every joint turns at up to {speed:g} rad/s, and joint 1 has a stop at ±180°. How long "
        "does the move take?",
        options=(
            Option(
                "{short:.2f} s: they are 2 cm apart.",
                "Near in space is not near in the joints: q1 is +179.7° at one and −179.7° at the "
                "other, and the stop is between them.",
                "distance in space taken for distance in the joints",
                "Without a stop it would be true; travel_time(..., short_way=True) says so.",
            ),
            Option(
                "{half:.1f} s: half a turn.",
                "Half a turn leads to the point opposite.",
                "a half turn for a whole one",
                "From (−2, 0.01, 2) half a turn of joint 1 ends near (2, 0, 2).",
            ),
            Option(
                "{long:.1f} s: nearly a whole turn.",
                "Joint 1 goes all the way round. Whether this is right depends on the machine: "
                "read its data sheet, and tell the program (`short_way`).",
            ),
            Option(
                "0 s: the posture is the same.",
                "Joints 2 and 3 stand alike; joint 1 has to turn.",
                "joint 1 forgotten",
                "Two points on one circle about axis 1 differ in q1 alone.",
            ),
        ),
        facts=_halves_facts,
        right=_halves_right,
        view=_halves_view,
    ),
    "p5": Prediction(
        question="We change the task of collecting. Under which change is it still right, for all "
        "points and every T, to take the cheapest first?",
        options=(
            Option(
                "The container stands on axis 1, where joint 1 keeps its angle.",
                "Then the way to an object depends on where joint 1 was left by the one before: "
                "another order may bring more.",
                "a free joint taken for no cost",
                "Four objects round the axis: whoever goes round in order turns least.",
            ),
            Option(
                "Each object has a price, and the sum of prices counts.",
                "A dear object may be worth more than two cheap ones in the same time.",
                "count taken for value",
                "Two objects of 5 s with price 1, one of 9 s with price 10, and T = 10 s.",
            ),
            Option(
                "The joints have unlike speeds: 0.1, 0.3 and 0.5 rad/s.",
                "Other speeds are other costs, and each object still has its own, whatever came "
                "before. The proof below needs no more.",
            ),
            Option(
                "The arm goes on from object to object, and empties its bag at the end.",
                "Then a cost belongs to a pair of points: this is visiting, and the opening shows "
                "nearest first beaten.",
                "costs taken for fixed",
                "Of two objects side by side the second is nearly free.",
            ),
        ),
        facts=_change_facts,
        right=_change_right,
        view=lambda: (
            "With prices: objects of 5, 5 and 9 s, and T = 10 s. The two cheapest fit. At prices "
            "of 1, 1 and 10 they bring 2, and the dear one alone 10. Unlike speeds only put other "
            "numbers in the place of 5, 5 and 9 s, and the proof holds for any numbers."
        ),
    ),
    "p6": Prediction(
        question="We draw {n} tasks, `random_task(0)` to `random_task({last})`: seven points, 15 "
        "to 40 s, 0.2 rad/s. In how many of them does nearest first visit fewer points than the "
        "best of all 5040 orders?",
        options=(
            Option(
                "In at most 5: it takes a case made up for the purpose.",
                "The case at the top is made up, but the fault is common: in {some} of {n}.",
                "a made-up case taken for a rare one",
                "Any point on the wrong side of p0 and a little nearer can do it.",
            ),
            Option(
                "In 6 to 39, one of ten or so.",
                "More often: in {some} of {n}, {share:.1f} %.",
                "greed taken for nearly best",
                "With four points it is rarer, with seven there are many ways to be lured.",
            ),
            Option(
                "In 40 to 99.",
                "In {some} of {n}: one point lost in {one}, more in {more}. So of all tasks drawn "
                "in this way it is {low:.0f} to {high:.0f} %, with a confidence of 95 %. Most of "
                "the time greed is good enough; it never tells you when it is not.",
            ),
            Option(
                "In 100 or more, at least half.",
                "In {none} of {n} it does as well as the best.",
                "greed taken for always wrong",
                "If T is long enough for the slowest order, every order visits all.",
            ),
        ),
        facts=_lost_facts,
        right=_lost_right,
        view=_lost_view,
    ),
    "p7": Prediction(
        optional=True,
        question="Now l1 = {l1:g} m and l2 = {l2:g} m. No part of the arm may be under the floor. "
        "How high above the origin is the lowest point of axis 1 that the tool can touch?",
        options=(
            Option(
                "{height:.0f}",
                "Link 1 cannot lean by more than 90°: the elbow is then on the floor, {l1:g} m "
                "behind the axis. Link 2 reaches from there to √(25 − 16) = {height:g} m. Nearer "
                "to the origin the triangle still closes, with the elbow in the ground.",
            ),
            Option(
                "{triangle:.0f}",
                "There the triangle of l1, l2 and d closes. Link 1 would point straight down, into "
                "the floor.",
                "a triangle taken for a posture",
                "Also at 2 m the triangle closes, and its elbow is 1.25 m under the floor.",
            ),
            Option(
                "{floor:.0f}",
                "At the origin the triangle does not even close: l2 − l1 is the least distance.",
                "links taken for a rope",
                "With equal links it would: they fold onto each other.",
            ),
            Option(
                "{square:.2f}",
                "That is the distance at q3 = 0, with the links square to each other.",
                "the square angle taken for the border",
                "Bent more, the arm comes nearer.",
            ),
            Option(
                "{top:.0f}",
                "That is the highest one, the arm stretched upwards.",
                "highest for lowest",
                "Any bend of the elbow brings the tool lower.",
            ),
        ),
        facts=_axis_facts,
        right=lambda facts: 0,
        view=_axis_view,
        unit="m",
        within=0.02,
    ),
    "p8": Prediction(
        optional=True,
        question="The tool goes from (6, 0, 1) to (1.05, 0, 0.1) m, every joint evenly. Both "
        "points are in the workspace. How low is the tool on the way?",
        options=(
            Option(
                "About {deep:.0f} m under the floor.",
                "By {deep:.2f} m. Both ends are allowed, and the way is not. `report` names such a "
                "move, and `visit(task, above_floor=True)` refuses it. It can happen only where "
                "l1 > l2: "
                "else the allowed (q2, q3) form a convex set, which no even move leaves. A real "
                "controller does not look either unless you give it a safety plane.",
            ),
            Option(
                "{b:g} m above the floor: never lower than the lower end.",
                "That would hold on a straight line in space. This is a straight line in the "
                "joints (PTP, MoveJ).",
                "PTP taken for LIN",
                "From one side of the base to the other a PTP goes round it, not through it.",
            ),
            Option(
                "About 0.05 m above the floor: the workspace ends at the floor.",
                "The workspace says where the tool may stop. Nothing keeps it there on the way.",
                "the workspace taken for a fence",
                "In p1 every joint was inside its limits, and the tool under the floor.",
            ),
            Option(
                "0 m: it touches the floor at one place and slides on.",
                "Nothing in the joints knows of the floor.",
                "the floor taken for a stop",
                "A real arm would press on, until its motors trip.",
            ),
        ),
        facts=_dip_facts,
        right=_dip_right,
        view=_dip_view,
    ),
    "p9": Prediction(
        optional=True,
        question="Objects lie on the belt one every 150 mm exactly. One arm, with joints at "
        "2 rad/s, which always takes the object with which it is back soonest, takes all 200 up to "
        "{even} mm/s (we try steps of 5). Now they lie 75 to 225 mm apart in random order, 150 mm "
        "on average: spread 0.5. Up to which speed does the arm miss none?",
        options=(
            Option(
                "{even} mm/s: the average counts.",
                "A pause of the arm cannot be saved for later, so dense stretches are not made up "
                "for by thin ones. At {even} mm/s it misses {at_even} of 200.",
                "the average taken for the whole",
                "One bus with room for 50 every hour, 50 people an hour on average: some walk.",
            ),
            Option(
                "About {uneven} mm/s.",
                "In a dense stretch objects come faster than the arm can be there and back: while "
                "it takes others, one passes and leaves the window. So c v / g is a bound: no "
                "fewer arms will do, and more may be needed. In two other orders of the same gaps "
                "it is {least} to {greatest} mm/s. Another rule has another speed: first come, "
                "first served takes all up to {first} mm/s.",
            ),
            Option(
                "About {half} mm/s: the least gap is half as long.",
                "It would be if every gap were the least one. The window lets an object wait for "
                "the arm a little.",
                "the worst gap taken for all",
                "Of two objects 75 mm apart the arm takes one at the beginning of the window, and "
                "the other farther down.",
            ),
            Option(
                "More than {even} mm/s: in the wide gaps the arm can rest.",
                "A rest takes no object, and none is taken sooner because of it.",
                "idle time taken for gain",
                "All objects in one heap are the other extreme: the arm takes a few and misses "
                "the rest.",
            ),
        ),
        facts=_belt_facts,
        right=_belt_right,
        view=_belt_view,
    ),
}
