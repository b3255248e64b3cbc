"""Code that exercises and predictions of this lab share."""

import numpy as np
from numpy.typing import NDArray

from robokin import Link, Transform, deg, elbow_arm, loader_arm, mm

Floats = NDArray[np.float64]
A, B = 450 * mm, 300 * mm
LOADER = loader_arm(A, B)
E = 100 * mm  # joint 2 of the other loader is this far in front of its axis 1
SHOULDER = elbow_arm(
    "Loader with a shoulder",
    (
        LOADER.links[0],
        Link(Transform(translation=[E, 0, 0]), LOADER.links[1].axis, LOADER.links[1].after),
        LOADER.links[2],
    ),
    np.array([(-180, 180), (0, 270), (0, 180)]) * deg,
)
PER_DEGREE = np.array([10, 40, 40])
START, GOAL = np.array([[600, -350, 50], [50, 250, 350]]) * mm
STEP = 1.8  # degrees
TURN = 2 * np.pi
