"""The command `python -m robokin.jobs FOLDER`: reports, log, exit status, and a folder of mutated
task files.

`python tests/test_jobs_command.py 10000 /tmp/mutants` writes 10 000 such files to a folder. The
test uses ROBOKIN_MUTANTS files, or 300 if the variable is not set.
"""

import copy
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import PATIENCE

from robokin.jobs.visit_collect import read_task

DATA = Path(__file__).parent / "data"
TASKS = Path(__file__).parents[1] / "notebooks" / "tasks"
CASES = json.loads((DATA / "spbu3_tasks.json").read_text())["cases"]
NUMBERS = ("L1", "L2", "T")
SOME = (*NUMBERS, "q'", "p0", "pi", "task")
posix = pytest.mark.skipif(os.name != "posix", reason="needs a POSIX system")


def command(*arguments, cwd, **options):
    """Run the command and return its result, which must not contain a traceback."""
    options = dict(stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=600) | options
    run = subprocess.run([sys.executable, "-m", "robokin.jobs", *arguments], cwd=cwd, **options)
    run.out, run.err = ((stream or b"").decode() for stream in (run.stdout, run.stderr))
    assert "Traceback" not in run.out + run.err and "Exception" not in run.out + run.err, run.err
    return run


def write(folder, **files):
    """Write task files to a folder (name=dict or bytes) and return it."""
    folder.mkdir(exist_ok=True)
    for name, data in files.items():
        (folder / f"{name}.json").write_bytes(
            data if isinstance(data, bytes) else json.dumps(data).encode()
        )
    return folder


def example(number=3, **changes):
    return json.loads((TASKS / f"example_{number}.json").read_text()) | changes


# ---- The document's examples

REPORTS = """\
ERROR: Task example_1.json skipped:
	point 0 = p0 (0, 0.7071, 0.7071) is too close to the origin: |p|^2 = 0.99998082 m^2 is less \
than l2^2 - l1^2 - 2 l1 rho = 3.3432 m^2
INFO: Task example_2.json: collected 1 of 2 points in 6.097347887101 s (T = 10 s)
	0 (2, 3, 2) at 6.097347887101 s
	left: 1
INFO: Task example_3.json: visited 2 of 2 points in 4.379934189305 s (T = 10 s)
	0 (2, 3, 2) at 3.04867394355 s
	1 (1, 3, 3) at 4.379934189305 s
INFO: 3 files: 2 solved, 1 skipped
"""


def test_example_files_give_the_documented_reports(tmp_path):
    run = command(str(TASKS), cwd=tmp_path)
    assert (run.returncode, run.out.splitlines(), run.err) == (1, REPORTS.splitlines(), "")
    assert [entry.name for entry in tmp_path.iterdir()] == ["output.log"]
    log = (tmp_path / "output.log").read_text(encoding="utf-8")
    assert [
        line for line in log.splitlines() if not line.startswith("DEBUG: ")
    ] == REPORTS.splitlines()
    debug = [line for line in log.splitlines() if line.startswith("DEBUG: Task example_3.json: ")]
    assert len(debug) == 4
    assert "T = 10.0, q' = [0.2, 0.2, 0.2], p0 = [1.0, 1.0, 1.0], pi = [[2.0, 3.0, 2.0]" in debug[0]
    numbers = [[float(x) for x in re.findall(r"\d+\.\d+", line.split("=", 1)[1])] for line in debug]
    assert numbers[1][:3] == pytest.approx(
        (0.785398163397448, 0.149913117550067, 1.253235897503375), abs=1e-14
    )
    assert "t1, t2, t3 from p0 to pi[0, 1] = [[" in debug[2]
    assert "t1, t2, t3 from pi[0] to pi[1] = [[" in debug[3]
    assert max(numbers[2][:3]) == pytest.approx(3.048673943550, abs=1e-12)
    assert max(numbers[3]) == pytest.approx(1.331260245755, abs=1e-12)


