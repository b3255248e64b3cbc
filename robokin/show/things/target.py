"""Target frames: the poses that an arm should reach."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypedDict

import numpy as np

from ..._arrays import Floats, Ints
from ..._validate import floats, instance
from ...transform import Transform
from ..checks import in_sight, plain
from .thing import PageWay, Thing, Way, moving

if TYPE_CHECKING:
    from ..scene import Scene


class PageTarget(TypedDict):
    """A named pose."""

    kind: Literal["target"]
    name: str
    pose: list[float] | PageWay


@dataclass(frozen=True, init=False, eq=False)
class Target(Thing):
    """A named pose. The shape of a moving pose is (samples,), or the leading axes of the motion and
    then the samples. A page draws the straight route between targets called start, via and goal,
    and shows how near the path comes to via.
    """

    name: str
    pose: Transform
    way: Way

    def __init__(self, pose: Transform, name: str) -> None:
        called = f"target {plain(name, 'name')}"
        places = in_sight(instance(pose, Transform, called).translation, called)
        floats(places, called, finite=not pose.shape)
        rows = pose.as_matrix()[..., :3, :].reshape(*pose.shape, 12)
        way = moving(rows, called) if pose.shape else Way(rows[None, None], (), called)
        self.hold(name=plain(name, "name"), pose=pose, way=way)

    def page(self, kept: Ints | None) -> PageTarget:
        return {"kind": "target", "name": self.name, "pose": self.way.page(kept)}

    def seen(self, axis: float) -> Floats:
        return (self.pose[..., None] @ np.vstack([np.zeros(3), axis * np.eye(3)])).reshape(-1, 3)

    def draw(self, scene: "Scene", sample: int | None) -> None:
        pose = self.pose
        if pose.shape:
            pose = pose[(0,) * (len(pose.shape) - 1) + (sample if pose.shape[-1] > 1 else 0,)]
        scene.triad(pose, self.name)
