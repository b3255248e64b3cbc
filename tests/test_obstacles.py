"""A point obstacle near the three-lever arm: reference cases, guaranteed clearance, and plans that
keep their distance.

An independent model of the arm, in complex numbers, checks the distances. ROBOKIN_TASKS=2000 runs
all random tasks; tests/benchmarks/obstacle_tasks.py prints their results.
"""

import os
import re

import numpy as np
import pytest
from machines import oracle

from robokin import SCARA, deg, loader_arm, three_lever, within
from robokin.jobs.obstacles import (
    CIRCLES,
    LEVERS,
    TOLERANCE,
    WORK,
    Plan,
    along,
    clearance,
    collision,
    distances,
    in_quadrilateral,
    keeps,
    plan,
    swept,
    via_path,
    via_points,
    way_round,
)
from robokin.jobs.obstacles.ways import nearest_approach, unchecked_path

CASES = oracle("planar_obstacle")["cases"]
TASKS = int(os.environ.get("ROBOKIN_TASKS", 60))
ARM = three_lever(1.0)
KEPT = ARM.lever / 7
cases = pytest.mark.parametrize("case", CASES)
# The least S (radians) for some of the random tasks, found by brute force: SciPy's Dijkstra, on a
# grid of 2 degrees whose edges keep the distance L/7 (tests/benchmarks/obstacle_tasks.py,
# `brute_force`).
BRUTE = {
    0: 2.3075,
    2: 3.3259,
    3: 2.4217,
    5: 3.3916,
    6: 5.2527,
    7: 3.8858,
    8: 5.6599,
    9: 4.6517,
    10: 1.294,
    11: 2.2095,
    12: 2.4412,
    13: 4.8266,
    14: 4.6026,
    15: 2.1133,
    16: 3.6588,
    17: 7.0104,
    20: 5.6286,
    22: 3.406,
    23: 3.0209,
}


def seen(q, H, L=1.0):
    """The distances (..., 3) of H from the levers in postures q (..., 3), calculated with complex
    numbers.
    """
    gamma, beta, alpha = np.moveaxis(np.asarray(q), -1, 0)
    lever = L * np.exp(1j * gamma)
    start, found = 0 * lever, []
    for turn in (beta, alpha, None):
        # in these coordinates the lever extends from 0 to 1 on the real axis
        seen_from_lever = (complex(*H) - start) / lever
        foot = np.clip(seen_from_lever.real, 0, 1)
        found.append(L * abs(seen_from_lever - foot))
        start = start + lever
        lever = None if turn is None else -lever * np.exp(1j * turn)
    return np.stack(found, axis=-1)


def dense(path, samples=4001):
    """Postures (parts, samples, 3) on every part of a path."""
    path = np.asarray(path)
    return path[:-1, None] + np.linspace(0, 1, samples)[:, None] * np.diff(path, axis=0)[:, None]


def passes_over(q0, q1, H):
    """For each point of H (n, 2): whether lever AK passes over it on the direct path
    from q0 to q1.
    """
    gamma, beta, alpha = dense([q0, q1], 721)[0].T
    first, second, third = (
        np.exp(1j * gamma),
        -np.exp(1j * (gamma + beta)),
        np.exp(1j * (gamma + beta + alpha)),
    )
    beside = (H @ [1, 1j])[:, None] - first - second
    beside = beside / third
    changes = (beside.imag[:, 1:] > 0) != (beside.imag[:, :-1] > 0)
    foot = (beside.real[:, 1:] + beside.real[:, :-1]) / 2
    return (changes & (foot > 0.01) & (foot < 0.99)).any(axis=1)


def tasks(n, seed=5, limited=True):
    """Yield n random tasks (q0, target, obstacle) in which AK sweeps over the obstacle on the
    direct path, and L < OH < 3 L.
    """
    rng = np.random.default_rng(seed)

    def ring(count):
        r, phi = rng.uniform(1, 3, count), rng.uniform(-np.pi, np.pi, count)
        return np.stack([r * np.cos(phi), r * np.sin(phi)], axis=-1)

    while n:
        q0, K1 = rng.uniform(0, np.pi, 3), ring(1)[0]
        q1, _ = ARM.least(K1, q0, limited)
        if np.isnan(q1).any() or not 1 < np.hypot(*ARM.points(q0)[3]) < 3:
            continue
        H = ring(1)
        if passes_over(q0, q1, H)[0]:
            yield q0, K1, H[0]
            n -= 1


@cases
def test_clearance_and_via_points_match_the_reference_cases(case):
    q0, q1, H = np.array(case["previous"])[::-1], np.array(case["new"])[::-1], case["H"]
    for q, names in ((q0, ("A", "K")), (q1, ("A1", "K1"))):
        for point, name in zip(ARM.points(q)[2:], names, strict=True):
            np.testing.assert_allclose(point, case[name], rtol=0, atol=1e-12)
    np.testing.assert_allclose(ARM.least(case["K1"], q0, limited=False)[0], q1, rtol=0, atol=1e-6)
    assert in_quadrilateral(ARM, q0, q1, H)["AK"] == case["inside_quadrilateral"]
    assert swept(ARM, q0, q1, H)["AK"] == case["swept_by_AK_joint_linear"]
    # if AK sweeps over H, the reference is only the least of its samples, at most 0.0007
    if not case["swept_by_AK_joint_linear"]:
        least = clearance(ARM, [q0, q1], H)[0, 2]
        assert 0 < case["min_distance_AK_joint_linear"] - least < 5e-6
    K2, K3 = via_points(case["K"], case["K1"], H, case["L"] / 7)
    np.testing.assert_allclose([K2, K3], [case["K2"], case["K3"]], rtol=0, atol=1e-12)
    # the reference's clearance is that of the straight lines K - K2 - K3 - K1
    corners = np.array([case["K"], K2, K3, case["K1"]]) @ [1, 1j]
    for a, b, reference in zip(corners, corners[1:], case["clearance"], strict=False):
        foot = np.clip(((complex(*H) - a) / (b - a)).real, 0, 1)
        assert abs(complex(*H) - a - foot * (b - a)) == pytest.approx(reference, abs=1e-9)
    path = via_path(ARM, q0, case["K1"], H, limited=False)
    assert np.isnan(path).any() != (case["K2_reachable"] and case["K3_reachable"])
    if not np.isnan(path).any():
        np.testing.assert_allclose(
            ARM.points(path)[:, 3], [case["K"], K2, K3, case["K1"]], rtol=0, atol=1e-12
        )


