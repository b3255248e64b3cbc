"""A student's lab as one page to hand in: the student's name, the verdicts on the exercises, the
predictions, and below them the lab itself, which has been run again. Its views work without a
network.

A report is a file that its author can edit. To be sure, judge the notebook again (`summary` does);
`kernel.py` explains how reliable that is.
"""

import os
import re
import unicodedata
from dataclasses import asdict
from datetime import datetime
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup

from .. import __version__
from ..show.markup import inert
from ..show.palette import ALARM, AXIS_COLORS, PAGE
from ..show.saving import write_page
from .book import find, lab
from .export import View, page
from .handed_in import HandedIn, handed_in
from .harmless import shortened
from .judge import LIMITS, Judged, Limits, judge_notebook
from .predictions import chosen
from .reported import DATA, counted, report_data
from .texts import all_visible, visible
from .variants import normalised, variant

WORDS = 2_000  # maximum number of characters in one text of the header
KINDS = {  # the class that gives each state its colour
    **dict.fromkeys(("holds", "right"), "holds"),
    **dict.fromkeys(("does not hold", "failed", "not judged", "not so"), "not"),
}
INK, SOFT, LINE = (PAGE[name][0] for name in ("ink", "soft", "line"))
GREEN = AXIS_COLORS[1]  # dark enough for text
STYLE = f"""\
.rk-report {{ font: 15px/1.5 system-ui, sans-serif; padding: 0 8px 8px; margin-bottom: 24px;
  border-bottom: 3px solid {SOFT}; color: {INK}; background: #fff; }}
.rk-report h1 {{ font-size: 26px; margin: 8px 0 0; }}
.rk-report h2 {{ font-size: 18px; margin: 20px 0 4px; }}
.rk-report table {{ border-collapse: collapse; width: 100%; }}
.rk-report td, .rk-report th {{ text-align: left; vertical-align: top; padding: 4px 10px 4px 0;
  border-bottom: 1px solid {LINE}; }}
.rk-report td:nth-child(n+2), .rk-report h1, .rk-report p, .rk-report li {{
  overflow-wrap: anywhere; }}
.rk-report :is(h1, p, li, pre, div) {{ overflow: clip; }}  /* combining marks that pile up */
.rk-report th {{ font-weight: 600; white-space: nowrap; }}
.rk-report tr.rk-objective td {{ font-weight: 600; padding-top: 10px; }}
.rk-report td:first-child {{ white-space: nowrap; }}
.rk-report pre {{ margin: 2px 0; font: 13px/1.4 ui-monospace, monospace; white-space: pre-wrap; }}
.rk-report :is(.rk-holds, .rk-not, .rk-open) {{ overflow-wrap: normal; }}
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
    """Judge the notebook at `path` again, write its report into `folder` and return its path.
    Raises ValueError if it is not a notebook, `who` is empty, or there is a file in the way that is
    not this student's report on this notebook.
    """
    if not who.strip():
        raise ValueError(f"name: wanted a name, got {who!r}")
    handed = handed_in(path)
    to = folder / f"{portable(path.stem)}_{portable(who)}.html"
    _refuse_to_overwrite(to, handed, who)
    judged = judge_notebook(handed, who, limits)
    write_page(to, page_of(told(handed, who, judged), judged.notebook, path.parent))
    return to


def told(handed: HandedIn, who: str, judged: Judged) -> dict[str, Any]:
    """The data of a report."""
    numbers = str(variant(handed.lab, who)) if handed.lab and lab(handed.lab).given else ""
    return {
        "report": 2,
        "who": who,
        "lab": handed.lab,
        "title": handed.title,
        "file": os.fsencode(handed.path.name).decode(errors="replace"),
        "made": datetime.now().astimezone().isoformat(timespec="seconds"),
        "robokin": __version__,
        "numbers": numbers,
        "exercises": [asdict(each) for each in judged.exercises],
        "predictions": [asdict(each) for each in judged.predictions],
        "remarks": list(judged.remarks),
        "guesses_came": any(each.choice is not None for each in judged.predictions),
    }


def objectives(data: dict[str, Any]) -> list[tuple[str, str]]:
    """Return each objective of the lab with its state: "holds", "begun" or "not yet"."""
    found = []
    texts = lab(data["lab"]).objectives if data["lab"] else ()
    for k, text in enumerate(texts, 1):
        states = [e["state"] for e in data["exercises"] if e["objective"] == k]
        held = bool(states) and all(state == "holds" for state in states)
        begun = any(state != "unanswered" for state in states)
        found.append((text, "holds" if held else "begun" if begun else "not yet"))
    return found


def exercise_title(name: str) -> str:
    """The title of the exercise with this id."""
    return str(find(name, "exercises").title)


def page_of(data: dict[str, Any], notebook: Any, folder: Path) -> str:
    """Return the page: the report, and the notebook with its outputs. Pictures are read from
    `folder`. Outputs that cannot be shown are noted in the remarks of the data.
    """
    choices = {each["id"]: each["choice"] for each in data["predictions"] if each["choice"]}
    view = View(folder, choices, lenient=True)
    cells = view.cells(notebook)
    data["remarks"] += view.remarks
    # `report_data` reads these data; despite the tag, they are not a script
    header = f"<style>{STYLE}</style>\n{DATA}{inert(all_visible(data))}</script>\n{_header(data)}"
    return page(cells, _title(data), view.nonce, header)


def portable(text: str) -> str:
    """Convert text so that it is valid in a file name on any system. Letters of all scripts, digits
    and hyphens are kept.
    """
    text = unicodedata.normalize("NFC", text)
    kept = "".join(c if c == "-" or unicodedata.category(c)[0] in "LMN" else "_" for c in text)
    short = re.sub("_+", "_", kept).encode(errors="ignore")[:100].decode(errors="ignore")
    return short.strip("_") or "lab"


def _refuse_to_overwrite(to: Path, handed: HandedIn, who: str) -> None:
    """Raise ValueError if another file is there. We check this before running a kernel."""
    if not to.parent.is_dir():
        raise ValueError(f"to: wanted a folder that exists, got {str(to.parent)!r}")
    if not to.exists() and not to.is_symlink():
        return
    try:
        data = report_data(to.read_text(encoding="utf-8")) if to.is_file() else None
    except (ValueError, OSError):
        data = None
    if data is None or normalised(data["who"]) != normalised(who) or data["lab"] != handed.lab:
        raise ValueError(f"{to} exists and is not this report; nothing is overwritten")


# --- The header of a report -----------------------------------------------------------------------


def _header(data: dict[str, Any]) -> str:
    template = PAGES.get_template("header.html.j2")
    made = _day(data["made"])
    return template.render(data=data, made=made, objectives=objectives(data), kinds=KINDS)


def _title(data: dict[str, Any]) -> str:
    return f"{data['who']}: {data['title']}"


def _day(time: str) -> str:
    made = datetime.fromisoformat(time)
    return f"{made.day} {made:%B %Y}"


def _sentence(text: str) -> Markup:
    """Convert plain text to HTML; text between backticks is code."""
    words = str(Markup.escape(shortened(visible(text), WORDS)))
    return Markup(re.sub("`([^`]+)`", r"<code>\1</code>", words))


PAGES = jinja2.Environment(
    loader=jinja2.PackageLoader("robokin.course", "templates"),
    autoescape=True,
    trim_blocks=True,
    lstrip_blocks=True,
)
PAGES.filters |= {"said": _sentence, "day": _day, "title": exercise_title}
PAGES.globals |= {"chosen": chosen, "counted": counted}
