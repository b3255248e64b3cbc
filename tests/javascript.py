"""The tools of the page's scripts, Prettier and TypeScript, in the versions of js/package-lock.json
and with PyPI's Node:

    python tests/javascript.py prettier --write robokin/show/js
    python tests/javascript.py tsc

npm lays them, once for each lock file, into the user's cache, so that nothing of them stands in
the tree.
"""

import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from conftest import NODE, ROOT

HERE = ROOT / "tests" / "js"
PROGRAMS = {
    "prettier": ("prettier/bin/prettier.cjs", f"--config={HERE / 'prettier.config.json'}"),
    "tsc": ("typescript/bin/tsc", f"--project={HERE / 'tsconfig.json'}"),
}
UNREACHABLE = ("ENOTFOUND", "EAI_AGAIN", "ECONNREFUSED", "ECONNRESET", "ENETUNREACH", "TIMEDOUT")


class NoNetwork(Exception):
    """The tools are not there, and the registry cannot be reached."""


def tools():
    """The folder of the installed packages. Another process may install them at the same time:
    each works in a folder of its own, and the first one to end names it.
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
    """A run of "prettier" or "tsc" at the top of the repository."""
    program, settings = PROGRAMS[name]
    command = [NODE, tools() / program, settings, *arguments]
    return subprocess.run(command, cwd=ROOT, text=True, capture_output=True)


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


if __name__ == "__main__":
    run = tool(*sys.argv[1:])
    sys.stdout.write(run.stdout)
    sys.stderr.write(run.stderr)
    sys.exit(run.returncode)
