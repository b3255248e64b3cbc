"""The arm of source 002: two links in the plane z = 0, with two solutions for the elbow."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from .._arrays import ArrayLike, Bools, Floats, Sealed, stack
from .._validate import floats, length
from ..transform import Transform
from ..units import deg, wrapped
from .arm import ClosedFormArm
from .geometry import (
    FREE,
    ROUNDING,
    SINGULAR,
    Gap,
    coordinates,
    distance,
    flags,
    one_point,
    two_levers,
    worst,
)
from .link import Link


def two_link(l1: float, l2: float, base: ArrayLike = (0, 0)) -> ClosedFormArm:
    """The planar arm of source 002: links with lengths l1 and l2 in metres, mounted at the point
    `base` (2,) of the plane z = 0.

    q1 is the angle of link 1 from the +x axis, q2 that of link 2 from link 1. The document's
    unknown (x2, y2) is the elbow: `arm.frames(q)[..., 1].translation`. `ik` takes points (..., 2)
    or (..., 3), or the translations of Transforms; a point off the plane z = 0 is out of reach.
    Each joint ranges from -180 to 180 degrees; the document states no limits.

    Source: 002, (1) and figure 1. Raises ValueError if a length is not one positive number or
    `base` is not a point.

    >>> from robokin import deg, two_link
    >>> (two_link(0.3, 0.4).ik((0.3, 0.4)) / deg).round(1) + 0.0
    array([[  0. ,  90. ],
           [106.3, -90. ]])
    """
    limits = np.array([(-180, 180)] * 2) * deg
    return ClosedFormArm("Two links", TwoLinkGeometry(l1, l2, base), limits)


@dataclass(frozen=True, init=False, repr=False, eq=False)
class TwoLinkGeometry(Sealed):
    """Two links in the plane and their inverse (see `two_link`). The configuration flag is the sign
    of q2. At +1, link 2 turns counter-clockwise from link 1, and the elbow is to the right of the
    line from base to tip.

    The document's formula (2) is valid only for equal links mounted at the origin, divides by x3,
    and changes sides with the sign of x3 (errata S2-a, S2-d, S2-e). We solve the triangle of base,
    elbow and tip with half-angle formulas, for any lengths.
    """

    branches = flags(1)
    target = np.ndarray
    carried = "the target"
    l1: float
    l2: float
    base: tuple[float, float]
    reach: float
    links: tuple[Link, ...]

    def __init__(self, l1: float, l2: float, base: ArrayLike) -> None:
        l1, l2, place = length(l1, "l1"), length(l2, "l2"), floats(base, "base", 2)
        if place.ndim != 1:
            raise ValueError(f"base: wanted one point (2,), got shape {place.shape}")
        links = (
            Link(Transform(translation=(*place, 0)), after=Transform(translation=(l1, 0, 0))),
            Link(after=Transform(translation=(l2, 0, 0))),
        )
        vars(self).update(l1=l1, l2=l2, reach=l1 + l2, base=tuple(place.tolist()), links=links)

    def ik(self, pose: Any) -> Floats:
        """See `ClosedFormArm.ik`: points or Transform of shape (...) -> (..., 2, 2). Where equal
        links fold and the tip is at the base, q1 is free and set to 0.
        """
        x, y, d, off = self._way(pose)
        ahead, turn, exists = two_levers(self.l1, self.l2, d)
        exists = exists & (off <= ROUNDING * self.reach)
        elbow = self.branches[:, 0]
        q1 = np.arctan2(y, x)[..., None] - elbow * ahead[..., None]
        q = wrapped(stack([q1, elbow * turn[..., None]])) + 0.0  # -0.0 becomes 0
        return np.where(exists[..., None, None], q, np.nan)

    def gap(self, pose: Any, row: int) -> Gap:
        """The reason why a single pose has no solution in this row."""
        _, _, d, off = self._way(one_point(pose))
        borders = {"stretched": d - (self.l1 + self.l2), "base": abs(self.l1 - self.l2) - d}
        return worst(borders | {"plane": off}, self.carried)

    def singularities(self, q: Floats) -> dict[str, Bools]:
        """Return whether each singularity occurs at q (..., 2), within 1e-6 rad."""
        return {"elbow": abs(np.sin(q[..., 1])) < SINGULAR}

    def choose_free_joints(self, q: Floats, previous: Floats) -> Floats:
        """Return rows q (..., 2) in which q1 has its value from `previous` wherever it is free
        because the tip is at the base.
        """
        equal = abs(self.l1 - self.l2) <= FREE * self.reach
        free = (abs(np.cos(q[..., 1] / 2)) < FREE) & equal
        return np.where(free[..., None] & (np.arange(2) == 0), previous, q)

    def _way(self, pose: Any) -> tuple[Floats, Floats, Floats, Floats]:
        """The vector from base to tip (x, y), its length, and the tip's distance from the plane."""
        x, y, z = coordinates(pose)
        # -0.0 becomes 0, since atan2 distinguishes the two although they are the same coordinate
        x, y = x - self.base[0] + 0.0, y - self.base[1] + 0.0
        return x, y, distance(x, y), abs(z)
