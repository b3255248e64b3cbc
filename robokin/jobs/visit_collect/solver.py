"""Solutions of a task: the points that the arm visits or collects, their order and their times."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..._arrays import Bools, Floats, Ints, Sealed
from ..._validate import floats, instance, short
from ...arms.geometry import ROUNDING
from .arm import UNDER, joint_travel_time, lowest_place, with_free_joints
from .task import Task, TaskError

# With these limits, every call takes at most a few seconds. Maximum number of points for the exact
# optimum; each additional point doubles its time and memory:
EXACT_LIMIT = 16
# Maximum number of points; repeatedly finding the nearest of n points compares n^2 / 2 moves:
NEAREST_LIMIT = 10_000
# Maximum number of points if the lowest point of each of these moves is computed as well:
ABOVE_LIMIT = 1_000


@dataclass(frozen=True)
class Result(Sealed):
    """The result of a task. `order` and `left` are indices of its points, and `times`, in s, are
    the times at which the points of `order` are visited or brought back.
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
        """The time in s at which the last point is visited or brought back; 0 if there is none."""
        return self.times[-1] if self.times else 0.0


# at 1e-308 rad/s, a time overflows to infinity, which exceeds T (here and below)
@np.errstate(over="ignore")
def collect(task: Task, *, short_way: bool = False, above_floor: bool = False) -> Result:
    """Bring as many points as possible to p0, one at a time, within T.

    The cost of a point is the time there and back. The cheapest points come first; of equally cheap
    ones, the one with the lower index. This is the optimum (errata S0-r), unless p0 is on axis 1:
    there, the cost of a point depends on the value that joint 1 has kept, and the cheapest next
    point may not be the best. A time of exactly T is allowed. `above_floor` excludes points for
    which the tool would dip below the floor on the way. Source: 000, "Нахождение времени", task
    "сбора". Raises TaskError if p0 is on axis 1 and there are more than NEAREST_LIMIT points
    (ABOVE_LIMIT with `above_floor`).
    """
    start = instance(task, Task, "task").q[0]
    if np.isnan(start).any():
        return _cheapest_next(task, short_way, above_floor, back=True)
    costs = 2 * joint_travel_time(start, task.q[1:], task.speeds, short_way)
    if above_floor:
        costs[_dips(task, start, task.q[1:])] = np.inf
    order = costs.argsort()
    # Costs that differ only by rounding count as equal; after sorting, they are adjacent.
    rank = np.cumsum(~_nearly_least(costs[order[1:]], costs[order[:-1]]))
    order = order[np.lexsort((order, np.append(0, rank)))]
    times = np.cumsum(costs[order])
    served = int(fits(times, task.T).sum())
    return _result(task, order[:served].tolist(), times[:served])


def visit(task: Task, *, short_way: bool = False, above_floor: bool = False) -> Result:
    """Go to the nearest unvisited point (of equally near ones, to the one with the lower index) as
    long as T permits.

    This is greedy, as in the document, and not always optimal (errata S0-q): see `best_visit`. It
    ends when the nearest point does not fit within T, since then none does; the printed program
    never ends in that case (S0-f). A time of exactly T is allowed. `above_floor` excludes moves on
    which the tool would dip below the floor. Source: 000, "Нахождение времени", task "посещения".
    Raises TaskError if there are more than NEAREST_LIMIT points (ABOVE_LIMIT with `above_floor`).
    """
    return _cheapest_next(instance(task, Task, "task"), short_way, above_floor, back=False)


@np.errstate(over="ignore")
def best_visit(task: Task, *, short_way: bool = False, above_floor: bool = False) -> Result:
    """The best visit: the one with the most points within T, then with the shortest time, then with
    the lexicographically first order. Times that differ only by rounding (1e-12) count as equal.
    This method is not in the document.

    The result is exact: it is found by dynamic programming over the sets of visited points. Raises
    ValueError if there are more than EXACT_LIMIT points, since each additional point doubles the
    work. `above_floor` is as in `visit`.
    """
    n = len(instance(task, Task, "task").points)
    if n > EXACT_LIMIT:
        raise ValueError(
            f"task: wanted at most {EXACT_LIMIT} points for the exact optimum, got {n} (each "
            f"additional point doubles the work); visit() takes up to {NEAREST_LIMIT}"
        )
    point, q, lands = _standings(task)
    legs = joint_travel_time(q[:, None], task.q[1:], task.speeds, short_way)  # (postures, n)
    if above_floor:
        legs[_dips(task, q[:, None], task.q[1:])] = np.inf

    # A set of points is a number with one bit per point. least[here, visited] is the shortest time
    # to visit this set and end in this posture. path is the order with that time, with its points
    # as the digits of a number in base 16, so that the lexicographically first of two orders is the
    # smaller number.
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
    """The timetable of the arm: times (k,) in s and joint values (k, 3) at every stop, p0 first.

    In "collect" the arm returns to p0 with each point. Between two stops every joint moves at
    constant speed (`np.interp`), so that all arrive together and none exceeds its limit. It is
    meant for animations. Raises ValueError if the result belongs to another task.
    """
    q = stops_of(task, result)
    times = joint_travel_time(q[:-1], q[1:], task.speeds, short_way)
    if short_way:
        q[:, 0] = np.unwrap(q[:, 0])
    return np.concatenate([[0.0], np.cumsum(times)]), q


