"""Statements that a third set of readers refuted or doubted, recomputed by a different method."""

import contextlib
import io
import re

import numpy as np
import pytest
from conftest import NOTEBOOKS
from scipy.integrate import quad, simpson
from scipy.optimize import minimize_scalar
from scipy.spatial.transform import Rotation
from test_true_statements_b import asked, cells
from test_true_statements_b import run as run_cells
from test_true_statements_c import flat, mistakes, numbers, view

from robokin import IRB140, PUMA560, Quaternion, Transform, deg, lin, mm
from robokin.course import book, check

WRIST = book.find("spherical_wrist.2", "exercises")


def one_line(text):
    return re.sub(r"\s+", " ", text)


def option(name, short):
    """The option of a prediction with the given short name."""
    lab, number = name.split(".")
    text = (NOTEBOOKS / "exercises" / lab / "predictions.md").read_text(encoding="utf-8")
    section = text.split(f"## {number}")[1].split("\n## ")[0]
    names = re.findall(r"^- `(.*?)`", section, re.M)
    return asked(name)[1][names.index(short)]


def says(lab, name):
    ((_, found),) = mistakes(lab, name)
    return one_line(found)


def about(axis, angle):
    """A rotation about an axis, computed by SciPy."""
    return Rotation.from_rotvec(angle * np.array(axis) / np.linalg.norm(axis)).as_matrix()


# --- Lab 01 ---------------------------------------------------------------------------------------


def test_lerp_between_rotations_is_not_a_rotation():
    words = flat("01", "short")
    assert (
        "Strictly between two different rotations, the result of lerp is not a rotation." in words
    )
    assert (
        "If you divide it by its length (nlerp), you get a rotation again, but the speed is not "
        "constant." in words
    )
    third = np.array([np.cos(120 * deg), np.sin(120 * deg), 0, 0])
    # this sum of two unit quaternions has length 1, so it is a rotation
    assert np.linalg.norm([1, 0, 0, 0] + third) == pytest.approx(1)
    s = np.linspace(0, 1, 201)[:, None]
    rng = np.random.default_rng(1)
    for angle in np.append(rng.uniform(1, 179, 20), [1, 179]) * deg:
        a = Rotation.random(random_state=rng)
        axis = rng.normal(size=3)
        b = a * Rotation.from_rotvec(angle * axis / np.linalg.norm(axis))
        chord = (1 - s) * a.as_quat() + s * b.as_quat() * np.sign(a.as_quat() @ b.as_quat())
        assert (np.linalg.norm(chord, axis=1)[1:-1] < 1).all()
        steps = Rotation.from_quat(chord)  # SciPy normalises the quaternions
        speed = (steps[:-1].inv() * steps[1:]).magnitude()
        assert speed.sum() == pytest.approx(angle)
        uneven = speed.max() / speed.min() - 1
        assert uneven == pytest.approx(np.tan(angle / 4) ** 2, rel=0.05)
        means = [(1 - w) * a.as_matrix() + w * b.as_matrix() for w in (0.2, 0.5)]
        assert all(np.linalg.det(mean) < 1 - 1e-6 for mean in means)


