"""The exercises of lab 10: correct answers in every style pass, mistakes are named, and individual
tasks can be solved.
"""

import re
from functools import cache, partial
from itertools import product

import numpy as np
import pytest
from matplotlib.path import Path as Outline

from robokin import deg, three_lever
from robokin.course import book, check, hint, solution, variant
from robokin.jobs.obstacles import along, clearance, way_round

arm = three_lever(1.0)
lever_distances = book.lab("obstacle_avoidance").module("shared")["distances"]


def _sides(c):
    return zip(c, np.roll(c, -1, axis=0), strict=True)


def _angle_sum(c, H):
    a = np.arctan2(c[:, 1] - H[1], c[:, 0] - H[0])
    turns = (np.diff(np.append(a, a[0])) + np.pi) % (2 * np.pi) - np.pi
    return round(turns.sum() / (2 * np.pi)) % 2 == 1


def _upward(c, H):
    count = 0
    for i in range(len(c)):
        (x0, y0), (x1, y1) = c[i - 1], c[i]
        if (x0 <= H[0]) != (x1 <= H[0]):
            count += y0 + (H[0] - x0) * (y1 - y0) / (x1 - x0) > H[1]
    return int(count % 2)


def _to_the_left(c, H):
    odd = False
    for P, Q in _sides(c):
        if min(P[1], Q[1]) < H[1] <= max(P[1], Q[1]):
            odd ^= P[0] + (H[1] - P[1]) * (Q[0] - P[0]) / (Q[1] - P[1]) < H[0]
    return odd


@pytest.mark.parametrize(
    "right", [_angle_sum, _upward, _to_the_left, lambda c, H: Outline(c).contains_point(H)]
)
def test_correct_point_in_polygon_tests_pass_in_every_style(right):
    """H is inside if an odd number of outlines contain it."""

    def inside(outlines, H):
        return sum(bool(right(corners, H)) for corners in outlines) % 2

    assert check("obstacle_avoidance.1", inside).holds


def test_library_function_that_ignores_holes_fails():
    def compound(outlines, H):
        return Outline.make_compound_path(*map(Outline, outlines)).contains_point(H)

    def any_of_them(outlines, H):
        return any(Outline(corners).contains_point(H) for corners in outlines)

    assert not check("obstacle_avoidance.1", compound).holds
    assert check("obstacle_avoidance.1", any_of_them).mistake == "inside any outline"


def _every_side(outlines):
    return [side for corners in outlines for side in _sides(corners)]


def _areas(outlines, H):
    def area(P, Q):
        return abs((P[0] - H[0]) * (Q[1] - H[1]) - (P[1] - H[1]) * (Q[0] - H[0])) / 2

    def within(c):
        x, y = c.T
        whole = abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
        return abs(sum(area(P, Q) for P, Q in _sides(c)) - whole) < 1e-9

    return sum(map(within, outlines)) % 2 == 1


def _both_ways(outlines, H):
    return sum((P[1] > H[1]) != (Q[1] > H[1]) for P, Q in _every_side(outlines)) % 2 == 1


def _returns_early(outlines, H):
    for P, Q in _every_side(outlines):
        if (P[1] > H[1]) != (Q[1] > H[1]):
            if H[0] < P[0] + (H[1] - P[1]) * (Q[0] - P[0]) / (Q[1] - P[1]):
                return True
    return False


def _winding(outlines, H):
    """A test by the nonzero rule instead of the even-odd rule: the middle of a star that is drawn
    in one line counts as inside.
    """
    turn = sum(np.angle(np.divide(*((x - H) @ [1, 1j] for x in side[::-1])))
               for side in _every_side(outlines))  # fmt: skip
    return abs(turn) > 3


def _strictly_convex(outlines, H):
    left = [np.linalg.det([Q - P, H - P]) for P, Q in _every_side(outlines)]
    return min(left) > 1e-12 or max(left) < -1e-12


def _open_upward(outlines, H):
    odd = False
    for c in outlines:
        for P, Q in zip(c[:-1], c[1:], strict=True):
            if (P[0] > H[0]) != (Q[0] > H[0]):
                odd ^= H[1] < P[1] + (H[0] - P[0]) * (Q[1] - P[1]) / (Q[0] - P[0])
    return bool(odd)


def _open_by_slices(outlines, H):
    """zip(corners, corners[1:]), and a corner at the height of H counts as above it."""
    odd = False
    for c in outlines:
        for P, Q in zip(c, c[1:], strict=False):
            if min(P[1], Q[1]) < H[1] <= max(P[1], Q[1]):
                odd ^= P[0] + (H[1] - P[1]) / (Q[1] - P[1]) * (Q[0] - P[0]) > H[0]
    return bool(odd)


