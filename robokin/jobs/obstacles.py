"""The three-lever arm beside a point obstacle H: what lies in its way, via points, clearance, and a
way round.

`plan` is the control system of source 003, figure 33; the functions above it are its parts, in the
order in which it asks them. Names are the document's:

O, B, A, K    base, two joints and gripper of the arm before the motion; A1, K1 the same after it
H             the obstacle, a point; the levers OB, BA, AK have no width
K2, K3        via points for the gripper, on a circle about H
path (k, 3)   postures q = (gamma, beta, alpha) in radians; between two of them every joint turns
              evenly (PTP)
S             the sum of the changes of all joint angles along a path, in radians

Points are (2,), or (3,) with z = 0, in metres.
"""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from .._arrays import ArrayLike, Bools, Floats, Ints, frozen
from .._validate import broadcast, choice, floats, instance, length, short, text, warn_if_degrees
from ..arms.planar import ThreeLeverArm
from ..arms.two_link import two_link
from ..units import deg, in_words

LEVERS = ("OB", "BA", "AK")
WAYS = ("direct", "via points", "wait", "search", "none")
TOLERANCE = 1e-6  # of a lever's length: a clearance is known as well as this
CLOSE = 1e-9  # of a lever's length: `keeps` cannot tell distances apart that are nearer than this
# The via points' circles about H, in lever lengths. On the document's own, 1/7, the way keeps less
# than 1/7 from H; on a larger one it may keep that.
CIRCLES = (1 / 7, 0.16, 0.18, 0.20, 0.225, 0.25)
STEP = 5 * deg  # of the grid of postures in which `way_round` searches
# Of a lever's length, kept between the grid's postures and the clearance, tried in this order. One
# step of the first joint can move the gripper by 0.26 lever lengths: a small clearance needs the
# last margin, or steps jump over H.
MARGINS = (0.005, 0.03, 0.13)
SLACK = 1e-9  # past a limit by no more than this is rounding
FARTHEST = 1e9  # rad or m; beyond it a float does not hold an angle or a place well enough
WORK = 1_000_000  # stretches of motions, or postures of a grid, that one call may look at: 1 s
PORTION = 50_000  # stretches measured at a time, so that memory stays small


# --- Where is the obstacle? -----------------------------------------------------------------------


def in_quadrilateral(
    arm: ThreeLeverArm, q0: ArrayLike, q1: ArrayLike, H: ArrayLike
) -> dict[str, Bools]:
    """Does H (..., 2) lie in the quadrilaterals between the levers before and after the motion from
    q0 to q1?

    dict: "AK" for A K K1 A1, "BA" for B A A1 B1, each bool (...). The document tests the first
    only; its inequalities hold for its own drawing and fail for most others (errata S3-j, S3-k), so
    here a ray from H counts the sides it crosses. Straight sides are not what the levers sweep: see
    `swept`.
    """
    instance(arm, ThreeLeverArm, "arm")
    q0, q1, H = _posture(q0, "q0"), _posture(q1, "q1"), _points(H, "H")
    warn_if_degrees(q0, "q0", posture=1)
    warn_if_degrees(q1, "q1", posture=1)
    (_, B, A, K), (_, B1, A1, K1) = arm.points(q0), arm.points(q1)
    return {"BA": _inside(np.stack([B, A, A1, B1]), H), "AK": _inside(np.stack([A, K, K1, A1]), H)}


def swept(arm: ThreeLeverArm, q0: ArrayLike, q1: ArrayLike, H: ArrayLike) -> dict[str, bool]:
    """Which levers truly pass over H (2,) on the motion from q0 to q1? dict of lever -> bool."""
    instance(arm, ThreeLeverArm, "arm")
    q0, q1, H = _posture(q0, "q0"), _posture(q1, "q1"), _point(H, "H")
    warn_if_degrees(q0, "q0", posture=1)
    warn_if_degrees(q1, "q1", posture=1)
    least = _clearance(arm, np.stack([q0, q1]), H[None, None])[0]
    return dict(zip(LEVERS, (least <= 0).tolist(), strict=True))


def locate(P: ArrayLike, Q: ArrayLike, from_P: float, from_Q: float) -> Floats:
    """The places (2, 2) of an obstacle that two sensors, in the points P and Q, measure at these
    distances, in metres; NaN where the circles do not meet.

    The circles are the two arms that a two-link arm on P has to Q (`two_link`), and the obstacle
    its elbow: row 0 lies right of the way from P to Q, row 1 left of it. A third distance tells
    which. ValueError: P and Q in one point.
    """
    P, Q = _point(P, "P"), _point(Q, "Q")
    if (P == Q).all():
        raise ValueError(f"Q: wanted a point apart from P, got both at {P.tolist()}")
    from_P, from_Q = length(from_P, "from_P"), length(from_Q, "from_Q")
    q1 = two_link(from_P, from_Q, P).ik(Q)[:, :1]
    return P + from_P * np.concatenate([np.cos(q1), np.sin(q1)], axis=-1)


