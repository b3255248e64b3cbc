"""Exercise 1: a student's own belt, and the mistakes in its bin and in the number of its arms."""

from collections.abc import Mapping, Sequence
from functools import cache
from itertools import product
from math import ceil, floor
from typing import Any

import numpy as np

from robokin import mm
from robokin.course.exercises import in_words
from robokin.course.told import floats, one_number
from robokin.course.variants import Numbers, dice
from robokin.jobs.conveyor import BIN

from .shared import COUNT as OBJECTS
from .shared import STEP, at_speed, is_last, missed, none_missed, ways

COUNT = 7
SPEED_KEY = "one_arm_speed"
KEYS = ("bin", "least", "missed", "arms", SPEED_KEY, "first_come_in", "first_come_out")
LOW, HIGH = np.array([[150, -450], [350, 450]]) * mm  # where the bin may stand: x and y
CORNER = (350 * mm, -450 * mm)  # the least time of one object
MOST_ARMS = 12
Fault = tuple[str, str]
# the bin, the bound, what so few arms miss, the arms, the speed up to which one arm misses nothing,
# and what the arms miss under "first come" with the bin at each end of the window
Line = tuple[tuple[float, float], int, int, int, int, tuple[int, int]]


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
    if isinstance(answer, Mapping) and set(answer) == set(KEYS) - {SPEED_KEY}:
        wanted = f'also wanted "{SPEED_KEY}", the belt speed in mm/s up to which one arm with your'
        raise ValueError(f"{wanted} bin misses none, got an answer without it")
    if isinstance(answer, Mapping) and "first_come" in answer and KEYS[-1] not in answer:
        wanted = '"first_come_in" and "first_come_out", whole numbers for the bin at y = −0.45 m'
        raise ValueError(f'wanted {wanted} and at y = 0.45 m, got "first_come"')
    if not isinstance(answer, Mapping) or not set(KEYS) <= set(answer):
        names = ", ".join(f'"{key}"' for key in KEYS[1:])
        wanted = f'wanted "bin": [x, y] in m, and a whole number for each of {names}'
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
            wanted = "a whole number" + " of mm/s" * (key == SPEED_KEY)
            raise ValueError(f"{key}: wanted {wanted}, got {in_words(answer[key])}")
        counts.append(int(value))
    least, lost, arms, speed, near, far = counts
    return (float(place[0]), float(place[1])), least, lost, arms, speed, (near, far)


def faults(line: Line, numbers: Any) -> list[Fault]:
    place, least, told, arms, speed, told_first = line
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
        found.append(slip(least, list(bound.items()), "another bound"))
    # a student with a wrong bound may have counted what that many arms miss
    served = least if 1 <= least <= MOST_ARMS else bound["the bound"]
    lost = missed(numbers, place, served)
    if told not in (sum(lost), sum(missed(numbers, place, bound["the bound"]))):
        slips = [("one stream of three", lost[0]), ("taken for missed", 3 * OBJECTS - sum(lost))]
        found.append(slip(told, slips, "another number of missed objects"))
    most = int(numbers["most"])
    if not 1 <= arms <= MOST_ARMS:
        says = f"Wanted 1 to {MOST_ARMS} arms, got {arms}."
        found.append(("no number of arms for a line", says))
    else:
        lost = missed(numbers, place, arms)
        if any(lost):
            name = "the bound is not enough" if arms == bound["the bound"] else "too few arms"
            many = "one arm" if arms == 1 else f"{arms} arms"
            k = lost.index(max(lost))
            some = f"{lost[k]} object{'s' * (lost[k] > 1)} of the stream with seed"
            says = f"With this bin, {many} miss{'es' * (arms == 1)} {some} {numbers['seeds'][k]}."
            found.append((name, says))
        # a student with too few arms may have counted with enough of them
        enough = next((n for n in range(arms, MOST_ARMS) if none_missed(numbers, place, n)), arms)
        if told_first != first_come_missed(numbers, place, enough) and (
            fault := first_come_slips(numbers, place, served, arms, told_first)
        ):
            found.append(fault)
    if fault := speed_slips(numbers, place, arms, speed):
        found.append(fault)
    if arms > most:
        says = (
            f"You may use {most} arms at most. Try other places for the bin, also nearer to the "
            "belt: a small c is not enough if the way to the rest of the window is long."
        )
        if none_missed(numbers, place, most):
            says = "With this bin, fewer arms already miss none: try count_missed with fewer arms."
        found.append(("more arms than allowed", says))
    if len(found) > 1 and (other := other_bin(line, numbers)):
        says = f"The counts and the speed fit the bin [{other[0]:g}, {other[1]:g}] instead. "
        says += "You may have changed the bin and not the numbers."
        return [("the numbers of another bin", says.replace("-", "−"))] * len(found)
    return found


