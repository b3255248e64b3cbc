"""Copy the labs into a student's folder, or update them there:

    python -m robokin.course copy FOLDER

A lab counts as edited if its cells have changed or are in a different order; running a lab does not
count. A lab that the student has not edited is replaced by the newer version. An edited lab is
kept, byte for byte, and the newer version is put next to it as NAME.new.ipynb. A deleted lab is
restored when there is a newer version. A file that has a lab's name but was never handed out
belongs to the student. Notebooks are written as trusted, so that their players run immediately.

The exit status is 0 if every lab is there, or a file of the student's own in its place. It is 1 if
something could not be done; this is reported on stderr, everything else is done, and the student's
work is unchanged. A script that starts a student's server can continue in both cases.

The student's work is never lost. The manifest in FOLDER/.robokin lists every version that was ever
written, with the digests of its file and of its cells. The manifest is written before the labs, so
that files from an interrupted run are recognised as ours. A lab is first written completely in
.robokin and then linked to its place; linking never overwrites a file. The file that it replaces is
first moved to .robokin/old, where no program can save into it unnoticed, and is checked again. If
it is not ours, because the student saved at that very moment, it is moved back. `_tidy` completes
each step and repairs what an interrupted run left behind.
"""

import contextlib
import hashlib
import json
import os
import platform
import re
import stat
import sys
import time
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any, BinaryIO

from .._validate import short

HANDED_OUT = ("*.ipynb", "documents/*.ipynb", "tasks/*.json", "images/*")
FOR_TEACHERS = ("documents/teaching.ipynb",)
BUSY = "was saved while labs were being copied and is left unchanged; run this again"


@dataclass(frozen=True)
class Outcome:
    """The outcome for the file at `path`; `says` describes it.

    what  "new", "replaced", "kept" (the student's file is kept, and the newer version is next to
          it), "same" (there was nothing to do), "gone" (it is no longer a lab; the file is kept),
          "found" (it was rescued from an interrupted run) or "failed"
    """

    path: str
    what: str
    says: str = ""


def copy(
    folder: str | os.PathLike[str], source: str | os.PathLike[str] | None = None
) -> list[Outcome]:
    """Copy the labs from `source` (None means the clone from which robokin is installed) into
    `folder`, which is created if necessary.

    Raises ValueError if there are no labs, `folder` is not a folder, one folder is inside the
    other, or another process is copying. Raises OSError, and writes nothing, if permission is
    missing or the disk is full. The failure of a single file is reported as an `Outcome`.
    """
    labs = Path(source) if source is not None else Path(__file__).parents[2] / "notebooks"
    files = {
        path.relative_to(labs).as_posix(): path
        for pattern in HANDED_OUT
        for path in labs.glob(pattern)
        if path.is_file() and not path.name.startswith(".")
    }
    if not any(path.endswith(".ipynb") for path in files):
        more = "" if source else ": robokin is not installed from a clone; give --from FOLDER"
        raise ValueError(f"no labs in {labs}{more}")
    student = _Folder(_target(Path(folder), labs))
    with alone(student.own / "lock"):
        return student.hand_out({p: files[p] for p in files if p not in FOR_TEACHERS})


def digest(path: str, content: bytes) -> str:
    """Return a digest of a file's content. For a notebook, the content is the types, sources and
    attachments of its cells, in order; for anything else, including a broken notebook, it is the
    bytes.
    """
    if path.endswith(".ipynb"):
        with contextlib.suppress(ValueError, LookupError, TypeError, RecursionError):
            cells = [
                (cell["cell_type"], "".join(cell["source"]), cell.get("attachments") or {})
                for cell in json.loads(content)["cells"]
            ]
            content = b"cells" + json.dumps(cells, sort_keys=True).encode()
    return hashlib.sha256(content).hexdigest()


