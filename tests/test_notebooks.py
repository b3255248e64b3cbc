"""Rules for every stored lab, checked in its file; nbval runs the cells and compares their outputs.

The tests also check that the script that executes the labs again makes no unnecessary changes.
"""

import ast
import base64
import builtins
import io
import json
import re
import subprocess
import sys
import tokenize
import unicodedata
import zlib

import lab_sizes
import nbformat
import pytest
from conftest import NOTEBOOKS, PATIENCE, ROOT
from PIL import Image
from rerun import Cell

from robokin.show import joiner

# Not recursive, since JupyterLab keeps checkpoints in a subfolder.
LABS = sorted(NOTEBOOKS.glob("*.ipynb"))
PATHS = [*LABS, *sorted(NOTEBOOKS.glob("documents/*.ipynb"))]  # labs and companions
IMPORTS = {"ipywidgets", "matplotlib", "numpy", "robokin", "scipy", "sympy"} | set(
    sys.stdlib_module_names
)
LONGEST_CELL = 35
TEACHING, GLOSSARY = (
    NOTEBOOKS / "documents" / f"{name}.ipynb" for name in ("teaching", "glossary")
)
UNCOMPARED = {"nbval-ignore-output", "nbval-skip", "nbval-check-output", "raises-exception"}
PARTS = ("Your turn", "In short", "Next", "More")
every_lab = pytest.mark.parametrize("lab", LABS, ids=lambda path: path.stem)
HEADINGS = ("You will be able to", "Your turn", "In short", "Next")


@pytest.fixture(params=PATHS, ids=lambda path: path.stem)
def path(request):
    return request.param


@pytest.fixture
def cells(path):
    return nbformat.read(path, as_version=4).cells


@pytest.fixture
def code(cells):
    return [cell for cell in cells if cell.cell_type == "code"]


@pytest.fixture
def prose(cells):
    return [cell.source for cell in cells if cell.cell_type == "markdown"]


def test_labs_exist():
    assert PATHS


def test_lab_numbers_have_no_gaps():
    assert [int(path.stem[:2]) for path in LABS] == list(range(len(LABS)))
    assert len(LABS) <= 15


def test_cells_were_executed_from_top_to_bottom(code):
    # nbval does not compare a cell without an execution count, so a notebook without counts would
    # pass.
    assert all(cell.source.strip() for cell in code), "a code cell is empty"
    assert [cell.execution_count for cell in code] == list(range(1, len(code) + 1))


def test_every_notebook_has_outputs_that_nbval_compares(path, code):
    words_only = path.stem in ("glossary", "teaching")
    printed = sum(output.output_type == "stream" for cell in code for output in cell.outputs)
    assert (not code) if words_only else printed >= 2
    assert not [
        output
        for cell in code
        for output in cell.outputs
        if output.output_type == "error" and "raises-exception" not in cell.metadata.get("tags", ())
    ]


def test_no_warning_is_stored(code):
    assert not [
        output.text for cell in code for output in cell.outputs if output.get("name") == "stderr"
    ]


def test_notebook_files_are_small(path):
    assert path.stat().st_size < 1_000_000


def test_stored_scripts_are_up_to_date(path):
    """nbval compares only the keys of the scripts, because their bytes depend on the version of
    zlib.
    """
    text = json.dumps(json.loads(path.read_text(encoding="utf-8")), ensure_ascii=False)
    form = r"\$loader\.start\(\W*[0-9a-f]{12}\W+([0-9a-f]{12})\W+?([A-Za-z0-9+/=]+)\W+\$(\w+) =>"
    found = re.findall(form, text)
    views = re.findall(r"class=\W+robokin-player\W+data-player=", text)
    assert len(found) == len(views)
    for key, script, module in set(found):
        wanted, today = joiner.compressed(module)
        assert key == wanted, f"{module}: run .venv/bin/python tests/execute_notebooks.py"
        unpacked = [zlib.decompress(base64.b64decode(one)) for one in (script, today)]
        assert unpacked[0] == unpacked[1], (
            f"{module}: run .venv/bin/python tests/execute_notebooks.py"
        )


