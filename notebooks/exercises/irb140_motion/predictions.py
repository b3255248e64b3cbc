"""The facts behind the predictions of irb140 motion.

Objective 1: p6, p7. Objective 2: p3. Objective 3: p5. p1 is about the straight line. Under "More":
p2 and p4 (of the straight line and of objective 2), p9 (of 1), p8 and p10 (of 3).
"""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np

from robokin import (
    IRB140,
    Transform,
    blend,
    deg,
    differentiate,
    follow,
    lin,
    linear,
    mm,
    quintic,
    trapezoidal,
)
from robokin.units import wrapped

from .shared import GOAL, HIGH, LEFT, P0, RIGHT, ROW, START, VIA, D, Floats, length, pose, short_end

DURATION = 20.0  # s
T = np.linspace(0, DURATION, 1001)
S = T / DURATION
POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def closest(guesses: Mapping[str, float], value: float) -> str:
    """The name of the guess that is closest to a value."""
    return min(guesses, key=lambda name: abs(guesses[name] - value))


class Power(float):
    """A number that is printed with one digit and a power of ten."""

    def __str__(self) -> str:
        digit, power = f"{float(self):.0e}".split("e")
        return f"{digit}·10{str(int(power)).translate(POWERS)}"

    def __format__(self, spec: str) -> str:
        return str(self)


def posture(target: Transform) -> Floats:
    q: Floats = IRB140.ik(target)[ROW]
    return q


@cache
def along() -> Floats:
    """The joint values on the straight line from `LEFT` to `RIGHT`."""
    return follow(IRB140, IRB140.ik(lin(LEFT, RIGHT, S)), ROW)


STEADY = {
    (): "none",
    (4, 5, 6): "the wrist",
    (1, 2, 3): "joints 1 to 3",
    (1, 2, 3, 4, 5, 6): "all six",
}


@cache
def p1() -> dict[str, Any]:
    v = abs(differentiate(along(), T)) / deg
    low, high = v.min(axis=0), v.max(axis=0)
    tool = length(RIGHT.translation - LEFT.translation) / mm / DURATION
    steady = tuple(i + 1 for i in range(6) if high[i] - low[i] < 0.01 * high[i])
    facts = {"tool": tool, "right": STEADY[steady]}
    return facts | {
        f"{k}{i + 1}": x[i] for k, x in (("low", low), ("high", high)) for i in range(6)
    }


def per_progress() -> Floats:
    """What the line of section 1 asks of each joint: its speed over its speed limit, if the
    progress grows by 1 per second.
    """
    assert IRB140.speed_limits is not None
    asked: Floats = abs(differentiate(along(), S)) / IRB140.speed_limits
    return asked


def free_pace() -> Floats:
    """The times at which LIN is at progress S, if one joint is always at its speed limit."""
    most = per_progress().max(axis=-1)
    steps = (most[1:] + most[:-1]) / 2 * np.diff(S)
    return np.concatenate([[0.0], np.cumsum(steps)])


@cache
def p2() -> dict[str, Any]:
    asked, turns = per_progress(), abs(along()[-1] - along()[0])
    lin_joint, ptp_joint = asked.max(axis=0).argmax(), (turns / IRB140.speed_limits).argmax()
    lin_time, ptp_time = asked.max(), (turns / IRB140.speed_limits).max()
    best = free_pace()[-1]
    right = "between" if ptp_time <= best < 0.99 * lin_time else "no change"
    return {
        "lin_time": lin_time,
        "lin_joint": lin_joint + 1,
        "low": 100 * asked[0, lin_joint] / lin_time,
        "ptp_time": ptp_time,
        "ptp_joint": ptp_joint + 1,
        "turn": turns[ptp_joint] / deg,
        "best": best,
        "right": right if best >= ptp_time else "shorter way",
    }


FROM, TO = 350.0, 60.0  # degrees, joint 6


