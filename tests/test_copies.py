"""`python -m robokin.course copy`: labs handed out, and again, without a loss.

A history is what may happen to a student's folder: edits, runs, files of their own, newer labs, and
copies that are interrupted at any write or meet a student who saves in that very moment. `History`
knows by itself what the student wrote and what the labs say, and looks after every step.
"""

import builtins
import contextlib
import json
import os
import platform
import random
import shutil
import subprocess
import sys
from functools import partial
from pathlib import Path
from unittest import mock

import nbformat
import pytest
from conftest import NOTEBOOKS, until
from nbformat.sign import MemorySignatureStore, NotebookNotary

from robokin.course import copies
from robokin.course.__main__ import main
from robokin.course.copies import copy

TWO = "two [\u00fc].ipynb"
WRITES = ("fsync", "link", "makedirs", "rename", "replace", "unlink")


@pytest.fixture(autouse=True)
def _own_trust(tmp_path, monkeypatch):
    """No signature of these tests among the developer's."""
    monkeypatch.setenv("JUPYTER_DATA_DIR", str(tmp_path / "jupyter"))
    monkeypatch.setenv("JUPYTER_CONFIG_DIR", str(tmp_path / "jupyter"))


# --- Notebooks ------------------------------------------------------------------------------------


def notebook(text, shown="still"):
    """A small lab that says `text`; `shown` is what its player shows."""
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
    """What the cells say, or None where the bytes are no notebook."""
    try:
        return [(c["cell_type"], "".join(c["source"])) for c in json.loads(content)["cells"]]
    except (ValueError, KeyError, TypeError):
        return None


def said(path, content):
    """What counts in a file: its cells, or its bytes."""
    return (path.endswith(".ipynb") and str(cells(content))) or content


def trusted(path, notary=NotebookNotary):
    return notary().check_signature(nbformat.read(path, as_version=4))


def laid(content):
    """A lab as it should lie in a student's folder."""
    data = json.loads(content)
    data["metadata"]["language_info"]["version"] = platform.python_version()
    return data


# --- Whatever may happen at a write ---------------------------------------------------------------


class Writes:
    """Stands for `os` and `open` in `copies`: counts what it does to files, and at count `end`
    stops it by an `error`: before or after that takes effect, in the middle of a write; once, or
    (`dead`) for good, as a process that was killed. `at`: count -> what happens just before.
    With `near`, a path, it counts from the moment when that is moved or laid.
    """

    def __init__(self, end=None, after=False, dead=False, error=KeyboardInterrupt):
        self.count, self.end, self.after, self.dead = 0, end, after, dead
        self.error, self.at, self.near = error, {}, None

    def __getattr__(self, name):
        if name == "fsync":
            return lambda _: self.step(lambda: None)  # it takes its time
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


# --- A history ------------------------------------------------------------------------------------


