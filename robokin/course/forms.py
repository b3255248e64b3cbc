"""Forms for several exercises. A form converts a result for comparison, or raises a ValueError that
says what was wanted and what was received.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .._arrays import Floats
from ..arms.scara import ScaraPose
from ..quaternion import Quaternion
from ..transform import Transform
from .answers import equal
from .exercises import in_words
from .exercises import numbers as as_numbers
from .told import floats, one_number


def same(a: Any, b: Any) -> bool:
    """Return whether two results are equal. Numbers may differ by 1e-6, or by one millionth of
    their size if they are large; NaN equals NaN.
    """
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    if isinstance(a, ScaraPose) and isinstance(b, ScaraPose):
        a, b = ([*each.position.ravel(), *each.angle.ravel()] for each in (a, b))
    one, two = as_numbers(a), as_numbers(b)
    if one is None or two is None:
        return equal(a, b)
    return one.shape == two.shape and np.allclose(one, two, rtol=1e-6, atol=1e-6, equal_nan=True)


def like(result: Any, wanted: Any) -> Any:
    """Return a result with the type and shape of the correct one. Raises ValueError if it has a
    different type or shape.
    """
    if isinstance(wanted, (bool, np.bool_)):
        return truth(result)
    if isinstance(wanted, (str, Transform, Quaternion, ScaraPose)):
        if not isinstance(result, type(wanted)):
            raise ValueError(f"wanted a {type(wanted).__name__}, got {in_words(result)}")
        return result
    if isinstance(wanted, Mapping):
        if not isinstance(result, Mapping) or result.keys() != wanted.keys():
            raise ValueError(
                f"wanted a dict with {', '.join(map(repr, wanted))}, got {in_words(result)}"
            )
        return {key: like(result[key], wanted[key]) for key in wanted}
    if np.asarray(wanted).dtype.kind == "b":
        made = np.asarray(result)
        if made.dtype.kind != "b" or made.shape != np.shape(wanted):
            shape = np.shape(wanted)
            raise ValueError(
                f"wanted True or False in an array of shape {shape}, got {in_words(result)}"
            )
        return made
    return numbers(result, np.shape(wanted))


def numbers(result: Any, shape: tuple[int, ...], what: str = "") -> Floats:
    """Return numbers of this shape. Raises ValueError if the result is not numeric or its shape
    differs.
    """
    if not what:
        what = f"an array of shape {shape}" if shape else "a number"
    try:
        values = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"wanted {what}, got {in_words(result)}") from None
    if values.shape != shape and (values.size, shape) != (1, ()):
        raise ValueError(f"wanted {what}, got {in_words(result)}")
    return values.reshape(shape)


def truth(result: Any, what: str = "") -> bool:
    """Return True or False. Raises ValueError if it is something else; `what` is added to the
    message.
    """
    if not isinstance(result, (bool, np.bool_)):
        raise ValueError(f"wanted True or False{what and f' {what}'}, got {in_words(result)}")
    return bool(result)


def numbers_of(answer: Any, names: Sequence[str]) -> dict[str, float]:
    """Return a dict with a finite number for each name. Raises ValueError if one is missing or
    invalid.
    """
    if not isinstance(answer, Mapping):
        raise ValueError(f"Wanted a dict with {' and '.join(names)}, got {in_words(answer)}.")
    missing = [name for name in names if name not in answer]
    if missing:
        raise ValueError(f"Your dict has no {' and no '.join(map(repr, missing))}.")
    found = {}
    for name in names:
        try:
            found[name] = one_number(answer[name])
        except (TypeError, ValueError):
            raise ValueError(f"{name}: wanted one number, got {in_words(answer[name])}.") from None
        if not np.isfinite(found[name]):
            raise ValueError(f"{name}: wanted a finite number, got {in_words(answer[name])}.")
    return found
