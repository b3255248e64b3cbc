"""Views that open after the guess, for the predictions of this lab."""

from math import pi
from typing import Any

import numpy as np

from robokin import deg, ptp
from robokin.jobs.visit_collect import Task, best_visit, principal_postures, visit
from robokin.show import Sketch, curves, figure
from robokin.show.palette import INK, SOFT

from .predictions import DIP, LOW1, p1, p2, p3, p7, p8
from .shared import ARM, FOUR, L1, L2

SIDE: dict[str, Any] = {"unit": "m", "x": "distance from the axis", "y": "height"}


def p1_view() -> Any:
    says = (
        f"Side view at q1 = q2 = 90 degrees and q3 = 0: link 1 lies flat, {L1:g} m long, link 2 "
        f"hangs from its end, and the tool is {p1()['z']:g} m under the floor."
    )
    title = "Link 1 lies flat, and link 2 hangs down"
    sketch = Sketch(says, title=title, **SIDE | {"x": "y", "height": 3.6})
    sketch.levers([(0, 0), (L1, 0), (L1, -L2)], ["O1", "O2", "tool"])
    sketch.ax.axhline(0, color=SOFT, lw=1, zorder=1)
    sketch.ax.margins(0.22)
    return sketch


def p2_view() -> Any:
    q3 = p2()["q3"]
    says = f"The stretched arm, flat: link 2 is {abs(q3):.0f} degrees above its position at q3 = 0."
    title = f"Stretched: link 2 is {abs(q3):.0f}° above its position at q3 = 0"
    sketch = Sketch(says, title=title, height=3.6, **SIDE)
    sketch.levers([(0, 0), (L1, 0), (L1 + L2, 0)], ["O1", "", "tool"])
    sketch.ax.text(L1, 0.25, "O2", ha="center", fontsize=12)
    sketch.levers([(0, 0), (L1, 0), (L1, -L2)], dashed=True)
    sketch.angle((L1, 0), -pi / 2, 0, "−q3", radius=1.5)
    return sketch


def p3_view() -> Any:
    shares = p3()["shares"]
    says = (
        f"Bars: of the points within 1 m of the axis, {shares[0]:.0f} percent have a second "
        f"posture inside the limits, of those farther than 8 m {shares[-1]:.0f} percent."
    )
    fig = figure(says, height=3)
    ax = fig.subplots()
    ax.bar(np.arange(9) + 0.5, shares, width=0.92)
    ax.set_title("The nearer to the axis, the easier it is to lean over backwards")
    ax.set(xlabel="distance from axis 1, m", ylabel="points with a second posture, %")
    ax.set(xlim=(0, 9), ylim=(0, 105))
    fig.tight_layout()
    return fig


def p4_view() -> Any:
    q = principal_postures(L1, L2, [[-2, 0.01, 2], [-2, -0.01, 2]])[:, 0]
    turned = (q[0] - q[1]) / deg
    says = (
        f"Seen from above: joint 1 turns from {q[0] / deg:.1f} to {q[1] / deg:.1f} degrees, away "
        f"from the stop at 180 degrees and all the way round, {turned:.0f} degrees."
    )
    title = f"Joint 1 turns away from its stop and goes round, {turned:.0f}°"
    sketch = Sketch(says, title=title, unit="m", height=3.6)
    sketch.levers([(0, 0), (-2, 0.01)], ["axis 1", ""])
    turn = np.linspace(q[0], q[1], 200)
    sketch.ax.plot(np.cos(turn), np.sin(turn), color=INK, lw=1.3)
    tip = {"arrowstyle": "-|>", "color": INK}
    sketch.ax.annotate("", (-1, -0.02), (-0.985, -0.17), arrowprops=tip)
    sketch.ax.text(-2.1, 0.15, "both points", ha="right")
    sketch.ax.text(-2.1, -0.25, "stop at ±180°", ha="right")
    sketch.ax.text(0.85, 0.85, "joint 1")
    sketch.ax.set(xlim=(-4, 2), ylim=(-1.3, 1.4))
    return sketch


def p5_view() -> Any:
    return (
        "With prices: objects of 5, 5 and 9 s, and T = 10 s. The two cheapest fit. At prices of 1, "
        "1 and 10 they bring 2, but the third object alone brings 10. Different speeds only "
        "replace 5, 5 and 9 s by other numbers, and the proof holds for any numbers."
    )


def p6_view() -> Any:
    times = np.linspace(0, 20, 401)
    tasks = [Task(L1, L2, T, [0.2] * 3, [4, 0, 2], FOUR, "visit") for T in times]
    few, many = ([len(rule(task).order) for task in tasks] for rule in (visit, best_visit))
    last = max(T for T, count in zip(times, few, strict=True) if count == 1)
    early = min(T for T, count in zip(times, many, strict=True) if count == 3)
    fig = figure(
        f"Points touched within T: the best order touches three from {early:.1f} s on; nearest "
        f"first touches only one up to {last:.1f} s.",
        height=2.8,
    )
    ax = fig.subplots()
    curves(
        ax,
        times,
        {"nearest first": few, "best order": many},
        xlabel="time allowed T, s",
        ylabel="points touched",
        title="Nearest first loses its time on the way back from the lure",
    )
    fig.tight_layout()
    return fig


def p7_view() -> Any:
    height = p7()["height"]
    says = (
        f"Side view: link 1 lies on the floor behind the axis, link 2 reaches from there to the "
        f"axis, {height:g} m above the origin."
    )
    title = f"The elbow lies on the floor, the tool is {height:g} m above the origin"
    sketch = Sketch(says, title=title, **SIDE)
    sketch.levers([(0, 0), (-LOW1, 0), (0, height)], ["O1", "O2", "tool"])
    sketch.ax.axhline(0, color=SOFT, lw=1, zorder=1)
    sketch.ax.axvline(0, color=SOFT, lw=1, ls=":")
    sketch.ax.text(-0.1, 0.15 * height, "axis 1", ha="right")
    sketch.ax.margins(0.22)
    return sketch


def p8_view() -> Any:
    q = principal_postures(L1, L2, DIP)
    way = ptp(q[0], q[1], np.linspace(0, 1, 200))
    side = ARM.fk(way).translation[:, [0, 2]]
    deep = -p8()["low"]
    says = (
        f"Side view of the move: the arm at its start, dashed, and where its tool is lowest; the "
        f"path of the tool goes {deep:.2f} m under the floor."
    )
    title = f"Between two allowed points: {deep:.2f} m under the floor"
    sketch = Sketch(says, title=title, **SIDE)
    for k, dashed in ((0, True), (int(side[:, 1].argmin()), False)):
        elbow = L1 * np.array([np.sin(way[k, 1]), np.cos(way[k, 1])])
        sketch.levers([np.zeros(2), elbow, side[k]], dashed=dashed)
    sketch.ax.plot(*side.T, color=INK, lw=1.5)
    sketch.ax.axhline(0, color=SOFT, lw=2)
    sketch.ax.text(6.2, -0.3, "floor", color=SOFT)
    sketch.point(DIP[0, [0, 2]], "start", away=(1, 0))
    sketch.point(DIP[1, [0, 2]], "goal", away=(1, 1))
    sketch.ax.margins(0.18)
    return sketch
