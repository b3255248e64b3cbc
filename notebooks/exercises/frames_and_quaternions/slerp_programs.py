"""Helpers for the correct and wrong programs of exercise 3 of this lab, and the sentence about the
last call of a refused one.
"""

from typing import Any

import numpy as np

from robokin import Quaternion, deg
from robokin.course.exercises import in_words
from robokin.course.told import floats

from .shared import Floats, angle, arc, chord, unit, weighted

__all__ = ["Quaternion", "angle", "arc", "chord", "deg", "floats", "np", "unit", "weighted"]


EQUAL = (
    " Here a and b are the same rotation. The slerp formula is 0/0 for them: is the value with "
    "which you compare NaN?"
)


def rejection(inputs: tuple[Any, ...], result: Any) -> str:
    """The last inputs that a correct program was given, and its result."""
    a, b, s = floats(inputs[0]), floats(inputs[1]), in_words(inputs[2])
    called = f"Your test last called it with a = {in_words(a)}, b = {in_words(b)}, s = {s}."
    equal = EQUAL if angle(a, near(a, b)) < 1e-6 else ""
    return f"{called} It returned {in_words(floats(result))}, which is right.{equal}"


def near(a: Floats, b: Floats) -> Floats:
    """Return b or -b, whichever is nearer to a."""
    return b if a @ b >= 0 else -b


def times(a: Floats, b: Floats) -> Floats:
    w, u = a[0] * b[0] - a[1:] @ b[1:], a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])
    return np.array([w, *u])


def conjugate(a: Floats) -> Floats:
    turned: Floats = a * [1, -1, -1, -1]
    return turned


def power(q: Floats, s: float) -> Floats:
    """The rotation by s times the angle of q, the short way."""
    q = q if q[0] >= 0 else -q
    half, sine = np.arctan2(np.linalg.norm(q[1:]), q[0]), np.linalg.norm(q[1:])
    if sine < 1e-15:
        return np.array([1.0, 0, 0, 0])
    return np.array([np.cos(s * half), *(np.sin(s * half) * q[1:] / sine)])


def angles(q: Floats) -> Floats:
    return np.array([float(x) for x in Quaternion(q).as_roll_pitch_yaw()])


def of_angles(a: Floats, b: Floats, s: float) -> Floats:
    """Interpolate roll, pitch and yaw linearly."""
    roll, pitch, yaw = (1 - s) * angles(a) + s * angles(b)
    return Quaternion.from_roll_pitch_yaw(roll, pitch, yaw).wxyz
