"""Stepper motors: the pulses of a move, when each motor gets them, what they switch in its
windings, and whether its rotor follows.

The motors of the log loader (source 003, paper 1), from the points of a job to the pulses:

    arm = loader_arm(1.2, 1.0)
    q = station_postures(arm, points)        # (stations, 3); `out_of_reach` says why one is NaN
    n = counts(q, per_degree)                # (stations, 3) whole pulses: where the motors stand
    move = synchronised(n[0], n[1])          # or unsynchronised, or straight
    q_t = joint_values(move(t), per_degree)  # joint values at the times t, to draw
    move.pulses()                            # for each motor: when, and in which direction
    Stepper().run(times, signs).lost         # the steps that its rotor did not make

A motor's position is counted in pulses from the joint's zero. Whole pulses are taken from these
positions and never from the angle of a single move, so that no rounding adds up, however many moves
there are.
Source: 003, II.3 (the motors) and paper 1; errata S3-p to S3-t.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from .._arrays import ArrayLike, Floats, Ints, frozen
from .._validate import (
    broadcast,
    choice,
    floats,
    instance,
    number,
    positive,
    short,
    warn_if_degrees,
    whole,
)
from ..arms.arm import ClosedFormArm
from ..arms.elbow import ElbowGeometry
from ..arms.geometry import FREE, ROUNDING
from ..units import deg, wrapped

LIMIT = 500.0  # pulses per second, the greatest frequency. Source: 003, paper 1, (8)
SAMPLES = 1001  # postures along a straight line
SLACK = 1e-9  # this near to a whole pulse is the pulse
COUNTED = 2**52  # pulses from zero: so far a float counts them, and their differences, one by one
LISTED = 10_000_000  # pulses that one call lists
STRETCHES = 100_000  # of a move whose pulses are listed


# ---- From points to motor positions


def out_of_reach(arm: ClosedFormArm, point: ArrayLike) -> list[str]:
    """Why the loader's gripper cannot be at one point (3,): a list of reasons in words, empty if it
    can.

    Source: 003, paper 1, (1), and the inner bound |A - B| that it lacks (errata S3-r).
    """
    geometry, place = _loader(arm), _place(point, "point")
    row = arm.branch(+1, -1)
    missing = np.isnan(arm.ik(place)[row]).any()
    reasons = [geometry.gap(place, row).words] if missing else []
    if place[2] < -ROUNDING * geometry.elbow.reach:
        reasons.append(f"the point is under the floor: z = {place[2]:.4g} m")
    return reasons


def station_postures(arm: ClosedFormArm, points: ArrayLike) -> Floats:
    """The loader's postures at its stations, in their order: points (stations, 3) -> q (stations,
    3), alpha unwrapped.

    The elbow is up; beta lies in 0..180 degrees and gamma in 0..270 (for z >= 0). alpha begins in
    (-180, 180] and goes on by the shortest turn; on the vertical axis, where it is free, it stays
    as it was (0 at first). NaN rows where a point is out of reach. Source: 003, paper 1, table 1
    and (2) to (4); errata S3-p, S3-q.
    """
    reach, places = _loader(arm).elbow.reach, floats(points, "points", 3)
    if places.ndim != 2:
        raise ValueError(f"points: wanted shape (stations, 3), got {places.shape}")
    alpha, gamma, beta = arm.ik(places)[:, arm.branch(+1, -1)].T
    with np.errstate(over="ignore"):
        free = np.hypot(places[:, 0], places[:, 1]) <= FREE * reach
    before = 0.0
    for i in np.flatnonzero(~np.isnan(alpha)):
        alpha[i] = before = before if free[i] else float(wrapped(alpha[i], before))
    gamma = np.where(gamma < -90 * deg, gamma + 360 * deg, gamma)
    return np.stack([alpha, gamma, abs(beta)], axis=-1)  # folded, beta is 0 but for rounding


def shortest_turn(start: ArrayLike, goal: ArrayLike) -> Floats:
    """The shortest way from one angle to another, in [-pi, pi] rad; positive is counter-clockwise.

    Source: 003, paper 1, the two conditions for alpha; the second one has the wrong sign for alpha2
    < alpha1 (errata S3-q: from 170 to -170 degrees it turns -20 and not +20).
    """
    start, goal = floats(start, "start"), floats(goal, "goal")
    broadcast("start and goal", start.shape, goal.shape)
    return wrapped(goal - start)


def counts(q: ArrayLike, per_degree: ArrayLike) -> Ints:
    """The motors' positions at joint values q (..., n) rad, in whole pulses (..., n), the nearest
    ones.

    per_degree  (n,) or one number: pulses per degree of the joint, gear included. Source: 003,
                paper 1, the reduced angle phi of (5).
    The pulses of moves are differences, `np.diff(counts(q, per_degree), axis=-2)`: their sum is
    exact. A UserWarning where a joint is turned many times round: degrees were likely meant.
    """
    values = floats(q, "q")
    warn_if_degrees(values, "q", posture=1)
    return _counted(np.rint(_pulses(values, per_degree)), "q").astype(np.int64)


def joint_values(positions: ArrayLike, per_degree: ArrayLike) -> Floats:
    """Joint values in rad from motor positions in pulses (..., n): the way back from `counts`."""
    positions, per_degree = floats(positions, "positions"), _per_degree(per_degree)
    broadcast("positions and per_degree", positions.shape, per_degree.shape)
    with np.errstate(over="ignore"):
        return floats(positions / per_degree * deg, "positions / per_degree")


# ---- Moves: when a motor is where


@dataclass(frozen=True, eq=False)
class Move:
    """What n motors do between two stations: they stand at `positions` (k, n) in pulses at the
    times `t` (k,) in s and run evenly in between. The first time is 0, first and last positions are
    whole pulses. Both are read-only copies.

    `move(t)` gives the positions at the times t (...), as (..., n): not rounded; before and after
    the move they stand. ValueError: times that do not rise from 0, positions that do not fit.
    """

    t: Floats
    positions: Floats

    def __post_init__(self) -> None:
        t, positions = floats(self.t, "t"), floats(self.positions, "positions")
        if t.ndim != 1 or not t.size or t[0] != 0 or (np.diff(t) <= 0).any():
            raise ValueError(f"t: wanted times that rise from 0, got {short(t.tolist())}")
        if positions.ndim != 2 or len(positions) != len(t) or not positions.size:
            raise ValueError(f"positions: wanted ({len(t)}, motors), got {positions.shape}")
        _whole(_counted(positions, "positions")[[0, -1]], "first and last of positions")
        object.__setattr__(self, "t", frozen(t))
        object.__setattr__(self, "positions", frozen(positions))

    def __call__(self, t: ArrayLike) -> Floats:
        """The motors' positions in pulses at the times t (...) in seconds -> (..., n)."""
        t = floats(t, "t")
        return np.stack([np.interp(t, self.t, column) for column in self.positions.T], axis=-1)

    @property
    def duration(self) -> float:
        """Seconds."""
        return float(self.t[-1])

    @property
    def frequencies(self) -> Floats:
        """(k - 1, n) pulses per second in each stretch of the move, negative backwards."""
        with np.errstate(over="ignore"):
            return np.diff(self.positions, axis=0) / np.diff(self.t)[:, None]

    def pulses(self) -> list[tuple[Floats, Ints]]:
        """The pulse trains: for each motor (times, signs), both (pulses,); the signs are +1 and -1.

        A pulse comes when the motor is due one whole pulse further on (or back). So the motor lags
        by less than one pulse, makes exactly the pulses of the move, and after a change of
        direction, too, no two pulses come faster than the frequencies allow. ValueError: a move of
        more than `LISTED` pulses or `STRETCHES` stretches.
        """
        count, stretches = abs(self.positions[1:] - self.positions[:-1]).sum(), len(self.t) - 1
        if count > LISTED or stretches > STRETCHES:
            wanted = f"wanted a move of at most {LISTED} in {STRETCHES} stretches"
            raise ValueError(f"pulses: {wanted}, got one of {count:.0f} in {stretches}")
        return [_train(self.t, column) for column in self.positions.T]


