"""Visit and collect: the document's examples and errata S0, the reference tasks, and laws that any
answer obeys.
"""

import itertools
import json
import re

import numpy as np
import pytest
from conftest import ROOT
from machines import oracle

from robokin import spbu_arm
from robokin.jobs.visit_collect import (
    EXACT_LIMIT,
    KEYS,
    Result,
    Task,
    TaskError,
    answer,
    best_visit,
    collect,
    faults,
    itinerary,
    misfit,
    postures,
    read_task,
    report,
    travel_time,
    visit,
    workspace,
)

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


def on_a_circle(azimuths, radius=4, z=2):
    return [(radius * np.cos(a), radius * np.sin(a), z) for a in azimuths]


# ---- The document's examples


def test_example_1_is_refused_with_its_numbers():
    with pytest.raises(TaskError) as caught:
        read_task(TASKS / "example_1.json")
    assert caught.value.faults == (
        "point 0 = p0 (0, 0.7071, 0.7071) is too close to origin: |p|^2 = 0.99998082 m^2 is less "
        "than "
        "l2^2 - l1^2 - 2 l1 rho = 3.3432 m^2",
    )
    assert (
        EXAMPLES["example1"]["p_sq"] == "0.99998082"
        and "3.3432" in EXAMPLES["example1"]["inequality"]
    )


def test_example_2_collects_one():
    task, wanted = read_task(TASKS / "example_2.json"), EXAMPLES["example2"]
    result = answer(task)
    assert result.order == tuple(wanted["collected"]) and result.left == (1,)
    assert result.time == pytest.approx(float(wanted["time"]), rel=0, abs=1e-14)
    both = collect(make(kind="collect", T=20))
    assert both.times == pytest.approx(
        [float(wanted["cost_0"]), float(wanted["sum_both"])], rel=0, abs=1e-14
    )


def test_example_3_visits_both():
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
        got = postures(5, 4, json.loads(point.replace("(", "[").replace(")", "]")))
        np.testing.assert_allclose(got, [float(x) for x in q], rtol=0, atol=5e-15)


def test_the_examples_are_the_documents():
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


def test_reports():
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
def test_reference_task(case):
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
def test_results_hold_together(case):
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


# ---- Travel time


def test_travel_time_is_a_distance():
    q = np.random.default_rng(0).uniform(-1.5, 1.5, (30, 3)) * [2, 1, 1]
    for short_way in (False, True):
        legs = travel_time(q[:, None], q, (0.5, 0.2, 1.0), short_way=short_way)
        assert legs.shape == (30, 30)
        assert (
            (np.diag(legs) == 0).all()
            and (legs == legs.T).all()
            and (legs[~np.eye(30, dtype=bool)] > 0).all()
        )
        assert (legs[:, None] <= legs[:, :, None] + legs + 1e-12).all()  # no detour is shorter


def test_the_slowest_joint_decides():
    assert travel_time((0, 0, 0), (0.1, -0.4, 0.3), (1, 2, 0.5)) == pytest.approx(0.6)
    assert travel_time((0, 0, 0), (0.1, -0.4, 0.3), (0.1, 2, 0.5)) == pytest.approx(1.0)


def test_joint_1_may_take_the_short_way_round():
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
def test_a_point_on_the_axis_costs_no_turn(x, y):
    """Errata S0-p: 15.7 s as printed."""
    there = make(p0=(-2, 0, 4), points=[(x, y, 4.9)], T=100)
    back = make(p0=(x, y, 4.9), points=[(-2, 0, 4)], T=100)
    for task in (there, back):
        for method in (visit, best_visit):
            assert method(task).time == pytest.approx(2.1501933177, abs=1e-10)
        assert collect(task).time == pytest.approx(2 * 2.1501933177, abs=1e-10)
    printed = abs(np.diff(spbu_arm(5, 4).ik([(-2, 0, 4), (0, 0, 4.9)])[:, 0], axis=0)).max() / 0.2
    assert printed == pytest.approx(15.7079632679, abs=1e-10)


def test_minus_zero_is_zero():
    plus, minus = (
        make(p0=(-2, 0.0, 2), points=[(-1, 0.0, 3)]),
        make(p0=(-2, -0.0, 2), points=[(-1, -0.0, 3)]),
    )
    assert visit(plus) == visit(minus) and (plus.q == minus.q).all()
    assert "-0" not in report(minus, visit(minus)).replace("-1", "")
    mixed = make(p0=(-2, 0.0, 2), points=[(-2, -0.0, 2)])
    assert visit(mixed).times == (0.0,)


