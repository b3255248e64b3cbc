"""`python -m robokin.course copy`: labs are handed out repeatedly without losing work.

A history is a possible sequence of events in a student's folder: edits, runs, other files, newer
labs, and copies that are interrupted at any write or coincide with a save. `History` records
independently what the student wrote and what the labs contain, and checks both after every step.
"""

import builtins
import contextlib
import json
import os
import platform
import random
import re
import shutil
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from unittest import mock

import nbformat
import pytest
from conftest import NOTEBOOKS, awake, until
from nbformat.sign import MemorySignatureStore, NotebookNotary

from robokin.course import copies
from robokin.course.__main__ import main
from robokin.course.copies import copy

TWO = "two [\u00fc].ipynb"
WRITES = ("fsync", "link", "makedirs", "rename", "replace", "unlink")


@pytest.fixture(autouse=True)
def _own_trust(tmp_path, monkeypatch):
    """Keep the signatures of these tests out of the developer's own trust database."""
    monkeypatch.setenv("JUPYTER_DATA_DIR", str(tmp_path / "jupyter"))
    monkeypatch.setenv("JUPYTER_CONFIG_DIR", str(tmp_path / "jupyter"))


# --- Making and reading small labs ----------------------------------------------------------------


def notebook(text, shown="still"):
    """A small lab that contains `text`; `shown` is the output of its player."""
    html = {"text/html": [f"<script>{shown}</script>"], "text/plain": ["player"]}
    output = {"output_type": "display_data", "data": html, "metadata": {}}
    cells = [
        {
            "cell_type": "markdown",
            "id": "a",
            "metadata": {},
            "source": [f"# {text}\n", "![x](attachment:x.png)"],
            "attachments": {"x.png": {"image/png": "eHk="}},
        },
        {
            "cell_type": "code",
            "id": "b",
            "metadata": {},
            "source": ["1 + 1"],
            "execution_count": 1,
            "outputs": [output],
        },
    ]
    info = {"name": "python", "version": "3.0.0"}
    metadata = {"language_info": info, "kernelspec": {"name": "python3", "display_name": "Python"}}
    return {"cells": cells, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5}


def written(data):
    return (json.dumps(data, indent=1) + "\n").encode()


def cells(content):
    """The type and text of each cell, or None if the bytes are not a notebook."""
    try:
        return [(c["cell_type"], "".join(c["source"])) for c in json.loads(content)["cells"]]
    except (ValueError, KeyError, TypeError):
        return None


def said(path, content):
    """The content of a file that must be preserved: its cells, or its bytes."""
    return (path.endswith(".ipynb") and str(cells(content))) or content


def trusted(path, notary=NotebookNotary):
    return notary().check_signature(nbformat.read(path, as_version=4))


def laid(content):
    """A lab as it should be in a student's folder."""
    data = json.loads(content)
    data["metadata"]["language_info"]["version"] = platform.python_version()
    return data


# --- Simulated faults in file operations ----------------------------------------------------------


