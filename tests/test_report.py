"""`python -m robokin.course report`: a lab is judged again and written as one page to hand in.

The labs are written here, so that the verdict on every answer is known in advance.
"""

import io
import re
import sys
from html import unescape
from types import SimpleNamespace

import pytest
from conftest import NOTEBOOKS, awake, until
from handed import cell, report_of, stored
from nbformat.v4 import new_markdown_cell, new_notebook

from robokin import course
from robokin.course import book, solution
from robokin.course.__main__ import main
from robokin.course.handed_in import handed_in
from robokin.course.judge import Judged, Limits, Result, guesses
from robokin.course.report_page import objectives, page_of, portable, report, told
from robokin.course.reported import STATES, report_data

QUICK = Limits(cell=12, all=100)
SHORT = Limits(cell=4, all=100)
IMPORTS = "from robokin.course import check, predict, variant\nimport numpy as np"
PLAYER = """\
from robokin import IRB140, Transform, deg, ptp
from robokin.show import animate
t = np.linspace(0, 2, 41)
q = ptp(np.zeros(6), np.array([90, 30, -60, 45, 60, 120]) * deg, t / 2)
animate(IRB140, t, q, title="A turn of every joint")"""


@pytest.fixture(scope="module")
def hostile(tmp_path_factory):
    """A lab with nearly every possible problem, which is judged once: its path, its page, and the
    data of the page.
    """
    folder = tmp_path_factory.mktemp("hostile")
    lab = stored(
        folder / "Ada's homework.ipynb",
        new_markdown_cell("# A hostile lab\n\nThe angle is $\\frac{\\pi}{2}$."),
        new_markdown_cell("It is $\\nonsense$."),
        IMPORTS,
        PLAYER,
        'predict("scara_motion.p1", "a")',
        'predict("scara_motion.p2", choice="c")\npredict("scara_motion.p3", "z")',
        'predict("scara_motion.p4")',
        "1 / 0",
        "import os\nprint('I shall die')\nos._exit(1)",
        "while True:\n    print('x' * 1000)",
        solution("scara_motion.1"),
        '%time 1\ncheck("scara_motion.1", answer=least_turn)',
        "def inside(q, limits, lengths):\n    return True",
        cell('course_check = check\ncheck("scara_motion.2", inside)', "scara_motion.2: holds."),
        solution("scara_motion.3"),  # solves the variant of "your name"
        cell('check("scara_motion.3", design, who=who)', "scara_motion.3: holds."),
        "exit()",
        "print('still here')",
    )
    page = report(lab, "Ada Lovelace", folder, SHORT)
    text = page.read_text(encoding="utf-8")
    return SimpleNamespace(lab=lab, page=page, text=text, data=report_data(text))


def test_verdicts_match_the_answers(hostile):
    one, two, three = hostile.data["exercises"]
    assert (one["id"], one["state"], one["points"]) == ("scara_motion.1", "holds", 1)
    wrong = course.check("scara_motion.2", lambda *case: True)
    assert two["state"] == "does not hold" and two["points"] == wrong.points < 1
    assert (two["mistake"], two["case"]) == (wrong.mistake, wrong.case) and wrong.mistake
    assert tuple(two["says"]) == wrong.says
    # the answer is correct for "your name", but Ada's numbers differ
    assert three["state"] == "does not hold"
    assert [state for _, state in objectives(hostile.data)] == ["holds", "begun", "begun"]
    assert hostile.data["who"] == "Ada Lovelace" and hostile.data["lab"] == "scara_motion"
    assert hostile.data["numbers"] == str(course.variant("scara_motion", "Ada Lovelace"))


def test_anomalies_in_a_notebook_are_reported(hostile):
    remarks = "\n".join(hostile.data["remarks"])
    for said in (
        'scara_motion.2: the stored output says "holds"; judged again, it is "does not hold".',
        "scara_motion.3: the notebook uses the numbers of 'your name', not of 'Ada Lovelace'.",
        "(ZeroDivisionError)",
        "The kernel died in this cell.",
        "its output was too long",
        ": Stopped after 4 s.",
        "is shown as it was typed",
    ):
        assert said in remarks, said
    assert "scara_motion.1:" not in remarks
    for said in (
        "I shall die",
        "The kernel died in this cell.",
        "Stopped after 4 s.",
        "still here",
    ):
        assert said in hostile.text, said
    assert "ZeroDivisionError" in hostile.text and "x" * 1000 in hostile.text
    # a player and three predictions are made again, since the lab was handed in without them
    assert len(hostile.text.encode()) < hostile.lab.stat().st_size + 500_000 + 200_000