def test_via_points_are_at_right_angles_and_on_the_side_of_the_base():
    """Seen from the obstacle, a via point is at right angles to its end of the path. Errata S3-m:
    the printed formulas give (1.556, 1.131) and (1.429, 0.876) here; neither is at right angles,
    and one is on the wrong side.
    """
    H, K, K1 = np.array([1.5, 1]), np.array([1.2, 1.7]), np.array([1.9, 0.3])
    K2, K3 = via_points(K, K1, H, 1 / 7)
    np.testing.assert_allclose(
        [K2, K3], [(1.368693567, 0.943725814), (1.375965265, 0.929123009)], atol=1e-9
    )
    for via, end in ((K2, K), (K3, K1)):
        assert abs((via - H) @ (end - H)) < 1e-15 and np.hypot(*(via - H)) == pytest.approx(
            1 / 7, abs=1e-15
        )
        assert (via - H) @ H < 0
    with pytest.raises(ValueError, match="different from K1"):
        via_points(K, H, H, 1 / 7)


def test_quadrilateral_test_is_correct_for_any_quadrilateral():
    """Errata S3-k: the printed inequalities miss a point inside. Corners and sides
    count as inside.
    """
    q0 = ARM.least((0.8668, -0.5041), [1.2, 2.0, 1.0], limited=False)[0]
    q1 = ARM.least((1.2804, 0.1854), [1.5, 2.0, 1.0], limited=False)[0]
    (_, B, A, K), (_, B1, A1, K1) = ARM.points(q0), ARM.points(q1)
    H = np.stack([A, K, (A + K) / 2, (3 * A + K1 + K + A1) / 6, 2 * K - A, (5, 5)])
    found = in_quadrilateral(ARM, q0, q1, H)
    assert found["AK"].tolist() == [True, True, True, True, False, False]
    assert found["BA"].shape == (6,) and found["BA"][0]
    # compared with the winding number of the outline around the point, for a simple and a
    # self-intersecting outline
    rng = np.random.default_rng(4)
    for corners in (np.stack([A, K, K1, A1]), np.stack([B, A, A1, B1])):
        points = corners.min(axis=0) + rng.uniform(-0.1, 1.1, (500, 2)) * np.ptp(corners, axis=0)
        about = (corners @ [1, 1j])[:, None] - points @ [1, 1j]
        winding = np.round(np.angle(np.roll(about, -1, axis=0) / about).sum(axis=0) / (2 * np.pi))
        name = "AK" if corners[0] is not B and (corners[0] == A).all() else "BA"
        np.testing.assert_array_equal(in_quadrilateral(ARM, q0, q1, points)[name], winding % 2 == 1)


@pytest.mark.parametrize("L", [1.0, 0.35])
def test_clearance_is_a_tight_bound(L):
    rng, arm = np.random.default_rng(6), three_lever(L)
    for _ in range(60):
        path, H = rng.uniform(0, np.pi, (4, 3)), L * rng.uniform(-3, 3, 2)
        if rng.random() < 0.5:  # some joints do not move, as at a kink of S
            path[1:] = np.where(rng.random((3, 3)) < 0.6, path[0], path[1:])
        sampled = seen(dense(path), H, L)
        bound = clearance(arm, path, H)
        assert bound.shape == (3, 3) and (bound <= sampled.min(axis=1)).all()
        fast = abs(np.diff(path, axis=0)).sum(axis=1, keepdims=True) * 3 * L / 4000
        assert (sampled.min(axis=1) - bound <= fast + 2e-6 * L).all()
        np.testing.assert_allclose(distances(arm, path, H), seen(path, H, L), rtol=0, atol=1e-14)
        # the clearance is accurate to 1e-6 of a lever, and `keeps` is more accurate
        least, slack = bound.min(axis=1), 2.1e-6 * L
        for distance in least[least > slack]:
            for asked in (distance - slack, distance + slack):
                kept = keeps(arm, path[:-1], path[1:], H, asked)
                np.testing.assert_array_equal(kept, least > asked)


@pytest.mark.parametrize("levers", [(0.9, 1.1, 0.6), (0.5, 0.3, 1.6), (1.7, 0.9, 0.2)])
def test_levers_of_different_lengths_keep_their_clearance(levers):
    """The clearance is a tight bound here too, compared with positions from `arm.points`, and plans
    keep their distance.
    """
    rng, arm = np.random.default_rng(16), three_lever(levers)
    share = np.linspace(0, 1, 301)[:, None]

    def least_seen(q, H):
        O_B_A_K = arm.points(q)  # test_planar.py checks these points
        start, end = O_B_A_K[..., :-1, :], O_B_A_K[..., 1:, :]
        along = ((H - start) * (end - start)).sum(axis=-1) / np.array(levers) ** 2
        foot = start + np.clip(along, 0, 1)[..., None] * (end - start)
        return np.linalg.norm(foot - H, axis=-1)

    for _ in range(60):
        (a, b), H = rng.uniform(0, np.pi, (2, 3)), rng.uniform(-2.5, 2.5, 2)
        found = clearance(arm, [a, b], H)[0]
        sampled = least_seen(a + share * (b - a), H).min(axis=0)
        assert (found <= sampled).all()
        assert (sampled - found <= abs(b - a).sum() * sum(levers) / 300).all()
        np.testing.assert_allclose(distances(arm, a, H), least_seen(a, H), rtol=0, atol=1e-14)
    kept = 0
    for _ in range(50):
        q0 = rng.uniform(0.3, 2.8, 3)
        target, H = arm.points(rng.uniform(0.3, 2.8, (2, 3)))[:, 3]
        answer = plan(arm, q0, target, H)
        if answer.found:
            path = dense(answer.path, 301)
            assert least_seen(path, H).min() >= arm.lever / 7
            np.testing.assert_allclose(arm.points(answer.path[-1])[3], target, rtol=0, atol=1e-9)
            kept += answer.way != "direct"
    assert kept


def test_clearance_is_zero_for_a_lever_that_passes_over_the_obstacle():
    q0, q1 = np.array([100, 120, 130]) * deg, np.array([60, 120, 130]) * deg
    for lever, u in ((0, 0.5), (1, 0.3), (2, 0.9)):
        O_B_A_K = ARM.points((q0 + q1) / 2)
        H = O_B_A_K[lever] + u * (O_B_A_K[lever + 1] - O_B_A_K[lever])
        assert swept(ARM, q0, q1, H)[LEVERS[lever]]
        assert clearance(ARM, [q0, q1], H)[0, lever] == 0
        assert not keeps(ARM, q0, q1, H, 1e-6)
    assert not any(swept(ARM, q0, q1, (-2.0, -2.0)).values())


