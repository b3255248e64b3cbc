"""Cases, form and law of exercise 1, the next posture; its text is in the Markdown file."""

from typing import Any

import numpy as np

from robokin import deg, mm
from robokin.course.exercises import in_words
from robokin.course.told import apart, floats
from robokin.units import wrapped

from .shared import SHOULDER, TURN, A, B, E, Floats

# x, y, z in mm, and the previous angle of joint 1 in degrees
PLACES = (
    "600 0 100 0, 600 200 100 0, 300 400 0 40, 0 500 200 10, -400 300 50 100, -400 -300 50 -100",
    "400 -300 250 30, -500 -20 200 170, -500 20 200 -170, -500 -20 200 190, -500 20 200 -200",
    "-300 -300 300 90, 300 300 300 -150, 500 100 100 700, 500 -100 100 -760, 0 0 400 130",
    "0 0 600 -75, 4 3 500 60, -1 2 400 -100, 0 -400 0 0, 100 100 600 -20",  # near the axis
    "60 20 300 40, -30 -50 250 -100",  # behind joint 2
    "80 60 700 0, 200 0 0 0, 60 -60 90 20, 800 400 100 0, 0 0 800 30, 249 0 0 0, 0 852 0 0",
    "-251 0 0 150, 0 849 0 100",  # at the borders
    "450 150 100 1400, -400 -250 80 -1700",  # four turns further
)


def cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    rows = [np.array(row.split(), dtype=float) for row in ", ".join(PLACES).split(", ")]
    found = [(row[:3] * mm, float(row[3] * deg)) for row in rows]
    for _ in range(8):
        place = rng.uniform(-1, 1, 3)
        place *= rng.uniform(0.3, 0.7) / np.linalg.norm(place)
        place[2] = abs(place[2])
        found.append((place.round(3), float(rng.uniform(-200, 200) * deg)))
    return found


def form(result: Any, case: tuple[Any, ...]) -> Floats:
    wanted = "wanted three angles alpha, gamma, beta in radians, or three NaN"
    try:
        values = floats(result)
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {in_words(result)}") from None
    if values.size == 1 and np.isnan(values).all():
        return np.full(3, np.nan)
    if values.size != 3:
        raise ValueError(f"{wanted}, got {in_words(result)}")
    return values.reshape(3)


def same(a: Floats, b: Floats) -> bool:
    return np.allclose(a, b, rtol=0, atol=1e-6, equal_nan=True)


def law(case: tuple[Any, ...], yours: Floats, wanted: Floats) -> str | None:
    point, before = case
    h = float(np.hypot(np.hypot(point[0], point[1]) - E, point[2]))
    if np.isnan(wanted).any():
        if np.isnan(yours).all():
            return None
        side = "nearer than A \N{MINUS SIGN} B" if h < A else "farther than A + B"
        return f"should be three NaN: joint 2 is h = {h / mm:.1f} mm away from the point, {side}"
    # whole turns count for joint 1 (alpha), and not for gamma and beta
    off = abs(np.append(yours[:1] - wanted[:1], wrapped(yours[1:] - wanted[1:])))
    if off.max() <= 1e-6:
        return None
    right, given = apart(wanted / deg, yours / deg, 2)
    says = f"α, γ, β should be {right} degrees, not {given}"
    if not off[0] <= 1e-6 and not (point[0] or point[1]):
        return f"{says}: on the axis joint 1 stays at {before / deg:.1f}°"
    if np.isnan(yours).any():
        return f"{says}: joint 2 is h = {h / mm:.1f} mm away from the point, which is in reach"
    if off[0] > 1e-6 and abs(wrapped(yours[0] - wanted[0])) <= 1e-6:
        turn, yours_turn = apart((wanted[0] - before) / deg, (yours[0] - before) / deg)
        return f"{says}: a turn of {turn}° from {before / deg:.1f}°; you turn by {yours_turn}°"
    there = SHOULDER.fk(wrapped(yours)).translation
    if np.linalg.norm(there - point) <= 1e-9:
        return f"{says}; your angles reach the point in a different posture"
    got, asked = apart(there / mm, point / mm)
    return f"{says}; your angles put the gripper at ({got}) mm instead of ({asked}) mm"


# --- Helpers for the wrong programs ---------------------------------------------------------------


def raised() -> float:
    raise ValueError("out of reach")


def by_size(d: float) -> float:
    """The rest of a turn, always with the same sign."""
    return d if abs(d) <= np.pi else abs(d) - TURN


def once(d: float) -> float:
    """Add or subtract at most one turn."""
    return d - TURN if d > np.pi else d + TURN if d < -np.pi else d


def cells(x: float, y: float) -> float:
    """The angle by table 1 as printed."""
    if x == 0:
        return float(np.sign(y) * np.pi / 2)
    if x < 0 <= y:
        return float(np.arctan(y / abs(x)) + np.pi / 2) if y else np.pi
    return float(np.arctan(y / x) - (np.pi if x < 0 else 0))


def at_gripper(h: float) -> float:
    """The law of sines with the angle at the gripper."""
    beta = np.arccos((A**2 + B**2 - h**2) / (2 * A * B))
    return float(np.arcsin(np.minimum(A * np.sin(beta) / h, 1)))
