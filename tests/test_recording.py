"""The content of a recording: the derivatives computed by `differentiate`, and the samples where
they are undefined.
"""

import pickle
from dataclasses import replace

import numpy as np
import pytest

from robokin import (
    IRB140,
    SCARA,
    Quaternion,
    Recording,
    Transform,
    blend,
    deg,
    differentiate,
    follow,
    lin,
    linear,
    ptp,
    quintic,
    record,
    trapezoidal,
    two_link,
)

X, Y, Z = np.eye(3)
ROW = IRB140.branch(+1, +1, -1)
# The motion of document 001, tasks 3 and 4.
START = Transform(Quaternion.from_angle_axis(90 * deg, -X), (0.2, 0.4, 0.2))
VIA = Transform(Quaternion.from_angle_axis(45 * deg, Y), (0.65, -0.1, 0.8))
GOAL = Transform(Quaternion.from_angle_axis(90 * deg, Y), (0.3, 0.3, 0.5))
T = np.linspace(0, 20, 2001)
# The jumps in speed at the via pose, rad/s: errata S1, "chain", calculated by independent code.
CORNER_JUMP = np.array(
    [
        0.107946862582,
        0.457852830604,
        0.920011415539,
        0.030116525407,
        -0.456073919364,
        -0.216939050457,
    ]
)
UNEVEN = np.cumsum(np.random.default_rng(7).uniform(0.5, 1.5, 300)) * 0.01


def chain(fraction, t=T):
    s = linear(t[-1])(t)
    return follow(IRB140, IRB140.ik(blend(START, VIA, GOAL, fraction, s)), ROW)


def wave(t=UNEVEN, size=1.0):
    """A motion of six joints with different speeds, inside the limits of the IRB-140."""
    return size * np.sin(np.outer(t, 1 + np.arange(6) / 2))


@pytest.fixture(scope="module")
def motions():
    return chain(np.array([0, 0.1, 0.25, 0.5])[:, None])


# --- Speeds and accelerations ---------------------------------------------------------------------


@pytest.mark.parametrize("t", [T, UNEVEN], ids=["even", "uneven"])
def test_a_smooth_motion_has_the_derivatives_that_differentiate_gives(t):
    q = wave(t)
    found = record(IRB140, t, q)
    assert (found.v == differentiate(q, t)).all()
    assert (found.a == differentiate(q, t, 2)).all()
    assert (found.q == q).all() and (found.t == t).all()
    assert not found.gaps.any() and not found.missing.any() and found.leaps == found.jumps == ()


def test_pieces_on_both_sides_of_a_gap_are_differentiated_separately():
    q = wave()
    q[100:120] = np.nan
    found = record(IRB140, UNEVEN, q)
    for piece in (slice(0, 100), slice(120, 300)):
        assert (found.v[piece] == differentiate(q[piece], UNEVEN[piece])).all()
        assert (found.a[piece] == differentiate(q[piece], UNEVEN[piece], 2)).all()
    assert np.isnan(found.v[100:120]).all() and np.isnan(found.a[100:120]).all()
    assert np.flatnonzero(found.missing).tolist() == list(range(100, 120))
    assert np.flatnonzero(found.gaps).tolist() == list(range(99, 120))
    assert found.leaps == ()


@pytest.mark.parametrize("length", [1, 2, 3])
def test_short_pieces_have_no_speed(length):
    q = wave()
    q[100], q[101 + length] = np.nan, np.nan
    found = record(IRB140, UNEVEN, q)
    piece = slice(101, 101 + length)
    assert np.isfinite(found.q[piece]).all()
    assert np.isfinite(found.v[piece]).all() == (length == 3)
    assert np.isfinite(found.v[:100]).all() and np.isfinite(found.v[102 + length :]).all()
    assert np.isfinite(found.a[piece]).all() == (length == 3)


def test_two_samples_have_no_speeds():
    found = record(IRB140, [0, 1], wave(np.array([0, 0.1])))
    assert np.isnan(found.v).all() and np.isnan(found.a).all() and np.isfinite(found.q).all()
    assert np.isnan(found.greatest_speed.value).all() and np.isnan(found.speed_excess).all()


