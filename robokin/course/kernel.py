"""The kernel in which a handed-in notebook runs: Jupyter's own, with a limit of memory, that judges
an answer between two cells with the checks that it had before the first one ran.

Judging runs the student's code in one process with the checks, so whoever wants to can forge a
verdict. Nothing here prevents that. Marks that matter belong to nbgrader.
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

SAID = 10_000  # characters that a cell may print; a report shows fewer


def main(memory: int) -> None:
    """Be the kernel until told to end. memory: bytes; 0: no limit."""
    for each in labs().values():
        each.read()  # all that judges is loaded before the first cell
    kernel = IPKernelApp.instance(outstream_class=f"{__name__}.Stream")
    kernel.initialize(sys.argv[1:])
    shell: Any = kernel.shell
    shell.ask_exit = lambda: None  # `exit()` would end it during another cell
    shell.user_expressions = judging(course.check, shell.user_ns)
    if memory:
        limit_memory(memory)
    kernel.start()


def limit_memory(size: int) -> None:
    """Let this process have `size` bytes, or what it has where that is less."""
    import resource  # Linux and its like

    if sys.platform != "win32":
        _, most = resource.getrlimit(resource.RLIMIT_AS)
        size = size if most == resource.RLIM_INFINITY else min(size, most)
        resource.setrlimit(resource.RLIMIT_AS, (size, size))


def judging(
    check: Callable[..., Any], space: dict[str, Any]
) -> Callable[[dict[str, str]], dict[str, str]]:
    """The function that answers a request, {"judge": JSON of "name", "answer", "who", "own"}, by
    {"judge": JSON}: of {"verdict": ..., "own": the name used in the notebook}, or of {"error": why
    there is no verdict}.
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
            # as text, since Jupyter cannot send every string
            found = json.dumps({"verdict": verdict, "own": None if own is None else str(own)})
        except BaseException as error:  # a KeyboardInterrupt: the time is over
            found = json.dumps({"error": f"{type(error).__name__}: {error}"[:300]})
        finally:
            course._verdicts = kept
        return {"judge": found}

    return verdict_of


class Stream(OutStream):
    """A kernel's stdout or stderr. What a cell prints without an end goes nowhere, or it would
    still be on its way long after the cell was stopped.
    """

    cell, said = None, 0

    def write(self, string: str) -> int:
        cell = self.parent_header.get("msg_id")
        if cell != self.cell:
            self.cell, self.said = cell, 0
        if self.said <= SAID:
            text = string[:SAID].encode(errors="replace").decode()  # a lone surrogate is lost, and
            super().write(text)  # with it the message that the cell has ended
        self.said += len(string)
        return len(string)
