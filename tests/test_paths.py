"""Paths: LIN, PTP, LIN-LIN and the blend with both kinds of corner."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from machines import SHAPES

from robokin import (
    IRB140,
    Quaternion,
    ScaraPose,
    Transform,
    blend,
    deg,
    follow,
    lin,
    lin_lin,
    mm,
    ptp,
    quintic,
)

CORNERS = ["parabola", "quintic"]
corners = pytest.mark.parametrize("corner", CORNERS)
# the distance from via to the curve, as a fraction of the distance from via to the corner's chord
NEARNESS = {"parabola": 1 / 2, "quintic": 3 / 8}


def pose(x, y, z, angle, axis):
    return Transform(Quaternion.from_angle_axis(angle * deg, axis), np.array([x, y, z]) * mm)


START = pose(200, 400, 200, 90, (-1, 0, 0))
VIA = pose(650, -100, 800, 45, (0, 1, 0))
GOAL = pose(300, 300, 500, 90, (0, 1, 0))


def difference(a, b):
    return abs(a.as_matrix() - b.as_matrix()).max()


def twist(a, b):
    """The translation and the rotation vector from pose a to pose b: (..., 6)."""
    angle, axis = (b.rotation @ a.rotation.inverse()).as_angle_axis()
    return np.concatenate([b.translation - a.translation, axis * angle[..., None]], axis=-1)


def test_lin_is_straight_at_constant_linear_and_angular_velocity():
    s = np.linspace(0, 1, 101)
    T = lin(START, GOAL, s)
    steps = twist(T[:-1], T[1:])
    assert np.ptp(steps, axis=0).max() < 1e-14
    assert np.allclose(steps.sum(0)[:3], GOAL.translation - START.translation, rtol=0, atol=1e-14)
    assert np.allclose(steps.sum(0), twist(START, GOAL), rtol=0, atol=1e-13)


@pytest.mark.parametrize("shape", SHAPES)
def test_ptp_interpolates_all_joints_linearly(shape):
    rng = np.random.default_rng(32)
    q0, q1, s = rng.normal(size=(*shape, 6)), rng.normal(size=(*shape, 6)), rng.uniform(size=shape)
    assert np.allclose(
        ptp(q0, q1, s), q0 * (1 - s[..., None]) + q1 * s[..., None], rtol=0, atol=1e-15
    )
    assert ptp(q0, q1, s).shape == q0.shape
    assert (ptp(q0, q1, 0) == q0).all() and np.allclose(ptp(q0, q1, 1), q1, rtol=0, atol=1e-15)


def test_ptp_does_not_wrap_angles():
    assert np.allclose(ptp([0.0, 7.0], [10.0, -7.0], [0.0, 0.5, 1.0]), [[0, 7], [5, 0], [10, -7]])


def test_ptp_between_postures_in_degrees_causes_a_warning(recwarn):
    ptp(np.zeros(6), np.full(6, 2 * np.pi), 0.5)
    ptp([0.0, -12.0], [12.0, 0.0], 0.5)
    assert not recwarn.list
    for ends, name in ((([0.0, 90.0], [1.0, 1.0]), "q0"), (([1.0, 1.0], [-90.0, 0.0]), "q1")):
        with pytest.warns(UserWarning, match=f"{name}: 90 rad is many turns; did you mean degrees"):
            ptp(*ends, 0.5)


def test_lin_lin_consists_of_two_lines():
    s = np.linspace(0, 1, 101)
    T = lin_lin(START, VIA, GOAL, s)
    first, second = s <= 0.5, s >= 0.5
    assert difference(T[first], lin(START, VIA, 2 * s[first])) < 1e-15
    assert difference(T[second], lin(VIA, GOAL, 2 * s[second] - 1)) < 1e-15
    assert difference(T[50], VIA) < 1e-15


@corners
@pytest.mark.parametrize("b", [0, 1e-300, 1e-12, 1e-3, 0.1, 0.25, 0.5])
def test_blend_matches_the_lines_outside_its_corner(corner, b):
    s = np.concatenate([np.linspace(0, 1, 401), [0.5 - b, 0.5 + b]])
    T = blend(START, VIA, GOAL, b, s, corner)
    assert difference(T[0], START) < 1e-15 and difference(T[400], GOAL) < 1e-15
    lines = abs(s - 0.5) >= b
    assert difference(T[lines], lin_lin(START, VIA, GOAL, s[lines])) < 1e-14


@corners
def test_blend_of_zero_equals_lin_lin(corner):
    s = np.linspace(0, 1, 1001)
    assert difference(blend(START, VIA, GOAL, 0.0, s, corner), lin_lin(START, VIA, GOAL, s)) == 0


@corners
@pytest.mark.parametrize("b", [0.05, 0.1, 0.5])
def test_distance_of_the_path_from_the_via_point_matches_the_errata(corner, b):
    """Errata S1-l: the middle of the parabola is |a - 2 b + c| / 4 from via, which is half of the
    distance to the chord; the middle of the quintic is at 3/4 of the parabola's distance.
    """
    first, last = lin(START, VIA, 1 - 2 * b).translation, lin(VIA, GOAL, 2 * b).translation
    chord = np.linalg.norm((first + last) / 2 - VIA.translation)
    middle = blend(START, VIA, GOAL, b, 0.5, corner).translation
    assert abs(np.linalg.norm(middle - VIA.translation) - NEARNESS[corner] * chord) < 1e-15
    if corner == "parabola":
        assert abs(np.linalg.norm(first - 2 * VIA.translation + last) / 4 - chord / 2) < 1e-15


def bernstein(points, x):
    """A Bezier curve computed from Bernstein polynomials, not with de Casteljau's algorithm."""
    from math import comb

    n = len(points) - 1
    return sum(comb(n, k) * x**k * (1 - x) ** (n - k) * p for k, p in enumerate(points))


