"""Motions: time laws, paths, and their derivatives."""

from .derivatives import differentiate
from .laws import TimeLaw, linear, quintic, trapezoidal
from .paths import blend, lin, lin_lin, ptp

__all__ = [
    "TimeLaw",
    "blend",
    "differentiate",
    "lin",
    "lin_lin",
    "linear",
    "ptp",
    "quintic",
    "trapezoidal",
]
