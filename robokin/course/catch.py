"""A test to write that has to accept right programs and to catch wrong ones."""

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .answers import Outcome, is_stub, run
from .exercises import Exercise, Verdict, unanswered, words
from .mistakes import Mistake, Program

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
