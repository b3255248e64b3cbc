"""Lab 06, the spherical wrist: its exercises and predictions.

The answers to each exercise come first, right and wrong, then the predictions' numbers and views;
the tables stand at the end.
"""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np

from .._arrays import Floats
from ..arms import ITMO6R, distance_from_singularity, follow
from ..motion import differentiate, lin, quintic
from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, mm, wrapped
from .exercises import words
from .mistakes import DEGREES, METRES, Mistake, Program, Tools
from .old import Catch, Fault, Function, Value
from .questions import Option, Prediction
from .told import apart, floats, one_number
from .variants import Numbers, dice

LAB = "spherical_wrist"
OBJECTIVES = (
    "read a Denavit-Hartenberg table, and compute every frame and every joint axis of the arm from "
    "it",
    "test a program that finds the three wrist angles in the nine numbers of a rotation, both "
    "ways, also where the wrist is singular",
    "say how near a posture is to a singularity, and choose a motion that keeps away from it",
)

X, Y, Z = np.eye(3)
turned = Quaternion.from_angle_axis
MINUS = str.maketrans({"-": "\N{MINUS SIGN}"})
# source 004, table 1; lengths as in the lab
A = np.array([0, 100, 0, 0, 0, 0]) * mm
ALPHA = np.array([90, 0, 90, -90, 90, 0]) * deg
D = np.array([100, 0, 0, 200, 0, 200]) * mm
OFFSET = np.array([0, 0, 90, 0, 0, 0]) * deg
ROW = ITMO6R.branch(+1, -1, -1)


def _posture(*degrees: float) -> Floats:
    q: Floats = np.array(degrees) * deg
    return q


# --- 1: the joint axes from a table ---------------------------------------------------------------


def rot(axis: int, angle: float) -> Floats:
    """A turn about a coordinate axis (0, 1, 2), 4 x 4."""
    matrix, (i, j) = np.eye(4), [(1, 2), (2, 0), (0, 1)][axis]
    c, s = np.cos(angle), np.sin(angle)
    matrix[i, i], matrix[i, j], matrix[j, i], matrix[j, j] = c, -s, s, c
    return matrix


def shift(x: float, y: float, z: float) -> Floats:
    """A shift, 4 x 4."""
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def row_matrix(tools: Tools, a: float, alpha: float, d: float, theta: float) -> Floats:
    """One row of a table: Rot(z, theta) Trans(0, 0, d) Trans(a, 0, 0) Rot(x, alpha)."""
    made: Floats = tools.product(tools.product(rot(2, theta), shift(a, 0, d)), rot(0, alpha))
    return made


def dh_frames(
    tools: Tools, a: Any, alpha: Any, d: Any, theta: Any, row: Any = row_matrix
) -> Floats:
    """Frames 0 to n as matrices (n + 1, 4, 4)."""
    frames = [np.eye(4)]
    for each in zip(a, alpha, d, theta, strict=True):
        frames.append(tools.product(frames[-1], row(tools, *each)))
    return np.array(frames)


def read_axes(frames: Floats, point: int = 0, along: int = 0, column: int = 2) -> Floats:
    """Points and directions (2, n, 3), from the frames before the joints (0) or after them (1)."""
    n = len(frames) - 1
    places, ways = frames[point : point + n, :3, 3], frames[along : along + n, :3, column]
    return np.stack([places, ways])


def _axes(tools: Tools, a: Floats, alpha: Floats, d: Floats, offset: Floats, q: Floats) -> Floats:
    return read_axes(dh_frames(tools, a, alpha, d, offset + q))


def _axes_cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    def case(a: Any, alpha: Any, d: Any, offset: Any, q: Any) -> tuple[Any, ...]:
        units = mm, deg, mm, deg, deg
        columns = a, alpha, d, offset, q
        return tuple(np.array(x, float) * unit for x, unit in zip(columns, units, strict=True))

    level = [300, 200, 100], [0, 0, 0], [0, 0, 0], [0, 0, 0]
    cases = [
        case([300], [90], [200], [0], [30]),
        case(*level, [30, 40, -20]),
        case([0, 300, 200], [90, 0, 0], [400, 0, 0], [0, 0, 0], [0, 0, 0]),
        case([0, 300, 200], [90, 0, 0], [400, 0, 0], [0, 0, 0], [30, 40, -20]),
        case([0, 300, 200], [90, 0, 0], [400, 0, 0], [0, 0, 90], [30, 40, -20]),
        case([0, 300, 200], [-90, 0, 90], [400, 50, 0], [45, 0, 0], [-100, 40, 10]),
        case([50, 300, 200, 0], [90, 0, 90, 0], [400, 0, 0, 80], [0, 90, 0, -90], [0, 0, 0, 0]),
    ]
    table = A, ALPHA, D, OFFSET
    for q in ([0, 0, 0, 0, 0, 0], [20, 70, -60, 30, 50, 10], [0, 90, 45, 13, 42, 210]):
        cases.append((*table, np.array(q, dtype=float) * deg))
    cases.append((A, ALPHA, D, 0 * OFFSET, _posture(30, -40, 50, 60, -70, 80)))
    for n in (3, 4, 5, 6, 7, 6, 4, 3):
        lengths = rng.uniform(-400, 400, (2, n)).round()
        twist = 90.0 * rng.integers(-1, 3, n) + (15.0 * rng.integers(-2, 3, n) if n > 4 else 0)
        home, angles = 90.0 * rng.integers(-1, 3, n), rng.uniform(-170, 170, n).round()
        cases.append(case(lengths[0], twist, lengths[1], home, angles))
    return cases


def _is_unit(rows: Floats) -> Any:
    return abs(np.linalg.norm(rows, axis=-1) - 1) < 1e-6


class Axes:
    """Points and directions (n, 3) as they were returned. `rows`: directions and moments (n, 6),
    the same for every point of an axis; also where the two are exchanged, and, of length 2, for a
    direction of any length but 1.
    """

    def __init__(self, points: Floats, ways: Floats) -> None:
        self.points, self.ways = points, ways
        size = np.linalg.norm(ways, axis=-1, keepdims=True)
        if _is_unit(points).all() and not _is_unit(ways).all():
            halves = np.cross(ways, points), points
        else:
            scale = 2 / np.where(size > 1e-9, size, 2)
            ways = np.where(_is_unit(ways)[:, None], ways, scale * ways)
            halves = ways, np.cross(points, ways)
        self.rows: Floats = np.concatenate(halves, axis=-1)

    def __array__(self, dtype: Any = None, copy: Any = None) -> Floats:
        return self.rows if dtype is None else self.rows.astype(dtype)

    def __repr__(self) -> str:
        """Both arrays; of long ones the first rows, so that the line stays short."""
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


def _axes_form(result: Any, case: tuple[Any, ...]) -> Axes:
    """Points and directions, from two arrays (n, 3) or from one."""
    n = len(case[0])
    wanted = f"wanted points and directions, two arrays ({n}, 3)"
    try:
        values = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {words(result)}") from None
    if values.shape == (n, 6):
        values = np.stack([values[:, :3], values[:, 3:]])
    elif values.shape == (n, 2, 3) and n != 2:
        values = values.swapaxes(0, 1)
    if values.ndim != 3 or values.shape[::2] != (2, 3) or not values.size:
        raise ValueError(f"{wanted}, got shape {values.shape}")
    return Axes(*values)


def _axes_law(case: tuple[Any, ...], answer: Axes) -> str | None:
    points, ways = _axes(Tools(), *case)
    yours = answer.rows
    if len(yours) != len(points):
        return f"wanted points and directions of {len(points)} joints, got {len(yours)} of each"
    for i, (point, way) in enumerate(zip(points, ways, strict=True)):
        place = ", ".join(f"{x / mm:.1f}" for x in point + 0.0)
        along = ", ".join(f"{x:.3f}" for x in np.round(way, 9) + 0.0)
        if not np.allclose(answer.ways[i], way, rtol=0, atol=1e-6):
            along, got = apart(way, answer.ways[i], 3)
            more = "" if _is_unit(answer.ways[i]) else ", which is not a unit vector"
            wanted = f"the axis of joint {i + 1} should have the direction ({along})"
            return f"{wanted}, not ({got}){more}"
        off = float(np.linalg.norm(yours[i, 3:] - np.cross(point, way)))
        if not off <= 1e-6:
            return (
                f"the axis of joint {i + 1} should go through ({place}) mm along ({along}); yours "
                f"passes {apart(off / mm, 0)[0]} mm beside"
            )
    return None


