"""The course engine: verdicts on answers of every kind, for exercises that are defined here, and
the isolation of answers. The exercises of each lab have their own test file.
"""

import _thread
import copy
import random
import re
import signal
import subprocess
import sys
import time
import types

import numpy as np
import pytest
from conftest import until
from hypothesis import given, settings
from hypothesis import strategies as st

from robokin import Quaternion, ScaraPose, Transform, course, deg, mm
from robokin.course import (
    answers,
    book,
    catch,
    check,
    edits,
    hint,
    key,
    markdown,
    page,
    progress,
    solution,
    variant,
)
from robokin.course.slips import INPUTS, RESULTS
from robokin.units import wrapped

TIP = Transform(Quaternion.from_angle_axis(0.4, (0.6, 0, 0.8)), (0.1, 0.2, 0.3))
WORDS = """\
# {number}. {title}

Objective {number}. {title}

## Hints

1. first
2. second
"""
POSE = """
## Solution

```python
from robokin import Quaternion, Transform

TIP = Transform(Quaternion.from_angle_axis(0.4, (0.6, 0, 0.8)), (0.1, 0.2, 0.3))


def pose(height, angle):
    turn = Quaternion.from_angle_axis(angle, (0, 0, 1))
    place = (0.2, 0.1, height)
    return Transform(turn, place) @ TIP
```

## Mistakes

**no tip.** The tip is left out.
- ` @ TIP` → nothing

**fixed height.**
- `0.1, height` → `0.1, 0.5`

**fixed height, said otherwise.**
- `(0.2, 0.1, height)` → `(0.2, 0.1, 0.5)`
"""
HALF = """
## Solution

```python
half = 0.5
```
"""
STEEP = """
## Promise

It doubles.

## Correct programs

**plain.**
```python
def twice(x):
    return 2 * x
```

**by sums.**
```python
def twice(x):
    return x + x
```

## Solution

```python
def my_test(program):
    return program(3) == 6 and program(2) == 4
```

## Mistakes

**one more.** It adds one.
- `2 * x` → `2 * x + 1`

**square.** It squares.
- `x + x` → `x * x`
"""


def made(text, number="1", title="a pose", **code):
    """An exercise from a teacher's files: `text` is the Markdown below the hints, and `code` is the
    Python file.
    """
    words = WORDS.format(number=number, title=title)
    return book.made(markdown.exercise("made.md", words + text), code)


def function(program, cases, mistakes="", **code):
    """An exercise that asks for a function, with its correct program."""
    parts = f"\n## Solution\n\n```python\n{program}\n```\n\n## Mistakes\n\n{mistakes}"
    return made(parts, cases=cases, **code)


def angles(rng):
    small = [(0.5, 1.0), (2.5, 0.3)]
    return small + [tuple(map(float, rng.uniform(-3, 3, 2))) for _ in range(10)]


def formed(result, case):
    if not isinstance(result, Transform):
        raise ValueError(f"wanted a Transform, got {type(result).__name__}")
    return result


def near(a, b):
    return np.allclose(a.as_matrix(), b.as_matrix(), rtol=0, atol=1e-9)


def law(case, yours, wanted):
    return None if near(yours, wanted) else f"should be at {wanted.translation}"


KEPT = {"cases": angles, "form": formed, "law": law, "same": near}


def halves():
    return made(
        HALF,
        number="2",
        title="a half",
        form=lambda answer, given: float(answer),
        faults=lambda x, given: [] if 0.3 < x <= given else [("too long", f"{x} is too long")],
        COUNT=1,
        given=lambda who: 0.5,
    )


@pytest.fixture(autouse=True)
def lab(monkeypatch):
    """A lab with one exercise of each kind."""
    exercises = {
        "1": made(POSE, **KEPT),
        "2": halves(),
        "3": made(STEEP, number="3", title="a test"),
    }
    lab = types.SimpleNamespace(
        objectives=("turn", "choose", "catch"),
        exercises=exercises,
        predictions={},
        moved={},
        broken={},
        given=lambda who: None,
        read=lambda: None,
    )
    monkeypatch.setattr(book, "labs", lambda: {"made": lab})
    monkeypatch.setattr(course, "_verdicts", {})
    return lab


