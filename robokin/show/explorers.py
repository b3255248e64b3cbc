"""Explorers: views in which the reader can move an arm without a kernel.

In `joint_explorer`, the reader turns joints. In `target_explorer`, the reader moves a target and
sees every branch of `ik`, and which branches are usable. The page computes with the scripts in
`js/`; `twin.py` prepares the data of the arm. The reasons why a row of `ik` is not usable are in
`arms/explanations.py`; all other text is in `explorer.WORDS`.
"""

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import floats, instance, short
from ..arms.arm import Arm, ClosedFormArm
from ..arms.branches import explain, nearest, within
from ..arms.dexterity import distance_from_singularity, spread
from ..arms.planar import ThreeLeverArm
from ..arms.scara import ScaraPose
from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, length_unit, mm
from .camera import STRAIGHT, common_plane, extent
from .checks import yes
from .explorer import (
    TAKE,
    TURNS,
    WORDS,
    Explorer,
    Pose,
    arm_page,
    as_transform,
    code_name,
    control,
    imports,
    inverted,
    number,
    picture,
    pose_data,
    sizes,
    units,
)
from .explorer_page import Control, FactRow, JointPage, TargetPage
from .findings import flags
from .levers_explorer import levers_explorer
from .numbers import rounded
from .things import Zone

__all__ = ["Explorer", "joint_explorer", "target_explorer"]

MEANT = (
    "Distance from singularity: the smallest singular value of the Jacobian, with lengths divided "
    "by the arm's reach, so that it has no unit. It says how slowly the tool moves in its worst "
    "direction; it is 0 at a singularity."
)

AREAS = (
    "Where the grey areas overlap, both elbows reach the target. On a coloured line, the joint of "
    "that colour is at its limit. "
)


def joint_explorer(
    arm: Arm, q: ArrayLike | None = None, *, singular: bool = False, wrist: bool = False
) -> "Explorer":
    """Show an arm with a ring and a slider for each joint, all its frames, and the pose of the
    flange. The explorer displays itself at the end of a cell. It opens at the posture q (n,), by
    default at a posture that is easy to see.

    With `singular`, it also shows the distance from a singularity and says which singularities the
    posture has, and the reader can display the ellipsoid of tool velocities. With `wrist`, it shows
    a larger picture of a translucent arm and marks the wrist centre, where the axes of the last
    three joints meet.

    Roll, pitch and yaw are rotations about the fixed x, y and z axes of the base, in this order: R
    = Rz Ry Rx. (At a pitch of +-90 degrees, roll and yaw rotate about the same line, and roll is
    set to zero.)

    Raises TypeError if `arm` is not an Arm. Raises ValueError if q is not a posture, or if `wrist`
    is True and the last three axes do not meet in one point.
    """
    instance(arm, Arm, "arm")
    start = _open(arm) if q is None else floats(q, "q", len(arm.limits))
    if start.ndim != 1:
        raise ValueError(f"q: wanted one posture ({len(arm.limits)},), got shape {start.shape}")
    name, size = length_unit(extent(arm))
    limits = arm.limits / sizes(arm)[:, None]
    controls = [
        control(f"q{i + 1}", unit["name"], low, high, 1 if unit["name"] != "m" else 0.001)
        for i, (unit, (low, high)) in enumerate(zip(units(arm), limits, strict=True))
    ]
    singular = yes(singular, "singular")
    centre = _wrist_centre(arm) if yes(wrist, "wrist") else None
    facts = (
        (f"position, {name}", "place", ["x", "y", "z"], 1 if size == mm else 3),
        ("orientation, °", "turns", ["roll", "pitch", "yaw"], 1),
        ("quaternion", "rotation", ["w", "x", "y", "z"], 4),
        ("distance from singularity", "near", [""], 3),
    )
    rows: list[FactRow] = [
        {"name": named, "fact": fact, "heads": heads, "decimals": decimals}
        for named, fact, heads, decimals in facts[: 4 if singular else 3]
    ]
    values = ", ".join(f"q{i + 1} {number(x, 0)}" for i, x in enumerate(start / sizes(arm)))
    flange = arm.fk(start).translation / size
    move, moved = ("move", "moved") if arm.prismatic.any() else ("turn", "turned")
    summary = (
        f"{arm.name} with joints that can be {moved}, at {values}: the flange is at "
        f"({', '.join(number(x, facts[0][3]) for x in flange)}) {name}."
    )
    page = arm_page(
        arm,
        f"{arm.name}: {move} the joints",
        summary,
        controls,
        start[None],
        near=_wrist_turns(arm, start) if wrist else None,
        meant=f"{TAKE}{TURNS} {MEANT if singular else ''}".strip(),
        code=f"{imports(arm)}\nq = np.array([{{q}}])\n{code_name(arm)}.fk(q)",
    )
    data: JointPage = {
        "kind": "joint",
        **page,
        "q": start.tolist(),
        "rows": rows,
        "singular": singular,
        "wrist": None if centre is None else rounded(centre),
    }
    frames = arm.frames(start)
    points = {} if centre is None else {WORDS["wrist"]: arm.fk(start) @ centre}
    still = picture(
        summary, arm, start, frames=[frames[i] for i in range(len(arm.links))], points=points
    )
    return Explorer(data, still)