class History:
    """A source of labs, a student's folder, and what has to hold.

    mine       [path, bytes] that the student wrote and has not changed or deleted since; the path
               is None while only the next copy can bring it back (a save that met a killed copy)
    untouched  places of labs where ours lies, run or not
    offered    lab -> what of it was last handed out; several where a copy was interrupted
    outputs    lab -> the bytes that were last handed out, if that is sure
    links      the student's links, and where they lead
    """

    def __init__(self, seed, top):
        self.random = random.Random(seed)
        self.source, self.folder = top / "labs", top / "student"
        self.number = 0
        self.mine, self.untouched, self.offered, self.before = [], set(), {}, {}
        self.links, self.versions, self.valid, self.outputs = {}, {}, set(), {}
        store = MemorySignatureStore()  # SQLite takes its time
        self.notary = partial(NotebookNotary, store_factory=lambda: store, secret=b"secret")
        for name in ("one.ipynb", TWO, "documents/three.ipynb", "tasks/task.json"):
            self._lab(name)
        (self.source / "notes.txt").write_text("not handed out")
        (self.source / "documents" / ".hidden.ipynb").write_text("not handed out")

    def run(self, steps):
        with mock.patch.object(copies, "NotebookNotary", self.notary):
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
        assert self.files(hidden=True) == before, "a copy without news changes nothing"

    # What the teacher does

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

    # What the student does

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
        """The newer one, laid beside, takes the place of the student's."""
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
        """A folder, or a link, where a lab was or will be."""
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
        """A folder of labs is moved, and a link is in its place."""
        place = self.folder / "documents"
        if (
            place.is_dir()
            and not place.is_symlink()
            and not any("documents" in p for p in self.links)
        ):
            for path in list(self.files()):
                if path.startswith("documents/"):
                    self.mine = [m for m in self.mine if m[0] != path]
                    self.mine.append([f"elsewhere/{path[10:]}", self._read(path)])
                    self.untouched.discard(path)
                    self.before.pop(path, None)
            if os.path.lexists(self.folder / "elsewhere"):
                return shutil.rmtree(self.folder / "elsewhere")
            place.rename(self.folder / "elsewhere")
            place.symlink_to(self.folder / "elsewhere")
            self.links["documents"] = str(self.folder / "elsewhere")
        return None

    def save(self, path, content, ours=False):
        """The student's file, written as JupyterLab writes: into the file that is there."""
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
        """A copy that nothing disturbs, and what holds after it."""
        before, laid_before = self.files(), {p: self.offered.get(p, {None}) for p in self.labs()}
        outcomes = copy(self.folder, self.source)
        assert not [o for o in outcomes if o.what == "failed"], outcomes
        after = self.files()
        inside = [p for p in self.files(hidden=True) if p.startswith(".robokin/")]
        assert sorted(inside) == [".robokin/lock", ".robokin/manifest.json"]
        self.look()
        assert not [m for m in self.mine if m[0] is None], "what was saved is not given back"
        mine = [m[0] for m in self.mine]
        for path in self.labs():
            newest = (self.source / path).read_bytes()
            says = said(path, newest)
            barred = (self.folder / path).parent.is_symlink()
            if barred:
                continue
            newer = says not in laid_before[path]
            same = laid_before[path] == {says}
            here = after.get(path)
            sides = self._sides(path, after)
            if path in self.untouched:  # also where an interrupted copy had moved it
                assert here and said(path, here) == says, f"{path}: not touched, not the newest"
                if self.outputs.get(path) not in (None, newest):
                    assert path.endswith(".json") or json.loads(here) == laid(newest)
            elif path in mine or self._strange(path):
                beside = [said(path, after[side]) for side in sides]
                assert says in beside or not newer, f"{path}: no newer beside"
            elif not os.path.lexists(self.folder / path):
                assert not newer and path not in before, f"{path} does not come back"
            elif path not in before:
                assert not same, f"{path} was deleted and came back without news"
                assert said(path, here) == says
                self.untouched.add(path)
            for side in sides:
                if side not in mine:
                    self.untouched.add(side)
                    assert said(path, after[side]) == says, f"{side} is not the newest"
            self.offered[path], self.outputs[path] = {says}, newest
        for outcome in outcomes:
            assert (
                outcome.path in ("documents", ".robokin/manifest.json")
                or outcome.says
                or (outcome.what == "same")
            )
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
                    f"{path} is the student's and was signed"
                )

    def interrupted(self):
        """A copy that is stopped somewhere."""
        if self.random.random() < 0.5:
            self.newer()
        error = self.random.choice([KeyboardInterrupt, OSError(28, "No space left on device")])
        with self._writes(25, error), contextlib.suppress(KeyboardInterrupt, OSError):
            copy(self.folder, self.source)
        self._unsure()

    def meets_a_save(self):
        """A copy while the student saves what it is about to replace: into the file, by a new file
        in its place, or in two halves; once or twice; sometimes it is killed on top of it.
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
                self.mine.append([None, saved.pop()])  # it was not the student who moved it
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
            assert here or writes.end, f"{path}: the student saved it, and it is elsewhere"
            self.mine.append([path if here else None, saved[0]])
        self._unsure()

    def _writes(self, last, error, dead=None, never=0.0):
        end = None if self.random.random() < never else self.random.randint(1, last)
        dead = self.random.random() < 0.5 if dead is None else dead
        return Writes(end, self.random.random() < 0.5, dead, error)

    def _unsure(self):
        """After a copy that was disturbed: it may have handed out anything, or nothing."""
        files = self.files()
        for path in self.labs():
            says = said(path, (self.source / path).read_bytes())
            self.offered[path] = {*self.offered.get(path, ()), says, "unsure"}
            self.outputs.pop(path, None)
            for place in (path, *self._sides(path, files)):
                mine = any(m[0] == place for m in self.mine)
                if self._plain(place) and not mine and said(path, files[place]) == says:
                    self.untouched.add(place)

    # What has to hold

    def look(self):
        """Nothing of the student's is lost, and no notebook is broken that was whole."""
        files = self.files(hidden=True)
        for each in self.mine:
            path, content = each
            if path is None:
                where = [p for p in files if files[p] == content]
                assert where, "what was saved is lost"
                each[0] = next((p for p in where if not p.startswith(".robokin")), None)
            else:
                assert files.get(path) == content, f"{path} is not what the student wrote"
        for path, target in self.links.items():
            assert os.readlink(self.folder / path) == target
        for path, content in files.items():
            mine = any(content == m[1] for m in self.mine)
            hidden = path.startswith(".robokin") or content in self.valid
            if path.endswith(".ipynb") and not mine and not hidden:
                nbformat.validate(nbformat.reads(content.decode(), as_version=4))
                self.valid.add(content)

    # Small things

    def token(self):
        self.number += 1
        return f"t{self.number}"

    def labs(self):
        found = [*self.source.glob("*.ipynb"), *self.source.glob("documents/[!.]*.ipynb")]
        found += self.source.glob("tasks/*.json")
        return sorted(p.relative_to(self.source).as_posix() for p in found)

    def files(self, hidden=False):
        """Path -> bytes of the student's files; what links lead to is not theirs twice."""
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
        """The student changes a cell, adds one, or changes their order."""
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
def test_no_history_loses_anything(seed, tmp_path):
    History(seed, tmp_path).run(steps=25)
