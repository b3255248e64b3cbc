"""Lab 12, two links and generated code: its exercises and predictions.

The answers to each exercise come first, right and wrong, then the predictions' numbers and views;
the tables stand at the end.
"""

import ast
import importlib
import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, TypeAlias

import numpy as np

from .._arrays import Floats
from ..arms import two_link
from ..units import deg, mm
from .exercises import words
from .mistakes import Mistake, Program, Tools
from .old import Catch, Function, Value
from .questions import Option, Prediction
from .told import apart, floats
from .variants import Numbers, dice

LAB = "two_link_code_generation"
OBJECTIVES = (
    "derive where two circles meet, for any base and any two lengths, without a division that the "
    "arm does not ask for",
    "have common subexpressions taken out, count the operations before and after, and write C and "
    "Python from one formula",
    "test generated code against its equations: on both sides of every division, with odd numbers, "
    "and at the edges of the reach",
)

# --- 1: the elbow ---------------------------------------------------------------------------------

ROUNDING = 1e-9  # of the reach
Case: TypeAlias = tuple[Any, ...]


@dataclass(frozen=True)
class Place:
    """An answer: a point, and whether the case has one. Where it has none, all points are one
    mistake.
    """

    x: float
    y: float
    exists: bool

    @property
    def found(self) -> bool:
        """Whether it is a point."""
        return not math.isnan(self.x)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        return np.array([self.x, self.y])

    def __repr__(self) -> str:
        return words(np.array(self))


# a formula: case -> (what stands under the root, root -> point, distance of the tip)
Formula: TypeAlias = Callable[..., tuple[float, Callable[[float], Floats], float]]
Rim: TypeAlias = Callable[[float, float, float, float], float]


def _divided(a: float, b: float) -> float:
    """As NumPy divides: inf and NaN, no error."""
    with np.errstate(all="ignore"):
        return float(np.divide(a, b))


def _shares(d2: float, l1: float, l2: float) -> tuple[float, float]:
    a = _divided(d2 + l1**2 - l2**2, 2 * d2)
    return a, _divided(l1**2, d2) - a**2


def _general(base: Floats, tip: Floats, l1: float, l2: float, side: float) -> Any:
    dx, dy = tip - base
    a, h2 = _shares(dx * dx + dy * dy, l1, l2)
    along, across = np.array([dx, dy]), np.array([dy, -dx])
    return h2, lambda h: base + a * along + side * h * across, math.hypot(dx, dy)


def _safe(h2: float, d: float, l1: float, l2: float) -> float:
    slack = ROUNDING * (l1 + l2)
    inside = abs(l1 - l2) - slack <= d <= l1 + l2 + slack and d > 0
    return math.sqrt(max(h2, 0.0)) if inside else math.nan


def _bare(h2: float, d: float, l1: float, l2: float) -> float:
    return math.nan if not h2 >= 0 else math.sqrt(h2)


def _clipped(h2: float, d: float, l1: float, l2: float) -> float:
    return float(np.sqrt(np.maximum(h2, 0.0)))


def _raising(h2: float, d: float, l1: float, l2: float) -> float:
    return math.sqrt(h2)


def _outer(h2: float, d: float, l1: float, l2: float) -> float:
    return math.nan if d > (l1 + l2) * (1 + ROUNDING) else _clipped(h2, d, l1, l2)


def _inner(h2: float, d: float, l1: float, l2: float) -> float:
    near = d < abs(l1 - l2) - ROUNDING * (l1 + l2)
    return math.nan if near else _clipped(h2, d, l1, l2)


def _outer_strict(h2: float, d: float, l1: float, l2: float) -> float:
    return math.nan if d > l1 + l2 else _clipped(h2, d, l1, l2)


def _inner_strict(h2: float, d: float, l1: float, l2: float) -> float:
    return math.nan if d < abs(l1 - l2) else _clipped(h2, d, l1, l2)


def _strict(h2: float, d: float, l1: float, l2: float) -> float:
    return _clipped(h2, d, l1, l2) if abs(l1 - l2) <= d <= l1 + l2 else math.nan


def _refusing(h2: float, d: float, l1: float, l2: float) -> float:
    root = _safe(h2, d, l1, l2)
    if math.isnan(root):
        raise ValueError("out of reach")
    return root


def _margin(h2: float, d: float, l1: float, l2: float) -> float:
    return math.nan if h2 < 1e-3 else math.sqrt(h2)


def _wide(slack: float) -> Rim:
    def root(h2: float, d: float, l1: float, l2: float) -> float:
        inside = abs(l1 - l2) - slack <= d <= l1 + l2 + slack
        return _clipped(h2, d, l1, l2) if inside else math.nan

    return root


def _inner_of(first: int) -> Rim:
    """The inner edge is looked at only where the first link is the longer one (+1), or the second
    one (-1).
    """

    def root(h2: float, d: float, l1: float, l2: float) -> float:
        near = d < first * (l1 - l2) - ROUNDING * (l1 + l2)
        return math.nan if near else _outer(h2, d, l1, l2)

    return root


def _about(h2: float, d: float, l1: float, l2: float) -> float:
    if np.isclose(d, l1 + l2) or np.isclose(d, abs(l1 - l2)):
        return 0.0
    return _clipped(h2, d, l1, l2) if abs(l1 - l2) <= d <= l1 + l2 else math.nan


def _whole(base: Any, tip: Any, l1: float, l2: float, side: float) -> Floats:
    """Written into an array made like the base."""
    elbow = np.zeros_like(base)
    right = _elbow(Tools(), base, tip, l1, l2, side)
    if np.isnan(right).any():
        return right
    elbow[:] = right
    return np.asarray(elbow)


def _solved(formula: Formula, rim: Rim) -> Program:
    def program(base: Floats, tip: Floats, l1: float, l2: float, side: float) -> Floats:
        h2, place, d = formula(base, tip, l1, l2, side)
        return place(rim(h2, d, l1, l2))

    return program


def _elbow(tools: Tools, base: Any, tip: Any, l1: float, l2: float, side: float) -> Floats:
    right: Floats = _solved(_general, _safe)(np.array(base), np.array(tip), l1, l2, side)
    return right


def _elbow_cases(rng: np.random.Generator) -> list[Case]:
    def case(base: Any, tip: Any, l1: float, l2: float, side: int) -> Case:
        return np.array(base, dtype=float), np.array(tip, dtype=float), l1, l2, side

    cases = [
        case([0, 0], [1.2, 0.7], 1.0, 0.8, +1),
        case([0, 0], [1.2, 0.7], 1.0, 0.8, -1),
        case([0.2, -0.1], [1.3, 0.6], 1.0, 0.7, +1),
        case([0, 0], [0, 1.1], 1.0, 0.7, +1),  # straight up: dx = 0
        case([0, 0], [0, 1.1], 1.0, 0.7, -1),
        case([0, 0], [0, -1.1], 0.7, 1.0, +1),
        case([0, 0], [-0.9, 0.3], 0.6, 0.9, +1),  # to the left of the base
        case([0, 0], [-0.9, 0.3], 0.6, 0.9, -1),
        case([0, 0], [-0.5, -0.8], 0.9, 0.5, +1),
        case([0, 0], [1.1, 0], 1.0, 0.7, +1),  # level: dy = 0
        case([0, 0], [-1.1, 0], 0.7, 1.0, -1),
        case([-0.4, 0.3], [-0.4, 1.5], 0.8, 0.9, -1),
        case([0, 0], [0.2, 0.4], 0.6, 1.0, +1),  # the line of the elbows is behind the base
        case([0, 0], [1.2, 0.9], 0.8, 0.5, +1),  # beyond the outer edge
        case([0, 0], [0.1, 0.1], 1.0, 0.7, -1),  # inside the inner one
        case([0.5, -0.2], [-1.4, 0.9], 0.9, 0.9, -1),
    ]
    more, less = 1.7 * (1 + 1e-10), 0.3 * (1 - 1e-10)  # on the rim, and past it by rounding alone
    for turn in (0.0, 0.7, 2.3, -2.9):  # stretched, and folded back
        way = np.array([np.cos(turn), np.sin(turn)])
        cases.append(case([0.1, 0.2], np.array([0.1, 0.2]) + more * way, 1.0, 0.7, +1))
        cases.append(case([0, 0], less * way, 1.0, 0.7, -1))
    cases.append(case([0, 0], [1.699, 0.0], 1.0, 0.7, +1))  # 1 mm inside, 2 mm outside
    cases.append(case([0, 0], [0.0, 1.702], 1.0, 0.7, +1))
    cases.append(case([0, 0], [0.298, 0.0], 1.0, 0.7, +1))
    cases.append(case([0, 0], [1.7 * (1 + 2e-6), 0], 1.0, 0.7, +1))  # 3 micrometres outside, inside
    cases.append(case([0, 0], [0, 1.7 * (1 - 2e-6)], 1.0, 0.7, +1))
    cases.append(case([0, 0], [1.7 * (1 + 1e-7), 0], 1.0, 0.7, +1))  # less than one outside
    cases.append(case([0, 0], [1.7e-3 * (1 + 1e-7), 0], 1e-3, 0.7e-3, +1))  # a small arm
    cases.append(case([0, 0], [0.1, 0.1], 0.7, 1.0, +1))  # too near, the second link longer
    cases.append((np.array([0, 0]), np.array([1, 1]), 1, 1.2, -1))  # whole numbers
    while len(cases) < 44:
        base, l1, l2 = rng.uniform(-1, 1, 2), *rng.uniform(0.4, 1.2, 2)
        turn, share = rng.uniform(-np.pi, np.pi), rng.uniform(0.1, 0.9)
        d = abs(l1 - l2) + share * (l1 + l2 - abs(l1 - l2))
        tip = base + d * np.array([np.cos(turn), np.sin(turn)])
        side = int(1 - 2 * rng.integers(2))
        cases.append(case(base.round(3), tip.round(3), round(l1, 3), round(l2, 3), side))
    return cases


def _exists(case: Case) -> bool:
    base, tip, l1, l2, _ = case
    d, slack = float(np.hypot(*(tip - base))), ROUNDING * (l1 + l2)
    return bool(abs(l1 - l2) - slack <= d <= l1 + l2 + slack)


