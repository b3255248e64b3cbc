"""The exercises of lab 07: correct answers in different styles pass, and mistakes are named. The
laws for all labs are in test_course_labs.py.
"""

import re

import numpy as np
import pytest

from robokin import PUMA560, deg, mm
from robokin.course import book, check

lab = book.lab("puma560_branches")
judged_line = lab.module("own_line")["judged_line"]


def said(front, above, noflip):
    return (
        "RIGHTY" if front else "LEFTY",
        "ABOVE" if above else "BELOW",
        "NOFLIP" if noflip else "FLIP",
    )


def front_of(q, a2, a3, d4):
    return a2 * np.cos(q[1]) + a3 * np.cos(q[1] + q[2]) > d4 * np.sin(q[1] + q[2])


def by_flags(q, a2, a3, d4):
    front = front_of(q, a2, a3, d4)
    return said(front, front != (np.sin(q[2] + np.arctan2(d4, a3)) > 0), q[4] > 0)


def by_places(q, a2, a3, d4):
    """Name a posture from the places of elbow and wrist centre in the plane of the arm."""
    elbow = a2 * np.exp(1j * q[1])
    wrist = elbow + (a3 + 1j * d4) * np.exp(1j * (q[1] + q[2]))
    above = elbow.imag > wrist.imag * elbow.real / wrist.real
    return " ".join(said(wrist.real > 0, above, q[4] > 0))


def by_row(q, *lengths):
    """Name a posture from the row of `PUMA560.ik` that equals it up to whole turns."""
    off = np.sin((PUMA560.ik(PUMA560.fk(q)) - q) / 2)
    front, elbow, wrist = PUMA560.branches[abs(off).max(axis=-1).argmin()]
    return " ".join(said(front > 0, front * elbow < 0, wrist > 0))


@pytest.mark.parametrize("answer", [by_flags, by_places])
def test_correct_configuration_names_pass(answer):
    verdict = check("puma560_branches.1", answer)
    assert verdict.holds, verdict


@pytest.mark.parametrize(
    "answer, mistake",
    [
        (by_row, "the lengths of the PUMA"),
        (lambda q, *_: by_flags(q, 431.8, 20.3, 431.8), "the lengths of the PUMA"),
        (lambda q, *rest: (*by_flags(q, *rest)[:2], "NOFLIP"), "always NOFLIP"),
        (
            lambda q, *rest: said(front_of(q, *rest), q[2] < -90 * deg, q[4] > 0),
            "the stretched arm at q3 = −90°, and the elbow flag alone, −1 for ABOVE",
        ),
        (
            lambda q, *rest: said(front_of(q, *rest), np.sin(q[1]) > 0, q[4] > 0),
            "higher than the shoulder",
        ),
    ],
)
def test_mistakes_in_configuration_names_are_reported(answer, mistake):
    verdict = check("puma560_branches.1", answer)
    assert not verdict.holds and verdict.mistake == mistake, verdict


def rates(q, direction):
    unit = direction / np.linalg.norm(direction)
    return np.linalg.solve(PUMA560.jacobian(q), [*unit, 0, 0, 0])


def doubled(q, direction, most):
    low, high = 0.0, 1.0
    while (abs(rates(q, direction)) * high <= most).all():
        high *= 2
    for _ in range(60):
        middle = (low + high) / 2
        fits = (abs(rates(q, direction)) * middle <= most).all()
        low, high = (middle, high) if fits else (low, middle)
    return low


@pytest.mark.parametrize("answer", [doubled, lambda q, d, most: 1 / max(abs(rates(q, d) / most))])
def test_correct_speeds_pass(answer):
    verdict = check("puma560_branches.2", answer)
    assert verdict.holds, verdict


@pytest.mark.parametrize(
    "answer, mistake",
    [
        (
            lambda q, d, most: abs(PUMA560.jacobian(q)[:3].T @ d) @ most / np.sqrt((d * d).sum()),
            "forward instead of inverse",
        ),
        (
            lambda q, d, most: 1 / np.linalg.norm(rates(q, d) / most),
            "the length of the joint speeds",
        ),
        (lambda q, d, most: (most / abs(rates(q, d))).sum(), "the sum of the quotients"),
        (lambda q, d, most: most.mean() / abs(rates(q, d)).max(), "the mean limit for all joints"),
    ],
)
def test_mistakes_in_speeds_are_named(answer, mistake):
    verdict = check("puma560_branches.2", answer)
    assert not verdict.holds and verdict.mistake == mistake, verdict


