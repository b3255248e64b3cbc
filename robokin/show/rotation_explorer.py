"""The explorer of a rotation: a vector v, the product q v, and the rotated vector q v q*."""

import re

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import floats, number, short
from ..quaternion import hamilton, unit
from ..units import deg, length_unit, mm
from . import plots
from .camera import SPECK, VIEW
from .checks import HORIZON
from .explorer import WORDS, Explorer, control
from .explorer import number as told
from .explorer_page import RotationPage
from .numbers import rounded
from .page import PageScene
from .palette import INK, REMARK, SECOND, SOFT, TRACE
from .scene import Scene

MOST = 4 * np.pi  # after two whole turns, the quaternion has its initial value again
FARTHEST = 120  # degrees: the largest angle between v and the axis
LENGTHS = ("v", "q v", "q v q*")  # the rows of the table after that of q, which has no unit
SEEN = (
    "A vector v of {length} {unit} at {tilt}° to the axis n, and q for the rotation by {angle}°. "
    "q v: real part {real}, vector part ({left}) {unit}. q v q*: ({whole}) {unit}."
)
SAYS = {
    **{name: WORDS[name] for name in ("copy", "copied")},
    "takeAngle": "q v q*, around the axis n",
    "takeTilt": "v, towards the axis n",
    "real": "Real part of q v: ",
    "scale": "v is {length} {unit} long",
    "seen": SEEN,
    "half": "Perpendicular to n: q v is rotated by {half}°, q v q* by {angle}°.",
    "along": "Along n: v has {along} {unit}, q v has {kept} {unit}.",
    "perpendicular": "v is perpendicular to n, so the real part is 0 for every θ.",
    "parallel": "v lies on the axis n, so q v q* is v for every θ.",
    "one": "q is 1: both products are v.",
    "minus": "q is \N{MINUS SIGN}1: q v is \N{MINUS SIGN}v, but q v q* is v.",
}
MEANT = (
    "Drag the rings, or move the sliders: θ is the angle of the rotation about the axis n, φ is "
    "the angle between v and n. Each of the two coloured arcs is θ/2. The dotted line from the "
    "circle to the tip of q v is parallel to n."
)


def rotation_explorer(angle: float, axis: ArrayLike, v: ArrayLike) -> Explorer:
    """Show a vector v (3,), in metres, and the products q v and q v q*, where q is the quaternion
    of the rotation by `angle` about the unit vector `axis` (3,). The vector part of q v is drawn,
    and its real part is shown as a number; q v q* is the rotated vector. The reader changes the
    angle of the rotation, from 0 to two whole turns, and the angle between v and the axis.

    `angle` is in radians. The explorer displays itself at the end of a cell. Raises ValueError if
    the angle is below 0 or above 4 pi, or if `axis` is not one unit vector. Raises ValueError if v
    is not one vector, is more than 120 degrees away from the axis, or is too short or too long to
    draw.
    """
    turn = number(angle, "angle")
    if not 0 <= turn <= MOST:
        raise ValueError(f"angle: wanted 0 to 4 pi (two whole turns), got {short(angle)}")
    n, way = floats(axis, "axis", 3), floats(v, "v", 3)
    if n.ndim != 1:
        raise ValueError(f"axis: wanted one unit vector (3,), got shape {n.shape}")
    n = unit(n, "axis", "one unit vector")
    with np.errstate(over="ignore"):
        length = float(np.linalg.norm(way))
    if way.ndim != 1 or not SPECK <= length <= HORIZON:
        wanted = f"one vector (3,) from {SPECK:g} to {HORIZON:g} m long"
        raise ValueError(f"v: wanted {wanted}, got {short(v)}")
    across = _across(n, way)
    tilt = float(np.arctan2(way @ across, way @ n))
    if tilt > FARTHEST * deg:
        wanted = f"a vector at most {FARTHEST}° away from the axis"
        raise ValueError(f"v: wanted {wanted}, got {told(tilt / deg, 1)}°")
    name, size = length_unit(length)
    decimals = 1 if size == mm else 3
    left, whole = _products(turn, n, way / size)
    alt = SEEN.format(
        length=told(length / size, decimals),
        unit=name,
        tilt=told(tilt / deg, 1),
        angle=told(turn / deg, 1),
        real=told(left[0], decimals),
        left=", ".join(told(x, decimals) for x in left[1:]),
        whole=", ".join(told(x, decimals) for x in whole[1:]),
    )
    data: RotationPage = {
        "kind": "rotation",
        "title": "Rotate v by q v q*",
        "summary": alt,
        "alt": alt,
        "meant": _unbroken(MEANT),
        "unit": {"name": name, "size": size, "code": f" * {name}" if size == mm else ""},
        "scene": _scene(n, across, length),
        "controls": [control("θ", "°", 0, 720, 1), control("φ", "°", 0, FARTHEST, 1)],
        "words": {key: _unbroken(text) for key, text in SAYS.items()} | {"seen": SEEN},
        "code": "import numpy as np\nfrom robokin import Quaternion, deg, mm\n\n"
        "q = Quaternion.from_angle_axis({angle} * deg, {axis})\n"
        "v = np.array({v}){unit}\n"
        "q @ v  # q v q*",
        "axis": rounded(n, 12),
        "across": rounded(across, 12),
        "length": length,
        "angles": [turn, tilt],
        "rows": ["q", *(_unbroken(f"{row}, {name}") for row in LENGTHS)],
        "heads": ["", "real part", "x", "y", "z"],
        "decimals": decimals,
    }
    return Explorer(data, _picture(alt, n, way, turn, left[1:] * size))


