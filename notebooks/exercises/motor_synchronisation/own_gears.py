"""Exercise 2: a student's own move, and what does not hold of its gears and frequencies."""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np

from robokin import deg, mm
from robokin.course.exercises import words
from robokin.course.told import apart, floats
from robokin.course.variants import Numbers, dice
from robokin.jobs.steppers import counts, station_postures
from robokin.units import wrapped

from .shared import LOADER, STEP, A, B, Floats

COUNT = 4
LENGTHS = np.array([A + B, A + B, B])  # from each joint to the end of the stretched arm
COARSE = LENGTHS * STEP / 2 * deg  # what half a step without a gear moves that end
TOGETHER = 0.01  # working times this near to each other, as a share, are one
KEYS = ("gears", "frequencies")
Fault = tuple[str, str]
Drive = tuple[Floats, Floats]


@cache
def turns_of(places: tuple[float, ...]) -> Floats:
    """The turns of the three joints in degrees."""
    ends = np.reshape(places, (2, 3))
    return np.asarray(np.diff(station_postures(LOADER, ends), axis=0)[0] / deg)


def places(given: Mapping[str, Any]) -> tuple[float, ...]:
    return tuple(float(given[f"{end}_{x}"]) for end in ("start", "goal") for x in "xyz")


def pulses_of(given: Mapping[str, Any], gears: Floats) -> Floats:
    """The pulses of the move, without signs."""
    q = station_postures(LOADER, np.reshape(places(given), (2, 3)))
    return np.asarray(abs(np.diff(counts(q, gears / STEP), axis=0)[0]), dtype=float)


def given(who: Any) -> Numbers:
    """Two points on either side of the direction 180°, a greatest miss, a greatest frequency, and a
    time that leaves some room.
    """
    d = dice("motor_synchronisation", who)
    while True:
        side = d.choice([-1, 1])
        start = np.array([-d.randrange(250, 560, 10), side * d.randrange(60, 260, 10)])
        goal = np.array([-d.randrange(250, 560, 10), -side * d.randrange(60, 260, 10)])
        heights = [d.randrange(50, 400, 10), d.randrange(50, 400, 10)]
        miss, most = d.randrange(20, 42, 2) / 100 * mm, d.randrange(400, 820, 20)
        ends = (*(start * mm), heights[0] * mm, *(goal * mm), heights[1] * mm)
        ends = tuple(float(x) for x in ends)
        if not (np.linalg.norm(np.reshape(ends, (2, 3)), axis=1) < 0.7).all():
            continue
        turns = abs(turns_of(ends))
        if (turns > 12).all() and np.ptp(np.sort(turns)[1:]) > 8:
            break
    names = [f"{end}_{x}" for end in ("start", "goal") for x in "xyz"]
    values: dict[str, Any] = dict(zip(names, ends, strict=True))
    gear = int(np.ceil(COARSE.max() / miss - 1e-9))
    needed = float(turns.max()) * gear / STEP / most
    values |= {
        "miss": miss,
        "most": most,
        "seconds": float(np.ceil(12 * needed) / 10),
    }
    units = {name: ("mm", mm) for name in [*names, "miss"]}
    return Numbers(values, units | {"most": ("pulses/s", 1.0), "seconds": ("s", 1.0)})


def form(answer: Any, given: Any) -> Drive:
    if not isinstance(answer, Mapping) or not set(KEYS) <= set(answer):
        raise ValueError(
            f'wanted {{"gears": [three whole numbers], "frequencies": [three]}}, got '
            f"{words(answer)}"
        )
    found = []
    for key in KEYS:
        try:
            values = floats(answer[key])
        except (TypeError, ValueError):
            values = np.empty(0)
        if values.size == 1 and key == "gears":
            values = np.full(3, float(values.reshape(())))
        if values.size != 3 or not np.isfinite(values).all():
            raise ValueError(f"{key}: wanted three numbers, got {words(answer[key])}")
        found.append(values.reshape(3))
    gears, omega = found
    if (gears < 1).any() or (gears % 1).any() or (gears > 100_000).any():
        raise ValueError(f"gears: wanted whole numbers from 1 up, got {words(gears)}")
    if (omega == 0).any():
        raise ValueError(f"frequencies: every motor has to move, got {words(omega)}")
    return gears, abs(omega)