def _point(result: Any, case: Case) -> Place:
    wanted = "wanted one point [x, y], with NaN twice where there is none"
    try:
        values = np.squeeze(floats(result))
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {words(result)}") from None
    if values.shape == () and np.isnan(values):
        values = np.array([np.nan, np.nan])
    if values.shape == (3,) and values[2] == 0:
        values = values[:2]
    if values.shape != (2,):
        raise ValueError(f"{wanted}, got {words(result)}")
    if np.isnan(values).any():
        values = np.array([np.nan, np.nan])
    return Place(float(values[0]), float(values[1]), _exists(case))


def _elbow_law(case: Case, yours: Place) -> str | None:
    base, tip, l1, l2, side = case
    d = float(np.hypot(*(tip - base)))
    if not yours.exists:
        if not yours.found:
            return None
        far = d > l1 + l2
        is_at, rim = apart(d, l1 + l2 if far else abs(l1 - l2), 3)
        return (
            f"should be NaN twice: the tip is {is_at} m from the base, and the arm reaches "
            f"{'out' if far else 'in'} to {rim} m"
        )
    wanted, mine = _elbow(Tools(), *case), np.array(yours)
    if np.linalg.norm(mine - wanted) <= 1e-6:
        return None
    one, two = np.hypot(*(mine - base)), np.hypot(*(mine - tip))
    name = "right" if side > 0 else "left"
    says = f"should be {words(wanted)}, {l1:.4g} m from the base and {l2:.4g} m from the tip"
    if not yours.found:
        return (
            f"{says}; the tip is {d:.9g} m away, and the arm reaches from {abs(l1 - l2):.4g} m to "
            f"{l1 + l2:.4g} m"
        )
    if abs(one - l1) < 1e-6 and abs(two - l2) < 1e-6:
        return f"{says}, on the {name} of the way from base to tip; yours is on the other side"
    (_, from_base), (_, from_tip) = apart(l1, one, 3), apart(l2, two, 3)
    return f"{says}; yours is {from_base} m and {from_tip} m from them"


def _same_point(a: Place, b: Place) -> bool:
    if a.exists != b.exists or a.found != b.found:
        return False
    near = np.allclose(np.array(a), np.array(b), rtol=0, atol=1e-6)
    return not a.found or not a.exists or bool(near)


def _made(
    way: Program = lambda base, tip: tip - base,
    shares: Program = _shares,
    place: Program | None = None,
    squared: Program = lambda dx, dy: dx * dx + dy * dy,
) -> Formula:
    """The general formula with one of its steps exchanged."""

    def formula(base: Floats, tip: Floats, l1: float, l2: float, side: float) -> Any:
        dx, dy = way(base, tip)
        a, h2 = shares(squared(dx, dy), l1, l2)
        along, across, d = np.array([dx, dy]), np.array([dy, -dx]), math.hypot(dx, dy)
        if place is None:
            return h2, lambda h: base + a * along + side * h * across, d
        return h2, lambda h: place(base, tip, a, side, h, along, across), d

    return formula


def _with_a(a: Program) -> Formula:
    """Another share along the way, and h from it."""

    def shares(d2: float, l1: float, l2: float) -> tuple[float, float]:
        value = a(d2, l1, l2)
        return value, _divided(l1**2, d2) - value**2

    return _made(shares=shares)


def _with_h(h2: Program) -> Formula:
    """Another thing under the root."""

    def shares(d2: float, l1: float, l2: float) -> tuple[float, float]:
        a, _ = _shares(d2, l1, l2)
        return a, h2(d2, l1, l2, a)

    return _made(shares=shares)


def _placed(place: Program) -> Formula:
    return _made(place=place)


def _picked(axis: int, sign: int) -> Formula:
    """The elbow with the greater (sign 1) or smaller coordinate for side +1."""

    def place(base: Any, tip: Any, a: Any, side: Any, h: Any, along: Any, across: Any) -> Floats:
        both = [base + a * along + s * h * across for s in (1, -1)]
        both.sort(key=lambda point: float(point[axis]))
        return np.asarray(both[-1 if side * sign > 0 else 0])

    return _placed(place)


def _eliminated(k: int, sign: float, own_side: bool) -> Formula:
    """The line solved for coordinate k, which is divided by the way along k; the side from the sign
    of the root, or right (own_side).
    """

    def place(base: Any, tip: Any, a: Any, side: Any, h: Any, along: Any, across: Any) -> Floats:
        if along[k] == 0:
            return np.array([np.nan, np.nan])
        s = side * np.sign(across[1 - k]) * sign if not own_side else side
        return np.asarray(base + a * along + s * h * across)

    return _placed(place)


def _turned(base: Any, tip: Any, a: Any, side: Any, h: Any, along: Any, across: Any) -> Floats:
    """With arctan of the quotient."""
    direction = np.arctan(np.divide(along[1], along[0])) - side * np.arctan2(h, a)
    length = np.hypot(*along) * np.hypot(a, h)
    return np.asarray(base + length * np.array([np.cos(direction), np.sin(direction)]))


def _polar(direction: Program) -> Formula:
    """By the length of link 1 and another direction(along, angle at the base, side)."""

    def place(base: Any, tip: Any, a: Any, side: Any, h: Any, along: Any, across: Any) -> Floats:
        length = np.hypot(*along) * np.hypot(a, h)
        q = direction(along, np.arctan2(h, a), side)
        return np.asarray(base + length * np.array([np.cos(q), np.sin(q)]))

    return _placed(place)


def _with_cosine(cosine: Program) -> Formula:
    """With another cosine of the angle at the base: of d, l1, l2."""

    def formula(base: Floats, tip: Floats, l1: float, l2: float, side: float) -> Any:
        dx, dy = tip - base
        d = math.hypot(dx, dy)
        c = cosine(d, l1, l2)

        def place(h: float) -> Floats:
            q = np.arctan2(dy, dx) - side * np.arctan2(h, c)
            return np.asarray(base + l1 * np.array([np.cos(q), np.sin(q)]))

        return 1 - c * c, place, d

    return formula


def _in_degrees(base: Any, tip: Any, a: Any, side: Any, h: Any, along: Any, across: Any) -> Floats:
    direction = (np.arctan2(along[1], along[0]) - side * np.arctan2(h, a)) / deg
    length = np.hypot(*along) * np.hypot(a, h)
    return np.asarray(base + length * np.array([np.cos(direction), np.sin(direction)]))


def _angles_of(base: Any, tip: Any, a: Any, side: Any, h: Any, along: Any, across: Any) -> Floats:
    elbow = base + a * along + side * h * across
    one, two = elbow - base, tip - elbow
    q1 = np.arctan2(one[1], one[0])
    q2 = np.remainder(np.arctan2(two[1], two[0]) - q1 + np.pi, 2 * np.pi) - np.pi
    return np.array([q1, q2])


def _lengths(d2: float, l1: float, l2: float) -> tuple[float, float]:
    d = math.sqrt(d2)
    a = _divided(d2 + l1**2 - l2**2, 2 * d)
    return a, l1**2 - a**2


def _h_length(d2: float, l1: float, l2: float) -> tuple[float, float]:
    a, h2 = _shares(d2, l1, l2)
    return a, h2 * d2