def _same_axes(one: Axes, two: Axes) -> bool:
    a, b = one.rows, two.rows
    return a.shape == b.shape and np.allclose(a, b, rtol=0, atol=1e-7, equal_nan=True)


TOOLS = Tools()


def _other_row(change: Any, **places: int) -> Program:
    """The right program with another row matrix, (a, alpha, d, theta) -> 4 x 4."""

    def program(a: Floats, alpha: Floats, d: Floats, offset: Floats, q: Floats) -> Floats:
        def row(tools: Tools, *four: float) -> Any:
            return change(*four)

        return read_axes(dh_frames(TOOLS, a, alpha, d, offset + q, row), **places)

    return program


def _other_theta(change: Any) -> Program:
    return lambda a, alpha, d, offset, q: read_axes(
        dh_frames(TOOLS, a, alpha, d, change(offset, q))
    )


def _read(**places: int) -> Program:
    return lambda a, alpha, d, offset, q: read_axes(
        dh_frames(TOOLS, a, alpha, d, offset + q), **places
    )


def _rows_for_columns(*case: Any) -> Floats:
    a, alpha, d, offset, q = case
    frames = dh_frames(TOOLS, a, alpha, d, offset + q)
    return np.stack([frames[:-1, :3, 3], frames[:-1, 2, :3]])


def _local(*case: Any) -> Floats:
    rows = [np.eye(4)] + [
        row_matrix(TOOLS, *each) for each in zip(*case[:3], case[3] + case[4], strict=True)
    ]
    return read_axes(np.array(rows))


def _always_six(*case: Any) -> Floats:
    a, alpha, d, offset, q = case
    rows = np.array([(a[i], alpha[i], d[i], offset[i] + q[i]) for i in range(6)])
    return read_axes(dh_frames(TOOLS, rows[:, 0], rows[:, 1], rows[:, 2], rows[:, 3]))


def _first_six(*case: Any) -> Floats:
    a, alpha, d, offset, q = case
    frames = dh_frames(TOOLS, a, alpha, d, offset + q)
    return np.stack([frames[:6, :3, 3], frames[:6, :3, 2]])


def _at_most_six(*case: Any) -> Floats:
    return _axes(TOOLS, *(column[:6] for column in case))


def _lengths_of_the_lab(*case: Any) -> Floats:
    a, alpha, d, offset, q = case
    return _axes(
        TOOLS, *(np.array([c[i] for i in range(len(q))]) for c in (A, alpha, D, offset, q))
    )


def _lengths_of_its_rows(*case: Any) -> Floats:
    _, alpha, _, offset, q = (column[:6] for column in case)
    return _axes(TOOLS, A[: len(q)], alpha, D[: len(q)], offset, q)


def _six_rows_of_its_lengths(*case: Any) -> Floats:
    _, alpha, _, offset, q = case
    rows = np.array([(A[i], alpha[i], D[i], offset[i], q[i]) for i in range(6)])
    return _axes(TOOLS, *rows.T)


def _wrong_side(*case: Any) -> Floats:
    a, alpha, d, offset, q = case
    frames = [np.eye(4)]
    for each in zip(a, alpha, d, offset + q, strict=True):
        frames.append(row_matrix(TOOLS, *each) @ frames[-1])
    return read_axes(np.array(frames))


def _own_table(*case: Any) -> Floats:
    q = np.array([case[4][i] for i in range(6)])
    return _axes(TOOLS, A, ALPHA, D, OFFSET, q)


def _upright(*case: Any) -> Floats:
    points, ways = _axes(TOOLS, *case)
    return np.stack([points, np.broadcast_to(Z, ways.shape)])


def _modified(a: float, alpha: float, d: float, theta: float) -> Floats:
    return rot(0, alpha) @ shift(a, 0, 0) @ rot(2, theta) @ shift(0, 0, d)


AFTER = (
    "Joint i turns about z of the frame before it, frame i − 1: the first axis is the base's z, "
    "and the last frame belongs to no axis."
)


def _labs_table(a: Any, alpha: Any, d: Any, offset: Any, q: Any) -> Floats:
    n = min(len(q), len(A))
    frames = dh_frames(Tools(), A[:n], ALPHA[:n], D[:n], OFFSET[:n] + q[:n])[: len(q)]
    return np.stack([frames[:, :3, 3], frames[:, :3, 2]])


SIX = "The table may have any number of rows: take it from len(q)."
LENGTHS = (
    "a and d come in as arguments: D1, A2, D4 and D6 are the lengths of the lab's arm, and every "
    "arm has its own."
)

AXES_MISTAKES = [
    Mistake(
        "the lab's own table",
        "It reads the columns of the lab and not its inputs: my_chain has a, alpha, d and offset "
        "of its own. Build the chain from what you are given.",
        _labs_table,
    ),
    Mistake("the frame after the joint", AFTER, _read(point=1, along=1)),
    Mistake("z of the frame after the joint", AFTER, _read(along=1)),
    Mistake("the origin of the frame after the joint", AFTER, _read(point=1)),
    Mistake("x for z", "A joint turns about a z axis: the third column.", _read(column=0)),
    Mistake("y for z", "A joint turns about a z axis: the third column.", _read(column=1)),
    Mistake(
        "a row for a column",
        "The axes of a frame are the columns of its matrix, R[:, 2]; you take a row.",
        _rows_for_columns,
    ),
    Mistake(
        "the offset is left out",
        "The turn of a row is offset + q: q = 0 is not theta = 0.",
        _other_theta(lambda offset, q: q),
    ),
    Mistake(
        "the offset is subtracted",
        "The turn of a row is offset + q.",
        _other_theta(lambda offset, q: q - offset),
    ),
    Mistake(
        "the joints stand still",
        "These are the axes at q = 0. Axis i is carried by all joints before it.",
        _other_theta(lambda offset, q: offset),
    ),
    Mistake(
        "the joints turn the wrong way",
        "The sign of q is turned round.",
        _other_theta(lambda offset, q: offset - q),
    ),
    Mistake(
        "the modified table (Craig)",
        "Shift and twist come after the turn here: this is a classical table, not a modified one.",
        _other_row(_modified),
    ),
    Mistake(
        "the modified table (Craig), with its own axes",
        "In a modified table shift and twist come first and joint i turns about z of frame i. Here "
        "the turn comes first, about z of frame i − 1.",
        _other_row(_modified, point=1, along=1),
    ),
    Mistake(
        "the shift before the turn",
        "a goes along the new x: first the turn about z, then the shift.",
        _other_row(lambda a, alpha, d, theta: shift(a, 0, d) @ rot(2, theta) @ rot(0, alpha)),
    ),
    Mistake(
        "the twist before the shift",
        "d goes along the old z: first the shift, then the twist about x.",
        _other_row(lambda a, alpha, d, theta: rot(2, theta) @ rot(0, alpha) @ shift(a, 0, d)),
    ),
    Mistake(
        "the twist before the turn",
        "The order is: turn about z, shift, twist about x.",
        _other_row(lambda a, alpha, d, theta: rot(0, alpha) @ rot(2, theta) @ shift(a, 0, d)),
    ),
    Mistake(
        "the twist about another axis",
        "The twist alpha turns about x; yours turns about y.",
        _other_row(lambda a, alpha, d, theta: rot(2, theta) @ shift(a, 0, d) @ rot(1, alpha)),
    ),
    Mistake(
        "the sign of the twist",
        "The twist has the wrong sign: −sin stands in the second row of Rot(x, alpha), above the "
        "diagonal.",
        _other_row(lambda a, alpha, d, theta: row_matrix(TOOLS, a, -alpha, d, theta)),
    ),
    Mistake(
        "the twist is left out",
        "Without the twist every axis is upright.",
        _other_row(lambda a, alpha, d, theta: row_matrix(TOOLS, a, 0.0, d, theta)),
    ),
    Mistake(
        "a and d exchanged",
        "d goes along z, a along x.",
        _other_row(lambda a, alpha, d, theta: row_matrix(TOOLS, d, alpha, a, theta)),
    ),
    Mistake(
        "a is left out",
        "a, the shift along x, is missing.",
        _other_row(lambda a, alpha, d, theta: row_matrix(TOOLS, 0.0, alpha, d, theta)),
    ),
    Mistake(
        "d is left out",
        "d, the shift along z, is missing.",
        _other_row(lambda a, alpha, d, theta: row_matrix(TOOLS, a, alpha, 0.0, theta)),
    ),
    Mistake(
        "degrees for radians",
        DEGREES,
        lambda *c: _axes(TOOLS, c[0], c[1] * deg, c[2], c[3] * deg, c[4] * deg),
    ),
    Mistake(
        "degrees for radians",
        DEGREES,
        lambda *c: _axes(TOOLS, c[0], c[1], c[2], c[3] * deg, c[4] * deg),
    ),
    Mistake("mm for m", METRES, lambda *case: _axes(TOOLS, *case) * [[[1000]], [[1]]]),
    Mistake("mm for m", METRES, lambda *case: _axes(TOOLS, *case) * [[[mm]], [[1]]]),
    Mistake(
        "multiplied on the wrong side",
        "A row says where frame i stands in frame i − 1: frame @ row, not row @ frame.",
        _wrong_side,
    ),
    Mistake(
        "the table of this lab",
        "The columns a, alpha, d, offset come in as arguments; yours come from the lab's own arm.",
        _own_table,
    ),
    Mistake(
        "every axis upright",
        "The direction (0, 0, 1) holds in the frame itself. In the base it is the third column of "
        "the frame's rotation.",
        _upright,
    ),
    Mistake(
        "the direction is not a unit vector",
        "Directions are wanted with length 1. Along the z axis that is the third column of the "
        "rotation as it is, not d times it.",
        lambda *case: _axes(TOOLS, *case) * [[[1]], [[2]]],
    ),
    Mistake(
        "the opposite direction",
        "A positive angle turns about the direction by the right-hand rule: +z, not −z.",
        lambda *case: _axes(TOOLS, *case) * [[[1]], [[-1]]],
    ),
    Mistake(
        "each row seen from the base",
        "A row says where frame i stands in frame i − 1. Multiply on: frame @ row.",
        _local,
    ),
    Mistake("six rows assumed", SIX, _always_six),
    Mistake("six rows assumed", SIX, _first_six),
    Mistake("six rows assumed", SIX, _at_most_six),
    Mistake("lengths of this lab assumed", LENGTHS, _lengths_of_the_lab),
    Mistake("lengths of this lab assumed", LENGTHS, _lengths_of_its_rows),
    Mistake("lengths of this lab assumed", f"{LENGTHS} {SIX}", _six_rows_of_its_lengths),
    Mistake(
        "points and directions exchanged",
        "First the points, then the directions.",
        lambda *case: _axes(TOOLS, *case)[::-1],
    ),
]


