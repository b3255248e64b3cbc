"""Lab 01, frames and quaternions: its exercises and predictions.

The answers to each exercise come first, right and wrong, then the predictions' numbers and views;
the tables stand at the end.
"""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np

from .._arrays import Floats
from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, mm
from .exercises import words
from .mistakes import METRES, Mistake, Program, Tools
from .old import Catch, Fault, Function, Value
from .questions import Option, Prediction
from .told import apart, floats
from .variants import Numbers, dice

LAB = "frames_and_quaternions"
OBJECTIVES = (
    "chain frames in the right order, go back along a chain without solving equations, and write "
    "any link of an arm as four numbers",
    "turn points and compose turns with quaternions, and go from a quaternion to a matrix and back",
    "lead a frame from one turn to another the short way at constant angular speed, and tell a way "
    "that does not",
)

X, Y, Z = np.eye(3)
MINUS = str.maketrans("-", "\N{MINUS SIGN}")


def _trans(x: float, y: float, z: float) -> Floats:
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def _rot(axis: Floats, angle: float) -> Floats:
    c, s, cross = np.cos(angle), np.sin(angle), np.cross(axis, np.eye(3)).T
    matrix = np.eye(4)
    matrix[:3, :3] = c * np.eye(3) + s * cross + (1 - c) * np.outer(axis, axis)
    return matrix


# --- 1: seen from the flange ----------------------------------------------------------------------


def _dh(q: float, d: float, a: float, alpha: float) -> Floats:
    matrix: Floats = _rot(Z, q) @ _trans(a, 0, d) @ _rot(X, alpha)
    return matrix


def _rows(table: Floats, q: Floats) -> list[Floats]:
    return [
        _dh(offset + joint, d, a, alpha)
        for (offset, d, a, alpha), joint in zip(table, q, strict=True)
    ]


def _seen(tools: Tools, table: Floats, q: Floats, base_part: Floats) -> Transform:
    flange = Transform()
    for link in _rows(table, q):
        flange = tools.product(flange, Transform.from_matrix(link))
    seen: Transform = tools.product(tools.inverse(flange), Transform.from_matrix(base_part))
    return seen


