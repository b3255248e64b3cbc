"""The player of a conveyor, in which several arms pick objects from a belt."""

from collections.abc import Sequence
from itertools import product

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import floats, length, short, whole
from ..arms import spbu_arm
from ..jobs.conveyor import ALONG, BIN, GAP, LINKS, WINDOW, Trips, serve, spaced, ways_from
from ..jobs.visit_collect import principal_postures
from ..motion import ptp, quintic
from ..units import deg, mm
from .checks import yes
from .player import Player, animate
from .things import Mark

OBJECTS, BEGIN = 200, 116  # in the stream; about so many have come in when the clock starts
PITCH = 1.0  # m, between neighbouring arms
SHOWN = 6.0  # seconds of the motion
SAMPLES = 1201
RADIUS = 22 * mm  # the radius of an object
HANGS = 30 * mm  # the distance from a tool down to the object that it carries
BEYOND = 200 * mm  # how far the drawn belt extends beyond the windows
SLOWEST, FASTEST = 0.02, 0.5  # m/s, of the belt
NARROW, WIDE = 0.1, 0.5  # m, the mean gap; a gap of at most twice WIDE fits on the drawn belt
BUSIEST = 6  # maximum number of arms, and of values of the slider
RULES = ("back soonest", "first come")
EDGE = 60 * mm  # half the width of the belt
STRIP = 40 * mm  # the width of the strip beside a window, and its distance from the belt
SPECK = 1 * mm  # the radius of the ball at a label, which is hardly visible
OVER = 540 * mm  # the height of a count; no part of an arm at work is higher than 500 mm
VIEW = -30 * deg, 22 * deg  # of the camera: the same for every bin, so that pictures compare
SQUARE = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
# x and y of an arrow on the belt, from its middle: it points in the direction of motion
ARROW = np.array([[-15, -70], [15, -70], [15, 0], [45, 0], [0, 70], [-45, 0], [-15, 0]]) * mm