# --- 2: a test for wrist programs -----------------------------------------------------------------


def zyz(phi: Any, theta: Any, psi: Any) -> Floats:
    """Rot(z, phi) Rot(y, theta) Rot(z, psi): angles (...) -> (..., 3, 3)."""
    turns = turned(phi, Z) @ turned(theta, Y) @ turned(psi, Z)
    return turns.as_matrix()


def textbook(h: Floats, wrist: int) -> Floats:
    """The regular formulas alone, for matrices (..., 3, 3): (..., 3)."""
    c = h[..., 2, 2]
    with np.errstate(invalid="ignore"):
        theta = np.arctan2(wrist * np.sqrt(1 - c**2), c)
    phi = np.arctan2(wrist * h[..., 1, 2], wrist * h[..., 0, 2])
    psi = np.arctan2(wrist * h[..., 2, 1], -wrist * h[..., 2, 0])
    return np.stack([phi, theta, psi], axis=-1)


def mended(h: Floats, wrist: int, phi: Any = None, free: float = 1e-13) -> Floats:
    """psi measured from phi: right everywhere, for matrices (..., 3, 3)."""
    s = np.hypot(h[..., 0, 2], h[..., 1, 2])
    theta = np.arctan2(wrist * s, h[..., 2, 2])
    if phi is None:
        phi = np.where(s < free, 0.0, np.arctan2(wrist * h[..., 1, 2], wrist * h[..., 0, 2]))
    c, s = np.cos(phi), np.sin(phi)
    psi = np.arctan2(c * h[..., 1, 0] - s * h[..., 0, 0], c * h[..., 1, 1] - s * h[..., 0, 1])
    return np.stack([phi, theta, psi], axis=-1)


def _singular(h: Floats) -> bool:
    return bool(np.hypot(h[0, 2], h[1, 2]) < 1e-13)


def _sixth_free(h: Floats, wrist: int) -> Any:
    """Joint 6 to zero instead of joint 4."""
    if not _singular(h):
        return tuple(mended(h, wrist))
    if h[2, 2] > 0:
        return np.arctan2(h[1, 0], h[0, 0]), wrist * 0.0, 0.0
    return np.arctan2(-h[1, 0], -h[0, 0]), wrist * np.pi, 0.0


def _any_free(h: Floats, wrist: int) -> Floats:
    return mended(h, wrist, 0.7) if _singular(h) else mended(h, wrist)


def _by_halves(h: Floats, wrist: int) -> list[float]:
    """From the quaternion: half the sum and half the difference of phi and psi."""
    w, x, y, z = Quaternion.from_matrix(h).wxyz
    total, less = 2 * np.arctan2(z, w), 2 * np.arctan2(-x, y)
    theta = 2 * np.arctan2(np.hypot(x, y), np.hypot(w, z))
    phi, psi = (total + less) / 2, (total - less) / 2
    return [phi, theta, psi] if wrist > 0 else [phi + np.pi, -theta, psi - np.pi]


def _positive(h: Floats, wrist: int) -> Floats:
    phi, theta, psi = mended(h, wrist)
    return np.array([phi % (2 * np.pi), theta, psi % (2 * np.pi)])


def _psi_first(h: Floats, wrist: int) -> list[float]:
    """psi as the textbook has it, phi measured from it."""
    psi, theta, phi = mended(h.T, -wrist)
    return [-float(phi), -float(theta), -float(psi)]


def _guarded(h: Floats, wrist: int) -> Floats:
    """The regular formulas, and the singular ones at sin theta = 0 exactly."""
    if _singular(h):
        return mended(h, wrist)
    return textbook(h, wrist)


def _coarse(h: Floats, wrist: int) -> Floats:
    if np.hypot(h[0, 2], h[1, 2]) > 1e-3:
        return mended(h, wrist)
    theta = 0.0 if h[2, 2] > 0 else wrist * np.pi
    return np.array([0.0, theta, mended(h, wrist, 0.0)[2]])


def _theta_alone(h: Floats, wrist: int) -> Floats:
    phi, theta, psi = mended(h, +1)
    return np.array([phi, wrist * theta, psi])


def _half_the_other(h: Floats, wrist: int) -> Floats:
    phi, theta, psi = mended(h, +1)
    return np.array([phi + (np.pi if wrist < 0 else 0), wrist * theta, psi])


def _always_the_sum(h: Floats, wrist: int) -> Floats:
    if not _singular(h):
        return mended(h, wrist)
    theta = 0.0 if h[2, 2] > 0 else wrist * np.pi
    return np.array([0.0, theta, np.arctan2(h[1, 0], h[0, 0])])


def _always_the_difference(h: Floats, wrist: int) -> Floats:
    if not _singular(h):
        return mended(h, wrist)
    theta = 0.0 if h[2, 2] > 0 else wrist * np.pi
    return np.array([0.0, theta, -np.arctan2(-h[1, 0], -h[0, 0])])


def _only_at(theta: float, wrong: Program) -> Program:
    """Wrong near this theta, 0 or pi, and right elsewhere."""
    side = np.cos(theta)
    return lambda h, wrist: wrong(h, wrist) if side * h[2, 2] > 0 else mended(h, wrist)


def _nan_there(h: Floats, wrist: int) -> Floats:
    return np.full(3, np.nan) if _singular(h) else mended(h, wrist)


def _phi_nan_there(h: Floats, wrist: int) -> Floats:
    return mended(h, wrist) + [np.nan if _singular(h) else 0, 0, 0]


def _little_off(h: Floats, wrist: int) -> Floats:
    return mended(h, wrist) + [0, 0, 1e-8]


