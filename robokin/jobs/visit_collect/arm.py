"""The arm of source 000: its workspace, the time of a move, and the lowest point of the tool."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..._arrays import ArrayLike, Bools, Floats, by_blocks, components
from ..._validate import TWO_TURNS, broadcast, floats, length, short, warn_if_degrees
from ...arms import spbu_arm, within
from ...arms.geometry import FREE, ROUNDING

SHORTEST, LONGEST = 1e-6, 1e6  # m; a link outside this range is probably in the wrong unit
UNDER = 1e-9  # fraction of the reach: a tool below the floor by no more than this counts as on it


def workspace(l1: float, l2: float, points: ArrayLike) -> Bools:
    """Return whether each of the document's four conditions holds: points (..., 3) in metres ->
    bool (..., 4).

    The conditions are, in this order: the point is not beyond the reach of the fully extended arm;
    it is not below the floor; it is not nearer to the origin than l1 - l2 (if l1 > l2); the elbow
    is not below the floor (if l1 < l2). A point that is beyond a boundary only because of rounding
    (1e-12 of the reach) counts as on it (errata S0-l). A point is in the workspace if all four
    conditions hold; then the principal branch exists and is within the limits. Source: 000,
    "Определение границ рабочей области"; its condition cos q2 >= 0 follows from these (errata S0-c,
    S0-s).
    """
    l1, l2 = _links(l1, l2)
    x, y, z = components(floats(points, "points", 3))
    slack = ROUNDING * (l1 + l2)
    with np.errstate(over="ignore"):  # a point 1e308 m away must not cause a warning
        rho = np.hypot(x, y)
        d = np.hypot(rho, z)
        # The lowest elbow allowed is on the floor, l1 behind the axis: (rho + l1)^2 + z^2 >= l2^2,
        # which is the document's last inequality with its terms reordered.
        from_elbow = np.hypot(rho + l1, z)
    inner_sphere = (d >= l1 - l2 - slack) | (l1 <= l2)
    inner_surface = (from_elbow >= l2 - slack) | (l1 >= l2)
    return np.stack([d <= l1 + l2 + slack, z >= -slack, inner_sphere, inner_surface], axis=-1)


def out_of_workspace(l1: float, l2: float, point: ArrayLike) -> list[str]:
    """The reasons why a point (3,) is outside the workspace: a list of strings, empty if inside."""
    l1, l2 = _links(l1, l2)
    p = floats(point, "point", 3)
    if p.ndim != 1:
        raise ValueError(f"point: wanted a single point (3,), got {p.shape}")
    holds = workspace(l1, l2, p)
    return [
        reason for reason, fine in zip(reasons_outside(l1, l2, p), holds, strict=True) if not fine
    ]


def principal_postures(l1: float, l2: float, points: ArrayLike) -> Floats:
    """The principal branch for points (..., 3) -> q (..., 3) in rad. A free joint is NaN; a point
    out of reach gives a NaN row.

    On axis 1, joint 1 is free (errata S0-p). Where equal links are folded onto the origin, joint 2
    is free as well (S0-k).
    """
    l1, l2 = _links(l1, l2)
    # -0.0 becomes 0, since atan2 distinguishes the two although they are the same coordinate
    p = floats(points, "points", 3) + 0.0
    near = FREE * (l1 + l2)
    # as in `workspace`, distant points must not cause a warning
    with np.errstate(over="ignore", invalid="ignore"):
        q = np.array(spbu_arm(l1, l2).ik(p)[..., 0, :])
        rho = np.hypot(p[..., 0], p[..., 1])
        q[rho <= near, 0] = np.nan
        q[np.hypot(rho, p[..., 2]) <= near, 1] = np.nan
    return q


def misfit(l1: float, l2: float, q: ArrayLike, points: ArrayLike) -> Floats:
    """The distance in m of the tool at q (..., 3) from the points (..., 3) where it should be:
    (...). It is infinite if a joint exceeds its limit, and NaN if the posture does not exist.

    The printed program's seven checks are meant to test this, but they lack the absolute value, and
    none of them tests joint 1 (errata S0-e).
    """
    arm = spbu_arm(*_links(l1, l2))
    posture, p = floats(q, "q", 3, finite=False), floats(points, "points", 3)
    broadcast("q and points", posture.shape, p.shape)
    posture = with_free_joints(posture, 0.0)  # a free joint may have any value, including 0
    with np.errstate(over="ignore"):
        gap = np.linalg.norm(arm.fk(posture).translation - p, axis=-1)
    return np.where(within(arm, posture).all(axis=-1) | np.isnan(gap), gap, np.inf)


def travel_time(
    q_from: ArrayLike, q_to: ArrayLike, speeds: ArrayLike, *, short_way: bool = False
) -> Floats:
    """The shortest time in s from one posture to another: q_from, q_to (..., 3) and maximum speeds
    (3,) -> (...).

    t is the maximum over the joints of |difference| / speed: the slowest joint decides. A joint
    that is NaN takes no time: in q_to, it is free and keeps its value (errata S0-p); in q_from, its
    value is unknown. To continue from a free joint, insert the value that it kept, as `itinerary`
    does. The result is NaN if every joint is NaN. `short_way` lets joint 1 take the shorter turn,
    as if it had no stop at +-pi (errata S0-o). Source: 000, "Нахождение времени". Raises ValueError
    if a shape is wrong or a speed is not positive.
    """
    start, end = (
        floats(q, name, 3, finite=False) for q, name in ((q_from, "q_from"), (q_to, "q_to"))
    )
    broadcast("q_from and q_to", start.shape, end.shape)
    limits = floats(speeds, "speeds", 3)
    if limits.ndim != 1 or not (limits > 0).all():
        raise ValueError(f"speeds: wanted three positive numbers in rad/s, got {short(speeds)}")
    for q, name in ((start, "q_from"), (end, "q_to")):
        warn_if_degrees(q, name, posture=1)
    return joint_travel_time(start, end, limits, short_way)


def lowest(l1: float, l2: float, q_from: ArrayLike, q_to: ArrayLike) -> Floats:
    """The lowest height of the tool in m on the way from q_from to q_to (..., 3), with every joint
    at constant speed: (...).

    Between two points above the floor it can be negative if l1 > l2 (errata S0-u). The result is a
    proven bound, not the minimum of samples: the tool is nowhere lower than this height minus 1e-9
    of the reach. A joint that is NaN at one end is free and stands still. The result is NaN if a
    posture does not exist. Raises ValueError if a joint value exceeds two turns.
    """
    l1, l2 = _links(l1, l2)
    start, end = (
        floats(q, name, 3, finite=False) for q, name in ((q_from, "q_from"), (q_to, "q_to"))
    )
    broadcast("q_from and q_to", start.shape, end.shape)
    for q, name in ((start, "q_from"), (end, "q_to")):
        if (abs(q) > TWO_TURNS).any():
            got = f"{np.nanmax(abs(q)):.6g} rad"
            raise ValueError(f"{name}: wanted joint values within two turns, got {got}")
    return lowest_place(l1, l2, start, end, np.inf)


# ---- Versions without argument checks


def joint_travel_time(start: Floats, end: Floats, speeds: Floats, short_way: bool) -> Floats:
    """`travel_time` without argument checks."""
    with np.errstate(over="ignore", invalid="ignore"):
        turn = abs(end - start)
        if short_way:
            turn[..., 0] = abs((turn[..., 0] + np.pi) % (2 * np.pi) - np.pi)
        one, two, three = components(turn / speeds)
        longest: Floats = np.fmax(np.fmax(one, two), three)
    return longest


def with_free_joints(q: Floats, here: Floats | float) -> Floats:
    """Return postures q (..., 3) in which each free joint (NaN) has its value from the posture
    `here`. A posture that does not exist also lacks joint 3, and remains NaN.
    """
    return np.where(np.isnan(q) & ~np.isnan(q[..., 2:]), here, q)


def lowest_place(l1: float, l2: float, start: Floats, end: Floats, below: float) -> Floats:
    """`lowest` without argument checks; a result that is not below the height `below` may be too
    large.
    """
    start, end = np.broadcast_arrays(
        with_free_joints(with_free_joints(start, end), 0.0),
        with_free_joints(with_free_joints(end, start), 0.0),
    )
    moves = np.concatenate([start[..., 1:], end[..., 1:]], axis=-1).reshape(-1, 4)
    z = by_blocks(lambda block: [_lowest_of_block(l1, l2, block, below)], moves)
    return z.reshape(start.shape[:-1])


def reasons_outside(l1: float, l2: float, point: Floats) -> tuple[str, ...]:
    """The reasons why a point (3,) may be outside the workspace, one string for each of the four
    conditions.
    """
    x, y, z = point.tolist()
    rho, d = math.hypot(x, y), math.hypot(x, y, z)
    return (
        f"is too far: {d - l1 - l2:.4g} m beyond the reach of the arm, l1 + l2 = {l1 + l2:.9g} m",
        f"is under the floor: z = {z:.9g} m",
        f"is too close to the origin: |p| = {d:.9g} m is less than l1 - l2 = {l1 - l2:.9g} m",
        f"is too close to the origin: |p|^2 = {d * d:.9g} m^2 is less than "
        f"l2^2 - l1^2 - 2 l1 rho = {(l2 - l1) * (l2 + l1) - 2 * l1 * rho:.9g} m^2",
    )


# ---- Private


def _links(l1: Any, l2: Any) -> tuple[float, float]:
    l1, l2 = length(l1, "l1"), length(l2, "l2")
    for name, value in (("l1", l1), ("l2", l2)):
        if not SHORTEST <= value <= LONGEST:
            wanted = f"a length from {SHORTEST:g} to {LONGEST:g} m"
            raise ValueError(f"{name}: wanted {wanted}, got {value:g}")
    return l1, l2


@np.errstate(invalid="ignore")  # postures that do not exist are NaN
def _lowest_of_block(l1: float, l2: float, moves: Sequence[Floats], below: float) -> Floats:
    """`lowest_place` for n moves, given by q2 and q3 at the start and q2 and q3 at the end, (n,)
    each.

    The function bisects the pieces of a move that can still contain a lower point. With a = q2 and
    b = q2 + q3, the height is z = l1 cos a - l2 sin b, and a and b change linearly. A piece that is
    a fraction h of the move is lower than its lower end by at most z'' h^2 / 8, and z'' is bounded
    by its value in the middle and its rate of change.
    """
    a, q3, a_end, q3_end = moves
    b, b_end = a + q3, a_end + q3_end
    da, db = a_end - a, b_end - b
    low, high = l1 * np.cos(a) - l2 * np.sin(b), l1 * np.cos(a_end) - l2 * np.sin(b_end)
    least, change = np.minimum(low, high), l1 * abs(da) ** 3 + l2 * abs(db) ** 3
    move, begin, share = np.arange(len(a)), np.zeros(len(a)), 1.0
    while len(move):
        middle = begin + share / 2
        up = l1 * np.cos(a[move] + middle * da[move])
        down = l2 * np.sin(b[move] + middle * db[move])
        here = up - down
        np.minimum.at(least, move, here)
        bend = down * db[move] ** 2 - up * da[move] ** 2 + change[move] * share / 2
        bound = np.minimum(low, high) - np.maximum(bend, 0) * share**2 / 8
        on = bound < np.minimum(least[move], below) - UNDER * (l1 + l2)
        move, begin = np.tile(move[on], 2), np.concatenate([begin[on], middle[on]])
        low, high = (np.concatenate(ends) for ends in ((low[on], here[on]), (here[on], high[on])))
        share /= 2
    return least
