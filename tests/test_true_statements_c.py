"""Statements that new readers refuted in the second round. Each test reads its statement from a
cell, figure or prediction and checks it by a second calculation.
"""

import json
import re

import numpy as np
import pytest
from conftest import NOTEBOOKS
from scipy.optimize import fsolve
from scipy.spatial.transform import Rotation
from test_true_statements_b import ARM, asked, cells
from test_true_statements_b import run as run_cells

from robokin import (
    IRB140,
    PUMA560,
    Quaternion,
    ScaraPose,
    Transform,
    blend,
    deg,
    differentiate,
    lin,
    mm,
    quintic,
    scara_arm,
    within,
)
from robokin.course import book
from robokin.course.book import find
from robokin.jobs.visit_collect import principal_postures

X, Y, Z = np.eye(3)


def flat(lab, cell):
    """The text of a cell on one line."""
    return re.sub(r"\s+", " ", cells(lab)[cell])


def shown(lab, cell):
    """The text in the stored output of a cell."""
    (path,) = [*NOTEBOOKS.glob(f"{lab}_*.ipynb"), *NOTEBOOKS.glob(f"documents/{lab}_*.ipynb")]
    (found,) = [
        each for each in json.loads(path.read_text(encoding="utf-8"))["cells"] if each["id"] == cell
    ]
    return "".join(
        "".join(out["text"] if "text" in out else out["data"].get("text/plain", ""))
        for out in found["outputs"]
    )


def view(name):
    """The text of a prediction's view, or the alt text of its figure."""
    made = find(name, "predictions").view()
    return made if isinstance(made, str) else made.alt


def numbers(pattern, text):
    match = re.search(pattern, text)
    assert match, pattern
    return [float(each.replace("\N{MINUS SIGN}", "-")) for each in match.groups()]


def mistakes(lab, name):
    """The mistakes with this name, each with its explanation."""
    return [
        (each, each.says)
        for exercise in find_exercises(lab)
        for each in (*getattr(exercise, "mistakes", ()), *written(exercise))
        if getattr(each, "name", "") == name
    ]


def written(exercise):
    return exercise.text.wrong() if hasattr(exercise, "text") else []


def find_exercises(lab):
    return [find(f"{lab}.{n}", "exercises") for n in (1, 2, 3)]


# --- Lab 01 ---------------------------------------------------------------------------------------


