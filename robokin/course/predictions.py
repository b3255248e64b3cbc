"""Predictions: questions that a reader answers before the view that shows the answer opens. They
work in the page, without a kernel.
"""

import functools
import hashlib
import html
import json
import os
import re
from typing import TYPE_CHECKING, Any

from .book import find
from .questions import LETTERS, Option, Prediction, chosen_option, filled

if TYPE_CHECKING:
    from ..show.page import PageAnswer, PageQuestion

NUMBER = re.compile("[-+.eE0-9]{1,30}")  # a number and nothing else
ASLEEP = (
    "To answer it: run all cells (Run > Run All Cells), or trust the notebook (Ctrl+Shift+C, then "
    "Trust Notebook)."
)

UNGUESSED = "Show the answer without a guess"


@functools.cache
def worked_out(name: str) -> tuple[str, list[Option], int]:
    """Return `filled` for the prediction with this id; its facts are computed only once."""
    return filled(find(name, "predictions"))


def chosen(name: str, choice: str) -> str:
    """A choice as text: the letter and the text of its option, or a number with its unit. An
    unknown choice is returned unchanged.
    """
    unit = find(name, "predictions").unit
    if unit is not None:
        return with_unit(choice, unit) if NUMBER.fullmatch(choice) else choice
    _, options, right = worked_out(name)
    try:
        at = chosen_option(find(name, "predictions"), options, right, choice)
    except ValueError:
        return choice
    return f"{LETTERS[at]}) {options[at].text}"


def predict(name: str, choice: str | float | None = None) -> "Asked":
    """Show the question of a prediction, such as "irb140_motion.p2". The view that answers it opens
    in the page after a choice, or on request without one; this does not need a kernel.

    choice  the letter of an answer, or a number if the question asks for one. If it is given, the
            output shows the question, the choice and the reason, and the report contains the
            choice.

    Raises ValueError if there is no such prediction or the choice is invalid.
    """
    return Asked(name, find(name, "predictions"), choice)


class Asked:
    """A question on a page. A notebook displays it; `save` writes it as a page of its own."""

    def __init__(self, name: str, prediction: Prediction, choice: str | float | None) -> None:
        self.name, self.choice = name, choice
        self.question, self.options, self.right = filled(prediction)
        self.unit, self.view = prediction.unit, prediction.view
        self.at = None
        if choice is not None:
            self.at = chosen_option(prediction, self.options, self.right, choice)
        self.data: PageQuestion = {
            "name": name,
            "title": f"Predict: {name}",
            "question": self.question,
            "options": [self._data(option) for option in self.options],
            "right": self.right,
            "unit": self.unit,
            "within": prediction.within,
            "choice": None if choice is None else str(choice),
        }
        text = json.dumps(self.data, ensure_ascii=False)
        self.id = hashlib.sha256(text.encode()).hexdigest()[:12]

    def _data(self, option: Option) -> "PageAnswer":
        data: PageAnswer = {
            "name": option.name,
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
        """The HTML of the question: its text, and the script that replaces it."""
        return self._in_page()

    def _in_page(self, nonce: str = "") -> str:
        """The HTML for a page whose policy permits only scripts with this nonce."""
        from ..show.markup import inert, output

        words = "".join(map(paragraph, repr(self).split("\n")[1:]))
        view = f'<div class="robokin-view">{shown(self.view(), nonce)}</div>'
        if self.at is None:
            view = (
                f'<details class="robokin-unguessed"><summary>{UNGUESSED}</summary>'
                f"{paragraph(self._right())}{view}</details>"
            )
        still = f"{words}<p>{ASLEEP}</p>{view}"
        return output("prediction.ask", self.id, inert(self.data), still, nonce)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write one self-contained page, atomically. Raises ValueError if `path` does not end in
        .html or is an existing file that is not ours.
        """
        from ..show.saving import save

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
            lines.append(f"Your choice: {str(self.choice).partition(':')[0]}.")
            if self.at == self.right:
                lines.append(f"Right. {right.reason}")
            else:
                mine = self.options[self.at]
                lines.append(f"No: {mine.confusion}. {mine.reason}" if self.at >= 0 else "No.")
                lines.append(self._right())
        return "\n".join(lines)

    def _right(self) -> str:
        """The right answer and the reason for it."""
        right = self.options[self.right]
        letter = "" if self.unit else f"{LETTERS[self.right]}) "
        text = right.text if self.unit is None else with_unit(right.text, self.unit)
        end = "" if text.endswith((".", "!", "?")) else "."
        return f"The right answer is {letter}{text}{end} {right.reason}"


def with_unit(text: str, unit: str) -> str:
    """Format a number with its unit: "−290°", "200 mm"."""
    space = "" if unit.startswith("°") else " "
    return text.replace("-", "\N{MINUS SIGN}") + space + unit


def paragraph(line: str) -> str:
    """Convert a line to HTML; text between backticks is code."""
    return "<p>" + re.sub("`([^`]+)`", r"<code>\1</code>", html.escape(line)) + "</p>"


def shown(view: Any, nonce: str = "") -> str:
    """The HTML of a view."""
    if isinstance(view, str):
        return "".join(paragraph(line) for line in view.split("\n") if line)
    if nonce and hasattr(view, "_in_page"):
        return str(view._in_page(nonce))
    data = view._repr_mimebundle_()
    return str(data["text/html"]) if "text/html" in data else paragraph(data["text/plain"])
