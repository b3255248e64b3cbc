"""Judge a handed-in notebook again: its cells run in a fresh kernel, in order, in a separate
folder, and the answers in its calls to `check` are judged there with the package's own `check`.

A cell that raises an error does not stop the others. A cell that takes too long is interrupted. A
cell that cannot be interrupted, or that kills the kernel, is left out, and all others run again in
a new kernel. This protects against accidents, but it is not a sandbox: cells may read files and use
the network with the permissions of the judging user, and a student can forge a verdict
(`kernel.py`).
"""

import asyncio
import contextlib
import functools
import json
import math
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Coroutine
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import nbformat

from .book import find, ids
from .guesses import Guess as Guess
from .guesses import guesses as guesses
from .handed_in import NONE, Call, HandedIn, claims
from .process import SLOWER, TEXT, Ended, Kernel, running, shortened
from .texts import ALL_BUT_HALVES, all_visible
from .variants import normalised

TIMES = 5  # maximum number of restarts of a kernel
BESIDE = ("tasks", "images")  # folders that labs read from
LARGE = 50_000_000  # files next to a lab with this many bytes or more are not copied


class Limits(NamedTuple):
    """Limits on the CPU time of a cell, of an answer and in total, in seconds, and on memory, in
    bytes.
    """

    cell: float = 60
    answer: float = 120
    all: float = 600
    memory: int = 4 * 2**30


LIMITS = Limits()


@dataclass(frozen=True)
class Result:
    """The result of an exercise.

    state  "holds", "does not hold", "unanswered", "failed" (there is no answer to judge: a cell
           raises, is stopped, ...) or "not judged" (the machine was too slow)
    """

    id: str
    task: str
    objective: int
    state: str = "unanswered"
    mistake: str | None = None
    says: tuple[str, ...] = ()
    case: str | None = None
    points: float = 0.0


@dataclass(frozen=True)
class Judged:
    """The result of judging a notebook: the notebook with new outputs, verdicts and remarks."""

    notebook: Any
    exercises: tuple[Result, ...]
    predictions: tuple[Guess, ...]
    remarks: tuple[str, ...]


def judge_notebook(handed: HandedIn, who: str | None, limits: Limits = LIMITS) -> Judged:
    """Run a notebook and judge its answers. An exercise that gives each student their own numbers
    uses those of the student `who` or, if this is None, of the name in the notebook. Several
    threads may judge at the same time. Raises OSError if a kernel cannot be started.
    """
    notebook = nbformat.from_dict(handed.notebook)
    names = ids(handed.lab, "exercises") if handed.lab else []
    checks = {name: call for name, call in handed.checks.items() if name in names}
    before = claims(notebook, checks)
    run = NotebookRun(notebook, checks, who, limits)
    with tempfile.TemporaryDirectory(prefix="robokin", ignore_cleanup_errors=True) as folder:
        place = Path(folder, "lab")
        _furnish(place, handed)
        _complete(lambda: run.all(place))
    exercises = tuple(run.result(name, handed.broken) for name in names)
    remarks = [*run.remarks, *_differences(exercises, before, claims(notebook, checks))]
    others = [name for name in handed.checks if name not in names]
    if others:
        remarks.append(f"Left out, since they belong to other labs: {', '.join(others)}.")
    remarks += [
        f"{name}: not judged, since it is not an exercise of a lab." for name in handed.strange[:20]
    ]
    made = guesses(handed, remarks)
    return Judged(notebook, exercises, made, tuple(remarks))


