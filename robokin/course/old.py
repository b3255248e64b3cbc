"""The exercises of the labs whose content is Python still."""

import contextlib
import random
import warnings
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .answers import Outcome, equal, is_stub, run, unended
from .exercises import Verdict, has_nan, unanswered, words
from .exercises import numbers as _numbers
from .mistakes import Mistake, Program, Tools, general

Fault = tuple[str, str]
NEAR = 0.01


@dataclass(frozen=True, kw_only=True)
class Exercise(ABC):
    """What every kind has. `objective` is one of the lab's three, from 1; `hints` go from a nudge
    to nearly all.
    """

    title: str
    task: str
    objective: int
    hints: Sequence[str]

    @abstractmethod
    def judge(self, name: str, answer: Any, who: Any) -> Verdict:
        """The verdict on an answer of the student `who`."""


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


ASSERTS = "It raises AssertionError"  # as `answers.run` says it


class NoResult(Exception):
    """What every wrong program raises in the place of its own errors."""


def _raises(*inputs: Any) -> Any:
    raise ValueError("no result")


RAISES = Mistake(
    "it raises an error",
    "It never comes to a result. A test that passes over errors accepts it: an error is a no.",
    _raises,
)


@dataclass(frozen=True, kw_only=True)
class Catch(Exercise):
    """A test to write: program -> True if it is right. It has to accept the `rights` and to refuse
    the `mistakes`, and a program that only raises. What a wrong program raises may pass through
    the test: that is a no. A test may say no by an assertion, and then yes by its silence.

    The programs come in an order drawn anew for each check, so that no test holds that counts its
    calls; what is told is the first in the order of this class.

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
        wrongs = [*self.mistakes, RAISES]
        told = [what for what, _ in self.rights] + [m.name for m in wrongs]
        programs = [p for _, p in self.rights] + [_guarded(m.program) for m in wrongs]
        outcomes = _asked(answer, programs)
        said = {k: _answer(outcome) for k, outcome in outcomes.items()}
        for k in sorted(outcomes):
            trouble = _trouble(outcomes[k], said[k])
            if trouble:
                case = f"  for the program: {told[k]}"
                return Verdict(name, mistake=trouble[0], says=trouble[1:], case=case)
        silent = [k for k in sorted(said) if said[k] is None]
        asserts = any(o.says.startswith(ASSERTS) for o in outcomes.values())
        if silent and (not asserts or any(x is True for x in said.values())):
            line = "Your test returns nothing: it has to return True or False. Is a return missing?"
            which = "every program" if len(silent) >= len(programs) - 1 else told[silent[0]]
            case = f"  for the program: {which}" if which in told else f"  for {which}"
            return Verdict(name, mistake="returns None", says=(line,), case=case)
        accepted = [said[k] is not False for k in range(len(programs))]
        verdict = self._verdict(name, answer, accepted, wrongs)
        if verdict.holds:
            again = {k: _answer(outcome) for k, outcome in _asked(answer, programs).items()}
            if any(again[k] != said[k] for k in said):
                line = "The same program gets another answer when it is asked again."
                return Verdict(name, mistake="its answer changes", says=(line,))
        return verdict

    def _verdict(
        self, name: str, answer: Program, accepted: Sequence[bool], wrongs: Sequence[Mistake]
    ) -> Verdict:
        right, wrong = accepted[: len(self.rights)], accepted[len(self.rights) :]
        refused = [each for each, yes in zip(self.rights, right, strict=True) if not yes]
        slipped = [m for m, yes in zip(wrongs, wrong, strict=True) if yes]
        if not refused and not slipped:
            line = f"It accepts {len(right)} right programs and catches {len(wrong)}."
            return Verdict(name, holds=True, says=(line,), points=1.0)
        count = (
            f"It refuses {len(refused)} of {len(right)} right programs and accepts "
            f"{len(slipped)} of {len(wrong)} wrong ones."
        )
        says = [self.promise, count] if refused else [slipped[0].says, count]
        if not any(right) and sum(wrong) >= len(self.mistakes):
            named = "True and False exchanged"
            says = ["It accepts what is wrong and refuses what is right.", count]
        elif not any(accepted):
            named = "refuses every program"
        elif all(accepted):
            named = "accepts every program"
        elif refused:
            named = "refuses a right program"
        else:
            named = f"accepts: {slipped[0].name}"
        if refused:
            case = f"  a right program that it refuses: {refused[0][0]}"
            says += self.refusal(answer, refused[0][1])
        else:
            case = f"  a wrong program that it accepts: {slipped[0].name}"
        points = round((len(accepted) - len(refused) - len(slipped)) / len(accepted), 2)
        return Verdict(name, mistake=named, says=tuple(says), case=case, points=points)

    def refusal(self, answer: Program, program: Program) -> Sequence[str]:
        """What else is told to a test that refuses this right program."""
        return ()


def _guarded(program: Program) -> Program:
    """The program, which raises nothing but `NoResult`; a new one of those that remember."""
    program = getattr(program, "anew", lambda: program)()

    def guarded(*inputs: Any) -> Any:
        try:
            return program(*inputs)
        except Exception as error:
            raise NoResult(f"{type(error).__name__}: {error}") from None

    return guarded


def _asked(answer: Program, programs: Sequence[Program]) -> Mapping[int, Outcome]:
    """What the test says of each program, asked in an order drawn by lot."""
    order = random.SystemRandom().sample(range(len(programs)), len(programs))
    outcomes = run(answer, [(programs[k],) for k in order])
    return dict(zip(order, outcomes, strict=False))


def _answer(outcome: Outcome) -> Any:
    """True or False; None: nothing was said; else what was returned, or the outcome itself."""
    if outcome.name == "raises an error":
        no = outcome.says.startswith((ASSERTS, "It raises NoResult"))
        return False if no else outcome
    if outcome.name:
        return None if outcome.name == "returns None" else outcome
    yes = isinstance(outcome.result, (bool, np.bool_))
    return bool(outcome.result) if yes else Outcome(outcome.result)


def _trouble(outcome: Outcome, said: Any) -> tuple[str, str] | None:
    """Name and sentence of an answer that is neither yes nor no."""
    if not isinstance(said, Outcome):
        return None
    if outcome.name:
        return outcome.name, outcome.says
    line = f"Your test has to return True or False; it returns {words(outcome.result)}."
    return "another kind or shape", line
