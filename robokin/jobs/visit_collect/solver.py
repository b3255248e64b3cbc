"""Answers to a task: which points are served, in which order and when."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..._arrays import Bools, Floats, Ints
from ..._validate import floats, instance, short
from ...arms.geometry import ROUNDING
from .arm import UNDER, joint_travel_time, lowest_place, with_free_joints
from .task import Task, TaskError

# So that no call takes more than some seconds:
EXACT_LIMIT = 16  # points; the exact optimum takes twice the time and memory for each point more
NEAREST_LIMIT = 10_000  # points; to find the nearest again and again compares n^2 / 2 moves
ABOVE_LIMIT = 1_000  # the same if the lowest place of each of these moves is wanted


@dataclass(frozen=True)
class Result:
    """What a task yields: `order` and `left`, indices into its points, and `times`, s, when each
    point of `order` is visited or brought back.
    """

    order: tuple[int, ...]
    times: tuple[float, ...]
    left: tuple[int, ...]

    def __post_init__(self) -> None:
        times = floats(self.times, "times")
        vars(self).update(order=_indices(self.order, "order"), left=_indices(self.left, "left"))
        if times.shape != (len(self.order),):
            wanted = f"{len(self.order)} times, one for each point of order"
            raise ValueError(f"times: wanted {wanted}, got {short(self.times)}")
        vars(self)["times"] = tuple(times.tolist())

    @property
    def time(self) -> float:
        """When the last point is served, s; 0 if none is."""
        return self.times[-1] if self.times else 0.0


@np.errstate(over="ignore")  # here and below: at 1e-308 rad/s a time is infinite, and does not fit
def collect(task: Task, *, short_way: bool = False, above_floor: bool = False) -> Result:
    """Bring as many points as possible to p0, one at a time, within T: the Result.

    Each costs the way there and back; the cheapest come first, the one with the lower index on a
    tie. This is the optimum (errata S0-r), unless p0 lies on axis 1: there the cost of a point
    depends on where joint 1 has been left, and the cheapest next from there need not be the best.
    T hit exactly counts. `above_floor` refuses points on whose way the tool would dip under the
    floor. Source: 000, "Нахождение времени", task "сбора". TaskError: p0 on axis 1 and more than
    NEAREST_LIMIT points (ABOVE_LIMIT with `above_floor`).
    """
    start = instance(task, Task, "task").q[0]
    if np.isnan(start).any():
        return _cheapest_next(task, short_way, above_floor, back=True)
    costs = 2 * joint_travel_time(start, task.q[1:], task.speeds, short_way)
    if above_floor:
        costs[_dips(task, start, task.q[1:])] = np.inf
    order = costs.argsort()
    # Costs that differ by rounding are a tie; sorted, they stand side by side.
    rank = np.cumsum(~_nearly_least(costs[order[1:]], costs[order[:-1]]))
    order = order[np.lexsort((order, np.append(0, rank)))]
    times = np.cumsum(costs[order])
    served = int(fits(times, task.T).sum())
    return _result(task, order[:served].tolist(), times[:served])


def visit(task: Task, *, short_way: bool = False, above_floor: bool = False) -> Result:
    """Go on to the nearest point not yet visited, the one with the lower index on a tie, until T:
    the Result.

    Greedy, as in the document, and not always the optimum (errata S0-q): see `best_visit`. It ends
    where the nearest point does not fit, since then none does; the printed program never ends there
    (S0-f). T hit exactly counts. `above_floor` refuses moves on which the tool would dip under the
    floor.
    Source: 000, "Нахождение времени", task "посещения". TaskError: more than NEAREST_LIMIT points
    (ABOVE_LIMIT with `above_floor`).
    """
    return _cheapest_next(instance(task, Task, "task"), short_way, above_floor, back=False)


@np.errstate(over="ignore")
def best_visit(task: Task, *, short_way: bool = False, above_floor: bool = False) -> Result:
    """The best possible visit: the most points within T, then the least time, then the order that
    is first in the dictionary. Times that differ by rounding (1e-12) are equal. Not in the
    document.

    Exact, by dynamic programming over the sets of visited points; ValueError for more than
    EXACT_LIMIT points, since each point more doubles the work. `above_floor` as in `visit`.
    """
    n = len(instance(task, Task, "task").points)
    if n > EXACT_LIMIT:
        raise ValueError(
            f"task: wanted at most {EXACT_LIMIT} points for the exact optimum, got {n} (each "
            f"point more doubles the work); visit() takes up to {NEAREST_LIMIT}"
        )
    point, q, lands = _standings(task)
    legs = joint_travel_time(q[:, None], task.q[1:], task.speeds, short_way)  # (postures, n)
    if above_floor:
        legs[_dips(task, q[:, None], task.q[1:])] = np.inf

    # A set of points is a number, one bit a point. least[here, visited]: the least time to visit
    # this set, ending in this posture. path: the order that takes it, its points as the digits of a
    # number to base 16, so that of two orders of one set the smaller number is the one first in the
    # dictionary.
    sets = np.arange(2**n)
    size = np.bitwise_count(sets)
    least = np.full((len(q), 2**n), np.inf)
    path = np.zeros((len(q), 2**n), dtype=np.uint64)
    least[0, 0] = 0.0
    for count, last in np.ndindex(n, n):
        visited = sets[(size == count + 1) & (sets >> last & 1 == 1)]
        before = visited ^ (1 << last)
        for here in np.flatnonzero(point == last):
            come = np.flatnonzero((lands[:, last] == here) & (point != last))
            arrival = least[come[:, None], before] + legs[come, last][:, None]  # (postures, sets)
            soonest = arrival.min(axis=0)
            code = np.where(_nearly_least(arrival, soonest), path[come[:, None], before], 2**64 - 1)
            least[here, visited] = soonest
            path[here, visited] = code.min(axis=0) * np.uint64(16) + np.uint64(last)

    in_time = fits(least, task.T)
    most = int((size * in_time).max())
    best = in_time & (size == most)
    first = int(path[best & _nearly_least(least, least[best].min())].min())
    order = [(first >> 4 * k) & 15 for k in reversed(range(most))]
    ways = _settled(task.q[[0, *(i + 1 for i in order)]])
    return _result(
        task, order, np.cumsum(joint_travel_time(ways[:-1], ways[1:], task.speeds, short_way))
    )


@np.errstate(over="ignore")
def itinerary(task: Task, result: Result, *, short_way: bool = False) -> tuple[Floats, Floats]:
    """When the arm is where: times (k,) in s and joint values (k, 3) at every stop, p0 first.

    After "collect" the arm returns to p0 with each point. Between two stops every joint moves
    evenly (`np.interp`), so that all arrive together, and none faster than it can. For an
    animation. ValueError: a result of another task.
    """
    q = stops_of(task, result)
    times = joint_travel_time(q[:-1], q[1:], task.speeds, short_way)
    if short_way:
        q[:, 0] = np.unwrap(q[:, 0])
    return np.concatenate([[0.0], np.cumsum(times)]), q


def answer(task: Task, *, above_floor: bool = False) -> Result:
    """What the document's program computes: `collect` or the greedy `visit`, as the task says."""
    method = collect if instance(task, Task, "task").kind == "collect" else visit
    return method(task, above_floor=above_floor)


