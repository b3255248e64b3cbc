"""An arm as data: a chain of links, a geometry that inverts it, and the limits of its joints."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .._validate import broadcast, floats, instance
from ..quaternion import Quaternion
from ..transform import Transform


@dataclass(frozen=True, eq=False)
class Link:
    """One joint between two fixed transforms: the frame after it is `frame @ before @ motion @
    after`.

    The motion is a turn about the unit vector `axis` or, if `prismatic`, a shift along it. A
    Denavit-Hartenberg row has its fixed part after the joint; listing 1 of source 001 has it
    before.
    """

    before: Transform = Transform()
    axis: tuple = (0.0, 0.0, 1.0)
    after: Transform = Transform()
    prismatic: bool = False

    def __post_init__(self):
        instance(self.before, Transform, "before")
        instance(self.after, Transform, "after")
        axis = floats(self.axis, "axis", 3)
        if axis.ndim != 1 or abs(np.linalg.norm(axis) - 1) > 1e-9:
            raise ValueError(
                f"axis: wanted one unit vector, got {axis} of length {np.linalg.norm(axis):.6g}"
            )

    def carry(self, frame, q):
        """The frame after this link, from the frame before it and q (...) in radians, metres if
        prismatic.
        """
        joint, axis = frame @ self.before, np.asarray(self.axis, dtype=float)
        if self.prismatic:
            moved = Transform._of(
                joint.rotation, joint.translation + q[..., None] * (joint.rotation @ axis)
            )
        else:
            moved = Transform._of(joint.rotation @ Quaternion._turn(q, axis), joint.translation)
        return moved @ self.after


def dh_links(a, alpha, d, theta=0.0):
    """Revolute links from a table of standard Denavit-Hartenberg parameters, each (n,): A = Rot(z,
    theta + q) Trans(0, 0, d) Trans(a, 0, 0) Rot(x, alpha). Metres and radians; `theta` is the
    offset of the joint.

    Source: 000, "Обзор источников"; 004, table 1. ValueError: columns of different length.
    """
    table = [
        floats(column, name)
        for column, name in ((a, "a"), (alpha, "alpha"), (d, "d"), (theta, "theta"))
    ]
    broadcast("a, alpha, d and theta", *(column.shape for column in table))
    a, alpha, d, theta = np.broadcast_arrays(*table)
    turn = Transform(Quaternion.from_angle_axis(theta, (0, 0, 1)))
    rest = Transform(
        Quaternion.from_angle_axis(alpha, (1, 0, 0)), np.stack([a, np.zeros_like(a), d], axis=-1)
    )
    return tuple(Link(before=before, after=after) for before, after in zip(turn, rest, strict=True))


@dataclass(frozen=True, eq=False, repr=False)
class Arm:
    """A robot arm with n joints. q (..., n) is in radians, metres for a prismatic joint.

    name           what a figure calls it
    links          n links, base to flange
    geometry       the closed-form inverse of the same links: has `branches`, `ik`, `unreached`,
                   `singular`, `settle`
    limits         (n, 2), lowest and highest value of each joint
    speed_limits   (n,), greatest speeds in rad/s or m/s, where known
    """

    name: str
    links: tuple
    geometry: object
    limits: np.ndarray
    speed_limits: np.ndarray | None = None

    def __post_init__(self):
        limits = floats(self.limits, "limits", 2)
        if limits.shape != (len(self.links), 2) or (limits[:, 0] >= limits[:, 1]).any():
            raise ValueError(
                f"limits: wanted {len(self.links)} pairs (lowest, highest), got {limits.tolist()}"
            )
        object.__setattr__(self, "limits", limits)
        if self.speed_limits is not None:
            speeds = floats(self.speed_limits, "speed_limits", len(self.links))
            if (speeds <= 0).any():
                raise ValueError(f"speed_limits: wanted positive numbers, got {speeds.tolist()}")
            object.__setattr__(self, "speed_limits", speeds)

    @cached_property
    def prismatic(self):
        """(n,) bool: which joints shift and do not turn."""
        return np.array([link.prismatic for link in self.links])

    @property
    def branches(self):
        """(rows, flags) of +-1: the configuration of every row of `ik`, in its order."""
        return self.geometry.branches

    def branch(self, *flags):
        """The row of `ik` that holds the configuration with these flags. ValueError: no such
        flags.
        """
        for row, wanted in enumerate(self.branches.tolist()):
            if wanted == list(flags):
                return row
        raise ValueError(
            f"{self.name}: wanted {self.branches.shape[1]} flags of +1 or -1, got {flags}"
        )

    def frames(self, q):
        """Every frame in base coordinates: base, the frame after each joint, the last one being the
        flange.

        q (..., n) -> Transform of shape (..., n + 1). A NaN in q makes that frame and those after
        it NaN.
        """
        frames = list(self._walk(q))
        return Transform._of(
            Quaternion._of(np.stack([f.rotation.wxyz for f in frames], axis=-2)),
            np.stack([f.translation for f in frames], axis=-2),
        )

    def fk(self, q):
        """The flange in base coordinates: q (..., n) -> Transform of shape (...). NaN rows give NaN
        poses.
        """
        *_, flange = self._walk(q)
        return flange

    def jacobian(self, q):
        """The geometric Jacobian at the flange in base coordinates: q (..., n) -> (..., 6, n).

        Rows 0..2: linear velocity in m per unit of joint speed; rows 3..5: angular velocity in rad.
        Source: Siciliano et al., Robotics, 2009, section 3.1.
        """
        frames = self.frames(q)
        tip = frames.translation[..., -1, :]
        columns = []
        for i, link in enumerate(self.links):
            joint = frames[..., i] @ link.before
            axis = joint.rotation @ np.asarray(link.axis, dtype=float)
            if link.prismatic:
                columns.append(np.concatenate([axis, np.zeros_like(axis)], axis=-1))
            else:
                columns.append(
                    np.concatenate([np.cross(axis, tip - joint.translation), axis], axis=-1)
                )
        return np.stack(columns, axis=-1)

    def ik(self, pose):
        """All joint values that bring the flange to `pose`: Transform of shape (...) -> (..., rows,
        n).

        Row k is always the configuration `branches[k]`. A row that does not exist is wholly NaN.
        Angles lie in [-pi, pi]; limits are ignored (see `within`, `nearest`). Where branches
        coincide the row is repeated.
        """
        return self.geometry.ik(pose)

    def _walk(self, q):
        """The frames one by one, base to flange."""
        frame = Transform.identity(np.shape(q)[:-1])
        yield frame
        for link, q_i in zip(self.links, np.moveaxis(self._joints(q), -1, 0), strict=True):
            frame = link.carry(frame, q_i)
            yield frame

    def _joints(self, q):
        return floats(q, "q", len(self.links), finite=False)

    def __repr__(self):
        return f"Arm({self.name!r}, {len(self.links)} joints)"
