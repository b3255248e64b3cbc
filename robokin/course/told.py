"""Read numbers from answers, and format numbers for sentences."""

from typing import Any

import numpy as np

from .._arrays import Floats

LARGE = 1e7  # larger numbers are written with a power of ten
MOST = 12  # maximum number of digits after the decimal point
RAISED = str.maketrans("-0123456789", "\N{SUPERSCRIPT MINUS}⁰¹²³⁴⁵⁶⁷⁸⁹")


def floats(value: Any) -> Floats:
    """Return a number, or an array or lists of numbers, as an array. Raises TypeError for text such
    as "0.3", for True and False, for complex numbers that are not real, and for anything else that
    is not a number. Raises ValueError if rows have different lengths.
    """
    made = np.asarray(value)
    if made.dtype == object and any(
        x is None or isinstance(x, (str, bytes, bool)) for x in made.flat
    ):
        raise TypeError("wanted numbers, got text")
    if made.dtype.kind == "c" and not (abs(made.imag) > 1e-12).any():
        made = made.real
    if made.dtype.kind not in "fiuO":
        raise TypeError(f"wanted numbers, got {made.dtype.name}")
    return made.astype(float)


def one_number(value: Any) -> float:
    """Return a single number, even from an array with one element. Raises TypeError or ValueError
    if it is not a single number.
    """
    made = floats(value)
    if made.size != 1:
        raise ValueError(f"wanted one number, got {made.size}")
    return float(made.reshape(()))


def apart(a: Any, b: Any, digits: int = 1) -> tuple[str, str]:
    """Write two numbers, or two rows of numbers, with as many decimals as are needed to tell them
    apart, but at least `digits`. Equal numbers have `digits` decimals.
    """
    rows = [np.atleast_1d(np.asarray(x, dtype=float)) for x in (a, b)]
    for n in [*range(digits, MOST + 1), digits]:
        one, two = (", ".join(_in_digits(x, n) for x in row) for row in rows)
        if one != two:
            break
    return one, two


def _in_digits(x: float, digits: int) -> str:
    if np.isfinite(x) and abs(x) >= LARGE:
        mantissa, power = f"{x:.1e}".split("e")
        return f"{mantissa} · 10{str(int(power)).translate(RAISED)}"
    return f"{round(x, digits) + 0.0:.{digits}f}" if np.isfinite(x) else str(x)
