"""Numbers for pages and figures, the same on every processor: rounding, ticks, the choice of
samples, and compact integers.
"""

import base64
import math
from collections.abc import Iterable, Sequence
from typing import Any, TypeAlias, TypedDict

import numpy as np

from .._arrays import ArrayLike, Bools, Floats, Ints
from ..motion.recording import Recording

Scale: TypeAlias = tuple[float, float, int, int]  # lowest tick, step, number of ticks, decimals

# bytes: maximum size of all joint values, speeds and accelerations, unless 41 samples need more
DATA_BYTES = 570_000
NOTHING = -32768  # the integer for "no value"
# added before rounding, so that every processor rounds an exact half in the same way
TIE = 2e-7 * np.sqrt(2)
EQUAL = 1e-6  # two speeds that differ by less than this share are equal but for rounding
STEPS = np.array([0.1, 0.2, 0.25, 0.5, 1, 2, 2.5, 5, 10, 20])  # of ticks


class Packed(TypedDict):
    """Numbers (motions, samples, columns) in compact form: 16-bit integers times a step size.

    steps  for each motion, one step size for all columns, or a list with one for each column
    data   the integers in base64, by motion, column and sample. We store the second differences
           over the samples (as if two zeros preceded the first sample), each as 2 d or, if d is
           negative, as -2 d - 1, in groups of seven bits, the lowest group first. A byte above 127
           means that the number continues. The integer -32768 means "no value here".
    """

    steps: list[float | list[float]]
    data: str


def tidy(x: float, decimals: int) -> float:
    """Round x. An exact half is always rounded up, even in the presence of rounding errors, and the
    result is never a negative zero.
    """
    scale = 10.0**decimals
    return float(np.floor(float(x) * scale + 0.5 + TIE) / scale) + 0.0


def rounded(values: ArrayLike, decimals: int = 9) -> list[float]:
    """Return all values in one list, rounded with `tidy`."""
    return [tidy(x, decimals) for x in np.ravel(values)]


def packed(values: Floats, finest: float, groups: Sequence[Bools] = ()) -> Packed:
    """Return numbers (motions, samples, columns) as `Packed`. The greatest value of each motion is
    about `finest` steps. The columns of a group share a step size; without groups, all columns do.

    Each motion has its own step size, since one extreme value would make the other motions coarse.
    We store second differences, since nearly all of them fit into one byte for 241 samples of a
    smooth curve.
    """
    steps = np.empty((len(values), 1, values.shape[-1]))
    for group in groups or [np.ones(values.shape[-1], dtype=bool)]:
        if group.any():
            part = np.nan_to_num(values[..., group])
            greatest = abs(part).max(axis=(1, 2), initial=0)
            least = [series_step(x * (1 + TIE) / finest) for x in greatest]
            steps[..., group] = np.array(least)[:, None, None]
    whole = np.floor(values / steps + 0.5 + TIE)
    whole = np.where(np.isnan(whole), NOTHING, whole).astype(np.int64)
    rows = [[float(f"{step:.0e}") for step in row] for row in steps[:, 0]]
    return {
        "steps": [row[0] if len(set(row)) == 1 else row for row in rows],
        "data": base64.b64encode(_differences(whole)).decode(),
    }


def _differences(whole: Ints) -> bytes:
    second = np.diff(np.diff(whole, axis=1, prepend=0), axis=1, prepend=0)
    second = second.transpose(0, 2, 1).ravel()
    folded = np.where(second < 0, -2 * second - 1, 2 * second)
    groups = folded[:, None] >> np.array([0, 7, 14])
    last = 0 + (folded > 127) + (folded > 16383)
    sevens: Ints = (groups & 127) + 128 * (np.arange(3) < last[:, None])
    return bytes(sevens[np.arange(3) <= last[:, None]].tolist())


def series_step(least: float) -> float:
    """Return the smallest number of the series 1, 2, 5, 10, ... that is not below `least`. The
    series begins at a millionth.
    """
    least = max(least, 1e-6)
    power = 10.0 ** np.floor(np.log10(least) + 1e-12)
    return float(next(power * k for k in (1, 2, 5, 10) if power * k >= least * (1 - 1e-12)))


def thin(count: int, tracks: Sequence[Recording], wanted: int) -> Ints:
    """Return the samples, out of `count`, that the page contains: evenly spread ones, those on both
    sides of each jump, and those with the greatest speed and acceleration of each motion, so that
    the curves reach the values in the table.
    """
    values = sum(track.q.shape[0] * track.q.shape[2] for track in tracks)
    wanted = min(count, wanted, max(41, int(DATA_BYTES / (3 * values * 1.1 * 4 / 3))))
    extra: set[int] = set()
    for track in tracks:
        for jump in track.jumps:
            extra.update((jump.first - 2, jump.first, jump.last, jump.last + 2))
        for motion in track.gaps[np.any(track.gaps, axis=-1)]:
            edges = np.flatnonzero(motion[1:] != motion[:-1]) + 1
            extra.update(
                np.concatenate(
                    [edges, edges + 1] + [[i, i + 1] for i in np.flatnonzero(motion)[:1]]
                ).tolist()
            )
    extra = {i for i in extra if 0 < i < count - 1}
    if len(extra) > wanted // 3:
        extra = set()
    for peak in _peaks(tracks):
        if len(extra) < wanted // 3 and 0 < peak < count - 1:
            extra.add(peak)
    even = np.floor(np.linspace(0, count - 1, wanted - len(extra)) + 0.5 + TIE).astype(int)
    return np.array(sorted({*even.tolist(), *extra}))


