"""Unit quaternions: rotations in space, one or a whole batch of them.

Conventions: scalar first (w, x, y, z), Hamilton product, active rotations, right-hand rule. The
quaternions q and -q are the same rotation. Angles are in radians. The leading axes of every array
are the batch.
"""

from abc import abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Self, overload

import numpy as np

from ._arrays import ArrayLike, Floats, Sealed, components, sealed, stack
from ._validate import broadcast, floats, instance, selected, shape_of, warn_if_degrees

UNIT = 1e-6  # a length that differs from 1 by at most this is accepted and normalised
UPRIGHT = 1e-14  # a pitch this close to +-90 degrees counts as +-90 degrees
CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])


class Batch(Sealed):
    """Base class of values with a batch shape: indexing, length and iteration act on the batch
    only.
    """

    # Otherwise `array @ value` would return an array of objects instead of raising a TypeError.
    __array_ufunc__ = None

    @property
    @abstractmethod
    def shape(self) -> tuple[int, ...]:
        """The batch shape."""

    @abstractmethod
    def __getitem__(self, index: Any) -> Self: ...

    def __len__(self) -> int:
        if not self.shape:
            raise TypeError(f"a single {type(self).__name__} has no length")
        return self.shape[0]

    def __iter__(self) -> Iterator[Self]:
        return (self[i] for i in range(len(self)))


