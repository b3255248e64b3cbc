"""Exercise 2: the cases, the form of a speed, the law, and helpers for the wrong lines."""

from typing import Any

import numpy as np

from robokin import PUMA560, deg, distance_from_singularity
from robokin.course.forms import numbers
from robokin.course.told import apart

from .shared import HIGH, LOW, Floats, X, Y, Z


def cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    """Cases in which joints do not move, limits differ, the wrist is nearly aligned; then random
    ones.
    """
    even = np.full(6, 100.0) * deg
    uneven = np.array([80, 60, 100, 150, 120, 200]) * deg
    stand = np.array([0, 60, -170, 0, 40, 0]) * deg
    turned = np.array([20, 50, -150, 30, 40, -10]) * deg
    near = np.array([0, 60, -170, 30, 3, 0]) * deg
    made: list[tuple[Any, ...]] = [
        (stand, X, even),  # joints 1, 4 and 6 do not move
        (stand, Y, even),
        (turned, X, even),
        (turned, -Z, uneven),
        (turned, 3 * Y, uneven),
        (near, Y, uneven),
        (near, np.array([1.0, -2.0, 2.0]), uneven),
    ]
    while len(made) < 30:
        q = rng.uniform(LOW, HIGH).round(3)
        if distance_from_singularity(PUMA560, q) > 0.02:
            direction = (rng.normal(size=3) * rng.choice([0.2, 1, 5])).round(3)
            made.append((q, direction, (rng.integers(5, 26, 6) * 10 * deg).astype(float)))
    return made


def form(result: Any, case: tuple[Any, ...]) -> float:
    return float(numbers(result, (), "one number, a speed in m/s"))


def law(case: tuple[Any, ...], yours: float, wanted: float) -> str | None:
    """The correct speed, and the fraction of its limit at which a joint turns at your speed."""
    q, direction, most = case
    if abs(yours - wanted) <= 2e-3 * wanted:
        return None
    twist = [*(direction / np.linalg.norm(direction)), 0, 0, 0]
    share = abs(np.linalg.solve(PUMA560.jacobian(q), twist)) * wanted / most
    should, is_at = apart(wanted, yours, 4)
    says = f"should be {should} m/s: joint {int(share.argmax()) + 1} then turns at its limit"
    if not np.isfinite(yours) or yours <= 0:
        return says
    if yours > 100 * wanted:
        return f"{says}; {is_at} m/s is far too fast"
    used = apart(100 * yours / wanted, 100, 0)[0]  # all joints are scaled by the same factor
    return f"{says}; at {is_at} m/s it turns at {used} % of it"


def same(a: float, b: float) -> bool:
    """Whether two speeds agree to a millionth, however small they are."""
    both = a == b or (np.isnan(a) and np.isnan(b))
    return bool(both or abs(a - b) <= 1e-6 * abs(b))


def scaled_jacobian(q: Floats) -> Floats:
    """The Jacobian with lengths in units of the reach."""
    jacobian = PUMA560.jacobian(q)
    jacobian[:3] /= PUMA560.reach
    return jacobian
