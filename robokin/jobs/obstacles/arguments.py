"""Checks of postures, paths, points and obstacles for the functions of this package."""

import numpy as np

from ..._arrays import ArrayLike, Floats
from ..._validate import floats, short
from ...arms.planar import ThreeLeverArm
from ...units import deg

SLACK = 1e-9  # rad; an excess over a limit of no more than this counts as a rounding error
FARTHEST = 1e9  # rad or m; larger floats are too coarse for angles and positions


def read_angles(value: ArrayLike, name: str, finite: bool = True) -> Floats:
    """Return `value` as postures (..., 3)."""
    q = floats(value, name, 3, finite)
    if (abs(q) > FARTHEST).any():
        raise ValueError(f"{name}: wanted angles in radians, got {np.nanmax(abs(q)):.6g}")
    return q


def read_posture(value: ArrayLike, name: str) -> Floats:
    q = read_angles(value, name)
    if q.ndim != 1:
        raise ValueError(f"{name}: wanted a single posture (3,), got shape {q.shape}")
    return q


def read_start(arm: ThreeLeverArm, value: ArrayLike, name: str) -> Floats:
    """Return `value` as a posture inside the limits."""
    q = read_posture(value, name)
    if (q < arm.limits[:, 0] - SLACK).any() or (q > arm.limits[:, 1] + SLACK).any():
        raise ValueError(
            f"{name}: wanted three angles from 0 to 180 degrees, got {(q / deg).round(3).tolist()}"
        )
    return q


def read_path(value: ArrayLike) -> Floats:
    path = read_angles(value, "path")
    if path.ndim != 2 or len(path) < 2:
        raise ValueError(f"path: wanted two or more postures (k, 3), got shape {path.shape}")
    return path


def read_points(value: ArrayLike, name: str) -> Floats:
    """Return x, y of points (..., 2), or (..., 3) in the plane z = 0."""
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


def read_obstacles(value: ArrayLike, name: str) -> Floats:
    """Return one point (2,) or several points (m, 2) as (m, 1, 2)."""
    points = read_points(value, name)
    if points.ndim > 2 or not points.size:
        raise ValueError(f"{name}: wanted one point (2,) or several (m, 2), got {points.shape}")
    return points.reshape(-1, 1, 2)


def read_point(value: ArrayLike, name: str) -> Floats:
    """Return x, y of a single point."""
    point = read_points(value, name)
    if point.ndim != 1:
        raise ValueError(f"{name}: wanted a single point, got a batch of shape {point.shape[:-1]}")
    return point
