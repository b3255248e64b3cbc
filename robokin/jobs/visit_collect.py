"""Visit and collect: how many points the three-joint arm of source 000 can serve in a given time.

A task is a JSON file with exactly the document's keys:

    L1, L2   lengths of the links, m        p0     where the tool starts, m: [x, y, z]
    T        time allowed, s                pi     the points to serve, m: [[x, y, z], ...]
    q'       greatest joint speeds, rad/s   task   "visit": go from point to point; "collect": bring
             each back to p0

    task = read_task("notebooks/tasks/example_3.json")
    print(report(task, visit(task)))

Everything is solved on the document's principal branch, row 0 of `spbu_arm(l1, l2).ik` (errata
S0-d: a second solution may exist inside the same limits, and be nearer). A joint that is free at a
point (joint 1 on axis 1, joint 2 as well where equal links are folded onto the origin) stays where
it stands when the arm arrives; a start there takes the value of the first target that has one
(errata S0-p).
Source: 000, "Определение границ рабочей области", "Нахождение времени", appendix 1; errata S0.
"""

import json
import math
import os
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .._arrays import ArrayLike, Bools, Floats, Ints, by_blocks, components, frozen
from .._validate import (
    TWO_TURNS,
    broadcast,
    floats,
    instance,
    length,
    masked,
    short,
    text,
    warn_if_degrees,
)
from ..arms import spbu_arm, within
from ..arms.geometry import FREE, ROUNDING

KEYS = ("L1", "L2", "T", "q'", "p0", "pi", "task")
SHORTEST, LONGEST = 1e-6, 1e6  # m; a link beyond these is a mistake of units
UNDER = 1e-9  # of the reach: a tool no deeper under the floor than this is on it

# So that no call takes more than some seconds:
EXACT_LIMIT = 16  # points; the exact optimum takes twice the time and memory for each point more
NEAREST_LIMIT = 10_000  # points; to find the nearest again and again compares n^2 / 2 moves
ABOVE_LIMIT = 1_000  # the same if the lowest place of each of these moves is wanted
TASK_LIMIT = 300_000  # points of any task
FILE_LIMIT = 40_000_000  # bytes
# So that a person can read what is said:
FAULTS_SHOWN = 10  # of one kind
POINTS_SHOWN = 1_000


# ---- The arm: where it reaches, how long it takes, how low it comes


def workspace(l1: float, l2: float, points: ArrayLike) -> Bools:
    """Which of the document's four conditions hold: points (..., 3) in metres -> bool (..., 4).

    In this order: not beyond the stretched arm; not under the floor; not nearer to the origin than
    l1 - l2 (where l1 > l2); the elbow not under the floor (where l1 < l2). A point past a border by
    rounding (1e-12 of the reach) is on it (errata S0-l). A point is in the workspace if all four
    hold; then the principal branch exists, inside the limits. Source: 000, "Определение границ
    рабочей области"; its condition cos q2 >= 0 follows (errata S0-c, S0-s).
    """
    l1, l2 = _links(l1, l2)
    x, y, z = components(floats(points, "points", 3))
    slack = ROUNDING * (l1 + l2)
    with np.errstate(over="ignore"):  # a point 1e308 m away is too far, and that is all
        rho = np.hypot(x, y)
        d = np.hypot(rho, z)
        # The elbow is lowest on the floor behind the axis, l1 away: (rho + l1)^2 + z^2 >= l2^2, the
        # last inequality of the document with its terms in another order.
        from_elbow = np.hypot(rho + l1, z)
    inner_sphere = (d >= l1 - l2 - slack) | (l1 <= l2)
    inner_surface = (from_elbow >= l2 - slack) | (l1 >= l2)
    return np.stack([d <= l1 + l2 + slack, z >= -slack, inner_sphere, inner_surface], axis=-1)


def out_of_workspace(l1: float, l2: float, point: ArrayLike) -> list[str]:
    """Why one point (3,) lies outside the workspace: a list of reasons in words, empty if it lies
    inside.
    """
    l1, l2 = _links(l1, l2)
    p = floats(point, "point", 3)
    if p.ndim != 1:
        raise ValueError(f"point: wanted one single point (3,), got {p.shape}")
    holds = workspace(l1, l2, p)
    return [reason for reason, fine in zip(_reasons(l1, l2, p), holds, strict=True) if not fine]


