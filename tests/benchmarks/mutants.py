"""Do the tests detect wrong programs? The script inserts small faults into the package, one at a
time, and runs the tests that use the changed module until one fails.

    python tests/benchmarks/mutants.py                        300 of all modules, about 20 minutes
    python tests/benchmarks/mutants.py --count 60 robokin/quaternion.py robokin/transform.py
    python tests/benchmarks/mutants.py --list robokin/motion/paths.py     what could be changed
    python tests/benchmarks/mutants.py --seed 7                           another sample

The faults are: a different operator or comparison (`<` for `<=`), a negated or dropped condition, a
different constant, a similar function (argmin for argmax), a dropped call, keyword or statement,
and a missing result. Messages, docstrings and annotations are not changed. Faults without a visible
effect are listed in `equivalent_mutants.toml`, each with its reason, and are left out. A fault
whose run takes too long counts as detected.

The aim is to detect at least 97 % of 300 faults. The others are printed: each needs a test or a
reason.

The processes that run the tests are forked from one that has loaded NumPy, SciPy, pytest and
Hypothesis; each works on its own copy of the package, with a few Hypothesis examples that are
always the same. Linux and macOS only.
"""

import argparse
import ast
import copy
import hashlib
import itertools
import os
import re
import shutil
import signal
import sys
import tempfile
import time
import tomllib
import warnings
from collections import Counter, defaultdict
from dataclasses import dataclass
from functools import cache
from pathlib import Path

for _library in ("OMP", "OPENBLAS", "MKL"):  # before NumPy starts its threads
    os.environ[f"{_library}_NUM_THREADS"] = "1"

ROOT = Path(__file__).resolve().parent.parent.parent
EQUIVALENT = Path(__file__).with_name("equivalent_mutants.toml")
WORKERS = 2
SECONDS = 120  # time limit for all tests of one mutant
MEMORY = 8 << 30  # bytes of address space: a fault may request any amount

# The tests that may detect a fault in a module, the most likely ones first: a file, or a file with
# an expression for -k.
TESTS = {
    "robokin/quaternion.py": ["quaternion", "transform", "paths"],
    "robokin/transform.py": ["transform", "arm", "paths"],
    "robokin/arms/arm.py": ["arm", "geometry", "branches", "oracle_irb140"],
    "robokin/arms/link.py": ["arm", "geometry", "spherical_wrist", "oracle_irb140"],
    "robokin/arms/geometry.py": ["geometry", "elbow", "two_link", "scara", "branches"],
    "robokin/arms/explanations.py": ["branches", "elbow", "scara", "two_link"],
    "robokin/arms/branches.py": ["branches", "spherical_wrist", "elbow", "scara", "geometry"],
    "robokin/arms/catalogue.py": ["arm", "geometry", "oracle_irb140", "loader", "elbow", "scara"],
    "robokin/arms/dexterity.py": ["dexterity", "arm"],
    "robokin/arms/elbow.py": ["elbow", "geometry", "spherical_wrist", "branches", "loader"],
    "robokin/arms/planar.py": ["planar", "geometry", "branches"],
    "robokin/arms/two_link.py": ["two_link", "geometry", "branches"],
    "robokin/arms/scara.py": ["scara", "geometry", "branches", "errata_s1"],
    "robokin/arms/spherical_wrist.py": ["spherical_wrist", "geometry", "branches", "oracle_irb140"],
    "robokin/motion/laws.py": ["laws", "arm"],
    "robokin/motion/paths.py": ["paths", "errata_s1"],
    "robokin/motion/derivatives.py": ["derivatives", "recording"],
    "robokin/motion/recording.py": ["recording", "plots"],
    "robokin/jobs/__main__.py": ["jobs_command"],
    "robokin/jobs/visit_collect/arm.py": ["visit_collect", "jobs_command"],
    "robokin/jobs/visit_collect/report_text.py": ["visit_collect", "jobs_command"],
    "robokin/jobs/visit_collect/solver.py": ["visit_collect", "jobs_command"],
    "robokin/jobs/visit_collect/task.py": ["visit_collect", "jobs_command"],
    "robokin/jobs/obstacles/arguments.py": ["obstacles", "moving"],
    "robokin/jobs/obstacles/collision.py": ["obstacles", "moving"],
    "robokin/jobs/obstacles/planner.py": ["obstacles", "moving"],
    "robokin/jobs/obstacles/posture_grid.py": ["posture_grid", "obstacles", "moving"],
    "robokin/jobs/obstacles/ways.py": ["obstacles -k nearest_approach", "live -k unchecked_paths"],
    "robokin/jobs/moving.py": ["moving"],
    "robokin/jobs/steppers/moves.py": ["steppers", "loader"],
    "robokin/jobs/steppers/phase_table.py": ["steppers"],
    "robokin/jobs/steppers/rotor.py": ["steppers"],
}
# Tests that run after these for every module, since tests of drawings are slow and detect few
# faults.
ALL = [
    "wrong_input",
    "read_only",
    "wrong_calls -k not (plot or animate or explorer or Explorer or Player or Output)",
]