def test_no_session_state_is_stored(path):
    notebook = json.loads(path.read_text(encoding="utf-8"))
    assert set(notebook["metadata"]) == {"kernelspec", "language_info"}, (
        "run tests/execute_notebooks.py"
    )
    for cell in notebook["cells"]:
        assert set(cell["metadata"]) <= {"tags", "reason", "jupyter"}
        if cell["metadata"].get("jupyter"):  # the cell is folded, also in an exported page
            assert cell["metadata"]["jupyter"] == {"source_hidden": True}
            assert "hide-input" in cell["metadata"]["tags"] and cell["cell_type"] == "code"
    ids = [cell["id"] for cell in notebook["cells"]]
    assert len(set(ids)) == len(ids)


def test_ignored_outputs_have_a_reason(cells):
    for cell in cells:
        if UNCOMPARED & set(cell.metadata.get("tags", ())):
            assert len(cell.metadata.get("reason", "")) > 20, cell.source
        assert "NBVAL" not in cell.source.upper(), "use a tag and a reason"


def test_cells_fit_on_a_screen(code):
    too_long = {
        cell.source.splitlines()[0]: n
        for cell in code
        if (n := cell.source.count("\n") + 1) > LONGEST_CELL
    }
    assert not too_long


def test_cells_are_plain_python_and_import_only_installed_packages(code):
    for cell in code:
        for node in ast.walk(
            ast.parse(cell.source)
        ):  # a SyntaxError means a magic command, which no lab needs
            names = (
                [node.module]
                if isinstance(node, ast.ImportFrom)
                else [a.name for a in getattr(node, "names", ()) if isinstance(node, ast.Import)]
            )
            for name in names:
                assert name.split(".")[0] in IMPORTS and "pyplot" not in name, (
                    f"{name} in: {cell.source[:60]}"
                )


def test_names_in_code_are_ascii(code):
    # A Cyrillic letter that looks Latin makes a different name, and invisible characters are hard
    # to find.
    for cell in code:
        for token in tokenize.generate_tokens(io.StringIO(cell.source).readline):
            assert (
                token.type in (tokenize.STRING, tokenize.COMMENT)
                or token.string.isascii()
                or "FSTRING" in tokenize.tok_name[token.type]
            ), token


def test_cells_contain_no_invisible_or_broken_characters(cells):
    for cell in cells:
        odd = {
            char
            for char in cell.source
            if char != "\n" and unicodedata.category(char) in ("Cc", "Cf", "Cn", "Co")
        }
        assert not odd | ({"\ufffd"} & set(cell.source)), f"{odd} in: {cell.source[:60]}"


def test_pictures_have_alt_text(cells):
    for cell in cells:
        for output in cell.get("outputs", ()):
            data = output.get("data", {})
            # JupyterLab and nbconvert drop the alt text of an image/png output; they keep an <img>
            # in HTML.
            assert not [kind for kind in data if kind.startswith("image/")], cell.source
            _assert_alt_texts(data.get("text/html", ""))
        if cell.cell_type == "markdown":
            _assert_alt_texts(cell.source)
            assert all(len(alt) > 20 for alt in re.findall(r"!\[(.*?)\]\(", cell.source, re.S))


def test_notebooks_have_one_title(prose):
    assert re.match(r"# \S", prose[0]) and len(re.findall(r"^# ", "\n".join(prose), re.M)) == 1


@every_lab
def test_labs_have_all_parts_in_the_same_order(lab):
    text = _prose(lab)
    for heading in HEADINGS:
        assert re.search(rf"^(#+ |\*\*){heading}", text, re.M), f"the part '{heading}' is missing"
    titles = re.findall(r"^## (.*)$", text, re.M)
    places = [titles.index(part) for part in titles if part.split(" (")[0] in PARTS]
    assert titles[places[0] :] == [titles[k] for k in places], "another section follows 'Your turn'"
    assert [PARTS.index(titles[k].split(" (")[0]) for k in places] == sorted(
        PARTS.index(titles[k].split(" (")[0]) for k in places
    ), "the parts are in a different order"
    numbered = [title for title in titles if re.match(r"\d", title)]
    assert [int(title.split(".")[0]) for title in numbered] == list(range(1, len(numbered) + 1))


@every_lab
def test_labs_do_not_exceed_the_size_limits(lab):
    length = lab_sizes.measure(lab)
    assert not lab_sizes.too_long(lab.stem, length), length


