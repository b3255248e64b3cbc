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

from dataclasses import dataclass

import numpy as np

from .._validate import floats, instance, length
from ..arms.elbow import in_words
from ..arms.planar import ThreeLever
from ..units import deg

LEVERS = ("OB", "BA", "AK")
TOLERANCE = 1e-6  # of a lever's length: a clearance is known as well as this
STEP = 5 * deg  # of the grid of postures in which `way_round` searches
# Of a lever's length, kept between the grid's postures and the clearance, tried in this order. One
# step of the first joint can move the gripper by 0.26 lever lengths: a small clearance needs the
# last margin, or steps jump over H.
MARGINS = (0.005, 0.03, 0.13)


# --- Where is the obstacle? -----------------------------------------------------------------------


def in_quadrilateral(arm, q0, q1, H):
    """Does H (..., 2) lie in the quadrilaterals between the levers before and after the motion from
    q0 to q1?

    dict: "AK" for A K K1 A1, "BA" for B A A1 B1, each bool (...). The document tests the first
    only; its inequalities hold for its own drawing and fail for most others (errata S3-j, S3-k), so
    here a ray from H counts the sides it crosses. Straight sides are not what the levers sweep: see
    `swept`.
    """
    (_, B, A, K), (_, B1, A1, K1) = arm.joints(q0), arm.joints(q1)
    H = _points(H, "H")
    return {"BA": _inside(np.stack([B, A, A1, B1]), H), "AK": _inside(np.stack([A, K, K1, A1]), H)}


def swept(arm, q0, q1, H):
    """Which levers truly pass over H (2,) on the motion from q0 to q1? dict of lever -> bool."""
    least = clearance(arm, np.stack([q0, q1]), H)[0]
    return dict(zip(LEVERS, (least <= 0).tolist(), strict=True))


# --- How near does the arm come? ------------------------------------------------------------------


def distances(arm, q, H):
    """The distances of H (..., 2) from the levers OB, BA, AK in the postures q (..., 3): (..., 3),
    in metres.
    """
    gamma, beta, alpha = np.moveaxis(floats(q, "q", 3, finite=False), -1, 0)
    return np.stack(
        np.broadcast_arrays(*_beside(arm, gamma, beta, alpha, _points(H, "H"))[0]), axis=-1
    )


def clearance(arm, path, H):
    """The least distance of every lever from H along a path (k, 3): (k - 1, 3), one row for every
    part.

    Not a sample but a bound: the arm comes nowhere nearer, and at some place at most `TOLERANCE`
    lever lengths farther; 0 where a lever passes over H. It is found by halving those stretches of
    a part which could still hold a smaller distance, given how fast the points of the levers move.
    """
    path, H, tolerance = _path(path), _point(H, "H"), TOLERANCE * arm.lever
    a, b = path[:-1], path[1:]
    least = np.minimum(distances(arm, a, H), distances(arm, b, H))
    part, middle, half = _stretches(len(a), 16)
    while len(part):
        here, bound = _bounds(arm, a[part], b[part], middle, half, H)
        np.minimum.at(least, part, here)
        part, middle, half = _halved(
            part, middle, half, (bound < least[part] - tolerance).any(axis=-1)
        )
    return np.maximum(least - tolerance, 0)


def keeps(arm, a, b, H, distance):
    """Do all levers keep this distance from H on the motions from postures a (..., 3) to b (...,
    3)? bool (...).

    As certain as `clearance` and quicker, since a motion is given up at the first stretch that is
    too near.
    """
    a, b = np.broadcast_arrays(floats(a, "a", 3), floats(b, "b", 3))
    shape, a, b, H = a.shape[:-1], a.reshape(-1, 3), b.reshape(-1, 3), _point(H, "H")
    good = (distances(arm, a, H) >= distance).all(axis=-1) & (distances(arm, b, H) >= distance).all(
        axis=-1
    )
    part, middle, half = _stretches(len(a), 4)
    # after that a stretch is shorter than 1e-7: it touches the circle, and counts as near
    for _ in range(24):
        part, middle, half = part[good[part]], middle[good[part]], half[good[part]]
        here, bound = _bounds(arm, a[part], b[part], middle, half, H)
        good[part[(here < distance).any(axis=-1)]] = False
        part, middle, half = _halved(part, middle, half, (bound < distance).any(axis=-1))
        if not len(part):
            break
    good[part] = False
    return good.reshape(shape)


