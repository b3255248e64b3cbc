"""The motor explorer: a stepper motor on a page, seen along its shaft, whose rotor the reader can
turn without a kernel.

The page computes with `js/rotor.js`, which implements `jobs.steppers.Stepper`. The phase tables,
the positions of the poles and all text come from this module.
"""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Literal, TypeAlias, TypedDict

import numpy as np

from .._validate import instance, number
from ..jobs.steppers import FINE, LIMIT, NEARLY, ROTORS, SETTLED, SLOWEST, Stepper, phases
from . import plots
from .checks import yes
from .explorer import Explorer
from .explorer_page import Control
from .palette import FAINT, INK, JOINT_STYLES, PANEL_GRID, REMARK, SOFT

PULSES = 48  # number of pulses in a run
DRIVES = {"wave": "wave", "two-phase": "two-phase", "half-step": "half step"}
KINDS = {
    ("active", "unipolar"): "magnet (active), unipolar",
    ("active", "bipolar"): "magnet (active), bipolar",
    ("passive", "unipolar"): "soft iron (passive), unipolar",
}
ON, OTHER, NORTH = (JOINT_STYLES[j]["color"] for j in (4, 5, 1))  # current > 0, current < 0, N pole
PLUS, MINUS = "+", "\N{MINUS SIGN}"
WORDS = {
    "motor": "rotor, feed",
    "windings": "windings",
    "drive": "drive",
    "back": "\N{MINUS SIGN}1 pulse",
    "on": "+1 pulse",
    "run": f"Run {PULSES} pulses",
    "stop": "Stop",
    "begin": "Begin again",
    "backwards": "backwards",
    "copy": "Copy as Python",
    "copied": "Copied",
    "row": "pulse",
    "takeRotor": "rotor",
    "rotorAt": "rotor {angle}°",
    "fieldAt": "field {angle}°",
    "table": "Phase table: the windings that are on at each pulse.",
    "curves": "Steps over time: those sent, and those that the rotor makes. The text next to the "
    "curves says how the run ends.",
    "curveTitle": "Steps sent and steps made",
    "curveTime": "time, ms",
    "sent": "sent",
    "made": "rotor",
    "gap": "{lost} lost",
    "allMade": "{pulses} pulses in {last}\u00a0ms, {how}: no steps lost.",
    "someLost": "{pulses} pulses in {last}\u00a0ms, {how}: {lost} of {pulses} steps lost.",
    "runsBack": "{pulses} pulses in {last}\u00a0ms, {how}: {lost} steps lost. The load slips back.",
    "tooMany": "{pulses} pulses in {last}\u00a0ms, {how}: {lost} steps too many.",
    "plain": "{end} per second from the first to the last",
    "flat": "{end} per second from the first to the last (no ramp: it would begin at {start})",
    "ramped": "from {start} up to {top} per second and down again",
    "slow": "The run is shown {slow} times slower than real time.",
    "inStep": "Pulses sent: {sent}. The rotor has lost no steps.",
    "behind": "Pulses sent: {sent}. Steps behind: {lost}.",
    "ahead": "Pulses sent: {sent}. Steps ahead: {lost}.",
    "held": "You are holding the rotor. Let it go.",
    "tooMuch": "This row does not hold the load.",
    "step": "step",
    "holding": "holding torque",
    "starting": "starting torque",
    "startFrequency": "maximum start frequency",
    "commutation": "maximum commutation frequency",
    "degrees": "{value}°",
    "torques": "{value}\u00a0mN\u00a0m",
    "perSecond": "{value}\u00a0pulses/s",
    "none": "none: not even {value}\u00a0pulses/s",
    "orMore": "{value}\u00a0pulses/s or more",
}
MEANT = (
    "Take hold of the ring on the rotor, turn it away, and let it go. Click a row of the table to "
    "switch its windings on."
)
MEANT_LOAD = " The load is a weight on a drum: it always pulls backwards."
MEANT_ALONE = (
    " The values beside the table: a pulse turns the rotor by one step. From rest, the motor "
    "follows pulses up to the maximum start frequency without losing a step."
)
Quantity: TypeAlias = Literal["end", "load", "inertia", "start", "ramp"]
CONTROLS: Sequence[tuple[Quantity, float, str, str, float, float, float, int]] = (
    # key, size of the unit in SI units, name, unit, low, high, step, decimals
    ("end", 1.0, "frequency", "/s", SLOWEST, LIMIT, 5, 0),
    ("load", 1e-3, "load torque", "mN m", 0, 40, 0.5, 1),
    ("inertia", 1e-7, "load inertia", "g cm²", 0, 50, 1, 0),
    ("start", 1.0, "ramp from", "/s", SLOWEST, 200, 5, 0),
    ("ramp", 1e-3, "ramp time", "ms", 0, 500, 10, 0),
)
FREQUENCY = 160.0  # pulses per second on opening


