"""The explorer of a straight line past a wrist singularity."""

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import floats, length, short
from ..arms.arm import ClosedFormArm
from ..arms.branches import within
from ..arms.spherical_wrist import SphericalWristGeometry
from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, mm, wrapped
from .explorer import (
    WORDS,
    Explorer,
    arm_page,
    code_name,
    control,
    imports,
    inverted,
    number,
    picture,
    pose_data,
)
from .explorer_page import SingularityPage
from .numbers import rounded

HALF = 100 * mm  # half the length of the line
SPEED = 100 * mm  # per second: the speed of the tool along the line
JOINT = 3  # the index of joint 4
MISSES = 200  # maximum number of values of the miss above 0, each of which is checked
WORDS_HERE = {
    **{name: WORDS[name] for name in ("copy", "copied")},
    "takeTool": "tool along the line",
    "singular": "singular pose",
    "speed": "Speed of joint 4 for 100 mm/s along the line",
    "turns": "{turns} turns/s",
    "degrees": "= {degrees}°/s",
    "free": "free",
    "near": "The tool is {distance} mm from the singular pose. Joint 4 is at {turned}°; the angle "
    "between axes 4 and 6 is {bend}°.",
    "isFree": "Singular: axes 4 and 6 are in line. Joint 4 is free: joint 6 can undo its "
    "rotation, so joint 4 need not turn at all.",
    "axis": "turns/s, with a miss of {miss} mm",
    "scene": "{name} with its tool at {place} mm on a line that passes {miss} mm beside the "
    "singular pose. {says}",
    "curve": "The speed of joint 4 along the line, with a miss of {miss} mm. It "
    "reaches {most} turns/s; at {place} mm it is {speed}.",
}
MEANT = (
    "Drag the ring at the tool along the line, or move the sliders. The number "
    "does not depend on how fast you drag: it follows from the Jacobian J at this posture, as the "
    "fourth entry of J\u207b\u00b9(v, 0), where v is the velocity of the tool, which does not "
    "rotate. The dash-dotted lines are axes 4 and 6."
)


