"""Control a judging kernel from outside: start it, let it work within a time limit, and end it
together with all processes that it has started. `kernel.py` is the code that runs inside it.

Limits are in CPU time of the kernel and its child processes, so that no verdict depends on the load
of the machine. Sleeping takes no CPU time, so there is also a wall-clock limit, `SLOWER` times as
long.
"""

import asyncio
import contextlib
import functools
import logging
import os
import secrets
import sys
import threading
import time
from collections.abc import AsyncIterator, Awaitable
from pathlib import Path
from typing import Any, NamedTuple

import nbformat
import psutil
from jupyter_client.kernelspec import KernelSpec, KernelSpecManager
from jupyter_client.manager import AsyncKernelManager
from nbclient import NotebookClient
from nbclient.exceptions import DeadKernelError

from .texts import ALL_BUT_HALVES, all_visible

SLOWER = 10
GRACE = 5.0  # seconds after an interrupt before the kernel is killed
LOOK = 0.1  # minimum interval in seconds between two checks of the CPU time
START = 600  # wall-clock seconds for a kernel to start
LAST = 20  # wall-clock seconds for the output of a cell to arrive after its end
TEXT = 5_000  # maximum number of characters of text that a cell may show in the page
ROOM = 2_000_000  # maximum number of characters of pictures, players and similar outputs
MARK = "ROBOKIN_JUDGE"  # an environment variable with the same value in all processes of a kernel
TOP = str(Path(__file__).resolve().parents[2])
CODE = (  # runs this copy of robokin, even if another is installed or in the notebook's folder
    f"import sys; sys.path.insert(0, {TOP!r}); from robokin.course.kernel import main; "
    "sys.path.append(sys.path.pop(0)); main({memory})"
)
_starting = threading.Lock()  # jupyter_client's list of free ports is not thread-safe


class Ended(NamedTuple):
    """How a piece of work ended.

    how   "in time", "stopped" (by an interrupt), "killed" (with the kernel), "dead" (it killed the
          kernel) or "unread" (nbclient cannot read its messages)
    slow  whether it was stopped by the wall-clock limit rather than the CPU limit
    """

    how: str
    slow: bool = False


class Kernel:
    """A running kernel; `running` starts one."""

    def __init__(self, manager: AsyncKernelManager, client: "Client") -> None:
        self.manager, self.client = manager, client
        self.process = psutil.Process(manager.provisioner.pid)  # type: ignore[union-attr]
        self.used = 0.0

    def seconds(self) -> float:
        """The CPU time so far, including child processes."""
        used = 0.0
        with contextlib.suppress(psutil.Error):
            for each in (self.process, *self.process.children(recursive=True)):
                with contextlib.suppress(psutil.Error):
                    # the process's own time and that of its children that have ended
                    used += sum(each.cpu_times()[:4])
        self.used = max(self.used, used)  # the last value remains after the process has ended
        return self.used

    async def run(self, cell: Any, k: int, limit: float) -> Ended:
        """Run a cell and store its outputs in it. `limit` is CPU time in seconds."""
        return await self._within(limit, self.client.async_execute_cell(cell, k))

    async def ask(self, request: str, limit: float) -> tuple[Ended, Any]:
        """Return the reply of `judging` in the kernel, or None. `limit` is CPU time in seconds."""
        message = self.client.kc.execute(  # type: ignore[union-attr]
            "", silent=True, store_history=False, user_expressions={"judge": request}
        )
        replies: list[Any] = []

        async def wait() -> None:
            replies.append(await self.client.async_wait_for_reply(message))

        ended = await self._within(limit, wait())
        content = replies[0]["content"] if replies and replies[0] else {}
        return ended, (content.get("user_expressions") or {}).get("judge")

    async def _within(self, limit: float, work: Awaitable[Any]) -> Ended:
        task = asyncio.ensure_future(work)
        # without this, asyncio logs exceptions that are never retrieved
        task.add_done_callback(lambda ended: ended.cancelled() or ended.exception())
        how, slow = "in time", False
        try:
            for then in ("stopped", "killed"):
                late = await self._late(task, limit)
                if not late:
                    break
                how, slow, limit = then, slow or late == "by the clock", min(limit, GRACE)
                if how == "stopped":
                    await self.manager.interrupt_kernel()
                else:
                    await self.manager.shutdown_kernel(now=True)
                    await asyncio.wait({task}, timeout=GRACE)
            if task.done():
                task.result()
        except DeadKernelError:
            how = "killed" if how == "killed" else "dead"
        except Exception:  # a cell can send any message
            how = "unread"
        finally:
            task.cancel()
        return Ended(how, slow)

    async def _late(self, task: asyncio.Future[Any], limit: float) -> str:
        """Wait for the task and return "", or "CPU" or "by the clock" if its time is up."""
        computed, clock = self.seconds() + limit, time.monotonic() + SLOWER * limit
        while True:
            cpu, wall = computed - self.seconds(), clock - time.monotonic()
            if cpu < 0 or wall < 0:
                return "CPU" if cpu < 0 else "by the clock"
            pause = max(LOOK, min(cpu / (os.cpu_count() or 1), wall))
            done, _ = await asyncio.wait({task}, timeout=pause)
            if done:
                return ""