class PagePole(TypedDict):
    """A pole of the stator: its position in rad, its winding, the direction of the winding (+1 or
    -1), and its label.
    """

    at: float
    winding: int
    sign: int
    name: str


class PageMotor(TypedDict):
    """A motor with a given rotor, feed and number of windings. It contains the arguments of
    rotor.js (`turn`, `periods`, `sharp`), the poles, the number of teeth of a passive rotor (0 for
    a magnet), the revolutions of the field in the picture per electrical revolution (`space`), the
    headings of the table and, for each drive, the currents and the table as the document prints it.
    """

    windings: int
    turn: float
    periods: int
    sharp: int
    poles: list[PagePole]
    teeth: int
    space: float
    heads: list[str]
    currents: dict[str, list[list[int]]]
    printed: dict[str, list[list[str]]]


class MotorKind(TypedDict):
    """A rotor and a feed: their name on the page, and the motors that have them, by number of
    windings.
    """

    rotor: str
    motor: str
    name: str
    motors: list[PageMotor]


class MotorDrive(TypedDict):
    """A drive: its key in `PageMotor`, and its name."""

    key: str
    name: str


class MotorNumbers(TypedDict):
    """The parameters of a `Stepper` that all motors of a page share."""

    torque: float
    inertia: float
    damping: float
    rise: float


class MotorRules(TypedDict):
    """The constants of jobs/steppers/rotor.py for the simulation and its result."""

    fine: list[float]
    settled: float
    slowest: float
    limit: int
    nearly: float


class MotorControl(Control):
    """A slider: the key in `MotorValues` that it sets, and the size of its unit in SI units."""

    key: Quantity
    size: float


class MotorValues(TypedDict):
    """The current choice: the indices of a kind, of a motor of this kind and of a drive; and the
    frequencies, the load and the ramp time in the units of their sliders.
    """

    kind: int
    motor: int
    drive: int
    end: float
    load: float
    inertia: float
    start: float
    ramp: float


class PageMotors(TypedDict):
    """The data of the motor explorer. `pulses` is the number of pulses in a run, `opening` is the
    initial choice, `words` contains all its sentences, `code` the corresponding Python lines, with
    blanks to fill, and `meant` the explanation below the view. If the motor is `alone`, the view
    has neither menus for other motors nor sliders for load and ramp.
    """

    kind: str
    title: str
    summary: str
    alt: str
    meant: str
    words: dict[str, str]
    pulses: int
    alone: bool
    rules: MotorRules
    own: MotorNumbers
    kinds: list[MotorKind]
    drives: list[MotorDrive]
    opening: MotorValues
    controls: list[MotorControl]
    code: str


def motor_explorer(
    motor: Stepper | None = None, *, alone: bool = False, frequency: float = FREQUENCY
) -> Explorer:
    """Show a stepper motor along its shaft: the windings, coloured by their currents, the field,
    and a rotor that the reader can turn. Next to it is the phase table, in which the current row is
    marked. Pulses are sent one by one or as a run at a frequency, with a load and a ramp; lost
    steps are counted and drawn over time. Menus choose rotor, feed, windings and drive.

    The explorer opens with `motor`, by default the motor of the document's table 1, and with a run
    at `frequency`, in pulses per second. All motors in it have the torque, inertia, damping and
    `rise` of `motor`. With `alone`, only the drive, the frequency and the direction can be chosen:
    there is no other rotor, feed or number of windings, no load and no ramp. Of the motor's
    properties, the view then shows only the step and the maximum start frequency, and the
    explanation below it says what they mean. Raises TypeError if `motor` is not a Stepper, and
    ValueError if its runs take too long to compute or the frequency is not between `SLOWEST` and
    `LIMIT`.
    """
    opened = Stepper() if motor is None else instance(motor, Stepper, "motor")
    kind = opened.rotor, opened.motor
    pace = number(frequency, "frequency")
    if not SLOWEST <= pace <= LIMIT:
        wanted = f"wanted a number of pulses per second from {SLOWEST:g} to {LIMIT:g}"
        raise ValueError(f"frequency: {wanted}, got {pace:g}")
    lost = opened.run(np.arange(1, PULSES + 1) / pace, np.ones(PULSES)).lost
    summary = (
        f"A stepper motor, {KINDS[kind]}, {opened.windings} windings, "
        f"{DRIVES[opened.drive]} drive, {opened.step * 180 / np.pi:.3g}° per step. "
        f"{PULSES} pulses at {pace:g} per second: "
        + (f"{lost} steps lost." if lost else "no steps lost.")
    )
    page = _page(opened, summary, pace)
    if yes(alone, "alone"):
        chosen = page["opening"]
        only = page["kinds"][chosen["kind"]]
        only["motors"] = [only["motors"][chosen["motor"]]]
        page["kinds"], page["meant"], page["alone"] = [only], MEANT + MEANT_ALONE, True
        chosen["kind"] = chosen["motor"] = 0
    return Explorer(page, _picture(opened, summary))


