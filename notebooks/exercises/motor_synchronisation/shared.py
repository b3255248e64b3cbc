"""Code that exercises and predictions of this lab share."""

import numpy as np
from numpy.typing import NDArray

from robokin import loader_arm, mm

Floats = NDArray[np.float64]
A, B = 450 * mm, 300 * mm
LOADER = loader_arm(A, B)
PER_DEGREE = np.array([10, 40, 40])
START, GOAL = np.array([[600, -350, 50], [50, 250, 350]]) * mm
STEP = 1.8  # degrees
TURN = 2 * np.pi
