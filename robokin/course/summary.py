"""The teacher's table of what was handed in: who, which exercises and objectives hold, which
mistakes are the most frequent, which predictions went wrong.

It takes reports as they are, and judges notebooks anew (`judge`). Who it is from: a report says it;
of a notebook it is what its file's name has beside the lab's ("03_irb140_motion Ada.ipynb"), else
the folder that it lies in. Its own numbers are those of the name that stands in it, since folders
are seldom called what students call themselves; where that is another name, a remark says so. Of
two files of one student for one lab the newer counts: by the report's date, by the notebook's time.
"""

import contextlib
import csv
import html
import io
import os
import re
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import Any

from ..show.page import write_page
from ..show.palette import ALARM
from .book import LABS
from .handed_in import HandedIn, handed_in
from .judge import LIMITS, Limits, judge
from .report_page import GREEN, INK, LINE, SOFT, objectives, told
from .reported import report_data
from .variants import normalised

FIRST = ["who", "lab", "file", "date"]  # the columns by which a table of ours is known
BEGIN = "<title>What was handed in</title>"  # ... and a page
STYLE = f"""\
body {{ font: 15px/1.5 system-ui, sans-serif; margin: 16px; color: {INK}; background: #fff; }}
table {{ border-collapse: collapse; }}
td, th {{ text-align: left; vertical-align: top; padding: 4px 12px 4px 0;
  border-bottom: 1px solid {LINE}; }}
.wide {{ overflow-x: auto; }}
.holds {{ color: {GREEN}; }}
.not {{ color: {ALARM}; }}
.open, small {{ color: {SOFT}; }}
"""


@dataclass(frozen=True)
class Entry:
    """What one student handed in for one lab. `file`: below the folder; `data`: as in a report;
    `given`: a notebook, whose data come from judging it.
    """

    who: str
    lab: str
    file: str
    when: datetime
    data: dict[str, Any]
    given: HandedIn | None = None


@dataclass
class Summary:
    """The entries, by lab and name; (file, reason) of what could not be used; remarks."""

    entries: list[Entry] = field(default_factory=list)
    broken: list[tuple[str, str]] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)


def summary(
    folder: Path, limits: Limits = LIMITS, tell: Callable[[str], None] = lambda line: None
) -> Summary:
    """Collect what lies below `folder`, hidden files and folders left out. `tell` is called with a
    line for each file. ValueError: no folder.
    """
    if not folder.is_dir():
        raise ValueError(f"folder: wanted one that exists, got {str(folder)!r}")
    made, others = Summary(), 0
    found: dict[tuple[str, str], list[Entry]] = defaultdict(list)
    for path in sorted(folder.rglob("*")):
        inside = path.relative_to(folder)
        if any(part.startswith(".") for part in inside.parts) or not path.is_file():
            continue
        try:
            entry = _read(path, inside)
            if entry:
                found[normalised(entry.who), entry.lab].append(entry)
            others += entry is None and path.suffix == ".ipynb"
        except (OSError, ValueError) as error:
            made.broken.append((inside.as_posix(), str(error)))
    for several in found.values():
        several.sort(key=lambda each: (each.when, each.file))
        entry = several[-1]
        if len(several) > 1:
            names = ", ".join(each.file for each in several)
            made.remarks.append(
                f"{entry.who}, {entry.lab}: {names}; the newest counts: {entry.file}."
            )
        if entry.given:
            try:
                judged = judge(entry.given, None, limits)
                entry.data.update(told(entry.given, entry.who, judged))
            except (OSError, ValueError) as error:
                made.broken.append((entry.file, str(error)))
                continue
        made.entries.append(entry)
        tell(f"{entry.file}: {entry.who}, {entry.lab}, {_held(entry)}")
    made.entries.sort(key=lambda each: (LABS.index(each.lab), normalised(each.who)))
    if others:
        made.remarks.append(f"Notebooks without exercises, left out: {others}.")
    return made


def places(folder: Path) -> tuple[Path, Path]:
    """Where the table and the page come. ValueError: no folder, or something else is there."""
    if not folder.is_dir():
        raise ValueError(f"to: wanted a folder that exists, got {str(folder)!r}")
    table, page = folder / "summary.csv", folder / "summary.html"
    for path, begin in ((table, ",".join(FIRST) + ","), (page, BEGIN)):
        if os.path.lexists(path) and not _begins(path, begin):
            raise ValueError(f"{path} exists and is not a summary; nothing is overwritten")
    return table, page


def write(made: Summary, folder: Path) -> tuple[Path, Path]:
    """Write summary.csv and summary.html into `folder`. ValueError as `places`."""
    table, page = places(folder)
    write_page(page, page_of(made))
    _write(table, csv_of(made).encode("utf-8-sig"))
    return table, page


