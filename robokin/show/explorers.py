"""Explorers: an arm in a page that answers to the hand, without a kernel.

`joint_explorer` has its joints taken and turned, `target_explorer` a target moved, with every
branch of `ik` drawn and judged, `motion_explorer` the stations of a blended motion. The page
computes by the scripts of `js/`; `twin.py` says what they are told of an arm. Why a row of `ik`
does not exist or cannot be used stands in `arms/verdicts.py`, everything else that is said in
`WORDS`.
"""

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import TypeAlias

import numpy as np

import robokin

from .._arrays import ArrayLike, Floats
from .._validate import floats, instance, whole
from ..arms.arm import Arm, ClosedFormArm
from ..arms.branches import explain, follow, nearest, unwrapped, within
from ..arms.dexterity import distance_from_singularity, spread
from ..arms.planar import ThreeLeverArm
from ..arms.scara import ScaraPose
from ..motion.laws import quintic
from ..motion.maximum import refined_maximum
from ..motion.paths import blend
from ..motion.recording import FEW, LEAP, record
from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, length_unit, mm
from . import plots
from .arguments import named_targets
from .camera import VIEW, arm_points, common_plane, extent, scene_data
from .numbers import tidy
from .page import Control, Corner, FactRow, Law, PageExplorer, PagePose, PageScene, PageUnit
from .palette import DASHES
from .player import Output, still_picture
from .scene import Scene
from .twin import KINDS, arm_data

Pose: TypeAlias = Transform | ScaraPose

SAMPLES = 241  # of a motion: enough for its speeds, few enough to follow a hand
LAWS: Sequence[Law] = ("quintic", "trapezoidal", "linear")
CORNERS: Sequence[Corner] = ("parabola", "quintic")
NEAREST = "nearest"
MEANT = (
    "Distance from singularity: the smallest singular value of the Jacobian, lengths divided by "
    "the arm's reach so that it has no unit. It says how little the tool moves in its worst "
    "direction; 0 is a singularity."
)
TURNS = "Roll, pitch and yaw turn about the base's x, then y, then z axis."
TAKE = "Take hold of a ring and drag it, or move the sliders. "
WORDS: Mapping[str, str] = {
    "target": "target",
    "branch": "branch",
    "nearest": NEAREST,
    "none": "\N{EN DASH}",
    "and": " and ",
    "singularity": "{name} singularity",
    "singular": "Singular: {names}.",
    "regular": "Not singular.",
    "missingRow": "does not exist",
    "past": "past limit: {joints}",
    "usable": "usable",
    "usableSingular": "usable, singular",
    "oneUsable": "1 of {all} branches is usable. {why}",
    "someUsable": "{count} of {all} branches are usable. {why}",
    "noneUsable": "No branch is usable. {why}",
    "ellipsoid": "ellipsoid of tool velocities, free to turn",
    "axes": "joint axes",
    "copy": "Copy as Python",
    "copied": "Copied",
    "takeJoint": "joint {joint}",
    "takeFree": "target, in the plane of the screen",
    "takeAlong": "target along its {axis} axis",
    "takeTurn": "target about its {axis} axis",
    "takeAngle": "angle of the tool",
    "takeStation": "{name}, in the plane of the screen",
    "takeVia": "via along the base's {axis} axis",
    "law": "time law",
    "corner": "corner",
    "time": "time",
    "costs": "The sum S of the angles' changes over the free angle alpha.",
    "costTitle": "S, the sum of the angles' changes",
    "costAxis": "free angle alpha",
    "costSays": "gamma {gamma}°, beta {beta}°, alpha {alpha}°: S = {S}°. Least at alpha = {best}°: "
    "{least}°.",
    "outside": "No posture reaches this point.",
    "least": "Least S",
    "begin": "Begin here",
    "curves": "Curves over time: joint values, speeds, accelerations. The greatest values stand in "
    "the table.",
    "speed": "greatest speed, per s",
    "acceleration": "greatest acceleration, per s²",
    "sampled": "{what}, of {samples} samples",
    "near": "The path passes via at {distance}.",
    "missingSamples": "No solution in {none} of {all} samples.",
    "pastSamples": "q{joint} is past its limit in {past} of {all} samples.",
    "fastSamples": "q{joint} is past its speed limit in {past} of {all} samples.",
    "jump": "The speed jumps at {time} s: there is no acceleration there.",
}


