"""Numbers: as an answer gives them, and as a sentence tells them."""

from typing import Any

import numpy as np

from .._arrays import Floats

LARGE = 1e7  # told with a power of ten from here on
MOST = 12  # digits after the point
RAISED = str.maketrans("-0123456789", "\N{SUPERSCRIPT MINUS}⁰¹²³⁴⁵⁶⁷⁸⁹")


def floats(value: Any) -> Floats:
    """A number, or an array or lists of numbers, as an array. Raises TypeError for text, as "0.3",
    True and False, a complex number that is not real, and what else is no number; ValueError for
    rows of unlike length.
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
    """A number, also as an array that holds only one. TypeError or ValueError: it is none."""
    made = floats(value)
    if made.size != 1:
        raise ValueError(f"wanted one number, got {made.size}")
    return float(made.reshape(()))


def apart(a: Any, b: Any, digits: int = 1) -> tuple[str, str]:
    """Two numbers, or two rows of numbers, in as many digits after the point as they need to differ
    in what is printed; `digits` at least, and no more where the two are the same.
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
