"""Points and balls."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypedDict

import numpy as np

from ..._arrays import ArrayLike, Floats, Ints
from ..._validate import length
from ..checks import in_sight, plain
from .thing import PageReading, PageWay, Reading, Thing, Way, as_place, as_reading

if TYPE_CHECKING:
    from ..scene import Scene


class PageMark(TypedDict):
    """A point (radius 0) or a ball."""

    kind: Literal["mark"]
    name: str | PageReading
    radius: float
    at: list[float] | PageWay


@dataclass(frozen=True, init=False, eq=False)
class Mark(Thing):
    """A point, or a ball if it has a radius (m). A reading of shape (samples,), or with the leading
    axes of the motion, is written after the name.
    """

    at: Way
    name: str
    radius: float
    reading: Reading | None

    def __init__(
        self,
        at: ArrayLike | Way,
        name: str = "",
        radius: float | None = None,
        reading: ArrayLike | Reading | None = None,
    ) -> None:
        size = 0.0 if radius is None else length(radius, "radius")
        self.hold(
            at=as_place(at, "at"),
            name=plain(name, "name"),
            radius=float(in_sight(np.array(size), "radius")),
            reading=None if reading is None else as_reading(reading, "reading"),
        )

    def page(self, kept: Ints | None) -> PageMark:
        return {
            "kind": "mark",
            "name": self.reading.named(self.name, kept) if self.reading else self.name,
            "radius": self.radius,
            "at": self.at.page(kept),
        }

    def seen(self, axis: float) -> Floats:
        sides = self.radius * np.concatenate([np.eye(3), -np.eye(3)])
        return (self.at.rows[..., None, :] + sides).reshape(-1, 3)

    def draw(self, scene: "Scene", sample: int | None) -> None:
        at = self.at.at(sample)
        text = self.reading.after(self.name, sample) if self.reading else self.name
        scene.mark(at, self.radius)
        if text and np.isfinite(at).all():
            scene.label(text, at)
