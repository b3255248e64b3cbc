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


# --- 2: Past a bar
import numpy as np

from robokin import deg, three_lever
from robokin.course import variant
from robokin.jobs.obstacles import clearance, way_round

who = "your name"
my_task = variant("obstacle_avoidance", who)
arm = three_lever(1.0)
my_start, (first, last) = np.array(my_task["start"]) * deg, np.array(my_task["bar"])


def points_of_the_bar(count):
    return first + np.linspace(0, 1, count)[:, None] * (last - first)


# whoever keeps d from two points h apart keeps sqrt(d**2 - (h / 2)**2) from what is between them
few = points_of_the_bar(10)
h = np.hypot(*(few[1] - few[0]))
asked = np.hypot(my_task["distance"], h / 2)
my_path = way_round(arm, my_start, my_task["target"], few, asked)
movement = abs(np.diff(my_path, axis=0)).sum()
least = clearance(arm, my_path, points_of_the_bar(200)).min()

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