def frequencies(pulses: ArrayLike, limit: float = LIMIT) -> Floats:
    """Pulse frequencies with which all motors need the same time: pulses (..., n) -> (..., n)
    pulses per second.

    The motor with the most pulses runs at `limit`; one that has none stands. Source: 003, paper 1,
    (5) to (8), with errata S3-s: its conditions (6) and (7) make the motor with the longest way the
    slowest. Right is omega1 phi2 = omega2 phi1, for every pair of motors: omega_i = limit phi_i /
    max phi.
    """
    pulses, limit = abs(floats(pulses, "pulses")), _limit(limit)
    if not (pulses.ndim and pulses.shape[-1]):
        raise ValueError(f"pulses: wanted one number for each motor, got shape {pulses.shape}")
    most = pulses.max(axis=-1, keepdims=True)
    return pulses / np.where(most > 0, most, 1) * limit


def unsynchronised(start: ArrayLike, goal: ArrayLike, limit: float = LIMIT) -> Move:
    """Trajectory a of the document: all motors start together at the greatest frequency, and each
    stops when it is done. start, goal (n,) motor positions -> Move. The gripper's path has a kink
    wherever a motor stops.

    Source: 003, paper 1, figure 4 (5 in the text), a.
    """
    start, goal = _stations(start, goal)
    ends = _seconds(abs(goal - start), limit)
    t = np.unique([0.0, *ends])
    share = np.minimum(t[:, None] / np.where(ends > 0, ends, 1), 1)
    return Move(t, start + (goal - start) * share)


