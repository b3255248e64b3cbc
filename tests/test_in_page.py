"""Cells that run in the pages of the site: in Chromium, with Python from the site's own files,
from a plain server under a sub-path. `tests/test_site.py` tests the rest of the site.
"""

import gzip
import io
import json
import re
import tomllib
import zipfile

import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import NOTEBOOKS, ROOT, awake, until
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet
from test_browser import NEXT_FRAME, PLAYER, _seen

from robokin.course import book
from robokin.course.site import files

FRAMES = "01_frames_and_quaternions"
POINT, TABLE, CHECK = "first-point", "your-turn-code", "your-turn-check-1"
SOLUTION = book.find("frames_and_quaternions.1", "exercises").solution


# --- Files ----------------------------------------------------------------------------------------


def test_sizes_stay_within_what_a_phone_can_fetch(site):
    sizes = {path.name: path.stat().st_size for path in (site / "python").glob("*.gz")}
    sympy = sizes.pop("sympy.zip.gz")
    assert 5e6 < sum(sizes.values()) <= 9.5e6
    assert 1e6 < sympy <= 5e6


def test_page_has_the_files_of_the_package_and_no_others(site):
    names = {
        name: zipfile.ZipFile(io.BytesIO(gzip.decompress(packed.read_bytes()))).namelist()
        for name in ("numpy", "robokin", "sympy")
        for packed in [site / "python" / f"{name}.zip.gz"]
    }
    assert {"numpy/__init__.py", "numpy/linalg/__init__.py"} <= set(names["numpy"])
    assert {"sympy/__init__.py", "mpmath/__init__.py"} <= set(names["sympy"])
    own = {p.relative_to(ROOT).as_posix() for p in (ROOT / "robokin").rglob("*.py")}
    exercises = {
        p.relative_to(ROOT).as_posix()
        for p in (NOTEBOOKS / "exercises").rglob("*")
        if p.suffix in (".md", ".py")
    }
    site_only = {name for name in own if name.startswith("robokin/course/site/")}
    assert (own - site_only) | exercises <= set(names["robokin"])
    names["numpy"].remove("numpy/f2py/__init__.py")  # empty, for `from numpy import *`
    for name in (name for each in names.values() for name in each):
        assert not re.search(r"/tests/|/f2py/|/distutils/|\.pyi$|__pycache__|course/site/", name)


def test_a_file_other_than_the_pinned_one_is_refused(tmp_path, monkeypatch):
    monkeypatch.setenv("ROBOKIN_CACHE", str(tmp_path / "cache"))
    name = files.EDITOR
    forging = "import pathlib, sys; pathlib.Path(sys.argv[1], {!r}).write_bytes(b'another file')"
    monkeypatch.setattr(files, "_client", lambda pin: ["python3", "-c", forging.format(name)])
    with pytest.raises(ValueError, match=f"{name}: wanted the checksum"):
        files.package(name)
    assert not list(tmp_path.rglob("*.tgz")), "nothing wrong may stay in the cache"
    failing = "import sys; print('no such host', file=sys.stderr); sys.exit(1)"
    monkeypatch.setattr(files, "_client", lambda pin: ["python3", "-c", failing])
    with pytest.raises(ValueError, match=f"{name}.*could not be fetched: no such host"):
        files.package(name)


def test_requirements_allow_the_versions_of_the_page():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    numpy = next(r for r in map(Requirement, project["dependencies"]) if r.name == "numpy")
    page = re.search(r"numpy-(\d+\.\d+\.\d+)-py3(\d+)h", files.NUMPY)
    assert page[1] in numpy.specifier
    assert f"3.{page[2]}" in SpecifierSet(project["requires-python"])


# --- In Chromium ----------------------------------------------------------------------------------


