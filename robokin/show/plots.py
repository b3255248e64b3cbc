"""Arrays in, Matplotlib figures out: joint curves, postures of an arm, frames.

A figure is a value: the last line of a cell, or `fig.savefig(...)`. Nothing here touches pyplot, so
no figure is drawn twice and none is kept alive. Degrees and millimetres outside (metres for what is
larger than 2 m).
"""

import base64
import html
import io
import textwrap

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure as MatplotlibFigure
from PIL import Image

from .._validate import floats, instance
from ..arms.arm import Arm
from ..transform import Transform
from ..units import deg, mm
from .panels import JOINT_STYLES, SLACK, lay_out, panel
from .scene import FAINT, INK, SOFT, Scene, arm_points, is_flat, named_targets, number, reach

__all__ = [
    "JOINT_STYLES",
    "SLACK",
    "Figure",
    "figure",
    "palette_png",
    "plot_frames",
    "plot_joints",
    "plot_postures",
]

DPI = 100


class Figure(MatplotlibFigure):
    """A Matplotlib figure that carries its alt text and shows itself in a notebook."""

    def __init__(self, alt, **keywords):
        super().__init__(dpi=DPI, facecolor="white", **keywords)
        FigureCanvasAgg(self)
        self.alt = alt

    def _repr_mimebundle_(self, include=None, exclude=None):
        # JupyterLab 4.6 and the "lab" template of nbconvert 7.17 both ignore {"alt": ...} in the
        # metadata of an image/png output. Both keep <img alt> in text/html, an untrusted notebook
        # included, and show it once.
        data = base64.b64encode(palette_png(self)).decode()
        width, height = np.round(self.get_size_inches() * DPI).astype(int)
        image = (
            f'<img alt="{html.escape(self.alt)}" width="{width}" height="{height}" '
            f'src="data:image/png;base64,{data}">'
        )
        return {"text/html": image, "text/plain": self.alt}

    def __repr__(self):
        return self.alt


def figure(alt, width=9, height=4):
    """An empty figure of width x height inches (100 pixels each): `ax = fig.subplots()`, and `fig`
    ends the cell.

    `alt` says in words what a sighted reader concludes; it is the image's alternative text and what
    a test compares.
    """
    if not (isinstance(alt, str) and alt.strip()):
        raise ValueError(f"alt: wanted words that say what the figure shows, got {alt!r}")
    return Figure(alt, figsize=(width, height))


