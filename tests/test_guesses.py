"""Guesses made in a page are saved next to their notebook, and a report lists them in order,
whatever other files are in the folder.
"""

import json
import os
import re
import shutil
import threading
import time
from datetime import datetime
from types import SimpleNamespace

import nbformat
import pytest
import test_browser
from conftest import awake, until
from playwright.sync_api import expect

from robokin.course import book, predict
from robokin.course import guesses as hub
from robokin.course.copies import copy
from robokin.course.guesses import Guess, guesses, keep, parse_line, read_guesses
from robokin.course.handed_in import handed_in
from robokin.show.joiner import script

page = test_browser.page  # records errors and requests to other hosts
LAB = "irb140_motion"
P1, P2 = f"{LAB}.p1", f"{LAB}.p2"
OTHER = "scara_motion.p1"
TYPED = next(p for p in book.ids(LAB, "predictions") if book.find(p, "predictions").unit)
KEPT = "Saved for your report."
RUN = "Saved in this browser only. Run > Run All Cells saves it for your report."


def at(second):
    return f"2026-11-23T12:00:{second:02}.000+01:00"


def notebook(path, *cells, ids=()):
    """Write a notebook with these code cells and one for each prediction, none of them run; return
    its path.
    """
    sources = [
        *(["from robokin.course import predict"] if ids else []),
        *(f'predict("{name}")' for name in ids),
        *cells,
    ]
    v4 = nbformat.v4
    made = [v4.new_markdown_cell("# Guesses"), *map(v4.new_code_cell, sources)]
    kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    path.parent.mkdir(exist_ok=True)
    nbformat.write(v4.new_notebook(cells=made, metadata={"kernelspec": kernel}), path)
    return path


def written(folder, text):
    (folder / ".robokin").mkdir(exist_ok=True)
    (folder / ".robokin" / "guesses.json").write_text(text)


def chosen(path):
    return {name: [c for c, _ in made] for name, made in (read_guesses(path) or {}).items()}


# --- The file of guesses --------------------------------------------------------------------------


def test_guesses_are_saved_by_notebook_in_chronological_order_without_duplicates(tmp_path):
    one, two = notebook(tmp_path / "1.ipynb", ids=[P1]), notebook(tmp_path / "2.ipynb", ids=[P1])
    assert read_guesses(one) is None
    keep(one, [(P1, "b", at(5)), (TYPED, "-290", at(6))])
    keep(two, [(P1, "d", at(1))])
    keep(one, [(P1, "a", "2026-11-23T11:00:03Z"), (P1, "b", at(5)), (P1, "b", at(7))])
    assert chosen(one) == {P1: ["a", "b", "b"], TYPED: ["-290"]}
    assert chosen(two) == {P1: ["d"]}
    times = [datetime.fromisoformat(time) for _, time in read_guesses(one)[P1]]
    assert times == [datetime.fromisoformat(at(s)) for s in (3, 5, 7)]
    before = os.stat(tmp_path / ".robokin" / "guesses.json")
    keep(one, [(P1, "b", at(5))])
    assert os.stat(tmp_path / ".robokin" / "guesses.json").st_mtime_ns == before.st_mtime_ns


def test_simultaneous_kernels_lose_no_guesses(tmp_path):
    paths = [notebook(tmp_path / f"{k}.ipynb", ids=[P1]) for k in range(6)]
    wait = threading.Barrier(len(paths))

    def write(path):
        wait.wait()
        for second in range(10):
            keep(path, [(P1, "abcd"[second % 4], at(second))])

    threads = [threading.Thread(target=write, args=(path,)) for path in paths]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(chosen(path) == {P1: list("abcdabcdab")} for path in paths)
    assert set(os.listdir(tmp_path / ".robokin")) == {"guesses.json", "guesses.lock"}


