"""The exercises and predictions of lab 03: correct answers in every style pass, mistakes are named,
and the answer to every prediction is computed by another method.
"""

import json
import math
import re

import numpy as np
import pytest
from conftest import NOTEBOOKS

from robokin import (
    IRB140,
    Arm,
    Quaternion,
    Transform,
    blend,
    deg,
    differentiate,
    mm,
    nearest,
    ptp,
)
from robokin.course import book, check
from robokin.course.questions import filled

FUNCTIONS = ("1", "2")
LAB = book.lab("irb140_motion")
SHARED, FACTS = LAB.module("shared"), LAB.module("predictions")
START, VIA, GOAL, LEFT, RIGHT, ROW = (
    SHARED[name] for name in ("START", "VIA", "GOAL", "LEFT", "RIGHT", "ROW")
)
NAN = float("nan")


# --- Exercise 1: the blend for a distance, and its acceleration -----------------------------------


def _with_peak(blend_of):
    """An answer that adds the greatest second difference of the path in the corner to the blend."""

    def answer(distance, corner):
        b = blend_of(distance, corner)
        if np.isnan(b):
            return b, b
        s = 0.5 + np.linspace(-1, 1, 801) * b
        path = blend(START, VIA, GOAL, b, s, corner=corner).translation
        bends = np.linalg.norm(np.diff(path, n=2, axis=0), axis=1)
        return b, bends.max() / (20 * (s[1] - s[0])) ** 2

    return answer


def _by_table(distance, corner):
    values = np.linspace(0, 0.5, 6)
    gaps = [_gap(b, corner) for b in values]
    return NAN if distance > gaps[-1] else np.interp(distance, gaps, values)


def _by_bisection(distance, corner):
    low, high = 0.0, 0.5
    if _gap(high, corner) < distance:
        return None or NAN
    for _ in range(30):
        middle = (low + high) / 2
        low, high = (middle, high) if _gap(middle, corner) < distance else (low, middle)
    return high


def _gap(b, corner):
    middle = blend(START, VIA, GOAL, b, 0.5, corner=corner).translation
    return np.linalg.norm(middle - VIA.translation)


def _by_the_middle(distance, corner):
    middle = (START.translation + GOAL.translation) / 2
    reach = np.linalg.norm(middle - VIA.translation)
    if corner == "quintic":
        reach *= 0.75
    b = np.array([distance / reach])
    b[b > 0.5] = np.nan
    return b


def _by_one_call(distance, corner):
    fraction = 0.5 * distance / _gap(0.5, corner)
    return round(fraction, 9) if fraction < 0.5 else np.float64("nan")


def _by_hand(distance, corner):
    x, y, z = (2 * VIA.translation - START.translation - GOAL.translation).tolist()
    d = (x * x + y * y + z * z) ** 0.5
    b = 2 * distance / d
    if corner != "parabola":
        b = b * 4 / 3
    if b > 0.5:
        return float("nan")
    return b


@pytest.mark.parametrize(
    "answer", [_by_table, _by_bisection, _by_the_middle, _by_one_call, _by_hand]
)
def test_blends_found_by_other_methods_pass(answer):
    verdict = check("irb140_motion.1", _with_peak(answer))
    assert verdict.holds, verdict


def test_blend_alone_and_an_acceleration_that_does_not_fit_the_blend_are_refused():
    verdict = check("irb140_motion.1", _by_hand)
    assert (
        not verdict.holds and "wanted two numbers, the blend and the acceleration" in verdict.case
    )
    right = _with_peak(_by_hand)
    for factor in (0, -1, 0.98, 1.02, NAN):
        verdict = check(
            "irb140_motion.1", lambda *case, f=factor: np.multiply(right(*case), (1, f))
        )
        assert not verdict.holds, factor
    assert check("irb140_motion.1", lambda *case: np.multiply(right(*case), (1, 1.005))).holds


