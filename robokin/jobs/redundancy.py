"""Ways to choose the posture of an arm with one joint too many: the methods that source 003 tells
of in part I, and a race of all of them against its own, the least movement.

Each method takes an arm of three levers, targets (..., 2) in metres and the postures (..., 3)
before, and answers with postures (..., 3) at the targets, in radians: NaN where it fails, that is,
does not arrive within the limits of 0 to 180 degrees. How the gripper gets there is not part of the
answer: from the posture before to that at the target all joints turn evenly.
"""

from collections.abc import Callable, Mapping
from time import perf_counter
from typing import NamedTuple, TypeAlias

import numpy as np

from .._arrays import ArrayLike, Bools, Floats
from .._validate import broadcast, floats, instance, short, warn_if_degrees, whole
from ..arms.planar import ThreeLeverArm
from ..units import deg
from .obstacles import distances

Method: TypeAlias = Callable[[ThreeLeverArm, ArrayLike, ArrayLike], Floats]

STRIDE = 0.1  # of a lever's length: the gripper's greatest step
TURN = 10 * deg  # the greatest turn of a joint in one step
STEPS = 200  # what has not arrived then, does not
ARRIVED = 1e-9  # of a lever's length
FLAT = 1e-4  # of a lever's length; it damps pseudo-inverses: a stretched arm is no division by 0
NEAR = 0.5  # of a lever's length: an obstacle farther away than this stops no joint
PULL = 0.1  # of the way to the middle of the limits, in one step
SLACK = 1e-9  # rad; past a limit by no more than this is rounding
SAME = 1e-12  # of a lever's length; distances that differ by less are the same distance


class RaceResult(NamedTuple):
    """What a method made of n targets, one after the other.

    postures  (n, 3); NaN where the arm cannot reach the target, and stayed
    turns     (n,) the sum of the changes of all angles in radians
    failed    (n,) bool: the method failed, and the least movement did the task in its place
    seconds   the method's own time for one target, the mean
    """

    postures: Floats
    turns: Floats
    failed: Bools
    seconds: float


def race(
    methods: Mapping[str, Method], arm: ThreeLeverArm, targets: ArrayLike, start: ArrayLike
) -> dict[str, RaceResult]:
    """Every method on the same targets (n, 2) in the same order, each task from the posture in
    which the last one ended, the first from `start` (3,). So that the sums of turns can be
    compared, what a method does not reach is reached by the least movement. dict of name ->
    `RaceResult`.
    """
    instance(arm, ThreeLeverArm, "arm")
    targets, start = floats(targets, "targets", 2), floats(start, "start", 3)
    if targets.ndim != 2 or not len(targets) or start.ndim != 1:
        got = f"{targets.shape} and {start.shape}"
        raise ValueError(f"targets and start: wanted shapes (n, 2) and (3,), got {got}")
    if not isinstance(methods, Mapping) or not all(map(callable, methods.values())):
        raise ValueError(f"methods: wanted names and functions, got {short(methods)}")
    if len(set(map(id, methods.values()))) < len(methods):  # its dice would go on, not begin anew
        raise ValueError(f"methods: wanted each function once, got {short(methods)}")
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
    """All of them for `race`, by name: the distance rule with this obstacle (2,), the random choice
    with dice of this seed.
    """
    return {
        "least movement": least_movement,
        "pseudo-inverse": pseudo_inverse,
        "gradient projection": gradient_projection,
        "equal angles": equal_angles,
        "random choice": random_choice(seed),
        "distance rule": distance_rule(obstacle),
    }


# --- The methods ----------------------------------------------------------------------------------


def least_movement(arm: ThreeLeverArm, target: ArrayLike, previous: ArrayLike) -> Floats:
    """The posture with the smallest sum of the angles' changes: `ThreeLeverArm.least`, as a method
    of this module. Source: 003, III.4.1.
    """
    target, previous = _asked(arm, target, previous)
    return arm.least(target, previous)[0]


def pseudo_inverse(arm: ThreeLeverArm, target: ArrayLike, previous: ArrayLike) -> Floats:
    """The gripper goes straight to the target by small steps e, the joints by dq = J+ e: of all
    that make the step, the dq with the smallest sum of squares. It knows no limits: a joint stops
    where its own is, and the others may get stuck. Source: 003, I.2.1; Siciliano et al., Robotics,
    2009, section 3.5.1.
    """
    target, previous = _asked(arm, target, previous)
    return _go(arm, target, previous, lambda q, J, e: _times(_inverse(arm, J), e))


