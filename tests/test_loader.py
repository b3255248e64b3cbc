"""The log loader of source 003, paper 1: its angles, compared with the reference cases, table 1
and errata S3-p to S3-r.
"""

import numpy as np
import pytest
from machines import SHAPES, oracle, rot, shift, turns

from robokin import SCARA, Transform, deg, explain, loader_arm, three_lever, two_link, within
from robokin.jobs.steppers import out_of_reach, shortest_turn, station_postures

CASES = oracle("loader_arm")["cases"]
LENGTHS = [(1.2, 1.0), (1.0, 1.2), (1.0, 1.0), (2.0, 0.1)]
cases = pytest.mark.parametrize("case", CASES, ids=[str(i) for i in range(len(CASES))])
lengths = pytest.mark.parametrize("A, B", LENGTHS)


def joints_of(case):
    return np.array([case["alpha_deg"], case["gamma_deg"], case["beta_deg"]]) * deg


@cases
def test_angles_match_the_reference_cases(case):
    arm = loader_arm(case["A"], case["B"])
    row = arm.ik(case["p"])[arm.branch(+1, -1)]
    q = station_postures(arm, [case["p"]])[0]
    if not case["reachable"]:
        assert np.isnan(row).all() and np.isnan(q).all() and out_of_reach(arm, case["p"])
        return
    assert abs(q - joints_of(case)).max() < 1e-9
    assert turns(row, q).max() < 1e-12 and within(arm, row).all()
    np.testing.assert_allclose(arm.fk(q).translation, case["p"], atol=1e-12)
    assert out_of_reach(arm, case["p"]) == []


@lengths
def test_fk_matches_the_figure_of_the_document(A, B):
    rng = np.random.default_rng(1)
    for alpha, gamma, beta in rng.uniform(-np.pi, np.pi, (20, 3)):
        chain = (
            rot("z", alpha)
            @ rot("y", -gamma)
            @ shift(A, 0, 0)
            @ rot("y", np.pi - beta)
            @ shift(B, 0, 0)
        )
        np.testing.assert_allclose(
            loader_arm(A, B).fk([alpha, gamma, beta]).as_matrix(), chain, atol=1e-12
        )
        # beta is the angle between the levers at the elbow
        shoulder, elbow, tip = loader_arm(A, B).frames([alpha, gamma, beta]).translation[1:]
        cosine = (shoulder - elbow) @ (tip - elbow) / (A * B)
        assert cosine == pytest.approx(np.cos(beta), abs=1e-12)
        assert elbow[2] == pytest.approx(A * np.sin(gamma))


@lengths
@pytest.mark.parametrize("shape", SHAPES)
def test_ik_contains_the_original_joint_values(A, B, shape):
    arm = loader_arm(A, B)
    q = np.random.default_rng(2).uniform((-np.pi, 0, 0.01), (np.pi, np.pi / 2, 3.13), (*shape, 3))
    pose = arm.fk(q)
    rows = arm.ik(pose)
    assert rows.shape == (*shape, 4, 3)
    assert turns(rows, q[..., None, :]).max(-1).min(-1).max() < 1e-9
    back = arm.fk(rows).translation - pose.translation[..., None, :]
    assert abs(back).max() < 1e-12
    np.testing.assert_array_equal(rows, arm.ik(pose.translation))


@pytest.mark.parametrize("x", [-1.0, 0.0, 1.0])
@pytest.mark.parametrize("y", [-2.0, -0.0, 0.0, 2.0])
def test_alpha_matches_the_nine_cells_of_table_1(x, y):
    alpha = station_postures(loader_arm(2, 1.5), [(x, y, 0.9)])[0, 0] / deg
    steep = np.degrees(np.arctan(2.0))
    table = {
        (-1, -1): -180 + steep,
        (0, -1): -90,
        (1, -1): -steep,
        (-1, 0): 180,
        (1, 0): 0,
        (0, 0): 0,
        # the corner (-1, 1) as in errata S3-p
        (-1, 1): 180 - steep,
        (0, 1): 90,
        (1, 1): steep,
    }
    assert alpha == pytest.approx(table[np.sign(x), np.sign(y)], abs=1e-12)


def test_printed_corner_of_table_1_is_wrong():
    alpha = station_postures(loader_arm(2, 1.5), [(-1, 2, 0), (-1, 1e-4, 0)])[:, 0] / deg
    assert alpha == pytest.approx([116.565051, 179.994270], abs=1e-6)
    printed = np.degrees(np.arctan([2.0, 1e-4])) + 90
    assert printed == pytest.approx([153.434949, 90.005730], abs=1e-6)


def test_alpha_keeps_its_value_on_the_axis():
    arm = loader_arm(1.2, 1.0)
    q = station_postures(
        arm, [(0, 0, 1.5), (0.5, 0.5, 1), (0, 0, 1.5), (0, 1e-16, 2.2), (-0.5, 0.5, 1)]
    )
    assert q[:, 0] / deg == pytest.approx([0, 45, 45, 45, 135])
    assert np.isfinite(q).all() and q[3, 2] == pytest.approx(np.pi)


def test_gamma_can_reach_270_degrees():
    """If the outer lever is longer than the inner one, the inner one can point down and back, and
    gamma can be as large as 270 degrees.
    """
    arm, alpha = loader_arm(1.0, 2.0), 0.3
    gamma, beta = np.meshgrid([-30, 1, 89, 179, 181, 269, 269.9], [0.03, 0.3, 20, 70, 150])
    q = np.stack([alpha / deg + 0 * gamma, gamma, beta], axis=-1).reshape(-1, 3) * deg
    places = arm.fk(q).translation
    ahead = places[:, :2] @ [np.cos(alpha), np.sin(alpha)] > 0
    served = ahead & (places[:, 2] >= 0)
    assert set(q[served, 1] / deg) > {89.0, 179.0, 269.0, 269.9}
    np.testing.assert_allclose(station_postures(arm, places)[served], q[served], atol=1e-7)


