"""Units: multiply by a unit to get metres or radians, divide by it to convert back.

Inside robokin, lengths are in metres and angles in radians. The labs write ``352 * mm`` and
``90 * deg``.
"""

from math import pi

import numpy as np

from ._arrays import Floats

mm = 1e-3  #: a millimetre in metres
deg = pi / 180  #: a degree in radians


def wrapped(angle: Floats, near: Floats | float = 0.0) -> Floats:
    """The angles nearest to `near` (within half a turn) that differ from `angle` by whole turns."""
    return angle - 2 * pi * np.round((angle - near) / (2 * pi))


def length_unit(size: float) -> tuple[str, float]:
    """Return the name and the length in metres of the unit that suits an object of this size (m):
    millimetres up to 2 m, then metres.
    """
    return ("mm", mm) if size <= 2 else ("m", 1.0)


def in_words(length: float) -> str:
    """Return a length (m) as text for a sentence: millimetres below 10 m, then metres."""
    return f"{length / mm:.1f} mm" if length < 10 else f"{length:.1f} m"
