"""The exercises and predictions of lab 02: correct answers pass, mistakes are refused and named,
and the answers to the predictions are recomputed.
"""

import re

import numpy as np
import pytest
from playwright.sync_api import expect

from robokin import IRB140, Quaternion, Transform, deg, differentiate, mm, within
from robokin.course import book, check, pose_explorer, variant
from robokin.course.questions import filled

TIP, POSE, DESIGN = (f"irb140_kinematics.{k}" for k in (1, 2, 3))
X, Y, Z = np.eye(3)
turned = Quaternion.from_angle_axis
LAB = book.lab("irb140_kinematics")
TARGET, FACTS = LAB.module("own_target"), LAB.module("predictions")
NEAR = Transform(turned(180 * deg, Y), np.array([70, 0, 297]) * mm)


# --- Exercise 1: the tip of a gripper -------------------------------------------------------------


def by_chain(q, upper, length, turn):
    "The chain of the lab, written with lists and with the gripper in two steps."
    steps = [
        Transform(turned(q[0], Z), [0, 0, 0.352]),
        Transform(turned(q[1], -Y), [0.070, 0, 0]),
        Transform(turned(q[2], Y), [0, 0, upper]),
        Transform(turned(q[3], X) @ turned(q[4], Y), [0.380, 0, 0]),
        Transform(turned(q[5], X) @ turned(90 * deg, Y), [0.065, 0, 0]),
        Transform(translation=[0, 0, length]),
        Transform(turned(turn, Z)),
    ]
    pose = Transform.identity()
    for step in steps:
        pose = pose @ step
    return pose


def longer(q, upper):
    "The difference of the upper arms in base coordinates: joint 2 leans the arm back."
    away = (upper - 0.350) * np.array([-np.sin(q[1]), 0, np.cos(q[1])])
    return turned(q[0], Z) @ away


def by_joint_6(q, upper, length, turn):
    "A program that uses the fact that a rotation about the flange's z axis changes only joint 6."
    more = q.copy()
    more[5] += turn
    flange = IRB140.fk(more)
    return Transform(flange.rotation, flange @ (0, 0, length) + longer(q, upper))


def by_matrices(q, upper, length, turn):
    c, s = np.cos(turn), np.sin(turn)
    tool = np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, length], [0, 0, 0, 1]])
    pose = IRB140.fk(q).as_matrix() @ tool
    pose[:3, 3] += longer(q, upper)
    return Transform.from_matrix(pose)


def by_parts(q, upper, length, turn):
    flange = IRB140.frames(q)[-1]
    z = flange.rotation.as_matrix()[:, 2]
    half = Quaternion([np.cos(turn / 2), 0, 0, np.sin(turn / 2)])
    return Transform(flange.rotation @ half, flange.translation + length * z + longer(q, upper))


@pytest.mark.parametrize("right", [by_chain, by_joint_6, by_matrices, by_parts])
def test_correct_tip_poses_pass(right):
    verdict = check(TIP, right)
    assert verdict.holds, verdict


@pytest.mark.parametrize("mistake", LAB.exercises["1"].own, ids=lambda m: m.name)
def test_mistakes_in_tip_poses_are_refused_and_named(mistake):
    verdict = check(TIP, LAB.exercises["1"].steps.program(mistake))
    assert not verdict.holds and verdict.mistake == mistake.name and mistake.says in verdict.says
    assert "should" in verdict.case


def gripper(length, turn):
    return Transform(turned(turn, Z), length * Z)


def plate(q, upper):
    return by_chain(q, upper, 0.0, 0.0)


GENERAL = {
    "order of a product": lambda q, up, length, turn: gripper(length, turn) @ plate(q, up),
    "mm for m": lambda q, up, length, turn: plate(q, up) @ gripper(length * mm, turn),
    "degrees for radians": lambda q, up, length, turn: plate(q, up) @ gripper(length, turn * deg),
    "sign": lambda q, up, length, turn: plate(q, up) @ gripper(length, -turn),
    "inverse of the answer": lambda q, *rest: by_chain(q, *rest).inverse(),
    "another kind or shape": lambda q, *rest: by_chain(q, *rest).translation,
}