def right(height, angle):
    turn = Transform(Quaternion.from_angle_axis(angle, (0, 0, 1)), (0.2, 0.1, height))
    return turn @ TIP


def test_correct_answer_passes_and_reports_the_number_of_cases():
    verdict = check("made.1", right)
    assert verdict.holds and verdict and verdict.answered and verdict.points == 1
    assert verdict.mistake is None and verdict.case is None
    assert "12 cases" in repr(verdict) and "made.1: holds." in repr(verdict)


def stub(height, angle):
    """A stub with a docstring."""
    ...


def raises(height, angle):
    raise NotImplementedError


@pytest.mark.parametrize("answer", [stub, raises, ..., None, lambda h, a: ...])
def test_missing_answer_gets_a_friendly_message(answer):
    verdict = check("made.1", answer)
    assert not verdict.answered and not verdict.holds and verdict.mistake is None
    assert "not answered yet" in repr(verdict)


def half_written(height, angle):
    if height > 2:
        raise NotImplementedError
    return right(height, angle)


def test_partly_written_answer_is_judged(lab):
    """The missing part may be anywhere, even in the last case."""
    verdict = check("made.1", half_written)
    assert verdict.answered and not verdict.holds and verdict.mistake == "raises an error"
    assert "NotImplementedError" in verdict.case and "height = 2.5" in verdict.case
    lab.exercises["4"] = made(POSE, **KEPT | {"cases": lambda rng: angles(rng)[::-1]})

    def but_the_last(height, angle):
        if height == 0.5:
            raise NotImplementedError
        return right(height, angle)

    verdict = check("made.4", but_the_last)
    assert verdict.answered and not verdict.holds and "height = 0.5" in verdict.case


def prints(height, angle):
    print("the pose is", right(height, angle))


def loops(height, angle):
    while True:
        height += 1


def stubborn(height, angle):
    while True:
        try:
            height += 1
        except:  # noqa: E722
            pass


def late(height, angle):
    while angle < 0:
        height += 1
    return right(height, angle)


TROUBLE = {
    "raises an error": (lambda h, a: h / 0, "ZeroDivisionError"),
    "returns None": (lambda h, a: None if h else 1, "return missing"),
    "prints instead of returning": (prints, "the pose is"),
    "another kind or shape": (lambda h, a: [h, a], "wanted a Transform, got list"),
}


@pytest.mark.parametrize("name", TROUBLE)
def test_errors_in_an_answer_are_named(name, capsys):
    answer, words = TROUBLE[name]
    verdict = check("made.1", answer)
    assert verdict.mistake == name and not verdict.holds and words in repr(verdict)
    assert "height = 0.5, angle = 1" in verdict.case
    assert capsys.readouterr().out == ""


SHIFT = Transform(translation=(0.1, 0.2, 0.3))
ERRORS = {
    "`pose.translation` is its position": [
        lambda h, a: 2 * SHIFT,
        lambda h, a: SHIFT - SHIFT,
        lambda h, a: np.ones(3) - SHIFT,
        lambda h, a: SHIFT + np.ones(3),
        lambda h, a: np.linalg.norm(SHIFT),
        lambda h, a: -SHIFT,
        lambda h, a: float(SHIFT),
    ],
    "no `return`": [lambda h, a: h + print(), lambda h, a: None < h],
    "`np.array(...)`": [lambda h, a: [h, a] - [a, h], lambda h, a: h * [h], lambda h, a: -(h, a)],
    "`a[0]`": [lambda h, a: SHIFT.translation(0)],
    None: [
        lambda h, a: h / 0,
        lambda h, a: np.ones(3) @ SHIFT,  # the order is wrong, not the kind
        lambda h, a: SHIFT(h),
        lambda h, a: SHIFT.position,
        lambda h, a: h + "a",
    ],
}


@pytest.mark.parametrize("words", ERRORS)
def test_a_well_known_error_has_a_sentence_on_what_to_write(words):
    for answer in ERRORS[words]:
        line = check("made.1", answer).case.splitlines()[-1].strip()
        advice = re.fullmatch(r"It raises .*? \(line \d+ of its cell\)\.(.*)", line)[1]
        if words is None:
            assert advice == ""
        else:
            assert advice.startswith(" ") and words in advice and advice.endswith((".", "?"))