def test_row_with_one_nan_joint_is_missing():
    q = wave()
    q[50, 3] = np.nan
    found = record(IRB140, UNEVEN, q)
    assert np.isnan(found.q[50]).all() and found.missing[50]
    assert found.missing.sum() == 1 and np.isfinite(found.q[[49, 51]]).all()


# --- Jumps in speed -------------------------------------------------------------------------------


@pytest.mark.parametrize("count, tolerance", [(2001, 1e-4), (2000, 2e-3), (100, 0.03)])
def test_speed_jump_does_not_depend_on_the_step(count, tolerance):
    t = np.linspace(0, 20, count)
    [jump] = record(IRB140, t, chain(0.0, t)).jumps
    assert t[jump.first] <= 10 + 1e-9 and t[jump.last] >= 10 - 1e-9
    assert jump.last - jump.first <= 1 and jump.time == pytest.approx(10, abs=1e-9)
    assert np.allclose(jump.by, CORNER_JUMP, atol=tolerance)


def test_speeds_on_both_sides_of_a_corner_match_the_two_pieces():
    # Two parabolas meet at t = 1.5 with different slopes, so the speeds are known exactly.
    t = np.linspace(0, 3, 301)
    u = t - 1.5
    q = np.zeros((301, 6))
    q[:, 0] = np.where(u < 0, 0.5 * u + 0.1 * u**2, -0.3 * u + 0.2 * u**2)
    q[:, 1] = 0.2 * u**2  # the speed of joint 2 does not jump
    [jump] = record(IRB140, t, q).jumps
    assert (jump.first, jump.last) == (150, 150) and jump.time == 1.5 and jump.motion == ()
    assert jump.before[0] == pytest.approx(0.5, abs=1e-9)
    assert jump.after[0] == pytest.approx(-0.3, abs=1e-9)
    assert jump.by[0] == pytest.approx(-0.8, abs=1e-9) and (jump.by[1:] == 0).all()
    assert jump.before[1] == pytest.approx(0, abs=1e-9)


def test_a_corner_between_two_samples_is_found_between_them():
    t = np.linspace(0, 3, 300)  # no sample at 1.5
    u = t - 1.5
    q = np.zeros((300, 6))
    q[:, 2] = np.where(u < 0, 0.5 * u, -0.3 * u)
    [jump] = record(IRB140, t, q).jumps
    assert (jump.first, jump.last) == (149, 150) and jump.time == pytest.approx(1.5)
    assert jump.before[2] == pytest.approx(0.5, abs=1e-9)
    assert jump.after[2] == pytest.approx(-0.3, abs=1e-9)


@pytest.mark.parametrize("share", [0.02, 0.3, 0.7, 0.98])
@pytest.mark.parametrize("sample", [4, 50, 94])
def test_small_speed_change_next_to_a_corner_is_not_a_separate_jump(share, sample):
    """A corner shortly after (or before) a sample changes the speeds of two pairs of intervals, one
    of them by 2 % of the jump: too little for a separate jump.
    """
    t = np.linspace(0, 1, 100)
    corner = t[sample] + share * (t[sample + 1] - t[sample])
    q = np.stack([t + 0.1 * np.maximum(t - corner, 0), 0 * t], axis=-1)
    (jump,) = record(two_link(1, 1), t, q).jumps
    assert (jump.first, jump.last) == (sample, sample + 1)
    np.testing.assert_allclose(jump.time, t[sample : sample + 2].mean(), rtol=1e-12)
    np.testing.assert_allclose(jump.before, [1, 0], atol=1e-9)
    np.testing.assert_allclose(jump.after, [1.1, 0], atol=1e-9)