@pytest.mark.parametrize("name", GENERAL)
def test_common_slips_in_tip_poses_are_named(name):
    assert check(TIP, GENERAL[name]).mistake == name


def test_the_library_alone_does_not_give_the_tip():
    """The upper arm is an input, so the package's arm has the wrong flange."""
    verdict = check(TIP, lambda q, upper, length, turn: IRB140.fk(q) @ gripper(length, turn))
    assert not verdict.holds and verdict.mistake == "the upper arm of 350 mm"


# --- Exercise 2: a pose with four solutions, all facing away --------------------------------------


@pytest.mark.parametrize("offset", ((0, 0, 0), (20, 0, 0), (-15, 10, 15), (0, 0, -29)))
@pytest.mark.parametrize("tilt", (30, 180))
def test_poses_too_near_for_the_rows_that_face_them_pass(offset, tilt):
    """The wrist centre is less than l3 - l2 = 30 mm away from the shoulder."""
    rotation = turned(tilt * deg, X)
    centre = (np.array([70, 0, 352]) + offset) * mm
    pose = Transform(rotation, centre + 65 * mm * (rotation @ Z))
    rows = IRB140.ik(pose)
    assert np.isnan(rows[:4]).all() and np.isfinite(rows[4:]).all()
    assert not within(IRB140, rows).all(axis=1).any()  # rows past a limit count
    assert check(POSE, pose).holds


def test_pose_farther_than_the_difference_of_the_links_is_refused():
    pose = Transform(turned(180 * deg, Y), np.array([70, 0, 352 + 31 - 65]) * mm)
    assert check(POSE, pose).mistake == "all eight ways"


@pytest.mark.parametrize("side", (-40, 0, 100))
@pytest.mark.parametrize("ahead", (680, 700, 760))
def test_poses_too_far_away_for_front_minus_1_are_refused(ahead, side):
    pose = Transform(turned(180 * deg, Y), np.array([ahead, side, 287]) * mm)
    assert (~np.isnan(IRB140.ik(pose)[:, 0])).sum() == 4
    verdict = check(POSE, pose)
    assert not verdict.holds and verdict.mistake == "the rows that face the target"


def singular():
    """A pose with its wrist centre near the shoulder and joint 5 at zero."""
    row = IRB140.ik(NEAR)[IRB140.branch(-1, +1, +1)]
    return IRB140.fk(np.array([*row[:4], 0, row[5]]))


WRONG_POSES = {
    "all eight ways": IRB140.fk(np.array([10, 20, -30, 40, 50, 60]) * deg),
    "the flange instead of the wrist centre": Transform(
        turned(180 * deg, Y), np.array([70, 0, 352]) * mm
    ),
    "limits counted": Transform(turned(90 * deg, Y), np.array([300, 200, 600]) * mm),
    "no way: out of reach": Transform(translation=(0.9, 0, 0.3)),
    "mm for m": Transform(turned(180 * deg, Y), (70, 0, 297)),
    "rows twice: a singular pose": singular(),
    "the rows that face the target": Transform(turned(180 * deg, Y), np.array([720, 0, 287]) * mm),
    "exactly at the edge": Transform(turned(180 * deg, Y), np.array([70, 0, 317]) * mm),
}


@pytest.mark.parametrize("name", WRONG_POSES)
def test_mistakes_in_poses_are_named(name):
    verdict = check(POSE, WRONG_POSES[name])
    assert not verdict.holds and verdict.mistake == name


