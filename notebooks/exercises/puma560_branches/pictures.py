"""Views that open after the guess, for the predictions of this lab."""

from typing import Any

import numpy as np

from robokin import PUMA560, deg, differentiate, mm
from robokin.show import curves, figure, plot_frames
from robokin.show.palette import AREA, COMPARED, FIRST, SECOND

from . import predictions as of
from .shared import D3, HIGH, LOW


def p1_view() -> Any:
    frames = PUMA560.frames(np.array([0, 0, of.p1()["down"], 0, 0, 0]) * deg)
    shown = [frames[k] for k in (0, 1, 2, 3, 6)]
    names = ["base", "shoulder", "elbow", "forearm", "flange"]
    title = f"q2 = 0, q3 = {of.p1()['down']}°".translate(of.MINUS)
    return plot_frames(shown, chain=True, size=120 * mm, names=names, title=title)


def p2_view() -> Any:
    facts = of.p2()
    fig = figure(
        "The two values of joint 1 over the distance of the wrist centre from axis 1. At 800 mm "
        f"they differ by {np.ptp(of.waists(800 * mm)):.0f} degrees, at {facts['rho']:.0f} mm by "
        f"{facts['turn']:.0f} degrees, at {D3 / mm:.2f} mm they are one.",
        7,
        3.6,
    )
    ax = fig.subplots()
    rho = (D3 / mm + 1e-6) + 700 * np.linspace(0, 1, 100) ** 3
    both = np.array([of.waists(x * mm) for x in rho])
    ax.plot(rho, both[:, 0], "-", rho, both[:, 1], "--", color=FIRST, lw=2)
    ax.vlines(facts["rho"], *of.waists(2 * D3), color=SECOND, lw=2)
    ax.text(facts["rho"] + 8, 90, f"{facts['turn']:.0f}°", va="center")
    ax.text(700, both[92, 0] + 9, "front", ha="center")
    ax.text(700, both[92, 1] - 9, "behind", ha="center", va="top")
    ax.axvspan(100, D3 / mm, color=AREA)
    ax.set(xlabel="distance from axis 1, mm", ylabel="q1, °", xlim=(100, 850), ylim=(0, 180))
    ax.set(yticks=range(0, 181, 30), title="At the offset the two values are one")
    fig.tight_layout()
    return fig


def p3_view() -> str:
    return (
        "At the start of the line, q1 to q6 in degrees:\n"
        f"row 0 (+1 +1 +1): {of.p3()['row0']}\n"
        f"row 2 (+1 −1 +1): {of.p3()['row2']}"
    )


def p4_view() -> Any:
    shares = of.left_shares()
    fig = figure(
        "How many of eight rows are inside the limits at a random pose that can be reached: none "
        f"in {shares[0]:.1f} percent of the poses, all eight in {shares[8]:.1f} percent.",
        8,
        3.2,
    )
    ax = fig.subplots()
    ax.bar(range(9), shares, color=FIRST)
    for k, value in enumerate(shares):
        ax.text(k, value + 0.7, f"{value:.1f}", ha="center", fontsize=9)
    ax.set(xlabel="rows inside the limits", ylabel="share of the poses, %", xticks=range(9))
    title = f"{shares[0]:.0f} % of what it reaches it cannot use"
    ax.set(ylim=(0, 1.2 * shares.max()), title=title)
    fig.tight_layout()
    return fig


def p5_view() -> str:
    facts = of.p5()
    lines = [
        f"{facts[k]}: |det J| = {facts[f'det_{k}']:.1f}e-4 m³, "
        f"smallest singular value {facts[f'sigma_{k}']:.4f}"
        for k in ("both", "one")
    ]
    return "\n".join(lines).translate(of.MINUS)


def p6_view() -> Any:
    misses = np.array([100, 30, 10, 3, 1, 0.3, 0.1])
    prices = {name: np.array([of.price(name, m * mm) for m in misses]) for name in of.LINES}
    most = {name: line[-1, 0] / deg for name, line in prices.items()}
    fig = figure(
        "Left: greatest joint speed over the distance from the singularity, both axes logarithmic. "
        + ", ".join(f"{name}: {value:.0f}" for name, value in most.items())
        + " degrees per second at 0.1 mm. Right: the smallest singular value of all four lines.",
        9,
        3.8,
    )
    left, right = fig.subplots(1, 2)
    for (name, line), (color, style) in zip(prices.items(), COMPARED, strict=True):
        left.loglog(misses, line[:, 0] / deg, style, color=color, lw=2.4)
        look: dict[str, Any] = {"ls": style, "lw": 2.4}
        if name == "shoulder, towards":  # wide, since the other shoulder line covers it
            look = {"lw": 6, "ls": "-", "alpha": 0.4}
        right.loglog(misses, line[:, 1], color=color, label=name, **look)
        above = 0.4 if name == "elbow" else 1.35
        left.text(0.09, above * most[name], name, fontsize=9)
    left.set(xlabel="distance m, mm", ylabel="greatest joint speed, °/s")
    left.set(ylim=(10, 1e5), title="The price depends on the direction")
    right.set(xlabel="distance m, mm", ylabel="distance from singularity")
    right.set(title="The warning does not")
    right.legend(fontsize=9)
    fig.tight_layout()
    return fig


def p7_view() -> str:
    lines = [
        f"{of.PAIRS} lines join random poses: the wrist centre spread evenly over the box about",
        "what the stretched arm reaches, the orientation over all rotations.",
        f"On {of.p7()['lines']} of the lines all eight rows exist and at least one serves.",
        "Of these a rule misses:",
    ]
    lines += [f"{name}: {of.p7()[f'rule{k}']:.0f} %" for k, name in enumerate(of.RULES)]
    return "\n".join(lines)


def p8_view() -> Any:
    t, both = of.twins()
    fig = figure(
        "Left: joint 4 of the wrist twins, row 0 and row 1, the same curve half a turn apart. Row "
        f"0 leaves the limits, by up to {of.p8()['by']:.0f} degrees; row 1 stays inside. Right: "
        "their speeds are equal.",
        9,
        3.6,
    )
    left, right = fig.subplots(1, 2)
    rows = {f"row {row}": both[row] for row in (0, 1)}
    curves(
        left,
        t,
        {name: q[:, 3] / deg for name, q in rows.items()},
        xlabel="t, s",
        ylabel="q4, °",
        title="Half a turn apart: one is past its limit",
    )
    curves(
        right,
        t,
        {name: differentiate(q, t)[:, 3] / deg for name, q in rows.items()},
        xlabel="t, s",
        ylabel="speed of joint 4, °/s",
        title="The same speeds",
    )
    for end, away in ((LOW[3], -60), (HIGH[3], 60)):
        left.axhspan(end / deg, end / deg + away, color=AREA)
    left.text(0.1, HIGH[3] / deg + 8, "past the limit")
    fig.tight_layout()
    return fig
