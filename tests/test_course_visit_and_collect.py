"""The exercises of lab 08: correct answers in different styles pass, and mistakes are named. The
laws for all labs are in test_course_labs.py.
"""

import math
from itertools import permutations

import numpy as np
import pytest

from robokin import spbu_arm, within
from robokin.course import book, check, variant
from robokin.jobs.visit_collect import (
    best_visit,
    misfit,
    principal_postures,
    travel_time,
    visit,
    workspace,
)

LAB = book.lab("visit_and_collect")
TRAPS, FACTS, SHARED = (LAB.module(name) for name in ("greedy_traps", "predictions", "shared"))

ARM = spbu_arm(5, 4)
BOX = np.random.default_rng(5).uniform([-9, -9, 0], [9, 9, 9], size=(200, 3))
POINTS = BOX[workspace(5, 4, BOX).all(axis=-1)]
# the last point is on the boundary of the workspace
AXIS = np.array([[0, 0, 6.0], [0, 0, 3.0], [0, -9.0, 0]])


def inside(q):
    return (abs(q) <= np.array([np.pi, np.pi / 2, np.pi / 2]) + 1e-9).all()


def judge_on(points, limits=inside, near=lambda gap: np.linalg.norm(gap) <= 1e-6, shape=True):
    def test(inverse):
        for p in points:
            q = np.asarray(inverse(p))
            if shape and q.shape != (3,):
                return False
            if not near(ARM.fk(q).translation - p) or not limits(q):
                return False
        return True

    return test


def asserting(inverse):
    for p in [*POINTS, *AXIS]:
        q = inverse(list(p))
        assert np.shape(q) == (3,)
        assert math.dist(ARM.fk(q).translation, p) < 1e-6
        assert inside(np.array(q))


@pytest.mark.parametrize(
    "answer",
    [
        judge_on(np.vstack([POINTS, AXIS])),
        judge_on(np.vstack([AXIS[::2], POINTS[:60]]), near=lambda gap: (abs(gap) < 1e-6).all()),
        lambda inverse: (
            all(
                np.shape(inverse(p)) == (3,)
                and misfit(5, 4, inverse(p), p) < 1e-6
                and inside(np.array(inverse(p)))
                for p in POINTS
            )
            and math.isfinite(sum(inverse([0, 0, 6])))
            and ARM.fk(inverse([0.6, -0.8, 0])).translation[0] > 0.5
        ),
        asserting,
    ],
)
def test_correct_tests_pass(answer):
    verdict = check("visit_and_collect.1", answer)
    assert verdict.holds, verdict


@pytest.mark.parametrize(
    "answer, mistake",
    [
        (judge_on(POINTS), "accepts: not a number on axis 1"),
        (judge_on(np.vstack([POINTS, AXIS[:2]])), "accepts: not a number on the boundary"),
        (judge_on(np.vstack([POINTS, AXIS]), shape=False), "accepts: a matrix with one row"),
        (judge_on(np.vstack([POINTS, AXIS]), limits=lambda q: True), "accepts: the other elbow"),
        (
            judge_on(np.vstack([POINTS, AXIS]), limits=lambda q: within(ARM, q).all()),
            "accepts: joint 1 from 0 to 360 degrees",
        ),
        (
            judge_on(np.vstack([POINTS, AXIS]), near=lambda gap: np.linalg.norm(gap) < 1e-5),
            "accepts: 0.003 mm short of the point",
        ),
        (
            judge_on(np.vstack([POINTS, AXIS]), near=lambda gap: np.linalg.norm(gap) < 1e-7),
            "rejects a correct program",
        ),
        (
            lambda inverse: all(
                inside(np.asarray(inverse(p))) and np.allclose(ARM.fk(inverse(p)).translation, p)
                for p in POINTS
            ),
            "accepts: 0.003 mm short of the point",
        ),
        (
            judge_on(np.vstack([POINTS, AXIS]), near=lambda gap: (gap <= 1e-6).all()),
            "accepts: every coordinate too small",
        ),
        (
            judge_on(np.vstack([POINTS, AXIS]), near=lambda gap: (abs(gap[[0, 2]]) < 1e-6).all()),
            "accepts: arccos for atan2",
        ),
        (judge_on([[2, 3, 2]]), "accepts: the answer to one example"),
        (judge_on(abs(POINTS)), "accepts: arctan for atan2"),
        (judge_on(BOX), "rejects every program"),
        (
            lambda inverse: all(np.allclose(inverse(p), ARM.ik(p)[0]) for p in POINTS),
            "rejects a correct program",
        ),
    ],
)
def test_program_accepted_by_a_weak_test_is_named(answer, mistake):
    verdict = check("visit_and_collect.1", answer)
    assert not verdict.holds and verdict.mistake == mistake