def test_test_in_the_last_hint_for_slerp_detects_every_mistake():
    exercise = book.find("frames_and_quaternions.3", "exercises")
    hint = one_line(exercise.hints[2])
    more = "pairs that are 30° and 175° apart, and also (a, a) and (a, -a)"
    assert more in hint
    shares = [float(each) for each in re.search(r"[Ff]or s in \((.*?)\)", hint)[1].split(",")]
    rights = [exercise.program(text) for _, text in exercise.rights]
    wrongs = [(name, exercise.program(text)) for name, _, text in exercise.wrongs]

    def is_right(lead, pairs):
        """The hint's test, with SciPy's slerp in place of ours."""
        for a, b in pairs:
            one, two = (Rotation.from_quat(q, scalar_first=True) for q in (a, b))
            way = (one.inv() * two).as_rotvec()
            for s in shares:
                exact = (one * Rotation.from_rotvec(s * way)).as_quat(scalar_first=True)
                found = np.asarray(lead(a.copy(), b.copy(), s))
                error = min(abs(found - exact).max(), abs(found + exact).max())
                if found.shape != (4,) or not error < 1e-6:
                    return False
        return True

    without = 0
    for seed in range(6):
        rng = np.random.default_rng(seed)
        pairs = []
        while len(pairs) < 20:
            a, b = (q / np.linalg.norm(q) for q in rng.normal(size=(2, 4)))
            if 2 * np.arccos(abs(a @ b)) < 179 * deg:
                pairs.append((a, b))
        a = pairs[0][0]
        more = [(a, a), (a, -a)]
        for angle in (30, 175):
            turn = Rotation.from_rotvec(angle * deg * np.array([2, -1, 2]) / 3)
            b = (Rotation.from_quat(a, scalar_first=True) * turn).as_quat(scalar_first=True)
            more += [(a, b), (a, -b)]
        assert all(is_right(lead, pairs + more) for lead in rights)
        with np.errstate(all="ignore"):
            missed = [name for name, lead in wrongs if is_right(lead, pairs + more)]
            assert not missed, (seed, missed)
            old = dict(wrongs)["nlerp for small rotations"]
            without += is_right(old, pairs + more[:2])  # only the cases of earlier hints
    assert without


def test_skew_axes_with_known_directions_determine_the_dh_parameters():
    reason = one_line(option("frames_and_quaternions.p4", "none").reason)
    assert (
        "Once you have chosen the directions of the axes and of their common perpendicular, that "
        "is right for skew axes, which have only one." in reason
    )
    assert "it is 0°, or 180° if they point in opposite directions" in one_line(
        option("frames_and_quaternions.p4", "alpha").reason
    )

    def link(q, d, a, alpha):
        turn, twist = about([0, 0, 1], q), about([1, 0, 0], alpha)
        return turn @ twist, turn @ [a, 0, 0] + [0, 0, d]

    for q, d, a, alpha in np.random.default_rng(4).uniform(0.2, 1.3, (10, 4)):
        (R, p), (S, r) = link(q, d, a, alpha), link(q + np.pi, d, -a, -alpha)
        # both links lead to the same next axis
        assert np.allclose(R[:, 2], S[:, 2]) and np.allclose(p, r)
        assert np.allclose(R[:, 0], -S[:, 0])  # the x axes are opposite
        # if the directions of x and z are known, all four parameters can be read from the frame
        read = np.arctan2(R[1, 0], R[0, 0]), p[2], p @ R[:, 0], np.arctan2(R[2, 1], R[2, 2])
        assert np.allclose(read, (q, d, a, alpha))
        assert np.allclose(np.cross(link(q, d, a, np.pi)[0][:, 2], [0, 0, 1]), 0)


# --- Lab 03 ---------------------------------------------------------------------------------------