def test_no_3_by_3_matrix_moves_the_origin_and_the_rotation_fixes_only_the_z_axis():
    said = "No 3 × 3 matrix can shift every point, because every such matrix maps 0 to 0."
    assert said in flat("01", "matrices")
    rng = np.random.default_rng(1)
    assert not (rng.normal(size=(50, 3, 3)) @ np.zeros(3)).any()
    _, options, _ = asked("frames_and_quaternions.p1")
    assert "only the points on the z axis stay where they are" in " ".join(
        options[3].second.split()
    )
    values, vectors = np.linalg.eig([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    assert np.sum(abs(values - 1) < 1e-12) == 1 and abs(vectors[2, abs(values - 1).argmin()]) == 1


def test_dh_lengths_a_and_d_are_along_the_stated_axes():
    assert "each $a$ is along the red axis of the frame at its end" in flat("01", "dh-look")
    assert "each $d$ is along the blue axis of the frame before it" in flat("01", "dh-look")
    for q, d, a, alpha in np.random.default_rng(2).uniform(-2, 2, (20, 4)):
        turn = Quaternion.from_angle_axis
        end = Transform(turn(q, Z)) @ Transform(translation=[a, 0, d]) @ Transform(turn(alpha, X))
        assert end.translation == pytest.approx(a * end.rotation.as_matrix()[:, 0] + d * Z)


def test_average_of_two_rotations_shrinks_by_the_stated_factor():
    words = flat("01", "average")
    assert r"shrinks by a factor of $\cos(\theta/2)$, which is an even smaller number" in words
    assert r"$\ell = \cos(\theta/4)$: everything shrinks by a factor of $\cos^2(\theta/4)$" in words
    rng = np.random.default_rng(3)
    for theta in (20, 90, 150):
        axis = rng.normal(size=3)
        first = Quaternion.from_angle_axis(1.0, axis / np.linalg.norm(axis)).as_matrix()
        axis = rng.normal(size=3)
        other = Quaternion.from_angle_axis(theta * deg, axis / np.linalg.norm(axis)).as_matrix()
        sizes = np.linalg.svd((first + first @ other) / 2)[1]
        assert sizes == pytest.approx([1, *[np.cos(theta / 2 * deg)] * 2])
        pair = [Rotation.from_matrix(each).as_quat() for each in (first, first @ other)]
        length = np.linalg.norm(pair[0] + np.sign(pair[0] @ pair[1]) * pair[1]) / 2
        assert length == pytest.approx(np.cos(theta / 4 * deg))
        assert np.cos(theta / 2 * deg) < length**2


def test_acceleration_of_a_jump_is_the_jump_divided_by_twice_the_step():
    assert "the number is the jump in speed divided by twice the step" in flat(
        "01", "line-jump-look"
    )
    for step in (0.01, 0.001):
        t = step * np.arange(-20, 21)
        greatest = differentiate(200 * np.clip(t, 0, None), t, 2).max()
        assert greatest == pytest.approx(200 / (2 * step))


# --- Labs 02 and 03 -------------------------------------------------------------------------------


def test_the_arm_reaches_the_pose_of_the_first_picture_in_eight_ways():
    assert "This arm can reach the pose below in eight ways." in flat("02", "title")
    place = [
        float(x)
        for x in re.findall(r"\[(\d+) \* mm, (\d+) \* mm, (\d+)", cells("02")["opening"])[0]
    ]
    x, *rest = (f"{each:.0f}" for each in np.subtract(place, [65, 0, 0]))  # the wrist centre
    assert f"place = np.array([{x}, {', '.join(rest)}]) * mm" in cells("02")["triangle-code"]
    pose = Transform(Quaternion.from_angle_axis(90 * deg, Y), np.array(place) * mm)
    wanted = pose.as_matrix()

    def off(q):
        gap = IRB140.fk(np.angle(np.exp(1j * q))).as_matrix() - wanted
        turned = wanted[:3, :3].T @ gap[:3, :3]
        return np.array([*gap[:3, 3], turned[2, 1], turned[0, 2], turned[1, 0]])

    found, rng = [], np.random.default_rng(4)
    for start in rng.uniform(-np.pi, np.pi, (250, 6)):
        q, _, fine, _ = fsolve(off, start, full_output=True)
        if fine == 1 and np.allclose(IRB140.fk(np.angle(np.exp(1j * q))).as_matrix(), wanted):
            if not any(abs(np.exp(1j * q) - np.exp(1j * old)).max() < 1e-4 for old in found):
                found.append(q)
    assert len(found) == 8


def test_lengths_of_the_links_are_as_stated():
    said = [float(x) for x in re.findall(r"l_\d = (\d+)", flat("02", "chain"))]
    home, bent = np.zeros(6), np.array([0, 0, 0, 0, 90, 0]) * deg
    _, _, shoulder, elbow, *_, flange = IRB140.frames(home).translation / mm
    chord = np.linalg.norm(IRB140.fk(bent).translation / mm - flange)
    last = chord / np.sqrt(2)  # joint 5 moves the flange through a quarter of a circle
    forearm = flange[0] - last - elbow[0]
    found = [shoulder[2], shoulder[0], elbow[2] - shoulder[2], forearm, last]
    assert said == pytest.approx(found)


def test_only_joint_3_does_not_use_atan2_and_joint_6_can_undo_joint_4():
    assert "We compute every angle except that of joint 3 with atan2" in flat("02", "short")
    code = cells("02")
    assert (
        code["triangle-code"].count("np.arccos") == 1
        and "gamma = -elbow * np.arccos" in code["triangle-code"]
    )
    assert not re.search(r"arc(cos|sin)", code["wrist-code"])
    assert "At $q_5 = 0$, axes 4 and 6" in flat("02", "home")
    q = np.array([10, 20, -30, 0, 0, 50]) * deg
    back = IRB140.fk(q + [0, 0, 0, 1, 0, -1]).as_matrix()
    assert np.allclose(IRB140.fk(q).as_matrix(), back)


def test_first_and_last_x_of_the_rows_in_the_lab_are_those_of_the_triangle():
    """The target of the explorer in section 5, pulled along x: front -1 ends first."""
    says = flat("02", "drag-target-look")
    ends = numbers(
        r"At x = (\d+) mm, the four rows with front −1 vanish, and at (\d+) mm, the others", says
    )
    ahead, more = numbers(
        r"shoulder is (\d+) mm ahead of axis 1.* (\d+) mm farther back along \$r\$", says
    )
    assert more == 2 * ahead == 140 != ends[1] - ends[0] and "(not quite along x)" in says
    rotation = Quaternion.from_roll_pitch_yaw(-30 * deg, 15 * deg, -15 * deg)
    opened = shown("02", "drag-target")
    assert "x 250, y −50, z 950, roll −30, pitch 15, yaw −15" in opened
    x = np.arange(250, 900)
    place = np.stack([x, np.full_like(x, -50), np.full_like(x, 950)], axis=-1)
    centre = place - 65 * rotation.as_matrix()[:, 2]
    for shoulder, end in zip((-ahead, ahead), ends, strict=True):
        away = np.hypot(np.hypot(*centre.T[:2]) - shoulder, centre[:, 2] - 352)
        assert x[np.argmax(away > 730)] == end


def test_limits_of_the_moving_target_are_as_stated():
    made = run_cells("02", "heights-player")
    low, high = IRB140.limits.T
    says = flat("02", "limits")
    first, second, limit, none = numbers(
        r"At (\d+) and (\d+) mm, joint 3 starts past its limit of (\d+)°. "
        r"At (\d+) mm and above, no joint exceeds a limit.",
        says,
    )
    assert [first, second, none] == made["heights"][:3] and limit == high[2] / deg
    for height, q in zip(made["heights"], made["chase"], strict=True):
        past = (q < low - 1e-9) | (q > high + 1e-9)
        assert past.any(axis=0).tolist() == [False, False, height < none, False, False, False]
        assert past[0, 2] == (height < none)


@pytest.mark.parametrize("who", ["Ana Test", "Ben", "anna"])
def test_the_view_of_exercise_3_and_its_check_name_the_same_joints(who):
    """The view adds the whole turns that the exercise allows."""
    exercise = book.lab("irb140_kinematics").module("own_target")
    numbers, inside = exercise["given"](who), 0
    for row, flags in enumerate(IRB140.branches.tolist()):
        height = (0.5, 0.7, 0.9)[row % 3]
        text = cells("02")["look-3"]
        for name, value in (("height", height), ("flags", flags)):
            text, count = re.subn(rf"^look_{name} = .*", f"look_{name} = {value}", text, flags=re.M)
            assert count == 1
        text, count = re.subn(r"^animate\(", "view = animate(", text, flags=re.M)
        assert count == 1
        names = {
            "np": np,
            "IRB140": IRB140,
            "mm": mm,
            "my_target": lambda t, total, z: exercise["target"](numbers, t / total, z),
        }
        exec(text, names)
        notes = " ".join(names["view"].data["arms"][0].get("notes", {}).get("0", []))
        shown = re.findall(r"q(\d) exceeds its limit", notes)
        faults = exercise["faults"]({"height": height, "flags": flags, "duration": 10.0}, numbers)
        past = [re.findall(r"\d", name) for name, _ in faults if name.startswith("past a limit")]
        assert shown == (past[0] if past else []), (height, flags)
        inside += not past
    assert inside
    assert (
        "Each joint is shifted by whole turns so that its motion stays inside its limits or, if"
        in flat("02", "look-3-ask")
    )


def test_the_loop_over_the_fronts_keeps_the_tool_direction_of_the_first_view():
    names = run_cells("02", "opening", "chain-code", "triangle-code")
    assert isinstance(names["ahead"], Quaternion)


def test_axis_5_points_in_the_stated_direction():
    side, down = numbers(
        r"axis 5, (\d+) degrees from side and (\d+) from down", shown("02", "matrix-figure")
    )
    q = np.array([-30, 10, 0, 35, 50, 40]) * deg
    assert "np.array([-30, 10, 0, 35, 50, 40]) * deg" in cells("02")["matrix-figure"]
    h = 1e-6  # axis 5 is the axis of a small rotation of the flange by joint 5
    turn = (
        IRB140.fk(q + [0, 0, 0, 0, h, 0]).rotation @ IRB140.fk(q).rotation.inverse()
    ).as_matrix()
    axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / (
        2 * h
    )
    forearm = run_cells("02", "chain-code")["my_chain"](q)[3].rotation.as_matrix()
    ways = {"down": -forearm[:, 2], "side": forearm[:, 1]}
    assert np.arccos(axis @ ways["side"]) / deg == pytest.approx(side, abs=1e-3)
    assert np.arccos(axis @ ways["down"]) / deg == pytest.approx(down, abs=1e-3)


def test_the_triangle_closes_between_the_stated_distances():
    hint = find("irb140_kinematics.2", "exercises").hints[1]
    fore, upper, least, most = numbers(r"between (\d+) − (\d+) = (\d+) mm and .* = (\d+) mm", hint)
    assert [least, most] == [fore - upper, fore + upper]
    down = Quaternion.from_angle_axis(np.pi, [1, 0, 0])
    for d in (1, least - 1, least + 1, most - 1, most + 1):  # above the shoulder, the tool down
        rows = IRB140.ik(Transform(down, np.array([70, 0, 352 + d - 65]) * mm))
        assert np.isfinite(rows[:4]).all() == (least < d < most)
    ahead, more = numbers(
        r"shoulder is (\d+) mm in front of axis 1.* it is (\d+) mm away from there", hint
    )
    assert more == 2 * ahead == 140


def test_speeds_of_joint_1_and_the_change_in_speed_at_via_are_as_stated():
    _, options, _ = asked("irb140_motion.p1")
    said = " ".join(options[0].reason.split())
    assert "is the speed of the wrist centre around axis 1, divided by its distance" in said
    low, high = numbers(r"turns at (\S+) to (\S+)°/s", said)
    made = run_cells("03", "race")
    t = np.linspace(0, 20, 20001)
    pose = lin(made["left"], made["right"], t / 20)
    x, y, _ = (pose.translation - 65 * mm * pose.rotation.as_matrix()[..., 2]).T
    speed = (x * np.gradient(y, t) - y * np.gradient(x, t)) / (x**2 + y**2) / deg
    assert [round(abs(speed).min(), 1), round(abs(speed).max(), 1)] == [low, high]
    _, options, right = asked("irb140_motion.p5")
    said = " ".join(options[right].reason.split())
    (change,) = numbers(r"With h = 0\.01 s, it is ([\d.]+)°/s", said)
    made |= run_cells("03", "bezier-code")
    share = np.linspace(0.999, 1, 2)[:, None]  # at via, and 10 ms away from it
    before = IRB140.ik(lin(made["start"], made["via"], share[:, 0]))[:, made["row"], 2]
    after = IRB140.ik(lin(made["goal"], made["via"], share[:, 0]))[:, made["row"], 2]
    assert round(abs(before[0] - 2 * before[1] + after[0]) / 0.01 / deg, 1) == change


# --- Labs 04 to 06 --------------------------------------------------------------------------------


def test_hole_notch_and_areas_of_the_zone_are_as_stated():
    said = shown("04", "zone-grid")
    (hole,) = numbers(r"nearest point that is reached: +(\S+) mm", said)
    (notch,) = numbers(r"farthest one behind the column: (\d+) mm", said)
    assert f"where the tool is {hole:.0f} mm from the axis of joint 1" in flat("04", "able")
    assert "a ring with a notch at the back" in flat("04", "short")
    limits = np.array([[-140, 140], [-150, 150], [-400, 400], [0, 1]]) * [[deg], [deg], [deg], [1]]
    arm = scara_arm("zone", 220.2 * mm, 200 * mm, 250 * mm, limits)
    x = np.arange(1, 450) * mm
    rows = arm.ik(ScaraPose(np.stack([-x, 0 * x, 0.1 + 0 * x], axis=-1)))
    inside = x[within(arm, rows).all(axis=-1).any(axis=-1)] / mm
    assert [np.floor(inside.min()), np.ceil(inside.max())] == pytest.approx([hole, notch], abs=1)
    assert len(inside) == inside.max() - inside.min() + 1, "wanted no gap between the two"
    one, either = numbers(r"elbow \+1: +(\d+) cm²\n.*either elbow: (\d+) cm²", said)
    told = (
        "With ±140° and ±150°, the area with two elbows is only a quarter larger than with one, "
        "because the arm reaches most places with"
    )
    assert told in flat("04", "zone-look")
    assert either / one == pytest.approx(1.25, abs=0.01) and 2 * one - either > either / 2


def test_joint_3_ends_where_stated_after_a_turn_in_either_direction():
    start, left, right, over = numbers(
        r"starts at (\S+)°, so it ends at (\S+)° or at (\S+)°, which is (\S+)° past",
        flat("04", "follow-answer"),
    )
    q2 = np.arccos((270**2 - 200**2 - 250**2) / (2 * 200 * 250))  # at the start, 270 mm away
    q1 = -np.arctan2(250 * np.sin(q2), 200 + 250 * np.cos(q2))
    assert round(-(q1 + q2) / deg) == start  # the tool's angle is 0, and on a lap it turns by 360°
    assert [left, right] == [start + 360, start - 360] and right == -400 - over
    told = "If the tool starts at 0°, it can make one turn to the left, and none to the right."
    assert told in flat("04", "follow-answer")


def test_both_motions_to_the_same_orientation_have_the_stated_greatest_speeds():
    slow, fast = numbers(
        r"speed of \d+ samples (\S+) °/s \(joint 5\).* (\S+) °/s \(joint 4\)", shown("06", "twins")
    )
    # the law accelerates for a quarter of the time and brakes for a quarter
    assert "trapezoidal(duration=1)" in cells("06")["twins"]
    assert [135 / (1 - 0.25), (45 + 180) / (1 - 0.25)] == pytest.approx([slow, fast])


def test_errors_after_the_fix_are_as_stated_and_equal_sharing_turns_the_joints_least():
    words = view("spherical_wrist.p6")
    most, down, where, there = numbers(
        r"below (\S+) down to theta = (\S+); at (\S+), where phi .* it is (\S+), and falls", words
    )
    names = "table-code twins zyz-drawing zyz-code regular-code noise-code cure-code"
    made = run_cells("06", *names.split())

    def worst(theta):
        h = made["wrists"](theta)
        return max(abs(made["zyz"](*made["my_wrist"](each, +1)) - each).max() for each in h)

    assert max(worst(10.0**-n) for n in range(13)) < most and down == 1e-12 and where == 1e-13
    assert worst(where) == pytest.approx(there, rel=0.1)
    assert worst(1e-14) == pytest.approx(there / 10, rel=0.2)
    assert "so that the faster one is as slow as possible" in flat("06", "share")
    shares = np.linspace(-1, 2, 301)
    assert shares[np.maximum(abs(shares), abs(1 - shares)).argmin()] == pytest.approx(0.5)


# --- Labs 07 to 09 --------------------------------------------------------------------------------


def test_the_corner_is_a_fraction_of_the_progress_and_only_joint_values_jump():
    assert "a fraction $b$ of the progress $s$ on either side of the via point" in flat("07", "via")
    made = run_cells("07", "via-code")
    start, via, goal = made["via_start"], made["via"], made["via_goal"]
    t = np.linspace(0, 10, 4001)
    s = quintic(10)(t)
    path = blend(start, via, goal, 0.1, s)
    sharp = np.where(
        s[:, None] < 0.5,
        lin(start, via, (2 * s).clip(0, 1)).translation,
        lin(via, goal, (2 * s - 1).clip(0, 1)).translation,
    )
    cut = abs(path.translation - sharp).max(axis=1) > 1e-9
    assert cut.sum() / len(t) < 0.11 and [s[cut].min(), s[cut].max()] == pytest.approx(
        [0.4, 0.6], abs=2e-3
    )
    _, options, _ = asked("puma560_branches.p8")
    (least,) = numbers(
        r"Apart from whole turns, a fixed row .* stays above (\d+)°", options[3].second
    )
    row = PUMA560.ik(path)[:, 0]
    assert least < abs(row[:, 4]).min() / deg < least + 1
    steps = np.diff(row, axis=0)
    assert abs(steps).max() > 6, "the joint values should jump"
    assert abs(np.angle(np.exp(1j * steps))).max() < 0.1 * deg, "the arm should not jump"


def test_speeds_very_near_wrist_and_shoulder_singularities_are_as_stated():
    told = flat("07", "cross-jacobian")
    assert "As $m$ goes to 0, their motion becomes a jump of half a turn" in told
    text = flat("07", "why")
    aligned = PUMA560.fk(np.array([0, 60, -170, 0, 0, 0]) * deg)
    for m in (1e-2, 1e-3):
        u = 100 * m * mm * np.linspace(-1, 1, 4001) ** 3
        place = aligned.translation + u[:, None] * Y + m * mm * Z
        q = np.unwrap(PUMA560.ik(Transform(aligned.rotation, place))[:, 3], axis=0) / deg
        assert np.ptp(q, axis=0)[[3, 5]] == pytest.approx(180, abs=2)
    assert r"Joint 1 turns at a speed of $v\,d_3/(\rho\,r)$, where $\rho = d_3 + m$" in text
    assert "when $m$ is small compared with $d_3$" in text
    d3, h = 150.05 * mm, 1e-7
    for m in (100 * mm, 10 * mm, 1 * mm):  # speeds by finite differences of joint 1
        place = np.array([[d3 + m + x, 0, 1.2] for x in (-h, h)])
        q1 = PUMA560.ik(Transform(Quaternion(np.array([1.0, 0, 0, 0])), place))[:, 2, 0]
        rho, r = d3 + m, np.sqrt(2 * d3 * m + m * m)
        assert abs(np.diff(q1)[0]) / (2 * h) == pytest.approx(d3 / (rho * r), rel=1e-5)
    assert "at least 150.05 mm away from axis 1" in flat("07", "short")


def test_the_two_values_of_joint_1_differ_as_stated():
    (apart,) = numbers(r"At 800 mm they differ by (\d+) degrees", view("puma560_branches.p2"))
    assert round(180 - 2 * np.arcsin(150.05 / 800) / deg) == apart


def test_with_finer_steps_the_stated_number_of_lines_remains():
    """The steps are a fifth as long as in the prediction, and each row is unwrapped separately,
    from values inside the limits.
    """
    drawn = book.lab("puma560_branches").module("predictions")["random_poses"]
    ends = drawn(np.random.default_rng(7), (2, 3000))
    ends = ends[:, np.isfinite(PUMA560.ik(ends)).all(axis=(0, 2, 3))]
    served, (low, high) = 0, PUMA560.limits.T
    for a, b in zip(*ends, strict=True):
        rows = PUMA560.ik(lin(a, b, np.linspace(0, 1, 11)))
        if not np.isfinite(rows).all() or not within(PUMA560, rows).all(axis=2).all(axis=0).any():
            continue
        rows = PUMA560.ik(lin(a, b, np.linspace(0, 1, 401)))
        if np.isfinite(rows).all():
            q = np.unwrap(rows, axis=0)[..., None] + 2 * np.pi * np.array([0, -1, 1, -2, 2])
            inside = (q > low[:, None] - 1e-9) & (q < high[:, None] + 1e-9)  # shape (401, 8, 6, 5)
            begins = inside[0].argmax(axis=-1)[None, ..., None]  # index of the first value inside
            served += np.take_along_axis(inside.all(axis=0)[None], begins, -1).all(axis=2).any()
    question, _, _ = asked("puma560_branches.p7")
    assert question.startswith(f"Take {served} random straight lines")


def test_first_come_rule_meets_its_objects_where_stated():
    text = flat("14", "belt-row")
    assert "each of its first seven objects farther from the bin than the one before" in text
    assert "a late arm makes a longer trip, and is later still" in text
    made = run_cells("14", "belt-code", "belt-work")
    far = principal_postures(500 * mm, 400 * mm, made["WINDOW"]) - made["q_bin"]
    assert (np.diff(abs(far).max(axis=-1)) > 0).all(), (
        "places farther along the belt are farther from the bin"
    )
    first, soonest = (
        np.array([place for _, _, place in made["work"](made["uneven"], 0.15, come)[0]])
        for come in (True, False)
    )
    assert (np.diff(first[:7]) > 0).all() and first[7] == first[6] and first[3:].min() >= 0.6 * 160
    assert ((soonest <= 40).sum(), len(soonest)) == (143, 144)
    lines = shown("14", "belt-work").splitlines()
    for k, places in ((0, soonest), (3, first)):  # three lines for each rule
        seven = " ".join(f"{-400 + 5 * place}" for place in places[:7])
        assert lines[k + 1].endswith(f"the first seven are met at y = {seven} mm")
        assert lines[k].endswith(f", {(places <= 40).sum()} in the quarter nearest to the bin")


def one_posture(place, gamma):
    """The posture (gamma, beta, alpha) at a target for a given gamma, from two circles; NaN if
    there is no such posture.
    """
    K = np.asarray(place)
    B = np.array([np.cos(gamma), np.sin(gamma)])
    way = K - B
    d = np.hypot(*way)
    with np.errstate(invalid="ignore"):
        bend = np.arccos(d / 2)  # both levers are 1 m long
    first = np.arctan2(way[1], way[0]) + bend  # the chain turns clockwise at A: A is left of BK
    A = B + [np.cos(first), np.sin(first)]
    last = np.arctan2(*(K - A)[::-1])
    beta, alpha = (
        np.remainder(x, 2 * np.pi) for x in (np.pi + first - gamma, np.pi + last - first)
    )
    q = np.array([gamma, beta, alpha])
    return q if (q <= np.pi + 1e-9).all() else np.full(3, np.nan)


def test_gamma_must_change_between_the_two_targets():
    _, options, _ = asked("three_levers.p10")
    most, least = numbers(r"gamma turns from at most (\S+)° to at least (\S+)°", options[2].second)
    gammas = np.linspace(0, 180, 7201)
    for place, inside in (((2, 0), lambda g: g <= most), ((-1, np.sqrt(3)), lambda g: g >= least)):
        q = np.array([one_posture(place, g * deg) for g in gammas])
        there = gammas[np.isfinite(q).all(axis=1)]
        assert (
            len(there)
            and inside(there).all()
            and not inside(there - (0.15 if place[1] else -0.15)).all()
        )
        assert np.allclose(ARM.points(q[np.isfinite(q).all(axis=1)])[:, 3], place)


def test_sum_of_changes_and_largest_change_are_least_where_stated():
    STAND, TARGET = map(book.lab("three_levers").module("predictions").get, ("STAND", "TARGET"))
    at = numbers(r"least at (\d+) degrees, the largest at (\d+) degrees", view("three_levers.p8"))
    q = np.array([one_posture(TARGET, g) for g in np.linspace(0, np.pi, 20001)])
    change = abs(q - STAND)
    for alpha, size in zip(at, (change.sum(axis=1), change.max(axis=1)), strict=True):
        assert round(q[np.nanargmin(size), 2] / deg) == alpha
