"""The exercises of lab 07: right answers in unlike styles hold, and wrong ones are named. What
holds of every lab stands in test_course_labs.py.
"""

import numpy as np
import pytest

from robokin import PUMA560, deg
from robokin.course import check
from robokin.course import puma560_branches as lab

FORE = np.hypot(431.8, 20.3)
OFFSET = np.arctan2(431.8, 20.3)


def said(front, above, noflip):
    return (
        "RIGHTY" if front else "LEFTY",
        "ABOVE" if above else "BELOW",
        "NOFLIP" if noflip else "FLIP",
    )


def front_of(q):
    return 431.8 * np.cos(q[1]) + FORE * np.cos(q[1] + q[2] + OFFSET) > 0


def by_flags(q):
    front = front_of(q)
    return said(front, front != (np.sin(q[2] + OFFSET) > 0), q[4] > 0)


def by_row(turn_back, order):
    def name(q):
        miss = PUMA560.ik(PUMA560.fk(q)) - q
        if turn_back:
            miss = (miss + np.pi) % (2 * np.pi) - np.pi
        row = np.linalg.norm(miss, ord=order, axis=-1).argmin()
        front, elbow, wrist = PUMA560.branches[row]
        return " ".join(said(front > 0, front * elbow < 0, wrist > 0))

    return name


@pytest.mark.parametrize("answer", [by_flags, by_row(True, 1), by_row(True, np.inf)])
def test_right_names_hold(answer):
    verdict = check("puma560_branches.1", answer)
    assert verdict.holds, verdict


@pytest.mark.parametrize(
    "answer, mistake",
    [
        (by_row(False, 1), "whole turns in the comparison of rows"),
        (by_row(False, 2), "whole turns in the comparison of rows"),
        (by_row(False, np.inf), "whole turns in the comparison of rows"),
        (lambda q: (*by_flags(q)[:2], "NOFLIP"), "always NOFLIP"),
        (
            lambda q: said(front_of(q), q[2] < -90 * deg, q[4] > 0),
            "the stretched arm at q3 = −90° and the elbow's flag alone, −1 for ABOVE",
        ),
        (
            lambda q: said(front_of(q), np.sin(q[1]) > 0, q[4] > 0),
            "higher than the shoulder",
        ),
    ],
)
def test_wrong_names_are_named(answer, mistake):
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
def test_right_speeds_hold(answer):
    verdict = check("puma560_branches.2", answer)
    assert verdict.holds, verdict


@pytest.mark.parametrize(
    "answer, mistake",
    [
        (
            lambda q, d, most: abs(PUMA560.jacobian(q)[:3].T @ d) @ most / np.sqrt((d * d).sum()),
            "forward for inverse",
        ),
        (
            lambda q, d, most: 1 / np.linalg.norm(rates(q, d) / most),
            "the length of the joint speeds",
        ),
        (lambda q, d, most: (most / abs(rates(q, d))).sum(), "the sum of the quotients"),
        (lambda q, d, most: most.mean() / abs(rates(q, d)).max(), "one most for all joints"),
    ],
)
def test_wrong_speeds_are_named(answer, mistake):
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
        (lambda fastest: 1.02 * fastest, "the joint speed for the duration"),
    ],
)
def test_a_duration_is_told_what_it_is(change, mistake):
    numbers = lab.given("Bo")
    least = lab._of(numbers).least(numbers["fastest"])
    duration = least.min() * change(numbers["fastest"])
    verdict = check(
        "puma560_branches.3", {"row": int(least.argmin()), "duration": duration}, who="Bo"
    )
    assert verdict.holds == (mistake is None) and verdict.mistake == mistake, verdict


def test_the_peak_of_ptp_is_not_that_of_a_line():
    numbers = lab.given("Chen")
    judged = lab._of(numbers)
    row = int(judged.least(1.0).argmin())
    duration = 15 / 8 * judged.mean[row] / numbers["fastest"]
    verdict = check("puma560_branches.3", {"row": row, "duration": duration}, who="Chen")
    assert verdict.mistake == "the peak of PTP on a line", verdict
