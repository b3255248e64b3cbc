"""Statements that the last readers of the labs refuted, computed again."""

import math
import re

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from test_true_statements_c import flat, numbers, shown
from test_true_statements_g import joints_of, place_of

from robokin import ITMO6R, Quaternion, Transform, deg, mm
from robokin.course import book

# --- Lab 06 ---------------------------------------------------------------------------------------


def test_the_pose_to_type_is_the_hit_where_two_pairs_of_rows_become_one():
    """The tool of the first cell: half a turn about z, then a quarter about y."""
    typed = re.search(
        r"type x (\S+), y (\S+), z (\S+), roll (\S+), pitch (\S+), yaw (\S+), compare rows 2 and 3",
        flat("06", "drag-target-look"),
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


def test_the_speed_at_which_the_sinking_arm_folds_has_the_digits_shown():
    """cos rule: L2^2 = r^2 + L1^2 - 2 r L1 cos(gamma), with the height falling 1 m each second."""
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
        np.nanmax(abs(np.gradient(lean(rho), times))[2:-2]) for rho in (0.15, 0.3, 0.5, 0.7, 1)
    ]
    assert count == 421 and told == pytest.approx(max(speeds) / deg, abs=0.06)


def test_the_arms_at_the_belt_turn_joint_1_at_most_2_rad_per_second():
    told = re.findall(
        r"greatest speed of (\d+) samples (\S+) °/s \(joint 1\)", shown("08", "belt-player")
    )
    assert len(told) == 3 and {count for count, _ in told} == {"1201"}
    assert {speed for _, speed in told} == {f"{math.degrees(2):.1f}"}, "the limit of the planner"


def test_the_inverse_that_searches_stops_less_than_1e_8_m_from_the_point():
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