def test_acceleration_is_nan_exactly_at_speed_jumps():
    t = np.linspace(0, 3, 301)
    u = t - 1.5
    q = np.zeros((301, 6))
    q[:, 0], q[:, 1] = np.where(u < 0, 0.5 * u, -0.3 * u), 0.2 * u**2
    found = record(IRB140, t, q)
    plain = differentiate(q, t, 2)
    missing = np.isnan(found.a)
    assert np.flatnonzero(missing[:, 0]).tolist() == [149, 150, 151]
    assert not missing[:, 1:].any()
    assert (found.a[~missing] == plain[~missing]).all()
    # Plain differences have a spike there: the jump divided by the step.
    assert abs(plain[149:152, 0]).max() > 10 and abs(found.a[~missing]).max() < 0.5
    assert (found.v == differentiate(q, t)).all()  # the speeds are unchanged


@pytest.mark.parametrize("count", [100, 2001])
def test_a_smooth_motion_has_no_jump(count):
    t = np.linspace(0, 20, count)
    q0, q1 = chain(0.0, np.array([0, 10.0, 20]))[[0, 2]]
    for law in (linear(20), quintic(20), trapezoidal(20)):
        s = law(t)
        for q in (ptp(q0, q1, s), follow(IRB140, IRB140.ik(lin(START, GOAL, s)), ROW)):
            found = record(IRB140, t, q)
            assert found.jumps == () and found.leaps == () and not found.gaps.any()
            assert np.isfinite(found.a).all()
    assert record(IRB140, t, chain(0.1, t)).jumps == ()


def test_tiny_changes_in_speed_are_not_jumps():
    t = np.linspace(0, 2, 401)
    corner = np.maximum(t - 1, 0)
    for share, count in ((0.008, 0), (0.02, 1)):
        q = np.zeros((401, 6))
        q[:, 0] = t + share * corner
        assert len(record(IRB140, t, q).jumps) == count


def test_two_corners_are_two_jumps():
    t = np.linspace(0, 3, 301)
    q = np.zeros((301, 6))
    q[:, 0] = np.interp(t, [0, 1, 2, 3], [0, 0.5, 0.2, 0.2])
    jumps = record(IRB140, t, q).jumps
    assert [jump.time for jump in jumps] == pytest.approx([1, 2])
    assert [jump.by[0] for jump in jumps] == pytest.approx([-0.8, 0.3])
    assert [repr(jump.motion) for jump in jumps] == ["()", "()"]


def test_two_corners_three_samples_apart_are_two_jumps():
    t = np.linspace(0, 1, 101)
    q = np.interp(t, [0, 0.5, 0.53, 1], [0, 0.5, 0.47, 0.94])[:, None] * [1.0, 0]
    jumps = record(two_link(1, 1), t, np.stack([q, q])).jumps
    assert [(repr(jump.motion), jump.first) for jump in jumps] == [
        (f"({i},)", first) for i in (0, 1) for first in (50, 53)
    ]
    assert [jump.by[0] for jump in jumps] == pytest.approx([-2, 2] * 2)


# --- Jumps in position ----------------------------------------------------------------------------


def test_turn_by_two_pi_between_samples_is_a_jump():
    q = wave()
    q[200:, 3] += 2 * np.pi
    found = record(IRB140, UNEVEN, q)
    [leap] = found.leaps
    assert (leap.first, leap.last, leap.motion) == (199, 200, ())
    assert leap.time == (UNEVEN[199] + UNEVEN[200]) / 2
    assert leap.by[3] == pytest.approx(2 * np.pi, abs=1e-3) and (np.delete(leap.by, 3) == 0).all()
    middle = np.sin(2.5 * leap.time)
    assert leap.before[3] == pytest.approx(middle, abs=1e-3)
    assert leap.after[3] == pytest.approx(middle + 2 * np.pi, abs=1e-3)
    assert np.flatnonzero(found.gaps).tolist() == [199] and found.jumps == ()
    whole = record(IRB140, UNEVEN, wave())
    assert abs(found.v - whole.v).max() < 0.01 and abs(found.v).max() < 4
    for piece in (slice(0, 200), slice(200, 300)):
        assert (found.v[piece] == differentiate(q[piece], UNEVEN[piece])).all()


