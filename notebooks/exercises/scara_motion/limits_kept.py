"""Cases, form and law of exercise 2; its text is in the Markdown file beside it."""

from typing import Any

import numpy as np

from robokin import SCARA, deg, mm
from robokin.course.forms import truth

from .shared import HIGH, LOW, MINUS, Floats


def cases(rng: np.random.Generator) -> list[tuple[Floats]]:
    """Motions: limits reached, limits broken, NaN, at the first, a middle and the last sample."""
    still = np.array([0.1, 0.5, 0.2, 0.1])

    def one(sample: int, joint: int, value: float, count: int = 25) -> tuple[Floats]:
        q = np.tile(still, (count, 1))
        q[sample, joint] = value
        return (q,)

    unit = np.array([deg, deg, deg, mm])
    found: list[tuple[Floats]] = [(np.tile(still, (3, 1)),)]
    for joint in (3, 0, 1, 2):
        for limit, side in ((LOW[joint], -1), (HIGH[joint], 1)):
            # exact only for the stroke, since converting an angle to degrees rounds it
            edge = float(limit) if joint == 3 else float(limit) - side * 1e-7
            found += [one(k, joint, edge, count=3) for k in (0, 1, 2)]
            found.append(one(1, joint, float(limit) + side * 2e-6, count=3))
            for past in (0.5, 20.0):
                value = float(limit + side * past * unit[joint])
                found += [one(0, joint, value, 3), one(13, joint, value), one(24, joint, value)]
    found += [one(1, 1, 145 * deg, 3), one(1, 0, 145 * deg, 3), one(1, 2, 300 * deg, 3)]
    # a whole turn further, which only joint 3 may be
    found += [one(1, 0, 370 * deg, 3), one(1, 1, -350 * deg, 3)]
    for sample in (10, 12):  # one is a fifth or tenth sample, the other a third one
        found += [one(sample, 3, 0.2), one(sample, 0, 145 * deg)]
    found += [one(1, 3, 5.0, 3), one(1, 3, 100.0, 3)]  # a stroke in mm
    # past every limit that may be confused with it
    found += [one(1, 3, 200.0, 3), one(1, 3, -0.25, 3)]
    found += [one(1, 2, float(HIGH[2]) + 0.8 * deg, 3)]  # rounded to a degree, or one too far
    for row in (0, 13, 24):
        q = np.tile(still, (25, 1))
        q[row] = np.nan
        found.append((q,))
    found.append((np.full((3, 4), np.nan),))
    found.append((np.tile(HIGH + 0.1, (3, 1)),))  # no joint is inside
    for _ in range(12):
        ends = rng.uniform(LOW, HIGH, (2, 4))
        found.append((np.linspace(ends[0], ends[1], 25),))  # inside
        beyond = ends + np.eye(4)[rng.integers(4)] * (HIGH - LOW) * 1.1
        found.append((np.linspace(ends[0], beyond[1], 25),))
    return found


def form(result: Any, case: tuple[Floats]) -> bool:
    return truth(result, "for the whole motion")


def law(case: tuple[Floats], yours: bool, wanted: bool) -> str | None:
    (q,) = case
    if yours == wanted:
        return None
    if wanted:
        says = "every value of this motion keeps its limits (the limits included): True is right"
        sample, joint = divmod(int(np.argmin(np.minimum(q - LOW, HIGH - q))), 4)
        value = float(q[sample, joint])
        limit = float(min(LOW[joint], HIGH[joint], key=lambda x: abs(x - value)))
        if abs(value - limit) > 1e-6:
            return says
        if value == limit:
            return f"{says}; sample {sample} has joint {joint + 1} at its limit"
        si = "m" if joint == 3 else "rad"
        at = f"sample {sample} has joint {joint + 1} at {value:.7f} {si}, its limit is {limit:.7f}"
        return f"{says}; {at} {si}".translate(MINUS)
    sample, joint = divmod(int(np.argmax(~((q >= LOW) & (q <= HIGH)))), 4)
    where = f"sample {sample} of {len(q)} (counted from 0)"
    if np.isnan(q[sample, joint]):
        return f"{where} is a row of NaN, out of reach: False is right"
    si, size, unit = ("m", mm, " mm") if joint == 3 else ("rad", deg, "°")
    value, low, high = (x / size for x in (q[sample, joint], LOW[joint], HIGH[joint]))
    limit, side = (low, "below") if value < low else (high, "above")
    excess = abs(value - limit)
    digits = 1 if excess > 0.05 else 4 if unit == "°" else 3
    return (
        f"{where} has joint {joint + 1} at {value * size:.7f} {si}, {excess:.{digits}f}{unit} "
        f"{side} its limit of {limit:.0f}{unit}: False is right"
    ).translate(MINUS)


def limits(joint: int, low: float, high: float) -> Floats:
    """For wrong programs: the limits, with other ones for one joint."""
    found = SCARA.limits.copy()
    found[joint - 1] = low, high
    return found.T
