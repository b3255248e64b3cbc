"""A handed-in notebook judged anew: its cells run in a fresh kernel, in order, in a folder of their
own, and what stands in its calls of `check` is judged there with the package's own `check`.

A cell that raises does not stop the others; one that takes too long is interrupted; one that cannot
be interrupted, or that kills the kernel, is left out, and all others run again in a new one. This
protects from accidents. It is no sandbox: cells may read files and use a network as the user who
judges, and `kernel.py` says how far a verdict can be trusted.
"""

import asyncio
import functools
import json
import logging
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Awaitable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import nbformat
from jupyter_client.kernelspec import KernelSpec, KernelSpecManager
from jupyter_client.manager import AsyncKernelManager
from nbclient import NotebookClient
from nbclient.exceptions import DeadKernelError
from nbclient.util import run_sync

from .book import find, lab
from .guesses import Guess as Guess
from .guesses import guesses as guesses
from .handed_in import NONE, Call, HandedIn, claims
from .variants import normalised

TEXT = 5_000  # characters of text that a cell may leave in the page
ROOM = 2_000_000  # characters of pictures, players and the like
TIMES = 5  # as often a kernel is started again
BESIDE = ("tasks", "images")  # folders that labs read from
LARGE = 50_000_000  # bytes of a file beside a lab
TOP = str(Path(__file__).resolve().parents[2])
START = (  # this robokin, whichever one is installed, and none from the folder of the notebook
    f"import sys; sys.path.insert(0, {TOP!r}); from robokin.course.kernel import main; "
    "sys.path.append(sys.path.pop(0)); main({memory})"
)


class Limits(NamedTuple):
    """Seconds for a cell and for an answer's judgement, seconds for all, bytes of memory."""

    cell: float = 60
    all: float = 600
    memory: int = 4 * 2**30


LIMITS = Limits()


@dataclass(frozen=True)
class Result:
    """What came of an exercise.

    state  "holds", "does not hold", "unanswered", "failed" (there is no answer to judge: a cell
           raises, is stopped, ...) or "not judged" (the notebook changes the package)
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
    """What came of a notebook: the notebook with new outputs, verdicts and remarks."""

    notebook: Any
    exercises: tuple[Result, ...]
    predictions: tuple[Guess, ...]
    remarks: tuple[str, ...]


def judge(given: HandedIn, who: str | None, limits: Limits = LIMITS) -> Judged:
    """Run a notebook and judge its answers. For an exercise with numbers of one's own these are
    those of the student `who`; None: of the name that the notebook gives itself.
    """
    notebook = nbformat.from_dict(given.notebook)
    names = _ids(given.lab, "EXERCISES")
    checks = {name: call for name, call in given.checks.items() if name in names}
    before = claims(notebook, checks)
    run = Run(notebook, checks, who, limits)
    with tempfile.TemporaryDirectory(prefix="robokin", ignore_cleanup_errors=True) as folder:
        place = Path(folder, "lab")
        _furnish(place, given)
        run_sync(run.all)(place)
    exercises = tuple(run.result(name, given.broken) for name in names)
    remarks = [*run.remarks, *_differences(exercises, before, claims(notebook, checks))]
    others = [name for name in given.checks if name not in names]
    if others:
        remarks.append(f"Of other labs, and left out here: {', '.join(others)}.")
    made = guesses(given, remarks)
    return Judged(notebook, exercises, made, tuple(remarks))


class Client(NotebookClient):
    """nbclient's, which stops listening where a cell shows too much. `cut`: those cells."""

    def __init__(self, *given: Any, cut: set[int], **more: Any) -> None:
        super().__init__(*given, **more)
        self.cut = cut

    def output(self, outs: Any, msg: Any, display_id: Any, cell_index: int) -> Any:
        if msg["msg_type"] != "error" and (len(outs) > 100 or sum(map(_size, outs)) > ROOM):
            self.cut.add(cell_index)
            return None
        return super().output(outs, msg, display_id, cell_index)


