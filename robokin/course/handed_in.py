"""Read a handed-in notebook without running it: the exercises and predictions that it answers, the
answers, and the verdicts in its outputs.

The notebook may contain anything. If it cannot be used, a ValueError gives the reason. The time for
reading is proportional to its size. We do not use nbformat, which can take minutes for a megabyte;
the result is a valid notebook with only the parts that we use.
"""

import ast
import html
import json
import os
import re
import threading
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import nbformat

from .._validate import short
from .book import home, ids, lab_of, labs
from .texts import ALL_BUT_HALVES, all_visible

NONE = "your name"  # the placeholder for the student's name in the labs
CLAIM = re.compile(r"\b(\w+\.\w+): (holds|does not hold|not answered yet|not judged)\.")
# calls to `check` in a cell that is not valid Python
CHECKED = re.compile(r"""check\(\s{0,99}["'](\w{1,99}\.\w{1,99})["']""")
SIZE = 20_000_000  # maximum number of bytes in a notebook
CODE = 100_000  # maximum number of characters in a cell that is parsed as Python
ALL_CODE = 5 * CODE  # maximum number of characters in all cells that are parsed as Python


CALLS = ("check", "predict", "report")


class Call(NamedTuple):
    """A call of `check` or `predict` in cell number `cell`. `answer` is the answer or the choice,
    and `own` is the argument `who`; both are source text, or "" if missing.
    """

    cell: int
    name: str
    answer: str
    own: str


@dataclass(frozen=True)
class HandedIn:
    """A student's notebook.

    lab      the lab whose exercises and predictions it contains, or None
    asked    the predictions in the notebook
    checks   the last call for each exercise, which is the one that counts
    choices  the last call with a choice for each prediction
    broken   the ids of exercises that are checked in cells that are not valid Python, with the
             reasons
    guesses  the line of guesses copied from a page, in the last call of `report` that has one
    strange  the names of other exercises that the notebook checks, which the student has made
    """

    path: Path
    notebook: Any
    lab: str | None
    asked: tuple[str, ...]
    checks: dict[str, Call]
    choices: dict[str, Call]
    broken: dict[str, str]
    guesses: str = ""
    strange: tuple[str, ...] = ()

    @property
    def title(self) -> str:
        """The first heading, or the name of the file."""
        for cell in self.notebook.cells:
            found = re.search(r"^# +(\S.*)$", cell.source, re.M)
            if cell.cell_type == "markdown" and found:
                return found[1].strip()[:200]
        return os.fsencode(self.path.stem).decode(errors="replace")


def handed_in(path: Path) -> HandedIn:
    """Read a notebook. The ids in it determine its lab, since the file may have any name; if it has
    no ids, the file name determines the lab. Raises ValueError if it is not a notebook or cannot be
    read.
    """
    notebook = _notebook(path)
    checks: dict[str, Call] = {}
    choices: dict[str, Call] = {}
    broken: dict[str, str] = {}
    named: list[str] = []
    strange: dict[str, None] = {}
    guesses, room = "", ALL_CODE
    for k, cell in enumerate(notebook.cells):
        if cell.cell_type != "code" or not any(word in cell.source for word in CALLS):
            continue
        size = len(cell.source)
        try:
            if size > min(CODE, room):
                raise ValueError(f"{size} characters is too many")
            room -= size
            calls = list(_calls(cell.source, k))
        except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
            calls = []
            reason = str(error)[:300] or "nested too deeply"
            for name in set(CHECKED.findall(cell.source)):
                if _known(name, "exercises"):
                    broken[name] = f"{type(error).__name__}: {reason}"
        for what, call in calls:
            if what == "report":
                guesses = call.answer or guesses
                continue
            if not _known(call.name, "exercises" if what == "check" else "predictions"):
                if what == "check":
                    strange[call.name] = None
                continue
            named.append(call.name)
            if what == "check":
                checks[call.name] = call
                broken.pop(call.name, None)
            elif call.answer not in ("", "None"):
                choices[call.name] = call
    in_name = (slug for slug in labs() if slug in path.stem.lower())
    lab_ = lab_of([*named, *broken]) or next(in_name, None)
    asked = tuple(name for name in dict.fromkeys(named) if _known(name, "predictions"))
    return HandedIn(path, notebook, lab_, asked, checks, choices, broken, guesses, tuple(strange))