def p3() -> dict[str, Any]:
    q0, q1 = np.zeros(6), np.zeros(6)
    q0[5], q1[5] = FROM * deg, TO * deg
    turn = (short_end(q0, q1) - q0)[5] / deg
    short = float(wrapped(q1 - q0)[5]) / deg
    guesses = {"it turns back": TO - FROM, "past the limit": short, "the end": TO}
    guesses["exchanged"] = FROM - TO
    told = {"a": FROM, "b": TO, "limit": HIGH[5] / deg, "turn": turn, "back": -turn, "short": short}
    told["radians"] = turn * deg
    return told | {"right": closest(guesses, turn)}


LAWS = {"linear": linear, "trapezoidal": trapezoidal, "quintic": quintic}


def p4() -> dict[str, Any]:
    facts = {
        name: 100 * DURATION * differentiate(law(DURATION)(T), T).max()
        for name, law in LAWS.items()
    }
    guesses = facts | {"triangle": 200.0, "cubic": 150.0}
    told = {"excess": facts["quintic"] - 100, "factor": facts["quintic"] / 100}
    return facts | told | {"right": closest(guesses, facts["quintic"])}


def clock(step: float) -> Floats:
    return np.linspace(0, DURATION, round(DURATION / step) + 1)


def sharp(step: float) -> Floats:
    """Joint 3 of two straight motions that meet, a sample every `step` seconds: (samples, 1)."""
    rows = IRB140.ik(blend(START, VIA, GOAL, 0.0, clock(step) / DURATION))
    return follow(IRB140, rows, ROW)[:, 2:3]


def corner_change(step: float) -> tuple[float, float]:
    """Where two straight motions meet: the greatest change of joint 3's speed from one interval to
    the next, in °/s, and this change divided by the step.
    """
    v = np.diff(sharp(step)[:, 0]) / step / deg
    change = float(abs(np.diff(v)).max())
    return change, change / step


@cache
def p5() -> dict[str, Any]:
    change, a = corner_change(0.02)
    half, found = corner_change(0.01)
    guesses = {"half": a / 2, "same": a, "double": 2 * a, "four": 4 * a}
    right = closest({name: np.log(guess) for name, guess in guesses.items()}, np.log(found))
    return guesses | {"change": change, "half_change": half, "found": found, "right": right}


def tool_acceleration(fraction: float, duration: float) -> float:
    """The acceleration measured in the middle of the parabola's corner, mm/s²."""
    t = np.linspace(0, duration, 1001)
    place = blend(START, VIA, GOAL, fraction, t / duration).translation
    return length(differentiate(place, t, 2)[500]) / mm


@cache
def p6() -> dict[str, Any]:
    before, after = tool_acceleration(0.1, DURATION), tool_acceleration(0.05, DURATION)
    longer = DURATION * np.sqrt(after / before)  # the acceleration is proportional to 1 / duration²
    times = {"same": DURATION, "root": longer, "twice": 2 * DURATION, "four": 4 * DURATION}
    found = {name: tool_acceleration(0.05, time) for name, time in times.items()}
    return times | {"before": before, "after": after, "right": closest(found, before)}


def joint_3(fractions: Floats, corner: str) -> Floats:
    """The greatest acceleration of joint 3 for each blend, in °/s², from samples 1 ms apart: with
    20 ms the fourth digit is too low.
    """
    t = np.linspace(0, DURATION, 20_001)
    path = blend(START, VIA, GOAL, fractions[:, None], t / DURATION, corner=corner)
    a = differentiate(follow(IRB140, IRB140.ik(path), ROW), t, 2) / deg
    greatest: Floats = abs(a[..., 2]).max(axis=-1)
    return greatest


@cache
def p7() -> dict[str, Any]:
    parabola = float(joint_3(np.array([0.1]), "parabola")[0])
    same_blend, same_distance = map(float, joint_3(np.array([0.1, 0.1 / 0.75]), "quintic"))
    guesses = {"less": 0.75 * parabola, "the same": parabola, "a little more": same_distance}
    guesses["much more"] = same_blend
    return {
        "gap": 0.1 / 2 * D / mm,
        "parabola": parabola,
        "quintic": same_distance,
        "less": 0.75 * parabola,
        "at_blend": same_blend,
        "more": 100 * (same_distance / parabola - 1),
        "right": closest(guesses, same_distance),
    }


