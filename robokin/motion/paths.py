"""Paths: the pose or posture of a motion at s in [0, 1].

`lin`, `lin_lin` and `blend` work on any value with `lerp(goal, s)`, for example a Transform. `ptp`
moves joints.
"""

from typing import Protocol, Self, TypeVar

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import broadcast, choice, floats, warn_if_degrees

CORNERS = ("parabola", "quintic")


class Lerps(Protocol):
    """A value that can be interpolated towards another one of its type."""

    def lerp(self, goal: Self, s: ArrayLike) -> Self:
        """Interpolate: this value for s = 0, `goal` for s = 1, on the straight line between
        them."""


P = TypeVar("P", bound=Lerps)


def lin(start: P, goal: P, s: ArrayLike) -> P:
    """The straight motion (LIN, MoveL) from `start` to `goal`, at s (...) in [0, 1].

    Source: 001, listing 7. Raises ValueError if s is outside [0, 1], and TypeError if a value has
    no `lerp` or the types differ.

    >>> start, goal = Transform(translation=(0.4, 0, 0.5)), Transform(translation=(0.4, 0.2, 0.5))
    >>> lin(start, goal, [0, 0.25, 1]).translation
    array([[0.4 , 0.  , 0.5 ],
           [0.4 , 0.05, 0.5 ],
           [0.4 , 0.2 , 0.5 ]])
    """
    return _pose(start, "start").lerp(goal, _share(s))


def ptp(q0: ArrayLike, q1: ArrayLike, s: ArrayLike) -> Floats:
    """The point-to-point motion (PTP, MoveJ): all joints move linearly from q0 (..., n) to q1 (...,
    n), at s (...).

    Returns (..., n). Joint values are not wrapped: for the shorter turn, choose q1 with `nearest`.
    Source: 001, listing 8; 000, the motion along a straight line in the space Q. Warns
    (UserWarning) if a joint exceeds two turns, since the angles are then probably in degrees.
    Raises ValueError if s is outside [0, 1] or the shapes do not match.
    """
    q0, q1, s = floats(q0, "q0"), floats(q1, "q1"), _share(s)
    if q0.ndim == 0 or q0.shape[-1:] != q1.shape[-1:]:
        raise ValueError(
            f"q0 and q1: wanted the same number of joints, got shapes {q0.shape} and {q1.shape}"
        )
    broadcast("q0, q1 and s", q0.shape[:-1], q1.shape[:-1], s.shape)
    for name, q in (("q0", q0), ("q1", q1)):
        warn_if_degrees(q, name, posture=1)
    return q0 + s[..., None] * (q1 - q0)


def lin_lin(start: P, via: P, goal: P, s: ArrayLike) -> P:
    """Two consecutive straight motions. At s = 1/2 the path is at `via`, where the velocity jumps.

    Source: 001, listing 11. Raises the same errors as `lin`.
    """
    return blend(start, via, goal, 0.0, s)


def blend(
    start: P, via: P, goal: P, fraction: ArrayLike, s: ArrayLike, corner: str = "parabola"
) -> P:
    """Two straight motions with a corner that is rounded for |s - 1/2| < `fraction`, at s (...).

    fraction  the blend (zone), in [0, 0.5], a number or an array broadcast with s; 0 is `lin_lin`
    corner    "parabola": a quadratic Bezier curve from the first line to the second with `via` as
              its middle control pose; the velocity is continuous in s (C1). At s = 1/2, the
              curve is half as far from `via` as the midpoint of the corner's two ends.
              "quintic": a Bezier curve of degree 5 with control poses 0, 0.4 and 0.8 of the way to
              `via` from both ends; the acceleration is continuous, too (C2). At s = 1/2, its
              distance from `via` is 3/8 of the midpoint's and 3/4 of the parabola's.
    Source: 001, listing 12 (parabola), with errata S1-j: for a fraction above 0.5, the printed law
    misses both end poses. Raises ValueError if the fraction is outside [0, 0.5], s is outside
    [0, 1], or the corner is unknown, and TypeError if a value has no `lerp` or the types differ.
    """
    s, b = _share(s), floats(fraction, "fraction")
    if ((b < 0) | (b > 0.5)).any():
        bad = b[(b < 0) | (b > 0.5)].flat[0] if b.ndim else b
        raise ValueError(f"fraction: wanted a blend in [0, 0.5], got {bad:g}")
    choice(corner, "corner", CORNERS)
    broadcast("fraction and s", b.shape, s.shape)
    # x runs from 0 to 1 across the corner and is constant outside it. Outside, the curve is at its
    # first or last control pose, which moves along one of the two lines, so one formula covers the
    # whole path.
    with np.errstate(over="ignore"):  # the quotient overflows for an extremely short corner
        across = (s - 0.5 + b) / np.where(b > 0, 2 * b, 1)
    x = np.where(b > 0, np.clip(across, 0, 1), s >= 0.5)
    first = _pose(start, "start").lerp(via, np.minimum(2 * s, 1 - 2 * b))
    last = _pose(via, "via").lerp(goal, np.maximum(2 * s - 1, 2 * b))
    if corner == "parabola":
        poses = [first, via, last]
    else:
        poses = [
            first,
            first.lerp(via, 0.4),
            first.lerp(via, 0.8),
            last.lerp(via, 0.8),
            last.lerp(via, 0.4),
            last,
        ]
    while len(poses) > 1:  # de Casteljau: interpolate between neighbours
        poses = [a.lerp(c, x) for a, c in zip(poses, poses[1:], strict=False)]
    return poses[0]


def _share(s: ArrayLike) -> Floats:
    s = floats(s, "s")
    if not s.size:
        raise ValueError("s: wanted fractions of the path, got an empty array")
    if np.count_nonzero((s < -1e-12) | (s > 1 + 1e-12)):
        raise ValueError(
            f"s: wanted fractions of the path in [0, 1], got {s.min():g} to {s.max():g}"
        )
    return np.minimum(np.maximum(s, 0), 1)


def _pose(value: P, name: str) -> P:
    kind = type(value)
    if not callable(getattr(kind, "lerp", None)):
        wanted = "a pose with lerp, such as a Transform"
        raise TypeError(f"{name}: wanted {wanted}, got {kind.__name__}")
    return value