Parts: TypeAlias = tuple[str, str, Formula]
FORMULAS: tuple[Parts, ...] = (
    (
        "the sides exchanged",
        "Seen from the base towards the tip, right is (dy, \N{MINUS SIGN}dx), not "
        "(\N{MINUS SIGN}dy, dx).",
        _placed(lambda base, tip, a, side, h, u, v: base + a * u - side * h * v),
    ),
    (
        "side is not used",
        "You always give the right elbow: `side` = \N{MINUS SIGN}1 asks for the left one.",
        _placed(lambda base, tip, a, side, h, u, v: base + a * u + h * v),
    ),
    (
        "side is not used",
        "You always give the left elbow: `side` = +1 asks for the right one.",
        _placed(lambda base, tip, a, side, h, u, v: base + a * u - h * v),
    ),
    (
        "the base taken for the origin",
        "The way is from the base to the tip: subtract the base first, and add it at the end.",
        lambda base, tip, l1, l2, side: _general(0 * base, tip, l1, l2, side),
    ),
    (
        "the base not added at the end",
        "The result is counted from the base. The elbow's place is base + that.",
        _placed(lambda base, tip, a, side, h, u, v: a * u + side * h * v),
    ),
    (
        "the way counted from the origin",
        "dx and dy are tip minus base, not the tip itself.",
        _made(way=lambda base, tip: tip),
    ),
    (
        "the way from tip to base",
        "The way is base minus tip, the wrong way round: it is tip minus base.",
        _made(way=lambda base, tip: base - tip),
    ),
    (
        "equal links assumed",
        "a = 1/2 holds for two links of the same length only.",
        _with_a(lambda d2, l1, l2: 0.5),
    ),
    (
        "the links exchanged",
        "l1 belongs to the base, l2 to the tip; a counts from the base.",
        lambda base, tip, l1, l2, side: _general(base, tip, l2, l1, side),
    ),
    (
        "the sign of l2 squared",
        "In a the square of l2 is subtracted: of two links the longer one pushes the line away "
        "from its own end.",
        _with_a(lambda d2, l1, l2: _divided(d2 + l1**2 + l2**2, 2 * d2)),
    ),
    (
        "the signs of both squares",
        "l1 squared is added and l2 squared subtracted; you have it the other way round.",
        _with_a(lambda d2, l1, l2: _divided(d2 - l1**2 + l2**2, 2 * d2)),
    ),
    (
        "a factor of two in a",
        "a has 2 d\N{SUPERSCRIPT TWO} below the line: with equal links it has to be 1/2.",
        _with_a(lambda d2, l1, l2: _divided(d2 + l1**2 - l2**2, d2)),
    ),
    (
        "the ratio of the links for a",
        "With unequal links the line divides the way by l1 : l2 only where the arm is stretched.",
        _with_a(lambda d2, l1, l2: l1 / (l1 + l2)),
    ),
    (
        "lengths taken for shares",
        "a and h in metres have to be divided by d before they multiply dx and dy.",
        _made(shares=_lengths),
    ),
    (
        "h a length, a a share",
        "h multiplies dy and dx, so it is a share of d: l1\N{SUPERSCRIPT TWO} stands over "
        "d\N{SUPERSCRIPT TWO}.",
        _made(shares=_h_length),
    ),
    (
        "l1 squared not divided by d squared",
        "Under the root l1\N{SUPERSCRIPT TWO} / d\N{SUPERSCRIPT TWO}, minus a\N{SUPERSCRIPT TWO}.",
        _with_h(lambda d2, l1, l2, a: l1**2 - a**2),
    ),
    (
        "the square of l1 forgotten",
        "Under the root stands l1 squared, not l1.",
        _with_h(lambda d2, l1, l2, a: _divided(l1, d2) - a**2),
    ),
    (
        "the square of a forgotten",
        "Under the root a squared is subtracted, not a.",
        _with_h(lambda d2, l1, l2, a: _divided(l1**2, d2) - a),
    ),
    (
        "l2 under the root",
        "a counts from the base, and so the circle about the base gives h: l1, not l2.",
        _with_h(lambda d2, l1, l2, a: _divided(l2**2, d2) - a**2),
    ),
    (
        "the root forgotten",
        "h is the root of l1\N{SUPERSCRIPT TWO} / d\N{SUPERSCRIPT TWO} minus a\N{SUPERSCRIPT TWO}.",
        _placed(lambda base, tip, a, side, h, u, v: base + a * u + side * h * h * v),
    ),
    (
        "d for d squared",
        "d\N{SUPERSCRIPT TWO} is dx\N{SUPERSCRIPT TWO} + dy\N{SUPERSCRIPT TWO}, without a root.",
        _made(squared=lambda dx, dy: math.hypot(dx, dy)),
    ),
    (
        "across taken along",
        "h goes square to the way: its direction is (dy, \N{MINUS SIGN}dx).",
        _placed(lambda base, tip, a, side, h, u, v: base + a * u + side * h * u),
    ),
    (
        "a sign of the normal",
        "(dy, dx) is a mirror image of the way, not square to it: one sign changes, "
        "(dy, \N{MINUS SIGN}dx).",
        _placed(lambda base, tip, a, side, h, u, v: base + a * u + side * h * u[::-1]),
    ),
    (
        "the upper elbow for the right one",
        "Upper and lower are not right and left: the tip may be anywhere.",
        _picked(1, +1),
    ),
    (
        "the lower elbow for the right one",
        "Lower and upper are right and left only while the tip is to the right of the base.",
        _picked(1, -1),
    ),
    (
        "the elbow with the larger x for the right one",
        "Which elbow has the larger x depends on where the tip is: right is meant along the way.",
        _picked(0, +1),
    ),
    (
        "divides by dx",
        "The line is solved for x and divided by dx: straight above the base there is no answer. "
        "The arm has one; go along the way and across it.",
        _eliminated(0, 1, True),
    ),
    (
        "divides by dy",
        "The line is solved for y and divided by dy: level with the base there is no answer. The "
        "arm has one; go along the way and across it.",
        _eliminated(1, 1, True),
    ),
    (
        "divides by dx, and the side from the sign of the root",
        "Solved for x the line is divided by dx: no answer straight above the base, and to its "
        "right the two elbows are exchanged.",
        _eliminated(0, 1, False),
    ),
    (
        "divides by dx, and the side from the sign of the root",
        "Solved for x the line is divided by dx: no answer straight above the base, and to its "
        "left the two elbows are exchanged.",
        _eliminated(0, -1, False),
    ),
    (
        "divides by dy, and the side from the sign of the root",
        "Solved for y the line is divided by dy: no answer level with the base, and the two "
        "elbows are exchanged on one side of it.",
        _eliminated(1, 1, False),
    ),
    (
        "divides by dy, and the side from the sign of the root",
        "Solved for y the line is divided by dy: no answer level with the base, and the two "
        "elbows are exchanged on one side of it.",
        _eliminated(1, -1, False),
    ),
    (
        "arctan for arctan2",
        "arctan(dy / dx) knows half of the plane: to the left of the base the elbow is on the "
        "wrong side of it.",
        _placed(_turned),
    ),
    ("degrees for radians", "sin and cos want radians.", _placed(_in_degrees)),
    (
        "the arguments of arctan2 exchanged",
        "arctan2 takes the sine's side first: arctan2(dy, dx).",
        _polar(lambda u, angle, side: np.arctan2(u[0], u[1]) - side * angle),
    ),
    (
        "the direction of the way left out",
        "The angle at the base counts from the way to the tip, and that has a direction of its "
        "own: arctan2(dy, dx).",
        _polar(lambda u, angle, side: -side * angle),
    ),
    (
        "the wrong link in the law of cosines",
        "The angle at the base lies between link 1 and the way: its cosine is divided by 2 d l1.",
        _with_cosine(lambda d, l1, l2: (d * d + l1**2 - l2**2) / (2 * d * l2)),
    ),
    (
        "the angle at the elbow for the angle at the base",
        "This cosine, over 2 l1 l2, belongs to the corner at the elbow.",
        _with_cosine(lambda d, l1, l2: (l1**2 + l2**2 - d * d) / (2 * l1 * l2)),
    ),
    (
        "q2 for the angle at the base",
        "This is the cosine of q2. Wanted is the angle between the way and link 1.",
        _with_cosine(lambda d, l1, l2: (d * d - l1**2 - l2**2) / (2 * l1 * l2)),
    ),
    (
        "h left out",
        "This is the point on the way between the two elbows: go across, too, by h.",
        _placed(lambda base, tip, a, side, h, u, v: base + a * u + 0 * h * v),
    ),
    (
        "x and y exchanged",
        "The point is [x, y], in this order.",
        _placed(lambda base, tip, a, side, h, u, v: (base + a * u + side * h * v)[::-1]),
    ),
    (
        "the joint angles for the place",
        "These are q1 and q2. Asked is the place of the elbow, in metres.",
        _placed(_angles_of),
    ),
)
RIMS: tuple[tuple[str, str, Rim], ...] = (
    (
        "the stretched arm lost",
        "On the rim both elbows are one point, and h is 0. Rounding takes the tip past the rim, or "
        "what stands under the root below 0: allow for 1e-9 of the reach, and take max(..., 0).",
        _bare,
    ),
    (
        "an answer out of reach",
        "Where no elbow exists you invent one: compare the distance with l1 + l2 and with "
        "|l1 \N{MINUS SIGN} l2|, and return NaN.",
        _clipped,
    ),
    (
        "an error instead of NaN",
        "math.sqrt of a negative number raises an error. Where no elbow exists the answer is NaN, "
        "and on the rim rounding alone must not matter.",
        _raising,
    ),
)
MORE_RIMS: tuple[tuple[str, str, Rim], ...] = (
    (
        "an error out of reach",
        "Where no elbow exists the answer is NaN twice; no error is raised.",
        _refusing,
    ),
    (
        "the inner edge forgotten",
        "Nearer to the base than |l1 \N{MINUS SIGN} l2| there is no elbow either.",
        _outer,
    ),
    (
        "the inner edge forgotten, and the stretched arm lost",
        "Nearer to the base than |l1 \N{MINUS SIGN} l2| there is no elbow either. And on the outer "
        "edge allow for rounding, 1e-9 of the reach.",
        _outer_strict,
    ),
    ("the outer edge forgotten", "Farther than l1 + l2 there is no elbow.", _inner),
    (
        "the outer edge forgotten, and the folded arm lost",
        "Farther than l1 + l2 there is no elbow. And on the inner edge allow for rounding, 1e-9 of "
        "the reach.",
        _inner_strict,
    ),
    (
        "a margin inside the rim",
        "Tips that are 1 mm inside the rim are refused: room for rounding is 1e-9 of the reach.",
        _margin,
    ),
    (
        "np.isclose decides what is on the rim",
        "np.isclose allows for 1e-5 of the number: micrometres inside the rim there are two "
        "elbows, millimetres apart, and outside none. Allow for 1e-9 of the reach.",
        _about,
    ),
    *(
        (
            "a margin outside the rim",
            f"Tips that are {far} out of reach are accepted: room for rounding is 1e-9 of the "
            "reach.",
            _wide(slack),
        )
        for far, slack in (("2 mm", 0.01), ("3 micrometres", 1e-4), ("0.1 micrometres", 1e-6))
    ),
    (
        "the inner edge for a longer first link only",
        "The inner edge is |l1 − l2|, also where the second link is the longer one.",
        _inner_of(+1),
    ),
    (
        "the inner edge for a longer second link only",
        "The inner edge is |l1 − l2|, also where the first link is the longer one.",
        _inner_of(-1),
    ),
)
WHOLE = (
    "The elbow is written into an array of whole numbers, such as np.zeros_like(base) makes of a "
    "base (0, 0): what is behind the point is cut off. Ask for floats."
)
ROUNDED = "So few digits are too few: the elbow is off by more than a micrometre."


def _rounded(digits: int, rim: Rim) -> Program:
    def program(*case: Any) -> Floats:
        return np.asarray(_solved(_general, rim)(*case)).round(digits)

    return program


OTHER_ROOT = {  # what is under the root is negative elsewhere than where the tip is out of reach
    "equal links assumed",
    "the sign of l2 squared",
    "the signs of both squares",
    "a factor of two in a",
    "the ratio of the links for a",
    "l1 squared not divided by d squared",
    "the square of l1 forgotten",
    "the square of a forgotten",
    "l2 under the root",
    "d for d squared",
    "the wrong link in the law of cosines",
}
INDISTINCT = {  # the wrong root is of a negative number never, or always
    "the sign of l2 squared, and an error instead of NaN",
    "d for d squared, and an answer out of reach",
    "d for d squared, and an error instead of NaN",
}


def _elbow_mistakes() -> list[Mistake]:
    """Every wrong formula with a rim that is treated rightly or wrongly, and the right formula with
    every wrong rim.
    """
    found = [Mistake(name, says, _solved(f, _safe)) for name, says, f in FORMULAS]
    found += [Mistake(n, says, _solved(_general, rim)) for n, says, rim in (*RIMS, *MORE_RIMS)]
    found.append(Mistake("whole numbers for the elbow", WHOLE, _whole))
    found += [Mistake("rounded", ROUNDED, _rounded(digits, _safe)) for digits in (2, 3, 4)]
    for name, says, f in FORMULAS:
        lost, why, _ = RIMS[0]
        for also, more, rim in (*RIMS, (lost, why, _strict)):
            if rim is _strict and name not in OTHER_ROOT:
                continue
            both = f"{name}, and {also}"
            if both not in INDISTINCT:
                found.append(Mistake(both, f"{says} {more}", _solved(f, rim)))
    return found


