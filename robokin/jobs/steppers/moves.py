"""Moves of stepper motors: motor positions at stations and over time, and pulses."""

from dataclasses import dataclass

import numpy as np

from ..._arrays import ArrayLike, Floats, Ints, Sealed, frozen
from ..._validate import broadcast, floats, instance, positive, short, warn_if_degrees
from ...arms.arm import ClosedFormArm
from ...arms.elbow import ElbowGeometry
from ...arms.geometry import FREE, ROUNDING
from ...units import deg, wrapped

LIMIT = 500.0  # pulses per second, the maximum frequency. Source: 003, paper 1, (8)
SAMPLES = 1001  # number of postures along a straight line
SLACK = 1e-9  # a position this close to a whole pulse counts as that pulse
# maximum distance from zero in pulses: a float represents every whole number up to it exactly
COUNTED = 2**52
LISTED = 10_000_000  # maximum number of pulses that one call lists
STRETCHES = 100_000  # maximum number of segments of a move whose pulses are listed


# ---- From points to motor positions


def out_of_reach(arm: ClosedFormArm, point: ArrayLike) -> list[str]:
    """The reasons why the loader's gripper cannot reach a point (3,): a list of strings, empty if
    it can.

    Source: 003, paper 1, (1), and the inner bound |A - B| that it lacks (errata S3-r).
    """
    geometry, place = _loader(arm), _place(point, "point")
    row = arm.branch(+1, -1)
    missing = np.isnan(arm.ik(place)[row]).any()
    reasons = [geometry.gap(place, row).words] if missing else []
    if place[2] < -ROUNDING * geometry.elbow.reach:
        reasons.append(f"the point is under the floor: z = {place[2]:.4g} m")
    return reasons


def station_postures(arm: ClosedFormArm, points: ArrayLike) -> Floats:
    """The loader's postures at consecutive stations: points (stations, 3) -> q (stations, 3), with
    alpha unwrapped.

    The elbow is up; beta is from 0 to 180 degrees and gamma from 0 to 270 degrees (for z >= 0).
    alpha begins in (-180, 180] and continues by the shortest turn; on the vertical axis, where it
    is free, it keeps its value (0 at the start). Rows are NaN where a point is out of reach.
    Source: 003, paper 1, table 1 and (2) to (4); errata S3-p, S3-q.
    """
    reach, points = _loader(arm).elbow.reach, floats(points, "points", 3)
    if points.ndim != 2:
        raise ValueError(f"points: wanted shape (stations, 3), got {points.shape}")
    alpha, gamma, beta = arm.ik(points)[:, arm.branch(+1, -1)].T
    with np.errstate(over="ignore"):
        free = np.hypot(points[:, 0], points[:, 1]) <= FREE * reach
    before = 0.0
    for i in np.flatnonzero(~np.isnan(alpha)):
        alpha[i] = before = before if free[i] else float(wrapped(alpha[i], before))
    gamma = np.where(gamma < -90 * deg, gamma + 360 * deg, gamma)
    # In a folded arm, rounding can make beta negative instead of 0.
    return np.stack([alpha, gamma, abs(beta)], axis=-1)


def shortest_turn(start: ArrayLike, goal: ArrayLike) -> Floats:
    """The shortest turn from one angle to another, in [-pi, pi] rad; positive is counter-clockwise.

    Source: 003, paper 1, the two conditions for alpha; the second one has the wrong sign for alpha2
    < alpha1 (errata S3-q: from 170 to -170 degrees it turns -20 instead of +20).
    """
    start, goal = floats(start, "start"), floats(goal, "goal")
    broadcast("start and goal", start.shape, goal.shape)
    return wrapped(goal - start)


def counts(q: ArrayLike, per_degree: ArrayLike) -> Ints:
    """The motor positions at joint values q (..., n) in rad, rounded to whole pulses (..., n).

    per_degree  (n,) or one number: pulses per degree of the joint, including the gear. Source: 003,
                paper 1, the reduced angle phi of (5).
    The pulses of each move are the differences, `np.diff(counts(q, per_degree), axis=-2)`, so that
    their sum is exact. Warns (UserWarning) if an angle is so large that it is probably in degrees.
    """
    values = floats(q, "q")
    warn_if_degrees(values, "q", posture=1)
    return _counted(np.rint(_pulses(values, per_degree)), "q").astype(np.int64)


def joint_values(positions: ArrayLike, per_degree: ArrayLike) -> Floats:
    """Joint values in rad from motor positions in pulses (..., n): the inverse of `counts`."""
    positions, per_degree = floats(positions, "positions"), _per_degree(per_degree)
    broadcast("positions and per_degree", positions.shape, per_degree.shape)
    with np.errstate(over="ignore"):
        return floats(positions / per_degree * deg, "positions / per_degree")


# ---- Moves: the position of each motor over time


