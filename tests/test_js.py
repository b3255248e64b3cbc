"""The scripts of the page have one format, correct types, and the same data types as Python."""

import ast
import contextlib
import json
import os
import re
import shutil
import subprocess
from functools import cache
from pathlib import Path
from typing import Literal, get_args

import pytest
from conftest import NODE, ROOT
from javascript import HERE, NoNetwork, page_types, tool, tools, written

from robokin import IRB140, SCARA, spbu_arm, three_lever, two_link
from robokin.show import explorer_page, page, things, twin
from robokin.show.things import PageThing
from robokin.show.things.thing import PageReading, PageWay

PACKAGE = ROOT / "robokin"
FOLDER = PACKAGE / "show" / "js"
SITE = ROOT / "robokin" / "course" / "site" / "static"
NARROW = ROOT / "robokin" / "course" / "templates" / "narrow.js"
SCRIPTS = sorted([*FOLDER.glob("*.js"), *SITE.glob("*.js"), NARROW])


def not_installed(error):
    """Skip the test if there is no network; under CI, let it fail."""
    report = pytest.fail if os.environ.get("CI") else pytest.skip
    report(f"Prettier and TypeScript are not installed, and there is no network: {error}")


def run(name, *arguments):
    """The output of a tool, or "" if it finds no faults."""
    try:
        done = tool(name, *arguments)
    except NoNetwork as error:
        not_installed(error)
    return done.stdout + done.stderr if done.returncode else ""


def test_prettier_finds_no_changes():
    said = run("prettier", "--check", FOLDER, *SITE.glob("*.js"), NARROW)
    assert not said, (
        f"{said}\nRun: .venv/bin/python tests/javascript.py prettier --write robokin/show/js"
    )


def test_tsc_finds_no_errors():
    said = run("tsc")
    assert not said, f"{said}\nRun it yourself: .venv/bin/python tests/javascript.py tsc"


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.name)
def test_no_line_is_longer_than_100_columns(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    assert not [(i, line) for i, line in enumerate(lines, 1) if len(line) > 100]


@cache
def scanned():
    """The output of tests/js/scan.cjs for every script: its functions and top-level constants."""
    try:
        command = [NODE, HERE / "scan.cjs", tools(), *SCRIPTS]
    except NoNetwork as error:
        not_installed(error)
    done = subprocess.run(command, text=True, capture_output=True, check=True)
    return {Path(path): found for path, found in json.loads(done.stdout).items()}


def test_functions_and_files_are_short():
    """A function has at most 60 lines, including inner functions, and a script at most 350."""
    functions = [
        (path.name, name, first, count)
        for path, found in scanned().items()
        for name, first, count in found["functions"]
    ]
    assert len(functions) > 1000 and max(count for *_, count in functions) > 40, (
        "too few functions were found"
    )
    assert not [each for each in functions if each[-1] > 60]
    lengths = {path.name: len(path.read_text(encoding="utf-8").splitlines()) for path in SCRIPTS}
    assert not {name: length for name, length in lengths.items() if length > 350}


# For each constant that both languages define: the test in test_twin.py that compares the two.
TWINS = {
    ("STEPS", 64): "test_page_refines_the_same_maxima",
    ("AROUND", 8): "test_page_refines_the_same_maxima",
    ("MOST", 200): "test_page_refines_the_same_maxima",
    ("JOINT", 3): "test_page_has_the_same_joint_and_the_same_tolerance_of_pulses",
    ("SLACK", 1e-9): "test_page_has_the_same_joint_and_the_same_tolerance_of_pulses",
}
PLAIN = {*range(-1, 101), 0.002, 0.5, 200, 400}  # values that may be equal by chance
# tolerances whose values are equal to a tolerance of Python by chance
OTHER = {("KEPT", 1e-6), ("SAME", 1e-6), ("TINY", 1e-9), ("SHORT", 0.01)}


def numbers_of(path):
    """The top-level numbers of a Python module: a dict that maps names to values."""
    found = {}
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        pairs = []
        if isinstance(node, ast.Assign):
            pairs = [(target, node.value) for target in node.targets]
        elif isinstance(node, ast.AnnAssign) and node.value:
            pairs = [(node.target, node.value)]
        for target, value in pairs:
            several = isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple)
            both = zip(target.elts, value.elts, strict=False) if several else [(target, value)]
            for name, each in both:
                with contextlib.suppress(ValueError):
                    number = ast.literal_eval(each)
                    if isinstance(name, ast.Name) and type(number) in (int, float):
                        found[name.id] = number
    return found