def palette_png(fig):
    """The figure as the bytes of a PNG with a palette: a third of the size of a plain one.

    Pillow's octree keeps the colours of thin lines to 1/100; its median cut turns the green of a
    triad blue.
    """
    fig.canvas.draw()
    image = Image.fromarray(np.asarray(fig.canvas.buffer_rgba())).convert("RGB")
    file = io.BytesIO()
    image.quantize(128, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(
        file, "PNG", optimize=True
    )
    return file.getvalue()


def plot_postures(arm, q, *, targets=(), title=None, alt=None):
    """Postures along one path, in a spatial view with true proportions.

    q        (samples, n): the whole path, as finely as it is known. The tool's path is drawn
             through all samples, the first and last posture strongly and up to seven between them
             faintly. NaN rows are left out. Where the flange stands still (the rows of `ik`), up to
             nine postures are drawn alike.
    targets  list of Transforms (one: target; two: start, goal; three: start, via, goal) or dict of
             name -> Transform
    alt      the alternative text, where the numbers alone do not say it
    """
    q = _samples(arm, q)
    targets = named_targets(targets)
    exists = np.flatnonzero(np.isfinite(q).all(axis=-1))
    if not len(exists):
        raise ValueError("q: wanted at least one posture, got only NaN rows")
    size, flange = reach(arm), arm.fk(q)
    fig = Figure(alt or _postures_alt(arm, flange[exists], len(exists), title, targets, size))
    scene = Scene(_canvas(fig, title), size, flat=is_flat(arm, q))
    scene.base()
    first, last = exists[0], exists[-1]
    moves = _moves(flange[exists])
    for i in np.unique(np.linspace(0, len(exists) - 1, 9).round().astype(int))[:-1]:
        scene.arm(arm, q[exists[i]], "between" if moves and i else "first")
    if moves:
        scene.trace(flange.translation)
        scene.triad(flange[first], length=0.07 * size, width=2.4)
        # The names stand where the two postures differ most, on the half next to the base: the tool
        # has its own names.
        half = slice(1, len(arm.links) + 1)
        ends = arm_points(arm, q[[first, last]])[:, half]
        where = np.linalg.norm(ends[1] - ends[0], axis=-1).argmax()
        scene.label("first", ends[0, where], SOFT)
        scene.label("last", ends[1, where])
    scene.arm(arm, q[last], "last" if moves or len(exists) == 1 else "first")
    scene.triad(flange[last], length=0.07 * size, width=3.2, letters=True)
    for name, pose in targets.items():
        scene.triad(pose, name, width=1.4)
    scene.finish(fit=(9, 6.2))
    return fig


def plot_frames(frames, *, names=None, title=None, size=None, chain=False, alt=None):
    """Frames as triads (x red, y green, z blue) with names, beside the base frame, in true
    proportions.

    frames  Transform of shape (k,) or (), or a list of single Transforms, in base coordinates; NaN
            is left out
    names   one for each frame; a frame at the base takes the place of the base's own triad
    size    length of the axes in metres; chosen from the distances if not given
    chain   join the origins in their order, from the base, as the links of an arm do
    """
    frames = _frames(frames)
    origins = np.stack([frame.translation for frame in frames])
    if names is None:
        names = [""] * len(frames)
    if isinstance(names, str) or len(names) != len(frames):
        raise ValueError(f"names: wanted {len(frames)} names, one for each frame, got {names!r}")
    extent = np.nanmax(np.linalg.norm(origins, axis=-1), initial=0)
    size = size or (0.22 * extent if extent > 0 else 0.1)
    if not (np.isfinite(size) and size > 0):
        raise ValueError(f"size: wanted a positive length in metres, got {size!r}")
    unit, unit_name = (1, "m") if extent > 2 else (mm, "mm")
    fig = Figure(alt or _frames_alt(frames, names, title, unit, unit_name))
    scene = Scene(_canvas(fig, title), max(extent, 2 * size))
    at_base = [np.allclose(frame.as_matrix(), np.eye(4), atol=1e-9) for frame in frames]
    if not any(at_base):
        scene.triad(Transform(), "base", length=size, color="#6B7681")
    if chain:
        scene.line(np.concatenate([np.zeros((1, 3)), origins]), color=FAINT, linewidth=4, zorder=2)
    for i, (frame, name) in enumerate(zip(frames, names, strict=True)):
        scene.drop(frame.translation)
        scene.triad(frame, name, length=size, width=2.6, letters=True, at=_naming_axis(frames, i))
    scene.finish(fit=(9, 5.6))
    return fig


def plot_joints(arm, t, q, v=None, a=None, *, title=None, alt=None):
    """Joint values over time and, where given, speeds and accelerations: one panel each, with one
    time axis.

    t (samples,) in seconds; q, v, a (samples, n) in radians and metres, drawn as they are: NaN is a
    gap, a jump by a whole turn is a jump. Prismatic joints have panels of their own, in mm.
    A limit is shaded where its joint comes near it; samples past it are marked and counted. Samples
    past a limit are judged as drawn, so q + 360 degrees may still be inside (`within` says). A lone
    spike, which a jump leaves when it is differentiated, does not set the scale: it leaves the
    panel and is named.
    """
    t = floats(t, "t")
    q = _samples(arm, q)
    if t.ndim != 1 or len(t) != len(q):
        raise ValueError(f"t: wanted {len(q)} times, one for each sample of q, got shape {t.shape}")
    if len(t) < 2 or (np.diff(t) <= 0).any():
        raise ValueError(
            f"t: wanted two or more rising times, got {number(t[0])} ... {number(t[-1])}"
        )
    rows = [
        (kind, _samples(arm, values, kind, len(q)))
        for kind, values in (("q", q), ("v", v), ("a", a))
        if values is not None
    ]
    groups = [
        (np.flatnonzero(arm.prismatic == kind), unit, size)
        for kind, unit, size in ((False, "°", deg), (True, "mm", mm))
        if (arm.prismatic == kind).any()
    ]
    fig = Figure("", figsize=(9, (0.45 if title else 0.1) + 0.45 + 2.05 * len(rows)))
    grid = fig.subplots(
        len(rows),
        len(groups),
        sharex=True,
        squeeze=False,
        width_ratios=[1.7, 1] if len(groups) > 1 else None,
    )
    facts = [f"{arm.name}, joint curves over {number(t[-1] - t[0])} s."]
    for (kind, values), line in zip(rows, grid, strict=True):
        for (joints, unit, size), ax in zip(groups, line, strict=True):
            facts += panel(ax, arm, t, values[:, joints] / size, kind, joints, unit, size)
    for ax in grid[-1]:
        ax.set_xlabel("t, s", labelpad=2)
    lay_out(fig, grid, title)
    fig.alt = alt or " ".join([*([title.rstrip(".") + "."] if title else []), *facts])
    return fig


def _canvas(fig, title):
    """Axes over the whole figure, below the title."""
    fig.set_size_inches(9, 6)
    if title:
        fig.text(
            0.014,
            0.985,
            textwrap.fill(title, 64),
            fontsize=12,
            fontweight="bold",
            color=INK,
            va="top",
        )
    return fig.add_axes((0, 0, 1, 0.93 if title else 1))


def _samples(arm, values, name="q", count=None):
    values = floats(values, name, len(instance(arm, Arm, "arm").links), finite=False)
    if values.ndim == 1:
        values = values[None]
    if values.ndim != 2 or not len(values) or count not in (None, len(values)):
        wanted = count or "samples"
        raise ValueError(f"{name}: wanted shape ({wanted}, {len(arm.links)}), got {values.shape}")
    return values


def _frames(frames):
    """A list of single Transforms."""
    if isinstance(frames, Transform):
        frames = list(frames) if frames.shape else [frames]
    frames = list(frames)
    for frame in frames:
        if instance(frame, Transform, "frames").shape:
            raise ValueError(
                f"frames: wanted a Transform of shape (k,) or a list of single ones, got {frame}"
            )
    if not frames:
        raise ValueError("frames: wanted at least one, got none")
    return frames


def _naming_axis(frames, i):
    """Frames with one origin are told apart at the tips of an axis: of the one (0, 1, 2) whose tips
    lie farthest apart. None for a frame that has its origin to itself.
    """
    here = [
        f for f in frames if np.allclose(f.translation, frames[i].translation, rtol=0, atol=1e-6)
    ]
    axes = np.stack([frame.rotation.as_matrix() for frame in here])
    apart = np.linalg.norm(axes[:, None] - axes[None], axis=-2)[np.triu_indices(len(here), 1)]
    return int(apart.min(axis=0).argmax()) if len(here) > 1 else None


def _postures_alt(arm, flange, count, title, targets, size):
    unit, name = (1, "m") if size > 2 else (mm, "mm")
    words = [title.rstrip(".") + "."] if title else []
    start, end = (_place(flange.translation[i], unit) for i in (0, -1))
    if _moves(flange):
        words.append(f"{arm.name} along a path. The flange moves from {start} to {end} {name}.")
    else:
        postures = "one posture" if count == 1 else f"{count} postures"
        words.append(f"{arm.name} in {postures}, the flange at {start} {name}.")
    if targets:
        words.append(f"Marked: {', '.join(targets)}.")
    return " ".join(words)


def _moves(flange):
    """Whether the poses (k,) differ."""
    return bool(abs(flange.as_matrix() - flange[0].as_matrix()).max() > 1e-6)


def _frames_alt(frames, names, title, unit, unit_name):
    words = [title.rstrip(".") + "."] if title else []
    parts = [
        f"{name or f'frame {i + 1}'} at {_place(frame.translation, unit)} {unit_name}"
        for i, (frame, name) in enumerate(zip(frames, names, strict=True))
    ]
    return " ".join([*words, f"Frames in base coordinates: {', '.join(parts)}."])


def _place(point, unit):
    return f"({', '.join(number(np.round(x / unit, 0 if unit == mm else 2), 4) for x in point)})"
