"""`python -m robokin.course export` turns a lab into a single page that works without a network."""

import json
import re
import subprocess
import sys
from html.parser import HTMLParser

import pytest
from conftest import NOTEBOOKS, PATIENCE, ROOT

from robokin.course.__main__ import main
from robokin.course.export import export, mathml, read

PATHS = [*sorted(NOTEBOOKS.glob("*.ipynb")), *sorted(NOTEBOOKS.glob("documents/*.ipynb"))]
START = NOTEBOOKS / "00_start_here.ipynb"
FORMULA = re.compile(r"(?<!\\)\$\$(.+?)\$\$|(?<![\\$])\$([^$]+)\$(?!\$)", re.S)
FETCHED = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src"}


class Fetches(HTMLParser):
    """The addresses that a page and its scripts would load."""

    def __init__(self, text):
        super().__init__()
        self.found, self.math = [], 0
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.math += tag == "math"
        address = dict(attrs).get(FETCHED.get(tag)) or ""
        if address and not address.startswith("data:"):
            self.found.append(address)


def formulas(path):
    """Yield the TeX of each formula of a notebook, and whether it is displayed on its own line."""
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "markdown":
            text = re.sub(r"```.*?```|`[^`\n]*`", "", "".join(cell["source"]), flags=re.S)
            for found in FORMULA.finditer(text):
                yield found[1] or found[2], bool(found[1])


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_every_formula_becomes_mathml(path):
    for tex, block in formulas(path):
        made = mathml(tex, block)
        assert made.startswith("<math") and ('display="block"' in made) == block
        read = re.sub(r"<[^>]*>|&\w+;", "", made)
        assert not re.search(r"[\\$&]", read), f"{tex}: {read}"
        # the MathML contains every number
        said = re.sub(r"\\[A-Za-z]+", " ", tex)
        for number in re.findall(r"\d+", re.sub(r"\[[\d.]+\w*\]", "", said)):
            assert number in read, f"{tex}: {number} is missing"


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_page_fetches_nothing_and_contains_every_formula(path, exported):
    page = exported[path.relative_to(NOTEBOOKS).with_suffix("").as_posix()]
    text = page.read_text(encoding="utf-8")
    fetches = Fetches(text)
    assert fetches.found == []
    assert "@import" not in text and "url(http" not in text
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    written = sum("text/latex" in o.get("data", ()) for c in cells for o in c.get("outputs", ()))
    assert fetches.math == len(list(formulas(path))) + written
    folded = sum("hide-input" in cell["metadata"].get("tags", ()) for cell in cells)
    assert text.count('<details class="rk-folded">') == folded


def test_formulas_become_equivalent_mathml():
    assert "atan2" in mathml(r"\operatorname{atan2}(y, x)")
    assert mathml(r"\frac{1}{2}").count("<mn>") == 2 and "<mfrac>" in mathml(r"\frac{1}{2}")
    with pytest.raises(ValueError, match=r"formula.*nonsense"):
        mathml(r"\nonsense{1}")
    with pytest.raises(ValueError, match="formula"):
        mathml(r"\frac{1")


LIGHT = """selector => {
    const [r, g, b] = getComputedStyle(document.querySelector(selector)).backgroundColor
        .match(/[0-9.]+/g).map(Number);
    return (r + g + b) / 765; }"""


def command(*words, cwd):
    return subprocess.run(
        [sys.executable, "-m", "robokin.course", "export", *map(str, words)],
        cwd=cwd,
        text=True,
        capture_output=True,
        timeout=PATIENCE,
    )