# ---- The faults


@dataclass(frozen=True, eq=False)
class Mutant:
    """One fault in `module`, in the statement that begins with `line`; `change` describes it, and
    `number` distinguishes equal ones. `where` is the path to the changed node, `new` its new value.
    """

    module: str
    line: str
    change: str
    number: int
    where: tuple
    new: ast.AST

    @property
    def key(self):
        return self.module, self.line, self.change

    def rank(self, seed):
        """The rank of the fault in the sample, independent of the other faults."""
        return hashlib.sha256(repr((seed, *self.key, self.number)).encode()).hexdigest()

    def source(self):
        """The whole module with the fault; None if it is not a valid program."""
        tree = _put(copy.deepcopy(_tree(self.module)), self.where, self.new)
        try:
            source = ast.unparse(ast.fix_missing_locations(tree))
            with warnings.catch_warnings(action="ignore"):
                compile(source, self.module, "exec")
        except (SyntaxError, ValueError):
            return None
        return source


ARITHMETIC = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Div,
    ast.Mod: ast.Mult,
    ast.Pow: ast.Mult,
    ast.BitAnd: ast.BitOr,
    ast.BitOr: ast.BitAnd,
    ast.LShift: ast.RShift,
    ast.RShift: ast.LShift,
}
COMPARISON = {
    ast.Lt: (ast.LtE, ast.Gt),
    ast.LtE: (ast.Lt, ast.GtE),
    ast.Gt: (ast.GtE, ast.Lt),
    ast.GtE: (ast.Gt, ast.LtE),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
}
PAIRS = (
    "argmin argmax, min max, minimum maximum, fmin fmax, nanmin nanmax, nanargmin nanargmax, "
    "sin cos, arcsin arccos, floor ceil, any all, zeros ones, zeros_like ones_like, and or, "
    "sum prod, cumsum cumprod, flatnonzero nonzero, isnan isfinite, vstack hstack, sorted reversed"
)
SWAPPED = {}
for _pair in PAIRS.split(", "):
    _a, _b = _pair.split()
    SWAPPED |= {_a: _b, _b: _a}
# Calls and keywords that matter only to readers or to the type checker; `strict` only reports our
# own mistakes.
SILENT_CALLS = {"TypeVar", "warn", "overload", "cast"}
SILENT_KEYWORDS = {"strict"}


def mutants(module):
    """All possible faults in a module, given as a path below the repository."""
    counts = Counter()
    for statement, path in _statements(_tree(module)):
        line, bare = _line(statement), _bare(statement)
        seen = {ast.unparse(bare)}
        for where, new, change in _faults(statement):
            changed = new if not where else _put(copy.deepcopy(bare), where, new)
            text = ast.unparse(changed)
            if text not in seen:  # duplicates are skipped
                seen.add(text)
                counts[line, change] += 1
                yield Mutant(module, line, change, counts[line, change], (*path, *where), new)


@cache
def _tree(module):
    return ast.parse((ROOT / module).read_text(encoding="utf-8"))


def _statements(tree):
    """Yield every statement that has an effect, and the path to it: a list of (field, index)."""

    def walk(body, path, field):
        for i, statement in enumerate(body):
            here = (*path, (field, i))
            kinds = (ast.Import, ast.ImportFrom, ast.Assert, ast.Pass, ast.Global)
            text = isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
            names = isinstance(statement, ast.Assign) and ast.unparse(statement)[:2] == "__"
            names |= "TypeAlias" in ast.unparse(getattr(statement, "annotation", ast.Pass()))
            stub = isinstance(statement, ast.FunctionDef) and _is_stub(statement)
            if isinstance(statement, kinds) or text or names or stub:
                continue
            yield statement, here
            for inner in ("body", "orelse", "finalbody"):
                yield from walk(getattr(statement, inner, ()), here, inner)
            for k, handler in enumerate(getattr(statement, "handlers", ())):
                yield from walk(handler.body, (*here, ("handlers", k)), "body")

    yield from walk(tree.body, (), "body")