class Writes:
    """Replaces `os` and `open` in `copies`, counts file operations, and raises `error` at
    operation number `end`: before or after the operation takes effect, or in the middle of
    a write. With `dead`, all later operations fail, too, as in a killed process. `at` maps a number
    to an action just before that operation. With a path `near`, the count begins when this path is
    moved or written.
    """

    def __init__(self, end=None, after=False, dead=False, error=KeyboardInterrupt):
        self.count, self.end, self.after, self.dead = 0, end, after, dead
        self.error, self.at, self.near = error, {}, None

    def __getattr__(self, name):
        if name == "fsync":
            return lambda _: self.step(lambda: None)  # a real fsync is slow
        value = getattr(os, name)
        return (lambda *a, **k: self.step(lambda: value(*a, **k), *a)) if name in WRITES else value

    def step(self, act, *names, half=lambda: None):
        if self.near is not None and not self.count and self.near not in names:
            return act()
        self.count += 1
        self.at.get(self.count, lambda: None)()
        gone = self.end is not None and self.dead and self.count > self.end
        if gone or (self.count == self.end and not self.after):
            if not gone:
                half()
            raise self.error
        result = act()
        if self.count == self.end:
            raise self.error
        return result

    @contextlib.contextmanager
    def open(self, path, mode):
        def opened():
            return self.stack.enter_context(builtins.open(path, mode))

        with self.step(opened) as file:
            write = file.write

            class Stepped:
                flush, fileno = file.flush, file.fileno

                @staticmethod
                def write(content):
                    def half():
                        write(content[: len(content) // 2])
                        file.flush()

                    self.step(lambda: write(content), half=half)

            yield file if "a" in mode else Stepped

    def __enter__(self):
        self.stack = contextlib.ExitStack()
        self.stack.enter_context(mock.patch.object(copies, "os", self))
        self.stack.enter_context(mock.patch.object(copies, "open", self.open, create=True))
        return self

    def __exit__(self, *_):
        self.stack.close()


# --- Histories of a student's folder --------------------------------------------------------------


class History:
    """A source of labs, a student's folder, and the laws that must hold.

    mine       [path, bytes] that the student wrote and has not changed or deleted since; the path
               is None while only the next copy can restore it (after a save during a killed copy)
    untouched  paths of labs that the student has not changed, whether run or not
    offered    for each lab, the content that was last handed out; several if a copy was interrupted
    outputs    for each lab, the bytes that were last handed out, if they are known for certain
    links      for each link of the student, its target
    """

    def __init__(self, seed, top):
        self.random = random.Random(seed)
        self.source, self.folder = top / "labs", top / "student"
        self.number = 0
        self.mine, self.untouched, self.offered, self.before = [], set(), {}, {}
        self.links, self.versions, self.valid, self.outputs = {}, {}, set(), {}
        store = MemorySignatureStore()  # SQLite is slow
        self.notary = partial(NotebookNotary, store_factory=lambda: store, secret=b"secret")
        for name in ("one.ipynb", TWO, "documents/three.ipynb", "tasks/task.json"):
            self._lab(name)
        (self.source / "notes.txt").write_text("not handed out")
        (self.source / "documents" / ".hidden.ipynb").write_text("not handed out")

    def run(self, steps):
        with mock.patch.object(nbformat.sign, "NotebookNotary", self.notary):
            self._run(steps)

    def _run(self, steps):
        self.copies()
        for _ in range(steps):
            act = self.random.choice(ACTS)
            act(self)
            self.look()
        self.copies()
        before = self.files(hidden=True)
        assert not [o for o in copy(self.folder, self.source) if o.what in ("new", "replaced")]
        assert self.files(hidden=True) == before, "a copy without newer labs changed something"

    # Teacher actions

    def newer(self):
        self._lab(self.random.choice(self.labs()))

    def older(self):
        path = self.random.choice(self.labs())
        self._write(self.source / path, self.random.choice(self.versions[path]))

    def other_outputs(self):
        path = self.random.choice([p for p in self.labs() if p.endswith(".ipynb")])
        data = json.loads((self.source / path).read_bytes())
        data["cells"][1]["outputs"][0]["data"]["text/html"] = [self.token()]
        self._write(self.source / path, written(data))

    def added(self):
        self._lab(self.random.choice(["four.ipynb", "documents/five.ipynb", "tasks/six.json"]))

    def removed(self):
        if len(self.labs()) > 2:
            path = self.random.choice([p for p in self.labs() if p != "one.ipynb"])
            (self.source / path).unlink()

    def renamed(self):
        path = self.random.choice([p for p in self.labs() if p != "one.ipynb"] or [None])
        if path:
            new = Path(path).with_name(f"{self.random.choice('xyz')}{Path(path).suffix}").as_posix()
            self.versions.setdefault(new, []).append((self.source / path).read_bytes())
            os.replace(self.source / path, self.source / new)

    # Student actions

    def edit(self):
        path = self._pick(".ipynb")
        if path:
            self.before[path] = (self._read(path), path in self.untouched)
            self.save(path, self._edited(self._read(path)))

    def reorder(self):
        path = self._pick(".ipynb")
        if path in self.untouched:
            data = json.loads(self._read(path))
            data["cells"].reverse()
            self.save(path, written(data))

    def edit_task(self):
        path = self._pick(".json")
        if path:
            self.save(path, json.dumps({"task": self.token()}).encode())

    def undo(self):
        path = self.random.choice([p for p in self.before if self._plain(p)] or [None])
        if path:
            content, untouched = self.before.pop(path)
            self.save(path, content, ours=untouched)

    def rerun(self):
        path = self._pick(".ipynb")
        if path:
            self.save(path, self._rerun(self._read(path)), ours=path in self.untouched)

    def delete(self):
        path = self._pick("")
        if path:
            (self.folder / path).unlink()
            self._forget(path)

    def move_away(self):
        path = self._pick("")
        if path:
            content = self._read(path)
            self.delete_at(path)
            self.save(f"my {self.token()}{Path(path).suffix}", content)

    def duplicate(self):
        path = self._pick("")
        if path:
            self.save(f"my {self.token()}{Path(path).suffix}", self._read(path))

    def accept(self):
        """The student replaces a lab with the newer one next to it."""
        path = self._pick(".new.ipynb")
        place = path and path.replace(".new.", ".")
        if path and self._plain(place):
            self.save(place, self._read(path), ours=path in self.untouched)

    def own(self):
        names = ["my notes.txt", "my lab.ipynb", TWO, "four.ipynb", "one.new.ipynb", "x.json"]
        path = self.random.choice(names)
        if not os.path.lexists(self.folder / path) or self._plain(path):
            data = notebook(self.token()) if path.endswith(".ipynb") else self.token()
            self.save(path, written(data))

    def corrupt(self):
        path = self._pick(".ipynb")
        if path:
            content = self._read(path)
            self.save(path, content[: self.random.randrange(len(content) - 3)] + b" ")

    def folder_or_link(self):
        """The student puts a folder or a link where a lab was or will be."""
        path = self.random.choice([TWO, "four.ipynb", "documents/three.ipynb"])
        place = self.folder / path
        if place.is_dir() or place.is_symlink() or not self._folder_there(path):
            return
        moved = self._read(path) if self._plain(path) else None
        self.delete_at(path)
        if self.random.random() < 0.5:
            place.mkdir()
            self.save(f"{path}/my.txt", self.token().encode())
        else:
            target = f"my {self.token()}.ipynb"
            self.save(target, moved or written(notebook(self.token())))
            place.symlink_to(self.folder / target)
            self.links[path] = str(self.folder / target)

    def folder_elsewhere(self):
        """The student moves a folder of labs and puts a link in its place."""
        place, other = self.folder / "documents", self.folder / "elsewhere"
        if "documents" in self.links or os.path.lexists(other) or not place.is_dir():
            return
        for path, link in [(p, self.links.pop(p)) for p in list(self.links) if "documents" in p]:
            self.links[path.replace("documents", "elsewhere")] = link
        for each in self.mine:
            each[0] = each[0] and re.sub("^documents/", "elsewhere/", each[0])
        for path in [p for p in self.untouched if p.startswith("documents/")]:
            if self._plain(path):
                self.mine.append([path.replace("documents", "elsewhere"), self._read(path)])
            self._forget(path)
        place.rename(other)
        place.symlink_to(other)
        self.links["documents"] = str(other)

    def save(self, path, content, ours=False):
        """Save the student's file as JupyterLab does: by writing into the existing file."""
        self._write(self.folder / path, content)
        self._forget(path)
        if ours:
            self.untouched.add(path)
        else:
            self.mine.append([path, content])

    def delete_at(self, path):
        if self._plain(path):
            (self.folder / path).unlink()
        self._forget(path)

    # Copies

    def copies(self):
        """Make an undisturbed copy, and check the laws that must hold after it."""
        before, laid_before = self.files(), {p: self.offered.get(p, {None}) for p in self.labs()}
        outcomes = copy(self.folder, self.source)
        assert not [o for o in outcomes if o.what == "failed"], outcomes
        after = self.files()
        inside = [p for p in self.files(hidden=True) if p.startswith(".robokin/")]
        assert sorted(inside) == [".robokin/lock", ".robokin/manifest.json"]
        self.look()
        assert not [m for m in self.mine if m[0] is None], "a saved file was not restored"
        assert all(os.lstat(self.folder / p).st_nlink == 1 for p in after), "a file has two names"
        mine = [m[0] for m in self.mine]
        for path in self.labs():
            newest = (self.source / path).read_bytes()
            says = said(path, newest)
            if (self.folder / path).parent.is_symlink():
                continue
            newer = says not in laid_before[path]
            same = laid_before[path] == {says}
            here = after.get(path)
            sides = self._sides(path, after)
            if path in self.untouched:  # even if an interrupted copy has moved it
                assert here and said(path, here) == says, (
                    f"{path}: the student did not change it, but it is not the newest version"
                )
                if self.outputs.get(path) not in (None, newest):
                    assert path.endswith(".json") or json.loads(here) == laid(newest)
            elif path in mine or self._strange(path):
                beside = [said(path, after[side]) for side in sides]
                assert says in beside or not newer, f"{path}: there is no newer lab next to it"
            elif not os.path.lexists(self.folder / path):
                assert not newer and path not in before, f"{path} was not restored"
            elif path not in before:
                assert not same, f"{path} was deleted, but the same version was restored"
                if said(path, here) == says:
                    self.untouched.add(path)
                else:  # restored after a killed copy; the student has since deleted the file
                    assert "unsure" in laid_before[path] and b"student" in here
                    self.mine.append([path, here])
            for side in sides:
                if side not in mine:
                    self.untouched.add(side)
                    assert said(path, after[side]) == says, f"{side} is not the newest version"
            self.offered[path], self.outputs[path] = {says}, newest
        for outcome in outcomes:
            assert outcome.says or outcome.what == "same"
            if outcome.what in ("new", "replaced") and outcome.path.endswith(".ipynb"):
                path = outcome.path.replace(".new.", ".").replace(".new2.", ".")
                assert trusted(self.folder / outcome.path, self.notary)
                assert json.loads(after[outcome.path]) == laid((self.source / path).read_bytes())
            if outcome.what == "gone":
                assert outcome.path not in self.labs()
                assert os.path.lexists(self.folder / outcome.path)
        for path, content in self.mine:
            if path.endswith(".ipynb") and b"student" in content and cells(content):
                assert not trusted(self.folder / path, self.notary), (
                    f"{path} is the student's work, but was signed"
                )

    def interrupted(self):
        """Make a copy that stops at some operation."""
        if self.random.random() < 0.5:
            self.newer()
        error = self.random.choice([KeyboardInterrupt, OSError(28, "No space left on device")])
        with self._writes(25, error), contextlib.suppress(KeyboardInterrupt, OSError):
            copy(self.folder, self.source)
        self._unsure()

    def meets_a_save(self):
        """Make a copy while the student saves the file that the copy is about to replace. The
        student writes into the file, replaces it with a new one, or writes it in two halves, once
        or twice. Sometimes the copy is also killed.
        """
        mine = [m[0] for m in self.mine]
        path = self.random.choice([p for p in self.labs() if p not in mine] or [None])
        place = path and self.folder / path
        if not path or self._strange(path) or place.parent.is_symlink():
            return
        self._lab(path)
        before = self._read(path) if self._plain(path) else (self.source / path).read_bytes()
        contents = [self._edited(before), self._edited(before)]
        saved, halves = [], []

        def save(how):
            content = contents.pop()
            if not os.path.lexists(place) and saved:
                self.mine.append([None, saved.pop()])  # the copy, not the student, has moved it
            if self._plain(path):
                self.mine = [m for m in self.mine if m[1] != place.read_bytes()]
            place.parent.mkdir(exist_ok=True)
            if how == "beside":
                (self.folder / "my part").write_bytes(content)
                os.replace(self.folder / "my part", place)
            elif how == "into":
                place.write_bytes(content)
            else:
                halves.append(open(place, "wb"))
                halves[0].write(content[:200])
                halves[0].flush()
                halves.append(content[200:])
            saved[:] = [content]

        def rest():
            if halves:
                with halves[0] as file:
                    file.write(halves[1])
                halves.clear()

        writes = self._writes(6, KeyboardInterrupt, dead=True, never=0.6)
        writes.near = place
        first, second = sorted(self.random.sample(range(1, 5), 2))
        how = self.random.choice(["into", "beside", "halves"])
        writes.at[first] = lambda: save(how)
        writes.at[second] = rest if how == "halves" else lambda: None
        if how != "halves" and self.random.random() < 0.5:
            writes.at[second] = lambda: save("into")
        with writes, contextlib.suppress(KeyboardInterrupt):
            copy(self.folder, self.source)
        rest()
        if saved:
            self._forget(path)
            here = self._plain(path) and self._read(path) == saved[0]
            assert here or writes.end, f"{path}: the file that the student saved was moved"
            self.mine.append([path if here else None, saved[0]])
        self._unsure()

    def _writes(self, last, error, dead=None, never=0.0):
        end = None if self.random.random() < never else self.random.randint(1, last)
        dead = self.random.random() < 0.5 if dead is None else dead
        return Writes(end, self.random.random() < 0.5, dead, error)

    def _unsure(self):
        """Record that a disturbed copy may have handed out any lab, or none."""
        files = self.files()
        for path in self.labs():
            says = said(path, (self.source / path).read_bytes())
            self.offered[path] = {*self.offered.get(path, ()), says, "unsure"}
            self.outputs.pop(path, None)
            for place in (path, *self._sides(path, files)):
                mine = any(m[0] == place for m in self.mine)
                if self._plain(place) and not mine and said(path, files[place]) == says:
                    self.untouched.add(place)

    # Invariants

    def look(self):
        """Assert that none of the student's work is lost and that no valid notebook is broken."""
        files = self.files(hidden=True)
        for each in self.mine:
            path, content = each
            if path is None:
                where = [p for p in files if files[p] == content]
                assert where, "a saved file is lost"
                each[0] = next((p for p in where if not p.startswith(".robokin")), None)
            else:
                assert files.get(path) == content, f"{path} is not what the student wrote"
        for path, content in files.items():
            if ".yours" in path and not path.startswith(".robokin"):
                assert content in [m[1] for m in self.mine], f"{path} is not the student's work"
                assert content != files.get(re.sub(r"\.yours\d*", "", path)), f"{path} exists twice"
        for path, target in self.links.items():
            assert os.readlink(self.folder / path) == target
        for path, content in files.items():
            mine = any(content == m[1] for m in self.mine)
            hidden = path.startswith(".robokin") or content in self.valid
            if path.endswith(".ipynb") and not mine and not hidden:
                nbformat.validate(nbformat.reads(content.decode(), as_version=4))
                self.valid.add(content)

    # Helpers

    def token(self):
        self.number += 1
        return f"t{self.number}"

    def labs(self):
        found = [*self.source.glob("*.ipynb"), *self.source.glob("documents/[!.]*.ipynb")]
        found += self.source.glob("tasks/*.json")
        return sorted(p.relative_to(self.source).as_posix() for p in found)

    def files(self, hidden=False):
        """The bytes of the student's files by path; targets of links are not counted twice."""
        found = {}
        for top, _, names in os.walk(self.folder):
            for path in (Path(top, name) for name in names):
                name = path.relative_to(self.folder).as_posix()
                if not path.is_symlink() and (hidden or not name.startswith(".robokin")):
                    found[name] = path.read_bytes()
        return found

    def _lab(self, path):
        says = f"lab {self.token()}"
        data = notebook(says) if path.endswith(".ipynb") else {"task": says}
        self._write(self.source / path, written(data))
        self.versions.setdefault(path, []).append(written(data))

    def _write(self, place, content):
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content)

    def _read(self, path):
        return (self.folder / path).read_bytes()

    def _plain(self, path):
        place = self.folder / path
        return place.is_file() and not place.is_symlink() and not place.parent.is_symlink()

    def _folder_there(self, path):
        parent = (self.folder / path).parent
        return parent.is_dir() and not parent.is_symlink()

    def _strange(self, path):
        place = self.folder / path
        return place.is_symlink() or place.is_dir()

    def _pick(self, end, labs=False):
        fits = [p for p in self.files() if p.endswith(end) and self._plain(p)]
        fits = [p for p in fits if not labs or p in self.labs()]
        return self.random.choice(sorted(fits)) if fits else None

    def _forget(self, path):
        self.mine = [m for m in self.mine if m[0] != path]
        self.untouched.discard(path)

    def _edited(self, content):
        """The notebook after the student has changed or added a cell."""
        if cells(content) is None:
            return written(notebook(f"student {self.token()}"))
        data = json.loads(content)
        how = self.random.choice(["change", "add"])
        text = f"student {self.token()}"
        if how == "change":
            data["cells"][0]["source"] = [text]
        else:
            cell = {"cell_type": "raw", "id": f"s{self.number}", "metadata": {}, "source": text}
            data["cells"].insert(self.random.randint(0, len(data["cells"])), cell)
        return written(data)

    def _rerun(self, content):
        if cells(content) is None:
            return content
        data = json.loads(content)
        data["metadata"]["widgets"] = {}
        for cell in data["cells"]:
            if cell["cell_type"] == "code":
                cell["execution_count"] = self.random.randint(1, 99)
                stream = {"output_type": "stream", "name": "stdout", "text": [self.token()]}
                cell["outputs"] = [stream]
                cell["metadata"]["run"] = True
            cell["source"] = "".join(cell["source"])
        return written(data)

    def _sides(self, path, files):
        place = Path(path)
        start, end = place.with_name(f"{place.stem}.new").as_posix(), place.suffix
        return [p for p in files if p.startswith(start) and p[len(start) :] in (end, f"2{end}")]


TEACHER = [History.newer] * 3 + [History.older, History.other_outputs]
TEACHER += [History.added, History.removed, History.renamed]
STUDENT = [History.edit] * 3 + [History.rerun] * 2 + [History.edit_task] + [History.undo] * 3
STUDENT += [
    History.reorder,
    History.delete,
    History.move_away,
    History.duplicate,
    History.accept,
    History.own,
]
STUDENT += [History.corrupt, History.folder_or_link, History.folder_elsewhere]
ACTS = TEACHER + STUDENT + [History.copies] * 3 + [History.interrupted] * 6
ACTS += [History.meets_a_save] * 4


@pytest.mark.parametrize("seed", range(50))
def test_no_sequence_of_copies_loses_work(seed, tmp_path):
    History(seed, tmp_path).run(steps=25)


@pytest.mark.parametrize("seed", range(100, 103))
def test_no_work_is_lost_on_a_file_system_without_links(seed, tmp_path, monkeypatch):
    def link(*_, **__):
        raise PermissionError(1, "Operation not permitted")

    monkeypatch.setattr(os, "link", link)
    # without links, a save between the check and the move cannot be detected
    monkeypatch.setattr(History, "meets_a_save", History.copies)
    History(seed, tmp_path).run(steps=25)


# --- Tests of single cases ------------------------------------------------------------------------


class Class:
    """Labs, and a student's folder that holds a copy of them."""

    def __init__(self, top, *names):
        self.labs, self.folder = top / "labs", top / "student"
        for name in names or ("one.ipynb", "two.ipynb", "tasks/task.json"):
            self.newer(name, "first")
        self.copy()

    def newer(self, name, says):
        place = self.labs / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(written(notebook(f"{name} {says}") if "ipynb" in name else says))

    def copy(self):
        """Copy the labs, and return the outcome by path for all files that were changed."""
        return {o.path: o.what for o in copy(self.folder, self.labs) if o.what != "same"}

    def says(self, name):
        content = (self.folder / name).read_bytes()
        return cells(content)[0][1].split("\n")[0] if "ipynb" in name else json.loads(content)

    def files(self):
        return {p: p.read_bytes() for p in self.folder.rglob("*") if p.is_file()}

    def write(self, name, content):
        (self.folder / name).write_bytes(content)


@pytest.fixture
def school(tmp_path):
    return Class(tmp_path)


def test_running_a_lab_does_not_count_as_a_change():
    lab = notebook("a lab")
    same, others = [notebook("a lab", "run")], [notebook("another")]
    for change in (
        lambda n: n["cells"][1].update(execution_count=7, outputs=[], metadata={"tags": ["x"]}),
        lambda n: n["metadata"].update(widgets={}),
        lambda n: n["cells"][0].update(source="".join(n["cells"][0]["source"]), id="other"),
    ):
        same.append(notebook("a lab"))
        change(same[-1])
    for change in (
        lambda n: n["cells"][1].update(source=["1 +  1"]),
        lambda n: n["cells"][1].update(cell_type="raw"),
        lambda n: n["cells"][0].update(attachments={"x.png": {"image/png": "eHl="}}),
        lambda n: n["cells"].reverse(),
        lambda n: n["cells"].pop(),
        lambda n: n["cells"].append(n["cells"][1]),
        lambda n: n["cells"].insert(0, {"cell_type": "code", "source": [], "outputs": []}),
        lambda n: n.pop("cells"),
    ):
        others.append(notebook("a lab"))
        change(others[-1])
    digest = copies.digest("x.ipynb", written(lab))
    assert {copies.digest("x.ipynb", written(n)) for n in same} == {digest}
    digests = [copies.digest("x.ipynb", written(n)) for n in others]
    digests += [copies.digest("x.ipynb", written(lab)[:-n]) for n in (2, 9)]
    digests += [copies.digest("x.ipynb", b"[" * 100_000), copies.digest("x.ipynb", b"\xff")]
    digests += [copies.digest("x.json", written(lab)), copies.digest("x.json", written(same[0]))]
    assert len({digest, *digests}) == 1 + len(digests)


def test_reported_outcomes_match_the_files(school, capsys):
    command = ["copy", str(school.folder), "--from", str(school.labs)]
    assert main(command) == 0
    assert capsys.readouterr().out == f"{school.folder}: nothing new; 3 unchanged\n"
    school.write("one.ipynb", written(notebook("mine")))
    (school.folder / "two.ipynb").unlink()
    (school.labs / "tasks/task.json").unlink()
    for name in ("one.ipynb", "two.ipynb", "three.ipynb"):
        school.newer(name, "second")
    assert main(command) == 0
    assert capsys.readouterr().out.splitlines() == [
        "tasks/task.json: no longer a lab; the file is kept",
        "one.ipynb: your version is kept; the newer one is one.new.ipynb",
        "three.ipynb: new",
        "two.ipynb: restored, since there is a newer version",
        f"{school.folder}: 2 new, 1 kept; 0 unchanged",
    ]
    assert school.says("one.ipynb") == "# mine" and school.says("tasks/task.json") == "first"
    assert school.says("one.new.ipynb") == "# one.ipynb second"
    # the newer lab next to it is replaced, unless the student has changed that lab, too
    for says, beside in (("third", "one.new.ipynb"), ("fourth", "one.new2.ipynb")):
        school.newer("one.ipynb", says)
        assert school.copy() == {"one.ipynb": "kept", "tasks/task.json": "gone"}
        assert school.says(beside) == f"# one.ipynb {says}"
        school.write(beside, written(notebook(f"mine, too: {says}")))
    school.newer("one.ipynb", "fifth")
    school.copy()
    assert [school.says(f"one.new{n}.ipynb").split()[-1] for n in ("", 2, 3)] == [
        "third",
        "fourth",
        "fifth",
    ]
    assert school.says("one.ipynb") == "# mine"


@pytest.mark.parametrize("after, dead", [(True, False), (False, True)])
def test_copy_can_be_interrupted_at_any_write_and_finished_later(
    tmp_path, after, dead, monkeypatch
):
    notary = NotebookNotary(store_factory=MemorySignatureStore, secret=b"secret")
    monkeypatch.setattr(nbformat.sign, "NotebookNotary", lambda: notary)
    school = Class(tmp_path, "one.ipynb", "two.ipynb")
    mine = written(notebook("mine"))
    school.write("two.ipynb", mine)
    for name in ("one.ipynb", "two.ipynb", "three.ipynb"):
        school.newer(name, "second")
    start, ends = shutil.copytree(school.folder, tmp_path / "start"), 0
    while True:
        ends += 1
        shutil.rmtree(school.folder)
        shutil.copytree(start, school.folder)
        with Writes(ends, after, dead) as writes, contextlib.suppress(KeyboardInterrupt):
            school.copy()
        if writes.count < ends:
            break
        assert (school.folder / "two.ipynb").read_bytes() == mine
        for path in school.folder.glob("*.ipynb"):
            nbformat.validate(nbformat.read(path, as_version=4))
        school.copy()
        assert (school.folder / "two.ipynb").read_bytes() == mine
        for name in ("one.ipynb", "two.new.ipynb", "three.ipynb"):
            assert school.says(name).endswith("second"), f"after write {ends}"
        names = sorted(p.name for p in school.files())
        wanted = ["one.ipynb", "three.ipynb", "two.ipynb", "two.new.ipynb"]
        assert names == ["lock", "manifest.json", *wanted], f"after write {ends}"
    assert ends > 30


def test_files_moved_by_a_killed_copy_are_restored_once(school, tmp_path):
    old, ends = school.folder / ".robokin" / "old" / "one.ipynb", 0
    mine, later = written(notebook("mine")), written(notebook("mine, later"))
    while True:
        ends += 1
        old.write_bytes(mine)
        school.write("one.ipynb", later)
        with Writes(ends, dead=True) as writes, contextlib.suppress(KeyboardInterrupt):
            school.copy()
        school.copy()
        assert (school.folder / "one.ipynb").read_bytes() == later
        rescued = school.folder / "one.yours.ipynb"
        assert rescued.read_bytes() == mine and rescued.stat().st_nlink == 1
        assert len(list(school.folder.glob("one*"))) == 2 and not old.exists()
        rescued.unlink()
        if writes.count < ends:
            break
    assert ends > 3


def test_partial_files_of_a_killed_copy_are_removed(school):
    rest = school.folder / ".robokin" / "new"
    rest.write_text("half of a la")
    assert school.copy() == {} and not rest.exists()


def test_link_created_during_a_copy_is_kept(school, tmp_path, monkeypatch):
    write, place = copies.write, school.folder / "one.ipynb"

    def meanwhile(path, content):
        write(path, content)
        if b"one.ipynb second" in content:
            place.unlink()
            place.symlink_to(tmp_path)

    monkeypatch.setattr(copies, "write", meanwhile)
    school.newer("one.ipynb", "second")
    assert school.copy() == {"one.ipynb": "failed"} and place.readlink() == tmp_path


def test_full_disk_is_reported_and_the_next_copy_succeeds(school, capsys):
    for name in ("one.ipynb", "two.ipynb", "new.ipynb"):
        school.newer(name, "second")
    with mock.patch.object(copies, "_put", side_effect=OSError(28, "No space left on device")):
        assert main(["copy", str(school.folder), "--from", str(school.labs)]) == 1
    said = capsys.readouterr()
    assert said.err.splitlines()[0] == "new.ipynb: No space left on device"
    assert "3 failed; 1 unchanged" in said.out
    assert set(school.copy().values()) == {"new", "replaced"}
    assert all(school.says(n) == f"# {n} second" for n in ("one.ipynb", "two.ipynb", "new.ipynb"))


def test_files_written_before_the_disk_is_full_are_reported(school, monkeypatch):
    """Exactly the reported files exist, whichever file is the last to fit on the disk."""
    write, names = copies.write, ("new.ipynb", "one.ipynb", "two.ipynb")
    for name in names:
        school.newer(name, "second")
    told = []
    for room in range(6):
        left = iter(range(room))

        def full(path, content, left=left):
            if next(left, None) is None:
                raise OSError(28, "No space left on device")
            write(path, content)

        folder = school.folder.with_name(f"student{room}")
        with monkeypatch.context() as patched:
            patched.setattr(copies, "write", full)
            try:
                done = {each.path: each.what for each in copies.copy(folder, school.labs)}
            except OSError as error:
                assert room == 0 and error.errno == 28
                done = {}
        laid = {path for path, what in done.items() if what == "new"}
        there = {p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file()}
        assert {path for path in there if not path.startswith(".robokin/")} == laid
        assert ("failed" in done.values()) == (0 < room) and not list(folder.rglob("new"))
        told.append(len(laid))
        again = {each.path: each.what for each in copies.copy(folder, school.labs)}
        assert {path for path, what in again.items() if what == "new"} >= set(names) - laid
        assert "failed" not in again.values()
    assert told == sorted(told) and told[-1] > told[1]


def test_broken_lab_is_reported_and_the_others_are_copied(school, capsys):
    before = (school.folder / "one.ipynb").read_bytes()
    (school.labs / "one.ipynb").write_text("{}")
    (school.labs / "bad.ipynb").write_text('{"cells": [{"cell_type": "code"')
    school.newer("two.ipynb", "second")
    assert main(["copy", str(school.folder), "--from", str(school.labs)]) == 1
    said = capsys.readouterr()
    assert [line.split(":")[:2] for line in said.err.splitlines()] == [
        ["bad.ipynb", " not a notebook"],
        ["one.ipynb", " not a notebook"],
    ]
    assert school.says("two.ipynb") == "# two.ipynb second"
    assert (school.folder / "one.ipynb").read_bytes() == before
    assert not (school.folder / "bad.ipynb").exists()


@pytest.mark.parametrize("text", ["", "{", "[]", '{"one.ipynb": 5}', "\xff", None])
def test_copy_without_a_manifest_loses_nothing(school, text):
    manifest = school.folder / ".robokin" / "manifest.json"
    mine = written(notebook("mine"))
    school.write("one.ipynb", mine)
    school.newer("tasks/task.json", "second")
    if text is None:
        manifest.unlink()
    else:
        manifest.write_bytes(text.encode("latin-1"))
    done = school.copy()
    assert (".robokin/manifest.json" in done) == (text is not None)
    assert done["one.ipynb"] == "kept" and school.says("one.new.ipynb") == "# one.ipynb first"
    assert done["two.ipynb"] == "replaced", "a file that equals ours counts as ours"
    assert school.says("tasks/task.json") == "first", "an older file may be the student's"
    assert school.says("tasks/task.new.json") == "second"
    assert (school.folder / "one.ipynb").read_bytes() == mine and school.copy() == {}


def test_lab_name_may_contain_the_word_new(tmp_path):
    school = Class(tmp_path, "one.ipynb", "one.new.ipynb")
    (school.labs / "one.new.ipynb").write_bytes((school.labs / "one.ipynb").read_bytes())
    school.copy()
    school.write("one.ipynb", written(notebook("mine")))
    school.newer("one.ipynb", "second")
    assert school.copy() == {"one.ipynb": "kept"}
    assert school.says("one.new2.ipynb").endswith("second")
    assert school.says("one.new.ipynb") == "# one.ipynb first"


def test_unusable_folders_are_refused_with_a_reason(school, tmp_path, capsys, monkeypatch):
    def refused(folder, *source):
        before = sorted(tmp_path.rglob("*"))
        assert main(["copy", str(folder), *(["--from", str(source[0])] if source else [])]) == 1
        said = capsys.readouterr()
        assert not said.out and len(said.err.splitlines()) == 1
        assert sorted(tmp_path.rglob("*")) == before, "a file or folder was created"
        return said.err.removeprefix(f"{folder}: ")

    (tmp_path / "file").write_text("mine")
    assert (
        refused(tmp_path / "file", school.labs) == "wanted a folder, got a file or a broken link\n"
    )
    for folder in (school.labs, school.labs / "deep" / "er", tmp_path, school.labs / ".." / "labs"):
        assert "wanted a folder separate from the labs" in refused(folder, school.labs)
    assert "no labs in" in refused(tmp_path / "new", tmp_path)
    monkeypatch.setattr(copies, "__file__", str(tmp_path / "site" / "robokin" / "course" / "x.py"))
    assert "not installed from a clone; give --from" in refused(tmp_path / "new")
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / ".robokin").write_text("mine")
    assert "File exists" in refused(tmp_path / "own", school.labs)

    def makedirs(path, **_):
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(os, "makedirs", makedirs)  # root can write anywhere
    assert "Permission denied" in refused(tmp_path / "new", school.labs)


