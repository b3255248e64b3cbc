"""Cases, form and law of exercise 1; its text is in the Markdown file beside it."""

import contextlib
from typing import Any

import numpy as np

from robokin import SCARA, ScaraPose, deg, mm, nearest
from robokin.course.exercises import in_words
from robokin.course.told import apart, floats
from robokin.units import wrapped

from .shared import HIGH, LOW, MINUS, Floats


def same_elbow(q0: Floats, position: Any, angle: float, side: int = 1) -> Any:
    """The row of ik with the elbow of q0; side -1: the other one."""
    return SCARA.ik(ScaraPose(position, angle))[SCARA.branch(side if q0[1] >= 0 else -side)]


def cases(rng: np.random.Generator) -> list[tuple[Any, ...]]:
    def case(q0: list[float], place: list[float], angle: float) -> tuple[Any, ...]:
        return np.array(q0) * [deg, deg, deg, mm], np.array(place) * mm, angle * deg

    found = [
        case([0, 90, 0, 100], [200, 250, 120.2], 110),  # the arm stays still, the tool turns by 20
        case([0, 90, 0, 100], [200, 250, 120.2], -110),  # 160 to the left, through 180
        case([0, 90, 0, 100], [200, 250, 120.2], 450),  # one turn further: it stays still
        case([0, 90, -90, 150], [200, 250, 70.2], -176),  # joint 4 is not an angle
        case([-100, 40, 0, 20], [-150, 300, 150.2], 150),  # joints 1 and 2 turn by 200
        case([120, -50, 30, 20], [-100, -300, 150.2], -80),
        case([30, 60, 80, 50], [300, 200, 170.2], -170),  # to the left through 180
        case([30, -60, -130, 50], [300, -200, 100.2], 170),  # to the right, with the other elbow
        case([-90, 40, 0, 20], [100, 350, 150.2], 100),  # joints 1 and 2 turn a lot
        case([-110, 60, 20, 20], [-150, 300, 150.2], 60),
        case([110, -60, -20, 20], [-150, -300, 150.2], -60),
        case([100, 60, 150, 0], [300, 150, 220.2], -20),  # from 310: 340 is nearer than -20
        case([100, 60, 390, 0], [300, 150, 220.2], 170),  # from 550
        case([-100, -60, -390, 0], [300, -150, 220.2], -170),
        case([20, 60, 380, 90], [150, 300, 100.2], 160),  # the limit of joint 3 matters
        case([60, 90, 385, 90], [300, -150, 100.2], 190),
        case([60, 90, 395, 90], [250, -250, 60.2], 150),
        case([-20, -60, -380, 90], [150, -300, 100.2], -160),
        case([-60, -90, -385, 90], [300, 150, 100.2], -190),
        case([100, -60, -230, 90], [-214, 81, 100.2], -20),  # joints 1 and 2 turn by -290
        case([60, 90, 300, 90], [300, -150, 100.2], 1170),  # three turns further
        case([60, 90, -300, 90], [300, -150, 100.2], -1000),
        case([30, 60, 80, 50], [300, 200, 170.2], -1250),  # four turns further
        case([30, -60, -130, 50], [300, -200, 100.2], 1250),
        case([0, 90, -90, 20], [200, 250, 50.2], 176),  # joint 4 moves by 150 mm, not by an angle
        case([0, 90, -90, 170], [200, 250, 200.2], -176),
        case([0, 0, 90, 100], [200, 250, 120.2], 110),  # a straight arm: 0 is positive
        case([120, 0, -30, 50], [200, 250, 120.2], -110),  # the other elbow would be nearer
    ]
    while len(found) < 46:
        q0 = np.array([*rng.uniform([-139, 20, -399], [139, 140, 399]).round(1), 30.0])
        q0[1] *= rng.choice([-1, 1])
        q0 = q0 * [deg, deg, deg, mm]
        q = np.array([*rng.uniform([-135, 25], [135, 140]).round(1) * deg, 0.0, 0.1])
        q[1] *= np.sign(q0[1])
        if len(found) % 2:  # joints 1 and 2 turn a lot
            q[0], q0[2] = -np.sign(q0[0]) * abs(q[0]), q0[2] / 2
        place = SCARA.fk(q).translation.round(4)
        angle = round(rng.uniform(-400, 400), 1) * deg
        end = angle - same_elbow(q0, place, angle)[:2].sum()
        # at half a turn, both directions are equally short
        clear = abs(abs(wrapped(angle - q0[:3].sum())) - np.pi) > 0.05
        if clear and (abs(wrapped(end - [LOW[2], HIGH[2]])) > 0.02).all():
            found.append((q0, place, angle))
    return found


