"""The numbers, conditions and sentences of exercise 2 of frames and quaternions."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from robokin import Quaternion, Transform, deg, mm
from robokin.course.exercises import in_words
from robokin.course.slips import METRES
from robokin.course.told import apart, floats
from robokin.course.variants import Numbers, dice

from .rolled import faults_of_lamp, faults_of_roll
from .shared import NEAR, Floats, X, Z

COUNT = 6
Given = Mapping[str, Any]
Fault = tuple[str, str]
Direction = tuple[str, Floats, Floats, str]  # name, axis, the direction it should have, sentence
PLACES = [f"{what}_{axis}" for what in ("eye", "part", "lamp") for axis in "xyz"]
UNITS = dict.fromkeys(PLACES, ("mm", mm)) | {"roll": ("°", deg)}
WANTED = "Wanted (my_camera, my_rolled, my_lamp)"


class Answer(NamedTuple):
    """The pose of the camera, its rotation after the roll, and the place of the lamp. The last two
    are None while they are missing.
    """

    camera: Transform
    rolled: Quaternion | None
    lamp: Floats | None


def given(who: Any) -> Numbers:
    """The numbers of a student: a place for the camera, a part below it and to the side, a lamp on
    the camera, and the angle of its roll.
    """
    roll = dice("frames_and_quaternions", who)

    def signed(low: int, steps: int) -> int:
        return (low + 10 * roll.randrange(steps)) * (1 - 2 * roll.randrange(2))

    eye = [signed(200, 16), signed(150, 16), 550 + 10 * roll.randrange(20)]
    part = [eye[0] + signed(250, 11), eye[1] + signed(120, 10), 10 * roll.randrange(16)]
    camera = upright(np.subtract(part, eye))
    while True:
        lamp = [signed(60, 7), signed(60, 7), 30 + 10 * roll.randrange(7)]
        turn = (25 + 5 * roll.randrange(9)) * (1 - 2 * roll.randrange(2))
        whole = camera @ Quaternion.from_angle_axis(turn * deg, Z)
        others = whole.inverse() @ lamp, np.array(lamp)  # the results of two mistakes
        if all(np.linalg.norm(whole @ lamp - other) > 20 for other in others):
            break
    values = [x * mm for x in eye + part + lamp] + [turn * deg]
    return Numbers(dict(zip(UNITS, values, strict=True)), UNITS)


def upright(look: Floats) -> Quaternion:
    """The rotation of a camera that looks in this direction, level and upright."""
    x, z = unit(np.cross(look, Z)), unit(look)
    return Quaternion.from_matrix(np.transpose([x, np.cross(z, x), z]))


def places(given: Given) -> tuple[Floats, Floats, Floats]:
    """The places of the camera and the part, and that of the lamp in the camera's coordinates."""
    eye, part, lamp = np.array([given[key] for key in PLACES]).reshape(3, 3)
    return eye, part, lamp


def plain(answer: Any) -> Any:
    """The pose of the camera, which is what the case shows."""
    return answer[0] if isinstance(answer, (tuple, list)) and len(answer) == 3 else answer


def form(answer: Any, given: Any) -> Answer:
    """Return the answer in its parts. ValueError: a part is of another kind."""
    if not isinstance(answer, (tuple, list)) or len(answer) != 3:
        raise ValueError(f"{WANTED}, got {in_words(answer)}.")
    camera, rolled, lamp = answer
    if camera is ... or camera is None:
        raise ValueError("my_camera is missing: the other two depend on it.")
    return Answer(pose(camera), rotation(rolled), place(lamp))


def rotation(answer: Any) -> Quaternion | None:
    """Return the second part of the answer. ValueError: it is not one unit quaternion."""
    if answer is ... or answer is None:
        return None
    wanted = "my_rolled: wanted one unit quaternion, a Quaternion or (w, x, y, z)"
    if isinstance(answer, Quaternion) and answer.shape == ():
        return answer
    try:
        row = floats(answer)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {in_words(answer)}.") from None
    if row.shape != (4,):
        raise ValueError(f"{wanted}, got {in_words(answer)}.")
    length = float(np.linalg.norm(row))
    if not abs(length - 1) < 1e-3:
        raise ValueError(f"{wanted}, but the length of yours is {length:.3f}.")
    return Quaternion(row / length)


def place(answer: Any) -> Floats | None:
    """Return the third part of the answer. ValueError: it is not one finite place."""
    if answer is ... or answer is None:
        return None
    wanted = "my_lamp: wanted one place (x, y, z) in metres"
    try:
        row = floats(answer)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {in_words(answer)}.") from None
    if row.shape != (3,):
        raise ValueError(f"{wanted}, got {in_words(answer)}.")
    if not np.isfinite(row).all():
        raise ValueError("my_lamp contains NaN or infinity instead of a number.")
    return row


def pose(answer: Any) -> Transform:
    """Return the first part of the answer. ValueError: it is not one pose."""
    if isinstance(answer, Transform) and answer.shape == ():
        return answer
    wanted = "my_camera: wanted one Transform, the pose of the camera"
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


def faults(answer: Answer, given: Given) -> list[Fault]:
    """The faults of the camera, of its roll and of the lamp. The roll and the lamp are compared
    with the student's own camera.
    """
    camera, rolled, lamp = answer
    found = faults_of_camera(camera, given)
    turn = Quaternion.from_angle_axis(given["roll"], Z)
    own = camera.rotation
    if not (np.isfinite(own.wxyz).all() and np.isfinite(camera.translation).all()):
        return found
    found += faults_of_roll(own, turn, rolled)
    right = Transform(own @ turn if rolled is None else rolled, camera.translation)
    return found + faults_of_lamp(camera, right, places(given)[2], lamp)


def faults_of_camera(camera: Transform, given: Given) -> list[Fault]:
    """The faults of the position, of the direction of z, and of the directions of x and y."""
    back = camera.inverse()
    if found_in(camera, given) and not found_in(back, given):
        says = "Your pose is that of the base as the camera sees it, the inverse of the right one."
        return [("the inverse pose", says)] * 4
    return found_in(camera, given)


def found_in(camera: Transform, given: Given) -> list[Fault]:
    eye, part, _ = places(given)
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
