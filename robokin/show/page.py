"""The data of a page, and the HTML with the script that draws it. An explorer's arm is described in
`twin`, what a scene shows besides arms in `things`; `saving` writes pages to files.
"""

import base64
import html
import json
from typing import Any, Literal, NotRequired, TypeAlias, TypedDict

from .joiner import compressed, script, style
from .numbers import Packed, Scale
from .palette import css
from .things import PageThing
from .twin import ArmData, PageLink

STILL = (
    "A still picture. To see it move: run all cells (Run > Run All Cells), or trust the notebook "
    "(Ctrl+Shift+C, then Trust Notebook)."
)


# --- The data -------------------------------------------------------------------------------------
#
# Metres and radians in the scene; in the curves degrees and the unit of lengths. A rigid transform
# is 12 numbers: the rows of [R | p]. A motion is one value of the switch with one of the slider:
# their number is switch * slider values + slider.


class Unit(TypedDict):
    """The unit of lengths beside the curves: its name, and its size in metres."""

    name: str
    size: float


class Slider(TypedDict):
    """A value to choose a motion by, and the decimals to write it with."""

    label: str
    values: list[float]
    decimals: int


class Switch(TypedDict):
    """Words to choose a motion by."""

    label: str
    values: list[str]


class PageScene(TypedDict):
    """The space: the arm's length, the coordinate that is zero where all is flat, the step of the
    floor's grid, what the camera must see, two corners of the floor, azimuth and elevation of the
    camera. With `grows` the picture shrinks where an arm or a thing leaves it; a floor that is
    `solid` hides what dips below it. With `bases` all arms stand there in one picture; None gives
    each its own.
    """

    size: float
    flat: int | None
    grid: float
    seen: list[list[float]]
    floor: list[list[float]]
    view: list[float]
    grows: bool
    solid: bool
    bases: list[list[float]] | None
    things: list[PageThing]


class Axis(TypedDict):
    """The scales of turning or of shifting joints in one panel; `of` motion -> which, or None: all
    have the first.
    """

    unit: str
    scales: list[Scale]
    of: list[int] | None


class PagePanel(TypedDict):
    """One panel of curves. `own`: each motion has its own scale. `near`: for each arm the limits
    to show, [joint, 0 lower or 1 upper]. `axes`: those of "turn" and "shift" joints, if any.
    """

    label: str
    own: bool
    near: list[list[list[int]]]
    axes: dict[str, Axis]


class Greatest(TypedDict):
    """For each motion and joint: the greatest speed, its share of the limit in percent, the
    greatest acceleration or words where the speed jumps.
    """

    speed: list[list[float]]
    share: list[list[int]] | None
    acceleration: list[list[float | str]]


class Flaws(TypedDict):
    """What is wrong with a motion, by its number: the samples after which its curves break, [[time,
    words]] of jumps of speed and of position, sentences.
    """

    gaps: dict[str, list[int]]
    jumps: dict[str, list[tuple[float, str]]]
    leaps: dict[str, list[tuple[float, str]]]
    notes: dict[str, list[str]]


class PageArm(Greatest, Flaws):
    """One arm and its motions: `Packed` joint values, speeds and accelerations; [lower, upper]
    limits of the joints, their speed limits; for each motion [smallest distance from "via", x, y,
    z of that place], or None.
    """

    name: str
    chain: list[PageLink]
    motion: list[Packed]
    limits: list[list[float]]
    speedLimits: list[float] | None
    via: list[list[float] | None] | None


class Page(TypedDict):
    """Everything that a player draws. `nothing`: the whole number of a `Packed` that stands for no
    value. `decimals` are those of speeds and accelerations, `sampled` says of which samples the
    greatest are told, `ticks` is the scale of the time, `dashes` the dashes of the joints' lines.
    """

    title: str
    summary: str
    alt: str
    nothing: int
    times: list[float]
    ticks: Scale
    slider: Slider | None
    switch: Switch | None
    unit: Unit
    dashes: list[list[float]]
    scene: PageScene
    panels: list[PagePanel]
    decimals: list[int]
    sampled: str
    arms: list[PageArm]


class Control(TypedDict):
    """A slider: its name, unit and range, the step of its handle, the decimals to write it with."""

    name: str
    unit: str
    low: float
    high: float
    step: float
    decimals: int


class PageUnit(Unit):
    """The same for an explorer, and how it is written in code."""

    code: str


class PagePose(TypedDict):
    """A target as the scripts take it: a place; with `rotation` [w, x, y, z] a transform, with
    `angle` a ScaraPose.
    """

    place: list[float]
    rotation: NotRequired[list[float]]
    angle: NotRequired[float]


class FactRow(TypedDict):
    """Numbers below an arm: what they are called, which fact of the posture they are, the heads of
    their columns, their decimals.
    """

    name: str
    fact: str
    heads: list[str]
    decimals: int


Law: TypeAlias = Literal["quintic", "trapezoidal", "linear"]  # as motion.js has them
Corner: TypeAlias = Literal["parabola", "quintic"]


