"""The inverse kinematics of every arm in the catalogue: no row is wrong, no row is missing, and
every row is in its place.
"""

import dataclasses

import numpy as np
import pytest
from machines import (
    MACHINES,
    SHAPES,
    SIX,
    gap,
    oracle,
    position_gap,
    random_joints,
    reach,
    rotation_gap,
    transform,
    turns,
)

from robokin import (
    IRB140,
    ITMO6R,
    PUMA560,
    Link,
    Quaternion,
    Transform,
    deg,
    dh_links,
    itmo_arm,
    mm,
    spherical_wrist,
)

machines = pytest.mark.parametrize("machine", MACHINES, ids=repr)
six = pytest.mark.parametrize("machine", SIX, ids=repr)


def solved(arm, T, rows):
    """Check that every existing row reaches the pose within 1e-12 of the reach, and that the other
    rows are NaN throughout.

    Return which rows exist.
    """
    exists = np.isfinite(rows).all(axis=-1)
    assert (exists == np.isfinite(rows).any(axis=-1)).all()
    back = arm.fk(np.where(exists[..., None], rows, 0))
    assert position_gap(back, T[..., None])[exists].max(initial=0) < 1e-12 * reach(arm)
    assert rotation_gap(back, T[..., None])[exists].max(initial=0) < 1e-12
    assert (abs(rows[exists][:, ~arm.prismatic]) <= np.pi).all()
    return exists


def expected(machine, T):
    """Which rows must exist, as booleans (..., 8) found from distances alone, and how far the pose
    is from the limit at which each row stops existing.
    """
    w = machine.wrist
    centre = T.translation - w["tool"] * T.rotation.as_matrix()[..., 2]
    out2 = centre[..., 0] ** 2 + centre[..., 1] ** 2 - w["lateral"] ** 2
    exists, margin = [], []
    for front, _, _ in machine.arm.branches:
        ahead = front * np.sqrt(np.where(out2 >= 0, out2, np.nan)) - w["shoulder"][0]
        d = np.hypot(ahead, centre[..., 2] - w["shoulder"][1])
        exists.append((d <= w["upper"] + w["fore"]) & (d >= abs(w["upper"] - w["fore"])))
        edges = np.stack(
            [abs(d - w["upper"] - w["fore"]), abs(d - abs(w["upper"] - w["fore"])), abs(out2)]
        )
        margin.append(np.nanmin(np.where(np.isnan(edges), abs(out2), edges), axis=0))
    return np.stack(exists, axis=-1), np.stack(margin, axis=-1)


def flags(machine, q):
    """The configuration of q according to the documents' own rules, from frames and signs."""
    arm = machine.arm
    frames = arm.frames(q)
    centre = (
        frames.translation[..., -1, :]
        - machine.wrist["tool"] * frames.rotation.as_matrix()[..., -1, :, 2]
    )
    turn = q[..., 0]
    front = centre[..., 0] * np.cos(turn) + centre[..., 1] * np.sin(turn)
    bend = {
        "IRB-140": np.cos(q[..., 2]),
        "PUMA 560": np.sin(q[..., 2] + np.arctan2(0.4318, 0.0203)),
        "DH arm (004)": np.sin(q[..., 2]),
    }[arm.name]
    return np.stack([front, bend, q[..., 4]], axis=-1)


@machines
def test_20000_random_poses_have_exactly_the_expected_rows(machine):
    arm = machine.arm
    q = random_joints(arm, np.random.default_rng(4), (20_000,))
    T = arm.fk(q)
    rows = arm.ik(T)
    assert rows.shape == (20_000, len(arm.branches), len(arm.links))
    exists = solved(arm, T, rows)
    drawn = gap(arm, rows, q[:, None]).max(axis=-1)
    # near a singularity a joint value is less accurate
    assert np.nanmin(drawn, axis=1).max() < 1e-7
    assert np.median(np.nanmin(drawn, axis=1)) < 1e-14
    if machine.wrist:
        wanted, margin = expected(machine, T)
        assert (exists == wanted)[margin > 1e-12].all()
        assert (np.sign(flags(machine, rows)) == arm.branches)[exists].all()
        assert 4 * 20_000 < exists.sum() <= 8 * 20_000


