"""Positioning arms: three revolute joints, an upper arm and a forearm, with four closed-form
solutions.

In a six-axis arm the same three joints carry the wrist, and the point to be placed is the wrist
centre.
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
    measured from the links at q = 0.

    At q = 0, in base coordinates, axis 1 must lie on the z axis, and axes 2 and 3 must be parallel
    to the y axis. The signs and offsets of the joints follow from the links. `ik` takes points
    (..., 3) in metres, or the translations of Transforms. ValueError: any other arrangement; the
    message names the axis.
    """
    return ClosedFormArm(name, ElbowGeometry(links), limits, speed_limits)


@dataclass(frozen=True, init=False, repr=False, eq=False)
class ElbowGeometry(Sealed):
    """Three links that position a point, and their inverse (see `elbow_arm`).

    Configuration flags, +1 or -1: whether the point is in front of or behind axis 1 (front is the
    +x side at q1 = 0), and whether joint 3 is on the positive or negative side of the stretched
    arm. Source: 000, "Решение обратной задачи".
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
        """Which singularities occur at q (..., 3): dict of name -> bool (...); see
        `Elbow.singularities`.
        """
        return self.elbow.singularities(q)

    def choose_free_joints(self, q: Floats, previous: Floats) -> Floats:
        """Return rows q (..., 3) with joint 1 as in `previous` wherever the point lies on axis 1
        and leaves joint 1 free.
        """
        on_axis = abs(self.elbow.radius(q)) < FREE * self.elbow.reach
        free = on_axis & (self.elbow.lateral == 0)
        return np.where(free[..., None] & (np.arange(3) == 0), previous, q)


class Elbow(NamedTuple):
    """Three joints and the point that they carry, measured at q = 0.

    carried      the name of the point
    sign1 ... 3  +1 or -1: the direction in which a joint turns
    shoulder_x, shoulder_z  the position of axis 2 in the plane of the arm
    lateral      the point's distance to the left of the plane through axis 1
    upper, fore  the lengths of the links
    upper_angle, fore_angle  their angles above the horizontal at q = 0
    reach        how far the stretched arm reaches from axis 1
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
        """Measure an arm from a point on each of the three axes, the axes, and the carried point,
        all at q = 0. ValueError: directions other than those in `elbow_arm`, or a link of length
        zero.
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
        """Return joints 1 to 3 that bring the point to x, y, z (N,): each (front/back, elbow, N),
        NaN where there is no solution.

        It also returns the directions that a wrist needs: (cosine, sine) of the arm's plane (2, 1,
        N) and of the forearm's angle above the horizontal (2, 2, N). Angles are kept as pairs
        (cosine, sine), so that only the joint values need an arctangent.
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
        # + 0.0 removes a negative zero, so that half a turn is +pi
        sin1 = np.where(free, 0.0, (y * r - x * b) / rho2) + 0.0

        # Joints 2 and 3: the triangle of upper arm, forearm and the line from shoulder to point.
        # With the angle g between the links, 1 + cos g and 1 - cos g say how far the arm is from
        # folded and from stretched. Both are differences of two squares; computed from a cosine,
        # the smaller one would lose its digits (equal links, nearly folded). The squares are
        # written as products because every language rounds products in the same way, but not
        # powers.
        u, w = r - a, z - c
        d2, scale = u * u + w * w, 2 * upper * fore
        unfolded = (d2 - (upper - fore) * (upper - fore)) / scale
        unstretched = ((upper + fore) * (upper + fore) - d2) / scale
        # The rates at which these two change per metre at the borders, times the reach.
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
        """How far the point is in front of axis 1 at q (..., 3 or more); negative behind it."""
        elevation = self.upper_angle + self.sign2 * q[..., 1]
        ahead = self.upper * np.cos(elevation) + self.fore * np.cos(elevation + self.bend(q))
        return self.shoulder_x + ahead

    def bend(self, q: Floats) -> Floats:
        """The angle from the upper arm up to the forearm at q (..., 3 or more)."""
        return self.fore_angle - self.upper_angle + self.sign3 * q[..., 2]

    def singularities(self, q: Floats) -> dict[str, Bools]:
        """The singularities of the posture: dict of name -> bool (...). Shoulder: the point is on
        axis 1 or as near to it as it can be (within 1e-6 of the reach). Elbow: the arm is stretched
        or folded (within 1e-6 rad).
        """
        return {
            "shoulder": abs(self.radius(q)) < SINGULAR * self.reach,
            "elbow": abs(np.sin(self.bend(q))) < SINGULAR,
        }

    def gap(self, point: Sequence[float], front: int) -> Gap:
        """The border that a single unreachable point (3,) is beyond, on the side `front` (+-1)."""
        x, y, z = point
        rho2 = x * x + y * y
        r2 = rho2 - self.lateral * self.lateral
        # A point that is past this border only by rounding counts as on it, so another border must
        # be the reason.
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
    """Raise ValueError unless the axis is parallel to x, y or z (along 0, 1, 2)."""
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
    """(x, y) normalised to length 1, or (1, 0) for length zero: joint 2 is free where equal links
    are folded.
    """
    length = np.sqrt(x * x + y * y)
    none = length == 0
    if none.any():
        x, length = np.where(none, 1.0, x), np.where(none, 1.0, length)
    return x / length, y / length


def _point(pose: Any) -> Floats:
    return pose.translation if isinstance(pose, Transform) else floats(pose, "points", 3)
