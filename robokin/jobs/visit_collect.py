"""Visit and collect: how many points the three-joint arm of source 000 can serve in a given time.

A task is a JSON file with exactly the document's keys:

    L1, L2   lengths of the links, m        p0     where the tool starts, m: [x, y, z]
    T        time allowed, s                pi     the points to serve, m: [[x, y, z], ...]
    q'       greatest joint speeds, rad/s   task   "visit": go from point to point; "collect": bring
             each back to p0

    task = read_task("notebooks/tasks/example_3.json")
    print(report(task, visit(task)))

Everything is solved on the document's principal branch, row 0 of `spbu_arm(l1, l2).ik` (errata
S0-d: a second solution may exist inside the same limits, and be nearer).
Source: 000, "Определение границ рабочей области", "Нахождение времени", appendix 1; errata S0.
"""

import json
import math
import reprlib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .._validate import broadcast, floats, instance
from ..arms import spbu_arm, within
from ..arms.elbow import FREE, ROUNDING

KEYS = ("L1", "L2", "T", "q'", "p0", "pi", "task")
SHORTEST, LONGEST = 1e-6, 1e6  # m; a link beyond these is a mistake of units
EXACT_LIMIT = 16  # points; the exact optimum takes twice the time and memory for each point more


# ---- The arm: where it reaches, and how long it takes


def workspace(l1, l2, points):
    """Which of the document's four conditions hold: points (..., 3) in metres -> bool (..., 4).

    In this order: not beyond the stretched arm; not under the floor; not nearer to the origin than
    l1 - l2 (where l1 > l2); the elbow not under the floor (where l1 < l2). A point past a border by
    rounding (1e-12 of the reach) is on it (errata S0-l). A point is in the workspace if all four
    hold; then the principal branch exists, inside the limits. Source: 000, "Определение границ
    рабочей области"; its condition cos q2 >= 0 follows (errata S0-c, S0-s).
    """
    l1, l2, points = _length(l1, "l1"), _length(l2, "l2"), floats(points, "points", 3)
    x, y, z = np.moveaxis(points, -1, 0)
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


def refusal(l1, l2, point):
    """Why one point (3,) lies outside the workspace: a list of reasons in words, empty if it lies
    inside.
    """
    point = floats(point, "point", 3)
    if point.ndim != 1:
        raise ValueError(f"point: wanted one single point (3,), got {point.shape}")
    x, y, z = point.tolist()
    rho, d = math.hypot(x, y), math.hypot(*point)
    reasons = (
        f"is too far: {d - l1 - l2:.4g} m beyond the stretched arm, l1 + l2 = {l1 + l2:.9g} m",
        f"is under floor: z = {z:.9g} m",
        f"is too close to origin: |p| = {d:.9g} m is less than l1 - l2 = {l1 - l2:.9g} m",
        f"is too close to origin: |p|^2 = {d * d:.9g} m^2 is less than "
        f"l2^2 - l1^2 - 2 l1 rho = {(l2 - l1) * (l2 + l1) - 2 * l1 * rho:.9g} m^2",
    )
    return [
        reason for reason, holds in zip(reasons, workspace(l1, l2, point), strict=True) if not holds
    ]


def postures(l1, l2, points):
    """The principal branch for points (..., 3) -> q (..., 3): rad, NaN in a joint that is free, all
    NaN out of reach.

    On axis 1 joint 1 is free (errata S0-p), and with equal links folded onto the origin joint 2 as
    well (S0-k).
    """
    # -0.0 is 0: atan2 tells them apart, a point does not
    points = floats(points, "points", 3) + 0.0
    q = spbu_arm(l1, l2).ik(points)[..., 0, :].copy()
    near = FREE * (l1 + l2)
    q[np.hypot(points[..., 0], points[..., 1]) <= near, 0] = np.nan
    q[np.linalg.norm(points, axis=-1) <= near, 1] = np.nan
    return q


def misfit(l1, l2, q, points):
    """How far the tool at q (..., 3) is from where it should be, points (..., 3): m, (...).
    Infinite if a joint is past its limit, NaN if the posture does not exist.

    It says what the printed program's seven checks mean to say: they have no absolute value, and
    joint 1 is in none of them (errata S0-e).
    """
    arm, q, points = spbu_arm(l1, l2), floats(q, "q", 3, finite=False), floats(points, "points", 3)
    # A free joint may take any value; 0 is one of them. A missing posture has joint 3 missing as
    # well.
    q = np.where(np.isnan(q) & ~np.isnan(q[..., 2:]), 0.0, q)
    gap = np.linalg.norm(arm.fk(q).translation - points, axis=-1)
    return np.where(within(arm, q).all(axis=-1) | np.isnan(gap), gap, np.inf)


