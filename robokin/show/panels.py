"""Panels of joint curves over time: limits shaded, violations marked and counted, spikes named.

`plots.plot_joints` puts them into a figure.
"""

import textwrap

import numpy as np
from matplotlib.ticker import MaxNLocator
from matplotlib.transforms import offset_copy

from .scene import INK, SOFT, dense, number

# Colour and dash of joints 1 to 6; dashes are on/off lengths in line widths. Colours: Okabe and
# Ito, Color Universal Design, 2008; they stay apart for colour-blind readers, and the dashes stay
# apart in grey print.
JOINT_STYLES = (
    {"color": "#0072B2", "dash": ()},
    {"color": "#D55E00", "dash": (5, 1.8)},
    {"color": "#009E73", "dash": (1.6, 1.3)},
    {"color": "#CC79A7", "dash": (6, 1.6, 1.4, 1.6)},
    {"color": "#E69F00", "dash": (2.8, 1.2)},
    {"color": "#56B4E9", "dash": (0.9, 1.4)},
)
ALARM = "#B3261E"
SLACK = 1e-9  # a joint this little past its limit stands at it
STRIP = 0.08  # height of the shaded strip beyond a limit, as a share of its panel
WORDS = {"q": ("angle", "position"), "v": ("speed", "speed"), "a": ("acceleration", "acceleration")}
PER = {"q": "", "v": "/s", "a": "/s²"}


def panel(ax, arm, t, values, kind, joints, unit, size):
    """One quantity of some joints, `values` (samples, k) in `unit`; returns what the alt text says
    about it.
    """
    unit_text = unit + PER[kind]
    name = WORDS[kind][int(arm.prismatic[joints[0]])]
    spikes = _spikes(values) if kind != "q" else np.zeros(values.shape, dtype=bool)
    low, high = _view(np.where(spikes, np.nan, values), kind)
    limits = _limits(arm, kind, joints, size)
    past = (values < limits[:, 0] - SLACK) | (values > limits[:, 1] + SLACK)
    ax.limit_labels = []
    ax.set_xlim(t[0], t[-1])
    ax.set_ylim(low, high)
    ax.grid(color="#E9ECEF", linewidth=0.8)
    ax.set_axisbelow(True)
    ax.tick_params(labelsize=9, color=SOFT, length=3)
    alone = len(joints) == len(arm.links)  # else there are two columns of panels
    ax.xaxis.set_major_locator(MaxNLocator(8 if alone else 4, steps=[1, 2, 5, 10]))
    steps = [1, 1.5, 3, 4.5, 9, 10] if unit_text == "°" else [1, 2, 5, 10]
    ax.yaxis.set_major_locator(MaxNLocator(5, steps=steps))
    ax.spines[:].set_color(SOFT)
    ax.set_ylabel(f"{name}, {unit_text}", fontsize=9.5)
    for i, joint in enumerate(joints):
        style = JOINT_STYLES[joint % len(JOINT_STYLES)]
        line = (0, style["dash"]) if style["dash"] else "-"
        _band(ax, limits[i], values[:, i], joint, unit_text, style["color"])
        ax.plot(
            t,
            values[:, i],
            color=style["color"],
            linestyle=line,
            linewidth=1.9,
            label=f"q{joint + 1}",
        )
        marked = np.where(past[:, i] & ~spikes[:, i], values[:, i], np.nan)
        if np.isfinite(marked).any():
            ax.plot(
                t, marked, color=ALARM, linewidth=7, alpha=0.3, solid_capstyle="butt", zorder=1.5
            )
    said = _remarks(arm, t, values, kind, joints, past & ~spikes, spikes, unit, limits)
    ax.heading = ax.text(
        0.006,
        1.02,
        "; ".join(said),
        transform=ax.transAxes,
        fontsize=9,
        va="bottom",
        color=ALARM if past.any() or spikes.any() else "#5A6672",
    )
    return [
        _range_words(kind, name, np.where(spikes, np.nan, values), joints, unit_text),
        *(
            f"{remark}." if remark.startswith("q") else f"{remark[0].upper()}{remark[1:]}."
            for remark in said
        ),
    ]


def lay_out(fig, grid, title):
    """Margins in inches, the title, and names at the ends of the curves or in a legend."""
    legend = not all(_ends_in_view(ax) for ax in grid.flat)
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
    fig.align_ylabels(grid)
    for ax in grid.flat:
        inches = ax.get_position().width * width
        ax.heading.set_text(textwrap.fill(ax.heading.get_text(), int(inches * 14)))
        (_legend if legend else _end_labels)(ax)
        _write_limits(ax)


def _limits(arm, kind, joints, size):
    """(k, 2) the limits of the quantity in the unit of the panel, infinite where there are none."""
    if kind == "q":
        return arm.limits[joints] / size
    greatest = np.full(len(joints), np.inf)
    if kind == "v" and arm.speed_limits is not None:
        greatest = arm.speed_limits[joints] / size
    return np.stack([-greatest, greatest], axis=-1)


