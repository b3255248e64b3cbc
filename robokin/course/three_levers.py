"""Lab 09, three levers: its exercises and predictions.

The answers to each exercise come first, right and wrong, then the predictions' numbers and views;
the tables stand at the end.
"""

from collections.abc import Mapping
from functools import cache, lru_cache
from itertools import pairwise
from typing import Any

import numpy as np

from .._arrays import Floats
from ..arms import three_lever
from ..arms.branches import within
from ..jobs.redundancy import methods, race
from ..units import deg, wrapped
from .exercises import words
from .mistakes import DEGREES, Mistake, Program, Tools
from .old import Catch, Fault, Function, Value
from .questions import Option, Prediction
from .told import apart, floats
from .variants import Numbers, dice

OBJECTIVES = (
    "compute where a chain of levers puts the gripper, and every posture that puts it at a given "
    "point",
    "choose the posture with the least movement, by a sweep and exactly, and test a program that "
    "claims to",
    "say what least movement leaves out, above all the time and the next task, and plan two tasks "
    "at once",
)
LAB = "three_levers"
L = 1.0  # m, as in the lab
ARM = three_lever(L)
K = np.array([1.5, 1.0])


def _direction(angle: Any) -> Floats:
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


# --- 1: levers of any lengths ---------------------------------------------------------------------


def _corner(a: Any, b: Any, c: Any) -> Any:
    """The angle between the sides a and b of a triangle, opposite c; NaN: there is none."""
    with np.errstate(invalid="ignore"):
        return np.arccos((a**2 + b**2 - c**2) / (2 * a * b))


def _clipped(a: Any, b: Any, c: Any) -> Any:
    return np.arccos(np.clip((a**2 + b**2 - c**2) / (2 * a * b), -1, 1))


def _by_arctan2(b: Any, c: Any, alpha: Any, side: Any) -> Any:
    """beta_2 from BA, AK and alpha."""
    return np.arctan2(c * np.sin(alpha), b - c * np.cos(alpha))


def _by_cosines(b: Any, c: Any, alpha: Any, side: Any) -> Any:
    """beta_2 from KB, BA and AK: whoever has a wrong KB has a wrong beta_2, too."""
    return _corner(side, b, c)


def _by_clipped_cosines(b: Any, c: Any, alpha: Any, side: Any) -> Any:
    return _clipped(side, b, c)


def _levers(
    point: Floats,
    alpha: float,
    lengths: Floats,
    *,
    KB: Program = lambda a, b, c, alpha: np.sqrt(b**2 + c**2 - 2 * b * c * np.cos(alpha)),
    phi: Program = np.arctan2,
    corner: Program = _corner,
    beta_2: Program = _by_arctan2,
    gamma: Program = lambda gamma_1, phi: gamma_1 + phi,
    beta: Program = lambda beta_1, beta_2: beta_1 + beta_2,
) -> Floats:
    """The right way; each step of it can be exchanged for a wrong one."""
    a, b, c = np.asarray(lengths, dtype=float)
    x, y = point
    KO, side = np.hypot(x, y), KB(a, b, c, alpha)
    angles = (
        gamma(corner(KO, a, side), phi(y, x)),
        beta(corner(side, a, KO), beta_2(b, c, alpha, side)),
    )
    q = np.array([*angles, alpha], dtype=float)
    return q if np.isfinite(q).all() else np.full(3, np.nan)


def _levers_right(tools: Tools, point: Floats, alpha: float, lengths: Floats) -> Floats:
    return _levers(point, alpha, lengths, phi=tools.atan2)


def _chain(q: Floats, lengths: Floats) -> Floats:
    """The points O, B, A, K: (4, 2)."""
    gamma, beta, alpha = q
    ways = np.array([gamma, gamma + beta - np.pi, gamma + beta + alpha - 2 * np.pi])
    steps = np.asarray(lengths)[:, None] * _direction(ways)
    return np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])


def _levers_cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    def case(x: float, y: float, alpha: float, lengths: list[float]) -> tuple[Any, ...]:
        return np.array([x, y]), alpha * deg, np.array(lengths)

    cases = [
        case(1.5, 1.0, 120, [1, 1, 1]),  # as in the lab
        case(2.0, 0.0, 150, [1, 1, 1]),
        case(1.5, 1.0, 120, [1, 1, 0.5]),
        case(1.0, 0.5, 90, [1, 0.6, 0.8]),
        case(-1.0, 1.5, 150, [1, 1, 1]),  # left of O
        case(0.0, 1.4, 100, [0.9, 0.8, 0.6]),  # x is 0
        case(-1.2, -0.6, 110, [0.8, 1.0, 0.7]),
        case(2.5, 0.0, 60, [1, 1, 1]),  # K is too far away: none
        case(0.1, 0.1, 150, [0.5, 0.9, 0.8]),  # K is too near: none
        case(3.0, 1.0, 170, [0.6, 1.0, 0.9]),
        case(0.9, 0.2, 20, [1.0, 0.9, 0.4]),  # a small alpha: BA and AK lie nearly on each other
        case(0.6, -0.3, 40, [0.9, 0.5, 0.9]),
        case(1.4, 0.6, 179, [0.7, 0.6, 0.5]),
        case(0.25, 0.1, 75, [0.35, 0.3, 0.2]),  # a table-top arm
        case(0.3, -0.4, 60, [0.5, 0.3, 0.45]),  # K nearer than a lever
    ]
    cases += [
        case(1.9, 0.0, 60, [1, 1, 1]),  # beta is above 180 degrees
        case(1.2, 0.8, 50, [0.9, 0.8, 0.7]),
        case(0.9, 0.4, 40, [0.8, 0.4, 1.0]),  # beta_2 is above 90 degrees
        case(-0.7, 0.5, 30, [0.7, 0.5, 0.9]),
        case(0.2, -0.3, 130, [1.2, 0.3, 0.4]),  # K is nearer than any alpha reaches
    ]
    for KO in (2.72, 2.745, 0.738, 0.726):  # some mm inside the border or outside, far and near
        cases.append(case(KO, 0.0, 120, [1, 1, 1]))
    for KO in (0.705, 0.695):  # near, OB being longer than KB
        cases.append(case(0.0, KO, 60, [1.2, 0.5, 0.5]))
    while len(cases) < 41:
        lengths = rng.uniform(0.3, 1.2, 3).round(2)
        alpha = rng.uniform(15, 175)
        r, phi = rng.uniform(0.2, 2.8), rng.uniform(-180, 180) * deg
        x, y = (r * _direction(phi)).round(2)
        a, b, c = lengths
        side = np.sqrt(b**2 + c**2 - 2 * b * c * np.cos(alpha * deg))
        KO = float(np.hypot(x, y))
        gap = min(side + a - KO, KO - abs(side - a))
        exists = gap > 0.02
        if abs(gap) > 0.02 and (exists or len(cases) % 5 == 0):
            cases.append(case(float(x), float(y), round(float(alpha), 1), lengths.tolist()))
    return cases


def _posture_form(result: Any, case: tuple[Any, ...]) -> Floats:
    wanted = "wanted three angles (gamma, beta, alpha) in radians, or NaN"
    try:
        q = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {words(result)}") from None
    if q.size == 1 and np.isnan(q).all():
        return np.full(3, np.nan)
    if q.size != 3:
        raise ValueError(f"{wanted}, got {words(result)}")
    q = q.reshape(3)
    return np.full(3, np.nan) if np.isnan(q[:2]).any() else q  # [nan, nan, alpha] says it, too


def _levers_law(case: tuple[Any, ...], yours: Floats) -> str | None:
    point, alpha, lengths = case
    wanted = _levers_right(Tools(), *case)
    KO = float(np.hypot(*point))
    if np.isnan(wanted).any():
        if np.isnan(yours).all():
            return None
        b, c = lengths[1:]
        side = float(np.sqrt(b**2 + c**2 - 2 * b * c * np.cos(alpha)))
        return (
            f"should be NaN: OB = {lengths[0]:g} m, KB = {side:.3f} m and KO = {KO:.3f} m are no "
            "triangle"
        )
    told = ", ".join(f"{x / deg:.2f}°" for x in wanted)
    if np.isnan(yours).any():
        return f"should be gamma, beta, alpha = {told}: this posture exists"
    gripper = _chain(yours, lengths)[3]
    miss = float(np.hypot(*(gripper - point)))
    if miss > 1e-6:
        is_at, off = apart(gripper, point, 3)[0], apart(miss, 0, 3)[0]
        return (
            f"should be gamma, beta, alpha = {told}; yours puts the gripper at ({is_at}) m, {off} "
            "m from K"
        )
    if abs(wrapped(yours - wanted)).max() <= 1e-5:
        return None
    told, yours_told = apart(wanted / deg, yours / deg, 2)
    return (
        f"should be gamma, beta, alpha = ({told})°; yours, ({yours_told})°, reaches K, too, in "
        "another posture"
    )


def _same_posture(a: Floats, b: Floats) -> bool:
    if a.shape != b.shape or (np.isnan(a) != np.isnan(b)).any():
        return False
    return bool(np.isnan(a).all() or np.nanmax(abs(wrapped(a - b))) <= 1e-7)


def _sine_beta(a: Any, b: Any, c: Any) -> Any:
    """Acute always, as from the law of sines."""
    angle = _corner(a, b, c)
    return np.minimum(angle, np.pi - angle)


def _all_clipped(point: Floats, alpha: float, lengths: Floats) -> Floats:
    return _levers(point, alpha, lengths, corner=_clipped)


def _swap(order: list[int]) -> Program:
    return lambda point, alpha, lengths: _levers(point, alpha, lengths[order])


def _square(a: Any, b: Any, c: Any, alpha: Any) -> Any:
    return np.sqrt(b**2 + c**2 - 2 * b * c * np.cos(alpha))


def _is_half(b: Any, c: Any, alpha: Any, side: Any) -> Any:
    return (np.pi - alpha) / 2


def _chord(k: int) -> Program:
    return lambda a, b, c, alpha: 2 * (a, b, c)[k] * np.sin(alpha / 2)


def _changed(**steps: Program) -> Program:
    return lambda point, alpha, lengths: _levers(point, alpha, lengths, **steps)


def _quotient(y: Any, x: Any) -> Any:
    return np.arctan(np.divide(y, x))


def _sides(point: Floats, alpha: float, lengths: Floats) -> tuple[float, float]:
    """KO and KB."""
    return float(np.hypot(*point)), float(_square(0, lengths[1], lengths[2], alpha))


def _unless(gone: Program) -> Program:
    """NaN where `gone` says so; elsewhere clipped."""

    def program(point: Floats, alpha: float, lengths: Floats) -> Floats:
        lost = gone(*_sides(point, alpha, lengths), lengths)
        return np.full(3, np.nan) if lost else _all_clipped(point, alpha, lengths)

    return program


def _refused(bad: Program) -> Program:
    """Right, but NaN where `bad` says so, too."""

    def program(point: Floats, alpha: float, lengths: Floats) -> Floats:
        q = _levers(point, alpha, lengths)
        return np.full(3, np.nan) if bad(q, np.hypot(*point), lengths) else q

    return program


