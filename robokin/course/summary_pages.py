"""The teacher's table as files: summary.csv, summary.html and a page for each row.

The pages come from templates that escape all text. They have no scripts: their content security
policy forbids scripts and requests and permits only one style sheet.
"""

import base64
import contextlib
import csv
import functools
import hashlib
import io
import os
import re
from collections import Counter, defaultdict
from collections.abc import Collection
from datetime import datetime
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup, escape

from ..show.palette import ALARM, AXIS_COLORS, PAGE
from ..show.saving import write_page
from .book import find, home, lab, labs, titled
from .predictions import chosen, worked_out
from .report_page import exercise_title, portable
from .reported import counted
from .summary import Entry, Summary
from .variants import normalised

FIRST = ["who", "lab", "file", "date"]  # columns that identify our tables
BEGIN = "<title>What was handed in</title>"  # identifies our overview pages
SHEET = '<meta name="generator" content="robokin summary: one student">'  # marks student pages
PAGES = "summary_pages"
INK, SOFT, RULE = (PAGE[name][0] for name in ("ink", "soft", "line"))
STYLE = f"""\
body {{ font: 15px/1.5 system-ui, sans-serif; margin: 16px; color: {INK}; background: #fff; }}
table {{ border-collapse: collapse; margin-bottom: 20px; }}
td, th {{ text-align: left; vertical-align: top; padding: 4px 12px 4px 0; contain: paint;
  border-bottom: 1px solid {RULE}; overflow-wrap: anywhere; min-width: 6em; }}
th {{ overflow-wrap: normal; }}
.overview td:first-child {{ min-width: 10em; }}
.overview :is(td, th) + * {{ min-width: 0; white-space: nowrap; }}
th small {{ font-weight: 400; }}
pre {{ margin: 2px 0; font: 13px/1.4 ui-monospace, monospace; white-space: pre-wrap; }}
.wide {{ overflow-x: auto; }}
.counted td:first-child {{ width: 45%; }}
.counted td:last-child {{ width: 30%; }}
.objective td {{ font-weight: 600; }}
.holds {{ color: {AXIS_COLORS[1]}; }}
.not {{ color: {ALARM}; }}
.open, small {{ color: {SOFT}; }}
@page {{ size: landscape; }}
@media print {{
  body {{ font-size: 11px; margin: 0; }}
  td, th {{ min-width: 0; padding-right: 8px; }}
  tr {{ break-inside: avoid; }}
  .wide {{ overflow: visible; }}
  .students th small {{ display: none; }}  /* the table above has these words */
}}
"""
HASH = base64.b64encode(hashlib.sha256(STYLE.encode()).digest()).decode()
POLICY = f"default-src 'none'; style-src 'sha256-{HASH}'; base-uri 'none'; form-action 'none'"
FORMULA = re.compile("(^|[;,|\"'] ?)(?=[=+@\uff1d\uff0b\uff0d\uff20-])")


def mistakes(made: Summary) -> list[tuple[str, str, list[str]]]:
    """Return (exercise, mistake, names of students), the most frequent mistakes of each exercise
    first.
    """
    found: dict[tuple[str, str], list[str]] = defaultdict(list)
    for entry in made.entries:
        for each in entry.data["exercises"]:
            if each["state"] == "does not hold":
                found[each["id"], each["mistake"] or "not recognised"].append(entry.who)
    return _most(found)


def confusions(made: Summary) -> list[tuple[str, str, list[str]]]:
    """Return (prediction, the confusion behind a wrong first guess, names of students), the most
    frequent confusions of each prediction first.
    """
    found: dict[tuple[str, str], list[str]] = defaultdict(list)
    for entry in made.entries:
        for each in entry.data["predictions"]:
            if each["right"] is False:
                found[each["id"], each["confusion"] or "another number"].append(entry.who)
    return _most(found)


def _most(found: dict[tuple[str, str], list[str]]) -> list[tuple[str, str, list[str]]]:
    rows = [(name, what, who) for (name, what), who in found.items()]

    def place(row: tuple[str, str, list[str]]) -> Any:
        number = row[0].partition(".")[2].lstrip("p")
        place = list(labs()).index(home(row[0])), int(number)  # p9 before p10
        return *place, -len(row[2]), row[1]

    return sorted(rows, key=place)


