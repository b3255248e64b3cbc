"""The facts behind the predictions of scara kinematics.

Objective 1: p1, p3, p4. Objective 2: p5, p6, p7. Objective 3: p2, p8, p9.
"""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np

from robokin import SCARA, ScaraPose, deg, follow, mm, within

from .shared import HIGH, L1, L2, MINUS, Floats, corner, distance, place, shown


def nearest(guesses: Mapping[str, float], value: float) -> str:
    """The name of the guess that is closest to a value."""
    return min(guesses, key=lambda name: abs(guesses[name] - value))


def whole(x: float) -> str:
    """An angle as a whole number of degrees."""
    return f"{round(x / deg) + 0:d}°".translate(MINUS)


def p1() -> Mapping[str, Any]:
    before = np.array([40, 60, -70, 120]) * [deg, deg, deg, mm]
    after = before + [30 * deg, 30 * deg, 0, 0]
    angle = [float(SCARA.fk(q).rotation.as_angle_axis()[0]) for q in (before, after)]
    change = round((angle[1] - angle[0]) / deg)
    guesses = {"not at all": 0, "for joint 2": -30, "for both": -60, "along": 60}
    right = nearest(guesses, -change)
    return {"by": 30, "change": change, "answer": f"−{change}°", "right": right}


ASKED = 540 * deg
TURN = ScaraPose([0.3, 0, 0.1], 0.0), ScaraPose([0.3, 0, 0.1], ASKED)


def p2() -> Mapping[str, Any]:
    start, goal = TURN
    poses = start.as_transform(), goal.as_transform()
    short = float((poses[0].rotation.inverse() @ poses[1].rotation).as_angle_axis()[0]) / deg
    half = float(start.lerp(goal, 0.5).angle) / deg
    right = f"{2 * half:.0f} and {short:.0f}"
    return {"asked": ASKED / deg, "short": short, "half": half, "right": right}


MIRRORED = np.array([200, 200]) * mm


@cache
def p3() -> Mapping[str, Any]:
    plus, minus = SCARA.ik(ScaraPose([*MIRRORED, 100 * mm]))
    q1, q2 = plus[:2]
    towards = float(np.arctan2(MIRRORED[1], MIRRORED[0]))
    guesses = {"as it is": q1, "in the x axis": -q1, "in the line": 2 * towards - q1}
    guesses["as in a parallelogram"] = q1 + q2
    told = {"q1": q1, "q2": q2, "turned": -q2, "other": minus[0], "negative": -q1}
    told |= {"towards": towards, "inside": towards - q1, "sum": q1 + q2}
    misses = {"miss": q1, "miss_x": -q1, "miss_sum": q1 + q2}
    return {
        "right": nearest(guesses, minus[0]),
        **{name: shown(angle) for name, angle in told.items()},
        **{name: f"{missed([angle, -q2]):.0f}" for name, angle in misses.items()},
    }


def missed(q: Any) -> float:
    """The distance of the tool from the position of prediction 3, mm."""
    return float(np.linalg.norm(place(np.array(q)) - MIRRORED)) / mm


SINE_AT = 130 * mm


def sine_angles(d: float) -> tuple[float, float, float]:
    """q2, the angle inside the triangle at joint 1, and that angle by the law of sines."""
    q2 = float(np.arccos((d**2 - L1**2 - L2**2) / (2 * L1 * L2)))
    sine = float(np.arcsin(np.clip(L2 * np.sin(q2) / d, -1, 1)))
    return q2, corner(L1, L2, q2), sine


@cache
def p4() -> Mapping[str, Any]:
    _, angle, sine = sine_angles(SINE_AT)
    near = 2 * SINE_AT / mm * abs(np.sin((angle - sine) / 2))
    border = float(np.sqrt(L2**2 - L1**2)) / mm
    right = "NaN" if not np.isfinite(near) else "beside" if round(near) == 28 else "right"
    told = {"corner": shown(angle), "sine": shown(sine), "border": border}
    return {"near": near, "right": right} | told


BEHIND = ScaraPose([-320 * mm, 140 * mm, 120 * mm], 0.0)
BY_FITS = {
    (True, True): "both",
    (True, False): "elbow +1",
    (False, True): "elbow −1",
    (False, False): "neither",
}


