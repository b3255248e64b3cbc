"""Find exercises and predictions by id: "irb140_motion.1" is exercise 1 of the lab whose notebook
is NN_irb140_motion.ipynb; "irb140_motion.p2" is a prediction of that lab. A prediction that moves
to another lab keeps its id.

Their text is in one folder per lab, in notebooks/exercises. The environment variable
ROBOKIN_EXERCISES lists additional folders of this kind, for your own labs or if robokin was not
installed from a clone.
"""

import contextlib
import hashlib
import importlib
import inspect
import os
import re
import sys
import textwrap
import traceback
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cache, cached_property, partial
from pathlib import Path
from types import ModuleType
from typing import Any

from . import edits, markdown, questions
from .catch import Catch
from .exercises import Exercise
from .function import Function
from .markdown import BadFile
from .questions import Prediction
from .value import Value

OURS = Path(__file__).parents[2] / "notebooks" / "exercises"
ELSEWHERE = "ROBOKIN_EXERCISES"
WORDS = ("objectives", "predictions")  # Markdown files that are not exercises
MORE = "For labs of your own, set ROBOKIN_EXERCISES=FOLDER or pass --exercises FOLDER."
DEFAULTS = ("form", "law", "same")  # `own` ignores these names in a notebook


class Lab:
    """The exercises and predictions of a lab, read from its folder on demand. `broken` maps each
    file that cannot be read to the reason; all other files can be used.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.broken: dict[str, str] = {}
        self.package = f"robokin_exercises_{hashlib.sha1(os.fsencode(folder)).hexdigest()[:12]}"
        for name in [each for each in sys.modules if each.startswith(f"{self.package}.")]:
            del sys.modules[name]  # the file may have changed
        importlib.invalidate_caches()
        sys.modules.setdefault(self.package, ModuleType(self.package)).__path__ = [str(folder)]

    @cached_property
    def objectives(self) -> tuple[str, ...]:
        """The objectives: what a student can do after the lab."""
        file = self.folder / "objectives.md"
        with self._noted(file.name):
            return markdown.objectives(markdown.read(file)) if file.is_file() else ()
        return ()

    @cached_property
    def exercises(self) -> Mapping[str, Exercise]:
        """The exercises by number."""
        found: dict[str, Exercise] = {}
        files: dict[str, str] = {}
        for file in sorted(self.folder.glob("*.md")):
            if file.stem not in WORDS:
                with self._noted(file.name):
                    exercise = self.exercise(file)
                    other = files.setdefault(exercise.number, file.name)
                    if other != file.name:
                        told = f"{exercise.number} is also the number of {other}"
                        raise BadFile(f"{file}", 1, told)
                    found[exercise.number] = exercise
        return dict(sorted(found.items(), key=lambda each: (len(each[0]), each[0])))

    @cached_property
    def predictions(self) -> Mapping[str, Prediction]:
        """The predictions by number."""
        found: dict[str, Prediction] = {}
        file = self.folder / "predictions.md"
        if not file.is_file():
            return found
        with self._noted(file.name):
            code = self.module("predictions")
            for line, heading, text in questions.sections(markdown.read(file)):
                with self._noted(f"{file.name}, {heading}"):
                    number, each = questions.prediction(f"{file}", line, heading, text, code)
                    if number in found:
                        raise BadFile(f"{file}", line, f"{number} occurs twice")
                    found[number] = replace(each, view=partial(self._view, number))
        return found

    @cached_property
    def moved(self) -> Mapping[str, str]:
        """The full ids of the predictions that have moved here from another lab, by number. The
        heading of such a prediction contains its full id.
        """
        with contextlib.suppress(BadFile):  # `predictions` notes that there is no such file
            text = markdown.read(self.folder / "predictions.md")
            found: list[str] = re.findall(r"^## (\w+\.p\d+)", text, re.M)
            return {name.partition(".")[2]: name for name in found}
        return {}

    def _view(self, number: str) -> Any:
        """The view that shows the answer to a prediction. Only this method imports the drawing
        code.
        """
        return self.module("pictures").get(f"{number}_view", str)()

    def read(self) -> None:
        """Read all files now."""
        _ = self.objectives, self.exercises, self.predictions

    @property
    def given(self) -> Callable[[Any], Any] | None:
        """The function that returns the numbers of a student; None if no exercise has any."""
        found = (getattr(each, "given", None) for each in self.exercises.values())
        return next(filter(None, found), None)

    def exercise(self, file: Path) -> Exercise:
        """Return the exercise in a Markdown file and its Python file. Raises ValueError if they
        cannot be used.
        """
        text = markdown.exercise(f"{file}", markdown.read(file))
        return made(text, self.module(file.stem))

    def module(self, stem: str) -> dict[str, Any]:
        """Run a Python file and return its names. Raises ValueError if it cannot be run."""
        file = self.folder / f"{stem}.py"
        if not file.is_file():
            return {}
        try:
            return vars(importlib.import_module(f"{self.package}.{stem}"))
        except SyntaxError as error:
            raise BadFile(error.filename or f"{file}", error.lineno, markdown.why(error)) from None
        except Exception as error:
            steps = traceback.extract_tb(error.__traceback__)
            mine = [each for each in steps if Path(each.filename).parent == self.folder]
            where, line = (mine[-1].filename, mine[-1].lineno) if mine else (f"{file}", None)
            raise BadFile(where, line, markdown.why(error)) from None

    @contextlib.contextmanager
    def _noted(self, name: str) -> Iterator[None]:
        try:
            yield
        except Exception as error:  # a teacher's file may raise any error
            known = f"{error}" if isinstance(error, ValueError) else markdown.why(error)
            self.broken[name] = known if known.startswith(f"{self.folder}") else f"{name}: {known}"


def made(text: markdown.Text, code: Mapping[str, Any]) -> Exercise:
    """Make an exercise. Its files determine its kind: the student writes a test if the text has a
    section "Correct programs", gives a value if the code defines `faults`, and otherwise writes a
    function. Raises ValueError if the files do not define an exercise.
    """
    if "Correct programs" in text.parts:
        return Catch(text, code)
    return Value(text, code) if "faults" in code else Function(text, code)


def own(solution: Any, cases: Any, mistakes: str) -> Exercise:
    """Make the reader's own exercise from a Markdown file, or from cases and a correct function or
    its source text. Raises ValueError if these do not define an exercise.
    """
    if isinstance(solution, os.PathLike) or f"{solution}".endswith(".md"):
        file = Path(solution).resolve()
        return Lab(file.parent).exercise(file)
    names: dict[str, Any] = {}
    if not isinstance(solution, str):
        try:
            names = {k: v for k, v in solution.__globals__.items() if k not in DEFAULTS}
            if solution.__name__ == "<lambda>":
                raise ValueError("solution: wanted a function defined with def, got a lambda")
            solution = inspect.getsource(solution)
        except (AttributeError, OSError, TypeError):
            raise ValueError(
                f"solution: wanted a function or its source code, got {solution!r}"
            ) from None
    source = textwrap.dedent(solution).strip()
    title = edits.function_name("solution", 1, source)
    parts = {
        "Solution": (1, f"```python\n{source}\n```"),
        "Mistakes": (1, textwrap.dedent(mistakes)),
    }
    text = markdown.Text(f"exercise {title}", "1", title, 1, "", (), parts)
    return Function(text, names | {"cases": cases})


def labs() -> Mapping[str, Lab]:
    """All labs by name: ours, then those in other folders. The labs of a folder are in the order of
    the notebooks next to it; labs without a notebook come last.
    """
    return _labs(OURS, os.environ.get(ELSEWHERE, ""))


def numbered(place: Path) -> list[str]:
    """The names of the labs whose notebooks are next to a folder, in order."""
    return [file.stem.partition("_")[2] for file in sorted(place.parent.glob("[0-9]*_*.ipynb"))]


@cache
def _labs(ours: Path, elsewhere: str) -> Mapping[str, Lab]:
    found: dict[str, Lab] = {}
    for place in (ours, *(Path(each).resolve() for each in elsewhere.split(os.pathsep) if each)):
        folders = {each.name: each for each in place.glob("[!._]*") if each.is_dir()}
        first = [name for name in numbered(place) if name in folders]
        for name in dict.fromkeys([*first, *sorted(folders)]):
            taken, here = found.get(name), folders[name]
            if taken and taken.folder != here:  # our labs cannot be replaced
                told = f"{here}: not read, since {taken.folder} has the same name"
                taken.broken[f"{here}"] = told
            found.setdefault(name, Lab(here))
    return found


def lab(name: Any) -> Lab:
    """Return a lab. Raises ValueError if there is no such lab."""
    known = labs()
    if not known:
        raise ValueError(
            "lab: no labs found. Install robokin from a clone of its repository, or set "
            f"{ELSEWHERE} to the notebooks/exercises folder of a clone"
        )
    if not isinstance(name, str) or name not in known:
        raise ValueError(f"lab: wanted one of {', '.join(known)}, got {name!r}")
    return known[name]


def titled(name: str) -> str:
    """The name of a lab for readers: "lab 03, irb140 motion"."""
    return f"lab {list(labs()).index(name):02}, {name.replace('_', ' ')}"


def ids(slug: str, what: str) -> list[str]:
    """Return the ids of the exercises or predictions of a lab, in the order of the lab. `what` is
    "exercises" or "predictions". Raises ValueError if there is no such lab.
    """
    made = lab(slug)
    return [made.moved.get(number, f"{slug}.{number}") for number in getattr(made, what)]


def home(name: str) -> str:
    """Return the lab to which the exercise or prediction with this id belongs. It is the lab named
    in the id, unless the prediction has moved. Does not check whether this lab exists.
    """
    asking = (slug for slug, made in labs().items() if name in made.moved.values())
    return next(asking, name.partition(".")[0])


def lab_of(names: Iterable[str]) -> str | None:
    """Return the lab to which most of these ids belong, or None if they belong to no lab."""
    found = Counter(slug for slug in map(home, names) if slug in labs())
    return found.most_common(1)[0][0] if found else None


def find(name: Any, what: str) -> Any:
    """Find an exercise or a prediction by id; an exercise is returned unchanged. `what` is
    "exercises" or "predictions". Raises ValueError if there is none or it cannot be read.
    """
    if isinstance(name, Exercise):
        return name
    text, known = str(name), labs()
    slug, (_, dot, number) = home(text), text.partition(".")
    if known and (slug not in known or not dot):
        raise ValueError(
            f'id: wanted an id such as "{next(iter(known))}.1", from one of the labs '
            f"{', '.join(known)}; got {name!r}. {MORE}"
        )
    valid = ids(slug, what)
    if text not in valid:
        wanted = f"wanted one of {', '.join(valid)}" if valid else f"{slug} has no {what}"
        raise ValueError("\n".join([f"id: {wanted}, got {name!r}", *lab(slug).broken.values()]))
    return getattr(lab(slug), what)[number]