def csv_of(made: Summary, points: bool = True) -> str:
    """The table for a spreadsheet: a row for each entry, and at the end one for each file that was
    left out.
    """
    numbers = sorted({_number(e) for entry in made.entries for e in entry.data["exercises"]})
    goals = range(1, 1 + max((len(each.objectives) for each in made.entries), default=0))
    heads = [*FIRST, "points", *(f"objective {k}" for k in goals)]
    heads += [f"{what} {n}" for n in numbers for what in ("exercise", "points", "mistake")]
    heads += ["predictions made", "predictions right", "predictions wrong", "remarks", "problem"]
    if not points:
        heads = [head for head in heads if not head.startswith("points")]
    text = io.StringIO()
    rows = csv.DictWriter(text, heads, restval="", extrasaction="ignore")
    rows.writeheader()
    for entry in made.entries:
        row = {"who": entry.who, "lab": entry.lab, "file": entry.file, "date": entry.date}
        row["points"] = entry.points
        row |= {f"objective {k}": state for k, (_, state) in enumerate(entry.objectives, 1)}
        for each in entry.data["exercises"]:
            n = _number(each)
            row[f"exercise {n}"], row[f"points {n}"] = each["state"], f"{each['points']:g}"
            row[f"mistake {n}"] = each["mistake"] or ""
        if entry.data["guesses_came"]:
            guesses = entry.data["predictions"]
            row["predictions made"] = str(sum(p["right"] is not None for p in guesses))
            row["predictions right"] = str(sum(p["right"] is True for p in guesses))
            row["predictions wrong"] = "; ".join(
                f"{_number(p)}: {p['confusion'] or p['choice']}"
                for p in guesses
                if p["right"] is False
            )
        row["remarks"] = " ".join(entry.data["remarks"])
        rows.writerow({name: harmless(value) for name, value in row.items()})
    for left in made.left_out:
        row = {"who": left.who, "file": left.file, "problem": left.reason}
        rows.writerow({name: harmless(value) for name, value in row.items()})
    return text.getvalue()


def harmless(text: str) -> str:
    """Put the text of a cell on one line that no spreadsheet interprets as a formula, even if the
    separator is not a comma.
    """
    return FORMULA.sub(r"\1'", " ".join(text.split()))


def page_of(made: Summary, links: list[str], points: bool = True) -> str:
    """Return the overview page. Its first table has the number of solved exercises, with a row for
    each student and a column for each lab. For each lab, it has the number of students who pass
    each exercise, and a row for each student. Tables of mistakes, predictions and files that were
    left out follow. `links` are the links to the pages of the entries.
    """
    rows = list(zip(made.entries, links, strict=True))
    students: dict[str, dict[str, tuple[Entry, str]]] = defaultdict(dict)
    for entry, link in rows:
        students[normalised(entry.who)][entry.lab] = entry, link
    taught = [(slug, [row for row in rows if row[0].lab == slug]) for slug in labs()]
    return _page(
        "summary.html.j2",
        points=points,
        made=made,
        labs=[
            {"name": slug, "rows": here, **_figures(slug, here)} for slug, here in taught if here
        ],
        now=f"{datetime.now():%Y-%m-%d %H:%M}",
        students=[students[name] for name in sorted(students)],
        counted=(
            ("The most frequent mistakes", "Exercise", "Mistake", mistakes(made)),
            ("Predictions that went wrong", "Prediction", "Confusion", confusions(made)),
        ),
    )


def sheet(entry: Entry, points: bool = True) -> str:
    """One student's page, written from validated data."""
    return _page("sheet.html.j2", points=points, entry=entry, mark=Markup(SHEET))


def _figures(slug: str, rows: list[tuple[Entry, str]]) -> dict[str, Any]:
    """The number of students for each exercise and state, and for each objective reached."""
    states: dict[str, Counter[str]] = defaultdict(Counter)
    for entry, _ in rows:
        for each in entry.data["exercises"]:
            states[each["id"]][each["state"]] += 1
    held = Counter(text for entry, _ in rows for text, s in entry.objectives if s == "holds")
    return {
        "exercises": [(n, f"{slug}.{n}", states[f"{slug}.{n}"]) for n in lab(slug).exercises],
        "objectives": [(text, held[text]) for text in lab(slug).objectives],
    }


def _page(template: str, **more: Any) -> str:
    return _templates().get_template(template).render(more, style=Markup(STYLE), policy=POLICY)