@six
def test_poses_moved_out_of_the_workspace_lose_their_rows(machine):
    arm = machine.arm
    rng = np.random.default_rng(5)
    T = arm.fk(random_joints(arm, rng, (5000,)))
    T = Transform(T.rotation, T.translation + rng.normal(size=(5000, 3)) * reach(arm))
    rows = arm.ik(T)
    exists = solved(arm, T, rows)
    wanted, margin = expected(machine, T)
    assert (exists == wanted)[margin > 1e-12].all()
    assert (
        0.02 < exists.any(-1).mean() < 0.9
        and not exists[np.linalg.norm(T.translation, axis=-1) > reach(arm)].any()
    )


@machines
@pytest.mark.parametrize("shape", SHAPES + [(0,), (2, 0)])
def test_every_batch_shape_gives_the_same_rows_as_single_poses(machine, shape):
    arm = machine.arm
    q = random_joints(arm, np.random.default_rng(6), shape)
    T = arm.fk(q)
    rows = arm.ik(T)
    assert rows.shape == (*shape, len(arm.branches), len(arm.links))
    for i in np.ndindex(*shape):
        one = arm.ik(T[i] if i else T)
        assert np.allclose(rows[i], one, rtol=0, atol=1e-13, equal_nan=True)
        assert np.nanmin(gap(arm, one, q[i]).max(-1)) < 1e-9


def test_a_long_batch_gives_the_same_rows_as_short_batches():
    T = IRB140.fk(random_joints(IRB140, np.random.default_rng(7), (5001,)))
    rows = IRB140.ik(T)
    for block in (slice(0, 7), slice(2040, 2060), slice(4090, 4100), slice(4995, 5001)):
        assert np.allclose(rows[block], IRB140.ik(T[block]), rtol=0, atol=1e-13, equal_nan=True)


@six
@pytest.mark.parametrize("bend", [0.0, 1e-12, 1e-9, 1e-6, np.pi, np.pi - 1e-9, -np.pi, -1e-9])
def test_rows_at_wrist_singular_poses_are_correct(machine, bend):
    """The whole orientation is correct, and only q4 + q6 (q4 - q6 at pi) is determined. Errata
    S1-d.
    """
    arm = machine.arm
    q = random_joints(arm, np.random.default_rng(8), (500,))
    q[:, 4] = bend
    T = arm.fk(q)
    rows = arm.ik(T)
    exists = solved(arm, T, rows)
    wanted, margin = expected(machine, T)
    assert (exists == wanted)[margin > 1e-12].all()
    same = np.nanargmin(
        gap(arm, rows, q[:, None])[..., :3].max(-1) + gap(arm, rows, q[:, None])[..., 4], axis=1
    )
    row = rows[np.arange(500), same]
    assert turns(row[:, [0, 1, 2, 4]], q[:, [0, 1, 2, 4]]).max() < 1e-8
    spin = arm.jacobian(q)[:, 3:]
    # axes 4 and 6 point in the same or in opposite directions
    sense = np.sign((spin[..., 3] * spin[..., 5]).sum(-1))
    fixed = row[:, 3] - q[:, 3] + sense * (row[:, 5] - q[:, 5])
    assert turns(fixed, 0).max() < 1e-8
    if bend in (0, np.pi, -np.pi):
        # Joint 4 is free and 0 by convention. Near stretched postures, rounding the pose is
        # enough to bend the wrist.
        assert (row[:, 3] == 0).mean() > 0.98
        assert turns(row[:, 4], bend).max() < 1e-8
        assert (exists.sum(1) % 4 == 0).all()  # both wrist rows exist, although they coincide
        settled = arm.geometry.choose_free_joints(row, q)
        assert np.quantile(turns(settled, q).max(-1), 0.995) < 1e-8
        assert rotation_gap(arm.fk(settled), T).max() < 1e-9
    elif abs(np.sin(bend)) >= 1e-9:
        assert np.quantile(turns(row, q).max(-1), 0.98) < 1e-13 / abs(np.sin(bend))