def _seen_cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    part = _trans(0.3, 0.1, 0.2) @ _rot(Z, 40 * deg)

    def case(rows: list[list[float]], q: list[float], base_part: Floats = part) -> tuple[Any, ...]:
        return np.array(rows) * [deg, mm, mm, deg], np.array(q) * deg, base_part

    cases = [
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
        table = np.stack(
            [
                rng.uniform(-180, 180, count) * deg,
                rng.uniform(-0.5, 0.5, count),
                rng.uniform(0, 0.6, count),
                rng.uniform(-120, 120, count) * deg,
            ],
            axis=-1,
        ).round(3)
        q = rng.uniform(-180, 180, count).round() * deg
        axis = rng.normal(size=3)
        turn = Quaternion.from_angle_axis(rng.uniform(0, 3), axis / np.linalg.norm(axis))
        base_part = Transform(turn, rng.uniform(-1, 1, 3).round(3)).as_matrix()
        cases.append((table, q, base_part))
    return cases


def _matrix(result: Any, case: tuple[Any, ...]) -> Floats:
    if isinstance(result, Transform) and not result.shape:
        return result.as_matrix()
    wanted = "wanted a homogeneous matrix (4, 4)"
    try:
        matrix = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {words(result)}") from None
    if matrix.shape != (4, 4):
        more = ": the place alone, the turn is missing" if matrix.shape == (3,) else ""
        raise ValueError(f"{wanted}, got {words(result)}{more}")
    return matrix


def _seen_law(case: tuple[Any, ...], yours: Floats) -> str | None:
    table, q, base_part = case
    wanted = _matrix(_seen(Tools(), table, q, base_part), case)
    if np.allclose(yours, wanted, rtol=0, atol=1e-6):
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
        return row + f"the last row should be {last}, and is {is_last}"
    if not np.allclose(yours[:3, 3], wanted[:3, 3], rtol=0, atol=1e-6):
        place, is_at = apart(wanted[:3, 3] / mm, yours[:3, 3] / mm)
        return (
            f"{row}the part should be at ({place}) mm, seen from the flange, and is at ({is_at}) mm"
        )
    k = int(abs(yours[:3, :3] - wanted[:3, :3]).max(axis=0).argmax())
    axis, is_axis = apart(wanted[:3, k], yours[:3, k], 3)
    name = "xyz"[k]
    return f"{row}the place is right; the part's {name} axis should be ({axis}), and is ({is_axis})"


def _row(values: Floats, digits: int = 1) -> str:
    return ", ".join(f"{x:.{digits}f}" for x in np.round(values, digits) + 0.0)


def _same_matrix(a: Floats, b: Floats) -> bool:
    return np.allclose(a, b, rtol=0, atol=1e-6)


def _product(links: list[Floats]) -> Floats:
    flange = np.eye(4)
    for link in links:
        flange = flange @ link
    return flange


def _with(
    link: Program = _dh,
    joint: Program = lambda offset, q: offset + q,
    chain: Program = _product,
    seen: Program = lambda flange, part: np.linalg.inv(flange) @ part,
) -> Program:
    """The right program with one of its parts exchanged."""

    def program(table: Floats, q: Floats, base_part: Floats) -> Any:
        links = [link(joint(row[0], x), *row[1:]) for row, x in zip(table, q, strict=True)]
        return seen(chain(links), base_part)

    return program


def _back(turn: Program, shift: Program) -> Program:
    """An inverse made of a turn and a shift, times the part."""

    def seen(flange: Floats, part: Floats) -> Floats:
        rotation, p = flange[:3, :3], flange[:3, 3]
        back = np.eye(4)
        back[:3, :3], back[:3, 3] = turn(rotation), shift(rotation, p)
        return back @ part

    return seen


def _difference(flange: Floats, part: Floats) -> Floats:
    seen = part.copy()
    seen[:3, 3] -= flange[:3, 3]
    return seen


def _place_only(flange: Floats, part: Floats) -> Floats:
    seen = np.linalg.inv(flange) @ part
    seen[:3, :3] = part[:3, :3]
    return seen


def _parts(turn: Floats, axes: Floats, flange: Floats, part: Floats) -> Floats:
    """The part's turn by `turn`, and the way from flange to part in `axes`."""
    seen = np.eye(4)
    seen[:3, :3] = turn @ part[:3, :3]
    seen[:3, 3] = axes @ (part - flange)[:3, 3]
    return seen


def _sided(flange: Floats, part: Floats) -> Floats:
    seen = np.linalg.inv(flange) @ part
    seen[:3, :3] = part[:3, :3] @ flange[:3, :3].T
    return seen


def _misread(table: Floats, q: Floats, base_part: Floats) -> Any:
    """The columns as a, alpha, d, offset."""
    links = [_dh(row[3] + x, row[2], row[0], row[1]) for row, x in zip(table, q, strict=True)]
    return np.linalg.inv(_product(links)) @ base_part


INVERSE = "The inverse of the flange's matrix has R^T as its turn and -R^T p as its shift."
ORDER = (
    "A row is Rot(z) Trans(0, 0, d) Trans(a, 0, 0) Rot(x), from left to right: the steps on z come "
    "first."
)
SEEN_MISTAKES = (
    Mistake(
        "no inverse",
        "You multiply base_flange by base_part: the inner names do not cancel. Wanted is "
        "flange_base @ base_part.",
        _with(seen=lambda flange, part: flange @ part),
    ),
    Mistake(
        "the inverse on the wrong side",
        "The inverse stands at the right: base_part @ flange_base. The names cancel in "
        "flange_base @ base_part.",
        _with(seen=lambda flange, part: part @ np.linalg.inv(flange)),
    ),
    Mistake(
        "the flange, seen from the part",
        "This is the flange seen from the part: the inverse of what is wanted.",
        _with(seen=lambda flange, part: np.linalg.inv(part) @ flange),
    ),
    Mistake(
        "-p for -R^T p",
        f"The shift back is measured in the flange's axes. {INVERSE}",
        _with(seen=_back(lambda r: r.T, lambda r, p: -p)),
    ),
    Mistake(
        "-R p for -R^T p",
        f"The shift is turned on instead of back. {INVERSE}",
        _with(seen=_back(lambda r: r.T, lambda r, p: -r @ p)),
    ),
    Mistake(
        "R^T p without its sign",
        f"The minus of the shift is missing. {INVERSE}",
        _with(seen=_back(lambda r: r.T, lambda r, p: r.T @ p)),
    ),
    Mistake(
        "R for R^T",
        f"The turn of the inverse is not turned back. {INVERSE}",
        _with(seen=_back(lambda r: r, lambda r, p: -r.T @ p)),
    ),
    Mistake(
        "only the signs of the shift",
        f"You change the sign of the shift and leave the turn as it is. {INVERSE}",
        _with(seen=_back(lambda r: r, lambda r, p: -p)),
    ),
    Mistake(
        "transposed for inverse",
        "The whole matrix is transposed: then the shift stands in the last row. Transposing "
        f"inverts the rotation R alone. {INVERSE}",
        _with(seen=lambda flange, part: flange.T @ part),
    ),
    Mistake(
        "the difference in base axes",
        "You subtract the places. That is the way from flange to part in base axes; the flange is "
        "turned.",
        _with(seen=_difference),
    ),
    Mistake(
        "the part's turn is left in base axes",
        "The place is right; the turn of the part is still seen from the base.",
        _with(seen=_place_only),
    ),
    Mistake(
        "the flange alone",
        "This is where the flange is: the part makes no difference.",
        _with(seen=lambda flange, part: flange),
    ),
    Mistake(
        "the base, seen from the flange",
        "This is the inverse of the flange's matrix: the part makes no difference.",
        _with(seen=lambda flange, part: np.linalg.inv(flange)),
    ),
    Mistake(
        "the chain from the wrong end",
        "The rows are multiplied in the wrong order. Wanted is flange = flange @ row for each new "
        "row; of inverses the last row's comes first: (A B)⁻¹ = B⁻¹ A⁻¹.",
        _with(chain=lambda links: _product(links[::-1])),
    ),
    Mistake(
        "only the last row",
        "Only the last row of the table counts. Each row is multiplied to what is there: flange = "
        "flange @ row.",
        _with(chain=lambda links: links[-1]),
    ),
    Mistake(
        "only the first row",
        "Only the first row of the table counts. The loop has to come to its end before the "
        "return.",
        _with(chain=lambda links: links[0]),
    ),
    Mistake(
        "the last row is missing",
        "The last row of the table is left out: range(n) counts to n - 1 already.",
        _with(chain=lambda links: _product(links[:-1])),
    ),
    Mistake(
        "the first row is missing",
        "The first row of the table is left out: rows are counted from 0.",
        _with(chain=lambda links: _product(links[1:])),
    ),
    Mistake(
        "always three rows",
        "Only the first three rows count. A table may have any number.",
        _with(chain=lambda links: _product(links[:3])),
    ),
    Mistake(
        "always six rows",
        "Only the first six rows count. A table may have any number.",
        _with(chain=lambda links: _product(links[:6])),
    ),
    Mistake(
        "the offset is forgotten",
        "The joint angle is added to the offset of its row.",
        _with(joint=lambda offset, q: q),
    ),
    Mistake(
        "the joint angles are forgotten",
        "The offsets alone: the joints never turn.",
        _with(joint=lambda offset, q: offset),
    ),
    Mistake(
        "the offset is subtracted",
        "The joint angle is added to the offset of its row: offset + q.",
        _with(joint=lambda offset, q: q - offset),
    ),
    Mistake(
        "d and a exchanged",
        "d is the shift along z (the joint axis), a the shift along x (the link).",
        _with(link=lambda q, d, a, alpha: _dh(q, a, d, alpha)),
    ),
    Mistake(
        "the columns in another order",
        "A row is (offset, d, a, alpha) here; dh_links takes a, alpha, d, theta.",
        _misread,
    ),
    Mistake(
        "the sign of alpha",
        "alpha tilts the other way.",
        _with(link=lambda q, d, a, alpha: _dh(q, d, a, -alpha)),
    ),
    Mistake(
        "the steps on x before those on z",
        ORDER,
        _with(
            link=lambda q, d, a, alpha: (
                _rot(X, alpha) @ _trans(a, 0, 0) @ _rot(Z, q) @ _trans(0, 0, d)
            )
        ),
    ),
    Mistake(
        "a before the turn",
        f"The link goes along the x axis that was not turned yet. {ORDER}",
        _with(link=lambda q, d, a, alpha: _trans(a, 0, d) @ _rot(Z, q) @ _rot(X, alpha)),
    ),
    Mistake(
        "both turns before the shifts",
        f"d goes along the axis that is tilted already. {ORDER}",
        _with(link=lambda q, d, a, alpha: _rot(Z, q) @ _rot(X, alpha) @ _trans(a, 0, d)),
    ),
    Mistake(
        "alpha about another axis",
        "alpha turns about x, the common perpendicular, not about y.",
        _with(link=lambda q, d, a, alpha: _rot(Z, q) @ _trans(a, 0, d) @ _rot(Y, alpha)),
    ),
    Mistake(
        "alpha about another axis",
        "alpha turns about x, the common perpendicular, not about z.",
        _with(link=lambda q, d, a, alpha: _rot(Z, q) @ _trans(a, 0, d) @ _rot(Z, alpha)),
    ),
    Mistake(
        "alpha is left out",
        "Rot(x, alpha) is missing at the end of each row.",
        _with(link=lambda q, d, a, alpha: _dh(q, d, a, 0)),
    ),
    Mistake(
        "d is left out",
        "The shift along the joint axis is missing.",
        _with(link=lambda q, d, a, alpha: _dh(q, 0, a, alpha)),
    ),
    Mistake(
        "a is left out",
        "The length of the link is missing.",
        _with(link=lambda q, d, a, alpha: _dh(q, d, 0, alpha)),
    ),
    Mistake(
        "degrees for radians",
        "All angles are in radians already: do not multiply them by deg (np.radians).",
        _with(link=lambda q, d, a, alpha: _dh(q * deg, d, a, alpha * deg)),
    ),
    Mistake(
        "the inverse of the part as well",
        "The part is inverted, too: it stands there as base_part already, and that fits.",
        _with(seen=lambda flange, part: np.linalg.inv(flange) @ np.linalg.inv(part)),
    ),
    Mistake(
        "the inverse of the other matrix",
        "The part is inverted instead of the flange: wanted is flange_base @ base_part.",
        _with(seen=lambda flange, part: flange @ np.linalg.inv(part)),
    ),
    Mistake(
        "the inverse of the product",
        "You multiply first and invert the product. Only the flange is to be inverted.",
        _with(seen=lambda flange, part: np.linalg.inv(flange @ part)),
    ),
    Mistake(
        "no inverse, and the other order",
        "You multiply base_part by base_flange: no names cancel, as they do in "
        "flange_base @ base_part.",
        _with(seen=lambda flange, part: part @ flange),
    ),
    Mistake(
        "from both sides",
        "The matrix of the flange stands on both sides. A pose is multiplied from one side; "
        "wanted is flange_base @ base_part.",
        _with(seen=lambda flange, part: np.linalg.inv(flange) @ part @ flange),
    ),
    Mistake(
        "the shift back is left out",
        f"The turn is undone, the place of the flange is not. {INVERSE}",
        _with(seen=_back(lambda r: r.T, lambda r, p: 0 * p)),
    ),
    Mistake(
        "the turn back is left out",
        f"You undo the place of the flange as it is seen from the flange, not its turn. {INVERSE}",
        _with(seen=_back(lambda r: np.eye(3), lambda r, p: -r.T @ p)),
    ),
    Mistake(
        "the place in base axes",
        "The turn of the part is right; its place is the difference in base axes: R^T times it.",
        _with(seen=lambda flange, part: _parts(flange[:3, :3].T, np.eye(3), flange, part)),
    ),
    Mistake(
        "R for R^T, everywhere",
        "You take the difference and turn it on by R. Turn it back, by R^T.",
        _with(seen=lambda flange, part: _parts(flange[:3, :3], flange[:3, :3], flange, part)),
    ),
    Mistake(
        "the part's turn on the wrong side",
        "The place is right; for the turn R^T stands at the left of the part's.",
        _with(seen=_sided),
    ),
    Mistake(
        "matrices subtracted",
        "Poses are not subtracted: the way from one to the other is inverse(one) @ other.",
        _with(seen=lambda flange, part: part - flange),
    ),
    Mistake(
        "rows added",
        "The matrices of the rows are added. Poses are multiplied.",
        _with(chain=lambda links: np.sum(links, axis=0)),
    ),
    Mistake(
        "element-wise product",
        "`*` multiplies element by element; the product of matrices is `@`.",
        _with(seen=lambda flange, part: np.linalg.inv(flange) * part),
    ),
    Mistake(
        "the turn of a row the other way",
        "Each joint turns clockwise. A positive angle turns from x to y.",
        _with(joint=lambda offset, q: -(offset + q)),
    ),
    Mistake(
        "the first joint angle for all",
        "Every row is given q[0]: each has its own.",
        lambda table, q, part: _with()(table, np.full_like(q, q[0]), part),
    ),
    Mistake(
        "only the first joint turns",
        "All joints but the first stand at their offsets.",
        lambda table, q, part: _with()(table, q * (np.arange(len(q)) == 0), part),
    ),
    Mistake(
        "q added to the shift",
        "These joints turn: q adds to the offset, not to d.",
        lambda table, q, part: _with(joint=lambda offset, x: offset)(
            table + q[:, None] * [0, 1, 0, 0], q, part
        ),
    ),
    Mistake(
        "degrees for radians",
        "All angles are in radians already: do not divide them by deg (np.degrees).",
        _with(link=lambda q, d, a, alpha: _dh(q / deg, d, a, alpha / deg)),
    ),
    Mistake("mm for m", METRES, _with(link=lambda q, d, a, alpha: _dh(q, d * mm, a * mm, alpha))),
    Mistake("mm for m", METRES, _with(link=lambda q, d, a, alpha: _dh(q, d / mm, a / mm, alpha))),
    Mistake(
        "a and alpha exchanged",
        "A row is (offset, d, a, alpha): first the length, then the angle.",
        _with(link=lambda q, d, a, alpha: _dh(q, d, alpha, a)),
    ),
    Mistake(
        "the columns in another order",
        "A row is (offset, d, a, alpha) here, from left to right.",
        lambda table, q, part: _with()(table[:, ::-1], q, part),
    ),
    Mistake(
        "the columns in another order",
        "A row is (offset, d, a, alpha) here: not (offset, alpha, a, d).",
        lambda table, q, part: _with()(table[:, [0, 3, 2, 1]], q, part),
    ),
    Mistake(
        "a along y",
        "a goes along the x axis after the turn, not along y.",
        _with(link=lambda q, d, a, alpha: _rot(Z, q) @ _trans(0, a, d) @ _rot(X, alpha)),
    ),
)


# --- 2: a camera that looks at a part -------------------------------------------------------------

NEAR = 0.1 * deg
UNITS = dict.fromkeys(("eye_x", "eye_y", "eye_z", "part_x", "part_y", "part_z"), ("mm", mm))


def given(who: Any) -> Numbers:
    """Where the camera stands, and a part that lies lower and to the side."""
    roll = dice(LAB, who)

    def signed(low: int, steps: int) -> int:
        return (low + 10 * roll.randrange(steps)) * (1 - 2 * roll.randrange(2))

    eye = [signed(200, 16), signed(150, 16), 550 + 10 * roll.randrange(20)]
    part = [eye[0] + signed(250, 11), eye[1] + signed(120, 10), 10 * roll.randrange(16)]
    return Numbers({k: x * mm for k, x in zip(UNITS, eye + part, strict=True)}, UNITS)


def _places(given: Mapping[str, Any]) -> tuple[Floats, Floats]:
    values = np.array([given[key] for key in UNITS])
    return values[:3], values[3:]


def camera_form(answer: Any, given: Any) -> Transform:
    """One pose."""
    if isinstance(answer, Transform) and answer.shape == ():
        return answer
    wanted = "Wanted one Transform, the pose of the camera"
    if isinstance(answer, Quaternion):
        raise ValueError(f"{wanted}: the turn is there, the place is missing.")
    with np.errstate(all="ignore"):
        shape = np.shape(answer)
    if shape == (4, 4):
        try:
            return Transform.from_matrix(floats(answer))
        except (TypeError, ValueError) as error:
            raise ValueError(f"{wanted}. Your matrix is no pose: {error}") from None
    hint = ": a place without a turn" if shape == (3,) else ""
    hint = ": a matrix of a turn without a place" if shape == (3, 3) else hint
    raise ValueError(f"{wanted}, got {words(answer)}{hint}.")


def _unit(vector: Floats) -> Floats:
    length = np.linalg.norm(vector)
    return vector / length if length > 0 else Z


def _apart(a: Floats, b: Floats) -> float:
    return float(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b))


