"""Slow correct answers pass: only their own CPU time counts, separately for each case."""

import numpy as np
import pytest
from scipy.optimize import brentq

from robokin import Quaternion, Transform, blend, deg, mm, three_lever
from robokin.course import check

X, Y, Z = np.eye(3)
START, VIA, GOAL = (
    Transform(Quaternion.from_angle_axis(angle * deg, axis), np.array(place) * mm)
    for place, angle, axis in (
        ((200, 400, 200), 90, -X),
        ((650, -100, 800), 45, Y),
        ((300, 300, 500), 90, Y),
    )
)


def _off(b, distance, corner):
    path = blend(START, VIA, GOAL, b, np.array([0.5]), corner=corner)
    return np.linalg.norm(path.translation[0] - VIA.translation) - distance


def _peak(b, corner):
    """The greatest acceleration, by second differences of samples in the corner."""
    t = np.linspace(10 - 20 * b, 10 + 20 * b, 1001)
    place = blend(START, VIA, GOAL, b, t / 20, corner=corner).translation
    return np.linalg.norm(np.diff(place, n=2, axis=0), axis=-1).max() / (t[1] - t[0]) ** 2


def by_bisection(distance, corner):
    if _off(0.5, distance, corner) < 0:
        return np.nan, np.nan
    low, high = 0.0, 0.5
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if _off(middle, distance, corner) < 0 else (low, middle)
    return high, _peak(high, corner)


def by_brentq(distance, corner):
    if _off(0.5, distance, corner) < 0:
        return np.nan, np.nan
    b = brentq(_off, 0, 0.5, args=(distance, corner), xtol=1e-15)
    return b, _peak(b, corner)


@pytest.mark.parametrize("answer", [by_bisection, by_brentq])
def test_answers_that_search_for_the_blend_and_measure_the_acceleration_pass(answer):
    assert check("irb140_motion.1", answer).holds


def test_test_with_150_random_tasks_per_program_passes():
    arm = three_lever(1.0)
    rng = np.random.default_rng(3)

    def is_least(program):
        for _ in range(150):
            length, angle = rng.uniform(1.01, 2.99), rng.uniform(-np.pi, np.pi)
            K = length * np.array([np.cos(angle), np.sin(angle)])
            previous = rng.uniform(0.2, np.pi, 3)
            best, least = arm.least(K, previous)
            if np.isnan(best).any():
                continue
            q = np.asarray(program(K, previous), dtype=float)
            if q.shape != (3,) or not np.isfinite(q).all():
                return False
            gripper = arm.fk(q).translation[:2]
            if np.linalg.norm(gripper - K) > 1e-5 or (q < -1e-6).any() or (q > np.pi + 1e-6).any():
                return False
            if abs(q - previous).sum() > least + 0.02 * deg:
                return False
        return True

    assert check("three_levers.2", is_least).holds
