"""The facts behind the predictions. p9 was first asked in the lab on visiting and collecting."""

from collections.abc import Mapping
from functools import cache
from math import ceil, floor
from typing import Any

import numpy as np

from robokin import mm
from robokin.jobs.conveyor import ALONG, GAP, serve, spaced, ways_from

from .shared import COUNT, taken

MOST_ARMS = 8
SPEEDS = list(range(60, 141, 5))  # mm/s


def p1() -> dict[str, Any]:
    v, c = 250 * mm, 2 * float(ways_from().min())
    load = c * v / GAP
    return {
        "v": v / mm,
        "gap": GAP / mm,
        "c": c,
        "rate": v / GAP,
        "one": 1 / c,
        "served": floor(load) / c,
        "load": load,
        "inverse": 1 / load,
        "mixed": load / mm,
        "twice": ceil(2 * load),
        "up": ceil(load),
        "down": floor(load),
        "right": "rounded up",
    }


@cache
def p2() -> Mapping[str, Any]:
    """What one arm takes by both rules, and the mean time of an object."""
    v, spread, facts = 150 * mm, 0.5, {}
    for name, first_come in (("first", True), ("soon", False)):
        stream = spaced(COUNT, GAP, spread)
        (trips,) = serve(stream, v, ALONG, ways_from(), first_come=first_come)
        facts[name] = float(len(trips.objects))
        facts[f"{name}_cost"] = 2 * float(ways_from()[trips.places].mean())
    share = facts["soon"] / facts["first"]
    more = "twice" if share > 2 else "a few more"
    return {
        "v": v / mm,
        "least": (1 - spread) * GAP / mm,
        "most": (1 + spread) * GAP / mm,
        **facts,
        "first": int(facts["first"]),
        "soon": int(facts["soon"]),
        "right": more if share > 1.02 else "as many" if share > 0.98 else "first come more",
    }


def missed(v: float, spread: float = 0.5, seed: int = 8, first_come: bool = False) -> int:
    """How many of the objects one arm misses, at v mm/s."""
    return COUNT - taken(v * mm, spread, ways_from(), seed=seed, first_come=first_come)


def speed(lost: list[int]) -> int:
    """The greatest speed up to which no object is lost."""
    return SPEEDS[int(np.flatnonzero(np.cumsum(lost) == 0)[-1])]


@cache
def p3() -> Mapping[str, Any]:
    """What each arm of a line takes of evenly spaced objects, and the mean time of an object."""
    v, c = 200 * mm, 2 * float(ways_from().min())
    lines = {}
    for first_come in (False, True):
        found = serve(
            spaced(COUNT, GAP), v, ALONG, ways_from(), arms=MOST_ARMS, first_come=first_come
        )
        lines[first_come] = [each for each in found if len(each.objects)]
    takes = [len(each.objects) for each in lines[True]]
    costs = [2 * float(ways_from()[each.places].mean()) for each in lines[True]]
    least, arms = len(lines[False]), len(takes)
    return {
        "gap": GAP / mm,
        "v": v / mm,
        "load": c * v / GAP,
        "c": c,
        "period": GAP / v,
        "least": least,
        "one_more": least + 1,
        "arms": arms,
        "takes": takes,
        "gets": [COUNT - sum(takes[:k]) for k in range(arms)],
        "costs": costs,
        "soonest": [len(each.objects) for each in lines[False]],
        "missed_by_two": COUNT - sum(takes[:2]),
        "missed_by_three": COUNT - sum(takes[:3]),
        **dict(zip(("first_cost", "second_cost", "third_cost", "last_cost"), costs, strict=False)),
        "right": ("the bound", "one more", "two more")[arms - least],
    }


@cache
def p9() -> Mapping[str, Any]:
    lost = {
        "uneven": [missed(v) for v in SPEEDS],
        "even": [missed(v, spread=0) for v in SPEEDS],
        "first": [missed(v, first_come=True) for v in SPEEDS],
    }
    most = {name: speed(counts) for name, counts in lost.items()}
    others = [speed([missed(v, seed=seed) for v in SPEEDS]) for seed in (9, 10)]
    share = most["uneven"] / most["even"]
    fast = "more" if share > 1.02 else "the average counts"
    slow = "about three quarters" if share > 0.6 else "half, by the least gap"
    return {
        **most,
        "least": min(most["uneven"], *others),
        "greatest": max(most["uneven"], *others),
        "half": round(most["even"] / 2),
        "rule": float(GAP / (2 * ways_from().min()) / mm),
        "lost": lost,
        "fast": SPEEDS[-1],
        "even_fast": lost["even"][-1],
        "uneven_fast": lost["uneven"][-1],
        "at_even": lost["uneven"][SPEEDS.index(most["even"])],
        "right": fast if share > 0.95 else slow,
    }
