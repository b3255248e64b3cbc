"""The exercises and predictions of lab 06: correct answers in every style pass, mistakes are named,
and the answer to every prediction is computed by another method.
"""

import itertools
import json
import re
from pathlib import Path

import numpy as np
import pytest

from robokin import ITMO6R, Arm, Link, Quaternion, Transform, deg, dh_links, mm
from robokin.arms.link import home
from robokin.course import book, check, variant
from robokin.course.questions import filled

LAB = book.lab("spherical_wrist")
SHARED, LINE, FACTS = LAB.module("shared"), LAB.module("own_line"), LAB.module("predictions")
AXES, WRIST = LAB.exercises["1"], LAB.exercises["2"]
rot, zyz, turned = SHARED["rot"], SHARED["zyz"], SHARED["turned"]
passage, across = LINE["passage"], LINE["across"]
RIGHTS = [WRIST.program(text) for _, text in WRIST.rights]
WRONGS = {name: WRIST.program(text) for name, _, text in WRIST.wrongs}


# --- Exercise 1: the axes of a measured table -----------------------------------------------------


def _with_the_package(a, alpha, d, offset, beta, q):
    bends = Transform(Quaternion.from_angle_axis(beta, [0, 1, 0]))
    rows = dh_links(a, alpha, d, offset + q)
    links = [Link(row.before, after=row.after @ b) for row, b in zip(rows, bends, strict=True)]
    points, ways, _ = home(links)
    return points, ways


def _elsewhere_on_the_axis(*case):
    points, ways = _with_the_package(*case)
    return [
        [
            (np.asarray(p) + k * w).tolist()
            for k, (p, w) in enumerate(zip(points, ways, strict=True))
        ],
        ways.tolist(),
    ]


def _by_transforms(a, alpha, d, offset, beta, q):
    frame, rows, turn = Transform(), [], Quaternion.from_angle_axis
    for i in range(len(q)):
        rows.append([*frame.translation, *frame.rotation.as_matrix()[:, 2]])
        frame = frame @ Transform(turn(offset[i] + q[i], [0, 0, 1]))
        frame = frame @ Transform(turn(alpha[i], [1, 0, 0]), [a[i], 0, d[i]])
        frame = frame @ Transform(turn(beta[i], [0, 1, 0]))
    return np.array(rows)


def _by_loops(a, alpha, d, offset, beta, q):
    """A program that computes the rotation and the origin of each axis separately."""
    rotation, origin, out = np.eye(3), np.zeros(3), ([], [])
    for i in range(len(a)):
        out[0].append(origin + 0.3 * rotation[:, 2])
        out[1].append(rotation @ [0, 0, 1])
        angle = q[i] + offset[i]
        along = rotation @ [np.cos(angle), np.sin(angle), 0]
        across = np.cross(rotation[:, 2], along)
        up = np.cos(alpha[i]) * rotation[:, 2] - np.sin(alpha[i]) * across
        origin = origin + d[i] * rotation[:, 2] + a[i] * along
        side = np.cross(up, along)
        ahead = np.cos(beta[i]) * along - np.sin(beta[i]) * up
        rotation = np.stack([ahead, side, np.cross(ahead, side)], axis=1)
    return out


@pytest.mark.parametrize(
    "answer", [_with_the_package, _elsewhere_on_the_axis, _by_transforms, _by_loops]
)
def test_axes_found_by_other_methods_pass(answer):
    verdict = check("spherical_wrist.1", answer)
    assert verdict.holds, verdict


@pytest.mark.parametrize("mistake", AXES.own, ids=lambda m: m.name)
def test_mistakes_in_axes_are_named(mistake):
    verdict = check("spherical_wrist.1", AXES.steps.program(mistake))
    assert not verdict.holds and verdict.mistake == mistake.name
    assert mistake.says in verdict.says
    assert any(word in verdict.case for word in ("should", "wanted", "IndexError"))


