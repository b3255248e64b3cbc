"""python -m robokin.jobs FOLDER: the document's program (source 000, appendix 1) as a command."""

import argparse
import contextlib
import logging
import os
import sys
import time
from collections.abc import Iterator, Sequence
from typing import TextIO

from .._arrays import Floats, Ints
from .visit_collect import (
    FAULTS_SHOWN,
    NEAREST_LIMIT,
    POINTS_SHOWN,
    TASK_LIMIT,
    Result,
    Task,
    TaskError,
    answer,
    read_task,
    report,
)
from .visit_collect.solver import candidates

if sys.platform != "win32":
    import fcntl

LOG = "output.log"
HELP = """\
Solve the "visit" and "collect" tasks in a folder: how many points can the
three-joint arm visit or collect in the time T? Every *.json in FOLDER is a task
with the keys

  L1, L2  lengths of the links, m       p0    start of the tool, m: [x, y, z]
  T       time allowed, s               pi    points, m: [[x, y, z], ...]
  q'      joint speeds, rad/s: [3]      task  "visit" or "collect"

Three examples are in notebooks/tasks."""
AFTER = f"""\
The reports, in order of the file names, are written to standard output; if a file
is not a task, the report gives the reasons why it was skipped. The reports are also
written to {LOG} in the working folder, with the joint values and the times of
each move (DEBUG). Each run replaces this log, and only one run at a time can write
it; no other file is written. Progress is shown on standard error.

A file in which a key occurs twice is skipped. Unknown keys, speeds that look like
degrees and moves on which the tool dips under the floor cause warnings. A file may
have up to {TASK_LIMIT} points ("visit", or "collect" with p0 on axis 1: {NEAREST_LIMIT}).
At most {POINTS_SHOWN} points are listed, and {FAULTS_SHOWN} faults or low moves of each kind.

Exit status: 0    every task was solved
             1    a file was skipped, or the output or the log could not be written
             2    nothing to do: wrong usage, no such folder, or no *.json in it
             130  stopped with Ctrl+C"""
BIG = 1_000_000  # bytes; larger files are announced, since they take longer

