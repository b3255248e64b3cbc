"""An obstacle that moves while the three-lever arm moves, and an obstacle located from two
distances.

As in test_obstacles.py, an independent model of the arm checks the distances, at its own positions
and times. ROBOKIN_TASKS=500 runs all random tasks; tests/benchmarks/obstacle_tasks.py prints
their results.
"""

import os

import numpy as np
import pytest
from test_obstacles import ARM, KEPT, Q0, tasks

from robokin import within
from robokin.jobs.moving import TICKS, plan_moving
from robokin.jobs.obstacles import STEP, clearance, locate, plan
from robokin.jobs.obstacles.collision import motion_clearances, motions_keep

TASKS = int(os.environ.get("ROBOKIN_TASKS", 40))


def least_on_the_way(path, times, H, v, samples=2001):
    """For every part of the path, the least distance from the point H + v t to any lever: an array
    of shape (parts,).
    """
    s, found = np.linspace(0, 1, samples), []
    for a, b, begin, end in zip(path, path[1:], times, times[1:], strict=False):
        gamma, beta, alpha = (a + s[:, None] * (b - a)).T
        place = (np.asarray(H) + np.outer(begin + s * (end - begin), v)) @ [1, 1j]
        lever, start, near = np.exp(1j * gamma), 0, []
        for turn in (beta, alpha, None):
            seen = (place - start) / lever
            near.append(abs(seen - np.clip(seen.real, 0, 1)).min())
            start = start + lever
            lever = None if turn is None else -lever * np.exp(1j * turn)
        found.append(min(near))
    return np.array(found)


def test_clearance_from_a_moving_obstacle_is_a_tight_bound():
    """Obstacles move fast and slowly, near and far, through the levers and past them; some arms do
    not move.
    """
    rng, swept = np.random.default_rng(7), 0
    for turn in (0.0, 0.5, 3.0):
        a = rng.uniform(0, np.pi, (60, 3))
        b = a + turn * rng.uniform(-1, 1, (60, 3))
        H, v = rng.uniform(-3, 3, (2, 60, 2))
        places = np.stack([H, H + v])[:, None]  # one obstacle; each motion takes one second
        bound = motion_clearances(ARM, a, b, places)
        for k in range(60):
            sampled = least_on_the_way([a[k], b[k]], [0.0, 1.0], H[k], v[k], 20_001)[0]
            fast = (3 * abs(b[k] - a[k]).sum() + np.hypot(*v[k])) / 20_000
            assert -1e-12 <= sampled - bound[k].min() <= fast + 2.1e-6
            for distance in (bound[k].min() - 1e-5, bound[k].min() + fast + 1e-5):
                kept = motions_keep(
                    ARM, a[k, None], b[k, None], places[:, :, k, None], max(distance, 1e-4)
                )
                assert kept[0] == (distance < bound[k].min() and bound[k].min() > 1e-4)
            swept += bound[k].min() == 0
    assert 10 < swept < 100


def moving_tasks(n, seed=21, speed=1.0):
    """Yield tasks (q0, target, H, v): those of test_obstacles.py, but the obstacle comes from any
    direction and reaches its position halfway through the direct motion.
    """
    rng = np.random.default_rng(seed)
    for q0, K1, H in tasks(n, seed):
        turn = rng.uniform(0, 2 * np.pi)
        v = rng.uniform(0.1, 1) * np.array([np.cos(turn), np.sin(turn)])
        yield q0, K1, H - v * ARM.least(K1, q0)[1] / speed / 2, v


@pytest.fixture(scope="module")
def answers():
    return [(task, plan_moving(ARM, *task, speed=1.0)) for task in moving_tasks(TASKS)]


