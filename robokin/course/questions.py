"""Predictions as they are written: a question, its answers, and what they are filled with."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from .._validate import number
from .markdown import one_line, wrong

LETTERS = "abcdef"


class Option(NamedTuple):
    """An answer to choose, or a number that somebody may type.

    text       what it says; for a number to type, the number as the facts have it: "{tool:.0f}"
    reason     why it is right, or why it is not
    confusion  the name of the confusion behind a wrong one; None: the right one
    second     for a wrong one: a second case that shows it
    name       a short one, which stays when options change places
    """

    text: str
    reason: str
    confusion: str | None = None
    second: str = ""
    name: str = ""


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


def filled(prediction: Prediction) -> tuple[str, list[Option], int]:
    """Question, options and the number of the right one, with all facts in their places."""
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


# --- As Markdown ----------------------------------------------------------------------------------

HEAD = re.compile(r"(p\d+)(?:, a number in (\S+), within ([\d.]+) %)?(, optional)?")
ANSWER = re.compile(r"`([^`]+)` \*\*(.+?)\*\* (.*?)(?: \*([^*]+):\*(?: (.*))?)?")


def predictions(file: str, text: str, code: Mapping[str, Any]) -> dict[str, Prediction]:
    """The predictions of a lab by their numbers, with the names of their Python file: for p1 `p1()`
    gives its facts, "right" among them, which is an answer's name, and `p1_view()` what opens.
    ValueError: something is missing.

    ## p5, a number in mm/s, within 2 %

    The question.

    - `half` **An answer.** Why it is right.
    - `twice` **Another.** Why it is not. *The confusion:* a second case.
    """
    made: dict[str, Prediction] = {}
    for found in re.finditer(r"^## (.+)\n((?s:.*?))(?=^## |\Z)", text, re.M):
        line, head = text.count("\n", 0, found.start()) + 1, HEAD.fullmatch(found[1].strip())
        if not head or head[1] in made or head[1] not in code:
            told = f"wanted '## p1' or '## p1, a number in UNIT, within 2 %', got {found[1]!r}"
            if head:
                told = f"{head[1]} is there twice" if head[1] in made else f"no facts {head[1]}()"
            raise wrong(file, line, told)
        question, *answers = re.split(r"^- ", found[2], flags=re.M)
        options = [_option(file, line, one_line(answer)) for answer in answers]
        names = [each.name for each in options]
        if len(set(names)) < max(2, len(names)) or sum(o.confusion is None for o in options) != 1:
            told = "wanted answers with unlike names, and a confusion for each but the right one"
            raise wrong(file, line, told)
        made[head[1]] = Prediction(
            question=one_line(question),
            options=options,
            facts=code[head[1]],
            right=lambda facts, names=names: names.index(facts["right"]),  # type: ignore[misc]
            view=code.get(f"{head[1]}_view", lambda: ""),
            unit=head[2],
            within=float(head[3]) / 100 if head[3] else 0.1,
            optional=bool(head[4]),
        )
    return made


def _option(file: str, line: int, text: str) -> Option:
    found = ANSWER.fullmatch(text)
    if not found:
        told = f"wanted '- `name` **An answer.** Why. *The confusion:* a case', got {text[:60]!r}"
        raise wrong(file, line, told)
    name, answer, reason, confusion, second = found.groups()
    return Option(answer, reason, confusion, second or "", name)
