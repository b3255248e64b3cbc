"""Statements that a second group of readers refuted, checked by a second calculation."""

import re
from itertools import pairwise, product
from math import comb

import numpy as np
import pytest
from conftest import NOTEBOOKS
from test_true_statements_b import (
    ARM,
    DISTANCE,
    asked,
    cells,
    direct,
    least_distance,
    lever_distance,
    tries,
)
from test_true_statements_b import run as run_cells
from test_true_statements_c import flat, numbers, shown

from robokin import (
    IRB140,
    ITMO6R,
    PUMA560,
    SCARA,
    Arm,
    Quaternion,
    ScaraPose,
    Transform,
    blend,
    deg,
    lin,
    loader_arm,
    mm,
    spbu_arm,
    three_lever,
    within,
)
from robokin.course import book
from robokin.jobs.obstacles import clearance, in_quadrilateral, plan, via_path
from robokin.jobs.steppers import (
    Stepper,
    counts,
    energised,
    phases,
    ramp,
    station_postures,
    straight,
    synchronised,
    unsynchronised,
)
from robokin.jobs.visit_collect import Task, TaskError, principal_postures

LINE = book.lab("puma560_branches").module("predictions")
LOADER = loader_arm(450 * mm, 300 * mm)
LEVERS = book.lab("three_levers").module("predictions")
sampled_tasks = book.lab("obstacle_avoidance").module("predictions")["sampled_tasks"]
START_10, K1_10 = ARM.family((1.2, 1.7), 118 * deg), (1.9, 0.3)  # of lab 10


def about(axis, angle):
    """A rotation by Rodrigues' formula."""
    K = np.cross(np.eye(3), np.asarray(axis) / np.linalg.norm(axis))
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def written(lab):
    """The text of all exercise files of a lab, on one line."""
    (ours,) = [NOTEBOOKS / "exercises" / lab]
    files = [*ours.glob("*.md"), *(ours.parents[2] / "robokin" / "course").glob(f"{lab}.py")]
    text = " ".join(each.read_text(encoding="utf-8") for each in files)
    return re.sub(r"\s+", " ", re.sub(r'"\s+"', "", text))


def apart(R, S):
    """The angle between two rotations."""
    return np.arccos(np.clip((np.trace(R.T @ S) - 1) / 2, -1, 1))


# --- Labs 00 to 03 --------------------------------------------------------------------------------


def test_every_lab_marks_values_to_change_with_a_try_comment():
    assert "**Look at** tells you where to look, and `# try` tells you what to change" in flat(
        "00", "how"
    )
    for lab in range(15):
        assert any("# try" in text for text in cells(f"{lab:02}").values()), lab


def test_angles_can_be_interpolated_if_only_one_of_them_changes():
    says = "That is right if just one of the three angles changes, by less than half a turn"
    assert says in written("frames_and_quaternions")
    rng = np.random.default_rng(1)

    def turned(roll, pitch, yaw):
        return about([0, 0, 1], yaw) @ about([0, 1, 0], pitch) @ about([1, 0, 0], roll)

    def middle(one, two):
        return turned(*(one + two) / 2)

    for _ in range(30):
        one = rng.uniform([-3, -1.5, -3], [3, 1.5, 3])
        for k in range(3):
            two = one.copy()
            two[k] = rng.uniform(-1.5, 1.5) if k == 1 else one[k] + rng.uniform(-3.1, 3.1)
            whole = apart(turned(*one), turned(*two))
            half = middle(one, two)
            assert apart(turned(*one), half) == pytest.approx(whole / 2, abs=1e-6)
            assert apart(half, turned(*two)) == pytest.approx(whole / 2, abs=1e-6)
    # the second triple of angles is a rotation by 120 degrees about y
    back = np.array([0, 0, 0.0]), np.array([np.pi, np.pi / 3, np.pi])
    assert apart(turned(*back[1]), about([0, 1, 0], 2 * np.pi / 3)) < 1e-6
    assert apart(middle(*back), about([0, 1, 0], np.pi / 3)) > 60 * deg


def test_statements_on_scalar_parts_speed_jumps_and_parallel_axes_are_true():
    told = "At φ = 90°. Otherwise, part of $v$ is parallel to the axis, and $q\\,v$ has a real"
    assert f"{told} part." in flat("01", "turning-why")
    u, q = np.array([1, 2, 2]) / 3, 0.4
    for point in ([2.0, -1, 0], [0.3, 1, 2]):
        length = np.linalg.norm(point)
        way = Quaternion([0, *(np.array(point) / length)])
        real, *vector = (Quaternion([np.cos(q), *(np.sin(q) * u)]) @ way).wxyz * length
        assert (abs(real) < 1e-12) == (abs(u @ point) < 1e-12)
        assert real**2 + (u @ vector) ** 2 == pytest.approx((u @ point) ** 2)
    assert "Every speed except that of joint 4 jumps" in flat("01", "line-look")
    assert "q4 0%" in shown("01", "line-code") and "q5 0%" not in shown("01", "line-code")
    _, options, _ = asked("frames_and_quaternions.p4")
    assert any("The IRB-140's shoulder and elbow axes are parallel" in o.second for o in options)
    for q in np.random.default_rng(2).uniform(-1, 1, (5, 6)):
        frames = IRB140.frames(q).rotation.as_matrix()
        turns = []
        for k in (1, 2):
            more = IRB140.fk(q + 1e-6 * np.eye(6)[k]).rotation.as_matrix()
            W = (more - frames[-1]) @ frames[-1].T / 1e-6
            turns.append([W[2, 1], W[0, 2], W[1, 0]])
        assert np.linalg.norm(np.cross(*turns)) < 1e-5


def hamilton(a, b):
    """Return the product of two quaternions, computed with Hamilton's table of i, j and k."""
    table = [
        [(0, 1), (1, 1), (2, 1), (3, 1)],
        [(1, 1), (0, -1), (3, 1), (2, -1)],
        [(2, 1), (3, -1), (0, -1), (1, 1)],
        [(3, 1), (2, 1), (1, -1), (0, -1)],
    ]
    found = np.zeros(4)
    for x, row in zip(a, table, strict=True):
        for y, (unit, sign) in zip(b, row, strict=True):
            found[unit] += sign * x * y
    return found


def test_each_step_of_the_derivation_of_rodrigues_formula_is_true():
    words = flat("01", "turning-why")
    rng = np.random.default_rng(6)
    assert r"$q\,v_\perp = c\,v_\perp + s\,n \times v_\perp$. This has no real part" in words
    assert r"$v_\perp n = -n\,v_\perp$, we have $v_\perp q^* = v_\perp (c - s\,n)" in words
    assert r"= (c + s\,n)\,v_\perp = q\,v_\perp$. So the factor on the right" in words
    assert r"$q\,v_\parallel = c\,v_\parallel - s\,(n \cdot v)$ has a real part" in words
    assert "1. By θ/2." in words and "3. At 720°. At 360°, $q$ is −1." in words
    for theta in [*rng.uniform(0, 4 * np.pi, 20), 2 * np.pi, 4 * np.pi]:
        n, v = rng.normal(size=(2, 3))
        n /= np.linalg.norm(n)
        c, s = np.cos(theta / 2), np.sin(theta / 2)
        q, back = np.array([c, *(s * n)]), np.array([c, *(-s * n)])
        parallel, across = (n @ v) * n, v - (n @ v) * n
        half = [0, *(about(n, theta / 2) @ across)]
        assert hamilton(q, [0, *across]) == pytest.approx(half)
        assert half[1:] == pytest.approx(c * across + s * np.cross(n, across))
        assert hamilton([0, *across], back) == pytest.approx(half)
        assert hamilton(q, [0, *parallel]) == pytest.approx([-s * (n @ v), *(c * parallel)])
        whole = [0, *(about(n, theta) @ v)]
        assert hamilton(hamilton(q, [0, *v]), back) == pytest.approx(whole, abs=1e-12)
    assert q == pytest.approx([1, 0, 0, 0], abs=1e-12)  # after two turns, but not after one
    assert np.cos(360 * deg / 2) == -1


