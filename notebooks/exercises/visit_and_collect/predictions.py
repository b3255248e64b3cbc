"""The facts behind the predictions. Objective 1: p1 to p3, p7; 2: p4, p8; 3: p5, p6."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from itertools import permutations
from typing import Any

import numpy as np

from robokin import deg, mm, within
from robokin.jobs import visit_collect as jobs

from .shared import ARM, FOUR, L1, L2, Floats, costs, drawn, each_needs


def p1() -> dict[str, Any]:
    _, y, z = (float(c) for c in ARM.fk(np.array([90, 90, 0]) * deg).translation.round(9) + 0.0)
    right = "under the floor" if (y, z) == (L1, -L2) else "link 2 upright"
    return {"y": y, "z": abs(z), "l1": L1, "l2": L2, "both": L1 + L2, "right": right}


def p2() -> dict[str, Any]:
    q3 = float(jobs.principal_postures(L1, L2, [L1 + L2, 0, 0])[2]) / deg
    return {"q3": q3, "zero": 0.0, "plus": 90.0, "half": 180.0, "radians": q3 * deg} | {
        "right": "stretched"
    }


@cache
def p3() -> Mapping[str, Any]:
    """How many random points of the workspace have two postures inside the limits."""
    box = np.random.default_rng(0).uniform([-9, -9, 0], [9, 9, 9], size=(20000, 3))
    cloud = box[jobs.workspace(L1, L2, box).all(axis=-1)]
    count = within(ARM, ARM.ik(cloud)).all(axis=-1).sum(axis=-1)
    radius = np.hypot(cloud[:, 0], cloud[:, 1]).astype(int)
    shares = [float(100 * (count[radius == k] == 2).mean()) for k in range(9)]
    d = np.linalg.norm(cloud, axis=-1)
    beta = np.arccos(np.clip((L1**2 + d**2 - L2**2) / (2 * L1 * d), -1, 1))
    rises = np.arcsin(cloud[:, 2] / d) >= beta
    return {
        "n": len(cloud),
        "two": int((count == 2).sum()),
        "far": shares[-1],
        "shares": shares,
        "right": "high up" if ((count == 2) == rises).all() else "all of them",
    }


def p4() -> dict[str, Any]:
    q = jobs.principal_postures(L1, L2, [[-2, 0.01, 2], [-2, -0.01, 2]])
    long, half = float(jobs.travel_time(q[0], q[1], [0.2] * 3)), np.pi / 0.2
    short = float(jobs.travel_time(q[0], q[1], [0.2] * 3, short_way=True))
    right = "nearly a whole turn" if long > 1.5 * half else "2 cm apart"
    return {"long": long, "short": short, "half": half, "speed": 0.2, "right": right}


SUBSETS = (np.arange(2**5)[:, None] >> np.arange(5)) & 1  # (32, 5)


def beaten_by_subset(task: jobs.Task, values: Floats) -> bool:
    """Whether some choice is worth more than taking the cheapest objects first."""
    fits = task.T + 1e-9 >= SUBSETS @ costs(task)
    mine = values[list(jobs.collect(task).order)].sum()
    return bool((SUBSETS[fits] @ values).max() > mine + 1e-9)


def beaten_by_order(task: jobs.Task) -> bool:
    """With the container on axis 1: whether some order brings more objects than cheapest first."""
    best = 0
    for order in permutations(range(1, 6)):
        q = np.repeat(task.q[:1], 11, axis=0)
        q[1::2] = task.q[list(order)]
        arrivals = each_needs(q, task.speeds).max(axis=-1).cumsum()[1::2]
        best = max(best, int((arrivals <= task.T + 1e-9).sum()))
    return best > len(jobs.collect(task).order)


def beaten_on_a_round(task: jobs.Task) -> bool:
    """With a bag that is emptied at the end: whether some order brings more than nearest first."""
    legs = jobs.travel_time(task.q[:, None], task.q, task.speeds)
    nearest_first = jobs.visit(replace(task, kind="visit", T=1000.0)).order  # there is time for all

    def brought(order: tuple[int, ...]) -> int:
        stops = np.array(order) + 1
        reached = legs[[0, *stops[:-1]], stops].cumsum()
        return int((reached + legs[stops, 0] <= task.T + 1e-9).sum())

    return max(map(brought, permutations(range(5)))) > brought(nearest_first)


@cache
def p5() -> Mapping[str, Any]:
    """In how many of 30 random tasks cheapest (or nearest) first is beaten, for each change."""
    beaten = {"container on axis 1": 0, "prices": 0, "unlike speeds": 0, "emptied at the end": 0}
    for seed in range(30):
        task = drawn(seed, 5, "collect")
        prices = np.random.default_rng(seed).integers(1, 10, 5).astype(float)
        beaten["prices"] += beaten_by_subset(task, prices)
        uneven = replace(task, speeds=np.array([0.1, 0.3, 0.5]))
        beaten["unlike speeds"] += beaten_by_subset(uneven, np.ones(5))
        central = replace(task, p0=np.array([0, 0, 6.5]), T=40.0)
        beaten["container on axis 1"] += beaten_by_order(central)
        beaten["emptied at the end"] += beaten_on_a_round(task)
    return beaten | {"right": next(name for name, times in beaten.items() if not times)}


@cache
def p6() -> Mapping[str, Any]:
    """How many points both rules touch in the task of the opening, with twice its time."""
    task = jobs.Task(L1, L2, 15.0, [0.2] * 3, [4, 0, 2], FOUR, "visit")
    ways = jobs.travel_time(task.q[0], task.q[1:], task.speeds)
    few, best = jobs.visit(task), jobs.best_visit(task)
    first, second = (float(t) for t in sorted(ways)[:2])
    right = ("none", "one", "two", "three", "four")[len(few.order)]
    facts = {"T": task.T, "ways": ", ".join(f"{t:.1f}" for t in ways), "best": len(best.order)}
    facts |= {"first": first, "second": second, "leg": first + second}
    facts |= {"next": 2 * first + second, "right": right}
    return facts | {"all": jobs.best_visit(replace(task, T=1000.0)).time}


LOW1, LOW2 = 4.0, 5.0  # m, so that the answer is a round number


def p7() -> dict[str, Any]:
    points = np.linspace([0, 0, 0], [0, 0, 8], 8001)
    served = jobs.workspace(LOW1, LOW2, points).all(axis=-1)
    height = float(points[served.argmax(), 2])
    facts = {"l1": LOW1, "l2": LOW2, "height": height, "triangle": LOW2 - LOW1, "floor": 0.0}
    square = float(np.hypot(LOW1, LOW2))
    facts |= {"square": square, "top": LOW1 + LOW2, "mm": height / mm}
    return facts | {"right": "elbow on the floor"}


DIP = np.array([[6.0, 0, 1], [1.05, 0, 0.1]])  # m


def p8() -> dict[str, Any]:
    q = jobs.principal_postures(L1, L2, DIP)
    low, end = float(jobs.lowest(L1, L2, q[0], q[1])), DIP[1, 2]
    above = "never lower" if low >= end - 1e-9 else "about 0.05 m"
    right = above if low >= 0 else "under the floor"
    return {"low": low, "deep": abs(low), "b": end, "right": right}
