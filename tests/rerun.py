"""Readers change cells and run them again. Does that work in every lab?

    python tests/rerun.py                               all labs and companions, every value
    python tests/rerun.py notebooks/05_scara_motion.ipynb ...
    python tests/rerun.py --sample                      one value per line, as the tests do
    python tests/rerun.py --seed 7                      also in a random order

1. All cells run from top to bottom. At a line with `# try`, each value after it replaces the value
   before it, and every cell that depends on the line runs again. No cell may raise an exception,
   and in a figure that changes, no title, label or alternative text may contain a hard-coded
   number. Each value is tried in a fork of the process, in the state that the cells above left.
2. Then each cell runs again alone, from last to first, and must give the same output.
"""

import argparse
import ast
import contextlib
import io
import json
import os
import random
import re
import sys
import time
import traceback
import types
from pathlib import Path

from robokin.course.page.cells import global_names, reads

ROOT = Path(__file__).resolve().parent.parent
FORKS = hasattr(os, "fork")  # each value is tried in a fork
TRY = re.compile(r"^(?P<head>\s*[A-Za-z_][\w, \[\]]*? = )(?P<value>.*?)  # try (?P<more>.+)$")
# Numbers that are part of a name. All other numbers in the text of a figure are results or inputs,
# and must be computed.
NAMES = re.compile(
    r"IRB-140|PUMA ?560|\b[23]-?D\b|\b(?:source|companion) 00\d\b"
    r"|\b(?:[Jj]oint|[Aa]xis|[Aa]rm|[Rr]ow|[Ll]ab|[Ll]ever|[Ll]ink|[Mm]otor|[Cc]oil|[Pp]hase|[Ff]rame"
    r"|[Ss]ection|[Ee]xercise|[Oo]bject|[Pp]oint|[Aa]xes|[Jj]oints|[Rr]ows|[Ll]evers|[Ll]inks)"
    r"(?: \d\b(?:,| and| to| or)?)+"
    r"|[A-Za-zα-ωΑ-Ω]_?\{?\d\}?(?!\d)|[A-Za-zα-ω]+\d\b"
)  # q1, C2, K1, z_0, l2
# Types whose values never change. Values of robokin's own types do not change either.
FIXED = (types.ModuleType, types.FunctionType, type, str, float, int, tuple)
ASKED = re.compile(r"^(predict|check|progress|hint|solution|variant)\(")


class Cell:
    """A code cell: its source, and the names that it reads, sets and changes."""

    def __init__(self, source: str) -> None:
        self.source = source
        tree = ast.parse(source)
        self.reads = reads(tree.body, set())  # names read before the cell sets them
        self.writes = global_names(compile(tree, "cell", "exec"))[1]
        self.changed: set[str] = set()  # in place: values[3] = 1, names.append("C")
        for node in ast.walk(tree):
            if isinstance(node, ast.Attribute) or (
                isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Store)
            ):
                base = node.value
                while isinstance(base, (ast.Subscript, ast.Attribute)):
                    base = base.value
                if isinstance(base, ast.Name):
                    self.changed.add(base.id)
        formats = {
            id(part)
            for node in ast.walk(tree)
            if isinstance(node, ast.FormattedValue) and node.format_spec
            for part in ast.walk(node.format_spec)
        }
        self.typed = {
            part.strip()
            for node in ast.walk(tree)
            if isinstance(node, ast.Constant) and isinstance(node.value, str)
            for part in [NAMES.sub(" ", node.value)]
            if re.search(r"\d", part) and id(node) not in formats
        }

    def tries(self) -> list[tuple[int, str]]:
        """Return the line number and the line with another value, for each value after `# try`."""
        found = []
        for n, line in enumerate(self.source.splitlines()):
            if "# try" not in line:
                continue
            match = TRY.match(line)
            if not match:
                raise ValueError(f"wanted `name = value  # try value, value`, got: {line.strip()}")
            ast.parse(f"{match['head'].strip()} {match['value']}")
            values = ast.parse(f"({match['more']},)", mode="eval").body.elts
            found += [(n, match["head"] + ast.unparse(value)) for value in values]
        return found


