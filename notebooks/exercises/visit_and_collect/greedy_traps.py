"""Exercise 3: a student's numbers, and the faults of the traps."""

from collections.abc import Mapping
from contextlib import suppress
from typing import Any

import numpy as np

from robokin.course.exercises import in_words
from robokin.course.told import apart, floats
from robokin.course.variants import Numbers, dice
from robokin.jobs.visit_collect import Task, best_visit, collect, out_of_workspace, visit

from .shared import FOUR, L1, L2, Floats, costs

Fault = tuple[str, str]
Traps = dict[str, Floats | None]  # None: no trap

COUNT = 3
APART = 0.3  # m
LOST = 2  # points
TASKS = ("visit", "collect", "worth")
NO_TRAP = "no trap"
NOBODY = "your name"  # the placeholder in the lab
KNOWN = np.array(FOUR)
GIVEN_UP = {
    "visit": "The cost of a point depends on where the arm comes from: the opening has such a "
    "case, with other numbers.",
    "worth": "Cheapest first brings the most objects, but they need not be worth the most: let a "
    "cheap one use up the time that the valuable one needs.",
}


def given(who: Any) -> Numbers:
    """Times, worths, speed and start for individual traps. Every student's task can be solved:
    points on the circle through p0 about axis 1 suffice, since joint 1 has room for 2.7 rad to both
    sides.
    """
    roll = dice("visit_and_collect", who)
    speed = 0.2 + 0.05 * roll.randrange(5)
    budget = 1.2 + 0.05 * roll.randrange(9)  # rad that a joint can turn in the time T
    T = round(budget / speed, 1)
    x, y = 3.5 + 0.25 * roll.randrange(5), -1.5 + 0.25 * roll.randrange(13)
    height = 1.0 + 0.25 * roll.randrange(7)
    worth = [3 + roll.randrange(3) for _ in range(4)]  # none is half of another ...
    worth[roll.randrange(4)] = 11 + roll.randrange(5)  # ... except of the valuable one
    made = {
        "T": (T, "s"),
        "T_collect": (round(3 * T, 1), "s"),
        "worth": (worth, "(of object 0, 1, 2, 3)"),
        "speed": (round(speed, 2), "rad/s, of every joint"),
        "p0": ([x, y, height], "m"),
        "apart": (APART, "m"),
    }
    units = {name: (unit, 1.0) for name, (_, unit) in made.items()}
    return Numbers({name: value for name, (value, _) in made.items()}, units)


def plain(answer: Any) -> Any:
    """Convert lists of numbers to arrays, which are shown with few digits."""
    if not isinstance(answer, Mapping):
        return answer
    found = dict(answer)
    for task, points in answer.items():
        with suppress(TypeError, ValueError):
            found[task] = floats(points) if isinstance(points, (list, tuple)) else points
    return found


def form(answer: Any, given: Any) -> Traps:
    answer = plain(answer)
    if not isinstance(answer, Mapping) or set(answer) != set(TASKS):
        wanted = 'Wanted {"visit": ..., "collect": ..., "worth": ...}'
        raise ValueError(f"{wanted}, got {in_words(answer)}.")
    traps: Traps = {}
    wrong = []
    for task in TASKS:
        try:
            traps[task] = points_form(task, answer[task])
        except ValueError as error:
            wrong.append(str(error))
    if wrong:
        raise ValueError(" ".join(wrong))
    return traps


def points_form(task: str, answer: Any) -> Floats | None:
    wanted = (
        f'"{task}": wanted four points, [[x, y, z], [x, y, z], [x, y, z], [x, y, z]] in metres, '
        f'or "{NO_TRAP}"'
    )
    if isinstance(answer, str) and " ".join(answer.casefold().strip(" .!'\"").split()) == NO_TRAP:
        return None
    points: Floats = np.zeros(0)
    with suppress(TypeError, ValueError):
        points = floats(answer)
    if points.shape != (4, 3) or not np.isfinite(points).all():
        raise ValueError(f"{wanted}, got {in_words(answer)}.")
    if abs(points).max() > 50:
        raise ValueError(f"{wanted}; yours are up to {abs(points).max():.4g} m away.")
    return points


def both(task: str, points: Floats, numbers: Any) -> tuple[list[int], list[int]]:
    """The choice of the greedy rule, in order, and the best choice."""
    T, kind = (numbers["T"], "visit") if task == "visit" else (numbers["T_collect"], "collect")
    made = Task(L1, L2, T, [numbers["speed"]] * 3, numbers["p0"], points.tolist(), kind)
    if task == "visit":
        return list(visit(made).order), list(best_visit(made).order)
    worth = np.array(numbers["worth"] if task == "worth" else [1, 1, 1, 1])
    choices = (np.arange(16)[:, None] >> np.arange(4)) & 1
    fits = choices[choices @ costs(made) <= made.T + 1e-9]
    return list(collect(made).order), np.flatnonzero(fits[(fits @ worth).argmax()]).tolist()