def other_bin(line: Line, numbers: Any) -> tuple[float, float] | None:
    """A bin at an end of the window, or the lab's, that these numbers fit instead."""
    place, least, told, arms, speed, told_first = line
    if not 1 <= arms <= MOST_ARMS:
        return None
    for x, y in product((place[0], LOW[0], HIGH[0]), (LOW[1], HIGH[1])):
        other = float(x), float(y)
        if (
            np.abs(np.subtract(other, place)).max() > mm
            and least == bounds(other, numbers)["the bound"]
            and told == sum(missed(numbers, other, least))
            and is_last(numbers, other, speed)
            and told_first == first_come_missed(numbers, other, arms)
        ):
            return other
    return None


def speed_slips(
    numbers: Mapping[str, Any], place: tuple[float, float], arms: int, told: int
) -> Fault | None:
    """The mistake in the speed up to which one arm misses nothing."""
    if told < STEP or told % STEP:
        name = "another speed of one arm"
        return name, f"{SPEED_KEY}: Wanted a multiple of {STEP} mm/s, got {told}."
    if is_last(numbers, place, told):
        return None
    average = float(numbers["gap"]) / (2 * ways(place).min()) / mm
    streams = [dict(numbers) | {"seeds": [seed]} for seed in numbers["seeds"]]
    slips = {
        "only the average": told == floor(average / STEP) * STEP,
        "the first speed with a miss": told > STEP and is_last(numbers, place, told - STEP),
        "the speed of one stream": any(is_last(each, place, told) for each in streams),
        "the speed of all arms": 1 < arms <= MOST_ARMS and is_last(numbers, place, told, arms),
        "the speed under first come": is_last(numbers, place, told, first_come=True),
        "the bin of the lab": is_last(numbers, (float(BIN[0]), float(BIN[1])), told),
        "the speed of the belt": told == round(float(numbers["v"]) / mm),
    }
    names = [name for name, holds in slips.items() if holds]
    lost = sum(missed(at_speed(numbers, told), place, 1))
    says = [f"At {told} mm/s, one arm with your bin misses {lost} of the 600 objects."]
    if not lost:
        says = [f"At {told + STEP} mm/s, one arm with your bin misses none, either."]
    if names:
        says.append(" Or: ".join(SPEED_WHY[name] for name in names))
    return " or ".join(names) or "another speed of one arm", f"{SPEED_KEY}: {' '.join(says)}"


def first_come_slips(
    numbers: Mapping[str, Any],
    place: tuple[float, float],
    served: int,
    arms: int,
    told: tuple[int, int],
) -> Fault | None:
    """The mistake in what so many arms miss under "first come" with the bin at each end."""
    stands = ends(place)
    late = [missed(numbers, end, arms, first_come=True) for end in stands]
    right = sum(late[0]), sum(late[1])
    if told == right:
        return None
    if told == right[::-1]:
        return "the two ends swapped", WHY["the two ends swapped"]
    k = 0 if told[0] != right[0] else 1  # the first wrong number
    slips = [
        ("back soonest instead of first come", sum(missed(numbers, stands[k], arms))),
        *(
            (
                "first come by another number of arms",
                sum(missed(numbers, stands[k], n, first_come=True)),
            )
            for n in sorted({*range(1, int(numbers["most"]) + 2), served} - {arms})
        ),
        ("first come, one stream of three", late[k][0]),
        ("first come, taken for missed", 3 * OBJECTS - right[k]),
        (
            "your own bin instead of one at the end",
            sum(missed(numbers, place, arms, first_come=True)),
        ),
    ]
    name, says = slip(told[k], slips, "another number under first come")
    return name, f"{KEYS[k - 2]}: {says}"


def first_come_missed(
    numbers: Mapping[str, Any], place: tuple[float, float], arms: int
) -> tuple[int, int]:
    """What so many arms miss under "first come" with the bin at each end."""
    near, far = (sum(missed(numbers, end, arms, first_come=True)) for end in ends(place))
    return near, far


