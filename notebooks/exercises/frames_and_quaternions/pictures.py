"""The views that open after the guess, for the predictions of this lab."""

from typing import Any

import numpy as np

from robokin import Quaternion, Transform, deg, mm
from robokin.show import curves, figure, plot_frames
from robokin.show.palette import FIRST, REMARK, SECOND

from .predictions import NUMBERS, SHIFT, TURN, S, nlerp, p4, p5, p7, p8, speed, told
from .shared import MINUS, X, Z, arc


def p1_view() -> Any:
    frame = Transform(Quaternion.from_angle_axis(90 * deg, Z), np.array([200, 0, 0]) * mm)
    tip = Transform(frame.rotation, frame @ (100 * mm * X))
    return plot_frames(
        [frame, tip],
        names=["the rotated frame", "moved point"],
        size=60 * mm,
        title="The point is 100 mm along the x axis of the rotated frame",
    )


def p2_view() -> Any:
    fig = figure(
        f"Two lines of {SHIFT:.0f} mm from the base, {TURN:.0f} degrees apart, and the chord "
        "between their ends. The three are a triangle with two equal sides.",
        height=3.4,
    )
    ax = fig.subplots()
    tip = SHIFT * np.array([np.cos(TURN * deg), np.sin(TURN * deg)])
    ax.plot([0, SHIFT], [0, 0], color=SECOND, lw=3, ls="--")
    ax.plot([0, tip[0]], [0, tip[1]], color=FIRST, lw=3)
    ax.plot([SHIFT, tip[0]], [0, tip[1]], color=REMARK, lw=1.5, ls=":")
    ax.annotate("shift, then rotation", (SHIFT, 0), (8, 0), textcoords="offset points")
    ax.annotate("rotation, then shift", (tip[0], tip[1]), (8, 0), textcoords="offset points")
    chord = float(np.hypot(*(tip - [SHIFT, 0])))
    ax.annotate(
        f"{chord:.0f} mm",
        (0.5 * (tip[0] + SHIFT), 0.5 * tip[1]),
        (8, 0),
        textcoords="offset points",
    )
    ax.set(
        title=f"The two origins are the ends of a chord of {chord:.0f} mm",
        xlabel="x, mm",
        ylabel="y, mm",
        aspect="equal",
        xlim=(-120, 520),
        ylim=(-30, 330),
    )
    fig.tight_layout()
    return fig


def p3_view() -> Any:
    tool = Transform(Quaternion.from_angle_axis(90 * deg, Z), np.array([400, 0, 300]) * mm)
    return plot_frames(
        [tool],
        names=["tool"],
        size=110 * mm,
        title="Seen from the tool, the base is along the green axis, and below",
    )


def p4_view() -> str:
    lines = ["If one number of the link changes a little, does the next joint axis move?"]
    for name in NUMBERS:
        stays = name in p4()["free"]
        lines.append(f"{name}: {'no' if stays else 'yes'}")
    return "\n".join(lines)


def p5_view() -> Any:
    first = Quaternion.from_angle_axis(90 * deg, Z)
    both = first @ Quaternion.from_angle_axis(90 * deg, X)
    facts = p5()
    places = np.array([[250, 0, 0], [500, 0, 0]]) * mm
    return plot_frames(
        [Transform(first, places[0]), Transform(both, places[1])],
        names=["after hinge 1", "after hinge 2"],
        size=100 * mm,
        title="Each axis takes the place of the next: one rotation by "
        f"{facts['angle']:.0f}° about the diagonal",
    )


def p6_view() -> str:
    lines = ["Rotations about z and their quaternions (w, x, y, z):"]
    for angle in (0, 90, 180, 270, 360, 720):
        q = np.array([np.cos(angle * deg / 2), 0, 0, np.sin(angle * deg / 2)])
        lines.append(f"{angle}°: {told(q, 2)}")
    return "\n".join(lines)


def p7_view() -> str:
    least = p7()["least"]
    return (
        "w² + x² + y² + z² = 1. The mean of the four squares is 1/4, and the largest square is not "
        f"below the mean.\nWe tried 4000 unit quaternions, among them one with four equal "
        f"components: in none is the largest component below {least:.2f}. The one with four equal "
        "components is a rotation about the diagonal of a cube."
    )


def p8_view() -> Any:
    ratio = p8()["ratio"]
    fig = figure(
        "The angular speed over s for a half turn. Slerp stays at 180 degrees per unit of s. Nlerp "
        f"rises to {ratio:.1f} times its value at the ends, and falls again.",
        height=3.2,
    )
    ax = fig.subplots()
    curves(
        ax,
        S,
        {name: speed(lead, np.pi) / deg for name, lead in (("slerp", arc), ("nlerp", nlerp))},
        xlabel="s",
        ylabel="angular speed, ° per unit of s",
        title=f"In the middle, nlerp is {ratio:.1f} times as fast as at the ends",
    )
    ax.set_ylim(0, 270)
    fig.tight_layout()
    return fig


def p9_view() -> str:
    a, b = Quaternion.identity().wxyz, Quaternion.from_angle_axis(60 * deg, Z).wxyz
    lines = ["The angle by which the frame has rotated about z, towards b and towards −b:"]
    for s in (0, 0.25, 0.5, 0.75, 1):
        short, far = (2 * np.arctan2(q[3], q[0]) / deg for q in (arc(a, b, s), arc(a, -b, s)))
        lines.append(f"s = {s:g}: {short:.0f}° and {far:.0f}°")
    return "\n".join(lines).translate(MINUS)