def synchronised(start: ArrayLike, goal: ArrayLike, limit: float = LIMIT) -> Move:
    """Trajectory d of the document: all motors start and stop together, each at its own even
    frequency (`frequencies`). start, goal (n,) motor positions -> Move. No motor turns back; the
    gripper's path is a curve.

    No motion that keeps the limit is faster. Source: 003, paper 1, figure 4 (5 in the text), d.
    """
    start, goal = _stations(start, goal)
    duration = _seconds(abs(goal - start), limit).max()
    if duration == 0:
        return Move(np.zeros(1), start[None])
    return Move(np.array([0.0, duration]), np.stack([start, goal]))


def straight(
    arm: ClosedFormArm,
    start: ArrayLike,
    goal: ArrayLike,
    per_degree: ArrayLike,
    limit: float = LIMIT,
) -> Move:
    """Trajectories b and c of the document: the loader's gripper goes straight from one point (3,)
    to another -> Move.

    All motors start and stop together; at any moment the one with the most to do runs at the
    greatest frequency, which is the shortest time for this path. The figure is lost and the text
    does not say what tells b from c but that in c a motor first turns one way and then back; we
    read: two pairs of points, one law. c costs more pulses than its d.

    Source: 003, paper 1, figure 4 (5 in the text), b and c. ValueError: a point of the line that
    `out_of_reach` names.
    """
    _loader(arm)
    start, goal = _place(start, "start"), _place(goal, "goal")
    s = np.linspace(0, 1, SAMPLES)
    points = (1 - s)[:, None] * start + s[:, None] * goal
    q = station_postures(arm, points)
    gaps = np.flatnonzero(np.isnan(q).any(axis=-1))
    for i in (*gaps[:1], 0, -1):
        for reason in out_of_reach(arm, points[i]):
            raise ValueError(
                f"start and goal: wanted a line inside the workspace, at {s[i]:.0%} of it {reason}"
            )
    due = _counted(_pulses(q, per_degree), "per_degree")
    due[[0, -1]] = np.rint(due[[0, -1]])  # motors stand on whole pulses
    ahead = _seconds(abs(np.diff(due, axis=0)).max(axis=-1), limit)
    t = np.concatenate([[0.0], np.cumsum(ahead)])
    moved = np.concatenate([[True], np.diff(t) > 0])
    return Move(t[moved], due[moved])


# ---- Phases: what a pulse switches

_DRIVES = ("wave", "two-phase", "half-step")
_FEWEST = {"unipolar": 3, "bipolar": 2}
_DOCUMENTS = {"unipolar": 4, "bipolar": 2}  # windings of the motors of tables 1 and 2
COLUMNS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "unipolar": ("half winding a1", "half winding b1", "half winding a2", "half winding b2"),
        "bipolar": (
            "winding 1, end a1",
            "winding 1, end b1",
            "winding 2, end a2",
            "winding 2, end b2",
        ),
    }
)


