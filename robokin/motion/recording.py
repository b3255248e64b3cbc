"""The recording of a motion: its derivatives, jumps and limits, computed once for all code that
draws or checks it.

Differences across a jump say nothing about the motion: the "acceleration" at a corner is the jump
in speed divided by the time step (errata S1-m), and the "speed" of a wrapped angle is 2 pi divided
by the time step (S1-e). This module finds and reports both kinds of jump, and computes no
differences across them.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from .._arrays import ArrayLike, Bools, Floats, Ints, Sealed, frozen, sealed
from .._validate import TWO_TURNS, floats, instance, short, warn_if_degrees
from ..arms.arm import Arm
from ..arms.branches import SLACK
from .derivatives import differentiate, rising

LEAP = 0.002  # rad or m: a smaller change is never a jump in position
FEW = 8  # with fewer changes in speed than this, the noise level is unknown
# a jump: index of its motion, first and last sample, time, and the values (n,) before and after it
Found: TypeAlias = tuple[int, int, int, float, Floats, Floats]


@dataclass(frozen=True, eq=False)
class Jump(Sealed):
    """A jump in the joint values, or in the speeds, of one motion.

    motion         the index of the motion in the batch, so that `recording.q[jump.motion]` is the
                   motion; () for a single motion
    first, last    the samples around the jump; equal if the jump is at a sample
    time           the time of the jump in s: half-way between these samples
    before, after  (n,) the values on both sides of the jump, extrapolated from the samples beside
                   it, in rad or m, or per second for speeds; equal for joints that do not jump
    """

    motion: tuple[int, ...]
    first: int
    last: int
    time: float
    before: Floats
    after: Floats

    @property
    def by(self) -> Floats:
        """The size of each joint's jump, (n,); 0 for joints that do not jump."""
        return self.after - self.before


class Extreme(NamedTuple):
    """The greatest (or lowest) value of each joint, and the time in seconds of the first sample
    with that value: both (..., n). They are NaN for a joint without values.
    """

    value: Floats
    time: Floats


