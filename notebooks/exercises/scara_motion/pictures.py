"""Views that open after the guess, for the predictions of this lab."""

from typing import Any

import numpy as np

from robokin import SCARA, ScaraPose, deg, differentiate, lin, mm, ptp
from robokin.show import JOINT_STYLES, animate, curves, figure
from robokin.show.palette import ALARM, AREA, COMPARED, INK, REMARK, SOFT
from robokin.units import wrapped

from .predictions import B1, H1, H2, OFF, acceleration, behind, near_start, p5, p9, turning
from .shared import GOAL, HIGH, ROW, START, VIA, S, Shown, T, joints, stroke

FEW = T[::10]  # every 0.2 s: enough for a view that shows a shape
WIDE = 4.2  # inches: a figure of this width fits on a phone without scrolling
PINK = JOINT_STYLES[3]["color"]  # joint 4


def p1_view() -> Any:
    fig = figure(
        "The four joints over time on the line, with a tool angle of 0, 45 and 90 degrees at the "
        "start. Joint 3 has three curves, which meet at the goal; joints 1, 2 and 4 have one.",
        WIDE,
        4.6,
    )
    for i, ax in enumerate(fig.subplots(2, 2).flat):
        for angle, style in ((0, "-"), (45, "--"), (90, ":")):
            start = ScaraPose(START.position, angle * deg)
            q = joints(lin(start, GOAL, FEW / 20))[:, i] / (mm if i == 3 else deg)
            ax.plot(FEW, q, style, color=JOINT_STYLES[i]["color"], lw=2)
            if i == 2:
                ax.text(0.6, q[0] + 18, f"{angle}°", fontsize=10)
        ax.set(xlabel="t, s", title=f"q{i + 1}, {'mm' if i == 3 else '°'}")
    fig.suptitle("Three tool angles at the start (0°, 45°, 90°): only joint 3 differs")
    fig.tight_layout()
    return fig


def p2_view() -> Any:
    v = differentiate(joints(lin(START, GOAL, S)), T) / [deg, deg, deg, mm]
    ends = zip(v.min(axis=0), v.max(axis=0), ["degrees/s"] * 3 + ["mm/s"], strict=True)
    told = "; ".join(
        f"q{i} from {low:.1f} to {high:.1f} {unit}" for i, (low, high, unit) in enumerate(ends, 1)
    )
    fig = figure(
        f"The speeds of the joints over time on the line: {told}. Only that of q4 is constant.",
        WIDE,
        4.6,
    )
    for i, ax in enumerate(fig.subplots(2, 2).flat):
        color, dash = JOINT_STYLES[i]["color"], JOINT_STYLES[i]["dash"]
        ax.plot(T, v[:, i], color=color, dashes=dash or (1, 0), lw=2)
        ax.set(xlabel="t, s", title=f"q{i + 1}, {'mm' if i == 3 else '°'}/s")
        if i == 3:
            ax.set(ylim=(-8, 0))
    fig.suptitle("Speeds on a line: only the stroke changes evenly")
    fig.tight_layout()
    return fig


def p3_view() -> Any:
    lower = np.array([0, 60, 120])  # mm: how far the goal is lowered
    goals = ScaraPose([[0.2, -0.2, (200 - z) * mm] for z in lower], 90 * deg)
    share = FEW / 20
    line = joints(lin(START, goals[:, None], share))
    even = ptp(SCARA.ik(START)[ROW], SCARA.ik(goals)[:, None, ROW], share)
    slider = "goal lowered by, mm", lower
    title = "Two motions with the same ends, at the same heights at all times"
    return animate([SCARA] * 2, FEW, [line, even], names=["LIN", "PTP"], slider=slider, title=title)