def principal_postures(l1: float, l2: float, points: ArrayLike) -> Floats:
    """The principal branch for points (..., 3) -> q (..., 3): rad, NaN in a joint that is free, all
    NaN out of reach.

    On axis 1 joint 1 is free (errata S0-p), and with equal links folded onto the origin joint 2 as
    well (S0-k).
    """
    l1, l2 = _links(l1, l2)
    # -0.0 is 0: atan2 tells them apart, a point does not
    p = floats(points, "points", 3) + 0.0
    near = FREE * (l1 + l2)
    with np.errstate(over="ignore", invalid="ignore"):  # as in `workspace`
        q = np.array(spbu_arm(l1, l2).ik(p)[..., 0, :])
        rho = np.hypot(p[..., 0], p[..., 1])
        q[rho <= near, 0] = np.nan
        q[np.hypot(rho, p[..., 2]) <= near, 1] = np.nan
    return q


def misfit(l1: float, l2: float, q: ArrayLike, points: ArrayLike) -> Floats:
    """How far the tool at q (..., 3) is from where it should be, points (..., 3): m, (...).
    Infinite if a joint is past its limit, NaN if the posture does not exist.

    It says what the printed program's seven checks mean to say: they have no absolute value, and
    joint 1 is in none of them (errata S0-e).
    """
    arm = spbu_arm(*_links(l1, l2))
    posture, p = floats(q, "q", 3, finite=False), floats(points, "points", 3)
    broadcast("q and points", posture.shape, p.shape)
    posture = _kept(posture, 0.0)  # a free joint may take any value; 0 is one of them
    with np.errstate(over="ignore"):
        gap = np.linalg.norm(arm.fk(posture).translation - p, axis=-1)
    return np.where(within(arm, posture).all(axis=-1) | np.isnan(gap), gap, np.inf)