def test_renamed_notebook_keeps_its_guesses(tmp_path):
    lab, other = (
        notebook(tmp_path / "lab.ipynb", ids=[P1]),
        notebook(tmp_path / "x.ipynb", ids=[P2]),
    )
    keep(lab, [(P1, "b", at(1))])
    keep(other, [(P2, "a", at(1))])
    fresh = notebook(tmp_path / "fresh.ipynb", ids=[P1])
    assert read_guesses(fresh) is None, "a new notebook took the guesses of an existing one"
    fresh.unlink()
    mine = lab.rename(tmp_path / "lab of Ada.ipynb")
    assert chosen(mine) == {P1: ["b"]}
    keep(mine, [(P1, "c", at(2))])
    assert chosen(mine) == {P1: ["b", "c"]} and chosen(other) == {P2: ["a"]}
    assert read_guesses(notebook(tmp_path / "lab.ipynb", ids=[P1])) is None, (
        "a new notebook took the guesses of the renamed one"
    )


HOSTILE = [
    "",
    "{",
    "[]",
    "null",
    "[" * 100_000,
    '{"guesses": 2, "notebooks": {}}',
    '{"guesses": 1, "notebooks": []}',
    '{"guesses": 1, "notebooks": {"lab.ipynb": [1]}}',
    *(
        json.dumps({"guesses": 1, "notebooks": {"lab.ipynb": kept}})
        for kept in (
            {P1: "b"},
            {P1: [["b"]]},
            {P1: [["b", None]]},
            {P1: [["b", "yesterday"]]},
            {P1: [["b", "2026-11-23T12:00:00"]]},
            {P1: [["b", "0001-01-01T00:00:00+14:00"]]},
            {P1: [["b", 1e99]]},
            {P1: [[2, at(1)]]},
            {P1: [["<b>", at(1)]]},
            {P1: [["\ud800", at(1)]]},
            {P1: [["1" * 31, at(1)]]},
            {"<script>": [["b", at(1)]]},
            {"../../x.p1": [["b", at(1)]]},
            {P1: [["b", at(1)]] * 30_000},
        )
    ),
]


@pytest.mark.parametrize("text", HOSTILE, ids=lambda text: text[:70])
def test_file_that_is_not_ours_is_refused_and_not_overwritten(tmp_path, text):
    lab = notebook(tmp_path / "lab.ipynb", f'predict("{P1}", "c")')
    written(tmp_path, text)
    with pytest.raises(ValueError, match=r"guesses\.json cannot be used: "):
        read_guesses(lab)
    remarks = []
    made = guesses(handed_in(lab), remarks)
    assert made[0].choice == "c" and "guesses.json cannot be used" in remarks[0]
    for choice in "ab":  # the first call moves the bad file aside; the second finds a good one
        keep(lab, [(P1, choice, at(ord(choice) - 90))])
    assert chosen(lab) == {P1: ["a", "b"]}
    assert (tmp_path / ".robokin" / "guesses.broken1.json").read_text() == text


def test_special_files_are_refused(tmp_path):
    lab = notebook(tmp_path / "lab.ipynb", ids=[P1])
    (tmp_path / ".robokin").mkdir()
    file = tmp_path / ".robokin" / "guesses.json"
    kinds = [file.mkdir, lambda: file.symlink_to("/dev/zero"), lambda: file.symlink_to("nowhere")]
    for make in [*kinds, *([lambda: os.mkfifo(file)] if hasattr(os, "mkfifo") else [])]:
        make()
        with pytest.raises(ValueError, match="not a regular file"):
            read_guesses(lab)
        file.rmdir() if file.is_dir() else file.unlink()


def test_unknown_predictions_and_notebooks_are_left_out(tmp_path):
    lab = notebook(tmp_path / "lab.ipynb", ids=[P1])
    mine = {P1: [["e", at(2)], ["b", "2026-11-23<12:00:01+01:00"]], "os.p1": [["a", at(1)]]}
    names = {name: {P1: []} for name in ("a\0b", "x" * 5000, "../..", "", "\ud800.ipynb")}
    written(
        tmp_path,
        json.dumps({"guesses": 1, "notebooks": {"lab.ipynb": {**mine, f"{LAB}.p99": []}, **names}}),
    )
    assert chosen(lab) == {P1: ["b", "e"]}
    assert "<" not in str(read_guesses(lab))
    keep(lab, [(P1, "c", at(3))])
    assert chosen(lab) == {P1: ["b", "e", "c"]}


