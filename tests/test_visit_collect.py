"""Visit and collect: the document's examples and errata S0, the reference tasks, and properties of
every answer.
"""

import copy
import dataclasses
import itertools
import json
import math
import re
import time
import tracemalloc

import numpy as np
import pytest
from conftest import ROOT
from machines import oracle

from robokin import spbu_arm
from robokin.jobs.visit_collect import (
    ABOVE_LIMIT,
    EXACT_LIMIT,
    KEYS,
    NEAREST_LIMIT,
    TASK_LIMIT,
    Result,
    Task,
    TaskError,
    answer,
    best_visit,
    collect,
    faults,
    itinerary,
    lowest,
    misfit,
    out_of_workspace,
    principal_postures,
    read_task,
    report,
    travel_time,
    visit,
    workspace,
)
from robokin.jobs.visit_collect import task as task_module

TASKS = ROOT / "notebooks" / "tasks"
EXAMPLES = oracle("examples")["spbu"]
CASES = oracle("spbu3_tasks")["cases"]
GOOD = {
    "L1": 5,
    "L2": 4,
    "T": 10,
    "q'": [0.2, 0.2, 0.2],
    "p0": [1, 1, 1],
    "pi": [[2, 3, 2], [1, 3, 3]],
    "task": "visit",
}
cases = pytest.mark.parametrize(
    "case", CASES, ids=[f"{i}-{len(case['pi'])}" for i, case in enumerate(CASES)]
)


def make(**changes):
    """Example 3, with changes."""
    given = dict(
        l1=5,
        l2=4,
        T=10,
        speeds=(0.2, 0.2, 0.2),
        p0=(1, 1, 1),
        points=[(2, 3, 2), (1, 3, 3)],
        kind="visit",
    )
    return Task(**given | changes)


def of_case(case, kind="visit", **changes):
    return make(
        **dict(
            l1=case["L1"],
            l2=case["L2"],
            T=case["T"],
            speeds=case["qdot"],
            p0=case["p0"],
            points=case["pi"],
            kind=kind,
        )
        | changes
    )


def drawn(rng, n, l1=5, l2=4, **changes):
    """A task of n random points of the workspace."""
    points = rng.uniform(-l1 - l2, l1 + l2, (40 * n + 40, 3))
    points = points[workspace(l1, l2, points).all(axis=-1)][: n + 1]
    assert len(points) == n + 1
    return make(**dict(l1=l1, l2=l2, p0=points[0], points=points[1:]) | changes)


def vars_of(task):
    return {name: getattr(task, name) for name in ("l1", "l2", "speeds", "p0", "points", "kind")}


def drawn_on_the_axis(rng, n, axis=3, origin=0, **changes):
    """Like `drawn`, but some of p0 and the points are moved onto axis 1, or onto the origin if the
    links are equal.
    """
    task = drawn(rng, n, **changes)
    places = np.vstack([task.p0, task.points])
    chosen = rng.permutation(n + 1)
    onto = chosen[:axis]
    lowest_on_axis = np.sqrt(max(task.l2**2 - task.l1**2, (task.l1 - task.l2) ** 2))
    places[onto] = 0
    places[onto, 2] = rng.uniform(lowest_on_axis, task.l1 + task.l2, len(onto))
    places[chosen[axis : axis + origin]] = 0
    given = vars_of(task) | {"p0": places[0], "points": places[1:]}
    return make(**given | changes)


def on_a_circle(azimuths, radius=4, z=2):
    return [(radius * np.cos(a), radius * np.sin(a), z) for a in azimuths]


# ---- An independent model: one arm, one move after another, in plain floats


class Walk:
    """The arm of a task, moved from point to point. A free joint is None until a point determines
    it.
    """

    def __init__(self, task, short_way=False):
        self.task, self.short_way, self.time = task, short_way, 0.0
        self.q = self.solved(task.p0)

    def solved(self, p):
        """The three angles by the law of cosines; None for a free joint."""
        l1, l2 = self.task.l1, self.task.l2
        rho, d = math.hypot(p[0], p[1]), math.hypot(*p)
        if d == 0:
            return [None, None, math.pi / 2]
        cosine = (l1**2 + d**2 - l2**2) / (2 * l1 * d)
        q2 = math.atan2(rho, p[2]) - math.acos(max(-1.0, min(1.0, cosine)))
        sine = (l1**2 + l2**2 - d**2) / (2 * l1 * l2)
        q3 = math.asin(max(-1.0, min(1.0, sine)))
        return [math.atan2(p[1], p[0]) if rho > 0 else None, q2, q3]

    def go(self, p):
        """Move to a place; return self."""
        times = [0.0]
        for j, (was, wanted) in enumerate(zip(self.q, self.solved(p), strict=True)):
            if wanted is None:
                continue
            turn = 0.0 if was is None else abs(wanted - was)
            if j == 0 and self.short_way:
                turn = min(turn, abs(2 * math.pi - turn))
            times.append(turn / self.task.speeds[j])
            self.q[j] = wanted
        self.time += max(times)
        return self

    def to(self, i):
        """Move to a point, and back if the task is to collect; return self."""
        self.go(self.task.points[i])
        return self.go(self.task.p0) if self.task.kind == "collect" else self

    def copy(self):
        other = copy.copy(self)
        other.q = list(self.q)
        return other


def walked(task, order, short_way=False):
    """The times at which the points are reached in this order."""
    walk, times = Walk(task, short_way), []
    for i in order:
        times.append(walk.to(i).time)
    return times


def cheapest_next(task, short_way=False):
    """The order in which each next point is the cheapest one that remains, while there is time."""
    walk, order = Walk(task, short_way), []
    while len(order) < len(task.points):
        ways = {i: walk.copy().to(i) for i in range(len(task.points)) if i not in order}
        least = min(way.time for way in ways.values())
        if least > task.T * (1 + 1e-12):
            break
        i = min(i for i, way in ways.items() if way.time <= least + 1e-12 * task.T)
        walk = ways[i]
        order.append(i)
    return order


# ---- The document's examples


def test_example_1_is_refused_with_numbered_faults():
    with pytest.raises(TaskError) as caught:
        read_task(TASKS / "example_1.json")
    assert caught.value.faults == (
        "point 0 = p0 (0, 0.7071, 0.7071) is too close to the origin: |p|^2 = 0.99998082 m^2 is "
        "less than l2^2 - l1^2 - 2 l1 rho = 3.3432 m^2",
    )
    assert (
        EXAMPLES["example1"]["p_sq"] == "0.99998082"
        and "3.3432" in EXAMPLES["example1"]["inequality"]
    )


def test_example_2_collects_one_point():
    task, wanted = read_task(TASKS / "example_2.json"), EXAMPLES["example2"]
    result = answer(task)
    assert result.order == tuple(wanted["collected"]) and result.left == (1,)
    assert result.time == pytest.approx(float(wanted["time"]), rel=0, abs=1e-14)
    both = collect(make(kind="collect", T=20))
    assert both.times == pytest.approx(
        [float(wanted["cost_0"]), float(wanted["sum_both"])], rel=0, abs=1e-14
    )


def test_example_3_visits_both_points():
    task, wanted = read_task(TASKS / "example_3.json"), EXAMPLES["example3"]
    result = answer(task)
    assert result.order == tuple(wanted["visited"]) and result.left == ()
    assert result.times == pytest.approx(
        [float(wanted["d01"]), float(wanted["time"])], rel=0, abs=1e-14
    )
    assert best_visit(task) == result
    other = travel_time(task.q[[0, 2]], task.q[[2, 1]], task.speeds).sum()
    assert other == pytest.approx(float(wanted["other_order"]), rel=0, abs=1e-14)
    for point, q in EXAMPLES["joint_values"].items():
        got = principal_postures(5, 4, json.loads(point.replace("(", "[").replace(")", "]")))
        np.testing.assert_allclose(got, [float(x) for x in q], rtol=0, atol=5e-15)


def test_examples_match_the_document():
    texts = [json.loads((TASKS / f"example_{i}.json").read_text()) for i in (1, 2, 3)]
    assert all(tuple(sorted(text)) == tuple(sorted(KEYS)) for text in texts)
    assert texts[2] == GOOD and texts[1] == GOOD | {"task": "collect"}
    assert texts[0] == {
        "L1": 4,
        "L2": 5,
        "T": 5,
        "q'": [0.02] * 3,
        "p0": [0, 0.7071, 0.7071],
        "pi": [[2, 3, 4], [1, 3, 5]],
        "task": "collect",
    }