def test_the_pointers_agree_three_times_and_nlerp_is_faster_in_the_middle():
    says = "They agree at the start, halfway and at the end. In the middle, *nlerp* is faster;"
    assert says in flat("01", "slerp-look")
    s = np.linspace(0, 1, 121)
    goals = cells("01")["pointers"].split("goals, share_of_way = np.array([")[1].split("]")[0]
    for goal in map(float, goals.split(",")):
        end = about([0, 0, 1], goal * deg)
        even = [apart(np.eye(3), about([0, 0, 1], share * goal * deg)) for share in s]
        half = goal * deg / 2
        chord = 2 * np.arctan2(s * np.sin(half), 1 - s + s * np.cos(half))
        off = chord - even
        assert apart(np.eye(3), end) == pytest.approx(chord[-1], abs=1e-6)
        assert off[[0, 60, 120]] == pytest.approx([0, 0, 0], abs=1e-6)
        assert (off[1:60] < 0).all() and (off[61:120] > 0).all()
        assert np.gradient(chord, s)[60] > 1.02 * goal * deg


def test_moving_the_tip_along_base_x_is_right_only_if_the_tool_points_that_way():
    says = "along the base's x axis. That is right only while the tool points along this axis."
    assert says in written("irb140_kinematics")
    assert (
        flat("02", "short").count("We compute every angle except that of joint 3 with atan2.") == 1
    )
    for q, right in (([0, 30, 30, 0, 0, 25], True), ([0] * 6, True), ([0, 30, 0, 0, 0, 0], False)):
        q = np.array(q) * deg
        flange = IRB140.fk(q)
        ahead = flange.rotation.as_matrix()[:, 2]
        assert (np.linalg.norm(ahead - [1, 0, 0]) < 1e-9) == right
        tip = (flange @ Transform(translation=[0, 0, 0.2])).translation
        off = np.linalg.norm(tip - (flange.translation + [0.2, 0, 0]))
        assert (off < 1e-9) == right


def test_one_shoulder_reaches_poses_that_the_other_does_not():
    says = "the wrist centre is too far from this shoulder ($d > l_2 + l_3$) or too near ($d < l_3"
    assert says in flat("02", "triangle")
    down = Quaternion.from_angle_axis(np.pi, [1, 0, 0])
    for height, wanted in ((500, (True, False)), (352 - 65, (False, True))):
        fronts = set()
        for x in np.linspace(0.05, 0.9, 86):
            rows = np.isfinite(IRB140.ik(Transform(down, [x, 0, height * mm]))).all(axis=1)
            fronts.add((rows[:4].any(), rows[4:].any()))
        assert wanted in fronts


def test_shorter_intervals_do_not_show_smaller_changes():
    _, options, _ = asked("irb140_motion.p5")
    reason = " ".join(options[0].reason.split())
    assert reason.endswith(
        "to the next, and it changes by the same amount if the intervals are shorter."
    )
    (said,) = numbers(r"changes by ([\d.]+)°/s", reason)
    rows = [
        line.split() for line in shown("03", "diff-halve").splitlines() if "speed jumps" in line
    ]
    changes = [float(row[4].removesuffix("°/s")) for row in rows]
    assert changes == sorted(changes) and any(round(each, 1) == said for each in changes)
    least, most = numbers(r"joint 3 jumps by (\S+) to ([\d.]+)°/s", flat("03", "corner-worth"))
    assert [round(changes[0], 1), round(changes[-1], 1)] == [least, most]
    made = book.find("irb140_motion.p5", "predictions").facts()
    assert made["change"] == pytest.approx(changes[1], abs=1e-3)
    assert "A number that doubles is a jump divided by the step" in flat("03", "short")
    told = "the greatest acceleration of the tool in the quintic corner is 1.5 times that in the"
    assert f"At the same blend, {told} parabola." in written("irb140_motion")
    # x is the parameter of the corner; the control points are fractions of the path to via
    x = np.linspace(0, 1, 1001)
    peaks = []
    for controls in ([0, 1, 0], [0, 0.4, 0.8, 0.8, 0.4, 0]):
        n, bends = len(controls) - 1, np.diff(controls, 2)
        weights = [comb(n - 2, k) * x**k * (1 - x) ** (n - 2 - k) for k in range(n - 1)]
        peaks.append(abs(n * (n - 1) * bends @ weights).max())
    assert peaks[1] == pytest.approx(1.5 * peaks[0])


# --- Labs 04 to 06 --------------------------------------------------------------------------------


def test_light_grey_areas_of_the_zone_belong_to_the_stated_elbows():
    assert (
        "to the left (elbow +1, row 0) or to the right (−1). Both elbows reach the dark grey area. "
        "Only +1 reaches the light grey area at the upper left, and only −1 the one at the lower "
        "left." in flat("04", "able")
    )
    assert SCARA.branch(+1) == 0
    across = np.arange(-449, 450, 2.0) * mm
    x, y = np.meshgrid(across, across)
    grid = ScaraPose(np.stack([x, y, 0.1 + 0 * x], axis=-1))
    inside = within(SCARA, SCARA.ik(grid)).all(axis=-1)
    for row, side in ((0, 1), (1, -1)):
        alone = inside[..., row] & ~inside[..., 1 - row]
        assert alone.sum() > 20000 and (side * y[alone] > 0).all()
        assert x[alone].mean() < -100 * mm


def test_only_the_arms_length_limits_the_reach_in_front():
    words = "In front, only the length of the arm limits the outer edge."
    assert words in flat("04", "zone-how")
    low, high = SCARA.limits[:2].T
    l1, l2 = 0.2, 0.25

    def served(x, y):
        for elbow in (1, -1):
            q2 = elbow * np.arccos(np.clip((x * x + y * y - l1**2 - l2**2) / (2 * l1 * l2), -1, 1))
            q1 = np.arctan2(y, x) - np.arctan2(l2 * np.sin(q2), l1 + l2 * np.cos(q2))
            q = (np.array([q1, q2]) + np.pi) % (2 * np.pi) - np.pi
            if ((low - 1e-9 <= q) & (q <= high + 1e-9)).all():
                return True
        return False

    for r in np.linspace(0.3, l1 + l2, 31):
        for phi in np.linspace(-90, 90, 37) * deg:
            assert served(r * np.cos(phi), r * np.sin(phi)), (r, phi)
    assert not served(-0.38, 0) and served(-0.36, 0)


def test_first_link_turns_by_the_stated_angle_if_the_second_is_short():
    _, options, _ = asked("scara_kinematics.p3")
    pattern = r"links of (\d+) and (\d+) mm, the first one turns by at most (\d+)°"
    l1, l2, most = numbers(pattern, " ".join(each.second for each in options))
    q2 = np.linspace(-np.pi, np.pi, 100001)
    inner = np.arctan2(l2 * np.sin(q2), l1 + l2 * np.cos(q2))
    assert round((2 * inner.max()) / deg) == most


def test_least_tool_speed_for_unit_joint_speeds_is_the_smaller_singular_value():
    words = flat("04", "deeper-jacobian")
    assert "= 1$ rad²/s², how slow can the tool be? Its lowest speed is the smallest" in words
    q = np.array([0.3, 0.5])
    J = 1e3 * np.array(
        [
            [-0.2 * np.sin(q[0]) - 0.25 * np.sin(q.sum()), -0.25 * np.sin(q.sum())],
            [0.2 * np.cos(q[0]) + 0.25 * np.cos(q.sum()), 0.25 * np.cos(q.sum())],
        ]
    )
    phi = np.linspace(0, np.pi, 100001)
    speeds = np.hypot(*(J @ [np.cos(phi), np.sin(phi)]))
    assert speeds.min() == pytest.approx(np.linalg.svd(J)[1][1])


