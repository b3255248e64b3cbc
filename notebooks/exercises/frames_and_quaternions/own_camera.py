"""The numbers, conditions and sentences of exercise 2 of frames and quaternions."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from robokin import Quaternion, Transform, deg, mm
from robokin.course.exercises import in_words
from robokin.course.slips import METRES
from robokin.course.told import apart, floats
from robokin.course.variants import Numbers, dice

from .shared import Floats, X, Z

COUNT = 4
Given = Mapping[str, Any]
Fault = tuple[str, str]
Direction = tuple[str, Floats, Floats, str]  # name, axis, the direction it should have, sentence
NEAR = 0.1 * deg
UNITS = dict.fromkeys(("eye_x", "eye_y", "eye_z", "part_x", "part_y", "part_z"), ("mm", mm))


def given(who: Any) -> Numbers:
    """The numbers of a student: a place for the camera, and a part below it and to the side."""
    roll = dice("frames_and_quaternions", who)

    def signed(low: int, steps: int) -> int:
        return (low + 10 * roll.randrange(steps)) * (1 - 2 * roll.randrange(2))

    eye = [signed(200, 16), signed(150, 16), 550 + 10 * roll.randrange(20)]
    part = [eye[0] + signed(250, 11), eye[1] + signed(120, 10), 10 * roll.randrange(16)]
    return Numbers({k: x * mm for k, x in zip(UNITS, eye + part, strict=True)}, UNITS)


def places(given: Given) -> tuple[Floats, Floats]:
    values = np.array([given[key] for key in UNITS])
    return values[:3], values[3:]


def form(answer: Any, given: Any) -> Transform:
    """Return the answer as one pose. ValueError: it is not one pose."""
    if isinstance(answer, Transform) and answer.shape == ():
        return answer
    wanted = "Wanted one Transform, the pose of the camera"
    if isinstance(answer, Quaternion):
        raise ValueError(f"{wanted}. Your rotation has no position: use Transform(rotation, eye).")
    with np.errstate(all="ignore"):
        shape = np.shape(answer)
    if shape == (4, 4):
        try:
            return Transform.from_matrix(floats(answer))
        except (TypeError, ValueError) as error:
            raise ValueError(f"{wanted}. Your matrix is not a pose: {error}") from None
    hint = ": a position without a rotation" if shape == (3,) else ""
    hint = ": a rotation matrix without a position" if shape == (3, 3) else hint
    raise ValueError(f"{wanted}, got {in_words(answer)}{hint}.")


def unit(vector: Floats) -> Floats:
    length = np.linalg.norm(vector)
    return vector / length if length > 0 else Z


def between(a: Floats, b: Floats) -> float:
    return float(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b))


def faults(camera: Transform, given: Given) -> list[Fault]:
    """The faults of the position, of the direction of z, and of the directions of x and y."""
    back = camera.inverse()
    if found_in(camera, given) and not found_in(back, given):
        says = "Your pose is that of the base as the camera sees it, the inverse of the right one."
        return [("the inverse pose", says)] * 4
    return found_in(camera, given)


def found_in(camera: Transform, given: Given) -> list[Fault]:
    eye, part = places(given)
    found = [*misplaced(camera.translation, eye, part)]
    rotation = camera.rotation.as_matrix()
    if not np.isfinite(rotation).all():
        return [("NaN", "Your pose contains NaN instead of a number.")] * 4
    x, y, z = rotation.T
    look = unit(part - eye)
    if between(z, look) > NEAR:
        found += [looking(rotation, look, eye, part)] * 2
    tilt, rise = (float(np.arcsin(np.clip(axis[2], -1, 1))) for axis in (x, y))
    if abs(tilt) > NEAR:
        short = np.cross(Z, look)
        turn = Quaternion.from_angle_axis(between(Z, look), unit(short))
        degrees = apart(abs(tilt) / deg, 0)[0]
        says = f"The x axis should be level, but it is {degrees}° away from the horizontal."
        if float(turn.angle_to(camera.rotation)) < NEAR:
            name = "the shortest rotation"
            says += (
                " You used the shortest rotation from z to the line of sight. It does not control "
                "the rotation about this line."
            )
        else:
            name = "not level"
        found.append((name, says))
    elif abs(rise) <= NEAR:
        found.append(("y is level", "The y axis should point down, but it is level."))
    elif rise > 0:
        says = f"The y axis should point down, but it points up by {rise / deg:.1f}°."
        if not found:
            says += " Rotate the camera by 180° about its line of sight."
        found.append(("upside down", says))
    return found[:4]


def misplaced(place: Floats, eye: Floats, part: Floats) -> list[Fault]:
    off = float(np.linalg.norm(place - eye))
    if off <= 1 * mm:
        return []
    should, stands = apart(eye / mm, place / mm)
    told = f"The camera should be at ({should}) mm, but it is at ({stands}) mm."
    if np.linalg.norm(place) > 20:
        return [("mm for m", f"{told} {METRES}")]
    for name, other in (
        ("the camera is at the part", part),
        ("the camera is at part - eye", part - eye),
        ("the camera is at eye - part", eye - part),
        ("the camera is at -eye", -eye),
        ("the camera is at the base", 0 * eye),
    ):
        if np.linalg.norm(place - other) < 1 * mm:
            return [(name, told)]
    return [("the camera is elsewhere", told)]


def swung(look: Floats) -> Quaternion:
    """A rotation about z that turns the camera's y axis to the azimuth of the line of sight."""
    return Quaternion.from_angle_axis(float(np.arctan2(look[1], look[0])) - np.pi / 2, Z)


