"""The machinery of the checks: four kinds of exercise, and the verdict on an answer.

A check is properties on many cases, the smallest first. A wrong answer is named by the mistake,
itself a small wrong program, that it agrees with on all cases; by two if two agree; by none if none
does.
"""

import contextlib
import html
import warnings
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, mm
from .answers import NEVER, TROUBLE, Outcome, equal, is_stub, run
from .mistakes import Mistake, Program, Tools, general

Fault = tuple[str, str]  # the name of what is wrong, and a sentence


@dataclass(frozen=True)
class Verdict:
    """What a check found. Shows itself at the end of a cell.

    answered  whether there was anything to judge
    holds     whether everything that was tried holds
    mistake   the mistake by its name, two joined by " or "; None: none, or not recognised
    says      sentences
    case      the smallest input that shows what is wrong, with your result and what should hold
    points    from 0 to 1: the share of what was tried that holds
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
        word = "holds" if self.holds else "does not hold" if self.answered else "not answered yet"
        lines = [f"{self.exercise}: {word}."]
        if self.case:
            lines += self.case.split("\n")
        if self.mistake and self.mistake not in TROUBLE:  # the case has said it
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


@dataclass(frozen=True, kw_only=True)
class Exercise(ABC):
    """What every kind has. `objective` is one of the lab's three, from 1; `hints` go from a nudge
    to nearly all.
    """

    task: str
    objective: int
    hints: Sequence[str]

    @abstractmethod
    def judge(self, name: str, answer: Any, who: Any) -> Verdict:
        """The verdict on an answer of the student `who`."""


def unanswered(name: str) -> Verdict:
    """The friendly line."""
    says = "Nothing here yet: write your answer into the cell above and run both again."
    return Verdict(name, answered=False, says=(says,))


# --- Write a function -----------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Function(Exercise):
    """A function to write.

    inputs    the names of its inputs
    right     right(tools, *inputs): a right program, written with `Tools`
    cases     generator of random numbers -> inputs, the smallest first
    form      (result, inputs) -> the result as `law` and `same` want it; ValueError that says what
              was wanted and what came
    law       (inputs, result) -> None, or a sentence: what should hold
    same      whether two results are one answer
    mistakes  those of this exercise
    """

    inputs: Sequence[str]
    right: Program
    cases: Callable[[np.random.Generator], Sequence[tuple[Any, ...]]]
    form: Callable[[Any, tuple[Any, ...]], Any]
    law: Callable[[tuple[Any, ...], Any], str | None]
    same: Callable[[Any, Any], bool]
    mistakes: Sequence[Mistake] = ()

    def seeded(self) -> Sequence[tuple[Any, ...]]:
        """The cases, the same on every machine."""
        return self.cases(np.random.default_rng(140))

    def judge(self, name: str, answer: Any, who: Any) -> Verdict:
        if is_stub(answer):
            return unanswered(name)
        if not callable(answer):
            return Verdict(name, says=(f"Wanted a function, got {words(answer)}.",))
        cases = self.seeded()
        outcomes = [self._formed(o, c) for o, c in zip(run(answer, cases), cases, strict=False)]
        wrong = [self._wrong(o, c) for o, c in zip(outcomes, cases, strict=False)]
        if len(wrong) == len(cases) and not any(wrong):
            line = f"It holds in all {len(cases)} cases that were tried, edges among them."
            return Verdict(name, holds=True, says=(line,), points=1.0)
        first = next(k for k, sentence in enumerate(wrong) if sentence)
        trouble = outcomes[first]
        ended = [o for o in outcomes if o is not NEVER]
        named = self.named(ended, cases) if trouble is not NEVER else []
        if not named and trouble.name:
            named = [(trouble.name, "")]
        elif not named and len(ended) == len(cases):
            named = self._unused(answer, cases)
        says = tuple(sentence for _, sentence in named if sentence)
        if not named and has_nan(trouble.result):
            named, says = [("NaN", "")], ("A NaN stands where a number should.",)
        if not named:
            says = ("The mistake is not recognised: look at the case.",)
        good = round(wrong.count(None) / len(cases), 2)
        case = self._told(cases[first], trouble, wrong[first])
        mistake = " or ".join(dict.fromkeys(each for each, _ in named)) or None
        return Verdict(name, mistake=mistake, says=says, case=case, points=min(good, 0.9))

    def _formed(self, outcome: Outcome, case: tuple[Any, ...]) -> Outcome:
        if outcome.name:
            return outcome
        try:
            result = self.form(outcome.result, case)
        except Exception as error:
            return Outcome(outcome.result, "another kind or shape", f"{error}")
        return Outcome(result)

    def _wrong(self, outcome: Outcome, case: tuple[Any, ...]) -> str | None:
        if outcome.name:
            return outcome.says
        with np.errstate(all="ignore"), contextlib.suppress(Exception):
            return self.law(case, outcome.result)
        return "It cannot be judged."

    def named(self, outcomes: Sequence[Outcome], cases: Sequence[tuple[Any, ...]]) -> list[Fault]:
        """The mistakes that give these outcomes in all cases; those of the exercise first, and the
        general ones where none of these does.
        """
        if len(outcomes) < min(6, len(cases)):
            return []
        cases = cases[: len(outcomes)]
        own = [m for m in self.mistakes if self.agrees(m.program, outcomes, cases)]
        said = [o.result for o in outcomes]
        if not own and all(isinstance(x, (bool, np.bool_)) for x in said) and len({*said}) == 1:
            says = f"It answers {said[0]} to every case that was tried."
            return [("one answer to everything", says)]
        found = own or [
            m
            for m in general(self.right, len(self.inputs))
            if self.agrees(m.program, outcomes, cases)
        ]
        return list(dict.fromkeys((m.name, m.says) for m in found))

    def _unused(self, answer: Program, cases: Sequence[tuple[Any, ...]]) -> list[Fault]:
        """The inputs that make no difference to the answer where they should."""
        found = []
        for k, name in enumerate(self.inputs):
            tried = [(*cases[0][:k], case[k], *cases[0][k + 1 :]) for case in cases]
            tried = [case for case in tried if not self._equal_right(case, cases[0])][:20]
            outcomes = [
                self._formed(o, c)
                for o, c in zip(run(answer, [cases[0], *tried]), [cases[0], *tried], strict=False)
            ]
            if len(outcomes) < 3 or any(outcome.name for outcome in outcomes):
                continue
            if all(equal(outcome.result, outcomes[0].result) for outcome in outcomes[1:]):
                says = f"Another {name} gives the very same result: `{name}` makes no difference."
                found.append((f"{name} is not used", says))
        return found

    def _equal_right(self, case: tuple[Any, ...], other: tuple[Any, ...]) -> bool:
        with contextlib.suppress(Exception):
            return self.same(self.right_result(case), self.right_result(other))
        return True

    def agrees(
        self, program: Program, outcomes: Sequence[Outcome], cases: Sequence[tuple[Any, ...]]
    ) -> bool:
        """Whether a program gives these outcomes in all cases, and an outcome at all in one."""
        common = 0
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            for outcome, case in zip(outcomes, cases, strict=True):
                try:
                    other = self._formed(Outcome(program(*case)), case)
                except Exception:
                    other = Outcome(name="raises an error")
                if outcome.name != other.name:
                    return False
                if outcome.name == "another kind or shape":
                    if not equal(outcome.result, other.result):
                        return False
                elif outcome.name is None and not self.same(outcome.result, other.result):
                    return False
                common += outcome.name != "raises an error"
        return common > 0

    def _told(self, case: tuple[Any, ...], outcome: Outcome, law: str | None) -> str:
        inputs = ", ".join(f"{n} = {words(v)}" for n, v in zip(self.inputs, case, strict=True))
        lines = [f"  for {inputs}"]
        if outcome.name in (None, "another kind or shape"):
            lines.append(f"  you return {words(outcome.result)}")
        return "\n".join([*lines, f"  {law}"])

    def right_result(self, case: tuple[Any, ...]) -> Any:
        """What the right program gives, in form."""
        return self.form(self.right(Tools(), *case), case)


# --- Give a value: pose and design ----------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Value(Exercise):
    """A value to give, of which many are right: a pose taken from an explorer ("pose"), or numbers
    within limits for one's own task ("design").

    form    (answer, given) -> the answer as `faults` wants it; ValueError that says what was wanted
    faults  (answer, given) -> what does not hold, each with a name and a sentence: the first counts
    count   how many conditions there are
    given   who -> this student's numbers; None: all have the same task
    goal    for a pose taken from an explorer: what the page tells by itself (page.PageExplorer)
    """

    form: Callable[[Any, Any], Any]
    faults: Callable[[Any, Any], Sequence[Fault]]
    count: int
    given: Callable[[Any], Any] | None = None
    goal: Mapping[str, Any] | None = None

    def judge(self, name: str, answer: Any, who: Any) -> Verdict:
        if is_stub(answer):
            return unanswered(name)
        if isinstance(answer, Mapping) and any(v is None or v is ... for v in answer.values()):
            return unanswered(name)
        if self.given and who is None:
            line = 'Whose numbers? Give your name: check(..., who="your name").'
            return Verdict(name, says=(line,))
        given = self.given(who) if self.given else None
        try:
            formed = self.form(answer, given)
        except Exception as error:
            return Verdict(
                name,
                mistake="another kind or shape",
                says=(f"{error}",),
                case=f"  your answer is {words(answer)}",
            )
        found = list(self.faults(formed, given))
        if not found:
            line = "It does what it should."
            if self.count > 1:
                line = f"All {self.count} conditions hold."
            return Verdict(name, holds=True, says=(line,), points=1.0)
        return Verdict(
            name,
            mistake=found[0][0],
            says=tuple(dict.fromkeys(says for _, says in found)),
            case=f"  your answer is {words(answer)}",
            points=round(max(0, self.count - len(found)) / self.count, 2),
        )


# --- Catch wrong programs -------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Catch(Exercise):
    """A test to write: program -> True if it is right. It has to accept the `rights` and to refuse
    the `mistakes`.

    rights   (what is special about it, program)
    promise  what a right program keeps, in a sentence: told to a test that refuses one
    """

    rights: Sequence[tuple[str, Program]]
    mistakes: Sequence[Mistake] = field(default=())
    promise: str = ""

    def judge(self, name: str, answer: Any, who: Any) -> Verdict:
        if is_stub(answer):
            return unanswered(name)
        if not callable(answer):
            return Verdict(name, says=(f"Wanted a function, got {words(answer)}.",))
        programs = [(p,) for _, p in self.rights] + [(m.program,) for m in self.mistakes]
        outcomes = run(answer, programs, each=True)
        # a test may say no by an assertion, and yes by its silence
        said = [
            False
            if o.name == "raises an error" and o.says.startswith("It raises AssertionError")
            else True
            if o.name == "returns None"
            else o.result
            for o in outcomes
        ]
        told = [what for what, _ in self.rights] + [m.name for m in self.mistakes]
        for what, outcome, answered in zip(told, outcomes, said, strict=False):
            case = f"  for the program: {what}"
            if outcome.name not in (None, "returns None") and answered is not False:
                return Verdict(name, mistake=outcome.name, says=(outcome.says,), case=case)
            if not isinstance(answered, (bool, np.bool_)):
                line = f"Your test has to return True or False; it returns {words(answered)}."
                return Verdict(name, mistake="another kind or shape", says=(line,), case=case)
        accepted = [bool(x) for x in said]
        refused = [what for (what, _), yes in zip(self.rights, accepted, strict=False) if not yes]
        slipped = [
            m for m, yes in zip(self.mistakes, accepted[len(self.rights) :], strict=True) if yes
        ]
        count = len(programs)
        points = round((count - len(refused) - len(slipped)) / count, 2)
        if not refused and not slipped:
            line = f"It accepts {len(self.rights)} right programs and catches {len(self.mistakes)}."
            return Verdict(name, holds=True, says=(line,), points=1.0)
        if not any(accepted):
            named = "refuses every program"
        elif all(accepted):
            named = "accepts every program"
        elif refused:
            named = "refuses a right program"
        else:
            named = f"accepts: {slipped[0].name}"
        case = (
            f"  a right program that it refuses: {refused[0]}"
            if refused
            else f"  a wrong program that it accepts: {slipped[0].name}"
        )
        says = [self.promise] if refused else [slipped[0].says]
        says.append(
            f"It refuses {len(refused)} of {len(self.rights)} right programs and accepts "
            f"{len(slipped)} of {len(self.mistakes)} wrong ones."
        )
        return Verdict(name, mistake=named, says=tuple(says), case=case, points=points)


# --- In words -------------------------------------------------------------------------------------


def has_nan(value: Any) -> bool:
    """Whether a NaN stands in numbers or in a pose."""
    with contextlib.suppress(Exception):
        numbers = value.as_matrix() if isinstance(value, (Transform, Quaternion)) else value
        return bool(np.isnan(np.asarray(numbers, dtype=float)).any())
    return False


def words(value: Any) -> str:
    """A value in one short line."""
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
        if value.size > 12:
            return f"an array of shape {value.shape}: [{_row(value.ravel()[:4])}, ...]"
        if value.ndim == 2:
            return "[" + ", ".join(f"[{_row(row)}]" for row in value) + "]"
        return f"[{_row(value)}]" if value.ndim == 1 else f"an array of shape {value.shape}"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{k!r}: {words(v)}" for k, v in value.items()) + "}"
    if callable(value):
        return f"the function {getattr(value, '__name__', '?')}"
    with contextlib.suppress(Exception):
        text = " ".join(repr(value).split())
        return text if len(text) < 120 else text[:117] + "..."
    return f"an object of {type(value).__name__}"


def _row(values: Any) -> str:
    return ", ".join(f"{x:.5g}" for x in np.asarray(values) + 0.0)
