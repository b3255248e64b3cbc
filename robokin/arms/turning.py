"""Three levers on a turning base, which reach points in space.

Source 003 works in the plane and adds the third dimension with one motor between the manipulator
and the ground, which turns the plane of the levers about the vertical (II.2). This motor needs no
new inverse: its angle is the direction of the point, and the planar arm does the rest.
"""

from dataclasses import dataclass, field

import numpy as np

from .._arrays import ArrayLike, Floats, Sealed
from .._validate import broadcast, floats, instance, warn_if_degrees
from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, wrapped
from .arm import Arm
from .geometry import distance
from .link import Link
from .planar import ThreeLeverArm

X = np.array([1.0, 0.0, 0.0])


def turning_base(arm: ThreeLeverArm) -> "TurningLeverArm":
    """The arm on a turning base, q = (turn, gamma, beta, alpha). Joint 1 turns the plane of the
    levers about the z axis of the base, which points up. When joint 1 is 0, the x axis of the
    levers is that of the base; their y axis always points up. Joint 1 ranges from -180 to 180
    degrees.

    Source: 003, II.2. Raises TypeError if `arm` is not a ThreeLeverArm.
    """
    limits = np.concatenate([[(-180 * deg, 180 * deg)], instance(arm, ThreeLeverArm, "arm").limits])
    return TurningLeverArm(f"{arm.name} on a turning base", TurningLeverGeometry(arm), limits)


@dataclass(frozen=True, repr=False, eq=False)
class TurningLeverGeometry(Sealed):
    """The links of an arm on a turning base, and its planar arm `plane`. There is no inverse."""

    target = np.ndarray
    plane: ThreeLeverArm
    reach: float = field(init=False)
    links: tuple[Link, ...] = field(init=False)

    def __post_init__(self) -> None:
        upright = Transform(Quaternion.from_angle_axis(90 * deg, X))
        links = (Link(), Link(upright), *self.plane.links[1:])
        vars(self).update(reach=self.plane.reach, links=links)


@dataclass(frozen=True, init=False, repr=False, eq=False)
class TurningLeverArm(Arm):
    """An arm of three levers on a turning base (see `turning_base`). Points are (..., 3)."""

    geometry: TurningLeverGeometry

    def seen(self, point: ArrayLike) -> tuple[Floats, Floats]:
        """The two angles of joint 1 (..., 2) at which the plane of the levers contains the points,
        and the coordinates of the points in that plane (..., 2, 2). At the first angle, the points
        are in front of the base; at the second, half a turn further, they are behind it. For a
        point on the axis, every angle is possible; we take 0 and half a turn.
        """
        x, y, z = np.moveaxis(floats(point, "point", 3), -1, 0)
        r, turn = distance(x, y), np.arctan2(y + 0.0, x + 0.0)  # -0.0 becomes 0
        places = np.stack([np.stack([r, z], axis=-1), np.stack([-r, z], axis=-1)], axis=-2)
        return wrapped(np.stack([turn, turn + np.pi], axis=-1)), places

    def least(self, point: ArrayLike, previous: ArrayLike) -> tuple[Floats, Floats]:
        """The posture within the limits at the points (..., 3) with the smallest sum S of the four
        absolute angle changes from previous (..., 4): (..., 4) and (...), NaN where there is none.

        We choose the better of the two angles of joint 1. For a point on the axis, the base does
        not turn.
        """
        before = floats(previous, "previous", 4)
        warn_if_degrees(before, "previous", posture=1)
        turns, places = self.seen(point)
        broadcast("point and previous", turns.shape[:-1], before.shape[:-1])
        on_axis = (places[..., 0] == 0).all(axis=-1)[..., None]
        turns = np.where(on_axis, before[..., None, 0], turns)
        q, S = self.geometry.plane.least(places, before[..., None, 1:])
        S = S + abs(turns - before[..., None, 0])
        q = np.concatenate([np.broadcast_to(turns, S.shape)[..., None], q], axis=-1)
        q = np.where(np.isnan(S)[..., None], np.nan, q)
        best = np.where(np.isnan(S), np.inf, S).argmin(axis=-1)[..., None]
        return (
            np.take_along_axis(q, best[..., None], axis=-2)[..., 0, :],
            np.take_along_axis(S, best, axis=-1)[..., 0],
        )
