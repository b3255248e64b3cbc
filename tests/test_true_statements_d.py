"""Statements of labs 03 and 10 to 12 that new readers refuted, checked by a second calculation."""

import itertools
import re
from itertools import pairwise

import numpy as np
import pytest
from test_true_statements_b import (
    ARM,
    DISTANCE,
    K1,
    Q0,
    asked,
    cells,
    direct,
    grid_wave,
    least_distance,
    lever_distance,
)
from test_true_statements_b import run as run_cells
from test_true_statements_c import flat, mistakes, numbers, shown, view

from robokin import deg, loader_arm, mm, two_link
from robokin.course import book
from robokin.jobs.obstacles import plan, via_path, way_round
from robokin.jobs.steppers import Stepper, ramp, shortest_turn, station_postures, straight

LAB_10 = book.lab("obstacle_avoidance")
sampled_tasks = LAB_10.module("predictions")["sampled_tasks"]
LOADER, PER_DEGREE, LIMIT = loader_arm(450 * mm, 300 * mm), np.array([10, 40, 40]), 500


# --- Lab 03 ---------------------------------------------------------------------------------------


def test_correct_programs_compute_speeds_as_accurately_as_promised():
    """The motions are sums of two oscillations with speeds, accelerations and jerks below 10."""
    rng = np.random.default_rng(3)
    exercise = book.find("irb140_motion.3", "exercises")
    for count in [3, 3, 4, 5, 9, 40, 300]:
        for shortest in (0.001, 0.0099):
            t = rng.uniform(-9, 9) + rng.uniform(shortest, 0.01, count).cumsum()
            rate, phase = rng.uniform(0.1, 2, (2, 6)), rng.uniform(0, 2 * np.pi, (2, 6))
            swing = 4.9 / np.maximum(rate, rate**3)
            q = sum(swing[k] * np.sin(rate[k] * t[:, None] + phase[k]) for k in (0, 1))
            v = sum(swing[k] * rate[k] * np.cos(rate[k] * t[:, None] + phase[k]) for k in (0, 1))
            for name, text in exercise.rights:
                found = exercise.program(text)((q + np.pi) % (2 * np.pi) - np.pi, t)
                error = abs(found - v)
                assert (error < 0.1).all() and (error[1:-1] < 0.001).all(), name


# --- Lab 10 ---------------------------------------------------------------------------------------


def test_the_15_degree_grid_has_a_path_that_the_wavefront_search_does_not_find():
    _, options, right = asked("obstacle_avoidance.p8")
    assert options[right].text.startswith("Only that this wave found no path")
    assert options[1].reason.startswith("This wave found no path in steps of 15°")
    assert "no path found" in view("obstacle_avoidance.p8")
    H = np.array([0.5, 1.0])
    assert grid_wave(15, H) == (None, None)
    corners = "120 120 120, 180 120 120, 180 90 120, 180 90 90, 180 60 90, 150 60 90, 150 30 90, "
    corners += "90 30 90, 90 60 90, 90 60 180"  # all corners are on the grid
    way = np.array([each.split() for each in corners.split(", ")], dtype=float)
    assert (way % 15 == 0).all() and ((np.diff(way, axis=0) != 0).sum(axis=1) == 1).all()
    curve = ARM.family(K1, np.linspace(*ARM.alpha_range(K1), 200))
    last = curve[abs(curve - way[-1] * deg).sum(axis=1).argmin()]
    assert least_distance([Q0, *(way * deg), last], H) >= DISTANCE
    assert abs(last - way[-1] * deg).max() < 15 * deg, "wanted less than a step of the grid"
    words = flat("10", "check-3-look")
    assert "from the grid posture that is nearest to the curve to a posture on the curve" in words


