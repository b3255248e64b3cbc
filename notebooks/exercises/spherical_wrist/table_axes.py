"""Exercise 1: the cases, the form of the axes, the law, and helpers for the wrong lines."""

from typing import Any

import numpy as np

from robokin import deg, mm
from robokin.course.exercises import in_words
from robokin.course.told import apart, floats

from .shared import ALPHA, OFFSET, A, D, Floats, posture, rot, trans

# with an extra row that is never reached
TABLE = [np.append(column, 0.0) for column in (A, ALPHA, D, OFFSET)]


def cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    """Simple tables, first with beta = 0, the lab's own, then tables of 3 to 7 rows."""

    def case(a: Any, alpha: Any, d: Any, offset: Any, q: Any, beta: Any = 0) -> tuple[Any, ...]:
        units = mm, deg, mm, deg, deg, deg
        columns = a, alpha, d, offset, np.broadcast_to(beta, len(q)), q
        return tuple(np.array(x, float) * unit for x, unit in zip(columns, units, strict=True))

    level = [300, 200, 100], [0, 0, 0], [0, 0, 0], [0, 0, 0]
    upright = [0, 300, 200], [90, 0, 0], [400, 0, 0], [0, 0, 90]
    made = [
        case([300], [90], [200], [0], [30]),
        case(*level, [30, 40, -20]),
        case([0, 300, 200], [90, 0, 0], [400, 0, 0], [0, 0, 0], [0, 0, 0]),
        case([0, 300, 200], [90, 0, 0], [400, 0, 0], [0, 0, 0], [30, 40, -20]),
        case(*upright, [30, 40, -20]),
        case([0, 300, 200], [-90, 0, 90], [400, 50, 0], [45, 0, 0], [-100, 40, 10]),
        case([50, 300, 200, 0], [90, 0, 90, 0], [400, 0, 0, 80], [0, 90, 0, -90], [0, 0, 0, 0]),
        case(*level, [0, 0, 0], [10, 0, 0]),
        case(*level, [30, 40, -20], [10, -5, 0]),
        case(*upright, [0, 0, 0], [10, 0, 0]),
        case(*upright, [30, 40, -20], [5, 10, 0]),
    ]
    table, true, bent = (A, ALPHA, D, OFFSET), np.zeros(6), posture(0.5, -0.3, 0.2, -1, 0.8, 0)
    for q in ([0, 0, 0, 0, 0, 0], [20, 70, -60, 30, 50, 10], [0, 90, 45, 13, 42, 210]):
        made.append((*table, true, posture(*q)))
    made.append((A, ALPHA, D, 0 * OFFSET, true, posture(30, -40, 50, 60, -70, 80)))
    made.append((*table, bent, posture(20, 70, -60, 30, 50, 10)))
    for n in (3, 4, 5, 6, 7, 6, 4, 3):
        lengths = rng.uniform(-400, 400, (2, n)).round()
        twist = 90.0 * rng.integers(-1, 3, n) + (15.0 * rng.integers(-2, 3, n) if n > 4 else 0)
        home, angles = 90.0 * rng.integers(-1, 3, n), rng.uniform(-170, 170, n).round()
        bend = rng.uniform(-8, 8, n).round(1)
        made.append(case(lengths[0], twist, lengths[1], home, angles, bend))
    return made


def is_unit(rows: Floats) -> Any:
    return abs(np.linalg.norm(rows, axis=-1) - 1) < 1e-6


