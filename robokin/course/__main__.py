"""python -m robokin.course COMMAND: the commands that work on lab files."""

import argparse
import os
import shutil
import sys
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command and return the exit status: 0, or 1 if a file could not be used."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")  # for names that the stream cannot encode
    options = _parser().parse_args(argv)
    try:
        if "to" in options:
            options.to.mkdir(parents=True, exist_ok=True)
        if getattr(options, "exercises", None):
            _add(options.exercises.resolve())
        return int(options.run(options))
    except OSError as error:
        print(error, file=sys.stderr)
        return 1
    except ModuleNotFoundError as error:
        install = f"pip install '.[{options.extra}]' at the top of a clone of robokin"
        print(f"{error}; install it with {install}", file=sys.stderr)
        return 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m robokin.course", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(
        run: Callable[[Any], int], words: str, description: str, extra: str = "labs"
    ) -> argparse.ArgumentParser:
        name = run.__name__.strip("_")
        made = commands.add_parser(name, help=words, description=description)
        made.set_defaults(run=run, extra=extra)
        return made

    labs: dict[str, Any] = {"nargs": "+", "metavar": "LAB", "type": Path}
    to: dict[str, Any] = {"metavar": "FOLDER", "type": Path, "default": Path()}
    _copy_arguments(command)

    export = command(
        _export,
        "write each lab as one page that works without a network",
        "Write LAB.html for each LAB.ipynb. The page needs neither a network nor Python, and its "
        "players, explorers and predictions work.",
    )
    report = command(
        _report,
        "write your lab as a single page to hand in",
        "Run each LAB.ipynb again and write LAB_NAME.html. The page contains the student's "
        "name, the verdicts on the exercises, the predictions and the lab itself. It works without "
        "a network.",
    )
    summary = command(
        _summary,
        "write the teacher's table of handed-in work",
        "Write summary.csv and summary.html from the reports and notebooks in FOLDER and its "
        "subfolders. They list the students, their results, the frequent mistakes and the wrong "
        "predictions; summary_pages contains a page for each row. Notebooks are judged again, "
        "several at a time; each takes 5 to 60 seconds. Judging runs the students' code with your "
        "permissions, without a sandbox, and that code can forge a verdict: use nbgrader for marks "
        "that matter.",
    )
    for each in (export, report):
        each.add_argument("labs", help="a notebook (.ipynb)", **labs)
    report.add_argument("--name", required=True, help="the student's name")
    summary.add_argument("folder", metavar="FOLDER", type=Path, help="the handed-in work")
    summary.add_argument("--no-points", action="store_true", help="leave out the points")
    for each in (export, report, summary):
        each.add_argument("--to", help="output folder (default: the current one)", **to)
    for each in (report, summary):
        own = "a folder with exercises for labs of your own, one subfolder for each lab"
        each.add_argument("--exercises", metavar="FOLDER", type=Path, help=own)

    _site_arguments(command)
    return parser


def _copy_arguments(command: Callable[..., argparse.ArgumentParser]) -> None:
    copy = command(
        _copy,
        "copy the labs into a student's folder, or update them there",
        "Copy the labs into FOLDER and mark them as trusted. When run again, replace the labs that "
        "the student has not edited (running a lab does not count as editing). An edited lab is "
        "kept, and its newer version is written next to it as NAME.new.ipynb.",
    )
    copy.add_argument("folder", metavar="FOLDER", type=Path, help="the student's folder")
    where = "where the labs are (default: in the clone that robokin is installed from)"
    copy.add_argument("--from", dest="source", metavar="FOLDER", type=Path, help=where)


def _site_arguments(command: Callable[..., argparse.ArgumentParser]) -> None:
    site = command(
        _site,
        "write all labs and the package reference as pages, which run Python themselves",
        "Write a website into FOLDER: the labs, companions, glossary, notes for teachers, package "
        "reference and a search page. Open its index.html, or put the folder on any web server.",
        extra="site",
    )
    site.add_argument(
        "folder", metavar="FOLDER", type=Path, help="a new folder, or one with an earlier site"
    )
    site.add_argument(
        "--no-teaching",
        dest="teaching",
        action="store_false",
        help="leave out the notes for teachers, which contain the answers to the oral questions",
    )
    site.add_argument(
        "--repository",
        metavar="URL",
        default="",
        help="the https address of the repository, which every page then names as the place to "
        "get robokin (default: no page does)",
    )


