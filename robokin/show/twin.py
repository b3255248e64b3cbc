"""The data that Python passes to the page's own kinematics, which are the scripts in `js/`.

A page without a kernel computes in JavaScript, with the same formulas in the same order. The
scripts contain no arms and no sentences: both come from here as data. Every number has full
precision, since a rounded number would describe another machine.
"""

from collections.abc import Sequence
from typing import Any, Literal, NotRequired, TypeAlias, TypedDict, cast

import numpy as np

from .._validate import instance
from ..arms import branches, geometry
from ..arms.arm import Arm, ClosedFormArm
from ..arms.dexterity import movable
from ..arms.elbow import ElbowGeometry
from ..arms.explanations import SENTENCES
from ..arms.link import Link
from ..arms.planar import ThreeLeverGeometry
from ..arms.scara import ScaraGeometry, ScaraPose
from ..arms.spherical_wrist import FREE, NOISY, SphericalWristGeometry
from ..arms.two_link import TwoLinkGeometry
from ..transform import Transform
from ..units import deg, mm

KINDS: dict[type, str] = {
    ElbowGeometry: "elbow",
    SphericalWristGeometry: "wrist",
    ScaraGeometry: "scara",
    TwoLinkGeometry: "two_link",
    ThreeLeverGeometry: "three_lever",
}
TARGETS: dict[type, str] = {Transform: "Transform", ScaraPose: "ScaraPose", np.ndarray: "point"}
TOLERANCES: "Tolerances" = {
    "ROUNDING": geometry.ROUNDING,
    "STRAIGHT": geometry.STRAIGHT,
    "FREE": geometry.FREE,
    "SINGULAR": geometry.SINGULAR,
    "STUCK": FREE,
    "NOISY": NOISY,
    "SLACK": branches.SLACK,
}


class PageLink(TypedDict):
    """One link of a chain: the transform to its joint, the joint's axis, the transform to its end.
    A transform is 12 numbers, the rows of [R | p].
    """

    before: list[float]
    axis: list[float]
    after: list[float]
    prismatic: bool


class ElbowData(TypedDict):
    """The fields of `elbow.Elbow`."""

    carried: str
    sign1: float
    sign2: float
    sign3: float
    shoulder_x: float
    shoulder_z: float
    lateral: float
    upper: float
    fore: float
    upper_angle: float
    fore_angle: float
    reach: float


class WristData(TypedDict):
    """The fields of `spherical_wrist.Wrist`."""

    sign5: float
    sign6: float
    axis4: float
    from_flange: list[float]
    centre_from_flange: list[float]


class ElbowTurns(TypedDict):
    """Cosine and sine of the constant angles that the inverse adds to a direction."""

    upper: tuple[float, float]
    fore: tuple[float, float]


class WristTurns(ElbowTurns):
    """`ElbowTurns`, and cosine and sine of the constant angle of axis 4."""

    axis4: tuple[float, float]


class ElbowInverse(TypedDict):
    """The data of an `elbow.ElbowGeometry`."""

    kind: Literal["elbow"]
    elbow: ElbowData
    reach: float
    turns: ElbowTurns


class WristInverse(TypedDict):
    """The data of a `spherical_wrist.SphericalWristGeometry`."""

    kind: Literal["wrist"]
    elbow: ElbowData
    wrist: WristData
    reach: float
    turns: WristTurns


class ScaraInverse(TypedDict):
    """The data of a `scara.ScaraGeometry`."""

    kind: Literal["scara"]
    height: float
    upper: float
    fore: float
    reach: float


class TwoLinkInverse(TypedDict):
    """The data of a `two_link.TwoLinkGeometry`."""

    kind: Literal["two_link"]
    l1: float
    l2: float
    base: tuple[float, float]
    reach: float


class ThreeLeverInverse(TypedDict):
    """The data of a `planar.ThreeLeverGeometry`."""

    kind: Literal["three_lever"]
    levers: tuple[float, float, float]
    lever: float
    inner: float
    reach: float


class NoInverse(TypedDict):
    """The inverse of an arm whose geometry is not in geometries.js."""

    kind: None


Inverse: TypeAlias = (
    ElbowInverse | WristInverse | ScaraInverse | TwoLinkInverse | ThreeLeverInverse | NoInverse
)


