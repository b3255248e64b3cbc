"""The camera of figures and pages: its position, and the points that must be visible.

`project` returns picture coordinates in metres. `scene.Scene._fit` and Matplotlib convert them to
pixels; on a page, `js/camera.js` does so.
"""

from collections.abc import Iterable, Sequence
from typing import TypeAlias

import numpy as np

from .._arrays import ArrayLike, Floats, Ints
from .._validate import TWO_TURNS
from ..arms.arm import Arm
from ..arms.dexterity import total_length
from ..arms.link import Link
from ..transform import Transform
from ..units import deg, wrapped
from .checks import HORIZON
from .numbers import TIE, rounded, series_step, tidy
from .page import PageScene
from .things import Thing
from .twin import PageLink

View: TypeAlias = tuple[float, float]

VIEW = -60 * deg, 22 * deg  # azimuth and elevation of the camera in a spatial view
SPECK = 1e-3  # metres: the length of the smallest arm that can be drawn
# Views perpendicular to the planes x = 0, y = 0 and z = 0
STRAIGHT: tuple[View, ...] = (0, 0), (-90 * deg, 0), (-90 * deg, 90 * deg)


def project(points: ArrayLike, view: View = VIEW) -> Floats:
    """Return the parallel projection of points (..., 3) as picture coordinates (..., 2) in metres,
    to the right and upwards. `view` contains the azimuth about the base's z axis, measured from its
    x axis, and the elevation, both in radians.
    """
    (ca, ce), (sa, se) = np.cos(view), np.sin(view)
    across: Floats = np.asarray(points) @ np.array([[-sa, -se * ca], [ca, -se * sa], [0, ce]])
    return across


def posture(arm: Arm, q: Floats) -> Floats:
    """Return the postures q (..., n) with angles beyond two turns wrapped. A motion that keeps
    turning (as `follow` may return) is valid, so it must not cause the warning about degrees.
    """
    far = (abs(q) > TWO_TURNS) & ~arm.prismatic
    return np.where(far, wrapped(q), q) if far.any() else q


def arm_points(arm: Arm, q: Floats) -> Floats:
    """Return the polyline of the links for postures q (..., n) as points (..., 2n + 1, 3): base,
    joint 1, end of link 1, joint 2, ..., flange.

    Joint i is at index 2i + 1 (i from 0); the ends of the links are the origins of `arm.frames`.
    """
    frames = arm.frames(posture(arm, q))
    joints = [frames[..., i] @ link.before.translation for i, link in enumerate(arm.links)]
    points = np.empty((*np.shape(q)[:-1], 2 * len(joints) + 1, 3))
    points[..., ::2, :], points[..., 1::2, :] = frames.translation, np.stack(joints, axis=-2)
    return points


def flange(arm: Arm, q: Floats) -> Transform:
    """Return the pose of the flange at q (..., n), for angles of any size."""
    return arm.fk(posture(arm, q))


def extent(arm: Arm) -> float:
    """Return the length of the fully extended arm in metres, which determines the scale of its
    pictures. Raises ValueError if the arm is too large or too small to draw.
    """
    with np.errstate(over="ignore"):
        size = total_length(arm)
    if not SPECK <= size <= HORIZON:
        raise ValueError(f"arm: wanted one from {SPECK:g} to {HORIZON:g} m long, got {size:g} m")
    return size


def is_flat(arm: Arm, q: Floats) -> bool:
    """Return whether these postures lie in the plane z = 0, so that a view from above is the
    clearest.
    """
    return bool(np.nanmax(abs(arm_points(arm, q)[..., 2]), initial=0) < 1e-6 * extent(arm))


# --- Page data ---------------------------------------------------------------------------


def scene_data(
    arms: Sequence[Arm],
    postures: Sequence[Floats],
    things: Sequence[Thing],
    size: float,
    kept: Ints | None = None,
    *,
    solid: bool = False,
    grows: bool = False,
    bases: Floats | None = None,
) -> PageScene:
    """Return the page data of a scene: the camera, the points that must be visible, the floor and
    the things. `kept` contains the indices of the samples that the page stores. A `solid` floor is
    at height 0.
    """
    flat, foot = common_plane(arms), 0.08 * size * np.array([[-1], [1]])
    feet = standing(bases, len(arms))
    parts = [
        arm_points(arm, q).reshape(-1, 3) + base
        for arm, q, base in zip(arms, postures, feet, strict=True)
    ]
    tools = [
        Transform(translation=base) @ flange(arm, q)
        for arm, q, base in zip(arms, postures, feet, strict=True)
    ]
    axis = 0.13 * size
    tips = [(pose[..., None] @ (axis * np.eye(3))).reshape(-1, 3) for pose in tools]
    tips += [thing.seen(axis) for thing in things]
    parts += [thing.seen(0.0) for thing in things]  # the axes of frames do not enlarge the floor
    across = [k for k in range(3) if k != (2 if flat is None else flat)]
    rings = [foot * np.eye(3)[k] + base for base in feet for k in across]
    seen = np.concatenate([*rings, *parts])
    low, high = np.nanmin(seen, axis=0), np.nanmax(seen, axis=0)
    step = series_step(max(*(high - low)[across], size / 3) * (1 + TIE) / 8)
    low[across] = np.floor(low[across] / step + 0.1) * step
    high[across] = np.ceil(high[across] / step - 0.1) * step
    sunk = flat is None and not solid and low[2] < -0.01 * size
    low[2] = min(low[2], 0.0) if sunk else 0.0
    places = np.concatenate([pose.translation.reshape(-1, 3) for pose in tools])
    return {
        "size": tidy(size, 4),
        "flat": flat,
        "grid": tidy(step, 6),
        "seen": outermost(np.concatenate([seen, *tips])),
        "floor": [rounded(low, 4), rounded(high, 4)],
        "view": rounded(best_view(places - feet.mean(axis=0), flat), 4),
        "grows": grows,
        "solid": solid,
        "bases": None if bases is None else [rounded(base, 4) for base in feet],
        "things": [thing.page(kept) for thing in things],
    }


