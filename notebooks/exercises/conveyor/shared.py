"""Code that exercises and predictions of this lab share."""

from collections.abc import Mapping
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robokin import mm
from robokin.jobs.conveyor import ALONG, GAP, serve, spaced, ways_from

Floats = NDArray[np.float64]
COUNT = 200  # objects in a stream
HEIGHT = 250 * mm  # of a bin
STEP = 5  # mm/s


def taken(
    v: float,
    spread: float,
    ways: Floats,
    *,
    gap: float = GAP,
    arms: int = 1,
    seed: int = 8,
    first_come: bool = False,
) -> int:
    """How many objects of a stream the arms take; v in m/s."""
    stream = spaced(COUNT, gap, spread, seed=seed)
    trips = serve(stream, v, ALONG, ways, arms=arms, first_come=first_come)
    return sum(len(each.objects) for each in trips)


@cache
def ways(place: tuple[float, float]) -> Floats:
    """The time of one way from a bin to each place of the window."""
    return ways_from([*place, HEIGHT])


def missed(
    numbers: Mapping[str, Any], place: tuple[float, float], arms: int, *, first_come: bool = False
) -> list[int]:
    """How many objects of each stream these arms miss."""
    v, gap, spread = (float(numbers[name]) for name in ("v", "gap", "spread"))
    times, take = ways(place), partial(taken, gap=gap, arms=arms, first_come=first_come)
    return [COUNT - take(v, spread, times, seed=seed) for seed in numbers["seeds"]]


def none_missed(numbers: Mapping[str, Any], place: tuple[float, float], arms: int) -> bool:
    return not any(missed(numbers, place, arms))


def is_last(
    numbers: Mapping[str, Any],
    place: tuple[float, float],
    v: int,
    arms: int = 1,
    *,
    first_come: bool = False,
) -> bool:
    """Whether these arms miss nothing at v mm/s, but something at the next step."""
    now, then = (
        any(missed(at_speed(numbers, each), place, arms, first_come=first_come))
        for each in (v, v + STEP)
    )
    return then and not now


def at_speed(numbers: Mapping[str, Any], v: int) -> dict[str, Any]:
    """The same belt at another speed, in mm/s."""
    return dict(numbers) | {"v": v * mm}