class Tolerances(TypedDict):
    """The type of TOLERANCES."""

    ROUNDING: float
    STRAIGHT: float
    FREE: float
    SINGULAR: float
    STUCK: float
    NOISY: float
    SLACK: float


class JointUnit(TypedDict):
    """The unit of a joint in a sentence: its name, and its size in radians or metres."""

    name: str
    size: float


class ArmData(TypedDict):
    """The data of an arm: see `arm_data`."""

    name: str
    target: str | None
    reach: float
    chain: list[PageLink]
    limits: list[list[float]]
    limits_in_words: list[list[str]]
    prismatic: list[bool]
    units: list[JointUnit]
    speed_limits: list[float] | None
    movable: list[int]
    geometry: Inverse
    tolerances: Tolerances
    branches: NotRequired[list[list[int]]]
    carried: NotRequired[str]
    sentences: NotRequired[dict[str, str]]


def arm_data(arm: Arm) -> ArmData:
    """Return the data of an arm for the scripts in `js/`, which JSON can represent.

    name, reach   as in Python
    target        "Transform", "ScaraPose" or "point"; None for another type
    chain         see `chain`
    limits        n pairs in rad (m if prismatic); limits_in_words contains them as text
    prismatic     n booleans
    units         the unit of each joint in a sentence: name, and size in rad or m
    speed_limits  n speeds, or None
    movable       which rows of the Jacobian the arm can move (see `singular_values`)
    geometry      see `inverse_data`
    branches, carried, sentences  what `ik` and `explain` need; only if there is an inverse
    tolerances    see TOLERANCES
    """
    limits = instance(arm, Arm, "arm").limits.tolist()
    units = [(" mm", mm) if link.prismatic else ("°", deg) for link in arm.links]
    data: ArmData = {
        "name": arm.name,
        "target": TARGETS.get(arm.target),
        "reach": float(arm.reach),
        "chain": chain(arm.links),
        "limits": limits,
        "limits_in_words": [
            [f"{limit / size:g}{name}" for limit in pair]
            for pair, (name, size) in zip(limits, units, strict=True)
        ],
        "prismatic": arm.prismatic.tolist(),
        "units": [{"name": name, "size": size} for name, size in units],
        "speed_limits": None if arm.speed_limits is None else arm.speed_limits.tolist(),
        "movable": movable(arm).tolist(),
        "geometry": inverse_data(arm),
        "tolerances": TOLERANCES,
    }
    if isinstance(arm, ClosedFormArm):
        data |= {
            "branches": arm.branches.tolist(),
            "carried": arm.geometry.carried,
            "sentences": SENTENCES,
        }
    return data


def chain(links: Sequence[Link]) -> list[PageLink]:
    """Return the links for `frames` in kinematics.js, with the fixed transforms as 12 numbers, the
    rows of [R | p].
    """
    return [
        {
            "before": link.before.as_matrix()[:3].ravel().tolist(),
            "axis": link.axis.tolist(),
            "after": link.after.as_matrix()[:3].ravel().tolist(),
            "prismatic": link.prismatic,
        }
        for link in links
    ]


def inverse_data(arm: Arm) -> Inverse:
    """Return the numbers of an arm's inverse: `kind`, which is the name of the geometry in
    geometries.js (None if it is not there), and the fields of the geometry by their names.

    turns  cosine and sine of the constant angles that the inverse adds to a direction. They are
           stored because they decide which rows exist, and the last bit of a cosine may differ
           between two languages
    """
    solid = arm.geometry
    kind = KINDS.get(type(solid))
    if kind is None:
        return {"kind": None}
    data: dict[str, Any] = {"kind": kind}
    for name, value in vars(solid).items():
        if name != "links":
            data[name] = value._asdict() if hasattr(value, "_asdict") else value
    if isinstance(solid, (ElbowGeometry, SphericalWristGeometry)):
        upper, fore = solid.elbow.upper_angle, solid.elbow.fore_angle
        angles = {"upper": -upper, "fore": upper - fore}
        if isinstance(solid, SphericalWristGeometry):
            angles["axis4"] = solid.wrist.axis4 - fore
        data["turns"] = {
            name: [float(np.cos(angle)), float(np.sin(angle))] for name, angle in angles.items()
        }
    return cast(Inverse, data)
