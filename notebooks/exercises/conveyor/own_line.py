"""Exercise 1: a student's own belt, and the mistakes in its bin and in the number of its arms."""

from collections.abc import Mapping
from functools import cache
from math import ceil, floor
from typing import Any

import numpy as np

from robokin import mm
from robokin.course.exercises import in_words
from robokin.course.told import floats, one_number
from robokin.course.variants import Numbers, dice
from robokin.jobs.conveyor import BIN, ways_from

from .shared import COUNT as OBJECTS
from .shared import Floats, taken

COUNT = 5
KEYS = ("bin", "least", "missed", "arms")
LOW, HIGH = np.array([[150, -450], [350, 450]]) * mm  # where the bin may stand: x and y
HEIGHT = 250 * mm
CORNER = (350 * mm, -450 * mm)  # the least time of one object
MOST_ARMS = 12
# A rounding error can decide which of two objects an arm takes; from then on it takes others.
ROUNDED = 0.2
Fault = tuple[str, str]
# the bin, the bound, what so few arms miss, the arms
Line = tuple[tuple[float, float], int, int, int]


@cache
def ways(place: tuple[float, float]) -> Floats:
    """The time of one way from a bin to each place of the window."""
    return ways_from([*place, HEIGHT])


def missed(numbers: Mapping[str, Any], place: tuple[float, float], arms: int) -> list[int]:
    """How many objects of each stream these arms miss."""
    v, gap, spread = (float(numbers[name]) for name in ("v", "gap", "spread"))
    return [
        OBJECTS - taken(v, spread, ways(place), gap=gap, arms=arms, seed=seed)
        for seed in numbers["seeds"]
    ]


def none_missed(numbers: Mapping[str, Any], place: tuple[float, float], arms: int) -> bool:
    return not any(missed(numbers, place, arms))


def needed(numbers: Mapping[str, Any], place: tuple[float, float]) -> int:
    """The least number of arms that miss nothing."""
    return next(n for n in range(1, MOST_ARMS) if none_missed(numbers, place, n))


@cache
def given(who: Any) -> Numbers:
    """A belt for which the bound is too small, even with the best bin, and a number of arms that is
    too small with the bin of the lab.
    """
    roll = dice("conveyor", who)
    while True:
        values: dict[str, Any] = {
            "v": roll.randrange(200, 310, 10) * mm,
            "gap": roll.randrange(130, 180, 10) * mm,
            "spread": roll.randrange(40, 95, 5) / 100,
            "seeds": sorted(roll.sample(range(100), 3)),
        }
        most = needed(values, CORNER)
        enough = bounds(CORNER, values)["the bound"] == most
        if not enough and not none_missed(values, (float(BIN[0]), float(BIN[1])), most):
            break
    units = {"v": ("mm/s", mm), "gap": ("mm", mm), "most": ("arms", 1.0)}
    return Numbers(values | {"most": most}, units)


def form(answer: Any, numbers: Any) -> Line:
    if not isinstance(answer, Mapping) or not set(KEYS) <= set(answer):
        wanted = 'wanted {"bin": [x, y] in m} and whole numbers for "least", "missed" and "arms"'
        raise ValueError(f"{wanted}, got {in_words(answer)}")
    try:
        place = floats(answer["bin"])
    except (TypeError, ValueError):
        place = np.empty(0)
    if place.shape != (2,) or not np.isfinite(place).all():
        raise ValueError(f"bin: wanted x and y in m, got {in_words(answer['bin'])}")
    counts = []
    for key in KEYS[1:]:
        try:
            value = one_number(answer[key])
        except (TypeError, ValueError):
            value = float("nan")
        if not 0 <= value <= 1000 or value % 1:
            raise ValueError(f"{key}: wanted a whole number, got {in_words(answer[key])}")
        counts.append(int(value))
    return (float(place[0]), float(place[1])), counts[0], counts[1], counts[2]


def faults(line: Line, numbers: Any) -> list[Fault]:
    place, least, told, arms = line
    if (np.array(place) < LOW - 1e-9).any() or (np.array(place) > HIGH + 1e-9).any():
        name = "millimetres for metres" if max(map(abs, place)) > 2 else "the bin is somewhere else"
        says = (
            "The bin must be at x from 150 to 350 mm and y from −450 to 450 mm. Give both "
            "numbers in metres. Nothing else was checked."
        )
        return [(name, says)] * COUNT
    found = []
    bound = bounds(place, numbers)
    if least != bound["the bound"]:
        name = next((each for each, n in bound.items() if n == least), "another bound")
        found.append((name, WHY.get(name, WHY["another bound"])))
    lost = missed(numbers, place, bound["the bound"])
    if abs(told - sum(lost)) > ROUNDED * sum(lost):
        slips = {lost[0]: "one stream of three", 3 * OBJECTS - sum(lost): "taken for missed"}
        name = slips.get(told, "another number of missed objects")
        found.append((name, WHY[name]))
    most = int(numbers["most"])
    if arms < 1 or arms > MOST_ARMS or not none_missed(numbers, place, arms):
        too_few = 1 <= arms <= MOST_ARMS
        name = "the bound is not enough" if arms == bound["the bound"] else "too few arms"
        many = "one arm" if arms == 1 else f"{arms} arms"
        says = f"With {many} and this bin, some objects of a stream are missed."
        if not too_few:
            says = f"Wanted 1 to {MOST_ARMS} arms, got {arms}."
        found.append((name if too_few else "no number of arms for a line", says))
    if arms > most:
        says = f"You may use {most} arms at most. A bin with a smaller c usually needs fewer."
        found.append(("more arms than allowed", says))
    return found


WHY = {
    "rounded down": "You rounded the bound down. So few arms do not have enough time for all "
    "the objects.",
    "there without back": "You used the time of one way. c is the time there and back.",
    "the bin of the lab": "You used c of the lab's bin. Your bin has a different c.",
    "the mean over the window": "You used the mean over the window. That is not a bound, because "
    "the arms may take most objects near the bin. Use the least time.",
    "one stream of three": "That is what the arms miss of the first stream. Add the other two.",
    "taken for missed": "So many of the 600 objects are taken. Give the number that is missed.",
    "another number of missed objects": "Let as many arms as the bound for your bin serve each of "
    "your three streams, and add up what they miss.",
    "another bound": "The bound is c v / g, rounded up: c is 2 ways_from([x, y, 0.25]).min() for "
    "your bin, and g is the mean gap.",
}


def bounds(place: tuple[float, float], numbers: Mapping[str, Any]) -> dict[str, int]:
    """The bound, and the numbers that mistakes give."""
    per_second = float(numbers["v"]) / float(numbers["gap"])
    c = 2 * ways(place)
    lab = 2 * ways((float(BIN[0]), float(BIN[1])))
    return {
        "the bound": ceil(c.min() * per_second - 1e-9),
        "rounded down": floor(c.min() * per_second),
        "the bin of the lab": ceil(lab.min() * per_second),
        "the mean over the window": ceil(c.mean() * per_second),
        "there without back": ceil(c.min() / 2 * per_second),
    }
