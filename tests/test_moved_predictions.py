"""A prediction that moves to another lab keeps its id: the new lab asks and counts it, and work on
older versions of the labs can still be read.
"""

import json

import pytest
from conftest import NOTEBOOKS
from handed import page, put, report_of, rows_of, stored

from robokin.course import book, check, predict, summary, summary_pages
from robokin.course.guesses import guesses, keep, read_guesses
from robokin.course.hand_in import _lab
from robokin.course.handed_in import handed_in
from robokin.course.judge import Judged
from robokin.course.report_page import told
from robokin.course.reported import report_data

ASKED = """
How long is half of a metre, asked as {name}?

- `half` **0.5 m.** Half of it.
- `whole` **1 m.** It is not. *the whole for a half:* Half of two is one.
- `twice` **2 m.** It is not. *twice for half:* Twice a half is one.
"""
FACTS = "def p{n}():\n    return {{'right': 'half', 'name': 'p{n}'}}\n"
EXERCISE = """# 1. Half

Objective 1. Half of a number.

## Solution

```python
def half(x):
    return x / 2
```
"""
CASES = "def cases(rng):\n    return [(x,) for x in rng.uniform(1, 9, 5)]\n"
LABS = {"early": ("p1", "p3"), "late": ("early.p2", "p1")}  # early used to ask p2
TIMES = [f"2026-11-23T12:00:0{k}.000+01:00" for k in range(9)]


@pytest.fixture(autouse=True)
def labs(tmp_path, monkeypatch):
    """Create two labs of a teacher."""
    for lab, headings in LABS.items():
        folder = tmp_path / "exercises" / lab
        folder.mkdir(parents=True)
        text = "".join(f"## {heading}\n{ASKED}\n" for heading in headings)
        (folder / "predictions.md").write_text(text)
        facts = "".join(FACTS.format(n=heading[-1]) for heading in headings)
        (folder / "predictions.py").write_text(facts)
        (folder / "half.md").write_text(EXERCISE)
        (folder / "half.py").write_text(CASES)
    monkeypatch.setenv(book.ELSEWHERE, str(tmp_path / "exercises"))


def asking(path, *ids):
    return stored(path, *(f'predict("{name}")' for name in ids))


def results(path):
    """Return the guesses in a report on the notebook: a dict that maps an id to (choice, whether it
    is right).
    """
    return {each.id: (each.choice, each.right) for each in guesses(handed_in(path))}


def reported(path, who="Ada"):
    """Return the data of a report on the notebook, read from its page."""
    handed = handed_in(path)
    return report_data(page(told(handed, who, Judged(None, (), guesses(handed), ()))))


def test_moved_prediction_is_found_only_by_its_old_id():
    assert book.ids("early", "predictions") == ["early.p1", "early.p3"]
    assert book.ids("late", "predictions") == ["early.p2", "late.p1"]
    assert book.home("early.p2") == "late" and book.home("early.p1") == "early"
    assert "asked as p2" in predict("early.p2").question
    assert "Right." in repr(predict("early.p2", "a"))
    for name in ("late.p2", "early.p9", "nobody.p2", "p2"):
        with pytest.raises(ValueError, match="id: wanted"):
            predict(name)
    assert check("late.1", lambda x: x / 2).holds


def test_two_predictions_of_a_lab_cannot_have_the_same_number(tmp_path):
    (tmp_path / "exercises" / "late" / "predictions.md").write_text(
        f"## early.p2\n{ASKED}\n## p2\n{ASKED}"
    )
    book._labs.cache_clear()
    lab = book.lab("late")
    lab.read()
    assert len(lab.broken) == 1 and "p2 occurs twice" in str(lab.broken)


def test_guess_is_reported_by_the_lab_that_now_asks_the_prediction(tmp_path):
    late = asking(tmp_path / "late.ipynb", "early.p2", "late.p1")
    early = asking(tmp_path / "early.ipynb", "early.p1", "early.p3")
    keep(late, [("early.p2", "b", TIMES[1]), ("late.p1", "a", TIMES[2])])
    keep(early, [("early.p1", "a", TIMES[3])])
    assert handed_in(late).lab == "late" and handed_in(early).lab == "early"
    assert results(late) == {"early.p2": ("b", False), "late.p1": ("a", True)}
    assert results(early) == {"early.p1": ("a", True), "early.p3": (None, None)}
    data = reported(late)
    assert [each["id"] for each in data["predictions"]] == ["early.p2", "late.p1"]
    assert data["lab"] == "late" and data["predictions"][0]["confusion"] == "the whole for a half"
    assert [each["id"] for each in reported(early)["predictions"]] == ["early.p1", "early.p3"]


def test_copied_line_is_read_by_the_lab_that_now_asks_the_prediction(tmp_path):
    cells = ['predict("early.p2")', 'predict("late.p1")']
    for line in ("p2 b, late.p1 a", "early.p2 b, p1 a", "p2 b, p1 a, early.p1 c"):
        late = stored(tmp_path / "late.ipynb", *cells, f'report("Ada", guesses="{line}")')
        assert results(late) == {"early.p2": ("b", False), "late.p1": ("a", True)}, line


