"""An explorer of two links whose tip crosses a line. It shows the tracks of both elbows, and which
elbow a formula returns.
"""

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import choice, floats, instance, short
from ..arms.arm import ClosedFormArm
from ..arms.branches import explain
from ..arms.two_link import TwoLinkGeometry
from ..units import deg, mm
from .camera import extent
from .explorer import WORDS, Explorer, arm_page, control, imports, number
from .explorer_page import CrossingPage, PageUnit
from .numbers import rounded, series_step
from .palette import COMPARED, FAINT, REMARK
from .sketch import Sketch

SMALL = 0.5  # m: if the reach of an arm is shorter, its lengths are shown in mm
SIDES = "right elbow", "left elbow"
DIVISORS = "x3", "y3"
TRACKS = (
    "The outer, solid line is the track of the right elbow, and the inner, dashed line is that of "
    "the left elbow, while the tip moves along the dotted line. (Both tracks are on the circle of "
    "radius l1 around the base; they are drawn beside it.) A ring marks a place where the two "
    "elbows meet."
)
BAND = (
    "The grey band shows which of them the formula returns, and the black dot is that elbow now. "
    "The red dashes go from one end of the jump to the other."
)
SAYS = {
    **{key: WORDS[key] for key in ("copy", "copied", "none")},
    "take": "tip",
    "returned": "{elbow}: formula",
    "both": "both elbows",
    "any": "one of the elbows",
    "line": "{letter} = {value}",
    "seen": "Tip at x3 {x}, y3 {y} {unit}.",
    "elbow": "{elbow} at ({x}, {y}) {unit}.",
    "curve": "{y} of both elbows plotted against {x}.",
    "meet": "Along the dotted line, the two elbows meet at {count} places.",
    "returns": "The formula returns the {elbow}.",
    "jumps": "Along the dotted line, it jumps by {jump} {unit} at {line}.",
    "one": "Along the dotted line, it does not jump: the two elbows are one at {line}.",
    "keeps": "Along the dotted line, it does not jump at {line}: on both sides, the formula "
    "returns the elbow with the greater {kept}.",
    "stays": "The dotted line does not cross {line} within reach, so the formula does not jump.",
    "nothing": "At {line}, the formula divides 0 by 0 and returns no number, although the tip "
    "is in reach.",
    "stretched": "The arm is stretched: both elbows coincide.",
    "folded": "The arm is folded: both elbows coincide.",
    "onBase": "The tip is on the base: the arm is folded, and every point of the circle around "
    "the base is an elbow. The view shows one of them.",
    "tooFar": "Out of reach: the tip is {gap} beyond the reach of the arm.",
    "tooNear": "Out of reach: the tip is {gap} too close to the base.",
}