def travel_time(q_from, q_to, speeds, *, short_way=False):
    """The least time from posture to posture, s: q_from, q_to (..., 3) and greatest speeds (3,) ->
    (...).

    t = max over the joints of |difference| / speed: the slowest joint decides. A joint that is NaN
    at either end is free there and costs nothing, so that a stop on axis 1 costs no turn (errata
    S0-p); going on from there to another azimuth, the real arm may need longer. NaN if every joint
    is NaN. `short_way` lets joint 1 take the shorter way round, as if it had no stop at +-pi
    (errata S0-o).
    Source: 000, "Нахождение времени". ValueError: wrong shapes, a speed that is not positive.
    """
    q_from, q_to = (
        floats(q, name, 3, finite=False) for q, name in ((q_from, "q_from"), (q_to, "q_to"))
    )
    broadcast("q_from and q_to", q_from.shape, q_to.shape)
    turn = abs(q_to - q_from)
    if short_way:
        turn[..., 0] = abs((turn[..., 0] + np.pi) % (2 * np.pi) - np.pi)
    with np.errstate(over="ignore"):
        return np.fmax.reduce(turn / _speeds(speeds), axis=-1)


# ---- The task


class TaskError(ValueError):
    """A task that cannot be worked on; `faults` holds every reason, one text each."""

    def __init__(self, faults):
        super().__init__("; ".join(faults))
        self.faults = tuple(faults)


@dataclass(frozen=True, eq=False)
class Task:
    """A checked task: links l1, l2 (m), time T (s), greatest joint speeds (3,) in rad/s, start p0
    (3,) and points (n, 3) in metres, kind "visit" or "collect". `q` (1 + n, 3) are the `postures`
    of p0 and of the points.

    TaskError with every fault: see `faults`.
    """

    l1: float
    l2: float
    T: float
    speeds: np.ndarray
    p0: np.ndarray
    points: np.ndarray
    kind: str
    q: np.ndarray = field(init=False)

    def __post_init__(self):
        given = (self.l1, self.l2, self.T, self.speeds, self.p0, self.points, self.kind)
        found = faults(dict(zip(KEYS, map(_plain, given), strict=True)))
        if found:
            raise TaskError(found)
        for name in ("l1", "l2", "T"):
            object.__setattr__(self, name, float(getattr(self, name)))
        for name in ("speeds", "p0", "points"):
            object.__setattr__(self, name, np.array(getattr(self, name), dtype=float) + 0.0)
        object.__setattr__(self, "q", postures(self.l1, self.l2, np.vstack([self.p0, self.points])))


def read_task(path):
    """The task in a JSON file. TaskError with every fault, whatever the file holds; the file is
    only read.
    """
    path = Path(path)
    try:
        if path.exists() and not path.is_file():
            raise TaskError([f"is not a file but a {'folder' if path.is_dir() else 'device'}"])
        data = json.loads(path.read_bytes().decode("utf-8-sig"))
    except TaskError:
        raise
    except OSError as error:
        raise TaskError([f"cannot be read: {error.strerror or error}"]) from None
    except UnicodeDecodeError as error:
        raise TaskError(
            [f"is not UTF-8: byte 0x{error.object[error.start]:02x} at position {error.start}"]
        ) from None
    except json.JSONDecodeError as error:
        if not error.doc.strip():
            raise TaskError(["is empty"]) from None
        raise TaskError(
            [f"is not JSON: {error.msg}, line {error.lineno} column {error.colno}"]
        ) from None
    except RecursionError:
        raise TaskError(["is not a task: nested too deeply"]) from None
    except ValueError:
        raise TaskError(["is not JSON: a number with thousands of digits"]) from None
    if not isinstance(data, dict) or not data.keys() >= set(KEYS):
        raise TaskError(faults(data))
    return Task(*(data[key] for key in KEYS))


def faults(data):
    """Everything wrong with a task as its file gives it, a dict with the keys KEYS: a list of
    texts, or an empty one.

    Other keys are let be. Right points are checked against the workspace if the lengths are right
    too, numbered as in the document: 0 is p0, and 1 is pi[0].
    """
    if not isinstance(data, dict):
        return [f"wanted an object with the keys {', '.join(KEYS)}, got {_short(data)}"]
    missing = [key for key in KEYS if key not in data]
    found = [f"missing: {', '.join(missing)}"] if missing else []
    wrong = {key for key, (right, _) in RULES.items() if key in data and not right(data[key])}
    found += [
        f"{key}: wanted {RULES[key][1]}, got {_short(data[key])}" for key in KEYS if key in wrong
    ]

    wrong.update(missing)
    points = {} if "p0" in wrong else {0: data["p0"]}
    for i, point in enumerate([] if "pi" in wrong else data["pi"]):
        if _triple(point):
            points[i + 1] = point
        else:
            found.append(f"pi[{i}]: wanted {RULES['p0'][1]}, got {_short(point)}")
    if points and not wrong & {"L1", "L2"}:
        found += _unreachable(float(data["L1"]), float(data["L2"]), points)
    return found