@pytest.mark.parametrize(
    ("answer", "name"),
    [
        (lambda *c: _by_loops(*c)[1], "another kind or shape"),
        (lambda *c: _by_loops(*c[:5], -c[5]), "the joints turn"),
        (lambda a, alpha, *c: _by_loops(a, alpha / deg, *c), "degrees"),
        (lambda a, alpha, d, *c: _by_loops(a, alpha, 0 * d, *c), "d is left out"),
        (lambda *c: _by_loops(*(column[:6] for column in c)), "six rows assumed"),
        (
            lambda a, alpha, d, offset, beta, q: _by_loops(
                [0, 0.1, 0, 0, 0, 0], alpha, [0.1, 0, 0, 0.2, 0, 0.2], offset, beta, q[:6]
            ),
            "lengths of this lab assumed",
        ),
    ],
)
def test_other_mistakes_in_axes_are_recognised(answer, name):
    verdict = check("spherical_wrist.1", answer)
    assert not verdict.holds and name in verdict.mistake


def _frames_of_an_arm(a, alpha, d, offset, beta, q, first=0):
    """The package's frames of a table with four columns: beta is left out."""
    links = dh_links(a, alpha, d, offset)
    frames = Arm("of four columns", links, [(-9, 9)] * len(q)).frames(q).as_matrix()
    rows = frames[first : first + len(q), :3]
    return rows[:, :, 3], rows[:, :, 2]


def test_frames_of_the_package_lack_the_fifth_column():
    verdict = check("spherical_wrist.1", _frames_of_an_arm)
    assert not verdict.holds and verdict.mistake == "beta is left out"
    verdict = check("spherical_wrist.1", lambda *c: _frames_of_an_arm(*c, first=1))
    assert not verdict.holds and "beta is left out" in verdict.mistake
    assert "the frame after the joint" in verdict.mistake


def _every_frame(*case):
    """The frames after the rows, too: n + 1 of them."""
    points, ways = _with_the_package(*(np.append(column, 0.0) for column in case))
    return points, ways


def _views(a, alpha, d, offset, beta, q):
    """Views of one array that changes afterwards: all of them show the last frame."""
    frame, points, ways = np.eye(4), [], []
    for i in range(len(q)):
        points.append(frame[:3, 3])
        ways.append(frame[:3, 2])
        row = rot(2, offset[i] + q[i]) @ SHARED["trans"](a[i], 0, d[i]) @ rot(0, alpha[i])
        frame[:] = frame @ row @ rot(1, beta[i])
    return points, ways


def _rows(a, alpha, d, offset, beta, q):
    """Rows of each rotation and matrix, where columns are wanted."""
    made = [np.eye(4)]
    for i in range(len(q) - 1):
        made.append(made[-1] @ rot(2, offset[i] + q[i]) @ rot(0, alpha[i]) @ rot(1, beta[i]))
    return np.zeros((len(q), 3)), [matrix[2, :3] for matrix in made]


@pytest.mark.parametrize(
    ("answer", "name", "why"),
    [
        (_every_frame, "a frame too many", "leave it out"),
        (_views, "the last frame in every row", "copy"),
        (_rows, "rows instead of columns", "frame[:3, 3]"),
    ],
)
def test_frames_too_many_and_views_are_recognised(answer, name, why):
    verdict = check("spherical_wrist.1", answer)
    assert verdict.mistake == name and any(why in line for line in verdict.says), verdict
    assert "1 joints" not in verdict.case


def _swapped_elsewhere(*case):
    return _elsewhere_on_the_axis(*case)[::-1]


def _of_length_five(*case):
    points, ways = _with_the_package(*case)
    return points, 5 * np.asarray(ways)


@pytest.mark.parametrize(
    ("answer", "name"),
    [
        (_swapped_elsewhere, "points and directions swapped"),
        (_of_length_five, "the direction is not a unit vector"),
    ],
)
def test_vectors_that_are_not_unit_vectors_are_reported(answer, name):
    verdict = check("spherical_wrist.1", answer)
    assert verdict.mistake == name and "not a unit vector" in verdict.case