def test_plans_keep_their_clearance_from_a_moving_obstacle(answers):
    ways = []
    for (q0, K1, H, v), (answer, times) in answers:
        ways.append(answer.way)
        assert times.shape == (len(answer.path),) and times[0] == 0
        if not answer.found:
            assert answer.path.tolist() == [q0.tolist()]
            assert "At the start" in answer.words or "neither waiting nor" in answer.words
            continue
        assert (answer.path[0] == q0).all() and within(ARM, answer.path).all()
        np.testing.assert_allclose(ARM.points(answer.posture)[3], K1, rtol=0, atol=1e-12)
        assert (abs(np.diff(answer.path, axis=0)).sum(axis=1) <= np.diff(times) + 1e-9).all()
        sampled = least_on_the_way(answer.path, times, H, v)
        assert sampled.min() >= KEPT and (answer.clearance.min(axis=1) <= sampled).all()
        assert (sampled - answer.clearance.min(axis=1) < 0.01).all()  # a tight bound
        assert answer.cost >= answer.least - 1e-9
    assert {"direct", "wait", "search", "none"} == set(ways)


def test_obstacle_motion_changes_the_plan(answers):
    """Many of the plans would come too near to an obstacle that stays at its first or last
    position.
    """
    still = [
        min(clearance(ARM, answer.path, np.add(H, t * v)).min() for t in (times[0], times[-1]))
        for (_, _, H, v), (answer, times) in answers
        if answer.found
    ]
    assert np.mean(np.array(still) < KEPT) > 0.3


def test_plan_waits_no_longer_than_needed_and_searches_only_as_a_last_resort(answers):
    compared = []
    for (q0, K1, H, v), (answer, times) in answers:
        if "At the start" in answer.words:
            continue
        path, clear = np.stack([q0, q0, ARM.least(K1, q0)[0]]), []
        for wait in np.arange(TICKS + 1) * STEP:
            when = np.array([0, wait, wait + answer.least])
            if answer.way in ("direct", "wait") and wait > times[-2] - 1e-9:
                break
            clear.append(least_on_the_way(path, when, H, v, 401).min())
        assert (np.array(clear) < KEPT + 1e-3).all()
        compared += [answer.way] * (len(clear) > 0)
        if answer.way == "direct":
            assert times[-1] == pytest.approx(answer.least)
        if answer.way == "wait":
            assert times[-1] == pytest.approx(times[1] + answer.least)
            assert answer.cost == pytest.approx(answer.least) and len(times) == 3
            assert f"waits for {times[1]:.2f} s" in answer.words
    assert compared.count("wait") > 5 and compared.count("search") > 5


def test_plan_moving_agrees_with_plan_for_a_fixed_obstacle():
    for q0, K1, H in tasks(6):
        fixed, (moving, times) = plan(ARM, q0, K1, H), plan_moving(ARM, q0, K1, H, (0, 0), 1.0)
        if moving.found:
            assert fixed.found and clearance(ARM, moving.path, H).min() >= KEPT
            assert times[-1] >= moving.least and moving.way == "search"
        elif "At the start" not in moving.words and "No path" not in fixed.words:
            assert fixed.cost > 0.8 * TICKS * STEP or not fixed.found


def test_doubling_all_speeds_halves_the_time():
    for q0, K1, H, v in moving_tasks(6):
        slow, slow_times = plan_moving(ARM, q0, K1, H, v, 1.0)
        fast, fast_times = plan_moving(ARM, q0, K1, H, 2 * v, 2.0)
        assert slow.way == fast.way
        np.testing.assert_allclose(slow.path, fast.path, rtol=0, atol=1e-9)
        np.testing.assert_allclose(slow_times, 2 * fast_times, rtol=1e-9)


@pytest.mark.parametrize(
    "target, obstacle, words",
    [
        ((0.5, 0.5), (1.5, 1.5), "not farther than one lever"),
        ((1.8, 0.6), ARM.points(Q0)[3], "At the start lever AK is already 0.0 mm"),
        # the obstacle moves onto the base
        ((1.8, 0.6), (0.15, -0.1), "neither waiting nor a search keeps 142.9 mm"),
    ],
)
def test_impossible_plans_give_a_reason(target, obstacle, words):
    answer, times = plan_moving(ARM, Q0, target, obstacle, (-1.0, 0.6), 1.0)
    assert words in answer.words and not answer.found and times.tolist() == [0.0]


