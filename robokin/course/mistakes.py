"""Mistakes that are made everywhere, each as a small wrong program: the right one, fed, built or
read wrongly. Every exercise tries them all; the mistakes of one exercise stand in its lab's file.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, mm, wrapped

Program = Callable[..., Any]


class Mistake(NamedTuple):
    """A wrong program, its name, and a sentence to who has made it: what it is, and what helps."""

    name: str
    says: str
    program: Program


@dataclass(frozen=True)
class Tools:
    """The operations that a right program is written with, so that a wrong one can be swapped in.

    product  of two poses, rotations or matrices: first b, then a, seen from the base
    inverse  of a pose or a rotation
    atan2    angle from sine and cosine
    short    (to, from): the values of angles `to`, whole turns left out, nearest to `from`
    """

    product: Program = lambda a, b: a @ b
    inverse: Program = lambda a: a.inverse()
    atan2: Program = np.arctan2
    short: Program = lambda to, start: wrapped(to, start)


def _elementwise(a: Any, b: Any) -> Any:
    if isinstance(a, np.ndarray):
        return a * b
    raise TypeError("not an array")


TOOLS = (
    (
        "order of a product",
        "Two factors of a product are in the wrong order. In A @ B the right factor acts first, "
        "seen from the base.",
        {"product": lambda a, b: b @ a},
    ),
    (
        "element-wise product",
        "`*` multiplies element by element; the product of matrices is `@`.",
        {"product": _elementwise},
    ),
    (
        "inverse left out",
        "Something is used as it is where its inverse is wanted.",
        {"inverse": lambda a: a},
    ),
    (
        "arcsin for atan2",
        "The angle comes from its sine alone: half of the plane is lost. Use arctan2 of sine and "
        "cosine.",
        {"atan2": lambda y, x: np.arcsin(np.clip(y / np.maximum(np.hypot(y, x), 1e-300), -1, 1))},
    ),
    (
        "the long way round",
        "An angle goes through a whole turn more than it has to: two values that differ by 360 "
        "degrees are the same posture.",
        {"short": lambda to, start: to},
    ),
)


def _numbers(change: Program) -> Program:
    """`change` of a result that is numbers; ValueError for another one."""

    def changed(value: Any) -> Any:
        if isinstance(value, (Transform, Quaternion, str, bool)) or value is None:
            raise ValueError("no numbers")
        return change(np.asarray(value, dtype=float))

    return changed


def _place(change: Program) -> Program:
    """`change` of the place of a pose, or of numbers."""

    def changed(value: Any) -> Any:
        if isinstance(value, Transform):
            return Transform(value.rotation, change(value.translation))
        return _numbers(change)(value)

    return changed


def _turn(change: Program) -> Program:
    """`change` of the angle of a pose's rotation about its axis, or of numbers."""

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
            raise ValueError("not three axes")
        return flip * value

    return turned


def _sample(by: int) -> Program:
    def shifted(value: Any) -> Any:
        value = np.asarray(value, dtype=float)
        if value.ndim == 0 or len(value) < 9:
            raise ValueError("no samples")
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
        raise ValueError("nothing to transpose")
    return np.swapaxes(value, -1, -2)


def _not(value: Any) -> Any:
    if not isinstance(value, (bool, np.bool_)):
        raise ValueError("neither True nor False")
    return not value


DEGREES = "Angles are in radians here: `90 * deg`, and `angle / deg` only to print."
METRES = "Lengths are in metres here: `350 * mm`, and `length / mm` only to print."
# name, sentence, what is done to a result
RESULTS = (
    ("degrees for radians", DEGREES, _turn(lambda x: x / deg)),
    ("degrees for radians", DEGREES, _turn(lambda x: x * deg)),
    ("mm for m", METRES, _place(lambda x: x / mm)),
    ("mm for m", METRES, _place(lambda x: x * mm)),
    ("percent", "A share is a number from 0 to 1 here.", _numbers(lambda x: 100 * x)),
    (
        "a factor of two",
        "Your result is twice what it should be.",
        _numbers(lambda x: 2 * x),
    ),
    ("a factor of two", "Your result is half of what it should be.", _numbers(lambda x: x / 2)),
    ("sign", "Every sign is turned round.", _numbers(lambda x: -x)),
    *(
        ("sign of an axis", f"The sign of {letter} is turned round.", _axis(k))
        for k, letter in enumerate("xyz")
    ),
    (
        "inverse for the thing",
        "This is the inverse of what is wanted: the base seen from the tool, or 1 / x.",
        _inverse,
    ),
    ("transposed", "Rows and columns are exchanged.", _transposed),
    (
        "wrapped angle",
        "Angles are wrapped into -180 to 180 degrees. Here they go on, or stay inside the limits.",
        _numbers(wrapped),
    ),
    ("off by one sample", "Every value comes one sample too late.", _sample(+1)),
    ("off by one sample", "Every value comes one sample too early.", _sample(-1)),
    (
        "True and False exchanged",
        "It says True where False is right, and False where True is right.",
        _not,
    ),
)
# name, sentence, what is done to one of the inputs that are numbers
INPUTS = (
    ("degrees for radians", DEGREES, lambda x: x / deg),
    ("degrees for radians", DEGREES, lambda x: x * deg),
    ("mm for m", METRES, lambda x: x / mm),
    ("mm for m", METRES, lambda x: x * mm),
    ("sign", "A sign is turned round.", lambda x: -x),
)


def general(right: Program, inputs: Sequence[str]) -> Iterator[Mistake]:
    """Every general mistake made in `right(tools, *inputs)`."""
    for name, says, swapped in TOOLS:
        tools = replace(Tools(), **swapped)
        yield Mistake(name, says, lambda *case, tools=tools: right(tools, *case))
    for name, says, change in RESULTS:
        yield Mistake(name, says, lambda *case, change=change: change(right(Tools(), *case)))
    for name, says, change in INPUTS:
        for k, given in enumerate(inputs):
            yield Mistake(name, f"{says} It is about `{given}`.", _fed(right, k, change))


def _fed(right: Program, k: int, change: Program) -> Program:
    def program(*case: Any) -> Any:
        value = case[k]
        if isinstance(value, (float, int)) and not isinstance(value, bool):
            value = float(value)
        elif not (isinstance(value, np.ndarray) and value.dtype.kind == "f"):
            raise TypeError("no numbers")
        return right(Tools(), *case[:k], change(value), *case[k + 1 :])

    return program
