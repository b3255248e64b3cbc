"""`python -m robokin.course summary`: the teacher's table, compared with counts made by the tests.
test_summary_attacked.py tests attacks by students.
"""

import functools
import os
import random
import re
import sys
import threading
from collections import Counter, defaultdict
from html import unescape
from pathlib import Path
from urllib.parse import unquote

import nbformat
import pytest
from handed import SLUG, page_in, put, report_of, rows_of, table_in
from nbformat.v4 import new_code_cell, new_notebook

from robokin import course
from robokin.course import book, summary, summary_pages
from robokin.course.__main__ import main
from robokin.course.judge import Judged, Limits, Result
from robokin.course.variants import normalised

NAMES = """Ada Grace Mary Юрий Łukasz José Zoë Ng O'Neil कमला =SUM(A1) +49 -1 @home Li Wei Max Eva
Noor Otto Pia Quinn Rosa Sven Tom Uma Vera Will Xi Yara""".split()
SLUGS = ("irb140_motion", "scara_motion", "three_levers")
MISTAKES = ("takes degrees", "the sign", None)


def notebook(path, *cells):
    path.parent.mkdir(parents=True, exist_ok=True)
    nbformat.write(new_notebook(cells=[new_code_cell(cell) for cell in cells]), path)
    return path


def drawn_report(name, slug, dice):
    """A report with random verdicts and guesses."""
    data = report_of(name, slug)
    for each in data["exercises"]:
        state = dice.choice(("holds", "does not hold", "does not hold", "unanswered", "failed"))
        each["state"] = state
        each["points"] = {"holds": 1.0, "does not hold": dice.choice((0.1, 0.5))}.get(state, 0.0)
        each["mistake"] = dice.choice(MISTAKES) if state == "does not hold" else None
    for each in dice.sample(data["predictions"], 4):
        wrong = dice.random() < 0.6
        confusion = dice.choice(("the elbow", "the path", None)) if wrong else None
        each |= {"choice": "b", "right": not wrong, "confusion": confusion, "later": ["c", "a"]}
    return data


@pytest.fixture(scope="module")
def handed(tmp_path_factory):
    """A folder with the reports of thirty students, one of which is truncated, and other files; and
    the random data of each intact report.
    """
    folder, dice = tmp_path_factory.mktemp("handed"), random.Random(14)
    drawn = {name: drawn_report(name, SLUGS[k % 3], dice) for k, name in enumerate(NAMES)}
    for k, data in enumerate(drawn.values()):
        put(folder / f"student {k}" / "report.html", data)
    last = folder / f"student {k}" / "report.html"
    last.write_text(last.read_text().partition('"predictions"')[0])
    del drawn[NAMES[-1]]
    put(folder / "student 3" / "03_irb140_motion.ipynb", "{}")
    put(folder / "student 4" / ".ipynb_checkpoints" / "x.ipynb", "{}")
    put(folder / "student 5" / "other.HTML", "<p>no report</p>")
    put(folder / "student 5" / "notes.txt", "")
    notebook(folder / "student 6" / "notes.ipynb", "1")
    return folder, drawn


@functools.cache
def question(name):
    return course.predict(name).question.replace("`", "")


def words(name, choice):
    """The text of a guess as the lab's page shows it."""
    asked = course.predict(name)
    if choice is None or asked.unit:
        return choice or ""  # a typed answer has no letter
    return f"{choice}) {asked.options['abcd'.index(choice)].text}".replace("`", "")


