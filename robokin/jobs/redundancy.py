"""Methods that choose the posture of a redundant arm. Source 003 describes several of them in part
I; `race` compares them with the document's own method, the least movement.

Each method takes an arm of three levers, targets (..., 2) in metres and the previous postures (...,
3), and returns postures (..., 3) at the targets, in radians. A row is NaN if the method fails, that
is, if it does not reach the target within the limits of 0 to 180 degrees. The path of the gripper
is not part of the result: from the previous posture to the new one, all joints turn at constant
speed.
"""

from collections.abc import Callable, Mapping
from time import perf_counter
from typing import NamedTuple, TypeAlias

import numpy as np

from .._arrays import ArrayLike, Bools, Floats
from .._validate import broadcast, floats, instance, short, warn_if_degrees, whole
from ..arms.planar import ThreeLeverArm
from ..units import deg
from .obstacles import distances, keeps

Method: TypeAlias = Callable[[ThreeLeverArm, ArrayLike, ArrayLike], Floats]

STRIDE = 0.1  # maximum step of the gripper, in lever lengths
TURN = 10 * deg  # maximum rotation of a joint in one step
STEPS = 200  # a motion that has not arrived after this many steps has failed
ARRIVED = 1e-9  # lever lengths; a gripper at most this far from the target has arrived
FLAT = 1e-4  # lever lengths; with this damping the pseudo-inverse exists for a fully extended arm
NEAR = 0.5  # lever lengths; an obstacle farther away than this stops no joint
PULL = 0.1  # a joint aims to cover this fraction of its distance from mid-range in one step
SLACK = 1e-9  # rad; an excess over a limit of no more than this counts as a rounding error
TRIES = 100  # random postures among which `random_choice` looks for one that avoids the obstacle
SAME = 1e-12  # lever lengths; distances that differ by less than this count as equal


class RaceResult(NamedTuple):
    """The result of a method for n consecutive targets.

    postures  (n, 3); NaN where the arm cannot reach the target and does not move
    turns     (n,) the sum of the absolute angle changes in radians
    failed    (n,) bool: whether the method failed and the least movement was used instead
    seconds   the method's mean computing time per target
    """

    postures: Floats
    turns: Floats
    failed: Bools
    seconds: float


def race(
    methods: Mapping[str, Method], arm: ThreeLeverArm, targets: ArrayLike, start: ArrayLike
) -> dict[str, RaceResult]:
    """Run every method on the same targets (n, 2) in the same order. Each task begins in the
    posture in which the previous one ended, and the first one in `start` (3,). If a method fails,
    the method of least movement reaches the target instead, so that the sums of turns are
    comparable. Returns a dict that maps the name of each method to its `RaceResult`.
    """
    instance(arm, ThreeLeverArm, "arm")
    targets, start = floats(targets, "targets", 2), floats(start, "start", 3)
    if targets.ndim != 2 or not len(targets) or start.ndim != 1:
        got = f"{targets.shape} and {start.shape}"
        raise ValueError(f"targets and start: wanted shapes (n, 2) and (3,), got {got}")
    if not isinstance(methods, Mapping) or not all(map(callable, methods.values())):
        raise ValueError(f"methods: wanted a dict of functions by name, got {short(methods)}")
    # a function with two names would share its random numbers
    if len(set(map(id, methods.values()))) < len(methods):
        raise ValueError(f"methods: wanted each function only once, got {short(methods)}")
    runs = {}
    for name, method in methods.items():
        stand, seconds = start, 0.0
        postures, turns, failed = np.empty((len(targets), 3)), np.zeros(len(targets)), []
        for i, target in enumerate(targets):
            begin = perf_counter()
            q = method(arm, target, stand)
            seconds += perf_counter() - begin
            failed.append(bool(np.isnan(q).any()))
            postures[i] = least_movement(arm, target, stand) if failed[i] else q
            if not np.isnan(postures[i]).any():
                turns[i], stand = abs(postures[i] - stand).sum(), postures[i]
        runs[name] = RaceResult(postures, turns, np.array(failed), seconds / len(targets))
    return runs


def methods(obstacle: ArrayLike, seed: int) -> dict[str, Method]:
    """All methods for `race`, by name. The distance rule and the random choice avoid `obstacle`
    (2,). `seed` is for the random choice.
    """
    return {
        "least movement": least_movement,
        "pseudo-inverse": pseudo_inverse,
        "gradient projection": gradient_projection,
        "equal angles": equal_angles,
        "random choice": random_choice(seed, obstacle),
        "distance rule": distance_rule(obstacle),
    }


# --- The methods ----------------------------------------------------------------------------------