def test_report_lists_points_times_and_what_is_left():
    assert report(make(), visit(make())) == (
        "visited 2 of 2 points in 4.379934189305 s (T = 10 s)\n"
        "\t0 (2, 3, 2) at 3.04867394355 s\n\t1 (1, 3, 3) at 4.379934189305 s"
    )
    task = make(kind="collect")
    assert report(task, collect(task)) == (
        "collected 1 of 2 points in 6.097347887101 s (T = 10 s)\n\t0 (2, 3, 2) at 6.097347887101 "
        "s\n\tleft: 1"
    )
    task = make(T=1)
    assert report(task, visit(task)) == "could not visit any points, not enough time (T = 1 s)"


# ---- The reference tasks


@cases
def test_answers_match_the_reference_task(case):
    task = of_case(case)
    np.testing.assert_allclose(task.q, [case["q0"], *case["qi"]], rtol=0, atol=1e-12)
    legs = travel_time(task.q[:, None], task.q, task.speeds)
    np.testing.assert_allclose(legs, case["distance"], rtol=1e-12, atol=1e-12)
    for result, wanted in ((collect(task), case["collect"]), (visit(task), case["visit_greedy"])):
        assert list(result.order) == wanted["indices"]
        assert result.time == pytest.approx(wanted["time"], rel=1e-12)
    best, wanted = best_visit(task), case["visit_optimal"]
    assert len(best.order) == wanted["count"]
    assert best.time == pytest.approx(wanted["time"], rel=1e-12)


@cases
def test_results_are_consistent(case):
    task = of_case(case)
    legs = np.array(case["distance"])
    for result in (visit(task), best_visit(task)):
        assert sorted(result.order + result.left) == list(range(len(case["pi"])))
        stops = [0] + [i + 1 for i in result.order]
        np.testing.assert_allclose(result.times, np.cumsum(legs[stops[:-1], stops[1:]]), rtol=1e-12)
        assert result.time <= case["T"] * (1 + 1e-12)
    brought = collect(task)
    np.testing.assert_allclose(
        brought.times, np.cumsum([2 * legs[0, i + 1] for i in brought.order]), rtol=1e-12
    )
    assert all(2 * legs[0, i + 1] + brought.time > case["T"] for i in brought.left)


@pytest.mark.parametrize("k", [1e-5, 1, 1e5])
def test_tolerance_scales_with_the_reach(k):
    """Errata S0-l: a point that is outside the workspace by less than 1e-12 times the reach counts
    as on the boundary, for an arm of any size.
    """
    behind = np.sqrt(25 - 16)  # the height at which the inner boundary for l1 < l2 meets the axis
    for l1, l2, border, outward, condition in (
        (5, 4, (0, 0, 9), (0, 0, 1), 0),
        (5, 4, (4, 3, 0), (0, 0, -1), 1),
        (5, 4, (0, 1, 0), (0, -1, 0), 2),
        (4, 5, (0, 0, behind), (0, 0, -5 / 3), 3),
        (4, 5, (0.6, 0.8, 0), (-0.6, -0.8, 0), 3),
    ):
        border, outward = k * np.array(border, float), 9 * k * np.array(outward)
        for share, inside in ((-1e-9, True), (0.5e-12, True), (2e-12, False), (1e-9, False)):
            holds = workspace(k * l1, k * l2, border + share * outward)
            assert holds[condition] == inside and np.delete(holds, condition).all()
    q = principal_postures(
        5 * k, 4 * k, k * np.array([(2, 3, 2), (1, 3, 3), (0, 0, 9), (0, 0, 0.5)])
    )
    np.testing.assert_allclose(
        q, principal_postures(5, 4, [(2, 3, 2), (1, 3, 3), (0, 0, 9), (0, 0, 0.5)]), atol=1e-7
    )
    # a point is on axis 1 if it is nearer to it than 1e-13 times the reach
    for rho, free in ((0.5e-13, True), (2e-13, False)):
        assert np.isnan(principal_postures(5 * k, 4 * k, (9 * k * rho, 0, 6 * k))[0]) == free
        folded = principal_postures(4 * k, 4 * k, (0, 0, 8 * k * rho))
        assert np.isnan(folded).tolist() == [True, free, False]


# ---- Travel time


def test_travel_time_is_a_metric():
    q = np.random.default_rng(0).uniform(-1.5, 1.5, (30, 3)) * [2, 1, 1]
    for short_way in (False, True):
        legs = travel_time(q[:, None], q, (0.5, 0.2, 1.0), short_way=short_way)
        assert legs.shape == (30, 30)
        assert (
            (np.diag(legs) == 0).all()
            and (legs == legs.T).all()
            and (legs[~np.eye(30, dtype=bool)] > 0).all()
        )
        assert (legs[:, None] <= legs[:, :, None] + legs + 1e-12).all()  # no detour takes less time


def test_the_slowest_joint_sets_the_travel_time():
    assert travel_time((0, 0, 0), (0.1, -0.4, 0.3), (1, 2, 0.5)) == pytest.approx(0.6)
    assert travel_time((0, 0, 0), (0.1, -0.4, 0.3), (0.1, 2, 0.5)) == pytest.approx(1.0)


def test_joint_1_may_take_the_shorter_turn():
    """Errata S0-o."""
    task = make(p0=(-2, 0.01, 2), points=[(-2, -0.01, 2)], T=100)
    assert visit(task).time == pytest.approx(31.365926952558, abs=1e-11)
    for method in (visit, best_visit):
        assert method(task, short_way=True).time == pytest.approx(0.049999583340, abs=1e-11)
    assert collect(task, short_way=True).time == pytest.approx(2 * 0.049999583340, abs=1e-11)
    q = np.array([3.0, 0, 0]), np.array([-3.0, 0.01, 0])
    assert travel_time(*q, (1, 1, 1), short_way=True) == pytest.approx(2 * np.pi - 6)


@pytest.mark.parametrize("x", [0.0, -0.0, 1e-17])
@pytest.mark.parametrize("y", [0.0, -0.0, -1e-17])
def test_point_on_the_axis_needs_no_turn_of_joint_1(x, y):
    """Errata S0-p: the printed program takes 15.7 s."""
    there = make(p0=(-2, 0, 4), points=[(x, y, 4.9)], T=100)
    back = make(p0=(x, y, 4.9), points=[(-2, 0, 4)], T=100)
    for task in (there, back):
        for method in (visit, best_visit):
            assert method(task).time == pytest.approx(2.1501933177, abs=1e-10)
        assert collect(task).time == pytest.approx(2 * 2.1501933177, abs=1e-10)
    printed = abs(np.diff(spbu_arm(5, 4).ik([(-2, 0, 4), (0, 0, 4.9)])[:, 0], axis=0)).max() / 0.2
    assert printed == pytest.approx(15.7079632679, abs=1e-10)


def test_negative_zero_equals_zero():
    plus, minus = (
        make(p0=(-2, 0.0, 2), points=[(-1, 0.0, 3)]),
        make(p0=(-2, -0.0, 2), points=[(-1, -0.0, 3)]),
    )
    assert visit(plus) == visit(minus) and (plus.q == minus.q).all()
    assert "-0" not in report(minus, visit(minus)).replace("-1", "")
    assert "(0, 20, 1) is too far" in faults(GOOD | {"pi": [[-0.0, 20, 1]]})[0]
    mixed = make(p0=(-2, 0.0, 2), points=[(-2, -0.0, 2)])
    assert visit(mixed).times == (0.0,)


def test_precision_is_kept_near_the_origin():
    """The equal links are nearly folded, so the law of cosines would lose half of the digits."""
    for d in 10.0 ** -np.arange(1, 12):
        point = d * np.array([0.48, -0.64, 0.6])
        q = principal_postures(4, 4, point)
        bend = np.arcsin(d / 8)
        wanted = (
            np.arctan2(-0.64, 0.48),
            np.arctan2(0.8, 0.6) - np.pi / 2 + bend,
            np.pi / 2 - 2 * bend,
        )
        np.testing.assert_allclose(q, wanted, rtol=0, atol=1e-15)
        assert misfit(4, 4, q, point) < 4e-15
        task = make(l1=4, l2=4, p0=(0, 0, 0), points=[point], speeds=(1, 1, 1))
        assert visit(task).time == pytest.approx(2 * bend, rel=1e-15 / d)


def test_two_joints_are_free_where_the_arm_folds_onto_the_origin():
    """Errata S0-k: with equal links the printed program divides by zero at the origin."""
    task = make(l1=4, l2=4, p0=(0, 0, 0), points=[(0, -3, 2)])
    assert np.isnan(task.q[0]).tolist() == [True, True, False] and task.q[0, 2] == pytest.approx(
        np.pi / 2
    )
    assert visit(task).time == pytest.approx((np.pi / 2 - task.q[1, 2]) / 0.2)