def camera_faults(camera: Transform, given: Mapping[str, Any]) -> list[Fault]:
    """The place; where z goes; x is level; y points down."""
    back = camera.inverse()
    if _faults(camera, given) and not _faults(back, given):
        says = "This is the base, seen from the camera: the inverse of the camera's pose."
        return [("the base, seen from the camera", says)] * 4
    return _faults(camera, given)


def _faults(camera: Transform, given: Mapping[str, Any]) -> list[Fault]:
    eye, part = _places(given)
    found = [*_misplaced(camera.translation, eye, part)]
    rotation = camera.rotation.as_matrix()
    if not np.isfinite(rotation).all():
        return [("NaN", "A NaN stands where a number should.")] * 4
    x, y, z = rotation.T
    look = _unit(part - eye)
    if _apart(z, look) > NEAR:
        found += [_looking(rotation, look, eye, part)] * 2
    tilt, rise = (float(np.arcsin(np.clip(axis[2], -1, 1))) for axis in (x, y))
    if abs(tilt) > NEAR:
        short = np.cross(Z, look)
        turn = Quaternion.from_angle_axis(_apart(Z, look), _unit(short))
        degrees = apart(abs(tilt) / deg, 0)[0]
        says = f"The x axis should be level; it is {degrees}° out of the horizontal."
        if float(turn.angle_to(camera.rotation)) < NEAR:
            name = "the shortest turn"
            says += (
                " The shortest turn from z to the line of sight leaves the turn about this line to "
                "chance."
            )
        else:
            name = "not level"
        found.append((name, says))
    elif abs(rise) <= NEAR:
        found.append(("y is level", "The y axis should point down, and is level."))
    elif rise > 0:
        says = f"The y axis should point down, and points {rise / deg:.1f}° up."
        if not found:
            says += " Turn the camera by 180° about its line of sight."
        found.append(("upside down", says))
    return found[:4]


def _misplaced(place: Floats, eye: Floats, part: Floats) -> list[Fault]:
    off = float(np.linalg.norm(place - eye))
    if off <= 1 * mm:
        return []
    should, stands = apart(eye / mm, place / mm)
    told = f"It should stand at ({should}) mm and stands at ({stands}) mm."
    if np.linalg.norm(place) > 20:
        return [("mm for m", f"{told} {METRES}")]
    for name, other in (
        ("the part's place for the camera's", part),
        ("the way from camera to part for the place", part - eye),
        ("the way from part to camera for the place", eye - part),
        ("the sign of the place", -eye),
        ("no place", 0 * eye),
    ):
        if np.linalg.norm(place - other) < 1 * mm:
            return [(name, told)]
    return [("not at your place", told)]


