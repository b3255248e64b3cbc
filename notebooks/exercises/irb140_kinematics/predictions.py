"""The facts behind the predictions of irb140 kinematics.

Objective 1: p1, p2. Objective 2: p3, p4, p6, p9. Objective 3: p7, p8, p10.
Under "More": p3, p9, p7, p10.
"""

from typing import Any

import numpy as np

from robokin import IRB140, Transform, deg, mm, within
from robokin.units import wrapped

from .shared import L4, Floats, Z, listed, target


def signed(angle: float, digits: int = 0) -> str:
    """An angle in degrees, with a typographic minus sign."""
    return f"{round(angle / deg, digits) + 0.0:.{digits}f}°".replace("-", "−")


def moved(q: Any, k: int, by: float, point: Any = (0, 0, 0)) -> float:
    """How far a point fixed to the flange moves when joint k (from 0) turns, in mm."""
    a = np.array(q, dtype=float)
    b = a + by * (np.arange(6) == k)
    return float(np.linalg.norm(IRB140.fk(b) @ point - IRB140.fk(a) @ point)) / mm


def p1() -> dict[str, Any]:
    """The joints that turn the flange without moving it in the home posture."""
    home, bent = np.zeros(6), np.array([0, 0, 0, 0, 45, 0]) * deg
    at_home = [moved(home, k, 45 * deg) for k in range(6)]
    still = tuple(k + 1 for k, x in enumerate(at_home) if x < 1e-6)
    names = {(4, 5, 6): "4, 5 and 6", (4, 6): "4 and 6", (6,): "6 alone", (1, 6): "1 and 6"}
    return {
        "right": names[still],
        "wrist": at_home[4],
        "column": at_home[0],
        "bent": moved(bent, 3, 45 * deg),
        "tipped": moved(home, 4, 45 * deg, 200 * mm * Z),
    }


CENTRE_Q = np.array([10, 20, -30, 40, 50, 60]) * deg


def p2() -> dict[str, Any]:
    """How joint 5 moves two points: the flange and the wrist centre behind it."""
    behind = -L4 * Z
    centre = moved(CENTRE_Q, 4, 90 * deg, behind)
    others = max(moved(CENTRE_Q, k, 90 * deg, behind) for k in (3, 5))
    stays = "nowhere" if others < 1e-6 else "joints 4 and 6 move it"
    return {
        "right": "on arcs" if centre > 1e-6 else stays,
        "flange": moved(CENTRE_Q, 4, 90 * deg),
        "centre": centre,
        "others": others,
        "elbow": moved(CENTRE_Q, 2, 90 * deg, behind),
    }


AWAY_AT = np.array([400, -230.94, 500]) * mm  # a wrist centre 30 degrees to the right


def away_pose() -> Transform:
    """The pose whose tool points up, so that the flange is 65 mm above its wrist centre."""
    return Transform(translation=AWAY_AT + L4 * Z)


def p3() -> dict[str, Any]:
    """Joint 1 of the arm that faces a point, and of the arm that faces away from it."""
    rows = IRB140.ik(away_pose())
    front, back = (float(rows[IRB140.branch(f, 1, 1), 0]) for f in (+1, -1))
    x, y, _ = AWAY_AT
    options = {
        "mirrored": np.arctan2(-y, x),
        "half a turn on": back,
        "one sign": np.arctan2(y, -x),
        "the elbow alone": front,
    }
    return {
        "right": next(name for name, q1 in options.items() if faces_away(q1)),
        "front": signed(front),
        "back": signed(back),
        "mirrored": signed(options["mirrored"]),
        "one_sign": signed(options["one sign"]),
    }


def faces_away(q1: float) -> bool:
    """Whether the wrist centre is behind the arm, in the plane of joints 2 and 3."""
    x, y, _ = AWAY_AT
    ahead, aside = np.cos(q1) * x + np.sin(q1) * y, -np.sin(q1) * x + np.cos(q1) * y
    return bool(ahead < 0 and abs(aside) < 1e-9)


WRIST_Q = np.array([-20, 15, -40, 25, 35, -50]) * deg


def p4() -> dict[str, Any]:
    """The last three joints of a posture, those with the other wrist, and three confusions."""
    rows = IRB140.ik(IRB140.fk(WRIST_Q))
    q = WRIST_Q[3:]
    mine = np.nanargmin(abs(wrapped(rows - WRIST_Q)).max(axis=-1))
    front, elbow, wrist = IRB140.branches[mine].tolist()
    partner = rows[IRB140.branch(front, elbow, -wrist), 3:]
    options = {
        "joint 5 alone": q * [1, -1, 1],
        "all signs": -q,
        "half turns": partner,
        "half a turn of joint 5": np.array([q[0] + np.pi, q[1] - np.pi, q[2]]),
    }
    flip, negative, other, half = (", ".join(map(signed, each)) for each in options.values())
    goal = IRB140.fk(WRIST_Q).as_matrix()
    reached = {
        name: IRB140.fk(np.array([*WRIST_Q[:3], *each])).as_matrix()
        for name, each in options.items()
    }
    same = (name for name, pose in reached.items() if np.allclose(pose, goal, atol=1e-9))
    texts = {"flip": flip, "negative": negative, "other": other, "half": half}
    return texts | {"right": next(same), "options": options, "mine": texts_of(q)}


def texts_of(q: Any) -> str:
    """Joint angles as text; half a turn is +180° even if rounding makes it -180°."""
    half = np.isclose(q, -np.pi, rtol=0, atol=1e-9)
    return ", ".join(signed(float(x)) for x in np.where(half, np.pi, q))


