"""Exercise 1: a student's own load, and the mistakes in its ramp."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from math import ceil
from typing import Any

import numpy as np

from robokin.course.exercises import in_words
from robokin.course.told import apart, one_number
from robokin.course.variants import Numbers, dice
from robokin.jobs.steppers import Stepper, ramp

from .shared import MOTOR, ONES, PULSES

COUNT = 3
KEYS = ("start", "end", "seconds")
WEAK = replace(MOTOR, torque=0.8 * MOTOR.torque)
SHARE = 0.75  # the time allowed, as a share of the shortest time without a ramp
NEAR = 0.85  # a start above this share of the start frequency leaves no room for a rise,
ROOM = 0.6  # and one at this share does
ONLY_FULL = "only with the full torque"
LONGEST = 10.0  # s: a longer move is not simulated
RISE = "The frequency has to rise: `end` above `start`, and `seconds` above 0."
Fault = tuple[str, str]
Ramp = tuple[float, float, float]  # start and end in pulses/s, and its time in s


def given(who: Any) -> Numbers:
    """A load and a time that is too short for a start at one frequency."""
    load = dice("rotor", who).randrange(10, 42, 2) * 1e-7
    without = PULSES / fastest_start(WEAK, load)
    values = {"load_inertia": load, "within": ceil(100 * SHARE * without - 1e-9) / 100}
    return Numbers(values, {"load_inertia": ("g cm²", 1e-7), "within": ("s", 1.0)})


def form(answer: Any, numbers: Any) -> Ramp:
    if not isinstance(answer, Mapping) or not set(KEYS) <= set(answer):
        wanted = 'wanted {"start": pulses/s, "end": pulses/s, "seconds": s}'
        raise ValueError(f"{wanted}, got {in_words(answer)}")
    found = []
    for key in KEYS:
        try:
            value = one_number(answer[key])
        except (TypeError, ValueError):
            value = float("nan")
        if not (0 < value < 1e6 or (value == 0 and key == "seconds")):
            raise ValueError(f"{key}: wanted a positive number, got {in_words(answer[key])}")
        found.append(value)
    start, end, seconds = found
    return start, end, seconds


def faults(answer: Ramp, numbers: Any) -> list[Fault]:
    start, end, _ = answer
    if start > end:  # no condition can be checked
        says = (
            f"The ramp begins at `start`, {start:g} pulses/s, and rises to `end`, {end:g} "
            "pulses/s: `end` has to be higher."
        )
        return [("start and end exchanged", says)] * COUNT
    load, within = float(numbers["load_inertia"]), float(numbers["within"])
    times = ramp(PULSES, *answer)
    takes = float(times[-1])
    found = []
    if takes <= LONGEST:
        full, weak = (each.run(times, ONES, 0, load).lost for each in (MOTOR, WEAK))
        if full:
            name, change = why_lost(answer, MOTOR, load)
            found.append((name, f"It loses {full} of {PULSES} steps. {change}"))
        if weak:
            name, change = why_lost(answer, WEAK, load)
            says = f"With 80 % of its torque the motor loses {weak} of {PULSES} steps."
            found.append((name, says) if full else (ONLY_FULL, f"{says} {change}"))
    if takes > within:
        took, allowed = apart(takes, within, 2)
        says = f"The move takes {took} s; {allowed} s are allowed. {too_slow(answer, within)}"
        late = answer[2] > 1 and ramp(PULSES, *answer[:2], answer[2] / 1000)[-1] <= within
        if late:
            says += " The time of the ramp is in seconds."
        name = "no ramp" if is_flat(answer) else "too slow"
        found.append(("milliseconds for seconds" if late else name, says))
    return found


@cache
def fastest_start(motor: Stepper, load: float) -> float:
    return motor.start_frequency(load_inertia=load)


def too_slow(answer: Ramp, within: float) -> str:
    """Why the move takes too long, and what to change."""
    start, end, seconds = answer
    needed = PULSES / within
    if is_flat(answer):
        return RISE
    if end < needed:
        return f"The mean frequency should be at least {ceil(needed)} pulses/s: raise `end`."
    top = 1 / float(np.diff(ramp(PULSES, *answer)).min())
    if top < 0.99 * end:
        return (
            f"In {seconds:g} s, the frequency would rise to {end:.0f} pulses/s, but the move is so "
            f"short that it reaches only {top:.0f}: shorten the ramp."
        )
    return "Raise `start` or `end`, or shorten the ramp."


def why_lost(answer: Ramp, motor: Stepper, load: float) -> Fault:
    """The name of the mistake in a ramp with which this motor loses steps, and what to change."""
    start, end, seconds = answer
    if is_flat(answer):
        return "no ramp", RISE
    top, weak = fastest_start(motor, load), fastest_start(WEAK, load)
    if start > top:
        return (
            "begins too fast",
            f"From rest, it cannot follow {start:.0f} pulses/s: lower `start`.",
        )
    if start > weak:
        change = f"From rest, the weaker motor follows at most {weak:.0f} pulses/s: lower `start`."
        return "begins too fast", change
    lower = ramp(PULSES, ROOM * weak, end, seconds)
    if start > NEAR * weak and not motor.run(lower, ONES, 0, load).lost:
        change = "It begins too close to the weaker motor's start frequency: lower `start`."
        return "begins too fast", change
    change = "The frequency rises too steeply or too far: raise `seconds`, or lower `end`."
    return "too steep or too fast", change


def is_flat(answer: Ramp) -> bool:
    """Whether the frequency hardly rises."""
    start, end, seconds = answer
    return seconds == 0 or end < 1.01 * start
