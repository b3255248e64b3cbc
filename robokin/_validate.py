"""Checks of the arguments of public functions, and their error messages.

There is one rule. A number, array or string that is of the wrong kind or has the wrong shape or
value raises a `ValueError`. An argument that is not an instance of the required class (an arm, a
pose, a task) raises a `TypeError`. Both messages have the form `name: wanted ..., got ...`. A legal
value that is probably a mistake, such as degrees for radians, causes a warning and is accepted.
"""

import math
import reprlib
import warnings
from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np

from ._arrays import Bools, Floats

T = TypeVar("T")
FLOAT = np.dtype(float)
TWO_TURNS = 4 * np.pi
# maximum number of axes of an argument; a result may have two more, and NumPy allows at most 32
AXES = 30
GREATEST = 10**8  # maximum number of values in one array: more would exhaust a laptop's memory


def floats(value: Any, name: str, last: int | None = None, finite: bool = True) -> Floats:
    """Return `value` as a float array. `last` is the required length of its last axis. Raises
    ValueError if `value` cannot be converted.

    With `finite=False`, NaN (which marks a row that does not exist) is accepted, but infinity is
    not. The result may share memory with `value`, so a caller that stores it must copy it.
    """
    array = _numbers(value, name)
    if array.ndim > AXES:
        raise ValueError(f"{name}: wanted at most {AXES} axes, got {array.ndim}")
    if last is not None and (array.ndim == 0 or array.shape[-1] != last):
        raise ValueError(f"{name}: wanted shape (..., {last}), got {array.shape}")
    good = np.isfinite(array) if finite else ~np.isinf(array)
    # for a few numbers, this is three times as fast as `all`
    if np.count_nonzero(good) < array.size:
        where = tuple(int(i) for i in np.argwhere(~good)[0])
        raise ValueError(f"{name}: wanted finite numbers, got {array[where]} at index {where}")
    return array


def number(value: Any, name: str, what: str = "one number") -> float:
    """Return `value` as a float. Raises ValueError if it is not one finite number; the message says
    that `what` was wanted.
    """
    if type(value) is float and math.isfinite(value):
        return value  # ten times as fast as by an array
    array = floats(value, name)
    if array.ndim:
        raise ValueError(f"{name}: wanted {what}, got {short(value)}")
    return float(array)


def positive(value: Any, name: str, what: str = "one positive number") -> float:
    """Return `value` as a float. Raises ValueError if it is not one positive number; the message
    says that `what` was wanted.
    """
    one = number(value, name, what)
    if one <= 0:
        raise ValueError(f"{name}: wanted {what}, got {short(value)}")
    return one


def length(value: Any, name: str) -> float:
    """Return `value`, in metres, as a float. Raises ValueError if it is not one positive number."""
    return positive(value, name, "one positive length in metres")


def whole(value: Any, name: str, low: int, high: int | None = None) -> int:
    """Return `value` as an int. Raises ValueError if it is not a whole number from `low` to `high`.
    True and False do not count as numbers.
    """
    good = isinstance(value, (int, np.integer)) and not isinstance(value, (bool, np.timedelta64))
    if not (good and low <= value and (high is None or value <= high)):
        wanted = f"from {low} to {high}" if high is not None else f"of at least {low}"
        raise ValueError(f"{name}: wanted a whole number {wanted}, got {short(value)}")
    return int(value)


def bools(value: Any, name: str) -> Bools:
    """Return `value` as a boolean array. Raises ValueError if it contains anything but True and
    False.
    """
    try:
        array = np.asarray(value)
    except Exception:  # an object that claims to be an array may raise any error
        array = np.array(0)
    if array.dtype != bool or masked(value):
        raise ValueError(f"{name}: wanted True or False, or an array of them, got {short(value)}")
    return array


def selected(part: Floats) -> Floats:
    """Return the part of an array that an index selected. Raises ValueError if the part has more
    axes than NumPy can broadcast.
    """
    if part.ndim > AXES + 2:
        raise ValueError(f"index: wanted at most {AXES + 2} axes, got {part.ndim}")
    return part


