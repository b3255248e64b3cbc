"""Lab 11, motors in step: its exercises and predictions.

The answers to each exercise come first, right and wrong, then the predictions' numbers and views;
the tables stand at the end.
"""

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import numpy as np

from .._arrays import Floats
from ..arms import loader_arm
from ..jobs.steppers import (
    Move,
    Stepper,
    counts,
    energised,
    frequencies,
    joint_values,
    phases,
    ramp,
    shortest_turn,
    station_postures,
    synchronised,
    unsynchronised,
)
from ..units import deg, mm, wrapped
from .exercises import words
from .mistakes import Mistake, Program, Tools
from .old import Catch, Function, Value
from .questions import Option, Prediction
from .told import apart, floats
from .variants import Numbers, dice

OBJECTIVES = (
    "compute the three angles of a loader for a point, and turn there the short way round",
    "turn a move into whole pulses that never drift, with frequencies that let all motors stop "
    "together",
    "read the phase sequence of a stepper motor, and tell which way, how far and how strongly it "
    "pulls the rotor",
)

# as in the lab
A, B = 450 * mm, 300 * mm
LOADER = loader_arm(A, B)
PER_DEGREE = np.array([10, 40, 40])
START, GOAL = np.array([[600, -350, 50], [50, 250, 350]]) * mm
STEP = 1.8  # degrees
TURN = 2 * np.pi
MINUS = "\N{MINUS SIGN}"


def _near(angle: float, other: float) -> float:
    """The value of an angle nearest to another, whole turns left out."""
    return float(wrapped(np.asarray(angle), np.asarray(other)))


# --- 1: the next posture --------------------------------------------------------------------------


def _height(point: Floats) -> float:
    return float(np.sqrt(point @ point))


def _gamma_1(h: float) -> float:
    return float(np.arccos((A**2 - B**2 + h**2) / (2 * A * h)))


def _gamma_2(point: Floats, h: float) -> float:
    return float(np.arcsin(point[2] / h))


def _beta(h: float) -> float:
    return float(np.arccos((A**2 + B**2 - h**2) / (2 * A * B)))


def _in_reach(h: float) -> bool:
    return A - B <= h <= A + B


def _next_posture(tools: Tools, point: Floats, before: float) -> Floats:
    h = _height(point)
    if not _in_reach(h):
        return np.full(3, np.nan)
    alpha = before
    if point[0] or point[1]:
        alpha = float(tools.short(tools.atan2(point[1], point[0]), before))
    return np.array([alpha, _gamma_1(h) + _gamma_2(point, h), _beta(h)])


def _posture_cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    places: list[tuple[list[float], float]] = [
        ([600, 0, 100], 0),
        ([600, 200, 100], 0),
        ([300, 400, 0], 40),
        ([0, 500, 200], 10),
        ([-400, 300, 50], 100),
        ([-400, -300, 50], -100),
        ([400, -300, 250], 30),
        ([-500, -20, 200], 170),
        ([-500, 20, 200], -170),
        ([-500, -20, 200], 190),
        ([-500, 20, 200], -200),
        ([-300, -300, 300], 90),
        ([300, 300, 300], -150),
        ([500, 100, 100], 700),
        ([500, -100, 100], -760),
        ([0, 0, 400], 130),
        ([0, 0, 600], -75),
        ([4, 3, 500], 60),  # beside the axis
        ([-1, 2, 400], -100),
        ([0, -400, 0], 0),
        ([100, 100, 600], -20),
        ([80, 60, 700], 0),
        ([100, 0, 0], 0),
        ([60, -60, 90], 20),
        ([700, 400, 100], 0),
        ([0, 0, 800], 30),
        ([149, 0, 0], 0),
        ([0, 752, 0], 0),
        ([-151, 0, 0], 150),
        ([0, 749, 0], 100),
        ([450, 150, 100], 1400),  # four turns on
        ([-400, -250, 80], -1700),
    ]
    cases = [(np.array(place) * mm, float(before * deg)) for place, before in places]
    for _ in range(8):
        place = rng.uniform(-1, 1, 3)
        place *= rng.uniform(0.2, 0.7) / np.linalg.norm(place)
        place[2] = abs(place[2])
        cases.append((place.round(3), float(rng.uniform(-200, 200) * deg)))
    return cases


def _posture_form(result: Any, case: tuple[Any, ...]) -> Floats:
    wanted = "wanted three angles alpha, gamma, beta in radians, or three NaN"
    try:
        values = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {words(result)}") from None
    if values.size == 1 and np.isnan(values).all():
        return np.full(3, np.nan)
    if values.size != 3:
        raise ValueError(f"{wanted}, got {words(result)}")
    return values.reshape(3)


def _degrees(values: Floats) -> str:
    return ", ".join(
        f"{name} = {x / deg:.2f}°" for name, x in zip(("α", "γ", "β"), values + 0.0, strict=True)
    )


def _posture_law(case: tuple[Any, ...], yours: Floats) -> str | None:
    point, before = case
    wanted = _next_posture(Tools(), point, before)
    h = _height(point)
    if np.isnan(wanted).any():
        if np.isnan(yours).all():
            return None
        side = "nearer than A \N{MINUS SIGN} B" if h < A else "farther than A + B"
        return f"should be three NaN: h = {h / mm:.1f} mm is {side}"
    # gamma and beta by the same arm, alpha as it is: whole turns count
    off = abs(np.append(yours[:1] - wanted[:1], wrapped(yours[1:] - wanted[1:])))
    if off.max() <= 1e-6:
        return None
    says = f"should be {_degrees(wanted)}"
    if not off[0] <= 1e-6 and not (point[0] or point[1]):
        return f"{says}: above the base joint 1 stays at {before / deg:.1f}°"
    if np.isnan(yours).any():
        return f"{says}: h = {h / mm:.1f} mm is in reach"
    if off[0] > 1e-6 and abs(wrapped(yours[0] - wanted[0])) <= 1e-6:
        turn, yours_turn = apart((wanted[0] - before) / deg, (yours[0] - before) / deg)
        return f"{says}: a turn of {turn}° from {before / deg:.1f}°; yours is one of {yours_turn}°"
    there = LOADER.fk(wrapped(yours)).translation
    if np.linalg.norm(there - point) <= 1e-9:
        return f"{says}; your angles reach the point in another posture"
    got, asked = apart(there / mm, point / mm)
    return f"{says}; your angles put the gripper at ({got}) mm, asked is ({asked}) mm"


def _same_angles(a: Floats, b: Floats) -> bool:
    return bool(np.allclose(a, b, rtol=0, atol=1e-6, equal_nan=True))


Alpha = Callable[[Floats, float], float]
Levers = Callable[[Floats, float], tuple[float, float]]


def _on_axis(point: Floats) -> bool:
    return not (point[0] or point[1])


def _direction(point: Floats) -> float:
    return float(np.arctan2(point[1], point[0]))


def _staying(rule: Alpha) -> Alpha:
    """The rule, and above the base no turn."""
    return lambda point, before: before if _on_axis(point) else rule(point, before)


def _turned(rule: Callable[[float], float]) -> Alpha:
    """alpha by a rule for the turn from the difference."""
    return lambda point, before: before + rule(_direction(point) - before)


def _short_of(angle: Callable[[Floats], float]) -> Alpha:
    """alpha the short way to a direction."""
    return lambda point, before: _near(angle(point), before)


def _right_alpha(point: Floats, before: float) -> float:
    return _near(_direction(point), before)


def _right_levers(point: Floats, h: float) -> tuple[float, float]:
    return _gamma_1(h) + _gamma_2(point, h), _beta(h)


def _clipped(point: Floats, h: float) -> tuple[float, float]:
    gamma_1 = float(np.arccos(np.clip((A**2 - B**2 + h**2) / (2 * A * h), -1, 1)))
    beta = float(np.arccos(np.clip((A**2 + B**2 - h**2) / (2 * A * B), -1, 1)))
    return gamma_1 + _gamma_2(point, h), beta


def _by_size(d: float) -> float:
    return d if abs(d) <= np.pi else -(TURN - abs(d))


def _unsigned(d: float) -> float:
    return min(abs(d) % TURN, TURN - abs(d) % TURN)


def _once(d: float) -> float:
    return d - TURN if d > np.pi else d + TURN if d < -np.pi else d


def _cells(point: Floats) -> float:
    """Table 1 as printed."""
    x, y, _ = point
    if x == 0:
        return float(np.sign(y) * np.pi / 2)
    if x > 0:
        return float(np.arctan(y / x))
    if y == 0:
        return np.pi
    if y < 0:
        return float(np.arctan(y / x)) - np.pi
    return float(np.arctan(y / abs(x))) + np.pi / 2


def _arctan(point: Floats) -> float:
    x, y, _ = point
    return float(np.arctan(y / x)) if x else float(np.sign(y) * np.pi / 2)


def _whole(count: Callable[[float], float]) -> Alpha:
    """So many whole turns are taken off the difference."""
    return _turned(lambda d: d - TURN * count(d / TURN))


