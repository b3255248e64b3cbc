"""Chains of links: forward kinematics, frames, the Jacobian and the data of an arm."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest
from machines import (
    MACHINES,
    SHAPES,
    UR5,
    UR5_TABLE,
    position_gap,
    random_joints,
    reach,
    rot,
    rotation_gap,
    shift,
)

from robokin import (
    IRB140,
    ITMO6R,
    PUMA560,
    SCARA,
    Arm,
    Link,
    Quaternion,
    ScaraPose,
    Transform,
    deg,
    dh_links,
    linear,
    loader_arm,
    mm,
    spbu_arm,
    spherical_wrist,
    three_lever,
    two_link,
)

RNG = np.random.default_rng(3)
machines = pytest.mark.parametrize("machine", MACHINES, ids=repr)


@machines
@pytest.mark.parametrize("shape", SHAPES)
def test_fk_matches_the_matrix_chain_of_the_document(machine, shape):
    q = random_joints(machine.arm, RNG, shape)
    T = machine.arm.fk(q)
    assert T.shape == shape
    for i in np.ndindex(*shape):
        assert np.allclose(
            T[i].as_matrix() if i else T.as_matrix(), machine.chain(q[i]), rtol=0, atol=4e-15
        )


@machines
def test_fk_at_home_matches_the_matrix_chain(machine):
    n = len(machine.arm.links)
    assert np.allclose(
        machine.arm.fk([0] * n).as_matrix(), machine.chain([0] * n), rtol=0, atol=2e-16
    )


def test_irb140_home_pose_follows_from_its_lengths():
    """The pose is computed by hand from the lengths of listing 1: 70 + 380 + 65 forward and 352 +
    350 up. The flange's z axis points forward.
    """
    T = IRB140.fk(np.zeros(6))
    assert np.allclose(T.translation, [0.515, 0, 0.702], rtol=0, atol=1e-15)
    assert np.allclose(T.rotation @ [0, 0, 1], [1, 0, 0], rtol=0, atol=1e-15)


@machines
@pytest.mark.parametrize("shape", SHAPES)
def test_frames_are_ordered_from_base_to_flange(machine, shape):
    arm = machine.arm
    q = random_joints(arm, RNG, shape)
    frames = arm.frames(q)
    assert frames.shape == (*shape, len(arm.links) + 1)
    assert (frames[..., 0].as_matrix() == np.eye(4)).all()
    assert (frames[..., -1].as_matrix() == arm.fk(q).as_matrix()).all()
    for i in range(len(arm.links)):  # joint i moves the frames after it and no others
        moved = q.copy()
        moved[..., i] += 0.1
        change = abs(arm.frames(moved).as_matrix() - frames.as_matrix()).max((-1, -2))
        assert (change[..., : i + 1] == 0).all() and (change[..., i + 1 :] > 1e-3).all()


@machines
@pytest.mark.parametrize("shape", SHAPES)
def test_jacobian_is_the_derivative_of_fk(machine, shape):
    arm, h = machine.arm, 1e-5
    n = len(arm.links)
    q = random_joints(arm, RNG, shape)
    J = arm.jacobian(q)
    assert J.shape == (*shape, 6, n)
    ahead, back = arm.fk(q[..., None, :] + h * np.eye(n)), arm.fk(q[..., None, :] - h * np.eye(n))
    linear = (ahead.translation - back.translation) / (2 * h)
    # the rotation between the two, in base coordinates
    angle, axis = (ahead.rotation @ back.rotation.inverse()).as_angle_axis()
    angular = axis * angle[..., None] / (2 * h)
    assert np.allclose(J[..., :3, :], np.moveaxis(linear, -2, -1), rtol=0, atol=1e-9)
    assert np.allclose(J[..., 3:, :], np.moveaxis(angular, -2, -1), rtol=0, atol=1e-9)


@machines
def test_jacobian_loses_rank_at_reported_singularities(machine):
    arm = machine.arm
    size = np.array([1 / reach(arm)] * 3 + [1] * 3)[:, None]

    def smallest(q):
        values = np.linalg.svd(arm.jacobian(q) * size, compute_uv=False)
        return values[..., min(len(arm.links), 6) - 1]

    q = random_joints(arm, RNG, (200,))
    near = np.stack(list(arm.geometry.singularities(q).values())).any(axis=0)
    assert not near.any() and (smallest(q) > 1e-8).all()
    if "wrist" in arm.geometry.singularities(q):
        for wrist in (0, np.pi):
            q[:, 4] = wrist
            assert (
                arm.geometry.singularities(q)["wrist"].all() and (smallest(q) < 1e-15 / 1e-2).all()
            )


@machines
def test_nan_joint_value_gives_nan_frames(machine):
    n = len(machine.arm.links)
    q = np.where(np.eye(n, dtype=bool), np.nan, 0.3)  # in row i, the value of joint i is NaN
    frames = machine.arm.frames(q)
    for i in range(n):
        assert np.isfinite(frames.as_matrix()[i, : i + 1]).all()
        assert np.isnan(frames.translation[i, i + 1 :]).any(-1).all()
    flange = machine.arm.fk(q)
    turning = ~machine.arm.prismatic
    assert (
        np.isnan(flange.translation).any(-1).all() and np.isnan(flange.rotation.wxyz[turning]).all()
    )


@machines
def test_branch_flags_are_unique(machine):
    arm = machine.arm
    assert abs(arm.branches).tolist() == np.ones_like(arm.branches).tolist()
    assert len(arm.branches) == 2 ** arm.branches.shape[1]
    for row, flags in enumerate(arm.branches.tolist()):
        assert arm.branch(*flags) == row
    for wrong in ((1,) * (arm.branches.shape[1] + 1), (0,) * arm.branches.shape[1], ()):
        with pytest.raises(ValueError, match="flags"):
            arm.branch(*wrong)


def test_dh_links_equal_the_product_of_four_matrices():
    a, alpha, d, theta, q = RNG.normal(size=(5, 4))
    frame = (1, 0, 0, 0), (0, 0, 0)  # a quaternion and an origin as plain numbers
    for link, q_i in zip(dh_links(a, alpha, d, theta), q, strict=True):
        _, frame = link._carry(frame, q_i)
    m = np.eye(4)
    for i in range(4):
        m = (
            m
            @ rot("z", theta[i] + q[i])
            @ shift(0, 0, d[i])
            @ shift(a[i], 0, 0)
            @ rot("x", alpha[i])
        )
    frame = Transform(Quaternion(frame[0]), frame[1])
    assert np.allclose(frame.as_matrix(), m, rtol=0, atol=1e-14)
    assert all(np.allclose(x.before.as_matrix(), np.eye(4)) for x in dh_links(a, alpha, d))


@pytest.mark.parametrize("modified", [False, True])
def test_both_dh_forms_accept_prismatic_joints(modified):
    """In Craig's form, Rot(x, alpha) Trans(a, 0, 0) belongs to the previous link and comes before
    the joint.
    """
    a, alpha, d, theta, q = RNG.normal(size=(5, 6))
    shifts = [False, True, False, True, True, False]
    links = dh_links(a, alpha, d, theta, prismatic=shifts, modified=modified)
    m = np.eye(4)
    for i, link in enumerate(links):
        assert link.prismatic is shifts[i]
        turn, climb = theta[i] + q[i] * (not shifts[i]), d[i] + q[i] * shifts[i]
        joint = rot("z", turn) @ shift(0, 0, climb)
        way = rot("x", alpha[i]) @ shift(a[i], 0, 0)
        m = m @ way @ joint if modified else m @ joint @ way
    arm = Arm("table", SimpleNamespace(links=links, target=Transform, reach=1.0), [(-9, 9)] * 6)
    assert np.allclose(arm.fk(q).as_matrix(), m, rtol=0, atol=1e-14)


def test_dh_table_of_a_scara_gives_its_forward_kinematics():
    """Two links include a rotation by 180° about x, so the stroke points down and the tool's z axis
    up.
    """
    links = dh_links(
        a=np.array([200, 250, 0, 0]) * mm,
        alpha=np.array([0, 0, 180, 180]) * deg,
        d=np.array([220.2, 0, 0, 0]) * mm,
        prismatic=[False, False, False, True],
    )
    arm = Arm("table", SimpleNamespace(links=links, target=ScaraPose, reach=0.45), SCARA.limits)
    q = random_joints(SCARA, RNG, (50,))
    assert position_gap(arm.fk(q), SCARA.fk(q)).max() < 1e-15
    assert rotation_gap(arm.fk(q), SCARA.fk(q)).max() < 1e-15
    assert np.allclose(arm.jacobian(q), SCARA.jacobian(q), rtol=0, atol=1e-15)


def test_craig_table_of_the_puma_gives_fk_and_ik():
    """The table is from Craig, Introduction to Robotics, figure 3.21 (link parameters of the PUMA
    560), with the catalogue's lengths. Craig's joints 1 and 2 differ from the catalogue's by half a
    turn (his axis 2 points the other way), and his base is at the shoulder; the flange is the same.
    """
    half = 180 * deg
    links = dh_links(
        alpha=np.array([0, -90, 0, -90, 90, -90]) * deg,
        a=np.array([0, 0, 431.8, 20.3, 0, 0]) * mm,
        d=np.array([671.83, 0, 150.05, 431.8, 0, 0]) * mm,
        theta=[half, half, 0, 0, 0, 0],
        modified=True,
    )
    arm = spherical_wrist("Craig's PUMA", links, PUMA560.limits)
    q = random_joints(PUMA560, RNG, (50,))
    assert position_gap(arm.fk(q), PUMA560.fk(q)).max() < 1e-15
    assert rotation_gap(arm.fk(q), PUMA560.fk(q)).max() < 1e-14
    pose = PUMA560.fk(q)
    assert np.allclose(np.sin(arm.ik(pose)), np.sin(PUMA560.ik(pose)), rtol=0, atol=1e-9)


def ur5_chain(q):
    """The product of the six matrices, each written out (Universal Robots' convention)."""
    m = np.eye(4)
    for (a, d, alpha), angle in zip(UR5_TABLE, q, strict=True):
        (c, s), (ca, sa) = (np.cos(angle), np.sin(angle)), (np.cos(alpha), np.sin(alpha))
        m = m @ [
            [c, -s * ca, s * sa, a * c],
            [s, c * ca, -c * sa, a * s],
            [0, sa, ca, d],
            [0, 0, 0, 1],
        ]
    return m


def test_arm_from_links_has_fk_and_jacobian():
    q = RNG.uniform(-np.pi, np.pi, (40, 6))
    flange, J, step = UR5.fk(q).as_matrix(), UR5.jacobian(q), 1e-6
    assert np.allclose(flange, [ur5_chain(one) for one in q], rtol=0, atol=1e-14)
    for j in range(6):
        ahead, behind = (
            np.array([ur5_chain(one + sign * step * np.eye(6)[j]) for one in q]) for sign in (1, -1)
        )
        change = (ahead - behind) / (2 * step)
        assert np.allclose(J[:, :3, j], change[:, :3, 3], rtol=0, atol=1e-9)
        spin = change[:, :3, :3] @ flange[:, :3, :3].mT
        turns = np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], axis=-1)
        assert np.allclose(J[:, 3:, j], turns, rtol=0, atol=1e-9)