def _unrooted(point: Floats, alpha: float, lengths: Floats) -> Floats:
    return _levers(point * np.hypot(*point), alpha, lengths)


def _angle_at_K(point: Floats, alpha: float, lengths: Floats) -> Floats:
    KO, KB = _sides(point, alpha, lengths)
    q = _levers(point, alpha, lengths)
    found: Floats = q + [_corner(KO, KB, lengths[0]) - _corner(KO, lengths[0], KB), 0, 0]
    return found


LEVER_BASE = (
    Mistake(
        "the formulas of equal levers",
        "2 L sin(alpha/2) and (180° - alpha)/2 belong to an isosceles triangle. BA and AK differ "
        "here: law of cosines for KB, and the angle at B from KB, BA and AK.",
        _changed(KB=_chord(1), beta_2=_is_half),
    ),
    Mistake(
        "the formulas of equal levers, with OB",
        "2 OB sin(alpha/2) takes all levers for as long as the first. KB joins the ends of BA and "
        "AK: law of cosines with these two.",
        _changed(KB=_chord(0), beta_2=_is_half),
    ),
    Mistake(
        "the formulas of equal levers, with AK",
        "2 AK sin(alpha/2) takes BA for as long as AK. KB: law of cosines with both.",
        _changed(KB=_chord(2), beta_2=_is_half),
    ),
    Mistake(
        "KB of equal levers",
        "KB = 2 L sin(alpha/2) holds where BA and AK are equally long. Here KB² = BA² + AK² - 2 BA "
        "AK cos(alpha).",
        _changed(KB=_chord(1)),
    ),
    Mistake(
        "beta_2 of equal levers",
        "(180° - alpha)/2 is the angle at B of an isosceles triangle. BA and AK differ here: take "
        "the angle between KB and BA, opposite AK.",
        _changed(beta_2=_is_half),
    ),
    Mistake(
        "BA and AK exchanged, or the angle at K for that at B",
        "In the triangle B, A, K beta is counted at B: between KB and BA, opposite AK. lengths are "
        "those of OB, BA and AK, in this order.",
        _changed(
            beta_2=lambda b, c, alpha, _: np.arctan2(b * np.sin(alpha), c - b * np.cos(alpha))
        ),
    ),
    Mistake(
        "beta_2 left out",
        "beta has two parts: the angle at B of the triangle O, B, K and that of B, A, K.",
        _changed(beta=lambda one, two: one),
    ),
    Mistake(
        "beta_2 subtracted",
        "A lies on the far side of KB from O: the two parts of beta are added.",
        _changed(beta=lambda one, two: one - two),
    ),
    Mistake(
        "the direction of K left out",
        "gamma_1 is counted from the line OK. gamma counts from the x axis: add the direction of "
        "K, arctan2(y, x).",
        _changed(gamma=lambda one, phi: one),
    ),
    Mistake(
        "the direction of K alone",
        "gamma is the direction of K plus gamma_1, the angle at O between OK and OB.",
        _changed(gamma=lambda one, phi: phi),
    ),
    Mistake(
        "gamma_1 subtracted",
        "B lies counter-clockwise from the line OK: gamma_1 is added. (Subtracted, beta would have "
        "to change, too.)",
        _changed(gamma=lambda one, phi: phi - one),
    ),
    Mistake(
        "B on the other side",
        "A posture that reaches K with B clockwise from OK. Asked is the one with B "
        "counter-clockwise: gamma = direction of K + gamma_1, beta = beta_1 + beta_2.",
        _changed(
            gamma=lambda one, phi: phi - one,
            beta=lambda one, two: two - one,
        ),
    ),
    Mistake(
        "arctan of x / y",
        "That is the angle of K from the y axis. gamma counts from the x axis: arctan2(y, x).",
        _changed(phi=lambda y, x: np.arctan(np.divide(x, y))),
    ),
    Mistake(
        "x and y exchanged in arctan2",
        "arctan2 takes y first: np.arctan2(y, x).",
        _changed(phi=lambda y, x: np.arctan2(x, y)),
    ),
    Mistake(
        "arctan of y / x",
        "An arctangent of a quotient cannot tell K from the opposite point: left of O the gripper "
        "ends up on the other side. Use arctan2(y, x).",
        _changed(phi=_quotient),
    ),
    Mistake(
        "clipped where there is no triangle",
        "Where OB, KB and KO are no triangle the answer is NaN. Clipped, the arm stretches towards "
        "K and does not reach it, and nobody is told.",
        _all_clipped,
    ),
    Mistake(
        "the wrong sign in the law of cosines",
        "KB² = BA² + AK² - 2 BA AK cos(alpha): alpha is the interior angle. With a plus it would "
        "be the angle that the joint turns.",
        _changed(
            KB=lambda a, b, c, alpha: np.sqrt(b**2 + c**2 + 2 * b * c * np.cos(alpha)),
        ),
    ),
    Mistake(
        "the factor 2 left out in the law of cosines",
        "KB² = BA² + AK² - 2 BA AK cos(alpha), with the 2.",
        _changed(KB=lambda a, b, c, alpha: np.sqrt(b**2 + c**2 - b * c * np.cos(alpha))),
    ),
    Mistake(
        "KB without the root",
        "The law of cosines gives KB². The root is missing.",
        _changed(KB=lambda a, b, c, alpha: _square(a, b, c, alpha) ** 2),
    ),
    Mistake(
        "acute angles only",
        "The law of sines (arcsin) cannot tell an angle from 180° minus it. Take the law of "
        "cosines, or arctan2.",
        _changed(corner=_sine_beta),
    ),
    Mistake(
        "the exterior angle for beta",
        "beta is the interior angle at B, between BO and BA: 180° means in line. You return 180° "
        "minus it.",
        _changed(beta=lambda one, two: np.pi - one - two),
    ),
    Mistake(
        "the levers in another order",
        "lengths are those of OB, BA and AK, in this order.",
        _swap([2, 1, 0]),
    ),
    Mistake(
        "OB and BA exchanged",
        "lengths are those of OB, BA and AK, in this order.",
        _swap([1, 0, 2]),
    ),
    Mistake(
        "the angles in another order",
        "q is (gamma, beta, alpha): from the base to the gripper.",
        lambda point, alpha, lengths: _levers(point, alpha, lengths)[::-1],
    ),
    Mistake(
        "KO without the root",
        "KO is a length: the root of x² + y².",
        lambda point, alpha, lengths: _unrooted(point, alpha, lengths),
    ),
    Mistake(
        "the mean length of BA and AK",
        "KB is the third side of a triangle of BA, AK and alpha; their mean length does not give "
        "it. Law of cosines.",
        _changed(
            KB=lambda a, b, c, alpha: (b + c) * np.sin(alpha / 2),
            beta_2=_is_half,
        ),
    ),
    Mistake(
        "alpha for beta_2",
        "In the triangle B, A, K alpha is the angle at A, opposite KB. beta_2 is the one at B, "
        "opposite AK.",
        _changed(beta_2=lambda b, c, alpha, _: alpha),
    ),
    Mistake(
        "arcsin for beta_2",
        "Where AK is the longest side beta_2 may be above 90°, and arcsin never is. Take arctan2, "
        "or the law of cosines.",
        _changed(beta_2=lambda b, c, alpha, side: np.arcsin(c * np.sin(alpha) / side)),
    ),
    Mistake(
        "arctan of a quotient for beta_2",
        "Where beta_2 is above 90° the quotient is negative, and arctan gives a negative angle. "
        "Take arctan2 of both.",
        _changed(
            beta_2=lambda b, c, alpha, _: np.arctan(c * np.sin(alpha) / (b - c * np.cos(alpha))),
        ),
    ),
    Mistake(
        "the angle at K for gamma_1",
        "In the triangle O, B, K gamma_1 is the angle at O, between KO and OB, opposite KB. You "
        "take the one at K.",
        lambda point, alpha, lengths: _angle_at_K(point, alpha, lengths),
    ),
    Mistake(
        "the turn for alpha",
        "alpha is returned as it was given: the interior angle, not 180° minus it.",
        lambda point, alpha, lengths: (
            _levers(point, alpha, lengths) * [1, 1, 0] + [0, 0, np.pi - alpha]
        ),
    ),
    Mistake(
        "K too near is forgotten",
        "A triangle may fail in two ways: K too far away, KO above OB + KB, and K too near, KO "
        "below |OB - KB|.",
        _unless(lambda KO, KB, lengths: KO > lengths[0] + KB),
    ),
    Mistake(
        "K too far is forgotten",
        "A triangle may fail in two ways: K too near, KO below |OB - KB|, and K too far away, KO "
        "above OB + KB.",
        _unless(lambda KO, KB, lengths: KO < abs(lengths[0] - KB)),
    ),
    Mistake(
        "the reach of the stretched arm",
        "With alpha given the arm cannot stretch: what counts is OB + KB, not the sum of the "
        "three lengths.",
        _unless(lambda KO, KB, lengths: KO > sum(lengths)),
    ),
    Mistake(
        "the reach of the whole arm",
        "That is where the arm reaches with some alpha. alpha is given here: NaN stands where OB, "
        "KB and KO are no triangle, KO above OB + KB or below |OB - KB|.",
        _unless(
            lambda KO, KB, lengths: not 2 * max(lengths) <= sum(lengths) + KO <= 2 * sum(lengths)
        ),
    ),
    Mistake(
        "the rule KO > OB kept",
        "That K keeps away from the inner disc is a rule of the lab's arm. Here NaN stands only "
        "where O, B, K are no triangle.",
        _refused(lambda q, KO, lengths: KO <= lengths[0]),
    ),
    Mistake(
        "the rule KO > OB kept",
        "That K keeps away from the inner disc is a rule of the lab's arm. Here NaN stands only "
        "where O, B, K are no triangle.",
        _refused(lambda q, KO, lengths: KO < lengths[0] - 1e-9),
    ),
    Mistake(
        "the rule KO > OB for the triangle",
        "That K keeps away from the inner disc is a rule of the lab's arm, and clipped the rest is "
        "never NaN. NaN stands where OB, KB and KO are no triangle, and only there.",
        _unless(lambda KO, KB, lengths: KO <= lengths[0]),
    ),
    Mistake(
        "the rule KO > OB for the triangle",
        "That K keeps away from the inner disc is a rule of the lab's arm, and clipped the rest is "
        "never NaN. NaN stands where OB, KB and KO are no triangle, and only there.",
        _unless(lambda KO, KB, lengths: KO < lengths[0] - 1e-9),
    ),
    Mistake(
        "180° - alpha for beta_2",
        "180° - alpha is beta_2 and the angle at K together. beta_2 alone is the angle at B, "
        "between KB and BA, opposite AK.",
        _changed(beta_2=lambda b, c, alpha, _: np.pi - alpha),
    ),
    Mistake(
        "KB of the stretched arm",
        "KB is BA + AK only where alpha is 180°. Law of cosines with BA, AK and alpha.",
        _changed(KB=lambda a, b, c, alpha: b + c, beta_2=lambda b, c, alpha, _: 0.0),
    ),
    Mistake(
        "Pythagoras for KB",
        "KB² = BA² + AK² only where alpha is 90°. Law of cosines: - 2 BA AK cos(alpha).",
        _changed(KB=lambda a, b, c, alpha: np.hypot(b, c)),
    ),
    *(
        Mistake(
            "the wrong two levers for KB",
            "KB is the third side of the triangle B, A, K: the law of cosines takes BA and AK, "
            "lengths[1] and lengths[2].",
            _changed(KB=KB),
        )
        for KB in (
            lambda a, b, c, alpha: _square(0, a, b, alpha),
            lambda a, b, c, alpha: _square(0, a, c, alpha),
        )
    ),
    Mistake(
        "limits are looked at",
        "Limits are not asked for: gamma or beta above 180°, or below 0°, is no reason for NaN.",
        _refused(lambda q, KO, lengths: (q < 0).any() or (q > np.pi).any()),
    ),
    Mistake(
        "the limit of beta is looked at",
        "Limits are not asked for: beta above 180° is no reason for NaN.",
        _refused(lambda q, KO, lengths: q[1] > np.pi),
    ),
    Mistake(
        "zeros instead of NaN",
        "Zeros are a posture, too: the arm would go there. Where there is none return NaN.",
        lambda point, alpha, lengths: np.nan_to_num(_levers(point, alpha, lengths)),
    ),
    Mistake(
        "zeros instead of NaN, beside alpha",
        "Zeros are angles, too: the arm would go there. Where there is no posture return NaN.",
        lambda point, alpha, lengths: np.append(
            np.nan_to_num(_levers(point, alpha, lengths))[:2], alpha
        ),
    ),
    Mistake(
        "gamma_1 and beta_1 exchanged",
        "In the triangle O, B, K gamma_1 is the angle at O, opposite KB, and beta_1 the angle at "
        "B, opposite KO.",
        lambda point, alpha, lengths: _exchanged(point, alpha, lengths),
    ),
)


