"""The three-lever arm of source 003: reference cases, the family of postures, and the least
movement.
"""

import os

import numpy as np
import pytest
from machines import SHAPES, oracle

from robokin import Transform, deg, explain, follow, three_lever, two_link, within

CASES = oracle("planar3")["cases"]
SWEEPS = [case for case in CASES if case["kind"] == "sweep"]
FORWARD = [case for case in CASES if case["kind"] == "forward"]
UNREACHED = [case for case in CASES if case["kind"] == "invalid_range"]
TASKS = int(os.environ.get("ROBOKIN_TASKS", 2000))
EXAMPLE = oracle("examples")["planar3"]
ARM = three_lever(1.0)


def ours(angles):
    """The oracle's angles (alpha, beta, gamma) in our order, from the base outwards."""
    return np.array(angles, dtype=float)[..., ::-1]


def chain(L, q):
    """O, B, A, K as complex numbers: each lever is turned clockwise from the previous one by an
    interior angle.
    """
    gamma, beta, alpha = q
    first = L * np.exp(1j * gamma)
    second = -first * np.exp(1j * beta)
    third = -second * np.exp(1j * alpha)
    return np.cumsum([0, first, second, third])


def random_points(rng, shape, L=1.0):
    KO, phi = L * rng.uniform(1.0001, 2.9999, shape), rng.uniform(-np.pi, np.pi, shape)
    return np.stack([KO * np.cos(phi), KO * np.sin(phi)], axis=-1)


@pytest.mark.parametrize("case", SWEEPS)
def test_family_matches_the_rows_of_the_oracle(case):
    arm, K = three_lever(case["L"]), case["K"]
    low, high = arm.alpha_range(K, limited=False)
    assert low == pytest.approx(case["alpha_min"], abs=1e-12) and high == np.pi
    for row in case["rows"]:
        q = arm.family(K, row["alpha"])
        np.testing.assert_allclose(q, [row["gamma"], row["beta"], row["alpha"]], rtol=0, atol=1e-12)
        np.testing.assert_allclose(
            arm.points(q), [(0, 0), row["B"], row["A"], K], rtol=0, atol=1e-12
        )
        assert within(arm, q).all() == row["within_0_180"]


@pytest.mark.parametrize("case", SWEEPS)
def test_least_movement_matches_the_oracle(case):
    arm = three_lever(case["L"])
    q, S = arm.least(case["K"], ours(case["previous"]), limited=False)
    assert S == pytest.approx(case["cost"], abs=1e-12)
    np.testing.assert_allclose(q, ours(case["optimum"]), rtol=0, atol=1e-6)
    kept, _ = arm.least(case["K"], ours(case["previous"]))
    if case["gamma_in_range"]:
        np.testing.assert_allclose(kept, q, rtol=0, atol=1e-12)
    else:  # the limits of gamma increase S or exclude all postures
        assert np.isnan(kept).all() or (within(arm, kept).all() and abs(kept - q).max() > 1e-6)


@pytest.mark.parametrize("case", FORWARD)
def test_forward_kinematics_matches_the_oracle(case):
    arm, q = three_lever(case["L"]), ours(case["angles"])
    frames = arm.frames(q).translation
    B, A = frames[2], arm.frames(q)[2] @ arm.links[2].before.translation
    for found in ((B, A, frames[3]), arm.points(q)[1:], _pairs(chain(case["L"], q)[1:])):
        for point, name in zip(found, "BAK", strict=True):
            np.testing.assert_allclose(point[:2], case[name], rtol=0, atol=1e-12)
    assert frames[:, 2].tolist() == [0, 0, 0, 0]
    assert (arm.out_of_reach(case["K"]) == "" or "gamma" in arm.out_of_reach(case["K"])) == case[
        "valid_range"
    ]


@pytest.mark.parametrize("case", UNREACHED)
def test_target_out_of_reach_has_no_postures_and_gets_a_reason(case):
    arm = three_lever(case["L"])
    assert np.isnan(arm.family(case["K"], [1.0, 2.0, np.pi])).all()
    assert (
        np.isnan(arm.least(case["K"], [1.0, 1, 1])[0]).all()
        and np.isnan(arm.sweep(case["K"], [1.0, 1, 1])[0]).all()
    )
    assert len(arm.table(case["K"])) == 0
    words = {"KO<=L": "not farther than one lever", "KO>=3L": "farther than three levers"}[
        case["reason"]
    ]
    assert words in arm.out_of_reach(
        case["K"]
    ) and f"{case['distance'] * 1000:.1f} mm" in arm.out_of_reach(case["K"])