class NotebookRun:
    """One run of a notebook's cells. After `all`, the notebook has its outputs, and `result` and
    `remarks` give the findings.
    """

    def __init__(
        self, notebook: Any, checks: dict[str, Call], who: str | None, limits: Limits
    ) -> None:
        self.notebook, self.checks, self.who, self.limits = notebook, checks, who, limits
        self.found: dict[str, dict[str, Any]] = {}  # the kernel's reply for each exercise
        self.notes: dict[int, str] = {}  # the reasons why cells are left out
        self.stopped: dict[int, str] = {}  # what happened to the cells that were stopped
        self.slow: set[int] = set()  # cells that the wall-clock limit stopped
        self.cut: set[int] = set()  # cells with too much output
        self.remarks: list[str] = []
        self.used = 0.0  # CPU time of the kernels that have ended

    async def all(self, place: Path) -> None:
        """Run the notebook in the folder `place`, with a new kernel whenever one dies."""
        self.end = time.monotonic() + SLOWER * self.limits.all
        memory = self.limits.memory if _limited() else 0
        if not memory:
            self.remarks.append("This system cannot limit memory: the cells ran without a limit.")
        for _ in range(TIMES + 1):
            self.stopped.clear()
            self.slow &= self.notes.keys()
            for k, cell in enumerate(self.notebook.cells):
                if cell.cell_type == "code" and k not in self.notes:
                    cell.outputs, cell.execution_count = [], None
            async with running(self.notebook, place, memory, self.cut) as kernel:
                done = await self._once(kernel)
                self.used += kernel.seconds()
            if done:
                break
        else:
            self.remarks.append(f"The kernel died {TIMES + 1} times; the rest did not run.")
        self._tell()

    async def _once(self, kernel: Kernel) -> bool:
        """Run all cells that are not left out. Return False if a cell killed the kernel; that cell
        is left out from now on.
        """
        for k, cell in enumerate(self.notebook.cells):
            if cell.cell_type != "code" or not cell.source.strip() or k in self.notes:
                continue
            left = self.limits.all - self.used - kernel.seconds()
            if left < 0:
                self.notes[k] = f"Not run: the {self.limits.all:g} s for all cells were used up."
            elif time.monotonic() > self.end:
                self.notes[k] = "Not run: the machine was too slow."
                self.slow.add(k)
            elif not await self._cell(kernel, k, cell, min(self.limits.cell, max(1.0, left))):
                return False
            else:
                for call in self.checks.values():
                    if call.cell == k and not await self._judge(kernel, call):
                        return False
        return True

    async def _cell(self, kernel: Kernel, k: int, cell: Any, limit: float) -> bool:
        """Run a cell. Return False if it killed the kernel; it is left out from now on."""
        ended = await kernel.run(cell, k, limit)
        if ended.slow:
            self.slow.add(k)
        what = _stopped(ended, limit)
        if ended.how in ("stopped", "unread"):
            self.stopped[k] = what
        elif ended.how != "in time":
            self.notes[k], cell.execution_count = what, None
            return False
        return True

    async def _judge(self, kernel: Kernel, call: Call) -> bool:
        """Judge the answer in a call. Return False if that killed the kernel; the answer is
        not judged again.
        """
        if "died" in self.found.get(call.name, {}) or self._too_slow(call):
            return True
        asked = {"name": call.name, "answer": call.answer, "own": call.own, "who": self.who}
        ended, answer = await kernel.ask(json.dumps(asked), self.limits.answer)
        found = _read(answer)
        if ended.how == "stopped":
            found = {"error": f"judging it was stopped after {self.limits.answer:g} s"}
        if ended.how in ("killed", "dead"):
            found = {"died": True, "error": "judging it ends the kernel"}
        self.found[call.name] = {"slow": True} | found if ended.slow else found
        return "died" not in found

    def _too_slow(self, call: Call) -> bool:
        """Return whether the wall-clock limit stopped the cell of the call, or an earlier cell that
        it may need.
        """
        return any(k <= call.cell for k in self.slow)

    def result(self, name: str, broken: dict[str, str]) -> Result:
        """Return the result of an exercise."""
        exercise = find(name, "exercises")
        blank = Result(name, exercise.task, exercise.objective)
        found, call = self.found.get(name), self.checks.get(name)
        if name in broken:
            says = f"Its cell cannot be read as Python: {broken[name]}."
            return replace(blank, state="failed", says=(says,))
        if call is None:
            return replace(blank, says=("The notebook does not check it.",))
        if self._too_slow(call):
            says = "The machine was too slow for a cell that it may depend on (see the remarks)."
            return replace(blank, state="not judged", says=(says,))
        if found and "slow" in found:
            return replace(blank, state="not judged", says=("The machine was too slow.",))
        if found is None:
            says = self.notes.get(call.cell, "Its cell did not run.")
            return replace(blank, state="failed", says=(says,))
        if "error" in found:
            says = f"No answer to judge: {str(found['error'])[:300]}."
            return replace(blank, state="failed", says=(says,))
        try:
            return _verdict(blank, found["verdict"])
        except (KeyError, TypeError, ValueError):  # a notebook can imitate our reply
            return replace(
                blank, state="failed", says=("No answer to judge: this is not a verdict.",)
            )

    def _tell(self) -> None:
        """Record in the notebook and in the remarks what happened to cells."""
        happened = {**self.stopped, **self.notes}
        raised = []
        for k, cell in enumerate(self.notebook.cells):
            if cell.cell_type != "code":
                continue
            if shortened(cell):
                self.cut.add(k)
            errors = [o.ename[:100] for o in cell.outputs if o.output_type == "error"]
            if k in happened:
                text = f"{happened[k]}\n"
                cell.outputs.append(nbformat.v4.new_output("stream", name="stderr", text=text))
                self.remarks.append(f"{_called(cell, k)}: {happened[k]}")
            elif errors:
                raised.append(f"{_called(cell, k)} ({errors[0]})")
        if raised:
            self.remarks.append(f"Cells that raise an error: {', '.join(raised)}.")
        for k in sorted(self.cut):
            cell = _called(self.notebook.cells[k], k)
            self.remarks.append(f"{cell}: its output was too long and is shortened here.")
        for name, found in self.found.items():
            own = found.get("own")
            if not isinstance(own, str) or not getattr(find(name, "exercises"), "given", None):
                continue
            own = own.strip()[:100] or NONE
            if self.who is None:
                self.remarks.append(f"{name}: judged with the numbers of {own!r}.")
            elif normalised(own) != normalised(self.who):
                self.remarks.append(
                    f"{name}: the notebook uses the numbers of {own!r}, not of {self.who!r}."
                )


