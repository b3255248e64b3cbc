"""Exercises that teachers write: in a cell, in a file, or in a folder of labs in ROBOKIN_EXERCISES.
A teacher's errors are reported in a sentence with file and line, and the other exercises work.
"""

import os
import pathlib
import re
import time

import numpy as np
import pytest

from robokin import Quaternion, ScaraPose, Transform, course, deg, mm
from robokin.course import answers, book, check, edits, exercise, hint, predict, progress, variant
from robokin.course import solution as shown
from robokin.course.markdown import BadFile

HEAD = """\
# {number}. Reach of two links

Objective 1. How far the tip is from the base.

## Hints

1. The law of cosines.

"""
REACH = """\
## Solution

```python
import numpy as np


def reach(l1, l2, elbow):
    squares = l1**2 + l2**2
    mixed = 2 * l1 * l2 * np.cos(elbow)
    return np.sqrt(squares + mixed)
```

## Mistakes

**the stretched arm.** The elbow is not looked at.
- `2 * l1 * l2 * np.cos(elbow)` → `2 * l1 * l2`

**one link squared.** Both links are squared.
- `l2**2` → `l2`
- `l1**2` → `l1`
"""
CASES = """\
def cases(rng):
    return [(0.5, 0.3, 1.0), *(tuple(rng.uniform(0.1, 2, 3)) for _ in range(12))]
"""


def cases(rng):
    return [(0.5, 0.3, 1.0), *(tuple(rng.uniform(0.1, 2, 3)) for _ in range(12))]


def reach(l1, l2, elbow):
    return np.sqrt(l1**2 + l2**2 + 2 * l1 * l2 * np.cos(elbow))


def same(a, b):
    raise AssertionError("an exercise used a function of the notebook by accident")


form = law = same


# --- Exercises defined in a cell ------------------------------------------------------------------


def test_exercise_needs_only_a_solution_and_cases():
    """The solution can use the notebook's names, but the exercise never uses the notebook's `form`,
    `law` and `same` by accident.
    """
    mine = exercise(reach, cases)
    verdict = check(mine, lambda a, b, q: np.hypot(a + b * np.cos(q), b * np.sin(q)))
    assert (
        verdict.holds and "13 cases" in repr(verdict) and repr(verdict).startswith("reach: holds")
    )
    verdict = check(mine, lambda a, b, q: reach(a, b, q) / 3)
    assert not verdict.holds and verdict.mistake is None
    assert "l1 = 0.5, l2 = 0.3, elbow = 1" in verdict.case
    assert f"should be {reach(0.5, 0.3, 1):.6g}" in verdict.case
    assert not check(mine, ...).answered


def test_exercises_from_a_cell_do_not_count_as_progress(monkeypatch):
    monkeypatch.setattr(course, "_verdicts", {})
    assert check(exercise(reach, cases), reach).holds
    assert "Nothing" in progress()


def test_slips_are_named_without_a_list_of_mistakes():
    mine = exercise(reach, cases)
    told = {
        "degrees for radians": lambda a, b, q: reach(a, b, q * deg),
        "mm for m": lambda a, b, q: reach(a, b, q) / mm,
        "a root left out": lambda a, b, q: reach(a, b, q) ** 2,
        "sine for cosine": lambda a, b, q: np.sqrt(a * a + b * b + 2 * a * b * np.sin(q)),
        "a factor of two": lambda a, b, q: np.sqrt(a * a + b * b + a * b * np.cos(q)),
    }
    assert {name: check(mine, answer).mistake for name, answer in told.items()} == dict(
        zip(told, told, strict=True)
    )


def test_pairs_of_mistakes_are_named():
    mine = exercise(book_text(REACH), cases, REACH.partition("## Mistakes")[2])
    verdict = check(mine, lambda a, b, q: np.sqrt(a + b**2 + 2 * a * b))
    assert verdict.mistake == "the stretched arm, and one link squared"
    assert verdict.says == ("The elbow is not looked at. And: Both links are squared.",)
    verdict = check(mine, lambda a, b, q: np.sqrt(a**2 + b**2 + 2 * a * b) / mm)
    assert verdict.mistake == "the stretched arm, and mm for m"