def _view(values, kind):
    """Lowest and highest value of the panel: the curves and a margin, never the noise of a
    constant.
    """
    finite = values[np.isfinite(values)]
    low, high = (finite.min(), finite.max()) if len(finite) else (0.0, 0.0)
    if kind != "q":
        low, high = min(low, 0.0), max(high, 0.0)
    least = 1.0 if kind == "q" else 0.01  # degrees or mm; per second
    if high - low < least:
        low, high = (low + high - least) / 2, (low + high + least) / 2
    margin = 0.08 * (high - low)
    return low - margin, high + margin


def _spikes(values, longest=6):
    """Lone samples (samples, k) that a differentiated jump leaves: in runs of at most `longest`
    samples, and more than four times as large as all but the largest twentieth of that joint's
    samples and of the panel's typical joint.
    """
    size = np.where(np.isfinite(values), abs(values), 0.0)
    if len(size) < 40:
        return np.zeros(values.shape, dtype=bool)
    usual = np.quantile(size, 0.95, axis=0)
    high = size > 4 * np.maximum(usual, max(np.median(usual), 0.01))
    for column in high.T:
        edges = np.flatnonzero(np.diff(np.concatenate([[0], column, [0]])))
        for start, stop in edges.reshape(-1, 2):
            column[start:stop] = stop - start <= longest
    return high


def near_limits(limits, least, greatest, low, high):
    """Which limits a panel from low to high shows: those in view that their joint passes or comes
    near, measured by the height of the panel and by the room between the joint's limits.

    limits (..., 2), the joint's least and greatest value (...), low and high (...) -> bool (...,
    2).
    """
    away = np.stack([least - limits[..., 0], limits[..., 1] - greatest], axis=-1)
    low, high = np.expand_dims(low, -1), np.expand_dims(high, -1)
    near = np.minimum(1.2 * STRIP * (high - low), 0.1 * np.diff(limits, axis=-1))
    return (low <= limits) & (limits <= high) & (away < near)


def _band(ax, limits, values, joint, unit, color):
    """Shade the near side of what lies beyond a limit. Only a strip: with six joints in one panel,
    what is beyond one joint's limit is inside another's.
    """
    low, high = ax.get_ylim()
    near = near_limits(
        limits, np.nanmin(values, initial=np.inf), np.nanmax(values, initial=-np.inf), low, high
    )
    for bound, shown, outward in zip(limits, near, (-1, 1), strict=True):
        if shown:
            beyond = np.clip(bound + outward * STRIP * (high - low), low, high)
            ax.axhspan(bound, beyond, color=color, alpha=0.22, linewidth=0, zorder=0)
            ax.axhline(bound, color=color, linewidth=0.9, zorder=1)
            ax.limit_labels.append(
                (f"limit of q{joint + 1}: {number(bound)}{_space(unit)}{unit}", bound, outward)
            )


def _write_limits(ax):
    """The words beside each limit line, inside it or beyond it, where fewest curves pass."""
    to_pixels, renderer = ax.transData.transform, ax.figure.canvas.get_renderer()
    curves = np.concatenate(
        [
            dense(to_pixels(np.column_stack(line.get_data())))
            for line in ax.lines
            if line.get_label().startswith("q")
        ]
    )
    frame, taken = ax.get_window_extent(renderer), []
    for words, bound, outward in ax.limit_labels:
        text = ax.text(0, bound, words, fontsize=8.5, color=INK, va="center", zorder=4)
        box = text.get_window_extent(renderer)
        w, h = box.width / 2 + 3, box.height / 2
        y = to_pixels((0, bound))[1]
        best, least = None, np.inf
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
        text.set_position(ax.transData.inverted().transform(best - (w - 3, 0)))


