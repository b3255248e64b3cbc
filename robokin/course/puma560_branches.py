"""Lab 07, the PUMA 560 and its branches: its exercises and predictions.

The answers to each exercise come first, right and wrong, then the predictions' numbers and views;
the tables stand at the end.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from itertools import product
from typing import Any, TypeAlias

import numpy as np

from .._arrays import Floats
from ..arms import PUMA560, distance_from_singularity, follow, within
from ..motion import blend, differentiate, lin, quintic
from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, mm
from .exercises import Function, Value, words
from .mistakes import Mistake, Tools
from .predictions import Option, Prediction
from .told import apart, one_number
from .variants import Numbers, dice

LAB = "puma560_branches"
OBJECTIVES = (
    "name the posture of a PUMA 560 from its joint values, in flags and in VAL's words",
    "predict what a straight line past a singularity costs in joint speed, and find the flange "
    "speed that the joints allow",
    "choose the branch that carries a whole path, and its duration, from the angles followed to "
    "the end of the path",
)

X, Y, Z = np.eye(3)
LOW, HIGH = PUMA560.limits.T
# lengths of P. Corke's model, as in the lab's table
D3, UPPER, FORE = 150.05 * mm, 431.8 * mm, float(np.hypot(431.8, 20.3)) * mm
OFFSET = float(np.arctan2(431.8, 20.3))  # of the wrist centre seen from the elbow, at q3 = 0
REST = np.array([0, 90, -90, 0, 0, 0]) * deg
SLACK = 1e-9

Signs: TypeAlias = Callable[[Floats], Any]


# --- 1: the name of a posture ---------------------------------------------------------------------


def _bend(q: Floats) -> float:
    """Joint 3, counted from the stretched arm."""
    return float(q[2]) + OFFSET


def _ahead(q: Floats) -> float:
    """How far the wrist centre is ahead of axis 1, in the arm's plane."""
    return float(UPPER * np.cos(q[1]) + FORE * np.cos(q[1] + _bend(q)))


def _height(q: Floats) -> float:
    """The wrist centre above the shoulder."""
    return float(UPPER * np.sin(q[1]) + FORE * np.sin(q[1] + _bend(q)))


def _above_line(q: Floats) -> float:
    """The elbow above the line from shoulder to wrist, at the elbow's place."""
    return float(UPPER * (np.sin(q[1]) - np.cos(q[1]) * np.divide(_height(q), _ahead(q))))


def _named(righty: Any, above: Any, noflip: Any) -> str:
    return (
        f"{'RIGHTY' if righty else 'LEFTY'} {'ABOVE' if above else 'BELOW'} "
        f"{'NOFLIP' if noflip else 'FLIP'}"
    )


def _posture_name(tools: Tools, q: Floats) -> str:
    front = _ahead(q) > 0
    return _named(front, front != (np.sin(_bend(q)) > 0), q[4] > 0)


PAIRS = ({"RIGHTY", "LEFTY"}, {"ABOVE", "BELOW"}, {"FLIP", "NOFLIP"})


def _name_form(result: Any, case: tuple[Any, ...]) -> str:
    parts = [result] if isinstance(result, str) else result
    if not isinstance(parts, (list, tuple, set)) or not all(isinstance(x, str) for x in parts):
        raise ValueError(f'wanted three words, "RIGHTY ABOVE NOFLIP", got {words(result)}')
    found = re.findall(r"[A-Z]+", " ".join(parts).upper())
    chosen = [[word for word in found if word in pair] for pair in PAIRS]
    if len(found) != 3 or any(len(some) != 1 for some in chosen):
        raise ValueError(f"wanted one word of each pair, got {words(result)}")
    return " ".join(some[0] for some in chosen)


def _name_law(case: tuple[Any, ...], yours: str) -> str | None:
    (q,) = case
    right = _posture_name(Tools(), q)
    if yours == right:
        return None
    side = _ahead(q)
    rise = _above_line(q) * abs(side) / np.hypot(side, _height(q))  # square to the line
    return (
        f"should be {right}: the wrist centre is {abs(side) / mm:.0f} mm "
        f"{'ahead of' if side > 0 else 'behind'} axis 1, the elbow {abs(rise) / mm:.0f} mm "
        f"{'above' if rise > 0 else 'below'} the line from shoulder to wrist centre, and q5 is "
        f"{q[4] / deg:.0f}°"
    )


def _name_cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    simple = [
        [0, 60, -170, 0, 40, 0],
        [0, 60, -170, 0, -40, 0],
        [0, 120, -10, 0, 40, 0],
        [120, 60, -170, 0, 40, 0],
        [0, 30, 20, 0, 40, 0],
        [0, 150, -170, 0, 40, 0],
        [0, -30, 30, 120, 40, 200],
        [0, 60, -88.5, 0, 40, 0],  # between -90 and the stretched arm
        [0, 150, -88.5, 0, -40, 0],
        [0, 200, -60, 0, 40, 0],
        [0, 45, -224, 0, 40, 0],
        [0, 100, -75.5, 30, 20, 0],  # the wrist centre a few mm from the axis
        [0, 135, -180.5, 30, 20, 0],
        [0, 81.08, -71.08, 0, 40, 0],  # 12 mm ahead of the axis, and without a3 behind it
        [0, 60, -86, 0, 40, 0],  # between the stretched arm and -85
        [0, 150, -86, 0, -40, 0],
    ]
    cases = [(np.array(q) * deg,) for q in simple]
    while len(cases) < 40:
        q = rng.uniform(LOW, HIGH).round(2)
        clear = abs(_ahead(q)) > 10 * mm and abs(np.sin(_bend(q))) > 0.02 and abs(q[4]) > 0.05
        if clear and abs(_above_line(q)) > 2 * mm:
            cases.append((q,))
    return cases


def _above_line_in_x(q: Floats) -> float:
    """As _above_line, with x of the base for the distance in the arm's plane."""
    _, shoulder, elbow, *_, wrist = PUMA560.frames(q).translation
    (x, _, z), (far, _, high) = elbow - shoulder, wrist - shoulder
    return float(z - high * np.divide(x, far))


def _without_a3(q: Floats) -> float:
    return float(UPPER * np.cos(q[1]) - 431.8 * mm * np.sin(q[1] + q[2]))