def test_slip_that_undoes_a_mistake_is_not_named():
    text = "def kept(x):\n    x = 1.0 * x\n    return x if x < 5 else float('nan')\n"
    mistakes = "**mm for m.** It is in mm.\n- `1.0 * x` → `1e-3 * x`"
    mine = exercise(text, lambda rng: [(x,) for x in rng.uniform(0, 10, 20)], mistakes)
    assert check(mine, lambda x: x / 1000 if x < 5000 else np.nan).mistake == "mm for m"
    verdict = check(mine, lambda x: x)  # this answer does not have the limit at 5
    assert not verdict.holds and verdict.mistake is None


def book_text(markdown):
    return re.search("```python\n(.*?)```", markdown, re.S)[1]


TURN = Quaternion.from_angle_axis(0.3, (0, 0, 1))
# For each kind of result: the result of a solution, an equal answer, a wrong answer, and an answer
# of another type.
KINDS = {
    "a number": ("2 * x", lambda x: 2 * x + 1e-9, lambda x: 3 * x, lambda x: [x, x]),
    "a whole number": ("round(x)", lambda x: float(round(x)), lambda x: x, lambda x: f"{x:.0f}"),
    "an array": (
        "np.array([x, 1, np.nan])",
        lambda x: [x, 1, np.nan],
        lambda x: [x, 2, np.nan],
        lambda x: [x, 1],
    ),
    "truth": ("x > 1", lambda x: np.float64(x) > 1, lambda x: x > 2, lambda x: 1.0),
    "an array of truth": (
        "np.array([x, -x]) > 1",
        lambda x: [x > 1, x < -1],
        lambda x: [x > 1, x > 1],
        lambda x: [x, -x],
    ),
    "text": (
        "'up' if x > 1 else 'down'",
        lambda x: "down" if x <= 1 else "up",
        lambda x: "up" if x > 2 else "down",
        lambda x: x > 1,
    ),
    "a pose": (
        "Transform(TURN, (x, 0, 0))",
        lambda x: Transform(TURN, (x + 1e-9, 0, 0)),
        lambda x: Transform(TURN, (0, x, 0)),
        lambda x: (x, 0, 0),
    ),
    "a rotation": (
        "TURN @ Quaternion.from_angle_axis(x, (1, 0, 0))",
        lambda x: TURN @ Quaternion.from_angle_axis(-x, (-1, 0, 0)),
        lambda x: TURN @ Quaternion.from_angle_axis(x, (0, 1, 0)),
        lambda x: Transform(TURN, (x, 0, 0)),
    ),
    "a pose of a SCARA": (
        "ScaraPose((x, 0, 0), x)",
        lambda x: ScaraPose((x, 1e-9, 0), x),
        lambda x: ScaraPose((x, 0, 0), 2 * x),
        lambda x: (x, 0, 0, x),
    ),
    "a dict": (
        "{'row': np.array([x, x]), 'up': x > 1}",
        lambda x: {"up": x > 1, "row": [x, x + 1e-9]},
        lambda x: {"up": x > 1, "row": [x, 2 * x]},
        lambda x: {"up": x > 1},
    ),
}


@pytest.mark.parametrize("kind", KINDS)
def test_functions_form_law_and_same_have_defaults(kind):
    program, same, wrong, other = KINDS[kind]
    imports = "import numpy as np\nfrom robokin import Quaternion, ScaraPose, Transform\n"
    text = f"{imports}\nTURN = Quaternion.from_angle_axis(0.3, (0, 0, 1))\n\n\ndef mine(x):\n"
    mine = exercise(f"{text}    return {program}", lambda rng: [(k / 4,) for k in range(12)])
    assert check(mine, same).holds
    verdict = check(mine, wrong)
    assert not verdict.holds and "should be" in verdict.case and "of shape ()" not in verdict.case
    verdict = check(mine, other)
    assert verdict.mistake == "another kind or shape" and "wanted" in verdict.case


@pytest.mark.parametrize(
    "given",
    [TURN, (TURN, 1.0), {"a": np.ones(3), "b": "text"}, [Transform(TURN, (1, 2, 3))], np.nan, None],
)
def test_unchanged_inputs_are_not_reported(given):
    mine = exercise("def mine(x, y):\n    return y", lambda rng: [(given, k) for k in range(3)])
    assert check(mine, lambda x, y: y).holds


class Gauge:
    """A class without __eq__: instances with equal values are not equal."""

    def __init__(self, value):
        self.value = value