def _remarks(arm, t, values, kind, joints, past, spikes, unit, limits):
    """What the panel says in words: violations, jumps, spikes, the share of a speed limit."""
    said = []
    if past.any():
        what = {"q": "limit", "v": "speed limit"}[kind]
        counts = past.sum(axis=0)
        for i in sorted(np.flatnonzero(counts), key=lambda i: -counts[i]):
            rest = (
                f"past its {what} in {counts[i]} of {len(t)} samples"
                if not said
                else f"in {counts[i]}"
            )
            said.append(f"joint {joints[i] + 1} {rest}")
        if past.any(axis=1).sum() > counts.max():
            said.append(f"one or another in {past.any(axis=1).sum()}")
        said = [", ".join(said)]
    elif kind == "q":
        said.append(
            "every joint inside its limits"
            if len(joints) > 1
            else f"q{joints[0] + 1} inside its limits"
        )
    elif kind == "v" and np.isfinite(limits).all():
        share = np.nanmax(np.where(spikes, 0, abs(values)) / limits[:, 1], axis=0, initial=0)
        i = int(share.round(9).argmax())
        said.append(f"at most {number(100 * share[i], 2)} % of the speed limit (q{joints[i] + 1})")
    if kind == "q" and unit == "°":
        said += _turns(t, values, joints)
    if spikes.any():
        jump = {"v": "angle jump" if unit == "°" else "jump", "a": "speed jump"}[kind]
        at = t[spikes.any(axis=1)]
        where = np.unravel_index(np.where(spikes, abs(values), 0).round(6).argmax(), values.shape)
        # Neighbouring samples are one spike, in the middle of them.
        runs = np.split(at, np.flatnonzero(np.diff(at) > 10 * np.median(np.diff(t))) + 1)
        said.append(
            f"spike at {_times([run[len(run) // 2] for run in runs])}: {jump} / step, "
            f"up to {number(abs(values[where]))} {unit}{PER[kind]} (q{joints[where[1]] + 1})"
        )
    return said


def _turns(t, values, joints):
    """Jumps by a whole turn between neighbours, as angles have that were not unwrapped."""
    step = np.diff(values, axis=0)
    jumps = abs(abs(step) - 360) < 30
    said = []
    for i, joint in enumerate(joints):
        if jumps[:, i].any():
            said.append(f"q{joint + 1} jumps by 360° at {_times(t[1:][jumps[:, i]])}")
    return said


def _times(times):
    return f"{' and '.join(map(number, times))} s" if len(times) < 4 else f"{len(times)} places"


def _range_words(kind, name, values, joints, unit):
    """What the curves reach, in numbers that do not depend on the last bits."""
    gap = _space(unit)
    if kind == "q":
        parts = []
        for joint, column in zip(joints, values.T, strict=True):
            reached = column[np.isfinite(column)].round(6)
            ends = (
                [number(x.round(1), 4) for x in (reached.min(), reached.max())]
                if len(reached)
                else []
            )
            span = f"{' to '.join(dict.fromkeys(ends))}{gap}{unit}" if ends else "missing"
            parts.append(f"q{joint + 1} {span}")
        return f"{name.capitalize()}: {', '.join(parts)}."
    greatest = np.nanmax(abs(values), axis=0, initial=0).round(6)
    i = int(greatest.argmax())
    return f"Greatest {name} {number(greatest[i], 3)}{gap}{unit}" + (
        f" (q{joints[i] + 1})." if greatest[i] else "."
    )


def _space(unit):
    return "" if unit == "°" else " "


def _ends_in_view(ax):
    """Whether every curve goes on to the right edge, or nearly, and ends between the limits of the
    panel.
    """
    (low, high), (first, last) = ax.get_ylim(), ax.get_xlim()
    times, ends = _ends(ax)
    return bool(((ends >= low) & (ends <= high) & (times > first + 0.9 * (last - first))).all())


def _ends(ax):
    """Time and value of the last sample that exists, of each curve; NaN for a curve that has
    none.
    """
    curves = [
        np.column_stack(line.get_data()) for line in ax.lines if line.get_label().startswith("q")
    ]
    last = [curve[np.isfinite(curve[:, 1])][-1:] for curve in curves]
    return np.array([end[0] if len(end) else (np.nan, np.nan) for end in last]).T


def _legend(ax):
    lines = [line for line in ax.lines if line.get_label().startswith("q")]
    ax.legend(
        handles=lines,
        loc="center left",
        bbox_to_anchor=(1.0, 0.5),
        fontsize=8.5,
        frameon=False,
        handlelength=2.6,
        borderpad=0.1,
        handletextpad=0.4,
    )


def _end_labels(ax):
    """The joint's name at the right end of each curve, moved apart where ends meet."""
    lines = [line for line in ax.lines if line.get_label().startswith("q")]
    low, high = ax.get_ylim()
    times, ends = _ends(ax)
    points = ax.get_position().height * ax.figure.get_size_inches()[1] * 72
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
            textcoords=offset_copy(ax.get_yaxis_transform(), ax.figure, 14, 0, "points"),
            arrowprops={
                "arrowstyle": "-",
                "color": color,
                "linewidth": 0.9,
                "shrinkA": 0,
                "shrinkB": 0,
                "relpos": (0, 0.5),
            },
        )


def _write_title(fig, title, height):
    """A bold title at the top left, in as many lines as it takes in a figure of this height;
    returns their number.
    """
    words = textwrap.fill(title, int(fig.get_size_inches()[0] * 8.4))
    lines = words.count("\n") + 1
    fig.text(
        0.014,
        1 - 0.1 / (height + 0.2 * (lines - 1)),
        words,
        fontsize=12,
        fontweight="bold",
        color=INK,
        va="top",
    )
    return lines