def _arcsin(h: Floats, wrist: int) -> Floats:
    phi, theta, psi = mended(h, wrist)
    return np.array([phi, np.arcsin(np.sin(theta)), psi])


def _atan(h: Floats, wrist: int) -> Floats:
    if _singular(h):
        return mended(h, wrist)
    with np.errstate(divide="ignore"):
        return mended(h, wrist, np.arctan(np.divide(h[1, 2], h[0, 2])))


def _round_the_long_way(h: Floats, wrist: int) -> Floats:
    phi, theta, psi = mended(h, wrist)
    if _singular(h):
        return np.array([phi, theta, psi])
    return np.array([phi + np.pi, theta - 2 * np.pi * np.sign(theta), psi + np.pi]) * [1, -1, 1]


def _sign_of_psi(h: Floats, wrist: int) -> Floats:
    phi, theta, psi = mended(h, wrist)
    return np.array([phi, theta, psi if _singular(h) else np.pi - psi])


WRIST_RIGHTS: tuple[tuple[str, Program], ...] = (
    ("joint 4 at zero where it is free", mended),
    ("joint 6 at zero where it is free, a tuple", _sixth_free),
    ("joint 4 at 0.7 rad where it is free", _any_free),
    ("from the quaternion, angles beyond half a turn, a list", _by_halves),
    ("angles from 0 to 360 degrees", _positive),
    ("joint 4 measured from joint 6", _psi_first),
)
BLIND = (
    "NaN compares false with every number: `if error > 1e-10: return False` lets it pass, `if not "
    "error < 1e-10` does not."
)
WRIST_MISTAKES = (
    Mistake(
        "the flag is ignored",
        "It gives the positive theta whatever wrist says: ask for both, and look at the sign.",
        lambda h, wrist: mended(h, +1),
    ),
    Mistake(
        "theta alone changes its sign",
        "For wrist = −1 it turns theta round and leaves phi and psi: another rotation.",
        _theta_alone,
    ),
    Mistake(
        "psi stays for the other wrist",
        "For wrist = −1 it turns phi by half a turn and forgets psi.",
        _half_the_other,
    ),
    Mistake(
        "the regular formulas beside the singularity",
        "Right at every theta of ordinary size, and at theta = 0 exactly. At theta = 1e-8 rad the "
        "matrix is off by more than 1e-10, or the angles are NaN: try such small angles, many of "
        "them.",
        _guarded,
    ),
    Mistake(
        "a coarse threshold",
        "Below theta = 1e-3 rad it takes the wrist for singular, and theta is lost. Try 1e-4.",
        _coarse,
    ),
    *(
        Mistake(
            f"{name} at theta = {where}",
            f"Within {near} rad of theta = {where}, and there only, theta is lost: try angles so "
            "near to 0, and so near to 180 degrees.",
            _only_at(theta, wrong),
        )
        for theta, where in ((0.0, "0"), (np.pi, "180 degrees"))
        for name, near, wrong in (
            ("the regular formulas", "1e-8", _guarded),
            ("a coarse threshold", "1e-3", _coarse),
        )
    ),
    Mistake(
        "the difference at theta = 0, too",
        "At theta = 0 the sum of phi and psi counts, not the difference.",
        _always_the_difference,
    ),
    Mistake(
        "the sum at theta = 180 degrees, too",
        "At theta = 180 degrees the difference of phi and psi counts, not the sum.",
        _always_the_sum,
    ),
    Mistake(
        "NaN in the singularity",
        "At sin theta = 0 it gives NaN. One angle is free there, and any choice is an answer. "
        f"{BLIND}",
        _nan_there,
    ),
    Mistake(
        "NaN for the free angle",
        f"At sin theta = 0 its phi is NaN, and theta and psi are numbers. {BLIND}",
        _phi_nan_there,
    ),
    Mistake(
        "psi off by 1e-8 rad",
        "Entries of its matrix are off by up to 1e-8, and 1e-10 is promised. np.allclose has a "
        "relative tolerance, too, 1e-5 of the entry: give it rtol=0 beside atol=1e-10.",
        _little_off,
    ),
    Mistake(
        "arcsin for theta",
        "theta beyond 90 degrees comes out as 180 degrees minus theta: try theta = 2 rad.",
        _arcsin,
    ),
    Mistake(
        "atan for atan2",
        "phi comes from a quotient: half of the plane is lost. Try phi = 2 rad.",
        _atan,
    ),
    Mistake(
        "theta beyond half a turn",
        "Its theta has the right sign and the angles make the right matrix, but theta is between "
        "180 and 360 degrees. Your test has to ask for at most 180.",
        _round_the_long_way,
    ),
    Mistake(
        "the sign of h31",
        "psi is read from h32 and h31, and the minus before h31 is missing.",
        _sign_of_psi,
    ),
    Mistake(
        "the transposed matrix",
        "It reads rows for columns, which are the angles of the inverse rotation.",
        lambda h, wrist: mended(h.T, wrist),
    ),
    Mistake(
        "phi and psi exchanged",
        "The first and the last angle stand in each other's place.",
        lambda h, wrist: mended(h, wrist)[::-1],
    ),
    Mistake(
        "degrees",
        "It returns degrees; radians are promised.",
        lambda h, wrist: mended(h, wrist) / deg,
    ),
)


# --- 3: a line past the singularity ---------------------------------------------------------------

HALF = 113 * mm  # half the line
T1 = np.linspace(0, 1, 401)
UNITS = {
    "slope": ("°", deg),
    "miss": ("mm", mm),
    "most_tilt": ("°", deg),
    "least_distance": ("", 1.0),
    "most_speed": ("°/s", deg),
    "longest": ("s", 1.0),
}


def tilted_line(slope: float, miss: float, up: float, side: float, s: Any) -> Transform:
    """Poses on a straight line that rises by `slope`, `miss` beside the singular pose: the tool
    points ahead along x, tilted up and to the side.
    """
    along = np.array([0, np.cos(slope), np.sin(slope)])
    across = np.array([0, -np.sin(slope), np.cos(slope)])
    tilt = turned(-up, Y) @ turned(side, Z)
    level = turned(90 * deg, Y) @ turned(180 * deg, Z)
    middle = np.array([400, 0, 200]) * mm + miss * across
    start, goal = (Transform(tilt @ level, middle + e * HALF * along) for e in (-1, 1))
    return lin(start, goal, s)


def passage(numbers: Mapping[str, Any], up: float, side: float) -> tuple[float, float]:
    """The smallest distance from a singularity on the line, and the greatest joint speed (rad/s) if
    it takes one second. NaN: a pose is out of reach.
    """
    poses = tilted_line(numbers["slope"], numbers["miss"], up, side, quintic(duration=1)(T1))
    rows = ITMO6R.ik(poses)
    if np.isnan(rows[:, ROW]).any():
        return np.nan, np.nan
    q = follow(ITMO6R, rows, ROW)
    least = float(distance_from_singularity(ITMO6R, q).min())
    return least, float(abs(differentiate(q, T1)).max())


def across(slope: float, tilt: float) -> list[tuple[float, float]]:
    """(up, side) of the two tilts square to the line."""
    return [(e * tilt * np.cos(slope), -e * tilt * np.sin(slope)) for e in (1, -1)]


@cache
def _given(who: str) -> tuple[tuple[str, float], ...]:
    roll = dice(LAB, who)
    slope = (25 + 5 * roll.randrange(6)) * (1 - 2 * roll.randrange(2)) * deg
    miss = (5 + roll.randrange(4)) * (1 - 2 * roll.randrange(2)) * mm
    tilt = (5 + roll.randrange(3)) * deg
    speed = (150 + 10 * roll.randrange(10)) * deg
    numbers = {"slope": slope, "miss": miss}
    found = [passage(numbers, *each) for each in across(slope, 0.97 * tilt)]
    least, fastest = max(pair for pair in found if np.isfinite(pair[0]))
    values = numbers | {
        "most_tilt": tilt,
        "least_distance": float(np.floor(930 * least)) / 1000,  # the other side stays below 0.86
        "most_speed": speed,
        "longest": float(np.ceil(11.5 * fastest / speed)) / 10,
    }
    return tuple(values.items())


def given(who: Any) -> Numbers:
    """A line a few millimetres beside the singular pose, and what the process allows. Solvable: the
    limits are drawn round the tilt square to the line, so that a tilt to one side keeps them and
    none to the other side does.
    """
    return Numbers(dict(_given(str(who))), UNITS)


