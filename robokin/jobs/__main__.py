"""python -m robokin.jobs FOLDER: the document's program (source 000, appendix 1) as a command."""

import argparse
import contextlib
import os
import sys
import time
import traceback

import numpy as np

from .visit_collect import TaskError, answer, itinerary, read_task, report

LOG = "output.log"
HELP = """\
Answer the "visit" and "collect" tasks in a folder: how many points can the
three-joint arm serve in the time T? Every *.json in FOLDER is a task with the keys

  L1, L2  lengths of the links, m       p0    start of the tool, m: [x, y, z]
  T       time allowed, s               pi    points, m: [[x, y, z], ...]
  q'      joint speeds, rad/s: [3]      task  "visit" or "collect"

Three examples lie in notebooks/tasks."""
AFTER = f"""\
A report on each file, in order of the names, goes to the standard output; a file
that is no task is skipped, with every reason. The same goes to {LOG} in the
working folder, with the joint values and the times of each way (DEBUG). This log
is made anew; no other file is written. Progress goes to the standard error output.

Exit status: 0    every task answered
             1    a file skipped, or the output could not be written
             2    nothing to do: wrong use, no such folder, no *.json in it
             130  stopped with Ctrl+C"""


def main(argv=None):
    """Run the command; the exit status."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")  # a name that the terminal cannot show
    parser = argparse.ArgumentParser(
        prog="python -m robokin.jobs",
        description=HELP,
        epilog=AFTER,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("folder", metavar="FOLDER", help="where the task files are")
    folder = parser.parse_args(argv).folder
    with Log() as log:
        try:
            status = run(folder, log)
        except KeyboardInterrupt:
            log.fatal("stopped with Ctrl+C")
            return 130
        return status or int(log.failed)


def run(folder, log):
    """Answer every task file in the folder; the exit status."""
    try:
        names = sorted(
            n for n in os.listdir(folder) if n.endswith(".json") and not n.startswith(".")
        )
    except OSError as error:
        log.fatal(f"folder {_shown(folder)} cannot be read: {error.strerror or error}")
        return 2
    if not names:
        log.fatal(f"no tasks (*.json) found in folder {_shown(folder)}")
        return 2
    skipped, told = 0, time.monotonic()
    for count, name in enumerate(names, 1):
        skipped += not one(os.path.join(folder, name), f"Task {_shown(name)}", log)
        if count < len(names) and (count % 100 == 0 or time.monotonic() > told + 2):
            told = time.monotonic()
            _tell(f"{count} of {len(names)} files")
    log.info(
        f"{len(names)} {'file' if len(names) == 1 else 'files'}: {len(names) - skipped} answered, "
        f"{skipped} skipped"
    )
    return int(skipped > 0)


def one(path, title, log):
    """Answer one task file and say so, or say why not; whether it was answered."""
    try:
        task = read_task(path)
        result = answer(task)
        text = report(task, result)
        _, q = itinerary(task, result)
        with np.errstate(over="ignore"):
            legs = abs(np.diff(q, axis=0)) / task.speeds
    except TaskError as error:
        log.error(f"{title} skipped:" + "".join(f"\n\t{fault}" for fault in error.faults))
        return False
    except Exception as error:  # a fault of this program: the other files are answered all the same
        log.debug(f"{title}: {traceback.format_exc()}")
        log.error(f"{title} skipped:\n\tthis program failed, {type(error).__name__}: {error}")
        return False
    log.debug(
        f"{title}: L1 = {task.l1}, L2 = {task.l2}, T = {task.T}, q' = {task.speeds.tolist()}, "
        f"p0 = {task.p0.tolist()}, pi = {task.points.tolist()}, task = {task.kind}"
    )
    log.debug(f"{title}: q of p0 and pi, nan where a joint is free = {task.q.tolist()}")
    log.debug(f"{title}: t1, t2, t3 of each way = {legs.tolist()}")
    log.info(f"{title}: {text}")
    return True


class Log:
    """Lines "LEVEL: message" in output.log, and those above DEBUG on the standard output as
    well.
    """

    def __init__(self):
        self.failed = False
        try:
            # Removed and made, not overwritten: output.log may be a link to a file that must not
            # change.
            with contextlib.suppress(FileNotFoundError):
                os.remove(LOG)
            self.file = open(LOG, "x", encoding="utf-8", errors="backslashreplace", buffering=1)
        except OSError as error:
            self._lost(error)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._close()

    def debug(self, message):
        """To the file only."""
        self._write(f"DEBUG: {message}\n")

    def info(self, message):
        """To the file and to the standard output."""
        self._write(f"INFO: {message}\n")
        self._print(f"INFO: {message}")

    def error(self, message):
        """As `info`."""
        self._write(f"ERROR: {message}\n")
        self._print(f"ERROR: {message}")

    def fatal(self, message):
        """To the file and to the standard error output: the run ends here."""
        self._write(f"ERROR: {message}\n")
        _tell(f"ERROR: {message}")

    def _write(self, line):
        if self.file:
            try:
                self.file.write(line)
            except OSError as error:
                self._lost(error)

    def _print(self, text):
        try:
            print(text, flush=True)
        # nobody reads on, as in `| head`, or the disk is full: the log goes on
        except OSError as error:
            self.failed = True
            _tell(f"the standard output cannot be written: {error.strerror or error}")
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())

    def _lost(self, error):
        """Without the file the answers still go to the standard output."""
        self.failed = True
        _tell(f"{LOG} cannot be written: {error.strerror or error}")
        if getattr(self, "file", None):
            self._close()
        self.file = None

    def _close(self):
        if self.file:
            try:
                self.file.close()
            except OSError as error:
                self.file = None
                self._lost(error)


def _tell(text):
    """To the standard error output, if there is one."""
    if sys.stderr:
        with contextlib.suppress(OSError):
            print(text, file=sys.stderr, flush=True)


def _shown(name):
    """A file's name on one line, with what cannot be printed as escapes."""
    return "".join(
        c if c.isprintable() else c.encode("unicode_escape", "surrogatepass").decode() for c in name
    )


if __name__ == "__main__":
    sys.exit(main())