def test_table_lists_handed_in_work(handed, tmp_path, capsys):
    folder, drawn = handed
    assert main(["summary", str(folder), "--to", str(tmp_path)]) == 1
    said = capsys.readouterr()
    assert len(said.err.splitlines()) == 2
    assert re.search(r"student 3/03_irb140_motion.ipynb: not a notebook", said.err)
    assert re.search(r"student 29/report.html: a report that cannot be read", said.err)
    left_out = {
        "student 29/report.html": ("student 29", "a report that cannot be read"),
        "student 3/03_irb140_motion.ipynb": ("student 3", "not a notebook"),
        "student 5/other.HTML": ("student 5", "a page that is not a report"),
        "student 6/notes.ipynb": ("student 6", f"a notebook without a known exercise. {book.MORE}"),
    }
    rows = table_in(tmp_path)
    assert len(drawn) == 29 and len(rows) == 29 + len(left_out)
    assert not any(row["problem"] for row in rows[:29])
    listed = rows_of(page_in(tmp_path), "left")
    for row, (file, who, reason) in zip(rows[29:], listed, strict=True):
        assert (row["file"], row["who"], row["problem"]) == (file, who, reason)
        assert who == left_out[file][0] and reason.startswith(left_out[file][1])
    assert [file for file, _, _ in listed] == sorted(left_out)
    seen = set()
    for row in rows[:29]:
        name = row["who"].removeprefix("'")
        data = drawn[name]
        seen.add(name)
        assert row["lab"] == data["lab"] and row["file"].startswith("student ")
        for each in data["exercises"]:
            n = each["id"][-1]
            assert row[f"exercise {n}"] == each["state"]
            assert float(row[f"points {n}"]) == each["points"]
            assert row[f"mistake {n}"] == (each["mistake"] or "")
        assert float(row["points"]) == pytest.approx(sum(e["points"] for e in data["exercises"]))
        for k in (1, 2, 3):
            states = {e["state"] for e in data["exercises"] if e["objective"] == k}
            wanted = "holds" if states == {"holds"} else "begun"
            assert row[f"objective {k}"] == ("not yet" if states == {"unanswered"} else wanted)
        right = [each["right"] for each in data["predictions"] if each["choice"]]
        assert (row["predictions made"], row["predictions right"]) == ("4", str(sum(right)))
        assert row["predictions wrong"].count("; ") + 1 == max(1, right.count(False))
    assert seen == set(drawn)


def test_mistakes_confusions_and_results_are_counted(handed, tmp_path):
    folder, drawn = handed
    made = summary.summary(folder)
    wrong, guessed, held = defaultdict(list), defaultdict(list), Counter()
    for name, data in drawn.items():
        for each in data["exercises"]:
            held[each["id"]] += each["state"] == "holds"
            held[f"{data['lab']} objective {each['objective']}"] += each["state"] == "holds"
            if each["state"] == "does not hold":
                wrong[each["id"], each["mistake"] or "not recognised"].append(name)
        for each in data["predictions"]:
            if each["right"] is False:
                guessed[each["id"], each["confusion"] or "another number"].append(name)
    counted = (summary_pages.mistakes(made), wrong), (summary_pages.confusions(made), guessed)
    for rows, wanted in counted:
        assert {(a, b): sorted(who) for a, b, who in rows} == {
            key: sorted(who) for key, who in wanted.items()
        }
        counts = defaultdict(list)
        for name, _, who in rows:
            counts[name].append(len(who))
        assert all(each == sorted(each, reverse=True) for each in counts.values())
        assert max(map(max, counts.values())) > 1
        labs = [list(book.labs()).index(name.partition(".")[0]) for name, _, _ in rows]
        assert labs == sorted(labs)
    summary_pages.write(made, tmp_path)
    page = page_in(tmp_path)
    rows = rows_of(page, "counted")
    for (name, what), who in wrong.items():
        task = book.find(name, "exercises").task.replace("`", "")
        lab = book.titled(name.partition(".")[0]).capitalize()
        assert [f"{lab}: {task}", what, str(len(who))] in [r[:3] for r in rows]
    for name, what in guessed:
        lab = book.titled(name.partition(".")[0]).capitalize()
        assert [f"{lab}: {question(name)}", what] in [row[:2] for row in rows]
    figures = iter(rows_of(page, "class"))
    for slug in SLUGS:  # each exercise has its own objective
        students = sum(data["lab"] == slug for data in drawn.values())
        for n, exercise in book.lab(slug).exercises.items():
            head, holds, *_, task = next(figures)
            assert (head, task) == (f"exercise {n}", exercise.task.replace("`", ""))
            assert holds == f"{held[f'{slug}.{n}']} of {students}"
        for k, text in enumerate(book.lab(slug).objectives, 1):
            head, holds, *_, words = next(figures)
            assert (head, words) == (f"objective {k}", text.replace("`", ""))
            assert holds == f"{held[f'{slug} objective {k}']} of {students}"
    assert not re.search(rf"({'|'.join(SLUGS)})\.p?\d", page), "an id instead of a title"