def worths(numbers: Any, *choices: list[int]) -> list[int]:
    return [sum(numbers["worth"][k] for k in taken) for taken in choices]


def scores(task: str, points: Floats, numbers: Any) -> str:
    greedy, best = both(task, points, numbers)
    a, b, (first, most) = len(greedy), len(best), worths(numbers, greedy, best)
    told = {
        "visit": f"nearest first visits {a} of 4 (order {greedy}), and the best order visits {b} "
        f"({best}).",
        "collect": f"cheapest first brings {a} of 4 ({greedy}), and the best choice brings {b}.",
        "worth": f"cheapest first brings {greedy}, worth {first}; the best choice is {best}, worth "
        f"{most}.",
    }
    return f'"{task}": {told[task]}'


def holds(traps: Traps, numbers: Any) -> list[str]:
    told = [scores(task, points, numbers) for task, points in traps.items() if points is not None]
    told.append('"collect": no trap, and the proof of section 2 says why.')
    if numbers == given(NOBODY):
        told.append(f'These numbers belong to "{NOBODY}": give your own name.')
    return told


def faults(traps: Traps, numbers: Any) -> list[Fault]:
    found = [fault for task in TASKS if (fault := trap_fault(task, traps[task], numbers))]
    if len(found) < 2:
        return found
    names = "; ".join(dict.fromkeys(name for name, _ in found))
    return [(f"{len(found)} of the {COUNT} answers are wrong: {names}", says) for _, says in found]


def trap_fault(task: str, points: Floats | None, numbers: Any) -> Fault | None:
    """The fault of the answer for one task; None: it is correct."""
    if points is None:
        says = f'"{task}": there is a trap. {GIVEN_UP.get(task)}'
        return ("given up, although there is a trap", says) if task in GIVEN_UP else None
    fault = places_fault(task, points, numbers)
    if task == "collect":
        says = '"collect": look at the proof of section 2 before you build.'
        if not fault:
            says = (
                f"{scores(task, points, numbers)} No four points change that: any k objects cost "
                "at least as much as the k cheapest (section 2)."
            )
        return "a trap that cannot exist", says
    return fault or not_beaten(task, points, numbers)


def places_fault(task: str, points: Floats, numbers: Any) -> Fault | None:
    for k, point in enumerate(points):
        if reasons := out_of_workspace(L1, L2, point):
            return "out of the workspace", f'"{task}": point {k} {reasons[0]}.'
    places = np.vstack([numbers["p0"], points])
    gaps = np.linalg.norm(places[:, None] - places, axis=-1) + 100 * np.eye(5)
    if gaps.min() < APART - 1e-9:
        a, b = (int(k) for k in np.unravel_index(gaps.argmin(), gaps.shape))
        names = ["p0", *(f"point {k}" for k in range(4))]
        near, wanted = apart(gaps.min(), APART, 2)
        says = f"{names[a]} and {names[b]} are {near} m apart. They need {wanted} m."
        return "too near to each other", f'"{task}": {says}'
    return None


def known(points: Floats) -> bool:
    """Whether these are nearly the four points of the opening, in any order, or mirror images."""
    both_ways = np.array([KNOWN, KNOWN * [1, -1, 1]])[:, None]
    gaps = np.linalg.norm(points[:, None] - both_ways, axis=-1)  # (2, 4, 4)
    nearest = np.maximum(gaps.min(axis=1).max(axis=-1), gaps.min(axis=2).max(axis=-1))
    return bool((nearest < 0.15).any())


def not_beaten(task: str, points: Floats, numbers: Any) -> Fault | None:
    """Why allowed points are not a trap for the greedy rule of "visit" or "worth"."""
    if known(points):
        says = "these are the four points of the opening. Build your own for your start and time."
        return "the lab's own points", f'"{task}": {says}'
    greedy, best = both(task, points, numbers)
    told = scores(task, points, numbers)
    if not best:
        return (
            "nothing in time",
            f"{told} Not even the nearest point is reached in time: move the points nearer.",
        )
    if len(greedy) == 4:
        return "all in time", f"{told} There is time for all of them: move them farther apart."
    if task == "visit" and len(best) - len(greedy) < LOST:
        if len(best) == len(greedy):
            return "the rule is not beaten", f"{told} No order does better."
        return "one point lost, not two", f"{told} If nearest first loses one more, this is a trap."
    if task == "worth":
        first, most = worths(numbers, greedy, best)
        if first == most:
            return "the rule is not beaten", f"{told} No choice is worth more."
        if 2 * first > most:
            return "less than half is lost", f"{told} Cheapest first must bring at most half."
    return None
