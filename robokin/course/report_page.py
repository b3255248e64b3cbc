"""A student's lab as one page to hand in: who it is from, what holds of its exercises, which
predictions were made, and below it the lab itself, run anew and alive without a network.

A report is a file that its author can edit, like any other. Who has to be sure judges the notebook
(`summary` does), and reads in `kernel.py` how sure that is.
"""

import html
import re
import unicodedata
from dataclasses import asdict
from datetime import datetime
from pathlib import Path
from typing import Any

import nbformat

from .. import __version__
from ..show.page import inert, write_page
from ..show.palette import ALARM, AXIS_COLORS, PAGE
from .book import lab
from .export import page
from .handed_in import HandedIn, handed_in
from .judge import LIMITS, Judged, Limits, judge
from .reported import DATA, report_data
from .variants import normalised, variant

# a page that fetches nothing, whatever a notebook would like to fetch
ALONE = (
    '<meta http-equiv="Content-Security-Policy" content="default-src \'none\'; '
    "script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; "
    'font-src data:; media-src data:">'
)
INK, SOFT, LINE = (PAGE[name][0] for name in ("ink", "soft", "line"))
GREEN = AXIS_COLORS[1]  # dark enough for words
STYLE = f"""\
.rk-report {{ font: 15px/1.5 system-ui, sans-serif; padding: 0 8px 8px; margin-bottom: 24px;
  border-bottom: 3px solid {SOFT}; color: {INK}; background: #fff; }}
.rk-report h1 {{ font-size: 26px; margin: 8px 0 0; }}
.rk-report h2 {{ font-size: 18px; margin: 20px 0 4px; }}
.rk-report table {{ border-collapse: collapse; width: 100%; }}
.rk-report td, .rk-report th {{ text-align: left; vertical-align: top; padding: 4px 10px 4px 0;
  border-bottom: 1px solid {LINE}; }}
.rk-report td:nth-child(3) {{ overflow-wrap: anywhere; }}
.rk-report th {{ font-weight: 600; white-space: nowrap; }}
.rk-report tr.rk-objective td {{ font-weight: 600; padding-top: 10px; }}
.rk-report td:first-child {{ white-space: nowrap; }}
.rk-report pre {{ margin: 2px 0; font: 13px/1.4 ui-monospace, monospace; white-space: pre-wrap; }}
.rk-report .rk-holds {{ color: {GREEN}; font-weight: 600; }}
.rk-report .rk-not {{ color: {ALARM}; font-weight: 600; }}
.rk-report .rk-open {{ color: {SOFT}; font-weight: 600; }}
@media (max-width: 600px) {{
  .rk-report {{ font-size: 13px; }}
  .rk-report td:first-child, .rk-report th {{ white-space: normal; }}
  .rk-report td, .rk-report th {{ padding-right: 5px; }}
}}
@media print {{
  .rk-report tr {{ break-inside: avoid; }}
  main pre {{ white-space: pre-wrap !important; overflow-wrap: anywhere; }}  /* nothing scrolls */
}}
"""


def report(path: Path, who: str, folder: Path, limits: Limits = LIMITS) -> Path:
    """Judge the notebook at `path` anew, write its report into `folder` and return where it is.
    ValueError: no notebook, no name, a file in the way that is not this student's report of it.
    """
    if not who.strip():
        raise ValueError(f"name: wanted a name, got {who!r}")
    given = handed_in(path)
    to = folder / f"{safe(path.stem)}_{safe(who)}.html"
    _refuse_to_overwrite(to, given, who)
    judged = judge(given, who, limits)
    write_page(to, page_of(told(given, who, judged), judged.notebook, path.parent))
    return to


def told(given: HandedIn, who: str, judged: Judged) -> dict[str, Any]:
    """What a report says, as data."""
    numbers = str(variant(given.lab, who)) if given.lab and hasattr(lab(given.lab), "given") else ""
    return {
        "report": 1,
        "who": who,
        "lab": given.lab,
        "title": given.title,
        "file": given.path.name,
        "made": datetime.now().astimezone().isoformat(timespec="seconds"),
        "robokin": __version__,
        "numbers": numbers,
        "exercises": [asdict(each) for each in judged.exercises],
        "predictions": [asdict(each) for each in judged.predictions],
        "remarks": list(judged.remarks),
    }


def objectives(data: dict[str, Any]) -> list[tuple[str, str]]:
    """(objective, "holds", "begun" or "not yet") for each of the lab's."""
    found = []
    texts = lab(data["lab"]).OBJECTIVES if data["lab"] else ()
    for k, text in enumerate(texts, 1):
        states = [e["state"] for e in data["exercises"] if e["objective"] == k]
        held = bool(states) and all(state == "holds" for state in states)
        begun = any(state != "unanswered" for state in states)
        found.append((text, "holds" if held else "begun" if begun else "not yet"))
    return found


def page_of(data: dict[str, Any], notebook: Any, folder: Path) -> str:
    """The page: what a report says, and the notebook with its outputs."""
    title = f"{data['who']}: {data['title']}"
    try:
        return _page(title, data, notebook, folder)
    except ValueError:  # a formula of the student's that is none
        for k, cell in enumerate(notebook.cells, 1):
            if cell.cell_type != "markdown":
                continue
            try:
                page(nbformat.v4.new_notebook(cells=[cell]), title, folder)
            except ValueError as error:
                data["remarks"].append(f"cell {k} of the file is shown as it was typed: {error}.")
                cell.source = f"````text\n{cell.source}\n````"
        return _page(title, data, notebook, folder)


