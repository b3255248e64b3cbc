"""A spatial view with true proportions: arms, frames, paths, a floor with its scale.

`plots` draws postures and frames with it, `player` its still picture.
"""

import numpy as np
from matplotlib.patches import Polygon

from .._validate import instance
from ..transform import Transform
from ..units import deg, mm

AXIS_COLORS = ("#C62828", "#2E7D32", "#1F55C4")  # x, y, z of a triad: red, green, blue
INK, SOFT, FAINT, GRID, TRACE = "#2F3A45", "#87939F", "#C3CAD1", "#DDE2E7", "#0072B2"
VIEW = -60 * deg, 22 * deg  # azimuth and elevation: where the camera of a spatial view stands
# the views straight at the planes x = 0, y = 0 and z = 0
STRAIGHT = (0, 0), (-90 * deg, 0), (-90 * deg, 90 * deg)


def project(points, view=VIEW):
    """Parallel projection of points (..., 3) onto the picture: (..., 2), in metres, to the right
    and up, as it is seen from `view`: azimuth about the base's z axis, counted from its x axis, and
    elevation, in radians.
    """
    (ca, ce), (sa, se) = np.cos(view), np.sin(view)
    return np.asarray(points) @ np.array([[-sa, -se * ca], [ca, -se * sa], [0, ce]])


def arm_points(arm, q):
    """The polyline of the links: base, joint 1, end of link 1, joint 2, ..., flange: q (..., n) ->
    (..., 2n + 1, 3).

    Joint i stands at index 2i + 1 (i from 0); the ends of the links are the origins of
    `arm.frames`.
    """
    frames = arm.frames(q)
    joints = [frames[..., i] @ link.before.translation for i, link in enumerate(arm.links)]
    points = np.empty((*np.shape(q)[:-1], 2 * len(joints) + 1, 3))
    points[..., ::2, :], points[..., 1::2, :] = frames.translation, np.stack(joints, axis=-2)
    return points


def reach(arm):
    """The length of the stretched arm in metres, prismatic joints at their far limit: the scale of
    its pictures.
    """
    fixed = sum(
        np.linalg.norm(link.before.translation) + np.linalg.norm(link.after.translation)
        for link in arm.links
    )
    return float(fixed + abs(arm.limits[arm.prismatic]).max(axis=-1, initial=0).sum())


def is_flat(arm, q):
    """Whether all of these postures lie in the plane z = 0, so that a view from above says more."""
    return bool(np.nanmax(abs(arm_points(arm, q)[..., 2]), initial=0) < 1e-6 * reach(arm))


def named_targets(targets):
    """`targets` as a dict of name -> Transform. A list of one is the target, of two start and goal,
    of three start, via and goal; more are numbered P1, P2, ...
    """
    if isinstance(targets, Transform):
        targets = [targets] if not targets.shape else list(targets)
    if not isinstance(targets, dict):
        targets = list(targets)
        names = {1: ["target"], 2: ["start", "goal"], 3: ["start", "via", "goal"]}.get(
            len(targets), [f"P{i + 1}" for i in range(len(targets))]
        )
        targets = dict(zip(names, targets, strict=True))
    for name, pose in targets.items():
        if instance(pose, Transform, f"target {name}").shape:
            raise ValueError(
                f"target {name}: wanted one single pose, got a batch of shape {pose.shape}"
            )
    return targets


