"""Robot arms: chains of links, their closed-form inverses, and the machines of the lessons."""

from .arm import Arm, Link
from .branches import explain, follow, nearest, within
from .catalogue import IRB140
from .spherical_wrist import spherical_wrist

__all__ = ["IRB140", "Arm", "Link", "explain", "follow", "nearest", "spherical_wrist", "within"]
