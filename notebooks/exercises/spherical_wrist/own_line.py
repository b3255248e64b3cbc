"""Numbers, conditions and sentences of exercise 3; its text is in the Markdown file beside it."""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np

from robokin import ITMO6R, deg, differentiate, distance_from_singularity, follow, mm, quintic
from robokin.course.exercises import in_words
from robokin.course.slips import DEGREES
from robokin.course.told import apart, one_number
from robokin.course.variants import Numbers, dice

from .shared import ROW, tilted_line

COUNT = 4
T1 = np.linspace(0, 1, 401)
UNITS = {
    "slope": ("°", deg),
    "miss": ("mm", mm),
    "most_tilt": ("°", deg),
    "least_distance": ("", 1.0),
    "most_speed": ("°/s", deg),
    "longest": ("s", 1.0),
}
Given = Mapping[str, Any]
Fault = tuple[str, str]


def passage(numbers: Given, up: float, side: float) -> tuple[float, float]:
    """The smallest distance from a singularity on the line, and the greatest joint speed (rad/s) if
    the line takes one second. NaN: a pose is out of reach.
    """
    poses = tilted_line(numbers["slope"], numbers["miss"], up, side, quintic(duration=1)(T1))
    rows = ITMO6R.ik(poses)
    if np.isnan(rows[:, ROW]).any():
        return np.nan, np.nan
    q = follow(ITMO6R, rows, ROW)
    least = float(distance_from_singularity(ITMO6R, q).min())
    return least, float(abs(differentiate(q, T1)).max())


def across(slope: float, tilt: float) -> list[tuple[float, float]]:
    """(up, side) of the two tilts perpendicular to the line."""
    return [(e * tilt * np.cos(slope), -e * tilt * np.sin(slope)) for e in (1, -1)]


@cache
def numbers_of(who: str) -> tuple[tuple[str, float], ...]:
    roll = dice("spherical_wrist", who)
    slope = (25 + 5 * roll.randrange(6)) * (1 - 2 * roll.randrange(2)) * deg
    miss = (5 + roll.randrange(4)) * (1 - 2 * roll.randrange(2)) * mm
    tilt = (5 + roll.randrange(3)) * deg
    speed = (150 + 10 * roll.randrange(10)) * deg
    numbers = {"slope": slope, "miss": miss}
    found = [passage(numbers, *each) for each in across(slope, 0.97 * tilt)]
    least, fastest = max(pair for pair in found if np.isfinite(pair[0]))
    values = numbers | {
        "most_tilt": tilt,
        # a tilt to the other side stays below 0.86 of it
        "least_distance": float(np.floor(930 * least)) / 1000,
        "most_speed": speed,
        "longest": float(np.ceil(11.5 * fastest / speed)) / 10,
    }
    return tuple(values.items())


def given(who: Any) -> Numbers:
    """A line a few millimetres beside the singular pose, and the limits of the process. It can be
    solved: the limits are derived from the tilt perpendicular to the line, so that a tilt to one
    side satisfies them and no tilt to the other side does.
    """
    return Numbers(dict(numbers_of(str(who))), UNITS)


def form(answer: Any, given: Given) -> dict[str, float]:
    """up, side and duration as floats."""
    names = ("up", "side", "duration")
    if not isinstance(answer, Mapping):
        raise ValueError(f"Wanted a dict with up, side and duration, got {in_words(answer)}.")
    missing = [name for name in names if name not in answer]
    if missing:
        raise ValueError(f"Your dict has no {' and no '.join(map(repr, missing))}.")
    numbers = {}
    for name in names:
        try:
            numbers[name] = one_number(answer[name])
        except (TypeError, ValueError):
            raise ValueError(f"{name}: wanted a number, got {in_words(answer[name])}.") from None
        if not np.isfinite(numbers[name]):
            raise ValueError(f"{name}: wanted a number, got {numbers[name]}.")
    if numbers["duration"] <= 0:
        raise ValueError(f"duration: wanted seconds above 0, got {numbers['duration']:g}.")
    return numbers


def keeps(given: Given, up: float, side: float) -> bool:
    """Whether this tilt is small enough and keeps the arm far enough from a singularity."""
    if max(abs(up), abs(side)) > 2 * given["most_tilt"]:
        return False
    return bool(passage(given, up, side)[0] >= given["least_distance"])


def too_near(given: Given, up: float, side: float, tilt: float, least: float) -> Fault:
    """The fault of a tilt with which the arm comes too near a singularity."""
    is_at, wanted = apart(least, given["least_distance"], 4)
    across_it = abs(np.dot(across(given["slope"], 1.0)[0], (up, side)))
    line = (
        f"The smallest distance from a singularity on your line is {is_at}; it must be at least "
        f"{wanted}. You tilt the tool by {tilt / deg:.2f}° ({given['most_tilt'] / deg:.0f}° are "
        f"allowed). The component perpendicular to the line is {across_it / deg:.2f}°."
    )
    if keeps(given, up / deg, side / deg):
        return "deg twice", f"{line} You multiplied by deg twice: divide both tilts by deg."
    if tilt > 0.5 * given["most_tilt"] and across_it < 0.5 * tilt:
        line += " Because of the component along the line, the forearm passes the tool's direction "
        line += "a little earlier or later. Only the perpendicular component keeps them apart."
        return "tilted along the line", line
    if max(abs(up), abs(side)) < 1e-3:
        return "not tilted", line
    other = passage(given, -up, -side)[0]
    swapped = keeps(given, side, up)
    if swapped and not other >= given["least_distance"]:
        line += f" With up and side swapped, it would be {passage(given, side, up)[0]:.4f}."
        return "up and side swapped", line
    if other > least + 1e-4:
        line += f" With the same tilt to the other side, it would be {other:.4f}."
        if swapped:
            line += " With up and side swapped, it would also be right."
        return "tilted to the wrong side", line
    return "too near the singularity", line


def faults(answer: dict[str, float], given: Given) -> list[Fault]:
    """What is wrong with the tilt, the distance, the speeds and the duration."""
    up, side, duration = answer["up"], answer["side"], answer["duration"]
    tilt = np.arccos(np.clip(np.cos(up) * np.cos(side), -1, 1))
    found = []
    if max(abs(up), abs(side)) > np.pi / 2:
        return [("degrees for radians", DEGREES)] * 3
    if tilt > given["most_tilt"] + 1e-9:
        is_at, most = apart(tilt / deg, given["most_tilt"] / deg, 2)
        found.append(("tilted too far", f"The tilt is {is_at}°; at most {most}° is allowed."))
    least, fastest = passage(given, up, side)
    if np.isnan(least):
        says = "Part of the line is out of reach: the wrist centre is too far away. Tilt the tool "
        says += "less or in another direction."
        return [*found, ("out of reach", says)] + [("out of reach", "")] * 2
    if least < given["least_distance"] - 1e-9:
        found.append(too_near(given, up, side, tilt, least))
    speed = fastest / duration
    if speed > given["most_speed"] * (1 + 1e-9):
        is_at, most = apart(speed / deg, given["most_speed"] / deg)
        found.append(("too fast", f"One joint reaches {is_at}°/s; at most {most}°/s is allowed."))
    if duration > given["longest"] + 1e-9:
        longest, takes = apart(given["longest"], duration)
        found.append(("too slow", f"The line may take at most {longest} s; yours takes {takes} s."))
    return found