def test_each_row_links_to_its_own_page(handed, tmp_path):
    folder, drawn = handed
    made = summary.summary(folder)
    for points in (True, False):
        summary_pages.write(made, tmp_path, points)
        links = re.findall('<td><a href="(summary_pages/[^"]*)">(.*?)</a><br>', page_in(tmp_path))
        assert sorted(unescape(who) for _, who in links) == sorted(drawn)
        for link, who in links:
            data = drawn[unescape(who)]
            page = (tmp_path / unquote(link)).read_text(encoding="utf-8")
            assert re.findall('<a href="([^"]*)"', page) == ["../summary.html"], "no student's page"
            told = [row for row in rows_of(page, "sheet") if row[0].startswith("exercise")]
            for row, each in zip(told, data["exercises"], strict=True):
                title = book.find(each["id"], "exercises").title
                assert row[0] == f"exercise {each['id'][-1]}{title}"
                assert row[1] == each["state"] and (each["mistake"] or "") in row[2]
                assert row[3:] == ([f"{each['points']:g}"] if points else [])
            guesses = rows_of(page, "guesses")
            for row, each in zip(guesses, data["predictions"], strict=True):
                assert row[0] == question(each["id"])
                assert row[1] == words(each["id"], each["choice"])
                assert row[3] == "".join(words(each["id"], later) for later in each["later"])
        assert len(links) == 29 == len(os.listdir(tmp_path / "summary_pages"))
        said = page_in(tmp_path)
        assert ("not marks" in said) == points == ("<th>Points</th>" in said)
        assert any("points" in head for head in table_in(tmp_path)[0]) == points


def test_numbers_have_units_and_optional_predictions_can_be_missing(tmp_path):
    slug = "irb140_motion"
    data = report_of("Ada", slug)
    asked = book.lab(slug).predictions
    optional = [f"{slug}.{n}" for n, each in asked.items() if each.optional]
    typed = next(n for n, each in asked.items() if each.unit == "°")
    for each in data["predictions"]:
        if each["id"] == f"{slug}.{typed}":
            each |= {"choice": "-90", "right": False, "later": ["-9<b>", "120"]}
        elif each["id"] != optional[-1]:
            each |= {"choice": "a", "right": True}
    put(tmp_path / "a.html", data)
    [entry] = summary.summary(tmp_path).entries
    rows = rows_of(summary_pages.sheet(entry), "guesses")
    [row] = [row for row in rows if row[0] == question(f"{slug}.{typed}")]
    assert row[1:] == ["−90°", "not so", "-9<b>120°"]
    [last] = [row for row in rows if row[0] == question(optional[-1])]
    assert len(optional) > 1 and last[1:3] == ["", "optional, not made"]
    made = len(asked) - 1
    assert entry.guessed == f"{made - 1} right of {made} made ({made} asked)"


def test_points_can_be_hidden_and_missing_guesses_are_reported(tmp_path):
    put(tmp_path / "a.html", report_of("Ada", guesses_came=False))
    old = report_of("Grace") | {"report": 1}
    del old["guesses_came"]
    for each in old["predictions"]:
        del each["when"], each["later"]
    old["predictions"][0] |= {"choice": "a", "right": True}
    put(tmp_path / "g.html", old)
    assert main(["summary", str(tmp_path), "--to", str(tmp_path), "--no-points"]) == 0
    ada, grace = table_in(tmp_path)
    assert not any("points" in head for head in ada)
    assert (ada["predictions made"], grace["predictions made"]) == ("", "1")
    cells = rows_of(page_in(tmp_path), "students")
    assert cells[0][-2] == "guesses: none came with the notebook"
    assert cells[1][-2].startswith("1 right of 1 made")


def test_other_files_are_not_overwritten(handed, tmp_path):
    folder, _ = handed
    made = summary.Summary()
    table, page = summary_pages.write(made, tmp_path)
    first = table.read_bytes()
    assert first.startswith(b"\xef\xbb\xbfwho,lab,file,date,")
    summary_pages.write(made, tmp_path)
    assert table.read_bytes() == first and sorted(os.listdir(tmp_path)) == [table.name, page.name]
    for path, words in ((table, "mine;mine"), (page, "<!DOCTYPE html><!-- robokin player -->")):
        before = path.read_bytes()
        path.write_text(words)
        with pytest.raises(ValueError, match="nothing is overwritten"):
            summary_pages.write(made, tmp_path)
        assert main(["summary", str(folder), "--to", str(tmp_path)]) == 1
        assert path.read_text() == words
        path.write_bytes(before)
    with pytest.raises(ValueError, match="folder: wanted"):
        summary.summary(tmp_path / "none")
    with pytest.raises(ValueError, match="to: wanted"):
        summary_pages.write(made, tmp_path / "none")


