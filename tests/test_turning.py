"""Three levers on a turning base: points in space, compared with a chain of complex numbers in a
plane that the tests rotate.
"""

import numpy as np
import pytest
from machines import SHAPES

from robokin import SCARA, deg, three_lever, turning_base, within
from robokin.show import joint_explorer

ARMS = {
    "equal": turning_base(three_lever(0.4)),
    "unequal": turning_base(three_lever((0.9, 1.1, 0.6))),
}
arms = pytest.mark.parametrize("arm", ARMS.values(), ids=ARMS)


def tip(arm, q):
    """The gripper's position K (..., 3): the levers are complex numbers in a plane whose real axis
    turns with the base and whose imaginary axis points up.
    """
    turn, gamma, beta, alpha = np.moveaxis(q, -1, 0)
    turns = np.stack([np.exp(1j * gamma), -np.exp(1j * beta), -np.exp(1j * alpha)])
    K = np.tensordot(arm.geometry.plane.levers, np.cumprod(turns, axis=0), axes=1)
    return np.stack([K.real * np.cos(turn), K.real * np.sin(turn), K.imag], axis=-1)


def postures(arm, shape, seed=1):
    return np.random.default_rng(seed).uniform(*arm.limits.T, (*shape, 4))


@arms
@pytest.mark.parametrize("shape", SHAPES)
def test_chain_is_the_rotated_planar_arm(arm, shape):
    q = postures(arm, shape)
    np.testing.assert_allclose(arm.fk(q).translation, tip(arm, q), rtol=0, atol=1e-14)
    turn = np.append(q[..., :1], np.zeros((*shape, 3)), axis=-1)
    elbow = arm.frames(q)[..., 3].translation  # point B, where joint 3 is
    aside = elbow[..., 1] * np.cos(turn[..., 0]) - elbow[..., 0] * np.sin(turn[..., 0])
    assert abs(aside).max() < 1e-14 and arm.limits.shape == (4, 2)


@arms
@pytest.mark.parametrize("shape", SHAPES)
def test_least_movement_reaches_the_point_within_the_limits(arm, shape):
    points, before = tip(arm, postures(arm, shape)), postures(arm, shape, seed=2)
    q, S = arm.least(points, before)
    assert q.shape == (*shape, 4) and S.shape == shape
    n = ~np.isnan(S)
    assert abs(tip(arm, q[n]) - points[n]).max(initial=0) < 1e-13
    assert within(arm, q[n]).all()
    np.testing.assert_allclose(abs(q - before).sum(axis=-1)[n], S[n], rtol=0, atol=1e-13)


@arms
def test_no_other_posture_moves_less(arm):
    """Brute force over both base angles and 2001 values of alpha; each base angle is sometimes
    better.
    """
    points, before = tip(arm, postures(arm, (300,))), postures(arm, (300,), seed=2)
    plane = arm.geometry.plane
    q, S = arm.least(points, before)
    away = np.hypot(points[:, 0], points[:, 1])
    front = np.arctan2(points[:, 1], points[:, 0])
    back = np.where(front > 0, front - np.pi, front + np.pi)
    sums = []
    for turn, ahead in ((front, away), (back, -away)):
        low, high = plane.alpha_range(np.stack([ahead, points[:, 2]], axis=-1))
        rows = plane.family(np.stack([ahead, points[:, 2]], axis=-1), np.linspace(low, high, 2001))
        moved = abs(rows - before[:, 1:]).sum(axis=-1) + abs(turn - before[:, 0])
        sums.append(np.where(np.isnan(moved), np.inf, moved).min(axis=0))
    exists = np.isfinite(sums).any(axis=0)
    np.testing.assert_array_equal(exists, ~np.isnan(S))
    best = np.min(sums, axis=0)[exists]
    assert (best - S[exists]).min() > -1e-12 and (best - S[exists]).max() < 0.05
    behind = abs(np.cos(q[exists, 0] - front[exists]) + 1) < 1e-9
    assert 0.2 < behind.mean() < 0.8 and exists.sum() > 150
    assert np.isfinite(sums).sum(axis=0).max() == 2


def test_base_does_not_turn_for_points_on_the_axis():
    arm, before = ARMS["unequal"], np.array([1.1, 1.0, 2.0, 2.0])
    q, _ = arm.least((0, 0, 1.7), before)
    assert q[0] == 1.1
    np.testing.assert_allclose(tip(arm, q), (0, 0, 1.7), rtol=0, atol=1e-14)
    turns, places = arm.seen((-0.0, 0.0, 1.7))
    assert turns.tolist() == [0, np.pi] and (places == [0, 1.7]).all()
    assert np.isnan(arm.least((0, 0, 2.7), before)[0]).all()


def test_turning_arm_works_in_an_explorer_and_refuses_invalid_arguments():
    arm = ARMS["equal"]
    assert "on a turning base" in joint_explorer(arm, [0.5, 1.0, 2.0, 2.0]).data["title"]
    with pytest.raises(TypeError, match="arm: wanted a ThreeLeverArm, got"):
        turning_base(SCARA)
    with pytest.raises(ValueError, match=r"point: wanted shape \(..., 3\)"):
        arm.least((1, 1), np.ones(4))
    with pytest.raises(ValueError, match=r"previous: wanted shape \(..., 4\)"):
        arm.least((1, 1, 0), np.ones(3))
    with pytest.warns(UserWarning, match="previous: 120 rad"):
        arm.least((0.6, 0.2, 0.3), [1, 100, 110, 120])
    assert arm.limits[0].tolist() == [-180 * deg, 180 * deg]
