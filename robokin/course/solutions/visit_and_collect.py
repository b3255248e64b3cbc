"""Solutions of lab 08: one way of several. The checks accept every right one."""

# --- 1: A test for inverses
import numpy as np

from robokin import spbu_arm
from robokin.jobs.visit_collect import workspace


def inverse_is_right(inverse):
    """Whether the program inverse(p) gives right joint values for spbu_arm(5, 4)."""
    arm = spbu_arm(5, 4)
    rng = np.random.default_rng(1)
    points = rng.uniform([-9, -9, 0], [9, 9, 9], size=(300, 3))
    points = points[workspace(5, 4, points).all(axis=-1)]
    most = np.array([np.pi, np.pi / 2, np.pi / 2])
    for p in [*points, np.array([0, 0, 6.0])]:  # random points are never on the axis
        q = np.asarray(inverse(p), dtype=float)
        if not (abs(q) <= most + 1e-9).all():  # a NaN is not below
            return False
        if np.linalg.norm(arm.fk(q).translation - p) > 1e-6:
            return False
    return True


# --- 2: When is the arm where?
import numpy as np


def arrivals(q, speeds):
    """When each stop after the start is reached, in s."""
    q = q.copy()
    angle = q[~np.isnan(q[:, 0]), 0][0]  # a start on the axis has the first angle known
    for stop in q:
        if np.isnan(stop[0]):
            stop[0] = angle  # joint 1 stays
        angle = stop[0]
    needs = abs(np.diff(q, axis=0)) / speeds
    return needs.max(axis=-1).cumsum()


# --- 3: A trap
import numpy as np

from robokin.course import variant

who = "your name"
mine = variant("visit_and_collect", who)

B = mine["speed"] * mine["T"]  # rad: so far a joint turns in the time T
x, y, z = mine["p0"]
r, start = np.hypot(x, y), np.arctan2(y, x)
# the lure on one side, three points behind each other on the other: joint 1 alone moves
my_points = [
    [r * np.cos(start + share * B), r * np.sin(start + share * B), z]
    for share in (0.66, -0.73, -0.83, -0.93)
]
