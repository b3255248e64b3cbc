"""The base class of all kinds of things, and numbers that may change during a motion."""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..._arrays import ArrayLike, Floats, Ints, Sealed, frozen
from ..._validate import floats
from ..checks import HORIZON, in_sight
from ..numbers import Packed, fewest, packed, rounded

if TYPE_CHECKING:
    from ..scene import Scene
    from . import PageThing


class PageWay(Packed):
    """Numbers in k columns that may change. `motions` or `samples` is 1 if all motions or all
    samples have the same numbers. A thing is not drawn while one of its numbers is NaN.
    """

    motions: int
    samples: int


class PageReading(PageWay):
    """A name followed by a number, which keeps its value until the next sample; with NaN only the
    name is shown.
    """

    name: str
    decimals: int


@dataclass(frozen=True, eq=False)
class Way(Sealed):
    """Numbers that are constant or change.

    rows   (motions or 1, samples or 1, k); NaN where the thing is missing
    shape  the leading axes of the argument: () for constant numbers
    name   the name of the numbers in error messages
    last   the last axis of the argument, which error messages add to the shape
    """

    rows: Floats
    shape: tuple[int, ...]
    name: str
    last: tuple[int, ...] = ()

    def at(self, sample: int | None) -> Floats:
        """Return the k numbers at a sample of the first motion."""
        one: Floats = self.rows[0, sample if sample and self.rows.shape[1] > 1 else 0]
        return one

    def page(self, kept: Ints | None) -> list[float] | PageWay:
        """Return the page data; `kept` contains the indices of the samples in the page."""
        return self._packed(kept) if self.shape else rounded(self.rows)

    def fit(self, lead: tuple[int, ...], count: int) -> None:
        """Check the shape. Raises ValueError if it does not fit motions of shape `lead` with
        `count` samples.
        """
        wanted = dict.fromkeys([(count,), (*lead, count), (*lead, 1)])
        if self.shape and self.shape not in wanted:
            shapes = " or ".join(str((*one, *self.last)) for one in wanted)
            got = (*self.shape, *self.last)
            raise ValueError(f"{self.name}: wanted shape {shapes}, got {got}")

    def _packed(self, kept: Ints | None) -> PageWay:
        rows = self.rows[:, kept] if self.rows.shape[1] > 1 else self.rows
        return {**packed(rows, 8000), "motions": len(rows), "samples": rows.shape[1]}


class Reading(Way):
    """Numbers to show after a name, one at a time."""

    def named(self, name: str, kept: Ints | None) -> PageReading:
        """Return the page data of a thing with this name."""
        return {**self._packed(kept), "name": name, "decimals": fewest(self.rows)}

    def after(self, name: str, sample: int | None) -> str:
        """Return `name` and the number at a sample, or only the name if there is no number."""
        value = np.nan if sample is None else self.at(sample)[0]
        return name if np.isnan(value) else f"{name}: {value:.{fewest(self.rows)}f}"


class Thing(ABC):
    """A thing in a scene. Each kind is a frozen dataclass that checks its arguments."""

    @abstractmethod
    def page(self, kept: Ints | None) -> "PageThing":
        """Return the page data; `kept` contains the indices of the samples of moving values in the
        page.
        """

    @abstractmethod
    def seen(self, axis: float) -> Floats:
        """Return points (k, 3) of the whole motion that must be visible; NaN is ignored. `axis` is
        the length (m) of the axes of frames. (In a script, `seen` returns the points at one moment,
        and only scenes that grow call it.)
        """

    @abstractmethod
    def draw(self, scene: "Scene", sample: int | None) -> None:
        """Draw the thing into a figure; draw nothing if its place is NaN. (A page leaves out such
        a thing before it calls the script.)

        sample  an index into the samples of the first motion: -1 in the still picture; in a film,
                that of the frame, or None for a thing that does not move
        """

    @property
    def moves(self) -> bool:
        """Return whether the place of the thing depends on the motion."""
        return any(way.shape for way in self._ways() if not isinstance(way, Reading))

    def fit(self, lead: tuple[int, ...], count: int) -> None:
        """Check the shapes. Raises ValueError if one of them does not fit motions of shape `lead`
        with `count` samples.
        """
        for way in self._ways():
            way.fit(lead, count)

    def hold(self, **fields: Any) -> None:
        """Set the fields of the frozen dataclass."""
        vars(self).update(fields)

    def _ways(self) -> list[Way]:
        return [value for value in vars(self).values() if isinstance(value, Way)]


def as_place(value: ArrayLike | Way, name: str) -> Way:
    """Return places (..., 3) in metres, or one place (2,) or (3,), as a `Way`. Raises ValueError if
    the shape is another one, or if a number is infinite.
    """
    if isinstance(value, Way):
        return value
    given = floats(value, name, finite=False)
    if given.ndim > 1 and given.shape[-1] == 3:
        return moving(in_sight(given, name), name, (3,))
    if given.shape not in ((2,), (3,)):
        raise ValueError(f"{name}: wanted points of shape (..., 3), got shape {given.shape}")
    point = in_sight(np.append(floats(given, name), [0.0] * (3 - len(given))), name)
    return Way(frozen(point[None, None]), (), name, (3,))


def as_reading(value: ArrayLike | Reading, name: str) -> Reading:
    """Return numbers (...) to show as a `Reading`. Raises ValueError if a number is too large."""
    if isinstance(value, Reading):
        return value
    given = np.atleast_1d(floats(value, name, finite=False))
    if (abs(given) > HORIZON).any():
        raise ValueError(f"{name}: wanted numbers up to {HORIZON:g}")
    return Reading(_flat(given[..., None]), given.shape, name)


def moving(given: Floats, name: str, last: tuple[int, ...] = ()) -> Way:
    """Return numbers (..., samples, k) as a `Way`."""
    return Way(_flat(given), given.shape[:-1], name, last)


def _flat(given: Floats) -> Floats:
    """Return numbers (..., samples, k) with all motions along one axis."""
    return frozen(given.reshape(math.prod(given.shape[:-2]), *given.shape[-2:]))
