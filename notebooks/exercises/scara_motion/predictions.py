"""The facts behind the predictions of scara motion.

Objective 1: p1, p2, p3, p6. Objective 2: p4, p7. Objective 3: p5, p8, p9, p10.
"""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np

from robokin import SCARA, ScaraPose, blend, deg, differentiate, lin, mm, ptp
from robokin.units import wrapped

from .shared import GOAL, HIGH, LEVEL, LOW, ROW, START, VIA, S, Shown, T, joints, plus, stroke


def p1() -> Mapping[str, Any]:
    """How much each joint of the LIN changes if the tool starts turned by 45°."""
    turned = ScaraPose(START.position, START.angle + 45 * deg)
    most = abs(joints(lin(turned, GOAL, S)) - joints(lin(START, GOAL, S))).max(axis=0)
    changed = (f"q{i + 1}" for i in range(4) if most[i] > 1e-9)
    return {"most": most[2] / deg, "right": plus(changed)}


@cache
def p2() -> Mapping[str, Any]:
    v = differentiate(joints(lin(START, GOAL, S)), T) / [deg, deg, deg, mm]
    low, high = v.min(axis=0), v.max(axis=0)
    steady = (f"q{i + 1}" for i in range(4) if high[i] - low[i] < 1e-6 * abs(high[i]))
    facts: dict[str, Any] = {"stroke": Shown(v[0, 3]), "right": plus(steady)}
    for i in range(3):
        facts |= {f"low{i + 1}": Shown(low[i]), f"high{i + 1}": Shown(high[i])}
    return facts


@cache
def p3() -> Mapping[str, Any]:
    line = lin(START, GOAL, S)
    q = ptp(SCARA.ik(START)[ROW], SCARA.ik(GOAL)[ROW], S)
    x, y, z = abs(SCARA.fk(q).translation - line.position).max(axis=0)
    apart = {"x": x, "y": y, "z": z, "angle": abs(q[:, :3].sum(axis=-1) - line.angle).max()}
    differ = (name for name, gap in apart.items() if gap > 1e-9)
    return {"x": x / mm, "y": y / mm, "right": plus(differ)}


def behind(x: Any) -> ScaraPose:
    """Goals on the other side of the column, x in mm (section 4)."""
    places = np.stack(np.broadcast_arrays(np.multiply(x, mm), -0.4, 0.2), axis=-1)
    return ScaraPose(places, np.full(np.shape(x), 90 * deg))


@cache
def p4() -> Mapping[str, Any]:
    goal = behind(0)
    line = lin(START, goal, S)
    both = joints(line), ptp(SCARA.ik(START)[ROW], SCARA.ik(goal)[ROW], S)
    bad, even = (((q < LOW) | (q > HIGH)).sum(axis=0) for q in both)
    near = np.linalg.norm(line.position[:, :2], axis=-1).min()
    name = ("neither", "PTP alone", "LIN alone", "both")[2 * bool(bad.any()) + bool(even.any())]
    return {"bad1": int(bad[0]), "bad2": int(bad[1]), "near": near / mm, "right": name}


@cache
def p5() -> Mapping[str, Any]:
    down, up, half = 90.0, 60.0, 5.0  # mm, mm, s
    before, after = down / half, -up / half
    via = ScaraPose([0.3, 0.1, 0.05], 0.0)
    start = ScaraPose([0.2, 0.2, 0.05 + down * mm], 0.0)
    goal = ScaraPose([0.3, -0.1, 0.05 + up * mm], 0.0)
    t = np.array([4.8, 4.9, 5.0, 5.1, 5.2])
    q4 = SCARA.ik(blend(start, via, goal, 0.0, t / (2 * half)))[:, ROW, 3] / mm
    jump = (q4[4] - q4[3] - q4[1] + q4[0]) / 0.1
    guesses = {"sign": -jump, "sizes": -after - before, "less": before + after, "first": -before}
    guesses |= {"mean": jump / 2, "metres": jump / 1000}
    told = {"down": down, "up": up, "half": half, "before": before, "after": Shown(after)}
    return {"jump": jump, "right": "after less before"} | guesses | told | {"slower": -after}


