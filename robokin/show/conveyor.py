"""The player of a conveyor, in which several arms pick objects from a belt."""

from collections.abc import Sequence

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import floats, number, short, whole
from ..arms import spbu_arm
from ..jobs.conveyor import ALONG, BIN, GAP, LINKS, WINDOW, Trips, serve, spaced, ways_from
from ..jobs.visit_collect import principal_postures
from ..motion import ptp, quintic
from ..units import mm
from .player import Player, animate

OBJECTS = 200  # in the stream
PITCH = 1.0  # m, between neighbouring arms
SHOWN = 6.0  # seconds of the motion
SAMPLES = 1201
RADIUS = 22 * mm  # the radius of an object
HANGS = 30 * mm  # the distance from a tool down to the object that it carries
BEFORE, AFTER = 200 * mm, 100 * mm  # how far the drawn belt extends beyond the windows
SLOWEST, FASTEST = 0.02, 0.5  # m/s, of the belt
BUSIEST = 6  # maximum number of arms and of spreads
SQUARE = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])


def conveyor_player(v: float = 0.2, spreads: ArrayLike = (0.0, 0.5, 1.0), arms: int = 3) -> Player:
    """Show the conveyor of lab 14 for six seconds in the middle of a stream of 200 objects. The
    arms are identical and stand in a row. Each of them picks the object that it can bring to its
    bin soonest.

    v        speed of the belt, 0.02 to 0.5 m/s
    spreads  the values of the slider, two to six increasing fractions from 0 to 1: see `spaced`
    arms     number of arms, two to six

    The numbers next to the arms and the curves count the objects brought to the bins since the
    start of the six seconds. Lines across the belt mark where each window begins and ends. Raises
    ValueError if a number is outside these ranges.
    """
    speed, values = number(v, "v"), floats(spreads, "spreads")
    if not SLOWEST <= speed <= FASTEST:
        raise ValueError(f"v: wanted a speed from {SLOWEST} to {FASTEST} m/s, got {short(v)}")
    inside = values.ndim == 1 and 2 <= len(values) <= BUSIEST and 0 <= values[0] < values[-1] <= 1
    if not inside or (np.diff(values) <= 0).any():
        wanted = f"wanted 2 to {BUSIEST} increasing numbers from 0 to 1"
        raise ValueError(f"spreads: {wanted}, got {short(spreads)}")
    count = whole(arms, "arms", 2, BUSIEST)
    clock = 0.6 * OBJECTS * GAP / speed + np.linspace(0, SHOWN, SAMPLES)
    machine = spbu_arm(*LINKS)
    feet = np.stack([np.zeros(count), PITCH * np.arange(count)], axis=-1)
    motions, places, brought = [], [], []
    for spread in values:
        stream = spaced(OBJECTS, GAP, float(spread))
        trips = serve(stream, speed, ALONG, ways_from(), arms=count, pitch=PITCH)
        q = [_motion(each, clock) for each in trips]
        tools = [machine.fk(one).translation for one in q]
        held = [tool + [*foot, -HANGS] for tool, foot in zip(tools, feet, strict=True)]
        motions.append(q)
        places.append(_objects(stream, speed, trips, held, clock, (count - 1) * PITCH))
        done = [(clock[:, None] >= each.backs).sum(axis=-1) for each in trips]
        brought.append([each - each[0] for each in done])
    names = [f"arm {k + 1}" for k in range(count)]
    numbers = dict(zip(names, np.stack(brought, axis=1), strict=True))
    return animate(
        [machine] * count,
        clock,
        list(np.stack(motions, axis=1)),
        names=names,
        slider=("spread", values),
        bases=feet,
        points={name: [1.05, y, 0] for name, (_, y) in zip(names, feet, strict=True)},
        readings=numbers,
        circles=[(lane, RADIUS) for lane in _lanes(places)],
        faces=_belt(feet) + _boxes(feet),
        quantities={"objects brought": list(numbers.values())},
        title=f"{speed / mm:.0f} mm/s: which spread gives arm {count} work to do?",
    )


