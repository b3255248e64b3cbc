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
    for p in [*points, np.array([0, 0, 6.0]), np.array([9.0, 0, 0])]:  # on the axis, on the border
        q = np.asarray(inverse(p), dtype=float)
        if q.shape != (3,) or not (abs(q) <= most + 1e-9).all():  # a NaN is not below
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


# --- 3: A trap, or none?
import numpy as np

from robokin.course import variant

who = "your name"
mine = variant("visit_and_collect", who)

B = mine["speed"] * mine["T"]  # rad: so far a joint turns in the time T
x, y, z = mine["p0"]
r, start = np.hypot(x, y), np.arctan2(y, x)


def on_circle(shares):
    """Points at these shares of B from p0, on its circle about axis 1: joint 1 alone moves."""
    return [[r * np.cos(start + s * B), r * np.sin(start + s * B), z] for s in shares]


# visit: the lure on one side, three points behind each other on the other
# worth: T_collect is 3 T; the cheap one costs T, the dear one 2.4 T, the others more
dear = int(np.argmax(mine["worth"]))
shares = [0.5, -1.35, -1.5]
shares.insert(dear, -1.2)
my_traps = {
    "visit": on_circle([0.66, -0.73, -0.83, -0.93]),
    "collect": "no trap",  # any k objects cost at least as much as the k cheapest
    "worth": on_circle(shares),
}
