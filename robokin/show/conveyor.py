"""The player of a conveyor, in which several arms pick objects from a belt."""

from collections.abc import Sequence
from itertools import product

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import floats, length, number, short, whole
from ..arms import spbu_arm
from ..jobs.conveyor import ALONG, BIN, GAP, LINKS, WINDOW, Trips, serve, spaced, ways_from
from ..jobs.visit_collect import principal_postures
from ..motion import ptp, quintic
from ..units import mm
from .checks import yes
from .player import Player, animate
from .things import Mark

OBJECTS = 200  # in the stream
PITCH = 1.0  # m, between neighbouring arms
SHOWN = 6.0  # seconds of the motion
SAMPLES = 1201
RADIUS = 22 * mm  # the radius of an object
HANGS = 30 * mm  # the distance from a tool down to the object that it carries
BEFORE, AFTER = 200 * mm, 100 * mm  # how far the drawn belt extends beyond the windows
SLOWEST, FASTEST = 0.02, 0.5  # m/s, of the belt
NARROW, WIDE = 0.1, 0.5  # m, the mean gap; a gap of at most twice WIDE fits on the drawn belt
BUSIEST = 6  # maximum number of arms and of spreads
RULES = ("back soonest", "first come")
EDGE = 60 * mm  # half the width of the belt
STRIP = 40 * mm  # the width of the strip beside a window, and its distance from the belt
SPECK = 1 * mm  # the radius of the ball at a label, which is hardly visible
OVER = 600 * mm  # the height of a count; no part of an arm at work is higher than 500 mm
SQUARE = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])


def conveyor_player(
    v: float = 0.2,
    spreads: ArrayLike = (0.0, 0.5, 1.0),
    arms: int = 3,
    *,
    rules: bool = False,
    bin_place: ArrayLike = BIN,
    gap: float = GAP,
    seed: int = 8,
) -> Player:
    """Show the conveyor of lab 14 for six seconds in the middle of a stream of 200 objects. The
    arms are identical and stand in a row. Each of them picks the object that it can bring to its
    bin soonest.

    v          speed of the belt, 0.02 to 0.5 m/s
    spreads    the values of the slider, two to six increasing fractions from 0 to 1: see `spaced`
    arms       number of arms, one to six
    rules      whether the reader can choose the rule "first come" instead: see `serve`
    bin_place  the place (3,) of the bin, in m: see `ways_from`
    gap, seed  mean gap between two objects, 0.1 to 0.5 m, and the order of the gaps: see `spaced`

    The title asks about the last arm, so its curve is the first one, with the strongest line. The
    numbers above the arms and the curves count the objects brought to the bins since the start
    of the six seconds. A strip along the belt marks each window. Raises ValueError if a number is
    outside these ranges.
    """
    speed, values, count, mean = _checked(v, spreads, arms, gap)
    ways, place = ways_from(bin_place), floats(bin_place, "bin_place")
    stand = principal_postures(*LINKS, place)
    words = RULES if yes(rules, "rules") else RULES[:1]
    lead = (len(words), len(values)) if len(words) > 1 else (len(values),)
    clock = 0.6 * OBJECTS * mean / speed + np.linspace(0, SHOWN, SAMPLES)
    machine = spbu_arm(*LINKS)
    feet = np.stack([np.zeros(count), PITCH * np.arange(count)], axis=-1)
    motions, places, brought = [], [], []
    for word, spread in product(words, values):
        stream = spaced(OBJECTS, mean, float(spread), seed=seed)
        first = word == RULES[1]
        trips = serve(stream, speed, ALONG, ways, arms=count, pitch=PITCH, first_come=first)
        q = [_motion(each, clock, stand) for each in trips]
        tools = [machine.fk(one).translation for one in q]
        held = [tool + [*foot, -HANGS] for tool, foot in zip(tools, feet, strict=True)]
        motions.append(q)
        places.append(_objects(stream, speed, trips, held, clock, (count - 1) * PITCH))
        done = [(clock[:, None] >= each.backs).sum(axis=-1) for each in trips]
        brought.append([each - each[0] for each in done])
    numbers = [one.reshape(*lead, SAMPLES) for one in np.stack(brought, axis=1)]
    moves = [one.reshape(*lead, SAMPLES, -1) for one in np.stack(motions, axis=1)]
    return animate(  # the last arm first: the first arm has the strongest curve
        [machine] * count,
        clock,
        moves[::-1],
        names=[f"arm {k}" for k in range(count, 0, -1)],
        slider=("spread", values),
        switch=("rule", words) if len(words) > 1 else None,
        bases=feet[::-1] if count > 1 else None,
        circles=[(lane.reshape(*lead, SAMPLES, 3), RADIUS) for lane in _lanes(places)],
        faces=_belt(feet) + _boxes(feet, place),
        things=_labels(feet, numbers),
        quantities={"objects brought": numbers[::-1] if count > 1 else numbers[0]},
        title=_title(speed, count),
    )