class Run:
    """A lab in this process: `space` is the namespace that its kernel would have."""

    def __init__(self, path: Path) -> None:
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        code = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
        self.cells = [Cell(source) for source in code if source.strip()]
        module = types.ModuleType("__main__")
        self.space = module.__dict__

    def run(self, k: int, source: str | None = None) -> "Shown":
        """Run cell k; return what it prints and the value of its last expression."""
        source = self.cells[k].source if source is None else source
        body = ast.parse(source).body
        last = body.pop() if body and isinstance(body[-1], ast.Expr) else None
        printed, value = io.StringIO(), None
        with contextlib.redirect_stdout(printed):
            exec(compile(ast.Module(body, []), f"cell {k + 1}", "exec"), self.space)
            if last is not None:
                value = eval(
                    compile(ast.Expression(last.value), f"cell {k + 1}", "eval"), self.space
                )
        if source.rstrip().endswith(";"):
            value = None
        return Shown(printed.getvalue(), value)

    def reached(self, k: int) -> list[int]:
        """The cells after k that use what cell k sets or changes, and the cells that these need."""
        names, found = self._left(k), []
        later = [n for n in range(k + 1, len(self.cells)) if not ASKED.match(self.cells[n].source)]
        for n in later:
            if self.cells[n].reads & names:
                found.append(n)
                names = names | self._left(n)
            else:  # the names that it sets get the same values as before
                names = names - self.cells[n].writes
        for n in reversed(later):
            wanted = set().union(*(self.cells[m].reads for m in found if m > n))
            if n not in found and self._left(n) & wanted:
                found = sorted({n, *found})
        return found

    def _left(self, k: int) -> set[str]:
        """The names that cell k sets, and those whose mutable values it changes."""
        fixed = {
            name
            for name, value in self.space.items()
            if isinstance(value, FIXED) or type(value).__module__.startswith("robokin.")
        }
        return self.cells[k].writes | (self.cells[k].changed - fixed)


class Shown:
    """The output of a cell: its printed text and the text of its result; for a figure or a player
    also its text and what is drawn.
    """

    def __init__(self, printed: str, value) -> None:
        self.text = printed + ("" if value is None else repr(value))
        self.words: list[str] = []
        self.drawn = ""
        if hasattr(value, "alt") and hasattr(value, "axes"):
            self.words, self.drawn = _figure(value)
        elif hasattr(value, "data") and hasattr(value, "still"):
            self.words = [value.data.get("title") or "", value.still.alt]
            self.drawn = json.dumps({**value.data, "title": ""}, sort_keys=True, default=str)


def _figure(fig) -> tuple[list[str], str]:
    words, drawn = [fig.alt], []
    words += [text.get_text() for text in fig.texts]
    for ax in fig.axes:
        words += [ax.get_title(loc) for loc in ("left", "center", "right")]
        words += [ax.get_xlabel(), ax.get_ylabel(), *(text.get_text() for text in ax.texts)]
        if ax.get_legend():
            words += [text.get_text() for text in ax.get_legend().get_texts()]
        drawn += [line.get_xydata().round(9).tolist() for line in ax.lines]
        drawn += [c.get_offsets().round(9).tolist() for c in ax.collections]
        drawn += [p.get_path().vertices.round(9).tolist() for p in ax.patches]
        drawn += [image.get_array().tolist() for image in ax.images]
    return [word for word in words if word], json.dumps(drawn)


