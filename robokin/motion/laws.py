"""Time laws: how far a motion is along its path at time t. `law(t)` returns s in [0, 1]."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from .._arrays import ArrayLike, Floats, Sealed
from .._validate import floats, positive, short

RAMP = "a number above 0 and at most 0.5"


@dataclass(frozen=True, eq=False)
class TimeLaw(Sealed):
    """s(t) over `duration` seconds: 0 before the motion, 1 after it.

    `progress` maps t / duration, an array of numbers in [0, 1], to s of the same shape. A law can
    be pickled if its `progress` can (a module-level function can, a lambda cannot). Raises
    TypeError if `progress` is not callable.
    """

    duration: float
    progress: Callable[[Floats], Floats]

    def __post_init__(self) -> None:
        duration = positive(self.duration, "duration", "one positive number of seconds")
        if not callable(self.progress):
            raise TypeError(f"progress: wanted a function, got {short(self.progress)}")
        vars(self)["duration"] = duration

    def __call__(self, t: ArrayLike) -> Floats:
        """Return s at the times t (...) in seconds. Raises ValueError if there are no times, a time
        is not finite, or `progress` returns another shape or anything other than numbers.
        """
        t = floats(t, "t")
        if not t.size:
            raise ValueError("t: wanted times, got an empty array")
        s = floats(
            self.progress(np.minimum(np.maximum(t, 0.0), self.duration) / self.duration), "progress"
        )
        if s.shape != t.shape:
            raise ValueError(f"progress: wanted s of shape {t.shape}, got shape {s.shape}")
        return np.minimum(np.maximum(s, 0.0), 1.0)  # a polynomial near 1 may round to more than 1


def linear(duration: float) -> TimeLaw:
    """Constant speed: s = t / T. The speed jumps at both ends. Source: 001, listing 7."""
    return TimeLaw(duration, _linear)


def trapezoidal(duration: float, ramp: float = 0.25) -> TimeLaw:
    """Constant acceleration, constant speed, constant deceleration. Each ramp takes the fraction
    `ramp` of the duration, above 0 and at most 0.5. The acceleration jumps. Source: Siciliano et
    al., Robotics, 2009, section 4.2.1.
    """
    share = positive(ramp, "ramp", RAMP)
    if share > 0.5:
        raise ValueError(f"ramp: wanted {RAMP}, got {short(ramp)}")
    return TimeLaw(duration, partial(_trapezoidal, share))


def quintic(duration: float) -> TimeLaw:
    """s = 10 x^3 - 15 x^4 + 6 x^5 with x = t / T: speed and acceleration are zero at both ends.
    Source: Craig, Introduction to Robotics, section 7.3 (quintic polynomials).

    >>> law = quintic(duration=4)
    >>> law([0, 1, 2, 3, 4]).round(4)
    array([0.    , 0.1035, 0.5   , 0.8965, 1.    ])
    """
    return TimeLaw(duration, _quintic)


# These are module-level functions, so that a law can be pickled.


def _linear(x: Floats) -> Floats:
    return x


def _trapezoidal(ramp: float, x: Floats) -> Floats:
    peak = 1 / (1 - ramp)  # the speed between the ramps: the area under the speed curve is 1
    left = np.minimum(x, 1 - x)  # time to the nearer end: the two halves are symmetric
    on_ramp = np.minimum(left, ramp)
    s: Floats = peak * (on_ramp * on_ramp / (2 * ramp) + (left - on_ramp))
    return np.where(x > 0.5, 1 - s, s)


def _quintic(x: Floats) -> Floats:
    return x**3 * (10 + x * (6 * x - 15))
