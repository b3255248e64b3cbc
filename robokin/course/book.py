"""Where exercises and predictions are found by their ids: "irb140_motion.1" is exercise 1 of the
lab whose notebook is called irb140_motion, whatever its number; "irb140_motion.p2" a prediction.

What they say and ask stands in a folder for each lab, beside the notebooks: notebooks/exercises.
ROBOKIN_EXERCISES names other folders, of labs of one's own, or for an installation without a clone.
"""

import importlib
import os
import sys
from collections.abc import Mapping
from functools import cache, cached_property
from pathlib import Path
from types import ModuleType
from typing import Any

from . import markdown
from .catch import Catch
from .exercises import Exercise
from .function import Function
from .predictions import Prediction
from .value import Value

OURS = Path(__file__).parents[2] / "notebooks" / "exercises"
ELSEWHERE = "ROBOKIN_EXERCISES"


class Lab:
    """The exercises and predictions of a lab, read from its folder. `broken`: what could not be
    read, by its file, and why.
    """

    def __init__(self, folder: Path) -> None:
        self.folder, self.broken = folder, {}
        self.package = f"robokin_exercises_{abs(hash(folder))}"
        found = sys.modules.setdefault(self.package, ModuleType(self.package))
        found.__path__ = [str(folder)]

    @cached_property
    def objectives(self) -> tuple[str, ...]:
        file = self.folder / "objectives.md"
        return markdown.objectives(markdown.read(file)) if file.is_file() else ()

    @cached_property
    def exercises(self) -> Mapping[str, Exercise]:
        """By their numbers. What cannot be read is in `broken`."""
        made = {}
        for file in sorted(self.folder.glob("*.md")):
            if file.stem in ("objectives", "predictions") or file.name.startswith("."):
                continue
            try:
                exercise = self._exercise(file)
                if exercise.number in made:
                    raise markdown.wrong(f"{file}", 1, f"{exercise.number} is there already")
                made[exercise.number] = exercise
            except Exception as error:
                told = f"{error}" if isinstance(error, ValueError) else f"{file}: {error!r}"
                self.broken[file.name] = told
        return dict(sorted(made.items()))

    @cached_property
    def predictions(self) -> Mapping[str, Prediction]:
        """By their numbers. ValueError: they cannot be read."""
        file = self.folder / "predictions.md"
        if not file.is_file():
            return {}
        asked = markdown.questions(f"{file}", markdown.read(file))
        code, pictures = self._module("predictions"), self._module("pictures")
        return {n: Prediction(each, code, pictures, n) for n, each in asked.items()}

    def _exercise(self, file: Path) -> Exercise:
        text = markdown.exercise(f"{file}", markdown.read(file))
        try:
            return made(text, self._module(file.stem))
        except ValueError as error:
            raise ValueError(f"{file}, {error}") from None

    def _module(self, stem: str) -> dict[str, Any]:
        if not (self.folder / f"{stem}.py").is_file():
            return {}
        return vars(importlib.import_module(f"{self.package}.{stem}"))


def made(text: markdown.Text, code: Mapping[str, Any]) -> Exercise:
    """An exercise of the kind that it is written as: a test to write has right programs, a value
    to give has `faults`, and what has neither is a function to write.
    """
    kind = Catch if "Right programs" in text.parts else Value if "faults" in code else Function
    return kind(text, code)
