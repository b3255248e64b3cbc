"""Methods that choose the posture of the three-lever arm: each behaves as documented, and none
moves the arm less than the method of least movement.

The gripper's positions come from `chain` (complex numbers), not from robokin; NumPy inverts the
Jacobians.
"""

import numpy as np
import pytest

from robokin import SCARA, deg, three_lever
from robokin.jobs import redundancy
from robokin.jobs.obstacles import distances
from robokin.jobs.redundancy import (
    distance_rule,
    equal_angles,
    gradient_projection,
    least_movement,
    methods,
    pseudo_inverse,
    race,
    random_choice,
)

ARMS = {"equal": three_lever(1.0), "unequal": three_lever((0.9, 1.1, 0.6))}
H = np.array([1.2, 1.2])
NAMES = list(methods(H, 0))
arms = pytest.mark.parametrize("arm", ARMS.values(), ids=ARMS)


def chain(arm, q):
    """The gripper's positions K (..., 2) in postures q (..., 3)."""
    gamma, beta, alpha = np.moveaxis(q, -1, 0)
    turns = np.stack([np.exp(1j * gamma), -np.exp(1j * beta), -np.exp(1j * alpha)])
    K = np.tensordot(arm.levers, np.cumprod(turns, axis=0), axes=1)
    return np.stack([K.real, K.imag], axis=-1)


def tasks(arm, n, seed=4):
    """Targets (n, 2) that the arm reaches within its limits, and the previous postures (n, 3)."""
    rng = np.random.default_rng(seed)
    K = chain(arm, rng.uniform(0, np.pi, (4 * n, 3)))
    K = K[~np.isnan(arm.alpha_range(K)[0])][:n]
    assert len(K) == n
    return K, rng.uniform(0, np.pi, (n, 3))


@arms
@pytest.mark.parametrize("name", NAMES)
def test_methods_reach_the_target_within_the_limits_or_return_nan(arm, name):
    """For a single task, no method moves the arm less than the method of least movement."""
    K, before = tasks(arm, 400)
    q = methods(H, 0)[name](arm, K, before)
    failed = np.isnan(q).any(axis=-1)
    assert np.isnan(q[failed]).all() and failed.mean() < 0.6
    assert abs(chain(arm, q[~failed]) - K[~failed]).max() < 1e-8
    assert q[~failed].min() > -1e-8 and q[~failed].max() < np.pi + 1e-8
    least = arm.least(K, before)[1]
    more = abs(q - before).sum(axis=-1) - least
    assert np.nanmin(more) > -1e-8
    if name == "least movement":
        assert not failed.any() and np.nanmax(more) < 1e-12
    else:  # the bound is not trivial: the other methods usually move the arm more
        assert np.nanmedian(more) > 0.01
    far = methods(H, 0)[name](arm, 4 * K, before)
    assert np.isnan(far[np.hypot(*(4 * K).T) > arm.reach]).all()


@arms
def test_pseudo_inverse_makes_the_shortest_step(arm):
    _, q = tasks(arm, 300)
    K, e = chain(arm, q), 1e-4 * np.array([0.6, -0.8])
    J = arm.jacobian(q)[:, :2]
    bent = np.linalg.svd(J, compute_uv=False)[:, 1] > 0.3
    step = pseudo_inverse(arm, K + e, q) - q
    wanted = (np.linalg.pinv(J) @ e[:, None])[..., 0]
    kept = bent & ~np.isnan(step).any(axis=-1)
    assert kept.sum() > 200 and abs(step - wanted)[kept].max() < 1e-6 < abs(wanted).max()


@arms
def test_gradient_projection_moves_the_joints_towards_mid_range(arm):
    K, before = tasks(arm, 400)
    plain, pulled = pseudo_inverse(arm, K, before), gradient_projection(arm, K, before)
    middle = np.pi / 2
    both = ~np.isnan(plain + pulled).any(axis=-1)
    away = [np.linalg.norm(q[both] - middle, axis=-1) for q in (plain, pulled)]
    assert (away[1] < away[0]).mean() > 0.9 and both.sum() > 150
    assert np.isnan(pulled).any(axis=-1).sum() < np.isnan(plain).any(axis=-1).sum()
    # nothing moves if the gripper is already at the target: the secondary objective acts only on
    # the way there
    stay = gradient_projection(arm, chain(arm, before), before)
    np.testing.assert_array_equal(stay, before)


