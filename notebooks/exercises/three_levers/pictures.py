"""Views that open after the guess, for the predictions of this lab."""

from typing import Any

import numpy as np

from robokin import deg
from robokin.show import Sketch, curves, figure
from robokin.show.palette import AREA, FAINT, FIRST_AREA, INK, PAPER, SECOND, SOFT

from . import predictions as of
from .shared import ARM, K, direction


def panels(alt: str, count: int = 1, height: float = 3.5, **keywords: Any) -> tuple[Any, Any]:
    """A figure with a row of plots in a tight layout: the figure, and the plot or plots."""
    fig = figure(alt, height=height)
    fig.set_layout_engine("tight")
    return fig, fig.subplots(1, count, **keywords)


def p1_view() -> Any:
    alpha = of.BENT[2] / deg
    sketch = Sketch(
        "The upright arm is dashed, the bent one solid: the last lever has turned to the right by "
        "60 degrees; the angle inside, between AB and AK, is 120 degrees.",
        title=f"An interior angle of {alpha:.0f}° is a turn of {180 - alpha:.0f}° to the right",
        unit="m",
        height=3.8,
    )
    sketch.levers(ARM.points(of.UPRIGHT), dashed=True)
    sketch.levers(ARM.points(of.BENT), ["O", "B", "A", "K"])
    sketch.angle(ARM.points(of.BENT)[2], 270 * deg, 390 * deg, "α = 120°", radius=0.3)
    sketch.ax.set_xlim(-2.5, 3.5)
    return sketch


def p2_view() -> Any:
    KO = np.linspace(1, 3, 401)
    low = ARM.alpha_range(np.stack([KO, 0 * KO], axis=-1), limited=False)[0] / deg
    fig, ax = panels(
        "The angles alpha that reach K, against the distance KO: from 0 to 180 degrees at 1 m, "
        "only 180 degrees at 3 m.",
        height=3.4,
    )
    ax.fill_between(KO, low, 180, color=FIRST_AREA, linewidth=0)
    for at in (of.NEAR, of.FAR):
        ax.plot([at, at], [180 - of.width(at), 180], color=INK, lw=2)
        told = f"{of.width(at):.1f}°"
        ax.annotate(told, (at, 150), (-6, 0), textcoords="offset points", ha="right")
    ax.set(xlabel="distance KO, m", ylabel="free angle α, °", xlim=(1, 3), ylim=(0, 182))
    ax.set_title("The farther away K is, the smaller its family")
    return fig


def p3_view() -> Any:
    low, high = ARM.alpha_range(K)
    alphas = np.linspace(low, high, 241)
    family = ARM.family(K, alphas) / deg
    fig, (left, right) = panels(
        "Left: nine postures of the family, the symmetric one in bold. Right: beta falls and "
        "gamma grows with alpha; beta and alpha are equal at one point.",
        count=2,
        height=3.7,
        width_ratios=[1, 1.15],
    )
    for a in np.linspace(low, high, 9):
        left.plot(*ARM.points(ARM.family(K, a)).T, "o-", color=FAINT, markersize=4, lw=1.3)
    same = of.p3()["trapezoid"]
    left.plot(*ARM.points(ARM.family(K, same * deg)).T, "o-", color=INK, markersize=6, lw=3)
    left.set(aspect="equal", xlabel="x, m", ylabel="y, m", title="Three equal sides: a trapezoid")
    curves(
        right,
        alphas / deg,
        dict(zip("γβα", family.T, strict=True)),
        joints=range(3),
        xlabel="free angle α, °",
        ylabel="γ, β, α, °",
        title="β = α at one point",
    )
    right.plot(same, same, "o", color=INK, markersize=7)
    right.annotate(f"{same:.1f}°", (same, same), (12, -3), textcoords="offset points")
    return fig


def p4_view() -> Any:
    sketch = Sketch(
        "K moves on an arc from 30 to 130 degrees. With arctan2, the gripper stays on it. With "
        "arctan of the quotient, it leaves the arc at 90 degrees and jumps to the opposite side "
        "of O.",
        title="Once K has passed 90°, arctan(y / x) turns the arm by 180° (dashed)",
        unit="m",
        height=4.8,
    )
    arc = of.RING * direction(np.linspace(30, 130, 101) * deg)
    sketch.ax.plot(*arc.T, color=SOFT, lw=1.4)
    sketch.ax.plot(*-arc[61:].T, color=SOFT, lw=1.4, ls="--")
    q = ARM.family(arc[80], of.SAMPLE)
    sketch.levers(ARM.points(q - [np.pi, 0, 0]), dashed=True)
    sketch.levers(ARM.points(q), list("OBAK"))
    sketch.point(-arc[80], "gripper", away=(1, 0))
    sketch.ax.set_xlim(-3.5, 3.5)
    return sketch


def p5_view() -> Any:
    phi = np.linspace(0, 180, 721)
    ring = of.BEHIND_KO * direction(phi * deg)
    every, kept = (np.array(ARM.alpha_range(ring, limited=flag)) / deg for flag in (False, True))
    fig, ax = panels(
        "The range of alpha for targets 2 m away, against their direction. Up to about 104 degrees "
        "all of it is usable; then less and less, and from about 151 degrees on none of it.",
        height=3.4,
    )
    ax.fill_between(phi, *every, facecolor=AREA, edgecolor=SOFT, hatch="//", linewidth=0)
    ax.fill_between(phi, *kept, color=FIRST_AREA, linewidth=0)
    ax.text(30, 125, "usable", fontweight="bold")
    box = {"facecolor": PAPER, "edgecolor": "none", "alpha": 0.9}
    ax.text(128, 160, "γ above 180°", bbox=box)
    ax.axvline(of.BEHIND, color=INK, lw=1)
    ax.set(xlabel="direction of K seen from O, °", ylabel="α, °", xlim=(0, 180), ylim=(60, 182))
    ax.set_title(f"{of.BEHIND_KO:g} m from the base: behind the arm the family disappears")
    return fig


