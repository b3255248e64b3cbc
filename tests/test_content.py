"""Laws for all content in notebooks/exercises and in the folders of ROBOKIN_EXERCISES, including
laws that are too slow to test on every check.
"""

import contextlib
import warnings
from collections import Counter

import numpy as np
import pytest

from robokin.course import book
from robokin.course.answers import Outcome, run, unended
from robokin.course.catch import Catch
from robokin.course.edits import function_name
from robokin.course.exercises import Exercise
from robokin.course.function import Function

EXERCISES = {
    f"{name}.{number}": each
    for name, lab in book.labs().items()
    for number, each in lab.exercises.items()
    if isinstance(each, Exercise)
}
FUNCTIONS = [name for name, each in EXERCISES.items() if isinstance(each, Function)]
CATCHES = [name for name, each in EXERCISES.items() if isinstance(each, Catch)]
UNJUDGED = "It cannot be judged."


def test_all_content_can_be_read():
    """If you change a line of a solution, also change the text to the left of the arrow in each
    edit of it. The tests report the edits that no longer match.
    """
    told = [line for lab in book.labs().values() for line in lab.broken.values()]
    if told:
        pytest.fail("\n".join(told), pytrace=False)


@pytest.mark.parametrize("lab", book.labs())
def test_content_files_are_short(lab):
    """A file has at most 350 lines, and its name is not one that pytest would collect as a test
    module.
    """
    for file in book.labs()[lab].folder.glob("*.[mp][dy]"):
        assert len(file.read_text(encoding="utf-8").splitlines()) <= 350, file
        assert not file.stem.startswith("test_") and not file.stem.endswith("_test"), file


@pytest.mark.parametrize("name", EXERCISES)
def test_exercises_have_all_required_sections(name):
    text = EXERCISES[name].text
    assert text.title and text.task and len(set(text.hints)) == 3
    assert all(hint.strip() for hint in text.hints) and EXERCISES[name].solution.strip()


@pytest.mark.parametrize("name", [*FUNCTIONS, *CATCHES])
def test_mistakes_have_unique_names_and_explanations(name):
    mistakes = EXERCISES[name].text.wrong()
    assert len({each.name for each in mistakes}) >= 6, "wanted at least six mistakes"
    for what in ("name", "says"):
        found = Counter(getattr(each, what) for each in mistakes)
        assert not (twice := [text for text, n in found.items() if n > 1]), f"{what}: {twice}"
    assert all(each.says and each.programs for each in mistakes)


def outcomes(exercise, variant):
    """The outcomes of a wrong program in all cases."""
    [made] = run(lambda: _outcomes(exercise, variant), [()])
    if unended(made):
        pytest.fail(f"{variant.name!r} does not end", pytrace=False)
    return made.result


def _outcomes(exercise, variant):
    found = []
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        for k in range(len(exercise.cases)):
            try:
                found.append(exercise.formed(Outcome(exercise.result(variant, k)), k))
            except Exception as error:
                found.append(Outcome(name="raises an error", says=f"{error!r}"))
    return found


@pytest.mark.parametrize("name", FUNCTIONS)
def test_solutions_satisfy_the_law_of_their_exercise(name):
    exercise = EXERCISES[name]
    right = [exercise.formed(Outcome(wanted), k) for k, wanted in enumerate(exercise.wanted)]
    assert [exercise.wrong(o, k) for k, o in enumerate(right)] == [None] * len(exercise.cases)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_each_mistake_gives_wrong_results_and_gets_its_own_name(name):
    """A program whose edit uses a name that does not exist would raise an error in every case."""
    exercise = EXERCISES[name]
    for variant in exercise.own:
        got = outcomes(exercise, variant)
        raised = [o.says for o in got if o.name == "raises an error"]
        assert len(raised) < len(got), (variant.name, raised[0])
        assert not any(says.startswith("NameError") for says in raised), (variant.name, raised[0])
        wrong = [exercise.wrong(o, k) for k, o in enumerate(got)]
        assert any(wrong) and UNJUDGED not in wrong, variant
        first = next(k for k, sentence in enumerate(wrong) if sentence)
        told = {each for each, _ in exercise.named(got, wrong, first)}
        assert told == {variant.name}, variant


@pytest.mark.parametrize("name", CATCHES)
def test_programs_of_exercises_that_ask_for_a_test_compile(name):
    exercise = EXERCISES[name]
    assert exercise.promise and len(exercise.rights) >= 3
    for _, text in [*exercise.rights, *((n, text) for n, _, text in exercise.wrongs)]:
        assert callable(exercise.program(text))


@pytest.mark.parametrize("name", CATCHES)
def test_wrong_programs_do_not_fail_with_name_errors(name):
    """The solution's test calls each program. It would also refuse a program that only raises a
    NameError, but for the wrong reason.
    """
    exercise, space = EXERCISES[name], {}
    exec(compile(exercise.solution, name, "exec"), space)
    test = space[function_name(name, 1, exercise.solution)]
    for told, _, text in exercise.wrongs:
        program, came = exercise.program(text), []

        def recorded(*inputs, program=program, came=came):
            try:
                came.append(program(*inputs))
            except Exception as error:
                came.append(error)
                raise
            return came[-1]

        with contextlib.suppress(Exception):
            test(recorded)
        missing = [each for each in came if isinstance(each, (NameError, ImportError))]
        assert came and not missing, (told, missing[:1])