@cache
def p5() -> Mapping[str, Any]:
    rows = SCARA.ik(BEHIND)
    towards = float(np.arctan2(BEHIND.position[1], BEHIND.position[0]))
    plus, minus = np.all(within(SCARA, rows), axis=-1).tolist()
    told = {"towards": towards, "plus": rows[0, 0], "minus": rows[1, 0]}
    facts = {name: shown(angle) for name, angle in told.items()}
    return facts | {"limit": whole(HIGH[0]), "right": BY_FITS[plus, minus]}


STOP = 120 * deg


@cache
def p6() -> Mapping[str, Any]:
    guesses = {
        "at the stop": distance(STOP) / mm,
        "folded": (L2 - L1) / mm,
        "inner angle": distance(np.pi - STOP) / mm,
        "lab's stop": distance(HIGH[1]) / mm,
        "right angle": distance(np.pi / 2) / mm,
        "zero": 0.0,
    }
    bends = np.linspace(-STOP, STOP, 2401)
    near = np.linalg.norm(place(np.stack([0 * bends, bends], axis=-1)), axis=-1).min() / mm
    guesses["metres"] = distance(STOP)
    told = {"stop": STOP / deg, "lab": HIGH[1] / deg, "bent": distance(100 * deg) / mm}
    return guesses | told | {"right": nearest(guesses, near)}


def areas(a: float, most: float) -> tuple[float, float]:
    """The areas that elbow +1 and both elbows reach, cm², with the stops of joints 1 and 2."""
    one = 2 * a * L1 * L2 * (1 - np.cos(most))
    b = np.pi - a
    notch = L1 * np.cos(b) + np.sqrt(L2**2 - (L1 * np.sin(b)) ** 2)
    beta = np.arccos((notch**2 - L1**2 - L2**2) / (2 * L1 * L2))
    both = a * (L1 + L2) ** 2 + L2**2 * beta + L1 * notch * np.sin(b) - np.pi * distance(most) ** 2
    return one * 1e4, both * 1e4


@cache
def p7() -> Mapping[str, Any]:
    a, most, more = float(HIGH[0]), float(HIGH[1]), 10 * deg
    now, first, second = areas(a, most), areas(a + more, most), areas(a, most + more)
    facts: dict[str, Any] = {
        "one_1": 100 * (first[0] / now[0] - 1),
        "one_2": 100 * (second[0] / now[0] - 1),
        "both_1": 100 * (first[1] / now[1] - 1),
        "both_2": 100 * (second[1] / now[1] - 1),
        "rest": 100 * (areas(np.pi, most)[1] - first[1]) / now[1],
    }
    gains = {"joint 1": facts["both_1"], "joint 2": facts["both_2"]}
    right = max(gains, key=lambda name: gains[name])
    if abs(gains["joint 1"] - gains["joint 2"]) < 0.1:
        right = "the same"
    return facts | {"right": "neither" if max(gains.values()) < 0.1 else right}


@cache
def lap(elbow: int, turns: int = 1) -> Floats:
    """Joint 3 along a circle of 70 mm around (200, 0) mm, with this many turns of the tool."""
    omega = np.linspace(0, 2 * np.pi, 361)
    x, y = 200 + 70 * np.cos(omega), 70 * np.sin(omega)
    targets = ScaraPose(np.stack([x, y, np.full_like(x, 100)], axis=-1) * mm, turns * omega)
    return follow(SCARA, SCARA.ik(targets), SCARA.branch(elbow))[:, 2]


@cache
def p8() -> Mapping[str, Any]:
    tracks = {"plus": lap(+1), "minus": lap(-1)}
    facts = {name: shown(q3[0]) for name, q3 in tracks.items()}
    facts |= {f"{name}_end": shown(q3[-1]) for name, q3 in tracks.items()}
    plus, minus = (bool(abs(q3).max() <= HIGH[2]) for q3 in tracks.values())
    facts |= {"back": shown(lap(-1, -1)[-1]), "limit": whole(HIGH[2])}
    return facts | {"right": BY_FITS[plus, minus]}


def bend(r: float) -> float:
    """q2 of elbow +1 at the distance r (mm), in degrees."""
    return float(SCARA.ik(ScaraPose([r * mm, 0, 100 * mm]))[0, 1]) / deg


@cache
def p9() -> Mapping[str, Any]:
    last, middle = bend(440) - bend(450), bend(300) - bend(310)
    guesses = {"as much": middle, "about 24°": 24.0, "about 90°": 90.0, "less": 0.0}
    told = {"before": bend(430) - bend(440), "one": bend(449), "square": distance(np.pi / 2) / mm}
    return {"last": last, "middle": middle, "right": nearest(guesses, last)} | told