@pytest.mark.filterwarnings("ignore:.*degrees:UserWarning")
def test_clearance_is_correct_for_known_motions():
    """Only joint 1 of the arm turns: lever OB moves past the obstacle or stops before it, and the
    rest of the arm is rigid.
    """
    q, H = np.array([0.2, 2.0, 2.5]), np.array([0.3, 0.9])
    to = np.arctan2(H[1], H[0])  # 71.6 degrees
    for turn in (0.5, 1.0, 1.3, 2.0, 40.0):
        end = q + [turn, 0, 0]
        angle = max(to - end[0], 0.0)
        least = np.hypot(*H) * np.sin(angle)
        found = clearance(ARM, [q, end], H)[0]
        assert least - 2e-6 <= found[0] <= least, turn
        # the other levers, compared with samples of their rotation about the base
        s = np.linspace(0, min(turn, 2 * np.pi), 40_001)[:, None]
        sampled = seen(q + s * [1, 0, 0], H).min(axis=0)
        assert (sampled - found <= 2e-4).all() and (sampled >= found).all()


@pytest.mark.parametrize("H", [(0, 0), (1e-9, 0), (0.01, -0.02), (1e3, 2e3)])
def test_clearance_is_found_where_the_distance_hardly_changes(H):
    """The levers rotate about the base, and the obstacle is at or near the base or very far from
    it. The distances hardly differ, but the bisection must end.
    """
    a, b = np.array([0.1, 1.1, 1.9]), np.array([3.0, 1.1, 1.9])
    least = clearance(ARM, [a, b], H)[0]
    sampled = seen(dense([a, b], 100_001)[0], H).min(axis=0)
    assert (least <= sampled).all() and (sampled - least <= 2.1e-6).all()
    held = sampled.min() + 1e-4
    assert not keeps(ARM, a, b, H, held) and (held < 0.1 or keeps(ARM, a, b, H, held - 2e-4))


def test_distance_equal_to_the_clearance_of_a_resting_arm_counts_as_kept():
    """A required distance that equals the clearance counts as kept; the next larger floating-point
    number does not.
    """
    q, H = np.array([1.0, 2.0, 1.5]), (1.3, 1.2)
    least = seen(q, H).min()
    near = distances(ARM, q, H).min()
    assert near == pytest.approx(least, abs=1e-15)
    assert keeps(ARM, q, q, H, near) and not keeps(ARM, q, q, H, np.nextafter(near, 9))
    np.testing.assert_allclose(
        clearance(ARM, [q, q, q], H), [seen(q, H) - TOLERANCE] * 2, rtol=0, atol=1e-15
    )


def test_distances_accept_batches_of_postures_and_obstacles():
    rng = np.random.default_rng(12)
    q, H = rng.uniform(0, np.pi, (4, 1, 3)), rng.uniform(-2, 2, (5, 2))
    found = distances(ARM, q, H)
    assert found.shape == (4, 5, 3)
    for i in range(4):
        for k in range(5):
            np.testing.assert_allclose(found[i, k], seen(q[i, 0], H[k]), atol=1e-14)
    np.testing.assert_array_equal(distances(ARM, q[0, 0], H), found[0])
    np.testing.assert_array_equal(distances(ARM, q[:, 0], (*H[0], 0.0)), found[:, 0])
    missing = distances(ARM, [[np.nan] * 3, [1, 1, 1]], H[0])
    assert np.isnan(missing[0]).all() and np.isfinite(missing[1]).all()
    a, b = rng.uniform(0, np.pi, (2, 1, 3)), rng.uniform(0, np.pi, (3, 3))
    H = (0.9, 1.0)
    kept = keeps(ARM, a, b, H, 0.2)
    assert kept.shape == (2, 3) and kept.any() and not kept.all()
    for i in range(2):
        for k in range(3):
            one = keeps(ARM, a[i, 0], b[k], H, 0.2)
            assert one.shape == () and one == kept[i, k]
            assert one == (clearance(ARM, [a[i, 0], b[k]], H).min() >= 0.2)


def test_clearance_does_not_depend_on_the_size_of_the_blocks(monkeypatch):
    """The result is the same whether all pieces are processed together or a few at a time."""
    rng = np.random.default_rng(13)
    path, H = rng.uniform(0, np.pi, (60, 3)), (0.9, 1.1)
    together, kept = clearance(ARM, path, H), keeps(ARM, path[:-1], path[1:], H, 0.1)
    monkeypatch.setattr(collision, "PORTION", 7)
    np.testing.assert_allclose(clearance(ARM, path, H), together, rtol=0, atol=1.1e-6)
    np.testing.assert_array_equal(keeps(ARM, path[:-1], path[1:], H, 0.1), kept)


@pytest.mark.filterwarnings("ignore:.*degrees:UserWarning")
def test_excessive_work_is_refused(monkeypatch):
    q = np.array([1.0, 2.0, 1.5])
    # a hundred turns are a lot of work, but less than the limit
    assert clearance(ARM, [q, q + [200 * np.pi, 0, 0]], (1.2, 1.3)).shape == (1, 3)
    many = np.tile(q, (WORK + 1, 1))
    with pytest.raises(
        ValueError, match=f"most {WORK} pie.*{WORK + 1} or more .*{WORK + 1} .*of 0 rad"
    ):
        keeps(ARM, many, q, (2.9, 2.9), 0.5)
    with pytest.raises(
        ValueError, match=r"got 10\d{5} or more for 1 motions of 3e\+06 rad in total"
    ):
        clearance(ARM, [q, q + 1e6], (1.2, 1.3))
    monkeypatch.setattr(collision, "WORK", 8)
    assert keeps(ARM, many[:8], q, (2.9, 2.9), 0.5).all()
    for call in (
        lambda: keeps(ARM, many[:9], q, (2.9, 2.9), 0.5),
        lambda: keeps(ARM, q, q + [20, 0, 0], (2.9, 2.9), 0.5),
        lambda: swept(ARM, q, q + [20, 0, 0], (1.5, 1.5)),
    ):
        with pytest.raises(ValueError, match="motions: wanted motions that need at most 8 pieces"):
            call()


def test_only_the_nearest_of_several_obstacles_matters():
    """The result equals the least of the results for the individual obstacles."""
    rng = np.random.default_rng(15)
    for _ in range(40):
        path, H = rng.uniform(0, np.pi, (4, 3)), rng.uniform(-2.5, 2.5, (3, 2))
        alone = np.min([clearance(ARM, path, each) for each in H], axis=0)
        np.testing.assert_allclose(clearance(ARM, path, H), alone, rtol=0, atol=1.01e-6)
        for distance in (0.05, 0.2, 0.5):
            each = [keeps(ARM, path[:-1], path[1:], h, distance) for h in H]
            np.testing.assert_array_equal(
                keeps(ARM, path[:-1], path[1:], H, distance), np.all(each, axis=0)
            )