def _swung(look: Floats) -> Quaternion:
    """About z, until the camera's y axis has the direction of the line of sight."""
    return Quaternion.from_angle_axis(float(np.arctan2(look[1], look[0])) - np.pi / 2, Z)


def _tilted(look: Floats) -> Quaternion:
    """About the level x axis, from straight up to the line of sight."""
    return Quaternion.from_angle_axis(-_apart(Z, look), X)


def _looking(rotation: Floats, look: Floats, eye: Floats, part: Floats) -> Fault:
    x, y, z = rotation.T
    angle = _apart(z, look)
    told = f"The z axis should point at the part; it points {angle / deg:.1f}° beside it."
    names = (
        ("looks away", z, -look, "It looks exactly the other way: part - eye, not eye - part."),
        (
            "the inverse turn",
            rotation[2],
            look,
            "The inverse turn would look at it. The turned axes are the columns, not the rows.",
        ),
        ("x looks at the part", x, look, "It is the x axis that looks at the part."),
        ("y looks at the part", y, look, "It is the y axis that looks at the part."),
        ("x looks away from the part", x, -look, "It is the x axis that lies along the line."),
        ("y looks away from the part", y, -look, "It is the y axis that lies along the line."),
        (
            "seen from the base",
            z,
            _unit(part),
            "It looks along the line from the base to the part. The camera stands at eye: part - "
            "eye.",
        ),
        ("the sum for the difference", z, _unit(part + eye), "The line goes along part - eye."),
        ("looks at the base", z, _unit(-eye), "It looks at the origin of the base."),
        ("looks at the base", z, _unit(eye), "It looks along the line from the base to itself."),
        ("not turned", z, Z, "The z axis is where it was."),
        ("straight down", z, -Z, "It looks straight down."),
        (
            "to the opposite side",
            z,
            look * [-1, -1, 1],
            "It looks to the opposite side: half a turn about z is missing, as with arctan where "
            "arctan2 belongs.",
        ),
        *(
            (
                "a quarter turn off",
                z,
                np.array([-sign * look[1], sign * look[0], look[2]]),
                "It is a quarter turn off about z: with no turn the camera's x axis, not its y "
                "axis, lies along x of the base.",
            )
            for sign in (+1, -1)
        ),
        (
            "the order of the turns",
            z,
            _tilted(look) @ _swung(look) @ Z,
            "The two turns are in the wrong order: the tilt belongs to the turned camera, and "
            "stands at the right.",
        ),
        ("looks up", z, look * [1, 1, -1], "It looks up as steeply as it should look down."),
        ("mirrored", z, look * [1, -1, 1], "The sign of y is turned round: the turn about z."),
        ("mirrored", z, look * [-1, 1, 1], "The sign of x is turned round: the turn about z."),
        (
            "x and y exchanged",
            z,
            look[[1, 0, 2]],
            "x and y are exchanged: arctan2 takes y first.",
        ),
        ("half of the turn", z, _unit(Z + look), "It is turned half of the way."),
        (
            "twice the turn",
            z,
            2 * look[2] * look - Z,
            "It is turned twice as far as it should be.",
        ),
        (
            "sine and cosine of the slope exchanged",
            z,
            _unit(
                np.append(
                    look[:2] / max(np.hypot(*look[:2]), 1e-9) * abs(look[2]), -np.hypot(*look[:2])
                )
            ),
            "Its slope is the right angle measured from the other line: from z for from the "
            "horizontal, or the other way round.",
        ),
        (
            "level: the height is left out",
            z,
            _unit(look * [1, 1, 0]),
            "It looks in the right direction of the compass, but not down.",
        ),
    )
    for name, axis, other, says in names:
        if _apart(axis, other) < NEAR:
            return name, f"{told} {says}"
    return "looks past the part", told


# --- 3: a test for slerp --------------------------------------------------------------------------


def _angle(a: Floats, b: Floats) -> float:
    """Of the arc between two quaternions, in four dimensions."""
    return 2 * float(np.arctan2(np.linalg.norm(a - b), np.linalg.norm(a + b)))


def _arc(a: Floats, b: Floats, s: float) -> Floats:
    """Slerp towards b as it is written."""
    beta = _angle(a, b)
    if beta < 1e-12:
        return a.copy()
    if np.pi - beta < 1e-9:  # b is -a: an arc, but which?
        return a.copy()
    arc: Floats = (np.sin((1 - s) * beta) * a + np.sin(s * beta) * b) / np.sin(beta)
    return arc


def _near(a: Floats, b: Floats) -> Floats:
    return b if a @ b >= 0 else -b


def _good(a: Floats, b: Floats, s: float) -> Floats:
    return _arc(a, _near(a, b), s)


def _times(a: Floats, b: Floats) -> Floats:
    w, u = a[0] * b[0] - a[1:] @ b[1:], a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])
    return np.array([w, *u])


def _back_turn(a: Floats) -> Floats:
    turned: Floats = a * [1, -1, -1, -1]
    return turned


def _power(q: Floats, s: float) -> Floats:
    """The turn by s times the angle of q, the short way."""
    q = q if q[0] >= 0 else -q
    half, sine = np.arctan2(np.linalg.norm(q[1:]), q[0]), np.linalg.norm(q[1:])
    if sine < 1e-15:
        return np.array([1.0, 0, 0, 0])
    return np.array([np.cos(s * half), *(np.sin(s * half) * q[1:] / sine)])


def _chord(a: Floats, b: Floats, s: float) -> Floats:
    chord: Floats = (1 - s) * a + s * b
    return chord


def _long(q: Floats) -> Floats:
    length = np.linalg.norm(q)
    unit: Floats = q / length if length > 0 else q
    return unit


def _nearly(a: Floats, b: Floats, s: float) -> Floats:
    b = _near(a, b)
    return _long(_chord(a, b, s)) if a @ b > 1 - 1e-12 else _arc(a, b, s)


def _textbook(a: Floats, b: Floats, s: float) -> Floats:
    """No care for equal turns."""
    b = _near(a, b)
    beta = np.arccos(np.clip(a @ b, -1, 1))
    found: Floats = (np.sin((1 - s) * beta) * a + np.sin(s * beta) * b) / np.sin(beta)
    return found


def _of_lists(lead: Program) -> Program:
    """The program, for a and b given as arrays or as lists."""
    return lambda a, b, s: lead(floats(a), floats(b), s)


RIGHT_LEADS: tuple[tuple[str, Program], ...] = (
    ("the formula, the sign of b flipped where it has to be", _good),
    ("the formula, the sign of a flipped instead", lambda a, b, s: _arc(_near(b, a), b, s)),
    ("the lerp of nearly equal turns, the formula for others", _nearly),
    (
        "a times a part of the turn from a to b",
        lambda a, b, s: _times(a, _power(_times(_back_turn(a), b), s)),
    ),
    (
        "a part of the turn from a to b, seen from the base, times a",
        lambda a, b, s: _times(_power(_times(b, _back_turn(a)), s), a),
    ),
    ("robokin's slerp", lambda a, b, s: Quaternion(a).slerp(Quaternion(b), s).wxyz),
    ("the other sign of the result", lambda a, b, s: -_good(a, b, s)),
    ("rounded to eight digits after the point", lambda a, b, s: _good(a, b, s).round(8)),
    ("its result is a list", lambda a, b, s: _good(a, b, s).tolist()),
)


def _swapped(a: Floats, b: Floats, s: float) -> Floats:
    return _good(b, a, s)


def _doubled(a: Floats, b: Floats, s: float) -> Floats:
    """The angle of the turn where that of the arc belongs."""
    b = _near(a, b)
    turn = 2 * _angle(a, b)
    if turn < 1e-12:
        return a.copy()
    return _long((np.sin((1 - s) * turn) * a + np.sin(s * turn) * b) / np.sin(turn))