@dataclass(frozen=True, init=False, repr=False, eq=False)
class Recording(Sealed):
    """Motions of one arm with n joints and N samples each; the leading axes are the batch. `record`
    makes a recording.

    t        (N,) seconds
    q, v, a  (..., N, n) joint values (rad; m if prismatic), speeds, accelerations. All of q is NaN
             where one of its joints is; v and a are NaN where they cannot be computed: in pieces of
             fewer than three samples, and a also at a jump in speed.
    missing  (..., N) bool: True where a sample has no posture
    gaps     (..., N - 1) bool: True where the position jumps between a sample and the next, or one
             of the two is missing
    leaps    a `Jump` for each jump in position
    jumps    a `Jump` for each jump in speed

    `recording[i]` is a part of the batch. All arrays are read-only. If you have more accurate
    speeds or accelerations than finite differences, use `dataclasses.replace(recording, v=v)`.
    Raises TypeError or ValueError if a part is of another type or shape.
    """

    arm: Arm
    t: Floats
    q: Floats
    v: Floats
    a: Floats
    missing: Bools
    gaps: Bools
    leaps: tuple[Jump, ...]
    jumps: tuple[Jump, ...]

    def __init__(
        self,
        arm: Arm,
        t: ArrayLike,
        q: ArrayLike,
        v: ArrayLike,
        a: ArrayLike,
        missing: ArrayLike,
        gaps: ArrayLike,
        leaps: tuple[Jump, ...],
        jumps: tuple[Jump, ...],
    ) -> None:
        n, count = len(instance(arm, Arm, "arm").limits), len(rising(t, 2))
        q = floats(q, "q", finite=False)
        shape = q.shape
        if q.ndim < 2 or shape[-2:] != (count, n):
            raise ValueError(f"q: wanted shape (..., {count}, {n}), got {shape}")
        for name, value, wanted in (
            ("t", t, (count,)),
            ("q", q, shape),
            ("v", v, shape),
            ("a", a, shape),
            ("missing", missing, shape[:-1]),
            ("gaps", gaps, (*shape[:-2], count - 1)),
        ):
            array: Any = floats(value, name, finite=False)
            if array.shape != wanted:
                raise ValueError(f"{name}: wanted shape {wanted}, got {array.shape}")
            if name in ("missing", "gaps"):
                array = np.asarray(value, dtype=bool)
            if array.flags.writeable:  # a read-only array needs no copy
                array = frozen(array)
            vars(self)[name] = array
        for name, found in (("leaps", leaps), ("jumps", jumps)):
            if not isinstance(found, tuple) or not all(isinstance(one, Jump) for one in found):
                raise TypeError(f"{name}: wanted a tuple of Jumps, got {short(found)}")
        vars(self).update(arm=arm, leaps=leaps, jumps=jumps)

    @property
    def shape(self) -> tuple[int, ...]:
        """The batch shape; () for a single motion."""
        return self.q.shape[:-2]

    @cached_property
    def excess(self) -> Floats:
        """The amount by which each joint exceeds its limit, in rad or m: (..., N, n), 0 inside the
        limits and NaN where a sample is missing. Angles are not wrapped: q + 2 pi k may be inside
        (see `within`).
        """
        low, high = self.arm.limits.T
        return _excess(np.maximum(low - self.q, self.q - high))

    @cached_property
    def speed_excess(self) -> Floats:
        """The amount by which each joint exceeds its speed limit, in rad/s or m/s: (..., N, n), 0
        where it does not or the arm has no speed limits, and NaN where there is no speed.
        """
        limits = self.arm.speed_limits
        return _excess(abs(self.v) - (np.inf if limits is None else limits))

    @cached_property
    def lowest(self) -> Extreme:
        """The lowest value of each joint, in rad or m."""
        value, time = _extreme(-self.q, self.t)
        return Extreme(sealed(-value), time)

    @cached_property
    def highest(self) -> Extreme:
        """The highest value of each joint, in rad or m."""
        return _extreme(self.q, self.t)

    @cached_property
    def greatest_speed(self) -> Extreme:
        """The greatest absolute speed over all samples, in rad/s or m/s."""
        return _extreme(abs(self.v), self.t)

    @cached_property
    def greatest_acceleration(self) -> Extreme:
        """The greatest absolute acceleration over all samples that have one, in rad/s² or m/s²."""
        return _extreme(abs(self.a), self.t)

    def __len__(self) -> int:
        if not self.shape:
            raise TypeError("a single Recording has no length")
        return self.shape[0]

    def __iter__(self) -> Iterator["Recording"]:
        return (self[i] for i in range(len(self)))

    def __getitem__(self, index: Any) -> "Recording":
        if not self.shape:
            raise TypeError("a single Recording has no parts")
        chosen = np.arange(self.missing[..., 0].size).reshape(self.shape)[index]
        moved = {int(k): i for i, k in np.ndenumerate(chosen)}

        def mine(jumps: tuple[Jump, ...]) -> tuple[Jump, ...]:
            places = (moved.get(int(np.ravel_multi_index(j.motion, self.shape))) for j in jumps)
            return tuple(
                replace(j, motion=i) for j, i in zip(jumps, places, strict=True) if i is not None
            )

        q, v, a = (sealed(x[index]) for x in (self.q, self.v, self.a))
        missing, gaps = (sealed(x[index]) for x in (self.missing, self.gaps))
        leaps, jumps = mine(self.leaps), mine(self.jumps)
        return Recording(self.arm, self.t, q, v, a, missing, gaps, leaps, jumps)

    def __repr__(self) -> str:
        samples = f"{len(self.t)} samples over {self.t[-1] - self.t[0]:g} s"
        return f"Recording({self.arm.name!r}, {samples}, shape={self.shape})"


