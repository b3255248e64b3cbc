"""Choose a safe plan, based on the distances that `collision` measures. This module checks direct
motions and paths through via points; `posture_grid` checks the path that a search finds.

This is the control system of source 003: it plans the direct motion, a path through two via points,
or a path found by a search.
"""

from contextlib import suppress
from dataclasses import dataclass
from typing import cast

import numpy as np

from ..._arrays import ArrayLike, Floats, Sealed, frozen
from ..._validate import choice, floats, instance, length, short, text
from ...arms.planar import ThreeLeverArm
from ...units import deg, in_words
from .arguments import read_angles, read_obstacles, read_path, read_point, read_posture, read_start
from .collision import LEVERS, TOLERANCE, lever_distances, motion_clearances
from .posture_grid import STEP, way_round

WAYS = ("direct", "via points", "wait", "search", "none")
# Radii of the circles around H on which via points are tried, in lever lengths. With the document's
# radius, 1/7, the path comes nearer than 1/7 to H; with a larger radius, it may stay that far away.
CIRCLES = (1 / 7, 0.16, 0.18, 0.20, 0.225, 0.25)


# --- The document's path around H: two via points for the gripper ---------------------------------


def via_points(K: ArrayLike, K1: ArrayLike, H: ArrayLike, radius: float) -> Floats:
    """The via points K2 and K3, (2, 2): the points of the circle around H on the perpendiculars to
    KH and K1H, on the side of the base. Source: 003, III.3.2, figure 26.

    The printed formulas (40), (41) and table 6 swap two legs: their points lie on the circle, but
    not on the perpendiculars, and can be on either side (errata S3-m). Raises ValueError if H
    coincides with K or K1, since a direction is then undefined.
    """
    K, K1, H = read_point(K, "K"), read_point(K1, "K1"), read_point(H, "H")
    radius = length(radius, "radius")
    points: Floats = H + radius * _square(K, K1, H)
    return points


def via_path(
    arm: ThreeLeverArm,
    q0: ArrayLike,
    target: ArrayLike,
    H: ArrayLike,
    radius: float | None = None,
    limited: bool = True,
) -> Floats:
    """The path K - K2 - K3 - K1 with the least movement on each part: (4, 3), with NaN from the
    first point that is out of reach. The radius is L/7 by default. Source: 003, IV.

    A path through K2 and K3 guarantees nothing about the motion between them, nor about the levers
    (errata S3-n): see `clearance`.
    """
    instance(arm, ThreeLeverArm, "arm")
    q0, K1, H = read_posture(q0, "q0"), read_point(target, "target"), read_point(H, "H")
    if not isinstance(limited, bool):
        raise ValueError(f"limited: wanted True or False, got {short(limited)}")
    radius = arm.lever / 7 if radius is None else length(radius, "radius")
    (path,) = _via_paths(arm, q0, K1, H, np.array([radius]), limited)
    return cast(Floats, path)


# --- The control system ---------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Plan(Sealed):
    """The result of `plan`.

    way        "direct", "via points", "search", or "none"; also "wait" if the obstacle moves
    words      sentences that describe the result
    path       (k, 3) postures, beginning with the start; (1, 3) if no path was found and the arm
               does not move
    clearance  (k - 1, 3) smallest distance of the levers OB, BA, AK from the obstacle on each part;
               inf without an obstacle
    least      S of the direct motion in radians, a lower bound for all paths; NaN if the target is
               out of reach
    radius     radius of the circle around the obstacle on which the via points lie, in metres; NaN
               for all other ways

    Arrays are read-only copies. Raises ValueError if the parts do not match.
    """

    way: str
    words: str
    path: Floats
    clearance: Floats
    least: float
    radius: float = np.nan

    def __post_init__(self) -> None:
        choice(self.way, "way", WAYS)
        text(self.words, "words")
        path = read_angles(self.path, "path")
        if path.ndim != 2 or not len(path) or (len(path) > 1) != self.found:
            wanted = "two or more postures (k, 3)" if self.found else "the start (1, 3)"
            raise ValueError(f"path: wanted {wanted} for way {self.way!r}, got shape {path.shape}")
        finite = self.clearance
        with suppress(ValueError):  # inf is a valid distance here, but `floats` refuses it
            finite = np.nan_to_num(finite, nan=np.nan, posinf=0.0)
        known = floats(finite, "clearance", 3)
        if known.shape != (len(path) - 1, 3) or (known < 0).any():
            raise ValueError(
                f"clearance: wanted distances ({len(path) - 1}, 3), got {short(self.clearance)}"
            )
        least = floats(self.least, "least", finite=False)
        if least.ndim or least < 0:
            raise ValueError(f"least: wanted one sum of angle changes, got {short(self.least)}")
        radius = floats(self.radius, "radius", finite=False)
        if radius.ndim or np.isnan(radius) == (self.way == "via points") or radius <= 0:
            wanted = "wanted one length for way 'via points' and NaN for all other ways"
            raise ValueError(f"radius: {wanted}, got {short(self.radius)} for {self.way!r}")
        object.__setattr__(self, "radius", float(radius))
        object.__setattr__(self, "path", frozen(path))
        object.__setattr__(self, "clearance", frozen(np.asarray(self.clearance, dtype=float)))
        object.__setattr__(self, "least", float(least))

    @property
    def found(self) -> bool:
        """Whether there is a path that keeps the clearance."""
        return self.way != "none"

    @property
    def cost(self) -> float:
        """S of the path, in radians."""
        return float(abs(np.diff(self.path, axis=0)).sum())

    @property
    def posture(self) -> Floats:
        """The final posture (3,) of the arm: the start of the next task."""
        posture: Floats = self.path[-1]
        return posture

    @property
    def via(self) -> Floats:
        """The postures (k - 2, 3) between start and end."""
        return self.path[1:-1]


