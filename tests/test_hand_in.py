"""`report(who)` in a lab finds its notebook, checks whether the file has the student's last
changes, and writes the report or says in one sentence why it cannot.
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from queue import Empty
from types import SimpleNamespace

import nbformat
import psutil
import pytest
from conftest import NOTEBOOKS, PATIENCE, ROOT, until
from jupyter_client.manager import KernelManager
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from robokin import course
from robokin.course import hand_in, report, solution
from robokin.course.hand_in import ASLEEP, UNSAVED, Ran
from robokin.course.note import Note
from robokin.course.reported import report_data

IMPORTS = "from robokin.course import check, predict, report"
CHECK = 'check("start_here.1", my_posture)'
REPORT = 'report("Ada")'


def stored(path, *sources, saved=None):
    """Write a notebook with these code cells; `saved` is the time stamp of the file."""
    cells = [new_markdown_cell("# A lab"), *map(new_code_cell, sources)]
    nbformat.write(new_notebook(cells=cells), path)
    if saved is not None:
        os.utime(path, (saved, saved))
    return path


@pytest.fixture
def desk(tmp_path, monkeypatch):
    """A kernel's folder with `lab.ipynb`, which is open in JupyterLab. `desk.run(source, when=...)`
    runs a cell; `desk.judged` lists the reports that would have been written, as (file, name).
    """
    here = SimpleNamespace(folder=tmp_path, lab=tmp_path / "lab.ipynb", judged=[])

    def run(*sources, when):
        hand_in._ran.extend(Ran(source, when) for source in sources)

    def written(path, who):
        here.judged.append((path.name, who))
        return Note("written")

    here.run = run
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(hand_in, "_ran", [])
    monkeypatch.setattr(hand_in, "_written", written)
    monkeypatch.delenv("ROBOKIN_JUDGE", raising=False)
    monkeypatch.setenv("JPY_SESSION_NAME", str(here.lab))
    return here


# --- Calls that do nothing ------------------------------------------------------------------------


@pytest.mark.parametrize("who", ["your name", " Your  NAME ", "", "  ", None, ...])
def test_report_without_a_name_prints_one_line(desk, who):
    stored(desk.lab, REPORT)
    assert repr(report(who)) == ASLEEP and desk.judged == []


@pytest.mark.parametrize("where", ["judged", "only executed"])
def test_report_outside_a_front_end_prints_one_line(desk, monkeypatch, where):
    stored(desk.lab, REPORT)
    if where == "judged":
        monkeypatch.setenv("ROBOKIN_JUDGE", "1")
        assert repr(report("Ada", notebook="lab.ipynb")) == ASLEEP
    else:  # run by nbval, nbclient or tests/rerun.py
        monkeypatch.delenv("JPY_SESSION_NAME")
    assert repr(report("Ada")) == ASLEEP and desk.judged == []
    assert "\n" not in ASLEEP


def test_report_in_a_page_says_where_to_write_it(desk, monkeypatch):
    stored(desk.lab, REPORT)
    monkeypatch.setattr(sys, "platform", "emscripten")
    for who in ("Ada", "your name"):
        told = repr(report(who, "p1 b", notebook="lab.ipynb"))
        assert "Download my notebook" in told and "JupyterLab" in told and "\n" not in told
    assert desk.judged == []


def test_any_student_name_is_accepted(desk):
    stored(desk.lab, REPORT)
    for who in (7, "Zoë -x", "李 小龙"):
        assert report(who) == "written" and desk.judged[-1] == ("lab.ipynb", str(who))


def test_modules_do_not_shadow_exported_names():
    """Importing a module named like a function would replace the function."""
    modules = {path.stem for path in Path(course.__file__).parent.iterdir()}
    assert not modules & set(course.__all__)


# --- Unsaved changes ------------------------------------------------------------------------------


def test_unsaved_answer_is_not_judged(desk):
    stored(desk.lab, IMPORTS, "my_posture = ...", CHECK, saved=100)
    desk.run(IMPORTS, "my_posture = 1", CHECK, REPORT, when=200)
    assert report("Ada") == UNSAVED and desk.judged == []
    stored(desk.lab, IMPORTS, "my_posture = 1", CHECK, saved=300)
    assert report("Ada") == "written"


def test_last_version_of_a_cell_counts(desk):
    versions = [f"def answer(q):\n    return {k}" for k in range(3)]
    desk.run(IMPORTS, *versions, CHECK, when=200)
    stored(desk.lab, IMPORTS, versions[1], CHECK, saved=150)
    assert report("Ada") == UNSAVED
    stored(desk.lab, IMPORTS, versions[2], CHECK, saved=300)
    assert report("Ada") == "written"
    desk.run(versions[0], when=400)  # back to the first version
    assert report("Ada") == UNSAVED


def test_deleted_cells_are_ignored(desk):
    desk.run(IMPORTS, "def helper(): ...", 'predict("start_here.p1", "b")', when=200)
    stored(desk.lab, IMPORTS, CHECK, saved=300)
    assert report("Ada") == "written"


def test_unchanged_cells_do_not_have_to_be_saved_again(desk):
    stored(desk.lab, IMPORTS, CHECK + "\n", saved=100)
    desk.run(IMPORTS, CHECK, when=200)
    assert report("Ada") == "written"


def test_report_cell_must_be_saved_only_if_it_has_guesses(desk, monkeypatch):
    parse = SimpleNamespace(parse_line=lambda text: None)
    monkeypatch.setitem(sys.modules, "robokin.course.guesses", parse)
    stored(desk.lab, IMPORTS, "report(who)", saved=100)
    cell = 'report("Ada", guesses="p1 b")'
    desk.run(IMPORTS, REPORT, when=200)
    assert report("Ada") == "written"
    desk.run(cell, when=300)
    assert report("Ada", guesses="p1 b") == UNSAVED
    stored(desk.lab, IMPORTS, cell, saved=400)
    assert report("Ada", guesses="p1 b") == "written"
    desk.run("def answer(): ...\nreport('Ada')", when=500)
    assert report("Ada") == UNSAVED, "an answer in the cell of `report` does not count"


def test_invalid_line_of_guesses_is_reported(desk):
    stored(desk.lab, IMPORTS)
    assert report("Ada", guesses=3).startswith("No report: guesses: wanted the line")
    said = report("Ada", guesses="first b")
    assert said.startswith("No report: guesses: wanted") and said.endswith("got 'first b'")
    assert desk.judged == []


# --- Finding the notebook's file ------------------------------------------------------------------


def test_renamed_notebook_is_found_by_its_exercises(desk):
    stored(desk.folder / "Ada's lab.ipynb", IMPORTS, CHECK)
    stored(desk.folder / "other.ipynb", IMPORTS, 'check("scara_motion.1", f)')
    (desk.folder / "broken.ipynb").write_text("{")
    (desk.folder / "none.ipynb").write_text('{"cells": 3}')
    desk.run(IMPORTS, 'predict("start_here.p1")', when=100)
    assert report("Ada") == "written" and desk.judged == [("Ada's lab.ipynb", "Ada")]


def test_two_copies_require_a_file_name(desk):
    for name in ("one.ipynb", "two.ipynb"):
        stored(desk.folder / name, IMPORTS, CHECK)
    desk.run(IMPORTS, CHECK, when=100)
    said = report("Ada")
    assert "one.ipynb, two.ipynb" in said and 'report(who, notebook="NAME.ipynb")' in said
    assert desk.judged == []
    assert report("Ada", notebook="two.ipynb") == "written"
    assert report("Ada", notebook=Path("one.ipynb")) == "written"
    assert desk.judged == [("two.ipynb", "Ada"), ("one.ipynb", "Ada")]


@pytest.mark.parametrize("given", ["lost.ipynb", "", 3, ["lab.ipynb"], "a\0b"])
def test_missing_file_is_reported(desk, given):
    assert report("Ada", notebook=given).startswith("No report: ") and desk.judged == []


def test_file_that_is_not_a_notebook_is_reported(desk):
    desk.lab.write_text("{}")
    assert report("Ada") == "No report: lab.ipynb is not a notebook."


def test_missing_notebook_is_reported(desk):
    desk.run(IMPORTS, CHECK, when=100)
    assert "no notebook with this lab's exercises" in report("Ada")


def test_path_of_the_notebook_is_taken_from_vs_code(desk, monkeypatch):
    monkeypatch.delenv("JPY_SESSION_NAME")
    stored(desk.lab, IMPORTS, CHECK)
    space = {"__vsc_ipynb_file__": str(desk.lab)}
    ipython = SimpleNamespace(get_ipython=lambda: SimpleNamespace(user_ns=space))
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    assert report("Ada") == "written"


def test_file_names_in_links_are_escaped():
    note = Note('a<b>&_Ada.html is "your" report.\nx: holds')
    assert note._repr_html_() is None
    note.file = "a<b>&_Ada.html"
    assert note._repr_html_() == (
        '<a href="a%3Cb%3E%26_Ada.html" target="_blank">a&lt;b&gt;&amp;_Ada.html</a>'
        " is &quot;your&quot; report.<br>x: holds"
    )


# --- Reports written in a kernel ------------------------------------------------------------------


class Kernel:
    """A real kernel, started as JupyterLab starts it for the notebook at `lab`."""

    def __init__(self, lab):
        self.manager = KernelManager(kernel_name="python3")
        environment = {k: v for k, v in os.environ.items() if k != "ROBOKIN_JUDGE"}
        environment["JPY_SESSION_NAME"] = str(lab)
        self.manager.start_kernel(cwd=str(lab.parent), env=environment)
        self.client = self.manager.client()
        self.client.start_channels()
        self.client.wait_for_ready(timeout=PATIENCE)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.client.stop_channels()
        self.manager.shutdown_kernel(now=True)

    def run(self, source, seen=lambda text: None):
        """Run a cell and return its output. `seen` is called repeatedly with the output so far."""
        asked, said = self.client.execute(source), ""
        while True:
            try:
                message = self.client.get_iopub_msg(timeout=PATIENCE)
            except Empty:
                pytest.fail(f"the kernel sends nothing after: {said}")
            content, kind = message["content"], message["msg_type"]
            if message["parent_header"].get("msg_id") != asked:
                continue
            if kind == "status" and content["execution_state"] == "idle":
                return said
            said += content.get("text", "") or content.get("data", {}).get("text/plain", "")
            said += "\n".join(content.get("traceback", ()))
            seen(said)

    def others(self):
        """The child processes of the kernel."""
        started = psutil.Process(self.manager.provisioner.pid).children(recursive=True)
        return [each for each in started if each.status() != psutil.STATUS_ZOMBIE]


def test_complete_session_writes_a_report(tmp_path):
    """The session contains an answer that raises an error, a correct answer that is not saved, and
    an interrupt.
    """
    raising = "import robokin\nmy_posture = 1 / 0"
    cells = [IMPORTS, raising, CHECK, 'predict("start_here.p1", "b")']
    lab = stored(tmp_path / "00_start_here.ipynb", *cells)
    with Kernel(lab) as kernel:
        for source in cells:
            kernel.run(source)
        page = tmp_path / "00_start_here_Ada.html"
        said = kernel.run(REPORT)
        assert said.startswith("Running your lab again.") and page.name in said
        assert "start_here.1: failed" in said and "1 of 1 predictions made" in said
        assert "Cells that raise an error: cell [2] (ZeroDivisionError), cell [3]" in said
        data = report_data(page.read_text(encoding="utf-8"))
        assert data["who"] == "Ada" and data["exercises"][0]["state"] == "failed"
        before = page.read_bytes()
        right = solution("start_here.1")
        assert "holds" in kernel.run(f"{right}\n{CHECK}")
        assert kernel.run(REPORT) == repr(UNSAVED).strip("'") and page.read_bytes() == before
        stored(lab, IMPORTS, right, CHECK, "import time\ntime.sleep(600)")
        stopped = []

        def interrupt(text):
            if "Running" in text and not stopped:
                until(lambda: len(kernel.others()) > 1, "no kernel for judging has started")
                stopped.append(kernel.manager.interrupt_kernel())

        assert "Stopped: no report was written." in kernel.run(REPORT, interrupt)
        until(lambda: not kernel.others(), "a judging process is still running")
        assert page.read_bytes() == before and kernel.run("print(6 * 7)") == "42\n"


@pytest.mark.skipif(os.name == "nt", reason="needs a login shell")
def test_commands_of_lab_00_work(tmp_path):
    """The commands run in a login shell, in the clone's folder, without our Python on the path."""
    [told] = [cell for cell in _prose("00_start_here.ipynb") if "-m robokin.course report" in cell]
    assert "in the folder from which you started JupyterLab" in " ".join(told.split())
    [commands] = re.findall(r"^```sh\n(.*?)^```", told, re.M | re.S)
    python = tmp_path / ".venv" / "bin" / "python"
    python.parent.mkdir(parents=True)
    python.write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
    python.chmod(0o755)
    labs = tmp_path / "my-labs"
    labs.mkdir()
    stored(labs / "00_start_here.ipynb", IMPORTS, solution("start_here.1"), CHECK)
    environment = {"HOME": str(tmp_path), "PATH": "/usr/bin:/bin", "PYTHONPATH": str(ROOT)}
    run = subprocess.run(
        ["bash", "-lec", commands],
        cwd=tmp_path,
        env=environment,
        text=True,
        capture_output=True,
        timeout=PATIENCE,
    )
    assert run.returncode == 0, run.stderr
    data = report_data((labs / "00_start_here_Your_Name.html").read_text(encoding="utf-8"))
    assert data["who"] == "Your Name" and data["exercises"][0]["state"] == "holds"
    assert (labs / "00_start_here.html").is_file()


