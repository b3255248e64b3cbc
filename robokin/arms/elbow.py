"""Positioning arms: three revolute joints, an upper arm and a forearm; four solutions in closed
form.

The same three joints carry the wrist of a six-axis arm: there the point to be placed is the wrist
centre.
"""

from functools import cached_property

import numpy as np

from .._validate import floats
from ..transform import Transform
from .arm import Arm

# Distances as shares of the reach.
ROUNDING = 1e-12  # out of reach by no more than this is rounding
# this near to stretched or folded is stretched or folded: the two elbow rows are one
STRAIGHT = 1e-14
EPS = np.finfo(float).eps
FREE = 1e-13  # this near to axis 1 the angle of joint 1 is noise, and the joint is free


def elbow_arm(name, links, limits, speed_limits=None):
    """An `Arm` of three revolute links that places its flange's origin; its geometry is read from
    the links at q = 0.

    Wanted at q = 0, in base coordinates: axis 1 on the z axis, axes 2 and 3 parallel to the y axis.
    Signs and offsets of the joints follow from the links. `ik` takes points (..., 3) in metres, or
    Transforms, of which it takes the translation. ValueError otherwise, naming the axis.
    """
    geometry = ElbowArm(name, links)
    geometry.elbow  # noqa: B018  (measured now, so that a wrong chain is reported here)
    return Arm(name, geometry.links, geometry, limits, speed_limits)


class ElbowArm:
    """The inverse of three links that place a point (see `elbow_arm`).

    Configuration flags, +1 or -1: the point in front of or behind axis 1 (front is the side of +x
    at q1 = 0); joint 3 on the positive or negative side of the stretched arm. Source: 000, "Решение
    обратной задачи".
    """

    branches = np.array([(i, j) for i in (1, -1) for j in (1, -1)])

    def __init__(self, name, links):
        self.name, self.links = name, tuple(links)

    @cached_property
    def elbow(self):
        """The geometry, measured when it is first asked for."""
        if len(self.links) != 3:
            raise ValueError(f"{self.name}: wanted three revolute links, got {len(self.links)}")
        points, axes, flange = home(self.links)
        return Elbow(self.name, points, axes, flange.translation, "point")

    def ik(self, pose):
        """See `Arm.ik`: points or Transform of shape (...) -> (..., 4, 3)."""
        point = _point(pose)
        q = np.empty((3, 2, 2, point[..., 0].size))
        with np.errstate(invalid="ignore", divide="ignore"):
            self.elbow.solve(*point.reshape(-1, 3).T, q)
        return np.moveaxis(q.reshape(3, 4, *point.shape[:-1]), (0, 1), (-1, -2))

    def unreached(self, pose, row):
        """Why `row` does not exist for one single pose, in words, and by how many metres; ("", 0.0)
        if it exists.
        """
        return self.elbow.unreached(_point(pose), self.branches[row][0])

    def singular(self, q):
        """Which singularities hold at q (..., 3): dict of name -> bool (...); see
        `Elbow.singular`.
        """
        return self.elbow.singular(q)

    def settle(self, q, previous):
        """Rows q (..., 3) with joint 1 as in `previous` where the point lies on axis 1 and leaves
        it free.
        """
        free = (abs(self.elbow.radius(q)) < FREE * self.elbow.reach) & (self.elbow.lateral == 0)
        return np.where(free[..., None] & (np.arange(3) == 0), previous, q)


