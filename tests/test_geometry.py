"""Geometries: links and inverse come from the same lengths, one tolerance applies everywhere, and
each reason has an explanation.
"""

import dataclasses

import numpy as np
import pytest
from machines import MACHINES, turns

from robokin import (
    IRB140,
    PUMA560,
    SCARA,
    Arm,
    Link,
    Quaternion,
    ScaraPose,
    Transform,
    deg,
    explain,
    itmo_arm,
    loader_arm,
    mm,
    scara_arm,
    spbu_arm,
    three_lever,
    two_link,
)
from robokin.arms.explanations import SENTENCES
from robokin.arms.geometry import Gap, distance, two_levers
from robokin.arms.spherical_wrist import SphericalWristGeometry
from robokin.units import in_words, length_unit, wrapped

TURN = 2 * np.pi


def arms_of(rng):
    """One arm of every geometry with random lengths; the limits do not matter here."""
    a, b, c, d = rng.uniform(0.1, 2.0, 4)
    return [
        two_link(a, b, rng.normal(size=2)),
        scara_arm("any", rng.normal(), a, b, [(-3, 3)] * 3 + [(0, 1)]),
        spbu_arm(a, b),
        loader_arm(a, b),
        itmo_arm(a, b, c, d),
        two_link(a, a),
        scara_arm("equal", c, a, a, [(-3, 3)] * 3 + [(0, 1)]),
        loader_arm(a, a),
        itmo_arm(a, b, b, d),
    ]


@pytest.mark.parametrize("seed", range(12))
def test_ik_and_fk_agree_for_links_of_any_lengths(seed):
    """Closed-form inverses agree with their chain: every row leads back to the pose, and the
    original posture is one of the rows.
    """
    rng = np.random.default_rng(seed)
    for arm in arms_of(rng):
        q = rng.uniform(-np.pi, np.pi, (40, len(arm.links)))
        T = arm.fk(q)
        rows = arm.ik(T)
        exists = ~np.isnan(rows).any(-1)
        assert exists.any(-1).all()
        back = arm.fk(rows)
        far = np.linalg.norm(back.translation - T.translation[:, None], axis=-1)
        assert far[exists].max() < 1e-12
        away = abs(wrapped(rows - q[:, None]))
        away[..., arm.prismatic] = abs(rows - q[:, None])[..., arm.prismatic]
        assert np.nanmin(away.max(-1), axis=1).max() < 1e-6
        assert np.isnan(rows).any(-1).tolist() == np.isnan(rows).all(-1).tolist()


def test_links_cannot_change_without_the_inverse():
    links = list(IRB140.links)
    links[2] = dataclasses.replace(links[2], before=Transform(translation=(0, 0, 498 * mm)))
    with pytest.raises(TypeError, match="links"):
        dataclasses.replace(IRB140, links=tuple(links))
    with pytest.raises(AttributeError):
        IRB140.geometry.links = tuple(links)
    longer = dataclasses.replace(IRB140, geometry=SphericalWristGeometry(links))
    q = np.array([0.3, -0.4, 0.5, 1.0, 0.7, -0.2])
    assert np.linalg.norm(longer.fk(q).translation - IRB140.fk(q).translation) > 0.1
    rows = longer.ik(longer.fk(q))
    assert turns(rows, q).max(-1).min() < 1e-12
    assert longer.limits.tolist() == IRB140.limits.tolist() and longer.name == "IRB-140"


@pytest.mark.parametrize("machine", MACHINES, ids=repr)
def test_arm_target_is_the_type_of_its_poses(machine):
    arm = machine.arm
    pose = arm.fk(np.full(len(arm.links), 0.2))
    asked = {
        Transform: pose,
        np.ndarray: pose.translation,
        ScaraPose: ScaraPose(pose.translation, 0.6),
    }[arm.target]
    assert isinstance(asked, arm.target) and not np.isnan(arm.ik(asked)).all()
    assert np.allclose(arm.ik(asked), arm.ik(pose), rtol=0, atol=1e-9, equal_nan=True)
    assert arm.target is arm.geometry.target and arm.links is arm.geometry.links