def test_quintic_corner_has_a_higher_peak_acceleration():
    assert "its peak in the corner is higher" in flat("05", "cost-look")
    made, count = run_cells("05", "blend-code"), 4001
    s = np.linspace(0, 1, count)
    for share in (0.1, 0.268, 0.5):
        most = {}
        for corner in ("parabola", "quintic"):
            poses = made["blend"](made["start"], made["via"], made["goal"], share, s, corner=corner)
            q = np.unwrap(SCARA.ik(poses)[:, made["row"]], axis=0)
            inside = abs(s[1:-1] - 0.5) < share - 2 / count
            most[corner] = abs(np.diff(q, 2, axis=0))[inside].max(axis=0)
        assert (most["quintic"] > 1.2 * most["parabola"]).all()


def test_paths_need_only_a_lerp_method():
    words = flat("05", "short")
    assert "LIN and the blend use nothing but the `lerp` of a pose" in words

    class Place:
        def __init__(self, x):
            self.x = np.asarray(x, dtype=float)

        def lerp(self, goal, s):
            return Place(self.x + np.asarray(s) * (goal.x - self.x))

    assert lin(Place(1), Place(3), [0, 0.5]).x.tolist() == [1, 2]
    assert blend(Place(0), Place(1), Place(4), 0.1, [0, 0.25, 1]).x.tolist() == [0, 0.5, 4]
    q = np.array([0.3, 0.4, 0.5, 0.1])
    bare = Arm("links alone", SCARA.geometry, SCARA.limits)
    assert (bare.jacobian(q) == SCARA.jacobian(q)).all()


def test_two_of_the_four_row_pairs_coincide_at_the_singular_pose():
    words = flat("06", "drag-target-look")
    assert "There are four such pairs." in words
    told = "the two postures of a pair can coincide: rows 2 and 3 are the same, and so are rows"
    assert f"{told} 4 and 5." in words
    pose = Transform(Quaternion.from_roll_pitch_yaw(0, np.pi / 2, 0), np.array([400, 0, 200]) * mm)
    q = ITMO6R.ik(pose)
    off = [abs(np.exp(1j * q[k]) - np.exp(1j * q[k + 1])).max() for k in (0, 2, 4, 6)]
    assert [each < 1e-6 for each in off] == [False, True, True, False]


def test_phi_loses_digits_as_stated():
    assert "rounding leaves few correct digits of $\\phi$" in flat("06", "root-look")
    rng, worst = np.random.default_rng(6), {}
    for theta in (1e-9, 5e-14):
        off = []
        for phi in rng.uniform(-3, 3, 200):
            psi = rng.uniform(-3, 3)
            M = about([0, 0, 1], phi) @ about([0, 1, 0], theta) @ about([0, 0, 1], psi)
            back = about([1, 0, 0], 0.7)
            M = back.T @ (back @ M)  # with the rounding errors of a product of matrices
            off.append(abs(np.exp(1j * np.arctan2(M[1, 2], M[0, 2])) - np.exp(1j * phi)))
        worst[theta] = max(off)
    assert worst[1e-9] < 1e-6 and 1e-4 < worst[5e-14] < 0.1
    assert "in the line from joint 2 to the wrist centre" in flat("06", "position")


# --- Lab 07 ---------------------------------------------------------------------------------------


def test_unwrapping_matters_only_for_joint_6():
    words = flat("07", "choose-rule")
    told = "only those of joint 6, which can turn through 532° (some $k$ is always inside)."
    assert told in words
    low, high = PUMA560.limits.T
    assert ((high - low) / deg > 360).tolist() == [False] * 5 + [True]
    assert round((high - low)[5] / deg) == 532
    rng, kinds = np.random.default_rng(3), set()
    while len(kinds) < 2:
        walk = np.cumsum(rng.normal(0, 12, (60, 6)), axis=0) * deg
        for j in range(6):
            q = walk[:, j] - walk[0, j]
            kept = ((low[j] <= q) & (q <= high[j])).all()
            turns = 2 * np.pi * np.arange(-3, 4)[:, None]
            some = ((low[j] <= q + turns) & (q + turns <= high[j])).any(axis=0).all()
            assert some == (kept if j < 5 else True)
            kinds.add(bool(some != kept))


def test_rows_4_to_6_end_with_a_joint_beyond_its_limit():
    words = flat("07", "choose-look")
    told = "Rows 3 to 6 are usable at the start *and* at the goal, but a joint passes its limit on"
    assert told in words
    told = flat("07", "deeper-nearest-look")
    assert "Rows 4 to 6 of that line end with a joint wound past its limit" in told
    made = run_cells("07", "choose-player")
    low, high = PUMA560.limits.T
    ends, wound = [], []
    for k, q in enumerate(made["motions"]):
        turns = 2 * np.pi * np.arange(-2, 3)[:, None, None]
        fits = ((low <= q + turns) & (q + turns <= high)).any(axis=0).all(axis=-1)
        past = ((q < low) | (q > high)).any(axis=-1)
        if fits[0] and fits[-1] and past.any():
            ends.append(k)
            if past[-1]:
                wound.append(k)
    assert ends == [3, 4, 5, 6] and wound == [4, 5, 6]


def test_longer_moves_to_rows_5_and_7_avoid_the_limit_of_joint_2():
    assert "In rows 5 and 7, the best move is longer than the move to the values" in flat(
        "07", "deeper-ptp-look"
    )
    made = run_cells("07", "deeper-ptp")
    q, (low, high) = made["q_from"], PUMA560.limits.T
    for row in (0, 2, 5, 7):
        raw = made["options"][row]
        kept = [raw + 2 * np.pi * np.array(turn) for turn in product((-1, 0, 1), repeat=6)]
        kept = [each for each in kept if ((low <= each) & (each <= high)).all()]
        longer = min(abs(each - q).sum() for each in kept) > abs(raw - q).sum() + 1e-9
        outside = (np.flatnonzero((raw < low) | (raw > high)) + 1).tolist()
        assert (longer, outside) == ((True, [2]) if row in (5, 7) else (False, []))


def test_the_blocks_of_the_jacobian_have_the_stated_determinants():
    words = flat("07", "near")
    assert "span a parallelogram of area $l_2 l_3 |\\sin\\gamma|$" in words
    assert "moves it out of this plane, by $|r|$ per radian" in words
    for q in np.random.default_rng(7).uniform(*PUMA560.limits.T, size=(50, 6)):
        J, corners = PUMA560.jacobian(q), PUMA560.frames(q).translation
        shoulder, elbow, wrist = corners[[1, 2, 4]]
        normal = np.array([np.sin(q[0]), -np.cos(q[0]), 0])  # the normal of the arm's plane
        lifted = wrist - 0.15005 * normal
        area = np.linalg.norm(np.cross(elbow - shoulder, lifted - elbow))
        r = (lifted - shoulder) @ [np.cos(q[0]), np.sin(q[0]), 0]
        assert abs(J[:3, 3:]).max() < 1e-12
        assert np.linalg.norm(np.cross(J[:3, 1], J[:3, 2])) == pytest.approx(area)
        assert abs(J[:3, 0] @ normal) == pytest.approx(abs(r))
        assert abs(np.linalg.det(J[:3, :3])) == pytest.approx(abs(r) * area)
        assert abs(np.linalg.det(J[3:, 3:])) == pytest.approx(abs(np.sin(q[4])))


def test_statements_on_the_worst_case_and_the_ellipsoid_are_true():
    words = flat("07", "cross-jacobian")
    assert "together) that a joint-speed vector of length 1 rad/s can give." in words
    q = np.array([10, 60, -93, 20, 30, 40]) * deg
    J = PUMA560.jacobian(q)
    J = np.vstack([J[:3] / PUMA560.reach, J[3:]])
    (left,) = [np.linalg.eigh(J.T @ J)[1][:, 0]]
    sigma = float(LINE["near"](q))
    assert np.linalg.norm(J @ left) == pytest.approx(sigma)
    assert (np.linalg.norm(J @ np.random.default_rng(1).normal(size=(6, 50)), axis=0) > sigma).any()
    assert "the ellipsoid becomes flat, and its shortest semi-axis falls to 1 mm/s." in flat(
        "07", "near-look"
    )
    steps = 1e-6 * np.eye(6)
    q = np.array([0, 60, -87, 0, 0, 0]) * deg
    A = (PUMA560.fk(q + steps).translation - PUMA560.fk(q - steps).translation).T / 2e-6
    assert round(np.linalg.svd(A)[1][2] / mm) == 1