def printed_times(task):
    """t1, t2, t3 in the order in which the document's program logs them (appendix 1), with a break
    where no point fits (errata S0-f).
    """
    q, T = task.q.tolist(), task.T
    here, done, total = q[0], set(), 0.0
    while len(done) < len(q) - 1:
        best = None
        for i, there in enumerate(q[1:]):
            if i not in done:
                times = [abs(a - b) / v for a, b, v in zip(there, here, task.speeds, strict=True)]
                yield times
                if best is None or max(times) < best[0]:
                    best = max(times), i
        if task.kind == "collect" or total + best[0] > T:
            return
        total += best[0]
        done.add(best[1])
        here = q[1 + best[1]]


@pytest.mark.parametrize("kind", ["visit", "collect"])
@pytest.mark.parametrize("T", [0.0, 9.0, 1e3])
def test_log_has_the_times_of_all_candidates_as_the_documents_program(tmp_path, kind, T):
    tries = np.random.default_rng(5).uniform([1, 1, 1], [4, 4, 4], (9, 3))
    data = example(3, pi=tries.tolist(), task=kind, T=T)
    run = command("tasks", cwd=write(tmp_path / "tasks", a=data).parent)
    assert run.returncode == 0, run.out
    log = (tmp_path / "output.log").read_text(encoding="utf-8").splitlines()
    lines = [line.split(" = ")[1] for line in log if "t1, t2, t3 from" in line]
    found = [times for line in lines for times in json.loads(line)]
    wanted = list(printed_times(read_task(tmp_path / "tasks" / "a.json")))
    np.testing.assert_allclose(found, wanted, rtol=1e-12)
    assert len(found) == (45 if (kind, T) == ("visit", 1e3) else 9) or (kind, T) == ("visit", 9.0)


def test_success_returns_0_and_replaces_the_log(tmp_path):
    (tmp_path / "output.log").write_text("yesterday\n" * 1000)
    run = command(
        "tasks", cwd=write(tmp_path / "tasks", b=example(2), a=example(3), c=example(T=4)).parent
    )
    assert run.returncode == 0 and run.err == ""
    assert re.findall(r"Task (\w)\.json", run.out) == ["a", "b", "c"], (
        "the tasks are not in alphabetical order"
    )
    assert "visited 1 of 2 points in 3.04867394355 s (T = 4 s)" in run.out, (
        "errata S0-f: the printed program does not end on this task"
    )
    assert "yesterday" not in (tmp_path / "output.log").read_text()


def test_help_and_usage_errors_explain_the_command(tmp_path):
    run = command("-h", cwd=tmp_path)
    assert run.returncode == 0
    for word in (
        "FOLDER",
        "L1, L2",
        "q'",
        "p0",
        "pi",
        "visit",
        "collect",
        "output.log",
        "Exit status",
        "rad/s",
    ):
        assert word in run.out
    assert max(map(len, run.out.splitlines())) <= 84
    for arguments in ((), ("a", "b"), ("--fast", "a")):
        run = command(*arguments, cwd=tmp_path)
        assert run.returncode == 2 and "usage: python -m robokin.jobs" in run.err


def test_empty_folder_returns_2(tmp_path):
    empty = write(tmp_path / "empty")
    (empty / "readme.txt").write_text("no task")
    (empty / ".hidden.json").write_text("{}")
    for folder, wanted in (
        ("empty", "no tasks (*.json) found in folder empty"),
        ("nowhere", "folder nowhere cannot be read: No such file"),
        ("empty/readme.txt", "empty/readme.txt is a file: wanted its folder, empty"),
        ("output.log", "output.log is a file: wanted its folder, ."),
        ("", "cannot be read"),
    ):
        run = command(folder, cwd=tmp_path)
        assert (
            run.returncode == 2
            and wanted in run.err
            and wanted in (tmp_path / "output.log").read_text()
        )


# ---- Output that cannot be written