@pytest.mark.parametrize(
    "arm", [m.arm for m in MACHINES] + [spbu_arm(5, 4), loader_arm(1, 1), two_link(1, 1)], ids=repr
)
def test_rows_and_configurations_correspond(arm):
    q = np.full(len(arm.links), 0.3)
    count = arm.ik(arm.fk(q)).shape[-2]
    flags = arm.branches.tolist()
    assert len(flags) == count == 2 ** len(flags[0])
    assert len({tuple(row) for row in flags}) == count and {abs(f) for r in flags for f in r} == {1}
    assert [arm.branch(*row) for row in flags] == list(range(count))
    for wrong in ((), (1,) * (len(flags[0]) + 1), (0,) * len(flags[0]), (np.ones(2),)):
        with pytest.raises(ValueError, match="flags of \\+1 or -1"):
            arm.branch(*wrong)


def test_arm_without_closed_form_has_a_different_type():
    arm = three_lever(0.4)
    assert isinstance(arm, Arm) and arm.target is np.ndarray
    assert not any(hasattr(arm, name) for name in ("ik", "branches", "branch"))
    with pytest.raises(TypeError, match="geometry with links, target, reach, branches"):
        type(IRB140)("none", arm.geometry, arm.limits)


# Boundaries of the workspace: for each of them, `stretched` returns two functions, the results of
# `ik` and of `explain` at a given distance beyond the boundary. Both must use the same tolerance.
def stretched(arm, at):
    return lambda beyond: arm.ik(at(beyond)), lambda beyond: explain(arm, at(beyond), 0)


BORDERS = {
    "two links": stretched(two_link(0.3, 0.4), lambda x: (0.42 + 0.6 * x, 0.56 + 0.8 * x)),
    "two links folded": stretched(two_link(0.3, 0.4), lambda x: (0.06 - 0.6 * x, 0.08 - 0.8 * x)),
    "SCARA": stretched(SCARA, lambda x: ScaraPose((0.27 + 0.6 * x, 0.36 + 0.8 * x, 0.1))),
    "SCARA folded": stretched(SCARA, lambda x: ScaraPose((0.03 - 0.6 * x, 0.04 - 0.8 * x, 0.1))),
    "loader": stretched(loader_arm(1, 0.8), lambda x: (0, 1.08 + 0.6 * x, 1.44 + 0.8 * x)),
    "loader folded": stretched(loader_arm(1, 0.8), lambda x: (0, 0.12 - 0.6 * x, 0.16 - 0.8 * x)),
    "spbu": stretched(spbu_arm(5, 4), lambda x: (0, 5.4 + 0.6 * x, 7.2 + 0.8 * x)),
    "IRB-140": stretched(
        IRB140,
        lambda x: Transform(
            Quaternion.from_angle_axis(90 * deg, (0, 1, 0)), (0.07 + 0.73 + 0.065 + x, 0, 0.352)
        ),
    ),
    "PUMA 560": stretched(PUMA560, lambda x: puma_beyond(x)),
}


def puma_beyond(x):
    """A pose whose wrist centre, the origin of the flange, is x beyond the reach of the stretched
    arm.
    """
    T = PUMA560.fk([0, 0, -90 * deg + np.arctan2(20.3, 431.8), 0.1, 0.2, 0.3])
    ahead = (T.translation - [0, 0, 0.67183]) * [1, 0, 1]
    return Transform(T.rotation, T.translation + x * ahead / np.linalg.norm(ahead))


def away(x):
    return Transform(translation=(0, 0, x))


@pytest.mark.parametrize("name", BORDERS)
def test_ik_and_explain_agree_at_the_workspace_boundary_of_every_geometry(name):
    """`explain` gives a reason exactly for the rows that are NaN in `ik`, from a rounding error to
    10 mm beyond the boundary. (In the first version, the reason was empty for some of these
    distances.)
    """
    ik, words = BORDERS[name]
    reached = []
    for beyond in np.concatenate([-np.logspace(-17, -5, 25), [0], np.logspace(-17, -2, 91)]):
        exists = not np.isnan(ik(beyond)[0]).any()
        said = words(beyond)
        reached.append(exists)
        assert exists != ("does not exist" in said), (beyond, said)
        if not exists:
            assert " mm " in said or " m " in said
            if beyond > 1e-4:
                number = float(said.split(" is ")[1].split(" mm")[0])
                assert number == pytest.approx(beyond * 1000, rel=0.3, abs=0.051)
    assert sorted(reached, reverse=True) == reached, "there is more than one boundary"
    assert reached[25] and reached[26] and not reached[-1]


