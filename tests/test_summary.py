"""`python -m robokin.course summary`: the teacher's table, against one that is counted here."""

import csv
import html
import os
import random
import re
from collections import Counter, defaultdict
from dataclasses import asdict, replace

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_notebook

from robokin import course
from robokin.course import book, summary
from robokin.course.__main__ import main
from robokin.course.handed_in import handed_in
from robokin.course.judge import Guess, Judged, Limits, Result
from robokin.course.report_page import page_of, told
from robokin.course.variants import normalised

NAMES = """Ada Grace Mary Юрий Łukasz José Zoë Ng O'Neil कमला =SUM(A1) +49 -1 @home Li Wei Max Eva
Noor Otto Pia Quinn Rosa Sven Tom Uma Vera Will Xi Yara""".split()
SLUGS = ("irb140_motion", "scara_motion", "three_levers")
MISTAKES = ("takes degrees", "the sign", None)


def notebook(path, *cells):
    nbformat.write(new_notebook(cells=[new_code_cell(cell) for cell in cells]), path)
    return path


def results(slug, dice):
    """Verdicts and guesses of a student, drawn."""
    exercises = []
    for n, exercise in book.lab(slug).EXERCISES.items():
        state = dice.choice(("holds", "does not hold", "does not hold", "unanswered", "failed"))
        made = Result(f"{slug}.{n}", exercise.task, exercise.objective, state)
        if state == "holds":
            made = replace(made, points=1.0)
        if state == "does not hold":
            made = replace(made, points=dice.choice((0.1, 0.5)), mistake=dice.choice(MISTAKES))
        exercises.append(made)
    guesses = [Guess(f"{slug}.{n}") for n in book.lab(slug).PREDICTIONS]
    for k in dice.sample(range(len(guesses)), 4):
        wrong = dice.random() < 0.6
        confusion = dice.choice(("the elbow", "the path", None)) if wrong else None
        guesses[k] = replace(guesses[k], choice="b", right=not wrong, confusion=confusion)
    return Judged(None, tuple(exercises), tuple(guesses), ())


@pytest.fixture(scope="module")
def handed(tmp_path_factory):
    """A folder of thirty students' reports, one of them cut off, and a notebook that is none; and
    what was drawn for each.
    """
    folder, dice = tmp_path_factory.mktemp("handed"), random.Random(14)
    drawn = {}
    for k, name in enumerate(NAMES):
        slug = SLUGS[k % 3]
        place = folder / f"student {k}"
        place.mkdir()
        lab = notebook(folder / ".lab.ipynb", f'check("{slug}.1", ...)')
        judged = results(slug, dice)
        data = told(handed_in(lab), name, judged)
        page = page_of(data, new_notebook(), folder)
        (place / "report.html").write_text(page, encoding="utf-8")
        drawn[name] = slug, judged
    # the last one's is cut off, and a notebook that is none lies among them
    page = place / "report.html"
    text = page.read_text(encoding="utf-8")
    page.write_text(text[: text.index('"predictions"')], encoding="utf-8")
    drawn.pop(name)
    (folder / "student 3" / "03_irb140_motion.ipynb").write_text("{}")
    (folder / "student 4" / ".ipynb_checkpoints").mkdir()
    (folder / "student 4" / ".ipynb_checkpoints" / "x.ipynb").write_text("{}")
    (folder / "student 5" / "other.html").write_text("<p>no report</p>")
    notebook(folder / "student 6" / "notes.ipynb", "1")
    return folder, drawn


