"""The exercise and the prediction of lab 00: correct answers in every style pass, mistakes are
named, and the answer to the prediction is computed by another method.
"""

import json
import re

import numpy as np
import pytest
from conftest import NOTEBOOKS
from lab_sizes import measure

from robokin import IRB140, PUMA560, SCARA, deg, mm, ptp, within
from robokin.course import book, check, solution
from robokin.course.questions import filled

ANSWER = [45, -17, -10, 0, 30, 0]  # degrees


def place(q):
    return IRB140.fk(q).translation / mm


def searched(seed):
    """A posture that solves the task, found by a search over random joint values."""
    dice = np.random.default_rng(seed)
    low, high = IRB140.limits.T
    while True:
        q = dice.uniform(low, high)
        x, y, z = place(q)
        q[0] += np.pi / 4 - np.arctan2(y, x)  # turns the tool to the diagonal
        q[0] = (q[0] + np.pi) % (2 * np.pi) - np.pi
        if abs(z - 600) < 4.5 and np.hypot(x, y) > 100:
            return q


@pytest.mark.parametrize(
    "answer",
    [
        np.array(ANSWER) * deg,
        [x * deg for x in ANSWER],
        tuple(np.radians(ANSWER)),
        *(searched(seed) for seed in range(3)),
    ],
)
def test_every_posture_that_solves_the_task_passes(answer):
    x, y, z = place(answer)
    assert abs(x - y) <= 5 and x > 0 and abs(z - 600) <= 5, "the posture does not solve the task"
    verdict = check("start_here.1", answer)
    assert verdict.holds and verdict.points == 1, verdict


@pytest.mark.parametrize(
    ("answer", "name"),
    [
        (ANSWER, "degrees for radians"),
        (np.array(ANSWER) * deg * deg, "`deg` twice"),
        (np.array([40, -17, -10, 0, 30, 0]) * deg, "x and y differ"),
        (np.array([45, -20, -10, 0, 30, 0]) * deg, "too low"),
        (np.array([45, -10, -10, 0, 30, 0]) * deg, "too high"),
        (np.array([-45, -17, -10, 0, 30, 0]) * deg, "right instead of left"),
        (np.array([-135, -17, -10, 0, 30, 0]) * deg, "behind the arm"),
        (np.array([45, -17, -10, 0, 390, 0]) * deg, "past a limit"),
        (np.array(ANSWER[:5]) * deg, "another kind or shape"),
        ([[x * deg for x in ANSWER]], "another kind or shape"),
        (45 * deg, "another kind or shape"),
        ([np.nan] * 6, "another kind or shape"),
        (["45", "-17", "a", "0", "30", "0"], "another kind or shape"),
        ((45, -17), "another kind or shape"),
        (np.array([425, 425, 600]) * mm, "a place instead of angles"),
        ((425, 425, 600), "a place instead of angles"),
    ],
)
def test_mistakes_in_the_posture_are_named(answer, name):
    verdict = check("start_here.1", answer)
    assert verdict.answered and not verdict.holds and verdict.mistake == name, verdict
    assert verdict.says and verdict.points < 1


@pytest.mark.parametrize(("unit", "shown"), [(deg, "[40°, −17°, "), (1, "[2292°, −974°, ")])
def test_the_case_shows_the_angles_in_degrees(unit, shown):
    """So that an answer without `deg` looks as wrong as it is."""
    verdict = check("start_here.1", np.array([40, -17, -10, 0, 30, 0]) * unit)
    assert f"your answer is {shown}" in verdict.case


@pytest.mark.parametrize("seed", range(3))
def test_a_right_answer_is_told_where_the_tool_is(seed):
    q = searched(seed)
    x, y, z = place(q)
    says = f"The tool is at x = {x:.0f} mm, y = {y:.0f} mm, z = {z:.0f} mm."
    assert says in check("start_here.1", q).says


def test_a_place_meets_no_condition():
    assert check("start_here.1", np.array([425, 425, 600]) * mm).points == 0


def test_one_failed_condition_of_three_costs_a_third():
    assert check("start_here.1", np.array([45, -20, -10, 0, 30, 0]) * deg).points == 0.67
    assert check("start_here.1", np.array([40, -20, -10, 0, 30, 0]) * deg).points == 0.33


def test_missing_posture_counts_as_unanswered():
    for answer in (..., None):
        assert not check("start_here.1", answer).answered
    assert "45" in solution("start_here.1")


