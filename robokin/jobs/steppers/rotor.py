"""Rotors: the torques on a rotor, and whether it follows its pulses."""

import math
from dataclasses import dataclass

import numpy as np

from ..._arrays import ArrayLike, Floats, Ints, Sealed, frozen
from ..._validate import choice, floats, number, positive, short, whole
from .moves import LIMIT
from .phase_table import DRIVES, energised, phases, read_windings

ROTORS = ("active", "passive")
SETTLED = 8.0  # number of time constants after which a rotor is at rest
NEARLY = 3.0  # number of time constants until a current is within 5 % of its final value
# the integration step, as a fraction of the shortest mechanical time constant and of `rise`
FINE = (0.1, 0.25)
INTEGRATED = 100_000  # maximum number of steps of one run
FASTEST = 1e9  # rad/s: the maximum speed that a load or torque may cause
SLOWEST = 10  # pulses per second: the search for a start frequency begins here


@dataclass(frozen=True)
class Stepper(Sealed):
    """A stepper motor modelled as an inertia on a magnetic spring. Each pulse moves the spring
    forward.

    rotor     "active" (a permanent magnet with two poles) or "passive" (soft iron with 2 n + 2
              teeth between 2 n poles; the sign of a current has no effect, so the motor is
              unipolar)
    motor, windings, drive  as in `phases`
    torque    the maximum torque of one winding, N m
    inertia   the rotor's moment of inertia, kg m^2
    damping   braking torque per angular speed, N m s
    rise      time constant L/R of a winding's current, s; with 0, the current changes at once

    A winding with the current i (1 is full current) pulls with torque * i * sin(psi - N theta),
    where psi is its position in the ring of windings, theta the rotor's angle and N the number of
    periods of the pull in one revolution of the rotor (`periods`), which is 1 or the number of
    teeth. For a passive rotor, i^2 replaces i. The sum over the windings is a single sine as well:
    torque * |pull| * sin(arg(pull) - N theta). Raises ValueError if a number is not positive or a
    passive motor is bipolar. Source: 003, II.3.1 (active and passive rotors); the sine is the usual
    first harmonic, see for example P. Acarnley, Stepping Motors, 2002, ch. 2 to 5.
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
        read_windings(self.motor, self.windings)
        choice(self.drive, "drive", DRIVES)
        for name in ("torque", "inertia", "damping"):
            positive(getattr(self, name), name)
        _not_negative(self.rise, "rise")
        if self.rotor == "passive" and self.motor == "bipolar":
            raise ValueError("motor: wanted 'unipolar' for a passive rotor, got 'bipolar'")

    @property
    def periods(self) -> int:
        """The number of periods of a winding's pull in one revolution of the rotor."""
        return 1 if self.rotor == "active" else 2 * self.windings + 2

    @property
    def currents(self) -> Ints:
        """The current of each winding in each row of `phases`: (rows, windings) of 1, 0 and -1."""
        table = phases(self.drive, self.motor, self.windings)
        return table[:, ::2] if self.motor == "bipolar" else table

    @property
    def step(self) -> float:
        """The angle of a step in rad: a full turn divided by (rows of the phase table * periods).

        Source: 003, II.3.1: 1 to 9 degrees with a passive rotor, 10 and more with an active one.
        """
        return 2 * math.pi / (len(self.currents) * self.periods)

    @property
    def pulls(self) -> np.ndarray[tuple[int, ...], np.dtype[np.complex128]]:
        """The pull of each row as a complex number, (rows,): its direction in the ring of windings
        and its strength (1 is one winding).
        """
        turn = (math.pi if self.motor == "bipolar" else 2 * math.pi) / self.windings
        currents = self.currents if self.rotor == "active" else self.currents**2
        pulls: np.ndarray[tuple[int, ...], np.dtype[np.complex128]] = currents @ np.exp(
            1j * turn * np.arange(self.windings)
        )
        return pulls

    @property
    def holding_torque(self) -> float:
        """The maximum load in N m that every row can hold at rest: the least torque * |pull|."""
        return float(self.torque * abs(self.pulls).min())

    @property
    def starting_torque(self) -> float:
        """The maximum load in N m that the motor can move from every row to the next at low speed.

        A load L deflects the rotor in row k by asin(L / s_k), where s_k is the strength of the row.
        The next row can take over as long as both angles and the step add up to less than half a
        turn. The maximum L is therefore the distance from 0 to the line between two neighbouring
        `pulls`. Source of the term: 003, II.3.1.
        """
        now, on = self.pulls, np.roll(self.pulls, -1) - self.pulls
        share = np.clip(-(now.conj() * on).real / abs(on) ** 2, 0, 1)
        return float(self.torque * abs(now + share * on).min())

    @property
    def commutation_frequency(self) -> float:
        """The frequency, in pulses per second, above which a winding's current does not get within
        5 % of its final value in one step; infinite if `rise` is 0. Source of the term: 003,
        II.3.1.
        """
        return 1 / (NEARLY * self.rise) if self.rise else math.inf

    def start_frequency(
        self, load: float = 0.0, load_inertia: float = 0.0, pulses: int = 48
    ) -> float:
        """The highest frequency, in whole pulses per second, at which the motor follows from rest
        without losing a step; at one pulse per second more, it loses steps. It is at most `LIMIT`,
        and 0 if even `SLOWEST` is too fast. We find it by bisection, which may miss that a motor
        with little damping also loses steps at much lower frequencies, because of resonance.

        load, load_inertia  as in `run`. Source of the term: 003, II.3.1.
        """
        count = whole(pulses, "pulses", 1, INTEGRATED)
        low, high = SLOWEST - 1, int(LIMIT) + 1
        # the motor loses no steps at `low` (or `low` is too slow to try), and loses steps at `high`
        while high - low > 1:
            middle = (low + high) // 2
            times = np.arange(1, count + 1) / middle
            lost = self.run(times, np.ones(count), load, load_inertia).lost
            low, high = (low, middle) if lost else (middle, high)
        return float(low if low >= SLOWEST else 0)

    def run(
        self, times: ArrayLike, signs: ArrayLike, load: float = 0.0, load_inertia: float = 0.0
    ) -> "RotorMotion":
        """Simulate the rotor, which rests in the first row of the table, receives the pulses, and
        comes to rest again.

        times, signs  (pulses,) as `Move.pulses` returns them: times in s, from 0 on and never
                      decreasing, and +1 or -1
        load          N m; like a weight on a drum, it always pulls backwards
        load_inertia  kg m^2, in addition to the rotor's

        We use the fourth-order Runge-Kutta method, with equal steps from pulse to pulse;
        js/rotor.js does the same in a page. Raises ValueError if the run has more than `INTEGRATED`
        steps.
        """
        t, turns = floats(times, "times"), floats(signs, "signs")
        if t.ndim != 1 or t.shape != turns.shape or (np.diff(t, prepend=0.0) < 0).any():
            wanted = "wanted times (pulses,), at least 0 and never decreasing, and as many signs"
            raise ValueError(f"times and signs: {wanted}, got {short(t)} and {short(turns)}")
        # `energised` raises ValueError for signs other than +1 and -1.
        rows = energised(np.arange(len(self.currents))[:, None], turns)[:, 0]
        return _rotor_run(self, t, rows, turns, *_loaded(load, load_inertia))