def test_no_constant_is_defined_both_in_python_and_in_a_script():
    """The page gets each constant from Python, or a test compares the page's value with Python's.
    This test looks for equal names and equal values.
    """
    ours = [pair for path in PACKAGE.rglob("*.py") for pair in numbers_of(path).items()]
    assert {("LEAP", 0.002), ("FORBIDDEN", 255), ("NOTHING", -32768)} <= set(ours), (
        "constants were not found"
    )
    names, values = dict(ours), {value for _, value in ours}
    twins = (ROOT / "tests" / "test_twin.py").read_text(encoding="utf-8")
    for path, found in scanned().items():
        for name, text in found["constants"]:
            if not re.fullmatch(r"-?[\d.]+(?:e-?\d+)?", text):
                continue
            value = float(text)
            if (name, value) in TWINS:
                assert f"def {TWINS[name, value]}(" in twins
                continue
            assert names.get(name) != value, f"{path.name}: {name} is also defined in Python"
            equal = value not in PLAIN and value in values and (name, value) not in OTHER
            assert not equal, f"{path.name}: {name} = {text}"
        for value in {x for x in values if x not in PLAIN and abs(x) > 1000}:
            loose = re.findall(rf"(?<![\w.])-?{abs(value):g}(?![\w.])", path.read_text())
            assert not loose, f"{path.name}: {value}"


def types_in(text):
    """The types in braces after the tags of JSDoc comments."""
    for comment in re.findall(r"/\*\*.*?\*/", text, re.S):
        comment = re.sub(r"\n\s*\*(?!/)", "\n", comment)
        for tag in re.finditer(r"@\w+\s*\{", comment):
            depth, end = 1, tag.end()
            while depth and end < len(comment):
                depth += {"{": 1, "}": -1}.get(comment[end], 0)
                end += 1
            yield comment[tag.end() : end - 1]


LOOSE = re.compile(r"\bany\b|(?<![\w*])\*(?=\s*(?:[>,)}\]|]|$))|\bFunction\b|\bObject\b(?!<)")


def test_untyped_declarations_are_detected():
    text = "/** any {any} @param {{a: any}} x @returns {*} @type {Object<string, *>} any */"
    assert list(types_in(text)) == ["{a: any}", "*", "Object<string, *>"]
    assert all(map(LOOSE.search, types_in(text))) and LOOSE.search("Object")
    assert not LOOSE.search("Object<string, number>") and not LOOSE.search("(many: Company) => 2")


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.name)
def test_no_declaration_is_untyped(path):
    text = path.read_text(encoding="utf-8")
    assert not [each for each in types_in(text) if LOOSE.search(each)]
    assert not re.findall(r"@ts-\w+", text), "correct the fault instead of suppressing the message"


def test_page_types_match_those_of_python():
    for path, text in written().items():
        stored = path.read_text(encoding="utf-8")
        assert stored == text, f"{path.name}: run .venv/bin/python tests/javascript.py types"


KEYS = {  # for each kind of page: a key that only this kind has, and a script that uses it
    "joint": ("rows: FactRow[];", "joint_explorer.js"),
    "levers": ("curve: PageCosts;", "levers_explorer.js"),
    "elbow": ("elbows: string[];", "elbow_explorer.js"),
    "crossing": ("eliminated: string;", "crossing_curve.js"),
    "target": ("turning: number[];", "target_explorer.js"),
    "motion": ("samples: number;", "blended.js"),
    "rotation": ("across: number[];", "rotation_explorer.js"),
    "plan": ("forbidden: number;", "plan_explorer.js"),
    "tour": ("spare: number[][];", "tour_explorer.js"),
    "singularity": ("beside: number[];", "singularity_explorer.js"),
    "clearance": ("vias: number[][];", "clearance_explorer.js"),
    "paths": ("paths: string[];", "paths_explorer.js"),
}
THINGS = {get_args(table.__annotations__["kind"])[0]: table for table in get_args(PageThing)}