def test_folded_onto_the_origin_two_joints_are_free():
    """Errata S0-k: with equal links the printed program divides by zero there."""
    task = make(l1=4, l2=4, p0=(0, 0, 0), points=[(0, -3, 2)])
    assert np.isnan(task.q[0]).tolist() == [True, True, False] and task.q[0, 2] == pytest.approx(
        np.pi / 2
    )
    assert visit(task).time == pytest.approx((np.pi / 2 - task.q[1, 2]) / 0.2)


# ---- Time allowed, ties


def test_T_hit_exactly_counts():
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
    assert visit(make(T=4.379934189305)).order == (0, 1), "T copied from the report, which rounds"


def vars_of(task):
    return {name: getattr(task, name) for name in ("l1", "l2", "speeds", "p0", "points", "kind")}


@pytest.mark.parametrize(
    "T, served", [(0, ()), (-0.0, ()), (3, ()), (4, (0,)), (4.379, (0,)), (4.38, (0, 1))]
)
def test_it_ends_where_the_nearest_does_not_fit(T, served):
    """Errata S0-f: the printed program goes round for ever."""
    assert visit(make(T=T)).order == best_visit(make(T=T)).order == served
    assert visit(make(T=T)).left == tuple({0, 1} - set(served))


def test_nothing_served_takes_no_time():
    result = visit(make(T=0))
    assert result == best_visit(make(T=0)) == collect(make(T=0)) == Result((), (), (0, 1))
    assert result.time == 0.0
    # but where the arm already is, it is
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
    # Mirrored in the start's own plane, at an azimuth where the two angles differ by rounding.
    for azimuth in np.linspace(-2, 2, 41):
        mirrored = make(
            p0=on_a_circle([azimuth])[0],
            points=on_a_circle(azimuth + np.array([0.3, -0.3, 0.3, -0.3])),
            T=1e3,
        )
        assert visit(mirrored).order == best_visit(mirrored).order == (0, 2, 1, 3)
        assert collect(mirrored).order == (0, 1, 2, 3)


def test_time_that_is_no_number_of_floats():
    """Speeds and times at the ends of the floats: an answer, no warning."""
    never = make(speeds=(5e-324,) * 3, T=1.7e308)
    assert visit(never).order == collect(never).order == best_visit(never).order == ()
    at_once = make(speeds=(1.7e308,) * 3, T=0)
    assert visit(at_once).order == ()  # quick, and yet not in no time
    assert visit(make(speeds=(1.7e308,) * 3, T=1e-300)).order == (0, 1)


# ---- The optimum


def test_greed_visits_one_where_three_can_be_visited():
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
    if seed % 3 == 0:  # with points that stand twice
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


def test_a_longer_time_never_serves_less():
    rng = np.random.default_rng(7)
    given = vars_of(drawn(rng, 7))
    for method in (collect, visit, best_visit):
        counts = [len(method(make(**given, T=T)).order) for T in np.linspace(0, 300, 61)]
        assert counts == sorted(counts) and counts[0] == 0 and counts[-1] == 7


def test_the_exact_method_says_its_limit():
    rng = np.random.default_rng(8)
    many = drawn(rng, EXACT_LIMIT + 1)
    with pytest.raises(
        ValueError, match=r"at most 16 points for the exact optimum, got 17.*visit\(\) takes any"
    ):
        best_visit(many)
    visit(many)


# ---- The way there


@pytest.mark.parametrize("short_way", [False, True])
@cases
def test_itinerary(case, short_way):
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
        # the slowest joint never rests
        np.testing.assert_allclose(share.max(axis=-1, initial=0), 1, rtol=1e-9)


def test_itinerary_over_the_axis():
    task = make(l1=4, l2=4, points=[(0, 0, 6), (0, 0, 0), (-2, 0.5, 3), (0, 0, 5)], T=1e3)
    t, q = itinerary(task, visit(task))
    assert np.isfinite(q).all() and len(t) == 5
    np.testing.assert_allclose(
        spbu_arm(4, 4).fk(q).translation[1:], task.points[list(visit(task).order)], atol=1e-12
    )
    up = make(p0=(0, 0, 5), points=[(0, 0, 6)], T=100)
    assert np.isfinite(itinerary(up, visit(up))[1]).all()
    assert itinerary(make(T=0), visit(make(T=0)))[1] == pytest.approx(make().q[:1])


