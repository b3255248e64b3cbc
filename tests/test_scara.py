"""The SCARA arm and ScaraPose compared with reference cases and with the documents' own motions
(oracle, errata S1).
"""

import json
from pathlib import Path

import numpy as np
import pytest

from robokin import (
    SCARA,
    Quaternion,
    ScaraPose,
    Transform,
    blend,
    deg,
    explain,
    follow,
    lin,
    lin_lin,
    mm,
    within,
)

DATA = Path(__file__).parent / "data"
CASES = json.loads((DATA / "scara.json").read_text())["cases"]
MOTIONS = json.loads((DATA / "trajectories_scara.json").read_text())["cases"]
UNITS = np.array([1, 1, 1, mm])
START, VIA, GOAL = (
    ScaraPose(np.array(p) * mm, a)
    for p, a in (((200, 300, 120), 0.0), ((400, 100, 0), np.pi), ((200, -200, 200), np.pi / 2))
)


def turned(a, b):
    """The greatest difference between two rows of joint values, with angles modulo whole turns."""
    difference = a - b
    difference[:3] -= 2 * np.pi * np.round(difference[:3] / (2 * np.pi))
    return abs(difference).max()


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["kind"])
def test_ik_returns_reference_cases_in_their_rows(case):
    *position, angle = case["target"]
    target = ScaraPose(np.array(position) * mm, angle)
    rows = SCARA.ik(target)
    matrix = np.array(case["T"])
    matrix[:3, 3] *= mm
    np.testing.assert_allclose(SCARA.ik(Transform.from_matrix(matrix)), rows, atol=1e-9)
    assert np.isnan(rows).all() != case["reachable"]
    for solution in case["solutions"]:
        wanted = np.array(solution["q"]) * UNITS
        row = rows[SCARA.branch(solution["elbow"])]
        assert turned(row, wanted) < (1e-4 if case["singular"]["elbow"] else 1e-6)
        assert (within(SCARA, wanted) == solution["in_limits_per_joint"]).all()
        np.testing.assert_allclose(SCARA.fk(row).as_matrix(), matrix, atol=1e-12)


@pytest.mark.parametrize("shape", [(), (1,), (3, 1, 2)])
def test_ik_contains_the_original_joint_values(shape):
    rng = np.random.default_rng(4)
    q = rng.uniform(-np.pi, np.pi, (*shape, 4)) * [1, 1, 1, 0.05]
    rows = SCARA.ik(SCARA.fk(q))
    assert rows.shape == (*shape, 2, 4)
    away = rows - q[..., None, :]
    away[..., :3] -= 2 * np.pi * np.round(away[..., :3] / (2 * np.pi))
    assert (abs(away).max(-1).min(-1) < 1e-9).all()
    assert (np.sign(rows[..., 1]) == [1, -1]).all()


def test_pose_with_a_tilted_tool_is_out_of_reach():
    tilted = Transform(Quaternion.from_angle_axis(1 * deg, (1, 0, 0)), (0.3, 0, 0.1))
    assert np.isnan(SCARA.ik(tilted)).all()
    assert "tilted by 1.0°" in explain(SCARA, tilted, 0)


def law(name, total, t):
    """The target laws of 001, written out: listings 4 and 6, and the motions of task 5."""
    omega = 2 * np.pi * t / total
    if name == "listing4 target":
        circle = np.stack([np.cos(omega), np.sin(omega), 0 * t], axis=-1)
        return ScaraPose((np.array([200, 0, 100]) + 100 * circle) * mm, 4 * omega)
    if name == "listing6 target":
        x, y, z = 200 + 50 * np.cos(omega), 30 + 200 * np.sin(omega), 100 + 50 * np.sin(omega)
        return ScaraPose(np.stack([x, y, z], axis=-1) * mm, np.pi)
    if name == "LIN":
        return lin(START, GOAL, t / total)
    if name == "LIN-LIN":
        return lin_lin(START, VIA, GOAL, t / total)
    return blend(START, VIA, GOAL, float(name.split()[1]), t / total)


@pytest.mark.parametrize("case", MOTIONS, ids=lambda case: f"{case['law']} elbow {case['elbow']}")
def test_the_documents_motions_match_the_oracle(case):
    total, step = case["total"], case["step"]
    t = np.arange(0, total, step)
    # errata S1-j: the printed law misses both end poses; robokin refuses it
    if case["law"] == "blend 0.55":
        with pytest.raises(ValueError, match=r"0\.55"):
            law(case["law"], total, t)
        return
    targets = law(case["law"], total, t)
    q = follow(SCARA, SCARA.ik(targets), SCARA.branch(case["elbow"]))
    for sample in case["samples"]:
        i = round(sample["t"] / step)
        if i < len(t):
            np.testing.assert_allclose(targets.position[i] / mm, sample["target"][:3], atol=1e-9)
            assert abs(targets.angle[i] - sample["target"][3]) < 1e-9
            assert turned(q[i].copy(), np.array(sample["q"]) * UNITS) < 1e-9
    speed = np.diff(q, axis=0) / step
    np.testing.assert_allclose(abs(speed).max(0) / UNITS, case["max_abs_speed"], atol=1e-8)
    acceleration = np.diff(speed, axis=0) / step
    np.testing.assert_allclose(
        abs(acceleration).max(0) / UNITS, case["max_abs_acc"], rtol=1e-5, atol=1e-6
    )
    assert within(SCARA, q).all() == case["limits_ok"]


