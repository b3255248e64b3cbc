"""Measure how near the levers come to the obstacle, and locate the obstacle. `planner` decides what
is safe.
"""

from collections.abc import Callable

import numpy as np

from ..._arrays import ArrayLike, Bools, Floats, Ints
from ..._validate import broadcast, instance, length, warn_if_degrees
from ...arms.planar import ThreeLeverArm
from ...arms.two_link import two_link
from .arguments import read_angles, read_obstacles, read_path, read_point, read_points, read_posture

LEVERS = ("OB", "BA", "AK")
TOLERANCE = 1e-6  # accuracy of a clearance, in lever lengths
CLOSE = 1e-9  # lever lengths; `keeps` does not distinguish distances that differ by less than this
# maximum number of motion pieces, or of grid postures, in one call, which then takes about 1 s
WORK = 1_000_000
PORTION = 50_000  # pieces measured at a time, to limit memory


# --- Location of the obstacle ---------------------------------------------------------------------


def in_quadrilateral(
    arm: ThreeLeverArm, q0: ArrayLike, q1: ArrayLike, H: ArrayLike
) -> dict[str, Bools]:
    """Return whether H (..., 2) lies in the quadrilaterals between the levers before and after the
    motion from q0 to q1.

    The result has the keys "AK", for A K K1 A1, and "BA", for B A A1 B1, each with a bool array
    (...). The document tests only the first quadrilateral, and its inequalities are correct for its
    own drawing but not for most others (errata S3-j, S3-k). We therefore count the sides that a ray
    from H crosses. The area that the levers sweep does not have straight sides: see `swept`.
    """
    instance(arm, ThreeLeverArm, "arm")
    q0, q1, H = read_posture(q0, "q0"), read_posture(q1, "q1"), read_points(H, "H")
    warn_if_degrees(q0, "q0", posture=1)
    warn_if_degrees(q1, "q1", posture=1)
    (_, B, A, K), (_, B1, A1, K1) = arm.points(q0), arm.points(q1)
    return {"BA": _inside(np.stack([B, A, A1, B1]), H), "AK": _inside(np.stack([A, K, K1, A1]), H)}


def swept(arm: ThreeLeverArm, q0: ArrayLike, q1: ArrayLike, H: ArrayLike) -> dict[str, bool]:
    """Return, for each lever, whether it passes over H (2,) on the motion from q0 to q1."""
    instance(arm, ThreeLeverArm, "arm")
    q0, q1, H = read_posture(q0, "q0"), read_posture(q1, "q1"), read_point(H, "H")
    warn_if_degrees(q0, "q0", posture=1)
    warn_if_degrees(q1, "q1", posture=1)
    least = motion_clearances(arm, q0[None], q1[None], H[None, None])[0]
    return dict(zip(LEVERS, (least <= 0).tolist(), strict=True))


def locate(P: ArrayLike, Q: ArrayLike, from_P: float, from_Q: float) -> Floats:
    """The two possible places (2, 2) of an obstacle, in metres, from its distances to two sensors
    at the points P and Q; NaN where the circles do not meet.

    The obstacle is the elbow of a two-link arm (`two_link`) with base P and tip Q whose links have
    these lengths: row 0 is to the right of the line from P to Q, row 1 to the left. A third
    distance would decide between them. Raises ValueError if P and Q coincide.
    """
    P, Q = read_point(P, "P"), read_point(Q, "Q")
    if (P == Q).all():
        raise ValueError(f"Q: wanted a point different from P, got both at {P.tolist()}")
    from_P, from_Q = length(from_P, "from_P"), length(from_Q, "from_Q")
    q1 = two_link(from_P, from_Q, P).ik(Q)[:, :1]
    return P + from_P * np.concatenate([np.cos(q1), np.sin(q1)], axis=-1)


# --- Clearance of the arm -------------------------------------------------------------------------


def distances(arm: ThreeLeverArm, q: ArrayLike, H: ArrayLike) -> Floats:
    """The distances in metres of H (..., 2) from the levers OB, BA, AK in the postures q (..., 3):
    (..., 3).
    """
    instance(arm, ThreeLeverArm, "arm")
    q, H = read_angles(q, "q", finite=False), read_points(H, "H")
    warn_if_degrees(q, "q", posture=1)
    shape = broadcast("q and H", q.shape[:-1], H.shape[:-1])
    return lever_distances(arm, np.broadcast_to(q, (*shape, 3)), H)