@pytest.mark.parametrize("answer", [loops, stubborn, late])
def test_endless_loop_is_reported_when_its_cpu_time_is_up(answer, monkeypatch):
    assert answers.SECONDS == 4
    monkeypatch.setattr(answers, "SECONDS", 0.4)
    begin = time.process_time()
    verdict = check("made.1", answer)
    assert 0.4 < time.process_time() - begin < 2
    assert verdict.mistake == "never ends" and not verdict.holds
    assert check("made.1", right).holds  # the caller is not affected


@pytest.fixture
def _interrupts():
    """Ctrl+C raises KeyboardInterrupt, as in a kernel, regardless of earlier tests."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("_interrupts")
def test_interrupt_by_the_user_reaches_the_caller():
    before = _thread._count()

    def interrupted(height, angle):
        signal.raise_signal(signal.SIGINT)
        while True:
            height += 1

    for _ in range(30):  # an interrupt can reach the caller at any line
        with pytest.raises(KeyboardInterrupt):
            check("made.1", interrupted)
        until(lambda: _thread._count() == before, "a thread is left over")

    def raises(height, angle):
        raise KeyboardInterrupt

    assert check("made.1", raises).mistake == "raises an error"


def test_time_limit_stops_the_answer_and_not_the_caller(monkeypatch):
    """The caller survives even if a busy machine uses up the time before the caller continues."""
    monkeypatch.setattr(answers, "SECONDS", 0.01)
    start = _thread.start_new_thread

    def slow_start(*given):
        start(*given)
        end = time.monotonic() + 0.1
        while time.monotonic() < end:
            pass

    monkeypatch.setattr(_thread, "start_new_thread", slow_start)
    before = _thread._count()
    for _ in range(5):
        assert answers.run(loops, [(0, 1)] * 3) == [answers.NEVER]
        assert answers.run(right, [(0.5, 0.2)])[0].name is None
    assert _thread._count() == before


def test_waiting_answer_is_stopped_by_the_wall_clock_limit(monkeypatch):
    monkeypatch.setattr(answers, "WALL", 0.1)

    def waits(height, angle):
        while True:
            time.sleep(0.001)

    [outcome] = answers.run(waits, [(0, 1)] * 3)
    assert outcome.name == "never ends" and "stopped after 0 s" in outcome.says
    assert answers.run(right, [(0.5, 0.2)])[0].name is None


def works(seconds):
    end = time.thread_time() + seconds
    while time.thread_time() < end:
        pass
    return seconds


def test_many_slow_cases_are_reported_together(monkeypatch):
    """No single case is blamed for the total time."""
    assert (answers.SECONDS, answers.TOTAL) == (4, 30)
    monkeypatch.setattr(answers, "TOTAL", 0.4)
    outcomes = answers.run(works, [(0.05,)] * 40)
    assert [o.name for o in outcomes[:-1]] == [None] * (len(outcomes) - 1) and len(outcomes) < 12
    assert outcomes[-1].name == "too slow in all"
    assert outcomes[-1].says == f"{len(outcomes)} cases took more than 0 s together."
    assert answers.unended(outcomes[-1]) and answers.unended(answers.NEVER)
    assert not answers.unended(outcomes[0])
    monkeypatch.setattr(answers, "TOTAL", 30)
    monkeypatch.setattr(answers, "SECONDS", 0.2)
    assert [o.name for o in answers.run(works, [(0.05,)] * 10)] == [None] * 10, (
        "each call has its own limit"
    )


def threadless(monkeypatch):
    """Make Python as in a web page, without threads and CPU time. Return what the page is told."""
    told = []

    def none(*given):
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(_thread, "start_new_thread", none)
    monkeypatch.delattr(time, "thread_time")
    monkeypatch.setattr(time, "process_time", lambda: 0.0)
    monkeypatch.setattr(page, "began", lambda limit, sentence: told.append((limit, sentence)))
    monkeypatch.setattr(page, "ended", lambda: told.append(None))
    return told


def test_verdicts_do_not_depend_on_threads_and_the_page_is_told(monkeypatch):
    tried = [right, prints, lambda h, a: h / 0, lambda h, a: right(0.5, a), half_written]
    before = [check("made.1", answer) for answer in tried]
    told = threadless(monkeypatch)
    assert [check("made.1", answer) for answer in tried] == before
    assert len(told) >= 2 * len(tried) and told[1::2] == [None] * (len(told) // 2)
    says = "It never ends, or is far too slow (stopped after 30 s)."
    assert set(told[::2]) == {(answers.PAGE, says)}


def test_page_is_told_that_an_answer_ended_even_if_it_raises(monkeypatch):
    told = threadless(monkeypatch)
    answers.run(lambda: 1 / 0, [()])
    assert len(told) == 2 and told[1] is None


def test_slow_page_refuses_no_correct_answer(monkeypatch):
    told = threadless(monkeypatch)
    monkeypatch.setattr(answers, "TOTAL", 0.02)
    outcomes = answers.run(lambda x: time.sleep(0.01) or x, [(k,) for k in range(9)])
    assert [each.result for each in outcomes] == list(range(9)) and len(told) == 18


def test_time_limit_leaves_no_thread_behind(monkeypatch):
    """There is no late exception, the output is not redirected, and no thread is waiting."""
    monkeypatch.setattr(answers, "SECONDS", 0.02)
    out, before = sys.stdout, _thread._count()
    told = set()
    for k in range(40):
        pause = 0.001 * k  # some answers end just before the limit, others just after

        def ends(height, pause=pause):
            end = time.thread_time() + pause
            while time.thread_time() < end:
                height += 1
            return height

        [outcome] = answers.run(ends, [(0,)])
        assert outcome.name in (None, "never ends") and sys.stdout is out
        told.add(outcome.name)
        assert sum(range(1000)) == 499500
    assert None in told  # how many answers are stopped depends on the machine
    for answer in (loops, stubborn):
        assert answers.run(answer, [(0, 1)] * 3) == [answers.NEVER]
    time.sleep(0.05)
    assert _thread._count() <= before


def test_changed_input_is_reported(lab):
    lab.exercises["4"] = function(
        "def twice(q):\n    return 2 * q", lambda rng: [(np.arange(3.0),), (np.ones((2, 2)),)]
    )

    def spoils(q):
        q *= 2
        return q

    assert check("made.4", spoils).mistake == "changes its input"
    assert check("made.4", lambda q: 2 * q).holds
    assert check("made.4", lambda q: (2 * q).tolist()).holds
    assert check("made.4", lambda q: np.where(q == 2, np.nan, 2 * q)).mistake == "NaN"
    assert check("made.4", lambda q: q * np.nan).mistake == "always NaN"


def test_one_changed_input_among_several_is_reported():
    def spoils(one, two):
        two[0] = 7
        return one.sum()

    [outcome] = answers.run(spoils, [(np.zeros(3), np.ones(2))])
    assert outcome.name == "changes its input"


def test_the_rounding_error_of_a_zero_is_not_shown(lab):
    answer = np.array([1.1e-16, -1e-15, 1.5708])
    assert "you return [0, 0, 1.5708]" in check("made.1", lambda height, angle: answer).case


# --- Names of mistakes ----------------------------------------------------------------------------


def test_wrong_answer_gets_the_name_of_the_mistake_that_it_matches_in_all_cases():
    verdict = check("made.1", lambda h, a: right(h, a) @ TIP.inverse())
    assert verdict.mistake == "no tip" and "The tip is left out." in verdict.says
    assert "height = 0.5, angle = 1" in verdict.case and "should be at" in verdict.case


def test_equivalent_mistakes_are_both_named():
    verdict = check("made.1", lambda h, a: right(0.5, a))
    assert verdict.mistake == "fixed height or fixed height, said otherwise"
    assert "height = 2.5" in verdict.case, "wanted the smallest case that shows the mistake"
    assert 0 < verdict.points < 0.5


def test_mistake_that_matches_only_in_some_cases_is_not_named():
    def sometimes(height, angle):
        return right(height, angle) if angle > 0 else right(0.1, angle)

    verdict = check("made.1", sometimes)
    assert verdict.mistake is None and not verdict.holds and "not recognised" in repr(verdict)
    assert verdict.case


def test_unused_input_is_named():
    verdict = check("made.1", lambda height, angle: right(height, 2.0) if height else None)
    assert verdict.mistake == "angle has no effect"
    assert check("made.1", lambda height, angle: TIP).mistake == "one answer to everything"
    verdict = check("made.1", lambda height, angle: right(round(height / 9), 2.0 + 1e-3 * height))
    assert verdict.mistake == "angle has no effect" and "when `angle` changes" in verdict.says[0]


def inside(lab, mistakes=""):
    """Make exercise 4, whose answer is True or False."""
    cases = [(float(x), float(low)) for x in range(-4, 5) for low in (-2, 1)]
    program = "def inside(x, low):\n    return low <= x and x <= 3"
    lab.exercises["4"] = function(program, lambda rng: cases, mistakes)


def test_inputs_count_as_used_even_if_the_result_is_almost_always_true(lab):
    """With only one case, most wrong programs would seem not to use any input."""
    inside(lab)
    assert check("made.4", lambda x, low: low <= x <= 3).holds
    assert check("made.4", lambda x, low: x <= low + 5).mistake is None
    assert check("made.4", lambda x, low: x <= 3).mistake == "low has no effect"
    assert check("made.4", lambda x, low: low <= 3).mistake == "one answer to everything"
    assert check("made.4", lambda x, low: not low <= x <= 3).mistake == "True and False swapped"


LOW_AND_HIGH = """\
**too low.** The lower end is one too low.
- `low <= x` → `low - 1 <= x`