def test_acceleration_in_the_solution_agrees_with_the_curve():
    """The control poses of the quintic are at 0, 0.4 and 0.8 of the way to via. The curve has the
    second derivative of a polynomial in the Bernstein form.
    """
    exercise = LAB.exercises["1"]
    place = [pose.translation for pose in (START, VIA, GOAL)]
    x = np.linspace(0, 1, 2001)[:, None]
    for corner, shares in (("parabola", [1, 0]), ("quintic", [1, 0.6, 0.2])):
        b, told = exercise.right(0.06, corner)
        into, out = ([place[1] + 2 * b * k * (end - place[1]) for k in shares]
                     for end in (place[0], place[2]))  # fmt: skip
        controls = np.array([*into, *out[::-1]] if corner == "quintic" else [*into, out[0]])
        n = len(controls) - 1
        weights = [math.comb(n - 2, k) * x**k * (1 - x) ** (n - 2 - k) for k in range(n - 1)]
        second = np.diff(controls, 2, axis=0)
        bends = n * (n - 1) * sum(w * d for w, d in zip(weights, second, strict=True))
        peak = np.linalg.norm(bends, axis=1).max() / (2 * b * 20) ** 2
        assert told == pytest.approx(peak, rel=1e-6), corner


def test_blend_in_the_task_matches_that_of_the_document():
    exercise = LAB.exercises["1"]
    wanted = np.array(exercise.right(0.05, "parabola"))
    assert _gap(wanted[0], "parabola") == pytest.approx(50 * mm)
    law = exercise.code["law"]
    assert law((0.05, "parabola"), np.array([0.06, 0.06]), wanted) == (
        "the blend should be 0.06652, so that the tool is 50.0 mm from via in the middle of the "
        "parabola; with 0.06, it is 45.1 mm from via"
    )
    assert law((0.05, "parabola"), wanted * [1, 2], wanted) == (
        "the blend is right, but with it the tool's greatest acceleration in the corner is "
        "0.0565 m/s², not 0.113 m/s²"
    )


# --- Exercise 2: PTP the short way ----------------------------------------------------------------


def _by_arrays(q0, q1, s, limits):
    values = q1[:, None] + 2 * np.pi * np.arange(-5, 6)
    away = np.where(
        (values >= limits[:, :1]) & (values <= limits[:, 1:]), abs(values - q0[:, None]), np.inf
    )
    end = np.where(np.isfinite(away).any(axis=1), values[range(6), away.argmin(axis=1)], np.nan)
    return q0 + np.multiply.outer(s, end - q0)


def _by_loops(q0, q1, s, limits):
    rows = []
    for share in s:
        row = []
        for a, b, (low, high) in zip(q0, q1, limits, strict=True):
            best = None
            for k in range(-3, 4):
                value = b + k * 2 * np.pi
                if low <= value <= high and (best is None or abs(value - a) < abs(best - a)):
                    best = value
            row.append(NAN if best is None else float(a + share * (best - a)))
        rows.append(row)
    return rows


def _by_recursion(q0, q1, s, limits):
    def shifted(value, near, low, high):
        if value > high:
            lower = value - 2 * np.pi
            return shifted(lower, near, low, high) if lower >= low else NAN
        if value < low:
            higher = value + 2 * np.pi
            return shifted(higher, near, low, high) if higher <= high else NAN
        if value - near > np.pi and value - 2 * np.pi >= low:
            return shifted(value - 2 * np.pi, near, low, high)
        if near - value > np.pi and value + 2 * np.pi <= high:
            return shifted(value + 2 * np.pi, near, low, high)
        return value

    end = np.array([shifted(b, a, *pair) for a, b, pair in zip(q0, q1, limits, strict=True)])
    return np.outer(1 - s, q0) + np.outer(s, end)


def _by_masks(q0, q1, s, limits):
    values = q1 + 2 * np.pi * np.arange(-3, 4)[:, None]
    low, high = limits.T
    travel = np.ma.masked_array(abs(values - q0), (values < low) | (values > high))
    end = values[travel.argmin(axis=0), range(6)]
    end[travel.mask.all(axis=0)] = np.nan
    return np.stack([q0 + share * (end - q0) for share in s])


def _by_rounding(q0, q1, s, limits):
    end = q1 + 2 * np.pi * np.round((q0 - q1) / (2 * np.pi))
    end = np.where(end > limits[:, 1], end - 2 * np.pi, end)
    end = np.where(end < limits[:, 0], end + 2 * np.pi, end)
    end[(end < limits[:, 0]) | (end > limits[:, 1])] = np.nan
    return (q0 + s[:, None] * (end - q0)).round(9)


