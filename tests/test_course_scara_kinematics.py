"""The exercises and predictions of lab 04: correct answers in every style pass, mistakes are named,
every student's task can be solved, and the answer to every prediction is computed by another
method.
"""

import re

import numpy as np
import pytest

from robokin import SCARA, ScaraPose, deg, follow, mm, scara_arm, within
from robokin.course import book, check, solution, variant
from robokin.course.questions import filled

LEVERS = 0.2, 0.25
LAB = book.lab("scara_kinematics")
CIRCLE, FACTS = LAB.module("own_circle"), LAB.module("predictions")


# --- Exercise 1: the other elbow ------------------------------------------------------------------


def _by_direction(q):
    x, y = SCARA.fk(q).translation[:2]
    q1 = 2 * np.arctan2(y, x) - q[0]
    return [q1, -q[1], sum(q[:3]) - q1 + q[1], q[3]]


def _by_rows(q):
    rows = SCARA.ik(SCARA.fk(q))
    row = rows[1] if q[1] >= 0 else rows[0]
    return np.array([row[0], row[1], q[:3].sum() - row[0] - row[1], q[3]])


def _by_complex_numbers(q):
    end = LEVERS[0] + LEVERS[1] * np.exp(1j * q[1])
    q1 = np.angle(np.exp(1j * q[0]) * end / end.conjugate())
    return (q1, -q[1], q[0] + q[1] + q[2] - q1 + q[1], q[3])


def _by_cosines(q):
    l1, l2 = LEVERS
    d = np.sqrt(l1**2 + l2**2 + 2 * l1 * l2 * np.cos(q[1]))
    inside = np.sign(q[1]) * np.arccos((l1**2 + d**2 - l2**2) / (2 * l1 * d) - 1e-16)
    return np.array([[q[0] + 2 * inside, -q[1], q[2] + 2 * q[1] - 2 * inside, q[3]]]).round(9)


@pytest.mark.parametrize("answer", [_by_direction, _by_rows, _by_complex_numbers, _by_cosines])
def test_other_elbow_found_by_other_methods_passes(answer):
    verdict = check("scara_kinematics.1", answer)
    assert verdict.holds, verdict


def test_every_listed_mistake_is_named():
    exercise = LAB.exercises["1"]
    for mistake in exercise.own:
        verdict = check("scara_kinematics.1", exercise.steps.program(mistake))
        assert not verdict.holds and verdict.mistake == mistake.name, verdict


@pytest.mark.parametrize(
    ("answer", "name"),
    [
        (lambda q: np.degrees(_by_cosines(q)), "degrees for radians"),
        (lambda q: _by_direction(q)[:3], "another kind or shape"),
        (lambda q: SCARA.ik(SCARA.fk(q)), "another kind or shape"),
        (lambda q: SCARA.ik(SCARA.fk(q))[1], "always elbow −1"),
        (lambda q: SCARA.ik(SCARA.fk(q))[1 if q[1] >= 0 else 0], "the tool's angle wrapped"),
        (lambda q: print(q), "prints instead of returning"),
        (lambda q: q.__setitem__(1, -q[1]), "changes its input"),
        (lambda q: q, None),
    ],
)
def test_mistakes_in_the_other_elbow_are_named(answer, name):
    verdict = check("scara_kinematics.1", answer)
    assert not verdict.holds
    assert name is None or name in (verdict.mistake or ""), verdict


def test_unknown_mistake_is_refused_but_not_named():
    verdict = check("scara_kinematics.1", lambda q: q * np.array([0.3, -1.1, 0.9, 1]))
    assert not verdict.holds and verdict.mistake is None


# --- Exercise 2: an individual circle -------------------------------------------------------------


def _every_task():
    return {tuple(n.values()): who for who in map(str, range(400)) for n in [LAB.given(who)]}


def test_every_student_can_solve_the_task():
    text = str(solution("scara_kinematics.2"))
    tasks = _every_task()
    assert len(tasks) > 100
    for who in tasks.values():
        space = {}
        exec(text.replace('"your name"', repr(who)), space)
        verdict = check("scara_kinematics.2", space["my_circle"], who=who)
        assert verdict.holds, verdict


