"""Code that exercises and predictions of this lab share."""

import numpy as np
from numpy.typing import NDArray

from robokin.jobs.conveyor import ALONG, GAP, serve, spaced

Floats = NDArray[np.float64]
COUNT = 200  # objects in a stream


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