def exact_speed(seconds: float) -> Floats:
    """Joint speeds on the line of section 2, by the Jacobian, rad/s."""
    angle, axis = (RIGHT.rotation @ LEFT.rotation.inverse()).as_angle_axis()
    way = RIGHT.translation - LEFT.translation
    velocity = np.concatenate([way, angle * axis]) / DURATION
    q = posture(LEFT.lerp(RIGHT, seconds / DURATION))
    return np.asarray(np.linalg.solve(IRB140.jacobian(q), velocity), dtype=float)


def errors(steps: Floats) -> dict[str, Floats]:
    """The largest errors of three difference formulas at t = 5 s."""
    now, tiny = 5.0, 1e-4
    v = exact_speed(now)
    a = (exact_speed(now + tiny) - exact_speed(now - tiny)) / (2 * tiny)  # good to 1e-11
    at = [IRB140.ik(LEFT.lerp(RIGHT, (now + k * steps) / DURATION))[:, ROW] for k in (-1, 0, 1)]
    before, here, after = at
    h = steps[:, None]
    found = {
        "speed, forward": (after - here) / h - v,
        "speed, central": (after - before) / (2 * h) - v,
        "acceleration": (after - 2 * here + before) / h**2 - a,
    }
    return {name: abs(error).max(axis=-1) for name, error in found.items()}


@cache
def p8() -> dict[str, Any]:
    middle, large = errors(np.array([1e-3, 1e-1]))["acceleration"].tolist()
    # Which rounding errors occur at 1e-7 s depends on the processor; this one is always possible.
    digit = float(np.spacing(abs(IRB140.ik(LEFT.lerp(RIGHT, 5 / DURATION))[ROW]).max()))
    named = {"tiny": 2 * digit / 1e-7**2, "middle": middle, "large": large}
    size = abs(exact_speed(5.1) - exact_speed(4.9)).max() / 0.2
    stays = named["tiny"] < 10 * named["middle"]
    right = "any below" if stays else closest(named, 0.0)
    return {name: Power(x) for name, x in (*named.items(), ("size", size))} | {"right": right}


def misses(b: float) -> tuple[float, float]:
    """How far the corner's formula is from start and goal at its ends, mm."""
    a, c = START.lerp(VIA, 1 - 2 * b), VIA.lerp(GOAL, 2 * b)

    def off(s: float, wanted: Transform) -> float:
        x = (s - 0.5 + b) / (2 * b)
        found = a.lerp(VIA, x).lerp(VIA.lerp(c, x), x)
        return length(found.translation - wanted.translation) / mm

    return off(0.0, START), off(1.0, GOAL)


@cache
def p9() -> dict[str, Any]:
    b = 0.55
    begins, ends = misses(b)
    before = length(START.lerp(VIA, 1 - 2 * b).translation - P0) / mm
    guesses = {"at the start": 0.0, "at A": before, "along the curve": begins}
    facts = {"x": (b - 0.5) / (2 * b), "before": before, "begins": begins, "ends": ends}
    return facts | {"right": closest(guesses, begins)}


def out_of_reach() -> Floats:
    """The rows of `ik` for two straight motions that meet at a point out of reach."""
    return IRB140.ik(blend(START, pose(900, -100, 800, 45, [0, 1, 0]), GOAL, 0.0, S))


@cache
def p10() -> dict[str, Any]:
    rows = out_of_reach()

    there = np.isfinite(rows[:, ROW]).all(axis=-1)
    missing = np.flatnonzero(~there)
    left = int(np.isfinite(np.unwrap(rows[:, ROW], axis=0)).all(axis=-1).sum())
    beside = np.isfinite(np.gradient(rows[:, ROW], axis=0)).all(axis=-1) & there
    facts = {"there": int(there.sum()), "beside": int(beside.sum()), "left": left}
    guesses = {"none": 0, "before the hole": left, "without neighbours": facts["beside"]}
    guesses["all but the hole"] = facts["there"]
    places = {"count": len(T), "first": int(missing[0]), "last": int(missing[-1])}
    return facts | places | {"right": closest(guesses, left)}