def test_changed_inputs_of_any_type_are_reported():
    for given in (Gauge(2.0), {"value": np.ones(3)}, [Gauge(np.ones(3))]):
        mine = exercise("def mine(x):\n    return 1", lambda rng, given=given: [(given,)])
        assert check(mine, lambda x: 1).holds

        def spoils(x):
            inner = x[0] if isinstance(x, list) else x
            (inner if isinstance(inner, dict) else vars(inner))["value"] *= 2
            return 1

        assert check(mine, spoils).mistake == "changes its input"


@pytest.mark.parametrize(
    ("solution", "cases", "says"),
    [
        ("x = 1\n", cases, "solution, line 1: wanted a program that defines a function"),
        ("def f(x):\n    return (x\n", cases, "solution, line 2: not Python: '(' was never closed"),
        (3, cases, "solution: wanted a function or its source code, got 3"),
        (len, cases, "solution: wanted a function or its source code"),
        ("def f(x):\n    return x", None, "exercise f: wanted a function cases(rng)"),
        ("def f(x):\n    return x", [(1,)], "exercise f: wanted a function cases(rng)"),
        (
            "import nonsense_\n\n\ndef f(x):\n    return x",
            cases,
            "exercise f, line 2: the solution:",
        ),
        (pathlib.Path("nowhere.md"), None, "nowhere.md: No such file"),
        ("nowhere.md", None, "nowhere.md: No such file"),
    ],
)
def test_invalid_exercises_are_refused_at_once(solution, cases, says):
    with pytest.raises(ValueError, match=re.escape(says)) as error:
        exercise(solution, cases)
    assert len(str(error.value).splitlines()) == 1


# --- Exercises read from files --------------------------------------------------------------------


def write(folder, **files):
    """Write files of a lab: reach_md="...", reach_py="..."."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        content = text if isinstance(text, bytes) else text.encode()
        (folder / re.sub("_(md|py)$", r".\1", name)).write_bytes(content)
    return folder


@pytest.fixture
def place(tmp_path, monkeypatch):
    """An empty folder for labs, named in ROBOKIN_EXERCISES."""
    monkeypatch.setenv(book.ELSEWHERE, str(tmp_path))
    monkeypatch.setattr(course, "_verdicts", {})
    return tmp_path


def test_exercise_files_are_read_again_after_a_change(tmp_path):
    """The files have a byte-order mark and Windows line endings."""
    text = f"\ufeff{HEAD.format(number=1)}{REACH}".replace("\n", "\r\n")
    write(tmp_path, reach_md=text, reach_py="from .more import cases\n__all__ = ['cases']\n")
    write(tmp_path, more_py=CASES)
    mine = exercise(tmp_path / "reach.md")
    verdict = check(mine, reach)
    assert verdict.holds and "13 cases" in repr(verdict) and "Reach of two links" in repr(verdict)
    assert check(mine, lambda a, b, q: a + b).mistake == "the stretched arm"
    write(tmp_path, more_py=CASES.replace("range(12)", "range(17)"))
    assert "18 cases" in repr(check(exercise(str(tmp_path / "reach.md")), reach))


def test_folder_of_a_teachers_labs_is_found(place):
    write(
        place / "two_links",
        reach_md=HEAD.format(number=2) + REACH,
        reach_py=CASES,
        tenth_md=HEAD.format(number=10) + REACH,
        tenth_py=CASES,
        objectives_md="# Objectives\n\n1. tell how far an arm reaches\n",
        predictions_md=PREDICTED,
        predictions_py="def p1():\n    return {'right': 'half', 'length': 0.5}\n",
    )
    assert [*book.labs()] == [*book.numbered(book.OURS), "two_links"]
    assert [*book.lab("two_links").exercises] == ["2", "10"] and not book.lab("two_links").broken
    assert check("two_links.2", reach).holds
    assert "law of cosines" in hint("two_links.2") and "def reach" in shown("two_links.2")
    assert "Right." in repr(predict("two_links.p1", "a"))
    assert "not 0.5 m" in repr(predict("two_links.p1", "b"))
    assert "begun    two_links.2, two_links.10: tell how far" in progress()
    with pytest.raises(ValueError, match="no numbers that depend on the student"):
        variant("two_links", "Ada")


def test_labs_of_a_teacher_cannot_replace_ours(place):
    write(place / "scara_motion", reach_md=HEAD.format(number=1) + REACH, reach_py=CASES)
    assert book.lab("scara_motion").folder == book.OURS / "scara_motion"
    assert book.find("scara_motion.1", "exercises").task != "How far the tip is from the base."
    [told] = book.lab("scara_motion").broken.values()
    assert told == (
        f"{place / 'scara_motion'}: not read, since {book.OURS / 'scara_motion'} has the same name"
    )


def test_progress_lists_exercises_without_an_objective(place):
    write(place / "two_links", reach_md=HEAD.format(number=1) + REACH, reach_py=CASES)
    assert "not yet  two_links.1: Reach of two links" in progress("two_links")


def test_labs_without_a_notebook_come_last(tmp_path, monkeypatch):
    """The labs are found as in an installation that points to a clone."""
    for name in ("apple", "pear", "zebra"):
        write(tmp_path / "exercises" / name)
    for name in ("00_zebra.ipynb", "01_pear.ipynb", "02_gone.ipynb"):
        (tmp_path / name).touch()
    monkeypatch.setattr(book, "OURS", tmp_path / "no_clone")
    monkeypatch.setenv(book.ELSEWHERE, os.pathsep.join(["", str(tmp_path / "exercises"), "gone"]))
    assert [*book.labs()] == ["zebra", "pear", "apple"]


def test_installation_without_a_clone_says_what_to_do(tmp_path, monkeypatch):
    monkeypatch.setattr(book, "OURS", tmp_path / "exercises")
    monkeypatch.delenv(book.ELSEWHERE, raising=False)
    says = "no labs found. Install robokin from a clone of its repository, or set ROBOKIN_EXERCISES"
    assert says in repr(check("scara_motion.1", 3)) and not check("scara_motion.1", 3).answered
    calls = (hint, shown, predict, progress, lambda name: variant(name, "Ada"))
    for call in calls:
        with pytest.raises(ValueError, match=says):
            call("scara_motion.1")
    assert check(exercise(reach, cases), reach).holds


@pytest.mark.parametrize("name", [None, 3, ["scara_motion"], {}, "", "scara_motion.1"])
def test_unknown_lab_is_refused(name):
    with pytest.raises(ValueError, match="lab: wanted one of"):
        book.lab(name)


# --- Errors in teacher files ----------------------------------------------------------------

PREDICTED = """\
# Predictions

