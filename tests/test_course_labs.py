"""Laws for the exercises and predictions of every lab. The tests for a single lab are in
test_course_<lab>.py.
"""

import json
import random
import re

import nbformat
import numpy as np
import pytest
from conftest import NOTEBOOKS, PATIENCE
from nbclient import NotebookClient

from robokin import course
from robokin.course import book, catch, check, hint, progress, solution
from robokin.course.catch import Catch
from robokin.course.function import Function
from robokin.course.predictions import shown
from robokin.course.questions import chosen_option, filled

LABS = {name: next(NOTEBOOKS.glob(f"*_{name}.ipynb")) for name in book.labs()}
EXERCISES = [name for lab in book.labs() for name in book.ids(lab, "exercises")]
PREDICTIONS = [name for lab in book.labs() for name in book.ids(lab, "predictions")]
KINDS = {e: type(book.find(e, "exercises")) for e in EXERCISES}
FUNCTIONS = [e for e in EXERCISES if KINDS[e] is Function]
CATCHES = [e for e in EXERCISES if KINDS[e] is Catch]
every_lab = pytest.mark.parametrize("lab", book.labs())
SHORT = ("start_here", "rotor", "conveyor")  # labs of at most half an hour, with one exercise


def cells(lab):
    return json.loads(LABS[lab].read_text(encoding="utf-8"))["cells"]


def words_of(lab):
    return "\n\n".join("".join(c["source"]) for c in cells(lab) if c["cell_type"] == "markdown")


def code(lab):
    return "\n".join("".join(c["source"]) for c in cells(lab) if c["cell_type"] == "code")


@every_lab
def test_lab_contains_its_predictions_and_exercises_in_order(lab):
    asked = re.findall(r'^predict\("([\w.]+)"\)$', code(lab), re.M)
    assert asked == book.ids(lab, "predictions")
    checked = re.findall(r'^check\("([\w.]+)",', code(lab), re.M)
    assert sorted(checked) == book.ids(lab, "exercises")
    assert len(asked) <= 10 and len(checked) == (1 if lab in SHORT else 3)


def test_ids_of_predictions_are_unique():
    assert len(set(PREDICTIONS)) == len(PREDICTIONS)
    moved = {p for lab in book.labs() for p in book.lab(lab).moved.values()}
    assert moved <= set(PREDICTIONS)
    for name in moved:  # the lab that asked it first does not use its number again
        first, _, number = name.partition(".")
        assert number not in book.lab(first).predictions, name


@every_lab
def test_exercise_titles_and_optional_predictions_match_the_lab(lab):
    sources = ["".join(c["source"]) for c in cells(lab)]
    text = "\n".join(sources)
    for n, exercise in book.lab(lab).exercises.items():
        assert re.search(rf"^\*\*(?:{n}\. )?{re.escape(exercise.title)}[.?]?\*\*", text, re.M)
    [more] = [k for k, each in enumerate(sources) if each.startswith("## More")]
    later = re.findall(r'^predict\("\w+\.(\w+)"\)$', "\n".join(sources[more:]), re.M)
    assert later == [n for n, each in book.lab(lab).predictions.items() if each.optional]


@every_lab
def test_every_objective_is_practised_and_named_in_the_lab(lab, monkeypatch):
    monkeypatch.setattr(course, "_verdicts", {})
    made = book.lab(lab)
    assert len(made.objectives) == (1 if lab in SHORT else 3)
    numbers = set(range(1, len(made.objectives) + 1))
    assert {e.objective for e in made.exercises.values()} == numbers
    kinds = {type(e) for e in made.exercises.values()}
    assert kinds - {Function}, "every exercise asks for a function"
    assert "not yet" in progress(lab) and all(f"{lab}.{n}" in progress(lab) for n in made.exercises)
    words = " ".join("".join(c["source"]) for c in cells(lab) if c["cell_type"] == "markdown")
    plain = re.sub(r"[*\s]+", " ", words)
    for objective in made.objectives:
        assert objective.rstrip(".;") in plain, objective
    if lab in SHORT[1:]:  # in a short lab, questions practise the objectives that have no exercise
        listed = re.search(r"\*\*You will be able to\*\*\n\n(.*?)\n\n", words_of(lab), re.S)[1]
        parts = re.findall(r"\((exercise 1|question in section \d)\)[;.]$", listed, re.M)
        assert len(parts) == 3 == listed.count("\n") + 1 and "exercise 1" in parts
        sections = re.split(
            r"^## (?=\d)", "\n".join("".join(c["source"]) for c in cells(lab)), flags=re.M
        )
        assert all("predict(" in sections[int(p[-1])] for p in parts if p[0] == "q")


