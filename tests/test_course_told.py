"""Numbers that are read from answers and written into sentences."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robokin import Transform
from robokin.course import book, check
from robokin.course.function import Function
from robokin.course.told import apart, floats, one_number

numbers = st.floats(-1e4, 1e4)


@given(numbers, numbers)
def test_different_numbers_print_differently(a, b):
    one, two = apart(a, b, 1)
    if abs(a - b) > 1e-11:
        assert one != two
    assert len(one.partition(".")[2]) >= 1 and abs(float(one) - a) <= 0.0500001
    assert abs((float(one) - float(two)) - (a - b)) <= 1.1 * 10.0 ** -len(one.partition(".")[2])


def test_rows_are_printed_with_enough_digits_to_differ():
    assert apart([0.766, 0.643, 0], [0.766, 0.6430004, 0], 3) == (
        "0.7660000, 0.6430000, 0.0000000",
        "0.7660000, 0.6430004, 0.0000000",
    )
    assert apart(0.24, 0.2404, 2) == ("0.2400", "0.2404")
    assert apart(0.5, 0.5, 2) == ("0.50", "0.50")
    assert apart(2, 3, 0) == ("2", "3") and apart(-0.0001, 3, 1) == ("0.0", "3.0")


def test_huge_and_missing_numbers_are_printed_readably():
    assert apart(0.5, 1.489e31, 3) == ("0.500", "1.5 · 10³¹")
    assert apart(np.nan, np.inf) == ("nan", "inf")


@pytest.mark.parametrize("value", ["0.3", ["0.3", 1], True, [None], {}, b"1", [object()], "x", 1j])
def test_values_that_are_not_numbers_are_refused(value):
    with pytest.raises((TypeError, ValueError)):
        floats(value)


def test_numbers_of_any_kind_become_floats():
    assert floats([1, 2.5]).tolist() == [1, 2.5] and floats(np.float32(0.5)) == 0.5
    assert one_number([[3]]) == 3 and floats([1 + 0j, np.nan]).dtype == float
    with pytest.raises(ValueError, match="one number"):
        one_number([1, 2])


FUNCTIONS = [
    f"{lab}.{n}"
    for lab in book.labs()
    for n, exercise in book.lab(lab).exercises.items()
    if isinstance(exercise, Function)
]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_strings_instead_of_numbers_are_reported_as_the_wrong_kind(name):
    exercise = book.find(name, "exercises")

    def right(*case):
        result = exercise.right(*case)
        return exercise.form(result, case, result)

    def in_text(*case):
        result = right(*case)
        numbers = result.as_matrix() if isinstance(result, Transform) else np.asarray(result)
        return np.asarray(numbers, dtype=float).astype(str).tolist()

    if not isinstance(right(*exercise.cases[0]), (str, bool)):
        assert check(name, in_text).mistake == "another kind or shape"


@pytest.mark.parametrize(
    ("name", "answer"),
    [
        ("irb140_kinematics.3", {"height": "0.3", "flags": (1, 1, 1), "duration": 3}),
        ("scara_kinematics.2", {"distance": 0.3, "elbow": 1, "angle": "0.1"}),
        ("scara_motion.3", {"blend": "0.2", "duration": 3}),
        ("spherical_wrist.3", {"up": 0.01, "side": "0.01", "duration": 2}),
        ("puma560_branches.3", {"row": 1, "duration": "3"}),
        (
            "visit_and_collect.3",
            dict.fromkeys(("visit", "collect", "worth"), [["1", "2", "3"]] * 4),
        ),
        ("three_levers.3", {"first": "2", "second": 2}),
        ("obstacle_avoidance.2", ([["1", "2", "2"], ["1", "1", "1"]], [[1, 1], [2, 1]])),
        (
            "motor_synchronisation.2",
            {"gears": ["9", "9", "9"], "pulses": np.ones((3, 3)), "frequencies": [1, 2, 3]},
        ),
    ],
)
def test_string_instead_of_a_number_in_a_design_is_reported_as_the_wrong_kind(name, answer):
    verdict = check(name, answer, who="Ada")
    assert verdict.mistake == "another kind or shape" and verdict.answered
