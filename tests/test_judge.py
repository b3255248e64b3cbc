"""Notebooks that are handed in are judged again, and their answers get the correct points, whatever
the student wrote.

The labs are written here, so that the points for every answer are known in advance.
"""

import copy
import json
import os
import random
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

import nbformat
import psutil
import pytest
from handed import cell, stored
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output

from robokin import course
from robokin.course import judge as judging
from robokin.course import kernel, process, solution
from robokin.course.__main__ import main
from robokin.course.handed_in import Call, claims, handed_in
from robokin.course.judge import Limits, NotebookRun, guesses, judge_notebook
from robokin.course.process import _end_marked

QUICK = Limits(cell=12, answer=60, all=100)
IMPORTS = "from robokin.course import check, predict, variant\nimport numpy as np"


# --- Points for answers ---------------------------------------------------------------------------


def test_answers_that_are_missing_raise_an_error_or_never_end_are_judged(tmp_path):
    lab = stored(
        tmp_path / "03_irb140_motion Ada.ipynb",
        IMPORTS,
        "def blend_for(distance, corner):\n    while True:\n        pass",
        cell('check("irb140_motion.1", blend_for)', "irb140_motion.1: does not hold."),
        cell("'a check that was deleted'", "irb140_motion.2: holds."),
        "raise RuntimeError('no')\ndef speeds_are_right(speeds):\n    return True",
        'check("irb140_motion.3", speeds_are_right)',
        'check("scara_motion.1", None)',
        "from ipywidgets import interact\n@interact(x=(0, 3))\ndef f(x=1):\n    print('x is', x)",
        "import asyncio\nawait asyncio.sleep(0)\nprint('awaited')",
        "input('?')",
    )
    judged = judge_notebook(handed_in(lab), "Ada", QUICK)
    one, two, three = judged.exercises
    assert (one.state, one.mistake) == ("does not hold", "never ends")
    assert (two.state, two.points) == ("unanswered", 0)
    assert three.state == "failed" and "NameError" in three.says[0] and three.points == 0
    remarks = "\n".join(judged.remarks)
    assert 'irb140_motion.2: the stored output says "holds"' in remarks
    assert "irb140_motion.1" not in remarks and "RuntimeError" in remarks
    assert "Left out, since they belong to other labs: scara_motion.1." in remarks
    assert "StdinNotImplementedError" in remarks and "could not be read" not in remarks
    assert judged.notebook.cells[-2].outputs[0].text == "awaited\n"
    assert all(guess.right is None for guess in judged.predictions)