log = logging.getLogger("robokin.jobs")  # writes to output.log
answers = log.getChild("answers")  # writes to output.log and standard output
end = log.getChild("end")  # writes the last message of a run to output.log and standard error


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command and return its exit status."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            # File names may have characters that the stream cannot encode.
            stream.reconfigure(errors="backslashreplace")
    parser = argparse.ArgumentParser(
        prog="python -m robokin.jobs",
        description=HELP,
        epilog=AFTER,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("folder", metavar="FOLDER", help="where the task files are")
    parser.add_argument(
        "--above-floor",
        action="store_true",
        help="refuse moves on which the tool dips under the floor",
    )
    arguments = parser.parse_args(argv)
    with outputs() as lost:
        try:
            status = run(arguments.folder, arguments.above_floor)
        except KeyboardInterrupt:
            end.error("stopped with Ctrl+C")
            return 130
        return status or int(bool(lost))


def run(folder: str, above_floor: bool = False) -> int:
    """Solve every task file in the folder and return the exit status."""
    try:
        names = sorted(
            n for n in os.listdir(folder) if n.endswith(".json") and not n.startswith(".")
        )
    except NotADirectoryError:
        where = os.path.dirname(folder) or os.curdir
        end.error(f"{_shown(folder)} is a file: wanted its folder, {_shown(where)}")
        return 2
    except OSError as error:
        end.error(f"folder {_shown(folder)} cannot be read: {error.strerror or error}")
        return 2
    if not names:
        end.error(f"no tasks (*.json) found in folder {_shown(folder)}")
        return 2
    skipped, told = 0, time.monotonic()
    for count, name in enumerate(names, 1):
        skipped += not one(os.path.join(folder, name), f"Task {_shown(name)}", above_floor)
        if count < len(names) and (count % 100 == 0 or time.monotonic() > told + 2):
            told = time.monotonic()
            _tell(f"{count} of {len(names)} files")
    answers.info(
        f"{len(names)} {'file' if len(names) == 1 else 'files'}: {len(names) - skipped} solved, "
        f"{skipped} skipped"
    )
    return int(skipped > 0)


def one(path: str, title: str, above_floor: bool = False) -> bool:
    """Solve one task file and log the result, or the reason why it was skipped. Return whether it
    was solved.
    """
    try:
        size = os.path.getsize(path) if os.path.isfile(path) else 0
        if size > BIG:
            _tell(f"{title}: reading {size / 1e6:.0f} MB")
        task = read_task(path)
        if size > BIG:
            _tell(f"{title}: {len(task.points)} points to {task.kind}")
        result = answer(task, above_floor=above_floor)
        text = report(task, result)
        compared = _compared(task, result)
    except TaskError as error:
        answers.error(f"{title} skipped:" + "".join(f"\n\t{fault}" for fault in error.faults))
        return False
    except Exception as error:  # an error in this program: the other files are still solved
        log.debug(title, exc_info=True)
        answers.error(f"{title} skipped:\n\tthis program failed, {type(error).__name__}: {error}")
        return False
    log.debug(
        f"{title}: L1 = {task.l1}, L2 = {task.l2}, T = {task.T}, q' = {task.speeds.tolist()}, "
        f"p0 = {task.p0.tolist()}, pi = {_first(task.points)}, task = {task.kind}"
    )
    log.debug(f"{title}: q of p0 and pi, nan where a joint is free = {_first(task.q)}")
    for line in compared:
        log.debug(f"{title}: {line}")
    answers.info(f"{title}: {text}")
    return True


class Output(logging.StreamHandler[TextIO]):
    """Write lines "LEVEL: message" to a stream. If the stream cannot be written, report this once
    and note it in `lost`; the other outputs continue.
    """

    def __init__(self, title: str, stream: TextIO, lost: list[str]) -> None:
        super().__init__(stream)
        self.title, self.lost = title, lost
        self.setFormatter(logging.Formatter("%(levelname)s: %(message)s"))

    def handleError(self, record: logging.LogRecord) -> None:
        """`emit` calls this when the stream raises an error."""
        self.setLevel(logging.CRITICAL + 1)
        _lose(self.title, sys.exc_info()[1], self.lost)
        # Discard what is left in the stream's buffer; otherwise closing it would fail again.
        with contextlib.suppress(OSError), open(os.devnull, "w") as nowhere:
            os.dup2(nowhere.fileno(), self.stream.fileno())


@contextlib.contextmanager
def outputs() -> Iterator[list[str]]:
    """Connect the loggers to their outputs for the duration of the context; yield the names of lost
    outputs.
    """
    lost: list[str] = []
    with contextlib.ExitStack() as stack:
        try:
            _lock_folder(stack)
            # Remove the old log and create a new one: overwriting it could change another file, if
            # it is a link.
            with contextlib.suppress(FileNotFoundError):
                os.remove(LOG)
            file = stack.enter_context(open(LOG, "x", encoding="utf-8", errors="backslashreplace"))
            _connect(stack, log, Output(LOG, file, lost), logging.DEBUG)
        except OSError as error:
            _lose(LOG, error, lost)
            _connect(stack, log, logging.NullHandler(), logging.DEBUG)
        if sys.stdout:
            name = "standard output"
            _connect(stack, answers, Output(name, sys.stdout, lost), logging.INFO)
        else:
            _lose("standard output", "it is closed", lost)
        if sys.stderr:
            _connect(stack, end, Output("standard error", sys.stderr, []), logging.INFO)
        stack.callback(log.setLevel, log.level)
        stack.callback(setattr, log, "propagate", log.propagate)
        log.setLevel(logging.DEBUG)
        log.propagate = False  # keep these messages out of the caller's own log
        yield lost


def _connect(
    stack: contextlib.ExitStack, logger: logging.Logger, handler: logging.Handler, level: int
) -> None:
    handler.setLevel(level)
    logger.addHandler(handler)
    stack.callback(logger.removeHandler, handler)


def _lock_folder(stack: contextlib.ExitStack) -> None:
    """Lock this folder's log until the stack is closed. Raises OSError if another run holds the
    lock.

    Windows needs no lock, since an open file cannot be removed there. If the file system has no
    locks, nothing is locked.
    """
    if sys.platform == "win32":
        return
    try:
        folder = os.open(os.curdir, os.O_RDONLY)
        stack.callback(os.close, folder)
        fcntl.flock(folder, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise OSError("another run is writing it") from None
    except OSError:
        pass


def _lose(title: str, why: object, lost: list[str]) -> None:
    lost.append(title)
    _tell(f"{title} cannot be written: {getattr(why, 'strerror', None) or why}")


def _tell(text: str) -> None:
    """Write to standard error, if there is one."""
    if sys.stderr:
        with contextlib.suppress(OSError):
            print(text, file=sys.stderr, flush=True)


def _compared(task: Task, result: Result) -> list[str]:
    """The times of all moves that were compared, one line for each stop, for the log. There are no
    more lines once POINTS_SHOWN moves are listed.
    """
    lines: list[str] = []
    count = 0
    for name, left, times in candidates(task, result):
        if count >= POINTS_SHOWN:
            return [*lines, "the times of later moves are not listed"]
        lines.append(f"t1, t2, t3 from {name} to pi{_first(left)} = {_first(times)}")
        count += len(left)
    return lines


def _first(rows: Floats | Ints) -> str:
    """The first POINTS_SHOWN rows of an array, as text for the log."""
    more = f" and {len(rows) - POINTS_SHOWN} more" if len(rows) > POINTS_SHOWN else ""
    return f"{rows[:POINTS_SHOWN].tolist()}{more}"


def _shown(name: str) -> str:
    """A file name on one line, with unprintable characters escaped."""
    return "".join(
        c if c.isprintable() else c.encode("unicode_escape", "surrogatepass").decode() for c in name
    )


if __name__ == "__main__":
    sys.exit(main())