def record(arm: Arm, t: ArrayLike, q: ArrayLike) -> Recording:
    """Return the `Recording` of the motion q (..., N, n) at two or more increasing times t (N,).

    Pass unwrapped angles (as `follow` returns them). NaN means that there is no posture. Speeds and
    accelerations are those of `differentiate`, for each unbroken piece separately. Warns
    (UserWarning) if the angles are probably in degrees, that is, if a motion begins more than two
    turns from zero and outside its limits, or goes beyond eight turns. Raises ValueError if the
    shapes do not match, the times do not increase, or a number is infinite.

    A joint's position jumps between two samples if it turns by more than pi there, or if the speed
    of this step lies outside the range of the three steps before and the three after it (at a
    corner it lies between them) by more than 8 times the width of that range. Where some of these
    steps are jumps themselves, only the similar ones among them are compared, and the step must be
    3 times as fast as those, or 10 times if only one side is known, at an end or beside a gap. A
    single outlier has a jump before it and a jump after it. A change below 2 mrad or 2 mm is not a
    jump, nor is a change within the noise, which is 10 times the lower quartile of the motion's
    changes in speed.

    Samples cannot distinguish a jump from a motion that takes less than two steps. Depending on
    where the samples fall, such a motion counts as a jump or not. Of the motions that we tried
    (point to point, flips, back and forth, sines), none that takes two steps from rest to rest, or
    five steps per period, counts as a jump. Two jumps in the same direction, or three in any
    direction, without another step between them look like a quick motion. If every other step of a
    motion is a jump, all of them count as noise.

    >>> t = np.linspace(0, 2, 201)
    >>> motion = record(SCARA, t, ptp([0, 0, 0, 0], [1, 1.5, 0, 0.1], quintic(2)(t)))
    >>> motion.greatest_speed.value.round(3)
    array([0.937, 1.406, 0.   , 0.094])
    >>> motion.greatest_speed.time[:2]
    array([1., 1.])
    """
    limits, prismatic = instance(arm, Arm, "arm").limits, arm.prismatic
    t, q = rising(t, 2), floats(q, "q", len(limits), finite=False)
    if q.ndim < 2 or q.shape[-2] != len(t):
        raise ValueError(f"q: wanted shape (..., {len(t)}, {len(limits)}), got {q.shape}")
    lead, q = q.shape[:-2], q.reshape(-1, *q.shape[-2:])
    missing: Bools = np.any(np.isnan(q), axis=-1)
    q = np.where(missing[..., None], np.nan, q)
    _warn(limits, prismatic, q, missing)
    with np.errstate(over="ignore"):
        steps = np.diff(q, axis=1)
        parts = _parts(steps, t, prismatic)
        gaps = parts.any(axis=-1) | missing[:, 1:] | missing[:, :-1]
        speeds = np.where(gaps[..., None], np.nan, steps) / np.diff(t)[:, None]
    v, a = _derivatives(q, t, gaps)
    leaps = _leaps(q, t, speeds, parts)
    jumps = _jumps(speeds, t)
    for c, first, last, _, before, after in jumps:
        around = np.arange(max(first - 1, 0), min(last + 2, len(t)))
        a[c, around[:, None], np.flatnonzero(before != after)] = np.nan
    q, v, a = (sealed(x.reshape(*lead, *x.shape[1:])) for x in (q, v, a))
    missing, gaps = (sealed(x.reshape(*lead, x.shape[1])) for x in (missing, gaps))
    return Recording(arm, t, q, v, a, missing, gaps, _named(leaps, lead), _named(jumps, lead))