@pytest.fixture(scope="module")
def tricks(tmp_path_factory):
    """The result of a lab with unusual cells and with unusual files next to it."""
    folder = tmp_path_factory.mktemp("tricks")
    (folder / "robokin.py").write_text("raise SystemExit")  # the judge must not import this module
    for name in ("tasks", "tasks/.robokin", ".robokin"):
        (folder / name).mkdir()
        (folder / name / "one.json").write_text("{}")
    (folder / "data.csv").write_text("1")
    os.mkfifo(folder / "tasks" / "pipe") if hasattr(os, "mkfifo") else None
    (folder / "tasks" / "nowhere").symlink_to(folder / "none")
    (folder / "images").symlink_to("/")
    odd = [os.fsencode(folder) + b"/odd \xff.txt", os.fsencode(folder) + b"/tasks/odd \xff.txt"]
    for name in odd if sys.platform == "linux" else ():
        with open(name, "w"):
            pass
    sleeper = "subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(1000)']"
    anew = (  # a process that keeps restarting itself in a new session
        "import os, time\nlast = time.time() + 60\nwhile time.time() < last:\n    if os.fork():\n"
        "        os._exit(0)\n    os.setsid()\n    time.sleep(0.1)"
    )
    lab = stored(
        folder / "lab.ipynb",
        IMPORTS,
        "import os, subprocess, sys\nfrom pathlib import Path\nfrom robokin import course\n"
        "assert Path('tasks/one.json').is_file() and not [*Path().glob('robokin*')]\n"
        "assert Path('data.csv').is_file() and not Path('tasks/pipe').exists()\n"
        "assert not [*Path().rglob('.robokin')] and not Path('images').exists()\n"
        "assert 'ROBOKIN_JUDGE' in os.environ",
        "blend_for = lambda distance, corner: 0.25\n"
        "course._verdicts['irb140_motion.1'] = course.Verdict('irb140_motion.1', holds=True)\n"
        "_check, check = check, lambda *a: print('irb140_motion.1: holds.')",
        # an earlier call, which does not count
        'course.check("irb140_motion.1", lambda distance, corner: distance)',
        'check("irb140_motion.1", blend_for)',
        f"started = {sleeper}), {sleeper}, start_new_session=True), {sleeper}, env={{}})\n"
        f"anew = subprocess.Popen([sys.executable, '-c', {anew!r}])\n"
        "print(*(each.pid for each in started))",
        "for k in range(60):\n    print('x' * 100, end=f' {k}\\r', flush=k % 10 == 0)",
        "print('a line of 15000', 'x' * 15000)",
        "import sys\nprint('first', file=sys.stderr)\nprint('second')",
        "deep = 1\nfor _ in range(200):\n    deep = [deep]\n"
        "display({'application/json': deep}, raw=True)",
        "print('\\ud800')",
        "get_ipython().kernel.session.send(get_ipython().kernel.iopub_socket, 'stream', "
        "{'name': 'stdout', 'text': '\\udc80 raw'}, get_ipython().kernel.get_parent())",
        "def speeds_are_right(speeds):\n    raise ValueError('\\ud800' * 9)",
        'course.check("irb140_motion.3", speeds_are_right)',
        "get_ipython().user_expressions = lambda e: {'judge': '{\"verdict\": [1]}'}",
        'course.check("irb140_motion.2", np.sin)',
    )
    before = sorted(os.listdir(folder))
    judged = judge_notebook(handed_in(lab), "Ada", QUICK)
    assert sorted(os.listdir(folder)) == before, "files were left next to the notebook"
    return SimpleNamespace(judged=judged, cells=judged.notebook.cells)


def test_package_modified_by_a_notebook_does_not_affect_verdicts(tricks):
    one, two, three = tricks.judged.exercises
    assert one.state == "does not hold"
    said = 'irb140_motion.1: the notebook\'s own output says "holds"; the check says'
    assert any(remark.startswith(said) for remark in tricks.judged.remarks)
    assert two.state == "failed" and "not a verdict" in two.says[0]
    assert three.state == "does not hold" and "ValueError" in str(three)
    assert not any("AssertionError" in remark for remark in tricks.judged.remarks)
    for text in (str(tricks.judged.exercises), str(tricks.judged.remarks)):
        text.encode()


@pytest.mark.skipif(sys.platform != "linux", reason="a process may survive on other systems")
def test_processes_of_a_notebook_end_with_it(tricks):
    [printed] = [c.outputs[0].text for c in tricks.cells if c.source.startswith("started")]
    for pid in map(int, printed.split()):
        assert not psutil.pid_exists(pid) or psutil.Process(pid).status() == psutil.STATUS_ZOMBIE
    assert not [p for p in psutil.process_iter() if "last = time.time() + 60" in _command(p)]


def _command(process_):
    try:
        return " ".join(process_.cmdline())
    except psutil.Error:
        return ""


@pytest.mark.skipif(sys.platform != "linux", reason="a process may survive on other systems")
def test_other_processes_keep_running():
    marks = ("one", "two")
    both = [
        subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE, env=env)
        for env in (os.environ | {process.MARK: mark} for mark in marks)
    ]
    try:
        judging._complete(lambda: _end_marked("one"))
        both[0].wait(60)
        assert both[1].poll() is None
    finally:
        for each in both:
            each.kill()
            each.communicate()


