"""Collect handed-in work for the teacher's table: reports are used as they are, and notebooks are
judged again (`judge`), several at the same time.

A report contains its student's name. For a notebook, the name is the part of the file name that is
not the lab's name ("03_irb140_motion Ada.ipynb"), otherwise the name of its folder. Individual
numbers are those of the name in the notebook, since folder names seldom match the names that
students use; if the names differ, a remark says so. If a student has two files for one lab, the
newer one counts, by the date of the report or the modification time of the notebook. If they are
equally new, like copies of one page, the one in a folder with the student's name counts, otherwise
the first.

All handed-in data are hostile until they are validated (`reported`), and are escaped when written
(`summary_pages`). A fault in one file does not affect the others.
"""

import os
import re
from collections import defaultdict
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path
from typing import Any

import psutil

from .book import MORE, labs
from .handed_in import HandedIn, handed_in
from .judge import LIMITS, Limits, judge_notebook
from .report_page import objectives, told
from .reported import NAME, TEXT, counted, report_data, validated
from .texts import visible
from .variants import normalised

LARGE = 50_000_000  # maximum number of bytes in a file; a report has about a tenth of this


@dataclass(frozen=True)
class Entry:
    """The work of one student for one lab. `file` is its path relative to the folder, as text;
    `data` are validated data as in a report; `handed` is the notebook, kept until it is judged;
    `judged` says whether it has been judged.
    """

    who: str
    lab: str
    file: str
    when: datetime
    data: dict[str, Any]
    handed: HandedIn | None = None
    judged: bool = False

    @property
    def date(self) -> str:
        """The date and time of the work, in the local time zone."""
        return f"{self.when.astimezone():%Y-%m-%d %H:%M}"

    @property
    def objectives(self) -> list[tuple[str, str]]:
        """Each objective with its state: "holds", "begun" or "not yet"."""
        return objectives(self.data)

    @property
    def points(self) -> str:
        """The sum of the points of all exercises."""
        return f"{sum(each['points'] for each in self.data['exercises']):g}"

    @property
    def held(self) -> str:
        """The number of solved exercises: "2 of 3"."""
        states = [each["state"] for each in self.data["exercises"]]
        return f"{states.count('holds')} of {len(states)}"

    @property
    def guessed(self) -> str:
        """The number of first guesses that are right."""
        if not self.data["guesses_came"]:
            return "guesses: none came with the notebook"
        asked = counted(self.data)
        rights = [each["right"] for each in asked if each["right"] is not None]
        return f"{sum(rights)} right of {len(rights)} made ({len(asked)} asked)"


@dataclass(frozen=True)
class LeftOut:
    """A file that is not in the table, its student, and the reason. `wrong` is True if the file
    cannot be used, and False if it does not belong in the table.
    """

    file: str
    who: str
    reason: str
    wrong: bool


@dataclass
class Summary:
    """The entries, sorted by lab and name, and the files that were left out."""

    entries: list[Entry] = field(default_factory=list)
    left_out: list[LeftOut] = field(default_factory=list)


def summary(
    folder: Path,
    limits: Limits = LIMITS,
    tell: Callable[[int, int, str], None] = lambda done, of, line: None,
    ours: Callable[[Path], bool] = lambda path: False,
) -> Summary:
    """Collect the files in `folder` and its subfolders, except hidden files and folders and the
    pages of a summary, for which `ours` returns True. Symbolic links are not followed. `tell` is
    called with the number of finished labs, their total number, and a line of text: first with 0 if
    there are notebooks, then after each student's lab. Raises ValueError if `folder` is not a
    folder.
    """
    if not folder.is_dir():
        raise ValueError(f"folder: wanted an existing folder, got {str(folder)!r}")
    made = Summary()
    found: dict[tuple[str, str], list[Entry]] = defaultdict(list)
    for inside, problem in _files(folder):
        try:
            if problem is None and ours(folder / inside):
                continue
            entry = problem or _read(folder / inside, inside)
            if isinstance(entry, Entry):
                found[normalised(entry.who), entry.lab].append(entry)
            else:
                made.left_out.append(_left(inside, entry, problem is not None))
        except Exception as error:  # a file may contain anything
            made.left_out.append(_left(inside, _reason(error), True))
    kernels = side_by_side(limits.memory)
    if notebooks := sum(any(each.handed for each in several) for several in found.values()):
        tell(0, len(found), f"notebooks to judge: {notebooks}, {kernels} at a time")
    pool = ThreadPoolExecutor(kernels)
    try:
        jobs = [pool.submit(_newest, several, limits) for several in found.values()]
        for done, job in enumerate(as_completed(jobs), 1):
            newest, left_out = job.result()
            made.left_out += left_out
            if newest:
                made.entries.append(newest)
                line = f"{newest.file}: {newest.who}, {newest.lab}, {newest.held} hold"
                tell(done, len(jobs), line)
    finally:
        pool.shutdown(cancel_futures=True)  # after Ctrl+C, waiting jobs do not start
    made.entries.sort(key=lambda each: (list(labs()).index(each.lab), normalised(each.who)))
    made.left_out.sort(key=lambda each: (each.file, each.reason))
    return made