## p1

How long is it?

- `half` **0.5 m.** So long.
- `whole` **1 m.** It is not {length} m. *twice as long:* a second case.
"""


RIGHTS = """\
## Solution

```python
def my_test(program):
    return program(3) == 6 and program(2) == 4
```

## Correct programs

**plain.**
```python
def twice(x):
    return 2 * x
```

**by sums.** It adds.
```python
def twice(x):
    return x + x
```

## Mistakes

**one more.** It adds one.
- `2 * x` → `2 * x + 1`

**another sum.** It is no sum.
- `x + x` → `x * x`
- `return x` → `return 1`
"""


def altered(*changes, text=REACH):
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    return HEAD.format(number=1) + text


# For each fault: the Markdown, the Python, and the message, which contains the file and line (with
# ".md" or ".py") and the reason.
BROKEN = {
    "no head": ("Reach\n", CASES, ".md, line 1: wanted '# 1. TITLE'"),
    "no solution": (
        HEAD.format(number=1) + "## Mistakes\n",
        CASES,
        ".md: wanted a section 'Solution' with a program",
    ),
    "a solution without a program": (
        HEAD.format(number=1) + "## Solution\n\nSee above.\n",
        CASES,
        ".md, line 9: wanted a section 'Solution' with a program",
    ),
    "a solution that is not Python": (
        altered(("np.cos(elbow)\n", "np.cos(elbow\n")),
        CASES,
        ".md, line 17: not Python: '(' was never closed",
    ),
    "a solution without a function": (
        altered(("def reach(l1, l2, elbow):", "if True:"), ("return ", "x = ")),
        CASES,
        ".md, line 12: wanted a program that defines a function",
    ),
    "a solution that imports a missing module": (
        altered(("import numpy as np", "import numpy_ as np")),
        CASES,
        ".md, line 12: the solution: ModuleNotFoundError: No module named 'numpy_'",
    ),
    "a mistake without a name": (
        altered(("**the stretched arm.**", "**the stretched arm.")),
        CASES,
        ".md, line 23: wanted '**name.** A sentence.', got '**the stretched arm.",
    ),
    "an edit without an arrow": (
        altered(("`l2**2` → `l2`", "`l2**2` = `l2`")),
        CASES,
        ".md, line 27: wanted `right` → `wrong`, got '`l2**2` = `l2`'",
    ),
    "an edit whose piece is missing": (
        altered(("`l2**2` →", "`l3**2` →")),
        CASES,
        ".md, line 27: 'one link squared': `l3**2` occurs 0 times in the solution, wanted once",
    ),
    "an edit whose piece occurs twice": (
        altered(("`l2**2` →", "`**2` →")),
        CASES,
        ".md, line 27: 'one link squared': `**2` occurs 2 times in the solution, wanted once",
    ),
    "an edit whose pieces overlap": (
        altered(("`l2**2` → `l2`", "`l2**2` → `l2`, `+ l2` → `- l2`")),
        CASES,
        ".md, line 27: 'one link squared': its pieces overlap",
    ),
    "an edit whose result is not Python": (
        altered(("`l2**2` → `l2`", "`l2**2` → `l2 **`")),
        CASES,
        ".md, line 27: 'one link squared': not Python: invalid syntax",
    ),
    "a wrong program with another name": (
        altered(("- `l2**2` → `l2`\n", "```python\ndef reaches(a, b, c):\n    return a\n```\n")),
        CASES,
        ".md, line 28: 'one link squared': the program does not define reach",
    ),
    "not UTF-8": (
        (HEAD.format(number=1) + REACH).encode("utf-16-le"),
        CASES,
        ".md, line 24: this is not UTF-8",
    ),
    "no Python file": (altered(), None, ".md: wanted a function cases(rng) in its Python file"),
    "no cases": (altered(), "x = 1\n", ".md: wanted a function cases(rng) in its Python file"),
    "a Python file that is not Python": (
        altered(),
        f"{CASES}\nx = (\n",
        ".py, line 4: SyntaxError: '(' was never closed",
    ),
    "a Python file that raises": (
        altered(),
        f"{CASES}\n\nx = 1 / 0\n",
        ".py, line 5: ZeroDivisionError: division by zero",
    ),
    "a Python file that is not UTF-8": (altered(), CASES.encode() + b"'\xe9'\n", ".py"),
    "an exercise with the same number": (
        altered(),
        CASES,
        ".md, line 1: 1 is also the number of a.md",
    ),
    "right programs without a program": (
        altered(text=f"{REACH}\n## Correct programs\n\n**plain.** None.\n"),
        CASES,
        ".md, line 30: wanted a section 'Correct programs' with a program",
    ),
    "right programs without a name": (
        altered(text=f"{REACH}\n## Correct programs\n\n```python\ndef f(x):\n    return x\n```\n"),
        CASES,
        ".md, line 32: wanted '**what is special.**' above the program",
    ),
    "a right program that is not Python": (
        altered(("return x + x", "return x +"), text=RIGHTS),
        None,
        ".md, line 26: 'by sums': not Python: invalid syntax",
    ),
    "a right program with another name": (
        altered(("twice(x):\n    return x + x", "double(x):\n    return x + x"), text=RIGHTS),
        None,
        ".md, line 26: 'by sums': the program does not define twice",
    ),
    "a value without its form": (
        altered(),
        "def faults(x, given):\n    return []\n",
        ".md: wanted form and COUNT in its Python file",
    ),
}


@pytest.mark.parametrize("what", BROKEN)
def test_faults_in_teacher_files_are_reported_and_other_exercises_work(what, place):
    text, code, says = BROKEN[what]
    write(place / "mine", z_md=text, zz_md=HEAD.format(number=3) + REACH, zz_py=CASES)
    if code is not None:
        write(place / "mine", z_py=code)
    number = 1 if "number" in what else 2
    write(place / "mine", a_md=HEAD.format(number=number) + REACH, a_py=CASES)
    lab = book.lab("mine")
    assert [*lab.exercises] == [f"{number}", "3"] and [*lab.broken] == ["z.md"]
    told = lab.broken["z.md"]
    assert told.startswith(f"{place / 'mine' / 'z'}{says}") and len(told.splitlines()) == 1
    assert check("mine.3", reach).holds
    if number == 2:
        verdict = check("mine.1", reach)
        assert not verdict.answered and told in repr(verdict)
        with pytest.raises(ValueError, match=re.escape(told)):
            hint("mine.1")


# For each fault: the Python file, and the message about its cases, which are made when they are
# needed.
UNDRAWN = {
    "cases that raise": ("    return 1 / 0\n", "It raises ZeroDivisionError: division by zero."),
    "cases that return nothing": ("    list(rng.uniform(0, 1, 3))\n", "It raises TypeError"),
    "no cases at all": ("    return []\n", "wanted tuples of l1, l2, elbow, got []"),
    "cases of another kind": ("    return [1, 2]\n", "wanted tuples of l1, l2, elbow, got [1, 2]"),
    "cases with too few inputs": (
        "    return [(1, 2)]\n",
        "wanted tuples of l1, l2, elbow, got [(1, 2)]",
    ),
    "cases that never end": ("    while True:\n        pass\n", "It never ends"),
}


@pytest.mark.parametrize("what", UNDRAWN)
def test_errors_while_making_cases_are_reported(what, place, monkeypatch):
    monkeypatch.setattr(answers, "SECONDS", 0.2)
    code, says = UNDRAWN[what]
    write(
        place / "mine",
        a_md=HEAD.format(number=1) + REACH,
        a_py=f"# cases\n\n\ndef cases(rng):\n{code}",
        b_md=HEAD.format(number=2) + REACH,
        b_py=CASES,
    )
    begin = time.process_time()
    verdict = check("mine.1", reach)
    assert time.process_time() - begin < 2
    assert not verdict.holds and verdict.points == 0
    [line] = verdict.says
    assert line.startswith(
        f"This cannot be judged: {place / 'mine' / 'a.py'}, line 4: cases: {says}"
    )
    assert "of its cell" not in line
    assert check("mine.2", reach).holds and hint("mine.1")


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("np.sqrt(squares + mixed)", "np.nothing(mixed)"), "It raises AttributeError"),
        (("    squares = l1", "    while True:\n        pass\n    squares = l1"), "It never ends"),
        (("return np.sqrt(squares + mixed)", "print(mixed)"), "It prints"),
    ],
)
def test_solution_without_a_result_is_reported(change, says, place, monkeypatch):
    monkeypatch.setattr(answers, "SECONDS", 0.2)
    text = altered(change).partition("## Mistakes")[0]
    write(place / "mine", a_md=text, a_py=CASES)
    verdict = check("mine.1", reach)
    assert not verdict.holds
    [line] = verdict.says
    where = f"{place / 'mine' / 'a.md'}, line 12: the solution, for l1 = 0.5, l2 = 0.3, elbow = 1: "
    assert line.startswith(f"This cannot be judged: {where}") and says in line


def test_exercise_that_asks_for_a_test_is_read_from_a_file(place):
    write(place / "mine", twice_md=HEAD.format(number=1) + RIGHTS)
    assert check("mine.1", lambda program: program(3) == 6 and program(2) == 4).holds
    verdict = check("mine.1", lambda program: program(2) == 4)
    assert verdict.mistake == "accepts: another sum"
    refused = check("mine.1", lambda program: program(2) == 4 and program.__code__.co_consts[1:])
    assert refused.mistake == "another kind or shape"


EMPTY = """\
def f(x, low):
    if low:
        x = x + 1
        x = x * 3
    return x