def test_adding_samples_never_increases_the_least_distance_found():
    _, options, right = asked("obstacle_avoidance.p4")
    says = options[right].reason
    assert "If you add samples and keep the old ones, the least distance found never gets" in says
    path, H = direct(np.array([150, 120, 120]) * deg), np.array([1.7, 1.0])

    def found(count):
        s = np.linspace(0, 1, count)[:, None]
        return lever_distance(path[0] + s * (path[1] - path[0]), H).min()

    assert found(7) >= found(13) >= found(25) >= found(49)
    assert found(10) > found(9), "with new places, the distance found can be larger"


def test_five_of_the_six_plans_exist_and_fold_the_arm_as_stated():
    most, least = numbers(
        r"five plans.*one no.* falls from (\d+) to (\d+) ", shown("10", "deeper-figure")
    )
    (listed,) = re.findall(r"moving_figure\((\[.*\])\)", cells("10")["deeper-figure"])
    places = np.array(eval(listed))
    places = places[np.argsort(-np.hypot(*places.T))]
    folds = []
    for H in places:
        path = plan(ARM, Q0, K1, H, DISTANCE).path
        if len(path) > 1:
            s = np.linspace(0, 1, 2001)[:, None]
            q = np.concatenate([a + s * (b - a) for a, b in pairwise(path)])
            folds.append((q[:, 1] + q[:, 2]).min() / deg)
    assert len(folds) == 5 and (np.diff(folds) < 0).all()
    assert [round(folds[0]), round(folds[-1])] == [most, least]


def test_gripper_distance_and_success_of_larger_circles_are_as_stated():
    (near,) = numbers(r"as near to the obstacle as (\d+) mm, inside", view("obstacle_avoidance.p5"))
    path = via_path(ARM, Q0, K1, np.array([1.0, 1.5]))
    s = np.linspace(0, 1, 20001)[:, None]
    ways = np.concatenate([ARM.points(a + s * (b - a))[:, 3] for a, b in pairwise(path)])
    assert round(np.hypot(*(ways - [1.0, 1.5]).T).min() / mm) == near < DISTANCE / mm
    swept, mended, lost = 0, 0, 0
    for start, target, H in sampled_tasks():
        small, large = (
            least_distance(via_path(ARM, start, target, H, r), H, 301) for r in (DISTANCE, 0.25)
        )
        swept += small < 1e-6
        mended += small >= 1e-6 and large >= DISTANCE
        lost += small < 1e-6 and large >= DISTANCE
    text = flat("10", "often-look")
    assert numbers(
        r"paths of (\d+) tasks keep the .* the (\d+) tasks in .* none of them are among the (\d+) "
        r"in",
        text,
    ) == [
        mended,
        100 - swept,
        swept,
    ]
    _, options, _ = asked("obstacle_avoidance.p7")
    assert lost == 0
    assert f"none of these belong to the {swept:.0f} tasks in" in options[1].reason
    assert options[1].reason.startswith(f"{mended} of 100")
    assert f"Of the {swept} tasks" in options[2].second
    shown_view = view("obstacle_avoidance.p7")
    assert (
        f"in {swept} tasks" in shown_view
        and f"in {100 - swept} no lever does. All {mended} are among these {100 - swept}"
        in shown_view
    )


def test_the_middle_of_a_five_pointed_star_is_outside():
    ((_, says),) = mistakes("obstacle_avoidance", "any number of turns, not only an odd one")
    assert "the middle of a five-pointed star drawn in a single stroke is outside" in says
    middle = np.array([0.01, 0.02])
    for points, step, inside in ((5, 2, False), (8, 3, True)):
        corners = np.array(LAB_10.module("inside_outside")["star_of"](points, step))
        assert LAB_10.exercises["1"].right([corners], middle) == inside
        seen = np.unwrap(np.arctan2(*(np.vstack([corners, corners[:1]]) - middle).T[::-1]))
        assert round(abs(seen[-1] - seen[0]) / (2 * np.pi)) % 2 == inside


