"""Findings in recorded motions, for the text next to their curves: the greatest values, the
distance to a via point, jumps and gaps, and a summary in one sentence.
"""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from .._arrays import Bools, Floats, Ints
from ..arms.arm import Arm, ClosedFormArm
from ..arms.branches import unwrapped
from ..motion.recording import Recording
from ..units import deg, mm
from .camera import flange
from .numbers import TIE, rounded, tidy
from .page import Flaws, Greatest, PageArm, Slider, Switch, Unit


def greatest(track: Recording, units: Floats, length: str, decimals: Sequence[int]) -> Greatest:
    """Return the greatest speed, its percentage of the limit, and the greatest acceleration, for
    each motion and joint.
    """
    arm, limits = track.arm, track.arm.speed_limits
    speed = np.nan_to_num(track.greatest_speed.value)
    acceleration = np.nan_to_num(track.greatest_acceleration.value) / units
    rows: list[list[float | str]] = [[tidy(x, decimals[1]) for x in row] for row in acceleration]
    jumps = np.zeros_like(speed)
    for jump in track.jumps:
        jumps[jump.motion] = np.fmax(jumps[jump.motion], abs(jump.by) / units)
    for motion, joint in np.argwhere(jumps > 0):
        name = length if arm.prismatic[joint] else "°"
        rows[motion][joint] = (
            f"jump {tidy(jumps[motion, joint], decimals[0]):.{decimals[0]}f} {name}/s"
        )
    share = None
    if limits is not None:
        share = [[int(tidy(x, 0)) for x in row] for row in 100 * speed / limits]
    return {
        "speed": [[tidy(x, decimals[0]) for x in row] for row in speed / units],
        "share": share,
        "acceleration": rows,
    }


def sampled(t: Floats, leaps: bool = False) -> str:
    """Say which samples the greatest values come from, since values between the samples are not
    included; with `leaps`, also that jumps of position are not included.
    """
    least, most = np.diff(t).min(), np.diff(t).max()
    even = most - least < 1e-3 * most
    step = f"every {tidy(most, 6):.4g} s" if even else f"at most {tidy(most, 6):.4g} s apart"
    rest = ", without the jumps in position" if leaps else ""
    return f"greatest values of {len(t)} samples, {step}{rest}"


