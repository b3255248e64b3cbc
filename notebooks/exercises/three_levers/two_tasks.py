"""Two tasks at once: a student's numbers, and the faults of a plan of two postures."""

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np

from robokin import deg
from robokin.arms.branches import within
from robokin.course.exercises import in_words
from robokin.course.slips import DEGREES
from robokin.course.told import apart, floats
from robokin.course.variants import Numbers, dice

from .shared import ARM

UNITS = {
    **dict.fromkeys(("gamma", "beta", "alpha"), ("°, where the arm stands", deg)),
    **dict.fromkeys(("x_first", "y_first", "x_second", "y_second"), ("m", 1.0)),
    "most": ("° of movement in total", deg),
    "longest": ("° of the largest turns, both tasks", deg),
}
NAMES, COUNT, EASE = ("first", "second"), 4, 1e-6
Fault = tuple[str, str]
Given = Mapping[str, Any]


def places(given: Given) -> list[Any]:
    """The two targets, each (2,)."""
    return [np.array([given[f"x_{name}"], given[f"y_{name}"]]) for name in NAMES]


def start(given: Given) -> Any:
    """The start posture of the arm."""
    return np.array([given[name] for name in ("gamma", "beta", "alpha")])


def changes(given: Given, postures: Any) -> tuple[Any, Any]:
    """How far each joint turns in both tasks (..., 3)."""
    return abs(postures[0] - start(given)), abs(postures[1] - postures[0])


def greedy(given: Given) -> tuple[Any, Any]:
    """The postures with the least S, task by task."""
    first, second = places(given)
    one = ARM.least(first, start(given))[0]
    return one, ARM.least(second, one)[0]


@cache
def drawn(who: str) -> Numbers:
    roll = dice("three_levers", who)
    while True:  # at least a tenth of the draws are suitable
        angles = ("gamma", 50, 13), ("beta", 90, 10), ("alpha", 90, 10)
        numbers = {name: (low + 5 * roll.randrange(count)) * deg for name, low, count in angles}
        for name, low, count in (("first", 0, 9), ("second", 125, 6)):
            r = 2.1 + 0.05 * roll.randrange(12)
            phi = (low + 5 * roll.randrange(count)) * deg
            numbers[f"x_{name}"] = round(float(r * np.cos(phi)), 1)
            numbers[f"y_{name}"] = round(float(r * np.sin(phi)), 1)
        targets = np.array(places(numbers))
        ranges = ARM.alpha_range(targets)
        if np.isnan(ranges).any():
            continue
        one, two = ARM.family(targets[:, None], np.linspace(*ranges, 181, axis=-1))
        d1, d2 = changes(numbers, (one[:, None], two))
        S, longest = (d1.sum(-1) + d2.sum(-1)) / deg, (d1.max(-1) + d2.max(-1)) / deg
        greed = sum(float(d.sum()) for d in changes(numbers, greedy(numbers))) / deg
        if greed >= 1.1 * S.min():
            most = float(np.ceil(S.min() + 0.4 * (greed - S.min())))
            numbers["most"] = most * deg
            numbers["longest"] = float(np.ceil(1.08 * longest[most >= S].min())) * deg
            return Numbers(numbers, UNITS)


def given(who: Any) -> Numbers:
    """A posture, two targets and two limits. Least movement task by task exceeds the first limit;
    some pairs of postures on a grid of 1° keep within both.
    """
    return Numbers(dict(drawn(str(who))), UNITS)


def form(answer: Any, given: Given) -> Any:
    """Return two alphas in radians. ValueError: another kind of answer."""
    wanted = 'Wanted a dict {"first": ..., "second": ...} with two alphas in radians, got '
    if isinstance(answer, Mapping):
        missing = [key for key in NAMES if key not in answer]
        if missing:
            raise ValueError(f"Your dict has no {' and no '.join(map(repr, missing))}.")
        answer = [answer[key] for key in NAMES]
    wanted += in_words(answer)
    try:
        alphas = floats(answer).ravel()
    except (TypeError, ValueError):
        alphas = np.empty(0)
    if alphas.shape != (2,):
        says = "; alpha alone determines the posture" if alphas.size == 6 else ""
        raise ValueError(f"{wanted}{says}.")
    if not np.isfinite(alphas).all():
        raise ValueError(f"{wanted}: a number is missing.")
    return alphas


