"""Exercises in writing a test, which must accept correct programs and reject wrong ones."""

import random
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from . import edits
from .answers import Outcome, is_stub, run
from .exercises import ACCEPTS, Exercise, Verdict, in_words, unanswered
from .markdown import BadFile, Text

ASSERTS = "It raises AssertionError"  # the beginning of a sentence from `answers.run`
RAISES = (
    "it raises an error",
    "It never returns a result. A test that ignores errors accepts it, although an error shows "
    "that the program is wrong.",
)
SLOW = "That is your whole test of this program: try fewer cases."
Program = Callable[..., Any]


class NoResult(Exception):
    """Wrong programs raise this instead of their own errors."""


class Catch(Exercise):
    """An exercise in writing a test: a function that takes a program and returns True if the
    program is correct. The test must accept the correct programs, and reject the mistakes and a
    program that always raises an error. If a wrong program raises an error that the test does not
    catch, this counts as a rejection. A test may also reject a program by a failed assertion; then
    returning nothing means that it accepts the program.

    The Markdown file contains the correct programs, a promise (what they guarantee, shown if the
    test rejects one of them) and the mistakes, each as edits to the first correct program that they
    fit. All programs may use the names in the Python file, `code`. If this file defines
    `rejection(inputs, result)`, that function returns an additional sentence about the last call of
    a correct program that was rejected.

    Each check runs the programs in a new random order, so that a test that counts its calls does
    not pass. The verdict names the first failure in the order of the Markdown file.
    """

    def __init__(self, text: Text, code: Mapping[str, Any]) -> None:
        super().__init__(text)
        self.code = dict(code)
        line, first = text.code("Correct programs")
        self.function = edits.function_name(text.file, line, first)
        right = edits.own(text.file, self.function, [first], text.wrong("Correct programs"))
        if not right:
            raise BadFile(text.file, line - 1, "wanted '**what is special.**' above the program")
        self.rights = [(" ".join(filter(None, each[:2])), each.text(first)) for each, _ in right]
        programs = [program for _, program in self.rights]
        self.promise = text.prose("Promise")
        self.wrongs = [
            (variant.name, variant.says, variant.text(base))
            for variant, base in edits.own(text.file, self.function, programs, text.wrong())
        ]

    def program(self, text: str) -> Program:
        """Make a new copy of the program, so that it has no state from earlier calls."""
        made: Program = edits.run(text, self.code)[self.function]
        return made

    def judge(self, name: str, answer: Any, who: Any) -> Verdict:
        if is_stub(answer):
            return unanswered(name)
        if not callable(answer):
            return Verdict(name, says=(f"Wanted a function, got {in_words(answer)}.",))
        told = [*(what for what, _ in self.rights), *(n for n, _, _ in self.wrongs), RAISES[0]]
        outcomes = self._asked(answer)
        said = {k: _answer(outcome) for k, outcome in outcomes.items()}
        for k in sorted(outcomes):
            if trouble := _trouble(outcomes[k], said[k]):
                case = f"  for the program: {told[k]}"
                return Verdict(name, mistake=trouble[0], says=trouble[1:], case=case)
        silent = [k for k in sorted(said) if said[k] is None]
        asserts = any(o.says.startswith(ASSERTS) for o in outcomes.values())
        if silent and (not asserts or any(x is True for x in said.values())):
            line = "Your test returns nothing: it has to return True or False. Is a return missing?"
            which = "every program" if len(silent) >= len(told) - 1 else told[silent[0]]
            case = f"  for the program: {which}" if which in told else f"  for {which}"
            return Verdict(name, mistake="returns None", says=(line,), case=case)
        verdict = self._verdict(name, answer, [said[k] is not False for k in range(len(told))])
        if verdict.holds:
            again = {k: _answer(outcome) for k, outcome in self._asked(answer).items()}
            if any(again[k] != said[k] for k in said):
                line = "Your test gives the same program a different answer the second time."
                return Verdict(name, mistake="its answer changes", says=(line,))
        return verdict

    def _asked(self, answer: Program) -> Mapping[int, Outcome]:
        """The outcome of the test for each program; the programs run in random order."""
        programs = [self.program(text) for _, text in self.rights]
        programs += [_guarded(self.program(text)) for _, _, text in self.wrongs]
        programs.append(_guarded(_raises))
        order = random.SystemRandom().sample(range(len(programs)), len(programs))
        outcomes = run(answer, [(programs[k],) for k in order])
        return dict(zip(order, outcomes, strict=False))

    def _verdict(self, name: str, answer: Program, accepted: Sequence[bool]) -> Verdict:
        wrongs = [*(wrong[:2] for wrong in self.wrongs), RAISES]
        right, wrong = accepted[: len(self.rights)], accepted[len(self.rights) :]
        rejected = [each for each, yes in zip(self.rights, right, strict=True) if not yes]
        slipped = [each for each, yes in zip(wrongs, wrong, strict=True) if yes]
        if not rejected and not slipped:
            line = f"It accepts {len(right)} correct programs and catches {len(wrong)} wrong ones."
            return Verdict(name, holds=True, says=(line,), points=1.0)
        count = (
            f"It rejects {len(rejected)} of {len(right)} correct programs and accepts "
            f"{len(slipped)} of {len(wrong)} wrong ones."
        )
        says = [self.promise, count] if rejected else [slipped[0][1], count]
        if not any(right) and sum(wrong) >= len(wrong) - 1:
            named = "True and False swapped"
            says = ["It accepts the wrong programs and rejects the correct ones.", count]
        elif not any(accepted):
            named = "rejects every program"
        elif all(accepted):
            named = "accepts every program"
        elif rejected:
            named = "rejects a correct program"
        else:
            named = f"{ACCEPTS}{slipped[0][0]}"
        if rejected:
            case = f"  a correct program that it rejects: {rejected[0][0]}"
            says += self._rejection(answer, rejected[0][1])
            if named == "rejects a correct program" and slipped:
                says.append(f"It also accepts a wrong program, {slipped[0][0]}: {slipped[0][1]}")
        else:
            case = f"  a wrong program that it accepts: {slipped[0][0]}"
        points = round((len(accepted) - len(rejected) - len(slipped)) / len(accepted), 2)
        return Verdict(name, mistake=named, says=tuple(says), case=case, points=points)

    def _rejection(self, answer: Program, text: str) -> list[str]:
        """The additional sentence for a test that rejects this correct program."""
        if "rejection" not in self.code:
            return []
        program, calls = self.program(text), []

        def recorded(*inputs: Any) -> Any:
            calls.append((inputs, program(*inputs)))
            return calls[-1][1]

        run(answer, [(recorded,)])
        return [self.code["rejection"](*calls[-1])] if calls else ["It never calls the program."]


