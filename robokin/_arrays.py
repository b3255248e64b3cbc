"""Read-only arrays, their memory layout, and the computation of batches block by block.

NumPy is fastest on components: one contiguous array for all x, another for all y. The formulas of
this package work on components. Only this module makes the contiguous arrays and divides them into
blocks.
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
else:  # only type checkers need these, and numpy.typing is slow to import
    ArrayLike = Any
    Floats = Bools = Ints = np.ndarray

Array = TypeVar("Array", bound="NDArray[Any]")

BLOCK = 16_000  # numbers in one work array: 128 kB, which the memory allocator can reuse


def sealed(array: Array) -> Array:
    """Make this array read-only in place and return it. Nothing else may hold a reference to it."""
    array.setflags(write=False)
    return array


def frozen(array: Array) -> Array:
    """Return a read-only copy."""
    return sealed(array.copy())


class Sealed:
    """Base class of frozen dataclasses that have arrays or tuples of arrays as fields. The arrays
    of copies and of unpickled objects are read-only too, although NumPy does not copy this flag.
    """

    def __setstate__(self, state: dict[str, Any]) -> None:
        _seal(tuple(state.values()))
        vars(self).update(state)


def components(array: Floats) -> tuple[Any, ...]:
    """Split the last axis: (..., k) -> k arrays (...), but (k,) -> k plain numbers. Formulas run
    several times faster on plain numbers than on arrays of size one.
    """
    if array.ndim == 1:
        return tuple(array.tolist())
    return tuple(array[..., i] for i in range(array.shape[-1]))


def stack(parts: Sequence[Any]) -> Floats:
    """The inverse of `components`: broadcast k arrays or numbers and combine them into an array
    (..., k) in which each component is contiguous in memory.
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
    """Apply `work` to the rows of arrays (N, k), block by block; return one new array (parts,
    *rest, N).

    work(*blocks)  receives, for each array, the components of some of its rows as a tuple of k
                   arrays (rows,). It returns a list of parts. A part is a number, an array that
                   broadcasts to (*rest, rows), or a pair of these for the two entries of the last
                   axis of `rest`.

    A block has a few thousand rows. A larger block would not fit into the processor's cache, so
    each operation would wait for memory or request new pages from the operating system.
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
    """Make an array, or every array in a tuple, read-only."""
    if isinstance(value, np.ndarray):
        sealed(value)
    elif isinstance(value, tuple):
        for part in value:
            _seal(part)