def _is_stub(function):
    """Whether a function only declares a type: an overload, or a member of a protocol."""
    body = [s for s in function.body if not isinstance(getattr(s, "value", None), ast.Constant)]
    overload = any("overload" in ast.unparse(d) for d in function.decorator_list)
    return overload or not body


def _faults(statement):
    """Yield the path to a node of the statement, its replacement and the change in words."""
    kind = type(statement)
    if kind in (ast.Expr, ast.Assign, ast.AugAssign, ast.Raise) and _can_go(statement):
        yield (), ast.Pass(), "removed"
    if kind is ast.Return and statement.value is not None:
        yield (("value", None),), ast.Constant(None), "returns None"
    if kind in (ast.If, ast.While) and not isinstance(statement.test, (ast.Compare, ast.UnaryOp)):
        yield (("test", None),), ast.UnaryOp(ast.Not(), statement.test), "condition negated"
    if kind in (ast.Continue, ast.Break):
        other = ast.Break() if kind is ast.Continue else ast.Continue()
        yield (), other, f"{ast.unparse(statement)} -> {ast.unparse(other)}"
    if kind is ast.AugAssign and type(statement.op) in ARITHMETIC:
        other = ARITHMETIC[type(statement.op)]()
        changed = _with(statement, op=other)
        yield (("op", None),), other, f"{ast.unparse(statement)} -> {ast.unparse(changed)}"
    alone = getattr(statement, "value", None) if kind is ast.Expr else None
    for node, where in _expressions(statement):
        for changed in _changes(node) if node is not alone else ():
            words = f"{ast.unparse(node)} -> {ast.unparse(changed)}"
            yield where, changed, words if len(words) < 200 else f"{words[:197]}..."


def _can_go(statement):
    """Whether the module still makes sense without the statement."""
    if isinstance(statement, ast.Assign):
        # an undefined name fails at once and tests nothing
        parts = [getattr(target, "elts", [target]) for target in statement.targets]
        return not any(
            isinstance(part, (ast.Name, ast.Starred)) for group in parts for part in group
        )
    return True


def _expressions(statement):
    """The expressions of a statement itself, not those of inner statements."""

    def walk(node, where):
        if isinstance(node, (ast.JoinedStr, ast.stmt)):
            return
        yield node, where
        if isinstance(node, ast.Call) and _called(node) in SILENT_CALLS:
            return
        for field, value in ast.iter_fields(node):
            if field in ("annotation", "returns", "type_comment", "ctx"):
                continue
            if isinstance(node, ast.keyword) and node.arg in SILENT_KEYWORDS:
                continue
            if isinstance(value, ast.AST):
                yield from walk(value, (*where, (field, None)))
            elif isinstance(value, list):
                for i, item in enumerate(value):
                    if isinstance(item, ast.AST):
                        yield from walk(item, (*where, (field, i)))

    if isinstance(statement, ast.Raise):  # the message
        return
    for field, value in ast.iter_fields(statement):
        if field in ("annotation", "returns", "type_comment", "handlers", "simple"):
            continue
        if field in ("body", "orelse", "finalbody"):
            continue
        if isinstance(value, ast.AST):
            yield from walk(value, ((field, None),))
        elif isinstance(value, list):
            for i, item in enumerate(value):
                if isinstance(item, ast.AST):
                    yield from walk(item, ((field, i),))


