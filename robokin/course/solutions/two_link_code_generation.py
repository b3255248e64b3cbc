"""Solutions of lab 12, one part for each exercise."""

# --- 1: The elbow
import numpy as np


def elbow_of(base, tip, l1, l2, side):
    """The elbow (2,) in m: side +1 right of the way from base to tip, -1 left; NaN: none."""
    dx, dy = np.asarray(tip) - base
    d2, d = dx**2 + dy**2, np.hypot(dx, dy)
    room = 1e-9 * (l1 + l2)  # for rounding on the rim
    if d == 0 or d > l1 + l2 + room or d < abs(l1 - l2) - room:
        return np.array([np.nan, np.nan])
    a = (d2 + l1**2 - l2**2) / (2 * d2)
    h = side * np.sqrt(max(l1**2 / d2 - a**2, 0))
    return base + a * np.array([dx, dy]) + h * np.array([dy, -dx])


# --- 2: A budget of operations
from robokin.course import variant

who = "your name"
own = variant("two_link_code_generation", who)
K, L = (own["l1"] ** 2 - own["l2"] ** 2) / 2, own["l1"] ** 2  # constants of this arm
my_program = f"""
dx = x3 - {own["base_x"]}
dy = y3 - {own["base_y"]}
d2 = dx*dx + dy*dy
a = 0.5 + {K} / d2
h = sqrt({L} / d2 - a*a)
px = {own["base_x"]} + a*dx
py = {own["base_y"]} + a*dy
u = h*dy
v = h*dx
xr = px + u
yr = py - v
xl = px - u
yl = py + v
"""


# --- 3: A test for generated code
import numpy as np


def elbows_are_right(elbows):
    """Whether the program elbows(x1, y1, x3, y3, l1, l2) finds both elbows."""
    x1, y1, l1, l2 = 0.23, -0.17, 0.91, 0.64
    far, near = l1 + l2, l1 - l2
    for d, exists in ((0.1, False), (near + 0.005, True), (0.83, True), (far - 0.005, True),
                      (far + 0.1, False)):  # fmt: skip
        for turn in np.arange(0, 360, 15):
            way = np.array([np.cos(np.radians(turn)), np.sin(np.radians(turn))])
            if turn % 90 == 0:
                way = np.round(way)  # exactly along an axis
            x3, y3 = np.array([x1, y1]) + d * way
            found = np.asarray(elbows(x1, y1, x3, y3, l1, l2), dtype=float)
            if not exists:
                if not np.isnan(found).all():
                    return False
                continue
            if found.shape != (4,) or not np.isfinite(found).all():
                return False
            for (x, y), side in zip(found.reshape(2, 2), (1, -1), strict=True):
                cross = (x3 - x1) * (y - y1) - (y3 - y1) * (x - x1)
                if abs(np.hypot(x - x1, y - y1) - l1) > 1e-9 or side * cross > 0:
                    return False
                if abs(np.hypot(x - x3, y - y3) - l2) > 1e-9:
                    return False
    return True