def phases(drive: str, motor: str, windings: int | None = None) -> Ints:
    """The phase table, one row per pulse: (rows, columns) of 1, 0 and -1. Without `windings` it is
    that of the document's motors, columns as in `COLUMNS[motor]`.

    drive     "wave": one winding at a time; "two-phase": two neighbours, with more torque;
              "half-step": by turns, half the angle per pulse, so twice the pulses per degree
    motor     "unipolar": one column for each winding, 1 where it carries current. "bipolar": two
              for each, 1 at its positive end, -1 at its negative end. The document names the
              columns of both a1, b1, a2, b2 and means other wires (errata S3-t): with table 1's
              names the first row of table 2 would be two opposite half windings that cancel.
    windings  phases that are switched: 3 to 6 unipolar (of two the second pulls as much forwards as
              backwards), 4 if None: two windings with a tap in the middle, four halves. 2 to 6
              bipolar, 2 if None. Source: 003, II.3.1 ("two to six")

    The field turns evenly, once in n rows unipolar and 2 n bipolar, and in twice as many half
    steps. Source: 003, II.3.2, tables 1 and 2 (which shows only the +). Its appendices 3 and 4, the
    two-phase drive of the unipolar motor and the half step, are not in the text: these rows follow
    from the order of table 1.
    """
    choice(drive, "drive", _DRIVES)
    n = _windings(motor, windings)
    one = np.eye(n, dtype=np.int64)
    if motor == "bipolar":
        one = np.concatenate([one, -one])
    two = one + np.roll(one, -1, axis=0)
    rows = {"wave": one, "two-phase": two}.get(drive)
    if rows is None:
        rows = np.stack([one, two], axis=1).reshape(-1, n)
    if motor == "bipolar":
        rows = np.stack([rows, -rows], axis=-1).reshape(-1, 2 * n)
    return rows


def energised(table: ArrayLike, signs: ArrayLike, row: int = 0) -> Ints:
    """What the windings carry before the first and after every pulse: table (rows, columns), signs
    (pulses,) -> (pulses + 1, columns).

    The first answer is the row number `row` of the table, counted on from the last row to the
    first. A positive pulse takes the next row and a negative one the row before: the order is the
    direction. Source: 003, II.3.1. ValueError: signs that are not +1 or -1.
    """
    rows, signs = floats(table, "table"), floats(signs, "signs")
    if rows.ndim != 2 or not len(rows):
        raise ValueError(f"table: wanted rows as `phases` gives them, got shape {rows.shape}")
    if signs.ndim != 1 or (abs(signs) != 1).any():
        raise ValueError(f"signs: wanted +1 and -1 in an array (pulses,), got {short(signs)}")
    steps = np.concatenate([[0], np.cumsum(signs)]).astype(np.int64)
    return np.asarray(table)[(whole(row, "row", -COUNTED, COUNTED) + steps) % len(rows)]


# ---- Rotors: whether it follows

ROTORS = ("active", "passive")
SETTLED = 8.0  # time constants that a rotor gets to come to rest
NEARLY = 3.0  # time constants in which a current comes within 5 % of its value
FINE = (0.1, 0.25)  # a step of the integration: of the mechanics' shortest time, and of `rise`
INTEGRATED = 100_000  # steps of one run
FASTEST = 1e9  # rad/s
SLOWEST = 10  # pulses per second, where the search for a start frequency begins


