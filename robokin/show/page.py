"""The types of the data in a page. Those of an explorer's arm are in `twin`, and those of the other
things in a scene are in `things`.
"""

from typing import Any, Literal, NotRequired, TypeAlias, TypedDict

from .numbers import Packed, Scale
from .things import PageThing
from .twin import ArmData, PageLink

# --- Page data ------------------------------------------------------------------------------------
#
# Scenes use metres and radians; curves use degrees and the unit of lengths. A rigid transform is 12
# numbers: the rows of [R | p]. Each motion belongs to one value of the switch and one value of the
# slider. Its index is the index of the switch value, times the number of slider values, plus the
# index of the slider value.


class Unit(TypedDict):
    """The unit of lengths in curves and tables: its name, and its size in metres."""

    name: str
    size: float


class Slider(TypedDict):
    """A slider that selects a motion by a number: its values, and the decimals to show."""

    label: str
    values: list[float]
    decimals: int


class Switch(TypedDict):
    """A menu that selects a motion: its label and its options."""

    label: str
    values: list[str]


class PageScene(TypedDict):
    """The scene: the arm's length, the coordinate that is zero in a flat scene, the step of the
    floor's grid, the points that must be visible, two corners of the floor, and the azimuth and
    elevation of the camera. With `grows`, the picture zooms out when an arm or a thing leaves it. A
    `solid` floor hides what is below it. With `bases`, all arms are in one picture at these places;
    if it is None, each arm has its own picture.
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
    """The scale of revolute or of prismatic joints in one panel."""

    unit: str
    scale: Scale


class PagePanel(TypedDict):
    """One panel of curves, with one scale for all motions. `near` lists the limits to show for each
    arm, as [joint, 0 for lower or 1 for upper]. `axes` contains the axes of "turn" and "shift"
    joints, if the arms have any.
    """

    label: str
    near: list[list[list[int]]]
    axes: dict[str, Axis]


class PageQuantity(TypedDict):
    """A panel of a quantity that does not belong to a joint, such as a distance: its name with the
    unit, its scale, and the numbers of each arm.
    """

    label: str
    scale: Scale
    values: list[Packed]


class Watch(TypedDict):
    """The panel and the joints to watch: the index of the large panel (quantities come after the
    three panels of joints) and the joints that are not faint, counted from 0 (None: all joints).
    """

    panel: int
    joints: list[int] | None


class Greatest(TypedDict):
    """The greatest speed, its percentage of the limit, and the greatest acceleration, for each
    motion and joint. The acceleration is a string if the speed jumps.
    """

    speed: list[list[float]]
    share: list[list[int]] | None
    acceleration: list[list[float | str]]


class Flaws(TypedDict):
    """The flaws of motions, by the index of the motion: the samples after which the curves break,
    [[time, label]] for jumps in speed and in position, and sentences about the flaws.
    """

    gaps: dict[str, list[int]]
    jumps: dict[str, list[tuple[float, str]]]
    leaps: dict[str, list[tuple[float, str]]]
    notes: dict[str, list[str]]


class PageArm(Greatest, Flaws):
    """One arm and its motions: joint values, speeds and accelerations as `Packed`; [lower, upper]
    joint limits; speed limits; for each motion [smallest distance from "via", x, y, z of the
    nearest place], or None; for each motion of an arm with an inverse [first sample, name] of the
    rows of `ik` to which its postures belong.
    """

    name: str
    rows: list[list[tuple[int, str]]] | None
    chain: list[PageLink]
    motion: list[Packed]
    limits: list[list[float]]
    speedLimits: list[float] | None
    via: list[list[float] | None] | None


class TimePage(TypedDict):
    """The data of every view of curves over time. `nothing` is the integer in a `Packed` that means
    "no value", `ticks` is the scale of the time axis, and `dashes` are the dash patterns of the
    joints.
    """

    title: str
    summary: str
    alt: str
    nothing: int
    times: list[float]
    ticks: Scale
    dashes: list[list[float]]


class Page(TimePage):
    """The data of a player. `decimals` contains the number of decimals for speeds and for
    accelerations. `sampled` says which samples the greatest values come from.
    """

    slider: Slider | None
    switch: Switch | None
    unit: Unit
    scene: PageScene
    panels: list[PagePanel]
    quantities: list[PageQuantity]
    watch: Watch
    decimals: list[int]
    sampled: str
    arms: list[PageArm]


class CurvePanel(PagePanel):
    """A panel of `PageCurves`: the values of all joints, the [lower, upper] limit of each, and the
    [time, label] of each mark.
    """

    values: Packed
    limits: list[list[float]] | None
    marks: list[tuple[float, str]]


class PageCurves(TimePage):
    """The joint curves of one motion. `prismatic` says whether each joint is prismatic, `gaps`
    contains the samples after which the curves break, and `notes` are sentences, each with True if
    it reports a violation.
    """

    prismatic: list[bool]
    gaps: list[int]
    panels: list[CurvePanel]
    notes: list[tuple[str, bool]]


class Control(TypedDict):
    """A slider: its name, unit and range, the step of its handle, and the number of decimals to
    show.
    """

    name: str
    unit: str
    low: float
    high: float
    step: float
    decimals: int


class PageUnit(Unit):
    """The unit of a joint or of lengths, with its name in Python code."""

    code: str


class PagePose(TypedDict):
    """A target: a position, with `rotation` [w, x, y, z] if it is a Transform, or with `angle` if
    it is a ScaraPose.
    """

    place: list[float]
    rotation: NotRequired[list[float]]
    angle: NotRequired[float]


class FactRow(TypedDict):
    """A row of numbers below an arm: its name, the property of the posture that it shows, the
    headings of its columns, and its number of decimals.
    """

    name: str
    fact: str
    heads: list[str]
    decimals: int


Law: TypeAlias = Literal["quintic", "trapezoidal", "linear"]  # named as in motion.js
Corner: TypeAlias = Literal["parabola", "quintic"]


class StartValues(TypedDict):
    """The initial values of a blended motion; law, corner and row (the branch) are indices."""

    blend: float
    duration: float
    law: int
    corner: int
    row: int


class JumpRules(TypedDict):
    """The constants with which motion/recording.py finds jumps in position."""

    least: float
    few: int


class BranchTask(TypedDict):
    """An exercise: the number of different postures that must reach the target, and the sentences
    to show when the task is solved (`holds`) and until then (`open`).
    """

    wanted: int
    holds: str
    open: str


class ExplorerPage(TypedDict):
    """The data of every explorer. `words` contains all its sentences, `code` the corresponding
    Python lines, with blanks to fill, and `meant` the explanation below the view.
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
    """The data of an explorer of an arm (see `twin.arm_data`), with the units of its joints."""

    arm: ArmData
    units: list[PageUnit]