def test_verdict_on_a_test_reports_the_refused_point():
    everywhere = check("visit_and_collect.1", judge_on(BOX))
    assert "this point is not in the workspace: it is too far" in everywhere.says[-1]
    strict = judge_on(np.vstack([POINTS, AXIS]), near=lambda gap: np.linalg.norm(gap) < 1e-7)
    told = check("visit_and_collect.1", strict).says[-1]
    assert "inside the limits, with the tool 5e-07 m from the point" in told
    at_once = check("visit_and_collect.1", lambda inverse: bool(inverse(POINTS).any()))
    assert "wanted one point (3,) at a time" in at_once.says[0]
    blind = check("visit_and_collect.1", lambda inverse: False)
    assert blind.says[-1] == "It never calls the program."


def loops(q, speeds):
    here, clock, times = list(q[0]), 0.0, []
    for stop in q[1:]:
        longest = 0.0
        for j in range(3):
            if not (math.isnan(stop[j]) or math.isnan(here[j])):
                longest = max(longest, abs(stop[j] - here[j]) / speeds[j])
        clock += longest
        times.append(clock)
        here = [stop[j] if not math.isnan(stop[j]) else here[j] for j in range(3)]
    return times


def twice(q, speeds):
    q = np.array(q)
    for k in range(1, len(q)):
        if np.isnan(q[k, 0]):
            q[k, 0] = q[k - 1, 0]
    for k in range(len(q) - 2, -1, -1):
        if np.isnan(q[k, 0]):
            q[k, 0] = q[k + 1, 0]
    return np.cumsum(np.max(np.abs(q[1:] - q[:-1]) / speeds, axis=1))[:, None]


@pytest.mark.parametrize("answer", [loops, twice])
def test_correct_arrivals_pass(answer):
    verdict = check("visit_and_collect.2", answer)
    assert verdict.holds, verdict


def nothing(q, speeds):
    return np.cumsum(np.nanmax(abs(np.diff(q, axis=0)) / speeds, axis=1))


def forward_only(q, speeds):
    q = q.copy()
    for k in range(1, len(q)):
        if np.isnan(q[k, 0]):
            q[k, 0] = q[k - 1, 0]
    return np.cumsum((abs(np.diff(q, axis=0)) / speeds).max(axis=1))


def filled_backward(q, speeds):
    q = q.copy()
    for k in range(len(q) - 2, -1, -1):
        if np.isnan(q[k, 0]):
            q[k, 0] = q[k + 1, 0]
    return np.cumsum((abs(np.diff(q, axis=0)) / speeds).max(axis=1))


@pytest.mark.parametrize(
    "answer, mistake",
    [
        (filled_backward, "turned on the way to the axis"),
        (nothing, "NaN costs nothing, both ways"),
        (lambda q, speeds: nothing(np.nan_to_num(q), speeds), "0 instead of NaN"),
        (
            lambda q, speeds: np.diff(nothing(np.nan_to_num(q), speeds), prepend=0),
            "0 instead of NaN, and times of the moves, not added up",
        ),
        (forward_only, "a start on the axis left out"),
        (
            lambda q, speeds: np.diff(loops(q, speeds), prepend=0),
            "times of the moves, not added up",
        ),
        (lambda q, speeds: [0, *loops(q, speeds)], "another kind or shape"),
        (lambda q, speeds: loops(q, [max(speeds)] * 3), "the greatest speed for all"),
        (lambda q, speeds: np.round(loops(q, speeds), 2), "rounded"),
        (lambda q, speeds: np.array(loops(q, speeds)) * 180 / np.pi, "degrees for radians"),
        (lambda q, speeds: 2 * np.array(loops(q, speeds)), "there and back"),
        (lambda q, speeds: [0, *loops(q, speeds)][:-1], "when the arm leaves"),
        (
            lambda q, speeds: np.nancumsum((abs(np.diff(q, axis=0)) / speeds).max(axis=1)),
            "a move from or to the axis takes no time",
        ),
    ],
)
def test_mistakes_in_arrivals_are_named(answer, mistake):
    verdict = check("visit_and_collect.2", answer)
    assert not verdict.holds and verdict.mistake == mistake, verdict