def test_worked_example_agrees_with_the_errata():
    """Errata S3-h: the result of the sweep is near the kink at beta = 110 degrees; the exact
    minimum is at the kink.
    """
    previous = ours(EXAMPLE["previous_deg"]) * deg
    q, S = ARM.least(EXAMPLE["target"], previous)
    assert S / deg == pytest.approx(18.300924618, abs=1e-9) == EXAMPLE["cost_deg"]
    np.testing.assert_allclose(q / deg, ours(EXAMPLE["optimum_deg"]), rtol=0, atol=1e-9)
    q, S = ARM.sweep(EXAMPLE["target"], previous, 0.01 * deg)
    assert S / deg == pytest.approx(18.304095438, abs=1e-9)
    np.testing.assert_allclose(q / deg, [85.225727, 110.007137, 123.522685], rtol=0, atol=1e-6)
    assert ARM.alpha_range(EXAMPLE["target"])[0] / deg == pytest.approx(
        EXAMPLE["alpha_min_deg"], abs=1e-12
    )


@pytest.mark.parametrize("shape", SHAPES)
def test_family_reaches_its_point_over_its_whole_range(shape):
    rng = np.random.default_rng(1)
    arm = three_lever(0.4)
    K = random_points(rng, shape, 0.4)
    low, high = arm.alpha_range(K, limited=False)
    alpha = low[..., None] + (high - low)[..., None] * np.linspace(0, 1, 301)
    q = arm.family(K[..., None, :], alpha)
    assert q.shape == (*shape, 301, 3)
    flange = arm.fk(q).translation
    np.testing.assert_allclose(
        flange[..., :2], np.broadcast_to(K[..., None, :], (*shape, 301, 2)), rtol=0, atol=1e-14
    )
    assert (q[..., 1:] >= 0).all() and (q[..., 1:] <= np.pi + 1e-12).all()
    np.testing.assert_allclose(q[..., 0, 1], np.pi, atol=1e-7)  # beta at alpha_min
    assert (np.diff(q[..., 0], axis=-1) > 0).all()  # gamma only increases
    assert np.isnan(arm.family(K, low - 1e-6)).all() and np.isnan(arm.family(K, high + 1e-6)).all()
    # a point with three coordinates and a Transform give the same result
    for i in np.ndindex(*shape):
        point = np.append(K[i], 0.0)
        for same in (point, Transform(translation=point)):
            np.testing.assert_array_equal(arm.family(same, alpha[i]), q[i])
    # if the range with limited gamma is not empty, it contains exactly the alphas for which all
    # angles are between 0 and 180 degrees
    low, high = arm.alpha_range(K)
    with np.errstate(invalid="ignore"):
        inside = (alpha > low[..., None] + 1e-9) & (alpha < high[..., None] - 1e-9)
        outside = ~((alpha > low[..., None] - 1e-9) & (alpha < high[..., None] + 1e-9))
    marked = within(arm, q).all(axis=-1)
    assert marked[inside].all() and not marked[outside].any()


@pytest.mark.parametrize("L", [1.0, 0.3])
def test_target_near_the_stretched_arm_is_reached_accurately(L):
    arm = three_lever(L)
    direction = np.array([np.cos(2.0), np.sin(2.0)])
    q, S = arm.least(3 * L * direction, [2.0, 3.0, 3.0])
    np.testing.assert_allclose(q, [2.0, np.pi, np.pi], atol=1e-7)
    for gap in (1e-3, 1e-6, 1e-9, 1e-12):
        K = (3 - gap) * L * direction
        q = arm.family(K, np.mean(arm.alpha_range(K)))
        np.testing.assert_allclose(arm.points(q)[3], K, rtol=0, atol=2e-14)
    assert np.isnan(arm.family((3 + 1e-9) * L * direction, np.pi)).all()
    assert np.isnan(arm.family(L * direction, np.pi)).all()  # the document excludes KO = L


