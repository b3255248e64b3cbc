"""Solutions of lab 06: one way of several. The checks accept every right one."""

# --- 1: The axes of a table
import numpy as np


def joint_axes(a, alpha, d, offset, q):
    """Points and directions (n, 3) of the axes of joints 1 to n, in base coordinates."""
    frame, points, ways = np.eye(4), [], []
    for i in range(len(q)):
        points.append(frame[:3, 3])  # joint i + 1 turns about z of the frame before it
        ways.append(frame[:3, 2])
        c, s = np.cos(offset[i] + q[i]), np.sin(offset[i] + q[i])
        ca, sa = np.cos(alpha[i]), np.sin(alpha[i])
        row = [
            [c, -s * ca, s * sa, a[i] * c],
            [s, c * ca, -c * sa, a[i] * s],
            [0, sa, ca, d[i]],
            [0, 0, 0, 1],
        ]
        frame = frame @ np.array(row)
    return np.array(points), np.array(ways)


# --- 2: A test for wrist programs
import numpy as np


def wrist_is_right(wrist_angles):
    """Whether the program wrist_angles(h, wrist) finds phi, theta, psi."""

    def zyz(phi, theta, psi):  # the lab has one, too
        (a, b, c), (x, y, z) = np.cos([phi, theta, psi]), np.sin([phi, theta, psi])
        return np.array(
            [
                [a * b * c - x * z, -a * b * z - x * c, a * y],
                [x * b * c + a * z, a * c - x * b * z, x * y],
                [-y * c, y * z, b],
            ]
        )

    rng = np.random.default_rng(1)
    pairs = [(np.pi / 4, 0.3), (2, -0.5), *rng.uniform(-np.pi, np.pi, (6, 2))]
    for theta in (0, 1e-9, 1e-8, 1e-6, 1e-4, 0.5, 2, np.pi - 1e-4, np.pi - 1e-9, np.pi):
        for phi, psi in pairs:
            for wrist in (+1, -1):
                h = zyz(phi, theta, psi)
                found = wrist_angles(h, wrist)
                if not abs(zyz(*found) - h).max() < 1e-10:  # also where it is NaN
                    return False
                if not -1e-10 <= wrist * found[1] <= np.pi + 1e-10:
                    return False
    return True


# --- 3: A line that keeps its distance
import numpy as np

from robokin import (
    ITMO6R,
    Quaternion,
    Transform,
    differentiate,
    distance_from_singularity,
    follow,
    lin,
    mm,
    quintic,
)
from robokin.course import variant

who = "your name"
n = variant("spherical_wrist", who)
t = np.linspace(0, 1, 1001)
turn = Quaternion.from_angle_axis


def measured(up, side):
    """The smallest distance from a singularity, and the greatest joint speed for 1 s."""
    along = np.array([0, np.cos(n["slope"]), np.sin(n["slope"])])
    across = np.array([0, -np.sin(n["slope"]), np.cos(n["slope"])])
    level = turn(np.pi / 2, (0, 1, 0)) @ turn(np.pi, (0, 0, 1))
    tool = turn(-up, (0, 1, 0)) @ turn(side, (0, 0, 1)) @ level
    middle = np.array([400, 0, 200]) * mm + n["miss"] * across
    ends = [Transform(tool, middle + e * 113 * mm * along) for e in (-1, 1)]
    rows = ITMO6R.ik(lin(*ends, quintic(duration=1)(t)))
    q = follow(ITMO6R, rows, ITMO6R.branch(+1, -1, -1))
    if np.isnan(q).any():
        return 0, np.inf
    return distance_from_singularity(ITMO6R, q).min(), abs(differentiate(q, t)).max()


tilt = 0.97 * n["most_tilt"]
up, side = tilt * np.cos(n["slope"]), -tilt * np.sin(n["slope"])  # square to the line
ways = [(up, side), (-up, -side)]
best = max(ways, key=lambda way: measured(*way)[0])
duration = 1.001 * measured(*best)[1] / n["most_speed"]
my_line = {"up": best[0], "side": best[1], "duration": duration}