# --- The document's way round: two via points for the gripper -------------------------------------


def via_points(K, K1, H, radius):
    """The via points K2 and K3, (2, 2): on the circle about H, where the lines square to KH and to
    K1H leave it on the side of the base. Source: 003, III.3.2, figure 26.

    The printed formulas (40), (41) and table 6 swap two legs: their points lie on the circle, but
    not square to the line, and on either side (errata S3-m). ValueError: H in K or K1, where there
    is no line.
    """
    K, K1, H = _point(K, "K"), _point(K1, "K1"), _point(H, "H")
    points = []
    for name, end in (("K", K), ("K1", K1)):
        x, y = end - H
        if np.hypot(x, y) == 0:
            raise ValueError(f"H: wanted an obstacle apart from {name}, got both at {H.tolist()}")
        square = np.array([-y, x]) / np.hypot(x, y)
        points.append(H - square * radius * (1.0 if square @ H > 0 else -1.0))
    return np.stack(points)


def via_path(arm, q0, target, H, radius=None, limited=True):
    """The path K - K2 - K3 - K1 with the least movement for each part: (4, 3), NaN from the first
    point that is out of reach on. The radius is L/7 unless given. Source: 003, IV.

    Passing K2 and K3 promises nothing about the way between them, nor about the levers (errata
    S3-n): see `clearance`.
    """
    path = [floats(q0, "q0", 3)]
    K, K1, radius = (
        arm.joints(path[0])[3],
        _point(target, "target"),
        arm.lever / 7 if radius is None else radius,
    )
    for point in (*via_points(K, K1, H, radius), K1):
        known = not np.isnan(path[-1]).any()
        path.append(arm.least(point, path[-1], limited)[0] if known else path[-1])
    return np.stack(path)


# --- A better way round: search among postures ----------------------------------------------------