def test_two_distances_locate_two_points_or_one_in_line_with_the_sensors():
    text = flat("10", "deeper-locate")
    assert "at two points, or at one if the obstacle is in line with both sensors" in text
    assert "A third sensor that is not in line with these two tells you which" in text
    made = run_cells("10", "setup", "cube-setup", "deeper-locate-code")
    for truth in ([1.5, 0], [2.5, 0], [1.5, 1.0]):
        far = np.hypot(*(np.array(truth) - made["sensors"]).T)
        spots = made["locate"](*made["sensors"][:2], *far[:2])
        assert np.allclose(spots[0], spots[1], atol=1e-6) == (truth[1] == 0)
        in_line = np.hypot(*(spots - [1.0, 0]).T)
        assert in_line[0] == pytest.approx(in_line[1])


def test_paths_keep_their_clearance_and_sampled_obstacles_are_on_lever_ak():
    words = flat("10", "check-3-look")
    assert "takes steps of at most 5° between allowed postures" in words
    assert "proves every part" in words and "an obstacle on AK" in flat("10", "often-code")
    for start, target, H in sampled_tasks()[:20]:
        a, b = direct(start, target)
        on_AK = lever_distance(a + np.linspace(0, 1, 4001)[:, None] * (b - a), H, slice(2, 3))
        assert on_AK.min() < 1e-3
        path = way_round(ARM, start, target, H, DISTANCE)
        assert path is None or least_distance(path, H, 301) >= DISTANCE


# --- Lab 11 ---------------------------------------------------------------------------------------


def test_more_pulses_do_not_always_take_more_time(capsys):
    assert "more time if its motor then has the most pulses" in flat("11", "pulses-look")
    q = station_postures(LOADER, np.array([[600, -350, 50], [50, 250, 350]]) * mm) / deg
    seconds = {}
    for gears in ((18, 72, 72), (36, 72, 72), (18, 144, 72), (18, 72, 144)):
        n = np.rint(q * np.array(gears) / 1.8)
        seconds[gears] = abs(np.diff(n, axis=0)).max() / LIMIT
    first, *others = seconds.values()
    assert others[0] == first < others[2] < others[1]


def test_straight_line_takes_longer_if_the_motor_at_the_limit_changes():
    words = flat("11", "deeper-straight-look")
    assert (
        "longer than path d to the same goal if different motors are at the limit on different "
        "parts of the way. If the same motor is at the limit all the way, both take the same time"
        in words
    )
    rng, kinds = np.random.default_rng(5), set()
    for _ in range(60):
        ends = rng.uniform([-600, -600, 50], [600, 600, 300], (2, 3)) * mm
        ends[1] = ends[0] + 0.3 * (ends[1] - ends[0])
        try:
            move = straight(LOADER, *ends, PER_DEGREE)
        except ValueError:
            continue
        points = ends[0] + np.linspace(0, 1, 4001)[:, None] * (ends[1] - ends[0])
        if not np.isfinite(station_postures(LOADER, points)).all():
            continue
        n = np.unwrap(station_postures(LOADER, points), axis=0) / deg * PER_DEGREE
        steps = np.diff(n, axis=0)
        if ((steps > 0).any(axis=0) & (steps < 0).any(axis=0)).any() or abs(
            n[-1] - n[0]
        ).max() < 200:
            continue  # skip lines where a motor reverses or rounding matters
        changes = len({*abs(steps).argmax(axis=1).tolist()}) > 1
        d = abs(n[-1] - n[0]).max() / LIMIT
        share = move.duration / d
        kinds.add(changes)
        assert share > 1 - 0.005 and (changes or share < 1 + 0.01)
        own = abs(steps).max(axis=1).sum() / LIMIT
        assert own > d * (1 + 1e-9) if changes else own == pytest.approx(d)
    assert kinds == {True, False}


