"""Choosing among solutions: within, nearest, follow, explain."""

import itertools
from types import SimpleNamespace

import numpy as np
import pytest
from machines import MACHINES, SHAPES, SIX, gap, position_gap, random_joints, rotation_gap, turns

from robokin import (
    IRB140,
    ITMO6R,
    PUMA560,
    SCARA,
    Arm,
    Link,
    Quaternion,
    Transform,
    blend,
    deg,
    explain,
    follow,
    lin,
    mm,
    nearest,
    representative,
    within,
)
from robokin.arms import unwrapped

machines = pytest.mark.parametrize("machine", MACHINES, ids=repr)
six = pytest.mark.parametrize("machine", SIX, ids=repr)
HOME = np.zeros(6)

# One revolute and one prismatic joint: limits beyond half a turn, and a stroke longer than 2 pi
# metres.
MIXED = Arm(
    "mixed",
    SimpleNamespace(
        links=(Link(), Link(axis=(1, 0, 0), prismatic=True)), target=Transform, reach=1.0
    ),
    [(-250 * deg, 100 * deg), (-0.5, 7.0)],
)


def representatives(arm, q):
    """All values q + 2 pi k of each joint that are inside its limits, found by trial; only k = 0
    for a prismatic joint.
    """
    out = []
    for value, (low, high), slides in zip(q, arm.limits, arm.prismatic, strict=True):
        values = value + 2 * np.pi * np.arange(-4, 5) * (not slides)
        out.append(sorted({float(v) for v in values if low - 1e-9 <= v <= high + 1e-9}))
    return out


# within
# --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("arm", [m.arm for m in MACHINES] + [MIXED], ids=lambda arm: arm.name)
@pytest.mark.parametrize("shape", SHAPES)
def test_within_accepts_values_that_differ_by_whole_turns(arm, shape):
    rng = np.random.default_rng(20)
    q = rng.uniform(-8, 8, (*shape, len(arm.links)))
    inside = within(arm, q)
    assert inside.shape == q.shape and inside.dtype == bool
    for i in np.ndindex(*shape):
        assert inside[i].tolist() == [bool(values) for values in representatives(arm, q[i])]


def test_within_accepts_values_at_a_limit_and_rejects_nan():
    assert within(IRB140, IRB140.limits.T).all()
    with pytest.warns(UserWarning, match="q: 13.2645 rad .* did you mean degrees"):
        assert within(IRB140, IRB140.limits[:, 1] + 2 * np.pi).all()
    past = IRB140.limits[:, 1] + 1e-6
    # the limits of these joints span a full turn or more
    assert within(IRB140, past).tolist() == [True, False, False, True, False, True]
    assert within(IRB140, [0, np.nan, 0, 0, 0, np.nan]).tolist() == [
        True,
        False,
        True,
        True,
        True,
        False,
    ]


def test_whole_turns_do_not_apply_to_prismatic_joints():
    assert within(MIXED, [0, 6.9]).tolist() == [True, True]
    assert within(MIXED, [110 * deg, -0.6]).tolist() == [True, False]
    assert within(MIXED, [105 * deg, 7.1]).tolist() == [False if 105 - 360 < -250 else True, False]
    assert within(MIXED, [0, 0.1 - 2 * np.pi]).tolist() == [True, False]


def test_limits_beyond_half_a_turn_are_respected():
    """Errata S1-f: the listing rejects joint 3 at 160 degrees, because this exceeds its limit of 50
    degrees, although -200 degrees is the same angle and inside the limits.
    """
    drawn = np.array([10, 20, -200, 30, 40, 50]) * deg
    rows = IRB140.ik(IRB140.fk(drawn))
    row = np.nanargmin(turns(rows, drawn).max(-1))
    assert abs(rows[row, 2] - 160 * deg) < 1e-12
    assert within(IRB140, rows[row]).all()
    assert np.allclose(nearest(IRB140, rows, HOME + drawn * 0.9), drawn, rtol=0, atol=1e-12)


# nearest
# --------------------------------------------------------------------------------------------------