def test_elbow_line_ends_at_the_stated_distance_from_full_stretch():
    told = flat("07", "cross-jacobian")
    assert "*elbow* goes outwards and stops $m$ short of full stretch" in told
    made = run_cells("07", "cross-player", "cross-cost")
    _, pose, away, along = made["LINES"]["elbow"]
    assert along.tolist() == [1, 0, 0] and away.tolist() == [-1, 0, 0]
    for place in (pose.translation, LINE["stretched"](0).translation):
        out = place / mm - [0, 0, 671.83]
        assert np.sqrt(out @ out - 150.05**2) == pytest.approx(431.8 + np.hypot(431.8, 20.3))
    for m in (100 * mm, 10 * mm):
        assert LINE["stretched"](m).translation == pytest.approx(pose.translation + m * away)
    assert "We take many random poses within reach" in flat("07", "count")


def test_arm_is_stretched_and_forearm_points_up_where_stated():
    assert "atan2}(d_4, a_3) = -87.3°$" in flat("07", "triangle-formula")
    words = written("puma560_branches")
    assert "At q2 = q3 = 0, the forearm points up" in words
    for q3 in (-87.3, -90, 0):
        places = PUMA560.frames(np.array([0, 0, q3, 0, 0, 0]) * deg).translation
        shoulder, elbow, wrist = places[[1, 2, 4]] + np.array([[0], [0], [0.15005]]) * [0, 1, 0]
        straight = np.linalg.norm(elbow - shoulder) + np.linalg.norm(wrist - elbow)
        assert (np.linalg.norm(wrist - shoulder) > (1 - 1e-6) * straight) == (q3 == -87.3)
    for q2, up in ((0, 1), (90, 0)):
        places = PUMA560.frames(np.array([0, q2, 0, 0, 0, 0]) * deg).translation
        fore = places[4] - places[3]
        assert fore[2] / np.linalg.norm(fore) == pytest.approx(up, abs=1e-9)


def test_rows_0_and_2_of_the_first_view_share_only_joint_1():
    text = flat("07", "eight")
    assert "same value in rows 0 and 2?" in text and "It is joint 1. The elbow moves" in text
    level = Quaternion.from_angle_axis(90 * deg, [0, 1, 0])
    rows = PUMA560.ik(Transform(level, np.array([550, 0, 800]) * mm))
    off = abs(np.exp(1j * rows[0]) - np.exp(1j * rows[2]))
    assert (np.flatnonzero(off < 1e-9) + 1).tolist() == [1] and (off[1:] > 0.05).all()


def test_name_of_a_posture_matches_measured_positions():
    question, options, right = asked("puma560_branches.p9")
    q = np.array(numbers(r"\((\S+), (\S+), (\S+), (\S+), (\S+), (\S+)\), in deg", question)) * deg
    places = PUMA560.frames(q).translation
    elbow, wrist = (p[[0, 2]] for p in places[[2, 4]] - places[1])  # joint 1 is at 0
    side = "RIGHTY" if PUMA560.jacobian(q)[2, 1] > 0 else "LEFTY"
    height = "ABOVE" if elbow[1] > wrist[1] * elbow[0] / wrist[0] else "BELOW"
    flip = "NOFLIP" if q[4] > 0 else "FLIP"
    assert q[0] == 0 and options[right].text == f"{side} {height} {flip}."
    (r, gamma) = numbers(r"r is (\S+) mm, .*γ is (\S+)°,", options[right].reason)
    assert round(wrist[0] / mm) == r
    bend = np.arctan2(*(wrist - elbow)[::-1]) - np.arctan2(*elbow[::-1])
    assert np.angle(np.exp(1j * bend)) / deg == pytest.approx(gamma, abs=0.051)
    assert "Turn joint 1 to 150°: the wrist centre moves to x > 0" in options[0].second
    assert PUMA560.fk(q + [150 * deg, 0, 0, 0, 0, 0]).translation[0] > 0


def test_front_row_exceeds_the_limit_of_joint_1_for_far_poses_straight_behind():
    _, options, _ = asked("puma560_branches.p4")
    (far,) = numbers(r"^For a target (\d+) mm straight behind axis 1", options[0].second)
    for rho, allowed in ((300, True), (400, True), (far, False), (700, False)):
        q1 = 180 - np.arcsin(150.05 / rho) / deg  # joint 1 of the front row, except for its sign
        assert (q1 <= 160) == allowed


def test_most_short_lines_keep_their_row():
    _, options, _ = asked("puma560_branches.p7")
    assert any(o.reason.startswith("On most short lines, a row that is usable") for o in options)
    rng = np.random.default_rng(9)
    ends = LINE["random_poses"](rng, (300,))
    way = rng.normal(size=(300, 3))
    way *= 20 * mm / np.linalg.norm(way, axis=1, keepdims=True)
    other = Transform(ends.rotation, ends.translation + way)
    rows = PUMA560.ik(lin(ends[:, None], other[:, None], np.linspace(0, 1, 21)))
    rows = rows[np.isfinite(rows).all(axis=(1, 2, 3))]
    followed = LINE["tracks"](rows)
    rest = abs(followed[:, :, 0] - LINE["REST"]).sum(axis=-1)
    fits = LINE["usable"](rows[:, 0])
    pick = np.where(fits, rest, np.inf).argmin(axis=-1)
    stay = LINE["serves"](followed)[np.arange(len(rows)), pick][fits.any(axis=-1)]
    assert len(stay) > 60 and 0.9 < stay.mean()


# --- Labs 08 and 09 -------------------------------------------------------------------------------


def test_every_joint_has_its_full_speed_at_once():
    assert "every joint reaches its full speed at once" in flat("08", "time-take")
    assert "Choose a speed of joint 1, press play" in flat("08", "time-take")
    assert "Joints 2 and 3 turn at 11.5°/s (0.2 rad/s)" in flat("08", "time-take")
    (most,) = numbers(
        r"greatest speed of \d+ samples (\S+) °/s \(joint \d\)", shown("08", "time-player")
    )
    assert most == pytest.approx(0.2 / deg, abs=0.05)
    assert "the distance of the tool from axis 1 (with a sign; all lengths in m)" in flat(
        "08", "chain-formula"
    )
    q2 = -60 * deg
    assert 5 * np.sin(q2) + 4 * np.cos(q2) == pytest.approx(-2.33, abs=0.005)


def test_joint_1_arrives_last_up_to_the_stated_speed():
    degrees, stated = numbers(
        r"Up to (\S+)°/s, which is (\S+) rad/s \(the limit", flat("08", "time-look")
    )
    assert round(stated / deg, 1) == degrees
    starts, ends = principal_postures(5, 4, [[1, 1, 1], [1, 3, 3]])
    turns = abs(ends - starts)
    speeds = np.array([0.075, 0.1, 0.125, 0.15, 0.2])
    assert "joint_1 = np.array([0.075, 0.1, 0.125, 0.15, 0.2])" in cells("08")["time-player"]
    last = [int(np.argmax(turns / np.array([v, 0.2, 0.2]))) + 1 for v in speeds]
    assert [v for v, joint in zip(speeds, last, strict=True) if joint == 1][-1] == stated
    assert set(last) == {1, 3} and "Above that, joint 3 arrives last" in flat("08", "time-look")


