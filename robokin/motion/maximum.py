"""The greatest value of a quantity over time, where the function behind it is known."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from .._arrays import Floats
from .._validate import floats, number, short, whole

FIRST, LAST = 32, 2**20  # steps between the first samples, and at most


class Maximum(NamedTuple):
    """A greatest value, and where it is."""

    value: float
    at: float


def refined_maximum(
    function: Callable[[Floats], Floats], low: float, high: float, decimals: int
) -> Maximum:
    """The greatest value between `low` and `high`, to be shown with so many decimals: sampled in 32
    steps, then ever again in twice as many, until two doublings in a row change it by less than
    half a unit of the second decimal behind those shown. A peak narrower than a 32nd that no sample
    meets is not seen.

    `function` maps an array (k,) to an array (k,); NaN where it has no value. The lowest is that of
    the function's negative. TypeError: no function. ValueError: no finite range, other shapes, no
    value at all, or one that does not stand in 2^20 steps: beside a pole, say.

    >>> value, at = refined_maximum(lambda t: t * np.exp(-t), 0, 3, 3)
    >>> round(value, 5), round(at, 2)
    (0.36788, 1.0)
    """
    if not callable(function):
        raise TypeError(f"function: wanted a function, got {short(function)}")
    low, high = number(low, "low"), number(high, "high")
    if not low < high:
        raise ValueError(f"low and high: wanted low < high, got {low:g} and {high:g}")
    fine = 0.5 * 10.0 ** -(whole(decimals, "decimals", 0) + 2)

    def most(shares: Floats) -> Maximum:
        at = low + (high - low) * shares
        values = floats(function(at), "function", finite=False)
        if values.shape != at.shape:
            raise ValueError(f"function: wanted shape {at.shape}, got {values.shape}")
        values = np.where(np.isnan(values), -np.inf, values)
        best = int(values.argmax())
        return Maximum(float(values[best]), float(at[best]))

    steps, stands = FIRST, 0
    found = most(np.arange(steps + 1) / steps)
    while stands < 2:
        steps *= 2
        if steps > LAST:
            raise ValueError(f"function: wanted a greatest value that stands, got {found.value:g}")
        better = most(np.arange(1, steps, 2) / steps)
        stands = 0 if better.value > found.value + fine else stands + 1
        found = better if better.value > found.value else found
    if found.value == -np.inf:
        raise ValueError("function: wanted values, got none")
    return found