"""
NOTHING = """\
**not raised.** One.
- `x = x + 1` → nothing

**not tripled.** Two.
- `x = x * 3` → nothing
"""


def test_pairs_of_mistakes_that_cannot_be_combined_are_ignored():
    mine = exercise(EMPTY, lambda rng: [(k / 2, k % 3 > 0) for k in range(9)], NOTHING)
    assert check(mine, lambda x, low: x * 3 if low else x).mistake == "not raised"
    verdict = check(mine, lambda x, low: x + 7 if low else x)
    assert not verdict.holds and verdict.case and "cannot be judged" not in repr(verdict)


def test_incomparable_results_count_as_different():
    mine = exercise("def f(n):\n    return n", lambda rng: [(n,) for n in range(9)])
    mine.alike = lambda a, b: 1 / 0
    mine.code["form"] = lambda result, case: result
    mine.code["law"] = lambda case, yours, wanted: "should be another"
    verdict = check(mine, lambda n: n + 1)
    assert not verdict.holds and "cannot be judged" not in repr(verdict)


def test_all_edits_that_no_longer_match_a_changed_solution_are_reported(place):
    """In an exercise that asks for a test, an edit is reported if it matches none of the correct
    programs.
    """
    text = altered(("l1**2 + l2**2\n", "l1 * l1 + l2 * l2\n"))
    write(place / "mine", reach_md=text, reach_py=CASES)
    rights = RIGHTS.replace("return x + x", "return 2 * x")
    write(place / "mine", twice_md=HEAD.format(number=2) + rights)
    lab = book.lab("mine")
    assert not lab.exercises
    for name, line, mistake, pieces in (
        ("reach.md", 27, "one link squared", ("l2**2", "l1**2")),
        ("twice.md", 36, "another sum", ("x + x", "return x")),
    ):
        assert lab.broken[name].split("\n") == [
            f"{place / 'mine' / name}, line {line + k}: {mistake!r}: `{piece}` occurs 0 times in "
            "the solution, wanted once"
            for k, piece in enumerate(pieces)
        ]


def test_empty_folder_is_reported(place):
    write(place / "mine")
    assert "mine has no exercises, got 'mine.1'" in repr(check("mine.1", 3))
    with pytest.raises(ValueError, match="mine has no predictions"):
        predict("mine.p1")
    with pytest.raises(ValueError, match="a folder|directory|denied"):
        exercise(place / "mine.md" if (place / "mine").rename(place / "mine.md") else None)


OPTION = "- `whole` **1 m.** It is not {length} m. *twice as long:* a second case."
# For each fault: predictions.md, predictions.py and the message.
UNPREDICTED = {
    "no facts": (PREDICTED, None, "line 3: no facts: wanted a function p1() in its Python file"),
    "other facts": (PREDICTED, "def p2():\n    pass\n", "line 3: no facts: wanted a function p1()"),
    "no confusion": (
        PREDICTED.replace(" *twice as long:* a second case.", ""),
        "",
        "line 3: p1: wanted answers with different names, all but one with a confusion",
    ),
    "two equal names": (
        PREDICTED.replace("`whole`", "`half`"),
        "",
        "line 3: p1: wanted answers with different names, all but one with a confusion",
    ),
    "one answer": (PREDICTED.replace(OPTION, ""), "", "line 3: p1: wanted answers with different"),
    "an answer in the wrong form": (
        PREDICTED.replace("**1 m.**", "1 m."),
        "",
        "line 3: wanted '- `name` **An answer.** Why. *The confusion:* a case'",
    ),
    "another heading": (PREDICTED.replace("## p1", "## P1"), "", "line 3: wanted '## p1' or"),
}
FACTS = "def p1():\n    return {'right': 'half', 'length': 1}\n\n\np3 = p1\n"


@pytest.mark.parametrize("what", UNPREDICTED)
def test_invalid_prediction_is_reported_and_other_predictions_work(what, place):
    text, code, says = UNPREDICTED[what]
    third = PREDICTED.partition("\n## p1")[2]
    write(place / "mine", predictions_md=f"{text}\n## p3\n{third}", objectives_md="1. one\n")
    if code is not None:
        write(place / "mine", predictions_py=code.replace("p2():", "p3():") or FACTS)
    told = f"{place / 'mine' / 'predictions.md'}, {says}"
    with pytest.raises(ValueError, match=re.escape(told)):
        predict("mine.p1")
    assert len(book.lab("mine").broken) == (2 if code is None else 1)
    assert [*book.lab("mine").predictions] == ([] if code is None else ["p3"])


def test_duplicate_prediction_or_missing_correct_option_is_reported(place):
    write(
        place / "mine",
        predictions_md=PREDICTED + PREDICTED.replace("# Predictions\n", ""),
        predictions_py=FACTS.replace("'half'", "'third'"),
        a_md=HEAD.format(number=1) + REACH,
        a_py=CASES,
    )
    lab = book.lab("mine")
    lab.read()
    file = place / "mine" / "predictions.md"
    assert [*lab.broken.values()] == [f"{file}, line 10: p1 occurs twice"]
    with pytest.raises(BadFile, match=r"line 3: p1\(\): wanted 'right' to be one of half, whole"):
        predict("mine.p1")


def test_prediction_text_with_a_missing_value_is_reported(place):
    facts = FACTS.replace("length", "size")
    write(place / "mine", predictions_md=PREDICTED, predictions_py=facts)
    with pytest.raises(BadFile, match="line 3: p1 cannot be filled: KeyError: 'length'"):
        predict("mine.p1")


def test_broken_views_are_reported_when_drawn(place):
    pictures = "def p1_view():\n    return 'half'\n"
    write(place / "mine", predictions_md=PREDICTED, predictions_py=FACTS, pictures_py=pictures)
    write(place / "other", predictions_md=PREDICTED, predictions_py=FACTS, pictures_py="x = 1 / 0")
    assert predict("mine.p1").view() == "half" and "p>half" in predict("mine.p1").html
    assert "0.5 m" in repr(predict("other.p1"))
    told = f"{place / 'other' / 'pictures.py'}, line 1: ZeroDivisionError: division by zero"
    with pytest.raises(BadFile, match=re.escape(told)):
        _ = predict("other.p1").html


@pytest.mark.parametrize("name", ["predictions.py", "objectives.md"])
def test_broken_file_does_not_affect_other_exercises(name, place):
    write(
        place / "mine",
        a_md=HEAD.format(number=1) + REACH,
        a_py=CASES,
        predictions_md=PREDICTED,
        predictions_py=FACTS,
        objectives_md="1. one\n",
    )
    (place / "mine" / name).write_bytes(b"x = 1\n\xff\n")
    lab = book.lab("mine")
    lab.read()
    [told] = lab.broken.values()
    assert told.startswith(f"{place / 'mine' / name}") and len(told.splitlines()) == 1
    assert check("mine.1", reach).holds


def test_slips_that_never_end_do_not_prevent_a_verdict():
    text = """\