def _with_L(**steps: Program) -> Program:
    return lambda point, alpha, lengths: _levers(point, alpha, np.append(L, lengths[1:]), **steps)


def _folded(corner: Program) -> Program:
    def program(point: Floats, alpha: float, lengths: Floats) -> Floats:
        gamma, beta, _ = _levers(point, alpha, lengths, corner=corner)
        return np.array([gamma, min(beta, 2 * np.pi - beta), alpha])

    return program


def _sine(which: str, corner: Program) -> Program:
    """The law of sines for one angle of the triangle O, B, K, that of cosines for the other."""

    def acute(angle: Any) -> Any:
        return np.minimum(angle, np.pi - angle)

    steps: dict[str, Program] = {which: lambda one, other: acute(one) + other}
    return _changed(corner=corner, **steps)


def _exchanged(point: Floats, alpha: float, lengths: Floats) -> Floats:
    phi = np.arctan2(point[1], point[0])
    beta_2 = _levers(point, alpha, lengths, beta=lambda one, two: two)[1]
    gamma, beta, _ = _levers(point, alpha, lengths)
    return np.array([beta - beta_2 + phi, gamma - phi + beta_2, alpha])


OB_OF_THE_LAB = (
    "L of the lab for OB",
    "In the triangle O, B, K the first lever is as long as in the lab, 1 m. Take lengths[0].",
)
KB_OF_THE_LAB = (
    "KB with L of the lab",
    "KB = 2 L sin(alpha/2) holds for the lab's arm. Here KB² = BA² + AK² - 2 BA AK cos(alpha).",
)
FOLDED = (
    "beta folded below 180°",
    "beta may be above 180° here: limits are not asked for. 360° minus it is another posture, and "
    "an arccosine of the directions BO and BA gives that one. Add beta_1 and beta_2.",
)
SINES = (
    "the law of sines for {}",
    "{} may be above 90°, and an arcsine never is. Take the law of cosines.",
)


def _chord_of_the_lab(a: Any, b: Any, c: Any, alpha: Any) -> Any:
    return 2 * L * np.sin(alpha / 2)


def _wrong_sides() -> list[Mistake]:
    """A wrong KB again, with beta_2 from that KB: another posture. Both clipped and not."""
    ways: dict[str, Program] = {
        "KB of equal levers": _chord(1),
        "the wrong sign in the law of cosines": lambda a, b, c, alpha: _square(
            a, b, c, np.pi - alpha
        ),
        "the factor 2 left out in the law of cosines": lambda a, b, c, alpha: np.sqrt(
            b**2 + c**2 - b * c * np.cos(alpha)
        ),
        "KB without the root": lambda a, b, c, alpha: _square(a, b, c, alpha) ** 2,
        "Pythagoras for KB": lambda a, b, c, alpha: np.hypot(b, c),
    }
    says = {mistake.name: mistake.says for mistake in LEVER_BASE}
    made = [
        Mistake(name, says[name], _changed(KB=KB, beta_2=beta_2, corner=corner))
        for name, KB in ways.items()
        for beta_2, corner in ((_by_cosines, _corner), (_by_clipped_cosines, _clipped))
    ]
    for KB in (
        lambda a, b, c, alpha: _square(0, a, b, alpha),
        lambda a, b, c, alpha: _square(0, a, c, alpha),
    ):
        name = "the wrong two levers for KB"
        made += [
            Mistake(name, says[name], _changed(KB=KB, beta_2=beta_2, corner=corner))
            for beta_2, corner in ((_by_cosines, _corner), (_by_clipped_cosines, _clipped))
        ]
    for beta_2, corner in (
        (_by_arctan2, _corner),
        (_is_half, _corner),
        (_is_half, _clipped),
        (_by_cosines, _corner),
        (_by_clipped_cosines, _clipped),
    ):
        steps: dict[str, Program] = {"KB": _chord_of_the_lab, "beta_2": beta_2, "corner": corner}
        made.append(Mistake(*KB_OF_THE_LAB, _changed(**steps)))
    return made


AND_CLIPPED = (
    "; and clipped where there is no triangle",
    " And where OB, KB and KO are no triangle the answer is NaN: no np.clip.",
)


def _and_clipped() -> list[Mistake]:
    """The lab's angle_between taken over with its clip, and a mistake beside it."""
    ways: dict[str, dict[str, Program]] = {
        "the formulas of equal levers": {"KB": _chord(1), "beta_2": _is_half},
        "the formulas of equal levers, with OB": {"KB": _chord(0), "beta_2": _is_half},
        "the formulas of equal levers, with AK": {"KB": _chord(2), "beta_2": _is_half},
        "beta_2 of equal levers": {"beta_2": _is_half},
        "BA and AK exchanged, or the angle at K for that at B": {
            "beta_2": lambda b, c, alpha, _: _by_arctan2(c, b, alpha, _)
        },
        "beta_2 left out": {"beta": lambda one, two: one},
        "the direction of K left out": {"gamma": lambda one, phi: one},
        "arctan of y / x": {"phi": _quotient},
    }
    says = {mistake.name: mistake.says for mistake in LEVER_BASE}
    return [
        Mistake(
            name + AND_CLIPPED[0], says[name] + AND_CLIPPED[1], _changed(corner=_clipped, **way)
        )
        for name, way in ways.items()
    ]


LEVER_MISTAKES = (
    *LEVER_BASE,
    *(
        Mistake(*OB_OF_THE_LAB, _with_L(corner=corner, beta_2=beta_2))
        for corner in (_corner, _clipped)
        for beta_2 in (_by_arctan2, _is_half)
    ),
    *(Mistake(*FOLDED, _folded(corner)) for corner in (_corner, _clipped)),
    *(
        Mistake(SINES[0].format(told), SINES[1].format(told), _sine(which, corner))
        for told, which in (("gamma_1", "gamma"), ("beta_1", "beta"))
        for corner in (_corner, _clipped)
    ),
    *_wrong_sides(),
    *_and_clipped(),
)


# --- 2: a test for least movement -----------------------------------------------------------------

ROOM = 0.02 * deg  # by so much a right program may be above the least S
REACH = 1e-5  # m


@lru_cache(maxsize=2000)  # many of the programs begin with it, on the same tasks
def _remembered(point: tuple[float, ...], previous: tuple[float, ...]) -> Floats:
    q: Floats = ARM.least(np.array(point), np.array(previous))[0]
    return q


def _exact(point: Floats, previous: Floats) -> Floats:
    place, before = (tuple(np.asarray(x, dtype=float).tolist()) for x in (point, previous))
    return _remembered(place, before).copy()


def _rows(point: Floats, step: float, limited: bool = True) -> Floats:
    low, high = (float(x) for x in ARM.alpha_range(point, limited=limited))
    return _rows_at(point, np.append(np.arange(low, high, step), high))


def _rows_at(point: Floats, alphas: Floats) -> Floats:
    """The family without its checks: a few hundred microseconds less for each program and task."""
    KO, KB = np.hypot(*point), 2 * L * np.sin(alphas / 2)
    gamma = _clipped(KO, L, KB) + np.arctan2(point[1], point[0])
    return np.stack([gamma, _clipped(KB, L, KO) + (np.pi - alphas) / 2, alphas], axis=-1)


def _swept(
    point: Floats,
    previous: Floats,
    step: float = 0.01 * deg,
    cost: Program = lambda change: abs(change).sum(axis=-1),
    limited: bool = True,
) -> Floats:
    rows = _rows(point, step, limited)
    found: Floats = rows[np.asarray(cost(rows - previous)).argmin()]
    return found


def _beside(point: Floats, previous: Floats) -> Floats:
    """gamma a little nearer to 90° than it should be."""
    q = _exact(point, previous)
    gamma = q[0] - np.sign(q[0] - np.pi / 2) * 8e-6 / np.hypot(*point)
    return np.array([gamma, q[1], q[2]])


def _above(point: Floats, previous: Floats, by: float = 0.018 * deg) -> Floats:
    """The posture beside the least that uses most of what is allowed."""
    q = _exact(point, previous)
    low, high = ARM.alpha_range(point)
    alphas = np.clip(q[2] + np.linspace(-0.06, 0.06, 241) * deg, low, high)
    rows = np.concatenate([q[None], _rows_at(point, alphas)])
    S = abs(rows - previous).sum(axis=-1)
    found: Floats = rows[np.where(S <= S[0] + by, S, -1).argmax()]
    return found


RIGHT_LEAST: tuple[tuple[str, Program], ...] = (
    ("the exact least of the package", _exact),
    ("a sweep in steps of 0.01°, up to 0.012° above the least in what we tried", _swept),
    (
        "a sweep from 180° down, which takes the last of equal rows, as a list of rounded numbers",
        lambda p, q: np.round(_backward(p, q), 7).tolist(),
    ),
    ("the gripper up to 8e-6 m beside K, as promised: the tolerance is 1e-5 m", _beside),
    (
        "every angle too large by 8e-7 rad, so up to that past 180°, as promised",
        lambda p, q: _exact(p, q) + 8e-7,
    ),
    ("S up to 0.018° above the least, as promised: the tolerance is 0.02°", _above),
)


