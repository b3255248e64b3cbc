"""Geometries: a chain of links and, where one exists, its closed-form inverse.

An arm is a geometry with limits (see `arm.py`). A geometry holds the lengths and angles that its
links and its inverse share, so that the two cannot disagree. There are two protocols: every
geometry is a `Geometry`; a `ClosedForm` also has an inverse.

The tolerances of all geometries are here too. Distances are fractions of the arm's reach.
"""

from dataclasses import dataclass
from itertools import product
from typing import Any, NamedTuple, Protocol

import numpy as np

from .._arrays import Bools, Floats, Ints, Sealed
from .._validate import floats
from ..transform import Transform
from ..units import in_words
from .explanations import SENTENCES
from .link import Link

ROUNDING = 1e-12  # a point beyond a boundary by no more than this counts as on it
STRAIGHT = 1e-14  # an arm this close to fully extended or folded has two equal elbow rows
# if the point is nearer to axis 1 than this, joint 1 counts as free, because its angle is dominated
# by rounding errors
FREE = 1e-13
SINGULAR = 1e-6  # rad, or fraction of reach: a posture this near a singularity counts as singular
UPRIGHT = 1e-9  # rad; a tool tilted by less than this counts as upright


class Geometry(Protocol):
    """The attributes of every geometry.

    links    the links, from base to flange
    target   the type of an arm's targets: Transform (position and orientation), ScaraPose (position
             and angle) or np.ndarray (a point)
    reach    the maximum distance of the carried point from axis 1, in metres; tolerances are
             fractions of it, and dividing by it makes the linear and angular rows of a Jacobian
             comparable
    """

    @property
    def links(self) -> tuple[Link, ...]: ...
    @property
    def target(self) -> type: ...
    @property
    def reach(self) -> float: ...


class ClosedForm(Geometry, Protocol):
    """The additional attributes of a geometry with a closed-form inverse.

    branches   a read-only array (rows, flags) of +1 and -1: the configuration of each row
    carried    the point that the first joints position: "wrist centre", "point", ...

    The names that `gap` and `singularities` return are keys of `explanations.SENTENCES`.
    `show/js/geometries.js` has the same inverse for pages.
    """

    @property
    def branches(self) -> Ints: ...
    @property
    def carried(self) -> str: ...

    def ik(self, pose: Any) -> Floats:
        """See `ClosedFormArm.ik`."""

    def gap(self, pose: Any, row: int) -> "Gap":
        """The reason why a single pose has no solution in this row. This method is called only if
        there is no solution.
        """

    def singularities(self, q: Floats) -> dict[str, Bools]:
        """Return whether each singularity occurs at q (..., n), as a dict that maps its name to a
        bool array (...).
        """

    def choose_free_joints(self, q: Floats, previous: Floats) -> Floats:
        """Return rows q (..., n) in which the joints that a singularity leaves free turn as little
        as possible from `previous` (..., n).
        """


@dataclass(frozen=True, eq=False)
class Chain(Sealed):
    """The geometry of a chain of links without an inverse. No posture reaches beyond `reach`."""

    links: tuple[Link, ...]
    reach: float
    target = Transform

    @classmethod
    def measured(cls, links: tuple[Link, ...], limits: Floats) -> "Chain":
        """Make a chain of links, and compute its reach from the limits of the joints (n, 2). The
        reach is the sum of the lengths and strokes after joint 1; for a part whose distance from
        axis 1 is fixed, only that distance counts. Raises ValueError if the flange never leaves
        axis 1.
        """
        first, *others = links
        start = first.after @ others[0].before if others else first.after
        shifts = [start, *(link.before for link in others[1:]), *(link.after for link in others)]
        ways = np.stack([shift.translation for shift in shifts])
        if not first.prismatic:
            ways[0] -= (ways[0] @ first.axis) * first.axis
        strokes = abs(limits[[link.prismatic for link in links]]).max(axis=-1, initial=0)
        reach = float(np.linalg.norm(ways, axis=-1).sum() + strokes.sum())
        if reach < 1e-9:
            raise ValueError("links: wanted a flange that can leave axis 1, got a reach of 0 m")
        return cls(links, reach)