def test_verdict_shows_the_returned_arrays():
    wrong = check("spherical_wrist.1", lambda *c: -np.array(_by_loops(*c)))
    shown = next(line for line in wrong.case.split("\n") if "you return" in line)
    assert shown.strip().startswith("you return points [[") and "directions [[" in shown
    assert len(shown) < 140


# --- Exercise 2: a test for wrist programs --------------------------------------------------------


def rebuilt(phi, theta, psi):
    """The rotation matrix of these angles, even if they are NaN or in degrees."""
    return rot(2, phi)[:3, :3] @ rot(1, theta)[:3, :3] @ rot(2, psi)[:3, :3]


def _judges(angles, exact):
    def test(program):
        for theta in angles:
            for phi, psi in np.random.default_rng(3).uniform(-3, 3, (30, 2)):
                for wrist in (1, -1):
                    h = zyz(phi, theta, psi)
                    found = np.asarray(program(h, wrist), dtype=float)
                    if not np.isfinite(found).all() or wrist * found[1] < -exact:
                        return False
                    if abs(rebuilt(*found) - h).max() > exact:
                        return False
        return True

    return test


def test_only_certain_wrong_programs_pass_at_regular_angles():
    for angles in ([0.3, 1.0, 3.0], [0, np.pi], [1e-9, 1e-7, 1e-5, np.pi - 1e-7]):
        judge = _judges(angles, 1e-10)
        assert all(judge(program) for program in RIGHTS)
    judge = _judges([0.3, 1.0, 3.0], 1e-10)
    caught = {name for name, program in WRONGS.items() if not judge(program)}
    only_there = set(WRONGS) - caught
    assert only_there == {
        "the regular formulas near the singularity",
        "a coarse threshold",
        "the regular formulas at theta = 0",
        "the regular formulas at theta = 180 degrees",
        "a coarse threshold at theta = 0",
        "a coarse threshold at theta = 180 degrees",
        "the difference at theta = 0, too",
        "the sum at theta = 180 degrees, too",
        "NaN at the singularity",
        "NaN for the free angle",
        "theta beyond half a turn",
        "only a better root",
    }


@pytest.mark.parametrize(
    ("test", "mistake"),
    [
        (_judges([0.3, 1.0], 1e-10), "accepts: the regular formulas near the singularity"),
        (_judges([0.3, 1.0, 3.0], 1e-17), "rejects every program"),
        (
            _judges([0, 1e-8, 1e-4, 1, 2, np.pi], 1e-10),
            "accepts: the regular formulas at theta = 180 degrees",
        ),
        (
            _judges([0, 1, 2, np.pi - 1e-4, np.pi - 1e-8, np.pi], 1e-10),
            "accepts: the regular formulas at theta = 0",
        ),
        (
            _judges([1e-8, 1e-4, 1, 2, np.pi - 1e-4, np.pi - 1e-8, np.pi], 1e-10),
            "accepts: the difference at theta = 0, too",
        ),
        (lambda p: True, "accepts every program"),
        (
            lambda p: bool(np.allclose(p(zyz(0.3, 1, 0.2), 1), (0.3, 1, 0.2))),
            "accepts: the flag is ignored",
        ),
        (
            lambda p: bool(np.allclose(p(zyz(3, 0, 2), 1), (0, 0, 5 - 2 * np.pi))),
            "rejects a correct program",
        ),
    ],
)
def test_programs_accepted_by_weak_tests_are_named(test, mistake):
    assert check("spherical_wrist.2", test).mistake == mistake


def _with_slack(program):
    """A careful test, except that it uses the default relative tolerance of allclose."""
    for theta in (0, 1e-9, 1e-8, 1e-4, 1, 2, np.pi - 1e-9, np.pi):
        for phi, psi in [(np.pi / 4, 0.3), (2, -0.5), (-2, 3)]:
            for wrist in (1, -1):
                found, h = program(zyz(phi, theta, psi), wrist), zyz(phi, theta, psi)
                if not np.allclose(rebuilt(*found), h, atol=1e-10):
                    return False
                if not -1e-10 <= wrist * found[1] <= np.pi + 1e-10:
                    return False
    return True