def standing(bases: Floats | None, count: int) -> Floats:
    """Return the positions (count, 3) of `count` arms. Without `bases`, all are at the origin."""
    flat = np.zeros((count, 2)) if bases is None else bases
    return np.column_stack([flat, np.zeros(count)])


def apart(bases: Floats | None) -> bool:
    """Return whether the arms of one picture stand at different places. Their frames are not drawn
    then, because in a row they would hide what the arms do.
    """
    return bases is not None and bool((bases != bases[0]).any())


def outermost(points: Floats) -> list[list[float]]:
    """Return about fifty points (k, 3) that must be visible: those farthest out in evenly spread
    directions.

    The points are rounded first, so that rounding errors do not decide which of two equally distant
    points is chosen.
    """
    points = np.floor(points[np.isfinite(points).all(axis=-1)] * 200 + 0.5 + TIE).astype(np.int64)
    x, y, z = (points - points.min(axis=0)).T
    # Sorting one number per point is a hundred times faster than sorting rows.
    points = points[np.unique((x << 40) + (y << 20) + z, return_index=True)[1]] / 200
    k = np.arange(100) + 0.5
    z, turn = 1 - 2 * k / 100, k * np.pi * (1 + 5**0.5)
    across = np.sqrt(1 - z**2)
    directions = np.round(np.stack([across * np.cos(turn), across * np.sin(turn), z], axis=-1), 3)
    return [
        rounded(points[i], 3) for i in sorted(set((directions @ points.T).argmax(axis=-1).tolist()))
    ]


def best_view(tools: Floats, flat: int | None) -> View:
    """Return the azimuth and elevation of the camera. It looks perpendicularly at the plane of a
    flat scene. Otherwise, it looks from the direction in which the tool's path appears largest, on
    the tool's side of the base.
    """
    if flat is not None:
        return STRAIGHT[flat]
    tools = tools[np.isfinite(tools).all(axis=-1)]
    if not len(tools):
        return VIEW
    spread, centre = np.cov(tools.T) if len(tools) > 1 else np.eye(3), tools.mean(axis=0)
    best, most = VIEW, 0.0
    # With these steps no side of the floor is ever parallel to the line of sight.
    for azimuth in VIEW[0] + np.array([0, 30, 90, 120, 180, 210, 270, 300]) * deg:
        screen = project(np.eye(3), (azimuth, VIEW[1])).T
        area = np.sqrt(max(np.linalg.det(screen @ spread @ screen.T), 0)) + 0.05 * (
            screen[0] @ spread @ screen[0]
        )
        toward = centre @ [np.cos(azimuth), np.sin(azimuth), 0]
        area *= 1 + 0.3 * np.tanh(5 * toward / (np.linalg.norm(centre) + 1e-9))
        if area > 1.05 * most:  # so that rounding errors do not decide between equal views
            best, most = (azimuth, VIEW[1]), area
    return best


def common_plane(arms: Sequence[Arm]) -> int | None:
    """Return the coordinate (0, 1, 2) that is zero in every posture of every arm, or None."""
    for axis in (2, 1, 0):
        if all(
            abs(
                arm_points(arm, np.linspace(0.1, 0.9, 5 * len(arm.links)).reshape(5, -1))[..., axis]
            ).max()
            < 1e-9
            for arm in arms
        ):
            return axis
    return None


def chain(links: Iterable[Link]) -> list[PageLink]:
    """Return the page data of an arm's links."""
    return [
        {
            "before": matrix(link.before),
            "axis": rounded(link.axis),
            "after": matrix(link.after),
            "prismatic": link.prismatic,
        }
        for link in links
    ]


def matrix(pose: Transform) -> list[float]:
    """Return the upper three rows of the homogeneous matrix as one list, row by row."""
    return rounded(pose.as_matrix()[:3])
