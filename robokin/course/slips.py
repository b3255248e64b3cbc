"""Common slips in a result or an input of any exercise: wrong units, a wrong sign, rows and columns
swapped; and what to write instead after a common TypeError.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, mm, wrapped

Program = Callable[..., Any]


def _numbers(change: Program) -> Program:
    """Apply `change` to a numeric result. Raises ValueError if it is not numeric."""

    def changed(value: Any) -> Any:
        if isinstance(value, (Transform, Quaternion, str, bool)) or value is None:
            raise ValueError("wanted numbers")
        return change(np.asarray(value, dtype=float))

    return changed


def _place(change: Program) -> Program:
    """Apply `change` to the position of a pose, or to numbers."""

    def changed(value: Any) -> Any:
        if isinstance(value, Transform):
            return Transform(value.rotation, change(value.translation))
        return _numbers(change)(value)

    return changed


def _turn(change: Program) -> Program:
    """Apply `change` to the rotation angle of a pose, or to numbers."""

    def changed(value: Any) -> Any:
        if isinstance(value, Transform):
            angle, axis = value.rotation.as_angle_axis()
            return Transform(Quaternion.from_angle_axis(change(angle), axis), value.translation)
        return _numbers(change)(value)

    return changed


def _axis(k: int) -> Program:
    def turned(value: Any) -> Any:
        flip = np.where(np.arange(3) == k, -1.0, 1.0)
        if isinstance(value, Transform):
            return Transform(value.rotation, flip * value.translation)
        value = np.asarray(value, dtype=float)
        if value.shape[-1:] != (3,):
            raise ValueError("wanted three coordinates")
        return flip * value

    return turned


def _sample(by: int) -> Program:
    def shifted(value: Any) -> Any:
        value = np.asarray(value, dtype=float)
        if value.ndim == 0 or len(value) < 9:
            raise ValueError("wanted at least nine samples")
        return np.concatenate([value[:1], value[:-1]] if by > 0 else [value[1:], value[-1:]])

    return shifted


def _inverse(value: Any) -> Any:
    if isinstance(value, (Transform, Quaternion)):
        return value.inverse()
    value = np.asarray(value, dtype=float)
    if value.ndim == 2 and value.shape[0] == value.shape[1]:
        return np.linalg.inv(value)
    return 1 / value


def _transposed(value: Any) -> Any:
    if isinstance(value, Transform):
        return Transform(value.rotation.inverse(), value.translation)
    value = np.asarray(value, dtype=float)
    if value.ndim < 2:
        raise ValueError("wanted rows and columns")
    return np.swapaxes(value, -1, -2)


def _not(value: Any) -> Any:
    if not isinstance(value, (bool, np.bool_)):
        raise ValueError("wanted True or False")
    return not value


DEGREES = "Angles are in radians here: write `90 * deg`, and divide by `deg` only for printing."
METRES = "Lengths are in metres here: write `350 * mm`, and divide by `mm` only for printing."
# (name, sentence, the change to a result)
RESULTS = (
    ("degrees for radians", DEGREES, _turn(lambda x: x / deg)),
    ("degrees for radians", DEGREES, _turn(lambda x: x * deg)),
    ("mm for m", METRES, _place(lambda x: x / mm)),
    ("mm for m", METRES, _place(lambda x: x * mm)),
    ("percent", "Return a number from 0 to 1, not a percentage.", _numbers(lambda x: 100 * x)),
    (
        "a factor of two",
        "Your result is twice what it should be.",
        _numbers(lambda x: 2 * x),
    ),
    ("a factor of two", "Your result is half of what it should be.", _numbers(lambda x: x / 2)),
    ("sign", "Every sign is reversed.", _numbers(lambda x: -x)),
    *(
        ("sign of an axis", f"The sign of {letter} is reversed.", _axis(k))
        for k, letter in enumerate("xyz")
    ),
    (
        "inverse of the answer",
        "You return the inverse of the answer, such as the base seen from the tool, or 1 / x.",
        _inverse,
    ),
    ("transposed", "Rows and columns are swapped.", _transposed),
    (
        "wrapped angle",
        "You wrapped the angles to the range -180 to 180 degrees. Here they have to continue past "
        "180 degrees, or stay inside the limits.",
        _numbers(wrapped),
    ),
    ("off by one sample", "Every value comes one sample too late.", _sample(+1)),
    ("off by one sample", "Every value comes one sample too early.", _sample(-1)),
    (
        "True and False swapped",
        "It returns True where it should return False, and False where it should return True.",
        _not,
    ),
)
# (name, sentence, the change to one of the numeric inputs)
INPUTS = (
    ("degrees for radians", DEGREES, lambda x: x / deg),
    ("degrees for radians", DEGREES, lambda x: x * deg),
    ("mm for m", METRES, lambda x: x / mm),
    ("mm for m", METRES, lambda x: x * mm),
    ("sign", "A sign is reversed.", lambda x: -x),
)


def fed(case: tuple[Any, ...], i: int, change: Program) -> tuple[Any, ...]:
    """The inputs of a case with input i changed. Raises TypeError if this input is not numeric."""
    value = case[i]
    if isinstance(value, (float, int)) and not isinstance(value, bool):
        value = float(value)
    elif not (isinstance(value, np.ndarray) and value.dtype.kind == "f"):
        raise TypeError("wanted numbers")
    return (*case[:i], change(value), *case[i + 1 :])


# (pattern in the message of a TypeError, sentence); the first that fits is used
_MATHS = r"operand(?!.* @: ).*|argument .* not |not supported .*"
ERRORS = (
    (
        rf"({_MATHS})'Transform'",
        "A pose is not a vector: `pose.translation` is its position, `pose.rotation` its rotation.",
    ),
    (
        rf"({_MATHS})'NoneType'",
        "One of these values is None: does a function that you call have no `return`?",
    ),
    (
        rf"({_MATHS})'(list|tuple)'|multiply sequence by non-int of type 'float'",
        "A list is not a vector: compute with `np.array(...)`.",
    ),
    (
        "'numpy.ndarray' object is not callable",
        "An array is not a function: write `a[0]` for its first value, and `pose.translation` "
        "without brackets.",
    ),
)