@pytest.fixture(scope="module")
def two_drawn():
    """Random tasks with a second, random obstacle, before or after the first."""
    rng, found = np.random.default_rng(16), []
    for q0, K1, H in tasks(max(TASKS // 2, 24), seed=17):
        second = rng.uniform(-2.5, 2.5, 2)
        found.append((q0, K1, np.array([H, second])[:: rng.choice([1, -1])]))
    return found


def test_plans_past_two_obstacles_keep_clear_of_both(two_drawn):
    ways, differs = [], 0
    for q0, K1, H in two_drawn:
        answer = plan(ARM, q0, K1, H)
        ways.append(answer.way)
        too_near = min(
            *(seen(q0, h).min() for h in H), np.hypot(*(K1 - H).T).min(), np.hypot(*H.T).min()
        )
        assert ("No path keeps" in answer.words) == (too_near < KEPT)
        if not answer.found:
            continue
        sampled = np.min([seen(dense(answer.path), h).min(axis=1) for h in H], axis=0)
        assert sampled.min() >= KEPT and (answer.path[0] == q0).all()
        assert (answer.clearance <= sampled).all()
        np.testing.assert_allclose(ARM.points(answer.posture)[3], K1, rtol=0, atol=1e-12)
        differs += any(plan(ARM, q0, K1, h).cost < answer.cost - 1e-6 for h in H)
    assert {"via points", "search", "none"} <= set(ways) and differs > 3


def test_via_points_are_around_the_first_obstacle_in_the_way(two_drawn):
    """The obstacle is identified from the gripper's positions and compared with the text."""
    count = 0
    for q0, K1, H in two_drawn:
        answer = plan(ARM, q0, K1, H)
        if answer.way != "via points":
            continue
        # shape (2 obstacles, 2 points)
        away = np.hypot(*(ARM.points(answer.via)[:, None, 3] - H).T)
        about = abs(away - answer.radius).max(axis=1) < 1e-12
        assert about.sum() == 1
        assert f"{1000 * answer.radius:.1f} mm from obstacle {about.argmax() + 1}" in answer.words
        near = [
            (seen(dense([q0, ARM.least(K1, q0)[0]])[0], h).min(axis=1) < KEPT).argmax() for h in H
        ]
        met = [h for h, first in zip((0, 1), near, strict=True) if first > 0]
        if met:
            assert about.argmax() == min(met, key=lambda h: near[h])
            count += len(met) == 1
    assert count


def test_plan_text_gives_the_number_of_the_obstacle():
    far = (-2.0, -2.0)
    for words, obstacle in (
        ("Obstacle 2 lies 50.0 mm from the base", (far, (0.05, 0))),
        ("The target lies 100.0 mm from obstacle 2", (far, (1.8, 0.7))),
        ("already 0.0 mm from obstacle 1", (KNOWN[3], far)),
        ("The direct motion is clear: no obstacle is in its way.", (far, far)),
    ):
        assert words in plan(ARM, Q0, (1.8, 0.6), obstacle).words
    q0, K1, H = next(tasks(1))
    assert "lever AK hits an obstacle. " in plan(ARM, q0, K1, [far, H]).words


@pytest.fixture(scope="module")
def drawn():
    """Random tasks (q0, target, obstacle)."""
    return list(tasks(max(TASKS, 62)))


@pytest.fixture(scope="module")
def answers(drawn):
    """The random tasks with their plans: (q0, target, obstacle, plan)."""
    return [(*task, plan(ARM, *task)) for task in drawn[:TASKS]]


def test_plans_keep_their_clearance_or_find_no_path(answers):
    ways = []
    for q0, K1, H, answer in answers:
        ways.append(answer.way)
        if not answer.found:
            assert (
                answer.way == "none" and answer.path.tolist() == [q0.tolist()] and answer.cost == 0
            )
            assert "no path" in answer.words or "No path keeps" in answer.words
            assert ("No path keeps" in answer.words) == (
                min(seen(q0, H).min(), np.hypot(*(K1 - H))) < KEPT
            )
            continue
        postures = dense(answer.path)
        assert (answer.path[0] == q0).all()
        np.testing.assert_allclose(ARM.fk(answer.posture).translation[:2], K1, rtol=0, atol=1e-12)
        assert within(ARM, answer.path).all()
        sampled = seen(postures, H).min(axis=1)
        assert sampled.min() >= KEPT, answer
        assert (answer.clearance <= sampled).all() and (answer.clearance.min() >= KEPT - 2e-6)
        assert answer.cost == pytest.approx(abs(np.diff(answer.path, axis=0)).sum())
        assert answer.cost >= answer.least - 1e-9
    assert ways.count("direct") == 0
    assert ways.count("search") > 0.5 * TASKS and ways.count("via points") > 0.1 * TASKS


def test_plan_text_names_the_nearest_lever(answers):
    """If two levers meet at the nearest point, the text names the lever nearer to the base."""
    told = re.compile(r"lever (\w+) (hits|comes within ([0-9.]+) mm of) the obstacle")
    for q0, K1, H, answer in answers:
        if "No path keeps" in answer.words:
            continue
        circles = {f"{1000 * r:.1f} mm from the obst": via_path(ARM, q0, K1, H, r) for r in CIRCLES}
        reached = [path for path in circles.values() if not np.isnan(path).any()]
        assert ("not both within the allowed reach" in answer.words) == (not reached)
        paths = [[q0, ARM.least(K1, q0)[0]]]
        paths += [path for words, path in circles.items() if words in answer.words]
        found = told.findall(answer.words)
        assert found[0][1] == "hits"
        if answer.way == "via points":
            assert len(found) == 1 and len(paths) == 2
            np.testing.assert_allclose(answer.path, paths[1], rtol=0, atol=1e-12)
            continue
        assert len(found) == len(paths) == 1 + bool(reached)
        # if no circle keeps the distance, the text names the one that comes closest to it
        if reached:
            assert clearance(ARM, paths[1], H).min() == max(
                clearance(ARM, path, H).min() for path in reached
            )
        for (name, what, near), path in zip(found, paths, strict=True):
            parts = seen(dense(path, 20_001), H)
            least = parts.min(axis=(0, 1))
            fast = abs(np.diff(path, axis=0)).sum(axis=1).max() * 3 / 20_000
            lever = LEVERS.index(name)
            assert least[lever] <= least.min() + fast
            assert (least[:lever] > least.min() + 1e-6).all()
            if what == "hits":
                assert least.min() <= fast
            else:
                assert abs(float(near) / 1000 - least.min()) <= fast + 5.1e-5 and float(near) > 0


def test_search_path_cannot_be_shortened_by_simple_changes(answers):
    """No simple change shortens a path, such as omitting a via posture, moving a via posture
    towards its neighbours, or ending at a nearer posture.
    """
    searched = [(H, K1, p.path) for _, K1, H, p in answers if p.way == "search"]
    nearer = [is_taut(path, K1, H, KEPT) for H, K1, path in searched]
    assert len(searched) > 0.5 * TASKS and sum(nearer) <= 0.05 * len(searched)


def is_taut(path, K1, H, distance):
    """Assert that no change of its via postures shortens the path; return whether the path could
    end at a nearer posture.
    """
    assert not keeps(ARM, path[:-2], path[2:], H, distance).any()
    for a, via, b in zip(path, path[1:], path[2:], strict=False):
        between = np.clip(via, np.minimum(a, b), np.maximum(a, b))
        pulled = via + (between - via) / 32
        slack = abs(between - via).sum() > 1e-9
        assert not (slack and keeps(ARM, [a, pulled], [pulled, b], H, distance).all())
    goals = ARM.family(K1, np.linspace(*ARM.alpha_range(K1), 300))
    gain = abs(path[-1] - path[-2]).sum() - abs(goals - path[-2]).sum(axis=1)
    return bool(keeps(ARM, path[-2], goals[gain > 1 * deg], H, distance).any())


def test_search_path_costs_no_more_than_brute_force(drawn):
    ratios = []
    for i, least in BRUTE.items():
        q0, K1, H = drawn[i]
        S = abs(np.diff(way_round(ARM, q0, K1, H, KEPT), axis=0)).sum()
        assert S < 1.03 * least, (i, S, least)
        ratios.append(S / least)
    assert np.mean(ratios) < 0.985  # the via postures are optimal and not restricted to a grid


def test_search_finds_paths_with_a_small_clearance(drawn):
    """In these tasks a step of the grid can jump over the obstacle. In the last three, a goal
    further along the target's curve saves movement.
    """
    found = []
    for q0, K1, H in [*drawn[:12], drawn[21], drawn[30], drawn[61]]:
        path = way_round(ARM, q0, K1, H, 0.02)
        found.append(path is not None)
        if path is not None:
            assert seen(dense(path), H).min() >= 0.02 and (path[0] == q0).all()
            assert not is_taut(path, K1, H, 0.02)
    assert sum(found) >= 13


def test_search_reaches_targets_that_few_postures_reach():
    """Near full stretch the target's family is short; at full stretch it is a single posture;
    beyond it there is no posture and no path.
    """
    for r in (2.9, 2.9999, 2.99999999, 3.0):
        K1 = r * np.array([np.cos(1.0), np.sin(1.0)])
        path = way_round(ARM, Q0, K1, (-2.0, 0.5), 0.1)
        np.testing.assert_allclose(ARM.points(path[-1])[3], K1, atol=1e-7)
        least = ARM.least(K1, Q0)[1]
        assert least - 1e-9 <= abs(np.diff(path, axis=0)).sum() < least + 2 * deg
    assert way_round(ARM, Q0, (3.001, 0), (-2.0, 0.5), 0.1) is None
    assert way_round(ARM, Q0, (0.5, 0.5), (-2.0, 0.5), 0.1) is None


def test_start_at_the_joint_limits_is_accepted():
    """A start that exceeds a limit by a rounding error is accepted, too: the path begins at the
    arm's posture.
    """
    for q0 in ([-5e-10, 2.0, 1.5], [np.pi + 5e-10, 2.0, 1.5], [0.0, np.pi, 2.0], [1.0, 0.3, np.pi]):
        path = way_round(ARM, q0, (1.8, 0.6), (1.0, -1.5), 0.1)
        assert (path[0] == q0).all() and within(ARM, path).all()
    with pytest.raises(ValueError, match="from 0 to 180"):
        way_round(ARM, [-5e-9, 2.0, 1.5], (1.8, 0.6), (1.0, -1.5), 0.1)


def test_search_finds_a_path_where_one_was_constructed():
    """The tasks have a known solution: the obstacle is next to a path with two random corners."""
    rng, solved, count = np.random.default_rng(8), 0, 0
    while count < 25:
        path = rng.uniform(0, np.pi, (4, 3))
        H = rng.uniform(-2.5, 2.5, 2)
        K, K1 = ARM.points(path[0])[3], ARM.points(path[-1])[3]
        if not (1 < np.hypot(*K) < 3 and 1 < np.hypot(*K1) < 3 and np.hypot(*H) > 0.5):
            continue
        if seen(dense(path, 400), H).min() < KEPT + 0.03 or keeps(
            ARM, path[0], ARM.least(K1, path[0])[0], H, KEPT
        ):
            continue
        count += 1
        found = way_round(ARM, path[0], K1, H, KEPT)
        solved += found is not None
        assert (
            found is None
            or abs(np.diff(found, axis=0)).sum() < 1.05 * abs(np.diff(path, axis=0)).sum()
        )
    assert solved == count


def test_next_task_can_start_from_the_last_posture_of_a_plan():
    posture = np.array([100, 110, 120]) * deg
    for target, obstacle in (
        ((1.8, 0.6), (1.2, 2.1)),
        ((0.5, 2.0), (1.5, 1.5)),
        ((2.5, 0.5), (1.5, 1.5)),
    ):
        answer = plan(ARM, posture, target, obstacle)
        assert answer.found and (answer.path[0] == posture).all()
        posture = answer.posture
        np.testing.assert_allclose(ARM.points(posture)[3], target, atol=1e-12)


def test_direct_plan_has_no_via_postures():
    q0 = np.array([100, 110, 120]) * deg
    free = plan(ARM, q0, (1.8, 0.6))
    beside = plan(ARM, q0, (1.8, 0.6, 0.0), (-2.0, -2.0, 0.0))
    for answer in (free, beside):
        assert (
            answer.way == "direct"
            and answer.found
            and len(answer.path) == 2
            and len(answer.via) == 0
        )
        assert answer.cost == pytest.approx(answer.least) == pytest.approx(18.300924618454935 * deg)
    assert np.isinf(free.clearance).all() and beside.clearance.min() > 2
    assert "no obstacle is given" in free.words and "not in its way" in beside.words


def test_via_points_of_the_document_leave_less_clearance():
    """The chords of the circle of radius L/7 come nearer than L/7 (errata S3-n), so the document's
    path works only for a smaller distance.
    """
    ways, radii = [], []
    for q0, K1, H in tasks(min(TASKS, 30)):
        answer = plan(ARM, q0, K1, H, distance=0.09)
        ways.append(answer.way)
        if answer.way == "via points":
            radii.append(answer.radius)
            assert f"points K2 and K3, {1000 * radii[-1]:.1f} mm from the obst" in answer.words
            assert seen(dense(answer.path), H).min() >= 0.09 and len(answer.path) == 4
            np.testing.assert_allclose(
                np.hypot(*(ARM.points(answer.via)[:, 3] - H).T), radii[-1], atol=1e-12
            )
    assert radii.count(1 / 7) > 2 and "search" in ways


def test_first_circle_that_keeps_the_distance_is_used(answers):
    """No circle has a radius below the distance or L/7; the circle of radius L/7 never keeps the
    distance L/7 (errata S3-n).
    """
    radii = []
    for q0, K1, H, answer in answers:
        tried = [via_path(ARM, q0, K1, H, r) for r in CIRCLES]
        kept = [not np.isnan(p).any() and clearance(ARM, p, H).min() >= KEPT for p in tried]
        if answer.way == "via points":
            assert answer.radius == CIRCLES[np.argmax(kept)] and any(kept)
            radii.append(answer.radius)
        else:
            assert np.isnan(answer.radius) and (not any(kept) or "No path" in answer.words)
    assert len(set(radii)) > 1 and min(radii) > 1 / 7
    for distance in (0.1, 0.2, 0.21, 0.4):
        told = [plan(ARM, *answer[:3], distance).words for answer in answers[:12]]
        named = [float(n) / 1000 for n in re.findall(r"K3, ([0-9.]+) mm", " ".join(told))]
        tried = {max(distance, 1 / 7), *(r for r in CIRCLES if r > distance)}
        assert len(named) > 3
        assert all(min(abs(r - each) for each in tried) < 5.1e-5 for r in named)


Q0 = np.array([100, 110, 120]) * deg
KNOWN = ARM.points(Q0)


@pytest.mark.parametrize(
    "target, obstacle, words",
    [
        ((0.5, 0.5), (1.5, 1.5), "not farther than one lever (1000.0 mm), which this course does"),
        ((2.5, 2.5), (1.5, 1.5), "farther than three levers"),
        ((0, 0), (1.5, 1.5), "not farther than one lever"),
        ((-1.97, 0.35), (1.5, 1.5), "gamma outside 0 to 180 degrees"),
        ((1.8, 0.6), (0, 0), "lies 0.0 mm from the base"),
        ((1.8, 0.6), (0.05, -0.1), "lies 111.8 mm from the base"),
        ((1.8, 0.6), (1.8, 0.6), "The target lies 0.0 mm from the obstacle"),
        ((1.8, 0.6), (1.8, 0.7), "The target lies 100.0 mm from the obstacle"),
        ((1.8, 0.6), KNOWN[3], "At the start lever AK is already 0.0 mm"),
        ((1.8, 0.6), (KNOWN[0] + KNOWN[1]) / 2, "At the start lever OB is already"),
        ((1.8, 0.6), (KNOWN[1] + KNOWN[2]) / 2, "At the start lever BA is already 0.0 mm"),
        (KNOWN[3], KNOWN[3], "At the start"),
        # the arm is stretched over the obstacle, so no posture at the target is free
        ((2.99, 0.1), (1.5, 0.05), "finds no path"),
    ],
)
def test_impossible_plans_give_a_reason(target, obstacle, words):
    answer = plan(ARM, Q0, target, obstacle)
    assert words in answer.words, answer.words
    assert not answer.found and answer.way == "none" and len(answer.clearance) == 0
    assert answer.path.tolist() == [Q0.tolist()] and (answer.posture == Q0).all()


def test_distance_that_is_just_kept_is_accepted():
    """A clearance that equals the required distance is enough at the base, the start and the target
    and on the direct path.
    """
    target, H = (1.75, 0.5), (1.75, 0.75)
    at_start, direct = distances(ARM, Q0, H).min(), [Q0, ARM.least(target, Q0)[0]]
    for distance, obstacle, words in (
        (0.5, (0.0, -0.5), "lies 500.0 mm from the base"),
        (at_start, H, "At the start lever AK is already"),
        (0.25, H, "The target lies 250.0 mm"),
    ):
        at, above = (
            plan(ARM, Q0, target, obstacle, d).words for d in (distance, np.nextafter(distance, 9))
        )
        assert words in above and words not in at, (at, above)
    H = (1.5, 1.4)
    near = clearance(ARM, direct, H).min()
    assert plan(ARM, Q0, target, H, near).way == "direct"
    assert plan(ARM, Q0, target, H, np.nextafter(near, 9)).way != "direct"


def test_plan_accepts_a_smaller_distance():
    target, obstacle = (1.8, 0.6), (1.8, 0.7)
    assert not plan(ARM, Q0, target, obstacle).found
    answer = plan(ARM, Q0, target, obstacle, distance=0.05)
    assert answer.found and 0.05 <= seen(dense(answer.path), obstacle).min() <= 0.1


def test_along_returns_the_postures_of_a_path():
    path = np.array([(0, 0, 0), (1, 0, 0), (1, 2, 1)])
    q = along(path, [0, 0.125, 0.25, 0.625, 1])
    np.testing.assert_allclose(
        q, [(0, 0, 0), (0.5, 0, 0), (1, 0, 0), (1, 1, 0.5), (1, 2, 1)], atol=1e-15
    )
    np.testing.assert_allclose(along(path[[0, 0]], [0, 0.5]), path[[0, 0]])  # no movement


def test_S_grows_linearly_along_a_path():
    path = np.array([(0, 1, 0), (0.5, 0, -1), (-1, 0.2, 0)])
    # the two parts have S = 2.5 and 2.7, so no sample is at the corner
    q = along(path, np.linspace(0, 1, 43))
    S = abs(np.diff(q, axis=0)).sum(axis=-1)
    inner = np.delete(S, np.searchsorted(np.linspace(0, 1, 43), 2.5 / 5.2) - 1)
    np.testing.assert_allclose(inner, 5.2 / 42, rtol=1e-12)


def test_fractions_outside_0_to_1_give_the_ends_of_a_path():
    path = np.array([(0, 0, 0), (1, 0, 0), (1, 2, 1)])
    assert (along(path, [[-1.0, 2.0], [1e300, -1e300]]) == path[[[0, 2], [2, 0]]]).all()


# ---- invalid calls

ARMS = {
    "in_quadrilateral": lambda arm: in_quadrilateral(arm, Q0, Q0, (1, 2)),
    "swept": lambda arm: swept(arm, Q0, Q0, (1, 2)),
    "distances": lambda arm: distances(arm, Q0, (1, 2)),
    "clearance": lambda arm: clearance(arm, [Q0, Q0], (1, 2)),
    "keeps": lambda arm: keeps(arm, Q0, Q0, (1, 2), 0.1),
    "via_path": lambda arm: via_path(arm, Q0, (1.8, 0.6), (1, 2)),
    "way_round": lambda arm: way_round(arm, Q0, (1.8, 0.6), (1, 2), 0.1),
    "plan": lambda arm: plan(arm, Q0, (1.8, 0.6)),
}


@pytest.mark.parametrize("name", ARMS)
def test_arms_of_other_kinds_are_refused(name):
    ARMS[name](ARM)
    for arm in (None, "a", 3, SCARA, loader_arm(1, 1), ARM.geometry, type(ARM)):
        with pytest.raises(TypeError, match="arm: wanted a ThreeLeverArm, got"):
            ARMS[name](arm)


FAR = (1.2, 1.9)  # this obstacle is not in the way
GOAL = (1.8, 0.6)
WRONG = {
    "a posture past its limit": (lambda: plan(ARM, [1, 2, 4], GOAL), "from 0 to 180 degrees"),
    "a posture below its limit": (lambda: plan(ARM, [1, -0.1, 3], GOAL), "from 0 to 180 degrees"),
    "a posture in degrees": (
        lambda: plan(ARM, [100, 110, 120], GOAL),
        r"180 degrees, got \[5729\.578",
    ),
    "two angles": (lambda: plan(ARM, [1, 2], GOAL), r"posture.*\(2,\)"),
    "two postures": (lambda: plan(ARM, [Q0, Q0], GOAL), r"posture: wanted a single .*\(2, 3\)"),
    "no posture": (lambda: plan(ARM, None, GOAL), "posture: wanted numbers"),
    "NaN posture": (lambda: plan(ARM, [1, np.nan, 2], GOAL), "posture.*nan"),
    "target off the plane": (lambda: plan(ARM, Q0, (1.8, 0.6, 0.1)), "z = 0"),
    "target of four numbers": (lambda: plan(ARM, Q0, (1, 2, 0, 0)), "target: wanted points"),
    "target as a number": (lambda: plan(ARM, Q0, 1.8), "target: wanted points.*1.8"),
    "two targets": (lambda: plan(ARM, Q0, [GOAL] * 2), r"target.*a single point.*\(2,\)"),
    "NaN obstacle": (lambda: plan(ARM, Q0, GOAL, (1, np.nan)), "obstacle.*nan"),
    "obstacle too far away": (lambda: plan(ARM, Q0, GOAL, (1e300, 0)), "metres, got 1e.300"),
    "obstacle as a string": (lambda: plan(ARM, Q0, GOAL, "ab"), "obstacle: wanted numbers"),
    "negative distance": (lambda: plan(ARM, Q0, GOAL, (1, 2), -0.1), "-0.1"),
    "distance 0": (lambda: plan(ARM, Q0, GOAL, (1, 2), 0), "distance: wanted one positive length"),
    "NaN distance": (lambda: plan(ARM, Q0, GOAL, (1, 2), np.nan), "distance.*nan"),
    "one posture is not a path": (lambda: clearance(ARM, Q0, (1, 2)), r"two or more.*\(3,\)"),
    "a path of one posture": (lambda: clearance(ARM, [Q0], (1, 2)), r"two or more.*\(1, 3\)"),
    "a batch of paths": (lambda: clearance(ARM, [[Q0, Q0]] * 2, (1, 2)), r"\(2, 2, 3\)"),
    "two obstacles": (lambda: swept(ARM, Q0, Q0, [(1, 2)] * 2), "a single point"),
    "a batch of obstacles": (
        lambda: clearance(ARM, [Q0, Q0], [[(1, 2)] * 2] * 3),
        r"H: wanted one point \(2,\) or several \(m, 2\), got \(3, 2, 2\)",
    ),
    "an empty list of obstacles": (lambda: plan(ARM, Q0, GOAL, np.empty((0, 2))), r"\(0, 2\)"),
    "angles too large": (lambda: clearance(ARM, [Q0, Q0 + 1e10], FAR), "radians, got 1e"),
    "along a single posture": (lambda: along([Q0], 0.5), "two or more"),
    "along at NaN": (lambda: along([Q0, Q0], np.nan), "s: wanted finite"),
    "distance below zero": (lambda: keeps(ARM, Q0, Q0, FAR, -np.inf), "distance.*inf"),
    "keeps -1": (lambda: keeps(ARM, Q0, Q0, FAR, -1), "distance: wanted one positive length"),
    "keeps NaN": (lambda: keeps(ARM, Q0, Q0, FAR, np.nan), "distance.*nan"),
    "keeps of NaN": (lambda: keeps(ARM, Q0, [np.nan] * 3, FAR, 0.1), "b: wanted finite"),
    "keeps, unequal batches": (
        lambda: keeps(ARM, [Q0] * 2, [Q0] * 3, FAR, 0.1),
        r"a and b.*\(2, 3\) and \(3, 3\)",
    ),
    "distances, unequal batches": (
        lambda: distances(ARM, [Q0] * 2, [FAR] * 3),
        r"q and H.*\(2,\) and \(3,\)",
    ),
    "way round, degrees": (
        lambda: way_round(ARM, [100, 110, 120], GOAL, FAR, 0.1),
        "q0: .* to 180",
    ),
    "way round, NaN": (lambda: way_round(ARM, Q0 * np.nan, GOAL, FAR, 0.1), "q0.*nan"),
    "way round, NaN target": (lambda: way_round(ARM, Q0, (np.nan, 1), FAR, 0.1), "target.*nan"),
    "way round, distance": (lambda: way_round(ARM, Q0, GOAL, FAR, -1), "distance: .*got -1"),
    "way round, NaN distance": (lambda: way_round(ARM, Q0, GOAL, FAR, np.nan), "distance.*nan"),
    "radius below zero": (lambda: via_points((1, 2), (2, 1), FAR, -1), "radius: .*positive.*-1"),
    "no radius": (lambda: via_points((1, 2), (2, 1), FAR, None), "radius: wanted"),
    "radius of a via path": (lambda: via_path(ARM, Q0, GOAL, FAR, 0), "radius: .*positive.*0"),
    "two starts": (lambda: via_path(ARM, [Q0, Q0], GOAL, FAR), r"q0: .*\(2, 3\)"),
    "limited as a string": (lambda: via_path(ARM, Q0, GOAL, FAR, 0.1, "no"), "limited: .*'no'"),
    "quadrilaterals of a batch": (
        lambda: in_quadrilateral(ARM, [Q0] * 4, Q0, FAR),
        r"q0: wanted a single .*\(4, 3\)",
    ),
    "swept without a second posture": (lambda: swept(ARM, Q0, None, FAR), "q1: wanted numbers"),
}


@pytest.mark.parametrize("name", WRONG)
def test_errors_name_the_invalid_argument(name):
    call, words = WRONG[name]
    with pytest.raises(ValueError, match=words) as caught:
        call()
    assert len(str(caught.value)) < 200


def test_angles_in_degrees_cause_a_warning():
    q, H = np.array([100.0, 110.0, 120.0]), (1.2, 1.9)
    for call in (
        lambda: in_quadrilateral(ARM, Q0, q, H),
        lambda: swept(ARM, q, Q0, H),
        lambda: distances(ARM, q, H),
        lambda: clearance(ARM, [Q0, q], H),
        lambda: keeps(ARM, q, Q0, H, 0.1),
        lambda: keeps(ARM, Q0, q, H, 0.1),
    ):
        with pytest.warns(UserWarning, match="degrees") as caught:
            call()
        assert caught[0].filename == __file__


def test_grids_with_too_many_postures_are_refused():
    wide = type(ARM)("wide", ARM.geometry, [(-20.0, 20.0)] * 3)
    with pytest.raises(ValueError, match=rf"arm: .* grid postures .*{WORK}, got 9.6.* with 1 obst"):
        way_round(wide, Q0, GOAL, FAR, 0.1)
    with pytest.raises(ValueError, match=r"got 2\.3.* with 50 obstacles"):
        way_round(ARM, Q0, GOAL, [FAR] * 50, 0.1)
    narrow = type(ARM)("narrow", ARM.geometry, [(0.0, 3.2)] * 3)
    assert way_round(narrow, Q0, GOAL, FAR, 0.1) is not None


# ---- the data of a plan


def a_plan(**other):
    made = dict(way="search", words="So.", path=[Q0, Q0 + 0.1], clearance=[[1, 2, np.inf]], least=1)
    return Plan(**made | other)


def test_plans_are_read_only_data():
    answer = plan(ARM, Q0, (1.8, 0.6), (1.6, 1.6))
    assert isinstance(answer, Plan) and answer.words.endswith(".")
    path, clear = np.array([Q0, Q0 + 0.1, Q0]), np.array([[1.0, 2, np.inf], [0, 1, 2]])
    made = a_plan(path=path, clearance=clear)
    assert made.found and made.cost == pytest.approx(0.6) and made.least == 1
    assert made.via.shape == (1, 3) and (made.posture == Q0).all()
    path[:], clear[:] = 0, 0
    assert (made.path[0] == Q0).all() and np.isinf(made.clearance[0, 2])
    for array in (made.path, made.clearance, made.via, made.posture):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    for name in ("path", "clearance", "words", "found", "cost"):
        with pytest.raises(AttributeError):
            setattr(made, name, None)
    stays = a_plan(way="none", path=[Q0], clearance=np.empty((0, 3)), least=np.nan)
    assert not stays.found and stays.cost == 0 and np.isnan(stays.least) and len(stays.via) == 0


@pytest.mark.parametrize(
    "wrong",
    [
        {"way": "tunnel"},
        {"way": None},
        {"way": "none"},  # a path of two postures, but no path was found
        {"words": 3},
        {"path": [Q0]},  # one posture, but a path was found
        {"path": Q0},
        {"path": [Q0 * np.nan, Q0]},
        {"path": np.empty((0, 3))},
        {"path": [Q0] * 3},  # two parts, but the clearance of only one
        {"path": None},
        {"clearance": [[1, 2]]},
        {"clearance": [[1, 2, np.nan]]},
        {"clearance": [[1, 2, -np.inf]]},
        {"clearance": [[1, 2, -1e-3]]},
        {"clearance": [[1, 2, 3], [1, 2]]},
        {"clearance": "abc"},
        {"clearance": [[1, 2, 3]] * 2},
        {"clearance": [1, 2, 3]},
        {"least": -1},
        {"least": [1, 2]},
        {"least": np.inf},
        {"radius": 0.2},  # a plan found by a search must not have a radius
        {"way": "via points"},  # a plan with via points must have a radius
        {"way": "via points", "radius": -0.2},
        {"way": "via points", "radius": np.inf},
        {"way": "via points", "radius": [0.1, 0.2]},
        {"way": "none", "path": np.empty((0, 3)), "clearance": np.empty((0, 3))},
        {"way": "direct", "path": [Q0], "clearance": np.empty((0, 3))},
    ],
)
def test_plans_with_mismatched_parts_are_refused(wrong):
    with pytest.raises(
        ValueError, match=f"^({'|'.join([*wrong, 'path', 'clearance', 'radius'])}): wanted"
    ):
        a_plan(**wrong)


def test_nearest_approach_matches_the_clearance():
    rng, through = np.random.default_rng(31), 0
    for _ in range(40):
        q0, target, H = rng.uniform(0, np.pi, 3), rng.uniform(-1, 2.5, 2), rng.uniform(-1, 2, 2)
        for way in ("direct", "via points"):
            path = unchecked_path(ARM, way, q0, target, H, 0.1)
            np.testing.assert_array_equal(path[0], q0)
            if len(path) > 1:
                np.testing.assert_allclose(ARM.points(path[-1])[3], target, atol=1e-9)
            else:
                assert way == "via points" or ARM.out_of_reach(target)
            near = clearance(ARM, path, H) if len(path) > 1 else np.empty((0, 3))
            lever, least, place = nearest_approach(ARM, path, near, H)
            each = near.min(axis=0) if len(path) > 1 else distances(ARM, q0, H)
            assert least == each[lever] == each.min()
            # between two samples a point moves by at most the reach times the angle turned
            moved = 3 * abs(np.diff(path, axis=0)).sum() / 120
            assert -1e-9 <= np.hypot(*(place - H)) - least <= moved + 2e-6
            through += len(path) > 1
    assert through > 20