@six
def test_home_pose_has_all_its_rows(machine):
    arm = machine.arm
    T = arm.fk(np.zeros(6))
    rows = arm.ik(T)
    exists = solved(arm, T, rows)
    # in its home posture the ITMO6R is fully extended, which is tested below
    assert (exists == expected(machine, T)[0]).all() or arm is ITMO6R
    assert abs(rows[exists]).max(-1).min() < 1e-7


def test_the_irb140_has_eight_rows_at_home_seven_of_them_different():
    rows = IRB140.ik(IRB140.fk(np.zeros(6)))
    assert np.isfinite(rows).all()
    different = {tuple(np.round(np.cos(q), 6)) + tuple(np.round(np.sin(q), 6) + 0.0) for q in rows}
    assert len(different) == 7


def stretched(machine, count, rng, folded=False):
    """Postures in which the forearm is in line with the upper arm or folded back onto it."""
    q = random_joints(machine.arm, rng, (count,))
    line = {"IRB-140": np.pi / 2, "PUMA 560": -np.arctan2(0.4318, 0.0203), "DH arm (004)": 0.0}[
        machine.arm.name
    ]
    q[:, 2] = line + (np.pi if folded else 0)
    return q


@six
@pytest.mark.parametrize("folded", [False, True])
def test_stretched_and_folded_postures_are_reachable(machine, folded):
    """A cosine that is larger than 1 because of rounding counts as 1. The two elbow rows coincide,
    and both exist.
    """
    arm = machine.arm
    if arm is IRB140:
        folded = not folded  # at q3 = 90 degrees the forearm points back along the upper arm
    q = stretched(machine, 500, np.random.default_rng(9), folded)
    T = arm.fk(q)
    rows = arm.ik(T)
    exists = solved(arm, T, rows)
    drawn = gap(arm, rows, q[:, None]).max(axis=-1)
    # The PUMA's links differ by half a millimetre, so joint 2 is inaccurate when the arm is folded.
    atol = 1e-6 if abs(machine.wrist["upper"] - machine.wrist["fore"]) > 0.01 else 0.01
    assert np.nanmin(drawn, axis=1).max() < atol
    own = np.nanargmin(drawn, axis=1)
    assert exists[np.arange(500), own].all() and exists[np.arange(500), own ^ 2].all()
    assert gap(arm, rows[np.arange(500), own], rows[np.arange(500), own ^ 2]).max() < atol


@six
def test_pose_slightly_beyond_the_stretched_arm_is_out_of_reach(machine):
    """A pose is out of reach if it is 1e-9 of the reach beyond the limit, and within reach if it is
    1e-9 of the reach inside the limit.
    """
    arm, w = machine.arm, machine.wrist
    q = stretched(machine, 200, np.random.default_rng(10), folded=arm is IRB140)
    T = arm.fk(q)
    frame = arm.frames(q)[:, 1]
    centre = T.translation - w["tool"] * T.rotation.as_matrix()[..., 2]
    shoulder = frame @ np.array([w["shoulder"][0], 0, 0])
    side = frame.rotation @ (Y if arm is IRB140 else Z)  # along axis 2
    line = centre - shoulder
    line -= (line * side).sum(-1, keepdims=True) * side
    line /= np.linalg.norm(line, axis=-1, keepdims=True)
    own = np.nanargmin(gap(arm, arm.ik(T), q[:, None]).max(-1), axis=1)
    for step, there in ((1e-9, False), (-1e-9, True)):
        moved = Transform(T.rotation, T.translation + step * reach(arm) * line)
        exists = solved(arm, moved, arm.ik(moved))
        assert (exists[np.arange(200), own] == there).all()