@pytest.mark.parametrize("size, leap", [(0.0019, False), (0.0021, True), (3.0, True)])
def test_step_from_rest_is_a_jump_if_it_exceeds_2_mrad(size, leap):
    t = np.linspace(0, 1, 101)
    q = np.zeros((101, 6))
    q[50:, 0] = size
    found = record(IRB140, t, q)
    assert [jump.first for jump in found.leaps] == [49] * leap
    assert found.gaps[49] == leap and found.gaps.sum() == leap


ON = {
    "rest": lambda t: 0 * t,
    "ramp": lambda t: 0.7 * t,
    "sine": lambda t: np.sin(2 * t),
    "fast sine": lambda t: 0.1 * np.sin(12 * t),
}
TEETH = {
    "one": [120],
    "several": [40, 100, 160, 220],
    "close": [100, 103, 107, 110],
    "as close as can be": [100, 102, 104, 106, 108],
    "next to the ends": [1, 297],
}


@pytest.mark.parametrize("size", [0.12, -0.16, 1.5])
@pytest.mark.parametrize("teeth", TEETH.values(), ids=TEETH)
@pytest.mark.parametrize("on", ON.values(), ids=ON)
@pytest.mark.parametrize("t", [np.linspace(0, 3, 300), UNEVEN], ids=["even", "uneven"])
def test_every_tooth_of_a_sawtooth_is_a_jump(t, on, teeth, size):
    """Joint 2 jumps at every tooth; joint 1 does not. The size of each tooth is known."""
    up = size * np.searchsorted(teeth, np.arange(300))
    q = np.zeros((300, 6))
    q[:, 0], q[:, 1] = np.sin(t), on(t) + up
    found = record(IRB140, t, q)
    assert [(jump.first, jump.last) for jump in found.leaps] == [(i, i + 1) for i in teeth]
    assert found.jumps == () and np.flatnonzero(found.gaps).tolist() == teeth
    for jump in found.leaps:
        assert jump.by[1] == pytest.approx(size, abs=0.013) and (np.delete(jump.by, 1) == 0).all()
    # The speeds are those of the underlying motion, not a jump divided by a step.
    exact = np.gradient(on(t), t)
    assert np.nanmax(abs(found.v[:, 1] - exact)) < 0.4 and abs(size) / 0.015 > 3


def test_teeth_of_four_samples_or_more_are_jumps():
    """Teeth of three samples are not jumps: a sine can have the same samples."""
    t = np.linspace(0, 2, 201)
    for period, leaps in ((3, False), (4, True), (7, True), (30, True)):
        q = 0.05 * (np.arange(201) % period)[:, None] * [1, 0.5]
        falls = np.flatnonzero(np.diff(q[:, 0]) < 0)
        found = record(two_link(1, 1), t, q)
        inside = [
            jump for jump in found.leaps if 2 < jump.first < 197
        ]  # other rules apply near the ends
        assert [jump.first for jump in inside] == [i for i in falls if 2 < i < 197] * leaps
        for jump in inside:
            np.testing.assert_allclose(jump.by, [-0.05 * period, -0.025 * period], atol=1e-9)


@pytest.mark.parametrize("size", [0.5, -1.5])
@pytest.mark.parametrize("on", list(ON.values())[:3], ids=list(ON)[:3])
def test_tooth_at_an_end_is_a_jump_if_ten_times_as_large_as_the_next_step(on, size):
    t = np.linspace(0, 3, 300)
    q = np.stack([on(t) + size * np.searchsorted([0, 298], np.arange(300)), 0 * t], axis=-1)
    found = record(two_link(1, 1), t, q)
    assert [jump.first for jump in found.leaps] == [0, 298] and found.jumps == ()
    assert all(jump.by[0] == pytest.approx(size, abs=0.03) for jump in found.leaps)