def plan(
    arm: ThreeLeverArm,
    posture: ArrayLike,
    target: ArrayLike,
    obstacle: ArrayLike | None = None,
    distance: float | None = None,
) -> Plan:
    """The control system of source 003 (figure 33): plan from the current posture (3,) to the
    target, past the obstacle.

    Along the whole path, all levers stay at least `distance` (in metres; L/7 by default) away from
    the obstacle, or the plan says that no such path was found. The ways are tried in this order:
    the direct motion with the least movement; the document's via points K2, K3 on the smallest
    circle for which the path keeps the distance (its radius is the distance or L/7, whichever is
    greater, or a greater one from `CIRCLES`); a search among postures. Angles stay between 0 and
    180 degrees. Raises ValueError if the posture is outside these limits.

    With several obstacles (m, 2), the path keeps clear of all of them; the via points lie around
    the first one that is in the way.
    """
    instance(arm, ThreeLeverArm, "arm")
    start, K1 = read_start(arm, posture, "posture"), read_point(target, "target")
    distance = arm.lever / 7 if distance is None else length(distance, "distance")
    H = None if obstacle is None else read_obstacles(obstacle, "obstacle")
    unreached = arm.out_of_reach(K1)
    if unreached:
        return no_plan(start, f"The target is outside the allowed reach: {unreached}.")
    goal, S = arm.least(K1, start)
    least = float(S)
    direct = np.stack([start, goal])
    if H is None:
        far = np.full((1, 3), np.inf)
        words = "The direct motion is clear: no obstacle is given."
        return Plan("direct", words, direct, far, least)
    too_near = _too_near(arm, start, K1, H, distance)
    if too_near:
        hint = f"No path keeps a distance of {in_words(distance)}; ask for a smaller one."
        return no_plan(start, f"{too_near} {hint}", least)
    clear = motion_clearances(arm, start[None], goal[None], H)
    if clear.min() >= distance:
        none = "the obstacle is not" if len(H) == 1 else "no obstacle is"
        words = f"The direct motion is clear: {none} in its way."
        return Plan("direct", words, direct, clear, least)
    words = f"In the direct motion, {_nearest(arm, clear, H)}."
    by_points = best_circle(arm, direct, K1, H, distance)
    if by_points is None:
        words += " The via points K2 and K3 are not both within the allowed reach."
    else:
        path, clear, radius = by_points
        named = _named(H, _in_the_way(arm, direct, H, distance))
        circle = f"the via points K2 and K3, {in_words(radius)} from {named}"
        if clear.min() >= distance:
            words += f" T{circle[1:]}, lead round it."
            return Plan("via points", words, path, clear, least, radius)
        words += f" Through {circle}, {_nearest(arm, clear, H)}."
    found = way_round(arm, start, K1, H[:, 0], distance)
    if found is not None:
        words += " A search among postures finds a path."
        clear = motion_clearances(arm, found[:-1], found[1:], H)
        return Plan("search", words, found, clear, least)
    words += f" A search among postures in steps of {STEP / deg:.0f}° finds no path that keeps"
    return no_plan(start, f"{words} {in_words(distance)}.", least)


def along(path: ArrayLike, s: ArrayLike) -> Floats:
    """Postures on a path (k, 3) at the fractions s (...) of its S, from 0 to 1: (..., 3), for
    figures and players. For s outside 0 to 1, the result is an end of the path.
    """
    path, s = read_path(path), np.clip(floats(s, "s"), 0, 1)
    S = np.concatenate([[0.0], abs(np.diff(path, axis=0)).sum(axis=-1).cumsum()])
    return np.stack([np.interp(s * S[-1], S, path[:, i]) for i in range(3)], axis=-1)


