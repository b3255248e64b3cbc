"""Cases, form and law of exercise 2; its text is in the Markdown file beside it, and its wrong
programs also use the helpers here.
"""

from typing import Any

import numpy as np

from robokin import IRB140, deg, follow, lin, nearest, quintic
from robokin.course.exercises import in_words
from robokin.course.told import apart, floats
from robokin.units import wrapped

from .shared import ROW, SLACK, TURN, Floats, into, short_end

__all__ = ["IRB140", "ROW", "into", "nearest", "quintic", "short_end", "wrapped"]
Case = tuple[Floats, Floats, Floats, Floats]
# of another arm, in which joints 1, 4 and 6 can take two values or three
OTHER = np.array([[-250, 250], [-60, 200], [-70, 170], [-360, 360], [-130, 130], [-300, 300]]) * deg
HOME = [10.0, 20.0, -40.0, 5.0, 30.0, 15.0]


def case(q0: Any, q1: Any, s: Any, limits: Floats = IRB140.limits) -> Case:
    return np.array(q0) * deg, np.array(q1) * deg, np.array(s, dtype=float), limits


def one_joint(
    joint: int, start: float, goal: float, middle: float = 0.5, limits: Floats = IRB140.limits
) -> Case:
    """A joint that moves alone, from start to goal in degrees."""
    q0 = np.array([0, 0, 0, 0, 30, 0.0])
    q1 = q0.copy()
    q0[joint - 1], q1[joint - 1] = start, goal
    return case(q0, q1, [0, middle, 1], limits)


def cases(rng: np.random.Generator) -> list[Case]:
    six = np.linspace(0, 1, 6)
    found = [
        case(HOME, [40, 20, -40, 5, 30, 15], six),  # joint 1 alone, nothing to choose
        case(HOME, [10, 20, -40, 5, 30, -170], six),  # joint 6 through 180
        one_joint(6, 170, -170),  # the short way over 180
        one_joint(6, -170, 170),
        one_joint(1, 170, -170),  # the short way is outside the limits
        one_joint(1, -170, 170),
        one_joint(4, 190, -175),  # joint 4: ±200
        one_joint(4, 190, -150),
        one_joint(4, -190, 150),
        one_joint(3, -150, 150),  # joint 3: -230 to 50
        one_joint(3, 20, 150),
        case([3, 5, -220, 2, 30, 4], [8, 5, 40, 2, 35, 9], [0, 0.5, 1]),
        one_joint(6, 350, -350),  # two turns
        one_joint(6, -350, 350),
        one_joint(6, 350, 60),  # 420 would be outside
        one_joint(6, -350, -60),
        one_joint(6, 350, -300),
        one_joint(6, 300, 20),  # 380 would be inside
        one_joint(6, -300, -20),
        case(HOME, HOME, [0, 0.5, 1]),  # the arm does not move
        case(HOME, [400, 380, 320, 365, 390, 375], [0, 0.5, 1]),  # all one turn further
        one_joint(6, 380, -340, 0.3),  # does not move, two turns further
        one_joint(6, 350, -710),  # three turns
        one_joint(6, -350, 710),
        one_joint(4, -190, -565),  # -205 would be outside
        one_joint(4, 190, 565),
        case(HOME, [-60, 50, -90, 170, -40, -100], [0.5]),
        case(HOME, [-60, 50, -90, -170, -40, 120], [0.2, 0.25, 0.9]),
        case([100, -30, -200, 190, 60, 370], [-160, 40, 170, -179, -60, 30], np.linspace(1, 0, 5)),
    ]
    found += [
        one_joint(1, 170, -170, limits=OTHER),  # the short way is inside here
        one_joint(2, 100, -170, limits=OTHER),  # 190
        one_joint(6, 250, -50, limits=OTHER),  # 310 is outside
        one_joint(4, 350, 10, limits=OTHER),  # 370 is outside
    ]
    found += [  # a joint without a value inside its limits; `nearest` moves it to one outside them
        one_joint(3, 20, 100),
        one_joint(3, -30, 190, limits=OTHER),
        case(HOME, [40, 150, -40, 5, 30, -170], six),
        case(HOME, [-60, -120, 130, -170, -160, 120], [0.2, 0.25, 0.9], OTHER),
    ]
    while len(found) < 48:
        limits = (IRB140.limits, OTHER)[len(found) % 2]
        low, high = limits.T
        q0 = rng.uniform(low, high).round(2)
        q1 = wrapped(rng.uniform(low, high).round(2))
        if (abs(abs(wrapped(q1 - q0)) - np.pi) > 0.05).all():  # not half a turn
            found.append((q0, q1, rng.uniform(0, 1, 7).round(3), limits))
    return found