def joint_explorer(arm: Arm, q: ArrayLike | None = None) -> "Explorer":
    """A ring on each joint to take it by, and a slider; the arm with all its frames, the flange in
    numbers, and how near it is to a singularity. It opens at the posture q (n,), or at one in the
    middle of things. At the end of a cell it shows itself. TypeError: not an Arm. ValueError: a q
    that is no posture.

    Roll, pitch and yaw are turns about the fixed x, y and z axes of the base, in this order: R = Rz
    Ry Rx (at a pitch of +-90 degrees roll and yaw turn about the same line, and roll is given as
    zero).
    """
    instance(arm, Arm, "arm")
    start = _open(arm) if q is None else floats(q, "q", len(arm.limits))
    if start.ndim != 1:
        raise ValueError(f"q: wanted one posture ({len(arm.limits)},), got shape {start.shape}")
    name, size = length_unit(extent(arm))
    limits = arm.limits / _sizes(arm)[:, None]
    controls = [
        _control(f"q{i + 1}", unit["name"], low, high, 1 if unit["name"] != "m" else 0.001)
        for i, (unit, (low, high)) in enumerate(zip(_units(arm), limits, strict=True))
    ]
    facts = (
        (f"position, {name}", "place", ["x", "y", "z"], 1 if size == mm else 3),
        ("orientation, °", "turns", ["roll", "pitch", "yaw"], 1),
        ("quaternion", "rotation", ["w", "x", "y", "z"], 4),
        ("distance from singularity", "near", [""], 3),
    )
    rows: list[FactRow] = [
        {"name": named, "fact": fact, "heads": heads, "decimals": decimals}
        for named, fact, heads, decimals in facts
    ]
    values = ", ".join(f"q{i + 1} {_number(x, 0)}" for i, x in enumerate(start / _sizes(arm)))
    flange = arm.fk(start).translation / size
    summary = (
        f"{arm.name} with joints to be turned, at {values}: the flange is at "
        f"({', '.join(_number(x, facts[0][3]) for x in flange)}) {name}."
    )
    data = _page(
        arm,
        "joint",
        f"{arm.name}: turn the joints",
        summary,
        controls,
        start[None],
        meant=f"{TAKE}{TURNS} {MEANT}",
        code=f"{_imports(arm)}\nq = np.array([{{q}}])\n{_code(arm)}.fk(q)",
    )
    data |= {
        "q": start.tolist(),
        "rows": rows,
    }
    frames = arm.frames(start)
    still = _picture(summary, arm, start, frames=[frames[i] for i in range(len(arm.links))])
    return Explorer(data, still)


def target_explorer(arm: ClosedFormArm | ThreeLeverArm) -> "Explorer":
    """A target to take by rings and arrows; every branch of `ik` drawn, the chosen one strongly,
    with a row of a table for each. A click on a row chooses it; the menu, too, or the usable one
    nearest to the last posture.

    Six-axis arms: place, and roll, pitch, yaw as in `joint_explorer`. SCARA: place and the tool's
    angle. Positioning arms: the place. Three levers: the place, the free angle alpha, the curve of
    what it costs to come there from the posture before, and of unequal ones the lengths. TypeError:
    an arm with neither.
    """
    if isinstance(arm, ThreeLeverArm):
        return _levers_explorer(arm)
    _inverted(arm)
    place, turns, q = _showcase(arm)
    name, size = length_unit(extent(arm))
    most = float(np.ceil(1.05 * extent(arm) / (50 * mm)) * 50 * mm / size)
    step = 1 if size == mm else 0.001
    letters = "xyz" if common_plane([arm]) is None else "xy"
    controls = [_control(letter, name, -most, most, step) for letter in letters]
    controls += [_control(turn, "°", -180, 180, 1) for turn in _turns(arm)]
    target = _asked(arm, place, turns)
    rows = arm.ik(target)
    usable = np.all(within(arm, rows), axis=-1)
    row = int(np.nanargmin(np.where(usable, abs(rows - q).sum(axis=-1), np.inf)))
    values = ", ".join(
        f"{c['name']} {_number(x, 0 if c['unit'] != 'm' else 3)}"
        for c, x in zip(
            controls, [*place[: len(letters)] / size, *np.array(turns) / deg], strict=True
        )
    )
    count = int(usable.sum())
    verdict = WORDS["oneUsable" if count == 1 else "someUsable"].format(
        count=count, all=len(rows), why=explain(arm, target, row)
    )
    summary = f"{arm.name} and a target to be moved, at {values}. {verdict}"
    shown = rows[np.isfinite(rows).all(axis=-1)]
    turning = np.flatnonzero(~arm.prismatic)
    whole = len(turning) == len(arm.links)
    data = _page(
        arm,
        "target",
        f"{arm.name}: move the target",
        summary,
        controls,
        shown,
        meant=TAKE + (f"{TURNS} " if arm.target is Transform else "") + MEANT,
        code=f"{_imports(arm)}\ntarget = {_target_code(arm, size)}\n"
        f"q = {_code(arm)}.ik(target)[{{row}}]",
    )
    data |= {
        "q": q.tolist(),
        "turns": list(map(float, turns)),
        "target": _pose_data(target),
        "branches": [_flags(arm, k) for k in range(len(rows))],
        "heads": [
            "branch",
            "verdict",
            *(f"q{i + 1} {unit['name']}" for i, unit in enumerate(_units(arm))),
            "distance from singularity",
            # angles only: a stroke is the same in every row
            "travel, °" if whole else f"travel of {', '.join(f'q{j + 1}' for j in turning)}, °",
        ],
        "turning": turning.tolist(),
    }
    others = [rows[k] for k in np.flatnonzero(np.isfinite(rows).all(axis=-1)) if k != row]
    posed = {"target": _transform(target)} if arm.target is not np.ndarray else {}
    still = _picture(summary, arm, nearest(arm, rows[[row]], q), others, posed)
    return Explorer(data, still)