ROUND = "Wanted is the nearest whole number of turns: np.round. "
# name, sentence, (point, before) -> alpha
ALPHAS: tuple[tuple[str, str, Alpha], ...] = (
    (
        "alpha stays wherever x = 0",
        "At x = 0 and y not 0 the direction is ±90°, and arctan2 gives it; nothing is divided. "
        "Only above the base, x = y = 0, does alpha stay.",
        lambda point, before: before if point[0] == 0 else _right_alpha(point, before),
    ),
    (
        "alpha does not go on from before",
        "arctan2 gives the direction, always within ±180°. Wanted is the value of this direction "
        "nearest to `before`.",
        lambda point, before: _direction(point),
    ),
    (
        "alpha from 0° to 360°",
        "alpha is put into 0° to 360°. Wanted is the value nearest to `before`.",
        lambda point, before: _direction(point) % TURN,
    ),
    (
        "alpha from 0° to 360°",
        "alpha is put into 0° to 360°. Wanted is the value nearest to `before`.",
        lambda point, before: (before if _on_axis(point) else _direction(point)) % TURN,
    ),
    (
        "alpha back in ±180°",
        "alpha is put back into ±180°. Wanted is the value nearest to `before`, above the base, "
        "too: whole turns count.",
        lambda point, before: _near(before if _on_axis(point) else _direction(point), 0),
    ),
    (
        "the turn for the angle",
        "This is the turn from `before` on. Wanted is where joint 1 stands after it: before + "
        "turn.",
        lambda point, before: _near(_direction(point) - before, 0),
    ),
    (
        "the same sign for both long ways",
        "Where the difference is more than half a turn, the rest of the turn is taken with one "
        "sign always. From 170° to \N{MINUS SIGN}170° it has to be +20°.",
        _turned(_by_size),
    ),
    (
        "the sign of the turn is lost",
        "The size of the turn is right, its sign is always +: clockwise turns are negative.",
        _turned(_unsigned),
    ),
    (
        "the turn goes the other way",
        "The difference is where to minus where from: direction \N{MINUS SIGN} before.",
        lambda point, before: before - _near(_direction(point) - before, 0),
    ),
    (
        "only differences above 180° are mended",
        "A difference below \N{MINUS SIGN}180° is the long way, too: add a turn.",
        _turned(lambda d: d - TURN if d > np.pi else d),
    ),
    (
        "only differences above 180° are mended",
        "A difference below \N{MINUS SIGN}180° is the long way, too: add turns.",
        _turned(lambda d: d - TURN * np.ceil((d - np.pi) / TURN) if d > np.pi else d),
    ),
    (
        "only differences below \N{MINUS SIGN}180° are mended",
        "A difference above 180° is the long way, too: take a turn off.",
        _turned(lambda d: d + TURN if d < -np.pi else d),
    ),
    (
        "only differences below \N{MINUS SIGN}180° are mended",
        "A difference above 180° is the long way, too: take turns off.",
        _turned(lambda d: d - TURN * np.floor((d + np.pi) / TURN) if d < -np.pi else d),
    ),
    (
        "one turn at most is taken off",
        "Joint 1 keeps counting: `before` may be 700°. Take off as many whole turns as there are: "
        "round(d / turn), not one `if`.",
        _turned(_once),
    ),
    (
        "two turns at most are taken off",
        "Joint 1 keeps counting: `before` may be many turns. Take off as many as there are.",
        _turned(lambda d: min((d + k * TURN for k in range(-2, 3)), key=abs)),
    ),
    ("floor for round", f"{ROUND}With floor the turn is never clockwise.", _whole(np.floor)),
    ("ceil for round", f"{ROUND}With ceil the turn is never counter-clockwise.", _whole(np.ceil)),
    (
        "int for round",
        f"{ROUND}int cuts off: 0.9 turns become 0, and the long way stays.",
        _whole(np.trunc),
    ),
    (
        "half turns taken off",
        "Only whole turns, 2 pi, bring an angle back to the same direction. After half a turn the "
        "arm looks the other way.",
        _turned(lambda d: d - np.pi * np.round(d / np.pi)),
    ),
    (
        "360 among radians",
        "A whole turn is 2 pi here: the angles are in radians.",
        _turned(lambda d: d - 360 * np.round(d / 360)),
    ),
    (
        "arctan for arctan2",
        "arctan(y / x) is the same for a point and the one opposite to it: half of the plane is "
        "lost.",
        _short_of(_arctan),
    ),
    (
        "arctan for arctan2, and alpha does not go on",
        "arctan(y / x) loses half of the plane; and alpha is not the value nearest to `before`.",
        lambda point, before: _arctan(point),
    ),
    (
        "arccos for arctan2",
        "arccos(x / r) is never negative: the sign of y is lost.",
        _short_of(lambda p: float(np.arccos(p[0] / (np.hypot(p[0], p[1]) or np.nan)))),
    ),
    (
        "arcsin for arctan2",
        "arcsin(y / r) is never above 90°: the sign of x is lost.",
        _short_of(lambda p: float(np.arcsin(p[1] / (np.hypot(p[0], p[1]) or np.nan)))),
    ),
    (
        "x and y exchanged",
        "np.arctan2 takes y first, then x.",
        _short_of(lambda p: float(np.arctan2(p[0], p[1]))),
    ),
    (
        "table by signs, one cell wrong",
        "For x < 0 and y > 0 the angle is 180° \N{MINUS SIGN} arctan(y / |x|). With + 90° it is "
        "right on the diagonal only.",
        _short_of(_cells),
    ),
    (
        "the turn for the angle",
        "This is the turn from `before` on. Wanted is where joint 1 stands after it: before + "
        "turn.",
        lambda p, before: 0.0 if _on_axis(p) else _near(_direction(p) - before, 0),
    ),
    ("joint 1 never turns", "alpha is `before`, wherever the point is.", lambda p, before: before),
)


def _gamma_2_by(rule: Callable[[Floats, float], float]) -> Levers:
    return lambda point, h: (_gamma_1(h) + rule(point, h), _beta(h))


def _beta_by(rule: Callable[[float, float, float], float]) -> Levers:
    """Another beta from the right gamma and beta, and h."""
    return lambda point, h: (
        _gamma_1(h) + _gamma_2(point, h),
        rule(_gamma_1(h) + _gamma_2(point, h), _beta(h), h),
    )


def _with_h(length: Callable[[Floats], float]) -> Levers:
    return lambda point, h: _right_levers(point, length(point))


EXCHANGED = "The angle at the base lies beside lever A: A² + h² \N{MINUS SIGN} B² over 2 A h."
# name, sentence, (point, h) -> gamma, beta
LEVERS: tuple[tuple[str, str, Levers], ...] = (
    (
        "gamma without gamma 2",
        "gamma is counted from the horizon: the angle at the base of the triangle and the "
        "elevation of the point, arcsin(z / h).",
        _gamma_2_by(lambda point, h: 0.0),
    ),
    (
        "gamma 2 alone",
        "This is the elevation of the point. Lever A stands above it by the triangle's angle "
        "gamma 1.",
        lambda p, h: (_gamma_2(p, h), _beta(h)),
    ),
    (
        "the elbow below",
        "Wanted is the elbow above: gamma 1 is added to gamma 2.",
        lambda p, h: (_gamma_2(p, h) - _gamma_1(h), _beta(h)),
    ),
    (
        "gamma 2 subtracted",
        "The elevation of the point is added: a higher point lifts the lever.",
        _gamma_2_by(lambda point, h: -_gamma_2(point, h)),
    ),
    (
        "arctan(z / h) for arcsin(z / h)",
        "h is the slanted side of the triangle with z: its angle is arcsin(z / h), or arctan2 of z "
        "and the horizontal distance.",
        _gamma_2_by(lambda p, h: float(np.arctan(p[2] / h))),
    ),
    (
        "arccos(z / h) for arcsin(z / h)",
        "gamma is counted from the horizon, not from the vertical.",
        _gamma_2_by(lambda p, h: float(np.arccos(p[2] / h))),
    ),
    (
        "x for the horizontal distance",
        "The arm's plane has turned by alpha: ahead is hypot(x, y), not x.",
        _gamma_2_by(lambda p, h: float(np.arctan2(p[2], p[0]))),
    ),
    (
        "x for the horizontal distance",
        "The arm's plane has turned by alpha: ahead is hypot(x, y), not x.",
        _gamma_2_by(lambda p, h: float(np.arctan(p[2] / p[0])) if p[0] else np.pi / 2),
    ),
    (
        "the outer angle at the elbow",
        "beta is the angle inside the triangle: 180° for the stretched arm. The numerator is A² + "
        "B² \N{MINUS SIGN} h².",
        _beta_by(lambda gamma, beta, h: np.pi - beta),
    ),
    ("half of beta", "beta is half of what it should be.", _beta_by(lambda g, b, h: b / 2)),
    (
        "beta from the other side",
        "beta is the angle inside the triangle, from 0 to 180°.",
        _beta_by(lambda gamma, beta, h: -beta),
    ),
    (
        "beta from the other side",
        "beta is the angle inside the triangle, from 0 to 180°.",
        _beta_by(lambda gamma, beta, h: TURN - beta),
    ),
    (
        "A B without the 2",
        "The law of cosines has 2 A B below the line.",
        _beta_by(lambda g, b, h: float(np.arccos((A**2 + B**2 - h**2) / (A * B)))),
    ),
    (
        "lever B against the horizon",
        "beta is the angle between the levers, not the one of lever B above the horizon.",
        _beta_by(lambda gamma, beta, h: gamma + beta - np.pi),
    ),
    (
        "A and B exchanged in gamma",
        EXCHANGED,
        lambda p, h: (
            float(np.arccos((B**2 - A**2 + h**2) / (2 * B * h))) + _gamma_2(p, h),
            _beta(h),
        ),
    ),
    (
        "the sign of B² in gamma",
        EXCHANGED,
        lambda p, h: (
            float(np.arccos((B**2 - A**2 + h**2) / (2 * A * h))) + _gamma_2(p, h),
            _beta(h),
        ),
    ),
    (
        "gamma 1 from the angle at the gripper",
        "The sine law gives one of two angles, and gamma 1 lies beside lever A, opposite to B.",
        lambda p, h: (
            float(np.arcsin(min(A * np.sin(_beta(h)) / h, 1))) + _gamma_2(p, h),
            _beta(h),
        ),
    ),
    (
        "beta and gamma in the wrong order",
        "The order is alpha, gamma, beta: from the base out.",
        lambda p, h: (_beta(h), _gamma_1(h) + _gamma_2(p, h)),
    ),
    (
        "h without the height",
        "h is the distance in space: z belongs to it.",
        _with_h(lambda p: float(np.hypot(p[0], p[1])) or np.nan),
    ),
    (
        "the root of h is missing",
        "h is the root of x² + y² + z².",
        _with_h(lambda p: float(p @ p)),
    ),
)


