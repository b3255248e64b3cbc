"""Cases, form and law of exercise 1. Its text is in the Markdown file next to this one. Its wrong
programs also use `pose`, `turn`, `place` and `scaled`.
"""

from typing import Any

import numpy as np

from robokin import Arm, Quaternion, Transform, deg, dh_links, mm
from robokin.course.exercises import in_words
from robokin.course.told import apart, floats

from .shared import Floats, Z, rot, trans

__all__ = ["Arm", "dh_links"]
Case = tuple[Floats, Floats, Floats]


def cases(rng: np.random.Generator) -> list[Case]:
    part = trans(0.3, 0.1, 0.2) @ rot(Z, 40 * deg)

    def case(rows: list[list[float]], q: list[float], base_part: Floats = part) -> Case:
        return np.array(rows) * [deg, mm, mm, deg], np.array(q) * deg, base_part

    # `Arm` refuses a flange that cannot leave axis 1, so these tables need a chain of one's own
    found = [
        case([[0, 0, 0, 0]], [0]),
        case([[0, 300, 0, 0]], [0]),
        case([[0, 0, 400, 0]], [0]),
        case([[0, 0, 0, 0]], [30]),
        case([[90, 0, 0, 0]], [0]),
        case([[0, 0, 0, 90]], [0]),
        case([[0, 300, 400, 0]], [60]),
        case([[20, 300, 400, -90]], [50]),
        case([[20, 300, 400, -90]], [50], np.eye(4)),
        case([[0, 350, 0, -90], [-90, 0, 500, 0]], [0, 0]),
        case([[0, 350, 0, -90], [-90, 0, 500, 0], [90, 0, 400, 0]], [30, 20, -10]),
        case([[0, 350, 0, -90], [-90, 0, 500, 0], [90, 0, 400, 0]], [-120, 70, 140]),
    ]
    for count in (1, 2, 2, 3, 4, 5, 6, 7):
        columns = [
            rng.uniform(-180, 180, count) * deg,
            rng.uniform(-0.5, 0.5, count),
            rng.uniform(0, 0.6, count),
            rng.uniform(-120, 120, count) * deg,
        ]
        table = np.stack(columns, axis=-1).round(3)
        q = rng.uniform(-180, 180, count).round() * deg
        axis = rng.normal(size=3)
        turned = Quaternion.from_angle_axis(rng.uniform(0, 3), axis / np.linalg.norm(axis))
        base_part = Transform(turned, rng.uniform(-1, 1, 3).round(3)).as_matrix()
        found.append((table, q, base_part))
    return found


def form(result: Any, case: Case) -> Floats:
    if isinstance(result, Transform) and not result.shape:
        return result.as_matrix()
    wanted = "wanted a homogeneous matrix (4, 4)"
    try:
        matrix = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {in_words(result)}") from None
    if matrix.shape != (4, 4):
        more = ": a position without a rotation" if matrix.shape == (3,) else ""
        raise ValueError(f"{wanted}, got {in_words(result)}{more}")
    return matrix


def law(case: Case, yours: Floats, wanted: Floats) -> str | None:
    table, q, _ = case
    if same(yours, wanted):
        return None
    row = ""
    if len(table) == 1:
        offset, d, a, alpha = table[0]
        row = (
            f"with the row {offset / deg:.0f}°, {d / mm:.0f} mm, {a / mm:.0f} mm, "
            f"{alpha / deg:.0f}° and q1 = {q[0] / deg:.0f}° "
        )
    if not np.allclose(yours[3], [0, 0, 0, 1], rtol=0, atol=1e-6):
        last, is_last = apart([0, 0, 0, 1], yours[3], 0)
        return row + f"the last row should be {last}, but is {is_last}"
    if not np.allclose(place(yours), place(wanted), rtol=0, atol=1e-6):
        at, is_at = apart(place(wanted) / mm, place(yours) / mm)
        return f"{row}the part should be at ({at}) mm, seen from the flange, but is at ({is_at}) mm"
    k = int(abs(turn(yours) - turn(wanted)).max(axis=0).round(9).argmax())  # the first if equal
    axis, is_axis = apart(wanted[:3, k], yours[:3, k], 3)
    name = "xyz"[k]
    told = f"the part's {name} axis should be ({axis}), but is ({is_axis})"
    return f"{row}the position is right; {told}"


def same(a: Floats, b: Floats) -> bool:
    return np.allclose(a, b, rtol=0, atol=1e-6)


def pose(turned: Floats, at: Floats) -> Floats:
    """The matrix of a rotation and a position."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = turned, at
    return matrix


def turn(matrix: Floats) -> Floats:
    return matrix[:3, :3]


def place(matrix: Floats) -> Floats:
    return matrix[:3, 3]


def scaled(matrix: Floats, by: float) -> Floats:
    """The pose with its position in another unit."""
    return pose(turn(matrix), by * place(matrix))
