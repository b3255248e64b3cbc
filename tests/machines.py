"""The arms on which every law is tested, each with a second description that is independent of
robokin.

To add an arm, add a line to `MACHINES`. `chain(q)` is its forward kinematics as a product of 4 x 4
matrices, written from its document; `wrist` holds the lengths that are needed to count the
solutions independently.
"""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from robokin import IRB140, ITMO6R, PUMA560, SCARA, Arm, Transform, dh_links

SHAPES = [(), (1,), (3, 1, 2)]
DATA = Path(__file__).parent / "data"


@dataclass(frozen=True)
class Machine:
    """An arm, its chain as matrices, and for a spherical wrist the distances that determine its
    reach.
    """

    arm: object
    chain: object  # q (n,) -> 4 x 4 matrix
    wrist: dict | None = None

    def __repr__(self):
        return self.arm.name


def oracle(name):
    return json.loads((DATA / f"{name}.json").read_text())


def transform(matrix, scale=1.0):
    """Transforms from 4 x 4 matrices whose lengths are in units of `scale` metres."""
    matrix = np.array(matrix, dtype=float)
    matrix[..., :3, 3] *= scale
    return Transform.from_matrix(matrix)


def random_joints(arm, rng, shape):
    """Random joint values: from a full turn, or from the stroke of a prismatic joint."""
    low = np.where(arm.prismatic, arm.limits[:, 0], -np.pi)
    high = np.where(arm.prismatic, arm.limits[:, 1], np.pi)
    return rng.uniform(low, high, (*shape, len(arm.links)))


def turns(a, b):
    """The absolute difference between angles, modulo whole turns."""
    return abs((np.asarray(a) - b + np.pi) % (2 * np.pi) - np.pi)


def gap(arm, q, p):
    """The absolute difference between joint values, modulo whole turns for revolute joints."""
    return np.where(arm.prismatic, abs(np.asarray(q) - p), turns(q, p))


def rotation_gap(a, b):
    """The greatest difference between corresponding elements of two rotation matrices."""
    return abs(a.rotation.as_matrix() - b.rotation.as_matrix()).max(axis=(-1, -2))


def position_gap(a, b):
    return np.linalg.norm(a.translation - b.translation, axis=-1)


def reach(arm):
    """The total length of all links."""
    return sum(
        np.linalg.norm(part.translation) for link in arm.links for part in (link.before, link.after)
    )


def rot(axis, angle):
    """The 4 x 4 matrix of a rotation about x, y or z, written out."""
    c, s = np.cos(angle), np.sin(angle)
    i = "xyz".index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    m = np.eye(4)
    m[j, j], m[j, k], m[k, j], m[k, k] = c, -s, s, c
    return m


def shift(x, y, z):
    m = np.eye(4)
    m[:3, 3] = x, y, z
    return m


def dh(q, a, alpha, d, theta):
    """The product of Rot(z, q + theta) Trans(0, 0, d) Trans(a, 0, 0) Rot(x, alpha). Source: 000."""
    m = np.eye(4)
    for qi, ai, alphai, di, thetai in zip(q, a, alpha, d, theta, strict=True):
        m = m @ rot("z", qi + thetai) @ shift(ai, 0, di) @ rot("x", alphai)
    return m


def irb140_chain(q):
    """The IRB-140. Source: 001, listing 1."""
    return (
        shift(0, 0, 0.352)
        @ rot("z", q[0])
        @ shift(0.07, 0, 0)
        @ rot("y", -q[1])
        @ shift(0, 0, 0.35)
        @ rot("y", q[2])
        @ shift(0.38, 0, 0)
        @ rot("x", q[3])
        @ rot("y", q[4])
        @ shift(0.065, 0, 0)
        @ rot("x", q[5])
        @ rot("y", np.pi / 2)
    )


def puma_chain(q):
    """The PUMA 560. Source: oracle/README.md, standard DH."""
    r = np.pi / 2
    return dh(
        q,
        (0, 0.4318, 0.0203, 0, 0, 0),
        (r, 0, -r, r, -r, 0),
        (0.67183, 0, 0.15005, 0.4318, 0, 0),
        (0,) * 6,
    )


def itmo_chain(q, d1=0.1, a2=0.1, d4=0.2, d6=0.2):
    """The six-axis arm of ITMO. Source: oracle/itmo6r.json, key "arm"."""
    r = np.pi / 2
    return dh(
        q, (0, a2, 0, 0, 0, 0), (r, 0, r, -r, r, 0), (d1, 0, 0, d4, 0, d6), (0, 0, r, 0, 0, 0)
    )


def scara_chain(q):
    """The SCARA. Source: 001, listing 4."""
    return (
        shift(0, 0, 0.2202)
        @ rot("z", q[0])
        @ shift(0.2, 0, 0)
        @ rot("z", q[1])
        @ shift(0.25, 0, 0)
        @ rot("z", q[2])
        @ shift(0, 0, -q[3])
    )


#: An arm for which robokin has no closed form. Source: Universal Robots, DH parameters for
#: calculations of kinematics and dynamics: UR5 (CB3, series 3); a and d in m, alpha in rad.
UR5_TABLE = np.array(
    [
        (0, 0.089159, np.pi / 2),
        (-0.425, 0, 0),
        (-0.39225, 0, 0),
        (0, 0.10915, np.pi / 2),
        (0, 0.09465, -np.pi / 2),
        (0, 0.0823, 0),
    ]
)
UR5 = Arm(
    "UR5",
    dh_links(a=UR5_TABLE[:, 0], d=UR5_TABLE[:, 1], alpha=UR5_TABLE[:, 2]),
    [(-2 * np.pi, 2 * np.pi)] * 6,
)

MACHINES = [
    Machine(
        IRB140,
        irb140_chain,
        dict(tool=0.065, shoulder=(0.07, 0.352), lateral=0, upper=0.35, fore=0.38),
    ),
    Machine(
        PUMA560,
        puma_chain,
        dict(
            tool=0,
            shoulder=(0, 0.67183),
            lateral=0.15005,
            upper=0.4318,
            fore=np.hypot(0.4318, 0.0203),
        ),
    ),
    Machine(ITMO6R, itmo_chain, dict(tool=0.2, shoulder=(0, 0.1), lateral=0, upper=0.1, fore=0.2)),
    Machine(SCARA, scara_chain),
]
SIX = [m for m in MACHINES if m.wrist]