@arms
def test_equal_angles_are_found_where_they_exist(arm):
    K, before = tasks(arm, 300)
    q = equal_angles(arm, K, before)
    np.testing.assert_allclose(q[:, 1], q[:, 2], rtol=0, atol=1e-9)
    # beta - alpha changes sign once along the family, or no posture has equal angles
    low, high = arm.alpha_range(K, limited=False)
    rows = arm.family(K[:, None], low[:, None] + (high - low)[:, None] * np.linspace(0, 1, 4001))
    signs = np.diff(np.sign(rows[..., 1] - rows[..., 2]), axis=1) != 0
    at = signs.argmax(axis=1)
    near = rows[np.arange(len(K)), at]
    kept = signs.any(axis=1) & (near[:, 0] > 1e-3) & (near[:, 0] < np.pi - 1e-3)
    assert kept.sum() > 200 and (signs.sum(axis=1) <= 1).all()
    assert abs(q - near)[kept].max() < 5e-3
    out = ~signs.any(axis=1) | (near[:, 0] < -1e-3) | (near[:, 0] > np.pi + 1e-3)
    assert np.isnan(q[out]).all() and out.any()


def test_random_choice_is_uniform():
    arm, K = ARMS["equal"], np.array([1.2, 0.9])
    low, high = arm.alpha_range(K)
    q = random_choice(5)(arm, np.tile(K, (4000, 1)), np.ones(3))
    share = np.sort((q[:, 2] - low) / (high - low))
    assert abs(share - (np.arange(4000) + 0.5) / 4000).max() < 0.03  # Kolmogorov-Smirnov test
    same = random_choice(5)(arm, np.tile(K, (4000, 1)), np.ones(3))
    np.testing.assert_array_equal(q, same)
    dice = random_choice(5)
    assert (dice(arm, K, np.ones(3)) != dice(arm, K, np.ones(3))).all()


@arms
def test_random_choice_avoids_the_obstacle_on_the_way(arm):
    """Distances are those of complex numbers from line segments, at 300 samples of each motion."""
    K, before = tasks(arm, 60)
    near = arm.lever / 7

    def nearest(a, b):
        q = a + (b - a) * np.linspace(0, 1, 300)[:, None]
        gamma, beta, alpha = np.moveaxis(q, -1, 0)
        turns = np.stack([np.exp(1j * gamma), -np.exp(1j * beta), -np.exp(1j * alpha)])
        levers = np.asarray(arm.levers)[:, None] * np.cumprod(turns, axis=0)
        to_H = complex(*H) - (np.cumsum(levers, axis=0) - levers)
        share = np.clip((to_H * levers.conj()).real / abs(levers) ** 2, 0, 1)
        return abs(to_H - share * levers).min()

    q = random_choice(5, H)(arm, K, before)
    failed = np.isnan(q).any(axis=-1)
    assert 5 < failed.sum() < 40
    reached = [nearest(a, b) for a, b in zip(before[~failed], q[~failed], strict=True)]
    assert min(reached) >= near
    plain = random_choice(5)(arm, K, before)
    assert min(nearest(a, b) for a, b in zip(before[~failed], plain[~failed], strict=True)) < near
    for place, a in zip(K[failed], before[failed], strict=True):  # few postures, if any, are safe
        rows = arm.family(place, np.linspace(*arm.alpha_range(place), 100))
        assert sum(nearest(a, b) > near for b in rows) < 10