@functools.cache
def _templates() -> jinja2.Environment:
    pages = jinja2.Environment(
        loader=jinja2.PackageLoader("robokin.course", "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
    )
    pages.filters |= {"words": _words, "asked": _asked, "time": _time, "kind": _kind}
    pages.filters |= {"home": home, "titled": titled, "title": exercise_title}
    pages.globals |= {"chosen": chosen, "counted": counted}
    return pages


def _words(text: str) -> Markup:
    """Convert plain text to HTML; text between backticks is code."""
    return Markup(re.sub("`([^`]+)`", r"<code>\1</code>", str(escape(text))))


@functools.cache
def _asked(name: str) -> str:
    """The task of an exercise or the question of a prediction, from robokin."""
    slug, _, number = name.partition(".")
    if number in lab(slug).exercises:
        return str(find(name, "exercises").task)
    return worked_out(name)[0]


def _time(text: str) -> str:
    return f"{datetime.fromisoformat(text):%Y-%m-%d %H:%M}"


def _kind(state: str) -> str:
    wrong = state in ("does not hold", "failed", "not judged")
    return "holds" if state == "holds" else "not" if wrong else "open"


def _number(each: dict[str, Any]) -> str:
    return str(each["id"]).partition(".")[2]


# --- Output files ---------------------------------------------------------------------------------


def places(folder: Path) -> tuple[Path, Path, Path]:
    """The paths of the table, the page and the students' pages. Raises ValueError if there is no
    folder or another file is in the way.
    """
    if not folder.is_dir():
        raise ValueError(f"to: wanted a folder that exists, got {str(folder)!r}")
    table, page, pages = folder / "summary.csv", folder / "summary.html", folder / PAGES
    for path, begin in ((table, ",".join(FIRST) + ","), (page, BEGIN)):
        if os.path.lexists(path) and not _begins(path, begin):
            raise ValueError(f"{path} exists and is not a summary; nothing is overwritten")
    if os.path.lexists(pages) and (pages.is_symlink() or not pages.is_dir()):
        raise ValueError(f"{pages} exists and is not a folder; nothing is overwritten")
    return table, page, pages


def write(made: Summary, folder: Path, points: bool = True) -> tuple[Path, Path]:
    """Write summary.csv and summary.html into `folder`, and next to them the students' pages, which
    replace those of an earlier summary. Raises ValueError as `places` does.
    """
    table, page, pages = places(folder)
    if made.entries:
        pages.mkdir(exist_ok=True)
    names: dict[str, str] = {}  # in lower case, since a file system may ignore case
    for entry in made.entries:
        path = _free(pages, f"{entry.lab}_{portable(entry.who)}", names)
        write_page(path, sheet(entry, points))
        names[path.name.casefold()] = path.name
    write_page(page, page_of(made, [f"{PAGES}/{name}" for name in names.values()], points))
    _write(table, csv_of(made, points).encode("utf-8-sig"))
    for path in pages.iterdir() if pages.is_dir() else ():
        name = names.get(path.name.casefold())
        if _begins(path, SHEET) and not (name and path.samefile(pages / name)):
            path.unlink()
    return table, page


def is_ours(path: Path, folder: Path) -> bool:
    """Return whether a page was written into `folder` by `write`."""
    place, top = path.resolve(), folder.resolve()
    if place == top / "summary.html":
        return _begins(path, BEGIN)
    return place.parent == top / PAGES and _begins(path, SHEET)


def _free(pages: Path, name: str, taken: Collection[str]) -> Path:
    """A path for a page at which there is no foreign file and no other student's page."""
    path, k = pages / f"{name}.html", 1
    while path.name.casefold() in taken or (os.path.lexists(path) and not _begins(path, SHEET)):
        k += 1
        path = pages / f"{name}_{k}.html"
    return path


def _begins(path: Path, begin: str) -> bool:
    """Return whether a path is a regular file, not a link, with this text near its beginning."""
    if path.is_symlink() or not path.is_file():
        return False
    with path.open("rb") as file:
        return begin in file.read(1000).decode("utf-8-sig", "replace")


def _write(path: Path, content: bytes) -> None:
    """Write a file atomically."""
    beside = path.with_name(f".{os.urandom(8).hex()}.csv.part")
    try:
        beside.write_bytes(content)
        os.replace(beside, path)
    finally:
        with contextlib.suppress(FileNotFoundError):
            beside.unlink()