@pytest.mark.parametrize("answer", [_by_arrays, _by_loops, _by_recursion, _by_masks, _by_rounding])
def test_shortest_ptp_motions_found_by_other_methods_pass(answer):
    verdict = check("irb140_motion.2", answer)
    assert verdict.holds, verdict


def _in_a_library_call(q0, q1, s, limits):
    return ptp(q0, nearest(Arm("arm", IRB140.geometry, limits), q1[None], q0), s)


def test_library_call_leaves_a_joint_outside_its_limits_and_does_not_pass():
    """`nearest` falls back to a value outside the limits where none is inside."""
    verdict = check("irb140_motion.2", _in_a_library_call)
    assert not verdict.holds and verdict.mistake == "a value outside the limits", verdict
    assert "joint 3 has no value inside its limits of -230° and 50°" in verdict.case


@pytest.mark.parametrize("order", ["up, then down", "down, then up", "up or down"])
def test_one_turn_more_where_the_nearest_value_is_outside_the_limits_is_reported(order):
    def answer(q0, q1, s, limits):
        end = q1 + 2 * np.pi * np.round((q0 - q1) / (2 * np.pi))
        for joint, (low, high) in enumerate(limits):
            if order == "up or down":
                end[joint] += 2 * np.pi * (int(end[joint] < low) - int(end[joint] > high))
            for way in order.split(", then "):
                if way == "up" and end[joint] < low:
                    end[joint] += 2 * np.pi
                if way == "down" and end[joint] > high:
                    end[joint] -= 2 * np.pi
        return q0 + s[:, None] * (end - q0)

    verdict = check("irb140_motion.2", answer)
    assert not verdict.holds and verdict.mistake == "a value outside the limits", verdict


@pytest.mark.parametrize("samples", [101, 501, 1001])
@pytest.mark.parametrize("method", ["gradient", "diff"])
def test_acceleration_measured_on_coarse_samples_is_reported(samples, method):
    def answer(distance, corner):
        b = _by_hand(distance, corner)
        if np.isnan(b):
            return b, b
        t = np.linspace(0, 20, samples)
        place = blend(START, VIA, GOAL, b, t / 20, corner=corner).translation
        if method == "diff":
            push = np.diff(place, 2, axis=0) / t[1] ** 2
        else:
            push = np.gradient(np.gradient(place, t, axis=0), t, axis=0)
        return b, np.linalg.norm(push, axis=1).max()

    verdict = check("irb140_motion.1", answer)
    assert verdict.mistake == "the acceleration measured on coarse samples", verdict


@pytest.mark.parametrize("without", ["q1", "the first value", "the nearest value", "NaN", "q0"])
def test_one_turn_is_too_little_whatever_stands_in_for_the_value_that_is_missing(without):
    def answer(q0, q1, s, limits):
        end = q1.copy()
        for joint, (low, high) in enumerate(limits):
            values = [q1[joint] + 2 * np.pi * k for k in (-1, 0, 1)]
            other = {"q1": q1[joint], "the first value": values[0], "q0": q0[joint], "NaN": NAN}
            other["the nearest value"] = min(values, key=lambda x: abs(x - q0[joint]))
            inside = [value for value in values if low <= value <= high] or [other[without]]
            end[joint] = min(inside, key=lambda x: abs(x - q0[joint]))
        return q0 + s[:, None] * (end - q0)

    verdict = check("irb140_motion.2", answer)
    assert not verdict.holds and verdict.mistake == "only one turn", verdict


@pytest.mark.parametrize(
    ("most", "limited", "name"),
    [
        (1, True, "only one turn"),
        (2, True, "only two turns"),
        (2, False, "only two turns, without"),
    ],
)
def test_too_few_turns_are_reported(most, limited, name):
    def few(q0, q1, s, limits):
        low, high = limits.T
        values = q1 + 2 * np.pi * np.array(sorted(range(-most, most + 1), key=abs))[:, None]
        fits = (values >= low) & (values <= high) | (not limited)
        end = values[np.where(fits, abs(values - q0), np.inf).argmin(axis=0), range(6)]
        return q0 + s[:, None] * (end - q0)

    verdict = check("irb140_motion.2", few)
    assert not verdict.holds and verdict.mistake.startswith(name), verdict


