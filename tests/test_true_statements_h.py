"""Statements that the last readers of the labs refuted, recomputed."""

import math
import re
import shutil
import subprocess
import sys
from itertools import pairwise

import numpy as np
import pytest
from conftest import NOTEBOOKS
from scipy.spatial.transform import Rotation
from test_true_statements_b import cells
from test_true_statements_b import run as run_cells
from test_true_statements_c import flat, numbers, shown
from test_true_statements_f import one_line, option
from test_true_statements_g import joints_of, place_of

from robokin import (
    IRB140,
    ITMO6R,
    PUMA560,
    SCARA,
    Quaternion,
    Transform,
    blend,
    deg,
    lin,
    mm,
    spbu_arm,
    three_lever,
)
from robokin.course import book
from robokin.jobs import redundancy
from robokin.jobs.steppers import Stepper, phases

# --- Lab 06 ---------------------------------------------------------------------------------------


def test_two_pairs_of_rows_coincide_at_the_suggested_pose():
    """The first cell rotates the tool by half a turn about z and then by a quarter turn about y."""
    typed = re.search(
        r"type x (\S+), y (\S+), z (\S+), roll (\S+), pitch (\S+), yaw (\S+), and compare rows 2 "
        r"and 3",
        flat("06", "target-ask"),
    )
    x, y, z, *angles = (float(word.replace("\N{MINUS SIGN}", "-")) for word in typed.groups())
    typed_rotation = Rotation.from_euler("xyz", angles, degrees=True)  # fixed axes: x, y, z in turn
    hit = Rotation.from_euler("zy", [180, 90], degrees=True)
    assert (typed_rotation.inv() * hit).magnitude() < 1e-9 and (x, y, z) == (400, 0, 200)
    w, *xyz = typed_rotation.as_quat(scalar_first=True)
    rows = ITMO6R.ik(Transform(Quaternion((w, *xyz)), np.array([x, y, z]) * mm))
    same = [np.allclose(rows[k], rows[k + 1], rtol=0, atol=1e-9) for k in (0, 2, 4, 6)]
    assert sum(same) == 2 and same[1]


# --- Lab 08 ---------------------------------------------------------------------------------------


def test_elbow_of_the_sinking_arm_stays_above_the_floor_only_at_1_m():
    """The elbow is at the upper intersection of circles about the origin and the tool."""
    assert "Only at 1 m." in flat("08", "zone-take")
    (away,) = re.findall(r"away = np.array\(\[(.*?)\]\)", cells("08")["zone-player"])
    kept = []
    for rho in map(float, away.split(", ")):
        q = [joints_of((rho, 0, h), 4.0, 5.0) for h in np.linspace(4, 1.2, 421)]
        if min(math.cos(lean) for _, lean, _ in q) >= -1e-9:
            kept.append(rho)
    assert kept == [1]


def test_greatest_speed_of_joint_2_of_the_sinking_arm_is_as_shown():
    """By the law of cosines, L2^2 = r^2 + L1^2 - 2 r L1 cos(gamma); the tool sinks at 1 m/s."""
    (count, told) = numbers(
        r"greatest speed of (\d+) samples (\S+) °/s \(joint 2\)", shown("08", "zone-player")
    )
    times = np.linspace(0, 2.8, 1_000_001)

    def lean(rho):
        r = np.hypot(rho, 4 - times)
        inside = abs((r**2 + 16 - 25) / (8 * r)) <= 1
        gamma = np.arccos(np.clip((r**2 + 16 - 25) / (8 * r), -1, 1))
        q2 = np.arctan2(rho, 4 - times) - gamma
        return np.where(inside, q2, np.nan)

    speeds = [
        np.nanmax(abs(np.gradient(lean(rho), times))[2:-2]) for rho in (0, 0.15, 0.3, 0.5, 0.7, 1)
    ]
    assert count == 421 and told == pytest.approx(max(speeds) / deg, abs=0.06)


def test_joint_1_of_every_belt_arm_reaches_2_rad_per_second():
    told = re.findall(
        r"greatest speed of (\d+) samples (\S+) °/s \(joint 1\)", shown("14", "opening")
    )
    assert len(told) == 2 and {count for count, _ in told} == {"1201"}
    assert {speed for _, speed in told} == {f"{math.degrees(2):.1f}"}, "the limit of the planner"


