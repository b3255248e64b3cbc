"""What the right and the wrong programs of exercise 3 of scara kinematics use."""

import numpy as np

from robokin import SCARA, deg
from robokin.units import wrapped

__all__ = ["SCARA", "deg", "np", "wrapped"]