# --- Private --------------------------------------------------------------------------------------


def _checked(
    v: float, spreads: ArrayLike, arms: int, gap: float
) -> tuple[float, Floats, int, float]:
    """Return the arguments of `conveyor_player`."""
    speed, values = number(v, "v"), floats(spreads, "spreads")
    if not SLOWEST <= speed <= FASTEST:
        raise ValueError(f"v: wanted a speed from {SLOWEST} to {FASTEST} m/s, got {short(v)}")
    inside = values.ndim == 1 and 2 <= len(values) <= BUSIEST
    if not inside or not 0 <= values[0] < values[-1] <= 1 or (np.diff(values) <= 0).any():
        wanted = f"wanted 2 to {BUSIEST} increasing numbers from 0 to 1"
        raise ValueError(f"spreads: {wanted}, got {short(spreads)}")
    mean = length(gap, "gap")
    if not NARROW <= mean <= WIDE:
        raise ValueError(f"gap: wanted {NARROW} to {WIDE} m, got {short(gap)}")
    return speed, values, whole(arms, "arms", 1, BUSIEST), mean


def _title(speed: float, count: int) -> str:
    who = f"arm {count}" if count > 1 else "one arm"
    return f"{speed / mm:.0f} mm/s: how many objects does {who} bring?"


def _motion(trips: Trips, times: Floats, at_bin: Floats) -> Floats:
    """Return the postures (samples, 3) of an arm, which waits at its bin and fetches objects."""
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
    """Return the polygons of the belt, and of a strip in front of it for each window."""
    ends, middle = ALONG[[0, -1]] + feet[:, 1:], WINDOW[0, 0]
    begin = middle + EDGE + STRIP
    belt = middle - EDGE, middle + EDGE, ends.min() - BEFORE, ends.max() + AFTER
    strips = [(begin, begin + STRIP, low, high) for low, high in ends]
    return [
        [[left if x < 0 else right, low if y < 0 else high, 0] for x, y in SQUARE]
        for left, right, low, high in [belt, *strips]
    ]


def _labels(feet: Floats, numbers: Sequence[Floats]) -> list[Mark]:
    """Return the counts, each above its arm, and the names of the windows, each in front of its
    strip. Nothing moves there, so that the labels stay where they are.
    """
    front = WINDOW[0, 0] + EDGE + 5 * STRIP
    counts = [
        Mark([*foot, OVER], f"arm {k + 1}", SPECK, reading)
        for k, (foot, reading) in enumerate(zip(feet, numbers, strict=True))
    ]
    windows = [Mark([front, y, 0], f"window {k + 1}", SPECK) for k, (_, y) in enumerate(feet)]
    return counts + windows


def _boxes(feet: Floats, place: Floats) -> list[list[list[float]]]:
    """Return the polygons of the bins. Each bin has four walls."""
    half, height = 80 * mm, 160 * mm
    return [
        [
            [*(foot + place[:2] + half * corner), z]
            for corner, z in ((a, 0), (b, 0), (b, height), (a, height))
        ]
        for foot in feet
        for a, b in zip(SQUARE, np.roll(SQUARE, -1, axis=0), strict=True)
    ]