def _raises(*inputs: Any) -> Any:
    raise ValueError("no result")


def _guarded(program: Program) -> Program:
    """Wrap the program so that it raises only `NoResult`."""

    def guarded(*inputs: Any) -> Any:
        try:
            return program(*inputs)
        except Exception as error:
            raise NoResult(f"{type(error).__name__}: {error}") from None

    return guarded


def _answer(outcome: Outcome) -> Any:
    """Return True or False, None if the test returned nothing, otherwise the returned value or the
    outcome itself.
    """
    if outcome.name == "raises an error":
        no = outcome.says.startswith((ASSERTS, "It raises NoResult"))
        return False if no else outcome
    if outcome.name:
        return None if outcome.name == "returns None" else outcome
    yes = isinstance(outcome.result, (bool, np.bool_))
    return bool(outcome.result) if yes else Outcome(outcome.result)


def _trouble(outcome: Outcome, said: Any) -> tuple[str, str] | None:
    """The name and sentence for an answer that is neither True nor False."""
    if not isinstance(said, Outcome):
        return None
    if outcome.name == "raises an error":
        says = outcome.says.removeprefix("It raises")
        return outcome.name, f"Your test has to return True or False; it raises{says}"
    if outcome.name:
        slow = outcome.name == "never ends"
        return outcome.name, f"{outcome.says} {SLOW}" if slow else outcome.says
    line = f"Your test has to return True or False; it returns {in_words(outcome.result)}."
    return "another kind or shape", line