@pytest.mark.parametrize("limited", [True, False])
def test_exact_minimum_is_never_above_the_result_of_a_sweep(limited):
    rng = np.random.default_rng(2)
    n = 5 * TASKS // 2  # 5000 tasks for each parameter by default
    K, previous = random_points(rng, n), rng.uniform(0, np.pi, (n, 3))
    q, S = ARM.least(K, previous, limited)
    exists = ~np.isnan(S)
    assert exists.all() if not limited else 0.5 < exists.mean() < 0.9
    np.testing.assert_allclose(ARM.fk(q[exists]).translation[:, :2], K[exists], rtol=0, atol=1e-13)
    np.testing.assert_allclose(abs(q - previous).sum(axis=-1), S, rtol=0, atol=1e-13)
    assert within(ARM, q[exists]).all() or not limited
    above = (
        np.array(
            [ARM.sweep(*task, 0.01 * deg, limited)[1] for task in zip(K, previous, strict=True)]
        )
        - S
    )
    assert (np.isnan(above) >= ~exists).all() and np.isnan(above).sum() <= (
        ~exists
    ).sum() + n / 1000
    assert np.nanmin(above) > -1e-14
    # in one step of alpha, each angle changes by at most three times the step, so the two results
    # are close to each other
    assert 0 < np.nanmax(above) < 0.05 * deg and np.nanmedian(above) < 0.005 * deg


def test_exact_minimum_between_the_kinks_is_found():
    """At this minimum all three angles change, and alpha is not at an end of its range."""
    K, previous = np.array([1.8, 0.6]), np.array([175, 30, 40]) * deg
    q, S = ARM.least(K, previous, limited=False)
    low, high = ARM.alpha_range(K, limited=False)
    assert low + 0.1 < q[2] < high - 0.1 and abs(q - previous).min() > 0.1
    alpha = q[2] + np.linspace(-0.01, 0.01, 2001)
    around = abs(ARM.family(K, alpha) - previous).sum(axis=-1)
    assert around.min() > S - 1e-14 and around[[0, -1]].min() > S + 1e-6


def test_batch_matches_single_tasks():
    rng = np.random.default_rng(3)
    K, previous = random_points(rng, (4, 5)), rng.uniform(0, np.pi, (5, 3))
    q, S = ARM.least(K, previous)
    assert q.shape == (4, 5, 3) and S.shape == (4, 5)
    for i in np.ndindex(4, 5):
        one, cost = ARM.least(K[i], previous[i[1]])
        np.testing.assert_allclose(one, q[i], rtol=0, atol=1e-7)
        np.testing.assert_allclose(cost, S[i], rtol=0, atol=1e-13)


def test_table_matches_table_3_of_the_document():
    K, step = (1.5, 1.0), 0.01 * deg
    rows = ARM.table(K, step, limited=False)
    assert rows[0, 2] / deg == pytest.approx(64.055520228, abs=1e-9)  # errata S3-e, row 1
    # row 2: the step is added outside the arccos
    assert rows[1, 2] / deg == pytest.approx(64.065520228, abs=1e-9)
    assert 180 - 0.01 < rows[-1, 2] / deg <= 180 and len(rows) == 11595
    # errata S3-d
    assert np.cos(ARM.family(K, np.pi)[0] - np.arctan2(1.0, 1.5)) == pytest.approx(
        0.0693375245, abs=1e-10
    )
    # errata S3-g: nearly every row has gamma > 180 degrees
    K = 2 * np.array([np.cos(150 * deg), np.sin(150 * deg)])
    share = len(ARM.table(K)) / len(ARM.table(K, limited=False))
    assert share == pytest.approx(0.0105, abs=5e-4)  # the errata give 1.05 %, from a coarser table
    K = 2 * np.array([np.cos(170 * deg), np.sin(170 * deg)])
    assert len(ARM.table(K)) == 0 and "gamma outside" in ARM.out_of_reach(K)


def test_a_redundant_arm_has_no_ik():
    assert not any(hasattr(ARM, name) for name in ("ik", "branch", "branches"))
    with pytest.raises(TypeError, match="arm: wanted a ClosedFormArm, got Arm"):
        explain(ARM, (1.5, 1, 0), 0)


