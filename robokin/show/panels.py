"""Panels of joint curves over time. Limits are shaded, violations are marked and counted, and jumps
are named.

`joint_plot.plot_joints` puts the panels into a figure.
"""

import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._arrays import Bools, Floats, Ints
from ..motion.recording import Jump, Recording
from .drawing import DRAWS, Axes, Figure, Line2D, MaxNLocator, Text, offset_copy
from .palette import ALARM, INK, JOINT_STYLES, PANEL_GRID, REMARK, SOFT
from .panel_words import (
    PER,
    about_limits,
    beside_jump,
    corner_words,
    leap_words,
    range_words,
    space,
    spike_words,
)
from .scene import dense, number

STRIP = 0.08  # height of the shaded strip beyond a limit, as a fraction of its panel
WORDS = {"q": ("angle", "position"), "v": ("speed", "speed"), "a": ("acceleration", "acceleration")}


@dataclass
class Panel:
    """One panel of a figure.

    heading  the text above it, wrapped once its width is known
    labels   the labels of the limits that it shows, as (text, limit, 1 for above or -1 for below
             the limit); they are placed later
    facts    its sentences in the alt text
    alarm    whether one of them is about a limit that is exceeded, or about a spike
    """

    ax: Axes
    heading: Text
    labels: list[tuple[str, float, int]]
    facts: list[str]
    alarm: bool


def without_spikes(recording: Recording, kind: str, values: Floats) -> Floats:
    """Return the caller's speeds or accelerations (samples, n), with NaN in place of the spikes
    that a differentiated jump leaves. A spike is a value next to a jump that is more than 1.5 times
    as large as all values elsewhere.
    """
    beside = np.zeros(values.shape, dtype=bool)
    for jump in _jumps(recording, kind):
        beside[beside_jump(jump), jump.by != 0] = True
    spikes = np.zeros_like(beside)
    size = np.where(np.isnan(values), 0.0, abs(values))
    for alike in (recording.arm.prismatic, ~recording.arm.prismatic):
        usual = np.where(beside, 0.0, size)[:, alike].max(initial=0.0)
        spikes[:, alike] = beside[:, alike] & (size[:, alike] > 1.5 * usual)
    return np.where(spikes, np.nan, values)


def draw_panel(
    ax: Axes,
    recording: Recording,
    drawn: Floats,
    kind: str,
    joints: Ints,
    unit: str,
    size: float,
) -> Panel:
    """Draw one quantity of some joints in `unit`. `drawn` (samples, n) are the curves. Values that
    are NaN in the recording are spikes, which do not affect the scale.
    """
    t, unit_text = recording.t, unit + PER[kind]
    name = WORDS[kind][int(recording.arm.prismatic[joints[0]])]
    values = drawn[:, joints] / size
    judged: Floats = getattr(recording, kind)[:, joints] / size
    spikes = np.isfinite(values) & np.isnan(judged)
    low, high = _view(judged, kind)
    limits = _limits(recording, kind, joints, size)
    past = _past(recording, kind, joints)
    ax.set_xlim(t[0], t[-1])
    ax.set_ylim(low, high)
    ax.grid(color=PANEL_GRID, linewidth=0.8)
    ax.set_axisbelow(True)
    ax.tick_params(labelsize=9, color=SOFT, length=3)
    alone = drawn.shape[1] == len(joints)  # otherwise there are two columns of panels
    ax.xaxis.set_major_locator(MaxNLocator(8 if alone else 4, steps=[1, 2, 5, 10]))
    steps = [1, 1.5, 3, 4.5, 9, 10] if unit_text == "°" else [1, 2, 5, 10]
    ax.yaxis.set_major_locator(MaxNLocator(5, steps=steps))
    ax.spines[:].set_color(SOFT)
    ax.set_ylabel(f"{name}, {unit_text}", fontsize=9.5)
    labels: list[tuple[str, float, int]] = []
    for i, joint in enumerate(joints):
        style = JOINT_STYLES[joint % len(JOINT_STYLES)]
        line = (0, style["dash"]) if style["dash"] else "-"
        labels += _band(ax, (low, high), limits[i], values[:, i], joint, unit_text, style["color"])
        ax.plot(
            t,
            values[:, i],
            color=style["color"],
            linestyle=line,
            linewidth=1.9,
            label=f"q{joint + 1}",
        )
        if past[:, i].any():
            marked = np.where(past[:, i], values[:, i], np.nan)
            ax.plot(
                t, marked, color=ALARM, linewidth=7, alpha=0.3, solid_capstyle="butt", zorder=1.5
            )
    said = [
        *about_limits(recording, kind, joints, past),
        *leap_words(recording, kind, joints, unit, size),
        *spike_words(recording, kind, joints, spikes, values, unit),
        *corner_words(recording, kind, joints, unit, size, np.isnan(values)),
    ]
    alarm = bool(past.any() or spikes.any())
    heading = ax.text(
        0.006,
        1.02,
        "; ".join(said),
        transform=ax.transAxes,
        fontsize=9,
        va="bottom",
        color=ALARM if alarm else REMARK,
    )
    facts = [
        f"{remark}." if remark.startswith("q") else f"{remark[0].upper()}{remark[1:]}."
        for remark in said
    ]
    words = range_words(recording, kind, name, joints, unit_text, size)
    return Panel(ax, heading, labels, [words, *facts], alarm)


