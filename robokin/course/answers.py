"""Runs a student's answer so that nothing it does gets out: no exception, no print, no endless
loop, no change of its input.
"""

import _thread
import contextlib
import copy
import ctypes
import dis
import io
import sys
import threading
import time
import warnings
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ..transform import Transform

SECONDS = 4.0  # of CPU time for one case; of a test, for one program
TOTAL = 30.0  # of CPU time for all of them together
WALL = 90.0  # by the clock on the wall for one: sleeping and C's own threads take no CPU here
QUIET = {"RESUME", "NOP", "LOAD_CONST", "RETURN_VALUE", "RETURN_CONST"}
IDENTITY: Any = object.__eq__  # of a class whose == compares no values
RAISING = {"LOAD_GLOBAL", "RAISE_VARARGS", "PUSH_NULL", "PRECALL", "CALL"}


class TimeUp(BaseException):
    """Not an Exception: `except Exception` in an answer does not catch it."""


class Outcome(NamedTuple):
    """What came of one call: a result, or what went wrong (`name`, and a sentence `says`)."""

    result: Any = None
    name: str | None = None
    says: str = ""


# the names of what goes wrong before anything can be judged
TROUBLE = {
    "raises an error",
    "changes its input",
    "returns None",
    "prints instead of returning",
    "never ends",
    "too slow",
}


def _never(seconds: float) -> Outcome:
    says = f"It does not come to an end, or is far too slow (stopped after {seconds:.0f} s)."
    return Outcome(name="never ends", says=says)


NEVER = _never(SECONDS)


def is_stub(answer: Any) -> bool:
    """Whether nothing was written yet: `...` itself, or a function that does nothing or says by
    NotImplementedError that it does nothing.
    """
    if answer is ... or answer is None:
        return True
    code = getattr(answer, "__code__", None)
    if code is None:
        return False
    steps = list(dis.get_instructions(code))
    kinds = {step.opname for step in steps}
    if "RAISE_VARARGS" in kinds:
        names = [step.argval for step in steps if step.opname == "LOAD_GLOBAL"]
        return kinds <= QUIET | RAISING and names == ["NotImplementedError"]
    constants = [step.argval for step in steps if step.opname in ("LOAD_CONST", "RETURN_CONST")]
    return kinds <= QUIET and constants[-1] in (None, ...)


def unended(outcome: Outcome) -> bool:
    """Whether this call was stopped."""
    return outcome.name in ("never ends", "too slow")


host: Callable[[bool], None] = lambda begins: None  # noqa: E731  see `run`


def run(answer: Callable[..., Any], cases: Sequence[tuple[Any, ...]]) -> list[Outcome]:
    """What `answer` makes of every case, up to the first one that does not end in time: a case has
    `SECONDS` of CPU, and `WALL` seconds where it waits or computes elsewhere; all have `TOTAL`.

    The answer runs in a thread of its own. So `TimeUp`, which arrives between any two steps of
    Python, cannot reach the thread that asks. In a page Python has no threads: there the page sets
    `host`, is told by it that answers begin (True) and have ended (False), and ends all if it has
    to.
    """
    worker, streams = _Worker(answer, cases), (sys.stdout, sys.stderr)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                worker.start()
            except RuntimeError:  # no threads
                worker.run_here()
            else:
                worker.watch()
    finally:
        worker.end()
        sys.stdout, sys.stderr = streams
    outcomes = worker.outcomes[: len(cases)]
    if len(outcomes) < len(cases) and not (outcomes and outcomes[-1] is NEVER):
        outcomes.append(NEVER)
    if outcomes and outcomes[-1] is NEVER:
        outcomes[-1] = worker.stopped(len(outcomes))
    return outcomes


def _call(answer: Callable[..., Any], case: tuple[Any, ...]) -> Outcome:
    inputs, printed = copy.deepcopy(case), io.StringIO()
    try:
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(io.StringIO()):
            result = answer(*inputs)
    except TimeUp:
        return NEVER
    except BaseException as error:  # also SystemExit and KeyboardInterrupt: nothing gets out
        return Outcome(
            name="raises an error", says=f"It raises {_told(error)}{_where(answer, error)}."
        )
    if not all(map(equal, inputs, case)):
        return Outcome(name="changes its input", says="It changes what it is given. Copy it first.")
    if result is None:
        text = " ".join(printed.getvalue().split())
        if text:
            says = f'It prints ("{text[:60]}") and returns nothing. Use return.'
            return Outcome(name="prints instead of returning", says=says)
        return Outcome(name="returns None", says="It returns None: is there a return missing?")
    return Outcome(result)


def _where(answer: Callable[..., Any], error: BaseException) -> str:
    """The last line of the answer's own file or cell that the error came through."""
    code, line, trace = getattr(answer, "__code__", None), 0, error.__traceback__
    while trace is not None:
        if code is not None and trace.tb_frame.f_code.co_filename == code.co_filename:
            line = trace.tb_lineno
        trace = trace.tb_next
    return f" (line {line} of its cell)" if line else ""


