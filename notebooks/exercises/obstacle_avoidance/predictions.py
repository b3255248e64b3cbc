"""The facts behind the predictions of obstacle avoidance.

Objective 1: p1, p2. Objective 2: p3, p5, p6, p7. Objective 3: p4, p8.
"""

from collections.abc import Mapping
from functools import cache
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robokin import deg, mm
from robokin.jobs.obstacles import along, clearance, in_quadrilateral, keeps, via_path, way_round

from .shared import ARM, K1, START, WANTED, Floats, count, direct, distances, drawing, sampled


def nearest(guesses: Mapping[str, float], value: float) -> str:
    """The name of the guess that is closest to a value."""
    return min(guesses, key=lambda name: abs(guesses[name] - value))


@cache
def p1() -> dict[str, Any]:
    rng, many = np.random.default_rng(5), 1500
    before = rng.uniform(0, np.pi, (many, 3))
    r, phi = rng.uniform(1.1, 2.9, many), rng.uniform(0, 120, many) * deg
    targets = np.stack([r * np.cos(phi), r * np.sin(phi)], axis=-1)
    after = ARM.least(targets, before)[0]
    found = []
    for a, b in zip(ARM.points(before)[:, 2:], ARM.points(after)[:, 2:], strict=True):
        corners = np.array([*a, *b[::-1]])
        H = rng.uniform(corners.min(axis=0), corners.max(axis=0))
        if count(corners, H) % 2 == 1:
            found.append(drawing(corners, H))
    seen = sum(drawing(corners, np.zeros(2)) for corners in drawings().values())
    guesses = {"nearly all": len(drawings()), "half": 4, "few": 1, "a quarter": 2}
    told = {"tasks": many, "inside": len(found), "found": sum(found)}
    told |= {"seen": seen, "drawings": len(drawings())}
    return told | {"right": nearest(guesses, seen)}


DRAWN = np.array([(-0.5, 0.4), (0.45, 0.6), (0.55, -0.6), (-0.4, -0.5)])  # m: A, K, K1, A1


def drawings() -> dict[str, Floats]:
    """The drawing, turned by quarters, as it is and mirrored; H is in its middle, at (0, 0)."""
    found = {}
    for shape, corners in (("drawn", DRAWN), ("mirrored", DRAWN * (-1, 1))):
        for quarters in range(4):
            found[f"{shape}, {90 * quarters}°"] = corners
            corners = corners @ np.array([(0, 1), (-1, 0)])
    return found


def swept_by_last(start: Floats, end: Floats, x: Floats, y: Floats) -> NDArray[np.bool_]:
    """Which points (x, y) of a grid lever AK passes over, (len(y), len(x)): in each row everything
    between where the lever is at one moment and at the next, if it crosses the row.
    """
    s = np.linspace(0, 1, 2401)[:, None]
    (ax, ay), (kx, ky) = np.moveaxis(ARM.points(start + s * (end - start))[:, 2:], 0, -1)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (y[:, None] - ay) / (ky - ay)
    crosses, above = (share >= 0) & (share <= 1), y[:, None] > ay
    at = ax + np.clip(share, 0, 1) * (kx - ax)  # the end of the lever that is nearest to the row
    row, moment = np.nonzero(crosses[:, 1:] | crosses[:, :-1] | (above[:, 1:] != above[:, :-1]))
    low, high = np.sort([at[row, moment], at[row, moment + 1]], axis=0)
    ends = np.zeros((len(y), len(x) + 1), dtype=int)
    np.add.at(ends, (row, np.searchsorted(x, low)), 1)
    np.add.at(ends, (row, np.searchsorted(x, high, side="right")), -1)
    over: NDArray[np.bool_] = ends.cumsum(axis=1)[:, :-1] > 0
    return over


FAR = np.array([150, 120, 120]) * deg
FINE_STEP = 0.002  # m: the grid on which areas are counted


