"""Cases, form and law of exercise 1, and helpers for its wrong lines; its text is in the Markdown
file beside it.
"""

import math
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from robokin.course.exercises import in_words
from robokin.course.told import apart, floats

from .shared import Floats

Case: TypeAlias = tuple[Any, ...]
ROUNDING = 1e-9  # as a fraction of the reach
NONE = np.array([np.nan, np.nan])


@dataclass(frozen=True)
class Place:
    """An answer: a point, and whether one exists in this case. If none exists, all points are the
    same mistake.
    """

    x: float
    y: float
    exists: bool

    @property
    def found(self) -> bool:
        """Whether it is a point. Where one exists, infinity (1 / 0) is as wrong as NaN (0 / 0)."""
        if self.exists:
            return math.isfinite(self.x) and math.isfinite(self.y)
        return not math.isnan(self.x)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        return np.array([self.x, self.y])

    def __repr__(self) -> str:
        return in_words(np.array(self))


def case(base: Any, tip: Any, l1: float, l2: float, side: int) -> Case:
    return np.array(base, dtype=float), np.array(tip, dtype=float), l1, l2, side


def cases(rng: np.random.Generator) -> list[Case]:
    found = [
        case([0, 0], [1.2, 0.7], 1.0, 0.8, +1),
        case([0, 0], [1.2, 0.7], 1.0, 0.8, -1),
        case([0.2, -0.1], [1.3, 0.6], 1.0, 0.7, +1),
        case([0.2, -0.1], [1.3, 0.6], 1.0, 0.7, 0),  # between both elbows
        case([0, 0], [0, 1.1], 1.0, 0.7, +1),  # straight up: dx = 0
        case([0, 0], [0, 1.1], 1.0, 0.7, -1),
        case([0, 0], [0, -1.1], 0.7, 1.0, +1),
        case([0, 0], [-0.9, 0.3], 0.6, 0.9, +1),  # to the left of the base
        case([0, 0], [-0.9, 0.3], 0.6, 0.9, -1),
        case([0, 0], [-0.5, -0.8], 0.9, 0.5, +1),
        case([0, 0], [1.1, 0], 1.0, 0.7, +1),  # level: dy = 0
        case([0, 0], [-1.1, 0], 0.7, 1.0, -1),
        case([-0.4, 0.3], [-0.4, 1.5], 0.8, 0.9, -1),
        case([0, 0], [0.2, 0.4], 0.6, 1.0, +1),  # the line through the elbows is behind the base
        case([0, 0], [1.2, 0.9], 0.8, 0.5, +1),  # beyond the outer edge
        case([0, 0], [0.1, 0.1], 1.0, 0.7, -1),  # inside the inner edge
        case([0, 0], [0, 1.1], 0.7, 1.0, 0),
        case([0.1, 0.2], [1.9, 1.4], 1.0, 0.7, 0),  # out of reach, where only this point exists
        case([0.3, 0.1], [0.3, 2.4], 0.9, 0.6, 0),
        case([0, 0], [0.1, -0.2], 1.0, 0.7, 0),  # too near
        case([0, 0], [-0.2, 0.1], 0.6, 1.0, 0),
        case([0.5, -0.2], [-1.4, 0.9], 0.9, 0.9, -1),
    ]
    more, less = 1.7 * (1 + 1e-10), 0.3 * (1 - 1e-10)  # past the rims by rounding alone
    for turn in (0.0, 0.7, 2.3, -2.9):  # stretched, and folded back
        way = np.array([np.cos(turn), np.sin(turn)])
        found.append(case([0.1, 0.2], np.array([0.1, 0.2]) + more * way, 1.0, 0.7, +1))
        found.append(case([0, 0], less * way, 1.0, 0.7, -1))
    found.append(case([0, 0], [1.699, 0.0], 1.0, 0.7, +1))  # 1 mm inside the rim; then 2 mm outside
    found.append(case([0, 0], [0.0, 1.702], 1.0, 0.7, +1))
    found.append(case([0, 0], [0.298, 0.0], 1.0, 0.7, +1))
    # 3 micrometres outside; then inside
    found.append(case([0, 0], [1.7 * (1 + 2e-6), 0], 1.0, 0.7, +1))
    found.append(case([0, 0], [0, 1.7 * (1 - 2e-6)], 1.0, 0.7, +1))
    # within a micrometre of the rim
    found.append(case([0, 0], [1.7 * (1 + 1e-7), 0], 1.0, 0.7, +1))
    found.append(case([0, 0], [1.7e-3 * (1 + 1e-7), 0], 1e-3, 0.7e-3, +1))  # a small arm
    found.append(case([0, 0], [0.1, 0.1], 0.7, 1.0, +1))  # too near, the second link longer
    found.append((np.array([0, 0]), np.array([1, 1]), 1, 1.2, -1))  # whole numbers
    return found + [drawn(rng) for _ in range(50 - len(found))]


