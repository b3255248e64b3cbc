"""The explorer of a blended motion with stations that the reader can drag."""

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise

import numpy as np

from .._arrays import Floats
from .._validate import choice, instance, positive, short, whole
from ..arms.arm import Arm, ClosedFormArm
from ..arms.branches import follow, unwrapped
from ..arms.scara import ScaraPose
from ..motion.laws import TimeLaw, linear, quintic, trapezoidal
from ..motion.maximum import refined_maximum
from ..motion.paths import blend
from ..motion.recording import FEW, LEAP, record
from ..transform import Transform
from ..units import length_unit, mm
from .camera import extent
from .checks import yes
from .explorer import (
    TAKE,
    Explorer,
    Pose,
    arm_page,
    as_transform,
    code_name,
    control,
    imports,
    inverted,
    number,
    pose_data,
    sizes,
    units,
)
from .explorer_page import Control, Corner, Law, MotionPage, StartValues
from .findings import flags
from .palette import DASHES
from .player import still_picture
from .things import Target

BLEND = 0.1  # the initial blend
STRAIGHT = 1e-3  # rad: a smaller change of direction is not a corner
SAMPLES = 241  # samples of a motion: enough for its speeds, few enough to follow the pointer
LAWS: Mapping[Law, Callable[[float], TimeLaw]] = {
    "quintic": quintic,
    "trapezoidal": trapezoidal,
    "linear": linear,
}
SHORTEST, LONGEST = 0.5, 20.0  # s
CORNERS: Sequence[Corner] = ("parabola", "quintic")


def motion_explorer(
    arm: ClosedFormArm,
    start: Pose,
    via: Pose,
    goal: Pose,
    row: int | None = None,
    *,
    law: Law = "quintic",
    duration: float = 5.0,
    close_up: bool = False,
) -> "Explorer":
    """Show a blended motion past the via point `via`. The reader can drag start, via point and goal
    with rings and arrows, move the via point and set the blend and the duration with sliders, and
    choose the time law, the corner and the branch from menus. The arm, the curves and the numbers
    follow. The motion can be played, and a click on a curve sets the clock. The explorer opens with
    the time law `law`, a `duration` in seconds, and the branch `row`, by default the first of those
    with the most usable samples.

    With `close_up`, the reader cannot move start, via point and goal. The picture shows a close-up
    of the corner at the via point, in the plane of its two lines, with a ring that changes the
    blend. Next to it are the curves of the joint accelerations.

    The poses are single targets of `arm.ik` (Transform, or ScaraPose for a SCARA). Raises
    ValueError if they are batches of poses, if there is no such row, or if `close_up` is True and
    start, via point and goal are on one line. Raises TypeError if the poses are of another type, or
    if the arm has no `ik`.
    """
    inverted(arm)
    stations = {"start": start, "via": via, "goal": goal}
    posed = _posed(arm, stations)
    choice(law, "law", list(LAWS))
    seconds = _seconds(duration)
    progress = LAWS[law](seconds)

    def path(x: Floats) -> Pose:
        return blend(start, via, goal, BLEND, progress(x))

    t = np.linspace(0, seconds, SAMPLES)
    row, motion = _first_motion(arm, t, path, row)
    through = motion[np.isfinite(motion).all(axis=-1)][::40]
    if yes(close_up, "close_up"):
        title, point, more = "a rounded corner", "a via point", ""
        result = _passes(arm, posed, path, seconds)
    else:
        title, point = "a blended motion", "a via point that can be moved"
        more = "You can move start and goal, too. "
        result = _greatest_speed(arm, path, t, motion)
    summary = (
        f"{arm.name} on a blended motion past {point}, {seconds:g} s, blend {BLEND:g}, branch "
        f"{flags(arm, row)}: {result}."
    )
    page = arm_page(
        arm,
        f"{arm.name}: {title}",
        summary,
        _controls(arm)[3 * close_up :],
        through,
        posed,
        meant=f"{TAKE}{more}Click a curve to set the clock.",
        code=_motion_code(arm, stations),
    )
    data: MotionPage = {
        "kind": "motion",
        **page,
        "dashes": DASHES,
        "start": pose_data(start),
        "via": pose_data(via),
        "goal": pose_data(goal),
        "start_values": _start_values(seconds, law, row),
        "laws": list(LAWS),
        "corners": list(CORNERS),
        "branches": [flags(arm, k) for k in range(len(arm.branches))],
        "samples": SAMPLES,
        "jumps": {"least": LEAP, "few": FEW},
        "panels": ["joint values q", "speeds q\N{PRIME}", "accelerations q\N{DOUBLE PRIME}"],
        "close_up": close_up,
    }
    still = still_picture(
        [arm.name],
        [(arm, motion)],
        [Target(pose, name) for name, pose in posed.items()],
        data["scene"],
        data["title"],
        summary,
    )
    return Explorer(data, still)