def _open_leftward(outlines, H):
    odd = False
    for c in outlines:
        for P, Q in zip(c, c[1:], strict=False):
            if (P[1] >= H[1]) != (Q[1] >= H[1]):
                odd ^= P[0] + (H[1] - P[1]) / (Q[1] - P[1]) * (Q[0] - P[0]) < H[0]
    return bool(odd)


def _by_products(outlines, H):
    """A test that counts the crossings of the sides, except those at an end point of a side."""
    count = 0
    for P, Q in _every_side(outlines):
        if (P[1] - H[1]) * (Q[1] - H[1]) < 0:
            count += P[0] + (H[1] - P[1]) * (Q[0] - P[0]) / (Q[1] - P[1]) > H[0]
    return count % 2 == 1


def _box(outlines, H):
    corners = np.concatenate(outlines)
    return (corners.min(0) <= H).all() and (H <= corners.max(0)).all()


@pytest.mark.parametrize(
    "wrong, named",
    [
        (_winding, "any number of turns, not only an odd one"),
        (_strictly_convex, "no dent allowed"),
        (_open_upward, "the closing side left out"),
        (_open_by_slices, "the closing side left out"),
        (_open_leftward, "the closing side left out"),
        (_by_products, "a corner counted twice, or not at all"),
        (_areas, "no dent allowed"),
        (_both_ways, "always outside"),
        (_returns_early, "any crossing"),
        (_box, "the box around it"),
        (lambda outlines, H: _upward(outlines[-1], H), "only the last outline"),
    ],
)
def test_mistakes_in_point_in_polygon_tests_are_named(wrong, named):
    verdict = check("obstacle_avoidance.1", wrong)
    assert not verdict.holds and verdict.mistake == named


def _own(who):
    """The task of `who`, with its start, and a function that returns points along the bar."""
    task = variant("obstacle_avoidance", who)
    start = np.array([task[name] for name in ("gamma", "beta", "alpha")])
    first, last = np.array(task["bar"])
    return task, start, lambda count: first + np.linspace(0, 1, count)[:, None] * (last - first)


@pytest.mark.parametrize("who", ["Ada", "Jonas"])
def test_paths_known_from_the_lab_do_not_get_past_the_bar(who):
    task, start, points = _own(who)
    end = arm.least(task["target"], start)[0]
    paths = {
        "direct": [start, end],
        "back": [end, start],
        "degrees": np.array([start, end]) / deg,
        "round an end": way_round(arm, start, task["target"], task["bar"][0], task["distance"]),
        "round both ends": way_round(arm, start, task["target"], task["bar"], task["distance"]),
    }
    assert paths["round both ends"] is not None
    verdicts = {
        name: check("obstacle_avoidance.2", (path, points(8)), who=who)
        for name, path in paths.items()
        if path is not None
    }
    for name, verdict in verdicts.items():
        assert not verdict.holds and verdict.mistake, name
    assert "degrees" in verdicts["degrees"].mistake
    assert verdicts["back"].mistake == "another start"
    # the ends of the path keep the distance, but postures between them do not
    assert "between its ends" in verdicts["round both ends"].mistake


@pytest.mark.parametrize("who", ["Ada", "Jonas", "your name"])
def test_paths_around_closely_spaced_points_get_past_the_bar(who):
    """The statement in the hint about points at a distance h from each other is also true."""
    task, start, along_the_bar = _own(who)
    fine = along_the_bar(400)
    for count in (7, 8) if who != "Ada" else (8,):  # Ada's bar is the longest
        points = along_the_bar(count)
        asked = np.hypot(task["distance"], np.hypot(*(points[1] - points[0])) / 2)
        path = way_round(arm, start, task["target"], points, asked)
        assert clearance(arm, path, fine).min() >= task["distance"] - 1e-6
        assert check("obstacle_avoidance.2", (path, points), who=who).holds


@pytest.mark.parametrize("who", ["Ann Reader", "your name"])
def test_path_that_holds_needs_points_that_prove_it(who):
    """With 5 points and no margin, `way_round` finds a path that keeps the distance from the whole
    bar, but these points do not prove it.
    """
    task, start, points = _own(who)
    path = way_round(arm, start, task["target"], points(5), task["distance"])
    assert clearance(arm, path, points(400)).min() >= task["distance"]
    few = check("obstacle_avoidance.2", (path, points(5)), who=who)
    assert few.mistake == "not proven with these points"
    assert few.points == pytest.approx(6 / 7, 0.01)
    d, h = clearance(arm, path, points(5)).min(), np.hypot(*(points(5)[1] - points(5)[0]))
    proven = np.sqrt(d**2 - (h / 2) ** 2) * 1000
    assert f"proves only {proven:.0f} mm" in " ".join(few.says)


NAMES = ["your name", "Ann", "Bob", "Eva", "Max", "Lena", "Tom", "Ada", "Kim", "Zoe", "n13", "n23"]


