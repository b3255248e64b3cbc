"""The greatest value of a quantity over time, where the function behind it is known."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from .._arrays import Floats
from .._validate import floats, number, short, whole

STEPS = 64  # between the samples of a stretch
DIGITS = 12  # behind the point; a float has few more
MOST = 200  # stretches that are looked at


class Maximum(NamedTuple):
    """A greatest value, and where it is."""

    value: float
    at: float


def refined_maximum(
    function: Callable[[Floats], Floats], low: float, high: float, decimals: int
) -> Maximum:
    """The greatest value between `low` and `high`, to be shown with `decimals`: two more stand.

    The stretch is sampled in 64 steps; so is the stretch round each sample that stands above its
    neighbours, if it would be the greatest when raised by as much again; and so on, until none
    would change the greatest by half a unit of the second decimal behind those shown. A concave
    peak rises above its greatest sample by no more than that. A peak between two samples that
    neither of them tells of, narrower than a 64th, is not seen.

    `function` maps an array (k,) to an array (k,); NaN where it has no value. The lowest is that of
    the function's negative. TypeError: no function. ValueError: no finite range, other shapes, no
    value at all, or one that does not stand: beside a pole, say.

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
    for _ in range(MOST):
        if not stretches or stretches[-1][0] < best.value + fine:
            break
        _, start, stop = stretches.pop()
        at = start + (stop - start) * (np.arange(STEPS + 1) / STEPS)
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
            ends = float(at[max(i - 1, 0)]), float(at[min(i + 1, STEPS)])
            stretches.append((float(hopes[i]), *ends))
        stretches.sort()
    else:
        raise ValueError(f"function: wanted a greatest value that stands, got {best.value:g}")
    if best.value == -np.inf:
        raise ValueError("function: wanted values, got none")
    return best
