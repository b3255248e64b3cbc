"""The exercises and predictions of lab 04: correct answers in every style pass, mistakes are named,
every student's task can be solved, and the answer to every prediction is computed by another
method.
"""

import re

import numpy as np
import pytest

from robokin import SCARA, ScaraPose, deg, follow, mm, scara_arm, within
from robokin.course import book, check, hint, predict, solution, variant
from robokin.course.questions import filled

LEVERS = 0.2, 0.25
LAB = book.lab("scara_kinematics")
CIRCLE, FACTS = LAB.module("own_circle"), LAB.module("predictions")


# --- Exercise 1: the other elbow of a camera ------------------------------------------------------


def _by_direction(q1, q2, l1, along, side):
    """Mirror both sides of the triangle in the line to the camera."""
    camera = l1 * np.exp(1j * q1) + (along + 1j * side) * np.exp(1j * (q1 + q2))
    sides = [l1 * np.exp(1j * q1), (along + 1j * side) * np.exp(1j * (q1 + q2))]
    first, second = (np.angle(camera**2 / each) for each in sides)
    return [first, second - first - np.angle(along + 1j * side)]


def _by_a_longer_arm(q1, q2, l1, along, side):
    """Use the inverse of a SCARA whose second link ends at the camera."""
    reach, offset = np.hypot(along, side), np.arctan2(side, along)
    arm = scara_arm("to the camera", 1.0, l1, reach, np.array([(-4, 4)] * 3 + [(0, 1)]))
    rows = arm.ik(arm.fk([q1, q2 + offset, 0, 0]))
    other = rows[1] if np.sin(q2 + offset) >= 0 else rows[0]
    return other[:2] - [0, offset]


def _by_cosines(q1, q2, l1, along, side):
    reach, bend = np.hypot(along, side), q2 + np.arctan2(side, along)
    d = np.sqrt(l1**2 + reach**2 + 2 * l1 * reach * np.cos(bend))
    inside = np.arccos(np.clip((l1**2 + d**2 - reach**2) / (2 * l1 * d), -1, 1))
    turn = 2 * inside * np.sign(np.sin(bend))
    return np.array([[q1 + turn, -q2 - 2 * np.arctan2(side, along)]]).round(9)


@pytest.mark.parametrize("answer", [_by_direction, _by_a_longer_arm, _by_cosines])
def test_other_elbow_found_by_other_methods_passes(answer):
    verdict = check("scara_kinematics.1", answer)
    assert verdict.holds, verdict


@pytest.mark.parametrize("number", ["1", "3"])
def test_every_listed_mistake_is_named(number):
    exercise = LAB.exercises[number]
    for mistake in exercise.own:
        verdict = check(f"scara_kinematics.{number}", exercise.steps.program(mistake))
        assert not verdict.holds and verdict.mistake == mistake.name, verdict


def _by_a_quotient(q1, q2, l1, along, side):
    """Use arctan(side / along), which is half a turn off if the camera is behind joint 2."""
    reach, bend = np.hypot(along, side), q2 + np.arctan(side / along)
    inside = np.arctan2(reach * np.sin(bend), l1 + reach * np.cos(bend))
    return [q1 + 2 * inside, -q2 - 2 * np.arctan(side / along)]


def _without_brackets(q1, q2, l1, along, side):
    """Divide only by the first term of the denominator."""
    offset, reach = np.arctan2(side, along), np.hypot(along, side)
    bend = q2 + offset
    inside = np.arctan(reach * np.sin(bend) / l1 + reach * np.cos(bend))
    return [q1 + 2 * inside, -bend - offset]


def _by_ik_alone(q1, q2, l1, along, side):
    """Use the inverse of the lab's arm for the position of its tool, not of the camera."""
    rows = SCARA.ik(SCARA.fk([q1, q2, 0, 0]))
    return rows[1 if q2 >= 0 else 0, :2]


def _by_direction_and_cosines(q1, q2, l1, along, side):
    """Add an arccosine to the direction of the camera, whichever way the triangle bends."""
    camera = l1 * np.exp(1j * q1) + (along + 1j * side) * np.exp(1j * (q1 + q2))
    d, reach = abs(camera), np.hypot(along, side)
    cosine = np.clip((l1**2 + d**2 - reach**2) / (2 * l1 * d), -1, 1)
    return [np.angle(camera) + np.arccos(cosine), -q2 - 2 * np.arctan2(side, along)]