@pytest.mark.parametrize("log", ["folder", "link to nowhere"])
@posix
def test_unwritable_log_is_reported(tmp_path, log):
    tasks = write(tmp_path / "tasks", a=example())
    if log == "folder":
        (tmp_path / "output.log").mkdir()
        run = command("tasks", cwd=tmp_path)
        assert run.returncode == 1 and "output.log cannot be written: " in run.err
    else:
        (tmp_path / "output.log").symlink_to("nowhere/at/all")
        run = command(str(tasks), cwd=tmp_path)
        assert run.returncode == 0 and (tmp_path / "output.log").is_file()
    assert "visited 2 of 2" in run.out and "1 file: 1 solved, 0 skipped" in run.out


@pytest.mark.parametrize("link", ["symlink_to", "hardlink_to"])
@posix
def test_log_that_links_to_a_task_does_not_change_the_task(tmp_path, link):
    task = write(tmp_path / "tasks", a=example()) / "a.json"
    before = task.read_bytes()
    getattr(tmp_path / "output.log", link)(task)
    assert command("tasks", cwd=tmp_path).returncode == 0
    assert (
        task.read_bytes() == before and "INFO: Task a.json" in (tmp_path / "output.log").read_text()
    )


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
def test_full_disk_is_reported(tmp_path):
    tasks = write(tmp_path / "tasks", a=example(), b=example(2))
    with open("/dev/full", "wb") as full:
        run = command(str(tasks), cwd=tmp_path, stdout=full)
    assert run.returncode == 1 and "standard output cannot be written: No space" in run.err
    assert "Task b.json: collected 1 of 2" in (tmp_path / "output.log").read_text()


@posix
def test_closed_pipe_is_handled(tmp_path):
    write(tmp_path / "tasks", **{f"t{i:03}": example() for i in range(50)})
    line = f'"{sys.executable}" -m robokin.jobs tasks | head -1'
    run = subprocess.run(
        line, shell=True, cwd=tmp_path, capture_output=True, text=True, timeout=PATIENCE
    )
    assert run.stdout.startswith("INFO: Task t000.json") and "Traceback" not in run.stderr
    assert "Exception" not in run.stderr
    assert "50 files: 50 solved" in (tmp_path / "output.log").read_text()


@posix
def test_closed_streams_are_handled(tmp_path):
    write(tmp_path / "tasks", a=example())
    for closed, status, told in (
        (">&-", 1, "standard output cannot be written: it is closed\n"),
        (">&- 2>&-", 1, ""),
        ("2>&-", 0, ""),
    ):
        run = subprocess.run(
            f'"{sys.executable}" -m robokin.jobs tasks {closed}',
            shell=True,
            cwd=tmp_path,
            timeout=PATIENCE,
            capture_output=True,
            text=True,
        )
        assert (run.returncode, run.stderr) == (status, told)
        assert ("visited 2 of 2" in run.stdout) == (status == 0)
        log = (tmp_path / "output.log").read_text()
        assert "visited 2 of 2" in log and "cannot" not in log