@every_lab
def test_labs_open_with_a_view(lab):
    """A lab opens with a title and a claim, and a cell of at most four lines that shows a view and
    needs no other cell.
    """
    cells = json.loads(lab.read_text(encoding="utf-8"))["cells"]
    first, view = cells[:2]
    assert not Cell("".join(view["source"])).reads - set(dir(builtins))
    assert re.search(r"\n\*\*[^*]+[.?!]\*\*", "".join(first["source"])), "no claim in bold"
    assert not lab_sizes.folded(view) and len(view["source"]) <= 4
    assert any("rk" in "".join(o.get("data", {}).get("text/html", "")) for o in view["outputs"])


@every_lab
def test_section_runs_alone_or_names_the_sections_to_run_first(lab):
    """The cells of a section read only names that are set in this section or in those that its text
    names: "Run section 2 first", "Run sections 2 and 4 first", 'Run "Your turn" first'. These
    sections may name others in turn.
    """
    sections = sections_of(lab)
    for title in sections:
        known = set(dir(builtins))
        for cell in with_sections_to_run_first(sections, title):
            assert not cell.reads - known, (title, cell.reads - known)
            known |= cell.writes


def sections_of(lab):
    """Return a dict that maps the title of each part of a lab to its text and its cells."""
    sections = {}
    title = "top"
    for cell in nbformat.read(lab, as_version=4).cells:
        if cell.cell_type == "markdown":
            for found in re.findall(r"^## (.*)$", cell.source, re.M):
                title = found
            sections.setdefault(title, (["\n"], []))[0].append(cell.source)
        else:
            sections.setdefault(title, (["\n"], []))[1].append(Cell(cell.source))
    return {
        title: (" ".join("\n".join(text).split()), made) for title, (text, made) in sections.items()
    }


def with_sections_to_run_first(sections, title):
    """The cells of a section, after those of the sections that have to run first."""
    needed, to_do = set(), [title]
    while to_do:
        now = to_do.pop()
        needed.add(now)
        to_do += [each for each in _run_first(sections, now) if each not in needed]
    return [cell for each in sections if each in needed for cell in sections[each][1]]


def _run_first(sections, title):
    """Return the titles of the sections that must run before the section `title`."""
    found = re.findall(r"\b[Rr]un sections? (\d+(?:(?:, | and )\d+)*) first", sections[title][0])
    first = {number for each in found for number in re.findall(r"\d+", each)}
    first |= {"Your turn"} if 'Run "Your turn" first' in sections[title][0] else set()
    return [each for each in sections if each.split(".")[0] in first]


def test_joints_are_counted_from_one(prose):
    titles = re.findall(r"^#+ .*$", "\n".join(prose), re.M)
    assert not [title for title in titles if re.search(r"\bq_?\{?0|q₀|[Jj]oint 0", title)]


def test_links_resolve(path, prose):
    for text in prose:
        for target in re.findall(r"\]\(([^)\s]+)\)", text):
            if not re.match(r"https?:|#|attachment:", target):
                assert (path.parent / target.split("#")[0]).exists(), target


# --- tests/execute_notebooks.py -------------------------------------------------------------------

PICTURE = """\
import base64, io
from IPython.display import HTML
from matplotlib.figure import Figure
fig = Figure()
fig.subplots().plot([1, 3, 2])
file = io.BytesIO()
fig.savefig(file, format="png")
HTML(f'<img alt="three" src="data:image/png;base64,{base64.b64encode(file.getvalue()).decode()}">')
"""


def test_executing_again_changes_nothing(tmp_path):
    path = _notebook(
        tmp_path / "a.ipynb",
        "print(1, flush=True)\nprint(2)",
        "import ipywidgets\nipywidgets.IntSlider(5)",
        PICTURE,
    )
    assert _execute(path).returncode == 0
    once = path.read_bytes()
    notebook = nbformat.reads(once.decode(), as_version=4)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert [cell.execution_count for cell in code] == [1, 2, 3]
    assert [len(cell.outputs) for cell in code] == [1, 1, 1] and code[0].outputs[0].text == "1\n2\n"
    assert set(notebook.metadata) == {"kernelspec", "language_info"}
    assert notebook.metadata.language_info.nbconvert_exporter == "python"
    assert notebook.cells[0].metadata == {"tags": ["intro"]}
    assert "unchanged" in _execute(path).stdout
    assert path.read_bytes() == once