def test_reach_of_a_chain_is_an_upper_bound():
    upright = Transform(Quaternion.from_angle_axis(90 * deg, (1, 0, 0)))
    slide = Link(upright, after=Transform(translation=(0.1, 0, 0)), prismatic=True)
    crooked = [Link(slide.after, (0.6, 0, 0.8), upright), slide, Link(after=slide.after), slide]
    for links, limits in (
        (IRB140.links, IRB140.limits),
        (SCARA.links, SCARA.limits),
        (UR5.links, UR5.limits),
        (crooked, [(-3, 3), (-0.5, 0.2), (-3, 3), (0.1, 0.3)]),
        ([slide] * 3, [(-0.5, 0.2)] * 3),
        ([slide], [(-0.5, 0.2)]),
    ):
        arm = Arm("links", links, limits)
        q = RNG.uniform(*arm.limits.T, (2000, len(arm.links)))
        flange, joint = arm.fk(q).translation, links[0].before
        beside = flange - joint.translation
        if not links[0].prismatic:  # for a revolute joint, only the distance from its axis counts
            axis = joint.rotation @ links[0].axis
            beside = beside - (beside @ axis)[:, None] * axis
        farthest = np.linalg.norm(beside, axis=-1).max()
        assert 0.4 * arm.reach < farthest <= arm.reach + 1e-12
    longer = dataclasses.replace(arm, limits=[(-0.9, 0.2)])
    assert longer.reach == pytest.approx(1.0) and arm.reach == pytest.approx(0.6)