@dataclass(frozen=True)
class Stepper:
    """A stepper motor as a weight on a magnetic spring that every pulse moves on.

    rotor     "active": a permanent magnet of two poles. "passive": soft iron with 2 n + 2 teeth
              between 2 n poles; it knows no sign of a current, so it is unipolar
    motor, windings, drive  as for `phases`
    torque    of one winding at most, N m
    inertia   of the rotor, kg m^2
    damping   torque per speed, N m s
    rise      time constant L/R of a winding's current, s; 0: at once

    Each winding with the current i (1: full) pulls with torque * i * sin(psi - N theta), where
    psi is its place in the ring of windings, theta the rotor's angle and N how often this comes
    round in one turn of the rotor (`periods`): 1, or the number of teeth. A passive rotor has i^2
    for i. The sum is one sine as well: torque * |pull| * sin(arg(pull) - N theta). ValueError:
    numbers that are not positive, a passive bipolar motor. Source: 003, II.3.1 (active and passive
    rotors); the sine is the usual first term, e.g. P. Acarnley, Stepping Motors, 2002, ch. 2 to 5.
    """

    rotor: str = "active"
    motor: str = "unipolar"
    windings: int = 4
    drive: str = "wave"
    torque: float = 0.02
    inertia: float = 1e-6
    damping: float = 6e-5
    rise: float = 1e-3

    def __post_init__(self) -> None:
        choice(self.rotor, "rotor", ROTORS)
        _windings(self.motor, self.windings)
        choice(self.drive, "drive", _DRIVES)
        for name in ("torque", "inertia", "damping"):
            positive(getattr(self, name), name)
        _not_negative(self.rise, "rise")
        if self.rotor == "passive" and self.motor == "bipolar":
            raise ValueError("motor: wanted 'unipolar' for a passive rotor, got 'bipolar'")

    @property
    def periods(self) -> int:
        """How often the pull of a winding comes round in one turn of the rotor."""
        return 1 if self.rotor == "active" else 2 * self.windings + 2

    @property
    def currents(self) -> Ints:
        """(rows, windings): what each winding carries in each row of `phases`; 1, 0 or -1."""
        table = phases(self.drive, self.motor, self.windings)
        return table[:, ::2] if self.motor == "bipolar" else table

    @property
    def step(self) -> float:
        """The angle of a step in rad: a full turn / (rows of the phase table * periods).

        Source: 003, II.3.1: 1 to 9 degrees with a passive rotor, 10 and more with an active one.
        """
        return 2 * math.pi / (len(self.currents) * self.periods)

    @property
    def pulls(self) -> np.ndarray[tuple[int, ...], np.dtype[np.complex128]]:
        """(rows,) complex: direction (in the ring) and strength (1: one winding) of each row."""
        turn = (math.pi if self.motor == "bipolar" else 2 * math.pi) / self.windings
        currents = self.currents if self.rotor == "active" else self.currents**2
        pulls: np.ndarray[tuple[int, ...], np.dtype[np.complex128]] = currents @ np.exp(
            1j * turn * np.arange(self.windings)
        )
        return pulls

    @property
    def holding_torque(self) -> float:
        """The greatest load, N m, that the motor bears at rest in every row: torque * |pull|."""
        return float(self.torque * abs(self.pulls).min())

    @property
    def starting_torque(self) -> float:
        """The greatest load, N m, that it still takes from every row to the next, however slowly.

        A load L bends row k by asin(L / s_k), s_k the strength; the next row takes over while both
        angles and the step sum up to less than half a turn. So L is the distance from 0 to the line
        between two neighbouring `pulls`. Source of the term: 003, II.3.1.
        """
        now, on = self.pulls, np.roll(self.pulls, -1) - self.pulls
        share = np.clip(-(now.conj() * on).real / abs(on) ** 2, 0, 1)
        return float(self.torque * abs(now + share * on).min())

    @property
    def commutation_frequency(self) -> float:
        """The frequency, pulses per second, above which a winding's current comes no longer within
        5 % of its value in one step; infinite where `rise` is 0. Source of the term: 003, II.3.1.
        """
        return 1 / (NEARLY * self.rise) if self.rise else math.inf

    def start_frequency(
        self, load: float = 0.0, load_inertia: float = 0.0, pulses: int = 48
    ) -> float:
        """The frequency, in whole pulses per second, at which the motor just follows from rest
        without losing a step: one more, and it loses some. At most `LIMIT`; 0 if even `SLOWEST` is
        too fast. Found by halving: far below it a motor with little damping may lose steps, too, by
        resonance.

        load, load_inertia  as for `run`. Source of the term: 003, II.3.1.
        """
        count = whole(pulses, "pulses", 1, INTEGRATED)
        low, high = SLOWEST - 1, int(LIMIT) + 1
        while high - low > 1:  # made at `low` (or too slow to ask), lost at `high`
            middle = (low + high) // 2
            times = np.arange(1, count + 1) / middle
            lost = self.run(times, np.ones(count), load, load_inertia).lost
            low, high = (low, middle) if lost else (middle, high)
        return float(low if low >= SLOWEST else 0)

    def run(
        self, times: ArrayLike, signs: ArrayLike, load: float = 0.0, load_inertia: float = 0.0
    ) -> "Run":
        """What the rotor does with pulses: it rests in the table's first row, gets them, and comes
        to rest again.

        times, signs  (pulses,) s, not falling, from 0 on; +1 or -1: as of `Move.pulses`
        load          N m, a weight on a drum: it pulls backwards, whatever the rotor does
        load_inertia  kg m^2, beside the rotor's

        Fourth order Runge-Kutta in equal steps from pulse to pulse; the page has the same
        (js/rotor.js). ValueError: a run of more than `INTEGRATED` steps.
        """
        t, turns = floats(times, "times"), floats(signs, "signs")
        if t.ndim != 1 or t.shape != turns.shape or (np.diff(t, prepend=0.0) < 0).any():
            wanted = "wanted times (pulses,) that do not fall, from 0 on, and as many signs"
            raise ValueError(f"times and signs: {wanted}, got {short(t)} and {short(turns)}")
        rows = energised(np.arange(len(self.currents))[:, None], turns)[:, 0]  # or refuses
        return _rotor_run(self, t, rows, turns, *_loaded(load, load_inertia))


