"""SCARA arms, which have two links with parallel axes, a rotating tool and a vertical stroke. Their
inverse has two closed-form solutions.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .._arrays import ArrayLike, Bools, Floats, Sealed, components, sealed, stack
from .._validate import broadcast, floats, instance, length, number
from ..quaternion import Batch, Quaternion, rounded
from ..transform import Transform
from ..units import wrapped
from .arm import ClosedFormArm
from .geometry import FREE, SINGULAR, UPRIGHT, Gap, distance, flags, two_levers, worst
from .link import Link

X, Y, Z = np.eye(3)


@dataclass(frozen=True, init=False, repr=False, eq=False)
class ScaraPose(Batch):
    """A target of a SCARA: `position` (..., 3) in metres and the tool's `angle` (...) about the
    vertical. The arrays are read-only copies.

    The angle is in radians and not wrapped: from 0 to pi is half a turn to the left, from 0 to -pi
    half a turn to the right, and 3 pi is one and a half turns. As rotations, these are all the same
    (errata S1-t). Raises ValueError if a shape is wrong or a number is not finite. Source: 001,
    listings 4 and 12.

    >>> from robokin import ScaraPose
    >>> ScaraPose((0.2, 0.3, 0.1), 0.0).lerp(ScaraPose((0.4, 0.1, 0.1), 3.0), 0.5)
    ScaraPose(position=[0.3, 0.2, 0.1], angle=1.5)
    """

    position: Floats
    angle: Floats

    def __init__(self, position: ArrayLike, angle: ArrayLike = 0.0) -> None:
        place, turn = floats(position, "position", 3), floats(angle, "angle")
        shape = broadcast("position and angle", place.shape[:-1], turn.shape)
        copies = np.broadcast_to(place, (*shape, 3)).copy(), np.broadcast_to(turn, shape).copy()
        vars(self).update(position=sealed(copies[0]), angle=sealed(copies[1]))

    @property
    def shape(self) -> tuple[int, ...]:
        """The batch shape."""
        return self.angle.shape

    def __getitem__(self, index: Any) -> "ScaraPose":
        index = index if isinstance(index, tuple) else (index,)
        return ScaraPose(self.position[(*index, slice(None))], self.angle[index])

    def lerp(self, goal: "ScaraPose", s: ArrayLike) -> "ScaraPose":
        """Interpolate from this pose (s = 0) to `goal` (s = 1), linearly in position and angle; s
        (...) is broadcast.
        """
        instance(goal, ScaraPose, "goal")
        share = floats(s, "s")
        broadcast("start, goal and s", self.shape, goal.shape, share.shape)
        position = self.position + (goal.position - self.position) * share[..., None]
        return ScaraPose(position, self.angle + (goal.angle - self.angle) * share)

    def as_transform(self) -> Transform:
        """The pose of the flange. The tool's z axis always points up (errata S1-r)."""
        return Transform(Quaternion._turn(self.angle, Z), self.position)

    def __repr__(self) -> str:
        if self.shape:
            return f"ScaraPose(shape={self.shape})"
        return f"ScaraPose(position={rounded(self.position)}, angle={rounded(self.angle)})"


def scara_arm(
    name: str,
    height: float,
    upper: float,
    fore: float,
    limits: ArrayLike,
    speed_limits: ArrayLike | None = None,
) -> ClosedFormArm:
    """A SCARA arm. Joints 1 to 3 turn about vertical axes, and joint 4 lowers the tool from
    `height`. Lengths are in metres.

    At q = 0, the arm is fully extended along x, with the tool at `height`. `ik` takes a ScaraPose
    or a Transform. Source: 001, listings 4 and 12. Raises ValueError if the length of a link is not
    one positive number.
    """
    return ClosedFormArm(name, ScaraGeometry(height, upper, fore), limits, speed_limits)


@dataclass(frozen=True, repr=False, eq=False)
class ScaraGeometry(Sealed):
    """The links of a SCARA and their inverse (see `scara_arm`). The configuration flag is the sign
    of joint 2. Angles are in [-pi, pi].

    Source: 001, listing 4, with errata S1-o (the other elbow, rounding) corrected.
    """

    branches = flags(1)
    target = ScaraPose
    carried = "the target"
    height: float
    upper: float
    fore: float
    reach: float = field(init=False)
    links: tuple[Link, ...] = field(init=False)

    def __post_init__(self) -> None:
        level = number(self.height, "height", "one number, in metres")
        upper, fore = length(self.upper, "upper"), length(self.fore, "fore")
        links = (
            Link(Transform(translation=(0, 0, level)), Z),
            Link(Transform(translation=(upper, 0, 0)), Z),
            Link(Transform(translation=(fore, 0, 0)), Z),
            Link(axis=-Z, prismatic=True),
        )
        vars(self).update(height=level, upper=upper, fore=fore, reach=upper + fore, links=links)

    def ik(self, pose: Any) -> Floats:
        """See `ClosedFormArm.ik`: ScaraPose or Transform of shape (...) -> (..., 2, 4). A pose with
        a tilted tool is out of reach.
        """
        position, angle, tilt = _parts(pose)
        x, y, z = components(position[..., None, :])
        ahead, turn, exists = two_levers(self.upper, self.fore, distance(x, y))
        elbow = self.branches[:, 0]
        q1, q2 = np.arctan2(y, x) - elbow * ahead, elbow * turn + 0.0  # -0.0 becomes 0
        q3 = angle[..., None] - q1 - q2
        q = stack([wrapped(q1), q2, wrapped(q3), self.height - z])
        reached = exists & (tilt < UPRIGHT)[..., None]
        return np.where(reached[..., None], q, np.nan)

    def gap(self, pose: Any, row: int) -> Gap:
        """The reason why a single pose has no solution in this row."""
        position, _, tilt = _parts(pose)
        if tilt >= UPRIGHT:
            return Gap("tilted", 0.0, self.carried, float(np.rad2deg(tilt)))
        r, borders = np.hypot(*position[:2]), (self.upper + self.fore, abs(self.upper - self.fore))
        return worst({"stretched": r - borders[0], "axis": borders[1] - r}, self.carried)

    def singularities(self, q: Floats) -> dict[str, Bools]:
        """Return whether each singularity occurs at q (..., 4), within 1e-6 rad."""
        return {"elbow": abs(np.sin(q[..., 1])) < SINGULAR}

    def choose_free_joints(self, q: Floats, previous: Floats) -> Floats:
        """Return rows q (..., 4) unchanged, except where equal links are folded onto axis 1. There,
        joint 1 has its value from `previous`, and joint 3 compensates.
        """
        equal = abs(self.upper - self.fore) <= FREE * self.reach
        free = (abs(np.cos(q[..., 1] / 2)) < FREE) & equal
        if not free.any():
            return q
        back = np.where(free, q[..., 0] - previous[..., 0], 0.0)
        return np.stack([q[..., 0] - back, q[..., 1], q[..., 2] + back, q[..., 3]], axis=-1)


def _parts(pose: Any) -> tuple[Floats, Floats, Floats]:
    """The position, the angle about the vertical, and the tilt from the vertical, in radians."""
    if isinstance(pose, ScaraPose):
        return pose.position, pose.angle, np.zeros(pose.shape)
    hint = " (a SCARA takes a ScaraPose or a Transform)"
    instance(pose, Transform, "pose", hint=hint)
    w, x, y, z = np.moveaxis(pose.rotation.wxyz, -1, 0)
    tilt = 2 * np.arctan2(np.hypot(x, y), np.hypot(w, z))
    return pose.translation, 2 * np.arctan2(z, w), tilt
