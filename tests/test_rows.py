"""Each capability of the documents and each finding of the second reading is covered somewhere.

The tables at the end of the companions list the 97 capabilities (S0-01 to S4-11); the file
data/second_reading.csv lists the findings (A1 to H12). Every target exists; every name that a row
quotes from the document occurs in one of the row's targets, and every object of robokin that a row
names cites the document, if it cites any.
"""

import csv
import importlib
import inspect
import json
import re

import pytest
from conftest import NOTEBOOKS, ROOT

COUNTS = {"S0": 25, "S1": 28, "S2": 6, "S3": 27, "S4": 11}
FINDINGS = {"A": 14, "B": 10, "C": 3, "D": 15, "E": 10, "F": 9, "G": 8, "H": 12}
READING = ROOT / "tests" / "data" / "second_reading.csv"
LABS = {path.stem[:2]: path for path in NOTEBOOKS.glob("*.ipynb")}
COMPANIONS = {
    path.stem[:3]: path for path in NOTEBOOKS.glob("documents/*.ipynb") if path.stem[:3].isdigit()
}


def prose(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return "\n".join("".join(c["source"]) for c in cells if c["cell_type"] == "markdown")


def table(source):
    """A tuple (row, what, where, names) for each line of a companion's table."""
    text = prose(COMPANIONS[f"00{source[1]}"])
    lines = re.findall(rf"^\| ({source}-\d\d) \|(.*)\|$", text, re.M)
    return [(row, *(part.strip() for part in rest.split(" | "))) for row, rest in lines]


def section_text(path, section):
    """The text of a section, such as "§3", "More" or "Your turn", or of the whole notebook for
    ""; "" if the notebook has no such section.
    """
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    text = "\n".join("".join(cell["source"]) for cell in cells)
    heading = rf"{section[1:]}\. " if section.startswith("§") else section
    parts = re.split(r"^(?=## )", text, flags=re.M)
    return "".join(part for part in parts if not section or re.match(f"## {heading}", part))


def has_section(path, section):
    return bool(section_text(path, section))


def found(name):
    """The object of robokin with this dotted name; None if there is none."""
    for module in ("robokin", "robokin.arms", "robokin.motion", "robokin.show", "robokin.course"):
        value = importlib.import_module(module)
        for part in name.removeprefix("robokin.").split("."):
            if not hasattr(value, part):
                try:
                    value = importlib.import_module(f"{value.__name__}.{part}")
                except (ImportError, AttributeError):
                    break
            else:
                value = getattr(value, part)
        else:
            return value
    return None


@pytest.mark.parametrize("source", COUNTS)
def test_every_capability_of_a_document_has_a_target(source):
    rows = table(source)
    assert [row[0] for row in rows] == [f"{source}-{k:02}" for k in range(1, COUNTS[source] + 1)]
    for row, what, where, names in rows:
        assert len(what) > 8, row
        if where.startswith(("decided against:", "not yet:")):
            assert len(where) > 40, f"{row}: the reason is missing"
            continue
        links = re.findall(r"\[(\w+)(?: ([^\]]+))?\]\(([^)]+)\)", where)
        assert links, f"{row}: {where}"
        texts = []
        for lab, section, target in links:
            path = COMPANIONS[f"00{source[1]}"]
            if lab != "here":
                path = LABS[lab]
                assert target.split("#")[0] == f"../{path.name}", f"{row}: {target}"
            assert has_section(path, section), f"{row}: {lab} {section}"
            texts.append(section_text(path, section))
        for term in re.findall(r"`([^`]+)`", what):
            assert any(term in text for text in texts), f"{row}: {term} occurs in none of {where}"
        assert names == "–" or "`" in names, f"{row}: {names}"
        for name in re.findall(r"`([^`]+)`", names):
            value = found(name)
            assert value is not None, f"{row}: {name}"
            cited = re.findall(r"Source: [^>]*", inspect.getdoc(value) or "")
            assert not cited or f"00{source[1]}" in cited[0], f"{row}: {name} cites {cited}"


def findings():
    with open(READING, encoding="utf-8") as file:
        return list(csv.DictReader(file, delimiter=";"))


def test_every_finding_of_the_second_reading_has_a_target():
    wanted = [f"{part}{k}" for part, count in FINDINGS.items() for k in range(1, count + 1)]
    assert [line["row"] for line in findings()] == wanted


@pytest.mark.parametrize("line", findings(), ids=lambda line: line["row"])
def test_findings_are_resolved_at_their_targets(line):
    assert len(line["what"]) > 10
    for place in line["where"].split(", "):
        if re.fullmatch(r"later|decided against", place):
            assert len(line["what"]) > 30, "the reason is missing"
        elif match := re.fullmatch(r"(\d\d)(?: (.+))?", place):
            assert has_section(LABS[match[1]], match[2] or ""), place
        elif match := re.fullmatch(r"companion (00\d)(?: (§\d+))?", place):
            assert has_section(COMPANIONS[match[1]], match[2] or ""), place
        elif match := re.fullmatch(r"(tests/\S+?\.py)(?:::(\w+))?", place):
            text = (ROOT / match[1]).read_text(encoding="utf-8")
            assert match[2] is None or re.search(rf"^def {match[2]}\(", text, re.M), place
        elif place.startswith("robokin."):
            assert found(place) is not None, place
        else:
            assert (ROOT / place).exists(), place


def test_every_box_of_the_flow_charts_leads_to_the_source_of_its_function():
    """Companion 003, figures 29 to 33. The companion's own cells check that the drawn
    names exist.
    """
    path, figures = COMPANIONS["003"], []
    for figure, names in re.findall(r"^\| (29|3[0-3]) \|[^|]+\|([^|]+)\|", prose(path), re.M):
        figures.append(figure)
        linked = re.findall(r"\[`([^`]+)`\]\(([^)]+)\)", names)
        assert linked, names
        for name, target in linked:
            value = found(name)
            assert value is not None, name
            assert (path.parent / target).resolve().samefile(inspect.getsourcefile(value)), name
    assert sorted(set(figures)) == ["29", "30", "31", "32", "33"]


def test_companion_003_explains_every_term_of_the_documents_own_list():
    """The list is "Santrumpų ir terminų žodynėlis" and has 20 entries."""
    text = prose(COMPANIONS["003"]).split("\n## Its terms\n")[1].split("\n## ")[0]
    named = [line.split("|")[1].lower() for line in text.splitlines() if line.startswith("| ")]
    terms = """ai, atvirkštinė kinematika, autonominis, c++, db, dof, is, if/then, išmanioji
        sistema, jutiklis, manipuliatorius, matlab, operatorius, plv, pagalbinė sistema,
        realaus laiko sistema, tiesioginė kinematika, tis, valdiklis, žingsninis variklis"""
    for term in map(str.strip, re.sub(r"\s+", " ", terms).split(",")):
        assert any(re.search(rf"(?<!\w){re.escape(term)}(?!\w)", name) for name in named), term