def shape_of(value: Any, name: str) -> tuple[int, ...]:
    """Return `value` as a tuple. Raises ValueError if it is not the shape of an array with at most
    30 axes.
    """
    if not (isinstance(value, (tuple, list)) and all(type(n) is int and n >= 0 for n in value)):
        raise ValueError(f"{name}: wanted a tuple of whole numbers, got {short(value)}")
    if len(value) > AXES:
        raise ValueError(f"{name}: wanted at most {AXES} axes, got {len(value)}")
    if math.prod(value) > GREATEST:
        raise ValueError(
            f"{name}: wanted at most {GREATEST:g} values, got {short(math.prod(value))}"
        )
    return tuple(value)


def text(value: Any, name: str) -> str:
    """Return `value`. Raises ValueError if it is not a string."""
    if not isinstance(value, str):
        raise ValueError(f"{name}: wanted a string, got {short(value)}")
    return value


def choice(value: Any, name: str, options: Sequence[str]) -> str:
    """Return `value`. Raises ValueError if it is not one of the options."""
    if not (isinstance(value, str) and value in options):
        raise ValueError(f"{name}: wanted one of {tuple(options)}, got {short(value)}")
    return value


def broadcast(name: str, *shapes: tuple[int, ...]) -> tuple[int, ...]:
    """Return the common batch shape. Raises ValueError if the shapes cannot be broadcast."""
    if all(shape == shapes[0] for shape in shapes):
        return shapes[0]
    try:
        return np.broadcast_shapes(*shapes)
    except ValueError:
        fit = f"{' and '.join(map(str, shapes))} do not fit together"
        raise ValueError(f"{name}: batch shapes {fit}") from None


def instance(value: Any, kind: type[T], name: str, hint: str = "") -> T:
    """Return `value`. Raises TypeError if it is not an instance of `kind`."""
    if not isinstance(value, kind):
        article = "an" if kind.__name__[0] in "AEIOU" else "a"
        raise TypeError(f"{name}: wanted {article} {kind.__name__}, got {short(value)}{hint}")
    return value


def warn_if_degrees(angles: Floats, name: str, stacklevel: int = 3, posture: int = 0) -> None:
    """Warn (UserWarning) if angles that should be in radians are probably in degrees, that is, if
    one of them exceeds two turns (eight turns in a batch, which may be a motion in which a joint
    keeps turning).

    posture  1 if the last axis holds the joints of one posture, 0 if the angles are independent
    """
    limit = TWO_TURNS if angles.ndim <= posture else 4 * TWO_TURNS
    far = abs(angles) > limit
    if np.count_nonzero(far):
        text = f"{name}: {abs(angles[far]).max():.6g} rad is many turns; did you mean degrees?"
        warnings.warn(f"{text} (90 * deg)", UserWarning, stacklevel=stacklevel)


def short(value: Any) -> str:
    """Return an invalid argument as text of at most sixty characters, for an error message."""
    if isinstance(value, np.ndarray):
        return f"array of shape {value.shape}"
    try:
        text = (
            reprlib.repr(value) if isinstance(value, (str, list, tuple, dict, int)) else repr(value)
        )
    except Exception:  # `repr` may raise any error, but this function must not
        text = f"an object of type {type(value).__name__}"
    return text if len(text) <= 60 else f"{text[:57]}..."


def _numbers(value: Any, name: str) -> Floats:
    """Return `value` as floats. Raises ValueError if it contains anything but real numbers."""
    if type(value) is np.ndarray and value.dtype is FLOAT:
        return value
    if masked(value):
        raise ValueError(f"{name}: wanted numbers, got a masked array (call `filled` first)")
    try:
        array = np.asarray(value)
        if array.dtype is FLOAT:
            return array
        if array.dtype.kind == "O" and array.size and all(map(_is_real, array.flat)):
            return array.astype(float)  # integers too large for NumPy, or fractions
    except Exception:  # an object that claims to be an array may raise any error
        raise ValueError(f"{name}: wanted numbers, got {short(value)}") from None
    if array.dtype.kind not in "biuf":
        raise ValueError(f"{name}: wanted numbers, got {short(value)}")
    with np.errstate(over="ignore"):  # a number with more than 64 bits may overflow
        return array.astype(float)


def masked(value: Any) -> bool:
    """Return whether `value` is a masked array. We do not use `np.ma`, since importing it takes 8
    ms.
    """
    return isinstance(value, np.ndarray) and hasattr(value, "mask")


def _is_real(value: Any) -> bool:
    from numbers import Real  # imported here because it is rarely needed

    return isinstance(value, Real)