def least_movement(arm: ThreeLeverArm, target: ArrayLike, previous: ArrayLike) -> Floats:
    """The posture with the smallest sum of absolute angle changes: `ThreeLeverArm.least` as a
    method of this module. Source: 003, III.4.1.
    """
    target, previous = _asked(arm, target, previous)
    return arm.least(target, previous)[0]


def pseudo_inverse(arm: ThreeLeverArm, target: ArrayLike, previous: ArrayLike) -> Floats:
    """The gripper goes straight to the target in small steps e. In each step, the joints move by dq
    = J+ e, which has the smallest sum of squares of all dq that produce e. The method ignores
    limits: a joint stops at its limit, and the others may get stuck. Source: 003, I.2.1; Siciliano
    et al., Robotics, 2009, section 3.5.1.
    """
    target, previous = _asked(arm, target, previous)
    return _go(arm, target, previous, lambda q, J, e: _times(_inverse(arm, J), e))


def gradient_projection(arm: ThreeLeverArm, target: ArrayLike, previous: ArrayLike) -> Floats:
    """Like `pseudo_inverse`, but with an additional joint motion that does not move the gripper: dq
    = J+ e + (1 - J+ J) g, where g is the gradient of a secondary objective, projected onto the null
    space of J. The secondary objective is to keep the joints near the middle of their ranges.
    Source: 003, I.2.1 (Fu Rong); A. Liegeois, 1977.
    """
    target, previous = _asked(arm, target, previous)
    middle = arm.limits.mean(axis=-1)

    def move(q: Floats, J: Floats, e: Floats) -> Floats:
        wish = PULL * (middle - q) * _haste(arm, e)
        step: Floats = wish + _times(_inverse(arm, J), e - _times(J, wish))
        return step

    return _go(arm, target, previous, move)


def equal_angles(arm: ThreeLeverArm, target: ArrayLike, previous: ArrayLike) -> Floats:
    """The posture with beta = alpha: the levers bend equally at both joints, and the distance KO
    determines the angle. With u = -cos(alpha), 4 OB AK u^2 + 2 BA (OB + AK) u + BA^2 + (OB - AK)^2
    = KO^2. The previous posture does not matter. Source: 003, I.2.1 (S. Yahya).
    """
    target, previous = _asked(arm, target, previous)
    a, b, c = arm.levers
    KO, middle = np.hypot(target[..., 0], target[..., 1]), b * (a + c) / (4 * a * c)
    under = middle**2 + (KO**2 - b**2 - (a - c) ** 2) / (4 * a * c)
    u = np.sqrt(np.where(under >= 0, under, np.nan)) - middle
    alpha = np.arccos(np.where(abs(u) <= 1, -u, np.nan))
    return _kept(arm, arm.family(target, alpha), target)


def random_choice(seed: int, obstacle: ArrayLike | None = None) -> Method:
    """Return a method that chooses a random posture of the family, with alpha uniformly
    distributed. `seed` is for the random generator. With an obstacle (2,), it chooses among the
    postures for which all levers stay at least L/7 away from the obstacle on the motion from the
    previous posture; it fails if none of 100 random postures does. Source: 003, I.4 (Xi Lei-ping),
    which describes the choice in words and gives no distance; L/7 is that of III.3.2.
    """
    dice = np.random.default_rng(whole(seed, "seed", 0))
    H = None if obstacle is None else floats(obstacle, "obstacle", 2)

    def chosen(arm: ThreeLeverArm, target: ArrayLike, previous: ArrayLike) -> Floats:
        target, previous = _asked(arm, target, previous)
        low, high = arm.alpha_range(target)
        if H is None:
            return arm.family(target, low + (high - low) * dice.random(low.shape))
        alphas = low + (high - low) * dice.random((TRIES, *low.shape))
        rows = arm.family(target, alphas)
        stay = np.isnan(rows)  # in place of a posture that does not exist
        kept = keeps(arm, previous, np.where(stay, previous, rows), H, arm.lever / 7)
        safe = np.logical_and(kept, ~stay.any(axis=-1))
        first = safe.argmax(axis=0)
        row: Floats = np.take_along_axis(rows, first[None, ..., None], axis=0)[0]
        row[~safe.any(axis=0)] = np.nan
        return row

    return chosen