def claims(notebook: Any, checks: dict[str, Call]) -> dict[str, str]:
    """The verdicts in the outputs, by exercise id. They come from the cell with the call that
    counts, if it shows any, otherwise from all cells. The verdict is "holds" if any of them is.
    """
    found: dict[str, str] = {}
    last = {(call.name, call.cell) for call in checks.values()}
    claimed = [
        (name, k, word) for k, cell in enumerate(notebook.cells) for name, word in _claimed(cell)
    ]
    at_last = {name for name, k, _ in claimed if (name, k) in last}
    for name, k, word in claimed:
        if (name not in at_last or (name, k) in last) and found.get(name) != "holds":
            found[name] = word
    return found


# --- Reading the file -----------------------------------------------------------------------------


def _notebook(path: Path) -> Any:
    try:
        size = path.stat().st_size
        if size > SIZE:
            raise ValueError(f"wanted at most {SIZE} bytes, got {size}")
        raw = all_visible(json.loads(path.read_text(encoding="utf-8-sig")), ALL_BUT_HALVES)
        if not isinstance(raw, dict) or raw.get("nbformat") != 4:
            version = short(raw.get("nbformat")) if isinstance(raw, dict) else "none"
            raise ValueError(f"nbformat: wanted 4, got {version}")
        if not isinstance(raw.get("cells"), list):
            raise ValueError("it has no cells")
        cells = [_cell(each, k) for k, each in enumerate(raw["cells"], 1)]
    except OSError as error:
        raise ValueError(str(error.strerror)) from None
    except RecursionError:
        raise ValueError("not a notebook: nested too deeply") from None
    except MemoryError:
        raise ValueError("not a notebook: too large to fit in memory") from None
    except ValueError as error:
        raise ValueError(f"not a notebook: {str(error)[:300]}") from None
    return nbformat.from_dict(
        {"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": cells},
    )


def _cell(raw: Any, k: int) -> dict[str, Any]:
    """The parts of a cell that we use, valid for nbformat 4.5. Raises ValueError if it is not a
    cell.
    """
    kind = raw.get("cell_type") if isinstance(raw, dict) else None
    if kind not in ("code", "markdown", "raw"):
        raise ValueError(f"cell {k}: wanted code, markdown or raw text, got {short(kind)}")
    source = _text(raw.get("source"))
    if source is None:
        raise ValueError(f"cell {k}: wanted text, got {short(raw.get('source'))}")
    folded = _get(_get(raw.get("metadata"), "jupyter"), "source_hidden") is True
    made = {"id": f"cell-{k}", "cell_type": kind, "source": source}
    made["metadata"] = {"jupyter": {"source_hidden": True}} if folded else {}
    if kind == "code":
        return made | {"execution_count": None, "outputs": list(_outputs(raw.get("outputs")))}
    attached = raw.get("attachments")
    files = attached.items() if isinstance(attached, dict) else ()
    return made | {"attachments": {name: _texts(file) for name, file in files}}


def _outputs(raw: Any) -> Iterator[dict[str, Any]]:
    """The stored outputs that are or contain text."""
    for each in raw if isinstance(raw, list) else ():
        kind = _get(each, "output_type")
        if kind == "stream":
            name = "stderr" if each.get("name") == "stderr" else "stdout"
            yield {"output_type": kind, "name": name, "text": _text(each.get("text")) or ""}
        elif kind in ("display_data", "execute_result"):
            count = {"execution_count": None} if kind == "execute_result" else {}
            yield {"output_type": kind, "metadata": {}, "data": _texts(each.get("data")), **count}


def _get(value: Any, name: str) -> Any:
    return value.get(name) if isinstance(value, dict) else None