def _raised() -> Floats:
    raise ValueError("out of reach")


def _built(
    alpha: Alpha = _right_alpha,
    levers: Levers = _right_levers,
    *,
    stays: bool = True,
    inner: Callable[[], Any] | None = lambda: np.full(3, np.nan),
    outer: Callable[[], Any] | None = lambda: np.full(3, np.nan),
) -> Program:
    """A program of parts. What is returned nearer than A - B and farther than A + B; None: what the
    formulas give there.
    """
    rule = _staying(alpha) if stays else alpha

    def program(point: Floats, before: float) -> Any:
        h = _height(point)
        if inner is not None and h < A - B:
            return inner()
        if outer is not None and h > A + B:
            return outer()
        with np.errstate(all="ignore"):
            return np.array([rule(point, before), *levers(point, h)])

    return program


LEFT = "alpha is a number where there is no posture"
NOWHERE = "Out of reach all three are NaN: an alpha beside two NaN is no posture."
AXIS = "above the base alpha does not stay"
ABOVE = "At x = y = 0 every alpha will do: the joint has no reason to turn. alpha = before."
HOLE = (
    "Nearer than A \N{MINUS SIGN} B to the base there is no posture either: NaN. A clipped "
    "cosine puts the gripper somewhere else, and nobody is told."
)


RAISES = (
    "Past a border the arccosine has no value, and math.acos raises an error. Look at h first, and "
    "return three NaN."
)


def _posture_mistakes() -> list[Mistake]:
    """Every wrong alpha and every wrong gamma and beta, each also with what is left out beside it:
    the axis, the reach.
    """
    zeros = lambda: np.zeros(3)  # noqa: E731
    found = [
        Mistake(AXIS, ABOVE, _built(stays=False)),
        Mistake(LEFT, NOWHERE, _built(inner=None, outer=None)),
        Mistake("the hole is not looked at", NOWHERE, _built(inner=None)),
        Mistake("the hole is not looked at", HOLE, _built(levers=_clipped, inner=None)),
        Mistake("the hole is not looked at", HOLE, _built(inner=zeros)),
        Mistake("the far bound is not looked at", NOWHERE, _built(outer=None)),
        Mistake("the cosines are clipped", HOLE, _built(levers=_clipped, inner=None, outer=None)),
        Mistake(
            "zeros instead of NaN",
            "Zeros are a posture. Where there is none the answer is three NaN.",
            _built(inner=zeros, outer=zeros),
        ),
        Mistake(
            "an error instead of NaN",
            "Where there is no posture the answer is three NaN; no error is raised.",
            _built(inner=_raised, outer=_raised),
        ),
        Mistake("the hole is not looked at", RAISES, _built(inner=_raised)),
        Mistake("the far bound is not looked at", RAISES, _built(outer=_raised)),
    ]
    for name, says, alpha in ALPHAS:
        found.append(Mistake(name, says, _built(alpha)))
    for name, says, levers in LEVERS:
        found.append(Mistake(name, says, _built(levers=levers)))
    for name, says, alpha in ALPHAS:
        found.append(Mistake(name, f"{says} {ABOVE}", _built(alpha, stays=False)))
        found.append(Mistake(name, f"{says} {NOWHERE}", _built(alpha, inner=None, outer=None)))
        loose = _built(alpha, stays=False, inner=None, outer=None)
        found.append(Mistake(name, f"{says} {ABOVE} {NOWHERE}", loose))
        raising = _built(alpha, inner=_raised, outer=_raised)
        found.append(Mistake(name, f"{says} {RAISES}", raising))
        raising = _built(alpha, stays=False, inner=_raised, outer=_raised)
        found.append(Mistake(name, f"{says} {ABOVE} {RAISES}", raising))
    for name, says, levers in LEVERS:
        found.append(Mistake(name, f"{says} {ABOVE}", _built(levers=levers, stays=False)))
        loose = _built(levers=levers, inner=None, outer=None)
        found.append(Mistake(name, f"{says} {NOWHERE}", loose))
        raising = _built(levers=levers, inner=_raised, outer=_raised)
        found.append(Mistake(name, f"{says} {RAISES}", raising))
    raising = _built(stays=False, inner=_raised, outer=_raised)
    found.append(Mistake(AXIS, f"{ABOVE} {RAISES}", raising))
    found.append(Mistake(AXIS, f"{ABOVE} {NOWHERE}", _built(stays=False, inner=None, outer=None)))
    return found


def _told_apart() -> tuple[Mistake, ...]:
    """Of mistakes that no case tells apart, or from the right program, the first."""
    cases = _posture_cases(np.random.default_rng(140))

    def answers(program: Program) -> tuple[str, ...]:
        found = []
        for point, before in cases:
            try:
                found.append(str((np.round(program(point, before), 5) + 0.0).tolist()))
            except ValueError:
                found.append("raises")
        return tuple(found)

    seen = {answers(lambda point, before: _next_posture(Tools(), point, before))}
    kept = []
    for mistake in _posture_mistakes():
        told = answers(mistake.program)
        if told not in seen:
            seen.add(told)
            kept.append(mistake)
    return tuple(kept)


POSTURE_MISTAKES = _told_apart()


# --- 2: gears and frequencies ---------------------------------------------------------------------

LENGTHS = np.array([A + B, A + B, B])  # from each joint to the end of the stretched arm
COARSE = LENGTHS * STEP / 2 * deg  # what half a step without a gear moves that end
TOGETHER = 0.01  # working times this near to each other, as a share, are one
KEYS = ("gears", "frequencies")


@cache
def _turns(places: tuple[float, ...]) -> Floats:
    """The turns of the three joints in degrees."""
    ends = np.reshape(places, (2, 3))
    return np.asarray(np.diff(station_postures(LOADER, ends), axis=0)[0] / deg)


def _places(given: Mapping[str, Any]) -> tuple[float, ...]:
    return tuple(float(given[f"{end}_{x}"]) for end in ("start", "goal") for x in "xyz")


def _pulses(given: Mapping[str, Any], gears: Floats) -> Floats:
    """The pulses of the move, without signs."""
    q = station_postures(LOADER, np.reshape(_places(given), (2, 3)))
    return np.asarray(abs(np.diff(counts(q, gears / STEP), axis=0)[0]), dtype=float)