# --- 2: a budget of operations --------------------------------------------------------------------

OUTPUTS = ("xr", "yr", "xl", "yl")
BUDGET = 23
NEARLY = 5 * mm  # a program whose elbows are off by less is told that it is nearly right
SIGNS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "**"}
TIPS = np.array([(0.9, 0.4), (-0.5, 0.8), (0.2, -0.9), (-0.7, -0.6), (0.1, 1.1), (1.1, -0.1)])


def given(who: Any) -> Numbers:
    """An arm of one's own: its base, and two lengths that differ."""
    roll = dice(LAB, who)
    x, y = (1 - 2 * roll.randrange(2)) * 0.05, (1 - 2 * roll.randrange(2)) * 0.05
    long, less = roll.randrange(60, 91, 5) / 100, roll.randrange(10, 31, 5) / 100
    l1, l2 = (long, long - less) if roll.randrange(2) else (long - less, long)
    numbers = {
        "base_x": round(x * roll.randrange(1, 5), 2),
        "base_y": round(y * roll.randrange(1, 5), 2),
        "l1": round(l1, 2),
        "l2": round(l2, 2),
        "budget": BUDGET,
    }
    units = {name: ("m", 1.0) for name in ("base_x", "base_y", "l1", "l2")}
    return Numbers(numbers, units | {"budget": ("operations", 1)})


def operations(program: str) -> int:
    """Each + - * / **, each root, each change of sign; the minus of a constant is none."""
    nodes = list(ast.walk(ast.parse(program)))
    signs = [node.operand for node in nodes if isinstance(node, ast.UnaryOp)]
    return sum(isinstance(node, (ast.BinOp, ast.Call)) for node in nodes) + sum(
        not isinstance(operand, ast.Constant) for operand in signs
    )


def _program_form(answer: Any, given: Any) -> str:
    if isinstance(answer, (list, tuple)) and all(isinstance(line, str) for line in answer):
        answer = "\n".join(answer)
    if not isinstance(answer, str):
        raise ValueError(
            f"wanted the text of a program, lines such as 'dx = x3 - 0.2', got {words(answer)}"
        )
    lines = "\n".join(line.strip() for line in answer.replace(";", "\n").splitlines())
    try:
        tree = ast.parse(lines)
    except (SyntaxError, ValueError) as error:
        raise ValueError(f"this is not Python: {error}") from None
    for node in tree.body:
        plain = isinstance(node, ast.Assign) and len(node.targets) == 1
        if not (plain and isinstance(node.targets[0], ast.Name)):  # type: ignore[attr-defined]
            raise ValueError(f"wanted lines `name = expression` only, got: {ast.unparse(node)}")
    _values(lines, (0.5, 0.6))
    missing = [name for name in OUTPUTS if not re.search(rf"^{name} *=", lines, re.M)]
    if missing:
        raise ValueError(f"the program never sets {', '.join(missing)}")
    return lines


def _values(program: str, tip: Sequence[float]) -> dict[str, float]:
    """All names after the program, run by hand: nothing but arithmetic and roots."""
    known = {"x3": float(tip[0]), "y3": float(tip[1])}

    def value(node: Any) -> float:
        if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
            return float(node.value)
        if isinstance(node, ast.Name):
            if node.id not in known:
                raise ValueError(f"{node.id} is used before it is set; x3 and y3 are given")
            return known[node.id]
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.UAdd)):
            return -value(node.operand) if isinstance(node.op, ast.USub) else value(node.operand)
        if isinstance(node, ast.BinOp) and type(node.op) in SIGNS:
            a, b = np.float64(value(node.left)), np.float64(value(node.right))
            with np.errstate(all="ignore"):
                results = {"+": a + b, "-": a - b, "*": a * b, "/": a / b, "**": a**b}
            return float(results[SIGNS[type(node.op)]])
        if isinstance(node, ast.Call) and len(node.args) == 1 and not node.keywords:
            if re.fullmatch(r"((math|np|numpy|sp)\.)?sqrt", ast.unparse(node.func)):
                with np.errstate(all="ignore"):
                    return float(np.sqrt(value(node.args[0])))
        raise ValueError(f"wanted + - * / ** and sqrt alone, got: {ast.unparse(node)}")

    for node in ast.parse(program).body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            known[node.targets[0].id] = value(node.value)
    return known


def _pair(base: Sequence[float], tip: Floats, l1: float, l2: float, side: int) -> Floats:
    h2, place, _ = _general(np.array(base), tip, l1, l2, side)
    elbow: Floats = place(_bare(h2, 0, 0, 0))
    return elbow


def _program_tips(given: Any) -> Floats:
    """Tips in reach, all round the base."""
    base, l1, l2 = (given["base_x"], given["base_y"]), given["l1"], given["l2"]
    low, high = abs(l1 - l2), l1 + l2
    shares = np.linspace(0.15, 0.9, len(TIPS))
    ways = TIPS / np.linalg.norm(TIPS, axis=-1, keepdims=True)
    tips: Floats = np.array(base) + (low + shares * (high - low))[:, None] * ways
    return tips


def _written(
    base: Sequence[float],
    tip: Floats,
    l1: float,
    l2: float,
    *,
    way: Program = lambda bx, by, x, y: (x - bx, y - by),
    square: Program = lambda dx, dy: dx * dx + dy * dy,
    K: Program = lambda l1, l2: (l1**2 - l2**2) / 2,
    share: Program = lambda K, d2: 0.5 + K / d2,
    L: Program = lambda l1, l2: l1**2,
    height: Program = lambda L, d2, a: np.sqrt(L / d2 - a * a),
    foot: Program = lambda bx, by, a, dx, dy: (bx + a * dx, by + a * dy),
    aside: Program = lambda h, dx, dy: (h * dy, h * dx),
    elbows: Program = lambda px, py, u, v: (px + u, py - v, px - u, py + v),
) -> Floats:
    """The short program, in whose place each step can be exchanged for a wrong one."""
    (bx, by), (x, y) = np.asarray(base, dtype=float), np.asarray(tip, dtype=float)
    with np.errstate(all="ignore"):
        dx, dy = way(bx, by, x, y)
        d2 = np.float64(square(dx, dy))
        a = share(K(l1, l2), d2)
        h = height(L(l1, l2), d2, a)
        found: Floats = np.array(elbows(*foot(bx, by, a, dx, dy), *aside(h, dx, dy)))
    return found


SHARE = "a = 0.5 + K / d2 with K = (l1² − l2²) / 2."
HEIGHT = "h = sqrt(l1² / d2 − a²), with d2 = dx² + dy²."
FOOT = "The foot is the base plus a times the way: px = base_x + a dx, py = base_y + a dy."
ASIDE = "Across the way is (dy, −dx): xr = px + h dy, yr = py − h dx; on the left all signs change."
# name, sentence, the step that is exchanged
SLIPS: tuple[tuple[str, str, dict[str, Program]], ...] = (
    ("K not halved", SHARE, {"K": lambda l1, l2: l1**2 - l2**2}),
    ("K halved twice", SHARE, {"K": lambda l1, l2: (l1**2 - l2**2) / 4}),
    ("the sign of K", SHARE, {"K": lambda l1, l2: (l2**2 - l1**2) / 2}),
    ("a sum of squares in K", SHARE, {"K": lambda l1, l2: (l1**2 + l2**2) / 2}),
    ("no squares in K", SHARE, {"K": lambda l1, l2: (l1 - l2) / 2}),
    ("the square of the difference in K", SHARE, {"K": lambda l1, l2: (l1 - l2) ** 2 / 2}),
    ("only l2² halved in K", SHARE, {"K": lambda l1, l2: l1**2 - l2**2 / 2}),
    ("0.5 left out of a", SHARE, {"share": lambda K, d2: K / d2}),
    ("1 for 0.5 in a", SHARE, {"share": lambda K, d2: 1 + K / d2}),
    ("0.5 divided by d2, too", SHARE, {"share": lambda K, d2: (0.5 + K) / d2}),
    ("K not divided by d2", SHARE, {"share": lambda K, d2: 0.5 + K}),
    ("K times d2", SHARE, {"share": lambda K, d2: 0.5 + K * d2}),
    ("K divided by d, not by d2", SHARE, {"share": lambda K, d2: 0.5 + K / np.sqrt(d2)}),
    ("a minus in a", SHARE, {"share": lambda K, d2: K / d2 - 0.5}),
    ("a not squared", HEIGHT, {"height": lambda L, d2, a: np.sqrt(L / d2 - a)}),
    ("2 a for a²", HEIGHT, {"height": lambda L, d2, a: np.sqrt(L / d2 - 2 * a)}),
    ("plus for minus under the root", HEIGHT, {"height": lambda L, d2, a: np.sqrt(L / d2 + a * a)}),
    ("a² − l1² / d2 under the root", HEIGHT, {"height": lambda L, d2, a: np.sqrt(a * a - L / d2)}),
    ("the root left out", HEIGHT, {"height": lambda L, d2, a: L / d2 - a * a}),
    ("l1² not divided by d2", HEIGHT, {"height": lambda L, d2, a: np.sqrt(L - a * a)}),
    ("a² divided by d2, too", HEIGHT, {"height": lambda L, d2, a: np.sqrt((L - a * a) / d2)}),
    ("l1² times d2", HEIGHT, {"height": lambda L, d2, a: np.sqrt(L * d2 - a * a)}),
    ("l1 for l1²", HEIGHT, {"L": lambda l1, l2: l1}),
    ("l2² for l1²", HEIGHT, {"L": lambda l1, l2: l2**2}),
    (
        "h in metres",
        "With this h the step aside needs a way of length 1: divide h by d. " + HEIGHT,
        {"height": lambda L, d2, a: np.sqrt(L - a * a * d2)},
    ),
    ("h halved", HEIGHT, {"height": lambda L, d2, a: np.sqrt(L / d2 - a * a) / 2}),
    ("h twice", HEIGHT, {"height": lambda L, d2, a: np.sqrt(L / d2 - a * a) * 2}),
    ("d for d2", HEIGHT, {"square": lambda dx, dy: np.hypot(dx, dy)}),
    ("minus for plus in d2", HEIGHT, {"square": lambda dx, dy: dx * dx - dy * dy}),
    ("the square of the sum for d2", HEIGHT, {"square": lambda dx, dy: (dx + dy) ** 2}),
    ("dx twice in d2", HEIGHT, {"square": lambda dx, dy: 2 * dx * dx}),
    ("dy twice in d2", HEIGHT, {"square": lambda dx, dy: 2 * dy * dy}),
    (
        "the way from the tip to the base",
        "dx = x3 − base_x and dy = y3 − base_y: the way goes from the base to the tip.",
        {"way": lambda bx, by, x, y: (bx - x, by - y)},
    ),
    (
        "the base added to the tip",
        "dx = x3 − base_x and dy = y3 − base_y. A base below 0 is taken away all the same.",
        {"way": lambda bx, by, x, y: (x + bx, y + by)},
    ),
    (
        "the base added to x3",
        "dx = x3 − base_x: a base below 0 is taken away all the same.",
        {"way": lambda bx, by, x, y: (x + bx, y - by)},
    ),
    (
        "the base added to y3",
        "dy = y3 − base_y: a base below 0 is taken away all the same.",
        {"way": lambda bx, by, x, y: (x - bx, y + by)},
    ),
    (
        "the base left out of dx and dy",
        "dx = x3 − base_x and dy = y3 − base_y.",
        {"way": lambda bx, by, x, y: (x, y)},
    ),
    ("the base left out of dx", "dx = x3 − base_x.", {"way": lambda bx, by, x, y: (x, y - by)}),
    ("the base left out of dy", "dy = y3 − base_y.", {"way": lambda bx, by, x, y: (x - bx, y)}),
    (
        "base_x and base_y exchanged",
        "dx = x3 − base_x and dy = y3 − base_y.",
        {"way": lambda bx, by, x, y: (x - by, y - bx)},
    ),
    ("1/2 for a in the foot", FOOT, {"foot": lambda bx, by, a, dx, dy: (bx + dx / 2, by + dy / 2)}),
    ("no a in the foot", FOOT, {"foot": lambda bx, by, a, dx, dy: (bx + dx, by + dy)}),
    (
        "the foot counted from the tip",
        FOOT,
        {"foot": lambda bx, by, a, dx, dy: (bx + dx + a * dx, by + dy + a * dy)},
    ),
    (
        "the foot on the other side of the base",
        FOOT,
        {"foot": lambda bx, by, a, dx, dy: (bx - a * dx, by - a * dy)},
    ),
    (
        "dx and dy exchanged in the foot",
        FOOT,
        {"foot": lambda bx, by, a, dx, dy: (bx + a * dy, by + a * dx)},
    ),
    ("dx for dy in the foot", FOOT, {"foot": lambda bx, by, a, dx, dy: (bx + a * dx, by + a * dx)}),
    ("aside along the way", ASIDE, {"aside": lambda h, dx, dy: (h * dx, h * dy)}),
    ("aside without the way", ASIDE, {"aside": lambda h, dx, dy: (h, h)}),
    ("both signs alike", ASIDE, {"elbows": lambda px, py, u, v: (px + u, py + v, px - u, py - v)}),
    ("the sign in xl", ASIDE, {"elbows": lambda px, py, u, v: (px + u, py - v, px + u, py + v)}),
    ("the sign in yl", ASIDE, {"elbows": lambda px, py, u, v: (px + u, py - v, px - u, py - v)}),
    ("the sign in xr", ASIDE, {"elbows": lambda px, py, u, v: (px - u, py - v, px - u, py + v)}),
    ("the sign in yr", ASIDE, {"elbows": lambda px, py, u, v: (px + u, py + v, px - u, py + v)}),
)


