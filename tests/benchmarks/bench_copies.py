"""Test whether copies lose anything, and measure how long they take.

    python tests/benchmarks/bench_copies.py --histories 500 --kills 60 --saves 60

The histories are those of tests/test_copies.py. Then the script copies the real labs: into an empty
folder, again without changes, and again with a newer version of every lab. Then it kills a process
that copies newer labs (SIGKILL) at a random moment, and lets one process copy labs while another
saves a lab as JupyterLab does. After each of these, the student's files must be unchanged, every
notebook must be valid, and the next copy must finish. Aims: nothing lost, and a copy of all labs
within two seconds. POSIX only.
"""

import argparse
import json
import multiprocessing
import os
import random
import shutil
import sys
import tempfile
import time
from pathlib import Path

import nbformat
from jupyter_server.services.contents.fileio import atomic_writing

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from test_copies import History

from robokin.course.copies import copy

LABS = ROOT / "notebooks"
TOUCHED, SAVED = "03_irb140_motion.ipynb", "08_visit_and_collect.ipynb"
Process = multiprocessing.get_context("fork").Process


def edited(path, text):
    """The notebook with one more cell, as text."""
    data = json.loads(path.read_text(encoding="utf-8"))
    cell = {"cell_type": "markdown", "id": f"x{random.getrandbits(40)}", "metadata": {}}
    data["cells"].append(cell | {"source": [text]})
    return json.dumps(data, indent=1)


def newer(labs, word):
    for path in labs.rglob("*.ipynb"):
        original = LABS / path.relative_to(labs)
        path.write_text(edited(original, f"lab {word}"), encoding="utf-8")


def histories(count, steps):
    lost = 0
    for seed in range(1000, 1000 + count):
        with tempfile.TemporaryDirectory() as top:
            try:
                History(seed, Path(top)).run(steps)
            except AssertionError as error:
                lost += 1
                print(f"history {seed}: {error}")
    print(f"{count} histories of {steps} steps: {lost} failed")


def times(labs, folder):
    for what in ("into an empty folder", "without changes", "every lab newer"):
        if "newer" in what:
            newer(labs, "newer")
        start = time.perf_counter()
        copy(folder, labs)
        print(f"the labs {what}: {time.perf_counter() - start:.2f} s")


def whole(folder):
    """Assert that every notebook in the student's folder is valid."""
    for path in folder.rglob("*.ipynb"):
        if ".robokin" not in path.parts:
            nbformat.validate(nbformat.read(path, as_version=4))


def finished(labs, folder):
    """Assert that the next copy finishes and brings every unchanged lab up to date."""
    copy(folder, labs)
    whole(folder)
    for path in labs.rglob("*.ipynb"):
        place = folder / path.relative_to(labs)
        if place.name in (TOUCHED, SAVED):
            place = sorted(place.parent.glob(f"{place.stem}*.ipynb"))[-1]
        if place.name not in (TOUCHED, SAVED, "teaching.ipynb"):
            assert json.loads(place.read_bytes())["cells"] == json.loads(path.read_bytes())["cells"]
    rest = sorted(p.name for p in (folder / ".robokin").rglob("*") if p.is_file())
    assert rest == ["lock", "manifest.json"], rest


def kills(labs, folder, count):
    mine = edited(folder / TOUCHED, "mine").encode()
    (folder / TOUCHED).write_bytes(mine)
    newer(labs, "measured")
    start = time.perf_counter()
    copy(folder, labs)
    span, met = time.perf_counter() - start, 0
    for k in range(count):
        newer(labs, f"kill {k}")
        process = Process(target=copy, args=(folder, labs))
        process.start()
        time.sleep(random.uniform(0, 1.1 * span))
        process.kill()
        process.join()
        met += process.exitcode != 0
        assert (folder / TOUCHED).read_bytes() == mine
        whole(folder)
        if random.random() < 0.7:  # otherwise the next process is killed, too
            finished(labs, folder)
            assert (folder / TOUCHED).read_bytes() == mine
    finished(labs, folder)
    print(f"{count} processes, of which {met} were killed while copying: nothing lost")


def save_for_a_while(path, seconds):
    """Save repeatedly as JupyterLab does; keep the last version next to the file."""
    end, k = time.monotonic() + seconds, 0
    try:
        text = edited(path, "COUNT")
    except FileNotFoundError:
        return  # the lab was being replaced at that moment
    while time.monotonic() < end:
        k += 1
        with atomic_writing(str(path)) as file:
            file.write(text.replace("COUNT", f"mine {k}"))
    Path(f"{path}.last").write_text(text.replace("COUNT", f"mine {k}"), encoding="utf-8")


def saves(labs, folder, count):
    moved = 0
    for k in range(count):
        for side in folder.glob(f"{Path(SAVED).stem}*.ipynb"):
            side.unlink()
        newer(labs, f"before save {k}")
        copy(folder, labs)
        newer(labs, f"save {k}")
        copying = Process(target=copy, args=(folder, labs))
        start = time.perf_counter()
        copying.start()
        while not (folder / ".robokin" / "new").exists() and copying.is_alive():
            time.sleep(0.001)  # until the copy begins to write
        time.sleep(random.uniform(0, 0.1))
        saving = Process(target=save_for_a_while, args=(folder / SAVED, 0.3))
        saving.start()
        copying.join()
        span = time.perf_counter() - start
        saving.join()
        last = folder / f"{SAVED}.last"
        if last.exists():  # the saving process has saved a lab
            seen = [p.read_bytes() for p in folder.glob("*.ipynb")]
            assert last.read_bytes() in seen, "the last save is lost"
            moved += (folder / SAVED).read_bytes() != last.read_bytes()
            last.unlink()
        finished(labs, folder)
    print(f"{count} copies ({span:.1f} s) during saves: nothing lost, {moved} versions moved aside")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name, count in (("histories", 500), ("steps", 25), ("kills", 60), ("saves", 60)):
        parser.add_argument(f"--{name}", type=int, default=count)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as top:
        os.environ["JUPYTER_DATA_DIR"] = os.environ["JUPYTER_CONFIG_DIR"] = f"{top}/jupyter"
        histories(given.histories, given.steps)
        labs, folder = Path(top, "labs"), Path(top, "student")
        shutil.copytree(LABS, labs, ignore=shutil.ignore_patterns(".*"))
        times(labs, folder)
        kills(labs, folder, given.kills)
        saves(labs, folder, given.saves)


if __name__ == "__main__":
    main()