def _add(folder: Path) -> None:
    """Make the labs in a folder known to this process and to the kernels that it starts. Raises
    OSError if it is not a folder or has no labs.
    """
    from .book import ELSEWHERE, labs

    before = len(labs())
    if not folder.is_dir():
        raise NotADirectoryError(f"--exercises: wanted a folder, got {str(folder)!r}")
    known = [os.environ[ELSEWHERE]] if os.environ.get(ELSEWHERE) else []
    os.environ[ELSEWHERE] = os.pathsep.join([*known, str(folder)])
    for each in labs().values():
        each.read()
        for told in each.broken.values():
            print(told, file=sys.stderr)
    if len(labs()) == before:
        raise FileNotFoundError(f"--exercises: no new lab in {str(folder)!r}")


def _copy(options: Any) -> int:
    from .copies import copy

    try:
        outcomes = copy(options.folder, options.source)
    except (OSError, ValueError) as error:
        print(f"{options.folder}: {error}", file=sys.stderr)
        return 1
    counts = Counter(outcome.what for outcome in outcomes)
    for outcome in outcomes:
        if outcome.what != "same":
            failed = outcome.what == "failed"
            print(f"{outcome.path}: {outcome.says}", file=sys.stderr if failed else sys.stdout)
    same = counts["same"]
    news = [f"{counts[what]} {what}" for what in ("new", "replaced", "kept", "failed")]
    news = [each for each in news if not each.startswith("0 ")]
    print(f"{options.folder}: {', '.join(news) or 'nothing new'}; {same} unchanged")
    return 1 if counts["failed"] else 0


def _export(options: Any) -> int:
    from .export import export

    def written(path: Path) -> Path:
        page: Path = options.to / f"{path.stem}.html"
        export(path, page)
        return page

    return _each(options.labs, written)


def _report(options: Any) -> int:
    from .report_page import report

    return _each(options.labs, lambda path: report(path, options.name, options.to))


def _each(labs: Sequence[Path], written: Callable[[Path], Path]) -> int:
    """Write each lab as a page. Report failures, and write the other labs all the same."""
    failed = 0
    for path in labs:
        try:
            page = written(path)
        except (OSError, ValueError) as error:
            failed += 1
            print(f"{path}: {error}", file=sys.stderr)
        else:
            print(f"{page}: {page.stat().st_size / 1e3:.0f} kB", flush=True)
    return 1 if failed else 0


def _summary(options: Any) -> int:
    from .summary import summary
    from .summary_pages import is_ours, places, write

    live = sys.stdout.isatty()
    width = shutil.get_terminal_size().columns - 1

    def tell(done: int, of: int, line: str) -> None:
        if live:
            line = f"\r{f'{done} of {of}: {line}'[:width]:{width}}"
        print(line, end="" if live else "\n", flush=True)

    try:
        places(options.to)  # fail now, not after running notebooks for minutes
        made = summary(options.folder, tell=tell, ours=lambda path: is_ours(path, options.to))
        if live:
            print()
        for each in made.left_out:
            line = f"{options.folder}/{each.file}: {each.reason}"
            print(line, file=sys.stderr if each.wrong else sys.stdout)
        for path in write(made, options.to, not options.no_points):
            print(path)
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 1
    return 1 if any(each.wrong for each in made.left_out) else 0


def _site(options: Any) -> int:
    from .site import build

    print("Building the site; this takes about a minute.", flush=True)
    try:
        complaints = build(options.folder, options.teaching, options.repository)
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 1
    print(options.folder / "index.html")
    if complaints:
        print(complaints, file=sys.stderr)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