def test_tsc_refuses_a_changed_key(tmp_path):
    """If keys of one kind of page or thing change, its scripts no longer type-check, but those of
    other kinds do. The test changes one key of a page, or every key of a thing except its kind.
    """
    for path in [*FOLDER.glob("*.js"), FOLDER / "page.d.ts"]:
        shutil.copy(path, tmp_path)
    settings = json.loads((HERE / "tsconfig.json").read_text()) | {"include": ["."]}
    (tmp_path / "tsconfig.json").write_text(json.dumps(settings))
    types = page_types()
    program = [NODE, tools() / "typescript" / "bin" / "tsc", "--project", tmp_path]
    others = {f"{kind}_explorer.js" for kind in KEYS} | {f"{kind}.js" for kind in THINGS}
    changes = [(f"{kind.capitalize()}Page", key, file) for kind, (key, file) in KEYS.items()]
    changes += [(table.__name__, "", f"{kind}.js") for kind, table in THINGS.items()]
    for table, key, script in changes:
        at = types.index(f"interface {table} {{")
        end = types.index("\n}", at)
        changed = re.sub(rf"^  (?!kind:)(?={re.escape(key)})", "  un", types[at:end], flags=re.M)
        assert changed != types[at:end], (table, key)
        (tmp_path / "page.d.ts").write_text(types[:at] + changed + types[end:])
        done = subprocess.run(program, cwd=tmp_path, text=True, capture_output=True)
        refused = set(re.findall(r"^(\w+\.js)\(", done.stdout, re.M))
        assert script in refused and done.returncode, done.stdout
        own = {script, f"{table.removesuffix('Page').lower()}_explorer.js"}
        assert not refused & others - own, (table, refused)


def test_scenes_have_no_optional_keys():
    for table in (page.PageScene, PageWay, PageReading, *get_args(PageThing)):
        assert not table.__optional_keys__, table.__name__


def test_all_kinds_of_things_are_listed():
    """Each kind has a module in things/, a script in js/, a data type in PageThing, and a class."""
    modules = {path.stem for path in (PACKAGE / "show" / "things").glob("[!_]*.py")} - {"thing"}
    where = "PageThing in things/__init__.py: wanted one kind for each module in things/"
    assert THINGS.keys() == modules, where
    assert not {kind for kind in THINGS if not (FOLDER / f"{kind}.js").exists()}, (
        "wanted a script in js/ for each kind"
    )
    classes = {getattr(things, name) for name in things.__all__} - {things.PageThing, things.Thing}
    exported = {each.__module__.rpartition(".")[2] for each in classes}
    assert exported == modules, "__all__ in things/__init__.py: wanted a class of each module"


def test_explorer_pages_have_no_optional_keys():
    """The keys that `Live` adds are an exception."""
    for table in get_args(explorer_page.PageExplorer):
        live = explorer_page.LivePage.__optional_keys__ & {*table.__annotations__}
        assert table.__optional_keys__ == live, table.__name__


@pytest.mark.parametrize(
    "arm", [IRB140, SCARA, spbu_arm(0.4, 0.3), two_link(0.3, 0.4), three_lever((0.3, 0.2, 0.4))]
)
def test_arm_data_has_the_keys_of_its_type(arm):
    data = twin.arm_data(arm)
    tables = {get_args(t.__annotations__["kind"])[:1]: t for t in get_args(twin.Inverse)}
    inverse = tables[get_args(Literal[data["geometry"]["kind"]])]
    for value, table in (
        (data, twin.ArmData),
        (data["geometry"], inverse),
        (data["tolerances"], twin.Tolerances),
        (data["chain"][0], twin.PageLink),
        (data["geometry"].get("elbow"), twin.ElbowData),
        (data["geometry"].get("wrist"), twin.WristData),
    ):
        assert value is None or table.__required_keys__ <= value.keys() <= {*table.__annotations__}