def line_form(answer: Any, given: Any) -> dict[str, float]:
    """up, side and duration as floats."""
    names = ("up", "side", "duration")
    if not isinstance(answer, Mapping):
        raise ValueError(f"Wanted a dict with up, side and duration, got {words(answer)}.")
    missing = [name for name in names if name not in answer]
    if missing:
        raise ValueError(f"Your dict has no {' and no '.join(map(repr, missing))}.")
    numbers = {}
    for name in names:
        try:
            numbers[name] = one_number(answer[name])
        except (TypeError, ValueError):
            raise ValueError(f"{name}: wanted a number, got {words(answer[name])}.") from None
        if not np.isfinite(numbers[name]):
            raise ValueError(f"{name}: wanted a number, got {numbers[name]}.")
    if numbers["duration"] <= 0:
        raise ValueError(f"duration: wanted seconds above 0, got {numbers['duration']:g}.")
    return numbers


def _keeps(given: Mapping[str, Any], up: float, side: float) -> bool:
    """Whether this tilt is a tilt, not too far out, and keeps the distance."""
    if max(abs(up), abs(side)) > 2 * given["most_tilt"]:
        return False
    return bool(passage(given, up, side)[0] >= given["least_distance"])


def line_faults(answer: dict[str, float], given: Mapping[str, Any]) -> list[Fault]:
    """What does not hold: tilt, distance, speeds, duration."""
    up, side, duration = answer["up"], answer["side"], answer["duration"]
    tilt = np.arccos(np.clip(np.cos(up) * np.cos(side), -1, 1))
    faults = []
    if max(abs(up), abs(side)) > np.pi / 2:
        return [("degrees for radians", DEGREES)] * 3
    if tilt > given["most_tilt"] + 1e-9:
        is_at, most = apart(tilt / deg, given["most_tilt"] / deg, 2)
        says = f"The tilt is {is_at}°, and {most}° are allowed."
        faults.append(("tilted too far", says))
    least, fastest = passage(given, up, side)
    if np.isnan(least):
        says = "Not every pose of the line exists: the wrist centre comes too far out. Tilt less, "
        return [*faults, ("out of reach", says + "or another way.")] + [("out of reach", "")] * 2
    if least < given["least_distance"] - 1e-9:
        is_at, wanted = apart(least, given["least_distance"], 4)
        line = f"The smallest distance from a singularity on the line is {is_at}, and {wanted} "
        line += "are wanted."
        name = "too near the singularity"
        square = across(given["slope"], 1.0)[0]
        across_it = abs(np.dot(square, (up, side)))
        line += f" Your tilt is {tilt / deg:.2f}° of {given['most_tilt'] / deg:.0f}° allowed, and "
        line += f"{across_it / deg:.2f}° of it are square to the line."
        if _keeps(given, up / deg, side / deg):
            name = "deg twice"
            line += " Divided by deg once more, both tilts would do."
        elif tilt > 0.5 * given["most_tilt"] and across_it < 0.5 * tilt:
            name = "tilted along the line"
            line += " A tilt along the line lets the forearm pass the tool's direction a little "
            line += "earlier or later, and as near as before."
        elif max(abs(up), abs(side)) < 1e-3:
            name = "not tilted"
        else:
            other = passage(given, -up, -side)[0]
            if other >= given["least_distance"]:
                name = "tilted to the wrong side"
                line += f" Tilted as far to the other side it would be {other:.4f}."
                if _keeps(given, side, up):
                    line += " With up and side exchanged it would do, too."
            elif _keeps(given, side, up):
                name = "up and side exchanged"
                line += f" With the two exchanged it would be {passage(given, side, up)[0]:.4f}."
        faults.append((name, line))
    speed = fastest / duration
    if speed > given["most_speed"] * (1 + 1e-9):
        is_at, most = apart(speed / deg, given["most_speed"] / deg)
        says = f"The fastest joint goes {is_at}°/s; {most}°/s are allowed."
        faults.append(("too fast", says))
    if duration > given["longest"] + 1e-9:
        longest, takes = apart(given["longest"], duration)
        says = f"The line may take {longest} s; yours takes {takes} s."
        faults.append(("too slow", says))
    return faults


# --- The predictions' numbers and views -----------------------------------------------------------


@cache
def _origins_facts() -> dict[str, Any]:
    def ways(bend: float) -> list[float]:
        q = np.array([0, 60, -60, 0, bend, 0]) * deg + np.linspace(0, 90, 2)[:, None] * deg * (
            np.arange(6) == 3
        )
        places = ITMO6R.frames(q).translation
        return [float(x) / mm for x in np.linalg.norm(places[1] - places[0], axis=-1)]

    bent, straight = ways(45), ways(0)
    moving = [k for k, way in enumerate(bent) if way > 1e-6]
    return {"bent": bent, "moving": moving, "tool": bent[6], "straight": straight[6] + 0.0}


def _origins_view() -> str:
    bent = _origins_facts()["bent"]
    lines = ["How far each origin is from where it was, after 90° of joint 4:"]
    lines += [f"frame {k}: {way:.1f} mm" for k, way in enumerate(bent)]
    return "\n".join(lines)


def _centre_facts() -> dict[str, Any]:
    size = D[5] / mm
    tilts = {"up": Z, "along x": X, "down": -Z}
    off = {name: float(np.linalg.norm(size * way - size * Z)) for name, way in tilts.items()}
    half = size / 2
    return {"size": size, "off": off["along x"], "half": half, "down": off["down"], "up": off["up"]}


def _centre_view() -> str:
    size = D[5] / mm
    lines = ["How far o − (0, 0, d6) is from the wrist centre:"]
    for tilt in (0, 45, 90, 135, 180):
        off = 2 * size * np.sin(tilt * deg / 2)
        lines.append(f"tool {tilt}° away from straight up: {off:.1f} mm")
    return "\n".join(lines)


LEANING = _posture(30, 110, 40, 0, 60, 0)


@cache
def _facing_facts() -> dict[str, Any]:
    centre = ITMO6R.frames(LEANING)[4].translation
    first = float(np.arctan2(centre[1], centre[0])) / deg
    numbers = {
        "q1": float(LEANING[0]) / deg,
        "first": first,
        "opposite": -first,
        "less": float(LEANING[0]) / deg - 90,
        "x": float(centre[0]) / mm,
        "y": float(centre[1]) / mm,
    }
    said = {name: f"{value:.0f}".translate(MINUS) for name, value in numbers.items()}
    return {"numbers": numbers} | said


def _facing_right(facts: Mapping[str, Any]) -> int:
    numbers = facts["numbers"]
    centre = ITMO6R.frames(LEANING)[4].translation
    guesses = [numbers[name] * deg for name in ("q1", "first", "opposite", "less")]
    level = np.hypot(centre[0], centre[1])
    facing = [np.cos(q1) * centre[0] + np.sin(q1) * centre[1] for q1 in guesses]
    return int(np.argmin(abs(np.array(facing) - level)))


def _facing_view() -> Any:
    from ..show import plot_postures

    centre = ITMO6R.frames(LEANING)[4]
    title = "q2 = 110°: the upper arm leans back, and the wrist centre is behind axis 1"
    return plot_postures(ITMO6R, LEANING, targets={"wrist centre": centre}, title=title)


@cache
def _column_facts() -> dict[str, Any]:
    before, after = (zyz(53.0 * deg, 30.0 * deg, psi * deg)[:, 2] for psi in (20, 110))
    rolled = rot(2, 90 * deg)[:3, :3] @ before
    forms = {"before": before, "after": after, "rolled": rolled, "back": -before}
    return {k: ", ".join(f"{x:.2f}" for x in v + 0.0).translate(MINUS) for k, v in forms.items()}


def _column_right(facts: Mapping[str, Any]) -> int:
    return [facts[k] for k in ("rolled", "before", "back")].index(facts["after"])


def _column_view() -> str:
    lines = ["The third column for joint 4 at 53°, joint 5 at 30°, and joint 6 at"]
    for psi in (20, 65, 110, 200):
        column = zyz(53 * deg, 30 * deg, psi * deg)[:, 2]
        lines.append(f"{psi}°: " + ", ".join(f"{x:.2f}" for x in column))
    return "\n".join(lines)


TRIPLE = 30.0, 40.0, 50.0