**too high.** The upper end is one too high.
- `x <= 3` → `x <= 4`
"""


def test_two_mistakes_in_a_boolean_answer_are_both_named(lab):
    inside(lab, LOW_AND_HIGH)
    assert check("made.4", lambda x, low: low - 1 <= x <= 3).mistake == "too low"
    verdict = check("made.4", lambda x, low: low - 1 <= x <= 4)
    assert verdict.mistake == "too low, and too high"
    assert verdict.says == (
        "It behaves like a program with two mistakes. The lower end is one too low. And: The upper "
        "end is one too high.",
    )


def test_two_mistakes_in_a_pose_are_both_named():
    turn = Quaternion.from_angle_axis
    verdict = check("made.1", lambda h, a: Transform(turn(a, (0, 0, 1)), (0.2, 0.1, 0.5)))
    assert verdict.mistake == "height has no effect", (
        "two pairs of mistakes match, so neither is named"
    )
    verdict = check("made.1", lambda h, a: Transform(turn(a / deg, (0, 0, 1)), (0.2, 0.1, h)))
    assert verdict.mistake == "no tip, and degrees for radians"


def test_verdict_on_a_nearly_correct_answer_states_its_error(lab):
    """A mistake that does not change the correct program's results is never named, however tolerant
    `same` is.
    """
    loose = lambda a, b: np.allclose(a.as_matrix(), b.as_matrix(), rtol=0, atol=1e-2)  # noqa: E731
    lab.exercises["4"] = made(POSE, **KEPT | {"same": loose})
    for name in ("made.1", "made.4"):
        verdict = check(name, lambda h, a: right(1.001 * h, a))
        assert verdict.mistake == "nearly right" and "off by at most 0.1" in verdict.says[0]
        assert check(name, lambda h, a: right(1.1 * h, a)).mistake is None


GENERAL = {
    "order of a product": lambda h, a: TIP @ (right(h, a) @ TIP.inverse()),
    "inverse of the answer": lambda h, a: right(h, a).inverse(),
    "degrees for radians": lambda h, a: right(h, a * deg),
    "mm for m": lambda h, a: right(h / mm, a),
    "sign": lambda h, a: right(h, -a),
    "sign of an axis": lambda h, a: Transform(
        right(h, a).rotation, right(h, a).translation * (1, -1, 1)
    ),
    "transposed": lambda h, a: Transform(right(h, a).rotation.inverse(), right(h, a).translation),
}


@pytest.mark.parametrize("name", GENERAL)
def test_common_slip_is_named(name):
    verdict = check("made.1", GENERAL[name])
    assert not verdict.holds and verdict.mistake == name


ARRAYS = {
    "wrapped angle": lambda t: wrapped(2 * t),
    "degrees for radians": lambda t: 2 * t / deg,
    "percent": lambda t: 200 * t,
    "a factor of two": lambda t: t,
    "off by one sample": lambda t: 2 * np.concatenate([t[:1], t[:-1]]),
    "sign": lambda t: -2 * t,
}


@pytest.mark.parametrize("name", ARRAYS)
def test_common_slip_in_numbers_is_named(name, lab):
    lab.exercises["4"] = function(
        "def twice(t):\n    return 2 * t",
        lambda rng: [(np.linspace(0, 3, 20),), (rng.uniform(0.1, 9, 30),)],
    )
    assert check("made.4", ARRAYS[name]).mistake == name
    assert check("made.4", lambda t: t + t).holds


def matrices(rng):
    return [tuple(rng.uniform(-1, 1, (2, 3, 3))) for _ in range(8)]


def planes(rng):
    return [(1.0, 2.0), (1.0, -2.0), *(tuple(map(float, p)) for p in rng.uniform(-2, 2, (9, 2)))]


def rows(rng):
    return [(rng.uniform(-2, 2, 4), rng.uniform(-2, 2, 4)) for _ in range(9)]


def integers(rng):
    return [(float(a), float(b)) for a in range(-2, 3) for b in range(-2, 3)]


# For each slip: the result of a correct program, its cases, and a student's wrong version.
WRITTEN = {
    "element-wise product": ("a @ b", matrices, lambda a, b: a * b),
    "order of a product": ("a @ b", matrices, lambda a, b: b @ a),
    "transposed": ("a @ b", matrices, lambda a, b: (a @ b).T),
    "inverse of the answer": (
        "a @ b",
        matrices,
        lambda a, b: np.linalg.solve(b, np.linalg.inv(a)),
    ),
    "inverse left out": (
        "(pose(a, b) @ pose(b, a).inverse()).translation",
        angles,
        lambda a, b: (right(a, b) @ right(b, a)).translation,
    ),
    "arcsin for atan2": (
        "np.arctan2(b, a)",
        planes,
        lambda x, y: np.arcsin(y / np.hypot(x, y)),
    ),
    "x and y swapped": ("np.arctan2(b, a)", planes, lambda x, y: np.arctan2(x, y)),
    "the long way round": (
        "a + (wrapped(3 * b, a) - a) / 2",
        angles,
        lambda a, b: a + (3 * b - a) / 2,
    ),
    "sign": ("a + 3 * b", planes, lambda a, b: a - 3 * b),
    "sine for cosine": ("3 * a + np.cos(b)", planes, lambda a, b: 3 * a + np.sin(b)),
    "a root left out": ("a + np.sqrt(b**4 + 3)", planes, lambda a, b: a + b**4 + 3),
    "a square left out": ("3 * a + b**2", planes, lambda a, b: 3 * a + b),
    "absolute value left out": ("3 * a + abs(b)", planes, lambda a, b: 3 * a + b),
    "least for greatest": ("(a - b).max()", rows, lambda a, b: (a - b).min()),
    "any for all": ("all((a - b)[:2] > -1)", rows, lambda a, b: any((a - b)[:2] > -1)),
    "a factor of two": ("a + 2 * (b + 5)", planes, lambda a, b: a + b + 5),
    "the limit itself": ("a <= b + 1", integers, lambda a, b: a < b + 1),
    "an index off by one": ("(a + b)[1]", rows, lambda a, b: (a + b)[2]),
}
POSED = """\
import numpy as np

