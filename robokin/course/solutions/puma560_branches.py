"""Solutions of lab 07: one way of several. The checks accept every right one."""

# --- 1: Name a posture
import numpy as np

from robokin import mm


def posture_name(q):
    """The posture q (6,) in VAL's words."""
    upper, fore = 431.8 * mm, np.hypot(431.8, 20.3) * mm
    gamma = q[2] + np.arctan2(431.8, 20.3)  # the bend, 0 where the arm is stretched
    r = upper * np.cos(q[1]) + fore * np.cos(q[1] + gamma)  # of the wrist centre, ahead of axis 1
    front = 1 if r > 0 else -1
    elbow = 1 if np.sin(gamma) > 0 else -1
    arm = "RIGHTY" if front > 0 else "LEFTY"
    height = "ABOVE" if front * elbow < 0 else "BELOW"
    return f"{arm} {height} {'NOFLIP' if q[4] > 0 else 'FLIP'}"


# --- 2: The flange speed that the joints allow
import numpy as np

from robokin import PUMA560


def flange_speed(q, direction, most):
    """The greatest speed of the flange along `direction`, m/s, with no joint above `most`."""
    unit = direction / np.linalg.norm(direction)
    rates = np.linalg.solve(PUMA560.jacobian(q), [*unit, 0, 0, 0])  # rad/s for 1 m/s
    with np.errstate(divide="ignore"):  # a joint that stands still allows any speed
        return float(np.min(most / abs(rates)))


# --- 3: A line of one's own
import numpy as np

from robokin import PUMA560, Quaternion, Transform, differentiate, follow, lin, quintic
from robokin.course import variant

who = "your name"
own = variant("puma560_branches", who)
tool = Quaternion.from_angle_axis(own["tilt"], [0, 1, 0])
my_start = Transform(tool, [own["start_x"], own["start_y"], own["start_z"]])
my_goal = Transform(tool, [own["goal_x"], own["goal_y"], own["goal_z"]])

x = np.linspace(0, 1, 1001)  # one second
my_rows = PUMA560.ik(lin(my_start, my_goal, quintic(1.0)(x)))
low, high = PUMA560.limits.T
least = {}
for row in range(8):
    q = follow(PUMA560, my_rows, row)
    if ((q >= low) & (q <= high)).all():
        least[row] = abs(differentiate(q, x)).max() / own["fastest"]  # s
best = min(least, key=least.get)
my_choice = {"row": best, "duration": 1.02 * least[best]}
