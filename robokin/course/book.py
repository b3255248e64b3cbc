"""Where exercises and predictions are found by their ids: "irb140_motion.1" is exercise 1 of the
lab whose notebook is called irb140_motion, whatever its number; "irb140_motion.p2" a prediction.

What they say and ask stands in a folder for each lab, beside the notebooks: notebooks/exercises.
The variable ROBOKIN_EXERCISES names more such folders, for labs of one's own and for an
installation without a clone.
"""

import contextlib
import hashlib
import importlib
import inspect
import os
import sys
import textwrap
from collections.abc import Mapping
from functools import cache, cached_property
from pathlib import Path
from types import ModuleType
from typing import Any

from . import edits, markdown
from .catch import Catch
from .exercises import Exercise
from .function import Function
from .questions import Prediction, predictions
from .value import Value

OURS = Path(__file__).parents[2] / "notebooks" / "exercises"
ELSEWHERE = "ROBOKIN_EXERCISES"
WORDS = ("objectives", "predictions")  # Markdown that is no exercise


class Lab:
    """The exercises and predictions of a lab, read from its folder when they are asked for."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.broken: dict[str, str] = {}  # file -> why it cannot be read
        self.package = f"robokin_exercises_{hashlib.sha1(os.fsencode(folder)).hexdigest()[:12]}"
        sys.modules.setdefault(self.package, ModuleType(self.package)).__path__ = [str(folder)]

    @cached_property
    def objectives(self) -> tuple[str, ...]:
        """What a student can do after the lab."""
        file = self.folder / "objectives.md"
        if not file.is_file():
            return tuple(_old(self.folder.name, "OBJECTIVES") or ())
        return markdown.objectives(markdown.read(file))

    @cached_property
    def exercises(self) -> Mapping[str, Exercise]:
        """By their numbers. What cannot be read is in `broken`, and the others are there."""
        found: dict[str, Exercise] = {}
        for file in sorted(self.folder.glob("*.md")):
            if file.stem not in WORDS:
                try:
                    exercise = self._exercise(file)
                    if exercise.number in found:
                        raise markdown.wrong(f"{file}", 1, f"another one is {exercise.number}, too")
                    found[exercise.number] = exercise
                except Exception as error:  # a teacher's file may hold anything
                    known = isinstance(error, ValueError)
                    told = f"{error}" if known else f"{file}: {type(error).__name__}: {error}"
                    self.broken[file.name] = told
        return dict(sorted({**_old(self.folder.name, "EXERCISES"), **found}.items()))

    @cached_property
    def predictions(self) -> Mapping[str, Prediction]:
        """By their numbers. ValueError: they cannot be read."""
        file = self.folder / "predictions.md"
        if not file.with_suffix(".py").is_file():
            return _old(self.folder.name, "PREDICTIONS") or {}
        code = self.module("pictures") | self.module("predictions")
        return predictions(f"{file}", markdown.read(file), code)

    def read(self) -> None:
        """Read everything now."""
        _ = self.objectives, self.exercises, self.predictions

    def given(self, who: Any) -> Any:
        """The numbers of a student. ValueError: no exercise has numbers of one's own."""
        for exercise in self.exercises.values():
            if given := getattr(exercise, "given", None):
                return given(who)
        raise ValueError(f"lab: {self.folder.name} has no numbers of one's own")

    def _exercise(self, file: Path) -> Exercise:
        text = markdown.exercise(f"{file}", markdown.read(file))
        code = self.module(file.stem)
        try:
            return made(text, code)
        except ValueError as error:
            raise ValueError(
                f"{error}" if f"{file}" in f"{error}" else f"{file}, {error}"
            ) from None

    def module(self, stem: str) -> dict[str, Any]:
        if not (self.folder / f"{stem}.py").is_file():
            return {}
        return vars(importlib.import_module(f"{self.package}.{stem}"))


def _old(name: str, what: str) -> Any:
    """What a lab has in Python still."""
    if name not in numbered():
        return {}
    with contextlib.suppress(ModuleNotFoundError):
        return getattr(importlib.import_module(f".{name}", __package__), what)
    return {}


def made(text: markdown.Text, code: Mapping[str, Any]) -> Exercise:
    """An exercise of the kind that it is written as: a test to write has right programs, a value to
    give has `faults`, and what has neither is a function to write.
    """
    if "Right programs" in text.parts:
        return Catch(text, code)
    return Value(text, code) if "faults" in code else Function(text, code)


def own(solution: Any, cases: Any, mistakes: str) -> Exercise:
    """An exercise of one's own: of a Markdown file, or of a right function, or its text, and its
    cases. ValueError: it cannot be read.
    """
    if isinstance(solution, os.PathLike) or (isinstance(solution, str) and "\n" not in solution):
        file = Path(solution)
        return Lab(file.resolve().parent)._exercise(file.resolve())
    source = solution if isinstance(solution, str) else inspect.getsource(solution)
    title = edits.function_name(textwrap.dedent(source))
    parts = {
        "Solution": (1, f"```python\n{textwrap.dedent(source)}```"),
        "Mistakes": (1, textwrap.dedent(mistakes)),
    }
    text = markdown.Text("<exercise>", "1", title, 1, "", (), parts)
    names = {} if isinstance(solution, str) else vars(inspect.getmodule(solution))
    return Function(text, names | {"cases": cases})


def labs() -> Mapping[str, Lab]:
    """All labs by their names, in the order of their notebooks; those of other folders after ours,
    in the order of their names.
    """
    return _labs(os.environ.get(ELSEWHERE, ""))


def numbered() -> list[str]:
    """Our labs in the order of their notebooks."""
    return [file.stem.partition("_")[2] for file in sorted(OURS.parent.glob("[0-9]*_*.ipynb"))]


@cache
def _labs(elsewhere: str) -> Mapping[str, Lab]:
    numbers = numbered()
    found: dict[str, Lab] = {name: Lab(OURS / name) for name in numbers}
    for place in (OURS, *map(Path, filter(None, elsewhere.split(os.pathsep)))):
        folders = [each for each in place.glob("[!._]*") if each.is_dir()]
        for each in sorted(folders, key=lambda each: each.name):
            found.setdefault(each.name, Lab(each))  # nobody takes a name of ours
    return found


def lab(name: Any) -> Lab:
    """A lab. ValueError: none such."""
    known = labs()
    if not known:
        raise ValueError(
            f"lab: no labs are here. Install robokin from its clone, or let {ELSEWHERE} name the "
            "folder notebooks/exercises of one"
        )
    if name not in known:
        raise ValueError(f"lab: wanted one of {', '.join(known)}, got {name!r}")
    return known[name]


def titled(name: str) -> str:
    """A lab as people call it: "lab 03, irb140 motion"."""
    return f"lab {list(labs()).index(name):02}, {name.replace('_', ' ')}"


def find(name: Any, what: str) -> Any:
    """The exercise or prediction with an id. `what`: "exercises" or "predictions". ValueError: none
    such, or one that cannot be read.
    """
    slug, dot, number = str(name).partition(".")
    known = labs()
    if known and (slug not in known or not dot):
        raise ValueError(
            f'id: wanted a lab and a number, "{next(iter(known))}.1", of {", ".join(known)}; got '
            f"{name!r}"
        )
    entries = getattr(lab(slug), what)
    if number not in entries:
        told = f"id: wanted one of {', '.join(f'{slug}.{key}' for key in entries)}, got {name!r}"
        raise ValueError(". ".join([told, *lab(slug).broken.values()]))
    return entries[number]
