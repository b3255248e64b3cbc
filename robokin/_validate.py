"""What every public call asks of the arrays it is given."""

import numpy as np


def floats(value, name, last=None, finite=True):
    """`value` as a float array; `last` is the length that its last axis must have. ValueError
    otherwise.

    With `finite=False` a NaN passes (a row that does not exist) and an infinite number does not.
    """
    try:
        array = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{name}: wanted numbers, got {_short(value)}") from None
    if last is not None and (array.ndim == 0 or array.shape[-1] != last):
        raise ValueError(f"{name}: wanted shape (..., {last}), got {array.shape}")
    bad = ~np.isfinite(array) if finite else np.isinf(array)
    if bad.any():
        where = tuple(int(i) for i in np.argwhere(bad)[0])
        raise ValueError(f"{name}: wanted finite numbers, got {array[where]} at index {where}")
    return array


def length(value, name):
    """`value` as a float, if it is one positive number (of metres); ValueError otherwise."""
    array = floats(value, name)
    if array.ndim or array <= 0:
        raise ValueError(f"{name}: wanted one positive length in metres, got {_short(value)}")
    return float(array)


def broadcast(name, *shapes):
    """The common batch shape; ValueError where the shapes do not fit."""
    if all(shape == shapes[0] for shape in shapes):
        return shapes[0]
    try:
        return np.broadcast_shapes(*shapes)
    except ValueError:
        raise ValueError(
            f"{name}: batch shapes {' and '.join(map(str, shapes))} do not fit together"
        ) from None


def instance(value, kind, name, hint=""):
    """`value`, if it is a `kind`; ValueError otherwise."""
    if not isinstance(value, kind):
        raise ValueError(f"{name}: wanted a {kind.__name__}, got {_short(value)}{hint}")
    return value


def _short(value):
    text = f"array of shape {value.shape}" if isinstance(value, np.ndarray) else repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
