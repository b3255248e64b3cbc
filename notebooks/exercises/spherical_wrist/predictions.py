"""The facts behind the predictions: p1() for p1, with the name of the right answer as "right"."""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np

from robokin import ITMO6R, Transform, deg, distance_from_singularity, mm
from robokin.units import wrapped

from .shared import (
    ALPHA,
    OFFSET,
    ROW,
    A,
    D,
    Floats,
    X,
    Y,
    Z,
    mended,
    posture,
    rot,
    textbook,
    trans,
    turned,
    zyz,
)

MINUS = str.maketrans("-", "\N{MINUS SIGN}")
POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def nearest(value: float, guesses: Mapping[str, float]) -> str:
    """The name of the guess that is closest to a value."""
    return min(guesses, key=lambda name: abs(guesses[name] - value))


def ways(bend: float) -> list[float]:
    """How far each origin moves when joint 4 turns by 90 degrees, mm; joint 5 is at `bend`."""
    q = np.array([0, 60, -60, 0, bend, 0]) * deg + np.linspace(0, 90, 2)[:, None] * deg * (
        np.arange(6) == 3
    )
    places = ITMO6R.frames(q).translation
    return [float(x) / mm for x in np.linalg.norm(places[1] - places[0], axis=-1)]


@cache
def p1() -> dict[str, Any]:
    bent, straight = ways(45), ways(0)
    moving = [k for k, way in enumerate(bent) if way > 1e-6]
    answers = {"4, 5 and 6": [4, 5, 6], "5 and 6": [5, 6], "6 alone": [6], "none": []}
    right = next(name for name, frames in answers.items() if frames == moving)
    return {"right": right, "bent": bent, "tool": bent[6], "straight": straight[6] + 0.0}


def p2() -> dict[str, Any]:
    size = D[5] / mm
    tilts = {"up": Z, "along x": X, "down": -Z}
    off = {name: float(np.linalg.norm(size * way - size * Z)) for name, way in tilts.items()}
    facts = {"size": size, "off": off["along x"], "half": size / 2}
    facts |= {"down": off["down"], "up": off["up"], "metres": off["along x"] * mm}
    guesses = {"the diagonal": np.sqrt(2) * size, "one leg": size, "both legs": 2 * size}
    guesses |= {"half a leg": size / 2, "no way at all": 0.0}
    return facts | {"right": nearest(off["along x"], guesses)}


LEANING = posture(30, 110, 40, 0, 60, 0)


@cache
def p3() -> dict[str, Any]:
    centre = ITMO6R.frames(LEANING)[4].translation
    q1, first = float(LEANING[0]) / deg, float(np.arctan2(centre[1], centre[0])) / deg
    numbers = {"q1": q1, "first": first, "opposite": -first, "less": q1 - 90}
    names = ("what went in", "half a turn away", "mirrored", "90° less")
    facing = [np.cos(x * deg) * centre[0] + np.sin(x * deg) * centre[1] for x in numbers.values()]
    level = float(np.hypot(centre[0], centre[1]))
    right = nearest(level, dict(zip(names, facing, strict=True)))
    numbers |= {"x": float(centre[0]) / mm, "y": float(centre[1]) / mm}
    said = {name: f"{value:.0f}".translate(MINUS) for name, value in numbers.items()}
    return {"right": right} | said


TRIPLE = 30.0, 40.0, 50.0


@cache
def p5() -> dict[str, Any]:
    phi, theta, psi = TRIPLE
    found = wrapped(mended(zyz(*np.array(TRIPLE) * deg), -1)) / deg
    triples: dict[str, Any] = {
        "given": TRIPLE,
        "found": found,
        "theta": (phi, -theta, psi),
        "all": (-phi, -theta, -psi),
        "one": (phi - 180, -theta, psi),
    }
    wanted = zyz(*np.array(TRIPLE) * deg)
    facts: dict[str, Any] = {
        name: "(" + ", ".join(f"{x:.0f}°" for x in each).translate(MINUS) + ")"
        for name, each in triples.items()
    }
    for name, each in triples.items():
        facts[f"off_{name}"] = float(abs(zyz(*np.array(each) * deg) - wanted).max())
    names = {"theta": "joint 5", "all": "every sign", "one": "joints 4 and 5", "found": "all three"}
    return facts | {"right": nearest(0, {names[k]: facts[f"off_{k}"] for k in names})}


def chain(q: Floats) -> Floats:
    """The rotations (7, 3, 3) of frames 0 to 6, rounded as in the lab's chain."""
    frames = [np.eye(4)]
    for a, alpha, d, theta in zip(A, ALPHA, D, OFFSET + q, strict=True):
        frames.append(frames[-1] @ (rot(2, theta) @ trans(a, 0, d) @ rot(0, alpha)))
    return np.array(frames)[:, :3, :3]


