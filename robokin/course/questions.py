"""Predictions as teachers write them: a question, its answers, and the facts for their texts."""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from .._validate import number
from .markdown import BadFile, one_line, why

LETTERS = "abcdef"


class Option(NamedTuple):
    """An answer to choose, or a number that a student may type.

    text       the answer; for a number to type, the number from the facts: "{tool:.0f}"
    reason     why it is right or wrong
    confusion  the name of the confusion behind a wrong answer; None for the right one
    second     for a wrong answer: a second case that shows the confusion
    name       a short name, which remains valid if the options are reordered
    """

    text: str
    reason: str
    confusion: str | None = None
    second: str = ""
    name: str = ""


@dataclass(frozen=True, kw_only=True)
class Prediction:
    """A question, its answers, and the view that shows the right one.

    Computed `facts` are filled into every text: "{most:.0f} mm".

    question  two or three sentences
    options   three or four answers, one of them right; if a number is to be typed (there is a
              `unit`), the right number and those of the confusions, which are hidden
    facts     a function that returns the numbers for all texts
    right     a function that computes the index of the right option, counting from 0, from the
              facts
    view      a function that returns the view shown after the choice: an `Output` or a `Figure` of
              robokin.show, or text
    unit      the unit of a number to type; `within`: the relative tolerance
    optional  whether it is in the optional part of the lab
    """

    question: str
    options: Sequence[Option]
    facts: Callable[[], Mapping[str, Any]]
    right: Callable[[Mapping[str, Any]], int]
    view: Callable[[], Any] = field(default=lambda: "")
    unit: str | None = None
    within: float = 0.1
    optional: bool = False


def filled(prediction: Prediction) -> tuple[str, list[Option], int]:
    """The question, the options and the index of the right one, with all facts filled in."""
    facts = prediction.facts()
    options = [
        Option(
            each.text.format(**facts),
            each.reason.format(**facts),
            each.confusion,
            each.second.format(**facts),
            each.name,
        )
        for each in prediction.options
    ]
    return prediction.question.format(**facts), options, prediction.right(facts)


def chosen_option(
    prediction: Prediction, options: Sequence[Option], right: int, choice: Any
) -> int:
    """Return the index of the chosen option, or -1 for a number that matches none. A choice is a
    number, "b", or "b: joint 3"; a name takes precedence over the letter, since the options may
    have been reordered. Raises ValueError if the choice is not the letter of an option (or not a
    number, if the prediction asks for one).
    """
    if prediction.unit is None:
        letters = list(LETTERS[: len(options)])
        letter, _, name = choice.partition(": ") if isinstance(choice, str) else ("", "", "")
        names = [each.name for each in options]
        if name and name in names:
            return names.index(name)
        if letter not in letters:
            raise ValueError(f"choice: wanted one of {', '.join(letters)}, got {choice!r}")
        return letters.index(letter)
    typed = number(choice, "choice")
    values = [float(option.text) for option in options]
    near = [k for k, value in enumerate(values) if _near(typed, value, prediction.within)]
    nearest = min(near, key=lambda k: abs(typed - values[k]), default=-1)
    return right if right in near else nearest


def _near(x: float, value: float, within: float) -> bool:
    return abs(x - value) <= within * abs(value) + 1e-9


# --- Predictions in Markdown ----------------------------------------------------------------------

HEAD = re.compile(r"(?:\w+\.)?(p\d+)(?:, a number in (.+?), within ([\d.]+) %)?(, optional)?")
ANSWER = re.compile(r"`([^`]+)` \*\*(.+?)\*\* (.*?)(?: \*([^*]+):\*(?: (.*))?)?")


def sections(text: str) -> Iterator[tuple[int, str, str]]:
    """The sections of a text: the line of each heading, the heading, and its text."""
    for found in re.finditer(r"^## (.+)\n((?s:.*?))(?=^## |\Z)", text, re.M):
        yield text.count("\n", 0, found.start()) + 1, found[1].strip(), found[2]


def prediction(
    file: str, line: int, heading: str, text: str, code: Mapping[str, Any]
) -> tuple[str, Prediction]:
    """Parse a prediction from its number, its section and the names of its Python file: for p1,
    `p1()` returns its facts and, under "right", the name of the right answer. A prediction that has
    moved here from another lab has its full id in the heading. Raises BadFile if something is
    missing.

    ## p5, a number in mm/s, within 2 %

    The question.

    - `half` **An answer.** Why it is right.
    - `twice` **Another.** Why it is not. *The confusion:* a second case.
    """
    head = HEAD.fullmatch(heading)
    if not head:
        told = f"wanted '## p1' or '## p1, a number in UNIT, within 2 %', got {heading!r}"
        raise BadFile(file, line, told)
    number, unit, within, optional = head.groups()
    if number not in code:
        raise BadFile(file, line, f"no facts: wanted a function {number}() in its Python file")
    question, *answers = re.split(r"^- ", text, flags=re.M)
    options = [_option(file, line, one_line(answer)) for answer in answers]
    names = [each.name for each in options]
    if len(set(names)) < max(2, len(names)) or sum(o.confusion is None for o in options) != 1:
        told = "wanted answers with different names, all but one with a confusion"
        raise BadFile(file, line, f"{number}: {told}")

    def facts() -> Mapping[str, Any]:
        found: Mapping[str, Any] = code[number]()
        try:
            one_line(text).format(**found)  # a line may end inside the name of a fact
        except Exception as error:
            raise BadFile(file, line, f"{number} cannot be filled: {why(error)}") from None
        if found.get("right") not in names:
            told = f"{number}(): wanted 'right' to be one of {', '.join(names)}"
            raise BadFile(file, line, f"{told}, got {found.get('right')!r}")
        return found

    return number, Prediction(
        question=one_line(question),
        options=options,
        facts=facts,
        right=lambda facts: names.index(facts["right"]),
        unit=unit,
        within=float(within) / 100 if within else 0.1,
        optional=bool(optional),
    )


def _option(file: str, line: int, text: str) -> Option:
    found = ANSWER.fullmatch(text)
    if not found:
        told = f"wanted '- `name` **An answer.** Why. *The confusion:* a case', got {text[:60]!r}"
        raise BadFile(file, line, told)
    name, answer, reason, confusion, second = found.groups()
    return Option(answer, reason, confusion, second or "", name)