def nearest_by_trial(arm, rows, q):
    """The nearest row, found by trying all rows and whole turns; each joint inside its limits if
    possible.
    """
    best = np.full(len(arm.links), np.nan)
    for row in rows[~np.isnan(rows).any(-1)]:
        choice = []
        for i, inside in enumerate(representatives(arm, row)):
            values = inside or (row[i] + 2 * np.pi * np.arange(-4, 5) * (not arm.prismatic[i]))
            choice.append(min(values, key=lambda v: abs(v - q[i])))
        if np.isnan(best).any() or abs(choice - q).sum() < abs(best - q).sum():
            best = np.array(choice)
    return best


@machines
@pytest.mark.parametrize("shape", SHAPES)
def test_nearest_has_the_least_travel_of_all_rows_and_turns(machine, shape):
    arm = machine.arm
    rng = np.random.default_rng(21)
    q = rng.uniform(arm.limits[:, 0], arm.limits[:, 1], (*shape, len(arm.links)))
    rows = arm.ik(arm.fk(random_joints(arm, rng, shape)))
    chosen = nearest(arm, rows, q)
    assert chosen.shape == q.shape
    for i in np.ndindex(*shape):
        assert np.allclose(chosen[i], nearest_by_trial(arm, rows[i], q[i]), rtol=0, atol=1e-12)


def test_nearest_broadcasts_and_returns_nan_without_rows():
    rng = np.random.default_rng(22)
    q = rng.uniform(-1, 1, (5, 6))
    rows = IRB140.ik(IRB140.fk(q[0]))
    assert np.allclose(
        nearest(IRB140, rows, q),
        [nearest_by_trial(IRB140, rows, one) for one in q],
        rtol=0,
        atol=1e-12,
    )
    many = IRB140.ik(IRB140.fk(q))
    many[2] = np.nan
    chosen = nearest(IRB140, many, q[0])
    assert (
        chosen.shape == (5, 6)
        and np.isnan(chosen[2]).all()
        and np.isfinite(np.delete(chosen, 2, 0)).all()
    )


def test_nearest_does_not_wrap_prismatic_joints():
    rows = np.array([[3.0, 6.5], [-3.0, 0.1]])
    # 172 degrees exceeds the limit
    assert np.allclose(nearest(MIXED, rows, [0.0, 6.4]), [3.0 - 2 * np.pi, 6.5])
    assert np.allclose(nearest(MIXED, rows, [0.0, 0.0]), [-3.0, 0.1])
    beyond = np.array([[0.0, 7.5]])
    assert np.allclose(nearest(MIXED, beyond, [0.0, 0.0]), [0.0, 7.5])


def test_nearest_returns_the_current_posture_for_its_own_pose():
    rng = np.random.default_rng(23)
    q = rng.uniform(IRB140.limits[:, 0], IRB140.limits[:, 1], (200, 6))
    assert abs(nearest(IRB140, IRB140.ik(IRB140.fk(q)), q) - q).max() < 1e-9


# follow
# --------------------------------------------------------------------------------------------------


def joint_path(arm, q0, q1, samples=201):
    """A motion in joint space, its rows, and the row it starts on."""
    s = np.linspace(0, 1, samples)[:, None]
    q = q0 + s * (np.asarray(q1) - q0)
    rows = arm.ik(arm.fk(q))
    start = (
        next(i for i in range(samples) if abs(np.sin(q[i, 4])) > 1e-6) if len(arm.links) == 6 else 0
    )
    row = int(np.nanargmin(gap(arm, rows[start], q[start]).max(-1)))
    return q, rows, row


@six
@pytest.mark.parametrize("middle", [0.0, np.pi])
def test_follow_passes_through_the_wrist_singularity_without_a_jump(machine, middle):
    """q5 crosses 0 (or pi) while q4 and q6 are constant: in a fixed row both jump by half a turn;
    with `follow`, neither moves.
    """
    arm = machine.arm
    rng = np.random.default_rng(24)
    crossed = 0
    for _ in range(12):
        q0 = rng.uniform(-1, 1, 6) + [0, 0, 0.3, 0, 0, 0]
        q0[4], q1 = middle - 0.5, q0.copy()
        q1[[0, 4]] = q0[0] + 0.3, middle + 0.5
        q, rows, row = joint_path(arm, q0, q1)
        path = follow(arm, rows, row)
        assert turns(path, q).max() < 1e-8
        assert abs(np.diff(path, axis=0)).max() < 0.011
        assert position_gap(arm.fk(path), arm.fk(q)).max() < 1e-12
        assert rotation_gap(arm.fk(path), arm.fk(q)).max() < 1e-9
        crossed += np.nanmax(turns(np.diff(rows[:, row], axis=0), 0)) > 1
    assert crossed == 12