def crossing_explorer(
    arm: ClosedFormArm, tip: ArrayLike, *, divisor: str | None = None
) -> Explorer:
    """Show two links from above, with both elbows. The reader drags the tip. Two curves show the
    tracks of the elbows while the tip moves along a straight line through its current position;
    rings mark the places where the elbows meet.

    With `divisor`, the explorer also shows which elbow the quadratic formula returns, and how far
    it jumps. "x3" means that x2 is eliminated, so that the formula divides by x3 - x1; the line
    through the tip is then horizontal. "y3" means that y2 is eliminated; the line is then vertical.
    The formula uses the plus sign before the root. `tip` (2,) is in metres.

    It displays itself at the end of a cell. Raises TypeError if the arm does not consist of two
    links, and ValueError if `tip` is not a point in reach or `divisor` has another value.
    """
    geometry = instance(arm, ClosedFormArm, "arm").geometry
    if not isinstance(geometry, TwoLinkGeometry):
        raise TypeError(f"arm: wanted two links (two_link), got {arm.name}")
    place = floats(tip, "tip", 2)
    if place.ndim != 1:
        raise ValueError(f"tip: wanted one point (2,), got shape {place.shape}")
    rows = arm.ik(place)
    if np.isnan(rows).any():
        raise ValueError(
            f"tip: wanted a point in reach, got {short(tip)}. {explain(arm, place, 0)}"
        )
    k = None if divisor is None else DIVISORS.index(choice(divisor, "divisor", DIVISORS))
    size, unit = (1.0, "m") if extent(arm) >= SMALL else (mm, "mm")
    decimals = 3 if unit == "m" else 1
    most = 1.05 * arm.reach
    step = series_step(most / 210)
    base = np.array(geometry.base)
    ends = np.ceil(most / step - 1e-9) * step * np.array([[-1], [1]]) + np.round(base / step) * step
    controls = [
        control(name, unit, ends[0, i] / size, ends[1, i] / size, step / size, decimals)
        for i, name in enumerate(DIVISORS)
    ]
    alt = _summary(arm, place, rows, unit, size, decimals)
    around = np.stack([np.arange(-180, 180, 90) * deg, np.zeros(4)], axis=-1)
    page = arm_page(
        arm,
        "The tip and both elbows",
        alt,
        controls,
        rows,
        near=around,
        meant=f"Drag the ring at the tip, or move the sliders. {TRACKS}"
        + ("" if k is None else f" {BAND}"),
        code=f"{imports(arm)}\narm.ik(np.array([{{x}}, {{y}}]){' * mm' if unit == 'mm' else ''})",
    )
    corners = base + most * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    page["scene"] |= {"grows": False, "seen": [rounded([*corner, 0], 4) for corner in corners]}
    kept, eliminated = ("x2", "y2") if k else ("y2", "x2")
    page["words"] = {**SAYS, "keeps": SAYS["keeps"].replace("{kept}", kept)}
    given: PageUnit = {"name": unit, "size": size, "code": unit}
    data: CrossingPage = {
        "kind": "crossing",
        **page,
        "unit": given,
        "tip": place.tolist(),
        "divisor": k,
        "eliminated": eliminated,
        "rows": [*SIDES, "formula"][: 2 if k is None else 3],
        "heads": ["", f"x2, {unit}", f"y2, {unit}"],
    }
    still = Sketch(alt, title=page["title"], unit=unit, x="x", y="y", width=6.4, height=5.6)
    _draw(still, arm, geometry, place, rows, k or 0, size)
    return Explorer(data, still)


def _elbows(arm: ClosedFormArm, rows: Floats) -> Floats:
    """Return the elbows (..., 2) of postures (..., 2)."""
    found: Floats = arm.frames(rows)[..., 1].translation[..., :2]
    return found


def _summary(
    arm: ClosedFormArm, place: Floats, rows: Floats, unit: str, size: float, decimals: int
) -> str:
    """Say where the tip and both elbows are."""
    x, y = (number(value, decimals) for value in place / size)
    said = [SAYS["seen"].format(x=x, y=y, unit=unit)]
    for name, elbow in zip(SIDES, _elbows(arm, rows), strict=True):
        x, y = (number(value, decimals) for value in elbow / size)
        said.append(SAYS["elbow"].format(elbow=name.capitalize(), x=x, y=y, unit=unit))
    return " ".join(said)


def _draw(
    sketch: Sketch,
    arm: ClosedFormArm,
    geometry: TwoLinkGeometry,
    place: Floats,
    rows: Floats,
    k: int,
    size: float,
) -> None:
    """Draw the arm with both elbows and their tracks, and the rims of its reach."""
    base, rims = np.asarray(geometry.base), [arm.reach, abs(geometry.l1 - geometry.l2)]
    turn = np.linspace(-np.pi, np.pi, 721)
    line = np.tile(place, (len(turn), 1))
    line[:, k] = base[k] + arm.reach * np.sin(turn / 2)
    tracks = _elbows(arm, arm.ik(line)) / size
    for side, (color, style) in zip((0, 1), COMPARED, strict=False):
        beside = base / size + (1.04, 0.96)[side] * (tracks[:, side] - base / size)
        sketch.ax.plot(*beside.T, color=color, ls=style, lw=1.6)
    sketch.ax.plot(*(line[np.isfinite(tracks[:, 0, 0])] / size).T, color=REMARK, lw=1, ls=":")
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    for radius in rims:
        sketch.ax.plot(*((base + radius * ring) / size).T, color=FAINT, lw=1)
    for side, elbow in reversed(list(enumerate(_elbows(arm, rows)))):
        sketch.levers([base, elbow, place], ["", SIDES[side]], dashed=side > 0)
    sketch.point(place, "tip", away=(1, 0.3))
