"""The common parts of all explorers of an arm: page data, text, code, still picture."""

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np

import robokin

from .._arrays import Floats
from .._validate import instance
from ..arms.arm import Arm, ClosedFormArm
from ..arms.scara import ScaraPose
from ..transform import Transform
from ..units import deg, length_unit, mm
from . import plots
from .camera import VIEW, arm_points, common_plane, extent, scene_data
from .explorer_page import ArmPage, Control, PagePose, PageUnit
from .numbers import tidy
from .output import Output
from .page import PageScene
from .scene import Scene
from .things import Target, Thing, Zone
from .twin import KINDS, arm_data

Pose: TypeAlias = Transform | ScaraPose

NEAREST = "nearest"
TURNS = "Roll, pitch and yaw rotate about the base's x, then y, then z axis."
TAKE = "Take hold of a ring and drag it, or move the sliders. "
WORDS: Mapping[str, str] = {
    "target": "target",
    "scene": "{name} and a target that can be moved, at {values}. {says}",
    "count": "{count} of {all}",
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
    "room": "Joint {joint} is {room}° from its limit of {limit}.",
    "ellipsoid": "ellipsoid",
    "off": "off",
    "free": "tool velocities, tool free to turn",
    "held": "tool velocities, orientation held",
    "speeds": "Semi-axes: {values} {unit}/s.",
    "axes": "joint axes",
    "copy": "Copy as Python",
    "copied": "Copied",
    "wrist": "wrist centre",
    "takeJoint": "joint {joint}",
    "takeFree": "target, in the plane of the screen",
    "takeAlong": "target along its {axis} axis",
    "takeTurn": "target about its {axis} axis",
    "takeAngle": "angle of the tool",
    "takeStation": "{name}, in the plane of the screen",
    "takeVia": "via point along the base's {axis} axis",
    "takeBlend": "blend",
    "blendIs": "{blend}, {distance} from via",
    "rings": "rings {first} to {last}",
    "ringsMove": "rings to move",
    "ringsTurn": "rings to turn",
    "ringsFree": "start, via, goal",
    "ringsVia": "via point along x, y, z",
    "law": "time law",
    "corner": "corner",
    "curves": "Curves over time: joint values, speeds, accelerations. The greatest values are in "
    "the table.",
    "speed": "greatest speed, per s",
    "acceleration": "greatest acceleration, per s²",
    "sampled": "{what}, of {samples} samples",
    "near": "The path passes {distance} from via.",
    "hardest": "Joint {joint} accelerates most: {value}.",
    "hardestOfKind": "Joint {joint} accelerates at up to {value}.",
    "closeUp": "Close-up of the corner. ",
    "fromStart": "from start",
    "toGoal": "to goal",
    "missingSamples": "No solution in {none} of {all} samples.",
    "pastSamples": "q{joint} exceeds its limit in {past} of {all} samples.",
    "fastSamples": "q{joint} exceeds its speed limit in {past} of {all} samples.",
    "jump": "The speed jumps at {time} s, so there is no finite acceleration.",
}


class Explorer(Output):
    """A view in which the reader can move an arm. It displays itself in a notebook; `save` writes
    it as a page.

    data    the data of the page, which JSON can represent: a `page.PageExplorer`
    still   the figure that is shown until the script runs, in print, and in an untrusted
            notebook
    """

    @property
    def call(self) -> str:  # type: ignore[override]
        """The module, and the function in it, that shows the explorer."""
        return f"{self.data['kind']}_explorer.explore"


def inverted(arm: ClosedFormArm) -> None:
    """Check that the scripts implement the inverse of an arm. Raises TypeError if the arm has no
    inverse, or if the scripts do not implement it.
    """
    kind = type(instance(arm, ClosedFormArm, "arm").geometry)
    if kind not in KINDS:
        raise TypeError(
            f"arm: {kind.__name__} has no inverse for pages: see KINDS in robokin/show/twin.py"
        )


# --- Poses ----------------------------------------------------------------------------------------


def as_transform(pose: Pose) -> Transform:
    """Return the flange pose of a target."""
    return pose.as_transform() if isinstance(pose, ScaraPose) else pose


def pose_data(pose: Pose) -> PagePose:
    """Return a pose as page data."""
    if isinstance(pose, ScaraPose):
        return {"place": pose.position.tolist(), "angle": float(pose.angle)}
    return {"place": pose.translation.tolist(), "rotation": pose.rotation.wxyz.tolist()}


# --- Page data ------------------------------------------------------------------------------------


