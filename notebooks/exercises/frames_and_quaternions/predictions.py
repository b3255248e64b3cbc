"""The facts behind the predictions of frames and quaternions.

Objective 1: p1 to p4. Objective 2: p5 to p7. Objective 3: p8 and p9.
"""

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import numpy as np

from robokin import Quaternion, deg, mm

from .shared import MINUS, Floats, X, Z, arc, chord, rot, trans, unit


def told(vector: Any, digits: int = 0) -> str:
    values = np.round(np.asarray(vector, dtype=float), digits) + 0.0
    return f"({', '.join(f'{x:.{digits}f}' for x in values)})".translate(MINUS)


def nearest(guesses: Mapping[str, Any], value: Any) -> str:
    """The name of the guess that is closest to a value, which is a number or an array."""
    return min(guesses, key=lambda name: float(np.linalg.norm(np.subtract(guesses[name], value))))


def p1() -> dict[str, Any]:
    shift, turn, point = trans(200, 0, 0), rot(Z, 90 * deg), np.array([100.0, 0, 0, 1])
    guesses = {
        "turn then shift": shift @ (turn @ point),
        "shift then turn": turn @ (shift @ point),
        "clockwise": shift @ turn.T @ point,
        "shift alone": shift @ point,
    }
    facts = dict(zip(("point", "whole", "clockwise", "unturned"), guesses.values(), strict=True))
    right = nearest(guesses, (shift @ turn) @ point)
    return {name: told(place[:3]) for name, place in facts.items()} | {"right": right}


TURN, SHIFT = 100.0, 300.0  # degrees, mm


def p2() -> dict[str, Any]:
    one = rot(Z, TURN * deg) @ trans(SHIFT, 0, 0)
    two = trans(SHIFT, 0, 0) @ rot(Z, TURN * deg)
    facts = {
        "chord": 2 * SHIFT * np.sin(TURN * deg / 2),
        "none": 0.0,
        "arc": SHIFT * TURN * deg,
        "twice": 2 * SHIFT,
        "sine": SHIFT * np.sin(TURN * deg),
        "shift": SHIFT,
    }
    facts["metres"] = facts["chord"] * mm
    names = ["the chord", "no distance", "the arc", "both shifts"]
    names += ["the height", "the shift", "in metres"]
    guesses = dict(zip(names, facts.values(), strict=True))
    right = nearest(guesses, np.linalg.norm((one - two)[:3, 3]))
    return facts | {"turn": TURN, "right": right}


def p3() -> dict[str, Any]:
    rotation, p = rot(Z, 90 * deg)[:3, :3], np.array([400.0, 0, 300])
    guesses = {
        "the other sign": -p,
        "turned back": -rotation.T @ p,
        "turned on": -rotation @ p,
        "no sign": rotation.T @ p,
    }
    facts = dict(zip(("minus", "back", "on", "unsigned"), guesses.values(), strict=True))
    seen = np.linalg.inv(trans(*p) @ rot(Z, 90 * deg))[:3, 3]
    found = {name: told(place) for name, place in facts.items()}
    return found | {"place": told(p), "right": nearest(guesses, seen)}


NUMBERS = ("q", "d", "a", "alpha")


def dh(q: float, d: float, a: float, alpha: float) -> Floats:
    matrix: Floats = rot(Z, q) @ trans(a, 0, d) @ rot(X, alpha)
    return matrix


@cache
def p4() -> dict[str, Any]:
    """The number of a link between parallel axes that does not move the next axis."""
    link = {"q": 20 * deg, "d": 100 * mm, "a": 300 * mm, "alpha": 0.0}
    free = []
    for name in NUMBERS:
        one, two = dh(**link), dh(**(link | {name: link[name] + 0.1}))
        same = np.allclose(one[:3, 2], two[:3, 2])
        beside = np.cross(one[:3, 2], two[:3, 3] - one[:3, 3])
        if same and np.allclose(beside, 0):
            free.append(name)
    return {"free": free, "apart": link["a"] / mm, "right": " and ".join(free) or "none"}


