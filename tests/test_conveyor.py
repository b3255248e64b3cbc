"""The conveyor: laws that its trips obey, and comparisons with formulas and with a second, simple
program.
"""

from math import acos, asin, atan2, ceil, floor, hypot, sqrt

import numpy as np
import pytest

from robokin import mm
from robokin.jobs.conveyor import serve, spaced
from robokin.jobs.visit_collect import principal_postures, travel_time

GAP, COUNT, SPEED = 150 * mm, 200, 2.0  # m, objects, rad/s
BIN = np.array([150, -450, 250]) * mm
WINDOW = np.linspace(-400, 400, 161) * mm
PLACES = np.stack([0 * WINDOW + 600 * mm, WINDOW, 0 * WINDOW + 50 * mm], axis=-1)
WAYS = (
    15
    / 8
    * travel_time(
        principal_postures(500 * mm, 400 * mm, BIN),
        principal_postures(500 * mm, 400 * mm, PLACES),
        [SPEED] * 3,
    )
)
LINES = [  # spread, belt speed in mm/s, number of arms, metres between them, first come, seed
    (0.0, 120, 1, 1.0, False, 8),
    (0.5, 230, 3, 0.8, False, 8),
    (0.5, 130, 2, 1.0, True, 1),
    (1.0, 230, 3, 1.3, False, 2),
    (1.0, 300, 4, 0.9, True, 3),
]


@pytest.fixture(params=LINES, ids=lambda line: f"spread {line[0]:g}, {line[1]} mm/s, {line[2]}")
def line(request):
    """A line: (offsets, belt speed, metres between arms, trips of each arm, rule)."""
    spread, v, arms, pitch, first_come, seed = request.param
    offsets = spaced(COUNT, GAP, spread, seed=seed)
    trips = serve(offsets, v * mm, WINDOW, WAYS, arms=arms, pitch=pitch, first_come=first_come)
    assert len(trips) == arms and all(len(one.objects) > 5 for one in trips)
    return offsets, v * mm, pitch, trips, first_come


# --- Positions of the objects ---------------------------------------------------------------------


def test_zero_spread_gives_equal_gaps():
    assert np.allclose(spaced(COUNT, GAP), GAP * np.arange(1, COUNT + 1), rtol=1e-12, atol=0)


@pytest.mark.parametrize("spread", [0.25, 0.5, 1.0])
@pytest.mark.parametrize("seed", [0, 8])
def test_spread_is_the_largest_relative_deviation_of_a_gap(spread, seed):
    gaps = np.diff(spaced(COUNT, GAP, spread, seed=seed), prepend=0)
    assert gaps.min() == pytest.approx(GAP * (1 - spread), abs=1e-12)
    assert gaps.max() == pytest.approx(GAP * (1 + spread), abs=1e-12)
    assert gaps.mean() == pytest.approx(GAP, rel=1e-12)
    deviation = spread / sqrt(3) * GAP * sqrt((COUNT + 1) / (COUNT - 1))
    assert gaps.std() == pytest.approx(deviation, rel=1e-9)
    order = np.argsort(np.argsort(gaps))
    assert abs(np.corrcoef(order[1:], order[:-1])[0, 1]) < 0.2  # no gap predicts the next one
    steady = np.diff(spaced(COUNT, GAP, 0.1, seed=seed), prepend=0)
    assert (np.argsort(np.argsort(steady)) == order).all()


def test_different_seeds_give_different_orders():
    assert not np.allclose(spaced(COUNT, GAP, 0.5, seed=1), spaced(COUNT, GAP, 0.5, seed=2))
    assert spaced(1, GAP, 1.0) == pytest.approx([GAP])


# --- Trips of the arms ----------------------------------------------------------------------------


def posture(point):
    """Joint values from the triangle of the levers, computed with `math` alone."""
    x, y, z = point
    l1, l2, rho, d = 0.5, 0.4, hypot(x, y), hypot(x, y, z)
    return (
        atan2(y, x),
        atan2(rho, z) - acos((l1**2 + d**2 - l2**2) / (2 * l1 * d)),
        asin((l1**2 + l2**2 - d**2) / (2 * l1 * l2)),
    )


def seconds(point):
    """The time from the bin to a point: the peak speed of the quintic law is 15/8 of its mean."""
    there = zip(posture(BIN), posture(point), strict=True)
    return 15 / 8 * max(abs(a - b) for a, b in there) / SPEED


