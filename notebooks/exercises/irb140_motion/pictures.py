"""Views that open after the guess, for the predictions of this lab."""

from typing import Any

import numpy as np

from robokin import IRB140, deg, differentiate, follow, mm
from robokin.show import curves, figure, plot_joints
from robokin.show.palette import SOFT

from .predictions import (
    FROM,
    LAWS,
    TO,
    S,
    T,
    along,
    clock,
    corner_change,
    errors,
    free_pace,
    joint_3,
    misses,
    out_of_reach,
    p2,
    p6,
    p10,
    sharp,
    tool_acceleration,
)
from .shared import HIGH, LOW, MINUS, ROW, D


def p1_view() -> Any:
    title = "The tool moves at a constant speed, the joints do not"
    return plot_joints(IRB140, T, along(), differentiate(along(), T), title=title)


def p2_view() -> Any:
    facts, angles = p2(), abs(along()[:, 0] - along()[0, 0]) / deg
    clock = np.linspace(0, facts["lin_time"], 401)
    times = {
        "LIN, constant pace": S * facts["lin_time"],
        "LIN, varying pace": free_pace(),
        "PTP": np.interp(angles, angles[[0, -1]], [0, facts["ptp_time"]]),
    }
    fig = figure(
        "The angle that joint 1 has turned, over time. PTP is a straight line, as steep as the "
        f"limit allows, and ends at {facts['ptp_time']:.2f} s. LIN with a varying pace is nearly "
        f"as steep and ends at {facts['best']:.2f} s. LIN with a constant pace is as steep only in "
        f"the middle and ends at {facts['lin_time']:.2f} s.",
        height=3.6,
    )
    ax = fig.subplots()
    turned = {name: np.interp(clock, at, angles, right=np.nan) for name, at in times.items()}
    curves(
        ax,
        clock,
        turned,
        xlabel="time t, s",
        ylabel="turn of joint 1, °",
        title="A constant pace loses time where joint 1 is slow",
    )
    fig.tight_layout()
    return fig


def p3_view() -> str:
    lines = [f"Values of joint 6 for the same posture, and how far each is from {FROM:g}°:"]
    for k in (-2, -1, 0, 1):
        value = TO + 360 * k
        inside = LOW[5] <= value * deg <= HIGH[5]
        lines.append(f"{value:g}°: turn {value - FROM:+g}°, {'inside' if inside else 'outside'}")
    return "\n".join(lines).translate(MINUS)


def p4_view() -> Any:
    fig = figure(
        "Progress, speed and acceleration of three time laws over 20 s. The linear law starts and "
        "ends at full speed, the trapezoidal law's acceleration jumps, the quintic law's does not; "
        "its speed has the highest peak.",
        height=3.4,
    )
    axes = fig.subplots(1, 3)
    progress = {name: law(T[-1])(T) for name, law in LAWS.items()}
    speed = {name: differentiate(s, T) for name, s in progress.items()}
    acceleration = {name: differentiate(s, T, 2) for name, s in progress.items()}
    curves(axes[0], T, progress, xlabel="time t, s", title="progress s")
    curves(axes[1], T, speed, xlabel="time t, s", title="speed of s, 1/s")
    curves(axes[2], T, acceleration, xlabel="time t, s", title="acceleration of s, 1/s²")
    axes[2].get_legend().remove()  # it would cover a curve; the other two panels have one
    fig.tight_layout()
    return fig


def p5_view() -> str:
    lines = ["Joint 3 at t = 10 s, by differences of samples:"]
    for step in (0.02, 0.01, 0.005):
        change, a = corner_change(step)
        twice = abs(differentiate(sharp(step), clock(step), 2)[:, 0]).max() / deg
        lines.append(
            f"step {step:g} s: the speed changes by {change:.1f}°/s; second differences "
            f"{a:.0f}°/s²; differentiate(q, t, 2) {twice:.0f}°/s²"
        )
    lines.append(
        "The change of the speed stays the same: it is a property of the robot's motion. The "
        "quotients depend on the step: they come from the method. (differentiate spreads the "
        "change over two steps, so its quotient is about half as large.)"
    )
    return "\n".join(lines)


def p6_view() -> str:
    lines = ["The tool's acceleration in the middle of the corner:"]
    facts = p6()
    tried = [(0.1, facts["same"])]
    tried += [(0.05, facts[name]) for name in ("same", "root", "twice", "four")]
    for fraction, time in tried:
        a = tool_acceleration(fraction, time)
        lines.append(f"blend {fraction:.2f}, duration {time:.1f} s: {a:.2f} mm/s²")
    return "\n".join(lines)


def p7_view() -> str:
    lines = ["Joint 3's greatest acceleration if both corners pass at the same distance from via:"]
    blends = np.array([0.05, 0.1, 0.15, 0.2])
    found = zip(blends, joint_3(blends, "parabola"), joint_3(blends / 0.75, "quintic"), strict=True)
    for b, parabola, quintic in found:
        more = f"{100 * (quintic / parabola - 1):+.0f} %".translate(MINUS)
        lines.append(
            f"{b / 2 * D / mm:.1f} mm: parabola (blend {b:.2f}) {parabola:.2f}°/s², quintic "
            f"(blend {b / 0.75:.3f}) {quintic:.2f}°/s², {more}"
        )
    return "\n".join(lines)


def p8_view() -> Any:
    steps = 10.0 ** np.arange(-8, 0.6, 0.25)
    fig = figure(
        "Error of three difference formulas against the step, both axes logarithmic. Each curve is "
        "a V: the error falls with the step, until rounding makes it rise again.",
        height=3.8,
    )
    ax = fig.subplots()
    curves(
        ax,
        steps,
        errors(steps),
        xlabel="step h, s",
        ylabel="largest error of six joints, rad/s and rad/s²",
        title="A step can be too small: on the left, the error is rounding",
    )
    ax.axvline(0.01, color=SOFT, linewidth=1)
    ax.set(xscale="log", yscale="log")
    fig.tight_layout()
    return fig


def p9_view() -> str:
    lines = ["How far from the start the motion begins, and how far from the goal it ends:"]
    for b in (0.5, 0.51, 0.55, 0.6):
        begins, ends = misses(b)
        lines.append(f"b = {b:.2f}: {begins:.2f} mm and {ends:.2f} mm")
    return "\n".join(lines)


def p10_view() -> Any:
    facts, rows = p10(), out_of_reach()
    found = {
        f"np.unwrap: {facts['left']} of {facts['count']} samples": np.unwrap(rows[:, ROW], axis=0),
        f"follow: {facts['there']} of {facts['count']} samples": follow(IRB140, rows, ROW),
    }
    fig = figure(
        f"Joint 3 against the number of the sample. {'; '.join(found)} usable. The curve of "
        "np.unwrap ends at the gap; that of follow goes on behind it.",
        height=3,
    )
    for ax, (title, q) in zip(fig.subplots(1, 2, sharey=True), found.items(), strict=True):
        one = {"joint 3": q[:, 2] / deg}
        curves(ax, np.arange(len(q)), one, xlabel="sample", ylabel="q3, °", title=title)
        ax.set_xlim(0, len(q))
    fig.tight_layout()
    return fig
