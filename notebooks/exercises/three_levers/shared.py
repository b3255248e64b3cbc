"""Code that exercises and predictions of this lab share."""

from typing import Any

import numpy as np

from robokin import three_lever

ARM = three_lever(1.0)
K = np.array([1.5, 1.0])


def direction(angle: Any) -> Any:
    """The unit vector (..., 2) at an angle from the x axis."""
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)