class Specs(KernelSpecManager):
    """Knows one kernel: ours, run by the Python that runs this."""

    memory = 0

    def get_kernel_spec(self, kernel_name: str) -> KernelSpec:
        start = START.replace("{memory}", str(self.memory))
        argv = [sys.executable, "-P", "-c", start, "-f", "{connection_file}"]
        return KernelSpec(argv=argv, display_name="robokin", language="python")


class Run:
    """Cells that run, and what is found meanwhile. After `all`: outputs in the notebook, `result`
    and `remarks`.
    """

    def __init__(
        self, notebook: Any, checks: dict[str, Call], who: str | None, limits: Limits
    ) -> None:
        self.notebook, self.checks, self.who, self.limits = notebook, checks, who, limits
        self.found: dict[str, dict[str, Any]] = {}  # id -> what the kernel answered
        self.notes: dict[int, str] = {}  # cell -> why it is left out
        self.stopped: dict[int, str] = {}  # cell -> what happened to it
        self.cut: set[int] = set()  # cells that say too much
        self.remarks: list[str] = []

    async def all(self, place: Path) -> None:
        """Run the notebook in the folder `place`, in a new kernel as often as one dies."""
        self.end = time.monotonic() + self.limits.all
        memory = self.limits.memory if _limited() else 0
        if not memory:
            self.remarks.append("This system has no limit of memory: the cells ran without one.")
        for _ in range(TIMES + 1):
            self.stopped.clear()
            for k, cell in enumerate(self.notebook.cells):
                if cell.cell_type == "code" and k not in self.notes:
                    cell.outputs, cell.execution_count = [], None
            specs = Specs()
            specs.memory = memory
            manager = AsyncKernelManager(kernel_name="robokin", kernel_spec_manager=specs)
            if await self._once(place, manager):
                break
        else:
            self.remarks.append(f"The kernel died {TIMES + 1} times; the rest did not run.")
        self._tell()

    async def _once(self, place: Path, manager: AsyncKernelManager) -> bool:
        """Run all cells that are not left out. False: one killed the kernel and is now left out."""
        client = Client(
            self.notebook,
            cut=self.cut,
            km=manager,
            timeout=None,
            allow_errors=True,
            coalesce_streams=True,
            record_timing=False,
            log=_silent(),
        )
        quiet = {"stdout": asyncio.subprocess.DEVNULL, "stderr": asyncio.subprocess.DEVNULL}
        environment = {**_environment(), "IPYTHONDIR": str(place.parent / "ipython")}
        try:
            try:
                await client.async_start_new_kernel(cwd=str(place), env=environment, **quiet)
                await client.async_start_new_kernel_client()
            except RuntimeError as error:
                raise OSError(f"no kernel: {error}") from None
            for k, cell in enumerate(self.notebook.cells):
                if cell.cell_type != "code" or not cell.source.strip() or k in self.notes:
                    continue
                if time.monotonic() > self.end:
                    self.notes[k] = f"Not run: the {self.limits.all:.0f} s for all were over."
                    continue
                if not await self._cell(client, manager, k, cell):
                    return False
                for call in self.checks.values():
                    if call.cell == k and not await self._judge(client, manager, call):
                        return False
            return True
        finally:
            if client.kc is not None:
                client.kc.stop_channels()
            if manager.has_kernel:
                await manager.shutdown_kernel(now=True)

    async def _cell(self, client: Client, manager: AsyncKernelManager, k: int, cell: Any) -> bool:
        """Run a cell. False: it killed the kernel and is now left out."""
        seconds = min(self.limits.cell, max(1.0, self.end - time.monotonic()))
        ended = await _within(seconds, client.async_execute_cell(cell, k), manager)
        if self._capped(cell):
            self.cut.add(k)
        if ended == "in time":
            return True
        what = {
            "stopped": f"Stopped after {seconds:.0f} s.",
            "killed": f"Stopped after {seconds:.0f} s: nothing less than ending the kernel "
            "stopped it. The other cells ran without it.",
            "dead": "The kernel died in this cell. The other cells ran without it.",
            "unread": "Not all that it shows could be read.",
        }[ended]
        if ended in ("stopped", "unread"):
            self.stopped[k] = what
            return True
        self.notes[k], cell.execution_count = what, None
        return False

    async def _judge(self, client: Client, manager: AsyncKernelManager, call: Call) -> bool:
        """Judge the answer in a call. False: that killed the kernel; it is not tried again."""
        if "died" in self.found.get(call.name, {}):
            return True
        asked = {"name": call.name, "answer": call.answer, "own": call.own, "who": self.who}
        message = client.kc.execute(  # type: ignore[union-attr]
            "", silent=True, store_history=False, user_expressions={"judge": json.dumps(asked)}
        )
        replies: list[Any] = []

        async def wait() -> None:
            replies.append(await client.async_wait_for_reply(message))

        ended = await _within(self.limits.cell, wait(), manager)
        if ended in ("killed", "dead"):
            self.found[call.name] = {"died": True, "error": "judging it ends the kernel"}
            return False
        content = replies[0]["content"] if replies and replies[0] else {}
        found = content.get("user_expressions", {}).get("judge")
        odd = {"error": "the kernel gave no answer"}
        self.found[call.name] = found if isinstance(found, dict) else odd
        return True

    def result(self, name: str, broken: dict[str, str]) -> Result:
        """What came of an exercise."""
        exercise = find(name, "EXERCISES")
        blank = Result(name, exercise.task, exercise.objective)
        found, call = self.found.get(name), self.checks.get(name)
        if name in broken:
            says = f"Its cell is no Python: {broken[name]}."
            return replace(blank, state="failed", says=(says,))
        if call is None:
            return replace(blank, says=("Nowhere in the notebook is it checked.",))
        if found is None:
            says = self.notes.get(call.cell, "Its cell did not run.")
            return replace(blank, state="failed", says=(says,))
        if "changed" in found:
            says = f"The notebook changes the package ({', '.join(found['changed'])}): not judged."
            return replace(blank, state="not judged", says=(says,))
        if "error" in found:
            return replace(blank, state="failed", says=(f"No answer to judge: {found['error']}.",))
        try:
            verdict = found["verdict"]
            state = "holds" if verdict["holds"] else "does not hold"
            return replace(
                blank,
                state=state if verdict["answered"] else "unanswered",
                mistake=verdict["mistake"],
                says=tuple(verdict["says"]),
                case=verdict["case"],
                points=float(verdict["points"]),
            )
        except (KeyError, TypeError, ValueError):  # a notebook that answers for us
            return replace(blank, state="failed", says=("No answer to judge: it is no verdict.",))

    def _tell(self) -> None:
        """Put into the notebook and into the remarks what happened to cells."""
        happened = {**self.stopped, **self.notes}
        raised = []
        for k, cell in enumerate(self.notebook.cells):
            errors = [o.ename for o in cell.get("outputs", ()) if o.output_type == "error"]
            if k in happened:
                text = f"{happened[k]}\n"
                cell.outputs.append(nbformat.v4.new_output("stream", name="stderr", text=text))
                self.remarks.append(f"{_called(cell, k)}: {happened[k]}")
            elif errors:
                raised.append(f"{_called(cell, k)} ({errors[0]})")
        if raised:
            self.remarks.append(f"Cells that raise: {', '.join(raised)}.")
        for k in sorted(self.cut):
            cell = _called(self.notebook.cells[k], k)
            self.remarks.append(f"{cell}: what it shows was too much and is shortened here.")
        for name, found in self.found.items():
            own = found.get("own")
            if own is None or not getattr(find(name, "EXERCISES"), "given", None):
                continue
            if self.who is None:
                self.remarks.append(f"{name}: judged with the numbers of {own!r}.")
            elif normalised(own.strip() or NONE) != normalised(self.who):
                self.remarks.append(
                    f"{name}: the notebook uses the numbers of {own!r}, not of {self.who!r}."
                )

    def _capped(self, cell: Any) -> bool:
        """Shorten what a cell says; whether it was too long."""
        room, cut = TEXT, False
        kept: list[Any] = []
        for output in cell.outputs:
            if output.output_type == "stream":
                text = output.text
                if len(text) > room:
                    output.text, cut = text[:room] + "\n... shortened\n", True
                room = max(0, room - len(text))
            elif output.output_type == "error":
                lines = "\n".join(output.traceback)
                if len(lines) > 4 * TEXT or cut:  # colours are characters, too
                    output.traceback = [f"{output.ename}: {output.evalue[:500]}"]
                    output.evalue, cut = output.evalue[:500], True
            elif _size(output) > ROOM or len(kept) >= 100:
                cut = True
                continue
            kept.append(output)
        cell.outputs = kept
        return cut


