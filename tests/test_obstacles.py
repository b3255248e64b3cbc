"""A point obstacle beside the three-lever arm: reference cases, certified clearance, and plans that
keep what they say.

Distances are checked by a second description of the arm (complex numbers, levers as many points),
not by robokin's. ROBOKIN_TASKS=2000 runs the full number of random tasks;
tests/benchmarks/obstacle_tasks.py prints what comes of them.
"""

import os

import numpy as np
import pytest
from machines import oracle

from robokin import deg, three_lever, within
from robokin.jobs.obstacles import (
    LEVERS,
    Plan,
    along,
    clearance,
    distances,
    in_quadrilateral,
    keeps,
    plan,
    swept,
    via_path,
    via_points,
    way_round,
)

CASES = oracle("planar_obstacle")["cases"]
TASKS = int(os.environ.get("ROBOKIN_TASKS", 60))
ARM = three_lever(1.0)
KEPT = ARM.lever / 7
cases = pytest.mark.parametrize("case", CASES)


def seen(q, H, L=1.0):
    """Distances of H from the levers in postures q (..., 3): (..., 3), by complex numbers."""
    gamma, beta, alpha = np.moveaxis(np.asarray(q), -1, 0)
    lever = L * np.exp(1j * gamma)
    start, found = 0 * lever, []
    for turn in (beta, alpha, None):
        # the lever lies from 0 to 1 on the real axis
        seen_from_lever = (complex(*H) - start) / lever
        foot = np.clip(seen_from_lever.real, 0, 1)
        found.append(L * abs(seen_from_lever - foot))
        start = start + lever
        lever = None if turn is None else -lever * np.exp(1j * turn)
    return np.stack(found, axis=-1)


def dense(path, samples=4001):
    """Postures on every part of a path: (parts, samples, 3)."""
    path = np.asarray(path)
    return path[:-1, None] + np.linspace(0, 1, samples)[:, None] * np.diff(path, axis=0)[:, None]


def passes_over(q0, q1, H):
    """Does lever AK pass over one of the points H (n, 2) on the way from q0 to q1? By the side on
    which H lies.
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
    """n random tasks (q0, target, obstacle) whose obstacle, L < OH < 3 L, is swept by AK on the
    direct way.
    """
    rng = np.random.default_rng(seed)

    def ring(count):
        r, phi = rng.uniform(1, 3, count), rng.uniform(-np.pi, np.pi, count)
        return np.stack([r * np.cos(phi), r * np.sin(phi)], axis=-1)

    while n:
        q0, K1 = rng.uniform(0, np.pi, 3), ring(1)[0]
        q1, _ = ARM.least(K1, q0, limited)
        if np.isnan(q1).any() or not 1 < np.hypot(*ARM.joints(q0)[3]) < 3:
            continue
        H = ring(1)
        if passes_over(q0, q1, H)[0]:
            yield q0, K1, H[0]
            n -= 1


@cases
def test_reference_cases(case):
    q0, q1, H = np.array(case["previous"])[::-1], np.array(case["new"])[::-1], case["H"]
    for q, names in ((q0, ("A", "K")), (q1, ("A1", "K1"))):
        for point, name in zip(ARM.joints(q)[2:], names, strict=True):
            np.testing.assert_allclose(point, case[name], rtol=0, atol=1e-12)
    np.testing.assert_allclose(ARM.least(case["K1"], q0, limited=False)[0], q1, rtol=0, atol=1e-6)
    assert in_quadrilateral(ARM, q0, q1, H)["AK"] == case["inside_quadrilateral"]
    assert swept(ARM, q0, q1, H)["AK"] == case["swept_by_AK_joint_linear"]
    # else the reference holds the least of samples, up to 0.0007
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
            ARM.joints(path)[:, 3], [case["K"], K2, K3, case["K1"]], rtol=0, atol=1e-12
        )


def test_via_points_are_square_and_on_the_side_of_the_base():
    """Errata S3-m: the printed formulas give (1.556, 1.131) and (1.429, 0.876) here, not square and
    one outside.
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
    with pytest.raises(ValueError, match="apart from K1"):
        via_points(K, H, H, 1 / 7)


def test_the_quadrilateral_of_any_drawing():
    """Errata S3-k: the printed inequalities miss this point. A corner and a side count as
    inside.
    """
    q0 = ARM.least((0.8668, -0.5041), [1.2, 2.0, 1.0], limited=False)[0]
    q1 = ARM.least((1.2804, 0.1854), [1.5, 2.0, 1.0], limited=False)[0]
    (_, B, A, K), (_, B1, A1, K1) = ARM.joints(q0), ARM.joints(q1)
    H = np.stack([A, K, (A + K) / 2, (3 * A + K1 + K + A1) / 6, 2 * K - A, (5, 5)])
    found = in_quadrilateral(ARM, q0, q1, H)
    assert found["AK"].tolist() == [True, True, True, True, False, False]
    assert found["BA"].shape == (6,) and found["BA"][0]
    # against another way to count: the winding of the corners about the point, for a simple and a
    # crossed outline
    rng = np.random.default_rng(4)
    for corners in (np.stack([A, K, K1, A1]), np.stack([B, A, A1, B1])):
        points = corners.min(axis=0) + rng.uniform(-0.1, 1.1, (500, 2)) * np.ptp(corners, axis=0)
        about = (corners @ [1, 1j])[:, None] - points @ [1, 1j]
        winding = np.round(np.angle(np.roll(about, -1, axis=0) / about).sum(axis=0) / (2 * np.pi))
        name = "AK" if corners[0] is not B and (corners[0] == A).all() else "BA"
        np.testing.assert_array_equal(in_quadrilateral(ARM, q0, q1, points)[name], winding % 2 == 1)