# ---- What the report asks besides


def stops_of(task: Task, result: Result) -> Floats:
    """The postures (k, 3) at every stop of a result of this task."""
    instance(task, Task, "task")
    instance(result, Result, "result")
    n = len(task.points)
    if sorted((*result.order, *result.left)) != list(range(n)):
        got = f"{len(result.order)} served and {len(result.left)} left"
        raise ValueError(f"result: wanted one of this task with its {n} points, got {got}")
    stops = [0]
    for i in result.order:
        stops += [i + 1, 0] if task.kind == "collect" else [i + 1]
    return _settled(task.q[stops])


@np.errstate(over="ignore")
def fits(times: Floats, T: float) -> Bools:
    """Which times are within T: T hit exactly counts, and T passed by rounding is T."""
    return times - T <= ROUNDING * T


# ---- Private


@np.errstate(over="ignore")
def _cheapest_next(task: Task, short_way: bool, above_floor: bool, back: bool) -> Result:
    """Serve the cheapest point left, again and again, while it fits; `back` with the way back to
    p0.
    """
    limit = ABOVE_LIMIT if above_floor else NEAREST_LIMIT
    if (n := len(task.points)) > limit:
        what = "collect with p0 on axis 1" if back else "visit"
        floor = " above the floor" if above_floor else ""
        moves = f"up to {n * (n + 1) // 2:.1e} moves to compare"
        raise TaskError([f"pi: wanted at most {limit} points to {what}{floor}, got {n} ({moves})"])
    order: list[int] = []
    times: list[float] = []
    total, here, p0 = 0.0, task.q[0], task.q[0]
    # The points left and their postures, in one long run for each joint; the last takes the place
    # of one that is served.
    left, q = np.arange(n), np.array(task.q[1:], order="F")
    while len(left):
        costs = joint_travel_time(here, q, task.speeds, short_way)
        if back:
            costs += joint_travel_time(with_free_joints(q, here), p0, task.speeds, short_way)
        if above_floor:
            costs[_dips(task, here, q)] = np.inf
        best = np.flatnonzero(_nearly_least(costs, costs.min()) & fits(total + costs, task.T))
        if not len(best):
            break
        k = best[left[best].argmin()]  # the first of those that cost least
        total += float(costs[k])
        order.append(int(left[k]))
        times.append(total)
        here = (
            with_free_joints(p0, with_free_joints(q[k], here))
            if back
            else with_free_joints(q[k], here)
        )
        left[k], q[k] = left[-1], q[-1]
        left, q = left[:-1], q[:-1]
    return _result(task, order, times)