def motion_explorer(
    arm: ClosedFormArm, start: Pose, via: Pose, goal: Pose, row: int | None = None
) -> "Explorer":
    """A blended motion past `via`: start, via and goal to take by rings and arrows, sliders for the
    via point, the blend and the duration, menus for the time law, the corner and the branch; arm,
    curves and numbers follow. A click on a curve puts the clock there. It opens on branch `row`, or
    on the first with the most usable samples.

    Poses are what `arm.ik` takes (Transform, or ScaraPose for a SCARA), one of each. ValueError: a
    batch of poses, no such row. TypeError: other poses, an arm without `ik`.
    """
    _inverted(arm)
    kind = ScaraPose if arm.target is ScaraPose else Transform
    stations = {"start": start, "via": via, "goal": goal}
    for name, pose in stations.items():
        if instance(pose, kind, name).shape:
            raise ValueError(f"{name}: wanted one single pose, got a batch of shape {pose.shape}")
    unit, size = length_unit(extent(arm))
    law = quintic(5.0)
    t = np.linspace(0, law.duration, SAMPLES)
    rows = arm.ik(blend(start, via, goal, 0.1, law(t)))
    motions = [follow(arm, rows, k) for k in range(len(arm.branches))]
    usable = [(record(arm, t, q).excess <= 0).all(axis=-1).sum() for q in motions]
    row = int(np.argmax(usable)) if row is None else whole(row, "row", 0, len(usable) - 1)
    most = float(np.ceil(1.05 * extent(arm) / (50 * mm)) * 50 * mm / size)
    step = 1 if size == mm else 0.001
    controls = [_control(f"via {letter}", unit, -most, most, step) for letter in "xyz"]
    controls.append(_control("blend", "", 0, 0.5, 0.01, 3))
    controls.append(_control("duration", "s", 0.5, 20, 0.5, 2))
    posed = {name: _transform(pose) for name, pose in stations.items()}
    through = motions[row][np.isfinite(motions[row]).all(axis=-1)][::40]
    speed, j, of = _fastest(arm, lambda x: blend(start, via, goal, 0.1, law(x)), t, motions[row])
    summary = (
        f"{arm.name} on a blended motion past a via point that can be moved, 5 s, blend 0.1, "
        f"branch {_flags(arm, row)}: greatest speed{of} {_number(speed, 1)} "
        f"{_units(arm)[j]['name']}/s (joint {j + 1})."
    )
    data = _page(
        arm,
        "motion",
        f"{arm.name}: a blended motion",
        summary,
        controls,
        through,
        posed,
        meant=TAKE + "Start and goal move, too. A click on a curve sets the clock.",
        code=_motion_code(arm, stations),
    )
    data |= {
        "start": _pose_data(start),
        "via": _pose_data(via),
        "goal": _pose_data(goal),
        "start_values": {"blend": 0.1, "duration": 5.0, "law": 0, "corner": 0, "row": row},
        "laws": list(LAWS),
        "corners": list(CORNERS),
        "branches": [_flags(arm, k) for k in range(len(usable))],
        "samples": SAMPLES,
        "jumps": {"least": LEAP, "few": FEW},
        "panels": ["joint values q", "speeds q\N{PRIME}", "accelerations q\N{DOUBLE PRIME}"],
        "words": {**WORDS, "near": WORDS["near"].replace("}", f"}} {unit}")},
    }
    still = still_picture(
        [arm.name],
        [(arm, motions[row])],
        named_targets(posed),
        [],
        data["scene"],
        data["title"],
        summary,
    )
    return Explorer(data, still)