class StartValues(TypedDict):
    """How a blended motion opens: the numbers of its law, its corner and its branch, too."""

    blend: float
    duration: float
    law: int
    corner: int
    row: int


class JumpRules(TypedDict):
    """The constants of motion/recording.py by which a jump of position is found."""

    least: float
    few: int


class BranchTask(TypedDict):
    """An exercise: how many different postures have to reach the target; what it says then and
    before.
    """

    wanted: int
    holds: str
    open: str


class ExplorerPage(TypedDict):
    """What every explorer is given. `words`: every sentence it says; `code`: the lines of Python
    behind it, with blanks; `meant`: what stands below.
    """

    title: str
    summary: str
    alt: str
    meant: str
    unit: PageUnit
    scene: PageScene
    controls: list[Control]
    words: dict[str, str]
    code: str


class ArmPage(ExplorerPage):
    """The same of an explorer of an arm (see `twin.arm_data`), and the units of its joints."""

    arm: ArmData
    units: list[PageUnit]


class JointPage(ArmPage):
    """The posture q, rows of numbers."""

    kind: Literal["joint"]
    q: list[float]
    rows: list[FactRow]


class LeversPage(ArmPage):
    """The point `target`, the posture q before it."""

    kind: Literal["levers"]
    q: list[float]
    target: PagePose


class TargetPage(ArmPage):
    """The target, its turns in radians, the posture q before it, names of branches, heads of the
    table, the joints whose angles the column "travel" adds; `task`: of an exercise.
    """

    kind: Literal["target"]
    q: list[float]
    target: PagePose
    turns: list[float]
    branches: list[str]
    heads: list[str]
    turning: list[int]
    task: BranchTask | None


class MotionPage(ArmPage):
    """The stations, how it opens, names of laws, corners, branches and panels, samples."""

    kind: Literal["motion"]
    dashes: list[list[float]]
    start: PagePose
    via: PagePose
    goal: PagePose
    start_values: StartValues
    laws: list[Law]
    corners: list[Corner]
    branches: list[str]
    panels: list[str]
    samples: int
    jumps: JumpRules


class LivePage(ExplorerPage):
    """What `live.Live` adds: the question with which an explorer opens, and its answer."""

    question: NotRequired[dict[str, Any]]
    first: NotRequired[dict[str, Any]]


class PlanPage(LivePage):
    """The arm, names of the ways as `branches`, the value of forbidden cells of the cube."""

    kind: Literal["plan"]
    arm: ArmData
    branches: list[str]
    forbidden: int


class TourPage(LivePage):
    """Names of kinds of tasks and of tours, the most points, places for those that are added."""

    kind: Literal["tour"]
    kinds: list[str]
    tours: list[str]
    most: int
    spare: list[list[float]]


PageExplorer: TypeAlias = JointPage | LeversPage | TargetPage | MotionPage | PlanPage | TourPage


class PageAnswer(TypedDict):
    """An answer to a question: its short name, which older notebooks do not have, what it says, why
    it is right or not, the confusion behind a wrong one and a second case that shows it; of a
    number to type its value.
    """

    name: NotRequired[str]
    text: str
    reason: str
    confusion: str | None
    second: str
    value: NotRequired[float]


class PageQuestion(TypedDict):
    """Everything that a prediction is given. `unit` and `within` (a share): of a number to type.
    `choice`: what was chosen in the notebook, if anything. `view`: what opens after the choice, as
    HTML.
    """

    name: str
    title: str
    question: str
    options: list[PageAnswer]
    right: int
    unit: str | None
    within: float
    choice: str | None
    view: str


# --- HTML -----------------------------------------------------------------------------------------


def inert(data: Any) -> str:
    """`data` as JSON that may stand in a script. ValueError: nothing that JSON can hold."""
    try:
        text = json.dumps(data, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
        text.encode()
    except (TypeError, ValueError, RecursionError) as error:
        raise ValueError(f"data: wanted what JSON can hold ({error})") from None
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def still_image(png: bytes, alt: str) -> str:
    """The still picture that stands in the place of a player or an explorer until it wakes."""
    image = base64.b64encode(png).decode()
    return (
        f'<img alt="{html.escape(alt)}" style="max-width:100%" '
        f'src="data:image/png;base64,{image}"><p>{STILL}</p>'
    )


def output(call: str, name: str, text: str, still: str, nonce: str = "") -> str:
    """A piece of HTML: `still`, and the script that replaces it by what `text`, a `Page`,
    `PageExplorer` or `PageQuestion` as JSON, describes. `call`: the module and its function,
    "player.play". `nonce`: of a page whose policy lets no other script run.
    """
    module, _ = call.split(".")
    key, bytes_of_script = compressed(module)
    tag = f"script nonce={nonce}" if nonce else "script"
    return (
        f'<div class="robokin-player" data-player="{name}">{still}</div>\n'
        f"<style>{css()}{style('elements')}\n</style>\n"
        f"<{tag}>(() => {{\n{script('loader')}\n"
        f'$loader.start("{name}", "{key}", "{bytes_of_script}", ${module} => {{\n'
        f'${call}("{name}", {text});\n}});\n}})();</script>\n'
    )