# --- How near does the arm come? ------------------------------------------------------------------


def distances(arm: ThreeLeverArm, q: ArrayLike, H: ArrayLike) -> Floats:
    """The distances of H (..., 2) from the levers OB, BA, AK in the postures q (..., 3): (..., 3),
    in metres.
    """
    instance(arm, ThreeLeverArm, "arm")
    q, H = _angles(q, "q", finite=False), _points(H, "H")
    warn_if_degrees(q, "q", posture=1)
    shape = broadcast("q and H", q.shape[:-1], H.shape[:-1])
    return _distances(arm, np.broadcast_to(q, (*shape, 3)), H)


def clearance(arm: ThreeLeverArm, path: ArrayLike, H: ArrayLike) -> Floats:
    """The least distance of every lever from H along a path (k, 3): (k - 1, 3), one row for every
    part. H is one obstacle (2,), or several (m, 2): then the least over all of them.

    Not a sample but a bound: the arm comes nowhere nearer, and at some place at most `TOLERANCE`
    lever lengths farther; 0 where a lever passes over H. It is found by halving those stretches of
    a part which could still hold a smaller distance. ValueError: a path that takes more than `WORK`
    stretches.
    """
    instance(arm, ThreeLeverArm, "arm")
    path, H = _path(path), _obstacles(H, "H")
    warn_if_degrees(path, "path", posture=1)
    return _clearance(arm, path, H)


def keeps(arm: ThreeLeverArm, a: ArrayLike, b: ArrayLike, H: ArrayLike, distance: float) -> Bools:
    """Do all levers keep this distance (metres) from H, one obstacle (2,) or several (m, 2), on the
    motions from postures a (..., 3) to b (..., 3)? bool (...).

    As certain as `clearance` and quicker, since a motion is given up at the first stretch that is
    too near. One that comes to the distance within 1e-9 of a lever's length may count as too near.
    ValueError: motions that take more than `WORK` stretches.
    """
    instance(arm, ThreeLeverArm, "arm")
    a, b = _angles(a, "a"), _angles(b, "b")
    H, distance = _obstacles(H, "H"), length(distance, "distance")
    warn_if_degrees(a, "a", posture=1)
    warn_if_degrees(b, "b", posture=1)
    shape = broadcast("a and b", a.shape, b.shape)
    a, b = (np.broadcast_to(q, shape).reshape(-1, 3) for q in (a, b))
    return _keeps(arm, a, b, H, distance).reshape(shape[:-1])


# --- The document's way round: two via points for the gripper -------------------------------------


def via_points(K: ArrayLike, K1: ArrayLike, H: ArrayLike, radius: float) -> Floats:
    """The via points K2 and K3, (2, 2): on the circle about H, where the lines square to KH and to
    K1H leave it on the side of the base. Source: 003, III.3.2, figure 26.

    The printed formulas (40), (41) and table 6 swap two legs: their points lie on the circle, but
    not square to the line, and on either side (errata S3-m). ValueError: H in K or K1, where there
    is no line.
    """
    K, K1, H, radius = _point(K, "K"), _point(K1, "K1"), _point(H, "H"), length(radius, "radius")
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
    """The path K - K2 - K3 - K1 with the least movement for each part: (4, 3), NaN from the first
    point that is out of reach on. The radius is L/7 unless given. Source: 003, IV.

    Passing K2 and K3 promises nothing about the way between them, nor about the levers (errata
    S3-n): see `clearance`.
    """
    instance(arm, ThreeLeverArm, "arm")
    q0, K1, H = _posture(q0, "q0"), _point(target, "target"), _point(H, "H")
    if not isinstance(limited, bool):
        raise ValueError(f"limited: wanted True or False, got {short(limited)}")
    radius = arm.lever / 7 if radius is None else length(radius, "radius")
    (path,) = _via_paths(arm, q0, K1, H, np.array([radius]), limited)
    return cast(Floats, path)


# --- A better way round: search among postures ----------------------------------------------------


