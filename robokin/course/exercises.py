"""The machinery of the checks: kinds of exercise, and the verdict on an answer.

A check is properties on many cases, the smallest first. A wrong answer is named by the mistake,
itself a small wrong program, that it agrees with on all cases; by two if two agree; by none if none
does.
"""

import contextlib
import html
import warnings
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..quaternion import Quaternion
from ..transform import Transform
from ..units import deg, mm
from .answers import TROUBLE, Outcome, equal, is_stub, run, unended
from .mistakes import Mistake, Program, Tools, general

Fault = tuple[str, str]  # the name of what is wrong, and a sentence
NEAR = 0.01  # an answer that is off by no larger share is told to be nearly right


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
    """What every kind has. `title` is the lab's own; `objective` is one of the lab's three, from 1;
    `hints` go from a nudge to nearly all.
    """

    title: str
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
        mistake, says = self._explained(answer, cases, outcomes, wrong, first)
        good = round(wrong.count(None) / len(cases), 2)
        case = self._told(cases[first], outcomes[first], wrong[first])
        return Verdict(name, mistake=mistake, says=says, case=case, points=min(good, 0.9))

    def _explained(
        self,
        answer: Program,
        cases: Sequence[tuple[Any, ...]],
        outcomes: Sequence[Outcome],
        wrong: Sequence[str | None],
        first: int,
    ) -> tuple[str | None, tuple[str, ...]]:
        """Name and sentences of what is wrong, `first` in that case."""
        trouble = outcomes[first]
        if unended(trouble):
            return trouble.name, ()
        ended = [o for o in outcomes if not unended(o)]
        found = self.named(ended, wrong, cases, first)
        if found:
            names = list(dict.fromkeys(name for name, _ in found))[:2]
            sentences = [says for _, says in found if says][: len(names)]
            if ", and " in names[0] and isinstance(trouble.result, (bool, np.bool_)):
                sentences.insert(0, "It behaves like a program with two mistakes.")  # few answers
                return names[0], (" ".join(sentences[:2]),)
            return " or ".join(names), tuple([" Or: ".join(sentences)] if sentences else [])
        if trouble.name:
            return trouble.name, ()
        if has_nan(trouble.result) and not has_nan(self.right_result(cases[first])):
            return "NaN", ("A NaN stands where a number should.",)
        if len(ended) == len(cases):
            off = self._nearly(outcomes, cases)
            if off:
                return "nearly right", (off,)
            unused = self._unused(answer, outcomes, cases)
            if unused:
                told = " or ".join(f"`{each}`" for each in unused[:2])
                names = [f"{each} is not used" for each in unused[:2]]
                return " and ".join(names), (f"The result stays the same when {told} changes.",)
        return None, ("The mistake is not recognised: look at the case.",)

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

    def named(
        self,
        outcomes: Sequence[Outcome],
        wrong: Sequence[str | None],
        cases: Sequence[tuple[Any, ...]],
        first: int,
    ) -> list[Fault]:
        """The mistakes that give these outcomes in all cases: those of the exercise, or one answer
        to everything, or the general ones.
        """
        if len(outcomes) < min(6, len(cases)):
            return []
        rest = [k for k in range(len(outcomes)) if k != first]
        tried = [(outcomes[k], wrong[k], cases[k]) for k in (first, *rest)]
        said = [outcome.result for outcome in outcomes]
        if all(o.name is None and has_nan(o.result) for o in outcomes):
            return [("always NaN", "It gives NaN in every case that was tried.")]
        found = [m for m in self.mistakes if self.agrees(m.program, tried)]
        if not found and not any(o.name for o in outcomes):
            if all(equal(x, said[0]) for x in said):
                says = f"It answers {words(said[0])} to every case that was tried."
                return [("one answer to everything", says)]
        if not found:
            everybodys = general(self.right, self.inputs)
            found = [m for m in everybodys if self.agrees(m.program, tried)]
        return list(dict.fromkeys((m.name, m.says) for m in found))

    def agrees(
        self, program: Program, tried: Sequence[tuple[Outcome, str | None, tuple[Any, ...]]]
    ) -> bool:
        """Whether a program gives these outcomes in all cases, and an outcome at all in one; and
        whether it keeps the law where they do and breaks it where they do. So what leaves the right
        program as it is explains nothing.
        """
        others = []
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            for outcome, _, case in tried:
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
                others.append(other)
            return any(other.name != "raises an error" for other in others) and all(
                other.name is not None or (self._wrong(other, case) is None) == (says is None)
                for other, (_, says, case) in zip(others, tried, strict=True)
            )

    def _nearly(self, outcomes: Sequence[Outcome], cases: Sequence[tuple[Any, ...]]) -> str:
        """By how much an answer is off that is nearly right in every case; "": it is not."""
        worst = 0.0
        for outcome, case in zip(outcomes, cases, strict=True):
            mine, right = _numbers(outcome.result), _numbers(self.right_result(case))
            if outcome.name or mine is None or right is None or mine.shape != right.shape:
                return ""
            known = np.isfinite(right)
            if not np.array_equal(known, np.isfinite(mine)):
                return ""
            off = float(abs(mine - right)[known].max(initial=0))
            if off:
                worst = max(worst, off / max(float(abs(right[known]).max(initial=0)), 1e-300))
        if not 0 < worst <= NEAR:
            return ""
        much = f"{100 * worst:.2g} %" if worst > 1e-4 else f"{1e6 * worst:.2g} parts in a million"
        return (
            f"It is nearly right: off by at most {much}. A number with too few digits does that, "
            "a tolerance that is too loose, or a step that is too coarse."
        )

    def _unused(
        self, answer: Program, outcomes: Sequence[Outcome], cases: Sequence[tuple[Any, ...]]
    ) -> list[str]:
        """The inputs that make no difference to the answer, and should in some of the cases that
        are asked. Asked from several, with unlike results, none of them NaN; where the answers are
        True and False, from cases of both.
        """
        if any(outcome.name for outcome in outcomes):
            return []
        order = np.random.default_rng(140).permutation(len(cases)).tolist()
        unlike: list[list[int]] = []  # cases with the same result
        for k in order:
            result = outcomes[k].result
            if not has_nan(result):
                group = [g for g in unlike if self.same(result, outcomes[g[0]].result)]
                group[0].append(k) if group else unlike.append([k])
        if len(unlike) < 2:
            return []
        bases = [g[n] for n in range(3) for g in unlike if n < len(g)][:6]
        found = []
        for i, name in enumerate(self.inputs):
            tried = [
                (b, (*cases[b][:i], cases[k][i], *cases[b][i + 1 :]))
                for b in bases
                for k in order[:6]
                if not equal(cases[k][i], cases[b][i])
            ]
            got = run(answer, [case for _, case in tried])
            formed = [self._formed(o, c) for o, (_, c) in zip(got, tried, strict=False)]
            alike = all(
                o.name is None and equal(o.result, outcomes[b].result)
                for o, (b, _) in zip(formed, tried, strict=False)
            )
            if alike and len(formed) == len(tried):
                should = [b for b, case in tried if not self._equal_right(case, cases[b])]
                if len(should) >= 4 and len(set(should)) > 1:
                    found.append(name)
        return found

    def _equal_right(self, case: tuple[Any, ...], other: tuple[Any, ...]) -> bool:
        with contextlib.suppress(Exception):
            return self.same(self.right_result(case), self.right_result(other))
        return True

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


# --- In words -------------------------------------------------------------------------------------


def has_nan(value: Any) -> bool:
    """Whether a NaN stands in numbers or in a pose."""
    with contextlib.suppress(Exception):
        numbers = value.as_matrix() if isinstance(value, (Transform, Quaternion)) else value
        return bool(np.isnan(np.asarray(numbers, dtype=float)).any())
    return False


def _numbers(value: Any) -> Any:
    """A result as an array of numbers; None: it is none."""
    with contextlib.suppress(Exception):
        numbers = value.as_matrix() if isinstance(value, (Transform, Quaternion)) else value
        made = np.asarray(numbers)
        return made.astype(float) if made.dtype.kind in "fiu" else None
    return None


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