def _backward(point: Floats, previous: Floats) -> Floats:
    rows = _rows(point, 0.008 * deg)[::-1]
    found: Floats = rows[abs(rows - previous).sum(axis=-1).argmin()]
    return found


def _kept(joint: int, otherwise: int) -> Program:
    """One angle as it was, where the family has it; else the first or the last row."""

    def program(point: Floats, previous: Floats) -> Floats:
        rows = _rows(point, 0.1 * deg)
        values = rows[:, joint] - previous[joint]
        found: Floats = rows[abs(values).argmin()]
        if values.min() > 0 or values.max() < 0:
            found = rows[otherwise]
        return found

    return program


def _mirrored(point: Floats, previous: Floats) -> Floats:
    """The other bend, written with the same angles."""
    q = _exact(point, previous)
    return np.array([2 * np.arctan2(point[1], point[0]) - q[0], 2 * np.pi - q[1], 2 * np.pi - q[2]])


def _quotient_least(point: Floats, previous: Floats) -> Floats:
    q = _exact(point, previous)
    turned = np.arctan(point[1] / point[0]) - np.arctan2(point[1], point[0])
    found: Floats = q + [turned, 0, 0]
    return found


def _kinks_only(point: Floats, previous: Floats) -> Floats:
    """The places where an angle stays as it was, without the ends of the range."""
    rows = _rows(point, 0.02 * deg)
    change = rows - previous
    crossed = (change[1:] * change[:-1] <= 0).any(axis=-1)
    kinks = rows[1:][crossed]
    if not len(kinks):
        kinks = rows[len(rows) // 2 :][:1]
    found: Floats = _refined(point, previous, kinks)
    return found


def _refined(point: Floats, previous: Floats, rows: Floats) -> Floats:
    best = rows[abs(rows - previous).sum(axis=-1).argmin()]
    ends = _rows(point, np.pi)[[0, -1], 2]
    near = np.clip(best[2] + np.linspace(-0.02, 0.02, 41) * deg, *ends)
    fine = ARM.family(point, near)
    found: Floats = fine[abs(fine - previous).sum(axis=-1).argmin()]
    return found


class _Forgets:
    """Takes the arm to stand for ever where it stood at the first call."""

    def __init__(self) -> None:
        self.first: Floats | None = None

    def __call__(self, point: Floats, previous: Floats) -> Floats:
        self.first = np.array(previous) if self.first is None else self.first
        return _exact(point, self.first)

    def anew(self) -> Program:
        """One that has not been called."""
        return _Forgets()


MIDDLE = np.array([np.pi / 2, np.pi / 2, np.pi / 2])

LEAST_MISTAKES = (
    Mistake(
        "the previous posture of the first task",
        "It takes the arm to stand for ever where it stood at its first task. A test finds that "
        "with tasks from unlike postures.",
        _Forgets(),
    ),
    Mistake(
        "it stays where it is",
        "It returns the old posture: no movement at all, and S = 0. Does the gripper reach K?",
        lambda point, previous: previous.copy(),
    ),
    Mistake(
        "the least sum of squares",
        "It adds the squares of the changes. The posture reaches K and is near, but its S is not "
        "the least.",
        lambda point, previous: _swept(point, previous, cost=lambda d: (d**2).sum(axis=-1)),
    ),
    Mistake(
        "the longest motor counts",
        "It makes the largest of the three changes small: the least time, not the least sum.",
        lambda point, previous: _swept(point, previous, cost=lambda d: abs(d).max(axis=-1)),
    ),
    Mistake(
        "no absolute values",
        "It adds the changes with their signs: a large negative one looks cheap.",
        lambda point, previous: _swept(point, previous, cost=lambda d: d.sum(axis=-1)),
    ),
    Mistake(
        "gamma does not count",
        "It adds the changes of alpha and beta only.",
        lambda point, previous: _swept(point, previous, cost=lambda d: abs(d[:, 1:]).sum(axis=-1)),
    ),
    Mistake(
        "alpha does not count",
        "It adds the changes of gamma and beta only.",
        lambda point, previous: _swept(point, previous, cost=lambda d: abs(d[:, :2]).sum(axis=-1)),
    ),
    Mistake(
        "a step of 1°",
        "Its rows are 1° apart: mostly more than 0.02° above the least. How much more than the "
        "least do you allow?",
        lambda point, previous: _swept(point, previous, step=1 * deg),
    ),
    Mistake(
        "a step of 0.1°",
        "Its rows are 0.1° apart: in many tasks it is more than 0.02° above the least. Each task "
        "has to keep the 0.02°, not their mean, and S itself counts, not its share.",
        lambda point, previous: _swept(point, previous, step=0.1 * deg),
    ),
    Mistake(
        "S up to 0.028° above the least",
        "It takes a posture somewhat beside the least. How much more than the least do you allow? "
        "0.02°, in radians: 0.02 * deg.",
        lambda point, previous: _above(point, previous, 0.028 * deg),
    ),
    Mistake(
        "rounded to hundredths of a degree",
        "Its angles are rounded to 0.01°: the gripper ends up some 0.1 mm beside K. How far from K "
        "do you allow? 1e-5 m, in every task.",
        lambda point, previous: np.round(_exact(point, previous) / deg, 2) * deg,
    ),
    Mistake(
        "the most movement",
        "argmax for argmin.",
        lambda point, previous: _swept(point, previous, cost=lambda d: -abs(d).sum(axis=-1)),
    ),
    Mistake(
        "the first row",
        "It takes the posture with the lowest alpha, whatever was before.",
        lambda point, previous: _rows(point, 1 * deg)[0],
    ),
    Mistake(
        "the last row",
        "It takes the posture with the highest alpha, whatever was before.",
        lambda point, previous: _rows(point, 1 * deg)[-1],
    ),
    Mistake(
        "alpha stays where it can",
        "It keeps alpha. Often another angle should stay as it was.",
        _kept(2, 0),
    ),
    Mistake(
        "beta is not moved",
        "Its gamma and alpha are right, its beta is that of before. Look at all three angles, or "
        "at where the gripper is.",
        lambda point, previous: np.where([0, 1, 0], previous, _exact(point, previous)),
    ),
    Mistake(
        "beta stays where it can",
        "It keeps beta. Often another angle should stay as it was.",
        _kept(1, -1),
    ),
    Mistake(
        "the ends of the range left out",
        "It compares the kinks alone. Where no angle can stay as it was, the least S is at an end "
        "of the range, or at a level place. Try many postures before.",
        _kinks_only,
    ),
    Mistake(
        "the limit of gamma forgotten",
        "Some of its postures have gamma above 180°. Look at the limits, and ask for points behind "
        "the base, too (directions of 110° to 140°).",
        lambda point, previous: _swept(point, previous, limited=False),
    ),
    Mistake(
        "the other bend",
        "Its gripper is on K, but its chain turns counter-clockwise: its beta and alpha are above "
        "180°.",
        _mirrored,
    ),
    Mistake(
        "arctan of y / x",
        "Where x is negative its gripper is on the other side of O. Ask for points left of O, too.",
        _quotient_least,
    ),
    Mistake(
        "from the middle posture",
        "It counts from a fixed posture and not from the one before.",
        lambda point, previous: _exact(point, MIDDLE),
    ),
    Mistake("degrees", DEGREES, lambda point, previous: _exact(point, previous) / deg),
    Mistake(
        "the angles in another order",
        "It returns (alpha, beta, gamma). Let the chain say where the gripper is.",
        lambda point, previous: _exact(point, previous)[::-1],
    ),
    Mistake(
        "NaN",
        "It returns NaN. A comparison with NaN is always False: ask whether the error is small, "
        "not whether it is large.",
        lambda point, previous: np.full(3, np.nan),
    ),
)


# --- 3: two tasks at once -------------------------------------------------------------------------

UNITS = {
    **dict.fromkeys(("gamma", "beta", "alpha"), ("°, where the arm stands", deg)),
    **dict.fromkeys(("x_first", "y_first", "x_second", "y_second"), ("m", 1.0)),
    "most": ("° of movement in all", deg),
    "longest": ("° of the longest motors, both tasks", deg),
}
EASE = 1e-6


def places(numbers: Mapping[str, Any]) -> tuple[Floats, Floats]:
    """The two targets (2,)."""
    first = np.array([numbers["x_first"], numbers["y_first"]])
    return first, np.array([numbers["x_second"], numbers["y_second"]])


def start(numbers: Mapping[str, Any]) -> Floats:
    """Where the arm stands."""
    return np.array([numbers[name] for name in ("gamma", "beta", "alpha")])


def changes(numbers: Mapping[str, Any], postures: tuple[Floats, Floats]) -> tuple[Floats, Floats]:
    """How far each joint turns in both tasks (..., 3)."""
    return abs(postures[0] - start(numbers)), abs(postures[1] - postures[0])


def greedy(numbers: Mapping[str, Any]) -> tuple[Floats, Floats]:
    """The postures with the least S, task by task."""
    first, second = places(numbers)
    one = ARM.least(first, start(numbers))[0]
    return one, ARM.least(second, one)[0]


@cache
def _given(who: Any) -> Numbers:
    roll = dice(LAB, who)
    while True:  # a tenth of the draws and more will do
        numbers: dict[str, Any] = {
            "gamma": (50 + 5 * roll.randrange(13)) * deg,
            "beta": (90 + 5 * roll.randrange(10)) * deg,
            "alpha": (90 + 5 * roll.randrange(10)) * deg,
        }
        for name, first in (("first", 0), ("second", 125)):
            r = 2.1 + 0.05 * roll.randrange(12)
            phi = (first + 5 * roll.randrange(9 if name == "first" else 6)) * deg
            numbers[f"x_{name}"] = round(float(r * np.cos(phi)), 1)
            numbers[f"y_{name}"] = round(float(r * np.sin(phi)), 1)
        ranges = [ARM.alpha_range(place) for place in places(numbers)]
        if np.isnan(ranges).any():
            continue
        rows = [
            ARM.family(p, np.linspace(*r, 181))
            for p, r in zip(places(numbers), ranges, strict=True)
        ]
        one, two = changes(numbers, (rows[0][:, None], rows[1]))
        S, longest = (one.sum(-1) + two.sum(-1)) / deg, (one.max(-1) + two.max(-1)) / deg
        greed = sum(float(d.sum()) for d in changes(numbers, greedy(numbers))) / deg
        if greed < 1.1 * S.min():
            continue
        most = float(np.ceil(S.min() + 0.4 * (greed - S.min())))
        longest_most = float(np.ceil(1.08 * longest[most >= S].min()))
        numbers["most"], numbers["longest"] = most * deg, longest_most * deg
        return Numbers(numbers, UNITS)


def given(who: Any) -> Numbers:
    """A posture, two targets and two limits. Least movement task by task is above the first limit;
    some pairs of postures of a grid of 1° keep both.
    """
    return Numbers(dict(_given(str(who))), UNITS)


def plan_form(answer: Any, given: Any) -> Floats:
    """Two alphas in radians."""
    wanted = 'a dict {"first": ..., "second": ...} with two alphas in radians'
    if isinstance(answer, Mapping):
        missing = [key for key in ("first", "second") if key not in answer]
        if missing:
            raise ValueError(f"Your dict has no {' and no '.join(map(repr, missing))}.")
        answer = [answer["first"], answer["second"]]
    try:
        alphas = floats(answer).ravel()
    except (TypeError, ValueError):
        raise ValueError(f"Wanted {wanted}, got {words(answer)}.") from None
    if alphas.shape != (2,):
        says = "; alpha alone says which posture it is" if alphas.size == 6 else ""
        raise ValueError(f"Wanted {wanted}, got {words(answer)}{says}.")
    if not np.isfinite(alphas).all():
        raise ValueError(f"Wanted {wanted}, got {words(answer)}: a number is missing.")
    return alphas


def plan_faults(alphas: Floats, given: Mapping[str, Any]) -> list[Fault]:
    """Both postures exist; gamma inside its limits; not too much movement; not too slow."""
    if (alphas > 2 * np.pi).any():
        return [("degrees for radians", DEGREES)] * 4
    if (alphas < 2 * np.pi * deg).all() and (alphas > 0).all():
        told = " and ".join(f"{alpha / deg:.2g}°" for alpha in alphas)
        return [("deg twice", f"Your alphas are {told}; an alpha of 120° is 120 * deg.")] * 4
    found = _plan_faults(alphas, given)
    if found and not _plan_faults(alphas[::-1], given):
        says = "Exchanged, your two alphas keep everything: the first belongs to the first target."
        found.insert(0, ("the two alphas exchanged", says))
    return found


def _plan_faults(alphas: Floats, given: Mapping[str, Any]) -> list[Fault]:
    targets, postures, gone = places(given), [], []
    for name, place, alpha in zip(("first", "second"), targets, alphas, strict=True):
        q = ARM.family(place, alpha)
        postures.append(q)
        if np.isnan(q).any():
            low, high = (float(x) / deg for x in ARM.alpha_range(place, limited=False))
            is_at, edge = apart(alpha / deg, low if alpha / deg < low else high, 2)
            ends = f"{edge}° to {high:.2f}°" if alpha / deg < low else f"{low:.2f}° to {edge}°"
            gone.append(
                f"No posture reaches the {name} target with alpha = {is_at}°: it goes from {ends}."
            )
    if gone:
        swapped = np.isfinite(
            [ARM.family(p, a) for p, a in zip(targets, alphas[::-1], strict=True)]
        ).all()
        if swapped:
            gone.append("Exchanged, your two alphas would exist.")
        return [("alpha outside its range", " ".join(gone))] * 4
    found: list[Fault] = []
    for name, q in zip(("first", "second"), postures, strict=True):
        if not within(ARM, q).all():
            says = (
                f"At the {name} target gamma would be {q[0] / deg:.2f}°; it may go from 0° to "
                "180°. gamma grows with alpha: take a smaller alpha."
            )
            found.append((f"gamma past its limit at the {name} target", says))
    one, two = changes(given, (postures[0], postures[1]))
    S, most = float(one.sum() + two.sum()), given["most"]
    if S > most + EASE:
        greed = [q[2] for q in greedy(given)]
        turned, allowed = apart(S / deg, most / deg)
        says = (
            f"Together the joints turn by {one.sum() / deg:.1f}° and {two.sum() / deg:.1f}°, "
            f"{turned}° in all; allowed are {allowed}°."
        )
        again = float(abs(postures[1] - start(given)).sum())
        if one.sum() + again <= most + EASE:
            says += (
                f" Counted from where the arm stands now the second task would be "
                f"{again / deg:.1f}°; it begins where the first one ended."
            )
        if abs(alphas - greed).max() < 0.2 * deg:
            found.append(("greed", f"{says} This is the least for each task by itself."))
        else:
            found.append(("too much movement", says))
    time, longest = float(one.max() + two.max()), given["longest"]
    if time > longest + EASE:
        turned, allowed = apart(time / deg, longest / deg)
        says = (
            f"The longest motors turn by {one.max() / deg:.1f}° and {two.max() / deg:.1f}°, "
            f"{turned}° in all; allowed are {allowed}°."
        )
        busiest = float((one + two).max())
        if busiest <= longest + EASE:
            says += (
                f" The busiest motor of both tasks together turns by {busiest / deg:.1f}°, but "
                "each task waits for its own longest motor."
            )
        found.append(("too slow", says))
    return found


# --- The predictions' numbers and views -----------------------------------------------------------

MINUS = str.maketrans("-", "\N{MINUS SIGN}")
UPRIGHT = np.array([90, 180, 180]) * deg
BENT = np.array([90, 180, 120]) * deg


def _said(place: Floats) -> str:
    return f"({place[0]:.2f}, {place[1]:.2f}) m".translate(MINUS)


@cache
def _bend_facts() -> dict[str, Any]:
    gripper = ARM.points(BENT)[3]
    turned = ARM.points(UPRIGHT)[2] + _direction(-30 * deg)  # by 120 degrees, to the right
    leaning = ARM.points(np.array([30, 180, 180]) * deg)[3]
    candidates = [gripper * [-1, 1], gripper, turned, leaning]
    return {
        "right": int(np.argmin([np.hypot(*(c - gripper)) for c in candidates])),
        "left_side": _said(candidates[0]),
        "place": _said(gripper),
        "turned": _said(turned),
        "leaning": _said(leaning),
    }


def _bend_view() -> Any:
    from ..show import Sketch

    sketch = Sketch(
        "The upright arm dashed, the bent one drawn: the last lever has turned to the right by "
        "60 degrees; the angle inside, between AB and AK, is 120 degrees.",
        title=f"An interior angle of {BENT[2] / deg:.0f}° is a turn of "
        f"{180 - BENT[2] / deg:.0f}° to the right",
        unit="m",
        height=3.8,
    )
    sketch.levers(ARM.points(UPRIGHT), dashed=True)
    sketch.levers(ARM.points(BENT), ["O", "B", "A", "K"])
    sketch.angle(ARM.points(BENT)[2], 270 * deg, 390 * deg, "α = 120°", radius=0.3)
    sketch.ax.set_xlim(-2.5, 3.5)
    return sketch


NEAR, FAR = 1.5, 2.8  # m


def _width(KO: float) -> float:
    low, high = ARM.alpha_range((KO, 0), limited=False)
    return float(high - low) / deg


@cache
def _width_facts() -> dict[str, Any]:
    near, far = _width(NEAR), _width(FAR)
    return {
        "near_KO": NEAR,
        "far_KO": FAR,
        "near": near,
        "far": far,
        "share": near * NEAR / FAR,
        "wider": near * FAR / NEAR if near * FAR / NEAR < 180 else 180.0,
        "lowest": 180 - far,
        "between": _width(2.0),
    }


def _width_right(facts: Mapping[str, Any]) -> int:
    guesses = [facts[name] for name in ("wider", "near", "share", "far")]
    return int(np.argmin([abs(guess - _width(FAR)) for guess in guesses]))


def _width_view() -> Any:
    from ..show import figure

    KO = np.linspace(1, 3, 401)
    low = ARM.alpha_range(np.stack([KO, 0 * KO], axis=-1), limited=False)[0] / deg
    fig = figure(
        "The angles alpha that reach K, against the distance KO: from 0 to 180 degrees at 1 m, "
        "180 degrees alone at 3 m.",
        height=3.4,
    )
    ax = fig.subplots()
    ax.fill_between(KO, low, 180, color="#7FB8D8", linewidth=0)
    for at in (NEAR, FAR):
        ax.plot([at, at], [180 - _width(at), 180], "k", linewidth=2)
        ax.annotate(
            f"{_width(at):.1f}°", (at, 150), (-6, 0), textcoords="offset points", ha="right"
        )
    ax.set(
        xlabel="distance KO, m",
        ylabel="free angle α, °",
        xlim=(1, 3),
        ylim=(0, 182),
        title="The farther K is, the smaller is the family",
    )
    fig.tight_layout()
    return fig


@cache
def _equal_facts() -> dict[str, Any]:
    KO = float(np.hypot(*K))
    low = 180 - _width(KO)
    turn = float(np.arccos((KO - L) / (2 * L))) / deg
    return {
        "equal": 180 - turn,
        "turn": turn,
        "middle": (low + 180) / 2,
        "sixty": 120.0,
        "square": 90.0,
        "low": low,
    }


def _equal_right(facts: Mapping[str, Any]) -> int:
    guesses = np.array([facts[name] for name in ("equal", "middle", "sixty", "turn", "square")])
    q = ARM.family(K, guesses * deg)
    return int(np.argmin(abs(q[:, 1] - q[:, 2])))


def _equal_view() -> Any:
    from ..show import JOINT_STYLES, figure

    low, high = ARM.alpha_range(K)
    alphas = np.linspace(low, high, 241)
    family = ARM.family(K, alphas) / deg
    fig = figure(
        "Left: nine postures of the family, the symmetric one strongly. Right: beta falls and "
        "gamma grows with alpha; beta and alpha are equal at one place.",
        height=3.7,
    )
    left, right = fig.subplots(1, 2, width_ratios=[1, 1.15])
    for a in np.linspace(low, high, 9):
        left.plot(*ARM.points(ARM.family(K, a)).T, "o-", color="0.7", markersize=4, linewidth=1.3)
    same = _equal_facts()["equal"]
    left.plot(*ARM.points(ARM.family(K, same * deg)).T, "ko-", markersize=6, linewidth=3)
    left.set(aspect="equal", xlabel="x, m", ylabel="y, m", title="Three equal sides: a trapezoid")
    for joint, name in ((0, "γ"), (1, "β"), (2, "α")):
        style = JOINT_STYLES[joint]
        dash = (0, style["dash"]) if style["dash"] else "-"
        right.plot(alphas / deg, family[:, joint], color=style["color"], linewidth=2.2, ls=dash)
        right.text(182, family[-1, joint], name, color=style["color"], va="center")
    right.plot(same, same, "ko", markersize=7)
    right.annotate(f"{same:.1f}°", (same, same), (12, -3), textcoords="offset points")
    right.set(xlabel="free angle α, °", ylabel="γ, β, α, °", title="β = α at one place")
    fig.tight_layout()
    return fig


RING = 1.8  # m, about O
SAMPLE = 80 * deg  # alpha: so gamma stays below 180° from 30° to 130°


@cache
def _quotient_facts() -> dict[str, Any]:
    there = RING * _direction(120 * deg)
    q = ARM.family(there, SAMPLE)
    wrong = np.arctan(there[1] / there[0]) - np.arctan2(there[1], there[0])
    gripper = ARM.points(q + [wrong, 0, 0])[3]
    candidates = [there, there * [-1, 1], -there, np.array([0, RING])]  # as the options have them
    return {
        "right": int(np.argmin([np.hypot(*(c - gripper)) for c in candidates])),
        "there": _said(there),
        "gripper": _said(gripper),
        "off": float(np.hypot(*(gripper - there))),
        "mirrored": _said(there * [-1, 1]),
    }


def _quotient_view() -> Any:
    from ..show import animate

    t = np.linspace(0, 8, 601)
    phi = (30 + 100 * t / t[-1]) * deg
    ring = RING * _direction(phi)
    q = ARM.family(ring, SAMPLE)
    wrong = q.copy()
    wrong[:, 0] += np.arctan(ring[:, 1] / ring[:, 0]) - phi
    moving = np.concatenate([ring, np.zeros((len(t), 1))], axis=1)
    return animate(
        [ARM, ARM],
        t,
        [q, wrong],
        names=["arctan2(y, x)", "arctan(y / x)"],
        points={"K": moving},
        title="K passes the y axis",
    )


BEHIND, BEHIND_KO = 150.0, 2.0  # degrees, m


def _share(phi: float) -> float:
    """How much of the range of alpha has gamma up to 180 degrees, in percent."""
    place = BEHIND_KO * _direction(phi * deg)
    low, high = (float(x) for x in ARM.alpha_range(place))
    first, last = (float(x) for x in ARM.alpha_range(place, limited=False))
    return 0.0 if np.isnan(low) else 100 * (high - low) / (last - first)


@cache
def _behind_facts() -> dict[str, Any]:
    place = BEHIND_KO * _direction(BEHIND * deg)
    low = float(ARM.alpha_range(place, limited=False)[0]) / deg
    gamma = ARM.family(place, np.array([low, 180]) * deg)[:, 0] / deg
    return {
        "phi": BEHIND,
        "KO": BEHIND_KO,
        "low": low,
        "share": _share(BEHIND),
        "first": gamma[0],
        "last": gamma[1],
        "none_from": next(phi for phi in np.arange(150, 180, 0.1) if _share(phi) == 0),
    }


def _behind_right(facts: Mapping[str, Any]) -> int:
    guesses = [100.0, 50.0, 1.0, 0.0]
    return int(np.argmin([abs(guess - facts["share"]) for guess in guesses]))


def _behind_view() -> Any:
    from ..show import figure

    phi = np.linspace(0, 180, 721)
    ring = BEHIND_KO * _direction(phi * deg)
    every, kept = (np.array(ARM.alpha_range(ring, limited=flag)) / deg for flag in (False, True))
    fig = figure(
        "Range of alpha for targets 2 m away against their direction. Up to about 104 degrees all "
        "of it is usable; then less and less, and from about 151 degrees on nothing.",
        height=3.4,
    )
    ax = fig.subplots()
    ax.fill_between(phi, *every, facecolor="0.92", edgecolor="0.6", hatch="//", linewidth=0)
    ax.fill_between(phi, *kept, color="#7FB8D8", linewidth=0)
    ax.text(30, 125, "usable", fontweight="bold")
    ax.text(
        128, 160, "γ above 180°", bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.9}
    )
    ax.axvline(BEHIND, color="black", linewidth=1)
    ax.set(
        xlabel="direction of K seen from O, °",
        ylabel="α, °",
        xlim=(0, 180),
        ylim=(60, 182),
        title=f"{BEHIND_KO:g} m from the base: behind the arm the family dies out",
    )
    fig.tight_layout()
    return fig


