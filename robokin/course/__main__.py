"""python -m robokin.course COMMAND: what a course does with its labs as files."""

import argparse
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; the exit status: 0, or 1 if a file could not be used."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")  # a name that the terminal cannot show
    parser = argparse.ArgumentParser(prog="python -m robokin.course", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    export = commands.add_parser(
        "export",
        help="one page for each lab, alive without a network",
        description="Write LAB.html for each LAB.ipynb: one page that needs no network and no "
        "Python. Players, explorers and predictions are alive in it.",
    )
    export.add_argument("labs", nargs="+", metavar="LAB", type=Path, help="a notebook (.ipynb)")
    export.add_argument(
        "--to", metavar="FOLDER", type=Path, default=Path(), help="where (default: here)"
    )
    copy = commands.add_parser(
        "copy",
        help="the labs into a student's folder; again when there are newer ones",
        description="Lay the labs into FOLDER, trusted. Run again, it replaces what was not "
        "touched (running is not touching) and keeps the student's work: the newer lab is then "
        "laid beside it, NAME.new.ipynb.",
    )
    copy.add_argument("folder", metavar="FOLDER", type=Path, help="the student's folder")
    copy.add_argument(
        "--from",
        dest="source",
        metavar="FOLDER",
        type=Path,
        help="where the labs are (default: in the clone that robokin is installed from)",
    )
    site = commands.add_parser(
        "site",
        help="all labs and the package's reference as pages, alive without Python",
        description="Write a site into FOLDER: labs, companions, glossary, notes for teachers, the "
        "package's reference, a search. Open its index.html, or lay the folder on any server.",
    )
    site.add_argument("folder", metavar="FOLDER", type=Path, help="a new one, or a site's")
    given = parser.parse_args(argv)
    if given.command == "site":
        return _site(given.folder)
    if given.command == "copy":
        return _copy(given.folder, given.source)
    return _export(given.labs, given.to)


def _copy(folder: Path, source: Path | None) -> int:
    from .copies import copy

    try:
        outcomes = copy(folder, source)
    except ModuleNotFoundError as error:
        print(f"{error}; pip install 'robokin[labs]' brings it", file=sys.stderr)
        return 1
    except (OSError, ValueError) as error:
        print(f"{folder}: {error}", file=sys.stderr)
        return 1
    counts = Counter(outcome.what for outcome in outcomes)
    for outcome in outcomes:
        if outcome.what != "same":
            failed = outcome.what == "failed"
            print(f"{outcome.path}: {outcome.says}", file=sys.stderr if failed else sys.stdout)
    same = counts["same"]
    news = [f"{counts[what]} {what}" for what in ("new", "replaced", "kept", "failed")]
    news = [each for each in news if not each.startswith("0 ")]
    print(f"{folder}: {', '.join(news) or 'nothing new'}; {same} as they were")
    return 1 if counts["failed"] else 0


def _export(labs: Sequence[Path], folder: Path) -> int:
    try:
        from .export import export
    except ModuleNotFoundError as error:
        print(f"{error}; pip install 'robokin[labs]' brings it", file=sys.stderr)
        return 1
    failed = 0
    for path in labs:
        page = folder / f"{path.stem}.html"
        try:
            export(path, page)
        except (OSError, ValueError) as error:
            failed += 1
            print(f"{path}: {error}", file=sys.stderr)
        else:
            print(f"{page}: {page.stat().st_size / 1e3:.0f} kB")
    return 1 if failed else 0


def _site(folder: Path) -> int:
    from .site import build

    print("The site is being made; this takes half a minute.", flush=True)
    try:
        complaints = build(folder)
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 1
    print(folder / "index.html")
    if complaints:
        print(complaints, file=sys.stderr)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
