"""`Transform` compared with 4 x 4 matrices."""

import numpy as np
import pytest
from machines import SHAPES
from scipy.spatial.transform import Rotation

from robokin import Quaternion, Transform, deg, mm

RNG = np.random.default_rng(2)


def random(shape):
    wxyz = RNG.normal(size=(*shape, 4))
    return Transform(
        Quaternion(wxyz / np.linalg.norm(wxyz, axis=-1, keepdims=True)),
        RNG.normal(size=(*shape, 3)),
    )


@pytest.mark.parametrize("shape", SHAPES)
def test_composition_inverse_and_action_match_matrices(shape):
    a, b, points = random(shape), random(shape), RNG.normal(size=(*shape, 3))
    m, n = a.as_matrix(), b.as_matrix()
    assert (a @ b).shape == a.inverse().shape == shape
    assert np.allclose((a @ b).as_matrix(), m @ n, rtol=0, atol=1e-14)
    assert np.allclose(a.inverse().as_matrix(), np.linalg.inv(m), rtol=0, atol=1e-14)
    homogeneous = np.concatenate([points, np.ones((*shape, 1))], axis=-1)
    assert np.allclose(a @ points, (m @ homogeneous[..., None])[..., :3, 0], rtol=0, atol=1e-14)


@pytest.mark.parametrize("shape", SHAPES)
def test_matrices_round_trip(shape):
    rotation = (
        Rotation.random(int(np.prod(shape)), random_state=3).as_matrix().reshape(*shape, 3, 3)
    )
    m = np.zeros((*shape, 4, 4))
    m[..., :3, :3], m[..., :3, 3], m[..., 3, 3] = rotation, RNG.normal(size=(*shape, 3)), 1
    back = Transform.from_matrix(m)
    assert back.shape == shape
    assert np.allclose(back.as_matrix(), m, rtol=0, atol=1e-15)


def test_rotation_is_applied_before_translation():
    T = Transform(Quaternion.from_angle_axis(90 * deg, (0, 0, 1)), (100 * mm, 0, 0))
    assert np.allclose(T @ (50 * mm, 0, 0), (0.1, 0.05, 0), rtol=0, atol=1e-17)


def test_a_batch_of_poses_acts_on_a_batch_of_points():
    T, points = random((5,)), RNG.normal(size=(7, 3))
    each = np.array([[t.as_matrix()[:3, :3] @ p + t.translation for p in points] for t in T])
    assert np.allclose(T[:, None] @ points, each, rtol=0, atol=1e-14)
    with pytest.raises(ValueError, match=r"\(5,\) and \(7,\)"):
        T @ points


def test_a_batch_of_poses_composes_with_a_single_pose():
    T, one = random((5,)), random(())
    for product, pairs in ((T @ one, [(t, one) for t in T]), (one @ T, [(one, t) for t in T])):
        assert product.shape == (5,)
        assert np.allclose(
            product.as_matrix(),
            [a.as_matrix() @ b.as_matrix() for a, b in pairs],
            rtol=0,
            atol=1e-14,
        )


def test_rotation_and_translation_are_broadcast():
    T = Transform(random((3, 1)).rotation, RNG.normal(size=(4, 3)))
    assert T.shape == (3, 4) and T.rotation.shape == (3, 4) and T.translation.shape == (3, 4, 3)
    assert T[0, 0].shape == () and T[..., 1].rotation.shape == (3,)
    assert Transform().as_matrix().tolist() == np.eye(4).tolist()
    assert Transform.identity((2, 3)).as_matrix().shape == (2, 3, 4, 4)


@pytest.mark.parametrize("shape", SHAPES)
def test_lerp_moves_linearly_and_rotates_like_slerp(shape):
    a, b, s = random(shape), random(shape), np.linspace(0, 1, 11)
    T = a[..., None].lerp(b[..., None], s)
    assert T.shape == (*shape, 11)
    line = a.translation[..., None, :] * (1 - s)[:, None] + b.translation[..., None, :] * s[:, None]
    assert np.allclose(T.translation, line, rtol=0, atol=1e-15)
    steps = T.rotation[..., :-1].inverse() @ T.rotation[..., 1:]
    angle = (a.rotation.inverse() @ b.rotation).as_angle_axis()[0]
    assert np.allclose(steps.as_angle_axis()[0], angle[..., None] / 10, rtol=0, atol=1e-14)
    for end, s_end in ((a, 0), (b, 1)):
        assert np.allclose(a.lerp(b, s_end).as_matrix(), end.as_matrix(), rtol=0, atol=1e-15)


def test_len_and_iteration_use_the_batch():
    T = random((3, 2))
    assert len(T) == 3 and [t.shape for t in T] == [(2,)] * 3


def test_values_are_copied_from_the_caller():
    translation = np.array([1.0, 2, 3])
    T = Transform(translation=translation)
    translation[:] = 7
    assert T.translation.tolist() == [1, 2, 3]


def test_invalid_operands_raise_type_error():
    for left, right in (
        (np.eye(4), Transform()),
        (Transform(), Quaternion.identity()),
        (np.zeros(3), Transform()),
    ):
        with pytest.raises(TypeError):
            left @ right


def test_repr_has_no_negative_zero():
    text = repr(Transform(translation=(-0.0, -1e-9, 1)))
    assert "-0" not in text and "1." in text


def test_a_matrix_can_be_a_list():
    rows = [[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]
    T = Transform.from_matrix(rows)
    assert T.translation.tolist() == [1, 2, 3]
    assert np.allclose(T @ (1, 0, 0), [1, 3, 3])
    batch = Transform.from_matrix([rows, np.eye(4).tolist()])
    assert batch.shape == (2,) and batch[1].translation.tolist() == [0, 0, 0]


def test_wrong_last_row_is_refused():
    for column in range(4):
        for off in (1e-6, -1e-6):
            m = np.eye(4)
            m[3, column] += off
            with pytest.raises(ValueError, match="0 0 0 1 as the last row"):
                Transform.from_matrix(m)
