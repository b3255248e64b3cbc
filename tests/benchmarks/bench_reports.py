"""Measure the time and size of the reports on the solved labs 01 to 12, and the time of a summary
of 30 notebooks.

    python tests/benchmarks/bench_reports.py [SLUG ...]

Every exercise is answered with its solution and every prediction with its first option, under a
name other than the default. Then `report` judges the lab again, and `summary` reads all reports.
Aims: every exercise passes, there are no remarks, and a report is at most 500 kB larger than the
lab with its new outputs.

Then `summary` judges 30 solved notebooks: one after another, in parallel, and in parallel while two
busy loops run. Aims: the verdicts are the same, and two idle cores need at most 0.6 times the time.
"""

import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import nbformat

from robokin.course import book, solution, summary
from robokin.course.report_page import report
from robokin.course.reported import report_data
from robokin.course.summary_pages import write

NOTEBOOKS = Path(__file__).resolve().parents[2] / "notebooks"
WHO = "Ada Lovelace"


def solved(slug, folder):
    """Write a copy of the lab with all answers to `folder`, and copy the folders that it uses."""
    [path] = NOTEBOOKS.glob(f"*_{slug}.ipynb")
    notebook = nbformat.read(path, as_version=4)
    cells, checks = [], []
    for cell in notebook.cells:
        found = re.match(r'check\("([\w.]+)"', cell.source)
        if found:  # at the end, since a solution may redefine names of the lab
            checks += [nbformat.v4.new_code_cell(solution(found[1])), cell]
        else:
            cells.append(cell)
    cells += checks
    for cell in cells:
        if cell.cell_type == "code":
            cell.source = cell.source.replace('"your name"', f'"{WHO}"')
            asked = re.match(r'predict\("([\w.]+)"\)$', cell.source)
            if asked:
                choice = "'a'" if book.find(asked[1], "predictions").unit is None else "1"
                cell.source = f"{cell.source[:-1]}, {choice})"
            said = str(cell.get("outputs", ""))
            if "not answered yet" in said:
                cell.outputs = []
    notebook.cells = cells
    nbformat.write(notebook, folder / path.name)
    for name in ("tasks", "images"):
        # copied, since a judged lab cannot use symbolic links
        shutil.copytree(NOTEBOOKS / name, folder / name, dirs_exist_ok=True)
    return folder / path.name


def judged(folder):
    """The time (s) and the content, without the date, of a summary of the notebooks in `folder`."""
    begin = time.perf_counter()
    made = summary.summary(folder)
    seconds = time.perf_counter() - begin
    rows = [(e.who, e.lab, e.file, {**e.data, "made": None}) for e in made.entries]
    return seconds, (rows, made.left_out)


def thirty(slugs, folder, count=30):
    """Return the number of differences between verdicts on the same notebooks."""
    for k in range(count):
        place = folder / f"student {k}"
        place.mkdir(parents=True)
        solved(slugs[k % len(slugs)], place)
    kernels = summary.side_by_side(summary.LIMITS.memory)
    summary.side_by_side, rule = (lambda memory: 1), summary.side_by_side
    alone, wanted = judged(folder)
    summary.side_by_side = rule
    seconds, beside = judged(folder)
    loops = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(2)]
    try:
        busy, loaded = judged(folder)
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()
    print(
        f"summary of {len(wanted[0])} notebooks: {alone:.0f} s one after another, {seconds:.0f} s "
        f"with {kernels} in parallel ({seconds / alone:.2f} of it), {busy:.0f} s while two busy "
        f"loops ran; the same verdicts: {beside == wanted}, {loaded == wanted}"
    )
    for other in (beside, loaded):
        for mine, its in zip(wanted[0], other[0], strict=False):
            if mine != its:
                print(f"    {mine}\n    {its}")
    return (beside != wanted) + (loaded != wanted) + (len(wanted[0]) != count)


def main(slugs):
    failed = 0
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        reports = folder / "reports"
        reports.mkdir()
        for slug in slugs:
            lab = solved(slug, folder)
            begin = time.perf_counter()
            page = report(lab, WHO, reports)
            seconds = time.perf_counter() - begin
            data = report_data(page.read_text(encoding="utf-8"))
            held = sum(each["state"] == "holds" for each in data["exercises"])
            more = page.stat().st_size - lab.stat().st_size
            good = held == len(data["exercises"]) and not data["remarks"] and more < 500_000
            failed += not good
            print(
                f"{slug:26} {seconds:5.1f} s, {page.stat().st_size / 1e3:5.0f} kB "
                f"(the lab and {more / 1e3:4.0f}), {held} of {len(data['exercises'])} pass, "
                f"{sum(bool(p['choice']) for p in data['predictions'])} predictions"
                f"{'' if good else '   <- NOT AS WANTED'}",
                flush=True,
            )
            for remark in data["remarks"]:
                print(f"    {remark}")
        begin = time.perf_counter()
        write(summary.summary(reports), folder)
        print(f"summary of {len(slugs)} reports: {time.perf_counter() - begin:.1f} s")
        failed += thirty(slugs, folder / "handed in")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:] or list(book.labs())))
