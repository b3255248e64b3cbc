"""A conveyor: which objects on a belt the arms beside it can take, and when.

The belt runs along y at v (m/s). At the time 0 object i lies offsets[i] metres before the window of
the first arm: so it is at the place window[j] at (offsets[i] + window[j] - window[0]) / v. An arm
waits at its bin, goes to a place of its window, meets the object there and takes it back. Arms
stand one after the other, each with a window, a bin and a clock of its own, and each sees only what
those before it have left.

    arms = serve(spaced(200, 0.15, spread=0.5), 0.12, window, ways, arms=2)
    len(arms[0].objects)

The document ends with the question, whether one robot can take all objects from a conveyor, and
gives no numbers. Source: 000, "Заключение".
"""

from dataclasses import dataclass, replace

import numpy as np

from .._arrays import ArrayLike, Floats, Ints, frozen
from .._validate import floats, length, number, positive, short, whole
from ..arms.geometry import ROUNDING

# So that no call takes more than some seconds:
MOST = 1_000  # objects
PLACES = 500  # of a window
ARMS = 100


def spaced(count: int, gap: float, spread: float = 0.0, *, seed: int = 8) -> Floats:
    """How far before the first window `count` objects lie, (count,) in m, rising.

    The gaps before the objects go in equal steps from gap (1 - spread) to gap (1 + spread), each
    once, and are shuffled; `seed` says how. So `spread` is a share of the mean gap, from 0, evenly
    spaced, to 1, gaps between none and twice the mean; the mean is `gap` exactly, and the standard
    deviation spread / sqrt(3) of it (times sqrt((count + 1) / (count - 1))). One seed gives one
    order of the gaps for every spread, so that curves over `spread` compare like with like.

    ValueError: a spread that is not from 0 to 1.
    """
    count = whole(count, "count", 1, MOST)
    mean = length(gap, "gap")
    share = number(spread, "spread")
    if not 0 <= share <= 1:
        raise ValueError(f"spread: wanted a share from 0 to 1, got {share:g}")
    dice = np.random.default_rng(whole(seed, "seed", 0, 2**63 - 1))
    steps = np.linspace(-1, 1, count) if count > 1 else np.zeros(1)
    offsets: Floats = np.cumsum(mean * (1 + share * dice.permutation(steps)))
    return offsets


@dataclass(frozen=True, eq=False)
class Trips:
    """What one arm does, trip after trip; k trips, times in s on the clock of the belt.

    objects  (k,) which objects it takes: their numbers in `offsets`
    places   (k,) where it meets them: their numbers in the arm's window
    leaves   (k,) when it leaves its bin: so that it is at the place when the object is
    meets    (k,) when it takes the object
    backs    (k,) when it is back at its bin, and its own clock lets it go again
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

    offsets     (n,) in m, rising: how far before the first arm's window the objects lie at time 0
    v           speed of the belt, m/s
    window      (m,) in m, rising: the places along y where the first arm can meet an object
    ways        (m,) in s: how long the arm's way from its bin to each of them takes, and back again
    arms        how many stand along the belt, `pitch` metres apart, equal to the first
    pitch       at least the length of the window (None: that), so that no two windows overlap
    first_come  the rule. A free arm takes the object with which it is back soonest, or, if
                `first_come`, the first on the belt that it can still meet. It meets an object at
                the first place where it can be in time.

    The rules are greedy: they need not take as many objects as can be taken. The arm stands still
    while it grips, and that takes no time. ValueError: wrong shapes, numbers that do not rise.
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
        raise ValueError(f"pitch: wanted at least the window's {span:g} m, got {apart:g} m")
    if not isinstance(first_come, (bool, np.bool_)):
        raise ValueError(f"first_come: wanted True or False, got {short(first_come)}")
    with np.errstate(over="ignore"):
        delays, last = (along - along[0]) / speed, (reach[-1] + ARMS * apart) / speed
    if not np.isfinite([*delays, last]).all():
        raise ValueError(f"v: wanted a speed at which the objects come, got {speed:g} m/s")
    left, done = np.arange(len(reach)), []
    for k in range(whole(arms, "arms", 1, ARMS)):
        trips = _trips((reach[left] + k * apart) / speed, delays, times, bool(first_come))
        done.append(replace(trips, objects=frozen(left[trips.objects])))
        left = np.delete(left, trips.objects)
    return tuple(done)


# --- Private --------------------------------------------------------------------------------------


def _trips(arrivals: Floats, delays: Floats, ways: Floats, first_come: bool) -> Trips:
    """The trips of one arm.

    arrivals  (n,) when the objects come to its window;  delays  (m,) how much later they are at
    each place
    """
    free, trips, left = 0.0, [], np.ones(len(arrivals), dtype=bool)
    slack = (delays - ways).max()  # an object can be met if free <= arrival + slack
    while True:
        # Those before `low` are past. Those behind the first that comes to the window no sooner
        # than the arm can be there are met at its first place too, only later.
        low = np.searchsorted(arrivals, free - slack - 1e-9)  # s, more than rounding
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
        raise ValueError(f"{name}: wanted 1 to {most} rising numbers in m, got {short(values)}")
    return array
