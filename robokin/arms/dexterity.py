"""The distance from singularities: singular values of the Jacobian, scaled by one length."""

import itertools

import numpy as np

from .._arrays import ArrayLike, Floats, Ints
from .._validate import instance
from .arm import Arm


def total_length(arm: Arm) -> float:
    """The length of the stretched chain from the base in metres, with prismatic joints at their far
    limit. It sets the scale of pictures.
    """
    parts = [part for link in instance(arm, Arm, "arm").links for part in (link.before, link.after)]
    shifts = abs(arm.limits[arm.prismatic]).max(axis=-1, initial=0)
    return float(sum(np.linalg.norm(part.translation) for part in parts) + shifts.sum())


def singular_values(arm: Arm, q: ArrayLike) -> Floats:
    """The singular values of the Jacobian at q (..., n) in descending order: the semi-axes of the
    ellipsoid of tool velocities for joint speeds of norm 1. NaN in, NaN out.

    Lengths are divided by the arm's reach (`Arm.reach`), so the values have no unit. We use only
    the rows of the arm's task (the position of the tool for arms with up to three joints, otherwise
    position and orientation), and of these only the rows that the arm can change. Source: Siciliano
    et al., Robotics, 2009, section 3.9 (kinematic manipulability).
    """
    instance(arm, Arm, "arm")
    jacobian = _scaled(arm, q)[..., movable(arm), :]
    missing = np.isnan(jacobian.sum(axis=(-1, -2), keepdims=True))
    whole = np.where(missing, 0.0, jacobian)
    values = np.linalg.svd(whole, compute_uv=False)
    return np.where(missing[..., 0], np.nan, values)


def distance_from_singularity(arm: Arm, q: ArrayLike) -> Floats:
    """The smallest of the `singular_values` at q (..., n): (...). It says how slowly the tool moves
    in its worst direction; 0 is a singularity.

    >>> from robokin import SCARA, deg, distance_from_singularity
    >>> postures = np.array([(0, 90 * deg, 0, 0), (0, 5 * deg, 0, 0), (0, 0, 0, 0)])
    >>> distance_from_singularity(SCARA, postures).round(3)
    array([0.279, 0.018, 0.   ])
    """
    return singular_values(arm, q)[..., -1]


def velocity_ellipsoid(arm: Arm, q: ArrayLike) -> Floats:
    """The semi-axes of the ellipsoid of tool-point velocities for joint speeds of norm 1 that do
    not rotate the tool: columns of (..., 3, 3) in m/s, longest first, for q (..., n). Zero columns
    where the ellipsoid is flat; NaN in, NaN out.

    Joint speeds are in rad/s, those of prismatic joints in reaches (`Arm.reach`) per second. The
    tool of an arm with up to three joints may rotate, since orientation is not part of its task.

    The semi-axes are the singular values of J_v N, where the columns of N are an orthonormal basis
    of the null space of J_w. Where J_w loses rank, no joint can rotate the tool about some axis:
    the condition about that axis is void, N has one column more, and the ellipsoid is as large as
    or larger than next to that posture. At a wrist singularity J_w usually keeps its rank, and one
    semi-axis is zero.
    """
    instance(arm, Arm, "arm")
    jacobian = arm.jacobian(q)
    jacobian[..., arm.prismatic] *= arm.reach
    missing = np.isnan(jacobian.sum(axis=(-1, -2)))[..., None, None]
    jacobian = np.where(missing, 0.0, jacobian)
    moves, turns = jacobian[..., :3, :], jacobian[..., 3:, :]
    if len(arm.links) > 3:  # joint speeds that rotate the tool are removed
        moves = moves - moves @ np.linalg.pinv(turns, rcond=1e-9) @ turns
    ways, lengths, _ = np.linalg.svd(moves, full_matrices=False)
    lengths = np.where(lengths < 1e-12 * arm.reach, 0.0, lengths)
    count = lengths.shape[-1]
    largest = np.take_along_axis(ways, abs(ways).argmax(axis=-2)[..., None, :], axis=-2)
    axes = np.zeros((*ways.shape[:-1], 3))
    axes[..., :count] = ways * np.where(largest < 0, -1.0, 1.0) * lengths[..., None, :]
    return np.where(missing, np.nan, axes)


def _scaled(arm: Arm, q: ArrayLike) -> Floats:
    jacobian, size = arm.jacobian(q), arm.reach
    jacobian[..., :3, :] /= size
    jacobian[..., arm.prismatic] *= size
    return jacobian


def movable(arm: Arm) -> Ints:
    """Which rows of the Jacobian are nonzero in at least one posture."""
    moved = abs(_scaled(arm, spread(arm, 64))).max(axis=(0, 2)) > 1e-9
    return np.flatnonzero(moved[:3] if len(arm.links) <= 3 else moved)


def spread(arm: Arm, count: int, most: float = np.inf) -> Floats:
    """Postures (count, n) spread evenly between the limits, with angles within +-`most` where the
    limits permit: Weyl's sequence of the square roots of primes.
    """
    low, high = arm.limits.T
    inner = ~arm.prismatic & (low < most) & (high > -most)
    low, high = (np.where(inner, np.clip(x, -most, most), x) for x in (low, high))
    roots = np.sqrt(_primes(len(arm.links)))
    shares = (np.arange(1, count + 1)[:, None] * roots) % 1
    postures: Floats = low + shares * (high - low)
    return postures


def _primes(count: int) -> list[int]:
    found: list[int] = []
    for number in itertools.count(2):
        if len(found) == count:
            break
        if all(number % prime for prime in found):
            found.append(number)
    return found