# ---- Points on axis 1


def test_path_over_the_axis_still_needs_the_turn_of_joint_1():
    """Regression: on a path through a point on the axis, joint 1 needs 15.71 s for the turn of the
    direct path. The first version took 5.84 s, with joint 1 at 0.538 rad/s.
    """
    task = make(p0=(-2, 0.01, 4), points=[(0, 0, 6.5), (2, -0.01, 4)], T=100)
    turn = np.pi / 0.2
    direct = travel_time(task.q[0], task.q[2], task.speeds)
    assert direct == pytest.approx(turn, abs=1e-9)
    for method in (visit, best_visit):
        result = method(task)
        assert result.order == (0, 1) and result.time > direct + 2.9
        t, q = itinerary(task, result)
        assert q[1, 0] == q[0, 0], "joint 1 should not move"
        assert (abs(np.diff(q, axis=0)) / np.diff(t)[:, None]).max() == pytest.approx(0.2)
    assert visit(make(**vars_of(task), T=15)).order == (0,)


def test_collecting_into_a_container_on_the_axis_keeps_the_speed_limit():
    """Regression: the first version collected these four points in 23.36 s, with joint 1 at 1.07
    rad/s.
    """
    task = make(
        p0=(0, 0, 6.5), points=[(2, 0, 4), (0, 2, 4), (-2, 0, 4), (0, -2, 4)], T=100, kind="collect"
    )
    # without the turn of joint 1 all points are equally far away
    way = travel_time(task.q[0], task.q[1], task.speeds)
    quarter = np.pi / 2 / 0.2
    assert 4 * 2 * way == pytest.approx(23.36, abs=0.005)
    result = collect(task)
    # joint 1 starts at the angle of the first point, each of the next two points is a quarter turn
    # further on, and the last one is beyond the limit at half a turn
    assert result.order == (0, 1, 2, 3)
    np.testing.assert_allclose(
        np.diff(result.times, prepend=0), [2 * way, *2 * [quarter + way], 3 * quarter + way]
    )
    t, q = itinerary(task, result)
    assert (abs(np.diff(q, axis=0)) / np.diff(t)[:, None]).max() == pytest.approx(0.2)
    assert (q[2::2, 0] == q[1::2, 0]).all(), "joint 1 should not move on the way to the container"
    # Going from one end of the turn to the other takes less time, so the cheapest next point is not
    # optimal here.
    assert walked(task, (3, 0, 1, 2))[-1] == pytest.approx(2 * way + 3 * (quarter + way))
    assert walked(task, (3, 0, 1, 2))[-1] < result.time
    assert "p0 is on axis 1" in report(task, result) and "not always the best" in report(
        task, result
    )
    for other in (
        make(kind="collect"),
        make(p0=(0, 0, 6)),
        # there is only one order of a single point
        make(p0=(0, 0, 6), points=[(2, 3, 2)], kind="collect"),
    ):
        assert "axis 1" not in report(other, answer(other))
    two = make(p0=(0, 0, 6), kind="collect")
    assert "axis 1" in report(two, collect(two))