class Gap(NamedTuple):
    """The reason why a row does not exist: the boundary that the target is beyond, and by how much.

    kind     the key of a sentence in `explanations.SENTENCES`
    metres   how far the target is beyond the boundary; 0 if the reason is not a length
    what     the point to be positioned: "the wrist centre", "the target"
    degrees  the tilt of the tool, if that is the reason
    """

    kind: str
    metres: float
    what: str
    degrees: float = 0.0

    @property
    def words(self) -> str:
        """The reason, as part of a sentence."""
        facts = {"what": self.what, "gap": in_words(self.metres), "degrees": self.degrees}
        return SENTENCES[self.kind].format(**facts)


def flags(count: int) -> Ints:
    """All configurations with `count` flags, as a read-only array (2**count, count) of +1 and -1.
    The first flag changes slowest.
    """
    rows = np.array(list(product((1, -1), repeat=count)))
    rows.flags.writeable = False
    return rows


def worst(gaps: dict[str, Any], what: str) -> Gap:
    """The boundary that the target is farthest beyond. `gaps` maps boundaries to excesses in
    metres.
    """
    kind = max(gaps, key=lambda name: float(gaps[name]))
    return Gap(kind, max(float(gaps[kind]), 0.0), what)


def coordinates(point: Any) -> tuple[Floats, Floats, Floats]:
    """The coordinates x, y, z of points (..., 2) or (..., 3), or of the origins of Transforms."""
    place = point.translation if isinstance(point, Transform) else floats(point, "point")
    if place.ndim == 0 or place.shape[-1] not in (2, 3):
        raise ValueError(f"point: wanted shape (..., 2) or (..., 3), got {place.shape}")
    x, y = place[..., 0], place[..., 1]
    return x, y, place[..., 2] if place.shape[-1] == 3 else 0 * x


def one_point(point: Any) -> Any:
    """Return the point. Raises ValueError if it is a batch of points."""
    x = coordinates(point)[0]
    if x.ndim:
        raise ValueError(f"point: wanted a single point, got a batch of shape {x.shape}")
    return point


def distance(x: Floats, y: Floats) -> Floats:
    """The length of (x, y), like np.hypot, but computed with only + - * / and sqrt. Every machine
    and language rounds these in the same way, so they all agree on which points are out of reach.
    """
    scale = np.maximum(np.maximum(abs(x), abs(y)), 1e-300)
    x, y = x / scale, y / scale
    return scale * np.sqrt(x * x + y * y)


def two_levers(upper: float, fore: float, d: Floats) -> tuple[Floats, Floats, Bools]:
    """Solve the triangle of two links whose ends are d (...) apart. Return the angle between the
    first link and the line between the ends, the angle from the first to the second link, both in
    [0, pi], and whether the triangle exists.

    It uses half-angle formulas. The four factors are those of Heron's formula; each is a sum or
    difference of lengths, never of squares, so that no digits are lost where equal links fold (the
    law of cosines loses half of them).
    """
    slack = ROUNDING * (upper + fore)
    stretch, fold = upper + fore - d, d - abs(upper - fore)
    exists = (stretch >= -slack) & (fold >= -slack)
    stretch, around = np.maximum(stretch, 0), upper + fore + d
    short, long = np.maximum(d - (upper - fore), 0), np.maximum(d + (upper - fore), 0)
    # a point 1e200 m away is out of reach and must not cause a warning
    with np.errstate(over="ignore"):
        ahead = 2 * np.arctan2(np.sqrt(stretch * short), np.sqrt(around * long))
        turn = 2 * np.arctan2(np.sqrt(stretch * around), np.sqrt(short * long))
    return ahead, turn, exists