class Axes:
    """Points and directions (n, 3) as they were returned. `rows`: directions and moments (n, 6),
    which are the same for every point of an axis, even if points and directions are swapped. A
    direction that is not a unit vector is scaled to length 2 there.
    """

    def __init__(self, points: Floats, ways: Floats) -> None:
        self.points, self.ways = points, ways
        size = np.linalg.norm(ways, axis=-1, keepdims=True)
        if is_unit(points).all() and not is_unit(ways).all():
            halves = np.cross(ways, points), points
        else:
            scale = 2 / np.where(size > 1e-9, size, 2)
            ways = np.where(is_unit(ways)[:, None], ways, scale * ways)
            halves = ways, np.cross(points, ways)
        self.rows: Floats = np.concatenate(halves, axis=-1)

    def __array__(self, dtype: Any = None, copy: Any = None) -> Floats:
        """The arrays as they were returned, so that slips in a result change both of them."""
        both = np.stack([self.points, self.ways])
        return both if dtype is None else both.astype(dtype)

    def __repr__(self) -> str:
        """Both arrays on a short line; of long arrays only the first rows."""
        rounded = np.round([self.points, self.ways], 9) + 0.0
        for count in range(len(self.points), 0, -1):
            parts = []
            for name, array in zip(("points", "directions"), rounded, strict=True):
                rows = [f"[{', '.join(f'{x:.3g}' for x in row)}]" for row in array[:count]]
                rows += ["..."] * (count < len(array))
                parts.append(f"{name} [{', '.join(rows)}]")
            text = ", ".join(parts)
            if len(text) < 120:
                break
        return text.replace("-", "\N{MINUS SIGN}")


def form(result: Any, case: tuple[Any, ...]) -> Axes:
    """Return points and directions, from two arrays (n, 3) or from one. ValueError: other input."""
    if isinstance(result, Axes):
        return result
    n = len(case[0])
    wanted = f"wanted points and directions, two arrays ({n}, 3)"
    try:
        values = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {in_words(result)}") from None
    if values.shape == (n, 6):
        values = np.stack([values[:, :3], values[:, 3:]])
    elif values.shape == (n, 2, 3) and n != 2:
        values = values.swapaxes(0, 1)
    if values.ndim != 3 or values.shape[::2] != (2, 3) or not values.size:
        raise ValueError(f"{wanted}, got shape {values.shape}")
    return Axes(*values)


def law(case: tuple[Any, ...], yours: Axes, wanted: Axes) -> str | None:
    """A message about the first wrong axis."""
    points, ways, n = wanted.points, wanted.ways, len(wanted.points)
    if len(yours.rows) != n:
        joints = "1 joint" if n == 1 else f"{n} joints"
        return f"wanted points and directions of {joints}, got {len(yours.rows)} of each"
    for i, (point, way) in enumerate(zip(points, ways, strict=True)):
        place = ", ".join(f"{x / mm:.1f}" for x in np.round(point, 9) + 0.0)
        along = ", ".join(f"{x:.3f}" for x in np.round(way, 9) + 0.0)
        if not np.allclose(yours.ways[i], way, rtol=0, atol=1e-6):
            along, got = apart(way, yours.ways[i], 3)
            more = "" if is_unit(yours.ways[i]) else ", which is not a unit vector"
            axis = f"the axis of joint {i + 1} should have the direction ({along})"
            return f"{axis}, not ({got}){more}"
        off = float(np.linalg.norm(yours.rows[i, 3:] - np.cross(point, way)))
        if not off <= 1e-6:
            return (
                f"the axis of joint {i + 1} should go through ({place}) mm along ({along}); your "
                f"axis passes this point at a distance of {apart(off / mm, 0)[0]} mm"
            )
    return None


def same(one: Axes, two: Axes) -> bool:
    a, b = one.rows, two.rows
    return a.shape == b.shape and np.allclose(a, b, rtol=0, atol=1e-7, equal_nan=True)


# --- Helpers for the wrong lines ------------------------------------------------------------------


def rot_x(angle: float) -> Floats:
    return rot(0, angle)


def rot_y(angle: float) -> Floats:
    return rot(1, angle)


def rot_z(angle: float) -> Floats:
    return rot(2, angle)


def modified(a: float, alpha: float, d: float, theta: float) -> Floats:
    """The matrix of a row of a DH table in Craig's form."""
    return rot_x(alpha) @ trans(a, 0, 0) @ rot_z(theta) @ trans(0, 0, d)