def test_follow_accepts_the_family_as_rows():
    """At each sample of a path, `follow` chooses the posture with the least movement among the
    given ones.
    """
    K = np.linspace((1.8, 0.6), (1.2, 1.4), 40)
    rows = ARM.family(K[:, None], np.linspace(80, 180, 201) * deg)
    q = follow(ARM, rows, 100)
    np.testing.assert_allclose(ARM.fk(q).translation[:, :2], K, atol=1e-12)
    assert abs(np.diff(q, axis=0)).max() < 3 * deg


@pytest.mark.parametrize(
    "call, words",
    [
        (lambda: three_lever(0), "positive length"),
        (lambda: three_lever([1, 1]), "one positive length in metres, or three"),
        (lambda: three_lever([1, 1, 0]), "positive length"),
        (lambda: three_lever(np.ones((2, 3))), r"array of shape \(2, 3\)"),
        (lambda: ARM.family((1, 2, 3, 4), 2.0), r"\(4,\)"),
        (lambda: ARM.family(np.ones((4, 2)), np.ones(3)), r"\(4,\) and \(3,\)"),
        (lambda: ARM.sweep(np.ones((4, 2)), np.ones(3)), "single point"),
        (lambda: ARM.sweep((1.5, 1), np.ones(3), 0), "step"),
        (lambda: ARM.sweep((1.5, 1), np.ones(2)), r"previous.*\(2,\)"),
        (lambda: ARM.least((1.5, np.nan), np.ones(3)), "nan"),
    ],
)
def test_errors_name_the_invalid_argument(call, words):
    with pytest.raises(ValueError, match=words):
        call()


def test_points_off_the_plane_are_out_of_reach():
    assert np.isnan(ARM.family((1.5, 1, 0.1), 2.0)).all() and "off the plane" in ARM.out_of_reach(
        (1.5, 1, 0.1)
    )


@pytest.mark.parametrize("way", [(0.0, 0, 1), (1.0, 0, 0)], ids=["height", "distance"])
def test_out_of_reach_reason_agrees_with_the_postures(way):
    """The test finds the last reachable point upwards or outwards by bisection."""

    def at(far):
        return np.array([1.5, 0, 0]) + far * np.array(way)

    low, high = 0.0, 4.0
    while low < (middle := (low + high) / 2) < high:
        reached = not np.isnan(ARM.least(at(middle), np.ones(3))[0]).any()
        low, high = (middle, high) if reached else (low, middle)
    assert 0 < low and high == np.nextafter(low, 5)
    assert ARM.out_of_reach(at(low)) == "" != ARM.out_of_reach(at(high))


def _pairs(points):
    return np.stack([points.real, points.imag], axis=-1)


def test_out_of_reach_and_the_family_agree_at_the_workspace_boundary():
    L = ARM.lever
    for KO in (L, L * (1 + 1e-13), L * (1 + 1e-9), 3 * L, 3 * L * (1 + 5e-13), 3 * L * (1 + 1e-9)):
        for angle in (0.3, 1.2, 2.0):
            K = KO * np.array([np.cos(angle), np.sin(angle)])
            low, high = ARM.alpha_range(K)
            assert (ARM.out_of_reach(K) == "") == bool(low <= high), (KO, angle)
    assert ARM.out_of_reach((0, 3 * L * (1 + 5e-13))) == ""


def test_plane_tolerance_is_the_rounding_error_of_the_arm():
    """A point that is off the plane by less than 1e-12 times the reach counts as on it, for an arm
    of any size.
    """
    for size in (1e-3, 1.0, 1e3):
        two, three = two_link(size, size), three_lever(size)
        assert not np.isnan(two.ik((size, 0, 1e-12 * size))).any()
        assert np.isnan(two.ik((size, 0, 3e-12 * size))).all()
        assert not np.isnan(three.family((2 * size, size, 0.5e-12 * size), 2.5)).any()
        assert np.isnan(three.family((2 * size, size, 3e-12 * size), 2.5)).all()