def faults(
    path: Path, sample: bool = False, seed: int | None = None
) -> tuple[int, list[str], list[str]]:
    """Return the number of values tried, the faults that they cause, and the faults when each cell
    runs again alone: from last to first and, with a `seed`, also in a random order. With `sample`,
    one value is tried for each line.
    """
    lab, wrong, reports, shown = Run(path), [], [], []
    with _in(path.parent):
        for k, cell in enumerate(lab.cells):
            try:
                lines = cell.tries() if FORKS else []
            except (SyntaxError, ValueError) as error:
                wrong.append(f"[{k + 1}] {error}")
                lines = []
            if sample:
                lines = list(dict(random.Random(path.stem).sample(lines, len(lines))).items())
            for n, line in lines:
                rows = cell.source.splitlines()
                rows[n] = line
                reports.append((k, line.strip(), _forked(lab, k, "\n".join(rows))))
            shown.append(lab.run(k))
        orders = [list(reversed(range(len(lab.cells))))]
        if seed is not None:
            orders.append(random.Random(seed).sample(orders[0], len(lab.cells)))
        again = [fault for order in orders for fault in _again(lab, order, shown)]
    for k, line, report in reports:
        wrong += _told(lab, shown, f"[{k + 1}] {line}", report)
    return len(reports), list(dict.fromkeys(wrong)), again


def _again(lab: Run, order: list[int], shown: list["Shown"]) -> list[str]:
    wrong = []
    for k in order:
        try:
            text = lab.run(k).text
        except Exception as error:
            wrong.append(f"[{k + 1}] on a later run: {type(error).__name__}: {error}")
            continue
        if text != shown[k].text:
            a, b = _differ(shown[k].text, text)
            wrong.append(f"[{k + 1}] printed {b!r} on a later run and {a!r} on the first")
    return wrong


def _told(lab: Run, shown: list["Shown"], name: str, report) -> list[str]:
    """The faults that a tried value causes, found by comparing what the cells show."""
    if isinstance(report, str):
        return [f"{name}: {report}"]
    return [
        f"{name}: [{n + 1}] has the hard-coded text {part!r} in {word!r}"
        for n, words, drawn in report
        if drawn != shown[n].drawn
        for word in words
        for part in lab.cells[n].typed
        if re.search(rf"(?<![\d.]){re.escape(part)}(?!\.?\d)", NAMES.sub(" ", word))
    ]


def _forked(lab: Run, k: int, source: str):
    """The figures of the changed cell k and the cells that depend on it, or an error message."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(read)
        try:
            found = []
            for n in [k, *lab.reached(k)]:
                shown = lab.run(n, source if n == k else None)
                if shown.words:
                    found.append((n, shown.words, shown.drawn))
            answer = json.dumps(found)
        except BaseException as error:
            where = [f for f in traceback.extract_tb(error.__traceback__) if "cell" in f.filename]
            at = where[-1].filename if where else "?"
            answer = json.dumps(f"{at}: {type(error).__name__}: {error}")
        with os.fdopen(write, "w") as pipe:
            pipe.write(answer)
        os._exit(0)
    os.close(write)
    with os.fdopen(read) as pipe:
        answer = pipe.read()
    os.waitpid(child, 0)
    return [tuple(x) for x in found] if isinstance(found := json.loads(answer), list) else found


def _differ(a: str, b: str) -> tuple[str, str]:
    for one, two in zip(a.splitlines(), b.splitlines(), strict=False):
        if one != two:
            return one[:120], two[:120]
    return a[-120:], b[-120:]


@contextlib.contextmanager
def _in(folder: Path):
    before = Path.cwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("notebooks", nargs="*", type=Path)
    parser.add_argument("--sample", action="store_true")
    parser.add_argument("--seed", type=int)
    given = parser.parse_args()
    top = ROOT / "notebooks"
    paths = given.notebooks or [
        *sorted(top.glob("*.ipynb")),
        *sorted(top.glob("documents/*.ipynb")),
    ]
    bad = 0
    for path in (path.resolve() for path in paths):
        start = time.perf_counter()
        try:
            count, wrong, again = faults(path, given.sample, given.seed)
            wrong += again
        except Exception as error:
            count, wrong = 0, [f"does not run: {type(error).__name__}: {error}"]
        bad += bool(wrong)
        word = f"{len(wrong)} faults" if wrong else "stands"
        print(f"{path.name}: {word}, {count} values tried, {time.perf_counter() - start:.1f} s")
        for fault in wrong:
            print("   ", fault)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