def test_line_at_variable_speed_saves_most_of_the_lost_time_but_never_beats_ptp():
    """Joint 1 is computed from the position of the wrist centre, the other joints with `ik`."""
    reason = one_line(option("irb140_motion.p2", "between").reason)
    (best,) = numbers(r"It takes (\S+) s\.", reason)
    (low,) = numbers(r"at the start, joint 1 moved at only (\d+) % of its speed limit", reason)
    (turn,) = numbers(r"joint 1 turns by (\d+)° in both", reason)
    question = one_line(asked("irb140_motion.p2")[0])
    (lin_time,), (ptp_time,) = (
        numbers(p, question) for p in (r"in LIN and took (\S+) s;", r"in PTP, it took (\S+) s")
    )
    s = np.linspace(0, 1, 4001)
    first, last = about([-1, 0, 0], np.pi / 2), about([0, 1, 0], np.pi / 2)
    way = Rotation.from_matrix(last @ first.T).as_rotvec()
    tool = (Rotation.from_rotvec(s[:, None] * way)).as_matrix() @ first @ [0, 0, 1]
    place = [200, 400, 600] + s[:, None] * np.subtract([200, -300, 800], [200, 400, 600])
    centre = place - 65 * tool
    # front row: joint 1 points to the wrist centre
    q1 = np.unwrap(np.arctan2(centre[:, 1], centre[:, 0]))
    share = abs(np.gradient(q1, s)) / IRB140.speed_limits[0]
    assert 100 * share[0] / share.max() == pytest.approx(low, abs=0.5)
    assert abs(q1[-1] - q1[0]) / deg == pytest.approx(turn, abs=0.5)
    assert share.max() == pytest.approx(lin_time, abs=5e-3)  # joint 1 sets the pace
    assert abs(s[share.argmax()] - 0.5) < 0.05  # near the middle of the line
    assert abs(q1[-1] - q1[0]) / IRB140.speed_limits[0] == pytest.approx(ptp_time, abs=5.1e-3)
    line = lin(
        Transform(Quaternion.from_angle_axis(90 * deg, (-1, 0, 0)), (0.2, 0.4, 0.6)),
        Transform(Quaternion.from_angle_axis(90 * deg, (0, 1, 0)), (0.2, -0.3, 0.8)),
        s,
    )
    rest = abs(np.gradient(np.unwrap(IRB140.ik(line)[:, 1], axis=0), s, axis=0)[:, 1:])
    most = np.maximum(share, (rest / IRB140.speed_limits[1:]).max(axis=-1))
    assert simpson(most, x=s) == pytest.approx(best, abs=5e-3)
    assert ptp_time < best and lin_time - best > 0.5 * (lin_time - ptp_time)


def test_trapezoidal_law_brakes_at_full_strength_until_the_end():
    reason = one_line(option("irb140_motion.p4", "trapezoidal").reason)
    assert "brakes with the same deceleration to the very end. The quintic law brakes" in reason
    bell = one_line(option("irb140_motion.p4", "triangle").second)
    assert bell.endswith("the bell-shaped curve of the quintic law is lower.")
    law = np.polynomial.Polynomial([0, 0, 0, 10, -15, 6])
    slope, brake = law.deriv(), law.deriv(2)
    ramp = 0.25  # fraction of the time; peak speed / mean speed is 1 / (1 - ramp) = 4/3
    assert float(option("irb140_motion.p4", "trapezoidal").text) == pytest.approx(133.3)
    steady = 1 / (ramp * (1 - ramp))
    x = np.linspace(0, 1, 100001)
    assert brake(1.0) == 0 and -brake(x).min() > steady  # the quintic brakes harder, before the end
    assert (-brake(x[x > 0.86]) < steady).all()
    assert slope(0.5) == 1.875 and quad(slope, 0, 1)[0] == pytest.approx(1)
    narrow = np.polynomial.Polynomial([0, 0, 0, 0, 0, 1]) * np.polynomial.Polynomial([1, -1]) ** 5
    # this bell-shaped curve has a higher peak than a triangle
    assert narrow(0.5) / quad(narrow, 0, 1)[0] > 2