def test_predictions_are_reported_as_they_were_made(hostile):
    made = {each["id"].partition(".p")[2]: each for each in hostile.data["predictions"]}
    assert len(made) == len(book.lab("scara_motion").predictions)
    for number, letter in (("1", "a"), ("2", "c")):
        asked = course.predict(f"scara_motion.p{number}", letter)
        assert made[number]["choice"] == letter
        assert made[number]["right"] == (asked.at == asked.right)
        assert made[number]["confusion"] == asked.options[asked.at].confusion
    assert made["3"]["right"] is False and "no choice" in made["3"]["confusion"]
    assert {made[n]["right"] for n in made if n not in "123"} == {None}


def test_report_works_from_a_file(hostile, browser, tmp_path):
    context = browser.new_context(viewport={"width": 1000, "height": 900}, offline=True)
    page, complaints, asked = context.new_page(), [], []
    page.on("console", lambda m: m.type in ("error", "warning") and complaints.append(m.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", lambda request: asked.append(request.url))
    page.goto(hostile.page.as_uri())
    awake(page)
    [formula] = page.locator("math mfrac").all()
    assert formula.bounding_box()["height"] > 15
    assert "It is $\\nonsense$." in page.locator("main").inner_text(), (
        "wanted the invalid formula as it was typed"
    )
    head = page.locator(".rk-report")
    assert "Ada Lovelace" in head.inner_text() and "A hostile lab" in head.inner_text()
    player = page.locator("div.robokin-player", has=page.get_by_label("playback speed")).first
    player.scroll_into_view_if_needed()
    arm = player.locator("canvas").first
    before = arm.screenshot()
    player.get_by_role("slider").first.fill("1.0")
    until(lambda: arm.screenshot() != before, "the arm does not move", page)
    asking = page.locator("div.robokin-player", has_text="d) ").last
    assert asking.get_by_role("radio").count() >= 3, "missing predictions can still be made"
    page.set_viewport_size({"width": 390, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") <= 392
    pdf = page.pdf(path=tmp_path / "report.pdf", format="A4")
    assert pdf.startswith(b"%PDF") and len(re.findall(rb"/Type\s*/Page\b", pdf)) >= 2
    assert complaints == []
    assert [url for url in asked if not url.startswith(("file:", "data:", "blob:"))] == []
    context.close()


def test_header_lists_guesses_and_titles_in_lab_order(tmp_path):
    slug = "irb140_motion"
    lab, data = book.lab(slug), report_of("Ada", slug)
    typed = next(n for n, each in lab.predictions.items() if each.unit == "°")
    for each in data["predictions"]:
        number = each["id"].partition(".")[2]
        choice = {"p1": "b", "p9": "a", typed: "-90"}.get(number)
        each |= {"choice": choice, "right": choice and False}
    data["predictions"][0]["later"] = ["a", "<b>"]
    header = page_of(data, new_notebook(), tmp_path).partition("<header")[2].partition("<main")[0]
    said = [unescape(text) for text in re.findall(r">\s*([^<>]+?)\s*<", header)]
    titles = [each.title for each in lab.exercises.values()]
    assert [text for text in said if text in titles] == titles
    assert [text for text in said if re.fullmatch(r"objective \d", text)] == [
        f"objective {k}" for k in range(1, 4)
    ], "the objectives follow the exercises"
    one, nine = (course.predict(f"{slug}.{n}").options for n in ("p1", "p9"))
    for words in (f"b) {one[1].text}", f"later: a) {one[0].text}", f"a) {nine[0].text}", "−90°"):
        assert words.replace("`", "") in said, words
    assert "later: <b>" in said
    missing, optional = (said[said.index(word) - 1] for word in ("not made", "optional, not made"))
    left = [n for n in lab.predictions if n not in ("p1", "p9", typed)]
    later = [n for n in left if lab.predictions[n].optional]
    assert missing.split(", ") == [n for n in left if n not in later]
    assert optional.split(", ") == later and 1 < len(later) < len(left)


def test_report_is_only_a_little_larger_than_the_lab():
    for path in sorted(NOTEBOOKS.glob("*.ipynb"), key=lambda path: path.stat().st_size)[-2:]:
        given = handed_in(path)
        says = ("A sentence about what is wrong and how it can be mended, of usual length.",) * 4
        made = [
            Result(f"{given.lab}.{n}", e.task, e.objective, "failed", "the mistake", says, "case")
            for n, e in book.lab(given.lab).exercises.items()
        ]
        judged = Judged(given.notebook, tuple(made), guesses(given), says * 5)
        page = page_of(told(given, "Ada", judged), given.notebook, path.parent)
        assert len(page.encode()) < path.stat().st_size + 500_000


@pytest.mark.parametrize(
    ("name", "kept"),
    [
        ("Ada Lovelace", "Ada_Lovelace"),
        ("Юрий Поляков", "Юрий_Поляков"),
        ("José-María", "José-María"),
        ('a/b\\c:d*e?f"g<h>i|j', "a_b_c_d_e_f_g_h_i_j"),
        ("../../etc", "etc"),
        ("कमला", "कमला"),
        ("...", "lab"),
        ("x" * 300, "x" * 100),
        ("ж" * 300, "ж" * 50),
    ],
)
def test_name_of_the_student_becomes_part_of_the_file_name(name, kept):
    assert portable(name) == kept


def test_other_files_are_not_overwritten(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    lab = stored(tmp_path / "my lab.ipynb", new_markdown_cell("# Notes"), "print(1 + 1)")
    page = tmp_path / "my_lab_Ada.html"
    page.write_text("mine")
    (tmp_path / "bad.ipynb").write_text("{}")
    assert main(["report", "bad.ipynb", str(lab), "lost.ipynb", "--name", "Ada"]) == 1
    said = capsys.readouterr()
    assert page.read_text() == "mine" and "nothing is overwritten" in said.err
    assert "bad.ipynb: not a notebook" in said.err and "lost.ipynb: No such file" in said.err
    page.unlink()
    assert (
        main(["report", str(lab), "--name", "Ada"]) == 0
    )  # this is not one of our labs, so it has no exercises
    said = capsys.readouterr()
    assert "my_lab_Ada.html" in said.out and said.err == ""
    text = page.read_text(encoding="utf-8")
    data = report_data(text)
    assert data["lab"] is None and data["exercises"] == [] and data["title"] == "Notes"
    assert "no robokin exercises" in text and ">2\n<" in text
    page.write_text(text.replace('"who":"Ada"', '"who":"Bob"'))
    assert main(["report", str(lab), "--name", "Ada"]) == 1, "the page is another student's"
    for name in ("", " "):
        with pytest.raises(ValueError, match="name: wanted"):
            report(lab, name, tmp_path)
    with pytest.raises(ValueError, match="to: wanted a folder"):
        report(lab, "Ada", tmp_path / "none")


def test_invalid_report_data_are_refused(hostile):
    assert report_data("<!DOCTYPE html><p>A page</p>") is None
    for this, that in (
        ('"state":"holds"', '"state":"perfect"'),
        ('"points":1}', '"points":7}'),
        ('"report":2', '"report":3'),
        ('"lab":"scara_motion"', '"lab":"os"'),
        ('"who":"Ada Lovelace"', '"who":["Ada"]'),
        ('"made":"20', '"made":"x20'),
        ('"remarks":[', '"remarks":['[:-1] + "{"),
    ):
        assert this in hostile.text
        with pytest.raises(ValueError, match="a report that cannot be read"):
            report_data(hostile.text.replace(this, that, 1))
    with pytest.raises(ValueError, match="a report that cannot be read"):
        report_data(hostile.text[: hostile.text.index('"exercises"')])
    assert set(STATES) >= {each["state"] for each in hostile.data["exercises"]}


def test_student_text_is_escaped(tmp_path, monkeypatch):
    evil = "</script><script>alert(1)</script>"
    monkeypatch.setattr(sys, "stdout", io.StringIO())
    lab = stored(tmp_path / "x.ipynb", new_markdown_cell(f"# Title {evil}"))
    text = report(lab, f"Ada {evil}", tmp_path, QUICK).read_text(encoding="utf-8")
    head = text[text.index('<script type="application/json"') : text.index("</header>")]
    assert "<script>" not in head and report_data(text)["who"] == f"Ada {evil}"
