"""Exercise 3: a student's own line, and the faults of a row and of a duration on it."""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np

from robokin import PUMA560, Quaternion, Transform, deg, differentiate, lin, mm, quintic
from robokin.course.exercises import in_words
from robokin.course.told import apart
from robokin.course.variants import Numbers, dice

from .shared import REST, Floats, Y, excess, near, serves, tracks, usable

COUNT = 3
UNITS = {
    "tilt": ("° about y", deg),
    **{f"{end}_{letter}": ("mm", mm) for end in ("start", "goal") for letter in "xyz"},
    "fastest": ("°/s", deg),
}
SAMPLES = 41  # to find a line; FINE then confirms it, and judges the answers
FINE = 641
QUICKEST = (1, 2)  # a line is drawn so that one of these rows is the quickest, as often each
LONGEST = 1.05  # times the shortest duration


def ends(numbers: Mapping[str, float]) -> tuple[Transform, Transform]:
    """Start and goal of a line."""
    turn = Quaternion.from_angle_axis(numbers["tilt"], Y)
    first, last = ([numbers[f"{end}_{x}"] for x in "xyz"] for end in ("start", "goal"))
    return Transform(turn, np.array(first)), Transform(turn, np.array(last))


class Judged:
    """The properties of a line: for each row the motion, how far it exceeds the limits, its
    greatest joint speed if it takes 1 s, and whether it is usable at the ends.
    """

    def __init__(self, samples: int, *items: tuple[str, float]) -> None:
        shares = np.linspace(0, 1, samples)
        self.q = tracks(PUMA560.ik(lin(*ends(dict(items)), quintic(1.0)(shares))))
        self.past = excess(self.q).max(axis=(1, 2))
        self.serves = serves(self.q)
        speeds = differentiate(self.q, shares)
        self.speed = abs(speeds).max(axis=(1, 2))
        self.at_start, self.at_goal = usable(self.q[:, 0]), usable(self.q[:, -1])
        self.near = near(self.q).min(axis=-1)
        self.mean = np.maximum(abs(self.q[:, -1] - self.q[:, 0]).max(axis=-1), 1e-9)
        travel = abs(self.q[:, 0] - REST).sum(axis=-1)
        self.obvious = int(np.where(self.at_start, travel, np.inf).argmin())

    def least(self, fastest: float) -> Floats:
        """The shortest duration of each row, s; infinite if the row is not usable to the end."""
        return np.where(self.serves, self.speed / fastest, np.inf)

    def fair(self, quickest: int) -> bool:
        """Whether a line is a fair task: at least two rows are usable to its end, so that there is
        a choice, and at least two others only at its start. The row `quickest` is clearly the
        quickest, the next one is less than four times as slow, and nothing depends on the samples.
        """
        if not np.isfinite(self.q).all():
            return False
        most = np.sort(self.least(1.0))
        best = int(self.least(1.0).argmin())
        return bool(
            2 <= self.serves.sum() <= min(4, self.at_start.sum() - 2)
            and (abs(self.past) > 1 * deg).all()
            and 1.15 * most[0] < most[1] < 4 * most[0]
            and self.near[best] > 0.03
            and best == quickest
        )


judged_once = cache(Judged)


def judged_line(numbers: Mapping[str, float], samples: int = FINE) -> Judged:
    """The properties of the line with these numbers."""
    return judged_once(samples, *((name, float(value)) for name, value in sorted(numbers.items())))


def given(who: Any) -> Numbers:
    """An individual line, for which the student chooses a row and a duration."""
    roll = dice("puma560_branches", who)
    quickest = QUICKEST[roll.randrange(len(QUICKEST))]
    while True:
        side, x = 1 - 2 * roll.randrange(2), roll.randrange(350, 651, 10) * mm
        numbers = {
            "tilt": roll.randrange(60, 151, 15) * deg,
            "start_x": x,
            "start_y": side * roll.randrange(300, 651, 10) * mm,
            "start_z": roll.randrange(400, 1101, 10) * mm,
            "goal_x": x,
            "goal_y": -side * roll.randrange(100, 401, 10) * mm,
            "goal_z": roll.randrange(400, 1201, 10) * mm,
            "fastest": roll.randrange(30, 91, 5) * deg,
        }
        reached = np.isfinite(
            PUMA560.ik(lin(*ends(numbers), quintic(1.0)(np.linspace(0, 1, 21))))
        ).all()
        if reached and all(judged_line(numbers, n).fair(quickest) for n in (SAMPLES, FINE)):
            return Numbers(numbers, UNITS)