# name, sentence, posture -> whether the arm is a right one
SIDES: tuple[tuple[str, str, Signs], ...] = (
    ("", "", lambda q: _ahead(q) > 0),
    (
        "RIGHTY and LEFTY exchanged",
        "RIGHTY is front = +1: the wrist centre is ahead of axis 1.",
        lambda q: _ahead(q) < 0,
    ),
    (
        "ahead taken from joint 1",
        "Joint 1 turns the whole arm, shoulder and wrist together: it does not tell which of them "
        "is ahead.",
        lambda q: np.cos(q[0]) > 0,
    ),
    (
        "the side of the base for the side of the arm",
        "The x of the wrist centre is seen from the base. Ahead is meant as the arm sees it, in "
        "its own plane: without joint 1.",
        lambda q: PUMA560.fk(q).translation[0] > 0,
    ),
    (
        "the upper arm for the wrist",
        "The cosine of q2 tells where the elbow is. The forearm may reach back beyond axis 1.",
        lambda q: np.cos(q[1]) > 0,
    ),
    (
        "the forearm's zero direction",
        "At q3 = 0 the forearm stands square to the upper arm, not along it: its direction is "
        "q2 + q3 + 87.3°.",
        lambda q: UPPER * np.cos(q[1]) + FORE * np.cos(q[1] + q[2]) > 0,
    ),
    (
        "a3 is left out",
        "The forearm is 431.8 mm long and 20.3 mm beside the elbow (a3): near axis 1 that decides.",
        lambda q: _without_a3(q) > 0,
    ),
    (
        "the side of the base for the side of the arm",
        "The y of the wrist centre is seen from the base, and joint 1 changes it. RIGHTY asks "
        "whether the wrist centre is ahead of the shoulder in the arm's own plane.",
        lambda q: PUMA560.fk(q).translation[1] < 0,
    ),
    (
        "the forearm's share with the wrong sign",
        "At q3 = 0 the forearm points up: its share of r is −431.8 mm · sin(q2 + q3) (and 20.3 mm "
        "· cos of it).",
        lambda q: UPPER * np.cos(q[1]) + FORE * np.sin(q[1] + q[2]) > 0,
    ),
    (
        "the forearm for the whole arm",
        "The forearm may point back while the wrist centre is still ahead of axis 1: the upper "
        "arm's share counts, too.",
        lambda q: np.cos(q[1] + _bend(q)) > 0,
    ),
    (
        "the forearm's angle without q2",
        "Joint 2 carries the forearm along: its direction is q2 + q3 + 87.3°.",
        lambda q: UPPER * np.cos(q[1]) + FORE * np.cos(_bend(q)) > 0,
    ),
    ("always RIGHTY", "Every posture is called RIGHTY.", lambda q: True),
)
# whether the elbow's flag is +1
ELBOWS: tuple[tuple[str, str, Signs], ...] = (
    ("", "", lambda q: np.sin(_bend(q)) > 0),
    (
        "the stretched arm at q3 = 0",
        "The arm is stretched at q3 = −87.3°, not at 0: the sign of the bend is that of sin(q3 + "
        "87.3°).",
        lambda q: q[2] > 0,
    ),
    (
        "the stretched arm at q3 = 0",
        "The arm is stretched at q3 = −87.3°, not at 0: the sign of the bend is that of sin(q3 + "
        "87.3°), not of sin(q3).",
        lambda q: np.sin(q[2]) > 0,
    ),
    (
        "the stretched arm at q3 = −90°",
        "The arm is stretched at q3 = −87.3°, where the wrist centre is in line with both: a3 is "
        "20.3 mm.",
        lambda q: -90 * deg < q[2] < 90 * deg,
    ),
    (
        "the cosine of the bend",
        "The cosine tells how far the arm is stretched. To which side it bends tells the sine.",
        lambda q: np.cos(_bend(q)) > 0,
    ),
    (
        "the sign of joint 2",
        "Joint 2 swings the whole arm up and down. The elbow's flag belongs to the bend at joint "
        "3.",
        lambda q: q[1] > 0,
    ),
)
# whether the elbow is above, where it is not made of the two flags
HEIGHTS: tuple[tuple[str, str, Signs], ...] = (
    (
        "higher than the wrist",
        "ABOVE is meant against the line from shoulder to wrist, not against the wrist alone.",
        lambda q: UPPER * np.sin(q[1]) > _height(q),
    ),
    (
        "higher than the shoulder",
        "ABOVE is meant against the line from shoulder to wrist, not against the shoulder.",
        lambda q: np.sin(q[1]) > 0,
    ),
    (
        "higher than both, shoulder and wrist",
        "ABOVE is meant against the line from shoulder to wrist. The elbow may be above it and "
        "lower than one of its ends.",
        lambda q: UPPER * np.sin(q[1]) > max(0.0, _height(q)),
    ),
    (
        "the line seen from the base",
        "The line is taken over x of the base. Joint 1 turns the arm's plane away from x: take the "
        "distance along that plane.",
        lambda q: _above_line_in_x(q) > 0,
    ),
)
WRISTS: tuple[tuple[str, str, Signs], ...] = (
    ("", "", lambda q: q[4] > 0),
    ("FLIP and NOFLIP exchanged", "NOFLIP is a positive joint 5.", lambda q: q[4] < 0),
    (
        "the flip taken from joint 4",
        "Twins differ by 180° in joint 4, but which of the two is flipped tells the sign of "
        "joint 5.",
        lambda q: abs(q[3]) < 90 * deg,
    ),
    ("the sign of joint 4", "FLIP and NOFLIP tell the sign of joint 5.", lambda q: q[3] > 0),
    ("the sign of joint 6", "FLIP and NOFLIP tell the sign of joint 5.", lambda q: q[5] > 0),
    (
        "the cosine of joint 5",
        "The cosine tells how far the wrist is bent. To which side tells the sign of joint 5.",
        lambda q: np.cos(q[4]) > 0,
    ),
    ("always NOFLIP", "Every posture is called NOFLIP.", lambda q: True),
)
# a wrong bend, which goes into the side, too
BENDS: tuple[tuple[str, str, Signs], ...] = (
    (
        "q3 for the bend",
        "The bend is counted from the stretched arm: gamma = q3 + atan2(431.8, 20.3), which is q3 "
        "+ 87.3°.",
        lambda q: q[2],
    ),
    (
        "the arguments of atan2 exchanged",
        "It is atan2(d4, a3) = 87.3°: the long d4 first.",
        lambda q: q[2] + np.pi / 2 - OFFSET,
    ),
    (
        "the offset of the bend subtracted",
        "At q3 = −87.3° the arm is stretched: 87.3° is added to q3.",
        lambda q: q[2] - OFFSET,
    ),
    (
        "a3 is left out",
        "The bend is q3 + 87.3°, not q3 + 90°: the wrist centre is 20.3 mm beside the forearm's "
        "zero line (a3).",
        lambda q: q[2] + np.pi / 2,
    ),
)
# (right arm, elbow's flag) -> above
PRODUCTS: tuple[tuple[str, str, Callable[[bool, bool], bool]], ...] = (
    ("", "", lambda front, elbow: front != elbow),
    (
        "the elbow's flag alone, −1 for ABOVE",
        "ABOVE needs both flags: a left arm is a right arm turned over, and then the same bend "
        "points the other way.",
        lambda front, elbow: not elbow,
    ),
    (
        "the elbow's flag alone, +1 for ABOVE",
        "ABOVE needs both flags: it is front · elbow = −1.",
        lambda front, elbow: elbow,
    ),
    (
        "ABOVE and BELOW exchanged",
        "ABOVE is front · elbow = −1: at front = +1 the elbow's flag is −1.",
        lambda front, elbow: front == elbow,
    ),
)


# those that are made together
USUAL = {
    "ahead taken from joint 1",
    "the side of the base for the side of the arm",
    "the upper arm for the wrist",
    "the stretched arm at q3 = 0",
    "the stretched arm at q3 = −90°",
    "the elbow's flag alone, −1 for ABOVE",
    "the elbow's flag alone, +1 for ABOVE",
    "RIGHTY and LEFTY exchanged",
    "ABOVE and BELOW exchanged",
    "FLIP and NOFLIP exchanged",
    "the sign of joint 4",
    "the sign of joint 6",
    "q3 for the bend",
    "higher than the wrist",
}
NAIVE = {
    "ahead taken from joint 1",
    "the stretched arm at q3 = 0",
    "the elbow's flag alone, −1 for ABOVE",
}


def _row_as_it_is(order: float) -> Callable[[Floats], str]:
    """The row at the least distance, in the norm of this order."""

    def name(q: Floats) -> str:
        miss = np.linalg.norm(PUMA560.ik(PUMA560.fk(q)) - q, ord=order, axis=-1)
        front, elbow, wrist = PUMA560.branches[int(miss.argmin())]
        return _named(front > 0, front * elbow < 0, wrist > 0)

    return name


def _bent(bend: Signs, rule: Any, wrist: Signs) -> Callable[[Floats], str]:
    """With another bend in both flags."""

    def name(q: Floats) -> str:
        gamma = float(bend(q))
        front = bool(UPPER * np.cos(q[1]) + FORE * np.cos(q[1] + gamma) > 0)
        return _named(front, rule[2](front, bool(np.sin(gamma) > 0)), wrist(q))

    return name


def _flagged(side: Any, elbow: Any, rule: Any, wrist: Any) -> Callable[[Floats], str]:
    """ABOVE made of the two flags."""

    def name(q: Floats) -> str:
        front = bool(side[2](q))
        return _named(front, rule[2](front, bool(elbow[2](q))), wrist[2](q))

    return name


def _seen(side: Signs, height: Signs, wrist: Signs) -> Callable[[Floats], str]:
    """ABOVE made of heights."""
    return lambda q: _named(side(q), height(q), wrist(q))


def _name_mistakes() -> list[Mistake]:
    """One thing wrong or two; a wrong side goes into ABOVE, too, or does not."""
    made: list[Mistake] = []

    def add(named: Sequence[tuple[str, str]], program: Callable[[Floats], str]) -> None:
        names = [name for name, _ in named if name]
        together = {2: USUAL, 3: NAIVE}.get(len(names), set())
        if len(names) == 1 or (names and set(names) <= together):
            says = " ".join(sentence for _, sentence in named if sentence)
            made.append(Mistake(" and ".join(names), says, program))

    for side, elbow, rule, wrist in product(SIDES, ELBOWS, PRODUCTS, WRISTS):
        add([part[:2] for part in (side, elbow, rule, wrist)], _flagged(side, elbow, rule, wrist))
    for bend, rule, wrist in product(BENDS, PRODUCTS, WRISTS):
        add([bend[:2], rule[:2], wrist[:2]], _bent(bend[2], rule, wrist[2]))
    turns = (
        "whole turns in the comparison of rows",
        "A row of ik and q may differ by a whole turn of a joint and be one posture: compare the "
        "angles modulo 360°.",
    )
    for order in (1, 2, np.inf):
        add([turns], _row_as_it_is(order))
    for side, wrist in product(SIDES[1:], WRISTS):
        add([side[:2], wrist[:2]], _seen(side[2], lambda q: _above_line(q) > 0, wrist[2]))
    for side, height, wrist in product(SIDES, HEIGHTS, WRISTS):
        add([side[:2], height[:2], wrist[:2]], _seen(side[2], height[2], wrist[2]))
    return made


@cache
def _told_apart() -> tuple[Mistake, ...]:
    """Of mistakes that no case tells apart, or from the right program, the first."""
    cases = [q for (q,) in _name_cases(np.random.default_rng(140))]
    seen = {tuple(_posture_name(Tools(), q) for q in cases)}
    kept = []
    for mistake in sorted(_name_mistakes(), key=lambda m: " and " in m.name):
        answers = tuple(mistake.program(q) for q in cases)
        if answers not in seen:
            seen.add(answers)
            kept.append(mistake)
    return tuple(kept)


