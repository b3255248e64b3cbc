"""Matplotlib figures of arrays: joint curves, postures of an arm, frames.

A figure is a value: end a cell with it, or call `fig.savefig(...)`. This module does not use
pyplot, so no figure is drawn twice or kept in memory. Figures show degrees and millimetres (metres
for arms larger than 2 m).
"""

import io
import textwrap
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import instance, length, positive, short, warn_if_degrees
from ..arms.arm import Arm
from ..transform import Transform
from ..units import length_unit, mm
from . import layers
from .arguments import Targets, named_targets
from .camera import arm_points, extent, flange, is_flat
from .checks import if_given, in_sight, plain, samples, sentence, several
from .drawing import DRAWS, STORED, Axes, FigureCanvasAgg, Image, Text, cycler, rc_context, require
from .drawing import Figure as PlainFigure
from .markup import figure_image
from .palette import COMPARED, FAINT, INK, JOINT_STYLES, PAPER, SCALE, SOFT, TITLE
from .scene import Scene, number

__all__ = [
    "JOINT_STYLES",
    "Figure",
    "figure",
    "palette_png",
    "plot_frames",
    "plot_postures",
]

DPI = 100
SMALLEST = 10 * 72 / DPI  # points: text of 10 pixels, which is still readable
INCHES = "a positive number of inches"
STYLE: dict[Any, Any] = {  # the style of a plot, apart from its title
    "axes.prop_cycle": cycler(color=[color for color, _ in COMPARED]),
    "axes.edgecolor": SOFT,
    "axes.labelcolor": INK,
    "xtick.color": SOFT,
    "ytick.color": SOFT,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
}


class Plot(Axes):
    """A plot with a left-aligned title, in the style of all titles."""

    def set_title(self, label: str, *args: Any, **keywords: Any) -> Text:
        """Write the title, in as many lines as it needs. The font is smaller if there are several
        plots in a row.
        """
        place, whole = self.get_subplotspec(), self.get_figure(root=True)
        columns = place.get_gridspec().ncols if place else 1
        size = keywords.get("fontsize", 12 if columns == 1 else 10.5)
        width = whole.get_figwidth() / columns - 0.6 if whole else 1.0
        look = {"loc": "left", "fontsize": size, **TITLE, **keywords}
        return super().set_title(wrapped(label, width, size), *args, **look)

    def get_title(self, loc: Any = "left") -> str:
        return super().get_title(loc)


def wrapped(words: str, width: float, size: float) -> str:
    """Break words into lines that fit into a width in inches, as a title of a size in points."""
    most = max(int(width * 9.5 * 12 / size), 1)
    return "\n".join(textwrap.fill(line, most) for line in words.split("\n"))


class Figure(PlainFigure):
    """A Matplotlib figure that has alt text and displays itself in a notebook."""

    def __init__(self, alt: str, **keywords: Any) -> None:
        super().__init__(dpi=DPI, facecolor=PAPER, **keywords)
        FigureCanvasAgg(self)
        self.alt = alt

    def add_subplot(self, *place: Any, **keywords: Any) -> Any:
        """Return a new plot in the style of all figures. `subplots` also makes its plots with this
        method.
        """
        if "projection" not in keywords:
            keywords = {"axes_class": Plot} | keywords
        with rc_context(STYLE):
            plot = super().add_subplot(*place, **keywords)
        plot.set_anchor("W")  # a plot with true proportions is at the left, below its title
        return plot

    def suptitle(self, t: str, **keywords: Any) -> Text:
        """Write the title at the top left, in as many lines as it needs."""
        words = wrapped(t, self.get_figwidth(), 12)
        look = {"x": 0.014, "ha": "left", "fontsize": 12, **TITLE, **keywords}
        return super().suptitle(words, **look)

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        if not DRAWS:
            return {"text/plain": self.alt, "application/x-robokin-figure": STORED}
        # JupyterLab 4.6 and the "lab" template of nbconvert 7.17 both ignore {"alt": ...} in the
        # metadata of an image/png output. Both keep <img alt> in text/html, even in an untrusted
        # notebook, and show it once.
        width, height = np.round(self.get_size_inches() * DPI).astype(int)
        written: list[Any] = self.findobj(_is_written)
        smallest = min((text.get_fontsize() for text in written), default=SMALLEST)
        least = min(width, int(np.ceil(width * SMALLEST / smallest)))
        spatial = bool(self.axes) and not any(ax.axison for ax in self.axes)  # see `Scene`
        image = figure_image(palette_png(self), self.alt, width, height, least, spatial)
        return {"text/html": image, "text/plain": self.alt}

    def __repr__(self) -> str:
        return self.alt