@dataclass(frozen=True, init=False, repr=False, eq=False)
class Quaternion(Batch):
    """A rotation, or a batch of rotations of any shape, as unit quaternions `wxyz` (..., 4).

    `a @ b` composes (b first, then a) and `a @ points` rotates points of shape (..., 3). `wxyz` is
    read-only. Raises ValueError if a number is not finite or a length differs from 1 by more than
    1e-6. Source: 001, all listings, which write `*` for this product (Hamilton's).

    >>> half = Quaternion.from_angle_axis(np.pi, (0, 0, 1))
    >>> (half @ (1, 2, 3)).round(3)
    array([-1., -2.,  3.])
    """

    wxyz: Floats

    def __init__(self, wxyz: ArrayLike) -> None:
        value = floats(wxyz, "wxyz", 4)
        vars(self)["wxyz"] = sealed(unit(value, "wxyz", "unit quaternions"))

    @classmethod
    def _of(cls, wxyz: Floats) -> "Quaternion":
        """Make a Quaternion from unit quaternions, without checks; NaN rows are accepted."""
        wxyz.setflags(write=False)  # without `sealed`: every pose that is taken from a batch
        self = object.__new__(cls)  # comes through here, and a call costs a tenth of its time
        self.__dict__["wxyz"] = wxyz
        return self

    @classmethod
    def identity(cls, shape: tuple[int, ...] = ()) -> "Quaternion":
        """The identity rotation, with this batch shape."""
        return cls._of(np.broadcast_to([1.0, 0.0, 0.0, 0.0], (*shape_of(shape, "shape"), 4)))

    @classmethod
    def from_angle_axis(cls, angle: ArrayLike, axis: ArrayLike) -> "Quaternion":
        """The rotation by `angle` (...) in radians about the unit vector `axis` (..., 3),
        counter-clockwise when the axis points at the viewer. Raises ValueError if the length of an
        axis differs from 1 by more than 1e-6.
        """
        angles, axes = floats(angle, "angle"), floats(axis, "axis", 3)
        broadcast("angle and axis", angles.shape, axes.shape[:-1])
        warn_if_degrees(angles, "angle")
        return cls._turn(angles, unit(axes, "axis", "a unit vector"))

    @classmethod
    def _turn(cls, angle: Floats, axis: Floats) -> "Quaternion":
        """Like `from_angle_axis`, but without checks: a NaN angle gives a NaN rotation."""
        return cls._of(stack(half_angles(angle, components(axis))))

    @classmethod
    def from_roll_pitch_yaw(cls, roll: ArrayLike, pitch: ArrayLike, yaw: ArrayLike) -> "Quaternion":
        """Rotations by angles (...) in radians about the fixed x, then y, then z axis: Rz(yaw)
        Ry(pitch) Rx(roll).
        """
        x, y, z = np.eye(3)
        rolled = cls.from_angle_axis(roll, x)
        pitched, yawed = cls.from_angle_axis(pitch, y), cls.from_angle_axis(yaw, z)
        return yawed @ pitched @ rolled

    @classmethod
    def from_matrix(cls, matrix: ArrayLike) -> "Quaternion":
        """The rotations of matrices (..., 3, 3). Raises ValueError if a matrix is not orthogonal to
        within 1e-6 or is a reflection.

        The elements of the matrix give every product of two components of the quaternion. Dividing
        the four products that contain one component by that component gives all four components. We
        divide by the largest one (Shepperd 1978, J. Guidance and Control 1, p. 223), which is at
        least 1/2.
        """
        m = floats(matrix, "matrix", 3)
        if m.ndim < 2 or m.shape[-2] != 3:
            raise ValueError(f"matrix: wanted shape (..., 3, 3), got {m.shape}")
        with np.errstate(over="ignore", invalid="ignore"):
            error = abs(m @ m.mT - np.eye(3)).max(initial=0)
        if not error <= UNIT:
            differs = f"a matrix M for which M M^T differs from the identity by {error:.3g}"
            raise ValueError(f"matrix: wanted a rotation, got {differs}")
        x, y, z = (components(m[..., k, :]) for k in range(3))
        volume = sum(a * b for a, b in zip(cross(x, y), z, strict=True))  # the determinant
        if np.count_nonzero(volume < 0):
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
        rows = np.stack(  # row k is 4 * component k * quaternion
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

    def as_matrix(self) -> Floats:
        """Rotation matrices (..., 3, 3)."""
        return np.stack([stack(row) for row in self._rows()], axis=-2)

    def _rows(self) -> tuple[tuple[Floats, ...], ...]:
        """The nine elements of the matrix, each an array of the batch shape."""
        return matrix_rows(components(self.wxyz))

    def as_angle_axis(self) -> tuple[Floats, Floats]:
        """The angle in [0, pi] and the unit axis (..., 3). The axis of the identity is z by
        convention.
        """
        vector = np.where(self.wxyz[..., :1] < 0, -self.wxyz[..., 1:], self.wxyz[..., 1:])
        sine = np.linalg.norm(vector, axis=-1)
        angle = 2 * np.arctan2(sine, abs(self.wxyz[..., 0]))
        some = sine[..., None] > 0
        axis = np.where(some, vector / np.where(some, sine[..., None], 1), [0.0, 0.0, 1.0])
        return angle, axis

    def as_roll_pitch_yaw(self) -> tuple[Floats, Floats, Floats]:
        """The angles (...) in radians about the fixed x, then y, then z axis that compose this
        rotation (see `from_roll_pitch_yaw`); pitch lies in [-pi/2, pi/2].

        At a pitch of +-90 degrees (within the rounding of a few products) roll and yaw rotate about
        the same line, and we set roll to zero. Near this pitch, each single angle is inaccurate,
        but together they still give this rotation. Source: Bernardes and Viollet 2022, PLoS ONE
        17(11), e0276302.
        """
        w, x, y, z = components(self.wxyz)
        (xx, _, _), (yx, _, _), (zx, _, _) = self._rows()
        # cosine and sine of (yaw - roll) / 2, undefined at a pitch of -90 degrees, then those of
        # (yaw + roll) / 2, undefined at +90 degrees
        c, s, cos, sin = w + y, z - x, w - y, z + x
        up, down = np.hypot(cos, sin) < UPRIGHT, np.hypot(c, s) < UPRIGHT
        cos, sin = np.where(up, c, cos), np.where(up, s, sin)
        c, s = np.where(down, cos, c), np.where(down, sin, s)
        roll = np.arctan2(sin * c - cos * s, cos * c + sin * s)
        yaw = np.arctan2(sin * c + cos * s, cos * c - sin * s)
        return roll, np.arctan2(-zx, np.hypot(xx, yx)), yaw

    def angle_to(self, other: "Quaternion") -> Floats:
        """The angle in [0, pi] of the rotation from this one to `other`: (...) in radians.

        The batches are broadcast. Small angles are accurate to the last digit, unlike those from
        the arccos of the product's scalar part. The `angle_to` of source 001 is a different
        function: the signed angle between two vectors about an axis.
        """
        instance(other, Quaternion, "other")
        broadcast("the two rotations", self.shape, other.shape)
        return _angle_between(*_same_sign(self.wxyz, other.wxyz))

    @property
    def shape(self) -> tuple[int, ...]:
        """The batch shape."""
        return self.wxyz.shape[:-1]

    def __getitem__(self, index: Any) -> "Quaternion":
        whole = (*index, slice(None)) if isinstance(index, tuple) else (index, slice(None))
        return Quaternion._of(selected(self.wxyz[whole]))

    @overload
    def __matmul__(self, other: "Quaternion") -> "Quaternion": ...
    @overload
    def __matmul__(self, other: ArrayLike) -> Floats: ...
    def __matmul__(self, other: Any) -> Any:
        if isinstance(other, Quaternion):
            broadcast("the two rotations", self.shape, other.shape)
            return Quaternion._of(stack(hamilton(components(self.wxyz), components(other.wxyz))))
        if isinstance(other, Batch):
            return NotImplemented
        points = floats(other, "points", 3, finite=False)
        broadcast("rotation and points", self.shape, points.shape[:-1])
        return stack(turned(components(self.wxyz), components(points)))

    def inverse(self) -> "Quaternion":
        """The inverse rotation."""
        return Quaternion._of(self.wxyz * CONJUGATE)

    def slerp(self, goal: "Quaternion", s: ArrayLike) -> "Quaternion":
        """Interpolate along the shorter arc from this rotation (s = 0) to `goal` (s = 1), at
        constant angular velocity.

        `s` (...) is broadcast against both; outside [0, 1] the rotation continues. For a relative
        angle of exactly pi both arcs are equally long, and the signs of the two quaternions decide
        which one is taken. Source: Shoemake 1985, SIGGRAPH; 001, listing 7.
        """
        instance(goal, Quaternion, "goal")
        share = floats(s, "s")
        broadcast("start, goal and s", self.shape, goal.shape, share.shape)
        a, b = _same_sign(self.wxyz, goal.wxyz)
        angle = _angle_between(a, b) / 2  # the angle of the arc on the sphere of unit quaternions
        none = angle == 0
        whole = np.where(none, 1.0, np.sin(angle))
        of_a = np.where(none, 1 - share, np.sin((1 - share) * angle) / whole)
        of_b = np.where(none, share, np.sin(share * angle) / whole)
        ends = zip(components(a), components(b), strict=True)
        return Quaternion._of(stack([of_a * a_ + of_b * b_ for a_, b_ in ends]))

    def __repr__(self) -> str:
        if self.shape:
            return f"Quaternion(shape={self.shape})"
        return f"Quaternion(wxyz={rounded(self.wxyz)})"


# --- Formulas on components, which are single numbers or arrays -----------------------------------


def hamilton(a: Sequence[Any], b: Sequence[Any]) -> tuple[Any, Any, Any, Any]:
    """Hamilton's product of two quaternions (w, x, y, z)."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )


def turned(q: Sequence[Any], v: Sequence[Any]) -> tuple[Any, ...]:
    """The vector v (x, y, z) rotated by the quaternion q: q v q* = v + w t + u x t, where u is the
    vector part of q and t = 2 u x v.
    """
    w, *u = q
    t = [2 * c for c in cross(u, v)]
    return tuple(v_ + w * t_ + c for v_, t_, c in zip(v, t, cross(u, t), strict=True))


def spun(q: Sequence[Any], axis: int, cosine: Any, sine: Any) -> tuple[Any, Any, Any, Any]:
    """The quaternion q times a rotation about the coordinate axis 0, 1 or 2, given by the cosine
    and sine of half its angle: Hamilton's product without the terms that are zero.
    """
    w, *v = q
    i, j = (axis + 1) % 3, (axis + 2) % 3
    u = [w * sine + v[axis] * cosine] * 3
    u[i], u[j] = v[i] * cosine + v[j] * sine, v[j] * cosine - v[i] * sine
    return w * cosine - v[axis] * sine, *u


def along(q: Sequence[Any], axis: int, length: float) -> list[Any]:
    """The vector of this length along the coordinate axis 0, 1 or 2, rotated by q: a column of
    `matrix_rows` times the length.
    """
    w, *v = q
    i, j, twice = (axis + 1) % 3, (axis + 2) % 3, 2 * length
    u = [length - twice * (v[i] * v[i] + v[j] * v[j])] * 3
    u[i], u[j] = twice * (v[axis] * v[i] + w * v[j]), twice * (v[axis] * v[j] - w * v[i])
    return u


def half_angles(angle: Floats, axis: Sequence[Any]) -> tuple[Any, Any, Any, Any]:
    """The quaternion of a rotation by `angle` about the unit vector `axis` (x, y, z)."""
    half = angle / 2
    sine = np.sin(half)
    return np.cos(half), sine * axis[0], sine * axis[1], sine * axis[2]


def matrix_rows(q: Sequence[Any]) -> tuple[tuple[Any, ...], ...]:
    """The rotation matrix of the quaternion q, row by row."""
    w, x, y, z = q
    x2, y2, z2 = 2 * x, 2 * y, 2 * z
    wx, wy, wz = w * x2, w * y2, w * z2
    xx, xy, xz, yy, yz, zz = x * x2, x * y2, x * z2, y * y2, y * z2, z * z2
    return (
        (1 - (yy + zz), xy - wz, xz + wy),
        (xy + wz, 1 - (xx + zz), yz - wx),
        (xz - wy, yz + wx, 1 - (xx + yy)),
    )


def unit(vectors: Floats, name: str, what: str) -> Floats:
    """Return vectors (..., k) normalised to length 1. Raises ValueError if a length differs from 1
    by more than 1e-6; the message says that `what` was wanted.
    """
    with np.errstate(over="ignore"):
        length = np.sqrt((vectors * vectors).sum(axis=-1, keepdims=True))
    off = abs(length - 1)
    if np.count_nonzero(off > UNIT):
        worst = np.unravel_index(off[..., 0].argmax(), off.shape[:-1])
        got = f"{vectors[worst]} of length {length[worst][0]:.6g}"
        raise ValueError(f"{name}: wanted {what}, got {got}")
    scaled: Floats = vectors / length
    return scaled


def rounded(array: Floats) -> str:
    """Round to four decimals for a repr, without negative zeros."""
    return np.array2string(np.round(array, 4) + 0.0, separator=", ")


def _same_sign(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """Return a and whichever of b and -b is nearer to it."""
    # The margin prevents rounding errors from determining the direction of a half turn.
    return a, np.where(((a * b).sum(-1) < -1e-14)[..., None], -b, b)


def _angle_between(a: Floats, b: Floats) -> Floats:
    """The rotation angle between quaternions of the same sign: twice the angle of their arc."""
    apart, beside = np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1)
    angle: Floats = 4 * np.arctan2(apart, beside)
    return angle


def cross(a: Sequence[Any], b: Sequence[Any]) -> tuple[Any, Any, Any]:
    """The cross product of two vectors (x, y, z)."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