def tilted(look: Floats) -> Quaternion:
    """A rotation about the level x axis, from straight up to the line of sight."""
    return Quaternion.from_angle_axis(-between(Z, look), X)


def looking(rotation: Floats, look: Floats, eye: Floats, part: Floats) -> Fault:
    angle = between(rotation[:, 2], look)
    told = f"The z axis should point at the part, but it misses it by {angle / deg:.1f}°."
    turned = ((name, rotation[:, 2], other, says) for name, other, says in turns(look))
    for name, axis, other, says in (*lines(rotation, look, eye, part), *turned):
        if between(axis, other) < NEAR:
            return name, f"{told} {says}"
    return "looks past the part", told


def lines(rotation: Floats, look: Floats, eye: Floats, part: Floats) -> tuple[Direction, ...]:
    """The mistakes in which another axis is along the line of sight, or z along another line."""
    x, y, z = rotation.T
    return (
        ("looks away", z, -look, "It points exactly away: use part - eye, not eye - part."),
        (
            "the inverse rotation",
            rotation[2],
            look,
            "The inverse of your rotation would be right. The axes are the columns of the matrix, "
            "not the rows.",
        ),
        ("x looks at the part", x, look, "Your x axis points at the part."),
        ("y looks at the part", y, look, "Your y axis points at the part."),
        ("x looks away from the part", x, -look, "Your x axis points exactly away from it."),
        ("y looks away from the part", y, -look, "Your y axis points exactly away from it."),
        (
            "seen from the base",
            z,
            unit(part),
            "It points along the line from the base to the part, but the camera is at eye: use "
            "part - eye.",
        ),
        ("the sum instead of the difference", z, unit(part + eye), "It points along part + eye."),
        ("looks at the base", z, unit(-eye), "It points at the origin of the base."),
        ("looks away from the base", z, unit(eye), "It points away from the origin of the base."),
    )


def turns(look: Floats) -> tuple[tuple[str, Floats, str], ...]:
    """The mistakes in which a wrong rotation was applied to z."""
    level = np.hypot(*look[:2])
    return (
        ("not rotated", Z, "It is still the z axis of the base."),
        ("straight down", -Z, "It points straight down."),
        (
            "to the opposite side",
            look * [-1, -1, 1],
            "It points to the opposite side. A half turn about z is missing, as if you had used "
            "arctan instead of arctan2.",
        ),
        *(
            (
                "a quarter turn off",
                np.array([-sign * look[1], sign * look[0], look[2]]),
                "It is a quarter turn off about z: before the rotation, the camera's x axis, not "
                "its y axis, points along x of the base.",
            )
            for sign in (+1, -1)
        ),
        (
            "the order of the rotations",
            tilted(look) @ swung(look) @ Z,
            "Your two rotations are in the wrong order: the tilt is about an axis of the rotated "
            "camera, so its factor belongs on the right.",
        ),
        ("looks up", look * [1, 1, -1], "It points up as steeply as it should point down."),
        ("mirrored", look * [1, -1, 1], "Its y has the wrong sign: look at your rotation about z."),
        ("mirrored", look * [-1, 1, 1], "Its x has the wrong sign: look at your rotation about z."),
        ("x and y swapped", look[[1, 0, 2]], "Its x and y are swapped: arctan2(y, x)."),
        ("half the rotation", unit(Z + look), "You rotated it by half the angle."),
        ("twice the rotation", 2 * look[2] * look - Z, "You rotated it by twice the angle."),
        (
            "sine and cosine of the slope swapped",
            unit(np.append(look[:2] / max(level, 1e-9) * abs(look[2]), -level)),
            "The angle of its slope is right, but you measured it from the wrong line: from z "
            "instead of from the horizontal, or the other way round.",
        ),
        (
            "looks level",
            unit(look * [1, 1, 0]),
            "Its horizontal direction is right, but it is level: you left out the height.",
        ),
    )
