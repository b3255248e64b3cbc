"""Run Prettier and TypeScript on the scripts of the page, in the versions that js/package-lock.json
specifies and with Node from PyPI:

    python tests/javascript.py prettier --write robokin/show/js
    python tests/javascript.py tsc
    python tests/javascript.py types    # writes page.d.ts and kinds.js in robokin/show/js

npm installs them once per lock file in the user's cache, so that the working tree stays clean.
"""

import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from types import UnionType
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints, is_typeddict

from conftest import NODE, ROOT

from robokin.show import motors, numbers, page, things, twin

HERE = ROOT / "tests" / "js"
PROGRAMS = {
    "prettier": ("prettier/bin/prettier.cjs", "--config", HERE / "prettier.config.json"),
    "tsc": ("typescript/bin/tsc", "--project", HERE / "tsconfig.json"),
}
UNREACHABLE = ("ENOTFOUND", "EAI_AGAIN", "ECONNREFUSED", "ECONNRESET", "ENETUNREACH", "TIMEDOUT")


class NoNetwork(Exception):
    """Raised if the tools are missing and the registry cannot be reached."""


def tools():
    """The folder of the installed packages. Several processes may install them at the same time:
    each uses its own folder, and the first one to finish renames its folder.
    """
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "robokin-js"
    home = cache / hashlib.sha256((HERE / "package-lock.json").read_bytes()).hexdigest()[:16]
    if not home.is_dir():
        cache.mkdir(parents=True, exist_ok=True)
        beside = Path(tempfile.mkdtemp(dir=cache))
        try:
            _install(beside)
            beside.rename(home)
        except OSError:
            if not home.is_dir():
                raise
        finally:
            shutil.rmtree(beside, ignore_errors=True)
    return home / "node_modules"


def tool(name, *arguments):
    """Run "prettier" or "tsc" in the top folder of the repository; return the finished process."""
    program, *settings = PROGRAMS[name]
    command = [NODE, tools() / program, *settings, *arguments]
    return subprocess.run(command, cwd=ROOT, text=True, capture_output=True)


def written():
    """The scripts that are generated from Python: a dict that maps paths to texts."""
    js = ROOT / "robokin/show/js"
    return {js / "page.d.ts": page_types(), js / "kinds.js": kinds()}


def kinds():
    """The text of js/kinds.js, which imports the script of each kind of `things.PageThing`."""
    names = [get_args(get_type_hints(table)["kind"])[0] for table in KINDS]
    imports = "".join(f'import {{{name}}} from "./{name}.js";\n' for name in sorted(names))
    return (
        "// Written by `python tests/javascript.py types` from PageThing in things/__init__.py.\n\n"
        f"{imports}\n/** The kinds of things, in the order in which they are drawn. */\n"
        f"export const kinds = {{{', '.join(names)}}};\n"
    )


def page_types():
    """The text of js/page.d.ts: the TypedDicts of the page data as TypeScript types."""
    tables = {
        name: table
        for module in (
            numbers,
            *[sys.modules[table.__module__] for table in KINDS],
            page,
            twin,
            motors,
        )
        for name, table in vars(module).items()
        if is_typeddict(table)
    }
    parts = [
        "// Written by `python tests/javascript.py types` from the TypedDicts of page.py, twin.py,",
        "// numbers.py, motors.py and things/, which describe every key. Edit those files instead.",
        "",
        "/** T in which these optional keys are present. */",
        "export type With<T, K extends keyof T> = T & Required<Pick<T, K>>;",
    ]
    for name, kind in ALIASES.items():
        types = _typed(kind, alias=False)
        line = f"export type {name} = {types};"
        if len(line) > 100:  # as prettier wraps it
            more = f"  {types};"
            if len(more) > 100:
                more = "".join(f"\n  | {each}" for each in types.split(" | "))[1:] + ";"
            line = f"export type {name} =\n{more}"
        parts += ["", line]
    for name, table in tables.items():
        parts += ["", f"export interface {name} {{"]
        for key, kind in get_type_hints(table).items():
            mark = "" if key in table.__required_keys__ else "?"
            parts.append(f"  {key}{mark}: {_typed(kind)};")
        parts.append("}")
    return "\n".join(parts) + "\n"


def _install(folder):
    for name in ("package.json", "package-lock.json"):
        shutil.copy(HERE / name, folder)
    package = NODE.parent if os.name == "nt" else NODE.parent.parent
    npm = next(package.glob("**/node_modules/npm/bin/npm-cli.js"))
    quick = ("--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=1")
    command = [NODE, npm, "ci", *quick, "--fetch-retry-mintimeout=1000"]
    done = subprocess.run(command, cwd=folder, text=True, capture_output=True, timeout=300)
    if done.returncode:
        kind = NoNetwork if any(word in done.stderr for word in UNREACHABLE) else RuntimeError
        raise kind(f"npm ci:\n{done.stderr[-1000:]}")


PLAIN = {str: "string", float: "number", int: "number", bool: "boolean", Any: "unknown"}
ALIASES = {"PageExplorer": page.PageExplorer, "Scale": numbers.Scale, "Inverse": twin.Inverse}
ALIASES |= {"PageThing": things.PageThing}
KINDS = get_args(things.PageThing)
PLAIN |= {type(None): "null"}


def _typed(kind, alias=True):
    """A Python type in TypeScript notation."""
    origin, inner = get_origin(kind), get_args(kind)
    if alias and kind in ALIASES.values():
        return next(name for name, known in ALIASES.items() if known == kind)
    if is_typeddict(kind):
        return kind.__name__
    if kind in PLAIN:
        return PLAIN[kind]
    if origin in (Union, UnionType):
        return " | ".join(dict.fromkeys(map(_typed, inner)))
    if origin is Literal:
        return " | ".join(json.dumps(each) for each in inner)
    if origin is list:
        one = _typed(inner[0])
        return f"({one})[]" if " | " in one and one[0] != "(" else f"{one}[]"
    if origin is tuple and inner[-1] is ...:
        return f"{_typed(inner[0])}[]"
    if origin is tuple:
        return f"[{', '.join(map(_typed, inner))}]"
    if origin is dict and inner[0] is str:
        return f"Record<string, {_typed(inner[1])}>"
    raise TypeError(f"no TypeScript type for {kind}")


if __name__ == "__main__":
    if sys.argv[1:] == ["types"]:
        for path, text in written().items():
            path.write_text(text, encoding="utf-8")
            print(path.relative_to(ROOT).as_posix())
        sys.exit()
    run = tool(*sys.argv[1:])
    sys.stdout.write(run.stdout)
    sys.stderr.write(run.stderr)
    sys.exit(run.returncode)
