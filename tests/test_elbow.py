"""The positioning arm of source 000, compared with reference cases, the matrices of the document
and errata S0.
"""

import numpy as np
import pytest
from machines import SHAPES, dh, oracle, turns

from robokin import Quaternion, Transform, explain, loader_arm, spbu_arm, within
from robokin.jobs.visit_collect import out_of_workspace, principal_postures, workspace

CASES = oracle("spbu3")["cases"]
VERDICTS = ("outer", "floor", "inner_l1_gt_l2", "inner_l1_lt_l2")
LENGTHS = [(5, 4), (4, 5), (4, 4), (1, 1.7), (0.3, 0.05), (0.05, 0.3)]
RIGHT = np.pi / 2
cases = pytest.mark.parametrize(
    "case", CASES, ids=[f"{i}-{case['kind']}" for i, case in enumerate(CASES)]
)
lengths = pytest.mark.parametrize("l1, l2", LENGTHS)


def matrices(l1, l2, q):
    """The product of the document's matrices, with alpha1 = -90 degrees."""
    return dh(q, (0, l1, l2), (-RIGHT, 0, 0), (0, 0, 0), (0, -RIGHT, RIGHT))


@cases
def test_ik_returns_every_solution_in_its_row(case):
    arm = spbu_arm(case["l1"], case["l2"])
    rows = arm.ik(case["p"])
    tolerance = 1e-4 if case["singular"]["elbow"] else 1e-6
    if not case["solutions"]:
        assert np.isnan(rows).all()
        return
    found = [turns(rows, s["q"]).max(axis=-1) < tolerance for s in case["solutions"]]
    assert np.any(found, axis=0).all(), "a row is not a solution"
    assert np.any(found, axis=1).all(), "a solution has no row"
    for solution, places in zip(case["solutions"], found, strict=True):
        assert (
            within(arm, rows[places]).all(axis=-1).tolist()
            == [solution["in_domain"]] * places.sum()
        )
        np.testing.assert_allclose(
            arm.fk(solution["q"]).as_matrix(), solution["T"], rtol=0, atol=1e-9
        )
    # The front rows face the point and the back rows face away from it. The two elbow rows are on
    # opposite sides of the stretched arm.
    heading = np.array(case["p"])[:2] @ [np.cos(rows[:, 0]), np.sin(rows[:, 0])]
    if not case["singular"]["axis"]:
        assert (np.sign(heading) == [1, 1, -1, -1]).all()
    if not case["singular"]["elbow"]:
        assert (np.sign(np.cos(rows[:, 2])) == [1, -1, 1, -1]).all()


@cases
def test_principal_branch_is_row_0(case):
    row = spbu_arm(case["l1"], case["l2"]).ik(case["p"])[0]
    if "principal" not in case:
        assert np.isnan(row).all()
    else:
        assert turns(row, case["principal"]).max() < (1e-6 if case["singular"]["elbow"] else 1e-9)
        fixed = [not case["singular"]["axis"], True, True]
        q = principal_postures(case["l1"], case["l2"], case["p"])
        assert (np.isnan(q) == np.logical_not(fixed)).all() and (q[fixed] == row[fixed]).all()


@cases
def test_workspace_conditions_match_the_reference_cases(case):
    inside = workspace(case["l1"], case["l2"], case["p"])
    assert dict(zip(VERDICTS, inside.tolist(), strict=True)) == case["workspace"]
    assert inside.all() == case["inside_workspace"]
    assert len(out_of_workspace(case["l1"], case["l2"], case["p"])) == 4 - sum(
        case["workspace"].values()
    )


@lengths
def test_fk_equals_the_product_of_the_document_matrices(l1, l2):
    for q in np.random.default_rng(1).uniform(-np.pi, np.pi, (20, 3)):
        q1, q2, q3 = q
        T = spbu_arm(l1, l2).fk(q).as_matrix()
        np.testing.assert_allclose(T, matrices(l1, l2, q), rtol=0, atol=1e-14)
        rho = l1 * np.sin(q2) + l2 * np.cos(q2 + q3)  # p* as printed
        wanted = np.cos(q1) * rho, np.sin(q1) * rho, l1 * np.cos(q2) - l2 * np.sin(q2 + q3)
        np.testing.assert_allclose(T[:3, 3], wanted, rtol=0, atol=1e-14)


def test_alpha_as_printed_in_the_text_puts_the_tool_below_the_floor():
    """Errata S0-a: alpha is +90 degrees in the text and -90 degrees in the matrices."""
    q = (0.3, 0.4, -0.2)
    assert spbu_arm(5, 4).fk(q).translation[2] == pytest.approx(3.810627646834, abs=1e-12)
    text = dh(q, (0, 5, 4), (RIGHT, 0, 0), (0, 0, 0), (0, -RIGHT, RIGHT))
    assert text[2, 3] == pytest.approx(-3.810627646834, abs=1e-12)


