"""The facts behind the predictions. Objective 1: p1 and p2; 2: p3 to p7; 3: p9."""

from functools import cache
from typing import Any

import numpy as np

from robokin import deg, mm
from robokin.jobs.steppers import (
    Move,
    counts,
    energised,
    frequencies,
    joint_values,
    phases,
    shortest_turn,
    station_postures,
    synchronised,
    unsynchronised,
)

from .next_posture import by_size
from .shared import GOAL, LOADER, PER_DEGREE, START, STEP, Floats


def p1() -> dict[str, Any]:
    """How fast joint 1 turns on a straight line past the vertical axis."""
    beside, speed = 20.0, 100.0  # mm, mm/s
    ends = np.array([[200, beside, 300], [-200, beside, 300]]) * mm
    turned = float(np.diff(station_postures(LOADER, ends), axis=0)[0, 0]) / deg
    even, most = turned / 4, speed / beside / deg
    return {
        "beside": beside,
        "speed": speed,
        "turned": turned,
        "even": even,
        "most": most,
        "end": speed * beside / (200**2 + beside**2) / deg,
        "right": "fast in the middle" if most > 3 * even else "evenly",
    }


def p2() -> dict[str, Any]:
    at = one_sided = 170.0
    for to in (-170.0, -60.0):
        at += float(shortest_turn(at * deg, to * deg)) / deg
        one_sided += by_size((to - one_sided) * deg) / deg
    return {
        "at": at,
        "back": -60.0,
        "once": 170 + float(shortest_turn(170 * deg, -170 * deg)) / deg,
        "turns": at - 170,
        "one": one_sided,
        "radians": at * deg,
        "right": "counted on",
    }


def p3() -> dict[str, Any]:
    """How far half a pulse of each motor moves the gripper at the start."""
    q = station_postures(LOADER, [START])[0]
    moved = np.linalg.norm(LOADER.jacobian(q)[:3], axis=0) * 0.5 / PER_DEGREE * deg / mm
    facts: dict[str, Any] = {f"m{i + 1}": float(x) for i, x in enumerate(moved)}
    return facts | {"right": f"gear {int(moved.argmax()) + 1}"}


def p4() -> dict[str, Any]:
    pulses = np.array([1200, 300, 0])
    return {
        "quarter": float(frequencies(pulses)[1]),
        "inverse": 500.0 * 1200 / 300,
        "share": 500.0 * 300 / pulses.sum(),
        "full": 500.0,
        "half": 500 / 2,
        "third": 500 / 3,
        "milli": float(frequencies(pulses)[1]) / 1000,
        "right": "a quarter",
    }


GEARED = np.array([40, 20, 20])  # pulses per degree of the other gears


def geared() -> dict[str, Move]:
    """The moves of the paths a and d with the other gears."""
    stations = counts(station_postures(LOADER, [START, GOAL]), GEARED)
    return {"a": unsynchronised(*stations), "d": synchronised(*stations)}


def path(move: Move) -> Floats:
    """The gripper's path in mm."""
    t = np.union1d(np.linspace(0, move.duration, 1001), move.t)
    q = joint_values(move(t), GEARED)
    return np.asarray(LOADER.fk(q).translation / mm)


@cache
def p5() -> dict[str, Any]:
    """The lengths of both paths with the other gears, in mm."""
    a, d = (
        float(np.linalg.norm(np.diff(path(move), axis=0), axis=1).sum())
        for move in geared().values()
    )
    right = "longer" if a > 1.02 * d else "shorter" if a < 0.98 * d else "as long"
    return {
        "a": a,
        "d": d,
        "line": round(float(np.linalg.norm(GOAL - START)) / mm, -1),
        "right": right,
    }


def p6() -> dict[str, Any]:
    lost, move, back = 32, 1000, 400  # a rotor slips by whole turns of the field
    stands, counted = 0, 0
    for pulses, missed in ((move, lost), (-back, 0)):
        counted += pulses
        stands += pulses - missed
    off = counted - stands
    return {
        "lost": lost,
        "sent": move,
        "twice": 2 * lost,
        "counted": counted,
        "stands": stands,
        "off": off,
        "right": {lost: "short for good", 0: "errors cancel"}.get(off, "short every move"),
    }


@cache
def random_moves() -> tuple[Floats, Floats]:
    """The errors of three motors after each of 10 000 random moves (10 000, 3), in pulses: if each
    move is rounded, and if positions are rounded.
    """
    rng = np.random.default_rng(1)
    walk = np.cumsum(rng.uniform(-20, 20, (10_001, 3)), axis=0)  # degrees
    positions = counts(walk * deg, PER_DEGREE)
    alone = positions[0] + np.cumsum(np.rint(np.diff(walk, axis=0) * PER_DEGREE), axis=0)
    return alone - walk[1:] * PER_DEGREE, positions[1:] - walk[1:] * PER_DEGREE


def p7() -> dict[str, Any]:
    alone, counted = (float(abs(off).max()) for off in random_moves())
    right = "below a pulse" if alone < 1.5 else "dozens" if alone < 200 else "thousands"
    expected = float(np.sqrt(10_000 / 12))
    return {"alone": alone, "counted": counted, "expected": expected, "right": right}


def p9() -> dict[str, Any]:
    rows = energised(phases("half-step", "unipolar"), np.ones(12))
    field = float(np.unwrap(np.angle(rows @ np.exp(0.5j * np.pi * np.arange(4))))[-1]) / deg
    return {
        "rotor": field / 50,
        "radians": field / 50 * deg,
        "field": field,
        "full": 12 * STEP,
        "doubled": 12 * 2 * STEP,
        "rows": 12 / 8 * STEP,
        "right": "half steps",
    }
