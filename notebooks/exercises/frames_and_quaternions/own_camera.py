"""Numbers, conditions and sentences of exercise 2 of frames and quaternions."""

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
    """A place for the camera, and a part that is lower and to the side."""
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
    """Return the answer if it is one pose. ValueError: it is not."""
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
    raise ValueError(f"{wanted}, got {in_words(answer)}{hint}.")


def unit(vector: Floats) -> Floats:
    length = np.linalg.norm(vector)
    return vector / length if length > 0 else Z


def between(a: Floats, b: Floats) -> float:
    return float(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b))


def faults(camera: Transform, given: Given) -> list[Fault]:
    """What is wrong with the place, the direction of z, the level of x and the direction of y."""
    back = camera.inverse()
    if found_in(camera, given) and not found_in(back, given):
        says = "This is the base, seen from the camera: the inverse of the camera's pose."
        return [("the base, seen from the camera", says)] * 4
    return found_in(camera, given)


def found_in(camera: Transform, given: Given) -> list[Fault]:
    eye, part = places(given)
    found = [*misplaced(camera.translation, eye, part)]
    rotation = camera.rotation.as_matrix()
    if not np.isfinite(rotation).all():
        return [("NaN", "A NaN stands where a number should.")] * 4
    x, y, z = rotation.T
    look = unit(part - eye)
    if between(z, look) > NEAR:
        found += [looking(rotation, look, eye, part)] * 2
    tilt, rise = (float(np.arcsin(np.clip(axis[2], -1, 1))) for axis in (x, y))
    if abs(tilt) > NEAR:
        short = np.cross(Z, look)
        turn = Quaternion.from_angle_axis(between(Z, look), unit(short))
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


def misplaced(place: Floats, eye: Floats, part: Floats) -> list[Fault]:
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


def swung(look: Floats) -> Quaternion:
    """A rotation about z that turns the camera's y axis to the azimuth of the line of sight."""
    return Quaternion.from_angle_axis(float(np.arctan2(look[1], look[0])) - np.pi / 2, Z)


def tilted(look: Floats) -> Quaternion:
    """A rotation about the level x axis, from straight up to the line of sight."""
    return Quaternion.from_angle_axis(-between(Z, look), X)


def looking(rotation: Floats, look: Floats, eye: Floats, part: Floats) -> Fault:
    angle = between(rotation[:, 2], look)
    told = f"The z axis should point at the part; it points {angle / deg:.1f}° beside it."
    turned = ((name, rotation[:, 2], other, says) for name, other, says in turns(look))
    for name, axis, other, says in (*lines(rotation, look, eye, part), *turned):
        if between(axis, other) < NEAR:
            return name, f"{told} {says}"
    return "looks past the part", told


def lines(rotation: Floats, look: Floats, eye: Floats, part: Floats) -> tuple[Direction, ...]:
    """Mistakes: another axis is along the line of sight, or z is along another line."""
    x, y, z = rotation.T
    return (
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
            unit(part),
            "It looks along the line from the base to the part. The camera stands at eye: part - "
            "eye.",
        ),
        ("the sum for the difference", z, unit(part + eye), "The line goes along part - eye."),
        ("looks at the base", z, unit(-eye), "It looks at the origin of the base."),
        ("looks at the base", z, unit(eye), "It looks along the line from the base to itself."),
    )


def turns(look: Floats) -> tuple[tuple[str, Floats, str], ...]:
    """Mistakes: z after a wrong rotation."""
    level = np.hypot(*look[:2])
    return (
        ("not turned", Z, "The z axis is where it was."),
        ("straight down", -Z, "It looks straight down."),
        (
            "to the opposite side",
            look * [-1, -1, 1],
            "It looks to the opposite side: half a turn about z is missing, as with arctan where "
            "arctan2 belongs.",
        ),
        *(
            (
                "a quarter turn off",
                np.array([-sign * look[1], sign * look[0], look[2]]),
                "It is a quarter turn off about z: with no turn the camera's x axis, not its y "
                "axis, lies along x of the base.",
            )
            for sign in (+1, -1)
        ),
        (
            "the order of the turns",
            tilted(look) @ swung(look) @ Z,
            "The two turns are in the wrong order: the tilt belongs to the turned camera, and "
            "stands at the right.",
        ),
        ("looks up", look * [1, 1, -1], "It looks up as steeply as it should look down."),
        ("mirrored", look * [1, -1, 1], "The sign of y is turned round: the turn about z."),
        ("mirrored", look * [-1, 1, 1], "The sign of x is turned round: the turn about z."),
        ("x and y exchanged", look[[1, 0, 2]], "x and y are exchanged: arctan2 takes y first."),
        ("half of the turn", unit(Z + look), "It is turned half of the way."),
        ("twice the turn", 2 * look[2] * look - Z, "It is turned twice as far as it should be."),
        (
            "sine and cosine of the slope exchanged",
            unit(np.append(look[:2] / max(level, 1e-9) * abs(look[2]), -level)),
            "Its slope is the right angle measured from the other line: from z for from the "
            "horizontal, or the other way round.",
        ),
        (
            "level: the height is left out",
            unit(look * [1, 1, 0]),
            "It looks in the right direction of the compass, but not down.",
        ),
    )
