"""Functions that choose among the solutions of the inverse kinematics: `within`, `nearest`,
`follow`, `explain`.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from .._arrays import ArrayLike, Bools, Floats
from .._validate import broadcast, floats, instance, warn_if_degrees, whole
from ..transform import Transform
from ..units import deg, mm, wrapped
from .arm import Arm, ClosedFormArm
from .explanations import SENTENCES
from .scara import ScaraPose

TURN = 2 * np.pi
SLACK = 1e-9  # a joint that exceeds its limit by no more than this counts as being at the limit


def within(arm: Arm, q: ArrayLike) -> Bools:
    """Return whether each joint of the posture q (..., n) is within its limits: bool (..., n).

    A revolute joint is within its limits if q + 2 pi k is, for some whole number k. NaN is never
    within the limits. Warns (UserWarning) if an angle is so large that it is probably in degrees.

    >>> from robokin import IRB140, deg, within
    >>> within(IRB140, np.array([0, 120, 0, 0, 0, 390]) * deg)
    array([ True, False,  True,  True,  True,  True])
    """
    values = floats(q, "q", len(instance(arm, Arm, "arm").links), finite=False)
    warn_if_degrees(values[..., arm.turning], "q", posture=1)
    return _within(arm, values)


def representative(arm: Arm, q: ArrayLike) -> Floats:
    """The joint values to display. For each joint, this is the value q + 2 pi k that is nearest to
    q among those inside the limits or, if none is inside, the one that exceeds the limits least.

    q (..., n) -> (..., n). A prismatic joint has only one value.

    >>> from robokin import IRB140, deg, representative
    >>> q = np.array([0, 0, -300, 0, 0, 0]) * deg  # joint 3 ranges from -230 to 50 degrees
    >>> (representative(IRB140, q) / deg).round(1).tolist()
    [0.0, 0.0, 60.0, 0.0, 0.0, 0.0]
    """
    values = floats(q, "q", len(instance(arm, Arm, "arm").links), finite=False)
    value, (low, high) = _inside(arm, values, values), arm.limits.T
    # Two candidates outside the limits: the lowest value above the upper limit and the highest
    # value below the lower limit.
    above = value - TURN * np.floor((value - high) / TURN)
    below = value + TURN * np.floor((low - value) / TURN)
    least = np.where(above - high <= low - below, above, below)
    outside = (value < low - SLACK) | (value > high + SLACK)
    return np.where(outside & ~arm.prismatic, least, value)


def unwrapped(arm: Arm, q: ArrayLike, near: ArrayLike) -> Floats:
    """The value q + 2 pi k nearest to `near`, for each revolute joint. The arguments are (..., n)
    and are broadcast.
    """
    n = len(instance(arm, Arm, "arm").links)
    values, goal = floats(q, "q", n, finite=False), floats(near, "near", n, finite=False)
    broadcast("q and near", values.shape, goal.shape)
    return _unwrapped(arm, values, goal)


def nearest(arm: Arm, rows: ArrayLike, q: ArrayLike) -> Floats:
    """The row with the least travel from q: rows (..., rows, n), q (..., n) -> (..., n).

    Travel is the sum of the absolute joint changes (in rad, or in m for prismatic joints). Of the
    values that differ by whole turns, each revolute joint takes the one nearest to q that is inside
    its limits or, if none is inside, the one nearest to q. The result is NaN where no row exists.
    Raises ValueError if the shapes do not match or there are no rows.

    >>> from robokin import SCARA, ScaraPose, deg, nearest
    >>> rows = SCARA.ik(ScaraPose((0.3, 0.1, 0.2), 0))
    >>> bool((nearest(SCARA, rows, [0, 90 * deg, 0, 0]) == rows[SCARA.branch(+1)]).all())
    True
    """
    options, here = _rows(arm, rows), floats(q, "q", len(arm.links))
    broadcast("rows and q", (*options.shape[:-2], options.shape[-1]), here.shape)
    return _least(_inside(arm, options, here[..., None, :]), here)


def follow(arm: Arm, rows: ArrayLike, row: int) -> Floats:
    """One continuous motion through the rows of `ik` along a path: (..., samples, rows, n) -> (...,
    samples, n).

    It starts on `row` (at the first sample where that row exists), with each joint inside its
    limits if possible. Every later sample takes the row nearest to the previous sample, with
    unwrapped angles, which may exceed the limits (see `within`). Where a wrist singularity leaves
    joints 4 and 6 free, they share the rotation equally. Where a shoulder singularity leaves joint
    1 free, it keeps the value from `ik`. Samples without a row are NaN, and the motion continues
    from the last finite sample. Raises ValueError if the arm does not have this row or there are no
    samples.
    """
    options = _rows(arm, rows)
    if options.ndim < 3 or options.shape[-3] == 0:
        wanted = "wanted shape (..., samples, rows, n) with at least one sample"
        raise ValueError(f"rows: {wanted}, got {options.shape}")
    whole(row, "row", 0, options.shape[-2] - 1)
    *batch, samples, count, n = options.shape
    tracks = options.reshape(-1, samples, count, n)  # (motions, samples, rows, n)
    missing = _missing(tracks, row)
    exists: Bools = ~np.all(missing, axis=-1)
    before = _start(arm, tracks[:, :, row])[:, None]
    tracks, cost = np.where(missing[..., None], 0.0, tracks), np.where(missing, np.inf, 0.0)
    choose, turn = _chooser(arm), np.where(arm.prismatic, 0.0, TURN)
    # Find the samples with free joints. Each joint is shifted by a different amount, so that no two
    # shifts cancel.
    free = (choose(tracks, tracks + np.arange(1, n + 1)) != tracks).any(axis=(0, 2, 3))
    complete: Bools = np.all(exists, axis=0)
    motions = np.arange(len(tracks))
    q = np.empty((len(tracks), samples, n))
    # Each sample depends on the previous one, so this loop over time cannot be vectorised.
    for i in range(samples):
        here = tracks[:, i] - turn * np.rint((tracks[:, i] - before) / TURN)
        if free[i]:
            here = choose(here, before)
        travel = abs(here - before).sum(axis=-1) + cost[:, i]
        q[:, i] = best = here[motions, travel.argmin(axis=-1)]
        now = best[:, None]
        before = now if complete[i] else np.where(exists[:, i, None, None], now, before)
    return np.where(exists[..., None], q, np.nan).reshape(*batch, samples, n)


def explain(arm: ClosedFormArm, pose: Any, row: int) -> str:
    """Return a sentence that says whether row `row` of `arm.ik(pose)` is usable and, if not, why.
    `pose` is a single pose.

    For a pose that is out of reach, the sentence says by how much, and whether the lengths may be
    in millimetres. Otherwise it names every joint that exceeds its limit, with the excess, and
    every singularity of the posture. The sentences are in `explanations.SENTENCES`.

    >>> from robokin import SCARA, ScaraPose, explain
    >>> explain(SCARA, ScaraPose((0.46, 0, 0.1), 0), 0)
    'Row 0 (+1) does not exist: the target is 10.0 mm beyond the reach of the arm.'
    """
    rows = instance(arm, ClosedFormArm, "arm").ik(pose)
    if rows.ndim != 2:
        raise ValueError(f"pose: wanted a single pose, got a batch of shape {rows.shape[:-2]}")
    row = whole(row, "row", 0, len(rows) - 1)
    q, signs = rows[row], ", ".join(f"{flag:+d}" for flag in arm.branches[row])
    if np.isnan(q).any():
        gap = arm.geometry.gap(pose, row)
        meant = gap.metres > 10 and not np.isnan(arm.ik(_shrunk(pose))).all()
        hint = SENTENCES["millimetres"] if meant else "."
        return SENTENCES["missing"].format(row=row, flags=signs, reason=gap.words, hint=hint)
    good = _within(arm, q)
    facts = [_excess(arm, q, int(i)) for i in np.flatnonzero(~good)]
    held = arm.geometry.singularities(q).items()
    facts += [SENTENCES[name].format(what=arm.geometry.carried) for name, holds in held if holds]
    kind = "not usable" if not good.all() else "usable but" if facts else "usable"
    return SENTENCES[kind].format(row=row, flags=signs, facts=", and ".join(facts))


def _rows(arm: Arm, rows: ArrayLike) -> Floats:
    n = len(instance(arm, Arm, "arm").links)
    options = floats(rows, "rows", n, finite=False)
    if options.ndim < 2 or options.shape[-2] == 0:
        got = options.shape
        raise ValueError(f"rows: wanted shape (..., rows, {n}) with at least one row, got {got}")
    return options


def _within(arm: Arm, q: Floats) -> Bools:
    """`within` without argument checks. A joint is within its limits if the lowest value q + 2 pi k
    that is not below the lower limit is not above the upper limit (a prismatic joint has only one
    value).
    """
    low, high = arm.limits[:, 0] - SLACK, arm.limits[:, 1] + SLACK
    lowest = q + TURN * np.ceil((low - q) / TURN)
    if arm.prismatic.any():
        lowest = np.where(arm.prismatic, np.where(q < low, np.inf, q), lowest)
    return lowest <= high


def _unwrapped(arm: Arm, q: Floats, near: Floats) -> Floats:
    return np.where(arm.prismatic, q, wrapped(q, near))


def _inside(arm: Arm, q: Floats, near: Floats) -> Floats:
    """Like `unwrapped`, but inside the limits where such a value exists."""
    value = _unwrapped(arm, q, near)
    low, high = arm.limits[:, 0] - SLACK, arm.limits[:, 1] + SLACK
    up = value + TURN * np.maximum(np.ceil((low - value) / TURN), 0)
    inside = up - TURN * np.maximum(np.ceil((up - high) / TURN), 0)
    fits = (inside >= low) & (inside <= high) & ~arm.prismatic
    return np.where(fits, inside, value)


def _least(options: Floats, q: Floats) -> Floats:
    """Return the row of `options` with the least travel from q (..., n); NaN if there is none."""
    travel = abs(options - q[..., None, :]).sum(axis=-1)
    best = np.where(np.isnan(travel), np.inf, travel).argmin(axis=-1)
    return np.take_along_axis(options, best[..., None, None], axis=-2)[..., 0, :]


def _missing(tracks: Floats, row: int) -> Bools:
    """The rows that the motions (motions, samples, rows, n) cannot take, as a mask: rows that are
    NaN, all rows before the first sample where `row` exists, and all rows except `row` at that
    sample.
    """
    missing: Bools = np.any(np.isnan(tracks), axis=-1)
    started = np.cumsum(~missing[..., row, None], axis=1)
    other = np.arange(tracks.shape[-2]) != row
    first: Bools = np.cumsum(started > 0, axis=1) == 1
    missing |= (started == 0) | first & other
    return missing


def _chooser(arm: Arm) -> Callable[[Floats, Floats], Floats]:
    """The function that chooses the values of free joints so that they are close to a given
    posture. For an arm without a closed-form inverse, this function returns the rows unchanged.
    """
    if isinstance(arm, ClosedFormArm):
        return arm.geometry.choose_free_joints
    return lambda rows, _: rows


def _start(arm: Arm, track: Floats) -> Floats:
    """The posture with which the first sample of a motion along one row (..., samples, n) is
    compared.

    A motion may begin at a singularity, for example at the IRB-140's home pose. The free joints
    then take their values from the first sample that determines them.
    """
    choose = _chooser(arm)
    exists = ~np.isnan(track).any(axis=-1)
    # each joint is shifted by a different amount, so that no two shifts cancel
    elsewhere = track + np.arange(track.shape[-1])
    determined = np.isclose(choose(track, elsewhere), track, rtol=0, atol=1e-12).all(axis=-1)
    begin = exists.argmax(axis=-1)
    ahead = np.where(determined.any(axis=-1), determined.argmax(axis=-1), begin)
    first, later = (
        np.take_along_axis(track, i[..., None, None], axis=-2)[..., 0, :] for i in (begin, ahead)
    )
    q = choose(first, later)
    q = np.where(np.isnan(q), 0.0, q)
    return _inside(arm, q, q)


def _shrunk(pose: Any) -> Any:
    """The pose with its lengths interpreted as millimetres."""
    if isinstance(pose, Transform):
        return replace(pose, translation=pose.translation / 1000)
    if isinstance(pose, ScaraPose):
        return replace(pose, position=pose.position / 1000)
    return np.asarray(pose) / 1000


def _excess(arm: Arm, q: Floats, i: int) -> str:
    """Return a phrase that says by how much joint i exceeds its limit, in the joint's unit."""
    (low, high), value = arm.limits[i], representative(arm, q)[i]
    limit, over = (high, value - high) if value > high else (low, low - value)
    unit, size = (" mm", mm) if arm.prismatic[i] else ("°", deg)
    value_words, over_words = f"{value / size:.1f}{unit}", f"{over / size:.1f}{unit}"
    facts = {"value": value_words, "over": over_words, "limit": f"{limit / size:g}{unit}"}
    return SENTENCES["past"].format(joint=i + 1, **facts)
