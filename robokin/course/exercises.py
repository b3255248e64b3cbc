"""The common parts of all exercises: the verdict on an answer, and values as text."""

import contextlib
import html
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, mm
from .answers import TROUBLE
from .markdown import Text

ACCEPTS = "accepts: "  # begins the mistake of a test that accepts a wrong program
EMPTY = "There is no {} yet: write it into its cell, run that cell, then check again."


@dataclass(frozen=True)
class Verdict:
    """The result of a check. A notebook displays it at the end of a cell.

    answered  whether there was an answer to judge
    holds     whether all conditions hold
    mistake   the name of the mistake, or two joined by " or "; None if there is none, or it is not
              recognised
    says      sentences about the answer
    case      the smallest input that shows the fault, with your result and what should hold
    points    from 0 to 1: the fraction of the conditions that hold
    """

    exercise: str
    answered: bool = True
    holds: bool = False
    mistake: str | None = None
    says: tuple[str, ...] = ()
    case: str | None = None
    points: float = 0.0

    def __bool__(self) -> bool:
        return self.holds

    def __repr__(self) -> str:
        word = "holds" if self.holds else "does not hold" if self.answered else "not judged"
        if not self.answered and self.says and self.says[0].endswith(EMPTY.partition("{}")[2]):
            word = "not answered yet"
        lines = [f"{self.exercise}: {word}."]
        if self.case:
            lines += self.case.split("\n")
        shown = self.mistake in TROUBLE or (self.mistake or "").startswith(ACCEPTS)
        if self.mistake and not shown:  # the case shows the others
            lines.append(f"The mistake: {self.mistake}.")
        return "\n".join([*lines, *self.says])

    def _repr_html_(self) -> str:
        from ..show.palette import ALARM, JOINT_STYLES, SOFT

        color = JOINT_STYLES[2]["color"] if self.holds else ALARM if self.answered else SOFT
        first, *rest = html.escape(repr(self)).split("\n")
        lines = (
            f'<div style="padding-left:{2 if line.startswith("  ") else 0}em">{line.strip()}</div>'
            for line in rest
        )
        return (
            f'<div role="status" style="border-left:5px solid {color};padding:4px 12px;'
            f'line-height:1.5"><b>{first}</b>{"".join(lines)}</div>'
        )


class Exercise(ABC):
    """An exercise defined in Markdown. `objective` is the number of an objective of the lab,
    counting from 1; `hints` range from a nudge to almost the whole solution.
    """

    def __init__(self, text: Text) -> None:
        self.text, self.number, self.title = text, text.number, text.title
        self.task, self.objective, self.hints = text.task, text.objective, text.hints
        _, self.solution = text.code("Solution")  # a correct program, as shown to students

    @abstractmethod
    def judge(self, name: str, answer: Any, who: Any) -> Verdict:
        """Return the verdict on an answer of the student `who`."""


def unanswered(name: str, what: str = "answer") -> Verdict:
    """Return the verdict on an answer that is missing, or that lacks a part, `what`."""
    return Verdict(name, answered=False, says=(EMPTY.format(what),))


# --- Values as text -------------------------------------------------------------------------------


def has_nan(value: Any) -> bool:
    """Return whether numbers or a pose contain a NaN."""
    with contextlib.suppress(Exception):
        numbers = value.as_matrix() if isinstance(value, (Transform, Quaternion)) else value
        return bool(np.isnan(np.asarray(numbers, dtype=float)).any())
    return False


def numbers(value: Any) -> Any:
    """Return a result as an array of numbers, or None if it is not numeric."""
    with contextlib.suppress(Exception):
        numbers = value.as_matrix() if isinstance(value, (Transform, Quaternion)) else value
        made = np.asarray(numbers)
        return made.astype(float) if made.dtype.kind in "fiu" else None
    return None


def in_words(value: Any) -> str:
    """Describe a value in one short line."""
    if isinstance(value, Transform) and not value.shape:
        angle, axis = value.rotation.as_angle_axis()
        place = ", ".join(f"{x / mm:.1f}" for x in value.translation + 0.0)
        about = ", ".join(f"{x:.2f}" for x in axis + 0.0)
        return f"a pose at ({place}) mm, turned by {angle / deg:.1f}° about ({about})"
    if isinstance(value, (Transform, Quaternion)) and value.shape:
        return f"a batch of shape {value.shape} of {type(value).__name__}"
    if isinstance(value, (float, np.floating)):
        return f"{value:.6g}"
    if isinstance(value, np.ndarray) and value.dtype.kind in "fiub":
        if not value.ndim:
            return in_words(value.item())
        if value.size > 12:
            return f"an array of shape {value.shape}: [{_row(value.ravel()[:4])}, ...]"
        if value.ndim == 2:
            return "[" + ", ".join(f"[{_row(row)}]" for row in value) + "]"
        return f"[{_row(value)}]" if value.ndim == 1 else f"an array of shape {value.shape}"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{k!r}: {in_words(v)}" for k, v in value.items()) + "}"
    if callable(value):
        return f"the function {getattr(value, '__name__', '?')}"
    with contextlib.suppress(Exception):
        text = " ".join(repr(value).split())
        return text if len(text) < 120 else text[:117] + "..."
    return f"an object of {type(value).__name__}"


def _row(values: Any) -> str:
    if values.dtype == bool:
        return ", ".join(map(str, values))
    # without the rounding error of a zero, which differs from machine to machine
    return ", ".join(f"{x:.5g}" for x in np.round(np.asarray(values, float), 12) + 0.0)
