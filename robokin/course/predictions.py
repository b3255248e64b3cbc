"""Predictions: a question that is answered before what answers it is seen, in the page, without a
kernel.
"""

import functools
import hashlib
import html
import json
import os
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

from .._validate import number
from .book import find

if TYPE_CHECKING:
    from ..show.page import PageAnswer, PageQuestion

LETTERS = "abcdef"
NUMBER = re.compile("[-+.eE0-9]{1,30}")  # and nothing else: no words
ASLEEP = (
    "To answer it: run all cells (Run > Run All Cells), or trust the notebook (Ctrl+Shift+C, then "
    "Trust Notebook)."
)


class Option(NamedTuple):
    """An answer to choose, or a number that somebody may type.

    text       what it says; for a number to type, the number as the facts have it: "{tool:.0f}"
    reason     why it is right, or why it is not
    confusion  the name of the confusion behind a wrong one; None: the right one
    second     for a wrong one: a second case that shows it
    """

    text: str
    reason: str
    confusion: str | None = None
    second: str = ""


@dataclass(frozen=True, kw_only=True)
class Prediction:
    """A question, its answers, and the view that answers it.

    Every text is filled with `facts`, which are computed: "{most:.0f} mm".

    question  in two or three sentences
    options   three or four answers, one of them right; for a number to type (`unit` is given): the
              right one and those of the confusions, which are not shown
    facts     () -> the numbers behind all texts
    right     facts -> which option is right, from 0: computed, not typed in
    view      () -> what opens after the choice: an `Output` or a `Figure` of robokin.show, or words
    unit      of a number to type; `within`: how near to a number counts as it, as a share
    optional  whether it stands in the lab's optional part
    """

    question: str
    options: Sequence[Option]
    facts: Callable[[], Mapping[str, Any]]
    right: Callable[[Mapping[str, Any]], int]
    view: Callable[[], Any] = field(default=lambda: "")
    unit: str | None = None
    within: float = 0.1
    optional: bool = False


@functools.cache
def worked_out(name: str) -> tuple[str, list[Option], int]:
    """`filled` for the prediction with an id: its facts are worked out once."""
    return filled(find(name, "PREDICTIONS"))


def chosen(name: str, choice: str) -> str:
    """A choice in words: the letter and what its option says, a number with its unit; what is none
    of the question's stays as it is.
    """
    unit = find(name, "PREDICTIONS").unit
    if unit is not None:
        return with_unit(choice, unit) if NUMBER.fullmatch(choice) else choice
    options = dict(zip(LETTERS, worked_out(name)[1], strict=False))
    return f"{choice}) {options[choice].text}" if choice in options else choice


def filled(prediction: Prediction) -> tuple[str, list[Option], int]:
    """Question, options and the number of the right one, with all facts in their places."""
    facts = prediction.facts()
    options = [
        Option(
            each.text.format(**facts),
            each.reason.format(**facts),
            each.confusion,
            each.second.format(**facts),
        )
        for each in prediction.options
    ]
    return prediction.question.format(**facts), options, prediction.right(facts)


def judged(prediction: Prediction, options: Sequence[Option], right: int, choice: Any) -> int:
    """Which option a choice is, -1 for a number that is none of them. ValueError: neither a letter
    of an option nor a number, as the prediction wants it.
    """
    if prediction.unit is None:
        letters = LETTERS[: len(options)]
        if not (isinstance(choice, str) and len(choice) == 1 and choice in letters):
            raise ValueError(f"choice: wanted one of {', '.join(letters)}, got {choice!r}")
        return letters.index(choice)
    given = number(choice, "choice")
    order = [right, *range(len(options))]
    near = (k for k in order if _near(given, float(options[k].text), prediction.within))
    return next(near, -1)


def _near(x: float, value: float, within: float) -> bool:
    return abs(x - value) <= within * abs(value) + 1e-9