def test_sweep_keeps_gamma_within_its_limits_by_default():
    """Without the limits, some points have a nearer posture with gamma outside 0 to 180 degrees."""
    previous = np.array([0.0, 90, 120]) * deg
    better = 0
    for K in np.random.default_rng(5).uniform(-2.5, 2.5, (200, 2)) * ARM.lever:
        q, S = ARM.sweep(K, previous, step=0.5 * deg)
        free, less = ARM.sweep(K, previous, step=0.5 * deg, limited=False)
        if not np.isnan(S):
            assert -1e-9 <= q[0] <= np.pi + 1e-9 and less <= S
            better += less < S - 1e-9
    assert better > 5
    with pytest.raises(ValueError, match="previous: wanted one posture"):
        ARM.sweep((1, 1), np.zeros((2, 3)))


def test_a_table_of_billions_of_rows_is_refused_with_its_size():
    with pytest.raises(ValueError, match=r"at most 2000000 rows, got 1e-09: [12]\.\d+e\+09 rows"):
        ARM.table((1.5 * ARM.lever, ARM.lever), step=1e-9)
    assert len(ARM.table((1.5 * ARM.lever, ARM.lever), step=0.001 * deg)) > 10_000


def test_angles_in_degrees_cause_a_warning():
    with pytest.warns(UserWarning, match="previous: 120 rad is many turns"):
        ARM.least((1.5 * ARM.lever, ARM.lever), [100, 110, 120])


def test_no_posture_of_the_family_needs_less_movement_than_the_exact_minimum():
    """Brute force: 400 targets and postures, each compared with 20 001 postures of its family."""
    rng = np.random.default_rng(17)
    L = ARM.lever
    K = ARM.points(rng.uniform(0, np.pi, (400, 3)))[:, 3]
    K = K[np.hypot(*K.T) > 1.001 * L]
    before = rng.uniform(0, np.pi, (len(K), 3))
    for limited in (False, True):
        low, high = ARM.alpha_range(K, limited)
        q, S = ARM.least(K, before, limited)
        alphas = np.linspace(low, high, 20_001)
        rows = ARM.family(K, alphas)
        sums = abs(rows - before).sum(-1)
        reached = ~np.isnan(low)
        assert (np.nanmin(sums[:, reached], axis=0) > S[reached] - 1e-9).all()
        assert (np.nanmin(sums[:, reached], axis=0) < S[reached] + 1e-3).all()
        assert np.isnan(S[~reached]).all() and np.isnan(q[~reached]).all()
        assert np.allclose(ARM.fk(q[reached]).translation[:, :2], K[reached], rtol=0, atol=1e-12)


@pytest.mark.parametrize("lengths", [1.0, (0.9, 1.1, 0.6)])
def test_alpha_range_has_two_ends_or_none(lengths):
    """Regression: with gamma below 0 along the whole family, the range had an upper end but no
    lower one.
    """
    arm = three_lever(lengths)
    KO, phi = np.meshgrid(np.linspace(0, 3.2, 60), np.linspace(-np.pi, np.pi, 60))
    K = np.stack([KO * np.cos(phi), KO * np.sin(phi)], axis=-1)
    low, high = arm.alpha_range(K)
    np.testing.assert_array_equal(np.isnan(low), np.isnan(high))
    alphas = np.linspace(*arm.alpha_range(K, limited=False), 200)
    gamma = arm.family(K, alphas)[..., 0]
    served = ((gamma > 0) & (gamma < np.pi)).any(axis=0)
    assert served.any() and not np.isnan(low[served]).any()


# --- Levers of different lengths ------------------------------------------------------------------

LENGTHS = np.random.default_rng(31).uniform(0.2, 1.5, (12, 3))
LENGTHS[0], LENGTHS[1], LENGTHS[2] = (0.9, 1.1, 0.6), (1.0, 1.2, 0.3), (0.3, 0.4, 2.0)
unequal = pytest.mark.parametrize("lengths", LENGTHS, ids=lambda each: str(each.round(2)))


def turning(lengths, q):
    """B, A, K as complex numbers (3, ...), like `chain`, but for any lengths and batches."""
    gamma, beta, alpha = np.moveaxis(q, -1, 0)
    turns = np.stack([np.exp(1j * gamma), -np.exp(1j * beta), -np.exp(1j * alpha)])
    levers = np.reshape(lengths, (3,) + (1,) * gamma.ndim) * np.cumprod(turns, axis=0)
    return np.cumsum(levers, axis=0)


