"""Views that open after the guess, for the predictions of this lab."""

from typing import Any

import numpy as np

from robokin import PUMA560, deg, differentiate, mm
from robokin.show import Sketch, curves, figure, plot_velocity_ellipsoid
from robokin.show.palette import AREA, COMPARED, FIRST, SECOND

from . import predictions as of
from .shared import D3, FORE, HIGH, LOW, OFFSET, UPPER


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
    ax.set(xlabel="rows inside the limits", ylabel="fraction of the poses, %", xticks=range(9))
    title = f"{shares[0]:.0f} % of the poses in reach have no usable row"
    ax.set(ylim=(0, 1.2 * shares.max()), title=title)
    fig.tight_layout()
    return fig


def p2_view() -> Any:
    facts = of.p2()
    fig = figure(
        "The two values of joint 1 against the distance of the wrist centre from axis 1. At 800 mm "
        f"they differ by {np.ptp(of.waists(800 * mm)):.0f} degrees, at {facts['rho']:.0f} mm by "
        f"{facts['turn']:.0f} degrees, at {D3 / mm:.2f} mm they coincide.",
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
    ax.set(yticks=range(0, 181, 30), title="At the offset, the two values coincide")
    fig.tight_layout()
    return fig


def p9_view() -> Sketch:
    facts, (_, q2, q3, *_) = of.p9(), np.array(of.NAMED) * deg
    gamma = q3 + OFFSET
    elbow = UPPER * np.array([np.cos(q2), np.sin(q2)])
    wrist = elbow + FORE * np.array([np.cos(q2 + gamma), np.sin(q2 + gamma)])
    sketch = Sketch(
        "The arm from the side: the upper arm leans back a little and the forearm points back, so "
        f"that r is {facts['r']} mm at the wrist centre. The elbow is above the line from the "
        "shoulder to the wrist centre.",
        title=f"{facts['right']}: r < 0, elbow above the line",
        x="r",
        y="h",
        width=6,
        height=4,
    )
    sketch.levers([np.zeros(2), elbow, wrist], ["shoulder", "elbow", "wrist centre"])
    sketch.length((0, 0), wrist)
    sketch.ax.margins(x=0.5)  # so that the names are inside the frame
    return sketch


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
    left.set(ylim=(10, 1e5), title="The joint speed depends on the direction")
    right.set(xlabel="distance m, mm", ylabel="distance from singularity")
    right.set(title="The distance from singularity does not")
    right.legend(fontsize=9)
    fig.tight_layout()
    return fig


def p7_view() -> str:
    lines = [
        f"{of.PAIRS} lines join random poses: the wrist centre is spread evenly over the box",
        "around the reach of the stretched arm, and the orientation over all rotations.",
        f"On {of.p7()['lines']} of them all eight rows exist and at least one stays inside the "
        "limits to the end.",
        "A rule for the first pose fails on this fraction of them (the program is under More):",
    ]
    lines += [f"{name}: {of.p7()[f'rule{k}']:.0f} %" for k, name in enumerate(of.RULES)]
    return "\n".join(lines)


def p5_view() -> Any:
    facts = of.p5()
    sigmas = " and ".join(f"{facts[f'sigma_{k}']:.4f}" for k in ("both", "one"))
    return plot_velocity_ellipsoid(
        PUMA560,
        np.array(of.NEAR) * deg,
        title=f"Velocities of the flange in A (posture 1) and B: σ = {sigmas}",
    )


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