def predict(name: str, choice: str | float | None = None) -> "Asked":
    """A question to answer before you look: "irb140_motion.p2". It shows itself in a cell, and what
    answers it opens in the page after the choice; no kernel is needed for that.

    choice  the letter of an answer, or a number where one is asked for. With it the output shows
            question, choice and reason: so it stays for the report.

    ValueError: no such prediction, a choice that is none.
    """
    return Asked(name, find(name, "PREDICTIONS"), choice)


class Asked:
    """A question on a page. Shows itself in a notebook; `save` writes it as a page."""

    def __init__(self, name: str, prediction: Prediction, choice: str | float | None) -> None:
        self.name, self.choice = name, choice
        self.question, self.options, self.right = filled(prediction)
        self.unit, self.view = prediction.unit, prediction.view
        self.at = None
        if choice is not None:
            self.at = judged(prediction, self.options, self.right, choice)
        self.data: PageQuestion = {
            "name": name,
            "title": f"Predict: {name}",
            "question": self.question,
            "options": [self._data(option) for option in self.options],
            "right": self.right,
            "unit": self.unit,
            "within": prediction.within,
            "choice": None if choice is None else str(choice),
            "view": "",
        }
        text = json.dumps(self.data, ensure_ascii=False)
        self.id = hashlib.sha256(text.encode()).hexdigest()[:12]

    def _data(self, option: Option) -> "PageAnswer":
        data: PageAnswer = {
            "text": option.text,
            "reason": option.reason,
            "confusion": option.confusion,
            "second": option.second,
        }
        if self.unit is not None:
            data["value"] = float(option.text)
        return data

    @property
    def html(self) -> str:
        """The question as a piece of HTML: in words, and the script that replaces them."""
        return self._in_page()

    def _in_page(self, nonce: str = "") -> str:
        """The same for a page whose policy lets only scripts with this nonce run."""
        from ..show.page import inert, output

        data = self.data | {"view": shown(self.view(), nonce)}
        words = "".join(map(paragraph, repr(self).split("\n")[1:]))
        return output("prediction.ask", self.id, inert(data), f"{words}<p>{ASLEEP}</p>", nonce)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write one self-contained page: wholly or not at all. ValueError: not a .html file, or one
        that is there and not ours.
        """
        from ..show.page import save

        save(path, self.data["title"], self.html)

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        from .guesses import listen

        listen()
        return {"text/html": self.html, "text/plain": repr(self)}

    def __repr__(self) -> str:
        lines = [f"{self.name}: predict, then look.", self.question]
        if self.unit is None:
            lines += [f"{x}) {o.text}" for x, o in zip(LETTERS, self.options, strict=False)]
        else:
            lines.append(f"A number, in {self.unit}.")
        if self.at is not None:
            right = self.options[self.right]
            lines.append(f"Your choice: {self.choice}.")
            if self.at == self.right:
                lines.append(f"Right. {right.reason}")
            else:
                mine = self.options[self.at]
                lines.append(
                    f"Not so: {mine.confusion}. {mine.reason}" if self.at >= 0 else "Not so."
                )
                letter = "" if self.unit else f"{LETTERS[self.right]}) "
                text = right.text if self.unit is None else with_unit(right.text, self.unit)
                end = "" if text.endswith((".", "!", "?")) else "."
                lines.append(f"Right is {letter}{text}{end} {right.reason}")
        return "\n".join(lines)


def with_unit(text: str, unit: str) -> str:
    """A number as people write it: "−290°", "200 mm"."""
    space = "" if unit.startswith("°") else " "
    return text.replace("-", "\N{MINUS SIGN}") + space + unit


def paragraph(line: str) -> str:
    """A line as HTML; what stands between back-ticks is code."""
    return "<p>" + re.sub("`([^`]+)`", r"<code>\1</code>", html.escape(line)) + "</p>"


def shown(view: Any, nonce: str = "") -> str:
    """What a view shows in a page, as HTML."""
    if isinstance(view, str):
        return "".join(paragraph(line) for line in view.split("\n") if line)
    if nonce and hasattr(view, "_in_page"):
        return str(view._in_page(nonce))
    return str(view._repr_mimebundle_()["text/html"])