@corners
def test_corner_is_the_bezier_curve_of_its_control_poses(corner):
    b, x = 0.2, np.linspace(0, 1, 51)[:, None]
    first, via, last = (
        lin(START, VIA, 1 - 2 * b).translation,
        VIA.translation,
        lin(VIA, GOAL, 2 * b).translation,
    )
    points = (
        [first, via, last]
        if corner == "parabola"
        else [
            first,
            first + 0.4 * (via - first),
            first + 0.8 * (via - first),
            last + 0.8 * (via - last),
            last + 0.4 * (via - last),
            last,
        ]
    )
    s = 0.5 - b + 2 * b * x[:, 0]
    assert np.allclose(
        blend(START, VIA, GOAL, b, s, corner).translation, bernstein(points, x), rtol=0, atol=1e-14
    )
    # Rotations about a common axis add like numbers, so the same polynomials give the angle.
    turned = [
        Transform(Quaternion.from_angle_axis(angle, (0, 0.6, 0.8))) for angle in (0.3, 1.5, 0.9)
    ]
    a, v, c = 0.3 + (1 - 2 * b) * 1.2, 1.5, 1.5 - 2 * b * 0.6
    angles = (
        [a, v, c]
        if corner == "parabola"
        else [a, a + 0.4 * (v - a), a + 0.8 * (v - a), c + 0.8 * (v - c), c + 0.4 * (v - c), c]
    )
    angle = blend(*turned, b, s, corner).rotation.as_angle_axis()[0]
    assert np.allclose(angle, bernstein(angles, x[:, 0]), rtol=0, atol=1e-13)


def jump(f, at, h, order):
    """The jump in a derivative of f at one point, from samples on both sides (second
    order in h).
    """
    weights = {1: [-1.5, 2, -0.5], 2: [2, -5, 4, -1]}[order]
    k = np.arange(len(weights)) * h
    after = np.tensordot(weights, f(at + k), 1) / h**order
    before = np.tensordot(weights, f(at - k), 1) / h**order * (-1) ** order
    return abs(after - before).max()


@pytest.mark.parametrize("b", [0.05, 0.1, 0.25, 0.4])
@pytest.mark.parametrize("corner, order", [("parabola", 1), ("quintic", 1), ("quintic", 2)])
@pytest.mark.parametrize("what", ["joints", "pose"])
def test_derivative_is_continuous_at_the_ends_of_the_corner(what, corner, order, b):
    """The test measures C1 and C2 continuity, also of rotations: the difference in q' (q'') across
    each end of the corner is proportional to the step.
    """
    row = IRB140.branch(1, 1, -1)

    def f(s):
        T = blend(START, VIA, GOAL, b, s, corner)
        if what == "joints":
            return follow(IRB140, IRB140.ik(T), row)
        return np.concatenate([T.translation, twist(VIA, T)[:, 3:]], axis=-1)

    for end in (0.5 - b, 0.5 + b):
        jumps = []
        for h in (4e-4, 2e-4, 1e-4):
            p = f(end + h * np.arange(-4, 5))
            d = np.diff(p, n=order, axis=0) / h**order
            # the derivative just after the end minus the one just before it
            jumps.append(abs(d[-3 + order] - d[2]).max())
        assert jumps[0] / jumps[1] > 1.75 and jumps[1] / jumps[2] > 1.75, jumps
        assert jump(f, end, 1e-3, order) < 0.02 * max(
            abs(np.diff(f(np.linspace(0, 1, 101)), n=order, axis=0)).max() * 100**order, 1
        )


@pytest.mark.parametrize(
    "corner, order, b", [("parabola", 2, 0.1), ("quintic", 3, 0.1), ("parabola", 1, 0.0)]
)
def test_corner_is_no_smoother_than_documented(corner, order, b):
    def f(s):
        return blend(START, VIA, GOAL, b, s, corner).translation

    h = 1e-3
    d = np.diff(f(0.5 - b + h * np.arange(-6, 7)), n=order, axis=0) / h**order
    middle = (len(d) - 1) / 2
    step = abs(d[int(np.ceil(middle)) + order] - d[int(middle) - order]).max()
    assert step > 0.5


