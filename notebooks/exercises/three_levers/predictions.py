"""The facts behind the predictions of three levers."""

from collections.abc import Mapping
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

from robokin import deg
from robokin.jobs.redundancy import equal_angles, least_movement, race, random_choice

from .shared import ARM, K, direction

UPRIGHT, BENT = np.array([90, 180, 180]) * deg, np.array([90, 180, 120]) * deg  # p1
NEAR, FAR = 1.5, 2.8  # p2: m
# p4: radius in m around O, and alpha; gamma stays below 180° from 30° to 130°
RING, SAMPLE = 1.8, 80 * deg
ANGLES, DISTANCES = (30.0, 170.0), (1.2, 2.7)  # p6: degrees, m, where the moves begin
BEHIND, BEHIND_KO = 150.0, 2.0  # p5: degrees, m
COARSE, FINE = 1.0, 0.1  # p7: degrees
STAND, TARGET = np.array([60, 120, 120]) * deg, np.array([2.4, 0.4])  # p8
JOINTS = ("gamma", "beta", "alpha")
RATE = 30.0  # p8: degrees per second, every motor
TOURS, STOPS, ROWS = 120, 5, 121  # p9
RACED = 100  # p10


def said(place: Any) -> str:
    return f"({place[0]:.2f}, {place[1]:.2f}) m".translate(str.maketrans("-", "\N{MINUS SIGN}"))


def nearest(value: Any, guesses: Mapping[str, Any]) -> str:
    """The name of the guess, a number or a point, that is closest to a value."""
    return min(guesses, key=lambda name: float(np.linalg.norm(np.subtract(guesses[name], value))))


def below(value: float, limits: Mapping[str, float]) -> str:
    """The name of the first limit that is above a value."""
    return next(name for name, limit in limits.items() if value < limit)


def p1() -> dict[str, Any]:
    gripper = ARM.points(BENT)[3]
    guesses = {
        "on the left": gripper * [-1, 1],
        "60° to the right": gripper,
        "120° to the right": ARM.points(UPRIGHT)[2] + direction(-30 * deg),
        "in line": ARM.points(np.array([30, 180, 180]) * deg)[3],
    }
    told = {name: said(place) for name, place in guesses.items()}
    return told | {"right": nearest(gripper, guesses)}


def width(KO: float) -> float:
    """The width of the range of alpha, in degrees."""
    low, high = ARM.alpha_range((KO, 0), limited=False)
    return float(high - low) / deg


def p2() -> dict[str, Any]:
    near, far = width(NEAR), width(FAR)
    wider, share = min(near * FAR / NEAR, 180.0), near * NEAR / FAR
    guesses = {"wider": wider, "as wide": near, "in proportion": share, "little room": far}
    told = {"near_KO": NEAR, "far_KO": FAR, "lowest": 180 - far, "between": width(2.0)}
    return guesses | told | {"right": nearest(width(FAR), guesses)}


def p3() -> dict[str, Any]:
    KO = float(np.hypot(*K))
    low, turn = 180 - width(KO), float(np.arccos((KO - 1) / 2)) / deg
    guesses = {"trapezoid": 180 - turn, "middle": (low + 180) / 2, "hexagon": 120.0}
    guesses |= {"turn": turn, "square": 90.0}
    _, beta, alpha = ARM.family(K, np.array([*guesses.values()]) * deg).T
    right = [*guesses][int(np.argmin(abs(beta - alpha)))]
    return guesses | {"low": low, "radians": guesses[right] * deg, "right": right}


def p4() -> dict[str, Any]:
    there = RING * direction(120 * deg)
    wrong = np.arctan(there[1] / there[0]) - np.arctan2(there[1], there[0])
    gripper = ARM.points(ARM.family(there, SAMPLE) + [wrong, 0, 0])[3]
    guesses = {"stays on K": there, "mirror image": there * [-1, 1], "opposite side": -there}
    told: dict[str, Any] = {name: said(place) for name, place in guesses.items()}
    told |= {"gripper": said(gripper), "off": float(np.hypot(*(gripper - there)))}
    return told | {"right": nearest(gripper, guesses | {"stops at 90°": np.array([0, RING])})}