@dataclass(frozen=True, eq=False)
class RotorMotion(Sealed):
    """The motion of a rotor: at the times `t` (k,) in s its angle was `angle` (k,) and should have
    been `due` (k,), both in rad. `lost` is the number of steps by which the final angle is short of
    `due`; steps lost from pulses with the sign -1 count as negative.

    At rest, the rotor can only be where the last row holds it, so the number of lost steps is
    always a multiple of the number of rows of the phase table.
    """

    t: Floats
    angle: Floats
    due: Floats
    lost: int


def ramp(pulses: int, start: float, end: float, seconds: float) -> Floats:
    """The times (pulses,) in s of pulses whose frequency rises linearly from `start` to `end`
    within `seconds`, stays there, and falls in the same way. In a short move, it begins to fall
    before it reaches `end`.

    Frequencies are in pulses per second; with `seconds=0`, the frequency is `end` from the
    beginning. Pulse k is sent when k pulses are due, so the last one is sent at the end of the
    move. If `start` and `end` are equal, the times are those that `Move.pulses` returns at a
    constant frequency.
    """
    count = whole(pulses, "pulses", 1, INTEGRATED)
    low, high = (
        positive(x, name, "one positive number of pulses per second")
        for x, name in ((start, "start"), (end, "end"))
    )
    rise = _not_negative(seconds, "seconds")
    if low > high:
        raise ValueError(f"start and end: wanted start <= end, got {low:g} and {high:g}")
    more = (high - low) / rise if rise > 0 else 0.0  # pulses per second squared
    low = low if more else high
    top = min(high, math.sqrt(low**2 + more * count))
    up = (top - low) / more if more else 0.0
    done = (low + top) / 2 * up  # number of pulses in one ramp
    duration = 2 * up + (count - 2 * done) / top
    k = np.arange(1, count + 1)
    ahead = np.minimum(k, count - k)  # number of pulses from the nearer end of the move
    with np.errstate(divide="ignore", invalid="ignore"):
        climbing = 2 * ahead / (low + np.sqrt(low**2 + 2 * more * ahead))
    since = np.where(ahead < done, climbing, up + (ahead - done) / top)
    return np.where(k <= count - k, since, duration - since)