@six
@pytest.mark.parametrize("sine", [1e-14, 3e-13, 1e-11, 1e-10])
def test_rounding_errors_at_the_wrist_singularity_move_no_joint(machine, sine):
    """This close to the singularity, the value of joint 4 is dominated by rounding errors in every
    row; `follow` ignores them.
    """
    arm = machine.arm
    rng = np.random.default_rng(25)
    q = np.repeat(rng.uniform(-1, 1, (1, 6)) + [0, 0, 0.3, 0, 0, 0], 41, axis=0)
    q[:, 0] += np.linspace(0, 0.1, 41)
    q[:, 4] = np.linspace(-0.1, 0.1, 41)
    q[15:26, 4] = sine * rng.choice([-1, 1], 11)
    rows = arm.ik(arm.fk(q))
    path = follow(arm, rows, int(np.nanargmin(turns(rows[0], q[0]).max(-1))))
    assert turns(path, q).max() < 1e-6
    assert rotation_gap(arm.fk(path), arm.fk(q)).max() < 1e-9


def test_follow_leaves_home_without_a_jump():
    """The IRB-140's home pose is a wrist singularity, so the motion begins with the joint values of
    its second sample.
    """
    goal = Transform(
        Quaternion.from_angle_axis(90 * deg, (0, 1, 0))
        @ Quaternion.from_angle_axis(0.4, (0.6, 0.8, 0)),
        (0.4, 0.2, 0.6),
    )
    poses = lin(IRB140.fk(HOME), goal, np.linspace(0, 1, 401))
    rows = IRB140.ik(poses)
    for row in range(8):
        path = follow(IRB140, rows, row)
        if np.isnan(rows[:, row]).any():
            continue
        assert abs(np.diff(path, axis=0)).max() < 0.1
        assert np.allclose(turns(path[1], rows[1, row]), 0, atol=1e-8)
        assert (
            turns(path[0, [3, 5]].sum(), rows[0, row, [3, 5]].sum()) < 1e-12
            or abs(rows[0, row, 4]) > 1e-3
        )
        assert (
            rotation_gap(IRB140.fk(path), poses).max() < 1e-9
            and position_gap(IRB140.fk(path), poses).max() < 1e-12
        )
    back = follow(IRB140, rows[::-1], IRB140.branch(1, 1, 1))  # the motion into the singularity
    assert abs(np.diff(back, axis=0)).max() < 0.1
    assert rotation_gap(IRB140.fk(back[-1]), IRB140.fk(HOME)) < 1e-12


def test_free_joints_do_not_move_at_the_wrist_singularity():
    q = np.zeros((50, 6)) + [0, 0.2, -0.1, 0, 0, 0.7]
    q[:, 0] = np.linspace(0, 1, 50)
    path = follow(IRB140, IRB140.ik(IRB140.fk(q)), IRB140.branch(1, 1, 1))
    assert np.allclose(path[:, :3], q[:, :3], rtol=0, atol=1e-12)
    assert np.allclose(path[:, 3] + path[:, 5], 0.7, rtol=0, atol=1e-12)
    assert abs(np.diff(path[:, 3:], axis=0)).max() < 1e-12


def test_joints_4_and_6_share_a_rotation_equally_at_the_wrist_singularity():
    q = np.zeros((50, 6)) + [0.3, 0.2, -0.1, 0, 0, 0]
    q[:, 5] = np.linspace(0, 1, 50)
    path = follow(IRB140, IRB140.ik(IRB140.fk(q)), IRB140.branch(1, 1, 1))
    assert np.allclose(path[:, 3] - path[0, 3], q[:, 5] / 2, rtol=0, atol=1e-12)
    assert np.allclose(path[:, 5] - path[0, 5], q[:, 5] / 2, rtol=0, atol=1e-12)