def _parts(steps: Floats, t: Floats, prismatic: Bools) -> Bools:
    """A mask of the steps (C, N - 1, n) that are jumps in position, by the rule of `record`."""
    duration = np.diff(t)[:, None]
    least = LEAP / duration
    with np.errstate(invalid="ignore", over="ignore"):
        speeds = steps / duration
        found = np.zeros(steps.shape, dtype=bool)
        sides = _shifted(speeds, -1), _shifted(speeds, 1)
        out = np.fmax(speeds - np.fmax(*sides), np.fmin(*sides) - speeds)
        for c, j in np.argwhere((out > least).any(axis=1)):  # only these joints can jump
            column = speeds[c : c + 1, :, j : j + 1]
            changes = abs(np.diff(column[0, :, 0]))
            changes = np.sort(changes[np.isfinite(changes)])
            noise = 10 * changes[len(changes) // 4] if len(changes) >= FEW else 0.0
            found[c, :, j] = _lonely(column, np.fmax(least, noise))[0, :, 0]
        return found | ((abs(steps) > np.pi) & ~prismatic)


def _lonely(speeds: Floats, least: Floats) -> Bools:
    """A mask of the speeds (C, N - 1, n) that are outside the range of their neighbours by more
    than `least` (N - 1, 1), as the speeds before and after a single outlier are.
    """
    found: Bools = _outside(speeds, 1, 1) > least
    before = (_outside(speeds, 1, 2) > least) & (speeds * _shifted(speeds, 1) < 0)
    before[:, :-1] &= (_outside(speeds, 2, 1) > least)[:, 1:]
    found |= before
    found[:, 1:] |= before[:, :-1]
    return found


def _outside(speeds: Floats, left: int, right: int) -> Floats:
    """The amount by which each speed (C, N - 1, n) is outside the range of the `left` speeds before
    it and the `right` speeds after it; 0 where this may be a quick motion.
    """
    sides = _shifted(speeds, -left), _shifted(speeds, right)
    low, high = np.fmin(*sides), np.fmax(*sides)
    out = np.fmax(speeds - high, low - speeds)
    size, beside = abs(speeds), np.fmax(*map(abs, sides))
    near = far = high - low
    for side, k in zip(sides, (-left, right), strict=True):
        on = [abs(_shifted(speeds, k + i * np.sign(k)) - side) for i in (1, 2)]
        near, far = np.fmax(near, np.fmin(*on)), np.fmax(far, np.fmax(*on))
    both = np.isfinite(sides[0] + sides[1])
    alone = both & (out > 8 * far)
    crowd = (out > 8 * near) & (size > np.where(both, 3, 10) * beside)
    return np.where(alone | crowd, out, 0.0)


def _leaps(q: Floats, t: Floats, speeds: Floats, parts: Bools) -> list[Found]:
    """The jumps in position. The time of a jump is half-way between two samples, and the values on
    both sides are extrapolated to this time.
    """
    c, i = np.nonzero(parts.any(axis=-1))
    half, count = (t[i + 1] - t[i])[:, None] / 2, speeds.shape[1]

    def slope(j: Ints) -> Floats:
        exists = (j >= 0) & (j < count)
        return np.nan_to_num(np.where(exists[:, None], speeds[c, j % count], 0.0))

    before = q[c, i] + half * slope(i - 1)
    after = np.where(parts[c, i], q[c, i + 1] - half * slope(i + 1), before)
    times = t[i] + half[:, 0]
    sides = sealed(before), sealed(after)
    return list(zip(c.tolist(), i.tolist(), (i + 1).tolist(), times.tolist(), *sides, strict=True))


def _derivatives(q: Floats, t: Floats, gaps: Bools) -> tuple[Floats, Floats]:
    """The speeds and accelerations of each unbroken piece; NaN where a piece has fewer than three
    samples.
    """
    v, a = np.full_like(q, np.nan), np.full_like(q, np.nan)
    whole = ~gaps.any(axis=-1) & (len(t) >= 3)
    if whole.any():
        v[whole] = differentiate(q[whole], t)
        a[whole] = differentiate(v[whole], t)
    for c in np.flatnonzero(~whole):
        ends = np.flatnonzero(np.concatenate([[True], gaps[c], [True]]))
        for start, stop in zip(ends[:-1], ends[1:], strict=True):
            if stop - start >= 3:
                piece = slice(start, stop)
                v[c, piece] = differentiate(q[c, piece], t[piece])
                a[c, piece] = differentiate(v[c, piece], t[piece])
    return v, a


def _jumps(speeds: Floats, t: Floats) -> list[Found]:
    """The jumps in the speeds between samples (C, N - 1, n): changes that are far greater than
    nearby changes.

    In a smooth motion, all changes are roughly the acceleration times the step. We compare each
    change with those two samples away, since an adjacent change may belong to the same corner,
    which can lie between two samples. A change below a hundredth of the greatest speed is not a
    jump, nor is a change without neighbours on both sides.
    """
    change = abs(np.diff(speeds, axis=1))
    beside = np.maximum(_shifted(change, -2), _shifted(change, 2))
    greatest = np.fmax.reduce(abs(speeds), axis=1, keepdims=True)
    sure = change > 8 * beside + 0.01 * greatest + 1e-9
    part = change > 3 * beside + 1e-9
    found = []
    for c in np.flatnonzero(sure.any(axis=(1, 2))):
        for run in _groups(np.flatnonzero(sure[c].any(axis=-1))):
            first, last = run[0], run[-1]
            # A corner between two samples appears in two changes, perhaps only faintly in one of
            # them. (There are always two more changes on each side of a jump in `sure`.)
            first -= part[c, first - 1].any()
            last += part[c, last + 1].any()
            time = float((t[first + 1] + t[last + 1]) / 2)
            before = _towards(speeds[c], t, time, first, -1)
            after = _towards(speeds[c], t, time, last + 1, 1)
            joins = part[c, first : last + 1].any(axis=0)
            after = np.where(joins, after, before)
            sides = frozen(before), frozen(after)
            found.append((int(c), int(first) + 1, int(last) + 1, time, *sides))
    return found


def _towards(speeds: Floats, t: Floats, time: float, i: int, side: int) -> Floats:
    """The speeds (n,) at `time`, extrapolated linearly from interval i and the next one on that
    side.
    """
    here: Floats = speeds[i]
    j = i + side
    if not 0 <= j < len(speeds) or np.isnan(speeds[j]).any():
        return here
    ti, tj = (t[i] + t[i + 1]) / 2, (t[j] + t[j + 1]) / 2
    on: Floats = (speeds[j] - here) * (time - ti) / (tj - ti)
    return here + on


def _groups(numbers: Ints) -> list[Ints]:
    """Split ascending whole numbers where two neighbours differ by more than 2."""
    return np.split(numbers, np.flatnonzero(np.diff(numbers) > 2) + 1)


def _shifted(values: Floats, k: int) -> Floats:
    """Shift values (C, m, n) so that entry i + k moves to index i; NaN where there is none."""
    out = np.full_like(values, np.nan)
    m = values.shape[1]
    if abs(k) < m:
        out[:, max(-k, 0) : m - max(k, 0)] = values[:, max(k, 0) : m + min(k, 0)]
    return out


def _named(found: list[Found], lead: tuple[int, ...]) -> tuple[Jump, ...]:
    """The same jumps with the indices of their motions in the batch."""
    places = list(np.ndindex(lead))
    return tuple(Jump(places[c], *rest) for c, rest in ((one[0], one[1:]) for one in found))


def _excess(over: Floats) -> Floats:
    return sealed(np.where(over <= SLACK, 0.0, over))


def _extreme(values: Floats, t: Floats) -> Extreme:
    """The greatest of the values (..., N, n) over the samples, and its time."""
    values = np.where(np.isnan(values), -np.inf, values)
    at = values.argmax(axis=-2)
    greatest = np.take_along_axis(values, at[..., None, :], axis=-2)[..., 0, :]
    none = np.isneginf(greatest)
    return Extreme(*(sealed(np.where(none, np.nan, x)) for x in (greatest, t[at])))


def _warn(limits: Floats, prismatic: Bools, q: Floats, missing: Bools) -> None:
    """Warn if the angles are probably in degrees. A motion may continue to turn beyond all limits,
    but it begins inside or near them.
    """
    begin = np.take_along_axis(q, missing.argmin(axis=1)[:, None, None], axis=1)[:, 0]
    outside = (begin < limits[:, 0]) | (begin > limits[:, 1])
    farthest = abs(np.where(outside & ~prismatic, begin, 0.0)).max(initial=0.0)
    turning = np.array(farthest) if farthest > TWO_TURNS else q[..., ~prismatic]
    warn_if_degrees(turning, "q", stacklevel=4)
