"""Solutions of lab 2, one part an exercise: each stands on its own."""

# --- 1: the tip of a gripper ----------------------------------------------------------------------

import numpy as np

from robokin import IRB140, Quaternion, Transform


def tip(q, length, angle):
    "The flange seen from the base, then the tip seen from the flange."
    gripper = Transform(Quaternion.from_angle_axis(angle, (0, 0, 1)), (0, 0, length))
    return IRB140.fk(q) @ gripper  # or my_chain(q)[-1] @ gripper


# --- 2: a pose with exactly four ways -------------------------------------------------------------

import numpy as np

from robokin import IRB140, Quaternion, Transform, deg, mm

# The tool looks down, so the wrist centre is 65 mm above the flange: at the height of the shoulder,
# 720 mm in front of axis 1. That is 650 mm from the shoulder of the arm that looks at it, and 790
# mm from that of the arm that faces away. Stretched, the arm reaches 730 mm.
down = Quaternion.from_angle_axis(180 * deg, (0, 1, 0))
my_pose = Transform(down, np.array([720, 0, 352 - 65]) * mm)
rows = IRB140.ik(my_pose)
exists = ~np.isnan(rows).any(axis=1)
print("rows that exist:", np.flatnonzero(exists))

# --- 3: a target of one's own ---------------------------------------------------------------------

import numpy as np

from robokin import IRB140, Quaternion, Transform, deg, differentiate, mm
from robokin.course import variant

who = "your name"
my_numbers = variant("irb140_kinematics", who)


def my_target(t, total, height):
    "The moving target at the times t (N,), for a motion of `total` seconds."
    n, p = my_numbers, t / total
    x = n["x_start"] + (n["x_end"] - n["x_start"]) * np.clip(2 * p - 1, 0, 1)
    y = n["y_start"] + (n["y_end"] - n["y_start"]) * np.clip(2 * p, 0, 1)
    turn = Quaternion.from_angle_axis(p * n["turn"], (0, 1, 0))
    return Transform(turn, np.stack([x, y, np.full_like(p, height)], axis=-1))


def inside(q):
    "Whether each joint has one value q + 2 pi k that stays inside its limits all the time."
    low, high = IRB140.limits.T
    below = 2 * np.pi * np.ceil((low - q.min(axis=0)) / (2 * np.pi))
    return (q.max(axis=0) + below <= high).all()


t = np.linspace(0, 1, 2001)  # one second: the shape of the motion is the same for every duration
ways = []
for height in np.arange(400, 901, 25) * mm:
    rows = IRB140.ik(my_target(t, 1.0, height))
    for row in range(8):
        q = np.unwrap(rows[:, row], axis=0)
        if not np.isnan(q).any() and inside(q):
            used = (abs(differentiate(q, t)) / IRB140.speed_limits).max()
            shortest = used / my_numbers["share"]
            ways.append((shortest, height, row))
            print(f"{height / mm:.0f} mm, row {row}: {shortest:.2f} s")

shortest, height, row = min(ways)
flags = tuple(IRB140.branches[row].tolist())
my_design = {"height": height, "flags": flags, "duration": 1.1 * shortest}