def test_teeth_of_different_joints_are_separate_jumps():
    t = np.linspace(0, 3, 300)
    q = wave(t, 0.3)
    teeth = {50: [0], 53: [3], 56: [0, 5], 200: [1, 2, 4]}
    for i, joints in teeth.items():
        q[i + 1 :, joints] += 0.2
    found = record(IRB140, t, q)
    told = {jump.first: np.flatnonzero(jump.by).tolist() for jump in found.leaps}
    assert told == teeth and found.jumps == ()


def test_teeth_between_missing_samples_are_found():
    t = np.linspace(0, 3, 300)
    q = np.stack([0.3 * t + 0.1 * (np.arange(300) > 60), 0 * t], axis=-1)
    q[120:, 0] += 0.1
    q[180:, 0] += 0.1
    for missing in ([58, 63], [118, 122], [178]):
        q[missing] = np.nan
    found = record(two_link(1, 1), t, q)
    assert [jump.first for jump in found.leaps] == [60, 119, 179] and found.jumps == ()
    assert all(0.09 < jump.by[0] < 0.11 for jump in found.leaps)


def test_outlying_sample_has_a_jump_on_both_sides():
    t = np.linspace(0, 3, 301)
    q = np.stack([np.sin(t), 0 * t], axis=-1)
    q[140, 0] += 0.3
    found = record(two_link(1, 1), t, q)
    assert [jump.first for jump in found.leaps] == [139, 140] and found.jumps == ()
    np.testing.assert_allclose([jump.by[0] for jump in found.leaps], [0.3, -0.3], atol=0.02)


def test_position_jump_is_found_where_the_speed_jumps_too():
    t = np.linspace(0, 3, 301)
    q = np.stack([np.where(t < 1.505, 0.2 * t, 0.5 - 0.3 * t), 0 * t], axis=-1)
    [leap] = record(two_link(1, 1), t, q).leaps
    assert leap.first == 150 and leap.by[0] == pytest.approx(0.5 - 0.5 * 1.505, abs=1e-9)


QUICK = {
    "point to point": lambda x, width: quintic(width)(x + width / 2),
    "with ramps": lambda x, width: trapezoidal(width)(x + width / 2),
    "at even speed": lambda x, width: np.clip(x / width, -0.5, 0.5),
    # most of a wrist flip happens within `width`
    "wrist flip": lambda x, width: np.arctan(2.7 * x / width),
    "there and back": lambda x, width: np.where(
        abs(x) < width / 2, np.cos(np.pi * x / width) ** 2, 0
    ),
}


@pytest.mark.parametrize("motion", QUICK.values(), ids=QUICK)
def test_motion_of_two_steps_is_not_a_jump(motion):
    """The motion goes from rest to rest, wherever the samples fall; a motion there and back takes
    four steps.
    """
    samples = np.arange(-30, 31.0)
    least = 4 if motion is QUICK["there and back"] else 2
    for width in (least, least + 0.5, least + 1, 2 * least, 5 * least):
        shifts = np.arange(0, 1, 0.05)[:, None]
        q = motion(samples + shifts, width)
        found = record(two_link(1, 1), samples, np.stack([q, 0 * q], axis=-1))
        assert found.leaps == ()


@pytest.mark.parametrize("period", [5, 5.5, 6.3, 7.1, 9, 20])
def test_oscillation_of_five_samples_is_not_a_jump(period):
    turns = np.arange(200) / period + np.arange(0, 1, 0.05)[:, None]
    q = np.sin(2 * np.pi * turns)
    assert record(two_link(1, 1), np.arange(200), np.stack([q, 0 * q], axis=-1)).leaps == ()


def test_ambiguous_samples_are_not_jumps():
    t = np.linspace(0, 1, 101)
    twice = np.searchsorted([50, 51], np.arange(101)) * 0.3
    thrice = np.zeros(101)
    thrice[[51, 53]] = 0.3  # the joint goes up, down, up, down
    every_other = np.arange(101) // 2 * 0.3
    for q in (twice, thrice, every_other):
        assert record(two_link(1, 1), t, np.stack([q, 0 * q], axis=-1)).leaps == ()