def test_only_free_joints_take_values_from_a_later_sample():
    """A joint that is free at the start takes its value from the later sample that determines it.
    Joint 1 is not free, and crosses 180 degrees before that sample.
    """
    q = np.zeros((60, 6)) + [0, 0.2, -0.1, 0.3, 0, 0.4]
    q[:, 0] = 3.0 + np.linspace(0, 0.5, 60)
    q[40:, 4] = np.linspace(0, 0.5, 20)
    path = follow(IRB140, IRB140.ik(IRB140.fk(q)), IRB140.branch(1, 1, 1))
    assert abs(path[:, :3] - q[:, :3]).max() < 1e-9
    # at the start, joints 4 and 6 already have the values that they need when joint 5 first moves
    assert abs(path - q).max() < 1e-6


@machines
def test_follow_returns_the_original_motion(machine):
    """For joint paths over several turns, through +-pi and beyond every limit, `follow` returns the
    same motion, unwrapped.
    """
    arm = machine.arm
    rng = np.random.default_rng(26)
    low, high = (
        np.where(arm.prismatic, arm.limits[:, 0], -7),
        np.where(arm.prismatic, arm.limits[:, 1], 7),
    )
    # Where two rows meet (a stretched arm, the PUMA's d3), samples cannot distinguish passing
    # through from turning back.
    meet = (
        slice(0, 1)
        if len(arm.links) == 4
        else slice(0, 2)
        if machine.wrist["lateral"]
        else slice(1, 2)
    )
    done = 0
    while done < 5:
        q0 = random_joints(arm, rng, ())
        q1 = np.where(rng.random(q0.shape) < 0.7, rng.uniform(low, high), q0)
        q, rows, row = joint_path(arm, q0, q1, 601)
        own = arm.branches[np.nanargmin(gap(arm, rows, q[:, None]).max(-1), axis=1)]
        if np.ptp(own[:, meet], axis=0).any() or abs(np.sin(q[0, 4:5])).min(initial=1) < 0.1:
            continue
        done += 1
        path = follow(arm, rows, row)
        turned = 2 * np.pi * np.round((path[0] - q[0]) / (2 * np.pi)) * ~arm.prismatic
        assert abs(path - turned - q).max() < 1e-6


def test_follow_lets_joint_6_turn_beyond_its_limit():
    q0, q1 = np.array([0.3, 0.2, -0.1, 0.3, 0.7, 6.0]), np.array([0.4, 0.1, 0.1, -0.3, 0.5, 21.0])
    q, rows, row = joint_path(IRB140, q0, q1, 301)
    path = follow(IRB140, rows, row)
    assert abs(np.ptp(path[:, 5]) - 15) < 1e-9 and path[:, 5].max() > 400 * deg
    assert abs(path - path[0] - (q - q[0])).max() < 1e-9


def test_follow_starts_inside_the_limits_if_possible():
    drawn = np.array([10, 20, -200, 30, 40, 50]) * deg
    rows = IRB140.ik(IRB140.fk(drawn + np.linspace(0, 0.1, 11)[:, None]))
    path = follow(IRB140, rows, int(np.nanargmin(turns(rows[0], drawn).max(-1))))
    assert np.allclose(path[0], drawn, rtol=0, atol=1e-12)
    puma = np.array([10, 200, -200, 160, 40, 50]) * deg  # wrapped, joints 2 and 3 are -160 and 160
    rows = PUMA560.ik(PUMA560.fk(puma + np.linspace(0, 0.1, 11)[:, None]))
    path = follow(PUMA560, rows, int(np.nanargmin(turns(rows[0], puma).max(-1))))
    assert np.allclose(path[0], puma, rtol=0, atol=1e-12)


def out_and_back():
    """A straight line that leaves the workspace and returns, at a constant orientation."""
    T = IRB140.fk(np.array([0.3, -0.4, 0.2, 0.5, 0.8, -0.3]))
    s = np.linspace(0, 1, 301)
    out = T.translation + np.sin(np.pi * s)[:, None] * np.array([0.6, 0.1, 0.1])
    return IRB140.ik(Transform(T.rotation, out))


