"""The machines: numbers, each beside its source."""

import numpy as np

from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, mm
from .arm import Link
from .spherical_wrist import spherical_wrist

X, Y, Z = np.eye(3)


def _at(x, y, z):
    return Transform(translation=(x, y, z))


# ABB IRB-140. Chain, lengths and limits: 001, listings 1 and 7 (S1-05, S1-08). The chain is the document's, its
# frame `wrist` split in two (joints 4 and 5). Its joint 2 turns about -y, so a positive angle leans the arm back, and
# its upper arm is 350 mm where other models of this robot have 360 mm (errata S1-g): we keep the document's numbers.
# Speeds: public models of the robot differ for joints 3 and 4 (260 and 360 elsewhere); these are the lower ones, not
# checked against the maker's data sheet.
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
    limits=np.array([(-180, 180), (-90, 110), (-230, 50), (-200, 200), (-115, 115), (-400, 400)]) * deg,
    speed_limits=np.array([200, 200, 245, 348, 360, 450]) * deg,
)