@pytest.mark.parametrize("exponent", range(2, 17))
def test_ik_of_equal_links_is_accurate_near_the_shoulder(exponent):
    """The law of cosines loses half of the digits near the shoulder: the error was once as large as
    the distance.
    """
    d = 10.0**-exponent
    # A point that is nearer to axis 1 than 1e-13 times the reach counts as on it, so joint 1 is
    # free.
    tolerance = 4e-15 if exponent < 12 else 4e-13
    angle = np.linspace(0, TURN, 13)
    circle = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=-1) * d
    lifted = circle[:, [0, 2, 1]]
    for arm, points in (
        (two_link(1, 1), circle),
        (loader_arm(1, 1), lifted),
        (spbu_arm(2, 2), lifted[lifted[:, 2] >= 0]),
    ):
        rows = arm.ik(points)
        assert not np.isnan(rows).any()
        back = arm.fk(rows).translation
        assert abs(back - points[:, None]).max() < tolerance
    scara = scara_arm("equal", 0.2, 1, 1, [(-3, 3)] * 3 + [(0, 1)])
    rows = scara.ik(ScaraPose(circle, 0.3))
    assert abs(scara.fk(rows).translation - circle[:, None]).max() < tolerance
    arm = itmo_arm(0.1, 0.5, 0.5, 0.2)  # for these targets its wrist centre is near the shoulder
    T = Transform(Quaternion.from_angle_axis(0.7, (0, 0, 1)), lifted + [0, 0, 0.1])
    T = T @ away(0.2)
    back = arm.fk(arm.ik(T))
    assert np.nanmax(abs(back.translation - T.translation[:, None])) < tolerance
    assert np.isfinite(back.translation).any(axis=(1, 2)).all()


def test_free_joint_keeps_its_value_where_equal_links_are_folded():
    """The tip is at the base, where joint 1 is free, so a motion keeps the previous value of joint
    1.
    """
    scara = scara_arm("equal", 0.2, 1, 1, [(-3, 3)] * 3 + [(0, 1)])
    rows = scara.ik(ScaraPose((0.0, 0.0, 0.1), 0.3))
    near = np.array([1.1, np.pi, 0.2, 0.1])
    kept = scara.geometry.choose_free_joints(rows, near)
    assert kept[:, 0].tolist() == [1.1, 1.1]
    assert np.allclose(scara.fk(kept).as_matrix(), scara.fk(rows).as_matrix(), rtol=0, atol=1e-15)
    apart = scara.ik(ScaraPose((0.5, 0.0, 0.1), 0.3))
    assert (scara.geometry.choose_free_joints(apart, near) == apart).all()
    unequal = scara_arm("unequal", 0.2, 1, 0.5, [(-3, 3)] * 3 + [(0, 1)])
    folded = unequal.ik(ScaraPose((0.5, 0.0, 0.1), 0.3))
    assert (unequal.geometry.choose_free_joints(folded, near) == folded).all()


def test_two_levers_agrees_with_the_law_of_cosines():
    rng = np.random.default_rng(8)
    a, b = rng.uniform(0.1, 2, (2, 500))
    for one, two, share in zip(a, b, rng.uniform(0.01, 0.99, 500), strict=True):
        d = abs(one - two) + share * (one + two - abs(one - two))
        ahead, turn, exists = two_levers(one, two, np.array(d))
        assert exists
        assert np.cos(ahead) == pytest.approx((one**2 + d**2 - two**2) / (2 * one * d), abs=1e-13)
        assert np.cos(np.pi - turn) == pytest.approx(
            (one**2 + two**2 - d**2) / (2 * one * two), abs=1e-13
        )
        assert 0 < ahead < np.pi and 0 < turn < np.pi
        # The chain must close: one link goes forward and the other back.
        tip = one * np.exp(-1j * ahead) + two * np.exp(1j * (turn - ahead))
        assert abs(tip - d) < 1e-14
    assert not two_levers(1, 0.5, np.array([0.49, 1.51, np.nan]))[2].any()


def test_distance_equals_hypot_at_every_scale():
    rng = np.random.default_rng(9)
    x, y = rng.normal(size=(2, 1000)) * 10.0 ** rng.integers(-300, 150, 1000)
    assert np.allclose(distance(x, y), np.hypot(x, y), rtol=4e-16, atol=0)
    assert distance(np.zeros(1), np.zeros(1)) == 0 and distance(np.array(5e-324), 0.0) == 5e-324