def test_objects_are_picked_inside_the_window_of_their_arm(line):
    offsets, v, pitch, trips, _ = line
    for k, one in enumerate(trips):
        # the position to which the belt has carried the object
        y = WINDOW[0] - offsets[one.objects] + v * one.meets
        assert (y >= WINDOW[0] + k * pitch - 1e-9).all()
        assert (y <= WINDOW[-1] + k * pitch + 1e-9).all()
        assert np.allclose(y - k * pitch, WINDOW[one.places], rtol=0, atol=1e-9)


def test_arms_do_not_start_a_trip_before_the_previous_one_ends(line):
    _, _, _, trips, _ = line
    assert max(WAYS) == pytest.approx(seconds(PLACES[-1]))
    for one in trips:
        ways = np.array([seconds(PLACES[j]) for j in one.places])
        assert np.allclose(one.meets - one.leaves, ways, rtol=0, atol=1e-9)
        assert np.allclose(one.backs - one.meets, ways, rtol=0, atol=1e-9)
        assert one.leaves[0] >= 0
        assert (one.leaves[1:] >= one.backs[:-1] - 1e-9).all()
        assert (np.diff(one.meets) >= ways[:-1] + ways[1:] - 1e-9).all()


def test_each_object_is_picked_once_or_missed_by_all_arms(line):
    offsets, v, pitch, trips, first_come = line
    taken = np.concatenate([one.objects for one in trips])
    assert len(set(taken.tolist())) == len(taken) <= COUNT
    more = serve(offsets, v, WINDOW, WAYS, arms=9, pitch=pitch, first_come=first_come)
    assert sorted(np.concatenate([one.objects for one in more]).tolist()) == list(range(COUNT))
    for one, same in zip(trips, more, strict=False):  # an arm is not affected by the arms after it
        assert (one.objects == same.objects).all() and (one.meets == same.meets).all()


def test_next_arm_picks_only_objects_that_have_left_the_previous_window(line):
    """Three arms once shared one clock, and arm 2 picked object 4 while the object was still at arm
    1.
    """
    offsets, v, pitch, trips, _ = line
    for k, one in enumerate(trips[1:], 1):
        left_the_window = (offsets[one.objects] + (k - 1) * pitch + WINDOW[-1] - WINDOW[0]) / v
        assert (one.meets >= left_the_window - 1e-9).all()


def test_larger_distance_between_arms_only_delays_picks(line):
    offsets, v, pitch, trips, first_come = line
    farther = serve(
        offsets, v, WINDOW, WAYS, arms=len(trips), pitch=pitch + 0.6, first_come=first_come
    )
    for k, (one, later) in enumerate(zip(trips, farther, strict=True)):
        assert (one.objects == later.objects).all()
        assert np.allclose(later.meets - one.meets, k * 0.6 / v, rtol=0, atol=1e-9)


def test_greedy_rule_matches_a_brute_force_search(line):
    """The search tries every remaining object and every place for every trip."""
    offsets, v, pitch, trips, first_come = line
    left = list(range(COUNT))
    for k, one in enumerate(trips):
        free = 0.0
        for i, j, meet in zip(one.objects, one.places, one.meets, strict=True):
            best = None
            for n in left:
                at = (offsets[n] + k * pitch + WINDOW - WINDOW[0]) / v
                fit = np.flatnonzero(at - WAYS >= free - 1e-9)
                if len(fit):
                    key = offsets[n] if first_come else at[fit[0]] + WAYS[fit[0]]
                    if best is None or key < best[0]:
                        best = key, n, fit[0], at[fit[0]]
            assert best is not None and best[1:3] == (i, j) and best[3] == pytest.approx(meet)
            free = meet + WAYS[j]
            left.remove(i)
        last = (offsets[left] + k * pitch + WINDOW[:, None] - WINDOW[0]) / v - WAYS[:, None]
        assert (last < free).all()  # the arm stops only when it can reach no other object