@dataclass
class _Entry:
    """The manifest's entry for a lab. `laid` is the version written last (the digest of the source
    file), or None. `handed` maps each version that may be in the folder to the digest of its
    content.
    """

    laid: str | None = None
    handed: dict[str, str] = field(default_factory=dict)


@dataclass
class _Job:
    """A version of the lab `path`, its content, and its destinations: the lab's own place, a
    place next to it, or none.
    """

    path: str
    version: str
    holds: str
    content: bytes
    places: list[str] = field(default_factory=list)
    outcomes: list[Outcome] = field(default_factory=list)


class _Folder:
    """A student's folder. Paths are relative to it and use forward slashes."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.own = folder, folder / ".robokin"
        self.old, self.new = self.own / "old", self.own / "new"
        self.manifest, self.stored = self.own / "manifest.json", ""
        self.entries: dict[str, _Entry] = {}
        self.outcomes: list[Outcome] = []

    def hand_out(self, labs: dict[str, Path]) -> list[Outcome]:
        """Do all steps: decide what to do, record what will be written, write it."""
        self._recall()
        self._tidy()
        jobs, notebooks = [], []
        for path in sorted({*self.entries, *labs}):
            if path not in labs:
                if os.path.lexists(self.folder / path):
                    self._say(path, "gone", "no longer a lab; the file is kept")
                continue
            try:
                job = self._plan(path, labs[path].read_bytes(), labs)
                if job.places and path.endswith(".ipynb"):
                    job.content, notebook = _prepared(job.content)
                    notebooks.append(notebook)
            except (OSError, ValueError) as error:
                self._say(path, "failed", _reason(error))
                continue
            jobs.append(job)
            if job.places:
                self.entries.setdefault(path, _Entry()).handed[job.version] = job.holds
        trouble = _sign(notebooks) if notebooks else None
        if trouble:
            self._say(".", "failed", f"not trusted, so players remain still pictures: {trouble}")
        self._remember()
        try:
            for job in jobs:
                self._do(job)
        finally:
            try:
                self._remember()
            except OSError as error:  # the next run will examine the files
                self._say(".robokin/manifest.json", "failed", _reason(error))
        return self.outcomes

    def _plan(self, path: str, content: bytes, labs: Iterable[str]) -> _Job:
        """Decide what to do for a lab whose newest version is `content`."""
        holds = digest(path, content)
        job = _Job(path, hashlib.sha256(content).hexdigest(), holds, content)
        entry = self.entries.get(path, _Entry())
        ours = {*entry.handed.values(), holds}
        newer = entry.handed.get(entry.laid or "") != holds
        parent = (self.folder / path).parent
        if _barred(parent):
            if newer:
                says = f"not copied, because {parent.name} is not an ordinary folder"
                job.outcomes.append(Outcome(path, "kept", says))
            return job
        beside = [p for p in self._beside(path) if p not in labs]
        there = {p: _held(self.folder / p) for p in (path, *beside)}
        # this replaces an older version that the student has restored, too
        known = (holds, job.version)
        job.places = [p for p in there if there[p] in ours and (there[p], entry.laid) != known]
        for place in job.places:
            job.outcomes.append(Outcome(place, "replaced", "replaced by the newer version"))
        if newer and there[path] is None:
            job.places.append(path)
            says = "restored, since there is a newer version" if entry.laid else "new"
            job.outcomes.append(Outcome(path, "new", says))
        elif newer and there[path] not in ours:
            job.places = job.places or [self._free(path, "new")]
            side = PurePosixPath(job.places[0]).name
            job.outcomes = [Outcome(path, "kept", f"your version is kept; the newer one is {side}")]
        return job

    def _do(self, job: _Job) -> None:
        """Write a version to its places."""
        if job.places:
            entry = self.entries[job.path]
            for place in job.places:
                try:
                    self._lay(place, job.content, set(entry.handed.values()))
                except (OSError, ValueError) as error:
                    self._say(place, "failed", _reason(error))
                    return
            entry.laid = job.version
        self.outcomes += job.outcomes or [Outcome(job.path, "same")]

    def _lay(self, path: str, content: bytes, ours: set[str]) -> None:
        """Write a file where there is none, or in place of one of ours. Raises ValueError if a file
        was saved there in the meantime.
        """
        place, old = self.folder / path, self.old / path
        os.makedirs(place.parent, exist_ok=True)
        os.makedirs(old.parent, exist_ok=True)
        try:
            write(self.new, content)
            if os.path.lexists(place):
                if _held(place) not in ours:
                    raise ValueError(BUSY)
                os.replace(place, old)
                if _held(old) not in ours:
                    raise ValueError(BUSY)
            _put(self.new, place)
        except FileExistsError:
            raise ValueError(BUSY) from None
        finally:
            self._tidy()

    def _tidy(self) -> None:
        """Remove our files from .robokin. Move other files there back to their places, or next to
        them if a new file that we did not write is in the way.
        """
        ours = {holds for entry in self.entries.values() for holds in entry.handed.values()}
        with contextlib.suppress(FileNotFoundError):
            os.unlink(self.new)
        for old in [Path(top, name) for top, _, names in os.walk(self.old) for name in names]:
            path = old.relative_to(self.old).as_posix()
            place = self.folder / path
            if not os.path.lexists(place) and not _barred(place.parent):
                os.makedirs(place.parent, exist_ok=True)
                with contextlib.suppress(FileExistsError):
                    _put(old, place)
                    continue
            if _held(old) in ours or os.lstat(old).st_nlink > 1:  # > 1: already linked back
                os.unlink(old)
            else:
                side = self._free(path, "yours")
                _put(old, self.folder / side)
                says = f"saved while labs were being copied: now in {PurePosixPath(side).name}"
                self._say(path, "found", says)

    def _recall(self) -> None:
        """Read the manifest. Without a readable manifest, a file counts as ours only if its content
        is what we would write.
        """
        with contextlib.suppress(FileNotFoundError):
            try:
                self.stored = self.manifest.read_text(encoding="utf-8")
                self.entries = {
                    path: _Entry(
                        _text(entry["laid"] or "") or None,
                        {_text(v): _text(holds) for v, holds in entry["handed"].items()},
                    )
                    for path, entry in json.loads(self.stored).items()
                }
            except (ValueError, LookupError, TypeError, AttributeError, RecursionError):
                self._say(".robokin/manifest.json", "found", "it cannot be read and is replaced")

    def _remember(self) -> None:
        """Write the manifest atomically if it has changed."""
        told = {path: asdict(entry) for path, entry in self.entries.items()}
        text = json.dumps(told, indent=1, sort_keys=True) + "\n"
        if text != self.stored:
            write(self.new, text.encode())
            os.replace(self.new, self.manifest)
            self.stored = text

    def _beside(self, path: str) -> list[str]:
        """The files next to a lab that are named as newer versions of it."""
        place, folder = PurePosixPath(path), (self.folder / path).parent
        name = re.compile(rf"{re.escape(place.stem)}\.new\d*{re.escape(place.suffix)}")
        names = sorted(os.listdir(folder)) if folder.is_dir() else []
        return [str(place.with_name(n)) for n in names if name.fullmatch(n)]

    def _free(self, path: str, word: str) -> str:
        """Return NAME.word.ipynb, or the first of NAME.word2.ipynb, ... that is free."""
        place, n = PurePosixPath(path), 1
        while True:
            side = place.with_name(f"{place.stem}.{word}{n if n > 1 else ''}{place.suffix}")
            if not os.path.lexists(self.folder / side):
                return str(side)
            n += 1

    def _say(self, path: str, what: str, says: str) -> None:
        self.outcomes.append(Outcome(path, what, says))


def _target(folder: Path, labs: Path) -> Path:
    """The student's folder, created if necessary, with .robokin in it."""
    if os.path.lexists(folder) and not folder.is_dir():
        raise ValueError("wanted a folder, got a file or a broken link")
    folder = folder.resolve()
    for inner, outer in ((folder, labs), (labs.resolve(), folder)):
        above = (inner, *inner.parents)
        if outer.exists() and any(p.exists() and p.samefile(outer) for p in above):
            raise ValueError(f"wanted a folder separate from the labs, which are in {labs}")
    os.makedirs(folder / ".robokin", exist_ok=True)
    return folder


