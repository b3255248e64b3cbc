"""Unit quaternions: rotations in space, one or a whole batch of them.

Conventions: scalar first (w, x, y, z), Hamilton product, active rotations, right-hand rule. The
quaternions q and -q are one rotation. Angles in radians. The leading axes of every array are the
batch.
"""

from dataclasses import dataclass

import numpy as np

from ._validate import broadcast, floats, instance


class Batch:
    """What values with a batch shape have in common: indexing, length and iteration over the batch
    only.
    """

    __array_ufunc__ = None  # so that `array @ value` is a TypeError and not an array of objects

    def __len__(self):
        if not self.shape:
            raise TypeError(f"one single {type(self).__name__} has no length")
        return self.shape[0]

    def __iter__(self):
        return (self[i] for i in range(len(self)))


@dataclass(frozen=True, eq=False, repr=False)
class Quaternion(Batch):
    """A rotation of any batch shape, as a unit quaternion `wxyz` of shape (..., 4).

    `a @ b` composes (first b, then a) and `a @ points` turns points of shape (..., 3). ValueError:
    not finite, or a length that is not 1 within 1e-6.
    Source: 001, all listings (there `*`); the product is Hamilton's.
    """

    wxyz: np.ndarray

    def __post_init__(self):
        wxyz = floats(self.wxyz, "wxyz", 4)
        length = np.linalg.norm(wxyz, axis=-1, keepdims=True)
        if (abs(length - 1) > 1e-6).any():
            worst = length.flat[abs(length - 1).argmax()]
            raise ValueError(f"wxyz: wanted unit quaternions, got one of length {worst:.6g}")
        object.__setattr__(self, "wxyz", wxyz / length)

    @classmethod
    def _of(cls, *wxyz):
        """From components already known to be of unit length: nothing is checked, NaN rows pass."""
        self = object.__new__(cls)
        object.__setattr__(self, "wxyz", wxyz[0] if len(wxyz) == 1 else stack(wxyz))
        return self

    @classmethod
    def identity(cls, shape=()):
        """No rotation, of the given batch shape."""
        return cls._of(np.broadcast_to([1.0, 0.0, 0.0, 0.0], (*shape, 4)))

    @classmethod
    def from_angle_axis(cls, angle, axis):
        """The turn by `angle` (...) in radians about the unit vector `axis` (..., 3),
        counter-clockwise seen against the axis. ValueError: an axis whose length is not 1 within
        1e-6.
        """
        angle, axis = floats(angle, "angle"), floats(axis, "axis", 3)
        broadcast("angle and axis", angle.shape, axis.shape[:-1])
        length = np.linalg.norm(axis, axis=-1, keepdims=True)
        if (abs(length - 1) > 1e-6).any():
            worst = tuple(int(i) for i in np.argwhere(abs(length[..., 0] - 1) > 1e-6)[0])
            raise ValueError(
                f"axis: wanted a unit vector, got {axis[worst]} of length {length[worst][0]:.6g}"
            )
        return cls._turn(angle, axis / length)

    @classmethod
    def _turn(cls, angle, axis):
        """As `from_angle_axis`, unchecked: a NaN angle gives a NaN rotation."""
        sine = np.sin(angle / 2)
        return cls._of(
            np.cos(angle / 2), sine * axis[..., 0], sine * axis[..., 1], sine * axis[..., 2]
        )

    @classmethod
    def from_matrix(cls, matrix):
        """From rotation matrices (..., 3, 3). ValueError: not orthogonal within 1e-6, or a
        reflection.

        Each of the four components can be read from the matrix with a division by itself; we divide
        by the largest one (Shepperd 1978, J. Guidance and Control 1, p. 223), which is never below
        1/2.
        """
        m = floats(matrix, "matrix", 3)
        if m.ndim < 2 or m.shape[-2] != 3:
            raise ValueError(f"matrix: wanted shape (..., 3, 3), got {m.shape}")
        error = abs(m @ m.mT - np.eye(3)).max(initial=0)
        if error > 1e-6:
            raise ValueError(
                f"matrix: wanted a rotation, got one whose R R^T differs from 1 by {error:.3g}"
            )
        if (np.linalg.det(m) < 0).any():
            raise ValueError("matrix: wanted a rotation, got a reflection (determinant -1)")
        xx, yy, zz = m[..., 0, 0], m[..., 1, 1], m[..., 2, 2]
        wx, wy, wz = (
            m[..., 2, 1] - m[..., 1, 2],
            m[..., 0, 2] - m[..., 2, 0],
            m[..., 1, 0] - m[..., 0, 1],
        )
        xy, xz, yz = (
            m[..., 1, 0] + m[..., 0, 1],
            m[..., 0, 2] + m[..., 2, 0],
            m[..., 2, 1] + m[..., 1, 2],
        )
        # row k is 4 * component k * quaternion
        rows = np.stack(
            [
                stack([1 + xx + yy + zz, wx, wy, wz]),
                stack([wx, 1 + xx - yy - zz, xy, xz]),
                stack([wy, xy, 1 - xx + yy - zz, yz]),
                stack([wz, xz, yz, 1 - xx - yy + zz]),
            ],
            axis=-2,
        )
        largest = np.diagonal(rows, axis1=-2, axis2=-1).argmax(axis=-1)
        row = np.take_along_axis(rows, largest[..., None, None], axis=-2)[..., 0, :]
        return cls._of(row / np.linalg.norm(row, axis=-1, keepdims=True))

    def as_matrix(self):
        """Rotation matrices (..., 3, 3)."""
        return np.stack([stack(row) for row in self._rows()], axis=-2)

    def _rows(self):
        """The nine elements of the matrix, each an array of the batch shape."""
        w, x, y, z = _components(self.wxyz)
        x2, y2, z2 = 2 * x, 2 * y, 2 * z
        wx, wy, wz = w * x2, w * y2, w * z2
        xx, xy, xz, yy, yz, zz = x * x2, x * y2, x * z2, y * y2, y * z2, z * z2
        return (
            (1 - (yy + zz), xy - wz, xz + wy),
            (xy + wz, 1 - (xx + zz), yz - wx),
            (xz - wy, yz + wx, 1 - (xx + yy)),
        )

    def as_angle_axis(self):
        """The angle in [0, pi] and the unit axis (..., 3). The axis of no rotation is z, by
        agreement.
        """
        vector = np.where(self.wxyz[..., :1] < 0, -self.wxyz[..., 1:], self.wxyz[..., 1:])
        sine = np.linalg.norm(vector, axis=-1)
        angle = 2 * np.arctan2(sine, abs(self.wxyz[..., 0]))
        some = sine[..., None] > 0
        return angle, np.where(some, vector / np.where(some, sine[..., None], 1), [0.0, 0.0, 1.0])

    @property
    def shape(self):
        """The batch shape."""
        return self.wxyz.shape[:-1]

    def __getitem__(self, index):
        index = index if isinstance(index, tuple) else (index,)
        return Quaternion._of(self.wxyz[(*index, slice(None))])

    def __matmul__(self, other):
        if isinstance(other, Quaternion):
            aw, ax, ay, az = _components(self.wxyz)
            bw, bx, by, bz = _components(other.wxyz)
            broadcast("the two rotations", self.shape, other.shape)
            return Quaternion._of(
                aw * bw - ax * bx - ay * by - az * bz,
                aw * bx + ax * bw + ay * bz - az * by,
                aw * by - ax * bz + ay * bw + az * bx,
                aw * bz + ax * by - ay * bx + az * bw,
            )
        if isinstance(other, Batch):
            return NotImplemented
        points = floats(other, "points", 3, finite=False)
        broadcast("rotation and points", self.shape, points.shape[:-1])
        w, *u = _components(self.wxyz)
        v = _components(points)
        t = [2 * c for c in _cross(u, v)]  # v + w t + u x t, which is q v q* written out
        return stack([v_ + w * t_ + c for v_, t_, c in zip(v, t, _cross(u, t), strict=True)])

    def inverse(self):
        """The rotation back."""
        return Quaternion._of(self.wxyz * [1.0, -1.0, -1.0, -1.0])

    def slerp(self, goal, s):
        """Along the shorter arc from here (s = 0) to `goal` (s = 1), at constant angular velocity.

        `s` (...) is broadcast against both; beyond [0, 1] the turn goes on. For a relative turn of
        exactly pi both arcs are equally long: there the signs of the two quaternions decide (they
        are used as they are).
        Source: Shoemake 1985, SIGGRAPH; 001, listing 7.
        """
        instance(goal, Quaternion, "goal")
        s = floats(s, "s")
        broadcast("start, goal and s", self.shape, goal.shape, s.shape)
        a, b = self.wxyz, goal.wxyz
        # The margin keeps rounding noise from choosing the direction of a half turn.
        b = np.where(((a * b).sum(-1) < -1e-14)[..., None], -b, b)
        angle = 2 * np.arctan2(np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1))
        none = angle == 0
        whole = np.where(none, 1.0, np.sin(angle))
        of_a = np.where(none, 1 - s, np.sin((1 - s) * angle) / whole)
        of_b = np.where(none, s, np.sin(s * angle) / whole)
        return Quaternion._of(
            *(of_a * a_ + of_b * b_ for a_, b_ in zip(_components(a), _components(b), strict=True))
        )

    def __repr__(self):
        return (
            f"Quaternion(wxyz={rounded(self.wxyz)})"
            if not self.shape
            else f"Quaternion(shape={self.shape})"
        )


def rounded(array):
    """For a repr: four decimals, no minus zero."""
    return np.array2string(np.round(array, 4) + 0.0, separator=", ")


def _components(array):
    return tuple(array[..., i] for i in range(array.shape[-1]))


def stack(components):
    # components in one long run each
    out = np.empty((*np.broadcast(*components).shape, len(components)), order="F")
    for i, component in enumerate(components):
        out[..., i] = component
    return out


def _cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