@pytest.mark.parametrize("who", NAMES)
def test_only_a_path_that_is_asked_for_more_than_the_distance_gets_past_the_bar(who):
    """With as many points as allowed, `way_round` is asked for exactly the distance, and then for
    what half a gap adds to it, as in the stored solution.
    """
    task, start, points = _own(who)
    most = points(8)
    h = np.hypot(*(most[1] - most[0]))
    verdicts = [
        check("obstacle_avoidance.2", (path, most), who=who)
        for asked in (task["distance"], np.hypot(task["distance"], h / 2))
        if (path := way_round(arm, start, task["target"], most, asked)) is not None
    ]
    assert [verdict.holds for verdict in verdicts][-2:] == [False, True], verdicts
    assert verdicts[0].mistake == "not proven with these points"
    assert "closer together" not in " ".join(verdicts[0].says), "there are no more points to give"


@pytest.mark.parametrize("who", ["Ann", "Kim"])
def test_stored_solution_holds_for_every_name(who):
    made = {}
    code = solution("obstacle_avoidance.2").replace('"your name"', repr(who))
    exec(re.search(r"import numpy.*", code, re.S)[0].split("```")[0], made)
    assert made["who"] == who
    assert check("obstacle_avoidance.2", (made["my_path"], made["my_points"]), who=who).holds


def test_points_that_prove_the_distance_lie_along_the_whole_bar_in_any_order():
    task, start, points = _own("Jonas")
    path = way_round(arm, start, task["target"], points(8), 1.1 * task["distance"])
    asked = partial(check, "obstacle_avoidance.2", who="Jonas")
    verdict = asked((path, points(8)))
    d, h = clearance(arm, path, points(8)).min(), np.hypot(*(points(8)[1] - points(8)[0]))
    proven = np.sqrt(d**2 - (h / 2) ** 2) * 1000
    assert proven <= clearance(arm, path, points(400)).min() * 1000
    assert verdict.holds and f"points prove {proven:.1f} mm for the whole bar" in verdict.says[1]
    assert asked((path, points(8)[::-1])).holds
    assert asked((path, np.column_stack([points(8), np.zeros(8)]))).holds, "points with z = 0"
    for wrong, mistake in (
        (points(8)[1:], "an end of the bar left out"),
        (points(8) + 0.01, "points that are not on the bar"),
        (points(2), "not proven with these points"),
        (points(9), "another kind or shape"),
        (points(8)[0], "another kind or shape"),
        (..., "another kind or shape"),
    ):
        assert asked((path, wrong)).mistake == mistake


@pytest.mark.parametrize("answer", [None, (None, [[1, 1], [2, 1]]), (None, None), (None, ...)])
def test_search_that_found_nothing_is_not_called_an_empty_answer(answer):
    verdict = check("obstacle_avoidance.2", answer, who="Ada")
    if answer is None:  # the name of the answer was never given a value
        assert not verdict.answered
        return
    assert verdict.answered and not verdict.holds
    assert "found no path" in " ".join(verdict.says)


def test_task_is_not_answered_before_both_parts_are_written():
    assert not check("obstacle_avoidance.2", (..., ...), who="Ada").answered
    says = " ".join(check("obstacle_avoidance.2", (..., [[1, 1], [2, 1]]), who="Ada").says)
    assert "my_path is missing" in says
    path = [[1, 1, 1], [2, 1, 1], [2, 2, 2]]  # the answer in earlier versions of the lab
    says = " ".join(check("obstacle_avoidance.2", path, who="Ada").says)
    assert "my_points" in says


@pytest.mark.parametrize(
    "who", ["your name", "Ann", "Bob", "Eva", "Max", "Lena", "Tom", "Ada", "Kim", "Zoe"]
)
def test_one_of_the_folds_in_the_hint_holds_for_every_name(who):
    text = hint("obstacle_avoidance.2", 2)
    assert "45°, 75° or 105°" in text and "the least, the middle or the greatest alpha" in text
    task, start, points = _own(who)
    held = 0
    for beta, alpha in product((45, 75, 105), repeat=2):
        for end in arm.family(task["target"], np.linspace(*arm.alpha_range(task["target"]), 3)):
            fold = [beta * deg, alpha * deg]
            path = [start, [start[0], *fold], [end[0], *fold], end]
            held += check("obstacle_avoidance.2", (path, points(8)), who=who).holds
    assert held >= 1


def test_path_of_strings_is_refused_and_different_numbers_print_differently():
    task, start, points = _own("Ada")
    path = np.array([start, arm.least(task["target"], start)[0]])
    text = check("obstacle_avoidance.2", (path.astype(str), points(8)), who="Ada")
    assert text.mistake == "another kind or shape"
    path[0, 0] += 0.01 * deg
    says = " ".join(check("obstacle_avoidance.2", (path, points(8)), who="Ada").says)
    begins, stands = re.search(
        r"begins at \((.*?)\)°, but the arm stands at \((.*?)\)°", says
    ).groups()
    assert begins != stands


