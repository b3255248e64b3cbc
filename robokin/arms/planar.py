"""Three levers in the plane z = 0: the arm of source 003, with levers OB, BA, AK and one more joint
than a point in the plane needs.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from .._arrays import ArrayLike, Floats, Sealed
from .._validate import broadcast, floats, positive, short, warn_if_degrees
from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, in_words
from .arm import Arm
from .geometry import ROUNDING, coordinates, distance, one_point
from .link import Link

Z = np.array([0.0, 0.0, 1.0])
MOST_ROWS = 2_000_000  # maximum number of rows of a table; computing them takes one or two seconds
PORTION = 1000  # number of tasks computed at once if each of them compares hundreds of postures


def three_lever(L: ArrayLike) -> "ThreeLeverArm":
    """The arm of source 003. L is the length of all its levers in metres, or the three lengths (3,)
    of OB, BA and AK. q is (gamma, beta, alpha), each from 0 to 180 degrees.

    O      the base, at the origin
    gamma  the angle of lever OB from the +x axis, counter-clockwise
    beta   the interior angle at B; at 180 degrees OB and BA are in line
    alpha  the interior angle at A; at 180 degrees BA and AK are in line
    K      the gripper, at the origin of the flange; where beta or alpha is below 180 degrees, the
           chain bends clockwise on its way from O to K

    Source: 003, III.1.1, figures 15 and 16, for equal levers; II.2 says that they may differ.
    Raises ValueError if L is neither one positive number nor three.

    >>> from robokin import deg, three_lever
    >>> three_lever((0.9, 1.1, 0.6)).points([90 * deg, 90 * deg, 180 * deg]).round(3) + 0.0
    array([[0. , 0. ],
           [0. , 0.9],
           [1.1, 0.9],
           [1.7, 0.9]])
    """
    return ThreeLeverArm("Three levers", ThreeLeverGeometry(L), np.array([(0, 180)] * 3) * deg)


@dataclass(frozen=True, init=False, repr=False, eq=False)
class ThreeLeverGeometry(Sealed):
    """Three levers (see `three_lever`). There is no inverse, because a family of postures cannot be
    listed row by row.

    levers  the lengths of OB, BA, AK
    lever   their mean, the unit for lengths such as tolerances and the document's L/7
    inner   |OB - BA| + AK, which is one lever length if the levers are equal; a reachable point is
            farther than this from the base
    """

    target = np.ndarray
    levers: tuple[float, float, float]
    lever: float
    inner: float
    reach: float
    links: tuple[Link, ...]

    def __init__(self, L: ArrayLike) -> None:
        levers = floats(L, "L")
        if levers.shape not in ((), (3,)) or not (levers > 0).all():
            wanted = "one positive length in metres, or three"
            raise ValueError(f"L: wanted {wanted}, got {short(L)}")
        a, b, c = np.broadcast_to(levers, 3).tolist()
        folded = Quaternion.from_angle_axis(-180 * deg, Z)
        # an interior angle of 0 folds the next lever back onto this one
        links = (
            Link(),
            Link(Transform(folded, (a, 0, 0))),
            Link(Transform(folded, (b, 0, 0)), after=Transform(translation=(c, 0, 0))),
        )
        lever = a if a == b == c else (a + b + c) / 3
        vars(self).update(levers=(a, b, c), lever=lever, inner=abs(a - b) + c, reach=a + b + c)
        vars(self).update(links=links)


@dataclass(frozen=True, init=False, repr=False, eq=False)
class ThreeLeverArm(Arm):
    """An arm of three levers (see `three_lever`). It reaches a point K in a family of postures, one
    for each value of the free angle alpha; `family` replaces `ik`.

    The arm reaches the points with |OB - BA| + AK < KO <= OB + BA + AK; if all levers have the
    length L, this is L < KO <= 3 L. In all postures for such a point, B is on the counter-clockwise
    side of the line OK. Nearer points also have postures on the other side, and therefore a second
    family. The methods take points (..., 2), points (..., 3) with z = 0, or Transforms. With
    `limited=True`, they also keep gamma between 0 and 180 degrees, which the document requires but
    does not check (errata S3-g). gamma is not wrapped: it lies between the direction of K and that
    direction plus half a turn.
    """

    geometry: ThreeLeverGeometry

    @property
    def levers(self) -> Floats:
        """The lengths (3,) of OB, BA, AK, in metres."""
        return np.array(self.geometry.levers)

    @property
    def lever(self) -> float:
        """The mean length of the levers in metres."""
        return self.geometry.lever

    def points(self, q: ArrayLike) -> Floats:
        """The points O, B, A, K in the plane: q (..., 3) -> (..., 4, 2). Source: 003, (15)-(21)."""
        gamma, beta, alpha = np.moveaxis(floats(q, "q", 3, finite=False), -1, 0)
        direction = np.stack(
            [0 * gamma, gamma, gamma + beta - np.pi, gamma + beta + alpha - 2 * np.pi], axis=-1
        )
        steps = np.stack([np.cos(direction), np.sin(direction)], axis=-1)
        steps[..., 0, :] = 0.0
        steps[..., 1:, :] *= self.levers[:, None]
        return np.cumsum(steps, axis=-2)

    def alpha_range(self, point: Any, limited: bool = True) -> tuple[Floats, Floats]:
        """The lowest and the highest alpha with which the arm reaches the point, each (...); NaN if
        it is out of reach.

        At the lowest alpha, beta is 180 degrees, gamma is 0, or alpha itself is 0 (which requires
        that AK is shorter than both other levers). At the highest alpha, alpha or gamma is 180
        degrees, since gamma increases with alpha along the family. Source: 003, (2) and (3), figure
        17.
        """
        KO, phi = self._polar(point)
        low, high = self._lowest(KO), np.where(np.isnan(KO), np.nan, np.pi)
        if limited:
            at_zero, at_half = self._alpha_of_gamma(KO, -phi), self._alpha_of_gamma(KO, np.pi - phi)
            low = np.where(phi + self._gamma1(KO, low) < 0, at_zero, low)
            high = np.where(phi + self._gamma1(KO, high) > np.pi, at_half, high)
            nowhere = ~(low <= high) | (phi + self._gamma1(KO, low) > np.pi + ROUNDING)
            low, high = np.where(nowhere, np.nan, low), np.where(nowhere, np.nan, high)
        return low, high

    def family(self, point: Any, alpha: ArrayLike) -> Floats:
        """The posture that reaches the point with the free angle alpha: point (...), alpha (...) ->
        q (..., 3).

        The result is NaN where there is none (see `alpha_range`). `within(arm, q)` shows which
        angles lie between 0 and 180 degrees: alpha and beta always do, gamma often does not. For
        one point and many alphas: `family(point, alphas)`; for many points and many alphas:
        `family(points[:, None], alphas)`. Source: 003, (4)-(14) and table 3, with errata S3-a (the
        direction of K) and S3-d (its last row) corrected.
        """
        (KO, phi), angles = self._polar(point), floats(alpha, "alpha", finite=False)
        broadcast("point and alpha", KO.shape, angles.shape)
        return self._posture(KO, phi, angles)

    def table(self, point: Any, step: float = 0.01 * deg, limited: bool = True) -> Floats:
        """Table 3 of the document: the postures for one point at alpha_min, alpha_min + step, ...
        up to 180 degrees.

        Returns an array (rows, 3), with no rows if the point is out of reach. With `limited=True`,
        rows with gamma outside 0 to 180 degrees are left out. Raises ValueError if the step would
        give more than two million rows. Source: 003, III.1.3 (step 0.01 degrees), paper 2 (0.001);
        errata S3-e.
        """
        low = self.alpha_range(one_point(point), limited=False)[0]
        width = positive(step, "step", "one positive angle in radians")
        many = 0.0 if np.isnan(low) else (np.pi - low) / width + 1 + 1e-9
        if many > MOST_ROWS:
            raise ValueError(
                f"step: wanted a step for at most {MOST_ROWS} rows, got {step!r}: {many:.3g} rows"
            )
        rows = self.family(point, np.minimum(low + width * np.arange(int(many)), np.pi))
        return rows[(rows[:, 0] >= 0) & (rows[:, 0] <= np.pi)] if limited else rows

    def sweep(
        self, point: Any, previous: ArrayLike, step: float = 0.01 * deg, limited: bool = True
    ) -> tuple[Floats, Floats]:
        """The document's choice: the first row of `table` with the smallest S, the sum of the
        absolute angle changes.

        Returns (q, S) for one point and one posture `previous` (3,); both are NaN if there is no
        row. S, in radians, is a substitute for the motors' energy, which the document does not
        model (errata S3-i). Source: 003, III.4.1, figure 29.
        """
        before, rows = self._previous(previous), self.table(point, step, limited)
        if before.ndim != 1:
            raise ValueError(f"previous: wanted one posture (3,), got shape {before.shape}")
        if not len(rows):
            return np.full(3, np.nan), np.full((), np.nan)
        S = sum(abs(rows[:, i] - before[i]) for i in range(3))
        best = S.argmin()
        return rows[best], S[best]

    def least(self, point: Any, previous: ArrayLike, limited: bool = True) -> tuple[Floats, Floats]:
        """The posture at the point that exactly minimises S = |d alpha| + |d beta| + |d gamma|.

        Returns (q, S): points (...) and previous (..., 3) -> (..., 3) and (...), NaN where the
        point is out of reach. As a function of alpha, S has a kink wherever an angle equals its
        previous value. Between the kinks and the ends, the minimum can only be where a sum such as
        alpha + beta - gamma is stationary. It is therefore enough to compare a few postures, and no
        step size is needed (errata S3-h: in 60 random tasks, the sweep with steps of 0.01 degrees
        gives an S up to 0.0062 degrees above the minimum).
        """
        a, b, c = self.geometry.levers
        before = self._previous(previous)
        KO, phi = self._polar(point)
        shape = broadcast("point and previous", KO.shape, before.shape[:-1])
        KO, phi = np.broadcast_to(KO, shape), np.broadcast_to(phi, shape)
        gamma0, beta0, alpha0 = np.moveaxis(np.broadcast_to(before, (*shape, 3)), -1, 0)
        low, high = (np.broadcast_to(end, shape) for end in self.alpha_range(point, limited))

        # If beta keeps its previous value, the distance OA is fixed, and A is on one side or the
        # other of the line OK.
        BAO, at_A = _beside(b, a, beta0), _angle(_across(a, b, beta0), c, KO)
        alphas = np.stack(
            [
                low,
                high,
                alpha0,
                self._alpha_of_gamma(KO, gamma0 - phi),
                BAO + at_A,
                BAO - at_A,
                *([self._bottom(KO, low, high)] if a == b == c else self._level(KO, low, high)),
            ],
            axis=-1,
        )
        alphas = np.clip(
            np.where(np.isnan(alphas), low[..., None], alphas), low[..., None], high[..., None]
        )
        rows = self._posture(KO[..., None], phi[..., None], alphas)
        S = abs(rows - before[..., None, :]).sum(axis=-1)
        best = np.where(np.isnan(S), np.inf, S).argmin(axis=-1)[..., None]
        return (
            np.take_along_axis(rows, best[..., None], axis=-2)[..., 0, :],
            np.take_along_axis(S, best, axis=-1)[..., 0],
        )

    def out_of_reach(self, point: Any) -> str:
        """Return the reason why a single point is out of reach, or "" if it is within reach.
        Source: 003, III.1.2: L < KO < 3 L.
        """
        x, y, z = coordinates(one_point(point))
        (a, b, c), inner, reach = self.geometry.levers, self.geometry.inner, self.reach
        KO = float(distance(x, y))
        if abs(z) > ROUNDING * self.lever:
            return f"it lies {in_words(float(abs(z)))} off the plane z = 0 of the levers"
        if KO <= inner:
            what = "one lever" if a == b == c else "|OB \N{MINUS SIGN} BA| + AK"
            return (
                f"it lies {in_words(KO)} from the base, not farther than {what} "
                f"({in_words(inner)}), which this course does not allow"
            )
        if KO > reach * (1 + ROUNDING):
            far = f"farther than three levers ({in_words(reach)})"
            return f"it lies {in_words(KO)} from the base, {far}"
        if np.isnan(self.alpha_range((x, y))[0]):
            return "every posture that reaches it has gamma outside 0 to 180 degrees"
        return ""

    def _previous(self, previous: ArrayLike) -> Floats:
        values = floats(previous, "previous", 3)
        warn_if_degrees(values, "previous", 4, posture=1)
        return values

    def _polar(self, point: Any) -> tuple[Floats, Floats]:
        """The distance KO and the direction phi of points (...), NaN where the point is out of
        reach.
        """
        x, y, z = coordinates(point)
        KO = distance(x, y)
        reached = (
            (KO > self.geometry.inner)
            & (KO <= self.reach * (1 + ROUNDING))
            & (abs(z) <= ROUNDING * self.lever)
        )
        return np.where(reached, KO, np.nan), np.where(reached, np.arctan2(y, x), np.nan)

    def _lowest(self, KO: Floats) -> Floats:
        """The alpha at which O, B and A are in line, or 0 if K is too near for that."""
        a, b, c = self.geometry.levers
        return np.where(KO <= a + b - c, 0.0, _angle(c, a + b, KO))

    def _posture(self, KO: Floats, phi: Floats | float, alpha: Floats) -> Floats:
        a, b, c = self.geometry.levers
        low = self._lowest(KO)
        alpha = np.where(
            (alpha >= low - ROUNDING) & (alpha <= np.pi + ROUNDING),
            np.clip(alpha, low, np.pi),
            np.nan,
        )
        KB = _across(b, c, alpha)
        gamma = phi + _angle(KO, a, KB)
        beta = _angle(KB, a, KO) + _beside(b, c, alpha)
        return np.stack(np.broadcast_arrays(gamma, beta, alpha), axis=-1)

    def _gamma1(self, KO: Floats, alpha: Floats) -> Floats:
        """The angle KOB of the document's figure 18."""
        a, b, c = self.geometry.levers
        return _angle(KO, a, _across(b, c, alpha))

    def _alpha_of_gamma(self, KO: Floats, gamma1: Floats) -> Floats:
        """The alpha that gives the angle KOB, NaN where there is none."""
        a, b, c = self.geometry.levers
        KB = np.sqrt(KO**2 + a**2 - 2 * KO * a * np.cos(gamma1))
        spare = (KB - abs(b - c)) * (KB + abs(b - c))
        half = np.sqrt(np.maximum(spare, 0)) / (2 * np.sqrt(b * c))
        exists = (half <= 1 + ROUNDING) & (KB >= abs(b - c)) & (gamma1 >= 0) & (gamma1 <= np.pi)
        return np.where(exists, 2 * np.arcsin(np.minimum(half, 1)), np.nan)

    def _bottom(self, KO: Floats, low: Floats, high: Floats) -> Floats:
        """For equal levers, the alpha between low and high that minimises alpha + beta - gamma; the
        other sums have no minimum between the ends. Each of six rounds takes 33 samples and narrows
        the interval to the neighbours of the best one. Half of the digits of alpha are enough,
        since the sum is flat at its minimum.

        beta - gamma is a right angle less alpha / 2, plus the difference of the angles at B and at
        O in the triangle OBK, which the law of tangents gives.
        """
        for _ in range(6):
            alphas = low[..., None] + (high - low)[..., None] * np.linspace(0, 1, 33)
            KB = 2 * self.lever * np.sin(alphas / 2)
            more, less = KO[..., None] + KB, KO[..., None] - KB
            around = np.sqrt(np.maximum(more**2 - self.lever**2, 0))
            beside = np.sqrt(np.maximum(self.lever**2 - less**2, 0))
            sums = alphas / 2 + 2 * np.arctan2(less * around, more * beside)
            best = sums.argmin(axis=-1)[..., None]
            low = np.take_along_axis(alphas, np.maximum(best - 1, 0), axis=-1)[..., 0]
            high = np.take_along_axis(alphas, np.minimum(best + 1, 32), axis=-1)[..., 0]
        return (low + high) / 2

    def _level(self, KO: Floats, low: Floats, high: Floats) -> Floats:
        """For levers of any lengths, six alphas (6, ...): the first and the last between low and
        high at which beta + alpha - gamma, gamma - beta + alpha, or gamma + beta - alpha is
        stationary. Where there is none, another alpha takes its place. (gamma + beta + alpha, the
        direction of the last lever, is stationary only where O, B and A are in line.)
        """
        if KO.size > PORTION:
            flat = np.stack([KO, low, high]).reshape(3, -1)
            starts = range(0, KO.size, PORTION)
            parts = [self._level(*flat[:, i : i + PORTION]) for i in starts]
            return np.concatenate(parts, axis=-1).reshape(6, *KO.shape)
        alphas = low[..., None] + (high - low)[..., None] * np.linspace(0, 1, 257)
        turns = np.diff(np.sign(self._slopes(KO[..., None], alphas)), axis=-2) != 0
        first, last = turns.argmax(axis=-2), 255 - turns[..., ::-1, :].argmax(axis=-2)
        cell = np.concatenate([first, last], axis=-1)  # (..., 6)
        start, end = (np.take_along_axis(alphas, cell + i, axis=-1) for i in (0, 1))
        for _ in range(7):
            alphas = start[..., None] + (end - start)[..., None] * np.linspace(0, 1, 17)
            slopes = self._slopes(KO[..., None, None], alphas)
            own = np.stack([slopes[..., i, :, i % 3] for i in range(6)], axis=-2)
            cell = (np.diff(np.sign(own), axis=-1) != 0).argmax(axis=-1)[..., None]
            start, end = (np.take_along_axis(alphas, cell + i, axis=-1)[..., 0] for i in (0, 1))
        return np.moveaxis((start + end) / 2, -1, 0)

    def _slopes(self, KO: Floats, alpha: Floats) -> Floats:
        """The derivatives of the three sums of `_level` with respect to alpha, up to a positive
        factor: (..., 3).

        With K fixed, gamma, beta and alpha change in proportion to the areas of the triangles BAK,
        OAK (negative where A lies counter-clockwise of OK) and OBK.
        """
        a, b, c = self.geometry.levers
        gamma, beta, alpha = np.moveaxis(self._posture(KO, 0.0, alpha), -1, 0)
        height = a * np.sin(gamma)  # height of B above the line from O to K
        changes = [b * c * np.sin(alpha), KO * (b * np.sin(gamma + beta) - height), KO * height]
        return np.stack([sum(changes) - 2 * change for change in changes], axis=-1)


