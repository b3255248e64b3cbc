"""Running a student's answer: nothing it does gets out. Not an exception, not a print, not a loop
without an end, not a change of what it was given.
"""

import contextlib
import copy
import ctypes
import dis
import io
import sys
import threading
import time
import warnings
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..arms.scara import ScaraPose
from ..transform import Transform

SECONDS = 4.0  # for all cases of a check together; of a test, for each program
QUIET = {"RESUME", "NOP", "LOAD_CONST", "RETURN_VALUE", "RETURN_CONST"}
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
}
NEVER = Outcome(
    name="never ends",
    says=f"It does not come to an end, or is far too slow (stopped after {SECONDS:.0f} s).",
)


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
    given = [step.argval for step in steps if step.opname in ("LOAD_CONST", "RETURN_CONST")]
    return kinds <= QUIET and given[-1] in (None, ...)


def run(
    answer: Callable[..., Any], cases: Sequence[tuple[Any, ...]], each: bool = False
) -> list[Outcome]:
    """What `answer` makes of every case, up to the first one that does not end in time: `SECONDS`
    for all of them, or for `each`.
    """
    outcomes: list[Outcome] = []
    watch, streams = Watch(), (sys.stdout, sys.stderr)
    threading.Thread(target=watch.run, daemon=True).start()
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            for case in cases:
                if each:
                    watch.begin()
                outcomes.append(_call(answer, case))
                if outcomes[-1] is NEVER:
                    break
    except TimeUp:
        outcomes.append(NEVER)
    finally:
        while True:  # it may come while we are here
            try:
                watch.over = True
                while not watch.gone:
                    time.sleep(0.001)
                _raise_in(watch.thread, None)
                break
            except TimeUp:
                continue
        sys.stdout, sys.stderr = streams
    return outcomes[: len(cases)]


def _call(answer: Callable[..., Any], case: tuple[Any, ...]) -> Outcome:
    given, printed = copy.deepcopy(case), io.StringIO()
    try:
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(io.StringIO()):
            result = answer(*given)
    except TimeUp:
        return NEVER
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # SystemExit, too: nothing gets out
        return Outcome(
            name="raises an error", says=f"It raises {_told(error)}{_where(answer, error)}."
        )
    if not all(map(equal, given, case)):
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


class Watch:
    """Raises `TimeUp` in the thread that made it, again and again, from `SECONDS` on until `over`.
    Between two steps of Python: a call into C is not interrupted. Without a lock, which an
    exception in the wrong place would leave locked.
    """

    def __init__(self) -> None:
        self.thread, self.over, self.gone = threading.get_ident(), False, False
        self.begin()

    def begin(self) -> None:
        """The time begins anew."""
        self.end = time.monotonic() + SECONDS

    def run(self) -> None:
        """In a thread of its own."""
        while not self.over:
            if time.monotonic() > self.end:
                _raise_in(self.thread, TimeUp)
            time.sleep(0.01)
        self.gone = True


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
    if isinstance(a, ScaraPose) and isinstance(b, ScaraPose):
        return equal(a.position, b.position) and equal(a.angle, b.angle)
    with contextlib.suppress(Exception):
        one, two = np.asarray(a), np.asarray(b)
        if one.dtype != object and two.dtype != object:
            numbers = one.dtype.kind in "fc" and two.dtype.kind in "fc"
            return np.array_equal(one, two, equal_nan=numbers)
    with contextlib.suppress(Exception):
        return bool(a is b or a == b)
    return False