@pytest.mark.parametrize("L", [1.0, 0.35])
def test_clearance_is_a_bound_and_a_tight_one(L):
    rng, arm = np.random.default_rng(6), three_lever(L)
    for _ in range(60):
        path, H = rng.uniform(0, np.pi, (4, 3)), L * rng.uniform(-3, 3, 2)
        if rng.random() < 0.5:  # joints that rest, as the kinks of least movement leave them
            path[1:] = np.where(rng.random((3, 3)) < 0.6, path[0], path[1:])
        sampled = seen(dense(path), H, L)
        bound = clearance(arm, path, H)
        assert bound.shape == (3, 3) and (bound <= sampled.min(axis=1)).all()
        fast = abs(np.diff(path, axis=0)).sum(axis=1, keepdims=True) * 3 * L / 4000
        assert (sampled.min(axis=1) - bound <= fast + 2e-6 * L).all()
        np.testing.assert_allclose(distances(arm, path, H), seen(path, H, L), rtol=0, atol=1e-14)
        # `keeps` may refuse what lies this near to the distance
        least, slack = bound.min(axis=1), 3e-6 * L
        for distance in (least[1] - slack, least.max() + slack):
            kept = keeps(arm, path[:-1], path[1:], H, distance)
            assert (
                kept[least >= distance + slack].all() and not kept[least < distance - slack].any()
            )
        assert keeps(arm, path[:-1], path[1:], H, least.min() - slack).all()
        assert not keeps(arm, path[:-1], path[1:], H, least.max() + slack).any()


def test_a_lever_that_passes_over_has_no_clearance():
    q0, q1 = np.array([100, 120, 130]) * deg, np.array([60, 120, 130]) * deg
    for lever, u in ((0, 0.5), (1, 0.3), (2, 0.9)):
        O_B_A_K = ARM.joints((q0 + q1) / 2)
        H = O_B_A_K[lever] + u * (O_B_A_K[lever + 1] - O_B_A_K[lever])
        assert swept(ARM, q0, q1, H)[LEVERS[lever]]
        assert clearance(ARM, [q0, q1], H)[0, lever] == 0
        assert not keeps(ARM, q0, q1, H, 1e-6)
    assert not any(swept(ARM, q0, q1, (-2.0, -2.0)).values())


def test_plans_keep_their_clearance_or_say_that_there_is_none():
    ways = []
    for q0, K1, H in tasks(TASKS):
        answer = plan(ARM, q0, K1, H)
        ways.append(answer.way)
        if not answer.found:
            assert (
                answer.way == "none" and answer.path.tolist() == [q0.tolist()] and answer.cost == 0
            )
            assert "no way" in answer.words or "No path keeps" in answer.words
            assert ("No path keeps" in answer.words) == (
                min(seen(q0, H).min(), np.hypot(*(K1 - H))) < KEPT
            )
            continue
        postures = dense(answer.path)
        np.testing.assert_allclose(answer.path[0], q0)
        np.testing.assert_allclose(ARM.fk(answer.posture).translation[:2], K1, rtol=0, atol=1e-12)
        assert within(ARM, answer.path).all()
        sampled = seen(postures, H).min(axis=1)
        assert sampled.min() >= KEPT, answer
        assert (answer.clearance <= sampled).all() and (answer.clearance.min() >= KEPT - 2e-6)
        assert answer.cost == pytest.approx(abs(np.diff(answer.path, axis=0)).sum())
        assert answer.cost >= answer.least - 1e-9
        assert "AK" in answer.words or "BA" in answer.words or "OB" in answer.words
    assert ways.count("direct") == 0
    assert ways.count("search") > 0.7 * TASKS


def test_the_way_round_exists_where_a_path_was_made_first():
    """Tasks that are known to be solvable: the obstacle stands beside a path with two random
    corners.
    """
    rng, solved, count = np.random.default_rng(8), 0, 0
    while count < 25:
        path = rng.uniform(0, np.pi, (4, 3))
        H = rng.uniform(-2.5, 2.5, 2)
        K, K1 = ARM.joints(path[0])[3], ARM.joints(path[-1])[3]
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


def test_the_remembered_posture_leads_from_task_to_task():
    posture = np.array([100, 110, 120]) * deg
    for target, obstacle in (
        ((1.8, 0.6), (1.2, 2.1)),
        ((0.5, 2.0), (1.5, 1.5)),
        ((2.5, 0.5), (1.5, 1.5)),
    ):
        answer = plan(ARM, posture, target, obstacle)
        assert answer.found and (answer.path[0] == posture).all()
        posture = answer.posture
        np.testing.assert_allclose(ARM.joints(posture)[3], target, atol=1e-12)