def way_round(
    arm: ThreeLeverArm, q0: ArrayLike, target: ArrayLike, H: ArrayLike, distance: float
) -> Floats | None:
    """A path (k, 3) from posture q0 to the target, with little movement, on which all levers keep
    the distance from H, one obstacle (2,) or several (m, 2); None if none is found.

    The postures (gamma, beta, alpha) fill a cube of 180 degrees a side, in which the target is a
    curve: its `family`. From q0 a wave spreads through the grid of those postures that keep the
    distance, one joint by one step at a time, so that it arrives at each with the least S. It is
    followed back from the place of the curve that it reaches with the least S; then corners that
    are not needed are cut. Every part of the path is checked by `keeps`. The grid is 5 degrees
    wide: a passage narrower than that can be missed. ValueError: a posture q0 outside the limits.
    """
    instance(arm, ThreeLeverArm, "arm")
    q0, K1, H = _start(arm, q0, "q0"), _point(target, "target"), _obstacles(H, "H")
    return _way_round(arm, q0, K1, H, length(distance, "distance"))


# --- The control system ---------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Plan:
    """What `plan` answers.

    way        "direct", "via points", "search", or "none"; "wait" where the obstacle moves
    words      the answer in sentences
    path       (k, 3) postures, the first being the start; (1, 3) if nothing was found: the arm
               stays
    clearance  (k - 1, 3) least distance of the levers OB, BA, AK from the obstacle on every part;
               inf without one
    least      S of the direct motion in radians, which no path can undercut; NaN if the target is
               out of reach
    radius     of the circle about the obstacle on which the via points lie, in metres; NaN if it is
               not by via points that the plan goes

    Arrays are read-only copies. ValueError: parts that do not belong together.
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
        path = _angles(self.path, "path")
        if path.ndim != 2 or not len(path) or (len(path) > 1) != self.found:
            wanted = "two or more postures (k, 3)" if self.found else "the start (1, 3)"
            raise ValueError(f"path: wanted {wanted} of way {self.way!r}, got shape {path.shape}")
        finite = self.clearance
        with suppress(ValueError):  # inf is a distance here, and to `floats` it is none
            finite = np.nan_to_num(finite, nan=np.nan, posinf=0.0)
        known = floats(finite, "clearance", 3)
        if known.shape != (len(path) - 1, 3) or (known < 0).any():
            raise ValueError(
                f"clearance: wanted distances ({len(path) - 1}, 3), got {short(self.clearance)}"
            )
        least = floats(self.least, "least", finite=False)
        if least.ndim or least < 0:
            raise ValueError(f"least: wanted one sum of changes, got {short(self.least)}")
        radius = floats(self.radius, "radius", finite=False)
        if radius.ndim or np.isnan(radius) == (self.way == "via points") or radius <= 0:
            wanted = f"wanted one length with way 'via points' alone, here {self.way!r}"
            raise ValueError(f"radius: {wanted}, got {short(self.radius)}")
        object.__setattr__(self, "radius", float(radius))
        object.__setattr__(self, "path", frozen(path))
        object.__setattr__(self, "clearance", frozen(np.asarray(self.clearance, dtype=float)))
        object.__setattr__(self, "least", float(least))

    @property
    def found(self) -> bool:
        """Is there a path that keeps the clearance?"""
        return self.way != "none"

    @property
    def cost(self) -> float:
        """S of the path, in radians."""
        return float(abs(np.diff(self.path, axis=0)).sum())

    @property
    def posture(self) -> Floats:
        """The posture (3,) in which the arm stands afterwards: remembered for the next task."""
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
    """The control system of source 003 (figure 33): from the remembered posture (3,) to the target,
    past the obstacle.

    All levers keep `distance` (metres; L/7 unless given) from the obstacle along the whole path, or
    the plan says in words that none was found. Tried in this order: the direct motion with least
    movement; the document's via points K2, K3 on circles of `CIRCLES` lever lengths, none smaller
    than the distance or than L/7, of which the first that keeps the distance is taken; a search
    among postures. Angles stay within 0 to 180 degrees. ValueError: a posture outside.

    Of several obstacles (m, 2) all are kept clear of; the via points lie about the one that is in
    the way first.
    """
    instance(arm, ThreeLeverArm, "arm")
    start, K1 = _start(arm, posture, "posture"), _point(target, "target")
    distance = arm.lever / 7 if distance is None else length(distance, "distance")
    H = None if obstacle is None else _obstacles(obstacle, "obstacle")
    unreached = arm.out_of_reach(K1)
    if unreached:
        return _none(start, f"The target is out of reach: {unreached}.")
    goal, S = arm.least(K1, start)
    least = float(S)
    direct = np.stack([start, goal])
    if H is None:
        far = np.full((1, 3), np.inf)
        return Plan("direct", "The way is direct: no obstacle is given.", direct, far, least)
    too_near = _too_near(arm, start, K1, H, distance)
    if too_near:
        hint = f"No path keeps {in_words(distance)}; a smaller distance may be asked for."
        return _none(start, f"{too_near} {hint}", least)
    clear = _clearance(arm, direct, H)
    if clear.min() >= distance:
        none = "the obstacle is not" if len(H) == 1 else "no obstacle is"
        return Plan("direct", f"The way is direct: {none} in it.", direct, clear, least)
    words = f"On the direct way {_nearest(arm, clear, H)}."
    first = _in_the_way(arm, direct, H, distance)
    radii = np.array([each for each in CIRCLES if each * arm.lever > distance]) * arm.lever
    radii = np.unique(np.append(radii, max(distance, CIRCLES[0] * arm.lever)))
    paths = _via_paths(arm, start, K1, H[first, 0], radii)
    reached = ~np.isnan(paths).any(axis=(1, 2))
    if not reached.any():
        words += " The via points K2 and K3 are not both within reach."
    else:
        paths, radii = paths[reached], radii[reached]
        clears = _clearances(arm, paths[:, :-1].reshape(-1, 3), paths[:, 1:].reshape(-1, 3), H)
        clears = clears.reshape(-1, 3, 3)
        room = clears.min(axis=(1, 2))
        best = int((room >= distance).argmax() if room.max() >= distance else room.argmax())
        radius = float(radii[best])
        circle = f"the via points K2 and K3, {in_words(radius)} from {_named(H, first)}"
        if room[best] >= distance:
            words += f" T{circle[1:]}, lead round it."
            return Plan("via points", words, paths[best], clears[best], least, radius)
        words += f" By {circle}, {_nearest(arm, clears[best], H)}."
    by_search = _way_round(arm, start, K1, H, distance)
    if by_search is not None:
        words += " A search among postures finds a way."
        return Plan("search", words, by_search, _clearance(arm, by_search, H), least)
    words += f" A search among postures in steps of {STEP / deg:.0f}° finds no way that keeps"
    return _none(start, f"{words} {in_words(distance)}.", least)


def along(path: ArrayLike, s: ArrayLike) -> Floats:
    """Postures on a path (k, 3) at the shares s (...) of its S, from 0 to 1: (..., 3), for figures
    and players. Before and after, the path's ends.
    """
    path, s = _path(path), np.clip(floats(s, "s"), 0, 1)
    S = np.concatenate([[0.0], abs(np.diff(path, axis=0)).sum(axis=-1).cumsum()])
    return np.stack([np.interp(s * S[-1], S, path[:, i]) for i in range(3)], axis=-1)


# --- Private helpers ------------------------------------------------------------------------------


def _none(start: Floats, words: str, least: float = np.nan) -> Plan:
    return Plan("none", words, start[None], np.empty((0, 3)), least)


def _too_near(arm: ThreeLeverArm, start: Floats, K1: Floats, H: Floats, distance: float) -> str:
    """Why no path can keep the distance, in a sentence; "" if one could."""
    O_H, K1_H = np.hypot(*H[:, 0].T), np.hypot(*(K1 - H[:, 0]).T)
    q_H = _distances(arm, start, H)[:, 0]  # (m, 3)
    if O_H.min() < distance:
        name = _named(H, int(O_H.argmin())).capitalize()
        return f"{name} lies on the base or {in_words(O_H.min())} beside it."
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
    # two levers are equally near at the joint where they meet: the first is named
    lever = LEVERS[(least <= least.min() + TOLERANCE * arm.lever).argmax()]
    one = len(H) == 1
    if not least.min():
        return f"lever {lever} sweeps {'the' if one else 'an'} obstacle"
    near = f"lever {lever} comes as near as {in_words(least.min())}"
    return near if one else f"{near} to an obstacle"


def _in_the_way(arm: ThreeLeverArm, direct: Floats, H: Floats, distance: float) -> int:
    """Of several obstacles the one that is in the way first, else the nearest. By samples: nothing
    is promised with it.
    """
    near = _distances(arm, along(direct, np.linspace(0, 1, 100)), H).min(axis=-1)  # (m, 100)
    first = np.where((near < distance).any(axis=1), (near < distance).argmax(axis=1), near.shape[1])
    return int(np.lexsort((near.min(axis=1), first))[0])


def _inside(corners: Floats, point: Floats) -> Bools:
    """Even-odd rule: corners (n, 2), points (..., 2) -> bool (...). A point on a side is inside."""
    crossings, on_side = np.zeros(point.shape[:-1]), np.zeros(point.shape[:-1], dtype=bool)
    for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        x, y = point[..., 0], point[..., 1]
        left = (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)  # > 0: the point lies left of the side
        crossings = crossings + ((y0 > y) != (y1 > y)) * ((left > 0) == (y1 > y0))
        within = (x - x0) * (x - x1) + (y - y0) * (y - y1) <= 0
        on_side = on_side | (within & (abs(left) <= 1e-12 * np.hypot(x1 - x0, y1 - y0)))
    inside: Bools = (crossings % 2 == 1) | on_side
    return inside


def _seen(arm: ThreeLeverArm, q: Floats, H: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """H (..., 2) seen from the levers OB, BA, AK in postures q (3, ...), four times (3, ...): its
    distance from the lever, how far it lies along the lever from its start, how far past either of
    its ends, and how far across.
    """
    direction = np.cumsum(q, axis=0)
    direction[1] -= np.pi
    direction[2] -= 2 * np.pi
    c, s = np.cos(direction), np.sin(direction)
    x, y = np.empty_like(c), np.empty_like(s)  # of H from the start of each lever
    x[0], y[0] = H[..., 0], H[..., 1]
    levers = arm.levers
    for i in (1, 2):
        x[i], y[i] = x[i - 1] - levers[i - 1] * c[i - 1], y[i - 1] - levers[i - 1] * s[i - 1]
    along, across = c * x + s * y, c * y - s * x
    beyond = along - np.clip(along, 0, levers.reshape(3, *(1,) * (along.ndim - 1)))
    return np.sqrt(across**2 + beyond**2), along, beyond, across


def _distances(arm: ThreeLeverArm, q: Floats, H: Floats) -> Floats:
    q = np.broadcast_to(q, (*np.broadcast_shapes(q.shape[:-1], H.shape[:-1]), 3))
    return np.moveaxis(_seen(arm, np.moveaxis(q, -1, 0), H)[0], 0, -1)


def _square(K: Floats, K1: Floats, H: Floats) -> Floats:
    """The directions (2, 2) from H to K2 and to K3."""
    directions = []
    for name, end in (("K", K), ("K1", K1)):
        x, y = end - H
        if np.hypot(x, y) == 0:
            raise ValueError(f"H: wanted an obstacle apart from {name}, got both at {H.tolist()}")
        square = np.array([-y, x]) / np.hypot(x, y)
        directions.append(square * (-1.0 if square @ H > 0 else 1.0))
    return np.stack(directions)


def _via_paths(
    arm: ThreeLeverArm, q0: Floats, K1: Floats, H: Floats, radii: Floats, limited: bool = True
) -> Floats:
    """`via_path` for each of the radii (r,): (r, 4, 3)."""
    K2, K3 = np.moveaxis(H + radii[:, None, None] * _square(arm.points(q0)[3], K1, H), 1, 0)
    path = [np.tile(q0, (len(radii), 1))]
    for places in (K2, K3, np.tile(K1, (len(radii), 1))):
        known = ~np.isnan(path[-1]).any(axis=-1, keepdims=True)
        reached = arm.least(places, np.where(known, path[-1], q0), limited)[0]
        path.append(np.where(known, reached, np.nan))
    return np.stack(path, axis=1)


# In what follows H is (m, 1, 2), m obstacles that stand; or (2, m, n, 2), where they are at the
# start and at the end of each of n motions, between which they move evenly.


def _clearance(arm: ThreeLeverArm, path: Floats, H: Floats) -> Floats:
    return _clearances(arm, path[:-1], path[1:], H)


def _clearances(arm: ThreeLeverArm, a: Floats, b: Floats, H: Floats) -> Floats:
    """Of the motions a -> b (n, 3): (n, 3)."""
    least, tolerance = np.full(a.shape, np.inf), TOLERANCE * arm.lever

    def halve(part: Ints, here: Floats, bound: Floats) -> Bools:
        np.minimum.at(least, part, here.T)
        nearer: Bools = np.any(bound < least[part].T - tolerance, axis=0)
        return nearer

    _measure(arm, a, b, H, halve)
    return np.maximum(least - tolerance, 0)


def _keeps(arm: ThreeLeverArm, a: Floats, b: Floats, H: Floats, distance: float) -> Bools:
    a, b = np.broadcast_arrays(a, b)
    good = np.ones(len(a), dtype=bool)

    def halve(part: Ints, here: Floats, bound: Floats) -> Bools:
        doubtful = bound < distance
        # what cannot be told from touching the circle counts as too near
        near = (here < distance) | (doubtful & (here - bound < CLOSE * arm.lever))
        good[part[near.any(axis=0)]] = False
        return good[part] & doubtful.any(axis=0)

    _measure(arm, a, b, H, halve)
    return good


def _measure(
    arm: ThreeLeverArm,
    a: Floats,
    b: Floats,
    H: Floats,
    halve: Callable[[Ints, Floats, Floats], Bools],
) -> None:
    """Measure stretches of the motions a -> b (n, 3), at first the whole motions, and halve those
    of which `halve(part, here, bound)` says so: number of the motion (k,), distances of the levers
    at an end of the stretch (3, k), and what they are at least on all of it. With several obstacles
    every motion is measured beside each of them.
    """
    n, m = len(a), H.shape[-3]
    H = np.broadcast_to(H, (2, m, n, 2)).reshape(2, -1, 2)
    part, start, end = np.arange(n * m), np.zeros(n * m), np.ones(n * m)
    work = len(part)
    while len(part):
        if work > WORK:
            turn = abs(b - a).sum()
            raise ValueError(
                f"motions: wanted some of which at most {WORK} stretches have to be measured, got "
                f"{len(a)} of {turn:.6g} rad in all, which take {work} and more"
            )
        now, later = slice(-PORTION, None), slice(None, -PORTION)
        i, s, e = part[now], start[now], end[now]
        motion = i % n
        which = halve(motion, *_bounds(arm, a[motion].T, b[motion].T, np.stack([s, e]), H[:, i]))
        i, s, e = i[which], s[which], e[which]
        middle = (s + e) / 2
        part = np.concatenate([part[later], i, i])
        start = np.concatenate([start[later], s, middle])
        end = np.concatenate([end[later], middle, e])
        work += 2 * len(i)


def _bounds(
    arm: ThreeLeverArm, a: Floats, b: Floats, ends: Floats, H: Floats
) -> tuple[Floats, Floats]:
    """For stretches of the motions a -> b (3, n) between two `ends` (2, n), and an obstacle that
    goes from H[0] to H[1] (2, n, 2) during the motion: the smaller of the distances (3, n) at the
    ends, and lower bounds for all between.

    Seen from a lever, the obstacle goes from one place to another, almost straight: it strays from
    the line by at most an eighth of its greatest acceleration, the stretch being the unit of time.
    The distance from a lever is a convex function along that line, and so it lies above its
    tangents at both ends.
    """
    change, (OB, BA, _) = b - a, arm.levers
    places = H[0] + ends[..., None] * (H[1] - H[0])
    d, along, beyond, across = _seen(arm, a[:, None] + ends * change[:, None], places)
    turn = change * (ends[1] - ends[0])
    # a turning view of a place: omega^2 times its distance, and twice omega times its speed
    omega, far = np.cumsum(turn, axis=0), np.sqrt((places**2).sum(axis=-1).max(axis=0))
    moved = np.sqrt(((places[1] - places[0]) ** 2).sum(axis=-1))
    stray = far * omega**2 + 2 * abs(omega) * moved
    stray[1] += OB * turn[1] ** 2
    stray[2] += OB * (turn[1] + turn[2]) ** 2 + BA * turn[2] ** 2
    x, y = along[:, 1] - along[:, 0], across[:, 1] - across[:, 0]
    rise = (beyond * x[:, None] + across * y[:, None]) / np.where(d > 0, d, 1)
    d0, d1, rise0, rise1 = d[:, 0], d[:, 1], rise[:, 0], rise[:, 1]
    here = np.minimum(d0, d1)
    inner = (rise0 < 0) & (rise1 > 0)  # the tangents meet between the ends
    meet = (d0 * rise1 - d1 * rise0 + rise0 * rise1) / np.where(inner, rise1 - rise0, 1)
    return here, np.maximum(np.where(inner, meet, here) - stray / 8, 0)


def _way_round(
    arm: ThreeLeverArm, q0: Floats, K1: Floats, H: Floats, distance: float
) -> Floats | None:
    low, high = arm.alpha_range(K1)
    if np.isnan(low):
        return None
    goals = arm.family(K1, np.linspace(low, high, int((high - low) / (1 * deg)) + 2))
    goals = goals[(_distances(arm, goals, H) >= distance).all(axis=(0, 2))]
    if not len(goals):
        return None
    size = len(H) * np.prod(np.ptp(arm.limits, axis=1) / STEP)
    if size > WORK:
        raise ValueError(
            f"arm: wanted limits for a grid of {WORK} postures, each beside each of {len(H)} "
            f"obstacles, got {size:.6g}"
        )
    axes = [_axis(value, *limits) for value, limits in zip(q0, arm.limits, strict=True)]
    room = _room(arm, axes, H[:, 0])
    start = tuple(int(np.abs(axis - value).argmin()) for axis, value in zip(axes, q0, strict=True))
    for margin in MARGINS:
        free = room >= distance + margin * arm.lever
        waves = _wave(free, start)
        path = _back(arm, axes, room, waves, _arrivals(axes, goals, waves), goals, H, distance)
        if path is not None:
            return _taut(arm, path, goals, H, distance)
    return None


def _axis(value: float, low: float, high: float) -> Floats:
    """Angles in even steps from `value` to both limits, and the limits."""
    down, up = np.arange(value, low, -STEP), np.arange(value, high, STEP)
    every = np.concatenate([[low, high], down, up])
    return np.unique(every.clip(min(low, value), max(high, value)))


def _room(arm: ThreeLeverArm, axes: list[Floats], H: Floats) -> Floats:
    """The least distance of the obstacles H (m, 2) from the levers in every posture of the grid
    with these axes.

    Lever OB knows gamma only, BA two of the angles, AK all: each is measured on as small a grid as
    it needs, in complex numbers.
    """
    gamma, beta, alpha = (np.exp(1j * axis) for axis in axes)
    OB = gamma[:, None, None]
    BA = -OB * beta[:, None]
    AK = -BA * alpha
    room: Any = np.inf
    for place in H @ np.array([1, 1j]):
        for lever, long in zip((OB, BA, AK), arm.levers, strict=True):
            seen = place * lever.conj()  # with the lever on the real axis
            beyond = seen.real - np.clip(seen.real, 0, long)
            room = np.minimum(room, beyond**2 + seen.imag**2)
            place = place - long * lever
    return cast(Floats, np.sqrt(room))


def _wave(free: Bools, start: tuple[int, ...]) -> Ints:
    """How many steps of one joint lead from the start to every free posture of the grid; -1 where
    none do.
    """
    waves = np.full(np.add(free.shape, 2), -1)  # a border saves asking for the ends
    inside = (slice(1, -1),) * 3
    open_ = np.zeros(waves.shape, dtype=bool)
    open_[inside] = free
    front = np.array([np.ravel_multi_index(tuple(i + 1 for i in start), waves.shape)])
    flat, open_, count = waves.reshape(-1), open_.reshape(-1), 0
    steps = np.array(waves.strides) // waves.itemsize
    steps = np.concatenate([steps, -steps])
    open_[front] = False
    while len(front):
        flat[front] = count
        front = (front[:, None] + steps).reshape(-1)
        front = front[open_[front]]
        open_[front] = False
        # once each: of equal entries one is written last
        number = np.arange(len(front))
        flat[front] = number
        front = front[flat[front] == number]
        count += 1
    return waves[inside]


def _arrivals(axes: list[Floats], goals: Floats, waves: Ints) -> tuple[Ints, Ints]:
    """Grid postures that the wave reached (m, 3) and a goal (m,) in a cell beside each, by rising
    S.
    """
    below = np.stack(
        [
            np.clip(np.searchsorted(axis, goals[:, i]) - 1, 0, len(axis) - 2)
            for i, axis in enumerate(axes)
        ]
    )
    corners = np.stack(np.meshgrid(*[(0, 1)] * 3, indexing="ij")).reshape(3, -1)
    nodes = (below[:, :, None] + corners[:, None]).reshape(3, -1)
    number = np.repeat(np.arange(len(goals)), 8)
    rest = sum(abs(axis[nodes[i]] - goals[number, i]) for i, axis in enumerate(axes))
    reached = waves[tuple(nodes)]
    S = np.where(reached >= 0, reached * STEP + rest, np.inf)
    order = S.argsort(kind="stable")[: np.isfinite(S).sum()]
    return nodes[:, order].T, number[order]


def _back(
    arm: ThreeLeverArm,
    axes: list[Floats],
    room: Floats,
    waves: Ints,
    arrivals: tuple[Ints, Ints],
    goals: Floats,
    H: Floats,
    distance: float,
) -> Floats | None:
    """The path of the wave to the first goal of which all parts keep the distance, without needless
    corners.
    """
    nodes, numbers = (column[:400] for column in arrivals)
    good = _keeps(arm, _on(axes, nodes), goals[numbers], H, distance)
    for node, number in list(zip(nodes[good], numbers[good], strict=True))[:5]:
        node = tuple(node.tolist())
        back = [node]
        while waves[node] > 0:
            before = []
            for i in range(3):
                for step in (-1, 1):
                    k = node[i] + step
                    other = (*node[:i], k, *node[i + 1 :])
                    if 0 <= k < waves.shape[i] and waves[other] == waves[node] - 1:
                        before.append(other)
            # of ways with equal S the one with more room
            node = max(before, key=lambda other: room[other])
            back.append(node)
        steps = _on(axes, np.array(back[::-1]))
        path = np.concatenate([steps, goals[[number]]])
        kept = _cut(arm, path, H, distance)
        if kept is not None:
            return path[kept]
    return None


def _on(axes: list[Floats], nodes: Ints) -> Floats:
    """Postures (n, 3) of the grid."""
    return np.stack([axis[i] for axis, i in zip(axes, nodes.T, strict=True)], axis=-1)


def _cut(arm: ThreeLeverArm, path: Floats, H: Floats, distance: float) -> list[int] | None:
    """From every posture on, straight to the farthest that can be reached so: the numbers of those
    that are left; None if not even the next can. H may be (m, k, 2), its place at every posture.
    """
    kept = [0]
    while kept[-1] < len(path) - 1:
        here = kept[-1]
        places = H
        if H.shape[1] > 1:
            places = np.stack(np.broadcast_arrays(H[:, here, None], H[:, here + 1 :]))
        good = np.flatnonzero(_keeps(arm, path[here], path[here + 1 :], places, distance))
        if not len(good):
            return None
        kept.append(here + 1 + int(good[-1]))
    return kept


def _taut(arm: ThreeLeverArm, path: Floats, goals: Floats, H: Floats, distance: float) -> Floats:
    """The path with less S: each via posture pulled between its neighbours as far as the distance
    allows, and the goal moved along its curve to where it is nearest to the last of them."""
    shares = np.linspace(1, 0, 33)[:, None]
    for _ in range(4):
        before = path.copy()
        for i in range(1, len(path) - 1):
            a, via, b = path[i - 1], path[i], path[i + 1]
            pulled = via + shares * (np.clip(via, np.minimum(a, b), np.maximum(a, b)) - via)
            starts = np.concatenate([np.broadcast_to(a, pulled.shape), pulled])
            ends = np.concatenate([pulled, np.broadcast_to(b, pulled.shape)])
            to, on = _keeps(arm, starts, ends, H, distance).reshape(2, -1)
            path[i] = pulled[(to & on).argmax()] if (to & on).any() else via
        S = abs(goals - path[-2]).sum(axis=-1)
        near = goals[S < abs(path[-1] - path[-2]).sum()]
        near = near[abs(near - path[-2]).sum(axis=-1).argsort()]
        good = _keeps(arm, path[-2], near, H, distance)
        if good.any():
            path[-1] = near[good.argmax()]
        path = path[cast(list[int], _cut(arm, path, H, distance))]  # every part keeps it
        if np.array_equal(path, before):
            break
    return path


def _angles(value: ArrayLike, name: str, finite: bool = True) -> Floats:
    """Postures (..., 3)."""
    q = floats(value, name, 3, finite)
    if (abs(q) > FARTHEST).any():
        raise ValueError(f"{name}: wanted angles in radians, got {np.nanmax(abs(q)):.6g}")
    return q


def _posture(value: ArrayLike, name: str) -> Floats:
    q = _angles(value, name)
    if q.ndim != 1:
        raise ValueError(f"{name}: wanted one single posture (3,), got shape {q.shape}")
    return q


def _start(arm: ThreeLeverArm, value: ArrayLike, name: str) -> Floats:
    """A posture inside the limits."""
    q = _posture(value, name)
    if (q < arm.limits[:, 0] - SLACK).any() or (q > arm.limits[:, 1] + SLACK).any():
        raise ValueError(
            f"{name}: wanted three angles from 0 to 180 degrees, got {(q / deg).round(3).tolist()}"
        )
    return q


def _path(value: ArrayLike) -> Floats:
    path = _angles(value, "path")
    if path.ndim != 2 or len(path) < 2:
        raise ValueError(f"path: wanted two or more postures (k, 3), got shape {path.shape}")
    return path


def _points(value: ArrayLike, name: str) -> Floats:
    """x, y of points (..., 2), or (..., 3) in the plane z = 0."""
    points = floats(value, name)
    flat = points.ndim and (
        points.shape[-1] == 2 or (points.shape[-1] == 3 and not points[..., 2].any())
    )
    if not flat:
        wanted = "wanted points (..., 2), or (..., 3) with z = 0"
        raise ValueError(f"{name}: {wanted}, got {short(value)}")
    if (abs(points) > FARTHEST).any():
        raise ValueError(f"{name}: wanted points in metres, got {abs(points).max():.6g}")
    return points[..., :2]


def _obstacles(value: ArrayLike, name: str) -> Floats:
    """One point (2,) or several (m, 2) as (m, 1, 2)."""
    points = _points(value, name)
    if points.ndim > 2 or not points.size:
        raise ValueError(f"{name}: wanted one point (2,) or several (m, 2), got {points.shape}")
    return points.reshape(-1, 1, 2)


def _point(value: ArrayLike, name: str) -> Floats:
    """x, y of one single point."""
    point = _points(value, name)
    if point.ndim != 1:
        raise ValueError(f"{name}: wanted one single point, got a batch {point.shape[:-1]}")
    return point