class Lab:
    """A lab's page. Its methods act as a reader does."""

    def __init__(self, context, address, name=FRAMES):
        self.page, self.errors, self.outside = context.new_page(), [], []
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("console", lambda m: m.type == "error" and self.errors.append(m.text))
        own = (address, "blob:", "data:")
        self.page.on("request", lambda r: r.url.startswith(own) or self.outside.append(r.url))
        self.open(f"{address}{name}.html")

    def open(self, address):
        self.page.goto(address)
        self.page.locator(".rk-bar").first.wait_for()
        awake(self.page)  # a view that starts between press and release moves the button

    def cell(self, name):
        """The place of the cell with this id in the notebook."""
        cells = json.loads(self.page.locator("#rk-lab").text_content())["cells"]
        return self.page.locator("#" + next(c["place"] for c in cells if c["id"] == name))

    def button(self, name, label):
        return self.cell(name).locator(".rk-bar, .rk-status").get_by_role("button", name=label)

    def edit(self, name, text):
        box = self.cell(name).locator("textarea")
        if not box.count():
            self.button(name, "Edit").click()
        box.fill(text)

    def text(self, name):
        return self.cell(name).locator("textarea").input_value()

    def run(self, name, text=None):
        """Run a cell, with another text if there is one; return what it then shows."""
        if text is not None:
            self.edit(name, text)
        self.cell(name).evaluate("""place => {
            place.begun = false;
            new MutationObserver(() => { place.begun = true; })
                .observe(place, {attributeFilter: ["data-running"]}); }""")
        self.button(name, "Run").click()
        begun = self.cell(name)  # on a busy machine, the click comes later
        until(lambda: begun.evaluate("place => place.begun"), "it does not begin", self.page)
        self.done()
        return self.shows(name)

    def done(self):
        self.page.evaluate(NEXT_FRAME)
        running = self.page.locator("[data-running]")
        until(lambda: not running.count(), "it still runs", self.page)

    def shows(self, name):
        """The words of the visible outputs."""
        outputs = self.cell(name).locator(".cell_output:visible").all()
        return "\n".join(one.inner_text() for one in outputs).strip()

    def says(self, name):
        return self.cell(name).locator(".rk-status").inner_text()

    def source(self, name):
        cells = json.loads(self.page.locator("#rk-lab").text_content())["cells"]
        return next(c["source"] for c in cells if c["id"] == name)


@pytest.fixture(scope="module")
def context(browser, site_address):
    context = browser.new_context(viewport={"width": 1366, "height": 900})
    yield context
    context.close()


@pytest.fixture(scope="module")
def shared(context, site_address):
    """A page whose Python keeps running from test to test."""
    return Lab(context, site_address)


@pytest.fixture
def lab(shared):
    """The shared page, with the lab's own cells."""
    yield shared
    assert shared.outside == [] and shared.errors == []
    mine = shared.page.get_by_role("button", name=re.compile("^(Reset|Lab's result)"))
    while mine.count():
        mine.first.click()


def test_a_cell_runs_with_what_it_needs(lab):
    stored = lab.shows(POINT)
    said = record(lab, POINT)
    assert lab.run(POINT) == stored, "the page's Python prints what the stored run printed"
    said = said()
    assert any(re.match(r"Fetching Python, once: \d\.\d of \d\.\d MB", line) for line in said)
    assert "Running 1 cell above …" in said
    assert lab.says(POINT) == "This is your result. Ran before it: cell 4."
    lab.run(POINT)
    assert lab.says(POINT) == "This is your result.", "Python still has the names"
    assert lab.cell(POINT).locator(".rk-mine").count() == 1
    lab.button(POINT, "Lab's result").click()
    lab.page.evaluate(NEXT_FRAME)
    assert lab.cell(POINT).locator(".rk-mine, .rk-edited").count() == 0
    assert lab.says(POINT) == "" and lab.shows(POINT) == stored


def record(lab, name):
    """Record what a cell says; the result returns the sentences."""
    lab.cell(name).evaluate("""cell => {
        const says = cell.querySelector(".rk-status");
        cell.told = [];
        new MutationObserver(() => cell.told.push(says.textContent))
            .observe(says, {childList: true}); }""")
    return lambda: lab.cell(name).evaluate("cell => cell.told")