def test_other_elbow_exceeds_its_limit_unless_the_arm_is_stretched_or_folded():
    words = flat("08", "rows-look")
    told = (
        "With the elbow flag −1, joint 3 is past its limit, unless the arm is stretched or folded."
    )
    assert told in words
    arm, rng = spbu_arm(5, 4), np.random.default_rng(8)
    low, high = arm.limits[2]
    points = rng.uniform([-9, -9, 0], 9, (4000, 3))
    d = np.linalg.norm(points, axis=1)
    points = points[(d > 1.01) & (d < 8.99) & (np.hypot(*points[:, :2].T) > 0.01)]
    points[::2, 2] = 0  # on the floor, which is part of the boundary of the workspace
    d = np.linalg.norm(points, axis=1)
    q3 = arm.ik(points[d > 1.01])[:, [1, 3], 2]
    assert not ((low <= q3) & (q3 <= high)).any()
    border = arm.ik([[1, 0, 0], [9, 0, 0]])[:, [1, 3], 2]
    assert ((low - 1e-9 <= border) & (border <= high + 1e-9)).all()


def test_at_most_ten_reasons_of_one_kind_are_listed():
    assert "says what is wrong, with at most ten reasons of each kind" in flat(
        "08", "deeper-command"
    )
    far = [[20 + k, 0, 0] for k in range(15)]
    with pytest.raises(TaskError) as told:
        Task(5, 4, T=-1, speeds=[0.2] * 3, p0=[2, 2, 1], points=far, kind="visit")
    about_far = [each for each in told.value.faults if "too far" in each]
    assert len(about_far) == 11 and len(told.value.faults) > 11


def test_ranges_of_alpha_and_gamma_are_as_stated():
    said = written("three_levers")
    (KO, low) = numbers(r"At (\S+) m alpha goes from (\S+)° to 180°\. At 3 m it cannot move", said)
    assert np.arccos((5 - KO**2) / 4) / deg == pytest.approx(low, abs=0.05)
    assert "Your answer becomes right as K's distance from the base approaches 1 m." in said
    off = [abs(90 - (180 - np.arccos((KO - 1) / 2) / deg)) for KO in (1.5, 1.1, 1.01, 1.0001)]
    assert (np.diff(off) < 0).all() and off[-1] < 0.01
    (x,) = numbers(r"With K at \((\S+), 0\) m, gamma is above 180° for every alpha", said)
    for alpha in np.linspace(np.arccos((5 - x * x) / 4), np.pi, 201):
        # the side BK, and then the angle at O of the triangle OBK
        away = np.sqrt(2 - 2 * np.cos(alpha))
        at_O = np.arccos(np.clip((1 + x * x - away**2) / (2 * abs(x)), -1, 1))
        assert at_O > 1e-3, "gamma is the direction of K plus this angle"


def test_greedy_rule_is_compared_with_the_best_of_all_choices():
    question, options, right = asked("three_levers.p9")
    assert question.endswith("Which arm has turned its joints less in the end?")
    count, tours, _, most, rows = numbers(
        r"On (\d+) of (\d+) random lists of (\d+) targets, the joints of the greedy arm turn more "
        r"than 5 % farther than those of the planning arm, and (\d+) % farther on the worst list. "
        r"\(The plan uses the best of (\d+) postures",
        options[right].reason,
    )
    lost = LEVERS["losses"]()
    assert (tours, rows) == (len(lost), LEVERS["ROWS"]) and (lost > 0.05).sum() == count
    assert round(100 * lost.max()) == most
    assert options[right].text.startswith("The planning arm on some lists; on the others, both")
    rng = np.random.default_rng(4)
    for _ in range(3):
        r, phi = rng.uniform(1.3, 2.7, 3), rng.uniform(0, 120, 3) * deg
        tour = np.stack([r * np.cos(phi), r * np.sin(phi)], axis=-1)
        before = np.array([90, 120, 120]) * deg
        best = [LEVERS["best_in_all"](before, tour, count) for count in (7, 13)]
        family = [ARM.family(K, np.linspace(*ARM.alpha_range(K), 7)) for K in tour]
        all_ways = min(
            abs(np.diff([before, a, b, c], axis=0)).sum()
            for a in family[0]
            for b in family[1]
            for c in family[2]
        )
        assert best[0] == pytest.approx(all_ways) and best[1] <= best[0] + 1e-12


def test_least_movement_per_task_is_the_same_in_both_replies():
    question, options, _ = asked("three_levers.p10")
    (each,) = numbers(
        r"rule of least movement, the joints turn by (\d+)° per task on average", question
    )
    (wide,) = numbers(r"the range of alpha at a target is (\d+)° wide", question)
    (twice,) = numbers(r"would have to add (\d+)° to every task, about twice", options[2].reason)
    assert abs(twice - 2 * each) <= 1 and twice / wide == pytest.approx(2, abs=0.1)
    text = flat("09", "race-look")
    assert "The rule of equal angles needs no search at all, only a formula." in text


# --- Lab 10 ---------------------------------------------------------------------------------------


def test_areas_and_curves_are_as_stated():
    assert "both quadrilaterals: BA can hit an obstacle, too." in flat("10", "region-look")
    assert "so A and K move on curves." in flat("10", "sweep")
    path = direct(np.array([150, 120, 120]) * deg)
    s = np.linspace(0, 1, 4001)[:, None]
    points = ARM.points(path[0] + s * (path[1] - path[0]))
    off = []
    for place in (points[:, 2], points[:, 3]):
        chord = place[-1] - place[0]
        x, y = (place - place[0]).T
        off.append(abs(chord[0] * y - chord[1] * x).max() / np.hypot(*chord))
    _, options, _ = asked("obstacle_avoidance.p2")
    assert numbers(r"curves of A and K bulge by (\S+) and (\S+) m,", options[1].reason) == [
        pytest.approx(each, abs=0.005) for each in off
    ]
    A = points[:, 3]
    a, b, c = A[0], A[2000], A[-1]
    middle = np.linalg.solve(2 * np.array([b - a, c - a]), [b @ b - a @ a, c @ c - a @ a])
    far = np.hypot(*(A - middle).T)
    assert np.ptp(far) > 1e-3, "the curve should not be an arc of a circle"


def through(*vias):
    path = [START_10]
    for place in (*vias, K1_10):
        path.append(ARM.least(place, path[-1])[0])
    return path


def gripper_distance(path, H):
    s = np.linspace(0, 1, 20001)[:, None]
    ways = np.concatenate([ARM.points(a + s * (b - a))[:, 3] for a, b in pairwise(path)])
    return np.hypot(*(ways - H).T).min()


def test_answers_to_the_questions_about_the_views_of_lab_10_are_true():
    H = np.array([1.2, 1.3])
    (far,) = numbers(
        r"nearer to the obstacle H than (\S+) mm, but the arm's levers do\.", flat("10", "title")
    )
    assert "H, [(1, 1.3), (1, 1.2)])" in cells("10")["opening"]
    path = through((1, 1.3), (1, 1.2))
    assert gripper_distance(path, H) / mm == pytest.approx(far, abs=0.06)
    assert far * mm > DISTANCE > least_distance(path, H) + 0.1
    pair, kept = said_pair("able", r"K2 = (.*?) m and K3 = (.*?) m\. .*clearance.* is (\S+) mm")
    assert least_distance(through(*pair), H) / mm == pytest.approx(kept, abs=0.06)
    H = np.array([1.5, 1.0])
    text = r"gripper: it comes within (\S+) mm of H before K2, (\S+) mm .*, and (\S+) mm after K3"
    near = numbers(text, flat("10", "via-rule"))
    rule = via_path(ARM, START_10, K1_10, H)
    found = [least_distance(rule[k : k + 2], H) / mm for k in range(3)]
    assert found == pytest.approx(near, abs=0.06) and max(near) * mm < DISTANCE
    each = [gripper_distance(rule[k : k + 2], H) / mm for k in range(3)]
    assert each == pytest.approx(near, abs=0.06), "a lever is nearer than the gripper"
    pair, kept = said_pair("via-rule", r"K2 = (.*?) m and K3 = (.*?) m, the clearance is (\S+) mm")
    assert least_distance(through(*pair), H) / mm == pytest.approx(kept, abs=0.06)
    assert kept * mm > DISTANCE