def turned(numbers, shares):
    x, y, z = numbers["p0"]
    angles = np.arctan2(y, x) + numbers["speed"] * numbers["T"] * np.array(shares)
    r = np.hypot(x, y)
    return [[r * np.cos(a), r * np.sin(a), z] for a in angles]


def traps(who, **changed):
    numbers = variant("visit_and_collect", who)
    shares = [0.5, -1.35, -1.5]
    shares.insert(int(np.argmax(numbers["worth"])), -1.2)
    return {
        "visit": turned(numbers, [0.66, -0.73, -0.83, -0.93]),
        "collect": "no trap",
        "worth": turned(numbers, shares),
    } | changed


def test_every_student_can_build_the_traps():
    for k in range(60):
        verdict = check("visit_and_collect.3", traps(k), who=k)
        assert verdict.holds, verdict
    assert 'worth": cheapest first brings [' in repr(verdict)


def mirrored(points):
    return (np.array(points) * [1, -1, 1]).tolist()


def test_traps_in_other_styles_pass():
    numbers = variant("visit_and_collect", "your name")
    assert numbers["p0"] == [4.0, -1.5, 1.25]
    good = traps("your name")
    other_side = turned(numbers, [-0.66, 0.73, 0.83, 0.93])
    higher = [[0.95 * x, 0.95 * y, z + 0.2] for x, y, z in good["visit"]]
    for visit_points in (other_side, higher, np.array(good["visit"]), good["visit"][::-1]):
        answer = good | {"visit": visit_points, "collect": "No  trap."}
        verdict = check("visit_and_collect.3", answer, who="your name")
        assert verdict.holds and "give your own name" in verdict.says[-1]
    assert "own name" not in repr(check("visit_and_collect.3", traps("Ada"), who="Ada"))


OPENING = [[4 * np.cos(a), 4 * np.sin(a), 2] for a in (1.0, -1.1, -1.2, -1.3)]  # as in lab 08


@pytest.mark.parametrize(
    "task, points, mistake",
    [
        ("visit", [[3, 3, 3], [4, 0, 2], [1, 5, 1], [-3, 2, 2]], "the rule is not beaten"),
        ("visit", [[9, 9, 9], [1, 2, 3], [4, 1, 1], [3, 3, 3]], "out of the workspace"),
        ("visit", [[4, 1, 1]] * 4, "too near to each other"),
        ("visit", [[-4, 0, 1], [-4, 1, 1], [-4, 2, 1], [-4, 3, 1]], "nothing in time"),
        ("visit", [[4000, 1000, 1000]] * 4, "another kind or shape"),
        ("visit", "no trap", "given up, although there is a trap"),
        ("visit", OPENING, "the lab's own points"),
        ("visit", mirrored(OPENING[::-1]), "the lab's own points"),
        ("collect", [[3, 3, 3], [4, 0, 2], [1, 5, 1], [-3, 2, 2]], "a trap that cannot exist"),
        ("collect", [[9, 9, 9]] * 4, "a trap that cannot exist"),
        ("worth", "no trap", "given up, although there is a trap"),
        ("worth", [[3.9, -0.8, 1], [4, 0, 1.2], [4, -2.5, 1], [3.5, 0.9, 1.4]], "all in time"),
        ("worth", "perhaps", "another kind or shape"),
    ],
)
def test_points_that_are_not_a_trap_are_reported(task, points, mistake):
    answer = traps("your name", **{task: points})
    verdict = check("visit_and_collect.3", answer, who="your name")
    assert not verdict.holds and verdict.mistake == mistake, verdict