def _blind(program):
    """A careful test, except that it does not detect NaN."""
    for theta in (0, 1e-9, 1e-8, 1e-4, 1, 2, np.pi - 1e-9, np.pi):
        for phi, psi in [(np.pi / 4, 0.3), (2, -0.5), (-2, 3), (1, 1), (0.2, 2.2)]:
            for wrist in (1, -1):
                h = zyz(phi, theta, psi)
                found = program(h, wrist)
                if abs(rebuilt(*found) - h).max() > 1e-10:
                    return False
                if not np.isfinite(found[1]) or not -1e-10 <= wrist * found[1] <= np.pi + 1e-10:
                    return False
    return True


@pytest.mark.parametrize(
    ("test", "name", "why"),
    [(_with_slack, "psi off by 1e-8 rad", "rtol=0"), (_blind, "NaN for the free angle", "NaN")],
)
def test_loose_comparisons_are_reported(test, name, why):
    verdict = check("spherical_wrist.2", test)
    assert verdict.mistake == f"accepts: {name}" and any(why in line for line in verdict.says)
    assert f"{name}\n" in repr(verdict) and "The mistake" not in repr(verdict)  # the case names it


def test_code_in_hints_can_be_run():
    for name in "23":
        code = [line for line in LAB.exercises[name].hints[2].split("\n") if line[:4] == "    "]
        compile("def f():\n" + "\n".join(code), name, "exec")


def from_a_chain(h):
    """The same rotation, with the rounding errors of a product."""
    back = turned(0.8, np.array([2, -1, 2]) / 3).as_matrix()
    return back.T @ (back @ h)


def _by_assertion(make):
    def test(program):
        for theta in (0, 1e-9, 1e-8, 1e-4, 1, 2, np.pi - 1e-4, np.pi - 1e-8, np.pi):
            for phi, psi in [(np.pi / 4, 0.3), (2, -0.5), (-2, 3), (1, 1)]:
                for h, wrist in itertools.product(make(zyz(phi, theta, psi)), (1, -1)):
                    found = program(h, wrist)
                    assert abs(rebuilt(*found) - h).max() < 1e-10
                    assert -1e-10 < wrist * found[1] < np.pi + 1e-10

    return test


def test_stricter_test_than_the_task_allows_rejects_a_correct_program():
    def test(program):
        h = zyz(2, 1, -0.5)
        return bool(abs(rebuilt(*program(h, 1)) - h).max() < 1e-12)

    verdict = check("spherical_wrist.2", test)
    assert verdict.mistake == "rejects a correct program" and "half of what" in verdict.case


def test_test_may_refuse_a_program_with_an_assertion():
    assert check("spherical_wrist.2", _by_assertion(lambda h: (h, from_a_chain(h)))).holds


def test_missing_test_of_a_product_of_matrices_is_reported():
    verdict = check("spherical_wrist.2", _by_assertion(lambda h: (h,)))
    assert verdict.mistake == "accepts: only a better root"
    assert any("matrices from a chain" in line for line in verdict.says)


# --- Exercise 3: an individual line ---------------------------------------------------------------