def test_last_move_of_the_program_turns_alpha_by_the_stated_angle():
    onwards, back = numbers(
        r"increases by (\S+)° instead of decreasing by (\S+)°\.",
        flat("11", "deeper-program-look"),
    )
    turn = 2 * np.degrees(np.arctan2(20, 500))
    assert [onwards, back] == pytest.approx([turn, 360 - turn], abs=0.05)
    points = np.array([[420, -180, 420], [-500, 20, 200], [-500, -20, 200]])
    assert re.search(
        r"job = .*\[420, -180, 420\].*\[-500, 20, 200\], \[-500, -20, 200\]\]",
        (flat("11", "deeper-program")),
    )
    before, last = np.diff(station_postures(LOADER, points * mm)[:, 0]) / deg
    assert before < 0 < last == pytest.approx(onwards, abs=0.05), "alpha turns back"


def test_rule_that_considers_only_the_size_of_a_turn_fails_in_the_stated_range():
    text = flat("11", "turn-look")
    low, high = numbers(
        r"for \$-(\d+)° < \\delta < -(\d+)°\$ the rule \*by size\* gives the right turn with the "
        r"wrong sign",
        text,
    )
    for d in np.arange(-899.5, 0):
        right = shortest_turn(0, d * deg) / deg
        rule = d if abs(d) <= 180 else -(360 - abs(d))
        assert (abs(rule + right) < 1e-9) == (-low < d < -high), d


def test_three_windings_act_like_one_and_arctan_jumps():
    ((_, says),) = mistakes("motor_synchronisation", "an extra winding now and then")
    assert "so the direction and the strength are right, but three windings draw current" in says
    field = np.array([1, 1j, -1, -1j])
    assert np.array([1, 1, 0, 1]) @ field == np.array([1, 0, 0, 0]) @ field == 1
    _, options, right = asked("motor_synchronisation.p1")
    x = np.linspace(200, -200, 4001)
    with np.errstate(divide="ignore"):
        angle = np.arctan(20 / x) / deg
    steps = np.diff(angle)
    assert options[1].reason.startswith(
        "arctan(y / x) jumps there, but it also varies on either side of the jump."
    )
    assert (abs(steps) > 100).sum() in (1, 2) and (abs(steps[:1900]) > 0).all()
    whole, middle = numbers(
        r"by (\d+) degrees, (\d+) of them in the second in the middle",
        view("motor_synchronisation.p1"),
    )
    turned = [2 * np.degrees(np.arctan2(half, 20)) for half in (200, 50)]
    assert [round(each) for each in turned] == [whole, middle] and middle > whole / 2
    assert "mostly in the middle" in options[right].text


def test_lost_steps_with_and_without_a_ramp_are_as_stated():
    words = view("motor_synchronisation.p10")
    least, top, first, few, most, second = numbers(
        r"Without a ramp (\d+) to (\d+) are lost from (\d+) .* ramp (\d+) to (\d+) from (\d+) on",
        words,
    )
    motor, ones = Stepper(torque=0.02, inertia=1e-6, damping=6e-5, rise=0), np.ones(48)
    for start, (low, high, at) in ((None, (least, top, first)), (40, (few, most, second))):
        lost = {
            f: motor.run(ramp(48, start or f, f, 0.1 if start else 0), ones).lost
            for f in range(60, 281, 10)
        }
        assert min(f for f, n in lost.items() if n) == at and not any(n % 4 for n in lost.values())
        behind = [n for f, n in lost.items() if f >= at]
        assert [min(behind), max(behind)] == [low, high]
    text = flat("13", "title")
    f, lost = numbers(r"At (\d+) pulses per second this motor loses (\d+) of 48 steps", text)
    assert "With a ramp of a tenth of a second it loses none." in text
    assert motor.run(ramp(48, f, f, 0), ones).lost == lost > 0
    assert motor.run(ramp(48, 40, f, 0.1), ones).lost == 0
    assert "*maximum start frequency*; [lab 13](13_rotor.ipynb) measures it" in flat("11", "pulses")
    assert re.search(r"maximum start frequency: \d+ pulses/s", shown("13", "missed-code"))


# --- Lab 12 ---------------------------------------------------------------------------------------