def _across(a: float, b: float, angle: Floats) -> Floats:
    """The third side of a triangle with two sides a and b and the given angle between them. For
    equal sides, the result equals the document's 2 a sin(angle / 2) to the last bit.
    """
    chord = 2 * np.sqrt(a * b) * np.sin(angle / 2)
    return distance(a - b + 0 * chord, chord)


def _beside(a: float, b: float, angle: Floats) -> Floats:
    """The angle between the side a and the third side of the same triangle. The law of tangents
    loses no digits if the triangle is flat.
    """
    half = angle / 2
    return (np.pi - angle) / 2 + np.arctan2((b - a) * np.cos(half), (b + a) * np.sin(half))


def _angle(a: Floats | float, b: Floats | float, c: Floats | float) -> Floats:
    """The angle between the sides a and b of a triangle, opposite c; NaN if there is no such
    triangle. We use the half-angle form of the law of cosines, since the document's arccos loses
    half of the digits if the triangle is flat.
    """
    with np.errstate(invalid="ignore"):
        beside, around = _spare(c, b, a) * _spare(c, a, b), _spare(a, b, c) * (a + b + c)
        flat = 4 * ROUNDING * (a + b) ** 2
        beside, around = (
            np.where((part < 0) & (part > -flat), 0.0, part) for part in (beside, around)
        )
        return 2 * np.arctan2(np.sqrt(beside), np.sqrt(around))


def _spare(a: Floats | float, b: Floats | float, c: Floats | float) -> Any:
    """The excess of the sides a and b together over the side c. It is rounded in the same way for
    every angle, so that all angles of a nearly flat triangle belong to the same triangle and the
    chain closes.
    """
    return np.maximum(a, b) - c + np.minimum(a, b)
