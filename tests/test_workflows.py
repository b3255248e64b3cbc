"""The workflows for GitHub are valid, as far as actionlint can tell without running them, and try
the versions that pyproject.toml and the page need.
"""

import json
import re
import subprocess
import tomllib

import pytest
from conftest import NODE, ROOT
from javascript import HERE, NoNetwork, tools
from packaging.specifiers import SpecifierSet
from test_js import not_installed

FOLDER = ROOT / ".github" / "workflows"
FILES = sorted(FOLDER.glob("*.yml"))
TEXT = {file.name: file.read_text(encoding="utf-8") for file in FILES}
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
PINS = ROOT / "robokin" / "course" / "site" / "python.json"


def found(*files):
    """What the linter finds in the files."""
    try:
        command = [NODE, HERE / "workflows.mjs", tools(), *files]
    except NoNetwork as error:
        not_installed(error)
    return subprocess.run(command, text=True, capture_output=True, check=True).stdout


def test_the_linter_finds_nothing():
    assert {*TEXT} == {"site.yml", "tests.yml"}
    assert found(*FILES) == ""


@pytest.mark.parametrize(
    "right, wrong, reason",
    [
        ("runs-on: ubuntu-latest", "runs-on: ubuntu-lates", "ubuntu-lates"),
        ("- uses: actions/checkout", "- usees: actions/checkout", "usees"),
        ("github.repository", "github.repozitory", "repozitory"),
    ],
)
def test_the_linter_finds_a_planted_fault(right, wrong, reason, tmp_path):
    assert right in TEXT["site.yml"]
    file = tmp_path / "site.yml"
    file.write_text(TEXT["site.yml"].replace(right, wrong, 1))
    assert reason in found(file)


def test_workflows_run_commands_that_exist():
    commands = re.findall(r"- run: (.*)", "".join(TEXT.values()))
    assert ".ci/run" in commands and (ROOT / ".ci" / "run").is_file()
    assert sum("robokin.course site site --repository" in command for command in commands) == 1
    for extra in re.findall(r'"\.\[(\w+)\]"', "".join(TEXT.values())):
        assert extra in PROJECT["optional-dependencies"]


def test_workflows_try_every_python_from_the_oldest_on():
    (listed,) = re.findall(r"python: (\[.*\])", TEXT["tests.yml"])
    tried = json.loads(listed)
    oldest = PROJECT["requires-python"].removeprefix(">=")
    assert tried[0] == oldest and [int(each.split(".")[1]) for each in tried] == [11, 12, 13, 14]
    (lowest,) = re.findall(r'python-version: "(.*)"\n.*uv\n.*lowest', TEXT["tests.yml"])
    assert lowest == oldest


def test_the_versions_of_the_page_are_in_the_ranges_of_the_package():
    """The page's Python and NumPy are older than those of most installations, and cannot be newer:
    nothing newer is to be had for it.
    """
    numpy = next(pin["npm"] for pin in json.loads(PINS.read_text()) if "numpy" in pin["file"])
    version, three, minor = re.search(r"@([\d.]+)-py(\d)(\d+)h", numpy).groups()
    assert SpecifierSet(PROJECT["requires-python"]).contains(f"{three}.{minor}")
    (wanted,) = PROJECT["dependencies"]
    assert SpecifierSet(wanted.removeprefix("numpy")).contains(version)
