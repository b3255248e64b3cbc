"""robokin: the kinematics of robot arms, as readable code and interactive labs.

Lengths are in metres and angles in radians; write `352 * mm` and `90 * deg` for arguments. Figures
and players come from `robokin.show`. There are no masses and no forces, with one exception:
`robokin.jobs.steppers` integrates the torque on the rotor of a motor.
"""

from .arms import (
    IRB140,
    ITMO6R,
    PUMA560,
    SCARA,
    Arm,
    ClosedFormArm,
    Link,
    ScaraPose,
    ThreeLeverArm,
    dh_links,
    distance_from_singularity,
    elbow_arm,
    explain,
    follow,
    itmo_arm,
    loader_arm,
    nearest,
    representative,
    scara_arm,
    singular_values,
    spbu_arm,
    spherical_wrist,
    three_lever,
    turning_base,
    two_link,
    within,
)
from .motion import (
    Recording,
    TimeLaw,
    blend,
    differentiate,
    lin,
    lin_lin,
    linear,
    ptp,
    quintic,
    record,
    shortest_duration,
    trapezoidal,
)
from .quaternion import Quaternion
from .transform import Transform
from .units import deg, mm

__version__ = "0.2.0"

__all__ = [
    "IRB140",
    "ITMO6R",
    "PUMA560",
    "SCARA",
    "Arm",
    "ClosedFormArm",
    "Link",
    "Quaternion",
    "Recording",
    "ScaraPose",
    "ThreeLeverArm",
    "TimeLaw",
    "Transform",
    "blend",
    "deg",
    "dh_links",
    "differentiate",
    "distance_from_singularity",
    "elbow_arm",
    "explain",
    "follow",
    "itmo_arm",
    "lin",
    "lin_lin",
    "linear",
    "loader_arm",
    "mm",
    "nearest",
    "ptp",
    "quintic",
    "record",
    "representative",
    "scara_arm",
    "shortest_duration",
    "singular_values",
    "spbu_arm",
    "spherical_wrist",
    "three_lever",
    "trapezoidal",
    "turning_base",
    "two_link",
    "within",
]