def test_jumps_in_the_first_views_are_as_stated():
    """The two elbows are mirror images in the line, so the jump is twice their distance from it."""
    height, low, jump = numbers(
        r"At (\S+) m, and also at (\S+) m: the view shows a jump of (\S+) m\.", flat("12", "able")
    )
    heights = np.round(np.arange(-2.1, 2.105, 0.01), 2)
    jumps = 2 * np.sqrt(np.maximum(1 - heights**2 / 4, 0))
    near = heights[np.argsort(abs(jumps - 1), kind="stable")[:2]]
    assert sorted(near) == [low, height] == [-height, height]
    assert round(2 * np.sqrt(1 - height**2 / 4), 3) == jump
    told = flat("12", "elimination-text")
    low, high, far = numbers(r"reach between (\S+) m and (\S+) m and beyond ±(\S+) m,", told)
    assert "link_2 = 0.7 " in cells("12")["elimination-view"] and far == pytest.approx(1 + 0.7)
    assert [low, high] == pytest.approx([-0.3, 0.3]) and high == pytest.approx(1 - 0.7)
    assert "It jumps where $|y_3|$ is between $|l_1 - l_2|$ and $l_1 + l_2$." in told
    for l2, y in itertools.product((0.5, 0.7, 1.0, 1.2), np.arange(0.05, 2.3, 0.1)):
        half = (y * y + 1 - l2**2) / 2  # on the line x3 = 0, the elbows are at x2 = ± the root
        assert (1 - (half / y) ** 2 > 0) == (abs(1 - l2) < y < 1 + l2)
    rng = np.random.default_rng(5)
    for x, y in rng.uniform(-1.6, 1.6, (400, 2)):
        d2 = x * x + y * y
        if not 0.31**2 < d2 < 1.69**2:
            continue
        half = (d2 + 1 - 0.49) / 2
        y2 = (y * half + np.sqrt(x * x * (d2 - half * half))) / d2
        x2 = (half - y * y2) / x
        other = (y * half - np.sqrt(x * x * (d2 - half * half))) / d2
        assert y2 > other, "the formula returns the lower elbow"
        assert (x * y2 - y * x2 > 0) == (x > 0), "the upper elbow is on the wrong side"


def test_elbows_are_swapped_on_the_stated_side():
    exercise = book.lab("two_link_code_generation").exercises["1"]
    name = r"divides by dx, and takes the side from the (other )?sign of the root"
    said = [each for each in exercise.own if re.fullmatch(name, each.name)]
    sides = []
    for each in said:
        program = exercise.steps.program(each)
        for x in (1.0, -1.0):
            elbow = program(np.zeros(2), np.array([x, 0.5]), 1, 0.8, 1)
            if x * elbow[1] - 0.5 * elbow[0] > 0:  # the elbow is to the left of the line to the tip
                sides.append("right" if x > 0 else "left")
    assert sides == ["right"] * 4 + ["left"] * 4
    assert [
        re.search(r"the other elbow for a tip to its (\w+)", says)[1] for _, says, _ in said
    ] == sides