def drawn(rng: np.random.Generator) -> Case:
    base, l1, l2 = rng.uniform(-1, 1, 2), *rng.uniform(0.4, 1.2, 2)
    turn, share = rng.uniform(-np.pi, np.pi), rng.uniform(0.1, 0.9)
    d = abs(l1 - l2) + share * (l1 + l2 - abs(l1 - l2))
    tip = base + d * np.array([np.cos(turn), np.sin(turn)])
    side = int(1 - 2 * rng.integers(2))
    return case(base.round(3), tip.round(3), round(l1, 3), round(l2, 3), side)


def exists(case: Case) -> bool:
    base, tip, l1, l2, side = case
    d, slack = float(np.hypot(*(tip - base))), ROUNDING * (l1 + l2)
    return side == 0 or bool(abs(l1 - l2) - slack <= d <= l1 + l2 + slack)


def form(result: Any, case: Case) -> Place:
    wanted = "wanted one point [x, y], with NaN twice where there is none"
    try:
        values = np.squeeze(floats(result))
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {in_words(result)}") from None
    if values.shape == () and np.isnan(values):
        values = NONE
    if values.shape == (3,) and values[2] == 0:
        values = values[:2]
    if values.shape != (2,):
        raise ValueError(f"{wanted}, got {in_words(result)}")
    if np.isnan(values).any():
        values = NONE
    return Place(float(values[0]), float(values[1]), exists(case))


def law(case: Case, yours: Place, wanted: Place) -> str | None:
    base, tip, l1, l2, side = case
    d = float(np.hypot(*(tip - base)))
    if not yours.exists:
        if not yours.found:
            return None
        far = d > l1 + l2
        is_at, rim = apart(d, l1 + l2 if far else abs(l1 - l2), 3)
        return (
            f"should be NaN twice: the tip is {is_at} m from the base, and the arm reaches "
            f"{'out' if far else 'in'} to {rim} m"
        )
    mine = np.array(yours)
    if np.linalg.norm(mine - np.array(wanted)) <= 1e-6:
        return None
    one, two = np.hypot(*(mine - base)), np.hypot(*(mine - tip))
    if side == 0:
        return (
            f"should be {wanted}, where the line through both elbows crosses the line from base to "
            f"tip; this point exists even if the tip is out of reach"
        )
    name = "right" if side > 0 else "left"
    says = f"should be {wanted}, {l1:.4g} m from the base and {l2:.4g} m from the tip"
    if not yours.found:
        low, high = abs(l1 - l2), l1 + l2
        if low <= d <= high:
            return (
                f"{says}; the tip is {d:.9g} m away, and the arm reaches from {low:.4g} m to "
                f"{high:.4g} m"
            )
        which, (is_at, rim) = (
            ("outer", apart(d, high, 3)) if d > high else ("inner", apart(d, low, 3))
        )
        return (
            f"{says}; the tip is {is_at} m away (the case is rounded), and the {which} rim is at "
            f"{rim} m: treat it as if it were on the rim"
        )
    if abs(one - l1) < 1e-6 and abs(two - l2) < 1e-6:
        return f"{says}, to the {name} of the line from base to tip; yours is on the other side"
    (_, from_base), (_, from_tip) = apart(l1, one, 3), apart(l2, two, 3)
    return f"{says}; yours is {from_base} m and {from_tip} m from them"


def same(a: Place, b: Place) -> bool:
    if a.exists != b.exists or a.found != b.found:
        return False
    near = np.allclose(np.array(a), np.array(b), rtol=0, atol=1e-6)
    return not a.found or not a.exists or bool(near)


# --- Helpers for the wrong lines ------------------------------------------------------------------


def polar(length: float, direction: float) -> Floats:
    return length * np.array([np.cos(direction), np.sin(direction)])


def on_the_rim(a: float, d: float, l1: float, l2: float) -> float:
    """The fraction a, or the end of link 1 as a fraction of d if the tip is out of reach."""
    if d > l1 + l2:
        return l1 / d
    return a if d > abs(l1 - l2) else float(np.copysign(l1 / d, l1 - l2))


def strict_root(h2: float) -> float:
    """The square root, which raises an error below 0."""
    return math.sqrt(h2)


def close(h2: float, d: float, l1: float, l2: float) -> float:
    """The square root, with np.isclose for the rim."""
    if np.isclose(d, l1 + l2) or np.isclose(d, abs(l1 - l2)):
        return 0.0
    return float(np.sqrt(max(h2, 0))) if abs(l1 - l2) <= d <= l1 + l2 else math.nan


def like(base: Any, elbow: Floats) -> Any:
    """The elbow, written into an array with the type of the base."""
    made = np.zeros_like(base)
    made[:] = elbow
    return made


def angles(base: Floats, elbow: Floats, tip: Floats) -> Floats:
    one, two = elbow - base, tip - elbow
    q1 = np.arctan2(one[1], one[0])
    q2 = np.remainder(np.arctan2(two[1], two[0]) - q1 + np.pi, 2 * np.pi) - np.pi
    return np.array([q1, q2])