def way_round(arm, q0, target, H, distance):
    """A path (k, 3) from posture q0 to the target, with little movement, on which all levers keep
    the distance from H; None if none is found.

    The postures (gamma, beta, alpha) fill a cube of 180 degrees a side, in which the target is a
    curve: its `family`. From q0 a wave spreads through the grid of those postures that keep the
    distance, one joint by one step at a time, so that it arrives at each with the least S. It is
    followed back from the place of the curve that it reaches with the least S; then corners that
    are not needed are cut. Every part of the path is checked by `keeps`. The grid is 5 degrees
    wide: a passage narrower than that can be missed.
    """
    q0, H = floats(q0, "q0", 3), _point(H, "H")
    low, high = arm.alpha_range(target)
    goals = arm.family(target, np.linspace(low, high, int((high - low) / (1 * deg)) + 2))
    goals = goals[(distances(arm, goals, H) >= distance).all(axis=-1)]
    if not len(goals):
        return None
    axes = [_axis(value, *limits) for value, limits in zip(q0, arm.limits, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    room = np.minimum.reduce(np.broadcast_arrays(*_beside(arm, *np.ix_(*axes), H)[0]))
    start = tuple(int(np.abs(axis - value).argmin()) for axis, value in zip(axes, q0, strict=True))
    for margin in MARGINS:
        free = room >= distance + margin * arm.lever
        free[start] = True
        waves = _wave(free, start)
        path = _back(arm, grid, room, waves, _arrivals(axes, goals, waves), goals, H, distance)
        if path is not None:
            return _taut(arm, path, goals, H, distance)
    return None


# --- The control system ---------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Plan:
    """What `plan` answers.

    found      bool: is there a path that keeps the clearance?
    way        "direct", "via points", "search", or "none"
    words      the answer in sentences
    path       (k, 3) postures, the first being the start; (1, 3) if nothing was found: the arm
               stays
    clearance  (k - 1, 3) least distance of the levers OB, BA, AK from the obstacle on every part;
               inf without one
    cost       S of the path, in radians
    least      S of the direct motion, which no path can undercut
    """

    found: bool
    way: str
    words: str
    path: np.ndarray
    clearance: np.ndarray
    cost: float
    least: float

    @property
    def posture(self):
        """The posture (3,) in which the arm stands afterwards: remembered for the next task."""
        return self.path[-1]

    @property
    def via(self):
        """The postures (k - 2, 3) between start and end."""
        return self.path[1:-1]


def plan(arm, posture, target, obstacle=None, distance=None):
    """The control system of source 003 (figure 33): from the remembered posture (3,) to the target,
    past the obstacle.

    All levers keep `distance` (metres; L/7 unless given) from the obstacle along the whole path, or
    the plan says in words that none was found. Tried in this order: the direct motion with least
    movement; the document's via points K2, K3; a search among postures. Angles stay within 0 to 180
    degrees. ValueError: a posture outside.
    """
    instance(arm, ThreeLever, "arm")
    start, K1 = _posture(arm, posture), _point(target, "target")
    distance = arm.lever / 7 if distance is None else length(distance, "distance")
    unreached = arm.unreached(K1)
    if unreached:
        return _none(start, f"The target is out of reach: {unreached}.")
    goal, least = arm.least(K1, start)
    direct = np.stack([start, goal])
    if obstacle is None:
        return _found(
            "direct",
            "The way is direct: no obstacle is given.",
            direct,
            np.full((1, 3), np.inf),
            least,
        )
    H = _point(obstacle, "obstacle")
    too_near = _too_near(arm, start, K1, H, distance)
    if too_near:
        hint = f"No path keeps {in_words(distance)}; a smaller distance may be asked for."
        return _none(start, f"{too_near} {hint}", least)
    clear = clearance(arm, direct, H)
    if clear.min() >= distance:
        return _found(
            "direct", "The way is direct: the obstacle is not in it.", direct, clear, least
        )
    words = f"On the direct way {_nearest(clear)}."
    by_points = via_path(arm, start, K1, H, max(distance, arm.lever / 7))
    if np.isnan(by_points).any():
        words += " The via points K2 and K3 are not both within reach."
    else:
        clear = clearance(arm, by_points, H)
        if clear.min() >= distance:
            return _found(
                "via points",
                f"{words} The via points K2 and K3 lead round it.",
                by_points,
                clear,
                least,
            )
        words += f" By the via points K2 and K3 {_nearest(clear)}."
    by_search = way_round(arm, start, K1, H, distance)
    if by_search is not None:
        clear = clearance(arm, by_search, H)
        return _found(
            "search", f"{words} A search among postures finds a way.", by_search, clear, least
        )
    return _none(
        start,
        f"{words} A search among postures in steps of {STEP / deg:.0f}° finds no way that keeps "
        f"{in_words(distance)}.",
        least,
    )


def along(path, s):
    """Postures on a path (k, 3) at the shares s (...) of its S, from 0 to 1: (..., 3), for figures
    and players.
    """
    path, s = _path(path), floats(s, "s")
    S = np.concatenate([[0.0], abs(np.diff(path, axis=0)).sum(axis=-1).cumsum()])
    return np.stack([np.interp(s * S[-1], S, path[:, i]) for i in range(3)], axis=-1)


# --- Private helpers ------------------------------------------------------------------------------


def _found(way, words, path, clear, least):
    cost = abs(np.diff(path, axis=0)).sum()
    return Plan(True, way, words, path, clear, float(cost), float(least))


def _none(start, words, least=np.nan):
    return Plan(False, "none", words, start[None], np.empty((0, 3)), 0.0, float(least))


def _too_near(arm, start, K1, H, distance):
    """Why no path can keep the distance, in a sentence; "" if one could."""
    O_H, K1_H, q_H = np.hypot(*H), np.hypot(*(K1 - H)), distances(arm, start, H)
    if O_H < distance:
        return f"The obstacle lies on the base or {in_words(O_H)} beside it."
    if q_H.min() < distance:
        return (
            f"At the start lever {LEVERS[q_H.argmin()]} is already {in_words(q_H.min())} from "
            f"the obstacle."
        )
    if K1_H < distance:
        return f"The target lies {in_words(K1_H)} from the obstacle."
    return ""


def _nearest(clear):
    lever, near = LEVERS[clear.min(axis=0).argmin()], clear.min()
    return (
        f"lever {lever} sweeps the obstacle"
        if near == 0
        else f"lever {lever} comes as near as {in_words(near)}"
    )


def _inside(corners, point):
    """Even-odd rule: corners (n, 2), points (..., 2) -> bool (...). A point on a side is inside."""
    crossings, on_side = 0, False
    for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        x, y = point[..., 0], point[..., 1]
        left = (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)  # > 0: the point lies left of the side
        crossings = crossings + ((y0 > y) != (y1 > y)) * ((left > 0) == (y1 > y0))
        within = (x - x0) * (x - x1) + (y - y0) * (y - y1) <= 0
        on_side = on_side | (within & (abs(left) <= 1e-12 * np.hypot(x1 - x0, y1 - y0)))
    return (crossings % 2 == 1) | on_side


def _beside(arm, gamma, beta, alpha, H):
    """Three lists, for OB, BA, AK: the distance of H from the lever, and where it lies beside it:
    along from the lever's start, and across. Angles of shapes that fit; a lever's arrays have that
    of the angles that move it.
    """
    x, y, L = H[..., 0], H[..., 1], arm.lever  # of H, seen from the start of each lever in turn
    distance, along, across = [], [], []
    for direction in (gamma, gamma + beta - np.pi, gamma + beta + alpha - 2 * np.pi):
        c, s = np.cos(direction), np.sin(direction)
        along.append(c * x + s * y)
        across.append(c * y - s * x)
        beyond = along[-1] - np.clip(along[-1], 0, L)
        distance.append(np.sqrt(across[-1] ** 2 + beyond**2))
        x, y = x - L * c, y - L * s
    return distance, along, across


def _bounds(arm, a, b, middle, half, H):
    """Distances (n, 3) in the middle of stretches of the motions a -> b, and lower bounds for the
    whole stretches.

    On a stretch a point at u from the start of its lever moves no farther than (v + u w) half: v is
    the speed of the lever's start, w that of its turning. The bound is the least over u of
    (distance of H from the point) minus that.
    """
    change, L, shift, bound = (b - a).T, arm.lever, 0.0, []
    here, along, across = _beside(arm, *(a.T + middle * change), H)
    turns = abs(np.cumsum(change, axis=0)) * half
    for turn, x, y in zip(turns, along, across, strict=True):
        slope = np.minimum(turn, 0.99)
        u = np.clip(x + abs(y) * slope / np.sqrt(1 - slope**2), 0, L)
        least = np.sqrt(y**2 + (u - x) ** 2) - u * turn - shift
        bound.append(np.where(turn < 0.99, least, -np.inf))
        shift = shift + L * turn
    return np.stack(here, axis=-1), np.stack(bound, axis=-1)


def _stretches(parts, count):
    """Every part cut into `count` stretches: number of the part, middle and half length on [0,
    1].
    """
    middle = (np.arange(count) + 0.5) / count
    return (
        np.repeat(np.arange(parts), count),
        np.tile(middle, parts),
        np.full(parts * count, 0.5 / count),
    )


def _halved(part, middle, half, which):
    """The two halves of those stretches."""
    part, middle, half = part[which], middle[which], half[which] / 2
    return np.tile(part, 2), np.concatenate([middle - half, middle + half]), np.tile(half, 2)


def _axis(value, low, high):
    """Angles in even steps from `value` to both limits, and the limits."""
    down, up = np.arange(value, low, -STEP), np.arange(value, high, STEP)
    return np.unique(np.concatenate([[low, high], down, up]).clip(low, high))


def _wave(free, start):
    """How many steps of one joint lead from the start to every free posture of the grid; -1 where
    none do.
    """
    waves = np.full(np.add(free.shape, 2), -1, dtype=np.int16)  # a border saves asking for the ends
    inside = (slice(1, -1),) * 3
    open_ = np.zeros(waves.shape, dtype=bool)
    open_[inside] = free
    front = np.ravel_multi_index(np.add(start, 1), waves.shape)[None]
    flat, open_, count = waves.reshape(-1), open_.reshape(-1), 0
    steps = np.array(
        [s * sign for s in (waves.shape[1] * waves.shape[2], waves.shape[2], 1) for sign in (1, -1)]
    )
    open_[front] = False
    while len(front):
        flat[front] = count
        front = (front[:, None] + steps).reshape(-1)
        front = np.unique(front[open_[front]])
        open_[front] = False
        count += 1
    return waves[inside]


def _arrivals(axes, goals, waves):
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


def _back(arm, grid, room, waves, arrivals, goals, H, distance):
    """The path of the wave to the first goal of which all parts keep the distance, without needless
    corners.
    """
    nodes, numbers = (column[:400] for column in arrivals)
    good = keeps(arm, grid[tuple(nodes.T)], goals[numbers], H, distance)
    for node, number in list(zip(nodes[good], numbers[good], strict=True))[:5]:
        node = tuple(node.tolist())
        path = [goals[number], grid[node]]
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
            path.append(grid[node])
        path = _cut(arm, np.stack(path[::-1]), H, distance)
        if path is not None:
            return path
    return None


def _cut(arm, path, H, distance):
    """From every posture on, straight to the farthest that can be reached so; None if not even the
    next can.
    """
    kept = [0]
    while kept[-1] < len(path) - 1:
        here = kept[-1]
        good = np.flatnonzero(keeps(arm, path[here], path[here + 1 :], H, distance))
        if not len(good):
            return None
        kept.append(here + 1 + good[-1])
    return path[kept]


def _taut(arm, path, goals, H, distance):
    """The path with less S: each via posture pulled between its neighbours as far as the distance
    allows, and the goal moved along its curve to where it is nearest to the last of them."""
    shares = np.linspace(1, 0, 33)[:, None]
    for _ in range(4):
        for i in range(1, len(path) - 1):
            a, via, b = path[i - 1], path[i], path[i + 1]
            pulled = via + shares * (np.clip(via, np.minimum(a, b), np.maximum(a, b)) - via)
            good = keeps(arm, a, pulled, H, distance) & keeps(arm, pulled, b, H, distance)
            path[i] = pulled[good.argmax()] if good.any() else via
        S = abs(goals - path[-2]).sum(axis=-1)
        near = goals[S < abs(path[-1] - path[-2]).sum()]
        near = near[abs(near - path[-2]).sum(axis=-1).argsort()]
        good = keeps(arm, path[-2], near, H, distance)
        if good.any():
            path[-1] = near[good.argmax()]
        path = _cut(arm, path, H, distance)
    return path


def _points(value, name):
    """x, y of points (..., 2), or (..., 3) in the plane z = 0."""
    point = floats(value, name)
    if (
        point.ndim == 0
        or point.shape[-1] not in (2, 3)
        or (point.shape[-1] == 3 and point[..., 2].any())
    ):
        raise ValueError(
            f"{name}: wanted points (..., 2), or (..., 3) with z = 0, got "
            f"{np.asarray(value).tolist()}"
        )
    return point[..., :2]


def _point(value, name):
    """x, y of one single point."""
    point = _points(value, name)
    if point.ndim != 1:
        raise ValueError(
            f"{name}: wanted one single point, got a batch of shape {point.shape[:-1]}"
        )
    return point


def _path(path):
    path = floats(path, "path", 3)
    if path.ndim != 2 or len(path) < 2:
        raise ValueError(f"path: wanted two or more postures (k, 3), got shape {path.shape}")
    return path


def _posture(arm, q):
    q = floats(q, "posture", 3)
    slack = 1e-9
    if q.ndim != 1 or (q < arm.limits[:, 0] - slack).any() or (q > arm.limits[:, 1] + slack).any():
        raise ValueError(
            f"posture: wanted three angles from 0 to 180 degrees, got {(q / deg).round(3).tolist()}"
        )
    return q
