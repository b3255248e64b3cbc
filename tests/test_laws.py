"""Time laws: they start at 0, reach 1 at the end, and have the documented smoothness."""

import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from machines import SHAPES
from scipy.interpolate import BPoly

from robokin import TimeLaw, linear, quintic, trapezoidal

LAWS = [linear, trapezoidal, quintic, lambda T: trapezoidal(T, 0.5), lambda T: trapezoidal(T, 0.01)]
laws = pytest.mark.parametrize(
    "law", LAWS, ids=["linear", "trapezoidal", "quintic", "triangle", "steep"]
)


@laws
@pytest.mark.parametrize("duration", [1e-3, 1, 20.0, 1e6])
def test_laws_rise_monotonically_from_0_to_1(law, duration):
    s = law(duration)(np.linspace(0, duration, 5001))
    assert s[0] == 0 and s[-1] == 1
    assert (np.diff(s) > -1e-15).all() and (np.diff(s)[1:-1:50] > 0).all()
    assert s.min() >= 0 and s.max() <= 1
    assert abs(law(duration)(duration / 2) - 0.5) < 1e-15
    # the deceleration mirrors the acceleration
    assert np.allclose(s + s[::-1], 1, rtol=0, atol=1e-14)


@laws
def test_rounding_near_the_end_never_exceeds_1(law):
    t = 3.3 - np.concatenate([np.arange(20_000) * 4e-16, np.linspace(0, 1e-3, 100_001)])
    assert law(3.3)(t).max() <= 1


@laws
def test_laws_are_constant_before_and_after_the_motion(law):
    assert law(2.0)(np.array([-1e9, -1e-9, 2.0, 2.1, 1e9])).tolist() == [0, 0, 1, 1, 1]


@laws
@pytest.mark.parametrize("shape", SHAPES)
def test_laws_keep_the_shape_of_the_times(law, shape):
    t = np.random.default_rng(30).uniform(0, 3, shape)
    s = law(3.0)(t)
    assert np.shape(s) == shape
    assert np.allclose(np.ravel(s), [law(3.0)(one) for one in np.ravel(t)], rtol=0, atol=1e-16)


def test_linear_law_returns_the_elapsed_fraction_of_the_duration():
    t = np.linspace(0, 7, 50)
    assert np.allclose(linear(7.0)(t), t / 7, rtol=0, atol=1e-16)


def test_quintic_is_the_polynomial_that_starts_and_ends_at_rest():
    """SciPy finds the only polynomial of degree 5 with s, s', s'' = 0, 0, 0 at the start and
    1, 0, 0 at the end.
    """
    reference = BPoly.from_derivatives([0, 8], [[0, 0, 0], [1, 0, 0]])
    t = np.linspace(0, 8, 1001)
    assert np.allclose(quintic(8.0)(t), reference(t), rtol=0, atol=2e-15)
    assert abs(reference.derivative()(4.0) - 1.875 / 8) < 1e-15  # its greatest speed


@pytest.mark.parametrize("ramp", [0.01, 0.1, 0.25, 0.5])
def test_trapezoidal_is_the_integral_of_a_trapezoid(ramp):
    law, x = trapezoidal(1.0, ramp), np.linspace(0, 1, 200_001)
    speed = np.minimum(np.minimum(x, 1 - x) / ramp, 1) / (1 - ramp)
    area = np.concatenate([[0], np.cumsum((speed[1:] + speed[:-1]) / 2)]) * (x[1] - x[0])
    assert np.allclose(law(x), area, rtol=0, atol=1e-9)


def derivative_jumps(law, at, order, h):
    """The jump of a derivative at a given time, from samples on either side."""
    weights = {1: [-1.5, 2, -0.5], 2: [2, -5, 4, -1]}[order]
    k = np.arange(len(weights)) * h
    after = np.dot(weights, law(at + k)) / h**order
    before = np.dot(weights, law(at - k)) / h**order * (-1) ** order
    return after - before