def given(who: Any) -> Numbers:
    """Two points on either side of the direction 180°, a greatest miss, a greatest frequency, and a
    time that leaves some room.
    """
    d = dice("motor_synchronisation", who)
    while True:
        side = d.choice([-1, 1])
        start = np.array([-d.randrange(250, 560, 10), side * d.randrange(60, 260, 10)])
        goal = np.array([-d.randrange(250, 560, 10), -side * d.randrange(60, 260, 10)])
        heights = [d.randrange(50, 400, 10), d.randrange(50, 400, 10)]
        miss, most = d.randrange(20, 42, 2) / 100 * mm, d.randrange(400, 820, 20)
        places = (*(start * mm), heights[0] * mm, *(goal * mm), heights[1] * mm)
        places = tuple(float(x) for x in places)
        if not (np.linalg.norm(np.reshape(places, (2, 3)), axis=1) < 0.7).all():
            continue
        turns = abs(_turns(places))
        if (turns > 12).all() and np.ptp(np.sort(turns)[1:]) > 8:
            break
    names = [f"{end}_{x}" for end in ("start", "goal") for x in "xyz"]
    values: dict[str, Any] = dict(zip(names, places, strict=True))
    gear = int(np.ceil(COARSE.max() / miss - 1e-9))
    needed = float(turns.max()) * gear / STEP / most
    values |= {
        "miss": miss,
        "most": most,
        "seconds": float(np.ceil(12 * needed) / 10),
    }
    units = {name: ("mm", mm) for name in [*names, "miss"]}
    return Numbers(values, units | {"most": ("pulses/s", 1.0), "seconds": ("s", 1.0)})


def _drive_form(answer: Any, given: Any) -> tuple[Floats, Floats]:
    if not isinstance(answer, Mapping) or not set(KEYS) <= set(answer):
        raise ValueError(
            f'wanted {{"gears": [three whole numbers], "frequencies": [three]}}, got '
            f"{words(answer)}"
        )
    found = []
    for key in KEYS:
        try:
            values = floats(answer[key])
        except (TypeError, ValueError):
            values = np.empty(0)
        if values.size == 1 and key == "gears":
            values = np.full(3, float(values.reshape(())))
        if values.size != 3 or not np.isfinite(values).all():
            raise ValueError(f"{key}: wanted three numbers, got {words(answer[key])}")
        found.append(values.reshape(3))
    gears, omega = found
    if (gears < 1).any() or (gears % 1).any() or (gears > 100_000).any():
        raise ValueError(f"gears: wanted whole numbers from 1 up, got {words(gears)}")
    if (omega == 0).any():
        raise ValueError(f"frequencies: every motor has to move, got {words(omega)}")
    return gears, abs(omega)


def _close(values: Floats) -> bool:
    return bool(values.max() <= (1 + TOGETHER) * values.min())


def _drive_faults(answer: tuple[Floats, Floats], given: Any) -> list[tuple[str, str]]:
    gears, omega = answer
    faults = []
    miss, most, seconds = (float(given[key]) for key in ("miss", "most", "seconds"))
    ends = COARSE / gears
    coarse = np.flatnonzero(ends > miss * (1 + 1e-9))
    if coarse.size:
        k = int(ends.argmax())
        moves, allowed = apart(ends[k] / mm, miss / mm, 2)
        faults.append(
            (
                "too coarse",
                f"Half a pulse of motor {k + 1} moves the end of the stretched arm by {moves} mm; "
                f"allowed are {allowed} mm. Half a pulse turns the "
                f"joint by 0.9° / gear, and the end is {LENGTHS[k] / mm:.0f} mm away from it.",
            )
        )
    fast = np.flatnonzero(omega > most * (1 + 1e-9))
    if fast.size:
        runs, allowed = apart(omega[fast[0]], most)
        says = f"Motor {fast[0] + 1} runs at {runs} pulses/s; allowed are {allowed}."
        faults.append(("above the limit", says))
    pulses = _pulses(given, gears)
    times = pulses / omega
    if not _close(times):
        faults.append(_apart_fault(given, gears, omega, pulses, times))
    if times.max() > seconds * (1 + 1e-9):
        faults.append(_slow_fault(given, gears, omega, pulses, times))
    return faults


def _apart_fault(
    given: Any, gears: Floats, omega: Floats, pulses: Floats, times: Floats
) -> tuple[str, str]:
    told = ", ".join(f"{t:.3f}" for t in times)
    says = f"The motors need {told} s for {', '.join(f'{p:.0f}' for p in pulses)} pulses."
    long = _long(given, gears)
    if _close(long / omega):
        return (
            "the long way round",
            f"{says} Your frequencies are for {long[0]:.0f} pulses of motor 1: from one side of "
            "the direction 180° to the other the short way does not pass 0°.",
        )
    if _close(pulses * omega):
        return (
            "equal products",
            f"{says} The products of pulses and frequency are equal. A time is pulses divided by "
            "frequency.",
        )
    if np.ptp(omega) < 1e-9:
        return (
            "one frequency for all",
            f"{says} With one frequency for all, the motor with the most pulses stops last.",
        )
    turns = abs(_turns(_places(given)))
    if _close(turns / omega):
        return (
            "the gears left out",
            f"{says} The frequencies are in proportion to the turns of the joints, not to the "
            "pulses: the gears are left out.",
        )
    if _close(turns / gears / omega):
        return (
            "divided by the gear",
            f"{says} A gear of i : 1 asks for i times as many pulses, not for an i-th of them.",
        )
    return "not together", says


def _long(given: Any, gears: Floats) -> Floats:
    """The pulses without the short way."""
    q = station_postures(LOADER, np.reshape(_places(given), (2, 3)))
    q[:, 0] = wrapped(q[:, 0])
    return np.asarray(abs(np.diff(counts(q, gears / STEP), axis=0)[0]), dtype=float)


def _slow_fault(
    given: Any, gears: Floats, omega: Floats, pulses: Floats, times: Floats
) -> tuple[str, str]:
    most, seconds = float(given["most"]), float(given["seconds"])
    best = float(pulses.max()) / most
    takes, allowed = apart(times.max(), seconds)
    says = f"The move takes {takes} s; allowed are {allowed} s."
    if best <= seconds:
        return (
            "slower than the limit asks",
            f"{says} These gears can keep the time, with higher frequencies.",
        )
    k = int(pulses.argmax())
    return (
        "geared too high",
        f"{says} Even at {most:.0f} pulses/s motor {k + 1} takes longer than that: its gear of "
        f"{gears[k]:.0f} : 1 is finer than asked.",
    )


# --- 3: a test for phases -------------------------------------------------------------------------

DRIVES = ("wave", "two-phase", "half-step")


def _good(drive: str, signs: Any) -> Any:
    return energised(phases(drive, "unipolar"), np.asarray(signs, dtype=float))


def _as_lists(drive: str, signs: Any) -> list[list[int]]:
    rows = phases(drive, "unipolar").tolist()
    at, found = 0, [rows[0]]
    for sign in signs:
        at = (at + int(sign)) % len(rows)
        found.append(rows[at])
    return found


def _from_row(row: int) -> Program:
    return lambda drive, signs: energised(
        phases(drive, "unipolar"), np.asarray(signs, dtype=float), row
    )


def _by_angle(drive: str, signs: Any) -> Floats:
    """A half winding is on if the field's direction is near to its own."""
    step = 45 if drive == "half-step" else 90
    at = (45 if drive == "two-phase" else 0) + step * np.concatenate([[0], np.cumsum(signs)])
    away = abs((at[:, None] - 90 * np.arange(4) + 180) % 360 - 180)
    return np.where(away < 50, 1.0, 0.0)


RIGHT_PHASES: tuple[tuple[str, Program], ...] = (
    ("robokin's energised(phases(...))", _good),
    ("a loop over the signs; rows as lists", _as_lists),
    ("the same, beginning with row 3 of the table", _from_row(2)),
    ("the same, beginning with the last row", _from_row(-1)),
    ("True and False for 1 and 0", lambda drive, signs: _good(drive, signs) == 1),
    ("from the field's direction, as floats", _by_angle),
)


def _tables(change: Callable[[str, Any], Any]) -> Program:
    """A right walk round a wrong table."""

    def program(drive: str, signs: Any) -> Any:
        table = change(drive, phases(drive, "unipolar"))
        return energised(table, np.asarray(signs, dtype=float))

    return program


def _walks(change: Callable[[Any, int], Any]) -> Program:
    """A wrong walk round the right table: row numbers from the signs and the count of rows."""

    def program(drive: str, signs: Any) -> Any:
        table = phases(drive, "unipolar")
        return table[np.asarray(change(np.asarray(signs, dtype=int), len(table)))]

    return program


def _sums(signs: Any) -> Any:
    return np.concatenate([[0], np.cumsum(signs)])


def _from_first(signs: Any, count: int) -> Any:
    """At each change of direction the walk begins with the first row again."""
    at, rows, before = 0, [0], 0
    for sign in signs:
        at = 0 if before and sign != before else at
        at, before = (at + sign) % count, sign
        rows.append(at)
    return rows


def _lost_at_turn(signs: Any, count: int) -> Any:
    """The first pulse after a change of direction does nothing."""
    at, rows, before = 0, [0], 0
    for sign in signs:
        if not before or sign == before:
            at = (at + sign) % count
        before = sign
        rows.append(at)
    return rows


def _last_lost(drive: str, signs: Any) -> Any:
    """The last pulse does nothing."""
    rows = np.array(_good(drive, signs))
    rows[-1] = rows[-2:][0]
    return rows


def _right_at_the_ends(drive: str, signs: Any) -> Any:
    """The first row stays until the last one."""
    rows = np.array(_good(drive, signs))
    rows[1:-1] = rows[0]
    return rows


