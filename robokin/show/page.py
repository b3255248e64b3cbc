"""The types of the data in a page. Those of the explorers are in `explorer_page`, and those of the
things in a scene other than an arm are in `things`.
"""

from typing import NotRequired, TypedDict

from .numbers import Packed, Scale
from .things import PageThing
from .twin import PageLink

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
    unit, its scale, and the numbers of each arm. The curves of whole numbers have steps, because a
    count has no values in between.
    """

    label: str
    scale: Scale
    steps: bool
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
    part of the data: it is part of the page's HTML.
    """

    name: str
    title: str
    question: str
    options: list[PageAnswer]
    right: int
    unit: str | None
    within: float
    choice: str | None
