"""Numbers, conditions and sentences of exercise 3; its text is in the Markdown file beside it."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from robokin import IRB140, deg, explain, mm, within
from robokin.course.exercises import in_words
from robokin.course.function import Fault
from robokin.course.slips import METRES
from robokin.course.told import apart, one_number
from robokin.course.variants import Numbers, dice

from .shared import Floats, listed, target

COUNT = 4
SLACK = 1.2  # the duration may be this many times the shortest
SAMPLES = 2001
EASE = 1.005  # with other samples the greatest speed differs by up to 0.2 %
UNITS = {
    **dict.fromkeys(("x_start", "x_end", "y_start", "y_end"), ("mm", mm)),
    "turn": ("° about y", deg),
    "share": ("% of every speed limit", 0.01),
    "longest": ("times the shortest duration", 1.0),
}


def given(who: Any) -> Numbers:
    """A target that moves behind the arm, across the line where joint 1 is at half a turn. The arm
    can follow it only while facing away from it, and only above a certain height.
    """
    roll = dice("irb140_kinematics", who)
    side = 1 - 2 * roll.randrange(2)
    x_start = -320 + 10 * roll.randrange(5)
    x_end = x_start + 80 + 10 * roll.randrange(5)
    y_start = -side * (200 + 20 * roll.randrange(4))
    y_end = side * (150 + 10 * roll.randrange(6))
    turn = 90 - 180 * roll.randrange(2)
    share = 20 + 5 * roll.randrange(7)
    values = {
        "x_start": x_start * mm,
        "x_end": x_end * mm,
        "y_start": y_start * mm,
        "y_end": y_end * mm,
        "turn": turn * deg,
        "share": share / 100,
        "longest": SLACK,
    }
    return Numbers(values, UNITS)


def form(answer: Any, given: Any) -> dict[str, Any]:
    """Height and duration as floats, and three flags of +1 or -1."""
    if not isinstance(answer, Mapping):
        raise ValueError(f"Wanted a dict with height, flags and duration, got {in_words(answer)}.")
    missing = [key for key in ("height", "flags", "duration") if key not in answer]
    if missing:
        raise ValueError(f"Your dict has no {' and no '.join(repr(key) for key in missing)}.")
    flags = np.asarray(answer["flags"], dtype=object).ravel().tolist()
    if len(flags) != 3 or any(isinstance(x, bool) or x not in (1, -1) for x in flags):
        got = in_words(answer["flags"])
        raise ValueError(f"flags: wanted three of +1 and -1, (+1, -1, +1), got {got}.")
    design: dict[str, Any] = {"flags": tuple(int(x) for x in flags)}
    for key, unit in (("height", "metres"), ("duration", "seconds")):
        try:
            value = one_number(answer[key])
        except (TypeError, ValueError):
            value = np.nan
        if not np.isfinite(value) or (key == "duration" and value <= 0):
            raise ValueError(f"{key}: wanted a number of {unit}, got {in_words(answer[key])}.")
        design[key] = value
    return design


def faults(design: Mapping[str, Any], given: Mapping[str, Any]) -> list[Fault]:
    """What is wrong: a pose out of reach, a limit exceeded, a motion too fast or too slow."""
    height, duration = design["height"], design["duration"]
    if height > 5:
        name = "mm for m" if height >= 200 else "cm for m"
        return [(name, f"The height is {height:g} m. {METRES}")] * 4
    row = IRB140.branch(*design["flags"])
    p = np.linspace(0, 1, SAMPLES)
    poses = target(given, p, height)
    rows = IRB140.ik(poses)[:, row]
    missing = np.isnan(rows).any(axis=-1)
    if missing.any():
        i = int(missing.argmax())
        says = (
            f"Out of reach for {missing.mean():.0%} of the time, first at t = "
            f"{p[i] * duration:.2f} s. {explain(IRB140, poses[i], row)}"
        )
        return [("out of reach", says)] * 4
    q = np.unwrap(rows, axis=0)
    past, rate = past_limits(q, p * duration), speeds(q, duration, given)
    if not past or any(name.startswith("a jump") for name, _ in rate):
        return [*past, *rate]
    # Another height or other flags will change the speeds, so the reply does not mention them.
    name, says = past[0]
    if design["flags"][0] > 0:
        says += (
            " Your target moves behind the arm, and with front +1, joint 1 is at ±180° where the "
            "wrist centre is exactly behind it."
        )
    return [(name, says)] * (1 + len(rate))


def past_limits(q: Floats, t: Floats) -> list[Fault]:
    """The joints that leave their limits whatever whole turns we add."""
    turns = 2 * np.pi * np.arange(-3, 4)
    names, lines, ends = [], [], True
    for k, (low, high) in enumerate(IRB140.limits):
        track = q[:, k, None] + turns
        over = np.maximum(track - high, low - track)  # (samples, whole turns)
        best = int(over.max(axis=0).argmin())
        i = int(over[:, best].argmax())
        if over[i, best] <= 1e-6:
            continue
        limit = high if track[i, best] > high else low
        names.append(k + 1)
        past = over[:, best] > 1e-6
        ends &= not past[[0, -1]].any()
        lines.append(
            f"Joint {k + 1} is past its limit of {limit / deg:.0f}° by "
            f"{apart(over[i, best] / deg, 0)[0]}° at t = {t[i]:.2f} s (it is past the limit from "
            f"{t[past][0]:.2f} to {t[past][-1]:.2f} s)."
        )
        if within(IRB140, q)[:, k].all():
            ends = False
            ways = track[:, best] / deg
            lines.append(
                "Each single sample has a value inside the limits, but one continuous motion does "
                f"not stay inside: the joint turns between {ways.min():.1f}° and "
                f"{ways.max():.1f}°, or the same range shifted by whole turns, and each of these "
                "ranges exceeds a limit."
            )
    if not names:
        return []
    which = f"joint {names[0]}" if len(names) == 1 else f"joints {listed(names)}"
    if ends:
        lines.append("At both ends, every joint is inside: look at the motion in between.")
    return [(f"past a limit: {which}", " ".join(lines))]


def speeds(q: Floats, duration: float, given: Mapping[str, Any]) -> list[Fault]:
    """What is wrong if the fastest joint exceeds its share of the speed limit or is far below."""
    dt = duration / (len(q) - 1)
    steps = abs(np.diff(q, axis=0))
    if steps.max() > 1.5:
        i, k = np.unravel_index(int(steps.argmax()), steps.shape)
        says = (
            f"Joint {k + 1} jumps by {steps[i, k] / deg:.0f}° at t = {i * dt:.2f} s, because with "
            "these flags the arm passes a singularity."
        )
        return [(f"a jump: joint {k + 1}", says)] * 2
    assert IRB140.speed_limits is not None
    used = steps / dt / IRB140.speed_limits
    i, k = np.unravel_index(int(used.argmax()), used.shape)
    most, share = float(used[i, k]), given["share"]
    busiest = (
        f"Joint {k + 1} is closest to its speed limit, at t = {i * dt:.2f} s. There it uses "
        f"{{}} your share of {100 * share:.0f} %"
    )
    if most > EASE * share:
        says = f"{busiest.format('more than')}. The motion needs more time."
        return [(f"too fast: joint {k + 1}", says)]
    if most * SLACK * EASE < share:
        says = (
            f"{busiest.format('less than')}. Choose a shorter duration: at most {SLACK} times the "
            "shortest one is allowed, and speeds are proportional to 1 / duration."
        )
        return [("slower than asked", says)]
    return []
