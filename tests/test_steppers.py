"""Pulses, frequencies, pulse trains and phases of the log loader's motors, and the response of
their rotors (003, II.3, paper 1; errata S3-s, S3-t).
"""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from machines import oracle
from scipy.integrate import quad, solve_ivp
from scipy.optimize import linprog
from scipy.special import ellipk

from robokin import SCARA, deg, loader_arm, three_lever
from robokin.jobs.steppers import (
    COLUMNS,
    FASTEST,
    LIMIT,
    Move,
    Stepper,
    counts,
    energised,
    frequencies,
    joint_values,
    out_of_reach,
    phases,
    ramp,
    shortest_turn,
    station_postures,
    straight,
    synchronised,
    unsynchronised,
)

CASES = [case for case in oracle("loader_arm")["cases"] if case["reachable"]]
ARM = loader_arm(1.2, 1.0)
PER_DEGREE = np.array([10.0, 20.0, 20.0])
B = ((1.3, -0.9, 1.2), (-0.1, -0.2, 0.9))  # a straight path, and no motor reverses
C = ((1.2, -1.0, 0.3), (0.4, 1.2, 0.3))  # a straight path on which two motors reverse
RANDOM = np.random.default_rng(8).integers(-3000, 3000, (40, 2, 3))
PAIRS = [
    *RANDOM,
    np.array([(0, 0, 0), (1000, 500, 250)]),
    np.array([(7, 7, 7), (7, 7, 7)]),
    np.array([(0, 0, 0), (-1, 1999, 0)]),
    np.array([(5, -4, 3), (4, -4, 3)]),
]


def moves():
    for start, goal in PAIRS:
        yield "synchronised", synchronised(start, goal)
        yield "unsynchronised", unsynchronised(start, goal)
    for points in (B, C):
        yield "straight", straight(ARM, *points, PER_DEGREE)
    rng = np.random.default_rng(9)
    for _ in range(20):  # the points are above the hole around joint 2
        start, goal = rng.uniform((-1.1, -1.1, 0.5), (1.1, 1.1, 1.2), (2, 3))
        yield "straight", straight(ARM, start, goal, PER_DEGREE)


MOVES = list(moves())
every_move = pytest.mark.parametrize(
    "kind, move", MOVES, ids=[f"{i}-{kind}" for i, (kind, _) in enumerate(MOVES)]
)


# ---- whole pulses


def test_rounding_errors_do_not_add_up_over_10_000_moves():
    rng = np.random.default_rng(1)
    q = rng.uniform(-np.pi, np.pi, (10_001, 3))
    per_degree = np.array([10 / 3, 7.77, 0.1])
    pulses = np.diff(counts(q, per_degree), axis=0)
    assert pulses.dtype.kind == "i"
    exact = (q - q[0]) / deg * per_degree
    # the error is at most half a pulse at the start and half a pulse at the station
    assert abs(np.cumsum(pulses, axis=0) - exact[1:]).max() <= 1
    there_and_back = np.tile([[0.0], [1 / 3 * deg]], (5000, 1))
    assert np.diff(counts(there_and_back, 1.3), axis=0).sum() == 0
    # each move is 0.37 pulses, which alone would round to 0
    steps = np.arange(10_001)[:, None] * 0.037 * deg
    assert np.diff(counts(steps, 10.0), axis=0).sum() == 3700


def test_counts_and_joint_values_are_inverses():
    n = np.random.default_rng(2).integers(-7000, 7000, (50, 3))
    assert (counts(joint_values(n, PER_DEGREE), PER_DEGREE) == n).all()
    assert counts([90 * deg], 10.0).tolist() == [900]
    assert joint_values([900, -900], [10, 20]).tolist() == [90 * deg, -45 * deg]
    q = np.random.default_rng(3).uniform(-3, 3, (50, 3))
    half = 0.5 / PER_DEGREE * deg
    assert (abs(joint_values(counts(q, PER_DEGREE), PER_DEGREE) - q) <= half + 1e-12).all()


def test_positions_too_large_for_exact_floats_are_refused():
    assert counts([4.0], [2**52 / (4 / deg)]).tolist() == [2**52]
    for q, per_degree in (([4.0], [2**53 / (4 / deg)]), ([1.0], [1e300]), ([-4.0], [1e17])):
        with pytest.raises(ValueError, match=r"q: wanted at most 2\*\*52 pulses"):
            counts(q, per_degree)
    with (
        pytest.warns(UserWarning, match="degrees"),
        pytest.raises(ValueError, match="5.7.*21"),
    ):
        counts([1e17], [1e3])
    with pytest.raises(ValueError, match="positions / per_degree: .*inf"):
        joint_values([1e300], 1e-300)


def test_angles_in_degrees_cause_a_warning():
    with pytest.warns(UserWarning, match="q: 120 rad .*degrees") as caught:
        assert counts([100.0, 110.0, 120.0], 1.0).shape == (3,)
    assert caught[0].filename == __file__


