"""Solutions of lab 01: one way of several. The checks accept every right one."""

# --- 1: Seen from the flange
import numpy as np

from robokin import Quaternion, Transform

X, Z = (1, 0, 0), (0, 0, 1)


def seen_from_flange(table, q, base_part):
    """flange_part = flange_base @ base_part, with flange_base the inverse of the chain."""
    flange = Transform()
    for (offset, d, a, alpha), joint in zip(table, q, strict=True):
        on_z = Transform(Quaternion.from_angle_axis(offset + joint, Z), (0, 0, d))
        on_x = Transform(Quaternion.from_angle_axis(alpha, X), (a, 0, 0))
        flange = flange @ on_z @ on_x  # with the matrices of the lab: flange @ dh(...)
    return (flange.inverse() @ Transform.from_matrix(base_part)).as_matrix()


# --- 2: A camera that looks at a part
import numpy as np

from robokin import Quaternion, Transform
from robokin.course import variant

who = "your name"
my_numbers = variant("frames_and_quaternions", who)
eye = np.array([my_numbers[name] for name in ("eye_x", "eye_y", "eye_z")])
part = np.array([my_numbers[name] for name in ("part_x", "part_y", "part_z")])

z = (part - eye) / np.linalg.norm(part - eye)  # the line of sight
x = np.cross(z, (0, 0, 1))  # level, and across z
x = x / np.linalg.norm(x)
y = np.cross(z, x)  # right-handed, and downwards
my_turn = Quaternion.from_matrix(np.transpose([x, y, z]))  # the axes are its columns
my_camera = Transform(my_turn, eye)


# --- 3: A test for slerp
import numpy as np

from robokin import Quaternion


def leads_well(lead):
    """Whether the program lead(a, b, s) is a right slerp."""
    rng = np.random.default_rng(1)
    pairs = []
    for turn in (0.0, 1e-3, 0.3, 0.6, 1.5, 2.5, 3.1):  # rad, about oblique axes
        a = rng.normal(size=4)
        a = a / np.linalg.norm(a)
        axis = rng.normal(size=3)
        axis = axis / np.linalg.norm(axis)
        b = (Quaternion(a) @ Quaternion.from_angle_axis(turn, axis)).wxyz
        pairs += [(a, b), (a, -b)]
    a = pairs[-1][0]
    pairs += [(a, a), (a, -a)]
    for a, b in pairs:
        for s in (0, 0.1, 0.25, 0.5, 0.9, 1):
            right = Quaternion(a).slerp(Quaternion(b), s).wxyz
            found = np.asarray(lead(a.copy(), b.copy(), s))
            if found.shape != (4,):
                return False
            error = min(abs(found - right).max(), abs(found + right).max())
            if not error < 1e-6:  # also where it is NaN
                return False
    return True