def test_move_to_the_current_position_takes_no_time():
    answer, times = plan_moving(ARM, Q0, ARM.points(Q0)[3], (3, 3), (-0.1, 0), 1.0)
    assert answer.way == "direct" and times == pytest.approx([0, 0], abs=1e-9)


# ---- Location from two distances


def test_two_distances_locate_an_obstacle_up_to_reflection():
    rng = np.random.default_rng(4)
    for _ in range(100):
        P, Q, H = rng.uniform(-3, 3, (3, 2))
        away = [np.hypot(*(H - P)), np.hypot(*(H - Q))]
        found = locate(P, Q, *away)
        side = (Q - P)[0] * (H - P)[1] - (Q - P)[1] * (H - P)[0]
        np.testing.assert_allclose(found[int(side > 0)], H, rtol=0, atol=1e-8)
        for row in found:
            np.testing.assert_allclose(
                [np.hypot(*(row - P)), np.hypot(*(row - Q))], away, atol=1e-9
            )
        # the two solutions are mirror images in the line PQ
        assert abs((found[1] - found[0]) @ (Q - P)) < 1e-8


@pytest.mark.parametrize("away", [(1.0, 0.9), (4.0, 1.9), (0.5, 2.6)])
def test_distances_whose_circles_do_not_meet_locate_no_point(away):
    assert np.isnan(locate((0, 0), (2, 0), *away)).all()


def test_distances_whose_circles_touch_locate_one_point():
    np.testing.assert_allclose(locate((0, 0), (2, 0), 1.5, 0.5), [(1.5, 0)] * 2, atol=1e-7)
    np.testing.assert_allclose(locate((1, 1), (1, 2), 3.0, 2.0), [(1, 4)] * 2, atol=1e-7)


# ---- invalid calls

GOAL, FAR, V = (1.8, 0.6), (1.2, 1.9), (0.1, 0.2)
WRONG = {
    "speed 0": (lambda: plan_moving(ARM, Q0, GOAL, FAR, V, 0), "speed: wanted one positive"),
    "a speed that is almost 0": (
        lambda: plan_moving(ARM, Q0, GOAL, FAR, V, 1e-300),
        "speed: wanted a speed at which .* got 1e-300",
    ),
    "no speed": (lambda: plan_moving(ARM, Q0, GOAL, FAR, V, None), "speed: wanted"),
    "two obstacles": (lambda: plan_moving(ARM, Q0, GOAL, [FAR] * 2, V, 1), "obstacle: .*single"),
    "two velocities": (lambda: plan_moving(ARM, Q0, GOAL, FAR, [V] * 2, 1), "velocity: .*single"),
    "velocity as a number": (lambda: plan_moving(ARM, Q0, GOAL, FAR, 1, 1), "velocity: wanted"),
    "distance": (lambda: plan_moving(ARM, Q0, GOAL, FAR, V, 1, -0.1), "distance: .*-0.1"),
    "degrees": (lambda: plan_moving(ARM, [90, 90, 90], GOAL, FAR, V, 1), "posture: .* to 180"),
    "both sensors at one point": (
        lambda: locate(FAR, FAR, 1, 1),
        "Q: wanted a point different from P",
    ),
    "a distance of 0": (lambda: locate(FAR, GOAL, 0, 1), "from_P: wanted one positive length"),
    "a distance of NaN": (lambda: locate(FAR, GOAL, 1, np.nan), "from_Q: .*nan"),
}


@pytest.mark.parametrize("name", WRONG)
def test_errors_name_the_invalid_argument(name):
    call, words = WRONG[name]
    with pytest.raises(ValueError, match=words):
        call()
    with pytest.raises(TypeError, match="arm: wanted a ThreeLeverArm"):
        plan_moving(None, Q0, GOAL, FAR, V, 1)