def test_a_point_inside_lever_ak_can_be_nearest_as_stated():
    text = r"H at \((.*?), (.*?)\) m, a point between A and K comes within (\S+) mm, and the "
    x, y, lever, gripper = numbers(text + r"gripper only within (\S+) mm", flat("10", "via-rule"))
    H = np.array([x, y])
    assert tries("10", "via-explorer") == [(x, y)]
    path = via_path(ARM, START_10, K1_10, H)
    assert gripper_distance(path, H) / mm == pytest.approx(gripper, abs=0.06)
    assert least_distance(path, H) / mm == pytest.approx(lever, abs=0.06)
    s = np.linspace(0, 1, 20001)[:, None]
    points = ARM.points(np.concatenate([a + s * (b - a) for a, b in pairwise(path)]))
    A, K = points[:, 2], points[:, 3]
    along = ((H - A) * (K - A)).sum(axis=1).clip(0, 1)  # the length of AK is 1
    far = np.hypot(*(A + along[:, None] * (K - A) - H).T)
    assert far.min() / mm == pytest.approx(lever, abs=0.06)
    assert 0.1 < along[far.argmin()] < 0.9, "the nearest point is an end of AK"


def test_lever_ak_sweeps_across_the_obstacle_of_the_question_for_the_stated_reason():
    """At the start, AK is above H. On the way to K2, the gripper goes below H and A stays above."""
    question, options, right = asked("obstacle_avoidance.p5")
    assert "from K = (1.2, 1.7) m to K1 = (1.9, 0.3) m" in question
    H = np.array(numbers(r"The obstacle is at \((\S+), (\S+)\) m", question))
    reason = "The rule takes the gripper below it while A stays above, so AK sweeps across it."
    assert f"At the start, AK lies above the obstacle. {reason}" in options[0].reason
    assert "takes the gripper below the obstacle, but A stays above it." in options[right].reason
    a, b = via_path(ARM, START_10, K1_10, H)[:2]
    points = ARM.points(a + np.linspace(0, 1, 2001)[:, None] * (b - a))
    A, K = points[:, 2], points[:, 3]
    share = (H[0] - A[:, 0]) / (K - A)[:, 0]
    above = A[:, 1] + share * (K - A)[:, 1] - H[1]  # of the point of AK at the x of H
    assert (share > 0).all() and (share < 1).all() and above[0] > 0.2 > 0 > above[-1]
    assert (A[:, 1] > H[1]).all() and K[0, 1] > H[1] > K[-1, 1]
    kept = via_path(ARM, START_10, K1_10, (1.5, 1.0))  # there the side of K2 is the same
    assert least_distance(kept, np.array([1.5, 1.0])) > 0.9 * DISTANCE


def said_pair(cell, pattern):
    one, two, kept = re.search(pattern, flat("10", cell)).groups()
    return [eval(one), eval(two)], float(kept)


def test_swept_place_and_the_minimum_between_samples_are_as_stated():
    (place,) = re.findall(r"\((.*?)\) m, right of the line KK1", flat("10", "sweep-look"))
    H = np.array(eval(place))
    a, b = through()
    across = np.cross([*(np.array(K1_10) - (1.2, 1.7)), 0], [*(H - (1.2, 1.7)), 0])[2]
    assert across > 0, "seen from K towards K1, the place is not on the left"
    assert in_quadrilateral(ARM, a, b, H)["AK"] == 0
    s = np.linspace(0, 1, 20001)[:, None]
    assert lever_distance(a + s * (b - a), H, slice(2, 3)).min() < 1e-3
    path = direct(np.array([150, 120, 120]) * deg)
    (found,) = re.findall(r"(\(.*?\)) m: too near from", flat("10", "whole-bound"))
    other = np.array(eval(found))
    d = lever_distance(path[0] + s * (path[1] - path[0]), other)
    near = s[d < DISTANCE, 0]
    assert (np.diff(near) < 1e-3).all(), "there is more than one minimum"
    told = numbers(r"\) m: too near from (\d+) to (\d+) %", flat("10", "whole-bound"))
    between = numbers(r"only between (\d+) and (\d+) %", flat("10", "whole-hand"))
    assert between[0] < told[0] < told[1] < between[1]
    assert found not in asked("obstacle_avoidance.p4")[0], "the question gives the answer away"
    assert told == [round(100 * near[0]), round(100 * near[-1])]
    hand = re.search(r"looks at (.*?) and 100 %", flat("10", "whole-hand"))[1]
    shares = [float(x) / 100 for x in hand.split(", ")] + [1.0]
    seen = [lever_distance(path[0] + x * (path[1] - path[0]), other) for x in shares]
    assert min(seen) > DISTANCE, "a sample is too near, so the program notices"


def test_view_below_the_question_about_samples_does_not_show_its_answer():
    """The view opens with H elsewhere, where no lever comes too near, so the reader has to find a
    place at which the samples miss the least distance.
    """
    (first,) = re.findall(r"\(1\.9, 0\.3\), \((.*?)\)\)", cells("10")["whole-explorer"])
    H = np.array(eval(first))
    path = direct(np.array([150, 120, 120]) * deg)
    assert least_distance(path, H) > 2 * DISTANCE
    question, _, _ = asked("obstacle_avoidance.p4")
    assert f"at ({H[0]:g}, {H[1]:g}) m" not in question
    assert "This is the same motion, with H elsewhere." in flat("10", "whole-hand")


def test_bound_on_the_motion_of_unequal_levers_is_as_stated():
    told = r"lengths (\S+) m \(OB\), (\S+) m \(BA\) and (\S+) m \(AK\)\. What is its \$m\$"
    OB, BA, AK = numbers(told, flat("10", "real"))
    term = r"(\S+)\\,\|\\Delta\\{}\|"
    form = r" \+ ".join(term.format(name) for name in ("gamma", "beta", "alpha"))
    carried = numbers(form, flat("10", "real"))
    assert carried == pytest.approx([OB + BA + AK, BA + AK, AK])
    arm = three_lever((OB, BA, AK))
    rng, worst = np.random.default_rng(8), 0.0
    for _ in range(300):
        q, turn = rng.uniform(0, np.pi, 3), rng.uniform(-0.3, 0.3, 3)
        moved = np.hypot(*(arm.points(q + turn) - arm.points(q)).T).max()
        worst = max(worst, moved / (abs(turn) @ carried))
    assert 0.5 < worst <= 1


def test_rule_about_the_reach_holds_for_targets_and_via_points_only():
    """The gripper may come nearer to O than one lever, but targets and via points may not."""
    assert "targets and via points lie farther than $L$ from O." in flat("10", "able")
    for place in ((0.6, 0.7), (0.99, 0.0)):
        assert ARM.out_of_reach(place)
        assert np.isnan(via_path(ARM, START_10, K1_10, place, 0.05)).any()
    path = plan(ARM, START_10, K1_10, (0.1, 1.3)).path
    s = np.linspace(0, 1, 2001)[:, None]
    K = np.concatenate([ARM.points(a + s * (b - a))[:, 3] for a, b in pairwise(path)])
    assert np.hypot(*K.T).min() < 0.7, "the gripper itself may pass nearer to O"


def test_only_one_of_the_other_points_is_in_the_quadrilateral_but_not_swept_by_ak():
    (told,) = re.findall(r"Answer</summary> (\(.*?\)): only BA does\.", flat("10", "lever"))
    a, b = through()
    s = np.linspace(0, 1, 20001)[:, None]
    found = []
    for place in tries("10", "sweep-code"):
        H = np.array(place)
        near = [lever_distance(a + s * (b - a), H, slice(k, k + 1)).min() < 1e-3 for k in range(3)]
        if in_quadrilateral(ARM, a, b, H)["AK"] and not near[2]:
            found.append((tuple(H.tolist()), near))
    assert found == [(eval(told), [False, True, False])]