def test_no_case_depends_on_how_a_computer_rounds():
    # the wrong programs that choose a row of `ik` must choose the same one on every machine
    for q0, q1, *_ in book.find("irb140_motion.2", "exercises").cases:
        ends = [nearest(IRB140, row[None], q0) for row in IRB140.ik(IRB140.fk(q1))]
        first = nearest(IRB140, ends, q0)
        others = [end for end in ends if not np.allclose(end, first, atol=1e-6)]
        assert min(abs(end - q0).sum() for end in others) > abs(first - q0).sum() + 1e-3


def test_slightly_wrong_value_is_called_nearly_right():
    D = 1503 * mm  # typed with too few digits

    def typed(distance, corner):
        fraction = distance / ({"parabola": 1 / 2, "quintic": 3 / 8}[corner] * D * 1.001)
        fraction = fraction if fraction <= 0.5 else NAN
        return fraction, {"parabola": 1, "quintic": 1.5}[corner] * D / (fraction * 400)

    verdict = check("irb140_motion.1", typed)
    assert verdict.mistake == "nearly right", verdict


def test_correct_motion_satisfies_its_laws():
    exercise = LAB.exercises["2"]
    for q0, q1, s, limits in exercise.cases:
        end = exercise.right(q0, q1, np.array([0.0, 1.0]), limits)
        low, high = limits.T
        values = q1 + 2 * np.pi * np.arange(-9, 10)[:, None]
        none = ~((low <= values) & (values <= high)).any(axis=0)
        assert (np.isnan(end) == none).all() and not none.all()
        assert (none | (end[0] == q0)).all()
        pose = IRB140.fk(np.where(none, q1, end[1])).as_matrix()
        assert np.allclose(pose, IRB140.fk(q1).as_matrix(), rtol=0, atol=1e-9)
        assert (none | (low - 1e-9 <= end) & (end <= high + 1e-9)).all()
        for k in range(-4, 5):  # no other value inside the limits is nearer to the start
            other = q1 + 2 * np.pi * k
            inside = (low <= other) & (other <= high)
            assert (~inside | (abs(other - q0) >= abs(end[1] - q0) - 1e-9)).all()
        motion = exercise.right(q0, q1, s, limits)
        assert np.isnan(motion[:, none]).all()
        there = ptp(q0, np.where(none, q0, end[1]), s)
        assert np.allclose(motion[:, ~none], there[:, ~none], rtol=0, atol=1e-12)


# --- Mistakes in exercises 1 and 2 ----------------------------------------------------------------


@pytest.mark.parametrize("number", FUNCTIONS)
def test_every_listed_mistake_is_named(number):
    exercise = LAB.exercises[number]
    for mistake in exercise.own:
        program = exercise.steps.program(mistake)
        verdict = check(f"irb140_motion.{number}", program)
        assert not verdict.holds and verdict.points < 1
        assert verdict.mistake == mistake.name, verdict
        assert verdict.case and mistake.says in verdict.says


@pytest.mark.parametrize("number", FUNCTIONS)
def test_unknown_mistake_is_refused_but_not_named(number):
    def stranger(*case):
        if number == "1":
            return 0.2 + 0.1 * np.sin(50 * case[0]) + 0.03 * (case[1] == "quintic"), case[0] ** 2
        q0, q1, s, _ = case
        return q0 * np.cos(s)[:, None] + q1 * np.sin(3 * s)[:, None]

    verdict = check(f"irb140_motion.{number}", stranger)
    assert not verdict.holds and verdict.mistake is None and verdict.case


@pytest.mark.parametrize(
    ("number", "answer", "name"),
    [
        ("1", lambda d, corner: str(d), "another kind or shape"),
        ("1", lambda d, corner: [0.1, 0.2, 0.3], "another kind or shape"),
        ("1", lambda d, corner: 0.1, "another kind or shape"),
        ("1", lambda d, corner: [].append(d), "returns None"),
        ("1", lambda d, corner: print(d), "prints instead of returning"),
        ("2", lambda q0, q1, s, _: q0 + s @ (q1[:2] - q0), "raises an error"),
        ("2", lambda q0, q1, s, _: IRB140.fk(q1), "another kind or shape"),
        ("2", lambda *case: _by_arrays(*case).T, "transposed"),
        ("2", lambda *case: _by_arrays(*case) / deg, "degrees for radians"),
        ("2", lambda q0, q1, s, _: s[:, None] * q1, "q0 has no effect"),
        (
            "2",
            lambda q0, q1, s, _: ptp(q0, nearest(IRB140, q1[None], q0), s),
            "the limits of the IRB-140",
        ),
        ("1", lambda d, corner: (0.123, 0.05), "one answer to everything"),
    ],
)
def test_answers_of_the_wrong_type_are_reported(number, answer, name):
    verdict = check(f"irb140_motion.{number}", answer)
    assert not verdict.holds and verdict.mistake == name, verdict


