"""Numbers, conditions and sentences of exercise 2; its text is in the Markdown file beside it."""

from collections.abc import Mapping
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from robokin import deg, mm
from robokin.course.exercises import in_words
from robokin.course.slips import DEGREES
from robokin.course.told import apart, floats
from robokin.course.variants import Numbers, dice, normalised
from robokin.jobs.obstacles import along, clearance, way_round

from .shared import ARM, Floats, direct, distances

COUNT = 7
KEPT = 0.1  # m: the distance that the exercise asks for
MOST = 8  # points of the bar for the proof: so few that their gaps matter
TOLERANCE = 1e-5  # m: by how much the distance may be less, for rounding errors
BETWEEN = 0.02  # m: between the measured points of the bar; the distance is then exact to 0.5 mm
UNITS = {
    **dict.fromkeys(("gamma", "beta", "alpha"), ("°, where the arm stands", deg)),
    "target": ("m", 1.0),
    "bar": ("m, its two ends", 1.0),
    "distance": ("mm", mm),
    "most": ("° of movement S at most", deg),
}


def given(who: Any) -> Numbers:
    """A start, a target, and a bar in between, far enough out for the folded arm."""
    return Numbers(dict(task(normalised(who))), UNITS)


@cache
def task(who: str) -> dict[str, Any]:
    """The numbers of `given`: drawn until folding keeps the distance, which evenly spaced points
    prove, the bar's ends alone do not suffice, and `way_round` gets past the bar only if it is
    asked for more than the distance.
    """
    roll = dice("obstacle_avoidance", who)
    while True:
        start = np.array([100 + 5 * roll.randrange(7), 110 + 5 * roll.randrange(7), 120.0])
        start[2] += 5 * roll.randrange(5)
        around, out = (10 + 5 * roll.randrange(5)) * deg, 1.8 + 0.1 * roll.randrange(6)
        target = np.round([out * np.cos(around), out * np.sin(around)], 2)
        straight = direct(start * deg, target)
        if np.isnan(straight).any():
            continue
        A, K_ = ARM.points(along(straight, 0.3 + 0.1 * roll.randrange(4)))[2:]
        first = np.round(A + (0.4 + 0.1 * roll.randrange(5)) * (K_ - A), 2)
        far, angle = 1.2 + 0.05 * roll.randrange(19), (40 + 5 * roll.randrange(8)) * deg
        bar = np.stack([first, np.round([far * np.cos(angle), far * np.sin(angle)], 2)])
        places = points_of(bar)
        room = [np.hypot(*places.T) - 1.1, np.hypot(*(places - target).T) - 0.15]
        room += [distances(start[None] * deg, place).min() - 0.15 for place in places[::5]]
        if np.hypot(*(bar[1] - bar[0])) < 0.4 or min(map(np.min, room)) < 0:
            continue
        least = cheapest(start * deg, target, bar)
        if least is None or ends_are_enough(start * deg, target, bar):
            continue
        most = (10 * np.ceil(least / deg / 10) + 30) * deg
        if not gaps_matter(start * deg, target, bar, most):
            continue
        return {
            **dict(zip(("gamma", "beta", "alpha"), (start * deg).tolist(), strict=True)),
            "target": tuple(target.tolist()),
            "bar": tuple(tuple(end.tolist()) for end in bar),
            "distance": KEPT,
            "most": most,
        }


def points_of(ends: Any) -> Floats:
    """Points (m, 2) along a bar, including its ends."""
    first, last = np.asarray(ends)
    count = int(np.hypot(*(last - first)) / BETWEEN) + 2
    points: Floats = first + np.linspace(0, 1, count)[:, None] * (last - first)
    return points


def ends_are_enough(q0: Floats, target: Floats, bar: Floats) -> bool:
    """Whether a path that avoids only the ends of the bar keeps half of the distance from all of
    it.
    """
    path = way_round(ARM, q0, target, bar, KEPT)
    return path is not None and bool(clearance(ARM, path, points_of(bar)).min() > KEPT / 2)


def gaps_matter(q0: Floats, target: Floats, bar: Floats, most: float) -> bool:
    """Whether a path of `way_round` past evenly spaced points proves the distance if it is asked
    for what half a gap adds to it, and does not if it is asked for the distance alone.
    """
    few = evenly(bar)
    half = float(np.hypot(*(few[1] - few[0]))) / 2
    path = way_round(ARM, q0, target, few, KEPT)
    if path is not None and proven(path, few)[2] >= KEPT - TOLERANCE:
        return False
    path = way_round(ARM, q0, target, few, float(np.hypot(KEPT, half)))
    return path is not None and bool(abs(np.diff(path, axis=0)).sum() <= most)


def evenly(bar: Floats) -> Floats:
    """As many evenly spaced points of the bar, with its ends, as the proof may use."""
    points: Floats = bar[0] + np.linspace(0, 1, MOST)[:, None] * (bar[1] - bar[0])
    return points


