"""The search for a path past obstacles in a grid of postures: axes, clearances, breadth-first
search and backtracking.

A search proceeds in ticks. At each tick, at most one joint moves, by one step. An array over the
grid contains the smallest number of steps in which each posture can be reached by that tick. At the
end of each axis it has one more element than the grid, so that a step beyond either end leads to a
posture that is never free.
"""

from collections.abc import Sequence
from typing import Any, TypeAlias, cast

import numpy as np

from ..._arrays import ArrayLike, Bools, Floats, Ints
from ..._validate import instance, length
from ...arms.planar import ThreeLeverArm
from ...units import deg
from .arguments import read_obstacles, read_point, read_start
from .collision import WORK, lever_distances, motions_keep

Steps: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.int16]]
Node: TypeAlias = tuple[int, ...]

STEP = 5 * deg  # step of the grid of postures in `way_round`
# Margins added to the clearance for the postures of the grid, in lever lengths, tried in this
# order. One step of the first joint can move the gripper by 0.26 lever lengths, so for a small
# clearance only the last margin prevents steps from jumping over H.
MARGINS = (0.005, 0.03, 0.13)
NEVER = 10_000  # more steps than any path through the grid has
INSIDE = (slice(-1),) * 3  # the grid without the extra elements
# the possible moves in a tick: (joint, number of steps)
MOVES = ((0, 0), (0, -1), (0, 1), (1, -1), (1, 1), (2, -1), (2, 1))


def way_round(
    arm: ThreeLeverArm, q0: ArrayLike, target: ArrayLike, H: ArrayLike, distance: float
) -> Floats | None:
    """A path (k, 3) from posture q0 to the target with little movement, on which all levers stay at
    least `distance` away from H, one obstacle (2,) or several (m, 2). It is None if no path is
    found.

    The postures (gamma, beta, alpha) fill a cube with sides of 180 degrees, in which the postures
    at the target form a curve, its `family`. From q0, a breadth-first search spreads through the
    grid of postures that keep the distance, one step of one joint at a time, so that it reaches
    each posture with the least S. We backtrack from the posture on the curve with the least S and
    then remove unnecessary corners. `keeps` checks every part of the path. The grid step is 5
    degrees, so a narrower passage may be missed. Raises ValueError if q0 is outside the limits.
    """
    instance(arm, ThreeLeverArm, "arm")
    q0, K1, H = read_start(arm, q0, "q0"), read_point(target, "target"), read_obstacles(H, "H")
    distance = length(distance, "distance")
    goals = target_curve(arm, K1)
    goals = goals[(lever_distances(arm, goals, H) >= distance).all(axis=(0, 2))]
    if not len(goals):
        return None
    size = len(H) * np.prod(np.ptp(arm.limits, axis=1) / STEP)
    if size > WORK:
        raise ValueError(
            f"arm: wanted limits for which grid postures times obstacles are at most {WORK}, got "
            f"{size:.6g} with {len(H)} obstacles"
        )
    axes, start = grid_axes(arm, q0)
    room = grid_room(arm, axes, H[:, 0])
    for margin in MARGINS:
        steps = breadth_first(room >= distance + margin * arm.lever, start)
        path = _first_path(arm, axes, room, steps, goals, H, distance)
        if path is not None:
            return _shortened(arm, path, goals, H, distance)
    return None


# --- The grid -------------------------------------------------------------------------------------


def target_curve(arm: ThreeLeverArm, K1: Floats, count: int | None = None) -> Floats:
    """Postures (count, 3) with the gripper at K1 (2,), by default about a degree of alpha apart;
    (0, 3) if K1 is out of reach.
    """
    low, high = arm.alpha_range(K1)
    if np.isnan(low):
        return np.empty((0, 3))
    return arm.family(K1, np.linspace(low, high, count or int((high - low) / (1 * deg)) + 2))


