"""Checks of the arguments of figures, players and things in a scene."""

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
    """Return lengths (...) in metres if a figure can show them; NaN is accepted. ValueError: it
    cannot.
    """
    if (abs(lengths) > HORIZON).any():
        raise ValueError(f"{name}: wanted at most {HORIZON:g} m, got {np.nanmax(abs(lengths)):g} m")
    return lengths


def several(
    value: Any, name: str, what: str, most: int = 100, error: type[Exception] = ValueError
) -> list[Any]:
    """Return the items of `value` if it is a list or another iterable; otherwise raise `error`,
    which says that `what` was wanted. ValueError: there are more than `most` items.
    """
    alone = isinstance(value, (str, bytes)) or (isinstance(value, np.ndarray) and not value.ndim)
    if alone or not isinstance(value, Iterable):
        raise error(f"{name}: wanted {what}, got {short(value)}")
    found = list(itertools.islice(value, most + 1))
    if len(found) > most:
        raise ValueError(f"{name}: wanted at most {most}, got more")
    return found


def yes(value: Any, name: str) -> bool:
    """Return `value`. ValueError: it is neither True nor False."""
    if not isinstance(value, (bool, np.bool_)):
        raise ValueError(f"{name}: wanted True or False, got {short(value)}")
    return bool(value)


def plain(value: Any, name: str) -> str:
    """Return `value`. ValueError: it is not text for a figure or a page. Lone surrogates, which
    cannot be saved in a file, are replaced by U+FFFD.
    """
    if len(text(value, name)) > LONGEST:
        raise ValueError(f"{name}: wanted at most {LONGEST} characters, got {len(value)}")
    return str(value).encode("utf-16", "surrogatepass").decode("utf-16", "replace")


def if_given(value: str | None, name: str) -> str | None:
    """A title or an alternative text, or None."""
    return None if value is None else plain(value, name)


def sentence(title: str | None) -> list[str]:
    """A title as the first sentence of an alternative text."""
    return [title.rstrip(".") + "."] if title else []


def samples(
    arm: Arm, values: ArrayLike | None, name: str = "q", count: int | None = None
) -> Floats:
    """Values (samples, n) for an arm of n joints. ValueError: wrong shape or number of samples."""
    found = floats(values, name, len(instance(arm, Arm, "arm").links), finite=False)
    if found.ndim == 1:
        found = found[None]
    if found.ndim != 2 or not len(found) or count not in (None, len(found)):
        wanted = count or "samples"
        raise ValueError(f"{name}: wanted shape ({wanted}, {len(arm.links)}), got {found.shape}")
    return found