def test_older_notebook_with_the_prediction_is_still_read(tmp_path):
    ids = ("early.p1", "early.p2", "early.p3")
    old = asking(tmp_path / "early.ipynb", *ids)
    first = {"early.p1": (None, None), "early.p3": (None, None)}
    assert handed_in(old).lab == "early" and results(old) == first, "p2 is no longer reported"
    keep(old, [("early.p2", "c", TIMES[1])])
    assert results(old) == first | {"early.p2": ("c", False)}
    assert [each["id"] for each in reported(old)["predictions"]] == [ids[0], ids[2], ids[1]]
    line = stored(tmp_path / "line.ipynb", *(f'predict("{p}")' for p in ids),
                  'report("Ada", guesses="p1 a, p2 b")')  # fmt: skip
    assert results(line) == {**first, "early.p1": ("a", True), "early.p2": ("b", False)}
    call = stored(tmp_path / "call.ipynb", f'predict("{ids[0]}", "a"); predict("{ids[1]}", "a")')
    assert results(call) == {**first, "early.p1": ("a", True), "early.p2": ("a", True)}
    # the new version of the notebook has the guesses of the old version, but no longer asks p2
    assert results(asking(old, "early.p1", "early.p3")) == first


def older_report(who, choice):
    """Return the data of a report on the lab early from the time when it still asked p2."""
    data = report_of(who, "early")
    data["predictions"].insert(1, {**data["predictions"][0], "id": "early.p2"})
    if choice:
        wrong = {"choice": choice, "right": False, "confusion": "the whole for a half"}
        data["predictions"][1] |= wrong
    return data


def test_older_report_is_still_read(tmp_path):
    for choice, count in (("b", 3), (None, 2)):
        data = report_data(page(older_report("Ada", choice)))
        assert len(data["predictions"]) == count
        assert [p["choice"] for p in data["predictions"]] == [None, None, "b"][:count]
    for name in ("late.p1", "early.p9", "scara_motion.p1"):
        other = json.loads(json.dumps(older_report("Ada", "b")).replace("early.p2", name))
        with pytest.raises(ValueError, match="predictions: wanted each id of the lab early"):
            report_data(page(other))


def test_summary_counts_a_moved_prediction_under_its_new_lab(tmp_path):
    old = older_report("Ada", "b")
    old["predictions"][0] |= {"choice": "c", "right": False, "confusion": "twice for half"}
    new = report_of("Bob", "late")
    assert new["predictions"][0]["id"] == "early.p2"
    new["predictions"][0] |= {"choice": "b", "right": False, "confusion": "the whole for a half"}
    for name, data in (("ada", old), ("bob", new)):
        put(tmp_path / "in" / f"{name}.html", data)
    made = summary.summary(tmp_path / "in")
    assert [(each.who, each.lab) for each in made.entries] == [("Ada", "early"), ("Bob", "late")]
    assert [each.guessed for each in made.entries] == [
        "0 right of 2 made (3 asked)",
        "0 right of 1 made (2 asked)",
    ]
    assert summary_pages.confusions(made) == [
        ("early.p1", "twice for half", ["Ada"]),
        ("early.p2", "the whole for a half", ["Ada", "Bob"]),
    ]
    shown = rows_of(summary_pages.page_of(made, ["a", "b"]), "counted")
    [row] = [row for row in shown if "asked as p2" in row[0]]
    assert row[0].startswith(f"{book.titled('late').capitalize()}: ") and row[2] == "2"


def test_notebook_does_not_take_guesses_from_a_renamed_notebook_of_another_lab(tmp_path):
    ids = ("early.p1", "early.p2", "early.p3")
    old = asking(tmp_path / "early.ipynb", *ids)
    keep(old, [(name, "a", TIMES[k]) for k, name in enumerate(ids)])
    mine = old.rename(tmp_path / "mine.ipynb")
    late = asking(tmp_path / "late.ipynb", "early.p2", "late.p1")
    assert read_guesses(late) is None
    keep(late, [("early.p2", "c", TIMES[5])])
    assert {name: made[0][0] for name, made in read_guesses(mine).items()} == dict.fromkeys(
        ids, "a"
    )
    assert [choice for choice, _ in read_guesses(late)["early.p2"]] == ["c"]


def test_notebook_without_a_name_is_recognised_by_its_predictions():
    assert _lab(['predict("early.p2")', 'hint("late.1")']) == "late"
    assert _lab(['predict("early.p2")', 'predict("early.p1")', 'predict("early.p3")']) == "early"
    assert _lab(['print("os.1")']) is None


def test_labs_13_and_14_ask_predictions_moved_from_labs_11_and_08(tmp_path):
    moved = {
        "rotor": ["motor_synchronisation.p8", "motor_synchronisation.p10"],
        "conveyor": ["visit_and_collect.p9"],
    }
    for lab, ids in moved.items():
        first = ids[0].partition(".")[0]
        [new], [old] = (list(NOTEBOOKS.glob(f"*_{each}.ipynb")) for each in (lab, first))
        assert handed_in(new).lab == lab and set(ids) <= set(results(new))
        assert handed_in(old).lab == first and not set(ids) & set(results(old))
        before = asking(tmp_path / old.name, *(f"{first}.p{k}" for k in range(1, 8)), *ids)
        keep(before, [(name, "a", TIMES[k]) for k, name in enumerate(ids)])
        assert handed_in(before).lab == first and set(ids) <= set(results(before))