# --- 2: the speed that the joints allow -----------------------------------------------------------


def _unit(direction: Floats) -> Floats:
    unit: Floats = direction / float(np.linalg.norm(direction))
    return unit


def _rates(q: Floats, direction: Floats) -> Floats:
    """Joint speeds for 1 m/s along the direction without a turn, rad/s."""
    return _solved(PUMA560.jacobian(q), _unit(direction), np.zeros(3))


def _flange_speed(tools: Tools, q: Floats, direction: Floats, most: Floats) -> float:
    return float(1 / np.max(abs(_rates(q, direction)) / most))  # a joint may stand still


def _speed_cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    even = np.full(6, 100.0) * deg
    uneven = np.array([80, 60, 100, 150, 120, 200]) * deg
    stand = np.array([0, 60, -170, 0, 40, 0]) * deg
    turned = np.array([20, 50, -150, 30, 40, -10]) * deg
    near = np.array([0, 60, -170, 30, 3, 0]) * deg
    cases: list[tuple[Any, ...]] = [
        (stand, X, even),  # joints 1, 4 and 6 stand still
        (stand, Y, even),
        (turned, X, even),
        (turned, -Z, uneven),
        (turned, 3 * Y, uneven),
        (near, Y, uneven),
        (near, np.array([1.0, -2.0, 2.0]), uneven),
    ]
    while len(cases) < 30:
        q = rng.uniform(LOW, HIGH).round(3)
        if distance_from_singularity(PUMA560, q) > 0.02:
            direction = (rng.normal(size=3) * rng.choice([0.2, 1, 5])).round(3)
            cases.append((q, direction, (rng.integers(5, 26, 6) * 10 * deg).astype(float)))
    return cases


def _speed_form(result: Any, case: tuple[Any, ...]) -> float:
    try:
        return one_number(result)
    except (TypeError, ValueError):
        raise ValueError(f"wanted one number, a speed in m/s, got {words(result)}") from None


def _speed_law(case: tuple[Any, ...], yours: float) -> str | None:
    q, direction, most = case
    wanted = _flange_speed(Tools(), *case)
    if abs(yours - wanted) <= 2e-3 * wanted:
        return None
    share = abs(_rates(q, direction)) * wanted / most
    joint = int(share.argmax())
    should, is_at = apart(wanted, yours, 4)
    says = f"should be {should} m/s: joint {joint + 1} then turns with its most"
    if not np.isfinite(yours) or yours <= 0:
        return says
    if yours > 100 * wanted:
        return f"{says}; {is_at} m/s is far too fast"
    used = apart(100 * yours / wanted, 100, 0)[0]  # all joints in proportion
    return f"{says}; at {is_at} m/s it turns with {used} % of it"


def _same_speed(a: float, b: float) -> bool:
    both = a == b or (np.isnan(a) and np.isnan(b))
    return bool(both or abs(a - b) <= 1e-6 * abs(b))


def _with_rates(made: Callable[..., Floats]) -> Callable[..., float]:
    """Everything else right, with other joint speeds for 1 m/s."""
    return lambda q, direction, most: float(np.min(most / abs(made(q, direction))))


def _scaled(q: Floats, direction: Floats) -> Floats:
    jacobian = PUMA560.jacobian(q)
    jacobian[:3] /= PUMA560.reach
    return _solved(jacobian, _unit(direction), np.zeros(3))


def _solved(matrix: Floats, *parts: Floats) -> Floats:
    rates: Floats = np.asarray(np.linalg.solve(matrix, np.concatenate(parts)), float)
    return rates


def _twist(direction: Floats) -> Floats:
    return np.append(_unit(direction), np.zeros(3))


def _sigma(q: Floats) -> float:
    return float(distance_from_singularity(PUMA560, q))