def lay_out(fig: Figure, panels: Sequence[Panel], title: str | None) -> None:
    """Set the margins (inches), the title, and the names at the ends of curves or in a legend."""
    if not DRAWS:
        return
    legend = not all(_ends_in_view(panel.ax) for panel in panels)
    width, height = fig.get_size_inches()
    lines = _write_title(fig, title, height) if title else 0
    fig.set_size_inches(width, height + 0.2 * max(lines - 1, 0))
    height = fig.get_size_inches()[1]
    right, top = 0.75 if legend else 0.45, 0.34 + 0.14 * bool(lines) + 0.2 * lines
    fig.subplots_adjust(
        left=0.72 / width,
        right=1 - right / width,
        bottom=0.45 / height,
        top=1 - top / height,
        hspace=0.32,
        wspace=0.5,
    )
    fig.align_ylabels([panel.ax for panel in panels])
    for panel in panels:
        inches = panel.ax.get_position().width * width
        panel.heading.set_text(textwrap.fill(panel.heading.get_text(), int(inches * 14)))
        (_legend if legend else _end_labels)(panel.ax)
        _write_limits(panel)


def near_limits(
    limits: Floats,
    least: Floats | float,
    greatest: Floats | float,
    low: Floats | float,
    high: Floats | float,
) -> Bools:
    """Return the limits that a panel from low to high shows, as bool (..., 2). A limit is shown if
    it is in view and its joint exceeds it or comes near to it, compared with the height of the
    panel and with the range between the joint's limits.

    limits (..., 2); the joint's least and greatest value (...); low and high (...)
    """
    away = np.stack([least - limits[..., 0], limits[..., 1] - greatest], axis=-1)
    low, high = np.expand_dims(low, -1), np.expand_dims(high, -1)
    near = np.minimum(1.2 * STRIP * (high - low), 0.1 * np.diff(limits, axis=-1))
    shown: Bools = (low <= limits) & (limits <= high) & (away < near)
    return shown


# --- Limits, range and jumps of a panel -----------------------------------------------------------


def _limits(recording: Recording, kind: str, joints: Ints, size: float) -> Floats:
    """Return the limits (k, 2) of the quantity in the unit of the panel. They are infinite if there
    are none.
    """
    arm = recording.arm
    if kind == "q":
        return arm.limits[joints] / size
    greatest = np.full(len(joints), np.inf)
    if kind == "v" and arm.speed_limits is not None:
        greatest = arm.speed_limits[joints] / size
    return np.stack([-greatest, greatest], axis=-1)


def _past(recording: Recording, kind: str, joints: Ints) -> Bools:
    """Return which samples (samples, k) exceed a limit."""
    if kind == "a":
        return np.zeros((len(recording.t), len(joints)), dtype=bool)
    return (recording.excess if kind == "q" else recording.speed_excess)[:, joints] > 0


def _view(values: Floats, kind: str) -> tuple[float, float]:
    """Return the lowest and highest value of the panel: the range of the curves and a margin. The
    range is never so small that it magnifies the rounding errors of a constant curve.
    """
    finite = values[np.isfinite(values)]
    low, high = (finite.min(), finite.max()) if len(finite) else (0.0, 0.0)
    if kind != "q":
        low, high = min(low, 0.0), max(high, 0.0)
    least = 1.0 if kind == "q" else 0.01  # degrees or mm for q, otherwise the units of v or a
    if high - low < least:
        low, high = (low + high - least) / 2, (low + high + least) / 2
    margin = 0.08 * (high - low)
    return low - margin, high + margin


def _band(
    ax: Axes,
    view: tuple[float, float],
    limits: Floats,
    values: Floats,
    joint: int,
    unit: str,
    color: str,
) -> Iterator[tuple[str, float, int]]:
    """Shade a strip beyond a limit, and yield the labels. It is only a strip, because in a panel
    with six joints, values beyond the limit of one joint are inside the limits of another.
    """
    low, high = view
    near = near_limits(
        limits, np.nanmin(values, initial=np.inf), np.nanmax(values, initial=-np.inf), low, high
    )
    for bound, shown, outward in zip(limits, near, (-1, 1), strict=True):
        if shown:
            beyond = np.clip(bound + outward * STRIP * (high - low), low, high)
            ax.axhspan(bound, beyond, color=color, alpha=0.22, linewidth=0, zorder=0)
            ax.axhline(bound, color=color, linewidth=0.9, zorder=1)
            yield f"limit of q{joint + 1}: {number(bound)}{space(unit)}{unit}", bound, outward


