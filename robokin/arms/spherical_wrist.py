"""Six-axis arms with a spherical wrist and eight closed-form solutions.

The three wrist axes meet at one point, the wrist centre. It does not move when joints 4 to 6 turn,
so the problem splits in two: position the wrist centre with joints 1 to 3, then orient the tool
with joints 4 to 6.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from .._arrays import ArrayLike, Bools, Floats, Sealed, by_blocks
from .._validate import instance
from ..quaternion import Quaternion, cross, hamilton, matrix_rows
from ..transform import Transform
from ..units import wrapped
from .arm import ClosedFormArm
from .elbow import Elbow, parallel, rotated
from .geometry import SINGULAR, Gap, flags
from .link import Link, chain, home

# if |sin q5| is below this, rounding errors dominate the angle of joint 4, which counts as free
FREE = 1e-13
# if |sin q5| is below this, rounding errors in the pose can change joint 4 noticeably, and
# `choose_free_joints` chooses its angle
NOISY = 1e-9


def spherical_wrist(
    name: str,
    links: Iterable[Link],
    limits: ArrayLike,
    speed_limits: ArrayLike | None = None,
) -> ClosedFormArm:
    """An arm of six revolute links with a spherical wrist. Its geometry is computed from the links
    at q = 0.

    At q = 0, in base coordinates, axis 1 must lie on the z axis, axes 2, 3 and 5 must be parallel
    to the y axis, and axes 4 to 6 must meet at one point, with 4 parallel to 6. The signs and
    offsets of the joints follow from the links. Raises ValueError for any other arrangement of the
    axes; the message names the axis.
    """
    return ClosedFormArm(name, SphericalWristGeometry(links), limits, speed_limits)


@dataclass(frozen=True, init=False, repr=False, eq=False)
class SphericalWristGeometry(Sealed):
    """Six links with a spherical wrist, and their inverse (see `spherical_wrist`).

    The configuration flags, +1 or -1, say whether the wrist centre is in front of axis 1 or behind
    it (at q1 = 0, the front is the +x side), whether joint 3 is above or below its value in the
    fully extended arm, and which sign joint 5 has. Source: 001, listing 1, with errata S1-c (obtuse
    shoulder) and S1-d (singular wrist) corrected; 004, section 3.
    """

    branches = flags(3)
    target = Transform
    carried = "the wrist centre"
    links: tuple[Link, ...]
    elbow: Elbow = field(init=False)
    wrist: "Wrist" = field(init=False)
    reach: float = field(init=False)

    @np.errstate(over="ignore", invalid="ignore")  # squares of huge lengths overflow
    def __init__(self, links: Iterable[Link]) -> None:
        links = chain(links)
        if len(links) != 6 or any(link.prismatic for link in links):
            raise ValueError(f"links: wanted six revolute links, got {len(links)}")
        points, axes, flange = home(links)
        wrist, centre = Wrist.measured(points[3:], axes[3:], flange)
        elbow = Elbow.measured(points[:3], axes[:3], centre, self.carried)
        vars(self).update(links=links, elbow=elbow, wrist=wrist, reach=elbow.reach)

    def ik(self, pose: Any) -> Floats:
        """See `ClosedFormArm.ik`: Transform of shape (...) -> (..., 8, 6)."""
        instance(pose, Transform, "pose", hint=" (Transform.from_matrix takes a 4 x 4 array)")
        columns = pose.rotation.wxyz.reshape(-1, 4), pose.translation.reshape(-1, 3)
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            q = by_blocks(self._solve, *columns, rest=(2, 2, 2))
        return np.moveaxis(q.reshape(6, 8, *pose.shape), (0, 1), (-1, -2))

    def _solve(self, rotation: Sequence[Floats], origin: Sequence[Floats]) -> list[Any]:
        """The six joint values for poses (N,). Each is a pair of arrays (front/back, elbow, N), one
        for each of the two wrist solutions.
        """
        wrist = self.wrist

        # Joints 1 to 3 position the wrist centre.
        tool, centre = wrist.at(rotation, origin)
        first, (cos1, sin1), fore = self.elbow.solve(*centre)

        # Joints 4 to 6 orient the wrist's frame, which is fixed to the tool, relative to the
        # forearm. Axis 4, on the forearm, has a forward component ce and an upward component se.
        ce, se = rotated(*fore, wrist.axis4 - self.elbow.fore_angle)
        ahead = [cos1 * tool[0][k] + sin1 * tool[1][k] for k in range(3)]
        aside = [wrist.sign5 * (cos1 * tool[1][k] - sin1 * tool[0][k]) for k in range(3)]
        below = [wrist.sign5 * (se * ahead[k] - ce * tool[2][k]) for k in range(3)]
        cos5 = ce * ahead[2] + se * tool[2][2]
        sin5 = np.sqrt(below[2] * below[2] + aside[2] * aside[2])
        stuck = sin5 < FREE
        cos4 = np.where(stuck, 1.0, below[2] / sin5)
        sin4 = np.where(stuck, 0.0, aside[2] / sin5)
        sin5 = np.where(stuck, 0.0, sin5)
        # Joint 4 determines axis 5; joint 6 is the angle from axis 5 to the tool. Near the
        # singularity, this keeps the orientation correct even though the value of joint 4 is
        # dominated by rounding errors (errata S1-d).
        sin6 = wrist.sign6 * (cos4 * aside[0] - sin4 * below[0])
        cos6 = cos4 * aside[1] - sin4 * below[1]
        q4, q5, q6 = np.arctan2(sin4, cos4), np.arctan2(sin5, cos5), np.arctan2(sin6, cos6)

        # In the other wrist solution, joint 5 has the opposite sign, and joints 4 and 6 are half a
        # turn further. A singular wrist has only one solution.
        other = [q4 - np.copysign(np.pi, q4), -q5, q6 - np.copysign(np.pi, q6)]
        if stuck.any():
            pairs = zip((q4, q5, q6), other, strict=True)
            other = [np.where(stuck, one, two) for one, two in pairs]
        same = [(q_i, q_i) for q_i in first]
        return [*same, *zip((q4, q5, q6), other, strict=True)]

    def gap(self, pose: Any, row: int) -> Gap:
        """The reason why a single pose has no solution in this row."""
        flange = pose.rotation.wxyz.tolist(), pose.translation.tolist()
        _, centre = self.wrist.at(*flange)
        return self.elbow.gap(centre, self.branches[row, 0])

    def singularities(self, q: Floats) -> dict[str, Bools]:
        """Return whether each singularity occurs at q (..., 6): those of `Elbow.singularities`, and
        "wrist", at which axes 4 and 6 are in line (within 1e-6 rad).
        """
        return self.elbow.singularities(q) | {"wrist": abs(np.sin(q[..., 4])) < SINGULAR}

    def choose_free_joints(self, q: Floats, previous: Floats) -> Floats:
        """Return rows q (..., 6) in which the joints that a wrist singularity leaves free turn as
        little as possible from `previous`.

        At this singularity, only the sum of joints 4 and 6 matters (their difference if joint 5 is
        pi); each of them takes half of the rotation.
        """
        stuck = abs(np.sin(q[..., 4])) < NOISY
        if not stuck.any():
            return q
        sense = self.wrist.sign6 * np.where(np.cos(q[..., 4]) > 0, 1.0, -1.0)
        turn = q[..., 3] - previous[..., 3] + sense * (q[..., 5] - previous[..., 5])
        half = wrapped(turn) / 2
        out = q.copy()
        out[..., 3] = np.where(stuck, previous[..., 3] + half, q[..., 3])
        out[..., 5] = np.where(stuck, previous[..., 5] + sense * half, q[..., 5])
        return out


class Wrist(NamedTuple):
    """The dimensions of the last three joints, computed from the links at q = 0.

    sign5, sign6  +1 or -1: axis 5 points along +y or -y, axis 6 along or against axis 4
    axis4         the angle of axis 4 above the horizontal
    from_flange   the quaternion w, x, y, z from the flange to the wrist's own frame, in which axis
                  5 is y and axis 4 is z
    centre_from_flange  the vector x, y, z from the flange to the wrist centre, in the wrist's own
                        frame
    """

    sign5: float
    sign6: float
    axis4: float
    from_flange: tuple[float, ...]
    centre_from_flange: tuple[float, ...]

    @classmethod
    def measured(cls, points: Floats, axes: Floats, flange: Transform) -> tuple["Wrist", Floats]:
        """Compute the dimensions of a wrist from a point on each of the axes 4 to 6, the directions
        of the axes, and the flange. Also return the wrist centre. Raises ValueError if an axis does
        not have the direction that `spherical_wrist` requires.
        """
        (e4, e5, e6), (p4, p5, p6) = axes, points
        parallel(5, e5, 1)
        _need(abs(e4[1]) < 1e-9, "axis 4 perpendicular to axis 5, got {}", e4)
        _need(abs(abs(e4 @ e6) - 1) < 1e-9, "axis 6 parallel to axis 4, got {}", e6)
        centre = p4 + ((p5 - p4) @ e4) * e4  # the foot of the perpendicular from p5 to axis 4
        for number, point, axis in ((5, p5, e5), (6, p6, e6)):
            beside = np.linalg.norm(cross(centre - point, axis))
            met = "axis {} through {}, got it {:.3g} m away"
            _need(beside < 1e-9, met, number, centre, beside)
        frame = Quaternion.from_matrix(np.stack([cross(e5, e4), e5, e4], axis=-1))
        wrist = cls(
            sign5=float(np.sign(e5[1])),
            sign6=float(np.sign(e4 @ e6)),
            axis4=float(np.arctan2(e4[2], e4[0])),
            from_flange=tuple((flange.rotation.inverse() @ frame).wxyz.tolist()),
            centre_from_flange=tuple((frame.inverse() @ (centre - flange.translation)).tolist()),
        )
        return wrist, centre

    def at(self, rotation: Sequence[Any], origin: Sequence[Any]) -> tuple[Any, list[Any]]:
        """For a flange given as components, return the rows of the matrix of the wrist's own frame,
        and the wrist centre, which is fixed to the flange.
        """
        rows = matrix_rows(hamilton(rotation, self.from_flange))
        cx, cy, cz = self.centre_from_flange
        steps = zip(origin, rows, strict=True)
        return rows, [o + row[0] * cx + row[1] * cy + row[2] * cz for o, row in steps]


def _need(true: Any, wanted: str, *got: object) -> None:
    if not true:
        raise ValueError(f"links: wanted {wanted.format(*got)} at q = 0")