@pytest.mark.parametrize("size", [1e-4, 1e-3, 0.01, 0.2])
def test_noise_is_not_a_jump(size):
    rng = np.random.default_rng(3)
    t = np.linspace(0, 20, 5001)
    q = np.sin(np.outer(t, [1, 1.5])) + size * rng.normal(size=(4, 5001, 2))
    assert record(two_link(1, 1), t, q).leaps == ()
    q[:, 3000:, 0] += 100 * size  # but a large step in the noise is a jump
    assert [jump.first for jump in record(two_link(1, 1), t, q).leaps] == [2999] * 4


def test_fast_motion_is_not_a_jump():
    t = np.linspace(0, 1, 11)
    q = np.zeros((11, 6))
    q[:, 0] = 2.0 * t  # 0.2 rad between any two samples
    assert record(IRB140, t, q).leaps == ()


def test_long_stroke_is_not_a_jump_but_half_a_turn_is():
    t = np.linspace(0, 10, 11)
    q = np.zeros((11, 4))
    q[:, 2] = 3.2 * t / 1  # every step is more than half a turn
    assert len(record(SCARA, t, q).leaps) == 10
    q = np.zeros((11, 4))
    q[:, 3] = 3.2 * t  # in metres
    assert record(SCARA, t, q).leaps == ()


def test_jump_next_to_a_gap_starts_from_the_only_sample_before_it():
    t = np.linspace(0, 1, 101)
    q = np.zeros((101, 6))
    q[:, 0] = t
    q[50:, 0] += 3
    q[48] = np.nan  # one sample is between the gap and the jump
    [leap] = record(IRB140, t, q).leaps
    assert (leap.first, leap.last) == (49, 50)
    assert leap.before[0] == t[49] and leap.after[0] == pytest.approx(3.495)


@pytest.mark.parametrize("first", [0, 98])
def test_jump_at_an_end_is_found(first):
    t = np.linspace(0, 0.99, 100)
    q = np.zeros((100, 6))
    q[:, 0] = 0.1 * t
    q[first + 1 :, 0] += 2
    [leap] = record(IRB140, t, q).leaps
    assert (leap.first, leap.last) == (first, first + 1)
    assert leap.by[0] == pytest.approx(2, abs=0.0011)


# --- Limits and greatest values -------------------------------------------------------------------


def test_excess_is_how_far_each_joint_value_is_beyond_its_limit():
    q = wave(size=2.5)
    q[40:50] = np.nan
    found = record(IRB140, UNEVEN, q)
    for k in range(0, 300, 7):
        for j in range(6):
            low, high = IRB140.limits[j]
            wanted = max(low - q[k, j], q[k, j] - high, 0)
            assert found.excess[k, j] == pytest.approx(wanted, abs=1e-12, nan_ok=True)
    past = found.excess > 0
    assert past[:, 1].any() and not past[:, 0].any() and not past[:, 3].any()
    assert np.isnan(found.excess[40:50]).all() and np.isfinite(found.excess[:40]).all()
    assert found.excess[np.isfinite(found.excess)].min() == 0


def test_joint_at_its_limit_does_not_exceed_it():
    q = np.broadcast_to(IRB140.limits[:, 1], (5, 6)) + 1e-10
    assert (record(IRB140, np.arange(5), q).excess == 0).all()
    q = np.broadcast_to(IRB140.limits[:, 0], (5, 6)) - 2e-9
    assert (record(IRB140, np.arange(5), q).excess > 0).all()


def test_speed_excess_is_symmetric():
    t = np.linspace(0, 2, 201)
    q = np.zeros((201, 6))
    q[:, 1], q[:, 2] = -4 * t + 4, 0.1 * np.sin(t)  # joint 2 at 4 rad/s; its limit is 200 °/s
    found = record(IRB140, t, q)
    assert np.allclose(found.speed_excess[:, 1], 4 - 200 * deg, rtol=0, atol=1e-9)
    assert (np.delete(found.speed_excess, 1, axis=1) == 0).all()
    assert SCARA.speed_limits is None
    assert (record(SCARA, t, q[:, :4]).speed_excess == 0).all()