class Scene:
    """A spatial view with true proportions on plain 2-D axes: draw into it, then call `finish()`
    once.

        scene = Scene(fig.add_axes((0, 0, 1, 1)), size=reach(arm))
        scene.arm(arm, q);  scene.trace(points);  scene.triad(pose, "goal");  scene.finish()

    size  metres; what the scene is about, the measure of triads and of the base
    flat  look straight down
    like  where given, the scene of a player's page (`player._scene`): the same view, floor and
          scale
    Matplotlib's own 3-D axes leave wide margins, cut off what stands out and need equal limits
    forced; a parallel projection is one matrix product, and `set_aspect("equal")` keeps the
    proportions.
    """

    def __init__(self, ax, size, flat=False, like=None):
        like = like or {"flat": 2 if flat else None, "view": STRAIGHT[2] if flat else VIEW}
        self.ax, self.size, self.like, self.view, self.flat = (
            ax,
            size,
            like,
            like["view"],
            like["flat"] is not None,
        )
        # the axes of the grid
        self.across = [k for k in range(3) if k != (like["flat"] if self.flat else 2)]
        self.ground = 0.0 if self.flat or "floor" not in like else like["floor"][0][2]
        self.corners = [np.zeros((1, 3))]  # what the floor has to lie under
        self.labels = []  # text, where, colour
        self.drawn = []  # projected lines and their widths, which labels keep off
        ax.set_axis_off()
        ax.set_aspect("equal")

    def project(self, points):
        """Points (..., 3) as they are seen: (..., 2), in metres."""
        return project(points, self.view)

    def line(self, points, corner=True, **style):
        """A polyline through points (..., 3); NaN interrupts it."""
        points = np.asarray(points, dtype=float).reshape(-1, 3)
        flat = self.project(points)
        if corner:
            self.corners.append(points[np.isfinite(points).all(axis=-1)])
        if corner and len(flat) > 1:
            self.drawn.append((flat, style.get("linewidth", 1)))
        return self.ax.plot(
            *flat.T, **{"solid_capstyle": "round", "solid_joinstyle": "round", **style}
        )[0]

    def arm(self, arm, q, strength="last"):
        """One posture q (n,), as "last" (dark, with joints and shadow), "first" (lighter) or
        "between" (faint).
        """
        points = arm_points(arm, q)
        if not np.isfinite(points).all():
            return
        color, width, z = {"last": (INK, 6, 5), "first": (SOFT, 5, 4), "between": (FAINT, 2.5, 2)}[
            strength
        ]
        self.line(points, color=color, linewidth=width, zorder=z)
        if strength == "between":
            return
        if not self.flat:
            self.line(
                points * [1, 1, 0] + [0, 0, self.ground],
                corner=False,
                color="#EDEFF2",
                linewidth=width,
                zorder=0.5,
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

    def base(self):
        """The foot of the arm at the origin."""
        angle = np.linspace(0, 2 * np.pi, 60)
        ring = (
            0.07
            * self.size
            * (
                np.cos(angle)[:, None] * np.eye(3)[self.across[0]]
                + np.sin(angle)[:, None] * np.eye(3)[self.across[1]]
            )
        )
        self.ax.add_patch(
            Polygon(self.project(ring), facecolor="#D5DAE0", edgecolor=SOFT, zorder=1)
        )
        self.corners.append(ring)
        self.drawn.append((self.project(ring), 1))

    def trace(self, points):
        """The path of the tool: points (samples, 3); NaN is a gap."""
        self.line(points, color=TRACE, linewidth=1.6, zorder=6)

    def drop(self, point):
        """A thin line from a point (3,) to the floor, which tells how high it stands."""
        if not self.flat and np.isfinite(point).all():
            self.line(
                [point, point * [1, 1, 0]],
                color=FAINT,
                linewidth=0.9,
                linestyle=(0, (3, 3)),
                zorder=1,
            )

    def triad(self, pose, name=None, length=None, width=1.8, letters=False, color=INK, at=None):
        """The axes of one pose: x red, y green, z blue. `letters` names the axes at their tips; the
        pose's name stands at its origin, or at the tip of axis `at` (0, 1, 2).
        """
        if not np.isfinite(pose.translation).all():
            return
        length = length or 0.1 * self.size
        tips = pose @ (length * np.eye(3))
        for i, (tip, axis_color, letter) in enumerate(zip(tips, AXIS_COLORS, "xyz", strict=True)):
            self.line([pose.translation, tip], color=axis_color, linewidth=width, zorder=7)
            along = self.project(tip - pose.translation)
            if name and i == at:
                self.label(f"{letter} {name}", tip, axis_color)
            elif letters and np.linalg.norm(along) > 0.3 * length:
                self.label(letter, tip, axis_color, 8)
        self.line(
            [pose.translation], linestyle="none", marker="o", markersize=3.5, color=color, zorder=8
        )
        if name and at is None:
            self.label(name, pose.translation, color)

    def label(self, text, point, color=INK, size=9.5):
        """Words beside a point (3,); `finish` finds them a free place."""
        where = self.project(point)
        if not any(
            text == other and np.allclose(where, there, rtol=0, atol=1e-6)
            for other, there, *_ in self.labels
        ):
            self.labels.append((text, where, color, size))

    def finish(self, footnote="", fit=None):
        """Floor, scale, limits and labels. `fit` (width, height) in inches: the figure shrinks to
        what is drawn.
        """
        low, high, step = self._floor()
        unit, name = (1, "m") if self.size > 2 else (mm, "mm")
        self._grid(low, high, step, unit)
        words = (
            f"floor grid {number(step / unit)} {name}"
            if not self.flat
            else f"grid {number(step / unit)} {name}"
        )
        seen = (
            [self.project(self.like["seen"])]
            if "seen" in self.like
            else [line for line, _ in self.drawn]
        )
        seen.append(
            self.project([self._at(x, y) for x in (low[0], high[0]) for y in (low[1], high[1])])
        )
        seen = np.concatenate(seen)
        seen = seen[np.isfinite(seen).all(axis=-1)]
        (x0, y0), (x1, y1) = seen.min(axis=0), seen.max(axis=0)
        self._fit(x0, x1, y0, y1, fit)
        self.ax.text(
            0.012,
            0.012,
            f"{words}; {footnote}" if footnote else words,
            transform=self.ax.transAxes,
            fontsize=9,
            color="#5A6672",
        )
        self._place_labels()

    def _fit(self, x0, x1, y0, y1, fit):
        """Limits that fill the axes with this range (metres), and leave room for words at the edges
        (pixels).
        """
        figure, box = self.ax.figure, self.ax.get_position(original=True)
        side, below, above = 42, 46, 26
        width, height = (
            (fit or figure.get_size_inches()) * np.array([box.width, box.height]) * figure.dpi
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

    def _floor(self):
        """Corners (2,), (2,) of the floor and the step of its grid: under all that is drawn, in
        whole steps.
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

    def _grid(self, low, high, step, unit):
        """The lines of the floor, with coordinates along its two front edges (left and lower ones,
        seen flat).
        """
        count = np.round((high - low) / step).astype(int)
        values = [low[i] + step * np.arange(count[i] + 1) for i in range(2)]
        for x in values[0]:
            self.line(
                [self._at(x, low[1]), self._at(x, high[1])],
                corner=False,
                color=GRID,
                linewidth=0.9,
                zorder=0,
            )
        for y in values[1]:
            self.line(
                [self._at(low[0], y), self._at(high[0], y)],
                corner=False,
                color=GRID,
                linewidth=0.9,
                zorder=0,
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
                    text = number(value / unit) if abs(value) > step / 2 else f"{'xyz'[axis]} = 0"
                    self.ax.text(
                        *self.project(point), f" {text} ", fontsize=8, color="#6B7681", ha=ha, va=va
                    )

    def _at(self, x, y):
        """The point (3,) of the floor with these two coordinates."""
        point = np.array([0.0, 0.0, self.ground])
        point[self.across] = x, y
        return point

    def _place_labels(self):
        """Each label at the free place nearest to its point: off the lines, off other labels,
        inside the picture.
        """
        figure, to_pixels = self.ax.figure, self.ax.transData.transform
        renderer = figure.canvas.get_renderer()
        lines, widths = zip(
            *((dense(to_pixels(line)), width) for line, width in self.drawn), strict=True
        )
        margin = np.repeat(np.array(widths) * 0.8 + 2, [len(line) for line in lines])[:, None]
        lines = np.concatenate(lines)
        frame, taken = self.ax.get_window_extent(renderer), []
        for text, point, color, size in self.labels:
            artist = self.ax.text(
                0, 0, text, fontsize=size, color=color, zorder=9, va="center", ha="center"
            )
            box = artist.get_window_extent(renderer)
            w, h = box.width / 2 + 2, box.height / 2 + 1
            best, least = None, np.inf
            for ring, gap in enumerate((5, 14, 26, 40)):
                for angle in np.arange(0, 360, 30) * deg:
                    c, s = np.cos(angle), np.sin(angle)
                    centre = to_pixels(point) + (gap + np.array([w, h])) * (c, s)
                    inside = (abs(lines - centre) < (w, h) + margin).all(axis=-1).sum()
                    hits = sum(
                        (abs(centre - other) < (w + ow, h + oh)).all() for other, ow, oh in taken
                    )
                    out = (centre - (w, h) < frame.min).any() or (centre + (w, h) > frame.max).any()
                    cost = 5 * inside + 200 * hits + 1000 * out + 6 * ring + (1 - c) + (1 - s)
                    if cost < least:
                        best, least = centre, cost
            artist.set_position(self.ax.transData.inverted().transform(best))
            taken.append((best, w, h))


def number(value, digits=3):
    """A number for people: three significant digits, a real minus sign, no minus zero."""
    value = round(float(value), 9)  # so that noise of the processor cannot decide a tie
    text = f"{value:.{digits}g}"
    if "e+" in text:
        text = f"{value:.0f}"
    return text.replace("-", "\N{MINUS SIGN}") if float(text) else "0"


def dense(line, step=4):
    """Points along a polyline (k, 2), every few pixels."""
    line = line[np.isfinite(line).all(axis=-1)]
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=-1))])
    at = np.linspace(0, along[-1], int(along[-1] / step) + 2)
    return np.stack([np.interp(at, along, line[:, i]) for i in range(2)], axis=-1)