def test_large_file_of_guesses_is_read_quickly(tmp_path):
    names = {f"{k}.ipynb": {f"{LAB}.p{k % 900}": []} for k in range(20_000)}
    written(tmp_path, json.dumps({"guesses": 1, "notebooks": names}))
    lab = notebook(tmp_path / "lab.ipynb", "predict('" + "x" * 3_000_000, ids=[P1])
    begun = time.process_time()
    assert read_guesses(lab) is None
    assert time.process_time() - begun < 2


def test_copies_have_no_guesses_and_plain_shells_save_none(tmp_path, monkeypatch):
    keep(notebook(tmp_path / "labs" / "01_lab.ipynb", ids=[P1]), [(P1, "b", at(1))])
    copy(tmp_path / "mine", tmp_path / "labs")
    assert [path.name for path in (tmp_path / "mine").rglob("guesses*")] == []

    monkeypatch.delenv("JPY_SESSION_NAME", raising=False)
    assert hub.own_notebook() is None, "the tests do not run in a kernel"
    shell = SimpleNamespace(kernel=1, user_ns={})
    monkeypatch.setitem(hub.sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell))
    assert hub.own_notebook() is None, "nbval and nbclient show no page"
    monkeypatch.setenv("JPY_SESSION_NAME", "/labs/lab.ipynb")
    assert hub.own_notebook().name == "lab.ipynb"
    monkeypatch.setenv("ROBOKIN_JUDGE", "1")
    monkeypatch.setattr(hub, "_hub", None)
    hub.listen()
    assert hub._hub is None, "a judging kernel opened a connection"


def test_guesses_are_saved_next_to_the_current_notebook(tmp_path):
    one = notebook(tmp_path / "labs" / "one.ipynb", ids=[P1])
    said = {"n": 3, "path": "labs/one.ipynb", "guesses": [[P1, "b", at(1)]]}
    assert hub._told(said, one) == {"n": 3, "first": {P1: "b"}} and chosen(one) == {P1: ["b"]}
    moved = one.rename(tmp_path / "labs" / "two.ipynb")
    later = {"path": "labs/two.ipynb", "guesses": [[P1, "c", at(2)]]}
    assert hub._told(said | later, one) == {"n": 3, "first": {P1: "b"}}, "b is the first guess"
    assert chosen(moved) == {P1: ["b", "c"]}
    for wrong in (
        {"path": "labs/none.ipynb"},
        {"path": None},
        {"path": 3},
        {"path": "labs/two.ipynb", "guesses": [[P1, "b", "now"]]},
        {"path": "labs/two.ipynb", "guesses": [[P1, "<b>", at(1)]]},
        {"path": "labs/two.ipynb", "guesses": None},
    ):
        assert hub._told(said | wrong, one)["error"]
    assert chosen(moved) == {P1: ["b", "c"]}


# --- Guesses in a report --------------------------------------------------------------------------


def test_line_of_guesses_is_parsed_or_refused():
    assert parse_line("") == parse_line("  ") == {}
    made = {"p1": "b", "p10": "a", "p5": "-290", "p6": "1e-3", OTHER: "c"}
    line = f" p1 b,p10  a , p5 -290,p6 1e-3, {OTHER} c"
    assert list(parse_line(line).items()) == list(made.items())
    for wrong in (
        "p1",
        ".p1 b",
        "a/b.p1 b",
        "p1 b p2 c",
        "p1 b,",
        "1 b",
        "p1 <b>",
        "p1 b, p1 c",
        "b",
        "p1: b",
        "p1 g",
    ):
        with pytest.raises(ValueError, match="guesses: wanted"):
            parse_line(wrong)