def test_a_changed_number_changes_the_result_and_reset_gives_the_cell_back(lab):
    stored, source = lab.shows(POINT), lab.source(POINT)
    lab.edit(POINT, source.replace("30 * deg", "90 * deg"))
    assert "You changed this cell" in lab.says(POINT) and lab.shows(POINT) == stored
    lab.cell(POINT).locator("textarea").press("Shift+Enter")
    lab.done()
    assert "goes to [0.  0.1 0.2]" in lab.shows(POINT) and "[0.  0.1 0.2]" not in stored
    lab.button(POINT, "Reset").click()
    assert (lab.text(POINT), lab.shows(POINT)) == (source, stored)
    lab.button(POINT, "Undo").click()
    assert "90 * deg" in lab.text(POINT)


def test_an_error_names_the_line_of_the_cell(lab):
    shows = lab.run(POINT, "a = 1\n\nprint(a)\na / 0")
    assert lab.says(POINT) == "Python stopped with an error in line 4."
    marked = lab.cell(POINT).locator(".rk-editor .rk-failed")
    assert marked.all_inner_texts() == ["a / 0\n"]
    assert shows.startswith("1\n") and "cell, line 4" in shows
    assert "ZeroDivisionError: division by zero" in shows and "pyodide" not in shows.lower()
    shows = lab.run(POINT, "a = (1,\nb = 2")
    assert "cell, line 1" in shows and "SyntaxError" in shows
    assert marked.all_inner_texts() == ["a = (1,\n"]
    lab.edit(POINT, "a = 1")
    assert marked.count() == 0
    assert "Did you mean: 'print'?" in lab.run(POINT, "pritn(1)")


def test_an_error_in_a_cell_above_is_named(lab):
    lab.run("elementary", "def trans(x, y, z):\n    return 1 / 0")
    lab.run(POINT)
    assert "ZeroDivisionError" in lab.shows(POINT)
    assert "another cell, line 2" in lab.shows(POINT)


@pytest.mark.parametrize(
    "source, words",
    [
        ("input()", "A page cannot ask for input"),
        ("!pip install scipy", "!pip install scipy is a command for Jupyter"),
        ("import matplotlib", "a page has no Matplotlib"),
        ("import numpy as np\nnp.ones(10**10)", "MemoryError: There is not enough memory"),
        ("print('x' * 10_000_000)", "more than 1 MB. The rest is left out"),
    ],
)
def test_what_a_page_cannot_do_has_a_sentence(lab, source, words):
    assert words in lab.run(POINT, source)


def test_python_can_be_stopped_and_starts_again(lab):
    lab.run(POINT)
    lab.edit("elementary", lab.source("elementary") + "\nwhile True:\n    pass")
    lab.button("elementary", "Run").click()
    lab.button(POINT, "Run").click()
    assert "still running cell 4" in lab.says(POINT)
    lab.button("elementary", "Stop").click()
    lab.done()
    assert "Stopped: Python was ended" in lab.says("elementary")
    assert "the lab's, not yours" in lab.says("elementary") or not lab.shows("elementary")
    lab.run(POINT)
    assert "needs cell 4, which was stopped" in lab.says(POINT)
    assert "[data-running]" not in lab.page.content()
    lab.run("elementary", lab.source("elementary"))
    assert lab.run(POINT) and lab.says(POINT) == "This is your result."


def test_a_cell_that_is_stopped_before_it_began_does_not_run_by_itself(lab):
    lab.edit("elementary", lab.source("elementary") + "\nwhile True:\n    pass")
    lab.cell("elementary").evaluate("""cell => {
        const [run, stop] = cell.querySelectorAll(".rk-bar button");
        run.click();
        stop.click(); }""")
    lab.done()
    lab.run(POINT)
    assert "needs cell 4, which was stopped" in lab.says(POINT)