def test_follow_continues_after_a_gap_from_the_last_sample_before_it():
    rows = out_and_back()
    path = follow(IRB140, rows, 0)
    gone = np.isnan(path).any(-1)
    assert gone.tolist() == np.isnan(rows).any(-1).all(-1).tolist() and np.isnan(path[gone]).all()
    inside = np.flatnonzero(~gone)
    last, first = inside[inside < 150][-1], inside[inside > 150][0]
    assert last < 140 and first > 160
    assert np.allclose(path[first], path[last], atol=0.15)  # the arm returns along the same line
    assert np.allclose(path[-1], path[0], rtol=0, atol=1e-9)
    assert (
        np.nanmax(abs(np.diff(path, axis=0))) < 0.2
    )  # the joints move fast when the arm is nearly stretched
    shifted = rows.copy()
    shifted[:first] = np.nan
    assert np.allclose(follow(IRB140, shifted, 0)[first:], rows[first:, 0], rtol=0, atol=1e-9)


def test_follow_starts_at_the_first_sample_in_which_its_row_exists():
    rows = out_and_back()[::-1].copy()
    rows[:20, 3] = np.nan
    path = follow(IRB140, rows, 3)
    assert np.isnan(path[:20]).all()
    assert turns(path[20], rows[20, 3]).max() < 1e-12
    rows[:, 5] = np.nan
    assert np.isnan(follow(IRB140, rows, 5)).all()


@machines
def test_follow_treats_each_motion_of_a_batch_separately(machine):
    arm = machine.arm
    rng = np.random.default_rng(27)
    q0, q1 = random_joints(arm, rng, (2, 3, 2, 1)) * 0.5
    q = q0 + np.linspace(0, 1, 40)[:, None] * (q1 - q0)
    rows = arm.ik(arm.fk(q))
    rows[1, 0, 10:20] = np.nan
    rows[2, 1] = np.nan
    for row in (0, len(arm.branches) - 1):
        path = follow(arm, rows, row)
        assert path.shape == (3, 2, 40, len(arm.links))
        for i in np.ndindex(3, 2):
            assert np.array_equal(path[i], follow(arm, rows[i], row), equal_nan=True)
        assert np.isnan(path[2, 1]).all() and np.isnan(path[1, 0, 10:20]).all()


@machines
def test_follow_returns_solutions_for_the_poses(machine):
    arm = machine.arm
    rng = np.random.default_rng(28)
    q0, q1 = random_joints(arm, rng, (2,))
    q = q0 + np.linspace(0, 1, 200)[:, None] * (q1 - q0)
    T = arm.fk(q)
    path = follow(arm, arm.ik(T), 0)
    some = np.isfinite(path).all(-1)
    assert some.any()
    assert (
        position_gap(arm.fk(path), T)[some].max() < 1e-12
        and rotation_gap(arm.fk(path), T)[some].max() < 1e-9
    )


def test_follow_accepts_a_single_sample():
    rows = IRB140.ik(IRB140.fk(np.full((1, 6), 0.2)))
    assert np.allclose(follow(IRB140, rows, 0), [[0.2] * 6], rtol=0, atol=1e-12)


# explain
# --------------------------------------------------------------------------------------------------

TURNED = Quaternion.from_angle_axis(90 * deg, (0, 1, 0))  # the flange's z axis points forward


def test_explain_describes_a_usable_row():
    text = explain(IRB140, IRB140.fk([0.1, 0.2, 0.1, 0.3, 0.5, 0.2]), 0)
    assert (
        text.startswith("Row 0 (+1, +1, +1) is usable")
        and "singular" in text
        and text.endswith(".")
    )


def test_explain_reports_the_distance_out_of_reach():
    # 12.3 mm beyond the reach of the stretched arm, in front of the shoulder
    centre = np.array([0.07 + 0.73 + 0.0123, 0, 0.352])
    pose = Transform(TURNED, centre + [0.065, 0, 0])
    for row in range(4):
        assert "12.3 mm beyond the reach of the arm" in explain(IRB140, pose, row)
        assert "does not exist" in explain(IRB140, pose, row) and "metres" not in explain(
            IRB140, pose, row
        )
    # an arm that reaches back over the shoulder falls short by another 140 mm
    assert "152.3 mm beyond" in explain(IRB140, pose, 4)
    near = Transform(TURNED, np.array([0.07 + 0.02, 0, 0.352]) + [0.065, 0, 0])
    assert "10.0 mm too near" in explain(IRB140, near, 0)
    assert "too near to axis 1" in explain(PUMA560, Transform(translation=(0.1, 0.1, 0.9)), 0)
    # 150.05 - 141.42
    assert "8.6 mm" in explain(PUMA560, Transform(translation=(0.1, 0.1, 0.9)), 0)


