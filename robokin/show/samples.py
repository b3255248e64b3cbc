"""Speeds and accelerations fit to be drawn: differentiated piece by piece, with the jumps named and
left out.

Differences across a jump say nothing about the motion: a corner's "acceleration" is the jump of the
speed divided by the time step (errata S1-m), a wrapped angle's "speed" is 2 pi divided by it
(S1-e). Here both are found and reported.
"""

from dataclasses import dataclass

import numpy as np

from .. import differentiate

# rad or m: a smaller step from one sample to the next is never taken for a jump of position
LEAP = 0.1


@dataclass(frozen=True, eq=False)
class Samples:
    """Motions of one arm at full resolution; C motions of N samples with n joints each.

    q, v, a   (C, N, n) joint values, speeds, accelerations; NaN where there is none to show
    breaks    (C, N - 1) bool: between these two samples the position jumps, or one of the two does
              not exist
    leaps     [(motion, sample, steps)]: position jumps between `sample` and the next, steps (n,)
    jumps     [(motion, first, last, before, after)]: speed jumps at the samples first..last, and
              the speeds (n,) on both sides, equal for the joints that do not take part
    """

    q: np.ndarray
    v: np.ndarray
    a: np.ndarray
    breaks: np.ndarray
    leaps: list
    jumps: list


def samples(q, t, prismatic):
    """From joint values q (C, N, n) at the times t (N,), NaN rows where there is no solution."""
    missing = np.isnan(q).any(axis=-1)
    steps = np.diff(q, axis=1)
    leap = _leaps(steps, prismatic)
    breaks = leap.any(axis=-1) | missing[:, 1:] | missing[:, :-1]
    v, a = _derivatives(q, t, breaks, missing)
    jumps = _jumps(np.where(breaks[..., None], np.nan, steps) / np.diff(t)[:, None], t)
    for motion, first, last, before, after in jumps:
        around = np.arange(max(first - 1, 0), min(last + 2, len(t)))
        a[motion, around[:, None], np.flatnonzero(before != after)] = np.nan
    _continue_to_the_ends(a, t, breaks)
    leaps = [(int(c), int(i), steps[c, i]) for c, i in np.argwhere(leap.any(axis=-1))]
    return Samples(np.where(missing[..., None], np.nan, q), v, a, breaks, leaps, jumps)


def _leaps(steps, prismatic):
    """Which steps (C, N - 1, n) are jumps: a turn by more than pi, or ten times as far as the steps
    beside it.
    """
    size = abs(steps)
    beside = np.fmax(_shifted(size, 1), _shifted(size, -1))
    return ((size > np.pi) & ~prismatic) | ((size > LEAP) & (size > 10 * beside))


def _derivatives(q, t, breaks, missing):
    """Speeds and accelerations, each unbroken run for itself; NaN where a run has fewer than three
    samples.
    """
    v, a = np.full_like(q, np.nan), np.full_like(q, np.nan)
    whole = ~breaks.any(axis=-1)
    if whole.any():
        v[whole], a[whole] = differentiate(q[whole], t), differentiate(q[whole], t, 2)
    for c in np.flatnonzero(~whole):
        for run in _runs(breaks[c]):
            if run.stop - run.start >= 3 and not missing[c, run].any():
                v[c, run] = differentiate(q[c, run], t[run])
                a[c, run] = differentiate(q[c, run], t[run], 2)
    return v, a


def _jumps(speeds, t):
    """Where the speeds between samples (C, N - 1, n) jump: a change far greater than the changes
    beside it.

    A smooth motion's changes are all of the size acceleration x step; those two and three samples
    away tell it (the next one shares a corner that lies between two samples). Less than a hundredth
    of the greatest speed is no jump, nor is what has no neighbours on both sides.
    """
    change = abs(np.diff(speeds, axis=1))
    beside = np.maximum(
        *(np.fmax(_shifted(change, 2 * side), _shifted(change, 3 * side)) for side in (-1, 1))
    )
    with np.errstate(invalid="ignore"):
        greatest = np.fmax.reduce(abs(speeds), axis=1, keepdims=True)
        sure = change > 8 * beside + 0.01 * greatest + 1e-9
        part = change > 3 * beside + 1e-9
    found = []
    for c in np.flatnonzero(sure.any(axis=(1, 2))):
        for run in _groups(np.flatnonzero(sure[c].any(axis=-1))):
            first, last = run[0], run[-1]
            # A corner between two samples shows in two changes, in one of them perhaps faintly.
            first -= bool(first > 0 and part[c, first - 1].any())
            last += bool(last + 1 < len(part[c]) and part[c, last + 1].any())
            middle = (t[first + 1] + t[last + 1]) / 2
            before = _towards(speeds[c], t, middle, first, -1)
            after = _towards(speeds[c], t, middle, last + 1, 1)
            joins = part[c, first : last + 1].any(axis=0)
            found.append(
                (int(c), int(first) + 1, int(last) + 1, before, np.where(joins, after, before))
            )
    return found


def _towards(speeds, t, time, i, side):
    """The speeds (n,) at `time`, on the straight line through those of interval i and of the next
    one on its side.
    """
    j = i + side
    if not 0 <= j < len(speeds) or np.isnan(speeds[j]).any():
        return speeds[i]
    ti, tj = (t[i] + t[i + 1]) / 2, (t[j] + t[j + 1]) / 2
    return speeds[i] + (speeds[j] - speeds[i]) * (time - ti) / (tj - ti)


def _continue_to_the_ends(a, t, breaks):
    """In place: a difference of one-sided differences is only first-order right, and it shows as a
    spike at the ends. So the first two and the last two accelerations of each run lie on the
    straight line through the two next to them.
    """
    whole = ~breaks.any(axis=-1)
    _straighten(a, t, whole, 0, a.shape[1])
    for c in np.flatnonzero(~whole):
        for run in _runs(breaks[c]):
            _straighten(a, t, slice(c, c + 1), run.start, run.stop)


def _straighten(a, t, motions, start, stop):
    if stop - start < 6:
        return
    for i, j, ends in (
        (start + 2, start + 3, (start, start + 1)),
        (stop - 3, stop - 4, (stop - 1, stop - 2)),
    ):
        slope = (a[motions, j] - a[motions, i]) / (t[j] - t[i])
        for end in ends:
            a[motions, end] = a[motions, i] + slope * (t[end] - t[i])


def _runs(breaks):
    """Slices between the breaks (N - 1,) of one motion."""
    edges = [0, *(np.flatnonzero(breaks) + 1).tolist(), len(breaks) + 1]
    return [slice(i, j) for i, j in zip(edges, edges[1:], strict=False)]


def _groups(numbers):
    """Ascending whole numbers, split where two are more than 2 apart."""
    return np.split(numbers, np.flatnonzero(np.diff(numbers) > 2) + 1)


def _shifted(values, k):
    """values (C, m, n) with entry i + k in place i; NaN where there is none."""
    out = np.full_like(values, np.nan)
    m = values.shape[1]
    if abs(k) < m:
        out[:, max(-k, 0) : m - max(k, 0)] = values[:, max(k, 0) : m + min(k, 0)]
    return out
