"""Exercise 2: a student's own cycle, and the mistakes in its gears, pulses and frequencies."""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np

from robokin import deg, mm
from robokin.course.exercises import in_words
from robokin.course.told import apart, floats
from robokin.course.variants import Numbers, dice
from robokin.jobs.steppers import counts, station_postures
from robokin.units import wrapped

from .shared import LOADER, STEP, A, B, Floats

COUNT = 5
LENGTHS = np.array([A + B, A + B, B])  # from each joint to the end of the stretched arm
COARSE = LENGTHS * STEP / 2 * deg  # how far half a step without a gear moves that end
TOGETHER = 0.01  # working times that differ by a smaller share count as equal
KEYS = ("gears", "pulses", "frequencies")
STOPS = ("start", "goal", "home")  # the cycle goes on from the last one to the first
PLACES = tuple(f"{stop}_{x}" for stop in STOPS for x in "xyz")
Fault = tuple[str, str]
Drive = tuple[Floats, Floats, Floats]  # gears, pulses (moves, motors) and frequencies


@cache
def postures(places: tuple[float, ...]) -> Floats:
    """The postures at some points in turn; joint 1 goes the short way."""
    return station_postures(LOADER, np.reshape(places, (-1, 3)))


def cycle(numbers: Mapping[str, Any]) -> Floats:
    """The postures (4, 3) of a student's cycle; the last is the first again."""
    return postures(tuple(float(numbers[name]) for name in (*PLACES, *PLACES[:3])))


def pulses_of(q: Floats, gears: Floats) -> Floats:
    """The pulses from the first posture to the second, without signs."""
    return np.asarray(abs(np.diff(counts(q, gears / STEP), axis=0)[0]), dtype=float)


def given(who: Any) -> Numbers:
    """Two points on either side of the direction 180° and a third one, such that the cycle drifts
    with the smallest gears if every move is rounded; the greatest miss and frequency that are
    allowed, and about 1.2 times the time that the smallest gears need for the first move.
    """
    roll = dice("motor_synchronisation", who)
    while True:
        side = roll.choice([-1, 1])
        start = np.array([-roll.randrange(250, 560, 10), side * roll.randrange(60, 260, 10)])
        goal = np.array([-roll.randrange(250, 560, 10), -side * roll.randrange(60, 260, 10)])
        heights = [roll.randrange(50, 400, 10), roll.randrange(50, 400, 10)]
        miss, most = roll.randrange(20, 42, 2) / 100 * mm, roll.randrange(400, 820, 20)
        ends = (*(start * mm), heights[0] * mm, *(goal * mm), heights[1] * mm)
        places = tuple(float(x) for x in ends)
        if not (np.linalg.norm(np.reshape(places, (2, 3)), axis=1) < 0.7).all():
            continue
        turns = abs(np.diff(postures(places), axis=0)[0] / deg)
        if (turns > 12).all() and np.ptp(np.sort(turns)[1:]) > 8:
            break
    least = np.ceil(COARSE / miss - 1e-9)  # the smallest gears that are fine enough
    needed = float((turns * least).max()) / STEP / most
    while True:
        home = [-roll.randrange(250, 560, 10), roll.randrange(-250, 260, 10)]
        stops = (*places, *(float(x * mm) for x in (*home, roll.randrange(50, 400, 10))))
        ways = np.diff(exact(postures((*stops, *stops[:3])), least), axis=0)
        if np.linalg.norm(stops[6:]) < 0.7 and np.rint(ways).sum(axis=0).any():
            break
    values: dict[str, Any] = dict(zip(PLACES, stops, strict=True))
    values |= {"miss": miss, "most": most, "seconds": float(np.ceil(12 * needed) / 10)}
    units = dict.fromkeys([*PLACES, "miss"], ("mm", mm))
    return Numbers(values, units | {"most": ("pulses/s", 1.0), "seconds": ("s", 1.0)})