@posix
def test_simultaneous_runs_in_one_folder_are_refused(tmp_path):
    """The second run reports that the first is still writing the log, and does not change it."""
    write(tmp_path / "tasks", **{f"t{i:03}": example() for i in range(600)})
    write(tmp_path / "others", a=example(2))
    line = [sys.executable, "-m", "robokin.jobs", "tasks"]
    with subprocess.Popen(
        line, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as first:
        first.stdout.readline()  # the first run has begun, and waits until its output is read
        second = command("others", cwd=tmp_path)
        out, err = first.communicate(timeout=PATIENCE)
    assert second.returncode == 1 and "a.json: collected 1 of 2" in second.out
    assert second.err == "output.log cannot be written: another run is writing it\n"
    assert first.returncode == 0 and b"cannot" not in err
    log = (tmp_path / "output.log").read_text()
    assert "a.json" not in log and "INFO: 600 files: 600 solved, 0 skipped" in log
    assert command("others", cwd=tmp_path).returncode == 0, "the folder is still locked"
    assert "a.json" in (tmp_path / "output.log").read_text()


@posix
def test_unprintable_file_names_are_escaped(tmp_path):
    tasks = write(tmp_path / "tasks")
    for name in (b"caf\xe9.json", "задача.json".encode(), b"a\nINFO: b.json", b"[x]*.json"):
        Path(os.fsdecode(os.fsencode(tasks) + b"/" + name)).write_text(json.dumps(example()))
    run = command(
        "tasks", cwd=tmp_path, env=os.environ | {"PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}
    )
    assert run.returncode == 0 and run.out.count("\nINFO: ") == 4 and "4 solved" in run.out
    assert "Task a\\nINFO: b.json: visited" in run.out and "Task caf\\udce9.json" in run.out
    assert "Task задача.json" in (tmp_path / "output.log").read_text(encoding="utf-8")


@posix
def test_special_files_are_reported(tmp_path):
    tasks = write(tmp_path / "tasks", good=example())
    (tasks / "folder.json").mkdir()
    os.mkfifo(tasks / "pipe.json")  # reading it would block for ever
    (tasks / "gone.json").symlink_to("nowhere")
    (tasks / "loop.json").symlink_to("loop.json")
    (tasks / "null.json").symlink_to("/dev/zero")
    run = command("tasks", cwd=tmp_path, timeout=PATIENCE)
    assert run.returncode == 1 and "6 files: 1 solved, 5 skipped" in run.out
    for name, why in (
        ("folder", "is not a file but a folder"),
        ("pipe", "is not a file but a device"),
        ("gone", "cannot be read: No such"),
        ("loop", "cannot be read"),
        ("null", "is not a file"),
    ):
        assert re.search(rf"ERROR: Task {name}.json skipped:\n\t{why}", run.out)


def test_interrupts_and_internal_errors_are_handled(tmp_path, monkeypatch, capsys):
    from robokin.jobs import __main__ as module

    monkeypatch.chdir(tmp_path)
    write(tmp_path / "tasks", a=example(), b=example(2))
    real = module.answer

    def fails(task, **options):
        if task.kind == "visit":
            raise ArithmeticError("raised by the test")
        return real(task, **options)

    monkeypatch.setattr(module, "answer", fails)
    assert module.main(["tasks"]) == 1
    out = capsys.readouterr().out
    assert "Task a.json skipped:\n\tthis program failed, ArithmeticError: raised by the test" in out
    assert "Task b.json: collected 1 of 2" in out and "Traceback" not in out
    assert "Traceback" in (tmp_path / "output.log").read_text(), (
        "the log lacks the traceback, which a developer needs"
    )

    def stop(task, **options):
        raise KeyboardInterrupt

    monkeypatch.setattr(module, "answer", stop)
    assert module.main(["tasks"]) == 130
    assert capsys.readouterr().err == "ERROR: stopped with Ctrl+C\n"


def test_messages_do_not_reach_the_log_of_the_caller(tmp_path, monkeypatch, capsys, caplog):
    from robokin.jobs import __main__ as module

    monkeypatch.chdir(tmp_path)
    write(tmp_path / "tasks", a=example())
    for _ in range(2):
        assert module.main(["tasks"]) == 0
        assert capsys.readouterr().out.count("visited 2 of 2") == 1
        assert (tmp_path / "output.log").read_text().count("visited 2 of 2") == 1
    assert not caplog.records and not module.log.handlers
    assert not module.answers.handlers and not module.end.handlers


# ---- Hints about the content of a file


def test_anomalies_in_a_file_are_reported(tmp_path):
    tasks = write(
        tmp_path / "tasks",
        degrees=example(**{"q'": [20, 20, 20]}),
        keys=example(q=[1, 2, 3], comment="mine"),
        low=example(p0=[6, 0, 1], pi=[[1.05, 0, 0.1]]),
        twice=json.dumps(example()).encode()[:-1] + b', "T": 1}',
    )
    run = command(str(tasks), cwd=tmp_path)
    assert run.returncode == 1 and "4 files: 3 solved, 1 skipped" in run.out
    said = dict(re.findall(r"Task (\w+)\.json.*?\n\t([^0-9].*)$", run.out, re.M))
    for name, words in (
        ("degrees", "20 rad/s is more than two turns a second; did you mean degrees?"),
        ("keys", "warning: unknown keys, ignored: 'q', 'comment'"),
        ("low", "from p0 to pi[0] dips under the floor, down to z = -1.016 m"),
        ("twice", "T: given 2 times"),
    ):
        assert words in run.out.split(f"Task {name}.json")[1].split("\nINFO")[0], said
    above = command(str(tasks), "--above-floor", cwd=tmp_path)
    assert (
        "low.json: could not visit any points, since every move that is in time dips under"
        in above.out
    )


# ---- Large files


def test_large_tasks_give_short_reports(tmp_path):
    rng = np.random.default_rng(0)
    points = rng.uniform([1, 1, 1], [3, 3, 5], (200_000, 3)).round(6).tolist()
    bad = [[9, 9, 9]] * 100_000
    tasks = write(
        tmp_path / "tasks",
        bad=example(2, pi=bad),
        good=example(2, pi=points, T=1e9),
        greedy=example(3, pi=points[:10_001]),
    )
    run = command(str(tasks), cwd=tmp_path, timeout=PATIENCE)
    assert run.returncode == 1 and "3 files: 1 solved, 2 skipped" in run.out
    assert "good.json: collected 200000 of 200000 points" in run.out
    assert "\n\tand 199000 more points\n" in run.out
    assert (
        run.out.count("is too far") == 10 and "\n\tand 99990 more points are too far\n" in run.out
    )
    assert "greedy.json skipped:\n\tpi: wanted at most 10000 points to visit, got 10001" in run.out
    assert len(run.out) < 100_000
    assert (tmp_path / "output.log").stat().st_size < 400_000
    assert [line for line in run.err.splitlines() if "files" not in line] == [
        "Task bad.json: reading 1 MB",
        "Task good.json: reading 6 MB",
        "Task good.json: 200000 points to collect",
    ]


def test_import_robokin_does_not_import_jobs():
    code = (
        "import sys, robokin; print([name for name in sys.modules if "
        "name.startswith('robokin.jobs')])"
    )
    assert (
        subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout
        == "[]\n"
    )


# ---- Mutated task files


def mutants(folder, count, seed=0):
    """Write `count` task files to a folder, most of them invalid; yield (name, words, case).

    words: text that the reason must contain, or None for a good task; case: the reference case from
    which the file was made, and the kind of task.
    """
    rng = np.random.default_rng(seed)
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for i in range(count):
        case = CASES[rng.integers(len(CASES))]
        data = {
            "L1": case["L1"],
            "L2": case["L2"],
            "T": case["T"],
            "q'": case["qdot"],
            "p0": case["p0"],
            "pi": case["pi"],
            "task": str(rng.choice(["visit", "collect"])),
        }
        kind = str(rng.choice(list(MUTATIONS)))
        path = folder / f"{i:05}_{kind.replace(' ', '_')}.json"
        made, words = MUTATIONS[kind](copy.deepcopy(data), rng)
        if made is None:
            path.mkdir()
        else:
            path.write_bytes(made if isinstance(made, bytes) else json.dumps(made).encode())
        yield path.name, words, (case, data["task"])


def _bad_value(rng, where):
    """A value that is not a number; `where` says whether it replaces a number or an array."""
    values = [
        None,
        True,
        False,
        "5",
        "",
        float("nan"),
        float("inf"),
        -float("inf"),
        {},
        {"a": 1},
        10**400,
        -(10**400),
        [[]],
        [[[1]]],
        "visit",
    ]
    return copy.deepcopy(values[rng.integers(len(values) - (where == "pi"))])


def _spoil_key(data, rng):
    key = str(rng.choice(SOME))
    value = _bad_value(rng, key)
    if key == "task" and value == "visit":
        value = "VISIT"
    if key == "pi" and value in ([[]], [[[1]]]):
        data[key] = value
        return data, "pi[0]: wanted an array of 3"
    data[key] = value
    return data, f"{key}: wanted"


def _spoil_element(data, rng):
    value = _bad_value(rng, "element")
    key = str(rng.choice(["q'", "p0", "pi"]))
    if key == "pi":
        i = int(rng.integers(len(data["pi"])))
        data["pi"][i][int(rng.integers(3))] = value
        return data, f"pi[{i}]: wanted"
    data[key][int(rng.integers(3))] = value
    return data, f"{key}: wanted"


def _wrong_count(data, rng):
    key = str(rng.choice(["q'", "p0", "pi"]))
    if key == "pi" and rng.random() < 0.3:
        data["pi"] = []
        return data, "pi: wanted a non-empty array"
    name, triple = (key, data[key]) if key != "pi" else ("pi[0]", data["pi"][0])
    triple[:] = triple[: int(rng.integers(3))] if rng.random() < 0.5 else [*triple, 1.0]
    return data, f"{name}: wanted an array of 3"


def _not_positive(data, rng):
    key = str(rng.choice(["L1", "L2", "q'"]))
    value = [0, 0.0, -0.0, -1, -1e300, -5e-324][rng.integers(6)]
    if key == "q'":
        data[key][int(rng.integers(3))] = value
    else:
        data[key] = value
    return data, f"{key}: wanted"


def _missing(data, rng):
    gone = [str(key) for key in rng.choice(SOME, size=rng.integers(1, 8), replace=False)]
    gone.sort(key=["L1", "L2", "T", "q'", "p0", "pi", "task"].index)
    return {
        key: value for key, value in data.items() if key not in gone
    }, f"missing: {', '.join(gone)}"


def _out_of_reach(data, rng):
    i = int(rng.integers(len(data["pi"]) + 1))
    point = data["p0"] if i == 0 else data["pi"][i - 1]
    kind = rng.integers(3)
    if kind == 0:
        point[:] = [
            float(x) for x in rng.choice([-1, 1], 3) * rng.choice([1e2, 1e20, 1e154, 1e308])
        ]
        point[2] = abs(point[2])
        return data, f"point {i} = {f'pi[{i - 1}]' if i else 'p0'} {_shown(point)} is too far"
    if kind == 1:
        point[2] = -float(10.0 ** rng.uniform(-8, 300))
        return (
            data,
            f"point {i} = {f'pi[{i - 1}]' if i else 'p0'} {_shown(point)} is under the floor",
        )
    data["L1"], data["L2"] = (5, 3) if rng.random() < 0.5 else (3, 5)
    point[:] = [0.1, -0.2, 0.3]
    return (
        data,
        f"point {i} = {f'pi[{i - 1}]' if i else 'p0'} (0.1, -0.2, 0.3) is too close to the origin",
    )


def _truncated(data, rng):
    text = json.dumps(data).encode()
    cut = int(rng.integers(len(text)))
    return text[:cut], "is not JSON: " if cut else "is empty"


def _not_utf8(data, rng):
    text = bytearray(json.dumps(data).encode())
    text[int(rng.integers(len(text)))] = int(rng.integers(0x80, 0x100))
    return bytes(text), "is not UTF-8: byte 0x"


def _huge_time(data, rng):
    data["T"] = [1e300, 10**300, 1.7976931348623157e308][rng.integers(3)]
    return data, f"({len(data['pi'])} of {len(data['pi'])})"  # all points are visited


def _shown(point):
    return f"({', '.join(f'{x:.12g}' for x in point)})"


# For each kind: a function that returns the content (a dict, bytes, or None for a folder) and text
# that the reason contains (None for a good task).
MUTATIONS = {
    "good": lambda data, rng: (data, None),
    "good with more keys": lambda data, rng: (data | {"q": [], "note": [[["x"]]]}, None),
    "good with a mark": lambda data, rng: (
        b"\xef\xbb\xbf" + json.dumps(data, indent=3).encode(),
        None,
    ),
    "good huge time": _huge_time,
    "missing keys": _missing,
    "wrong value": _spoil_key,
    "wrong element": _spoil_element,
    "wrong count": _wrong_count,
    "not positive": _not_positive,
    "negative time": lambda data, rng: (data | {"T": -float(rng.uniform(1e-9, 1e9))}, "T: wanted"),
    "out of reach": _out_of_reach,
    "truncated": _truncated,
    "not UTF-8": _not_utf8,
    "UTF-16": lambda data, rng: (json.dumps(data).encode("utf-16"), "is not UTF-8"),
    "noise": lambda data, rng: (b"\x93" + rng.bytes(int(rng.integers(500))), "is not UTF-8"),
    "empty": lambda data, rng: (b" \n" * int(rng.integers(3)), "is empty"),
    "folder": lambda data, rng: (None, "is not a file but a folder"),
    "other top": lambda data, rng: (
        json.dumps([[data], 5, None, "task", True][rng.integers(5)]).encode(),
        "wanted an object with the keys L1, L2, T, q', p0, pi, task",
    ),
    "deeply nested": lambda data, rng: (
        b'{"pi": ' + b"[" * int(rng.integers(30_000, 60_000)),
        "nested too deeply",
    ),
    "long number": lambda data, rng: (
        json.dumps(data).encode()[:-1] + b', "T": ' + b"7" * 5000 + b"}",
        "not JSON: a number with thousands of digits",
    ),
}


def test_mutated_files_are_reported_with_a_reason(tmp_path):
    count = int(os.environ.get("ROBOKIN_MUTANTS", 300))
    tasks = tmp_path / "tasks"
    wanted = list(mutants(tasks, count))
    before = snapshot(tasks)
    run = command("tasks", cwd=tmp_path)
    assert snapshot(tasks) == before, "an input was changed"
    assert run.returncode == 1
    reports = re.split(r"^(?=INFO: |ERROR: )", run.out, flags=re.M)[1:]
    assert len(reports) == count + 1
    bad = 0
    for text, (name, words, (case, kind)) in zip(reports, wanted, strict=False):
        title = f"Task {name}"
        if words is None or "good" in name:
            key = "collect" if kind == "collect" else "visit_greedy"
            verb = "collected" if kind == "collect" else "visited"
            n = len(case["pi"])
            served = range(n) if words else case[key]["indices"]
            if not served:
                assert text.startswith(
                    f"INFO: {title}: could not {kind} any points, not enough time"
                )
                continue
            match = re.match(
                rf"INFO: {re.escape(title)}: {verb} (\d+) of {n} points in (\S+) s ", text
            )
            assert match and int(match[1]) == len(served), text
            if not words:
                assert float(match[2]) == pytest.approx(case[key]["time"], rel=1e-12)
                assert [int(i) for i in re.findall(r"^\t(\d+) \(", text, re.M)] == served
        else:
            bad += 1
            assert text.startswith(f"ERROR: {title} skipped:\n\t") and words in text, (words, text)
    assert reports[-1].strip() == f"INFO: {count} files: {count - bad} solved, {bad} skipped"
    assert 0.1 * count < bad < 0.95 * count
    assert f"{count // 100 * 100 - 100 * (count % 100 == 0)} of {count} files" in run.err, (
        "the progress is not reported"
    )
    kept = [
        line
        for line in (tmp_path / "output.log").read_text(encoding="utf-8").splitlines()
        if not line.startswith("DEBUG: ")
    ]
    assert kept == run.out.splitlines()


def snapshot(folder):
    return {
        path.name: (path.stat().st_mtime_ns, path.read_bytes() if path.is_file() else None)
        for path in folder.iterdir()
    }


if __name__ == "__main__":
    print(sum(1 for _ in mutants(sys.argv[2], int(sys.argv[1]))), "files in", sys.argv[2])