def form(result: Any, case: Case) -> Floats:
    wanted = f"wanted joint values of shape ({len(case[2])}, 6)"
    try:
        values = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {in_words(result)}") from None
    if values.ndim not in (1, 2) or 6 not in values.shape:
        raise ValueError(f"{wanted}, got {values.shape}")
    return values


def law(case: Case, yours: Floats, wanted: Floats) -> str | None:
    q0, q1, s, limits = case
    if yours.shape != wanted.shape:
        return f"should have the shape {wanted.shape}: a row of six joint values for each s"
    wrong = ~np.isclose(yours, wanted, rtol=0, atol=1e-6, equal_nan=True)
    if not wrong.any():
        return None
    i = int(wrong.any(axis=0).argmax())
    k = int(wrong[:, i].argmax())
    ends = q0[i], short_end(q0, q1, limits)[i], *limits[i]
    a, b, low, high = (round(float(x) / deg, 1) + 0.0 for x in ends)
    if np.isnan(wanted[k, i]):
        return (
            f"joint {i + 1} has no value inside its limits of {low:g}° and {high:g}°: its column "
            f"should be NaN, but at s = {s[k]:.3g} it is at {yours[k, i] / deg:.1f}°"
        )
    at, is_at = apart(wanted[k, i] / deg, yours[k, i] / deg)
    return (
        f"joint {i + 1} should turn from {a:g}° to {b:g}° (its limits are {low:g}° and {high:g}°): "
        f"at s = {s[k]:.3g} it should be at {at}°, but is at {is_at}°"
    )


def same(a: Floats, b: Floats) -> bool:
    """Whether two results are equal; 180° equals -180°, since rounding decides between them."""
    if a.shape != b.shape:
        return False
    at_180 = (abs(abs(a) - np.pi) < 1e-6) & (abs(abs(b) - np.pi) < 1e-6)
    return bool(np.all(at_180 | np.isclose(a, b, rtol=0, atol=1e-6, equal_nan=True)))


# --- Helpers for the wrong programs ---------------------------------------------------------------


def straight(q0: Floats, end: Floats, s: Floats) -> Floats:
    motion: Floats = q0 + s[:, None] * (end - q0)
    return motion


def inside(q: Floats, limits: Floats) -> Any:
    low, high = limits.T
    return (q >= low - SLACK) & (q <= high + SLACK)


def one_turn_for_all(q0: Floats, q1: Floats) -> Floats:
    ends = [q1 + k * TURN for k in (0, -1, 1, -2, 2)]
    return min(ends, key=lambda end: float(abs(end - q0).sum()))


def one_turn_inside(q0: Floats, q1: Floats, limits: Floats) -> Floats:
    """The same number of turns for all joints, so that all are inside."""
    ends = [end for k in range(-4, 5) if inside(end := q1 + k * TURN, limits).all()]
    return min(ends, key=lambda end: float(abs(end - q0).sum()), default=q1)


def floored(q0: Floats, q1: Floats) -> Floats:
    return q1 + TURN * np.floor((q0 - q1) / TURN)


def nearest_or_q1(q0: Floats, q1: Floats, limits: Floats) -> Floats:
    """The nearest values where they are inside, q1 elsewhere."""
    near = wrapped(q1, q0)
    return np.where(inside(near, limits), near, q1)


def one_turn_back(q0: Floats, q1: Floats, limits: Floats) -> Floats:
    """The nearest values, one turn away where they are outside the limits."""
    near, (low, high) = wrapped(q1, q0), limits.T
    moved: Floats = near + TURN * (near < low - SLACK) - TURN * (near > high + SLACK)
    return moved


def down_then_up(q0: Floats, q1: Floats, limits: Floats) -> Floats:
    """The nearest values, moved below the upper limits and then above the lower ones."""
    near, (low, high) = wrapped(q1, q0), limits.T
    near = near - TURN * (near > high + SLACK)
    moved: Floats = near + TURN * (near < low - SLACK)
    return moved


def pinned(q0: Floats, q1: Floats, s: Floats, limits: Floats) -> Floats:
    end = short_end(q0, q1, limits)
    motion = straight(q0, end, s)
    motion[0], motion[-1] = q0, end
    return motion


def line(q0: Floats, q1: Floats, s: Floats, row: int | None = None) -> Floats:
    """The joint values on a straight line in space."""
    rows = IRB140.ik(lin(IRB140.fk(q0), IRB140.fk(q1), s))
    first = abs(wrapped(rows[0] - q0)).sum(axis=-1)
    return follow(IRB140, rows, int(first.argmin()) if row is None else row)