@pytest.mark.parametrize("who", ["Ada", "Bo", "Žydrė", "student 17", 4711])
def test_every_line_is_feasible_but_only_with_a_tilted_tool(who):
    n = LAB.given(who)
    least, fastest = max(passage(n, *tilt) for tilt in across(n["slope"], 0.99 * n["most_tilt"]))
    up, side = next(
        tilt for tilt in across(n["slope"], 0.99 * n["most_tilt"]) if passage(n, *tilt)[0] == least
    )
    line = {"up": up, "side": side, "duration": fastest / n["most_speed"] * 1.0001}
    assert check("spherical_wrist.3", line, who=who).holds
    named = {
        "not tilted": line | {"up": 0.0, "side": 0.0},
        "tilted too far": line | {"up": 1.2 * up, "side": 1.2 * side},
        "too fast": line | {"duration": 0.5 * line["duration"]},
        "too slow": line | {"duration": 3 * line["duration"]},
        "degrees for radians": line | {"up": 10.0, "side": -4.0},
    }
    for mistake, answer in named.items():
        assert check("spherical_wrist.3", answer, who=who).mistake == mistake
    assert "The mistake: too slow." in repr(check("spherical_wrist.3", named["too slow"], who=who))
    wrong_side = {"up": -up, "side": -side, "duration": line["duration"]}
    assert check("spherical_wrist.3", wrong_side, who=who).mistake == "tilted to the wrong side"
    small = {"up": -np.sign(up) * 0.9 * n["most_tilt"], "side": 0.0, "duration": line["duration"]}
    verdict = check("spherical_wrist.3", small, who=who)  # neither side is far enough
    assert verdict.mistake == "tilted to the wrong side" and "to the other side" in verdict.says[0]
    verdict = check("spherical_wrist.3", small | {"up": -small["up"]}, who=who)
    assert verdict.holds or "to the other side" not in " ".join(verdict.says)
    twice = line | {"up": up * deg, "side": side * deg}
    verdict = check("spherical_wrist.3", twice, who=who)
    assert verdict.mistake == "deg twice" and "perpendicular to the line" in verdict.says[0]
    verdict = check("spherical_wrist.3", line | {"up": side, "side": up}, who=who)
    if passage(n, -side, -up)[0] >= n["least_distance"]:
        assert "With up and side swapped, it would also be right" in verdict.says[0]
    elif 50 > abs(n["slope"]) / deg > 40:  # up and side have nearly the same size
        assert verdict.holds or verdict.mistake in ("tilted to the wrong side", "too fast")
    elif not verdict.holds and verdict.mistake not in ("too fast", "too slow"):
        assert verdict.mistake in ("up and side swapped", "tilted along the line", "out of reach")
    for share, askew in itertools.product((0.5, 0.7, 0.9, 1), (-60, -30, 0, 30, 60)):
        c, s = share * np.cos(askew * deg), share * np.sin(askew * deg)
        least, _ = passage(n, -c * up - s * side, -c * side + s * up)
        assert not least >= n["least_distance"]  # NaN means out of reach
    tilt = 0.99 * n["most_tilt"]
    along = [(e * tilt * np.sin(n["slope"]), e * tilt * np.cos(n["slope"])) for e in (1, -1)]
    for up, side in along:
        verdict = check("spherical_wrist.3", line | {"up": up, "side": side}, who=who)
        assert verdict.mistake in ("tilted along the line", "out of reach")
    nothing = check("spherical_wrist.3", dict.fromkeys(line, ...), who=who)
    assert not nothing.answered and "There is no answer yet" in repr(nothing)
    for empty in (None, ...):
        part = check("spherical_wrist.3", line | {"duration": empty}, who=who)
        assert not part.answered and repr(part).split("\n") == [
            "spherical_wrist.3: not answered yet.",
            "There is no value for duration yet: write it into its cell, run that cell, then check "
            "again.",
        ]
    assert not check("spherical_wrist.3", {"up": 0}, who=who).holds


def test_played_line_says_what_is_missing(capsys):
    """The cell that plays a line is not silent if the duration is 0 or less."""
    file = Path(__file__).parent.parent / "notebooks" / "06_spherical_wrist.ipynb"
    cells = json.loads(file.read_text(encoding="utf-8"))["cells"]
    sources = {cell["id"]: "".join(cell["source"]) for cell in cells}
    for line, said in (
        ({"up": ..., "side": ..., "duration": ...}, ""),
        ({"up": 0.01, "side": 0.02, "duration": 0}, "duration 0 s: it must be greater than 0"),
        ({"up": 0.01, "side": 0.02, "duration": -1.5}, "duration -1.5 s: it must be greater than"),
        ({"up": 0.01, "side": 0.02, "duration": 2}, "duration 2.00 s, at most"),
    ):
        space = {"variant": variant}
        exec(sources["given-3"], space)
        space["my_line"] = line
        exec(sources["play-3"], space)
        out = capsys.readouterr().out
        assert said in out and (said or not out), out