@contextlib.contextmanager
def alone(path: Path, seconds: float = 0) -> Iterator[None]:
    """Hold the lock at `path`, which is also released if the process dies. Raises ValueError if
    another process still holds it after `seconds`.
    """
    end = time.monotonic() + seconds
    with open(path, "ab") as file:
        while not _locked(file):
            if time.monotonic() >= end:
                raise ValueError("another process is using it; run this again")
            time.sleep(0.01)
        yield


def _locked(file: BinaryIO) -> bool:
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    except OSError:
        pass  # a file system without locks: two runs may interfere, but nothing is lost
    return True


def _prepared(content: bytes) -> tuple[bytes, Any]:
    """Return a notebook as text to write and as an nbformat object. Raises ValueError if it is not
    a notebook.
    """
    # imported only if needed, since this takes most of the time of a run that changes nothing
    import nbformat

    try:
        data = json.loads(content)
        info = data["metadata"].get("language_info", {})
        if info.get("name") == "python":
            # otherwise JupyterLab marks the lab as changed as soon as its kernel has started
            info["version"] = platform.python_version()
        text = json.dumps(data, indent=1, ensure_ascii=False) + "\n"
        notebook = nbformat.reads(text, as_version=4)
        nbformat.validate(notebook)
        return text.encode(), notebook
    except Exception as error:  # JSON, Unicode and schema errors from several libraries
        reason = str(error).partition("\n")[0]
        raise ValueError(f"not a notebook: {reason}") from None


