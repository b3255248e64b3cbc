"""The second half of exercise 2: the camera after its roll, and its lamp."""

import numpy as np

from robokin import Quaternion, Transform, deg, mm
from robokin.course.slips import METRES
from robokin.course.told import apart

from .shared import NEAR, Floats, X, Y, Z, unit

Fault = tuple[str, str]


def faults_of_roll(camera: Quaternion, turn: Quaternion, answer: Quaternion | None) -> list[Fault]:
    """The fault of the rotation after the roll `turn` about the camera's own z axis."""
    if answer is None:
        return [("the roll is missing", "Next: my_rolled, the camera's rotation after the roll.")]
    if not np.isfinite(answer.wxyz).all():
        return [("NaN", "my_rolled contains NaN instead of a number.")]
    right = camera @ turn
    off = float(right.angle_to(answer))
    if off < NEAR:
        return []
    told = f"my_rolled is {apart(off / deg, 0, 1)[0]}° away from the right rotation."
    for name, says, other in rolls(camera, turn):
        if float(other.angle_to(answer)) < NEAR:
            return [(name, f"{told} {says}")]
    return [("rolled elsewhere", told)]


def rolls(camera: Quaternion, turn: Quaternion) -> list[tuple[str, str, Quaternion]]:
    """The mistakes in the roll, each with its sentence and the rotation that it gives."""
    angle = 2 * float(np.arctan2(turn.wxyz[3], turn.wxyz[0]))

    def about(axis: Floats, by: float) -> Quaternion:
        return camera @ Quaternion.from_angle_axis(by % (2 * np.pi), axis)

    last = "The order of a quaternion is (w, x, y, z)."
    right = camera @ turn
    total = camera.wxyz + turn.wxyz
    found = [
        (
            "the roll about the base's z axis",
            "You rolled the camera about the z axis of the base. The roll is about its own z axis, "
            "so its quaternion is the factor on the right.",
            turn @ camera,
        ),
        ("not rolled", "It is still the rotation before the roll.", camera),
        ("rolled the other way", "You rolled the camera in the other direction.", about(Z, -angle)),
        ("half the roll", "You rolled it by half the angle.", about(Z, angle / 2)),
        (
            "twice the roll",
            "You rolled it by twice the angle: the quaternion contains half the angle.",
            about(Z, 2 * angle),
        ),
        (
            "degrees for radians",
            "The angle in my_numbers is in radians already: do not multiply it by deg.",
            about(Z, angle * deg),
        ),
        ("degrees", "from_angle_axis needs the angle in radians.", about(Z, angle / deg)),
        ("the roll alone", "It is the roll alone: multiply it by the camera's rotation.", turn),
        ("the inverse of the roll", "It is the inverse of the right rotation.", right.inverse()),
        ("rolled about x", "You rotated it about its x axis.", about(X, angle)),
        ("rolled about y", "You rotated it about its y axis.", about(Y, angle)),
        ("x, y, z, w", last, Quaternion(np.roll(right.wxyz, -1))),
    ]
    if np.linalg.norm(total) > 1e-6:
        says = "You added two quaternions. A product composes rotations, a sum does not."
        found.append(("the sum of the quaternions", says, Quaternion(unit(total))))
    return found


def faults_of_lamp(
    camera: Transform, rolled: Transform, lamp: Floats, answer: Floats | None
) -> list[Fault]:
    """The fault of the lamp's place. `rolled` is the camera's pose after the roll."""
    if answer is None:
        return [("the lamp is missing", "Next: my_lamp, the place of the lamp after the roll.")]
    right = rolled @ lamp
    if np.linalg.norm(answer - right) <= 1 * mm:
        return []
    should, stands = apart(right / mm, answer / mm)
    told = f"After your roll, the lamp should be at ({should}) mm, but it is at ({stands}) mm."
    if np.linalg.norm(answer) > 20:
        return [("the lamp: mm for m", f"{told} {METRES}")]
    eye, q = rolled.translation, rolled.rotation
    half = (q @ Quaternion([0.0, *(lamp / np.linalg.norm(lamp))])).wxyz[1:] * np.linalg.norm(lamp)
    for name, says, other in (
        ("the lamp before the roll", "That is its place before the roll.", camera @ lamp),
        ("the camera's place is left out", "You left out the place of the camera.", q @ lamp),
        (
            "the lamp: the inverse rotation",
            "You rotated it back: q* v q instead of q v q*.",
            eye + q.inverse() @ lamp,
        ),
        ("the lamp is not rotated", "You added its coordinates without rotating them.", eye + lamp),
        ("q v without q*", "You multiplied by q on one side only: q v q*.", eye + half),
        (
            "the lamp: the place rotated, too",
            "You rotated the place of the camera as well.",
            q @ (eye + lamp),
        ),
        ("the lamp: subtracted", "Add the place of the camera.", q @ lamp - eye),
        ("the camera instead of the lamp", "That is the place of the camera.", eye),
    ):
        if np.linalg.norm(answer - other) <= 1 * mm:
            return [(name, f"{told} {says}")]
    return [("the lamp is elsewhere", told)]