def test_printed_inverse_is_wrong_within_148_mm_of_the_shoulder_and_ours_is_correct():
    """Errata S1-c: the printed arcsine loses the obtuse shoulder angle exactly where d < sqrt(l3^2
    - l2^2) = 147.986 mm.
    """
    edge = np.sqrt(0.38**2 - 0.35**2)
    assert abs(edge / mm - 147.986485869) < 1e-9
    rng = np.random.default_rng(11)
    q = random_joints(IRB140, rng, (20_000,))
    q[:, 2] = np.pi / 2 + rng.uniform(-0.6, 0.6, 20_000)  # the forearm is folded back
    centre = (IRB140.frames(q)[:, 4]).translation
    rho = np.hypot(centre[:, 0], centre[:, 1])
    front = np.where(centre[:, 0] * np.cos(q[:, 0]) + centre[:, 1] * np.sin(q[:, 0]) > 0, 1, -1)
    d = np.hypot(rho - front * 0.07, centre[:, 2] - 0.352)
    near = d < edge
    assert 1000 < near.sum() < 19_000
    T = IRB140.fk(q)
    rows = IRB140.ik(T)
    solved(IRB140, T, rows)
    assert np.nanmin(gap(IRB140, rows, q[:, None]).max(-1), axis=1).max() < 1e-7
    # The formula of listing 1, with the names of its variables:
    triangle_angle = np.arcsin(np.clip(0.38 * front * np.sin(q[:, 2] - np.pi / 2) / d, -1, 1))
    lift_angle = np.arctan2(centre[:, 2] - 0.352, rho - front * 0.07)
    printed = -front * (np.pi / 2 + triangle_angle - lift_angle)
    wrong = turns(printed, q[:, 1]) > 1e-4
    clear = abs(d - edge) > 1e-4
    assert (wrong == near)[clear].all()
    there = IRB140.frames(np.column_stack([q[:, 0], printed, q[:, 2:]]))[:, 4].translation
    # the errata say "by up to 60.0 mm"
    assert 0.055 < np.linalg.norm(there - centre, axis=-1).max() < 0.0601


@pytest.mark.parametrize("machine", [m for m in SIX if not m.wrist["lateral"]], ids=repr)
def test_joint_1_is_free_at_shoulder_singular_poses(machine):
    """The arm has no lateral offset, and the wrist centre is on axis 1: joint 1 is 0 in the front
    rows and pi in the back rows.
    """
    arm, w = machine.arm, machine.wrist
    rng = np.random.default_rng(12)
    height = w["shoulder"][1] + rng.uniform(0.3, 0.95, 300) * (w["upper"] + w["fore"])
    rotation = Quaternion.from_angle_axis(rng.uniform(-3, 3, 300), _unit(rng.normal(size=(300, 3))))
    tool = rotation @ np.array([0, 0, w["tool"]])
    for off in (0, 1e-17, 1e-14, 1e-9):
        centre = np.stack([off * np.cos(height * 1e3), off * np.sin(height * 1e3), height], axis=-1)
        T = Transform(rotation, centre + tool)
        rows = arm.ik(T)
        exists = solved(arm, T, rows)
        wanted, margin = expected(machine, T)
        assert (exists == wanted)[margin > 1e-12].all() and exists.any(-1).mean() > 0.5
        if off <= 1e-17:
            front = np.where(arm.branches[:, 0] > 0, 0, np.pi)
            assert turns(rows[..., 0], front)[exists].max() < 1e-15
            assert (rows[..., 0][exists] == np.broadcast_to(front, exists.shape)[exists]).all()


