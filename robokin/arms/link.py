"""Links: the elements of a chain."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from .._arrays import ArrayLike, Bools, Floats, Sealed, sealed
from .._validate import bools, broadcast, floats, instance
from ..quaternion import Quaternion, along, half_angles, hamilton, spun, turned, unit
from ..transform import Transform

# A frame as the components that the formulas of a chain use: rotation w, x, y, z and origin x, y,
# z, each a number or an array over the batch.
Frame: TypeAlias = tuple[Sequence[Any], Sequence[Any]]
HERE = Transform()
BASE: Frame = ((1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


@dataclass(frozen=True, init=False, eq=False)
class Link(Sealed):
    """One joint between two constant transforms: the frame after the link is `frame @ before @
    motion @ after`.

    The motion is a rotation about the unit vector `axis` or, if `prismatic`, a translation along
    it. A Denavit-Hartenberg row has its constant part after the joint; listing 1 of source 001 has
    it before. Raises ValueError if a transform is a batch or the axis is not a single unit vector.
    """

    before: Transform
    axis: Floats
    after: Transform
    prismatic: bool
    _parts: "tuple[_Still, tuple[int | None, float], _Still]" = field(init=False, repr=False)

    def __init__(
        self,
        before: Transform = HERE,
        axis: ArrayLike = (0.0, 0.0, 1.0),
        after: Transform = HERE,
        prismatic: bool = False,
    ) -> None:
        for part, name in ((before, "before"), (after, "after")):
            if instance(part, Transform, name).shape:
                raise ValueError(f"{name}: wanted a single Transform, got {part}")
        direction = floats(axis, "axis", 3)
        if direction.ndim != 1:
            raise ValueError(f"axis: wanted one unit vector, got shape {direction.shape}")
        direction = sealed(unit(direction, "axis", "one unit vector"))
        instance(prismatic, bool, "prismatic")
        vars(self).update(before=before, axis=direction, after=after, prismatic=prismatic)
        vars(self)["_parts"] = _Still.of(before), _coordinate(direction), _Still.of(after)

    def _carry(self, frame: Frame, q: Any) -> tuple[Frame, Frame]:
        """Return the frame of the joint and the frame after this link, given the frame before the
        link and q (...), in radians, or in metres if prismatic. All frames are given as components;
        the first one is `BASE`.
        """
        before, (axis, sign), after = self._parts
        joint = rotation, origin = before.step(frame)
        if self.prismatic:
            ahead = turned(rotation, self.axis.tolist())
            moved: Frame = rotation, [o + q * a for o, a in zip(origin, ahead, strict=True)]
        elif axis is None:
            moved = hamilton(rotation, half_angles(q, self.axis.tolist())), origin
        else:
            half = (0.5 * sign) * q
            moved = spun(rotation, axis, np.cos(half), np.sin(half)), origin
        return joint, after.step(moved)


def dh_links(
    a: ArrayLike,
    alpha: ArrayLike,
    d: ArrayLike,
    theta: ArrayLike = 0.0,
    prismatic: bool | Sequence[bool] | Bools = False,
    modified: bool = False,
) -> tuple[Link, ...]:
    """Links from a table of Denavit-Hartenberg parameters, each (n,), in metres and radians. A link
    is A = Rot(z, theta) Trans(0, 0, d) Trans(a, 0, 0) Rot(x, alpha).

    prismatic  one bool or (n,): q is added to `d` where it is True, to `theta` where it is False
    modified   True if the table follows Craig's convention, in which a row has a and alpha of the
               link before its joint, and A = Rot(x, alpha) Trans(a, 0, 0) Rot(z, theta) Trans(0, 0,
               d)

    Source: 000, "Обзор источников"; 004, table 1; Craig, Introduction to Robotics, section 3.5.
    Raises ValueError if the columns have different lengths or `prismatic` is neither True nor
    False.

    >>> from robokin import dh_links
    >>> len(dh_links(a=[0, 0.4], alpha=[0.5 * np.pi, 0], d=0))
    2
    """
    columns = {"a": a, "alpha": alpha, "d": d, "theta": theta}
    table = [floats(column, name) for name, column in columns.items()]
    shifting = bools(prismatic, "prismatic")
    named = f"{', '.join(columns)} and prismatic"
    shape = broadcast(named, *(column.shape for column in table), shifting.shape)
    if len(shape) != 1 or shape[0] > 100:
        raise ValueError(f"{named}: wanted columns (n,), got shape {shape}")
    lengths, twists, offsets, angles = (np.broadcast_to(column, shape) for column in table)
    turn, zero = Quaternion.from_angle_axis(angles, (0, 0, 1)), np.zeros(shape)
    tilt = Quaternion.from_angle_axis(twists, (1, 0, 0))
    if instance(modified, bool, "modified"):
        before = Transform(tilt, np.stack([lengths, zero, zero], axis=-1)) @ Transform(turn)
        after = Transform(translation=np.stack([zero, zero, offsets], axis=-1))
    else:
        before = Transform(turn)
        after = Transform(tilt, np.stack([lengths, zero, offsets], axis=-1))
    joints = zip(before, after, np.broadcast_to(shifting, shape).tolist(), strict=True)
    return tuple(Link(start, after=end, prismatic=shifts) for start, end, shifts in joints)


def chain(links: Iterable[Link]) -> tuple[Link, ...]:
    """Return `links` as a tuple. Raises TypeError if an item is not a Link, and ValueError if there
    are no links.
    """
    links = tuple(links) if isinstance(links, (list, tuple)) else (instance(links, tuple, "links"))
    if not links:
        raise ValueError("links: wanted at least one Link, got none")
    return tuple(instance(link, Link, f"links[{i}]") for i, link in enumerate(links))


def home(links: Sequence[Link]) -> tuple[Floats, Floats, Transform]:
    """A point on each joint's axis (n, 3), the directions of the axes (n, 3), and the pose of the
    flange, in base coordinates at q = 0.
    """
    frame, points, axes = BASE, [], []
    for link in links:
        (rotation, origin), frame = link._carry(frame, 0.0)
        points.append(origin)
        axes.append(turned(rotation, link.axis.tolist()))
    return np.array(points), np.array(axes), Transform(Quaternion(frame[0]), frame[1])


class _Still(NamedTuple):
    """A constant transform in as few steps as possible: translations (axis, length) along
    coordinate axes, then at most one rotation, which is about a coordinate axis or given by a
    quaternion w, x, y, z.
    """

    shifts: tuple[tuple[int, float], ...]
    axes: tuple[int, ...]
    turn: tuple[float, ...]

    @classmethod
    def of(cls, transform: Transform) -> "_Still":
        turn = tuple(transform.rotation.wxyz.tolist())
        shifts = tuple((k, x) for k, x in enumerate(transform.translation.tolist()) if x)
        return cls(shifts, tuple(k for k in range(3) if turn[k + 1]), turn)

    def step(self, frame: Frame) -> Frame:
        """The frame after this transform."""
        rotation, origin = frame
        for k, length in self.shifts:
            shift = along(rotation, k, length)
            origin = [o + s for o, s in zip(origin, shift, strict=True)]
        if len(self.axes) > 1:
            rotation = hamilton(rotation, self.turn)
        for k in self.axes if len(self.axes) == 1 else ():
            rotation = spun(rotation, k, self.turn[0], self.turn[k + 1])
        return rotation, origin


def _coordinate(axis: Floats) -> tuple[int | None, float]:
    """The index of the coordinate axis parallel to `axis` (None if there is none) and the sign."""
    k = int(abs(axis).argmax())
    return (k, float(axis[k])) if abs(axis[k]) == 1 else (None, 1.0)