@pytest.mark.parametrize(
    ("answer", "name"),
    [
        (lambda *case: np.degrees(_by_cosines(*case)), "degrees for radians"),
        (lambda *case: _by_direction(*case)[:1], "another kind or shape"),
        (lambda *case: SCARA.ik(SCARA.fk([case[0], case[1], 0, 0])), "another kind or shape"),
        (_by_ik_alone, None),
        (_by_a_quotient, "arctan instead of arctan2 for the camera"),
        (_without_brackets, "brackets left out"),
        (lambda *case: print(case), "prints instead of returning"),
        (_by_direction_and_cosines, "arccosine without the sign"),
        (lambda q1, q2, *lengths: (q1, q2), None),
        (lambda q1, q2, *lengths: (q1, -q2), "only joint 2 changed"),
        (lambda q1, q2, *lengths: (-q1, -q2), "every sign changed"),
    ],
)
def test_mistakes_in_the_other_elbow_are_named(answer, name):
    verdict = check("scara_kinematics.1", answer)
    assert not verdict.holds
    assert name is None or name in (verdict.mistake or ""), verdict


def test_unknown_mistake_is_refused_but_not_named():
    verdict = check("scara_kinematics.1", lambda a, b, c, d, e: (0.3 * a + c, d + e - 1.1 * b))
    assert not verdict.holds and verdict.mistake is None


def test_whole_turns_pass_and_small_errors_are_called_nearly_right():
    def turned(*case):
        return np.array(_by_direction(*case)) + [12 * np.pi, -2 * np.pi]

    def little_off(*case):
        return _by_cosines(*case)[0] + [5e-7, 0]

    assert check("scara_kinematics.1", turned).holds
    verdict = check("scara_kinematics.1", little_off)
    assert verdict.mistake == "nearly right"
    place, is_at = re.search(r"be at \((.*)\) mm again; .* at \((.*)\) mm", verdict.case).groups()
    assert place != is_at


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
        ({"hole": 161}, "mm for m"),
        ({"hole": 0.05}, "the hole of an arm that folds"),
        ({"hole": "inner angle"}, "the stop used as the angle inside the triangle"),
        ({"hole": 0.12608}, "the hole of the lab's arm"),
        ({"hole": 0.2}, "another radius of the hole"),
        ({"distance": 290}, "mm for m"),
        ({"distance": -0.29}, "a negative distance"),
        ({"distance": 0.6}, "out of reach"),
        ({"distance": 0.375}, "too close to the straight arm"),
        ({"distance": 0.15}, "past a limit: joint 2"),
        ({"elbow": "other"}, "the wrong elbow"),
        ({"elbow": 0}, "another kind or shape"),
        ({"angle": 0.0}, "past a limit: joint 3"),
        ({"angle": "a turn more"}, "joint 3 starts a whole turn off"),
        ({"angle": "degrees"}, "degrees for radians"),
        ({"angle": ...}, None),
    ],
)
def test_mistakes_in_circles_are_named(change, name):
    who = next(
        w
        for n, w in _every_task().items()
        if n[0] == 140 * deg and n[1] == 70 * mm and abs(n[2]) == 115 * deg and n[3] > 0
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
            "inner angle": abs(0.2 + 0.25 * np.exp(1j * 40 * deg)),
        }.get(value, value)
    verdict = check("scara_kinematics.2", answer, who=who)
    assert not verdict.holds and verdict.says
    assert name is None or verdict.mistake == name, verdict


def test_tool_is_at_the_edge_of_the_hole_with_joint_2_at_its_stop():
    for who in ("Ada", "Grace", "7"):
        numbers = variant("scara_kinematics", who)
        x, y, _ = SCARA.fk([0, numbers["stop"], 0, 0]).translation
        assert CIRCLE["about_hole"](np.hypot(x, y), numbers) is None
        for off in (-1, 1):
            assert CIRCLE["about_hole"](np.hypot(x, y) + off * mm, numbers)


def test_circle_that_goes_out_to_the_distance_in_hint_2_stays_away_from_the_straight_arm():
    words = " ".join(str(hint("scara_kinematics.2", 2)).split())
    out = float(re.search(r"At q2 = 25°, the tool is (\d+) mm away", words)[1]) * mm
    numbers = variant("scara_kinematics", "Ada")
    space = {}
    exec(str(solution("scara_kinematics.2")).replace('"your name"', '"Ada"'), space)
    for off, named in ((0, False), (1 * mm, True)):
        circle = space["my_circle"] | {"distance": out + off - numbers["radius"]}
        says = str(check("scara_kinematics.2", circle, who="Ada"))
        assert ("too close to the straight arm" in says) == named, says