def side_by_side(memory: int) -> int:
    """The number of notebooks to judge at the same time: at most one per core and one for each
    `memory` bytes of free memory, but at least one.
    """
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return max(1, min(cores or 1, int(psutil.virtual_memory().available // max(memory, 1))))


def who_of(inside: Path) -> str:
    """The name of a file's student, from its path relative to the folder: the part of the file name
    that is not a lab's name, otherwise the name of the nearest folder that is not named after a
    lab, otherwise the file name.
    """
    for k, part in enumerate((inside.stem, *reversed(inside.parent.parts))):
        slug = re.search("|".join(labs()), part, re.I)
        if slug:
            before = re.sub(r"(^|[\s_-])\d{1,2}[\s_-]*$", " ", part[: slug.start()])  # lab number
            after = re.sub(r"-Copy\d+|\(\d+\)|_checkpoint", " ", part[slug.end() :])
            part = " ".join(re.sub("[_ ]+", " ", f"{before} {after}").strip(" -.()").split())
            if re.search(r"[^\W\d_]|\d{3}", part):
                return _shown(part)[:NAME]
        elif k and part.strip():
            return _shown(part)[:NAME]
    return _shown(inside.stem)[:NAME]


def _files(folder: Path) -> Iterator[tuple[Path, str | None]]:
    """Yield the path, relative to the folder, and None or the reason why it cannot be read, for all
    pages and notebooks. Links to folders and unreadable folders are included, since they may
    contain some.
    """
    todo = [Path()]
    while todo:
        inside = todo.pop()
        try:
            entries = sorted(os.scandir(folder / inside), key=lambda each: each.name)
        except OSError as error:
            yield inside, f"a folder that cannot be read: {error.strerror}"
            continue
        for each in entries:
            path, here = folder / inside / each.name, inside / each.name
            wanted = path.suffix.lower() in (".html", ".ipynb")
            if each.name.startswith("."):
                continue
            if each.is_symlink():
                if wanted or os.path.isdir(path):
                    yield here, "a symbolic link: its target is not read"
            elif each.is_dir():
                todo.append(here)
            elif wanted:
                yield here, None if each.is_file() else "not an ordinary file"


def _read(path: Path, inside: Path) -> Entry | str:
    """Return an entry, which has no data yet if it is a notebook, or the reason why the file does
    not belong in the table.
    """
    size = path.stat().st_size
    if size > LARGE:
        raise ValueError(f"too large: {size / 1e6:.0f} MB; at most {LARGE / 1e6:.0f} MB are read")
    if path.suffix.lower() == ".html":
        data = report_data(path.read_text(encoding="utf-8", errors="replace"))
        if data is None:
            return "a page that is not a report"
        if data["lab"] is None:
            return f"a report of a notebook without a known exercise. {MORE}"
        when = datetime.fromisoformat(data["made"])
        return Entry(data["who"], data["lab"], _shown(inside), when, data)
    handed = handed_in(path)
    if handed.lab is None:
        return f"a notebook without a known exercise. {MORE}"
    when = datetime.fromtimestamp(path.stat().st_mtime).astimezone()
    return Entry(who_of(inside), handed.lab, _shown(inside), when, {}, handed)


def _newest(several: list[Entry], limits: Limits) -> tuple[Entry | None, list[LeftOut]]:
    """Return the newest usable file of one student for one lab, judged if it is a notebook, and the
    files that are left out.
    """
    several = sorted(several, key=lambda each: each.file, reverse=True)
    several.sort(key=lambda each: (each.when, _at_home(each)))
    left_out: list[LeftOut] = []
    while several:
        entry = several.pop()
        try:
            if entry.handed:
                data = validated(
                    told(entry.handed, entry.who, judge_notebook(entry.handed, None, limits))
                )
                entry = replace(entry, data=data, handed=None, judged=True)
        except Exception as error:  # a student's code may return anything
            left_out.append(LeftOut(entry.file, entry.who, _reason(error), True))
            continue
        for each in several:
            who, reason = each.who, f"{entry.file} of {entry.who} for {entry.lab}"
            if each.data and each.data == entry.data:
                folder = Path(each.file).parent
                who = who_of(folder / "_") if folder.name else who
                reason = f"the same page as {entry.file}, which counts"
            elif each.when == entry.when:
                reason += " is equally new and counts"
            else:
                reason += " is newer and counts"
            left_out.append(LeftOut(each.file, who, reason, False))
        return entry, left_out
    return None, left_out


def _at_home(entry: Entry) -> bool:
    """Return whether a folder that contains the entry's file has the student's name."""
    name, folders = normalised(entry.who), normalised(f"/{Path(entry.file).parent}")
    return bool(re.search(rf"(?<![^\W_]){re.escape(name)}(?![^\W_])", folders))


def _left(inside: Path, reason: str, wrong: bool) -> LeftOut:
    return LeftOut(_shown(inside), who_of(inside), reason, wrong)


def _shown(name: Path | str) -> str:
    r"""A file name as text; bytes that are not UTF-8 become escapes like \xff."""
    text = name.as_posix() if isinstance(name, Path) else name
    return visible(os.fsencode(text).decode(errors="backslashreplace"), "", TEXT)


def _reason(error: Exception) -> str:
    known = isinstance(error, (OSError, ValueError)) and not isinstance(error, UnicodeError)
    text = str(error) if known else f"{type(error).__name__}: {error}"
    return visible(text, "", 500).rstrip(": ")