def test_command_reports_a_bad_file_and_exports_the_others(tmp_path):
    notebook = json.loads(START.read_text(encoding="utf-8"))
    notebook["cells"][0]["source"] = [r"# A lab with $\nonsense$"]
    (tmp_path / "odd.ipynb").write_text(json.dumps(notebook))
    (tmp_path / "none.ipynb").write_text("{}")
    (tmp_path / "text.ipynb").write_text("no notebook")
    bad = [tmp_path / name for name in ("odd.ipynb", "none.ipynb", "text.ipynb", "lost.ipynb")]
    run = command(*bad, START, "--to", "pages", cwd=tmp_path)
    assert run.returncode == 1 and "Traceback" not in run.stderr
    for path, reason in zip(
        bad, ("nonsense", "not a notebook", "not a notebook", "No such file"), strict=True
    ):
        assert re.search(rf"{re.escape(str(path))}: .*{reason}", run.stderr), run.stderr
    assert [p.name for p in (tmp_path / "pages").iterdir()] == ["00_start_here.html"], (
        "wanted only the page of the good notebook"
    )
    assert "00_start_here.html" in run.stdout and " kB" in run.stdout


def test_files_that_we_did_not_write_are_not_overwritten(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    mine = tmp_path / "00_start_here.html"
    mine.write_text("mine")
    assert main(["export", str(START)]) == 1
    assert "nothing is overwritten" in capsys.readouterr().err
    assert main(["export", str(START), "--to", str(mine)]) == 1, "a file was accepted as a folder"
    assert mine.name in capsys.readouterr().err and mine.read_text() == "mine"
    mine.unlink()
    assert main(["export", str(START)]) == 0
    first = mine.read_text(encoding="utf-8")
    assert main(["export", str(START)]) == 0, "our own page was not replaced"
    again = mine.read_text(encoding="utf-8")
    nonce = re.compile("[0-9a-f]{32}")
    assert nonce.sub("", again) == nonce.sub("", first)
    assert nonce.search(again)[0] != nonce.search(first)[0], "two pages have the same nonce"


def test_links_lead_to_the_neighbouring_pages(tmp_path):
    page = tmp_path / "page.html"
    export(START, page)
    links = re.findall(r'<a href="([^"#]+)"', page.read_text(encoding="utf-8"))
    inside = [link for link in links if not link.startswith("http")]
    assert inside and all(link.endswith(".html") for link in inside if "_" in link)


def test_lab_00_explains_the_export(tmp_path):
    text = START.read_text(encoding="utf-8")
    assert "python -m robokin.course export" in text
    assert (ROOT / "README.md").read_text(encoding="utf-8").count("robokin.course export") >= 1


def test_page_follows_the_preferred_color_scheme(browser, tmp_path):
    page = tmp_path / "page.html"
    export(START, page)
    seen = []
    for scheme in ("light", "dark"):
        context = browser.new_context(color_scheme=scheme)
        shown = context.new_page()
        shown.goto(page.as_uri())
        shown.locator(".rk canvas").first.wait_for()
        seen += [shown.evaluate(LIGHT, selector) for selector in ("body", ".rk")]
        shown.emulate_media(color_scheme="dark", media="print")
        assert shown.evaluate(LIGHT, "body") > 0.9, "the printed page is dark"
        context.close()
    assert min(seen[:2]) > 0.9 and max(seen[2:]) < 0.2


def test_invalid_notebook_is_reported_with_the_reason(tmp_path):
    path = tmp_path / "a.ipynb"
    cell = {"cell_type": "code", "source": "1", "metadata": {}, "outputs": [], "id": "a"}
    good = {"metadata": {}, "nbformat": 4, "nbformat_minor": 0}
    good["cells"] = [cell | {"execution_count": None}]
    path.write_text(json.dumps(good))
    assert read(path).cells[0].source == "1", "an old notebook with ids was not read"
    for bad, reason in (
        ([], "its JSON is not an object"),
        (good | {"nbformat": 5}, "version 5"),
        (good | {"cells": [{"cell_type": "code", "source": "1"}]}, "metadata"),
        (good | {"cells": [cell | {"outputs": [{"output_type": "x" * 5000}]}]}, "x"),
        ("[" * 100_000, "."),
    ):
        path.write_text(bad if isinstance(bad, str) else json.dumps(bad))
        with pytest.raises(ValueError, match=f"not a notebook: .*{reason}") as error:
            read(path)
        assert len(str(error.value)) < 400