def _unbroken(text: str) -> str:
    """Return the text without a line break inside a product."""
    return re.sub(r"q v( q\*)?", lambda found: found[0].replace(" ", "\N{NO-BREAK SPACE}"), text)


def _across(n: Floats, v: Floats) -> Floats:
    """Return a unit vector perpendicular to n, in the plane of n and v. If v is parallel to n, it
    is in the plane of n and the coordinate axis that is farthest from n.
    """
    for way in (v, np.eye(3)[abs(n).argmin()]):
        side = way - (way @ n) * n
        size = np.linalg.norm(side)
        if size > 1e-9 * np.linalg.norm(way):
            break
    found: Floats = side / size
    return found


def _products(angle: float, n: Floats, v: Floats) -> tuple[Floats, Floats]:
    """Return the products q v and q v q*, each (4,)."""
    w, (x, y, z) = np.cos(angle / 2), np.sin(angle / 2) * n
    left = hamilton((w, x, y, z), (0.0, *v))
    return np.array(left), np.array(hamilton(left, (w, -x, -y, -z)))


def _scene(n: Floats, across: Floats, length: float) -> PageScene:
    """Return a scene without a floor that has room for a vector of this length in any direction."""
    tilt, turn = np.meshgrid(np.linspace(0, FARTHEST * deg, 5), np.arange(0, 360, 45) * deg)
    tilt, turn = tilt[..., None], turn[..., None]
    ways = np.cos(tilt) * n + np.sin(tilt) * (
        np.cos(turn) * across + np.sin(turn) * np.cross(n, across)
    )
    ball = 1.1 * length * ways.reshape(-1, 3)
    return {
        "size": length,
        "flat": None,
        "grid": length,
        "seen": [rounded(p, 6) for p in ball],
        "floor": [[0.0] * 3] * 2,
        "view": list(VIEW),
        "grows": False,
        "solid": False,
        "bases": None,
        "things": [],
    }


def _picture(alt: str, n: Floats, v: Floats, angle: float, left: Floats) -> plots.Figure:
    """Draw the axis, the circle of the tip, v, the vector part of q v, and q v q*."""
    fig, length = plots.figure(alt, width=6.4, height=4.5), float(np.linalg.norm(v))
    scene = Scene(fig.add_axes((0, 0, 1, 1)), size=length)
    foot, side = (n @ v) * n, np.cross(n, v)

    def circle(turn: Floats) -> Floats:
        points: Floats = foot + np.cos(turn)[:, None] * (v - foot) + np.sin(turn)[:, None] * side
        return points

    half, whole = circle(angle * np.array([0.5, 1]))
    scene.line([-0.3 * length * n, 1.15 * length * n], color=REMARK, linewidth=1.2, ls="--")
    scene.line(circle(np.linspace(0, 2 * np.pi, 90)), color=SOFT, linewidth=1)
    scene.line([half, left], color=SECOND, linewidth=1.2, ls=":")
    for tip, name, color in ((v, "v", INK), (left, "q v", SECOND), (whole, "q v q*", TRACE)):
        scene.line([0 * n, tip], color=color, linewidth=3)
        scene.line([foot, tip if name != "q v" else half], color=color, linewidth=1, ls=":")
        scene.label(name, tip, color, 11)
    scene.label("axis n", 1.15 * length * n, size=11)
    scene.finish()
    return fig