def csv_of(made: Summary) -> str:
    """The table for a spreadsheet: a row for each entry, and at the end one for each file that
    could not be used.
    """
    numbers = sorted({_number(e) for entry in made.entries for e in entry.data["exercises"]})
    goals = range(1, 1 + max((len(objectives(e.data)) for e in made.entries), default=0))
    heads = [*FIRST, "points"]
    heads += [f"objective {k}" for k in goals]
    heads += [f"{what} {n}" for n in numbers for what in ("exercise", "points", "mistake")]
    heads += ["predictions made", "predictions right", "predictions wrong", "remarks", "problem"]
    text = io.StringIO()
    rows = csv.DictWriter(text, heads, restval="")
    rows.writeheader()
    for entry in made.entries:
        row: dict[str, Any] = {"who": entry.who, "lab": entry.lab, "file": entry.file}
        row["date"] = f"{entry.when.astimezone():%Y-%m-%d %H:%M}"
        row["points"] = f"{sum(e['points'] for e in entry.data['exercises']):g}"
        row |= {f"objective {k}": s for k, (_, s) in enumerate(objectives(entry.data), 1)}
        for each in entry.data["exercises"]:
            n = _number(each)
            row[f"exercise {n}"], row[f"points {n}"] = each["state"], f"{each['points']:g}"
            row[f"mistake {n}"] = each["mistake"] or ""
        guesses = entry.data["predictions"]
        row["predictions made"] = sum(p["right"] is not None for p in guesses)
        row["predictions right"] = sum(p["right"] is True for p in guesses)
        row["predictions wrong"] = "; ".join(
            f"{p['id']}: {p['confusion'] or p['choice']}" for p in guesses if p["right"] is False
        )
        row["remarks"] = " ".join(entry.data["remarks"])
        rows.writerow({name: harmless(value) for name, value in row.items()})
    for file, reason in made.broken:
        rows.writerow({"file": harmless(file), "problem": harmless(reason)})
    return text.getvalue()


def harmless(value: Any) -> Any:
    """A cell that no spreadsheet takes for a formula."""
    text = str(value)
    return f"'{text}" if text.startswith(("=", "+", "-", "@", "\t", "\r")) else value


def mistakes(made: Summary) -> list[tuple[str, str, list[str]]]:
    """(exercise, mistake, who made it), in each exercise the most frequent first."""
    found: dict[tuple[str, str], list[str]] = defaultdict(list)
    for entry in made.entries:
        for each in entry.data["exercises"]:
            if each["state"] == "does not hold":
                found[each["id"], each["mistake"] or "not recognised"].append(entry.who)
    return _most(found)


def confusions(made: Summary) -> list[tuple[str, str, list[str]]]:
    """(prediction, the confusion behind a wrong choice, who made it), the most frequent first."""
    found: dict[tuple[str, str], list[str]] = defaultdict(list)
    for entry in made.entries:
        for each in entry.data["predictions"]:
            if each["right"] is False:
                found[each["id"], each["confusion"] or "another number"].append(entry.who)
    return _most(found)


def _most(found: dict[tuple[str, str], list[str]]) -> list[tuple[str, str, list[str]]]:
    rows = [(name, what, who) for (name, what), who in found.items()]

    def place(row: tuple[str, str, list[str]]) -> Any:
        lab, _, number = row[0].partition(".")
        digits = int(re.sub(r"\D", "", number) or 0)  # p9 before p10
        return LABS.index(lab), digits, -len(row[2]), row[1]

    return sorted(rows, key=place)


def _read(path: Path, inside: Path) -> Entry | None:
    """An entry, of a notebook still without data; None: nothing for the table."""
    if path.suffix == ".html":
        data = report_data(path.read_text(encoding="utf-8", errors="replace"))
        if data is None or data["lab"] is None:
            return None
        when = datetime.fromisoformat(data["made"])
        return Entry(data["who"], data["lab"], inside.as_posix(), when, data)
    if path.suffix != ".ipynb":
        return None
    given = handed_in(path)
    if given.lab is None:
        return None
    when = datetime.fromtimestamp(path.stat().st_mtime).astimezone()
    who = who_of(inside, given.lab)
    return Entry(who, given.lab, inside.as_posix(), when, {}, given)


def who_of(inside: Path, lab: str) -> str:
    """Whose notebook it is, from its path below the folder."""
    before, slug, after = inside.stem.partition(lab)
    if slug:
        before = re.sub(r"(^|[\s_-])\d+[\s_-]*$", " ", before)  # the lab's number
        after = re.sub(r"-Copy\d+|\(\d+\)|_checkpoint", " ", after)
        rest = " ".join(re.sub(r"[_\s]+", " ", f"{before} {after}").strip(" -.()").split())
        if re.search(r"[^\W\d_]", rest):
            return rest
    return inside.parent.name or inside.stem