def test_explain_asks_whether_a_distant_pose_is_in_millimetres():
    text = explain(IRB140, Transform(TURNED, (515, 0, 702)), 0)
    assert "does not exist" in text and "millimetres" in text and "mm" in text
    # in millimetres, this pose would be out of reach, too
    assert "millimetres" not in explain(IRB140, Transform(TURNED, (515e3, 0, 702e3)), 0)
    assert "millimetres" not in explain(IRB140, Transform(TURNED, (2, 0, 0.7)), 0)


def test_explain_names_every_joint_outside_its_limits():
    drawn = np.array([10, 105, 60, 30, 120, 50]) * deg
    pose = IRB140.fk(drawn)
    row = int(np.nanargmin(turns(IRB140.ik(pose), drawn).max(-1)))
    text = explain(IRB140, pose, row)
    for words in ("joint 3", "60.0°", "10.0°", "50°", "joint 5", "120.0°", "5.0°", "115°"):
        assert words in text
    assert "joint 2" not in text and "joint 1" not in text
    low = np.array([0, -100, 0, 0.3, 30, 0]) * deg
    row = int(np.nanargmin(turns(IRB140.ik(IRB140.fk(low)), low).max(-1)))
    text = explain(IRB140, IRB140.fk(low), row)
    assert "joint 2" in text and "-100.0°" in text and "10.0°" in text and "-90°" in text


def test_explain_gives_the_values_of_prismatic_joints_in_millimetres():
    pose = SCARA.fk([0.2, 0.5, 0.1, 200 * mm])
    text = explain(SCARA, pose, 0)
    assert (
        "joint 4" in text
        and "200.0 mm" in text
        and "20.0 mm" in text
        and "180 mm" in text
        and "°" not in text
    )


def test_explain_names_the_singularity():
    assert "wrist" in explain(IRB140, IRB140.fk(HOME), 0)
    stretched = IRB140.fk([0.2, -0.3, -90 * deg, 0.2, 0.7, 0.1])
    assert "elbow" in explain(IRB140, stretched, 0) and "wrist singularity" not in explain(
        IRB140, stretched, 0
    )
    above = Transform(TURNED, (0.065, 0, 0.9))  # the wrist centre is on axis 1
    assert "shoulder" in explain(IRB140, above, 0)
    zero = explain(ITMO6R, ITMO6R.fk(HOME), 0)
    assert "elbow" in zero and "wrist" in zero


@six
def test_explain_agrees_with_ik_and_within(machine):
    arm = machine.arm
    rng = np.random.default_rng(29)
    seen = set()
    for q in random_joints(arm, rng, (60,)):
        pose = arm.fk(q)
        pose = Transform(pose.rotation, pose.translation + rng.normal(size=3) * 0.15)
        for row, solution in enumerate(arm.ik(pose)):
            text = explain(arm, pose, row)
            missing, good = bool(np.isnan(solution).any()), bool(within(arm, solution).all())
            assert text.startswith(f"Row {row} (") and text.endswith(".") and text.count(".\n") == 0
            assert ("does not exist" in text) == missing
            assert missing or (" is usable" in text) == good
            assert ("past its limit" in text) == (not missing and not good)
            assert ": ." not in text and "nan" not in text
            seen.add((missing, good))
    assert {(True, False), (False, True)} <= seen


# invalid calls
# --------------------------------------------------------------------------------------------------

ROWS = IRB140.ik(IRB140.fk(np.full((4, 6), 0.2)))