def _changes(node):
    """Possible replacements of an expression."""
    if isinstance(node, ast.BinOp) and not (_is_text(node.left) or _is_text(node.right)):
        if type(node.op) in ARITHMETIC:
            yield _with(node, op=ARITHMETIC[type(node.op)]())
        if isinstance(node.op, ast.MatMult):
            yield _with(node, left=node.right, right=node.left)
    elif isinstance(node, ast.Compare):
        for i, op in enumerate(node.ops):
            for other in COMPARISON[type(op)]:
                yield _with(node, ops=[*node.ops[:i], other(), *node.ops[i + 1 :]])
    elif isinstance(node, ast.BoolOp):
        yield _with(node, op=ast.Or() if isinstance(node.op, ast.And) else ast.And())
        for i in range(len(node.values)):
            left = node.values[:i] + node.values[i + 1 :]
            yield left[0] if len(left) == 1 else _with(node, values=left)
    elif isinstance(node, ast.UnaryOp):
        yield node.operand
    elif isinstance(node, ast.IfExp):
        yield _with(node, body=node.orelse, orelse=node.body)
    elif isinstance(node, ast.comprehension):
        for i in range(len(node.ifs)):
            yield _with(node, ifs=node.ifs[:i] + node.ifs[i + 1 :])
    elif isinstance(node, ast.Constant):
        for value in _other_constants(node.value):
            yield ast.Constant(value)
    elif isinstance(node, ast.Call):
        yield from _other_calls(node)
    elif isinstance(node, ast.Attribute) and node.attr in SWAPPED:
        yield _with(node, attr=SWAPPED[node.attr])
    elif isinstance(node, ast.Slice):
        for end in ("lower", "upper", "step"):
            if getattr(node, end) is not None:
                yield _with(node, **{end: None})


def _other_constants(value):
    if isinstance(value, bool):
        yield not value
    elif isinstance(value, int):
        yield value + 1
    elif isinstance(value, float):
        # Change a tolerance by powers of ten.
        yield value * (1e4 if 0 < abs(value) < 1e-4 else 2) if value else 1.0


def _other_calls(node):
    name = _called(node)
    if isinstance(node.func, ast.Name) and name in SWAPPED:
        yield _with(node, func=ast.Name(SWAPPED[name], ast.Load()))
    if name == "arctan2":
        yield _with(node, args=node.args[::-1])
    if name in SILENT_CALLS or name[:1].isupper():
        return
    if node.args and not isinstance(node.args[0], ast.Starred) and not _is_text(node.args[0]):
        yield node.args[0]  # the call is dropped
    elif not node.args and not node.keywords and isinstance(node.func, ast.Attribute):
        yield node.func.value
    for i, keyword in enumerate(node.keywords):
        if keyword.arg not in SILENT_KEYWORDS:
            yield _with(node, keywords=node.keywords[:i] + node.keywords[i + 1 :])


def _called(node):
    return getattr(node.func, "attr", getattr(node.func, "id", ""))


def _is_text(node):
    text = isinstance(node, ast.Constant) and isinstance(node.value, str)
    return text or isinstance(node, ast.JoinedStr)


def _with(node, **fields):
    changed = copy.copy(node)
    for name, value in fields.items():
        setattr(changed, name, value)
    return changed


def _put(tree, where, new):
    """The tree with `new` at the end of the path `where`."""
    node, (*way, (field, index)) = tree, where
    for name, i in way:
        node = getattr(node, name) if i is None else getattr(node, name)[i]
    if index is None:
        setattr(node, field, copy.deepcopy(new))
    else:
        getattr(node, field)[index] = copy.deepcopy(new)
    return tree


def _bare(statement):
    """A statement without the statements inside it."""
    inner = {name: [ast.Pass()] for name in ("body", "orelse", "finalbody", "handlers")}
    inner = {name: body for name, body in inner.items() if getattr(statement, name, None)}
    if "handlers" in inner:
        inner["handlers"] = [ast.ExceptHandler(body=[ast.Pass()])]
    return _with(statement, **inner)


def _line(statement):
    """The first line of a statement, as `ast` writes it."""
    bare = _bare(statement)
    if hasattr(bare, "decorator_list"):
        bare.decorator_list = []
    text = ast.unparse(bare).strip().splitlines()[0]
    return text if len(text) < 200 else f"{text[:197]}..."


# ---- Running the tests


def main():
    arguments = _arguments()
    modules = arguments.modules or [m for m in TESTS if (ROOT / m).exists()]
    found = [mutant for module in modules for mutant in mutants(module)]
    left_out = {tuple(m[k] for k in ("module", "line", "change")) for m in _equivalent()}
    stale = {key for key in left_out if key[0] in modules} - {m.key for m in found}
    for key in sorted(stale):
        print("no longer there:", *key, sep="\n    ")
    wanted = [m for m in found if m.key not in left_out]
    wanted.sort(key=lambda m: m.rank(arguments.seed))
    if arguments.only:
        wanted = [m for m in wanted if arguments.only in m.change or arguments.only in m.line]
    programs = ((mutant, source) for mutant in wanted if (source := mutant.source()))
    sample = dict(itertools.islice(programs, arguments.count or None))
    if arguments.list:
        for m in sorted(sample, key=lambda m: (m.module, m.line)):
            print(f"{m.module}  {m.line}\n    {m.change}")
        print(f"{len(sample)} of {len(found)}, {len(left_out)} equivalent ones left out")
        return 0
    print(f"{len(sample)} of {len(found)} faults, {len(found) - len(wanted)} equivalent left out")
    return run(sample)