def test_quintic_corner_raises_the_tools_peak_acceleration_by_the_stated_factor():
    second = one_line(option("irb140_motion.p7", "much more").second)
    told = (
        r"At the same blend, the greatest acceleration of the tool in the quintic corner is (\S+)"
    )
    (factor,) = numbers(told + r" times that in the parabola\.", second)
    start, via, goal = np.array([[200, 400, 200], [650, -100, 800], [300, 300, 500.0]])
    x = np.linspace(0, 1, 1001)[:, None]

    def curve(controls):
        """A Bezier curve, evaluated by de Casteljau's algorithm."""
        rows = [np.broadcast_to(each, (len(x), 3)) for each in controls]
        while len(rows) > 1:
            rows = [(1 - x) * a + x * b for a, b in zip(rows[:-1], rows[1:], strict=True)]
        return rows[0]

    for b in (0.05, 0.1, 0.3, 0.4, 0.5):
        A, C = via + 2 * b * (start - via), via + 2 * b * (goal - via)
        inside = [A + k * (via - A) for k in (0, 0.4, 0.8)]
        outside = [C + k * (via - C) for k in (0.8, 0.4, 0)]
        peaks = [
            np.linalg.norm(np.diff(curve(each), 2, axis=0), axis=1).max()
            for each in ([A, via, C], [*inside, *outside])
        ]
        assert peaks[1] / peaks[0] == pytest.approx(factor, rel=1e-3)
    # a single joint can have a lower peak with the quintic corner: joint 3 at blend 0.4
    made = run_cells("03", "bezier-code")
    s = np.linspace(0, 1, 4001)
    third = []
    for kind in ("parabola", "quintic"):
        q = IRB140.ik(made["blend"](made["start"], made["via"], made["goal"], 0.4, s, corner=kind))
        third.append(abs(np.diff(np.unwrap(q[:, 1, 2]), 2)).max())  # row 1, as in the lab
    assert third[1] < third[0]


def test_joint_4_can_have_two_values_inside_its_limits():
    others = (
        "The given value of any other joint may also be outside its limits, so that you have to "
        "add or subtract one or more whole turns"
    )
    one, two = says("irb140_motion", "only joint 6"), says("irb140_motion", "only joints 4 and 6")
    assert f"{others}, and joint 4 may have two values inside its limits." in one
    assert f"{others}." in two
    given = np.arange(-180, 180, 0.5)[:, None] + 360 * np.arange(-4, 5)
    most = []
    for low, high in IRB140.limits / deg:
        most.append(((low - 1e-9 <= given) & (given <= high + 1e-9)).sum(axis=1))
    assert [counts.max() for counts in most] == [2, 1, 1, 2, 1, 3]
    # joint 1 can have two values only at ±180 degrees
    assert (most[0] == 2).sum() == 1 and given[most[0] == 2, 4] == -180
    assert (most[3] == 2).sum() > 50 and most[5].min() == 2
    cases = book.find("irb140_motion.2", "exercises").cases
    for k in range(5):
        assert any(not x[k, 0] <= q1[k] <= x[k, 1] for _, q1, _, x in cases), k + 1


# --- Lab 04 ---------------------------------------------------------------------------------------


def zone_area(a, m, l1=0.2, l2=0.25):
    """The floor area that the arm reaches with either elbow, in m², integrated over circles."""

    def served(r):
        q2 = np.arccos(np.clip((r * r - l1**2 - l2**2) / (2 * l1 * l2), -1, 1))
        if q2 > m:
            return 0.0
        i = np.arctan2(l2 * np.sin(q2), l1 + l2 * np.cos(q2))
        # elbow +1 reaches the directions from i - a to i + a, and elbow -1 their mirror image
        behind = min(np.pi, a + i)
        return 2 * r * (behind - max(0.0, i - a))

    rim = np.sqrt(l1**2 + l2**2 + 2 * l1 * l2 * np.cos(m))
    at = np.linspace(rim, l1 + l2, 40)
    return sum(
        quad(served, *ends, epsabs=1e-9, limit=200)[0] for ends in zip(at, at[1:], strict=False)
    )


