"""What the right and the wrong programs of exercise 3 of irb140 motion use."""

import numpy as np

from robokin import deg, differentiate
from robokin.units import wrapped

__all__ = ["deg", "differentiate", "np", "wrapped"]