# --- Exercise 3: a test for speeds ----------------------------------------------------------------


def _wrapped(q):
    return np.angle(np.exp(1j * q))


def _by_one_sine(speeds):
    t = np.concatenate([np.arange(2, 6, 0.01), np.arange(6, 9, 0.004)])
    q = 3 + 1.5 * np.sin(2 * t)[:, None] * np.array([1, -1, 1, -1, 1, -1])
    v = 3 * np.cos(2 * t)[:, None] * np.array([1, -1, 1, -1, 1, -1])
    got = speeds(_wrapped(q), t)
    return (
        got.shape == v.shape
        and np.allclose(got[1:-1], v[1:-1], rtol=0, atol=1e-3)
        and (np.allclose(got, v, rtol=0, atol=0.1))
    )


def _by_assertions(speeds):
    t = np.linspace(-1, 1, 500) + 0.0015 * np.sin(np.arange(500))
    q = np.array([3.0, -3, 3, -3, 3, -3]) + np.outer(t**3 + t**2 - t, [1, 1, -1, -1, 1, -1])
    v = np.outer(3 * t**2 + 2 * t - 1, [1, 1, -1, -1, 1, -1])
    got = np.asarray(speeds(_wrapped(q), t))
    assert got.shape == (500, 6)
    assert np.nanmax(abs(got - v)[1:-1]) < 1e-3 and not np.isnan(got).any()
    assert abs(got - v)[[0, -1]].max() < 0.1


def _by_several_motions(speeds):
    rng = np.random.default_rng(5)
    t = 10 + np.cumsum(rng.choice([0.005, 0.01], 800))
    for size, rate in ((1.0, 1.5), (3.0, 1.0), (0.8, 2.0)):
        q = np.pi + size * np.sin(rate * t[:, None] + rng.uniform(0, 6, 6))
        got = speeds(_wrapped(q), t)
        reference = np.gradient(q, t, axis=0, edge_order=2)
        if got.shape != q.shape:
            return False
        error = abs(got - reference)
        if not (error[1:-1] <= 1e-3).all() or not (error <= 0.1).all():
            return False
    return True


def _by_summing_up(speeds):
    """A test that integrates the speeds and checks single samples."""
    t = 1 + np.cumsum(np.tile([0.01, 0.01, 0.005], 300))
    phase = np.linspace(0, 3, 6)
    q = 3 * np.sin(1.2 * t[:, None] + phase) + 1
    v = 3.6 * np.cos(1.2 * t[:, None] + phase)
    got = speeds(_wrapped(q), t)
    if np.shape(got) != (900, 6) or not np.isfinite(got).all():
        return False
    way = ((got[1:] + got[:-1]) / 2 * np.diff(t)[:, None]).cumsum(axis=0)
    if abs(way - (q[1:] - q[0])).max() > 0.01:
        return False
    worst = max(abs(got[k, j] - v[k, j]) for k in range(1, 899) for j in range(6))
    return bool(
        worst < 1e-3 and abs(got[0] - v[0]).max() < 0.1 and abs(got[-1] - v[-1]).max() < 0.1
    )


@pytest.mark.parametrize(
    "test", [_by_one_sine, _by_assertions, _by_several_motions, _by_summing_up]
)
def test_correct_tests_in_other_styles_pass(test):
    verdict = check("irb140_motion.3", test)
    assert verdict.holds, verdict


def test_correct_programs_are_accurate_and_constant_tests_do_not_pass():
    exercise = LAB.exercises["3"]
    rng = np.random.default_rng(2)
    for _ in range(5):
        t = rng.uniform(-5, 5) + np.cumsum(rng.uniform(0.002, 0.01, 400))
        rate = rng.uniform(0.8, 1.5, 6)
        phase, size = rng.uniform(0, 6, 6), np.minimum(10 / rate**3, 3)
        q = np.pi + size * np.sin(rate * t[:, None] + phase)
        v = size * rate * np.cos(rate * t[:, None] + phase)
        for what, text in exercise.rights:
            error = abs(exercise.program(text)(_wrapped(q), t) - v)
            assert error[1:-1].max() < 3e-4 and error.max() < 0.06, what
    for name in ("rejects every program", "accepts every program"):
        verdict = check("irb140_motion.3", lambda speeds, name=name: name.startswith("accepts"))
        assert verdict.mistake == name and not verdict.holds