# ---- frequencies


@pytest.mark.parametrize("case", CASES, ids=[str(i) for i in range(len(CASES))])
def test_frequencies_and_times_match_the_reference_cases(case):
    assert frequencies(case["pulses"]) == pytest.approx(case["frequencies"], rel=1e-12)
    move = synchronised(np.zeros(3), case["pulses"])
    assert move.duration == pytest.approx(case["time"], rel=1e-12)
    assert move.frequencies[0] == pytest.approx(case["frequencies"], rel=1e-12)


@pytest.mark.parametrize(
    "phi", [(1000, 500, 250), (3, 3, 3), (1, 1999, 77), (0, 400, 100), (0, 0, 9)]
)
def test_frequencies_solve_the_corrected_linear_program(phi):
    p1, p2, p3 = phi
    same_time = [[p2, -p1, 0], [p3, 0, -p1], [0, p3, -p2]]  # omega1 phi2 = omega2 phi1, and so on
    best = linprog(-np.array(phi, float), A_eq=same_time, b_eq=[0, 0, 0], bounds=[(0, LIMIT)] * 3)
    assert best.success
    moving = np.array(phi) > 0
    assert frequencies(phi)[moving] == pytest.approx(best.x[moving], rel=1e-6)
    assert (frequencies(phi)[~moving] == 0).all()


def test_the_printed_conditions_make_the_motor_with_the_most_pulses_the_slowest():
    phi = np.array([1000.0, 500, 250])
    printed = linprog(
        -phi, A_eq=[[1000, -500, 0], [1000, 0, -250]], b_eq=[0, 0], bounds=[(0, LIMIT)] * 3
    ).x
    assert printed == pytest.approx([125, 250, 500]) and phi / printed == pytest.approx([8, 2, 0.5])
    assert frequencies(phi) == pytest.approx([500, 250, 125]) and phi / frequencies(
        phi
    ) == pytest.approx([2, 2, 2])


def test_frequencies_accept_a_batch_and_motors_at_rest():
    batch = frequencies([[[100, -50]], [[0, 0]]], limit=200)
    assert batch.tolist() == [[[200, 100]], [[0, 0]]]


# ---- moves and their pulse trains


@every_move
def test_pulses_add_up_to_the_move(kind, move):
    wanted = move.positions[-1] - move.positions[0]
    for (times, signs), n in zip(move.pulses(), wanted, strict=True):
        assert signs.sum() == n and len(times) == len(signs)
        assert (np.diff(times) > 0).all()
        if kind != "straight":
            assert len(times) == abs(n)


@every_move
def test_the_frequency_limit_is_respected(kind, move):
    for times, _ in move.pulses():
        assert (np.diff(times) >= (1 - 1e-6) / LIMIT).all()
        # the limit also applies from one move to the next
        assert (times >= (1 - 1e-6) / LIMIT).all()
    if len(move.t) > 1:
        # in every move the fastest motor reaches the limit
        assert abs(move.frequencies).max(axis=-1) == pytest.approx(LIMIT)


@every_move
def test_motors_lag_by_less_than_a_pulse(kind, move):
    for (times, signs), due in zip(move.pulses(), move.positions.T, strict=True):
        t = np.linspace(0, move.duration, 997)
        stands = (
            due[0]
            + np.concatenate([[0], np.cumsum(signs)])[
                np.searchsorted(times, t + 1e-9, side="right")
            ]
        )
        assert abs(stands - np.interp(t, move.t, due)).max() < 1 + 1e-5
        assert stands[-1] == due[-1]


@pytest.mark.parametrize("start, goal", PAIRS)
def test_synchronised_motors_start_and_stop_together_within_one_pulse(start, goal):
    move = synchronised(start, goal)
    for (times, _), rate in zip(
        move.pulses(), abs(move.frequencies).T if len(move.t) > 1 else (), strict=False
    ):
        if len(times):
            assert times[0] <= (1 + 1e-9) / rate[0]
            assert times[-1] == pytest.approx(move.duration, rel=1e-12)


@pytest.mark.parametrize("start, goal", PAIRS)
def test_unsynchronised_motors_stop_one_after_another(start, goal):
    move, together = unsynchronised(start, goal), synchronised(start, goal)
    for (times, _), n in zip(move.pulses(), abs(goal - start), strict=True):
        if n:
            assert times[0] == pytest.approx(1 / LIMIT) and times[-1] == pytest.approx(n / LIMIT)
    assert move.duration == pytest.approx(together.duration)
    assert (
        (move.positions[-1] == goal).all()
        and (move(1e9) == goal).all()
        and (move(-1) == start).all()
    )


