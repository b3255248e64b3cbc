"""Solutions of lab 10: one way of several. The checks accept every right one."""

# --- 1: Inside or outside
import numpy as np


def inside(corners, H):
    """Whether H lies inside: a ray from H to the right crosses an odd number of sides."""
    odd = False
    for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if (y0 > H[1]) != (y1 > H[1]):
            if H[0] < x0 + (H[1] - y0) / (y1 - y0) * (x1 - x0):
                odd = not odd
    return odd


# --- 2: Past two obstacles
import itertools

import numpy as np

from robokin import deg, three_lever
from robokin.course import variant
from robokin.jobs.obstacles import clearance

who = "your name"
my_task = variant("obstacle_avoidance", who)
arm = three_lever(1.0)
my_start = np.array(my_task["start"]) * deg


def folded_path(beta, alpha, end):
    """Fold, swing, unfold."""
    first, last = [my_start[0], beta, alpha], [end[0], beta, alpha]
    return np.array([my_start, first, last, end])


def movement(path):
    return abs(np.diff(path, axis=0)).sum()


ends = arm.family(my_task["target"], np.linspace(*arm.alpha_range(my_task["target"]), 5))
folds = np.arange(45, 121, 15) * deg
my_path = None
for beta, alpha, end in itertools.product(folds, folds, ends):
    path = folded_path(beta, alpha, end)
    if my_path is not None and movement(path) >= movement(my_path):
        continue
    if all(clearance(arm, path, H).min() >= my_task["distance"] for H in my_task["obstacles"]):
        my_path = path

# --- 3: A test for checks
import numpy as np

from robokin import three_lever
from robokin.jobs.obstacles import along, clearance

arm = three_lever(1.0)
rng = np.random.default_rng(1)
tasks = []  # path, obstacle, distance, the truth
while len(tasks) < 60:
    path = rng.uniform(0.7, 2.2, (3, 3))  # no joint turns by more than 86°
    points = arm.points(along(path, rng.random()))
    lever = rng.integers(3)
    H = points[lever] + rng.random() * (points[lever + 1] - points[lever])
    H = H + rng.normal(0, 0.15, 2)
    least = clearance(arm, path, H).min()
    if least > 0.03:
        tasks.append((path, H, least - 0.025, True))
    tasks.append((path, H, least + 0.025, False))


def safe_is_right(safe):
    """Whether the program safe(path, H, distance) is right in all tasks."""
    return all(bool(safe(path, H, distance)) == truth for path, H, distance, truth in tasks)