def ends(place: tuple[float, float]) -> list[tuple[float, float]]:
    """The places of the bin at the ends of the window: where the objects come in, and the other."""
    return [(place[0], float(y)) for y in (LOW[1], HIGH[1])]


def holds(line: Line, numbers: Any) -> list[str]:
    """Sentences for an answer that passes: what its numbers show."""
    place, least, lost, arms, speed, (near, far) = line
    enough = "not enough" if lost else "enough"
    mean = float(numbers["gap"]) / (2 * ways(place).min()) / mm
    says = [
        f"With your bin, the bound of {least} is {enough} for these three streams.",
        f"One arm misses none up to {speed} mm/s. The average alone would allow {mean:.0f} mm/s, "
        "where c v / g = 1.",
    ]
    if near > far:
        says.append(
            f"Under first come, {arms} arms miss {near} objects with the bin where the objects "
            f"come in, and {far} with the bin at the other end. At the first end, a late arm makes "
            "a longer trip and is later still; at the other end, its trip is shorter."
        )
    elif near == far == 0:
        c = 2 * ways(ends(place)[0]).min()
        load = c * float(numbers["v"]) / float(numbers["gap"])
        says.append(
            f"Under first come, too, {arms} arms miss none, with the bin at either end: here the "
            "load is too small for the rule to matter. With the bin at an end, c v / g is only "
            f"{load:.2f}, so the {arms} arms have enough idle time: a late arm is soon on time "
            "again."
        )
    return says


def slip(told: int, slips: Sequence[tuple[str, int]], otherwise: str) -> Fault:
    """Name every mistake that gives this number."""
    names = list(dict.fromkeys(name for name, number in slips if number == told)) or [otherwise]
    first, *others = (WHY[name] for name in names)
    says = [first, *(f"Or: {why}" for why in others)]
    if others:
        says.insert(0, f"More than one mistake gives {told}.")
    return " or ".join(names), " ".join(says)


SPEED_WHY = {
    "only the average": "At this speed, c v / g is 1, or a little less: you looked only at the "
    "average, and unevenly spaced objects need a slower belt.",
    "the speed of one stream": "So fast a belt suits one of your three streams. The arm must miss "
    "none of all three.",
    "the first speed with a miss": "Give the last speed without a miss, one step less.",
    "the speed of all arms": "That is the speed for your `arms` arms. Find the speed for one arm.",
    "the speed under first come": "That is the speed under first come.",
    "the bin of the lab": "That is the speed with the bin of this lab.",
    "the speed of the belt": "That is the speed of your belt. Find the speed for one arm.",
}
WHY = {
    "rounded down": "You rounded the bound down. So few arms do not have enough time for all "
    "the objects.",
    "the time of one way": "You used the time of one way. c is the time there and back.",
    "the bin of the lab": "You used c of the lab's bin. Your bin has a different c.",
    "the mean over the window": "You used the mean over the window. That is not a bound, because "
    "the arms may take most objects near the bin. Use the least time.",
    "one stream of three": "That is what the arms miss of the first stream. Add the other two.",
    "taken for missed": "So many of the 600 objects are taken. Give the number that is missed.",
    "another number of missed objects": "missed: let `least` arms serve each of your three "
    "streams by the rule back soonest, and add up what they miss.",
    "back soonest instead of first come": "So many are missed under back soonest. "
    "Call count_missed with first_come=True.",
    "first come by another number of arms": "So many are missed under first come by another "
    "number of arms. Give what `arms` arms miss.",
    "first come, one stream of three": "That is what your arms miss of the first stream under "
    "first come. Add the other two.",
    "first come, taken for missed": "So many of the 600 objects are taken under first come. Give "
    "the number that is missed.",
    "the two ends swapped": "You swapped first_come_in and first_come_out: the objects come "
    "in at y = −0.45 m.",
    "your own bin instead of one at the end": "So many are missed with your own bin. Call "
    "count_missed with the bin at this end, and your x.",
    "another number under first come": "Let `arms` arms, the same number as before, "
    "serve your three streams under first come with the bin at this end, and add up what they "
    "miss.",
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
        "the time of one way": ceil(c.min() / 2 * per_second),
    }