@pytest.mark.parametrize(
    ("change", "name"),
    [
        ({"distance": 290}, "mm for m"),
        ({"distance": -0.29}, "a negative distance"),
        ({"distance": 0.6}, "out of reach"),
        ({"distance": 0.375}, "too near to the stretched arm"),
        ({"distance": 0.15}, "past a limit: joint 2"),
        ({"elbow": "other"}, "the wrong elbow"),
        ({"elbow": 0}, "another kind or shape"),
        ({"angle": 0.0}, "past a limit: joint 3"),
        ({"angle": "a turn more"}, "joint 3 begins a whole turn off"),
        ({"angle": "degrees"}, "degrees for radians"),
        ({"angle": ...}, None),
    ],
)
def test_mistakes_in_circles_are_named(change, name):
    who = next(
        w
        for n, w in _every_task().items()
        if n[0] == 70 * mm and abs(n[1]) == 115 * deg and n[2] > 0
    )
    space = {}
    exec(str(solution("scara_kinematics.2")).replace('"your name"', repr(who)), space)
    answer = dict(space["my_circle"])
    assert check("scara_kinematics.2", answer, who=who).holds
    for key, value in change.items():
        answer[key] = {
            "other": -answer["elbow"],
            "a turn more": answer["angle"] + 2 * np.pi,
            "degrees": np.degrees(answer["angle"]),
        }.get(value, value)
    verdict = check("scara_kinematics.2", answer, who=who)
    assert not verdict.holds and verdict.says
    assert name is None or verdict.mistake == name, verdict


def test_task_matches_the_circle_in_the_lab():
    numbers = variant("scara_kinematics", "Ada")
    targets = CIRCLE["own_circle"](numbers, 0.3, 0.5)
    centre = 0.3 * np.array([np.cos(numbers["bearing"]), np.sin(numbers["bearing"])])
    off = np.linalg.norm(targets.position[:, :2] - centre, axis=-1)
    assert np.allclose(off, numbers["radius"]) and (targets.position[:, 2] == 0.1).all()
    assert np.isclose(np.ptp(targets.angle), 4 * np.pi)


# --- Exercise 3: a test for limits ----------------------------------------------------------------


def test_correct_programs_detect_every_value_outside_the_limits():
    rng = np.random.default_rng(4)
    limits = SCARA.limits
    q = rng.uniform(*limits.T, (40, 4))
    exercise = LAB.exercises["3"]
    for _, text in exercise.rights:
        program = exercise.program(text)
        assert program(q, limits)
        for joint in range(4):
            for value in (limits[joint, 0] - 1e-3, limits[joint, 1] + 1e-3, np.nan):
                spoiled = q.copy()
                spoiled[rng.integers(40), joint] = value
                assert not program(spoiled, limits)


def test_programs_accepted_by_weak_limit_tests_are_named():
    def one_sided(inside):
        good = np.tile(SCARA.limits.mean(axis=1), (25, 1))
        bad = good.copy()
        bad[7] = SCARA.limits[:, 1] + 0.5
        return inside(good, SCARA.limits) and not inside(bad, SCARA.limits)

    verdict = check("scara_kinematics.3", one_sided)
    assert verdict.mistake == "accepts: the last joint is never looked at"

    def strict(inside):
        return not inside(SCARA.limits.T, SCARA.limits)

    assert check("scara_kinematics.3", strict).mistake == "refuses a correct program"


def spoiled(past, tables, at=(7,), said=bool):
    """A test that moves one value at a time beyond its limit by a given amount."""

    def inside_is_right(inside):
        for limits in tables:
            limits = np.array(limits)
            good = np.tile(limits.mean(axis=1), (25, 1))
            values = [(limits[:, 0], True), (limits[:, 1], True), (limits[:, 1] * np.nan, False)]
            values += [(limits[:, 0] - past, False), (limits[:, 1] + past, False)]
            for joint in range(len(limits)):
                for sample in at:
                    for value, right in values:
                        q = good.copy()
                        q[sample, joint] = value[joint]
                        if said(inside(q, limits)) != right:
                            return False
            if said(inside(good, limits)) is not True:
                return False
        return True

    return inside_is_right


FOUR = [(-2, 2), (-3, 1), (-7, 7), (0, 0.2)]
SIX = [(-0.5, 4), (-9, 9), (0.1, 2), (-3, 3), (-7, 1), (-2, 5)]


def test_limit_test_must_try_small_violations_and_six_joints():
    def close(answer):
        return bool(np.isclose(answer, True))

    name = "scara_kinematics.3"
    assert check(name, spoiled(1e-6, (FOUR, SIX))).holds
    assert check(name, spoiled(1e-6, (FOUR, SIX), said=close)).holds
    slack = check(name, spoiled(0.01, (FOUR, SIX)))
    assert slack.mistake == "accepts: a slack of a thousandth for every joint"
    tolerant = check(name, spoiled(5e-4, (FOUR, SIX)))
    assert tolerant.mistake == "accepts: np.isclose with its own tolerances"
    four = check(name, spoiled(1e-6, (FOUR, SIX[:4])))
    assert four.mistake == "accepts: only the first four joints"
    ends = check(name, spoiled(1e-6, (FOUR, SIX), at=(0, -1)))
    assert ends.mistake == "accepts: start and end only"