@cache
def _second_facts() -> dict[str, Any]:
    phi, theta, psi = TRIPLE
    found = wrapped(mended(zyz(*np.array(TRIPLE) * deg), -1)) / deg
    triples: dict[str, Any] = {
        "given": TRIPLE,
        "found": found,
        "theta": (phi, -theta, psi),
        "all": (-phi, -theta, -psi),
        "one": (phi - 180, -theta, psi),
    }
    wanted = zyz(*np.array(TRIPLE) * deg)
    facts: dict[str, Any] = {
        name: "(" + ", ".join(f"{x:.0f}°" for x in each).translate(MINUS) + ")"
        for name, each in triples.items()
    }
    for name, each in triples.items():
        facts[f"off_{name}"] = float(abs(zyz(*np.array(each) * deg) - wanted).max())
    return facts


def _second_right(facts: Mapping[str, Any]) -> int:
    offs = [facts[f"off_{name}"] for name in ("theta", "all", "one", "found")]
    return int(np.argmin(offs))


def _second_view() -> str:
    facts = _second_facts()
    lines = [f"The greatest difference of an entry from the matrix of {facts['given']}:"]
    for name in ("theta", "all", "one", "found"):
        off = facts[f"off_{name}"]
        lines.append(f"{facts[name]}: " + (f"{off:.3f}" if off > 1e-12 else "below 1e-12"))
    return "\n".join(lines)


@cache
def _noise() -> tuple[Floats, Floats, Floats]:
    """Angles theta; the worst error of an entry for each of three solvers (angles, 3), among the
    postures of 200 where it gives a number; and the shares where it gives none.
    """
    q = np.random.default_rng(1).uniform(-180, 180, (200, 6)) * deg  # as in the lab
    thetas = 10.0 ** np.arange(0, -17, -1)
    worst, lost = np.zeros((2, len(thetas), 3))
    for i, theta in enumerate(thetas):
        q[:, 4] = theta
        frames = np.array([dh_frames(TOOLS, A, ALPHA, D, OFFSET + each) for each in q])[..., :3, :3]
        h = frames[:, 3].swapaxes(-1, -2) @ frames[:, 6]  # rounded, as in the lab's chain
        book, mine = textbook(h, +1), mended(h, +1)
        both = np.stack([book[:, 0], mine[:, 1], book[:, 2]], axis=-1)
        for k, found in enumerate((book, both, mine)):
            there = np.isfinite(found).all(axis=-1)
            worst[i, k] = abs(zyz(*found[there].T) - h[there]).max()
            lost[i, k] = 1 - there.mean()
    return np.asarray(thetas, dtype=float), worst, lost


def _noise_facts() -> dict[str, Any]:
    thetas, worst, lost = _noise()
    row = int(np.argmin(abs(thetas - 1e-9)))
    digit, power = f"{worst[row, 0]:.0e}".split("e")
    return {
        "worst": worst[row, 0],
        "lost": lost[row, 0],
        "power": f"{digit}·10{str(int(power)).translate(POWERS)}",
    }


POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def _noise_right(facts: Mapping[str, Any]) -> int:
    guesses = np.log10([1e-16, 1e-9, facts["worst"]])
    return 3 if facts["lost"] else int(abs(guesses - np.log10(facts["worst"])).argmin())


def _noise_view() -> Any:
    from ..show import figure

    thetas, worst, lost = _noise()
    fig = figure(
        "Above: the worst error of an entry among 200 postures against theta. With the textbook's "
        "formulas it grows in step with 1 / theta. With psi measured from phi it stays below "
        "2e-15 down to theta = 1e-12; at 1e-13, where phi is set to zero, it is 2e-13, and falls "
        "with theta. Below: from 1e-8 rad on the textbook's root gives no number for about one "
        "posture in five.",
        9,
        5,
    )
    ax, below = fig.subplots(2, 1, sharex=True, height_ratios=(2.6, 1))
    for k, style, color in ((0, "o--", "#D55E00"), (2, "s-", "#0072B2")):
        ax.loglog(thetas, worst[:, k], style, color=color, lw=2)
        below.plot(thetas, 100 * lost[:, k], style, color=color, lw=2)
    ax.text(2e-7, 3e-4, "textbook, where it gives a number", color="#B24A00", ha="right")
    ax.text(1e-6, 3e-14, "ψ measured from φ", color="#0072B2")
    ax.set(
        ylabel="worst of 200 postures",
        xlim=(3, 3e-17),
        ylim=(3e-17, 20),
        title="Near the singularity the textbook loses digits, then the number itself",
    )
    below.text(3e-7, 15, "textbook", color="#B24A00", ha="right")
    below.set(xlabel="θ, rad", ylabel="NaN, % of 200", ylim=(-5, 50))
    fig.align_ylabels()
    fig.subplots_adjust(bottom=0.12, top=0.93, hspace=0.1)
    return fig


def _joint_end(k: int, sign: int) -> float:
    """The least (+1) or greatest (-1) distance from a singularity while joint k + 1 alone turns by
    up to 150 degrees to either side: 201 samples, then 201 about the best of them, down to 1e-8
    degrees.
    """
    best, half = 0.0, 150.0
    while half > 1e-8:
        by = np.clip(best + half * np.linspace(-1, 1, 201), -150, 150)
        q = _posture(20, 70, -60, 30, 50, 10) + by[:, None] * deg * np.eye(6)[k]
        values = sign * distance_from_singularity(ITMO6R, q)
        best, half = float(by[values.argmin()]), half / 50
    return sign * float(values.min())


@cache
def _joints_facts() -> dict[str, Any]:
    low, high = ([_joint_end(k, sign) for k in range(6)] for sign in (1, -1))
    never = [k + 1 for k in range(6) if high[k] - low[k] < 1e-9]
    facts: dict[str, Any] = {"never": never}
    for k in range(6):
        facts |= {f"low{k + 1}": float(low[k]), f"high{k + 1}": float(high[k])}
    return facts


def _joints_right(facts: Mapping[str, Any]) -> int:
    return [[1], [1, 6], [1, 4, 6], [4, 6]].index(facts["never"])


def _joints_view() -> str:
    facts = _joints_facts()
    lines = ["From (20, 70, −60, 30, 50, 10)°, each joint alone by up to 150° to either side:"]
    for k in range(1, 7):
        low, high = facts[f"low{k}"], facts[f"high{k}"]
        span = f"{low:.3f} to {high:.3f}" if high - low > 1e-9 else f"always {low:.3f}"
        lines.append(f"joint {k}: {span}")
    return "\n".join(lines)


def _speeds(miss: float) -> tuple[Floats, Floats]:
    """Times about the hit and the speed of joint 4 there, °/s, on the line of the first screen;
    exactly, from the Jacobian.
    """
    t = np.concatenate([np.linspace(0, 4, 401), np.linspace(1.9, 2.1, 2001)])
    t.sort()
    law = quintic(duration=4)
    level = turned(90 * deg, Y) @ turned(180 * deg, Z)
    beside = miss * np.array([0, -1, 1]) / np.sqrt(2)
    start, goal = (np.array([400, e * 80, 200 + e * 80]) * mm + beside for e in (-1, 1))
    poses = lin(Transform(level, start), Transform(level, goal), law(t))
    rate = (law(t + 1e-6) - law(t - 1e-6)) / 2e-6
    velocity = np.concatenate([goal - start, np.zeros(3)]) * rate[:, None]
    q = ITMO6R.ik(poses)[:, ROW]
    speeds = np.linalg.solve(ITMO6R.jacobian(q), velocity[..., None])[..., 0]
    joint4: Floats = np.abs(speeds[:, 3]) / deg
    return np.asarray(t, dtype=float), joint4


def _fastest(miss: float) -> float:
    """The greatest speed of joint 4 on the line of the first screen, °/s."""
    return float(_speeds(miss)[1].max())


@cache
def _half_facts() -> dict[str, Any]:
    two, one = _fastest(2 * mm), _fastest(1 * mm)
    ends = ITMO6R.ik(tilted_line(45 * deg, 2 * mm, 0, 0, np.linspace(0, 1, 2001)))
    joint4 = follow(ITMO6R, ends, ROW)[:, 3]
    return {
        "turn": float(abs(joint4[-1] - joint4[0])) / deg,
        "two": two,
        "one": one,
        "half": two / 2,
        "root": np.sqrt(2) * two,
        "double": 2 * two,
        "four": 4 * two,
    }


