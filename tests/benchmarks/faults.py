"""Do the tests detect faults in pages and in the course? The script inserts the hundred faults of
`faults.toml` into a copy of the repository, one at a time, and runs the tests that are likely to
detect the fault until one of them fails. (`mutants.py` does this for the rest of the package.)

    python tests/benchmarks/faults.py --results before.jsonl          an hour or so
    python tests/benchmarks/faults.py --repo ../other --after before.jsonl

White space, a comma before a closing bracket and parentheses around a single arrow parameter are
ignored in `old`, so that faults survive a formatter. A test that has failed runs again without the
fault and must pass; a fault whose run takes too long counts as detected. `--after` begins with the
test that detected the fault last time, even if the test has moved. The exit status is 1 if a fault
was not detected.
"""

import argparse
import contextlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

HERE, KEYS, SECONDS = Path(__file__).resolve().parent, ("file", "old", "new"), 300
NBVAL = ["--nbval", "--nbval-current-env", "--nbval-sanitize-with=tests/nbval_sanitize.cfg"]
# pytest with a plugin that records which test has failed
RUN = """import sys, pytest
class Watch:
    def pytest_runtest_logreport(self, report):
        if report.failed:
            with open(sys.argv[1], "a") as file: print(report.nodeid, file=file)
    pytest_collectreport = pytest_runtest_logreport
sys.exit(pytest.main(sys.argv[2:], plugins=[Watch()]))"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="only faults whose file or text contains this")
    parser.add_argument(
        "--check", action="store_true", help="only check whether each fault can be inserted"
    )
    parser.add_argument("--repo", type=Path, default=HERE.parents[1], help="the repository to test")
    parser.add_argument(
        "--results", type=Path, default=os.devnull, help="write a line for each fault to this file"
    )
    parser.add_argument("--after", type=Path, help="the results of an earlier run")
    given = parser.parse_args()
    faults = tomllib.loads((HERE / "faults.toml").read_text(encoding="utf-8"))["fault"]
    faults = [f for f in faults if given.only in f"{f['file']} {f['old']} {f['new']}"]
    if given.after:
        before = map(json.loads, given.after.read_text(encoding="utf-8").splitlines())
        first = {tuple(b[key] for key in KEYS): b["test"] for b in before if b["noticed"]}
        known = {tuple(f[key] for key in KEYS): f for f in faults}
        faults = [known[key] | {"first": [first[key]]} for key in known if key in first]
    slipped = 0
    with tempfile.TemporaryDirectory(prefix="robokin-faults-") as folder:
        sound, faulted = Path(folder, "sound"), Path(folder, "faulted")
        tracked = subprocess.check_output(["git", "ls-files", "-z"], cwd=given.repo, text=True)
        for name in filter(None, tracked.split("\0")):
            if (given.repo / name).is_file():
                (sound / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(given.repo / name, sound / name)
        for number, fault in enumerate(faults, 1):
            since, text = time.monotonic(), with_fault(sound, fault)
            noticed, test, how = bool(text), None, "is there" if text else "is not there"
            if text and not given.check:
                shutil.copytree(sound, faulted)
                (faulted / fault["file"]).write_text(text, encoding="utf-8")
                noticed, test, how = hunt(given.repo, sound, faulted, fault)
                shutil.rmtree(faulted, ignore_errors=True)
            slipped += not noticed
            told = {"noticed": noticed, "test": test, "how": how}
            told |= {"seconds": round(time.monotonic() - since, 1), **{k: fault[k] for k in KEYS}}
            print(f"{number}/{len(faults)}", *told.values(), sep=" | ", flush=True)
            with given.results.open("a", encoding="utf-8") as file:
                print(json.dumps(told, ensure_ascii=False), file=file)
    print(f"{len(faults) - slipped} of {len(faults)} detected")
    return 1 if slipped else 0


def with_fault(sound, fault):
    """The text of the file with the fault; None if the old text does not occur exactly once."""
    old = re.sub(r"\((\w+)\)=>", r"\1=>", re.sub(r"\s", "", fault["old"]))
    parts = []
    for piece in re.findall(r"\w+=>|.", re.sub(r",(?=[)\]}])", "", old)):
        name = re.fullmatch(r"(\w+)=>", piece)
        part = rf"\(?\s*{name[1]}\s*\)?\s*=\s*>" if name else re.escape(piece)
        parts.append(rf"(?:,\s*)?{part}" if piece in ")]}" else part)
    file = sound / fault["file"]
    text = file.read_text(encoding="utf-8") if file.is_file() else ""
    found = [place.span() for place in re.finditer(r"\s*".join(parts), text)]
    if len(found) != 1:
        return None
    return text[: found[0][0]] + fault["new"].strip() + text[found[0][1] :]


def hunt(repo, sound, faulted, fault):
    """Return whether a test detects the fault, which test, and how it failed."""
    answer = False, None, "no test has failed"
    for names in (fault.get("first", ()), fault["tests"]):
        tests, left_out = [test for name in names for test in where(repo, name)], []
        for _ in range(5 if tests else 0):
            test, how = run(faulted, tests, left_out)
            if test is None:
                break
            # A cell needs the cells before it. For a file that could not be collected, only the
            # collection is repeated.
            again = test.partition("::")[0] if ".ipynb" in test else test
            if how != "failed" or not run(sound, [again], ["--co"] * ("::" not in test))[0]:
                return True, test, how
            answer = False, test, "fails without a fault"
            left_out += ["--deselect", test]
    return answer


def where(repo, test):
    """The paths of a test in this repository, even if its function has moved to another file."""
    file, _, name = test.partition("::")
    if file.endswith(".ipynb") or not name:
        return [file] if (repo / file).exists() else []
    command = ["git", "grep", "-l", f"def {name.split('[')[0]}(", "--", "tests"]
    files = subprocess.run(command, cwd=repo, capture_output=True, text=True).stdout.split()
    return [f"{each}::{name}" for each in ([file] if file in files else files)]


def run(place, tests, options):
    """Return the first test that fails, or None, and how it failed."""
    with tempfile.TemporaryDirectory(prefix="robokin-run-") as folder:
        notes = Path(folder, "notes")
        command = [sys.executable, "-c", RUN, notes, "-x", "-q", "--tb=no", "-o", "addopts="]
        command += ["-p", "no:cacheprovider", f"--basetemp={folder}/tmp", *options, *tests]
        command += NBVAL * any(".ipynb" in test for test in tests)
        quiet = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.DEVNULL)
        quiet["env"] = {**os.environ, "PYTHONPATH": str(place), "PYTEST_ADDOPTS": ""}
        with subprocess.Popen(command, cwd=place, start_new_session=True, **quiet) as process:
            try:
                status = process.wait(SECONDS)
            except subprocess.TimeoutExpired:
                return tests[0], f"took longer than {SECONDS} s"
            finally:
                with contextlib.suppress(ProcessLookupError):  # ends its child processes, too
                    os.killpg(process.pid, signal.SIGKILL)
        failed = notes.read_text().splitlines() if notes.exists() else []
    if status == 4 and any("[" in test for test in tests):  # the test has other parameters here
        return run(place, [test.partition("[")[0] for test in tests], options)
    if failed or status in (0, 5):
        return (failed or [None])[0], "failed"
    return tests[0].partition("::")[0], "failed"  # nothing could be collected


if __name__ == "__main__":
    sys.exit(main())