@arms
def test_the_distance_rule_stops_the_nearest_approaching_lever(arm):
    K, before = tasks(arm, 200)
    np.testing.assert_array_equal(
        distance_rule((30.0, 30.0))(arm, K, before), pseudo_inverse(arm, K, before)
    )
    rng, stood = np.random.default_rng(6), 0
    for q in before:
        points, e = arm.points(q), 1e-5 * np.array([np.cos(q[0]), np.sin(q[0])])
        H = points[3] + rng.uniform(-0.4, 0.4, 2)
        d = distances(arm, q, H)
        free = (np.linalg.pinv(arm.jacobian(q)[:2]) @ e).clip(-0.1, 0.1)
        closer, share = d - distances(arm, q + free, H), d / arm.lever
        comes = (closer > 0) & (share < 0.5)
        step = distance_rule(H)(arm, points[3] + e, q) - q
        if not comes.any() or np.isnan(step).any() or np.linalg.cond(arm.jacobian(q)[:2]) > 5:
            continue
        if (abs(closer) < 1e-7).any() or (abs(share - 0.5) < 0.01).any():
            continue  # skip cases that rounding errors decide
        lever = np.where(comes, d, np.inf).argmin()
        alone = distances(arm, q + step * (np.arange(3) == lever), H)[lever] - d[lever]
        if share[lever] < 0.99 / 7:
            assert abs(step[lever]) > 1e-8 and alone > -1e-9
        elif share[lever] > 1.01 / 7:
            assert abs(step[lever]) < 0.01 * abs(step).max()
            stood += 1
    assert stood > 20


@arms
def test_joints_stop_at_their_limits(arm, monkeypatch):
    K, before = tasks(arm, 200)
    seen = []
    monkeypatch.setattr(
        redundancy, "distances", lambda arm, q, H: seen.append(q) or distances(arm, q, H)
    )
    distance_rule(H)(arm, K, before)
    on_the_way = np.array(seen[::3])  # each step tries three postures, the current one first
    assert on_the_way.min() == 0 and on_the_way.max() == np.pi and len(on_the_way) > 50


@arms
def test_batch_gives_the_same_results_as_single_tasks(arm):
    K, before = tasks(arm, 12)
    for name in NAMES:
        if name == "random choice":
            continue
        method = methods(H, 0)[name]
        batch = method(arm, K.reshape(3, 4, 2), before.reshape(3, 4, 3)).reshape(-1, 3)
        single = np.stack([method(arm, *task) for task in zip(K, before, strict=True)])
        np.testing.assert_allclose(batch, single, rtol=0, atol=1e-7)
        assert method(arm, K, before[0]).shape == (12, 3)


def test_each_task_of_a_race_starts_where_the_previous_one_ended():
    arm = ARMS["equal"]
    K, before = tasks(arm, 25)
    K[7] = (3.0, 0.2)  # out of reach, so no method moves the arm
    runs = race(methods(H, 0), arm, K, before[0])
    assert list(runs) == NAMES
    again, failures = methods(H, 0), 0
    for name, run in runs.items():
        stand = before[0]
        for i, target in enumerate(K):
            q = again[name](arm, target, stand)
            assert run.failed[i] == np.isnan(q).any()
            q = least_movement(arm, target, stand) if run.failed[i] else q
            np.testing.assert_array_equal(run.postures[i], q)
            if i == 7:
                assert np.isnan(q).all() and run.turns[i] == 0
                continue
            assert run.turns[i] == abs(q - stand).sum()
            stand = q
        assert run.failed[7] and run.seconds > 0
        failures += run.failed.sum() - 1
    assert failures > 0


def test_invalid_races_are_refused():
    K, before = tasks(ARMS["equal"], 3)
    all_of_them = methods(H, 0)
    with pytest.raises(TypeError, match="arm: wanted a ThreeLeverArm, got"):
        race(all_of_them, SCARA, K, before[0])
    for wrong in ((K[0], before[0]), (K[:0], before[0]), (K, before)):
        with pytest.raises(ValueError, match=r"targets and start: wanted shapes \(n, 2\) and"):
            race(all_of_them, ARMS["equal"], *wrong)
    with pytest.raises(ValueError, match=r"methods: wanted a dict of functions by name, got 3"):
        race(3, ARMS["equal"], K, before[0])
    dice = random_choice(5)
    with pytest.raises(ValueError, match="methods: wanted each function only once, got {'one'"):
        race({"one": dice, "two": dice}, ARMS["equal"], K, before[0])
    with pytest.warns(UserWarning, match="did you mean degrees"):
        pseudo_inverse(ARMS["equal"], K[0], before[0] / deg)