@every_lab
def test_last_cell_makes_the_report_and_your_turn_refers_to_it(lab):
    """The cell uses the student's name, which an earlier cell or its own first line sets."""
    sources = ["".join(c["source"]) for c in cells(lab)]
    end = next(k for k, text in enumerate(sources) if text.startswith("## In short"))
    assert re.search(r"^report\(who\)$", sources[-1], re.M)
    assert "last cell" in sources[end - 1].split("\n\n")[-1], "no line about the report"
    named = re.findall(r'^who = "(.*)"$', "\n".join(sources), re.M)
    assert named == ["your name"]
    assert len(re.findall(r"\breport\(", code(lab))) == 1


@pytest.mark.parametrize("name", EXERCISES)
def test_untouched_exercise_counts_as_unanswered(name):
    lab = book.home(name)
    kept = [
        "".join(c["outputs"][0]["data"]["text/plain"])
        for c in cells(lab)
        if re.search(rf'^check\("{re.escape(name)}"', "".join(c["source"]), re.M)
    ]
    assert len(kept) == 1 and kept[0].startswith(f"{name}: not answered yet.")


@pytest.mark.parametrize("name", EXERCISES)
def test_hints_are_distinct_and_the_solution_passes(name):
    exercise = book.find(name, "exercises")
    assert len(exercise.hints) == 3 and len(set(exercise.hints)) == 3
    assert all(text in hint(name, k) for k, text in enumerate(exercise.hints, 1))
    [call] = re.findall(rf'^(check\("{re.escape(name)}".*\))$', code(name.partition(".")[0]), re.M)
    space = {"check": check}
    exec(compile(solution(name), name, "exec"), space)  # in a separate namespace
    space.setdefault("who", "your name")
    verdict = eval(call, space)
    assert verdict.holds and verdict.points == 1, verdict


def zeros(value):
    try:
        return np.zeros_like(np.asarray(value, dtype=float))
    except (TypeError, ValueError):
        return 0.0


@pytest.mark.parametrize("name", FUNCTIONS)
def test_no_exercise_accepts_a_trivial_answer(name):
    """Zeros, NaN, the input itself and an empty answer are refused."""
    exercise = book.find(name, "exercises")
    like = exercise.wanted[0]
    nothing = {
        "zeros": lambda *case: zeros(like),
        "nan": lambda *case: zeros(like) * np.nan,
        **{f"input {k}": (lambda *case, k=k: case[k]) for k in range(len(exercise.inputs))},
        "the first right one": lambda *case: like,
        "empty": lambda *case: [],
    }
    for what, answer in nothing.items():
        verdict = check(name, answer)
        assert verdict.answered and not verdict.holds, f"{name} accepts {what}"
        assert verdict.case and verdict.points < 1


@pytest.mark.parametrize("name", [e for e in EXERCISES if e not in FUNCTIONS])
def test_no_trivial_value_or_test_passes(name):
    if name in CATCHES:
        for answer in (lambda p: True, lambda p: False, lambda p: 1 / 0, lambda p: "x"):
            assert not check(name, answer).holds
    else:
        for answer in (0, np.nan, np.zeros(6), {}, "answer", [], object(), {"height": 0}):
            verdict = check(name, answer, who="Ada")
            assert verdict.answered and not verdict.holds and verdict.says


def of_the_solution(name):
    """The test that the solution defines and passes to `check`."""
    lab = name.partition(".")[0]
    [call] = re.findall(rf'^check\("{re.escape(name)}", ?(?:answer=)?(\w+)\)$', code(lab), re.M)
    space = {"check": check}
    exec(compile(solution(name), name, "exec"), space)
    return space[call]