def test_the_pumas_front_and_back_rows_coincide_at_distance_d3_from_axis_1():
    """The PUMA's wrist centre cannot come nearer to axis 1 than d3; at that distance the front and
    back rows coincide.
    """
    rng = np.random.default_rng(13)
    d3 = 0.15005
    azimuth, z = rng.uniform(-np.pi, np.pi, 300), 0.67183 + rng.uniform(-0.8, 0.8, 300)
    rotation = Quaternion.from_angle_axis(rng.uniform(-3, 3, 300), _unit(rng.normal(size=(300, 3))))

    def at(radius):
        T = Transform(
            rotation, np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth), z], axis=-1)
        )
        return T, PUMA560.ik(T)

    T, rows = at(d3)
    exists = solved(PUMA560, T, rows)
    assert exists[:, 0].mean() > 0.8
    for front in range(4):
        both = exists[:, front]
        assert (both == exists[:, front + 4]).all()
        assert turns(rows[both, front, 0], rows[both, front + 4, 0]).max() < 1e-6
        assert turns(rows[both, front], rows[both, front + 4]).max(-1).max() < 1e-3
    T, rows = at(d3 * (1 + 1e-6))
    assert solved(PUMA560, T, rows)[:, 0].mean() > 0.8
    T, rows = at(d3 * (1 - 1e-9))
    assert np.isnan(rows).all()
    T, rows = at(0.0)
    assert np.isnan(rows).all()


@six
def test_poses_at_limits_and_at_whole_turns_have_all_their_rows(machine):
    arm = machine.arm
    rng = np.random.default_rng(14)
    q = rng.uniform(arm.limits[:, 0], arm.limits[:, 1], (1200, 6))
    joint = np.arange(1200) % 6
    q[np.arange(1200), joint] = arm.limits[joint, rng.integers(0, 2, 1200)]
    q[:100, 0] = rng.choice([-np.pi, np.pi], 100)
    T = arm.fk(q)
    rows = arm.ik(T)
    solved(arm, T, rows)
    # for one arm the limit of joint 5 is a wrist singularity
    rows = arm.geometry.choose_free_joints(rows, q[:, None] + 0 * rows)
    assert np.nanmin(gap(arm, rows, q[:, None]).max(-1), axis=1).max() < 1e-7


def test_joint_2_is_free_where_equal_levers_fold_onto_the_shoulder():
    """The wrist centre is at joint 2, which only equal links can reach: joint 2 is free, and no row
    is partly NaN.
    """
    arm = itmo_arm(0.1, 0.2, 0.2, 0.05)
    q = random_joints(arm, np.random.default_rng(15), (200,))
    q[:, 2] = np.pi
    T = arm.fk(q)
    rows = arm.ik(T)
    assert solved(arm, T, rows).all()


@machines
def test_negative_zero_in_a_pose_gives_finite_rows(machine):
    """-0.0 and +0.0 in a pose are the same position."""
    arm = machine.arm
    T = arm.fk(np.zeros(len(arm.links)))
    for sign in (0.0, -0.0):
        moved = Transform(T.rotation, np.where(abs(T.translation) < 1e-12, sign, T.translation))
        rows = arm.ik(moved)
        exists = solved(arm, moved, rows)
        assert exists.any()
        assert np.nanmin(gap(arm, rows, 0 * rows[0]).max(-1)) < 1e-7


# Reference cases
# --------------------------------------------------------------------------------------------------