@lengths
@pytest.mark.parametrize("shape", SHAPES)
def test_ik_reaches_the_point_and_contains_the_original_joints(l1, l2, shape):
    arm = spbu_arm(l1, l2)
    q = np.random.default_rng(2).uniform(-np.pi, np.pi, (*shape, 3))
    points = arm.fk(q).translation
    rows = arm.ik(points)
    assert rows.shape == (*shape, 4, 3)
    assert turns(rows, q[..., None, :]).max(axis=-1).min(axis=-1).max() < 1e-7
    np.testing.assert_allclose(
        arm.fk(rows).translation,
        np.broadcast_to(points[..., None, :], rows.shape),
        rtol=0,
        atol=1e-13 * (l1 + l2),
    )
    turned = Transform(Quaternion.from_angle_axis(0.7, (1, 0, 0)), points)
    # the orientation does not matter, since this arm cannot choose it
    np.testing.assert_array_equal(arm.ik(turned), rows)


@lengths
def test_workspace_is_where_the_principal_branch_is_inside_its_limits(l1, l2):
    """Errata S0-b, S0-c: the inequalities are exact, and the one for l1 < l2 means q2 >= -90
    degrees.
    """
    arm, reach = spbu_arm(l1, l2), l1 + l2
    points = np.random.default_rng(3).uniform(-1.05 * reach, 1.05 * reach, (20_000, 3)) * [
        1,
        1,
        0.8,
    ]
    near = np.random.default_rng(4).normal(0, max(abs(l1 - l2), 0.1 * reach), (20_000, 3))
    points = np.concatenate([points, near])
    q = arm.ik(points)[:, 0]
    holds = workspace(l1, l2, points)
    wanted = within(arm, q).all(axis=-1) & (points[:, 2] >= 0)
    assert 1000 < wanted.sum() < 39_000
    assert (holds.all(axis=-1) == wanted).all()
    assert (holds[:, 0] == (np.linalg.norm(points, axis=-1) <= reach)).all()
    printed = points[:, 0] ** 2 + points[:, 1] ** 2 + points[:, 2] ** 2 >= (
        l2**2 - l1**2 - 2 * l1 * np.hypot(points[:, 0], points[:, 1])
    )
    assert (holds[:, 3] == (printed | (l1 >= l2))).all()
    flat = np.arctan2(points[:, 1], points[:, 0])
    np.testing.assert_allclose(q[wanted, 0], flat[wanted], rtol=0, atol=1e-12)
    sine = (l1**2 + l2**2 - (points**2).sum(axis=-1)) / (2 * l1 * l2)
    np.testing.assert_allclose(np.sin(q[wanted, 2]), sine[wanted], rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    "l1, l2, point, words",
    [
        (5, 4, (9, 0.1, 0), "is too far: 0.0005555 m beyond the reach of the arm, l1 + l2 = 9 m"),
        (5, 4, (1, 1, -0.25), "is under the floor: z = -0.25 m"),
        (
            5,
            4,
            (0.5, 0, 0.5),
            "is too close to the origin: |p| = 0.707106781 m is less than l1 - l2 = 1 m",
        ),
        (
            4,
            5,
            (0, 0.7071, 0.7071),
            "is too close to the origin: |p|^2 = 0.99998082 m^2 is less than "
            "l2^2 - l1^2 - 2 l1 rho = 3.3432 m^2",
        ),
    ],
)
def test_reason_for_an_unreachable_point_is_reported(l1, l2, point, words):
    assert out_of_workspace(l1, l2, point) == [words]


def test_all_reasons_are_listed():
    assert [text.split(":")[0] for text in out_of_workspace(5, 4, (0, 0, -20))] == [
        "is too far",
        "is under the floor",
    ]
    assert out_of_workspace(5, 4, (2, 3, 2)) == []


def test_two_solutions_may_be_inside_the_domain():
    """Errata S0-d: the domain does not make the solution unique."""
    arm = spbu_arm(5, 4)
    rows = arm.ik((0.1, 0, 5))
    assert within(arm, rows).all(axis=-1).tolist() == [True, False, True, False]
    np.testing.assert_allclose(rows[0], (0, -0.802949066383, 0.411244089936), rtol=0, atol=1e-12)
    assert turns(rows[2], (np.pi, -0.842943734330, 0.411244089936)).max() < 1e-12