def test_the_angle_of_a_target_is_not_wrapped():
    half, more = lin(START, ScaraPose(VIA.position, 3 * np.pi), np.array([0.5, 1.0])).angle
    assert half == pytest.approx(1.5 * np.pi) and more == pytest.approx(3 * np.pi)
    assert VIA.as_transform().rotation.as_matrix()[0, 0] == pytest.approx(-1)


def test_half_a_turn_has_a_fixed_direction_for_targets_but_not_for_poses():
    """Errata S1-t: for poses, 0.01 degrees to either side of START decide the direction of rotation
    to VIA.
    """
    middles = []
    for off in (-0.01 * deg, 0.01 * deg):
        near = ScaraPose(START.position, off)
        assert near.lerp(VIA, 0.5).angle == pytest.approx(np.pi / 2, abs=1e-3)
        middles.append(near.as_transform().lerp(VIA.as_transform(), 0.5).rotation.as_matrix()[1, 0])
    assert middles == pytest.approx([-1, 1], abs=1e-6)


def test_zone_inside_the_limits_has_the_area_stated_in_the_errata():
    step = 4.0  # mm
    x, y = np.meshgrid(*[np.arange(-460 + step / 2, 460, step)] * 2)
    ways = within(
        SCARA, SCARA.ik(ScaraPose(np.stack([x, y, np.full_like(x, 100)], axis=-1) * mm))
    ).all(-1)
    r = np.hypot(x, y)[ways.any(-1)]
    assert 126.085128473 <= r.min() < 129 and 447 < r.max() <= 450
    assert ways.any(-1).sum() * step**2 == pytest.approx(569508.156, rel=2e-3)
    for elbow in range(2):
        assert ways[..., elbow].sum() * step**2 == pytest.approx(455956.021, rel=2e-3)


def test_the_determinant_vanishes_with_the_sine_of_joint_2():
    q = np.random.default_rng(5).uniform(*SCARA.limits.T, (200, 4))
    q[0, 1] = 0
    determinant = np.linalg.det(SCARA.jacobian(q)[:, :2, :2])
    np.testing.assert_allclose(determinant, 0.2 * 0.25 * np.sin(q[:, 1]), atol=1e-15)


def test_both_rows_coincide_at_full_reach():
    q = np.zeros((3600, 4))
    q[:, 0] = np.arange(-1800, 1800) * 0.1 * deg
    rows = SCARA.ik(SCARA.fk(q))
    np.testing.assert_allclose(rows[:, 0], rows[:, 1], atol=1e-6)
    np.testing.assert_allclose(
        SCARA.fk(rows).translation,
        SCARA.fk(q).translation[:, None] + np.zeros((1, 2, 1)),
        atol=1e-13,
    )
    assert "elbow singularity" in explain(SCARA, ScaraPose((0.45, 0, 0.1)), 0)


def test_invalid_targets_are_refused():
    with pytest.raises(ValueError, match=r"\(\.\.\., 3\)"):
        ScaraPose((1.0, 2.0), 0.0)
    with pytest.raises(ValueError, match="nan"):
        ScaraPose((0.1, 0.2, np.nan), 0.0)
    with pytest.raises(TypeError, match="ScaraPose or a Transform"):
        SCARA.ik(np.eye(4))
    with pytest.raises(TypeError, match="wanted a ScaraPose"):
        START.lerp(Transform(), 0.5)


def test_explain_states_the_stroke_in_millimetres():
    assert "joint 4 is at 220.2 mm, 40.2 mm past its limit of 180 mm" in explain(SCARA, VIA, 0)
    assert "100.0 mm beyond the reach of the arm" in explain(
        SCARA, ScaraPose((0.55, 0, 0.1), 0.0), 0
    )
    assert "40.0 mm too near to axis 1" in explain(SCARA, ScaraPose((0.01, 0, 0.1), 0.0), 1)


def test_batches_of_scara_poses_can_be_indexed():
    batch = ScaraPose(np.arange(18).reshape(2, 3, 3) / 10, np.arange(6).reshape(2, 3))
    assert batch.shape == (2, 3) and len(batch) == 2 and batch[1].shape == (3,)
    assert batch[1, 2].angle == 5 and batch[1, 2].position.tolist() == [1.5, 1.6, 1.7]
    assert batch[:, 1].angle.tolist() == [1, 4] and batch[..., None].shape == (2, 3, 1)
    assert [b.angle.tolist() for b in batch] == [[0, 1, 2], [3, 4, 5]]
    assert repr(batch) == "ScaraPose(shape=(2, 3))"
    assert repr(batch[0, 1]) == "ScaraPose(position=[0.3, 0.4, 0.5], angle=1.)"
    assert not hasattr(batch.angle, "nothing") and not batch.angle.flags.writeable


def test_scara_pose_without_an_angle_has_angle_zero():
    assert ScaraPose((0.3, 0.1, 0.2)).angle == 0
    assert (ScaraPose(np.ones((4, 3))).angle == np.zeros(4)).all()
    rows = SCARA.ik(ScaraPose((0.3, 0.1, 0.1)))
    assert np.allclose(rows[:, :3].sum(-1), 0, rtol=0, atol=1e-15)


def test_elbow_singularity_depends_only_on_joint_2():
    for q, wanted in (
        ([0.3, 0.0, 0.4, 0.1], True),
        ([0.3, np.pi, 0.4, 0.1], True),
        ([0.0, 0.5, 0.0, 0.0], False),
        ([0.3, 5e-7, 0.4, 0.1], True),
        ([0.3, 5e-6, 0.4, 0.1], False),
    ):
        assert SCARA.geometry.singularities(np.array(q)) == {"elbow": wanted}