def compare(arm, case, unit=1.0):
    """Check a reference case: exactly the rows of the case exist, in the places given by their
    flags.
    """
    T = transform(case["T"], unit)
    rows = arm.ik(T)
    exists = solved(arm, T, rows)
    assert exists.any() == case["reachable"]
    singular = any(case["singular"].values())
    atol = 1e-4 if singular or "near" in case["kind"] else 1e-6
    wanted = np.array([s["q"] for s in case["solutions"]]).reshape(-1, 6)
    off = turns(rows[exists][:, None], wanted).max(axis=-1)  # (existing rows, solutions)
    assert (off.min(axis=0, initial=9) < atol).all() and (off.min(axis=1, initial=9) < atol).all()
    if not singular:
        places = [arm.branch(*s["flags"]) for s in case["solutions"]]
        assert sorted(places) == np.flatnonzero(exists).tolist()
        for place, q in zip(places, wanted, strict=True):
            assert turns(rows[place], q).max() < atol
    else:  # a solution that belongs to several rows is in all of them
        for shoulder, elbow, _ in {tuple(arm.branches[i]) for i in np.flatnonzero(exists)}:
            assert exists[[arm.branch(shoulder, elbow, 1), arm.branch(shoulder, elbow, -1)]].all()
    return rows


CASES = [(PUMA560, case, 1.0) for case in oracle("puma560")["cases"]]
for case in oracle("itmo6r")["cases"]:
    CASES.append((itmo_arm(**case["params"]), case, 1.0))


@pytest.mark.parametrize(
    "arm, case, unit",
    CASES,
    ids=[f"{arm.name}-{i}-{case['kind']}" for i, (arm, case, _) in enumerate(CASES)],
)
def test_rows_match_the_reference_case(arm, case, unit):
    compare(arm, case, unit)


# Chains with and without a spherical wrist
# -------------------------------------------------------------------------------------------------


def changed(number, **parts):
    links = list(IRB140.links)
    links[number - 1] = dataclasses.replace(links[number - 1], **parts)
    return links


def at(x, y, z):
    return Transform(translation=(x, y, z))


X, Y, Z = np.eye(3)


@pytest.mark.parametrize(
    "links, message",
    [
        (IRB140.links[:5], "six revolute links"),
        (changed(3, prismatic=True), "six revolute links"),
        (changed(1, axis=X), "axis 1 parallel to z"),
        (changed(1, before=at(0.01, 0, 0.352)), "axis 1 through the origin"),
        (changed(2, axis=X), "axis 2 parallel to y"),
        (changed(3, axis=Z), "axis 3 parallel to y"),
        (changed(4, axis=Y), "axis 4 perpendicular"),
        (changed(4, axis=-Y), "axis 4 perpendicular"),
        (changed(5, axis=Z), "axis 5 parallel to y"),
        (changed(5, before=at(0, 0, 0.01)), "axis 5 through"),
        (changed(6, axis=Z), "axis 6 parallel to axis 4"),
        (changed(6, before=at(0.065, 0.01, 0)), "axis 6 through"),
        (changed(3, before=at(0, 0, 0)), "upper arm"),
        (changed(4, before=at(0, 0, 0)), "forearm"),
    ],
)
def test_unsuitable_chains_are_refused_and_the_axis_is_named(links, message):
    with pytest.raises(ValueError, match=f"links: wanted.*{message}"):
        spherical_wrist("crooked", links, np.array([(-180, 180)] * len(links)) * deg)


def random_arm(rng):
    """A random six-axis arm with signs, offsets and a tool that `spherical_wrist` must accept."""
    sign = rng.choice([-1.0, 1.0], 6)
    lateral = rng.choice([0.0, 0.12, -0.2])
    heel, bow = rng.choice([0.0, 0.05, -0.04], 2)
    # axis 4 in the home posture
    along = np.array([np.cos(tilt := rng.choice([0.0, np.pi / 2, 0.4])), 0, -np.sin(tilt)])
    fore = np.array([bow, 0, 0.05]) + 0.3 * along
    split = rng.uniform(-0.1, 0.1)
    turn = Quaternion.from_angle_axis(rng.uniform(-3, 3), _unit(rng.normal(size=3)))
    tool = Transform(turn, rng.normal(size=3) * 0.1)
    return spherical_wrist(
        "any",
        (
            Link(at(0, 0, 0.3), sign[0] * Z),
            Link(at(rng.choice([0.0, 0.07, -0.1]), 0.6 * lateral, 0.05), sign[1] * Y),
            Link(at(heel, 0, 0.35), sign[2] * Y),
            Link(Transform(translation=fore - split * along + 0.4 * lateral * Y), sign[3] * along),
            Link(Transform(translation=split * along), sign[4] * Y),
            Link(Transform(translation=0.05 * along), sign[5] * along, after=tool),
        ),
        np.array([(-180, 180)] * 6) * deg,
    )


