"""Views that open after the guess, for the predictions of this lab."""

from typing import Any

import numpy as np

from robokin import mm
from robokin.jobs.obstacles import along, in_quadrilateral, via_path
from robokin.show import curves, figure
from robokin.show.palette import (
    AREA,
    FAINT,
    FIRST,
    FIRST_AREA,
    INK,
    PAPER,
    REMARK,
    SECOND,
    SECOND_AREA,
    SOFT,
)

from .predictions import (
    FAR,
    LEVER,
    PASSED,
    SAMPLED,
    SEEN,
    drawings,
    p3,
    p5,
    p6,
    p7,
    p8,
    swept_by_last,
)
from .shared import ARM, K1, START, WANTED, Floats, direct, distances, drawing, sampled


def draw(ax: Any, q: Floats, label: str, **style: Any) -> None:
    points = ARM.points(q)
    ax.plot(*points.T, marker="o", mfc=PAPER, ms=5, lw=2, label=label, **style)


def mark_H(ax: Any, place: Any, away: tuple[float, float] = (7, 4)) -> None:
    """The cross of the obstacle, with its letter."""
    box = {"facecolor": PAPER, "edgecolor": "none", "pad": 0}
    ax.plot(*place, "X", color=INK, ms=9, zorder=6)
    ax.annotate("H", place, away, textcoords="offset points", zorder=6, bbox=box)


def plane(ax: Any, low: tuple[float, float], high: tuple[float, float], title: str) -> None:
    ax.set(aspect="equal", xlim=(low[0], high[0]), ylim=(low[1], high[1]), title=title)
    ax.set(xlabel="x, m", ylabel="y, m")


def p1_view() -> Any:
    fig = figure(
        "The same quadrilateral eight times: turned by 0, 90, 180 and 270 degrees, as drawn and "
        "mirrored. The obstacle is in its middle each time, and the test finds it in the first "
        "only.",
        height=4.6,
    )
    for ax, (name, corners) in zip(fig.subplots(2, 4).flat, drawings().items(), strict=True):
        ax.fill(*corners.T, facecolor=FIRST_AREA)
        for k, (label, color, dash) in enumerate((("AK", FIRST, "-"), ("A1K1", SECOND, ":"))):
            side = corners[[0, 1]] if k == 0 else corners[[3, 2]]
            ax.plot(*side.T, color=color, ls=dash, lw=3, label=label)
        says = drawing(corners, np.zeros(2))
        mark_H(ax, (0, 0))
        ax.text(0, -0.3, "found" if says else "missed", ha="center")
        ax.set(aspect="equal", title=name, xticks=[], yticks=[], xlim=(-0.8, 0.8), ylim=(-0.8, 0.8))
        ax.set(xlabel="x", ylabel="y")
    fig.legend(
        handles=fig.axes[0].get_legend_handles_labels()[0], loc="upper right", ncols=2, fontsize=9
    )
    fig.suptitle("The test finds H in one of the eight drawings")
    fig.tight_layout()
    return fig


STEP = 0.04  # m: between the points that are drawn
GRID = np.stack(np.meshgrid(np.arange(-1.6, 3, STEP), np.arange(-1, 3, STEP)), axis=-1).reshape(
    -1, 2
)


def p2_view() -> Any:
    fig = figure(
        "The area that lever AK sweeps in the longer motion, and the quadrilateral between its "
        "first and its last place: most of the area lies outside.",
        height=3.8,
    )
    ax = fig.subplots()
    start, end = direct(FAR)
    over = swept_by_last(start, end, *(np.unique(each) for each in GRID.T)).ravel()
    quad = in_quadrilateral(ARM, start, end, GRID)["AK"]
    ax.plot(*GRID[over & ~quad].T, "s", ms=3.2, color=SECOND_AREA, label="swept, outside")
    ax.plot(*GRID[over & quad].T, "s", ms=3.2, color=FIRST_AREA, label="swept, inside")
    corners = np.stack([*ARM.points(start)[2:], *ARM.points(end)[:1:-1]])
    ax.fill(*corners.T, facecolor="none", edgecolor=INK, ls="--", label="quadrilateral")
    draw(ax, start, "before", color=INK)
    draw(ax, end, "after", color=SECOND)
    plane(ax, (-1.6, -0.2), (3.6, 2.3), "Most of what AK sweeps lies outside the quadrilateral")
    samples: Any = ax.legend(loc="upper right", fontsize=8).legend_handles
    # as small as in the drawing, the pale squares are hard to see (no loop: a page has a stand-in)
    samples[0].set_markersize(9)
    samples[1].set_markersize(9)
    fig.tight_layout()
    return fig