@pytest.mark.parametrize(
    ("stops", "stop"),
    [
        ((140, 150), None),
        ((150, 150), None),
        ((140, 120), None),
        ((120, 120), None),
        ((180, 150), None),
        ((190, 150), 1),  # joint 1 reaches some places twice
        ((100, 120), 2),  # the formula is 0.39 % too low
        ((90, 120), 2),  # the formula is 1.65 % too low
        ((60, 150), 2),
        ((90, 150), 1),  # the workspace has a gap in front
        ((45, 170), 1),
    ],
)
def test_area_formula_holds_or_the_cell_says_that_it_does_not(stops, stop):
    words = flat("04", "deeper-area")
    assert r"let the second link turn as far as its mirror image: $\gamma \le m$" in words
    assert "at $q_2 = m$ is at most $a$. Then, for $a \\le 180°$:" in words
    told = io.StringIO()
    changed = [("stops = [140, 150]", f"stops = {list(stops)}"), ("fine = 2.0", "fine = 4.0")]
    with contextlib.redirect_stdout(told):
        made = run_cells(
            "04",
            "zone-code",
            "zone-grid",
            "target-code",
            "deeper-area-code",
            changed=changed,
        )
    *_, first, last = told.getvalue().splitlines()
    if stops[0] <= 180:
        off = re.fullmatch(r"formula, one elbow: \d+ cm², the grid is (\S+) % off", first)
        assert abs(float(off[1])) < 0.3
    else:
        stated = f"The formula for one elbow is not valid here: joint 1 stops at {stops[0]}°"
        assert first.startswith(stated)
    exact = zone_area(*np.array(stops) * deg)
    assert made["reached"].sum() * 16e-6 == pytest.approx(exact, rel=0.003)
    wrong = abs(made["both_area"] / exact - 1)
    if stop is None:
        assert wrong < 1e-4 and f"either elbow: {exact * 1e4:.0f} cm²" in last
    else:
        assert wrong > 5e-4
        stopped = f"The formula is not valid here: joint {stop} stops at {stops[stop - 1]}°"
        assert last.startswith(stopped)


# --- Lab 05 ---------------------------------------------------------------------------------------


def test_only_a_rotation_about_the_tools_axis_leaves_the_wrist_centre_in_place():
    found = option("scara_motion.p1", "q1+q2+q3+q4")
    assert "a tilt moves the wrist centre, which joints 1 to 3 carry." in one_line(found.reason)
    assert (
        "too, joint 6 alone can turn the tool about the tool's own axis. Any other rotation about"
        in (one_line(found.second))
    )
    rng = np.random.default_rng(5)
    for q in rng.uniform(-1, 1, (10, 6)):
        q[4] = abs(q[4]) + 0.1
        pose = IRB140.fk(q)
        R, place = pose.rotation.as_matrix(), pose.translation
        rows = IRB140.ik(pose)
        row = np.nanargmin(np.linalg.norm(np.sin((rows - q) / 2), axis=1))

        def moved(turn, R=R, place=place, row=row, rows=rows):
            """Whether each joint moves, and how far the wrist centre moves, in mm."""
            there = Transform(Quaternion.from_matrix(R @ turn), place)
            other = IRB140.ik(there)[row]
            centre = np.linalg.norm(65 * (R @ turn - R)[:, 2])
            return abs(np.sin((other - rows[row]) / 2)) > 1e-9, centre

        joints, centre = moved(about([0, 0, 1], 0.3))
        assert joints.tolist() == [False] * 5 + [True] and centre < 1e-9
        for axis in rng.normal(size=(5, 3)):
            joints, centre = moved(about(axis, 0.05))
            assert centre > 0.01 and joints[:3].any()


# --- Lab 06 ---------------------------------------------------------------------------------------


def by_hand(phi, theta, psi):
    """Rot(z, phi) Rot(y, theta) Rot(z, psi), computed entry by entry, so that small entries keep
    their digits.
    """
    (a, b, c), (x, y, z) = np.cos([phi, theta, psi]), np.sin([phi, theta, psi])
    return np.array(
        [
            [a * b * c - x * z, -a * b * z - x * c, a * y],
            [x * b * c + a * z, a * c - x * b * z, x * y],
            [-y * c, y * z, b],
        ]
    )


def off(program, h):
    with np.errstate(invalid="ignore"):
        return np.array([abs(by_hand(*program(each, +1)) - each).max() for each in h])


