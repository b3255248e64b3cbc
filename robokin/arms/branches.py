"""Choosing among the solutions of the inverse kinematics: `within`, `nearest`, `follow`,
`explain`.
"""

from dataclasses import replace

import numpy as np

from .._validate import broadcast, floats, instance
from ..transform import Transform
from ..units import deg, mm
from .arm import Arm

TURN = 2 * np.pi
SLACK = 1e-9  # a joint this little past its limit stands at it
SINGULAR = {
    "shoulder": "the wrist centre is in line with axis 1 (shoulder singularity), where the front "
    "and back rows meet",
    "elbow": "the arm is stretched or folded (elbow singularity), where the two elbow rows are one",
    "wrist": "axes 4 and 6 are in one line (wrist singularity), so that only their joints' "
    "common turn is fixed",
}


def within(arm, q):
    """Which joints can stand at q (..., n) inside their limits: bool (..., n).

    A revolute joint counts if some q + 2 pi k lies inside. NaN is outside.
    """
    low = _lowest(arm, floats(q, "q", len(instance(arm, Arm, "arm").links), finite=False))
    return low <= arm.limits[:, 1] + SLACK


def nearest(arm, rows, q):
    """The row with the least travel from q: rows (..., rows, n) and q (..., n) -> (..., n).

    Travel is the sum of all joint changes (rad; m for a prismatic joint). A joint takes the one of
    its values q + 2 pi k that is nearest to q and inside the limits or, if none is inside, nearest
    to q. NaN where no row exists. ValueError: shapes that do not fit.
    """
    rows, q = _rows(arm, rows), floats(q, "q", len(arm.links))
    broadcast("rows and q", (*rows.shape[:-2], rows.shape[-1]), q.shape)
    options = _inside(arm, rows, q[..., None, :])
    return _least(options, q)


def follow(arm, rows, row):
    """One continuous motion through the rows of `ik` along a path: (..., samples, rows, n) -> (...,
    samples, n).

    It starts on `row` (at the first sample where that row exists), with each joint inside its
    limits if it can; after that every sample takes the row nearest to the one before, with angles
    unwrapped (they may pass the limits: `within` tells). Where a wrist singularity leaves joints 4
    and 6 free they share the turn; for joint 1 free in a shoulder singularity nothing is chosen, it
    is where `ik` puts it. NaN where no row exists, then on from the last finite sample. ValueError:
    a row that the arm does not have, no samples.
    """
    rows = _rows(arm, rows)
    if rows.ndim < 3 or rows.shape[-3] == 0:
        raise ValueError(
            f"rows: wanted shape (..., samples, rows, n) with samples, got {rows.shape}"
        )
    count = rows.shape[-2]
    if not (isinstance(row, (int, np.integer)) and 0 <= row < count):
        raise ValueError(f"row: wanted a whole number from 0 to {count - 1}, got {row!r}")
    q = np.full((*rows.shape[:-2], rows.shape[-1]), np.nan)
    before = _start(arm, rows[..., row, :])
    started = np.zeros(q.shape[:-2], dtype=bool)
    # Each sample depends on the one before: the one loop over time that cannot be an array
    # operation.
    for i in range(q.shape[-2]):
        options = rows[..., i, :, :]
        options = np.where(started[..., None, None], options, options[..., row : row + 1, :])
        options = arm.geometry.settle(
            _unwrapped(arm, options, before[..., None, :]), before[..., None, :]
        )
        q[..., i, :] = _least(options, before)
        exists = ~np.isnan(q[..., i, :1])
        started |= exists[..., 0]
        before = np.where(exists, q[..., i, :], before)
    return q


def explain(arm, pose, row):
    """In one sentence whether row `row` of `arm.ik(pose)` is usable, and if not why. One single
    pose.

    Out of reach: by how much, and whether metres were meant to be millimetres. Else every joint
    past its limit, with the excess, and every singularity that holds.
    """
    rows = instance(arm, Arm, "arm").ik(pose)
    if rows.ndim != 2:
        raise ValueError(f"pose: wanted one single pose, got a batch of shape {rows.shape[:-2]}")
    if not (isinstance(row, (int, np.integer)) and 0 <= row < len(rows)):
        raise ValueError(f"row: wanted a whole number from 0 to {len(rows) - 1}, got {row!r}")
    what, q = f"Row {row} ({', '.join(f'{flag:+d}' for flag in arm.branches[row])})", rows[row]
    if np.isnan(q).any():
        reason, gap = arm.geometry.unreached(pose, row)
        meant = gap > 10 and not np.isnan(arm.ik(_shrunk(pose))).all()
        hint = "; lengths are in metres, were millimetres meant (350 * mm)?" if meant else "."
        return f"{what} does not exist: {reason}{hint}"
    facts = [_excess(arm, q, i) for i in np.flatnonzero(~within(arm, q))]
    facts += [SINGULAR[name] for name, holds in arm.geometry.singular(q).items() if holds]
    if not facts:
        return f"{what} is usable: it is inside every limit and not singular."
    return (
        f"{what} {'is usable, but' if within(arm, q).all() else 'is not usable:'} "
        f"{', and '.join(facts)}."
    )


