"""The three-lever arm past an obstacle that moves along a line while the arm does.

What `plan` of `robokin.jobs.obstacles` promises of a place holds here of a place and a time: the
obstacle is at H + v t, the arm in its posture at t, and between two postures all joints turn
evenly. The bound that proves a distance grows by what the obstacle moves meanwhile.
"""

from typing import cast

import numpy as np

from .._arrays import ArrayLike, Bools, Floats, Ints
from .._validate import instance, length, positive
from ..arms.planar import ThreeLeverArm
from ..units import deg, in_words
from .obstacles import (
    FARTHEST,
    LEVERS,
    MARGINS,
    STEP,
    Plan,
    _arrivals,
    _axis,
    _clearances,
    _cut,
    _distances,
    _keeps,
    _none,
    _on,
    _point,
    _room,
    _start,
)

TICKS = 120  # of STEP each: how far ahead is looked
NEVER = 10_000  # steps: more than any way through the grid has


def plan_moving(
    arm: ThreeLeverArm,
    posture: ArrayLike,
    target: ArrayLike,
    obstacle: ArrayLike,
    velocity: ArrayLike,
    speed: float,
    distance: float | None = None,
) -> tuple[Plan, Floats]:
    """From the posture (3,) to the target, past an obstacle that is at `obstacle` (2,) now and
    moves with the constant `velocity` (2,) in metres per second.

    Returns (plan, times): the plan's path (k, 3), and when the arm is in each of its postures (k,),
    in seconds from now. Tried in this order, by rising movement: "direct"; "wait" in the start
    posture, no longer than needed, and then directly; "search". All levers keep `distance` (metres;
    L/7 unless given) from the obstacle until the arm arrives; what comes then is another task.
    `speed`, in radians per second, is what the joints turn together at most, so that a way takes
    S / speed at least.

    The search is that of `way_round` with the time beside the posture: what can be reached grows by
    one step of one joint a tick, and shrinks to what is free at that tick. It looks `TICKS` ticks
    ahead, of 5 degrees / speed each. ValueError: a posture outside the limits.
    """
    instance(arm, ThreeLeverArm, "arm")
    start, K1 = _start(arm, posture, "posture"), _point(target, "target")
    H, v = _point(obstacle, "obstacle"), _point(velocity, "velocity")
    speed = positive(speed, "speed", "one positive speed in radians per second")
    distance = arm.lever / 7 if distance is None else length(distance, "distance")
    ahead = TICKS * STEP / speed
    if ahead * max(1, np.hypot(*v)) > FARTHEST:
        raise ValueError(
            f"speed: wanted one with which {TICKS} ticks of {STEP / deg:.0f} degrees, and what the "
            f"obstacle goes meanwhile, stay below {FARTHEST:g} s and m, got {speed!r}"
        )
    ticks = np.linspace(0, ahead, TICKS + 1)
    unreached, now = arm.out_of_reach(K1), np.zeros(1)
    if unreached:
        return _none(start, f"The target is out of reach: {unreached}."), now
    goal, S = arm.least(K1, start)
    near = _distances(arm, start, H)
    if near.min() < distance:
        words = f"At the start lever {LEVERS[near.argmin()]} is already {in_words(near.min())} "
        return _none(start, f"{words}from the obstacle.", float(S)), now
    waiting = _waiting(arm, start, goal, S / speed, ticks, H, v, distance)
    searched = _search(arm, start, K1, ticks, speed, H, v, distance) if waiting is None else None
    if waiting is not None:
        path, times = waiting
        way, words = "wait", f"The arm waits for {times[1]:.2f} s and goes directly then."
        if times[1] == 0:
            path, times = path[1:], times[1:]
            way, words = "direct", "The way is direct: the obstacle is not in it at that time."
    elif searched is not None:
        path, times = searched
        way, words = "search", f"Waiting does not do; a search finds a way of {times[-1]:.2f} s."
    else:
        words = f"Within {ticks[-1]:.2f} s neither waiting nor a search keeps"
        return _none(start, f"{words} {in_words(distance)}.", float(S)), now
    clear = _clearances(arm, path[:-1], path[1:], _places(H, v, times[:-1], times[1:]))
    return Plan(way, words, path, clear, float(S)), times


# --- Private helpers ------------------------------------------------------------------------------