def ring(rng, lengths, n):
    a, b, c = lengths
    KO, phi = rng.uniform(abs(a - b) + c, a + b + c, n), rng.uniform(-np.pi, np.pi, n)
    return np.stack([KO * np.cos(phi), KO * np.sin(phi)], axis=-1)


def test_equal_levers_can_be_given_as_one_length():
    one, three = three_lever(0.3), three_lever((0.3, 0.3, 0.3))
    rng = np.random.default_rng(32)
    K, before = random_points(rng, 500, 0.3), rng.uniform(0, np.pi, (500, 3))
    for mine, same in zip(one.least(K, before), three.least(K, before), strict=True):
        np.testing.assert_array_equal(mine, same)
    assert one.lever == three.lever == 0.3 and one.levers.tolist() == [0.3] * 3
    assert three_lever((1, 2, 6)).lever == 3 and three_lever((1, 2, 6)).reach == 9


@unequal
def test_unequal_levers_reach_their_targets(lengths):
    arm, rng = three_lever(lengths), np.random.default_rng(33)
    K = ring(rng, lengths, 300)
    low, high = arm.alpha_range(K, limited=False)
    q = arm.family(K[:, None], low[:, None] + (high - low)[:, None] * np.linspace(0, 1, 101))
    assert (q[..., 1:] >= 0).all() and (q[..., 1:] <= np.pi + 1e-12).all()
    there = turning(lengths, q)[-1]
    assert abs(there - (K @ [1, 1j])[:, None]).max() < 1e-13
    assert abs(arm.fk(q).translation[..., :2] - K[:, None]).max() < 1e-13
    points = turning(lengths, q)
    np.testing.assert_allclose(arm.points(q)[..., 1:, :], _pairs(np.moveaxis(points, 0, -1)))
    assert (np.diff(q[..., 0], axis=-1) > 0).all()


@unequal
def test_range_of_alpha_for_unequal_levers_follows_from_the_triangle(lengths):
    """The highest alpha is 180 degrees; at the lowest, OA is as long as OB and BA together; if K is
    too near for that, the lowest alpha is 0.
    """
    (a, b, c), rng = lengths, np.random.default_rng(34)
    arm, K = three_lever(lengths), ring(rng, lengths, 400)
    KO = np.hypot(*K.T)
    low, high = arm.alpha_range(K, limited=False)
    KB = np.sqrt(b**2 + c**2 - 2 * b * c * np.cos(low))
    assert (high == np.pi).all() and (KB <= a + KO + 1e-9).all() and (a <= KB + KO + 1e-9).all()
    stretched = KO > a + b - c
    cosine = ((a + b) ** 2 + c**2 - KO**2)[stretched] / (2 * (a + b) * c)
    np.testing.assert_allclose(np.cos(low[stretched]), cosine, rtol=0, atol=1e-13)
    assert (low[~stretched] == 0).all()
    assert stretched.all() == (c >= min(a, b)) or stretched.mean() > 0.9
    assert np.isnan(arm.family(K, low - 1e-6)).all() and np.isnan(arm.family(K, high + 1e-6)).all()
    kept = np.stack(arm.alpha_range(K), axis=-1)
    alphas = low + (high - low) * np.linspace(0, 1, 2001)[:, None]
    marked = within(arm, arm.family(K, alphas)).all(axis=-1)
    with np.errstate(invalid="ignore"):
        assert marked[(alphas > kept[:, 0] + 1e-9) & (alphas < kept[:, 1] - 1e-9)].all()
        left = (alphas > kept[:, 0] - 1e-9) & (alphas < kept[:, 1] + 1e-9)
    assert not marked[~left].any() and 0.2 < marked.mean() < 0.9