def _rows(arm, rows):
    instance(arm, Arm, "arm")
    rows = floats(rows, "rows", len(arm.links), finite=False)
    if rows.ndim < 2:
        raise ValueError(f"rows: wanted shape (..., rows, {len(arm.links)}), got {rows.shape}")
    return rows


def _lowest(arm, q):
    """Each joint's lowest value q + 2 pi k that is not below its lower limit (a prismatic joint has
    but one).
    """
    low = arm.limits[:, 0] - SLACK
    turned = q + TURN * np.ceil((low - q) / TURN)
    return np.where(arm.prismatic, np.where(q < low, np.inf, q), turned)


def _unwrapped(arm, q, near):
    """Each revolute joint's value q + 2 pi k nearest to `near`."""
    return np.where(arm.prismatic, q, q - TURN * np.round((q - near) / TURN))


def _inside(arm, q, near):
    """As `_unwrapped`, but inside the limits where there is such a value."""
    value = _unwrapped(arm, q, near)
    low, high = arm.limits[:, 0] - SLACK, arm.limits[:, 1] + SLACK
    up = value + TURN * np.maximum(np.ceil((low - value) / TURN), 0)
    inside = up - TURN * np.maximum(np.ceil((up - high) / TURN), 0)
    fits = (inside >= low) & (inside <= high) & ~arm.prismatic
    return np.where(fits, inside, value)


def _least(options, q):
    """The option (..., rows, n) with the least travel from q (..., n); NaN where there is none."""
    travel = abs(options - q[..., None, :]).sum(axis=-1)
    best = np.where(np.isnan(travel), np.inf, travel).argmin(axis=-1)
    return np.take_along_axis(options, best[..., None, None], axis=-2)[..., 0, :]


def _start(arm, track):
    """Where a motion along one row (..., samples, n) begins, for its first sample to be measured
    against.

    A motion may begin in a singularity, as from the IRB-140's home pose: the free joints then look
    ahead to the first sample that fixes them.
    """
    exists = ~np.isnan(track).any(axis=-1)
    # each joint by another amount, so that no two shifts cancel
    elsewhere = track + np.arange(track.shape[-1])
    fixed = np.isclose(arm.geometry.settle(track, elsewhere), track, rtol=0, atol=1e-12).all(
        axis=-1
    )
    begin = exists.argmax(axis=-1)
    ahead = np.where(fixed.any(axis=-1), fixed.argmax(axis=-1), begin)
    begin, ahead = (
        np.take_along_axis(track, i[..., None, None], axis=-2)[..., 0, :] for i in (begin, ahead)
    )
    q = arm.geometry.settle(begin, ahead)
    q = np.where(np.isnan(q), 0.0, q)
    return _inside(arm, q, q)


def _shrunk(pose):
    """The pose as if its lengths had been millimetres."""
    part = "translation" if isinstance(pose, Transform) else "position"
    if not hasattr(pose, part):  # a point
        return np.asarray(pose) / 1000
    return replace(pose, **{part: getattr(pose, part) / 1000})


def _excess(arm, q, i):
    """How joint i stands past its limit, said in the unit of the joint."""
    low, high = arm.limits[i]
    value = q[i]
    if not arm.prismatic[i]:
        value = value + TURN * np.arange(-2, 3)
    over = np.where(value > high, value - high, low - value)
    best = np.argmin(over)
    value, over = np.ravel(value)[best], np.ravel(over)[best]
    unit, size = (" mm", mm) if arm.prismatic[i] else ("°", deg)
    limit = high if value > high else low
    value, over, limit = (
        f"{value / size:.1f}{unit}",
        f"{over / size:.1f}{unit}",
        f"{limit / size:g}{unit}",
    )
    return f"joint {i + 1} stands at {value}, {over} past its limit of {limit}"