def cheapest(q0: Floats, target: Floats, bar: Floats) -> float | None:
    """The movement of the cheapest path of the kind fold, swing, unfold, among those of hint 2;
    None: none keeps the distance.
    """
    places, few = points_of(bar), evenly(bar)
    low, high = ARM.alpha_range(target)
    if not low < high:
        return None
    folds = np.array([(b, a) for b in (45, 75, 105) for a in (45, 75, 105)]) * deg
    paths = np.array(
        [
            [q0, [q0[0], *fold], [goal[0], *fold], goal]
            for goal in ARM.family(target, np.linspace(low, high, 5)[::2])
            for fold in folds
        ]
    )
    S = abs(np.diff(paths, axis=1)).sum(axis=(1, 2))
    far = np.ones(len(paths), dtype=bool)
    shares = np.linspace(0, 1, 16)[:, None]
    for k in range(3):
        a, b = paths[:, k, None], paths[:, k + 1, None]
        seen = (a + shares * (b - a)).reshape(-1, 3)
        for place in places[::4]:
            near = distances(seen, place).min(axis=-1).reshape(len(paths), -1)
            far &= near.min(axis=-1) >= KEPT + 0.03
            if not far.any():
                return None
    for path, cost in sorted(zip(paths[far], S[far], strict=True), key=lambda pair: pair[1]):
        if min(clearance(ARM, path, places).min(), proven(path, few)[2]) >= KEPT:
            return float(cost)
    return None


class Answer(NamedTuple):
    """A path (k, 3), and the points (m, 2) on the bar that prove its distance."""

    path: Floats
    points: Floats


def form(answer: Any, given: Mapping[str, Any]) -> Answer:
    """Return the answer in its parts. ValueError: a part is of another kind."""
    if not isinstance(answer, (tuple, list)) or len(answer) != 2:
        raise ValueError(f"wanted (my_path, my_points), got {in_words(answer)}")
    path, points = answer
    if path is None:
        line = "my_path is None: way_round found no path. Ask it for a smaller distance, or plan "
        raise ValueError(line + "by hand, as hint 2 says.")
    for name, part in (("my_path", path), ("my_points", points)):
        if part is ... or part is None:
            raise ValueError(f"{name} is missing: write it into its cell, then check again.")
    wanted = "my_path: wanted two or more postures (gamma, beta, alpha), (k, 3) radians"
    path = table(path, wanted, (3,), 2, 100)
    wanted = "my_points: wanted two or more points (x, y) on the bar, (m, 2) metres"
    return Answer(path, table(points, wanted, (2, 3), 2, MOST)[:, :2])


def table(answer: Any, wanted: str, widths: tuple[int, ...], least: int, most: int) -> Floats:
    """Return the answer as an array of rows. ValueError, which begins with `wanted`: it is none."""
    if isinstance(answer, (str, Mapping)):
        raise ValueError(f"{wanted}, got {in_words(answer)}")
    try:
        rows = floats([[x for x in row] for row in answer])
    except (TypeError, ValueError):
        raise ValueError(f"{wanted}, got {in_words(answer)}") from None
    if rows.ndim != 2 or rows.shape[1] not in widths or len(rows) < least:
        raise ValueError(f"{wanted}, got shape {rows.shape}")
    if not np.isfinite(rows).all():
        raise ValueError(f"{wanted}, got NaN in it")
    if len(rows) > most:
        raise ValueError(f"{wanted}, at most {most} of them, got {len(rows)}")
    return rows


def proven(path: Floats, points: Floats) -> tuple[float, float, float]:
    """Return the least distance d of the path from the points, the greatest gap h between two
    neighbours, and the distance from everything in between that they prove.
    """
    d = float(clearance(ARM, path, points).min())
    order = (points @ (points[-1] - points[0])).argsort()
    h = float(np.hypot(*np.diff(points[order], axis=0).T).max())
    return d, h, float(np.sqrt(max(0.0, d**2 - (h / 2) ** 2)))