def test_outputs_are_kept_up_to_the_limit(tricks):
    shown = {c.source.split("\n")[0][:20]: c.outputs for c in tricks.cells}
    assert shown["for k in range(60):"][0].text == "x" * 100 + " 59"
    assert len(shown["print('a line of 150"][0].text) < 6000
    assert [each.text for each in shown["import sys"]] == ["second\n", "first\n"]
    json.dumps(tricks.judged.notebook, ensure_ascii=False).encode()
    nbformat.validate(tricks.judged.notebook)


def test_simultaneous_judging_gives_the_same_verdicts(tmp_path):
    labs = [
        stored(
            tmp_path / "scara.ipynb",
            "from robokin.course import check, predict",
            solution("scara_motion.3").replace("your name", "Bob"),
            'check("scara_motion.3", design, who=who)',
            'predict("scara_motion.p1", "b")',
        ),
        stored(
            tmp_path / "irb140.ipynb",
            f"{IMPORTS}\n1 / 0",
            "print('shown')",
            'check("irb140_motion.1", lambda distance, corner: distance)',
            'check("irb140_motion.2", nothing)',
        ),
    ]

    def all_of(lab):
        made = judge_notebook(handed_in(lab), None, QUICK)
        printed = [[o.get("text") for o in c.outputs] for c in made.notebook.cells]
        return made.exercises, made.predictions, made.remarks, printed

    alone = [all_of(lab) for lab in labs]
    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(all_of, labs)) == alone
    states = [[each.state for each in exercises] for exercises, *_ in alone]
    assert states == [["unanswered"] * 2 + ["holds"], ["does not hold", "failed", "unanswered"]]
    assert alone[0][2] == ("scara_motion.3: judged with the numbers of 'Bob'.",)
    assert alone[0][1][0].choice == "b" and alone[1][3][1] == ["shown\n"]


# --- Limits ---------------------------------------------------------------------------------------


def slower(monkeypatch, factor):
    monkeypatch.setattr(process, "SLOWER", factor)
    monkeypatch.setattr(judging, "SLOWER", factor)


def test_cpu_limit_includes_child_processes(tmp_path, monkeypatch):
    slower(monkeypatch, 10_000)  # no real machine is that slow
    lab = stored(
        tmp_path / "lab.ipynb",
        IMPORTS,
        "import subprocess, sys, time\ntime.sleep(1.5)",
        "subprocess.run([sys.executable, '-c', 'while True: pass'])",
        "def slow():\n    end = time.process_time() + slow.time\n"
        "    while time.process_time() < end:\n        pass\n    slow.time = 9\nslow.time = 0",
        'check("irb140_motion.1", slow())',
        'check("irb140_motion.2", 1)',
    )
    judged = judge_notebook(handed_in(lab), "Ada", Limits(cell=5, answer=2, all=40))
    one, two, three = judged.exercises
    assert [remark for remark in judged.remarks if "topped" in remark] == [
        "cell [3]: Stopped after 5 s."
    ]
    assert (one.state, one.says) == (
        "failed",
        ("No answer to judge: judging it was stopped after 2 s.",),
    )
    assert (two.state, three.state) == ("does not hold", "unanswered")


def test_total_time_and_memory_are_limited(tmp_path):
    """Work beyond the limits is not run or raises an error; earlier results count."""
    spin = "import time\nend = time.process_time() + 3\nwhile time.process_time() < end:\n    pass"
    lab = stored(
        tmp_path / "lab.ipynb",
        f"{IMPORTS}\nlarge = bytes(6 * 2**30)",
        'check("irb140_motion.1", 1)',
        *[f"{spin}\nprint({k})" for k in range(7)],
        'check("irb140_motion.2", 1)',
    )
    judged = judge_notebook(
        handed_in(lab), "Ada", Limits(cell=15, answer=15, all=15, memory=4 * 2**30)
    )
    one, two, _ = judged.exercises
    late = "Not run: the 15 s for all cells were used up."
    assert one.state == "does not hold" and (two.state, two.says) == ("failed", (late,))
    assert any("MemoryError" in remark for remark in judged.remarks) or sys.platform != "linux"
    printed = [o.text for c in judged.notebook.cells for o in c.outputs if o.get("text")]
    assert "0\n" in printed and f"{late}\n" in printed