def gradient_projection(arm: ThreeLeverArm, target: ArrayLike, previous: ArrayLike) -> Floats:
    """As `pseudo_inverse`, and besides a motion that leaves the gripper where it is, dq = J+ e +
    (1 - J+ J) g: of the gradient g of a wish, the part in the null space of J. The wish is to be in
    the middle of the limits. Source: 003, I.2.1 (Fu Rong); A. Liegeois, 1977.
    """
    target, previous = _asked(arm, target, previous)
    middle = arm.limits.mean(axis=-1)

    def move(q: Floats, J: Floats, e: Floats) -> Floats:
        wish = PULL * (middle - q) * _haste(arm, e)
        step: Floats = wish + _times(_inverse(arm, J), e - _times(J, wish))
        return step

    return _go(arm, target, previous, move)


def equal_angles(arm: ThreeLeverArm, target: ArrayLike, previous: ArrayLike) -> Floats:
    """beta = alpha: the levers bend alike at both joints, and the distance KO says how much. With
    u = -cos(alpha), 4 OB AK u^2 + 2 BA (OB + AK) u + BA^2 + (OB - AK)^2 = KO^2. The posture before
    does not count. Source: 003, I.2.1 (S. Yahya).
    """
    target, previous = _asked(arm, target, previous)
    a, b, c = arm.levers
    KO, middle = np.hypot(target[..., 0], target[..., 1]), b * (a + c) / (4 * a * c)
    under = middle**2 + (KO**2 - b**2 - (a - c) ** 2) / (4 * a * c)
    u = np.sqrt(np.where(under >= 0, under, np.nan)) - middle
    alpha = np.arccos(np.where(abs(u) <= 1, -u, np.nan))
    return _kept(arm, arm.family(target, alpha), target)


def random_choice(seed: int) -> Method:
    """A method that takes any posture of the family, all alphas alike, by dice of this seed.
    Source: 003, I.4 (Xi Lei-ping), where one of those that pass the obstacle is taken.
    """
    dice = np.random.default_rng(whole(seed, "seed", 0))

    def chosen(arm: ThreeLeverArm, target: ArrayLike, previous: ArrayLike) -> Floats:
        target, previous = _asked(arm, target, previous)
        low, high = arm.alpha_range(target)
        return arm.family(target, low + (high - low) * dice.random(low.shape))

    return chosen


def distance_rule(obstacle: ArrayLike) -> Method:
    """A method that minds an obstacle (2,). As `pseudo_inverse`; but of the levers within half a
    length of the obstacle that come nearer to it, the nearest one stops: its joint stands still in
    that step, or turns away if it is nearer than L/7, and the other two take the gripper on.
    Source: 003, I.4 (M. Benzaoui), told there in words and without a length: where every lever
    stops, however far, more tasks fail.

    Two levers are equally near whenever the nearest place is the joint between them. Then the one
    nearer to the base stops: its joint moves that place, and the other's joint, which lies in it,
    does not. What differs by less than 1e-12 of a length is equal here, so that the last bit of a
    platform decides nothing.
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
    """Targets (..., 2) and postures (..., 3) of one batch. A place twice as far away as the arm
    reaches stands for all beyond.
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
    """Step by step to the target: `step(q, J, e)` makes the joints' step of the gripper's. A joint
    stops at its limits.
    """
    q = previous
    for _ in range(STEPS):
        points = arm.points(q)
        K = points[..., 3, :]
        arms = K[..., None, :] - points[..., :3, :]  # from each joint to the gripper
        e = target - K
        far = np.linalg.norm(e, axis=-1, keepdims=True)
        if (far <= ARRIVED * arm.lever).all():
            break
        e = e * np.minimum(1, STRIDE * arm.lever / np.maximum(far, 1e-300))
        dq = step(q, np.stack([-arms[..., 1], arms[..., 0]], axis=-2), e)
        q = np.clip(q + _bounded(dq), arm.limits[:, 0], arm.limits[:, 1])
    return _kept(arm, q, target)


def _bounded(dq: Floats) -> Floats:
    """The same step of the joints (..., 3), shortened where one of them would turn too far."""
    bounded: Floats = dq * (TURN / np.maximum(abs(dq).max(axis=-1, keepdims=True), TURN))
    return bounded


def _haste(arm: ThreeLeverArm, e: Floats) -> Floats:
    """1 on the way, less and less near the target: what is done besides must come to rest there."""
    haste: Floats = np.linalg.norm(e, axis=-1, keepdims=True) / (STRIDE * arm.lever)
    return haste


def _kept(arm: ThreeLeverArm, q: Floats, target: Floats) -> Floats:
    """The postures that are at the target and within the limits; NaN for the others."""
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