def _peaks(tracks: Sequence[Recording]) -> list[int]:
    """Return the samples with the greatest speeds and accelerations of each motion, beginning with
    the greatest of all. Of samples that are equal but for rounding, it returns the first.
    """
    found: list[tuple[float, int]] = []
    for track in tracks:
        for values in (track.v, track.a):
            most = np.nan_to_num(abs(values)).max(axis=-1)  # (motions, samples)
            height = most.max(initial=0)
            at = (most >= (1 - EQUAL) * most.max(axis=-1, keepdims=True)).argmax(axis=-1)
            found += [
                (-round(float(row[k] / height), 6), int(k))
                for row, k in zip(most, at, strict=True)
                if height > 0
            ]
    return list(dict.fromkeys(k for _, k in sorted(found)))


def scales(ranges: Sequence[Any]) -> list[Scale]:
    """Return the scale for one range (low, high), or the scales for two ranges in one panel, whose
    zeros and ticks are at the same heights.
    """
    ranges = [[float(f"{x:.6g}") if abs(x) > 1e-6 else 0.0 for x in ends] for ends in ranges]
    if len(ranges) == 1:
        return [scale(*ranges[0])]
    best: list[Scale] = []
    most = 0.0
    for below, above in ((i, n - i) for n in range(2, 6) for i in range(n + 1)):
        if all((below or low >= 0) and (above or high <= 0) for low, high in ranges):
            least = [max(high / (above or 1), -low / (below or 1)) for low, high in ranges]
            steps = [float(f"{series_step(x):.6g}") if x else 1.0 for x in least]
            filled = sum(
                (max(high, 0) - min(low, 0)) / step
                for (low, high), step in zip(ranges, steps, strict=True)
            )
            if filled / (below + above) > most * 1.001 or not best:
                best, most = (
                    [_ticks(-below * x, x, below + above + 1) for x in steps],
                    filled / (below + above),
                )
    return best


def scale(low: float, high: float) -> Scale:
    """Return the scale with Matplotlib's ticks for at most four intervals: the least step of 1, 2,
    2.5 or 5 times a power of ten that is at least a quarter of the range, or a smaller one if fewer
    than two ticks are within the range. The outermost ticks are at or beyond the data.
    """
    low, high = (float(f"{x:.6g}") if abs(x) > 1e-6 else 0.0 for x in (low, high))
    if high - low < 1e-6 * max(abs(low), abs(high), 1e-3):
        pad = 0.5 * max(abs(low), 1.0)
        low, high = low - pad, high + pad
    middle, rough = (low + high) / 2, (high - low) / 4
    far = abs(middle) >= 400 * rough  # then count from a power of ten, as Matplotlib does
    origin = np.copysign(10.0 ** np.floor(np.log10(abs(middle))), middle) if far else 0.0
    low, high = low - origin, high - origin
    steps = 10.0 ** math.floor(math.log10(rough)) * STEPS
    for step in reversed(steps[: np.searchsorted(steps, (high - low) / 4) + 1]):
        near = max(1e-10, 1e-12 * abs(origin) / step)  # how near a tick may be to an end, in steps
        under = low // step * step
        first, last = np.floor((low - under) / step + near), np.ceil((high - under) / step - near)
        ticks = np.arange(first, last + 1) * step + under
        if ((low <= ticks) & (ticks <= high)).sum() >= 2:
            break
    return _ticks(float(f"{ticks[0] + origin:.6g}"), float(f"{step:.6g}"), len(ticks))


def _ticks(low: float, step: float, count: int) -> Scale:
    """Return (lowest tick, step, number of ticks, decimals needed to write them)."""
    return (
        low + 0.0,
        step,
        count,
        next(d for d in range(12) if abs(step - round(step, d)) < 1e-9 * step),
    )


def fewest(values: Floats, most: int = 2) -> int:
    """Return the smallest number of decimals, but at most `most`, that represents these values
    exactly.
    """
    return next(
        (
            d
            for d in range(most)
            if np.allclose(values, values.round(d), rtol=0, atol=1e-9, equal_nan=True)
        ),
        most,
    )


def decimals(curves: Iterable[Floats]) -> int:
    """Return the number of decimals for one quantity, from one to three: the smaller its greatest
    value, the more decimals.
    """
    greatest = max(np.nanmax(abs(c), initial=0, where=~np.isnan(c)) for c in curves)
    return 1 if greatest >= 10 else 2 if greatest >= 1 else 3