def test_error_for_missing_nbformat_contains_the_install_command(school, monkeypatch, capsys):
    school.newer("one.ipynb", "second")
    monkeypatch.setitem(sys.modules, "nbformat", None)
    assert main(["copy", str(school.folder), "--from", str(school.labs)]) == 1
    assert "pip install '.[labs]' at the top of a clone" in capsys.readouterr().err
    assert school.says("one.ipynb").endswith("first")


def test_labs_are_copied_even_if_they_cannot_be_trusted(school, monkeypatch, capsys):
    school.newer("one.ipynb", "second")
    monkeypatch.setattr(
        nbformat.sign, "NotebookNotary", mock.Mock(side_effect=OSError("no rights"))
    )
    assert main(["copy", str(school.folder), "--from", str(school.labs)]) == 1
    assert "still pictures: 'no rights'" in capsys.readouterr().err
    assert school.says("one.ipynb").endswith("second"), (
        "the lab must be copied, even if it can only show still pictures"
    )


def test_simultaneous_copies_lose_nothing(school):
    with copies.alone(school.folder / ".robokin" / "lock"):
        with pytest.raises(ValueError, match="another process is using it"):
            school.copy()
    for name in ("one.ipynb", "two.ipynb", "three.ipynb"):
        school.newer(name, "second")
    with ThreadPoolExecutor(2) as pool:
        both = [pool.submit(school.copy) for _ in range(2)]
        errors = [each.exception() for each in both]
        assert all(e is None or "another process is using it" in str(e) for e in errors), errors
        assert None in errors
    assert all(school.says(f"{n}.ipynb").endswith("second") for n in ("one", "two", "three"))
    assert school.copy() == {}