def grid_axes(arm: ThreeLeverArm, q: Floats) -> tuple[list[Floats], Node]:
    """The angles of the grid for each joint: equal steps from its angle in the posture q (3,)
    towards both limits, and the limits themselves. Also return the grid node of q.
    """
    axes = []
    for value, (low, high) in zip(q, arm.limits, strict=True):
        down, up = np.arange(value, low, -STEP), np.arange(value, high, STEP)
        every = np.concatenate([[low, high], down, up])
        axes.append(np.unique(every.clip(min(low, value), max(high, value))))
    node = tuple(int(np.abs(axis - value).argmin()) for axis, value in zip(axes, q, strict=True))
    return axes, node


def grid_room(arm: ThreeLeverArm, axes: list[Floats], H: Floats) -> Floats:
    """The smallest distance of the obstacles H (m, 2) from the levers in each posture of the grid
    with these axes.

    Lever OB depends on gamma only, BA on two of the angles, AK on all three: each is measured on
    the smallest possible grid, with complex numbers.
    """
    gamma, beta, alpha = (np.exp(1j * axis) for axis in axes)
    OB = gamma[:, None, None]
    BA = -OB * beta[:, None]
    AK = -BA * alpha
    room: Any = np.inf
    for place in H @ np.array([1, 1j]):
        for lever, long in zip((OB, BA, AK), arm.levers, strict=True):
            seen = place * lever.conj()  # H in a frame with the lever on the real axis
            beyond = seen.real - np.clip(seen.real, 0, long)
            room = np.minimum(room, beyond**2 + seen.imag**2)
            place = place - long * lever
    return cast(Floats, np.sqrt(room))


def grid_postures(axes: list[Floats], nodes: Ints) -> Floats:
    """The postures (n, 3) at nodes (n, 3)."""
    return np.stack([axis[i] for axis, i in zip(axes, nodes.T, strict=True)], axis=-1)


# --- The search -----------------------------------------------------------------------------------


def blocked(allowed: Bools, size: Sequence[int]) -> Steps:
    """An array for a grid of this size: 0 in allowed postures, `NEVER` elsewhere and beyond the
    ends. The array `allowed` may be smaller than the grid.
    """
    closed = np.full(np.add(size, 1), NEVER, dtype=np.int16)
    closed[tuple(map(slice, allowed.shape))][allowed] = 0
    return closed


def at_start(size: Sequence[int], start: Node) -> Steps:
    """The smallest number of steps to each posture before the first tick."""
    steps = np.full(np.add(size, 1), NEVER, dtype=np.int16)
    steps[start] = 0
    return steps