def test_too_much_memory_ends_python_with_a_sentence(lab):
    lab.run(POINT, "import numpy as np\nkept = np.ones(100_000_000)")
    assert "more than 500 MB of memory" in lab.says(POINT)
    assert lab.run(POINT, "print(6 * 7)") == "42"


def test_a_check_judges_the_readers_answer(lab):
    assert "not answered yet" in lab.run(CHECK)
    lab.run(TABLE, f"from robokin.course import check\n\n{SOLUTION}")
    assert "frames_and_quaternions.1: holds." in lab.run(CHECK)
    wrong = "import numpy as np\n\ndef seen_from_flange(table, q, base_part):\n    return np.eye(4)"
    lab.run(TABLE, wrong)
    assert "frames_and_quaternions.1: does not hold." in lab.run(CHECK)


def test_hints_and_then_the_solution_stand_beside_the_verdict(lab):
    verdict = lab.run(CHECK)
    exercise = book.find("frames_and_quaternions.1", "exercises")
    helps = lab.cell(CHECK).locator(".rk-helps > *")
    for n, text in enumerate(exercise.hints, 1):
        lab.button(CHECK, "Hint").click()
        assert helps.count() == n and text in helps.nth(n - 1).inner_text()
    assert lab.button(CHECK, "Hint").count() == 0
    lab.button(CHECK, "Solution").click()
    assert SOLUTION.strip() in helps.last.inner_text()
    assert lab.button(CHECK, "Solution").count() == 0 and lab.shows(CHECK) == verdict
    assert lab.button(TABLE, "Hint").count() == 0


def test_an_answer_that_never_ends_gets_the_engines_sentence(lab):
    lab.run(TABLE, "def seen_from_flange(table, q, base_part):\n    while True:\n        pass")
    shows = lab.run(CHECK)
    assert "frames_and_quaternions.1: does not hold." in shows and "It never ends" in shows
    assert "Python was ended" in lab.says(CHECK)


def test_a_view_appears_and_moves(lab):
    before = lab.cell("opening").locator(f"{PLAYER} canvas").count()
    lab.run("opening", lab.source("opening") + "  # my own")
    own = lab.cell("opening").locator(f".rk-mine {PLAYER}")
    own.locator("canvas").first.wait_for()
    assert before and own.count() == 1
    seen, slider = _seen(own), own.locator("input[type=range]").first
    slider.focus()
    slider.press("ArrowRight")
    lab.page.evaluate(NEXT_FRAME)
    assert _seen(own) != seen


def test_a_run_that_gives_the_same_view_leaves_it_as_the_reader_left_it(context, site_address):
    lab = Lab(context, site_address, "03_irb140_motion")
    view = lab.cell("close-up").locator(f".cell_output:visible {PLAYER}")
    blend = view.get_by_role("slider", name="blend").last
    blend.press("ArrowRight")
    lab.page.evaluate(NEXT_FRAME)
    seen, value = _seen(view), blend.input_value()
    for _ in range(2):
        lab.run("close-up")
        assert (_seen(view), blend.input_value()) == (seen, value)
        assert "it stays as you left it" in lab.says("close-up")
    lab.button("close-up", "Start again").click()
    view.locator("canvas").first.wait_for()
    assert blend.input_value() != value, "the lab's view again"
    assert view.count() == 1
    blend.press("ArrowRight")
    blend.press("ArrowRight")
    value = blend.input_value()
    lab.run("close-up")
    assert blend.input_value() == value, "the reader's own view stays, too"
    source = lab.source("close-up")
    lab.run("close-up", source.replace("duration=20", "duration=10"))
    assert lab.says("close-up") == "This is your result."
    view.locator("canvas").first.wait_for()
    assert view.get_by_role("slider", name="duration").last.input_value() == "10"
    lab.button("close-up", "Reset").click()
    assert lab.errors == [] and lab.outside == []
    lab.page.close()