def test_iterative_inverse_stops_less_than_1e_8_m_from_the_point():
    path = book.OURS / "visit_and_collect" / "inverse_programs.md"
    assert "stops less than 1e-8 m from the point" in path.read_text(encoding="utf-8")
    rng = np.random.default_rng(8)
    points = rng.uniform([-9, -9, 0], [9, 9, 9], size=(3000, 3))
    lengths = np.linalg.norm(points, axis=1)
    away = [
        np.linalg.norm(place_of(joints_of(p) * (1 - 1e-10)) - p)
        for p in points[(lengths > 1) & (lengths < 9)]
    ]
    assert 1e-9 < max(away) < 1e-8


# --- Lab 03 ---------------------------------------------------------------------------------------


def test_greatest_accelerations_of_both_corners_are_as_shown():
    """The accelerations are fourth-order central differences of samples 2 ms apart."""
    row = IRB140.branch(+1, +1, -1)
    shown_numbers = re.findall(
        r"\(blend (\S+)\) ([\d.]+)°/s²", book.find("irb140_motion.p7", "predictions").view()
    )
    assert len(shown_numbers) == 8
    start = Transform(Quaternion.from_angle_axis(90 * deg, (-1, 0, 0)), (0.2, 0.4, 0.2))
    via = Transform(Quaternion.from_angle_axis(45 * deg, (0, 1, 0)), (0.65, -0.1, 0.8))
    goal = Transform(Quaternion.from_angle_axis(90 * deg, (0, 1, 0)), (0.3, 0.3, 0.5))
    weights = np.array([-1, 16, -30, 16, -1]) / (12 * 0.002**2)
    for k, (share, told) in enumerate(shown_numbers):
        corner = "quintic" if k % 2 else "parabola"
        b = [0.05, 0.1, 0.15, 0.2][k // 2] / (0.75 if k % 2 else 1)
        assert float(share) == pytest.approx(b, abs=6e-4)
        inside = np.arange(10 - 10 * b + 0.02, 10 + 10 * b - 0.02, 0.001)
        times = inside[:, None] + 0.002 * np.arange(-2, 3)
        q = IRB140.ik(blend(start, via, goal, b, times / 20, corner=corner))[..., row, 2]
        assert float(told) == pytest.approx(abs(q @ weights).max() / deg, abs=6e-3)


def test_objects_of_the_class_that_the_lab_suggests_can_blend_both_corners():
    """The test uses the class that the lab suggests, with the line of code printed there."""
    (line,) = re.findall(r"returns `(Joints\(.*?)`, and round", flat("03", "deeper-own"))

    class Joints:
        def __init__(self, q):
            self.q = q

        def lerp(self, goal, s):
            return eval(line, {"np": np, "Joints": Joints, "self": self, "goal": goal, "s": s})

    ends = [Joints(np.array(q)) for q in ([0.0, 0], [1, 0], [1, 2])]
    s = np.linspace(0, 1, 101)
    for corner in ("parabola", "quintic"):
        path = blend(*ends, 0.5, s, corner=corner).q
        assert path.shape == (101, 2)
        np.testing.assert_allclose(path[[0, -1]], [[0, 0], [1, 2]], atol=1e-12)
        assert (np.linalg.norm(path - [1, 0], axis=1) > 0.1).all(), (
            "the path passes through the corner"
        )


# --- Lab 05 ---------------------------------------------------------------------------------------


STATIONS = np.array([[200, 300, 120], [400, 100, 0], [200, -200, 200]])  # mm
DEEPEST = 220.2 - 180  # mm, the lowest height of the tool


def _elbow_left(x, y, turn=0.0):
    """Return q1, q2 and q3 in degrees for a place in mm and the tool's angle, computed with the law
    of cosines.
    """
    q2 = np.arccos((x**2 + y**2 - 200**2 - 250**2) / (2 * 200 * 250))
    q1 = np.arctan2(y, x) - np.arctan2(250 * np.sin(q2), 200 + 250 * np.cos(q2))
    return np.degrees([q1, q2, np.radians(turn) - q1 - q2])


def _rounded(via_z, blend_, count=200_001):
    """Return places (count, 3) on the parabola that rounds the corner, in mm."""
    x = np.linspace(0, 1, count)[:, None]
    start, via, goal = STATIONS - [[0, 0, 0], [0, 0, -via_z], [0, 0, 0]]
    return via + 2 * blend_ * ((1 - x) ** 2 * (start - via) + x**2 * (goal - via))


def test_final_angle_of_joint_3_depends_on_the_way_round_as_stated():
    text = flat("05", "half-look")
    told = re.findall(r"at (\S+)° if you ask for (\S+)°", text.replace("\N{MINUS SIGN}", "-"))
    told = [(float(turn), float(end)) for end, turn in told]
    told.append(tuple(numbers(r"With (\S+)° it ends at (\S+)°, past its limit of 400°", text)))
    assert [turn for turn, _ in told] == [180, -180, 540]
    for turn, end in told:
        q3 = _elbow_left(400, 100, turn)[2]
        assert round(q3) == end and (abs(q3) > 400) == (turn == 540)


def test_tool_turns_by_30_degrees_while_joint_3_compensates_for_the_arm():
    first, last, back = numbers(
        r"from (\S+)° to (\S+)°: joints 1 and 2 turn the tool back by (\S+)°",
        flat("05", "corner"),
    )
    q1, q2, q3 = _elbow_left(300, 150, 340)
    assert round(q3) == last and first == 150 and round(100 + 60 - q1 - q2) == back
    assert "the tool turns by 30°" in flat("05", "turn-text")
    assert 340 - (100 + 60 + 150) == 30 and last < 400 < _elbow_left(300, 150, 700)[2]


def test_least_heights_of_the_via_point_are_as_stated():
    without, with_blend = numbers(
        r"a little above (\S+) mm\. .* With a blend of 0\.1, \*via\* can be as low as (\S+) mm",
        flat("05", "blend-answer"),
    )
    assert without == pytest.approx(DEEPEST)
    assert _rounded(with_blend, 0.1)[:, 2].min() > DEEPEST
    assert _rounded(with_blend - 0.01, 0.1)[:, 2].min() < DEEPEST
    distance, least = numbers(r"About (\S+) mm, with a blend of (\S+)\.", flat("05", "able"))
    path = _rounded(0, least)
    assert path[:, 2].min() == pytest.approx(DEEPEST, abs=0.01)
    assert round(np.linalg.norm(path - STATIONS[1], axis=1).min()) == distance
    assert "lower the tool by 220.2 mm, but it stops at 180 mm" in flat("05", "able")


def test_least_blend_is_the_fraction_of_the_time_below_the_lowest_height():
    text = flat("05", "blend-look")
    samples, least = numbers(
        r"`fraction = 0`: (\d+) of 1001 are past the limit.* the smallest possible blend, "
        r"(\S+)\. With",
        text,
    )
    z = np.interp(np.linspace(0, 1, 1001), [0, 0.5, 1], STATIONS[:, 2])
    assert (z < DEEPEST).sum() == samples
    fine = np.interp(np.linspace(0, 1, 1_000_001), [0, 0.5, 1], STATIONS[:, 2])
    assert (fine < DEEPEST).mean() == pytest.approx(least, abs=1e-4)


def test_lin_exceeds_joint_limits_for_the_stated_goals_and_ptp_does_not():
    text, made = flat("05", "ends-look"), run_cells("05", "ends-player")
    assert "With LIN, the arm goes outside the limits for x = −100, −50 and 0" in text
    assert made["race_x"][made["race_x"] <= 0].tolist() == [-100, -50, 0]
    assert "(At x = −150, part of the line is too close to the column to have a solution.)" in text
    s = np.linspace(0, 1, 2001)
    for x in (-150, *made["race_x"]):
        with np.errstate(invalid="ignore"):
            q = np.transpose(_elbow_left(200 + s * (x - 200), 300 - 700 * s))[:, :2]
        assert np.isnan(q).any() == (x == -150)
        bad1, bad2 = ((abs(np.unwrap(q, axis=0, period=360)) > [140, 150]).any(axis=0)
                      if x > -150 else (True, True))  # fmt: skip
        assert bool(bad1) == bool(bad2) == (x <= 0), x
    even = made["race_ptp"]
    assert ((even >= SCARA.limits[:, 0]) & (even <= SCARA.limits[:, 1])).all()


def test_joint_1_is_faster_by_nearly_half_if_the_goal_is_closer():
    assert "the greatest speed of joint 1 grows by nearly half" in flat("05", "lin-look")
    s, most = np.linspace(0, 1, 20001), []
    for x in (200, 100):
        q1 = _elbow_left(200 + s * (x - 200), 300 - 500 * s)[0]
        most.append(abs(np.gradient(np.unwrap(q1, period=360), s)).max())
    assert 1.4 < most[1] / most[0] < 1.5


def test_nan_is_neither_less_nor_greater_but_unequal():
    assert not math.nan < 1 and not math.nan > 1 and math.nan != 1
    for path in book.OURS.glob("*/*.md"):
        assert "comparison with NaN is always" not in path.read_text(encoding="utf-8"), path.name


# --- Lab 09 ---------------------------------------------------------------------------------------


def test_sweeps_end_as_far_above_the_least_sum_as_the_alt_text_says():
    """The sweeps are repeated in steps of 1 and 0.1 degrees; the exact least sum comes from a sweep
    in steps of 0.0005 degrees.
    """
    alt = book.find("three_levers.p7", "predictions").view().alt
    coarse, fine = numbers(r"best ones are (\S+) and (\S+) degrees above it", alt)
    K, before = np.array([1.8, 0.5]), np.array([100, 110, 120]) * deg
    arm = three_lever((1.0, 1.0, 1.0))

    def least(step):
        rows = arm.table(K, step)
        return abs(rows - before).sum(axis=-1).min() / deg

    exact = least(0.0005 * deg)
    assert coarse == pytest.approx(least(1 * deg) - exact, abs=0.006)
    assert fine == pytest.approx(least(0.1 * deg) - exact, abs=0.0012)
    assert coarse > 10 * fine


def test_plot_includes_the_time_at_which_the_waiting_arm_starts():
    """The speed of the waiting arm jumps when it starts."""
    made = run_cells("10", "setup", "cube-setup", "deeper-while-code", "deeper-while-data")
    when = made["when"]
    assert np.isin(when, made["seconds"]).all(), "the samples do not contain the kinks"


# --- Second round ---------------------------------------------------------------------------------


def test_arm_with_equal_links_can_dip_below_the_floor_from_the_origin():
    text = (book.OURS / "visit_and_collect/predictions.md").read_text(encoding="utf-8")
    assert "for equal links with the tool at the origin" in " ".join(text.split())
    arm = spbu_arm(4, 4)
    q = np.radians([[0, 60, 90], [0, 60, 0], [0, 60, -30]])  # the second is between the others
    heights = arm.fk(q).translation[:, 2]
    assert abs(arm.fk(q[0]).translation).max() < 1e-9, "the tool should be at the origin"
    assert heights[1] < -1 and heights[2] > -1e-9
    assert (abs(q) <= np.abs(arm.limits).max(axis=1) + 1e-9).all()


# --- Third round: labs 07 and 08, companion 002 ---------------------------------------------------


def test_at_the_goal_within_overlooks_joints_1_2_4_and_6():
    """Followed on random lines, these end outside their limits although another value fits."""
    told = "If you check only the goal, `within` can overlook limits of joints 1, 2, 4 and 6."
    assert told in flat("07", "choose-rule")
    low, high = PUMA560.limits.T[..., None]
    rng, far = np.random.default_rng(1), np.hypot(431.8 + np.hypot(431.8, 20.3), 150.05) * mm
    wxyz = Rotation.random(8000, random_state=rng).as_quat(scalar_first=True).reshape(2, 4000, 4)
    place = [0, 0, 671.83 * mm] + rng.uniform(-far, far, (2, 4000, 3))
    ends = Transform(Quaternion(wxyz), place)
    ends = ends[:, np.isfinite(PUMA560.ik(ends)).all(axis=(0, 2, 3))]
    rows = PUMA560.ik(lin(ends[0][:, None], ends[1][:, None], np.linspace(0, 1, 161)))
    rows = np.unwrap(rows[np.isfinite(rows).all(axis=(1, 2, 3))], axis=1)
    rows = np.moveaxis(rows, 2, 1)
    rows = rows[(abs(np.diff(rows, axis=2)) < 90 * deg).all(axis=(2, 3))]  # (rows, 161, 6)
    values = rows[..., None] + 2 * np.pi * np.arange(-3, 4)
    fits = (low <= values) & (values <= high)
    first = fits[:, 0].argmax(axis=-1)[..., None]  # the value with which the arm starts
    arrives = np.take_along_axis(fits[:, -1], first, -1)[..., 0]
    overlooked = fits[:, 0].any(axis=-1) & ~arrives & fits[:, -1].any(axis=-1)
    assert (np.flatnonzero(overlooked.any(axis=0)) + 1).tolist() == [1, 2, 4, 6]
    # joints 3 and 5 are overlooked on no line: on a row, they are less than half a turn away from
    # the stretched arm or from 0, and to fit after a whole turn they would have to be farther away
    straight = np.arctan2(431.8, 20.3) / deg
    for joint, middle in ((3, -straight), (5, 0)):
        lowest, highest = PUMA560.limits[joint - 1] / deg
        assert highest - 360 < middle - 180 and middle + 180 < lowest + 360


def flange_rates(pose, row, direction, step=1e-7):
    """The joint speeds at 100 mm/s in some direction, °/s, by a difference of the inverse."""
    ends = pose.translation + step * np.array([[-1], [1]]) * direction
    q = PUMA560.ik(Transform(pose.rotation, ends))[:, row]
    return 2 * np.sin((q[1] - q[0]) / 2) / (2 * step) * 0.1 / deg


def test_joint_speeds_stay_bounded_in_some_directions():
    words = flat("07", "short")
    assert (
        "On the lines of section 5, the joint speeds grow as $1/m$ near the wrist singularity"
        in words
    )
    assert "in other directions, they can stay bounded." in words
    aligned = PUMA560.fk(np.array([0, 60, -170, 0, 0, 0]) * deg)
    sideways, upwards = [], []
    for m in (1e-3, 1e-4, 1e-5):
        past = Transform(translation=[150.05 * mm + m, 0, 1.2])
        sideways.append(abs(flange_rates(past, 2, [0, 1, 0])).max())
        above = Transform(aligned.rotation, aligned.translation + [0, 0, m])
        upwards.append(abs(flange_rates(above, 3, [0, 0, 1])).max())
    assert max(sideways) < 2 * 0.1 / 0.15005 / deg and max(upwards) < 15


def test_fastest_joint_in_the_worst_direction_turns_as_stated():
    chosen = option("puma560_branches.p6", "the worst direction")
    (length,) = numbers(r"^About (\d+)°/s", chosen.text)
    (fastest,) = numbers(
        r"That is the length of the joint-speed vector in the worst direction; there, the fastest "
        r"joint turns at (\d+)°/s\.",
        one_line(chosen.reason),
    )
    pose = Transform(translation=[151.05 * mm, 0, 1.2])
    angles = np.linspace(0, 180, 1801) * deg  # level directions
    rates = [flange_rates(pose, 2, [np.cos(a), np.sin(a), 0]) for a in angles]
    worst = rates[np.argmax(np.linalg.norm(rates, axis=1))]
    assert np.linalg.norm(worst) == pytest.approx(length, abs=0.6)
    assert abs(worst).max() == pytest.approx(fastest, abs=0.6)
    for tilted in np.random.default_rng(6).normal(size=(2000, 3)):
        rate = flange_rates(pose, 2, tilted / np.linalg.norm(tilted))
        assert np.linalg.norm(rate) < length + 0.6 and abs(rate).max() < fastest + 0.6


def test_mirrored_posture_passes_its_limit_at_low_points_near_and_far():
    path = book.OURS / "visit_and_collect" / "inverse_programs.md"
    words = one_line(path.read_text(encoding="utf-8"))
    assert (
        "at many points joint 2 is past its limit. Test the limits, too (in radians), at low"
        in (words)
    )
    arm, rng = spbu_arm(5, 4), np.random.default_rng(9)
    points = rng.uniform([-9, -9, 0], [9, 9, 1], (4000, 3))
    out, d = np.linalg.norm(points[:, :2], axis=1), np.linalg.norm(points, axis=1)
    past = arm.ik(points)[:, 2, 1] < -90 * deg  # row 2, joint 2
    for near, beyond in ((1.5, 4), (4, 7), (7, 9)):
        some = (out > near) & (out < beyond) & (d < 9)
        assert past[some].mean() > 0.95


def test_product_in_the_printed_c_code_overflows_first_at_29():
    words = flat("002", "casts")
    (stated,) = numbers(r"With whole numbers below (\d+), the result is right\.", words)
    assert "the product in `t11` can overflow a 32-bit `int`" in words
    assert "t11 = sqrt(-(double) (t1 * t5 * (-4 * t7 + t1 + t3)));" in words
    assert "reliable only for small whole numbers" in flat("002", "title")

    def largest(bound):
        """Of the products for whole numbers below the bound, where the tip is in reach."""
        x, y, l = (k**2 for k in np.ogrid[:bound, :bound, :bound])  # noqa: E741
        products = x * (x + y) * (-4 * l + x + y)
        return abs(products[products <= 0]).max()

    assert largest(int(stated)) < 2**31 <= largest(int(stated) + 1)


def test_formula_2_saves_operations_for_x2_alone_but_not_for_both_elbows():
    counts = dict(re.findall(r"^(\S.*?\S) +\d+ -> +(\d+)", shown("002", "count-table"), re.M))
    assert counts == {
        "(2), x2": "19",
        "general, x2": "24",
        "(2), both elbows": "33",
        "general, both elbows": "30",
    }
    words = flat("002", "count-note")
    assert "it is longer for $x_2$ alone, but shorter for both elbows" in words
    assert words.endswith("So for both elbows, (2) saves no operations.")
    assert "needs fewer operations for both elbows." in flat("002", "short")


# --- The documents --------------------------------------------------------------------------------


def test_listing_1_is_right_for_every_answer_inside_the_limits_but_not_at_every_allowed_pose():
    """The poses are those of random postures inside the limits; q5 is far from 0."""
    assert "but only in answers outside the limits." in flat("001", "title")
    assert "the arcsine is right in every answer inside the limits" in flat("001", "arcsine-look")
    made = run_cells(
        "001", "setup", "vector", "quaternion", "transform", "chain-code", "inverse-code"
    )
    random = np.random.default_rng(0)
    low, high = IRB140.limits.T
    poses = random.uniform(low, high, (400, 6))
    poses[:, 4] = random.uniform(20, 110, 400) * deg
    poses = np.vstack([poses, np.radians([20, 15, -229, 10, 20, 30])])
    missed, inside = [], []
    for q in poses:
        pose = IRB140.fk(q)
        for flags in IRB140.branches:
            with np.errstate(invalid="ignore"):
                answer = np.array(made["irb_ik"](made["theirs"](pose), made["irb_l"], flags))
            if np.isfinite(answer).all():
                back = IRB140.fk(answer).as_matrix() - pose.as_matrix()
                missed.append(abs(back).max())
                turns = answer + 2 * np.pi * np.arange(-2, 3)[:, None]
                inside.append(((turns >= low) & (turns <= high)).any(axis=0).all())
    missed, inside = np.array(missed), np.array(inside)
    assert inside.sum() > 400 and missed[inside].max() < 1e-6
    assert missed[-8:].max() > 20 * mm, "the posture at the end shows the error"


def test_each_frame_after_the_base_has_the_joints_that_the_companion_names():
    words = flat("001", "chain")
    assert "the wrist frame adds those of two joints" in words
    assert "the flange frame adds another, fixed rotation by 90°" in words
    made = run_cells("001", "setup", "vector", "quaternion", "transform", "chain-code")

    def steps(q):
        """The pose of each frame in the frame before it."""
        frames = [made["ours"](frame).as_matrix() for frame in made["irb_chain"](q, made["irb_l"])]
        return [frames[0], *(np.linalg.solve(a, b) for a, b in pairwise(frames))]

    still = steps(np.zeros(6))
    turned = [[] for _ in still]
    for joint, q in enumerate(np.eye(6)):
        for k, (was, now) in enumerate(zip(still, steps(q), strict=True)):
            if abs(was - now).max() > 0.1:
                turned[k].append(joint)
    assert turned == [[], [0], [1], [2], [3, 4], [5]] and np.allclose(still[0], np.eye(4))
    fixed = [np.degrees(np.arccos((np.trace(each[:3, :3]) - 1) / 2)) for each in still]
    assert np.allclose(fixed, [0, 0, 0, 0, 0, 90])


def test_second_angle_of_the_scara_triangle_has_the_wrong_sign_at_every_distance():
    assert "since its sign is always wrong, and so is its size for" in flat("001", "scara-o")
    d = np.linspace(51, 449, 400)
    q1 = np.pi - np.arccos((250**2 + 200**2 - d**2) / (2 * 250 * 200))
    printed = np.arcsin(250 * np.sin(q1 - np.pi) / d)
    right = np.arccos((200**2 + d**2 - 250**2) / (2 * 200 * d))
    assert (printed < 0).all() and (right > 0).all()
    size_is_wrong = abs(right + printed) > 1e-9
    assert np.array_equal(size_is_wrong, d < math.sqrt(250**2 - 200**2))


def test_acceleration_of_the_blend_jumps_at_the_end_of_the_corner():
    """The difference of the second derivatives at 8 s, from both sides, does not shrink with the
    step.
    """
    assert "now finite but still jumps at both ends of the corner" in flat("001", "blend-look")
    makers = "setup vector quaternion transform chain-code inverse-code task1-code wrap-code"
    made = run_cells("001", *makers.split())
    corner = [made["ours"](made[name]) for name in ("s11", "i11", "e11")]
    row = IRB140.branch(1, 1, -1)
    for h in (0.02, 0.01, 0.005):
        for end in (8, 12):
            s = (end + h * np.arange(-3, 4)) / 20
            q = np.unwrap(IRB140.ik(blend(*corner, 0.1, s))[:, row], axis=0)
            before, after = (np.diff(q[k : k + 3], n=2, axis=0)[0] / h**2 for k in (1, 3))
            assert 0.1 < abs(after - before).max() < 0.3


def test_each_half_winding_is_idle_for_as_long_as_the_companion_says():
    assert "at least half of the time (in table 1, for three quarters)" in flat(
        "003", "motors-leads-fed"
    )
    idle = {
        drive: 1 - np.mean(phases(drive, "unipolar"), axis=0)
        for drive in ("wave", "two-phase", "half-step")
    }
    assert np.allclose(idle["wave"], 3 / 4)
    assert min(each.min() for each in idle.values()) == pytest.approx(1 / 2)


def test_last_row_of_table_3_can_be_computed_but_is_wrong_near_the_base():
    assert "three cells of the table are wrong as printed" in flat("003", "table")
    for KO in (1.05, 1.2, 1.38):
        printed = 3 * (KO**2 - 1) / (2 * KO)
        right = (1 + KO**2 - 2**2) / (2 * KO)  # law of cosines: the levers BA and AK are in line
        assert abs(printed) < 1 and abs(printed - right) > 0.9


def test_drive_with_two_windings_on_is_as_strong_as_the_glossary_says():
    """Two windings that pull at an angle: the torque is 2 cos(angle / 2) times that of one."""
    glossary = (NOTEBOOKS / "documents" / "glossary.ipynb").read_text(encoding="utf-8")
    assert "on at a time: √2 times as strong if they pull at right angles |" in glossary
    motors = {
        90: ("active", "unipolar"),
        72: ("active", "unipolar", 5),
        120: ("active", "unipolar", 3),
        60: ("active", "bipolar", 3),
    }
    for angle, motor in motors.items():
        one, two = (Stepper(*motor, drive=drive).holding_torque for drive in ("wave", "two-phase"))
        assert two / one == pytest.approx(2 * math.cos(angle / 2 * deg))


def test_readme_states_what_the_command_does_with_the_tasks(tmp_path):
    readme = " ".join((NOTEBOOKS.parent / "README.md").read_text(encoding="utf-8").split())
    assert "solves the tasks in the folder, and says why it skips one of them" in readme
    shutil.copytree(NOTEBOOKS / "tasks", tmp_path / "tasks")
    done = subprocess.run(
        [sys.executable, "-m", "robokin.jobs", tmp_path / "tasks"],
        cwd=tmp_path,
        text=True,
        capture_output=True,
    )
    told = done.stdout + done.stderr
    assert re.search(r"Task \S+ skipped:\s+\S.*too close", told) and "1 skipped" in told


def test_only_the_three_lever_arm_has_numerical_solvers():
    """The solvers of `robokin.jobs.redundancy` refuse any other arm."""
    readme = " ".join((NOTEBOOKS.parent / "README.md").read_text(encoding="utf-8").split())
    assert "solvers in `robokin.jobs.redundancy` are only for the three-lever arm" in readme
    arm = three_lever((1.0, 1.0, 1.0))
    before = np.radians([100, 110, 120])
    for solver in (redundancy.pseudo_inverse, redundancy.gradient_projection):
        reached = arm.points(solver(arm, [1.8, 0.6], before))[..., 3, :]
        assert np.allclose(reached, [1.8, 0.6], rtol=0, atol=1e-8)
        with pytest.raises(TypeError):
            solver(IRB140, [1.8, 0.6], before)