def spread(steps: Steps, closed: Steps, closed_moves: Sequence[Steps] | None = None) -> Steps:
    """The smallest number of steps to each posture one tick later, when at most one joint has moved
    by one step.

    closed        the array from `blocked` for that tick
    closed_moves  for each joint, an array of the postures from which the step to the next one is
                  `blocked` (in both directions); if omitted, no step is blocked
    """
    flat = steps.reshape(-1)
    later, more = flat.copy(), flat + np.int16(1)
    for joint, stride in enumerate(np.array(steps.strides) // steps.itemsize):
        up, down = more[:-stride], more[stride:]
        if closed_moves is not None:
            closed_move = closed_moves[joint].reshape(-1)[:-stride]
            up, down = np.maximum(up, closed_move), np.maximum(down, closed_move)
        np.minimum(later[stride:], up, out=later[stride:])
        np.minimum(later[:-stride], down, out=later[:-stride])
    return np.maximum(later, closed.reshape(-1)).reshape(steps.shape)


def breadth_first(
    free: Bools,
    start: Node,
    free_moves: Sequence[Bools] | None = None,
    goals: Bools | None = None,
) -> Steps:
    """The smallest number of steps from the start to each free posture of the grid, or `NEVER`
    where there is no path. If goals are given, the search ends when it reaches one of them.

    free_moves  for each joint, whether its step from each posture to the next one is free
    """
    size = free.shape
    closed, steps = blocked(free, size), at_start(size, start)
    closed[start] = 0
    closed_moves = None if free_moves is None else [blocked(free, size) for free in free_moves]
    while goals is None or steps[INSIDE][goals].min(initial=NEVER) == NEVER:
        later = spread(steps, closed, closed_moves)
        if np.array_equal(later, steps):
            break
        steps = later
    return steps


def way_back(steps: Sequence[Steps], node: Node, room: Floats | None = None) -> Ints:
    """The nodes (ticks, 3) of a path with the smallest number of steps to the node at the last
    tick. If there are several, the one with more clearance at each tick is preferred.

    steps  an array for each tick. If the obstacle does not move, the last array can be used for
           every tick, since a posture that takes more steps than there have been ticks counts as
           not yet reached.
    """
    back = [node]
    for tick in range(len(steps) - 2, -1, -1):
        before = []
        for joint, step in MOVES:
            other = (*node[:joint], node[joint] + step, *node[joint + 1 :])
            if tick >= steps[tick][other] == steps[tick + 1][node] - abs(step):
                before.append(other)
        node = before[0] if room is None else max(before, key=lambda other: room[other])
        back.append(node)
    return np.array(back[::-1])


def arrivals(axes: list[Floats], goals: Floats, steps: Steps) -> tuple[Ints, Ints]:
    """Nodes (m, 3) that the search reached, and the index (m,) of a goal in a cell adjacent to
    each, in order of increasing S.
    """
    below = np.stack(
        [
            np.clip(np.searchsorted(axis, goals[:, i]) - 1, 0, len(axis) - 2)
            for i, axis in enumerate(axes)
        ]
    )
    corners = np.stack(np.meshgrid(*[(0, 1)] * 3, indexing="ij")).reshape(3, -1)
    nodes = (below[:, :, None] + corners[:, None]).reshape(3, -1)
    number = np.repeat(np.arange(len(goals)), 8)
    rest = sum(abs(axis[nodes[i]] - goals[number, i]) for i, axis in enumerate(axes))
    fewest = steps[tuple(nodes)]
    S = np.where(fewest < NEVER, fewest * STEP + rest, np.inf)
    order = S.argsort(kind="stable")[: np.isfinite(S).sum()]
    return nodes[:, order].T, number[order]


def shortcuts(arm: ThreeLeverArm, path: Floats, H: Floats, distance: float) -> list[int] | None:
    """Go from each posture straight to the farthest one that can be reached directly. Return the
    indices of the remaining postures, or None if not even the next one can be reached. H may also
    be (m, k, 2), the positions of moving obstacles at each posture.
    """
    kept = [0]
    while kept[-1] < len(path) - 1:
        here = kept[-1]
        obstacles = H
        if H.shape[1] > 1:
            obstacles = np.stack(np.broadcast_arrays(H[:, here, None], H[:, here + 1 :]))
        good = np.flatnonzero(motions_keep(arm, path[here], path[here + 1 :], obstacles, distance))
        if not len(good):
            return None
        kept.append(here + 1 + int(good[-1]))
    return kept


# --- The search in coarse steps -------------------------------------------------------------------


def coarse_search(
    arm: ThreeLeverArm, q0: Floats, K1: Floats, H: Floats, distance: float, step: float
) -> tuple[Steps, Bools, Floats]:
    """Search for a path from q0 to K1, past the obstacle H (2,), in a grid over the full range of
    all joints. Every step is proven to keep the distance, as in lab 10, "More".

    Returns (steps, free, curve). `steps` (n, n, n) is the smallest number of steps to each posture,
    or `NEVER` where there is no path or the search ended earlier, on the target's curve. `free` (n,
    n, n) is True for the postures that keep the distance. `curve` (31, 3) is the target's curve; it
    is (0, 3) if the target is out of reach.
    """
    axes = [np.arange(low, high + step / 2, step) for low, high in arm.limits]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    room = lever_distances(arm, grid, H).min(axis=-1)
    free, curve = room >= distance, target_curve(arm, K1, 31)
    goals = np.zeros_like(free)
    goals[tuple(np.round((curve - arm.limits[:, 0]) / step).astype(int).T)] = True
    away = np.where(free, abs(grid - q0).max(axis=-1), np.inf)
    start = tuple(int(i) for i in np.unravel_index(away.argmin(), away.shape))
    if away[start] > step:
        return np.full(free.shape, NEVER, dtype=np.int16), free, curve
    moves = _proven_moves(arm, grid, room, H, distance, step)
    return breadth_first(free, start, moves, goals)[INSIDE], free, curve


def _proven_moves(
    arm: ThreeLeverArm, grid: Floats, room: Floats, H: Floats, distance: float, step: float
) -> list[Bools]:
    """Return, for each joint, whether its step from each posture to the next one keeps the
    distance.
    """
    # length of the arm beyond a joint: no point moves farther than this times the rotation
    carried = np.cumsum(arm.levers[::-1])[::-1]
    proven, asked = [], []
    for joint in range(3):
        (here, there), (q0, q1) = (
            (x[:-1], x[1:]) for x in (np.moveaxis(each, joint, 0) for each in (room, grid))
        )
        # the bound of lab 10, section 3
        proven.append((here + there - carried[joint] * step) / 2 >= distance)
        open_ = ~proven[joint] & (here >= distance) & (there >= distance)
        asked.append((open_, q0[open_], q1[open_]))
    q0, q1 = (np.concatenate([each[k] for each in asked]) for k in (1, 2))
    kept = np.split(
        motions_keep(arm, q0, q1, H[None, None], distance),
        np.cumsum([len(each[1]) for each in asked[:2]]),
    )
    for good, (open_, *_), answer in zip(proven, asked, kept, strict=True):
        good[open_] = answer
    return [np.moveaxis(good, 0, joint) for joint, good in enumerate(proven)]


# --- Private helpers ------------------------------------------------------------------------------


def _first_path(
    arm: ThreeLeverArm,
    axes: list[Floats],
    room: Floats,
    steps: Steps,
    goals: Floats,
    H: Floats,
    distance: float,
) -> Floats | None:
    """The path to the first goal that can be reached with every part of the path far enough from
    the obstacles, without unnecessary corners.
    """
    nodes, numbers = (column[:400] for column in arrivals(axes, goals, steps))
    good = motions_keep(arm, grid_postures(axes, nodes), goals[numbers], H, distance)
    for node, number in list(zip(nodes[good], numbers[good], strict=True))[:5]:
        node = tuple(node.tolist())
        back = way_back([steps] * (int(steps[node]) + 1), node, room)
        path = np.concatenate([grid_postures(axes, back), goals[[number]]])
        kept = shortcuts(arm, path, H, distance)
        if kept is not None:
            return path[kept]
    return None


def _shortened(
    arm: ThreeLeverArm, path: Floats, goals: Floats, H: Floats, distance: float
) -> Floats:
    """Shorten the path: pull each via posture between its neighbours as far as the distance
    permits, and move the goal along its curve to the place nearest to the last via posture.
    """
    shares = np.linspace(1, 0, 33)[:, None]
    for _ in range(4):
        before = path.copy()
        for i in range(1, len(path) - 1):
            a, via, b = path[i - 1], path[i], path[i + 1]
            pulled = via + shares * (np.clip(via, np.minimum(a, b), np.maximum(a, b)) - via)
            starts = np.concatenate([np.broadcast_to(a, pulled.shape), pulled])
            ends = np.concatenate([pulled, np.broadcast_to(b, pulled.shape)])
            to, on = motions_keep(arm, starts, ends, H, distance).reshape(2, -1)
            path[i] = pulled[(to & on).argmax()] if (to & on).any() else via
        S = abs(goals - path[-2]).sum(axis=-1)
        near = goals[S < abs(path[-1] - path[-2]).sum()]
        near = near[abs(near - path[-2]).sum(axis=-1).argsort()]
        good = motions_keep(arm, path[-2], near, H, distance)
        if good.any():
            path[-1] = near[good.argmax()]
        # not None, since all parts keep the distance
        path = path[cast(list[int], shortcuts(arm, path, H, distance))]
        if np.array_equal(path, before):
            break
    return path