@cache
def p5() -> dict[str, Any]:
    two = Quaternion.from_angle_axis(90 * deg, Z) @ Quaternion.from_angle_axis(90 * deg, X)
    angle, axis = two.as_angle_axis()
    w = np.cos(45 * deg) ** 2
    facts = {
        "angle": 2 * np.arccos(w) / deg,
        "sum": 180.0,
        "root": 90 * np.sqrt(2),
        "one": 90.0,
        "half": np.arccos(w) / deg,
        "radians": 2 * np.arccos(w),
    }
    names = ("one turn", "the sum", "like arrows", "one hinge", "half of it", "in radians")
    right = nearest(dict(zip(names, facts.values(), strict=True)), float(angle) / deg)
    return facts | {"w": float(two.wxyz[0]), "axis": told(axis, 3), "right": right}


def p6() -> dict[str, Any]:
    guesses = {
        "plus one": (1, 0, 0, 0),
        "minus one": (-1, 0, 0, 0),
        "half a turn": (0, 0, 0, 1),
        "all zero": (0, 0, 0, 0),
    }
    return {"right": nearest(guesses, Quaternion.from_angle_axis(360 * deg, Z).wxyz)}


@cache
def p7() -> dict[str, Any]:
    """The smallest value of the largest component, over many unit quaternions and the one with
    equal components.
    """
    rows = np.random.default_rng(1).normal(size=(4000, 4))
    rows[0] = 1.0
    rows /= np.linalg.norm(rows, axis=1, keepdims=True)
    least, three = float(abs(rows).max(axis=1).min()), float(np.sqrt(1 / 3))
    guesses = {"zero": 0.0, "a quarter": 0.25, "a half": 0.5, "the root of 1/3": three}
    return {"least": least, "three": three, "right": nearest(guesses, least)}


S = np.linspace(0, 1, 401)
Lead = Callable[[Floats, Floats, float], Floats]


def nlerp(a: Floats, b: Floats, s: float) -> Floats:
    return unit(chord(a, b, s))


def speed(lead: Lead, turn: float) -> Floats:
    """The angular speed over S, on the path to a rotation about z."""
    a, b = Quaternion.identity().wxyz, Quaternion.from_angle_axis(turn, Z).wxyz
    rows = np.array([lead(a, b, s) for s in S])
    angles = 2 * np.unwrap(np.arctan2(rows[:, 3], rows[:, 0]))
    found: Floats = np.gradient(angles, S, edge_order=2)
    return found


def hurry(turn: float) -> float:
    """The speed of nlerp in the middle, divided by its speed at the ends."""
    found = speed(nlerp, turn)
    return float(found[len(S) // 2] / found[0])


@cache
def p8() -> dict[str, Any]:
    ratio = hurry(np.pi)
    root = np.sqrt(2)  # the ratio of arc radius to chord distance
    guesses = {"twice": root**2, "the same": 1.0, "half as fast": 1 / root**2}
    guesses |= {"the root": root, "four times": root**4}
    return {
        "ratio": ratio,
        "same": 1.0,
        "inverse": 1 / ratio,
        "root": float(np.sqrt(ratio)),
        "square": ratio**2,
        "small": hurry(60 * deg),
        "right": nearest(guesses, ratio),
    }


@cache
def p9() -> dict[str, Any]:
    way = 60.0
    a, b = Quaternion.identity().wxyz, -Quaternion.from_angle_axis(way * deg, Z).wxyz
    rows = Quaternion(np.array([arc(a, b, s) for s in S]))
    turned = float(rows[:-1].angle_to(rows[1:]).sum()) / deg
    facts = {
        "turned": 360 - way,
        "way": way,
        "arc": (360 - way) / 2,
        "half": 180.0,
        "rest": 180 - way,
        "minus": -way,
        "radians": (360 - way) * deg,
    }
    names = ["the rest of a turn", "as asked", "the arc", "half a turn", "the rest of a half"]
    names += ["the other way", "in radians"]
    guesses = dict(zip(names, facts.values(), strict=True))
    return facts | {"right": nearest(guesses, turned)}