# --- Copies of the real labs ----------------------------------------------------------------------


def test_copied_labs_are_valid_and_trusted(tmp_path):
    outcomes = copy(tmp_path / "student")
    given = {p.relative_to(NOTEBOOKS).as_posix() for p in NOTEBOOKS.rglob("*") if p.is_file()}
    given = {p for p in given if not any(part.startswith(".") for part in p.split("/"))}
    given = {p for p in given if not p.startswith("exercises/")}  # exercises contain solutions
    wanted = sorted(p for p in given - {"documents/teaching.ipynb"} if not p.endswith(".log"))
    assert [o.path for o in outcomes] == wanted and {o.what for o in outcomes} == {"new"}
    for path in wanted:
        content, lab = (tmp_path / "student" / path).read_bytes(), (NOTEBOOKS / path).read_bytes()
        if path.endswith(".ipynb"):
            assert json.loads(content) == laid(lab)
            read = nbformat.read(tmp_path / "student" / path, as_version=4)
            nbformat.validate(read)
            assert NotebookNotary().check_signature(read), f"{path} is not trusted"
        else:
            assert content == lab


def test_copied_lab_works_when_opened_and_is_not_marked_as_changed(browser, jupyter, monkeypatch):
    """The player plays before any cell has run, and JupyterLab has nothing to save."""
    monkeypatch.setenv("JUPYTER_DATA_DIR", jupyter.environment["JUPYTER_DATA_DIR"])
    copy(jupyter.labs / "student")
    page = browser.new_page()
    jupyter.open(page, "student/00_start_here.ipynb")
    page.locator("div.robokin-player").first.wait_for()
    players = page.locator("div.robokin-player")
    player = players.filter(has=page.get_by_label("playback speed")).first

    def started():
        awake(page)  # repeatedly, since JupyterLab renders the lower cells later
        return player.count() and player.locator("canvas").first.is_visible()

    until(started, "no player has started", page)
    button = player.get_by_role("button", name=re.compile("play", re.I)).first
    canvases = "e => [...e.querySelectorAll('canvas')].map(c => c.toDataURL()).join()"
    still = player.evaluate(canvases)
    button.click()
    until(lambda: player.evaluate(canvases) != still, "the player does not play", page)
    page.get_by_text("| Idle").first.wait_for()
    page.wait_for_timeout(1500)  # the language status appears later
    tab = page.locator(".lm-TabBar-tab.lm-mod-current[data-type='document-title']")
    assert tab.count() == 1 and "jp-mod-dirty" not in tab.get_attribute("class")
    page.close()
