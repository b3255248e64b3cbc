"""An explorer of the distance between an arm of three levers and an obstacle during a motion."""

from collections.abc import Mapping

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import floats, instance, short, warn_if_degrees
from ..arms.planar import ThreeLeverArm
from ..jobs.obstacles import LEVERS, along, clearance, distances
from ..jobs.obstacles.arguments import read_point, read_start
from ..units import in_words, mm
from . import plots
from .camera import extent
from .charts import curves
from .explorer import WORDS, Explorer, arm_page, control, imports
from .explorer_page import ClearancePage
from .levers_explorer import reasons
from .palette import AREA, INK
from .scene import Scene
from .things import Mark

MOST = 4  # maximum number of via points
WORDS_HERE: Mapping[str, str] = {
    **{name: WORDS[name] for name in ("copy", "copied")},
    "H": "H, the obstacle",
    "via": "K{k}, a via point of the gripper",
    "leastIs": "Least distance of a lever from H:",
    "toLeast": "Nearest moment",
    "none": "no path",
    "where": "lever {lever}, after {percent} % of the motion",
    "hits": "lever {lever} hits H, after {percent} % of the motion",
    "kept": "All levers stay at least {wanted} away from H. The least distance between "
    "gripper and H is {gripper}. All joint turns add up to S = {S}°.",
    "notKept": "Too near: the levers should stay at least {wanted} away from H. The least distance "
    "between gripper and H is {gripper}. All joint turns add up to S = {S}°.",
    "now": "The picture shows {percent} % of the motion: lever {lever} is {distance} from H.",
    "scene": "{title}. {says}",
    "curveTitle": "distance from H, mm",
    "motionAxis": "share of the motion, %",
    "anyLever": "nearest lever",
    "gripper": "gripper",
    "curveSays": "The distance of the nearest lever from H during the motion. The least "
    "distance, {distance}, is at lever {lever} after {percent} %. A line marks the required "
    "distance, {wanted}.",
}
MEANT = (
    "Drag the letters, or move them with the arrow keys. Drag along the curve, or move the slider, "
    "to see the arm at another moment. Between two points, all joints turn evenly, and S is "
    "as small as possible; the percentages are fractions of S. The radius of the grey disc is the "
    "required distance. Without via points, dotted lines join A to A1 and K to K1, the ends of the "
    "lever after the motion."
)


def clearance_explorer(
    arm: ThreeLeverArm,
    posture: ArrayLike,
    target: ArrayLike,
    obstacle: ArrayLike,
    via: ArrayLike = (),
) -> Explorer:
    """Plot the distance of the nearest lever from the obstacle H during a motion, its least value,
    and the required distance, which is a seventh of a lever. The arm moves from the posture (3,) to
    the target (2,) through the via points (k, 2) of its gripper. On each part of the way, the sum S
    of the angle changes is as small as possible. Lengths are in metres, angles in radians.

    The reader drags H and the via points, which are called K2, K3 and so on. Raises ValueError if
    the posture is not one posture within the limits, if the arm does not reach a via point or the
    target, or if there are more than 4 via points, and TypeError if the arm does not have three
    levers.
    """
    instance(arm, ThreeLeverArm, "arm")
    start, K1 = read_start(arm, posture, "posture"), read_point(target, "target")
    warn_if_degrees(start, "posture", posture=1)
    H, vias, distance = read_point(obstacle, "obstacle"), _vias(via), arm.lever / 7
    path = _path(arm, start, vias, K1)
    each = clearance(arm, path, H).min(axis=0)
    lever = LEVERS[int(each.argmin())]
    through = " and ".join(f"K{k}" for k in range(2, len(vias) + 2))
    title = f"From K{f' through {through}' * bool(len(vias))} to K1, past an obstacle H"
    kept = "farther than" if each.min() >= distance else "nearer than"
    summary = (
        f"{title}: lever {lever} of {arm.name} comes within {in_words(each.min())} of H, {kept} "
        f"the required {in_words(distance)}."
    )
    moments = along(path, np.linspace(0, 1, 25))
    page = arm_page(
        arm,
        title,
        summary,
        [control("motion", "%", 0, 100, 1, 0)],
        moments,
        near=moments,
        things=[Mark(H, radius=distance)],
        meant=MEANT,
        code=_code(arm, start),
    )
    page["words"] = dict(WORDS_HERE) | reasons(arm)
    page["scene"]["things"] = []  # the script of the page adds them
    data: ClearancePage = {
        "kind": "clearance",
        **page,
        "q": start.tolist(),
        "target": {"place": [*K1.tolist(), 0.0]},
        "vias": [[*place, 0.0] for place in vias.tolist()],
        "obstacle": [*H.tolist(), 0.0],
        "distance": distance,
    }
    return Explorer(data, _still(summary, arm, path, H, distance))


def _vias(via: ArrayLike) -> Floats:
    """Return the via points (k, 2)."""
    points = floats(via, "via")
    points = floats(points, "via", 2) if points.size else np.empty((0, 2))
    if points.ndim != 2 or len(points) > MOST:
        raise ValueError(f"via: wanted at most {MOST} points (k, 2), got shape {points.shape}")
    return points


def _path(arm: ThreeLeverArm, start: Floats, vias: Floats, K1: Floats) -> Floats:
    """Return the path (k + 2, 3) that has the least S on each of its parts."""
    path = [start]
    for place in [*vias, K1]:
        q = arm.least(place, path[-1])[0]
        if np.isnan(q).any():
            name = "via" if len(path) <= len(vias) else "target"
            why = arm.out_of_reach(place)
            raise ValueError(f"{name}: wanted a point in reach, got {short(place.tolist())}: {why}")
        path.append(q)
    return np.array(path)


def _code(arm: ThreeLeverArm, start: Floats) -> str:
    return (
        f"{imports(arm)}from robokin.jobs.obstacles import clearance\n"
        f"# arm = three_lever(...)\npath = [np.array({start.tolist()})]\n"
        "for place in [{places}]:\n    path.append(arm.least(place, path[-1])[0])\n"
        "least = clearance(arm, path, {obstacle}).min(axis=0)  # of OB, BA and AK, in metres"
    )


def _still(
    summary: str, arm: ThreeLeverArm, path: Floats, H: Floats, distance: float
) -> plots.Figure:
    """Draw the arm before and after the motion, next to the curve."""
    fig = plots.figure(summary, width=8, height=4)
    scene = Scene(fig.add_axes((0, 0, 0.5, 1)), size=extent(arm), flat=True)
    scene.base()
    s = np.linspace(0, 1, 241)
    q = along(path, s)
    for moment in q[::12]:
        scene.arm(arm, moment, "between")
    scene.ball(np.append(H, 0), distance)
    scene.arm(arm, path[-1], "between")
    scene.arm(arm, path[0], "last")
    scene.label("H", np.append(H, 0))
    scene.finish()
    ax = fig.add_axes((0.6, 0.15, 0.37, 0.72))
    curves(
        ax,
        100 * s,
        {"nearest lever": distances(arm, q, H).min(axis=-1) / mm},
        xlabel="share of the motion, %",
        ylabel="distance from H, mm",
        title="How near the levers come",
    )
    ax.axhspan(0, distance / mm, color=AREA)
    ax.axhline(distance / mm, color=INK, lw=1)
    ax.set_ylim(0, None)
    return fig
