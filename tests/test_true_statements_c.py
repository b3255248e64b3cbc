"""Statements that fresh readers refuted in the second round: each is read where it stands, in a
cell, a figure's words or a prediction, and computed again in another way.
"""

import json
import re
from itertools import pairwise

import numpy as np
import pytest
from conftest import NOTEBOOKS
from scipy.optimize import fsolve
from test_true_statements_b import ARM, K1, Q0, asked, cells, direct, least_distance, lever_distance
from test_true_statements_b import run as run_cells

import robokin.course.obstacle_avoidance as lab_10
from robokin import (
    IRB140,
    PUMA560,
    Quaternion,
    ScaraPose,
    Transform,
    blend,
    deg,
    lin,
    mm,
    quintic,
    scara_arm,
    within,
)
from robokin.course.book import find
from robokin.jobs.obstacles import via_path, way_round
from robokin.jobs.steppers import Stepper, ramp, shortest_turn
from robokin.jobs.visit_collect import principal_postures

X, Y, Z = np.eye(3)


def flat(lab, cell):
    """The text of a cell in one line."""
    return re.sub(r"\s+", " ", cells(lab)[cell])


def shown(lab, cell):
    """What the stored output of a cell says in words."""
    (path,) = NOTEBOOKS.glob(f"{lab}_*.ipynb")
    (found,) = [
        each
        for each in json.loads(path.read_text(encoding="utf-8"))["cells"]
        if each["id"] == cell
    ]
    return "".join(
        "".join(out["text"] if "text" in out else out["data"].get("text/plain", ""))
        for out in found["outputs"]
    )


def view(name):
    return str(find(name, "PREDICTIONS").view())


def numbers(pattern, text):
    match = re.search(pattern, text)
    assert match, pattern
    return [float(each.replace("\N{MINUS SIGN}", "-")) for each in match.groups()]


def mistakes(lab, name):
    """What is said about the mistakes of this name."""
    return [
        (each, each.says)
        for exercise in find_exercises(lab)
        for each in getattr(exercise, "mistakes", ())
        if getattr(each, "name", "") == name
    ]


def find_exercises(lab):
    return [find(f"{lab}.{n}", "EXERCISES") for n in (1, 2, 3)]


# --- 01 -------------------------------------------------------------------------------------------