def travel_time(
    q_from: ArrayLike, q_to: ArrayLike, speeds: ArrayLike, *, short_way: bool = False
) -> Floats:
    """The least time from posture to posture, s: q_from, q_to (..., 3) and greatest speeds (3,) ->
    (...).

    t = max over the joints of |difference| / speed: the slowest joint decides. A joint that is NaN
    costs nothing: in q_to it is free and stays where it stands (errata S0-p), in q_from nobody has
    said where it stands. Going on from a free joint, put in what it has kept: `itinerary` does. NaN
    if every joint is NaN. `short_way` lets joint 1 take the shorter way round, as if it had no stop
    at +-pi (errata S0-o).
    Source: 000, "Нахождение времени". ValueError: wrong shapes, a speed that is not positive.
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
    return _travel(start, end, limits, short_way)


def lowest(l1: float, l2: float, q_from: ArrayLike, q_to: ArrayLike) -> Floats:
    """The least height of the tool, m, on the way from q_from to q_to (..., 3) with every joint
    moving evenly: (...).

    Between two points above the floor it can be negative where l1 > l2 (errata S0-u). Not a sample
    but certain: the tool comes nowhere lower than this minus 1e-9 of the reach. A joint that is NaN
    at one end is free and stands still; NaN if a posture does not exist. ValueError: a joint beyond
    two turns.
    """
    l1, l2 = _links(l1, l2)
    start, end = (
        floats(q, name, 3, finite=False) for q, name in ((q_from, "q_from"), (q_to, "q_to"))
    )
    broadcast("q_from and q_to", start.shape, end.shape)
    for q, name in ((start, "q_from"), (end, "q_to")):
        if (abs(q) > TWO_TURNS).any():
            greatest = np.nanmax(abs(q))
            raise ValueError(f"{name}: wanted joints within two turns, got {greatest:.6g} rad")
    return _lowest(l1, l2, start, end, np.inf)


# ---- The task


class TaskError(ValueError):
    """A task that cannot be worked on; `faults` holds every reason, one text each."""

    def __init__(self, faults: Iterable[str]) -> None:
        self.faults = tuple(faults)
        super().__init__("; ".join(self.faults))


@dataclass(frozen=True, eq=False, init=False)
class Task:
    """A checked task, read-only: links l1, l2 (m), time T (s), greatest joint speeds (3,) in rad/s,
    start p0 (3,) and points (n, 3) in metres, kind "visit" or "collect". `remarks`: what is odd
    about its file, in words, for the report. `q` (1 + n, 3) are the `principal_postures` of p0 and
    of the points.

    TaskError with every fault: see `faults`.

    >>> task = Task(5, 4, 10, [0.2] * 3, [1, 1, 1], [[2, 3, 2], [1, 3, 3]], "visit")
    >>> visit(task).order
    (0, 1)
    """

    l1: float
    l2: float
    T: float
    speeds: Floats
    p0: Floats
    points: Floats
    kind: str
    remarks: tuple[str, ...]
    q: Floats = field(init=False)

    def __init__(
        self,
        l1: float,
        l2: float,
        T: float,
        speeds: ArrayLike,
        p0: ArrayLike,
        points: ArrayLike,
        kind: str,
        remarks: Sequence[str] = (),
    ) -> None:
        given = map(_plain, (l1, l2, T, speeds, p0, points, kind))
        data = dict(zip(KEYS, given, strict=True))
        if found := faults(data):
            raise TaskError(found)
        if not isinstance(remarks, (list, tuple)):
            raise ValueError(f"remarks: wanted a list of texts, got {short(remarks)}")
        l1, l2, T = (float(data[key]) for key in KEYS[:3])
        # -0.0 is 0, as in `principal_postures`
        rows = [frozen(np.array(data[key], dtype=float) + 0.0) for key in KEYS[3:6]]
        vars(self).update(l1=l1, l2=l2, T=T, speeds=rows[0], p0=rows[1], points=rows[2])
        vars(self).update(
            kind=data["task"],
            remarks=tuple(text(remark, "remarks") for remark in remarks),
            q=frozen(principal_postures(l1, l2, np.vstack(rows[1:]))),
        )


def read_task(path: str | os.PathLike[str]) -> Task:
    """The task in a JSON file. TaskError with every fault, whatever the file holds; the file is
    only read.

    A key given twice is a fault. Unknown keys are let be, and named in the task's `remarks`.
    """
    data, twice = _parsed(path)
    if not isinstance(data, dict) or not data.keys() >= set(KEYS):
        raise TaskError(faults(data))
    if again := [f"{key}: given {twice[key]} times" for key in KEYS if twice[key] > 1]:
        raise TaskError(again + faults(data))
    unknown = [short(key) for key in data if key not in KEYS]
    named = ", ".join(unknown[:FAULTS_SHOWN]) + _more(len(unknown), FAULTS_SHOWN, " and {}")
    remarks = (f"unknown keys, ignored: {named}",) if unknown else ()
    L1, L2, T, speeds, p0, points, kind = (data[key] for key in KEYS)
    return Task(L1, L2, T, speeds, p0, points, kind, remarks)


def faults(data: Any) -> list[str]:
    """Everything wrong with a task as its file gives it, a dict with the keys KEYS: a list of
    texts, or an empty one.

    Other keys are let be. Right points are checked against the workspace if the lengths are right
    too, numbered as in the document: 0 is p0, and 1 is pi[0]. Of one kind ten are named, and the
    rest are counted.
    """
    if not isinstance(data, dict):
        return [f"wanted an object with the keys {', '.join(KEYS)}, got {short(data)}"]
    missing = [key for key in KEYS if key not in data]
    found = [f"missing: {', '.join(missing)}"] if missing else []
    wrong = {key for key, (right, _) in RULES.items() if key in data and not right(data[key])}
    for key in (key for key in KEYS if key in wrong):
        many = isinstance(data[key], list) and len(data[key]) > TASK_LIMIT
        got = f"{len(data[key])} of them" if many else short(data[key])
        found.append(f"{key}: wanted {RULES[key][1]}, got {got}")

    wrong.update(missing)
    given = [] if "pi" in wrong else data["pi"]
    points = {} if "p0" in wrong else {0: data["p0"]}
    points |= {i: point for i, point in enumerate(given, 1) if _triple(point)}
    shapeless = [i for i in range(len(given)) if i + 1 not in points]
    found += [
        f"pi[{i}]: wanted {RULES['p0'][1]}, got {short(given[i])}" for i in shapeless[:FAULTS_SHOWN]
    ]
    if more := _more(len(shapeless), FAULTS_SHOWN, "and {} points that are no such array"):
        found.append(more)
    if points and not wrong & {"L1", "L2"}:
        p = np.array(list(points.values()), dtype=float) + 0.0
        found += _unreachable(float(data["L1"]), float(data["L2"]), list(points), p)
    return found


# ---- The answers


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
    costs = 2 * _travel(start, task.q[1:], task.speeds, short_way)
    if above_floor:
        costs[_dips(task, start, task.q[1:])] = np.inf
    order = costs.argsort()
    # Costs that differ by rounding are a tie; sorted, they stand side by side.
    rank = np.cumsum(~_about(costs[order[1:]], costs[order[:-1]]))
    order = order[np.lexsort((order, np.append(0, rank)))]
    times = np.cumsum(costs[order])
    fits = int(_fits(times, task.T).sum())
    return _result(task, order[:fits].tolist(), times[:fits])


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
    legs = _travel(q[:, None], task.q[1:], task.speeds, short_way)  # (postures, n)
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
            code = np.where(_about(arrival, soonest), path[come[:, None], before], 2**64 - 1)
            least[here, visited] = soonest
            path[here, visited] = code.min(axis=0) * np.uint64(16) + np.uint64(last)

    fits = _fits(least, task.T)
    most = int((size * fits).max())
    best = fits & (size == most)
    first = int(path[best & _about(least, least[best].min())].min())
    order = [(first >> 4 * k) & 15 for k in reversed(range(most))]
    ways = _settled(task.q[[0, *(i + 1 for i in order)]])
    return _result(task, order, np.cumsum(_travel(ways[:-1], ways[1:], task.speeds, short_way)))


@np.errstate(over="ignore")
def itinerary(task: Task, result: Result, *, short_way: bool = False) -> tuple[Floats, Floats]:
    """When the arm is where: times (k,) in s and joint values (k, 3) at every stop, p0 first.

    After "collect" the arm returns to p0 with each point. Between two stops every joint moves
    evenly (`np.interp`), so that all arrive together, and none faster than it can. For an
    animation. ValueError: a result of another task.
    """
    q = _stops(task, result)
    times = _travel(q[:-1], q[1:], task.speeds, short_way)
    if short_way:
        q[:, 0] = np.unwrap(q[:, 0])
    return np.concatenate([[0.0], np.cumsum(times)]), q


def answer(task: Task, *, above_floor: bool = False) -> Result:
    """What the document's program computes: `collect` or the greedy `visit`, as the task says."""
    method = collect if instance(task, Task, "task").kind == "collect" else visit
    return method(task, above_floor=above_floor)