def form(answer: Any, numbers: Any) -> Drive:
    if not isinstance(answer, Mapping) or not set(KEYS) <= set(answer):
        wanted = (
            'wanted {"gears": [three], "pulses": [three rows of three], "frequencies": [three]}'
        )
        raise ValueError(f"{wanted}, got {in_words(answer)}")
    found = []
    for key in KEYS:
        size, wanted = (3, "three numbers") if key != "pulses" else (9, "three rows of three")
        try:
            values = floats(answer[key])
        except (TypeError, ValueError):
            values = np.empty(0)
        if values.size == 1 and key == "gears":
            values = np.full(3, float(values.reshape(())))
        if values.size != size or not np.isfinite(values).all():
            raise ValueError(f"{key}: wanted {wanted}, got {in_words(answer[key])}")
        found.append(values.reshape(3) if size == 3 else values.reshape(3, 3))
    gears, sent, omega = found
    if (gears < 1).any() or (gears % 1).any() or (gears > 100_000).any():
        raise ValueError(f"gears: wanted whole numbers from 1 up, got {in_words(gears)}")
    if (omega <= 0).any():
        raise ValueError(
            "frequencies: wanted three positive numbers, because every motor has to move and the "
            f"direction is in the sign of the pulses, got {in_words(omega)}"
        )
    return gears, sent, omega


def faults(drive: Drive, numbers: Any) -> list[Fault]:
    gears, sent, omega = drive
    found, q = [], cycle(numbers)
    miss, most, seconds = (float(numbers[key]) for key in ("miss", "most", "seconds"))
    ends = COARSE / gears
    if (ends > miss * (1 + 1e-9)).any():
        k = int(ends.argmax())
        moves, allowed = apart(ends[k] / mm, miss / mm, 2)
        says = (
            f"Half a pulse of motor {k + 1} moves the end of the stretched arm by {moves} mm; "
            f"at most {allowed} mm is allowed. Half a pulse turns the joint by 0.9° / gear, and "
            f"the end is {LENGTHS[k] / mm:.0f} mm away from it."
        )
        found.append(("too coarse", says))
    fast = np.flatnonzero(omega > most * (1 + 1e-9))
    if fast.size:
        runs, allowed = apart(omega[fast[0]], most)
        says = f"Motor {fast[0] + 1} runs at {runs} pulses/s; at most {allowed} are allowed."
        found.append(("above the limit", says))
    if (sent != np.diff(counts(q, gears / STEP), axis=0)).any():
        found.append(wrong_pulses(q, gears, sent))
    pulses = pulses_of(q, gears)
    if not close(pulses / omega):
        found.append(not_together(q, gears, omega, pulses))
    if (pulses / omega).max() > seconds * (1 + 1e-9):
        found.append(too_slow(gears, omega, pulses, most, seconds))
    return found


def exact(q: Floats, gears: Floats) -> Floats:
    """The positions of the motors at some postures, in pulses and not rounded."""
    return np.asarray(q / deg * gears / STEP)