def distance_rule(obstacle: ArrayLike) -> Method:
    """Return a method that avoids an obstacle (2,). It works like `pseudo_inverse`, except that one
    lever stops: the nearest of those that are within half a length of the obstacle and approach it.
    Its joint does not move in that step, or turns away if the lever is nearer than L/7, and the
    other two joints move the gripper. Source: 003, I.4 (M. Benzaoui), which describes the rule in
    words and gives no length; if levers stopped at any distance from the obstacle, more tasks would
    fail.

    Two levers are equally near whenever the nearest point is the joint between them. In that case,
    the lever nearer to the base stops, since its joint moves that point and the other joint does
    not. Distances that differ by less than 1e-12 of a length count as equal, so that the result
    does not depend on the platform's rounding.
    """
    H = floats(obstacle, "obstacle", 2)

    def minding(arm: ThreeLeverArm, target: ArrayLike, previous: ArrayLike) -> Floats:
        target, previous = _asked(arm, target, previous)

        def move(q: Floats, J: Floats, e: Floats) -> Floats:
            now, free = distances(arm, q, H), _bounded(_times(_inverse(arm, J), e))
            same = SAME * arm.lever
            comes = (distances(arm, q + free, H) < now - same) & (now < NEAR * arm.lever)
            near = np.where(comes, now, np.inf)
            lever = (near <= near.min(axis=-1, keepdims=True) + same).argmax(axis=-1)[..., None]
            stopped = (np.arange(3) == lever) & comes
            change = distances(arm, q + 1e-6 * stopped, H) - now
            grows = np.where(abs(change) > same, np.sign(change), 0.0)
            away = TURN * stopped * grows * (now < arm.lever / 7) * _haste(arm, e)
            others = _inverse(arm, np.where(stopped[..., None, :], 0.0, J))
            step: Floats = away + _times(others, e - _times(J, away))
            return step

        return _go(arm, target, previous, move)

    return minding


# --- Private helpers ------------------------------------------------------------------------------


def _asked(arm: ThreeLeverArm, target: ArrayLike, previous: ArrayLike) -> tuple[Floats, Floats]:
    """Return targets (..., 2) and postures (..., 3) with the same batch shape. Targets farther than
    twice the arm's reach are moved to that distance.
    """
    instance(arm, ThreeLeverArm, "arm")
    target, previous = floats(target, "target", 2), floats(previous, "previous", 3)
    warn_if_degrees(previous, "previous", 4, posture=1)
    shape = broadcast("target and previous", target.shape[:-1], previous.shape[:-1])
    target = np.clip(target, -2 * arm.reach, 2 * arm.reach)
    return np.broadcast_to(target, (*shape, 2)), np.broadcast_to(previous, (*shape, 3))


def _go(
    arm: ThreeLeverArm,
    target: Floats,
    previous: Floats,
    step: Callable[[Floats, Floats, Floats], Floats],
) -> Floats:
    """Move to the target step by step: `step(q, J, e)` converts a step of the gripper into a step
    of the joints. A joint stops at its limits.
    """
    q = previous
    for _ in range(STEPS):
        points = arm.points(q)
        K = points[..., 3, :]
        arms = K[..., None, :] - points[..., :3, :]  # vectors from each joint to the gripper
        e = target - K
        far = np.linalg.norm(e, axis=-1, keepdims=True)
        if (far <= ARRIVED * arm.lever).all():
            break
        e = e * np.minimum(1, STRIDE * arm.lever / np.maximum(far, 1e-300))
        dq = step(q, np.stack([-arms[..., 1], arms[..., 0]], axis=-2), e)
        q = np.clip(q + _bounded(dq), arm.limits[:, 0], arm.limits[:, 1])
    return _kept(arm, q, target)


def _bounded(dq: Floats) -> Floats:
    """The step of the joints (..., 3), shortened if one of them would turn too far."""
    bounded: Floats = dq * (TURN / np.maximum(abs(dq).max(axis=-1, keepdims=True), TURN))
    return bounded


def _haste(arm: ThreeLeverArm, e: Floats) -> Floats:
    """A factor that is 1 on the way and falls to 0 near the target, so that secondary motions come
    to rest there.
    """
    haste: Floats = np.linalg.norm(e, axis=-1, keepdims=True) / (STRIDE * arm.lever)
    return haste


def _kept(arm: ThreeLeverArm, q: Floats, target: Floats) -> Floats:
    """Return the postures, but NaN where they are not at the target or not within the limits."""
    with np.errstate(invalid="ignore"):
        inside = ((q >= arm.limits[:, 0] - SLACK) & (q <= arm.limits[:, 1] + SLACK)).all(axis=-1)
        off = np.linalg.norm(arm.points(q)[..., 3, :] - target, axis=-1)
        kept = inside & (off <= 2 * ARRIVED * arm.lever)
    return np.where(kept[..., None], q, np.nan)


def _inverse(arm: ThreeLeverArm, J: Floats) -> Floats:
    """The damped pseudo-inverse (..., 3, 2) of Jacobians (..., 2, 3)."""
    return J.mT @ np.linalg.inv(J @ J.mT + (FLAT * arm.lever) ** 2 * np.eye(2))


def _times(matrix: Floats, vector: Floats) -> Floats:
    return (matrix @ vector[..., None])[..., 0]
