"""Motions: time laws, paths, derivatives and recordings."""

from .derivatives import differentiate
from .duration import shortest_duration
from .laws import TimeLaw, linear, quintic, trapezoidal
from .maximum import Maximum, refined_maximum
from .paths import blend, lin, lin_lin, ptp
from .recording import Extreme, Jump, Recording, record

__all__ = [
    "Extreme",
    "Jump",
    "Maximum",
    "Recording",
    "TimeLaw",
    "blend",
    "differentiate",
    "lin",
    "lin_lin",
    "linear",
    "ptp",
    "quintic",
    "record",
    "refined_maximum",
    "shortest_duration",
    "trapezoidal",
]
