"""Run a student's answer in isolation: no exception, print, endless loop or change of its input
affects the caller.
"""

import _thread
import contextlib
import copy
import ctypes
import dis
import io
import re
import sys
import threading
import time
import warnings
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ..transform import Transform
from . import page
from .slips import ERRORS

SECONDS = 4.0  # seconds of CPU time for one case, or for one program of a test
TOTAL = 30.0  # seconds of CPU time for all cases together
WALL = 90.0  # wall-clock seconds for one case: sleeping takes no CPU time
PAGE = 30.0  # wall-clock seconds for one case in a web page, which has no clock of CPU time
QUIET = {"RESUME", "NOP", "LOAD_CONST", "RETURN_VALUE", "RETURN_CONST"}
IDENTITY: Any = object.__eq__  # the == of classes that do not define one
RAISING = {"LOAD_GLOBAL", "RAISE_VARARGS", "PUSH_NULL", "PRECALL", "CALL"}


class TimeUp(BaseException):
    """Raised in an answer whose time is up. It is not an Exception, so that `except Exception` does
    not catch it.
    """


class Outcome(NamedTuple):
    """The outcome of one call: a result, or what went wrong (`name`, and the sentence `says`)."""

    result: Any = None
    name: str | None = None
    says: str = ""


# names of outcomes that leave no result to judge
TROUBLE = {
    "raises an error",
    "changes its input",
    "returns None",
    "prints instead of returning",
    "never ends",
    "too slow in all",
}


def _never(seconds: float) -> Outcome:
    says = f"It never ends, or is far too slow (stopped after {seconds:.0f} s)."
    return Outcome(name="never ends", says=says)


NEVER = _never(SECONDS)


def is_stub(answer: Any) -> bool:
    """Return whether nothing has been written yet, that is, the answer is `...`, or a function that
    does nothing or raises NotImplementedError.
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
    """Return whether this call was stopped because it took too long."""
    return outcome.name in ("never ends", "too slow in all")


def run(answer: Callable[..., Any], cases: Sequence[tuple[Any, ...]]) -> list[Outcome]:
    """Run `answer` on every case, up to the first one that does not end in time. Each case may take
    `SECONDS` of CPU time and `WALL` seconds of real time, since it may wait or compute elsewhere;
    all cases together may take `TOTAL` seconds of CPU time.

    The answer runs in its own thread, so that `TimeUp`, which can arrive between any two
    instructions, cannot reach the calling thread. In a web page, Python has no threads. There, the
    functions in `page` tell the page when a case begins and ends, and the page stops Python after
    `PAGE` seconds.
    """
    worker, streams = _Worker(answer, cases), (sys.stdout, sys.stderr)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                worker.start()
            except RuntimeError:  # threads are not available
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
    except BaseException as error:  # SystemExit and KeyboardInterrupt too
        says = f"It raises {_told(error)}{_where(answer, error)}.{_advice(error)}"
        return Outcome(name="raises an error", says=says)
    if not all(map(equal, inputs, case)):
        return Outcome(name="changes its input", says="It changes its input. Make a copy first.")
    if result is None:
        text = " ".join(printed.getvalue().split())
        if text:
            says = f'It prints ("{text[:60]}") and returns nothing. Use return.'
            return Outcome(name="prints instead of returning", says=says)
        return Outcome(name="returns None", says="It returns None: is a return missing?")
    return Outcome(result)


def _where(answer: Callable[..., Any], error: BaseException) -> str:
    """Describe the last line in the answer's own file or cell that the error passed through."""
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
            text = "an array is used as a condition; use .all() or .any(), or one of its values"
        return f"{type(error).__name__}: {text[:160]}" if text else type(error).__name__
    return type(error).__name__


def _advice(error: BaseException) -> str:
    """Say what to write instead, after a well-known error; otherwise nothing."""
    with contextlib.suppress(Exception):
        for pattern, advice in ERRORS if isinstance(error, TypeError) else ():
            if re.search(pattern, str(error)):
                return f" {advice}"
    return ""


class _Worker:
    """The thread in which an answer runs. Python delays an exception from another thread until the
    next instruction, so the order matters: the worker sets `done`, the watching thread withdraws
    its exception, and only then may the worker `leave`.

    We do not use `threading.Thread`, because an interrupt while its `start` waits would cause a
    different error.
    """

    def __init__(self, answer: Callable[..., Any], cases: Sequence[tuple[Any, ...]]) -> None:
        self.answer, self.cases = answer, cases
        self.started, self.ident = False, 0
        self.outcomes: list[Outcome] = []
        self.over = "case"  # which of the three limits was reached
        locks = [threading.Lock() for _ in range(4)]  # each is released to signal an event
        self.begun, self.done, self.leave, self.gone = locks
        for lock in locks:
            lock.acquire()

    def start(self) -> None:
        """Start the thread. Raises RuntimeError if threads are not available."""
        self.started = True  # set first, since an interrupt can arrive at any time
        try:
            _thread.start_new_thread(self.run, ())
        except RuntimeError:
            self.started = False
            raise

    def run(self) -> None:
        self.ident = threading.get_ident()
        self.begun.release()
        # A `finally` block calls its first function before Python checks for a pending exception.
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
        """Answer without a thread, in a web page. All cases together have no limit there: measured
        by the wall clock, it would refuse a correct answer on a slow phone.
        """
        with np.errstate(all="ignore"):
            for case in self.cases:
                page.began(PAGE, _never(PAGE).says)
                try:
                    self.outcomes.append(_call(self.answer, case))
                finally:
                    page.ended()

    def stopped(self, cases: int) -> Outcome:
        """The outcome of the last of `cases` cases, which was stopped."""
        if self.over == "all":
            says = f"{cases} cases took more than {TOTAL:.0f} s together."
            return Outcome(name="too slow in all", says=says)
        return NEVER if self.over == "case" else _never(WALL)

    def _answer(self) -> None:
        with np.errstate(all="ignore"):
            for case in self.cases:
                self.outcomes.append(_call(self.answer, case))
                if self.outcomes[-1] is NEVER:
                    break

    def watch(self) -> None:
        """Wait until the answer has finished or its time is up."""
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
        """Stop the answer, even if it catches `TimeUp` repeatedly. A call into C that does not
        return within `WALL` seconds is abandoned.
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
    """Return whether two values of any type are equal; NaN equals NaN."""
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
    with contextlib.suppress(Exception):  # a list may contain arrays of different shapes
        if isinstance(a, (list, tuple)) and type(a) is type(b):
            return len(a) == len(b) and all(map(equal, a, b))
    with contextlib.suppress(Exception):
        return bool(a is b or a == b)
    return False