def test_saved_guesses_take_precedence_over_those_in_the_line_and_the_cells(tmp_path):
    asked, typed = predict(P1), predict(TYPED)
    right = "abcd"[asked.right]
    wrong = "abcd"[(asked.right + 1) % 4]
    number = TYPED.partition(".")[2]
    value = typed.options[typed.right].text
    lab = notebook(
        tmp_path / "lab.ipynb",
        f'predict("{P1}", "{right}")\npredict("{P2}", "b")',
        f'predict("{TYPED}", {float(value)})',
        'report("Ada", guesses="p9 a")',
        f'report(who, guesses="p1 {wrong}, p2 c, {number} 1e999")',
    )

    def made(name):
        return next(each for each in guesses(handed_in(lab)) if each.id == name)

    line = asked.options["abcd".index(wrong)].confusion
    assert made(P1) == Guess(P1, wrong, False, line, None, (right,))
    assert (made(P2).choice, made(P2).later) == ("c", ("b",))
    assert made(TYPED).choice == "1e999" and made(TYPED).confusion == "no choice that can be read"
    assert float(made(TYPED).later[0]) == float(value)
    times = [at(1), at(2), at(3)]
    keep(lab, zip([P1] * 3, [right, wrong, right], times, strict=True))
    keep(lab, [(TYPED, value, at(1)), (TYPED, "99", at(2))])
    first = made(P1)
    assert (first.choice, first.right, first.later) == (right, True, (wrong, right))
    assert datetime.fromisoformat(first.when) == datetime.fromisoformat(at(1))
    assert (made(TYPED).right, made(TYPED).later) == (True, ("99", "1e999"))
    assert made(f"{LAB}.p4") == Guess(f"{LAB}.p4") and TYPED != f"{LAB}.p4"


def test_invalid_line_of_guesses_in_a_notebook_is_reported(tmp_path):
    lab = notebook(tmp_path / "l.ipynb", f'predict("{P1}", "c")', 'report(who, guesses="all b")')
    remarks = []
    assert guesses(handed_in(lab), remarks)[0].choice == "c"
    assert len(remarks) == 1 and "guesses: wanted" in remarks[0] and "all b" in remarks[0]


def test_report_on_a_copied_notebook_mentions_other_guesses_but_uses_none(tmp_path):
    lab = notebook(tmp_path / "lab.ipynb", ids=[P1, TYPED])
    number = TYPED.partition(".")[2]
    made = [(P1, "b", at(1)), (P1, "c", at(2)), (TYPED, "-290", at(3)), (f"{LAB}.p99", "a", at(4))]
    keep(lab, made)
    keep(notebook(tmp_path / "other.ipynb", ids=[OTHER]), [(OTHER, "d", at(1))])

    def of(path):
        remarks = []
        return {g.id: g.choice for g in guesses(handed_in(path), remarks) if g.choice}, remarks

    copied = shutil.copy(lab, tmp_path / "copy.ipynb")
    got, [remark] = of(copied)
    line = re.search(r'report\(who, guesses="(.*)"\)$', remark)[1]
    assert got == {} and parse_line(line) == {"p1": "b", number: "-290"}
    assert "for copy.ipynb, but some are for lab.ipynb," in remark
    handed = notebook(copied, remark.partition(": ")[2], ids=[P1, TYPED])
    assert of(handed) == ({P1: "b", TYPED: "-290"}, []), "the suggested line does not work"
    assert of(lab) == (of(handed)[0], [])
    (tmp_path / "away").mkdir()
    assert of(shutil.copy(lab, tmp_path / "away" / "lab.ipynb")) == ({}, [])
    keep(notebook(tmp_path / "second.ipynb", ids=[P1]), [(P1, "a", at(1))])
    third = notebook(tmp_path / "third.ipynb", ids=[P1])
    assert of(third) == ({}, []), "one of two other notebooks was chosen"
    written(tmp_path, "{")
    got, [remark] = of(third)
    assert got == {} and "cannot be used" in remark


# --- Guessing in a page ---------------------------------------------------------------------------


def answer(question, choice, again=False):
    """Make a guess in the page."""
    if again:
        question.get_by_role("button", name="Ask me again").click()
    if choice in "abcdef":
        question.locator(f"input[value={choice}]").check()
    else:
        question.locator("fieldset input").fill(choice)
    question.get_by_role("button", name="This is my guess").click()


def kept_as(name, letters):
    """These guesses in the form in which they are saved, with the names of the options."""
    options = predict(name).options
    return [f"{letter}: {options['abcd'.index(letter)].name}" for letter in letters]


def told(question):
    return question.locator(".rk-asking > p")


# Starts a hub for each context. `sent` contains its messages, and the test answers with `hear`.
HUBS = """contexts => {
  window.sent = contexts.map(() => []);
  window.hear = [];
  contexts.forEach((context, k) => $guesses.initialize({model: {
    widget_manager: context && {context},
    send: message => sent[k].push(message),
    on: (name, call) => { if (name === "msg:custom") hear[k] = call; },
  }}));
}"""