def _slip(given: Any, tips: Floats, found: Floats) -> tuple[str, str] | None:
    """Name and sentence of the slip in one step that gives these elbows; of two, if for these
    numbers two slips are one.
    """
    if not np.isfinite(found).any():
        return "NaN", "It gives NaN for every tip that was tried. In reach l1² / d2 is above a²."
    base, l1, l2 = (given["base_x"], given["base_y"]), given["l1"], given["l2"]
    fitting = [
        (name, says)
        for name, says, step in SLIPS
        for slipped in [np.array([_written(base, tip, l1, l2, **step) for tip in tips])]
        if np.allclose(found, slipped, rtol=0, atol=1e-6, equal_nan=True)
    ][:2]
    if not fitting:
        return None
    names, sentences = (list(dict.fromkeys(each)) for each in zip(*fitting, strict=True))
    return " or ".join(names), " Or: ".join(sentences)


def _program_faults(program: str, given: Any) -> list[tuple[str, str]]:
    tips = _program_tips(given)
    found = np.array([[_values(program, tip)[name] for name in OUTPUTS] for tip in tips])
    base, l1, l2 = (given["base_x"], given["base_y"]), given["l1"], given["l2"]

    def both(base: Sequence[float], l1: float, l2: float) -> Floats:
        pairs = [[_pair(base, tip, l1, l2, side) for side in (1, -1)] for tip in tips]
        return np.reshape(pairs, (len(tips), 4))

    def same(wanted: Floats) -> bool:
        return bool(np.allclose(found, wanted, rtol=0, atol=1e-6))

    right = both(base, l1, l2)
    faults: list[tuple[str, str]] = []
    known: tuple[tuple[str, str, Floats], ...] = (
        (
            "the sides exchanged",
            "xr, yr are the elbow on the right, seen from the base towards the tip.",
            right[:, [2, 3, 0, 1]],
        ),
        ("x and y exchanged", "xr is the x of the right elbow.", right[:, [1, 0, 3, 2]]),
        (
            "one elbow twice",
            "Both pairs are the right elbow: change the sign of h.",
            right[:, [0, 1, 0, 1]],
        ),
        (
            "one elbow twice",
            "Both pairs are the left elbow: change the sign of h.",
            right[:, [2, 3, 2, 3]],
        ),
        ("the base taken for the origin", "Your base is not the origin.", both((0, 0), l1, l2)),
        (
            "the base not added at the end",
            "The elbows are counted from your base: add it.",
            right - np.tile(base, 2),
        ),
        ("the links exchanged", "l1 is the link on the base.", both(base, l2, l1)),
        ("equal links assumed", "Your links differ: a is not 1/2.", both(base, l1, l1)),
        (
            "the lab's arm",
            "This is the arm of the lab, with its base and lengths: take your own.",
            both((0.2, -0.1), 1.0, 0.7),
        ),
    )
    named = next(((name, says) for name, says, wanted in known if same(wanted)), None)
    named = named or (None if same(right) else _slip(given, tips, found))
    most = float(abs(found - right).max())
    if not named and 1e-6 < most < NEARLY:
        says = f"Your elbows are off by up to {apart(most / mm, 0)[0]} mm; a micrometre is asked."
        named = "nearly right", says + " A constant with more digits is nearer."
    for k, name in ((0, "right"), (2, "left")):
        off = abs(found[:, k : k + 2] - right[:, k : k + 2]).max(axis=-1)
        if not (off <= 1e-6).all():
            n = int((~(off <= 1e-6)).argmax())
            at, is_at = apart(right[n, k : k + 2], found[n, k : k + 2], 3)
            says = (
                f"For the tip ({tips[n, 0]:.4g}, {tips[n, 1]:.4g}) the {name} elbow is at ({at}); "
                f"your program says ({is_at})."
            )
            why = f"{named[1]} " if named and not faults else ""
            faults.append((named[0] if named else f"another {name} elbow", why + says))
    count = operations(program)
    if count > given["budget"]:
        raw = count > 60
        says = f"It has {count} operations, and {given['budget']} are allowed. " + (
            "Take the common subexpressions out first."
            if raw
            else "What is computed twice? What is a constant of your arm?"
        )
        faults.append(("no temporaries" if raw else "too many operations", says))
    return faults


# --- 3: a test for generated code -----------------------------------------------------------------


def _both(*case: float, rim: Rim = _bare) -> tuple[float, ...]:
    x1, y1, x3, y3, l1, l2 = case
    base, tip = np.array([x1, y1], dtype=float), np.array([x3, y3], dtype=float)
    h2, _, d = _general(base, tip, l1, l2, 1)
    h = rim(h2, d, l1, l2)
    places = [_general(base, tip, l1, l2, side)[1](h) for side in (1, -1)]
    return tuple(float(x) for place in places for x in place)


def _by_angles(x1: Any, y1: Any, x3: Any, y3: Any, l1: Any, l2: Any) -> tuple[float, ...]:
    rows = two_link(l1, l2, (x1, y1))
    elbows = rows.frames(rows.ik((x3, y3)))[..., 1].translation[:, :2]
    return tuple(float(x) for x in elbows.ravel())


RIGHTS: tuple[tuple[str, Program], ...] = (
    ("along and across the way, as generated", _both),
    ("the same, which returns an array", lambda *case: np.array(_both(*case))),
    ("the same, which returns a list", lambda *case: list(_both(*case))),
    ("rounding on the rim mended", lambda *case: _both(*case, rim=_safe)),
    ("by angles, as two_link", _by_angles),
)


def _int(*case: float) -> tuple[float, ...]:
    """The squares cast to int."""
    x1, y1, x3, y3, l1, l2 = case
    dx, dy = x3 - x1, y3 - y1
    xx, yy, one, two = (float(int(v * v)) for v in (dx, dy, l1, l2))
    d2 = xx + yy
    a = _divided(d2 + one - two, 2 * d2)
    h = float(np.sqrt(_divided(one, d2) - a * a))
    return x1 + a * dx + h * dy, y1 + a * dy - h * dx, x1 + a * dx - h * dy, y1 + a * dy + h * dx


def _by_division(k: int, own_side: bool) -> Program:
    def program(*case: float) -> tuple[float, ...]:
        x1, y1, x3, y3, l1, l2 = case
        way = (x3 - x1, y3 - y1)[k]
        if way == 0:
            return (math.nan,) * 4
        both = _both(*case)
        other = not own_side and (way > 0) == (k == 1)
        return (*both[2:], *both[:2]) if other else both

    return program


def _changed(change: Program) -> Program:
    return lambda *case: _both(*change(*case))


def _single(*case: float) -> tuple[float, ...]:
    return tuple(float(np.float32(x)) for x in _both(*case))


def _missing(*case: float) -> tuple[float, ...]:
    x1, y1, x3, y3, l1, l2 = case
    d = math.hypot(x3 - x1, y3 - y1)
    return (math.nan,) * 4 if d > 0.98 * (l1 + l2) else _both(*case)