def test_joint_3_turns_by_the_angle_in_hint_2_on_every_circle():
    words = " ".join(str(hint("scara_kinematics.2", 2)).split())
    pattern = r"turn by (\d+)° between its limits.* exactly (\d+)° .* and has (\d+)° to spare"
    room, needed, spare = map(float, re.search(pattern, words).groups())
    assert room == np.ptp(SCARA.limits[2]) / deg == needed + spare
    for who in list(_every_task().values())[::7]:
        numbers = variant("scara_kinematics", who)
        nearest = CIRCLE["distance"](numbers["stop"]) + numbers["radius"]
        for distance in np.linspace(nearest, 0.439 - numbers["radius"], 3):
            for elbow in (+1, -1):
                answer = {"distance": distance, "elbow": elbow, "angle": 0.0}
                q = CIRCLE["joints"](answer, numbers)
                assert np.ptp(q[:, 2]) / deg == pytest.approx(needed)
                assert np.allclose(q[0, :2], q[-1, :2])
                assert abs(q[0, 2]) > 30 * deg, "it does not start at the tool's angle"


def test_task_matches_the_circle_in_the_lab():
    numbers = variant("scara_kinematics", "Ada")
    targets = CIRCLE["own_circle"](numbers, 0.3, 0.5)
    centre = 0.3 * np.array([np.cos(numbers["bearing"]), np.sin(numbers["bearing"])])
    off = np.linalg.norm(targets.position[:, :2] - centre, axis=-1)
    assert np.allclose(off, numbers["radius"]) and (targets.position[:, 2] == 0.1).all()
    assert np.isclose(np.ptp(targets.angle), 4 * np.pi)


# --- Exercise 3: how far past its limits ----------------------------------------------------------


def _sample_by_sample(radius, turns, elbow, limits):
    """Use the law of cosines at each sample instead of `ik` and `follow`."""
    l1, l2 = LEVERS
    most = [0.0] * 4
    for beta in np.linspace(0, 2 * np.pi, 401):
        x, y = 0.2 + radius * np.cos(beta), radius * np.sin(beta)
        q2 = elbow * np.arccos((x * x + y * y - l1**2 - l2**2) / (2 * l1 * l2))
        q1 = np.angle((x + 1j * y) / (l1 + l2 * np.exp(1j * q2)))
        joints = [q1, q2, turns * beta - q1 - q2, 0.2202 - 0.1]
        for k, (value, (low, high)) in enumerate(zip(joints, limits, strict=True)):
            most[k] = max(most[k], value - high, low - value)
    return most


def test_excess_computed_with_the_law_of_cosines_passes():
    verdict = check("scara_kinematics.3", _sample_by_sample)
    assert verdict.holds, verdict


@pytest.mark.parametrize(
    ("row", "name"),
    [
        (lambda rows, elbow: rows[:, elbow], "always elbow −1"),
        (lambda rows, elbow: rows[:, 1], "always elbow −1"),
        (lambda rows, elbow: follow(SCARA, rows, elbow), "the flag used as a row"),
    ],
)
def test_flag_used_as_an_index_is_named(row, name):
    def answer(radius, turns, elbow, limits):
        beta = np.linspace(0, 2 * np.pi, 401)
        place = np.stack([0.2 + radius * np.cos(beta), radius * np.sin(beta), 0.1 + 0 * beta], -1)
        q = row(SCARA.ik(ScaraPose(place, turns * beta)), elbow)
        q = np.column_stack([q[:, :2], turns * beta - q[:, 0] - q[:, 1], q[:, 3]])
        low, high = np.transpose(limits)
        return np.maximum(q - high, low - q).max(axis=0).clip(0)

    assert check("scara_kinematics.3", answer).mistake == name


def test_samples_counted_instead_of_measured_are_named():
    def counted(radius, turns, elbow, limits):
        beta = np.linspace(0, 2 * np.pi, 401)
        place = np.stack([0.2 + radius * np.cos(beta), radius * np.sin(beta), 0.1 + 0 * beta], -1)
        q = follow(SCARA, SCARA.ik(ScaraPose(place, turns * beta)), SCARA.branch(elbow))
        low, high = np.transpose(limits)
        return ((q > high) | (q < low)).sum(axis=0)

    verdict = check("scara_kinematics.3", counted)
    assert verdict.mistake == "the samples counted"
    # the sentence has the number that is returned, and the same in the unit of a figure
    assert "you return [0, 71, 0, 0]" in verdict.case and "you have 71.000 rad (" in verdict.case