def test_greatest_values_and_their_times_are_correct(motions):
    q = motions[1]
    found = record(IRB140, T, q)
    for extreme, values in (
        (found.greatest_speed, abs(np.gradient(q, T, axis=0, edge_order=2))),
        (found.greatest_acceleration, abs(found.a)),
        (found.highest, q),
        (found.lowest, q),
    ):
        for j in range(6):
            column = values[:, j].tolist()
            most = min(column) if extreme is found.lowest else max(column)
            assert extreme.value[j] == most and extreme.time[j] == T[column.index(most)]


def test_greatest_values_ignore_nan():
    q = wave()
    q[:150] = np.nan
    found = record(IRB140, UNEVEN, q)
    assert (found.highest.value == q[150:].max(axis=0)).all()
    assert (found.lowest.value == q[150:].min(axis=0)).all()
    assert (found.highest.time >= UNEVEN[150]).all() and (found.lowest.time >= UNEVEN[150]).all()
    none = record(IRB140, UNEVEN, np.full((300, 6), np.nan))
    for extreme in (none.highest, none.lowest, none.greatest_speed, none.greatest_acceleration):
        assert np.isnan(extreme.value).all() and np.isnan(extreme.time).all()
    assert none.missing.all() and none.gaps.all() and none.leaps == none.jumps == ()


# --- Batches --------------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", [(), (4,), (2, 1, 2), (0,)])
def test_a_batch_is_recorded_motion_by_motion(motions, shape):
    q = motions.copy()
    q[2, 700:710] = np.nan
    q[3, 500:, 5] += 2 * np.pi
    q = q[0] if shape == () else q[: shape[0]] if shape == (0,) else q.reshape(*shape, 2001, 6)
    found = record(IRB140, T, q)
    assert found.shape == shape
    for name, part in (("q", (6,)), ("v", (6,)), ("a", (6,)), ("excess", (6,)), ("missing", ())):
        assert getattr(found, name).shape == (*shape, 2001, *part)
    assert found.gaps.shape == (*shape, 2000)
    assert found.greatest_speed.value.shape == found.lowest.time.shape == (*shape, 6)
    for place in np.ndindex(shape):
        one, part = record(IRB140, T, q[place]), found[place] if shape else found
        for name in ("q", "v", "a", "missing", "gaps", "excess", "speed_excess"):
            assert np.array_equal(getattr(one, name), getattr(part, name), equal_nan=True)
        assert one.shape == part.shape == ()
        for name in ("leaps", "jumps"):
            mine = [jump for jump in getattr(found, name) if jump.motion == place]
            for jumps in (mine, getattr(part, name)):
                assert [j.time for j in jumps] == [j.time for j in getattr(one, name)]
            assert all(jump.motion == () for jump in getattr(part, name))
    if len(shape) == 1:
        assert len(found) == len(list(found)) == shape[0]


def test_parts_of_a_batch_keep_their_jumps(motions):
    both = record(IRB140, T, np.stack([motions, motions[::-1]]))
    assert [jump.motion for jump in both.jumps] == [(0, 0), (1, 3)]
    assert [jump.motion for jump in both[1].jumps] == [(3,)]
    assert [jump.motion for jump in both[:, 3].jumps] == [(1,)]
    assert [jump.motion for jump in both[1:, 2:].jumps] == [(0, 1)]
    assert both[1:, 2:].shape == (1, 2) and both[0, 1].jumps == ()
    for jump in both.jumps:
        assert np.array_equal(both.q[jump.motion], motions[0])


def test_a_single_recording_has_no_parts(motions):
    one = record(IRB140, T, motions[0])
    for call in (lambda: len(one), lambda: one[0], lambda: list(one)):
        with pytest.raises(TypeError, match="a single Recording"):
            call()


# --- Recordings as objects ------------------------------------------------------------------------