@pytest.mark.parametrize("points", [B, C])
def test_only_the_straight_move_stays_on_the_line(points):
    n = counts(station_postures(ARM, points), PER_DEGREE)
    b = straight(ARM, *points, PER_DEGREE)
    a, d = unsynchronised(*n), synchronised(*n)
    assert (b.positions[0] == n[0]).all() and (b.positions[-1] == n[1]).all()
    off = {}
    for name, move in (("a", a), ("b", b), ("d", d)):
        path = ARM.fk(
            joint_values(move(np.linspace(0, move.duration, 400)), PER_DEGREE)
        ).translation
        way = np.subtract(points[1], points[0]) / np.linalg.norm(np.subtract(points[1], points[0]))
        across = np.cross(path - points[0], way)
        off[name] = np.linalg.norm(across, axis=1).max()
        assert np.linalg.norm(path[-1] - points[1]) < 2e-3
    step = 3 * 0.5 * (1 / PER_DEGREE).max() * deg * 2.2  # half a pulse of all motors, at full reach
    assert off["b"] < step < min(off["a"], off["d"]) / 5
    assert b.duration >= d.duration - 1e-12  # no move within the frequency limit is faster than d


def test_motors_reverse_in_move_c_but_not_in_move_b():
    for points, turning in ((B, [0, 0, 0]), (C, [0, 1, 1])):
        trains = straight(ARM, *points, PER_DEGREE).pulses()
        assert [(np.diff(signs) != 0).sum() for _, signs in trains] == turning
        made, needed = sum(len(t) for t, _ in trains), sum(abs(s.sum()) for _, s in trains)
        assert (made > needed) == any(turning)


def test_pulses_follow_a_motor_that_reverses_repeatedly():
    t = np.array([0, 1, 2, 3, 4, 5, 6, 7.0])
    due = np.array([0, 2.6, 2.6, 2.4, 3.2, -0.5, -0.5, 0])
    times, signs = Move(t, due[:, None]).pulses()[0]
    assert signs.tolist() == [1, 1, 1, -1, -1, -1]
    assert times == pytest.approx(
        [1 / 2.6, 2 / 2.6, 3 + 0.6 / 0.8, 4 + 1.2 / 3.7, 4 + 2.2 / 3.7, 4 + 3.2 / 3.7]
    )


def test_a_line_that_leaves_the_workspace_is_refused():
    with pytest.raises(ValueError, match=r"too near to joint 2"):
        straight(ARM, (1.2, 0, 0.1), (-1.2, 0.1, 0.1), PER_DEGREE)
    with pytest.raises(ValueError, match=r"100% of its length the point is under the floor"):
        straight(ARM, (1.2, 0, 0.5), (1.2, 0.1, -0.1), PER_DEGREE)
    with pytest.raises(ValueError, match=r"beyond the reach of the arm"):
        straight(ARM, (1.2, 0, 0.5), (3, 0.1, 0.5), PER_DEGREE)
    with pytest.raises(ValueError, match=r" 0% of its length the point is under the floor"):
        straight(ARM, (1.2, 0, -1e-6), (1.2, 0.1, 0.5), PER_DEGREE)


def test_idle_motors_do_not_prolong_a_move():
    for move in (synchronised([5, -4], [5, -4]), unsynchronised([5, -4], [5, -4])):
        assert move.duration == 0 and move.positions.tolist() == [[5, -4]]
        assert move.frequencies.shape == (0, 2) and move([0, 1]).tolist() == [[5, -4]] * 2
        assert [len(times) for times, _ in move.pulses()] == [0, 0]
    point = straight(ARM, B[0], B[0], PER_DEGREE)
    assert [len(times) for times, _ in point.pulses()] == [0, 0, 0]


@pytest.mark.parametrize("limit", [100.0, 250, 1e6])
def test_frequency_limit_can_be_set(limit):
    start, goal = np.array([3, 0, -2]), np.array([1003, -400, -2])
    assert synchronised(start, goal, limit).duration == pytest.approx(1000 / limit)
    each = unsynchronised(start, goal, limit)
    assert each.t == pytest.approx([0, 400 / limit, 1000 / limit])
    assert each.positions.tolist() == [[3, 0, -2], [403, -400, -2], [1003, -400, -2]]
    assert abs(straight(ARM, *B, PER_DEGREE, limit).frequencies).max() == pytest.approx(limit)


# ---- the data of a move


def test_moves_are_read_only_data():
    t, positions = np.array([0.0, 1, 3]), np.array([(0, 5), (2.5, 5), (4, 5)])
    move = Move(t, positions)
    assert move.duration == 3 and move.frequencies.tolist() == [[2.5, 0], [0.75, 0]]
    assert move([[-1, 0], [0.4, 9]]).tolist() == [[[0, 5], [0, 5]], [[1, 5], [4, 5]]]
    t[:], positions[:] = 9, 9
    assert move.t.tolist() == [0, 1, 3] and move.positions[0].tolist() == [0, 5]
    for array in (move.t, move.positions):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1
    for name in ("t", "positions", "duration"):
        with pytest.raises(AttributeError):
            setattr(move, name, None)
    assert Move([0], [[1.0]]).duration == 0


