"""A conveyor: find out which objects on a belt the arms beside it can pick, and when.

The belt runs along y at v (m/s). At time 0 object i is offsets[i] metres before the window of the
first arm, so it reaches the place window[j] at (offsets[i] + window[j] - window[0]) / v. An arm
waits at its bin, moves to a place in its window, picks the object there and takes it to the bin.
Several arms stand along the belt, each with its own window, bin and clock; each can pick only the
objects that the arms before it have left.

    arms = serve(spaced(200, 0.15, spread=0.5), 0.12, window, ways, arms=2)
    len(arms[0].objects)

The document ends with the question whether one robot can pick all objects from a conveyor, but it
gives no numbers. Source: 000, "Заключение".
"""

from dataclasses import dataclass, replace

import numpy as np

from .._arrays import ArrayLike, Floats, Ints, Sealed, frozen
from .._validate import floats, length, number, positive, short, whole
from ..arms.geometry import ROUNDING
from ..units import mm
from .visit_collect import principal_postures, travel_time

# With these limits, every call takes at most a few seconds:
MOST = 1_000  # maximum number of objects on the belt
PLACES = 500  # maximum number of places in a window
ARMS = 100

# The conveyor of lab 14: an arm from the document, with its bin and its window in the coordinates
# of the arm. We chose these numbers; they are not from the document.
LINKS = 500 * mm, 400 * mm
SPEED = 2.0  # rad/s: the speed limit of each joint
BIN: Floats = frozen(np.array([150, -450, 250]) * mm)
ALONG: Floats = frozen(np.linspace(-400, 400, 161) * mm)  # positions along the window
WINDOW: Floats = frozen(np.stack([0 * ALONG + 600 * mm, ALONG, 0 * ALONG + 50 * mm], axis=-1))
GAP = 150 * mm  # the mean gap between two objects


def ways_from(bin_place: ArrayLike = BIN) -> Floats:
    """Return the times (161,), in s, that a move from a bin (3,) to each place of `WINDOW` takes,
    for an arm with `LINKS` and the joint speed limit `SPEED`. The moves follow the quintic law,
    whose greatest speed is 15/8 of the mean speed. Raises ValueError if the arm does not reach the
    bin, or if the bin is on axis 1.
    """
    place = floats(bin_place, "bin_place", 3)
    stand = principal_postures(*LINKS, place)
    if place.ndim != 1 or not np.isfinite(stand).all():
        wanted = "wanted a place (3,) in m that the arm reaches and that is not on axis 1"
        raise ValueError(f"bin_place: {wanted}, got {short(bin_place)}")
    return 15 / 8 * travel_time(stand, principal_postures(*LINKS, WINDOW), [SPEED] * 3)


def spaced(count: int, gap: float, spread: float = 0.0, *, seed: int = 8) -> Floats:
    """The distances of `count` objects from the first window, (count,) in m, increasing.

    The gaps before the objects are equally spaced values from gap (1 - spread) to gap (1 + spread),
    shuffled with `seed`. `spread` is therefore a fraction of the mean gap: 0 gives even spacing, 1
    gives gaps between zero and twice the mean. The mean is exactly `gap`, and the standard
    deviation is gap * spread / sqrt(3) (times sqrt((count + 1) / (count - 1))). For a given seed,
    the gaps have the same order for every spread, so that the points of a curve over `spread` are
    comparable.

    Raises ValueError if `spread` is not from 0 to 1.
    """
    count = whole(count, "count", 1, MOST)
    mean = length(gap, "gap")
    share = number(spread, "spread")
    if not 0 <= share <= 1:
        raise ValueError(f"spread: wanted a fraction from 0 to 1, got {share:g}")
    dice = np.random.default_rng(whole(seed, "seed", 0, 2**63 - 1))
    steps = np.linspace(-1, 1, count) if count > 1 else np.zeros(1)
    offsets: Floats = np.cumsum(mean * (1 + share * dice.permutation(steps)))
    return offsets


@dataclass(frozen=True, eq=False)
class Trips(Sealed):
    """The k trips of one arm, with times in s on the belt's clock.

    objects  (k,) the indices in `offsets` of the objects that it picks
    places   (k,) the indices in the arm's window of the places where it picks them
    leaves   (k,) when it leaves its bin in order to reach the place together with the object
    meets    (k,) when it picks the object
    backs    (k,) when it is back at its bin and free again
    """

    objects: Ints
    places: Ints
    leaves: Floats
    meets: Floats
    backs: Floats