def arm_page(
    arm: Arm,
    title: str,
    summary: str,
    controls: list[Control],
    opening: Floats,
    posed: Mapping[str, Transform] | None = None,
    *,
    near: Floats | None = None,
    things: Sequence[Thing] = (),
    meant: str,
    code: str,
) -> ArmPage:
    """Return the page data that all explorers of an arm share. The page opens with the postures
    `opening` (k, n), and its scene shows the targets `posed` and the given things. The picture also
    has room for the postures `near` (k, n); by default, these are postures in which one joint has
    moved a little.
    """
    name, size = length_unit(extent(arm))
    return {
        "title": title,
        "summary": summary,
        "alt": summary,
        "arm": arm_data(arm),
        "unit": {"name": name, "size": size, "code": name},
        "units": units(arm),
        "scene": _scene(arm, posed or {}, opening, near, things),
        "controls": controls,
        "words": dict(WORDS),
        "meant": meant,
        "code": code,
    }


def _scene(
    arm: Arm,
    posed: Mapping[str, Transform],
    opening: Floats,
    near: Floats | None,
    more: Sequence[Thing],
) -> PageScene:
    """Return a scene that shows the opening postures (k, n) and the postures near them, above the
    floor. The page zooms out when anything leaves the picture.
    """
    flat = common_plane([arm]) is not None
    turn = np.where(arm.prismatic, 0.03 * extent(arm), (40 if flat else 20) * deg)
    step = np.concatenate([np.diag(turn), -np.diag(turn)])
    if near is None:
        near = (opening[:, None] + step).reshape(-1, len(turn))
    postures = np.concatenate([opening, near])
    above = arm_points(arm, postures)[..., 2].min(axis=-1) > -0.01 * extent(arm)
    things = [*(Target(pose, name) for name, pose in posed.items()), *more]
    scene = scene_data([arm], [postures[above][None]], things, extent(arm), grows=True)
    if not flat:
        scene["view"] = list(VIEW)
    return scene


def control(
    name: str, unit: str, low: float, high: float, step: float, decimals: int | None = None
) -> Control:
    """Return the page data of a slider. By default, its values have one decimal, or three in
    metres.
    """
    default = 3 if unit == "m" else 1
    ends = [float(np.round(x, 9)) for x in (low, high)]
    return {
        "name": name,
        "unit": unit,
        "low": ends[0],
        "high": ends[1],
        "step": step,
        "decimals": default if decimals is None else decimals,
    }


def units(arm: Arm) -> list[PageUnit]:
    """Return the name, size and code of each joint's unit."""
    name, size = length_unit(extent(arm))
    shift: PageUnit = {"name": name, "size": size, "code": "mm" if size == mm else "1"}
    turn: PageUnit = {"name": "°", "size": deg, "code": "deg"}
    return [shift if link.prismatic else turn for link in arm.links]


def sizes(arm: Arm) -> Floats:
    """Return the sizes (n,) of the joints' units."""
    return np.array([unit["size"] for unit in units(arm)])


def number(value: float, decimals: int) -> str:
    """Format a number with `decimals` decimals and a real minus sign."""
    return f"{tidy(value, decimals):.{decimals}f}".replace("-", "\N{MINUS SIGN}")


# --- Python code for the reader -------------------------------------------------------------------


def code_name(arm: Arm) -> str:
    """Return the name of this arm in the package, or `arm` if it has none."""
    return next((name for name in robokin.__all__ if getattr(robokin, name) is arm), "arm")


def imports(arm: Arm, *more: str) -> str:
    """Return the Python lines that import an arm and the names in `more`."""
    names = {"deg", "mm", *more, *({code_name(arm)} - {"arm"})}
    own = "" if code_name(arm) != "arm" else f"# arm: {' '.join(arm.name.split())}\n"
    return (
        f"{own}import numpy as np\nimport robokin\nfrom robokin import {', '.join(sorted(names))}\n"
    )


# --- The still picture ----------------------------------------------------------------------------


def picture(
    alt: str,
    arm: Arm,
    q: Floats,
    others: Sequence[Floats] = (),
    targets: Mapping[str, Transform] | None = None,
    frames: Sequence[Transform] = (),
    points: Mapping[str, Floats] | None = None,
    zone: Zone | None = None,
) -> plots.Figure:
    """Draw one posture boldly and the others faintly. If there is a zone, draw them from above."""
    fig = plots.figure(alt, width=6.4, height=4.5)
    scene = Scene(fig.add_axes((0, 0, 1, 1)), size=extent(arm), flat=zone is not None)
    if zone:
        zone.draw(scene, None)
    scene.base()
    for other in others:
        scene.arm(arm, other, "between")
    scene.arm(arm, q, "last")
    for frame in frames:
        scene.triad(frame, length=0.08 * extent(arm))
    scene.triad(arm.fk(q), width=2.4)
    for name, pose in (targets or {}).items():
        scene.triad(pose, name)
    for name, point in (points or {}).items():
        scene.mark(point, 0.0)
        scene.label(name, point)
    scene.finish()
    return fig