@pytest.mark.parametrize(
    "t, positions, complaint",
    [
        ([], np.empty((0, 2)), "t: wanted times that increase from 0"),
        (0.0, [[1]], "t: wanted times that increase from 0"),
        ([1, 2], [[0], [1]], r"t: wanted times that increase from 0, got \[1.0, 2.0\]"),
        ([-1, 0], [[0], [1]], "t: wanted times that increase from 0"),
        ([0, 1, 1], [[0], [1], [2]], "t: wanted times that increase from 0"),
        ([0, 2, 1], [[0], [1], [2]], "t: wanted times that increase from 0"),
        ([[0, 1]], [[0], [1]], "t: wanted times that increase from 0"),
        ([0, np.nan], [[0], [1]], "t: wanted finite"),
        ([0, np.inf], [[0], [1]], "t: wanted finite"),
        ("ab", [[0], [1]], "t: wanted numbers"),
        ([0, 1], [0, 1], r"positions: wanted shape \(2, motors\), got \(2,\)"),
        ([0, 1], [[0], [1], [2]], r"positions: wanted shape \(2, motors\), got \(3, 1\)"),
        ([0, 1], np.empty((2, 0)), r"positions: wanted shape \(2, motors\), got \(2, 0\)"),
        ([0, 1], [[0], [np.nan]], "positions: wanted finite"),
        ([0, 1], [[0], [0.5]], "first and last of positions: wanted whole pulses"),
        ([0, 1], [[0.5], [0]], "first and last of positions: wanted whole pulses"),
        ([0, 1, 2], [[0], [2.0**53], [0]], r"positions: wanted at most 2\*\*52"),
        ([0, 1], None, "positions: wanted numbers"),
    ],
)
def test_invalid_moves_are_refused(t, positions, complaint):
    with pytest.raises(ValueError, match=complaint):
        Move(t, positions)


def test_too_many_pulses_are_refused():
    far = synchronised([0, 0], [10_000_000, 1])
    with pytest.raises(ValueError, match="at most 10000000 pulses in 100000 .* got 10000001 in 1"):
        far.pulses()
    assert synchronised([0], [9_999]).pulses()[0][1].sum() == 9_999
    t = np.arange(100_002.0)
    with pytest.raises(ValueError, match="got 100001 in 100001"):
        Move(t, t[:, None]).pulses()
    assert len(Move(t[:-1], t[:-1, None]).pulses()[0][0]) == 100_000


