"""Views that open after the guess, for the predictions of this lab."""

from typing import Any

import numpy as np

from robokin import IRB140, deg, explain, mm
from robokin.show import curves, figure, plot_joints, plot_postures
from robokin.show.palette import INK

from .predictions import (
    CENTRE_Q,
    JOINT_6,
    LEAST,
    WRIST_Q,
    arcsin_miss,
    away_pose,
    moved,
    p4,
    p7,
    p8,
    p10,
    signed,
    task_1,
    texts_of,
)
from .shared import L4, Z


def p1_view() -> Any:
    bent = np.zeros((41, 6))
    bent[:, 4] = np.linspace(0, 45, 41) * deg
    return plot_postures(IRB140, bent, title="Joint 5 swings the flange on an arc of radius 65 mm")


def p2_view() -> str:
    lines = ["How far the point and the flange's origin move when one joint turns by 90°:"]
    for k in range(3, 6):
        point, flange = (moved(CENTRE_Q, k, 90 * deg, at) for at in (-L4 * Z, 0 * Z))
        lines.append(f"joint {k + 1}: the point by {point:.1f} mm, the flange by {flange:.1f} mm")
    return "\n".join(lines)


def p3_view() -> Any:
    rows = IRB140.ik(away_pose())[[IRB140.branch(+1, 1, 1), IRB140.branch(-1, 1, 1)]]
    title = f"Joint 1 at {signed(rows[0, 0])} and at {signed(rows[1, 0])}: one plane, two fronts"
    return plot_postures(IRB140, rows, title=title)


def p4_view() -> str:
    facts, lines = p4(), ["q4, q5, q6, and how far the orientation is from that of the target:"]
    goal = IRB140.fk(WRIST_Q).rotation
    for wrist in (WRIST_Q[3:], *facts["options"].values()):
        got = IRB140.fk(np.array([*WRIST_Q[:3], *wrist])).rotation
        lines.append(f"{texts_of(wrist)}: {float(goal.angle_to(got)) / deg:.1f}° off")
    return "\n".join(lines)


def p6_view() -> str:
    pose = IRB140.fk(np.zeros(6))
    rows, lines = IRB140.ik(pose), ["The rows of ik at the home pose, q1 to q6:"]
    lines += [f"row {k}: {texts_of(row)}" for k, row in enumerate(rows)]
    lines.append(explain(IRB140, pose, 0))
    for q4 in (20, 110):
        q = np.array([0, 0, 0, q4, 0, -q4]) * deg
        off = abs(IRB140.fk(q).as_matrix() - pose.as_matrix()).max()
        lines.append(f"{texts_of(q)} reaches the same pose: {off < 1e-12}")
    return "\n".join(lines)


def p7_view() -> Any:
    t, q, _ = task_1()
    facts = p7()
    title = f"Flags 1, 1, 1: inside every limit from {facts['last']:.2f} s on"
    return plot_joints(IRB140, t, q, title=title)


def p8_view() -> str:
    facts = p8()
    return (
        f"A joint turns at {facts['true']:.3f} rad/s through half a turn.\n"
        f"Step 10 ms: the wrapped angle gives {facts['coarse']:.0f} rad/s, the unwrapped one "
        f"{facts['true coarse']:.3f} rad/s.\n"
        f"Step 5 ms: the wrapped angle gives {facts['fine']:.0f} rad/s, the unwrapped one "
        f"{facts['true fine']:.3f} rad/s."
    )


def p9_view() -> Any:
    distance = np.linspace(30.1, 300, 400)
    missed = [arcsin_miss(d * mm) for d in distance]
    fig = figure(
        f"With the arcsine, the wrist centre is off by up to {max(missed):.0f} mm if it is less "
        f"than {LEAST:.0f} mm from joint 2. Farther away, the formula is right.",
        9,
        3.2,
    )
    ax = fig.subplots()
    curves(
        ax,
        distance,
        {"miss": missed},
        xlabel="d, from joint 2 to the wrist centre, mm",
        ylabel="error, mm",
        title=f"Below {LEAST:.0f} mm, the arcsine is wrong without a warning",
    )
    ax.axvline(LEAST, color=INK, lw=1, ls="--")
    ax.text(LEAST + 4, 45, "shoulder angle 90°")
    ax.set(xlim=(0, 300), ylim=(0, 65))
    fig.subplots_adjust(bottom=0.18)
    return fig


def p10_view() -> str:
    lines = [f"Values inside the limits that give the same posture as {p10()['q6']}:"]
    for k, (low, high) in enumerate(IRB140.limits):
        values = JOINT_6 + 2 * np.pi * np.arange(-5, 6)
        inside = [signed(float(x)) for x in values if low <= x <= high]
        lines.append(
            f"joint {k + 1}, {signed(low)} to {signed(high)}: {len(inside)} ({', '.join(inside)})"
        )
    return "\n".join(lines)