def clearance(arm: ThreeLeverArm, path: ArrayLike, H: ArrayLike) -> Floats:
    """The smallest distance of each lever from H along a path (k, 3): (k - 1, 3), one row for each
    part. H is one obstacle (2,) or several (m, 2), of which the nearest counts.

    The result is a proven bound, not the minimum of samples: the arm never comes nearer, and
    somewhere it comes this near, to within `TOLERANCE` lever lengths. The distance is 0 where a
    lever passes over H. The function bisects the pieces of the path that could still contain a
    smaller distance. Raises ValueError if the path needs more than `WORK` pieces.
    """
    instance(arm, ThreeLeverArm, "arm")
    path, H = read_path(path), read_obstacles(H, "H")
    warn_if_degrees(path, "path", posture=1)
    return motion_clearances(arm, path[:-1], path[1:], H)


def keeps(arm: ThreeLeverArm, a: ArrayLike, b: ArrayLike, H: ArrayLike, distance: float) -> Bools:
    """Return whether all levers stay at least this distance (in metres) away from H, one obstacle
    (2,) or several (m, 2), on the motions from postures a (..., 3) to b (..., 3): bool (...).

    This function is as reliable as `clearance` and faster, since it stops measuring a motion at the
    first piece that is too near. A motion whose clearance exceeds the distance by less than 1e-9 of
    a lever's length may count as too near. Raises ValueError if the motions need more than `WORK`
    pieces.
    """
    instance(arm, ThreeLeverArm, "arm")
    a, b = read_angles(a, "a"), read_angles(b, "b")
    H, distance = read_obstacles(H, "H"), length(distance, "distance")
    warn_if_degrees(a, "a", posture=1)
    warn_if_degrees(b, "b", posture=1)
    shape = broadcast("a and b", a.shape, b.shape)
    a, b = (np.broadcast_to(q, shape).reshape(-1, 3) for q in (a, b))
    return motions_keep(arm, a, b, H, distance).reshape(shape[:-1])


# --- Versions without argument checks, also for moving obstacles ----------------------------------


def lever_distances(arm: ThreeLeverArm, q: Floats, H: Floats) -> Floats:
    """`distances` without argument checks, for postures q (..., 3) and H (..., 2)."""
    q = np.broadcast_to(q, (*np.broadcast_shapes(q.shape[:-1], H.shape[:-1]), 3))
    return np.moveaxis(_seen(arm, np.moveaxis(q, -1, 0), H)[0], 0, -1)


def motion_clearances(arm: ThreeLeverArm, a: Floats, b: Floats, H: Floats) -> Floats:
    """`clearance` for n motions from postures a (n, 3) to b (n, 3): (n, 3).

    H is (m, 1, 2) for m fixed obstacles, or (2, m, n, 2) for the positions of m moving obstacles at
    the start and at the end of each motion; in between, they move at constant velocity.
    """
    least, tolerance = np.full(a.shape, np.inf), TOLERANCE * arm.lever

    def halve(part: Ints, here: Floats, bound: Floats) -> Bools:
        np.minimum.at(least, part, here.T)
        nearer: Bools = np.any(bound < least[part].T - tolerance, axis=0)
        return nearer

    _measure(arm, a, b, H, halve)
    return np.maximum(least - tolerance, 0)


def motions_keep(arm: ThreeLeverArm, a: Floats, b: Floats, H: Floats, distance: float) -> Bools:
    """`keeps` for n motions from postures a (n, 3) to b (n, 3): bool (n,). H is as for
    `motion_clearances`.
    """
    a, b = np.broadcast_arrays(a, b)
    good = np.ones(len(a), dtype=bool)

    def halve(part: Ints, here: Floats, bound: Floats) -> Bools:
        doubtful = bound < distance
        # a distance that cannot be distinguished from one that is too small counts as too near
        near = (here < distance) | (doubtful & (here - bound < CLOSE * arm.lever))
        good[part[near.any(axis=0)]] = False
        return good[part] & doubtful.any(axis=0)

    _measure(arm, a, b, H, halve)
    return good