# ---- Wrong tasks


def test_wrong_joint_values_are_found():
    """Errata S0-e: these pass all seven printed checks, 5.7154 m beside the point seen in the arm's
    own plane.
    """
    wrong = (-0.549597363236, 1.568403110925, 0.373893819911)
    assert misfit(5, 4, wrong, (2, 3, 2)) > 5.7154
    tip = spbu_arm(5, 4).fk(wrong).translation
    assert np.hypot(np.hypot(*tip[:2]) - np.hypot(2, 3), tip[2] - 2) == pytest.approx(
        5.7154, abs=1e-4
    )
    q = make().q[1]
    assert misfit(5, 4, q, (2, 3, 2)) < 1e-14
    assert misfit(5, 4, q + [0.5, 0, 0], (2, 3, 2)) > 1.7, "joint 1 counts"
    rows = spbu_arm(5, 4).ik((2, 3, 2))
    assert misfit(5, 4, rows, (2, 3, 2))[1:].tolist() == [np.inf] * 3, "past the limits"
    assert np.isnan(misfit(5, 4, spbu_arm(5, 4).ik((9, 9, 9)), (9, 9, 9))).all()


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
        [r"point 0 = p0 \(2, 3, -2\) is under floor: z = -2 m"],
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
            "point 0 = p0 .* under floor",
            r"point 1 = pi\[0\] .* too far",
            r"point 3 = pi\[2\] .* too close to origin",
        ],
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_all_faults_are_named(name, tmp_path):
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
    if set(data) == set(KEYS):  # the same words for a task that a lesson makes
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
def test_a_file_that_is_no_task(name, tmp_path):
    data, wanted = FILES[name]
    path = tmp_path / "x.json"
    path.write_bytes(data)
    with pytest.raises(TaskError, match=wanted) as caught:
        read_task(path)
    assert len(caught.value.faults) == 1 and "\n" not in str(caught.value)
    assert path.read_bytes() == data


def test_a_path_that_is_no_file(tmp_path):
    for path, wanted in (
        (tmp_path, "is not a file but a folder"),
        (tmp_path / "no.json", "cannot be read: No such"),
    ):
        with pytest.raises(TaskError, match=wanted):
            read_task(path)


def test_what_a_file_may_have(tmp_path):
    path = tmp_path / "x.json"
    path.write_text(
        "\ufeff" + json.dumps(GOOD | {"comment": "a key of its own", "L1": 5.0}), encoding="utf-8"
    )
    task = read_task(str(path))
    assert visit(task) == visit(make()) and task.kind == "visit" and task.T == 10.0


def test_a_task_takes_arrays():
    task = make(
        p0=np.ones(3),
        points=np.array([[2, 3, 2], [1, 3, 3]]),
        speeds=np.full(3, 0.2),
        T=np.float64(10),
        l1=np.int64(5),
    )
    assert visit(task) == visit(make())
    assert visit(make(points=[np.array([2.0, 3, 2]), (1, 3, np.float32(3))])) == visit(make())


def test_wrong_calls():
    for call, evidence in (
        (lambda: visit(GOOD), "wanted a Task"),
        (lambda: collect("x.json"), "wanted a Task, got 'x.json'"),
        (lambda: best_visit(None), "wanted a Task"),
        (lambda: answer([]), "wanted a Task"),
        (lambda: itinerary(GOOD, visit(make())), "wanted a Task"),
        (lambda: travel_time((0, 0), (1, 1), (1, 1)), r"q_from: wanted shape \(\.\.\., 3\)"),
        (
            lambda: travel_time(np.zeros((2, 3)), np.zeros((4, 3)), (1, 1, 1)),
            r"\(2, 3\) and \(4, 3\)",
        ),
        (
            lambda: travel_time(np.zeros(3), np.ones(3), (1, 0, 1)),
            r"three positive numbers, got \[1.0, 0.0, 1.0\]",
        ),
        (lambda: travel_time(np.zeros(3), np.ones(3), (1, 1)), "speeds"),
        (lambda: make(kind="fetch"), "task: .*fetch"),
    ):
        with pytest.raises(ValueError, match=evidence):
            call()
