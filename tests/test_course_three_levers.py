"""The exercises of lab 09: correct answers in different styles pass, mistakes are named, and the
exercises can be solved with each student's own numbers.
"""

import cmath
import math
import re

import numpy as np
import pytest

from robokin import deg, three_lever
from robokin.course import answers, book, check, variant

ARM = three_lever(1.0)
PLAN = book.lab("three_levers").module("two_tasks")


def law(a, b, c):
    with np.errstate(invalid="ignore"):
        return np.arccos((a**2 + b**2 - c**2) / (2 * a * b))


def levers(K, alpha, lengths):
    a, b, c = lengths
    KO, KB = np.hypot(*K), np.sqrt(b**2 + c**2 - 2 * b * c * np.cos(alpha))
    gamma = law(KO, a, KB) + np.arctan2(K[1], K[0])
    return np.array([gamma, law(KB, a, KO) + law(KB, b, c), alpha])


def by_complex_numbers(K, alpha, lengths):
    """A program with complex numbers: OB is counter-clockwise from OK, and the rest follows."""
    a, b, c = (float(x) for x in lengths)
    k, KB = complex(*K), abs(b - c * cmath.exp(1j * alpha))
    if abs(k) > a + KB or abs(k) < abs(a - KB):
        return float("nan")
    gamma = cmath.phase(k) + math.acos((abs(k) ** 2 + a * a - KB * KB) / (2 * abs(k) * a))
    B = a * cmath.exp(1j * gamma)
    beta_1 = cmath.phase((k - B) / -B) % (2 * math.pi)
    return [gamma, beta_1 + abs(cmath.phase(b - c * cmath.exp(1j * alpha))), alpha]


def wrapped_into_half_turns(K, alpha, lengths):
    return (levers(K, alpha, lengths) + np.pi) % (2 * np.pi) - np.pi


@pytest.mark.parametrize("answer", [levers, by_complex_numbers, wrapped_into_half_turns])
def test_correct_levers_pass_in_different_styles(answer):
    assert check("three_levers.1", answer).holds


def limited(K, alpha, lengths):
    q = levers(K, alpha, lengths)
    return q if ((q >= 0) & (q <= np.pi)).all() else np.full(3, np.nan)


def equal_levers(K, alpha, lengths):
    KO, KB = np.hypot(*K), 2 * lengths[0] * np.sin(alpha / 2)
    gamma = law(KO, lengths[0], KB) + np.arctan2(K[1], K[0])
    return np.array([gamma, law(KB, lengths[0], KO) + (np.pi - alpha) / 2, alpha])


def no_direction(K, alpha, lengths):
    return levers(K, alpha, lengths) - [np.arctan2(K[1], K[0]), 0, 0]


def quotient(K, alpha, lengths):
    with np.errstate(divide="ignore"):
        turn = np.arctan(np.divide(K[1], K[0])) - np.arctan2(K[1], K[0])
    return levers(K, alpha, lengths) + [turn, 0, 0]


def angle_between(a, b, c):
    return np.arccos(np.clip((a**2 + b**2 - c**2) / (2 * a * b), -1, 1))


def of_the_lab(K, alpha, lengths):
    """A program with the lab's formulas, including np.clip, and with OB instead of L."""
    L, KO = lengths[0], np.hypot(*K)
    KB = 2 * L * np.sin(alpha / 2)
    gamma = angle_between(KO, L, KB) + np.arctan2(K[1], K[0])
    return np.array([gamma, angle_between(KB, L, KO) + (np.pi - alpha) / 2, alpha])


def first_of_the_lab(K, alpha, lengths):
    return levers(K, alpha, [1.0, *lengths[1:]])


def whole_arm(K, alpha, lengths):
    """A program that returns NaN only where no alpha reaches the point."""
    a, b, c = lengths
    KO, KB = np.hypot(*K), np.sqrt(b**2 + c**2 - 2 * b * c * np.cos(alpha))
    if not max(0, 2 * max(lengths) - sum(lengths)) <= KO <= sum(lengths):
        return np.nan
    gamma = angle_between(KO, a, KB) + np.arctan2(K[1], K[0])
    return np.array([gamma, angle_between(KB, a, KO) + angle_between(KB, b, c), alpha])


