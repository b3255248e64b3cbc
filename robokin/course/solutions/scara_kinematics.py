"""Solutions of lab 4: one way of several. The checks accept every right one."""

# --- 1: the other elbow
import numpy as np

from robokin import mm

L1, L2 = 200 * mm, 250 * mm


def other_elbow(q):
    """The triangle mirrored in the line to the target; joint 3 keeps the tool's angle."""
    q1, q2, q3, q4 = q
    inside = np.arctan2(L2 * np.sin(q2), L1 + L2 * np.cos(q2))
    new_q1 = q1 + 2 * inside
    return np.array([new_q1, -q2, (q1 + q2 + q3) - new_q1 + q2, q4])


# --- 2: a circle of one's own
import numpy as np

from robokin import SCARA, ScaraPose, mm
from robokin.course import variant

who = "your name"
my_numbers = variant("scara_kinematics", who)

distance = 0.29  # between the hole, 126 mm, and 440 mm, where joint 2 stands at 25 degrees
elbow = +1 if my_numbers["bearing"] > 0 else -1  # the first lever stays in front of the target

beta = np.linspace(0, 2 * np.pi, 361)
x = distance * np.cos(my_numbers["bearing"]) + my_numbers["radius"] * np.cos(beta)
y = distance * np.sin(my_numbers["bearing"]) + my_numbers["radius"] * np.sin(beta)
turned = my_numbers["turns"] * beta  # the tool's angle, were it to begin at 0
rows = SCARA.ik(ScaraPose(np.stack([x, y, np.full_like(x, 100 * mm)], axis=-1)))
q1, q2 = rows[:, SCARA.branch(elbow), :2].T
q3 = turned - q1 - q2
my_circle = {
    "distance": distance,
    "elbow": elbow,
    "angle": -(q3.min() + q3.max()) / 2,  # the middle of its way at 0
}


# --- 3: a test for limits
import numpy as np


def inside_is_right(inside):
    """One good motion, then one value spoiled at a time, for two tables of limits."""
    six = [(-0.5, 4), (-9, 9), (0.1, 2), (-3, 3), (-7, 1), (-2, 5)]
    for limits in ([(-2, 2), (-3, 1), (-7, 7), (0, 0.2)], six):
        low, high = np.transpose(limits)
        good = np.tile((low + high) / 2, (25, 1))
        good += np.linspace(-0.05, 0.05, 25)[:, None]
        if not inside(good, np.array(limits)):
            return False
        for joint in range(len(limits)):
            for value in (low[joint] - 1e-6, high[joint] + 1e-6, np.nan):
                bad = good.copy()
                bad[7, joint] = value
                if inside(bad, np.array(limits)):
                    return False
            for value in limits[joint]:  # a limit itself is inside
                edge = good.copy()
                edge[7, joint] = value
                if not inside(edge, np.array(limits)):
                    return False
    return True