def test_elbow_distances_link_ratio_and_lost_digits_are_as_stated():
    question, options, _ = asked("two_link_code_generation.p2")
    l1, d = numbers(r"Link 1 is (\S+) m long, .* tip is (\S+) m from", question)
    l2, from_tip, from_base = numbers(
        r"link 2 were (\S+) m long, both elbows would be (\S+) m from the tip and (\S+) m",
        options[0].second,
    )
    x = (l1**2 - l2**2 + d**2) / (2 * d)
    elbow = np.array([x, np.sqrt(l1**2 - x**2)])
    assert np.hypot(*elbow) == pytest.approx(from_base) and np.hypot(
        *(elbow - [d, 0])
    ) == pytest.approx(from_tip)
    name = "the ratio of the links for a"
    own = book.lab("two_link_code_generation").exercises["1"].own
    (says,) = [each.says for each in own if each.name == name]
    assert "With unequal links" in says and "only if the arm is stretched" in says
    for first, second in ((1.0, 1.0), (0.7, 1.0), (1.0, 0.4)):
        for d in np.linspace(abs(first - second) + 0.05, first + second, 9):
            same = (
                abs((first**2 - second**2 + d**2) / (2 * d**2) - first / (first + second)) < 1e-12
            )
            assert same == (first == second or d == pytest.approx(first + second))
    _, options, _ = asked("two_link_code_generation.p4")
    assert options[3].reason == "Rounding has already turned the numerator into 0."
    y3, x3 = 1.0, np.array([1e-3, 1e-6, 1e-9, 1e-12])
    d2 = x3**2 + y3**2
    y2 = (y3 * d2 + np.sqrt(x3**2 * d2 * (4 - d2))) / (2 * d2)
    exact = -x3 * np.sqrt(3)  # the numerator, to first order
    lost = abs((d2 - 2 * y3 * y2) / exact - 1)
    assert lost[1] < 1e-5 < lost[3], "the numerator should lose digits in floating-point arithmetic"
    below = 1e-20
    y2 = (y3 + np.sqrt(below**2 * (4 - 1))) / 2
    assert below > 0 == y3**2 - 2 * y3 * y2, "the numerator is 0 and the denominator is not"


def test_jump_of_both_angles_at_the_smallest_radius_is_as_stated():
    pytest.importorskip("sympy")
    made = run_cells("12", "derive-line", "derive-check", "sides-setup", "sides-player")
    q = np.degrees(made["angles"](made["by_line"], made["tip_arcs"])[made["radii"] == 0.5][0])
    jumps = np.flatnonzero(abs(np.diff(q[:, 1])) > 90)
    assert len(jumps) == 2
    told = flat("12", "sides-drag")
    low, high, line, turn = numbers(
        r"\$q_2\$ jumps between (\S+)° and (\S+)°, by (\S+)° or, the short way round, by (\S+)°",
        told,
    )
    (first,) = numbers(r", and \$q_1\$ by (\S+)°\.", told)
    pairs = [tuple(np.round(q[k : k + 2, 1], 1)) for k in jumps]
    assert pairs == [(high, low), (low, high)], "it jumps once in each direction"
    least, small, most, great = numbers(
        r"jumps least at (\S+) m, by (\S+) m, and most at (\S+) m, by (\S+) m\. There,", told
    )
    lengths = 2 * np.sqrt(1 - made["radii"] ** 2 / 4)
    assert [made["radii"][lengths.argmin()], made["radii"][lengths.argmax()]] == [least, most]
    assert [round(lengths.min(), 2), round(lengths.max(), 2)] == [small, great] and most == 0.5
    for k in jumps:
        change = np.diff(q[k : k + 2], axis=0)[0]
        assert abs(change[1]) == pytest.approx(line, abs=0.06)
        assert sorted(q[k : k + 2, 1]) == pytest.approx([low, high], abs=0.06)
        assert 360 - abs(change[1]) == pytest.approx(turn, abs=0.06)
        around = (change[0] + 180) % 360 - 180
        assert abs(around) == pytest.approx(first, abs=0.2)  # the tip moves between two samples
    # row 0 of two_link is the right elbow, row 1 the left one
    tip = np.array([0.6, 0.8])
    rows = made["arm"].ik(tip)
    elbows = made["arm"].frames(rows)[..., 1].translation[:, :2]
    sides = tip[0] * elbows[:, 1] - tip[1] * elbows[:, 0]
    assert sides[0] < 0 < sides[1] and "row 0: right elbow" in cells("12")["sides-player"]