def _sign(notebooks: Iterable[Any]) -> str | None:
    """Sign notebooks as trusted, as Jupyter does; return the reason if that fails."""
    from nbformat.sign import NotebookNotary

    try:
        notary = NotebookNotary()
        try:
            for notebook in notebooks:
                notary.sign(notebook)
        finally:
            notary.store.close()
    except Exception as error:  # errors from files, SQLite and Jupyter's settings
        return short(f"{error}")
    return None


def _held(place: Path) -> str | None:
    """The digest of the file at `place`; None if nothing is there; "" if it is not a readable file
    and therefore not one of ours.
    """
    try:
        if not stat.S_ISREG(os.lstat(place).st_mode):
            return ""
        return digest(place.name, place.read_bytes())
    except FileNotFoundError:
        return None
    except OSError:
        return ""


def _barred(folder: Path) -> bool:
    """Return whether something other than a real folder is there; we never write through a link."""
    return folder.is_symlink() or (folder.exists() and not folder.is_dir())


def write(path: Path, content: bytes) -> None:
    """Write a new file and flush it to disk. We never write into an existing file, since it may
    also have another name (a hard link).
    """
    with contextlib.suppress(FileNotFoundError):
        os.unlink(path)
    with open(path, "xb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())


def _put(path: Path, place: Path) -> None:
    """Move a file to a free place. Raises FileExistsError if the place is taken."""
    try:
        os.link(path, place, follow_symlinks=False)
    except FileExistsError:
        raise
    except (OSError, NotImplementedError):  # a file system without links, or not a regular file
        if os.path.lexists(place):
            raise FileExistsError(place) from None
        # never overwrites on Windows; elsewhere another process has microseconds to interfere
        os.rename(path, place)
    else:
        os.unlink(path)


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError("wanted a string")
    return value


def _reason(error: Exception) -> str:
    return getattr(error, "strerror", None) or str(error)