def closest(arm: Arm, q: Floats, via: Floats, unit: float) -> list[list[float] | None]:
    """Return [smallest distance from the via point in the length unit, x, y, z of the nearest place
    in metres] for each motion, or None if it has no path. `via` has the shape (motions or 1, 1, 3).

    The path is the polyline through all samples; NaN interrupts it.
    """
    path = flange(arm, q).translation - via
    place = np.broadcast_to(via, (len(path), 1, 3))[:, 0]
    side = np.diff(path, axis=1)
    length = (side**2).sum(axis=-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        along = np.clip(np.where(length > 0, -(path[:, :-1] * side).sum(axis=-1) / length, 0), 0, 1)
    near = path[:, :-1] + along[..., None] * side
    distance = np.where(np.isnan(near[..., 0]), np.inf, np.linalg.norm(near, axis=-1))
    best = distance.argmin(axis=-1)
    found: list[list[float] | None] = []
    for c, i in enumerate(best):
        d = distance[c, i]
        found.append(
            [tidy(d / unit, 1 if unit == mm else 3), *rounded(near[c, i] + place[c], 4)]
            if np.isfinite(d)
            else None
        )
    return found


def flags(arm: ClosedFormArm, *rows: int) -> str:
    """Return the name of a branch: its number and its flags, such as "2: +1 −1 +1". Of several
    branches, it has all numbers, and ±1 for a flag in which they differ.
    """
    signs = zip(*(arm.branches[k] for k in rows), strict=True)
    words = [f"{each[0]:+d}" if len({*each}) == 1 else "±1" for each in signs]
    return f"{', '.join(map(str, rows))}: {' '.join(words)}".replace("-", "\N{MINUS SIGN}")


def rows(arm: Arm, q: Floats) -> list[list[tuple[int, str]]] | None:
    """Return the rows of `ik` to which the postures of each motion in q (motions, samples, n)
    belong, as pairs of the first sample and the name of the row. Return None if the arm has no
    inverse or only one row.

    Where rows coincide at a singularity, a posture keeps the row of the previous sample; where the
    motion begins or ends there, it has the names of all these rows.
    """
    if not isinstance(arm, ClosedFormArm) or len(arm.branches) < 2:
        return None
    solved = arm.ik(arm.fk(q))  # (motions, samples, rows, n)
    away = abs(unwrapped(arm, solved, q[..., None, :]) - q[..., None, :]).max(axis=-1)
    belongs = away < 1e-6  # False for NaN
    found = []
    for motion in belongs:
        runs: list[tuple[int, str]] = []
        clear = np.flatnonzero(motion.sum(axis=-1) == 1)
        among: list[int] = []
        for i in np.flatnonzero(motion.any(axis=-1)).tolist():
            here = np.flatnonzero(motion[i]).tolist()
            inner = len(clear) and clear[0] <= i <= clear[-1]
            if inner:
                here = [row for row in among if row in here][:1] or here[:1]
            if here != among:
                among = here
                runs.append((i, f"row{'s' * (len(here) > 1)} {flags(arm, *here)}"))
        found.append(runs)
    return found


def spells(t: Floats, holds: Bools) -> str:
    """Return the times at which `holds` is true as text: "from 0.00 to 6.72 s". If there are
    several intervals, this is the first one, followed by the number of the others.
    """
    edges = np.flatnonzero(np.diff(np.concatenate([[False], holds, [False]]).astype(int)))
    first = f"from {tidy(t[edges[0]], 2):.2f} to {tidy(t[edges[1] - 1], 2):.2f} s"
    return first + again(len(edges) // 2 - 1)


def again(times: int) -> str:
    return f" and {times} more time{'s' * (times > 1)}" if times > 0 else ""


def flaws(track: Recording, kept: Ints, units: Floats, length: str) -> Flaws:
    """Return the flaws of each motion that has any: the gaps between kept samples, the jumps to
    mark with their labels, and sentences.
    """
    gaps: dict[int, list[int]] = {}
    jumps: dict[int, list[Any]] = {}
    leaps: dict[int, list[Any]] = {}
    notes: dict[int, list[str]] = {}
    short: dict[tuple[int, float], str] = {}  # of the jumps by more than half a turn
    arm, count = track.arm, len(track.t)

    def amount(value: float, j: int, per: str = "") -> str:
        space, value = "" if not arm.prismatic[j] and not per else " ", abs(value) / units[j]
        # One decimal or, for small values, two significant digits.
        decimals = int(np.clip(1 - np.floor(np.log10(value * (1 + TIE) or 1)), 1, 9))
        unit = length if arm.prismatic[j] else "°"
        return f"{tidy(value, decimals):.{decimals}f}{space}{unit}{per}"

    for c, motion in enumerate(track.gaps):
        inside = np.add.reduceat(motion, kept[:-1]) if motion.any() else np.zeros(1)
        if inside.any():
            gaps[c] = np.flatnonzero(inside).tolist()
    for found, marks, what, per in (
        (track.jumps, jumps, "speed jumps by {by}", "/s"),
        (track.leaps, leaps, "q{j} jumps by {by}", ""),
    ):
        for jump in found:
            j = int((abs(jump.by) / units).argmax())  # the joint with the largest jump
            words = what.format(j=j + 1, by=amount(jump.by[j], j, per))
            marks.setdefault(jump.motion[0], []).append([tidy(jump.time, 6), words])
            rest = 360 - abs(jump.by[j]) / deg
            if found is track.leaps and not arm.prismatic[j] and -TIE < rest < 180:
                short[jump.motion[0], marks[jump.motion[0]][-1][0]] = (
                    f" (the short way round: {max(tidy(rest, 1), 0):.1f}°)"
                )
    for c in range(len(track)):
        for j, excess in enumerate(track.excess[c].T):
            if (excess > 0).any():
                notes.setdefault(c, []).append(
                    f"q{j + 1} exceeds its limit in {(excess > 0).sum()} of {count} samples, "
                    f"{spells(track.t, excess > 0)}, by up to {amount(np.nanmax(excess), j)}."
                )
        for j, excess in enumerate(track.speed_excess[c].T):
            if (excess > 0).any():
                notes.setdefault(c, []).append(
                    f"q{j + 1} exceeds its speed limit in {(excess > 0).sum()} of {count} samples, "
                    f"{spells(track.t, excess > 0)}."
                )
        if track.missing[c].any():
            notes.setdefault(c, []).append(
                f"No solution in {track.missing[c].sum()} of {count} samples."
            )
    for c, marked in jumps.items():
        times = ", ".join(f"{when:.2f}" for when, _ in marked[:3])
        more = again(len(marked) - 3)
        notes.setdefault(c, []).append(
            f"The speed jumps at {times} s{more}, so there is no finite acceleration."
        )
    for c, marked in leaps.items():
        first = "; ".join(
            f"{text} at {when:.2f} s{short.get((c, when), '')}" for when, text in marked[:3]
        )
        more = f"; and {len(marked) - 3} more" if len(marked) > 3 else ""
        notes.setdefault(c, []).append(f"Jumps in position: {first}{more}.")

    def told(flaws: dict[int, Any]) -> dict[str, Any]:
        return {str(c): value for c, value in sorted(flaws.items())}

    return {"gaps": told(gaps), "jumps": told(jumps), "leaps": told(leaps), "notes": told(notes)}


def summary_and_alt(
    arms: Sequence[PageArm],
    t: Floats,
    targets: Iterable[str],
    unit: Unit,
    slider: Slider | None,
    switch: Switch | None,
) -> tuple[str, str]:
    """Return a summary of the player in one sentence, with rounded numbers, and the alt text of its
    still picture.
    """
    who = " and ".join(dict.fromkeys(arm["name"] for arm in arms))
    parts = [f"{tidy(t[-1] - t[0], 3):g} s"]
    if slider:
        values = slider["values"]
        parts.append(f"{slider['label']} {values[0]:g} to {values[-1]:g} in {len(values)} values")
    if switch:
        parts.append(f"{switch['label']} {' or '.join(switch['values'])}")
    for arm in arms:
        label = f"{arm['name']}: " if len(arms) > 1 else ""
        speeds = arm["speed"]
        fastest = max(range(len(speeds[0])), key=lambda j: max(row[j] for row in speeds))
        name = unit["name"] if arm["chain"][fastest]["prismatic"] else "°"
        apart = ", apart from jumps of position," if arm["leaps"] else ""
        parts.append(
            f"{label}greatest speed of {len(t)} samples{apart} "
            f"{max(row[fastest] for row in speeds):g} {name}/s (joint {fastest + 1})"
        )
        if arm["via"] and any(arm["via"]):
            near = [v[0] for v in arm["via"] if v]
            ends = f"{min(near):g}" if min(near) == max(near) else f"{min(near):g} to {max(near):g}"
            parts.append(f"{label}smallest distance from the via point {ends} {unit['name']}")
    summary = f"Player of {who}: {', '.join(parts)}."
    through = f" past {', '.join(targets)}" if targets else ""
    alt = f"{who} in the first and last posture, with the tool's path{through}. {summary}"
    return summary, alt
