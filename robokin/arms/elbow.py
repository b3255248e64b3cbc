"""Positioning arms: three revolute joints, an upper arm and a forearm, with four closed-form
solutions.

In a six-axis arm, the same three joints carry the wrist, and the point that they position is the
wrist centre.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from math import sqrt
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from .._arrays import ArrayLike, Bools, Floats, Sealed, by_blocks
from .._validate import floats
from ..transform import Transform
from .arm import ClosedFormArm
from .geometry import FREE, ROUNDING, SINGULAR, STRAIGHT, Gap, flags, worst
from .link import Link, chain, home

Pair: TypeAlias = tuple[Any, Any]  # cosine and sine of an angle


def elbow_arm(
    name: str,
    links: Iterable[Link],
    limits: ArrayLike,
    speed_limits: ArrayLike | None = None,
) -> ClosedFormArm:
    """An arm of three revolute links that positions the origin of its flange. Its geometry is
    computed from the links at q = 0.

    At q = 0, in base coordinates, axis 1 must lie on the z axis, and axes 2 and 3 must be parallel
    to the y axis. The signs and offsets of the joints follow from the links. `ik` takes points
    (..., 3) in metres, or the translations of Transforms. Raises ValueError for any other
    arrangement of the axes; the message names the axis.
    """
    return ClosedFormArm(name, ElbowGeometry(links), limits, speed_limits)


@dataclass(frozen=True, init=False, repr=False, eq=False)
class ElbowGeometry(Sealed):
    """Three links that position a point, and their inverse (see `elbow_arm`).

    The configuration flags, +1 or -1, say whether the point is in front of axis 1 or behind it (at
    q1 = 0, the front is the +x side), and whether joint 3 is above or below its value in the fully
    extended arm. Source: 000, "Решение обратной задачи".
    """

    branches = flags(2)
    target = np.ndarray
    carried = "the point"
    links: tuple[Link, ...]
    elbow: "Elbow" = field(init=False)
    reach: float = field(init=False)

    @np.errstate(invalid="ignore")  # squares of lengths may overflow or underflow
    def __init__(self, links: Iterable[Link]) -> None:
        links = chain(links)
        if len(links) != 3 or any(link.prismatic for link in links):
            raise ValueError(f"links: wanted three revolute links, got {len(links)}")
        points, axes, flange = home(links)
        elbow = Elbow.measured(points, axes, flange.translation, self.carried)
        vars(self).update(links=links, elbow=elbow, reach=elbow.reach)

    def ik(self, pose: Any) -> Floats:
        """See `ClosedFormArm.ik`: points or Transform of shape (...) -> (..., 4, 3)."""
        point = _point(pose)

        def solve(place: Sequence[Floats]) -> list[Floats]:
            return self.elbow.solve(*place)[0]

        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            q = by_blocks(solve, point.reshape(-1, 3), rest=(2, 2))
        return np.moveaxis(q.reshape(3, 4, *point.shape[:-1]), (0, 1), (-1, -2))

    def gap(self, pose: Any, row: int) -> Gap:
        """The reason why a single pose has no solution in this row."""
        return self.elbow.gap(_point(pose).tolist(), self.branches[row, 0])

    def singularities(self, q: Floats) -> dict[str, Bools]:
        """Return whether each singularity occurs at q (..., 3); see `Elbow.singularities`."""
        return self.elbow.singularities(q)

    def choose_free_joints(self, q: Floats, previous: Floats) -> Floats:
        """Return rows q (..., 3) in which joint 1 has its value from `previous` wherever it is free
        because the point lies on axis 1.
        """
        on_axis = abs(self.elbow.radius(q)) < FREE * self.elbow.reach
        free = on_axis & (self.elbow.lateral == 0)
        return np.where(free[..., None] & (np.arange(3) == 0), previous, q)


class Elbow(NamedTuple):
    """The dimensions of three joints and the point that they position, at q = 0.

    carried      the name of the point
    sign1 ... 3  +1 or -1: the direction in which a joint turns
    shoulder_x, shoulder_z  the position of axis 2 in the plane of the arm
    lateral      the point's distance to the left of the arm's plane, which contains axis 1
    upper, fore  the lengths of the links
    upper_angle, fore_angle  their angles above the horizontal at q = 0
    reach        how far the fully extended arm reaches from axis 1
    """

    carried: str
    sign1: float
    sign2: float
    sign3: float
    shoulder_x: float
    shoulder_z: float
    lateral: float
    upper: float
    upper_angle: float
    fore: float
    fore_angle: float
    reach: float

    @classmethod
    def measured(cls, points: Floats, axes: Floats, point: Floats, carried: str) -> "Elbow":
        """Compute the dimensions from a point on each of the three axes, the directions of the
        axes, and the carried point, all at q = 0. Raises ValueError if an axis does not have the
        direction that `elbow_arm` requires, or a link has length zero.
        """
        for number, axis, along in ((1, axes[0], 2), (2, axes[1], 1), (3, axes[2], 1)):
            parallel(number, axis, along)
        if np.hypot(*points[0][:2]) > 1e-9:
            got = f"got it through {points[0]} at q = 0"
            raise ValueError(f"links: wanted axis 1 through the origin, {got}")
        (ux, _, uz), (fx, _, fz) = points[2] - points[1], point - points[2]
        upper, fore = float(np.hypot(ux, uz)), float(np.hypot(fx, fz))
        for lever, length in (("an upper arm", upper), ("a forearm", fore)):
            if length < 1e-9:
                raise ValueError(f"links: wanted {lever} longer than 0, got {length:g} m at q = 0")
        shoulder_x, _, shoulder_z = points[1].tolist()
        reach, lateral = abs(shoulder_x) + upper + fore, float(point[1])
        return cls(
            carried,
            sign1=float(np.sign(axes[0][2])),
            sign2=-float(np.sign(axes[1][1])),  # turning about +y lowers a link that points forward
            sign3=-float(np.sign(axes[2][1])),
            shoulder_x=shoulder_x,
            shoulder_z=shoulder_z,
            lateral=0.0 if abs(lateral) < ROUNDING * reach else lateral,
            upper=upper,
            upper_angle=float(np.arctan2(uz, ux)),
            fore=fore,
            fore_angle=float(np.arctan2(fz, fx)),
            reach=reach,
        )

    def solve(self, x: Floats, y: Floats, z: Floats) -> tuple[list[Floats], Pair, Pair]:
        """Return the values of joints 1 to 3 that bring the point to x, y, z (N,). Each is an array
        (front/back, elbow, N) with NaN where there is no solution.

        Also return the directions that a wrist needs, as pairs (cosine, sine): the direction of the
        arm's plane (2, 1, N) and the angle of the forearm above the horizontal (2, 2, N). Because
        angles are represented by such pairs, only the joint values need an arctangent.
        """
        a, b, c = self.shoulder_x, self.lateral, self.shoulder_z
        upper, fore = self.upper, self.fore

        # Joint 1: seen from above, the point is r in front of axis 1 and b to the side of the arm's
        # plane.
        front = np.array([1.0, -1.0])[:, None, None]
        rho2 = x * x + y * y
        r2 = rho2 - b * b
        near = r2 >= -2 * ROUNDING * abs(b) * self.reach
        r = front * np.sqrt(np.where(near, np.maximum(r2, 0), np.nan))
        tiny = FREE * self.reach
        free = rho2 <= tiny * tiny
        cos1 = np.where(free, front, (x * r + y * b) / rho2)
        # adding 0.0 turns -0.0 into 0.0, so that half a turn is +pi
        sin1 = np.where(free, 0.0, (y * r - x * b) / rho2) + 0.0

        # Joints 2 and 3: the upper arm, the forearm and the line from shoulder to point form a
        # triangle. If g is the angle between the links, 1 + cos g and 1 - cos g show how far the
        # arm is from being folded and from being fully extended. Both are computed as differences
        # of two squares; computed from the cosine, the smaller one would lose its significant
        # digits (equal links, nearly folded). The squares are written as products because all
        # languages round products in the same way, but not powers.
        u, w = r - a, z - c
        d2, scale = u * u + w * w, 2 * upper * fore
        unfolded = (d2 - (upper - fore) * (upper - fore)) / scale
        unstretched = ((upper + fore) * (upper + fore) - d2) / scale
        # The rates of change of these two, per metre, at the boundaries of the workspace, times the
        # reach.
        inner = 2 * abs(upper - fore) * self.reach / scale
        outer = 2 * (upper + fore) * self.reach / scale
        exists = (unfolded >= -ROUNDING * inner) & (unstretched >= -ROUNDING * outer)
        unfolded = np.where(exists, unfolded, np.nan)
        unstretched = np.where(unstretched <= STRAIGHT * outer, 0.0, unstretched)
        unfolded = np.where(unfolded <= STRAIGHT * inner, 0.0, unfolded)
        elbow = self.sign3 * np.array([1.0, -1.0])[:, None]
        cos_g, sin_g = unfolded - 1, elbow * np.sqrt(unfolded * unstretched)
        along, across = (upper - fore) + fore * unfolded, fore * sin_g
        # angle of the upper arm above the horizontal
        cos_a, sin_a = _unit(along * u + across * w, along * w - across * u)
        # angle of the forearm above the horizontal
        cos_b, sin_b = cos_a * cos_g - sin_a * sin_g, sin_a * cos_g + cos_a * sin_g

        q1 = np.where(exists, np.arctan2(self.sign1 * sin1, cos1), np.nan)
        cos2, sin2 = rotated(cos_a, sin_a, -self.upper_angle)
        cos3, sin3 = rotated(cos_g, sin_g, self.upper_angle - self.fore_angle)
        q2, q3 = np.arctan2(self.sign2 * sin2, cos2), np.arctan2(self.sign3 * sin3, cos3)
        return [q1, q2, q3], (cos1, sin1), (cos_b, sin_b)

    def radius(self, q: Floats) -> Floats:
        """The distance of the point in front of axis 1 at q (..., 3 or more); negative if it is
        behind.
        """
        elevation = self.upper_angle + self.sign2 * q[..., 1]
        ahead = self.upper * np.cos(elevation) + self.fore * np.cos(elevation + self.bend(q))
        return self.shoulder_x + ahead

    def bend(self, q: Floats) -> Floats:
        """The angle from the upper arm up to the forearm at q (..., 3 or more)."""
        return self.fore_angle - self.upper_angle + self.sign3 * q[..., 2]

    def singularities(self, q: Floats) -> dict[str, Bools]:
        """Return whether each singularity occurs, as a dict that maps its name to a bool array
        (...). At "shoulder", the point is on axis 1 or as near to it as it can be (within 1e-6 of
        the reach). At "elbow", the arm is fully extended or folded (within 1e-6 rad).
        """
        return {
            "shoulder": abs(self.radius(q)) < SINGULAR * self.reach,
            "elbow": abs(np.sin(self.bend(q))) < SINGULAR,
        }

    def gap(self, point: Sequence[float], front: int) -> Gap:
        """The reason why a single point (3,) cannot be reached on the side `front` (+1 or -1)."""
        x, y, z = point
        rho2 = x * x + y * y
        r2 = rho2 - self.lateral * self.lateral
        # A point that is beyond this boundary only because of rounding counts as being on it, so
        # another boundary must be the reason.
        if r2 < -2 * ROUNDING * abs(self.lateral) * self.reach:
            return Gap("axis", abs(self.lateral) - sqrt(rho2), self.carried)
        r = front * sqrt(max(r2, 0.0))
        d = np.hypot(r - self.shoulder_x, z - self.shoulder_z)
        borders = {
            "stretched": d - (self.upper + self.fore),
            "folded": abs(self.upper - self.fore) - d,
        }
        return worst(borders, self.carried)


def parallel(number: int, axis: Floats, along: int) -> None:
    """Raise ValueError unless the axis is parallel to x, y or z (`along` is 0, 1 or 2)."""
    if abs(abs(axis[along]) - 1) > 1e-9:
        wanted = f"wanted axis {number} parallel to {'xyz'[along]}"
        raise ValueError(f"links: {wanted}, got {axis} at q = 0")


def rotated(cosine: Any, sine: Any, angle: float) -> Pair:
    """Add a constant angle to an angle given by its cosine and sine; return the new pair."""
    if angle == 0:
        return cosine, sine
    c, s = np.cos(angle), np.sin(angle)
    return cosine * c - sine * s, sine * c + cosine * s


def _unit(x: Floats, y: Floats) -> Pair:
    """Return (x, y) scaled to length 1, or (1, 0) if its length is zero: joint 2 is free where
    equal links are folded.
    """
    length = np.sqrt(x * x + y * y)
    none = length == 0
    if none.any():
        x, length = np.where(none, 1.0, x), np.where(none, 1.0, length)
    return x / length, y / length


def _point(pose: Any) -> Floats:
    return pose.translation if isinstance(pose, Transform) else floats(pose, "points", 3)
