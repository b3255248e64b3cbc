"""An explorer of the paths that a loader's gripper takes when its motors run in different ways."""

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import floats
from ..arms.arm import ClosedFormArm
from ..jobs.steppers import (
    LIMIT,
    Move,
    counts,
    joint_values,
    out_of_reach,
    station_postures,
    straight,
    synchronised,
    unsynchronised,
)
from ..units import length_unit, mm
from . import plots
from .camera import extent
from .explorer import TAKE, WORDS, Explorer, arm_page, control, imports, number
from .explorer_page import PathsPage
from .palette import INK, REMARK, SECOND
from .scene import Scene

SAMPLES = 1001  # number of postures along the straight line, as in `straight`
PATHS = (
    "a: at the limit",
    "b: straight",
    "c: straight, reversing",
    "d: in step",
)
LOOKS = {"a": (SECOND, "-."), "b": (REMARK, "--"), "c": (REMARK, "--"), "d": (INK, "-")}
STARTS, GOAL = "start", "goal"
WORDS_HERE = {
    **{name: WORDS[name] for name in ("copy", "copied", "none", "ringsMove")},
    "takeFree": "goal, in the plane of the screen",
    "takeAlong": "goal along the {axis} axis",
    "start": STARTS,
    "goal": GOAL,
    "nothing": "none",
    "same": "a and d take {time} s.",
    "fast": "{same} The straight line takes {slow} s: no motor reverses, so it is path b.",
    "slow": "{same} The straight line takes {slow} s: {who}, so it is path c.",
    "one": "motor {motors} reverses",
    "several": "motors {motors} reverse",
    "and": WORDS["and"],
    "blocked": "{same} The straight line is not possible: at {share}\N{NO-BREAK SPACE}% of it, "
    "{reason}.",
    "out": "There is no path: {reason}.",
    "floor": "the goal is under the floor",
    "near": "The goal is less than one pulse from the start.",
    "scene": "{name} and the paths of its gripper from the start to the goal at {values}. {says} "
    "{lengths}",
    "length": "{path} is {length} {unit} long.",
}
MEANT = (
    TAKE + "Click a row of the table: the arm follows that path. Path a: each motor runs at the "
    "limit until it is done; a small circle marks each point where a motor stops. Paths b and c: "
    "the gripper moves in a straight line; on c, a motor reverses where a small circle is. Path d: "
    "all motors stop together. The dots show all paths at the same moment. Off the line: the "
    "greatest distance of a path from the straight line."
)


def paths_explorer(
    arm: ClosedFormArm, start: ArrayLike, goal: ArrayLike, per_degree: ArrayLike
) -> Explorer:
    """Show the paths a, b or c, and d of a loader's gripper from the point `start` (3,) to the
    point `goal` (3,), in metres, with their times, lengths, distances from the straight line, and
    pulses. On path a, each motor runs at its limit; on b and c, the gripper moves in a straight
    line; on d, all motors stop together. The reader moves the goal, plays the moves, and chooses
    the path that the arm follows.

    The straight path is called b if no motor reverses, and c if one does (see
    `jobs.steppers.straight`). `per_degree`, an array (3,) or one number, is the number of pulses
    per degree of the joints. Raises TypeError if the arm is not a loader, and ValueError if a point
    is out of reach, if the straight line leaves the workspace, or if `per_degree` does not contain
    positive numbers.
    """
    ends = [floats(point, name, 3) for point, name in ((start, STARTS), (goal, GOAL))]
    for place, name in zip(ends, (STARTS, GOAL), strict=True):
        if place.ndim != 1:
            raise ValueError(f"{name}: wanted one point (3,), got shape {place.shape}")
        for why in out_of_reach(arm, place):
            raise ValueError(f"{name}: wanted a point in reach, but {why}")
    ratio = floats(per_degree, "per_degree")
    if ratio.shape not in ((), (3,)):
        wanted = "wanted one number or three"
        raise ValueError(f"per_degree: {wanted}, got shape {ratio.shape}")
    ratio = np.broadcast_to(ratio, 3)
    q = station_postures(arm, np.stack(ends))
    stations = counts(q, ratio)
    line = straight(arm, ends[0], ends[1], ratio)
    letter = "c" if _reverses(line) else "b"
    moves = {"a": unsynchronised(*stations), letter: line, "d": synchronised(*stations)}
    paths = {name: _path(arm, move, ratio) for name, move in moves.items()}
    unit, size = length_unit(extent(arm))
    most = float(np.ceil(1.05 * extent(arm) / (50 * mm)) * 50 * mm / size)
    decimals = 0 if size == mm else 3
    told = ", ".join(
        f"{name} {number(move.duration, 2)} s and {number(_length(paths[name]) / size, decimals)} "
        f"{unit}"
        for name, move in moves.items()
    )
    where = ", ".join(number(x, decimals) for x in ends[1] / size)
    summary = f"{arm.name} and the paths of its gripper to the goal at ({where}) {unit}: {told}."
    page = arm_page(
        arm,
        f"{arm.name}: four ways to run three motors",
        summary,
        [control(letter, unit, -most, most, 1 if size == mm else 0.001) for letter in "xyz"],
        q,
        near=np.concatenate([_postures(move, ratio)[::40] for move in moves.values()]),
        meant=MEANT,
        code=_code(arm, ends[0], ratio),
    )
    data: PathsPage = {
        "kind": "paths",
        **page,
        "words": WORDS_HERE,
        "start": ends[0].tolist(),
        "goal": ends[1].tolist(),
        "per_degree": ratio.tolist(),
        "limit": LIMIT,
        "row": int(arm.branch(+1, -1)),
        "samples": SAMPLES,
        "paths": list(PATHS),
        "heads": [
            "path",
            "time, s",
            f"length, {unit}",
            f"off the line, {unit}",
            "pulses",
            "reversing motors",
        ],
    }
    return Explorer(data, _still(summary, arm, _halfway(moves["d"], ratio), paths, ends))