def singularity_explorer(
    arm: ClosedFormArm,
    q: ArrayLike,
    way: ArrayLike,
    *,
    most: float = 50 * mm,
    step: float = 1 * mm,
) -> Explorer:
    """Show an arm whose tool the reader pulls along a straight line past a wrist singularity. The
    singular pose is that of the tool at the posture q (6,). The explorer shows how fast joint 4
    would have to turn for the tool to move along the line at 100 mm/s without rotating. The line
    has the direction `way` (3,) in base coordinates and extends 100 mm to either side of its
    middle. From the singular pose, the middle is displaced in a direction perpendicular to the line
    and to axis 4. A slider sets this distance, the miss, from 0 to `most` in steps of `step`
    (metres).

    The speed is the fourth entry of J^-1 (v, 0), where J is the Jacobian and v the velocity of the
    tool. In the singular pose itself, joint 4 is free. Raises TypeError if the arm has no spherical
    wrist. Raises ValueError if q is not one posture with a wrist singularity and no other, if `way`
    is along axis 4, if `step` is not a whole number of millimetres, or if `most` is not 1 to 200
    steps. Raises ValueError if the arm meets another singularity on the line, or cannot follow it
    within its limits.
    """
    inverted(arm)
    if not isinstance(arm.geometry, SphericalWristGeometry):
        raise TypeError(f"arm: wanted an arm with a spherical wrist, got {arm.name}")
    posture = _singular(arm, q)
    along, beside = _directions(arm, posture, way)
    misses = _misses(most, step)
    hit = arm.fk(posture)
    # remove rounding errors, which differ between processors
    pose = Transform(Quaternion(rounded(hit.rotation.wxyz, 12)), rounded(hit.translation, 12))
    row, rows = _followed(arm, pose, posture, along, beside, misses)
    opening = rows[0, 0]
    speed = abs(np.linalg.solve(arm.jacobian(opening), [*SPEED * along, 0, 0, 0])[JOINT])
    summary = (
        f"{arm.name} with its tool 100 mm before the singular pose, on a straight line through it. "
        f"For 100 mm/s along it joint 4 turns at {number(speed / (360 * deg), 2)} turns/s."
    )
    page = arm_page(
        arm,
        f"{arm.name}: pull the tool past the wrist singularity",
        summary,
        [
            control("place", "mm", -HALF / mm, HALF / mm, 1, 0),
            control("miss", "mm", 0, misses[-1] / mm, round(step / mm), 0),
        ],
        opening[None],
        near=rows[:: len(rows) // 2, :: len(misses) - 1].reshape(-1, 6),
        meant=MEANT,
        code=_code(arm, pose, along, beside, row),
    )
    data: SingularityPage = {
        "kind": "singularity",
        **page,
        "words": WORDS_HERE,
        "unit": {"name": "mm", "size": mm, "code": "mm"},
        "pose": pose_data(pose),
        "along": along.tolist(),
        "beside": beside.tolist(),
        "row": row,
        "speed": SPEED,
    }
    return Explorer(data, picture(summary, arm, opening, targets={WORDS_HERE["singular"]: pose}))


def _singular(arm: ClosedFormArm, q: ArrayLike) -> Floats:
    """Return q as one posture (6,). Raises ValueError if it does not have a wrist singularity, or
    has another one.
    """
    posture = floats(q, "q", 6)
    held = [name for name, holds in arm.geometry.singularities(posture).items() if np.any(holds)]
    if posture.ndim != 1 or held != ["wrist"]:
        raise ValueError(
            "q: wanted one posture (6,) with a wrist singularity and no other, got shape "
            f"{posture.shape} and {' and '.join(held) or 'none'}"
        )
    return posture


def _directions(arm: ClosedFormArm, posture: Floats, way: ArrayLike) -> tuple[Floats, Floats]:
    """Return two unit vectors (3,): along the line, and from the singular pose to the line."""
    direction, axis = floats(way, "way", 3), arm.jacobian(posture)[3:, JOINT]
    direction = direction / (abs(direction).max(initial=0.0) or 1.0)  # its square could overflow
    found = []
    for vector in (direction, np.cross(axis, direction)):
        size = np.linalg.norm(vector)
        if direction.ndim != 1 or size < 1e-6:
            raise ValueError(f"way: wanted a direction (3,) not along axis 4, got {short(way)}")
        found.append(np.array(rounded(vector / size, 12)))
    return found[0], found[1]


def _misses(most: float, step: float) -> Floats:
    """Return the values of the miss: 0, step, 2 step, ..., most."""
    apart, end = (length(x, name) / mm for x, name in ((step, "step"), (most, "most")))
    count = round(end / apart) if end < (MISSES + 0.5) * apart else 0
    if not count or max(abs(apart - round(apart)), abs(end - count * apart)) > 1e-6:
        raise ValueError(
            f"most: wanted 1 to {MISSES} steps of whole millimetres, got {end:g} mm in steps of "
            f"{apart:g} mm"
        )
    return np.asarray(round(apart) * mm * np.arange(count + 1), dtype=float)


def _followed(
    arm: ClosedFormArm,
    pose: Transform,
    posture: Floats,
    along: Floats,
    beside: Floats,
    misses: Floats,
) -> tuple[int, Floats]:
    """Return the row of `ik` that is nearest to a posture at the start of the line, and its joint
    values (places, misses, 6) at every step of both sliders.
    """
    places = np.linspace(-HALF, HALF, 201)
    shift = places[:, None, None] * along + misses[:, None] * beside
    rows = arm.ik(Transform(pose.rotation, pose.translation + shift))
    travel = abs(wrapped(rows[0, 0], posture)).sum(axis=-1)
    row = int(np.nan_to_num(travel, nan=np.inf).argmin())
    q = rows[..., row, :]
    good = np.isfinite(q).all(axis=-1) & within(arm, np.nan_to_num(q)).all(axis=-1)
    held = np.any(list(arm.geometry.singularities(np.nan_to_num(q)).values()), axis=0)
    held[len(places) // 2, 0] = False  # the singular pose itself
    if not (good & ~held).all():
        at, aside = np.argwhere(held | ~good)[0]
        raise ValueError(
            "way: wanted a line that the arm can follow, without another singularity, got no "
            f"posture at {places[at] / mm:.0f} mm with a miss of {misses[aside] / mm:.0f} mm"
        )
    return row, q


def _code(arm: ClosedFormArm, pose: Transform, along: Floats, beside: Floats, row: int) -> str:
    name = code_name(arm)
    return "\n".join(
        [
            imports(arm),
            "place, miss = {place} * mm, {miss} * mm",
            f"along, beside = np.array({[along.tolist(), beside.tolist()]})",
            f"origin = np.array({pose.translation.tolist()}) + place * along + miss * beside",
            f"rotation = robokin.Quaternion({pose.rotation.wxyz.tolist()})",
            f"q = {name}.ik(robokin.Transform(rotation, origin))[{row}]",
            f"velocity = [*{SPEED / mm:.0f} * mm * along, 0, 0, 0]  # of the tool: m/s, then rad/s",
            f"rates = np.linalg.lstsq({name}.jacobian(q), velocity)[0]",
            "rates[3] / (360 * deg)  # joint 4, turns/s",
        ]
    )