def test_recordings_are_read_only(motions):
    t, q = T.copy(), motions[0].copy()
    found = record(IRB140, t, q)
    q[:] = t[:] = 99
    assert found.q.max() < 9 and found.t[1] == T[1]
    arrays = [found.t, found.q, found.v, found.a, found.missing, found.gaps]
    arrays += [found.excess, found.speed_excess, *found.lowest, *found.highest]
    arrays += [*found.greatest_speed, *found.greatest_acceleration]
    arrays += [found.jumps[0].before, found.jumps[0].after]
    q = wave()
    q[200:, 3] += 2 * np.pi
    [leap] = record(IRB140, UNEVEN, q).leaps
    for array in (*arrays, leap.before, leap.after, record(IRB140, T, motions)[1].v):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0
    with pytest.raises(AttributeError):
        found.q = q
    with pytest.raises(AttributeError):
        leap.first = 3


def test_recordings_have_a_repr_and_can_be_pickled(motions):
    found = record(IRB140, T, motions[:2])
    assert repr(found) == "Recording('IRB-140', 2001 samples over 20 s, shape=(2,))"
    again = pickle.loads(pickle.dumps(found))
    assert isinstance(again, Recording) and np.array_equal(again.v, found.v)


def test_motion_in_degrees_causes_a_warning():
    t = np.linspace(0, 1, 50)
    q = np.linspace([90, 0, 0, 0, 0, 0], [100, 10, 0, 0, 0, 0], 50)
    with pytest.warns(UserWarning, match="q: 90 rad is many turns; did you mean degrees"):
        record(IRB140, t, q)


def test_motion_in_degrees_from_home_causes_a_warning():
    q = np.linspace(np.zeros(6), [90, 0, 0, 0, 0, 0], 50)
    with pytest.warns(UserWarning, match="did you mean degrees"):
        record(IRB140, np.linspace(0, 1, 50), q)
    with pytest.warns(UserWarning, match="q: 13 rad is many turns"):
        record(IRB140, np.linspace(0, 1, 50), np.full((50, 6), -13.0) * [1, 0, 0, 0, 0, 0])


def test_continuous_turning_causes_no_warning(recwarn):
    t = np.linspace(0, 1, 500)
    q = np.linspace(np.zeros(6), [0, 0, 0, 0, 0, 30], 500)
    q[:20] = np.nan
    record(IRB140, t, q)
    record(SCARA, t, np.full((500, 4), 20.0) * [0, 0, 0, 1])  # in metres
    assert not recwarn.list


@pytest.mark.parametrize(
    "wrong, kind, message",
    [
        (lambda q: record("IRB140", T, q), TypeError, "arm: wanted an Arm"),
        (lambda q: record(None, T, q), TypeError, "arm: wanted an Arm"),
        (lambda q: record(IRB140, T[:-1], q), ValueError, r"wanted shape \(..., 2000, 6\)"),
        (lambda q: record(IRB140, T[::-1], q), ValueError, "increasing"),
        (lambda q: record(IRB140, [0.0], q[:1]), ValueError, "at least two times"),
        (lambda q: record(IRB140, T, q[0]), ValueError, "q: wanted shape"),
        (lambda q: record(IRB140, T, q[:, :5]), ValueError, r"q: wanted shape \(..., 6\)"),
        (lambda q: record(IRB140, T, np.full_like(q, np.inf)), ValueError, "q: wanted finite"),
        (lambda q: record(IRB140, T * np.nan, q), ValueError, "t: wanted finite"),
        (lambda q: record(IRB140, T, None), ValueError, "q: wanted numbers"),
        (lambda q: record(IRB140, None, q), ValueError, "t: wanted numbers"),
        (lambda q: replace(record(IRB140, T, q), jumps=("here",)), TypeError, "tuple of Jumps"),
        (lambda q: replace(record(IRB140, T, q), leaps=[]), TypeError, "tuple of Jumps"),
    ],
)
def test_errors_name_the_invalid_argument_and_say_what_is_wanted(wrong, kind, message, motions):
    with pytest.raises(kind, match=message):
        wrong(motions[1])