def test_joint_3_starts_where_the_task_says_in_every_case():
    exercise = LAB.exercises["3"]
    for radius, _, elbow, _ in exercise.cases:
        q = SCARA.ik(ScaraPose((0.2 + radius, 0, 0.1), 0.0))[SCARA.branch(elbow)]
        assert abs(q[0] + q[1]) < np.pi  # so q3 = 0 − q1 − q2 is not wrapped


def test_wrapped_angles_and_limits_of_the_lab_are_refused():
    def wrapped(radius, turns, elbow, limits):
        beta = np.linspace(0, 2 * np.pi, 401)
        place = np.stack([0.2 + radius * np.cos(beta), radius * np.sin(beta), 0.1 + 0 * beta], -1)
        q = SCARA.ik(ScaraPose(place, turns * beta))[:, SCARA.branch(elbow)]
        low, high = np.transpose(limits)
        return np.maximum(q - high, low - q).max(axis=0).clip(0)

    assert check("scara_kinematics.3", wrapped).mistake == "wrapped angles"
    for answer in (
        lambda radius, turns, elbow, limits: _sample_by_sample(radius, turns, elbow, SCARA.limits),
        lambda *case: np.degrees(_sample_by_sample(*case)),
        lambda *case: max(_sample_by_sample(*case)),
    ):
        verdict = check("scara_kinematics.3", answer)
        assert not verdict.holds and verdict.mistake, verdict


# --- Answers to the predictions, by other methods -------------------------------------------------


def _right(name):
    _, options, right = filled(LAB.predictions[name])
    return options[right].text


def test_tool_rotates_with_both_joints_as_prediction_1_says():
    a, b = (SCARA.fk(q).rotation for q in ([0, 0, 0, 0], [30 * deg, 30 * deg, -60 * deg, 0]))
    assert np.allclose(a.as_matrix(), b.as_matrix())
    assert _right("p1") == "By −60°: it undoes the turns of both."


def test_answer_to_prediction_3_agrees_with_inverse_kinematics():
    q1 = SCARA.ik(ScaraPose([0.2, 0.2, 0.1]))[1, 0]
    assert _right("p3") == f"{q1 / deg:.1f}°: the triangle is mirrored in the line to the point."


def test_arcsine_misses_the_target_as_prediction_4_says():
    l1, l2, d = 0.2, 0.25, 0.13
    q2 = np.arccos((d**2 - l1**2 - l2**2) / (2 * l1 * l2))
    q1 = -np.arcsin(l2 * np.sin(q2) / d)
    end = l1 * np.exp(1j * q1) + l2 * np.exp(1j * (q1 + q2))
    assert abs(end - d) == pytest.approx(0.028, abs=5e-4) and "28 mm" in _right("p4")


def test_only_one_elbow_reaches_behind_the_arm_as_prediction_5_says():
    rows = SCARA.ik(FACTS["BEHIND"])
    assert within(SCARA, rows).all(axis=-1).tolist() == [True, False]
    assert _right("p5").startswith("Only elbow +1")


def test_radius_of_the_hole_in_prediction_6_follows_from_the_limit():
    x, y, _ = SCARA.fk([0, 120 * deg, 0, 0]).translation
    assert float(_right("p6")) == pytest.approx(np.hypot(x, y) / mm, abs=0.05)


def test_radius_of_the_hole_of_the_labs_arm_is_recognised():
    asked = predict("scara_kinematics.p6", 126)
    assert asked.options[asked.at].confusion == "you used the stop of the lab's arm"


@pytest.mark.parametrize("name", ["p3", "p6"])
def test_no_reply_says_the_same_twice(name):
    for option in filled(LAB.predictions[name])[1]:
        if option.confusion:
            said = re.sub("^you ", "", option.confusion)
            assert said not in option.reason
            own, after = (re.findall(r"\w+", x.lower()) for x in (said, option.reason))
            shared = [k for k in range(len(own) - 5) if " ".join(own[k : k + 6]) in " ".join(after)]
            assert not shared, option


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
    assert np.allclose(ends, [315, 405], atol=0.05)
    assert _right("p8") == "Elbow +1 alone: it starts farther from the upper limit."


def test_answer_to_prediction_9_agrees_with_inverse_kinematics():
    q2 = SCARA.ik(ScaraPose([0.44, 0, 0.1]))[0, 1]
    assert round(q2 / deg) == 24 and _right("p9").startswith("About 24°: near full reach,")
    assert _right("p2").startswith("540° with lerp, 180°")