def _number(exercise: dict[str, Any]) -> str:
    return str(exercise["id"]).partition(".")[2]


def _held(entry: Entry) -> str:
    states = [e["state"] for e in entry.data["exercises"]]
    return f"{states.count('holds')} of {len(states)} hold"


# --- The page -------------------------------------------------------------------------------------


def page_of(made: Summary) -> str:
    """The page: the table, below it mistakes and predictions, then what could not be used."""
    return "\n".join(_lines(made))


def _lines(made: Summary) -> Iterator[str]:
    yield '<!DOCTYPE html>\n<html lang="en">\n<meta charset="utf-8">'
    yield '<meta name="viewport" content="width=device-width">'
    yield f"{BEGIN}\n<style>{STYLE}</style>\n<body>"
    yield f"<h1>What was handed in</h1>\n<p>{datetime.now():%Y-%m-%d %H:%M}: "
    yield f"labs: {len(made.entries)}, students: {len({normalised(e.who) for e in made.entries})}, "
    yield f"files that could not be used: {len(made.broken)}.</p>"
    heads = ["Who", "Lab", "Objectives", "Exercises", "Points", "Predictions", "Remarks"]
    yield from _table(heads, map(_row, made.entries))
    yield "<h2>The most frequent mistakes</h2>"
    yield from _table(["Exercise", "Mistake", "How many", "Who"], map(_count, mistakes(made)))
    yield "<h2>Predictions that went wrong</h2>"
    yield from _table(["Prediction", "Confusion", "How many", "Who"], map(_count, confusions(made)))
    if made.broken:
        yield "<h2>Files that could not be used</h2>"
        yield from _table(["File", "Reason"], ((_said(a), _said(b)) for a, b in made.broken))
    if made.remarks:
        yield "<h2>Remarks</h2>\n<ul>"
        yield from (f"<li>{_said(remark)}</li>" for remark in made.remarks)
        yield "</ul>"
    yield "<p><small>A report says who it is from, and can be edited by who made it; a notebook is "
    yield "judged anew, and is from whom its file's name or its folder says.</small></p>"
    yield "</body>\n</html>\n"


def _table(heads: list[str], rows: Any) -> Iterator[str]:
    rows = list(rows)
    if not rows:
        yield "<p>None.</p>"
        return
    yield '<div class="wide"><table><tr>' + "".join(f"<th>{h}</th>" for h in heads) + "</tr>"
    for row in rows:
        yield "<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>"
    yield "</table></div>"


def _row(entry: Entry) -> tuple[str, ...]:
    exercises = []
    for each in entry.data["exercises"]:
        state = each["state"]
        kind = {"holds": "holds", "unanswered": "open"}.get(state, "not")
        mistake = f" ({_said(each['mistake'])})" if each["mistake"] else ""
        exercises.append(f'{_number(each)} <span class="{kind}">{state}</span>{mistake}')
    goals = [f"{k} {state}" for k, (_, state) in enumerate(objectives(entry.data), 1)]
    guesses = entry.data["predictions"]
    made = [p for p in guesses if p["right"] is not None]
    right = sum(p["right"] for p in made)
    remarks = [f"<small>{_said(remark)}</small>" for remark in entry.data["remarks"]]
    return (
        f"{_said(entry.who)}<br><small>{_said(entry.file)}, {entry.when:%Y-%m-%d}</small>",
        entry.lab,
        "<br>".join(goals),
        "<br>".join(exercises),
        f"{sum(e['points'] for e in entry.data['exercises']):g}",
        f"{right} right of {len(made)} made ({len(guesses)} asked)",
        "<br>".join(remarks),
    )


def _count(row: tuple[str, str, list[str]]) -> tuple[str, ...]:
    name, what, who = row
    return name, _said(what), str(len(who)), _said(", ".join(who))


def _said(text: str) -> str:
    return html.escape(text)


def _begins(path: Path, begin: str) -> bool:
    """Whether a file, and no link to one, has these words in its first line or two."""
    if path.is_symlink() or not path.is_file():
        return False
    with path.open("rb") as file:
        return begin in file.read(400).decode("utf-8-sig", "replace")


def _write(path: Path, content: bytes) -> None:
    """Wholly or not at all."""
    beside = path.with_name(f".{os.urandom(8).hex()}.csv.part")
    try:
        beside.write_bytes(content)
        os.replace(beside, path)
    finally:
        with contextlib.suppress(FileNotFoundError):
            beside.unlink()