@cache
def p2() -> dict[str, Any]:
    start, end = direct(FAR)
    places = ARM.points(along(direct(FAR), np.linspace(0, 1, 201)))[:, 2:].reshape(-1, 2)
    low, high = places.min(axis=0), places.max(axis=0)
    x, y = map(np.arange, low + FINE_STEP / 2, high, (FINE_STEP,) * 2)
    over = swept_by_last(start, end, x, y)
    quad = in_quadrilateral(ARM, start, end, np.stack(np.meshgrid(x, y), axis=-1))["AK"]
    missed, area = over & ~quad, FINE_STEP**2
    share = float(100 * missed.sum() / over.sum())
    guesses = {"nothing": 0, "narrow rim": 5, "a third": 33, "most": 75}
    areas = {"swept": over, "missed": missed, "false": quad & ~over}
    told = {name: float(each.sum() * area) for name, each in areas.items()}
    told |= {"turn": float(abs(end - start).sum() / deg), "share": share, "grid": FINE_STEP / mm}
    return told | {"right": nearest(guesses, share)}


LEVER = np.zeros(2), np.array([1.0, 0.0]), np.array([1.3, 0.4])


def p3() -> dict[str, Any]:
    P, Q, H = LEVER
    guesses = {
        "end": float(np.hypot(*(H - Q)) / mm),
        "line": abs(H[1]) / mm,
        "start": float(np.hypot(*(H - P)) / mm),
        "middle": float(np.hypot(*(H - (P + Q) / 2)) / mm),
        "along": (H[0] - Q[0]) / mm,
        "sum": float(abs(H - Q).sum() / mm),
        "metres": float(np.hypot(*(H - Q))),
    }
    away = float(np.hypot(*(H - [np.clip(H[0], 0, 1), 0])) / mm)
    return guesses | {"x": H[0], "y": H[1], "right": nearest(guesses, away)}


SAMPLED = np.array([1.65, 1.1])  # m: the obstacle of p4
SEEN = 6


@cache
def p4() -> dict[str, Any]:
    path = direct(FAR)
    seen = float(distances(sampled(path, SEEN), SAMPLED).min())
    true = float(clearance(ARM, path, SAMPLED).min())
    less = {"the nearest sample": 0, "a little less": 5, "a decimetre less": 100, "more": -50}
    told = {"count": SEEN, "x": SAMPLED[0], "y": SAMPLED[1], "wanted": WANTED / mm}
    told |= {"least": float(np.floor(seen / mm)), "seen": seen / mm}
    told |= {"true": true / mm, "less": (seen - true) / mm}
    return told | {"right": nearest(less, told["less"])}


PASSED = np.array([1.0, 1.5])  # m: the obstacle of p5
ROUND = np.array([1.2, 1.3])  # m: the obstacle of the opening view and of the wave


@cache
def p5() -> dict[str, Any]:
    path = via_path(ARM, START, K1, PASSED)
    ways = ARM.points(along(path, np.linspace(0, 1, 2001)))[:, 3] - PASSED
    least = clearance(ARM, path, PASSED).min(axis=0)
    far = clearance(ARM, via_path(ARM, START, K1, (1.5, 1.0)), (1.5, 1.0))
    right = "AK a little nearer"
    if min(least) >= WANTED:
        right = "all keep it"
    elif least[2] <= 1 * mm:
        right = "AK and BA over it" if least[1] <= 1 * mm else "AK over it"
    told = {"x": PASSED[0], "y": PASSED[1], "other_x": ROUND[0], "other_y": ROUND[1]}
    told |= {"far": far[:, 2].min() / mm, "gripper": np.hypot(*ways.T).min() / mm, "r": WANTED / mm}
    return told | {"BA": least[1] / mm, "AK": least[2] / mm, "right": right}