def test_sleeping_cell_is_stopped_and_not_judged(tmp_path, monkeypatch):
    slower(monkeypatch, 1)
    lab = stored(
        tmp_path / "lab.ipynb",
        f"{IMPORTS}\nimport signal, time\nfrom unittest.mock import Mock",
        "nap = Mock()\nnap.side_effect = lambda: time.sleep(1000) if nap.call_count > 1 else None",
        'check("irb140_motion.1", nap())',
        # makes the judge end the first kernel
        "signal.signal(signal.SIGINT, signal.SIG_IGN)\ntime.sleep(1000)",
        'check("irb140_motion.2", 1)',
        "time.sleep(1000)",
        'check("irb140_motion.3", 1)',
    )
    begun = time.monotonic()
    judged = judge_notebook(handed_in(lab), "Ada", Limits(cell=1, answer=1, all=80))
    assert time.monotonic() - begun < 500
    # on a slow machine other cells may time out as well, so nothing else is certain
    assert {each.state for each in judged.exercises} == {"not judged"}
    assert {each.points for each in judged.exercises} == {0}
    assert all("too slow" in each.says[0] for each in judged.exercises)
    stopped = [r for r in judged.remarks if "Stopped after 1 s by the clock" in r]
    assert any("only ending the kernel" in remark for remark in stopped)


def test_exercise_that_was_not_judged_does_not_contradict_its_output(tmp_path):
    run = NotebookRun(
        new_notebook(), {"irb140_motion.1": Call(3, "irb140_motion.1", "x", "")}, "Ada", QUICK
    )
    run.found["irb140_motion.1"] = {"error": "KeyboardInterrupt", "slow": True}
    result = run.result("irb140_motion.1", {})
    assert (result.state, result.points) == ("not judged", 0)
    assert judging._differences((result,), {result.id: "holds"}, {result.id: "holds"}) == []


# --- Judging in the kernel ------------------------------------------------------------------------


def asked(answers, name, answer, own="", who=None):
    request = json.dumps({"name": name, "answer": answer, "own": own, "who": who})
    return json.loads(answers({"judge": request})["judge"])


def test_judging_does_not_change_the_kernel():
    space = {"right": None, "who": "Bob"}
    exec(solution("scara_motion.3").replace("your name", "Bob"), space)
    answers = kernel.judging(course.check, space)
    assert answers({}) == {}
    before = dict(course._verdicts)
    names = set(space)
    assert asked(answers, "scara_motion.3", "design", "who")["verdict"]["holds"]
    other = asked(answers, "scara_motion.3", "design", "who", "Ada")
    assert not other["verdict"]["holds"] and other["own"] == "Bob"
    assert "NameError" in asked(answers, "scara_motion.3", "nothing_there")["error"]
    assert not asked(answers, "scara_motion.3", "")["verdict"]["answered"]
    assert course._verdicts == before and set(space) == names


RIGHT = {"answered": True, "holds": True, "mistake": None, "says": [], "case": None, "points": 1}


@pytest.mark.parametrize(
    "odd",
    [{"verdict": 1}, {"verdict": {"holds": True}}, {}, {"x": 1}, {"verdict": []}]
    + [
        {"verdict": RIGHT | change}
        for change in (
            {"says": [1]},
            {"says": "text"},
            {"says": None},
            {"mistake": 1},
            {"case": ["x"]},
            {"points": 7},
            {"points": "x"},
            {"points": float("nan")},
            {"points": -1},
        )
    ],
)
def test_invalid_kernel_answer_is_ignored(odd):
    call = Call(0, "irb140_motion.1", "x", "")
    run = NotebookRun(new_notebook(), {call.name: call}, "Ada", QUICK)
    run.found[call.name] = odd
    result = run.result(call.name, {})
    assert result.state == "failed" and result.points == 0
    run.found[call.name] = {"verdict": RIGHT}
    assert run.result(call.name, {}).state == "holds"


@pytest.mark.parametrize("odd", [None, 1, "", "x", "[]", '{"a":', "[" * 10_000, "9" * 5000])
def test_kernel_answer_that_is_not_json_is_ignored(odd):
    assert judging._read(odd) == {"error": "the kernel gave no answer"}


