"""An arm as data: a geometry and the limits of its joints."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from .._arrays import ArrayLike, Bools, Floats, Ints, Sealed, by_blocks, frozen
from .._validate import floats, short, text, warn_if_degrees
from ..quaternion import Quaternion, cross, turned
from ..transform import Transform
from .geometry import Chain, ClosedForm, Geometry
from .link import BASE, Frame, Link, chain

SCALARS = (int, float, np.number)


@dataclass(frozen=True, init=False, repr=False, eq=False)
class Arm(Sealed):
    """A robot arm with n joints. q (..., n) is in radians, or in metres for prismatic joints.

    name           its name in figures
    geometry       its links and the quantities derived from them (see `geometry.py`); or a tuple of
                   links, from which the arm makes a geometry without an inverse
    limits         (n, 2), lowest and highest value of each joint; read-only
    speed_limits   (n,), maximum speeds in rad/s or m/s; read-only; None if they are not known

    An arm whose geometry has a closed-form inverse is a `ClosedFormArm`. Raises ValueError if the
    limits have the wrong shape or the links never move the flange away from axis 1, and TypeError
    if `geometry` is neither a geometry nor a tuple of links.

    >>> from robokin import Arm, deg, dh_links, mm
    >>> a, d = np.array([[0, -425, -392.25, 0, 0, 0], [89.159, 0, 0, 109.15, 94.65, 82.3]]) * mm
    >>> alpha = np.array([90, 0, 0, 90, -90, 0]) * deg
    >>> ur5 = Arm("UR5", dh_links(a, alpha, d), np.array([(-360, 360)] * 6) * deg)
    >>> ur5.fk(np.array([0, -90, 90, 0, 0, 0]) * deg).translation.round(3) + 0.0
    array([-0.392, -0.191,  0.42 ])
    >>> ur5.jacobian(np.zeros(6)).shape, hasattr(ur5, "ik")
    ((6, 6), False)
    """

    name: str
    geometry: Geometry
    limits: Floats
    speed_limits: Floats | None

    def __init__(
        self,
        name: str,
        geometry: Geometry | Sequence[Link],
        limits: ArrayLike,
        speed_limits: ArrayLike | None = None,
    ) -> None:
        text(name, "name")
        geometry = _measured(geometry, limits)
        parts = self._geometry_has()
        if isinstance(geometry, type) or not all(hasattr(geometry, part) for part in parts):
            wanted = f"a geometry with {', '.join(parts)}"
            raise TypeError(f"geometry: wanted {wanted}, got {short(geometry)}")
        n = len(geometry.links)
        pairs = _pairs(limits, n)
        speeds = None if speed_limits is None else floats(speed_limits, "speed_limits", n)
        if speeds is not None and (speeds.ndim != 1 or (speeds <= 0).any()):
            got = short(speeds.tolist())
            raise ValueError(f"speed_limits: wanted {n} positive numbers, got {got}")
        vars(self).update(name=name, geometry=geometry, limits=frozen(pairs))
        vars(self)["speed_limits"] = None if speeds is None else frozen(speeds)

    @staticmethod
    def _geometry_has() -> tuple[str, ...]:
        return "links", "target", "reach"

    @property
    def links(self) -> tuple[Link, ...]:
        """The n links, from base to flange."""
        return self.geometry.links

    @property
    def target(self) -> type:
        """The type of the arm's targets: Transform (position and orientation), ScaraPose (position
        and angle) or np.ndarray (a point).
        """
        return self.geometry.target

    @property
    def reach(self) -> float:
        """The maximum distance in metres between axis 1 and the point that the arm positions (the
        wrist centre, or the tool of an arm without a wrist).
        """
        return self.geometry.reach

    @cached_property
    def prismatic(self) -> Bools:
        """A read-only bool array (n,): True for each prismatic joint."""
        prismatic = np.array([link.prismatic for link in self.links])
        prismatic.flags.writeable = False
        return prismatic

    @cached_property
    def turning(self) -> slice | Bools:
        """The index that selects the revolute joints on the last axis: a slice if all joints are
        revolute, otherwise a mask (n,).
        """
        if not self.prismatic.any():
            return slice(None)
        turning = ~self.prismatic
        turning.flags.writeable = False
        return turning

    def fk(self, q: ArrayLike) -> Transform:
        """The pose of the flange in base coordinates: q (..., n) -> Transform of shape (...). A NaN
        in q makes the pose NaN.

        Warns (UserWarning) if an angle is so large that it is probably in degrees.
        """

        def flange(joints: Sequence[Any]) -> list[Any]:
            *_, (_, (rotation, origin)) = self._walk(joints)
            return [*rotation, *origin]

        return _transform(self._evaluate(flange, q))

    def frames(self, q: ArrayLike) -> Transform:
        """All frames in base coordinates: the base frame and the frame after each joint. The last
        one is the flange.

        q (..., n) -> Transform of shape (..., n + 1). A NaN in q makes the frame after its joint
        and all later frames NaN. Warns as `fk` does.
        """

        def frames(joints: Sequence[Any]) -> list[Any]:
            walk = [BASE, *(frame for _, frame in self._walk(joints))]
            return [part for rotation, origin in walk for part in (*rotation, *origin)]

        parts = self._evaluate(frames, q)
        return _transform(parts.reshape(*parts.shape[:-1], len(self.links) + 1, 7))

    def jacobian(self, q: ArrayLike) -> Floats:
        """The geometric Jacobian at the flange in base coordinates: q (..., n) -> (..., 6, n).

        Each column is for a joint speed of 1 rad/s (1 m/s for a prismatic joint). Rows 0 to 2 are
        the linear velocity in m/s, rows 3 to 5 the angular velocity in rad/s. Source: Siciliano et
        al., Robotics, 2009, section 3.1.
        """
        n = len(self.links)

        def columns(joints: Sequence[Any]) -> list[Any]:
            walk = list(self._walk(joints))
            tip = walk[-1][1][1]
            found = []
            for link, ((rotation, origin), _) in zip(self.links, walk, strict=True):
                axis = turned(rotation, link.axis.tolist())
                arm = [t - o for t, o in zip(tip, origin, strict=True)]
                found.append((*axis, 0, 0, 0) if link.prismatic else (*cross(axis, arm), *axis))
            return [column[row] for row in range(6) for column in found]

        parts = self._evaluate(columns, q)
        return parts.reshape(*parts.shape[:-1], 6, n)

    def _walk(self, joints: Sequence[Any]) -> Iterator[tuple[Frame, Frame]]:
        """Yield, for each link from base to flange, the frame of its joint and the frame after the
        link.
        """
        frame = BASE
        for link, q in zip(self.links, joints, strict=True):
            joint, frame = link._carry(frame, q)
            yield joint, frame

    def _evaluate(self, work: Callable[[Sequence[Any]], list[Any]], q: ArrayLike) -> Floats:
        """Apply `work` to the joint values q (..., n), and return its results (..., k)."""
        n = len(self.links)
        values = floats(q, "q", n, finite=False)
        warn_if_degrees(values[..., self.turning], "q", 4, posture=1)
        if values.ndim == 1:
            return np.array(work(values.tolist()), dtype=float)
        parts = by_blocks(work, values.reshape(-1, n))
        return np.moveaxis(parts.reshape(len(parts), *values.shape[:-1]), 0, -1)

    def __repr__(self) -> str:
        return f"Arm({self.name!r}, {len(self.links)} joints)"

    if not TYPE_CHECKING:  # with __getattr__, a type checker would accept any attribute name

        def __getattr__(self, name):
            """Raise AttributeError; if the arm lacks `ik`, the message lists the methods it has."""
            words = f"{type(self).__name__!r} object has no attribute {name!r}"
            if name in ("ik", "branch", "branches"):
                kind = type(self)
                own = (each for each in dir(kind) if each[0] != "_")
                can = ", ".join(each for each in own if callable(getattr(kind, each)))
                words = (
                    f"{self.name} has no closed-form inverse and therefore no {name}; it has {can}"
                )
            raise AttributeError(words, name=name, obj=self)


@dataclass(frozen=True, init=False, repr=False, eq=False)
class ClosedFormArm(Arm):
    """An `Arm` with closed-form inverse kinematics: `ik` returns all solutions."""

    geometry: ClosedForm

    @staticmethod
    def _geometry_has() -> tuple[str, ...]:
        own = "branches", "carried", "ik", "gap", "singularities", "choose_free_joints"
        return *Arm._geometry_has(), *own

    @property
    def branches(self) -> Ints:
        """A read-only array (rows, flags) of +1 and -1: the configuration of each row of `ik`."""
        return self.geometry.branches

    def branch(self, *flags: int) -> int:
        """Return the row of `ik` with this configuration. Raises ValueError if there is none."""
        for row, wanted in enumerate(self.branches.tolist()):
            if all(isinstance(flag, SCALARS) for flag in flags) and list(flags) == wanted:
                return row
        count = self.branches.shape[1]
        raise ValueError(f"{self.name}: wanted {count} flags of +1 or -1, got {short(flags)}")

    def ik(self, pose: Any) -> Floats:
        """All joint values that bring the flange to `pose` (an instance of `target`, or a
        Transform): shape (...) -> (..., rows, n).

        Row k always has the configuration `branches[k]`. A row that does not exist contains only
        NaN. Angles lie in [-pi, pi]; limits are ignored (see `within`, `nearest`). Where branches
        coincide, the row is repeated. Raises TypeError if the pose is of another type.
        """
        return self.geometry.ik(pose)


def _measured(geometry: Geometry | Sequence[Link], limits: ArrayLike) -> Geometry:
    """Return links as a `Chain`, with the reach for these limits; return other geometries
    unchanged.
    """
    links = geometry.links if isinstance(geometry, Chain) else geometry
    if not isinstance(links, (tuple, list)) or hasattr(links, "links"):
        return cast(Geometry, geometry)
    links = chain(links)
    return Chain.measured(links, _pairs(limits, len(links)))


def _pairs(limits: ArrayLike, n: int) -> Floats:
    """Return the limits (n, 2) of n joints. Raises ValueError if their shape is wrong or a lower
    limit is not below the upper one.
    """
    pairs = floats(limits, "limits", 2)
    if pairs.shape != (n, 2) or (pairs[:, 0] >= pairs[:, 1]).any():
        got = pairs.tolist() if pairs.size < 50 else f"shape {pairs.shape}"
        raise ValueError(f"limits: wanted {n} pairs (lowest, highest), got {got}")
    return pairs


def _transform(parts: Floats) -> Transform:
    """Make a Transform from rotation w, x, y, z and origin x, y, z: (..., 7)."""
    missing = np.isnan(parts[..., 0])
    # A joint does not move an origin on its own axis, so a NaN angle leaves that origin finite. We
    # set it to NaN, too.
    if missing.any():
        parts[missing, 4:] = np.nan
    return Transform._of(Quaternion._of(parts[..., :4]), parts[..., 4:])
