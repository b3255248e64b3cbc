"""The twin: what Python hands over to the page's own kinematics, the scripts of `js/`.

A page without a kernel computes in JavaScript, with the same formulas in the same order. It knows
no arm and no sentence: both come from here as data, every number in full (the nearest rounded one
would be another machine).
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from .._validate import instance
from ..arms import branches, geometry
from ..arms.arm import Arm, ClosedFormArm
from ..arms.dexterity import movable
from ..arms.elbow import ElbowGeometry
from ..arms.link import Link
from ..arms.planar import ThreeLeverGeometry, TwoLinkGeometry
from ..arms.scara import ScaraGeometry, ScaraPose
from ..arms.spherical_wrist import FREE, NOISY, SphericalWristGeometry
from ..arms.verdicts import SENTENCES
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
TOLERANCES = {
    "ROUNDING": geometry.ROUNDING,
    "STRAIGHT": geometry.STRAIGHT,
    "FREE": geometry.FREE,
    "SINGULAR": geometry.SINGULAR,
    "STUCK": FREE,
    "NOISY": NOISY,
    "SLACK": branches.SLACK,
}


def arm_data(arm: Arm) -> dict[str, Any]:
    """What the scripts of `js/` have to know of an arm, for JSON.

    name, reach   as in Python
    target        "Transform", "ScaraPose" or "point"; None for another one
    chain         see `chain`
    limits        n pairs in rad, m if prismatic; limits_in_words, the same for a sentence
    prismatic     n times true or false
    units         for each joint what a sentence counts in: name, and size in rad or m
    speed_limits  n, or None
    movable       which rows of the Jacobian the arm can move (see `singular_values`)
    geometry      see `inverse_data`
    branches, carried, sentences  what `ik` and `explain` need; only where there is an inverse
    tolerances    how near is near
    """
    limits = instance(arm, Arm, "arm").limits.tolist()
    units = [(" mm", mm) if link.prismatic else ("°", deg) for link in arm.links]
    data = {
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


def chain(links: Sequence[Link]) -> list[dict[str, Any]]:
    """The links for `frames` in kinematics.js: the fixed transforms as 12 numbers, the rows of
    [R | p].
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


def inverse_data(arm: Arm) -> dict[str, Any]:
    """The numbers of an arm's inverse: `kind`, which geometries.js has to know (None: it does not),
    and the fields of the geometry by their names.

    turns  cosine and sine of the fixed angles by which the inverse turns a direction on: they
           decide which rows exist, and no two languages need agree on the last bit of a cosine
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
    return data
