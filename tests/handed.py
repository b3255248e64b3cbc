"""Helpers that make handed-in work (notebooks, and report pages with any data) and read the result
of `summary`.
"""

import csv
import json
import os
import re
from html import unescape

import nbformat
from nbformat.v4 import new_code_cell, new_notebook, new_output

from robokin.course import book
from robokin.course.reported import DATA

SLUG = "scara_motion"
MADE = "2026-11-02T09:30:00+01:00"


def report_of(who, slug=SLUG, made=MADE, **changes):
    """The data of a report without answers."""
    lab = book.lab(slug)
    exercises = [
        {"id": f"{slug}.{n}", "task": each.task, "objective": each.objective}
        | {"state": "unanswered", "mistake": None, "says": [], "case": None, "points": 0.0}
        for n, each in lab.exercises.items()
    ]
    predictions = [
        {"id": name, "choice": None, "right": None, "confusion": None} | {"when": None, "later": []}
        for name in book.ids(slug, "predictions")
    ]
    data = {"report": 2, "who": who, "lab": slug, "title": "A lab", "file": f"{slug}.ipynb"}
    data |= {"made": made, "robokin": "2.0.0", "numbers": "", "remarks": [], "guesses_came": True}
    return data | {"exercises": exercises, "predictions": predictions} | changes


def page(data):
    """A page that contains `data` as a report does; a string is taken as JSON text."""
    text = data if isinstance(data, str) else json.dumps(data)
    data = text.replace("<", "\\u003c")
    return f"<!DOCTYPE html>\n<html><head>{DATA}{data}</script></head></html>"


def cell(source, said=None):
    """A code cell; `said` is stored as its output."""
    made = new_code_cell(source)
    if said:
        data = {"text/plain": said, "text/html": f"<div><b>{said}</b></div>"}
        made.outputs = [new_output("execute_result", data=data, execution_count=1)]
    return made


def stored(path, *cells):
    made = [c if not isinstance(c, str) else cell(c) for c in cells]
    nbformat.write(new_notebook(cells=made), path)
    return path


def put(path, content):
    """Write bytes, a string or a report's data to a file, and create the folders above it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    text = page(content) if isinstance(content, dict) else content
    with open(os.fsencode(path), "wb") as file:
        file.write(text if isinstance(text, bytes) else text.encode(errors="surrogatepass"))
    return path


def table_in(folder):
    with open(folder / "summary.csv", encoding="utf-8-sig", newline="") as file:
        return list(csv.DictReader(file))


def page_in(folder):
    return (folder / "summary.html").read_text(encoding="utf-8")


def rows_of(page, table):
    """The rows of all tables with the CSS class `table`, each as a list of strings."""
    found = []
    for text in re.findall(rf'<table class="{table}">(.*?)</table>', page, re.S):
        for row in re.findall("<tr>(.*?)</tr>", text, re.S):
            cells = re.findall("<td>(.*?)</td>", row, re.S)
            found.append([unescape(re.sub("<[^>]*>", "", cell)).strip() for cell in cells])
    return [row for row in found if row]
