"""A handed-in notebook as a text: which exercises and predictions it answers and how, and which
verdicts stand in its outputs. Nothing of it is run.
"""

import ast
import html
import re
import warnings
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from .book import LABS, find
from .export import read

NONE = "your name"  # what the labs have where the student's name should stand
CLAIM = re.compile(r"\b(\w+\.\w+): (holds|does not hold|not answered yet)\.")


class Call(NamedTuple):
    """A call of `check` or `predict` in the cell with that number. answer, own: the arguments as
    Python's text ("" where there is none): the answer or the choice, and `who`.
    """

    cell: int
    name: str
    answer: str
    own: str


@dataclass(frozen=True)
class HandedIn:
    """A student's notebook.

    lab      the lab whose exercises and predictions it has, None: none
    checks   the last call for each exercise that it checks: that one counts
    choices  the last call of each prediction with a choice
    broken   the exercises that are checked in cells that are no Python
    guesses  the line of guesses that a page copies, as the last call of `report` has it
    """

    path: Path
    notebook: Any
    lab: str | None
    checks: dict[str, Call]
    choices: dict[str, Call]
    broken: dict[str, str]
    guesses: str = ""

    @property
    def title(self) -> str:
        """Its first heading, or the file's name."""
        for cell in self.notebook.cells:
            found = re.search(r"^# +(.+)$", cell.source, re.M)
            if cell.cell_type == "markdown" and found:
                return found[1].strip()
        return self.path.stem


def handed_in(path: Path) -> HandedIn:
    """Read a notebook. Which lab it is, the ids in it tell, since a file may be called anything;
    where there are none, the file's name. ValueError: no notebook.
    """
    notebook = read(path)
    checks: dict[str, Call] = {}
    choices: dict[str, Call] = {}
    broken: dict[str, str] = {}
    labs: Counter[str] = Counter()
    guesses = ""
    for k, cell in enumerate(notebook.cells):
        if cell.cell_type != "code":
            continue
        try:
            calls = list(_calls(cell.source, k))
        except (SyntaxError, ValueError, RecursionError) as error:
            calls = []
            for name in re.findall(r"""check\(\s*["'](\w+\.\w+)["']""", cell.source):
                broken[name] = f"{type(error).__name__}: {error}"
        for what, call in calls:
            if what == "report":
                guesses = call.answer or guesses
                continue
            try:
                find(call.name, "EXERCISES" if what == "check" else "PREDICTIONS")
            except ValueError:
                continue
            labs[call.name.partition(".")[0]] += 1
            if what == "check":
                checks[call.name] = call
                broken.pop(call.name, None)
            elif call.answer not in ("", "None"):
                choices[call.name] = call
    labs.update(name.partition(".")[0] for name in broken)
    most = [lab for lab, _ in labs.most_common() if lab in LABS]
    most = most or [lab for lab in LABS if lab in path.stem.lower()]
    return HandedIn(path, notebook, most[0] if most else None, checks, choices, broken, guesses)


def claims(notebook: Any, checks: dict[str, Call]) -> dict[str, str]:
    """What the outputs say of exercises, by their ids: those of the call that counts, where it has
    any, else of all cells; "holds" if any of them says so.
    """
    found: dict[str, str] = {}
    last = {(call.name, call.cell) for call in checks.values()}
    said = [(name, k, word) for k, cell in enumerate(notebook.cells) for name, word in _said(cell)]
    at_last = {name for name, k, _ in said if (name, k) in last}
    for name, k, word in said:
        if (name not in at_last or (name, k) in last) and found.get(name) != "holds":
            found[name] = word
    return found


def _said(cell: Any) -> Iterator[tuple[str, str]]:
    for output in cell.get("outputs", ()):
        data = output.get("data", {})
        shown = html.unescape(re.sub("<[^>]*>", "\n", str(data.get("text/html", ""))))
        yield from CLAIM.findall(f"{output.get('text', '')}\n{data.get('text/plain', '')}\n{shown}")


def _calls(source: str, cell: int) -> Iterator[tuple[str, Call]]:
    """("check" or "predict", Call) for each call with an id that stands there, from the top; and
    ("report", Call), whose answer is the line of guesses.
    """
    found = []
    for node in ast.walk(_tree(source)):
        if not isinstance(node, ast.Call):
            continue
        f = node.func
        what = f.id if isinstance(f, ast.Name) else f.attr if isinstance(f, ast.Attribute) else ""
        if what == "report":
            line = next((each.value for each in node.keywords if each.arg == "guesses"), None)
            if isinstance(line, ast.Constant) and isinstance(line.value, str):
                found.append((node.lineno, node.col_offset, what, Call(cell, "", line.value, "")))
        if what not in ("check", "predict"):
            continue
        names = ("name", "answer", "who") if what == "check" else ("name", "choice")
        given = dict(zip(names, node.args, strict=False))
        given |= {str(each.arg): each.value for each in node.keywords if each.arg in names}
        name = given.get("name")
        if isinstance(name, ast.Constant) and isinstance(name.value, str):
            answer, own = given.get(names[1]), given.get("who")
            call = Call(
                cell,
                name.value,
                ast.unparse(answer) if answer else "",
                ast.unparse(own) if own else "",
            )
            found.append((node.lineno, node.col_offset, what, call))
    for _, _, what, call in sorted(found, key=lambda each: each[:2]):
        yield what, call


def _tree(source: str) -> ast.AST:
    """A cell as Python's tree. Only where it is none, its lines of Jupyter's (`%time`) are left
    out. SyntaxError, ValueError, RecursionError: still none.
    """
    flags = ast.PyCF_ONLY_AST | ast.PyCF_ALLOW_TOP_LEVEL_AWAIT
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            tree: ast.AST = compile(source, "cell", "exec", flags)
        except SyntaxError:
            rest = re.sub(r"^([ \t]*)(?:[%!].*|[^#'\"\n]*\?)$", r"\1pass", source, flags=re.M)
            tree = compile(rest, "cell", "exec", flags)
    return tree