def _is_written(artist: Any) -> bool:
    return isinstance(artist, Text) and artist.get_visible() and bool(artist.get_text().strip())


def figure(alt: str, width: float = 9, height: float = 4) -> Figure:
    """Return an empty figure of width x height inches (100 pixels each): use `ax = fig.subplots()`,
    and end the cell with `fig`.

    `alt` says in words what a sighted reader concludes. It is the alternative text of the image,
    which tests compare. Raises ValueError if `alt` contains no words, or if a size is not positive
    or is above 100.
    """
    if not (isinstance(alt, str) and alt.strip()):
        raise ValueError(f"alt: wanted text that says what the figure shows, got {short(alt)}")
    sizes = [positive(width, "width", INCHES), positive(height, "height", INCHES)]
    if max(sizes) > 100:
        raise ValueError(f"width and height: wanted at most 100 inches, got {max(sizes):g}")
    return Figure(plain(alt, "alt"), figsize=sizes)


def palette_png(fig: PlainFigure) -> bytes:
    """Return the figure as a PNG with a palette, which is a third of the size of a PNG without one.

    Pillow's octree keeps the colours of thin lines to within 1/100; its median cut turns the green
    of a triad blue.
    """
    require()
    canvas: Any = fig.canvas
    canvas.draw()
    image = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
    file = io.BytesIO()
    image.quantize(128, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(
        file, "PNG", optimize=True
    )
    return file.getvalue()


def plot_postures(
    arm: Arm,
    q: ArrayLike,
    *,
    targets: Targets = (),
    title: str | None = None,
    alt: str | None = None,
) -> Figure:
    """Plot postures along one path, in a spatial view with true proportions.

    q        (samples, n): the whole path, in as many samples as are known. The tool's path is drawn
             through all samples, the first and last posture boldly, and up to seven postures
             between them faintly. NaN rows are left out. If the flange does not move (as in the
             rows of `ik`), more than two postures, up to nine, are drawn in the same style.
    targets  a list of Transforms (one: target; two: start, goal; three: start, via, goal), or a
             dict that maps names to Transforms
    alt      the alternative text, if the numbers alone do not say enough
    """
    q, targets = samples(arm, q), named_targets(targets)
    turning = q[..., ~arm.prismatic]
    warn_if_degrees(turning if len(q) > 1 else turning[0], "q", posture=1)
    title, alt = if_given(title, "title"), if_given(alt, "alt")
    exists = np.flatnonzero(np.all(np.isfinite(q), axis=-1))
    if not len(exists):
        raise ValueError("q: wanted at least one posture, got only NaN rows")
    size, tool = extent(arm), flange(arm, q)
    fig = Figure(alt or _postures_alt(arm, tool[exists], len(exists), title, targets, size))
    scene = Scene(_canvas(fig, title), size, flat=is_flat(arm, q))
    scene.base()
    first, last = exists[0], exists[-1]
    moves = _moves(tool[exists])
    for i in np.unique(np.linspace(0, len(exists) - 1, 9).round().astype(int))[:-1]:
        scene.arm(arm, q[exists[i]], "between" if moves and i else "first")
    if moves:
        scene.trace(tool.translation)
        scene.triad(tool[first], length=0.07 * size, width=2.4)
    # The names "first" and "last" are where the two postures differ most, on the half of the arm
    # next to the base, since the tool has labels of its own; or beyond, if only the rest moves.
    ends = arm_points(arm, q[[first, last]])
    apart = np.linalg.norm(ends[1] - ends[0], axis=-1)
    half = apart[: len(arm.links) + 1]
    where = (half if half.max() > 1e-3 * size else apart).argmax()
    scene.arm(arm, q[last], "last" if moves or len(exists) <= 2 else "first")
    scene.triad(tool[last], length=0.07 * size, width=3.2, letters=True)
    if (moves or len(exists) == 2) and apart[where] > 1e-3 * size:
        scene.label("first", ends[0, where], SOFT)
        scene.label("last", ends[1, where])
    for name, pose in targets.items():
        scene.triad(pose, name, width=1.4)
    scene.finish(fit=(9, 6.2))
    return fig


def plot_frames(
    frames: Transform | Iterable[Transform],
    *,
    names: Sequence[str] | None = None,
    title: str | None = None,
    size: float | None = None,
    chain: bool = False,
    alt: str | None = None,
) -> Figure:
    """Plot frames as triads (x red, y green, z blue) with names, together with the base frame, in
    true proportions.

    frames  Transform of shape (k,) or (), or a list of single Transforms, in base coordinates; NaN
            frames are left out
    names   one for each frame; a frame at the base replaces the triad of the base
    size    the length of the axes in metres; by default, it depends on the distances
    chain   whether to join the origins in order, starting at the base, like the links of an arm
    """
    frames = _frames(frames)
    title, alt = if_given(title, "title"), if_given(alt, "alt")
    origins = in_sight(np.stack([frame.translation for frame in frames]), "frames")
    if names is None:
        names = [""] * len(frames)
    if not isinstance(names, (list, tuple)) or len(names) != len(frames):
        raise ValueError(
            f"names: wanted {len(frames)} names, one for each frame, got {short(names)}"
        )
    names = [plain(name, "names") for name in names]
    extent = np.nanmax(np.linalg.norm(origins, axis=-1), initial=0)
    if size is None:
        size = 0.22 * extent if extent > 0 else 0.1
    size = float(in_sight(np.array(length(size, "size")), "size"))
    unit_name, unit = length_unit(extent)
    fig = Figure(alt or _frames_alt(frames, names, title, unit, unit_name))
    scene = Scene(_canvas(fig, title), max(extent, 2 * size))
    at_base = [np.allclose(frame.as_matrix(), np.eye(4), atol=1e-9) for frame in frames]
    if not any(at_base):
        scene.triad(Transform(), "base", length=size, color=SCALE)
    if chain:
        scene.line(
            np.concatenate([np.zeros((1, 3)), origins]),
            color=FAINT,
            linewidth=4,
            zorder=layers.BETWEEN,
        )
    for i, (frame, name) in enumerate(zip(frames, names, strict=True)):
        scene.drop(frame.translation)
        scene.triad(frame, name, length=size, width=2.6, letters=True, at=_naming_axis(frames, i))
    scene.finish(fit=(9, 5.6))
    return fig


def _canvas(fig: Figure, title: str | None) -> Axes:
    """Return axes that fill the figure below the title."""
    fig.set_size_inches(9, 6)
    if title:
        fig.suptitle(title, y=0.985, parse_math=False)
    return fig.add_axes((0, 0, 1, 0.93 if title else 1))


def _frames(frames: Transform | Iterable[Transform]) -> list[Transform]:
    """Return a list of single Transforms."""
    if isinstance(frames, Transform):
        frames = list(frames) if frames.shape else [frames]
    frames = several(frames, "frames", "Transforms", error=TypeError)
    for frame in frames:
        if instance(frame, Transform, "frames").shape:
            raise ValueError(
                f"frames: wanted a Transform of shape (k,) or a list of single ones, got {frame}"
            )
    if not frames:
        raise ValueError("frames: wanted at least one, got none")
    return frames


def _naming_axis(frames: Sequence[Transform], i: int) -> int | None:
    """Return the axis (0, 1, 2) at whose tip the name of frame i is written, or None for its
    origin. If frames have a common origin, their names are at the tips of the axis whose tips are
    farthest apart.
    """
    here = [
        f for f in frames if np.allclose(f.translation, frames[i].translation, rtol=0, atol=1e-6)
    ]
    axes = np.stack([frame.rotation.as_matrix() for frame in here])
    apart = np.linalg.norm(axes[:, None] - axes[None], axis=-2)[np.triu_indices(len(here), 1)]
    return int(apart.min(axis=0).argmax()) if len(here) > 1 else None


def _postures_alt(
    arm: Arm,
    tool: Transform,
    count: int,
    title: str | None,
    targets: dict[str, Transform],
    size: float,
) -> str:
    name, unit = length_unit(size)
    words = sentence(title)
    start, end = (_place(tool.translation[i], unit) for i in (0, -1))
    if _moves(tool):
        words.append(f"{arm.name} along a path. The flange moves from {start} to {end} {name}.")
    else:
        postures = "one posture" if count == 1 else f"{count} postures"
        words.append(f"{arm.name} in {postures}, the flange at {start} {name}.")
    if targets:
        words.append(f"Marked: {', '.join(targets)}.")
    return " ".join(words)


def _moves(tool: Transform) -> bool:
    """Return whether the poses (k,) differ."""
    return bool(abs(tool.as_matrix() - tool[0].as_matrix()).max() > 1e-6)


def _frames_alt(
    frames: Sequence[Transform],
    names: Sequence[str],
    title: str | None,
    unit: float,
    unit_name: str,
) -> str:
    words = sentence(title)
    parts = [
        f"{name or f'frame {i + 1}'} at {_place(frame.translation, unit)} {unit_name}"
        for i, (frame, name) in enumerate(zip(frames, names, strict=True))
    ]
    return " ".join([*words, f"Frames in base coordinates: {', '.join(parts)}."])


def _place(point: Floats, unit: float) -> str:
    return f"({', '.join(number(np.round(x / unit, 0 if unit == mm else 2), 4) for x in point)})"
