"""The report on a result, with warnings."""

import numpy as np

from ..._arrays import Floats
from ..._validate import TWO_TURNS
from .arm import UNDER, joint_travel_time, lowest_place
from .solver import Result, fits, stops_of
from .task import FAULTS_SHOWN, Task, and_more, coordinates

# With this limit, a report remains readable:
POINTS_SHOWN = 1_000


def report(task: Task, result: Result) -> str:
    """Return the result as text, with a line for each point that is visited or collected: its index
    in pi, its coordinates and its time. Warnings follow about moves on which the tool dips below
    the floor, an order that may not be the best, and anomalies in the file. At most POINTS_SHOWN
    points and FAULTS_SHOWN moves are listed. Raises ValueError if the result belongs to another
    task.
    """
    stops = stops_of(task, result)
    done, count = "collected" if task.kind == "collect" else "visited", len(result.order)
    lines = [
        f"{done} {count} of {len(task.points)} points in {result.time:.13g} s (T = {task.T:.13g} s)"
    ]
    if not count:
        ways = 2 if task.kind == "collect" else 1
        in_time = fits(
            ways * joint_travel_time(task.q[0], task.q[1:], task.speeds, False), task.T
        ).any()
        why = (
            "since every move that is in time dips under the floor"
            if in_time
            else "not enough time"
        )
        lines = [f"could not {task.kind} any points, {why} (T = {task.T:.13g} s)"]
    lines += [
        f"{i} {coordinates(task.points[i])} at {time:.13g} s"
        for i, time in zip(result.order[:POINTS_SHOWN], result.times, strict=False)
    ]
    lines += filter(None, [and_more(count, POINTS_SHOWN, "and {} points")])
    if count and result.left:
        some = ", ".join(map(str, result.left[:POINTS_SHOWN]))
        lines.append(f"left: {some}" + and_more(len(result.left), POINTS_SHOWN, " and {}"))
    lines += [f"warning: {text}" for text in (*_low_moves(task, result, stops), *_oddities(task))]
    return "\n\t".join(lines)


# ---- Private


def _low_moves(task: Task, result: Result, q: Floats) -> list[str]:
    """Warnings on moves between stops q (k, 3) that dip below the floor."""
    if task.kind == "collect":  # from p0 to each point and back
        names = [f"between p0 and pi[{i}]" for i in result.order]
        start, end = q[:-1:2], q[1::2]
    else:
        stops = ["p0", *(f"pi[{i}]" for i in result.order)]
        names = [f"from {a} to {b}" for a, b in zip(stops[:-1], stops[1:], strict=True)]
        start, end = q[:-1], q[1:]
    z = lowest_place(task.l1, task.l2, start, end, below=0)
    low = np.flatnonzero(z < -UNDER * (task.l1 + task.l2))
    texts = [
        f"the move {names[i]} dips under the floor, down to z = {z[i]:.4g} m"
        for i in low[:FAULTS_SHOWN]
    ]
    more = and_more(len(low), FAULTS_SHOWN, "and {} such moves")
    return [*texts, more] if more else texts


def _oddities(task: Task) -> list[str]:
    """Other warnings that a reader should see."""
    found = []
    if task.kind == "collect" and np.isnan(task.q[0]).any() and len(task.points) > 1:
        found.append(
            "p0 is on axis 1, so the order matters: taking the cheapest next is not always the best"
        )
    if (task.speeds > TWO_TURNS).any():
        found.append(
            f"q' = {task.speeds.tolist()}: {task.speeds.max():.6g} rad/s is more than two turns a "
            "second; did you mean degrees?"
        )
    return [*found, *task.remarks]