def faults(alphas: Any, given: Given) -> list[Fault]:
    """What is wrong: a missing posture, gamma past a limit, too much movement, or too slow."""
    if (alphas > 2 * np.pi).any():
        return [("degrees for radians", DEGREES)] * COUNT
    if (alphas < 2 * np.pi * deg).all() and (alphas > 0).all():
        told = " and ".join(f"{alpha / deg:.2g}°" for alpha in alphas)
        return [("deg twice", f"Your alphas are {told}; an alpha of 120° is 120 * deg.")] * COUNT
    found = of_a_plan(alphas, given)
    if found and not of_a_plan(alphas[::-1], given):
        says = "Swap your two alphas, and the plan works: the first alpha is for the first target."
        found.insert(0, ("the two alphas swapped", says))
    return found


def of_a_plan(alphas: Any, given: Given) -> list[Fault]:
    targets, found = places(given), []
    postures = ARM.family(targets, alphas)
    if np.isnan(postures).any():
        gone = [
            out_of_range(name, target, alpha / deg)
            for name, target, alpha, q in zip(NAMES, targets, alphas, postures, strict=True)
            if np.isnan(q).any()
        ]
        if np.isfinite(ARM.family(targets, alphas[::-1])).all():
            gone.append("Swap your two alphas, and both postures exist.")
        return [("alpha outside its range", " ".join(gone))] * COUNT
    for name, q in zip(NAMES, postures, strict=True):
        if not within(ARM, q).all():
            says = (
                f"At the {name} target gamma would be {q[0] / deg:.2f}°; it can go from 0° to "
                "180°. gamma grows with alpha, so choose a smaller alpha."
            )
            found.append((f"gamma past its limit at the {name} target", says))
    return found + beyond(*changes(given, postures), postures, given)


def out_of_range(name: str, target: Any, alpha: float) -> str:
    """The sentence that no posture has this alpha, which is in degrees."""
    low, high = (float(x) / deg for x in ARM.alpha_range(target, limited=False))
    is_at, edge = apart(alpha, low if alpha < low else high, 2)
    ends = f"{edge}° to {high:.2f}°" if alpha < low else f"{low:.2f}° to {edge}°"
    return f"No posture reaches the {name} target with alpha = {is_at}°: alpha can go from {ends}."


def beyond(one: Any, two: Any, postures: Any, given: Given) -> list[Fault]:
    """The limits that are exceeded, from the rotation of each joint in both tasks."""
    found = []
    if (S := one.sum() + two.sum()) > given["most"] + EASE:
        turned, allowed = apart(S / deg, given["most"] / deg)
        says = (
            f"Together the joints turn by {one.sum() / deg:.1f}° and {two.sum() / deg:.1f}°, "
            f"{turned}° in total; {allowed}° are allowed."
        )
        again = abs(postures[1] - start(given)).sum()
        if one.sum() + again <= given["most"] + EASE:
            says += (
                f" From the start posture the second task would be {again / deg:.1f}°, but it "
                "begins where the first one ended."
            )
        greed = abs(postures - greedy(given))[:, 2].max() < 0.2 * deg
        if greed:
            says += " Each task by itself has the least movement. Look ahead to the second task."
        found.append(("greed" if greed else "too much movement", says))
    if (longest := one.max() + two.max()) > given["longest"] + EASE:
        turned, allowed = apart(longest / deg, given["longest"] / deg)
        says = (
            f"The largest turns of a motor are {one.max() / deg:.1f}° and {two.max() / deg:.1f}°, "
            f"{turned}° in total; {allowed}° are allowed."
        )
        busiest = (one + two).max()
        if busiest <= given["longest"] + EASE:
            says += (
                f" No motor turns by more than {busiest / deg:.1f}° in both tasks together, but "
                "each task takes as long as its own largest turn."
            )
        found.append(("too slow", says))
    return found