def test_whole_turns_pass_and_small_errors_are_called_nearly_right():
    def turned(q):
        return np.array(_by_direction(q)) + [12 * np.pi, 0, -12 * np.pi, 0]

    def little_off(q):
        return _by_cosines(q)[0] + [5e-7, 0, -5e-7, 0]

    assert check("scara_kinematics.1", turned).holds
    verdict = check("scara_kinematics.1", little_off)
    assert verdict.mistake == "nearly right"
    place, is_at = re.search(r"stay at \((.*)\) mm; .* at \((.*)\) mm", verdict.case).groups()
    assert place != is_at


# --- Answers to the predictions, by other methods -------------------------------------------------


def _right(name):
    _, options, right = filled(LAB.predictions[name])
    return options[right].text


def test_tool_rotates_with_both_joints_as_prediction_1_says():
    a, b = (SCARA.fk(q).rotation for q in ([0, 0, 0, 0], [30 * deg, 30 * deg, -60 * deg, 0]))
    assert np.allclose(a.as_matrix(), b.as_matrix()) and _right("p1") == "By −60°."


def test_answer_to_prediction_3_agrees_with_inverse_kinematics():
    q1 = SCARA.ik(ScaraPose([0.2, 0.2, 0.1]))[1, 0]
    assert _right("p3") == f"{q1 / deg:.1f}°."


def test_arcsine_misses_the_target_as_prediction_4_says():
    l1, l2, d = 0.2, 0.25, 0.13
    q2 = np.arccos((d**2 - l1**2 - l2**2) / (2 * l1 * l2))
    q1 = -np.arcsin(l2 * np.sin(q2) / d)
    end = l1 * np.exp(1j * q1) + l2 * np.exp(1j * (q1 + q2))
    assert abs(end - d) == pytest.approx(0.028, abs=5e-4) and "28 mm" in _right("p4")


def test_only_one_elbow_reaches_behind_the_arm_as_prediction_5_says():
    rows = SCARA.ik(FACTS["BEHIND"])
    assert within(SCARA, rows).all(axis=-1).tolist() == [True, False]
    assert _right("p5").startswith("Elbow +1 alone")


def test_radius_of_the_hole_in_prediction_6_follows_from_the_limit():
    x, y, _ = SCARA.fk([0, 120 * deg, 0, 0]).translation
    assert float(_right("p6")) == pytest.approx(np.hypot(x, y) / mm, abs=0.05)


def test_areas_in_prediction_7_agree_with_a_grid():
    across = np.arange(-458, 460, 4.0)
    x, y = np.meshgrid(across, across)
    grid = ScaraPose(np.stack([x, y, np.full_like(x, 100)], axis=-1) * mm)
    for a, most in ((140, 150), (150, 150), (140, 160)):
        limits = np.array([(-a * deg, a * deg), (-most * deg, most * deg), (-7, 7), (0, 0.18)])
        arm = scara_arm("other", 0.2202, *LEVERS, limits)
        ways = within(arm, arm.ik(grid)).all(axis=-1)
        found = 0.16 * ways[..., 0].sum(), 0.16 * ways.any(axis=-1).sum()
        assert np.allclose(FACTS["areas"](a * deg, most * deg), found, rtol=2e-3)
    assert _right("p7").startswith("Joint 2")


def test_only_one_elbow_stays_inside_its_limits_as_prediction_8_says():
    omega = np.linspace(0, 2 * np.pi, 101)
    place = np.stack([0.2 + 0.07 * np.cos(omega), 0.07 * np.sin(omega), 0 * omega + 0.1], axis=-1)
    rows = SCARA.ik(ScaraPose(place, omega))
    ends = [follow(SCARA, rows, k)[-1, 2] / deg for k in (0, 1)]
    assert np.allclose(ends, [315, 405], atol=0.05) and _right("p8") == "Elbow +1 alone."


def test_answer_to_prediction_9_agrees_with_inverse_kinematics():
    q2 = SCARA.ik(ScaraPose([0.44, 0, 0.1]))[0, 1]
    assert round(q2 / deg) == 24 and _right("p9") == "By about 24°."
    assert _right("p2").startswith("540° with lerp, 180°")