def test_alpha_continues_by_the_shortest_turn():
    angle = np.array([170, -170, -20, 170, -100, 79]) * deg
    points = np.stack([np.cos(angle), np.sin(angle), 0 * angle + 0.3], axis=-1)
    alpha = station_postures(loader_arm(1.2, 1.0), points)[:, 0]
    assert alpha / deg == pytest.approx([170, 190, 340, 170, 260, 439], abs=1e-9)
    assert abs(np.diff(alpha)).max() <= np.pi + 1e-12
    assert alpha == pytest.approx(np.unwrap(angle))
    lost = np.insert(points, 2, [9, 9, 9], axis=0)
    q = station_postures(loader_arm(1.2, 1.0), lost)
    assert np.isnan(q[2]).all() and q[[0, 1, 3, 4, 5, 6], 0] == pytest.approx(alpha)


@pytest.mark.parametrize(
    "start, goal, turn",
    [
        (170, -170, 20),
        (-170, 170, -20),
        (0, 180, 180),
        (180, 0, -180),
        (10, 30, 20),
        (-90, 91, -179),
        (0, 0, 0),
    ],
)
def test_shortest_turn_matches_hand_computed_values(start, goal, turn):
    assert shortest_turn(start * deg, goal * deg) / deg == pytest.approx(turn)


def test_printed_shortest_turn_is_wrong():
    printed = -(360 - abs(-170 - 170))  # errata S3-q
    assert printed == -20 and shortest_turn(170 * deg, -170 * deg) / deg == pytest.approx(20)


@lengths
def test_stretched_and_folded_arms_have_the_expected_angles(A, B):
    arm = loader_arm(A, B)
    direction = np.array([0.6, 0.48, 0.64])
    stretched, folded = station_postures(
        arm, [(A + B) * direction, abs(A - B) * direction + [1e-9 * (A == B), 0, 0]]
    )
    assert stretched[2] == pytest.approx(np.pi, abs=1e-6) and stretched[1] == pytest.approx(
        np.arcsin(0.64), abs=1e-6
    )
    assert folded[2] == pytest.approx(0, abs=1e-6) and folded[2] >= 0
    assert np.isnan(station_postures(arm, [(A + B) * 1.0001 * direction])).all()
    if A != B:
        assert np.isnan(station_postures(arm, [abs(A - B) * 0.999 * direction])).all()


@lengths
def test_angles_match_the_formulas_of_the_document(A, B):
    rng = np.random.default_rng(5)
    p = rng.normal(size=(300, 3)) * [1, 1, 0.7]
    p[:, 2] = abs(p[:, 2])
    p *= (abs(A - B) + rng.uniform(0.001, 0.999, 300) * (A + B - abs(A - B)))[
        :, None
    ] / np.linalg.norm(p, axis=1, keepdims=True)
    h2 = (p**2).sum(axis=1)
    beta = np.arccos((B**2 + A**2 - h2) / (2 * A * B))  # formula (3)
    # formula (4)
    gamma = np.arccos((A**2 - B**2 + h2) / (2 * A * np.sqrt(h2))) + np.arcsin(p[:, 2] / np.sqrt(h2))
    q = station_postures(loader_arm(A, B), p)
    np.testing.assert_allclose(q[:, 1:], np.stack([gamma, beta], axis=1), atol=1e-8)
    q[:, 0] = shortest_turn(0, q[:, 0])  # alpha is unwrapped over 300 stations
    assert within(loader_arm(A, B), q).all()
    assert gamma.max() > np.pi or A >= B  # some gammas are above 180 degrees


def test_unreachable_coordinates_get_a_reason():
    arm = loader_arm(1.2, 0.7)
    assert out_of_reach(arm, (1, 0.5, 0.4)) == []
    assert out_of_reach(arm, (1, 0.5, -0.1)) == ["the point is under the floor: z = -0.1 m"]
    assert out_of_reach(arm, (2, 0, 0)) == ["the point is 100.0 mm beyond the reach of the arm"]
    # the inner bound of errata S3-r
    assert out_of_reach(arm, (0.3, 0, 0.1)) == ["the point is 183.8 mm too near to joint 2"]
    assert len(out_of_reach(arm, (2, 0, -1))) == 2
    # the tolerance is 1e-12 times the reach
    assert out_of_reach(arm, (1, 0.5, -1.8e-12)) == [] and out_of_reach(arm, (1, 0.5, -2e-12))
    assert out_of_reach(arm, (1.9, 0, 0)) == [] and out_of_reach(arm, (0, 0, 0.5)) == []
    assert "did you mean millimetres" in explain(arm, (1200, 0, 300), 1)
    assert "183.8 mm too near" in explain(arm, Transform(translation=(0.3, 0, 0.1)), 1)


def test_invalid_arguments_are_refused():
    for A, B in ((0, 1), (-1, 1), (1, np.nan), ("a", 1), ([1, 2], 1)):
        with pytest.raises(ValueError, match="A: |B: "):
            loader_arm(A, B)
    with pytest.raises(ValueError, match="stations"):
        station_postures(loader_arm(1, 1), (1, 0, 0))
    for arm in (SCARA, two_link(1, 1), three_lever(1), None, "a"):
        with pytest.raises(TypeError, match="loader_arm"):
            station_postures(arm, [(1, 0, 0)])
        with pytest.raises(TypeError, match="loader_arm"):
            out_of_reach(arm, "a")  # the error names the invalid arm, not the invalid point