MOVE = 0.1  # m
STEADY = 1e-6  # rad: an angle that stays as it was


def _moves() -> tuple[Floats, Floats]:
    """Random postures and points 10 cm away from their grippers."""
    rng = np.random.default_rng(6)
    before = rng.uniform(30, 170, (900, 3)) * deg
    gripper = ARM.points(before)[:, 3]
    far = np.hypot(*gripper.T)
    keep = (far > 1.2) & (far < 2.7)
    way = MOVE * _direction(rng.uniform(0, 2 * np.pi, int(keep.sum())))
    return before[keep], gripper[keep] + way


@cache
def _still_facts() -> dict[str, Any]:
    before, places_ = _moves()
    q, S = ARM.least(places_, before)
    reached = np.isfinite(S)
    still = (abs(q - before)[reached] < STEADY).sum(axis=-1)
    alphas = np.linspace(*ARM.alpha_range(places_), 301, axis=-1)
    rows = ARM.family(places_[:, None], alphas)
    squares = ((rows - before[:, None]) ** 2).sum(axis=-1)
    best = np.where(np.isnan(squares), np.inf, squares).argmin(axis=-1)
    change = abs(rows[np.arange(len(best)), best] - before)[reached]
    shares = [float((still == k).mean()) for k in range(4)]
    return {
        "count": int(reached.sum()),
        "turning": 3 - int(np.argmax(shares)),
        "one": 100 * shares[1],
        "none": 100 * shares[0],
        "two": int((still == 2).sum()),
        "squares": 100 * float((change > 0.05 * deg).all(axis=-1).mean()),
    }


