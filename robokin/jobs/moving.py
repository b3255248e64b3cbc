"""Plans that take the three-lever arm past an obstacle while the obstacle moves along a line.

`plan` in `robokin.jobs.obstacles` keeps a clearance from a fixed obstacle; here, the arm keeps it
from a moving one at all times. At time t the obstacle is at H + v t. Between two postures, all
joints turn at constant speed. The bound that proves a clearance also allows for the distance that
the obstacle moves in the meantime.
"""

from typing import TypeAlias

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import instance, length, positive
from ..arms.planar import ThreeLeverArm
from ..units import deg, in_words
from .obstacles.arguments import FARTHEST, read_point, read_start
from .obstacles.collision import LEVERS, lever_distances, motion_clearances, motions_keep
from .obstacles.planner import Plan, no_plan
from .obstacles.posture_grid import (
    MARGINS,
    NEVER,
    STEP,
    arrivals,
    at_start,
    blocked,
    grid_axes,
    grid_postures,
    grid_room,
    shortcuts,
    spread,
    target_curve,
    way_back,
)

# `way`, `words` and `path` of a plan, and the time of each posture
Found: TypeAlias = tuple[str, str, Floats, Floats]

# number of ticks that the search looks ahead; in each tick, the joints can turn by STEP in total
TICKS = 120


def plan_moving(
    arm: ThreeLeverArm,
    posture: ArrayLike,
    target: ArrayLike,
    obstacle: ArrayLike,
    velocity: ArrayLike,
    speed: float,
    distance: float | None = None,
) -> tuple[Plan, Floats]:
    """Plan from the posture (3,) to the target, past an obstacle that is at `obstacle` (2,) now and
    moves with the constant `velocity` (2,) in metres per second.

    Returns (plan, times): the plan with its path (k, 3), and the time of each posture (k,), in
    seconds from now. The ways are tried in order of increasing movement: "direct"; "wait", that is,
    wait in the start posture, no longer than necessary, and then go directly; "search". All levers
    stay at least `distance` (in metres; L/7 by default) away from the obstacle until the arm
    arrives; later times belong to the next task. `speed`, in radians per second, limits the sum of
    the joint speeds, so that a path takes at least S / speed.

    The search is that of `way_round` with time as an additional dimension: at each tick the
    reachable set grows by one step of one joint and shrinks to the postures that are free at that
    tick. It looks ahead by `TICKS` ticks of 5 degrees / speed. Raises ValueError if the posture is
    outside the limits.
    """
    instance(arm, ThreeLeverArm, "arm")
    start, K1 = read_start(arm, posture, "posture"), read_point(target, "target")
    H, v = read_point(obstacle, "obstacle"), read_point(velocity, "velocity")
    speed = positive(speed, "speed", "one positive speed in radians per second")
    distance = arm.lever / 7 if distance is None else length(distance, "distance")
    ahead = TICKS * STEP / speed
    if ahead * max(1, np.hypot(*v)) > FARTHEST:
        raise ValueError(
            f"speed: wanted a speed at which {TICKS} ticks of {STEP / deg:.0f} degrees take at "
            f"most {FARTHEST:g} s and the obstacle moves at most {FARTHEST:g} m meanwhile, got "
            f"{speed!r}"
        )
    ticks = np.linspace(0, ahead, TICKS + 1)
    unreached, now = arm.out_of_reach(K1), np.zeros(1)
    if unreached:
        return no_plan(start, f"The target is outside the allowed reach: {unreached}."), now
    goal, S = arm.least(K1, start)
    near = lever_distances(arm, start, H)
    if near.min() < distance:
        words = f"At the start lever {LEVERS[near.argmin()]} is already {in_words(near.min())} "
        return no_plan(start, f"{words}from the obstacle.", float(S)), now
    found = _wait(arm, start, goal, S / speed, ticks, H, v, distance)
    found = found or _search(arm, start, K1, ticks, speed, H, v, distance)
    if found is None:
        words = f"Within {ticks[-1]:.2f} s neither waiting nor a search keeps"
        return no_plan(start, f"{words} {in_words(distance)}.", float(S)), now
    way, words, path, times = found
    clear = motion_clearances(arm, path[:-1], path[1:], _positions(H, v, times[:-1], times[1:]))
    return Plan(way, words, path, clear, float(S)), times


# --- Private helpers ------------------------------------------------------------------------------


def _positions(H: Floats, v: Floats, begin: Floats, end: Floats) -> Floats:
    """The obstacle's positions at the beginning (n,) and the end (n,) of motions: (2, 1, n, 2)."""
    return (H + np.stack([begin, end])[..., None] * v)[:, None]


def _wait(
    arm: ThreeLeverArm,
    start: Floats,
    goal: Floats,
    takes: Floats,
    ticks: Floats,
    H: Floats,
    v: Floats,
    distance: float,
) -> Found | None:
    """The direct motion after the shortest wait in ticks; None if no wait makes it safe."""
    still = motions_keep(
        arm, np.tile(start, (TICKS, 1)), start, _positions(H, v, ticks[:-1], ticks[1:]), distance
    )
    here = np.concatenate([[True], np.logical_and.accumulate(still)])
    moves = motions_keep(
        arm, np.tile(start, (TICKS + 1, 1)), goal, _positions(H, v, ticks, ticks + takes), distance
    )
    if not (here & moves).any():
        return None
    begin = ticks[(here & moves).argmax()]
    if begin == 0:
        words = "The direct motion is clear: the obstacle is not in its way at that time."
        return "direct", words, np.stack([start, goal]), np.array([0, takes])
    words = f"The arm waits for {begin:.2f} s and then moves directly."
    return "wait", words, np.stack([start, start, goal]), np.array([0, begin, begin + takes])


def _search(
    arm: ThreeLeverArm,
    q0: Floats,
    K1: Floats,
    ticks: Floats,
    speed: float,
    H: Floats,
    v: Floats,
    distance: float,
) -> Found | None:
    """The first path found through the grid of postures; None if none is found."""
    goals = target_curve(arm, K1)
    axes, start = grid_axes(arm, q0)
    size = [len(axis) for axis in axes]
    for margin in MARGINS:
        steps = [at_start(size, start)]  # the steps of all ticks are kept, 2 bytes for each posture
        for tick in range(1, len(ticks)):
            room = grid_room(arm, axes, (H + ticks[tick] * v)[None])
            steps.append(spread(steps[-1], blocked(room >= distance + margin * arm.lever, size)))
            if steps[-1].min() == NEVER:
                break
            nodes, numbers = (column[:60] for column in arrivals(axes, goals, steps[-1]))
            ends = grid_postures(axes, nodes)
            arrive = ticks[tick] + abs(ends - goals[numbers]).sum(axis=-1) / speed
            positions = _positions(H, v, np.full(len(nodes), ticks[tick]), arrive)
            good = motions_keep(arm, ends, goals[numbers], positions, distance)
            for i in np.flatnonzero(good)[:3]:
                back = grid_postures(axes, way_back(steps, tuple(nodes[i].tolist())))
                path = np.concatenate([back, goals[numbers[i], None]])
                times = np.append(ticks[: tick + 1], arrive[i])
                kept = shortcuts(arm, path, (H + times[:, None] * v)[None], distance)
                if kept is not None:
                    found = f"a search finds a path that takes {arrive[i]:.2f} s."
                    return "search", f"Waiting is not enough; {found}", path[kept], times[kept]
    return None
