"""The kernel in which a handed-in notebook runs: Jupyter's kernel with a memory limit. Between
cells, it judges answers with the checks that it loaded before the first cell.

The student's code runs in the same process as the checks, so a student can forge a verdict, and
nothing here prevents that. Use nbgrader for marks that matter.
"""

import json
import sys
from collections.abc import Callable
from dataclasses import asdict
from typing import Any

from ipykernel.iostream import OutStream
from ipykernel.kernelapp import IPKernelApp

from .. import course
from .book import labs

SAID = 10_000  # maximum number of characters that a cell may print; a report shows fewer


def main(memory: int) -> None:
    """Run the kernel until it is asked to end. `memory` is its limit in bytes; 0 means no limit."""
    for each in labs().values():
        each.read()  # the judging code is loaded before the first cell
    kernel = IPKernelApp.instance(outstream_class=f"{__name__}.Stream")
    kernel.initialize(sys.argv[1:])
    shell: Any = kernel.shell
    shell.ask_exit = lambda: None  # otherwise `exit()` ends the kernel during a later cell
    shell.user_expressions = judging(course.check, shell.user_ns)
    if memory:
        limit_memory(memory)
    kernel.start()


def limit_memory(size: int) -> None:
    """Limit this process to `size` bytes, or to its present limit if that is lower."""
    import resource  # exists only on Linux and similar systems

    if sys.platform != "win32":
        _, most = resource.getrlimit(resource.RLIMIT_AS)
        size = size if most == resource.RLIM_INFINITY else min(size, most)
        resource.setrlimit(resource.RLIMIT_AS, (size, size))


def judging(
    check: Callable[..., Any], space: dict[str, Any]
) -> Callable[[dict[str, str]], dict[str, str]]:
    """Return the function that answers requests of the form {"judge": JSON}. The JSON of a request
    has the keys "name", "answer", "who" and "own". The JSON of the reply has the keys "verdict" and
    "own" (the name used in the notebook), or "error" (the reason why there is no verdict).
    """

    def verdict_of(asked: dict[str, str]) -> dict[str, str]:
        if "judge" not in asked:
            return {}
        request = json.loads(asked["judge"])
        kept, course._verdicts = course._verdicts, {}
        try:
            answer = eval(request["answer"] or "None", space)
            own = eval(request["own"] or "None", space)
            who = own if request["who"] is None else request["who"]
            verdict = asdict(check(request["name"], answer, who=who))
            # sent as JSON text, since Jupyter cannot send every string
            found = json.dumps({"verdict": verdict, "own": None if own is None else str(own)})
        except BaseException as error:  # a KeyboardInterrupt means that the time is up
            found = json.dumps({"error": f"{type(error).__name__}: {error}"[:300]})
        finally:
            course._verdicts = kept
        return {"judge": found}

    return verdict_of


class Stream(OutStream):
    """A kernel's stdout or stderr. Endless output of a cell is discarded; otherwise it would still
    arrive long after the cell was stopped.
    """

    cell, said = None, 0

    def write(self, string: str) -> int:
        cell = self.parent_header.get("msg_id")
        if cell != self.cell:
            self.cell, self.said = cell, 0
        if self.said <= SAID:
            # a lone surrogate cannot be sent, and would block the message that the cell has ended
            text = string[:SAID].encode(errors="replace").decode()
            super().write(text)
        self.said += len(string)
        return len(string)