def folded(K, alpha, lengths):
    gamma, beta, _ = levers(K, alpha, lengths)
    return np.array([gamma, min(beta, 2 * np.pi - beta), alpha])


def added(K, alpha, lengths):
    """A program with a wrong plus sign in the law of cosines, which computes beta_2 from the
    resulting KB.
    """
    a, b, c = lengths
    KO, KB = np.hypot(*K), np.sqrt(b**2 + c**2 + 2 * b * c * np.cos(alpha))
    gamma = law(KO, a, KB) + np.arctan2(K[1], K[0])
    return np.array([gamma, law(KB, a, KO) + law(KB, b, c), alpha])


def one_length(k, reach=None):
    """The lab's formulas with the length of lever k for L, and the reach of such an arm."""

    def answer(K, alpha, lengths):
        L = lengths[k]
        if reach and not L < np.hypot(*K) <= 3 * L:
            return np.nan
        return of_the_lab(K, alpha, [L, L, L])

    return answer


def within_the_reach(lowest, highest):
    """A correct formula that clips, and returns NaN outside the reach of the arm, as in the lab."""

    def answer(K, alpha, lengths):
        a, b, c = lengths
        KO, KB = np.hypot(*K), np.sqrt(b**2 + c**2 - 2 * b * c * np.cos(alpha))
        if KO <= lowest(lengths) or KO > highest(lengths):
            return np.nan
        gamma = angle_between(KO, a, KB) + np.arctan2(K[1], K[0])
        return np.array([gamma, angle_between(KB, a, KO) + angle_between(KB, b, c), alpha])

    return answer


def two_angles(test):
    """A program with two wrong angles: beta_2 of equal levers, and arctan of y / x."""

    def answer(K, alpha, lengths):
        a, b, c = lengths
        KO, KB = np.hypot(*K), np.sqrt(b**2 + c**2 - 2 * b * c * np.cos(alpha))
        if test and not (abs(a - KB) if test == "both" else 0) <= KO <= a + KB:
            return np.nan
        with np.errstate(divide="ignore"):
            gamma = angle_between(KO, a, KB) + np.arctan(np.divide(K[1], K[0]))
        return np.array([gamma, angle_between(KB, a, KO) + (np.pi - alpha) / 2, alpha])

    return answer


CLIPPED, REACH = "clipped if there is no triangle", "the reach of the lab's arm"
TWO = "beta_2 of equal levers, and arctan of y / x"


@pytest.mark.parametrize(
    ("answer", "mistake"),
    [
        (one_length(1), f"one length for all levers, and {CLIPPED}"),
        (one_length(2), f"one length for all levers, and {CLIPPED}"),
        (one_length(0, "lab"), f"the formulas of equal levers, with OB, and {REACH}"),
        (within_the_reach(lambda lengths: lengths[0], sum), REACH),
        (within_the_reach(lambda lengths: 1, sum), REACH),
        (within_the_reach(lambda lengths: 1, lambda lengths: 3), REACH),
        (two_angles("both"), TWO),
        (two_angles("far"), f"{TWO}, and an incomplete test for NaN"),
        (two_angles(None), f"{TWO}, and an incomplete test for NaN"),
        (
            of_the_lab,
            "the formulas of equal levers, with OB, and clipped if there is no triangle",
        ),
        (first_of_the_lab, "the lab's L used as OB"),
        (whole_arm, "the reach of the whole arm"),
        (folded, "beta folded below 180°"),
        (added, "the wrong sign in the law of cosines"),
        (limited, "the limits are checked"),
        (equal_levers, "the formulas of equal levers, with OB"),
        (no_direction, "the direction of K left out"),
        (quotient, "arctan of y / x"),
        (lambda *case: levers(*case) / deg, "degrees for radians"),
        (lambda *case: levers(*case)[::-1], "the angles in another order"),
        (lambda *case: np.nan_to_num(levers(*case)), "zeros instead of NaN, with alpha kept"),
    ],
)
def test_mistakes_in_levers_are_named(answer, mistake):
    verdict = check("three_levers.1", answer)
    assert not verdict.holds and verdict.mistake == mistake


