"""The course as a website for readers without Python: labs, companions, glossary, notes for
teachers and the package reference. Its views and predictions work, the cells of the labs run in the
page, and it loads nothing from other sites.

Sphinx, myst-nb and furo build it from the stored outputs. `build` arranges their input; conf.py
configures them.
"""

import hashlib
import importlib
import json
import os
import pkgutil
import re
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

import robokin

from . import files

HERE = Path(__file__).parent
TEACHING = "teaching.ipynb"
NOTES = "documents/teaching"  # the link to the notes; its line in index.md is removed with them
REPOSITORY = re.compile(r"https://[a-z0-9.-]+(:[0-9]+)?(/[a-z0-9._~-]+)+/?", re.I)
MARK = ".robokin-site"  # a file in the site's folder that lists all files written there


def build(folder: Path, teaching: bool = True, repository: str = "") -> str:
    """Write the site into `folder`, with or without the notes for teachers, and return Sphinx's
    warnings. If `repository` is the address of robokin's repository, every page names it.

    Raises ValueError, and writes nothing, if the address is not one, there are no labs, Sphinx is
    not installed or fails, the files of Python cannot be fetched, or a file that is not part of a
    site is in the way.
    """
    if repository and not REPOSITORY.fullmatch(repository):
        wanted = "an address such as https://example.org/group/robokin"
        raise ValueError(f"repository: wanted {wanted}, got {repository!r}")
    missing = [name for name in ("sphinx", "myst_nb", "furo") if find_spec(name) is None]
    if missing:
        install = "pip install '.[site]' at the top of a clone of robokin"
        raise ValueError(f"{', '.join(missing)}: not installed; use {install}")
    labs = Path(robokin.__file__).parents[1] / "notebooks"
    if not any(labs.glob("*.ipynb")):
        raise ValueError(f"{labs}: no labs; a site can only be built from a clone of robokin")
    _older(folder)
    with TemporaryDirectory() as scratch:
        source = Path(scratch).resolve() / "source"
        made = source.with_name("made")
        notebooks = [path for path in _notebooks(labs) if teaching or path.name != TEACHING]
        _gather(labs, notebooks, source)
        sizes = files.assets(python := source.with_name("python"))
        version = _version(python)
        _write(source / "sizes.json", json.dumps({"version": version, "sizes": sizes}))
        complaints = _run(source, made, repository)
        shutil.move(python, made / "python")
        for notebook in notebooks:  # the notebook to download, next to its page
            shutil.copyfile(notebook, made / notebook.relative_to(labs))
        unwanted = shutil.ignore_patterns("__pycache__")
        shutil.copytree(labs / "exercises", made / "exercises", ignore=unwanted)
        _put(made, folder)
    return complaints


def _version(folder: Path) -> str:
    """A hash of all files in a folder, which changes the addresses that a browser has stored."""
    all_ = sorted(path for path in folder.rglob("*") if path.is_file())
    return hashlib.sha256(b"".join(path.read_bytes() for path in all_)).hexdigest()[:8]


def anchor(title: str) -> str:
    """The anchor of a heading, as in JupyterLab."""
    return title.replace(" ", "-")


# --- Input for Sphinx ----------------------------------------------------------------------------


def _notebooks(labs: Path) -> list[Path]:
    return [*labs.glob("*.ipynb"), *labs.glob("documents/*.ipynb")]


def _gather(labs: Path, notebooks: list[Path], source: Path) -> None:
    """Gather the files next to this module, the notebooks, a list of the labs, an arm for the first
    page, and a page for each module. If the notes for teachers are left out, the first page does
    not mention them.
    """
    from ...show import target_explorer
    from ..ours import quiet

    shutil.copytree(HERE, source, ignore=shutil.ignore_patterns("__*", "files.py", "python.json"))
    for notebook in notebooks:
        copy = source / notebook.relative_to(labs)
        copy.parent.mkdir(exist_ok=True)
        shutil.copyfile(notebook, copy)
    shutil.copytree(labs / "images", source / "images")
    _write(source / "labs.txt", "\n".join(map(_entry, sorted(labs.glob("*.ipynb")))))
    if not any(path.name == TEACHING for path in notebooks):
        first = (HERE / "index.md").read_text(encoding="utf-8")
        _write(source / "index.md", "".join(re.split(rf".*{NOTES}.*\n", first)))
    _write(source / "arm.html", quiet(target_explorer(robokin.IRB140).html))
    names = _modules()
    for name in names:
        _write(source / "api" / f"{name}.rst", f"{name}\n{'=' * 80}\n\n.. automodule:: {name}\n")
    _write(source / "api" / "list.txt", "\n".join(map(_described, names)))
    tree = (f"{name.removeprefix('robokin.')} <{name}>" for name in names)
    _write(source / "api" / "tree.txt", "\n".join(("```{toctree}", ":hidden:", *tree, "```")))