def test_what_no_three_by_three_matrix_does_and_what_the_turn_leaves():
    assert "no 3 × 3 matrix shifts: each sends 0 to 0" in flat("01", "matrices")
    rng = np.random.default_rng(1)
    assert not (rng.normal(size=(50, 3, 3)) @ np.zeros(3)).any()
    _, options, _ = asked("frames_and_quaternions.p1")
    assert "points of the z axis are the ones that the turn leaves" in options[3].second
    values, vectors = np.linalg.eig([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    assert np.sum(abs(values - 1) < 1e-12) == 1 and abs(vectors[2, abs(values - 1).argmin()]) == 1


def test_where_a_and_d_lie():
    assert "each $a$ lies along the red axis of the frame at its end" in flat("01", "dh-look")
    assert "each $d$ along the blue axis of the frame before it" in flat("01", "dh-look")
    for q, d, a, alpha in np.random.default_rng(2).uniform(-2, 2, (20, 4)):
        turn = Quaternion.from_angle_axis
        end = Transform(turn(q, Z)) @ Transform(translation=[a, 0, d]) @ Transform(turn(alpha, X))
        assert end.translation == pytest.approx(a * end.rotation.as_matrix()[:, 0] + d * Z)


def test_how_the_average_of_two_rotations_shrinks():
    assert r"by $\cos(\theta/2)$" in flat("01", "deeper")
    rng = np.random.default_rng(3)
    for theta in (20, 90, 150):
        axis = rng.normal(size=3)
        first = Quaternion.from_angle_axis(1.0, axis / np.linalg.norm(axis)).as_matrix()
        axis = rng.normal(size=3)
        other = Quaternion.from_angle_axis(theta * deg, axis / np.linalg.norm(axis)).as_matrix()
        sizes = np.linalg.svd((first + first @ other) / 2)[1]
        assert sizes == pytest.approx([1, *[np.cos(theta / 2 * deg)] * 2])


# --- 02 and 03 ------------------------------------------------------------------------------------


def test_the_arm_of_the_first_picture_has_eight_ways():
    assert "The arm below reaches one and the same pose in eight ways" in flat("02", "title")
    place = [float(x) for x in re.findall(r"\[(\d+) \* mm, (\d+) \* mm, (\d+)", cells("02")["setup"])[0]]
    pose = Transform(Quaternion.from_angle_axis(90 * deg, Y), np.array(place) * mm)
    wanted = pose.as_matrix()

    def off(q):
        gap = IRB140.fk(np.angle(np.exp(1j * q))).as_matrix() - wanted
        turned = wanted[:3, :3].T @ gap[:3, :3]
        return np.array([*gap[:3, 3], turned[2, 1], turned[0, 2], turned[1, 0]])

    found, rng = [], np.random.default_rng(4)
    for start in rng.uniform(-np.pi, np.pi, (250, 6)):
        q, _, fine, _ = fsolve(off, start, full_output=True)
        if fine == 1 and abs(off(q)).max() < 1e-7:
            if not any(abs(np.exp(1j * q) - np.exp(1j * old)).max() < 1e-4 for old in found):
                found.append(q)
    assert len(found) == 8


def test_which_angles_come_from_atan2_and_what_joint_6_does_beside_joint_4():
    assert "Every angle but joint 3's comes from atan2" in flat("02", "short")
    code = cells("02")
    assert code["triangle-code"].count("np.arccos") == 1 and "gamma = -elbow * np.arccos" in code["triangle-code"]
    assert not [c for c in ("joint1-code", "wrist-code") if re.search(r"arc(cos|sin)", code[c])]
    assert "At $q_5 = 0$ axes 4 and 6" in flat("02", "home")
    q = np.array([10, 20, -30, 0, 0, 50]) * deg
    back = IRB140.fk(q + [0, 0, 0, 1, 0, -1]).as_matrix()
    assert np.allclose(IRB140.fk(q).as_matrix(), back)


def test_the_corner_of_the_target_and_the_configuration_past_its_limit():
    before, after = numbers(
        r"jumps from (\d+) mm/s along y to (\d+) mm/s along x", flat("02", "deeper-questions")
    )
    made = run_cells("02", "setup", "task-code")
    places = made["target"](np.array([9, 10, 11]), 20).translation / mm
    assert np.diff(places, axis=0) == pytest.approx(np.array([[0, before, 0], [after, 0, 0]]))
    assert "With this configuration joint 2 is always past its limit" in flat("02", "limits-look")
    times = np.linspace(0, 20, 4001)
    q2 = made["IRB140"].ik(made["target"](times, 20))[:, made["IRB140"].branch(+1, -1, +1), 1]
    least = (IRB140.limits[1, 0] - q2).min()  # in between it cannot fall by more than a step does
    assert least > 10 * abs(np.diff(q2)).max() > 0


def test_where_axis_5_points():
    aside, below = numbers(r"axis 5, (\d+) degrees from aside and (\d+)", shown("02", "matrix-figure"))
    q = np.array([-30, 10, 0, 35, 50, 40]) * deg
    assert "np.array([-30, 10, 0, 35, 50, 40]) * deg" in cells("02")["matrix-figure"]
    h = 1e-6  # axis 5 from how the flange turns with joint 5
    turn = (IRB140.fk(q + [0, 0, 0, 0, h, 0]).rotation @ IRB140.fk(q).rotation.inverse()).as_matrix()
    axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / (2 * h)
    forearm = run_cells("02", "setup", "chain-code")["my_chain"](q)[3].rotation.as_matrix()
    ways = {"below": -forearm[:, 2], "aside": forearm[:, 1]}
    assert np.arccos(axis @ ways["aside"]) / deg == pytest.approx(aside, abs=1e-3)
    assert np.arccos(axis @ ways["below"]) / deg == pytest.approx(below, abs=1e-3)


def test_how_much_farther_the_shoulder_behind_is():
    hint = find("irb140_kinematics.2", "EXERCISES").hints[1]
    ahead, more = numbers(r"At its height .* more than (\d+) mm ahead is (\d+) mm farther", hint)
    for x in (ahead + 1, 300, 800):  # the shoulder is at +70 or -70 mm
        assert abs(x + ahead) - abs(x - ahead) == more == 140


def test_what_makes_joint_1_fast_and_what_changes_between_two_intervals():
    _, options, _ = asked("irb140_motion.p1")
    assert "by the wrist centre's speed round axis 1 over its distance" in options[3].reason
    low, high = numbers(r"between (\S+) and (\S+)°/s", options[3].reason)
    made = run_cells("03", "setup")
    t = np.linspace(0, 20, 20001)
    pose = lin(made["left"], made["right"], t / 20)
    x, y, _ = (pose.translation - 65 * mm * pose.rotation.as_matrix()[..., 2]).T
    speed = (x * np.gradient(y, t) - y * np.gradient(x, t)) / (x**2 + y**2) / deg
    assert [round(abs(speed).min(), 1), round(abs(speed).max(), 1)] == [low, high]
    _, options, right = asked("irb140_motion.p5")
    (change,) = numbers(r"to the next the speed changes by (\S+) rad/s", options[right].reason)
    times = 10 + 0.01 * np.arange(-50, 51)
    way = [np.interp(times, [0, 10, 20], [0, k == 1, 0]) for k in range(3)]
    there, back = (lin(made[a], made["via"], u) for a, u in (("start", times / 10), ("goal", 2 - times / 10)))
    q = np.where((times < 10)[:, None], *(IRB140.ik(p)[:, made["row"]] for p in (there, back)))
    assert len(way) == 3 and round(abs(np.diff(np.unwrap(q[:, 2]), 2)).max() / 0.01, 3) == change


# --- 04 to 06 -------------------------------------------------------------------------------------


def test_where_the_notch_begins_and_where_the_tool_is_behind_joint_1():
    hole, notch = numbers(r"between (\d+) mm and 450 .* from (\d+) mm on", shown("04", "zone-figure"))
    assert "a ring with a hole, and with a notch behind" in flat("04", "short")
    limits = np.array([[-140, 140], [-150, 150], [-400, 400], [0, 1]]) * [[deg], [deg], [deg], [1]]
    arm = scara_arm("zone", 220.2 * mm, 200 * mm, 250 * mm, limits)
    x = np.arange(1, 450) * mm
    rows = arm.ik(ScaraPose(np.stack([-x, 0 * x, 0.1 + 0 * x], axis=-1)))
    inside = x[within(arm, rows).all(axis=-1).any(axis=-1)] / mm
    assert [np.floor(inside.min()), np.ceil(inside.max())] == pytest.approx([hole, notch], abs=1)
    assert len(inside) == inside.max() - inside.min() + 1, "closed between"
    ((_, says),) = mistakes("scara_kinematics", "atan for atan2 in the triangle")
    (angle,) = numbers(r"Beyond q2 = (\d+)° the tool is behind joint 1", says)
    assert round(np.arccos(-200 / 250) / deg) == angle


def test_the_two_ways_to_one_orientation_have_their_greatest_speed():
    slow, fast = numbers(r"speed (\S+) °/s \(joint 5\).* (\S+) °/s \(joint 4\)", shown("06", "twins"))
    assert "trapezoidal(duration=1)" in cells("06")["twins"]  # a quarter up, a quarter down
    assert [135 / (1 - 0.25), (45 + 180) / (1 - 0.25)] == pytest.approx([slow, fast])


def test_what_the_cure_keeps_and_what_sharing_is_least_in():
    words = view("spherical_wrist.p6")
    most, down, where, there = numbers(
        r"below (\S+) down to theta = (\S+); at (\S+), where phi .* it is (\S+), and falls", words
    )
    made = run_cells("06", "setup", "chain-code", "zyz-code", "book-code", "noise-code", "cure-code")

    def worst(theta):
        h = made["wrists"](theta)
        return max(abs(made["zyz"](*made["my_wrist"](each, +1)) - each).max() for each in h)

    assert max(worst(10.0**-n) for n in range(13)) < most and down == 1e-12 and where == 1e-13
    assert worst(where) == pytest.approx(there, rel=0.1)
    assert worst(1e-14) == pytest.approx(there / 10, rel=0.2)
    assert "Sharing turns the faster joint least *now*" in flat("06", "share")
    shares = np.linspace(-1, 2, 301)
    assert shares[np.maximum(abs(shares), abs(1 - shares)).argmin()] == pytest.approx(0.5)
