"""Cases, form and law of exercise 1; its text is in the Markdown file beside it, and its wrong
programs also use `count`, `seen` and other helpers.
"""

from typing import Any

import numpy as np

from robokin.course.exercises import in_words

from . import shared
from .shared import MINUS, Floats, crossing, drawing, gap_to, sides

__all__ = ["drawing"]
Outlines = list[Floats]
Case = tuple[Outlines, Floats]


def star_of(points: int, step: int) -> list[tuple[float, float]]:
    """A star with this many points, drawn in one line: from each point to the `step`-th next."""
    angles = 2 * np.pi * step / points * np.arange(points) + 0.1
    return [(round(2 * float(np.cos(a)), 2), round(2 * float(np.sin(a)), 2)) for a in angles]


def cases(rng: np.random.Generator) -> list[Case]:
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    diamond = [(0, -1), (1, 0), (0, 1), (-1, 0)]
    drawn = [(0.8, 1.5), (1.75, 1.7), (1.85, 0.5), (0.9, 0.6)]  # the lab's drawing: A, K, K1, A1
    dent = [(0, 0), (4, 0), (4, 3), (2, 1)]  # concave at the last corner
    arrow = [(0, 0), (2, 1), (4, 0), (2, 4)]
    bow = [(0, 0), (2, 2), (2, 0), (0, 2)]  # two of its sides cross
    star = star_of(5, 2)  # drawn in one line, which goes twice round the middle
    hook = [(0, 0), (5, 0), (5, 5), (1, 5), (1, 2), (3, 2)]
    hook += [(3, 3), (2, 3), (2, 4), (4, 4), (4, 1), (0, 1)]
    ring = star_of(8, 3)  # the line goes three times round the middle, twice round its surroundings
    comb = [(0, 0), (6, 0), (6, 4), (5, 1), (4, 4), (3, 1), (2, 4), (1, 1)]
    steep = [(0.9, 0.5), (0.85, -0.5), (1.3, 0.2), (0.75, 1.05)]
    triangle = [(0, 0), (3, 0), (0, 2)]
    pentagon = [(0, 0), (3, 0), (4, 2), (2, 1), (0, 3)]
    tried: list[tuple[Any, Any]] = [
        (square, [(0.5, 0.5), (1.5, 0.5), (-0.5, 0.5)]),
        (square[::-1], [(0.25, 0.75)]),
        (square, [(1.1, 0.5), (0.5, 1.5)]),
        (square, [(-1, 0), (-1, 1)]),  # at the height of a side
        (diamond, [(0, 0), (-2, 0), (-2, 1), (0.25, 0.5), (0.7, 0.6)]),  # at the height of corners
        (diamond[::-1], [(-0.75, -0.5)]),
        (drawn, [(1.3, 1.1), (0.5, 1.1), (1.3, 2.0)]),
        (drawn[::-1], [(1.3, 1.1)]),
        (dent, [(3, 1), (2, 1.5), (1, 1)]),
        (dent[::-1], [(1.5, 0.5)]),
        (arrow, [(2, 0.5), (2, 2), (-1, 1)]),
        (arrow[1:] + arrow[:1], [(2, 0.5)]),
        (bow, [(1, 0.5), (0.5, 1), (1.75, 1.5), (1, 1.5)]),
        (comb, [(0.4, 1.2), (1.8, 2), (3, 2), (0.5, 0.25), (4, 1)]),
        (steep, [(1.03, 0.45), (0.8, 0.3)]),
        (triangle, [(1, 1), (2, 1), (-1, 2)]),
        (pentagon, [(3, 1.75), (0.5, 2), (3.2, 1)]),
        (dent, [(1.5, 0.5)]),  # in line with a side
        (comb, [(5.7, 2)]),  # many crossings to one side of H, one to the other
        (star, [(0.1, 0.05), (1.5, 0.1)]),  # in the middle, with two sides to the right: outside
        (star[::-1], [(-0.1, 0.1)]),
        (star, [(0.95, 0.9)]),
        (ring, [(0.1, 0.05)]),
        (ring[::-1], [(-0.05, 0.1)]),
        (ring, [(0.9, 0.2), (1.7, 0.05)]),
        ([(y, x) for x, y in comb], [(2, 3)]),  # between two teeth, one above, one below
        (hook, [(3.5, 2.5), (1.5, 3)]),  # the first is outside, with sides in every direction
        (hook[::-1], [(2.5, 3.5)]),
    ]
    found = [
        ([np.array(c, dtype=float)], np.array(H, dtype=float)) for c, all_H in tried for H in all_H
    ]
    found[5:5] = with_holes()
    while len(found) < 80:
        corners = rng.uniform(0, 2, (4, 2)).round(2)
        H = rng.uniform(corners.min(axis=0), corners.max(axis=0)).round(2)
        gaps = [gap_to(P, Q, H) for P, Q in sides(corners)]
        if min(gaps) > 0.02:
            found.append(([corners], H))
    return found


