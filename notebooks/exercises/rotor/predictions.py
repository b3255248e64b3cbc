"""The facts behind the predictions. p8 and p10 were first asked in the lab on motors in step."""

from functools import cache
from typing import Any

import numpy as np

from robokin import deg
from robokin.jobs.steppers import ramp

from .shared import MOTOR, ONES, PULSES


def p8() -> dict[str, Any]:
    """The torque of the next winding, 90° ahead, on a magnet and on plain iron."""
    ahead = 90 * deg
    magnet, iron = float(np.sin(ahead)), abs(round(float(np.sin(2 * ahead)), 9))
    right = "cannot tell" if iron < 1e-6 < magnet else "as a magnet"
    return {"magnet": magnet, "iron": iron, "right": right}


@cache
def missed() -> dict[str, dict[int, int]]:
    """How many of 48 steps the motor of the lab loses, for each frequency in pulses per second:
    without a ramp, and with a ramp of 0.1 s that starts at 40.
    """
    tempos = range(60, 281, 10)
    return {
        "without a ramp": {f: MOTOR.run(ramp(PULSES, f, f, 0), ONES).lost for f in tempos},
        "with a ramp": {f: MOTOR.run(ramp(PULSES, 40, f, 0.1), ONES).lost for f in tempos},
    }


def p10() -> dict[str, Any]:
    found = sorted({n for ways in missed().values() for n in ways.values()} - {0})
    alone = missed()["without a ramp"]
    return {
        "some": ", ".join(map(str, found)),
        "few": found[0],
        "tempo": 160,
        "lost": alone[160],
        "made": PULSES - alone[160],
        "all_from": max(f for f, n in alone.items() if n < PULSES) + 10,  # the next frequency
        "runs": sum(map(len, missed().values())),
        "right": "only fours" if np.gcd.reduce(found) == 4 else "any number",
    }


@cache
def p1() -> dict[str, Any]:
    """The maximum start frequency of the motor alone, and with three times its inertia as a load,
    in pulses per second.
    """
    alone, loaded = (MOTOR.start_frequency(load_inertia=k * MOTOR.inertia) for k in (0, 3))
    share = loaded / alone
    slower = "about half" if share > 0.4 else "a quarter"
    right = "the same" if 0.99 < share < 1.01 else slower if share < 1 else "faster"
    return {
        "alone": alone,
        "loaded": loaded,
        "half": alone / 2,
        "right": right,
    }
