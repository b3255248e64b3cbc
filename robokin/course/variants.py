"""A student's own numbers: the same on every machine and for every spelling of the name."""

import hashlib
import random
import unicodedata
from typing import Any

from .book import lab as _lab


def normalised(who: Any) -> str:
    """Return a name in a form that does not depend on case, spaces or the way accents are typed.
    Raises ValueError if nothing is left.
    """
    text = unicodedata.normalize("NFKC", str(who)).casefold()
    text = " ".join(unicodedata.normalize("NFKC", text).split())
    if not text:
        raise ValueError("who: wanted a name or a number, got an empty name")
    return text


def dice(lab: str, who: Any) -> random.Random:
    """Return a random generator for a student in a lab. Draw only integers (`randrange`), which are
    the same on every machine and in every version of Python.
    """
    return random.Random(int(hashlib.sha256(f"{lab}\n{normalised(who)}".encode()).hexdigest(), 16))


class Numbers(dict[str, Any]):
    """A student's numbers, as in `numbers["height"]`. A notebook displays them as a table with
    units.

    units  a dict that maps names to (unit, its size in SI units); the values are in SI units
    """

    def __init__(self, values: dict[str, Any], units: dict[str, tuple[str, float]]) -> None:
        super().__init__(values)
        self.units = units

    def __repr__(self) -> str:
        lines = []
        for name, value in self.items():
            unit, size = self.units.get(name, ("", 1.0))
            shown = f"{value / size:g}" if isinstance(value, (int, float)) else str(value)
            lines.append(f"{name:12} {shown} {unit}".rstrip())
        return "\n".join(lines)


def variant(lab: str, who: Any) -> Numbers:
    """Return the numbers of the student `who` (a name or a number) for the design exercise of a
    lab.

    They are the same on every machine; case and spaces make no difference. Raises ValueError if
    there is no such lab, the lab has no such exercise, or the name is empty.
    """
    given = _lab(lab).given
    if given is None:
        raise ValueError(f"lab: {lab} has no numbers that depend on the student")
    made: Numbers = given(who)
    return made


def key(lab: str, names: Any) -> dict[str, Numbers]:
    """Return the numbers of many students, by name, for the teacher."""
    return {str(name): variant(lab, name) for name in names}