def close(values: Floats) -> bool:
    return bool(values.max() <= (1 + TOGETHER) * values.min())


def faults(answer: Drive, given: Any) -> list[Fault]:
    gears, omega = answer
    faults = []
    miss, most, seconds = (float(given[key]) for key in ("miss", "most", "seconds"))
    ends = COARSE / gears
    coarse = np.flatnonzero(ends > miss * (1 + 1e-9))
    if coarse.size:
        k = int(ends.argmax())
        moves, allowed = apart(ends[k] / mm, miss / mm, 2)
        faults.append(
            (
                "too coarse",
                f"Half a pulse of motor {k + 1} moves the end of the stretched arm by {moves} mm; "
                f"allowed are {allowed} mm. Half a pulse turns the "
                f"joint by 0.9° / gear, and the end is {LENGTHS[k] / mm:.0f} mm away from it.",
            )
        )
    fast = np.flatnonzero(omega > most * (1 + 1e-9))
    if fast.size:
        runs, allowed = apart(omega[fast[0]], most)
        says = f"Motor {fast[0] + 1} runs at {runs} pulses/s; allowed are {allowed}."
        faults.append(("above the limit", says))
    pulses = pulses_of(given, gears)
    times = pulses / omega
    if not close(times):
        faults.append(apart_fault(given, gears, omega, pulses, times))
    if times.max() > seconds * (1 + 1e-9):
        faults.append(slow_fault(given, gears, omega, pulses, times))
    return faults


def apart_fault(
    given: Any, gears: Floats, omega: Floats, pulses: Floats, times: Floats
) -> Fault:
    told = ", ".join(f"{t:.3f}" for t in times)
    says = f"The motors need {told} s for {', '.join(f'{p:.0f}' for p in pulses)} pulses."
    long = long_way(given, gears)
    if close(long / omega):
        return (
            "the long way round",
            f"{says} Your frequencies are for {long[0]:.0f} pulses of motor 1: from one side of "
            "the direction 180° to the other the short way does not pass 0°.",
        )
    if close(pulses * omega):
        return (
            "equal products",
            f"{says} The products of pulses and frequency are equal. A time is pulses divided by "
            "frequency.",
        )
    if np.ptp(omega) < 1e-9:
        return (
            "one frequency for all",
            f"{says} With one frequency for all, the motor with the most pulses stops last.",
        )
    turns = abs(turns_of(places(given)))
    if close(turns / omega):
        return (
            "the gears left out",
            f"{says} The frequencies are in proportion to the turns of the joints, not to the "
            "pulses: the gears are left out.",
        )
    if close(turns / gears / omega):
        return (
            "divided by the gear",
            f"{says} A gear of i : 1 asks for i times as many pulses, not for an i-th of them.",
        )
    return "not together", says


def long_way(given: Any, gears: Floats) -> Floats:
    """The pulses without the short way."""
    q = station_postures(LOADER, np.reshape(places(given), (2, 3)))
    q[:, 0] = wrapped(q[:, 0])
    return np.asarray(abs(np.diff(counts(q, gears / STEP), axis=0)[0]), dtype=float)


def slow_fault(
    given: Any, gears: Floats, omega: Floats, pulses: Floats, times: Floats
) -> Fault:
    most, seconds = float(given["most"]), float(given["seconds"])
    best = float(pulses.max()) / most
    takes, allowed = apart(times.max(), seconds)
    says = f"The move takes {takes} s; allowed are {allowed} s."
    if best <= seconds:
        return (
            "slower than the limit asks",
            f"{says} These gears can keep the time, with higher frequencies.",
        )
    k = int(pulses.argmax())
    return (
        "geared too high",
        f"{says} Even at {most:.0f} pulses/s motor {k + 1} takes longer than that: its gear of "
        f"{gears[k]:.0f} : 1 is finer than asked.",
    )


