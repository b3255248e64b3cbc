"""Links: what a chain is made of."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from .._arrays import Floats, sealed
from .._validate import broadcast, floats, instance
from ..quaternion import Quaternion, half_angles, hamilton, turned, unit
from ..transform import Transform

# A frame on components, as the formulas of a chain take it: the rotation w, x, y, z and the origin
# x, y, z, each a number or an array of the batch.
Frame: TypeAlias = tuple[Sequence[Any], Sequence[Any]]
HERE = Transform()
BASE: Frame = ((1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


@dataclass(frozen=True, eq=False, init=False)
class Link:
    """One joint between two fixed transforms: the frame after it is
    `frame @ before @ motion @ after`.

    The motion is a turn about the unit vector `axis` or, if `prismatic`, a shift along it. A
    Denavit-Hartenberg row has its fixed part after the joint; listing 1 of source 001 has it
    before. ValueError: a batch of transforms, an axis that is not one unit vector.
    """

    before: Transform
    axis: Floats
    after: Transform
    prismatic: bool

    def __init__(
        self,
        before: Transform = HERE,
        axis: ArrayLike = (0.0, 0.0, 1.0),
        after: Transform = HERE,
        prismatic: bool = False,
    ) -> None:
        for part, name in ((before, "before"), (after, "after")):
            if instance(part, Transform, name).shape:
                raise ValueError(f"{name}: wanted one single Transform, got {part}")
        direction = floats(axis, "axis", 3)
        if direction.ndim != 1:
            raise ValueError(f"axis: wanted one unit vector, got shape {direction.shape}")
        object.__setattr__(self, "before", before)
        direction = sealed(unit(direction, "axis", "one unit vector"))
        object.__setattr__(self, "axis", direction)
        object.__setattr__(self, "after", after)
        object.__setattr__(self, "prismatic", instance(prismatic, bool, "prismatic"))
        # For the formulas: plain numbers, and None for a part that changes nothing.
        object.__setattr__(self, "_parts", (_plain(before), direction.tolist(), _plain(after)))

    def carry(self, frame: Frame, q: Floats) -> tuple[Frame, Frame]:
        """The joint's own frame and the frame after this link, from the frame before it and q (...)
        in radians, metres if prismatic; all frames on components (`BASE` to begin with).
        """
        before, axis, after = self._parts  # type: ignore[attr-defined]
        joint = rotation, origin = _step(frame, before)
        if self.prismatic:
            ahead = turned(rotation, axis)
            moved: Frame = rotation, [o + q * a for o, a in zip(origin, ahead, strict=True)]
        else:
            moved = hamilton(rotation, half_angles(q, axis)), origin
        return joint, _step(moved, after)


def dh_links(
    a: ArrayLike, alpha: ArrayLike, d: ArrayLike, theta: ArrayLike = 0.0
) -> tuple[Link, ...]:
    """Revolute links from a table of standard Denavit-Hartenberg parameters, each (n,): A = Rot(z,
    theta + q) Trans(0, 0, d) Trans(a, 0, 0) Rot(x, alpha). Metres and radians; `theta` is the
    offset of the joint.

    Source: 000, "Обзор источников"; 004, table 1. ValueError: columns that are not of one length.
    """
    columns = {"a": a, "alpha": alpha, "d": d, "theta": theta}
    table = [floats(column, name) for name, column in columns.items()]
    shape = broadcast("a, alpha, d and theta", *(column.shape for column in table))
    if len(shape) != 1 or shape[0] > 100:
        raise ValueError(f"a, alpha, d and theta: wanted columns (n,), got shape {shape}")
    lengths, twists, offsets, angles = np.broadcast_arrays(*table)
    turn = Transform(Quaternion.from_angle_axis(angles, (0, 0, 1)))
    shift = np.stack([lengths, np.zeros_like(lengths), offsets], axis=-1)
    rest = Transform(Quaternion.from_angle_axis(twists, (1, 0, 0)), shift)
    return tuple(Link(before, after=after) for before, after in zip(turn, rest, strict=True))


def chain(links: Iterable[Link]) -> tuple[Link, ...]:
    """`links` as a tuple. TypeError: something else among them; ValueError: none."""
    links = tuple(links) if isinstance(links, (list, tuple)) else (instance(links, tuple, "links"))
    if not links:
        raise ValueError("links: wanted at least one Link, got none")
    return tuple(instance(link, Link, f"links[{i}]") for i, link in enumerate(links))


def home(links: Sequence[Link]) -> tuple[list[Floats], list[Floats], Transform]:
    """A point on each joint's axis (n, 3), the axes (n, 3) and the flange, in base coordinates at
    q = 0.
    """
    frame, points, axes = Transform(), [], []
    for link in links:
        joint = frame @ link.before
        points.append(joint.translation)
        axes.append(joint.rotation @ link.axis)
        frame = joint @ link.after
    return points, axes, frame


def _step(frame: Frame, fixed: tuple[list[float] | None, list[float] | None]) -> Frame:
    """The frame after a fixed transform, given as plain numbers."""
    (rotation, origin), (turn, shift) = frame, fixed
    if shift is not None:
        origin = [o + s for o, s in zip(origin, turned(rotation, shift), strict=True)]
    return (rotation if turn is None else hamilton(rotation, turn)), origin


def _plain(fixed: Transform) -> tuple[list[float] | None, list[float] | None]:
    turn, shift = fixed.rotation.wxyz.tolist(), fixed.translation.tolist()
    return (None if turn == [1.0, 0.0, 0.0, 0.0] else turn), (shift if any(shift) else None)
