"""Views that open after the guess, for the predictions of this lab."""

from typing import Any

import numpy as np

from robokin import SCARA, ScaraPose, deg, mm
from robokin.show import Sketch, curves, figure
from robokin.show.palette import AREA

from .predictions import BEHIND, MIRRORED, SINE_AT, TURN, areas, bend, lap, sine_angles
from .shared import HIGH, L1, L2, MINUS, distance, shown


def p1_view() -> str:
    lines = ["The tool's angle, by the product of the frames:"]
    for q1, q2, q3 in ((40, 60, -70), (70, 90, -70), (70, 90, -130)):
        angle, axis = SCARA.fk([q1 * deg, q2 * deg, q3 * deg, 0.12]).rotation.as_angle_axis()
        line = f"joints 1 to 3 at {q1}°, {q2}°, {q3}°: {float(angle) * axis[2] / deg:.0f}°"
        lines.append(line)
    return "\n".join(lines).translate(MINUS)


def p2_view() -> str:
    start, goal = TURN
    lines = ["The tool's angle at progress s, from 0 to 1:"]
    for s in (0.25, 0.5, 0.75, 1.0):
        q = start.as_transform().rotation.slerp(goal.as_transform().rotation, s)
        angle, _ = q.as_angle_axis()
        target = start.lerp(goal, s)
        lines.append(
            f"s = {s:.2f}: ScaraPose.lerp {float(target.angle) / deg:.0f}°, "
            f"slerp has turned by {float(angle) / deg:.0f}°"
        )
    return "\n".join(lines)


def elbow_at(q1: float) -> Any:
    """The position of joint 2."""
    return L1 * np.array([np.cos(q1), np.sin(q1)])


def p3_view() -> Any:
    fig = Sketch(
        "From above: the two elbows of one target are mirror images in the line from joint 1 to "
        "the target. The first links make the same angle with that line, on either side of it.",
        title="Mirror images in the line to the target",
    )
    target = MIRRORED
    rows = SCARA.ik(ScaraPose([*target, 100 * mm]))
    for row, dashed in zip(rows, (False, True), strict=True):
        fig.levers(np.array([np.zeros(2), elbow_at(row[0]), target]), dashed=dashed)
    fig.length([0, 0], target, "d")
    towards = np.pi / 4
    fig.angle([0, 0], towards, rows[0, 0], shown(towards - rows[0, 0]), radius=80 * mm)
    fig.angle([0, 0], towards, rows[1, 0], shown(rows[1, 0] - towards), radius=80 * mm)
    return fig


def p4_view() -> Any:
    q2, corner, sine = sine_angles(SINE_AT)
    fig = Sketch(
        "A target 130 mm from joint 1. With the right angle the second link ends at the target, "
        "with the angle from the arcsine it ends next to it.",
        title="With the arcsine (dashed) the arm misses the target",
    )
    for inside, dashed in ((corner, False), (sine, True)):
        joint_2 = elbow_at(-inside)
        end = joint_2 + L2 * np.array([np.cos(q2 - inside), np.sin(q2 - inside)])
        fig.levers(np.array([np.zeros(2), joint_2, end]), dashed=dashed)
    fig.point([SINE_AT, 0], "target", away=(1, 0))
    fig.ax.set(xlim=(-220, 260))
    return fig


def p5_view() -> Any:
    fig = Sketch(
        "From above: a place behind the arm and both elbows. The first link of elbow +1 is "
        "between the stops of joint 1, that of elbow −1 (dashed) is in the shaded sector beyond "
        "them.",
        title="The first link cannot enter the shaded sector",
    )
    closed = np.linspace(HIGH[0], 2 * np.pi - HIGH[0], 40)
    x, y = 230 * np.cos(closed), 230 * np.sin(closed)
    fig.ax.fill([0, *x], [0, *y], color=AREA, zorder=0)
    fig.ax.text(-130, 35, "past the stops\nof joint 1", ha="center", va="center")
    target = BEHIND.position[:2]
    for q, dashed in zip(SCARA.ik(BEHIND), (False, True), strict=True):
        joint_2 = elbow_at(q[0])
        fig.levers(np.array([np.zeros(2), joint_2, target]), dashed=dashed)
        fig.point(joint_2, "elbow −1" if dashed else "elbow +1", away=joint_2)
    fig.point(target, "target", away=(-1, 0))
    fig.ax.set(xlim=(-420, 120))
    return fig


def p6_view() -> str:
    lines = ["Distance of the tool from joint 1:"]
    for q2 in (0, 90, 120, 150, 180):
        lines.append(f"q2 = {q2}°: {distance(q2 * deg) / mm:.1f} mm")
    return "\n".join(lines)


def p7_view() -> str:
    lines = ["Area that the tool reaches, elbow +1 alone and both elbows together:"]
    for a, most in ((140, 150), (150, 150), (140, 160)):
        one, both = areas(a * deg, most * deg)
        lines.append(f"stops ±{a}° and ±{most}°: {one:.0f} cm² and {both:.0f} cm²")
    return "\n".join(lines)


def p8_view() -> Any:
    fig = figure(
        "Joint 3 along the circle for both elbows: with elbow −1 it starts at a larger angle and "
        "ends beyond 400°.",
        height=3.4,
    )
    ax = fig.subplots()
    degrees = np.linspace(0, 360, 361)
    curves(
        ax,
        degrees,
        {f"elbow {elbow:+d}".translate(MINUS): lap(elbow) / deg for elbow in (+1, -1)},
        xlabel="angle on the circle, °",
        ylabel="joint 3, °",
        title="One turn of the tool, two elbows",
    )
    ax.axhspan(HIGH[2] / deg, 450, color=AREA)
    ax.text(8, 425, "past the limit", va="center")
    ax.set_ylim(-80, 450)
    ax.legend(loc="lower right")
    fig.tight_layout()
    return fig


def p9_view() -> str:
    lines = ["Joint 2, elbow +1:"]
    for start in (300, 400, 420, 430, 440):
        change = bend(start) - bend(start + 10)
        lines.append(f"from {start} to {start + 10} mm: {change:.1f}°")
    return "\n".join(lines)