def usable(phi: float) -> float:
    """The percentage of the range of alpha in which gamma is at most 180 degrees."""
    place = BEHIND_KO * direction(phi * deg)
    low, high = (float(x) for x in ARM.alpha_range(place))
    first, last = (float(x) for x in ARM.alpha_range(place, limited=False))
    return 0.0 if np.isnan(low) else 100 * (high - low) / (last - first)


@cache
def p5() -> dict[str, Any]:
    place, share = BEHIND_KO * direction(BEHIND * deg), usable(BEHIND)
    low = float(ARM.alpha_range(place, limited=False)[0]) / deg
    first, last = ARM.family(place, np.array([low, 180]) * deg)[:, 0] / deg
    guesses = {"all of it": 100.0, "half of it": 50.0, "1 % of it": 1.0, "none of it": 0.0}
    told = {"phi": BEHIND, "KO": BEHIND_KO, "low": low, "share": share, "first": first}
    none_from = next(phi for phi in np.arange(150, 180, 0.01) if usable(phi) == 0)
    return told | {"last": last, "none_from": none_from, "right": nearest(share, guesses)}


@cache
def p6() -> dict[str, Any]:
    """Moves from random postures to points 10 cm away from the gripper."""
    rng = np.random.default_rng(6)
    before = rng.uniform(*ANGLES, (900, 3)) * deg
    gripper = ARM.points(before)[:, 3]
    far = np.hypot(*gripper.T)
    keep = (far > DISTANCES[0]) & (far < DISTANCES[1])
    places = gripper[keep] + 0.1 * direction(rng.uniform(0, 2 * np.pi, int(keep.sum())))
    before = before[keep]
    q, S = ARM.least(places, before)
    reached = np.isfinite(S)
    still = (abs(q - before)[reached] < 1e-6).sum(axis=-1)
    low, high = least, most = ARM.alpha_range(places)
    for _ in range(3):  # with finer and finer steps
        alphas = np.linspace(low, high, 301, axis=-1)
        rows = ARM.family(places[:, None], alphas)
        squares = ((rows - before[:, None]) ** 2).sum(axis=-1)
        best = np.where(np.isnan(squares), np.inf, squares).argmin(axis=-1)[:, None]
        middle, step = np.take_along_axis(alphas, best, 1)[:, 0], (high - low) / 300
        low, high = np.maximum(middle - step, least), np.minimum(middle + step, most)
    change = abs(np.take_along_axis(rows, best[..., None], 1)[:, 0] - before)[reached]
    shares = [float((still == k).mean()) for k in range(4)]
    facts: dict[str, Any] = {
        "count": int(reached.sum()),
        "one": 100 * shares[1],
        "none": 100 * shares[0],
    }
    facts |= {"two": int((still == 2).sum())}
    facts |= dict(zip(("lowest", "highest"), ANGLES, strict=True))
    facts |= dict(zip(("nearest", "farthest"), DISTANCES, strict=True))
    facts |= {"squares": 100 * float((change > 0.001 * deg).all(axis=-1).mean())}
    return facts | {"right": ("all three", "two", "one", "none")[int(np.argmax(shares))]}


@cache
def p7() -> dict[str, Any]:
    rng = np.random.default_rng(9)
    r, phi = rng.uniform(1.05, 2.95, 150), rng.uniform(0, 120, 150) * deg
    before, ring = rng.uniform(30, 170, (150, 3)) * deg, r[:, None] * direction(phi)
    there = np.isfinite(ARM.alpha_range(ring)[0])
    ring, before = ring[there], before[there]
    least = ARM.least(ring, before)[1]

    def above(step: float) -> float:
        S = [ARM.sweep(*task, step * deg)[1] for task in zip(ring, before, strict=True)]
        return float((np.array(S) - least).mean()) / deg

    coarse, found = above(COARSE), above(FINE)
    guesses = {"as before": coarse, "root of ten": coarse / np.sqrt(10)}
    guesses |= {"ten times less": coarse / 10, "a hundred times less": coarse / 100}
    right = nearest(np.log(found), {name: np.log(guess) for name, guess in guesses.items()})
    return guesses | {"right": right, "found": found, "count": len(ring)}


