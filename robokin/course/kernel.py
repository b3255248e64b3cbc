"""The kernel in which a handed-in notebook runs: Jupyter's own, with a limit of memory, that judges
an answer between two cells with the checks that it had before the first one ran.

What a verdict rests on is compared before and after each judgement with what it was: the modules of
robokin, and what they call of others. This finds a function that was replaced, by accident or by a
quick hand. It is no wall: cells and checks share a process, and whoever studies this file can
defeat it. Marking outside the student's process is nbgrader's work.
"""

import builtins
import contextlib
import functools
import json
import sys
from collections.abc import Callable, Mapping
from dataclasses import asdict
from types import FunctionType, MappingProxyType, MethodType, ModuleType
from typing import Any

import numpy as np
from ipykernel.iostream import OutStream
from ipykernel.kernelapp import IPKernelApp

from .. import course
from .book import LABS, lab

# what changes by itself: the verdicts of a student's own checks; `input`, which Jupyter replaces
CHANGING = {"_verdicts", "input"}
MISSING = object()
SAID = 10_000  # characters that a cell may print; a report shows fewer


def main(memory: int) -> None:
    """Be the kernel until told to end. memory: bytes; 0: no limit."""
    for slug in LABS:
        lab(slug)  # all that judges is loaded before the first cell
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
) -> Callable[[dict[str, str]], dict[str, Any]]:
    """The function that answers a request, {"judge": JSON of "name", "answer", "who", "own"}: by
    {"judge": {"verdict": ..., "own": the name used in the notebook}}, {"judge": {"changed": what of
    the package is not what it was}} or {"judge": {"error": why there is no verdict}}.
    """
    fingerprint = Fingerprint()

    def judge(asked: dict[str, str]) -> dict[str, Any]:
        if "judge" not in asked:
            return {}
        request = json.loads(asked["judge"])
        changed = fingerprint.changed()
        if changed:
            return {"judge": {"changed": changed}}
        kept, course._verdicts = course._verdicts, {}
        try:
            answer = eval(request["answer"] or "None", space)
            own = eval(request["own"] or "None", space)
            who = own if request["who"] is None else request["who"]
            verdict = asdict(check(request["name"], answer, who=who))
            changed = fingerprint.changed()  # by the answer itself
            if changed:
                return {"judge": {"changed": changed}}
            return {"judge": {"verdict": verdict, "own": None if own is None else str(own)}}
        except BaseException as error:  # a KeyboardInterrupt: the time is over
            return {"judge": {"error": f"{type(error).__name__}: {error}"[:300]}}
        finally:
            course._verdicts = kept

    return judge


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
            super().write(string[:SAID])
        self.said += len(string)
        return len(string)


class Fingerprint:
    """What judging rests on, as it is now: functions, their code and what they hold, classes,
    tables and arrays of robokin's modules, and the functions of the modules that these use.
    """

    def __init__(self) -> None:
        self.modules = {n: m for n, m in sys.modules.items() if _ours(n)}
        used = [m for each in self.modules.values() for m in vars(each).values()]
        others = [m for m in used if isinstance(m, ModuleType) and not _ours(m.__name__)]
        others += [builtins, np.linalg, np.random]
        self.kept: list[tuple[str, Any, Mapping[Any, Any]]] = []
        todo: list[tuple[str, Any]] = [(m.__name__, m) for m in [*self.modules.values(), *others]]
        seen: set[int] = {id(sys)}  # its functions are Jupyter's to replace
        while todo:
            place, value = todo.pop()
            if id(value) in seen:
                continue
            seen.add(id(value))
            if isinstance(value, (type, FunctionType)):  # where it is at home
                place = f"{value.__module__}.{value.__qualname__}"
            elif isinstance(value, ModuleType):
                place = value.__name__
            parts = _parts(value)
            if parts:
                self.kept.append((place, value, parts))
            if not isinstance(value, ModuleType) or _ours(value.__name__):
                todo += [(f"{place}.{name}", part) for name, part in parts.items()]

    def changed(self) -> list[str]:
        """The places where something else stands, at most three."""
        found = [n for n, module in self.modules.items() if sys.modules.get(n) is not module]
        for place, value, before in self.kept:
            now = _parts(value)
            names = [n for n in before if not _same(before[n], now.get(n, MISSING))]
            if now.keys() - before.keys():
                names += [n for n in now if n not in before and not _may_come(value, n)]
            found += [f"{place}.{name}" for name in names]
        return list(dict.fromkeys(found))[:3]


def _ours(name: str) -> bool:
    return name == "robokin" or name.startswith("robokin.")


def _may_come(value: Any, name: Any) -> bool:
    """Whether a new part changes nothing: a module has parts that are loaded late, but one of
    robokin's none that hides Python's own; an object keeps what it works out once.
    """
    if isinstance(value, ModuleType):
        return not (_ours(value.__name__) and hasattr(builtins, name))
    home = (vars(kind).get(name) for kind in type(value).__mro__)
    return any(isinstance(part, functools.cached_property) for part in home)


def _same(one: Any, other: Any) -> bool:
    return one is other or (type(one) is bytes and one == other)


def _parts(value: Any) -> Mapping[Any, Any]:
    """What a value rests on, by name; nothing of what cannot be changed or is not robokin's."""
    if isinstance(value, ModuleType):
        if _ours(value.__name__):
            return {n: v for n, v in vars(value).items() if n not in CHANGING and n[:2] != "__"}
        return {n: v for n, v in vars(value).items() if callable(v) and n not in CHANGING}
    if isinstance(value, FunctionType):
        if not _ours(value.__module__ or ""):
            return {}
        cells = {}
        for k, cell in enumerate(value.__closure__ or ()):
            with contextlib.suppress(ValueError):  # an empty one
                cells[f"closure {k}"] = cell.cell_contents
        own = {n: getattr(value, n) for n in ("__code__", "__defaults__", "__kwdefaults__")}
        return {**own, **vars(value), **cells}
    if isinstance(value, type):
        if not _ours(value.__module__):
            return {}
        return {n: v for n, v in vars(value).items() if not n.startswith("__annot")}
    if isinstance(value, (dict, MappingProxyType)):
        return dict(value)
    if isinstance(value, (list, tuple, set, frozenset)):
        return dict(enumerate(value))
    if isinstance(value, np.ndarray):
        return {"values": value.tobytes()} if value.dtype != object else {}
    if isinstance(value, property):
        return {"get": value.fget}
    if isinstance(value, (staticmethod, classmethod, MethodType)):
        return {"function": value.__func__}
    if isinstance(value, functools.partial):
        return {"function": value.func, "arguments": value.args, "keywords": value.keywords}
    if hasattr(value, "__wrapped__"):
        return {"function": value.__wrapped__}
    if _ours(type(value).__module__):
        slots = [n for c in type(value).__mro__ for n in _slots(c)]
        return {**getattr(value, "__dict__", {}), **{n: getattr(value, n, None) for n in slots}}
    return {}


def _slots(kind: type) -> tuple[str, ...]:
    slots = vars(kind).get("__slots__", ())
    return (slots,) if isinstance(slots, str) else tuple(slots)