def shown(page, *titles):
    """Show a page like JupyterLab's, with a panel for each tab title, or for None a panel without a
    tab; return the questions.
    """
    panels = "".join(
        (f'<li class="lm-TabBar-tab" data-id="n{k}" title="{title}"></li>' if title else "")
        + f'<div class="jp-NotebookPanel" id="n{k}">{predict(P1).html}</div>'
        for k, title in enumerate(titles)
    )
    page.set_content(panels)
    page.evaluate(f"() => {{ {script('guesses')}; window.$guesses = $guesses; }}")
    asks = page.locator(".rk-ask")
    until(lambda: asks.count() == len(titles), "a question is missing", page)
    return asks.all()


def made_in(page):
    return page.evaluate("sent.map(all => all.map(each => each.guesses.map(made => made[1])))")


def test_each_guess_goes_to_the_kernel_of_its_notebook(page):
    one, two, other = shown(
        page,
        "Name: a: b.ipynb&#10;Path: labs/a: b.ipynb&#10;Last Saved: 11/23/26",
        "名称：b.ipynb&#10;路径：labs/b.ipynb&#10;最后保存：11/23/26",
        "Nom : c.ipynb&#10;Chemin d'accès : c.ipynb&#10;",
    )
    paths = ("labs/b.ipynb", "labs/a: b.ipynb")
    contexts = [{"path": f"RTC:{path}", "localPath": path} for path in paths]
    page.evaluate(
        HUBS, [*contexts, {"path": "c.ipynb", "localPath": "c.ipynb", "isDisposed": True}]
    )
    answer(one, "a")
    answer(two, "b")
    answer(other, "c")
    assert made_in(page) == [[kept_as(P1, "b")], [kept_as(P1, "a")], []]
    expect(told(two)).to_have_text("Python will save it for your report as soon as it answers.")
    page.evaluate("() => { hear[0]({n: 1}); hear[1]({n: 1, error: 'the disk is full'}); }")
    expect(told(two)).to_have_text(KEPT)
    expect(told(one)).to_have_text("Saved on this page only: the disk is full.")
    expect(told(other)).to_have_text(RUN.replace("in this browser", "on this page"))
    copies = [each.get_by_role("button", name="Copy my").count() for each in (one, two, other)]
    assert copies == [1, 0, 1], "only guesses that are not saved need the button"
    answer(two, "d", again=True)
    assert made_in(page)[0] == [kept_as(P1, "b"), kept_as(P1, "bd")]
    assert page.evaluate("sent[0][1].path") == "labs/b.ipynb"


def test_the_question_names_the_first_guess_even_if_another_browser_made_it(page):
    (one,) = shown(page, "Path: a.ipynb")
    page.evaluate(HUBS, [{"path": "a.ipynb", "localPath": "a.ipynb"}])
    [first] = kept_as(P1, "b")
    for n, choice in enumerate("cdb", 1):
        answer(one, choice, again=n > 1)
        page.evaluate("([n, first]) => hear[0]({n, first})", [n, {P1: first}])
        more = "" if choice == "b" else " Your first guess, b, counts."
        expect(told(one)).to_have_text(f"{KEPT}{more}")


def test_guess_from_a_page_without_a_path_goes_to_the_only_kernel(page):
    # Notebook 7 has no tabs, and the widget model in VS Code has no context
    (one,) = shown(page, None)
    page.evaluate(HUBS, [{"path": "a.ipynb", "localPath": "a.ipynb"}])
    answer(one, "b")
    assert made_in(page) == [[kept_as(P1, "b")]]
    (one,) = shown(page, "Path: a.ipynb")
    page.evaluate("() => { delete window.robokinGuesses; robokinHubs.clear(); }")
    page.evaluate(HUBS, [None])
    answer(one, "c")
    assert made_in(page) == [[kept_as(P1, "c")]]
    page.evaluate(HUBS, [None])  # a second kernel
    answer(one, "d", again=True)
    assert made_in(page) == [[]] and "Run All Cells" in told(one).inner_text()