def _told(error: BaseException) -> str:
    with contextlib.suppress(Exception):
        text = " ".join(str(error).split())
        if text.startswith("The truth value of an array"):
            text = "it asks whether an array is true; ask .all() or .any() of it, or one value"
        return f"{type(error).__name__}: {text[:160]}" if text else type(error).__name__
    return type(error).__name__


class _Worker:
    """The thread in which an answer runs. Python keeps an exception that another thread sends
    until the next step, so three things happen in this order: the worker says `done`, the watching
    thread takes back what it sent, and only then may the worker `leave`.

    No `threading.Thread`: an interrupt while its `start` waits comes out as another error.
    """

    def __init__(self, answer: Callable[..., Any], cases: Sequence[tuple[Any, ...]]) -> None:
        self.answer, self.cases = answer, cases
        self.started, self.ident = False, 0
        self.outcomes: list[Outcome] = []
        self.over = "case"  # which of the three times was up
        locks = [threading.Lock() for _ in range(4)]  # each is released when it is so far
        self.begun, self.done, self.leave, self.gone = locks
        for lock in locks:
            lock.acquire()

    def start(self) -> None:
        """RuntimeError: no threads here."""
        self.started = True  # before it is: an interrupt may come between any two steps
        try:
            _thread.start_new_thread(self.run, ())
        except RuntimeError:
            self.started = False
            raise

    def run(self) -> None:
        self.ident = threading.get_ident()
        self.begun.release()
        # A `finally` calls its first function before Python looks for an exception that was sent.
        try:
            try:
                try:
                    self._answer()
                finally:
                    self.done.release()
            finally:
                self.leave.acquire()
        except TimeUp:
            pass
        self.gone.release()

    def run_here(self) -> None:
        host(True)
        try:
            self._answer()
        finally:
            host(False)

    def stopped(self, cases: int) -> Outcome:
        """What is said of the last of so many cases, which was stopped."""
        if self.over == "all":
            says = f"{cases} cases took more than {TOTAL:.0f} s together."
            return Outcome(name="too slow", says=says)
        return NEVER if self.over == "case" else _never(WALL)

    def _answer(self) -> None:
        with np.errstate(all="ignore"):
            for case in self.cases:
                self.outcomes.append(_call(self.answer, case))
                if self.outcomes[-1] is NEVER:
                    break

    def watch(self) -> None:
        """Wait until it is done, or until its time is up."""
        with self.begun:
            cpu = time.process_time
        if hasattr(time, "pthread_getcpuclockid"):
            cpu = partial(time.clock_gettime, time.pthread_getcpuclockid(self.ident))
        seen, first, wall = 0, cpu(), time.monotonic()
        begin = first
        while not self.done.acquire(timeout=0.01):
            now = cpu()
            if len(self.outcomes) > seen:
                seen, begin, wall = len(self.outcomes), now, time.monotonic()
            late = {
                "case": now - begin > SECONDS,
                "all": now - first > TOTAL,
                "wall": time.monotonic() - wall > WALL,
            }
            if any(late.values()):
                self.over = next(which for which in late if late[which])
                return
        self.done.release()

    def end(self) -> None:
        """Stop it, however often it catches `TimeUp`. A call into C that does not come back within
        `WALL` seconds is left behind.
        """
        if not self.started:
            return
        with self.begun:
            last = time.monotonic() + WALL
        while not self.done.acquire(timeout=0.01) and time.monotonic() < last:
            _raise_in(self.ident, TimeUp)
        _raise_in(self.ident, None)
        self.leave.release()
        if time.monotonic() < last:
            self.gone.acquire()


def _raise_in(thread: int, error: type[BaseException] | None) -> None:
    ctypes.pythonapi.PyThreadState_SetAsyncExc(
        ctypes.c_ulong(thread), ctypes.py_object(error) if error else None
    )


def equal(a: Any, b: Any) -> bool:
    """Whether two values of any kind are the same; a NaN is a NaN."""
    if isinstance(a, Transform) or isinstance(b, Transform):
        return (
            isinstance(a, Transform)
            and isinstance(b, Transform)
            and a.shape == b.shape
            and np.allclose(a.as_matrix(), b.as_matrix(), rtol=0, atol=1e-9)
        )
    with contextlib.suppress(Exception):
        if isinstance(a, Mapping) and isinstance(b, Mapping):
            return a.keys() == b.keys() and all(equal(a[key], b[key]) for key in a)
        if type(a) is type(b) and type(a).__eq__ is IDENTITY:
            return a is b or equal(vars(a), vars(b))
    with contextlib.suppress(Exception):
        one, two = np.asarray(a), np.asarray(b)
        if one.dtype != object and two.dtype != object:
            numbers = one.dtype.kind in "fc" and two.dtype.kind in "fc"
            return np.array_equal(one, two, equal_nan=numbers)
        if isinstance(a, (list, tuple)) and type(a) is type(b):
            return len(a) == len(b) and all(map(equal, a, b))
    with contextlib.suppress(Exception):
        return bool(a is b or a == b)
    return False