def test_arm_with_one_place_picks_every_kth_evenly_spaced_object():
    """An arm whose window is a single place and whose cycle time is c picks every ceil(c v / g)-th
    object.
    """
    for v in (0.05, 0.1, 0.13, 0.29, 0.4):
        (one,) = serve(spaced(COUNT, GAP), v, [0.0], [0.6])
        k = ceil(2 * 0.6 * v / GAP)
        first = ceil(0.6 * v / GAP) - 1  # the first object that the arm can reach in time
        assert one.objects.tolist() == list(range(first, COUNT, k))


@pytest.mark.parametrize("spread", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("first_come", [False, True])
def test_unlimited_window_allows_one_pick_per_cycle(spread, first_come):
    """If every place is w seconds away, v / g objects arrive per second and at most 1 / (2 w) are
    picked.
    """
    way, v = 0.6, 0.4
    assert v / GAP > 1 / (2 * way)  # more objects arrive than the arm can pick
    window = np.linspace(0, 100, 500)
    (one,) = serve(spaced(COUNT, GAP, spread), v, window, 0 * window + way, first_come=first_come)
    assert sorted(one.objects.tolist()) == list(range(COUNT))  # no object leaves the window
    step = (window[1] - window[0]) / v  # objects are picked only at the sampled places
    cycle = np.diff(one.meets)
    assert (cycle >= 2 * way - 1e-9).all() and (cycle[50:] <= 2 * way + step + 1e-9).all()
    slow = 0.1
    assert slow / GAP < 1 / (2 * way)
    (one,) = serve(spaced(COUNT, GAP), slow, window, 0 * window + way, first_come=first_come)
    assert np.allclose(one.meets, GAP * np.arange(1, COUNT + 1) / slow, rtol=1e-12, atol=0)


@pytest.mark.parametrize("seed", range(4))
def test_picking_at_one_place_with_uneven_gaps_matches_a_simple_loop(seed):
    """Objects that arrive while the arm is away are missed."""
    offsets, v, way = spaced(COUNT, GAP, 1.0, seed=seed), 0.2, 0.5
    (one,) = serve(offsets, v, [0.0], [way])
    free, taken = 0.0, []
    for i, at in enumerate((offsets / v).tolist()):
        if at >= free + way:
            taken.append(i)
            free = at + way
    assert one.objects.tolist() == taken and 0.2 < len(taken) / COUNT < 0.9


def test_number_of_arms_needed_is_at_least_the_lower_bound():
    for spread, v in ((0.0, 300), (0.5, 200), (1.0, 250)):
        offsets = spaced(COUNT, GAP, spread) + 1.0
        count = next(
            n
            for n in range(1, 10)
            if sum(len(one.objects) for one in serve(offsets, v * mm, WINDOW, WAYS, arms=n))
            == COUNT
        )
        assert count >= floor(2 * WAYS.min() * v * mm / GAP) + 1
        assert spread or count == 3  # with equal gaps, the rounded-up bound is enough here


def test_uneven_spacing_makes_an_arm_miss_objects():
    """At 120 mm/s one arm picks all evenly spaced objects. The more the gaps differ, the more
    objects it misses.
    """
    lost = [
        np.mean(
            [
                COUNT - len(serve(spaced(COUNT, GAP, x, seed=n), 0.12, WINDOW, WAYS)[0].objects)
                for n in range(5)
            ]
        )
        for x in (0, 0.25, 0.5, 1)
    ]
    assert lost[0] == 0 and all(more > less + 3 for less, more in zip(lost, lost[1:], strict=False))


@pytest.mark.parametrize(
    "change, message",
    [
        (dict(pitch=0.5), "pitch: wanted at least the window's length of 0.8 m, got 0.5 m"),
        (dict(offsets=[0.2, 0.1]), "offsets: wanted 1 to 1000 increasing numbers in m"),
        (dict(ways=WAYS[1:]), "ways: wanted 161 times in s, one for each place of the window"),
        (dict(v=1e-320), "v: wanted a speed at which the objects arrive"),
        (dict(first_come="no"), "first_come: wanted True or False, got 'no'"),
    ],
)
def test_invalid_conveyor_lines_are_refused(change, message):
    with pytest.raises(ValueError, match=message):
        serve(**dict(offsets=[0.1, 0.2], v=0.1, window=WINDOW, ways=WAYS) | change)


def test_invalid_spreads_are_refused():
    for spread in (-0.1, 1.1):
        with pytest.raises(ValueError, match="spread: wanted a fraction from 0 to 1"):
            spaced(COUNT, GAP, spread)
