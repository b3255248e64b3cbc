"""Robot arms: chains of links, their closed-form inverses, and the machines of the lessons."""

from .arm import Arm, Link, dh_links
from .branches import explain, follow, nearest, within
from .catalogue import IRB140, ITMO6R, PUMA560, SCARA, itmo_arm, loader_arm, spbu_arm
from .elbow import elbow_arm
from .planar import three_lever, two_link
from .scara import Target, scara
from .spherical_wrist import spherical_wrist

__all__ = [
    "IRB140",
    "ITMO6R",
    "PUMA560",
    "SCARA",
    "Arm",
    "Link",
    "Target",
    "dh_links",
    "elbow_arm",
    "explain",
    "follow",
    "itmo_arm",
    "loader_arm",
    "nearest",
    "scara",
    "spbu_arm",
    "spherical_wrist",
    "three_lever",
    "two_link",
    "within",
]
