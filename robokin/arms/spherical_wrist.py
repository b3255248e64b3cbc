"""Six-axis arms with a spherical wrist: all eight solutions in closed form.

The three wrist axes meet in one point, the wrist centre. It does not move when joints 4 to 6 turn,
so the problem falls apart in two: bring the wrist centre to its place with joints 1 to 3, then turn
the tool with joints 4 to 6.
"""

from functools import cached_property

import numpy as np

from .._validate import instance
from ..quaternion import Quaternion
from ..transform import Transform
from .arm import Arm
from .elbow import Elbow, home, parallel, turned

FREE = 1e-13  # below this sine of joint 5 the angle of joint 4 is noise, and the joint is free
# below this sine of joint 5 rounding of the pose itself can turn joint 4: a motion chooses it
NOISY = 1e-9
BLOCK = 2048  # poses solved at a time, so that the work stays in the processor's cache


def spherical_wrist(name, links, limits, speed_limits=None):
    """An `Arm` of six revolute links with a spherical wrist; its geometry is read from the links at
    q = 0.

    Wanted at q = 0, in base coordinates: axis 1 on the z axis; axes 2, 3 and 5 parallel to the y
    axis; axes 4 to 6 meeting in one point, 4 parallel to 6. Signs and offsets of the joints follow
    from the links. ValueError otherwise, naming the axis.
    """
    geometry = SphericalWrist(name, links)
    geometry.wrist  # noqa: B018  (measured now, so that a wrong chain is reported here)
    return Arm(name, geometry.links, geometry, limits, speed_limits)


class SphericalWrist:
    """The inverse of six links with a spherical wrist (see `spherical_wrist`).

    Configuration flags, +1 or -1: the wrist centre in front of or behind axis 1 (front is the side
    of +x at q1 = 0); joint 3 on the positive or negative side of the stretched arm; joint 5
    positive or negative.
    Source: 001, listing 1, with errata S1-c (obtuse shoulder) and S1-d (singular wrist) put right;
    004, section 3.
    """

    branches = np.array([(i, j, k) for i in (1, -1) for j in (1, -1) for k in (1, -1)])

    def __init__(self, name, links):
        self.name, self.links = name, tuple(links)

    @cached_property
    def wrist(self):
        """The geometry, measured when it is first asked for; that of the first three joints is
        `wrist.elbow`.
        """
        return Wrist(self.name, self.links)

    def ik(self, pose):
        """See `Arm.ik`: Transform of shape (...) -> (..., 8, 6)."""
        instance(pose, Transform, "pose", hint=" (Transform.from_matrix takes a 4 x 4 array)")
        # each component in one long run in memory
        wxyz = np.asfortranarray(pose.rotation.wxyz.reshape(-1, 4))
        translation = np.asfortranarray(pose.translation.reshape(-1, 3))
        # joint, front/back, elbow, wrist, pose: long runs in memory
        q = np.empty((6, 2, 2, 2, len(translation)))
        with np.errstate(invalid="ignore", divide="ignore"):
            for i in range(0, len(translation), BLOCK):
                block = slice(i, i + BLOCK)
                self._solve(
                    Transform._of(Quaternion._of(wxyz[block]), translation[block]), q[..., block]
                )
        return np.moveaxis(q.reshape(6, 8, *pose.shape), (0, 1), (-1, -2))

    def _solve(self, pose, q):
        """Fill q (6, 2, 2, 2, N)."""
        wrist = self.wrist

        # The wrist centre lies at a fixed place in the flange: step back to it. Joints 1 to 3 bring
        # it to its place.
        tool = (pose.rotation @ wrist.from_flange)._rows()
        cx, cy, cz = wrist.centre_from_flange
        x, y, z = (
            pose.translation[:, i] + row[0] * cx + row[1] * cy + row[2] * cz
            for i, row in enumerate(tool)
        )
        (cos1, sin1), fore = wrist.elbow.solve(x, y, z, q[:3, :, :, 0])
        q[:3, :, :, 1] = q[:3, :, :, 0]

        # Joints 4 to 6: the wrist's frame at the tool, seen from the forearm. Its axis 4 points ce
        # ahead, se up.
        ce, se = turned(*fore, wrist.axis4_from_fore)
        ahead = [cos1 * tool[0][k] + sin1 * tool[1][k] for k in range(3)]
        aside = [wrist.sign5 * (cos1 * tool[1][k] - sin1 * tool[0][k]) for k in range(3)]
        below = [wrist.sign5 * (se * ahead[k] - ce * tool[2][k]) for k in range(3)]
        cos5 = ce * ahead[2] + se * tool[2][2]
        sin5 = np.sqrt(below[2] * below[2] + aside[2] * aside[2])
        stuck = sin5 < FREE
        cos4 = np.where(stuck, 1.0, below[2] / sin5)
        sin4 = np.where(stuck, 0.0, aside[2] / sin5)
        sin5 = np.where(stuck, 0.0, sin5)
        # Axis 5 is known with joint 4; joint 6 is the angle from it to the tool. Near the
        # singularity this keeps the orientation right although joint 4 is noise (errata S1-d).
        sin6 = wrist.sign6 * (cos4 * aside[0] - sin4 * below[0])
        cos6 = cos4 * aside[1] - sin4 * below[1]

        # The other wrist: joint 5 the other way, joints 4 and 6 half a turn on. A stuck wrist has
        # but one row.
        q4, q5, q6 = np.arctan2(sin4, cos4), np.arctan2(sin5, cos5), np.arctan2(sin6, cos6)
        q[3, :, :, 0], q[4, :, :, 0], q[5, :, :, 0] = q4, q5, q6
        q[3, :, :, 1], q[4, :, :, 1], q[5, :, :, 1] = (
            q4 - np.copysign(np.pi, q4),
            -q5,
            q6 - np.copysign(np.pi, q6),
        )
        if stuck.any():
            q[3:, :, :, 1] = np.where(stuck, q[3:, :, :, 0], q[3:, :, :, 1])

    def unreached(self, pose, row):
        """Why `row` does not exist for one single pose, in words, and by how many metres; ("", 0.0)
        if it exists.
        """
        centre = (
            pose.translation
            + pose.rotation @ self.wrist.from_flange @ self.wrist.centre_from_flange
        )
        return self.wrist.elbow.unreached(centre, self.branches[row][0])

    def singular(self, q):
        """Which singularities hold at q (..., 6): dict of name -> bool (...). As `Elbow.singular`,
        and wrist: axes 4 and 6 in one line (within 1e-6 rad).
        """
        return self.wrist.elbow.singular(q) | {"wrist": abs(np.sin(q[..., 4])) < 1e-6}

    def settle(self, q, previous):
        """Rows q (..., 6) with what a wrist singularity leaves free chosen for the least turn from
        `previous`.

        There only the sum of joints 4 and 6 counts (the difference where joint 5 is pi); each takes
        half of the turn.
        """
        stuck = abs(np.sin(q[..., 4])) < NOISY
        if not stuck.any():
            return q
        sense = self.wrist.sign6 * np.where(np.cos(q[..., 4]) > 0, 1.0, -1.0)
        turn = q[..., 3] - previous[..., 3] + sense * (q[..., 5] - previous[..., 5])
        half = (turn - 2 * np.pi * np.round(turn / (2 * np.pi))) / 2
        out = q.copy()
        out[..., 3] = np.where(stuck, previous[..., 3] + half, q[..., 3])
        out[..., 5] = np.where(stuck, previous[..., 5] + sense * half, q[..., 5])
        return out