def _still_view() -> Any:
    from ..show import JOINT_STYLES, figure

    before = ARM.family(K, 100 * deg)
    target = K + [0.1, 0.0]
    exact, S = ARM.least(target, before)
    alphas = np.linspace(*ARM.alpha_range(target), 2001)
    change = abs(ARM.family(target, alphas) - before) / deg
    fig = figure(
        "The changes of gamma, beta and alpha and their sum S against alpha, near the least S. "
        "Each change is a V that touches 0 where this angle stays; S has its least value at one "
        "of these places.",
        height=3.7,
    )
    ax = fig.subplots()
    ax.plot(alphas / deg, change.sum(axis=-1), "k", linewidth=2.4)
    ax.plot(exact[2] / deg, S / deg, "kD", markersize=7)
    ax.text(117, change.sum(axis=-1)[abs(alphas / deg - 117).argmin()] + 1.5, "S", ha="right")
    for joint, name in ((0, "γ"), (1, "β"), (2, "α")):
        style = JOINT_STYLES[joint]
        dash = (0, style["dash"]) if style["dash"] else "-"
        ax.plot(alphas / deg, change[:, joint], color=style["color"], linewidth=1.8, ls=dash)
        at = abs(alphas / deg - 119).argmin()
        ax.text(119.3, change[at, joint] - 1.5, name, color=style["color"], va="top")
    stays = int(np.argmin(abs(exact - before)))
    ax.set(
        xlabel="α, °",
        ylabel="change, °",
        xlim=(86, 121),
        ylim=(0, 45),
        title=f"S is least where {'γβα'[stays]} stays as it was",
    )
    fig.tight_layout()
    return fig


COARSE, FINE = 1.0, 0.1  # degrees


def _tasks(count: int) -> tuple[Floats, Floats]:
    rng = np.random.default_rng(9)
    r, phi = rng.uniform(1.05, 2.95, count), rng.uniform(0, 120, count) * deg
    before = rng.uniform(30, 170, (count, 3)) * deg
    ring = r[:, None] * _direction(phi)
    there = np.isfinite(ARM.alpha_range(ring)[0])
    return ring[there], before[there]


@cache
def _scale_facts() -> dict[str, Any]:
    ring, before = _tasks(150)
    least = ARM.least(ring, before)[1]
    above = {}
    for step in (COARSE, FINE):
        S = np.array([ARM.sweep(p, q, step * deg)[1] for p, q in zip(ring, before, strict=True)])
        above[step] = float((S - least).mean()) / deg
    coarse = above[COARSE]
    return {
        "count": len(ring),
        "coarse": coarse,
        "found": above[FINE],
        "root": coarse / np.sqrt(10),
        "tenth": coarse / 10,
        "hundredth": coarse / 100,
    }


def _scale_right(facts: Mapping[str, Any]) -> int:
    guesses = [facts[name] for name in ("coarse", "root", "tenth", "hundredth")]
    return int(np.argmin([abs(np.log(guess / facts["found"])) for guess in guesses]))


def _scale_view() -> Any:
    from ..show import figure

    target, before = np.array([1.8, 0.6]), np.array([100, 110, 120]) * deg
    exact, S = ARM.least(target, before)
    fig = figure(
        "S near its least value is a V. The rows of a sweep with a step of 1 degree and with a "
        "tenth of it lie on both sides of the tip; the finer ones come about ten times nearer.",
        height=3.5,
    )
    axes = fig.subplots(1, 2)
    for ax, step in zip(axes, (COARSE, FINE), strict=True):
        near = exact[2] + np.linspace(-1.8, 1.8, 801) * step * deg
        curve = abs(ARM.family(target, near) - before).sum(axis=-1) / deg
        ax.plot(near / deg, curve, "k", linewidth=1.6)
        rows = ARM.table(target, step * deg)
        rows = rows[abs(rows[:, 2] - exact[2]) < 1.8 * step * deg]
        ax.plot(rows[:, 2] / deg, abs(rows - before).sum(axis=-1) / deg, "o", color="#D55E00")
        ax.plot(exact[2] / deg, S / deg, "kD", markersize=7)
        ax.ticklabel_format(useOffset=False)
        ax.locator_params(axis="x", nbins=5)
        ax.set(xlabel="α, °", ylabel="S, °", title=f"rows {step:g}° apart, ◆ exact")
    fig.tight_layout()
    return fig


STAND, TARGET = np.array([60, 120, 120]) * deg, np.array([2.4, 0.4])
RATE = 30.0  # degrees per second, every motor


@cache
def _time_facts() -> dict[str, Any]:
    exact, S = ARM.least(TARGET, STAND)
    rows = ARM.family(TARGET, np.linspace(*ARM.alpha_range(TARGET), 4001))
    change = abs(rows - STAND) / deg
    other = change[change.max(axis=-1).argmin()]
    least = abs(exact - STAND) / deg
    return {
        "S": float(S) / deg,
        "other_S": float(other.sum()),
        "time": float(least.max()) / RATE,
        "other_time": float(other.max()) / RATE,
        "sum_time": float(S) / deg / RATE,
        "other_sum_time": float(other.sum()) / RATE,
        "rate": RATE,
        "longest": float(least.max()),
        "other_longest": float(other.max()),
    }


def _time_right(facts: Mapping[str, Any]) -> int:
    gap = facts["time"] - facts["other_time"]
    return 2 if abs(gap) < 0.01 else int(gap > 0)


def _time_view() -> Any:
    from ..show import figure

    alphas = np.linspace(*ARM.alpha_range(TARGET), 801)
    change = abs(ARM.family(TARGET, alphas) - STAND) / deg
    curves = change.sum(axis=-1), change.max(axis=-1)
    fig = figure(
        "The sum of the changes and the largest of them against alpha: the sum is least near its "
        "right end, the largest is least elsewhere.",
        height=3.5,
    )
    ax = fig.subplots()
    names = ("S, the sum", 166, 68), ("the longest motor: the time", 160, 25)
    for curve, style, (name, x, y) in zip(curves, ("-", "--"), names, strict=True):
        ax.plot(alphas / deg, curve, style, color="black", linewidth=2)
        k = int(curve.argmin())
        ax.plot(alphas[k] / deg, curve[k], "kD", markersize=7)
        ax.text(x, y, name, ha="right" if style == "-" else "left")
    ax.set(
        xlabel="α, °",
        ylabel="°",
        title=f"Least sum at α = {alphas[curves[0].argmin()] / deg:.0f}°, "
        f"least time at {alphas[curves[1].argmin()] / deg:.0f}°",
    )
    fig.tight_layout()
    return fig