OFF = 0.01  # degrees


def near_start(off: float) -> ScaraPose:
    return ScaraPose(START.position, off * deg)


def turning(off: float, s: Any) -> Any:
    """The tool's angle, interpolated as a rotation."""
    pose = near_start(off).as_transform().lerp(VIA.as_transform(), s)
    x_axis = pose.rotation @ np.array([1.0, 0, 0])
    return np.arctan2(x_axis[..., 1], x_axis[..., 0])


@cache
def p6() -> Mapping[str, Any]:
    right, left = (float(turning(off, 0.5)) / deg for off in (-OFF, OFF))
    apart = abs(right - left)
    guesses = {"none": 0.0, "starts": 2 * OFF, "one": apart / 2, "minus": -apart}
    guesses["radians"] = apart * deg
    told = {"off": OFF, "whole": 360.0, "to_the_right": Shown(right), "to_the_left": Shown(left)}
    return {"apart": apart, "right": "half a turn apart"} | guesses | told


@cache
def p7() -> Mapping[str, Any]:
    """The joints that can leave their limits from inside although a test of wrapped angles accepts
    every sample: uniform motions from the middle to 50 ends, 1001 samples each.
    """
    blind = []
    for i in range(4):
        middle, span = (LOW[i] + HIGH[i]) / 2, HIGH[i] - LOW[i]
        ends = HIGH[i] + span * np.linspace(0.02, 1, 50)
        q = middle + (ends[:, None] - middle) * S
        seen = wrapped(q) if i < 3 else q
        if not ((seen < LOW[i]) | (seen > HIGH[i])).any():
            blind.append(f"q{i + 1}")
    return {"right": plus(blind)}


H1, H2, B0, B1 = 60.0, 180.0, 0.1, 0.4  # heights above via in mm, and two blends, for prediction 8


def deepest(b: float) -> float:
    """The deepest point of the path, measured, in mm above via."""
    via = ScaraPose([0.4, 0.1, 0], 0.0)
    start, goal = ScaraPose([0.2, 0.3, H1 * mm], 0.0), ScaraPose([0.2, -0.2, H2 * mm], 0.0)
    return float(blend(start, via, goal, b, np.linspace(0, 1, 4001)).position[:, 2].min()) / mm


@cache
def p8() -> Mapping[str, Any]:
    first, last, factor = deepest(B0), deepest(B1), B1 / B0
    guesses = {"square": first * factor**2, "twice": first * 2, "less": first / factor}
    guesses["metres"] = last * mm
    told = {"h1": H1, "h2": H2, "b0": B0, "b1": B1, "first": first, "times": factor, "half": 2 * B0}
    return {"last": last, "right": "enlarged"} | guesses | told


@cache
def p9() -> Mapping[str, Any]:
    """The smallest blend that keeps the stroke of the lab's motion inside, for two corners."""
    parabola, quintic = (
        (LEVEL - HIGH[3]) / (LEVEL - stroke(0.5, np.linspace(0, 1, 4001), corner).max()) / 2
        for corner in ("parabola", "quintic")
    )
    guesses = {"less": 0.75 * parabola, "the same": parabola}
    right = min(guesses, key=lambda name: abs(guesses[name] - quintic))
    if quintic > 1.05 * parabola:
        right = "none" if quintic > 0.5 else "more"
    facts = {"parabola": parabola, "less": guesses["less"], "quintic": quintic, "largest": 0.5}
    return facts | {"right": right}


def acceleration(b: float, duration: float) -> float:
    """The acceleration measured in the middle of the lab's corner, mm/s²."""
    t = np.linspace(0, duration, 1001)
    return float(abs(differentiate(stroke(b, t / duration)[:, None], t, 2)[500, 0])) / mm


@cache
def p10() -> Mapping[str, Any]:
    before, after = acceleration(0.4, 10.0), acceleration(0.2, 20.0)
    names = {"a quarter": 0.25, "half": 0.5, "the same": 1.0, "twice": 2.0}
    right = min(names, key=lambda name: abs(np.log(names[name] * before / after)))
    return {"before": before, "after": after, "short": acceleration(0.2, 10.0), "right": right}