@pytest.mark.parametrize("k", range(8))
def test_reply_to_eight_ways_states_the_wrist_centre_and_both_distances(k):
    rng = np.random.default_rng(k)
    angle, r, z = rng.uniform(-180, 180) * deg, rng.uniform(150, 450) * mm, rng.uniform(600, 800)
    centre = np.array([r * np.cos(angle), r * np.sin(angle), z * mm])
    rotation = Quaternion.from_roll_pitch_yaw(*rng.uniform(-180, 180, 3) * deg)
    pose = Transform(rotation, centre + 65 * mm * (rotation @ Z))
    rows = IRB140.ik(pose)
    assert np.isfinite(rows).all()
    away = [
        np.linalg.norm(IRB140.frames(row)[2].translation - centre) / mm
        for row in (rows[0], rows[4])
    ]
    reply = " ".join(check(POSE, pose).says)
    assert [int(x) for x in re.search(r"at \(([^)]*)\) mm", reply)[1].split(",")] == pytest.approx(
        centre / mm, abs=0.5
    )
    pattern = r"shoulder is ([\d.]+) mm with front \+1, and ([\d.]+) mm with front −1"
    said = [float(x) for x in re.search(pattern, reply).groups()]
    assert said == pytest.approx(away, abs=0.051)


def test_flange_at_the_place_of_the_wrist_centre_is_named_from_any_side():
    for angle in (0, 70, 180):
        about = turned(angle * deg, Z)
        for tilt in (0, 90, 180):
            pose = Transform(about @ turned(tilt * deg, Y), about @ (np.array([70, 0, 372]) * mm))
            verdict = check(POSE, pose)
            assert verdict.mistake == "the flange instead of the wrist centre", (angle, tilt)
            assert "65 mm behind the flange" in " ".join(verdict.says)


@pytest.mark.parametrize(
    "answer", [4, np.zeros(6), NEAR.as_matrix(), NEAR.translation, "four", [NEAR]]
)
def test_answers_that_are_not_poses_are_reported(answer):
    assert check(POSE, answer).mistake == "another kind or shape"


def test_pose_explorer_contains_the_number_of_solutions_wanted():
    task = pose_explorer(POSE).data["task"]
    assert task["wanted"] == 4 and "{count}" in task["open"]


def test_pose_explorer_reports_a_solved_task(browser, tmp_path):
    path = tmp_path / "pose.html"
    pose_explorer(POSE).save(path)
    page = browser.new_page(viewport={"width": 900, "height": 800})
    page.goto(path.as_uri())
    says = page.locator(".rk-says")
    expect(says).to_contain_text(
        "Without its limits, the arm reaches this pose in 8 ways. The exercise asks for 4."
    )
    turned = {"x, mm": 70, "y, mm": 0, "z, mm": 297, "roll, °": 180, "pitch, °": 0, "yaw, °": 180}
    for name, value in turned.items():
        field = page.get_by_label(f"{name}, exactly")
        field.fill(str(value))
        field.press("Enter")
    expect(says).to_contain_text(
        "Without its limits, the arm reaches this pose in 4 ways. Do all of them have front −1?"
    )
    page.get_by_label("x, mm, exactly").fill("370")
    page.get_by_label("x, mm, exactly").press("Enter")
    expect(says).to_contain_text(
        "Without its limits, the arm reaches this pose in 8 ways. The exercise asks for 4."
    )
    page.close()


# --- Exercise 3: an individual target -------------------------------------------------------------


def design(who, factor=1.1, height=None):
    "A correct design, found by a method other than the solution's: the fastest of a few heights."
    numbers = variant("irb140_kinematics", who)
    p, best = np.linspace(0, 1, 801), []
    for z in (0.65, 0.7, 0.75, 0.8) if height is None else (height,):
        rows = IRB140.ik(TARGET["target"](numbers, p, z))
        for row, flags in enumerate(IRB140.branches.tolist()):
            q = np.unwrap(rows[:, row], axis=0)
            turns = q[:, :, None] + 2 * np.pi * np.arange(-2, 3)
            low, high = IRB140.limits[:, :1], IRB140.limits[:, 1:]
            inside = ((turns >= low) & (turns <= high)).all(axis=0).any(axis=1)
            if inside.all():
                used = (abs(differentiate(q, p)) / IRB140.speed_limits).max()
                best.append((used / numbers["share"], z, tuple(flags)))
    shortest, z, flags = min(best)
    return {"height": z, "flags": flags, "duration": factor * shortest}


@pytest.mark.parametrize("k", range(50))
def test_individual_tasks_can_be_solved(k):
    verdict = check(DESIGN, design(k), who=k)
    assert verdict.holds, verdict