class Elbow:
    """Three joints and the point they carry, measured at q = 0: signs, levers and their angles
    above the horizon.

    points, axes   of the three joints, as `home` gives them; point (3,) the carried point; `what`
                   it is called
    """

    def __init__(self, name, points, axes, point, what):
        for number, axis, along in ((1, axes[0], 2), (2, axes[1], 1), (3, axes[2], 1)):
            parallel(name, number, axis, along)
        if np.hypot(*points[0][:2]) > 1e-9:
            raise ValueError(
                f"{name}: wanted axis 1 through the origin, got it through {points[0]} at q = 0"
            )
        self.what = what
        self.sign1 = np.sign(axes[0][2])
        # a turn about +y lowers what points ahead
        self.sign2, self.sign3 = -np.sign(axes[1][1]), -np.sign(axes[2][1])
        self.shoulder_x, self.shoulder_z, self.lateral = points[1][0], points[1][2], point[1]
        (ux, _, uz), (fx, _, fz) = points[2] - points[1], point - points[2]
        self.upper, self.upper_angle = np.hypot(ux, uz), np.arctan2(uz, ux)
        self.fore, self.fore_angle = np.hypot(fx, fz), np.arctan2(fz, fx)
        for lever, length in (("upper arm", self.upper), ("forearm", self.fore)):
            if length < 1e-9:
                raise ValueError(
                    f"{name}: wanted some length of the {lever}, got {length} at q = 0"
                )
        self.reach = abs(self.shoulder_x) + self.upper + self.fore
        if abs(self.lateral) < ROUNDING * self.reach:
            self.lateral = 0.0

    def solve(self, x, y, z, q):
        """Fill q (3, 2, 2, N): joint, front/back, elbow, point (N,). NaN where there is no
        solution.

        Returns the directions that a wrist needs: (cosine, sine) of the arm's plane (2, 1, N) and
        of the forearm above the horizon (2, 2, N). Angles live as such pairs, so that only the
        joint values need an arctangent.
        """
        a, b, c = self.shoulder_x, self.lateral, self.shoulder_z
        upper, fore = self.upper, self.fore

        # Joint 1: seen from above, the point is r in front of axis 1 and b beside the arm's plane.
        front = np.array([1.0, -1.0])[:, None, None]
        rho2 = x * x + y * y
        r2 = rho2 - b * b
        r = front * np.sqrt(
            np.where(r2 >= -2 * ROUNDING * abs(b) * self.reach, np.maximum(r2, 0), np.nan)
        )
        free = rho2 <= (FREE * self.reach) ** 2
        cos1 = np.where(free, front, (x * r + y * b) / rho2)
        # no minus zero: half a turn is +pi
        sin1 = np.where(free, 0.0, (y * r - x * b) / rho2) + 0.0

        # Joints 2 and 3: a triangle of upper arm, forearm and the line from shoulder to point.
        elbow = self.sign3 * np.array([1.0, -1.0])[:, None]
        u, w = r - a, z - c
        cos_g = (u * u + w * w - (upper**2 + fore**2)) / (2 * upper * fore)
        # cosine per reach
        unit = np.where(cos_g > 0, upper + fore, abs(upper - fore)) * self.reach / (upper * fore)
        beyond = abs(cos_g) - 1  # above 0 outside the stretched or inside the folded arm
        cos_g = np.where(abs(beyond) <= STRAIGHT * unit + EPS, np.sign(cos_g), cos_g)
        cos_g = np.where(beyond <= ROUNDING * unit + EPS, np.clip(cos_g, -1, 1), np.nan)
        sin_g = elbow * np.sqrt((1 - cos_g) * (1 + cos_g))
        along, across = upper + fore * cos_g, fore * sin_g
        # upper arm above the horizon
        cos_a, sin_a = _unit(along * u + across * w, along * w - across * u)
        # forearm above the horizon
        cos_b, sin_b = cos_a * cos_g - sin_a * sin_g, sin_a * cos_g + cos_a * sin_g

        exists = np.where(np.isnan(cos_g), np.nan, 0.0)
        q[0] = np.arctan2(self.sign1 * sin1, cos1) + exists
        cos2, sin2 = turned(cos_a, sin_a, -self.upper_angle)
        q[1] = np.arctan2(self.sign2 * sin2, cos2)
        cos3, sin3 = turned(cos_g, sin_g, self.upper_angle - self.fore_angle)
        q[2] = np.arctan2(self.sign3 * sin3, cos3)
        return (cos1, sin1), (cos_b, sin_b)

    def radius(self, q):
        """How far in front of axis 1 the point is at q (..., 3 or more): negative behind it."""
        elevation = self.upper_angle + self.sign2 * q[..., 1]
        return (
            self.shoulder_x
            + self.upper * np.cos(elevation)
            + self.fore * np.cos(elevation + self.bend(q))
        )

    def bend(self, q):
        """The angle of the forearm above the upper arm's direction at q (..., 3 or more)."""
        return self.fore_angle - self.upper_angle + self.sign3 * q[..., 2]

    def singular(self, q):
        """dict of name -> bool (...): shoulder, the point on axis 1 or as near as it comes (within
        1e-6 of the reach); elbow, the arm stretched or folded (within 1e-6 rad).
        """
        return {
            "shoulder": abs(self.radius(q)) < 1e-6 * self.reach,
            "elbow": abs(np.sin(self.bend(q))) < 1e-6,
        }

    def unreached(self, point, front):
        """Why no row with the flag `front` (+-1) holds one single point (3,), in words, and by how
        many metres.
        """
        rho, slack = np.hypot(*point[:2]), ROUNDING * self.reach
        if rho < abs(self.lateral) - slack:
            gap = abs(self.lateral) - rho
            return f"the {self.what} is {in_words(gap)} too near to axis 1", gap
        r = front * max(rho**2 - self.lateral**2, 0.0) ** 0.5
        d = np.hypot(r - self.shoulder_x, point[2] - self.shoulder_z)
        longest, shortest = self.upper + self.fore, abs(self.upper - self.fore)
        if d > longest + slack:
            return (
                f"the {self.what} is {in_words(d - longest)} beyond the stretched arm",
                d - longest,
            )
        if d < shortest - slack:
            return f"the {self.what} is {in_words(shortest - d)} too near to joint 2", shortest - d
        return "", 0.0


def home(links):
    """A point on each joint's axis (n, 3), the axes (n, 3) and the flange, in base coordinates at q
    = 0.
    """
    frame, points, axes = Transform(), [], []
    for link in links:
        joint = frame @ link.before
        points.append(joint.translation)
        axes.append(joint.rotation @ np.asarray(link.axis, dtype=float))
        frame = joint @ link.after
    return points, axes, frame


def parallel(name, number, axis, along):
    """ValueError unless the axis is parallel to x, y or z (along 0, 1, 2)."""
    if abs(abs(axis[along]) - 1) > 1e-9:
        raise ValueError(
            f"{name}: wanted axis {number} parallel to {'xyz'[along]}, got {axis} at q = 0"
        )


def turned(cosine, sine, angle):
    """The pair (cosine, sine) of an angle, turned on by a constant angle."""
    c, s = np.cos(angle), np.sin(angle)
    return cosine * c - sine * s, sine * c + cosine * s


def in_words(length):
    """A length in metres, for a sentence."""
    return f"{length * 1000:.1f} mm" if length < 10 else f"{length:.1f} m"


def _unit(x, y):
    """(x, y) at length 1, and (1, 0) for no length: equal levers, folded, leave joint 2 free."""
    length = np.sqrt(x * x + y * y)
    return np.where(length == 0, 1.0, x / length), np.where(length == 0, 0.0, y / length)


def _point(pose):
    return pose.translation if isinstance(pose, Transform) else floats(pose, "points", 3)
