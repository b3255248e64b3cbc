"""`shortest_duration`: no joint exceeds its speed limit, and one joint reaches it."""

from functools import partial

import numpy as np
import pytest
from machines import MACHINES, random_joints
from scipy.interpolate import CubicSpline

from robokin import (
    IRB140,
    SCARA,
    Arm,
    Quaternion,
    Transform,
    blend,
    follow,
    lin,
    linear,
    ptp,
    quintic,
    shortest_duration,
    spbu_arm,
    trapezoidal,
)
from robokin.jobs.visit_collect import travel_time

# The greatest slope ds/dx of each law in x = t / T, from its formula: 1, 1 / (1 - ramp), 15 / 8.
LAWS = {
    "linear": (linear, 1.0),
    "trapezoidal": (trapezoidal, 4 / 3),
    "short ramps": (partial(trapezoidal, ramp=0.05), 1 / 0.95),
    "quintic": (quintic, 15 / 8),
}
START = Transform(translation=(0.2, 0.4, 0.2))
VIA = Transform(Quaternion.from_angle_axis(0.8, (0, 1, 0)), (0.65, -0.1, 0.8))
GOAL = Transform(Quaternion.from_angle_axis(1.5, (0, 1, 0)), (0.3, 0.3, 0.5))


def limited(arm, rng):
    """The arm with speed limits drawn at random."""
    return Arm(arm.name, arm.links, arm.limits, rng.uniform(0.5, 5, len(arm.limits)))


@pytest.mark.parametrize("law, slope", LAWS.values(), ids=LAWS)
@pytest.mark.parametrize("machine", MACHINES, ids=repr)
def test_ptp_takes_as_long_as_its_slowest_joint_times_the_slope_of_the_law(machine, law, slope):
    rng = np.random.default_rng(7)
    arm = limited(machine.arm, rng)
    for _ in range(5):
        q0, q1 = random_joints(arm, rng, (2,))
        found = shortest_duration(arm, partial(ptp, q0, q1), law)
        wanted = slope * (abs(q1 - q0) / arm.speed_limits).max()
        assert found == pytest.approx(wanted, rel=1e-12 if law is linear else 1e-5)


@pytest.mark.parametrize("law", [each for each, _ in LAWS.values()], ids=LAWS)
@pytest.mark.parametrize("machine", MACHINES, ids=repr)
def test_one_joint_reaches_its_limit_and_none_exceeds_it(machine, law):
    """A curve through four random postures, whose derivative SciPy knows."""
    rng = np.random.default_rng(11)
    arm = limited(machine.arm, rng)
    curve = CubicSpline([0, 0.3, 0.6, 1], random_joints(arm, rng, (4,)))
    T = shortest_duration(arm, curve, law)
    t = np.linspace(0, T, 100_001)
    middle, s = (t[1:] + t[:-1]) / 2, law(T)(t)
    ds = np.diff(s) / np.diff(t)
    used = abs(curve(law(T)(middle), 1) * ds[:, None]) / arm.speed_limits
    assert 1 - 1e-4 <= used.max() <= 1 + 1e-5


def test_speeds_at_a_corner_are_those_of_its_faster_side():
    """A line, a corner and a faster line: a mean over the corner would be too slow."""
    arm = Arm("two joints", IRB140.links[:2], IRB140.limits[:2], [2.0, 2.0])

    def corner(s):
        return np.where(s < 0.7, s, 0.7 + 5 * (s - 0.7))[:, None] * [1, -0.5]

    assert shortest_duration(arm, corner) == pytest.approx(5 / 2, rel=1e-8)


@pytest.mark.parametrize("path", [lin, lambda a, b, s: blend(a, VIA, b, 0.2, s)])
def test_straight_and_blended_motions_of_the_irb140(path):
    def joints(s):
        return follow(IRB140, IRB140.ik(path(START, GOAL, s)), 1)

    s = np.linspace(0, 1, 20_001)
    speeds = abs(np.diff(joints(s), axis=0)) / np.diff(s)[:, None] / IRB140.speed_limits
    found = shortest_duration(IRB140, joints)  # mean speeds never exceed the greatest speed
    assert found * (1 - 5e-4) <= speeds.max() <= found * (1 + 1e-5)


def test_the_times_of_document_000_are_those_of_this_function():
    rng = np.random.default_rng(0)
    speeds = np.array([0.2, 0.3, 0.4])
    arm = Arm("spbu", spbu_arm(5, 4).links, spbu_arm(5, 4).limits, speeds)
    for q0, q1 in rng.uniform(-1.5, 1.5, (20, 2, 3)):
        found = shortest_duration(arm, partial(ptp, q0, q1))
        assert found == pytest.approx(travel_time(q0, q1, speeds), rel=1e-12)


def test_half_the_speed_limits_take_twice_as_long():
    slow = Arm("slow", IRB140.links, IRB140.limits, IRB140.speed_limits / 2)
    path = partial(ptp, np.zeros(6), np.array([1.0, 0.5, -0.5, 2, 1, -3]))
    twice = 2 * shortest_duration(IRB140, path, quintic)
    assert shortest_duration(slow, path, quintic) == pytest.approx(twice, rel=1e-12)


def test_an_arm_that_stands_still_takes_no_time():
    assert shortest_duration(IRB140, partial(ptp, np.ones(6), np.ones(6)), quintic) == 0


def test_a_path_that_leaves_the_reach_has_no_duration():
    def joints(s):
        there = Transform(translation=(2.0, 0.0, 0.5))
        return follow(IRB140, IRB140.ik(lin(START, there, s)), 1)

    assert np.isnan(shortest_duration(IRB140, joints))


@pytest.mark.parametrize(
    "arm, path, law, kind, message",
    [
        (SCARA, np.zeros_like, linear, ValueError, "arm: wanted an arm with speed limits, got SC"),
        (IRB140, np.zeros(6), linear, TypeError, "path: wanted a function, got"),
        (IRB140, np.zeros_like, quintic(2), TypeError, r"law\(1.0\): wanted a TimeLaw"),
        (IRB140, lambda s: ptp(np.zeros(6), np.ones(6), s), 2.0, TypeError, "law: wanted a func"),
        (IRB140, lambda s: ptp(np.zeros(6), np.ones(6), s), abs, TypeError, r"law\(1.0\): wanted"),
        (IRB140, lambda s: s[1:, None] * np.ones(6), linear, ValueError, r"wanted shape \(257, 6"),
        (
            IRB140,
            lambda s: np.where(s < 0.3, s, s + 1)[:, None] * np.ones(6),
            linear,
            ValueError,
            "path: wanted one without jumps, got speeds that grow as steps get",
        ),
    ],
)
def test_wrong_calls_say_what_is_wanted(arm, path, law, kind, message):
    with pytest.raises(kind, match=message):
        shortest_duration(arm, path, law)
