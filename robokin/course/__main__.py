"""python -m robokin.course COMMAND: what a course does with its labs as files."""

import argparse
import sys
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
    report = commands.add_parser(
        "report",
        help="one page of your lab to hand in",
        description="Run LAB.ipynb anew and write LAB_NAME.html for each: who, what holds of its "
        "exercises, the predictions made, and the lab, alive without a network.",
    )
    report.add_argument("labs", nargs="+", metavar="LAB", type=Path, help="a notebook (.ipynb)")
    report.add_argument("--name", required=True, help="who hands it in")
    report.add_argument(
        "--to", metavar="FOLDER", type=Path, default=Path(), help="where (default: here)"
    )
    summary = commands.add_parser(
        "summary",
        help="the teacher's table of what was handed in",
        description="Write summary.csv and summary.html over the reports and notebooks below "
        "FOLDER: who, what holds, which mistakes are frequent, which predictions went wrong. "
        "Notebooks are judged anew, which takes 5 to 60 seconds each.",
    )
    summary.add_argument("folder", metavar="FOLDER", type=Path, help="what was handed in")
    summary.add_argument(
        "--to", metavar="FOLDER", type=Path, default=Path(), help="where (default: here)"
    )
    given = parser.parse_args(argv)
    if given.command == "report":
        return _report(given.labs, given.name, given.to)
    if given.command == "summary":
        return _summary(given.folder, given.to)
    return _export(given.labs, given.to)


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


def _report(labs: Sequence[Path], name: str, folder: Path) -> int:
    try:
        from .report import report
    except ModuleNotFoundError as error:
        print(f"{error}; pip install 'robokin[labs]' brings it", file=sys.stderr)
        return 1
    failed = 0
    for path in labs:
        try:
            page = report(path, name, folder)
        except (OSError, ValueError) as error:
            failed += 1
            print(f"{path}: {error}", file=sys.stderr)
        else:
            print(f"{page}: {page.stat().st_size / 1e3:.0f} kB", flush=True)
    return 1 if failed else 0


def _summary(folder: Path, to: Path) -> int:
    try:
        from .summary import places, summary, write
    except ModuleNotFoundError as error:
        print(f"{error}; pip install 'robokin[labs]' brings it", file=sys.stderr)
        return 1
    try:
        places(to)  # before notebooks run for minutes
        made = summary(folder, tell=lambda line: print(line, flush=True))
        for file, reason in made.broken:
            print(f"{folder / file}: {reason}", file=sys.stderr)
        for path in write(made, to):
            print(path)
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 1
    return 1 if made.broken else 0


if __name__ == "__main__":
    sys.exit(main())