@dataclass(frozen=True, eq=False)
class Run:
    """What a rotor did: at the times `t` (k,) in s its angle was `angle` (k,) and should have been
    `due` (k,), both in rad. `lost` is how many steps the angle is short of `due` in the end; of
    pulses with the sign -1 lost steps count negative.

    At rest it can stand only where the last row holds it. So the lost steps are always as many as
    the phase table has rows, or twice as many, and so on.
    """

    t: Floats
    angle: Floats
    due: Floats
    lost: int


def ramp(pulses: int, start: float, end: float, seconds: float) -> Floats:
    """The times (pulses,) in s of pulses whose frequency rises evenly from `start` to `end`, in so
    many seconds, stays there, and falls in the same way. A short move turns back before `end`.

    Frequencies in pulses per second; `seconds` 0: `end` at once. Pulse k comes when k pulses are
    due, the last one at the end: with start = end as in `Move.pulses`.
    """
    count = whole(pulses, "pulses", 1, INTEGRATED)
    low, high = (
        positive(x, name, "one positive number of pulses per second")
        for x, name in ((start, "start"), (end, "end"))
    )
    rise = _not_negative(seconds, "seconds")
    if low > high:
        raise ValueError(f"start and end: wanted a frequency that rises, got {low:g} to {high:g}")
    more = (high - low) / rise if rise > 0 else 0.0  # pulses per second, each second
    low = low if more else high
    top = min(high, math.sqrt(low**2 + more * count))
    up = (top - low) / more if more else 0.0
    done = (low + top) / 2 * up  # pulses in the ramp
    duration = 2 * up + (count - 2 * done) / top
    k = np.arange(1, count + 1)
    ahead = np.minimum(k, count - k)  # from the start, or from the end
    with np.errstate(divide="ignore", invalid="ignore"):
        climbing = 2 * ahead / (low + np.sqrt(low**2 + 2 * more * ahead))
    since = np.where(ahead < done, climbing, up + (ahead - done) / top)
    return np.where(k <= count - k, since, duration - since)


# ---- Private


def _windings(motor: str, windings: int | None) -> int:
    """How many windings a motor has, its own or the document's."""
    fewest = _FEWEST[choice(motor, "motor", tuple(COLUMNS))]
    return whole(_DOCUMENTS[motor] if windings is None else windings, "windings", fewest, 6)


def _not_negative(value: float, name: str) -> float:
    one = number(value, name)
    if one < 0:
        raise ValueError(f"{name}: wanted no negative number, got {short(value)}")
    return one


def _loaded(load: float, load_inertia: float) -> tuple[float, float]:
    return number(load, "load"), _not_negative(load_inertia, "load_inertia")