@contextlib.asynccontextmanager
async def running(notebook: Any, place: Path, memory: int, cut: set[int]) -> AsyncIterator[Kernel]:
    """Start a kernel for a notebook in the folder `place`. `memory` is its limit in bytes (0 means
    no limit); `cut` collects the cells with too much output. Raises OSError if the kernel does not
    start.
    """
    specs = Specs()
    specs.memory = memory
    manager = AsyncKernelManager(kernel_name="robokin", kernel_spec_manager=specs)
    client = Client(
        notebook,
        cut=cut,
        km=manager,
        timeout=None,
        startup_timeout=START,
        iopub_timeout=LAST,
        allow_errors=True,
        coalesce_streams=False,  # `Client` joins them: nbclient can take hours for a long line
        record_timing=False,
        log=_silent(),
    )
    mark = secrets.token_hex(16)
    more = {MARK: mark, "IPYTHONDIR": str(place.parent / "ipython")}
    # many threads reserve more memory than they use, and the limit counts reserved memory
    more |= dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
    quiet = {"stdout": asyncio.subprocess.DEVNULL, "stderr": asyncio.subprocess.DEVNULL}
    children: list[psutil.Process] = []
    try:
        try:
            with _starting:
                await client.async_start_new_kernel(cwd=str(place), env=os.environ | more, **quiet)
            kernel = Kernel(manager, client)
            await client.async_start_new_kernel_client()
        except RuntimeError as error:
            raise OSError(f"no kernel: {error}") from None
        yield kernel
        with contextlib.suppress(psutil.Error):
            children = kernel.process.children(recursive=True)
    finally:
        if client.kc is not None:
            client.kc.stop_channels()
        if manager.has_kernel:
            await manager.shutdown_kernel(now=True)
        for child in children:
            with contextlib.suppress(psutil.Error):
                child.kill()
        await _end_marked(mark)


async def _end_marked(mark: str) -> None:
    """End the processes with this mark, even in other sessions. A process that restarts
    itself can be missed, so we search until two searches in a row find none.
    """
    none, last = 0, time.monotonic() + 2 * GRACE
    while none < 2 and time.monotonic() < last:
        none += 1
        for pid in psutil.pids():
            with contextlib.suppress(psutil.Error, OSError):
                process = psutil.Process(pid)
                if process.environ().get(MARK) == mark:
                    process.kill()
                    none = 0
        await asyncio.sleep(0)


class Client(NotebookClient):
    """nbclient's client, which also joins the printed text of a cell and stops listening if there
    is too much output. `cut` collects the cells with too much output.
    """

    def __init__(self, *args: Any, cut: set[int], **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.cut = cut

    def output(self, outs: Any, msg: Any, display_id: Any, cell_index: int) -> Any:
        kind, content = msg["msg_type"], msg["content"]
        most = 110 if kind == "error" else 100
        if len(outs) > most or (kind != "error" and sum(map(_size, outs)) > ROOM):
            self.cut.add(cell_index)
            return None
        if kind == "stream":
            content["text"] = content["text"][: 4 * TEXT]
            same = [o for o in outs if o.output_type == kind and o.name == content["name"]]
            caught = self.output_hook_stack[msg["parent_header"].get("msg_id")]
            if same and not caught and not self.clear_before_next_output:
                same[0].text += content["text"][: max(0, 4 * TEXT - len(same[0].text))]
                return same[0]
        return super().output(outs, msg, display_id, cell_index)


class Specs(KernelSpecManager):
    """Provide only our kernel, run by this Python interpreter."""

    memory = 0

    def get_kernel_spec(self, kernel_name: str) -> KernelSpec:
        code = CODE.replace("{memory}", str(self.memory))
        argv = [sys.executable, "-P", "-c", code, "-f", "{connection_file}"]
        return KernelSpec(argv=argv, display_name="robokin", language="python")


def shortened(cell: Any) -> bool:
    """Shorten the outputs of a cell; return whether they were too long."""
    room, cut = TEXT, False
    kept: list[Any] = []
    for output in cell.outputs:
        try:
            output = nbformat.from_dict(all_visible(output, ALL_BUT_HALVES))
        except ValueError:  # nested too deeply
            cut = True
            continue
        if output.output_type == "stream":
            text = "\n".join(map(_overwritten, output.text.split("\n")))
            output.text = text
            if len(text) > room:
                output.text, cut = text[:room] + "\n... shortened\n", True
            room = max(0, room - len(text))
        elif output.output_type == "error":
            lines = "\n".join(output.traceback)
            if len(lines) > 4 * TEXT or cut:  # colour codes count as characters, too
                output.traceback = [f"{output.ename[:100]}: {output.evalue[:500]}"]
                output.evalue, cut = output.evalue[:500], True
        elif _size(output) > ROOM or len(kept) >= 100:
            cut = True
            continue
        kept.append(output)
    for k in range(1, len(kept)):  # the two streams may arrive in either order
        if [each.get("name") for each in kept[k - 1 : k + 1]] == ["stderr", "stdout"]:
            kept[k - 1 : k + 1] = kept[k], kept[k - 1]
    cell.outputs = kept
    return cut


def _overwritten(line: str) -> str:
    """A line as a terminal shows it after carriage returns."""
    return line.rstrip("\r").rpartition("\r")[2]


def _size(output: Any) -> int:
    """The approximate number of characters in an output."""
    if output.output_type == "stream":
        return len(output.text)
    if output.output_type == "error":
        return sum(map(len, output.traceback))
    return sum(len(str(value)) for value in output.data.values())


@functools.cache
def _silent() -> logging.Logger:
    log = logging.getLogger("robokin.judge")
    log.propagate = False
    log.setLevel(logging.CRITICAL + 1)
    return log
