"""Lab 10, round an obstacle: its exercises and predictions.

The answers to each exercise come first, right and wrong, then the predictions' numbers and views;
the tables stand at the end.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np

from .._arrays import Bools, Floats
from ..arms import three_lever
from ..jobs.obstacles import (
    along,
    clearance,
    in_quadrilateral,
    keeps,
    via_path,
    way_round,
)
from ..units import deg, mm
from .exercises import words
from .mistakes import DEGREES, Mistake, Program, Tools
from .old import Catch, Fault, Function, Value
from .questions import Option, Prediction
from .told import apart, floats
from .variants import Numbers, dice, normalised

LAB = "obstacle_avoidance"
OBJECTIVES = (
    "decide whether a point lies in a region, and say why a test that holds for one drawing fails "
    "for another",
    "lead an arm past obstacles through via points or via postures, and measure the distance that "
    "all of its levers keep",
    'tell a check of a whole motion from one that looks at some of it, and answer "no" when a '
    "promise is not proven",
)
L = 1.0  # m: each lever
ARM = three_lever(L)
WANTED = L / 7  # m, source 003, III.3.2
K, K1 = np.array([1.2, 1.7]), np.array([1.9, 0.3])  # m: the gripper, its target, as in the lab
START = ARM.family(K, 118 * deg)
FAR = np.array([150, 120, 120]) * deg
MINUS = str.maketrans("-", "\N{MINUS SIGN}")


# --- 1: inside ------------------------------------------------------------------------------------

Corners = Any  # (n, 2)


def _sides(corners: Corners) -> list[tuple[Any, Any]]:
    return list(zip(corners, np.roll(corners, -1, axis=0), strict=True))


def _crossing(P: Any, Q: Any, y: float) -> float:
    """x of the line PQ at the height y."""
    return float(P[0] + (y - P[1]) / (Q[1] - P[1]) * (Q[0] - P[0]))


def _count(corners: Corners, H: Any) -> int:
    """The sides that a ray from H to the right crosses."""
    return sum(
        (P[1] > H[1]) != (Q[1] > H[1]) and H[0] < _crossing(P, Q, H[1]) for P, Q in _sides(corners)
    )


def _inside(tools: Tools, corners: Corners, H: Any) -> bool:
    return _count(corners, H) % 2 == 1


def _left_of(P: Any, Q: Any, H: Any) -> float:
    return float((Q[0] - P[0]) * (H[1] - P[1]) - (Q[1] - P[1]) * (H[0] - P[0]))


def _box(corners: Corners, H: Any) -> bool:
    return bool(((corners.min(axis=0) < H) & (corners.max(axis=0) > H)).all())


def _hull(corners: Corners, H: Any) -> bool:
    angles = np.sort(np.arctan2(corners[:, 1] - H[1], corners[:, 0] - H[0]))
    gaps = np.diff(np.append(angles, angles[0] + 2 * np.pi))
    return bool(gaps.max() < np.pi)


def _drawing(corners: Corners, H: Any) -> bool:
    """Between f1 (upper) and f2 (lower), between f3 (left) and f4 (right)."""
    A, K_, K1_, A1 = corners
    between = _height(A1, K1_, H[0]) < H[1] < _height(A, K_, H[0])
    return bool(between and _crossing(A, A1, H[1]) < H[0] < _crossing(K_, K1_, H[1]))


def _height(P: Any, Q: Any, x: float) -> float:
    """y of the line PQ at x."""
    return float(P[1] + (Q[1] - P[1]) / (Q[0] - P[0]) * (x - P[0]))


def _spans(touch: Callable[[float, float, float], bool]) -> Program:
    """The ray rule with another idea of which sides reach the height of H."""

    def program(corners: Corners, H: Any) -> bool:
        count = 0
        for P, Q in _sides(corners):
            low, high = min(P[1], Q[1]), max(P[1], Q[1])
            if touch(low, float(H[1]), high):
                if P[1] == Q[1]:
                    count += bool(H[0] < max(P[0], Q[0]))
                else:
                    count += bool(H[0] < _crossing(P, Q, H[1]))
        return count % 2 == 1

    return program


def _open_chain(corners: Corners, H: Any) -> bool:
    pairs = zip(corners[:-1], corners[1:], strict=True)
    crossed = [
        bool((P[1] > H[1]) != (Q[1] > H[1]) and H[0] < _crossing(P, Q, H[1])) for P, Q in pairs
    ]
    return sum(crossed) % 2 == 1


def _by_corner(which: Callable[[float, float], float]) -> Program:
    def program(corners: Corners, H: Any) -> bool:
        crossed = [
            bool((P[1] > H[1]) != (Q[1] > H[1]) and H[0] < which(P[0], Q[0]))
            for P, Q in _sides(corners)
        ]
        return sum(crossed) % 2 == 1

    return program


def _upside_down(corners: Corners, H: Any) -> bool:
    count = 0
    for P, Q in _sides(corners):
        if (P[1] > H[1]) != (Q[1] > H[1]):
            with np.errstate(all="ignore"):
                x = P[0] + (H[1] - P[1]) * np.divide(Q[1] - P[1], Q[0] - P[0])
            count += bool(H[0] < x)
    return count % 2 == 1


def _lines(corners: Corners, H: Any) -> bool:
    sides = [(P, Q) for P, Q in _sides(corners) if P[1] != Q[1]]
    return sum(bool(H[0] < _crossing(P, Q, H[1])) for P, Q in sides) % 2 == 1


def _two_triangles(corners: Corners, H: Any) -> bool:
    return any(_count(corners[[0, k, k + 1]], H) % 2 == 1 for k in range(1, len(corners) - 1))


def _circle(corners: Corners, H: Any) -> bool:
    middle = corners.mean(axis=0)
    return bool(np.hypot(*(H - middle)) < np.hypot(*(corners - middle).T).max())


def _one_turn(corners: Corners, H: Any) -> bool:
    return all(_left_of(P, Q, H) > 0 for P, Q in _sides(corners))


def _clockwise(corners: Corners, H: Any) -> bool:
    return all(_left_of(P, Q, H) < 0 for P, Q in _sides(corners))


def _last_decides(corners: Corners, H: Any) -> bool:
    inside = False
    for P, Q in _sides(corners):
        if (P[1] > H[1]) != (Q[1] > H[1]):
            inside = H[0] < _crossing(P, Q, H[1])
    return bool(inside)


def _crossed(takes: Callable[[float, float, float], bool]) -> Program:
    """The even-odd rule with another idea of which sides are at the height of H."""

    def program(corners: Corners, H: Any) -> bool:
        at = [(P, Q) for P, Q in _sides(corners) if takes(P[1], H[1], Q[1]) and P[1] != Q[1]]
        return sum(bool(H[0] < _crossing(P, Q, H[1])) for P, Q in at) % 2 == 1

    return program


def _every_way(ways: Sequence[str]) -> Program:
    return lambda corners, H: all(
        _count(TOWARDS[way](corners), TOWARDS[way](H)) > 0 for way in ways
    )


def _unsigned(corners: Corners, H: Any) -> float:
    """The angles under which H sees the sides, all counted positive, as parts of a turn."""
    seen = np.array([complex(*(P - H)) for P in corners])
    return float(abs(np.angle(np.roll(seen, -1) / seen)).sum()) / (2 * np.pi)


def _convex(corners: Corners, H: Any) -> bool:
    left = [_left_of(P, Q, H) > 0 for P, Q in _sides(corners)]
    return all(left) or not any(left)


def _no_dent(corners: Corners, H: Any) -> bool:
    """As `_convex`, but a point in line with a side is outside."""
    left = np.array([_left_of(P, Q, H) for P, Q in _sides(corners)])
    return bool((left > 0).all() or (left < 0).all())


def _no_dent_on_lines(corners: Corners, H: Any) -> bool:
    left = np.array([_left_of(P, Q, H) for P, Q in _sides(corners)])
    return bool((left >= 0).all() or (left <= 0).all())


def _turns(corners: Corners, H: Any) -> int:
    """How often the shape goes round H, counter-clockwise."""
    seen = np.array([complex(*(P - H)) for P in corners])
    return round(float(np.angle(np.roll(seen, -1) / seen).sum()) / (2 * np.pi))


TOWARDS: Mapping[str, Program] = {
    "right": lambda points: points,
    "left": lambda points: points * [-1, 1],
    "up": lambda points: points[..., ::-1],
    "down": lambda points: points[..., ::-1] * [-1, 1],
}


def _ray(way: str, program: Program) -> Program:
    """The same mistake by whoever draws the ray another way."""
    return lambda corners, H: program(TOWARDS[way](corners), TOWARDS[way](H))


def _first_four(corners: Corners, H: Any) -> bool:
    if len(corners) < 4:
        raise IndexError
    return _count(corners[:4], H) % 2 == 1


def _star(count: int, step: int) -> list[tuple[float, float]]:
    """A star with so many points, drawn in one line: from each point to the `step`-th next one."""
    angles = 2 * np.pi * step / count * np.arange(count) + 0.1
    return [(round(2 * float(np.cos(a)), 2), round(2 * float(np.sin(a)), 2)) for a in angles]


def _inside_cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    diamond = [(0, -1), (1, 0), (0, 1), (-1, 0)]
    drawn = [(0.8, 1.5), (1.75, 1.7), (1.85, 0.5), (0.9, 0.6)]  # one drawing: A, K, K1, A1
    dent = [(0, 0), (4, 0), (4, 3), (2, 1)]  # a dent at the last corner
    arrow = [(0, 0), (2, 1), (4, 0), (2, 4)]
    bow = [(0, 0), (2, 2), (2, 0), (0, 2)]  # two of its sides cross
    star = _star(5, 2)  # drawn in one line: the shape goes twice round its middle
    hook = [(0, 0), (5, 0), (5, 5), (1, 5), (1, 2), (3, 2)]
    hook += [(3, 3), (2, 3), (2, 4), (4, 4), (4, 1), (0, 1)]
    ring = _star(8, 3)  # three times round the middle, twice round what is next to it
    comb = [(0, 0), (6, 0), (6, 4), (5, 1), (4, 4), (3, 1), (2, 4), (1, 1)]
    steep = [(0.9, 0.5), (0.85, -0.5), (1.3, 0.2), (0.75, 1.05)]
    triangle = [(0, 0), (3, 0), (0, 2)]
    pentagon = [(0, 0), (3, 0), (4, 2), (2, 1), (0, 3)]
    tried: list[tuple[Any, Any]] = [
        (square, (0.5, 0.5)),
        (square, (1.5, 0.5)),
        (square, (-0.5, 0.5)),
        (square[::-1], (0.25, 0.75)),
        (square, (1.1, 0.5)),
        (square, (0.5, 1.5)),
        (square, (-1, 0)),  # level with a side
        (square, (-1, 1)),
        (diamond, (0, 0)),  # level with corners
        (diamond, (-2, 0)),
        (diamond, (-2, 1)),
        (diamond, (0.25, 0.5)),
        (diamond, (0.7, 0.6)),
        (diamond[::-1], (-0.75, -0.5)),
        (drawn, (1.3, 1.1)),
        (drawn, (0.5, 1.1)),
        (drawn, (1.3, 2.0)),
        (drawn[::-1], (1.3, 1.1)),
        (dent, (3, 1)),
        (dent, (2, 1.5)),
        (dent, (1, 1)),
        (dent[::-1], (1.5, 0.5)),
        (arrow, (2, 0.5)),
        (arrow, (2, 2)),
        (arrow, (-1, 1)),
        (arrow[1:] + arrow[:1], (2, 0.5)),
        (bow, (1, 0.5)),
        (bow, (0.5, 1)),
        (bow, (1.75, 1.5)),
        (bow, (1, 1.5)),
        (comb, (0.4, 1.2)),
        (comb, (1.8, 2)),
        (comb, (3, 2)),
        (comb, (0.5, 0.25)),
        (comb, (4, 1)),
        (steep, (1.03, 0.45)),
        (steep, (0.8, 0.3)),
        (triangle, (1, 1)),
        (triangle, (2, 1)),
        (triangle, (-1, 2)),
        (pentagon, (3, 1.75)),
        (pentagon, (0.5, 2)),
        (pentagon, (3.2, 1)),
        (dent, (1.5, 0.5)),  # in line with a side
        (comb, (5.7, 2)),  # many crossings on one side of H, one on the other
        (star, (0.1, 0.05)),  # two sides to the right: outside
        (star, (1.5, 0.1)),
        (star[::-1], (-0.1, 0.1)),
        (star, (0.95, 0.9)),
        (ring, (0.1, 0.05)),
        (ring[::-1], (-0.05, 0.1)),
        (ring, (0.9, 0.2)),
        (ring, (1.7, 0.05)),
        ([(y, x) for x, y in comb], (2, 3)),  # between two teeth, one above, one below
        (hook, (3.5, 2.5)),  # outside, with sides in every direction
        (hook, (1.5, 3)),
        (hook[::-1], (2.5, 3.5)),
    ]
    cases = [(np.array(c, dtype=float), np.array(h, dtype=float)) for c, h in tried]
    while len(cases) < 66:
        corners = rng.uniform(0, 2, (4, 2)).round(2)
        H = rng.uniform(corners.min(axis=0), corners.max(axis=0)).round(2)
        gaps = [_to_segment(P, Q, H) for P, Q in _sides(corners)]
        if min(gaps) > 0.02:
            cases.append((corners, H))
    return cases


def _to_segment(P: Floats, Q: Floats, H: Floats) -> float:
    share = np.clip((H - P) @ (Q - P) / ((Q - P) @ (Q - P)), 0, 1)
    return float(np.hypot(*(P + share * (Q - P) - H)))


def _bool(result: Any, case: tuple[Any, ...]) -> bool:
    if isinstance(result, str) or np.size(result) != 1:
        raise ValueError(f"wanted True or False, got {words(result)}")
    value = np.reshape(np.asarray(result), ()).item()
    if value not in (0, 1):
        raise ValueError(f"wanted True or False, got {words(result)}")
    return bool(value)


def _inside_law(case: tuple[Any, ...], yours: bool) -> str | None:
    corners, H = case
    wanted, count = _inside(Tools(), corners, H), _count(corners, H)
    if yours == wanted:
        return None
    sides = "side" if count == 1 else "sides"
    shape = ", ".join(f"({x:g}, {y:g})" for x, y in corners)
    line = (
        f"should be {wanted}: a ray from ({H[0]:g}, {H[1]:g}) to the right crosses {count} {sides} "
        f"of {shape}"
    )
    return line.translate(MINUS)


# of these there is one for each direction of the ray
OTHER_RAYS = (
    "the closing side left out",
    "any crossing",
    "a corner counts twice, or not at all",
    "lines for sides",
)
RIGHTWARD_MISTAKES = (
    Mistake(
        "the box around it",
        "It asks whether H lies between the smallest and the greatest x and y. A slanted shape "
        "does not fill that box.",
        _box,
    ),
    Mistake(
        "one drawing's order of the lines",
        "Its inequalities hold while the first side is the upper one and the second the right one. "
        "Another motion has them elsewhere.",
        _drawing,
    ),
    Mistake(
        "one way round only",
        "It asks whether H is to the left of every side. That wants corners counter-clockwise and "
        "a shape without a dent.",
        _one_turn,
    ),
    Mistake(
        "clockwise only",
        "It asks whether H is to the right of every side. That wants corners clockwise and a shape "
        "without a dent.",
        _clockwise,
    ),
    *(
        Mistake(
            "no dent allowed",
            "A shape with a dent, or with sides that cross, has points inside that are to the left "
            "of some sides and to the right of others. The same for sums of the triangles' areas.",
            program,
        )
        for program in (_convex, _no_dent, _no_dent_on_lines)
    ),
    Mistake(
        "any turns, not an odd number",
        "It asks whether the shape goes round H at all. Where sides cross it may go round twice: "
        "the middle of a five-pointed star drawn in one line is outside by the even-odd rule. Odd "
        "or even?",
        lambda corners, H: _turns(corners, H) != 0,
    ),
    Mistake(
        "one turn only",
        "It asks whether the shape goes round H once. Three turns are odd, too.",
        lambda corners, H: abs(_turns(corners, H)) == 1,
    ),
    Mistake(
        "one turn, counter-clockwise only",
        "It asks whether the shape goes round H once, counter-clockwise. Corners may be in either "
        "direction, and three turns are odd, too.",
        lambda corners, H: _turns(corners, H) == 1,
    ),
    Mistake(
        "counter-clockwise turns only",
        "The sum of the angles is negative where corners are clockwise. Take the number of turns "
        "without its sign, and ask whether it is odd.",
        lambda corners, H: _turns(corners, H) > 0,
    ),
    Mistake(
        "dents filled up",
        "It tests the rubber band around the corners, so a dent counts as inside.",
        _hull,
    ),
    Mistake(
        "two triangles together",
        "It joins triangles from the first corner. At a dent one of them covers more than the "
        "shape.",
        _two_triangles,
    ),
    Mistake(
        "a circle for the shape",
        "It compares distances from the middle.",
        _circle,
    ),
    Mistake(
        "the closing side left out",
        "The side from the last corner back to the first is missing.",
        _open_chain,
    ),
    Mistake(
        "outside always",
        "It says outside whatever comes. A whole line crosses the border an even number of times: "
        "count to one side of H only. The same happens to a sum of angles that are not wrapped.",
        lambda corners, H: False,
    ),
    Mistake("inside always", "It says inside whatever comes.", lambda corners, H: True),
    Mistake(
        "any crossing",
        "It asks whether the ray crosses a side at all. A ray that starts outside may cross two.",
        lambda corners, H: _count(corners, H) > 0,
    ),
    Mistake(
        "one crossing only",
        "Three crossings are odd, too.",
        lambda corners, H: _count(corners, H) == 1,
    ),
    Mistake(
        "the last side decides",
        "Each side at the height of H overwrites what the sides before it said. Toggle: "
        "odd = not odd.",
        _last_decides,
    ),
    Mistake(
        "rising sides only",
        "It counts the sides that go up and leaves out those that go down.",
        _crossed(lambda y0, y, y1: y0 <= y < y1),
    ),
    Mistake(
        "rising sides only",
        "It counts the sides that go up and leaves out those that go down.",
        _crossed(lambda y0, y, y1: y0 < y <= y1),
    ),
    Mistake(
        "falling sides only",
        "It counts the sides that go down and leaves out those that go up.",
        _crossed(lambda y0, y, y1: y1 <= y < y0),
    ),
    Mistake(
        "falling sides only",
        "It counts the sides that go down and leaves out those that go up.",
        _crossed(lambda y0, y, y1: y1 < y <= y0),
    ),
    Mistake(
        "two unlike questions to the ends of a side",
        "It asks >= of one end and > of the other. Where a corner is level with H its "
        "two sides disagree. Ask the same of both: (y0 > y) != (y1 > y).",
        _crossed(lambda y0, y, y1: (y0 >= y) != (y1 > y)),
    ),
    Mistake(
        "sides on the left and on the right",
        "It asks whether there are sides on both sides of H. So it is between two teeth of a comb, "
        "too. Count those of one direction: odd or even?",
        _every_way(("left", "right")),
    ),
    Mistake(
        "sides above and below",
        "It asks whether there are sides above H and below it. So it is in a dent, too. Count "
        "those of one direction: odd or even?",
        _every_way(("up", "down")),
    ),
    Mistake(
        "sides in every direction",
        "It asks whether there are sides to the left, to the right, above and below. So it is in a "
        "bay, too. Count those of one direction: odd or even?",
        _every_way(tuple(TOWARDS)),
    ),
    Mistake(
        "angles without their sign",
        "It adds the angles under which H sees the sides, all of them positive. At a dent the "
        "shape turns back: there they count negative.",
        lambda corners, H: abs(_unsigned(corners, H) - 1) < 1e-6,
    ),
    Mistake(
        "angles without their sign",
        "It adds the angles under which H sees the sides, all of them positive. At a dent the "
        "shape turns back: there they count negative.",
        lambda corners, H: _unsigned(corners, H) > 1 - 1e-6,
    ),
    Mistake(
        "two sides left out",
        "The first and the closing side are missing: it goes from the second corner to the last.",
        lambda corners, H: _open_chain(corners[1:], H),
    ),
    Mistake(
        "even for odd",
        "Inside and outside are exchanged.",
        lambda corners, H: _count(corners, H) % 2 == 0,
    ),
    Mistake(
        "a corner counts twice",
        "Where the ray meets a corner, both sides there count. Take one end of a side with it and "
        "leave the other: (y0 > y) != (y1 > y).",
        _spans(lambda low, y, high: low <= y <= high),
    ),
    Mistake(
        "a corner counts twice, or not at all",
        "Where the ray meets a corner, both sides there count or neither does: an even number "
        "where the border is crossed once. Take one end of a side with it: (y0 > y) != (y1 > y).",
        _spans(lambda low, y, high: low < y < high),
    ),
    Mistake(
        "a corner for the crossing",
        "It compares H with the first corner of a side, not with the place where the ray crosses "
        "it.",
        _by_corner(lambda a, b: a),
    ),
    Mistake(
        "the far end for the crossing",
        "It compares H with the right end of a side, not with the place where the ray crosses it.",
        _by_corner(max),
    ),
    Mistake(
        "the middle for the crossing",
        "It compares H with the middle of a side, not with the place where the ray crosses it.",
        _by_corner(lambda a, b: (a + b) / 2),
    ),
    Mistake(
        "slope upside down",
        "On a side x changes by (x1 - x0) / (y1 - y0) for each metre of height; it takes the "
        "inverse.",
        _upside_down,
    ),
    Mistake(
        "lines for sides",
        "It counts where the ray crosses the endless lines. A side ends at its corners.",
        _lines,
    ),
    Mistake(
        "x and y exchanged",
        "x and y of H are exchanged.",
        lambda corners, H: _count(corners, H[::-1]) % 2 == 1,
    ),
    Mistake(
        "four corners only",
        "The number of corners is built in. Here come three, five and eight, too.",
        _first_four,
    ),
)
INSIDE_MISTAKES = (
    *RIGHTWARD_MISTAKES,
    *(
        Mistake(mistake.name, mistake.says, _ray(way, mistake.program))
        for mistake in RIGHTWARD_MISTAKES
        for way in ("left", "up", "down")
        if mistake.name in OTHER_RAYS
    ),
)


# --- 2: a path of one's own, past a bar -----------------------------------------------------------

KEPT = 0.1  # m: asked for in the exercise
BETWEEN = 0.02  # m: between the points at which the bar is measured; KEPT is right to 0.5 mm
MOST_POSTURES = 12
UNITS = {
    "start": ("° (gamma, beta, alpha)", 1.0),
    "target": ("m", 1.0),
    "bar": ("m, its two ends", 1.0),
    "distance": ("mm", mm),
    "most": ("° of movement S at most, held in radians", deg),
}


def given(who: Any) -> Numbers:
    """A start, a target, and a bar in between, far enough out for the folded arm."""
    return Numbers(dict(_task(normalised(who))), UNITS)


@cache
def _task(who: str) -> Mapping[str, Any]:
    roll = dice(LAB, who)
    while True:
        start = np.array([100 + 5 * roll.randrange(7), 110 + 5 * roll.randrange(7), 120.0])
        start[2] += 5 * roll.randrange(5)
        around, out = (10 + 5 * roll.randrange(5)) * deg, 1.8 + 0.1 * roll.randrange(6)
        target = np.round([out * np.cos(around), out * np.sin(around)], 2)
        direct = _direct(start * deg, target)
        if np.isnan(direct).any():
            continue
        A, K_ = ARM.points(along(direct, 0.3 + 0.1 * roll.randrange(4)))[2:]
        first = np.round(A + (0.4 + 0.1 * roll.randrange(5)) * (K_ - A), 2)
        far, angle = 1.2 + 0.05 * roll.randrange(19), (40 + 5 * roll.randrange(8)) * deg
        bar = np.stack([first, np.round([far * np.cos(angle), far * np.sin(angle)], 2)])
        places = _bar(bar)
        room = [np.hypot(*places.T) - 1.1, np.hypot(*(places - target).T) - 0.15]
        room += [_distances(start[None] * deg, place).min() - 0.15 for place in places[::5]]
        if np.hypot(*(bar[1] - bar[0])) < 0.4 or min(map(np.min, room)) < 0:
            continue
        least = _cheapest(start * deg, target, places)
        if least is None or _ends_are_enough(start * deg, target, bar):
            continue
        return {
            "start": tuple(start.tolist()),
            "target": tuple(target.tolist()),
            "bar": tuple(tuple(end.tolist()) for end in bar),
            "distance": KEPT,
            "most": (10 * np.ceil(least / deg / 10) + 30) * deg,
        }


def _bar(ends: Any) -> Floats:
    """Points (m, 2) of a bar, with its ends."""
    first, last = np.asarray(ends)
    count = int(np.hypot(*(last - first)) / BETWEEN) + 2
    points: Floats = first + np.linspace(0, 1, count)[:, None] * (last - first)
    return points


def _ends_are_enough(q0: Floats, target: Floats, bar: Floats) -> bool:
    """Whether a way round both ends of the bar keeps half of the distance from all of it."""
    path = way_round(ARM, q0, target, bar, KEPT)
    return path is not None and bool(clearance(ARM, path, _bar(bar)).min() > KEPT / 2)


def _cheapest(q0: Floats, target: Floats, places: Floats) -> float | None:
    """The movement of the cheapest fold, swing, unfold of some; None: none of them keeps the
    distance.
    """
    low, high = ARM.alpha_range(target)
    if not low < high:
        return None
    folds = np.array([(b, a) for b in (45, 75, 105) for a in (45, 75, 105)]) * deg
    paths = np.array(
        [
            [q0, [q0[0], *fold], [goal[0], *fold], goal]
            for goal in ARM.family(target, np.linspace(low, high, 5)[::2])
            for fold in folds
        ]
    )
    S = abs(np.diff(paths, axis=1)).sum(axis=(1, 2))
    far = np.ones(len(paths), dtype=bool)
    shares = np.linspace(0, 1, 16)[:, None]
    for k in range(3):
        a, b = paths[:, k, None], paths[:, k + 1, None]
        seen = (a + shares * (b - a)).reshape(-1, 3)
        for place in places[::4]:
            near = _distances(seen, place).min(axis=-1).reshape(len(paths), -1)
            far &= near.min(axis=-1) >= KEPT + 0.03
            if not far.any():
                return None
    for path, cost in sorted(zip(paths[far], S[far], strict=True), key=lambda pair: pair[1]):
        if clearance(ARM, path, places).min() >= KEPT:
            return float(cost)
    return None


def _path_form(answer: Any, given: Mapping[str, Any]) -> Floats:
    """Postures (k, 3)."""
    wanted = "wanted a path: two or more postures (gamma, beta, alpha), (k, 3) radians"
    if isinstance(answer, (str, Mapping)):
        raise ValueError(f"{wanted}, got {words(answer)}")
    try:
        path = floats([[x for x in row] for row in answer])
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {words(answer)}") from None
    if path.ndim != 2 or path.shape[1:] != (3,) or len(path) < 2:
        raise ValueError(f"{wanted}, got shape {path.shape}")
    if not np.isfinite(path).all():
        raise ValueError(f"{wanted}, got NaN in it")
    if len(path) > 100:
        raise ValueError(f"{wanted}, at most 100 of them, got {len(path)}")
    return path


def _path_faults(path: Floats, given: Mapping[str, Any]) -> list[Fault]:
    """Begins at the start; ends at the target; inside the limits; the distance from the ends of the
    bar, and from what is between them; movement.
    """
    start = np.array(given["start"]) * deg
    if abs(path).max() > 4 * np.pi:
        return [("degrees for radians", DEGREES)] * 6
    if abs(path).max() <= 2 * np.pi * deg:
        return [
            ("deg twice", "All angles are 6° and less; an angle of 120° is 120 * deg, once.")
        ] * 6
    faults: list[Fault] = []
    if abs(path[0] - start).max() > 1e-4:
        stands, got = apart(given["start"], path[0] / deg)
        says = f"The path begins at ({got})°, the arm stands at ({stands})°."
        if abs(path[-1] - start).max() <= 1e-4:
            says += " There the path ends."
        elif abs(path[0, ::-1] - start).max() <= 1e-4:
            says += " These are its angles in the order alpha, beta, gamma."
        faults.append(("another start", says))
    end = ARM.points(path[-1])[3]
    miss = float(np.hypot(*(end - given["target"])))
    if miss > 1 * mm:
        says = f"The gripper ends at ({end[0]:.3f}, {end[1]:.3f}) m, {miss / mm:.0f} mm from "
        faults.append(("misses the target", says + f"the target {given['target']} m."))
    if (path < -1e-6).any() or (path > np.pi + 1e-6).any():
        i, j = np.argwhere((path < -1e-6) | (path > np.pi + 1e-6))[0]
        name = ("gamma", "beta", "alpha")[j]
        limit = 0.0 if path[i, j] < 0 else 180.0
        is_at = apart(path[i, j] / deg, limit)[0]
        says = f"Posture {i + 1}: {name} is {is_at}°, allowed are 0 to 180°."
        faults.append(("past a limit", says))
    bar = _bar(given["bar"])
    faults += _too_near(path, bar[[0, -1]], "the ends of the bar", given["distance"])
    faults += _too_near(path, bar[1:-1], "the bar between its ends", given["distance"])
    S = float(abs(np.diff(path, axis=0)).sum())
    if S > given["most"] + 1e-9:
        moved, most = apart(S / deg, given["most"] / deg)
        says = f"S is {moved}°, at most {most}° are allowed."
        faults.append(("too much movement", says))
    return faults


def _too_near(path: Floats, places: Floats, name: str, distance: float) -> list[Fault]:
    turn = abs(np.diff(path, axis=0)).sum()
    if turn > 200:
        return [("too much movement", "The joints turn round and round.")]
    least = clearance(ARM, path, places)
    if least.min() >= distance - 1e-5:
        return []
    part, lever = np.unravel_index(least.argmin(), least.shape)
    near, wanted = apart(least.min() / mm, distance / mm, 0)
    points = ARM.points(along(path, np.linspace(0, 1, 501)))[:, 3]
    gripper = float(np.hypot(*(points[:, None] - places).T).min())
    corners = min(float(_distances(path, place).min()) for place in places)
    says = (
        f"Between postures {part + 1} and {part + 2} lever {('OB', 'BA', 'AK')[lever]} comes as "
        f"near as {near} mm to {name}; wanted are {wanted} mm."
    )
    if corners >= distance:
        says += f" Every posture of the path keeps {corners / mm:.0f} mm: look at the way between."
        if gripper >= distance:
            says += " The gripper keeps it on the way, a lever does not."
        return [(f"{name}: too near between two postures", says)]
    if gripper >= distance:
        says += " The gripper keeps it, a lever does not."
        return [(f"{name}: the gripper passes, a lever does not", says)]
    return [(f"too near to {name}", says)]


# --- 3: a test for checks -------------------------------------------------------------------------


def _joints(q: Floats) -> Floats:
    """O, B, A, K of postures (n, 3): (n, 4, 2). Quick, without any check."""
    direction = np.cumsum(q, axis=-1) - np.array([0, np.pi, 2 * np.pi])
    steps = L * np.stack([np.cos(direction), np.sin(direction)], axis=-1)
    return np.concatenate([np.zeros((len(q), 1, 2)), steps.cumsum(axis=-2)], axis=-2)


def _distances(q: Floats, H: Any, clip: tuple[float, float] = (0, 1)) -> Floats:
    """Of H from the levers in postures (n, 3): (n, 3). Without an end: `clip` to infinity."""
    points = _joints(q)
    P, way = points[:, :-1], np.diff(points, axis=1)
    share = np.clip(((H - P) * way).sum(axis=-1) / L**2, *clip)
    gap = P + share[..., None] * way - H
    found: Floats = np.hypot(gap[..., 0], gap[..., 1])
    return found


def _sampled(path: Any, count: int, ends: bool = True) -> Floats:
    """Postures along every part: (m, 3)."""
    path = np.asarray(path, dtype=float)
    s = np.linspace(0, 1, count) if ends else (np.arange(count) + 0.5) / count
    return np.concatenate([a + s[:, None] * (b - a) for a, b in zip(path, path[1:], strict=False)])


FINE = 301


def _fine(path: Any, H: Any, distance: float) -> bool:
    return bool(_distances(_sampled(path, FINE), H).min() >= distance)


def _bounded(path: Any, H: Any, distance: float) -> bool:
    path = np.asarray(path, dtype=float)
    return bool(keeps(ARM, path[:-1], path[1:], H, distance).all())


def _halving(path: Any, H: Any, distance: float) -> bool:
    path = np.asarray(path, dtype=float)
    parts = np.stack([path[:-1], path[1:]], axis=1)
    for _ in range(30):
        d = _distances(parts.reshape(-1, 3), H).min(axis=-1).reshape(-1, 2)
        if (d < distance).any():
            return False
        move = abs(parts[:, 1] - parts[:, 0]) @ np.array([3.0, 2.0, 1.0]) * L
        parts = parts[(d.sum(axis=-1) - move) / 2 < distance]
        if not len(parts):
            return True
        middle = parts.mean(axis=1)
        parts = np.concatenate(
            [np.stack([parts[:, 0], middle], 1), np.stack([middle, parts[:, 1]], 1)]
        )
    return False


def _plain(path: Any, H: Any, distance: float) -> bool:
    """Part after part, and it stops at the first that is too near."""
    for a, b in zip(path, list(path)[1:], strict=False):
        if float(_distances(_sampled([a, b], FINE), H).min()) < distance:
            return False
    return True


def _of(measure: Callable[[Floats, Any], Any], count: int = FINE) -> Program:
    return lambda path, H, distance: bool(np.min(measure(_sampled(path, count), H)) >= distance)


def _chord(path: Any, H: Any, distance: float) -> bool:
    """The gripper on straight lines between the via points."""
    places = _joints(np.asarray(path, dtype=float))[:, 3]
    pairs = zip(places, places[1:], strict=False)
    return min(_to_segment(P, Q + 1e-12, np.asarray(H, dtype=float)) for P, Q in pairs) >= distance


def _corners_near(q: Floats, H: Any) -> Floats:
    points = _joints(q)[:, 1:] - H
    found: Floats = np.hypot(points[..., 0], points[..., 1])
    return found


def _short_parts(path: Any, H: Any, distance: float) -> bool:
    """Nothing is promised for longer parts."""
    longest = abs(np.diff(np.asarray(path, dtype=float), axis=0)).max()
    return bool(longest <= 90 * deg + 1e-6) and _bounded(path, H, distance)


RIGHT_CHECKS: tuple[tuple[str, Program], ...] = (
    ("robokin's keeps, which proves the distance", _bounded),
    (
        f"{FINE} postures of every part, all levers, answered with NumPy's True and False",
        lambda path, H, distance: np.bool_(_fine(path, H, distance)),
    ),
    ("motions halved until a bound decides", _halving),
    ("part after part, up to the first that is too near", _plain),
    (
        "it says no up to 18 mm above the distance asked for, as promised: within 20 mm it may",
        lambda path, H, distance: _bounded(path, H, distance + 18 * mm),
    ),
    (
        "it says yes down to 18 mm below the distance asked for, as promised: within 20 mm it may",
        lambda path, H, distance: _halving(path, H, distance - 18 * mm),
    ),
    ("it says no wherever a joint turns by more than 90° in a part, as promised", _short_parts),
)


class _Late:
    """Answers each time with what it found the time before."""

    def __init__(self, first: bool) -> None:
        self.first = self.found = first

    def __call__(self, path: Any, H: Any, distance: float) -> bool:
        before, self.found = self.found, _fine(path, H, distance)
        return before

    def anew(self) -> Program:
        """One that has not been called."""
        return _Late(self.first)


CHECK_MISTAKES = (
    Mistake(
        "the gripper only",
        "It looks at the gripper alone: a lever behind it may sweep the obstacle. A test finds "
        "that with tasks in which only a lever, and not the gripper, comes too near.",
        _of(lambda q, H: _corners_near(q, H)[:, 2]),
    ),
    Mistake(
        "the gripper on straight lines",
        "It takes straight lines between the gripper's places, and forgets the levers.",
        _chord,
    ),
    Mistake(
        "joints and gripper only",
        "It looks at the ends of the levers. Put an obstacle beside the middle of one.",
        _of(_corners_near),
    ),
    Mistake(
        "the last lever only",
        "It looks at lever AK alone. Let OB or BA come near an obstacle.",
        _of(lambda q, H: _distances(q, H)[:, 2]),
    ),
    Mistake(
        "the first lever left out",
        "It leaves out lever OB. Put an obstacle 0.5 m from the base.",
        _of(lambda q, H: _distances(q, H)[:, 1:]),
    ),
    Mistake(
        "the middle lever left out",
        "It leaves out lever BA. Let BA, and it alone, come near an obstacle.",
        _of(lambda q, H: _distances(q, H)[:, [0, 2]]),
    ),
    Mistake(
        "endless lines for levers",
        "It measures to the endless line through a lever, and so says no where the lever ends "
        "before the obstacle. A safe path whose lever points at an obstacle shows it.",
        _of(lambda q, H: _distances(q, H, (-np.inf, np.inf))),
    ),
    Mistake(
        "lines that do not end at the gripper",
        "A lever goes on past its far end here. A safe path whose gripper points at an obstacle "
        "shows it.",
        _of(lambda q, H: _distances(q, H, (0, np.inf))),
    ),
    Mistake(
        "the postures only",
        "It looks at the postures of the path, not at the way between them.",
        _of(_distances, 2),
    ),
    Mistake(
        "the middle of each part, too",
        "Start, middle and end of a part are three postures of it: put an obstacle where the arm "
        "is at a quarter of the way.",
        _of(_distances, 3),
    ),
    Mistake(
        "five postures of each part",
        "It looks at five postures of each part. Take a long motion, with an obstacle at one "
        "eighth of the way.",
        _of(_distances, 5),
    ),
    Mistake(
        "nine postures of each part",
        "It looks at nine postures of each part. Take a long motion, with an obstacle between two "
        "of them, and a small distance.",
        _of(_distances, 9),
    ),
    Mistake(
        "the first part only",
        "It stops after the first part of the path. Take paths of three postures and more.",
        lambda path, H, distance: _fine(path[:2], H, distance),
    ),
    Mistake(
        "the last part only",
        "It looks at the last part of the path only. Take paths of three postures and more.",
        lambda path, H, distance: _fine(path[-2:], H, distance),
    ),
    Mistake(
        "straight from the first to the last posture",
        "It leaves the via postures out.",
        lambda path, H, distance: _fine([path[0], path[-1]], H, distance),
    ),
    Mistake(
        "touching only",
        "It says no only where a lever sweeps the obstacle: the distance makes no difference.",
        lambda path, H, distance: _fine(path, H, 0.01),
    ),
    Mistake(
        "half the distance",
        "It keeps half of the distance: radius and diameter are confused.",
        lambda path, H, distance: _fine(path, H, distance / 2),
    ),
    Mistake(
        "twice the distance",
        "It asks for twice the distance: it refuses paths that are safe.",
        lambda path, H, distance: _fine(path, H, 2 * distance),
    ),
    Mistake(
        "squares and lengths compared",
        "It compares the square of the distance with the distance.",
        lambda path, H, distance: bool(_distances(_sampled(path, FINE), H).min() ** 2 >= distance),
    ),
    Mistake(
        "one safe moment is enough",
        "It takes the greatest distance on the way for the least.",
        lambda path, H, distance: bool(
            _distances(_sampled(path, FINE), H).min(axis=-1).max() >= distance
        ),
    ),
    Mistake(
        "one safe lever is enough",
        "It takes the lever that is farthest away, not the nearest one.",
        lambda path, H, distance: bool(
            _distances(_sampled(path, FINE), H).min(axis=0).max() >= distance
        ),
    ),
    *(
        Mistake(
            name,
            "It answers with what it found for the motion before, so it says yes as often as a "
            "right program. Compare each answer with the right one; do not count.",
            _Late(first),
        )
        for name, first in (("one motion late", True), ("one motion late, at first no", False))
    ),
    Mistake(
        "yes and no exchanged",
        "It says True where the arm comes too near.",
        lambda path, H, distance: not _fine(path, H, distance),
    ),
)


# --- Predictions: numbers and views ---------------------------------------------------------------

COLORS = ("#0072B2", "#D55E00", "#009E73")


def _direct(start: Floats = START, target: Floats = K1) -> Floats:
    return np.stack([start, ARM.least(target, start)[0]])


def _draw(ax: Any, q: Floats, label: str, **style: Any) -> None:
    points = ARM.points(q)
    ax.plot(*points.T, marker="o", mfc="white", ms=5, lw=2, label=label, **style)


def _plane(ax: Any, low: tuple[float, float], high: tuple[float, float], title: str) -> None:
    ax.set(aspect="equal", xlim=(low[0], high[0]), ylim=(low[1], high[1]), title=title)
    ax.set(xlabel="x, m", ylabel="y, m")


@cache
def _drawing_facts() -> dict[str, Any]:
    rng, count = np.random.default_rng(5), 1500
    before = rng.uniform(0, np.pi, (count, 3))
    r, phi = rng.uniform(1.1, 2.9, count), rng.uniform(0, 120, count) * deg
    targets = np.stack([r * np.cos(phi), r * np.sin(phi)], axis=-1)
    after = ARM.least(targets, before)[0]
    inside = found = 0
    for a, b in zip(ARM.points(before)[:, 2:], ARM.points(after)[:, 2:], strict=True):
        corners = np.array([*a, *b[::-1]])
        H = rng.uniform(corners.min(axis=0), corners.max(axis=0))
        if _count(corners, H) % 2 == 1:
            inside += 1
            found += _drawing(corners, H)
    share = 100 * found / inside
    own = own_found = 0
    for start, target, H in sampled_tasks():
        (A, K_), (A1, K1_) = ARM.points(_direct(start, target))[:, 2:]
        if _count([A, K_, K1_, A1], H) % 2 == 1:
            own += 1
            own_found += _drawing([A, K_, K1_, A1], H)
    return {
        "inside": inside,
        "found": found,
        "share": share,
        "tasks": count,
        "own": own,
        "own_found": own_found,
    }


def _drawing_right(facts: Mapping[str, Any]) -> int:
    return int(np.argmin([abs(guess - facts["share"]) for guess in (98, 50, facts["share"], 25)]))


def _drawing_view() -> Any:
    from ..show import figure

    fig = figure(
        "The same quadrilateral four times: as drawn, turned by a quarter, mirrored, and upside "
        "down. The obstacle is in its middle each time, and the test finds it in the first only.",
        height=2.9,
    )
    drawn = np.array([(-0.5, 0.4), (0.45, 0.6), (0.55, -0.6), (-0.4, -0.5)])
    shapes = {
        "as drawn": drawn,
        "a quarter turn": drawn @ np.array([(0, 1), (-1, 0)]),
        "mirrored": drawn * (-1, 1),
        "upside down": drawn * (1, -1),
    }
    for ax, (name, corners) in zip(fig.subplots(1, 4), shapes.items(), strict=True):
        ax.fill(*corners.T, facecolor="#CFE3F1")
        for k, (label, dash) in enumerate((("AK", "-"), ("A1K1", ":"))):
            side = corners[[0, 1]] if k == 0 else corners[[3, 2]]
            ax.plot(*side.T, color=COLORS[k], ls=dash, lw=3, label=label)
        says = _drawing(corners, np.zeros(2))
        ax.plot(0, 0, "X", color="black", ms=9)
        ax.text(0, -0.3, "found" if says else "missed", ha="center")
        ax.set(aspect="equal", title=name, xticks=[], yticks=[], xlim=(-0.8, 0.8), ylim=(-0.8, 0.8))
    fig.axes[0].legend(loc="upper left", fontsize=8)
    fig.tight_layout()
    return fig


def _swept_by_last(start: Floats, end: Floats, points: Floats) -> Bools:
    """Which points (n, 2) lever AK passes over: they change sides beside its length."""
    s = np.linspace(0, 1, 301)[:, None]
    joints = ARM.points(start + s * (end - start))[:, :, None]
    P, Q = joints[:, 2], joints[:, 3]
    (dx, dy), (x, y) = np.moveaxis(Q - P, -1, 0), np.moveaxis(points - P, -1, 0)
    left, share = dx * y - dy * x > 0, (dx * x + dy * y) / L**2
    beside = (share >= 0) & (share <= 1)
    over: Bools = ((left[1:] != left[:-1]) & beside[1:] & beside[:-1]).any(axis=0)
    return over


FINE_STEP = 0.02  # m: areas are counted on a grid
STEP = 0.04  # m, of the points that are drawn
GRID = np.stack(np.meshgrid(np.arange(-1.6, 3, STEP), np.arange(-1, 3, STEP)), axis=-1).reshape(
    -1, 2
)


@cache
def _sweep_facts() -> dict[str, Any]:
    start, end = _direct(FAR)
    places = ARM.points(along(_direct(FAR), np.linspace(0, 1, 201)))[:, 2:].reshape(-1, 2)
    low, high = places.min(axis=0), places.max(axis=0)
    fine = np.stack(np.meshgrid(*map(np.arange, low, high, (FINE_STEP,) * 2)), axis=-1)
    fine = fine.reshape(-1, 2)
    over = _swept_by_last(start, end, fine)
    quad = in_quadrilateral(ARM, start, end, fine)["AK"]
    missed, area = over & ~quad, FINE_STEP**2
    return {
        "turn": float(abs(end - start).sum() / deg),
        "share": float(100 * missed.sum() / over.sum()),
        "swept": float(over.sum() * area),
        "missed": float(missed.sum() * area),
        "false": float((quad & ~over).sum() * area),
        "grid": FINE_STEP / mm,
    }


def _sweep_right(facts: Mapping[str, Any]) -> int:
    guesses = (0.0, 5.0, 35.0, facts["share"])
    return int(np.argmin([abs(guess - facts["share"]) for guess in guesses]))


def _sweep_view() -> Any:
    from ..show import figure

    fig = figure(
        "The area that lever AK sweeps in the longer motion, and the quadrilateral between its "
        "first and its last place: most of the area lies outside.",
        height=3.8,
    )
    ax = fig.subplots()
    start, end = _direct(FAR)
    over = _swept_by_last(start, end, GRID)
    quad = in_quadrilateral(ARM, start, end, GRID)["AK"]
    ax.plot(*GRID[over & ~quad].T, "s", ms=3.2, color="#E08A4A", label="swept, outside")
    ax.plot(*GRID[over & quad].T, "s", ms=3.2, color="#A9CCE3", label="swept, inside")
    corners = np.stack([*ARM.points(start)[2:], *ARM.points(end)[:1:-1]])
    ax.fill(*corners.T, facecolor="none", edgecolor="black", ls="--", label="quadrilateral")
    _draw(ax, start, "before", color="black")
    _draw(ax, end, "after", color=COLORS[2])
    _plane(ax, (-1.6, -0.2), (3.6, 2.3), "Most of what AK sweeps lies outside the quadrilateral")
    ax.legend(loc="upper right", fontsize=8)
    fig.tight_layout()
    return fig


P_LEVER, Q_LEVER, H_LEVER = np.zeros(2), np.array([1.0, 0.0]), np.array([1.3, 0.4])


def _lever_facts() -> dict[str, Any]:
    P, Q, H = P_LEVER, Q_LEVER, H_LEVER
    return {
        "x": H[0],
        "y": H[1],
        "right": _to_segment(P, Q, H) / mm,
        "line": abs(H[1]) / mm,
        "start": float(np.hypot(*(H - P)) / mm),
        "middle": float(np.hypot(*(H - (P + Q) / 2)) / mm),
        "beside": (H[0] - Q[0]) / mm,
        "sum": float(abs(H - Q).sum() / mm),
        "square": float(((H - Q) ** 2).sum() / mm),
    }


def _lever_view() -> Any:
    from ..show import figure

    fig = figure(
        "A lever from the origin to (1, 0) m. The obstacle lies beyond its end: the nearest place "
        "of the lever is the end, half a metre away; the line through the lever is nearer.",
        height=2.6,
    )
    ax = fig.subplots()
    P, Q, H = P_LEVER, Q_LEVER, H_LEVER
    ax.plot(*np.array([P, Q]).T, color=COLORS[0], lw=6, solid_capstyle="round")
    ax.plot([1, 1.6], [0, 0], "--", color="0.6")
    ax.plot(*H, "X", color="black", ms=10)
    facts = _lever_facts()
    for foot, name, color in ((Q, "right", COLORS[1]), ((H[0], 0), "line", "0.5")):
        ax.annotate(
            "", (foot[0], foot[1]), (H[0], H[1]), arrowprops={"arrowstyle": "<->", "color": color}
        )
        x, y = (np.array(foot) + H) / 2
        side = "right" if name == "right" else "left"
        ax.text(x, y, f"  {facts[name]:.0f} mm  ", color=color, ha=side, va="center")
    _plane(ax, (-0.1, -0.15), (1.8, 0.55), "Beyond the end of a lever its end is the nearest place")
    fig.tight_layout()
    return fig


SAMPLED = np.array([1.7, 1.0])  # m: the obstacle of p4
SEEN = 7


@cache
def _sample_facts() -> dict[str, Any]:
    path = _direct(FAR)
    seen = float(_distances(_sampled(path, SEEN), SAMPLED).min())
    true = float(clearance(ARM, path, SAMPLED).min())
    return {
        "count": SEEN,
        "x": SAMPLED[0],
        "y": SAMPLED[1],
        "seen": seen / mm,
        "wanted": WANTED / mm,
        "true": true / mm,
        "less": (seen - true) / mm,
    }


def _sample_right(facts: Mapping[str, Any]) -> int:
    return int(np.argmin([abs(facts["seen"] - x - facts["true"]) for x in (0, 5, facts["less"])]))


def _sample_view() -> Any:
    from ..show import figure

    fig = figure(
        "Distance of the nearest lever from the obstacle on the whole motion: a valley between "
        "two of the seven dots reaches far below all of them.",
        height=3.2,
    )
    ax = fig.subplots()
    path, s = _direct(FAR), np.linspace(0, 1, 601)
    fine = _distances(_sampled(path, 601), SAMPLED).min(axis=-1)
    ax.plot(100 * s, fine, color=COLORS[0], lw=2)
    dots = _distances(_sampled(path, SEEN), SAMPLED).min(axis=-1)
    ax.plot(100 * np.linspace(0, 1, SEEN), dots, "o", color="black", ms=7)
    ax.axhspan(0, WANTED, color="0.88")
    ax.set(xlabel="share of the motion, %", ylabel="nearest lever, m", ylim=(0, None))
    ax.set_title("The valley lies between two of the samples")
    fig.tight_layout()
    return fig


PASSED = np.array([1.0, 1.5])  # m: the obstacle of p5
ROUND = np.array([1.2, 1.3])  # m: that of section 6


@cache
def _via_facts() -> dict[str, Any]:
    path = via_path(ARM, START, K1, PASSED)
    points = ARM.points(path)[1:3, 3]
    ways = ARM.points(along(path, np.linspace(0, 1, 2001)))[:, 3] - PASSED
    least = clearance(ARM, path, PASSED).min(axis=0)
    far = clearance(ARM, via_path(ARM, START, K1, (1.5, 1.0)), (1.5, 1.0))
    return {
        "far": float(far.min() / mm),
        "other_x": ROUND[0],
        "other_y": ROUND[1],
        "x": PASSED[0],
        "y": PASSED[1],
        "r": WANTED / mm,
        "gripper": float(np.hypot(*ways.T).min() / mm),
        "at": float(np.hypot(*(points - PASSED).T).min() / mm),
        "OB": least[0] / mm,
        "BA": least[1] / mm,
        "AK": least[2] / mm,
    }


def _via_right(facts: Mapping[str, Any]) -> int:
    levers = [facts[name] for name in ("OB", "BA", "AK")]
    if min(levers) >= facts["r"]:
        return 0
    return 3 if max(levers[1:]) <= 1 else 2 if levers[2] <= 1 else 1


def _via_view() -> Any:
    from ..show import figure

    fig = figure(
        "Sixty moments of the path through two via points. The gripper comes as near to the "
        f"obstacle as {_via_facts()['gripper']:.0f} mm, inside the circle; the lever AK passes "
        "over it.",
        height=4,
    )
    ax = fig.subplots()
    path = via_path(ARM, START, K1, PASSED)
    for q in along(path, np.linspace(0, 1, 60)):
        ax.plot(*ARM.points(q).T, color="0.8", lw=0.6, zorder=0)
    _draw(ax, path[0], "start", color="black")
    _draw(ax, path[-1], "target", color=COLORS[2], ls=":")
    ways = ARM.points(along(path, np.linspace(0, 1, 400)))[:, 3]
    ax.plot(*ways.T, color=COLORS[0], lw=2, label="gripper")
    angle = np.linspace(0, 2 * np.pi, 100)
    ax.plot(PASSED[0] + WANTED * np.cos(angle), PASSED[1] + WANTED * np.sin(angle), color="0.4")
    ax.plot(*PASSED, "X", color="black", ms=9, zorder=6)
    _plane(ax, (-1.2, -0.1), (2.9, 2.2), "The gripper goes round, lever AK goes over")
    ax.legend(loc="upper right", fontsize=8)
    fig.tight_layout()
    return fig


@cache
def _wave_facts() -> dict[str, Any]:
    """The wave of section 6, and the way that it has come."""
    size = 10 * deg
    angles = np.arange(19) * size
    cube = np.stack(np.meshgrid(angles, angles, angles, indexing="ij"), axis=-1)
    open_ = _distances(cube.reshape(-1, 3), ROUND).min(axis=-1).reshape(19, 19, 19) >= WANTED
    steps = []
    for j in range(3):
        a = np.moveaxis(cube, j, 0)
        steps.append(keeps(ARM, a[:-1], a[1:], ROUND, WANTED))
    begin = tuple(np.round(START / size).astype(int).tolist())
    goals = ARM.family(K1, np.linspace(*ARM.alpha_range(K1), 200))
    cells = np.round(goals / size).astype(int)
    ends = keeps(ARM, cells * size, goals, ROUND, WANTED)
    wanted = {tuple(cell) for cell in cells[ends].tolist()}
    came: dict[Any, Any] = {begin: None}
    front, count, end = [begin], 0, None
    while front and end is None:
        later = []
        for cell in front:
            for j in range(3):
                rest = cell[:j] + cell[j + 1 :]
                for move in (-1, 1):
                    at = cell[j] + move
                    other = (*cell[:j], at, *cell[j + 1 :])
                    if not 0 <= at < 19 or other in came or not open_[other]:
                        continue
                    if steps[j][(min(at, cell[j]), *rest)]:
                        came[other] = cell
                        later.append(other)
        front, count = later, count + 1
        end = next((cell for cell in front if cell in wanted), None)
    way, at = [], end
    while at is not None:
        way.append(cube[at])
        at = came[at]
    path = np.array(way[::-1])
    turns = abs(np.diff(path, axis=0)).sum(axis=0) / deg
    net = (path[-1] - path[0]) / deg
    return {
        "count": count,
        "sum": float(turns.sum()),
        "most": float(turns.max()),
        "straight": float(np.linalg.norm(net)),
        "net": float(abs(net.sum())),
        "turns": turns,
    }


def _wave_right(facts: Mapping[str, Any]) -> int:
    total = 10.0 * facts["count"]
    guesses = (facts["most"], facts["straight"], facts["sum"], facts["net"])
    return int(np.argmin([abs(total - guess) for guess in guesses]))


def _wave_view() -> str:
    facts = _wave_facts()
    turns = ", ".join(
        f"{name} {turn:.0f}°"
        for name, turn in zip(("gamma", "beta", "alpha"), facts["turns"], strict=True)
    )
    return (
        f"The wave arrives after {facts['count']} steps of 10°. Followed back, they turn {turns} "
        f"(to and fro both counted): together {facts['sum']:.0f}°."
    )


TASKS = 100
LARGER = 0.25


def sampled_tasks(count: int = TASKS) -> list[tuple[Floats, Floats, Floats]]:
    """Start, target and an obstacle on lever AK somewhere on the direct way; start, target and
    base keep L/7. The sample of section 7.
    """
    rng = np.random.default_rng(33)
    tasks: list[tuple[Floats, Floats, Floats]] = []
    while len(tasks) < count:
        r, phi = rng.uniform(1.2, 2.8, 2), rng.uniform(0, 130, 2) * deg
        P, target = np.stack([r * np.cos(phi), r * np.sin(phi)], axis=-1)
        if np.isnan(ARM.alpha_range(np.stack([P, target]))).any():
            continue
        start = ARM.family(P, rng.uniform(*ARM.alpha_range(P)))
        A, K_ = ARM.points(along(_direct(start, target), rng.random()))[2:]
        H = A + rng.random() * (K_ - A)
        near = _distances(start[None], H).min()
        if min(np.hypot(*H), np.hypot(*(target - H)), near) > WANTED:
            tasks.append((start, target, H))
    return tasks


@cache
def _often_facts() -> dict[str, Any]:
    keep = swept_ = out = 0
    for start, target, H in sampled_tasks():
        path = via_path(ARM, start, target, H, LARGER)
        if np.isnan(path).any():
            out += 1
            continue
        # samples suffice to say that it comes too near; `clearance` decides the others
        if _distances(_sampled(path, 41), H).min() < WANTED:
            swept_ += 1
        else:
            keep += bool(clearance(ARM, path, H).min() >= WANTED)
    passed = clearance(ARM, via_path(ARM, START, K1, ROUND, LARGER), ROUND)
    return {
        "passed": float(passed.min() / mm),
        "count": TASKS,
        "keep": keep,
        "out": out,
        "near": TASKS - keep - out,
        "r": LARGER / mm,
        "wanted": WANTED / mm,
    }


def _often_right(facts: Mapping[str, Any]) -> int:
    guesses = (0, facts["keep"], 65, 100)
    return int(np.argmin([abs(guess - facts["keep"]) for guess in guesses]))


def _often_view() -> str:
    facts = _often_facts()
    return (
        f"Of {facts['count']} tasks, with the circle of {facts['r']:.0f} mm: {facts['keep']} keep "
        f"{facts['wanted']:.0f} mm, {facts['near']} come nearer, {facts['out']} out of "
        f"reach.\nWith {WANTED / mm:.0f} mm a lever sweeps the obstacle in 47 tasks: none of "
        f"these keeps it now; in 53 no lever does: {facts['keep']} of these keep it now."
    )


NARROW = np.array([0.5, 1.0])  # m: the obstacle of p8
COARSE = 15


@cache
def _no_facts() -> dict[str, Any]:
    found = way_round(ARM, START, K1, NARROW, WANTED)
    S = np.nan if found is None else float(abs(np.diff(found, axis=0)).sum() / deg)
    sure = found is not None and bool(keeps(ARM, found[:-1], found[1:], NARROW, WANTED).all())
    return {
        "x": NARROW[0],
        "y": NARROW[1],
        "coarse": COARSE,
        "found": found is not None,
        "sure": sure,
        "S": S,
        "wanted": WANTED / mm,
        "direct": float(clearance(ARM, _direct(), NARROW).min() / mm),
    }


def _no_view() -> str:
    facts = _no_facts()
    return (
        f"The wave in steps of {facts['coarse']}°: no way found. Steps of 5°: a way with S = "
        f"{facts['S']:.0f}°, proven on its whole length."
    )


# --- The tables -----------------------------------------------------------------------------------

EXERCISES = {
    "1": Function(
        title="Inside or outside",
        task="Whether H lies inside the shape with these corners: True or False.",
        objective=1,
        hints=(
            "Walk from H to the right, for ever. Each time you cross a side you change from inside "
            "to outside or back. Far out you are outside. So what does the number of crossings "
            "tell?",
            "A side from (x0, y0) to (x1, y1) reaches the height of H if one of its ends is above "
            "and the other is not: (y0 > H[1]) != (y1 > H[1]). It is crossed to the right of H if "
            "the place x = x0 + (H[1] - y0) / (y1 - y0) * (x1 - x0) is greater than H[0]. Do not "
            "forget the side from the last corner to the first.",
            "odd = False; for each pair of a corner and the next one (np.roll(corners, -1, axis=0) "
            "has the next ones): if it is crossed, odd = not odd. Return odd.",
        ),
        inputs=("corners", "H"),
        right=_inside,
        cases=_inside_cases,
        form=_bool,
        law=_inside_law,
        same=lambda a, b: a == b,
        mistakes=INSIDE_MISTAKES,
    ),
    "2": Value(
        title="Past a bar",
        task="A path of your own past a bar: postures from the start to the target on which all "
        "levers keep the distance from all of the bar.",
        objective=2,
        hints=(
            "A bar is many points, and way_round takes many. Which points are enough, so that the "
            "levers cannot come nearer to what lies between two of them? Or go by hand: the folded "
            "arm, beta = alpha = 60°, is a triangle beside the base, where no bar of yours is.",
            "points = first + np.linspace(0, 1, 10)[:, None] * (last - first). If a lever keeps d "
            "from two points that are h apart, it keeps sqrt(d**2 - (h / 2)**2) from what is "
            "between them: so ask for a little more than the distance. By hand: path = [start, "
            "(gamma of the start, fold), (gamma of the end, fold), end].",
            "way_round(arm, start, target, points, 1.1 * distance) with start in radians. Measure "
            "its answer with clearance(arm, path, many_points).min(axis=1), which says which part "
            "is too near, and add up S. If it finds nothing, let loops try folds: beta and alpha "
            "from 45° to 120° in steps of 15°, and five alphas of the target's family.",
        ),
        form=_path_form,
        faults=_path_faults,
        count=6,
        given=given,
    ),
    "3": Catch(
        title="A test for checks",
        task="A test: whether the program safe(path, H, distance) judges motions rightly.",
        objective=3,
        hints=(
            "You need paths of which you know the truth: clearance(arm, path, H).min() has it. "
            "Then each wrong program is wrong on SOME path. Which path shows that the gripper "
            "alone was looked at? That the postures alone were?",
            "Draw many random tasks: paths of three postures, an obstacle beside a lever at a "
            "random moment of the way, moved aside a little. Ask for a distance 25 mm below the "
            "true one (the answer is True) and for one 25 mm above it (False).",
            "Make the tasks once, outside the function, since clearance takes time: 40 paths from "
            "rng.uniform(0.7, 2.2, (3, 3)), H = A + share * (B - A) of a random lever AB at a "
            "random moment, plus rng.normal(0, 0.15, 2). Return all(bool(safe(path, H, d)) == "
            "truth for ...).",
        ),
        rights=RIGHT_CHECKS,
        promise="A right program may be wrong only where the least distance on the way is within "
        "20 mm of the distance asked for, or where a joint turns by more than 90° in a part.",
        mistakes=CHECK_MISTAKES,
    ),
}

# Objective 1: p1, p2. Objective 2: p3, p5, p6, p7. Objective 3: p4, p8.
PREDICTIONS = {
    "p1": Prediction(
        question="We draw {tasks} motions: a first posture, all angles evenly from 0° to 180°; a "
        "target evenly 1.1 to 2.9 m from O, in a direction evenly from 0° to 120°; the second "
        "posture with the least S; and H evenly in the upright box round the quadrilateral. "
        "{inside} of these H lie inside the quadrilateral. How many of them does the test of this "
        "one drawing find?",
        options=(
            Option(
                "Nearly all: turning a drawing changes names, not the test.",
                "The test says which line is the upper one and which the left one. In another "
                "motion another line is. It finds {found} of {inside}.",
                "the drawing taken for the rule",
                "Let the arm go back from K1 to K: the same area, and now AK is the lower line.",
            ),
            Option(
                "About half: a line is either above or below.",
                "That would be one choice of two. Here two orders have to fit at once, and the "
                "sides have to slope the right way, too: {found} of {inside}.",
                "one condition of several counted",
                "A key that needs four pins in place does not open every second lock.",
            ),
            Option(
                "Few: fewer than one of ten.",
                "{found} of {inside}. Both pairs of lines have to be in the order of the drawing, "
                "and most of these motions have another one. Other draws give other shares: in the "
                "sample of section 7 H is inside {own} times, and the test finds {own_found}.",
            ),
            Option(
                "A quarter: four ways to turn the drawing, one of them fits.",
                "A drawing can be mirrored as well as turned, and levers are crossed or steep: "
                "{found} of {inside}.",
                "mirror images left out",
                "A left hand does not become a right one, however it is turned.",
            ),
        ),
        facts=_drawing_facts,
        right=_drawing_right,
        view=_drawing_view,
    ),
    "p2": Prediction(
        question="A longer motion: from (150°, 120°, 120°) to K1 = (1.9, 0.3) m with the least S, "
        "{turn:.0f}°. How much of the area that lever AK truly sweeps lies outside the "
        "quadrilateral A K K1 A1?",
        options=(
            Option(
                "Nothing: the quadrilateral joins the first and the last place.",
                "It joins them by straight lines, and joints move on arcs. {share:.0f} % lies "
                "outside.",
                "ends taken for the way",
                "A door sweeps a quarter of a disc, not the triangle between shut and open.",
            ),
            Option(
                "A narrow rim, about 5 %.",
                "The rim of a short motion is narrow. Here the curves of A and K bulge by 0.40 and "
                "0.47 m: {share:.0f} %.",
                "a short motion taken for all",
                "Between 12 and 1 o'clock chord and arc are close; between 12 and 6 they are not.",
            ),
            Option(
                "About a third.",
                "More: {missed:.2f} of {swept:.2f} m², that is {share:.0f} %.",
                "the bulge taken for too small",
                "The half disc above a diameter has all of its area outside the chord.",
            ),
            Option(
                "Most of it.",
                "{share:.0f} %: {missed:.2f} of {swept:.2f} m² lie outside; and of the "
                "quadrilateral {false:.2f} m² are never touched. (Counted on a grid of "
                "{grid:.0f} mm.)",
            ),
        ),
        facts=_sweep_facts,
        right=_sweep_right,
        view=_sweep_view,
    ),
    "p3": Prediction(
        question="A lever reaches from (0, 0) to (1, 0) m. The obstacle is at ({x:g}, {y:g}) m. "
        "How far is it from the lever?",
        options=(
            Option("{right:.0f}", "Beyond the end of the lever its end is the nearest place."),
            Option(
                "{line:.0f}",
                "That is the distance from the endless line through the lever.",
                "a line for a lever",
                "An obstacle at (5, 0) m would touch the lever.",
            ),
            Option(
                "{start:.0f}",
                "That is the distance from the start of the lever.",
                "the start for the lever",
                "An obstacle at (0.9, 0) m touches the lever.",
            ),
            Option(
                "{middle:.0f}",
                "That is the distance from the middle of the lever.",
                "the middle for the lever",
                "An obstacle at (1, 0) m touches the lever.",
            ),
            Option(
                "{beside:.0f}",
                "That is how far it lies beyond the end, along the lever only.",
                "along, and not across",
                "An obstacle at (1, 3) m would touch the lever.",
            ),
            Option(
                "{sum:.0f}",
                "That is along and across added.",
                "sides added",
                "From one corner of a square metre to the other it is 1.41 m, not 2 m.",
            ),
            Option(
                "{square:.0f}",
                "That is the square of the distance in m.",
                "the root left out",
                "At 0.1 m from the lever it would be 0.01 m.",
            ),
        ),
        facts=_lever_facts,
        right=lambda facts: 0,
        view=_lever_view,
        unit="mm",
        within=0.03,
    ),
    "p4": Prediction(
        question="A program looks at {count} postures, evenly spaced on the motion from (150°, "
        "120°, 120°) to K1 = (1.9, 0.3) m with the least S, the first and the last among them. It "
        "finds the obstacle at ({x:g}, {y:g}) m at least {seen:.0f} mm away in each. Wanted are "
        "{wanted:.0f} mm. What is the least distance on the whole motion?",
        options=(
            Option(
                "{seen:.0f} mm: the nearest of the samples.",
                "The nearest moment need not be a sample. It lies between two of them, and there "
                "the distance is {true:.0f} mm.",
                "samples taken for the whole",
                "A camera that takes a picture every minute does not see who walks by in between.",
            ),
            Option(
                "A little less, by some 5 mm.",
                "Between two samples the lever moves by decimetres, and the distance can fall as "
                "much: it is {true:.0f} mm.",
                "the gap between samples taken for small",
                "A lever of 1 m whose joint turns by 10° moves its end by 175 mm.",
            ),
            Option(
                "Less by about a decimetre.",
                "{true:.0f} mm, {less:.0f} mm below the nearest sample. Samples can only be too "
                "optimistic. If the old ones are kept, more of them never find a larger distance.",
            ),
            Option(
                "More: samples err on the safe side.",
                "The least of some values is never below the least of all. Samples err on the "
                "dangerous side.",
                "the safe side exchanged",
                "The shortest of five pupils of a class is at least as tall as the shortest of "
                "all.",
            ),
        ),
        facts=_sample_facts,
        right=_sample_right,
        view=_sample_view,
    ),
    "p5": Prediction(
        question="The obstacle is at ({x:g}, {y:g}) m. The gripper passes K2 and K3 at exactly "
        "{r:.0f} mm from it. What happens to the levers on the way?",
        options=(
            Option(
                "All keep {r:.0f} mm: they are behind the gripper.",
                "Behind the gripper is where the obstacle is: K2 and K3 lie on the side of the "
                "base, so the levers reach across. AK comes to {AK:.0f} mm, BA to {BA:.0f} mm.",
                "the gripper taken for the arm",
                "You reach round a lamp on the table: the hand is past it, the sleeve is in it.",
            ),
            Option(
                "AK comes a little nearer, by some millimetres.",
                "So it is where the obstacle is far out. Here the arm is beside it: AK comes to "
                "{AK:.0f} mm, BA to {BA:.0f} mm.",
                "one place of the obstacle for all",
                "At (1.5, 1) m lever AK comes to {far:.0f} mm, with the same rule.",
            ),
            Option(
                "AK passes over it.",
                "AK comes to {AK:.0f} mm and BA to {BA:.0f} mm, while the gripper stays "
                "{gripper:.0f} mm away or more.",
            ),
            Option(
                "AK and BA both pass over it.",
                "BA comes near, {BA:.0f} mm, and does not touch it: AK does.",
                "near taken for touching",
                "At ({other_x:g}, {other_y:g}) m both do, with the same rule.",
            ),
        ),
        facts=_via_facts,
        right=_via_right,
        view=_via_view,
    ),
    "p6": Prediction(
        question="The wave starts in the grid posture nearest to q0. After {count} steps of 10°, "
        "each of one joint, it first comes to a grid posture that is the nearest one to a posture "
        "of the target's curve, with a proven step onto it. {count} times 10° is what, between "
        "these two grid postures?",
        options=(
            Option(
                "The turn of the busiest joint, which sets the time.",
                "Joints take turns here, one step at a time; the busiest of them turns by "
                "{most:.0f}°.",
                "the longest taken for the sum",
                "Two joints that turn by 50° each need ten steps, not five.",
            ),
            Option(
                "The straight distance in the cube, a root of squares.",
                "Steps go along the edges of the cube's cells, as in a town with streets: the "
                "straight distance is {straight:.0f}°.",
                "as the crow flies",
                "Three blocks east and four north are seven blocks to walk, not five.",
            ),
            Option(
                "S, the sum of what all joints turn.",
                "Each step adds 10° to S. So whoever is reached first is reached with the least S "
                "that this grid allows.",
            ),
            Option(
                "The turn of the gripper's direction.",
                "That is the sum with signs, {net:.0f}°: turns to and fro cancel there, and not in "
                "the number of steps.",
                "signs kept in the sum",
                "One joint forth by 50° and another back by 50°: no turn of the gripper, ten "
                "steps.",
            ),
        ),
        facts=_wave_facts,
        right=_wave_right,
        view=_wave_view,
    ),
    "p7": Prediction(
        question="We draw {count} tasks in which lever AK would hit the obstacle. With via points "
        "on a larger circle, r = {r:.0f} mm, how many paths keep {wanted:.0f} mm for all levers?",
        options=(
            Option(
                "None: a via point promises nothing.",
                "It promises nothing, and sometimes it suffices: {keep} of {count} were measured "
                "and keep it.",
                "no promise taken for no success",
                "An umbrella is no promise to stay dry either.",
            ),
            Option(
                "About a quarter.",
                "{keep} of {count}, none of them among the 47 in which a lever sweeps the "
                "obstacle on the circle of 143 mm. {near} come nearer all the same.",
            ),
            Option(
                "About two thirds.",
                "{keep} of {count}. In {near} a lever still comes nearer: the circle moves the "
                "gripper only.",
                "the gripper's trouble taken for the arm's",
                "Of the 47 tasks in which a lever sweeps the obstacle with r = 143 mm, none is "
                "mended.",
            ),
            Option(
                "All: the circle is larger than the distance wanted.",
                "That holds for the gripper at the via points. {near} of {count} come nearer "
                "elsewhere.",
                "room for the gripper taken for room for the arm",
                "At (1.2, 1.3) m the levers come as near as {passed:.0f} mm with this circle.",
            ),
        ),
        facts=_often_facts,
        right=_often_right,
        view=_often_view,
    ),
    "p8": Prediction(
        question="The obstacle is at ({x:g}, {y:g}) m. The wave of section 6, with steps of "
        "{coarse}° that are all checked, does not arrive. What is proven?",
        options=(
            Option(
                "No way keeps {wanted:.0f} mm.",
                "This wave found none in steps of {coarse}°. With steps of 5° there is one, of S "
                "= {S:.0f}°, and it is proven.",
                "not found taken for not there",
                "A net with wide meshes that comes up empty does not prove that the lake has no "
                "fish.",
            ),
            Option(
                "The target is out of reach.",
                "Without the obstacle the arm reaches it directly.",
                "the obstacle taken for the reach",
                "The target of the lab is the same with every obstacle.",
            ),
            Option(
                "Nothing but that this wave found none: the arm stays, or a finer grid is tried.",
                "Steps of 5° find a way of S = {S:.0f}°. The answer no is right all the same: "
                "without a proven way the arm stays.",
            ),
            Option(
                "That the direct way is the best there is.",
                "The direct way comes as near as {direct:.0f} mm. A promise not kept is worse than "
                "no motion.",
                "the least bad one",
                "No free lane on a road is no reason to take the pavement.",
            ),
        ),
        facts=_no_facts,
        right=lambda facts: 2 if facts["found"] and facts["sure"] else 0,
        view=_no_view,
    ),
}
