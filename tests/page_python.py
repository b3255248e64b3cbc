"""Do the labs give the same answers in the page's Python as in CPython?

    python tests/page_python.py                 all labs
    python tests/page_python.py 05 12           only these

All code cells of a lab run from top to bottom in the page's Python, in Node, and in CPython. So do
the checks of its exercises, with the solution, the recorded mistakes and some trivial answers. The
following must be equal: errors (there are none), texts (what a cell prints, its value as text, the
alternative text of a figure), the data of its views (numbers within 1e-9), and the verdicts. Each
difference needs a line with its reason in EXPECTED, and each line needs a difference.

Without the page's files and without network, the script says so; only under CI (the environment
variable CI is set) it fails then.
"""

import argparse
import gzip
import html
import json
import os
import queue
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from conftest import NODE, NOTEBOOKS, ROOT

from robokin.course.ours import CALL, FIGURE
from robokin.course.site import files

HERE = Path(__file__).parent
WORKER = ROOT / "robokin" / "course" / "site" / "static" / "worker.js"
PROCESSES = 2  # in each of them the page's Python, and then CPython
NEAR = 1e-9
NUMBER = re.compile(r"\d+\.\d{10,}(?:e-?\d+)?")  # with all its digits, in Python code
KINDS = ("cells", "texts", "views", "verdicts")


class Named(NamedTuple):
    """An expected difference of kind "error", "text", "view" or "verdict": in the cell that has
    a text, or in the answer of an exercise with this name. Without a lab, it occurs in all labs.
    """

    lab: str
    kind: str
    where: str
    reason: str


ROUNDING = "rounding decides between two values that are nearly equal"
EXPECTED = [
    Named("", "text", "report(who)", "a page says how to hand in its lab"),
    Named("00_start_here", "error", "import ipywidgets", "a page has no widgets"),
    Named("06_spherical_wrist", "text", "def wrists(theta)", ROUNDING),
    Named("06_spherical_wrist", "text", "def my_wrist(h, wrist)", ROUNDING),
    Named("08_visit_and_collect", "error", "subprocess.run", "a page has no other programs"),
    Named("11_motor_synchronisation", "error", "import linprog", "a page has no SciPy"),
    Named("12_two_link_code_generation", "text", "in_c = compiled(", "a page has no C compiler"),
]


class Lab:
    """The questions of a lab and both answers to them."""

    def __init__(self, path):
        self.name = path.stem
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        code = {
            k: "".join(cell["source"])
            for k, cell in enumerate(cells)
            if cell["cell_type"] == "code" and "".join(cell["source"]).strip()
        }
        self.places, self.sources = list(code), list(code.values())
        calls = re.findall(r'^(check\("(\w+\.\w+)".*\))$', "\n".join(self.sources), re.M)
        self.questions = {"cells": self.sources, "verdicts": {name: call for call, name in calls}}
        self.here, self.there, self.seconds = {}, {}, [0.0, 0.0]

    def differences(self):
        """Yield the kind, the text that EXPECTED knows it by, and the words of each difference."""
        for k, source, here, there in zip(
            self.places, self.sources, self.here["cells"], self.there["cells"], strict=True
        ):
            one, other = (Shown(each["outputs"]) for each in (here, there))
            if one.error:
                yield "cpython", source, f"[{k}] {one.error} in CPython"
            elif other.error:
                yield "error", source, f"[{k}] {other.error}"
            if one.error or other.error:
                continue
            if one.text != other.text:
                yield "text", source, f"[{k}] {_first_difference(one.text, other.text)}"
            if place := apart(one.views, other.views):
                yield "view", source, f"[{k}] {place}"
        for name, here in self.here["verdicts"].items():
            there = self.there["verdicts"][name]
            if here != there:
                key = next(key for key in here if here[key] != there[key])
                words = _first_difference(str(here[key]), str(there[key]))
                yield "verdict", name, f"{name}: {key}: {words}"

    def counts(self):
        """The number of each of KINDS that were compared."""
        shown = [Shown(cell["outputs"]) for cell in self.here["cells"]]
        return (
            len(shown),
            sum(each.text != "" for each in shown),
            sum(len(each.views) for each in shown),
            len(self.here["verdicts"]),
        )


class Shown:
    """What a cell shows: its text, the data of its views, and its error."""

    def __init__(self, outputs):
        self.text, self.views, self.error = "", [], ""
        for output in outputs:
            if output["output_type"] == "error":
                self.error = f"{output['ename']}: {output['evalue']}"
                continue
            data = output.get("data", {})
            page = data.get("text/html", "")
            calls = [json.loads(data) for _, data in CALL.findall(page)]
            figure = FIGURE.fullmatch(page)
            self.views += calls
            if figure:
                self.text += f"figure: {html.unescape(figure[2])}\n"
            elif "application/x-robokin-figure" in data:
                self.text += f"figure: {data['text/plain']}\n"
            elif not calls:
                self.text += output.get("text", data.get("text/plain", ""))