def _far(a: Floats, b: Floats, s: float) -> Floats:
    b = -_near(a, b)
    return a.copy() if np.pi - _angle(a, b) < 1e-9 else _arc(a, b, s)


def _flipped_beyond(turn: float) -> Program:
    """b is flipped where the turn is larger than that."""

    def lead(a: Floats, b: Floats, s: float) -> Floats:
        near = _near(a, b)
        return _arc(a, near if a @ near >= np.cos(turn / 2) else -near, s)

    return lead


def _stays_far(a: Floats, b: Floats, s: float) -> Floats:
    """Turns beyond 170° are taken for half a turn, without a way."""
    return a.copy() if abs(a @ b) < np.cos(85 * deg) else _good(a, b, s)


def _absolute(a: Floats, b: Floats, s: float) -> Floats:
    """abs(a @ b), and b as it is."""
    beta = float(np.arccos(np.clip(abs(a @ b), 0, 1)))
    if beta < 1e-7:
        return _long(_chord(a, b, s))
    found: Floats = (np.sin((1 - s) * beta) * a + np.sin(s * beta) * b) / np.sin(beta)
    return found


def _early(a: Floats, b: Floats, s: float) -> Floats:
    b = _near(a, b)
    return _long(_chord(a, b, s)) if a @ b > 0.95 else _arc(a, b, s)


def _angles(q: Floats) -> Floats:
    return np.array([float(x) for x in Quaternion(q).as_roll_pitch_yaw()])


def _of_angles(a: Floats, b: Floats, s: float) -> Floats:
    roll, pitch, yaw = (1 - s) * _angles(a) + s * _angles(b)
    return Quaternion.from_roll_pitch_yaw(roll, pitch, yaw).wxyz


LEAD_MISTAKES = (
    Mistake(
        "lerp",
        "It takes the straight chord: the result is too short on the way. Look at its length, not "
        "at s = 0 and 1 alone.",
        lambda a, b, s: _chord(a, _near(a, b), s),
    ),
    Mistake(
        "nlerp",
        "It takes the chord and divides by its length: right at s = 0, 1/2 and 1, uneven in "
        "between. Look at s = 1/4 of a large turn.",
        lambda a, b, s: _long(_chord(a, _near(a, b), s)),
    ),
    Mistake(
        "nlerp of what is not near",
        "It takes the chord where the two are not far apart: a turn of 30° shows it, with 1e-6.",
        _early,
    ),
    Mistake(
        "the long way where b has the other sign",
        "It never flips a sign. Try b and -b: they are the same turn.",
        _arc,
    ),
    Mistake(
        "nlerp, and no sign is flipped",
        "It takes the chord to b as it is written. Try b and -b, and look at s = 1/4.",
        lambda a, b, s: _long(_chord(a, b, s)),
    ),
    Mistake(
        "always the long way",
        "It flips the sign where it should not. Look at how far the frame has turned half way.",
        _far,
    ),
    Mistake(
        "the long way beyond 90°",
        "It flips the sign of b where the turn is larger than 90°, since it takes the angle of the "
        "arc for that of the turn. Your turns should go up to 179°.",
        _flipped_beyond(90 * deg),
    ),
    Mistake(
        "no way beyond 170°",
        "It takes a turn larger than 170° for half a turn, where both ways are equally long, and "
        "stays at a. Your turns should go up to 179°.",
        _stays_far,
    ),
    Mistake(
        "the angle for -b, the way to b",
        "It takes the absolute value of a · b for the angle, and does not flip b: wrong where "
        "a · b is negative.",
        _absolute,
    ),
    Mistake(
        "0/0 for equal turns",
        "It divides by sin 0 where a and b are one turn. Try a twice. A comparison with NaN is "
        "always False: ask whether the error is small, not whether it is large.",
        _textbook,
    ),
    Mistake(
        "the whole angle for the half",
        "It uses the angle of the turn where that of the arc belongs, which is half of it.",
        _doubled,
    ),
    Mistake(
        "from b to a",
        "It begins at b. Half way nobody sees that: look at other values of s.",
        _swapped,
    ),
    Mistake(
        "a time law",
        "It starts and stops softly. At s = 0, 1/2 and 1 nobody sees that.",
        lambda a, b, s: _good(a, b, s * s * (3 - 2 * s)),
    ),
    Mistake(
        "half way only",
        "It returns the middle for every s between the ends.",
        lambda a, b, s: _good(a, b, 0.0 if s <= 0 else 1.0 if s >= 1 else 0.5),
    ),
    Mistake(
        "not to the end",
        "It stops at 99.9 % of the way: look at s = 1, with a fine tolerance.",
        lambda a, b, s: _good(a, b, 0.999 * s),
    ),
    Mistake(
        "the turn on the wrong side",
        "It applies the turn, which is seen from a, in base axes. About one common axis both are "
        "the same: your a and b need different axes.",
        lambda a, b, s: _times(_power(_times(_back_turn(a), b), s), a),
    ),
    Mistake(
        "it begins without a turn",
        "It leads from no turn at all to the turn from a to b: right if a is the identity. Your a "
        "should be turned.",
        lambda a, b, s: _power(_times(_back_turn(a), b), s),
    ),
    Mistake(
        "the inverse",
        "It returns the conjugate of the right one.",
        lambda a, b, s: _back_turn(_good(a, b, s)),
    ),
    Mistake(
        "angles instead of quaternions",
        "It leads roll, pitch and yaw on straight lines: where one alone changes, by less than "
        "half a turn, that is right.",
        _of_angles,
    ),
    Mistake(
        "rounded",
        "It rounds to four digits: your tolerance has to be fine.",
        lambda a, b, s: _good(a, b, s).round(4),
    ),
    Mistake(
        "x, y, z, w",
        "It returns the scalar part at the end.",
        lambda a, b, s: np.roll(_good(a, b, s), -1),
    ),
)


# --- The predictions' numbers and views -----------------------------------------------------------


def _told(vector: Any, digits: int = 0) -> str:
    return f"({_row(np.asarray(vector, dtype=float), digits)})".translate(MINUS)


def _point_facts() -> dict[str, Any]:
    shift, turn, point = _trans(200, 0, 0), _rot(Z, 90 * deg), np.array([100.0, 0, 0, 1])
    return {
        "right": _told((shift @ turn @ point)[:3]),
        "whole": _told((turn @ shift @ point)[:3]),
        "clockwise": _told((shift @ turn.T @ point)[:3]),
        "unturned": _told((shift @ point)[:3]),
    }


def _point_view() -> Any:
    from ..show import plot_frames

    frame = Transform(Quaternion.from_angle_axis(90 * deg, Z), np.array([200, 0, 0]) * mm)
    tip = Transform(frame.rotation, frame @ (100 * mm * X))
    return plot_frames(
        [frame, tip],
        names=["the turned frame", "where the point goes"],
        size=60 * mm,
        title="The point lies 100 mm along the x axis of the turned frame",
    )


TURN, SHIFT = 100.0, 300.0  # degrees, mm


def _orders_facts() -> dict[str, Any]:
    one = _rot(Z, TURN * deg) @ _trans(SHIFT, 0, 0)
    two = _trans(SHIFT, 0, 0) @ _rot(Z, TURN * deg)
    return {
        "turn": TURN,
        "shift": SHIFT,
        "chord": float(np.linalg.norm(one[:3, 3] - two[:3, 3])),
        "arc": SHIFT * TURN * deg,
        "twice": 2 * SHIFT,
        "sine": SHIFT * np.sin(TURN * deg),
        "none": 0.0,
        "cosine": SHIFT * (1 - np.cos(TURN * deg)),
    }