def target_explorer(
    arm: ClosedFormArm | ThreeLeverArm, target: Pose | None = None, *, zone: bool = False
) -> "Explorer":
    """Show a target that the reader can drag with rings and arrows, and every branch of `ik`. Each
    branch has a row in a table, and the chosen branch is drawn boldly. The reader chooses a branch
    by clicking its row or from a menu. The menu can also select the usable branch nearest to the
    last posture. The explorer opens at the pose `target`, by default at one with as many usable
    branches as possible.

    The target of a six-axis arm is a position with roll, pitch and yaw, as in `joint_explorer`. The
    target of a SCARA is a position and the tool's angle, and that of a positioning arm is a
    position. For three levers, the explorer shows the position, the free angle alpha, the curve of
    the cost of moving there from the previous posture, and, if the levers are unequal, their
    lengths.

    With `zone`, the explorer shows a SCARA from above, together with the zone that its tool can
    reach (`things.Zone`). It says which of joints 1 and 2 is nearer to its limit, and how near.

    Raises TypeError if the arm has neither an inverse nor a family of postures, if `target` is not
    a Transform (a ScaraPose for a SCARA), or if `zone` is true and the arm is not a SCARA. Raises
    ValueError if `target` is a batch or out of reach, or if it is given for an arm of three levers.
    """
    around = Zone(arm) if yes(zone, "zone") else None  # type: ignore[arg-type]
    if isinstance(arm, ThreeLeverArm):
        if target is not None:
            raise ValueError(f"target: wanted None for an arm of three levers, got {short(target)}")
        return levers_explorer(arm)
    inverted(arm)
    place, turns, q = _showcase(arm) if target is None else _opened(arm, target)
    _, size = length_unit(extent(arm))
    controls = _target_controls(arm)
    target = _asked(arm, place, turns)
    rows = arm.ik(target)
    usable = np.all(within(arm, rows), axis=-1)
    among = usable if usable.any() else np.isfinite(rows).all(axis=-1)
    row = int(np.where(among, abs(rows - q).sum(axis=-1), np.inf).argmin())
    given = [*place[: len(controls) - len(turns)] / size, *np.array(turns) / deg]
    values = ", ".join(
        f"{c['name']} {number(x, 0 if c['unit'] != 'm' else 3)}"
        for c, x in zip(controls, given, strict=True)
    )
    watched = [0, 1] if around else []
    says = _found(arm, target, rows, row, watched)
    summary = WORDS["scene"].format(name=arm.name, values=values, says=says)
    shown = rows[np.isfinite(rows).all(axis=-1)]
    page = arm_page(
        arm,
        f"{arm.name}: move the target",
        summary,
        controls,
        shown,
        things=[around] if around else [],
        meant=TAKE
        + (AREAS if around else "")
        + (f"{TURNS} " if arm.target is Transform else "")
        + MEANT,
        code=f"{imports(arm)}\ntarget = {_target_code(arm, size)}\n"
        f"q = {code_name(arm)}.ik(target)[{{row}}]",
    )
    data: TargetPage = {
        "kind": "target",
        **page,
        "q": q.tolist(),
        "turns": list(map(float, turns)),
        "target": pose_data(target),
        "branches": [flags(arm, k) for k in range(len(rows))],
        "heads": _heads(arm),
        "turning": np.flatnonzero(~arm.prismatic).tolist(),
        "watched": watched,
        "task": None,
    }
    if around:
        data["scene"]["view"] = list(STRAIGHT[2])
    others = [rows[k] for k in np.flatnonzero(np.isfinite(rows).all(axis=-1)) if k != row]
    posed = {"target": as_transform(target)} if arm.target is not np.ndarray else {}
    still = picture(summary, arm, nearest(arm, rows[[row]], q), others, posed, zone=around)
    return Explorer(data, still)