def best_circle(
    arm: ThreeLeverArm, direct: Floats, K1: Floats, H: Floats, distance: float
) -> tuple[Floats, Floats, float] | None:
    """Return the path through via points on the first circle for which it keeps the distance, or
    otherwise on the circle that leaves the most room, with its clearance and the radius; None if no
    circle has both via points within reach. `direct` (2, 3) is the direct motion. The circles are
    around the first of the obstacles H (m, 1, 2) that is in its way.
    """
    first = _in_the_way(arm, direct, H, distance)
    radii = np.array([each for each in CIRCLES if each * arm.lever > distance]) * arm.lever
    radii = np.unique(np.append(radii, max(distance, CIRCLES[0] * arm.lever)))
    paths = _via_paths(arm, direct[0], K1, H[first, 0], radii)
    reached = ~np.isnan(paths).any(axis=(1, 2))
    if not reached.any():
        return None
    paths, radii = paths[reached], radii[reached]
    clears = motion_clearances(arm, paths[:, :-1].reshape(-1, 3), paths[:, 1:].reshape(-1, 3), H)
    clears = clears.reshape(-1, 3, 3)
    room = clears.min(axis=(1, 2))
    best = int((room >= distance).argmax() if room.max() >= distance else room.argmax())
    return paths[best], clears[best], float(radii[best])


def no_plan(start: Floats, words: str, least: float = np.nan) -> Plan:
    """A plan without a path; its `words` give the reason."""
    return Plan("none", words, start[None], np.empty((0, 3)), least)


# --- Private helpers ------------------------------------------------------------------------------


def _too_near(arm: ThreeLeverArm, start: Floats, K1: Floats, H: Floats, distance: float) -> str:
    """Return a sentence that says why no path can keep the distance, or "" if a path could."""
    O_H, K1_H = np.hypot(*H[:, 0].T), np.hypot(*(K1 - H[:, 0]).T)
    q_H = lever_distances(arm, start, H)[:, 0]  # (m, 3)
    if O_H.min() < distance:
        name = _named(H, int(O_H.argmin())).capitalize()
        return f"{name} lies {in_words(O_H.min())} from the base."
    if q_H.min() < distance:
        which, lever = np.unravel_index(q_H.argmin(), q_H.shape)
        return (
            f"At the start lever {LEVERS[lever]} is already {in_words(q_H.min())} from "
            f"{_named(H, int(which))}."
        )
    if K1_H.min() < distance:
        return f"The target lies {in_words(K1_H.min())} from {_named(H, int(K1_H.argmin()))}."
    return ""


def _named(H: Floats, which: int) -> str:
    return "the obstacle" if len(H) == 1 else f"obstacle {which + 1}"


def _nearest(arm: ThreeLeverArm, clear: Floats, H: Floats) -> str:
    least = clear.min(axis=0)
    # if two levers are equally near, at their common joint, take the first
    lever = LEVERS[(least <= least.min() + TOLERANCE * arm.lever).argmax()]
    what = "the obstacle" if len(H) == 1 else "an obstacle"
    if not least.min():
        return f"lever {lever} hits {what}"
    return f"lever {lever} comes within {in_words(least.min())} of {what}"


def _in_the_way(arm: ThreeLeverArm, direct: Floats, H: Floats, distance: float) -> int:
    """The index of the first obstacle that blocks the path, or of the nearest one if none does. The
    path is sampled, so an obstacle may be missed.
    """
    near = lever_distances(arm, along(direct, np.linspace(0, 1, 100)), H).min(axis=-1)  # (m, 100)
    first = np.where((near < distance).any(axis=1), (near < distance).argmax(axis=1), near.shape[1])
    return int(np.lexsort((near.min(axis=1), first))[0])


def _square(K: Floats, K1: Floats, H: Floats) -> Floats:
    """The directions (2, 2) from H to K2 and to K3."""
    directions = []
    for name, end in (("K", K), ("K1", K1)):
        x, y = end - H
        if np.hypot(x, y) == 0:
            raise ValueError(
                f"H: wanted an obstacle different from {name}, got both at {H.tolist()}"
            )
        square = np.array([-y, x]) / np.hypot(x, y)
        directions.append(square * (-1.0 if square @ H > 0 else 1.0))
    return np.stack(directions)


def _via_paths(
    arm: ThreeLeverArm, q0: Floats, K1: Floats, H: Floats, radii: Floats, limited: bool = True
) -> Floats:
    """`via_path` for each of the radii (r,): (r, 4, 3)."""
    K2, K3 = np.moveaxis(H + radii[:, None, None] * _square(arm.points(q0)[3], K1, H), 1, 0)
    path = [np.tile(q0, (len(radii), 1))]
    for points in (K2, K3, np.tile(K1, (len(radii), 1))):
        known = ~np.isnan(path[-1]).any(axis=-1, keepdims=True)
        reached = arm.least(points, np.where(known, path[-1], q0), limited)[0]
        path.append(np.where(known, reached, np.nan))
    return np.stack(path, axis=1)
