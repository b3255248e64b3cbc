"""Cases, form and law of exercise 2; its text is in the Markdown file beside it."""

from typing import Any

import numpy as np

from robokin import deg, mm
from robokin.course.forms import truth

from .shared import MINUS, Floats

Case = tuple[Floats, Floats, Any]  # q, limits as in the data sheet, which joints are lengths

# the SCARA of this lab, one with its stroke as joint 3, and a gantry
SHEETS: tuple[tuple[list[list[float]], list[bool], list[float]], ...] = (
    ([[-140, 140], [-150, 150], [-400, 400], [0, 180]], [False] * 3 + [True], [6, 7, 11, 100]),
    ([[-130, 130], [-145, 145], [0, 200], [-360, 360]], [False, False, True, False], [6, 7, 60, 5]),
    ([[0, 700], [50, 500], [-300, 0], [-180, 180]], [True] * 3 + [False], [400, 90, -120, 5]),
)


def ends(limits: Floats, lengths: Any) -> Floats:
    """The lower and the upper limits (2, 4), in rad and m."""
    return limits.T * np.where(lengths, mm, deg)


def cases(rng: np.random.Generator) -> list[Case]:
    """Motions that reach or exceed limits, or have NaN, at the start, in the middle, at the end."""
    found = []
    for sheet in SHEETS:
        limits, lengths, still = (np.array(x) for x in sheet)
        rest = still * np.where(lengths, mm, deg)
        low, high = ends(limits, lengths)
        motions = _motions(rest, low, high, lengths, rng)
        found += [(q, limits.astype(float), lengths) for q in motions]
    return found


def _motions(
    rest: Floats, low: Floats, high: Floats, lengths: Any, rng: np.random.Generator
) -> list[Floats]:
    def one(sample: int, joint: int, value: float, count: int = 25) -> Floats:
        q = np.tile(rest, (count, 1))
        q[sample, joint] = value
        return q

    unit = np.where(lengths, mm, deg)
    found = [np.tile(rest, (3, 1))]
    for joint in map(int, np.argsort(~lengths, kind="stable")):  # lengths first
        for limit, side in ((low[joint], -1), (high[joint], 1)):
            # exact only at 0, since converting a limit rounds it
            edge = float(limit) - side * 1e-7 * (limit != 0)
            found += [one(k, joint, edge, count=3) for k in (0, 1, 2)]
            found.append(one(1, joint, float(limit) + side * 2e-6, count=3))
            for past in (0.5, 20.0):
                value = float(limit + side * past * unit[joint])
                found += [one(0, joint, value, 3), one(13, joint, value), one(24, joint, value)]
    last, turns = (
        int(np.flatnonzero(lengths)[-1]),
        [int(joint) for joint in np.flatnonzero(~lengths)],
    )
    for joint in turns:  # whole turns further
        found += [one(1, joint, rest[joint] + side * 4 * np.pi, 3) for side in (-1, 1)]
    for sample in (10, 12):  # one is a fifth or tenth sample, the other a third one
        found += [one(sample, last, high[last] + 20 * mm)]
        found += [one(sample, turns[0], high[turns[0]] + 5 * deg)]
    # a length in mm; past every limit that may be confused with it
    found += [one(1, last, value, 3) for value in (5.0, 100.0, 900.0, -0.8)]
    found.append(one(1, turns[0], 500.0, 3))  # past every limit in degrees
    found += [one(1, turns[-1], float(high[turns[-1]]) + 0.8 * deg, 3)]  # rounded to a degree
    for row in (0, 13, 24):
        q = np.tile(rest, (25, 1))
        q[row] = np.nan
        found.append(q)
    found.append(np.full((3, 4), np.nan))
    found.append(np.tile(high + 0.1, (3, 1)))  # no joint is inside
    for _ in range(6):
        first, then = rng.uniform(low, high, (2, 4))
        found.append(np.linspace(first, then, 25))  # inside
        beyond = then + np.eye(4)[rng.integers(4)] * (high - low) * 1.1
        found.append(np.linspace(first, beyond, 25))
    return found


def form(result: Any, case: Case) -> bool:
    return truth(result, "for the whole motion")


def law(case: Case, yours: bool, wanted: bool) -> str | None:
    q, limits, lengths = case
    if yours == wanted:
        return None
    low, high = ends(limits, lengths)
    if wanted:
        says = "every value of this motion is inside or at its limits, so the answer is True"
        sample, joint = divmod(int(np.argmin(np.minimum(q - low, high - q))), 4)
        value = float(q[sample, joint])
        limit = float(min(low[joint], high[joint], key=lambda x: abs(x - value)))
        if abs(value - limit) > 1e-6:
            return says
        if value == limit:
            return f"{says}; in sample {sample}, joint {joint + 1} is at its limit"
        si = "m" if lengths[joint] else "rad"
        at = f"in sample {sample}, joint {joint + 1} is at {value:.7f} {si}"
        return f"{says}; {at}, its limit is {limit:.7f} {si}".translate(MINUS)
    sample, joint = divmod(int(np.argmax(~((q >= low) & (q <= high)))), 4)
    where = f"sample {sample} of {len(q)} (counted from 0)"
    if np.isnan(q[sample, joint]):
        return f"{where} is a row of NaN, out of reach, so the answer is False"
    si, size, unit = ("m", mm, " mm") if lengths[joint] else ("rad", deg, "°")
    value = q[sample, joint] / size
    limit, side = limits[joint][1], "above"
    if value < limits[joint][0]:
        limit, side = limits[joint][0], "below"
    excess = abs(value - limit)
    digits = 1 if excess > 0.05 else 4 if unit == "°" else 3
    return (
        f"in {where}, joint {joint + 1} is at {value * size:.7f} {si}, {excess:.{digits}f}{unit} "
        f"{side} its limit of {limit:.0f}{unit}, so the answer is False"
    ).translate(MINUS)


def untested(limits: Floats, lengths: Any, joints: Any, sides: Any = (0, 1)) -> Floats:
    """For wrong programs: the limits in rad and m, infinite for these joints and sides."""
    found = ends(limits, lengths)
    for side in sides:
        found[side, joints] = (-np.inf, np.inf)[side]
    return found