# --- Page data ------------------------------------------------------------------------------------


def _page(opened: Stepper, summary: str, pace: float) -> PageMotors:
    """Return the page data of the explorer that opens with this motor and this frequency."""
    own: MotorNumbers = {
        "torque": opened.torque,
        "inertia": opened.inertia,
        "damping": opened.damping,
        "rise": opened.rise,
    }
    changed = [
        f"{name}={value!r}" for name, value in own.items() if value != asdict(Stepper())[name]
    ]
    motors = {
        (rotor, feed): [_motor(rotor, feed, n) for n in range(2 if feed == "bipolar" else 3, 7)]
        for rotor, feed in KINDS
    }
    kind = opened.rotor, opened.motor
    counts = [one["windings"] for one in motors[kind]]
    return {
        "kind": "motor",
        "title": "A stepper motor, seen along its shaft",
        "summary": summary,
        "alt": summary,
        "meant": MEANT + MEANT_LOAD,
        "words": WORDS,
        "pulses": PULSES,
        "alone": False,
        "rules": {
            "fine": list(FINE),
            "settled": SETTLED,
            "slowest": SLOWEST,
            "limit": int(LIMIT),
            "nearly": NEARLY,
        },
        "own": own,
        "kinds": [
            {"rotor": rotor, "motor": feed, "name": name, "motors": motors[rotor, feed]}
            for (rotor, feed), name in KINDS.items()
        ],
        "drives": [{"key": key, "name": name} for key, name in DRIVES.items()],
        "opening": {
            "kind": [*KINDS].index(kind),
            "motor": counts.index(opened.windings),
            "drive": [*DRIVES].index(opened.drive),
            "end": pace,
            "load": 0,
            "inertia": 0,
            "start": 40,
            "ramp": 0,
        },
        "controls": _controls(),
        "code": "import numpy as np\nfrom robokin.jobs.steppers import Stepper, ramp\n\n"
        f'motor = Stepper("{{rotor}}", "{{motor}}", {{windings}}, "{{drive}}"'
        f"{''.join(f', {text}' for text in changed)})\n"
        "times = ramp({pulses}, {start}, {end}, {ramp})\n"
        "run = motor.run(times, np.full({pulses}, {sign}), load={load}, load_inertia={inertia})\n"
        "run.lost",
    }


def _controls() -> list[MotorControl]:
    return [
        {
            "key": key,
            "size": size,
            "name": name,
            "unit": unit,
            "low": low,
            "high": high,
            "step": step,
            "decimals": decimals,
        }
        for key, size, name, unit, low, high, step, decimals in CONTROLS
    ]


def _motor(rotor: str, feed: str, n: int) -> PageMotor:
    first = Stepper(rotor, feed, n)
    tables = {drive: phases(drive, feed, n) for drive in DRIVES}
    return {
        "windings": n,
        "turn": (np.pi if feed == "bipolar" else 2 * np.pi) / n,
        "periods": first.periods,
        "sharp": 1 + ROTORS.index(rotor),
        "poles": _poles(rotor, feed, n),
        "teeth": 0 if rotor == "active" else first.periods,
        "space": 1.0 if rotor == "active" else 0.5,
        "heads": _heads(rotor, feed, n),
        "currents": {d: Stepper(rotor, feed, n, d).currents.tolist() for d in DRIVES},
        "printed": {
            d: [[PLUS if x > 0 else "" for x in row] for row in t.tolist()]
            for d, t in tables.items()
        },
    }


