"""`report(who)` in a lab: the report of the notebook in which it stands.

A notebook's file is as old as its last save, so it may lack what the student sees. What ran in this
kernel, and when, is noted here and compared with the file.
"""

import json
import os
import re
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple

from .book import labs
from .guesses import own_notebook, parse_line
from .note import Note
from .reported import counted, report_data
from .variants import normalised

NAMELESS = "your name"  # what the labs have where the student's name should stand
ASLEEP = "Put your name into who, save, and run this cell in JupyterLab: it writes your report."
UNSAVED = "Save first (Ctrl+S), then run this cell again."
TOP = str(Path(__file__).resolve().parents[2])
START = (  # this robokin, and none from the folder of the notebook
    f"import sys; sys.path.insert(0, {TOP!r}); from robokin.course.__main__ import main; "
    "sys.path.pop(0); sys.exit(main())"
)
IDS = re.compile(r"""["'](\w+)\.p?\d+["']""")
CALL, ANSWER = re.compile(r"\breport\("), re.compile(r"\b(check|predict)\(|\b(def|class) ")


class Ran(NamedTuple):
    """A cell that was run, and when: seconds since 1970."""

    source: str
    when: float


_ran: list[Ran] = []  # in this kernel


def watch() -> None:
    """From now on, note what runs in this kernel. What ran before counts as run now."""
    shell = _shell()
    if shell is None:
        return

    def note(info: Any) -> None:
        _ran.append(Ran(info.raw_cell, time.time()))

    _ran.extend(Ran(source, time.time()) for source in shell.history_manager.input_hist_raw)
    shell.events.register("pre_run_cell", note)


def report(who: Any, guesses: str | None = None, notebook: Any = None) -> Note:
    """Run this notebook anew, judge its answers, and write the report to hand in beside it. Shows
    the report's name, or what is in the way.

    who       the student's name
    guesses   the line that the exported page of this lab has copied: "p1 b, p3 a"
    notebook  its file, where that cannot be told

    Never raises. It does nothing with the name that the labs have, nor outside JupyterLab and
    VS Code, where a notebook is only executed.
    """
    name = str(who).strip()
    seen = own_notebook()
    if (
        "ROBOKIN_JUDGE" in os.environ
        or sys.platform == "emscripten"
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
    """IPython's shell in which this runs, or None."""
    ipython = sys.modules.get("IPython")
    return ipython.get_ipython() if ipython else None


def _notebook(seen: Path | None, path: Any) -> Path:
    """The notebook's file. ValueError: there is none, or several may be it."""
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
        'which file is this notebook? Say it: report(who, notebook="NAME.ipynb"). '
        f"In its folder there is {names}."
    )


def _may_be(path: Path, lab: str | None) -> bool:
    try:
        return lab is None or _lab(_cells(path)) == lab
    except (ValueError, OSError):
        return False


def _lab(sources: Iterable[str]) -> str | None:
    """The lab whose ids stand most often in these cells."""
    found = Counter(lab for source in sources for lab in IDS.findall(source) if lab in labs())
    return found.most_common(1)[0][0] if found else None


def _cells(path: Path) -> list[str]:
    """What stands in the code cells of a file. ValueError: it is no notebook."""
    try:
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
    except (ValueError, KeyError, TypeError, RecursionError):
        raise ValueError(f"{path.name} is not a notebook.") from None


def _unsaved(path: Path, guesses: str | None) -> bool:
    """Whether a cell ran after the file was saved, and is not in it as it ran. A cell that ran
    before and is not in it was changed or deleted since, and the file is right.
    """
    saved = path.stat().st_mtime
    kept = {"", *(source.strip() for source in _cells(path))}
    return any(
        when > saved and source.strip() not in kept
        for source, when in _ran
        # this very cell need not be saved, unless the guesses are to be read from it
        if guesses is not None or not CALL.search(source) or ANSWER.search(source)
    )


def _written(path: Path, who: str) -> Note:
    """Write the report in a process of its own, which an interrupt of the cell ends, and which
    leaves this kernel as it is. ValueError: why there is none.
    """
    print("Running your lab anew. This can take a minute.", flush=True)
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
    except KeyboardInterrupt:  # which the child gets as well, where the front end sends it to all
        _end(child)
        raise
    if child.returncode:
        lines = complaint.strip().removeprefix(f"{path}: ").splitlines()
        raise ValueError(lines[-1] if lines else f"it ended with status {child.returncode}.")
    page = path.parent / Path(said.strip().rpartition(":")[0]).name
    data = report_data(page.read_text(encoding="utf-8")) or {"exercises": [], "predictions": []}
    lines = [f"{page.name} is your report, beside this notebook. Look at it, and hand it in."]
    lines.append("In JupyterLab press Trust HTML, and it moves; any browser opens the file.")
    for each in data["exercises"]:
        lines.append(f"{each['id']}: {each['state']}")
        if each["state"] in ("failed", "not judged"):
            lines[-1] += f". {each['says'][0]}"
    asked = counted(data)
    made = sum(each["choice"] is not None for each in asked)
    lines.append(f"{made} of {len(asked)} predictions made")
    if made < len(asked):  # a page's guess waits while the kernel runs all cells
        lines[-1] += ". Is a guess missing? Run this cell once more."
    note = Note("\n".join(lines))
    note.file = page.name
    return note


def _outputs(child: "subprocess.Popen[str]") -> tuple[str, str]:
    """What a process says, when it has ended."""
    while True:
        try:
            return child.communicate(timeout=0.5)  # Windows interrupts no longer wait
        except subprocess.TimeoutExpired:
            pass


def _end(child: "subprocess.Popen[str]") -> None:
    try:
        child.wait(5)
    except subprocess.TimeoutExpired:
        child.kill()
        child.wait()
