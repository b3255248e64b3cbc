"""Time laws: how far along its path a motion is at time t. `law(t)` gives s in [0, 1]."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .._validate import floats


@dataclass(frozen=True, eq=False)
class TimeLaw:
    """s(t) over `duration` seconds: 0 before the motion, 1 after it. `progress` maps t / duration
    to s.
    """

    duration: float
    progress: Callable

    def __post_init__(self):
        duration = floats(self.duration, "duration")
        if duration.shape or duration <= 0:
            raise ValueError(
                f"duration: wanted one positive number of seconds, got {self.duration!r}"
            )
        object.__setattr__(self, "duration", float(duration))

    def __call__(self, t):
        """s at the times t (...) in seconds. ValueError: no times, not finite."""
        t = floats(t, "t")
        if not t.size:
            raise ValueError("t: wanted times, got an empty array")
        # a polynomial near 1 rounds beyond it
        return np.clip(self.progress(np.clip(t / self.duration, 0, 1)), 0, 1)


def linear(duration):
    """Constant speed: s = t / T. The speed jumps at both ends. Source: 001, listing 7."""
    return TimeLaw(duration, lambda x: x)


def trapezoidal(duration, ramp=0.25):
    """Constant acceleration, constant speed, constant braking; each ramp takes the share `ramp` of
    the duration, above 0 and at most 0.5. The acceleration jumps. Source: Siciliano et al.,
    Robotics, 2009, section 4.2.1.
    """
    share = floats(ramp, "ramp")
    if share.shape or not 0 < share <= 0.5:
        raise ValueError(f"ramp: wanted a number above 0 and at most 0.5, got {ramp!r}")
    ramp = float(share)
    peak = 1 / (1 - ramp)  # the cruising speed, so that the area is 1

    def progress(x):
        up, down = peak * x**2 / (2 * ramp), 1 - peak * (1 - x) ** 2 / (2 * ramp)
        return np.where(x < ramp, up, np.where(x > 1 - ramp, down, peak * (x - ramp / 2)))

    return TimeLaw(duration, progress)


def quintic(duration):
    """s = 10 x^3 - 15 x^4 + 6 x^5 with x = t / T: speed and acceleration are zero at both ends.
    Source: Craig, Introduction to Robotics, section 7.3 (quintic polynomials).
    """
    return TimeLaw(duration, lambda x: x**3 * (10 + x * (6 * x - 15)))