def _fastest(
    arm: ClosedFormArm, pose: Callable[[Floats], Pose], t: Floats, q: Floats
) -> tuple[float, int, str]:
    """The greatest speed on a motion with the samples q (samples, n), in the joint's unit, and the
    joint. In words what it is the greatest of: "" is between the samples, too, where the motion is
    whole and passes no singularity.
    """
    sizes, h, track = _sizes(arm), 1e-7 * t[-1], record(arm, t, q)

    def speeds(x: Floats) -> Floats:
        x = np.clip(x, h, t[-1] - h)
        ends, near = [], q[np.rint(x / t[1]).astype(int)]
        for side in (-h, h):
            rows = unwrapped(arm, arm.ik(pose(x + side)), near[:, None])
            travel = np.nan_to_num(abs(rows - near[:, None]).sum(axis=-1), nan=np.inf)
            ends.append(rows[np.arange(len(x)), travel.argmin(axis=-1)])
        per_second: Floats = abs(ends[1] - ends[0]) / (2 * h * sizes)
        return per_second

    singular = any(holds.any() for holds in arm.geometry.singularities(q).values())
    if not (singular or track.gaps.any()):
        try:
            tops = [
                refined_maximum(lambda x: speeds(x).max(axis=-1), *ends, 1)
                for ends in pairwise(t[::20])
            ]
            best = max(tops)
            return best.value, int(speeds(np.array([best.at]))[0].argmax()), ""
        except ValueError:  # beside a singularity none stands
            pass
    sampled = np.nan_to_num(track.greatest_speed.value) / sizes
    return float(sampled.max()), int(sampled.argmax()), f" of {SAMPLES} samples"


class Explorer(Output):
    """An arm in a page that answers to the hand. Shows itself in a notebook; `save` writes it as a
    page.

    data    what the page is given, as JSON takes it: a `page.PageExplorer`
    still   the figure that stands in its place until the script runs, in print and in an untrusted
            notebook
    """

    @property
    def call(self) -> str:  # type: ignore[override]
        """The script that shows it."""
        return f"{self.data['kind']}_explorer.explore"


def _levers_explorer(arm: ThreeLeverArm) -> Explorer:
    name, size = length_unit(extent(arm))
    place = np.array([0.55, 0.35, 0.0]) * extent(arm)
    before, _ = arm.least(place, arm.limits.mean(axis=-1))
    most = float(np.ceil(1.05 * extent(arm) / (50 * mm)) * 50 * mm / size)
    step = 1 if size == mm else 0.001
    controls = [_control(letter, name, -most, most, step) for letter in "xy"]
    controls.append(_control("alpha", "°", 0, 180, 1))
    unequal = len(set(arm.geometry.levers)) > 1
    if unequal:
        low, high = (
            np.round(share * arm.reach / (50 * mm)) * 50 * mm / size for share in (0.1, 0.6)
        )
        controls += [
            _control(f"lever {lever}", name, low, high, step) for lever in ("OB", "BA", "AK")
        ]
    where = ", ".join(_number(x, 0 if size == mm else 3) for x in place[:2] / size)
    summary = (
        f"{arm.name} and a point to be moved, at ({where}) {name}, with a free angle: gamma, beta, "
        f"alpha {', '.join(_number(x, 1) for x in before / deg)}°."
    )
    unit = " * mm" if size == mm else ""
    data = _page(
        arm,
        "levers",
        f"{arm.name}: move the point",
        summary,
        controls,
        before[None],
        meant=TAKE + "The broken posture is where S is counted from.",
        code=f"{_imports(arm, *['three_lever'] * unequal)}\n"
        f"{'arm = three_lever(({levers}))' if unequal else '# arm = three_lever(...)'}\n"
        f"q = arm.family(({{x}}{unit}, {{y}}{unit}), {{alpha}} * deg)",
    )
    data |= {
        "q": before.tolist(),
        "target": {"place": place.tolist()},
    }
    return Explorer(data, _picture(summary, arm, before))


# --- Where it opens -------------------------------------------------------------------------------


