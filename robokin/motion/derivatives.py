"""Speeds and accelerations from samples."""

import numpy as np

from .._validate import floats


def differentiate(values, t, order=1):
    """The derivative of samples by central differences, one-sided at both ends (`numpy.gradient`,
    second order).

    values (samples,) or (..., samples, n), t (samples,) in seconds, rising; the result has the
    shape of `values`. `order` 2 differentiates twice, and so on. It takes what it gets: give it
    unwrapped angles (`follow` does). A NaN spreads to its neighbours. ValueError: fewer than three
    samples, shapes that do not fit, times that do not rise.
    """
    values, t = floats(values, "values", finite=False), floats(t, "t")
    if t.ndim != 1 or len(t) < 3:
        raise ValueError(f"t: wanted at least three times, got shape {t.shape}")
    if (np.diff(t) <= 0).any():
        raise ValueError("t: wanted rising times, got a step that is not positive")
    axis = 0 if values.ndim == 1 else -2
    if values.ndim == 0 or values.shape[axis] != len(t):
        raise ValueError(
            f"values: wanted {len(t)} samples, one for each time, got shape {values.shape}"
        )
    if not (isinstance(order, (int, np.integer)) and order >= 1):
        raise ValueError(f"order: wanted 1, 2, ..., got {order!r}")
    for _ in range(order):
        slopes = np.gradient(values, t, axis=axis, edge_order=2)
        # a missing sample has no slope, though its neighbours have
        values = np.where(np.isnan(values), np.nan, slopes)
    return values
