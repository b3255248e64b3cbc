"""Phase tables: which windings of a stepper motor each pulse switches on and off."""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from ..._arrays import ArrayLike, Ints
from ..._validate import choice, floats, short, whole
from .moves import COUNTED

DRIVES = ("wave", "two-phase", "half-step")
_FEWEST = {"unipolar": 3, "bipolar": 2}
_DOCUMENTS = {"unipolar": 4, "bipolar": 2}  # windings of the motors in tables 1 and 2
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
    """The phase table, with one row per pulse: (rows, columns) of 1, 0 and -1. By default, it is
    the table of the document's motors, with columns as in `COLUMNS[motor]`.

    drive     "wave" (one winding at a time), "two-phase" (two neighbouring windings, with more
              torque) or "half-step" (one winding and two windings alternately, with half the angle
              per pulse and therefore twice the pulses per degree)
    motor     "unipolar" (one column for each winding, 1 where it carries current) or "bipolar" (two
              columns for each winding, 1 at its positive end and -1 at its negative end). The
              document names the columns a1, b1, a2, b2 for both motors but means different wires
              (errata S3-t): with the names of table 1, the first row of table 2 would be two
              opposite half windings, which cancel each other.
    windings  the number of windings. A unipolar motor has 3 to 6 (with two, the second would pull
              as much backwards as forwards); None means 4, the halves of two windings with centre
              taps. A bipolar motor has 2 to 6; None means 2. Source: 003, II.3.1 ("two to six")

    The field turns in equal steps: once in n rows (unipolar) or 2 n rows (bipolar), or in twice as
    many half steps. Source: 003, II.3.2, tables 1 and 2 (table 2 shows only the plus signs). Its
    appendices 3 and 4, for the two-phase drive of the unipolar motor and the half step, are not in
    the text: we derive these rows from the order of table 1.
    """
    choice(drive, "drive", DRIVES)
    n = read_windings(motor, windings)
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
    """The currents in the windings before the first pulse and after each pulse: table (rows,
    columns), signs (pulses,) -> (pulses + 1, columns).

    The first result is row `row` of the table, modulo the number of rows. A positive pulse moves to
    the next row and a negative one to the previous row, so the order of the rows gives the
    direction. Source: 003, II.3.1. Raises ValueError if a sign is not +1 or -1.
    """
    rows, signs = floats(table, "table"), floats(signs, "signs")
    if rows.ndim != 2 or not len(rows):
        raise ValueError(f"table: wanted rows as `phases` returns them, got shape {rows.shape}")
    if signs.ndim != 1 or (abs(signs) != 1).any():
        raise ValueError(f"signs: wanted an array (pulses,) of +1 and -1, got {short(signs)}")
    steps = np.concatenate([[0], np.cumsum(signs)]).astype(np.int64)
    return np.asarray(table)[(whole(row, "row", -COUNTED, COUNTED) + steps) % len(rows)]


def read_windings(motor: str, windings: int | None) -> int:
    """Return the number of windings of a motor, by default that of the document's motor."""
    fewest = _FEWEST[choice(motor, "motor", tuple(COLUMNS))]
    return whole(_DOCUMENTS[motor] if windings is None else windings, "windings", fewest, 6)
