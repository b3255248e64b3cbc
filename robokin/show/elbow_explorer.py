"""The explorer of an elbow: the triangle of upper arm and forearm, seen from the side."""

import numpy as np

from .._arrays import Floats
from .._validate import instance
from ..arms.arm import ClosedFormArm
from ..arms.branches import representative
from ..arms.elbow import Elbow, ElbowGeometry
from ..arms.link import Link
from ..arms.spherical_wrist import SphericalWristGeometry
from ..transform import Transform
from ..units import deg, length_unit, mm, wrapped
from .camera import STRAIGHT, extent
from .explorer import WORDS, Explorer, arm_page, control, number
from .explorer_page import ElbowPage, PageUnit
from .numbers import rounded, series_step, tidy
from .page import PageScene
from .palette import FAINT
from .sketch import Sketch

BEYOND = 1.06  # times l2 + l3: how far from joint 2 the point can be moved
FLAGS = "+1", "\N{MINUS SIGN}1"
SAYS = {
    **{key: WORDS[key] for key in ("copy", "copied", "and", "none")},
    "lengths": "from joint 2, {unit}",
    "seen": "{name} from the side: {point} at r {r}, z {z} {unit}, d {d} {unit}.",
    "bent": "Elbow {flag}: γ {gamma}°, α {alpha}°, q2 {q2}°, q3 {q3}°.",
    "inside": "Elbow {flag}: joints 2 and 3 are inside their limits.",
    "past": "Elbow {flag}: {facts}.",
    "stretched": "The arm is stretched: both elbows coincide (elbow singularity).",
    "folded": "The arm is folded: both elbows coincide (elbow singularity).",
    "tooFar": "Out of reach: d is {gap} longer than l2 + l3. The circles do not meet.",
    "tooNear": "Out of reach: d is {gap} shorter than the difference of l2 and l3. The circles do "
    "not meet.",
    "behind": "Behind axis 1: the front flag is \N{MINUS SIGN}1.",
    "onAxis": "On axis 1: q1 can have any value (shoulder singularity).",
}
MEANT = (
    "Drag the ring, or move the sliders. Click a row of the table to choose an elbow. The picture "
    "shows the plane in which the arm bends: r is measured from axis 1, z from the floor, and "
    "joint 1 turns the plane. Each elbow lies on both dotted circles: it is l2 away from joint 2 "
    "and l3 away from {point}."
)


def elbow_explorer(arm: ClosedFormArm) -> Explorer:
    """Show the vertical plane in which an arm bends, to scale. The reader moves a point: the wrist
    centre of a six-axis arm, or the flange of an arm that positions a point. The triangle of upper
    arm l2, forearm l3 and the line d from joint 2 to the point follows, for both elbows. A click on
    a row of the table chooses one of them.

    The explorer shows alpha, the elevation of the upper arm; gamma, the angle from the upper arm to
    the forearm; and the values of joints 2 and 3. It says by how much a joint exceeds its limit,
    and by how much d is too long or too short for a triangle. It displays itself at the end of a
    cell. Raises TypeError if the arm has no such triangle.
    """
    three, elbow = _positioning(arm)
    what, place = arm.geometry.carried, _opening(elbow)
    rows = representative(three, three.ik([place[0], elbow.lateral, place[1]])[:2])
    name, size = length_unit(extent(three))
    step, decimals, code = (1, 1, " * mm") if size == mm else (0.001, 3, "")
    lowest, highest = _room(elbow)
    controls = [
        control(letter, name, low / size, high / size, step, decimals)
        for letter, low, high in zip("rz", lowest, highest, strict=True)
    ]
    title = f"{arm.name} from the side: move {what}"
    page = arm_page(
        three,
        title,
        _summary(arm, elbow, place, rows, {"name": name, "size": size, "code": name}, decimals),
        controls,
        rows,
        meant=MEANT.format(point=what),
        code=f"{'from robokin import mm' if code else ''}\n\n".lstrip()
        + f"r, z, elbow = {{r}}{code}, {{z}}{code}, {{elbow}}",
    )
    page["arm"]["carried"] = what
    page["scene"] = _plane(elbow, lowest, highest)
    page["words"] = SAYS | {"take": what.removeprefix("the ")}
    data: ElbowPage = {
        "kind": "elbow",
        **page,
        "point": place.tolist(),
        "heads": ["elbow", "γ, °", "α, °", "q2, °", "q3, °"],
        "elbows": [f"elbow {flag}" for flag in FLAGS],
    }
    still = Sketch(page["alt"], title=title, unit=name, x="r", y="z", width=6.4, height=5.6)
    _draw(still, elbow, place, rows, size, page["words"]["take"])
    return Explorer(data, still)