def test_the_table_says_what_was_handed_in(handed, tmp_path, capsys):
    folder, drawn = handed
    assert main(["summary", str(folder), "--to", str(tmp_path)]) == 1
    said = capsys.readouterr()
    assert len(said.err.splitlines()) == 2
    assert re.search(r"student 3/03_irb140_motion.ipynb: not a notebook", said.err)
    assert re.search(r"student 29/report.html: a report that cannot be read", said.err)
    with open(tmp_path / "summary.csv", encoding="utf-8-sig", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(drawn) == 29 and len(rows) == 31
    assert [row["problem"][:8] for row in rows[29:]] == ["a report", "not a no"]
    assert not any(row["problem"] for row in rows[:29])
    seen = set()
    for row in rows[:29]:
        name = row["who"].removeprefix("'") if row["who"][0] == "'" else row["who"]
        slug, judged = drawn[name]
        seen.add(name)
        assert row["lab"] == slug and row["file"].startswith("student ")
        for each in judged.exercises:
            n = each.id[-1]
            assert row[f"exercise {n}"] == each.state
            assert float(row[f"points {n}"]) == each.points
            assert row[f"mistake {n}"] == (each.mistake or "")
        assert float(row["points"]) == pytest.approx(sum(e.points for e in judged.exercises))
        for k in (1, 2, 3):
            states = {e.state for e in judged.exercises if e.objective == k}
            wanted = "holds" if states == {"holds"} else "begun"
            assert row[f"objective {k}"] == ("not yet" if states == {"unanswered"} else wanted)
        right = [g.right for g in judged.predictions if g.choice]
        assert (row["predictions made"], row["predictions right"]) == ("4", str(sum(right)))
        assert row["predictions wrong"].count("; ") + 1 == max(1, right.count(False))
    assert seen == set(drawn)
    for row in rows:
        assert not any(cell.startswith(("=", "+", "-", "@")) for cell in row.values())


def test_mistakes_and_confusions_are_counted(handed, tmp_path):
    folder, drawn = handed
    made = summary.summary(folder)
    wrong, guessed = defaultdict(list), defaultdict(list)
    for name, (_, judged) in drawn.items():
        for each in judged.exercises:
            if each.state == "does not hold":
                wrong[each.id, each.mistake or "not recognised"].append(name)
        for each in judged.predictions:
            if each.right is False:
                guessed[each.id, each.confusion or "another number"].append(name)
    for rows, wanted in ((summary.mistakes(made), wrong), (summary.confusions(made), guessed)):
        assert {(a, b): sorted(who) for a, b, who in rows} == {
            key: sorted(who) for key, who in wanted.items()
        }
        counts = defaultdict(list)
        for name, _, who in rows:
            counts[name].append(len(who))
        assert all(each == sorted(each, reverse=True) for each in counts.values())
        assert max(map(max, counts.values())) > 1
        labs = [book.LABS.index(name.partition(".")[0]) for name, _, _ in rows]
        assert labs == sorted(labs)
    page = summary.page_of(made)
    for (name, what), who in [*wrong.items(), *guessed.items()]:
        assert f"<td>{name}</td><td>{what}</td><td>{len(who)}</td>" in page
    assert "03_irb140_motion.ipynb" in page and "left out: 1" in page
    assert Counter(re.findall(r"<td>(\w+)</td>", page))["irb140_motion"] == 10


def test_nothing_of_yours_is_overwritten(handed, tmp_path):
    folder, _ = handed
    made = summary.Summary()
    table, page = summary.write(made, tmp_path)
    first = table.read_bytes()
    assert first.startswith(b"\xef\xbb\xbfwho,lab,file,date,")
    summary.write(made, tmp_path)
    assert table.read_bytes() == first and sorted(os.listdir(tmp_path)) == [table.name, page.name]
    for path, words in ((table, "mine;mine"), (page, "<!DOCTYPE html><!-- robokin player -->")):
        before = path.read_bytes()
        path.write_text(words)
        with pytest.raises(ValueError, match="nothing is overwritten"):
            summary.write(made, tmp_path)
        assert main(["summary", str(folder), "--to", str(tmp_path)]) == 1
        assert path.read_text() == words
        path.write_bytes(before)
    with pytest.raises(ValueError, match="folder: wanted"):
        summary.summary(tmp_path / "none")
    with pytest.raises(ValueError, match="to: wanted"):
        summary.write(made, tmp_path / "none")


def test_notebooks_are_judged_anew_and_the_newest_counts(tmp_path):
    ada, bob = tmp_path / "Ada", tmp_path / "bob_17"
    ada.mkdir()
    bob.mkdir()
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
    given = handed_in(new)
    data = told(given, "ada", Judged(None, (), (), ("from the report",)))
    data["exercises"] = [asdict(Result("irb140_motion.1", "task", 1))]
    (tmp_path / "ada.html").write_text(page_of(data, new_notebook(), tmp_path), encoding="utf-8")
    os.utime(old, (1e9, 1e9))
    os.utime(new, (1.1e9, 1.1e9))
    heard = []
    made = summary.summary(tmp_path, Limits(cell=20), heard.append)
    assert made.broken == [] and len(heard) == 2
    first, second = made.entries
    assert (first.who, first.file) == ("ada", "ada.html")
    assert first.data["remarks"] == ["from the report"]
    assert any("the newest counts: ada.html" in remark for remark in made.remarks)
    assert (second.who, second.lab) == ("bob_17", "scara_motion")
    assert [e["state"] for e in second.data["exercises"]] == ["unanswered"] * 2 + ["holds"]
    assert second.data["remarks"] == ["scara_motion.3: judged with the numbers of 'Bob'."]
    page = summary.page_of(made)
    listed = re.findall(r"<li>(.*?)</li>", page[page.index("<h2>Remarks</h2>") :])
    assert [html.unescape(each) for each in listed] == made.remarks
    assert "<h2>Remarks" not in summary.page_of(summary.Summary())
    assert second.data["predictions"][0]["choice"] == "b"


@pytest.mark.parametrize(
    ("path", "who"),
    [
        ("03_irb140_motion Ada.ipynb", "Ada"),
        ("x/03_irb140_motion_Ada_Lovelace.ipynb", "Ada Lovelace"),
        ("lovelaceada_123_03_irb140_motion.ipynb", "lovelaceada 123"),
        ("Юрий/03_irb140_motion.ipynb", "Юрий"),
        ("Ada/irb140_motion-Copy1.ipynb", "Ada"),
        ("Ada/03_irb140_motion (2).ipynb", "Ada"),
        ("Ada/homework.ipynb", "Ada"),
        ("ada.ipynb", "ada"),
        ("03_irb140_motion.ipynb", "03_irb140_motion"),
    ],
)
def test_whose_a_notebook_is(path, who, tmp_path):
    made = summary.who_of(tmp_path.joinpath(path).relative_to(tmp_path), "irb140_motion")
    assert made == who and normalised(made)