def test_individual_tasks_differ():
    assert len({repr(variant("irb140_kinematics", k)) for k in range(50)}) > 45


def test_obvious_designs_fail_for_every_student():
    for k in range(20):
        task_1 = {"height": 0.5, "flags": (1, 1, 1), "duration": 20}
        assert check(DESIGN, task_1, who=k).mistake.startswith("past a limit: joint")
        high = {"height": 1.1, "flags": (-1, -1, 1), "duration": 20}
        assert check(DESIGN, high, who=k).mistake == "out of reach"


def test_mistakes_in_designs_are_named():
    good = design("anna")
    longest = design("anna", 1.19)
    assert check(DESIGN, good, who="anna").holds and check(DESIGN, longest, who=" Anna ").holds
    for change, name in (
        ({"duration": 0.8 * good["duration"]}, "too fast: joint"),
        ({"duration": 1.25 * good["duration"]}, "slower than asked"),
        ({"height": good["height"] * 1000}, "mm for m"),
        ({"height": good["height"] * 100}, "cm for m"),
        ({"height": 0.3}, "past a limit: joint"),
        ({"flags": (1, 1, 1)}, "past a limit: joint"),
        ({"flags": 4}, "another kind or shape"),
        ({"flags": (0, 1, 1)}, "another kind or shape"),
        ({"duration": "five"}, "another kind or shape"),
        ({"duration": -1}, "another kind or shape"),
    ):
        verdict = check(DESIGN, good | change, who="anna")
        assert not verdict.holds and verdict.mistake.startswith(name), (change, verdict)
    left = check(
        DESIGN,
        good | {"duration": good["duration"] * variant(*"irb140_kinematics anna".split())["share"]},
        who="anna",
    )
    assert left.mistake.startswith("too fast: joint") and not re.search(r"\?", " ".join(left.says))
    for key in ("height", "duration"):  # a string is not a number
        text = check(DESIGN, good | {key: str(good[key])}, who="anna")
        assert text.mistake == "another kind or shape" and key in text.says[0]
    assert check(DESIGN, {"height": 0.7}, who="anna").mistake == "another kind or shape"
    assert not check(DESIGN, good | {"flags": ...}, who="anna").answered
    assert "Whose" in check(DESIGN, good).says[0]
    lists = {
        "height": np.float64(good["height"]),
        "flags": np.array(good["flags"]),
        "duration": good["duration"],
    }
    assert check(DESIGN, lists, who="anna").holds


def test_replies_about_speed_do_not_give_the_duration_away():
    good, share = design("anna"), variant("irb140_kinematics", "anna")["share"]
    for factor, word in ((0.5, "more"), (2, "less")):
        verdict = check(DESIGN, good | {"duration": factor * good["duration"]}, who="anna")
        reply = " ".join(verdict.says)
        assert re.findall(r"([\d.]+) %", reply) == [f"{100 * share:.0f}"]
        assert f"uses {word} than your share" in reply


def test_message_about_a_limit_states_the_time_the_joint_and_the_excess():
    says = " ".join(check(DESIGN, design("anna") | {"flags": (1, 1, 1)}, who="anna").says)
    assert re.search(r"Joint 1 is past its limit of −?-?180° by \d+\.\d° at t = \d\.\d\d s", says)


@pytest.mark.parametrize("k", range(20))
def test_replies_about_limits_ignore_the_speed_and_explain_joint_1(k):
    """With front +1, joint 1 crosses half a turn for each student."""
    for flags in IRB140.branches.tolist():
        for duration in (0.01, 1000.0):
            verdict = check(DESIGN, {"height": 0.8, "flags": flags, "duration": duration}, who=k)
            if not verdict.mistake.startswith("past a limit"):
                assert flags[0] < 0
                continue
            says = " ".join(verdict.says)
            assert verdict.points <= 0.75 and "speed limit" not in says
            assert ("behind the arm" in says) == (flags[0] > 0)
            if flags[0] > 0:
                assert "Joint 1 is past its limit" in says


# --- Answers to the predictions -------------------------------------------------------------------


def key(name):
    return filled(LAB.predictions[name])[2]


