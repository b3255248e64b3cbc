"""Views that open after the guess, for the predictions of this lab."""

from typing import Any

import numpy as np

from robokin import deg, mm
from robokin.jobs.steppers import shortest_turn, station_postures
from robokin.show import JOINT_STYLES, figure
from robokin.show.palette import INK
from robokin.show.paths_explorer import LOOKS

from .predictions import geared, p1, p3, p4, p5, p6, p9, path, random_moves
from .shared import LOADER


def p1_view() -> Any:
    facts = p1()
    t = np.linspace(0, 4, 401)
    points = np.stack([200 - 100 * t, 0 * t + facts["beside"], 0 * t + 300], axis=-1) * mm
    alpha = station_postures(LOADER, points)[:, 0] / deg
    says = (
        f"Joint 1 over time. It turns by {facts['turned']:.0f} degrees, "
        f"{np.ptp(alpha[150:251]):.0f} of them in the second in the middle, where the gripper "
        "passes the vertical axis."
    )
    fig = figure(says, 6.4, 3.2)
    ax = fig.subplots()
    ax.plot(t, alpha, color=JOINT_STYLES[0]["color"], lw=2.4)
    ax.set(xlabel="time, s", ylabel="α, °", yticks=range(0, 181, 45))
    ax.set_title(f"Beside the axis, joint 1 turns at up to {facts['most']:.0f}°/s")
    fig.tight_layout()
    return fig


def p2_view() -> Any:
    told, at = [], 170.0
    for to in (-170, -60):
        turn = float(shortest_turn(at * deg, to * deg)) / deg
        told.append(f"From {at:.0f}°: the turn is {turn:+.0f}°, and ends at {at + turn:.0f}°.")
        at += turn
    return "\n".join(told)


def p3_view() -> Any:
    facts = p3()
    lines = ("the whole arm", "the same arm, with steps four times as fine", "lever B")
    return "\n".join(
        f"Half a pulse of motor {k}, which turns {line}: {facts[f'm{k}']:.3f} mm at the gripper."
        for k, line in enumerate(lines, 1)
    )


def p4_view() -> Any:
    slow = p4()["quarter"]
    return (
        f"Motor 1: 1200 pulses at 500 pulses/s take {1200 / 500:.1f} s.\n"
        f"Motor 2: 300 pulses at {slow:.0f} pulses/s take {300 / slow:.1f} s.\n"
        "Motor 3 does not move."
    )


def p5_view() -> Any:
    a, d = p5()["a"], p5()["d"]
    says = (
        f"Seen from above: with the other gears path a is {a:.0f} mm long and cuts inside, path d "
        f"is {d:.0f} mm long."
    )
    fig = figure(says, 5.4, 4.2)
    ax = fig.subplots()
    for name, move in geared().items():
        color, dash = LOOKS[name]  # as in the views of the lab
        way = path(move)
        ax.plot(way[:, 0], way[:, 1], dash, color=color, lw=2.2)
        x, y, _ = way[500]
        ax.text(x + 15, y, name, color=color, fontsize=14, fontweight="bold")
    ax.plot(0, 0, "+", color=INK, ms=12)
    ax.set(xlabel="x, mm", ylabel="y, mm", aspect="equal")
    ax.set_title(f"Seen from above: a {a:.0f} mm, d {d:.0f} mm")
    fig.tight_layout()
    return fig


def p6_view() -> Any:
    facts = p6()
    return (
        f"The controller counts {facts['counted']} pulses. The motor is at "
        f"{facts['stands']}: {facts['off']} pulses below that, as before the second move."
    )


def p7_view() -> Any:
    off, _ = random_moves()
    most = abs(off).max()
    says = (
        "The errors of three motors over 10 000 random moves, each rounded separately: they "
        f"wander, by up to {most:.0f} pulses."
    )
    fig = figure(says, 6.4, 3)
    ax = fig.subplots()
    for i, column in enumerate(off.T):
        color = JOINT_STYLES[i]["color"]
        ax.plot(column[::20], color=color, lw=1.4)
        ax.text(505, column[-1], f"motor {i + 1}", color=color, va="center")
    thousands = [f"{20 * k:,}".replace(",", " ") for k in range(0, 501, 100)]
    ax.set(xlabel="moves", ylabel="error, pulses", xlim=(0, 580))
    ax.set_xticks(range(0, 501, 100), thousands)
    ax.set_title(f"The errors wander, by up to {most:.0f} pulses")
    fig.tight_layout()
    return fig


def p9_view() -> Any:
    facts = p9()
    return (
        f"Twelve half steps turn the field by 12 × 45° = {facts['field']:.0f}°, which is one and "
        f"a half turns. The rotor turns by 1/50 of that: {facts['rotor']:.1f}°, or 12 × 0.9°."
    )