def _jumps(recording: Recording, kind: str) -> list[Jump]:
    """Return the jumps across which differences of this kind have no meaning."""
    return [*recording.leaps, *(recording.jumps if kind == "a" else ())]


# --- Names, limits and the title ------------------------------------------------------------------


def _write_limits(panel: Panel) -> None:
    """Write the text of each limit next to its line, inside or beyond the limit, where it covers
    the curves least.
    """
    ax = panel.ax
    canvas: Any = ax.figure.canvas
    to_data: Any = ax.transData.inverted()
    to_pixels, renderer = ax.transData.transform, canvas.get_renderer()
    curves = np.concatenate([dense(to_pixels(line.get_xydata())) for line in _curves(ax)])
    frame = ax.get_window_extent(renderer)
    taken: list[tuple[Floats, float, float]] = []
    for words, bound, outward in panel.labels:
        text = ax.text(0, bound, words, fontsize=8.5, color=INK, va="center", zorder=4)
        box = text.get_window_extent(renderer)
        w, h = box.width / 2 + 3, box.height / 2
        y = to_pixels((0, bound))[1]
        best, least = np.zeros(2), np.inf
        for x in np.linspace(frame.x0 + w + 4, frame.x1 - w - 4, 24):
            for side in (outward, -outward):
                centre = np.array([x, y + side * (h + 2)])
                cost = (abs(curves - centre) < (w, h)).all(axis=-1).sum() + (
                    x - frame.x0
                ) / frame.width
                cost += 100 * sum(
                    (abs(centre - other) < (w + ow, h + oh)).all() for other, ow, oh in taken
                )
                cost += 1000 * (centre[1] - h < frame.y0 or centre[1] + h > frame.y1) + 0.5 * (
                    side != outward
                )
                if cost < least:
                    best, least = centre, cost
        taken.append((best, w, h))
        text.set_position(to_data.transform(best - (w - 3, 0)))


def _ends_in_view(ax: Axes) -> bool:
    """Return whether every curve ends within the panel and at or near its right edge."""
    (low, high), (first, last) = ax.get_ylim(), ax.get_xlim()
    times, ends = _ends(ax)
    return bool(((ends >= low) & (ends <= high) & (times > first + 0.9 * (last - first))).all())


def _curves(ax: Axes) -> list[Line2D]:
    """Return the lines of the joints, without those of their limits."""
    return [line for line in ax.lines if str(line.get_label()).startswith("q")]


def _ends(ax: Axes) -> tuple[Floats, Floats]:
    """Return the time and value of the last sample of each curve that has any; NaN for an empty
    curve.
    """
    curves = [np.asarray(line.get_xydata()) for line in _curves(ax)]
    last = [curve[np.isfinite(curve[:, 1])][-1:] for curve in curves]
    times, values = np.array([end[0] if len(end) else (np.nan, np.nan) for end in last]).T
    return times, values


def _legend(ax: Axes) -> None:
    ax.legend(
        handles=_curves(ax),
        loc="center left",
        bbox_to_anchor=(1.0, 0.5),
        fontsize=8.5,
        frameon=False,
        handlelength=2.6,
        borderpad=0.1,
        handletextpad=0.4,
    )


def _end_labels(ax: Axes) -> None:
    """Write the joint's name at the right end of each curve; names that would overlap are moved
    apart.
    """
    figure: Any = ax.figure
    lines = _curves(ax)
    low, high = ax.get_ylim()
    times, ends = _ends(ax)
    points = ax.get_position().height * figure.get_size_inches()[1] * 72
    gap = 11 / points * (high - low)
    order = ends.argsort(kind="stable")
    at = ends[order].copy()
    for _ in range(200):  # neighbours push each other apart
        close = gap - np.diff(at)
        if (close <= 1e-9 * gap).all():
            break
        push = np.maximum(close, 0) / 2
        at[:-1] -= push
        at[1:] += push
        at = np.clip(at, low + gap * 0.2, high - gap * 0.2)
    for i, y in zip(order, at, strict=True):
        color = lines[i].get_color()
        ax.annotate(
            lines[i].get_label(),
            (times[i], ends[i]),
            (1, y),
            xycoords="data",
            fontsize=9.5,
            color=color,
            va="center",
            textcoords=offset_copy(ax.get_yaxis_transform(), figure, 14, 0, "points"),
            arrowprops={
                "arrowstyle": "-",
                "color": color,
                "linewidth": 0.9,
                "shrinkA": 0,
                "shrinkB": 0,
                "relpos": (0, 0.5),
            },
        )


def _write_title(fig: Figure, title: str, height: float) -> int:
    """Write a bold title at the top left of a figure of this height, and return its number of
    lines.
    """
    written = fig.suptitle(title, parse_math=False)
    lines = written.get_text().count("\n") + 1
    written.set_y(1 - 0.1 / (height + 0.2 * (lines - 1)))
    return lines