def _rotor_run(
    motor: Stepper, times: Floats, rows: Ints, signs: Floats, load: float, load_inertia: float
) -> Run:
    """The run of checked arguments."""
    table, periods, pulls = motor.currents.tolist(), motor.periods, motor.pulls
    sharp = 1 if motor.rotor == "active" else 2
    turn = (math.pi if motor.motor == "bipolar" else 2 * math.pi) / motor.windings
    across, along = ([f(turn * k) for k in range(motor.windings)] for f in (math.cos, math.sin))
    torque, damping, inertia = motor.torque, motor.damping, motor.inertia + load_inertia
    swing = math.sqrt(inertia / (periods * torque * float(abs(pulls).max())))
    longest = min(FINE[0] * min(swing, inertia / damping), FINE[1] * motor.rise or math.inf)
    settle = SETTLED * max(2 * inertia / damping, damping / inertia * swing * swing)
    ends = [*times.tolist(), (float(times[-1]) if len(times) else 0.0) + settle]
    gaps = np.diff(ends, prepend=0.0)
    with np.errstate(all="ignore"):
        counted = np.ceil(gaps / np.float64(longest))
    if not counted.sum() <= INTEGRATED:
        wanted = f"wanted a run of at most {INTEGRATED} steps of {longest:.3g} s"
        raise ValueError(f"times: {wanted}, got one of {ends[-1]:.4g} s")
    for name, value in (("load", load), ("torque", torque)):
        if not abs(value) / damping <= FASTEST:
            wanted = f"wanted one that turns the rotor at {FASTEST:g} rad/s at most"
            got = f"got {value:.4g} N m at a damping of {damping:.4g} N m s"
            raise ValueError(f"{name}: {wanted}, {got}")

    def pull(currents: list[float]) -> tuple[float, float]:
        x = y = 0.0
        for i, c, s in zip(currents, across, along, strict=True):
            i = i**sharp
            x += i * c
            y += i * s
        return x, y

    def faster(x: float, y: float, theta: float, omega: float) -> float:
        a = periods * theta
        drag = damping * omega + load
        return (torque * (y * math.cos(a) - x * math.sin(a)) - drag) / inertia

    rest = _resting(motor, load)
    theta, omega, time = rest[0], 0.0, 0.0
    currents = [float(i) for i in table[0]]
    t, angle, at = [0.0], [theta], [0]
    for k, (row, n, gap) in enumerate(zip(rows, counted, gaps, strict=True)):
        if not n:
            continue
        goal, h = table[row], gap / n
        left = math.exp(-h / 2 / motor.rise) if motor.rise else 0.0
        x0, y0 = pull(currents) if motor.rise else pull(goal)
        for _ in range(int(n)):
            currents = [g + (i - g) * left for i, g in zip(currents, goal, strict=True)]
            x1, y1 = pull(currents)
            currents = [g + (i - g) * left for i, g in zip(currents, goal, strict=True)]
            x2, y2 = pull(currents)
            a0 = faster(x0, y0, theta, omega)
            w1 = omega + h / 2 * a0
            a1 = faster(x1, y1, theta + h / 2 * omega, w1)
            w2 = omega + h / 2 * a1
            a2 = faster(x1, y1, theta + h / 2 * w1, w2)
            w3 = omega + h * a2
            a3 = faster(x2, y2, theta + h * w2, w3)
            theta += h / 6 * (omega + 2 * w1 + 2 * w2 + w3)
            omega += h / 6 * (a0 + 2 * a1 + 2 * a2 + a3)
            x0, y0 = x2, y2
            time += h
            t.append(time)
            angle.append(theta)
            at.append(k)
    sent = np.concatenate([[0.0], np.cumsum(signs)])
    due = (rest[rows] + (sent - rows) * motor.step)[at]
    lost = round((due[-1] - theta) / motor.step)
    return Run(frozen(np.array(t)), frozen(np.array(angle)), frozen(due), lost)