# ---- Private


def _not_negative(value: float, name: str) -> float:
    one = number(value, name)
    if one < 0:
        raise ValueError(f"{name}: wanted a number that is not negative, got {short(value)}")
    return one


def _loaded(load: float, load_inertia: float) -> tuple[float, float]:
    return number(load, "load"), _not_negative(load_inertia, "load_inertia")


def _rotor_run(
    motor: Stepper, times: Floats, rows: Ints, signs: Floats, load: float, load_inertia: float
) -> RotorMotion:
    """`Stepper.run` without argument checks."""
    table, periods = motor.currents.tolist(), motor.periods
    sharp = 1 if motor.rotor == "active" else 2
    turn = (math.pi if motor.motor == "bipolar" else 2 * math.pi) / motor.windings
    across, along = ([f(turn * k) for k in range(motor.windings)] for f in (math.cos, math.sin))
    torque, damping, inertia = motor.torque, motor.damping, motor.inertia + load_inertia
    gaps, steps = _integration_steps(motor, times, load, inertia)

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
    for k, (row, n, gap) in enumerate(zip(rows, steps, gaps, strict=True)):
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
    return RotorMotion(frozen(np.array(t)), frozen(np.array(angle)), frozen(due), lost)


def _integration_steps(
    motor: Stepper, times: Floats, load: float, inertia: float
) -> tuple[Floats, Floats]:
    """The times in s before each pulse and until the rotor is at rest (pulses + 1,), and the number
    of equal integration steps in each of them. Raises ValueError if there are too many steps.
    """
    torque, damping = motor.torque, motor.damping
    swing = math.sqrt(inertia / (motor.periods * torque * float(abs(motor.pulls).max())))
    longest = min(FINE[0] * min(swing, inertia / damping), FINE[1] * motor.rise or math.inf)
    settle = SETTLED * max(2 * inertia / damping, damping / inertia * swing * swing)
    ends = [*times.tolist(), (float(times[-1]) if len(times) else 0.0) + settle]
    gaps: Floats = np.diff(ends, prepend=0.0)
    with np.errstate(all="ignore"):
        steps = np.ceil(gaps / np.float64(longest))
    if not steps.sum() <= INTEGRATED:
        wanted = f"wanted a run of at most {INTEGRATED} steps of {longest:.3g} s"
        raise ValueError(f"times: {wanted}, got one of {ends[-1]:.4g} s")
    for name, value in (("load", load), ("torque", torque)):
        if not abs(value) / damping <= FASTEST:
            wanted = f"wanted a value that turns the rotor at no more than {FASTEST:g} rad/s"
            got = f"got {value:.4g} N m at a damping of {damping:.4g} N m s"
            raise ValueError(f"{name}: {wanted}, {got}")
    return gaps, steps


def _resting(motor: Stepper, load: float) -> Floats:
    """The rest position of the rotor in each row under a load: (rows,) in rad, the first within
    half a period of 0 and the others after it. For a row that cannot hold the load, it is the
    position where the row pulls most strongly.
    """
    pulls = motor.pulls
    bent = np.arcsin(np.clip(load / (motor.torque * abs(pulls)), -1, 1))
    ring = np.angle(pulls[0]) + 2 * np.pi / len(pulls) * np.arange(len(pulls))
    angles: Floats = (ring - bent) / motor.periods
    return angles