def _complete(work: Callable[[], Coroutine[Any, Any, None]]) -> None:
    """Run `work` to its end in another thread, because this one may have a running event loop, as
    in a kernel.
    """
    tasks: list[Any] = []

    async def task() -> None:
        tasks.append(asyncio.current_task())
        await work()

    with ThreadPoolExecutor(1) as pool:
        done = pool.submit(lambda: asyncio.run(task()))
        try:
            done.result()
        except KeyboardInterrupt:
            for each in tasks:
                each.get_loop().call_soon_threadsafe(each.cancel)
            raise


def _stopped(ended: Ended, limit: float) -> str:
    """Return a sentence that says what happened to a cell."""
    if ended.how == "dead":
        return "The kernel died in this cell. The other cells ran without it."
    if ended.how == "unread":
        return "Its output could not be read completely."
    says = f"Stopped after {limit:g} s"
    if ended.slow:
        says = f"Stopped after {SLOWER * limit:g} s by the clock"
    if ended.how == "killed":
        says += ": only ending the kernel stopped it. The other cells ran without it"
    return (
        f"{says}. The machine was too slow, or the cell was waiting." if ended.slow else f"{says}."
    )


def _read(answer: Any) -> dict[str, Any]:
    """Parse the reply from a kernel. It may be any text, since cells share the kernel with the
    checks.
    """
    with contextlib.suppress(ValueError, TypeError, RecursionError):
        found = all_visible(json.loads(answer), ALL_BUT_HALVES)
        if isinstance(found, dict):
            return found
    return {"error": "the kernel gave no answer"}


def _verdict(blank: Result, verdict: Any) -> Result:
    """Convert a verdict from the kernel to a result. Raises KeyError, TypeError or ValueError if it
    is not a verdict.
    """
    texts = {name: verdict[name] for name in ("mistake", "case")}
    says, points = verdict["says"], float(verdict["points"])
    every = [*says, *(text for text in texts.values() if text is not None)]
    if not (isinstance(says, list) and all(isinstance(text, str) for text in every)):
        raise TypeError("wanted strings")
    if not 0 <= points <= 1 or math.isnan(points):
        raise ValueError("wanted points from 0 to 1")
    state = "holds" if verdict["holds"] else "does not hold"
    return replace(
        blank,
        state=state if verdict["answered"] else "unanswered",
        says=tuple(text[:TEXT] for text in says[:100]),
        points=points,
        **{name: text and text[:TEXT] for name, text in texts.items()},
    )


@functools.cache
def _limited() -> bool:
    """Return whether this system can limit the memory of a process."""
    return sys.platform not in ("win32", "darwin")  # macOS does not enforce its limit


def _furnish(place: Path, handed: HandedIn) -> None:
    """Make a folder with copies of the notebook, of the folders that labs read, and of the files
    next to the notebook that it names. Files that cannot be copied are left out.
    """
    place.mkdir()
    named = "\n".join(cell.source for cell in handed.notebook.cells)
    for each in handed.path.parent.iterdir():
        with contextlib.suppress(OSError):
            if each.name in BESIDE and each.is_dir() and not each.is_symlink():
                shutil.copytree(each, place / each.name, symlinks=True, ignore=_unwanted)
            elif each == handed.path or (
                each.name in named and each.is_file() and each.stat().st_size < LARGE
            ):
                shutil.copyfile(each, place / each.name)


def _unwanted(folder: str, names: list[str]) -> list[str]:
    """The contents of a folder that are not copied: hidden ones, large files, and anything that is
    neither a file nor a folder.
    """
    unwanted = []
    for name in names:
        path = Path(folder, name)
        small = path.is_dir() or (path.is_file() and path.stat().st_size < LARGE)
        if name.startswith(".") or not small:
            unwanted.append(name)
    return unwanted


def _differences(
    exercises: tuple[Result, ...], before: dict[str, str], now: dict[str, str]
) -> list[str]:
    """Describe the differences between stored outputs and verdicts."""
    told = {"unanswered": "not answered yet"}
    remarks = []
    for each in exercises:
        if each.state == "not judged":
            continue
        mine = told.get(each.state, each.state)
        if each.id in before and before[each.id] != mine:
            remarks.append(
                f'{each.id}: the stored output says "{before[each.id]}"; judged again, it is '
                f'"{mine}".'
            )
        if now.get(each.id) == "holds" != mine:
            remarks.append(
                f'{each.id}: the notebook\'s own output says "holds"; the check says "{mine}".'
            )
    return remarks


def _called(cell: Any, k: int) -> str:
    count = cell.get("execution_count")
    return f"cell [{count}]" if count else f"cell {k + 1} of the file"