def _showcase(arm: ClosedFormArm) -> tuple[Floats, Floats, Floats]:
    """A target that shows much: most branches usable, far from singularities, in front of the arm
    and above the floor. (Where there is none, the one in the middle of all limits.)

    Place (3,), turns in radians, and the posture (n,) that it was made of; round numbers all.
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
            # a singular one last: there two branches are one, and a step on there is none
            score = (usable.sum() if near > 0.03 else 0) + float(np.round(near, 6))
            if score > most:
                best = place, turns, nearest(arm, rows[usable], np.zeros(len(arm.links)))
                most = score
    return best


def _open(arm: Arm) -> Floats:
    """A posture of round numbers, far from singularities, in front of the arm and above the
    floor.
    """
    unit, size = _sizes(arm), extent(arm)
    q = np.round(spread(arm, 160, 75 * deg) / unit / 5) * 5 * unit
    q = q[((q >= arm.limits[:, 0]) & (q <= arm.limits[:, 1])).all(axis=-1)]
    tool, near = arm.fk(q), distance_from_singularity(arm, q)
    place, forward = tool.translation, tool.rotation @ (0, 0, 1)
    good = (place[:, 0] > 0.2 * size) & (place[:, 2] > -1e-9) & (forward[:, 2] < 0.9)
    score = np.where(good, 1.0, 0.5) * near - 0.2 * abs(place[:, 1]) / size
    best: Floats = q[np.round(score, 6).argmax()] + 0.0
    return best


def _inverted(arm: ClosedFormArm) -> None:
    """TypeError: not an arm with an inverse, or one whose inverse no page knows."""
    kind = type(instance(arm, ClosedFormArm, "arm").geometry)
    if kind not in KINDS:
        raise TypeError(
            f"arm: {kind.__name__} has no inverse for pages; see KINDS in robokin/show/twin.py"
        )


# --- Targets --------------------------------------------------------------------------------------


def _turns(arm: Arm) -> tuple[str, ...]:
    return {Transform: ("roll", "pitch", "yaw"), ScaraPose: ("angle",)}.get(arm.target, ())


def _asked(arm: Arm, place: Floats, turns: Floats) -> Pose:
    """The target with its place (3,) and its turns in radians."""
    if arm.target is ScaraPose:
        return ScaraPose(place, turns[0])
    if arm.target is Transform:
        return Transform(Quaternion.from_roll_pitch_yaw(*turns), place)
    return Transform(translation=place)


def _turned(arm: Arm, pose: Transform) -> Floats:
    turns = np.array(pose.rotation.as_roll_pitch_yaw())
    return {Transform: turns, ScaraPose: turns[2:]}.get(arm.target, turns[:0])


def _transform(pose: Pose) -> Transform:
    return pose.as_transform() if isinstance(pose, ScaraPose) else pose


def _pose_data(pose: Pose) -> PagePose:
    """As the scripts take a pose."""
    if isinstance(pose, ScaraPose):
        return {"place": pose.position.tolist(), "angle": float(pose.angle)}
    return {"place": pose.translation.tolist(), "rotation": pose.rotation.wxyz.tolist()}


def _flags(arm: ClosedFormArm, k: int) -> str:
    flags = " ".join(f"{flag:+d}" for flag in arm.branches[k]).replace("-", "\N{MINUS SIGN}")
    return f"{k}: {flags}"


# --- What the page gets ---------------------------------------------------------------------------


def _page(
    arm: Arm,
    kind: str,
    title: str,
    summary: str,
    controls: list[Control],
    opening: Floats,
    posed: Mapping[str, Transform] | None = None,
    *,
    meant: str,
    code: str,
) -> PageExplorer:
    name, size = length_unit(extent(arm))
    return {
        "kind": kind,
        "title": title,
        "summary": summary,
        "alt": summary,
        "arm": arm_data(arm),
        "unit": {"name": name, "size": size, "code": name},
        "units": _units(arm),
        "dashes": DASHES,
        "scene": _scene(arm, posed or {}, opening),
        "controls": controls,
        "words": dict(WORDS),
        "meant": meant,
        "code": code,
    }


def _scene(arm: Arm, posed: Mapping[str, Transform], opening: Floats) -> PageScene:
    """A scene that holds the postures it opens with (k, n) and those near them, in space above the
    floor. The page shrinks the picture for what leaves it.
    """
    flat = common_plane([arm]) is not None
    turn = np.where(arm.prismatic, 0.03 * extent(arm), (40 if flat else 20) * deg)
    step = np.concatenate([np.diag(turn), -np.diag(turn)])
    near = (opening[:, None] + step).reshape(-1, len(turn))
    postures = np.concatenate([opening, near])
    above = arm_points(arm, postures)[..., 2].min(axis=-1) > -0.01 * extent(arm)
    scene = scene_data([arm], [postures[above][None]], named_targets(posed), [], extent(arm))
    scene["grows"] = True
    if not flat:
        scene["view"] = list(VIEW)
    return scene


def _control(
    name: str, unit: str, low: float, high: float, step: float, decimals: int = 1
) -> Control:
    decimals = decimals if unit != "m" else 3
    ends = [float(np.round(x, 9)) for x in (low, high)]
    return {
        "name": name,
        "unit": unit,
        "low": ends[0],
        "high": ends[1],
        "step": step,
        "decimals": decimals,
    }


def _units(arm: Arm) -> list[PageUnit]:
    """Name, size and code of each joint's unit."""
    name, size = length_unit(extent(arm))
    shift: PageUnit = {"name": name, "size": size, "code": "mm" if size == mm else "1"}
    turn: PageUnit = {"name": "°", "size": deg, "code": "deg"}
    return [shift if link.prismatic else turn for link in arm.links]


