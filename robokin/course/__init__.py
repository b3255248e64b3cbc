"""The course: exercises that name the student's mistake, predictions, hints, individual numbers for
each student, and reports.

    from robokin.course import check, hint, predict, progress, report, solution, variant

The text of exercises and predictions is in notebooks/exercises; `book` finds it.
"""

import textwrap
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from .book import find, lab, own
from .exercises import Exercise, Verdict
from .hand_in import report, watch
from .markdown import BadFile
from .note import Note
from .predictions import predict
from .variants import key, variant

if TYPE_CHECKING:
    from ..show.explorers import Explorer

__all__ = [
    "Verdict",
    "check",
    "exercise",
    "hint",
    "key",
    "pose_explorer",
    "predict",
    "progress",
    "report",
    "solution",
    "variant",
]

watch()  # the first cell of a lab imports this module, so `report` knows which cells ran later
# the latest verdict on each exercise in this kernel, by id; a passing verdict is kept
_verdicts: dict[str, Verdict] = {}


def check(name: str | Exercise, answer: Any = None, who: Any = None) -> Verdict:
    """Return a `Verdict` on the answer to an exercise, such as "irb140_motion.1". A cell displays
    the verdict.

    name  an id, or your own exercise (see `exercise`)
    who   the student, if the exercise gives each student their own numbers (see `variant`)

    No exception escapes: if the answer raises an error, prints, changes its input or never ends,
    the verdict says so.
    """
    called = name.title if isinstance(name, Exercise) else str(name)
    try:
        asked = name if isinstance(name, Exercise) else find(name, "exercises")
    except ValueError as error:
        return Verdict(called, answered=False, says=(str(error),))
    try:
        verdict: Verdict = asked.judge(called, answer, who)
    except Exception as error:
        told = f"{error}" if isinstance(error, BadFile) else f"{type(error).__name__}: {error}"
        verdict = Verdict(called, says=(f"This cannot be judged: {told}",))
    if isinstance(name, Exercise):  # not a lab exercise
        return verdict
    before = _verdicts.get(verdict.exercise)
    if before is None or not before.holds:  # a passing verdict is kept
        _verdicts[verdict.exercise] = verdict
    return verdict


def exercise(
    solution: Any, cases: Callable[..., Any] | None = None, mistakes: str = ""
) -> Exercise:
    """Make your own exercise, to use as in `check(exercise(...), answer)`.

    solution  a Markdown file (.md) like those of the labs, with its Python file next to it; or a
              correct function, or its source text
    cases     a function that takes a random generator and returns inputs of the solution, as tuples
    mistakes  as in the Markdown file: a name, a sentence, edits to the solution

    The file is read again on each call. Raises ValueError if the file cannot be read or defines no
    function, or if an edit does not match.
    """
    return own(solution, cases, mistakes)


def pose_explorer(name: str) -> "Explorer":
    """Return the target explorer of an exercise whose answer is a pose. The page shows whether the
    pose solves the task, and its button "Copy as Python" copies the pose. Raises ValueError if
    there is no such exercise.
    """
    from ..arms.catalogue import IRB140
    from ..show.explorers import Explorer, target_explorer

    exercise = find(name, "exercises")
    goal = getattr(exercise, "goal", None)
    if goal is None:
        raise ValueError(f"id: {name} is not an exercise whose answer is a pose")
    made = target_explorer(IRB140)
    title = f"Exercise {name}: {exercise.task}"
    return Explorer(made.data | {"task": dict(goal), "title": title}, made.still)


def hint(name: str, n: int = 1) -> Note:
    """Return hint n of an exercise, counting from 1; later hints reveal more. Raises ValueError if
    there is no such exercise.
    """
    hints = find(name, "exercises").hints
    if not isinstance(n, int) or not 1 <= n <= len(hints):
        return Note(f"There are {len(hints)} hints: 1 to {len(hints)}.")
    more = f" ({len(hints) - n} more)" if n < len(hints) else ""
    return Note(f"Hint {n}{more}: {hints[n - 1]}")


def solution(name: str) -> Note:
    """Return a solution of an exercise as text, without running it. Raises ValueError if there is
    no such exercise.
    """
    found: Exercise = find(name, "exercises")
    return Note(f"# --- {found.number}: {found.title}\n{found.solution.strip()}")


def progress(name: str | None = None) -> Note:
    """Return the objectives reached in this kernel, for each lab or only for the lab `name`."""
    slugs = dict.fromkeys(k.partition(".")[0] for k in _verdicts) if name is None else [name]
    lines = ["Checked since Python started:"] if _verdicts else []
    for slug in slugs:
        book = lab(slug)
        lines.append(f"{slug}:")
        objectives = dict(enumerate(book.objectives, 1))
        for k in sorted({*objectives, *(e.objective for e in book.exercises.values())}):
            mine = {f"{slug}.{n}": e for n, e in book.exercises.items() if e.objective == k}
            got = [i for i in mine if i in _verdicts and _verdicts[i].holds]
            tried = [i for i in mine if i in _verdicts and _verdicts[i].answered]
            word = "holds" if len(got) == len(mine) else "begun" if tried else "not yet"
            objective = objectives.get(k) or "; ".join(e.title for e in mine.values())
            text = f"{word:8} {', '.join(mine)}: {objective}"
            lines += textwrap.wrap(text, 88, initial_indent="  ", subsequent_indent=" " * 11)
    return Note("\n".join(lines) or "Nothing has been checked since Python started.")