# ---- The answers


@dataclass(frozen=True)
class Result:
    """What a task yields: `order` and `left`, indices into its points, and `times`, s, when each
    point of `order` is visited or brought back.
    """

    order: tuple
    times: tuple
    left: tuple

    @property
    def time(self):
        """When the last point is served, s; 0 if none is."""
        return self.times[-1] if self.times else 0.0


@np.errstate(over="ignore")  # here and below: at 1e-308 rad/s a time is infinite, and does not fit
def collect(task, *, short_way=False):
    """Bring as many points as possible to p0, one at a time, within T: the Result. This is the
    optimum.

    Each costs the way there and back; the cheapest come first, the one with the lower index on a
    tie. T hit exactly counts. Source: 000, "Нахождение времени", task "сбора".
    """
    start, points = _ends(task)
    costs = 2 * travel_time(start, points, task.speeds, short_way=short_way)
    return _cheapest_first(task, lambda here: costs)


@np.errstate(over="ignore")
def visit(task, *, short_way=False):
    """Go on to the nearest point not yet visited, the one with the lower index on a tie, until T:
    the Result.

    Greedy, as in the document, and not always the optimum (errata S0-q): see `best_visit`. It ends
    where the nearest point does not fit, since then none does; the printed program never ends there
    (S0-f). T hit exactly counts.
    Source: 000, "Нахождение времени", task "посещения".
    """
    _, points = _ends(task)
    return _cheapest_first(
        task, lambda here: travel_time(task.q[here], points, task.speeds, short_way=short_way)
    )


@np.errstate(over="ignore")
def best_visit(task, *, short_way=False):
    """The best possible visit: the most points within T, then the least time, then the order that
    is first in the dictionary. Times that differ by rounding (1e-12) are equal. Not in the
    document.

    Exact, by dynamic programming over the sets of visited points; ValueError for more than
    EXACT_LIMIT points, since each point more doubles the work.
    """
    n = len(instance(task, Task, "task").points)
    if n > EXACT_LIMIT:
        raise ValueError(
            f"task: wanted at most {EXACT_LIMIT} points for the exact optimum, got {n} (each "
            f"point more "
            "doubles the work); visit() takes any number"
        )
    legs = travel_time(task.q[:, None], task.q, task.speeds, short_way=short_way)  # (1 + n, 1 + n)
    first, between = legs[0, 1:], legs[1:, 1:]
    point, bit = np.arange(n), 1 << np.arange(n)

    # A set of points is a number, one bit a point. least[visited, last]: the least time to visit
    # this set, ending at `last`. path: the order that takes it, its points as the digits of a
    # number to base 16, so that of two orders of one set the smaller number is the one first in the
    # dictionary.
    least = np.full((2**n, n), np.inf)
    path = np.zeros((2**n, n), dtype=np.uint64)
    least[bit, point], path[bit, point] = first, point
    for visited in range(1, 2**n):
        arrival = least[visited][:, None] + between  # (last, next)
        soonest = arrival.min(axis=0)
        order = np.where(
            _about(arrival, soonest), path[visited][:, None], np.uint64(2**64 - 1)
        ).min(axis=0)
        new = point[(visited & bit) == 0]
        least[visited | bit[new], new] = soonest[new]
        path[visited | bit[new], new] = order[new] * np.uint64(16) + new.astype(np.uint64)

    size = np.bitwise_count(np.arange(2**n))[:, None]
    fits = _fits(least, task.T)
    most = int((size * fits).max())
    best = fits & (size == most)
    code = int(path[best & _about(least, least[best].min())].min()) if most else 0
    order = [(code >> 4 * k) & 15 for k in reversed(range(most))]
    stops = [0, *(i + 1 for i in order)]
    return _result(task, order, np.cumsum(legs[stops[:-1], stops[1:]]))


@np.errstate(over="ignore")
def itinerary(task, result, *, short_way=False):
    """When the arm is where: times (k,) in s and joint values (k, 3) at every stop, p0 first.

    After "collect" the arm returns to p0 with each point. Between two stops every joint moves
    evenly (`np.interp`), so that all arrive together; a joint that is free at a stop moves on
    evenly to the next. For an animation.
    """
    _ends(task)
    stops = [0]
    for i in result.order:
        stops += [i + 1, 0] if task.kind == "collect" else [i + 1]
    q = task.q[stops]
    t = np.concatenate(
        [[0.0], np.cumsum(travel_time(q[:-1], q[1:], task.speeds, short_way=short_way))]
    )
    for joint in (0, 1):
        fixed = ~np.isnan(q[:, joint])
        values = q[fixed, joint] if fixed.any() else np.zeros(1)
        if short_way and joint == 0:
            values = np.unwrap(values)
        q[:, joint] = np.interp(t, t[fixed] if fixed.any() else t[:1], values)
    return t, q


