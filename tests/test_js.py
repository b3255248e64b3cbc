"""The page's scripts: one form, types that hold, and types of the data that are Python's."""

import os
import re
from typing import Literal, get_args

import pytest
from conftest import ROOT
from javascript import NoNetwork, page_types, tool

from robokin import IRB140, SCARA, spbu_arm, three_lever, two_link
from robokin.show import twin

FOLDER = ROOT / "robokin" / "show" / "js"
SITE = ROOT / "robokin" / "course" / "site" / "static"
SCRIPTS = sorted([*FOLDER.glob("*.js"), *SITE.glob("*.js")])


def run(name, *arguments):
    """What a tool says, "" if it finds nothing."""
    try:
        done = tool(name, *arguments)
    except NoNetwork as error:
        report = pytest.fail if os.environ.get("CI") else pytest.skip
        report(f"Prettier and TypeScript are not installed, and there is no network: {error}")
    return done.stdout + done.stderr if done.returncode else ""


def test_prettier_changes_nothing():
    said = run("prettier", "--check", FOLDER, SITE / "site.js")
    assert not said, f"{said}\nRun: python tests/javascript.py prettier --write robokin/show/js"


def test_the_types_hold():
    said = run("tsc")
    assert not said, f"{said}\nThe same by hand: python tests/javascript.py tsc"


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.name)
def test_no_line_is_longer_than_100_columns(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    assert not [(i, line) for i, line in enumerate(lines, 1) if len(line) > 100]


def types_in(text):
    """What stands in the braces behind the tags of JSDoc comments, and the rest of an @import."""
    for comment in re.findall(r"/\*\*.*?\*/", text, re.S):
        comment = re.sub(r"\n\s*\*(?!/)", "\n", comment)
        for tag in re.finditer(r"@\w+\s*\{", comment):
            depth, end = 1, tag.end()
            while depth and end < len(comment):
                depth += {"{": 1, "}": -1}.get(comment[end], 0)
                end += 1
            yield comment[tag.end() : end - 1]


LOOSE = re.compile(r"\bany\b|(?<![\w*])\*(?=\s*(?:[>,)}\]|]|$))|\bFunction\b|\bObject\b(?!<)")


def test_what_counts_as_no_type():
    text = "/** any {any} @param {{a: any}} x @returns {*} @type {Object<string, *>} any */"
    assert list(types_in(text)) == ["{a: any}", "*", "Object<string, *>"]
    assert all(map(LOOSE.search, types_in(text))) and LOOSE.search("Object")
    assert not LOOSE.search("Object<string, number>") and not LOOSE.search("(many: Company) => 2")


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.name)
def test_no_type_says_nothing(path):
    text = path.read_text(encoding="utf-8")
    assert not [each for each in types_in(text) if LOOSE.search(each)]
    assert not re.findall(r"@ts-\w+", text), "a fault is mended, not hidden"


def test_the_types_of_the_data_are_those_of_python():
    stored = (FOLDER / "page.d.ts").read_text(encoding="utf-8")
    assert stored == page_types(), "Run: python tests/javascript.py types"


@pytest.mark.parametrize(
    "arm", [IRB140, SCARA, spbu_arm(0.4, 0.3), two_link(0.3, 0.4), three_lever((0.3, 0.2, 0.4))]
)
def test_an_arm_has_the_keys_of_its_type(arm):
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