def on_the_axis():
    """Tasks with points on axis 1 and, for equal links, at the origin; p0 may also be there."""
    for seed in range(40):
        rng = np.random.default_rng(seed)
        equal, n = seed % 2, 2 + seed % 4
        l1, l2 = ((4, 4), (5, 4), (4, 5))[0 if equal else 1 + seed % 4 // 2]
        changes = dict(l1=l1, l2=l2, speeds=rng.uniform(0.1, 0.5, 3), T=rng.uniform(10, 60))
        yield drawn_on_the_axis(rng, n, axis=seed % 3 + 1, origin=equal * (seed % 5 > 1), **changes)


AXIS = list(on_the_axis())


@pytest.mark.parametrize("short_way", [False, True])
@pytest.mark.parametrize("kind", ["visit", "collect"])
@pytest.mark.parametrize("number", range(len(AXIS)))
def test_free_joints_keep_their_values(number, kind, short_way):
    task = make(**vars_of(AXIS[number]) | {"kind": kind}, T=AXIS[number].T)
    wanted = cheapest_next(task, short_way)
    method = collect if kind == "collect" else visit
    result = method(task, short_way=short_way)
    assert list(result.order) == wanted
    np.testing.assert_allclose(result.times, walked(task, wanted, short_way), rtol=1e-9)
    t, q = itinerary(task, result, short_way=short_way)
    np.testing.assert_allclose(t[1 + (kind == "collect") :: 1 + (kind == "collect")], result.times)
    places = [task.p0]
    for i in result.order:
        places += [task.points[i], task.p0] if kind == "collect" else [task.points[i]]
    np.testing.assert_allclose(spbu_arm(task.l1, task.l2).fk(q).translation, places, atol=1e-9)
    # no joint exceeds its limit, and the slowest runs at its limit
    needed = (abs(np.diff(q, axis=0)) / task.speeds).max(axis=-1, initial=0)
    np.testing.assert_allclose(needed, np.diff(t), rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("short_way", [False, True])
@pytest.mark.parametrize("number", range(0, len(AXIS), 2))
def test_the_optimum_over_the_axis_is_the_best_of_all_orders(number, short_way):
    for task in AXIS[number : number + 2]:
        n, rated = len(task.points), []
        for k in range(n + 1):
            for order in itertools.permutations(range(n), k):
                total = ([0.0] + walked(task, order, short_way))[-1]
                if total <= task.T:
                    rated.append((-k, total, order))
        most, least, _ = min(rated)
        first = min(o for k, total, o in rated if k == most and total <= least * (1 + 1e-12))
        best = best_visit(task, short_way=short_way)
        assert best.order == first
        assert best.times == pytest.approx(walked(task, first, short_way), rel=1e-9)


def test_a_start_on_the_axis_takes_the_angle_of_the_first_target_off_it():
    task = make(p0=(0, 0, 5), points=[(0, 0, 6), (0, -3, 3)], T=100)
    t, q = itinerary(task, visit(task))
    assert q[:, 0].tolist() == [-np.pi / 2] * 3
    assert visit(task).order == best_visit(task).order == (0, 1)
    origin = make(l1=4, l2=4, p0=(0, 0, 0), points=[(0, 0, 5), (0, -3, 3)], T=100)
    for order in ((0, 1), (1, 0)):
        t, q = itinerary(origin, Result(order, walked(origin, order), ()))
        assert q[:, 0].tolist() == [-np.pi / 2] * 3
        first = principal_postures(4, 4, origin.points[order[0]])[1]
        assert q[0, 1] == q[1, 1] == first and not np.isnan(first)


# ---- Above the floor (errata S0-u)


def test_moves_below_the_floor_are_reported():
    task = make(p0=(6, 0, 1), points=[(1.05, 0, 0.1)], T=100)
    assert lowest(5, 4, *task.q) == pytest.approx(-1.016, abs=5e-4)
    text = report(task, visit(task))
    assert text.endswith(
        "\n\twarning: the move from p0 to pi[0] dips under the floor, down to z = -1.016 m"
    )
    task = make(p0=(6, 0, 0), points=[(1.2, 0, 0)], T=100, kind="collect")
    assert "between p0 and pi[0] dips under the floor, down to z = -1.051 m" in report(
        task, collect(task)
    )
    order = make(p0=(6, 0, 1), points=[(2, 3, 2), (1.05, 0, 0.1), (6, 0, 1)], T=100)
    result = Result((0, 2, 1), (1.0, 2.0, 3.0), ())
    assert [line for line in report(order, result).splitlines() if "warning" in line] == [
        "\twarning: the move from pi[2] to pi[1] dips under the floor, down to z = -1.016 m"
    ]


def test_above_floor_avoids_moves_below_the_floor():
    places = [(1.05, 0, 0.1), (0, -2, 2), (6, 0, 1)]
    task = make(p0=(6, 0, 1), points=places, T=100)
    assert visit(task).order == best_visit(task).order == (2, 0, 1)
    assert "dips" in report(task, visit(task))
    for result in (visit(task, above_floor=True), best_visit(task, above_floor=True)):
        assert result.order == (2, 1, 0) and "dips" not in report(task, result)
    brought = make(p0=(6, 0, 1), points=places, T=100, kind="collect")
    result = collect(brought, above_floor=True)
    assert result.order == (2, 1) and result.left == (0,) and "dips" not in report(brought, result)
    assert answer(task, above_floor=True) == visit(task, above_floor=True)
    assert answer(brought, above_floor=True) == result
    # by default no move is refused
    assert answer(task) == visit(task) and answer(brought) == collect(brought)
    assert collect(brought).order == (2, 0, 1)
    only = make(p0=(6, 0, 1), points=places[:1], T=100)
    assert report(only, visit(only, above_floor=True)) == (
        "could not visit any points, since every move that is in time dips under the floor "
        "(T = 100 s)"
    )
    assert best_visit(only, above_floor=True).order == ()
    short = make(p0=(6, 0, 1), points=places[:1], T=1)
    assert "not enough time" in report(short, visit(short, above_floor=True))
    needed = 2 * visit(only).time
    for T, why in (
        (needed * 0.99, "not enough time"),
        (needed, "since every move that is in time dips"),
    ):
        given = vars_of(brought) | {"points": places[:1]}
        assert why in report(make(**given, T=T), Result((), (), (0,)))
        given["kind"] = "visit"
        assert why in report(make(**given, T=T / 2), Result((), (), (0,)))


@pytest.mark.parametrize("k", [1e-3, 1, 1e3])
def test_tiny_dips_below_the_floor_count_as_rounding(k):
    """Between two neighbouring points on the floor, the dip is proportional to the square of their
    distance.
    """

    def beside(distance):
        points = [(k * (6 - distance), 0, 0)]
        return make(l1=5 * k, l2=4 * k, p0=(6 * k, 0, 0), points=points, T=100)

    wide = beside(1e-2)
    depth = -dense(wide, *wide.q[:, None])[0] / k
    assert 1e-8 < depth < 1e-6
    for share, told in ((0.5e-9, False), (2e-9, True)):
        task = beside(1e-2 * np.sqrt(share * 9 / depth))
        assert ("dips" in report(task, visit(task))) == told
        assert len(visit(task, above_floor=True).order) == (not told)


@pytest.mark.parametrize("kind", ["visit", "collect"])
def test_above_floor_includes_every_possible_point_from_a_start_on_the_axis(kind):
    task = make(p0=(0, 0, 3), points=[(1.05, 0, 0), (7, 0, 0), (3, 0, 0.2)], T=1000, kind=kind)
    low = lowest(5, 4, task.q[:, None], task.q) < -1e-9
    assert low[2, 1] and low[1, 2] and not low[0].any()
    result = answer(task, above_floor=True)
    assert "dips" not in report(task, result) and result.order
    here = 0 if kind == "collect" else result.order[-1] + 1
    assert all(low[here, i + 1] for i in result.left), "points that are left cannot be reached"


def dense(task, start, end, count=801):
    """The least height among `count` samples of each move (n, 3), from the arm's own forward
    kinematics.
    """
    share = np.linspace(0, 1, count)[:, None, None]
    heights = spbu_arm(task.l1, task.l2).fk(start + share * (end - start)).translation[..., 2]
    return heights.min(axis=0)


@pytest.mark.parametrize("l1, l2", [(5, 4), (5, 1), (1, 0.99), (0.3, 0.2), (4, 4), (4, 5), (1, 9)])
def test_lowest_matches_a_dense_sample(l1, l2):
    rng = np.random.default_rng(3)
    task = drawn(rng, 1500, l1=l1, l2=l2)
    start, end = task.q[:-1], task.q[1:]
    start, end = (np.where(np.isnan(q), 0, q) for q in (start, end))
    got, sample = lowest(l1, l2, start, end), dense(task, start, end)
    assert (got <= sample + 2e-9 * (l1 + l2)).all()
    # between two samples the tool is at most turn^2 / 8 lower, and a turn is at most 2 pi / 800
    assert (got >= sample - (l1 + l2) * (2 * np.pi / 800) ** 2).all()
    ends = np.minimum(task.points[:, 2], np.vstack([task.p0, task.points[:-1]])[:, 2])
    assert (got <= ends + 1e-12).all()
    if l1 <= l2:
        assert (got > -1e-12).all(), "the tool should not dip for l1 <= l2"
    if l1 > 1.2 * l2:
        assert (got < ends - 1e-2 * l1).any() and (got < 0).any()


@pytest.mark.parametrize("l1, l2", [(5, 4), (4, 5), (9, 1)])
def test_lowest_is_correct_for_any_move(l1, l2):
    """The moves are between any postures within the limits; their lowest point is often between the
    ends.
    """
    start, end = np.random.default_rng(6).uniform(-np.pi / 2, np.pi / 2, (2, 2000, 3))
    task = make(l1=l1, l2=l2, p0=(0, 8.5, 1), points=[(0, 8.5, 1)])
    got, sample = lowest(l1, l2, start, end), dense(task, start, end)
    assert (got <= sample + 1e-8).all()
    assert (got >= sample - (l1 + l2) * (2 * np.pi / 800) ** 2).all()
    assert (got < np.minimum(*(lowest(l1, l2, q, q) for q in (start, end))) - 0.1).sum() > 5


@pytest.mark.parametrize("l1, l2", [(5, 4), (4, 5)])
def test_lowest_is_the_same_in_both_directions(l1, l2):
    start, end = np.random.default_rng(8).uniform(-6, 6, (2, 1000, 3))
    there, back = lowest(l1, l2, start, end), lowest(l1, l2, end, start)
    np.testing.assert_allclose(there, back, atol=1e-8)
    assert (there > -l1 - l2).all() and np.ptp(there) > 1


def test_floor_check_finds_the_shallowest_dips():
    """For moves between points on the floor or just above it, the check finds the shallowest dips
    and no false ones. The reference bisects the bracket around the minimum of a dense sample.
    """
    from scipy.optimize import minimize_scalar

    rng = np.random.default_rng(4)
    rho, z = rng.uniform(1.001, 9, (2, 400)), 10 ** rng.uniform(-9, -2, (2, 400))
    z[:, ::3] = 0
    p = np.stack([rho, 0 * rho, np.minimum(z, np.sqrt(81 - rho**2))], axis=-1)
    assert workspace(5, 4, p).all()
    start, end = principal_postures(5, 4, p)
    got = lowest(5, 4, start, end)
    arm, share, exact = spbu_arm(5, 4), np.linspace(0, 1, 501), []
    for a, b in zip(start, end, strict=True):

        def height(s, a=a, b=b):
            return float(arm.fk(a + s * (b - a)).translation[2])

        sample = arm.fk(a + share[:, None] * (b - a)).translation[:, 2]
        k = int(sample.argmin())
        bounds = share[max(k - 1, 0)], share[min(k + 1, 500)]
        found = minimize_scalar(height, bounds=bounds, method="bounded", options={"xatol": 1e-12})
        exact.append(min(found.fun, sample.min()))
    np.testing.assert_allclose(got, exact, rtol=0, atol=1e-8)
    assert ((-1e-3 < got) & (got < -1e-8)).sum() > 3, "wanted some shallow dips"


def test_lowest_accepts_batches_and_free_joints():
    rng = np.random.default_rng(5)
    q = drawn(rng, 11).q.reshape(3, 4, 3)
    wide = lowest(5, 4, q[:, None], q)
    assert wide.shape == (3, 3, 4)
    assert lowest(5, 4, (4 * np.pi, 0, 0), (-4 * np.pi, 0, 0)) == 5
    for i, j, k in ((0, 0, 0), (0, 2, 1), (2, 1, 3)):
        assert wide[i, j, k] == lowest(5, 4, q[i, k], q[j, k])
    assert lowest(5, 4, np.zeros((0, 3)), np.zeros(3)).shape == (0,)
    # one move at a time and many at once give the same result
    many = np.tile(drawn(rng, 300).q, (15, 1))
    assert (
        lowest(5, 4, many, many[::-1])[:301] == lowest(5, 4, many[:301], many[::-1][:301])
    ).all()
    # joint 1 does not matter, a free joint 2 does not move, and a missing posture has no height
    assert lowest(5, 4, (np.nan, 0.1, 0.2), (2, 0.3, 0.1)) == lowest(
        5, 4, (0, 0.1, 0.2), (2, 0.3, 0.1)
    )
    folded = (np.nan, np.nan, np.pi / 2)
    assert lowest(4, 4, folded, (0, 0.3, 1)) == lowest(4, 4, (0, 0.3, np.pi / 2), (0, 0.3, 1))
    assert lowest(4, 4, (0, 0.3, 1), folded) == lowest(4, 4, folded, (0, 0.3, 1))
    assert lowest(4, 4, folded, folded) == pytest.approx(0, abs=1e-15)
    assert np.isnan(lowest(5, 4, [(np.nan,) * 3, (0, 0, 0)], (0, 0.1, 0.2))).tolist() == [
        True,
        False,
    ]


# ---- Time allowed, ties


def test_time_equal_to_T_counts():
    rng = np.random.default_rng(5)
    for n in (1, 3, 8):
        full = drawn(rng, n, T=1e6)
        for method in (collect, visit):
            times = method(full).times
            assert len(times) == n
            for k in range(n):
                exact = make(**vars_of(full), T=times[k])
                assert method(exact).times == times[: k + 1]
                less = make(**vars_of(full), T=times[k] * (1 - 1e-9))
                assert method(less).times == times[:k]
        best = best_visit(full)
        assert best_visit(make(**vars_of(full), T=best.time)) == best
        assert len(best_visit(make(**vars_of(full), T=best.time * (1 - 1e-9))).order) == n - 1
    assert collect(make(T=6.097347887100909)).order == (0,)  # errata S0-r
    assert visit(make(T=4.379934189305)).order == (0, 1), (
        "T was copied from the report, which rounds it"
    )


@pytest.mark.parametrize(
    "T, served", [(0, ()), (-0.0, ()), (3, ()), (4, (0,)), (4.379, (0,)), (4.38, (0, 1))]
)
def test_visit_ends_when_there_is_no_time_for_the_nearest_point(T, served):
    """Errata S0-f: the printed program never ends."""
    assert visit(make(T=T)).order == best_visit(make(T=T)).order == served
    assert visit(make(T=T)).left == tuple({0, 1} - set(served))


def test_tour_without_points_takes_no_time():
    result = visit(make(T=0))
    assert result == best_visit(make(T=0)) == collect(make(T=0)) == Result((), (), (0, 1))
    assert result.time == 0.0
    # only points at which the arm already is are visited
    at_start = make(T=0, points=[(2, 3, 2), (1, 1, 1), (1, 1, 1)])
    assert visit(at_start).order == collect(at_start).order == best_visit(at_start).order == (1, 2)


def test_ties_go_to_the_lowest_index():
    same = make(points=[(2, 3, 2)] * 5, T=4)
    assert visit(same).order == best_visit(same).order == (0, 1, 2, 3, 4)
    assert collect(make(points=[(1, 3, 3), (2, 3, 2), (1, 3, 3), (2, 3, 2)], T=1e3)).order == (
        1,
        3,
        0,
        2,
    )
    # Points mirrored in the plane of the start, at azimuths where the two angles differ by
    # rounding.
    for azimuth in np.linspace(-2, 2, 41):
        mirrored = make(
            p0=on_a_circle([azimuth])[0],
            points=on_a_circle(azimuth + np.array([0.3, -0.3, 0.3, -0.3])),
            T=1e3,
        )
        assert visit(mirrored).order == best_visit(mirrored).order == (0, 2, 1, 3)
        assert collect(mirrored).order == (0, 1, 2, 3)


def test_extreme_speeds_and_times_cause_no_warning():
    """There is an answer even for extreme float values."""
    never = make(speeds=(5e-324,) * 3, T=1.7e308)
    assert visit(never).order == collect(never).order == best_visit(never).order == ()
    at_once = make(speeds=(1.7e308,) * 3, T=0)
    assert visit(at_once).order == ()  # even a fast move takes more than 0 s
    assert visit(make(speeds=(1.7e308,) * 3, T=1e-300)).order == (0, 1)


# ---- The optimum


def test_greedy_visit_can_be_worse_than_the_best():
    """Errata S0-q."""
    task = make(
        p0=on_a_circle([0])[0], points=on_a_circle([1.0, -1.1, -1.2, -1.3]), speeds=(1, 1, 1), T=1.5
    )
    greedy, best = visit(task), best_visit(task)
    assert greedy.order == (0,) and greedy.time == pytest.approx(1.0)
    assert best.order == (1, 2, 3) and best.time == pytest.approx(1.3) and best.left == (0,)


@pytest.mark.parametrize("seed", range(12))
def test_the_optimum_is_the_best_of_all_orders(seed):
    rng = np.random.default_rng(seed)
    n = 2 + seed % 5
    task = drawn(rng, n, T=rng.uniform(5, 60), l1=4, l2=5 if seed % 2 else 4)
    if seed % 3 == 0:  # with duplicate points
        task = make(
            **vars_of(task) | {"points": np.concatenate([task.points[:-1], task.points[:1]])},
            T=task.T,
        )
    legs = travel_time(task.q[:, None], task.q, task.speeds)
    rated = []
    for k in range(n + 1):
        for order in itertools.permutations(range(n), k):
            stops = [0] + [i + 1 for i in order]
            total = legs[stops[:-1], stops[1:]].sum()
            if total <= task.T:
                rated.append((-k, total, order))
    most, least, _ = min(rated)
    first = min(order for k, total, order in rated if k == most and total <= least * (1 + 1e-12))
    best = best_visit(task)
    assert best.order == first and best.time == pytest.approx(least, rel=1e-12)
    greedy = visit(task)
    assert len(greedy.order) <= len(best.order)
    assert len(greedy.order) < len(best.order) or greedy.time >= best.time * (1 - 1e-12)


def test_remaining_points_are_sorted():
    points = np.full((10, 3), (2.0, 3, 2))
    points[[1, 8]] = (-2, -3, 2)
    for method, T in ((visit, 10), (best_visit, 10), (collect, 60)):
        assert method(make(points=points, T=T)).left == (1, 8)


def test_more_time_never_reduces_the_number_of_points():
    rng = np.random.default_rng(7)
    given = vars_of(drawn(rng, 7))
    for method in (collect, visit, best_visit):
        counts = [len(method(make(**given, T=T)).order) for T in np.linspace(0, 300, 61)]
        assert counts == sorted(counts) and counts[0] == 0 and counts[-1] == 7


def test_exact_method_states_its_limit():
    rng = np.random.default_rng(8)
    many = drawn(rng, EXACT_LIMIT + 1)
    words = r"at most 16 points for the exact optimum, got 17.*visit\(\) takes up to 10000"
    with pytest.raises(ValueError, match=words):
        best_visit(many)
    visit(many)


# ---- The itinerary


@pytest.mark.parametrize("short_way", [False, True])
@cases
def test_itinerary_agrees_with_the_result(case, short_way):
    for kind, method in (("visit", visit), ("visit", best_visit), ("collect", collect)):
        task = of_case(case, kind)
        result = method(task, short_way=short_way)
        t, q = itinerary(task, result, short_way=short_way)
        ways = 2 if kind == "collect" else 1
        assert t.shape == (ways * len(result.order) + 1,) and q.shape == (len(t), 3)
        np.testing.assert_allclose(t[ways::ways], result.times, rtol=1e-12)
        places = spbu_arm(task.l1, task.l2).fk(q).translation
        np.testing.assert_allclose(
            places[ways - 1 + (ways == 1) :: ways], task.points[list(result.order)], atol=1e-12
        )
        if kind == "collect":
            np.testing.assert_allclose(
                places[::2], np.tile(task.p0, (len(result.order) + 1, 1)), atol=1e-12
            )
        share = abs(np.diff(q, axis=0)) / task.speeds / np.diff(t)[:, None]
        # the slowest joint always runs at its limit
        np.testing.assert_allclose(share.max(axis=-1, initial=0), 1, rtol=1e-9)


def test_itinerary_over_the_axis_is_complete():
    task = make(l1=4, l2=4, points=[(0, 0, 6), (0, 0, 0), (-2, 0.5, 3), (0, 0, 5)], T=1e3)
    t, q = itinerary(task, visit(task))
    assert np.isfinite(q).all() and len(t) == 5
    np.testing.assert_allclose(
        spbu_arm(4, 4).fk(q).translation[1:], task.points[list(visit(task).order)], atol=1e-12
    )
    up = make(p0=(0, 0, 5), points=[(0, 0, 6)], T=100)
    assert (itinerary(up, visit(up))[1][:, 0] == 0).all(), (
        "wanted 0, since nothing determines joint 1"
    )
    assert itinerary(make(T=0), visit(make(T=0)))[1] == pytest.approx(make().q[:1])


# ---- Large tasks


def many(n, seed=0, **changes):
    return drawn(np.random.default_rng(seed), n, **dict(T=1e12, kind="collect") | changes)


def test_a_large_task_is_collected_in_seconds():
    began = time.process_time()
    task = many(200_000)
    result = collect(task)
    text = report(task, result)
    assert time.process_time() - began < 20  # about 1.5 s of CPU
    assert len(result.order) == 200_000 and result.left == ()
    costs = 2 * travel_time(task.q[0], task.q[1:], task.speeds)
    assert (np.diff(costs[list(result.order)]) >= -1e-9).all()
    np.testing.assert_allclose(result.times, np.cumsum(np.sort(costs)), rtol=1e-9)
    lines = text.splitlines()
    assert lines[0].startswith("collected 200000 of 200000 points")
    assert len(lines) < 1020 and lines[1001] == "\tand 199000 more points"
    half = make(**vars_of(task), T=result.times[99_999])
    assert collect(half).order == result.order[:100_000]
    assert report(half, collect(half)).count("\n") < 1020
    assert re.search(r"left: [\d, ]+ and 99000 more", report(half, collect(half)))


def test_quadratic_work_is_limited():
    on_axis = many(NEAREST_LIMIT + 1, p0=(0, 0, 5))
    some = many(ABOVE_LIMIT + 1, p0=(0, 0, 5), T=1)
    for call, what in ((visit, "visit"), (collect, "collect with p0 on axis 1")):
        words = rf"pi: wanted at most 10000 points to {what}, got 10001 .*5\.0e\+07 moves"
        with pytest.raises(TaskError, match=words):
            call(on_axis)
        call(some)
        words = f"at most 1000 points to {what} above the floor, got 1001"
        with pytest.raises(TaskError, match=words):
            call(some, above_floor=True)
    full = many(NEAREST_LIMIT, T=3)
    assert len(visit(full).order) > 3
    allowed = many(ABOVE_LIMIT, T=3)
    assert len(visit(allowed, above_floor=True).order) > 1
    off_axis = many(ABOVE_LIMIT + 1, T=1e4)
    assert len(collect(off_axis, above_floor=True).order) > 100, "this task only needs sorting"


def test_tasks_with_too_many_points_are_refused():
    for given in ([[1, 1, 1]] * (TASK_LIMIT + 1), np.ones((TASK_LIMIT + 1, 3))):
        began = time.process_time()
        with pytest.raises(
            TaskError, match="pi: wanted a non-empty array of points, at most 300000, got"
        ):
            make(points=given)
        assert time.process_time() - began < 5
    assert len(make(points=np.ones((TASK_LIMIT, 3))).points) == TASK_LIMIT
    found = faults(GOOD | {"pi": [[1, 1, 1]] * (TASK_LIMIT + 1)})
    assert len(found) == 1 and found[0].endswith(
        f"points, at most 300000, got {TASK_LIMIT + 1} of them"
    )


def test_many_faults_are_counted():
    """The first ten faults of each kind are described, and the others are counted."""
    began = time.process_time()
    bad = (
        [[9, 9, 9]] * 40_000
        + [[1, 1]] * 30_000
        + [[2, 3, -1]] * 20_000
        + [[0.1, 0, 0.1]] * 11
        + [[9, 9, -9]]
    )
    found = faults(GOOD | {"pi": bad, "p0": [0, 0, -1]})
    assert time.process_time() - began < 5
    kinds = (
        "wanted an array of 3",
        "is too far",
        "is under the floor",
        "is too close to the origin",
    )
    assert [sum(kind in text for text in found) for kind in kinds] == [10, 10, 10, 10]
    assert (
        found[0].startswith("pi[40000]: wanted")
        and found[10] == "and 29990 more points that are not such arrays"
    )
    assert found[11] == "point 0 = p0 (0, 0, -1) is under the floor: z = -1 m"
    assert [text for text in found if text.startswith("and")][1:] == [
        "and 39991 more points are too far",
        "and 19992 more points are under the floor",
        "and 1 more points are too close to the origin",
    ]
    assert len(found) == 44 and sum(map(len, found)) < 10_000
    with pytest.raises(TaskError) as caught:
        make(points=bad, p0=(0, 0, -1))
    assert list(caught.value.faults) == found
    ten = faults(GOOD | {"pi": [[9, 9, 9]] * 10 + [[1]] * 10})
    assert len(ten) == 20 and not any(text.startswith("and") for text in ten)
    eleven = faults(GOOD | {"pi": [[9, 9, 9]] * 11})
    assert len(eleven) == 11 and eleven[-1] == "and 1 more points are too far"


def test_a_report_counts_low_moves_after_the_first_ten():
    low = [(1.2, 0, 0)] * 1500
    task = make(p0=(6, 0, 0), points=low, T=1e6, kind="collect")
    lines = report(task, collect(task)).splitlines()
    assert len(lines) == 1 + 1000 + 1 + 10 + 1
    assert lines[-2].startswith("\twarning: the move between p0 and pi[9] dips")
    assert lines[-1] == "\twarning: and 1490 more such moves"
    task = make(p0=(6, 0, 0), points=low[:10], T=1e6, kind="collect")
    lines = report(task, collect(task)).splitlines()
    assert len(lines) == 1 + 10 + 10 and "more" not in lines[-1]


def test_the_exact_optimum_of_sixteen_points_takes_seconds():
    """The tasks are with and without points on axis 1."""
    rng = np.random.default_rng(9)
    for axis in (0, 6):
        task = drawn_on_the_axis(rng, EXACT_LIMIT, axis=axis, T=30)
        began = time.process_time()
        best = best_visit(task)
        assert time.process_time() - began < 20
        assert len(best.order) >= len(visit(task).order)
        assert best.times == pytest.approx(walked(task, best.order), rel=1e-9)


# ---- Invalid tasks


def test_wrong_joint_values_are_detected():
    """Errata S0-e: these joint values pass all seven printed checks, although the tool is 5.7154 m
    from the point in the arm's own plane.
    """
    wrong = (-0.549597363236, 1.568403110925, 0.373893819911)
    assert misfit(5, 4, wrong, (2, 3, 2)) > 5.7154
    tip = spbu_arm(5, 4).fk(wrong).translation
    assert np.hypot(np.hypot(*tip[:2]) - np.hypot(2, 3), tip[2] - 2) == pytest.approx(
        5.7154, abs=1e-4
    )
    q = make().q[1]
    assert misfit(5, 4, q, (2, 3, 2)) < 1e-14
    assert misfit(5, 4, q + [0.5, 0, 0], (2, 3, 2)) > 1.7, "the angle of joint 1 should be checked"
    rows = spbu_arm(5, 4).ik((2, 3, 2))
    assert misfit(5, 4, rows, (2, 3, 2))[1:].tolist() == [np.inf] * 3, (
        "wanted inf outside the limits"
    )
    assert np.isnan(misfit(5, 4, spbu_arm(5, 4).ik((9, 9, 9)), (9, 9, 9))).all()


@pytest.mark.parametrize("k", [1e-3, 1e3])
def test_misfit_detects_a_wrong_inverse(k, monkeypatch):
    """The joint values of the inverse are checked with the forward kinematics, point by point."""
    right = principal_postures
    given = GOOD | {"L1": 5 * k, "L2": 4 * k, "p0": [k, k, k], "pi": [[0, 9 * k, 0]] * 12}

    def off(by, rows):
        def wrong(l1, l2, points):
            q = right(l1, l2, points)
            q[rows] += by
            return q

        monkeypatch.setattr(task_module, "principal_postures", wrong)
        return faults(given)

    assert off([0.5e-6, 0, 0], 3) == []  # the error is 0.5e-6 of the reach
    assert off([2e-6, 0, 0], 3) == [
        f"point 3 = pi[2] (0, {9 * k:.12g}, 0) fails the check of its joint values: "
        f"off by {1.8e-5 * k:.4g} m"
    ]
    assert [text.split()[-2:] for text in off(np.nan, [0, 12])] == [["nan", "m"]] * 2
    many = off([1, 0, 0], slice(None))
    assert len(many) == 11 and many[-1] == "and 3 more points fail it"


WRONG = {
    "no L1": ({"L1"}, {}, ["missing: L1"]),
    "keys of other names": ({"q'", "pi"}, {"q": [1, 1, 1], "Pi": []}, ["missing: q', pi"]),
    "text": (
        (),
        {"L1": "5"},
        ["L1: wanted a positive number of metres, from 1e-06 to 1e.06, got '5'"],
    ),
    "true": ((), {"T": True}, ["T: wanted a finite number of seconds, not negative, got True"]),
    "no length": ((), {"L2": 0}, ["L2: wanted a positive number"]),
    "backwards": ((), {"L1": -5}, ["L1: .*got -5"]),
    "not a number": ((), {"L1": np.nan}, ["L1: .*got nan"]),
    "for ever": ((), {"T": np.inf}, ["T: .*got inf"]),
    "before": ((), {"T": -1}, ["T: .*got -1"]),
    "null": ((), {"T": None}, ["T: .*got None"]),
    "huge": ((), {"T": 10**400}, [r"T: .*got 10000+\.\.\.0+"]),
    "standing": (
        (),
        {"q'": [0.2, 0, 0.2]},
        [r"q': wanted an array of 3 positive .* rad/s, got \[0.2, 0, "],
    ),
    "turning back": ((), {"q'": [-0.2] * 3}, ["q': wanted"]),
    "one speed": ((), {"q'": 0.2}, ["q': .*got 0.2"]),
    "a true speed": ((), {"q'": [True, 1, 1]}, [r"q': .*got \[True, 1, 1\]"]),
    "an object": (
        (),
        {"p0": {"x": 1}},
        [r"p0: wanted an array of 3 finite numbers, m, got \{'x': 1\}"],
    ),
    "nested": ((), {"p0": [[1, 1, 1]]}, ["p0: wanted"]),
    "in the plane": ((), {"p0": [1, 1]}, ["p0: wanted"]),
    "flat": (
        (),
        {"pi": [2, 3, 2]},
        [rf"pi\[{i}\]: wanted an array of 3 .* got {v}" for i, v in enumerate("232")],
    ),
    "none": ((), {"pi": []}, ["pi: wanted a non-empty array of points"]),
    "words": ((), {"pi": "abc"}, ["pi: wanted a non-empty"]),
    "two of three": (
        (),
        {"pi": [[1, 2], [2, 3, 2], [1, 3, np.nan]]},
        [r"pi\[0\]: ", r"pi\[2\]: .*nan"],
    ),
    "nested points": ((), {"pi": [[[2, 3, 2]]]}, [r"pi\[0\]: "]),
    "other task": (
        (),
        {"task": "Visit"},
        ['task: wanted either "visit" or "collect", got \'Visit\''],
    ),
    "list of tasks": ((), {"task": ["visit"]}, ["task: "]),
    "too far": ((), {"pi": [[2, 3, 2], [9, 9, 9]]}, [r"point 2 = pi\[1\] \(9, 9, 9\) is too far"]),
    "out of all reach": (
        (),
        {"pi": [[1e308, -1e308, 1e308]]},
        [r"point 1 = .* is too far: 1\.732e.308 m"],
    ),
    "under floor": (
        (),
        {"p0": [2, 3, -2]},
        [r"point 0 = p0 \(2, 3, -2\) is under the floor: z = -2 m"],
    ),
    "all at once": (
        {"L2", "task"},
        {"T": -1, "q'": [1], "p0": "here", "pi": [[1], [2, 3, 4]]},
        ["missing: L2, task", "T: ", "q': ", "p0: ", r"pi\[0\]: "],
    ),
    "shape and place": (
        (),
        {"T": None, "p0": [0, 0, -1], "pi": [[9, 9, 9], [1, True, 1], [0, 0, 0]]},
        [
            "T: ",
            r"pi\[1\]: ",
            "point 0 = p0 .* under the floor",
            r"point 1 = pi\[0\] .* too far",
            r"point 3 = pi\[2\] .* too close to the origin",
        ],
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_all_faults_are_listed(name, tmp_path):
    without, changes, wanted = WRONG[name]
    data = {key: value for key, value in (GOOD | changes).items() if key not in without}
    found = faults(data)
    assert len(found) == len(wanted), found
    for text, pattern in zip(found, wanted, strict=True):
        assert re.match(pattern, text), text
        assert len(text) < 200 and "\n" not in text
    path = tmp_path / "task.json"
    path.write_text(json.dumps(data))
    with pytest.raises(TaskError) as caught:
        read_task(path)
    assert list(caught.value.faults) == found and str(caught.value) == "; ".join(found)
    if set(data) == set(KEYS):  # a task made in Python gives the same messages
        with pytest.raises(ValueError) as caught:
            Task(*(data[key] for key in KEYS))
        assert list(caught.value.faults) == found


FILES = {
    "empty": (b"", "is empty"),
    "blank": (b" \n\t", "is empty"),
    "truncated": (json.dumps(GOOD).encode()[:-20], "is not JSON: "),
    "two tasks": ((json.dumps(GOOD) * 2).encode(), "is not JSON: Extra data, line 1 column "),
    "Latin": ('{"L1": "дл"}'.encode("cp1251"), "is not UTF-8: byte 0xe4 at position 8"),
    "UTF-16": (json.dumps(GOOD).encode("utf-16"), "is not UTF-8: byte 0xff at position 0"),
    "zeros": (bytes(300), "is not JSON: "),
    "a number": (b"5", "wanted an object with the keys L1, L2, T, q', p0, pi, task, got 5"),
    "a list": (json.dumps([GOOD]).encode(), "wanted an object with the keys"),
    "null": (b"null", "wanted an object with the keys .* got None"),
    "deep": (b"[" * 200_000, "is not a task: nested too deeply"),
    "rather deep": (json.dumps(GOOD).encode().replace(b"10", b"[" * 400 + b"]" * 400), "T: wanted"),
    "many digits": (
        json.dumps(GOOD).encode().replace(b"10", b"1" * 5000),
        "is not JSON: a number with thousands",
    ),
    "infinite": (json.dumps(GOOD).encode().replace(b"10", b"1e999"), "T: wanted .* got inf"),
    "surrogate": (json.dumps(GOOD).encode().replace(b"visit", b"\\ud800"), "task: wanted"),
}


@pytest.mark.parametrize("name", FILES)
def test_files_that_are_not_tasks_are_refused(name, tmp_path):
    data, wanted = FILES[name]
    path = tmp_path / "x.json"
    path.write_bytes(data)
    with pytest.raises(TaskError, match=wanted) as caught:
        read_task(path)
    assert len(caught.value.faults) == 1 and "\n" not in str(caught.value)
    assert path.read_bytes() == data


def test_paths_that_are_not_files_are_refused(tmp_path):
    for path, wanted in (
        (tmp_path, "is not a file but a folder"),
        (tmp_path / "no.json", "cannot be read: No such"),
    ):
        with pytest.raises(TaskError, match=f"^{wanted}"):
            read_task(path)


def test_allowed_variations_of_a_file_are_read(tmp_path):
    path = tmp_path / "x.json"
    path.write_text(
        "\ufeff" + json.dumps(GOOD | {"comment": "a key of its own", "L1": 5.0}), encoding="utf-8"
    )
    task = read_task(str(path))
    assert visit(task) == visit(make()) and task.kind == "visit" and task.T == 10.0


def test_duplicate_keys_are_reported_as_faults(tmp_path):
    path = tmp_path / "x.json"
    text = json.dumps(GOOD)
    path.write_text(text[:-1] + ', "T": 20, "q\'": [1, 1, 1], "T": 30}')
    with pytest.raises(TaskError) as caught:
        read_task(path)
    assert caught.value.faults == ("T: given 3 times", "q': given 2 times")
    path.write_text(text[:-1] + ', "T": -1}')
    with pytest.raises(TaskError) as caught:
        read_task(path)
    assert caught.value.faults[0] == "T: given 2 times" and caught.value.faults[1].startswith(
        "T: wanted"
    )
    # the content of an ignored value is not checked
    path.write_text(text[:-1] + ', "note": {"T": 1, "T": 2}, "note": 1}')
    assert read_task(path).remarks == ("unknown keys, ignored: 'note'",)
    path.write_text('{"note": {"T": 1, "T": 2}, ' + text[1:])
    assert read_task(path).remarks == ("unknown keys, ignored: 'note'",)


def test_unknown_keys_are_listed_in_the_report(tmp_path):
    path = tmp_path / "x.json"
    path.write_text(json.dumps(GOOD | {"q": [1, 2, 3], "a\n": 0}))
    task = read_task(path)
    assert task.remarks == (r"unknown keys, ignored: 'q', 'a\n'",)
    assert report(task, visit(task)) == (
        report(make(), visit(make())) + "\n\twarning: unknown keys, ignored: 'q', 'a\\n'"
    )
    assert dataclasses.replace(task, T=1).remarks == task.remarks
    path.write_text(json.dumps(GOOD | {f"k{i}": i for i in range(12)}))
    assert read_task(path).remarks[0].endswith("'k8', 'k9' and 2 more")
    path.write_text(json.dumps(GOOD))
    assert read_task(path).remarks == make().remarks == ()


def test_speeds_that_are_probably_in_degrees_cause_a_warning():
    fast = make(speeds=(0.2, 20, 0.2))
    assert report(fast, visit(fast)).endswith(
        "\n\twarning: q' = [0.2, 20.0, 0.2]: 20 rad/s is more than two turns a second; did "
        "you mean degrees?"
    )
    still = make(speeds=(4 * np.pi,) * 3)
    assert "warning" not in report(still, visit(still))
    with pytest.warns(UserWarning, match="q_to: 90 rad is many turns"):
        travel_time((0, 0, 0), (90, 0, 0), (1, 1, 1))
    with pytest.warns(UserWarning, match="q_from: 60 rad is many turns"):
        travel_time((0, -60, 0), (0, 0, 0), (1, 1, 1))


def test_files_that_are_too_large_are_refused(tmp_path):
    path = tmp_path / "x.json"
    with path.open("wb") as file:
        file.truncate(40_000_001)
    with pytest.raises(TaskError, match="is too big: 40 MB, wanted at most 40 MB"):
        read_task(path)
    with path.open("wb") as file:
        file.truncate(40_000_000)
    tracemalloc.start()
    with pytest.raises(TaskError, match="is not JSON"):
        read_task(path)
    tracemalloc.stop()


def test_impossible_file_names_are_refused():
    for name in ("a\0b", "\ud800", "x" * 5000):
        with pytest.raises(TaskError, match="cannot be read: "):
            read_task(name)


def test_tasks_are_read_only():
    points = np.array([[2.0, 3, 2], [1, 3, 3]])
    task = make(points=points, speeds=(speeds := np.full(3, 0.2)))
    points[:], speeds[:] = 0, 9
    assert visit(task) == visit(make())
    for name in ("speeds", "p0", "points", "q"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(task, name)[...] = 1
    for thing, name in ((task, "T"), (visit(task), "order")):
        with pytest.raises(dataclasses.FrozenInstanceError):
            setattr(thing, name, 1)
    longer = dataclasses.replace(task, T=1e3)
    assert longer.T == 1000 and (longer.q == task.q).all()
    assert make() != make(), "tasks are compared by identity"


def test_arrays_without_numbers_are_refused():
    """Arrays are refused even if each item could be converted to a number: for NumPy, nanoseconds
    are whole numbers.
    """
    for p0 in (
        np.array([1, 1, 1], dtype="datetime64[ns]"),
        np.array([1, 1, 1], dtype="timedelta64[ns]"),
        np.ma.array([1.0, 1, 1], mask=[False, False, False]),
        np.ones(3, dtype=complex),
        np.ones(3, dtype=bool),
        np.array(["1", "1", "1"]),
    ):
        with pytest.raises(TaskError, match="^p0: wanted an array of 3 finite numbers, m, got"):
            make(p0=p0)


def test_a_result_contains_plain_python_numbers():
    result = Result(np.array([1, 0]), np.array([1, 2.5]), [])
    assert result == Result((1, 0), (1.0, 2.5), ()) and result.time == 2.5
    for value, kind in ((result.order[0], int), (result.times[0], float)):
        assert type(value) is kind
    best = best_visit(make())
    assert {type(i) for i in (*best.order, *visit(make()).order)} == {int}
    assert {type(t) for t in (*best.times, *collect(make()).times)} == {float}


def test_lengths_outside_the_allowed_range_are_refused():
    for number in (1e-6, 1e6):
        assert workspace(number, number, (0, 0, number)).all()
        make(l1=number, l2=number, p0=(0, 0, number), points=[(0, 0, number)])
    for wrong in (0.99e-6, 1e6 + 0.5):
        with pytest.raises(ValueError, match="l1: wanted a length from 1e-06 to 1e.06 m, got"):
            workspace(wrong, 4, (1, 1, 1))
        with pytest.raises(ValueError, match="l2: wanted a length from"):
            principal_postures(5, wrong, (1, 1, 1))
        with pytest.raises(TaskError, match="L2: wanted a positive number of metres, from"):
            make(l2=wrong)


def test_a_task_accepts_arrays():
    task = make(
        p0=np.ones(3),
        points=np.array([[2, 3, 2], [1, 3, 3]]),
        speeds=np.full(3, 0.2),
        T=np.float64(10),
        l1=np.int64(5),
    )
    assert visit(task) == visit(make())
    assert visit(make(points=[np.array([2.0, 3, 2]), (1, 3, np.float32(3))])) == visit(make())


def test_invalid_calls_are_refused():
    good = visit(make())
    for call, kind, evidence in (
        (lambda: visit(GOOD), TypeError, "task: wanted a Task"),
        (lambda: collect("x.json"), TypeError, "task: wanted a Task, got 'x.json'"),
        (lambda: best_visit(None), TypeError, "task: wanted a Task"),
        (lambda: answer([]), TypeError, "task: wanted a Task"),
        (lambda: itinerary(GOOD, good), TypeError, "task: wanted a Task"),
        (lambda: itinerary(make(), None), TypeError, "result: wanted a Result"),
        (lambda: report(None, good), TypeError, "task: wanted a Task"),
        (lambda: report(make(), (0, 1)), TypeError, "result: wanted a Result"),
        (lambda: read_task(None), TypeError, "path: wanted a path, got None"),
        (
            lambda: travel_time((0, 0), (1, 1), (1, 1)),
            ValueError,
            r"q_from: wanted shape \(\.\.\., 3\)",
        ),
        (
            lambda: travel_time(np.zeros((2, 3)), np.zeros((4, 3)), (1, 1, 1)),
            ValueError,
            r"\(2, 3\) and \(4, 3\)",
        ),
        (
            lambda: travel_time(np.zeros(3), np.ones(3), (1, 0, 1)),
            ValueError,
            r"three positive numbers in rad/s, got \(1, 0, 1\)",
        ),
        (
            lambda: travel_time(np.zeros(3), np.ones(3), np.ones((2, 3))),
            ValueError,
            "speeds: wanted three positive",
        ),
        (lambda: travel_time(np.zeros(3), np.ones(3), (1, 1)), ValueError, "speeds"),
        (
            lambda: lowest(5, 4, (0, 0, 13), (0, 0, 0)),
            ValueError,
            "q_from: wanted joint values within two turns, got 13 rad",
        ),
        (
            lambda: lowest(5, 4, (0, 0, 0), (0, -12.6, 0)),
            ValueError,
            "q_to: wanted joint values within two turns, got 12.6 rad",
        ),
        (
            lambda: lowest(5, 4, np.zeros((2, 3)), np.zeros((4, 3))),
            ValueError,
            r"\(2, 3\) and \(4, 3\)",
        ),
        (
            lambda: misfit(5, 4, np.zeros((2, 3)), np.zeros((4, 3))),
            ValueError,
            r"\(2, 3\) and \(4, 3\)",
        ),
        (lambda: out_of_workspace("a", 4, (1, 1, 1)), ValueError, "l1: wanted numbers, got 'a'"),
        (
            lambda: out_of_workspace(5, 4, [(1, 1, 1)]),
            ValueError,
            r"point: wanted a single point \(3,\), got \(1, 3\)",
        ),
        (lambda: make(kind="fetch"), TaskError, "task: .*fetch"),
        (lambda: make(remarks="odd"), ValueError, "remarks: wanted a list of strings, got 'odd'"),
        (lambda: make(remarks=[1]), ValueError, "remarks: wanted a string, got 1"),
        (
            lambda: Result((0,), (), (1,)),
            ValueError,
            "times: wanted 1 times, one for each point of order",
        ),
        (lambda: Result((0, 0.5), (1, 2), ()), ValueError, "order: wanted indices of points"),
        (lambda: Result((), (), (-1,)), ValueError, "left: wanted indices of points"),
        (lambda: Result((), (), 0), ValueError, "left: wanted indices of points"),
        (lambda: Result((), (), (1e300,)), ValueError, "left: wanted indices of points"),
        (lambda: Result((), (), (2.0**60,)), ValueError, "left: wanted indices of points"),
    ):
        with pytest.raises(kind, match=evidence):
            call()


@pytest.mark.parametrize("given", [((0, 1), (0,)), ((0, 2), ()), ((), ()), ((1, 1), ())])
def test_results_of_other_tasks_are_refused(given):
    order, left = given
    for method in (itinerary, report):
        with pytest.raises(ValueError, match="result: wanted a result of this task with 2 points"):
            method(make(), Result(order, range(len(order)), left))
    itinerary(make(), Result((1,), (5.0,), (0,)))


def test_lowest_point_of_a_move_is_that_of_its_reverse():
    """No sample of the move is below its lowest point, whichever way the joints turn."""
    rng = np.random.default_rng(23)
    for l1, l2 in ((5, 4), (3, 1), (2, 2), (1, 3)):
        a, b = rng.uniform(-np.pi / 2, np.pi / 2, (2, 100, 3))
        there, back = lowest(l1, l2, a, b), lowest(l1, l2, b, a)
        assert np.allclose(there, back, rtol=0, atol=2e-9 * (l1 + l2))
        s = np.linspace(0, 1, 501)[:, None, None]
        z = spbu_arm(l1, l2).fk(a + s * (b - a)).translation[..., 2].min(axis=0)
        assert (there <= z + 1e-9 * (l1 + l2)).all() and (z - there < 1e-3 * (l1 + l2)).all()