def _prose(name):
    cells = json.loads((NOTEBOOKS / name).read_text(encoding="utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"]


# --- Reports written in JupyterLab ----------------------------------------------------------------


def test_lab_00_can_be_handed_in_from_jupyterlab(jupyter, browser):
    """The student changes the answer and the name, runs all cells, is told to save, saves and hands
    in.
    """
    name = "handing in/00_start_here.ipynb"
    lab = jupyter.labs / name
    lab.parent.mkdir()
    lab.write_bytes((NOTEBOOKS / lab.name).read_bytes())
    page = browser.new_page(viewport={"width": 1280, "height": 1000})
    jupyter.open(page, name)
    cells = page.locator(".jp-CodeCell")
    for now, new in (
        ("my_posture = ...", solution("start_here.1")),
        (
            'who = "your name"',
            'from robokin.course import report\n\nwho = "Zoë"\n\nreport(who)',
        ),
    ):
        cells.filter(has_text=now).locator(".cm-content").click()
        page.keyboard.press("Control+a")
        page.keyboard.insert_text(new)
    jupyter.run_all(page, name)
    last = cells.filter(has_text="report(who)")
    assert last.locator(".jp-OutputArea-output").inner_text().strip() == UNSAVED
    assert not list(lab.parent.glob("*.html"))
    page.keyboard.press("Control+s")
    tab = page.locator(".lm-TabBar-tab.lm-mod-current[data-type='document-title']")
    until(lambda: "jp-mod-dirty" not in tab.get_attribute("class"), "it is not saved", page)
    last.locator(".cm-content").click()
    page.keyboard.press("Shift+Enter")
    link = last.get_by_role("link", name="00_start_here_Zoë.html")
    link.wait_for()
    assert "start_here.1: holds" in last.inner_text()
    assert "0 of 1 predictions made. Is a guess missing?" in last.inner_text()
    made = lab.parent / "00_start_here_Zoë.html"
    data = report_data(made.read_text(encoding="utf-8"))
    assert data["who"] == "Zoë" and data["exercises"][0]["state"] == "holds"
    link.click()  # JupyterLab opens the page next to the notebook
    page.locator(".lm-TabBar-tab", has_text=made.name).first.wait_for()
    page.close()