def test_motion_with_a_smooth_law_rests_at_both_ends():
    law, t = quintic(20.0), np.linspace(0, 20, 2001)
    T = blend(START, VIA, GOAL, 0.1, law(t), "quintic")
    q = follow(IRB140, IRB140.ik(T), IRB140.branch(1, 1, -1))
    v, a = np.diff(q, axis=0) / 0.01, np.diff(q, n=2, axis=0) / 1e-4
    assert abs(v[[0, -1]]).max() < 1e-5 and abs(a[[0, -1]]).max() < 1e-2
    assert abs(v).max() > 0.1 and abs(np.diff(a, axis=0)).max() < 0.02 * abs(a).max()


@corners
def test_blend_fractions_broadcast_with_s(corner):
    b, s = np.linspace(0, 0.5, 6), np.linspace(0, 1, 41)
    T = blend(START, VIA, GOAL, b[:, None], s, corner)
    assert T.shape == (6, 41)
    for i in range(6):
        assert difference(T[i], blend(START, VIA, GOAL, b[i], s, corner)) == 0
    pairs = blend(START, VIA, GOAL, b, np.linspace(0, 1, 6), corner)
    assert pairs.shape == (6,)
    assert difference(pairs[3], blend(START, VIA, GOAL, b[3], 0.6, corner)) < 1e-15


@corners
def test_poses_can_be_batches(corner):
    starts = Transform(START.rotation, START.translation + np.arange(3)[:, None] * 0.05)
    s = np.linspace(0, 1, 11)
    T = blend(starts[:, None], VIA, GOAL, 0.2, s, corner)
    assert T.shape == (3, 11)
    for i in range(3):
        assert difference(T[i], blend(starts[i], VIA, GOAL, 0.2, s, corner)) == 0


@corners
def test_anything_with_lerp_can_be_blended(corner):
    """The angle of a SCARA target is not wrapped, so half a turn has a direction (errata S1-t)."""
    a, b, c = (
        ScaraPose((0.1, 0, 0), 0.0),
        ScaraPose((0.2, 0, 0), np.pi),
        ScaraPose((0.2, 0.1, 0), 3 * np.pi),
    )
    s = np.linspace(0, 1, 101)
    T = blend(a, b, c, 0.2, s, corner)
    assert (np.diff(T.angle) > 0).all() and abs(T.angle[-1] - 3 * np.pi) < 1e-14


@corners
def test_start_can_equal_goal(corner):
    s = np.linspace(0, 1, 21)
    for T in (
        lin(START, START, s),
        lin_lin(START, START, START, s),
        blend(START, START, START, 0.2, s, corner),
    ):
        assert difference(T, START) < 1e-15
    there_and_back = blend(START, VIA, START, 0.2, s, corner)
    assert difference(there_and_back, there_and_back[::-1]) < 1e-14
    assert (
        difference(there_and_back[0], START) < 1e-15 and difference(there_and_back[10], START) > 0.1
    )
    assert (ptp(np.ones(6), np.ones(6), s) == 1).all()


@corners
def test_via_point_on_the_line_does_not_change_the_motion(corner):
    """If via is halfway between start and goal, there is no corner, and a blend does not change the
    motion.
    """
    s = np.linspace(0, 1, 101)
    T = blend(START, lin(START, GOAL, 0.5), GOAL, 0.3, s, corner)
    assert difference(T, lin(START, GOAL, s)) < 1e-14


@settings(max_examples=60, deadline=None)
@given(
    st.integers(0, 2**32 - 1), st.floats(0, 0.5, allow_subnormal=False), st.sampled_from(CORNERS)
)
def test_every_blend_is_continuous_and_stays_between_its_poses(seed, b, corner):
    rng = np.random.default_rng(seed)
    wxyz = rng.normal(size=(3, 4))
    points = Transform(
        Quaternion(wxyz / np.linalg.norm(wxyz, axis=-1, keepdims=True)), rng.normal(size=(3, 3))
    )
    s = np.linspace(0, 1, 2001)
    T = blend(points[0], points[1], points[2], b, s, corner)
    lengths = [
        np.linalg.norm(twist(points[i], points[i + 1])[part])
        for i in (0, 1)
        for part in (slice(0, 3), slice(3, 6))
    ]
    steps = twist(T[:-1], T[1:])
    # the speed of a quintic exceeds that of the lines by at most the ratio of its control polygon
    slack = 2.6 / 1000
    assert (
        np.linalg.norm(steps[:, :3], axis=-1).max() <= slack * max(lengths[0], lengths[2]) + 1e-12
    )
    assert (
        np.linalg.norm(steps[:, 3:], axis=-1).max()
        <= 2 * slack * max(lengths[1], lengths[3]) + 1e-12
    )
    assert np.allclose(np.linalg.norm(T.rotation.wxyz, axis=-1), 1, rtol=0, atol=1e-14)
    low, high = points.translation.min(0), points.translation.max(0)
    assert ((T.translation >= low - 1e-12) & (T.translation <= high + 1e-12)).all()
