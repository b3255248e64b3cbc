"""Speeds and accelerations from samples."""

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import floats, short, whole

ORDERS = 10  # maximum order; each order divides the rounding errors by the step again


def differentiate(values: ArrayLike, t: ArrayLike, order: int = 1) -> Floats:
    """The derivative of samples by central differences, one-sided at both ends (`numpy.gradient`,
    second order).

    values (samples,) or (..., samples, n); t (samples,) in seconds, strictly increasing. The result
    has the shape of `values`. `order` 2 differentiates twice, and so on up to 10. Angles are not
    unwrapped here: pass unwrapped ones (as `follow` returns them). A NaN also makes the
    neighbouring results NaN. Raises ValueError if there are fewer than three samples, the shapes do
    not match, the times do not increase, or a slope overflows.

    >>> t = np.array([0, 0.1, 0.2, 0.3])
    >>> differentiate(5 * t**2, t).round(3), differentiate(5 * t**2, t, 2).round(3)
    (array([0., 1., 2., 3.]), array([10., 10., 10., 10.]))
    """
    values, t = floats(values, "values", finite=False), rising(t)
    axis = 0 if values.ndim == 1 else -2
    if values.ndim == 0 or values.shape[axis] != len(t):
        raise ValueError(
            f"values: wanted {len(t)} samples, one for each time, got shape {values.shape}"
        )
    if whole(order, "order", 1) > ORDERS:
        raise ValueError(
            f"order: wanted at most {ORDERS}, got {short(order)}: {values.size} numbers would be "
            "differentiated that many times, and only rounding errors would be left"
        )
    for _ in range(order):
        with np.errstate(all="ignore"):
            slopes = np.gradient(values, t, axis=axis, edge_order=2)
        missing = np.isnan(values)
        known = np.isfinite(slopes)
        if missing.any():
            slopes[missing] = np.nan  # a missing sample has no slope, even if its neighbours do
            known = ~np.isinf(slopes)
        if not known.all():
            raise ValueError("values and t: wanted finite slopes, got infinite ones")
        values = slopes
    return values


def rising(t: ArrayLike, least: int = 3) -> Floats:
    """Return `t` as an array of at least `least` strictly increasing times. Raises ValueError if it
    is not such an array.
    """
    t = floats(t, "t")
    if t.ndim != 1 or len(t) < least:
        words = {2: "two", 3: "three"}[least]
        raise ValueError(f"t: wanted at least {words} times, got shape {t.shape}")
    if (t[1:] <= t[:-1]).any():
        raise ValueError("t: wanted increasing times, got a step that is not positive")
    return t