@cache
def p6() -> dict[str, Any]:
    """The wave of the lab, and the path that it finds."""
    size = 10 * deg
    angles = np.arange(19) * size
    cube = np.stack(np.meshgrid(angles, angles, angles, indexing="ij"), axis=-1)
    steps = []  # steps of joint j, by the lower of two cells
    for j in range(3):
        a = np.moveaxis(cube, j, 0)
        steps.append(np.moveaxis(keeps(ARM, a[:-1], a[1:], ROUND, WANTED), 0, j))
    goals = ARM.family(K1, np.linspace(*ARM.alpha_range(K1), 200))
    cells = np.round(goals / size).astype(int)
    wanted = cells[keeps(ARM, cells * size, goals, ROUND, WANTED)].tolist()
    queue = [tuple(np.round(START / size).astype(int).tolist())]
    came: dict[Any, Any] = {queue[0]: None}
    for cell in queue:  # the queue grows meanwhile
        if list(cell) in wanted:
            break
        for j, move in product(range(3), (-1, 1)):
            other = (*cell[:j], cell[j] + move, *cell[j + 1 :])
            if 0 <= other[j] < 19 and other not in came and steps[j][min(cell, other)]:
                came[other] = cell
                queue.append(other)
    way = [cell]
    while came[way[-1]]:
        way.append(came[way[-1]])
    length = len(way) - 1
    path = np.array([cube[each] for each in way[::-1]])
    turns = abs(np.diff(path, axis=0)).sum(axis=0) / deg
    net = (path[-1] - path[0]) / deg
    most, straight = float(turns.max()), float(np.linalg.norm(net))
    total, signed = float(turns.sum()), float(abs(net.sum()))
    guesses = {"busiest joint": most, "straight distance": straight, "S": total}
    right = nearest(guesses | {"gripper's direction": signed}, 10.0 * length)
    told = {"count": length, "sum": total, "most": most, "straight": straight}
    return told | {"net": signed, "turns": turns, "right": right}


TASKS = 100
LARGER = 0.25


def sampled_tasks(many: int = TASKS) -> list[tuple[Floats, Floats, Floats]]:
    """The sample of the lab: start, target and an obstacle that lever AK touches somewhere on the
    direct path; start, target and base are more than L/7 away from it.
    """
    rng = np.random.default_rng(33)
    tasks: list[tuple[Floats, Floats, Floats]] = []
    while len(tasks) < many:
        r, phi = rng.uniform(1.2, 2.8, 2), rng.uniform(0, 130, 2) * deg
        P, target = np.stack([r * np.cos(phi), r * np.sin(phi)], axis=-1)
        if np.isnan(ARM.alpha_range(np.stack([P, target]))).any():
            continue
        start = ARM.family(P, rng.uniform(*ARM.alpha_range(P)))
        A, K_ = ARM.points(along(direct(start, target), rng.random()))[2:]
        H = A + rng.random() * (K_ - A)
        near = distances(start[None], H).min()
        if min(np.hypot(*H), np.hypot(*(target - H)), near) > WANTED:
            tasks.append((start, target, H))
    return tasks


@cache
def p7() -> dict[str, Any]:
    keep = out = 0
    for start, target, H in sampled_tasks():
        path = via_path(ARM, start, target, H, LARGER)
        if np.isnan(path).any():
            out += 1
            continue
        # samples can show that a path comes too near; `clearance` decides the others
        if distances(sampled(path, 41), H).min() >= WANTED:
            keep += bool(clearance(ARM, path, H).min() >= WANTED)
    passed = clearance(ARM, via_path(ARM, START, K1, ROUND, LARGER), ROUND)
    guesses = {"none": 0, "a quarter": 25, "two thirds": 65, "all": 100}
    told = {"count": TASKS, "keep": keep, "out": out, "near": TASKS - keep - out}
    lengths = {"passed": float(passed.min() / mm), "r": LARGER / mm, "wanted": WANTED / mm}
    return told | lengths | {"right": nearest(guesses, 100 * keep / TASKS)}


NARROW = np.array([0.5, 1.0])  # m: the obstacle of p8
COARSE = 15


@cache
def p8() -> dict[str, Any]:
    found = way_round(ARM, START, K1, NARROW, WANTED)
    S = np.nan if found is None else float(abs(np.diff(found, axis=0)).sum() / deg)
    proven = found is not None and bool(keeps(ARM, found[:-1], found[1:], NARROW, WANTED).all())
    told = {"x": NARROW[0], "y": NARROW[1], "coarse": COARSE, "S": S, "wanted": WANTED / mm}
    near = float(clearance(ARM, direct(), NARROW).min() / mm)
    return told | {"direct": near, "right": "none found" if proven else "no way"}