class Wrist:
    """The last three joints, measured on the links at q = 0."""

    def __init__(self, name, links):
        def need(true, what):
            if not true:
                raise ValueError(f"{name}: {what} at q = 0")

        need(
            len(links) == 6 and not any(link.prismatic for link in links),
            "wanted six revolute links",
        )
        points, axes, flange = home(links)
        (e4, e5, e6), (p4, p5, p6) = axes[3:], points[3:]
        parallel(name, 5, e5, 1)
        need(abs(e4[1]) < 1e-9, f"wanted axis 4 square to axis 5, got {e4}")
        need(abs(abs(e4 @ e6) - 1) < 1e-9, f"wanted axis 6 parallel to axis 4, got {e6}")
        centre = p4 + ((p5 - p4) @ e4) * e4  # axis 5 is square to axis 4: its foot on axis 4
        for number, point, axis in ((5, p5, e5), (6, p6, e6)):
            need(
                np.linalg.norm(np.cross(centre - point, axis)) < 1e-9,
                f"wanted axis {number} through {centre}",
            )

        self.elbow = Elbow(name, points[:3], axes[:3], centre, "wrist centre")
        self.sign5, self.sign6 = np.sign(e5[1]), np.sign(e4 @ e6)
        self.axis4_from_fore = np.arctan2(e4[2], e4[0]) - self.elbow.fore_angle
        # axis 5 is y, axis 4 is z
        frame = Quaternion.from_matrix(np.stack([np.cross(e5, e4), e5, e4], axis=-1))
        self.from_flange = flange.rotation.inverse() @ frame
        # in the wrist's own frame
        self.centre_from_flange = frame.inverse() @ (centre - flange.translation)