PHASE_MISTAKES = (
    Mistake(
        "the signs are not looked at",
        "It goes on to the next row with every pulse, also with those of the sign \N{MINUS SIGN}.",
        _walks(lambda signs, n: np.arange(len(signs) + 1) % n),
    ),
    Mistake(
        "the other direction",
        "A pulse with the sign + turns the field from b1 to a1: clockwise.",
        _walks(lambda signs, n: -_sums(signs) % n),
    ),
    Mistake(
        "it stops at the ends of the table",
        "The rows are a ring: after the last one comes the first. Send more pulses than there are "
        "rows, in both directions.",
        _walks(lambda signs, n: np.clip(_sums(signs), 0, n - 1)),
    ),
    Mistake(
        "once round the ring at most",
        "It stops where the ring closes, after as many pulses one way as the table has rows. Send "
        "more of them, in both directions.",
        _walks(lambda signs, n: np.clip(_sums(signs), -n, n - 1) % n),
    ),
    Mistake(
        "the last row is left out",
        "The ring has one row too few: from the last but one it goes to the first.",
        _walks(lambda signs, n: _sums(signs) % (n - 1)),
    ),
    Mistake(
        "the row before the first pulse is missing",
        "There is one row more than there are pulses: what the windings carry before the first.",
        _walks(lambda signs, n: _sums(signs)[1:] % n),
    ),
    Mistake(
        "four rows for every drive",
        "The row numbers are taken modulo 4. That is right for wave and two-phase; the half step "
        "has eight rows.",
        _walks(lambda signs, n: _sums(signs) % 4),
    ),
    Mistake(
        "wave for every drive",
        "It takes the wave table whatever the drive is.",
        lambda drive, signs: _good("wave", signs),
    ),
    Mistake(
        "two-phase for wave",
        "For the wave drive it takes the two-phase table: two half windings carry current in each "
        "row.",
        lambda drive, signs: _good("two-phase" if drive == "wave" else drive, signs),
    ),
    Mistake(
        "half step without the single windings",
        "For the half step it takes the two-phase table: one row is as far from the next as a full "
        "step.",
        lambda drive, signs: _good("two-phase" if drive == "half-step" else drive, signs),
    ),
    Mistake(
        "half step for two-phase",
        "For the two-phase drive it takes the half-step table: every second row has one winding "
        "only.",
        lambda drive, signs: _good("wave" if drive == "wave" else "half-step", signs),
    ),
    Mistake(
        "half step: first the single, then the double rows",
        "Its half-step table is the wave table with the two-phase table below it. They have to "
        "alternate.",
        _tables(
            lambda drive, table: (
                np.concatenate([table[::2], table[1::2]]) if drive == "half-step" else table
            )
        ),
    ),
    Mistake(
        "two opposite half windings",
        "For the two-phase drive it feeds a1 with a2 and b1 with b2: their fields cancel.",
        _tables(
            lambda drive, table: (
                np.array([[1, 0, 1, 0], [0, 1, 0, 1]] * 2) if drive == "two-phase" else table
            )
        ),
    ),
    Mistake(
        "columns in the order a1, a2, b1, b2",
        "Columns 2 and 3 are exchanged: the field goes from a1 to the opposite side.",
        _tables(lambda drive, table: table[:, [0, 2, 1, 3]]),
    ),
    Mistake(
        "currents of both signs",
        "It gives a bipolar table, with \N{MINUS SIGN}1. Half windings carry a current or none: 1 "
        "or 0.",
        lambda drive, signs: energised(phases(drive, "bipolar"), np.asarray(signs, dtype=float)),
    ),
    Mistake(
        "back to the first row at every turn",
        "Where the direction changes it begins with the first row again. Send pulses that turn "
        "back somewhere in the middle of the table.",
        _walks(_from_first),
    ),
    Mistake(
        "the first pulse after a turn is lost",
        "Where the direction changes one pulse does nothing. Compare the row after every pulse "
        "with the one before it.",
        _walks(_lost_at_turn),
    ),
    Mistake(
        "the last pulse is lost",
        "Its rows are right up to the last one, which is the same as the row before. Look at every "
        "row.",
        _last_lost,
    ),
    Mistake(
        "right in the first and the last row",
        "Its first and last rows are right; in between the first row stays. Look at every row.",
        _right_at_the_ends,
    ),
    Mistake(
        "it stops half way",
        "It returns the first half of the rows. There is one row more than there are pulses.",
        lambda drive, signs: _good(drive, signs)[: len(signs) // 2 + 1],
    ),
    Mistake(
        "one more winding now and then",
        "In one row of the half step three half windings carry current: two of them cancel, so "
        "direction and strength are right, and three windings draw the current of one.",
        _tables(
            lambda drive, table: (
                np.vstack([[[1, 1, 0, 1]], table[1:]]) if drive == "half-step" else table
            )
        ),
    ),
)


# --- Predictions: numbers and views ---------------------------------------------------------------


def _passing_facts() -> dict[str, Any]:
    """Past the vertical axis on a straight line."""
    beside, speed = 20.0, 100.0  # mm, mm/s
    ends = np.array([[200, beside, 300], [-200, beside, 300]]) * mm
    turned = float(np.diff(station_postures(LOADER, ends), axis=0)[0, 0]) / deg
    return {
        "beside": beside,
        "speed": speed,
        "turned": turned,
        "even": turned / 4,
        "most": speed / beside / deg,
        "end": speed * beside / (200**2 + beside**2) / deg,
    }


def _passing_view() -> Any:
    from ..show import JOINT_STYLES, figure

    facts = _passing_facts()
    t = np.linspace(0, 4, 401)
    points = np.stack([200 - 100 * t, 0 * t + facts["beside"], 0 * t + 300], axis=-1) * mm
    alpha = station_postures(LOADER, points)[:, 0] / deg
    fig = figure(
        f"Joint 1 over time. It turns by {facts['turned']:.0f} degrees, "
        f"{np.ptp(alpha[150:251]):.0f} of them in the second in the middle, where the gripper "
        "passes the vertical axis.",
        6.4,
        3.2,
    )
    ax = fig.subplots()
    ax.plot(t, alpha, color=JOINT_STYLES[0]["color"], lw=2.4)
    ax.set(
        xlabel="time, s",
        ylabel="α, °",
        yticks=range(0, 181, 45),
        title=f"Past the axis joint 1 turns with up to {facts['most']:.0f}°/s",
    )
    fig.tight_layout()
    return fig


def _counting_facts() -> dict[str, float]:
    there, then = -170.0, -60.0
    at = 170.0
    for to in (there, then):
        at += float(shortest_turn(at * deg, to * deg)) / deg
    one_sided = 170.0
    for to in (there, then):
        one_sided += _by_size((to - one_sided) * deg) / deg
    return {"right": at, "back": then, "turns": at - 170, "one": one_sided}


def _counting_view() -> str:
    first = float(shortest_turn(170 * deg, -170 * deg)) / deg
    second = float(shortest_turn((170 + first) * deg, -60 * deg)) / deg
    return (
        f"From 170°: the turn is {first:+.0f}°, and joint 1 stands at {170 + first:.0f}°.\n"
        f"From {170 + first:.0f}°: the turn is {second:+.0f}°, and it stands at "
        f"{170 + first + second:.0f}°."
    )


def _finer_facts() -> dict[str, Any]:
    """How far half a pulse of each motor moves the gripper at the start."""
    q = station_postures(LOADER, [START])[0]
    moved = np.linalg.norm(LOADER.jacobian(q)[:3], axis=0) * 0.5 / PER_DEGREE * deg / mm
    return {f"m{i + 1}": float(x) for i, x in enumerate(moved)}


def _finer_right(facts: Mapping[str, Any]) -> int:
    return int(np.argmax([facts[f"m{i}"] for i in (1, 2, 3)]))


def _finer_view() -> str:
    facts = _finer_facts()
    lines = ("1: at the end of the whole arm", "2: the same lever, four times finer", "3: lever B")
    return "\n".join(
        f"Half a pulse of motor {line}: {facts[f'm{line[0]}']:.3f} mm at the gripper."
        for line in lines
    )


def _tempo_facts() -> dict[str, float]:
    pulses = np.array([1200, 300, 0])
    return {
        "right": float(frequencies(pulses)[1]),
        "inverse": 500.0 * 1200 / 300,
        "share": 500.0 * 300 / pulses.sum(),
        "full": 500.0,
        "third": 500 / 3,
    }


def _tempo_view() -> str:
    facts = _tempo_facts()
    return (
        f"Motor 1: 1200 pulses at 500 pulses/s take {1200 / 500:.1f} s.\n"
        f"Motor 2: 300 pulses at {facts['right']:.0f} pulses/s take "
        f"{300 / facts['right']:.1f} s.\nMotor 3 stands."
    )


GEARED = np.array([40, 20, 20])  # pulses per degree of the other gears


@cache
def _lengths() -> tuple[float, float]:
    """How long the paths a and d are with the other gears, in mm."""
    stations = counts(station_postures(LOADER, [START, GOAL]), GEARED)
    found = []
    for move in (unsynchronised(*stations), synchronised(*stations)):
        path = _path(move, GEARED)
        found.append(float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum()))
    return found[0], found[1]