def faults(answer: Answer, given: Mapping[str, Any]) -> list[tuple[str, str]]:
    """What is wrong with the start, the end at the target, the limits, the distance from the ends
    of the bar and from the part between them, the points that prove it, and the amount of movement.
    """
    path, points = answer
    start = np.array([given[name] for name in ("gamma", "beta", "alpha")])
    if abs(path).max() > 4 * np.pi:
        return [("degrees for radians", DEGREES)] * COUNT
    if abs(path).max() <= 2 * np.pi * deg:
        return [
            (
                "deg twice",
                "All your angles are at most 6°. Multiply by deg only once: 120° is 120 * deg.",
            )
        ] * COUNT
    found: list[tuple[str, str]] = []
    if abs(path[0] - start).max() > 1e-4:
        stands, got = apart(start / deg, path[0] / deg)
        says = f"The path begins at ({got})°, but the arm stands at ({stands})°."
        if abs(path[-1] - start).max() <= 1e-4:
            says += " That is where the path ends."
        elif abs(path[0, ::-1] - start).max() <= 1e-4:
            says += " These are its angles in the order alpha, beta, gamma."
        found.append(("another start", says))
    end = ARM.points(path[-1])[3]
    miss = float(np.hypot(*(end - given["target"])))
    if miss > 1 * mm:
        says = f"The gripper ends at ({end[0]:.3f}, {end[1]:.3f}) m, {miss / mm:.0f} mm from "
        found.append(("misses the target", says + f"the target {given['target']} m."))
    if (path < -1e-6).any() or (path > np.pi + 1e-6).any():
        i, j = np.argwhere((path < -1e-6) | (path > np.pi + 1e-6))[0]
        name = ("gamma", "beta", "alpha")[j]
        limit = 0.0 if path[i, j] < 0 else 180.0
        is_at = apart(path[i, j] / deg, limit)[0]
        says = f"Posture {i + 1}: {name} is {is_at}°, but it must be between 0 and 180°."
        found.append(("past a limit", says))
    bar = points_of(given["bar"])
    near = too_near(path, bar[[0, -1]], "the ends of the bar", given["distance"])
    near += too_near(path, bar[1:-1], "the bar between its ends", given["distance"])
    found += near or unproven(path, points, given)
    S = float(abs(np.diff(path, axis=0)).sum())
    if S > given["most"] + 1e-9:
        moved, most = apart(S / deg, given["most"] / deg)
        says = f"S is {moved}°, but you may spend at most {most}°."
        found.append(("too much movement", says))
    return found


def holds(answer: Answer, given: Mapping[str, Any]) -> tuple[str, ...]:
    """How much the points prove."""
    found = proven(*answer)[2] / mm
    return (f"Your {len(answer.points)} points prove {found:.1f} mm for the whole bar.",)


def unproven(path: Floats, points: Floats, given: Mapping[str, Any]) -> list[tuple[str, str]]:
    """The fault of points that do not prove that a path keeps the distance from the whole bar."""
    first, last = np.array(given["bar"])
    way = (last - first) / np.hypot(*(last - first))
    share = np.clip((points - first) @ way, 0, (last - first) @ way)
    off = np.hypot(*(first + share[:, None] * way - points).T)
    if off.max() > 1 * mm:
        x, y = points[off.argmax()]
        says = f"Your point ({x:.3f}, {y:.3f}) m is {off.max() / mm:.0f} mm from the bar."
        return [("points that are not on the bar", says)]
    for end in (first, last):
        gap = float(np.hypot(*(points - end).T).min())
        if gap > 1 * mm:
            says = f"Your points begin or end {gap / mm:.0f} mm from the end ({end[0]:g}, "
            return [("an end of the bar left out", says + f"{end[1]:g}) m of the bar.")]
    d, h, found = proven(path, points)
    if found >= given["distance"] - TOLERANCE:
        return []
    near, wanted = apart(found / mm, given["distance"] / mm, 0)
    closer = h > 1.01 * np.hypot(*(last - first)) / (MOST - 1)
    more = f"give at most {MOST} points that are closer together, or " if closer else ""
    says = (
        f"The levers stay d = {d / mm:.1f} mm away from your {len(points)} points, which are up to "
        f"h = {h / mm:.0f} mm apart. For the bar between them this proves only {near} mm; the task "
        f"asks for {wanted} mm. So the answer is still no: {more}ask for a path that stays farther "
        "away."
    )
    return [("not proven with these points", says)]


def too_near(path: Floats, places: Floats, name: str, distance: float) -> list[tuple[str, str]]:
    """The fault of a path that comes too near to these points of the bar."""
    turn = abs(np.diff(path, axis=0)).sum()
    if turn > 200:
        return [("too much movement", "The joints turn round and round.")]
    least = clearance(ARM, path, places)
    if least.min() >= distance - TOLERANCE:
        return []
    part, lever = np.unravel_index(least.argmin(), least.shape)
    near, wanted = apart(least.min() / mm, distance / mm, 0)
    points = ARM.points(along(path, np.linspace(0, 1, 501)))[:, 3]
    gripper = float(np.hypot(*(points[:, None] - places).T).min())
    corners = min(float(distances(path, place).min()) for place in places)
    says = (
        f"Between path[{part}] and path[{part + 1}], lever {('OB', 'BA', 'AK')[lever]} comes "
        f"within {near} mm of {name}; the task asks for {wanted} mm."
    )
    if corners >= distance:
        says += f" Every posture of the path stays {corners / mm:.0f} mm away: look between them."
        if gripper >= distance:
            says += " The gripper keeps this distance on the way, but a lever does not."
        return [(f"too near to {name} between two postures", says)]
    if gripper >= distance:
        says += " The gripper keeps this distance, but a lever does not."
        return [(f"the gripper keeps away from {name}, but a lever does not", says)]
    return [(f"too near to {name}", says)]