def test_clearance_is_a_lower_bound_as_close_as_stated():
    words = flat("10", "whole-look")
    (off,) = numbers(r"proven lower bound, at most (\S+) mm below the least", words)
    rng, s = np.random.default_rng(4), np.linspace(0, 1, 40001)[:, None]
    seen = 0
    for _ in range(40):
        a, b = rng.uniform(0, np.pi, (2, 3))
        H = rng.uniform(-1, 3, 2)
        least = lever_distance(a + s * (b - a), H).min()
        bound = clearance(ARM, [a, b], H).min()
        assert bound <= least
        if bound > 0.01:  # where a lever passes over H, samples come less close to the minimum
            seen += 1
            assert least <= bound + off * mm + 1e-7
    assert seen > 10


def test_other_arm_is_asked_for_a_seventh_of_its_mean_lever():
    (asked_for,) = numbers(r"stay (\S+) mm away, a seventh of the mean length", flat("10", "real"))
    assert three_lever((0.9, 1.1, 0.6)).lever / 7 / mm == pytest.approx(asked_for, abs=0.05)


def test_planning_method_changes_at_the_stated_places():
    text = flat("10", "cube-text")
    told = numbers(
        r"At (\S+) m, the direct motion is clear\. From (\S+) to (\S+) m, via points are "
        r"enough\. From (\S+) to (\S+) m, a search",
        text,
    )
    ways = {}
    for x in np.arange(20, -1, -1) / 10:
        found = plan(ARM, START_10, K1_10, (x, 1.3))
        ways.setdefault(found.way, []).append(x)
    assert [
        ways["direct"][-1],
        *(ways[k][i] for k in ("via points", "search") for i in (0, -1)),
    ] == (told)
    assert ways["none"] == [0.0] and ways["direct"][0] == 2.0
    assert lever_distance(START_10, np.array([0, 1.3])) < DISTANCE


def test_sampled_tasks_and_the_larger_circle_keep_the_distance_as_stated():
    words = "all levers keep the required distance at the start, and so does the gripper"
    assert words in flat("10", "often")
    near_at_target = 0
    for start, target, H in sampled_tasks():
        end = direct(start, target)[1]
        assert lever_distance(start, H) > DISTANCE and np.hypot(*(target - H)) > DISTANCE
        near_at_target += lever_distance(end, H) < DISTANCE
    assert near_at_target > 0
    _, options, _ = asked("obstacle_avoidance.p7")
    (kept, all_, near) = numbers(
        r"(\d+) of (\d+) do\. In (\d+), a lever still comes", options[2].reason
    )
    assert kept + near == all_


def test_plan_tries_more_circles_than_control():
    words = flat("10", "deeper-two")
    assert "like `control`, but with more circles, and it begins with the via" in words
    assert "for r in (distance, 0.16, 0.20, 0.25)" in cells("10")["control-code"]
    assert "r = 180 mm" in shown("10", "deeper-two-code")
    assert "six positions of the obstacle, side by side." in flat("10", "deeper-moving")
    assert "*Play* shows a coarse search." in flat("10", "cube")


# --- Labs 11 and 12 -------------------------------------------------------------------------------


def test_motors_reverse_on_the_straight_line_where_the_lab_says():
    assert (
        "Motor 3 reverses where the line is nearest to the base: the arm folds, and then unfolds. "
        "Motor 2 reverses later, where γ is greatest." in flat("11", "paths-look")
    )
    start, goal = np.array([[600, -350, 50], [50, 250, 350]]) * mm
    share = np.linspace(0, 1, 20001)
    line = start + share[:, None] * (goal - start)
    q = np.unwrap(station_postures(LOADER, line), axis=0)
    steps = np.diff(q, axis=0)
    back = [np.flatnonzero(np.diff(np.sign(w[abs(w) > 1e-12]))) / len(w) for w in steps.T]
    assert [len(each) for each in back] == [0, 1, 1]
    nearest = share[np.linalg.norm(line, axis=1).argmin()]
    assert back[2][0] == pytest.approx(nearest, abs=1e-3)
    assert (steps[share[1:] < nearest - 1e-3, 2] < 0).all(), "the arm does not fold at first"
    assert back[1][0] == pytest.approx(share[q[:, 1].argmax()], abs=1e-3)
    assert nearest < back[1][0] < nearest + 0.2


def test_straight_line_is_path_b_in_exactly_the_cases_that_lab_11_states():
    assert (
        "None reverses if, along the line, the distance from the base only grows or only shrinks, "
        "and so does γ" in flat("11", "paths-look")
    )
    start, loader = np.array([600, -350, 50]) * mm, loader_arm(0.45, 0.30)
    rng, found = np.random.default_rng(11), []

    def back(x):
        """By how much x goes back, in all, on its way from its first value to its last."""
        return abs(np.diff(x)).sum() - abs(x[-1] - x[0])

    while len(found) < 150:
        goal = rng.uniform([-0.7, -0.7, 0], [0.7, 0.7, 0.6])
        try:
            move = straight(loader, start, goal, [10, 40, 40])
        except ValueError:
            continue  # out of reach
        line = start + np.linspace(0, 1, 4001)[:, None] * (goal - start)
        gamma = station_postures(loader, line)[:, 1]
        turns = any(signs.size and np.ptp(signs) > 0 for _, signs in move.pulses())
        found.append(turns)
        pulse = 1 / 40 * deg  # a motor that goes back by less than this does not reverse
        assert turns != (back(np.linalg.norm(line, axis=1)) < 0.1 * mm and back(gamma) < 2 * pulse)
    assert 10 < sum(found) < 140


def test_paths_a_and_d_take_the_same_time_and_the_straight_line_is_never_faster():
    assert (
        "Never, and no. On a and d, the motor that has farthest to go runs at full speed all the "
        "way; on the straight line, it has at least as far to go." in flat("11", "able")
    )
    start, rng, slower = np.array([600, -350, 50]) * mm, np.random.default_rng(3), []
    while len(slower) < 100:
        goal = rng.uniform([-0.7, -0.7, 0], [0.7, 0.7, 0.6])
        try:
            line = straight(LOADER, start, goal, [10, 40, 40]).duration
        except ValueError:
            continue  # out of reach
        ends = counts(station_postures(LOADER, np.stack([start, goal])), [10, 40, 40])
        a, d = unsynchronised(*ends).duration, synchronised(*ends).duration
        assert a == pytest.approx(d, abs=1e-12) and line >= d - 1e-9
        slower.append(line > d + 1e-9)
    assert 10 < sum(slower), "the straight line always takes as long"


def test_half_a_pulse_moves_the_gripper_as_far_as_lab_11_prints():
    """The printed product must be the largest error by motor 1; for [36, 72, 72], half of it."""
    (angle, moved) = map(
        float,
        re.search(
            r"half a pulse of motor 1: (\S+)°, at start (\S+) mm", shown("11", "pulses-code")
        ).groups(),
    )
    q = station_postures(LOADER, np.array([[600, -350, 50]]) * mm)[0]
    turned = LOADER.fk(q + [angle * deg, 0, 0]).translation
    assert np.linalg.norm(turned - np.array([600, -350, 50]) * mm) / mm == pytest.approx(
        moved, abs=0.006
    )
    assert angle == 0.5 * 1.8 / 18 and "makes this error smaller" in flat("11", "pulses-look")


def test_motor_without_pulses_stands_still_in_lab_11():
    text = cells("11")["together-code"]
    made = {}
    with np.errstate(all="raise"):
        exec(text.replace("np.array([1000, 500, 250])", "np.array([1000, 500, 0])", 1), made)
    assert {name: omega.tolist() for name, omega in made["tempos"].items()} == {
        "each at the limit": [500, 500],
        "equal products": [250, 500],
        "equal times": [500, 250],
    }