def test_invalid_arguments_are_refused():
    table, nan = phases("wave", "bipolar"), np.nan
    for call, complaint in (
        (lambda: synchronised([0, 0], [1, 2, 3]), "one position for each motor"),
        (lambda: synchronised([], []), "one position for each motor"),
        (lambda: synchronised([[0]], [[1]]), "one position for each motor"),
        (lambda: synchronised([0.5], [1]), r"start: wanted whole pulses.*\[0.5\]"),
        (lambda: synchronised([0], [1.5]), r"goal: wanted whole pulses.*\[1.5\]"),
        (lambda: synchronised([0], [2**60]), r"goal: wanted at most 2\*\*52 pulses"),
        (lambda: synchronised([0], None), "goal: wanted numbers"),
        (lambda: synchronised([0], [1], 5e-324), "pulses / limit: .*inf"),
        (lambda: unsynchronised([0], [1], limit=0), "positive number of pulses per second"),
        (lambda: unsynchronised([0], [1], limit=[1, 2]), "limit: wanted one positive number"),
        (lambda: unsynchronised([0], [1], limit="a"), "limit: wanted numbers"),
        (lambda: counts([1.0], -3), "positive numbers of pulses"),
        (lambda: counts([1.0], [3, 0]), r"per_degree: .*\[3.0, 0.0\]"),
        (lambda: counts([1.0], [[3]]), "per_degree: .*one for each motor"),
        (lambda: counts([nan], 3), "finite"),
        (lambda: counts([1.0, 2.0], [1, 2, 3]), "do not fit"),
        (lambda: joint_values([1.0, 2.0], [1, 2, 3]), "do not fit"),
        (lambda: shortest_turn([1.0, 2.0], [1, 2, 3]), "do not fit"),
        (lambda: frequencies(3.0), "one number for each motor"),
        (lambda: frequencies([[], []]), r"one number for each motor.*\(2, 0\)"),
        (lambda: frequencies([1], 0), "limit: wanted one positive number"),
        (lambda: straight(ARM, [B[0]] * 2, B[1], PER_DEGREE), r"start: wanted a single .*\(2, 3\)"),
        (lambda: straight(ARM, *B, 1e300), r"per_degree: wanted at most 2\*\*52"),
        (lambda: out_of_reach(ARM, [B[0]] * 2), r"point: wanted a single point \(3,\)"),
        (lambda: phases("full", "bipolar"), "drive: wanted one of"),
        (lambda: phases([], "bipolar"), "drive: wanted one of"),
        (lambda: phases("wave", "tripolar"), "motor: wanted one of"),
        (lambda: phases("wave", None), "motor: wanted one of"),
        (lambda: phases("wave", "unipolar", 2), "windings: wanted a whole number from 3 to 6"),
        (lambda: phases("wave", "bipolar", 7), "windings: wanted a whole number from 2 to 6"),
        (lambda: energised(table, [1, 0]), r"\+1 and -1"),
        (lambda: Stepper("passive", "bipolar", 3), "motor: wanted 'unipolar' for a passive rotor"),
        (lambda: Stepper(rotor="iron"), "rotor: wanted one of"),
        (lambda: Stepper(windings=2), "windings: wanted"),
        (lambda: Stepper(inertia=0), "inertia: wanted one positive number"),
        (lambda: Stepper(rise=-1e-3), "rise: wanted a number that is not negative"),
        (lambda: Stepper().run([2, 1], [1, 1]), "times and signs: .* never decreasing"),
        (lambda: Stepper().run([-1], [1]), "times and signs: wanted times .* at least 0"),
        (lambda: Stepper().run([1, 2], [1]), "as many signs"),
        (lambda: Stepper().run([1], [0.5]), r"\+1 and -1"),
        (lambda: Stepper().run([1e4], [1]), "times: wanted a run of at most 100000 steps"),
        (
            lambda: Stepper().run([1], [1], load_inertia=-1),
            "load_inertia: wanted a number that is not negative",
        ),
        (lambda: Stepper().run([1], [1], load=1e300), "load: wanted a value that turns"),
        (lambda: ramp(0, 10, 20, 1), "pulses: wanted a whole number from 1 to"),
        (lambda: ramp(5, 30, 20, 1), "start and end: wanted start <= end, got 30 and 20"),
        (lambda: ramp(5, 10, 20, -1), "seconds: wanted a number that is not negative"),
        (lambda: energised(table, [[1]]), r"\+1 and -1"),
        (lambda: energised(table, [1], row=1.5), "row: wanted a whole number.*1.5"),
        (lambda: energised(table, [1], row=True), "row: wanted a whole number.*True"),
        (lambda: energised([], [1]), "table: wanted rows"),
        (lambda: energised([[]] * 0, [1]), "table: wanted rows"),
        (lambda: energised([1, 0], [1]), r"table: wanted rows.*\(2,\)"),
        (lambda: energised(None, [1]), "table: wanted numbers"),
    ):
        with pytest.raises(ValueError, match=complaint) as caught:
            call()
        assert len(str(caught.value)) < 200
    for arm in (None, 3, SCARA, three_lever(1), ARM.geometry):
        with pytest.raises(TypeError, match="arm: wanted .*a loader_arm"):
            straight(arm, *B, PER_DEGREE)


# ---- phases


def printed(text):
    """A table of the document: True where it contains a +."""
    return np.array([[mark == "+" for mark in line] for line in text.split()])


def test_phases_match_both_tables_of_the_document():
    assert (phases("wave", "unipolar") == printed("+... .+.. ..+. ...+")).all()
    bipolar = phases("two-phase", "bipolar")
    assert ((bipolar == 1) == printed("+.+. .++. .+.+ +..+")).all()
    # each + has a - at the other end of the winding
    assert (bipolar == -1).sum(axis=1).tolist() == [2, 2, 2, 2]


@pytest.mark.parametrize("motor", COLUMNS)
@pytest.mark.parametrize(
    "drive, angle, windings", [("wave", 90, {1}), ("two-phase", 90, {2}), ("half-step", 45, {1, 2})]
)
def test_the_field_advances_by_equal_angles(motor, drive, angle, windings):
    table = phases(drive, motor)
    # Unipolar: four half windings a quarter of a turn apart, in the order of table 1. Bipolar: two
    # windings at right angles, with the current from the positive end to the negative one.
    places = np.exp(1j * np.array([0, 90, 180, 270]) * deg)
    if motor == "unipolar":
        assert set(table.ravel()) == {0, 1} and set(table.sum(axis=1)) == windings
        field = table @ places
    else:
        assert (table[:, 0] == -table[:, 1]).all() and (table[:, 2] == -table[:, 3]).all()
        assert set(abs(table[:, ::2]).sum(axis=1)) == windings
        field = table[:, 0] * places[0] + table[:, 2] * places[1]
    turn = np.angle(np.roll(field, -1) / field) / deg
    assert turn == pytest.approx(angle) and len(table) == 360 / angle
    assert abs(field) == pytest.approx(
        np.sqrt(abs(table).sum(axis=1) / (2 if motor == "bipolar" else 1))
    )