@pytest.mark.parametrize(
    "change, mistake",
    [
        (lambda fastest: 1.02, None),
        (lambda fastest: 1.2, "too slow"),
        (lambda fastest: 0.9, "too fast"),
        (lambda fastest: 1.02 * deg, "degrees for radians"),
        (lambda fastest: 1.02 / deg, "degrees for radians"),
        (lambda fastest: 1.02 * fastest, "the joint speed instead of the duration"),
    ],
)
def test_durations_get_the_expected_verdicts(change, mistake):
    # if the greatest speed is near 1 rad/s, multiplying by it hardly changes the duration
    who = next(name for name in map(str, range(99)) if abs(lab.given(name)["fastest"] - 1) > 0.3)
    numbers = lab.given(who)
    least = judged_line(numbers).least(numbers["fastest"])
    duration = least.min() * change(numbers["fastest"])
    verdict = check(
        "puma560_branches.3", {"row": int(least.argmin()), "duration": duration}, who=who
    )
    assert verdict.holds == (mistake is None) and verdict.mistake == mistake, verdict


def test_peak_speed_of_ptp_is_not_that_of_a_line():
    for who in map(str, range(99)):
        numbers = lab.given(who)
        judged = judged_line(numbers)
        row = int(judged.least(1.0).argmin())
        if 15 / 8 * judged.mean[row] < 0.98 * judged.speed[row]:  # on other lines both are close
            break
    duration = 15 / 8 * judged.mean[row] / numbers["fastest"]
    verdict = check("puma560_branches.3", {"row": row, "duration": duration}, who=who)
    assert verdict.mistake == "the peak of PTP on a line", verdict


def test_each_line_offers_a_choice_and_no_row_is_always_the_quickest():
    quickest = set()
    for who in map(str, range(8)):
        least = np.sort(judged_line(lab.given(who)).least(1.0))
        assert 1.15 * least[0] < least[1] < 4 * least[0] and np.isinf(least[4:]).all(), who
        quickest.add(int(judged_line(lab.given(who)).least(1.0).argmin()))
    assert quickest == {1, 2}


@pytest.mark.parametrize("factor", [0.5, 0.9, 1.06, 1.08, 1.3, 3])
def test_messages_about_lines_do_not_reveal_the_answer(factor):
    for who in ("Ada", "Bo", "Chen", "Dora", "Emil"):
        numbers = lab.given(who)
        least = judged_line(numbers).least(numbers["fastest"])
        row, other = np.argsort(least)[:2].tolist()
        for k in (row, other):
            answer = {"row": k, "duration": factor * float(least[k] if k == row else least[row])}
            verdict = check("puma560_branches.3", answer, who=who)
            told = " ".join(verdict.says)
            assert not verdict.holds and f"{least[row]:.3g} s" not in told.replace(
                f"{answer['duration']:.4g} s", ""
            )
            assert k == row or f"row {row}" not in told.lower()
            if k == row and factor in (1.06, 1.08):
                assert verdict.mistake == "too slow", (who, verdict)


def test_distances_and_speeds_are_reported_with_suitable_precision():
    names, speeds = lab.exercises["1"], lab.exercises["2"]
    for k, case in enumerate(names.cases):
        told = names.code["law"](case, "nothing", names.wanted[k])
        assert int(re.search(r"the elbow is (\d+) mm", told)[1]) <= case[1] / mm, told
    law, case, right = speeds.code["law"], speeds.cases[0], speeds.wanted[0]
    assert "1.5 · 10³¹ m/s is far too fast" in law(case, 1.489e31, right)
    should, is_at = re.findall(r"(\d\.\d+) m/s", law(case, 1.003 * right, right))
    assert should != is_at


def test_missing_offset_and_slightly_wrong_bend_are_detected():
    def of(q, front, bend):
        return said(front, front != (np.sin(bend) > 0), q[4] > 0)

    def without_a3(q, a2, a3, d4):
        front = a2 * np.cos(q[1]) - d4 * np.sin(q[1] + q[2]) > 0
        return of(q, front, q[2] + np.arctan2(d4, a3))

    assert check("puma560_branches.1", without_a3).mistake == "a3 is left out"
    off = check(
        "puma560_branches.1",
        lambda q, a2, a3, d4: of(q, front_of(q, a2, a3, d4), q[2] + np.arctan2(d4, a3) - 2 * deg),
    )
    assert not off.holds
