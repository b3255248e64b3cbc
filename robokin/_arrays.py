"""Arrays: what nobody may write, how the numbers lie in memory, and in what portions a batch is
worked on.

NumPy works fastest on components: one array for all x, one for all y, each in one long run in
memory. The formulas of this package are written on components; how the runs are made and cut stands
here and nowhere else.
"""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]
Bools: TypeAlias = NDArray[np.bool_]
Ints: TypeAlias = NDArray[np.int64]

BLOCK = 2048  # rows worked on at a time, so that the work stays in the processor's cache


def sealed(array: Floats) -> Floats:
    """This very array, which nobody else holds, made read-only."""
    array.flags.writeable = False
    return array


def frozen(array: Floats) -> Floats:
    """A read-only copy."""
    return sealed(array.copy())


def components(array: Floats) -> tuple[Floats, ...]:
    """The parts of the last axis: (..., k) -> k arrays (...)."""
    return tuple(array[..., i] for i in range(array.shape[-1]))


def stack(parts: Sequence[Floats]) -> Floats:
    """The way back from `components`: k arrays, broadcast, -> (..., k), each component in one long
    run.
    """
    out = np.empty((*np.broadcast(*parts).shape, len(parts)), order="F")
    for i, part in enumerate(parts):
        out[..., i] = part
    return out