def test_answer_to_prediction_1_agrees_with_a_rotation_about_z():
    """The answer is computed with a rotation about z, without forward kinematics of the second
    posture.
    """
    question, options, right = filled(book.lab("start_here").predictions["p1"])
    x, y, z = place(np.array([40, -20, -10, 0, 30, 0]) * deg)
    for number in (x, y, z):
        assert f"{number:.0f}" in question
    turn = -80 * deg
    there = np.cos(turn) * x - np.sin(turn) * y, np.sin(turn) * x + np.cos(turn) * y
    wanted = "x = {:.0f} mm, y = {:.0f} mm".format(*there).replace("-", "\N{MINUS SIGN}")
    assert options[right].text.startswith(wanted)
    reasons = " ".join(option.reason for option in options)
    for angle in ("140°", "\N{MINUS SIGN}140°", "50°"):  # the directions of the other options
        assert f"at {angle}" in reasons


def cell(name):
    """The source of a cell of the lab."""
    notebook = json.loads((NOTEBOOKS / "00_start_here.ipynb").read_text(encoding="utf-8"))
    (found,) = ["".join(each["source"]) for each in notebook["cells"] if each["id"] == name]
    return found


def test_joint_5_exceeds_its_limit_on_the_lines_that_the_lab_names():
    """The tool points down, so the tilt of the forearm gives joint 5, and the law of cosines gives
    the tilt.
    """
    names = {}
    exec(cell("slider").split("print(")[0], names)
    assert np.allclose(names["lines"][..., 3], 0, atol=1e-9), "joint 4 moves"
    inside = within(IRB140, names["lines"])
    assert inside[..., [0, 1, 2, 3, 5]].all()
    more, limit = map(
        int,
        re.search(r"more than (\d+)° .* more than the (\d+)° that", cell("slider-look")).groups(),
    )
    ahead, past = np.hypot(350, np.linspace(-350, 350, 2001)) - 70, []
    for height in names["heights"]:
        up = height + 65 - 352
        gamma = np.arccos((ahead**2 + up**2 - 350**2 - 380**2) / (2 * 350 * 380))
        upper_arm = np.arctan2(up, ahead) + np.arctan2(
            380 * np.sin(gamma), 350 + 380 * np.cos(gamma)
        )
        past.append((upper_arm - gamma > more * deg).any())
    assert limit == more + 90 == round(IRB140.limits[4, 1] / deg)
    assert past == (~inside[..., 4]).any(axis=1).tolist()
    first = float(
        re.search(r"At (\d+) mm and above, joint 5 exceeds its limit", cell("slider-look"))[1]
    )
    assert past == (names["heights"] >= first).tolist() and 0 < sum(past) < len(past)


@pytest.mark.parametrize("arm", [IRB140, PUMA560, SCARA])
def test_only_the_joints_that_the_lab_names_keep_the_height(arm):
    """Joint 1 of all three arms, and all joints of the SCARA except the one that slides. (Joints 4
    to 6 of the PUMA 560 do not move its flange at all, since it is at the wrist centre.)
    """
    assert "the PUMA 560 and the SCARA, joint 1 also turns the whole arm" in cell("hand-in")
    assert "Only joint 4, which slides" in cell("other-arm-look")
    low, high = arm.limits.T
    q, other = np.random.default_rng(1).uniform(low, high, (2, 200, len(low)))
    keeps = []
    for k in range(len(low)):
        moved = q.copy()
        moved[:, k] = other[:, k]
        change = arm.fk(moved).translation[:, 2] - arm.fk(q).translation[:, 2]
        keeps.append(bool(abs(change).max() < 1e-9))
    assert keeps[:3] == ([True] * 3 if arm is SCARA else [True, False, False])
    assert arm is not SCARA or not keeps[3]


def test_joint_6_is_the_fastest_as_stated():
    names = {}
    exec(cell("player").split("animate(IRB140")[0], names)
    t, q = names["t"], ptp(names["home"], names["wave"], names["law"](names["t"]))
    speed = abs(np.gradient(q, t, axis=0)) / deg
    k, joint = np.unravel_index(speed.argmax(), speed.shape)
    said = re.search(
        r"Joint (\d), .*: after (\d) s, it turns at ([\d.]+)°/s\. "
        r".* same (\d) s, .* farthest, by (\d+)°",
        cell("player-look"),
    )
    assert [float(each) for each in said.groups()] == pytest.approx(
        [joint + 1, t[k], 180 * 15 / 8 / 4, names["law"].duration, 180], abs=0.03
    )
    assert speed[k, joint] == pytest.approx(float(said[3]), abs=0.05)


def test_the_lab_takes_no_longer_than_it_says():
    """The count leaves out the prediction after "Your turn": two minutes."""
    assert "In the next twenty minutes" in cell("title")
    assert round(measure(NOTEBOOKS / "00_start_here.ipynb").core.minutes) + 2 <= 20
    assert "in twenty minutes" in (NOTEBOOKS.parent / "README.md").read_text(encoding="utf-8")
