"""Arrays: which ones are read-only, how the numbers lie in memory, and in what portions a batch is
worked on.

NumPy works fastest on components: one array for all x, one for all y, each in one long run in
memory. The formulas of this package are written on components; how the runs are made and cut stands
here and nowhere else.
"""

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike as ArrayLike
    from numpy.typing import NDArray

    Floats: TypeAlias = NDArray[np.float64]
    Bools: TypeAlias = NDArray[np.bool_]
    Ints: TypeAlias = NDArray[np.int64]
else:  # only a type checker reads them, and numpy.typing is slow to import
    ArrayLike = Any
    Floats = Bools = Ints = np.ndarray

Array = TypeVar("Array", bound="NDArray[Any]")

BLOCK = 16_000  # numbers in one array of the work: 128 kB, which memory is kept ready for


def sealed(array: Array) -> Array:
    """This very array, which nobody else holds, made read-only."""
    array.setflags(write=False)
    return array


def frozen(array: Array) -> Array:
    """A read-only copy."""
    return sealed(array.copy())


class Sealed:
    """The base of a frozen dataclass that holds arrays, directly or in tuples. Its copies and what
    comes out of a pickle are read-only, too; NumPy copies no flags.
    """

    def __setstate__(self, state: dict[str, Any]) -> None:
        _seal(tuple(state.values()))
        vars(self).update(state)


def components(array: Floats) -> tuple[Any, ...]:
    """The parts of the last axis: (..., k) -> k arrays (...); (k,) -> k plain numbers, with which
    the same formulas are several times as fast as with arrays of one.
    """
    if array.ndim == 1:
        return tuple(array.tolist())
    return tuple(array[..., i] for i in range(array.shape[-1]))


def stack(parts: Sequence[Any]) -> Floats:
    """The way back from `components`: k arrays or numbers, broadcast, -> (..., k), each component
    in one long run.
    """
    if all(isinstance(part, float) for part in parts):
        return np.array(parts)
    out = np.empty((*np.broadcast(*parts).shape, len(parts)), order="F")
    for i, part in enumerate(parts):
        out[..., i] = part
    return out


def by_blocks(
    work: Callable[..., Sequence[Any]], *columns: Floats, rest: tuple[int, ...] = ()
) -> Floats:
    """What `work` makes of the rows of arrays (N, k), in one new array (parts, *rest, N).

    work(*blocks)  takes the components of some rows of each array, as a tuple of k arrays (rows,).
                   It answers with a list of parts, each a number or an array that fits
                   (*rest, rows), or a pair of such, for the two places of the last axis of `rest`.

    Some thousand rows go through at a time: more would not stay in the processor's cache, and every
    step would wait for the memory, or ask the system for new pages.
    """
    count = len(columns[0])
    runs = [np.asfortranarray(column) for column in columns]
    out = None
    step = BLOCK // math.prod(rest)
    for start in range(0, max(count, 1), step):
        rows = slice(start, start + step)
        parts = work(*(components(run[rows]) for run in runs))
        if out is None:
            out = np.empty((len(parts), *rest, count))
        for i, part in enumerate(parts):
            if isinstance(part, tuple):
                for k, each in enumerate(part):
                    out[i, ..., k, rows] = each
            else:
                out[i, ..., rows] = part
    assert out is not None
    return out


def _seal(value: Any) -> None:
    """Make an array read-only, or all arrays of a tuple."""
    if isinstance(value, np.ndarray):
        sealed(value)
    elif isinstance(value, tuple):
        for part in value:
            _seal(part)