def answer(task: Task, *, above_floor: bool = False) -> Result:
    """Solve a task as the document's program does: by `collect` or by the greedy `visit`."""
    method = collect if instance(task, Task, "task").kind == "collect" else visit
    return method(task, above_floor=above_floor)


# ---- For the report


def stops_of(task: Task, result: Result) -> Floats:
    """The postures (k, 3) at all stops of a result of this task."""
    instance(task, Task, "task")
    instance(result, Result, "result")
    n = len(task.points)
    if sorted((*result.order, *result.left)) != list(range(n)):
        got = f"{len(result.order)} in order and {len(result.left)} in left"
        raise ValueError(f"result: wanted a result of this task with {n} points, got {got}")
    stops = [0]
    for i in result.order:
        stops += [i + 1, 0] if task.kind == "collect" else [i + 1]
    return _settled(task.q[stops])


def candidates(task: Task, result: Result) -> Iterator[tuple[str, Ints, Floats]]:
    """All moves that the method compared, stop by stop, as the document's program logs them: the
    name of the place where the arm stands, the indices (m,) of the points that are left, and the
    times t1, t2, t3 (m, 3) in s that the joints need to go there. The last stop is the one at which
    no point fits within T. A joint that is free at the start needs no time.

    In "collect" every move starts at p0, so one stop has all of them, unless p0 is on axis 1: there
    joint 1 keeps a different value after each point.
    """
    stops_of(task, result)  # checks that they belong together
    here, p0, left = task.q[0], task.q[0], np.arange(len(task.points))
    collects, once = task.kind == "collect", not np.isnan(task.q[0]).any()
    name = "p0"
    for chosen in (*result.order, None):
        if not len(left):
            return
        with np.errstate(over="ignore"):
            times = abs(with_free_joints(task.q[1 + left], here) - here) / task.speeds
        yield name, left, np.nan_to_num(times, nan=0.0, posinf=np.inf)
        if chosen is None or (collects and once):
            return
        there = with_free_joints(task.q[1 + chosen], here)
        here = with_free_joints(p0, there) if collects else there
        name = "p0" if collects else f"pi[{chosen}]"
        left = left[left != chosen]


@np.errstate(over="ignore")
def fits(times: Floats, T: float) -> Bools:
    """Return whether times are within T. A time that exceeds T only by rounding is within T."""
    return times - T <= ROUNDING * T


# ---- Private


@np.errstate(over="ignore")
def _cheapest_next(task: Task, short_way: bool, above_floor: bool, back: bool) -> Result:
    """Repeatedly take the cheapest remaining point while it fits within T. With `back`, its cost
    includes the way back to p0.
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
    # The remaining points and their postures, contiguous for each joint. When a point is taken, the
    # last one moves to its place.
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
        k = best[left[best].argmin()]  # of the cheapest points, the one with the lowest index
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
    """Fill in the free joints of the postures q (k, 3) on a path with their values at the previous
    stop. At the beginning, use the value at the first stop where the joint is not free, or 0 if
    there is none.
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
    """All postures in which the arm of a task can stop, the start first: the index of the point
    (k,) for each posture, -1 for the start; the postures (k, 3); and, for each posture and each
    point, the index (k, n) of the posture in which the arm arrives there.

    A point off axis 1 has one posture; a point on it has one for each value that joint 1 can have
    on arrival.
    """
    point, q = [-1], [task.q[0]]
    lands: list[list[int]] = []
    known: dict[tuple[int, bytes], int] = {}
    for here in q:  # the list grows in the loop
        lands.append([])
        for i, posture in enumerate(with_free_joints(task.q[1:], here)):
            if (key := (i, posture.tobytes())) not in known:
                known[key] = len(q)
                point.append(i)
                q.append(posture)
            lands[-1].append(known[key])
    return np.array(point), np.array(q), np.array(lands)


def _dips(task: Task, start: Floats, end: Floats) -> Bools:
    """Return whether the tool dips below the floor on the moves from start to end (..., 3)."""
    return lowest_place(task.l1, task.l2, start, end, below=0) < -UNDER * (task.l1 + task.l2)


@np.errstate(over="ignore")
def _nearly_least(times: Floats, least: Floats) -> Bools:
    """Return whether times equal the least one. Times that differ only by rounding count as equal,
    so that the result is the same on every processor.
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