def test_the_direct_way():
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
    assert "no obstacle is given" in free.words and "not in it" in beside.words


def test_via_points_serve_where_less_is_asked():
    """The chords of the circle L/7 come nearer than L/7 (errata S3-n): the document's way serves a
    smaller distance.
    """
    found = [plan(ARM, *task, distance=0.09).way for task in tasks(30)]
    assert "via points" in found and "search" in found
    for q0, K1, H in tasks(30):
        answer = plan(ARM, q0, K1, H, distance=0.09)
        if answer.way == "via points":
            assert seen(dense(answer.path), H).min() >= 0.09 and len(answer.path) == 4
            np.testing.assert_allclose(
                np.hypot(*(ARM.joints(answer.via)[:, 3] - H).T), 1 / 7, atol=1e-12
            )


Q0 = np.array([100, 110, 120]) * deg
KNOWN = ARM.joints(Q0)


@pytest.mark.parametrize(
    "target, obstacle, words",
    [
        ((0.5, 0.5), (1.5, 1.5), "not farther than one lever"),
        ((2.5, 2.5), (1.5, 1.5), "farther than three levers"),
        ((0, 0), (1.5, 1.5), "not farther than one lever"),
        ((-1.97, 0.35), (1.5, 1.5), "gamma outside 0 to 180 degrees"),
        ((1.8, 0.6), (0, 0), "on the base"),
        ((1.8, 0.6), (0.05, -0.1), "on the base or 111.8 mm beside it"),
        ((1.8, 0.6), (1.8, 0.6), "The target lies 0.0 mm from the obstacle"),
        ((1.8, 0.6), (1.8, 0.7), "The target lies 100.0 mm from the obstacle"),
        ((1.8, 0.6), KNOWN[3], "At the start lever AK is already 0.0 mm"),
        ((1.8, 0.6), (KNOWN[0] + KNOWN[1]) / 2, "At the start lever OB is already"),
        ((1.8, 0.6), (KNOWN[1] + KNOWN[2]) / 2, "At the start lever BA is already 0.0 mm"),
        (KNOWN[3], KNOWN[3], "At the start"),
        # stretched over the obstacle: no posture at the target is free
        ((2.99, 0.1), (1.5, 0.05), "finds no way"),
    ],
)
def test_what_cannot_be_is_said(target, obstacle, words):
    answer = plan(ARM, Q0, target, obstacle)
    assert words in answer.words, answer.words
    assert not answer.found and answer.way == "none" and len(answer.clearance) == 0
    assert answer.path.tolist() == [Q0.tolist()] and (answer.posture == Q0).all()


def test_a_smaller_distance_may_be_asked_for():
    target, obstacle = (1.8, 0.6), (1.8, 0.7)
    assert not plan(ARM, Q0, target, obstacle).found
    answer = plan(ARM, Q0, target, obstacle, distance=0.05)
    assert answer.found and 0.05 <= seen(dense(answer.path), obstacle).min() <= 0.1


def test_postures_along_a_path():
    path = np.array([(0, 0, 0), (1, 0, 0), (1, 2, 1)])
    q = along(path, [0, 0.125, 0.25, 0.625, 1])
    np.testing.assert_allclose(
        q, [(0, 0, 0), (0.5, 0, 0), (1, 0, 0), (1, 1, 0.5), (1, 2, 1)], atol=1e-15
    )
    np.testing.assert_allclose(along(path[[0, 0]], [0, 0.5]), path[[0, 0]])  # a path that stands


@pytest.mark.parametrize(
    "call, words",
    [
        (lambda: plan(ARM, [1, 2, 4], (1.8, 0.6)), "from 0 to 180 degrees"),
        (lambda: plan(ARM, [1, 2], (1.8, 0.6)), r"posture.*\(2,\)"),
        (lambda: plan(ARM, Q0, (1.8, 0.6, 0.1)), "z = 0"),
        (lambda: plan(ARM, Q0, (1.8, 0.6), (1, np.nan)), "nan"),
        (lambda: plan(ARM, Q0, (1.8, 0.6), (1, 2), -0.1), "-0.1"),
        (lambda: plan(ARM, Q0, (1.8, 0.6), (1, 2), 0), "distance: wanted one positive length"),
        (lambda: plan(ARM, Q0, [(1.8, 0.6)] * 2), "one single point"),
        (lambda: plan(None, Q0, (1.8, 0.6)), "ThreeLever"),
        (lambda: clearance(ARM, Q0, (1, 2)), r"\(3,\)"),
        (lambda: clearance(ARM, [Q0, Q0], [(1, 2), (3, 4)]), "one single point"),
    ],
)
def test_wrong_calls_are_named(call, words):
    with pytest.raises(ValueError, match=words):
        call()


def test_a_plan_is_data():
    answer = plan(ARM, Q0, (1.8, 0.6), (1.6, 1.6))
    assert isinstance(answer, Plan) and answer.words.endswith(".")