def _heads(rotor: str, feed: str, n: int) -> list[str]:
    """Return the headings of the table's columns: those of the document if it gives them, otherwise
    letters.
    """
    if feed == "bipolar":
        return [f"{end}{k + 1}" for k in range(n) for end in "ab"]
    return ["a1", "b1", "a2", "b2"] if (rotor, n) == ("active", 4) else list("abcdef"[:n])


def _poles(rotor: str, feed: str, n: int) -> list[PagePole]:
    """Return the poles of the stator. If the rotor is a magnet and the motor is unipolar, there is
    one pole for each winding; otherwise opposite poles form a pair. In a bipolar motor, the two
    poles of a pair are wound in opposite directions; for a passive rotor, the sign does not matter.
    """
    pairs = rotor == "passive" or feed == "bipolar"
    count = 2 * n if pairs else n
    names = [str(k + 1) for k in range(n)] if feed == "bipolar" else _heads(rotor, feed, n)
    return [
        {
            "at": 2 * np.pi * k / count,
            "winding": k % n,
            "sign": -1 if feed == "bipolar" and k >= n else 1,
            "name": names[k % n],
        }
        for k in range(count)
    ]


# --- The still picture ----------------------------------------------------------------------------


def _picture(motor: Stepper, alt: str) -> plots.Figure:
    """Draw the motor with the currents of the first row of its table, and the table."""
    page = _motor(motor.rotor, motor.motor, motor.windings)
    rows, currents = page["printed"][motor.drive], page["currents"][motor.drive][0]
    fig = plots.figure(alt, width=8.0, height=4.2)
    ax, beside = fig.subplots(1, 2, width_ratios=(1, 1.1))
    ring = np.linspace(0, 2 * np.pi, 361)
    for radius in (1.0, 0.9):
        ax.plot(radius * np.cos(ring), radius * np.sin(ring), color=SOFT, lw=1.2)
    half = min(0.28, 0.9 * np.pi / len(page["poles"]) * 0.6)
    for pole in page["poles"]:
        now = currents[pole["winding"]] * pole["sign"]
        color = {0: PANEL_GRID, 1: ON, -1: OTHER}[now]
        at = pole["at"]
        corners = [(0.66, -half), (0.66, half), (0.88, half), (0.88, -half)]
        ax.fill(*np.transpose([r * _way(at + d) for r, d in corners]), fc=color, ec=INK, lw=1)
        mark = {0: "", 1: PLUS, -1: MINUS}[now]
        ax.text(*(0.77 * _way(at)), f"{pole['name']}{mark}", ha="center", va="center", fontsize=9)
    theta = float(np.angle(motor.pulls[0])) / motor.periods
    if motor.rotor == "active":
        for turn, color, name in ((0, NORTH, "N"), (np.pi, FAINT, "S")):
            side = theta + turn + np.linspace(-np.pi / 2, np.pi / 2, 91)
            ax.fill(0.56 * np.cos(side), 0.56 * np.sin(side), fc=color, ec=INK, lw=1)
            ax.text(*(0.4 * _way(theta + turn)), name, ha="center", va="center", weight="bold")
    else:
        pitch = 2 * np.pi / page["teeth"]
        turns = theta + pitch * (np.arange(page["teeth"])[:, None] + (-0.25, -0.2, 0.2, 0.25))
        rim = np.tile((0.44, 0.58, 0.58, 0.44), page["teeth"])
        ax.fill(rim * np.cos(turns.ravel()), rim * np.sin(turns.ravel()), fc=FAINT, ec=INK, lw=1)
    ax.set(aspect="equal", xlim=(-1.05, 1.05), ylim=(-1.05, 1.05))
    ax.set_title(f"{KINDS[motor.rotor, motor.motor]}", fontsize=10, color=REMARK)
    cells = [["pulse", *page["heads"]]]
    cells += [[str(k + 1), *row] for k, row in enumerate(rows)]
    height = 1 / (len(cells) + 0.5)
    for k, line in enumerate(cells):
        for j, text in enumerate(line):
            x, y = (j + 0.5) / len(line), 1 - (k + 0.5) * height
            size = min(11.0, 170 / len(cells))
            bold = "bold" if k == 1 else "normal"
            beside.text(x, y, text, ha="center", va="center", fontsize=size, weight=bold)
    beside.set_title(f"phase table, {DRIVES[motor.drive]}", fontsize=10, color=REMARK)
    for one in (ax, beside):
        one.set_axis_off()
    fig.tight_layout()
    return fig


def _way(angle: float) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return np.array([np.cos(angle), np.sin(angle)])
