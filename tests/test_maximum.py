"""`refined_maximum`, tested with functions whose maximum is known."""

import numpy as np
import pytest

from robokin import Quaternion, Transform, blend, deg, quintic
from robokin.motion import Maximum, refined_maximum

KNOWN = {
    "sine": (np.sin, 0.3, 2.9, 1.0),
    "narrow": (lambda x: 1 / (1 + (50 * (x - 0.4321)) ** 2), 0.0, 1.0, 1.0),
    "corner": (lambda x: -abs(x - np.sqrt(0.5)), 0.0, 1.0, 0.0),
    "at the end": (np.exp, -1.0, 2.0, np.exp(2)),
    "two peaks": (lambda x: np.sin(7 * x) + 1e-3 * x, 0.0, 2.0, None),
    "flat": (lambda x: 0 * x - 3, 0.0, 2.0, -3.0),
    "partly NaN": (lambda x: np.where(x < 1.5, x * (2 - x), np.nan), 0.0, 2.0, 1.0),
}


@pytest.mark.parametrize("decimals", [0, 1, 3, 5])
@pytest.mark.parametrize("function, low, high, most", KNOWN.values(), ids=KNOWN)
def test_maximum_is_accurate_to_two_more_digits_than_shown(function, low, high, most, decimals):
    if most is None:  # the later peak, where 7 cos 7x = -0.001
        x = (2 * np.pi + np.arccos(-1e-3 / 7)) / 7
        most = np.sin(7 * x) + 1e-3 * x
    found = refined_maximum(function, low, high, decimals)
    assert isinstance(found, Maximum) and low <= found.at <= high
    assert found.value == function(np.array([found.at]))[0] <= most + 1e-15
    assert most - found.value < 10.0 ** -(decimals + 2)


def test_minimum_is_the_maximum_of_the_negative():
    via = Transform(Quaternion.from_angle_axis(45 * deg, np.eye(3)[1]), (0.65, -0.1, 0.8))
    ends = [Transform(translation=p) for p in ((0.2, 0.4, 0.2), (0.3, 0.3, 0.5))]

    def apart(t):
        path = blend(ends[0], via, ends[1], 0.2, quintic(5)(t))
        return np.linalg.norm(path.translation - via.translation, axis=-1)

    found = refined_maximum(lambda t: -apart(t), 0, 5, 4)
    assert -found.value == pytest.approx(apart(np.linspace(2, 3, 1_000_001)).min(), abs=1e-6)
    assert -found.value < apart(np.linspace(0, 5, 240)).min() - 1e-5  # the samples miss the minimum


@pytest.mark.parametrize(
    "call, kind, message",
    [
        ((1.0, 0, 1, 2), TypeError, "function: wanted a function, got 1.0"),
        ((np.sin, 1, 1, 2), ValueError, "wanted low < high, got 1 and 1"),
        ((np.sin, 0, np.inf, 2), ValueError, "high: wanted finite"),
        ((np.sin, 0, 1, -1), ValueError, "decimals: wanted a whole number"),
        ((lambda x: x[:-1], 0, 1, 2), ValueError, r"wanted shape \(65,\), got \(64,\)"),
        ((lambda x: x * np.nan, 0, 1, 2), ValueError, "wanted at least one value, got only NaN"),
        (
            (lambda x: -np.log(abs(x - np.sqrt(0.5)) + 1e-300), 0, 1, 2),
            ValueError,
            "wanted one for which the search converges",
        ),
    ],
)
def test_errors_name_the_invalid_argument_and_say_what_is_wanted(call, kind, message):
    with pytest.raises(kind, match=message):
        refined_maximum(*call)