def safe(text: str) -> str:
    """Words as a part of a file's name on any system: letters of all scripts, digits and - stay."""
    text = unicodedata.normalize("NFC", text)
    kept = "".join(c if c == "-" or unicodedata.category(c)[0] in "LMN" else "_" for c in text)
    short = re.sub("_+", "_", kept).encode(errors="ignore")[:100].decode(errors="ignore")
    return short.strip("_") or "lab"


def _refuse_to_overwrite(to: Path, given: HandedIn, who: str) -> None:
    """ValueError: something else stands there. Before a kernel runs for minutes."""
    if not to.parent.is_dir():
        raise ValueError(f"to: wanted a folder that exists, got {str(to.parent)!r}")
    if not to.exists() and not to.is_symlink():
        return
    try:
        data = report_data(to.read_text(encoding="utf-8")) if to.is_file() else None
    except (ValueError, OSError):
        data = None
    if data is None or normalised(data["who"]) != normalised(who) or data["lab"] != given.lab:
        raise ValueError(f"{to} exists and is not this report; nothing is overwritten")


# --- The page -------------------------------------------------------------------------------------


def _page(title: str, data: dict[str, Any], notebook: Any, folder: Path) -> str:
    whole = nbformat.from_dict(notebook)
    whole.metadata = nbformat.from_dict({"language_info": {"name": "python"}})
    text = page(whole, title, folder)
    for mark, more in (("<head>", ALONE), ("<main>", _head(data))):
        before, _, after = text.partition(mark)
        text = f"{before}{mark}\n{more}\n{after}"
    return text


def _head(data: dict[str, Any]) -> str:
    made = datetime.fromisoformat(data["made"])
    lines = [
        f"<style>{STYLE}</style>",
        f"{DATA}{inert(data)}</script>",
        '<header class="rk-report">',
        f"<h1>Report: {_said(data['title'])}</h1>",
        f"<p><b>{_said(data['who'])}</b> · {made.day} {made:%B %Y} · {_said(data['file'])}"
        f" · {data['lab'] or 'no lab'}</p>",
    ]
    if data["numbers"]:
        lines += ["<h2>Own numbers</h2>", f"<pre>{_said(data['numbers'])}</pre>"]
    if data["lab"]:
        lines += ["<h2>Objectives and exercises</h2>", *_exercises(data)]
        lines += ["<h2>Predictions</h2>", *_predictions(data["predictions"])]
    else:
        lines.append("<p>This notebook has no exercises of robokin's.</p>")
    if data["remarks"]:
        lines.append("<h2>Remarks</h2><ul>")
        lines += [f"<li>{_said(remark)}</li>" for remark in data["remarks"]]
        lines.append("</ul>")
    lines.append(
        f"<p>All cells ran anew for this report, in a fresh kernel, and the verdicts were worked "
        f"out there (robokin {_said(data['robokin'])}); below is the lab with what its cells "
        "gave.</p></header>"
    )
    return "\n".join(lines)


def _exercises(data: dict[str, Any]) -> list[str]:
    points = sum(each["points"] for each in data["exercises"])
    lines = ["<table><tr><th></th><th>Verdict</th><th>What was found</th><th>Points</th></tr>"]
    for k, (text, state) in enumerate(objectives(data), 1):
        lines.append(
            f'<tr class="rk-objective"><td>objective {k}</td><td>{_word(state)}</td>'
            f'<td colspan="2">{_said(text)}</td></tr>'
        )
        for each in data["exercises"]:
            if each["objective"] != k:
                continue
            found = []
            if each["mistake"]:
                found.append(f"<div>The mistake: {_said(each['mistake'])}.</div>")
            found += [f"<div>{_said(line)}</div>" for line in each["says"]]
            if each["case"]:
                found.append(f"<pre>{_said(each['case'])}</pre>")
            lines.append(
                f"<tr><td>exercise {_number(each)}</td><td>{_word(each['state'])}</td>"
                f"<td><div><i>{_said(each['task'])}</i></div>{''.join(found)}</td>"
                f"<td>{each['points']:g}</td></tr>"
            )
    lines.append(
        f"<tr><td colspan='3'>Together, of {len(data['exercises'])}</td><td>{points:g}</td></tr>"
    )
    return [*lines, "</table>"]


def _predictions(predictions: list[dict[str, Any]]) -> list[str]:
    lines = ["<table>"]
    for each in predictions:
        if each["right"] is None:
            continue
        confusion = f": {_said(each['confusion'])}" if each["confusion"] else ""
        word = _word("right") if each["right"] else _word("not so") + confusion
        choice = f"choice {_said(each['choice'])}"
        lines.append(f"<tr><td>{_number(each)}</td><td>{choice}</td><td>{word}</td></tr>")
    left = ", ".join(_number(each) for each in predictions if each["right"] is None)
    if left:
        lines.append(f"<tr><td colspan='2'>{left}</td><td>{_word('not made')}</td></tr>")
    return [*lines, "</table>"]


def _number(each: dict[str, Any]) -> str:
    return _said(str(each["id"]).partition(".")[2])


def _word(state: str) -> str:
    kind = "holds" if state in ("holds", "right") else "open"
    if state in ("does not hold", "failed", "not judged", "not so"):
        kind = "not"
    return f'<span class="rk-{kind}">{state}</span>'


def _said(text: str) -> str:
    return re.sub("`([^`]+)`", r"<code>\1</code>", html.escape(text))