def test_kernel_that_starts_late_receives_earlier_guesses(page):
    (one,) = shown(page, "Path: a.ipynb")
    answer(one, "b")
    answer(one, "c", again=True)
    assert "Run All Cells" in told(one).inner_text()
    page.evaluate(HUBS, [{"path": "a.ipynb", "localPath": "a.ipynb"}])
    [[message]] = page.evaluate("sent")
    assert [name for name, _, _ in message["guesses"]] == [P1, P1]
    assert [choice for _, choice, _ in message["guesses"]] == kept_as(P1, "bc")
    times = [datetime.fromisoformat(time) for _, _, time in message["guesses"]]
    assert times == sorted(times) and all(time.tzinfo for time in times)


def exported(folder, *ids):
    """Write two pages with questions, as an export does, and return their paths."""
    for name in ("ada.html", "bob.html"):
        html = "".join(predict(each).html for each in ids)
        (folder / name).write_text(f"<!DOCTYPE html><meta charset=utf-8><body>{html}")
    return folder / "ada.html", folder / "bob.html"


def test_copy_button_copies_all_guesses_of_one_page(page, tmp_path):
    ada, bob = exported(tmp_path, P1, P2, TYPED, OTHER)
    page.add_init_script(
        'Object.defineProperty(navigator, "clipboard", '
        "{value: {writeText: async text => { window.copied = text; }}});"
    )
    page.goto(ada.as_uri())
    awake(page)
    one, two, typed, other = page.locator(".rk-ask").all()
    for question, choice in ((typed, "-290"), (one, "b"), (other, "d"), (two, "c")):
        answer(question, choice)
    answer(one, "a", again=True)
    button = page.get_by_role("button", name="Copy my guesses for the report")
    assert button.count() == 1 and one.get_by_role("button").last.inner_text().startswith("Copy my")
    button.click()
    line = f"{TYPED.partition('.')[2]} -290, p1 b, {OTHER} d, p2 c"
    assert page.evaluate("copied") == f'report(who, guesses="{line}")'
    assert parse_line(line)
    page.goto(bob.as_uri())
    awake(page)
    assert page.locator(".rk-answer p").count() == 0, "the page shows another page's guesses"
    page.goto(ada.as_uri())
    awake(page)
    assert page.get_by_text("You guessed here before.").count() == 4 and button.count() == 1
    one.get_by_role("button", name="Clear").click()
    two.get_by_role("button", name="Ask me again").click()
    page.goto(ada.as_uri())
    awake(page)
    assert page.get_by_text("You guessed here before.").count() == 3
    assert "You guessed here before." in told(two).inner_text()


def test_line_of_guesses_can_be_selected_if_there_is_no_clipboard(page, tmp_path):
    path, _ = exported(tmp_path, P1)
    page.add_init_script(
        'Object.defineProperty(navigator, "clipboard", {value: undefined});'
        "document.execCommand = () => false;"
    )
    page.goto(path.as_uri())
    awake(page)
    answer(page.locator(".rk-ask"), "b")
    for _ in range(2):
        page.get_by_role("button", name="Copy my guesses").click()
    [area] = page.locator("textarea").all()
    line = 'report(who, guesses="p1 b")'
    assert area.input_value() == line and page.evaluate("`${getSelection()}`") == line


# --- Guessing in JupyterLab -----------------------------------------------------------------------

PANEL = ".jp-NotebookPanel:not(.lm-mod-hidden)"


def says(question, text):
    expect(told(question)).to_have_text(text)


def current(page, name):
    """Wait until the notebook with this name is the active tab."""
    tab = ".lm-TabBar-tab.lm-mod-current[data-type=document-title]"
    page.locator(f"{tab}[title*='Path: guessing/{name}']").wait_for()
    page.locator(f"{PANEL} .jp-MarkdownCell h1").wait_for()


def run_all(jupyter, page, count):
    def ready():
        opened = page.locator(".jp-NotebookPanel").count()
        return len(jupyter.api("sessions") or ()) == opened and jupyter._kernels_idle()

    until(ready, "the kernels did not become idle", page)
    page.locator(".jp-StatusBar-Widget").get_by_text("| Idle").first.wait_for()
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
    asks = page.locator(f"{PANEL} .rk-ask")

    def asked():
        awake(page)  # an earlier guess opens a view, which moves the next question out of sight
        return asks.count() == count

    until(asked, f"{count} questions did not start", page)


