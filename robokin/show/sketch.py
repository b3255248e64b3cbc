"""Labelled sketches of a plane, as a lecturer would draw them: links, angles, lengths, points.

sketch = Sketch("Two levers and the angle between them.", title="q2 bends the elbow")
sketch.levers([(0, 0), (0.3, 0.2), (0.5, 0.1)], ["O", "A", "K"])
sketch.angle((0.3, 0.2), 0, np.pi / 2, "q2")
sketch
"""

from collections.abc import Sequence

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import choice, floats, positive
from ..units import mm
from .checks import in_sight, plain, several
from .palette import INK, JOINT_STYLES, PAPER, REMARK
from .plots import Figure, figure

UNITS = {"mm": mm, "m": 1.0}
NAMED = 11  # the distance between a joint and its name, in typographic points


class Sketch(Figure):
    """A figure of a plane with true proportions, to draw on. Points are (x, y) in metres, angles
    are in radians from the x axis, counter-clockwise; texts may contain formulas between dollar
    signs.

    alt    what a sighted reader concludes
    title  what the picture shows
    unit   the unit of the axes: "mm" or "m"
    x, y   the labels of the axes, without the unit
    """

    def __init__(
        self,
        alt: str,
        *,
        title: str = "",
        unit: str = "mm",
        x: str = "x",
        y: str = "y",
        width: float = 9,
        height: float = 4.6,
    ) -> None:
        self._unit = UNITS[choice(unit, "unit", tuple(UNITS))]
        blank = figure(alt, width, height)  # checks `alt` and the size of the figure
        super().__init__(blank.alt, figsize=blank.get_size_inches(), layout="constrained")
        self.ax = self.subplots()
        self.ax.set(
            aspect="equal", xlabel=f"{plain(x, 'x')}, {unit}", ylabel=f"{plain(y, 'y')}, {unit}"
        )
        self.ax.margins(0.12)
        self.ax.set_title(plain(title, "title"))

    def levers(self, points: ArrayLike, names: Sequence[str] = (), *, dashed: bool = False) -> None:
        """Draw links between consecutive points (k, 2) in the joints' colours, and the names of the
        points. `dashed` is for another posture of the same arm.
        """
        corners = self._at(points, "points", 2)
        for k, (a, b) in enumerate(zip(corners[:-1], corners[1:], strict=True)):
            color = JOINT_STYLES[k % len(JOINT_STYLES)]["color"]
            line = (0, (2, 1)) if dashed else "-"
            self.ax.plot(*np.transpose([a, b]), color=color, lw=3 if dashed else 5, ls=line)
        self.ax.plot(*corners.T, "o", color=PAPER, mec=INK, ms=8, mew=1.4, zorder=3)
        middle = corners.mean(axis=0)
        for corner, name in zip(
            corners, several(names, "names", "a list of strings"), strict=False
        ):
            self._text(corner, name, corner - middle)

    def point(self, place: ArrayLike, name: str = "", *, away: ArrayLike = (0, -1)) -> None:
        """Draw a point, with its name on the side `away`."""
        [at] = self._at(place, "place", 1)
        self.ax.plot(*at, "o", color=INK, ms=6, zorder=3)
        self._text(at, name, self._at(away, "away", 1)[0])

    def length(
        self, start: ArrayLike, end: ArrayLike, name: str = "", *, right: bool = False
    ) -> None:
        """Draw a thin line between two points, with its name at the middle. Seen from `start`, the
        name is to the left of the line or, with `right`, to its right.
        """
        [a], [b] = self._at(start, "start", 1), self._at(end, "end", 1)
        self.ax.plot(*np.transpose([a, b]), color=REMARK, lw=1.1, ls="--", zorder=1)
        self._text((a + b) / 2, name, (-1 if right else 1) * np.array([a[1] - b[1], b[0] - a[0]]))

    def angle(
        self, centre: ArrayLike, start: float, end: float, name: str = "", *, radius: float = 0.05
    ) -> None:
        """Draw an arc around a point from the direction `start` to `end`, with an arrow at its end.
        The name is outside the middle of the arc. A thin line shows the direction of the arc's
        start.
        """
        first, last = floats([start, end], "start and end", 2)
        [at] = self._at(centre, "centre", 1)
        size = positive(radius, "radius", "a length in metres")
        r = float(in_sight(np.array(size), "radius")) / self._unit
        turns = np.linspace(first, last, 181)
        arc = at + r * np.stack([np.cos(turns), np.sin(turns)], axis=-1)
        self.ax.plot(*np.transpose([at, at + 1.35 * (arc[0] - at)]), color=REMARK, lw=0.9, zorder=1)
        self.ax.plot(*arc.T, color=INK, lw=1.3)
        self.ax.annotate(
            "",
            (arc[-1, 0], arc[-1, 1]),
            (arc[-4, 0], arc[-4, 1]),  # so close that only the arrowhead shows
            arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 1.3, "shrinkA": 0, "shrinkB": 0},
        )
        self._text(arc[90], name, arc[90] - at)

    def _at(self, points: ArrayLike, name: str, least: int) -> Floats:
        values = np.atleast_2d(floats(points, name, 2))
        if values.ndim != 2 or len(values) < least or (least == 1 and len(values) > 1):
            wanted = "one point" if least == 1 else f"{least} or more points"
            raise ValueError(f"{name}: wanted {wanted} (x, y), got shape {values.shape}")
        return in_sight(values, name) / self._unit

    def _text(self, place: Floats, text: str, away: Floats) -> None:
        size = np.linalg.norm(away)
        x, y = NAMED * (away / size if size else np.array([0, 1]))
        self.ax.annotate(
            plain(text, "name"),
            (place[0], place[1]),
            (x, y),
            textcoords="offset points",
            ha="center" if abs(x) < 4 else "left" if x > 0 else "right",
            va="center" if abs(y) < 4 else "bottom" if y > 0 else "top",
            color=INK,
            fontsize=12,
            zorder=4,
            bbox={"facecolor": PAPER, "edgecolor": "none", "pad": 0},  # no line goes through it
        )