def _path(move: Move, per_degree: Floats) -> Floats:
    """The gripper's path in mm."""
    q = joint_values(move(np.linspace(0, move.duration, 1001)), per_degree)
    return np.asarray(LOADER.fk(q).translation / mm)


def _longer_facts() -> dict[str, Any]:
    a, d = _lengths()
    return {"a": a, "d": d, "line": float(np.linalg.norm(GOAL - START)) / mm}


def _longer_right(facts: Mapping[str, Any]) -> int:
    return 0 if facts["a"] > 1.02 * facts["d"] else 2 if facts["a"] < 0.98 * facts["d"] else 1


def _longer_view() -> Any:
    from ..show import figure

    stations = counts(station_postures(LOADER, [START, GOAL]), GEARED)
    a, d = _lengths()
    fig = figure(
        f"Seen from above: with the other gears path a is {a:.0f} mm long and cuts inside, path d "
        f"is {d:.0f} mm long.",
        5.4,
        4.2,
    )
    ax = fig.subplots()
    for name, move, color, dash in (
        ("a", unsynchronised(*stations), "#D55E00", "--"),
        ("d", synchronised(*stations), "#0072B2", "-"),
    ):
        path = _path(move, GEARED)
        ax.plot(path[:, 0], path[:, 1], dash, color=color, lw=2.2)
        x, y, _ = path[500]
        ax.text(x + 15, y, name, color=color, fontsize=14, fontweight="bold")
    ax.plot(0, 0, "+", color="black", ms=12)
    ax.set(
        xlabel="x, mm",
        ylabel="y, mm",
        aspect="equal",
        title=f"Seen from above: a {a:.0f} mm, d {d:.0f} mm",
    )
    fig.tight_layout()
    return fig


def _lost_facts() -> dict[str, Any]:
    lost, move, back = 32, 1000, 400  # a rotor slips by whole turns of the field
    stands, counted = 0, 0
    for pulses, missed in ((move, lost), (-back, 0)):
        counted += pulses
        stands += pulses - missed
    return {
        "lost": lost,
        "left": move - lost,
        "twice": 2 * lost,
        "counted": counted,
        "stands": stands,
    } | {"off": counted - stands}


def _lost_right(facts: Mapping[str, Any]) -> int:
    return 2 if facts["off"] == facts["lost"] else 0 if facts["off"] == 0 else 3


def _lost_view() -> str:
    facts = _lost_facts()
    return (
        f"The controller counts {facts['counted']} pulses. The motor stands at "
        f"{facts['stands']}: {facts['off']} short, as before the second move."
    )


@cache
def _random_moves() -> tuple[Floats, Floats]:
    """How far three motors are off after each of 10 000 random moves (10 000, 3), in pulses:
    rounded one by one, and by positions.
    """
    rng = np.random.default_rng(1)
    walk = np.cumsum(rng.uniform(-20, 20, (10_001, 3)), axis=0)  # degrees
    positions = counts(walk * deg, PER_DEGREE)
    alone = positions[0] + np.cumsum(np.rint(np.diff(walk, axis=0) * PER_DEGREE), axis=0)
    return alone - walk[1:] * PER_DEGREE, positions[1:] - walk[1:] * PER_DEGREE


def _random_facts() -> dict[str, Any]:
    alone, counted = (float(abs(off).max()) for off in _random_moves())
    return {"alone": alone, "counted": counted, "expected": float(np.sqrt(10_000 / 12))}


def _random_right(facts: Mapping[str, Any]) -> int:
    return 0 if facts["alone"] < 1.5 else 1 if facts["alone"] < 200 else 2


def _random_view() -> Any:
    from ..show import JOINT_STYLES, figure

    off, _ = _random_moves()
    fig = figure(
        f"The miss of three motors over 10 000 random moves, each rounded by itself: it wanders, "
        f"by up to {abs(off).max():.0f} pulses.",
        6.4,
        3,
    )
    ax = fig.subplots()
    for i, column in enumerate(off.T):
        ax.plot(column[::20], color=JOINT_STYLES[i]["color"], lw=1.4)
        ax.text(505, column[-1], f"motor {i + 1}", color=JOINT_STYLES[i]["color"], va="center")
    ax.set(
        xlabel="moves",
        ylabel="miss, pulses",
        xticks=range(0, 501, 100),
        xticklabels=[f"{20 * k:,}".replace(",", " ") for k in range(0, 501, 100)],
        xlim=(0, 580),
        title=f"It wanders, by up to {abs(off).max():.0f} pulses",
    )
    fig.tight_layout()
    return fig


def _iron_facts() -> dict[str, Any]:
    """The torque of the next winding, 90° ahead, on a magnet and on plain iron."""
    ahead = 90 * deg
    return {"magnet": float(np.sin(ahead)), "iron": abs(round(float(np.sin(2 * ahead)), 9))}


def _iron_right(facts: Mapping[str, Any]) -> int:
    return 2 if facts["iron"] < 1e-6 < facts["magnet"] else 0


def _iron_view() -> Any:
    from ..show import figure

    away = np.linspace(-180, 180, 361)
    fig = figure(
        "The torque over the angle from the rotor to the field. A magnet is pulled hardest at 90 "
        "degrees and has one place of rest. Plain iron is not pulled at 90 degrees at all and "
        "rests at 0 and at 180.",
        6.4,
        3.2,
    )
    ax = fig.subplots()
    for name, factor, color, dash in (
        ("magnet", 1, "#0072B2", "-"),
        ("plain iron", 2, "#D55E00", "--"),
    ):
        ax.plot(away, np.sin(factor * away * deg), dash, color=color, lw=2.2, label=name)
    ax.axvline(90, color="black", lw=1, ls=":")
    ax.axhline(0, color="0.7", lw=0.8, zorder=0)
    ax.legend(fontsize=9, loc="center left", bbox_to_anchor=(1, 0.5))
    ax.set(
        xlabel="field ahead of the rotor, °",
        ylabel="torque, share of the greatest",
        xticks=range(-180, 181, 90),
        title="A quarter turn ahead pulls a magnet, not plain iron",
    )
    fig.tight_layout()
    return fig


def _far_facts() -> dict[str, float]:
    signs = np.ones(12)
    state = energised(phases("half-step", "unipolar"), signs) @ np.exp(0.5j * np.pi * np.arange(4))
    field = float(np.unwrap(np.angle(state))[-1]) / deg
    return {"right": field / 50, "field": field, "full": 12 * STEP, "rows": 12 / 8 * STEP}


def _far_view() -> str:
    facts = _far_facts()
    return (
        f"Twelve half steps turn the field by 12 x 45° = {facts['field']:.0f}°, one turn and a "
        f"half. The rotor goes 1/50 of that: {facts['right']:.1f}°, or twelve times 0.9°."
    )


@cache
def _missed() -> dict[str, dict[int, int]]:
    """Steps lost of 48 by the motor of the lab, over the frequency in pulses per second: from rest,
    and with a ramp of 0.1 s from 40 on.
    """
    motor, ones = Stepper(torque=0.02, inertia=1e-6, damping=6e-5, rise=0), np.ones(48)
    tempos = range(60, 281, 10)
    return {
        "from rest": {f: motor.run(ramp(48, f, f, 0), ones).lost for f in tempos},
        "with a ramp": {f: motor.run(ramp(48, 40, f, 0.1), ones).lost for f in tempos},
    }


def _missed_facts() -> dict[str, Any]:
    found = sorted({n for ways in _missed().values() for n in ways.values()} - {0})
    return {
        "some": ", ".join(map(str, found)),
        "few": found[0],
        "common": int(np.gcd.reduce(found)),
        "tempo": 160,
        "lost": _missed()["from rest"][160],
        "runs": sum(map(len, _missed().values())),
    }


def _missed_right(facts: Mapping[str, Any]) -> int:
    return 1 if facts["common"] == 4 else 0


def _missed_view() -> Any:
    from ..show import JOINT_STYLES, figure

    first = [next(f for f, n in ways.items() if n) for ways in _missed().values()]
    least = [min(n for n in ways.values() if n) for ways in _missed().values()]
    most = max(_missed()["with a ramp"].values())
    fig = figure(
        f"Steps lost of 48 over the frequency. From rest {least[0]} to 48 are lost from {first[0]} "
        f"pulses per second on, with a ramp {least[1]} to {most} from {first[1]} on, and always a "
        "multiple of 4.",
        6.4,
        3.2,
    )
    ax = fig.subplots()
    for j, (name, ways) in enumerate(_missed().items()):
        look = {"color": JOINT_STYLES[j]["color"], "marker": "os"[j], "ms": 5}
        ax.plot(list(ways), list(ways.values()), ls=("-", "--")[j], label=name, **look)
    ax.legend(fontsize=9)
    ax.set(
        xlabel="frequency, pulses/s",
        ylabel="steps lost of 48",
        yticks=range(0, 49, 8),
        title="Lost steps come in fours; a ramp loses fewer",
    )
    ax.grid(axis="y", lw=0.5)
    fig.tight_layout()
    return fig