def p6() -> dict[str, Any]:
    """The postures that reach the pose of the posture 0, 0, 0, 0, 0, 0."""
    pose = IRB140.fk(np.zeros(6))
    rows = IRB140.ik(pose)
    exist = rows[~np.isnan(rows).any(axis=-1)]
    different = np.unique(np.round(np.exp(1j * exist), 9), axis=0)
    turn = IRB140.fk(np.array([0, 0, 0, 20, 0, -20]) * deg)
    free = np.allclose(turn.as_matrix(), pose.as_matrix(), atol=1e-12)
    return {"right": "no end" if free else "rows that differ", "different": len(different)}


def task_1() -> tuple[Floats, Floats, Transform]:
    """Task 1 of source 001: times, the row (+1, +1, +1) of all samples, and the poses."""
    t = np.linspace(0, 20, 2001)
    numbers = {"x_start": 0.2, "x_end": 0.45, "y_start": 0.05, "y_end": 0.55, "turn": 90 * deg}
    poses = target(numbers, t / 20, 500 * mm)
    q = IRB140.ik(poses)[:, IRB140.branch(+1, +1, +1)]
    q[0, 3] = -180 * deg  # half a turn: +180 or -180, which rounding would decide
    return t, q, poses


def p7() -> dict[str, Any]:
    """The fraction of task 1 that is within all limits, and the joints that exceed them."""
    t, q, _ = task_1()
    inside = within(IRB140, q)
    past: Any = ~inside.all(axis=-1)
    samples = [
        f"joint {k + 1} in {(~inside[:, k]).sum()}" for k in range(6) if not inside[:, k].all()
    ]
    (_, _, high3, _, high5, _) = IRB140.limits[:, 1]
    back = [float(t[~inside[:, k]][-1]) + 0.01 for k in (2, 4)]  # the first samples inside
    share = 1 - past.mean()
    shares = {
        "all": 1.0,
        "the last two thirds": 2 / 3,
        "the sum": 1 - sum(back) / t[-1],
        "nothing": 0.0,
    }
    return {
        "right": min(shares, key=lambda name: abs(shares[name] - share)),
        "first 3": back[0],
        "first 5": back[1],
        "past": int(past.sum()),
        "last": float(t[past][-1]) + 0.01,
        "count": len(past),
        "samples": " and ".join(samples),
        "q3": signed(float(q[:, 2].max()), 1),
        "q5": signed(float(q[:, 4].max()), 1),
        "high3": signed(high3),
        "high5": signed(high5),
    }


def p8() -> dict[str, Any]:
    """The greatest forward difference of joint 4 across a wrap, for two time steps."""
    found: dict[str, Any] = {}
    for name, step in (("coarse", 0.01), ("fine", 0.005)):
        t = np.arange(0, 1, step)
        turning = 179.5 * deg + 10 * deg * t  # 10 degrees a second, through half a turn
        shown = np.angle(np.exp(1j * turning))
        found[name] = float(abs(np.diff(shown)).max() / step)
        found[f"true {name}"] = float(abs(np.diff(np.unwrap(shown))).max() / step)
        found[f"central {name}"] = float(abs(np.gradient(shown, step)).max())
    ratio = found["fine"] / found["coarse"]
    ratios = {"halved": 0.5, "stays": 1.0, "doubles": 2.0}
    right = min(ratios, key=lambda name: abs(ratios[name] - ratio))
    return found | {"true": found["true coarse"], "right": right}


UPPER, FORE = 350 * mm, 380 * mm
# mm, from joint 2: below this distance the angle at the shoulder is obtuse
LEAST = np.sqrt(FORE**2 - UPPER**2) / mm


def at_elbow(d: float) -> float:
    """The angle inside the triangle, for a wrist centre at the distance d from joint 2."""
    return float(np.arccos((UPPER**2 + FORE**2 - d**2) / (2 * UPPER * FORE)))


def arcsin_miss(d: float) -> float:
    """The error of the wrist centre with the law of sines of listing 1, in mm."""
    inner = at_elbow(d)
    at_shoulder = np.arcsin(FORE * np.sin(inner) / d)
    bend = at_shoulder + inner - np.pi
    elbow = UPPER * np.array([np.cos(at_shoulder), np.sin(at_shoulder)])
    place = elbow + FORE * np.array([np.cos(bend), np.sin(bend)])
    return float(np.linalg.norm(place - [d, 0])) / mm


def p9() -> dict[str, Any]:
    """The result of the formula for a wrist centre 100 mm from joint 2."""
    d = 100 * mm
    sine, miss = FORE * np.sin(at_elbow(d)) / d, arcsin_miss(d)
    right = "a wrong place" if miss > 0.1 else "right"
    return {
        "right": right if np.isfinite(miss) else "NaN",
        "miss": miss,
        "sine": sine,
        "least": LEAST,
        "obtuse": np.arccos((UPPER**2 + d**2 - FORE**2) / (2 * UPPER * d)) / deg,
        "acute": np.arcsin(sine) / deg,
    }


JOINT_6 = 30 * deg


def p10() -> dict[str, Any]:
    """The values of joint 6 inside its limits that give the same posture."""
    low, high = IRB140.limits[5]
    values = JOINT_6 + 2 * np.pi * np.arange(-5, 6)
    inside = values[(values >= low) & (values <= high)]
    return {
        "right": ("one", "two", "three")[len(inside) - 1],
        "q6": signed(JOINT_6),
        "values": listed([signed(float(x)) for x in inside]),
        "back": signed(JOINT_6 - 2 * np.pi),
        "high": signed(high),
        "q1": int(sum(-180 <= 30 + 360 * k <= 180 for k in range(-5, 6))),
    }
