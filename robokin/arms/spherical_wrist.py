"""Six-axis arms with a spherical wrist: all eight solutions in closed form.

The three wrist axes meet in one point, the wrist centre. It does not move when joints 4 to 6 turn, so the problem
falls apart in two: bring the wrist centre to its place with joints 1 to 3, then turn the tool with joints 4 to 6.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .._validate import instance
from ..quaternion import Quaternion
from ..transform import Transform
from .arm import Arm

ROUNDING = 1e-12  # a cosine this far beyond 1 is rounding, and the arm is stretched
FREE = 1e-13  # below this sine of joint 5, or share of the reach, a joint's angle is noise, and the joint is free


def spherical_wrist(name, links, limits, speed_limits=None):
    """An `Arm` of six revolute links with a spherical wrist; its geometry is read from the links at q = 0.

    Wanted at q = 0, in base coordinates: axis 1 on the z axis; axes 2, 3 and 5 parallel to the y axis; axes 4 to 6
    meeting in one point, 4 parallel to 6. Signs and offsets of the joints follow from the links. ValueError
    otherwise, naming the axis.
    """
    return Arm(name, tuple(links), SphericalWrist(name, tuple(links)), limits, speed_limits)


@dataclass(frozen=True, eq=False)
class SphericalWrist:
    """The inverse of six links with a spherical wrist (see `spherical_wrist`).

    Configuration flags, +1 or -1: the wrist centre in front of or behind axis 1 (front is the side of +x at q1 = 0);
    joint 3 on the positive or negative side of the stretched arm; joint 5 positive or negative.
    Source: 001, listing 1, with errata S1-c (obtuse shoulder) and S1-d (singular wrist) put right; 004, section 3.
    """

    name: str
    links: tuple

    branches = np.array([(i, j, k) for i in (1, -1) for j in (1, -1) for k in (1, -1)])

    def __post_init__(self):
        self._home  # noqa: B018  (a wrong chain is reported when the arm is built)

    @cached_property
    def _home(self):
        return _Home(self.name, self.links)

    def ik(self, pose):
        """See `Arm.ik`: Transform of shape (...) -> (..., 8, 6)."""
        instance(pose, Transform, "pose", hint=" (Transform.from_matrix takes a 4 x 4 array)")
        shape, pose = pose.shape, _flat(pose)
        with np.errstate(invalid="ignore", divide="ignore"):
            q = self._solve(pose)
        return np.moveaxis(q.reshape(8, -1, 6), 0, -2).reshape(*shape, 8, 6)

    def _solve(self, pose):
        """Joint values (2, 2, 2, N, 6): front/back, elbow, wrist. Angles first live as pairs (cosine, sine), so that
        only the joint values themselves need an arctangent.
        """
        home = self._home
        a, b, c = home.shoulder_x, home.lateral, home.shoulder_z
        upper, fore = home.upper, home.fore

        # The wrist centre lies at a fixed place in the flange: step back to it.
        tool = (pose.rotation @ home.flange_wrist)._rows()
        x, y, z = np.moveaxis(pose.translation + pose.rotation @ home.flange_centre, -1, 0)

        # Joint 1: seen from above, the wrist centre is r in front of axis 1 and b beside the arm's plane.
        front = np.array([1.0, -1.0])[:, None, None]
        rho2 = x * x + y * y
        r2 = rho2 - b * b
        r = front * np.sqrt(np.where(abs(r2) <= ROUNDING * b * b, 0.0, r2))
        free = rho2 <= (FREE * home.reach) ** 2
        cos1 = np.where(free, front, (x * r + y * b) / rho2)
        sin1 = np.where(free, 0.0, (y * r - x * b) / rho2)

        # Joints 2 and 3: a triangle of upper arm, forearm and the line from shoulder to wrist centre.
        elbow = home.sign3 * np.array([1.0, -1.0])[:, None]
        u, w = r - a, z - c
        d2 = u * u + w * w
        cos_g = (d2 - upper**2 - fore**2) / (2 * upper * fore)
        cos_g = np.where(abs(cos_g) <= 1 + ROUNDING, np.clip(cos_g, -1, 1), np.nan)
        sin_g = elbow * np.sqrt((1 - cos_g) * (1 + cos_g))
        along, across = upper + fore * cos_g, fore * sin_g
        cos_a, sin_a = (along * u + across * w) / d2, (along * w - across * u) / d2  # upper arm above the horizon
        cos_b, sin_b = cos_a * cos_g - sin_a * sin_g, sin_a * cos_g + cos_a * sin_g  # forearm above the horizon

        # Joints 4 to 6: the wrist's frame at the tool, seen from the forearm. Its axis 4 points ce ahead, se up.
        ce, se = _turn(cos_b, sin_b, home.axis4_from_fore)
        ahead = [cos1 * tool[0][k] + sin1 * tool[1][k] for k in range(3)]
        aside = [home.sign5 * (cos1 * tool[1][k] - sin1 * tool[0][k]) for k in range(3)]
        below = [home.sign5 * (se * ahead[k] - ce * tool[2][k]) for k in range(3)]
        m33 = ce * ahead[2] + se * tool[2][2]
        sin5 = np.hypot(below[2], aside[2])
        stuck = sin5 < FREE
        cos4 = np.where(stuck, 1.0, below[2] / sin5)
        sin4 = np.where(stuck, 0.0, aside[2] / sin5)
        # Axis 5 is known with joint 4; joint 6 is the angle from it to the tool. Near the singularity this keeps the
        # orientation right although joint 4 is noise (errata S1-d).
        sin6 = home.sign6 * (cos4 * aside[0] - sin4 * below[0])
        cos6 = cos4 * aside[1] - sin4 * below[1]

        q = np.empty((2, 2, 2, len(x), 6))
        exists = np.where(np.isnan(cos_g), np.nan, 0.0)
        q[..., 0] = (np.arctan2(home.sign1 * sin1, cos1) + exists)[:, :, None]
        cos2, sin2 = _turn(cos_a, sin_a, -home.upper_angle)
        q[..., 1] = np.arctan2(home.sign2 * sin2, cos2)[:, :, None]
        cos3, sin3 = _turn(cos_g, sin_g, home.upper_angle - home.fore_angle)
        q[..., 2] = np.arctan2(home.sign3 * sin3, cos3)[:, :, None]
        q4, q5, q6 = np.arctan2(sin4, cos4), np.arctan2(np.where(stuck, 0, sin5), m33), np.arctan2(sin6, cos6)
        q[:, :, 0, :, 3], q[:, :, 0, :, 4], q[:, :, 0, :, 5] = q4, q5, q6
        q[:, :, 1, :, 3] = np.where(stuck, q4, q4 - np.copysign(np.pi, q4))
        q[:, :, 1, :, 4] = np.where(stuck, q5, -q5)
        q[:, :, 1, :, 5] = np.where(stuck, q6, q6 - np.copysign(np.pi, q6))
        return q

    def unreached(self, pose, row):
        """Why `row` does not exist for one single pose, in words, and by how many metres; ("", 0.0) if it exists."""
        home = self._home
        centre = pose.translation + pose.rotation @ home.flange_centre
        rho2 = centre[0] ** 2 + centre[1] ** 2
        if rho2 - home.lateral**2 < -ROUNDING * home.lateral**2:
            gap = abs(home.lateral) - rho2**0.5
            return f"the wrist centre is {_mm(gap)} too near to axis 1", gap
        r = self.branches[row][0] * max(rho2 - home.lateral**2, 0.0) ** 0.5
        d = np.hypot(r - home.shoulder_x, centre[2] - home.shoulder_z)
        longest, shortest = home.upper + home.fore, abs(home.upper - home.fore)
        if d > longest * (1 + ROUNDING):
            return f"the wrist centre is {_mm(d - longest)} beyond the stretched arm", d - longest
        if d < shortest * (1 - ROUNDING):
            return f"the wrist centre is {_mm(shortest - d)} too near to joint 2", shortest - d
        return "", 0.0

    def singular(self, q):
        """Which singularities hold at q (..., 6): dict of name -> bool (...).

        shoulder: wrist centre on axis 1 (within 1e-6 of the reach); elbow: arm stretched or folded; wrist: axes 4 and
        6 in one line (both within 1e-6 rad).
        """
        home = self._home
        elevation = home.upper_angle + home.sign2 * q[..., 1]
        bend = home.fore_angle - home.upper_angle + home.sign3 * q[..., 2]
        r = home.shoulder_x + home.upper * np.cos(elevation) + home.fore * np.cos(elevation + bend)
        return {"shoulder": abs(r) < 1e-6 * home.reach,
                "elbow": abs(np.sin(bend)) < 1e-6,
                "wrist": abs(np.sin(q[..., 4])) < 1e-6}

    def settle(self, q, previous):
        """Rows q (..., 6) with what a wrist singularity leaves free chosen for the least turn from `previous`.

        There only the sum of joints 4 and 6 counts (the difference where joint 5 is pi); each takes half of the turn.
        """
        stuck = abs(np.sin(q[..., 4])) < FREE
        sense = self._home.sign6 * np.where(np.cos(q[..., 4]) > 0, 1.0, -1.0)
        turn = q[..., 3] - previous[..., 3] + sense * (q[..., 5] - previous[..., 5])
        half = (turn - 2 * np.pi * np.round(turn / (2 * np.pi))) / 2
        out = q.copy()
        out[..., 3] = np.where(stuck, previous[..., 3] + half, q[..., 3])
        out[..., 5] = np.where(stuck, previous[..., 5] + sense * half, q[..., 5])
        return out


class _Home:
    """The numbers of the inverse, measured on the links at q = 0."""

    def __init__(self, name, links):
        def need(true, what):
            if not true:
                raise ValueError(f"{name}: {what} at q = 0")

        need(len(links) == 6 and not any(link.prismatic for link in links), "wanted six revolute links")
        frame, points, axes = Transform(), [], []
        for link in links:
            joint = frame @ link.before
            points.append(joint.translation)
            axes.append(joint.rotation @ np.asarray(link.axis, dtype=float))
            frame = joint @ link.after
        (e1, e2, e3, e4, e5, e6), (p1, p2, p3, p4, p5, p6) = axes, points
        for number, axis, along in ((1, e1, 2), (2, e2, 1), (3, e3, 1), (5, e5, 1)):
            need(abs(abs(axis[along]) - 1) < 1e-9, f"wanted axis {number} parallel to {'xyz'[along]}, got {axis}")
        need(np.hypot(*p1[:2]) < 1e-9, f"wanted axis 1 through the origin, got it through {p1}")
        need(abs(e4[1]) < 1e-9, f"wanted axis 4 square to axis 5, got {e4}")
        need(abs(abs(e4 @ e6) - 1) < 1e-9, f"wanted axis 6 parallel to axis 4, got {e6}")
        centre = p4 + ((p5 - p4) @ e4) * e4  # axis 5 is square to axis 4: its foot on axis 4
        for number, point, axis in ((5, p5, e5), (6, p6, e6)):
            need(np.linalg.norm(np.cross(centre - point, axis)) < 1e-9, f"wanted axis {number} through {centre}")

        self.sign1, self.sign5, self.sign6 = np.sign(e1[2]), np.sign(e5[1]), np.sign(e4 @ e6)
        self.sign2, self.sign3 = -np.sign(e2[1]), -np.sign(e3[1])  # a turn about +y lowers what points ahead
        self.shoulder_x, self.shoulder_z, self.lateral = p2[0], p2[2], centre[1]
        (ux, _, uz), (fx, _, fz) = p3 - p2, centre - p3
        self.upper, self.upper_angle = np.hypot(ux, uz), np.arctan2(uz, ux)
        self.fore, self.fore_angle = np.hypot(fx, fz), np.arctan2(fz, fx)
        self.axis4_from_fore = np.arctan2(e4[2], e4[0]) - self.fore_angle
        self.reach = abs(self.shoulder_x) + self.upper + self.fore
        wrist = Quaternion.from_matrix(np.stack([np.cross(e5, e4), e5, e4], axis=-1))  # axis 5 is y, axis 4 is z
        self.flange_wrist = frame.rotation.inverse() @ wrist
        self.flange_centre = frame.rotation.inverse() @ (centre - frame.translation)


def _turn(cosine, sine, angle):
    """The pair (cosine, sine) of an angle, turned on by a constant angle."""
    c, s = np.cos(angle), np.sin(angle)
    return cosine * c - sine * s, sine * c + cosine * s


def _flat(pose):
    return Transform._of(Quaternion._of(pose.rotation.wxyz.reshape(-1, 4)), pose.translation.reshape(-1, 3))


def _mm(length):
    return f"{length * 1000:.1f} mm"
