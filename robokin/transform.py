"""Rigid transforms: a rotation and a translation, one or a whole batch of them.

`T_base_tool` gives the tool's frame in base coordinates. `T_base_tool @ T_tool_part` composes, and
`T_base_tool @ points` converts points (..., 3) from tool coordinates to base coordinates. Lengths
are in metres and angles in radians.
"""

from dataclasses import dataclass
from typing import Any, overload

import numpy as np

from ._arrays import ArrayLike, Floats, components, sealed, stack
from ._validate import AXES, broadcast, floats, instance, selected, shape_of
from .quaternion import Batch, Quaternion, rounded

HERE = Quaternion.identity()


@dataclass(frozen=True, init=False, repr=False, eq=False)
class Transform(Batch):
    """A pose or a change of frame: `rotation` first, then `translation` (..., 3) in metres.

    Either part may be omitted. A batch of poses acts on a batch of points by broadcasting: `T[:,
    None] @ points`. The arrays are read-only copies. Raises ValueError if a shape is wrong or a
    number is not finite. Source: 001, all listings, which write `+` for `@`; 000, the homogeneous
    matrices.

    >>> ahead = Transform(translation=(1, 0, 0))
    >>> left = Transform(Quaternion.from_angle_axis(np.pi / 2, (0, 0, 1)))
    >>> (left @ ahead).translation.round(3)
    array([0., 1., 0.])
    """

    rotation: Quaternion
    translation: Floats

    def __init__(
        self, rotation: Quaternion = HERE, translation: ArrayLike = (0.0, 0.0, 0.0)
    ) -> None:
        instance(rotation, Quaternion, "rotation")
        place = floats(translation, "translation", 3)
        shape = broadcast("rotation and translation", rotation.shape, place.shape[:-1])
        if rotation.shape != shape:
            rotation = Quaternion._of(np.broadcast_to(rotation.wxyz, (*shape, 4)))
        copy = np.broadcast_to(place, (*shape, 3)).copy()
        vars(self).update(rotation=rotation, translation=sealed(copy))

    @classmethod
    def _of(cls, rotation: Quaternion, translation: Floats) -> "Transform":
        """Make a Transform from parts with the same batch shape, without checks; NaN rows are
        accepted.
        """
        translation.setflags(write=False)  # without `sealed`, as in Quaternion._of
        self = object.__new__(cls)
        fields = self.__dict__
        fields["rotation"], fields["translation"] = rotation, translation
        return self

    @classmethod
    def identity(cls, shape: tuple[int, ...] = ()) -> "Transform":
        """The identity, with this batch shape."""
        place = np.broadcast_to(np.zeros(3), (*shape_of(shape, "shape"), 3))
        return cls._of(Quaternion.identity(shape), place)

    @classmethod
    def from_matrix(cls, matrix: ArrayLike) -> "Transform":
        """The transforms of homogeneous matrices (..., 4, 4). Raises ValueError if the upper left
        part is not a rotation to within 1e-6 or the last row is not 0 0 0 1.
        """
        m = floats(matrix, "matrix", 4)
        if m.ndim < 2 or m.shape[-2] != 4:
            raise ValueError(f"matrix: wanted shape (..., 4, 4), got {m.shape}")
        if (abs(m[..., 3, :] - [0, 0, 0, 1]) > 1e-9).any():
            last = m[..., 3, :].reshape(-1, 4)[0]
            raise ValueError(f"matrix: wanted 0 0 0 1 as the last row, got {last}")
        return cls._of(Quaternion.from_matrix(m[..., :3, :3]), m[..., :3, 3].copy())

    def as_matrix(self) -> Floats:
        """Homogeneous matrices (..., 4, 4)."""
        m = np.zeros((*self.shape, 4, 4))
        m[..., :3, :3] = self.rotation.as_matrix()
        m[..., :3, 3] = self.translation
        m[..., 3, 3] = 1
        return m

    @property
    def shape(self) -> tuple[int, ...]:
        """The batch shape."""
        return self.translation.shape[:-1]

    def __getitem__(self, index: Any) -> "Transform":
        whole = (*index, slice(None)) if isinstance(index, tuple) else (index, slice(None))
        place = self.translation[whole]
        if place.ndim > AXES:  # a call for every pose would take a tenth of the time
            selected(place)
        return Transform._of(Quaternion._of(self.rotation.wxyz[whole]), place)

    @overload
    def __matmul__(self, other: "Transform") -> "Transform": ...
    @overload
    def __matmul__(self, other: ArrayLike) -> Floats: ...
    def __matmul__(self, other: Any) -> Any:
        if isinstance(other, Transform):
            rotation = self.rotation @ other.rotation
            return Transform._of(rotation, self.rotation @ other.translation + self.translation)
        if isinstance(other, Batch):
            return NotImplemented
        return self.rotation @ other + self.translation

    def inverse(self) -> "Transform":
        """The inverse change of frame: [R^T, -R^T p]. Source: 000, "Обратная задача"."""
        back = self.rotation.inverse()
        return Transform._of(back, -(back @ self.translation))

    def lerp(self, goal: "Transform", s: ArrayLike) -> "Transform":
        """Interpolate from this pose (s = 0) to `goal` (s = 1): the origin moves on a straight
        line, and the rotation follows `Quaternion.slerp`. `s` (...) is broadcast against both;
        outside [0, 1] the motion continues. Source: 001, listing 7 (`Transform.lerp`).
        """
        instance(goal, Transform, "goal")
        share = floats(s, "s")
        rotation = self.rotation.slerp(goal.rotation, share)
        ends = zip(components(self.translation), components(goal.translation), strict=True)
        return Transform._of(rotation, stack([a + (b - a) * share for a, b in ends]))

    def __repr__(self) -> str:
        if self.shape:
            return f"Transform(shape={self.shape})"
        place = rounded(self.translation)
        return f"Transform(rotation={rounded(self.rotation.wxyz)}, translation={place})"