def _orders_view() -> Any:
    from ..show import JOINT_STYLES, figure
    from ..show.palette import REMARK

    fig = figure(
        f"Two arrows of {SHIFT:.0f} mm from the base, {TURN:.0f} degrees apart, and the chord "
        "between their tips, which closes a triangle with two equal sides.",
        height=3.4,
    )
    ax = fig.subplots()
    tip = SHIFT * np.array([np.cos(TURN * deg), np.sin(TURN * deg)])
    ax.plot([0, SHIFT], [0, 0], color=JOINT_STYLES[1]["color"], lw=3, ls="--")
    ax.plot([0, tip[0]], [0, tip[1]], color=JOINT_STYLES[0]["color"], lw=3)
    ax.plot([SHIFT, tip[0]], [0, tip[1]], color=REMARK, lw=1.5, ls=":")
    ax.annotate("B: shift, turn", (SHIFT, 0), (8, 0), textcoords="offset points")
    ax.annotate("A: turn, shift", (tip[0], tip[1]), (8, 0), textcoords="offset points")
    chord = float(np.hypot(*(tip - [SHIFT, 0])))
    ax.annotate(
        f"{chord:.0f} mm",
        (0.5 * (tip[0] + SHIFT), 0.5 * tip[1]),
        (8, 0),
        textcoords="offset points",
    )
    ax.set(
        title=f"The origins are the ends of a chord of {chord:.0f} mm",
        xlabel="x, mm",
        ylabel="y, mm",
        aspect="equal",
        xlim=(-120, 460),
        ylim=(-30, 330),
    )
    fig.tight_layout()
    return fig


def _back_facts() -> dict[str, Any]:
    rotation, p = _rot(Z, 90 * deg)[:3, :3], np.array([400.0, 0, 300])
    return {
        "place": _told(p),
        "right": _told(-rotation.T @ p),
        "minus": _told(-p),
        "on": _told(-rotation @ p),
        "unsigned": _told(rotation.T @ p),
    }


def _back_view() -> Any:
    from ..show import plot_frames

    tool = Transform(Quaternion.from_angle_axis(90 * deg, Z), np.array([400, 0, 300]) * mm)
    return plot_frames(
        [tool],
        names=["tool"],
        size=110 * mm,
        title="Seen from the tool, the base lies along the green axis, and below",
    )


NUMBERS = ("q", "d", "a", "alpha")


@cache
def _free_facts() -> dict[str, Any]:
    """Which of the numbers of a link between parallel axes leaves the next axis where it is."""
    link = {"q": 20 * deg, "d": 100 * mm, "a": 300 * mm, "alpha": 0.0}
    free = []
    for name in NUMBERS:
        one, two = _dh(**link), _dh(**(link | {name: link[name] + 0.1}))
        same = np.allclose(one[:3, 2], two[:3, 2])
        beside = np.cross(one[:3, 2], two[:3, 3] - one[:3, 3])
        if same and np.allclose(beside, 0):
            free.append(name)
    return {"free": free, "apart": link["a"] / mm}


def _free_right(facts: Mapping[str, Any]) -> int:
    return [["a"], ["alpha"], ["d"], []].index(facts["free"])


def _free_view() -> str:
    lines = ["One number of the link is changed a little. Where does the next joint axis go?"]
    for name in NUMBERS:
        stays = name in _free_facts()["free"]
        lines.append(f"{name}: {'it stays the same line' if stays else 'it is another line'}")
    return "\n".join(lines)


@cache
def _quarter_facts() -> dict[str, Any]:
    quarter = 90 * deg
    two = Quaternion.from_angle_axis(quarter, Z) @ Quaternion.from_angle_axis(quarter, X)
    angle, axis = two.as_angle_axis()
    back = Quaternion.from_angle_axis(quarter, X) @ Quaternion.from_angle_axis(quarter, Z)
    return {
        "right": float(angle) / deg,
        "half": float(angle) / deg / 2,
        "sum": 180.0,
        "root": 90 * np.sqrt(2),
        "one": 90.0,
        "w": float(two.wxyz[0]),
        "axis": _told(axis, 3),
        "other": _told(back.as_angle_axis()[1], 3),
    }


def _quarter_view() -> Any:
    from ..show import plot_frames

    first = Quaternion.from_angle_axis(90 * deg, Z)
    both = first @ Quaternion.from_angle_axis(90 * deg, X)
    facts = _quarter_facts()
    places = np.array([[250, 0, 0], [500, 0, 0]]) * mm
    return plot_frames(
        [Transform(first, places[0]), Transform(both, places[1])],
        names=["after joint 1", "after joint 2"],
        size=100 * mm,
        title=f"Each axis takes the place of the next: a turn of {facts['right']:.0f}° about the "
        "diagonal",
    )


def _whole_facts() -> dict[str, Any]:
    whole = Quaternion.from_angle_axis(360 * deg, Z).wxyz.round(9) + 0.0
    return {"found": whole.tolist()}


WHOLES = ([1.0, 0, 0, 0], [-1.0, 0, 0, 0], [0, 0, 0, 1.0], [0, 0, 0, 0.0])


def _whole_right(facts: Mapping[str, Any]) -> int:
    return WHOLES.index(facts["found"])


def _whole_view() -> str:
    lines = ["Turns about z, and their quaternions (w, x, y, z):"]
    for angle in (0, 90, 180, 270, 360, 720):
        q = np.array([np.cos(angle * deg / 2), 0, 0, np.sin(angle * deg / 2)])
        lines.append(f"{angle}°: {_told(q, 2)}")
    return "\n".join(lines)


def _largest_facts() -> dict[str, Any]:
    """The smallest largest component of many unit quaternions, and where all are equal."""
    rows = np.random.default_rng(1).normal(size=(4000, 4))
    rows[0] = 1.0
    rows /= np.linalg.norm(rows, axis=1, keepdims=True)
    return {"least": float(abs(rows).max(axis=1).min()), "three": float(np.sqrt(1 / 3))}


def _largest_right(facts: Mapping[str, Any]) -> int:
    guesses = 0.0, 0.25, 0.5, facts["three"]
    return int(np.argmin([abs(guess - facts["least"]) for guess in guesses]))


def _largest_view() -> str:
    least = _largest_facts()["least"]
    return (
        "w² + x² + y² + z² = 1. Four squares with the sum 1 have the mean 1/4, and the largest is "
        f"not below the mean.\nOf 4000 unit quaternions, the one with four equal components among "
        f"them, none has a largest component below {least:.2f}. The quaternion with all four equal "
        "is a turn about the diagonal of a cube."
    )


S = np.linspace(0, 1, 401)


def _turned(lead: Program, turn: float) -> Floats:
    """The angle turned so far, over S, on the way to a turn about z."""
    a, b = Quaternion.identity().wxyz, Quaternion.from_angle_axis(turn, Z).wxyz
    rows = np.array([lead(a, b, s) for s in S])
    angles: Floats = 2 * np.unwrap(np.arctan2(rows[:, 3], rows[:, 0]))
    return angles


def _normalised(a: Floats, b: Floats, s: float) -> Floats:
    return _long(_chord(a, b, s))