def serve(
    offsets: ArrayLike,
    v: float,
    window: ArrayLike,
    ways: ArrayLike,
    *,
    arms: int = 1,
    pitch: float | None = None,
    first_come: bool = False,
) -> tuple[Trips, ...]:
    """The trips of each arm along the belt.

    offsets     (n,) in m, increasing: distances before the first arm's window at time 0
    v           speed of the belt, m/s
    window      (m,) in m, increasing: the places along y where the first arm can pick an object
    ways        (m,) in s: the time from the arm's bin to each place; the way back takes as long
    arms        the number of equal arms along the belt, `pitch` metres apart
    pitch       at least the window's length (the default), so that no two windows overlap
    first_come  the rule to use. A free arm picks the object that it can bring back soonest or, with
                `first_come`, the first object on the belt that it can still reach. It picks an
                object at the first place where it can be in time.

    Both rules are greedy and may pick fewer objects than possible. The arm stands still while it
    grips, which takes no time. Raises ValueError if a shape is wrong or numbers do not increase.
    """
    reach = _rising(offsets, "offsets", MOST)
    speed = positive(v, "v", "one positive speed in m/s")
    along = _rising(window, "window", PLACES)
    times = floats(ways, "ways")
    if times.shape != along.shape or (times < 0).any():
        wanted = f"{len(along)} times in s, one for each place of the window, none negative"
        raise ValueError(f"ways: wanted {wanted}, got {short(ways)}")
    span = float(along[-1] - along[0])
    apart = span if pitch is None else number(pitch, "pitch")
    if apart < span * (1 - ROUNDING):
        wanted = f"wanted at least the window's length of {span:g} m"
        raise ValueError(f"pitch: {wanted}, got {apart:g} m")
    if not isinstance(first_come, (bool, np.bool_)):
        raise ValueError(f"first_come: wanted True or False, got {short(first_come)}")
    with np.errstate(over="ignore"):
        delays, last = (along - along[0]) / speed, (reach[-1] + ARMS * apart) / speed
    if not np.isfinite([*delays, last]).all():
        raise ValueError(
            f"v: wanted a speed at which the objects arrive in finite time, got {speed:g} m/s"
        )
    left, done = np.arange(len(reach)), []
    for k in range(whole(arms, "arms", 1, ARMS)):
        trips = _trips((reach[left] + k * apart) / speed, delays, times, bool(first_come))
        done.append(replace(trips, objects=frozen(left[trips.objects])))
        left = np.delete(left, trips.objects)
    return tuple(done)


# --- Private --------------------------------------------------------------------------------------


def _trips(arrivals: Floats, delays: Floats, ways: Floats, first_come: bool) -> Trips:
    """The trips of one arm.

    arrivals  (n,) when the objects reach its window
    delays    (m,) how much later they reach each place
    """
    free, trips, left = 0.0, [], np.ones(len(arrivals), dtype=bool)
    slack = (delays - ways).max()  # an object can be picked if free <= arrival + slack
    while True:
        # Objects before `low` have passed. Only the first of the objects that the arm can pick at
        # the first place is compared: those behind it would be picked there too, but later.
        low = np.searchsorted(arrivals, free - slack - 1e-9)  # 1e-9 s exceeds rounding errors
        high = np.searchsorted(arrivals, free + ways[0]) + 1
        found = low + np.flatnonzero(left[low:high])
        at = arrivals[found, None] + delays
        in_time = at >= free + ways
        can = in_time.any(axis=-1)
        if not can.any():
            break
        found, place = found[can], in_time[can].argmax(axis=-1)
        meet = at[can, place]
        back = meet + ways[place]
        pick = 0 if first_come else int(back.argmin())
        j = int(place[pick])
        trips.append((found[pick], j, meet[pick] - ways[j], meet[pick], back[pick]))
        left[found[pick]] = False
        free = float(back[pick])
    columns = np.array(trips, dtype=float).reshape(-1, 5).T
    objects, places = columns[:2].astype(int)
    return Trips(frozen(objects), frozen(places), *(frozen(times) for times in columns[2:]))


def _rising(values: ArrayLike, name: str, most: int) -> Floats:
    array = floats(values, name)
    if array.ndim != 1 or not 1 <= len(array) <= most or (np.diff(array) < 0).any():
        raise ValueError(f"{name}: wanted 1 to {most} increasing numbers in m, got {short(values)}")
    return array