# --- Reading notebooks ----------------------------------------------------------------------------


def test_last_call_counts_and_any_file_name_works(tmp_path):
    lab = stored(
        tmp_path / "homework.ipynb",
        'check("irb140_motion.1", first)\ncourse.check(name="irb140_motion.2", answer=a + 1)',
        '%time check("irb140_motion.3", x)',  # a magic command, which only Jupyter can parse
        "x = [i\n  % 2 for i in y]; await z",
        'robokin.course.check("irb140_motion.1", f(1), who="Ada")',
        'predict("irb140_motion.p2", "a"); predict("irb140_motion.p2", "b")',
        'predict("irb140_motion.p3", None)\npredict("irb140_motion.p99", "a")',
        'check("irb140_motion.3" x)',
        'check(f"irb140_{1}", 2); check("nonsense.1", 3)',
    )
    given = handed_in(lab)
    assert given.lab == "irb140_motion" and given.title == "homework"
    assert given.checks["irb140_motion.1"] == (3, "irb140_motion.1", "f(1)", "'Ada'")
    assert given.checks["irb140_motion.2"].answer == "a + 1"
    assert set(given.checks) == {"irb140_motion.1", "irb140_motion.2"}
    assert given.choices["irb140_motion.p2"].answer == "'b'"
    assert set(given.choices) == {"irb140_motion.p2"}
    assert "SyntaxError" in given.broken["irb140_motion.3"]
    [made] = [guess for guess in guesses(given) if guess.right is not None]
    assert made.choice == "b"
    empty = stored(tmp_path / "02_irb140_kinematics (2).ipynb", "1")
    assert handed_in(empty).lab == "irb140_kinematics"
    assert handed_in(stored(tmp_path / "notes.ipynb", "1")).lab is None


HOSTILE = ("<", " ", "-", "(", '"', "check(", "\\", "\n ", "?\n", "&#9", "1;", "irb140_motion.")


