"""`report(who)` in a lab writes the report of its own notebook.

A notebook's file contains the state at the last save, so it may lack changes that the student sees.
This module records which cells ran in this kernel and when, and compares them with the file.
"""

import json
import os
import re
import subprocess
import sys
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple

from .book import lab_of
from .guesses import own_notebook, parse_line
from .note import Note
from .reported import counted, report_data
from .variants import normalised

NAMELESS = "your name"  # the placeholder for the student's name in the labs
ASLEEP = "Put your name into who, save, and run this cell in JupyterLab: it writes your report."
IN_PAGE = 'Press "Download my notebook", open it in JupyterLab, and run this cell there.'
UNSAVED = "Save first (Ctrl+S), then run this cell again."
TOP = str(Path(__file__).resolve().parents[2])
START = (  # runs this copy of robokin, not one in the notebook's folder
    f"import sys; sys.path.insert(0, {TOP!r}); from robokin.course.__main__ import main; "
    "sys.path.pop(0); sys.exit(main())"
)
IDS = re.compile(r"""["'](\w+\.p?\d+)["']""")
CALL, ANSWER = re.compile(r"\breport\("), re.compile(r"\b(check|predict)\(|\b(def|class) ")


class Ran(NamedTuple):
    """A cell that was run, and the time when it ran, in seconds since 1970."""

    source: str
    when: float


_ran: list[Ran] = []  # cells that ran in this kernel


def watch() -> None:
    """Record the cells that run in this kernel from now on. Earlier cells are recorded as if they
    ran now.
    """
    shell = _shell()
    if shell is None:
        return

    def note(info: Any) -> None:
        _ran.append(Ran(info.raw_cell, time.time()))

    _ran.extend(Ran(source, time.time()) for source in shell.history_manager.input_hist_raw)
    shell.events.register("pre_run_cell", note)


def report(who: Any, guesses: str | None = None, notebook: Any = None) -> Note:
    """Run this notebook again, judge its answers, and write the report to hand in next to it. The
    returned note gives the name of the report, or the reason why there is none.

    who       the student's name
    guesses   the line copied from the exported page of this lab: "p1 b, p3 a"
    notebook  the notebook's file; needed only if it cannot be determined

    No exception escapes. Nothing happens if `who` is still the placeholder, or outside JupyterLab
    and VS Code, where the notebook is only being executed.
    """
    name = str(who).strip()
    seen = own_notebook()
    if sys.platform == "emscripten":
        return Note(IN_PAGE)
    if (
        "ROBOKIN_JUDGE" in os.environ
        or who in (None, ...)
        or not name
        or normalised(name) == NAMELESS
        or not (seen or notebook)
    ):
        return Note(ASLEEP)
    try:
        if guesses is not None:
            parse_line(guesses)
        path = _notebook(seen, notebook)
        return Note(UNSAVED) if _unsaved(path, guesses) else _written(path, name)
    except (ValueError, TypeError, OSError) as error:
        return Note(f"No report: {error}")
    except KeyboardInterrupt:
        return Note("Stopped: no report was written.")


def _shell() -> Any:
    """The IPython shell in which this code runs, or None."""
    ipython = sys.modules.get("IPython")
    return ipython.get_ipython() if ipython else None


def _notebook(seen: Path | None, path: Any) -> Path:
    """The notebook's file. Raises ValueError if there is none or there are several candidates."""
    if path is not None:
        if not Path(path).is_file():
            raise ValueError(f"there is no file {str(path)!r} in {str(Path.cwd())!r}.")
        return Path(path).absolute()
    if seen is not None and seen.is_file():
        return seen.absolute()
    lab = _lab(source for source, _ in _ran)
    found = [path for path in sorted(Path.cwd().glob("*.ipynb")) if _may_be(path, lab)]
    if len(found) == 1:
        return found[0]
    names = ", ".join(path.name for path in found) or "no notebook with this lab's exercises"
    raise ValueError(
        'which file is this notebook? Pass its name: report(who, notebook="NAME.ipynb"). '
        f"Its folder contains {names}."
    )


def _may_be(path: Path, lab: str | None) -> bool:
    try:
        return lab is None or _lab(_cells(path)) == lab
    except (ValueError, OSError):
        return False


def _lab(sources: Iterable[str]) -> str | None:
    """The lab whose ids occur most often in these cells."""
    return lab_of(name for source in sources for name in IDS.findall(source))


def _cells(path: Path) -> list[str]:
    """The text of the code cells in a file. Raises ValueError if it is not a notebook."""
    try:
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
    except (ValueError, KeyError, TypeError, RecursionError):
        raise ValueError(f"{path.name} is not a notebook.") from None


def _unsaved(path: Path, guesses: str | None) -> bool:
    """Return whether a cell that ran after the file was saved is missing from it in that form. If a
    cell ran before and is missing, it was changed or deleted later, so the file is up to date.
    """
    saved = path.stat().st_mtime
    kept = {"", *(source.strip() for source in _cells(path))}
    return any(
        when > saved and source.strip() not in kept
        for source, when in _ran
        # this cell itself need not be saved, unless it contains guesses to read
        if guesses is not None or not CALL.search(source) or ANSWER.search(source)
    )


def _written(path: Path, who: str) -> Note:
    """Write the report in a separate process, so that this kernel is not changed. The process ends
    if the cell is interrupted. Raises ValueError, with the reason, if there is no report.
    """
    print("Running your lab again. This can take a few minutes on a slow machine.", flush=True)
    command = [sys.executable, "-P", "-X", "utf8", "-c", START, "report", str(path)]
    child = subprocess.Popen(
        [*command, f"--name={who}", "--to", str(path.parent)],
        cwd=path.parent,
        env={**os.environ, "ROBOKIN_JUDGE": "1"},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        errors="replace",
    )
    try:
        said, complaint = _outputs(child)
    except KeyboardInterrupt:  # some front ends interrupt the child process as well
        _end(child)
        raise
    if child.returncode:
        lines = complaint.strip().removeprefix(f"{path}: ").splitlines()
        raise ValueError(lines[-1] if lines else f"it ended with status {child.returncode}.")
    page = path.parent / Path(said.strip().rpartition(":")[0]).name
    empty: dict[str, Any] = {"exercises": [], "predictions": [], "remarks": []}
    data = report_data(page.read_text(encoding="utf-8")) or empty
    lines = [f"{page.name} is your report, next to this notebook. Look at it, and hand it in."]
    lines.append("In JupyterLab, press Trust HTML to make it move; any browser can open the file.")
    for each in data["exercises"]:
        lines.append(f"{each['id']}: {each['state']}")
        if each["state"] in ("failed", "not judged"):
            lines[-1] += f". {each['says'][0]}"
    asked = counted(data)
    made = sum(each["choice"] is not None for each in asked)
    lines.append(f"{made} of {len(asked)} predictions made")
    if made < len(asked):  # a guess from the page waits while the kernel runs all cells
        lines[-1] += ". Is a guess missing? Run this cell once more."
    lines += data["remarks"]
    note = Note("\n".join(lines))
    note.file = page.name
    return note


def _outputs(child: "subprocess.Popen[str]") -> tuple[str, str]:
    """Wait for the process to end and return what it wrote to stdout and stderr."""
    while True:
        try:
            return child.communicate(timeout=0.5)  # on Windows, a longer wait cannot be interrupted
        except subprocess.TimeoutExpired:
            pass


def _end(child: "subprocess.Popen[str]") -> None:
    try:
        child.wait(5)
    except subprocess.TimeoutExpired:
        child.kill()
        child.wait()