from robokin import Quaternion, Transform
from robokin.units import wrapped

TIP = Transform(Quaternion.from_angle_axis(0.4, (0.6, 0, 0.8)), (0.1, 0.2, 0.3))


def pose(height, angle):
    return Transform(Quaternion.from_angle_axis(angle, (0, 0, 1)), (0.2, 0.1, height)) @ TIP


def asked(a, b):
    return """


@pytest.mark.parametrize("name", WRITTEN)
def test_slip_in_an_operation_is_named(name, lab):
    program, cases, wrong = WRITTEN[name]
    lab.exercises["4"] = function(POSED + program, cases)
    verdict = check("made.4", wrong)
    assert not verdict.holds and verdict.mistake == name
    assert check("made.4", edits.run(POSED + program)["asked"]).holds


def test_all_common_slips_are_tried():
    everything = "[" + ", ".join(program for program, _, _ in WRITTEN.values()) + "]"
    exercise = function(POSED + everything, angles)
    common = list(exercise._common())
    general = {name for name, *_ in (*RESULTS, *INPUTS)}
    assert {each.name for each in common} == edits.SLIPS.keys() | general
    assert edits.SLIPS.keys() <= WRITTEN.keys(), "a slip has no case in WRITTEN"
    signs = [each.says for each in common if each.name == "sign"]
    assert any("`a`" in says for says in signs) and any("`b`" in says for says in signs)


# --- Exercises that ask for a value or a test -----------------------------------------------------


def test_value_is_judged_with_the_students_numbers():
    assert check("made.2", 0.4, who="Ada").holds
    assert not check("made.2", ..., who="Ada").answered
    assert "Whose numbers" in repr(check("made.2", 0.4))
    verdict = check("made.2", 0.6, who="Ada")
    assert verdict.mistake == "too long" and "0.6" in verdict.case
    assert check("made.2", "long", who="Ada").mistake == "another kind or shape"


def test_submitted_test_must_accept_correct_programs_and_reject_wrong_ones():
    def good(program):
        return program(3) == 6 and program(2) == 4

    def asserts(program):
        assert program(3) == 6

    assert check("made.3", good).holds and check("made.3", asserts).holds
    assert check("made.3", lambda program: True).mistake == "accepts every program"
    assert check("made.3", lambda program: False).mistake == "rejects every program"
    verdict = check("made.3", lambda program: program(2) == 4)
    assert verdict.mistake == "accepts: square" and verdict.points == 0.8
    assert check("made.3", lambda program: program.__name__ == "no").mistake
    assert check("made.3", lambda program: "yes").mistake == "another kind or shape"
    assert not check("made.3", lambda program: ...).answered
    verdict = check("made.3", lambda program: not good(program))
    assert verdict.mistake == "True and False swapped", (
        "the verdict must be the same whether or not a program raises an error"
    )
    verdict = check("made.3", lambda program: not _quietly(good, program))
    assert verdict.mistake == "True and False swapped" and verdict.points == 0


def _quietly(test, program):
    try:
        return test(program)
    except Exception:
        return False


def test_test_that_ignores_errors_accepts_a_program_that_raises_an_error():
    def passes_over(program):
        try:
            return program(3) == 6 and program(2) == 4
        except Exception:
            return True

    verdict = check("made.3", passes_over)
    assert verdict.mistake == "accepts: it raises an error" and not verdict.holds
    assert check("made.3", lambda program: _quietly(passes_over, program)).mistake


def test_test_that_returns_nothing_is_reported():
    def silent(program):
        program(3) == 6  # noqa: B015

    def forgets(program):
        if program(3) != 6 or program(2) != 4:
            return False

    for answer in (silent, forgets):
        verdict = check("made.3", answer)
        assert verdict.mistake == "returns None" and "returns nothing" in verdict.says[0]

    def mixed(program):
        assert program(2) == 4
        return True if program(3) == 6 else None

    assert check("made.3", mixed).mistake == "returns None"


def test_error_in_the_test_itself_is_reported():
    verdict = check("made.3", lambda program: program(3) == 6 and program(2) + "4")
    assert verdict.mistake == "raises an error" and "TypeError" in verdict.says[0]
    assert "plain" in verdict.case


def test_test_that_counts_its_calls_does_not_pass(monkeypatch):
    """A test that counts its calls is correct only by chance, so it is tried repeatedly."""
    held, told = 0, set()
    for seed in range(200):
        dice = random.Random(seed)
        monkeypatch.setattr(catch.random, "SystemRandom", lambda dice=dice: dice)
        calls = []

        def counts(program, calls=calls):
            calls.append(program)
            return (len(calls) - 1) % 5 < 2

        verdict = check("made.3", counts)
        held += verdict.holds
        told.add(verdict.mistake)
    assert held <= 6 and "its answer changes" in told


def test_verdict_on_a_test_does_not_depend_on_the_order_of_its_programs(monkeypatch):
    told = set()
    for seed in range(20):
        dice = random.Random(seed)
        monkeypatch.setattr(catch.random, "SystemRandom", lambda dice=dice: dice)
        told.add(check("made.3", lambda program: program(0) == 0))
        told.add(check("made.3", lambda program: program(1) == 2 and program(0) + "x"))
    assert len(told) == 2


@settings(deadline=None)
@given(
    st.one_of(
        st.none(),
        st.integers(),
        st.floats(),
        st.text(max_size=5),
        st.lists(st.integers(), max_size=3),
        st.dictionaries(st.text(max_size=3), st.floats(), max_size=2),
        st.just(object()),
        st.just(lambda *a: object()),
        st.just(Transform.identity()),
    ),
    st.sampled_from(["made.1", "made.2", "made.3", "made.9", "other.1", "", "made"]),
)
def test_check_never_raises(answer, name):
    for who in (None, "Ada", 7, ""):
        verdict = check(name, answer, who=who)
        assert isinstance(repr(verdict), str) and 0 <= verdict.points <= 1
        assert not verdict.holds or verdict.points == 1


def test_markup_in_an_answer_is_escaped():
    text = check("made.1", lambda h, a: "<script>alert(1)</script>")._repr_html_()
    assert "<script" not in text and "&lt;script" in text


# --- Hints, solutions, progress and numbers -------------------------------------------------------


def test_hints_are_given_one_at_a_time():
    assert "first" in hint("made.1") and "1 more" in hint("made.1")
    assert "second" in hint("made.1", 2) and "more" not in hint("made.1", 2)
    assert "2 hints" in hint("made.1", 3) and "2 hints" in hint("made.1", 0)
    with pytest.raises(ValueError, match="made.1"):
        hint("made.7")


def test_shown_solution_passes():
    text = solution("made.1")
    assert text.startswith("# --- 1: a pose\n")
    assert check("made.1", edits.run(text)["pose"]).holds


def test_progress_lists_solved_exercises():
    assert "Nothing" in progress()
    check("made.1", right)
    check("made.2", 0.9, who="Ada")
    lines = progress().splitlines()
    assert [line.split()[0] for line in lines] == ["Checked", "made:", "holds", "begun", "not"]
    assert progress("made") == progress()
    check("made.1", stub)
    assert progress().splitlines() == lines, "an exercise that was solved once counts as practised"


def test_individual_numbers_ignore_case_and_spaces_in_a_name(lab):
    from robokin.course.variants import Numbers, dice

    lab.given = lambda who: Numbers({"x": dice("made", who).randrange(10**6)}, {"x": ("mm", 1)})
    same = ["Ada Lovelace", " ada  lovelace", "ADA LOVELACE", "Ada\u00a0Lovelace"]
    assert len({variant("made", who)["x"] for who in same}) == 1
    assert variant("made", "Zo\u00eb") == variant("made", "Zoe\u0308")
    assert variant("made", 17) == variant("made", "17")
    assert len({variant("made", k)["x"] for k in range(300)}) > 295
    assert key("made", ["a", "b"]) == {"a": variant("made", "a"), "b": variant("made", "b")}
    with pytest.raises(ValueError, match="who"):
        variant("made", " ")
    assert repr(variant("made", "Ada")).endswith("mm")


def test_individual_numbers_are_the_same_in_another_process():
    code = "from robokin.course.variants import dice; print(dice('made', 'Ada').randrange(10**9))"
    made = {
        subprocess.run(
            [sys.executable, "-c", code],
            env={"PYTHONHASHSEED": seed, "PATH": ""},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(made) == 1 and made.pop().strip().isdigit()


def test_unchanged_input_equals_its_copy():
    rotation = Quaternion.from_angle_axis(0.3, [0, 0, 1])
    for value in (Transform(rotation, [1, 2, 3]), ScaraPose((1, 2, 3), 0.3), [np.nan, (1, "a")]):
        assert answers.equal(value, copy.deepcopy(value))
    assert not answers.equal(ScaraPose((1, 2, 3), 0.3), ScaraPose((1, 2, 3), 0.4))
    assert not answers.equal(ScaraPose((1, 2, 3)), ScaraPose((1, 2, 4)))
    assert not answers.equal(ScaraPose((1, 2, 3)), np.array([1, 2, 3]))
    ragged = [np.ones((4, 2)), np.ones((3, 2))]
    assert answers.equal(ragged, copy.deepcopy(ragged))
    assert not answers.equal(ragged, [ragged[0], 2 * ragged[1]])