@dataclass(frozen=True, eq=False)
class Move(Sealed):
    """The motion of n motors between two stations. The motors are at `positions` (k, n), in pulses,
    at the times `t` (k,), in s, and run at constant speed in between. The first time is 0, and the
    first and last positions are whole pulses. Both arrays are read-only copies.

    `move(t)` returns the positions (..., n) at the times t (...), not rounded; before and after the
    move, they are constant. Raises ValueError if the times do not increase from 0 or the positions
    do not match them.
    """

    t: Floats
    positions: Floats

    def __post_init__(self) -> None:
        t, positions = floats(self.t, "t"), floats(self.positions, "positions")
        if t.ndim != 1 or not t.size or t[0] != 0 or (np.diff(t) <= 0).any():
            raise ValueError(f"t: wanted times that increase from 0, got {short(t.tolist())}")
        if positions.ndim != 2 or len(positions) != len(t) or not positions.size:
            raise ValueError(f"positions: wanted shape ({len(t)}, motors), got {positions.shape}")
        _whole(_counted(positions, "positions")[[0, -1]], "first and last of positions")
        object.__setattr__(self, "t", frozen(t))
        object.__setattr__(self, "positions", frozen(positions))

    def __call__(self, t: ArrayLike) -> Floats:
        """The motors' positions in pulses at the times t (...) in seconds -> (..., n)."""
        t = floats(t, "t")
        return np.stack([np.interp(t, self.t, column) for column in self.positions.T], axis=-1)

    @property
    def duration(self) -> float:
        """The duration of the move in seconds."""
        return float(self.t[-1])

    @property
    def frequencies(self) -> Floats:
        """The pulses per second in each segment of the move: (k - 1, n), negative if backwards."""
        with np.errstate(over="ignore"):
            return np.diff(self.positions, axis=0) / np.diff(self.t)[:, None]

    def pulses(self) -> list[tuple[Floats, Ints]]:
        """The pulse train of each motor as (times, signs), both (pulses,); the signs are +1 and -1.

        A pulse is sent when the motor should be one whole pulse further (or further back). The
        motor therefore lags by less than one pulse and makes exactly the pulses of the move, and
        pulses never follow each other faster than the frequencies permit, even after a change of
        direction. Raises ValueError if the move has more than `LISTED` pulses or `STRETCHES`
        segments.
        """
        count, stretches = abs(self.positions[1:] - self.positions[:-1]).sum(), len(self.t) - 1
        if count > LISTED or stretches > STRETCHES:
            wanted = f"wanted a move of at most {LISTED} pulses in {STRETCHES} segments"
            raise ValueError(f"pulses: {wanted}, got {count:.0f} in {stretches}")
        return [_train(self.t, column) for column in self.positions.T]


def frequencies(pulses: ArrayLike, limit: float = LIMIT) -> Floats:
    """Pulse frequencies at which all motors need the same time: pulses (..., n) -> (..., n) pulses
    per second.

    The motor with the most pulses runs at `limit`; a motor without pulses stands still. Source:
    003, paper 1, (5) to (8), with errata S3-s: its conditions (6) and (7) make the motor that has
    farthest to go the slowest. The correct condition is omega1 phi2 = omega2 phi1 for every pair of
    motors: omega_i = limit phi_i / max phi.
    """
    pulses, limit = abs(floats(pulses, "pulses")), _limit(limit)
    if not (pulses.ndim and pulses.shape[-1]):
        raise ValueError(f"pulses: wanted one number for each motor, got shape {pulses.shape}")
    most = pulses.max(axis=-1, keepdims=True)
    return pulses / np.where(most > 0, most, 1) * limit


def unsynchronised(start: ArrayLike, goal: ArrayLike, limit: float = LIMIT) -> Move:
    """Trajectory a of the document: all motors start together at the maximum frequency, and each
    stops when it has finished. `start` and `goal` are motor positions (n,). The gripper's path has
    a kink wherever a motor stops.

    Source: 003, paper 1, figure 4 (5 in the text), a.
    """
    start, goal = _stations(start, goal)
    ends = _seconds(abs(goal - start), limit)
    t = np.unique([0.0, *ends])
    share = np.minimum(t[:, None] / np.where(ends > 0, ends, 1), 1)
    return Move(t, start + (goal - start) * share)


def synchronised(start: ArrayLike, goal: ArrayLike, limit: float = LIMIT) -> Move:
    """Trajectory d of the document: all motors start and stop together, each at its own constant
    frequency (`frequencies`). `start` and `goal` are motor positions (n,). No motor reverses; the
    gripper's path is a curve.

    No motion within the limit is faster. Source: 003, paper 1, figure 4 (5 in the text), d.
    """
    start, goal = _stations(start, goal)
    duration = _seconds(abs(goal - start), limit).max()
    if duration == 0:
        return Move(np.zeros(1), start[None])
    return Move(np.array([0.0, duration]), np.stack([start, goal]))