@cache
def _tasks(count, turn, gap):
    """Tuples (path, H, distance, whether the path keeps the distance). The distance differs by
    `gap` from the smallest distance between the path and H.
    """
    rng, made = np.random.default_rng(2), []
    while len(made) < count:
        first = rng.uniform(0.3, 2.8, 3)
        path = np.clip([first, first + rng.uniform(-turn, turn, 3) * deg], 0, np.pi)
        path = np.array([*path, np.clip(path[1] + rng.uniform(-turn, turn, 3) * deg, 0, np.pi)])
        points = arm.points(along(path, rng.random()))
        i = rng.integers(3)
        H = points[i] + rng.random() * (points[i + 1] - points[i]) + rng.normal(0, 0.2, 2)
        least = clearance(arm, path, H).min()
        if least > gap + 0.03:
            truth = len(made) % 2 == 0
            made.append((path, H, least - gap if truth else least + gap, truth))
    return made


@pytest.mark.parametrize(
    "turn, gap, mistake",
    [(80, 0.004, "rejects a correct program"), (170, 0.03, "rejects a correct program")],
)
def test_test_that_demands_more_than_promised_is_reported(turn, gap, mistake):
    def strict(safe):
        return all(bool(safe(path, H, d)) == truth for path, H, d, truth in _tasks(60, turn, gap))

    verdict = check("obstacle_avoidance.3", strict)
    assert verdict.mistake == mistake
    assert "so a correct program may give either answer" in " ".join(verdict.says)


def test_test_that_rejects_true_of_numpy_is_told_so():
    def identical(safe):
        return all(safe(path, H, d) is truth for path, H, d, truth in _tasks(60, 80, 0.025))

    verdict = check("obstacle_avoidance.3", identical)
    assert verdict.mistake == "rejects a correct program"
    assert "But it is NumPy's True, for which `is True` does not hold: write bool(safe" in " ".join(
        verdict.says
    )
    assert np.bool_(True) is not True

    def equal(safe):
        return all(safe(path, H, d) == truth for path, H, d, truth in _tasks(60, 80, 0.025))

    assert check("obstacle_avoidance.3", equal).mistake != verdict.mistake


def test_reply_on_turns_fits_the_first_shape_for_which_they_fail():
    """The first one has two outlines whose sides do not cross."""
    ours = book.lab("obstacle_avoidance")
    tried = ours.module("inside_outside")
    for outlines, H in tried["cases"](np.random.default_rng(1)):
        turns = round(tried["seen"](outlines, H).sum())
        if (turns != 0) != (turns % 2 == 1):
            break
    assert len(outlines) == 2 and abs(turns) == 2
    assert [abs(round(tried["seen"]([each], H).sum())) for each in outlines] == [1, 1]
    (says,) = [
        each.says
        for each in ours.exercises["1"].text.wrong()
        if each.name == "any number of turns, not only an odd one"
    ]
    assert "Two outlines, or one whose sides cross, can go round H twice" in " ".join(says.split())


def test_testing_only_the_first_and_last_postures_is_not_enough():
    rng, tasks = np.random.default_rng(4), []
    while len(tasks) < 80:  # the arm is nearest to H in its first or last posture
        path = rng.uniform(0.7, 2.2, (2, 3))
        points = arm.points(path[rng.integers(2)])
        i = rng.integers(3)
        H = points[i] + rng.random() * (points[i + 1] - points[i]) + rng.normal(0, 0.2, 2)
        least, ends = clearance(arm, path, H).min(), lever_distances(path, H).min()
        if least > 0.06 and ends - least < 1e-6:
            tasks += [(path, H, least - 0.025, True), (path, H, least + 0.025, False)]

    def ends_only(safe):
        return all(bool(safe(path, H, d)) == truth for path, H, d, truth in tasks)

    verdict = check("obstacle_avoidance.3", ends_only)
    assert verdict.mistake == "accepts: the postures only", verdict


def test_distances_in_the_checks_match_those_of_the_package():
    from robokin.jobs.obstacles import distances

    q = np.random.default_rng(1).uniform(0, np.pi, (50, 3))
    assert np.allclose(lever_distances(q, [1.2, 1.3]), distances(arm, q, (1.2, 1.3)), atol=1e-12)


def test_testing_only_one_easy_task_is_not_enough():
    verdict = check("obstacle_avoidance.3", lambda safe: safe([[1, 1, 1], [2, 2, 2]], [9, 9], 0.1))
    assert not verdict.holds and verdict.mistake.startswith("accepts: ")