def run(sample):
    """Run the tests on every mutant in `sample` (a dict that maps a mutant to its source), and
    print the undetected mutants and the percentages.
    """
    _load()
    start, alive, results = time.monotonic(), {}, {}
    with tempfile.TemporaryDirectory(prefix="robokin-mutants-") as folder:
        base = Path(folder) / "base"
        shutil.copytree(ROOT / "robokin", base / "robokin", ignore=_no_cache)
        quickest = _Sorted(_baseline(base, sorted({m.module for m in sample})))
        waiting = list(enumerate(sample))[::-1]
        while waiting or alive:
            while waiting and len(alive) < WORKERS:
                number, mutant = waiting.pop()
                home = Path(folder) / str(number)
                shutil.copytree(base, home, copy_function=os.link)
                (home / mutant.module).unlink()  # the link, not the file
                (home / mutant.module).write_text(sample[mutant], encoding="utf-8")
                alive[_fork(home, _tests(mutant.module), quickest)] = number, home, time.monotonic()
            time.sleep(0.02)
            for child, (number, home, since) in list(alive.items()):
                ended, status = os.waitpid(child, os.WNOHANG)
                slow = time.monotonic() - since > SECONDS
                if not ended and slow:
                    os.killpg(child, signal.SIGKILL)
                    _, status = os.waitpid(child, 0)
                if ended or slow:
                    results[number] = _verdict(status, home, slow and not ended)
                    if not results[number][0]:
                        mutant = next(itertools.islice(sample, number, None))
                        print("NOT DETECTED", *mutant.key, sep="\n    ", flush=True)
                    del alive[child]
                    shutil.rmtree(home)
                    if len(results) % 20 == 0:
                        survived = sum(not noticed for noticed, _ in results.values())
                        print(
                            f"  {len(results)}, {survived} undetected, "
                            f"{time.monotonic() - start:.0f} s",
                            flush=True,
                        )
    return _report(sample, results, time.monotonic() - start)


def _load():
    """Load what every test needs before forking, but not the package itself."""
    import hypothesis
    import numpy  # noqa: F401
    import pytest  # noqa: F401
    import scipy.interpolate
    import scipy.optimize
    import scipy.spatial.transform  # noqa: F401

    if (ROOT / "robokin" / "show").exists():
        import matplotlib.figure  # noqa: F401
    hypothesis.settings.register_profile(
        "mutants", max_examples=25, derandomize=True, deadline=None, database=None
    )
    hypothesis.settings.load_profile("mutants")
    assert "robokin" not in sys.modules


def _tests(module):
    """Lists of arguments for pytest, one list for each run."""
    runs = []
    for entry in dict.fromkeys([*TESTS.get(module, ()), *ALL]):
        name, *chosen = entry.split(" -k ")
        path = ROOT / "tests" / f"test_{name}.py"
        if path.exists():
            runs.append([str(path), *(f"-k={words}" for words in chosen)])
    return runs


def _fork(home, runs, plugin):
    """Fork a child that runs tests on the package in `home`, one list of pytest arguments after
    another; return its process id. Its exit status is 0 if nothing failed.
    """
    sys.stdout.flush()
    child = os.fork()
    if child:
        return child
    status = 3
    try:
        os.setsid()
        log = os.open(home / "log", os.O_WRONLY | os.O_CREAT | os.O_APPEND)
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        os.dup2(log, 1)
        os.dup2(log, 2)
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        os.environ |= {"PYTHONPATH": str(home), "PYTHONDONTWRITEBYTECODE": "1"}
        sys.dont_write_bytecode = True
        sys.path[:0] = [str(home)]
        os.chdir(home)
        status = _run_tests(home, runs, plugin)
    except BaseException as error:
        print(f"{type(error).__name__}: {error}")
    finally:
        sys.stdout.flush()
        os._exit(status)