def report(task: Task, result: Result) -> str:
    """The result in words, one line for each point served: its index in pi, its coordinates, when
    it is done. Then warnings: a move on which the tool dips under the floor, an order that need not
    be the best, what is odd about the file. POINTS_SHOWN lines of points at most, and FAULTS_SHOWN
    of moves. ValueError: a result of another task.
    """
    stops = _stops(task, result)
    done, count = "collected" if task.kind == "collect" else "visited", len(result.order)
    lines = [
        f"{done} {count} of {len(task.points)} points in {result.time:.13g} s (T = {task.T:.13g} s)"
    ]
    if not count:
        ways = 2 if task.kind == "collect" else 1
        in_time = _fits(ways * _travel(task.q[0], task.q[1:], task.speeds, False), task.T).any()
        why = "what is in time dips under the floor" if in_time else "not enough time"
        lines = [f"could not {task.kind} any points, {why} (T = {task.T:.13g} s)"]
    lines += [
        f"{i} {_coordinates(task.points[i])} at {time:.13g} s"
        for i, time in zip(result.order[:POINTS_SHOWN], result.times, strict=False)
    ]
    lines += filter(None, [_more(count, POINTS_SHOWN, "and {} points")])
    if count and result.left:
        some = ", ".join(map(str, result.left[:POINTS_SHOWN]))
        lines.append(f"left: {some}" + _more(len(result.left), POINTS_SHOWN, " and {}"))
    lines += [f"warning: {words}" for words in (*_low_moves(task, result, stops), *_oddities(task))]
    return "\n\t".join(lines)