def p4_view() -> Any:
    line = joints(lin(START, behind(0), S))
    even = ptp(line[0], line[-1], S)
    past = [
        f"joint {k + 1} is {(abs(line[:, k]) - HIGH[k]).max() / deg:.0f} degrees past its limit of "
        f"{HIGH[k] / deg:.0f}"
        for k in (0, 1)
    ]
    fig = figure(
        f"Joints 1 and 2 over the progress. In LIN {past[0]}, and {past[1]}, each at its worst. In "
        "PTP both run straight between their ends, inside their limits.",
        WIDE,
        5.2,
    )
    for k, ax in enumerate(fig.subplots(2, 1, sharex=True)):
        color = JOINT_STYLES[k]["color"]
        side = np.sign(line[abs(line[:, k]).argmax(), k])
        limit = side * HIGH[k] / deg
        ax.plot(S, line[:, k] / deg, color=color, lw=2.4, label="LIN")
        ax.plot(S, even[:, k] / deg, ":", color=color, lw=2.4, label="PTP")
        ax.axhspan(limit, side * 240, color=AREA, zorder=0)
        ax.set(xlim=(0, 1), ylim=(-240, 60) if side < 0 else (0, 180), ylabel=f"q{k + 1}, °")
        ax.set_title(f"LIN takes joint {k + 1} past {Shown(limit):.0f}°, PTP does not")
        ax.legend(loc="lower left")
    ax.set(xlabel="progress s")
    fig.tight_layout()
    return fig


def p5_view() -> Any:
    down, up, half, before = (p5()[name] for name in ("down", "up", "half", "before"))
    after, t = -up / half, np.array([0, half, 2 * half])
    fig = figure(
        f"Joint 4 over time: its value rises by {down:g} mm and falls by {up:g} mm; its speed is "
        f"{before:g} mm/s, then {after:g} mm/s.",
        WIDE,
        4.6,
    )
    place, speed = fig.subplots(2, 1)
    place.plot(t, [0, down, down - up], "-.", color=PINK, lw=2)
    speed.plot(t[:2], [before] * 2, "-.", t[1:], [after] * 2, "-.", color=PINK, lw=2)
    place.set(
        xlabel="time t, s", ylabel="q4 since the start, mm", title="A lower tool needs more stroke"
    )
    jump = f"A jump of {Shown(after - before):g} mm/s"
    speed.set(xlabel="time t, s", ylabel="speed of q4, mm/s", title=jump)
    speed.margins(y=0.15)
    fig.tight_layout()
    return fig


def p6_view() -> Any:
    fig = figure(
        "Tool angle over the progress. By the rotation, a start at +0.01 degrees turns to the left "
        "and one at -0.01 degrees to the right. By the number, both turn to the left.",
        WIDE,
        5.4,
    )
    axes = fig.subplots(2, 1, sharex=True)
    starts = {f"start at {Shown(off):+.2f}°": off for off in (-OFF, OFF)}
    curves(
        axes[0],
        S,
        {name: np.unwrap(turning(off, S)) / deg for name, off in starts.items()},
        ylabel="tool angle, °",
        title=f"As rotations, a difference of {2 * OFF:g}° decides",
    )
    curves(
        axes[1],
        S,
        {name: near_start(off).lerp(VIA, S).angle / deg for name, off in starts.items()},
        xlabel="progress s",
        ylabel="tool angle, °",
        title="As numbers, both turn to the left",
    )
    for ax in axes:
        ax.set_yticks(range(-180, 181, 90))
    fig.tight_layout()
    return fig


def p7_view() -> Any:
    fig = figure(
        "Two motions that leave a limit, wrapped. Joint 1 turns from 0 to 350 degrees: on the way "
        "it is seen between 140 and 180 degrees, past its limit. Joint 3 turns from 300 to 410 "
        "degrees: wrapped it runs from -60 to 50 degrees, never past its limit of 400.",
        WIDE,
        6.2,
    )
    for ax, i, first, last in zip(fig.subplots(2, 1), (0, 2), (0, 300), (350, 410), strict=True):
        q = first + (last - first) * S
        seen, limit = wrapped(q * deg) / deg, HIGH[i] / deg
        shown = np.where(abs(np.diff(seen, append=seen[-1])) > 180, np.nan, seen)
        caught = abs(seen) > limit
        ax.plot(S, q, "--", color=SOFT, lw=1.5)
        ax.text(0.97, q[-1] - 110, "as it turns", ha="right", va="top", color=REMARK)
        ax.plot(S, shown, color=JOINT_STYLES[i]["color"], lw=2)
        ax.text(0.97, seen[-1] - 110, "wrapped", ha="right", va="top")
        if caught.any():
            ax.plot(S[caught], seen[caught], ".", color=ALARM, ms=5)
            ax.text(S[caught][0] - 0.02, seen[caught][0] + 15, "caught", ha="right", color=ALARM)
        ax.axhspan(limit, 500, color=AREA, zorder=0)
        ax.axhspan(-500, -limit, color=AREA, zorder=0)
        told = "caught on its way out" if caught.any() else "no sample is caught"
        ax.set(xlim=(0, 1), ylim=(-450, 450), yticks=range(-360, 361, 180), xlabel="progress s")
        ax.set(ylabel=f"q{i + 1}, °", title=f"Joint {i + 1}, limit ±{limit:.0f}°: {told}")
    fig.tight_layout()
    return fig