def halvings(x, least):
    count = 0
    while x > least:
        x = x / 2
        count = count + 1
    return count
"""
    mine = exercise(text, lambda rng: [(1.0, 0.1), (9.0, 0.3), (2.0, 0.001)])
    assert not check(mine, lambda x, least: 4).holds


def test_program_of_a_teacher_that_never_ends_is_reported(monkeypatch):
    monkeypatch.setattr(answers, "SECONDS", 0.3)
    text = """\
def count(n):
    k = 0
    while k < n:
        k = k + 1
    return k
"""
    mistakes = "**one more.** It adds one.\n- `k + 1` → `k + 2`\n\n**stands.**\n- `k + 1` → `k + 0`"
    mine = exercise(text, lambda rng: [(n,) for n in range(1, 20)], mistakes)
    assert check(mine, lambda n: n + n % 2).mistake == "one more"
    verdict = check(mine, lambda n: n // 3)
    told = "(These mistakes of the exercise never end: 'stands'.)"
    assert verdict.mistake is None and verdict.says[0].endswith(told)


# --- Wrong programs -------------------------------------------------------------------------------

INPLACE = """\
def sorted_out(values, low):
    kept = list(values)
    for k in range(len(kept)):
        kept[k] = max(kept[k], low)
    first = kept[0]
    kept.append(first)
    return [*kept, first]