@pytest.mark.parametrize(
    ("test", "slips"),
    [
        (dict(turns=0), "no unwrap"),
        (dict(even=True), "the first step for all"),
        (dict(begin=0.0), "times that begin at 0"),
        (dict(within=0.2), "off by half a sample (forward)"),
        (dict(ends=False), "the ends are zero"),
        (dict(ends=1.2), "the ends are off by 1 rad/s"),
        (dict(rows=[0, -1]), "no unwrap"),
    ],
)
def test_wrong_program_that_a_weak_test_accepts_is_named(test, slips):
    def weak(speeds, turns=np.pi, even=False, begin=2.0, within=1e-3, ends=0.1, rows=None):
        step = np.full(600, 0.008) if even else np.tile([0.005, 0.01], 300)
        t = begin + np.cumsum(step) - step[0]
        phase = np.arange(6)
        size = 2.0 if turns else 1.0
        q = turns + size * np.sin(t[:, None] + phase)
        error = abs(np.resize(speeds(_wrapped(q), t), q.shape) - size * np.cos(t[:, None] + phase))
        if np.shape(speeds(_wrapped(q), t)) != q.shape:
            return False
        if rows is not None:
            return bool((error[rows] < ends).all())
        return bool((error[1:-1] < within).all() and (not ends or (error < ends + within).all()))

    verdict = check("irb140_motion.3", lambda speeds: weak(speeds, **test))
    assert not verdict.holds and verdict.mistake == f"accepts: {slips}", verdict


def test_differentiate_is_correct_only_after_unwrapping():
    t = np.linspace(0, 2, 201)
    q = 3 + np.outer(t, np.arange(6))
    assert abs(differentiate(_wrapped(q), t)).max() > 100
    assert re.search("unwrap", LAB.exercises["3"].rights[0][0])


# --- Answers to the predictions -------------------------------------------------------------------

NOTEBOOK = json.loads((NOTEBOOKS / "03_irb140_motion.ipynb").read_text(encoding="utf-8"))
CELLS = {cell["id"]: cell for cell in NOTEBOOK["cells"]}


def _right(name):
    _, options, right = filled(LAB.predictions[name])
    return options[right].text


def _line_speeds(a, b, x, seconds):
    """Joint speeds at progress x of the line from a to b, from the Jacobian."""
    angle, axis = (b.rotation @ a.rotation.inverse()).as_angle_axis()
    twist = np.concatenate([b.translation - a.translation, angle * axis]) / seconds
    return np.linalg.solve(IRB140.jacobian(IRB140.ik(a.lerp(b, x))[ROW]), twist)