# --- Private helpers ------------------------------------------------------------------------------


def _measure(
    arm: ThreeLeverArm,
    a: Floats,
    b: Floats,
    H: Floats,
    halve: Callable[[Ints, Floats, Floats], Bools],
) -> None:
    """Measure pieces of the motions a -> b (n, 3), beginning with whole motions, and bisect those
    for which `halve(part, here, bound)` is true. Its arguments are the index of the motion (k,),
    the distances of the levers at one end of the piece (3, k), and their lower bounds on the piece.
    If there are several obstacles, each motion is measured for each of them.
    """
    n, m = len(a), H.shape[-3]
    H = np.broadcast_to(H, (2, m, n, 2)).reshape(2, -1, 2)
    part, start, end = np.arange(n * m), np.zeros(n * m), np.ones(n * m)
    work = len(part)
    while len(part):
        if work > WORK:
            turn = abs(b - a).sum()
            raise ValueError(
                f"motions: wanted motions that need at most {WORK} pieces, got {work} or more for "
                f"{len(a)} motions of {turn:.6g} rad in total"
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
    """Return the smaller of the distances (3, n) at the two ends of a piece, and lower bounds for
    the whole piece. The pieces are parts of the motions a -> b (3, n) between two `ends` (2, n),
    and the obstacle moves from H[0] to H[1] (2, n, 2) during the motion.

    In the frame of a lever, the obstacle moves almost on a straight line from one place to another:
    it deviates from the line by at most an eighth of its maximum acceleration, if the piece takes
    one unit of time. Along the line, the distance from the lever is a convex function, so it lies
    above its tangents at both ends.
    """
    change, (OB, BA, _) = b - a, arm.levers
    positions = H[0] + ends[..., None] * (H[1] - H[0])
    d, along, beyond, across = _seen(arm, a[:, None] + ends * change[:, None], positions)
    turn = change * (ends[1] - ends[0])
    # acceleration in a rotating frame: omega^2 times the distance plus twice omega times the speed
    omega, far = np.cumsum(turn, axis=0), np.sqrt((positions**2).sum(axis=-1).max(axis=0))
    moved = np.sqrt(((positions[1] - positions[0]) ** 2).sum(axis=-1))
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


def _seen(arm: ThreeLeverArm, q: Floats, H: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """H (..., 2) in the frames of the levers OB, BA, AK in postures q (3, ...), as four arrays (3,
    ...): its distance from the lever, its coordinate along the lever, its distance beyond the ends
    of the lever, and its coordinate across the lever.
    """
    direction = np.cumsum(q, axis=0)
    direction[1] -= np.pi
    direction[2] -= 2 * np.pi
    c, s = np.cos(direction), np.sin(direction)
    x, y = np.empty_like(c), np.empty_like(s)  # H relative to the start of each lever
    x[0], y[0] = H[..., 0], H[..., 1]
    levers = arm.levers
    for i in (1, 2):
        x[i], y[i] = x[i - 1] - levers[i - 1] * c[i - 1], y[i - 1] - levers[i - 1] * s[i - 1]
    along, across = c * x + s * y, c * y - s * x
    beyond = along - np.clip(along, 0, levers.reshape(3, *(1,) * (along.ndim - 1)))
    return np.sqrt(across**2 + beyond**2), along, beyond, across


def _inside(corners: Floats, point: Floats) -> Bools:
    """Return whether points (..., 2) are inside a polygon with the corners (n, 2), by the even-odd
    rule: bool (...). A point on a side counts as inside.
    """
    crossings, on_side = np.zeros(point.shape[:-1]), np.zeros(point.shape[:-1], dtype=bool)
    for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        x, y = point[..., 0], point[..., 1]
        # positive if the point is to the left of the side
        left = (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)
        crossings = crossings + ((y0 > y) != (y1 > y)) * ((left > 0) == (y1 > y0))
        within = (x - x0) * (x - x1) + (y - y0) * (y - y1) <= 0
        on_side = on_side | (within & (abs(left) <= 1e-12 * np.hypot(x1 - x0, y1 - y0)))
    inside: Bools = (crossings % 2 == 1) | on_side
    return inside