TOURS, STOPS = 120, 5


def _best_in_all(before: Floats, tour: Floats, count: int = 121) -> float:
    """The least S of all tasks of a tour together, among `count` rows for each."""
    lows, highs = ARM.alpha_range(tour)
    stages = ARM.family(tour[:, None], np.linspace(lows, highs, count, axis=-1))
    cost = abs(stages[0] - before).sum(axis=-1)
    for one, two in pairwise(stages):
        between = sum(abs(one[:, None, j] - two[None, :, j]) for j in range(3))
        cost = (cost[:, None] + between).min(axis=0)
    return float(cost.min())


@cache
def _losses() -> Floats:
    rng = np.random.default_rng(1)
    r, phi = rng.uniform(1.1, 2.9, (400, STOPS)), rng.uniform(0, 150, (400, STOPS)) * deg
    tours = r[..., None] * _direction(phi)
    tours = tours[np.isfinite(ARM.alpha_range(tours)[0]).all(axis=-1)][:TOURS]
    before = rng.uniform(30, 150, (len(tours), 3)) * deg
    S, now = np.zeros(len(tours)), before
    for stop in range(STOPS):
        now, more = ARM.least(tours[:, stop], now)
        S = S + more
    best = [_best_in_all(q, tour) for q, tour in zip(before, tours, strict=True)]
    losses: Floats = S / np.array(best) - 1
    return losses


@cache
def _greed_facts() -> dict[str, Any]:
    losses = _losses()
    return {
        "tours": len(losses),
        "stops": STOPS,
        "count": int((losses > 0.05).sum()),
        "percent": 100 * float((losses > 0.05).mean()),
        "half": len(losses) // 2,
        "most": 100 * float(losses.max()),
        "small": int((losses > 0.01).sum()),
    }


def _greed_right(facts: Mapping[str, Any]) -> int:
    share = facts["percent"]
    return 0 if share == 0 else 1 if share < 20 else 2 if share < 80 else 3


def _greed_view() -> Any:
    from ..show import figure

    losses = 100 * np.sort(np.maximum(_losses(), 0))[::-1]
    facts = _greed_facts()
    fig = figure(
        "The loss of greed for each of the tours, sorted: a few high bars, and a long row of "
        "hardly any loss.",
        height=3.2,
    )
    ax = fig.subplots()
    ax.bar(np.arange(1, len(losses) + 1), losses, width=1.0, color="#56B4E9")
    ax.axhline(5, color="black", linewidth=1, ls="--")
    ax.set(
        xlabel="tours, sorted",
        ylabel="loss, %",
        title=f"{facts['count']} of {facts['tours']} tours lose more than 5 %",
    )
    fig.tight_layout()
    return fig


RACED = 100


@cache
def _race() -> dict[str, Floats]:
    """The turns (100,) of each task in degrees: name of the rule -> turns. The race of section 8,
    with three of its rules.
    """
    rules = methods((1.2, 1.2), seed=0)
    rules = {name: rules[name] for name in ("random choice", "equal angles", "least movement")}
    postures = np.random.default_rng(4).uniform(0, np.pi, (3 * RACED, 3))
    places = ARM.points(postures)[:, 3]
    places = places[np.isfinite(ARM.alpha_range(places)[0])][:RACED]
    runs = race(rules, ARM, places, np.array([60, 120, 120]) * deg)
    return {name: run.turns / deg for name, run in runs.items()}


@cache
def _race_facts() -> dict[str, Any]:
    turns = _race()
    least, dice = turns["least movement"].mean(), turns["random choice"].mean()
    return {
        "tasks": len(turns["least movement"]),
        "least": float(least),
        "dice": float(dice),
        "added": float(dice - least),
        "percent": float(100 * (dice / least - 1)),
        "times": float(dice / least),
        "equal": float(100 * (turns["equal angles"].mean() / least - 1)),
    }


def _race_right(facts: Mapping[str, Any]) -> int:
    more = facts["percent"]
    return 0 if more < 5 else 1 if more < 100 else 2 if more < 500 else 3


def _race_view() -> Any:
    from ..show import figure

    turns, facts = _race(), _race_facts()
    fig = figure(
        f"The turns of all joints, added up over {facts['tasks']} tasks, for three rules. All "
        "rise evenly; dice are the steepest, equal angles and least movement lie close together.",
        height=3.4,
    )
    ax = fig.subplots()
    for (name, each), color, dash in zip(
        turns.items(), ("#D55E00", "#009E73", "#0072B2"), ("--", ":", "-"), strict=True
    ):
        ax.plot(np.append(0, np.cumsum(each)), color=color, ls=dash, lw=1.8, label=name)
    ax.legend(frameon=False)
    ax.set(
        xlabel="tasks done",
        ylabel="turns in all, °",
        title=f"Dice turn the joints {facts['percent']:.0f} % more than the least movement",
    )
    fig.tight_layout()
    return fig


# --- The tables -----------------------------------------------------------------------------------

EXERCISES = {
    "1": Function(
        title="Levers of any lengths",
        task="The posture (gamma, beta, alpha) of three levers of any lengths with the gripper at "
        "K, alpha given, B counter-clockwise from the line OK; NaN where there is none.",
        objective=1,
        hints=(
            "Go through section 3 and ask of each formula: where does it use that levers are "
            "equally long? The triangle B, A, K is no longer isosceles.",
            "KB² = b² + c² - 2 b c cos(alpha) with b = BA and c = AK. In the triangle O, B, K the "
            "sides are a, KB and KO. The angle at B in the triangle B, A, K lies between KB and b, "
            "opposite c.",
            "beta_2 = arctan2(c sin(alpha), b - c cos(alpha)), or arccos((KB² + b² - c²) / (2 KB "
            "b)). Then gamma = gamma_1 + arctan2(y, x) and beta = beta_1 + beta_2. NaN: leave out "
            "np.clip, or ask first whether KO lies between |a - KB| and a + KB.",
        ),
        inputs=("K", "alpha", "lengths"),
        right=_levers_right,
        cases=_levers_cases,
        form=_posture_form,
        law=_levers_law,
        same=_same_posture,
        mistakes=LEVER_MISTAKES,
    ),
    "2": Catch(
        title="A test for least movement",
        task="A test: whether the program least(K, previous) finds the least movement.",
        objective=2,
        hints=(
            "Three things have to hold: the gripper is on K, every angle is within its limits, and "
            "S is not too far above the least. A program that returns the old posture has S = 0.",
            "Take a hundred random tasks: K at distances from 1.1 to 2.9 m in directions from 0° "
            "to 145°, any posture before. Leave out what `arm.least` does not reach (NaN). "
            "Compare S, not the angles: two postures may be equally near.",
            "For each task: q = np.asarray(program(K, previous)); return False unless q.shape == "
            "(3,), the distance of joints(q)[3] from K is below 1e-5, (q >= -1e-6).all() and "
            "(q <= np.pi + 1e-6).all(), and abs(q - previous).sum() <= S + 0.02 * deg with S from "
            "arm.least(K, previous). A hundred tasks are enough; for NaN, ask what is small.",
        ),
        rights=RIGHT_LEAST,
        promise="A right program puts the gripper within 1e-5 m of K, keeps 0° to 180°, and its S "
        "is at most 0.02° above the least. Its posture may be another one than yours.",
        mistakes=LEAST_MISTAKES,
    ),
    "3": Value(
        title="Two tasks at once",
        task="Two postures for two targets of one's own: little movement in all, and quick.",
        objective=3,
        hints=(
            "Two numbers decide, alpha at the first target and alpha at the second. What does the "
            "greedy arm do at the first target that it has to undo at the second?",
            "Try pairs: for each alpha of the first family and each of the second add up |change| "
            "of all joints over both tasks, and for the time the largest change of each task. "
            "Steps of 1° are enough.",
            "one = arm.family(K1, np.linspace(*arm.alpha_range(K1), 181)), two the same for K2. "
            "d1 = abs(one - start), d2 = abs(one[:, None] - two); S = d1.sum(-1)[:, None] + "
            "d2.sum(-1), longest = d1.max(-1)[:, None] + d2.max(-1). Take a pair with S <= most "
            "and longest <= the limit.",
        ),
        form=plan_form,
        faults=plan_faults,
        count=4,
        given=given,
    ),
}