def test_all_wrong_answers_are_named_at_once():
    none = dict.fromkeys(("visit", "collect", "worth"), "no trap")
    verdict = check("visit_and_collect.3", none, who="your name")
    assert verdict.mistake == "2 of the 3 answers are wrong: given up, although there is a trap"
    built = none | {"collect": [[3, 3, 3], [4, 0, 2], [1, 5, 1], [-3, 2, 2]]}
    verdict = check("visit_and_collect.3", built, who="your name")
    assert verdict.mistake.startswith("3 of the 3 answers are wrong: given up")
    assert verdict.mistake.endswith("; a trap that cannot exist")
    tasks = [line.split(":")[0] for line in verdict.says]
    assert tasks == ['"visit"', '"collect"', '"worth"'] and verdict.points == 0


def test_all_malformed_answers_are_named_at_once():
    answer = traps("your name", visit=[[1, 2, 3]], worth="perhaps")
    verdict = check("visit_and_collect.3", answer, who="your name")
    assert verdict.mistake == "another kind or shape"
    said = " ".join(verdict.says)
    assert '"visit": wanted four points' in said and '"worth": wanted four points' in said, verdict
    assert '"collect"' not in said


def test_loss_of_less_than_half_of_the_value_is_reported():
    numbers = variant("visit_and_collect", "your name") | {"worth": [3, 2, 3, 4]}
    points = np.array(turned(numbers, [0.5, -1.35, -1.5, -1.2]))
    name, says = TRAPS["trap_fault"]("worth", points, numbers)
    assert name == "less than half is lost" and "worth 3; the best choice is [3], worth 4" in says
    name, _ = TRAPS["trap_fault"]("worth", points, numbers | {"worth": [9, 1, 1, 1]})
    assert name == "the rule is not beaten"


def test_cheapest_first_collects_as_many_points_as_the_best_choice():
    """Test the exercise's statement about "collect" by trying all possible choices."""
    numbers = variant("visit_and_collect", 3)
    rng = np.random.default_rng(3)
    for _ in range(100):
        greedy, best = TRAPS["both"]("collect", rng.permutation(POINTS)[:4], numbers)
        assert len(greedy) == len(best)


def test_no_move_goes_under_the_floor_if_link_2_is_longer():
    """Test the statement of prediction 8 on more than 20 000 random moves in row 0."""
    rng, moves = np.random.default_rng(8), 0
    while moves < 20_000:
        l1 = rng.uniform(1, 6)
        l2 = rng.uniform(l1, 9)
        places = rng.uniform(-l1 - l2, l1 + l2, (800, 3))
        places[:, 2] = abs(places[:, 2])
        places = places[workspace(l1, l2, places).all(axis=-1)]
        q = principal_postures(l1, l2, places)
        begin, goal = q[: len(q) // 2], q[len(q) // 2 :][: len(q) // 2]
        share = np.linspace(0, 1, 101)[:, None, None]
        _, q2, q3 = np.moveaxis(begin + share * (goal - begin), -1, 0)
        heights = l1 * np.cos(q2) - l2 * np.sin(q2 + q3)
        assert np.allclose(heights[0], places[: len(begin), 2], rtol=0, atol=1e-9)
        assert heights.min() > -1e-9
        moves += len(begin)


def test_numbers_used_in_the_predictions_are_correct():
    assert FACTS["p7"]()["height"] == 3.0  # from a 3-4-5 triangle
    assert -1.017 < FACTS["p8"]()["low"] < -1.016
    changes = FACTS["p5"]()
    beaten = ("container on axis 1", "prices", "unlike speeds", "emptied at the end")
    assert [changes[k] > 0 for k in beaten] == [1, 1, 0, 1]
    stops = np.array([(0, *order) for order in permutations(range(1, 8))])
    for seed in range(5):  # compared with the package's own optimum
        task = SHARED["drawn"](seed)
        legs = travel_time(task.q[:, None], task.q, task.speeds)
        arrivals = legs[stops[:, :-1], stops[:, 1:]].cumsum(axis=-1)
        assert (arrivals <= task.T).sum(axis=-1).max() == len(best_visit(task).order)
        assert len(visit(task).order) <= len(best_visit(task).order)
