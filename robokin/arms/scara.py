"""SCARA arms: two parallel levers, a turning tool and a vertical stroke; two solutions in closed
form.
"""

from dataclasses import dataclass

import numpy as np

from .._validate import broadcast, floats, instance
from ..quaternion import Batch, Quaternion, rounded
from ..transform import Transform
from .arm import Arm, Link
from .elbow import ROUNDING, in_words

X, Y, Z = np.eye(3)


@dataclass(frozen=True, eq=False, repr=False)
class Target(Batch):
    """What a SCARA can be asked for: `position` (..., 3) in metres and the tool's `angle` (...)
    about the vertical.

    The angle is in radians and not wrapped: from 0 to pi is a half turn to the left, from 0 to -pi
    one to the right, and 3 pi is one and a half turns. A rotation cannot tell these apart (errata
    S1-t).
    Source: 001, listings 4 and 12.
    """

    position: np.ndarray
    angle: np.ndarray = 0.0

    def __post_init__(self):
        position, angle = floats(self.position, "position", 3), floats(self.angle, "angle")
        shape = broadcast("position and angle", position.shape[:-1], angle.shape)
        object.__setattr__(self, "position", np.broadcast_to(position, (*shape, 3)))
        object.__setattr__(self, "angle", np.broadcast_to(angle, shape))

    @property
    def shape(self):
        """The batch shape."""
        return self.angle.shape

    def __getitem__(self, index):
        index = index if isinstance(index, tuple) else (index,)
        return Target(self.position[(*index, slice(None))], self.angle[index])

    def lerp(self, goal, s):
        """On the way from here (s = 0) to `goal` (s = 1): position and angle both linear; s (...)
        is broadcast.
        """
        instance(goal, Target, "goal")
        s = floats(s, "s")
        return Target(
            self.position + (goal.position - self.position) * s[..., None],
            self.angle + (goal.angle - self.angle) * s,
        )

    def as_transform(self):
        """The flange pose: the tool's z axis keeps pointing up (errata S1-r)."""
        return Transform(Quaternion.from_angle_axis(self.angle, Z), self.position)

    def __repr__(self):
        if self.shape:
            return f"Target(shape={self.shape})"
        return f"Target(position={rounded(self.position)}, angle={rounded(self.angle)})"


def scara(name, height, upper, fore, limits, speed_limits=None):
    """A SCARA `Arm`: joints 1 to 3 turn about vertical axes, joint 4 lowers the tool from `height`.
    Lengths in m.

    q = 0 stretches the arm along x with the tool at `height`. `ik` takes a Target or a Transform.
    Source: 001, listings 4 and 12.
    """
    links = (
        Link(Transform(translation=(0, 0, height)), Z),
        Link(Transform(translation=(upper, 0, 0)), Z),
        Link(Transform(translation=(fore, 0, 0)), Z),
        Link(axis=-Z, prismatic=True),
    )
    return Arm(name, links, Scara(height, upper, fore), limits, speed_limits)


class Scara:
    """The inverse of a SCARA arm (see `scara`). Configuration flag: the sign of joint 2. Angles in
    [-pi, pi].

    Source: 001, listing 4, with errata S1-o (the other elbow, rounding) put right.
    """

    branches = np.array([(1,), (-1,)])

    def __init__(self, height, upper, fore):
        self.height, self.upper, self.fore = height, upper, fore

    def ik(self, pose):
        """See `Arm.ik`: Target or Transform of shape (...) -> (..., 2, 4). A tilted tool is out of
        reach.
        """
        position, angle, tilt = _parts(pose)
        x, y, z = np.moveaxis(position[..., None, :], -1, 0)
        elbow = self.branches[:, 0]
        cos2 = (x * x + y * y - self.upper**2 - self.fore**2) / (2 * self.upper * self.fore)
        reached = (abs(cos2) <= 1 + ROUNDING) & (tilt < 1e-9)[..., None]
        cos2 = np.clip(cos2, -1, 1)
        sin2 = elbow * np.sqrt((1 - cos2) * (1 + cos2))
        q1 = np.arctan2(y, x) - np.arctan2(self.fore * sin2, self.upper + self.fore * cos2)
        q2 = np.arctan2(sin2, cos2)
        q3 = angle[..., None] - q1 - q2
        q = np.stack(np.broadcast_arrays(_wrapped(q1), q2, _wrapped(q3), self.height - z), axis=-1)
        return np.where(reached[..., None], q, np.nan)

    def unreached(self, pose, row):
        """Why `row` does not exist for one single pose, in words, and by how many metres; ("", 0.0)
        if it exists.
        """
        position, _, tilt = _parts(pose)
        if tilt >= 1e-9:
            return (
                f"the tool is tilted by {np.rad2deg(tilt):.1f}°, and a SCARA's tool stays upright",
                0.0,
            )
        r, longest, shortest = (
            np.hypot(*position[:2]),
            self.upper + self.fore,
            abs(self.upper - self.fore),
        )
        if r > longest * (1 + ROUNDING):
            return f"the target is {in_words(r - longest)} beyond the stretched arm", r - longest
        if r < shortest * (1 - ROUNDING):
            return f"the target is {in_words(shortest - r)} too near to axis 1", shortest - r
        return "", 0.0

    def singular(self, q):
        """Which singularities hold at q (..., 4): dict of name -> bool (...), within 1e-6 rad."""
        return {"elbow": abs(np.sin(q[..., 1])) < 1e-6}

    def settle(self, q, previous):
        """Rows q (..., 4) as they are: a reachable pose leaves no joint free."""
        return q


def _parts(pose):
    """Position, angle about the vertical, and tilt away from it in radians."""
    if isinstance(pose, Target):
        return pose.position, pose.angle, np.zeros(pose.shape)
    instance(pose, Transform, "pose", hint=" (a SCARA takes a Target or a Transform)")
    w, x, y, z = np.moveaxis(pose.rotation.wxyz, -1, 0)
    return pose.translation, 2 * np.arctan2(z, w), 2 * np.arctan2(np.hypot(x, y), np.hypot(w, z))


def _wrapped(angle):
    return angle - 2 * np.pi * np.round(angle / (2 * np.pi))