def _run_tests(home, runs, plugin):
    import pytest

    import robokin

    assert robokin.__file__.startswith(str(home)), robokin.__file__
    options = ["-c", str(ROOT / "pyproject.toml"), "-o", "addopts=", "-p", "no:cacheprovider"]
    options += ["-p", "no:nbval", "-q", "--tb=no", "-rfE", "--no-header"]
    options += ["-W", "ignore::pytest.PytestAssertRewriteWarning"]  # Hypothesis is loaded already
    options += [] if isinstance(plugin, _Watch) else ["-x"]
    for run in runs:
        name = f"tests/{Path(run[0]).name}"
        if isinstance(plugin, _Sorted) and plugin.seconds.get(name) == float("inf"):
            continue  # the fault prevents the import
        status = pytest.main([*options, *run], plugins=[plugin])
        if status not in (0, 5) and "-x" in options:  # 5: no test was selected
            return 1
    return 0


class _Watch:
    """A pytest plugin that records the time of each test, and which tests fail."""

    def __init__(self, path):
        self.path = path

    def pytest_runtest_logreport(self, report):
        with open(self.path, "a") as file:
            file.write(f"{'inf' if report.failed else report.duration} {report.nodeid}\n")

    def pytest_collectreport(self, report):
        if report.failed:
            with open(self.path, "a") as file:
                file.write(f"inf {report.nodeid}\n")


class _Sorted:
    """A pytest plugin that runs the fastest tests first and skips those that fail anyway."""

    def __init__(self, seconds):
        self.seconds = seconds

    def pytest_collection_modifyitems(self, items):
        items[:] = [i for i in items if self.seconds.get(i.nodeid, 0) < float("inf")]
        items.sort(key=lambda item: self.seconds.get(item.nodeid, 0))


def _baseline(base, modules):
    """Return a dict that maps each test to its time in seconds without a fault. Failing tests are
    reported and skipped.
    """
    start, path, alive = time.monotonic(), base / "seen", set()
    waiting = list({tuple(run) for module in modules for run in _tests(module)})
    while waiting or alive:
        while waiting and len(alive) < WORKERS:
            alive.add(_fork(base, [waiting.pop()], _Watch(path)))
        alive.discard(os.wait()[0])
    seconds = Counter()
    for line in path.read_text().splitlines():
        span, test = line.split(" ", 1)
        seconds[test] += float(span)  # set-up, call and teardown
    for test in sorted(test for test, span in seconds.items() if span == float("inf")):
        print(f"  fails without a fault, left out: {test}")
    for name in ("seen", "log"):
        (base / name).unlink(missing_ok=True)
    print(f"  without a fault: {time.monotonic() - start:.0f} s", flush=True)
    return seconds


def _verdict(status, home, slow):
    """Return whether the fault was detected, and by what."""
    if slow:
        return True, "took too long"
    log = (home / "log").read_text(errors="replace") if (home / "log").exists() else ""
    first = re.search(r"^(?:FAILED|ERROR) \S*(tests/\S+)", log, re.M)
    return status != 0, first[1] if first else (log.strip().splitlines() or ["?"])[-1]


def _report(sample, results, seconds):
    by_module, killers = defaultdict(lambda: [0, 0]), Counter()
    for number, mutant in enumerate(sample):
        noticed, by = results[number]
        by_module[mutant.module][0] += noticed
        by_module[mutant.module][1] += 1
        if noticed:
            killers[by.split("::")[0].split(":")[0]] += 1
    print()
    for module, (noticed, count) in sorted(by_module.items()):
        print(f"{module:36} {noticed:4} of {count:4}  {noticed / count:7.1%}")
    noticed, count = (sum(n) for n in zip(*by_module.values(), strict=True))
    print(f"{'all':36} {noticed:4} of {count:4}  {noticed / count:7.1%}   {seconds:.0f} s")
    print("detected by:", ", ".join(f"{name} {n}" for name, n in killers.most_common(12)))
    return 0 if noticed >= 0.97 * count else 1


def _equivalent():
    if not EQUIVALENT.exists():
        return []
    return tomllib.loads(EQUIVALENT.read_text(encoding="utf-8")).get("mutant", [])


def _no_cache(folder, names):
    return [name for name in names if name == "__pycache__"]


def _arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("modules", nargs="*", help="such as robokin/quaternion.py")
    parser.add_argument(
        "--count", type=int, default=300, help="size of the sample; 0 takes all faults"
    )
    parser.add_argument("--seed", type=int, default=10)
    parser.add_argument("--only", help="only faults whose line or change contains this text")
    parser.add_argument("--list", action="store_true", help="print the faults, run no tests")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