EXERCISES = {
    "1": Function(
        title="The next posture",
        task="The posture for a point, joint 1 the short way round",
        objective=1,
        hints=(
            "gamma and beta do not depend on `before`, and alpha does not depend on h. Do the two "
            "parts one after the other; and first of all ask whether there is a posture.",
            "h between A \N{MINUS SIGN} B and A + B, or three NaN. alpha = before + turn, where "
            "the turn is d \N{MINUS SIGN} 2 pi round(d / (2 pi)) and d = arctan2(y, x) "
            "\N{MINUS SIGN} before. Above the base the turn is 0.",
            "beta = arccos((A² + B² \N{MINUS SIGN} h²) / (2 A B)); gamma = arccos((A² "
            "\N{MINUS SIGN} B² + h²) / (2 A h)) + arcsin(z / h). Return np.array([alpha, gamma, "
            "beta]), or np.full(3, np.nan).",
        ),
        inputs=("point", "before"),
        right=_next_posture,
        cases=_posture_cases,
        form=_posture_form,
        law=_posture_law,
        same=_same_angles,
        mistakes=POSTURE_MISTAKES,
    ),
    "2": Value(
        title="Gears for a move of your own",
        task="Gears and frequencies for a move of your own",
        objective=2,
        hints=(
            "Gears first: a gear has to be fine enough for `miss`, and no finer than the time "
            "allows. The frequencies follow from the pulses.",
            "Half a pulse turns the joint by 0.9° / gear and moves the end of the stretched arm by "
            "(A + B) times that, in radians, for joints 1 and 2. So their smallest gear is (A + B) "
            "* 0.9 * deg / miss, rounded up; joint 3 may have the same.",
            "pulses = abs(np.diff(counts(station_postures(LOADER, [my_start, my_goal]), gears / "
            '1.8), axis=0)[0]); the motor with the most runs at own["most"], each other one at '
            "its pulses over the most times that: `frequencies(pulses, limit)`.",
        ),
        form=_drive_form,
        faults=_drive_faults,
        count=4,
        given=given,
    ),
    "3": Catch(
        title="A test for phases",
        task="A test: whether the program windings(drive, signs) feeds the half windings rightly",
        objective=3,
        hints=(
            "Which drives are there, which directions, how many rows? A wrong program may be right "
            "for all but one of them.",
            "Send each drive more pulses than its table has rows, forward, back, and forward "
            "again. Then look at two things in every row: how many half windings are on, and where "
            "the field points. From row to row it turns by the step times the sign.",
            "f = np.asarray(rows, float) @ [1, 1j, -1, -1j]; np.angle(f[1:] / f[:-1]) should be "
            "sign times 90° (45° in half step). The sum of a row is 1 in wave drive, 2 in "
            "two-phase, by turns 1 and 2 in half step. There is one row more than there are "
            "pulses, and all entries are 0 or 1.",
        ),
        rights=RIGHT_PHASES,
        promise="A right program may begin with any row of its drive, and give lists, arrays, "
        "floats, or True and False.",
        mistakes=PHASE_MISTAKES,
    ),
}

