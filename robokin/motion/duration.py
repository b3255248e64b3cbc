"""How fast an arm can move along a path without exceeding its speed limits."""

from collections.abc import Callable

import numpy as np

from .._arrays import Floats
from .._validate import floats, instance, short
from ..arms.arm import Arm
from .laws import TimeLaw, linear

FIRST = 256  # steps into which the motion is divided at first
PARTS = 8  # parts into which a step is divided again
SHORT = 1e-7  # steps that take a smaller fraction of the duration than this are not divided
MOST = 2**17  # maximum number of steps
FINE = 1e-5  # relative accuracy of the result


def shortest_duration(
    arm: Arm,
    path: Callable[[Floats], Floats],
    law: Callable[[float], TimeLaw] = linear,
) -> float:
    """The shortest duration, in seconds, in which `arm` can follow a path without exceeding the
    speed limit of any joint.

    path  maps s (k,), rising from 0 to 1, to postures (k, n), for example those of `ptp`
    law   makes the time law from its duration, for example `linear` or `quintic`

    If a motion takes k times as long, every joint is slower by the factor k. So the result is the
    greatest of the ratios |speed| / limit in a motion that takes one second. It is exact for `ptp`
    with the linear law. Otherwise we divide the motion into steps and take the mean speed of each
    step. Where this speed rises so fast that the maximum may be higher by more than a factor of
    1 + 1e-5, we divide the steps again. Source: 000, "Обзор источников", the motion along a
    straight line in the space Q: its time is increased if a joint is too fast.

    Returns 0 if no joint moves, and NaN if a posture of the path is NaN. Raises TypeError if `path`
    or `law` is not a function, or if `law` makes no time law. Raises ValueError if the arm has no
    speed limits, if the postures have another shape, or if a joint jumps.

    >>> here, there = np.zeros(6), np.array([90, 40, -60, 0, 45, 180]) * deg
    >>> round(shortest_duration(IRB140, lambda s: ptp(here, there, s)), 3)
    0.45
    >>> round(shortest_duration(IRB140, lambda s: ptp(here, there, s), quintic), 3)
    0.844
    """
    limits = instance(arm, Arm, "arm").speed_limits
    if limits is None:
        raise ValueError(f"arm: wanted an arm with speed limits, got {arm.name} without")
    for name, function in (("path", path), ("law", law)):
        if not callable(function):
            raise TypeError(f"{name}: wanted a function, got {short(function)}")
    second = instance(law(1.0), TimeLaw, "law(1.0)")
    x, before = np.arange(FIRST + 1) / FIRST, np.inf
    while len(x) <= MOST:
        q = floats(path(second(x * second.duration)), "path", len(limits), finite=False)
        if q.shape != (len(x), len(limits)):
            raise ValueError(f"path: wanted shape {(len(x), len(limits))}, got {q.shape}")
        if not np.isfinite(q).all():
            return float("nan")
        width = np.diff(x)
        load = (abs(np.diff(q, axis=0)) / limits).max(axis=-1) / width
        sides = np.pad(load, 1, mode="edge")
        hope = 2 * load - np.minimum(sides[:-2], sides[2:])
        high = np.pad(hope > (1 + FINE) * load.max(), 1)
        split = (high[:-2] | high[1:-1] | high[2:]) & (width > SHORT)
        if not split.any():
            if load.max() > 2 * before:  # shorter steps never bring this to an end
                break
            return float(load.max())
        before = load.max()
        parts = x[:-1][split, None] + width[split, None] * np.arange(1, PARTS) / PARTS
        x = np.sort(np.append(x, parts))
    raise ValueError("path: wanted one without jumps, got speeds that grow as steps get shorter")