def test_picture_compressed_by_another_zlib_version_keeps_its_bytes(tmp_path):
    path = _notebook(tmp_path / "a.ipynb", PICTURE)
    _execute(path)
    first = _png(path)
    image, file = Image.open(io.BytesIO(base64.b64decode(first))), io.BytesIO()
    image.save(file, "PNG", compress_level=1, dpi=image.info["dpi"])
    other = base64.b64encode(file.getvalue()).decode()
    assert len(other) > 1.05 * len(first)
    path.write_text(path.read_text().replace(first, other))
    assert "unchanged" in _execute(path).stdout and _png(path) == other
    path.write_text(path.read_text().replace("[1, 3, 2]", "[1, 3, 1]"))
    _execute(path)
    assert _png(path) not in (first, other), "the changed picture was not stored"


def test_failing_notebook_is_reported_and_the_others_run(tmp_path):
    bad, good = (
        _notebook(tmp_path / "bad.ipynb", "1 / 0"),
        _notebook(tmp_path / "good.ipynb", "6 * 7"),
    )
    before = bad.read_bytes()
    run = _execute(bad, good)
    assert run.returncode == 1
    assert "1 of 2 notebooks failed: bad.ipynb" in run.stdout and "ZeroDivisionError" in run.stdout
    assert bad.read_bytes() == before and '"42"' in good.read_text()


def _assert_alt_texts(source):
    for image in re.findall(r"<img\b[^>]*>", source):
        alt = re.search(r'\balt="([^"]*)"', image)
        assert alt and len(alt[1]) > 20, image[:200]


def _prose(path):
    cells = nbformat.read(path, as_version=4).cells
    return "\n".join(cell.source for cell in cells if cell.cell_type == "markdown")


def _png(path):
    return re.search("iVBOR[A-Za-z0-9+/=]+", path.read_text())[0]


def _notebook(path, *sources):
    """Write a notebook with these code cells."""
    v4 = nbformat.v4
    cells = [
        v4.new_markdown_cell("# A lab", id="title", metadata={"tags": ["intro"], "scrolled": True})
    ]
    cells += [v4.new_code_cell(source, id=f"cell-{i}") for i, source in enumerate(sources)]
    nbformat.write(v4.new_notebook(cells=cells, metadata={"widgets": {}}), path)
    return path


def _execute(*paths):
    return subprocess.run(
        [sys.executable, ROOT / "tests" / "execute_notebooks.py", *paths],
        text=True,
        capture_output=True,
        timeout=PATIENCE,
    )


# --- Documents for teachers -----------------------------------------------------------------------


def test_minutes_in_the_teacher_notes_are_up_to_date():
    rows = re.findall(
        r"^\| \[(\d\d)[^\]]*\]\(\.\./(\S+)\) \| (\d+) \| (\d+) \|", _prose(TEACHING), re.M
    )
    assert [row[1] for row in rows] == [lab.name for lab in LABS]
    for (number, _, core, whole), lab in zip(rows, LABS, strict=True):
        assert number == lab.stem[:2]
        length = lab_sizes.measure(lab)
        minutes = round(length.core.minutes), round(length.whole.minutes)
        assert (int(core), int(whole)) == minutes, lab.stem


def test_teacher_notes_have_the_same_parts_for_every_lab():
    parts = re.split(r"^## (\d\d) ", _prose(TEACHING), flags=re.M)[1:]
    assert parts[::2] == [lab.stem[:2] for lab in LABS[1:]]
    for text in parts[1::2]:
        for word in ("Before it", "frequent mistakes", "An oral question", "Answer", "textbooks"):
            assert word.lower() in text.lower(), f"{word}: {text[:40]}"


def test_glossary_is_sorted_and_in_three_languages():
    rows = re.findall(r"^\| (.+?) \| (.+?) \| (.+?) \| (.+?) \| (.+?) \|$", _prose(GLOSSARY), re.M)
    rows = rows[2:]  # skip the header and the separator below it
    assert len(rows) > 80
    words = [row[0].lower() for row in rows]
    assert words == sorted(words) and len(set(words)) == len(words)
    assert sum(bool(re.search("[а-я]", row[1])) for row in rows) > 60
    assert sum(row[2] != "–" for row in rows) > 60
