"""robokin: the kinematics of robot arms, to read, run and drag.

Metres and radians inside; `352 * mm` and `90 * deg` on the way in. Figures and players come from `robokin.show`.
"""

from .arms import IRB140, Arm, Link, explain, follow, nearest, spherical_wrist, within
from .motion import TimeLaw, blend, differentiate, lin, lin_lin, linear, ptp, quintic, trapezoidal
from .quaternion import Quaternion
from .transform import Transform
from .units import deg, mm

__all__ = [
    "IRB140", "Arm", "Link", "Quaternion", "TimeLaw", "Transform", "blend", "deg", "differentiate", "explain",
    "follow", "lin", "lin_lin", "linear", "mm", "nearest", "ptp", "quintic", "spherical_wrist", "trapezoidal",
    "within",
]