def _both_right(*case: float) -> tuple[float, ...]:
    both = _both(*case)
    return (*both[:2], *both[:2])


def _swapped(*case: float) -> tuple[float, ...]:
    both = _both(*case)
    return (*both[2:], *both[:2])


def _one_x(*case: float) -> tuple[float, ...]:
    """y divided by x3 - x1: right where that is 1."""
    x1, y1, x3, y3, l1, l2 = case
    xr, yr, xl, yl = _both(*case)
    return xr, y1 + _divided(yr - y1, x3 - x1), xl, y1 + _divided(yl - y1, x3 - x1)


def _half_missing(*case: float) -> tuple[float, ...]:
    both = _both(*case)
    return (both[0], case[1], both[2], case[1]) if math.isnan(both[1]) else both


def _half_angle(*case: float) -> tuple[float, ...]:
    x1, y1, x3, y3, l1, _ = case
    base, way = np.array([x1, y1]), np.array([x3 - x1, y3 - y1])
    both = np.reshape(_both(*case), (2, 2)) - base
    along = both / l1 + way / np.hypot(*way)  # halfway between the elbow and the way to the tip
    found = base + l1 * along / np.hypot(along[:, :1], along[:, 1:])
    return tuple(float(x) for x in found.ravel())


CATCH_MISTAKES = (
    Mistake(
        "both elbows are the right one",
        "Compare the two elbows: away from the rim they are two points, on either side of the way.",
        _both_right,
    ),
    Mistake(
        "right and left exchanged",
        "Both points are elbows: only the side tells. (tip \N{MINUS SIGN} base) x (elbow "
        "\N{MINUS SIGN} base) is negative on the right.",
        _swapped,
    ),
    Mistake(
        "in the order xr, xl, yr, yl",
        "Its second and third number are exchanged. Look at all four, in the order xr, yr, xl, yl.",
        lambda *case: tuple(np.array(_both(*case))[[0, 2, 1, 3]].tolist()),
    ),
    Mistake(
        "the links exchanged",
        "Test with lengths that differ, and measure to the base and to the tip.",
        _changed(lambda x1, y1, x3, y3, l1, l2: (x1, y1, x3, y3, l2, l1)),
    ),
    Mistake(
        "the second link taken for as long as the first",
        "Test with lengths that differ.",
        _changed(lambda x1, y1, x3, y3, l1, l2: (x1, y1, x3, y3, l1, l1)),
    ),
    Mistake(
        "the base taken for the origin",
        "Test with a base that is not (0, 0).",
        _changed(lambda x1, y1, x3, y3, l1, l2: (0, 0, x3, y3, l1, l2)),
    ),
    Mistake(
        "squares cast to int",
        "With whole numbers a cast cannot be seen: test with odd ones.",
        _int,
    ),
    Mistake(
        "divides by x3 \N{MINUS SIGN} x1",
        "A tip straight above the base gets NaN. A test finds that with such a tip, and with a "
        "comparison that NaN does not pass.",
        _by_division(0, True),
    ),
    Mistake(
        "divides by y3 \N{MINUS SIGN} y1",
        "A tip level with the base gets NaN. A test finds that with such a tip, and with a "
        "comparison that NaN does not pass.",
        _by_division(1, True),
    ),
    Mistake(
        "exchanges the elbows on one side of the base",
        "Put tips on both sides of the base, to the left and to the right, and look at the side of "
        "each elbow.",
        _by_division(0, False),
    ),
    Mistake(
        "y divided by a length too much",
        "It is right where x3 \N{MINUS SIGN} x1 is 1: test where no difference is 0 or 1.",
        _one_x,
    ),
    Mistake(
        "single precision",
        "It is off by about 1e-8 m: in double precision the distances hold within 1e-9 m.",
        _single,
    ),
    Mistake(
        "an answer out of reach: too far",
        "Put a tip beyond l1 + l2: there has to be NaN.",
        lambda *case: _both(*case, rim=_inner),
    ),
    Mistake(
        "an answer out of reach: too near",
        "Put a tip nearer than |l1 \N{MINUS SIGN} l2| to the base: there has to be NaN.",
        lambda *case: _both(*case, rim=_outer),
    ),
    Mistake(
        "out of reach NaN in x only",
        "Out of reach all four numbers have to be NaN: look at each of them.",
        _half_missing,
    ),
    Mistake(
        "half of the angle at the base",
        "Its points are l1 away from the base, and not l2 from the tip: measure both distances.",
        _half_angle,
    ),
    Mistake(
        "gives up near the rim",
        "Put a tip a few millimetres inside the rim: there is an answer.",
        _missing,
    ),
)

# --- Predictions: numbers and views ---------------------------------------------------------------

MINUS = str.maketrans("-", "\N{MINUS SIGN}")
LONG, SHORT = 1.0, 0.7  # m, the lab's arm


def _crossing() -> tuple[Floats, Floats]:
    """A tip that runs past the base: times, places."""
    t = np.linspace(0, 8, 1601)
    x = np.linspace(-2, 2, len(t))
    return t, np.stack([x, np.full(len(t), 0.2)], axis=-1)


@cache
def _touch_facts() -> Mapping[str, Any]:
    _, tips = _crossing()
    exists = np.isfinite(two_link(LONG, SHORT).ik(tips)).all(axis=(-1, -2))
    return {"times": int(np.count_nonzero(np.diff(exists.astype(int))))}


def _touch_view() -> Any:
    from ..show import animate

    arm = two_link(LONG, SHORT)
    t, tips = _crossing()
    rows = arm.ik(tips)
    touched = _touch_facts()["times"]
    return animate(
        arm,
        t,
        rows[:, 0],
        points={
            "tip": np.pad(tips, [(0, 0), (0, 1)]),
            "other elbow": arm.frames(rows[:, 1])[..., 1].translation,
        },
        title=f"Past the base at 0.2 m: {touched} times the elbows meet",
    )


NEAR = {"l1": 0.7, "l2": 1.0, "d": 0.5}


def _share_facts() -> Mapping[str, Any]:
    a, h2 = _shares(NEAR["d"] ** 2, NEAR["l1"], NEAR["l2"])
    ratio = NEAR["l1"] / (NEAR["l1"] + NEAR["l2"])
    share = f"a = {a:.2f}".translate(MINUS)
    return NEAR | {
        "a": share,
        "a_number": a,
        "h": math.sqrt(h2),
        "ratio": ratio * 100,
        "at": abs(a) * NEAR["d"],
    }


def _share_right(facts: Mapping[str, Any]) -> int:
    return 3 if facts["a_number"] < 0 else 2 if facts["a_number"] < 0.4 else 1


def _share_view() -> Any:
    from ..show import Sketch

    facts = _share_facts()
    elbows = [(facts["a_number"] * facts["d"], -side * facts["h"] * facts["d"]) for side in (1, -1)]
    sketch = Sketch(
        f"Both elbows of the folded arm: the line through them crosses the x axis at "
        f"{elbows[0][0]:.2f} m, behind the base.",
        title=f"The line of the elbows, {facts['at']:.2f} m behind the base",
        unit="m",
    )
    for elbow, dashed in zip(elbows, (False, True), strict=True):
        sketch.levers([(0, 0), elbow, (facts["d"], 0)], dashed=dashed)
    sketch.length(elbows[1], elbows[0])
    sketch.point((0, 0), "base", away=(1, 1))
    sketch.point((facts["d"], 0), "tip", away=(0, 1))
    sketch.ax.margins(0.3)
    return sketch


def _quadratic(x3: float, y3: float, k: int = 0) -> Floats:
    """The elbow by the quadratic formula for equal links of 1 m, coordinate k eliminated."""
    u, v = np.float64((x3, y3)[k]), np.float64((x3, y3)[1 - k])
    with np.errstate(all="ignore"):
        d2 = u * u + v * v
        other = (v * d2 + np.sqrt(u * u * d2 * (4 - d2))) / (2 * d2)
        gone = (d2 - 2 * v * other) / (2 * u)
    return np.array([gone, other] if k == 0 else [other, gone])


def _is_right(x3: float, y3: float, k: int) -> bool:
    elbow = _quadratic(x3, y3, k)
    return bool(x3 * elbow[1] - y3 * elbow[0] < 0)


QUADRANTS = {
    "right and above": (0.9, 0.7),
    "left and above": (-0.9, 0.7),
    "left and below": (-0.9, -0.7),
    "right and below": (0.9, -0.7),
}


def _axes_right(facts: Mapping[str, Any]) -> int:
    one, two, three, four = (_is_right(*tip, 1) for tip in QUADRANTS.values())
    over_x3, over_y3 = one != two or three != four, two != three or one != four
    return [(True, False), (False, True), (True, True), (False, False)].index((over_x3, over_y3))


def _axes_view() -> str:
    lines = ["Where is the elbow of the formula with the plus sign?"]
    for name, tip in QUADRANTS.items():
        sides = ["right" if _is_right(*tip, k) else "left" for k in (0, 1)]
        lines.append(
            f"tip to the {name}: {sides[0]} with x2 eliminated, {sides[1]} with y2 eliminated"
        )
    return "\n".join(lines)


def _tiny_right(facts: Mapping[str, Any]) -> int:
    elbow = _quadratic(1e-300, 1.0)
    if np.isnan(elbow).any():
        return 1
    return 0 if abs(np.hypot(*elbow) - 1) < 1e-9 else 2 if np.isfinite(elbow).all() else 3


def _tiny_facts() -> Mapping[str, Any]:
    x, y = _quadratic(1e-300, 1.0)
    return {"x": abs(x), "y": y, "off": float(np.hypot(x, y))}


def _expanded(x3: float, y3: float) -> Floats:
    """As `_quadratic`, as SymPy writes it in section 4: not factored under the root."""
    a, b = 4 * x3**2 + 4 * y3**2, -4 * x3**2 * y3 - 4 * y3**3
    c = -4 * x3**2 + x3**4 + 2 * x3**2 * y3**2 + y3**4
    y2 = (4 * x3**2 * y3 + 4 * y3**3 + math.sqrt(max(-4 * a * c + b**2, 0))) / (2 * a)
    return np.array([(x3**2 + y3**2 - 2 * y3 * y2) / 2 / x3, y2])