WORST = (
    "The smallest singular value is the price of the worst direction. Asked is this direction: "
    "solve J for the joint speeds."
)
SPEED_MISTAKES = (
    Mistake(
        "the most patient joint decides",
        "This is the speed at which the last joint comes to its most: all others are past theirs. "
        "The first one decides, the least of the quotients.",
        lambda q, d, most: np.max(most / abs(_rates(q, d))),
    ),
    Mistake(
        "signs of the joint speeds",
        "A joint may turn either way: compare the absolute value of its speed with its most.",
        lambda q, d, most: np.min(most / _rates(q, d)),
    ),
    Mistake(
        "only joints that turn in the positive direction",
        "A joint that turns in the negative direction has the same most: take absolute values.",
        lambda q, d, most: 1 / np.max(_rates(q, d) / most),
    ),
    Mistake(
        "direction not of length 1",
        "Only the direction counts, not its length: divide it by np.linalg.norm(direction).",
        lambda q, d, most: _flange_speed(Tools(), q, d, most) / np.linalg.norm(d),
    ),
    Mistake(
        "divided by the length twice",
        "The direction's length comes in twice: a unit vector, or a division, not both.",
        lambda q, d, most: _flange_speed(Tools(), q, d, most) / np.linalg.norm(d) ** 2,
    ),
    Mistake(
        "a wrong length of the direction",
        "The length of a vector is the root of the sum of squares, not its largest component.",
        lambda q, d, most: _flange_speed(Tools(), q, d, most) / np.linalg.norm(d) * max(abs(d)),
    ),
    Mistake(
        "a wrong length of the direction",
        "The length of a vector is the root of the sum of squares, not the sum of squares.",
        lambda q, d, most: _flange_speed(Tools(), q, d, most) * np.linalg.norm(d),
    ),
    Mistake(
        "a wrong length of the direction",
        "The length of a vector is the root of the sum of squares, not the sum of its components.",
        lambda q, d, most: _flange_speed(Tools(), q, d, most) / np.linalg.norm(d) * np.sum(abs(d)),
    ),
    Mistake("the worst direction", WORST, lambda q, d, most: _sigma(q) * PUMA560.reach * min(most)),
    Mistake(
        "the worst direction",
        WORST + " (And a length in reaches is no length in metres.)",
        lambda q, d, most: _sigma(q) * min(most),
    ),
    Mistake(
        "the worst direction",
        WORST,
        lambda q, d, most: _sigma(q) * PUMA560.reach * np.linalg.norm(most),
    ),
    Mistake(
        "the tool may turn",
        "Joints 1 to 3 alone decide here: they carry the flange along, and the tool would turn "
        "with them. Joints 4 to 6 have to hold it, and one of them may be at its limit first: all "
        "six rows of J, with zeros for the angular velocity, and all six joints.",
        lambda q, d, most: np.min((most / abs(_rates(q, d)))[:3]),
    ),
    Mistake(
        "only the wrist",
        "Joints 1 to 3 have limits, too.",
        lambda q, d, most: np.min((most / abs(_rates(q, d)))[3:]),
    ),
    Mistake(
        "forward for inverse",
        "J times something gives the velocity of the flange. The joint speeds are the unknown: "
        "np.linalg.solve(J, twist).",
        _with_rates(lambda q, d: PUMA560.jacobian(q) @ _twist(d)),
    ),
    Mistake(
        "forward for inverse",
        "J times the greatest joint speeds is the velocity with all joints at their most; a part "
        "of it along the direction is another motion. The joint speeds are the unknown: solve.",
        lambda q, d, most: abs((PUMA560.jacobian(q) @ most)[:3] @ _unit(d)),
    ),
    Mistake(
        "forward for inverse",
        "J times the greatest joint speeds is the velocity with all joints at their most, in "
        "another direction. The joint speeds are the unknown: solve.",
        lambda q, d, most: np.linalg.norm((PUMA560.jacobian(q) @ most)[:3]),
    ),
    Mistake(
        "forward for inverse",
        "These are all joints at their most, each turning so that it helps: the flange is carried "
        "aside and turned, too. The joint speeds are the unknown: solve.",
        lambda q, d, most: abs(PUMA560.jacobian(q)[:3].T @ _unit(d)) @ most,
    ),
    Mistake(
        "forward for inverse",
        "These are all joints at their most, added up axis by axis of the base: another motion. "
        "The joint speeds are the unknown: solve.",
        lambda q, d, most: abs(PUMA560.jacobian(q)[:3]) @ most @ abs(_unit(d)),
    ),
    Mistake(
        "forward for inverse",
        "This is the joint that carries the flange fastest along the direction, alone: the flange "
        "goes aside and turns, too. The joint speeds are the unknown: solve.",
        lambda q, d, most: np.max(abs(PUMA560.jacobian(q)[:3].T @ _unit(d)) * most),
    ),
    Mistake(
        "another posture",
        "The joint speeds belong to another row of ik than q. The Jacobian is wanted at q itself.",
        _with_rates(lambda q, d: _rates(PUMA560.ik(PUMA560.fk(q))[0], d)),
    ),
    Mistake(
        "a joint's speed for the flange's",
        "This is how fast the deciding joint turns at 1 m/s. The speed is its most over that.",
        lambda q, d, most: abs(_rates(q, d))[int((abs(_rates(q, d)) / most).argmax())],
    ),
    Mistake(
        "transposed",
        "The transposed Jacobian turns forces into torques. Joint speeds need the inverse.",
        _with_rates(lambda q, d: PUMA560.jacobian(q).T @ _twist(d)),
    ),
    Mistake(
        "transposed",
        "J is transposed before the system is solved.",
        _with_rates(lambda q, d: _solved(PUMA560.jacobian(q).T, _twist(d))),
    ),
    Mistake(
        "velocity and angular velocity exchanged",
        "The first three rows of J are the velocity of the flange, the last three its turning.",
        _with_rates(lambda q, d: _solved(PUMA560.jacobian(q), np.zeros(3), _unit(d))),
    ),
    Mistake(
        "the tool turns along",
        "The angular velocity has to be zero: the flange does not turn.",
        _with_rates(lambda q, d: _solved(PUMA560.jacobian(q), _unit(d), _unit(d))),
    ),
    Mistake(
        "the tool turns along",
        "The angular velocity has to be zero, not one: the flange does not turn.",
        _with_rates(lambda q, d: _solved(PUMA560.jacobian(q), _unit(d), np.ones(3))),
    ),
    Mistake(
        "lengths in reaches",
        "The scaled Jacobian compares; a speed in m/s needs the Jacobian as it is.",
        _with_rates(_scaled),
    ),
    Mistake(
        "the direction seen from the tool",
        "`direction` is given in the base, as the Jacobian is: it is not turned.",
        _with_rates(lambda q, d: _rates(q, PUMA560.fk(q).rotation @ d)),
    ),
    Mistake(
        "the direction seen from the tool",
        "`direction` is given in the base, as the Jacobian is: it is not turned back.",
        _with_rates(lambda q, d: _rates(q, PUMA560.fk(q).rotation.inverse() @ d)),
    ),
    Mistake(
        "the fastest joint with its own most",
        "The joint that turns fastest is not always the first at its most: take the least of "
        "all six quotients.",
        lambda q, d, most: (most / abs(_rates(q, d)))[abs(_rates(q, d)).argmax()],
    ),
    Mistake(
        "one most for all joints",
        "Each joint has a most of its own: divide joint by joint, then take the least.",
        lambda q, d, most: np.min(most) / np.max(abs(_rates(q, d))),
    ),
    Mistake(
        "one most for all joints",
        "The largest most belongs to one joint only: divide joint by joint, then take the least.",
        lambda q, d, most: np.max(most) / np.max(abs(_rates(q, d))),
    ),
    Mistake(
        "one most for all joints",
        "The mean of most belongs to no joint: divide joint by joint, then take the least.",
        lambda q, d, most: np.mean(most) / np.max(abs(_rates(q, d))),
    ),
    Mistake(
        "one most for all joints, and signs",
        "Each joint has a most of its own, and may turn either way: divide joint by joint, take "
        "absolute values, then the least.",
        lambda q, d, most: np.min(most) / np.max(_rates(q, d)),
    ),
    Mistake(
        "the joint with the least most",
        "The weakest joint is not always the first at its most: another one may have to turn much "
        "more. Take the least of all six quotients.",
        lambda q, d, most: (most / abs(_rates(q, d)))[most.argmin()],
    ),
    Mistake(
        "the first joint's most for all",
        "most[0] is joint 1's: divide joint by joint, then take the least.",
        lambda q, d, most: most[0] / np.max(abs(_rates(q, d))),
    ),
    Mistake(
        "the length of the joint speeds",
        "The joints do not share a budget: each is compared with its own most.",
        lambda q, d, most: np.linalg.norm(most) / np.linalg.norm(_rates(q, d)),
    ),
    Mistake(
        "the length of the joint speeds",
        "The joints do not share a budget: each is compared with its own most.",
        lambda q, d, most: np.min(most) / np.linalg.norm(_rates(q, d)),
    ),
    Mistake(
        "the length of the joint speeds",
        "The joints do not share a budget: each is compared with its own most.",
        lambda q, d, most: np.max(most) / np.linalg.norm(_rates(q, d)),
    ),
    Mistake(
        "the length of the joint speeds",
        "The shares of the six joints are not a vector with a length: the greatest of them "
        "decides, not the root of the sum of squares.",
        lambda q, d, most: 1 / np.linalg.norm(_rates(q, d) / most),
    ),
    Mistake(
        "the sum of the joint speeds",
        "The joints do not share a budget: each is compared with its own most.",
        lambda q, d, most: 1 / np.sum(abs(_rates(q, d)) / most),
    ),
    Mistake(
        "the mean of the quotients",
        "A mean lets some joints past their most: the least of the quotients decides.",
        lambda q, d, most: np.mean(most / abs(_rates(q, d))),
    ),
    Mistake(
        "the sum of the quotients",
        "Each quotient is a speed that one joint allows. They are not added up: the least decides.",
        lambda q, d, most: np.sum(most / abs(_rates(q, d))),
    ),
    Mistake(
        "the sum of the quotients",
        "Each quotient is a speed that one joint allows. They have no length: the least decides.",
        lambda q, d, most: np.linalg.norm(most / _rates(q, d)),
    ),
    Mistake(
        "joint speeds over most",
        "This is the share of its most that the busiest joint needs at 1 m/s. The speed is 1 over "
        "that.",
        lambda q, d, most: np.max(abs(_rates(q, d)) / most),
    ),
    Mistake(
        "only joint 4",
        "Joint 4 whips near a wrist singularity, but elsewhere another joint decides.",
        lambda q, d, most: (most / abs(_rates(q, d)))[3],
    ),
)


# --- 3: a line of one's own -----------------------------------------------------------------------

UNITS = {
    "tilt": ("\N{DEGREE SIGN} about y", deg),
    **{f"{end}_{letter}": ("mm", mm) for end in ("start", "goal") for letter in "xyz"},
    "fastest": ("\N{DEGREE SIGN}/s", deg),
}
SHARES = quintic(1.0)(np.linspace(0, 1, 161))
LONGEST = 1.05  # times the least duration


def _ends(numbers: Mapping[str, float]) -> tuple[Transform, Transform]:
    turn = Quaternion.from_angle_axis(numbers["tilt"], Y)
    first, last = (
        Transform(turn, np.array([numbers[f"{end}_{letter}"] for letter in "xyz"]))
        for end in ("start", "goal")
    )
    return first, last


def _tracks(poses: Transform) -> Floats:
    """The motions (8, samples, 6) along every row."""
    rows = PUMA560.ik(poses)
    return follow(PUMA560, np.stack([np.roll(rows, -k, axis=1) for k in range(8)]), 0)


def _excess(q: Floats) -> Floats:
    """How far past the limits, rad: negative inside."""
    over: Floats = np.maximum(q - HIGH, LOW - q)
    return over


class _Judged:
    """What is to be known of a line: for each row the motion, how far past its limits it comes, its
    greatest joint speed in 1 s, and whether it is usable at the ends.
    """

    def __init__(self, numbers: Mapping[str, float]) -> None:
        self.q = _tracks(lin(*_ends(numbers), SHARES))
        over = _excess(self.q)
        self.past = over.max(axis=(1, 2))
        self.serves = np.isfinite(self.past) & (self.past <= SLACK)
        speeds = differentiate(self.q, np.linspace(0, 1, len(SHARES)))
        self.speed = abs(speeds).max(axis=(1, 2))
        self.at_start = np.all(within(PUMA560, self.q[:, 0]), axis=-1)
        self.at_goal = np.all(within(PUMA560, self.q[:, -1]), axis=-1)
        self.near = distance_from_singularity(PUMA560, self.q).min(axis=-1)
        self.mean = np.maximum(abs(self.q[:, -1] - self.q[:, 0]).max(axis=-1), 1e-9)
        travel = abs(self.q[:, 0] - REST).sum(axis=-1)
        self.obvious = int(np.where(self.at_start, travel, np.inf).argmin())

    def least(self, fastest: float) -> Floats:
        """The least duration of each row, s; infinite where it does not serve."""
        return np.where(self.serves, self.speed / fastest, np.inf)


@cache
def _judged(items: tuple[tuple[str, float], ...]) -> _Judged:
    return _Judged(dict(items))


def _of(numbers: Mapping[str, float]) -> _Judged:
    return _judged(tuple(sorted((k, float(v)) for k, v in numbers.items())))


def _fair(judged: _Judged) -> bool:
    """Whether a line is a fair task: some rows carry it to its end, at least two others are usable
    at its start, the obvious one is not the quickest, and nothing depends on the samples.
    """
    if not np.isfinite(judged.q).all():
        return False
    serving = judged.serves
    most = np.sort(judged.least(1.0))
    best = int(judged.least(1.0).argmin())
    return bool(
        1 <= serving.sum() <= min(4, judged.at_start.sum() - 2)
        and (abs(judged.past) > 1 * deg).all()
        and most[1] > 1.15 * most[0]
        and judged.near[best] > 0.03
        and best != judged.obvious
    )