def _sizes(arm: Arm) -> Floats:
    return np.array([unit["size"] for unit in _units(arm)])


def _number(value: float, decimals: int) -> str:
    return f"{tidy(value, decimals):.{decimals}f}".replace("-", "\N{MINUS SIGN}")


# --- In code --------------------------------------------------------------------------------------


def _code(arm: Arm) -> str:
    """What the package calls this very arm, or `arm`."""
    return next((name for name in robokin.__all__ if getattr(robokin, name) is arm), "arm")


def _imports(arm: Arm, *more: str) -> str:
    names = {"deg", "mm", *more, *({_code(arm)} - {"arm"})}
    own = "" if _code(arm) != "arm" else f"# arm: {' '.join(arm.name.split())}\n"
    return (
        f"{own}import numpy as np\nimport robokin\nfrom robokin import {', '.join(sorted(names))}\n"
    )


def _target_code(arm: Arm, size: float) -> str:
    unit = " * mm" if size == mm else ""
    place = f"({{x}}{unit}, {{y}}{unit}, {{z}}{unit})"
    if arm.target is ScaraPose:
        return f"robokin.ScaraPose({place}, {{angle}} * deg)"
    if arm.target is Transform:
        turns = "{roll} * deg, {pitch} * deg, {yaw} * deg"
        return f"robokin.Transform(robokin.Quaternion.from_roll_pitch_yaw({turns}), {place})"
    return place


def _motion_code(arm: Arm, stations: Mapping[str, Pose]) -> str:
    lines = [_imports(arm)]
    for name, pose in stations.items():
        if isinstance(pose, ScaraPose):
            lines.append(f"{name} = robokin.ScaraPose(({{{name}}}), {float(pose.angle)!r})")
        else:
            wxyz = ", ".join(map(repr, pose.rotation.wxyz.tolist()))
            turn = f"robokin.Quaternion(({wxyz}))"
            lines.append(f"{name} = robokin.Transform({turn}, ({{{name}}}))")
    return "\n".join(
        [
            *lines,
            "law = robokin.{law}({duration})",
            "t = np.linspace(0, law.duration, 2001)",
            'poses = robokin.blend(start, via, goal, {blend}, law(t), corner="{corner}")',
            f"q = robokin.follow({_code(arm)}, {_code(arm)}.ik(poses), {{row}})",
        ]
    )


# --- The still picture ----------------------------------------------------------------------------


def _picture(
    alt: str,
    arm: Arm,
    q: Floats,
    others: Sequence[Floats] = (),
    targets: Mapping[str, Transform] | None = None,
    frames: Sequence[Transform] = (),
) -> plots.Figure:
    """One posture, strongly, and others faintly."""
    fig = plots.figure(alt, width=6.4, height=4.5)
    scene = Scene(fig.add_axes((0, 0, 1, 1)), size=extent(arm))
    scene.base()
    for other in others:
        scene.arm(arm, other, "between")
    scene.arm(arm, q, "last")
    for frame in frames:
        scene.triad(frame, length=0.08 * extent(arm))
    scene.triad(arm.fk(q), width=2.4)
    for name, pose in (targets or {}).items():
        scene.triad(pose, name)
    scene.finish()
    return fig