def form(result: Any, case: tuple[Any, ...]) -> Floats:
    with contextlib.suppress(TypeError, ValueError):
        values = np.squeeze(floats(result))
        if values.shape == (4,):
            return values
    wanted = "wanted four joint values, q1 to q3 in radians and q4 in metres"
    raise ValueError(f"{wanted}, got {in_words(result)}")


def same(a: Floats, b: Floats) -> bool:
    return np.allclose(a, b, rtol=0, atol=1e-6, equal_nan=True)


def law(case: tuple[Any, ...], yours: Floats, wanted: Floats) -> str | None:
    said = told(case, yours, wanted)
    return said and said.translate(MINUS)


def told(case: tuple[Any, ...], yours: Floats, wanted: Floats) -> str | None:
    off = ~(abs(yours - wanted) <= 1e-6)
    if not off.any():
        return None
    q0, position, angle = case
    if off[:2].any() and (abs(yours[:2] * deg - wanted[:2]) <= 1e-6).all():
        return (
            f"joint 2 is {yours[1]:.1f}, which is right in degrees. It should be in radians, "
            f"{wanted[1]:.4f}, and joint 4 in metres"
        )
    other = same_elbow(q0, position, angle, -1)
    if off[:2].any() and (abs(wrapped(yours[:2] - other[:2])) <= 1e-6).all():
        counts = " (treated as positive)" if q0[1] == 0 else ""
        return (
            f"the elbow ends on the other side: joint 2 is at {q0[1] / deg:.1f}° in q0{counts} "
            f"and at {yours[1] / deg:.1f}° at the end. It should end at {wanted[1] / deg:.1f}°, "
            f"and joint 1 at {wanted[0] / deg:.1f}°"
        )
    for k in (0, 1):
        if off[k]:
            at, is_at = apart(wanted[k] / deg, yours[k] / deg)
            return f"joint {k + 1} should be at {at}° (same elbow as in q0), but is at {is_at}°"
    if off[3]:
        at, is_at = apart(wanted[3] / mm, yours[3] / mm)
        return f"joint 4 should be at {at} mm, but is at {is_at} mm"
    now, end, got = (float(q[:3].sum()) / deg for q in (q0, wanted, yours))
    turns, yours_turns = apart(end - now, got - now)
    third, yours_third = apart(wanted[2] / deg, yours[2] / deg)
    return (
        f"the tool is at {now:.1f}°. It should turn by {turns}°, to {end:.1f}°, with joint 3 "
        f"at {third}°. Your answer turns it by {yours_turns}°, with joint 3 at {yours_third}°"
    )


def nearer(rows: Floats, q0: Floats, count: int, order: float = 1, whole: bool = False) -> Any:
    """For wrong programs: the row whose first joints are nearest to q0 in the norm of this order;
    `whole`: ignore whole turns.
    """
    change = (rows - q0)[:, :count]
    change = wrapped(change) if whole else change
    return rows[np.nanargmin(np.linalg.norm(change, ord=order, axis=-1))]


def least_travel(rows: Floats, q0: Floats) -> Floats:
    return nearest(SCARA, rows, q0)


def by_360(q3: float) -> float:
    """Subtract or add 360, as if q3 were in degrees, until it is inside: two `while` loops."""
    while q3 > HIGH[2]:
        q3 -= 360
    while q3 < LOW[2]:
        q3 += 360
    return q3