def _resting(motor: Stepper, load: float) -> Floats:
    """(rows,) rad: where the rotor rests in each row under a load, the first row's within half a
    period of 0 and the others after it. Where a row does not hold the load: where it pulls most.
    """
    pulls = motor.pulls
    bent = np.arcsin(np.clip(load / (motor.torque * abs(pulls)), -1, 1))
    ring = np.angle(pulls[0]) + 2 * np.pi / len(pulls) * np.arange(len(pulls))
    angles: Floats = (ring - bent) / motor.periods
    return angles


def _loader(arm: ClosedFormArm) -> ElbowGeometry:
    """The geometry of the loader arm."""
    hint = ": wanted a loader_arm(A, B)"
    geometry = instance(arm, ClosedFormArm, "arm", hint).geometry
    return instance(geometry, ElbowGeometry, "arm", hint)


def _place(value: ArrayLike, name: str) -> Floats:
    place = floats(value, name, 3)
    if place.ndim != 1:
        raise ValueError(f"{name}: wanted one single point (3,), got {place.shape}")
    return place


def _per_degree(value: ArrayLike) -> Floats:
    per_degree = floats(value, "per_degree")
    if per_degree.ndim > 1 or np.count_nonzero(per_degree <= 0):
        wanted = "wanted positive numbers of pulses, one for each motor"
        raise ValueError(f"per_degree: {wanted}, got {short(per_degree.tolist())}")
    return per_degree


def _limit(value: float) -> float:
    return positive(value, "limit", "one positive number of pulses per second")


def _seconds(pulses: Floats, limit: float) -> Floats:
    """How long these pulses take at the greatest frequency."""
    with np.errstate(over="ignore"):
        return floats(pulses / _limit(limit), "pulses / limit")


def _pulses(q: Floats, per_degree: ArrayLike) -> Floats:
    """Motor positions, not rounded."""
    per_degree = _per_degree(per_degree)
    broadcast("q and per_degree", q.shape, per_degree.shape)
    with np.errstate(over="ignore", invalid="ignore"):
        return np.multiply(q, per_degree / deg, order="F")  # each motor's in one run


def _counted(positions: Floats, name: str) -> Floats:
    """Motor positions that a float counts."""
    most = abs(positions).max(initial=0)
    if not most <= COUNTED:
        raise ValueError(f"{name}: wanted at most 2**52 pulses from zero, got {most:.6g}")
    return positions


def _whole(positions: Floats, name: str) -> None:
    if (positions != np.rint(positions)).any():
        got = short(positions.tolist())
        raise ValueError(f"{name}: wanted whole pulses (`counts` gives them), got {got}")


def _stations(start: ArrayLike, goal: ArrayLike) -> tuple[Floats, Floats]:
    """Two rows of whole pulses."""
    start, goal = floats(start, "start"), floats(goal, "goal")
    if start.ndim != 1 or not start.size or start.shape != goal.shape:
        wanted = "wanted one position for each motor"
        raise ValueError(f"start and goal: {wanted}, got {start.shape} and {goal.shape}")
    for value, name in ((start, "start"), (goal, "goal")):
        _whole(_counted(value, name), name)
    return start, goal


def _train(t: Floats, due: Floats) -> tuple[Floats, Ints]:
    """One motor's pulses, from where it is due (k,) at the times t: (times, signs)."""
    times, signs, stands = [np.empty(0)], [np.empty(0, dtype=np.int64)], due[0]
    direction = np.sign(np.diff(due))
    turning = direction.nonzero()[0]
    # the stretches before which it turns back
    turning = turning[1:][direction[turning[1:]] != direction[turning[:-1]]]
    ends = [*turning, len(due) - 1]
    for begin, end in zip([0, *turning], ends, strict=True):
        sign = 1 if due[end] >= due[begin] else -1
        way = sign * due[begin : end + 1]
        levels = np.arange(sign * stands + 1, np.floor(way[-1] + SLACK) + 1)
        after = np.searchsorted(np.maximum.accumulate(way), levels - SLACK)
        before = after - 1
        share = np.minimum((levels - way[before]) / (way[after] - way[before]), 1)
        since, until = t[begin + before], t[begin + after]
        times.append(since + share * (until - since))
        signs.append(np.full(len(levels), sign))
        stands += sign * len(levels)
    return np.concatenate(times), np.concatenate(signs)
