"""Polygons behind the arms, such as a conveyor belt."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypedDict

import numpy as np

from ..._arrays import ArrayLike, Floats, Ints, frozen
from ..._validate import floats, short
from ..checks import in_sight, several
from ..numbers import rounded
from .thing import Thing

if TYPE_CHECKING:
    from ..scene import Scene


class PageFaces(TypedDict):
    """The corners (x, y, z) of each polygon."""

    kind: Literal["faces"]
    corners: list[list[list[float]]]


@dataclass(frozen=True, init=False, eq=False)
class Faces(Thing):
    """Fixed polygons, each with 3 to 100 corners (k, 3) in metres."""

    corners: tuple[Floats, ...]

    def __init__(self, faces: Iterable[ArrayLike]) -> None:
        found = []
        for face in several(faces, "faces", "a list of polygons"):
            corners = in_sight(floats(face, "faces", 3), "faces")
            if corners.ndim != 2 or not 3 <= len(corners) <= 100:
                raise ValueError(f"faces: wanted 3 to 100 corners (x, y, z), got {short(face)}")
            found.append(frozen(corners))
        self.hold(corners=tuple(found))

    def page(self, kept: Ints | None) -> PageFaces:
        corners = [[rounded(corner, 4) for corner in face] for face in self.corners]
        return {"kind": "faces", "corners": corners}

    def seen(self, axis: float) -> Floats:
        return np.concatenate([np.empty((0, 3)), *self.corners])

    def draw(self, scene: "Scene", sample: int | None) -> None:
        scene.faces(self.corners)