# --- Private --------------------------------------------------------------------------------------


def _motion(trips: Trips, times: Floats) -> Floats:
    """Return the postures (samples, 3) of an arm, which waits at its bin and fetches objects."""
    at_bin = principal_postures(*LINKS, BIN)
    there = principal_postures(*LINKS, WINDOW[trips.places])
    when = np.stack([trips.leaves, trips.meets, trips.backs], axis=-1).ravel()
    stands = np.stack([0 * there + at_bin, there, 0 * there + at_bin], axis=1).reshape(-1, 3)
    when = np.concatenate([[0.0], when, [np.inf]])
    stands = np.concatenate([[at_bin], stands, [at_bin]])
    leg = np.searchsorted(when, times, side="right") - 1
    share = (times - when[leg]) / (when[leg + 1] - when[leg])
    return ptp(stands[leg], stands[leg + 1], quintic(1.0)(share))


def _objects(
    stream: Floats,
    v: float,
    trips: Sequence[Trips],
    held: Sequence[Floats],
    times: Floats,
    more: float,
) -> Floats:
    """Return the places (objects, samples, 3) of the visible objects, which move with the belt and
    then with a tool. A place is NaN while the object is in a bin or beyond the drawn belt, which is
    `more` metres longer than for one arm.
    """
    y = ALONG[0] + v * times - stream[:, None]
    place = np.stack([0 * y + WINDOW[0, 0], y, 0 * y + WINDOW[0, 2] - HANGS], axis=-1)
    place[(y < ALONG[0] - BEFORE) | (y > ALONG[-1] + more + AFTER)] = np.nan
    for each, tool in zip(trips, held, strict=True):
        for i, meets, backs in zip(each.objects, each.meets, each.backs, strict=True):
            place[i, times > meets] = tool[times > meets]
            place[i, times >= backs] = np.nan
    seen: Floats = place[np.isfinite(place).any(axis=(1, 2))]
    return seen


def _lanes(places: Sequence[Floats]) -> Floats:
    """Combine the places of objects that are visible at different times into lanes. Return an array
    (lanes, motions, samples, 3).
    """
    rows: list[list[Floats]] = []
    for objects in places:
        lanes: list[Floats] = []
        for one in objects:
            there = np.isfinite(one[:, 0])
            # leave a few samples empty between two objects of a lane, so that none seems to jump
            near = np.convolve(there, np.ones(9), "same") > 0
            free = (k for k, lane in enumerate(lanes) if not np.isfinite(lane[near, 0]).any())
            k = next(free, len(lanes))
            if k == len(lanes):
                lanes.append(np.full_like(one, np.nan))
            lanes[k][there] = one[there]
        rows.append(lanes)
    empty = np.full_like(places[0][0], np.nan)
    most = max(map(len, rows))
    return np.array([[row[k] if k < len(row) else empty for row in rows] for k in range(most)])


def _belt(feet: Floats) -> list[list[list[float]]]:
    """Return the polygons of the belt: the windows and the parts between them."""
    ends = (ALONG[[0, -1]] + feet[:, 1:]).ravel()
    cuts = [ends[0] - BEFORE, *ends, ends[-1] + AFTER]
    middle, half = WINDOW[0, 0], 60 * mm
    return [
        [[middle + half * x, low if y < 0 else high, 0] for x, y in SQUARE]
        for low, high in zip(cuts, cuts[1:], strict=False)
    ]


def _boxes(feet: Floats) -> list[list[list[float]]]:
    """Return the polygons of the bins. Each bin has four walls."""
    half, height = 80 * mm, 160 * mm
    return [
        [
            [*(foot + BIN[:2] + half * corner), z]
            for corner, z in ((a, 0), (b, 0), (b, height), (a, height))
        ]
        for foot in feet
        for a, b in zip(SQUARE, np.roll(SQUARE, -1, axis=0), strict=True)
    ]
