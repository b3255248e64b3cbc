"""The greatest value of a function in an interval."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from .._arrays import Floats
from .._validate import floats, number, short, whole

STEPS = 64  # steps into which the interval is divided
AROUND = 8  # steps into which the two steps around a peak are divided
DIGITS = 12  # maximum number of decimals; a float has only a few more
MOST = 200  # maximum number of intervals that are sampled


class Maximum(NamedTuple):
    """The greatest value, and where it is reached."""

    value: float
    at: float


def refined_maximum(
    function: Callable[[Floats], Floats], low: float, high: float, decimals: int
) -> Maximum:
    """The greatest value between `low` and `high`, accurate to two more decimals than the
    `decimals` to be shown.

    We sample the interval in 64 steps. A concave peak rises above its highest sample by no more
    than this sample rises above the lower of its neighbours. We therefore sample again around every
    peak that could be the highest, and stop when no peak can raise the maximum by half a unit of
    the second decimal beyond those shown. A peak that is narrower than 1/64 of the interval and
    lies between two samples is missed.

    `function` maps an array (k,) to an array (k,), NaN where it has no value. For a minimum, negate
    the function. Raises TypeError if `function` is not callable. Raises ValueError if the interval
    is not finite, a result has another shape, all results are NaN, or the search does not converge,
    for example near a pole.

    >>> value, at = refined_maximum(lambda t: t * np.exp(-t), 0, 3, 3)
    >>> round(value, 5), round(at, 2)
    (0.36788, 1.0)
    """
    if not callable(function):
        raise TypeError(f"function: wanted a function, got {short(function)}")
    low, high = number(low, "low"), number(high, "high")
    if not low < high:
        raise ValueError(f"low and high: wanted low < high, got {low:g} and {high:g}")
    fine = 0.5 * 10.0 ** -(whole(decimals, "decimals", 0, DIGITS) + 2)
    best, stretches = Maximum(-np.inf, np.nan), [(np.inf, low, high)]
    for looked in range(MOST):
        if not stretches or stretches[-1][0] < best.value + fine:
            break
        _, start, stop = stretches.pop()
        steps = AROUND if looked else STEPS
        at = start + (stop - start) * (np.arange(steps + 1) / steps)
        values = floats(function(at), "function", finite=False)
        if values.shape != at.shape:
            raise ValueError(f"function: wanted shape {at.shape}, got {values.shape}")
        top = int(np.where(np.isnan(values), -np.inf, values).argmax())
        if values[top] > best.value:
            best = Maximum(float(values[top]), float(at[top]))
        sides = np.pad(values, 1, constant_values=np.nan)
        before, after = sides[:-2], sides[2:]
        hopes = 2 * values - np.fmin(values, np.fmin(before, after))
        peaks: list[int] = np.flatnonzero(
            values >= np.fmax(before, np.fmax(values, after))
        ).tolist()
        for i in peaks:
            ends = float(at[max(i - 1, 0)]), float(at[min(i + 1, steps)])
            stretches.append((float(hopes[i]), *ends))
        stretches.sort()
    else:
        got = f"{best.value:g} after {MOST} intervals"
        raise ValueError(f"function: wanted one for which the search converges, got {got}")
    if best.value == -np.inf:
        raise ValueError("function: wanted at least one value, got only NaN")
    return best
