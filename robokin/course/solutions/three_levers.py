"""Solutions of lab 09: one way of several. The checks accept every right one."""

# --- 1: Levers of any lengths
import numpy as np


def posture_of(K, alpha, lengths):
    """The posture (gamma, beta, alpha) at K of levers of these lengths; NaN if there is none."""
    a, b, c = lengths
    KO = np.hypot(*K)
    KB = np.sqrt(b**2 + c**2 - 2 * b * c * np.cos(alpha))
    if not abs(a - KB) <= KO <= a + KB:
        return np.full(3, np.nan)
    gamma_1 = np.arccos((KO**2 + a**2 - KB**2) / (2 * KO * a))
    beta_1 = np.arccos((KB**2 + a**2 - KO**2) / (2 * KB * a))
    beta_2 = np.arctan2(c * np.sin(alpha), b - c * np.cos(alpha))  # between KB and BA
    return np.array([gamma_1 + np.arctan2(K[1], K[0]), beta_1 + beta_2, alpha])


# --- 2: A test for least movement
import numpy as np

from robokin import deg, three_lever

arm = three_lever(1.0)


# the tasks, made once
rng = np.random.default_rng(2)
r, phi = rng.uniform(1.1, 2.9, 40), rng.uniform(0, 145, 40) * deg
points = np.stack([r * np.cos(phi), r * np.sin(phi)], axis=-1)
before = rng.uniform(20, 170, (40, 3)) * deg
least = arm.least(points, before)[1]  # S, all at once; NaN: not reached


def is_least(program):
    """Whether the program least(K, previous) finds the least movement."""
    for K, previous, S in zip(points, before, least, strict=True):
        if np.isnan(S):
            continue
        q = np.asarray(program(K, previous))
        if q.shape != (3,):
            return False
        reached = np.hypot(*(arm.points(q)[3] - K)) < 1e-5
        inside = (q >= -1e-6).all() and (q <= np.pi + 1e-6).all()
        if not (reached and inside and abs(q - previous).sum() <= S + 0.02 * deg):
            return False
    return True


# --- 3: Two tasks at once
import numpy as np

from robokin import three_lever
from robokin.course import variant

who = "your name"
n = my_numbers = variant("three_levers", who)
arm = three_lever(1.0)

start = np.array([n["gamma"], n["beta"], n["alpha"]])
K1, K2 = (n["x_first"], n["y_first"]), (n["x_second"], n["y_second"])
one, two = (arm.family(K, np.linspace(*arm.alpha_range(K), 181)) for K in (K1, K2))
d1, d2 = abs(one - start), abs(one[:, None] - two)  # (181, 3) and (181, 181, 3)
S = d1.sum(axis=-1)[:, None] + d2.sum(axis=-1)
longest = d1.max(axis=-1)[:, None] + d2.max(axis=-1)
i, j = np.argwhere((S <= n["most"]) & (longest <= n["longest"]))[
    0
]  # the first pair that keeps both
my_alphas = {"first": one[i, 2], "second": two[j, 2]}