def test_lengths_of_both_paths_with_other_gears_are_as_stated():
    """The view after the guess and the explorer must show the same rounded lengths."""
    _, options, right = asked("motor_synchronisation.p5")
    lengths = numbers(r"small circle: (\d+) mm against (\d+) mm", options[right].reason)
    n = np.rint(
        station_postures(LOADER, np.array([[600, -350, 50], [50, 250, 350]]) * mm)
        / deg
        * [40, 20, 20]
    )
    way = n[1] - n[0]
    t = np.linspace(0, abs(way).max(), 200_001)[:, None]
    for said, each in zip(lengths, (t.clip(max=abs(way)) / abs(way), t / t.max()), strict=True):
        path = LOADER.fk((n[0] + each * way) / [40, 20, 20] * deg).translation / mm
        assert round(np.linalg.norm(np.diff(path, axis=0), axis=1).sum()) == said


def test_answers_to_the_drag_tasks_of_lab_11_are_true():
    """The tasks are about path b, the limits of reach, the drift of the cycle and half steps."""
    start, loader = np.array([600, -350, 50]) * mm, loader_arm(0.45, 0.30)
    goal = numbers(
        r"and so does γ, as for \((\S+), (\S+), (\S+)\) mm\.",
        flat("11", "paths-look"),
    )
    share = np.linspace(0, 1, 2001)[:, None]
    line = start + share * (np.array(goal) * mm - start)
    turns = np.diff(station_postures(loader, line), axis=0)
    assert ((turns > 0).all(axis=0) | (turns < 0).all(axis=0)).all(), "a motor reverses"
    near, far = numbers(r"= (\d+) mm, .* = (\d+) mm", flat("11", "angles-hole"))
    for distance, exists in ((near - 1, 0), (near + 1, 1), (far - 1, 1), (far + 1, 0)):
        rows = loader.ik([distance * mm, 0, 0])
        assert np.isfinite(rows).all(axis=-1).any() == exists
    made = run_cells("11", "drift-code")
    assert made["left_over"].tolist() == [1, 0, -1]
    assert "one pulse too many, and joint 3 one too few" in flat("11", "drift-look")
    words = "With stakes at 420 mm: counter-clockwise and slightly down"
    assert (
        words in flat("11", "drift-look")
        and "stakes = [420, -180, 420]" in cells("11")["drift-code"]
    )
    before = np.deg2rad([-30.0, 66, 110])
    after = before + np.deg2rad([0.1, 0, -1 / 40])
    one, two = loader.fk(before).translation, loader.fk(after).translation
    around, down = np.hypot(*(two - one)[:2]), one[2] - two[2]
    [(off, cycles)] = re.findall(r"by (\d+) mm in (\d+) cycles", flat("11", "drift-look"))
    pulses = np.rint(made["exact"][0]) + int(cycles) * made["left_over"]
    away = loader.fk(np.deg2rad(pulses / [10, 40, 40])).translation - [0.6, -0.35, 0.05]
    assert round(np.linalg.norm(away) / mm, -1) == float(off)
    assert np.cross(one, two)[2] > 0 and around / 20 < down < around / 5
    rows = {drive: len(phases(drive, "unipolar")) for drive in ("wave", "half-step")}
    eight, small, large = numbers(
        r"there are (\S+) rows, and each turns the magnet by (\d+)° instead of (\d+)°",
        flat("11", "phases-look").replace("eight", "8"),
    )
    assert eight == rows["half-step"]
    assert (small, large) == (360 / eight, 360 / rows["wave"])
    wanted = numbers(r"turn such a rotor by (\S+)°\?", flat("11", "phases-own"))
    (total,) = numbers(
        r"Any with the sum (\S+), such as `\[-1\] \* 5`, in half-step drive only\.",
        flat("11", "phases-own"),
    )
    assert [total * 360 / eight / 50] == wanted and total == -5
    assert wanted[0] / 1.8 % 1, "whole steps are enough"
    for signs in ([-1] * 5, [-1] * 6 + [1], [1, -1, -1, -1, -1, -1, -1]):
        field = energised(phases("half-step", "unipolar"), signs) @ np.array([1, 1j, -1, -1j])
        turned = np.degrees(np.unwrap(np.angle(field)))
        assert [(turned[-1] - turned[0]) / 50] == pytest.approx(wanted)


def test_long_turns_and_lost_steps_are_as_stated():
    stands, directions = 150, np.array([-165, -120, -60, 0, 60, 120])
    setup = cells("11")["turn-setup"]
    assert f"directions, began = np.array({directions.tolist()}), {stands}" in setup
    *long, last = directions[abs(directions - stands) > 180]
    degrees = ", ".join(f"{x}°" for x in long)
    said = f"At {degrees} and {last}°, the plain difference takes the long way"
    assert said.replace("-", "\N{MINUS SIGN}") in flat("11", "turn-answer")
    for each in directions:  # the rest of the turn, always with the same sign
        turn = each - stands if abs(each - stands) <= 180 else abs(each - stands) - 360
        assert ((stands + turn - each) % 360 == 0) == (abs(each - stands) <= 180)
    motor, ones = Stepper(torque=0.02, inertia=1e-6, damping=6e-5, rise=0), np.ones(48)
    lost = {motor.run(ramp(48, f, f, 0), ones).lost for f in range(60, 281, 10)}
    assert 0 in lost and not any(each % 4 for each in lost)
    _, options, right = asked("motor_synchronisation.p10")
    assert re.search(r"the numbers of lost steps are 0, \d+", options[right].reason)
    assert "A path with corners can be shorter than a wide arc" in written("motor_synchronisation")


def test_generated_c_has_only_doubles_and_both_texts_describe_the_rims_alike():
    assert "every variable in it is a double" in flat("12", "c-generate")
    assert "2*t3" in shown("12", "c-generate") and "int " not in shown("12", "c-generate")
    anything = "If the tip is less than a millimetre from a rim, or on the base,"
    assert anything in flat("12", "your-turn-3") and anything in written("two_link_code_generation")


def test_between_two_jumps_the_arm_misses_the_tip():
    said = r"drifts in between: at \$y_3 = (\S+)\$ m, up to (\S+) m from the marked tip\."
    where, most = re.search(said, flat("12", "casts-drag")).groups()
    greatest = []
    made = {"np": np}
    for name in ("casts-motion", "casts-player"):
        exec(cells("12")[name], made)
    assert "At time $t$ in seconds, $x_3$ is $t$ metres." in flat("12", "casts")
    assert "animate([big, big], reach_x," in cells("12")["casts-player"]
    for y in (1.1, 1.6, 2.1):
        x = np.linspace(1.0, 3.5, 2001)
        elbow = np.array([made["listing"](each, y, 2.5, int) for each in x])
        up = np.sqrt(np.maximum(2.5**2 - elbow**2, 0))
        miss = abs(np.hypot(x - elbow, y - up) - 2.5)
        assert (miss > 1e-3).mean() > 0.9
        jumps = np.flatnonzero(abs(np.diff(elbow)) > 0.01)
        assert jumps.tolist() == np.flatnonzero(np.diff(np.floor(x * x))).tolist()
        whole = [*zip(jumps[1:] + 1, jumps[2:], strict=False)]  # from a jump to the next
        assert all(miss[after] < miss[before] for after, before in whole)
        greatest.append(miss.max())
    assert round(max(greatest), 2) == float(most)
    told = flat("12", "casts-drag")
    assert "It jumps wherever $x_3^2$ passes a whole number, first" in told
    first = float(re.search(r"first at \$\\sqrt 2 = (\S+)\$ m", told)[1])
    x, (with_int, with_double) = made["reach_x"], made["off_tip"]
    assert round(np.sqrt(2), 2) == first and x[0] < first
    row = made["lift"].tolist().index(float(where))
    assert f"{with_int[row].max():.2f}" == f"{with_int.max():.2f}" == most
    for away in with_int:
        leaps = np.flatnonzero(abs(np.diff(away)) > 0.01)
        assert leaps.tolist() == np.flatnonzero(np.diff(np.floor(x * x))).tolist()
    assert with_double.max() < 1e-12