def apart(one, other, place="view"):
    """The place of the first difference between two values from JSON, or None."""
    if isinstance(one, dict) and isinstance(other, dict):
        if one.keys() != other.keys():
            return f"{place}: other keys: {sorted(one.keys() ^ other.keys())}"
        found = (apart(one[key], other[key], f"{place}.{key}") for key in one)
    elif isinstance(one, list) and isinstance(other, list):
        if len(one) != len(other):
            return f"{place}: {len(one)} items and {len(other)}"
        pairs = enumerate(zip(one, other, strict=True))
        found = (apart(*pair, f"{place}[{k}]") for k, pair in pairs)
    elif isinstance(one, str) and isinstance(other, str):
        numbers = ([float(each) for each in NUMBER.findall(text)] for text in (one, other))
        same = NUMBER.sub("0", one) == NUMBER.sub("0", other) and apart(*numbers) is None
        return None if same else f"{place}: {_first_difference(one, other)}"
    elif all(
        isinstance(each, (int, float)) and not isinstance(each, bool) for each in (one, other)
    ):
        near = abs(one - other) <= NEAR * max(1, abs(one))
        return None if near else f"{place}: {one!r} and {other!r}"
    else:
        same = type(one) is type(other) and one == other
        return None if same else f"{place}: {str(one)[:60]!r} and {str(other)[:60]!r}"
    return next(filter(None, found), None)


def _first_difference(one, other):
    pairs = zip([*one.splitlines(), ""], [*other.splitlines(), ""], strict=False)
    here, there = next((pair for pair in pairs if pair[0] != pair[1]), (one, other))
    return f"{here[:110]!r} and {there[:110]!r}"


# --- Both Pythons ---------------------------------------------------------------------------------


class Python:
    """A process that answers questions (page_side.py)."""

    def __init__(self, command, folder):
        self.process = subprocess.Popen(
            command,
            cwd=folder,
            env=os.environ | {"PYTHONPATH": str(ROOT), "PYTHONIOENCODING": "utf-8"},
            encoding="utf-8",
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=(folder / f"{threading.get_ident()}-{Path(command[0]).stem}.txt").open("w"),
        )

    def ask(self, what, given):
        self.process.stdin.write(json.dumps({what: given}) + "\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())


def answered(labs):
    """Ask both Pythons all questions of the labs. Raises ValueError if there are no files."""
    with tempfile.TemporaryDirectory() as scratch:
        page, folder = Path(scratch) / "page", Path(scratch) / "notebooks"
        for name in files.assets(page):
            if name.endswith(".gz"):
                (page / name[:-3]).write_bytes(gzip.decompress((page / name).read_bytes()))
        unused = shutil.ignore_patterns("*.ipynb", "documents", "images", "__pycache__")
        shutil.copytree(NOTEBOOKS, folder, ignore=unused)
        waiting, failed = queue.Queue(), []
        for lab in labs:
            waiting.put(lab)
        threads = [
            threading.Thread(target=_work, args=(waiting, page, folder, failed))
            for _ in range(min(PROCESSES, len(labs)))
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        if failed:
            raise failed[0]


def _work(waiting, page, folder, failed):
    side = str(HERE / "page_side.py")
    try:
        there = Python(
            [str(NODE), str(HERE / "page_node.mjs"), str(page), side, str(WORKER)], folder
        )
        here = Python([sys.executable, side], folder)
        while not failed:
            try:
                lab = waiting.get_nowait()
            except queue.Empty:
                break
            for k, (python, answers) in enumerate(((there, lab.there), (here, lab.here))):
                first = time.monotonic()
                for what, given in lab.questions.items():
                    answers[what] = python.ask(what, given)
                lab.seconds[k] = time.monotonic() - first
            print(f"{lab.name}: {lab.seconds[0]:.0f} s and {lab.seconds[1]:.0f} s", flush=True)
        for python in (there, here):
            python.process.stdin.close()
            python.process.wait()
    except Exception as error:
        failed.append(error)


# --- The table ------------------------------------------------------------------------------------


def report(labs):
    """Print the table and all differences; return those that are not expected, and the lines of
    EXPECTED without a difference.
    """
    rows, wrong, used = [], [], set()
    for lab in labs:
        for kind, where, words in lab.differences():
            named = [
                each
                for each in EXPECTED
                if each.kind == kind and each.lab in (lab.name, "") and each.where in where
            ]
            used |= set(named)
            reason = "; ".join(each.reason for each in named) or "NOT EXPECTED"
            rows.append(f"{lab.name}, {kind}, {words}\n    {reason}")
            if not named:
                wrong.append(rows[-1])
    names = {"", *(lab.name for lab in labs)}
    stale = [each for each in EXPECTED if each not in used and each.lab in names]
    print(f"\n{'lab':32}" + "".join(f"{kind:>10}" for kind in KINDS) + "   page and CPython")
    total = Counter()
    for lab in labs:
        counts = dict(zip(KINDS, lab.counts(), strict=True))
        total.update(counts)
        times = f"{lab.seconds[0]:11.1f} s {lab.seconds[1]:6.1f} s"
        print(f"{lab.name:32}" + "".join(f"{counts[kind]:10}" for kind in KINDS) + times)
    print(f"{'all':32}" + "".join(f"{total[kind]:10}" for kind in KINDS))
    print(f"\n{len(rows)} differences, {len(wrong)} of them not expected")
    print("\n".join(rows))
    for each in stale:
        print(f"expected, but there is no such difference: {each}")
    return len(wrong) + len(stale)


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("labs", nargs="*", help="numbers of labs")
    wanted = parser.parse_args(argv).labs
    paths = sorted(NOTEBOOKS.glob("*.ipynb"))
    labs = [Lab(path) for path in paths if not wanted or path.name[:2] in wanted]
    try:
        answered(labs)
    except ValueError as error:
        print(f"not run: no files: {error}")
        return 1 if os.environ.get("CI") else 0
    return 1 if report(labs) else 0


if __name__ == "__main__":
    sys.exit(main())