def form(answer: Any, given: Any) -> tuple[int, float]:
    if not isinstance(answer, Mapping) or not {"row", "duration"} <= set(answer):
        raise ValueError(
            f'wanted {{"row": ..., "duration": ...}} with a row of ik and seconds, got '
            f"{in_words(answer)}"
        )
    row, duration = answer["row"], answer["duration"]
    if np.size(row) != 1 or isinstance(row, (str, bool)) or float(np.reshape(row, ())) % 1:
        raise ValueError(f"row: wanted a whole number from 0 to 7, got {in_words(row)}")
    row = int(np.reshape(row, ()))
    if not 0 <= row <= 7:
        raise ValueError(f"row: wanted a whole number from 0 to 7, got {row}")
    if np.size(duration) != 1 or isinstance(duration, (str, bool)):
        raise ValueError(f"duration: wanted seconds, got {in_words(duration)}")
    seconds = float(np.reshape(duration, ()))
    if not (np.isfinite(seconds) and seconds > 0):
        raise ValueError(f"duration: wanted seconds above 0, got {in_words(seconds)}")
    return row, seconds


def faults(answer: tuple[int, float], given: Any) -> list[tuple[str, str]]:
    row, duration = answer
    line = judged_line(given)
    found = []
    if not line.serves[row]:
        found.append(row_fault(line, row))
    fastest = float(given["fastest"])
    needed = float(line.speed[row]) / fastest
    least = float(line.least(fastest).min())
    if duration < 0.995 * needed:
        found.append(fast_fault(line, row, duration, fastest))
    if duration > LONGEST * max(least, needed if not line.serves[row] else 0.0):
        found.append(slow_fault(line, row, duration, fastest))
    return found


def row_fault(line: Judged, row: int) -> tuple[str, str]:
    """Which joint exceeds its limit, and from when on."""
    over = excess(line.q[row])
    sample, joint = (int(k) for k in np.argwhere(over > 1e-9)[0])
    most = over.max(axis=0)
    since = 100 * sample / (len(over) - 1)
    says = (
        f"On row {row} joint {joint + 1} goes past its limit after {since:.0f} % of the time, by "
        f"up to {most[joint] / deg:.0f}°."
    )
    if line.at_start[row] and line.at_goal[row]:
        says += " At both ends the posture is usable: follow the angles from end to end."
        return "usable at both ends, not in between", says
    if row == line.obvious:
        says += " At the start it is the usable row nearest to the rest posture."
        return "usable at the start, not to the end", says
    return "not usable to the end", says + " Follow each row to the end of the line."


def fast_fault(line: Judged, row: int, duration: float, fastest: float) -> tuple[str, str]:
    """How fast a joint turns, and the likely cause of such a duration."""
    is_at, most = apart(line.speed[row] / duration / deg, fastest / deg, 0)
    says = (
        f"In {duration:.4g} s a joint of row {row} turns at up to {is_at}°/s; the limit is "
        f"{most}°/s."
    )
    if abs(duration * fastest / line.mean[row] - 1) < 0.005:
        says += " You used the mean speed. In the middle the quintic law is faster than that."
        return "the mean speed instead of the greatest", says
    if abs(duration * fastest / line.mean[row] / (15 / 8) - 1) < 0.005:
        says += (
            " You used 15/8 of the mean speed. That is the peak of a PTP move, in which each joint "
            "follows the quintic law. On a straight line of the flange it does not: differentiate "
            "the angles."
        )
        return "the peak of PTP on a line", says
    if fault := unit_fault(duration * fastest / line.speed[row], fastest, says):
        return fault
    if (duration >= 0.995 * line.least(fastest)).any():
        says += " For another row this duration would be enough."
    return "too fast", says


def unit_fault(share: float, fastest: float, says: str) -> tuple[str, str] | None:
    """The fault of a duration that is this fraction of the correct one; None: no known fault."""
    for wrong in (deg, 1 / deg):
        if 0.995 < share / wrong < LONGEST:
            says += " Give the joint speed and fastest in the same unit: both in rad/s."
            return "degrees for radians", says
    if abs(fastest - 1) > 0.2 and abs(share / fastest - 1) < 0.021:
        says += " This number is the greatest joint speed if the line takes one second. Divide it "
        return "the joint speed instead of the duration", says + "by fastest to get the duration."
    return None


def slow_fault(line: Judged, row: int, duration: float, fastest: float) -> tuple[str, str]:
    """The fault of a slow motion: a row that turns more, another unit, or only the duration."""
    says = f"{duration:.4g} s is more than 5 % above the shortest possible duration."
    least = line.least(fastest)
    if line.serves[row] and least[row] > LONGEST * least.min():
        says += f" Row {row} is usable to the end, but another row needs less time."
        return "a row that reaches the goal, but not the quickest", says
    fault = unit_fault(duration * fastest / line.speed[row], fastest, says)
    return fault or ("too slow", says)