def _half_right(facts: Mapping[str, Any]) -> int:
    guesses = [facts[name] for name in ("half", "root", "double", "four")]
    return int(np.argmin([abs(np.log(guess / facts["one"])) for guess in guesses]))


def _half_view() -> Any:
    from ..show import figure

    fig = figure(
        "The speed of joint 4 from 1.95 to 2.05 s on two lines. 2 mm beside the hit it goes up to "
        f"{_fastest(2 * mm):.0f}°/s, 1 mm beside it to {_fastest(1 * mm):.0f}°/s, and for half as "
        "long.",
        5.8,
        2.4,
    )
    ax = fig.subplots()
    for miss, color, at in ((2, "#0072B2", 2.012), (1, "#B24A00", 2.004)):
        t, speed = _speeds(miss * mm)
        near = abs(t - 2) <= 0.05
        ax.plot(t[near], speed[near], color=color, lw=2)
        words = f"{miss} mm beside: {speed.max():.0f}°/s"
        ax.text(at, 0.9 * speed.max(), words, color=color, va="center")
    ax.set(xlabel="time, s", ylabel="joint 4, °/s", ylim=(0, 6800), xticks=(1.95, 2, 2.05))
    fig.subplots_adjust(left=0.13, right=0.97, bottom=0.21, top=0.96)
    return fig


# --- The tables -----------------------------------------------------------------------------------

EXERCISES = {
    "1": Function(
        title="The axes of a table",
        task="The axes of all joints from a Denavit-Hartenberg table: a point of each and its "
        "direction, in base coordinates.",
        objective=1,
        hints=(
            "Compute the frames first, as my_chain does, with as many rows as the table has. Then "
            "ask of which frame the z axis is the axis of joint 1.",
            "Joint i turns about z of frame i − 1. Its origin is a point of the axis, the third "
            "column of its rotation the direction.",
            "frame, points, ways = np.eye(4), [], []; for each row: "
            "points.append(frame[:3, 3]); ways.append(frame[:3, 2]); frame = frame @ "
            "rot_z(offset[i] + q[i]) @ trans(0, 0, d[i]) @ trans(a[i], 0, 0) @ rot_x(alpha[i]). "
            "Return np.array(points), np.array(ways).",
        ),
        inputs=("a", "alpha", "d", "offset", "q"),
        right=_axes,
        cases=_axes_cases,
        form=_axes_form,
        law=_axes_law,
        same=_same_axes,
        mistakes=AXES_MISTAKES,
    ),
    "2": Catch(
        title="A test for wrist programs",
        task="A test that tells right wrist programs from wrong ones.",
        objective=2,
        hints=(
            "Make matrices of angles that you know, with zyz, and see whether the program's angles "
            "give the matrix back. Which angles would you leave out? Take these, too.",
            "Do not compare angles with angles: there are whole turns, and in the singularity one "
            "angle is free. Compare zyz(*found) with h, and the sign of theta with wrist. Refuse "
            "what is not good, since NaN compares false; and np.allclose has a relative tolerance.",
            "Take eight pairs phi, psi, 45° and random ones among them, with\n\n"
            "    for theta in (0, 1e-9, 1e-8, 1e-6, 1e-4, 0.5, 2, np.pi - 1e-8, np.pi):\n"
            "        for wrist in (+1, -1):\n"
            "            h = zyz(phi, theta, psi)\n"
            "            found = wrist_angles(h, wrist)\n"
            "            if not abs(zyz(*found) - h).max() < 1e-10:\n"
            "                return False\n"
            "            if not -1e-10 <= wrist * found[1] <= np.pi + 1e-10:\n"
            "                return False",
        ),
        rights=WRIST_RIGHTS,
        mistakes=WRIST_MISTAKES,
        promise="A right program gives angles whose matrix is h within 1e-10, with theta times "
        "wrist from 0 to pi; phi and psi may be whole turns away, and where one is free any "
        "choice is right.",
    ),
    "3": Value(
        title="A line of your own",
        task="Tilt the tool, and choose the duration, so that your line keeps its distance from "
        "the wrist singularity.",
        objective=3,
        hints=(
            "Seen against x, as in section 8, the forearm's direction sweeps past the tool's "
            "direction along the line. Which tilt takes the tool's direction out of its way?",
            "A tilt along the line changes when the two meet, a tilt square to the line how near. "
            "A line that rises by `slope` has the direction (side, up) = (cos, sin) of it; square "
            "to it is (−sin, cos), and the opposite.",
            "Take\n\n"
            "    n = my_numbers\n"
            "    tilt = 0.95 * n['most_tilt']\n"
            "    up, side = tilt * np.cos(n['slope']), -tilt * np.sin(n['slope'])\n\n"
            "then the same with both signs turned round. Of the two keep the "
            "one with the greater distance_from_singularity. The duration is the greatest speed "
            "for 1 s divided by n['most_speed'], and a little more.",
        ),
        form=line_form,
        faults=line_faults,
        count=4,
        given=given,
    ),
}