def _entry(lab: Path) -> str:
    """The entry for a lab in the list of labs: its title and its claim."""
    try:
        first = "".join(json.loads(lab.read_text(encoding="utf-8"))["cells"][0]["source"])
    except (KeyError, ValueError) as error:
        raise ValueError(f"{lab}: not a notebook: {error!r}") from None
    title, claim = re.search("^# (.*)", first), re.search(r"\*\*(.*?)\*\*", first, re.S)
    if not title or not claim:
        raise ValueError(f"{lab}: wanted a title and a claim in bold in its first cell")
    return f"- [{title[1]}]({lab.name})\\\n  {' '.join(claim[1].split())}"


def _modules() -> list[str]:
    """The modules whose public names are described."""
    parts = [
        f"robokin.{package}.{module.name}"
        for package in ("arms", "motion", "jobs")
        for module in pkgutil.iter_modules([str(HERE.parents[1] / package)])
        if not module.name.startswith("_")
    ]
    own = ["robokin.transform", "robokin.quaternion", "robokin.units"]
    return [*own, *parts, "robokin.show", "robokin.course"]


def _described(name: str) -> str:
    """The entry for a module in the list of modules, with the first sentence of its docstring."""
    words = " ".join((importlib.import_module(name).__doc__ or "").split())
    return f"- [`{name}`]({name}.rst)\\\n  {re.split(r'(?<=[.])(?: |$)', words)[0]}"


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(exist_ok=True)
    path.write_text(text, encoding="utf-8")


# --- Running Sphinx, and installing its pages -----------------------------------------------------


def _run(source: Path, made: Path, repository: str = "") -> str:
    """Run Sphinx and return its warnings. Raises ValueError if it fails."""
    flags = ["-q", "-j", "auto", "-d", str(source.with_name("read"))]
    flags += ["-A", f"repository={repository}"]  # for page.html
    paths = (str(HERE.parents[2]), os.environ.get("PYTHONPATH", ""))
    run = subprocess.run(
        [sys.executable, "-m", "sphinx", *flags, str(source), str(made)],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(paths), "PYTHONIOENCODING": "utf-8"},
        encoding="utf-8",
        errors="replace",
        capture_output=True,
    )
    complaints = run.stderr.replace(f"{source}{os.sep}", "").strip()
    if run.returncode:
        raise ValueError(f"Sphinx failed: {complaints}")
    return complaints


def _older(folder: Path) -> set[str]:
    """The file names of an existing site. Raises ValueError if something else is there."""
    if (folder / MARK).is_file():
        names = (folder / MARK).read_text(encoding="utf-8").split("\n")
        return {name for name in names if name and ".." not in name and not name.startswith("/")}
    if folder.exists() and not (folder.is_dir() and not any(folder.iterdir())):
        raise ValueError(f"{folder}: neither empty nor a robokin site; nothing was overwritten")
    return set()


def _put(made: Path, folder: Path) -> None:
    """Write each file atomically, replacing the older site's file; other files are kept."""
    old = _older(folder)
    new = {p.relative_to(made).as_posix() for p in made.rglob("*") if p.is_file()}
    for name in sorted(new - old):
        if os.path.lexists(folder / name):
            raise ValueError(f"{folder / name}: not a file of the site; nothing was overwritten")
    folder.mkdir(parents=True, exist_ok=True)
    # written before the files, so that an interrupted build is recognised
    _write(folder / MARK, "\n".join(sorted(old | new)))
    for name in sorted(new):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(made / name, folder / f"{MARK}.part")
        os.replace(folder / f"{MARK}.part", folder / name)
    for name in old - new:
        (folder / name).unlink(missing_ok=True)
    _write(folder / MARK, "\n".join(sorted(new)))