def test_fields_cancel_in_table_2_with_the_names_of_table_1():
    places = np.exp(1j * np.array([0, 90, 180, 270]) * deg)
    field = printed("+.+. .++. .+.+ +..+") @ places
    # in rows 1 and 3, a1 cancels a2 or b1 cancels b2
    assert abs(field) == pytest.approx([0, np.sqrt(2), 0, np.sqrt(2)])


def test_the_order_of_the_rows_determines_the_direction():
    table = phases("wave", "unipolar")
    assert (energised(table, [1, 1, 1, 1]) == table[[0, 1, 2, 3, 0]]).all()
    assert (energised(table, [-1, -1, 1]) == table[[0, 3, 2, 3]]).all()
    assert (energised(table, [1], row=3) == table[[3, 0]]).all()
    assert (energised(table, []) == table[[0]]).all()
    assert (energised(table, [1, 1], row=-3) == table[[1, 2, 3]]).all()
    assert (energised(table.tolist(), [-1], row=4) == table[[0, 3]]).all()
    with pytest.raises(TypeError):
        COLUMNS["unipolar"] = ()
    signs = straight(ARM, *C, PER_DEGREE).pulses()[2][1]
    states = energised(phases("half-step", "bipolar"), signs)
    assert states.shape == (len(signs) + 1, 4)
    # one winding changes at a time
    assert (abs(np.diff(states[:, ::2], axis=0)).sum(axis=1) == 1).all()


# ---- rotors

KINDS = [("active", "unipolar", n) for n in range(3, 7)]
KINDS += [("active", "bipolar", n) for n in range(2, 7)]
KINDS += [("passive", "unipolar", n) for n in range(3, 7)]
DRIVES = ("wave", "two-phase", "half-step")
MOTORS = [Stepper(*kind, drive) for kind in KINDS for drive in DRIVES]
every_motor = pytest.mark.parametrize(
    "motor", MOTORS, ids=lambda m: f"{m.rotor}-{m.motor}-{m.windings}-{m.drive}"
)
STARTS = Stepper()  # the motor of table 1


def places(motor):
    """The direction in which each winding pulls: evenly distributed around the circle, or around
    half of it for bipolar currents.
    """
    whole_turn = 180 if motor.motor == "bipolar" else 360
    return np.arange(motor.windings) * whole_turn / motor.windings * deg


def even(count, frequency):
    return np.arange(1, count + 1) / frequency, np.ones(count)


@every_motor
def test_the_field_of_any_number_of_windings_turns_evenly(motor):
    table = phases(motor.drive, motor.motor, motor.windings)
    ways = (2 if motor.motor == "bipolar" else 1) * (2 if motor.drive == "half-step" else 1)
    assert len(table) == ways * motor.windings == len({*map(tuple, table.tolist())})
    if motor.motor == "bipolar":
        assert (table[:, ::2] == -table[:, 1::2]).all()
        table = table[:, ::2]
    field = table @ np.exp(1j * places(motor))
    assert np.angle(np.roll(field, -1) / field) == pytest.approx(2 * np.pi / len(table))
    on = np.count_nonzero(table, axis=1).tolist()
    assert on == {"wave": [1], "two-phase": [2], "half-step": [1, 2]}[motor.drive] * (
        len(table) // (2 if motor.drive == "half-step" else 1)
    )


@every_motor
def test_the_step_follows_from_windings_poles_and_teeth(motor):
    step = motor.step / deg
    halves = 2 if motor.drive == "half-step" else 1
    if motor.rotor == "active":  # a magnet with two poles, whose step is at least 10° (003, II.3.1)
        poles = 2 if motor.motor == "bipolar" else 1
        assert step == pytest.approx(360 / (motor.windings * poles * halves)) and step >= 10
    else:
        # the rotor advances by the difference between its teeth and the poles, like a vernier
        poles, teeth = 2 * motor.windings, motor.periods
        assert step == pytest.approx((360 / poles - 360 / teeth) / halves)
        assert step < 10 or motor.windings == 3


def test_steps_of_passive_rotors_are_in_the_range_stated_in_the_document():
    steps = [Stepper("passive", windings=n, drive=d).step / deg for n in (4, 5, 6) for d in DRIVES]
    assert min(steps) >= 1 and max(steps) <= 9 + 1e-9


@pytest.mark.parametrize("motor, strong", [("unipolar", 4), ("bipolar", 2)])
def test_two_windings_hold_sqrt_2_times_the_torque_of_one(motor, strong):
    one, two, half = (Stepper("active", motor, strong, d).holding_torque for d in DRIVES)
    assert two == pytest.approx(math.sqrt(2) * one) and half == one == Stepper().torque