def p3_view() -> Any:
    fig = figure(
        "A lever from the origin to (1, 0) m. The obstacle is beyond its end: the nearest point "
        "of the lever is the end, half a metre away; the line through the lever is nearer.",
        height=2.6,
    )
    ax = fig.subplots()
    P, Q, H = LEVER
    ax.plot(*np.array([P, Q]).T, color=INK, lw=6, solid_capstyle="round")
    ax.plot([1, 1.6], [0, 0], "--", color=SOFT)
    mark_H(ax, H)
    facts = p3()
    for foot, name, color in ((Q, "end", FIRST), ((H[0], 0), "line", REMARK)):
        ax.annotate(
            "", (foot[0], foot[1]), (H[0], H[1]), arrowprops={"arrowstyle": "<->", "color": color}
        )
        x, y = (np.array(foot) + H) / 2
        side = "right" if name == "end" else "left"
        ax.text(x, y, f"  {facts[name]:.0f} mm  ", color=color, ha=side, va="center")
    plane(ax, (-0.1, -0.15), (1.8, 0.55), "Beyond the end of a lever, its end is the nearest point")
    fig.tight_layout()
    return fig


def p4_view() -> Any:
    fig = figure(
        "Distance of the nearest lever from the obstacle on the whole motion: a valley between "
        f"two of the {SEEN} dots reaches far below all of them.",
        height=3.2,
    )
    ax = fig.subplots()
    path, s = direct(FAR), np.linspace(0, 1, 601)
    fine = distances(sampled(path, 601), SAMPLED).min(axis=-1)
    curves(
        ax,
        100 * s,
        {"nearest lever": fine},
        xlabel="part of the motion, %",
        ylabel="nearest lever, m",
        title="The valley lies between two of the samples",
    )
    dots = distances(sampled(path, SEEN), SAMPLED).min(axis=-1)
    ax.plot(100 * np.linspace(0, 1, SEEN), dots, "o", color=INK, ms=7)
    ax.axhspan(0, WANTED, color=AREA)
    ax.set_ylim(0, None)
    fig.tight_layout()
    return fig


def p5_view() -> Any:
    fig = figure(
        "Sixty moments of the path through two via points. The gripper comes as near to the "
        f"obstacle as {p5()['gripper']:.0f} mm, inside the circle; lever AK sweeps "
        "across it.",
        height=4,
    )
    ax = fig.subplots()
    path = via_path(ARM, START, K1, PASSED)
    for q in along(path, np.linspace(0, 1, 60)):
        ax.plot(*ARM.points(q).T, color=FAINT, lw=0.6, zorder=0)
    draw(ax, path[0], "start", color=INK)
    draw(ax, path[-1], "target", color=SECOND, ls=":")
    ways = ARM.points(along(path, np.linspace(0, 1, 400)))[:, 3]
    ax.plot(*ways.T, color=FIRST, lw=2, label="gripper")
    angle = np.linspace(0, 2 * np.pi, 100)
    ax.plot(PASSED[0] + WANTED * np.cos(angle), PASSED[1] + WANTED * np.sin(angle), color=REMARK)
    mark_H(ax, PASSED, (-24, -4))  # outside the circle
    plane(ax, (-1.2, -0.1), (2.9, 2.2), "The gripper goes round H, but lever AK sweeps across it")
    ax.legend(loc="upper right", fontsize=8)
    fig.tight_layout()
    return fig


def p6_view() -> str:
    facts = p6()
    turns = ", ".join(
        f"{name} {turn:.0f}°" for name, turn in zip("γβα", facts["turns"], strict=True)
    )
    return (
        f"The wave arrives after {facts['count']} steps of 10°. On the path that we follow back, "
        f"the turns are {turns} (both directions counted): together {facts['sum']:.0f}°."
    )


def p7_view() -> str:
    facts = p7()
    return (
        f"Of {facts['count']} tasks, with the circle of {facts['r']:.0f} mm: {facts['keep']} keep "
        f"{facts['wanted']:.0f} mm, {facts['near']} come nearer, {facts['out']} are out of reach."
        f"\nWith the circle of {WANTED / mm:.0f} mm, a lever hits the obstacle in 47 tasks, "
        f"but in 53 no lever does. All {facts['keep']} are among these 53."
    )


def p8_view() -> str:
    facts = p8()
    return (
        f"The wave in steps of {facts['coarse']}°: no path found. Steps of 5°: a path with S = "
        f"{facts['S']:.0f}°, proven on its whole length."
    )
