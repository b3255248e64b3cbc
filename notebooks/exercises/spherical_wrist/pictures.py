"""Views that open after the guess, for the predictions of this lab."""

from typing import Any

import numpy as np

from robokin import ITMO6R, deg, mm
from robokin.show import figure, plot_postures
from robokin.show.palette import FIRST, SECOND

from .predictions import LEANING, PLACES, fastest, joint4_speeds, noise, p1, p5, p7
from .shared import D


def p1_view() -> str:
    bent = p1()["bent"]
    lines = ["How far each origin moves when joint 4 turns by 90°:"]
    lines += [f"frame {k}: {way:.1f} mm" for k, way in enumerate(bent)]
    return "\n".join(lines)


def p2_view() -> str:
    size = D[5] / mm
    lines = ["The distance of o − (0, 0, d6) from the wrist centre:"]
    for tilt in (0, 45, 90, 135, 180):
        off = 2 * size * np.sin(tilt * deg / 2)
        lines.append(f"tool tilted by {tilt}° from straight up: {off:.1f} mm")
    return "\n".join(lines)


def p3_view() -> Any:
    centre = ITMO6R.frames(LEANING)[4]
    title = "q2 = 110°: the upper arm leans back, and the wrist centre is behind axis 1"
    return plot_postures(ITMO6R, LEANING, targets={"wrist centre": centre}, title=title)


def p5_view() -> str:
    facts = p5()
    lines = [f"The largest difference between an entry and that of the matrix of {facts['given']}:"]
    for name in ("theta", "all", "one", "found"):
        off = facts[f"off_{name}"]
        lines.append(f"{facts[name]}: " + (f"{off:.3f}" if off > 1e-12 else "below 1e-12"))
    return "\n".join(lines)


def p6_view() -> Any:
    thetas, worst, lost = noise()
    fig = figure(
        "Above: the largest error of an entry in 200 postures against theta. With the textbook's "
        "formulas it grows as 1 / theta. With psi found after undoing phi it stays below "
        "2e-15 down to theta = 1e-12; at 1e-13, where phi is set to zero, it is 2e-13, and falls "
        "with theta. Below: from 1e-8 rad on, the textbook's root gives no number for about one "
        "posture in five.",
        9,
        5,
    )
    ax, below = fig.subplots(2, 1, sharex=True, height_ratios=(2.6, 1))
    for k, style, color in ((0, "o--", SECOND), (2, "s-", FIRST)):
        ax.loglog(thetas, worst[:, k], style, color=color, lw=2)
        below.plot(thetas, 100 * lost[:, k], style, color=color, lw=2)
    ax.text(2e-7, 3e-4, "textbook, where it gives a number", color=SECOND, ha="right")
    ax.text(1e-6, 3e-14, "ψ after undoing φ", color=FIRST)
    ax.set(
        ylabel="largest error",
        xlim=(3, 3e-17),
        ylim=(3e-17, 20),
        title="Near the singularity the textbook loses digits, then the result itself",
    )
    below.text(3e-7, 15, "textbook", color=SECOND, ha="right")
    below.set(xlabel="θ, rad", ylabel="NaN, % of 200", ylim=(-5, 50))
    fig.align_ylabels()
    fig.subplots_adjust(bottom=0.12, top=0.93, hspace=0.1)
    return fig


def p7_view() -> str:
    facts = p7()
    lines = ["From (20, 70, −60, 30, 50, 10)°, one joint at a time, by up to 150° to either side:"]
    for k in range(1, 7):
        low, high = facts[f"low{k}"], facts[f"high{k}"]
        span = f"{low:.3f} to {high:.3f}" if high - low > 1e-9 else f"always {low:.3f}"
        lines.append(f"joint {k}: {span}")
    return "\n".join(lines)


def p8_view() -> Any:
    fig = figure(
        "The speed of joint 4 on two lines, from 5 mm before the middle to 5 mm after it. It "
        f"reaches {fastest(2 * mm):.0f}°/s on the line 2 mm beside the singular pose, and "
        f"{fastest(1 * mm):.0f}°/s on the line 1 mm beside it, but for half as long.",
        5.8,
        2.4,
    )
    ax = fig.subplots()
    near = abs(PLACES) <= 5.01 * mm
    for miss, color, at in ((2, FIRST, 1.35), (1, SECOND, 0.5)):
        speed = joint4_speeds(miss * mm)
        ax.plot(PLACES[near] / mm, speed[near], color=color, lw=2)
        beside = f"{miss} mm beside: {speed.max():.0f}°/s"
        ax.text(at, 0.9 * speed.max(), beside, color=color, va="center")
    ax.set(xlabel="place on the line, mm", ylabel="joint 4, °/s", ylim=(0, 6400))
    fig.subplots_adjust(left=0.13, right=0.97, bottom=0.21, top=0.96)
    return fig