# ---- Helpers


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
        costs = _travel(here, q, task.speeds, short_way)
        if back:
            costs += _travel(_kept(q, here), p0, task.speeds, short_way)
        if above_floor:
            costs[_dips(task, here, q)] = np.inf
        best = np.flatnonzero(_about(costs, costs.min()) & _fits(total + costs, task.T))
        if not len(best):
            break
        k = best[left[best].argmin()]  # the first of those that cost least
        total += float(costs[k])
        order.append(int(left[k]))
        times.append(total)
        here = _kept(p0, _kept(q[k], here)) if back else _kept(q[k], here)
        left[k], q[k] = left[-1], q[-1]
        left, q = left[:-1], q[:-1]
    return _result(task, order, times)


def _travel(start: Floats, end: Floats, speeds: Floats, short_way: bool) -> Floats:
    """`travel_time` of what has been checked."""
    with np.errstate(over="ignore", invalid="ignore"):
        turn = abs(end - start)
        if short_way:
            turn[..., 0] = abs((turn[..., 0] + np.pi) % (2 * np.pi) - np.pi)
        one, two, three = components(turn / speeds)
        longest: Floats = np.fmax(np.fmax(one, two), three)
    return longest


def _kept(q: Floats, here: Floats | float) -> Floats:
    """Postures q (..., 3) with each free joint (NaN) as it is in the posture `here`. A posture that
    does not exist has joint 3 missing as well, and stays.
    """
    return np.where(np.isnan(q) & ~np.isnan(q[..., 2:]), here, q)


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


def _stops(task: Task, result: Result) -> Floats:
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
        for i, posture in enumerate(_kept(task.q[1:], here)):
            if (key := (i, posture.tobytes())) not in known:
                known[key] = len(q)
                point.append(i)
                q.append(posture)
            lands[-1].append(known[key])
    return np.array(point), np.array(q), np.array(lands)


def _dips(task: Task, start: Floats, end: Floats) -> Bools:
    """On which moves from start to end (..., 3) does the tool come under the floor? bool (...)."""
    return _lowest(task.l1, task.l2, start, end, below=0) < -UNDER * (task.l1 + task.l2)


def _lowest(l1: float, l2: float, start: Floats, end: Floats, below: float) -> Floats:
    """`lowest` of what has been checked; what is not below the height `below` may be too great."""
    start, end = np.broadcast_arrays(_kept(_kept(start, end), 0.0), _kept(_kept(end, start), 0.0))
    moves = np.concatenate([start[..., 1:], end[..., 1:]], axis=-1).reshape(-1, 4)
    z = by_blocks(lambda block: [_lowest_of_block(l1, l2, block, below)], moves)
    return z.reshape(start.shape[:-1])