@unequal
def test_every_posture_of_unequal_levers_is_in_the_family(lengths):
    """If K is farther away than |OB - BA| + AK, every posture with angles between 0 and 180 degrees
    is the family's posture at its alpha; if K is nearer, some are not.
    """
    arm, rng = three_lever(lengths), np.random.default_rng(35)
    q = rng.uniform(0, np.pi, (20_000, 3))
    K = _pairs(turning(lengths, q)[-1])
    far = np.hypot(*K.T) > abs(lengths[0] - lengths[1]) + lengths[2]
    found = arm.family(K[far], q[far, 2])
    turns = abs((found - q[far] + np.pi) % (2 * np.pi) - np.pi)
    assert far.sum() > 1000 and turns.max() < 1e-5 and np.median(turns) < 1e-14
    assert np.isnan(arm.family(K[~far], q[~far, 2])).all()
    # if B is on the other side of OK, K is always nearer than |OB - BA| + AK, but can be close to
    # it
    q[:, 1] *= 0.05
    q[:, 2] *= 0.05
    q[::2, 2] = np.pi - q[::2, 2]
    B, _, K = turning(lengths, q)
    other = abs(K[(K.conj() * B).imag < 0]) / arm.geometry.inner
    assert 0.98 < other.max() <= 1 + 1e-12


@unequal
def test_no_posture_of_unequal_levers_needs_less_movement_than_the_exact_minimum(lengths):
    """Brute force: 100 targets and postures, each compared with 8001 postures of its family."""
    arm, rng = three_lever(lengths), np.random.default_rng(36)
    K, before = ring(rng, lengths, 100), rng.uniform(0, np.pi, (100, 3))
    for limited in (False, True):
        low, high = arm.alpha_range(K, limited)
        q, S = arm.least(K, before, limited)
        reached = ~np.isnan(low)
        sums = abs(arm.family(K, np.linspace(low, high, 8001)) - before).sum(-1)[:, reached]
        assert (sums.min(axis=0) > S[reached] - 1e-13).all()
        assert (sums.min(axis=0) < S[reached] + 0.02).all()
        assert np.isnan(S[~reached]).all() and np.isnan(q[~reached]).all() and reached.sum() > 20
        assert abs(arm.fk(q[reached]).translation[:, :2] - K[reached]).max() < 1e-12
        np.testing.assert_allclose(abs(q - before).sum(axis=-1), S, rtol=0, atol=1e-13)


def test_minimum_that_occurs_only_with_unequal_levers_is_found():
    """gamma - beta + alpha has its minimum inside this family, where all three angles change."""
    arm, K = three_lever((1.313, 0.534, 0.247)), np.array([1.057, 0.0])
    low, high = arm.alpha_range(K, limited=False)
    rows = arm.family(K, np.linspace(low, high, 20_001))
    level = (rows @ [1, -1, 1]).argmin()
    assert 100 < level < 19_900
    before = rows[level] + [-0.2, 0.2, -0.2]  # so that S is that sum plus a constant near this row
    q, S = arm.least(K, before, limited=False)
    sums = abs(rows - before).sum(axis=-1)
    assert abs(q - before).min() > 1e-3 and sums.min() - 1e-7 < S <= sums.min()
    assert abs(q - rows[sums.argmin()]).max() < 1e-3


def test_batch_of_tasks_for_unequal_levers_matches_single_tasks():
    arm, rng = three_lever((0.9, 1.1, 0.6)), np.random.default_rng(37)
    K, before = ring(rng, (0.9, 1.1, 0.6), 2300), rng.uniform(0, np.pi, (2300, 3))
    S = arm.least(K, before)[1]
    for i in range(0, 2300, 230):
        np.testing.assert_allclose(arm.least(K[i], before[i])[1], S[i], rtol=0, atol=1e-13)
    assert arm.least(K.reshape(10, 230, 2), before[0])[0].shape == (10, 230, 3)


def test_reason_is_given_for_points_that_unequal_levers_cannot_reach():
    arm = three_lever((0.9, 1.1, 0.6))
    assert "not farther than |OB \N{MINUS SIGN} BA| + AK (800.0 mm)" in arm.out_of_reach((0.8, 0))
    assert "farther than three levers (2600.0 mm)" in arm.out_of_reach((0, 2.61))
    assert arm.out_of_reach((0, 2.59)) == arm.out_of_reach((0.81, 0)) == ""
    assert len(arm.table((1.5, 1.0), step=1 * deg)) > 50
