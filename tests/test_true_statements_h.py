"""Statements that the last readers of the labs refuted, recomputed."""

import math
import re

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from test_true_statements_b import run as run_cells
from test_true_statements_c import flat, numbers, shown
from test_true_statements_g import joints_of, place_of

from robokin import (
    IRB140,
    ITMO6R,
    SCARA,
    Quaternion,
    ScaraPose,
    Transform,
    blend,
    deg,
    mm,
    spbu_arm,
    three_lever,
)
from robokin.course import book

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
    assert len(told) == 3 and {count for count, _ in told} == {"1201"}
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
        r"\(blend (\S+)\) (\S+) rad/s²", book.find("irb140_motion.p7", "predictions").view()
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
        assert float(told) == pytest.approx(abs(q @ weights).max(), abs=6e-5)


def test_both_corners_can_blend_objects_of_the_class_that_the_lab_suggests():
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


def test_the_lower_goal_is_reachable_and_below_the_lift_height():
    text = flat("05", "deeper-zones")
    (x, y, z, angle) = numbers(
        r"lower goal, `target\((\S+), (\S+), (\S+), (\S+)\)`, that lifts", text
    )
    assert "lifts the tool to 200 mm, moves over, and lowers it: three lines, two" in text
    assert z < 200 and np.isfinite(SCARA.ik(ScaraPose(np.array([x, y, z]) * mm, angle * deg))).any()


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
    made = run_cells("10", "setup", "deeper-while-code", "deeper-while-data")
    when = made["when"]
    assert np.isin(when, made["seconds"]).all(), "the samples do not contain the kinks"


# --- Second round ---------------------------------------------------------------------------------


def test_arm_with_equal_links_can_dip_below_the_floor_from_the_origin():
    text = (book.OURS / "visit_and_collect/predictions.md").read_text(encoding="utf-8")
    assert "for equal links with the tool on the origin" in text
    arm = spbu_arm(4, 4)
    q = np.radians([[0, 60, 90], [0, 60, 0], [0, 60, -30]])  # the second is between the others
    heights = arm.fk(q).translation[:, 2]
    assert abs(arm.fk(q[0]).translation).max() < 1e-9, "the tool should be at the origin"
    assert heights[1] < -1 and heights[2] > -1e-9
    assert (abs(q) <= np.abs(arm.limits).max(axis=1) + 1e-9).all()
