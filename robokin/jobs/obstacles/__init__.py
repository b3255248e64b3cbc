"""The three-lever arm near a point obstacle H: collisions, via points, clearance, and a path
around it.

`plan` is the control system of source 003, figure 33; the other functions are its parts. The names
are those of the document:

O, B, A, K    base, two joints and gripper of the arm before the motion; A1, K1 after it
H             the obstacle, a point; the levers OB, BA, AK have no thickness
K2, K3        via points for the gripper, on a circle around H
path (k, 3)   postures q = (gamma, beta, alpha) in radians; between two of them every joint turns
              at constant speed (PTP)
S             the sum of the absolute changes of all joint angles along a path, in radians

Points are (2,), or (3,) with z = 0, in metres.
"""

from .collision import (
    LEVERS,
    TOLERANCE,
    WORK,
    clearance,
    distances,
    in_quadrilateral,
    keeps,
    locate,
    swept,
)
from .planner import CIRCLES, Plan, along, plan, via_path, via_points
from .posture_grid import STEP, way_round

__all__ = [
    "CIRCLES",
    "LEVERS",
    "STEP",
    "TOLERANCE",
    "WORK",
    "Plan",
    "along",
    "clearance",
    "distances",
    "in_quadrilateral",
    "keeps",
    "locate",
    "plan",
    "swept",
    "via_path",
    "via_points",
    "way_round",
]
