"""Check the arguments of figures, players and things in a scene."""

import itertools
from collections.abc import Iterable
from typing import Any

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import floats, instance, short, text
from ..arms.arm import Arm

HORIZON = 1e9  # metres: the largest coordinate or length in a picture
LONGEST = 2000  # maximum number of characters in a title or a name


def in_sight(lengths: Floats, name: str) -> Floats:
    """Return lengths (...) in metres; NaN is accepted. Raises ValueError if a length is too large
    to be drawn.
    """
    if (abs(lengths) > HORIZON).any():
        raise ValueError(f"{name}: wanted at most {HORIZON:g} m, got {np.nanmax(abs(lengths)):g} m")
    return lengths


def several(
    value: Any, name: str, what: str, most: int = 100, error: type[Exception] = ValueError
) -> list[Any]:
    """Return the items of `value` if it is a list or another iterable; otherwise raises `error`
    with a message that `what` was wanted. Raises ValueError if there are more than `most` items.
    """
    alone = isinstance(value, (str, bytes)) or (isinstance(value, np.ndarray) and not value.ndim)
    if alone or not isinstance(value, Iterable):
        raise error(f"{name}: wanted {what}, got {short(value)}")
    found = list(itertools.islice(value, most + 1))
    if len(found) > most:
        raise ValueError(f"{name}: wanted at most {most}, got more")
    return found


def yes(value: Any, name: str) -> bool:
    """Return `value` as a bool. Raises ValueError if it is neither True nor False."""
    if not isinstance(value, (bool, np.bool_)):
        raise ValueError(f"{name}: wanted True or False, got {short(value)}")
    return bool(value)


def plain(value: Any, name: str) -> str:
    """Return `value` as text for a figure or a page. Lone surrogates, which cannot be saved in a
    file, are replaced by U+FFFD. Raises ValueError if `value` is not a string or is too long.
    """
    if len(text(value, name)) > LONGEST:
        raise ValueError(f"{name}: wanted at most {LONGEST} characters, got {len(value)}")
    return str(value).encode("utf-16", "surrogatepass").decode("utf-16", "replace")


def if_given(value: str | None, name: str) -> str | None:
    """Return a title or alt text as `plain` does, or None if there is none."""
    return None if value is None else plain(value, name)


def sentence(title: str | None) -> list[str]:
    """Return a title as the first sentence of the alt text, in a list."""
    return [title.rstrip(".") + "."] if title else []


def samples(
    arm: Arm, values: ArrayLike | None, name: str = "q", count: int | None = None
) -> Floats:
    """Return values (samples, n) for an arm of n joints. Raises ValueError if the shape or the
    number of samples is wrong.
    """
    found = floats(values, name, len(instance(arm, Arm, "arm").links), finite=False)
    if found.ndim == 1:
        found = found[None]
    if found.ndim != 2 or not len(found) or count not in (None, len(found)):
        wanted = count or "samples"
        raise ValueError(f"{name}: wanted shape ({wanted}, {len(arm.links)}), got {found.shape}")
    return found