def wrong_pulses(q: Floats, gears: Floats, sent: Floats) -> Fault:
    """Why these are not the differences of the rounded positions."""
    due, right = exact(q, gears), np.diff(counts(q, gears / STEP), axis=0)
    off = abs(np.cumsum(sent - right, axis=0))  # at every stop
    i, k = divmod(int(off.argmax()), off.shape[1])
    stop = (*STOPS[1:], STOPS[0])[i]
    away = f"of motor {k + 1} end {said(off[i, k])} from the position nearest to {stop}"
    k = int(off[-1].argmax())
    drift = (
        f"After one cycle, motor {k + 1} is {said(off[-1, k])} from where it began, and this error "
        "grows with every cycle."
        if off[-1].any()
        else "Then a motor does not always stop as near as possible to a point."
    )
    short = np.column_stack([wrapped(q[:, 0]), q[:, 1:]])
    why = {
        "pulses that are not whole": (
            [np.diff(due, axis=0)],
            "A motor makes only whole pulses. Round the positions.",
        ),
        "every move rounded": ([np.rint(np.diff(due, axis=0))], f"You rounded every move. {drift}"),
        "the signs of the pulses": (
            [abs(right), -right],
            "The sign of a number of pulses is the direction: + if the angle of the joint grows. "
            "The numbers are right apart from their signs.",
        ),
        "the long way round": (
            [np.diff(counts(short, gears / STEP), axis=0)],
            "From one side of the direction 180° to the other, motor 1 takes the long way: the "
            "shorter way does not pass 0°.",
        ),
        "positions truncated": (
            [np.diff(cut(due), axis=0) for cut in (np.trunc, np.floor, np.ceil)],
            "Nothing drifts, but you cut off the fraction of a pulse. Round to the nearest pulse, "
            "so that no motor stops more than half a pulse from a point.",
        ),
        "positions instead of pulses": (
            [np.rint(due[:3]), np.rint(due[1:])],
            "You give positions, in pulses from zero. A row contains the pulses of a move: the "
            "difference of two positions.",
        ),
        "the gears left out": (
            [np.diff(np.rint(exact(q, np.ones(3))), axis=0)],
            "With a gear of r : 1, the motor needs r times as many pulses: you left out the gears.",
        ),
        "degrees for pulses": (
            [np.rint(np.diff(q / deg, axis=0)), np.diff(np.rint(q / deg), axis=0)],
            "You give degrees of the joints. Multiply angles by the pulses per degree.",
        ),
        "rows and columns swapped": (
            [right.T],
            "You swapped rows and columns: each row is a move, and each column is a motor.",
        ),
    }
    for name, (programs, says) in why.items():
        if any(np.allclose(sent, each, rtol=0, atol=1e-6) for each in programs):
            return name, says
    if (sent % 1).any():
        return "pulses that are not whole", why["pulses that are not whole"][1]
    return "wrong pulses", (
        f"Your pulses {away}. The pulses of a move are the difference of two rounded positions."
    )


def said(pulses: float) -> str:
    return "1 pulse" if pulses == 1 else f"{pulses:.0f} pulses"


def close(values: Floats) -> bool:
    return bool(values.max() <= (1 + TOGETHER) * values.min())


def not_together(q: Floats, gears: Floats, omega: Floats, pulses: Floats) -> Fault:
    """Why the motors do not stop at the same time."""
    times = ", ".join(f"{t:.3f}" for t in pulses / omega)
    told = f"The motors need {times} s for {', '.join(f'{p:.0f}' for p in pulses)} pulses."
    turns = abs(np.diff(q, axis=0)[0] / deg)  # in the first move
    long = pulses_of(np.column_stack([wrapped(q[:, 0]), q[:, 1:]]), gears)
    why = {
        "the long way round": f"Your frequencies are for {long[0]:.0f} pulses of motor 1. From one "
        "side of the direction 180° to the other, the shorter way does not pass 0°.",
        "equal products": "You made the products of pulses and frequency equal. The time is the "
        "number of pulses divided by the frequency.",
        "one frequency for all": "You use the same frequency for all motors. Then the motor with "
        "the most pulses stops last.",
        "the gears left out": "Your frequencies are proportional to the turns of the joints, not "
        "to the pulses: you left out the gears.",
        "divided by the gear": "You divided by the gear. With a gear of r : 1 the motor needs r "
        "times as many pulses.",
    }
    fits = (
        close(long / omega),
        close(pulses * omega),
        np.ptp(omega) < 1e-9,
        close(turns / omega),
        close(turns / gears / omega),
    )
    for name, true in zip(why, fits, strict=True):
        if true:
            return name, f"{told} {why[name]}"
    return "not together", told


def too_slow(gears: Floats, omega: Floats, pulses: Floats, most: float, seconds: float) -> Fault:
    takes, allowed = apart((pulses / omega).max(), seconds)
    says = f"The move takes {takes} s; at most {allowed} s is allowed."
    if pulses.max() / most <= seconds:
        says += " With higher frequencies, these gears are fast enough."
        return "slower than the limit asks", says
    k = int(pulses.argmax())
    says += (
        f" Even at {most:.0f} pulses/s motor {k + 1} takes longer than that: its gear of "
        f"{gears[k]:.0f} : 1 is finer than it has to be."
    )
    return "geared too high", says