# Objective 1: p1 to p5. Objective 2: p6, p7. Objective 3: p8, p9, p10.
PREDICTIONS = {
    "p1": Prediction(
        question="The arm stands upright: gamma = 90°, beta = 180°, alpha = 180°. The gripper is "
        "at (0, 3) m. Now alpha, the interior angle at A, goes to 120°. Where is the gripper?",
        options=(
            Option(
                "{left_side}, on the left",
                "The chain turns clockwise here: on the way from O to K the last lever turns to "
                "the right.",
                "counter-clockwise, as angles are usually counted",
                "With beta = 120° instead, both outer levers lean to the right, too.",
            ),
            Option(
                "{place}",
                "At 180° the levers are in line. At 120° the last one has turned by 60°, to the "
                "right: it points 30° upwards.",
            ),
            Option(
                "{turned}",
                "That is a turn of 120°. An interior angle of 120° leaves a turn of 180° − 120° = "
                "60°.",
                "the interior angle taken for the turn",
                "At an interior angle of 180° the lever has not turned at all, at 0° it lies back "
                "on the one before.",
            ),
            Option(
                "{leaning}, in line with the others",
                "Only what comes behind the joint A turns: O, B and A stay.",
                "a joint in the middle taken for the one at the base",
                "Bend your wrist: your elbow stays.",
            ),
        ),
        facts=_bend_facts,
        right=lambda facts: int(facts["right"]),
        view=_bend_view,
    ),
    "p2": Prediction(
        question="K is {near_KO:g} m from the base, and the range of alpha is {near:.1f}° wide. K "
        "goes straight out to {far_KO:g} m. How wide is the range now?",
        options=(
            Option(
                "Wider, {wider:.1f}°: an arm that is stretched out has all its joints open.",
                "Open joints are what is asked of it, not what it may choose: near 3 m all "
                "postures are nearly straight.",
                "open joints taken for open choices",
                "At 3 m alpha has to be 180°: the family is a single posture.",
            ),
            Option(
                "As wide, {near:.1f}°: there is one free angle at either place.",
                "One free angle, yes; how far it may go is another matter.",
                "the number of free angles taken for their range",
                "At 1 m alpha goes from 0° to 180°, at 3 m it cannot move at all.",
            ),
            Option(
                "Narrower, {share:.1f}°: in proportion to the distance.",
                "It gets narrower, but not in proportion: an arccosine falls steeply near its end.",
                "proportion where an arccosine is",
                "In proportion the arm could still choose at 3.5 m, where it does not even reach.",
            ),
            Option(
                "Narrower, {far:.1f}°: a long way leaves little room to bend.",
                "The lowest alpha rises to {lowest:.1f}°. At 2 m the range is {between:.1f}° wide, "
                "at 3 m it is a point.",
            ),
        ),
        facts=_width_facts,
        right=_width_right,
        view=_width_view,
    ),
    "p3": Prediction(
        question="At K = (1.5, 1) m alpha goes from {low:.2f}° to 180°. beta falls meanwhile. At "
        "which alpha are beta and alpha equal? (A sketch of that posture helps.)",
        options=(
            Option(
                "{equal:.1f}",
                "Equal angles and equal levers are a trapezoid: KO = L + 2 L cos(180° − alpha). "
                "Read from K to O the chain is the same: whatever pair (beta, alpha) reaches a "
                "distance, (alpha, beta) reaches it, too.",
            ),
            Option(
                "{middle:.1f}",
                "beta falls faster than alpha rises at first and more slowly later: they meet "
                "before the middle.",
                "the middle of the range",
                "At 2.5 m from the base the range begins at 108.2°, and they meet at 138.6°, not "
                "at 144.1°.",
            ),
            Option(
                "{sixty:.0f}",
                "Three sides of a hexagon have 120° between them, and its K is at 2 m.",
                "a regular hexagon at any distance",
                "At 2 m from the base it is right.",
            ),
            Option(
                "{turn:.1f}",
                "That is the turn, 180° minus the interior angle.",
                "the turn for the interior angle",
                "In line the interior angle is 180° and the turn 0°.",
            ),
            Option(
                "{square:.0f}",
                "Three sides of a square have K at the distance of one lever.",
                "a square at any distance",
                "At 1 m from the base it would be right.",
            ),
        ),
        facts=_equal_facts,
        right=_equal_right,
        view=_equal_view,
        unit="°",
        within=0.008,
    ),
    "p4": Prediction(
        question="K moves on a circle about O, from the direction 30° to 130°. One arm follows "
        "with arctan2(y, x), the other with arctan(y / x). What does the gripper of the other one "
        "do when K passes 90°?",
        options=(
            Option(
                "It stays on K: these are two ways to write one angle.",
                "Up to 90° they are. arctan gives angles between −90° and 90° only.",
                "the angle of a quotient taken for the angle of a point",
                "(1, 1) and (−1, −1) have the same quotient, and lie opposite each other.",
            ),
            Option(
                "It goes back the way it came, as the mirror image of K.",
                "It does leave K, but not to {mirrored}: −y / x is not what is computed.",
                "the mirror image for the opposite point",
                "The quotient of (−1, 2) is that of (1, −2), not that of (1, 2).",
            ),
            Option(
                "It jumps to the opposite side of O.",
                "A point and its opposite have the same y / x. K = {there} gets the angle of its "
                "opposite: the gripper is at {gripper}, {off:.2f} m away.",
            ),
            Option(
                "It stops at 90°: there the quotient does not exist.",
                "It does not exist at 90° alone. A hundredth of a degree later it does, and is "
                "wrong.",
                "the gap taken for the mistake",
                "At 91° y / x is −57.3, a good number.",
            ),
        ),
        facts=_quotient_facts,
        right=lambda facts: int(facts["right"]),
        view=_quotient_view,
    ),
    "p5": Prediction(
        question="K lies {KO:g} m from O in the direction {phi:.0f}°: left of the base, not high. "
        "alpha may go from {low:.1f}° to 180°. In how much of this range is gamma, too, at most "
        "180°?",
        options=(
            Option(
                "In all of it: the triangles keep every angle below 180°.",
                "They keep alpha, beta and gamma_1. To gamma_1 the direction of K is added.",
                "angles of a triangle taken for angles of a joint",
                "With K on the negative x axis gamma is above 180° for every alpha.",
            ),
            Option(
                "In about half of it: gamma grows with alpha.",
                "It grows, but it begins at {first:.1f}° already.",
                "the middle guessed",
                "In the direction 90° it is all of it, from {none_from:.1f}° on nothing.",
            ),
            Option(
                "In about 1 % of it: gamma begins a little below 180° and grows.",
                "gamma goes from {first:.1f}° to {last:.1f}°: {share:.2f} % of the range is left.",
            ),
            Option(
                "In none of it: an arm that bends clockwise does not get behind its base.",
                "Not quite: at its lowest alpha gamma is {first:.1f}°.",
                "a border guessed",
                "From {none_from:.1f}° on it would be right.",
            ),
        ),
        facts=_behind_facts,
        right=_behind_right,
        view=_behind_view,
    ),
    "p6": Prediction(
        question="K moves by 10 cm, and the arm follows with the least sum of turns. How many of "
        "its three joints turn, as a rule?",
        options=(
            Option(
                "All three, each a little: so the work is shared.",
                "That is the least sum of SQUARES: it moves all three in {squares:.0f} % of "
                "{count} random moves. A sum of absolute values does not reward sharing.",
                "the least sum of squares",
                "From 0 to a sum of 10 in two steps: |5| + |5| is |10| + |0|, but 25 + 25 is less "
                "than 100.",
            ),
            Option(
                "Two; the third one stands still.",
                "S has a corner wherever one angle stays as it was, and its least value sits on "
                "such a corner in {one:.0f} % of {count} random moves. In {none:.0f} % all three "
                "turn: at an end of the range, or at a level place.",
            ),
            Option(
                "One; the other two stand still.",
                "K has two coordinates: one joint alone moves it on one circle, and the target "
                "hardly ever lies on it: in {two} of {count} random moves.",
                "two equations with one unknown",
                "Turn gamma alone: K keeps its distance from O.",
            ),
        ),
        facts=_still_facts,
        right=lambda facts: [3, 2, 1].index(facts["turning"]),
        view=_still_view,
    ),
    "p7": Prediction(
        question="In {count} random tasks a sweep in steps of 1° ends above the exact least S, by "
        "{coarse:.3f}° on average. Now the step is 0.1°. By how much is it above?",
        options=(
            Option(
                "{coarse:.3f}°, as before: either step can miss the place.",
                "Either can, but a finer one misses it by less.",
                "a miss is a miss",
                "A fence with posts ten times nearer to each other: the next post is nearer.",
            ),
            Option(
                "About {root:.3f}°: the root of ten times less.",
                "Roots are for averages of random errors. Here the next row counts.",
                "an average taken where a distance is",
                "Round to 0.1 instead of 1: the error is ten times less.",
            ),
            Option(
                "About {tenth:.3f}°: ten times less.",
                "We find {found:.3f}°. The least S mostly sits in a corner, a V: twice as far from "
                "the tip is twice as high.",
            ),
            Option(
                "About {hundredth:.4f}°: a hundred times less, as at every minimum.",
                "So it is at a smooth minimum, a parabola. A V has no level bottom.",
                "a corner taken for a smooth minimum",
                "A sum of squares is smooth: there it would be right.",
            ),
        ),
        facts=_scale_facts,
        right=_scale_right,
        view=_scale_view,
    ),
    "p8": Prediction(
        question="All three motors start together and turn at {rate:.0f}°/s. For one task the "
        "posture with the least S has S = {S:.1f}°. Another posture at the same K has S = "
        "{other_S:.1f}°. Which one is reached first?",
        options=(
            Option(
                "The one with the least S, after {sum_time:.2f} s; the other one takes "
                "{other_sum_time:.2f} s.",
                "That adds the motors up, as if one waited for the other. They turn together.",
                "the sum taken for the time",
                "Three people carry one box each: the time is that of the longest walk.",
            ),
            Option(
                "The other one, after {other_time:.2f} s; that with the least S takes {time:.2f} "
                "s.",
                "The longest motor decides. Least S gives nearly all of the way to one motor "
                "({longest:.1f}°); the other posture shares it ({other_longest:.1f}°).",
            ),
            Option(
                "Both together: they have the same target.",
                "The gripper's way ends at one point. The motors' ways do not.",
                "the gripper's way taken for the motors'",
                "Turn gamma by a whole turn, then go to K: the same target, and a long time.",
            ),
        ),
        facts=_time_facts,
        right=_time_right,
        view=_time_view,
    ),
    "p9": Prediction(
        question="We draw {tours} random tours of {stops} targets each. In how many of them does "
        "the arm that saves on each task lose more than 5 % against one that plans the whole tour?",
        options=(
            Option(
                "In none: the least of each adds up to the least in all.",
                "The second task begins where the first one ended: they are not independent.",
                "a sum of minima taken for the minimum of a sum",
                "A cheap ticket to the wrong station: the way on is dear.",
            ),
            Option(
                "In few, {count} of {tours}.",
                "Mostly the nearest posture is a good place to go on from. {small} tours lose more "
                "than 1 %, the worst one {most:.0f} %. Greed is a good rule with bad days.",
            ),
            Option(
                "In about half, {half}.",
                "Only where a task makes the arm undo what it did for the one before.",
                "a striking example taken for the rule",
                "Two targets near each other: hardly anything to undo.",
            ),
            Option(
                "In nearly all: who does not look ahead always loses.",
                "Not looking ahead costs something only where it changes the choice.",
                "greed never works",
                "With one target there is nothing to look ahead to.",
            ),
        ),
        facts=_greed_facts,
        right=_greed_right,
        view=_greed_view,
    ),
    "p10": Prediction(
        question="{tasks} targets, one after the other: where the gripper is in random postures, "
        "all angles drawn evenly from 0° to 180°. One arm takes the least movement each time, "
        "another throws dice: any alpha of the family, all alike. How much do all joints of the "
        "second one turn in the end, beside those of the first?",
        options=(
            Option(
                "Hardly more: over many tasks chance evens out.",
                "Chance evens out where it errs to both sides. Above the least there is only one "
                "side.",
                "what is never less taken for what is sometimes less",
                "Who takes any road to work is on some days as quick as by the shortest one, and "
                "never quicker.",
            ),
            Option(
                "About {times:.1f} times as much.",
                "The least movement takes {least:.0f}° a task: to get from target to target the "
                "arm has to turn anyhow. Dice add {added:.0f}°. Equal angles, which look at no "
                "posture before, take {equal:.0f} % more than the least movement.",
            ),
            Option(
                "About three times as much.",
                "Then two thirds of all turns would be waste. The way from one target to the next "
                "has to be turned under any rule: {least:.0f}° a task.",
                "the freedom taken for most of the movement",
                "From a target in front to one behind, no alpha saves the turn of gamma.",
            ),
            Option(
                "More than five times as much: the family is endless.",
                "It has endless postures, and all of them between two ends.",
                "endlessly many taken for endlessly far",
                "Between two neighbours of the family there are endless others, and all are near.",
            ),
        ),
        facts=_race_facts,
        right=_race_right,
        view=_race_view,
    ),
}