def with_holes() -> list[Case]:
    """Shapes with several outlines: a hole, an island in a hole, two parts, parts that overlap."""

    def box(low: float, high: float, x: float = 0) -> Floats:
        return np.array([(low + x, low), (high + x, low), (high + x, high), (low + x, high)])

    frame, turned = [box(0, 4), box(1, 3)], [box(0, 4), box(1, 3)[::-1]]
    island = [box(0, 6), box(1, 5)[::-1], box(2, 4)]
    apart, crossed = [box(0, 1), box(0, 1, 2)], [box(0, 3), box(1, 4)]
    hole = [box(0, 4), np.array([(1, 1), (3, 1), (2, 3)], dtype=float)]
    tried: list[tuple[Outlines, list[tuple[float, float]]]] = [
        (frame, [(2, 1.5), (0.5, 2), (3.5, 2.5), (5, 2)]),
        (turned, [(2, 1.5), (0.5, 2)]),
        (frame[::-1], [(2.5, 2), (3.4, 0.5)]),
        (island, [(3, 3.5), (1.5, 3), (4.5, 2.5), (0.5, 1.5)]),
        (apart, [(0.5, 0.25), (1.5, 0.5), (2.5, 0.75)]),
        (crossed, [(2, 2.5), (0.5, 0.5), (3.5, 3.5)]),
        (hole, [(2, 2), (1.1, 2.5), (2.9, 2.5)]),
    ]
    return [(outlines, np.array(H, dtype=float)) for outlines, all_H in tried for H in all_H]


def form(result: Any, case: Case) -> bool:
    if isinstance(result, str) or np.size(result) != 1:
        raise ValueError(f"wanted True or False, got {in_words(result)}")
    value = np.reshape(np.asarray(result), ()).item()
    if value not in (0, 1):
        raise ValueError(f"wanted True or False, got {in_words(result)}")
    return bool(value)


def law(case: Case, yours: bool, wanted: bool) -> str | None:
    if yours == wanted:
        return None
    outlines, H = case
    crossed = count(outlines, H)
    some = "side" if crossed == 1 else "sides"
    shape = " and of ".join(", ".join(f"({x:g}, {y:g})" for x, y in c) for c in outlines)
    line = (
        f"should be {wanted}: a ray from ({H[0]:g}, {H[1]:g}) to the right crosses {crossed} "
        f"{some} of {shape}"
    )
    return line.translate(MINUS)


# --- Helpers for the wrong programs


def count(outlines: Outlines, H: Any) -> int:
    """The number of sides that a ray from H to the right crosses."""
    return sum(shared.count(corners, H) for corners in outlines)


def every_side(outlines: Outlines) -> list[tuple[Any, Any]]:
    """The sides of all outlines."""
    return [side for corners in outlines for side in sides(corners)]


def left_of(P: Any, Q: Any, H: Any) -> float:
    """A number that is positive if H is to the left of the line from P to Q."""
    return float((Q[0] - P[0]) * (H[1] - P[1]) - (Q[1] - P[1]) * (H[0] - P[0]))


def in_rubber_band(corners: Floats, H: Floats) -> bool:
    """Whether H is inside the convex hull of the corners."""
    angles = np.sort(np.arctan2(corners[:, 1] - H[1], corners[:, 0] - H[0]))
    gaps = np.diff(np.append(angles, angles[0] + 2 * np.pi))
    return bool(gaps.max() < np.pi)


def seen(outlines: Outlines, H: Floats) -> Floats:
    """The angles under which H sees the sides, as fractions of a turn. Their sum is the number of
    times that the outlines go round H, counter-clockwise.
    """
    ends = np.array([[complex(*(P - H)) for P in side] for side in every_side(outlines)])
    return np.asarray(np.angle(ends[:, 1] / ends[:, 0]) / (2 * np.pi))


def crossing_or_end(P: Any, Q: Any, y: float) -> float:
    """x of the side PQ at the height y; for a horizontal side, x of its right end."""
    return float(max(P[0], Q[0])) if P[1] == Q[1] else crossing(P, Q, y)


def leftward(outlines: Outlines, H: Floats) -> Case:
    """Mirror the shape and H, so that a ray to the left becomes one to the right."""
    return [corners * [-1, 1] for corners in outlines], H * [-1, 1]


def upward(outlines: Outlines, H: Floats) -> Case:
    """As `leftward`, for a ray upwards."""
    return [corners[:, ::-1] for corners in outlines], H[::-1]


def downward(outlines: Outlines, H: Floats) -> Case:
    """As `leftward`, for a ray downwards."""
    return leftward(*upward(outlines, H))