def _first_motion(
    arm: ClosedFormArm, t: Floats, path: Callable[[Floats], Pose], row: int | None
) -> tuple[int, Floats]:
    """Return the branch that is shown at first and its motion (samples, n). If `row` is None, this
    is the first of the branches with the most usable samples.
    """
    rows = arm.ik(path(t))
    motions = [follow(arm, rows, k) for k in range(len(arm.branches))]
    usable = [(record(arm, t, q).excess <= 0).all(axis=-1).sum() for q in motions]
    row = int(np.argmax(usable)) if row is None else whole(row, "row", 0, len(usable) - 1)
    return row, motions[row]


def _start_values(duration: float, law: Law, row: int) -> StartValues:
    return {
        "blend": BLEND,
        "duration": duration,
        "law": list(LAWS).index(law),
        "corner": 0,
        "row": row,
    }


def _posed(arm: ClosedFormArm, stations: Mapping[str, Pose]) -> dict[str, Transform]:
    """Return the flange poses of start, via point and goal. Raises TypeError if one of them is not
    a target of this arm, and ValueError if it is a batch.
    """
    kind = ScaraPose if arm.target is ScaraPose else Transform
    for name, pose in stations.items():
        if instance(pose, kind, name).shape:
            raise ValueError(f"{name}: wanted a single pose, got a batch of shape {pose.shape}")
    return {name: as_transform(pose) for name, pose in stations.items()}


def _greatest_speed(
    arm: ClosedFormArm, pose: Callable[[Floats], Pose], t: Floats, q: Floats
) -> str:
    """Describe the greatest speed of a motion."""
    speed, j, of = _fastest(arm, pose, t, q)
    return f"greatest speed{of} {number(speed, 1)} {units(arm)[j]['name']}/s (joint {j + 1})"


def _passes(
    arm: Arm,
    stations: Mapping[str, Transform],
    pose: Callable[[Floats], Pose],
    duration: float,
) -> str:
    """Describe how far from the via point a path passes. Raises ValueError if the path has no
    corner there.
    """
    start, via, goal = (station.translation for station in stations.values())
    legs = np.stack([start - via, goal - via])
    size = np.linalg.norm(legs, axis=-1, keepdims=True)
    if size.min() < 1e-6 * extent(arm) or np.linalg.norm((legs / size).sum(axis=0)) < STRAIGHT:
        raise ValueError("close_up: wanted a corner at via, got start, via and goal on one line")

    def near(x: Floats) -> Floats:
        gaps = as_transform(pose(x)).translation - via
        return -np.asarray(np.linalg.norm(gaps, axis=-1))

    unit, metres = length_unit(extent(arm))
    decimals = 1 if metres == mm else 3
    distance = -refined_maximum(lambda x: near(x) / metres, 0, duration, decimals).value
    return f"its path passes {number(distance, decimals)} {unit} from via"


def _seconds(duration: float) -> float:
    """Return the duration as a float. Raises ValueError if it is too short or too long."""
    wanted = f"from {SHORTEST:g} to {LONGEST:g} s"
    seconds = positive(duration, "duration", wanted)
    if not SHORTEST <= seconds <= LONGEST:
        raise ValueError(f"duration: wanted {wanted}, got {short(duration)}")
    return seconds


def _controls(arm: ClosedFormArm) -> list[Control]:
    """Return the sliders of the via point, the blend and the duration."""
    unit, size = length_unit(extent(arm))
    most = float(np.ceil(1.05 * extent(arm) / (50 * mm)) * 50 * mm / size)
    step = 1 if size == mm else 0.001
    return [
        *(control(f"via {letter}", unit, -most, most, step) for letter in "xyz"),
        control("blend", "", 0, 0.5, 0.01, 3),
        control("duration", "s", SHORTEST, LONGEST, 0.5, 2),
    ]


def _fastest(
    arm: ClosedFormArm, pose: Callable[[Floats], Pose], t: Floats, q: Floats
) -> tuple[float, int, str]:
    """Return the greatest speed of a motion with the samples q (samples, n), in the joint's unit;
    the joint; and a qualification. The qualification is "" if the speed includes the values between
    the samples, because the motion is complete and passes no singularity.
    """
    scale, h, track = sizes(arm), 1e-7 * t[-1], record(arm, t, q)

    def speeds(x: Floats) -> Floats:
        x = np.clip(x, h, t[-1] - h)
        ends, near = [], q[np.rint(x / t[1]).astype(int)]
        for side in (-h, h):
            rows = unwrapped(arm, arm.ik(pose(x + side)), near[:, None])
            travel = np.nan_to_num(abs(rows - near[:, None]).sum(axis=-1), nan=np.inf)
            ends.append(rows[np.arange(len(x)), travel.argmin(axis=-1)])
        per_second: Floats = abs(ends[1] - ends[0]) / (2 * h * scale)
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
        except ValueError:  # near a singularity, the search may not converge
            pass
    sampled = np.nan_to_num(track.greatest_speed.value) / scale
    return float(sampled.max()), int(sampled.argmax()), f" of {SAMPLES} samples"


def _motion_code(arm: Arm, stations: Mapping[str, Pose]) -> str:
    lines = [imports(arm)]
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
            f"q = robokin.follow({code_name(arm)}, {code_name(arm)}.ik(poses), {{row}})",
        ]
    )
