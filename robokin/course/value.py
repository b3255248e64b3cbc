"""Exercises that ask for a value and have many correct answers: numbers for an individual task, a
pose, a program.
"""

from collections.abc import Callable, Mapping
from typing import Any

from .answers import is_stub
from .exercises import Exercise, Verdict, in_words, unanswered
from .markdown import BadFile, Text


class Value(Exercise):
    """An exercise that asks for a value. `code`, the names in the Python file, contains

    form    (answer, given) -> the answer in the form that `faults` needs; raises a ValueError that
            says what was wanted
    faults  (answer, given) -> (name, sentence) of each condition that does not hold; the first one
            names the mistake
    COUNT   the number of conditions

    and may contain

    given   (who) -> this student's numbers; without it, all students have the same task
    GOAL    for a pose taken from an explorer: the task that the page checks (page.PageExplorer)
    plain   (answer) -> the answer as shown in the case
    holds   (answer, given) -> additional sentences for an answer that passes
    """

    def __init__(self, text: Text, code: Mapping[str, Any]) -> None:
        super().__init__(text)
        if missing := [name for name in ("form", "faults", "COUNT") if name not in code]:
            raise BadFile(text.file, None, f"wanted {' and '.join(missing)} in its Python file")
        self.code = dict(code)
        self.given: Callable[[Any], Any] | None = code.get("given")
        self.goal: Mapping[str, Any] | None = code.get("GOAL")
        self.count: int = code["COUNT"]

    def judge(self, name: str, answer: Any, who: Any) -> Verdict:
        if is_stub(answer):
            return unanswered(name)
        if isinstance(answer, Mapping):
            empty = [
                in_words(key).strip("'")
                for key, value in answer.items()
                if value is None or value is ...
            ]
            if len(empty) == len(answer) > 0:
                return unanswered(name)
            if empty:
                return unanswered(name, f"value for {' and for '.join(empty)}")
        # in a tuple, None is the result of a call, such as that of a search which found nothing
        if isinstance(answer, tuple) and answer and all(v is ... for v in answer):
            return unanswered(name)
        if self.given and who is None:
            line = 'Whose numbers should be used? Add your name: check(..., who="your name").'
            return Verdict(name, says=(line,))
        given = self.given(who) if self.given else None
        case = f"  your answer is {in_words(self.code.get('plain', lambda x: x)(answer))}"
        try:
            formed = self.code["form"](answer, given)
        except Exception as error:
            return Verdict(name, mistake="another kind or shape", says=(f"{error}",), case=case)
        found = list(self.code["faults"](formed, given))
        if not found:
            line = "It does what it should."
            if self.count > 1:
                line = f"All {self.count} conditions hold."
            more = self.code["holds"](formed, given) if "holds" in self.code else ()
            return Verdict(name, holds=True, says=(line, *more), points=1.0)
        return Verdict(
            name,
            mistake=found[0][0],
            says=tuple(dict.fromkeys(says for _, says in found)),
            case=case,
            points=round(max(0, self.count - len(found)) / self.count, 2),
        )