@np.errstate(invalid="ignore")  # NaN of postures that do not exist
def _lowest_of_block(l1: float, l2: float, moves: Sequence[Floats], below: float) -> Floats:
    """`_lowest` for moves: q2 and q3 at the start, q2 and q3 at the end, (n,) each.

    Halves those stretches of a move which can still hold a lower place. With a = q2 and b = q2 + q3
    the height is z = l1 cos a - l2 sin b, and a, b run evenly: a stretch of the share h hangs lower
    than its lower end by at most z'' h^2 / 8, and z'' is known from its middle and from how fast it
    can change.
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


def _low_moves(task: Task, result: Result, q: Floats) -> list[str]:
    """The moves of a result, between stops q (k, 3), that dip under the floor, in words."""
    if task.kind == "collect":  # from p0 to each point, and back the same way
        names = [f"between p0 and pi[{i}]" for i in result.order]
        start, end = q[:-1:2], q[1::2]
    else:
        places = ["p0", *(f"pi[{i}]" for i in result.order)]
        names = [f"from {a} to {b}" for a, b in zip(places[:-1], places[1:], strict=True)]
        start, end = q[:-1], q[1:]
    z = _lowest(task.l1, task.l2, start, end, below=0)
    low = np.flatnonzero(z < -UNDER * (task.l1 + task.l2))
    texts = [
        f"the move {names[i]} dips under the floor, down to z = {z[i]:.4g} m"
        for i in low[:FAULTS_SHOWN]
    ]
    more = _more(len(low), FAULTS_SHOWN, "and {} such moves")
    return [*texts, more] if more else texts


def _oddities(task: Task) -> list[str]:
    """What else a reader of the answer should know, in words."""
    found = []
    if task.kind == "collect" and np.isnan(task.q[0]).any() and len(task.points) > 1:
        found.append(
            "p0 is on axis 1, so the order counts: the cheapest next each time, not always the best"
        )
    if (task.speeds > TWO_TURNS).any():
        found.append(
            f"q' = {task.speeds.tolist()}: {task.speeds.max():.6g} rad/s is more than two turns a "
            "second; were degrees meant?"
        )
    return [*found, *task.remarks]


@np.errstate(over="ignore")
def _fits(times: Floats, T: float) -> Bools:
    """Which times are within T: T hit exactly counts, and T passed by rounding is T."""
    return times - T <= ROUNDING * T


@np.errstate(over="ignore")
def _about(times: Floats, least: Floats) -> Bools:
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


def _links(l1: Any, l2: Any) -> tuple[float, float]:
    l1, l2 = length(l1, "l1"), length(l2, "l2")
    for name, value in (("l1", l1), ("l2", l2)):
        if not SHORTEST <= value <= LONGEST:
            wanted = f"a length from {SHORTEST:g} to {LONGEST:g} m"
            raise ValueError(f"{name}: wanted {wanted}, got {value:g}")
    return l1, l2


def _reasons(l1: float, l2: float, point: Floats) -> tuple[str, ...]:
    """What is wrong with one point (3,) if it is outside, one text for each of the four
    conditions.
    """
    x, y, z = point.tolist()
    rho, d = math.hypot(x, y), math.hypot(x, y, z)
    return (
        f"is too far: {d - l1 - l2:.4g} m beyond the stretched arm, l1 + l2 = {l1 + l2:.9g} m",
        f"is under floor: z = {z:.9g} m",
        f"is too close to origin: |p| = {d:.9g} m is less than l1 - l2 = {l1 - l2:.9g} m",
        f"is too close to origin: |p|^2 = {d * d:.9g} m^2 is less than "
        f"l2^2 - l1^2 - 2 l1 rho = {(l2 - l1) * (l2 + l1) - 2 * l1 * rho:.9g} m^2",
    )


def _unreachable(l1: float, l2: float, numbers: Sequence[int], p: Floats) -> list[str]:
    """The faults of points p (n, 3) with their numbers in the document, that the arm cannot
    serve.
    """

    def named(i: int) -> str:
        number = numbers[i]
        name = f"pi[{number - 1}]" if number else "p0"
        return f"point {number} = {name} {_coordinates(p[i])}"

    broken = ~workspace(l1, l2, p)
    told = broken & (broken.cumsum(axis=0) <= FAULTS_SHOWN)
    found = [
        f"{named(i)} {reason}"
        for i in np.flatnonzero(told.any(axis=-1)).tolist()
        for reason, tell in zip(_reasons(l1, l2, p[i]), told[i], strict=True)
        if tell
    ]
    kinds = ("are too far", "are under floor", "are too close to origin", "are too close to origin")
    for kind, count in zip(kinds, broken.sum(axis=0).tolist(), strict=True):
        if more := _more(count, FAULTS_SHOWN, "and {} points " + kind):
            found.append(more)

    inside = np.flatnonzero(~broken.any(axis=-1))
    gaps = misfit(l1, l2, principal_postures(l1, l2, p[inside]), p[inside])
    wrong = np.flatnonzero(~(gaps <= 1e-6 * (l1 + l2)))
    found += [
        f"{named(inside[i])} fails the check of its joint values: off by {gaps[i]:.4g} m"
        for i in wrong[:FAULTS_SHOWN]
    ]
    if more := _more(len(wrong), FAULTS_SHOWN, "and {} points fail it"):
        found.append(more)
    return found


def _parsed(path: str | os.PathLike[str]) -> tuple[Any, Counter[str]]:
    """What a JSON file holds, and how often its outermost object gives each key. TaskError if it
    cannot be had.
    """
    if not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"path: wanted a path, got {short(path)}")
    counts: Counter[str] = Counter()

    def counted(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        counts.clear()  # the outermost object comes last
        counts.update(key for key, _ in pairs)
        return dict(pairs)

    try:
        raw = _content(Path(path))
    except (OSError, ValueError) as error:  # ValueError: a name that no file can have
        if isinstance(error, TaskError):
            raise
        raise TaskError([f"cannot be read: {getattr(error, 'strerror', None) or error}"]) from None
    try:
        data = json.loads(raw.decode("utf-8-sig"), object_pairs_hook=counted)
    except UnicodeDecodeError as error:
        fault = f"is not UTF-8: byte 0x{error.object[error.start]:02x} at position {error.start}"
    except json.JSONDecodeError as error:
        fault = f"is not JSON: {error.msg}, line {error.lineno} column {error.colno}"
        if not error.doc.strip():
            fault = "is empty"
    except RecursionError:
        fault = "is not a task: nested too deeply"
    except ValueError:
        fault = "is not JSON: a number with thousands of digits"
    else:
        return data, counts
    raise TaskError([fault])


def _content(path: Path) -> bytes:
    if path.exists() and not path.is_file():
        raise TaskError([f"is not a file but a {'folder' if path.is_dir() else 'device'}"])
    if (size := path.stat().st_size) > FILE_LIMIT:
        raise TaskError(
            [f"is too big: {size / 1e6:.0f} MB, and {FILE_LIMIT / 1e6:.0f} MB are read"]
        )
    return path.read_bytes()


def _number(value: Any) -> bool:
    try:
        return (
            isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
        )
    except OverflowError:  # a whole number greater than every float
        return False


def _triple(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 3 and all(map(_number, value))


RULES: dict[str, tuple[Callable[[Any], bool], str]] = {  # key: what is right, and its name
    **dict.fromkeys(
        ("L1", "L2"),
        (
            lambda v: _number(v) and SHORTEST <= v <= LONGEST,
            f"a positive number of metres, from {SHORTEST:g} to {LONGEST:g}",
        ),
    ),
    "T": (lambda v: _number(v) and v >= 0, "a finite number of seconds, not negative"),
    "q'": (lambda v: _triple(v) and min(v) > 0, "an array of 3 positive finite numbers, rad/s"),
    "p0": (_triple, "an array of 3 finite numbers, m"),
    "pi": (
        lambda v: isinstance(v, list) and 0 < len(v) <= TASK_LIMIT,
        f"a non-empty array of points, at most {TASK_LIMIT}",
    ),
    "task": (
        lambda v: isinstance(v, str) and v in ("visit", "collect"),
        'either "visit" or "collect"',
    ),
}


def _plain(value: Any, depth: int = 2) -> Any:
    """Arrays and tuples, as a lesson gives them, as the lists of a file. What is too much, or holds
    no numbers, stays as it is, and `faults` refuses it.
    """
    if isinstance(value, (np.ndarray, np.generic)):
        fit = value.dtype.kind not in "mM" and value.size <= 3 * TASK_LIMIT
        return value.tolist() if fit and not masked(value) else value
    if not (depth and isinstance(value, (list, tuple)) and len(value) <= TASK_LIMIT):
        return value
    return [_plain(v, depth - 1) for v in value]


def _more(count: int, shown: int, words: str) -> str:
    """How many more there are than are shown, in the place {} of the words; "" if there are
    none.
    """
    return words.format(f"{count - shown} more") if count > shown else ""


def _coordinates(point: Floats) -> str:
    return f"({', '.join(f'{x:.12g}' for x in point)})"
