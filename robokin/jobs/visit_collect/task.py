"""Tasks: reading a task from a file or from numbers, and finding all its faults."""

import json
import math
import os
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..._arrays import ArrayLike, Floats, Sealed, frozen
from ..._validate import masked, short, text
from .arm import LONGEST, SHORTEST, misfit, principal_postures, reasons_outside, workspace

KEYS = ("L1", "L2", "T", "q'", "p0", "pi", "task")
# With these limits, every call takes at most a few seconds:
TASK_LIMIT = 300_000  # maximum number of points in a task
FILE_LIMIT = 40_000_000  # maximum number of bytes in a file
# With this limit, messages remain readable:
FAULTS_SHOWN = 10  # maximum number of faults of one kind that are listed


class TaskError(ValueError):
    """Raised for a task that cannot be solved; `faults` contains all reasons as strings."""

    def __init__(self, faults: Iterable[str]) -> None:
        self.faults = tuple(faults)
        super().__init__("; ".join(self.faults))


@dataclass(frozen=True, eq=False, init=False)
class Task(Sealed):
    """A checked, read-only task: links l1, l2 (m), time T (s), maximum joint speeds (3,) in rad/s,
    start p0 (3,) and points (n, 3) in metres, kind "visit" or "collect". `remarks` are sentences
    about anomalies in its file, for the report. `q` (1 + n, 3) are the `principal_postures` of p0
    and of the points.

    Raises TaskError, which lists all faults, if there are any (see `faults`).

    >>> task = Task(5, 4, 10, [0.2] * 3, [1, 1, 1], [[2, 3, 2], [1, 3, 3]], "visit")
    >>> visit(task).order
    (0, 1)
    """

    l1: float
    l2: float
    T: float
    speeds: Floats
    p0: Floats
    points: Floats
    kind: str
    remarks: tuple[str, ...]
    q: Floats = field(init=False)

    def __init__(
        self,
        l1: float,
        l2: float,
        T: float,
        speeds: ArrayLike,
        p0: ArrayLike,
        points: ArrayLike,
        kind: str,
        remarks: Sequence[str] = (),
    ) -> None:
        values = map(_plain, (l1, l2, T, speeds, p0, points, kind))
        data = dict(zip(KEYS, values, strict=True))
        if found := faults(data):
            raise TaskError(found)
        if not isinstance(remarks, (list, tuple)):
            raise ValueError(f"remarks: wanted a list of strings, got {short(remarks)}")
        l1, l2, T = (float(data[key]) for key in KEYS[:3])
        # -0.0 becomes 0, as in `principal_postures`
        rows = [frozen(np.array(data[key], dtype=float) + 0.0) for key in KEYS[3:6]]
        vars(self).update(l1=l1, l2=l2, T=T, speeds=rows[0], p0=rows[1], points=rows[2])
        vars(self).update(
            kind=data["task"],
            remarks=tuple(text(remark, "remarks") for remark in remarks),
            q=frozen(principal_postures(l1, l2, np.vstack(rows[1:]))),
        )


def read_task(path: str | os.PathLike[str]) -> Task:
    """Read the task in a JSON file. Raises TaskError, which lists all faults, if it is not a valid
    task.

    A duplicate key is a fault. Unknown keys are ignored and listed in the task's `remarks`.
    """
    data, twice = _parsed(path)
    if not isinstance(data, dict) or not data.keys() >= set(KEYS):
        raise TaskError(faults(data))
    if again := [f"{key}: given {twice[key]} times" for key in KEYS if twice[key] > 1]:
        raise TaskError(again + faults(data))
    unknown = [short(key) for key in data if key not in KEYS]
    named = ", ".join(unknown[:FAULTS_SHOWN]) + and_more(len(unknown), FAULTS_SHOWN, " and {}")
    remarks = (f"unknown keys, ignored: {named}",) if unknown else ()
    L1, L2, T, speeds, p0, points, kind = (data[key] for key in KEYS)
    return Task(L1, L2, T, speeds, p0, points, kind, remarks)


def faults(data: Any) -> list[str]:
    """All faults of a task, as a list of strings; it is empty if there are none. `data` is the task
    as read from its file, a dict with the keys KEYS.

    Other keys are ignored. If the points and the lengths are valid, the points are checked against
    the workspace. They are numbered as in the document: 0 is p0, and 1 is pi[0]. The first ten
    faults of one kind are listed, and the rest are counted.
    """
    if not isinstance(data, dict):
        return [f"wanted an object with the keys {', '.join(KEYS)}, got {short(data)}"]
    missing = [key for key in KEYS if key not in data]
    found = [f"missing: {', '.join(missing)}"] if missing else []
    wrong = {key for key, (right, _) in RULES.items() if key in data and not right(data[key])}
    for key in (key for key in KEYS if key in wrong):
        many = isinstance(data[key], list) and len(data[key]) > TASK_LIMIT
        got = f"{len(data[key])} of them" if many else short(data[key])
        found.append(f"{key}: wanted {RULES[key][1]}, got {got}")

    wrong.update(missing)
    rows = [] if "pi" in wrong else data["pi"]
    points = {} if "p0" in wrong else {0: data["p0"]}
    points |= {i: point for i, point in enumerate(rows, 1) if _triple(point)}
    shapeless = [i for i in range(len(rows)) if i + 1 not in points]
    found += [
        f"pi[{i}]: wanted {RULES['p0'][1]}, got {short(rows[i])}" for i in shapeless[:FAULTS_SHOWN]
    ]
    if more := and_more(len(shapeless), FAULTS_SHOWN, "and {} points that are not such arrays"):
        found.append(more)
    if points and not wrong & {"L1", "L2"}:
        p = np.array(list(points.values()), dtype=float) + 0.0
        found += _unreachable(float(data["L1"]), float(data["L2"]), list(points), p)
    return found


