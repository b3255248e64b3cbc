"""Exercises in writing a function: the verdict on an answer, and the wrong programs that explain a
wrong answer.
"""

import contextlib
import inspect
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, cached_property, partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from . import edits, forms
from .answers import Outcome, equal, is_stub, run, unended
from .edits import Variant
from .exercises import Exercise, Verdict, has_nan, in_words, numbers, unanswered
from .markdown import BadFile, Text, why
from .slips import INPUTS, RESULTS, fed

NEAR = 0.01  # an answer with at most this relative error counts as nearly right
Case = tuple[Any, ...]
Fault = tuple[str, str]  # the name of the fault, and a sentence


class Candidate(NamedTuple):
    """A possible explanation of an answer: a name, a sentence, and a function that returns its
    result in case k.
    """

    name: str
    says: str
    result: Callable[[int], Any]


class Function(Exercise):
    """An exercise in writing a function. `code`, the names in the Python file, contains

    cases  (random generator) -> the inputs of all cases, as tuples, the simplest first

    and, if the defaults in `forms` do not suffice,

    form   (result, case) -> the result in the form that `law` and `same` need; raises a ValueError
           that says what was wanted and what was received
    law    (case, yours, wanted) -> None, or a sentence that says what should hold
    same   (one, other) -> True if two results count as the same answer

    Edits to the solution may use all names in the file.
    """

    def __init__(self, text: Text, code: Mapping[str, Any]) -> None:
        super().__init__(text)
        if not callable(code.get("cases")):
            raise BadFile(text.file, None, "wanted a function cases(rng) in its Python file")
        self.code = dict(code)
        line, _ = text.code("Solution")
        name = edits.function_name(text.file, line, self.solution)
        try:
            self.right: Callable[..., Any] = edits.run(self.solution, self.code)[name]
        except Exception as error:
            raise BadFile(text.file, line, f"the solution: {why(error)}") from None
        self.inputs = tuple(inspect.signature(self.right).parameters)
        wrong = edits.own(text.file, name, [self.solution], text.wrong())
        self.own = [variant for variant, _ in wrong]
        self.alike = code.get("same", forms.same)
        self.made: dict[Any, tuple[Callable[..., Any], dict[int, Any]]] = {}
        self.trying = ""  # the mistake whose wrong program is running
        self.endless: list[str] = []  # mistakes that never ended; they are not run again

    @cached_property
    def cases(self) -> list[Case]:
        """The cases, which are the same on every machine. Raises BadFile if there are none or
        making them takes more than 4 s.
        """
        draw = self.code["cases"]
        [outcome] = run(partial(_drawn, draw), [(140,)])
        found: list[Case] = outcome.result or []
        if outcome.name or not (found and all(self._fits(case) for case in found)):
            wanted = f"wanted tuples of {', '.join(self.inputs)}, got {in_words(outcome.result)}"
            code = getattr(draw, "__code__", None)
            file = code.co_filename if code and Path(code.co_filename).is_file() else self.text.file
            line = code.co_firstlineno if code else None
            raise BadFile(file, line, f"cases: {outcome.says or wanted}")
        return found

    def _fits(self, case: Any) -> bool:
        return isinstance(case, tuple) and len(case) == len(self.inputs)

    @cached_property
    def wanted(self) -> list[Any]:
        """The correct results, converted by `form`. Raises BadFile if the solution raises an error
        or has an invalid form.
        """
        found: list[Any] = []
        for outcome, case in zip(run(self.right, self.cases), self.cases, strict=False):
            try:
                if outcome.name:
                    raise ValueError(outcome.says)
                found.append(self.form(outcome.result, case, outcome.result))
            except Exception as error:
                line, _ = self.text.code("Solution")
                told = f"the solution, for {self._given(case)}: {error}"
                raise BadFile(self.text.file, line, told) from None
        return found

    @cached_property
    def steps(self) -> edits.Steps:
        return edits.Steps(self.solution, self.code)

    # --- The verdict

    def judge(self, name: str, answer: Any, who: Any) -> Verdict:
        if is_stub(answer):
            return unanswered(name)
        if not callable(answer):
            return Verdict(name, says=(f"Wanted a function, got {in_words(answer)}.",))
        cases, _ = self.cases, self.wanted  # only this line raises BadFile
        outcomes = [self.formed(o, k) for k, o in enumerate(run(answer, cases))]
        wrong = [self.wrong(o, k) for k, o in enumerate(outcomes)]
        if len(wrong) == len(cases) and not any(wrong):
            line = f"It passes all {len(cases)} cases that were tried."
            return Verdict(name, holds=True, says=(line,), points=1.0)
        first = next(k for k, sentence in enumerate(wrong) if sentence)
        mistake, says = self._explained(answer, outcomes, wrong, first)
        good = round(wrong.count(None) / len(cases), 2)
        case = self._told(first, outcomes[first], wrong[first])
        return Verdict(name, mistake=mistake, says=says, case=case, points=min(good, 0.9))

    def same(self, one: Any, other: Any) -> bool:
        """Return whether two results are equal. Results that cannot be compared are unequal."""
        with contextlib.suppress(Exception):
            return bool(self.alike(one, other))
        return False

    def form(self, result: Any, case: Case, wanted: Any) -> Any:
        """Return a result in the form that is compared. Raises ValueError if this is impossible."""
        own = self.code.get("form")
        return own(result, case) if own else forms.like(result, wanted)

    def formed(self, outcome: Outcome, k: int) -> Outcome:
        """Return the outcome of case k with its result converted by `form`."""
        if outcome.name:
            return outcome
        if outcome.result is None:  # of a wrong program of the exercise; an answer has a name
            return Outcome(name="returns None", says="It returns None.")
        try:
            wanted = None if "form" in self.code else self.wanted[k]
            return Outcome(self.form(outcome.result, self.cases[k], wanted))
        except Exception as error:
            return Outcome(outcome.result, "another kind or shape", f"{error}")

    def wrong(self, outcome: Outcome, k: int) -> str | None:
        """Return a sentence on what should hold in case k but does not, or None."""
        if outcome.name:
            return outcome.says
        with np.errstate(all="ignore"), contextlib.suppress(Exception):
            if law := self.code.get("law"):
                said: str | None = law(self.cases[k], outcome.result, self.wanted[k])
                return said
            same = self.same(outcome.result, self.wanted[k])
            return None if same else f"should be {in_words(self.wanted[k])}"
        return "It cannot be judged."

    def _told(self, k: int, outcome: Outcome, law: str | None) -> str:
        lines = [f"  for {self._given(self.cases[k])}"]
        if outcome.name in (None, "another kind or shape"):
            lines.append(f"  you return {in_words(outcome.result)}")
        return "\n".join([*lines, f"  {law}"])

    def _given(self, case: Case) -> str:
        return ", ".join(f"{n} = {in_words(v)}" for n, v in zip(self.inputs, case, strict=True))

    def _explained(
        self, answer: Any, outcomes: list[Outcome], wrong: list[str | None], first: int
    ) -> tuple[str | None, tuple[str, ...]]:
        """The name and sentences of the fault that appears in case `first`."""
        trouble = outcomes[first]
        if unended(trouble):
            return trouble.name, ()
        ended = [o for o in outcomes if not unended(o)]
        if found := self._named_in_time(ended, wrong, first):
            names = list(dict.fromkeys(name for name, _ in found))[:2]
            says = [says for _, says in found if says][: len(names)]
            return " or ".join(names), tuple([" Or: ".join(says)] if says else [])
        if trouble.name:
            return trouble.name, ()
        if has_nan(trouble.result) and not has_nan(self.wanted[first]):
            return "NaN", ("There is a NaN where a number should be.",)
        if len(ended) == len(self.cases):
            if off := self._nearly(outcomes):
                return "nearly right", (off,)
            if unused := self._unused(answer, outcomes)[:2]:
                told = " or ".join(f"`{each}`" for each in unused)
                names = [f"{each} has no effect" for each in unused]
                return " and ".join(names), (f"The result stays the same when {told} changes.",)
        told = "The mistake is not recognised: look at the case."
        if self.endless:
            which = ", ".join(map(repr, self.endless))
            told += f" (These mistakes of the exercise never end: {which}.)"
        return None, (told,)

    def _named_in_time(
        self, outcomes: list[Outcome], wrong: list[str | None], first: int
    ) -> list[Fault]:
        """`named`, but without the mistakes that never end."""
        while True:
            self.trying = ""
            [outcome] = run(partial(self.named, outcomes, wrong, first), [()])
            if not (unended(outcome) and self.trying):
                found: list[Fault] = outcome.result or []
                return found
            self.endless.append(self.trying)
            self.own = [each for each in self.own if each.name != self.trying]

    # --- Explanations of a wrong answer

    def named(self, outcomes: list[Outcome], wrong: list[str | None], first: int) -> list[Fault]:
        """The mistakes that give these outcomes in all cases. They are tried in groups, the
        likeliest first: one mistake of the exercise; a constant answer; one common slip; two
        mistakes of the exercise; one mistake of the exercise and a slip in its result.
        """
        if len(outcomes) < min(6, len(self.cases)):
            return []
        if all(o.name is None and has_nan(o.result) for o in outcomes):
            return [("always NaN", "It gives NaN in every case that was tried.")]
        order = [first, *(k for k in range(len(outcomes)) if k != first)]
        raising = all(o.name == "raises an error" for o in outcomes)
        for group in (self._singles, lambda: self._alike(outcomes), self._common):
            found = [c for c in group() if self.agrees(c, outcomes, wrong, order)]
            if names := list(dict.fromkeys((c.name, c.says) for c in found)):
                return names
        for group in () if raising else (self._pairs, self._slipped):
            found = [c for c in group() if self.agrees(c, outcomes, wrong, order)]
            names = list(dict.fromkeys((c.name, c.says) for c in found))
            if len(names) > 1:  # several explanations fit, so any one would be a guess
                return []
            # a result with few possible values is weak evidence for a pair of mistakes
            if names and isinstance(outcomes[first].result, (bool, np.bool_, str)):
                says = f"It behaves like a program with two mistakes. {names[0][1]}"
                return [(names[0][0], says)]
            if names:
                return names
        return []

    def _singles(self) -> Iterator[Candidate]:
        return map(self._candidate, self.own)

    def _alike(self, outcomes: list[Outcome]) -> Iterator[Candidate]:
        said = outcomes[0].result
        if not any(o.name for o in outcomes) and all(equal(o.result, said) for o in outcomes):
            says = f"It returns {in_words(said)} in every case that was tried."
            yield Candidate("one answer to everything", says, lambda k: said)

    def _common(self) -> Iterator[Candidate]:
        def read(change: Callable[[Any], Any], k: int) -> Any:
            return change(self.wanted[k])

        def changed(i: int, change: Callable[[Any], Any], k: int) -> Any:
            return self.right(*fed(self.cases[k], i, change))

        yield from map(self._candidate, self.slips)
        for name, says, change in RESULTS:
            yield Candidate(name, says, partial(read, change))
        for name, says, change in INPUTS:
            for i, about in enumerate(self.inputs):
                told = f"{says} This is about `{about}`."
                yield Candidate(name, told, partial(changed, i, change))

    def _pairs(self) -> Iterator[Candidate]:
        def ran(program: Callable[[], Any], k: int) -> Any:
            return program()(*self.cases[k])

        self.trying = ""
        for pair in edits.pairs(self.own):
            program = cache(partial(self.steps.program, pair))  # it may not be valid Python
            yield Candidate(pair.name, pair.says, partial(ran, program))

    def _slipped(self) -> Iterator[Candidate]:
        def read(one: Variant, change: Callable[[Any], Any], k: int) -> Any:
            return change(self.result(one, k))

        for one in self.own:
            for name, says, change in RESULTS:
                if name != one.name:  # not the same mistake twice
                    told = f"{one.says} And: {says}"
                    yield Candidate(f"{one.name}, and {name}", told, partial(read, one, change))

    @cached_property
    def slips(self) -> list[Variant]:
        """The common slips, as edits to the solution."""
        return edits.everybody(self.solution)

    def _candidate(self, variant: Variant) -> Candidate:
        return Candidate(variant.name, variant.says, partial(self.result, variant))

    def result(self, variant: Variant, k: int) -> Any:
        """The result of a wrong program in case k. The program runs only once for each case; if it
        raised an error, the error is raised again.
        """
        if variant.change not in self.made:
            self.made[variant.change] = (self.steps.program(variant), {})
        program, results = self.made[variant.change]
        self.trying = variant.name
        if k not in results:
            try:
                results[k] = program(*self.cases[k])
            except Exception as error:
                results[k] = error
        if isinstance(results[k], Exception):
            raise results[k]
        return results[k]

    def agrees(
        self,
        candidate: Candidate,
        outcomes: Sequence[Outcome],
        wrong: Sequence[str | None],
        order: Sequence[int],
    ) -> bool:
        """Return whether a candidate gives these outcomes in all cases, with a result in at least
        one, and satisfies and violates the law in the same cases. An edit that leaves the program
        correct explains nothing.
        """
        others = {}
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            for k in order:
                mine = outcomes[k]
                try:
                    other = self.formed(Outcome(candidate.result(k)), k)
                except Exception:
                    other = Outcome(name="raises an error")
                if mine.name != other.name:
                    return False
                if mine.name == "another kind or shape":
                    if not equal(mine.result, other.result):
                        return False
                elif mine.name is None and not self.same(mine.result, other.result):
                    return False
                others[k] = other
            return any(other.name != "raises an error" for other in others.values()) and all(
                other.name is not None or (self.wrong(other, k) is None) == (wrong[k] is None)
                for k, other in others.items()
            )

    # --- Remarks on an answer that no mistake explains

    def _nearly(self, outcomes: list[Outcome]) -> str:
        """Return a sentence on how far off an answer is if it is nearly right in every case,
        otherwise "".
        """
        worst = 0.0
        for outcome, wanted in zip(outcomes, self.wanted, strict=True):
            mine, right = numbers(outcome.result), numbers(wanted)
            if outcome.name or mine is None or right is None or mine.shape != right.shape:
                return ""
            known = np.isfinite(right)
            if not np.array_equal(known, np.isfinite(mine)):
                return ""
            if off := float(abs(mine - right)[known].max(initial=0)):
                worst = max(worst, off / max(float(abs(right[known]).max(initial=0)), 1e-300))
        if not 0 < worst <= NEAR:
            return ""
        much = f"{100 * worst:.2g} %" if worst > 1e-4 else f"{1e6 * worst:.2g} parts in a million"
        return (
            f"It is nearly right: off by at most {much}. The cause may be a number with too "
            "few digits, a tolerance that is too loose, or a step that is too coarse."
        )

    def _unused(self, answer: Any, outcomes: list[Outcome]) -> list[str]:
        """The inputs that do not affect the answer although they should in some cases. We try
        several cases with different results, none of them NaN; if the results are True and False,
        we try cases with both.
        """
        if any(outcome.name for outcome in outcomes):
            return []
        cases = self.cases
        order = np.random.default_rng(140).permutation(len(cases)).tolist()
        unlike: list[list[int]] = []  # cases grouped by result
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
            alike = all(
                self._as_before(o, case, outcomes[b].result)
                for o, (b, case) in zip(got, tried, strict=False)
            )
            if alike and len(got) == len(tried):
                should = [b for b, case in tried if not self._same_right(case, b)]
                if len(should) >= 4 and len(set(should)) > 1:
                    found.append(name)
        return found

    def _as_before(self, outcome: Outcome, case: Case, before: Any) -> bool:
        with contextlib.suppress(Exception):
            return outcome.name is None and equal(self.form(outcome.result, case, before), before)
        return False

    def _same_right(self, case: Case, k: int) -> bool:
        with contextlib.suppress(Exception):
            wanted = self.wanted[k]
            return self.same(self.form(self.right(*case), case, wanted), wanted)
        return True


def _drawn(cases: Callable[..., Any], seed: int) -> list[Case]:
    return list(cases(np.random.default_rng(seed)))