def p6_view() -> Any:
    before, target = ARM.family(K, 100 * deg), K + [0.1, 0.0]
    exact, S = ARM.least(target, before)
    alphas = np.linspace(*ARM.alpha_range(target), 2001)
    change = abs(ARM.family(target, alphas) - before) / deg
    fig, ax = panels(
        "The changes of gamma, beta and alpha and their sum S against alpha, near the least S. "
        "Each change is a V that touches 0 where this angle stays; S has its least value at one "
        "of these points.",
        height=3.7,
    )
    stays = "γβα"[int(np.argmin(abs(exact - before)))]
    curves(
        ax,
        alphas / deg,
        dict(zip("γβα", change.T, strict=True)),
        joints=range(3),
        xlabel="α, °",
        ylabel="change, °",
        title=f"S is least where {stays} stays as it was",
    )
    ax.plot(alphas / deg, change.sum(axis=-1), color=INK, lw=2.4)
    ax.plot(exact[2] / deg, S / deg, "D", color=INK, markersize=7)
    ax.text(117, change.sum(axis=-1)[abs(alphas / deg - 117).argmin()] + 1.5, "S", ha="right")
    ax.set(xlim=(86, 121), ylim=(0, 45))
    return fig


def p7_view() -> Any:
    target, before = np.array([1.8, 0.5]), np.array([100, 110, 120]) * deg
    exact, S = ARM.least(target, before)
    above = [(ARM.sweep(target, before, step * deg)[1] - S) / deg for step in (of.COARSE, of.FINE)]
    fig, axes = panels(
        "S near its least value is a V. The rows of a sweep with a step of 1 degree and with a "
        "tenth of it lie on both sides of the tip. The best ones are "
        f"{above[0]:.2f} and {above[1]:.3f} degrees above it.",
        count=2,
    )
    for ax, step in zip(axes, (of.COARSE, of.FINE), strict=True):
        near = exact[2] + np.linspace(-1.8, 1.8, 801) * step * deg
        curve = abs(ARM.family(target, near) - before).sum(axis=-1) / deg
        ax.plot(near / deg, curve, color=INK, lw=1.6)
        rows = ARM.table(target, step * deg)
        rows = rows[abs(rows[:, 2] - exact[2]) < 1.8 * step * deg]
        ax.plot(rows[:, 2] / deg, abs(rows - before).sum(axis=-1) / deg, "o", color=SECOND)
        ax.plot(exact[2] / deg, S / deg, "D", color=INK, markersize=7)
        ax.ticklabel_format(useOffset=False)
        ax.locator_params(axis="x", nbins=5)
        ax.set(xlabel="α, °", ylabel="S, °", title=f"rows {step:g}° apart, ◆ exact")
    return fig


def p8_view() -> Any:
    alphas = np.linspace(*ARM.alpha_range(of.TARGET), 801)
    change = abs(ARM.family(of.TARGET, alphas) - of.STAND) / deg
    least = [alphas[each.argmin()] / deg for each in (change.sum(axis=-1), change.max(axis=-1))]
    fig, ax = panels(
        "The sum of the changes and the largest of them against alpha: the sum is least at "
        f"{least[0]:.0f} degrees, the largest at {least[1]:.0f} degrees."
    )
    both = {
        "S, the sum": change.sum(axis=-1),
        "the largest turn: the time": change.max(axis=-1),
    }
    curves(
        ax,
        alphas / deg,
        both,
        xlabel="α, °",
        ylabel="change, °",
        title=f"Least sum at α = {least[0]:.0f}°, least time at {least[1]:.0f}°",
    )
    for at, curve in zip(least, both.values(), strict=True):
        ax.plot(at, curve.min(), "D", color=INK, markersize=7)
    return fig


def p9_view() -> Any:
    lost, facts = 100 * np.sort(np.maximum(of.losses(), 0))[::-1], of.p9()
    fig, ax = panels(
        "How much more the greedy arm turns on each list, sorted: a few high bars, then a long "
        "row with almost no difference.",
        height=3.2,
    )
    ax.bar(np.arange(1, len(lost) + 1), lost, width=1.0)
    ax.axhline(5, color=INK, lw=1, ls="--")
    ax.set(xlabel="lists of targets, sorted", ylabel="more turns, %")
    ax.set_title(
        f"On {facts['count']} of {facts['tours']} lists the greedy arm turns over 5 % more"
    )
    return fig


def p10_view() -> Any:
    facts = of.p10()
    fig, ax = panels(
        f"The turns of all joints, added up over {facts['tasks']} tasks, for three rules. All "
        "rise evenly; random choice is the steepest, equal angles and least movement are close.",
        height=3.4,
    )
    curves(
        ax,
        np.arange(facts["tasks"] + 1),
        {name: np.append(0, np.cumsum(each)) for name, each in of.turns().items()},
        xlabel="tasks done",
        ylabel="turns in all, °",
        title=f"Random choice turns the joints {facts['percent']:.0f} % more than least movement",
    )
    return fig