def _tiny_view() -> str:
    lines = [
        "Links of 1 m, tip at (x3, 1): how far is the computed elbow from the base? First by "
        "`elbow_by_root` of the first cell, then by `root_code` of section 4, the same formula "
        "with the root multiplied out."
    ]
    for x3 in (1e-3, 1e-6, 1e-9, 1e-12, 1e-300):
        factored, multiplied = (np.hypot(*rule(x3, 1.0)) for rule in (_quadratic, _expanded))
        lines.append(f"x3 = {x3:.0e} m: {factored:.6f} m, {multiplied:.6f} m")
    return "\n".join(lines).translate(MINUS)


GAP = 1e-3  # m inside the rim


def _rim_facts() -> Mapping[str, Any]:
    q1, q2 = two_link(1, 1).ik((2 - GAP, 0))[0]
    return {"q2": q2 / deg, "q1": abs(q1) / deg, "linear": GAP / deg, "half": GAP / 2 / deg}


def _rim_view() -> str:
    lines = ["Two links of 1 m, the tip inside the rim by"]
    for gap in (1e-1, 1e-2, 1e-3, 1e-4):
        _, q2 = two_link(1, 1).ik((2 - gap, 0))[0]
        lines.append(f"{gap * 1e3:g} mm: q2 = {q2 / deg:.2f}\N{DEGREE SIGN}")
    return "\n".join(lines)


@cache
def _count_facts() -> Mapping[str, Any]:
    sp: Any = importlib.import_module("sympy")
    x1, y1, x3, y3 = sp.symbols("x1 y1 x3 y3", real=True)
    l1, l2 = sp.symbols("l1 l2", positive=True)
    dx, dy = x3 - x1, y3 - y1
    d2 = dx**2 + dy**2
    a = (d2 + l1**2 - l2**2) / (2 * d2)
    h = sp.sqrt(l1**2 / d2 - a**2)
    right = [x1 + a * dx + h * dy, y1 + a * dy - h * dx]
    left = [x1 + a * dx - h * dy, y1 + a * dy + h * dx]
    facts = {}
    for name, elbows in (("both", right + left), ("one", right)):
        steps, rest = sp.cse(elbows, symbols=sp.numbered_symbols("t"))
        facts[f"{name}_plain"] = sum(operations(str(each)) for each in elbows)
        facts[name] = sum(operations(str(each)) for each in [*(s for _, s in steps), *rest])
    return facts | {
        "half": facts["both"] // 2,
        "quarter": facts["one_plain"] / 2,
        "saved": facts["both"] - facts["one"],
        "factor": facts["both_plain"] / facts["both"],
    }


def _count_right(facts: Mapping[str, Any]) -> int:
    wanted = [facts["half"], facts["one_plain"] / 2, facts["one"]]
    return next(k for k in (2, 0, 1) if abs(wanted[k] - facts["one"]) < 1)


def _count_view() -> str:
    f = _count_facts()
    return (
        f"Both elbows: {f['both_plain']} operations as written, {f['both']} with temporaries.\n"
        f"The right elbow alone: {f['one_plain']} as written, {f['one']} with temporaries."
    )


def _listing(x3: float, y3: float, length: float, cast: Callable[[float], float]) -> dict[str, Any]:
    """The program of section 7 and its temporaries, as C computes it."""
    with np.errstate(all="ignore"):
        t1, t3, t7 = (np.float64(cast(v * v)) for v in (x3, y3, length))
        t5 = np.float64(cast(t1 + t3))
        t11 = np.sqrt(t1 * t5 * (4 * t7 - t5))
        x2 = (t1 * t5 - y3 * t11) / x3 / t5 / 2
    return {"t1": t1, "t3": t3, "t5": t5, "t7": t7, "t11": t11, "x2": x2}


def _cast_facts() -> Mapping[str, Any]:
    right = _listing(0.5, 0.7, 1, float)["x2"]
    return {
        "right": right,
        "told": f"{right:.3f}".translate(MINUS),
        "t5": _listing(0.5, 0.7, 1, int)["t5"],
    }


def _cast_right(facts: Mapping[str, Any]) -> int:
    x2 = _listing(0.5, 0.7, 1, int)["x2"]
    if np.isnan(x2):
        return 2
    return 0 if abs(x2 - facts["right"]) < 1e-9 else 1


def _cast_view() -> str:
    lines = []
    for name, cast in (("with (int)", int), ("without", float)):
        values = _listing(0.5, 0.7, 1, cast).items()
        numbers = ", ".join(f"{key} = {value:.4g}" for key, value in values)
        lines.append(f"{name}: {numbers.replace('nan', 'NaN')}")
    return "\n".join(lines).translate(MINUS)


RIM_TURNS = np.linspace(-np.pi, np.pi, 721)


def _circle(distance: float, turns: Floats = RIM_TURNS) -> Floats:
    tips: Floats = distance * np.stack([np.cos(turns), np.sin(turns)], axis=-1)
    return tips


def _under_root(x: Floats, y: Floats) -> Floats:
    """h squared for tips beside the base at 0, as the program of section 7 computes it."""
    t1, t3, t4 = LONG**2, x * x, y * y
    t5, t6 = t3 + t4, 2 * t3 + 2 * t4
    t7 = -(SHORT**2) + t1 + t5
    h2: Floats = t1 / t5 - t7 * t7 / (t6 * t6)
    return h2


@cache
def _lost_facts() -> Mapping[str, Any]:
    # sums, products and quotients only: cos has another last digit on another machine
    u = np.arange(-360, 361) / 360
    x, y = 1.7 * (1 - u * u) / (1 + u * u), 1.7 * (2 * u) / (1 + u * u)
    h2 = _under_root(x, y)
    plain = (
        LONG**2 / (x * x + y * y)
        - (LONG**2 - SHORT**2 + x * x + y * y) ** 2 / (2 * x * x + 2 * y * y) ** 2
    )
    return {
        "count": len(h2),
        "lost": int((h2 < 0).sum()),
        "above": int((h2 > 0).sum()),
        "zero": int((h2 == 0).sum()),
        "plain": int((plain < 0).sum()),
        "most": float(abs(h2).max()),
        "share": 100 * float((h2 < 0).mean()),
    }


def _lost_right(facts: Mapping[str, Any]) -> int:
    share = facts["share"]
    return 0 if share == 0 else 1 if share < 5 else 2 if share < 70 else 3


def _lost_view() -> Any:
    from ..show import animate

    arm = two_link(LONG, SHORT)
    distances = np.array([1.6, 1.69, 1.7])
    t = np.linspace(0, 8, len(RIM_TURNS))
    made, ours = [], []
    for distance in distances:
        tips = _circle(float(distance), 0.9 * RIM_TURNS)  # q1 stays within its limits
        lost = _under_root(*tips.T) < 0
        # on a circle joint 1 alone turns: smooth where ik rounds
        first = arm.ik(tips[0])[arm.branch(+1)]
        ours.append(first + np.outer(0.9 * (RIM_TURNS - RIM_TURNS[0]), [1, 0]))
        made.append(np.where(lost[:, None], np.nan, ours[-1]))
    return animate(
        [arm, arm],
        t,
        [np.array(made), np.array(ours)],
        names=["generated code", "two_link"],
        slider=("distance, m", distances),
        title="Round the base: where the generated code has no answer",
    )


# --- The tables -----------------------------------------------------------------------------------

EXERCISES = {
    "1": Function(
        title="The elbow, wherever it is",
        task="The elbow where two circles meet, on the side asked for",
        objective=1,
        hints=(
            "Go along the way from base to tip and square to it: only the distance is divided by. "
            "Then ask when the circles do not meet, and what rounding does where they touch.",
            "a = (d2 + l1**2 - l2**2) / (2 * d2), h2 = l1**2 / d2 - a**2; the right elbow is base "
            "+ a * (dx, dy) + sqrt(h2) * (dy, -dx), the left one has the other sign.",
            "d = hypot(dx, dy); return NaN twice if d == 0, or if d is above l1 + l2 or below "
            "abs(l1 - l2) by more than 1e-9 * (l1 + l2). Else h = side * sqrt(max(h2, 0)).",
        ),
        inputs=("base", "tip", "l1", "l2", "side"),
        right=_elbow,
        cases=_elbow_cases,
        form=_point,
        law=_elbow_law,
        same=_same_point,
        mistakes=_elbow_mistakes(),
    ),
    "2": Value(
        title="A budget of operations",
        task="A program for both elbows of an arm of your own, within a budget of operations",
        objective=2,
        hints=(
            "Put your numbers into `general` with subs, and let `shortened` take out the common "
            "terms: that program is right, and too long. Print it line by line.",
            "Look for what is the same under another shape: 2*t1 + 2*t3 beside t1 + t3. And "
            "l1**2, l2**2 and their difference are constants of your arm: compute them once, on "
            "paper.",
            "a = 0.5 + K / d2 with the constant K = (l1**2 - l2**2) / 2, h = sqrt(L / d2 - a*a) "
            "with L = l1**2; then px = base_x + a*dx, py = base_y + a*dy, u = h*dy, v = h*dx, and "
            "xr = px + u, yr = py - v, xl = px - u, yl = py + v.",
        ),
        form=_program_form,
        faults=_program_faults,
        count=3,
        given=given,
    ),
    "3": Catch(
        title="A test for generated code",
        task="A test: whether the program elbows(x1, y1, x3, y3, l1, l2) finds both elbows",
        objective=3,
        hints=(
            "No reference is needed: an elbow is l1 from the base and l2 from the tip. Which "
            "inputs would make each division, each cast, each forgotten base show?",
            "Take an odd base, unequal odd lengths, and tips all round: also straight above and "
            "below the base, level with it on both sides, 5 mm inside the rim, beyond it, and too "
            "near. Measure to 1e-9 m, and look at the side of each elbow.",
            "for each tip: xr, yr, xl, yl = elbows(...). In reach: all finite, hypot(xr - x1, "
            "yr - y1) = l1 and hypot(xr - x3, yr - y3) = l2 within 1e-9, the same for xl, yl; "
            "(x3 - x1)*(yr - y1) - (y3 - y1)*(xr - x1) below 0, for the left one above. Out of "
            "reach: all four NaN.",
        ),
        rights=RIGHTS,
        promise="A right program holds both distances within 1e-9 m, gives the right elbow first, "
        "and NaN four times out of reach. Nearer than a millimetre to a rim, and with the tip on "
        "the base, it may give anything.",
        mistakes=CATCH_MISTAKES,
    ),
}