def given(who: Any) -> Numbers:
    """A line of one's own, to be run by row and duration."""
    roll = dice(LAB, who)
    while True:
        side, x = 1 - 2 * roll.randrange(2), roll.randrange(350, 651, 10) * mm
        numbers = {
            "tilt": roll.randrange(60, 151, 15) * deg,
            "start_x": x,
            "start_y": side * roll.randrange(300, 651, 10) * mm,
            "start_z": roll.randrange(400, 1101, 10) * mm,
            "goal_x": x,
            "goal_y": -side * roll.randrange(100, 401, 10) * mm,
            "goal_z": roll.randrange(400, 1201, 10) * mm,
            "fastest": roll.randrange(30, 91, 5) * deg,
        }
        if np.isfinite(PUMA560.ik(lin(*_ends(numbers), SHARES[::8]))).all() and _fair(_of(numbers)):
            return Numbers(numbers, UNITS)


def _choice_form(answer: Any, given: Any) -> tuple[int, float]:
    if not isinstance(answer, Mapping) or not {"row", "duration"} <= set(answer):
        raise ValueError(
            f'wanted {{"row": ..., "duration": ...}} with a row of ik and seconds, got '
            f"{words(answer)}"
        )
    row, duration = answer["row"], answer["duration"]
    if np.size(row) != 1 or isinstance(row, (str, bool)) or float(np.reshape(row, ())) % 1:
        raise ValueError(f"row: wanted a whole number from 0 to 7, got {words(row)}")
    row = int(np.reshape(row, ()))
    if not 0 <= row <= 7:
        raise ValueError(f"row: wanted a whole number from 0 to 7, got {row}")
    if np.size(duration) != 1 or isinstance(duration, (str, bool)):
        raise ValueError(f"duration: wanted seconds, got {words(duration)}")
    seconds = float(np.reshape(duration, ()))
    if not (np.isfinite(seconds) and seconds > 0):
        raise ValueError(f"duration: wanted seconds above 0, got {words(seconds)}")
    return row, seconds


def _choice_faults(answer: tuple[int, float], given: Any) -> list[tuple[str, str]]:
    row, duration = answer
    judged = _of(given)
    faults = []
    if not judged.serves[row]:
        faults.append(_row_fault(judged, row))
    fastest = float(given["fastest"])
    needed = float(judged.speed[row]) / fastest
    least = float(judged.least(fastest).min())
    speed = judged.speed[row] / duration
    if duration < 0.995 * needed:
        faults.append(_fast_fault(judged, row, duration, fastest, speed))
    if duration > LONGEST * max(least, needed if not judged.serves[row] else 0.0):
        faults.append(_slow_fault(judged, row, duration, fastest, least))
    return faults


def _row_fault(judged: _Judged, row: int) -> tuple[str, str]:
    over = _excess(judged.q[row])
    sample, joint = (int(k) for k in np.argwhere(over > SLACK)[0])
    most = over.max(axis=0)
    says = (
        f"On row {row} joint {joint + 1} is past its limit from {100 * sample / 160:.0f} % of the "
        f"time on, by up to {most[joint] / deg:.0f}°."
    )
    if judged.at_start[row] and judged.at_goal[row]:
        return (
            "usable at both ends, not in between",
            says + " At both ends the posture is usable: look at the angles that were followed.",
        )
    if row == judged.obvious:
        return (
            "usable at the start, not to the end",
            says + " At the start it is usable, and the nearest to the rest posture. Rows count "
            "from 0.",
        )
    return "not usable to the end", says + " Follow each row to the end of the line."


def _fast_fault(
    judged: _Judged, row: int, duration: float, fastest: float, speed: float
) -> tuple[str, str]:
    is_at, most = apart(speed / deg, fastest / deg, 0)
    says = f"In {duration:.4g} s a joint of row {row} turns with up to {is_at}°/s; "
    says += f"allowed are {most}°/s."
    if abs(duration * fastest / judged.mean[row] - 1) < 0.005:
        return (
            "the mean speed for the greatest",
            says + " Way over time is the mean. The quintic law is faster than that in the middle.",
        )
    if abs(duration * fastest / judged.mean[row] / (15 / 8) - 1) < 0.005:
        return (
            "the peak of PTP on a line",
            says + " 15/8 of the mean is the peak where every joint turns from end to end by the "
            "quintic law. On a straight line of the flange it does not: differentiate the angles.",
        )
    if fault := _unit_fault(duration * fastest / judged.speed[row], fastest, says):
        return fault
    if (duration >= 0.995 * judged.least(fastest)).any():
        says += " For another row it would be enough."
    return "too fast", says


def _unit_fault(share: float, fastest: float, says: str) -> tuple[str, str] | None:
    """If the duration is such a share of the right one."""
    for wrong in (deg, 1 / deg):
        if 0.995 < share / wrong < LONGEST:
            return (
                "degrees for radians",
                says + " Joint speed and fastest have to be in one unit: both in rad/s.",
            )
    if abs(fastest - 1) > 0.2 and abs(share / fastest - 1) < 0.021:
        return (
            "the joint speed for the duration",
            says + " This number is the greatest joint speed in one second. In T seconds it is T "
            "times less: divide it by fastest.",
        )
    return None


def _slow_fault(
    judged: _Judged, row: int, duration: float, fastest: float, least: float
) -> tuple[str, str]:
    says = f"{duration:.4g} s is more than 5 % above the shortest duration there is."
    if judged.serves[row] and judged.least(fastest)[row] > LONGEST * least:
        return (
            "a row that serves, and not the quickest",
            says + f" Row {row} is usable to the end, but it turns more.",
        )
    fault = _unit_fault(duration * fastest / judged.speed[row], fastest, says)
    return fault or ("too slow", says)


# --- The predictions' numbers and views -----------------------------------------------------------

MINUS = str.maketrans("-", "\N{MINUS SIGN}")


def _pose(x: float, y: float, z: float) -> Transform:
    return Transform(Quaternion.from_angle_axis(90 * deg, Y), np.array([x, y, z]) * mm)


# the line of the lab's first picture, and the via point of its last section
START, GOAL, VIA = _pose(550, 600, 800), _pose(550, -200, 1100), _pose(600, -100, 1000)


def _forearm(q3: float) -> Floats:
    """The direction of the forearm over a level upper arm, joint 3 in degrees."""
    frames = PUMA560.frames(np.array([0, 0, q3, 0, 0, 0]) * deg).translation
    along: Floats = (frames[4] - frames[3]) / np.linalg.norm(frames[4] - frames[3])
    return along