def test_a_picture_that_cannot_be_drawn_again_is_not_called_the_readers(lab):
    lab.run(POINT, "from robokin.show import figure\nfigure('one')")
    assert lab.says(POINT) == "Done, but this page cannot draw the picture again."
    lab.run(POINT, "a = 1")
    assert lab.says(POINT) == "Done. This cell shows nothing."


def test_questions_are_not_run(lab):
    asks = [c for c in lab.page.locator("div.cell").all() if c.locator(".rk-ask").count()]
    assert asks
    for each in asks:
        assert each.locator(".rk-bar, summary:not(.robokin-player *)").count() == 0
        assert re.search(r"^guess p\d+$", each.inner_text(), re.M), "its name in the report"


def test_changes_survive_and_go_into_the_download(lab, site):
    text = "swing = 45 * deg  # mine\nprint(swing)"
    lab.edit(POINT, text)
    ask = lab.page.locator(".rk-ask").first
    ask.scroll_into_view_if_needed()
    ask.locator("input").fill("90")
    ask.get_by_role("button", name="This is my guess").click()
    assert "Saved for your report." in ask.inner_text()
    assert ask.get_by_role("button", name="Copy my guesses").count() == 0
    awake(lab.page)
    with lab.page.expect_download() as download:
        lab.page.get_by_role("button", name="Download my notebook").first.click()
    assert download.value.suggested_filename == f"{FRAMES}.ipynb"
    mine = json.loads(download.value.path().read_text(encoding="utf-8"))
    stored = json.loads((site / f"{FRAMES}.ipynb").read_text(encoding="utf-8"))
    pairs = zip(mine["cells"], stored["cells"], strict=True)
    changed = [
        own
        for own, lab_cell in pairs
        if own != lab_cell and "on the site:" not in str(lab_cell["source"])
    ]
    judging = [
        cell for cell in changed if re.search(r"(?m)^(check|progress)\(", "".join(cell["source"]))
    ]
    assert len(judging) > 2, "no stored verdict on another answer"
    sources = {cell["id"]: "".join(cell["source"]) for cell in changed if cell not in judging}
    assert sources.pop(POINT) == text
    assert len(sources) == 1 and all('.p5", 90)' in source for source in sources.values())
    assert all(cell["outputs"] == [] for cell in changed)
    assert "on the site:" in str(stored) and "on the site:" not in str(mine)
    lab.page.reload()
    lab.cell(POINT).locator("textarea").wait_for()
    assert lab.text(POINT) == text


def test_the_report_is_made_from_the_downloaded_notebook(lab, site):
    awake(lab.page)  # a view that starts between press and release moves the button
    report = lab.page.locator("div.cell", has_text="report(who)").last
    assert report.get_by_role("button", name="Run").count() == 0
    assert report.locator(".cell_output").count() == 0, "it would say what to do in JupyterLab"
    progress = lab.page.locator("div.cell", has_text="progress(").last
    for place in (lab.page.locator(".rk-intro"), progress, report):
        assert place.get_by_role("link", name="How to hand it in").get_attribute("href")
        with lab.page.expect_download() as download:
            place.get_by_role("button", name="Download my notebook").click()
        assert download.value.suggested_filename == f"{FRAMES}.ipynb"
        words = place.inner_text() + lab.page.locator(".rk-intro + .rk-status").inner_text()
        assert f"Downloaded {FRAMES}.ipynb" in words
    lab.run(POINT, "1 / 0")
    report.get_by_role("button", name="Download my notebook").click()
    words = report.locator(".rk-status")
    until(lambda: "Failed or stopped here: cell 5" in words.inner_text(), "no word", lab.page)
    plain = lab.page.locator("p.download a").first
    assert plain.inner_text() == "Download the lab without my changes"


