"""Robot arms: chains of links, their closed-form inverses, and the robots of the course."""

from .arm import Arm, ClosedFormArm
from .branches import explain, follow, nearest, representative, unwrapped, within
from .catalogue import IRB140, ITMO6R, PUMA560, SCARA, itmo_arm, loader_arm, spbu_arm
from .dexterity import distance_from_singularity, singular_values, total_length
from .elbow import elbow_arm
from .link import Link, dh_links
from .planar import ThreeLeverArm, three_lever
from .scara import ScaraPose, scara_arm
from .spherical_wrist import spherical_wrist
from .turning import turning_base
from .two_link import two_link

__all__ = [
    "IRB140",
    "ITMO6R",
    "PUMA560",
    "SCARA",
    "Arm",
    "ClosedFormArm",
    "Link",
    "ScaraPose",
    "ThreeLeverArm",
    "dh_links",
    "distance_from_singularity",
    "elbow_arm",
    "explain",
    "follow",
    "itmo_arm",
    "loader_arm",
    "nearest",
    "representative",
    "scara_arm",
    "singular_values",
    "spbu_arm",
    "spherical_wrist",
    "three_lever",
    "total_length",
    "turning_base",
    "two_link",
    "unwrapped",
    "within",
]