@cache
def noise() -> tuple[Floats, Floats, Floats]:
    """Angles theta; for each of three solvers the worst error of a matrix entry (angles, 3), among
    those of 200 postures for which it gives a number; and the fractions for which it gives none.
    """
    q = np.random.default_rng(1).uniform(-180, 180, (200, 6)) * deg  # as in the lab
    thetas = 10.0 ** np.arange(0, -17, -1)
    worst, lost = np.zeros((2, len(thetas), 3))
    for i, theta in enumerate(thetas):
        q[:, 4] = theta
        frames = np.array([chain(each) for each in q])
        h = frames[:, 3].swapaxes(-1, -2) @ frames[:, 6]
        book, mine = textbook(h, +1), mended(h, +1)
        both = np.stack([book[:, 0], mine[:, 1], book[:, 2]], axis=-1)
        for k, found in enumerate((book, both, mine)):
            there = np.isfinite(found).all(axis=-1)
            worst[i, k] = abs(zyz(*found[there].T) - h[there]).max()
            lost[i, k] = 1 - there.mean()
    return np.asarray(thetas, dtype=float), worst, lost


def p6() -> dict[str, Any]:
    thetas, all_worst, all_lost = noise()
    row = int(np.argmin(abs(thetas - 1e-9)))
    worst, lost = float(all_worst[row, 0]), all_lost[row, 0]
    digit, power = f"{worst:.0e}".split("e")
    guesses = {"all digits": 1e-16, "as small as the angle": 1e-9, "half of the digits": worst}
    right = nearest(0, {name: np.log10(guess / worst) for name, guess in guesses.items()})
    return {
        "right": "no number for some" if lost else right,
        "worst": worst,
        "lost": lost,
        "power": f"{digit}·10{str(int(power)).translate(POWERS)}",
    }


def joint_end(k: int, sign: int) -> float:
    """The least (+1) or greatest (-1) distance from a singularity while joint k + 1 alone turns by
    up to 150 degrees to either side: 201 samples, then 201 around the best of them, down to 1e-8
    degrees.
    """
    best, half = 0.0, 150.0
    while half > 1e-8:
        by = np.clip(best + half * np.linspace(-1, 1, 201), -150, 150)
        q = posture(20, 70, -60, 30, 50, 10) + by[:, None] * deg * np.eye(6)[k]
        values = sign * distance_from_singularity(ITMO6R, q)
        best, half = float(by[values.argmin()]), half / 50
    return sign * float(values.min())


@cache
def p7() -> dict[str, Any]:
    low, high = ([joint_end(k, sign) for k in range(6)] for sign in (1, -1))
    never = [k + 1 for k in range(6) if high[k] - low[k] < 1e-9]
    answers = {"joint 1": [1], "joints 1 and 6": [1, 6], "joints 1, 4 and 6": [1, 4, 6]}
    answers["joints 4 and 6"] = [4, 6]
    facts: dict[str, Any] = {"right": next(k for k, joints in answers.items() if joints == never)}
    for k in range(6):
        facts |= {f"low{k + 1}": float(low[k]), f"high{k + 1}": float(high[k])}
    return facts


PLACES = np.linspace(-100, 100, 2001) * mm  # on the line of the first view


def passed(miss: float) -> Floats:
    """The postures (2001, 6) at PLACES of the line that passes the singular pose with this miss."""
    level = turned(90 * deg, Y) @ turned(180 * deg, Z)
    along, across = np.array([[0, 1, 1], [0, -1, 1]]) / np.sqrt(2)
    origins = np.array([400, 0, 200]) * mm + PLACES[:, None] * along + miss * across
    q: Floats = np.unwrap(ITMO6R.ik(Transform(level, origins))[:, ROW], axis=0)
    return q


def joint4_speeds(miss: float) -> Floats:
    """The speeds (2001,) of joint 4 at PLACES, °/s, by the Jacobian; the tool moves at 100 mm/s."""
    velocity = np.array([0, 1, 1, 0, 0, 0]) / np.sqrt(2) * 100 * mm
    speeds: Floats = np.linalg.solve(ITMO6R.jacobian(passed(miss)), velocity)
    return abs(speeds[:, 3]) / deg


def fastest(miss: float) -> float:
    """The greatest speed of joint 4 on the line, °/s."""
    return float(joint4_speeds(miss).max())


@cache
def p8() -> dict[str, Any]:
    two, one = fastest(2 * mm), fastest(1 * mm)
    joint4 = passed(2 * mm)[:, 3]
    guesses = {"half": two / 2, "root": np.sqrt(2) * two, "double": 2 * two, "four": 4 * two}
    names = {"half": "half as fast", "root": "the root of 2", "double": "twice as fast"}
    names["four"] = "four times as fast"
    right = nearest(0, {names[k]: np.log(guess / one) for k, guess in guesses.items()})
    turn = float(abs(joint4[-1] - joint4[0])) / deg
    return {"right": right, "turn": turn, "two": two, "one": one} | guesses