@pytest.mark.parametrize(
    "law, order, times, jump",
    [
        (linear(4.0), 1, [0, 4], 0.25),
        (trapezoidal(4.0), 1, [0, 1, 3, 4], 0),
        # the jump is the cruising speed divided by the duration of a ramp
        (trapezoidal(4.0), 2, [0, 1, 3, 4], 1 / 0.75 / 4 / 1.0),
        (quintic(4.0), 1, [0, 4], 0),
        (quintic(4.0), 2, [0, 4], 0),
    ],
)
def test_laws_have_the_documented_smoothness(law, order, times, jump):
    for at in times:
        jumps = [abs(derivative_jumps(law, at, order, h)) for h in (1e-2, 1e-3)]
        assert abs(jumps[1] - jump) < 1e-5 and abs(jumps[0] - jump) < 1e-2


@settings(max_examples=80, deadline=None)
@given(
    st.floats(1e-3, 0.5),
    st.floats(0.01, 100),
    st.lists(st.floats(-1, 200), min_size=2, max_size=20),
)
def test_every_trapezoidal_law_rises_from_0_to_1(ramp, duration, times):
    s = trapezoidal(duration, ramp)(np.sort(times))
    assert (np.diff(s) >= -1e-15).all() and (s >= 0).all() and (s <= 1).all()


def test_laws_store_their_duration():
    for law in LAWS:
        assert law(20).duration == 20 and isinstance(law(20), TimeLaw)


@laws
def test_laws_can_be_pickled(law):
    t = np.linspace(-1, 9, 101)
    again = pickle.loads(pickle.dumps(law(8.0)))
    assert again.duration == 8 and (again(t) == law(8.0)(t)).all()


def test_custom_law_is_a_function_of_the_fraction_of_time():
    law = TimeLaw(4, lambda x: x**2)
    assert law([-1, 0, 1, 2, 4, 5]).tolist() == [0, 0, 1 / 16, 1 / 4, 1, 1]
    assert TimeLaw(4, lambda x: 3 * x - 1)([0, 2, 4]).tolist() == [0, 0.5, 1]  # clipped to [0, 1]


@pytest.mark.parametrize("progress", [None, 3, "linear", [0, 1]])
def test_progress_of_a_custom_law_must_be_callable(progress):
    with pytest.raises(TypeError, match="progress: wanted a function, got"):
        TimeLaw(2, progress)


@pytest.mark.parametrize(
    "progress, message",
    [
        (lambda x: "fast", "progress: wanted numbers"),
        (lambda x: None, "progress: wanted numbers"),
        (lambda x: x * np.nan, "progress: wanted finite"),
        (lambda x: 0.5, r"progress: wanted s of shape \(3,\), got shape \(\)"),
        (lambda x: x[:2], r"progress: wanted s of shape \(3,\), got shape \(2,\)"),
    ],
)
def test_results_of_the_progress_function_are_checked(progress, message):
    with pytest.raises(ValueError, match=message):
        TimeLaw(2, progress)([0, 1, 2])


@pytest.mark.parametrize("duration", [1e-320, 1e-300, 1e300])
def test_extreme_durations_work(duration):
    for law in LAWS:
        with np.errstate(all="raise", under="ignore"):
            assert law(duration)([0.0, duration, 1e308]).tolist() == [0, 1, 1]


@pytest.mark.parametrize("ramp", [1e-300, 1e-320])
def test_very_short_ramps_work(ramp):
    with np.errstate(all="raise", under="ignore"):
        s = trapezoidal(1.0, ramp)(np.linspace(0, 1, 11))
    assert np.allclose(s, np.linspace(0, 1, 11), rtol=0, atol=1e-15)


@pytest.mark.parametrize("wrong", [0, -1, 0.6, np.nan, "half", [0.1, 0.2], None])
def test_ramp_is_at_most_one_half(wrong):
    with pytest.raises(ValueError, match="ramp: wanted"):
        trapezoidal(1.0, wrong)