def straight(
    arm: ClosedFormArm,
    start: ArrayLike,
    goal: ArrayLike,
    per_degree: ArrayLike,
    limit: float = LIMIT,
) -> Move:
    """Trajectories b and c of the document: the loader's gripper moves straight from one point (3,)
    to another.

    All motors start and stop together. At any moment, the fastest one runs at the maximum
    frequency, so this is the shortest time for the path. The figure is missing, and the text
    distinguishes c from b only by a motor that turns one way and then back. We take b and c to be
    the same law between two different pairs of points. c needs more pulses than d between the same
    points.

    Source: 003, paper 1, figure 4 (5 in the text), b and c. Raises ValueError if `out_of_reach`
    gives a reason for a point of the line.
    """
    _loader(arm)
    start, goal = _place(start, "start"), _place(goal, "goal")
    s = np.linspace(0, 1, SAMPLES)
    points = (1 - s)[:, None] * start + s[:, None] * goal
    q = station_postures(arm, points)
    gaps = np.flatnonzero(np.isnan(q).any(axis=-1))
    for i in (*gaps[:1], 0, -1):
        for reason in out_of_reach(arm, points[i]):
            raise ValueError(
                f"start and goal: wanted a line inside the workspace, but at {s[i]:.0%} of its "
                f"length {reason}"
            )
    due = _counted(_pulses(q, per_degree), "per_degree")
    due[[0, -1]] = np.rint(due[[0, -1]])  # motors stop at whole pulses
    ahead = _seconds(abs(np.diff(due, axis=0)).max(axis=-1), limit)
    t = np.concatenate([[0.0], np.cumsum(ahead)])
    moved = np.concatenate([[True], np.diff(t) > 0])
    return Move(t[moved], due[moved])


# ---- Private


def _loader(arm: ClosedFormArm) -> ElbowGeometry:
    """The geometry of the loader arm."""
    hint = ": wanted a loader_arm(A, B)"
    geometry = instance(arm, ClosedFormArm, "arm", hint).geometry
    return instance(geometry, ElbowGeometry, "arm", hint)


def _place(value: ArrayLike, name: str) -> Floats:
    place = floats(value, name, 3)
    if place.ndim != 1:
        raise ValueError(f"{name}: wanted a single point (3,), got {place.shape}")
    return place


def _per_degree(value: ArrayLike) -> Floats:
    per_degree = floats(value, "per_degree")
    if per_degree.ndim > 1 or np.count_nonzero(per_degree <= 0):
        wanted = "wanted positive numbers of pulses, one for each motor"
        raise ValueError(f"per_degree: {wanted}, got {short(per_degree.tolist())}")
    return per_degree


def _limit(value: float) -> float:
    return positive(value, "limit", "one positive number of pulses per second")


def _seconds(pulses: Floats, limit: float) -> Floats:
    """The time that these pulses take at the maximum frequency."""
    with np.errstate(over="ignore"):
        return floats(pulses / _limit(limit), "pulses / limit")


def _pulses(q: Floats, per_degree: ArrayLike) -> Floats:
    """Motor positions, not rounded."""
    per_degree = _per_degree(per_degree)
    broadcast("q and per_degree", q.shape, per_degree.shape)
    with np.errstate(over="ignore", invalid="ignore"):
        # the values of each motor are contiguous in memory
        return np.multiply(q, per_degree / deg, order="F")


def _counted(positions: Floats, name: str) -> Floats:
    """Return the positions. Raises ValueError if a float cannot represent them exactly."""
    most = abs(positions).max(initial=0)
    if not most <= COUNTED:
        raise ValueError(f"{name}: wanted at most 2**52 pulses from zero, got {most:.6g}")
    return positions


def _whole(positions: Floats, name: str) -> None:
    if (positions != np.rint(positions)).any():
        got = short(positions.tolist())
        raise ValueError(f"{name}: wanted whole pulses (`counts` gives them), got {got}")


def _stations(start: ArrayLike, goal: ArrayLike) -> tuple[Floats, Floats]:
    """Return start and goal as two rows of whole pulses."""
    start, goal = floats(start, "start"), floats(goal, "goal")
    if start.ndim != 1 or not start.size or start.shape != goal.shape:
        wanted = "wanted one position for each motor"
        raise ValueError(f"start and goal: {wanted}, got {start.shape} and {goal.shape}")
    for value, name in ((start, "start"), (goal, "goal")):
        _whole(_counted(value, name), name)
    return start, goal


def _train(t: Floats, due: Floats) -> tuple[Floats, Ints]:
    """The pulses (times, signs) of one motor, from its ideal positions (k,) at the times t."""
    times, signs, stands = [np.empty(0)], [np.empty(0, dtype=np.int64)], due[0]
    direction = np.sign(np.diff(due))
    turning = direction.nonzero()[0]
    # the segments that begin with a reversal of the motor
    turning = turning[1:][direction[turning[1:]] != direction[turning[:-1]]]
    ends = [*turning, len(due) - 1]
    for begin, end in zip([0, *turning], ends, strict=True):
        sign = 1 if due[end] >= due[begin] else -1
        way = sign * due[begin : end + 1]
        levels = np.arange(sign * stands + 1, np.floor(way[-1] + SLACK) + 1)
        after = np.searchsorted(np.maximum.accumulate(way), levels - SLACK)
        before = after - 1
        share = np.minimum((levels - way[before]) / (way[after] - way[before]), 1)
        since, until = t[begin + before], t[begin + after]
        times.append(since + share * (until - since))
        signs.append(np.full(len(levels), sign))
        stands += sign * len(levels)
    return np.concatenate(times), np.concatenate(signs)