def _reverses(move: Move) -> bool:
    """Return whether a motor reverses during this move, and so receives pulses of both signs."""
    return any(np.ptp(signs) > 0 for _, signs in move.pulses() if signs.size)


def _postures(move: Move, ratio: Floats) -> Floats:
    """Return postures (samples, 3) at equally spaced times and wherever a motor changes speed."""
    even = np.linspace(0, move.duration, 401)
    t = np.union1d(even, move.t) if len(move.t) < 10 else even
    return joint_values(move(t), ratio)


def _path(arm: ClosedFormArm, move: Move, ratio: Floats) -> Floats:
    """Return the positions (samples, 3) of the gripper during a move."""
    return arm.fk(_postures(move, ratio)).translation


def _length(path: Floats) -> float:
    return float(np.linalg.norm(np.diff(path, axis=0), axis=-1).sum())


def _halfway(move: Move, ratio: Floats) -> Floats:
    """Return the posture (3,) in the middle of a move."""
    return joint_values(move(move.duration / 2), ratio)


def _code(arm: ClosedFormArm, start: Floats, ratio: Floats) -> str:
    _, size = length_unit(extent(arm))
    first = ", ".join(f"{x:.9g}" for x in start / size)
    unit = " * mm" if size == mm else ""
    return "\n".join(
        [
            imports(arm),
            "from robokin.jobs.steppers import (",
            "    counts, station_postures, straight, synchronised, unsynchronised",
            ")",
            f"points = np.array([[{first}], [{{goal}}]]){unit}",
            f"per_degree = {[float(f'{x:.9g}') for x in ratio]}",
            "n = counts(station_postures(arm, points), per_degree)",
            "a, d = unsynchronised(*n), synchronised(*n)",
            "b_or_c = straight(arm, *points, per_degree)",
        ]
    )


def _still(
    alt: str, arm: ClosedFormArm, q: Floats, paths: dict[str, Floats], ends: list[Floats]
) -> plots.Figure:
    """Draw the arm in one posture, and the paths, each with its letter in the middle."""
    fig = plots.figure(alt, width=6.4, height=4.5)
    scene = Scene(fig.add_axes((0, 0, 1, 1)), size=extent(arm))
    scene.base()
    for name, path in paths.items():
        color, dash = LOOKS[name]
        scene.line(path, color=color, linewidth=2, linestyle=dash)
        scene.label(name, path[len(path) // 2], color, 12)
    scene.arm(arm, q, "last")
    for name, place in zip((STARTS, GOAL), ends, strict=True):
        scene.mark(place, 0.0)
        scene.label(name, place)
    scene.finish()
    return fig