def test_student_pages_do_not_overwrite_other_files(tmp_path, capsys):
    """The folder of handed-in work is also the output folder, as in the README."""
    for who in ("Ada B", "ada_b", "Zoë"):
        put(tmp_path / f"{who}.html", report_of(who))
    put(tmp_path / "summary_pages" / f"{SLUG}_Zoë.html", "mine")
    put(tmp_path / "summary_pages" / "notes.html", "mine, too")
    for run in range(2):
        assert main(["summary", str(tmp_path), "--to", str(tmp_path)]) == 0
        names = sorted(os.listdir(tmp_path / "summary_pages"))
        wanted = [f"{SLUG}_{name}.html" for name in ("Ada_B", "Zoë", "Zoë_2", "ada_b_2")]
        assert names == sorted([*wanted, "notes.html"]), run
        rows = table_in(tmp_path)
        assert [row["who"] for row in rows[:3]] == ["Ada B", "ada_b", "Zoë"]
        assert [Path(row["file"]).name for row in rows[3:]] == ["notes.html", f"{SLUG}_Zoë.html"]
    assert (tmp_path / "summary_pages" / f"{SLUG}_Zoë.html").read_text() == "mine"
    (tmp_path / "Ada B.html").unlink()
    assert main(["summary", str(tmp_path), "--to", str(tmp_path)]) == 0
    names = [f"{SLUG}_Zoë.html", f"{SLUG}_Zoë_2.html", f"{SLUG}_ada_b.html", "notes.html"]
    assert sorted(os.listdir(tmp_path / "summary_pages")) == sorted(names)
    elsewhere = tmp_path / "to"
    elsewhere.mkdir()
    (elsewhere / "summary_pages").write_text("mine")
    capsys.readouterr()
    assert main(["summary", str(tmp_path), "--to", str(elsewhere)]) == 1
    assert "nothing is overwritten" in capsys.readouterr().err
    assert os.listdir(elsewhere) == ["summary_pages"]


def test_notebooks_are_judged_again_and_the_newest_counts(tmp_path):
    ada, bob = tmp_path / "Ada", tmp_path / "bob_17"
    old = notebook(ada / "03_irb140_motion Ada.ipynb", 'check("irb140_motion.1", ...)')
    new = notebook(ada / "irb140_motion.ipynb", 'check("irb140_motion.2", ...)')
    design = course.solution("scara_motion.3").replace("your name", "Bob")
    notebook(
        bob / "scara_motion.ipynb",
        design,
        "from robokin.course import check, predict",
        'check("scara_motion.3", design, who=who)',
        'predict("scara_motion.p1", "b")',
    )
    put(tmp_path / "ada.html", report_of("ada", "irb140_motion", remarks=["from the report"]))
    os.utime(old, (1e9, 1e9))
    os.utime(new, (1.1e9, 1.1e9))
    heard = []
    made = summary.summary(tmp_path, Limits(cell=20), lambda *told: heard.append(told))
    assert sorted(told[:2] for told in heard) == [(0, 2), (1, 2), (2, 2)]
    first, second = made.entries
    assert (first.who, first.file, first.judged) == ("ada", "ada.html", False)
    assert first.data["remarks"] == ["from the report"]
    for left, path in zip(made.left_out, (old, new), strict=True):
        assert (left.file, left.who) == (f"Ada/{path.name}", "Ada") and not left.wrong
        assert left.reason.startswith("ada.html")
    assert (second.who, second.lab, second.judged) == ("bob_17", "scara_motion", True)
    assert [e["state"] for e in second.data["exercises"]] == ["unanswered"] * 2 + ["holds"]
    assert second.data["remarks"] == ["scara_motion.3: judged with the numbers of 'Bob'."]
    assert second.data["predictions"][0]["choice"] == "b"


