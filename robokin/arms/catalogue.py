"""The robots of the course: their dimensions and limits, with the sources."""

import numpy as np

from .._validate import length, number
from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, mm
from .arm import ClosedFormArm
from .elbow import elbow_arm
from .link import Link, dh_links
from .scara import scara_arm
from .spherical_wrist import spherical_wrist

X, Y, Z = np.eye(3)


def _at(x: float, y: float, z: float) -> Transform:
    return Transform(translation=(x, y, z))


#: ABB IRB-140. The chain, lengths and limits are from 001, listings 1 and 7 (S1-05, S1-08); we
#: split the document's frame `wrist` in two (joints 4 and 5). Public models of this robot
#: (ROS-Industrial abb_experimental, ARTE) differ: their upper arm is 360 mm long, whereas ours is
#: 350 mm long, and a positive q2 leans it forward, whereas it leans ours backward. With q2 negated,
#: their flange is 10 mm from ours at every posture; without the negation, it is 563 mm away when q2
#: = 30 degrees and all other joints are zero (errata S1-g; companion 001, section 2). ARTE limits
#: joint 5 to +-120 degrees. We keep the document's values. The document states no speed limits. We
#: chose those of joints 3 and 4, which are below the 260 and 360 degrees/s of the public models; we
#: did not have the manufacturer's data sheet.
IRB140 = spherical_wrist(
    "IRB-140",
    links=(
        Link(_at(0, 0, 352 * mm), Z),
        Link(_at(70 * mm, 0, 0), -Y),
        Link(_at(0, 0, 350 * mm), Y),
        Link(_at(380 * mm, 0, 0), X),
        Link(axis=Y),
        Link(_at(65 * mm, 0, 0), X, after=Transform(Quaternion.from_angle_axis(90 * deg, Y))),
    ),
    limits=np.array([(-180, 180), (-90, 110), (-230, 50), (-200, 200), (-115, 115), (-400, 400)])
    * deg,
    speed_limits=np.array([200, 200, 245, 348, 360, 450]) * deg,
)


#: SCARA. The lengths are from 001, listing 4, the limits from listings 4 and 12, with joint 4 in mm
#: (errata S1-p). The document states no speed limits.
SCARA = scara_arm(
    "SCARA",
    height=220.2 * mm,
    upper=200 * mm,
    fore=250 * mm,
    limits=np.array(
        [(-140 * deg, 140 * deg), (-150 * deg, 150 * deg), (-400 * deg, 400 * deg), (0, 180 * mm)]
    ),
)

#: PUMA 560. Source 001 mentions this arm but gives no dimensions. The table has standard DH
#: parameters with the lengths and limits of P. Corke's model (Robotics Toolbox, `puma560`); the
#: base is raised by 26.45 inches.
PUMA560 = spherical_wrist(
    "PUMA 560",
    links=dh_links(
        a=np.array([0, 431.8, 20.3, 0, 0, 0]) * mm,
        alpha=np.array([90, 0, -90, 90, -90, 0]) * deg,
        d=np.array([671.83, 0, 150.05, 431.8, 0, 0]) * mm,
    ),
    limits=np.array([(-160, 160), (-45, 225), (-225, 45), (-110, 170), (-100, 100), (-266, 266)])
    * deg,
)


def itmo_arm(d1: float, a2: float, d4: float, d6: float) -> ClosedFormArm:
    """The six-axis arm of source 004, table 1, with lengths in metres. d1 and d6 may be 0. The
    source states no limits, so we allow one turn in each direction. Raises ValueError if a length
    is not positive (or d1 or d6 is negative).
    """
    ends = [number(value, name) for name, value in (("d1", d1), ("d6", d6))]
    if min(ends) < 0:
        raise ValueError(f"d1 and d6: wanted lengths that are not negative, got {ends}")
    return spherical_wrist(
        "DH arm (004)",
        links=dh_links(
            a=[0, length(a2, "a2"), 0, 0, 0, 0],
            alpha=np.array([90, 0, 90, -90, 90, 0]) * deg,
            d=[ends[0], 0, 0, length(d4, "d4"), 0, ends[1]],
            theta=np.array([0, 0, 90, 0, 0, 0]) * deg,
        ),
        limits=np.array([(-360, 360)] * 6) * deg,
    )


#: Source 004 states neither the lengths nor their unit. Its printed matrix (12) gives d4 = d6 = 20
#: and d1 + a2 = 20. We split the sum into equal halves and assume centimetres (errata S4-j).
ITMO6R = itmo_arm(d1=100 * mm, a2=100 * mm, d4=200 * mm, d6=200 * mm)


def spbu_arm(l1: float, l2: float) -> ClosedFormArm:
    """The positioning arm of source 000 (figure 2), with lengths in metres. Joint 1 turns about the
    vertical, joint 2 tilts link 1 away from the vertical, and when joint 3 is 0, the two links are
    perpendicular. The limits are those that the document states. Raises ValueError if a length is
    not positive.

    The document's first matrix has alpha = -90 degrees; with the +90 degrees in its text, the tool
    would be below the floor (errata S0-a).
    """
    return elbow_arm(
        "Arm (000)",
        links=dh_links(
            a=[0, length(l1, "l1"), length(l2, "l2")],
            alpha=np.array([-90, 0, 0]) * deg,
            d=0,
            theta=np.array([0, -90, 90]) * deg,
        ),
        limits=np.array([(-180, 180), (-90, 90), (-90, 90)]) * deg,
    )


def loader_arm(A: float, B: float) -> ClosedFormArm:
    """The log loader of source 003 with levers of lengths A and B in metres, q = (alpha, gamma,
    beta) from the base outwards.

    alpha  the rotation about the vertical, counter-clockwise from the +x axis
    gamma  the angle of lever A above the horizontal
    beta   the interior angle between the levers: lever B points gamma + beta - 180 degrees above
           the horizontal

    In the document's posture the elbow is up and 0 <= beta <= 180 degrees; this is row
    `arm.branch(+1, -1)`. In this row, alpha is atan2(y, x) in all nine cells of table 1 (errata
    S3-p; in the middle cell, where x = y = 0, alpha is free and `ik` returns 0), and beta and gamma
    are given by (3) and (4). The limits of alpha are those of the document; those of beta and gamma
    are the ranges of (3) and (4) for z >= 0. Joint alpha has no mechanical stop, so the shortest
    rotation (errata S3-q) may exceed its limits. `robokin.jobs.steppers.out_of_reach` checks the
    document's conditions on the position of the gripper.

    Source: 003, paper 1, (1) to (4), table 1, figure 3.
    """
    A, B = length(A, "A"), length(B, "B")
    # an interior angle of 0 folds B back onto A
    forearm = Transform(Quaternion.from_angle_axis(-180 * deg, -Y))
    return elbow_arm(
        "Log loader",
        links=(
            Link(axis=Z),
            Link(axis=-Y, after=_at(A, 0, 0)),
            Link(forearm, -Y, after=_at(B, 0, 0)),
        ),
        limits=np.array([(-180, 180), (0, 270), (0, 180)]) * deg,
    )