async def _within(seconds: float, work: Awaitable[Any], manager: AsyncKernelManager) -> str:
    """Wait for the kernel's work: "in time", "stopped" by an interrupt, "killed", "dead", or
    "unread" where nbclient does not understand what comes.
    """
    task = asyncio.ensure_future(work)
    ended = "in time"
    try:
        done, _ = await asyncio.wait({task}, timeout=seconds)
        if not done:
            ended = "stopped"
            await manager.interrupt_kernel()
            done, _ = await asyncio.wait({task}, timeout=5)
        if not done:
            ended = "killed"
            await manager.shutdown_kernel(now=True)
            await asyncio.wait({task}, timeout=5)
        if not task.done():
            return ended
        task.result()
    except DeadKernelError:
        return "killed" if ended == "killed" else "dead"
    except Exception:  # a cell may send anything
        return "unread"
    finally:
        task.cancel()
    return ended


@functools.cache
def _limited() -> bool:
    """Whether this system limits the memory of a process."""
    return sys.platform not in ("win32", "darwin")  # macOS takes the limit and does not keep it


def _environment() -> dict[str, str]:
    # many threads reserve more memory than they use, and the limit counts what is reserved
    one = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
    return {**os.environ, **one}


def _silent() -> logging.Logger:
    log = logging.getLogger("robokin.judge")
    log.propagate = False
    log.setLevel(logging.CRITICAL + 1)
    return log


