"""The rules of the repository: which modules a module may import, the cost of `import robokin`, and
the promises of the README.
"""

import ast
import importlib
import inspect
import itertools
import os
import re
import subprocess
import sys
import tomllib
from importlib.metadata import version

import pytest
from conftest import ROOT
from packaging.requirements import Requirement

import robokin

TOP = {"notebooks", "robokin", "environment.txt", "tests", "README.md", "pyproject.toml"}
TOP |= {"CONTRIBUTING.md", "CHANGELOG.md"}
OWNERS_CHOICE = {"LICENSE", "LICENSE.md", "LICENSE.txt", "LICENCE", "LICENCE.md", "LICENCE.txt"}
# Files of build tools, and the folders in the commands of the README.
MADE_BY_TOOLS = {"robokin.egg-info", "build", "dist"} | {"my-labs", "handed-in", "site"}
README = (ROOT / "README.md").read_text(encoding="utf-8")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]

# A module may import itself, its own parts, and the modules of the longest entry that matches its
# name.
BASE = (
    "robokin._arrays",
    "robokin._validate",
    "robokin.units",
    "robokin.quaternion",
    "robokin.transform",
)
KINEMATICS = (*BASE, "robokin.arms", "robokin.motion")
LAYERS = {
    "robokin": KINEMATICS,
    "robokin._arrays": (),
    "robokin._validate": ("robokin._arrays",),
    "robokin.units": ("robokin._arrays",),
    "robokin.quaternion": ("robokin._arrays", "robokin._validate"),
    "robokin.transform": ("robokin._arrays", "robokin._validate", "robokin.quaternion"),
    "robokin.arms": BASE,
    # uses any object with a `lerp` method, but no arms
    "robokin.motion": ("robokin._arrays", "robokin._validate", "robokin.units"),
    "robokin.motion.duration": (*BASE, "robokin.arms", "robokin.motion.laws"),
    "robokin.motion.recording": (*BASE, "robokin.arms", "robokin.motion.derivatives"),
    "robokin.jobs": KINEMATICS,
    "robokin.show": KINEMATICS,
    "robokin.show.clearance_explorer": (*KINEMATICS, "robokin.jobs", "robokin.show"),
    "robokin.show.conveyor": (*KINEMATICS, "robokin.jobs", "robokin.show"),
    "robokin.show.explorer": ("robokin",),
    "robokin.show.plan_explorer": (*KINEMATICS, "robokin.jobs", "robokin.show"),
    "robokin.show.motors": (*KINEMATICS, "robokin.show", "robokin.jobs.steppers"),
    "robokin.show.paths_explorer": (*KINEMATICS, "robokin.show", "robokin.jobs.steppers"),
    "robokin.course": ("robokin",),
    "robokin.show.tour_explorer": (*KINEMATICS, "robokin.jobs", "robokin.show"),
}
DRAWING = {"matplotlib", "PIL", "ipywidgets", "IPython", "anywidget", "traitlets"}
HEAVY = DRAWING | {
    "scipy",
    "sympy",
    "pandas",
    "jupyterlab",
    "hypothesis",
    "pytest",
    "asyncio",
    "importlib.resources",
}

# Libraries of the extras "labs" and "site", for what we should not implement ourselves.
OUTSIDE = {
    "robokin.course.copies": {"nbformat"},
    "robokin.course.export": {"jinja2", "markupsafe", "math_core", "nbconvert", "nbformat"},
    "robokin.course.harmless": {"bleach", "markupsafe"},
    "robokin.course.ours": {"markupsafe"},
    "robokin.course.handed_in": {"nbformat"},
    "robokin.course.judge": {"nbformat"},
    "robokin.course.process": {"jupyter_client", "nbclient", "nbformat", "psutil"},
    "robokin.course.kernel": {"ipykernel"},
    "robokin.course.report_page": {"jinja2", "markupsafe"},
    "robokin.course.site.conf": {"docutils", "sphinx"},
    "robokin.course.summary": {"psutil"},
    "robokin.course.summary_pages": {"jinja2", "markupsafe"},
}