def test_error_for_a_missing_inverse_says_what_to_use_instead():
    for arm, others in ((UR5, ""), (three_lever(0.4), "alpha_range, family, ")):
        for name in ("ik", "branch", "branches"):
            assert not hasattr(arm, name)
            has = f"{others}fk, frames, jacobian"
            words = f"{arm.name} has no closed-form inverse and therefore no {name}; it has {has}"
            with pytest.raises(AttributeError, match=words):
                getattr(arm, name)
    with pytest.raises(AttributeError, match="'Arm' object has no attribute 'anything'"):
        UR5.anything  # noqa: B018
    with pytest.raises(TypeError, match="geometry with links, target, reach, branches.*Chain"):
        type(IRB140)("no inverse", UR5.links, UR5.limits)


def test_prismatic_joint_moves_along_its_axis():
    link = Link(
        Transform(Quaternion.from_angle_axis(90 * deg, (0, 0, 1)), (1, 0, 0)),
        (1, 0, 0),
        prismatic=True,
    )
    arm = Arm("slide", SimpleNamespace(links=(link,), target=Transform, reach=1.0), [(0, 1)])
    assert np.allclose(arm.fk([0.3]).translation, [1, 0.3, 0], rtol=0, atol=1e-16)
    assert np.allclose(arm.jacobian([0.3])[:, 0], [0, 1, 0, 0, 0, 0], rtol=0, atol=1e-15)
    assert arm.prismatic.tolist() == [True]