@pytest.mark.parametrize(
    "call, evidence",
    [
        (lambda: within(IRB140, np.zeros(5)), r"\(5,\)"),
        (lambda: within(IRB140, [0, 0, np.inf, 0, 0, 0]), "inf"),
        (lambda: within("IRB140", np.zeros(6)), "IRB140"),
        (lambda: nearest(IRB140, ROWS[0], np.zeros(5)), r"\(5,\)"),
        (lambda: nearest(IRB140, ROWS, np.zeros((3, 6))), r"\(4, 6\).*\(3, 6\)"),
        (lambda: nearest(IRB140, np.zeros(6), np.zeros(6)), r"\(6,\)"),
        (lambda: nearest(IRB140, ROWS[0], [0, np.nan, 0, 0, 0, 0]), "nan"),
        (lambda: nearest(None, ROWS[0], np.zeros(6)), "None"),
        (lambda: follow(IRB140, ROWS[0], 0), r"\(8, 6\)"),
        (lambda: follow(IRB140, ROWS[:0], 0), r"\(0, 8, 6\)"),
        (lambda: follow(IRB140, ROWS, 8), "0 to 7, got 8"),
        (lambda: follow(IRB140, ROWS, -1), "0 to 7, got -1"),
        (lambda: follow(IRB140, ROWS, (1, 1, -1)), r"\(1, 1, -1\)"),
        (lambda: follow(IRB140, ROWS, 1.0), "1.0"),
        (lambda: follow(IRB140, ROWS[..., :5], 0), r"\(4, 8, 5\)"),
        (lambda: follow(ROWS, IRB140, 0), "Arm"),
        (lambda: explain(IRB140, IRB140.fk(np.zeros((2, 6))), 0), r"\(2,\)"),
        (lambda: explain(IRB140, np.eye(4), 0), r"\(4, 4\)"),
        (lambda: explain(IRB140, IRB140.fk(HOME), 8), "0 to 7, got 8"),
        (lambda: explain(IRB140, IRB140.fk(HOME), 1.5), "1.5"),
        (lambda: explain(IRB140, IRB140.fk(HOME), "front"), "front"),
        (lambda: explain(None, IRB140.fk(HOME), 0), "None"),
    ],
)
def test_errors_name_the_invalid_argument(call, evidence):
    with pytest.raises((ValueError, TypeError), match=evidence):
        call()


def test_follow_keeps_a_blend_on_one_row():
    """Far from all singularities, `follow` returns the row on which it starts, unwrapped."""
    start = Transform(Quaternion.from_angle_axis(90 * deg, (-1, 0, 0)), (0.2, 0.4, 0.2))
    via = Transform(Quaternion.from_angle_axis(45 * deg, (0, 1, 0)), (0.65, -0.1, 0.8))
    goal = Transform(TURNED, (0.3, 0.3, 0.5))
    rows = IRB140.ik(blend(start, via, goal, np.array([[0], [0.1], [0.5]]), np.linspace(0, 1, 301)))
    for corner, row in itertools.product(
        range(3), (IRB140.branch(1, 1, -1), IRB140.branch(1, 1, 1))
    ):
        path = follow(IRB140, rows[corner], row)
        assert turns(path, rows[corner, :, row]).max() < 1e-12
        assert abs(np.diff(path, axis=0)).max() < 0.05


# joint values for display
# --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("arm", [m.arm for m in MACHINES] + [MIXED], ids=lambda arm: arm.name)
def test_representative_is_inside_the_limits_or_closest_to_them(arm):
    """The result equals that of a trial of all whole turns: the value inside the limits that is
    nearest to q, or else the one with the smallest excess.
    """
    rng = np.random.default_rng(31)
    q = rng.uniform(-11, 11, (400, len(arm.links)))
    shown = representative(arm, q)
    for value, given in zip(shown.ravel(), np.ravel(q), strict=True):
        assert abs(np.exp(1j * value) - np.exp(1j * given)) < 1e-13 or value == given
    for row, given in zip(shown, q, strict=True):
        inside = representatives(arm, given)
        for i, (low, high) in enumerate(arm.limits):
            if arm.prismatic[i]:
                assert row[i] == given[i]
            elif inside[i]:
                best = min(abs(v - given[i]) for v in inside[i])
                assert abs(row[i] - given[i]) == pytest.approx(best, abs=1e-12)
            else:
                turns_ = given[i] + 2 * np.pi * np.arange(-4, 5)
                past = np.maximum(turns_ - high, low - turns_)
                assert max(row[i] - high, low - row[i]) == pytest.approx(past.min(), abs=1e-12)