class JointPage(ArmPage):
    """The data of the joint explorer: the posture q, rows of numbers, whether it mentions
    singularities, and, if it marks the wrist centre, its place in flange coordinates.
    """

    kind: Literal["joint"]
    q: list[float]
    rows: list[FactRow]
    singular: bool
    wrist: list[float] | None


class PageCosts(TypedDict):
    """The curve of the sum S over the free angle alpha: its title, the text of its axis, and the
    names of its three terms and the dashes of their lines, or none if only S is drawn.
    """

    title: str
    axis: str
    terms: list[str]
    dashes: list[list[float]]


class LeversPage(ArmPage):
    """The data of an explorer of three levers: the previous posture q, the points to reach one
    after the other, and the curve of the sum of the angle changes.
    """

    kind: Literal["levers"]
    q: list[float]
    targets: list[PagePose]
    curve: PageCosts


class ElbowPage(ArmPage):
    """The data of the explorer of an elbow: the point [r, z] in the plane of the arm, the headings
    of the table, and the names of its rows.
    """

    kind: Literal["elbow"]
    point: list[float]
    heads: list[str]
    elbows: list[str]


class TargetPage(ArmPage):
    """The data of the target explorer: the target, its rotations in radians, the previous posture
    q, the names of the branches, the headings of the table, and the joints whose angle changes are
    added up in the column "travel". `watched` lists the joints for which the explorer says how far
    the one nearest to a limit is from it. `task` belongs to an exercise.
    """

    kind: Literal["target"]
    q: list[float]
    target: PagePose
    turns: list[float]
    branches: list[str]
    heads: list[str]
    turning: list[int]
    watched: list[int]
    task: BranchTask | None


class MotionPage(ArmPage):
    """The data of the motion explorer: the stations, the initial values, the names of laws,
    corners, branches and panels, the number of samples, and whether it shows the corner close up.
    """

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
    close_up: bool


class SingularityPage(ArmPage):
    """The data of the singularity explorer: the singular pose, two unit vectors (the direction of
    the line, and that in which it misses the pose), the row of `ik`, and the tool's speed in m/s.
    """

    kind: Literal["singularity"]
    pose: PagePose
    along: list[float]
    beside: list[float]
    row: int
    speed: float


class RotationPage(ExplorerPage):
    """The data of the rotation explorer: two perpendicular unit vectors (the axis, and the one
    across it towards v), the length of v in metres, the opening angles in radians (of the rotation,
    and between v and the axis), the names of the rows and the headings of the table, and the number
    of decimals of lengths.
    """

    kind: Literal["rotation"]
    axis: list[float]
    across: list[float]
    length: float
    angles: list[float]
    rows: list[str]
    heads: list[str]
    decimals: int


class LivePage(ExplorerPage):
    """The additional data of `live.Live`: the first question of an explorer, and its answer."""

    question: NotRequired[dict[str, Any]]
    first: NotRequired[dict[str, Any]]


class PlanPage(LivePage):
    """The data of the explorer of plans: the arm, the names of the ways to plan (`branches`), and
    the value of forbidden cells in the cube.
    """

    kind: Literal["plan"]
    arm: ArmData
    branches: list[str]
    forbidden: int


class TourPage(LivePage):
    """The data of the explorer of tours: the names of the kinds of tasks and of the tours, whether
    the best one is shown at first, the speeds of the joints (rad/s), the maximum number of points,
    and the places of points that the reader adds.
    """

    kind: Literal["tour"]
    kinds: list[str]
    tours: list[str]
    best: bool
    speeds: list[float]
    most: int
    spare: list[list[float]]


PageExplorer: TypeAlias = (
    JointPage
    | LeversPage
    | ElbowPage
    | TargetPage
    | MotionPage
    | RotationPage
    | SingularityPage
    | PlanPage
    | TourPage
)


class PageAnswer(TypedDict):
    """An option of a question: its short name (missing in older notebooks), its text, why it is
    right or wrong, the misconception behind a wrong one, and a second example that exposes it;
    `value` if the answer is a number to type.
    """

    name: NotRequired[str]
    text: str
    reason: str
    confusion: str | None
    second: str
    value: NotRequired[float]


class PageQuestion(TypedDict):
    """The data of a prediction. `unit` and `within` (a fraction) are for a number that the reader
    types. `choice` is the choice in the notebook, if any. The view that answers the question is not
    part of the data: it is HTML of the page.
    """

    name: str
    title: str
    question: str
    options: list[PageAnswer]
    right: int
    unit: str | None
    within: float
    choice: str | None
