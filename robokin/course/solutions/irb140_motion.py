"""Solutions of lab 03: one way of several. The checks accept every right one."""

# --- 1: The blend from a distance
import numpy as np

from robokin import Quaternion, Transform, deg, mm

# the three poses are there in the lab
start = Transform(Quaternion.from_angle_axis(90 * deg, [-1, 0, 0]), np.array([200, 400, 200]) * mm)
via = Transform(Quaternion.from_angle_axis(45 * deg, [0, 1, 0]), np.array([650, -100, 800]) * mm)
goal = Transform(Quaternion.from_angle_axis(90 * deg, [0, 1, 0]), np.array([300, 300, 500]) * mm)


def fraction_for(distance, corner):
    """The blend that passes via at `distance` (m) in the middle of the corner; NaN: none does."""
    D = np.linalg.norm(start.translation - 2 * via.translation + goal.translation)
    share = {"parabola": 1 / 2, "quintic": 3 / 8}[corner]  # 3/8 is 3/4 of 1/2
    fraction = distance / (share * D)
    return fraction if fraction <= 0.5 else np.nan


# --- 2: The short way
import numpy as np

from robokin import IRB140


def ptp_short(q0, q1, s):
    """The PTP motion (samples, 6) from q0 to the nearest values of the posture q1."""
    low, high = IRB140.limits.T
    end = q1.copy()
    for joint in range(6):
        values = [q1[joint] + 2 * np.pi * k for k in range(-9, 10)]
        inside = [value for value in values if low[joint] <= value <= high[joint]]
        end[joint] = min(inside, key=lambda value: abs(value - q0[joint]))
    return q0 + s[:, None] * (end - q0)


# --- 3: A test for speeds
import numpy as np


def speeds_are_right(speeds):
    """Whether the program speeds(q, t) makes right joint speeds of wrapped angles."""
    rng = np.random.default_rng(1)
    t = 3 + np.cumsum(rng.uniform(0.004, 0.01, 1000))  # uneven, and not from 0
    phase = np.arange(6)  # six joints, each at another place of its swing
    q = np.pi + 2 * np.sin(t[:, None] + phase)  # passes 180° to and fro
    exact = 2 * np.cos(t[:, None] + phase)
    found = np.asarray(speeds((q + np.pi) % (2 * np.pi) - np.pi, t))
    if found.shape != exact.shape:
        return False
    error = abs(found - exact)
    return bool((error[1:-1] < 0.001).all() and (error < 0.1).all())  # a NaN is not below