def test_whole_turns_do_not_change_fk():
    q = RNG.uniform(-np.pi, np.pi, (50, 6))
    with pytest.warns(UserWarning, match="q: .* rad is many turns; did you mean degrees"):
        a, b = IRB140.fk(q), IRB140.fk(q + 2 * np.pi * RNG.integers(-9, 10, q.shape))
    assert rotation_gap(a, b).max() < 1e-13 and position_gap(a, b).max() < 1e-13


# The limits and speeds of the robots as printed in their sources, in degrees and millimetres.
PUBLISHED = {
    "IRB-140": (  # 001, listing 7; the speeds are our choice, below those of public models
        IRB140,
        [(-180, 180), (-90, 110), (-230, 50), (-200, 200), (-115, 115), (-400, 400)],
        [200, 200, 245, 348, 360, 450],
    ),
    "SCARA": (SCARA, [(-140, 140), (-150, 150), (-400, 400), (0, 180)], None),  # listings 4, 12
    "PUMA 560": (  # Corke's model
        PUMA560,
        [(-160, 160), (-45, 225), (-225, 45), (-110, 170), (-100, 100), (-266, 266)],
        None,
    ),
    "DH arm (004)": (ITMO6R, [(-360, 360)] * 6, None),
    "Arm (000)": (spbu_arm(5, 4), [(-180, 180), (-90, 90), (-90, 90)], None),
    "Log loader": (loader_arm(1.2, 1.0), [(-180, 180), (0, 270), (0, 180)], None),
    "Three levers": (three_lever(0.4), [(0, 180)] * 3, None),
    "Two links": (two_link(0.4, 0.3), [(-180, 180)] * 2, None),
}


@pytest.mark.parametrize("name", PUBLISHED)
def test_limits_and_speeds_match_the_published_values(name):
    arm, limits, speeds = PUBLISHED[name]
    units = np.where(arm.prismatic, mm, deg)[:, None]
    assert arm.name == name
    assert np.allclose(arm.limits / units, limits, rtol=0, atol=1e-9)
    if speeds is None:
        assert arm.speed_limits is None
    else:
        assert np.allclose(arm.speed_limits / deg, speeds, rtol=0, atol=1e-9)


def test_arms_with_equal_parts_are_not_equal():
    """Arms, links and poses are compared by identity, because comparing two arrays does not give a
    single truth value.
    """
    for a, b in (
        (Link(), Link()),
        (Transform(), Transform()),
        (Quaternion.identity(), Quaternion.identity()),
        (ScaraPose((0, 0, 0)), ScaraPose((0, 0, 0))),
        (two_link(1, 1), two_link(1, 1)),
        (linear(2.0), linear(2.0)),
        (dataclasses.replace(IRB140), IRB140),
    ):
        assert (a == b) is False and a == a and len({a, b, a}) == 2
        for change in ("anything", *vars(a)):
            with pytest.raises(AttributeError):
                setattr(a, change, 1)
            with pytest.raises(AttributeError):
                delattr(a, change)


def test_repr_of_an_arm_shows_its_name():
    assert repr(IRB140) == "Arm('IRB-140', 6 joints)"
    assert repr(three_lever(1)) == "Arm('Three levers', 3 joints)"
