"""Exercise 1: the cases, the form of a name, the law, and helpers for the wrong lines."""

import re
from typing import Any

import numpy as np

from robokin import PUMA560, deg, mm
from robokin.course.exercises import in_words

from .shared import FORE, HIGH, LOW, OFFSET, UPPER, Floats

PAIRS = ({"RIGHTY", "LEFTY"}, {"ABOVE", "BELOW"}, {"FLIP", "NOFLIP"})
SIMPLE = (  # degrees
    (0, 60, -170, 0, 40, 0),
    (0, 60, -170, 0, -40, 0),
    (0, 120, -10, 0, 40, 0),
    (120, 60, -170, 0, 40, 0),
    (0, 30, 20, 0, 40, 0),
    (0, 150, -170, 0, 40, 0),
    (0, -30, 30, 120, 40, 200),
    (0, 60, -88.5, 0, 40, 0),  # q3 between -90 and the stretched arm
    (0, 150, -88.5, 0, -40, 0),
    (0, 200, -60, 0, 40, 0),
    (0, 45, -224, 0, 40, 0),
    (0, 100, -75.5, 30, 20, 0),  # the wrist centre is a few mm from axis 1
    (0, 135, -180.5, 30, 20, 0),
    (0, 81.08, -71.08, 0, 40, 0),  # 12 mm ahead of axis 1; without a3, behind it
    (0, 60, -86, 0, 40, 0),  # q3 between the stretched arm and -85
    (0, 150, -86, 0, -40, 0),
)


def ahead(q: Floats) -> float:
    """How far the wrist centre is ahead of axis 1, in the arm's plane."""
    return float(UPPER * np.cos(q[1]) + FORE * np.cos(q[1] + q[2] + OFFSET))


def wrist_height(q: Floats) -> float:
    """The height of the wrist centre above the shoulder."""
    return float(UPPER * np.sin(q[1]) + FORE * np.sin(q[1] + q[2] + OFFSET))


def above_line(q: Floats) -> float:
    """The height of the elbow above the line from shoulder to wrist."""
    return float(UPPER * (np.sin(q[1]) - np.cos(q[1]) * np.divide(wrist_height(q), ahead(q))))


def cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    """Simple postures, then random ones whose names do not depend on rounding."""
    made = [(np.array(q) * deg,) for q in SIMPLE]
    while len(made) < 40:
        q = rng.uniform(LOW, HIGH).round(2)
        clear = abs(ahead(q)) > 10 * mm and abs(np.sin(q[2] + OFFSET)) > 0.02 and abs(q[4]) > 0.05
        if clear and abs(above_line(q)) > 2 * mm:
            made.append((q,))
    return made


def form(result: Any, case: tuple[Any, ...]) -> str:
    parts = [result] if isinstance(result, str) else result
    if not isinstance(parts, (list, tuple, set)) or not all(isinstance(x, str) for x in parts):
        raise ValueError(f'wanted three words, "RIGHTY ABOVE NOFLIP", got {in_words(result)}')
    found = re.findall(r"[A-Z]+", " ".join(parts).upper())
    chosen = [[word for word in found if word in pair] for pair in PAIRS]
    if len(found) != 3 or any(len(some) != 1 for some in chosen):
        raise ValueError(f"wanted one word of each pair, got {in_words(result)}")
    return " ".join(some[0] for some in chosen)


def law(case: tuple[Any, ...], yours: str, wanted: str) -> str | None:
    """The correct name, and the measurements that it depends on."""
    if yours == wanted:
        return None
    (q,) = case
    side = ahead(q)
    rise = above_line(q) * abs(side) / np.hypot(side, wrist_height(q))  # perpendicular to the line
    return (
        f"should be {wanted}: the wrist centre is {abs(side) / mm:.0f} mm "
        f"{'ahead of' if side > 0 else 'behind'} axis 1, the elbow {abs(rise) / mm:.0f} mm "
        f"{'above' if rise > 0 else 'below'} the line from shoulder to wrist centre, and q5 is "
        f"{q[4] / deg:.0f}°"
    )


# --- Helpers for the wrong lines ------------------------------------------------------------------


def above_line_in_x(q: Floats) -> float:
    """As `above_line`, but with x of the base instead of the distance in the arm's plane."""
    _, shoulder, elbow, *_, wrist = PUMA560.frames(q).translation
    (x, _, z), (far, _, high) = elbow - shoulder, wrist - shoulder
    return float(z - high * np.divide(x, far))


def row_as_it_is(q: Floats, order: float) -> str:
    """The name of the nearest row in the norm of this order; the angles are not wrapped."""
    miss = np.linalg.norm(PUMA560.ik(PUMA560.fk(q)) - q, ord=order, axis=-1)
    front, elbow, wrist = PUMA560.branches[int(miss.argmin())]
    arm, height = "RIGHTY" if front > 0 else "LEFTY", "ABOVE" if front * elbow < 0 else "BELOW"
    return f"{arm} {height} {'NOFLIP' if wrist > 0 else 'FLIP'}"