def answer(task):
    """What the document's program computes: `collect` or the greedy `visit`, as the task says."""
    return collect(task) if instance(task, Task, "task").kind == "collect" else visit(task)


def report(task, result):
    """The result in words, one line for each point served: its index in pi, its coordinates, when
    it is done.
    """
    done = "collected" if task.kind == "collect" else "visited"
    if not result.order:
        return f"could not {task.kind} any points, not enough time (T = {task.T:.13g} s)"
    lines = [
        f"{done} {len(result.order)} of {len(task.points)} points in {result.time:.13g} s (T = "
        f"{task.T:.13g} s)"
    ]
    lines += [
        f"\t{i} {_coordinates(task.points[i])} at {time:.13g} s"
        for i, time in zip(result.order, result.times, strict=True)
    ]
    if result.left:
        lines.append(f"\tleft: {', '.join(map(str, result.left))}")
    return "\n".join(lines)


# ---- Helpers


def _cheapest_first(task, costs_from):
    """Serve the cheapest point left while it fits: costs_from(here) (n,) in s, `here` the row of
    task.q just served.
    """
    order, times, total, here = [], [], 0.0, 0
    left = np.ones(len(task.points), dtype=bool)
    while left.any():
        costs = np.where(left, costs_from(here), np.inf)
        fits = _fits(total + costs, task.T)
        if not fits.any():
            break
        i = int((fits & _about(costs, costs.min())).argmax())  # the first of those that cost least
        left[i] = False
        total, here = total + float(costs[i]), i + 1
        order.append(i)
        times.append(total)
    return _result(task, order, times)


def _fits(times, T):
    """Which times are within T: T hit exactly counts, and T passed by rounding is T."""
    return times - T <= ROUNDING * T


def _about(times, least):
    """Which times are the least one; those that differ by rounding are equal, on every
    processor.
    """
    return times <= least * (1 + ROUNDING)


def _result(task, order, times):
    left = sorted(set(range(len(task.points))) - set(order))
    return Result(tuple(order), tuple(map(float, times)), tuple(left))


def _ends(task):
    """The posture at the start and those at the points."""
    return instance(task, Task, "task").q[0], task.q[1:]


def _unreachable(l1, l2, points):
    """The faults of points, a dict of number -> point, that the arm cannot serve."""
    found = []
    p = np.array([[float(x) for x in point] for point in points.values()]) + 0.0
    named = [
        f"point {number} = {f'pi[{number - 1}]' if number else 'p0'} {_coordinates(point)}"
        for number, point in zip(points, p, strict=True)
    ]
    inside = workspace(l1, l2, p).all(axis=-1)
    for i in np.flatnonzero(~inside):
        found += [f"{named[i]} {reason}" for reason in refusal(l1, l2, p[i])]
    gaps = misfit(l1, l2, postures(l1, l2, p[inside]), p[inside])
    for i, gap in zip(np.flatnonzero(inside), gaps, strict=True):
        if not gap <= 1e-6 * (l1 + l2):
            found.append(f"{named[i]} fails the check of its joint values: off by {gap:.4g} m")
    return found


def _number(value):
    try:
        return (
            isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
        )
    except OverflowError:  # a whole number greater than every float
        return False


def _triple(value):
    return isinstance(value, list) and len(value) == 3 and all(map(_number, value))


RULES = {  # key: what is right, and how it is called
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
    "pi": (lambda v: isinstance(v, list) and len(v) > 0, "a non-empty array of points"),
    "task": (lambda v: v in ("visit", "collect"), 'either "visit" or "collect"'),
}


def _length(value, name):
    length = floats(value, name)
    if length.shape or not length > 0:
        raise ValueError(f"{name}: wanted one positive length in metres, got {_short(value)}")
    return float(length)


def _speeds(value):
    speeds = floats(value, "speeds", 3)
    if not (speeds > 0).all():
        raise ValueError(f"speeds: wanted three positive numbers, got {speeds.tolist()}")
    return speeds


def _plain(value, depth=2):
    """Arrays and tuples, as a lesson gives them, as the lists of a file."""
    value = value.tolist() if isinstance(value, (np.ndarray, np.generic)) else value
    if not (depth and isinstance(value, (list, tuple))):
        return value
    return [_plain(v, depth - 1) for v in value]


def _coordinates(point):
    return f"({', '.join(f'{x:.12g}' for x in point)})"


def _short(value):
    return reprlib.repr(value)