@every_motor
def test_motor_holds_its_position_exactly_up_to_its_holding_torque(motor):
    below, above = (motor.run([], [], load=k * motor.holding_torque) for k in (0.99, 1.01))
    assert abs(np.diff(below.angle)).max() < 1e-9 and below.lost == 0
    # the load has pulled the rotor back almost to the point of maximum torque
    bent = motor.periods * (motor.run([], []).angle[0] - below.angle[0])
    assert np.sin(bent) == pytest.approx(
        0.99 * motor.holding_torque / motor.torque / abs(motor.pulls[0])
    )
    weak = abs(motor.pulls[0]) == pytest.approx(abs(motor.pulls).min())
    assert weak and above.lost > 0 and above.angle[-1] < -2 * np.pi / motor.periods


@every_motor
def test_motor_moves_exactly_up_to_its_starting_torque(motor):
    # The pulses are so far apart that only torques matter.
    slow = replace(motor, inertia=4e-4 * motor.periods, damping=4e-3 * motor.periods, rise=0.0)
    t, signs = even(len(motor.currents), 0.15)
    lost = [slow.run(t, signs, load=k * motor.starting_torque).lost for k in (0.96, 1.04)]
    assert lost[0] == 0 < lost[1]


@pytest.mark.parametrize("count", [2, 4, 6])
def test_a_rotor_swings_like_a_pendulum(count):
    # Half steps rotate the field by 45, 22.5 and 15 degrees. The period of a pendulum is known for
    # every amplitude A: 4 K(sin(A/2)) / omega, and 2 pi / omega for small A, where omega^2 = N T /
    # J.
    motor = Stepper("active", "bipolar", count, "half-step", damping=5e-7, rise=0.0)
    run = motor.run([0.0], [1])
    off = run.angle - run.due
    up = np.flatnonzero((off[:-1] < 0) & (off[1:] >= 0))[:2]
    cross = run.t[up] - off[up] * (run.t[up + 1] - run.t[up]) / (off[up + 1] - off[up])
    omega = math.sqrt(motor.periods * motor.torque * abs(motor.pulls[1]) / motor.inertia)
    away = np.pi / (2 * count)
    assert np.diff(cross) == pytest.approx(4 * ellipk(math.sin(away / 2) ** 2) / omega, rel=1e-3)
    if count == 6:
        assert 1 / np.diff(cross) == pytest.approx(omega / (2 * np.pi), rel=0.006)


RUNS = {
    "none lost": (Stepper(), 100, 0.0, 0.0),
    "lost": (Stepper(drive="two-phase"), 200, 0.004, 1e-6),
    "bipolar": (Stepper("active", "bipolar", 3, "half-step"), 300, 0.0, 5e-7),
    "passive": (Stepper("passive", "unipolar", 3, "two-phase"), 250, 0.0, 0.0),
    "at once": (Stepper("passive", "unipolar", 4, rise=0.0), 150, 0.005, 0.0),
}


@pytest.mark.parametrize("name", RUNS)
def test_run_matches_scipy_integration(name):
    motor, frequency, load, load_inertia = RUNS[name]
    t, signs = even(12, frequency)
    run = motor.run(t, signs, load, load_inertia)
    # The same model, written independently: one sine for each winding, and separate equations for
    # the currents.
    at, inertia = places(motor), motor.inertia + load_inertia
    table = phases(motor.drive, motor.motor, motor.windings)
    table = table[:, ::2] if motor.motor == "bipolar" else table

    def law(_, y, goal):
        theta, omega, i = y[0], y[1], y[2:] if motor.rise else goal
        i = i if motor.rotor == "active" else i * i
        torque = motor.torque * (i * np.sin(at - motor.periods * theta)).sum()
        lag = (goal - y[2:]) / motor.rise if motor.rise else 0 * goal
        return [omega, (torque - motor.damping * omega - load) / inertia, *lag]

    y, angle = np.array([run.angle[0], 0.0, *table[0]]), []
    edges = [0.0, *t, run.t[-1]]
    for k, (begin, end) in enumerate(itertools.pairwise(edges)):
        here = run.t[(run.t >= begin - 1e-12) & (run.t <= end + 1e-12)]
        goal = table[k % len(table)].astype(float)
        found = solve_ivp(
            law,
            (begin, end + 1e-9),
            y,
            "DOP853",
            args=(goal,),
            rtol=1e-11,
            atol=1e-12,
            dense_output=True,
        )
        angle.append((here, found.sol(here)[0]))
        y = found.sol(end)
    for here, wanted in angle:
        assert np.interp(here, run.t, run.angle) == pytest.approx(wanted, abs=1e-5)
    assert (run.lost != 0) == (name == "lost")


@every_motor
def test_lost_steps_are_multiples_of_the_length_of_the_table(motor):
    motor = replace(motor, rise=0.0)
    lost = [motor.run(*even(24, f), load_inertia=3e-5).lost for f in (60, 250, 480)]
    assert all(n % len(motor.currents) == 0 for n in lost) and any(lost)
    run = motor.run(*even(24, 480), load_inertia=3e-5)
    assert run.due[-1] - run.angle[-1] == pytest.approx(run.lost * motor.step, abs=0.02)
    assert run.due[-1] - run.due[0] == pytest.approx(24 * motor.step)


