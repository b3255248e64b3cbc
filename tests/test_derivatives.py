"""`differentiate`, compared with polynomials, whose derivatives are known."""

import numpy as np
import pytest

from robokin import differentiate

RNG = np.random.default_rng(31)


def uneven(n):
    return np.cumsum(RNG.uniform(0.5, 1.5, n)) * 0.1


@pytest.mark.parametrize(
    "t",
    [np.linspace(-1, 2, 40), uneven(40), np.array([0.0, 0.5, 2.0])],
    ids=["even", "uneven", "three"],
)
def test_derivatives_of_quadratics_are_exact_even_at_the_ends(t):
    a, b, c = RNG.normal(size=(3, 6))
    values = a + b * t[:, None] + c * t[:, None] ** 2
    assert np.allclose(differentiate(values, t), b + 2 * c * t[:, None], rtol=0, atol=1e-12)
    assert np.allclose(
        differentiate(values, t, 2), np.broadcast_to(2 * c, values.shape), rtol=0, atol=1e-9
    )
    assert np.allclose(differentiate(values, t, order=3), 0, rtol=0, atol=1e-6)


@pytest.mark.parametrize("order, exact", [(1, np.cos), (2, lambda t: -np.sin(t))])
def test_error_is_quadratic_in_the_step(order, exact):
    errors = []
    for n in (101, 201, 401):
        t = np.linspace(0, 3, n)
        error = abs(differentiate(np.sin(t), t, order) - exact(t))
        errors.append([error[3:-3].max(), error.max()])
    inner = [errors[i][0] / errors[i + 1][0] for i in (0, 1)]
    outer = [errors[i][1] / errors[i + 1][1] for i in (0, 1)]
    assert all(abs(ratio - 4) < 0.2 for ratio in inner)
    # the second derivative at the ends is one order less accurate
    assert all(ratio > (3.8 if order == 1 else 1.8) for ratio in outer)


@pytest.mark.parametrize("shape", [(), (3,), (2, 1, 3)])
def test_batches_are_differentiated_along_their_samples(shape):
    t = uneven(30)
    values = RNG.normal(size=(*shape, 30, 4))
    v = differentiate(values, t)
    assert v.shape == values.shape
    for i in np.ndindex(*shape):
        for j in range(4):
            assert np.allclose(v[i][:, j], differentiate(values[i][:, j], t), rtol=0, atol=1e-12)
    assert differentiate(values[..., 0].reshape(-1, 30)[0], t).shape == (30,)


@pytest.mark.parametrize(
    "t", [np.arange(20.0), np.linspace(0, 1, 20), uneven(20)], ids=["whole", "even", "uneven"]
)
def test_nan_affects_only_neighbouring_samples(t):
    values = np.stack([t**2, 3 * t], axis=-1)
    values[10, 0] = np.nan
    for order, missing in ((1, [9, 10, 11]), (2, [8, 9, 10, 11, 12])):
        v = differentiate(values, t, order)
        assert np.flatnonzero(np.isnan(v[:, 0])).tolist() == missing
        assert np.isfinite(v[:, 1]).all()
        rest = np.delete(np.arange(20), missing)
        assert np.allclose(v[rest, 0], 2 * t[rest] if order == 1 else 2, rtol=0, atol=1e-9)


def test_angles_are_not_unwrapped():
    """A wrapped angle gives a spike; `follow` unwraps angles (errata S1-e)."""
    t = np.linspace(0, 1, 101)
    wrapped = (6 * t + np.pi) % (2 * np.pi) - np.pi
    assert abs(differentiate(wrapped, t)).max() > 250
    assert np.allclose(differentiate(np.unwrap(wrapped), t), 6, rtol=0, atol=1e-9)


def test_input_is_not_changed():
    values, t = np.arange(5.0), np.arange(5.0)
    differentiate(values, t)
    assert values.tolist() == t.tolist() == [0, 1, 2, 3, 4]


def test_order_above_10_is_refused_with_a_reason():
    values, t = RNG.normal(size=(30, 4)), uneven(30)
    assert np.isfinite(differentiate(values, t, 10)).all()
    for order in (11, 10**6, 10**400):
        with pytest.raises(ValueError, match=r"order: wanted at most 10, got .*120 numbers"):
            differentiate(values, t, order)
    for order in (0, -1, 1.5, True, "2", None):
        with pytest.raises(ValueError, match="order: wanted a whole number of at least 1"):
            differentiate(values, t, order)


@pytest.mark.parametrize("t", [np.arange(5.0) * 1e-10, np.array([0, 1, 3, 4, 9]) * 1e-200])
def test_overflowing_slopes_are_refused(t):
    values = np.array([0, 1e300, -1e300, 1e300, 0])
    with pytest.raises(ValueError, match="slopes"):
        differentiate(values, t)
    with pytest.raises(ValueError, match="slopes"):
        differentiate(values / 1e10, t, 3)


def test_two_samples_are_refused():
    with pytest.raises(ValueError, match=r"at least three times, got shape \(2,\)"):
        differentiate([1, 2], [0, 1])
    assert differentiate([1, 2, 5], [0, 1, 2]).tolist() == [0, 2, 4]
    for t in ([0, 1, 1], [0, 2, 1]):
        with pytest.raises(ValueError, match="increasing"):
            differentiate([1, 2, 5], t)
