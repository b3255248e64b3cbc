"""Types for the data of explorers. Those for the data of an arm are in `twin`."""

from typing import Any, Literal, NotRequired, TypeAlias, TypedDict

from .page import PageScene, Unit
from .twin import ArmData


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
    to show when the task is solved (`holds`) and before that (`open`).
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
    """The curve of the sum S against the free angle alpha: its title, the label of its axis, the
    names of its three terms, and the dash patterns of their lines. `terms` and `dashes` are empty
    if only S is drawn.
    """

    title: str
    axis: str
    terms: list[str]
    dashes: list[list[float]]


class LeversPage(ArmPage):
    """The data of an explorer of three levers: the previous posture q, the points to be reached one
    after the other, and the curve of the sum of the angle changes.
    """

    kind: Literal["levers"]
    q: list[float]
    targets: list[PagePose]
    curve: PageCosts


class ElbowPage(ArmPage):
    """The data of the elbow explorer: the initial point [r, z] in the plane of the arm, the
    headings of the table, and the names of its rows.
    """

    kind: Literal["elbow"]
    point: list[float]
    heads: list[str]
    elbows: list[str]


class CrossingPage(ArmPage):
    """The data of the crossing explorer: the tip [x3, y3] in metres, the coordinate of the tip by
    which the formula divides (0 or 1, or None without a formula), the name of the elbow coordinate
    that is plotted against it, the names of the rows, and the headings of the table.
    """

    kind: Literal["crossing"]
    tip: list[float]
    divisor: int | None
    eliminated: str
    rows: list[str]
    heads: list[str]


class TargetPage(ArmPage):
    """The data of the target explorer: the target, its rotations in radians, the previous posture
    q, the names of the branches, the headings of the table, and the joints whose angle changes are
    added up in the column "travel". The explorer says which of the joints in `watched` is nearest
    to one of its limits, and how near. `task` belongs to an exercise.
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
    corners, branches and panels, the number of samples, and whether the explorer shows a close-up
    of the corner.
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
    the line, and the direction from the pose to the line), the row of `ik`, and the tool's speed in
    m/s.
    """

    kind: Literal["singularity"]
    pose: PagePose
    along: list[float]
    beside: list[float]
    row: int
    speed: float


class ClearancePage(ArmPage):
    """The data of the clearance explorer: the start posture q, the target, the places of the
    gripper's via points and of the obstacle, and the distance in metres that the levers should
    keep.
    """

    kind: Literal["clearance"]
    q: list[float]
    target: PagePose
    vias: list[list[float]]
    obstacle: list[float]
    distance: float


class RotationPage(ExplorerPage):
    """The data of the rotation explorer: two perpendicular unit vectors (the axis, and the
    direction from the axis to the tip of v), the length of v in metres, the initial angles in
    radians (of the rotation, and between v and the axis), the names of the rows and the headings of
    the table, and the number of decimals of lengths.
    """

    kind: Literal["rotation"]
    axis: list[float]
    across: list[float]
    length: float
    angles: list[float]
    rows: list[str]
    heads: list[str]
    decimals: int


class PathsPage(ArmPage):
    """The data of the paths explorer: start and goal, the pulses per degree of the joints, the
    maximum pulse frequency of a motor, the row of `ik`, the number of postures along the straight
    line, the names of the paths, and the headings of the table.
    """

    kind: Literal["paths"]
    start: list[float]
    goal: list[float]
    per_degree: list[float]
    limit: float
    row: int
    samples: int
    paths: list[str]
    heads: list[str]


class LivePage(ExplorerPage):
    """The additional data of `live.Live`: the first question of an explorer, and its answer."""

    question: NotRequired[dict[str, Any]]
    first: NotRequired[dict[str, Any]]


class PlanPage(LivePage):
    """The data of the plan explorer: the arm, the names of the planning methods (`branches`), and
    the value of forbidden cells in the cube.
    """

    kind: Literal["plan"]
    arm: ArmData
    branches: list[str]
    forbidden: int


class TourPage(LivePage):
    """The data of the tour explorer: the names of the kinds of tasks and of the tours, whether the
    best one is shown at first, the speeds of the joints (rad/s), the fraction of T by which a time
    may exceed T through rounding, the maximum number of points, and the places of points that the
    reader adds.
    """

    kind: Literal["tour"]
    kinds: list[str]
    tours: list[str]
    best: bool
    speeds: list[float]
    slack: float
    most: int
    spare: list[list[float]]


PageExplorer: TypeAlias = (
    JointPage
    | LeversPage
    | ElbowPage
    | CrossingPage
    | TargetPage
    | MotionPage
    | RotationPage
    | SingularityPage
    | ClearancePage
    | PathsPage
    | PlanPage
    | TourPage
)