def _furnish(place: Path, given: HandedIn) -> None:
    """A folder with a copy of the notebook, of the folders that labs read from, and of the files
    beside it that it names.
    """
    place.mkdir()
    named = "\n".join(cell.source for cell in given.notebook.cells)
    for each in given.path.parent.iterdir():
        if each.is_dir() and each.name in BESIDE:
            shutil.copytree(each, place / each.name)
        elif each == given.path or (
            each.name in named and each.is_file() and each.stat().st_size < LARGE
        ):
            shutil.copyfile(each, place / each.name)


def _ids(slug: str | None, what: str) -> list[str]:
    return [f"{slug}.{n}" for n in getattr(lab(slug), what)] if slug else []


def _differences(
    exercises: tuple[Result, ...], before: dict[str, str], now: dict[str, str]
) -> list[str]:
    """Where outputs say something else than the verdict."""
    told = {"unanswered": "not answered yet"}
    remarks = []
    for each in exercises:
        mine = told.get(each.state, each.state)
        if each.id in before and before[each.id] != mine:
            remarks.append(
                f'{each.id}: the stored output says "{before[each.id]}"; worked out anew it is '
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


def _size(output: Any) -> int:
    """How many characters an output has, about."""
    if output.output_type == "stream":
        return len(output.text)
    if output.output_type == "error":
        return sum(map(len, output.traceback))
    return sum(len(str(value)) for value in output.data.values())