def _positioning(arm: ClosedFormArm) -> tuple[ClosedFormArm, Elbow]:
    """Return an arm that has only the first three joints, with its flange at the wrist centre, and
    its elbow. An arm that positions a point is returned unchanged.
    """
    solid = instance(arm, ClosedFormArm, "arm").geometry
    if isinstance(solid, ElbowGeometry):
        return arm, solid.elbow
    if not isinstance(solid, SphericalWristGeometry):
        wanted = "an arm with a spherical wrist, or one that positions a point with an elbow"
        raise TypeError(f"arm: wanted {wanted}, got {arm.name}")
    home = np.zeros(6)
    centre = arm.fk(home) @ solid.wrist.centre_from_flange
    first, second, third = arm.links[:3]
    end = third.after @ Transform(translation=arm.frames(home)[3].inverse() @ centre)
    three = ElbowGeometry([first, second, Link(third.before, third.axis, end)])
    return ClosedFormArm(arm.name, three, arm.limits[:3]), three.elbow


def _opening(elbow: Elbow) -> Floats:
    """Return the initial place (r, z) of the point, in round numbers. As seen from joint 2, it is
    60 degrees above the horizontal, at the distance at which upper arm and forearm are
    perpendicular, up to rounding. Every elbow can reach this distance.
    """
    away = float(np.hypot(elbow.upper, elbow.fore))
    step = series_step(away / 100)
    place = [elbow.shoulder_x, elbow.shoulder_z] + away * np.array(
        [np.cos(60 * deg), np.sin(60 * deg)]
    )
    return np.array(rounded(np.round(place / step) * step))


def _room(elbow: Elbow) -> tuple[Floats, Floats]:
    """Return the lower and the upper limits (r, z) of the point. It stays above the floor, and it
    can be moved a little beyond the reach of the arm.
    """
    shoulder = np.array([elbow.shoulder_x, elbow.shoulder_z])
    most = BEYOND * (elbow.upper + elbow.fore)
    step = series_step(most / 20)
    lowest = np.array([np.floor((shoulder[0] - most) / step) * step, 0.0])
    return lowest, np.ceil((shoulder + most) / step) * step


def _plane(elbow: Elbow, lowest: Floats, highest: Floats) -> PageScene:
    """Return the scene: the plane y = 0 from the side, with a grid instead of a floor."""
    step = series_step(float((highest - lowest).max()) / 8)
    low, high = np.floor(lowest / step + 1e-9), np.ceil(highest / step - 1e-9)
    return {
        "size": tidy(elbow.upper + elbow.fore, 4),
        "flat": 1,
        "grid": tidy(step, 6),
        "seen": [rounded([r, 0, z], 4) for r in (lowest[0], highest[0]) for z in (0, highest[1])],
        "floor": [rounded([r * step, 0, z * step], 4) for r, z in (low, high)],
        "view": rounded(STRAIGHT[1], 6),
        "grows": False,
        "solid": False,
        "bases": None,
        "things": [],
    }


def _angles(elbow: Elbow, q: Floats) -> tuple[float, float]:
    """Return alpha and gamma of a posture, with gamma between -pi and pi."""
    return elbow.upper_angle + elbow.sign2 * float(q[1]), float(wrapped(elbow.bend(q)))


def _summary(
    arm: ClosedFormArm, elbow: Elbow, place: Floats, rows: Floats, unit: PageUnit, decimals: int
) -> str:
    """State the position of the point and the angles of both elbows."""
    away = place - [elbow.shoulder_x, elbow.shoulder_z]
    r, z, d = (number(x / unit["size"], decimals) for x in (*place, float(np.hypot(*away))))
    facts = {"r": r, "z": z, "d": d, "unit": unit["name"]}
    said = [SAYS["seen"].format(name=arm.name, point=arm.geometry.carried, **facts)]
    for flag, q in zip(FLAGS, rows, strict=True):
        alpha, gamma = (number(angle / deg, 1) for angle in _angles(elbow, q))
        q2, q3 = (number(angle / deg, 1) for angle in q[1:])
        said.append(SAYS["bent"].format(flag=flag, gamma=gamma, alpha=alpha, q2=q2, q3=q3))
    return " ".join(said)


def _draw(
    sketch: Sketch, elbow: Elbow, place: Floats, rows: Floats, size: float, point: str
) -> None:
    """Draw both elbows, with the lengths and angles of the one with the flag +1."""
    shoulder, long = np.array([elbow.shoulder_x, elbow.shoulder_z]), elbow.upper + elbow.fore
    column = np.array([[0, 0], [0, shoulder[1]], shoulder]) / size
    sketch.ax.plot(*column.T, color=FAINT, lw=4, zorder=0)
    for k in (1, 0):
        alpha, gamma = _angles(elbow, rows[k])
        knee = shoulder + elbow.upper * np.array([np.cos(alpha), np.sin(alpha)])
        sketch.levers([shoulder, knee, place], ["", f"elbow {FLAGS[k]}"], dashed=k > 0)
    sketch.angle(shoulder, 0, alpha, "α", radius=0.09 * long)
    sketch.angle(knee, alpha, alpha + gamma, "γ", radius=0.11 * long)
    foot = np.array([place[0], shoulder[1]])
    sketch.length(shoulder, foot, "u", right=True)
    sketch.length(foot, place, "w")
    sketch.length(shoulder, place, "d")
    sketch.length(shoulder, knee, "$l_2$")
    sketch.length(knee, place, "$l_3$")
    sketch.point(place, point, away=(1, 0.3))
    sketch.point(shoulder, "joint 2", away=(-0.3, -1))
