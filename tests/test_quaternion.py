"""`Quaternion` compared with SciPy's `Rotation`, and properties that only batches of rotations
have.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from machines import SHAPES
from scipy.spatial.transform import Rotation, Slerp

from robokin import Quaternion, Transform

RNG = np.random.default_rng(1)


def random(shape, rng=RNG):
    wxyz = rng.normal(size=(*shape, 4))
    return Quaternion(wxyz / np.linalg.norm(wxyz, axis=-1, keepdims=True))


def scipy(q):
    return Rotation.from_quat(q.wxyz.reshape(-1, 4), scalar_first=True)


def same(q, rotation, atol=1e-15):
    """Assert that the rotations agree, whatever the sign of the quaternion."""
    assert np.allclose(
        q.as_matrix().reshape(-1, 3, 3),
        rotation.as_matrix().reshape(-1, 3, 3),
        rtol=0,
        atol=8 * atol,
    )
    assert np.allclose(np.linalg.norm(q.wxyz, axis=-1), 1, rtol=0, atol=atol)


@pytest.mark.parametrize("shape", SHAPES)
def test_composition_action_and_inverse_match_scipy(shape):
    a, b, points = random(shape), random(shape), RNG.normal(size=(*shape, 3))
    same(a @ b, scipy(a) * scipy(b))
    same(a.inverse(), scipy(a).inv())
    assert np.allclose(
        (a @ points).reshape(-1, 3), scipy(a).apply(points.reshape(-1, 3)), rtol=0, atol=1e-14
    )
    assert (a @ b).shape == a.inverse().shape == shape
    assert (a @ points).shape == (*shape, 3)


@pytest.mark.parametrize("shape", SHAPES)
def test_angle_axis_matches_scipy_rotation_vector(shape):
    axis = RNG.normal(size=(*shape, 3))
    axis /= np.linalg.norm(axis, axis=-1, keepdims=True)
    angle = RNG.uniform(-10, 10, shape)
    q = Quaternion.from_angle_axis(angle, axis)
    same(q, Rotation.from_rotvec((angle[..., None] * axis).reshape(-1, 3)), 4e-16)
    back, about = q.as_angle_axis()
    assert ((back >= 0) & (back <= np.pi)).all()
    assert np.allclose(
        (back[..., None] * about).reshape(-1, 3), scipy(q).as_rotvec(), rtol=0, atol=1e-14
    )


def test_angle_axis_is_accurate_at_zero_and_half_a_turn():
    angle, axis = Quaternion.identity().as_angle_axis()
    assert angle == 0 and axis.tolist() == [0, 0, 1]
    for small in (1e-9, 1e-100):
        angle, axis = Quaternion.from_angle_axis(small, [0, 0.6, 0.8]).as_angle_axis()
        assert np.isclose(angle, small, rtol=1e-12, atol=0)
        assert np.allclose(axis, [0, 0.6, 0.8], rtol=0, atol=1e-12)
    angle, axis = Quaternion.from_angle_axis(np.pi, [0, -1, 0]).as_angle_axis()
    assert np.isclose(angle, np.pi) and np.allclose(axis, [0, -1, 0])
    angle, axis = Quaternion([-1.0, 0, 0, 0]).as_angle_axis()
    assert angle == 0


@pytest.mark.parametrize("largest", range(4))
def test_from_matrix_is_accurate_in_all_four_cases(largest):
    """The largest component is w, x, y or z in turn, and components as small as 1e-9
    are preserved.
    """
    wxyz = RNG.normal(size=(500, 4)) * [[1e-9], [1e-3], [0.1], [0.4], [0.4]][largest % 5]
    wxyz[:, largest] = RNG.choice([-1, 1], 500)
    q = Quaternion(wxyz / np.linalg.norm(wxyz, axis=-1, keepdims=True))
    back = Quaternion.from_matrix(scipy(q).as_matrix())
    same(back, scipy(q), 4e-16)
    sign = np.sign((q.wxyz * back.wxyz).sum(-1, keepdims=True))
    assert np.allclose(back.wxyz, sign * q.wxyz, rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    "axis", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (1, 0, -1), (0, -1, 1), (1, 1, 1)]
)
def test_from_matrix_is_accurate_at_half_turns(axis):
    unit = np.array(axis) / np.linalg.norm(axis)
    for angle in (np.pi, np.pi - 1e-9, -np.pi + 1e-12):
        rotation = Rotation.from_rotvec(angle * unit)
        same(Quaternion.from_matrix(rotation.as_matrix()), rotation)


def test_from_matrix_accepts_batches_and_corrects_rounded_digits():
    m = scipy(random((6,))).as_matrix().reshape(3, 1, 2, 3, 3)
    q = Quaternion.from_matrix(np.round(m, 8))
    assert q.shape == (3, 1, 2)
    assert np.allclose(q.as_matrix(), m, rtol=0, atol=2e-8)
    assert np.allclose(np.linalg.norm(q.wxyz, axis=-1), 1, rtol=0, atol=1e-15)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("flip", [1, -1])
def test_slerp_matches_scipy_for_both_signs(shape, flip):
    a, b = random(shape), random(shape)
    s = np.array([0, 0.1, 0.5, 0.77, 1])
    ours = a[..., None].slerp(Quaternion(flip * b.wxyz)[..., None], s)
    assert ours.shape == (*shape, 5)
    for i in np.ndindex(*shape):
        key = Rotation.from_quat(
            [a[i].wxyz, b[i].wxyz] if i else [a.wxyz, b.wxyz], scalar_first=True
        )
        same(ours[i] if i else ours, Slerp([0, 1], key)(s), 1e-15)


def test_slerp_turns_at_constant_speed_and_nlerp_does_not():
    """Errata S1-a: a quarter of the way from chain_s to chain_e the normalised straight line is
    2.204 degrees off.
    """
    a = Quaternion.from_angle_axis(np.pi / 2, (-1, 0, 0))
    b = Quaternion.from_angle_axis(np.pi / 2, (0, 1, 0))
    s = np.linspace(0, 1, 101)
    steps = (a.slerp(b, s[:-1]).inverse() @ a.slerp(b, s[1:])).as_angle_axis()[0]
    assert np.ptp(steps) < 1e-14 and steps.sum() > 1
    straight = 0.75 * a.wxyz + 0.25 * b.wxyz
    nlerp = Quaternion(straight / np.linalg.norm(straight))
    off = (a.slerp(b, 0.25).inverse() @ nlerp).as_angle_axis()[0]
    assert abs(np.rad2deg(off) - 2.204) < 5e-4


def test_slerp_of_half_a_turn_depends_on_the_signs():
    """Both arcs are equally long: the signs of the two quaternions decide between them, and
    rounding errors do not.
    """
    one = Quaternion.identity()
    for noise in (-4e-16, 0, 4e-16):
        half = Quaternion.from_angle_axis(np.pi + noise, (0, 0, 1))
        for a, sign in ((one, 1), (Quaternion(-one.wxyz), -1)):
            quarter = a.slerp(half, 0.5) @ [1.0, 0, 0]
            assert np.allclose(quarter, [0, sign, 0], rtol=0, atol=1e-14)
            assert np.allclose(
                a.slerp(Quaternion(-half.wxyz), 0.5) @ [1.0, 0, 0], -quarter, rtol=0, atol=1e-14
            )


def test_slerp_between_nearly_equal_rotations_keeps_all_digits():
    for angle in (0.0, 1e-100, 1e-12, 1e-9, 1e-6):
        goal = Quaternion.from_angle_axis(angle, (0.6, 0, 0.8))
        third = Quaternion.identity().slerp(goal, 1 / 3)
        assert np.allclose(third.as_angle_axis()[0], angle / 3, rtol=1e-12, atol=0)
        # now the two rotations differ only in their last digits
        base = Quaternion.from_angle_axis(2.0, (0, 1, 0))
        turned = base.slerp(base @ goal, 1 / 3)
        assert np.allclose(
            (base.inverse() @ turned).as_angle_axis()[0], angle / 3, rtol=0, atol=3e-16
        )


def test_slerp_continues_beyond_its_ends():
    goal = Quaternion.from_angle_axis(0.4, (0, 0, 1))
    same(
        Quaternion.identity().slerp(goal, np.array([-1.0, 2.5])),
        Rotation.from_rotvec([[0, 0, -0.4], [0, 0, 1.0]]),
    )


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_rotations_form_a_group_that_preserves_lengths_and_handedness(seed):
    rng = np.random.default_rng(seed)
    a, b, c = random((), rng), random((), rng), random((), rng)
    u, v = rng.normal(size=(2, 3)) * 10.0 ** rng.integers(-8, 8)
    assert np.allclose(((a @ b) @ c).wxyz, (a @ (b @ c)).wxyz, rtol=0, atol=1e-15)
    assert np.allclose((a @ b) @ u, a @ (b @ u), rtol=1e-13, atol=1e-14 * np.linalg.norm(u))
    assert np.isclose(np.linalg.norm(a @ u), np.linalg.norm(u), rtol=1e-14)
    assert np.allclose(
        np.cross(a @ u, a @ v), a @ np.cross(u, v), rtol=1e-12, atol=1e-13 * np.linalg.norm(u) ** 2
    )


def test_indexing_applies_to_the_batch_only():
    q = random((3, 1, 2))
    assert q[0].shape == (1, 2) and q[..., 1].shape == (3, 1) and q[:, 0].shape == (3, 2)
    assert q[None].shape == (1, 3, 1, 2) and q[:, None].shape == (3, 1, 1, 2)
    assert q[[2, 0]].shape == (2, 1, 2) and q[np.array([True, False, True])].shape == (2, 1, 2)
    assert (q[1, 0, 1].wxyz == q.wxyz[1, 0, 1]).all()
    with pytest.raises(IndexError):
        q[0, 0, 0, 0]
    with pytest.raises(IndexError):
        q[0, 0, 0][0]


@pytest.mark.parametrize("value", [random(()), Transform()])
def test_single_rotation_has_no_length_and_no_items(value):
    with pytest.raises(TypeError, match="no length"):
        len(value)
    with pytest.raises(TypeError, match="no length"):
        iter(value)


def test_a_batch_has_a_length_and_yields_its_items():
    q = random((3, 2))
    assert len(q) == 3
    assert [item.shape for item in q] == [(2,)] * 3
    assert (next(iter(q)).wxyz == q.wxyz[0]).all()


def test_a_batch_of_rotations_acts_on_a_batch_of_points():
    q, points = random((4,)), RNG.normal(size=(7, 3))
    each = np.array([[scipy(one).apply(p)[0] for p in points] for one in q])
    assert np.allclose(q[:, None] @ points, each, rtol=0, atol=1e-14)
    assert np.allclose(q @ [0, 0, 1.0], scipy(q).apply([0, 0, 1]), rtol=0, atol=1e-14)


def test_nan_points_remain_nan():
    points = np.array([[1.0, 2, 3], [np.nan, 0, 0]])
    turned = random(()) @ points
    assert np.isfinite(turned[0]).all() and np.isnan(turned[1]).all()


def test_invalid_operands_raise_type_error():
    for left, right in ((np.eye(3), random(())), (random(()), Transform()), (2.0, random(()))):
        with pytest.raises(TypeError):
            left @ right


def test_values_are_copied_from_the_caller():
    wxyz = np.array([1.0, 0, 0, 0])
    q = Quaternion(wxyz)
    wxyz[:] = 7
    assert q.wxyz.tolist() == [1, 0, 0, 0]


def test_nearly_unit_quaternions_are_normalised():
    q = Quaternion(np.array([0.6, 0, 0.8, 0]) * (1 + 9e-7))
    assert abs(np.linalg.norm(q.wxyz) - 1) < 3e-16


def test_repr_has_no_negative_zero():
    assert repr(Quaternion([1.0, -0.0, -1e-9, 0])) == "Quaternion(wxyz=[1., 0., 0., 0.])"
    assert repr(random((2, 3))) == "Quaternion(shape=(2, 3))"


@pytest.mark.parametrize("shape", SHAPES)
def test_angle_to_matches_scipy(shape):
    a, b = random(shape), random(shape)
    wanted = (scipy(a).inv() * scipy(b)).magnitude().reshape(shape)
    assert np.allclose(a.angle_to(b), wanted, rtol=0, atol=4e-15)
    assert np.allclose(a.angle_to(Quaternion(-b.wxyz)), wanted, rtol=0, atol=4e-15)
    assert a.angle_to(b).shape == shape and (a.angle_to(a) == 0).all()


@pytest.mark.parametrize("exponent", range(1, 16))
def test_small_angles_keep_their_digits(exponent):
    angle = 10.0**-exponent
    a = random((50,))
    b = a @ Quaternion.from_angle_axis(angle, (0.6, 0, 0.8))
    assert np.allclose(a.angle_to(b), angle, rtol=0, atol=1e-15)
    nearly_opposite = a @ Quaternion.from_angle_axis(np.pi - angle, (0.6, 0, 0.8))
    assert np.allclose(a.angle_to(nearly_opposite), np.pi - angle, rtol=0, atol=2e-15)


def test_angle_to_refuses_wrong_shapes_and_types():
    with pytest.raises(ValueError, match=r"\(2,\).*\(3,\)"):
        random((2,)).angle_to(random((3,)))
    with pytest.raises(TypeError, match="other: wanted a Quaternion"):
        random(()).angle_to(Transform())


@pytest.mark.parametrize("shape", SHAPES)
def test_roll_pitch_yaw_match_scipy(shape):
    q = random(shape)
    angles = np.stack(q.as_roll_pitch_yaw(), axis=-1)
    wanted = scipy(q).as_euler("xyz").reshape(*shape, 3)
    assert np.allclose(angles, wanted, rtol=0, atol=1e-12)
    back = Quaternion.from_roll_pitch_yaw(*np.moveaxis(angles, -1, 0))
    same(back, scipy(q), 1e-15)
    one_by_one = Rotation.from_euler("xyz", angles.reshape(-1, 3))
    same(back, one_by_one, 1e-15)


@pytest.mark.parametrize("pitch", [90, -90])
def test_roll_is_zero_at_vertical_pitch(pitch):
    for roll, yaw in ((0, 0), (30, 20), (-140, 75)):
        q = Quaternion.from_roll_pitch_yaw(*np.deg2rad([roll, pitch, yaw]))
        r, p, y = q.as_roll_pitch_yaw()
        assert r == 0 and np.rad2deg(p) == pytest.approx(pitch, abs=1e-6)
        same(Quaternion.from_roll_pitch_yaw(r, p, y), scipy(q), 1e-15)


@pytest.mark.parametrize("sign", [1, -1])
def test_roll_pitch_yaw_keep_their_digits_near_vertical_pitch(sign):
    """The nearer the pitch is to a quarter turn, the fewer correct digits roll and yaw have; the
    rotation that they describe together keeps all its digits.
    """
    rng = np.random.default_rng(15)
    for off in 10.0 ** np.arange(-17, 0.5, 0.25):
        roll, yaw = rng.uniform(-np.pi, np.pi, (2, 50))
        q = Quaternion.from_roll_pitch_yaw(roll, sign * (np.pi / 2 - off), yaw)
        back = q.as_roll_pitch_yaw()
        assert q.angle_to(Quaternion.from_roll_pitch_yaw(*back)).max() < 5e-14
        if off >= 1e-13:
            assert q.angle_to(Quaternion.from_roll_pitch_yaw(*back)).max() < 3e-15
        if off >= 1e-6:
            assert abs(np.array(back[::2]) - (roll, yaw)).max() < 1e-15 / off


def test_angles_in_degrees_cause_a_warning():
    with pytest.warns(UserWarning, match=r"angle: 90 rad .* did you mean degrees\? \(90 \* deg\)"):
        q = Quaternion.from_angle_axis(90, (0, 0, 1))
    assert q.wxyz[0] == np.cos(45)
    with pytest.warns(UserWarning, match="angle: 90 rad"):
        Quaternion.from_angle_axis([0, -90.0], (0, 0, 1))


def test_identity_has_the_requested_shape():
    for shape in ((), (3,), (2, 0), (4, 1)):
        assert Quaternion.identity(shape).shape == Transform.identity(shape).shape == shape
        assert (Transform.identity(shape).as_matrix() == np.eye(4)).all()
    assert Quaternion.identity([2]).shape == (2,)
    for wrong in (3, (1.0,), (-1,), ("2",), None, (True,)):
        with pytest.raises(ValueError, match="shape: wanted a tuple of whole numbers"):
            Quaternion.identity(wrong)


@pytest.mark.parametrize("axis", [(1, 0, 0), (-1, 0, 0), (0, -0.6, 0.8), (0, 0, -1)])
def test_half_a_turn_keeps_the_axis_of_its_quaternion(axis):
    angle, about = Quaternion((0, *axis)).as_angle_axis()
    assert angle == np.pi and about.tolist() == list(axis)