def p8_view() -> Any:
    fig = figure(
        "Side view of the corner for blends 0.1 to 0.4: the four curves are copies of one another, "
        "enlarged from the via point.",
        WIDE,
        3.8,
    )
    ax = fig.subplots()
    x = np.linspace(0, 1, 101)
    ax.plot([-1, 0, 1], [H1, 0, H2], color=SOFT, lw=1)
    for b, (color, style) in zip((0.1, 0.2, 0.3, 0.4), COMPARED, strict=True):
        across, height = 2 * b * (x**2 - (1 - x) ** 2), 2 * b * (H1 * (1 - x) ** 2 + H2 * x**2)
        ax.plot(across, height, style, color=color, lw=2, label=f"blend {b}")
        ax.plot(across[height.argmin()], height.min(), "o", color=INK, ms=4)
    ax.plot(0, 0, "o", color=INK)
    for place, name, off in (
        ((-2 * B1, 2 * B1 * H1), "A", (-4, 8)),
        ((0, 0), "B = via", (10, 5)),
        ((2 * B1, 2 * B1 * H2), "C", (-14, 2)),
    ):
        ax.plot(*place, "o", color=INK, ms=4)
        ax.annotate(name, place, off, textcoords="offset points", fontsize=11)
    for at, tall, name, side in ((-1, H1, "$h_1$", 6), (1, H2, "$h_2$", -20)):
        ax.annotate("", (at, 0), (at, tall), arrowprops={"arrowstyle": "<->", "color": REMARK})
        ax.annotate(name, (at, tall / 2), (side, 0), textcoords="offset points", fontsize=11)
    ax.axhline(0, color=SOFT, lw=0.8, zorder=0)
    ax.set_title("Every corner is the same one, enlarged from the via point")
    ax.set(xlabel="fraction of the line before (−), after (+) via", ylabel="height above via, mm")
    ax.set_xticks([-1, -0.5, 0, 0.5, 1])
    ax.legend()
    fig.tight_layout()
    return fig


def p9_view() -> Any:
    facts = p9()
    fig = figure(
        "Stroke over time at the same blend: the parabola touches the limit of 180 mm, the quintic "
        "is past it; with a larger blend the quintic touches it, too.",
        WIDE,
        3.8,
    )
    ax = fig.subplots()
    pairs = ("parabola", "parabola"), ("quintic", "parabola"), ("quintic", "quintic")
    curves(
        ax,
        T,
        {f"{one}, blend {facts[of]:.3f}": stroke(facts[of], S, one) / mm for one, of in pairs},
        xlabel="time t, s",
        ylabel="stroke q4, mm",
        title=f"The quintic goes deeper: it needs a blend of {facts['quintic']:.3f}",
    )
    ax.axhspan(HIGH[3] / mm, 200, color=AREA, zorder=0)
    ax.text(5.1, 192, "past the limit of 180 mm")
    ax.set(xlim=(5, 15), ylim=(120, 200))
    ax.legend(loc="lower center")
    fig.tight_layout()
    return fig


def p10_view() -> str:
    lines = ["The stroke's acceleration in the corner, measured:"]
    for b, duration in ((0.4, 10.0), (0.2, 10.0), (0.4, 20.0), (0.2, 20.0)):
        a = acceleration(b, duration)
        lines.append(f"blend {b:g}, duration {duration:g} s: {a:.2f} mm/s²")
    return "\n".join(lines)