def test_quadratic_formula_in_terms_of_a_and_h_holds_for_any_lengths():
    told = cells("12")["elimination-look"]
    assert r"y_2 = a\,y_3 + |x_3|\,h, \qquad x_2 = a\,x_3 - \frac{|x_3|}{x_3}\,h\,y_3." in told
    assert r"With $a = \frac12$ and $h \ge 0$ from section 2" in told
    made = run_cells("12", "sides-setup")
    setup = {"np": np}
    exec(cells("12")["casts-player"].partition("\n\n\n")[0], setup)
    for one, two in ((1.0, 1.0), (1.0, 0.7), (0.4, 0.9)):
        for angle in np.arange(0.1, 6.2, 0.3):
            d = 0.5 * (abs(one - two) + one + two)
            x3, y3 = d * np.cos(angle), d * np.sin(angle)
            a = (d**2 + one**2 - two**2) / (2 * d**2)
            h = np.sqrt(one**2 / d**2 - a**2)
            elbow = np.array([a * x3 - abs(x3) / x3 * h * y3, a * y3 + abs(x3) * h])
            assert np.hypot(*elbow) == pytest.approx(one)
            assert np.hypot(*(elbow - [x3, y3])) == pytest.approx(two)
            assert (elbow[1] - a * y3 > 0) and (x3 * elbow[1] - y3 * elbow[0] > 0) == (x3 > 0)
            if one == two:
                assert a == 0.5 and made["elbow_by_root"](x3, y3, one) == pytest.approx(elbow)
                assert setup["listing"](x3, y3, one, float) == pytest.approx(elbow[0])


def test_single_precision_is_as_accurate_as_stated_and_worse_nearer_to_the_rim():
    *rows, inside, rim = shown("12", "carry-code").strip().split("\n")
    small, large = (numbers(r"off by up to (\S+) µm", each)[0] for each in (inside, rim))
    assert "50 mm inside the reach" in inside and "1 mm inside the rim" in rim
    assert 0 < small < large < 10, "a robot repeats a position to some micrometres"
    assert "nearer to the rim the error grows" in flat("12", "carry-look")
    base, around = np.array([0.2, -0.1]), 2 * np.pi * np.arange(1000) / 1000
    greatest = []
    for gap in (1e-3, 1e-4, 1e-5, 1e-6):
        found = {}
        for real in (np.float32, np.float64):
            tips = base[:, None] + (1.7 - gap) * np.stack([np.cos(around), np.sin(around)])
            dx, dy = tips.astype(real) - base.astype(real)[:, None]
            d2 = dx**2 + dy**2
            a = (d2 + real(1) ** 2 - real(0.7) ** 2) / (2 * d2)
            h = np.sqrt(np.maximum(real(1) / d2 - a**2, 0))
            found[real] = np.array([a * dx + h * dy, a * dy - h * dx], dtype=float)
        greatest.append(np.hypot(*(found[np.float32] - found[np.float64])).max())
    assert greatest == sorted(greatest) and greatest[-1] > 50e-6


def test_task_on_the_scara_has_the_stated_answer():
    told = flat("12", "carry-look")
    l1, l2 = numbers(r"\$l_1 = (\S+)\$ m and \$l_2 = (\S+)\$ m", told)
    x, y, to_x, to_y = numbers(r"from \((\S+), (\S+)\) m to \((\S+), (\S+)\) m", told)
    (jump,) = numbers(r"By (\S+) m: at \$x_3 = 0\$, \$d\$ is 0\.4 m", told)
    assert (to_x, to_y) == (-x, y) and y == 0.4
    first, second = two_link(l1, l2).frames(two_link(l1, l2).ik((0, y)))[..., 1].translation
    assert np.hypot(*(first - second)[:2]) == pytest.approx(jump, abs=5e-4)
    ends = two_link(l1, l2).ik(np.stack([np.linspace(-x, x, 99), np.full(99, y)], axis=-1))
    assert np.isfinite(ends).all(), "the whole line should be in reach"
    steps = dict(re.findall(r"^(t\d+) = (.*)$", shown("12", "count-code"), re.M))
    assert steps["t8"] == "sqrt(t1/t5 - t7**2/t6**2)"
    assert "t8 := SQRT(t1 / t5 - t7 * t7 / (t6 * t6));" in told