def tasks(count):
    rng = np.random.default_rng(11)
    r, phi = rng.uniform(1.1, 2.9, count), rng.uniform(20, 145, count) * deg
    places = np.stack([r * np.cos(phi), r * np.sin(phi)], axis=-1)
    before = rng.uniform(20, 170, (count, 3)) * deg
    S = ARM.least(places, before)[1]
    there = np.isfinite(S)
    return zip(places[there], before[there], S[there], strict=True)


def asserting(program):
    for K, previous, S in tasks(100):
        q = np.array(program(K, previous))
        np.testing.assert_allclose(ARM.points(q)[3], K, atol=1e-5)
        assert q.min() > -1e-6 and q.max() < np.pi + 1e-6
        assert abs(q - previous).sum() < S + 0.02 * deg


def without_the_gripper(program):
    return all(
        abs(np.array(program(K, previous)) - previous).sum() <= S + 0.02 * deg
        for K, previous, S in tasks(40)
    )


def the_same_angles(program):
    return all(
        np.allclose(program(K, previous), ARM.least(K, previous)[0], rtol=0, atol=1e-6)
        for K, previous, _ in tasks(40)
    )


def one_task(program):
    K, previous = np.array([1.8, 0.6]), np.array([100, 110, 120]) * deg
    q = np.array(program(K, previous))
    return abs(q - ARM.least(K, previous)[0]).max() < 0.1 * deg


def test_tests_for_least_movement_get_the_expected_verdicts():
    assert check("three_levers.2", asserting).holds
    stays = check("three_levers.2", without_the_gripper)
    assert not stays.holds and stays.mistake == "accepts: it stays where it is"
    assert check("three_levers.2", the_same_angles).mistake == "rejects a correct program"
    assert not check("three_levers.2", one_task).holds


def least_test(at=1e-5, limit=1e-6, plus=0.02 * deg, relative=0.0):
    def test(program):
        for K, previous, S in tasks(140):
            q = np.array(program(K, previous))
            there = np.allclose(ARM.points(q)[3], K, rtol=relative, atol=at)
            legal = (q >= -limit).all() and (q <= np.pi + limit).all()
            if not (there and legal and abs(q - previous).sum() <= S + plus):
                return False
        return True

    return test


@pytest.mark.parametrize(
    ("test", "mistake"),
    [
        (least_test(), None),
        (least_test(relative=1e-5), None),
        (least_test(at=1e-9, relative=1e-5), "rejects a correct program"),
        (least_test(at=1e-3), "accepts: rounded to hundredths of a degree"),
        (least_test(limit=0), "rejects a correct program"),
        (least_test(plus=0.01 * deg), "rejects a correct program"),
        (least_test(plus=0.05 * deg), "accepts: S up to 0.028° above the minimum"),
        (least_test(plus=0.15 * deg), "accepts: a step of 0.1°"),
    ],
)
def test_tolerances_of_tests_must_agree_with_the_promised_accuracy(test, mistake):
    verdict = check("three_levers.2", test)
    assert verdict.holds == (mistake is None) and verdict.mistake == mistake


def drawn_anywhere(accepts):
    """A test with targets in all directions from 0° to 180°, which `accepts` (q, K, previous, S)
    judges.
    """

    def is_least(program):
        rng = np.random.default_rng(0)
        for _ in range(100):
            r, phi = rng.uniform(1.1, 2.9), rng.uniform(0, np.pi)
            K, previous = np.array([r * np.cos(phi), r * np.sin(phi)]), rng.uniform(0, np.pi, 3)
            q = np.asarray(program(K, previous))
            if not accepts(q, K, previous, ARM.least(K, previous)[1]):
                return False
        return True

    return is_least


def solved(q, K, previous, S):
    return np.hypot(*(ARM.points(q)[3] - K)) < 1e-5 and abs(q - previous).sum() <= S + 0.02 * deg