def jacobian(q, k, point=(0, 0, 0)):
    "The speed of a flange point when joint k turns, from the joint's axis, without differences."
    frame = IRB140.frames(q)[k + 1]
    axis = frame.rotation @ IRB140.links[k].axis if k < 5 else IRB140.fk(q).rotation @ Z
    return np.linalg.norm(np.cross(axis, IRB140.fk(q) @ point - frame.translation))


def test_answer_to_prediction_1_agrees_with_the_joint_axes():
    still = [k + 1 for k in range(6) if jacobian(np.zeros(6), k) < 1e-12]
    assert still == [4, 6] and "joints 4 and 6" in filled(LAB.predictions["p1"])[1][key("p1")].text


def test_answer_to_prediction_2_agrees_with_the_joint_axes():
    q = np.random.default_rng(2).uniform(*IRB140.limits.T)
    assert max(jacobian(q, k, (0, 0, -0.065)) for k in (3, 4, 5)) < 1e-12 and key("p2") == 0


def test_answer_to_prediction_3_agrees_with_the_plane_of_the_arm():
    text = filled(LAB.predictions["p3"])[1][key("p3")].text
    q1 = float(text.rstrip("°").replace("−", "-")) * deg
    front = np.arctan2(-230.94, 400)
    assert abs(abs(q1 - front) - np.pi) < 1e-3


def test_answer_to_prediction_4_agrees_with_half_turns_of_the_wrist():
    text = filled(LAB.predictions["p4"])[1][key("p4")].text
    wrist = [float(x.strip("°").replace("−", "-")) for x in text.split(", ")]
    assert wrist == [25 - 180, -35, -50 + 180]


def test_answer_to_prediction_6_agrees_with_the_jacobian():
    columns = [
        [*np.cross(e, IRB140.fk(np.zeros(6)).translation - p), *e]
        for e, p in (
            (X, [0.45, 0, 0.702]),
            (Y, [0.45, 0, 0.702]),
            (X, [0.515, 0, 0.702]),
        )
    ]
    assert np.linalg.matrix_rank(columns) == 2 and key("p6") == 3


def test_answer_to_prediction_7_agrees_with_the_limits():
    rows = IRB140.ik(FACTS["task_1"]()[2])[:, 0]
    low, high = IRB140.limits.T
    past = ((rows > high + 1e-9) | (rows < low - 1e-9)).any(axis=1)
    facts = LAB.predictions["p7"].facts()
    for k, name in ((2, "first 3"), (4, "first 5")):
        outside = rows[:, k] > high[k] + 1e-9
        assert outside[: outside.sum()].all() and 0.01 * outside.sum() == pytest.approx(facts[name])
    others = [0, 1, 3, 5]
    assert not ((rows > high + 1e-9) | (rows < low - 1e-9))[:, others].any()
    assert past[:673].all() and not past[673:].any() and key("p7") == 1


def test_answer_to_prediction_8_is_a_full_turn_per_time_step():
    facts = LAB.predictions["p8"].facts()
    for name, step in (("coarse", 0.01), ("fine", 0.005)):
        assert facts[name] == pytest.approx(2 * np.pi / step, rel=1e-3)
    assert key("p8") == 0


def test_answer_to_prediction_9_agrees_with_the_law_of_cosines():
    a, b, d = 0.38, 0.35, 0.1
    angle = np.arccos((b**2 + d**2 - a**2) / (2 * b * d))
    assert angle > np.pi / 2 and key("p9") == 3
    chord = 2 * b * np.sin(angle - np.pi / 2)  # the elbow moves on a circle about the shoulder
    facts = LAB.predictions["p9"].facts()
    assert facts["obtuse"] == pytest.approx(angle / deg)
    assert facts["acute"] == pytest.approx(180 - angle / deg)
    # the whole triangle rotates about the shoulder: the wrist centre moves d / b times as far as
    # the elbow
    assert facts["miss"] == pytest.approx(chord * d / b / mm)


def test_answer_to_prediction_10_agrees_with_a_direct_count():
    assert [q for q in range(-400, 401) if (q - 30) % 360 == 0] == [-330, 30, 390]
    assert key("p10") == 2