def test_representative_exceeds_a_limit_as_little_as_possible():
    """Lab 02 once showed q3 at -300.5 degrees, 70 degrees beyond its limit, and lab 07 showed q5 at
    259.8, although -100.2 exceeds its limit by only 0.2.
    """
    q = np.zeros(6)
    for k in (-1, 0, 1):
        q[2] = (-300.5 + 360 * k) * deg
        assert representative(IRB140, q)[2] / deg == pytest.approx(59.5)
    q[2] = 0
    for k in (-1, 0, 1):
        q[4] = (259.8 + 360 * k) * deg
        assert representative(PUMA560, q)[4] / deg == pytest.approx(-100.2)
    T = PUMA560.fk([0.1, 0.2, 0.3, 0.4, -100.2 * deg, 0.5])
    rows = PUMA560.ik(T)
    row = int(np.nanargmin(abs(rows - [0.1, 0.2, 0.3, 0.4, -100.2 * deg, 0.5]).max(-1)))
    assert "joint 5 is at -100.2°, 0.2° past its limit of -100°" in explain(PUMA560, T, row)
    assert np.isnan(representative(IRB140, np.full(6, np.nan))).all()


def test_representative_keeps_a_joint_at_its_limit():
    for arm in (IRB140, PUMA560, SCARA):
        for side in (0, 1):
            limit = arm.limits[:, side]
            assert np.allclose(representative(arm, limit), limit, rtol=0, atol=1e-12)


def test_unwrapped_takes_the_nearest_turn_and_does_not_change_prismatic_joints():
    rng = np.random.default_rng(32)
    q, near = rng.uniform(-9, 9, (2, 100, 2))
    got = unwrapped(MIXED, q, near)
    assert (got[:, 1] == q[:, 1]).all()
    assert (abs(got[:, 0] - near[:, 0]) <= np.pi + 1e-12).all()
    assert np.allclose(np.exp(1j * got[:, 0]), np.exp(1j * q[:, 0]))
    with pytest.raises(ValueError, match=r"\(2, 2\).*\(3, 2\)"):
        unwrapped(MIXED, np.zeros((2, 2)), np.zeros((3, 2)))


def test_degrees_cause_a_warning_and_long_motions_do_not():
    with pytest.warns(UserWarning, match="q: 90 rad is many turns; did you mean degrees"):
        within(IRB140, [0, 90, 0, 0, 0, 0])
    with pytest.warns(UserWarning, match="q: 90 rad is many turns"):
        IRB140.frames([0, 90, 0, 0, 0, 0])
    motion = np.linspace(np.zeros(6), np.full(6, 8 * np.pi), 100)  # four turns
    within(IRB140, motion), IRB140.fk(motion)
    SCARA.fk([0.1, 0.2, 0.3, 90])  # 90 is in metres


def test_follow_of_a_batch_matches_single_motions():
    """One motion is singular throughout, one begins late, and one is missing."""
    s = np.linspace(0, 1, 30)[:, None]
    plain = np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]) + 0.5 * s
    stuck = np.array([0.1, 0.2, 0.3, 0.9, 0.0, 0.6]) + [0.5, 0.3, 0.2, 0.4, 0, 0.3] * s
    rows = IRB140.ik(IRB140.fk(np.stack([plain, stuck, stuck, plain])))
    rows[1, :3] = np.nan
    rows[3] = np.nan
    for row in (0, 1):
        together = follow(IRB140, rows, row)
        alone = np.stack([follow(IRB140, track, row) for track in rows])
        np.testing.assert_array_equal(together, alone)
        assert np.isnan(together[1, :3]).all() and np.isfinite(together[:3, 3:]).all()


def test_motion_with_a_missing_start_begins_inside_the_limits():
    """Joint 3 of the IRB-140 can turn to -230 degrees: -200 is inside its limits, although 160, the
    same angle, is not.
    """
    s = np.linspace(0, 1, 20)[:, None]
    q = (np.array([10, 20, -200, 30, 40, 50]) + [5, 5, -5, 5, 5, 5] * s) * deg
    rows = IRB140.ik(IRB140.fk(q))
    row = int(np.nanargmin(gap(IRB140, rows[0], q[0]).max(-1)))
    for missing in (0, 1, 7):
        rows[:missing] = np.nan
        motion = follow(IRB140, rows, row)
        assert np.isnan(motion[:missing]).all()
        np.testing.assert_allclose(motion[missing:], q[missing:], rtol=0, atol=1e-9)