@pytest.mark.parametrize("name", CATCHES)
def test_no_test_passes_by_a_trick(name, monkeypatch):
    """The tricks are: counting calls, ignoring errors, returning nothing, never returning False."""
    right = of_the_solution(name)
    exercise = book.find(name, "exercises")
    many = len(exercise.rights) + len(exercise.wrongs) + 1
    dice = random.Random(1)
    monkeypatch.setattr(catch.random, "SystemRandom", lambda: dice)
    calls = []

    def counts(program):
        calls.append(program)
        return (len(calls) - 1) % many < len(exercise.rights)

    def passes_over(program):
        try:
            return right(program)
        except AssertionError:
            return False
        except Exception:
            return True

    def silent(program):
        right(program)

    def only_yes(program):
        if right(program) is not False:
            return True

    for answer in (counts, passes_over, silent, only_yes):
        verdict = check(name, answer)
        assert not verdict.holds and verdict.says, (name, answer)
    assert check(name, silent).mistake == "returns None"
    assert check(name, lambda program: not right(program)).mistake == "True and False swapped"
    assert check(name, right).holds


@pytest.mark.parametrize("name", PREDICTIONS)
def test_prediction_has_one_correct_option_and_each_option_has_a_reason(name):
    prediction = book.find(name, "predictions")
    question, options, right = filled(prediction)
    typed = prediction.unit is not None
    assert 3 <= len(options) <= (7 if typed else 4)
    assert question.rstrip().endswith(("?", ".", ".)"))
    assert [option.confusion is None for option in options] == [
        k == right for k in range(len(options))
    ]
    for k, option in enumerate(options):
        assert option.text and option.reason.rstrip().endswith((".", "!", "?", ".)"))
        assert k == right or (option.confusion and option.second)
    assert len({option.text for option in options}) == len(options)
    assert len({option.confusion for option in options}) == len(options)
    asked = question + "".join(option.text for option in options)
    assert not re.search(r"\bnan\b|\bjust\b|\bsimply\b", asked)
    said = asked + "".join(option.reason + option.second for option in options)
    assert not re.search(r"[{}$\\]", said), "the text contains an unfilled blank or a formula"
    for k, option in enumerate(options):
        if typed:  # the values of all options are distinguishable
            assert chosen_option(prediction, options, right, float(option.text)) == k
    assert shown(prediction.view()), "the view shows nothing"


@pytest.mark.parametrize("name", PREDICTIONS)
def test_reasons_of_predictions_do_not_appear_in_the_lab(name):
    lab = book.home(name)
    _, options, right = filled(book.find(name, "predictions"))
    open_words = []
    for cell in cells(lab):
        open_words.append("".join(cell["source"]))
        for output in cell.get("outputs", []):
            if not open_words[-1].startswith("predict("):
                open_words.append("".join(output.get("text", "")))
                open_words.append("".join(output.get("data", {}).get("text/plain", "")))
    text = " ".join(" ".join(open_words).split())
    for option in options:
        for hidden in (option.reason, option.second):
            assert not hidden or " ".join(hidden.split()) not in text


def test_endless_answer_is_reported_and_the_kernel_survives():
    notebook = nbformat.v4.new_notebook(
        cells=[
            nbformat.v4.new_code_cell(source)
            for source in (
                "from robokin.course import check, progress",
                "def blend_for(distance, corner):\n    while True:\n        try:\n"
                "            distance += 1\n        except Exception:\n            pass\n"
                'check("irb140_motion.1", blend_for)',
                "print(1 + 1)",
                "progress()",
            )
        ]
    )
    NotebookClient(notebook, timeout=PATIENCE, kernel_name="python3").execute()
    told, alive, after = (cell["outputs"][0] for cell in notebook.cells[1:])
    assert "It never ends, or" in told["data"]["text/plain"]
    assert alive["text"] == "2\n"
    assert "begun" in after["data"]["text/plain"]


@pytest.mark.parametrize("name", ["answers", "", "..", None, 7, "irb140_motion.1"])
def test_names_that_are_not_labs_are_refused(name):
    """Names of course modules are also refused, since the name comes from a file that was handed
    in.
    """
    with pytest.raises(ValueError, match="lab: wanted one of start_here, "):
        book.lab(name)