def test_test_is_told_that_a_target_is_out_of_reach():
    verdict = check("three_levers.2", drawn_anywhere(solved))
    assert verdict.mistake == "rejects every program"
    told = verdict.says[-1]
    x, y = map(float, re.search(r"with K = \[(\S+), (\S+)\] m, which `arm.least`", told).groups())
    assert np.isnan(ARM.least((x, y), np.ones(3))[1]) and told.endswith("Leave such tasks out.")
    # the programs raise no error for such targets, so that a test may also skip them afterwards

    def skips(q, K, previous, S):
        legal = (q > -1e-6).all() and (q < np.pi + 1e-6).all()
        return np.isnan(S) or (q.shape == (3,) and legal and solved(q, K, previous, S))

    assert check("three_levers.2", drawn_anywhere(skips)).holds


def test_test_without_a_tolerance_is_told_of_the_rounding_error():
    verdict = check("three_levers.2", least_test(limit=0))
    assert verdict.mistake == "rejects a correct program"
    assert "between 0° and 180° to within 1e-6 rad" in verdict.says[0]
    past = r"It returned a (gamma|beta|alpha) that is (\S+) rad (above 180|below 0)°"
    assert 0 < float(re.search(past, verdict.says[2])[2]) < 1e-6
    assert "the specification allows 1e-6 rad" in verdict.says[2]


def test_test_that_compares_angles_is_told_that_they_may_differ():
    verdict = check("three_levers.2", the_same_angles)
    told = (
        r"The gripper was (\S+) m from K, S was (\S+)° above the minimum, and the angles differed "
    )
    off, above, apart = re.search(rf"{told}by up to (\S+)° from", " ".join(verdict.says)).groups()
    assert float(off) < 1e-5 and float(above) <= 0.02 and float(apart) > 1e-5
    assert "That meets the specification." in " ".join(verdict.says)