def kinds(theta, count=60):
    """Matrices made by `by_hand`, and the same matrices with the rounding errors of products with
    other rotations.
    """
    rng = np.random.default_rng(8)
    exact = np.array([by_hand(f, theta, s) for f, s in rng.uniform(-3, 3, (count, 2))])
    back = Rotation.random(count, random_state=rng).as_matrix()
    return exact, back.swapaxes(1, 2) @ (back @ exact)


def lab_06():
    names = "table-code twins zyz-drawing zyz-code regular-code noise-code cure-code"
    with contextlib.redirect_stdout(io.StringIO()):
        return run_cells("06", *names.split(), "root-code")


def singular_too(program, right):
    """The program with its results corrected where sin(theta) = 0."""

    def found(h, wrist):
        with np.errstate(invalid="ignore"):
            return (right if np.hypot(h[0, 2], h[1, 2]) < 1e-13 else program)(h, wrist)

    return found


def test_hint_and_solution_reject_a_program_that_only_improves_the_root():
    made = lab_06()
    right, better = made["my_wrist"], singular_too(made["better_root"], made["my_wrist"])
    worst = {1e-10: 1e-6, 1e-9: 1e-7, 1e-8: 1e-8, 1e-7: 1e-9}
    for theta, least in worst.items():
        exact, rounded = kinds(theta)
        for chain in (rounded, made["wrists"](theta)):
            assert abs(chain @ chain.swapaxes(1, 2) - np.eye(3)).max() < 3e-15
            assert off(better, chain).max() > least and off(right, chain).max() < 1e-14
        assert off(better, exact).max() < 1e-14  # matrices made by zyz do not show the error
    one, _, three = (one_line(hint) for hint in WRIST.hints)
    assert (
        "try matrices that come from my_chain, such as those of `wrists(theta)` in section 5."
        in one
    )
    told = (
        "In a matrix from zyz, small entries are accurate to all digits; in a matrix from a chain,"
    )
    assert f"{told} they are not." in one
    assert "a random rotation B for each pair. The product B.T @ (B @ h) is h with" in three
    lines = [line for line in WRIST.hints[2].split("\n") if line[:4] == "    "]
    body = "\n".join("        " + line[4:] for line in lines)
    tried = (
        "def test(wrist_angles):\n    rng = np.random.default_rng(2)\n"
        "    for phi, psi in [(np.pi / 4, 0.3), *rng.uniform(-np.pi, np.pi, (7, 2))]:\n"
        f"        B = zyz(*rng.uniform(-np.pi, np.pi, 3))\n{body}\n    return True\n"
    )
    space = {"np": np, "zyz": by_hand}
    exec(compile(tried, "hint", "exec"), space)
    exec(compile(WRIST.solution, "solution", "exec"), space)
    for test in (space["test"], space["wrist_is_right"]):
        assert test(right) and not test(better)
        assert check("spherical_wrist.2", test).holds
    assert "only a better root" in {name for name, _, _ in WRIST.wrongs}
    told = says("spherical_wrist", "only a better root")
    assert (
        "In a matrix from a chain, these have rounding errors of 1e-16 and are inaccurate" in told
    )
    assert "in a matrix from zyz, they are not" in told


def test_a_hundred_matrices_are_enough_to_test_wrist_programs():
    assert "A hundred matrices are enough if you choose them well." in flat("06", "more")
    rng = np.random.default_rng(11)
    pairs = [(np.pi / 4, 0.3), (2, -0.5), *rng.uniform(-np.pi, np.pi, (4, 2))]
    chosen = []
    for theta in (0, 1e-8, 1e-4, 2, np.pi - 1e-4, np.pi - 1e-8, np.pi):
        for phi, psi in pairs:
            exact, back = by_hand(phi, theta, psi), Rotation.random(random_state=rng).as_matrix()
            chosen += [exact, back.T @ (back @ exact)]
    assert len(chosen) <= 100

    def test(program):
        for h in chosen:
            for wrist in (1, -1):
                found = program(h, wrist)
                if not abs(by_hand(*found) - h).max() < 1e-10:
                    return False
                if not -1e-10 <= wrist * found[1] <= np.pi + 1e-10:
                    return False
        return True

    assert check("spherical_wrist.2", test).holds


