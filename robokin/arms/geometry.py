"""What a geometry is: a chain of links and, where there is one, its closed-form inverse.

An arm is a geometry with limits (see `arm.py`). A geometry is made of the numbers that its links
and its inverse have in common, so that the two cannot disagree. Two protocols say what it has:
`Geometry` is every one, `ClosedForm` has an inverse besides.

How near is near stands here too, once for all geometries. Distances are shares of the arm's reach.
"""

from dataclasses import dataclass
from itertools import product
from typing import Any, NamedTuple, Protocol

import numpy as np

from .._arrays import Bools, Floats, Ints, Sealed
from .._validate import floats
from ..transform import Transform
from ..units import in_words
from .link import Link
from .verdicts import SENTENCES

ROUNDING = 1e-12  # past a border by no more than this is on it
STRAIGHT = 1e-14  # this near to stretched or folded is so: the two elbow rows are one
FREE = 1e-13  # this near to axis 1 the angle of joint 1 is noise, and the joint is free
SINGULAR = 1e-6  # rad, or of the reach: this near to a singularity is called singular
UPRIGHT = 1e-9  # rad; a tool tilted by less than this stands upright


class Geometry(Protocol):
    """What every geometry has.

    links    base to flange
    target   what an arm of this geometry can be asked for: Transform (place and orientation),
             ScaraPose (place and angle) or np.ndarray (a point)
    reach    m; how far from axis 1 the arm can bring what it carries: the measure of all slack, and
             the length by which the unlike rows of a Jacobian are made comparable
    """

    @property
    def links(self) -> tuple[Link, ...]: ...
    @property
    def target(self) -> type: ...
    @property
    def reach(self) -> float: ...


class ClosedForm(Geometry, Protocol):
    """What a geometry with a closed-form inverse has besides.

    branches   (rows, flags) of +-1, read-only: the configuration of every row
    carried    what is brought to its place by the first joints: "wrist centre", "point", ...

    The names that `gap` and `singularities` give are keys of `verdicts.SENTENCES`. The same
    inverse for pages: `show/js/geometries.js`.
    """

    @property
    def branches(self) -> Ints: ...
    @property
    def carried(self) -> str: ...

    def ik(self, pose: Any) -> Floats:
        """See `ClosedFormArm.ik`."""

    def gap(self, pose: Any, row: int) -> "Gap":
        """Why one single pose has no `row` (asked only where `ik` has none)."""

    def singularities(self, q: Floats) -> dict[str, Bools]:
        """Which singularities hold at q (..., n): dict of name -> bool (...)."""

    def choose_free_joints(self, q: Floats, previous: Floats) -> Floats:
        """Rows q (..., n) with what a singularity leaves free chosen for the least turn from
        `previous` (..., n).
        """


@dataclass(frozen=True, eq=False)
class Chain(Sealed):
    """The geometry of links alone: no inverse, and a `reach` that no posture exceeds."""

    links: tuple[Link, ...]
    reach: float
    target = Transform

    @classmethod
    def measured(cls, links: tuple[Link, ...], limits: Floats) -> "Chain":
        """Of links and the limits of their joints (n, 2). The reach is the sum of the lengths and
        strokes behind joint 1; what does not move against axis 1 counts by its distance from it.
        ValueError: a flange that never comes away from axis 1.
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
            raise ValueError("links: wanted a flange that comes away from axis 1, got reach 0 m")
        return cls(links, reach)


class Gap(NamedTuple):
    """Why a row does not exist: which border is passed, and by how much.

    kind     names a sentence of `verdicts.SENTENCES`
    metres   how far the target is beyond the border; 0 where no length says it
    what     what should be brought to its place: "the wrist centre", "the target"
    degrees  by how much a tool is tilted, where that is the reason
    """

    kind: str
    metres: float
    what: str
    degrees: float = 0.0

    @property
    def words(self) -> str:
        """The reason as a part of a sentence."""
        facts = {"what": self.what, "gap": in_words(self.metres), "degrees": self.degrees}
        return SENTENCES[self.kind].format(**facts)


def flags(count: int) -> Ints:
    """All configurations of so many flags, (2**count, count) of +1 and -1, read-only: the first
    flag changes last.
    """
    rows = np.array(list(product((1, -1), repeat=count)))
    rows.flags.writeable = False
    return rows


def worst(gaps: dict[str, Any], what: str) -> Gap:
    """The border (name -> metres beyond it) that is passed the farthest."""
    kind = max(gaps, key=lambda name: float(gaps[name]))
    return Gap(kind, max(float(gaps[kind]), 0.0), what)


def coordinates(point: Any) -> tuple[Floats, Floats, Floats]:
    """x, y, z of points (..., 2) or (..., 3), or of Transforms."""
    place = point.translation if isinstance(point, Transform) else floats(point, "point")
    if place.ndim == 0 or place.shape[-1] not in (2, 3):
        raise ValueError(f"point: wanted shape (..., 2) or (..., 3), got {place.shape}")
    x, y = place[..., 0], place[..., 1]
    return x, y, place[..., 2] if place.shape[-1] == 3 else 0 * x


def one_point(point: Any) -> Any:
    """The point, or ValueError: a batch of them."""
    x = coordinates(point)[0]
    if x.ndim:
        raise ValueError(f"point: wanted one single point, got a batch of shape {x.shape}")
    return point


def distance(x: Floats, y: Floats) -> Floats:
    """The length of (x, y), as np.hypot gives it, of + - * / and sqrt alone: these are rounded
    alike on every machine and in every language, so that all agree on what is out of reach.
    """
    scale = np.maximum(np.maximum(abs(x), abs(y)), 1e-300)
    x, y = x / scale, y / scale
    return scale * np.sqrt(x * x + y * y)


def two_levers(upper: float, fore: float, d: Floats) -> tuple[Floats, Floats, Bools]:
    """The triangle of two levers whose ends are d (...) apart: the angle of the upper one from the
    line between the ends, the turn from the upper to the fore one, both in [0, pi], and whether
    there is such a triangle.

    By half angles: the four factors are Heron's, each taken from a difference and never from a
    difference of squares, so that no digit is lost where equal levers fold (the law of cosines
    loses half of them).
    """
    slack = ROUNDING * (upper + fore)
    stretch, fold = upper + fore - d, d - abs(upper - fore)
    exists = (stretch >= -slack) & (fold >= -slack)
    stretch, around = np.maximum(stretch, 0), upper + fore + d
    short, long = np.maximum(d - (upper - fore), 0), np.maximum(d + (upper - fore), 0)
    with np.errstate(over="ignore"):  # 1e200 m away is out of reach, and that is all
        ahead = 2 * np.arctan2(np.sqrt(stretch * short), np.sqrt(around * long))
        turn = 2 * np.arctan2(np.sqrt(stretch * around), np.sqrt(short * long))
    return ahead, turn, exists