def test_table_has_all_students_and_labs(tmp_path):
    held = {"Zoë": {SLUGS[0]: 2, SLUGS[2]: 0}, "ada": {SLUGS[2]: 3}, "Bob": {SLUGS[0]: 1}}
    for who, labs in held.items():
        for slug, count in labs.items():
            data = report_of(who.upper() if slug == SLUGS[2] else who, slug)
            for each in data["exercises"][:count]:
                each |= {"state": "holds", "points": 1.0}
            put(tmp_path / who / f"{slug}.html", data)
    assert main(["summary", str(tmp_path), "--to", str(tmp_path)]) == 0
    page = page_in(tmp_path)
    [table] = re.findall('<table class="overview">(.*?)</table>', page, re.S)
    heads = re.findall("<th>(.*?)</th>", table)
    assert heads == ["Who", "Lab 03", "Lab 09"]
    assert rows_of(page, "overview") == [
        ["ADA", "", "3 of 3"],
        ["Bob", "1 of 3", ""],
        ["Zoë", "2 of 3", "0 of 3"],
    ]
    for link, count in re.findall('<a href="([^"]*)">(.*?)</a>', table):
        told = rows_of((tmp_path / unquote(link)).read_text(encoding="utf-8"), "sheet")
        states = [row[1] for row in told if row[0].startswith("exercise")]
        assert count == f"{states.count('holds')} of {len(states)}"


def test_the_same_page_in_several_folders_counts_once(tmp_path):
    """The page in the folder with the student's name counts, or else the first page; the reasons
    for leaving out the others name the page that counts.
    """
    for folder in ("Bob", "Ada_123_file/lab", "Adam", "Zoë"):
        put(tmp_path / folder / "lab.html", report_of("Ada"))
    put(tmp_path / "Bob" / "lab of Eve.html", report_of("Eve"))
    put(tmp_path / "Carl" / "lab of Eve.html", report_of("Eve"))
    put(tmp_path / "Carl" / "other.html", report_of("Eve", title="Another one"))
    put(tmp_path / "lab.html", report_of("Ada", made="2026-11-01T09:30:00+01:00"))
    for file in ("a.html", "b.html"):
        put(tmp_path / file, report_of("../x"))
    made = summary.summary(tmp_path)
    counts = {each.who: each.file for each in made.entries}
    assert counts == {
        "Ada": "Ada_123_file/lab/lab.html",
        "Eve": "Bob/lab of Eve.html",
        "../x": "a.html",
    }
    same = "the same page as {}, which counts".format
    assert {each.file: (each.who, each.reason) for each in made.left_out} == {
        "Adam/lab.html": ("Adam", same(counts["Ada"])),
        "Bob/lab.html": ("Bob", same(counts["Ada"])),
        "Zoë/lab.html": ("Zoë", same(counts["Ada"])),
        "Carl/lab of Eve.html": ("Carl", same(counts["Eve"])),
        "Carl/other.html": ("Eve", f"{counts['Eve']} of Eve for {SLUG} is equally new and counts"),
        "b.html": ("../x", same("a.html")),
        "lab.html": ("Ada", f"{counts['Ada']} of Ada for {SLUG} is newer and counts"),
    }
    assert not any(each.wrong for each in made.left_out)


def stub(wait=lambda name: None):
    """A stand-in for the judge that runs nothing."""

    def judge(given, who, limits):
        wait(given.path.parent.name)
        exercises = [
            Result(f"{given.lab}.{n}", e.task, e.objective)
            for n, e in book.lab(given.lab).exercises.items()
        ]
        return Judged(given.notebook, tuple(exercises), (), (given.path.parent.name,))

    return judge


def test_notebooks_are_judged_in_parallel_in_any_order(tmp_path, monkeypatch):
    for who in "abcdef":
        notebook(tmp_path / who / f"{SLUG}.ipynb", f'check("{SLUG}.1", ...)')
    monkeypatch.setattr(summary, "side_by_side", lambda memory: 2)
    lock, now, most, outcomes = threading.Lock(), set(), [], []
    for first, second in ("ab", "ba"):
        both, ended = threading.Barrier(2), threading.Event()

        def wait(name, first=first, second=second, both=both, ended=ended):
            with lock:
                now.add(name)
                most.append(len(now))
            if name in "ab":
                both.wait(60)  # a and b run at the same time; `first` ends first
            if name == second:
                assert ended.wait(60)
            with lock:
                now.remove(name)
            if name == first:
                ended.set()

        monkeypatch.setattr(summary, "judge_notebook", stub(wait))
        made = summary.summary(tmp_path)
        outcomes.append([(each.who, each.data["remarks"]) for each in made.entries])
    assert max(most) == 2
    assert outcomes[0] == outcomes[1] == [(who, [who]) for who in "abcdef"]