def test_regular_formulas_lose_digits_at_the_stated_angle():
    low, high = (
        says("spherical_wrist", f"the regular formulas at theta = {place}")
        for place in ("0", "180 degrees")
    )
    told = "its angles are inaccurate: try"
    assert low == f"Near theta = 0, {told} 1e-8 rad, and angles just as close to 180 degrees."
    high_told = f"{told} 180 degrees minus 1e-8 rad, and angles just as close to 0."
    assert high == f"Near theta = 180 degrees, {high_told}"
    made = lab_06()
    book_way = made["textbook_wrist"]
    for theta in (1e-8, np.pi - 1e-8):
        for h in kinds(theta):
            assert not (off(book_way, h) < 1e-10).any()
            assert (off(made["my_wrist"], h) < 1e-14).all()
    exact, rounded = kinds(1e-6)
    assert (off(book_way, exact) < 1e-10).all()  # no digits are lost for exact matrices
    far = kinds(2e-6, 400)[1]
    found = np.array([book_way(h, +1) for h in far])
    assert np.nanmax(off(book_way, far)) > 1e-10  # digits are lost for rounded matrices
    assert np.isfinite(found).all()


# --- Lab 07 ---------------------------------------------------------------------------------------


def test_the_sampled_lines_do_not_show_which_rule_is_better():
    question, options, right = asked("puma560_branches.p7")
    reason = one_line(options[right].reason)
    (said,) = numbers(r"^About (\d+) %\.$", options[right].text)
    (lines,) = numbers(r"^Take (\d+) random straight lines on which all eight rows", question)
    one, other = numbers(r"fail on (\d+) and (\d+) % of them\.", reason)[:1] + numbers(
        r"^It cannot finish (\d+) % of these", reason
    )
    (scatter,) = numbers(r"slightly different \(standard deviation: (\d+) %\)", reason)
    assert scatter == round(100 * np.sqrt(0.42 * 0.58 / lines))
    assert "these lines do not tell you which of the first two rules is better." in reason
    assert "the orientation over all rotations" in view("puma560_branches.p7")
    (low, high), rest = PUMA560.limits.T, np.array([0, 90, -90, 0, 0, 0]) * deg
    rng = np.random.default_rng(2107)  # a different sample, drawn in a different way
    far = np.hypot(431.8 + np.hypot(431.8, 20.3), 150.05) * mm
    wxyz = Rotation.random(6000, random_state=rng).as_quat(scalar_first=True).reshape(2, 3000, 4)
    place = [0, 0, 671.83 * mm] + rng.uniform(-far, far, (2, 3000, 3))
    ends = Transform(Quaternion(wxyz), place)
    ends = ends[:, np.isfinite(PUMA560.ik(ends)).all(axis=(0, 2, 3))]
    missed, turns = [], 2 * np.pi * np.array([0, -1, 1, -2, 2])
    for a, b in zip(*ends, strict=True):
        rows = PUMA560.ik(lin(a, b, np.linspace(0, 1, 101)))
        if not np.isfinite(rows).all():
            continue
        q = np.unwrap(rows, axis=0)[..., None] + turns  # shape (101, 8, 6, 5)
        inside = (q > low[:, None] - 1e-9) & (q < high[:, None] + 1e-9)
        begins = inside[0].argmax(axis=-1)[None, ..., None]  # index of the first value inside
        serves = np.take_along_axis(inside.all(axis=0)[None], begins, -1)[0, ..., 0].all(axis=-1)
        if not serves.any():
            continue
        first = np.take_along_axis(q[:1], begins, -1)[0, ..., 0]  # shape (8, 6)
        first = np.where(inside[0].any(axis=-1), first, rows[0])
        usable = inside[0].any(axis=-1).all(axis=-1)
        travel = abs(first - rest).sum(axis=1)
        margin = -np.minimum(first - low, high - first).min(axis=1)
        picks = [np.where(usable, cost, np.inf).argmin() for cost in (travel, margin)]
        missed.append([not serves[k] for k in picks])
    missed = np.array(missed)
    shares = 100 * missed.mean(axis=0)
    bound = 3 * 100 * np.sqrt(0.24 / len(missed))
    assert said == 40 and abs(shares - 41).max() < bound
    both = np.sqrt((missed[:, 0] != missed[:, 1]).mean() / lines) * 100
    assert abs(one - other) < 2 * both  # the difference is not significant


