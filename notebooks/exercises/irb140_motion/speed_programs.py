"""Helpers for the correct and wrong programs of exercise 3 of this lab."""

import numpy as np

from robokin import deg, differentiate
from robokin.units import wrapped

__all__ = ["deg", "differentiate", "np", "wrapped"]