@pytest.mark.parametrize(
    "l1, l2, point",
    [
        (0.1, 0.2, (0.1, 0.2, 0.2)),
        (5, 4, (9, 0, 0)),
        (5, 4, (0, 0, 9)),
        (5, 4, (0, 0, 1)),
        (4, 5, (0, 0, 3)),
        (4, 4, (0, 0, 0)),
        (5, 4, (0.6, 0.8, 0)),
        (1, 1.7, (0, -2.7, 0)),
    ],
)
def test_boundary_of_the_workspace_is_reachable(l1, l2, point):
    """Errata S0-l: because of rounding, the printed program refuses points that only the stretched
    arm reaches. It also fails at the origin (S0-k).
    """
    assert workspace(l1, l2, point).all()
    arm = spbu_arm(l1, l2)
    rows = arm.ik(point)
    assert within(arm, rows[0]).all()
    np.testing.assert_allclose(arm.fk(rows).translation, np.tile(point, (4, 1)), rtol=0, atol=1e-12)


@pytest.mark.parametrize("l1, l2", LENGTHS[:4])
def test_solutions_outside_the_workspace_are_nan(l1, l2):
    for direction in ((1, 0, 0), (0.6, 0, 0.8), (0, 0, 1)):
        beyond = np.multiply(direction, (l1 + l2) * (1 + 1e-9))
        assert workspace(l1, l2, beyond).tolist() == [False, True, True, True]
        assert np.isnan(spbu_arm(l1, l2).ik(beyond)).all()
        assert "beyond the reach of the arm" in explain(spbu_arm(l1, l2), beyond, 0)
    assert workspace(l1, l2, (1, 0, -1e-9)).tolist()[1] is False


@pytest.mark.parametrize("x", [0.0, -0.0])
@pytest.mark.parametrize("y", [0.0, -0.0])
def test_joint_1_is_0_on_axis_1_for_both_signs_of_zero(x, y):
    """Errata S0-p: atan2(0, -0.0) is pi."""
    rows = spbu_arm(5, 4).ik((x, y, 4.9))
    np.testing.assert_array_equal(rows[:, 0], [0, 0, np.pi, np.pi])
    assert np.isnan(principal_postures(5, 4, (x, y, 4.9))).tolist() == [True, False, False]
    assert spbu_arm(5, 4).ik((-1, y, 2))[0, 0] == np.pi == principal_postures(5, 4, (-1, y, 2))[0]


def test_free_joint_does_not_affect_other_rows_of_a_batch():
    """One point of the batch is where equal links fold onto joint 2."""
    arm = loader_arm(1, 1)
    points = np.array([(1, 0.3, 0.2), (0, 0, 0), (0.5, -1, 0.4)])
    rows = arm.ik(points)
    np.testing.assert_allclose(
        arm.fk(rows).translation, np.broadcast_to(points[:, None], (3, 4, 3)), atol=1e-12
    )
    np.testing.assert_array_equal(rows, [arm.ik(point) for point in points])


def test_invalid_arms_and_points_are_refused():
    for call, evidence in (
        (lambda: workspace(0, 4, (1, 1, 1)), "l1: wanted one positive length in metres, got 0"),
        (lambda: workspace(5, [4, 4], (1, 1, 1)), r"l2: .*\[4, 4\]"),
        (lambda: workspace(5, np.nan, (1, 1, 1)), "l2.*nan"),
        (lambda: workspace(5, 4, (1, 1)), r"points: wanted shape \(\.\.\., 3\), got \(2,\)"),
        (lambda: out_of_workspace(5, 4, [(1, 1, 1)] * 2), r"a single point \(3,\), got \(2, 3\)"),
        (lambda: spbu_arm(5, 4).ik((1, np.inf, 1)), "inf"),
        (lambda: spbu_arm(0, 4), "l1: wanted one positive length"),
        (lambda: spbu_arm(5, 0), "l2: wanted one positive length"),
    ):
        with pytest.raises(ValueError, match=evidence):
            call()


def test_only_joint_1_is_free_on_axis_1():
    for arm in (spbu_arm(2, 1), loader_arm(1, 0.8)):
        rows = arm.ik((0, 0, 1.5))
        near = np.array([0.7, 0.1, 0.2])
        kept = arm.geometry.choose_free_joints(rows, near)
        assert (kept[:, 0] == 0.7).all() and (kept[:, 1:] == rows[:, 1:]).all()
        assert np.allclose(arm.fk(kept).translation, [0, 0, 1.5], rtol=0, atol=3e-15)
        beside = arm.ik((1e-6, 0, 1.5))
        assert (arm.geometry.choose_free_joints(beside, near) == beside).all()