def test_start_frequency_is_the_limit_of_lossless_starts():
    for drive, inertia in ((DRIVES[0], 0.0), (DRIVES[2], 2e-6)):
        motor = Stepper(drive=drive)
        top = motor.start_frequency(load_inertia=inertia)
        assert 10 < top < LIMIT
        assert motor.run(*even(48, top), load_inertia=inertia).lost == 0
        assert motor.run(*even(48, top + 1), load_inertia=inertia).lost != 0
    assert Stepper().start_frequency(load=0.0199) == 0
    tops = [Stepper().start_frequency(load_inertia=k * 1e-6) for k in (1, 8)]
    assert sorted(tops, reverse=True) == tops and len(set(tops)) == 2


def test_four_times_the_inertia_halves_the_frequency():
    # the same equation on a different time scale, so the same angles
    heavy = replace(STARTS, damping=2 * STARTS.damping, rise=2 * STARTS.rise)
    for frequency in (100, 180):
        one = STARTS.run(*even(20, frequency))
        two = heavy.run(*even(20, frequency / 2), load_inertia=3 * STARTS.inertia)
        assert two.t == pytest.approx(2 * one.t) and two.lost == one.lost
        assert two.angle == pytest.approx(one.angle, abs=1e-6)
    assert one.lost
    assert one in [one] and one != replace(one)  # comparing arrays would raise an error


def test_reverse_run_is_the_mirror_image():
    for motor in MOTORS[::5]:
        t, signs = even(20, 230)
        there, back = motor.run(t, signs), motor.run(t, -signs)
        mirrored = 2 * there.angle[0] - back.angle
        assert mirrored == pytest.approx(there.angle, abs=1e-6) and back.lost == -there.lost


@pytest.mark.parametrize("sign", [1, -1])
def test_load_or_torque_that_turns_the_rotor_too_fast_is_refused(sign):
    """The final speed under a torque T is T / damping. Both torques count, whichever way the load
    pulls, and the message names the one that is too large.
    """
    motor = Stepper(torque=1e3, damping=2, inertia=1e-3, rise=0)
    assert motor.run([1e-3], [1], load=2 * sign * FASTEST).lost != 0
    with pytest.raises(
        ValueError, match=r"^load: wanted a value that turns the rotor at no more than 1e"
    ):
        motor.run([1e-3], [1], load=2.002 * sign * FASTEST)
    strong = {"damping": 1, "inertia": 1e-9, "rise": 0}
    assert Stepper(torque=FASTEST, **strong).run([1e-9], [1], load=sign).lost == 0
    with pytest.raises(
        ValueError, match=r"^torque: wanted a value that turns .*got 1\.001e\+09 N m"
    ):
        Stepper(torque=1.001 * FASTEST, **strong).run([1e-9], [1], load=sign)


def test_ramp_reaches_frequencies_above_the_start_frequency():
    motor = Stepper(drive="two-phase")
    assert motor.run(*even(48, 200), load_inertia=1e-6).lost == 48
    assert motor.run(ramp(48, 40, 200, 0.15), np.ones(48), load_inertia=1e-6).lost == 0
    # if the ramp is too short, some steps are lost
    assert 0 < motor.run(ramp(48, 40, 200, 0.05), np.ones(48), load_inertia=1e-6).lost < 48


@pytest.mark.parametrize(
    "asked", [(48, 40, 200, 0.15), (20, 50, 400, 0.3), (1, 10, 90, 2), (7, 5, 9, 0)]
)
def test_number_of_pulses_of_a_ramp_is_the_integral_of_its_frequency(asked):
    count, start, end, seconds = asked
    times = ramp(*asked)
    duration = times[-1]
    rise = (end - start) / seconds if seconds else np.inf

    def frequency(t):
        near = min(t, duration - t)
        return min(end, start + rise * near) if seconds else end

    for k, t in enumerate(times, 1):
        corners = [x for x in (seconds, duration / 2, duration - seconds) if 0 < x < t]
        assert quad(frequency, 0, t, points=corners or None)[0] == pytest.approx(k, abs=1e-6)
    assert times == pytest.approx(duration - np.concatenate([times[-2::-1], [0]]), abs=1e-12)
    gaps = np.diff(times, prepend=0)
    assert 1 / end - 1e-12 <= gaps.min() and gaps.max() <= 1 / start + 1e-12


def test_constant_ramp_matches_a_move_at_constant_frequency():
    times, signs = synchronised([0], [37], 250).pulses()[0]
    assert ramp(37, 250, 250, 1.0) == pytest.approx(times) and signs.sum() == 37
    for no_time in (0.0, 1e-9, 5e-324):
        assert ramp(37, 40, 250, no_time) == pytest.approx(times, abs=1e-8)
