"""The distance from singularities: singular values of the Jacobian, scaled by one length."""

import itertools

import numpy as np

from .._arrays import ArrayLike, Floats, Ints
from .._validate import instance
from .arm import Arm


def total_length(arm: Arm) -> float:
    """The length of the fully extended chain from the base, in metres, with prismatic joints at
    their far limits. It determines the scale of pictures.
    """
    parts = [part for link in instance(arm, Arm, "arm").links for part in (link.before, link.after)]
    shifts = abs(arm.limits[arm.prismatic]).max(axis=-1, initial=0)
    return float(sum(np.linalg.norm(part.translation) for part in parts) + shifts.sum())


def singular_values(arm: Arm, q: ArrayLike) -> Floats:
    """The singular values of the Jacobian at q (..., n) in descending order: the semi-axes of the
    ellipsoid of tool velocities for joint speeds of norm 1. They are NaN if q contains NaN.

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
    """The smallest singular value (see `singular_values`) at q (..., n), of shape (...). It shows
    how slowly the tool moves in its slowest direction; it is 0 at a singularity.

    >>> from robokin import SCARA, deg, distance_from_singularity
    >>> postures = np.array([(0, 90 * deg, 0, 0), (0, 5 * deg, 0, 0), (0, 0, 0, 0)])
    >>> distance_from_singularity(SCARA, postures).round(3)
    array([0.279, 0.018, 0.   ])
    """
    return singular_values(arm, q)[..., -1]


def velocity_ellipsoid(arm: Arm, q: ArrayLike) -> Floats:
    """The semi-axes of the ellipsoid of tool-point velocities for joint speeds of norm 1 that do
    not rotate the tool: the columns of an array (..., 3, 3) in m/s, longest first, for q (..., n).
    Columns are zero where the ellipsoid is flat, and NaN where q contains NaN.

    Joint speeds are in rad/s; those of prismatic joints are in multiples of `Arm.reach` per second.
    The tool of an arm with up to three joints may rotate, since orientation is not part of its
    task.

    The semi-axes are the singular values of J_v N, where the columns of N are an orthonormal basis
    of the null space of J_w. Where J_w loses rank, no joint can rotate the tool about some axis:
    the condition for that axis always holds, N has an additional column, and the ellipsoid is at
    least as large as at nearby postures. At a wrist singularity J_w usually keeps its rank, and one
    semi-axis is zero.
    """
    instance(arm, Arm, "arm")
    jacobian = arm.jacobian(q)
    jacobian[..., arm.prismatic] *= arm.reach
    missing = np.isnan(jacobian.sum(axis=(-1, -2)))[..., None, None]
    jacobian = np.where(missing, 0.0, jacobian)
    moves, turns = jacobian[..., :3, :], jacobian[..., 3:, :]
    if len(arm.links) > 3:  # remove joint speeds that rotate the tool
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
    """The indices of the rows of the Jacobian that are nonzero in at least one posture."""
    moved = abs(_scaled(arm, spread(arm, 64))).max(axis=(0, 2)) > 1e-9
    return np.flatnonzero(moved[:3] if len(arm.links) <= 3 else moved)


def spread(arm: Arm, count: int, most: float = np.inf) -> Floats:
    """Postures (count, n) spread evenly between the limits, with angles within +-`most` where the
    limits permit. They form a Weyl sequence based on the square roots of primes.
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