"""
LATER = """\
def scaled(x):
    half = lambda y: y / share
    share = 2
    return half(x) + x
"""
TWO_ENDS = """\
def clipped(values, low):
    values = values.copy()
    if low < 0:
        return values
    values[0] = low
    return values
"""
CHANGES = [
    (
        INPLACE,
        ([3.0, 1.0], 2),
        {"max(": "min(", "kept[0]": "kept[1]", "append(first)": "reverse()"},
    ),
    (LATER, (3.0,), {"share = 2": "share = 4", "half(x) + x": "half(x) - x"}),
    (TWO_ENDS, (np.ones(3), 2.0), {"values.copy()": "values", "= low": "= 2 * low"}),
]


@pytest.mark.parametrize(("solution", "case", "changes"), CHANGES)
def test_edited_programs_match_their_texts_and_have_no_side_effects(solution, case, changes):
    """The edits are applied in any order, alone and in pairs, to pieces that are compiled only
    once.
    """
    steps = edits.Steps(solution, {})
    own = []
    for old, new in changes.items():
        at = solution.index(old)
        own.append(edits.Variant(old, "", ((at, at + len(old), new),)))
    variants = [*own, *edits.pairs(own)]
    assert len(variants) >= len(own) + 1
    before = repr(case)
    for each in [*variants, *reversed(variants)]:
        copied = tuple(x.copy() if isinstance(x, (list, np.ndarray)) else x for x in case)
        wanted = edits.run(each.text(solution))[steps.name](*copied)
        assert repr(steps.program(each)(*case)) == repr(wanted), each.name
        assert repr(case) == before