# Objective 1: p1 to p3. Objective 2: p4 to p6. Objective 3: p7, p8.
PREDICTIONS = {
    "p1": Prediction(
        question="The arm stands at (0, 60, −60, 0, 45, 0)°. Row 4 of its table has d = 200 mm. "
        "Joint 4 alone turns by 90°. Which of the origins of the frames 0 to 6 move?",
        options=(
            Option(
                "4, 5 and 6: frame 4 stands 200 mm away from frame 3.",
                "It does, along z of frame 3, and that is the very axis joint 4 turns about. What "
                "lies on an axis stays.",
                "d taken for a lever",
                "d1 = 100 mm lifts the shoulder of this arm. When joint 1 turns it stays where it "
                "is; a = 100 mm would swing it.",
            ),
            Option(
                "5 and 6: all frames behind joint 4.",
                "Frame 5 turns with joint 4, and its origin lies on the axis: it stays in its "
                "place.",
                "turned taken for moved",
                "A wheel's hub turns all day and stays at the end of its axle.",
            ),
            Option(
                "6 alone.",
                "The origins 4 and 5 lie on the axis of joint 4. The tool, {tool:.0f} mm from "
                "where it was, does not, because joint 5 is bent.",
            ),
            Option(
                "None: joint 4 turns the forearm about itself.",
                "The forearm, yes. Beyond joint 5 the tool stands aslant, 200 mm long.",
                "the bent wrist is left out",
                "With joint 5 at 0° you would be right: the tool moves by {straight:.0f} mm.",
            ),
        ),
        facts=_origins_facts,
        right=lambda facts: [[4, 5, 6], [5, 6], [6], []].index(facts["moving"]),
        view=_origins_view,
    ),
    "p2": Prediction(
        question="The tool is {size:.0f} mm long (d6) and looks along the base's x axis, level. "
        "Somebody who wants the wrist centre goes {size:.0f} mm straight down from the tool point: "
        "o − (0, 0, d6). How far from the wrist centre does that end?",
        options=(
            Option(
                "{off:.0f}",
                "The wrist centre is {size:.0f} mm behind the tool point. The two points are the "
                "ends of a right angle with two legs of {size:.0f} mm.",
            ),
            Option(
                "{size:.0f}",
                "That is one leg of the right angle: how far both points are from the tool.",
                "a leg for the hypotenuse",
                "A step of 1 m aside and one of 1 m ahead lead 1.41 m away.",
            ),
            Option(
                "{down:.0f}",
                "That goes along both legs, one after the other. As a straight distance it holds "
                "for a tool that looks down: the wrist centre is above it then.",
                "both legs added, or opposite for square",
                "90° apart and 180° apart are two things.",
            ),
            Option(
                "{half:.0f}",
                "That is half the tool, or d1 and a2 of other rows. Both legs are d6 long, and "
                "their ends are farther apart than one leg.",
                "a half, or another row's length",
                "The way from one corner of a square to the opposite one is longer than its side.",
            ),
            Option(
                "{up:.0f}",
                "That holds for a tool that looks straight up, and for no other.",
                "the base's z taken for the tool's",
                "A tool that looks down is off by {down:.0f} mm.",
            ),
        ),
        facts=_centre_facts,
        right=lambda facts: 0,
        view=_centre_view,
        unit="mm",
        within=0.02,
    ),
    "p3": Prediction(
        question="A posture has q1 = {q1}°, and its upper arm leans back: q2 = 110°, q3 = 40°. "
        "We compute the wrist centre, forget the posture, and ask atan2(y, x) of the wrist centre "
        "for joint 1. What comes out?",
        options=(
            Option(
                "{q1}°: the joint value that made it.",
                "atan2 knows the place, not the posture. The wrist centre is behind axis 1.",
                "the inverse must return what went in",
                "The inverse of a square returns 3 for 9, also where −3 went in.",
            ),
            Option(
                "{first}°: half a turn away.",
                "The wrist centre is at x = {x} mm, y = {y} mm, behind axis 1. The arm "
                "reaches it over its back; atan2 gives the joint value of an arm that faces it.",
            ),
            Option(
                "{opposite}°: the mirrored direction.",
                "Mirrored in the xz plane the wrist centre would be at another place.",
                "half a turn taken for a mirror",
                "The direction opposite to 90° is −90°, and opposite to 0° is 180°, not 0°.",
            ),
            Option(
                "{less}°: the lean takes 90° away.",
                "Joint 2 tilts the arm in its own upright plane, and that plane stays.",
                "joint 2 taken to turn about axis 1",
                "With q2 = 80° or 100° the upper arm stands in the same plane through axis 1.",
            ),
        ),
        facts=_facing_facts,
        right=_facing_right,
        view=_facing_view,
    ),
    "p4": Prediction(
        question="Seen from the forearm, the tool's z axis is the third column of a 3 x 3 matrix: "
        "({before}). Now joint 6 turns by 90°. What is the third column then?",
        options=(
            Option(
                "({rolled}): turned by 90° about the forearm.",
                "That is what joint 4 does: it turns about the forearm.",
                "joint 4 for joint 6",
                "With joint 5 at 90° the tool stands aside. Joint 6 rolls it about itself; joint 4 "
                "swings it round the forearm.",
            ),
            Option(
                "({before}): as before.",
                "Joint 6 turns the tool about its own z axis, and an axis does not turn about "
                "itself. So joints 4 and 5 alone point the tool: two angles for a direction.",
            ),
            Option(
                "({back}): the opposite.",
                "A quarter turn about z exchanges x and y up to signs, and leaves z.",
                "z taken for x or y",
                "A screwdriver that is turned goes on pointing at the screw.",
            ),
        ),
        facts=_column_facts,
        right=_column_right,
        view=_column_view,
    ),
    "p5": Prediction(
        question="The wrist stands at {given} in the joints 4, 5 and 6, and nothing is past a "
        "limit. Which other angles give the tool the same orientation?",
        options=(
            Option(
                "{theta}: joint 5 to the other side.",
                "That points the tool to the other side of the forearm. Joint 4 has to bring it "
                "round.",
                "theta alone",
                "For joint 5 at 90° the tool would point away from where it pointed.",
            ),
            Option(
                "{all}: every sign turned round.",
                "The inverse rotation has the signs turned round, and the order, too.",
                "signs for half turns",
                "(30°, 0°, 0°) and (−30°, 0°, 0°) differ by 60° about one axis.",
            ),
            Option(
                "{one}: joint 4 half a turn on, joint 5 back.",
                "The tool points the right way, and has been rolled by half a turn with it.",
                "the roll is forgotten",
                "A camera on this flange would see the world upside down.",
            ),
            Option(
                "{found}: joints 4 and 6 half a turn on, joint 5 back.",
                "Joint 4 turns the bend to the other side, joint 5 bends the other way, and joint "
                "6 takes back the half turn. So each orientation has two ways.",
            ),
        ),
        facts=_second_facts,
        right=_second_right,
        view=_second_view,
    ),
    "p6": Prediction(
        question="In 200 random postures joint 5 stands at 0.000 000 001 rad (10⁻⁹), not at zero. "
        "For each we compute R₆³ from the chain, in double precision (16 digits), let the textbook "
        "formulas find the three angles, and build the matrix of these angles. What becomes of "
        "the 200? (An error is the greatest one of a matrix entry.)",
        options=(
            Option(
                "All 200 come back, with errors of 10⁻¹⁶: double precision has 16 digits.",
                "φ and ψ are read from numbers of size 10⁻⁹, and these carry a rounding of 10⁻¹⁶: "
                "few digits are left.",
                "all digits survive",
                "1 − cos(10⁻⁹) is 5·10⁻¹⁹ on paper, and 0 in double precision.",
            ),
            Option(
                "All 200 come back, with errors up to 10⁻⁹: as small as the angle.",
                "So small an angle hardly matters, and its direction does: the other two angles "
                "are read from it. Where there is a number, the worst is off by {power}.",
                "a small angle makes a small error",
                "At the north pole a step of a millimetre takes you through any longitude.",
            ),
            Option(
                "All 200 come back, with errors up to {power}: more than half of the digits go.",
                "That is the worst of the postures with a number. The others have none.",
                "the root is forgotten",
                "Of 1 − h₃₃² rounding may leave a negative number, and it has no root.",
            ),
            Option(
                "Some give no number at all; the others come back with errors up to {power}.",
                "h₃₃ is rounded, now and then to more than 1, and √(1 − h₃₃²) is the root of a "
                "negative number: NaN, in {lost:.0%} of the postures. The others are off, the "
                "worst by {power}: around the singularity lies a zone where \u201cregular\u201d is "
                "true and the regular formulas are not to be trusted.",
            ),
        ),
        facts=_noise_facts,
        right=_noise_right,
        view=_noise_view,
    ),
    "p7": Prediction(
        question="From an ordinary posture each joint turns alone. Which joints never change how "
        "near the arm is to a singularity?",
        options=(
            Option(
                "Joint 1 alone.",
                "Joint 6 does not, either: it rolls the tool about an axis through the tool point, "
                "and moves no other axis.",
                "the last joint is forgotten",
                "Roll a screwdriver in your hand: your arm stays as free to move as before.",
            ),
            Option(
                "Joints 1 and 6.",
                "Joint 1 turns the whole arm, with everything it can do. Joint 6 rolls the tool "
                "about its own axis. The other four change the angles and distances between the "
                "axes.",
            ),
            Option(
                "Joints 1, 4 and 6.",
                "Joint 4 swings the tool point round the forearm, and with it the distances from "
                "the other axes: {low4:.3f} to {high4:.3f}.",
                "joint 4 taken for a roll of the tool",
                "With joint 5 at 0° joint 4 does roll the tool; then the arm is singular, whatever "
                "joint 4 does.",
            ),
            Option(
                "Joints 4 and 6: the wrist is singular when joint 5 is at zero, whatever they do.",
                "At zero, yes. The question is how near, and joint 1 is left out.",
                "zero taken for all values",
                "Turn your chair: what your arm can do does not change. That is joint 1.",
            ),
        ),
        facts=_joints_facts,
        right=_joints_right,
        view=_joints_view,
    ),
    "p8": Prediction(
        question="On the line 2 mm beside the hit joint 4 goes up to {two:.0f}°/s. We run the line "
        "1 mm beside it, in the same time. How fast does joint 4 go?",
        options=(
            Option(
                "{half:.0f}°/s: the hit is easy, and we come nearer to it.",
                "The hit needs next to no turn of joint 4. The line 2 mm beside it needs "
                "{turn:.0f}°, and the nearer the line, the less time there is.",
                "the hit taken for a limit",
                "A car that passes your nose by a metre makes you turn your head faster than one "
                "across the street.",
            ),
            Option(
                "{root:.0f}°/s: the root of 2 times as fast.",
                "A root would come in if the time went with the root of the distance. It goes with "
                "the distance.",
                "a root of the distance",
                "A plane at half the height passes overhead in half the time.",
            ),
            Option(
                "{double:.0f}°/s: half the distance, twice the speed.",
                "Seen along the tool, joint 4 turns with the line from where the tool points to "
                "where the forearm points. The forearm's direction goes past at a given pace, so "
                "this line turns fastest at pace over distance, when they are nearest.",
            ),
            Option(
                "{four:.0f}°/s: the inverse square.",
                "The acceleration goes so. A speed of turning is pace over distance.",
                "the square of the distance",
                "From a train the trees at half the distance pass by twice as fast.",
            ),
        ),
        facts=_half_facts,
        right=_half_right,
        view=_half_view,
    ),
}