def peak(made, name, m, joint):
    """The greatest speed of a joint in °/s, found by a search over differences of `ik`."""
    row, pose, away, along = made["LINES"][name]

    def minus(u):
        step = 1e-4 * m
        places = pose.translation + m * away + np.array([[u - step], [u + step]]) * along
        q = PUMA560.ik(Transform(pose.rotation, places))[:, row]
        turned = np.sin((q[1] - q[0]) / 2)[joint - 1] * 2
        return -abs(turned) / (2 * step) * 0.1 / deg

    at = np.linspace(-1.5, 1.5, 61) * m  # the peak is m / 4 from the middle
    k = int(np.argmin([minus(u) for u in at]))
    best = minimize_scalar(
        minus, bounds=(at[max(k - 1, 0)], at[k + 1]), method="bounded", options={"xatol": 1e-6 * m}
    )
    return -best.fun


def lab_07(*names):
    told = io.StringIO()
    with contextlib.redirect_stdout(told):
        made = run_cells("07", "cross-player", *names)
    return made, told.getvalue()


def test_table_shows_the_greatest_joint_speeds_past_the_wrist_singularity():
    made, told = lab_07("cross-cost")
    head, *table = [line.split() for line in told.splitlines()[-5:]]
    assert head[:4] == ["m,", "mm", "wrist", "°/s,"]
    for row in table:
        m = float(row[0]) * mm
        (said,) = numbers(r"^(\d+)$", row[1])
        assert said == round(peak(made, "wrist", m, 6))
    assert [row[1] for row in table][-1] == "44868"
    (drawn,) = numbers(r"wrist: (\d+),", view("puma560_branches.p6"))
    assert drawn == 44868


def test_player_shows_the_greatest_joint_speed_on_the_line():
    made, _ = lab_07("cross-cost")
    source = cells("07")["cross-player"]
    head, _, tail = source.rpartition("\nanimate(")
    exec(compile(f"{head}\nplayer = animate({tail}", "player", "exec"), made)
    (said,) = numbers(r"greatest speed of \d+ samples (\S+) °/s \(joint 6\)", repr(made["player"]))
    assert said == round(peak(made, "wrist", 2 * mm, 6), 1) == 2244.5


def test_flange_moves_nearly_in_the_arms_plane_at_the_nearest_point():
    reason = one_line(option("puma560_branches.p6", "as towards the axis").reason)
    told = r"the tangent lies nearly in the arm's own plane, at (\S+)° to it"
    (said,) = numbers(told, reason)
    pose = Transform(translation=np.array([151.05, 0, 1200]) * mm)
    q = PUMA560.ik(pose)[2]
    places = PUMA560.frames(q).translation
    step = PUMA560.fk(q + [0, 1e-6, 0, 0, 0, 0]).translation - PUMA560.fk(q).translation
    lifted = PUMA560.fk(q + [0, 0, 1e-6, 0, 0, 0]).translation - PUMA560.fk(q).translation
    normal = np.cross(step, lifted)  # joints 2 and 3 move the flange in the arm's plane
    normal /= np.linalg.norm(normal)
    assert np.isfinite(places).all() and abs(normal[2]) < 1e-6
    assert round(90 - np.arccos(abs(normal[1])) / deg, 1) == said == 6.6