def and_more(count: int, shown: int, template: str) -> str:
    """Insert the number of items not shown in place of {} in the template; "" if all are shown."""
    return template.format(f"{count - shown} more") if count > shown else ""


def coordinates(point: Floats) -> str:
    """A point (3,) as text, with the precision of a report."""
    return f"({', '.join(f'{x:.12g}' for x in point)})"


# ---- Private


def _unreachable(l1: float, l2: float, numbers: Sequence[int], p: Floats) -> list[str]:
    """The faults of the points p (n, 3) that the arm cannot reach. `numbers` are the numbers of the
    points in the document.
    """

    def named(i: int) -> str:
        number = numbers[i]
        name = f"pi[{number - 1}]" if number else "p0"
        return f"point {number} = {name} {coordinates(p[i])}"

    broken = ~workspace(l1, l2, p)
    told = broken & (broken.cumsum(axis=0) <= FAULTS_SHOWN)
    found = [
        f"{named(i)} {reason}"
        for i in np.flatnonzero(told.any(axis=-1)).tolist()
        for reason, tell in zip(reasons_outside(l1, l2, p[i]), told[i], strict=True)
        if tell
    ]
    near = "are too close to the origin"
    kinds = ("are too far", "are under the floor", near, near)
    for kind, count in zip(kinds, broken.sum(axis=0).tolist(), strict=True):
        if more := and_more(count, FAULTS_SHOWN, "and {} points " + kind):
            found.append(more)

    inside = np.flatnonzero(~broken.any(axis=-1))
    gaps = misfit(l1, l2, principal_postures(l1, l2, p[inside]), p[inside])
    wrong = np.flatnonzero(~(gaps <= 1e-6 * (l1 + l2)))
    found += [
        f"{named(inside[i])} fails the check of its joint values: off by {gaps[i]:.4g} m"
        for i in wrong[:FAULTS_SHOWN]
    ]
    if more := and_more(len(wrong), FAULTS_SHOWN, "and {} points fail it"):
        found.append(more)
    return found


def _parsed(path: str | os.PathLike[str]) -> tuple[Any, Counter[str]]:
    """Return the content of a JSON file, and the number of times that its outermost object contains
    each key. Raises TaskError if the file cannot be read.
    """
    if not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"path: wanted a path, got {short(path)}")
    counts: Counter[str] = Counter()

    def counted(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        counts.clear()  # the outermost object comes last
        counts.update(key for key, _ in pairs)
        return dict(pairs)

    try:
        raw = _content(Path(path))
    except (OSError, ValueError) as error:  # ValueError: an invalid file name
        if isinstance(error, TaskError):
            raise
        raise TaskError([f"cannot be read: {getattr(error, 'strerror', None) or error}"]) from None
    try:
        data = json.loads(raw.decode("utf-8-sig"), object_pairs_hook=counted)
    except UnicodeDecodeError as error:
        fault = f"is not UTF-8: byte 0x{error.object[error.start]:02x} at position {error.start}"
    except json.JSONDecodeError as error:
        fault = f"is not JSON: {error.msg}, line {error.lineno} column {error.colno}"
        if not error.doc.strip():
            fault = "is empty"
    except RecursionError:
        fault = "is not a task: nested too deeply"
    except ValueError:
        fault = "is not JSON: a number with thousands of digits"
    else:
        return data, counts
    raise TaskError([fault])


def _content(path: Path) -> bytes:
    if path.exists() and not path.is_file():
        raise TaskError([f"is not a file but a {'folder' if path.is_dir() else 'device'}"])
    if (size := path.stat().st_size) > FILE_LIMIT:
        raise TaskError(
            [f"is too big: {size / 1e6:.0f} MB, wanted at most {FILE_LIMIT / 1e6:.0f} MB"]
        )
    return path.read_bytes()


def _number(value: Any) -> bool:
    try:
        return (
            isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
        )
    except OverflowError:  # an integer too large for a float
        return False


def _triple(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 3 and all(map(_number, value))


# for each key, the check of its value and a description of valid values
RULES: dict[str, tuple[Callable[[Any], bool], str]] = {
    **dict.fromkeys(
        ("L1", "L2"),
        (
            lambda v: _number(v) and SHORTEST <= v <= LONGEST,
            f"a positive number of metres, from {SHORTEST:g} to {LONGEST:g}",
        ),
    ),
    "T": (lambda v: _number(v) and v >= 0, "a finite number of seconds, not negative"),
    "q'": (lambda v: _triple(v) and min(v) > 0, "an array of 3 positive finite numbers, rad/s"),
    "p0": (_triple, "an array of 3 finite numbers, m"),
    "pi": (
        lambda v: isinstance(v, list) and 0 < len(v) <= TASK_LIMIT,
        f"a non-empty array of points, at most {TASK_LIMIT}",
    ),
    "task": (
        lambda v: isinstance(v, str) and v in ("visit", "collect"),
        'either "visit" or "collect"',
    ),
}


def _plain(value: Any, depth: int = 2) -> Any:
    """Convert arrays and tuples, which labs pass, to lists as in a file. Values that are too large
    or are not numbers remain unchanged; `faults` reports them.
    """
    if isinstance(value, (np.ndarray, np.generic)):
        fit = value.dtype.kind not in "mM" and value.size <= 3 * TASK_LIMIT
        return value.tolist() if fit and not masked(value) else value
    if not (depth and isinstance(value, (list, tuple)) and len(value) <= TASK_LIMIT):
        return value
    return [_plain(v, depth - 1) for v in value]