def test_answers_to_predictions_agree_with_other_methods():
    speeds = abs(np.array([_line_speeds(LEFT, RIGHT, x, 20) for x in np.arange(0, 1, 0.02)]))
    assert (speeds.max(axis=0) > 1.1 * speeds.min(axis=0)).all()
    assert _right("p1") == "None of them: a straight line in space is a curve in joint space."

    turns = abs(IRB140.ik(RIGHT)[ROW] - IRB140.ik(LEFT)[ROW])
    least, line = (turns / IRB140.speed_limits).max(), 20 * (speeds / IRB140.speed_limits).max()
    question = " ".join(filled(LAB.predictions["p2"])[0].split())
    told = (
        f"Less than {line:.2f} s, but no less than PTP: the joints have to turn as far as before."
    )
    assert _right("p2") == told and least < 0.6 * line
    assert f"took {line:.2f} s; in PTP, it took {least:.2f} s" in question

    q0, q1 = np.zeros(6), np.zeros(6)
    q0[5], q1[5] = 350 * deg, 60 * deg
    assert _right("p3") == f"{(nearest(IRB140, q1[None], q0)[5] - q0[5]) / deg:.0f}"

    slope = np.polynomial.Polynomial([0, 0, 0, 10, -15, 6]).deriv()
    assert _right("p4") == f"{100 * slope(0.5):.1f}" and slope.deriv()(0.5) == 0

    before, after = _line_speeds(START, VIA, 1.0, 10), _line_speeds(VIA, GOAL, 0.0, 10)
    number = float(re.match(r"About (\d+)°/s²:", _right("p5"))[1])
    assert number == pytest.approx((after - before)[2] / 0.01 / deg, rel=0.01)

    assert _right("p6").startswith(f"{20 * 2**0.5:.1f} s")

    found = []
    clock = np.linspace(0, 20, 4001)
    for b, corner in ((0.1, "parabola"), (0.1 / 0.75, "quintic"), (0.1, "quintic")):
        rows = IRB140.ik(blend(START, VIA, GOAL, b, clock / 20, corner=corner))[:, ROW]
        found.append(abs(np.diff(np.unwrap(rows[:, 2]), 2)).max() / 0.005**2)
    assert 1.1 < found[1] / found[0] < 1.13 and found[2] / found[0] > 1.5
    number = float(re.search(r", ([\d.]+)°/s²:", _right("p7"))[1])
    assert number == pytest.approx(found[1] / deg, rel=2e-3)

    def at(t):
        return IRB140.ik(LEFT.lerp(RIGHT, t / 20))[ROW]

    def speed(t):
        return _line_speeds(LEFT, RIGHT, t / 20, 20)

    exact = (speed(7 + 1e-4) - speed(7 - 1e-4)) / 2e-4
    errors = [
        abs((at(7 + h) - 2 * at(7) + at(7 - h)) / h**2 - exact).max() for h in (1e-1, 1e-3, 1e-7)
    ]
    assert errors[1] < errors[0] / 100 and errors[1] < errors[2] / 1e4
    assert _right("p8").startswith("About 0.001 s")

    x, places = 1 / 22, [pose.translation for pose in (START, VIA, GOAL)]
    a, c = places[0] - 0.1 * (places[1] - places[0]), places[2] + 0.1 * (places[2] - places[1])
    curve = (1 - x) ** 2 * a + 2 * x * (1 - x) * places[1] + x**2 * c
    assert _right("p9").startswith(f"{np.linalg.norm(curve - places[0]) / mm:.2f} mm")

    far = SHARED["pose"](900, -100, 800, 45, [0, 1, 0])
    hole = np.isnan(IRB140.ik(blend(START, far, GOAL, 0, FACTS["S"]))[:, ROW]).any(axis=-1)
    assert _right("p10").startswith(f"{hole.argmax()}:")


def test_nothing_outside_the_predictions_reveals_an_answer():
    seen = "\n".join(
        "".join(cell["source"])
        + "".join("".join(o.get("text", "")) for o in cell.get("outputs", ()))
        + "".join("".join(o.get("data", {}).get("text/plain", "")) for o in cell.get("outputs", ()))
        for id_, cell in CELLS.items()
        if not id_.startswith("predict-")
    )
    answers = ["0.62 s", "290", "5.06", "187.5", "1.875", "28.3", "9.77", "3.42", "413"]
    answers += ["5239", "5255"]
    assert not [answer for answer in answers if answer in seen]
    assert not re.search(r"quicker|no joint keeps|doubles whenever|after the first NaN", seen)


@pytest.mark.parametrize(
    ("cell", "names"),
    [
        ("race", "left right"),
        ("lin-code", "left aim"),
        ("long-way-player", "left right"),
        ("own-via", "start via goal"),
        ("bezier-code", "start via goal"),
        ("effect-view", "start via goal"),
        ("diff-halve", "start via goal"),
        ("your-turn-code", "start via goal"),
        ("laws-numbers", "left right"),
        ("diff-orders", "left right"),
        ("too-much-code", "start via goal"),
    ],
)
def test_every_section_uses_the_poses_of_the_exercises(cell, names):
    text = "".join(CELLS[cell]["source"])
    lines = re.findall(r"^turns = .*\n.* = Transform\(turns, .*$", text, re.M)
    space = {"Quaternion": Quaternion, "Transform": Transform, "deg": deg, "mm": mm, "y_goal": -300}
    exec(lines[-1], space)
    for name in names.split():
        mine = SHARED[{"aim": "right"}.get(name, name).upper()].as_matrix()
        assert np.allclose(space[name].as_matrix(), mine, rtol=0, atol=1e-15)