@pytest.mark.parametrize(
    ("cores", "free", "wanted"), [(8, 33, 8), (8, 9, 2), (2, 33, 2), (8, 1, 1), (1, 33, 1)]
)
def test_number_of_parallel_notebooks_depends_on_cores_and_memory(cores, free, wanted, monkeypatch):
    memory = type("Memory", (), {"available": free * 2**30})
    monkeypatch.setattr(summary.psutil, "virtual_memory", lambda: memory)
    monkeypatch.setattr(os, "sched_getaffinity", lambda of: range(cores), raising=False)
    assert summary.side_by_side(4 * 2**30) == wanted


def test_older_notebook_counts_if_the_newest_cannot_be_judged(tmp_path, monkeypatch):
    def wait(name):
        if name != "old":
            raise {"dies": MemoryError, "turns": RecursionError}.get(name, KeyError)(name)

    for k, name in enumerate(("old", "dies", "turns", "odd")):
        path = notebook(tmp_path / name / f"{SLUG} Ada.ipynb", f'check("{SLUG}.1", ...)')
        os.utime(path, (1e9 + k, 1e9 + k))
    monkeypatch.setattr(summary, "judge_notebook", stub(wait))
    made = summary.summary(tmp_path)
    assert [each.file for each in made.entries] == [f"old/{SLUG} Ada.ipynb"]
    assert [left.reason.partition(":")[0] for left in made.left_out] == [
        "MemoryError",
        "KeyError",
        "RecursionError",
    ]
    assert all(left.wrong and left.who == "Ada" for left in made.left_out)


def test_terminal_shows_progress_on_one_line(tmp_path, monkeypatch, capsys):
    for who in ("a", "b\x1b[2J", "c"):
        notebook(tmp_path / "in" / who / f"{SLUG}.ipynb", f'check("{SLUG}.1", ...)')
    monkeypatch.setattr(summary, "judge_notebook", stub())
    assert main(["summary", str(tmp_path / "in"), "--to", str(tmp_path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 1 + 3 + 2 and "0 of 3 hold" in lines[1]
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True, raising=False)
    monkeypatch.setenv("COLUMNS", "80")
    assert main(["summary", str(tmp_path / "in"), "--to", str(tmp_path)]) == 0
    first, *files, end = capsys.readouterr().out.split("\n")
    assert re.findall(r"\d of \d", first)[:1] == ["0 of 3"] and "3 of 3: " in first
    assert len(files) == 2 and "\x1b" not in first and end == ""
    assert {len(each) for each in first.split("\r")[1:]} == {79}


@pytest.mark.parametrize(
    ("path", "who"),
    [
        ("03_irb140_motion Ada.ipynb", "Ada"),
        ("x/03_irb140_motion_Ada_Lovelace.ipynb", "Ada Lovelace"),
        ("lovelaceada_123_03_irb140_motion.ipynb", "lovelaceada 123"),
        ("1234567_03_IRB140_Motion.ipynb", "1234567"),
        ("Юрий/03_irb140_motion.ipynb", "Юрий"),
        ("Ada/irb140_motion-Copy1.ipynb", "Ada"),
        ("Ada/03_irb140_motion (2).ipynb", "Ada"),
        ("Ada/03_irb140_motion/03_irb140_motion.ipynb", "Ada"),
        ("Ada/ /03_irb140_motion.ipynb", "Ada"),
        ("Ada/homework.ipynb", "Ada"),
        ("ada.ipynb", "ada"),
        ("03_irb140_motion.ipynb", "03_irb140_motion"),
        ("J\udcfcrgen/x.ipynb", "J\\xfcrgen"),
        ("a\nb\u202e/x.ipynb", "a\\nb\\u202e"),
        (f"{'x' * 250}/x.ipynb", "x" * 200),
    ],
)
def test_notebook_path_determines_the_students_name(path, who):
    made = summary.who_of(Path(path))
    assert made == who and normalised(made)
