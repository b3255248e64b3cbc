"""The text above a panel of curves: limits, jumps, greatest values."""

from collections.abc import Iterator, Sequence

import numpy as np

from .._arrays import Bools, Floats, Ints
from ..motion.recording import Jump, Recording
from .scene import number

PER = {"q": "", "v": "/s", "a": "/s²"}


def about_limits(recording: Recording, kind: str, joints: Ints, past: Bools) -> list[str]:
    """Say how many samples of each joint exceed a limit. If none does, say so or, for speeds, say
    what percentage of the speed limit is reached.
    """
    limits = recording.arm.speed_limits
    if past.any():
        what = {"q": "limit", "v": "speed limit"}[kind]
        counts = past.sum(axis=0)
        said: list[str] = []
        for i in sorted(np.flatnonzero(counts), key=lambda i: -counts[i]):
            rest = (
                f"past its {what} in {counts[i]} of {len(past)} samples"
                if not said
                else f"in {counts[i]}"
            )
            said.append(f"joint {joints[i] + 1} {rest}")
        either = np.any(past, axis=1).sum()
        if either > counts.max():
            said.append(f"one or another in {either}")
        return [", ".join(said)]
    if kind == "q":
        if len(joints) == 1:
            return [f"q{joints[0] + 1} inside its limits"]
        if len(joints) == len(recording.arm.links):
            return ["every joint inside its limits"]
        return [f"{', '.join(f'q{j + 1}' for j in joints)} inside their limits"]
    if kind == "v" and limits is not None:
        share = np.nan_to_num(recording.greatest_speed.value[joints]) / limits[joints]
        most = int(share.round(9).argmax())
        who = f"q{joints[most] + 1}"
        return [f"at most {number(100 * share[most], 2)} % of the speed limit ({who})"]
    return []


def leap_words(
    recording: Recording, kind: str, joints: Ints, unit: str, size: float
) -> Iterator[str]:
    """Describe the jumps in position, joint by joint."""
    for joint in joints if kind == "q" else ():
        jumps = [jump for jump in recording.leaps if jump.by[joint]]
        amounts = sorted(abs(jump.by[joint]) / size for jump in jumps)
        if jumps:
            alike = number(amounts[0]) == number(amounts[-1])
            amount = f"{'' if alike else 'up to '}{number(amounts[-1])}{space(unit)}{unit}"
            yield f"q{joint + 1} jumps by {amount} at {_times(jumps)}"


def spike_words(
    recording: Recording, kind: str, joints: Ints, spikes: Bools, values: Floats, unit: str
) -> Iterator[str]:
    """Describe the spikes in the caller's values where a jump makes the speed or acceleration
    undefined.
    """
    for jumps, what in (
        (recording.leaps, f"{'angle jump' if unit == '°' else 'jump'} / step"),
        (recording.jumps, "speed jump / step"),
    ):
        marked = [
            jump for jump in jumps if spikes[beside_jump(jump)][:, jump.by[joints] != 0].any()
        ]
        if marked:
            size = np.zeros_like(values)
            for jump in marked:
                part = beside_jump(jump)
                size[part] = np.where(spikes[part], abs(values[part]), 0.0)
            where = np.unravel_index(size.round(6).argmax(), size.shape)
            most = f"{number(size[where])} {unit}{PER[kind]} (q{joints[where[1]] + 1})"
            yield f"spike at {_times(marked)}: {what}, up to {most}"
            spikes = spikes & (size == 0)


def corner_words(
    recording: Recording, kind: str, joints: Ints, unit: str, size: float, missing: Bools
) -> Iterator[str]:
    """Say where the speed jumps, so that no acceleration is drawn."""
    jumps = [
        jump
        for jump in (recording.jumps if kind == "a" else ())
        if missing[jump.first : jump.last + 1][:, jump.by[joints] != 0].any()
    ]
    if jumps:
        amounts = np.array([abs(jump.by[joints]) / size for jump in jumps])
        most = amounts.max(axis=0).round(6)
        i = int(most.argmax())
        amount = f"{number(most[i])} {unit}/s (q{joints[i] + 1})"
        yield f"none at {_times(jumps)}: the speed jumps, by up to {amount}"


def range_words(
    recording: Recording, kind: str, name: str, joints: Ints, unit: str, size: float
) -> str:
    """Say which range the curves cover, rounded so that rounding errors do not show."""
    gap = space(unit)
    if kind == "q":
        parts = []
        for joint in joints:
            reached = [recording.lowest.value[joint], recording.highest.value[joint]]
            ends = [number((x / size).round(6).round(1), 4) for x in reached if not np.isnan(x)]
            span = f"{' to '.join(dict.fromkeys(ends))}{gap}{unit}" if ends else "missing"
            parts.append(f"q{joint + 1} {span}")
        return f"{name.capitalize()}: {', '.join(parts)}."
    extreme = recording.greatest_speed if kind == "v" else recording.greatest_acceleration
    greatest = np.nan_to_num(extreme.value[joints] / size).round(6)
    i = int(greatest.argmax())
    return f"Greatest {name} {number(greatest[i], 3)}{gap}{unit}" + (
        f" (q{joints[i] + 1})." if greatest[i] else "."
    )


def beside_jump(jump: Jump) -> slice:
    """Return the samples whose differences, of any order, extend across a jump."""
    return slice(max(jump.first - 2, 0), jump.last + 3)


def space(unit: str) -> str:
    return "" if unit == "°" else " "


def _times(jumps: Sequence[Jump]) -> str:
    if len(jumps) < 4:
        return f"{' and '.join(number(jump.time) for jump in jumps)} s"
    return f"{len(jumps)} places"