@pytest.mark.parametrize("who", range(8))
def test_individual_task_can_be_solved_but_not_greedily(who):
    numbers = variant("three_levers", who)
    greedy = [q[2] for q in PLAN["greedy"](numbers)]
    verdict = check("three_levers.3", {"first": greedy[0], "second": greedy[1]}, who=who)
    assert not verdict.holds and "greed" in verdict.mistake
    one, two = (
        ARM.family(place, np.linspace(*ARM.alpha_range(place), 121))
        for place in PLAN["places"](numbers)
    )
    to_one, to_two = PLAN["changes"](numbers, (one[:, None], two))
    S = to_one.sum(axis=-1) + to_two.sum(axis=-1)
    longest = to_one.max(axis=-1) + to_two.max(axis=-1)
    met = np.argwhere((S <= numbers["most"]) & (longest <= numbers["longest"]))
    assert 0 < len(met) < 0.5 * S.size
    i, j = met[len(met) // 2]
    assert check("three_levers.3", [one[i, 2], two[j, 2]], who=who).holds
    assert variant("three_levers", f" {who} ") == numbers


@pytest.mark.parametrize(
    ("answer", "mistake"),
    [
        ({"first": 120, "second": 110}, "degrees for radians"),
        ({"first": 0.5, "second": 2.0}, "alpha outside its range"),
        ({"first": 120 * deg * deg, "second": 110 * deg * deg}, "deg twice"),
        ({"first": 2.4}, "another kind or shape"),
        ({"first": 2.4, "second": np.pi}, "gamma past its limit at the second target"),
    ],
)
def test_reasons_why_plans_fail_are_reported(answer, mistake):
    verdict = check("three_levers.3", answer, who="Ada")
    assert not verdict.holds and verdict.mistake == mistake and verdict.says


def test_plan_of_strings_is_refused():
    text = check("three_levers.3", {"first": "2.4", "second": 2.0}, who="Ada")
    assert text.mistake == "another kind or shape"


def test_slightly_wrong_posture_is_reported_with_different_numbers():
    told = check("three_levers.1", lambda *case: levers(*case) + [3e-6, 0, 0]).case
    assert re.search(r"\n  gamma, beta, alpha should be \(\S+, \S+, \S+\)°; yours, \(", told)
    place, off = re.search(r"gripper at \((.*)\) m, (.*) m from K", told).groups()
    assert float(off) > 0 and place.count(",") == 1

    def other_bend(K, alpha, lengths):
        gamma, beta, _ = levers(K, alpha, lengths)
        side = np.arctan2(K[1], K[0])
        return [2 * side - gamma, 2 * np.pi - beta, 2 * np.pi - alpha]

    assert (
        "reaches K, too, but it is a different posture" in check("three_levers.1", other_bend).case
    )


def first_and_last_angle(program):
    """A test that checks gamma and alpha, but not beta."""
    for K, previous, S in tasks(140):
        q = np.array(program(K, previous))
        whole = ARM.family(K, np.clip(q[2], *ARM.alpha_range(K)))
        if not abs(q[0] - whole[0]) < 1e-4 or abs(whole - previous).sum() > S + 0.021 * deg:
            return False
    return True


def test_test_must_start_from_different_postures():
    """A second check gives the same verdict, since each check makes new copies of the stateful
    programs.
    """
    arm, rng = three_lever(1.0), np.random.default_rng(5)
    places = rng.uniform(1.2, 2.8, 100)[:, None] * [np.cos(0.8), np.sin(0.8)]

    def judged(stands):
        def is_least(program):
            for K, previous in zip(places, stands, strict=True):
                q, S = np.asarray(program(K, previous)), arm.least(K, previous)[1]
                if q.shape != (3,) or not (abs(q - np.pi / 2) <= np.pi / 2 + 1e-6).all():
                    return False
                if not np.linalg.norm(arm.fk(q).translation[:2] - K) < 1e-5:
                    return False
                if not abs(q - previous).sum() <= S + 0.02 * deg:
                    return False
            return True

        return check("three_levers.2", is_least).mistake

    for _ in range(2):
        assert judged(np.ones((100, 3))) == "accepts: the previous posture of the first task"
    assert judged(rng.uniform(0.2, 3, (100, 3))) != judged(np.ones((100, 3)))


def test_slow_test_is_told_that_its_own_time_is_up(monkeypatch):
    monkeypatch.setattr(answers, "SECONDS", 0.3)

    def slow(program):
        while True:
            for K, previous, _ in tasks(100):
                program(K, previous)

    verdict = check("three_levers.2", slow)
    assert verdict.mistake == "never ends"
    assert verdict.says[0].endswith("your whole test of this program: try fewer cases.")


def test_test_must_check_every_angle():
    assert "beta" in check("three_levers.2", first_and_last_angle).mistake


@pytest.mark.parametrize("share", [0.95, 0.99])
def test_answer_that_returns_nan_for_points_just_within_reach_is_refused(share):
    def far(K, alpha, lengths):
        a, b, c = lengths
        KB = np.sqrt(b**2 + c**2 - 2 * b * c * np.cos(alpha))
        return levers(K, alpha, lengths) if np.hypot(*K) < share * (a + KB) else np.nan

    def near(K, alpha, lengths):
        a, b, c = lengths
        KB = np.sqrt(b**2 + c**2 - 2 * b * c * np.cos(alpha))
        return levers(K, alpha, lengths) if share * np.hypot(*K) > abs(a - KB) else np.nan

    assert not check("three_levers.1", far).holds and not check("three_levers.1", near).holds


def test_first_example_for_a_test_that_accepts_everything_is_the_plainest_one():
    verdict = check("three_levers.2", lambda program: True)
    assert verdict.mistake == "accepts every program"
    assert "it stays where it is" in verdict.case


@pytest.mark.parametrize("plus", [0.02, 0.15 * deg, 1.15 * deg])
def test_limit_of_s_in_radians_is_told_its_unit(plus):
    verdict = check("three_levers.2", least_test(plus=plus))
    assert verdict.mistake.startswith("accepts: a step of ")
    assert "S is in radians" in verdict.says[0] and "`0.02 * deg`" in verdict.says[0]