def conveyor_player(
    v: ArrayLike = 0.2,
    spread: ArrayLike = (0.0, 0.5, 1.0),
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
    spread     a fraction from 0 to 1: see `spaced`. Either `v` or `spread` is a list of two to six
               increasing numbers, the values of the slider; the other one is a number
    arms       number of arms, one to six
    rules      whether the reader can choose the rule "first come" instead: see `serve`
    bin_place  the place (3,) of the bin, in m: see `ways_from`
    gap, seed  mean gap between two objects, 0.1 to 0.5 m, and the order of the gaps: see `spaced`

    The clock starts when about the 116th object reaches the first window. Since then, the numbers
    above the arms and the curves count the objects brought to the bins, and "missed" those that
    have left the last window; such an object has a dot. For several arms, curves also count the
    objects that have left the window of each arm: the last arm's are missed. Its curves come first
    and have the strongest line. A strip along the belt marks each window. An arrow shows where the
    belt moves. If the slider changes the spread, and several arms miss nothing by the first rule,
    the title asks what the last arm brings. Raises ValueError if a number is outside these ranges.
    """
    speeds, shares = _belts(v, spread)
    count, mean = whole(arms, "arms", 1, BUSIEST), length(gap, "gap")
    if not NARROW <= mean <= WIDE:
        raise ValueError(f"gap: wanted {NARROW} to {WIDE} m, got {short(gap)}")
    ways, place = ways_from(bin_place), floats(bin_place, "bin_place")
    stand = principal_postures(*LINKS, place)
    words = RULES if yes(rules, "rules") else RULES[:1]
    values = speeds.size * shares.size
    lead = (len(words), values) if len(words) > 1 else (values,)
    clock = np.linspace(0, SHOWN, SAMPLES)
    machine = spbu_arm(*LINKS)
    feet = np.stack([np.zeros(count), PITCH * np.arange(count)], axis=-1)
    end = float(ALONG[-1] + feet[-1, 1])  # of the last window
    motions, places, passed, counts = [], [], [], []
    for word, speed, share in product(words, speeds.flat, shares.flat):
        stream = spaced(OBJECTS, mean, float(share), seed=seed)
        first = word == RULES[1]
        trips = serve(stream, speed, ALONG, ways, arms=count, pitch=PITCH, first_come=first)
        times = BEGIN * mean / speed + clock
        q = [_motion(each, times, stand) for each in trips]
        tools = [machine.fk(one).translation for one in q]
        held = [tool + [*foot, -HANGS] for tool, foot in zip(tools, feet, strict=True)]
        objects = _objects(stream, speed, trips, held, times, end)
        left, outs = np.arange(OBJECTS), []
        for each, foot in zip(trips, feet, strict=True):
            left = left[~np.isin(left, each.objects)]
            # when the objects that this arm and those before it leave are out of its window
            outs.append((stream[left] + foot[1] + ALONG[-1] - ALONG[0]) / speed)
        lost = np.where(times[:, None] > outs[-1][:, None, None], objects[left], np.nan)
        motions.append(q)
        places.append(_seen(objects))
        passed.append(_seen(lost))
        done = [(times[:, None] >= at).sum(axis=-1) for at in (*(k.backs for k in trips), *outs)]
        counts.append([each - each[0] for each in done])
    sums = [one.reshape(*lead, SAMPLES) for one in np.stack(counts, axis=1)]
    brought, past = sums[:count], sums[count:]
    missed = past[-1]
    moves = [one.reshape(*lead, SAMPLES, -1) for one in np.stack(motions, axis=1)]
    balls, dots = (
        [lane.reshape(*lead, SAMPLES, 3) for lane in _lanes(rows)] for rows in (places, passed)
    )
    # whether the title asks what the last arm brings
    last = count > 1 and not speeds.ndim and not missed[(0,) * (len(words) > 1)].any()
    title = _title(speeds, shares, count, last)
    order = slice(None, None, -1)  # the last arm is the first, so that it has the strongest curves
    curves = {"objects brought": brought[order], "objects that passed the arm": past[order]}
    if count == 1:
        curves = {"objects brought": brought[0], "objects missed": missed}
    if title.endswith("miss?"):
        curves = dict(reversed(curves.items()))  # the first one has the large panel
    return animate(
        [machine] * count,
        clock,
        moves[order],
        names=[f"arm {k + 1}" for k in range(count)][order],
        slider=("belt speed, mm/s", speeds / mm) if speeds.ndim else ("spread", shares),
        switch=("rule", words) if len(words) > 1 else None,
        bases=feet[order] if count > 1 else None,
        circles=[(lane, RADIUS) for lane in balls],
        points=dots,
        faces=_belt(feet) + _boxes(feet, place),
        things=_labels(feet, brought, missed),
        joints=[],
        quantities=curves,
        title=title,
        view=VIEW,
    )


# --- Private --------------------------------------------------------------------------------------


def _belts(v: ArrayLike, spread: ArrayLike) -> tuple[Floats, Floats]:
    """Return the speeds and the spreads; either of them is a list."""
    speeds, shares = floats(v, "v"), floats(spread, "spread")
    for name, values, low, high, unit in (
        ("v", speeds, SLOWEST, FASTEST, " m/s"),
        ("spread", shares, 0, 1, ""),
    ):
        several = values.ndim == 1 and 2 <= len(values) <= BUSIEST and (np.diff(values) > 0).all()
        if values.ndim and not several or values.min() < low or values.max() > high:
            wanted = f"a number from {low} to {high}{unit}, or 2 to {BUSIEST} increasing ones"
            raise ValueError(f"{name}: wanted {wanted}, got {short(values)}")
    if speeds.ndim == shares.ndim:
        both = "two lists" if speeds.ndim else "two numbers"
        raise ValueError(f"v and spread: wanted one number and one list, got {both}")
    return speeds, shares


def _title(speeds: Floats, shares: Floats, count: int, last: bool) -> str:
    given = f"Spread {shares:g}" if speeds.ndim else f"{speeds / mm:.0f} mm/s"
    who = f"do {count} arms" if count > 1 else "does one arm"
    if last:
        who = f"does arm {count}"
    does = "bring" if last or count == 1 and not speeds.ndim else "miss"
    return f"{given}: how many objects {who} {does}?"


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
    end: float,
) -> Floats:
    """Return the places (objects, samples, 3) of the objects, which move with the belt and then
    with a tool. A place is NaN while the object is in a bin or beyond the drawn belt; the last
    window ends at `end`.
    """
    y = ALONG[0] + v * times - stream[:, None]
    place = np.stack([0 * y + WINDOW[0, 0], y, 0 * y + WINDOW[0, 2] - HANGS], axis=-1)
    place[(y < ALONG[0] - BEYOND) | (y > end + BEYOND)] = np.nan
    for each, tool in zip(trips, held, strict=True):
        for i, meets, backs in zip(each.objects, each.meets, each.backs, strict=True):
            place[i, times > meets] = tool[times > meets]
            place[i, times >= backs] = np.nan
    return place


def _seen(places: Floats) -> Floats:
    """Return the objects that are visible at some time."""
    found: Floats = places[np.isfinite(places).any(axis=(1, 2))]
    return found


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
    empty, most = np.full((SAMPLES, 3), np.nan), max(map(len, rows))
    return np.array([[row[k] if k < len(row) else empty for row in rows] for k in range(most)])


def _belt(feet: Floats) -> list[list[list[float]]]:
    """Return the polygons of the belt, of a strip in front of it for each window, and of the arrow
    at its beginning.
    """
    ends, middle = ALONG[[0, -1]] + feet[:, 1:], WINDOW[0, 0]
    begin = middle + EDGE + STRIP
    belt = middle - EDGE, middle + EDGE, ends.min() - BEYOND, ends.max() + BEYOND
    strips = [(begin, begin + STRIP, low, high) for low, high in ends]
    arrow = ARROW + [middle, ends.min() - BEYOND / 2]
    faces = [
        [[left if x < 0 else right, low if y < 0 else high, 0] for x, y in SQUARE]
        for left, right, low, high in [belt, *strips]
    ]
    return [*faces, [[x, y, 0] for x, y in arrow.tolist()]]


def _labels(feet: Floats, brought: Sequence[Floats], missed: Floats) -> list[Mark]:
    """Return the counts, each above its arm, the count of the missed objects beyond the belt, and
    the names of the windows and of their ends, in front of the strips. Nothing moves there, so that
    the labels stay where they are.
    """
    begin, end = ALONG[[0, -1]] + feet[[0, -1], 1]
    counts = [
        Mark([*foot, OVER], f"arm {k + 1}", SPECK, reading)
        for k, (foot, reading) in enumerate(zip(feet, brought, strict=True))
    ]
    lost = Mark([WINDOW[0, 0], end + BEYOND + 2 * STRIP, 0], "missed", SPECK, missed)
    front = WINDOW[0, 0] + EDGE
    names = [f"window {k + 1}" for k in range(len(feet))] if len(feet) > 1 else ["window"]
    places = [(front + 5 * STRIP, y) for y in feet[:, 1]]
    places += [(front + 2.5 * STRIP, y) for y in (begin, end)]
    words = zip([*names, "in", "out"], places, strict=True)
    return [*counts, lost, *(Mark([*place, 0], word, SPECK) for word, place in words)]


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