# --- The opening posture and target ---------------------------------------------------------------


def _showcase(arm: ClosedFormArm) -> tuple[Floats, Floats, Floats]:
    """Return a target with as many usable branches as possible, far from singularities, in front of
    the arm and above the floor. (If there is none, return the target at the middle of all limits.)

    The result is the position (3,) and the rotations in radians, in round numbers, and a posture
    (n,) that reaches the target.
    """
    middle, size = arm.limits.mean(axis=-1), extent(arm)
    best, most = (arm.fk(middle).translation, _turned(arm, arm.fk(middle)), middle), -1.0
    for q in spread(arm, 160):
        pose = arm.fk(q)
        place = np.round(pose.translation / (50 * mm)) * 50 * mm
        low = 0.1 * size if arm.target is Transform else 0
        if place[0] < 0.2 * size or place[2] < low:
            continue
        turns = np.round(_turned(arm, pose) / (15 * deg)) * 15 * deg
        rows = arm.ik(_asked(arm, place, turns))
        usable = np.all(within(arm, rows), axis=-1)
        if usable.any():
            near = np.nanmin(distance_from_singularity(arm, rows))
            # Rank singular targets last: two branches coincide there and vanish a step farther.
            score = (usable.sum() if near > 0.03 else 0) + float(np.round(near, 6))
            if score > most:
                best = place, turns, nearest(arm, rows[usable], np.zeros(len(arm.links)))
                most = score
    return best


def _opened(arm: ClosedFormArm, target: Pose) -> tuple[Floats, Floats, Floats]:
    """Return the same values as `_showcase`, but for a given target."""
    kind = ScaraPose if arm.target is ScaraPose else Transform
    if instance(target, kind, "target").shape:
        raise ValueError(f"target: wanted a single pose, got a batch of shape {target.shape}")
    rows = arm.ik(target)
    exists = np.isfinite(rows).all(axis=-1)
    if not exists.any():
        raise ValueError(f"target: wanted a pose in reach. {explain(arm, target, 0)}")
    usable = np.all(within(arm, rows), axis=-1)
    pose = as_transform(target)
    q = nearest(arm, rows[usable if usable.any() else exists], np.zeros(len(arm.links)))
    return pose.translation, _turned(arm, pose), q


def _open(arm: Arm) -> Floats:
    """Return a posture in round numbers that is far from singularities, in front of the arm and
    above the floor.
    """
    unit, size = sizes(arm), extent(arm)
    q = np.round(spread(arm, 160, 75 * deg) / unit / 5) * 5 * unit
    q = q[((q >= arm.limits[:, 0]) & (q <= arm.limits[:, 1])).all(axis=-1)]
    tool, near = arm.fk(q), distance_from_singularity(arm, q)
    place, forward = tool.translation, tool.rotation @ (0, 0, 1)
    good = (place[:, 0] > 0.2 * size) & (place[:, 2] > -1e-9) & (forward[:, 2] < 0.9)
    score = np.where(good, 1.0, 0.5) * near - 0.2 * abs(place[:, 1]) / size
    best: Floats = q[np.round(score, 6).argmax()] + 0.0
    return best


# --- The wrist ------------------------------------------------------------------------------------


def _wrist_centre(arm: Arm) -> Floats:
    """Return the point (3,) in flange coordinates where the last three axes meet. Raises ValueError
    if they do not meet.
    """
    q = np.zeros(len(arm.links))
    frames, last = arm.frames(q), range(len(q))[-3:]
    places = np.stack([frames[i] @ arm.links[i].before.translation for i in last])
    axes = np.stack([(frames[i] @ arm.links[i].before).rotation @ arm.links[i].axis for i in last])
    across = np.eye(3) - axes[:, :, None] * axes[:, None]  # removes the component along an axis
    offsets = (across @ places[..., None])[..., 0]
    centre, _, rank, _ = np.linalg.lstsq(across.reshape(-1, 3), offsets.ravel())
    off = np.linalg.norm(across @ centre - offsets, axis=-1).max()
    if len(last) < 3 or rank < 3 or arm.prismatic[-3:].any() or off > 1e-9 * arm.reach:
        raise ValueError(f"wrist: wanted an arm whose last three axes meet, got {arm.name}")
    return arm.fk(q).inverse() @ centre