@pytest.mark.parametrize("seed", range(40))
def test_every_suitable_chain_is_inverted(seed):
    """The arms differ in signs, offsets, bend of the forearm, tilt of the wrist and tool."""
    rng = np.random.default_rng(seed)
    arm = random_arm(rng)
    q = rng.uniform(-np.pi, np.pi, (200, 6))
    T = arm.fk(q)
    rows = arm.ik(T)
    exists = solved(arm, T, rows)
    assert np.nanmin(turns(rows, q[:, None]).max(-1), axis=1).max() < 1e-8
    assert (np.sign(rows[..., 4]) == arm.branches[:, 2])[exists].all()
    q[:, 4] = rng.choice([0, np.pi], 200)
    T = arm.fk(q)
    rows = arm.ik(T)
    assert solved(arm, T, rows).any(-1).all()
    settled = arm.geometry.choose_free_joints(rows, np.broadcast_to(q[:, None], rows.shape))
    assert np.nanmin(turns(settled, q[:, None]).max(-1), axis=1).max() < 1e-8
    T = Transform(T.rotation, T.translation + rng.normal(size=(200, 3)) * 0.3)
    solved(arm, T, arm.ik(T))


def test_dh_table_and_links_give_the_same_arm():
    links = dh_links(
        a=[0, 0.1, 0, 0, 0, 0],
        alpha=np.array([90, 0, 90, -90, 90, 0]) * deg,
        d=[0.1, 0, 0, 0.2, 0, 0.2],
        theta=np.array([0, 0, 90, 0, 0, 0]) * deg,
    )
    arm = spherical_wrist("the same", links, ITMO6R.limits)
    T = ITMO6R.fk(random_joints(ITMO6R, np.random.default_rng(16), (20,)))
    assert np.array_equal(arm.ik(T), ITMO6R.ik(T), equal_nan=True)


def _unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def test_each_singularity_depends_on_its_own_joints():
    """The wrist singularity depends only on joint 5, that of the elbow on joint 3, and that of the
    shoulder on joints 2 and 3.
    """
    stretched = -90 * deg  # the forearm of the IRB-140 points straight up
    for q, wanted in (
        ([0.3, 0.2, 0.4, 0.5, 0.0, 0.7], {"wrist"}),
        ([0.3, 0.2, 0.4, 0.5, np.pi, 0.7], {"wrist"}),
        ([0.0, 0.2, 0.4, 0.0, 0.6, 0.0], set()),
        ([0.3, 0.2, stretched, 0.5, 0.6, 0.7], {"elbow"}),
        ([0.3, 0.2, stretched, 0.5, -5e-7, 0.7], {"elbow", "wrist"}),
        ([0.3, 0.2, 0.4, 0.5, -0.6, 0.7], set()),
        ([0.3, 0.2, 0.4, 0.5, -2e-6, 0.7], set()),
    ):
        held = IRB140.geometry.singularities(np.array(q))
        assert {name for name, holds in held.items() if holds} == wanted, q
    # The wrist centre is on axis 1: the offset of 70 mm and the horizontal parts of the upper arm
    # and the forearm cancel.
    q2 = np.arcsin(0.07 / 0.35)
    q = np.array([0.5, q2, q2 - 90 * deg, 0.4, 0.6, 0.1])
    centre = IRB140.frames(q)[4].translation
    assert np.hypot(*centre[:2]) < 1e-12
    assert IRB140.geometry.singularities(q)["shoulder"]