# --- Answers to the predictions, by other methods -------------------------------------------------


def right(name):
    _, options, k = filled(LAB.predictions[name])
    return options[k].text


def test_answers_to_the_first_predictions_agree_with_other_methods():
    q = np.array([[0, 60, -60, 0, 45, 0], [0, 60, -60, 90, 45, 0]]) * deg
    moved = np.linalg.norm(np.diff(ITMO6R.frames(q).translation, axis=0)[0], axis=-1)
    assert right("p1").startswith(f"{np.flatnonzero(moved > 1e-9)[0]} alone: ")
    assert float(right("p2")) == pytest.approx(200 * np.sqrt(2), abs=0.5)
    # the forward distance in the arm's plane: 100 mm at 110°, then 200 mm at 150°
    ahead = 100 * np.cos(110 * deg) + 200 * np.cos(150 * deg)
    assert ahead < 0 and right("p3").startswith("−150°")


def test_answers_to_the_last_predictions_agree_with_other_methods():
    pairs = [(30, 40, 50), (-150, -40, -130)]
    one, two = (
        turned(a * deg, (0, 0, 1)) @ turned(b * deg, (0, 1, 0)) @ turned(c * deg, (0, 0, 1))
        for a, b, c in pairs
    )
    assert one.angle_to(two) < 1e-7 and right("p5").startswith("(−150°, −40°, −130°)")
    assert right("p6").startswith("Some give no number")
    thetas, worst, lost = FACTS["noise"]()
    assert 0.05 < lost[9, 0] < 0.4 and not lost[:, 1:].any() and not lost[:7].any()
    assert 1e-7 < worst[9, 0] < 1e-5 and worst[:, 2].max() < 1e-12
    assert 1 - np.cos(1e-9) == 0 and right("p7") == "Joints 1 and 6."
    fast = [FACTS["fastest"](miss * mm) for miss in (4, 2, 1)]
    assert np.allclose(fast[1:] / np.array(fast[:-1]), 2, rtol=0.01)
    assert right("p8").startswith("5730°/s")
    assert fast[2] * deg == pytest.approx(100, rel=1e-5)  # the tool's speed divided by the miss


def test_test_must_check_the_middle_angle():
    whole = _judges([0, 1e-8, 1e-4, 1, 2, np.pi - 1e-4, np.pi - 1e-8, np.pi], 1e-10)

    def first_and_last(program):
        """A test that computes a matching theta and ignores the program's theta."""

        def mended(h, wrist):
            phi, _, psi = program(h, wrist)
            return phi, np.arctan2(wrist * np.hypot(h[0, 2], h[1, 2]), h[2, 2]), psi

        return whole(mended)

    verdict = check("spherical_wrist.2", first_and_last)
    assert not verdict.holds and verdict.mistake.startswith("accepts: "), verdict
    arcsin = WRONGS["arcsin for theta"]
    assert first_and_last(arcsin) and not whole(arcsin)


def test_strings_are_refused_and_different_numbers_print_differently():
    good = {"up": 0.01, "side": 0.0, "duration": 2.0}
    for key in good:
        text = check("spherical_wrist.3", good | {key: str(good[key])}, who="Ada")
        assert text.mistake == "another kind or shape" and key in text.says[0]
    longest = variant("spherical_wrist", "Ada")["longest"]
    late = check("spherical_wrist.3", good | {"duration": longest + 0.01}, who="Ada")
    assert any(f"{longest:.2f} s; yours takes {longest + 0.01:.2f} s" in x for x in late.says)

    def little_off(*case):
        points, ways = np.array(_by_loops(*case))
        return points, ways + 5e-5

    told = check("spherical_wrist.1", little_off).case
    way, got = re.search(r"direction \((.*?)\), not \((.*?)\)", told).groups()
    assert way != got