@cache
def _forearm_facts() -> dict[str, Any]:
    inside = [q3 for q3 in range(-225, 46, 45) if _forearm(q3)[2] < -0.999]
    return {"down": inside[0], "other": inside[0] + 360, "level": inside[0] // 2}


def _forearm_view() -> Any:
    from ..show import plot_frames

    q = np.array([0, 0, _forearm_facts()["down"], 0, 0, 0]) * deg
    frames = PUMA560.frames(q)
    shown = [frames[k] for k in (0, 1, 2, 3, 6)]
    names = ["base", "shoulder", "elbow", "forearm", "flange"]
    title = f"q2 = 0, q3 = {_forearm_facts()['down']}\N{DEGREE SIGN}".translate(MINUS)
    return plot_frames(shown, chain=True, size=120 * mm, names=names, title=title)


def _waists(rho: float) -> Floats:
    """Both values of joint 1 for a wrist centre straight ahead, degrees: front and behind."""
    pose = _pose(rho / mm, 0, 900)
    both: Floats = PUMA560.ik(pose)[[0, 4], 0] / deg
    return both


@cache
def _waist_facts() -> dict[str, Any]:
    front, behind = _waists(2 * D3)
    turn = abs(behind - front)
    return {"rho": 2 * D3 / mm, "turn": turn, "one": (180 + turn) / 2, "rest": 180 - turn}


def _waist_right(facts: Mapping[str, Any]) -> int:
    return int(np.argmin([abs(x - facts["turn"]) for x in (180, facts["one"], facts["turn"], 90)]))


def _waist_view() -> Any:
    from ..show import figure

    facts = _waist_facts()
    fig = figure(
        "The two values of joint 1 over the distance of the wrist centre from axis 1. At 800 mm "
        f"they differ by {np.ptp(_waists(800 * mm)):.0f} degrees, at {facts['rho']:.0f} mm by "
        f"{facts['turn']:.0f} degrees, at {D3 / mm:.2f} mm they are one.",
        7,
        3.6,
    )
    ax = fig.subplots()
    rho = (D3 / mm + 1e-6) + 700 * np.linspace(0, 1, 100) ** 3
    both = np.array([_waists(x * mm) for x in rho])
    ax.plot(rho, both[:, 0], "-", rho, both[:, 1], "--", color="#0072B2", lw=2)
    ax.vlines(facts["rho"], *_waists(2 * D3), color="#D55E00", lw=2)
    ax.text(facts["rho"] + 8, 90, f"{facts['turn']:.0f}\N{DEGREE SIGN}", va="center")
    ax.text(700, both[92, 0] + 9, "front", ha="center")
    ax.text(700, both[92, 1] - 9, "behind", ha="center", va="top")
    ax.axvspan(100, D3 / mm, color="#E3E7EB")
    ax.set(xlabel="distance from axis 1, mm", ylabel="q1, \N{DEGREE SIGN}", xlim=(100, 850))
    ax.set(ylim=(0, 180), yticks=range(0, 181, 30), title="At the offset the two values are one")
    fig.tight_layout()
    return fig


@cache
def _elbow_facts() -> dict[str, Any]:
    rows = PUMA560.ik(START)
    moved = abs(np.sin((rows[2] - rows[0]) / 2)) > 1e-6
    values = {
        f"row{k}": ", ".join(f"{x / deg:.1f}" for x in rows[k]).translate(MINUS) for k in (0, 2)
    }
    return {"moved": [int(k) + 1 for k in np.flatnonzero(moved)], **values}


def _elbow_right(facts: Mapping[str, Any]) -> int:
    return [[3], [2, 3], [2, 3, 4, 5, 6], [1, 2, 3, 4, 5, 6]].index(facts["moved"])


def _elbow_view() -> str:
    facts = _elbow_facts()
    return (
        "At the start of the line, q1 to q6 in degrees:\n"
        f"row 0 (+1 +1 +1): {facts['row0']}\n"
        f"row 2 (+1 \N{MINUS SIGN}1 +1): {facts['row2']}"
    )


def _random_poses(rng: np.random.Generator, shape: tuple[int, ...]) -> Transform:
    """Wrist centres spread evenly over the box about what the stretched arm reaches, orientations
    evenly over all rotations.
    """
    wxyz = rng.normal(size=(*shape, 4))
    far = float(np.hypot(UPPER + FORE, D3))
    place = 671.83 * mm * Z + rng.uniform(-far, far, size=(*shape, 3))
    return Transform(Quaternion(wxyz / np.linalg.norm(wxyz, axis=-1, keepdims=True)), place)


@cache
def _left_shares() -> Floats:
    """Shares of reachable poses with 0 to 8 rows inside the limits, %."""
    rows = PUMA560.ik(_random_poses(np.random.default_rng(560), (8000,)))
    rows = rows[np.isfinite(rows).all(axis=(1, 2))]
    count = np.all(within(PUMA560, rows), axis=-1).sum(axis=-1)
    return 100 * np.bincount(count, minlength=9) / len(count)


def _left_facts() -> dict[str, Any]:
    shares = _left_shares()
    return {"none": shares[0], "all": shares[8], "mean": shares @ np.arange(9) / 100}


def _left_right(facts: Mapping[str, Any]) -> int:
    return int(np.argmin([abs(facts["none"] - x) for x in (1, 10, 33, 60)]))


def _left_view() -> Any:
    from ..show import figure

    shares = _left_shares()
    fig = figure(
        "How many of eight rows are inside the limits at a random pose that can be reached: none "
        f"in {shares[0]:.1f} percent of the poses, all eight in {shares[8]:.1f} percent.",
        8,
        3.2,
    )
    ax = fig.subplots()
    ax.bar(range(9), shares, color="#0072B2")
    for k, value in enumerate(shares):
        ax.text(k, value + 0.7, f"{value:.1f}", ha="center", fontsize=9)
    ax.set(xlabel="rows inside the limits", ylabel="share of the poses, %", xticks=range(9))
    ax.set(
        ylim=(0, 1.2 * shares.max()), title=f"{shares[0]:.0f} % of what it reaches it cannot use"
    )
    fig.tight_layout()
    return fig


BOTH, ONE = [0, 60, -93, 0, 6, 0], [0, 60, -170, 0, 0.6, 0]


@cache
def _factor_facts() -> dict[str, Any]:
    facts: dict[str, Any] = {}
    for name, q_deg in (("both", BOTH), ("one", ONE)):
        q = np.array(q_deg) * deg
        facts[f"det_{name}"] = 1e4 * abs(float(np.linalg.det(PUMA560.jacobian(q))))
        facts[f"sigma_{name}"] = _sigma(q)
        facts[name] = str(q_deg).translate(MINUS)
    return facts | {"ratio": facts["sigma_both"] / facts["sigma_one"]}


def _factor_right(facts: Mapping[str, Any]) -> int:
    return 0 if 0.6 < facts["ratio"] < 1.6 else 1 if facts["ratio"] <= 0.6 else 2


def _factor_view() -> str:
    facts = _factor_facts()
    lines = [
        f"{facts[k]}: |det J| = {facts[f'det_{k}']:.1f}e-4 m\N{SUPERSCRIPT THREE}, "
        f"smallest singular value {facts[f'sigma_{k}']:.4f}"
        for k in ("both", "one")
    ]
    return "\n".join(lines).translate(MINUS)


# the lines of section 6: row, pose nearest to the singularity at a miss m, direction, goes on
SPEED = 100 * mm
DOWN = Quaternion.from_angle_axis(180 * deg, X)


def _stretched(m: float) -> float:
    far = (UPPER + FORE - m) ** 2 - (600 * mm - 671.83 * mm) ** 2 + D3**2
    return float(np.sqrt(far))


def _aligned(m: float) -> Transform:
    pose = PUMA560.fk(np.array([0, 60, -170, 0, 0, 0]) * deg)
    return Transform(pose.rotation, pose.translation + m * Z)


def _beside(m: float) -> Transform:
    return Transform(translation=np.array([D3 + m, 0, 1200 * mm]))


LINES: dict[str, tuple[int, Callable[[float], Transform], Floats, bool]] = {
    "wrist": (3, _aligned, Y, True),
    "elbow": (3, lambda m: Transform(DOWN, np.array([_stretched(m), 0, 600 * mm])), X, False),
    "shoulder, towards": (2, _beside, -X, False),
    "shoulder, past": (2, _beside, Y, True),
}


def _price(name: str, m: float) -> tuple[float, float]:
    """The greatest joint speed on a line, rad/s, and the smallest distance from singularity."""
    row, middle, direction, goes_on = LINES[name]
    u = 200 * mm * np.linspace(-1, 1 if goes_on else 0, 201) ** 3
    pose = middle(m)
    q = PUMA560.ik(Transform(pose.rotation, pose.translation + u[:, None] * direction))[:, row]
    twist = np.append(SPEED * direction, np.zeros(3))
    rates = np.linalg.solve(PUMA560.jacobian(q), np.tile(twist, (len(u), 1))[..., None])
    return float(abs(rates).max()), float(distance_from_singularity(PUMA560, q).min())


@cache
def _past_facts() -> dict[str, Any]:
    past, near = _price("shoulder, past", 1 * mm)
    return {
        "near": near,
        "past": past / deg,
        "towards": _price("shoulder, towards", 1 * mm)[0] / deg,
        "worst": SPEED / PUMA560.reach / near / deg,
        "over": SPEED / (1 * mm) / deg,
        "ceiling": 2 * SPEED / D3 / deg,
    }


def _past_right(facts: Mapping[str, Any]) -> int:
    guesses = [facts[k] for k in ("over", "towards", "past", "worst")]
    return int(np.argmin([abs(np.log(x / facts["past"])) for x in guesses]))


def _past_view() -> Any:
    from ..show import figure

    misses = np.array([100, 30, 10, 3, 1, 0.3, 0.1])
    prices = {name: np.array([_price(name, m * mm) for m in misses]) for name in LINES}
    most = {name: price[-1, 0] / deg for name, price in prices.items()}
    fig = figure(
        "Left: greatest joint speed over the distance from the singularity, both axes logarithmic. "
        + ", ".join(f"{name}: {value:.0f}" for name, value in most.items())
        + " degrees per second at 0.1 mm. Right: the smallest singular value of all four lines.",
        9,
        3.8,
    )
    left, right = fig.subplots(1, 2)
    styles = (("#E69F00", "-"), ("#009E73", ":"), ("#0072B2", "--"), ("#CC79A7", "-."))
    for (name, price), (color, style) in zip(prices.items(), styles, strict=True):
        left.loglog(misses, price[:, 0] / deg, style, color=color, lw=2.4)
        wide = name == "shoulder, towards"  # the other shoulder line covers it
        look: dict[str, Any] = {"ls": "-", "lw": 6, "alpha": 0.4} if wide else {"ls": style}
        right.loglog(misses, price[:, 1], color=color, label=name, **({"lw": 2.4} | look))
        above = 0.4 if name == "elbow" else 1.35
        left.text(0.09, above * price[-1, 0] / deg, name, fontsize=9)
    left.set(xlabel="distance m, mm", ylabel="greatest joint speed, \N{DEGREE SIGN}/s")
    left.set(ylim=(10, 1e5), title="The price depends on the direction")
    right.set(xlabel="distance m, mm", ylabel="distance from singularity")
    right.set(title="The warning does not")
    right.legend(fontsize=9)
    fig.tight_layout()
    return fig


RULES: tuple[tuple[str, Callable[[Floats], Floats]], ...] = (
    ("nearest to the rest posture", lambda q: abs(q - REST).sum(axis=-1)),
    ("widest margin to the limits", lambda q: -np.minimum(q - LOW, HIGH - q).min(axis=-1)),
    (
        "farthest from singularities",
        lambda q: -distance_from_singularity(PUMA560, q).round(9),
    ),
)


@cache
def _rule_facts() -> dict[str, Any]:
    rng = np.random.default_rng(7)
    ends = _random_poses(rng, (2, 3000))
    ends = ends[:, np.isfinite(PUMA560.ik(ends)).all(axis=(0, 2, 3))]
    rows = PUMA560.ik(lin(ends[0][:, None], ends[1][:, None], np.linspace(0, 1, 81)))
    rows = rows[np.isfinite(rows).all(axis=(1, 2, 3))]  # (lines, 81, 8, 6)
    turned = np.stack([np.roll(rows, -k, axis=2) for k in range(8)], axis=1)
    tracks = follow(PUMA560, turned, 0)  # (lines, 8, 81, 6)
    serves: Any = (_excess(tracks) <= SLACK).all(axis=(2, 3))
    can = serves.any(axis=-1)
    at_start = np.all(within(PUMA560, rows[:, 0]), axis=-1)
    facts: dict[str, Any] = {"lines": int(can.sum())}
    for k, (_, rule) in enumerate(RULES):
        pick = np.where(at_start, rule(tracks[:, :, 0]), np.inf).argmin(axis=-1)
        missed = ~serves[np.arange(len(rows)), pick][can]
        facts[f"rule{k}"] = 100 * missed.mean()
    return facts


def _rule_right(facts: Mapping[str, Any]) -> int:
    return int(np.argmin([abs(facts["rule0"] - x) for x in (0, 5, 40, 85)]))


def _rule_view() -> str:
    facts = _rule_facts()
    lines = [f"Of {facts['lines']} random lines that at least one row can serve, a rule misses:"]
    lines += [f"{name}: {facts[f'rule{k}']:.0f} %" for k, (name, _) in enumerate(RULES)]
    return "\n".join(lines)


@cache
def _twins() -> tuple[Floats, Floats]:
    """Times and the motions (2, samples, 6) of rows 0 and 1 past the via point."""
    t = np.linspace(0, 10, 501)
    tracks = _tracks(blend(START, VIA, GOAL, 0.1, quintic(10)(t)))
    return t, tracks[:2]


@cache
def _twin_facts() -> dict[str, Any]:
    t, tracks = _twins()
    zero, one = abs(differentiate(tracks, t)).max(axis=(1, 2)) / deg
    over = _excess(tracks).max(axis=1)
    past = [[int(i) + 1 for i in np.flatnonzero(x > SLACK)] for x in over]
    return {
        "zero": zero,
        "one": one,
        "past0": past[0],
        "past1": past[1],
        "same": abs(zero - one) < 1e-6 * one,
        "by": over[0].max() / deg,
        "bend": abs(tracks[0, :, 4]).min() / deg,
    }


def _twin_right(facts: Mapping[str, Any]) -> int:
    if facts["same"]:
        return 1 if facts["past0"] else 0
    return 2


def _twin_view() -> Any:
    from ..show import figure

    t, tracks = _twins()
    facts = _twin_facts()
    fig = figure(
        "Left: joint 4 of the wrist twins, row 0 and row 1, the same curve half a turn apart. Row "
        f"0 leaves the limits, by up to {facts['by']:.0f} degrees; row 1 stays inside. Right: "
        "their speeds are equal.",
        9,
        3.6,
    )
    left, right = fig.subplots(1, 2)
    for row, (style, color) in enumerate((("-", "#0072B2"), ("--", "#D55E00"))):
        left.plot(t, tracks[row, :, 3] / deg, style, color=color, lw=2, label=f"row {row}")
        speed = differentiate(tracks[row], t)[:, 3] / deg
        right.plot(t, speed, style, color=color, lw=4 - 2 * row, label=f"row {row}")
    for end, away in ((LOW[3], -60), (HIGH[3], 60)):
        left.axhspan(end / deg, end / deg + away, color="#E3E7EB")
    left.text(0.1, HIGH[3] / deg + 8, "past the limit")
    left.set(xlabel="t, s", ylabel="q4, °", title="Half a turn apart: one is past its limit")
    right.set(xlabel="t, s", ylabel="speed of joint 4, °/s", title="The same speeds")
    left.legend()
    right.legend()
    fig.tight_layout()
    return fig


# --- The tables -----------------------------------------------------------------------------------

EXERCISES = {
    "1": Function(
        title="Name a posture",
        task="Name a posture from its joint values",
        objective=1,
        hints=(
            "NOFLIP needs joint 5 alone, RIGHTY joints 2 and 3. For the elbow: where is the arm "
            "stretched, and to which side of that does joint 3 bend it?",
            "With the bend gamma = q3 + atan2(431.8, 20.3) the wrist centre is r = l2 cos(q2) + l3 "
            "cos(q2 + gamma) ahead of axis 1: the front flag is its sign, the elbow's flag the "
            "sign of sin(gamma).",
            "front = 1 if r > 0 else -1; elbow = 1 if np.sin(gamma) > 0 else -1; wrist = 1 if "
            "q[4] > 0 else -1. Then the table of section 3: ABOVE is front * elbow == -1.",
        ),
        inputs=("q",),
        right=_posture_name,
        cases=_name_cases,
        form=_name_form,
        law=_name_law,
        same=lambda a, b: a == b,
        mistakes=_told_apart(),
    ),
    "2": Function(
        title="The speed that the joints allow",
        task="Find the flange speed that the joints allow",
        objective=2,
        hints=(
            "How fast do the joints turn when the flange runs at 1 m/s? At twice the speed they "
            "turn twice as fast.",
            "rates = np.linalg.solve(PUMA560.jacobian(q), twist), where twist is the unit "
            "direction and three zeros: the tool does not turn.",
            "Each joint allows most[i] / abs(rates[i]) m/s. The least of the six decides.",
        ),
        inputs=("q", "direction", "most"),
        right=_flange_speed,
        cases=_speed_cases,
        form=_speed_form,
        law=_speed_law,
        same=_same_speed,
        mistakes=SPEED_MISTAKES,
    ),
    "3": Value(
        title="A line of your own",
        task="Choose row and duration for a line of your own",
        objective=3,
        hints=(
            "The duration changes no angle: first find the rows that stay inside the limits from "
            "the first sample to the last, then ask how fast they turn.",
            "for each row: q = follow(PUMA560, PUMA560.ik(lin(my_start, my_goal, "
            "quintic(1.0)(x))), row) with x from 0 to 1. It serves if ((q >= low) & (q <= "
            "high)).all().",
            "v = abs(differentiate(q, x)).max() is the greatest joint speed in one second; in T "
            'seconds it is v / T. So T = v / own["fastest"], least over the rows that serve; '
            "take 1 or 2 % more.",
        ),
        form=_choice_form,
        faults=_choice_faults,
        count=3,
        given=given,
    ),
}

# Objective 1: p1 to p4. Objective 2: p5, p6. Objective 3: p7, p8.
PREDICTIONS = {
    "p1": Prediction(
        question="q2 = 0 lays the upper arm level. At which q3, inside the limits of the table, "
        "does the forearm hang straight down?",
        options=(
            Option(
                "{down}",
                "At q3 = 0 the forearm points straight up, because alpha3 turns its axis by "
                "\N{MINUS SIGN}90° against the upper arm's. Half a turn brings it down.",
            ),
            Option(
                "{other}",
                "The same posture, and past the upper limit of 45°: the range of joint 3 goes the "
                "other way.",
                "the limits forgotten",
                "\N{MINUS SIGN}300° and 60° are one posture of joint 3, and neither is inside.",
            ),
            Option(
                "{level}",
                "There the forearm lies level, in line with the upper arm.",
                "a quarter turn, as if q3 = 0 were the stretched arm",
                "On the IRB-140, too, the arm is not stretched at q3 = 0: there the forearm stands "
                "square to the upper arm.",
            ),
            Option(
                "0",
                "At 0 it points straight up.",
                "the zero of a joint taken for hanging down",
                "Where a joint's zero is says the table, not gravity: at q2 = 0 the upper arm lies "
                "level.",
            ),
            Option(
                "90",
                "There it would point back over the upper arm, and the limit is 45°.",
                "the direction of turning",
                "A positive q3 turns the forearm from up towards the shoulder.",
            ),
        ),
        facts=_forearm_facts,
        right=lambda facts: 0,
        view=_forearm_view,
        unit="°",
        within=0.01,
    ),
    "p2": Prediction(
        question="On the IRB-140 the arm that faces the target and the arm that turns its back to "
        "it differ by 180° in joint 1. The PUMA's arm is mounted 150.05 mm beside axis 1. Its "
        "wrist centre is at twice that distance, {rho:.1f} mm from the axis. By how much do its "
        "two values of joint 1 differ?",
        options=(
            Option(
                "180°: front and behind are opposite.",
                "The arm's plane does not contain axis 1. Turned by 180° it passes the wrist "
                "centre on the wrong side, two offsets away.",
                "an arm without an offset",
                "At 800 mm the two differ by 158°, not by 180° either.",
            ),
            Option(
                "{one:.0f}°: the offset takes away asin(1/2).",
                "It takes that away twice: once for the arm in front, once for the arm behind.",
                "one tangent of two",
                "Close to the circle of radius 150.05 mm the difference goes to 0°, not to 90°.",
            ),
            Option(
                "{turn:.0f}°: asin(1/2) = 30° is lost on either side.",
                "Two tangents of the circle of radius d3 reach the wrist centre, each 30° beside "
                "its direction.",
            ),
            Option(
                "90°: half the way to where they meet.",
                "They do meet, at 150.05 mm, but not in proportion to the distance.",
                "in proportion to the distance",
                "At three offsets it would have to be 180°; there it is 141°.",
            ),
        ),
        facts=_waist_facts,
        right=_waist_right,
        view=_waist_view,
    ),
    "p3": Prediction(
        question="Row 0 has the flags +1 +1 +1, row 2 has +1 \N{MINUS SIGN}1 +1: another elbow for "
        "the same pose of the flange. Which joints stand differently?",
        options=(
            Option(
                "Joint 3 alone: it is the elbow.",
                "With another bend the wrist centre is as far from the shoulder, but in another "
                "direction: joint 2 has to make up for it.",
                "a flag taken for a joint",
                "Move your elbow with your hand held in place: the shoulder turns, too.",
            ),
            Option(
                "Joints 2 and 3: they carry the wrist centre.",
                "They do. But the forearm now comes from another side, and the wrist has to turn "
                "the flange back.",
                "the wrist forgotten",
                "Hold a full glass and move your elbow: the wrist bends all the time.",
            ),
            Option(
                "Joints 2 to 6: all but joint 1.",
                "Joints 2 and 3 mirror the triangle of upper arm and forearm, and the wrist turns "
                "the flange back. Joint 1 looks at the same place from the same side.",
            ),
            Option(
                "All six: another posture is another posture.",
                "Joint 1 depends on the place of the wrist centre and on the front flag alone, and "
                "both are the same.",
                "joint 1 taken for part of the triangle",
                "Look at two such arms from above: they lie in one plane.",
            ),
        ),
        facts=_elbow_facts,
        right=_elbow_right,
        view=_elbow_view,
    ),
    "p4": Prediction(
        question="We take thousands of random poses that the arm can reach, all eight ways each. "
        "For how many of them is no row inside the limits?",
        options=(
            Option(
                "For less than 1 %: one of eight nearly always fits.",
                "The eight are not independent: one joint 1 that is forbidden takes four rows "
                "along.",
                "eight chances taken for independent",
                "A pose behind the arm has no allowed joint 1 for its front rows: four at once.",
            ),
            Option(
                "For about one in ten.",
                "Joints 2, 4 and 5 forbid much: on average {mean:.1f} rows of eight are left.",
                "the limits underrated",
                "Joint 4 may stand in 280° of 360°, joint 5 in 200° of 360°.",
            ),
            Option(
                "For about a third.",
                "For {none:.0f} %. On average {mean:.1f} rows are left, all eight for {all:.0f} % "
                "of the poses.",
            ),
            Option(
                "For more than half.",
                "That would be so with one way in each pose. Eight ways help, if not as much as "
                "eight dice would.",
                "one way taken for eight",
                "A pose with one allowed row of eight counts as usable.",
            ),
        ),
        facts=_left_facts,
        right=_left_right,
        view=_left_view,
    ),
    "p5": Prediction(
        question="Posture A, {both}, is nearly stretched and nearly has axes 4 and 6 in line. "
        "Posture B, {one}, has only the axes in line, ten times nearer. |det J| is "
        "{det_both:.1f}e-4 m\N{SUPERSCRIPT THREE} for A and {det_one:.1f}e-4 "
        "m\N{SUPERSCRIPT THREE} for B. What does the distance from singularity say?",
        options=(
            Option(
                "About the same: the determinants are.",
                "The determinant is the product of six singular values. One very small value and "
                "two that are a little small can have the same product.",
                "the determinant taken for a distance",
                "Halve all lengths of an arm: |det J| falls to an eighth, the arm is as far from "
                "singular.",
            ),
            Option(
                "A is nearer: two singularities are worse than one.",
                "Each of the two costs one direction a little. What counts is the worst direction, "
                "and B's is worse.",
                "bad directions added up",
                "Two stairs of 10 cm are easier to climb than one wall of 1 m.",
            ),
            Option(
                "B is nearer, by a factor of about 4.",
                "By {ratio:.1f}: {sigma_one:.4f} against {sigma_both:.4f}. The smallest singular "
                "value knows the worst direction alone.",
            ),
        ),
        facts=_factor_facts,
        right=_factor_right,
        view=_factor_view,
    ),
    "p6": Prediction(
        question="Now the flange passes beside axis 1, at 100 mm/s along a tangent of the cylinder "
        "of radius d3, at a distance of 1 mm from it. The distance from singularity falls to "
        "{near:.4f}. What is the greatest speed that a joint reaches?",
        options=(
            Option(
                "About {over:.0f}°/s: speed over distance, 1/m as at the wrist.",
                "That is the law of the wrist. Here nothing turns about the point that is missed.",
                "one law for all singularities",
                "The elbow and the way towards the axis do not follow 1/m either.",
            ),
            Option(
                "About {towards:.0f}°/s: as on the way towards the axis.",
                "Towards the axis is the direction that costs. Along the tangent the flange moves "
                "in the arm's own plane.",
                "one price for all directions",
                "At a stretched arm moving outwards is impossible, moving sideways is easy.",
            ),
            Option(
                "About {past:.0f}°/s: less than the worst direction would cost.",
                "Joint 1 turns at most with 2 v / d3 = {ceiling:.0f}°/s. The distance from "
                "singularity is the price of the worst direction; this is not the worst one.",
            ),
            Option(
                "About {worst:.0f}°/s: the velocity divided by the distance from singularity.",
                "That is the bound for the worst direction. Here the flange moves in another one.",
                "the worst direction taken for this one",
                "At the wrist singularity the tool still turns about axis 6, at the price of joint "
                "6 alone.",
            ),
        ),
        facts=_past_facts,
        right=_past_right,
        view=_past_view,
    ),
    "p7": Prediction(
        question="{lines} random straight lines, each of which at least one row carries to its "
        "end. A program looks at the first pose, and takes the row inside the limits that is "
        "nearest to the rest posture. How many lines does it fail to finish?",
        options=(
            Option(
                "None: it starts inside the limits.",
                "The limits are asked at every sample, and the angles go on.",
                "the first sample taken for the path",
                "Drag the row in the first picture: all eight are inside at t = 0.",
            ),
            Option(
                "A few, about 5 %.",
                "The line of this lab is no rare case.",
                "a trap taken for an exception",
                "On average fewer than three of eight rows are usable at one single pose.",
            ),
            Option(
                "About {rule0:.0f} %.",
                "Two other rules for the first sample miss {rule1:.0f} and {rule2:.0f} %. "
                "Following all eight rows takes a fraction of a second.",
            ),
            Option(
                "Nearly all, 85 % or more.",
                "Short lines stay where their start is usable.",
                "as if a row were drawn blindly each time",
                "The row nearest to rest starts far from most limits.",
            ),
        ),
        facts=_rule_facts,
        right=_rule_right,
        view=_rule_view,
    ),
    "p8": Prediction(
        question="Row 1 rounds the corner in 10 s with no joint faster than {one:.1f}°/s, inside "
        "all limits. Row 0 is its wrist twin: q4 and q6 are 180° away, q5 has the other sign. What "
        "about row 0?",
        options=(
            Option(
                "The same speeds, and inside the limits as well.",
                "The speeds are the same. But the range of joint 4 is 280° wide: 180° away there "
                "need not be room.",
                "twins taken for equal in everything",
                "At the rest posture q4 = 0 is inside, and its twin at 180° is not.",
            ),
            Option(
                "The same speeds, but a joint is past its limit.",
                "A constant and a sign change no speed. Joint 4 is past its limit, by up to "
                "{by:.0f}°.",
            ),
            Option(
                "Faster: the wrist has to turn over on the way.",
                "It is turned over from the first sample to the last, and never turns back.",
                "a posture taken for a motion",
                "Two people walk side by side, one of them backwards: equally fast.",
            ),
            Option(
                "It jumps: half a turn cannot be followed.",
                "Each twin is continuous on its own. Only who changes from one to the other jumps.",
                "changing the row taken for being on it",
                "Whole turns aside, a fixed row jumps only at a singularity, the wrist's at q5 = "
                "0; here |q5| stays above {bend:.0f}°.",
            ),
        ),
        facts=_twin_facts,
        right=_twin_right,
        view=_twin_view,
    ),
}