def _places(H: Floats, v: Floats, begin: Floats, end: Floats) -> Floats:
    """The obstacle at the begin (n,) and the end (n,) of motions: (2, 1, n, 2)."""
    return (H + np.stack([begin, end])[..., None] * v)[:, None]


def _waiting(
    arm: ThreeLeverArm,
    start: Floats,
    goal: Floats,
    takes: Floats,
    ticks: Floats,
    H: Floats,
    v: Floats,
    distance: float,
) -> tuple[Floats, Floats] | None:
    """Path and times of the direct motion after the fewest ticks of waiting; None if it is never
    free.
    """
    still = _keeps(
        arm, np.tile(start, (TICKS, 1)), start, _places(H, v, ticks[:-1], ticks[1:]), distance
    )
    here = np.concatenate([[True], np.logical_and.accumulate(still)])
    moves = _keeps(
        arm, np.tile(start, (TICKS + 1, 1)), goal, _places(H, v, ticks, ticks + takes), distance
    )
    if not (here & moves).any():
        return None
    begin = ticks[(here & moves).argmax()]
    return np.stack([start, start, goal]), np.array([0, begin, begin + takes])


def _search(
    arm: ThreeLeverArm,
    q0: Floats,
    K1: Floats,
    ticks: Floats,
    speed: float,
    H: Floats,
    v: Floats,
    distance: float,
) -> tuple[Floats, Floats] | None:
    low, high = arm.alpha_range(K1)
    goals = arm.family(K1, np.linspace(low, high, int((high - low) / (1 * deg)) + 2))
    axes = [_axis(value, *limits) for value, limits in zip(q0, arm.limits, strict=True)]
    start = tuple(int(np.abs(axis - value).argmin()) for axis, value in zip(axes, q0, strict=True))
    size = [len(axis) for axis in axes]
    for margin in MARGINS:
        waves = [cast(Ints, np.full(size, NEVER, dtype=np.int16))]  # all ticks' are kept: 2 bytes
        waves[0][start] = 0
        for tick in range(1, len(ticks)):
            room = _room(arm, axes, (H + ticks[tick] * v)[None])
            waves.append(_grown(waves[-1], room >= distance + margin * arm.lever))
            if waves[-1].min() == NEVER:
                break
            reached = np.where(waves[-1] < NEVER, waves[-1], -1)
            nodes, numbers = (column[:60] for column in _arrivals(axes, goals, reached))
            arrive = ticks[tick] + abs(_on(axes, nodes) - goals[numbers]).sum(axis=-1) / speed
            places = _places(H, v, np.full(len(nodes), ticks[tick]), arrive)
            good = _keeps(arm, _on(axes, nodes), goals[numbers], places, distance)
            for i in np.flatnonzero(good)[:3]:
                back = _on(axes, _back(waves, tuple(nodes[i].tolist())))
                path = np.concatenate([back, goals[numbers[i], None]])
                times = np.append(ticks[: tick + 1], arrive[i])
                kept = _cut(arm, path, (H + times[:, None] * v)[None], distance)
                if kept is not None:
                    return path[kept], times[kept]
    return None


def _grown(steps: Ints, free: Bools) -> Ints:
    """The fewest steps to every posture a tick later: one joint has gone one step, or none has."""
    grown = steps.copy()
    for axis in range(3):
        new, old = np.moveaxis(grown, axis, 0), np.moveaxis(steps, axis, 0)
        np.minimum(new[1:], old[:-1] + 1, out=new[1:])
        np.minimum(new[:-1], old[1:] + 1, out=new[:-1])
    grown[~free] = NEVER
    return grown


def _back(waves: list[Ints], node: tuple[int, ...]) -> Ints:
    """The nodes (ticks, 3) of a way to the node at the last tick; of ways with as few steps any."""
    back = [node]
    for tick in range(len(waves) - 2, -1, -1):
        steps = waves[tick]
        for axis, step in ((0, 0), (0, -1), (0, 1), (1, -1), (1, 1), (2, -1), (2, 1)):
            k = node[axis] + step
            other = (*node[:axis], k, *node[axis + 1 :])
            if 0 <= k < steps.shape[axis] and steps[other] == waves[tick + 1][node] - abs(step):
                node = other
                break
        back.append(node)
    return np.array(back[::-1])