@cache
def p8() -> dict[str, Any]:
    low, high = ARM.alpha_range(TARGET)
    for _ in range(3):  # with finer and finer steps
        alphas = np.linspace(low, high, 1001)
        change = abs(ARM.family(TARGET, alphas) - STAND) / deg
        best = int(change.max(-1).argmin())
        low, high = alphas[max(best - 1, 0)], alphas[min(best + 1, 1000)]
    least, other = abs(ARM.least(TARGET, STAND)[0] - STAND) / deg, change[best]
    facts: dict[str, Any] = {"rate": RATE}
    for name, each in (("", least), ("other_", other)):
        facts |= {f"{name}{joint}": float(x) for joint, x in zip(JOINTS, each, strict=True)}
        S, longest = float(each.sum()), float(each.max())
        facts |= {f"{name}S": S, f"{name}sum_time": S / RATE}
        facts |= {f"{name}longest": longest, f"{name}time": longest / RATE}
    gap, bounds = facts["time"] - facts["other_time"], (-0.01, 0.01, np.inf)
    names = "the least S", "both together", "the other one"
    return facts | {"right": below(gap, dict(zip(names, bounds, strict=True)))}


def best_in_all(before: Any, tour: Any, count: int = ROWS) -> float:
    """The least S of all tasks of a tour together, among `count` postures for each."""
    stages = ARM.family(tour[:, None], np.linspace(*ARM.alpha_range(tour), count, axis=-1))
    cost = abs(stages[0] - before).sum(axis=-1)
    for one, two in pairwise(stages):
        between = sum(abs(one[:, None, j] - two[None, :, j]) for j in range(3))
        cost = (cost[:, None] + between).min(axis=0)
    return float(cost.min())


@cache
def losses() -> Any:
    """The fraction of S that the greedy rule loses in each tour."""
    rng = np.random.default_rng(1)
    r, phi = rng.uniform(1.1, 2.9, (400, STOPS)), rng.uniform(0, 150, (400, STOPS)) * deg
    tours = r[..., None] * direction(phi)
    tours = tours[np.isfinite(ARM.alpha_range(tours)[0]).all(axis=-1)][:TOURS]
    before = rng.uniform(30, 150, (len(tours), 3)) * deg
    S, now = np.zeros(len(tours)), before
    for stop in range(STOPS):
        now, more = ARM.least(tours[:, stop], now)
        S = S + more
    return S / np.array([*map(best_in_all, before, tours)]) - 1


def p9() -> dict[str, Any]:
    lost, tours = losses(), len(losses())
    count = int((lost > 0.05).sum())
    facts: dict[str, Any] = {"tours": tours, "stops": STOPS, "rows": ROWS, "count": count}
    # with enough rows the plan never turns more than the greedy arm
    right = "few" if 0 < count < tours and lost.min() > -0.005 else "either"
    return facts | {"most": 100 * float(lost.max()), "right": right}


def raced() -> Any:
    """The targets (100, 2) of the race."""
    postures = np.random.default_rng(4).uniform(0, np.pi, (3 * RACED, 3))
    places = ARM.points(postures)[:, 3]
    return places[np.isfinite(ARM.alpha_range(places)[0])][:RACED]


@cache
def turns() -> dict[str, Any]:
    """The race with three of its rules: name of the rule -> the total rotation in each task (100,),
    in degrees.
    """
    rules = {
        "random choice": random_choice(seed=0),  # any alpha: this race has no obstacle
        "equal angles": equal_angles,
        "least movement": least_movement,
    }
    runs = race(rules, ARM, raced(), np.array([60, 120, 120]) * deg)
    return {name: run.turns / deg for name, run in runs.items()}


def p10() -> dict[str, Any]:
    each = turns()
    fewer = int((each["random choice"] < each["least movement"] - 1e-9).sum())
    dice, equal, least = (float(run.mean()) for run in each.values())
    percent = 100 * (dice / least - 1)
    facts = {"tasks": RACED, "least": least, "added": dice - least, "percent": percent}
    facts |= {
        "twice": 2 * least,
        "wide": float(np.diff(ARM.alpha_range(raced()), axis=0).mean()) / deg,
    }
    facts |= {"times": dice / least, "equal": 100 * (equal / least - 1), "fewer": fewer}
    limits = {"hardly more": 5, "less than twice": 100, "three times": 500, "five times": np.inf}
    return facts | {"right": below(percent, limits)}