def test_a_newer_lab_asks_before_it_uses_an_old_change(lab):
    path = "location.pathname"
    old = json.dumps({"stored": "an older text", "text": "print('old change')"})
    lab.page.evaluate(
        f"text => localStorage.setItem(`robokin edit ${{{path}}} {POINT}`, text)", old
    )
    lab.page.reload()
    lab.page.locator(".rk-bar").first.wait_for()
    assert "newer text of this cell" in lab.says(POINT)
    assert lab.cell(POINT).locator("textarea").count() == 0
    lab.button(POINT, "Use my text").click()
    lab.cell(POINT).locator("textarea").wait_for()
    assert lab.text(POINT) == "print('old change')"


def test_two_tabs_show_the_same_text(lab, context, site_address):
    other = Lab(context, site_address)
    other.edit(POINT, "print('from the other tab')")
    until(lambda: "in another tab" in lab.says(POINT), "no sentence", lab.page)
    assert lab.text(POINT) == "print('from the other tab')"
    other.page.close()


FORBIDDEN = """() => Object.defineProperty(window, "localStorage", {
    get() { throw new DOMException("denied", "SecurityError"); }})"""
FULL = """() => { Storage.prototype.setItem = () => {
    throw new DOMException("full", "QuotaExceededError"); }; }"""


@pytest.mark.parametrize("script, why", [(FORBIDDEN, "does not let"), (FULL, "has no more room")])
def test_a_browser_that_stores_nothing_says_so(browser, site_address, script, why):
    context = browser.new_context()
    context.add_init_script(f"({script})()")
    lab = Lab(context, site_address)
    lab.edit(POINT, "print(1)")
    note = lab.page.locator(".rk-intro ~ .rk-status").first
    assert why in note.inner_text() and "Download my notebook" in note.inner_text()
    assert set(lab.errors) <= {"denied"}, "only furo's own script may ask the storage in vain"
    context.close()


def test_an_address_never_fills_a_cell(context, site_address):
    lab = Lab(context, site_address)
    plain = lab.cell(POINT).inner_text()
    evil = "?cell=print(666)&code=print(666)&first-point=print(666)#code-12=print(666)"
    lab.open(f"{site_address}{FRAMES}.html{evil}")
    assert lab.cell(POINT).inner_text() == plain
    assert "666" not in lab.page.locator("article").inner_text()
    lab.page.close()


def test_files_that_are_missing_have_a_sentence(browser, site_address):
    context = browser.new_context()
    lab = Lab(context, site_address)
    lab.page.route("**/python/numpy*", lambda route: route.fulfill(status=404))
    lab.run(POINT)
    assert "Python could not be fetched (404" in lab.says(POINT)
    lab.page.unroute("**/python/numpy*")
    lab.run(POINT)
    assert lab.says(POINT).startswith("This is your result.")
    context.close()


def test_without_the_editors_files_there_is_a_plain_box(browser, site_address):
    context = browser.new_context()
    lab = Lab(context, site_address)
    lab.page.route("**/python/editor/**", lambda route: route.fulfill(status=404))
    lab.button(POINT, "Edit").click()
    box = lab.cell(POINT).locator("textarea.rk-plain")
    box.wait_for()
    assert box.input_value() == lab.source(POINT)
    context.close()


def test_page_from_a_folder_says_why_nothing_runs(browser, site):
    page = browser.new_page()
    errors = []
    page.on("console", lambda m: m.type == "error" and errors.append(m.text))
    page.goto((site / f"{FRAMES}.html").as_uri())
    page.get_by_text("This page was opened from a folder").wait_for()
    assert page.locator(".rk-bar").count() == 0 and errors == []
    page.close()


def test_page_without_scripts_says_why_nothing_runs(browser, site_address):
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(f"{site_address}{FRAMES}.html")
    assert page.get_by_text("run where the browser runs its scripts").is_visible()
    context.close()


