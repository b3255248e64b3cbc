"""Read-only arrays, the memory layout of numbers, and the blocks in which a batch is computed.

NumPy is fastest on components: one contiguous array for all x, another for all y. The formulas of
this package work on components. Only this module makes the contiguous arrays and cuts them into
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

BLOCK = 16_000  # numbers in one work array: 128 kB, which the memory allocator keeps for reuse


def sealed(array: Array) -> Array:
    """Make this array read-only in place and return it. Nothing else may hold a reference to it."""
    array.setflags(write=False)
    return array


def frozen(array: Array) -> Array:
    """Return a read-only copy."""
    return sealed(array.copy())


class Sealed:
    """Base class of frozen dataclasses that hold arrays, directly or in tuples. Copies and
    unpickled objects are read-only too, although NumPy does not copy the flag.
    """

    def __setstate__(self, state: dict[str, Any]) -> None:
        _seal(tuple(state.values()))
        vars(self).update(state)


def components(array: Floats) -> tuple[Any, ...]:
    """Split the last axis: (..., k) -> k arrays (...); (k,) -> k plain numbers, with which the same
    formulas run several times faster than with arrays of size one.
    """
    if array.ndim == 1:
        return tuple(array.tolist())
    return tuple(array[..., i] for i in range(array.shape[-1]))


def stack(parts: Sequence[Any]) -> Floats:
    """The inverse of `components`: k arrays or numbers, broadcast, -> (..., k), each component
    contiguous in memory.
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

    work(*blocks)  takes the components of some rows of each array, as a tuple of k arrays (rows,).
                   It returns a list of parts. A part is a number, an array that broadcasts to
                   (*rest, rows), or a pair of these for the two entries of the last axis of `rest`.

    A block has a few thousand rows. A larger one would not fit into the processor's cache, and
    every step would wait for memory or ask the system for new pages.
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