MODULES = {
    ".".join(p.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__"): p
    for p in sorted((ROOT / "robokin").rglob("*.py"))
}


@pytest.mark.parametrize("module", MODULES)
def test_modules_import_only_lower_layers(module):
    rule = max(
        (name for name in LAYERS if module == name or module.startswith(f"{name}.")), key=len
    )
    allowed = (*LAYERS[rule], *([rule] if rule != "robokin" else []))
    for name in _imports(module):
        if name.split(".")[0] == "robokin":
            assert any(name == a or name.startswith(f"{a}.") for a in allowed), (
                f"{module} must not import {name}"
            )
        elif name.split(".")[0] in DRAWING:
            assert module.startswith("robokin.show"), (
                f"{module} imports {name}: only robokin.show draws"
            )
        else:
            allowed_here = {"numpy", *sys.stdlib_module_names, *OUTSIDE.get(module, ())}
            assert name.split(".")[0] in allowed_here, f"{module} imports {name}"
        assert "pyplot" not in name, (
            f"{module} uses pyplot, but a figure must not depend on global state"
        )


def test_layer_check_detects_a_planted_import():
    # The rule above depends on the import parser, which must resolve relative imports and names
    # that a package re-exports.
    assert "robokin.arms.catalogue" in _imports("robokin.arms")
    assert {"numpy", "robokin.transform", "robokin.arms.arm"} <= _imports("robokin.arms.branches")
    assert "robokin.arms.spherical_wrist" in _imports("robokin.arms.catalogue")


def test_import_loads_nothing_heavy():
    code = (
        "import sys, numpy; before = set(sys.modules); import robokin; "
        "print(*sorted(set(sys.modules) - before))"
    )
    loaded = subprocess.run(
        [sys.executable, "-c", code], text=True, capture_output=True, check=True
    ).stdout.split()
    assert "robokin.transform" in loaded
    assert not [name for name in loaded if name in HEAVY or name.split(".")[0] in HEAVY]
    outside = {name.split(".")[0] for name in loaded} - {"robokin"} - set(sys.stdlib_module_names)
    assert outside <= {"numpy"}, outside


def test_top_level_folder_contains_only_the_agreed_files():
    found = {
        entry.name for entry in ROOT.iterdir() if not entry.name.startswith((".", "__pycache__"))
    }
    assert found - MADE_BY_TOOLS - OWNERS_CHOICE == TOP


def test_ci_runs_the_test_command_of_the_readme():
    commands = re.findall(r"^python3 -m venv .*pytest$", README, re.M)
    assert len(commands) == 1
    assert "-r environment.txt" in commands[0] and '-e ".[test]"' in commands[0]
    script = (ROOT / ".ci" / "run").read_text()
    assert "grep '^python3 -m venv .*pytest$' README.md" in script and 'eval "$command"' in script
    assert "pip install" not in script
    assert script.endswith('\neval "$command"\n.venv/bin/python tests/page_python.py\n')
    windows = [
        line
        for line in README.splitlines()
        if line.startswith("py -m venv") and line.endswith("pytest")
    ]
    assert [_arguments(windows[0])] == [_arguments(commands[0])], (
        "the Windows command installs something else"
    )


def test_readme_names_every_lab_and_its_links_resolve():
    links = re.findall(r"\]\(([^)\s]+)\)", README)
    others = [
        (ROOT / name).read_text(encoding="utf-8") for name in ("CONTRIBUTING.md", "CHANGELOG.md")
    ]
    for link in links + re.findall(r"\]\(([^)\s]+)\)", " ".join(others)):
        assert link.startswith(("https:", "#")) or (ROOT / link).exists(), link
    for lab in (ROOT / "notebooks").glob("**/[!.]*.ipynb"):
        if ".ipynb_checkpoints" not in lab.parts:
            name = lab.relative_to(ROOT).as_posix()
            assert name in links, f"{name} is not in the README"


def test_commands_in_the_readme_match_those_of_the_program():
    blocks = re.findall(r"^```(?:sh|powershell)\n(.*?)^```", README, re.M | re.S)
    used = re.findall(r"-m robokin\.course (\w+)", " ".join(blocks))
    assert used.count("copy") == 2, "wanted one command for each shell"
    told = subprocess.run(
        [sys.executable, "-m", "robokin.course", "-h"], text=True, capture_output=True, check=True
    ).stdout
    assert {*used} == set(re.findall(r"^    (\w+)  ", told, re.M)) - {"export"}


def test_pinned_versions_are_installed_and_within_the_ranges():
    lines = (ROOT / "environment.txt").read_text().splitlines()
    pins = dict(line.split("==") for line in lines if line and not line.startswith(("#", "-")))
    assert "-e .[labs]" in lines
    assert {"numpy", "matplotlib", "ipywidgets", "jupyterlab", "nbval"} <= set(pins)
    extras = PROJECT["optional-dependencies"].values()
    for wanted in map(Requirement, [*PROJECT["dependencies"], *itertools.chain(*extras)]):
        assert wanted.specifier.contains(version(wanted.name)), (
            f"{wanted}: {version(wanted.name)} is installed"
        )
        assert wanted.name not in pins or wanted.specifier.contains(pins[wanted.name])
    wrong = {name: version(name) for name, pin in pins.items() if version(name) != pin}
    assert not wrong, f"the stored outputs were made with other versions: {wrong}"


def test_package_itself_needs_only_numpy():
    assert [Requirement(text).name for text in PROJECT["dependencies"]] == ["numpy"]
    extras = {
        extra: {Requirement(text).name.lower() for text in texts}
        for extra, texts in PROJECT["optional-dependencies"].items()
    }
    # The imports of `robokin.show` must match its extra.
    drawn = {
        name.split(".")[0] for m in MODULES if m.startswith("robokin.show") for name in _imports(m)
    }
    assert drawn & DRAWING == {"PIL" if name == "pillow" else name for name in extras["show"]}
    exports = {"math-core", "nbconvert", "nbformat"}
    reports = {"ipykernel", "jupyter-client", "nbclient"}
    labs = {"robokin", "jupyterlab", "ipywidgets", "scipy", "sympy"}
    assert extras["labs"] == labs | exports | reports


def test_eight_lines_of_the_readme_save_a_page(tmp_path):
    section = README.split("## The package alone\n")[1].split("\n## ")[0]
    (code,) = re.findall(r"^```python\n(.*?)^```", section, re.M | re.S)
    assert len([line for line in code.splitlines() if line]) == 8
    subprocess.run([sys.executable, "-W", "error", "-c", code], cwd=tmp_path, check=True)
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "UR5" in page and "<script" in page and [*tmp_path.iterdir()] == [tmp_path / "page.html"]


def test_no_text_suggests_installing_robokin_from_an_index():
    """The user documentation says how to install from a clone; only pyproject.toml names the
    package.
    """
    read = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md"]
    read += [*MODULES.values(), *(ROOT / "notebooks").glob("**/*.ipynb")]
    for path in read:
        assert not re.search(r"install ['\"`]*robokin", path.read_text(encoding="utf-8")), path


def test_version_is_defined_once():
    assert "version" in PROJECT["dynamic"] and "version" not in PROJECT
    assert re.fullmatch(r"\d+\.\d+\.\d+", robokin.__version__)


@pytest.mark.parametrize("what", [[], ["--explicit-package-bases", "notebooks/exercises"]])
def test_mypy_finds_no_errors(what):
    # mypy is configured in pyproject.toml. Its cache (.mypy_cache) makes the second run quick.
    run = subprocess.run(
        [sys.executable, "-m", "mypy", *what],
        cwd=ROOT,
        env={**os.environ, "MYPYPATH": "notebooks"},
        text=True,
        capture_output=True,
    )
    assert run.returncode == 0, run.stdout + run.stderr


@pytest.mark.parametrize("command", [["check", "--output-format=concise"], ["format", "--check"]])
def test_ruff_finds_no_errors(command):
    run = subprocess.run(
        [sys.executable, "-m", "ruff", *command, "--no-cache", ROOT],
        text=True,
        capture_output=True,
    )
    assert run.returncode == 0, run.stdout


PACKAGES = [
    "robokin",
    "robokin.arms",
    "robokin.motion",
    "robokin.show",
    "robokin.jobs.obstacles",
    "robokin.jobs.steppers",
    "robokin.jobs.visit_collect",
]


@pytest.mark.parametrize("package", PACKAGES)
def test_public_names_are_listed_and_documented(package):
    module = importlib.import_module(package)
    assert len(module.__doc__) > 30 and len(set(module.__all__)) == len(module.__all__)
    passed_on = {name for name, _ in _passed_on(MODULES[package]) if not name.startswith("_")}
    assert set(module.__all__) == passed_on
    for name in module.__all__:
        value = getattr(module, name)
        if inspect.isclass(value) or inspect.isfunction(value):
            assert value.__doc__ and len(value.__doc__) > 30, f"{name} has no docstring"
            for attribute, member in vars(value).items() if inspect.isclass(value) else ():
                if not attribute.startswith("_") and inspect.isfunction(member):
                    assert member.__doc__, f"{name}.{attribute} has no docstring"


def _arguments(command):
    """The arguments of `pip install` in a command."""
    return re.search(r"pip install (.*?)(?:;| &&)", command)[1]


def _imports(module):
    """All modules that `module` imports; re-exported names count for the defining module."""
    found = set()
    package = module if MODULES[module].name == "__init__.py" else module.rpartition(".")[0]
    for node in ast.walk(ast.parse(MODULES[module].read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            source = importlib.util.resolve_name("." * node.level + (node.module or ""), package)
            found |= {_origin(source, alias.name) for alias in node.names}
    return found - {module}


def _origin(source, name):
    """The module that defines `name`, which `source` may re-export."""
    if f"{source}.{name}" in MODULES:
        return f"{source}.{name}"
    if source in MODULES and MODULES[source].name == "__init__.py":
        for passed, origin in _passed_on(MODULES[source]):
            if passed == name:
                return _origin(importlib.util.resolve_name(origin, source), name)
    return source


def _passed_on(init):
    """The names that an __init__.py imports from its own package: (name, relative module)."""
    for node in ast.walk(ast.parse(init.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level:
            for alias in node.names:
                yield alias.asname or alias.name, "." * node.level + (node.module or "")