def test_keyboard_alone_is_enough(browser, site_address):
    context = browser.new_context()
    lab = Lab(context, site_address)
    lab.button(POINT, "Edit").focus()
    lab.page.keyboard.press("Enter")
    box = lab.cell(POINT).locator("textarea")
    box.wait_for()
    until(lambda: box.evaluate("e => e === document.activeElement"), "no focus", lab.page)
    lab.page.keyboard.press("Control+a")
    lab.page.keyboard.type("for k in range(2):\nprint(k)", delay=5)
    assert box.input_value() == "for k in range(2):\n    print(k)", "indents after a colon"
    lab.page.keyboard.press("Tab")
    assert box.evaluate("e => e === document.activeElement"), "Tab indents"
    lab.page.keyboard.press("Escape")
    lab.page.keyboard.press("Tab")
    focused = "() => document.activeElement.getAttribute('aria-label')"
    assert lab.page.evaluate(focused) == "Run cell 5"
    lab.page.keyboard.press("Enter")
    lab.page.evaluate(NEXT_FRAME)
    assert lab.page.evaluate(focused) == "Stop cell 5"
    lab.done()
    assert lab.shows(POINT) == "0\n1" and lab.page.evaluate(focused) == "Run cell 5"
    context.close()


def test_a_phone_can_edit_and_run(browser, site_address):
    context = browser.new_context(
        viewport={"width": 390, "height": 800}, has_touch=True, is_mobile=True
    )
    lab = Lab(context, site_address)
    awake(lab.page)  # a view that starts between touch and release moves the button
    lab.button(POINT, "Edit").tap()
    box = lab.cell(POINT).locator("textarea")
    box.wait_for()
    assert box.is_visible(), "editing opens a folded cell"
    box.fill("print(' '.join('abc' * 40))")
    lab.button(POINT, "Run").tap()
    lab.done()
    assert lab.shows(POINT).startswith("a b c")
    box.fill("a = 1\n" * 3 + f"b = '{'long ' * 40}'")
    lab.page.evaluate(NEXT_FRAME)
    assert lab.page.evaluate(
        "() => [...document.querySelectorAll('.rk-editor, .rk-editor *')].map(e => e.scrollLeft)"
        ".every(x => x === 0)"
    ), "the beginnings of the lines are visible"
    lines = "article summary:visible, .rk-bar button:visible, .rk-intro button"
    assert lab.page.locator("article summary:visible").count() > 5
    for button in lab.page.locator(lines).all():
        box = button.bounding_box()
        assert box["height"] >= 44 and box["width"] >= 44, button.inner_text()
    assert lab.page.evaluate("() => document.documentElement.scrollWidth") <= 390
    context.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_screen_reader_can_use_cells(browser, site_address, scheme):
    context = browser.new_context(color_scheme=scheme)
    lab = Lab(context, site_address)
    lab.edit(POINT, "# words\nprint(1, True, 'x')\n1 / 0")
    lab.button(POINT, "Run").click()
    lab.done()
    awake(lab.page)
    found = {
        rule["id"]: [node["html"][:160] for node in rule["nodes"]]
        for rule in Axe().run(lab.page).response["violations"]
        if rule["impact"] != "minor"
    }
    assert found == {}
    context.close()


@pytest.mark.parametrize(
    "name, cell", [("08_visit_and_collect", "opening"), ("10_obstacle_avoidance", "plan-explorer")]
)
def test_a_view_that_asks_python_wakes_and_sleeps(browser, site_address, name, cell):
    context = browser.new_context(viewport={"width": 1366, "height": 900})
    lab = Lab(context, site_address, name)
    lab.run(cell)
    view = lab.cell(cell).locator(f".cell_output:visible {PLAYER}")
    view.scroll_into_view_if_needed()
    until(lambda: view.get_attribute("data-awake") is not None, "it stays asleep", lab.page)
    slider = view.locator(".rk-side input[type=range]").first
    slider.focus()
    slider.press("ArrowUp")
    until(lambda: view.get_attribute("data-answered"), "no answer", lab.page)
    lab.edit(cell, "while True: pass")
    lab.button(cell, "Run").click()
    lab.button(cell, "Stop").click()
    lab.done()
    assert lab.page.locator("[data-awake]").count() == 0
    assert lab.errors == [] and lab.outside == []
    context.close()
