"""Exercise 1: the cases, the form of a name and the law."""

import re
from typing import Any

import numpy as np

from robokin import deg, mm
from robokin.course.exercises import in_words

from .shared import HIGH, LOW, Floats

PAIRS = ({"RIGHTY", "LEFTY"}, {"ABOVE", "BELOW"}, {"FLIP", "NOFLIP"})
PUMA = (431.8, 20.3, 431.8)  # mm: a2, a3, d4
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
OTHER = (  # lengths, and a posture that has another name on the PUMA
    ((500, 100, 300), (0, 60, -80, 0, 40, 0)),  # stretched at -71.6
    ((300, 0, 600), (0, 50, -15, 0, 40, 0)),  # the long forearm reaches back behind axis 1
    ((600, -100, 300), (0, 60, -95, 0, -40, 0)),  # stretched at -108.4
)


def sides(q: Floats, a2: float, a3: float, d4: float) -> tuple[float, float, float]:
    """How far the wrist centre is ahead of axis 1 in the arm's plane, and above the shoulder, and
    how far the elbow is above the line from the shoulder to the wrist centre.
    """
    forearm = q[1] + q[2]  # its direction is up at 0
    ahead = a2 * np.cos(q[1]) + a3 * np.cos(forearm) - d4 * np.sin(forearm)
    high = a2 * np.sin(q[1]) + a3 * np.sin(forearm) + d4 * np.cos(forearm)
    rise = a2 * (np.sin(q[1]) - np.cos(q[1]) * np.divide(high, ahead))
    return float(ahead), float(high), float(rise)


def cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    """Simple postures of the PUMA, then of other arms, then random ones whose names do not depend
    on rounding.
    """
    made: list[tuple[Any, ...]] = [(np.array(q) * deg, *scaled(PUMA)) for q in SIMPLE]
    made += [(np.array(q) * deg, *scaled(lengths)) for lengths, q in OTHER]
    while len(made) < 48:
        q = rng.uniform(LOW, HIGH).round(2)
        a2, a3, d4 = (float(x) for x in rng.integers([25, -12, 25], [70, 13, 70]) * 10 * mm)
        ahead, _, rise = sides(q, a2, a3, d4)
        bend = np.sin(q[2] + np.arctan2(d4, a3))
        if abs(ahead) > 10 * mm and abs(bend) > 0.02 and abs(q[4]) > 0.05 and abs(rise) > 2 * mm:
            made.append((q, a2, a3, d4))
    return made


def scaled(lengths: tuple[float, ...]) -> list[float]:
    """Lengths in metres."""
    return [x * mm for x in lengths]


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
    q, *lengths = case
    ahead, high, rise = sides(q, *lengths)
    rise *= abs(ahead) / np.hypot(ahead, high)  # perpendicular to the line
    return (
        f"should be {wanted}: the wrist centre is {abs(ahead) / mm:.0f} mm "
        f"{'ahead of' if ahead > 0 else 'behind'} axis 1, the elbow is {abs(rise) / mm:.0f} mm "
        f"{'above' if rise > 0 else 'below'} the line from the shoulder to the wrist centre, and "
        f"q5 is {q[4] / deg:.0f}°"
    )