@pytest.mark.parametrize(
    ("size", "pieces"), [(100_000, HOSTILE), (1_000_000, HOSTILE[4:]), (4_000_000, HOSTILE[:4])]
)
def test_reading_a_notebook_takes_linear_time(size, pieces, tmp_path):
    """The limit is 2 s of CPU time per megabyte."""
    call, lab = 'check("irb140_motion.1", x)\n', tmp_path / "lab.ipynb"
    for piece in pieces:
        text = (piece * size)[:size]
        cells = [cell(call + text), new_markdown_cell("# " + text)]
        cells += [cell(call + text[:90_000]) for _ in range(0, size // 2, 90_000)]
        html = new_output("display_data", data={"text/html": text})
        cells[0].outputs = [html, new_output("stream", text=text)]
        lab.write_text(json.dumps(new_notebook(cells=cells)))
        begun = time.process_time()
        given = handed_in(lab)
        claims(given.notebook, given.checks)
        assert len(given.title) <= 200 and guesses(given)
        used = time.process_time() - begun
        assert used < 0.2 + 2e-6 * lab.stat().st_size, (piece, used)


@pytest.mark.parametrize(
    "text",
    [
        '{"nbformat": 4, "cells": [' + "{}," * 300_000 + "{}]}",
        '{"nbformat": 4, "cells": [{"cell_type": "code", "source": "", "outputs": ['
        + "{}," * 300_000
        + "{}]}]}",
        "[" * 1_000_000,
        '{"nbformat": ' + "9" * 1_000_000 + "}",
        '{"nbformat": 4, "cells": [], "x": ' + "[" * 500 + "]" * 500 + "}",
        '"' + "\\u0041" * 200_000,
    ],
    ids=range(6),
)
def test_reading_an_invalid_notebook_takes_linear_time(text, tmp_path):
    lab = tmp_path / "lab.ipynb"
    lab.write_text(text)
    begun = time.process_time()
    tried(lab)
    assert time.process_time() - begun < 2


def tried(path):
    """Return whether a notebook can be read. If it can, assert that everything that is done with it
    outside a kernel works.
    """
    try:
        given = handed_in(path)
    except (ValueError, OSError) as error:
        reason = str(error).removeprefix("not a notebook: ").strip()
        assert reason and len(str(error)) < 400, repr(error)
        return False
    nbformat.validate(given.notebook)
    claims(given.notebook, given.checks)
    guesses(given)
    json.dumps([given.title, given.broken, given.checks], ensure_ascii=False).encode()
    json.dumps(given.notebook, ensure_ascii=False).encode()
    return True


@pytest.mark.parametrize(
    ("change", "readable"),
    [
        ({"nbformat": 4.0}, True),
        ({"nbformat": "4"}, False),
        ({"nbformat": 3}, False),
        ({"nbformat": None}, False),
        ({"nbformat": 10**4000}, False),
        ({"nbformat_minor": 10**4000}, True),
        ({"nbformat_minor": "5"}, True),
        ({"metadata": []}, True),
        ({"cells": {}}, False),
        ({"cells": [1]}, False),
        ({"cells": [{"cell_type": "code", "metadata": {}}]}, False),
        ({"cells": [{"cell_type": "spell", "source": ""}]}, False),
        ({"cells": [{"cell_type": "code", "source": ["a", 1]}]}, False),
        ({"cells": [{"cell_type": ["code"], "source": ""}]}, False),
    ],
)
def test_invalid_notebooks_are_refused(change, readable, tmp_path):
    lab = tmp_path / "lab.ipynb"
    lab.write_text(json.dumps(new_notebook(cells=[new_code_cell("1")]) | change))
    assert tried(lab) == readable


@pytest.mark.parametrize(
    "source",
    [
        'check("irb140_motion.1", ' + "-" * 10_000 + "1)",
        'check("irb140_motion.1", ' + "1+" * 30_000 + "1)",
        'check("irb140_motion.1", ' + "(" * 500 + ")" * 500 + ")",
        'check("irb140_motion.1", "\ud800")',
        'check("irb140_motion.1", "\0")',
        'check("irb140_motion.1", 0x' + "f" * 5000 + ")",
        'check("irb140_motion.1", ' + "9" * 5000 + ")",
        'check("irb140_motion.' + "9" * 5000 + '", 1)\ncheck("irb140_motion.1" 1)',
        'check("irb140_motion.1", 1' + " " * 200_000 + ")",
    ],
)
def test_exercise_in_a_cell_that_cannot_be_parsed_counts_as_broken(source, tmp_path):
    lab = tmp_path / "irb140_motion.ipynb"
    lab.write_text(json.dumps(new_notebook(cells=[cell(source)])))
    assert tried(lab)
    given = handed_in(lab)
    if "\ud800" in source:  # a surrogate is not a character, so it is read as an escape
        assert given.checks["irb140_motion.1"].answer == r"'\ud800'"
        return
    assert set(given.broken) == {"irb140_motion.1"} and given.broken["irb140_motion.1"]


def test_missing_and_unreadable_files_are_refused(tmp_path):
    for name, content in (("bytes", b"\xff\xfe"), ("empty", b""), ("large", b" " * 20_000_001)):
        path = tmp_path / name
        path.write_bytes(content)
        assert not tried(path)
    assert not tried(tmp_path) and not tried(tmp_path / "none") and not tried(tmp_path / "\0")
    with pytest.raises(ValueError, match="wanted at most 20000000 bytes"):
        handed_in(tmp_path / "large")


@pytest.mark.skipif(sys.platform != "linux", reason="file names are Unicode on other systems")
def test_notebook_with_a_file_name_that_is_not_utf_8_is_read(tmp_path):
    path = stored(tmp_path / "lab.ipynb", "1").rename(os.fsdecode(os.fsencode(tmp_path) + b"/\xe9"))
    assert tried(path) and handed_in(path).title == "\N{REPLACEMENT CHARACTER}"


def test_mutated_notebooks_are_read_or_refused_with_a_reason(tmp_path):
    dice = random.Random(24)
    values = [None, True, -1, 10**400, 1e308, "", "\ud800", "\0", "x" * 300, [], {}, [[]], {"": 0}]
    values += [
        "code",
        "stream",
        ["a"],
        {"text/plain": "irb140_motion.1: holds."},
        "check(",
        "-" * 9999,
    ]
    good = new_notebook(
        metadata={"kernelspec": {"name": "python3", "display_name": "x"}},
        cells=[
            new_markdown_cell("# Title", attachments={"a.png": {"image/png": "AA=="}}),
            cell('check("irb140_motion.1", 1)', "irb140_motion.1: holds."),
            cell('predict("irb140_motion.p1", "a")'),
        ],
    )
    good.cells[2].outputs = [new_output("stream", text="x"), new_output("error", ename="E")]
    text, lab, read = json.dumps(good), tmp_path / "irb140_motion.ipynb", 0
    for _ in range(600):
        changed = json.loads(text)
        for _ in range(dice.choice((1, 1, 2, 5))):
            places = [(changed, key) for key in changed]
            for holder, key in places:  # the list grows in the loop
                inner = holder[key]
                keys = (
                    inner
                    if isinstance(inner, dict)
                    else range(len(inner) if isinstance(inner, list) else 0)
                )
                places += [(inner, k) for k in keys]
            holder, key = dice.choice(places)
            what = dice.random()
            if what < 0.2:
                del holder[key]
            elif what < 0.3 and isinstance(holder, dict):
                holder[dice.choice(("cells", "source", "data", "\ud800"))] = holder.pop(key)
            else:
                holder[key] = copy.deepcopy(dice.choice(values))
        lab.write_text(json.dumps(changed))
        read += tried(lab)
    assert 100 < read < 590
    for _ in range(300):  # change single bytes, and truncate some files
        raw = bytearray(text.encode())
        raw[dice.randrange(len(raw))] = dice.randrange(256)
        lab.write_bytes(raw[: dice.choice((len(raw), dice.randrange(len(raw))))])
        tried(lab)


OWN = """# 1. Twice

Objective 1. Twice a number

## Solution

```python
def twice(x):
    return 2 * x
```
"""


def test_exercise_outside_robokin_is_judged_if_the_teacher_has_it(tmp_path, monkeypatch, capsys):
    """Files next to the student's notebook do not count as the teacher's."""
    (tmp_path / "handed").mkdir()
    lab = stored(
        tmp_path / "handed" / "Ada.ipynb",
        "from robokin.course import check, exercise",
        "def twice(x):\n    return x + x",
        'check("doubles.1", twice)',
        "check(exercise(twice, lambda rng: [(1,)]), twice)",
    )
    for folder, text in (("teacher", OWN), ("handed/exercises", OWN.replace("2 * x", "x"))):
        place = tmp_path / folder / "doubles"
        place.mkdir(parents=True)
        (place / "twice.md").write_text(text)
        (place / "twice.py").write_text("def cases(rng):\n    return [(1,), (2.5,), (-3,)]\n")
    judged = judge_notebook(handed_in(lab), "Ada", QUICK)
    told = "not judged, since it is not an exercise of a lab."
    assert judged.exercises == () and f"doubles.1: {told}" in judged.remarks
    assert [each for each in judged.remarks if each.endswith(told)][1:], (
        "the exercise defined in a cell is not reported"
    )

    monkeypatch.setenv("ROBOKIN_EXERCISES", "")  # so that pytest restores it after the test
    given = ["summary", str(tmp_path / "handed"), "--to", str(tmp_path)]
    assert main([*given, "--exercises", str(tmp_path / "teacher")]) == 0
    table = (tmp_path / "summary.csv").read_text(encoding="utf-8-sig")
    assert re.search("^Ada,doubles,Ada.ipynb,.*,holds,", table, re.M), table
    assert main([*given, "--exercises", str(tmp_path / "nowhere")]) == 1
    assert main([*given, "--exercises", str(tmp_path / "handed" / "exercises" / "doubles")]) == 1
    errors = capsys.readouterr().err
    assert "wanted a folder, got" in errors and "no new lab in" in errors