# Objective 1: p1, p2. Objective 2: p3 to p7. Objective 3: p8 to p10.
PREDICTIONS = {
    "p1": Prediction(
        question="The gripper passes the vertical axis on a straight line, {beside:.0f} mm beside "
        "it: from x = 200 to x = \N{MINUS SIGN}200 mm at an even {speed:.0f} mm/s. What does joint "
        "1 do?",
        options=(
            Option(
                "It turns evenly, by about {even:.0f}° in each of the four seconds.",
                "The angle of the point is no linear function of x. Far from the axis a "
                "millimetre turns the arm little, near to it much.",
                "an even line taken for an even angle",
                "You walk past a lamp post and look at it: your head turns while you are beside "
                "it.",
            ),
            Option(
                "It stands still, and jumps by 180° as x changes its sign.",
                "arctan(y / x) jumps so, and moves on both sides. The point itself does not jump, "
                "and atan2 does not either; only on a line through the axis would it be so.",
                "the jump of arctan taken for a jump of the arm",
                "On y = 0.001 mm it still does not jump: it turns fast.",
            ),
            Option(
                "It turns by {turned:.0f}°, most of it in the middle, with up to {most:.0f}°/s.",
                "The speed is v y / (x² + y²): {end:.1f}°/s at the ends, v / y = {most:.0f}°/s "
                "beside the axis. Half the distance, twice the speed.",
            ),
            Option(
                "It need not turn: the levers fold and unfold.",
                "The arm stays in the plane through the axis and the gripper, and that plane "
                "turns. Only exactly over the axis could it fold through.",
                "levers taken for joint 1",
                "At x = 0 the gripper is 20 mm to the left of the axis: an arm that points ahead "
                "does not reach there.",
            ),
        ),
        facts=_passing_facts,
        right=lambda facts: 2 if facts["most"] > 3 * facts["even"] else 0,
        view=_passing_view,
    ),
    "p2": Prediction(
        question="Joint 1 stands at 170°. It turns the shorter way to the direction "
        "\N{MINUS SIGN}170°, then the shorter way to \N{MINUS SIGN}60°. It keeps counting: no "
        "angle is put back into ±180°. At which angle does it stand at last?",
        options=(
            Option(
                "{right:.0f}",
                "The turns are +20° and +110°. Both go on in the same direction, past 180°.",
            ),
            Option(
                "{back:.0f}",
                "That is the same direction, one turn less: to stand there joint 1 would have to "
                "turn back by 230°.",
                "the angle put back into ±180°",
                "A cable that is wound round the base knows the difference.",
            ),
            Option(
                "{turns:.0f}",
                "This is the sum of the turns. It began at 170°.",
                "the turn for the angle",
                "A joint at 90° that turns by 10° stands at 100°.",
            ),
            Option(
                "{one:.0f}",
                "From 170° to the direction \N{MINUS SIGN}170° the shorter way is +20°, not "
                "\N{MINUS SIGN}20°: the sign has to follow from the difference.",
                "the rest of a turn, always with one sign",
                "170° \N{MINUS SIGN} 20° is 150°, and that is another direction.",
            ),
        ),
        facts=_counting_facts,
        right=lambda facts: 0,
        view=_counting_view,
        unit="°",
        within=0.01,
    ),
    "p3": Prediction(
        question="Joint 1 gets 10 pulses per degree, joints 2 and 3 get 40. Motors can only stand "
        "on whole pulses, so the gripper may miss its point by a little. You may double one gear. "
        "Which one takes most off what it can miss at the start of our move?",
        options=(
            Option(
                "Gear 1, of the turn about the vertical.",
                "Half a pulse of motor 1 moves the gripper by {m1:.2f} mm there, of motor 2 by "
                "{m2:.2f}, of motor 3 by {m3:.2f}: angle times the distance from the axis.",
            ),
            Option(
                "Gear 2: the longest lever.",
                "Its lever is as long as that of joint 1, but its pulse is four times smaller: "
                "{m2:.2f} mm against {m1:.2f}.",
                "the length alone",
                "With 10 pulses per degree on all joints, 1 and 2 would be alike.",
            ),
            Option(
                "Gear 3: the last joint is nearest to the gripper.",
                "That is why it matters least: only lever B turns about it. Half a pulse is "
                "{m3:.2f} mm.",
                "near to the gripper taken for important",
                "Turn your shoulder by one degree, then your wrist: which moves the finger more?",
            ),
            Option(
                "All the same: rounding is half a pulse for each.",
                "Half a pulse is another angle for each motor, and an angle moves the gripper in "
                "proportion to its distance from the axis.",
                "pulses taken for millimetres",
                "Half a pulse of motor 1 is 0.05°, of the others 0.0125°.",
            ),
        ),
        facts=_finer_facts,
        right=_finer_right,
        view=_finer_view,
    ),
    "p4": Prediction(
        question="Motor 1 needs 1200 pulses, motor 2 needs 300, motor 3 none. No frequency may "
        "exceed 500 pulses/s, and both have to stop at one time, as early as possible. Which "
        "frequency does motor 2 get, in pulses/s?",
        options=(
            Option(
                "{right:.0f}",
                "Motor 1 cannot be done before 2.4 s. Motor 2 has a quarter of its pulses, so a "
                "quarter of its frequency.",
            ),
            Option(
                "{full:.0f}",
                "Then it is done after 0.6 s, and motor 1 after 2.4 s.",
                "each as fast as it can",
                "Two people with 1 and 4 km to go, at one speed, do not arrive together.",
            ),
            Option(
                "{inverse:.0f}",
                "That makes the products of pulses and frequency equal, and it is above 500.",
                "product for quotient",
                "Who has the shorter way would have to hurry more.",
            ),
            Option(
                "{share:.0f}",
                "The 500 are not shared among the motors: each may have them. What counts is the "
                "motor with the most pulses, not the sum.",
                "a share of the sum",
                "A third motor with as many pulses would slow down both others.",
            ),
            Option(
                "{third:.4f}",
                "The frequencies do not share 500 among three motors: each may run at 500 by "
                "itself.",
                "one limit for all together",
                "A second motor on its own supply does not make the first one slower.",
            ),
        ),
        facts=_tempo_facts,
        right=lambda facts: 0,
        view=_tempo_view,
        unit="pulses/s",
        within=0.01,
    ),
    "p5": Prediction(
        question="On path a each motor runs at full speed until it is done, on path d they stop "
        "together. For the gears of this lab a is the longer path. With other gears, 40, 20 and 20 "
        "pulses per degree, motor 1 is the last to stop, long after the levers. How long is a now, "
        "beside d?",
        options=(
            Option(
                "Longer still: a path with corners is a detour.",
                "Corners say nothing about length. A path with corners may be shorter than a wide "
                "arc: {a:.0f} mm against {d:.0f}.",
                "a corner taken for a detour",
                "Across a square the way along two sides has a corner. A circle round the square "
                "has none, and is longer.",
            ),
            Option(
                "As long as d: both have the same ends and the same angles.",
                "The same angles, but in another order in time: so the places in between are "
                "others.",
                "the ends taken for the path",
                "First up and then round, or both at once: two paths.",
            ),
            Option(
                "Shorter than d.",
                "The levers draw the gripper in at once, and then joint 1 swings it round on a "
                "small circle: {a:.0f} mm against {d:.0f}. Synchronising takes the corners out; "
                "it does not promise a shorter way.",
            ),
            Option(
                "As short as the straight line.",
                "The straight line is {line:.0f} mm long; a is {a:.0f}. For a straight line the "
                "frequencies must change all the time.",
                "even frequencies taken for a straight path",
                "Turn joint 1 alone: the path is a circle.",
            ),
        ),
        facts=_longer_facts,
        right=_longer_right,
        view=_longer_view,
    ),
    "p6": Prediction(
        question="A motor at rest is given pulses faster than its maximum start frequency. It "
        "misses the first {lost}, catches step, and follows the other {left} of the move. The next "
        "move is 400 pulses back, slow enough. Where is it after that?",
        options=(
            Option(
                "Where it should be: on the way back it misses nothing, so the error cancels.",
                "A move that is exact keeps the error that is there.",
                "an exact move taken for a correction",
                "Set a clock 5 minutes wrong, and it goes exactly: it stays 5 minutes wrong.",
            ),
            Option(
                "Where it should be: the controller counts positions, so nothing drifts.",
                "It counts the pulses that it has sent. Nobody tells it what the motor made of "
                "them.",
                "pulses sent taken for steps made",
                "A postman who counts the letters he has written does not know which arrived.",
            ),
            Option(
                "{off} pulses short of it, and so for every move that follows.",
                "The count is {counted}, the motor stands at {stands}. Only a reference tells: a "
                "switch or an encoder at a known place. Real machines drive to it when they start "
                "(homing).",
            ),
            Option(
                "{twice} pulses short: every move loses {lost}.",
                "The second move is slow enough and loses none.",
                "a lost step taken for a drift",
                "One missed step on a staircase is missed once.",
            ),
        ),
        facts=_lost_facts,
        right=_lost_right,
        view=_lost_view,
    ),
    "p7": Prediction(
        question="Now 10 000 moves instead of a cycle, each joint by an angle drawn evenly from "
        "\N{MINUS SIGN}20° to 20°. A careless program rounds every move by itself, each by up to "
        "half a pulse. By how much is one of the three motors off at most, on the way?",
        options=(
            Option(
                "By less than a pulse: random errors cancel.",
                "They cancel in part. What is left of a sum of random errors grows with the root "
                "of their number.",
                "cancelling taken for vanishing",
                "Throw a coin 10 000 times: heads and tails differ by about a hundred.",
            ),
            Option(
                "By some dozens of pulses.",
                "By {alone:.0f}. The root of 10 000 times 0.29, the spread of one rounding, is "
                "{expected:.0f}, and on the way one of three motors reaches more. By positions it "
                "is {counted:.1f} at most: each is rounded once, and never by more than half a "
                "pulse.",
            ),
            Option(
                "By some thousands: up to half a pulse each time.",
                "So it would be if all roundings had one sign. Here they have both. In a cycle the "
                "same ones come again, and what is left of them grows with every cycle.",
                "the worst case taken for every case",
                "10 000 steps in random directions do not bring you 10 000 steps away.",
            ),
        ),
        facts=_random_facts,
        right=_random_right,
        view=_random_view,
    ),
    "p8": Prediction(
        question="A rotor of plain iron, without a magnet, is drawn to a winding like a nail, "
        "whichever pole the winding shows. It lies along a1 and a2. Now the wave drive goes on: "
        "b1, a2, b2, a1. What does the rotor do?",
        options=(
            Option(
                "It follows the field, a quarter turn a pulse, as a magnet does.",
                "A magnet knows north from south. For iron a1 and a2 are one: it sees a, b, a, b, "
                "and read backwards that is a, b, a, b.",
                "iron taken for a magnet",
                "A nail is drawn to either pole of a magnet, and with either end.",
            ),
            Option(
                "It turns the other way: it is drawn, not pushed.",
                "Neither way is preferred. Forward and backward are the same sequence for it.",
                "attraction taken for a direction",
                "Exchange b1 and b2: the iron cannot tell.",
            ),
            Option(
                "It cannot tell forward from backward, and may not turn at all.",
                "A quarter turn ahead pulls it to both sides alike: the torque goes with sin 2d, "
                "{iron:.0f} at d = 90°, against sin d = {magnet:.0f} for the magnet. Motors with "
                "an iron rotor (passive, or reluctance motors) have three or more windings "
                "spaced less than 90° apart for it.",
            ),
            Option(
                "It turns half as far: it has no poles.",
                "No torque, no turn: at 90° the pull to both sides is the same.",
                "half the poles taken for half the way",
                "With three windings, spaced by 60° for it, the same rotor does turn.",
            ),
        ),
        facts=_iron_facts,
        right=_iron_right,
        view=_iron_view,
    ),
    "p9": Prediction(
        question="A motor makes 1.8° in a full step, and four full steps are one turn of the "
        "field. Half-step drive, twelve pulses, all with the sign +. By how many degrees does the "
        "rotor turn?",
        options=(
            Option("{right:.1f}", "A half step is 0.9°, and there are twelve."),
            Option(
                "{full:.1f}",
                "These are twelve full steps. In half-step drive a pulse is half of one.",
                "full steps for half steps",
                "Eight half steps make one turn of the field, four full steps do so as well.",
            ),
            Option(
                "{field:.0f}",
                "So far turns the field. A rotor with 50 teeth goes on by one tooth for each of "
                "its turns.",
                "the field taken for the rotor",
                "Four full steps are 7.2°, not a turn.",
            ),
            Option(
                "{rows:.1f}",
                "Twelve pulses are one and a half tables of eight rows; a table is four full "
                "steps, not one.",
                "a table taken for a step",
                "Each row of the table is a pulse, and each pulse turns the rotor.",
            ),
        ),
        facts=_far_facts,
        right=lambda facts: 0,
        view=_far_view,
        unit="°",
        within=0.02,
    ),
    "p10": Prediction(
        question="The motor of the next cell, a magnet of two poles (wave drive, four rows), "
        "stands still and gets 48 pulses, faster than its rotor can follow. In the end it stands "
        "again, and one winding is on. How many steps can be missing?",
        options=(
            Option(
                "Any number from 1 to 48: it depends on the frequency.",
                "At rest the magnet stands where the winding that is on holds it. Between the "
                "windings nothing does.",
                "a step taken for a place to stand",
                "Switch a1 on and turn the magnet by hand: in a whole turn there is one place "
                "where it stays.",
            ),
            Option(
                "Only 4, 8, 12 and so on.",
                "The winding that is on holds the magnet at one place of the turn, and a turn is "
                "four steps. In {runs} runs the lost steps were 0, {some}.",
            ),
            Option(
                "One or two: then it has caught up.",
                "Behind by more than half a turn it is pulled backwards, and the next pulses pull "
                "it to and fro. At {tempo} pulses per second it loses {lost} of 48.",
                "a lag taken for a loss",
                "A lag of one step is made good by the next pull; a lag of three is a pull the "
                "other way.",
            ),
            Option(
                "All 48: it does not move at all.",
                "It often loses nearly all. But with a ramp that is too short it follows at first, "
                "and loses {few} of 48.",
                "the start taken for the whole run",
                "What it has made before it falls behind, it keeps.",
            ),
        ),
        facts=_missed_facts,
        right=_missed_right,
        view=_missed_view,
    ),
}
