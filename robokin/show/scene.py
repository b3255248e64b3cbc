"""A spatial view with true proportions: arms, frames, paths, and a floor with its scale.

`plots` uses it for postures and frames, and `player` for its still picture.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .._arrays import ArrayLike, Floats
from ..arms.arm import Arm
from ..transform import Transform
from ..units import deg, length_unit
from . import layers
from .camera import STRAIGHT, VIEW, View, arm_points, project
from .drawing import DRAWS, Axes, Circle, Line2D, Polygon
from .palette import (
    AXIS_COLORS,
    FAINT,
    FOOT,
    GRID,
    INK,
    REMARK,
    SCALE,
    SHADOW,
    SOFT,
    TRACE,
)

FAR, DOTS = 1e4, 200_000  # maximum distance from the origin in px; maximum number of points


class Scene:
    """A spatial view with true proportions on ordinary 2-D axes: draw into it, then call `finish()`
    once.

        scene = Scene(fig.add_axes((0, 0, 1, 1)), size=extent(arm))
        scene.arm(arm, q);  scene.trace(points);  scene.triad(pose, "goal");  scene.finish()

    size  metres; the size of the subject, which scales triads and the base
    flat  whether to look straight down
    like  optional: the scene of a player's page (`camera.scene_data`), whose view, floor and scale
          are used
    Matplotlib's own 3-D axes leave wide margins, cut off whatever extends beyond them, and do not
    keep equal scales by themselves. A parallel projection is one matrix product, and
    `set_aspect("equal")` keeps the proportions.
    """

    def __init__(
        self,
        ax: Axes,
        size: float,
        flat: bool = False,
        like: Mapping[str, Any] | None = None,
    ) -> None:
        like = like or {"flat": 2 if flat else None, "view": STRAIGHT[2] if flat else VIEW}
        self.ax, self.size, self.like = ax, size, like
        self.view: View = like["view"]
        self.flat = like["flat"] is not None
        # the coordinate axes along the grid
        self.across = [k for k in range(3) if k != (like["flat"] if self.flat else 2)]
        self.ground = 0.0 if self.flat or "floor" not in like else like["floor"][0][2]
        # points below which the floor must extend
        self.corners: list[Floats] = [np.zeros((1, 3))]
        # for each label: its text, place, colour and size, and the direction in which it is
        self.labels: list[tuple[str, Floats, str, float, Floats]] = []
        # centre and half the size, in pixels, of each placed label, in the order of `labels`
        self.boxes: list[tuple[Floats, Floats]] = []
        # projected lines and their widths, which labels avoid
        self.drawn: list[tuple[Floats, float]] = []
        ax.set_axis_off()
        ax.set_aspect("equal")

    def project(self, points: ArrayLike) -> Floats:
        """Project points (..., 3) to picture coordinates (..., 2) in metres."""
        return project(points, self.view)

    def line(self, points: Any, corner: bool = True, **style: Any) -> Line2D:
        """Draw a polyline through points (..., 3); NaN interrupts it."""
        points = np.asarray(points, dtype=float).reshape(-1, 3)
        flat = self.project(points)
        if corner:
            self.corners.append(points[np.isfinite(points).all(axis=-1)])
        if corner and len(flat) > 1:
            self.drawn.append((flat, style.get("linewidth", 1)))
        return self.ax.plot(
            *flat.T, **{"solid_capstyle": "round", "solid_joinstyle": "round", **style}
        )[0]

    def arm(self, arm: Arm, q: Floats, strength: str = "last", base: Floats | float = 0.0) -> None:
        """Draw an arm at `base` (3,) in one posture q (n,), as "last" (dark, with joints and
        shadow), "first" (lighter) or "between" (faint).
        """
        points = arm_points(arm, q) + base
        if not np.isfinite(points).all():
            return
        color, width, z = {
            "last": (INK, 6, layers.LAST),
            "first": (SOFT, 5, layers.FIRST),
            "between": (FAINT, 2.5, layers.BETWEEN),
        }[strength]
        self.line(points, color=color, linewidth=width, zorder=z)
        if strength == "between":
            return
        if not self.flat:
            self.line(
                points * [1, 1, 0] + [0, 0, self.ground],
                corner=False,
                color=SHADOW,
                linewidth=width,
                zorder=layers.SHADOW,
            )
        self.line(
            points[1::2],
            linestyle="none",
            marker="o",
            markersize=width + 3,
            markerfacecolor="white",
            markeredgecolor=color,
            markeredgewidth=1.8,
            zorder=z + 0.1,
        )

    def base(self, at: Floats | float = 0.0) -> None:
        """Draw the base of the arm, at the origin or at a point (3,)."""
        angle = np.linspace(0, 2 * np.pi, 60)
        ring = (
            0.07
            * self.size
            * (
                np.cos(angle)[:, None] * np.eye(3)[self.across[0]]
                + np.sin(angle)[:, None] * np.eye(3)[self.across[1]]
            )
        ) + at
        self.ax.add_patch(
            Polygon(self.project(ring), facecolor=FOOT, edgecolor=SOFT, zorder=layers.BASE)
        )
        self.corners.append(ring)
        self.drawn.append((self.project(ring), 1))

    def trace(self, points: Floats) -> None:
        """Draw the path of the tool: points (samples, 3); NaN leaves a gap."""
        self.line(points, color=TRACE, linewidth=1.6, zorder=layers.PATH)

    def drop(self, point: Floats) -> None:
        """Draw a thin line from a point (3,) to the floor, which shows its height."""
        if not self.flat and np.isfinite(point).all():
            self.line(
                [point, point * [1, 1, 0]],
                color=FAINT,
                linewidth=0.9,
                linestyle=(0, (3, 3)),
                zorder=layers.BASE,
            )

    def triad(
        self,
        pose: Transform,
        name: str | None = None,
        length: float | None = None,
        width: float = 1.8,
        letters: bool = False,
        color: str = INK,
        at: int | None = None,
    ) -> None:
        """Draw the axes of one pose: x red, y green, z blue. `letters` names the axes at their
        tips. The pose's name is at its origin, or at the tip of axis `at` (0, 1, 2).
        """
        if not np.isfinite(pose.translation).all():
            return
        length = length or 0.1 * self.size
        tips = pose @ (length * np.eye(3))
        for i, (tip, axis_color, letter) in enumerate(zip(tips, AXIS_COLORS, "xyz", strict=True)):
            self.line(
                [pose.translation, tip], color=axis_color, linewidth=width, zorder=layers.FRAMES
            )
            along = self.project(tip - pose.translation)
            if name and i == at:
                self.label(f"{letter} {name}", tip, axis_color)
            elif letters and np.linalg.norm(along) > 0.3 * length:
                self.label(letter, tip, axis_color, 8, along)
        self.line(
            [pose.translation],
            linestyle="none",
            marker="o",
            markersize=3.5,
            color=color,
            zorder=layers.ORIGINS,
        )
        if name and at is None:
            self.label(name, pose.translation, color)

    def ball(self, centre: Floats, radius: float) -> None:
        """Draw a ball, or a disc in a flat view."""
        self.corners.append(centre[None])
        x, y = self.project(centre)
        self.ax.add_patch(Circle((x, y), radius, color=SOFT, alpha=0.45, lw=0, zorder=layers.BASE))

    def mark(self, centre: Floats, radius: float) -> None:
        """Draw a point (3,), or a ball if the radius is not 0; draw nothing if the point is NaN."""
        if not np.isfinite(centre).all():
            return
        if radius:
            self.ball(centre, radius)
        else:
            self.line(
                [centre],
                linestyle="none",
                marker="o",
                color=SOFT,
                markersize=5,
                zorder=layers.POINTS,
            )

    def faces(self, polygons: Sequence[Floats], **style: Any) -> None:
        """Draw polygons (k, 3) behind the arms, the farthest first."""
        style = {"facecolor": FOOT, "edgecolor": SOFT, "lw": 0.8, "zorder": layers.FACES, **style}
        (ca, ce), (sa, se) = np.cos(self.view), np.sin(self.view)
        for corners in sorted(
            polygons, key=lambda face: face.mean(axis=0) @ [ce * ca, ce * sa, se]
        ):
            self.corners.append(corners)
            self.ax.add_patch(Polygon(self.project(corners), **style))

    def label(
        self,
        words: str,
        point: Floats,
        color: str = INK,
        size: float = 9.5,
        away: ArrayLike = (0, 0),
    ) -> None:
        """Add text next to a point (3,), in the half plane `away` (2,) from it; `place_labels`
        finds a free place for it.
        """
        where = self.project(point)
        if not any(
            words == other and np.allclose(where, there, rtol=0, atol=1e-6)
            for other, there, *_ in self.labels
        ):
            self.labels.append((words, where, color, size, np.asarray(away)))

    def finish(self, footnote: str = "", fit: tuple[float, float] | None = None) -> None:
        """Draw floor, scale and labels, and set the limits. With `fit`, a (width, height) in
        inches, the figure shrinks to its content.
        """
        if not DRAWS:
            return
        low, high, step = self._floor()
        name, unit = length_unit(self.size)
        self._grid(low, high, step, unit)
        words = (
            f"floor grid {number(step / unit)} {name}"
            if not self.flat
            else f"grid {number(step / unit)} {name}"
        )
        lines = (
            [self.project(self.like["seen"])]
            if "seen" in self.like
            else [line for line, _ in self.drawn]
        )
        corners = [self._at(x, y) for x in (low[0], high[0]) for y in (low[1], high[1])]
        seen = np.concatenate([*lines, self.project(corners)])
        seen = seen[np.all(np.isfinite(seen), axis=-1)]
        (x0, y0), (x1, y1) = seen.min(axis=0), seen.max(axis=0)
        self._fit(x0, x1, y0, y1, fit)
        self.ax.text(
            0.012,
            0.012,
            f"{words}; {footnote}" if footnote else words,
            transform=self.ax.transAxes,
            fontsize=9,
            color=REMARK,
        )
        self.place_labels()

    def place_labels(self) -> None:
        """Put each label that has no place yet at the free place nearest to its point: away from
        lines and other labels, and inside the picture. `finish` calls this method; a film calls it
        for each frame.
        """
        new = self.labels[len(self.boxes) :]
        if not new:
            return
        canvas: Any = self.ax.figure.canvas
        to_data: Any = self.ax.transData.inverted()
        to_pixels, renderer = self.ax.transData.transform, canvas.get_renderer()
        dots = [dense(to_pixels(line)) for line, _ in self.drawn]
        widths = np.array([width for _, width in self.drawn])
        margin = np.repeat(widths * 0.8 + 2, [len(line) for line in dots])[:, None]
        lines = np.concatenate(dots)
        frame = self.ax.get_window_extent(renderer)
        # The candidate places: twelve directions from the point, at four distances, in pixels.
        angle = np.tile(np.arange(0, 360, 30) * deg, 4)
        way = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        ring = np.repeat(np.arange(4), 12)
        gap = np.array([5, 14, 26, 40])[ring, None]
        for words, point, color, size, away in new:
            taken, sizes = np.reshape([*self.boxes], (-1, 2, 2)).swapaxes(0, 1)
            artist = self.ax.text(
                0,
                0,
                words,
                fontsize=size,
                color=color,
                zorder=layers.LABELS,
                va="center",
                ha="center",
                parse_math=False,
            )
            box = artist.get_window_extent(renderer)
            half = np.array([box.width / 2 + 2, box.height / 2 + 1])
            here = to_pixels(point)
            places = here + (gap + half) * way
            near = np.all(abs(lines - here) < 2 * half + gap.max() + margin, axis=-1)
            inside, hits = (
                np.all(abs(places[:, None] - others) < half + room, axis=-1).sum(axis=-1)
                for others, room in ((lines[near], margin[near]), (taken, sizes))
            )
            out = np.any((places - half < frame.min) | (places + half > frame.max), axis=-1)
            cost = 5 * inside + 200 * hits + 1000 * out + 6 * ring + (1 - way[:, 0])
            cost += 50 * (way @ away < 0.3 * np.linalg.norm(away))
            # a letter nearer to the axis of another frame would name that one
            for axis in [np.array(x.get_xydata()) for x in self.ax.lines if x.get_color() == color]:
                if away.any() and np.any(axis[-1] != point):
                    off = np.linalg.norm(places[:, None] - dense(to_pixels(axis)), axis=-1)
                    cost += 50 * (off.min(axis=-1) < np.linalg.norm(places - here, axis=-1))
            best = places[(cost + (1 - way[:, 1])).argmin()]
            artist.set_position(to_data.transform(best))
            self.boxes.append((best, half))

    def _fit(
        self, x0: float, x1: float, y0: float, y1: float, fit: tuple[float, float] | None
    ) -> None:
        """Set limits that fill the axes with this range (metres) and leave room for text at the
        edges (pixels).
        """
        figure: Any = self.ax.figure
        box = self.ax.get_position(original=True)
        side, below, above = 46, 46, 26
        width, height = (
            np.array(fit or figure.get_size_inches()) * [box.width, box.height] * figure.dpi
        )
        # pixels per metre
        scale = min((width - 2 * side) / (x1 - x0), (height - below - above) / (y1 - y0))
        if fit:
            width, height = (
                max(scale * (x1 - x0) + 2 * side, 0.6 * width),
                scale * (y1 - y0) + below + above,
            )
            figure.set_size_inches(width / box.width / figure.dpi, height / box.height / figure.dpi)
        middle, spare = (x0 + x1) / 2, (height - below - above) / scale - (y1 - y0)
        self.ax.set_xlim(middle - width / scale / 2, middle + width / scale / 2)
        self.ax.set_ylim(y0 - spare / 2 - below / scale, y1 + spare / 2 + above / scale)

    def _floor(self) -> tuple[Floats, Floats, float]:
        """Return two opposite corners (2,) of the floor, and the step of its grid. The floor is
        below everything drawn and a whole number of steps wide.
        """
        if "floor" in self.like:
            return *np.array(self.like["floor"])[:, self.across], self.like["grid"]
        points = np.concatenate(self.corners)[:, self.across]
        low, high = points.min(axis=0), points.max(axis=0)
        rough = max(*(high - low), self.size / 3) / 8
        step = next(
            s
            for s in 10.0 ** np.floor(np.log10(rough)) * np.array([1, 2, 5, 10])
            if s >= rough * 0.999
        )
        low, high = np.floor(low / step - 0.05), np.ceil(high / step + 0.05)
        return low * step, high * step, step

    def _grid(self, low: Floats, high: Floats, step: float, unit: float) -> None:
        """Draw the lines of the floor, with coordinates along its two front edges (the left and
        lower ones in a flat view).
        """
        count = np.round((high - low) / step).astype(int)
        values = [low[i] + step * np.arange(count[i] + 1) for i in range(2)]
        for x in values[0]:
            self.line(
                [self._at(x, low[1]), self._at(x, high[1])],
                corner=False,
                color=GRID,
                linewidth=0.9,
                zorder=layers.FLOOR,
            )
        for y in values[1]:
            self.line(
                [self._at(low[0], y), self._at(high[0], y)],
                corner=False,
                color=GRID,
                linewidth=0.9,
                zorder=layers.FLOOR,
            )
        c, s = np.cos(self.view[0]), np.sin(self.view[0])  # the horizontal direction to the camera
        x_edge = low[0] if self.flat or c < 0 else high[0]
        y_edge = low[1] if self.flat or s < 0 else high[1]
        sides = (
            (
                [self._at(x, y_edge) for x in values[0]],
                values[0],
                self.across[0],
                "center" if self.flat else "left" if c * s > 0 else "right",
                "top",
            ),
            (
                [self._at(x_edge, y) for y in values[1]],
                values[1],
                self.across[1],
                "right" if self.flat or c * s > 0 else "left",
                "bottom" if self.flat else "top",
            ),
        )
        for points, numbers, axis, ha, va in sides:
            every = 1 if len(numbers) <= 4 else 2
            for point, value in zip(points, numbers, strict=True):
                if round(value / step) % every == 0:
                    words = number(value / unit) if abs(value) > step / 2 else f"{'xyz'[axis]} = 0"
                    x, y = self.project(point)
                    self.ax.text(x, y, f" {words} ", fontsize=9, color=SCALE, ha=ha, va=va)

    def _at(self, x: float, y: float) -> Floats:
        """Return the point (3,) on the floor that has these two coordinates."""
        point = np.array([0.0, 0.0, self.ground])
        point[self.across] = x, y
        return point


def number(value: float, digits: int = 3) -> str:
    """Format a number for readers, with `digits` significant digits, a real minus sign and no
    negative zero.
    """
    value = round(float(value), 9)  # so that rounding errors cannot decide a tie
    text = f"{value:.{digits}g}"
    if "e+" in text:
        text = f"{value:.0f}"
    return text.replace("-", "\N{MINUS SIGN}") if float(text) else "0"


def dense(line: Floats, step: float = 4) -> Floats:
    """Return points along a polyline (k, 2) every `step` pixels, except far outside a picture."""
    line = np.clip(line[np.all(np.isfinite(line), axis=-1)], -FAR, FAR)
    if not len(line):
        return line
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=-1))])
    at = np.linspace(0, along[-1], min(int(along[-1] / step) + 2, DOTS))
    return np.stack([np.interp(at, along, line[:, i]) for i in range(2)], axis=-1)