def _text(value: Any) -> str | None:
    if isinstance(value, list) and all(isinstance(line, str) for line in value):
        return "".join(value)
    return value if isinstance(value, str) else None


def _texts(value: Any) -> dict[str, str]:
    """The text representations of an output or a file, by MIME type."""
    forms = value.items() if isinstance(value, dict) else ()
    return {kind: text for kind, form in forms if (text := _text(form)) is not None}


# --- Verdicts and calls in cells ------------------------------------------------------------------


def _claimed(cell: Any) -> Iterator[tuple[str, str]]:
    for output in cell.get("outputs", ()):
        data = output.get("data", {})
        shown = re.sub("<[^<>]*>", "\n", str(data.get("text/html", "")))
        try:
            shown = html.unescape(shown)
        except ValueError:  # a character reference with thousands of digits
            shown = ""
        yield from CLAIM.findall(f"{output.get('text', '')}\n{data.get('text/plain', '')}\n{shown}")


def _known(name: str, what: str) -> bool:
    """Return whether an exercise (`what` is "exercises") or a prediction with this id exists."""
    return home(name) in labs() and name in ids(home(name), what)


def _calls(source: str, cell: int) -> Iterator[tuple[str, Call]]:
    """Yield ("check" or "predict", Call) for each call with a literal id, in order, and
    ("report", Call), whose answer is the line of guesses. Calls inside the arguments of another
    call are skipped.
    """
    found = []
    todo: list[ast.AST] = [_tree(source)]
    while todo:
        node = todo.pop()
        call = _call(node, cell) if isinstance(node, ast.Call) else None
        if call:
            found.append((node.lineno, node.col_offset, *call))  # type: ignore[attr-defined]
        else:
            todo += ast.iter_child_nodes(node)
    for _, _, what, call_ in sorted(found, key=lambda each: each[:2]):
        yield what, call_


def _call(node: ast.Call, cell: int) -> tuple[str, Call] | None:
    f = node.func
    what = f.id if isinstance(f, ast.Name) else f.attr if isinstance(f, ast.Attribute) else ""
    if what == "report":
        line = next((each.value for each in node.keywords if each.arg == "guesses"), None)
        if isinstance(line, ast.Constant) and isinstance(line.value, str):
            return what, Call(cell, "", line.value, "")
    if what not in ("check", "predict"):
        return None
    names = ("name", "answer", "who") if what == "check" else ("name", "choice")
    arguments = dict(zip(names, node.args, strict=False))
    arguments |= {str(each.arg): each.value for each in node.keywords if each.arg in names}
    asked = arguments.get("name")
    name = asked.value if isinstance(asked, ast.Constant) else None
    if what == "check" and asked is not None and not isinstance(name, str):
        name = ast.unparse(asked)[:60]  # the student's own exercise
    if not isinstance(name, str):
        return None
    answer, own = arguments.get(names[1]), arguments.get("who")
    return what, Call(
        cell,
        name,
        ast.unparse(answer) if answer else "",
        ast.unparse(own) if own else "",
    )


_parsing = threading.Lock()  # Python's warning filters are shared by all threads


def _tree(source: str) -> ast.AST:
    """The syntax tree of a cell. If it does not parse, its IPython magics (`%time`) are left out.
    Raises SyntaxError, ValueError, RecursionError or MemoryError if it still does not parse.
    """
    flags = ast.PyCF_ONLY_AST | ast.PyCF_ALLOW_TOP_LEVEL_AWAIT
    with _parsing, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            tree: ast.AST = compile(source, "cell", "exec", flags)
        except SyntaxError:
            rest = "\n".join(map(_without_magic, source.split("\n")))
            tree = compile(rest, "cell", "exec", flags)
    return tree


def _without_magic(line: str) -> str:
    words = line.lstrip(" \t")
    asks = words.endswith("?") and not any(mark in words for mark in "#'\"")
    return f"{line[: len(line) - len(words)]}pass" if asks or words[:1] in ("%", "!") else line
