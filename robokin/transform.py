"""Rigid transforms: a rotation and a translation, one or a whole batch of them.

`T_base_tool` gives the tool's frame in base coordinates. `T_base_tool @ T_tool_part` composes, and
`T_base_tool @ points` takes points (..., 3) from tool coordinates to base coordinates. Metres and
radians.
"""

from dataclasses import dataclass

import numpy as np

from ._validate import broadcast, floats, instance
from .quaternion import Batch, Quaternion, rounded, stack


@dataclass(frozen=True, eq=False, repr=False)
class Transform(Batch):
    """A pose or a change of frame: first `rotation`, then `translation` (..., 3) in metres.

    Either part may be left out. A batch of poses acts on a batch of points by broadcasting:
    `T[:, None] @ points`. ValueError: wrong shape, not finite.
    Source: 001, all listings (there `+`); 000, the homogeneous matrices.
    """

    rotation: Quaternion = Quaternion.identity()
    translation: np.ndarray = (0.0, 0.0, 0.0)

    def __post_init__(self):
        instance(self.rotation, Quaternion, "rotation")
        translation = floats(self.translation, "translation", 3)
        shape = broadcast("rotation and translation", self.rotation.shape, translation.shape[:-1])
        whole = Quaternion._of(np.broadcast_to(self.rotation.wxyz, (*shape, 4)))
        object.__setattr__(self, "rotation", whole)
        object.__setattr__(self, "translation", np.broadcast_to(translation, (*shape, 3)).copy())

    @classmethod
    def _of(cls, rotation, translation):
        """From parts of one batch shape: nothing is checked, NaN rows pass."""
        self = object.__new__(cls)
        object.__setattr__(self, "rotation", rotation)
        object.__setattr__(self, "translation", translation)
        return self

    @classmethod
    def identity(cls, shape=()):
        """The frame itself, of the given batch shape."""
        return cls._of(Quaternion.identity(shape), np.zeros((*shape, 3)))

    @classmethod
    def from_matrix(cls, matrix):
        """From homogeneous matrices (..., 4, 4). ValueError: the upper left part is no rotation
        within 1e-6, or the last row is not 0 0 0 1.
        """
        m = floats(matrix, "matrix", 4)
        if m.ndim < 2 or m.shape[-2] != 4:
            raise ValueError(f"matrix: wanted shape (..., 4, 4), got {m.shape}")
        if (abs(m[..., 3, :] - [0, 0, 0, 1]) > 1e-9).any():
            raise ValueError(
                f"matrix: wanted 0 0 0 1 as the last row, got {m[..., 3, :].reshape(-1, 4)[0]}"
            )
        return cls._of(Quaternion.from_matrix(m[..., :3, :3]), m[..., :3, 3].copy())

    def as_matrix(self):
        """Homogeneous matrices (..., 4, 4)."""
        m = np.zeros((*self.shape, 4, 4))
        m[..., :3, :3] = self.rotation.as_matrix()
        m[..., :3, 3] = self.translation
        m[..., 3, 3] = 1
        return m

    @property
    def shape(self):
        """The batch shape."""
        return self.translation.shape[:-1]

    def __getitem__(self, index):
        index = index if isinstance(index, tuple) else (index,)
        return Transform._of(self.rotation[index], self.translation[(*index, slice(None))])

    def __matmul__(self, other):
        if isinstance(other, Transform):
            rotation = self.rotation @ other.rotation
            return Transform._of(rotation, self.rotation @ other.translation + self.translation)
        if isinstance(other, Batch):
            return NotImplemented
        return self.rotation @ other + self.translation

    def inverse(self):
        """The change of frame back: [R^T, -R^T p]. Source: 000, "Обратная задача"."""
        back = self.rotation.inverse()
        return Transform._of(back, -(back @ self.translation))

    def lerp(self, goal, s):
        """On the way from here (s = 0) to `goal` (s = 1): the origin on a straight line, the
        rotation by `Quaternion.slerp`. `s` (...) is broadcast against both; beyond [0, 1] the
        motion goes on.
        Source: 001, listing 7 (`Transform.lerp`).
        """
        instance(goal, Transform, "goal")
        s = floats(s, "s")
        rotation = self.rotation.slerp(goal.rotation, s)
        here, there = np.moveaxis(self.translation, -1, 0), np.moveaxis(goal.translation, -1, 0)
        return Transform._of(
            rotation, stack([a + (b - a) * s for a, b in zip(here, there, strict=True)])
        )

    def __repr__(self):
        if self.shape:
            return f"Transform(shape={self.shape})"
        return (
            f"Transform(rotation={rounded(self.rotation.wxyz)}, "
            f"translation={rounded(self.translation)})"
        )