@cache
def _hurry_facts() -> dict[str, Any]:
    speed = np.gradient(_turned(_normalised, np.pi), S, edge_order=2)
    ratio = float(speed[len(S) // 2] / speed[0])
    small = np.gradient(_turned(_normalised, 60 * deg), S, edge_order=2)
    return {
        "ratio": ratio,
        "inverse": 1 / ratio,
        "root": float(np.sqrt(ratio)),
        "square": ratio**2,
        "same": 1.0,
        "small": float(small[len(S) // 2] / small[0]),
    }


def _hurry_view() -> Any:
    from ..show import JOINT_STYLES, figure

    ratio = _hurry_facts()["ratio"]
    fig = figure(
        "The angular speed over s for a half turn: that of slerp stays at 180 degrees per unit of "
        f"s, that of nlerp climbs to {ratio:.1f} times its value at the ends and sinks again.",
        height=3.2,
    )
    ax = fig.subplots()
    styles = (
        ("slerp", _arc, "-", JOINT_STYLES[0]["color"]),
        ("nlerp", _normalised, "--", JOINT_STYLES[1]["color"]),
    )
    for name, lead, style, color in styles:
        speed = np.gradient(_turned(lead, np.pi), S, edge_order=2) / deg
        ax.plot(S, speed, style, color=color, lw=2)
        ax.text(0.5, speed[200] + 6, name, color=color, ha="center")
    ax.set(
        title=f"Nlerp hurries in the middle: {ratio:.1f} times as fast as at the ends",
        xlabel="s",
        ylabel="angular speed, ° per unit of s",
        ylim=(0, 270),
    )
    fig.tight_layout()
    return fig


@cache
def _long_facts() -> dict[str, Any]:
    way = 60 * deg
    a, b = Quaternion.identity().wxyz, -Quaternion.from_angle_axis(way, Z).wxyz
    rows = Quaternion(np.array([_arc(a, b, s) for s in S]))
    turned = float(rows[:-1].angle_to(rows[1:]).sum()) / deg
    return {
        "way": way / deg,
        "turned": turned,
        "arc": turned / 2,
        "half": 180.0,
        "rest": 180 - way / deg,
        "more": 360 + way / deg,
    }


def _long_view() -> str:
    a, b = Quaternion.identity().wxyz, Quaternion.from_angle_axis(60 * deg, Z).wxyz
    lines = ["How far the frame has turned about z, to b and to −b:"]
    for s in (0, 0.25, 0.5, 0.75, 1):
        short, far = (2 * np.arctan2(q[3], q[0]) / deg for q in (_arc(a, b, s), _arc(a, -b, s)))
        lines.append(f"s = {s:g}: {short:.0f}° and {far:.0f}°")
    return "\n".join(lines).translate(MINUS)


# --- The tables -----------------------------------------------------------------------------------

EXERCISES = {
    "1": Function(
        title="Seen from the flange",
        task="Where is a part, seen from the flange of an arm with a DH table?",
        objective=1,
        hints=(
            "Two steps: the flange in base coordinates, from the table; then flange_part = "
            "flange_base @ base_part. Which matrix is flange_base?",
            "Begin with flange = np.eye(4), and multiply each row's matrix from the right: flange "
            "= flange @ dh(offset + joint, d, a, alpha).",
            "for (offset, d, a, alpha), joint in zip(table, q): flange = flange @ dh(offset + "
            "joint, d, a, alpha). Then return inverse(flange) @ base_part.",
        ),
        inputs=("table", "q", "base_part"),
        right=_seen,
        cases=_seen_cases,
        form=_matrix,
        law=_seen_law,
        same=_same_matrix,
        mistakes=SEEN_MISTAKES,
    ),
    "2": Value(
        title="A camera that looks at a part",
        task="Turn a camera so that it looks at your part, level and upright",
        objective=2,
        hints=(
            "The turned axes are the columns of the matrix. Which of the three do you know at "
            "once?",
            "z is the unit vector along part - eye. x is level and across z: np.cross(z, (0, 0, "
            "1)), divided by its length. And y = z × x.",
            "R = np.transpose([x, y, z]) has them as columns; Quaternion.from_matrix(R) is the "
            "turn. See that y points down; if not, x and y both have the wrong sign. "
            "my_camera = Transform(my_turn, eye).",
        ),
        form=camera_form,
        faults=camera_faults,
        count=4,
        given=given,
    ),
    "3": Catch(
        title="A test for slerp",
        task="Write a test that tells a right slerp from a wrong one",
        objective=3,
        hints=(
            "You need turns a and b about different oblique axes, several values of s, and a "
            "second way to the right answer. Which values of s are the same for slerp and nlerp?",
            "Quaternion(a).slerp(Quaternion(b), s).wxyz is right. Compare with it and with its "
            "negative. Try b and -b, a small and a large turn, and b = a.",
            "for a, b in pairs of random unit quaternions (less than 179° apart), and (a, a), and "
            "(a, -a): for s in (0, 0.1, 0.25, 0.5, 0.9, 1): error = min(abs(found - right).max(), "
            "abs(found + right).max()); if not error < 1e-6: return False. A NaN is not below.",
        ),
        rights=tuple((what, _of_lists(lead)) for what, lead in RIGHT_LEADS),
        mistakes=tuple(m._replace(program=_of_lists(m.program)) for m in LEAD_MISTAKES),
        promise="A right program keeps 1e-6 in each component, for either sign of the result, for "
        "two turns less than 179° apart.",
    ),
}

# Objective 1: p1 to p4. Objective 2: p5 to p7. Objective 3: p8, p9.
PREDICTIONS = {
    "p1": Prediction(
        question="The matrix is Trans(200 mm, 0, 0) Rot(z, 90°). Where does it send the point "
        "(100, 0, 0) mm?",
        options=(
            Option(
                "{right} mm",
                "A point travels from right to left: the turn brings it to the y axis, then the "
                "shift carries it along the x axis of the base.",
            ),
            Option(
                "{whole} mm",
                "That is the shift first, and then the turn of all of it.",
                "the product read from the wrong end",
                "Trans(0, 0, 200 mm) would not show it: a shift along the axis of the turn may "
                "stand on either side.",
            ),
            Option(
                "{clockwise} mm",
                "That is a turn clockwise. Seen from the tip of z, a positive angle goes from x to "
                "y.",
                "the sense of the turn",
                "With 180° both senses come to the same place.",
            ),
            Option(
                "{unturned} mm",
                "That is the shift alone. The matrix turns the point about the origin of the base, "
                "and the point is not there.",
                "a turn moves no point",
                "The points of the z axis are the ones that the turn leaves where they are.",
            ),
        ),
        facts=_point_facts,
        right=lambda facts: 0,
        view=_point_view,
    ),
    "p2": Prediction(
        question="A turn by {turn:.0f}° about z and a shift by {shift:.0f} mm along x, in the two "
        "orders A and B. How far apart are the two origins?",
        options=(
            Option(
                "{chord:.1f}",
                "Both origins lie {shift:.0f} mm from the base, {turn:.0f}° apart: they are the "
                "ends of a chord, 2 · {shift:.0f} mm · sin(θ/2).",
            ),
            Option(
                "{none:.1f}",
                "The rotations are equal, the places are not: in A the shift goes along an x axis "
                "that is turned already.",
                "the order makes no difference",
                "With θ = 0, or without a shift, it does make none.",
            ),
            Option(
                "{arc:.1f}",
                "That is the length of the arc. The distance goes straight across.",
                "the arc for the chord",
                "With θ = 180° the arc is half a circle, and the chord its diameter.",
            ),
            Option(
                "{twice:.1f}",
                "That is the most there can be, at θ = 180°.",
                "the two shifts added",
                "Two points at the same distance from the base are at most twice that apart.",
            ),
            Option(
                "{sine:.1f}",
                "That is how far the origin of A is from the x axis. B is not below it.",
                "the height for the distance",
                "With θ = 180° that height is 0.",
            ),
            Option(
                "{cosine:.1f}",
                "That is the difference along x alone.",
                "one coordinate for the distance",
                "With θ = 90° the difference along y is as large.",
            ),
        ),
        facts=_orders_facts,
        right=lambda facts: 0,
        view=_orders_view,
        unit="mm",
        within=0.02,
    ),
    "p3": Prediction(
        question="A tool is at {place} mm, turned by 90° about z. Where does it see the origin of "
        "the base?",
        options=(
            Option(
                "{minus} mm: the way back is the way with the other sign.",
                "In base axes it is. The tool measures along its own axes, and they are turned.",
                "the shift back in base axes",
                "A tool that is not turned sees the base there.",
            ),
            Option(
                "{right} mm",
                "−Rᵀp: the way back, and then seen in the axes of the tool. The tool's y axis "
                "points along −x of the base.",
            ),
            Option(
                "{on} mm",
                "That is −Rp: the way back turned on by another 90°, instead of back.",
                "turned on instead of back",
                "With a turn of 180° R and its transpose are the same, and nobody sees it.",
            ),
            Option(
                "{unsigned} mm",
                "The axes are right, the way is not: that points from the base to the tool.",
                "the sign forgotten",
                "A tool that is not turned would see the base at its own place.",
            ),
        ),
        facts=_back_facts,
        right=lambda facts: 1,
        view=_back_view,
    ),
    "p4": Prediction(
        question="Two joint axes are parallel, {apart:.0f} mm apart. Which number of this link may "
        "you choose as you like, and the next axis stays where it is?",
        options=(
            Option(
                "a: a link is as long as it is built.",
                "a is the distance of the two axes, and that is given.",
                "the length of the metal for the distance of the axes",
                "A bent link of 400 mm may join two axes that are 300 mm apart: a is 300 mm.",
            ),
            Option(
                "alpha: parallel axes have no angle between them.",
                "They have: it is 0, and with another one they are not parallel.",
                "zero taken for free",
                "For the axes of the shoulder and of the column it is 90°, and fixed as well.",
            ),
            Option(
                "d: every common perpendicular will do.",
                "Parallel lines have many common perpendiculars, at any height. d says which one "
                "you take, and many tables take 0.",
            ),
            Option(
                "None: all of them are given by the axes.",
                "So it is for skew axes, which have one common perpendicular. Parallel ones have "
                "many.",
                "the skew case for all cases",
                "The IRB-140's shoulder and elbow axes are parallel.",
            ),
        ),
        facts=_free_facts,
        right=_free_right,
        view=_free_view,
    ),
    "p5": Prediction(
        question="The two hinges at the top: joint 1 turns by 90° about z, joint 2 by 90° about x. "
        "One single turn about one axis would do both. By which angle?",
        options=(
            Option(
                "{right:.1f}",
                "w = cos 45° · cos 45° = {w:.2f}, and that is the cosine of half the angle. The "
                "axis is the diagonal {axis}.",
            ),
            Option(
                "{sum:.1f}",
                "Angles add about one common axis only. Here the scalar parts are multiplied, and "
                "the two vector parts are perpendicular.",
                "angles of different axes added",
                "Twice 90° about z is a half turn.",
            ),
            Option(
                "{root:.1f}",
                "Turns are no arrows: the third side of a right triangle has nothing to say here.",
                "turns added like arrows",
                "For two very small turns it is nearly right.",
            ),
            Option(
                "{one:.1f}",
                "x goes to y, y to z and z to x: no axis stays where it was, so it cannot be a "
                "quarter turn about one of them.",
                "the second turn does not count",
                "With joint 2 at 0 it is 90°.",
            ),
            Option(
                "{half:.1f}",
                "That is the half angle, the one in the quaternion.",
                "the half angle for the angle",
                "A quarter turn has w = cos 45°.",
            ),
        ),
        facts=_quarter_facts,
        right=lambda facts: 0,
        view=_quarter_view,
        unit="°",
        within=0.02,
    ),
    "p6": Prediction(
        question="A tool turns once about z, by 360°, and every point is back. What is the "
        "quaternion (w, x, y, z) of this turn?",
        options=(
            Option(
                "(1, 0, 0, 0): all is as it was.",
                "The tool is. The quaternion has gone half of the way round: cos 180° = −1.",
                "the same tool, so the same quaternion",
                "After two turns, 720°, the quaternion is back, too.",
            ),
            Option(
                "(−1, 0, 0, 0)",
                "Half of 360° is 180°: w = cos 180°. It turns every point like (1, 0, 0, 0).",
            ),
            Option(
                "(0, 0, 0, 1)",
                "That is half a turn about z: cos 90° = 0.",
                "the angle halved twice",
                "A turn by 180° about z is (0, 0, 0, 1).",
            ),
            Option(
                "(0, 0, 0, 0): there is no turn.",
                "It has the length 0, and q v q* would send every point to the origin.",
                "nothing taken for no turn",
                "No turn is (1, 0, 0, 0), as no change in a product is 1.",
            ),
        ),
        facts=_whole_facts,
        right=_whole_right,
        view=_whole_view,
    ),
    "p7": Prediction(
        question="Dividing by w fails where w is 0. So divide by the largest of |w|, |x|, |y|, "
        "|z|. How small can the largest one be, for a unit quaternion?",
        options=(
            Option(
                "0: each of the four can be 0.",
                "Each, but not all at once: the squares have the sum 1.",
                "each taken for all",
                "A half turn about x has w = y = z = 0, and x = 1.",
            ),
            Option(
                "1/4: the four share the 1.",
                "They share the sum of the squares: the largest square is at least 1/4.",
                "the square for the component",
                "Four times 1/4 squared is 1/4, not 1.",
            ),
            Option(
                "1/2",
                "Then all four squares are 1/4. So the division is never by less than that.",
            ),
            Option(
                "{three:.3f}: the axis has three components.",
                "That is the least that the largest component of a unit vector in space can have. "
                "Here four share.",
                "three for four",
                "On a circle, two share: 0.707.",
            ),
        ),
        facts=_largest_facts,
        right=_largest_right,
        view=_largest_view,
    ),
    "p8": Prediction(
        question="a and b are half a turn apart, and s runs evenly from 0 to 1. Slerp turns at "
        "constant speed. How many times as fast as at the ends is nlerp in the middle?",
        options=(
            Option(
                "{ratio:.2f}",
                "The chord is run through evenly. In the middle it is nearest to the centre of the "
                "circle, nearer by the root of 2, and the angular speed grows with its square.",
            ),
            Option(
                "{same:.2f}",
                "It stays on the right arc and is right in the middle, but even steps on a chord "
                "are no even angles.",
                "the right arc taken for the right speed",
                "For a turn of 60° the factor is {small:.2f}: small turns forgive it.",
            ),
            Option(
                "{inverse:.2f}",
                "That is the other way round: it is slow at the ends.",
                "fast and slow exchanged",
                "A lighthouse beam on a straight wall runs fastest far out; here the beam follows "
                "the wall.",
            ),
            Option(
                "{root:.2f}",
                "That is how much nearer the chord is. It counts twice: nearer, and seen more "
                "squarely.",
                "the distance counted once",
                "A lamp that moves evenly along a wall turns at v · h / r²: the distance r counts "
                "twice.",
            ),
            Option(
                "{square:.2f}",
                "That counts the distance four times.",
                "the distance counted too often",
                "The arc in four dimensions is half of the turn: 90° here, not 180°.",
            ),
        ),
        facts=_hurry_facts,
        right=lambda facts: 0,
        view=_hurry_view,
        unit="times",
        within=0.05,
    ),
    "p9": Prediction(
        question="b is a turned on by {way:.0f}°. Somebody stores it with the other sign, −b, and "
        "uses the formula of slerp without looking at the sign. By which angle does the frame turn "
        "on its way?",
        options=(
            Option(
                "{turned:.1f}",
                "It arrives at the same turn, on the rest of the great circle: a cable would be "
                "wound up. That is why b is flipped where a · b is negative.",
            ),
            Option(
                "{way:.1f}",
                "The ends are the same turns. The way between them is another one.",
                "same ends, so the same way",
                "With s = 0 and s = 1 alone the two cannot be told apart.",
            ),
            Option(
                "{arc:.1f}",
                "That is the angle in four dimensions, between a and −b. The frame turns twice as "
                "far.",
                "the angle of the arc for the turn",
                "Two quaternions at a right angle are half a turn apart.",
            ),
            Option(
                "{half:.1f}",
                "−1 on its own is a whole turn, 360°, not a half one.",
                "the sign taken for a half turn",
                "A half turn is the quaternion (0, n).",
            ),
            Option(
                "{rest:.1f}",
                "The two ways make a whole turn together, not a half one.",
                "the rest of a half turn",
                "For a half turn both ways are equally long.",
            ),
            Option(
                "{more:.1f}",
                "It turns the other way round: less than a whole turn.",
                "a whole turn more",
                "From a to −a the formula has no way at all: it divides by 0.",
            ),
        ),
        facts=_long_facts,
        right=lambda facts: 0,
        view=_long_view,
        unit="°",
        within=0.02,
    ),
}