def _wrist_turns(arm: Arm, q: Floats) -> Floats:
    """Return postures (k, n) in which one of the last three joints of q (n,) moves between its
    limits.
    """
    turned = np.tile(q, (3, 25, 1))
    for row, j in zip(turned, range(len(q))[-3:], strict=True):
        low, high = arm.limits[j].clip(-180 * deg, 180 * deg)
        row[:, j] = np.linspace(low, high, 25)
    return turned.reshape(-1, len(q))


# --- Targets --------------------------------------------------------------------------------------


def _target_controls(arm: Arm) -> list[Control]:
    """Return the sliders of a target, for its position and its rotations."""
    name, size = length_unit(extent(arm))
    most = float(np.ceil(1.05 * extent(arm) / (50 * mm)) * 50 * mm / size)
    letters = "xyz" if common_plane([arm]) is None else "xy"
    controls = [control(x, name, -most, most, 1 if size == mm else 0.001) for x in letters]
    return controls + [control(turn, "°", -180, 180, 1) for turn in _turns(arm)]


def _heads(arm: Arm) -> list[str]:
    """Return the headings of the table of branches."""
    turning = np.flatnonzero(~arm.prismatic)
    joints = ", ".join(f"q{j + 1}" for j in turning)
    return [
        "branch",
        "status",
        *(f"q{i + 1} {unit['name']}" for i, unit in enumerate(units(arm))),
        "distance from singularity",
        # only angles are counted, since a stroke is the same in every row
        "travel, °" if len(turning) == len(arm.links) else f"travel of {joints}, °",
    ]


def _found(arm: ClosedFormArm, target: Pose, rows: Floats, row: int, watched: list[int]) -> str:
    """Say how many rows of `ik` are usable, explain one of them, and say which of its watched
    joints is nearest to a limit.
    """
    usable = np.all(within(arm, rows), axis=-1)
    count = int(usable.sum())
    name = {0: "noneUsable", 1: "oneUsable"}.get(count, "someUsable")
    text = WORDS[name].format(count=count, all=len(rows), why=explain(arm, target, row))
    return f"{text} {_room(arm, rows[row], watched)}" if watched and usable[row] else text


def _turns(arm: Arm) -> tuple[str, ...]:
    return {Transform: ("roll", "pitch", "yaw"), ScaraPose: ("angle",)}.get(arm.target, ())


def _asked(arm: Arm, place: Floats, turns: Floats) -> Pose:
    """Return the target with this position (3,) and these rotations in radians."""
    if arm.target is ScaraPose:
        return ScaraPose(place, turns[0])
    if arm.target is Transform:
        return Transform(Quaternion.from_roll_pitch_yaw(*turns), place)
    return Transform(translation=place)


def _turned(arm: Arm, pose: Transform) -> Floats:
    turns = np.array(pose.rotation.as_roll_pitch_yaw())
    return {Transform: turns, ScaraPose: turns[2:]}.get(arm.target, turns[:0])


def _target_code(arm: Arm, size: float) -> str:
    unit = " * mm" if size == mm else ""
    place = f"({{x}}{unit}, {{y}}{unit}, {{z}}{unit})"
    if arm.target is ScaraPose:
        return f"robokin.ScaraPose({place}, {{angle}} * deg)"
    if arm.target is Transform:
        turns = "{roll} * deg, {pitch} * deg, {yaw} * deg"
        return f"robokin.Transform(robokin.Quaternion.from_roll_pitch_yaw({turns}), {place})"
    return place


def _room(arm: Arm, q: Floats, joints: list[int]) -> str:
    """Say how far the joint nearest to one of its limits is from this limit."""
    room = abs(arm.limits[joints] - q[joints, None]) / deg
    k, side = np.unravel_index(room.argmin(), room.shape)
    limit = f"{arm.limits[joints[k], side] / deg:g}°"
    return WORDS["room"].format(joint=joints[k] + 1, room=number(room.min(), 1), limit=limit)
