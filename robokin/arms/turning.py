"""Three levers on a base that turns: points in space.

Source 003 works in the plane and leaves the third axis to one motor between manipulator and ground,
which turns the plane of the levers about the vertical (II.2). That motor asks for no new inverse:
its angle is a direction, and what is left is the planar arm.
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
    """The arm on a turning base, q = (turn, gamma, beta, alpha): joint 1 turns the plane of the
    levers about the z axis of the base, which points up; at 0 the levers' x axis is that of the
    base, and their y axis always points up. The turn goes from -180 to 180 degrees.

    Source: 003, II.2. TypeError: another arm.
    """
    limits = np.concatenate([[(-180 * deg, 180 * deg)], instance(arm, ThreeLeverArm, "arm").limits])
    return TurningLeverArm(f"{arm.name} on a turning base", TurningLeverGeometry(arm), limits)


@dataclass(frozen=True, repr=False, eq=False)
class TurningLeverGeometry(Sealed):
    """The links of `turning_base`, and the arm `plane` that turns. No inverse, as there."""

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
        """The two turns that bring the plane of the levers through the points, (..., 2), and where
        the planar arm sees them then, (..., 2, 2): in front of its base, and, half a turn on,
        behind it. On the axis every turn does; here 0 and half a turn.
        """
        x, y, z = np.moveaxis(floats(point, "point", 3), -1, 0)
        r, turn = distance(x, y), np.arctan2(y + 0.0, x + 0.0)  # -0.0 is 0
        places = np.stack([np.stack([r, z], axis=-1), np.stack([-r, z], axis=-1)], axis=-2)
        return wrapped(np.stack([turn, turn + np.pi], axis=-1)), places

    def least(self, point: ArrayLike, previous: ArrayLike) -> tuple[Floats, Floats]:
        """The posture within the limits at the points (..., 3) with the smallest sum S of all four
        angles' changes from previous (..., 4): (..., 4) and (...), NaN where there is none.

        Of both turns the better one; on the axis the base stays as it is.
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