def _settled(q: Floats) -> Floats:
    """The postures q (k, 3) of a way with the values of free joints: that of the stop before; at
    the beginning that of the first stop which has one; 0 if none has.
    """
    q = q.copy()
    for joint in range(3):
        known = ~np.isnan(q[:, joint])
        if not known.any():
            q[:, joint] = 0.0
        source = np.where(known, np.arange(len(q)), known.argmax())
        q[:, joint] = q[np.maximum.accumulate(source), joint]
    return q


def _standings(task: Task) -> tuple[Ints, Floats, Ints]:
    """Every posture in which the arm of a task can stand, the start first: its point (k,), -1 for
    the start; the posture (k, 3); and in which of them it arrives from each at every point (k, n).

    Off axis 1 there is one at a point; on it one for every angle that joint 1 can bring along.
    """
    point, q = [-1], [task.q[0]]
    lands: list[list[int]] = []
    known: dict[tuple[int, bytes], int] = {}
    for here in q:  # which grows
        lands.append([])
        for i, posture in enumerate(with_free_joints(task.q[1:], here)):
            if (key := (i, posture.tobytes())) not in known:
                known[key] = len(q)
                point.append(i)
                q.append(posture)
            lands[-1].append(known[key])
    return np.array(point), np.array(q), np.array(lands)


def _dips(task: Task, start: Floats, end: Floats) -> Bools:
    """On which moves from start to end (..., 3) does the tool come under the floor? bool (...)."""
    return lowest_place(task.l1, task.l2, start, end, below=0) < -UNDER * (task.l1 + task.l2)


@np.errstate(over="ignore")
def _nearly_least(times: Floats, least: Floats) -> Bools:
    """Which times are the least one; those that differ by rounding are equal, on every
    processor.
    """
    return times <= least * (1 + ROUNDING)


def _result(task: Task, order: Sequence[int], times: Iterable[float]) -> Result:
    left = sorted(set(range(len(task.points))) - set(order))
    return Result(tuple(order), tuple(map(float, times)), tuple(left))


def _indices(value: Any, name: str) -> tuple[int, ...]:
    array = floats(value, name)
    if array.ndim != 1 or ((array < 0) | (array % 1 != 0) | (array > 2**53)).any():
        raise ValueError(f"{name}: wanted indices of points, whole numbers, got {short(value)}")
    return tuple(array.astype(int).tolist())