def test_every_gap_and_singularity_has_an_explanation():
    tilted = Transform(Quaternion.from_angle_axis(1 * deg, (1, 0, 0)), (0.3, 0, 0.1))
    offset = PUMA560.fk(np.full(6, 0.2))
    inside = Transform(offset.rotation, (0.0, 0.01, 0.7))
    for arm, pose, words in (
        (two_link(1, 0.5), (3, 0), "the target is 1500.0 mm beyond the reach of the arm"),
        (two_link(1, 0.5), (0.1, 0), "the target is 400.0 mm too near to the base"),
        (two_link(1, 0.5), (1, 0, 0.2), "the target is 200.0 mm off the plane z = 0"),
        (SCARA, tilted, "the tool is tilted by 1.0°, and a SCARA's tool stays upright"),
        (SCARA, ScaraPose((0.01, 0, 0.1)), "the target is 40.0 mm too near to axis 1"),
        (loader_arm(1, 0.5), (0, 0, 0.2), "the point is 300.0 mm too near to joint 2"),
        (loader_arm(1, 0.5), (0, 20, 0), "the point is 18.5 m beyond the reach of the arm"),
        (PUMA560, inside, "the wrist centre is 1"),
    ):
        said = explain(arm, pose, 0)
        assert words in said and said.startswith("Row 0 (") and said.endswith(".")
        gap = arm.geometry.gap(pose, 0)
        assert isinstance(gap, Gap) and gap.words in said and gap.kind in SENTENCES
    assert "too near to axis 1" in explain(PUMA560, inside, 0)
    # The hint appears only if the pose in millimetres would be within reach.
    assert "did you mean millimetres" in explain(loader_arm(1, 0.5), (0, 1200, 0), 0)
    assert "did you mean millimetres" not in explain(loader_arm(1, 0.5), (0, 1900, 0), 0)
    assert "did you mean millimetres" in explain(SCARA, ScaraPose((300, 0, 100), 0.1), 0)


def test_wrist_is_mentioned_only_for_arms_with_a_wrist():
    for arm in (loader_arm(1, 1), spbu_arm(1, 0.7)):
        on_axis = arm.ik((0, 0, 1.2))
        assert arm.geometry.singularities(on_axis)["shoulder"].all()
        said = explain(arm, (0, 0, 1.2), 0)
        assert "the point is as near to axis 1 as it can be (shoulder singularity)" in said
        assert "wrist" not in said and "wrist" not in explain(arm, (9, 9, 9), 0)


def test_axis_length_tolerance_is_the_same_everywhere():
    """An axis that is a unit vector within 1e-6 is accepted and normalised, in all functions."""
    link = Link(axis=(0, 0, 1 + 5e-7))
    assert link.axis.tolist() == [0, 0, 1]
    assert Quaternion.from_angle_axis(0.3, (0, 0, 1 + 5e-7)).wxyz[3] == np.sin(0.15)
    for make in (lambda a: Link(axis=a), lambda a: Quaternion.from_angle_axis(0.3, a)):
        with pytest.raises(ValueError, match="axis: wanted .*length 1.00001"):
            make((0, 0, 1 + 1e-5))


def test_links_may_have_any_axis_and_orientation():
    """The shortcuts for coordinate axes give the same result as the full product: a chain with
    oblique axes is compared with a rotated one.
    """
    rng = np.random.default_rng(11)
    for _ in range(30):
        crooked = Quaternion.from_roll_pitch_yaw(*rng.uniform(-3, 3, 3))
        axis = np.eye(3)[rng.integers(3)] * rng.choice([-1, 1])
        before = Transform(
            Quaternion.from_roll_pitch_yaw(*rng.uniform(-3, 3, 3)), rng.normal(size=3)
        )
        link = Link(before, axis)
        other = Link(before @ Transform(crooked.inverse()), crooked @ axis, Transform(crooked))
        q = np.array(rng.uniform(-3, 3))
        frames = [part._carry(((1, 0, 0, 0), (0, 0, 0)), q)[1] for part in (link, other)]
        (r1, o1), (r2, o2) = frames
        assert abs(abs(np.dot(r1, r2)) - 1) < 1e-14 and np.allclose(o1, o2, rtol=0, atol=1e-14)


def test_printed_lengths_have_a_suitable_unit():
    assert length_unit(2.0) == ("mm", 1e-3) and length_unit(2.01) == ("m", 1.0)
    assert in_words(0.0123) == "12.3 mm" and in_words(12.34) == "12.3 m"
    assert in_words(9.99) == "9990.0 mm"
    angle = np.linspace(-20, 20, 401)
    assert (abs(wrapped(angle)) <= np.pi + 1e-15).all()
    assert np.allclose(np.exp(1j * wrapped(angle)), np.exp(1j * angle))
    assert np.allclose(wrapped(angle, 7.0), 7 + wrapped(angle - 7))