# Objective 1: p2, p3, p5. Objective 2: p6. Objective 3: p1, p4, p7, p8.
PREDICTIONS = {
    "p1": Prediction(
        question="Link 1 is 1 m long, link 2 0.7 m. The tip runs along a straight line from the "
        "far left to the far right, and passes the base at a distance of 0.2 m. How often do the "
        "two elbows become one?",
        options=(
            Option(
                "Never: there are always two.",
                "At the edge of the reach the arm is stretched, and both elbows are one point.",
                "the edge of the reach forgotten",
                "Stretch your own arm: the elbow has one place only.",
            ),
            Option(
                "Twice: where the tip enters the reach, and where it leaves.",
                "That is the outer edge. Nearer than 0.3 m to the base link 2, folded back, is too "
                "short: there is an edge inside as well.",
                "the inner edge forgotten",
                "Links of 1 m and 0.1 m: the tip is always 0.9 m or more away from the base.",
            ),
            Option(
                "Three times: entering, nearest to the base, leaving.",
                "At 0.2 m the circles do not meet at all. The line enters the hole and leaves it.",
                "touching taken for crossing",
                "A line at 0.3 m would touch the inner edge once.",
            ),
            Option(
                "Four times.",
                "Twice on the outer edge, {times} times in all: the line goes through the hole "
                "about the base, too, and at each edge the circles touch in one point.",
            ),
        ),
        facts=_touch_facts,
        right=lambda facts: {0: 0, 2: 1, 3: 2, 4: 3}[facts["times"]],
        view=_touch_view,
    ),
    "p2": Prediction(
        question="Link 1 is {l1} m, link 2 {l2} m, and the tip is {d} m from the base. The line "
        "through both elbows is square to the line from base to tip. Where does it cross it?",
        options=(
            Option(
                "At {ratio:.0f} % of the way, as link 1 is of the whole arm.",
                "So it is when the arm is stretched. Folded, the elbows stand elsewhere.",
                "the ratio of the links",
                "With equal links it is in the middle, however the arm is folded; but 0.7 and 1.0 "
                "are not equal.",
            ),
            Option(
                "In the middle.",
                "Only points in the middle are as far from the base as from the tip; the links "
                "differ.",
                "equal links assumed",
                "If link 2 were 0.3 m long, both elbows would be 0.3 m from the tip and 0.7 m "
                "from the base.",
            ),
            Option(
                "Between base and tip, nearer to the base.",
                "Nearer to the base it is, but not between them.",
                "an elbow above the way",
                "Put the tip on the base's edge of reach, 0.3 m away: the elbow lies behind the "
                "base.",
            ),
            Option(
                "Behind the base.",
                "At {a} of the way, {at:.2f} m behind the base: link 2 is so long that the "
                "elbow has to step back.",
            ),
        ),
        facts=_share_facts,
        right=_share_right,
        view=_share_view,
    ),
    "p3": Prediction(
        question="Now y2 is eliminated instead of x2, and the quadratic equation for x2 is solved, "
        "with the plus sign of the root. When the tip crosses which line does this formula go over "
        "to the other elbow?",
        options=(
            Option(
                "The line x3 = 0, as before.",
                "The line belongs to the division. Now the division is by y3.",
                "a property of the arm",
                "Turn the drawing by 90°: the arm is the same, the axes have changed places.",
            ),
            Option(
                "The line y3 = 0.",
                "The line equation is solved for y2 and divided by y3, and the root holds the "
                "square of y3: it grows like its absolute value.",
            ),
            Option(
                "Both lines.",
                "Only one unknown is eliminated, and only its coefficient is divided by.",
                "two divisions for one",
                "With x2 eliminated y3 may be 0, and nothing happens.",
            ),
            Option(
                "None: another order mends it.",
                "Another order moves the trouble to another line.",
                "luck taken for a mend",
                "A tip on the x axis is now a division by 0.",
            ),
        ),
        facts=lambda: {},
        right=_axes_right,
        view=_axes_view,
    ),
    "p4": Prediction(
        question="The links are 1 m long, the tip stands at (x3, 1 m), and x3 is 1e-300 m: not 0, "
        "but next to it. What does the quadratic formula return?",
        options=(
            Option(
                "The right elbow: x3 is not 0.",
                "The square of 1e-300 is 1e-600, and the smallest number of the machine is about "
                "5e-324: the square is 0, and so is the root.",
                "numbers of a machine taken for real numbers",
                "1e-200 * 1e-200 is 0 in every program with double precision.",
            ),
            Option(
                "NaN, as at x3 = 0.",
                "Zero over 2e-300 is 0, a number like any other.",
                "the harmless kind of failure expected",
                "0 / 1e-300 gives 0, only 0 / 0 gives NaN.",
            ),
            Option(
                "A point that is no elbow, without a warning.",
                "({x:.0f}, {y:.1f}) m: the elbow of a link of 1 m stands {off:.1f} m from the "
                "base. `elbow_by_root` and `root_code` both say so. On the way there the digits go "
                "one by one.",
            ),
            Option(
                "Infinity: something is divided by almost 0.",
                "What is divided is lost by rounding first, and is 0 then.",
                "only the divisor looked at",
                "x / x stays 1 however small x is.",
            ),
        ),
        facts=_tiny_facts,
        right=_tiny_right,
        view=_tiny_view,
    ),
    "p5": Prediction(
        question="Two links of 1 m each; the tip stands 1 mm inside the rim, 1.999 m from the "
        "base. How far is q2 from 0, where the arm is stretched?",
        options=(
            Option(
                "{q2:.3f}",
                "The distance is 2 cos(q2 / 2) m: near the rim it changes with the square of q2. "
                "One millimetre costs {q2:.1f}°, a hundredth of it still a tenth of that.",
            ),
            Option(
                "{q1:.3f}",
                "That is how far q1 turns. Joint 2 turns twice as far.",
                "q1 for q2",
                "With equal links q2 is always twice the angle between link 1 and the way.",
            ),
            Option(
                "{linear:.3f}",
                "That is 1 mm seen from 1 m, as if the tip moved across. It moves along, and along "
                "a stretched arm no joint moves it.",
                "in proportion to the distance",
                "Bend a stretched arm a little: the hand hardly comes nearer.",
            ),
            Option(
                "{half:.4f}",
                "That is 1 mm seen from 2 m, as if the tip moved across the stretched arm.",
                "in proportion to the whole arm",
                "On the rim the tip can move across at once, but not inwards.",
            ),
        ),
        facts=_rim_facts,
        right=lambda facts: 0,
        view=_rim_view,
        unit="°",
        within=0.05,
    ),
    "p6": Prediction(
        question="We need one elbow only, the right one. As written that halves the count, from "
        "{both_plain} operations to {one_plain}. With temporaries both elbows take {both}. How "
        "many does one elbow take?",
        options=(
            Option(
                "{half:.0f}: half as well.",
                "The two elbows share nearly everything: d, a, h and the products with them.",
                "nothing shared",
                "A second elbow is two additions with another sign.",
            ),
            Option(
                "{quarter:.0f}: temporaries halve the count.",
                "They do far better than that, because nearly everything occurs many times.",
                "a rule of thumb for the count",
                "For both elbows the count falls by a factor of {factor:.1f}, not of 2.",
            ),
            Option(
                "{one}: nearly as many.",
                "The left elbow costs {saved} more operations once the right one is known.",
            ),
        ),
        facts=_count_facts,
        right=_count_right,
        view=_count_view,
    ),
    "p7": Prediction(
        question="The program with (int) runs in C for links of 1 m and the tip at (0.5, 0.7) m. "
        "Without (int) x2 is {told} m. What is it with (int)?",
        options=(
            Option(
                "The same: the length is a whole number.",
                "The squares of 0.5 and 0.7 are none.",
                "whole lengths taken for whole squares",
                "A link of 1.5 m would have the square 2.25, too.",
            ),
            Option(
                "Off by some tenths.",
                "A cast does not round a little, it cuts off everything behind the point: 0.25 and "
                "0.49 become 0.",
                "a cast taken for rounding",
                "(int) 0.99 is 0.",
            ),
            Option(
                "NaN.",
                "x3*x3 and y3*y3 are cut to 0, so t5 is {t5:.0f}, and the last line divides 0 by "
                "it.",
            ),
            Option(
                "An error: the compiler refuses it.",
                "A cast is what the programmer wants: the compiler obeys.",
                "the compiler as a judge",
                "Most compilers do not even warn where a cast is written.",
            ),
        ),
        facts=_cast_facts,
        right=_cast_right,
        view=_cast_view,
    ),
    "p8": Prediction(
        question="The tip goes half round the base at 1.7 m: links of 1 m and 0.7 m are stretched "
        "all the way. We take {count} tips, 1.7 (1 − u²) / (1 + u²) m ahead and "
        "1.7 · 2u / (1 + u²) m to the left, with u of `np.arange(-360, 361) / 360`. For how many "
        "of them does the program of section 7, with its temporaries, have no answer?",
        options=(
            Option(
                "For none: 1.7 m is in reach.",
                "In exact numbers h is 0. In the machine's numbers h squared is up to {most:.1e} "
                "off 0, upwards or downwards.",
                "the border taken for inside",
                "0.1 + 0.2 is not 0.3 either.",
            ),
            Option(
                "For less than 5 in a hundred.",
                "Rounding is small, but it is there in most directions: h squared comes out below "
                "0 for {lost} of {count} tips, above 0 for {above}, and exactly 0 for {zero}.",
                "small errors taken for rare errors",
                "Toss a coin that is a millionth of a gram heavier on one side: heads still comes "
                "about every second time.",
            ),
            Option(
                "For a good part of them, between 5 and 70 in a hundred.",
                "Where rounding takes h squared below 0, the root is NaN: for {lost} of {count} "
                "tips. Last digits decide: the same formula without temporaries (section 2) has "
                "no answer for {plain}.",
            ),
            Option(
                "For all of them: the arm is singular there.",
                "A stretched arm exists; it has one elbow instead of two.",
                "singular taken for out of reach",
                "Your own arm can be stretched.",
            ),
        ),
        facts=_lost_facts,
        right=_lost_right,
        view=_lost_view,
    ),
}
