"""Code that exercises and predictions of this lab share."""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]
MINUS = str.maketrans("-", "\N{MINUS SIGN}")
LONG, SHORT = 1.0, 0.7  # m, the lab's arm