def test_guesses_made_in_jupyterlab_are_saved(jupyter, page):
    """The session has two copies of a lab, one of which is renamed, and another lab. A kernel is
    restarted, Run All is used after guessing, and a notebook is saved, closed and opened again.
    """
    folder = jupyter.labs / "guessing"
    lab = notebook(folder / "lab.ipynb", ids=[P1, P2, TYPED])
    twin = notebook(folder / "twin.ipynb", ids=[P1, P2, TYPED])
    other = notebook(folder / "other.ipynb", "import os; os.chdir('/')", ids=[OTHER])
    asks = page.locator(f"{PANEL} .rk-ask")

    def to(name):
        page.locator(".lm-TabBar-tab[data-type=document-title]", has_text=name).click()
        current(page, name)

    jupyter.open(page, "guessing/lab.ipynb")
    run_all(jupyter, page, 3)
    answer(asks.nth(0), "b")
    says(asks.nth(0), KEPT)
    for path, count, choice in ((twin, 3, "c"), (other, 1, "d")):
        page.locator(".jp-DirListing-item", has_text=path.name).dblclick()
        current(page, path.name)
        run_all(jupyter, page, count)
        answer(asks.nth(0), choice)
        says(asks.nth(0), KEPT)
    to("lab.ipynb")
    answer(asks.nth(0), "a", again=True)
    answer(asks.nth(2), "-290")
    says(asks.nth(2), KEPT)
    assert chosen(lab) == {P1: kept_as(P1, "ba"), TYPED: ["-290"]}
    assert chosen(twin) == {P1: kept_as(P1, "c")} and chosen(other) == {OTHER: kept_as(OTHER, "d")}

    to("twin.ipynb")
    page.locator(".jp-DirListing-item", has_text="twin.ipynb").click()
    page.keyboard.press("F2")
    page.keyboard.press("Control+a")
    page.keyboard.type("my twin.ipynb")
    page.keyboard.press("Enter")
    until((folder / "my twin.ipynb").is_file, "the notebook is not renamed", page)
    current(page, "my twin.ipynb")
    answer(asks.nth(1), "b")
    says(asks.nth(1), KEPT)
    assert chosen(folder / "my twin.ipynb") == {P1: kept_as(P1, "c"), P2: kept_as(P2, "b")}

    to("lab.ipynb")
    page.get_by_role("menuitem", name="Kernel", exact=True).click()
    page.get_by_role("menuitem", name="Restart Kernel").first.click()
    page.locator(".jp-Dialog .jp-mod-accept").click()
    until(
        lambda: page.evaluate("robokinHubs.size") == 2,
        "the hub of the old kernel was not removed",
        page,
    )
    answer(asks.nth(1), "c")
    says(asks.nth(1), RUN)
    assert P2 not in chosen(lab)
    run_all(jupyter, page, 3)
    for question, more in zip(asks.all(), (" Your first guess, b, counts.", "", ""), strict=True):
        says(question, f"You guessed here before. {KEPT}{more}")
    page.keyboard.press("Control+s")
    saved = page.locator(".lm-TabBar-tab.lm-mod-current[data-type='document-title']")
    until(lambda: "jp-mod-dirty" not in saved.get_attribute("class"), "not saved", page)

    jupyter.open(page, "guessing/lab.ipynb")
    says(asks.nth(0), f"You guessed here before. {RUN}")
    kept = read_guesses(lab)
    assert chosen(lab) == {P1: kept_as(P1, "ba"), P2: kept_as(P2, "c"), TYPED: ["-290"]}
    times = [datetime.fromisoformat(t) for made in kept.values() for _, t in made]
    first = [datetime.fromisoformat(kept[name][0][1]) for name in (P1, TYPED, P2)]
    assert all(time.tzinfo for time in times) and first == sorted(first)
    cells = nbformat.read(lab, as_version=4).cells
    outputs = [o.data["text/html"] for cell in cells for o in cell.get("outputs", ())]
    assert outputs == [predict(name).html for name in (P1, P2, TYPED)], "an output contains a guess"
    assert "widget" not in lab.read_text()
    # JupyterLab itself reports an error about the debugger state
    errors = [each for each in page.errors if "debugger state" not in each]
    assert errors == [] and page.outside == []
