"""Exported pages and the site on narrow screens, on paper and in a screen reader."""

import io
import json
import shutil

import nbformat
import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import NOTEBOOKS, awake
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output
from PIL import Image
from test_browser import NEXT_FRAME

from robokin import IRB140
from robokin.course import site as making
from robokin.course.export import View, export
from robokin.course.predictions import ASLEEP
from robokin.show import figure, plot_postures
from robokin.show.markup import STILL

LABS = [path.stem for path in sorted(NOTEBOOKS.glob("*.ipynb"))]
SOME = ("01_frames_and_quaternions", "06_spherical_wrist", "12_two_link_code_generation")
WIDE, LAPTOP, PHONE, PAPER = 1366, 914, 390, 698  # A4 between margins of half an inch: 698 px
PARTS = "details.rk-code"


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """A site of three labs, built in the same way as the full site."""
    source = tmp_path_factory.mktemp("site") / "source"
    source.mkdir()
    for name in ("conf.py", "static", "templates"):
        there = making.HERE / name
        (shutil.copytree if there.is_dir() else shutil.copyfile)(there, source / name)
    for lab in SOME:
        shutil.copyfile(NOTEBOOKS / f"{lab}.ipynb", source / f"{lab}.ipynb")
    (source / "index.md").write_text("# Labs\n\n```{toctree}\n" + "\n".join(SOME) + "\n```\n")
    (source / "sizes.json").write_text(json.dumps({"version": "0", "sizes": {}}))
    making._run(source, source.with_name("made"))
    return source.with_name("made")


@pytest.fixture(scope="module")
def pages(small, exported):
    """`pages("site" or "export", lab)` is the address of a page."""
    return lambda kind, lab: (exported[lab] if kind == "export" else small / f"{lab}.html").as_uri()


@pytest.fixture
def opened(browser):
    """`opened(address, width, ...)` is a page of that width. It closes after the test."""
    contexts = []

    def opening(address, width, **options):
        contexts.append(browser.new_context(viewport={"width": width, "height": 900}, **options))
        page = contexts[-1].new_page()
        page.goto(address)
        return page

    yield opening
    for context in contexts:
        context.close()


# --- Screens --------------------------------------------------------------------------------------

# The lines of paragraphs and lists outside views, tables and outputs, without formulas.
LINES = """() => {
  const found = [], range = document.createRange();
  for (const node of document.querySelectorAll(":is(main, article) :is(p, li, dd)")) {
    if (node.closest(".robokin-player, table, summary, .jp-OutputArea")) continue;
    const walk = document.createTreeWalker(node, NodeFilter.SHOW_TEXT);
    let line = "", bottom = -Infinity;
    for (let text; (text = walk.nextNode());) {
      if (text.parentElement.closest("math, pre, li li")) continue;
      for (let k = 0; k < text.length; k++) {
        range.setStart(text, k);
        range.setEnd(text, k + 1);
        const [box] = range.getClientRects();
        if (!box) continue;
        if (box.top > bottom - 1) {
          found.push(line.trim());
          [line, bottom] = ["", box.bottom];
        }
        line += text.data[k];
      }
    }
    found.push(line.trim());
  }
  return found;
}"""


@pytest.mark.parametrize("kind", ["export", "site"])
@pytest.mark.parametrize("lab", SOME)
def test_lines_have_at_most_75_characters(pages, opened, lab, kind):
    for width in (WIDE, LAPTOP):
        lines = opened(pages(kind, lab), width).evaluate(LINES)
        assert 60 < max(map(len, lines)) <= 75, max(lines, key=len)


# The texts that are partly hidden: they extend beyond the window or beyond a box that does not
# scroll.
CUT = """() => {
  const range = document.createRange(), cut = [];
  const walk = document.createTreeWalker(document.querySelector("main, article"), 4);
  for (let text; (text = walk.nextNode());) {
    const within = text.parentElement, seen = within.checkVisibility();
    if (!text.data.trim() || within.closest(".robokin-player") || !seen) continue;
    range.selectNodeContents(text);
    const right = range.getBoundingClientRect().right;
    let box = within, hidden = false;
    const style = () => getComputedStyle(box).overflowX;
    const scrolls = () => /auto|scroll/.test(style()) && box.scrollWidth > box.clientWidth;
    for (; box && !scrolls() && !hidden; box = box.parentElement)
      hidden = /hidden|clip/.test(style()) && right > box.getBoundingClientRect().right + 1;
    if (hidden || !box && right > innerWidth + 1) cut.push(text.data.slice(0, 80));
  }
  return cut;
}"""


@pytest.mark.parametrize("lab", LABS)
def test_exported_lab_fits_a_phone_without_scrolling_sideways(exported, opened, lab):
    page = opened(exported[lab].as_uri(), PHONE)
    for open_ in (False, True):
        page.evaluate(
            "open => document.querySelectorAll('details').forEach(d => { d.open = open; })", open_
        )
        page.evaluate(NEXT_FRAME)
        assert page.evaluate("() => document.documentElement.scrollWidth") <= PHONE
        assert page.evaluate(CUT) == []


def notebook(*cells):
    return new_notebook(cells=list(cells))


def printed(text):
    outputs = [new_output("stream", name="stdout", text=text)]
    return new_code_cell("x = 1  # " + "long " * 40, outputs=outputs)


def latex(text):
    return new_code_cell("f", outputs=[new_output("execute_result", {"text/latex": text})])


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The address of a page with wide code, wide printed text, a wide formula and a wide table."""
    path = tmp_path_factory.mktemp("wide") / "wide.ipynb"
    sums = " + ".join(f"x_{{{k}}}" for k in range(100, 160))
    words = [f"wordwithoutend{k}" for k in range(20)]
    table = f"| {' | '.join(words)} |\n{'|---' * 20}|\n| {' | '.join(words)} |"
    row = " ".join(f"{k / 7:.6f}" for k in range(40))
    cells = notebook(new_markdown_cell(f"# Wide\n\n$${sums}$$\n\n{table}"), printed(f"{row}\n" * 3))
    nbformat.write(cells, path)
    export(path, path.with_suffix(".html"))
    return path.with_suffix(".html").as_uri()


BOXES = ("math[display=block]", "table", ".highlight pre", ".jp-OutputArea pre")


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("box", BOXES)
def test_box_has_a_shadow_exactly_where_its_content_is_cut_off(made, opened, box, scheme):
    page = opened(made, PHONE, color_scheme=scheme)
    page.evaluate("document.querySelectorAll('details').forEach(d => { d.open = true; })")
    found = page.locator(box).first
    # show only the shadows, without text and lines
    page.add_style_tag(content=f"{box} * {{ visibility: hidden; border-color: transparent; }}")
    page.add_style_tag(
        content=f"{box} {{ color: color-mix(in srgb, currentColor, transparent 0%); }}"
    )
    goes_on = found.evaluate("box => box.scrollWidth - box.clientWidth")
    assert goes_on > 200
    for at, left, right in ((0, False, True), (goes_on // 2, True, True), (goes_on, True, False)):
        found.evaluate("(box, at) => { box.scrollLeft = at; }", at)
        page.evaluate(NEXT_FRAME)
        shown = Image.open(io.BytesIO(found.screenshot())).convert("L")
        middle = shown.height - 3  # below the last line
        paper = shown.getpixel((shown.width // 2, middle))
        shaded = [abs(shown.getpixel((x, middle)) - paper) > 40 for x in (1, shown.width - 2)]
        assert shaded == [left, right], f"scrolled by {at} px"


def test_phone_shows_the_middle_of_a_spatial_figure_and_the_left_of_a_plot(tmp_path, opened):
    space = plot_postures(IRB140, [[0, 0, 0, 0, 0, 0], [1, 0.5, 0.2, 0, 1, 0]])
    plot = figure("A line that rises.", width=9, height=3)
    plot.subplots().plot([0, 1], [0, 1])
    outputs = [
        new_output("display_data", {"text/html": each._repr_mimebundle_()["text/html"]})
        for each in (space, plot)
    ]
    path = tmp_path / "two.ipynb"
    nbformat.write(notebook(*[new_code_cell("fig", outputs=[each]) for each in outputs]), path)
    export(path, path.with_suffix(".html"))
    page = opened(path.with_suffix(".html").as_uri(), PHONE)
    boxes = page.locator(".robokin-figure").evaluate_all(
        "all => all.map(e => [e.scrollLeft, e.scrollWidth - e.clientWidth])"
    )
    (middle, room), (left, other) = boxes
    assert min(room, other) > 100
    assert middle == pytest.approx(room / 2, abs=1) and left == 0


def test_printed_text_keeps_its_line_breaks_on_a_phone(made, opened):
    box = opened(made, PHONE).locator(".jp-OutputArea pre")
    high, line = box.evaluate("b => [b.clientHeight, parseFloat(getComputedStyle(b).lineHeight)]")
    assert 2.5 * line < high < 4.5 * line, "wanted three lines"
    assert box.get_attribute("tabindex") == "0", "the keyboard cannot scroll it"


# --- Folded code ----------------------------------------------------------------------------------


# Whether the code of each cell and the word "code" are visible
SEEN = """all => all.map(d => [d.querySelector("pre"), d.firstElementChild]
    .map(e => e.checkVisibility()))"""


@pytest.mark.parametrize("kind", ["export", "site"])
def test_code_is_folded_on_a_phone_and_open_elsewhere(pages, opened, kind):
    address = pages(kind, SOME[2])
    page = opened(address, LAPTOP)
    assert page.locator(PARTS).count() > 10
    assert {*map(tuple, page.locator(PARTS).evaluate_all(SEEN))} == {(True, False)}
    page = opened(address, PHONE)
    assert {*map(tuple, page.locator(PARTS).evaluate_all(SEEN))} == {(False, True)}
    first = page.locator(PARTS).first
    assert first.locator("summary").inner_text() == "code"
    first.locator("summary").click()
    page.emulate_media(media="print")
    page.evaluate(NEXT_FRAME)
    assert {*map(tuple, page.locator(PARTS).evaluate_all(SEEN))} == {(True, False)}
    page.emulate_media(media="screen")
    page.evaluate(NEXT_FRAME)
    states = page.locator(PARTS).evaluate_all("all => all.map(d => d.open)")
    assert states == [True] + [False] * (len(states) - 1), "printing changed which cells are open"
    page = opened(address, PHONE, java_script_enabled=False)
    assert page.locator(f"{PARTS} pre").first.is_visible(), (
        "without scripts, the code is not visible"
    )


@pytest.mark.parametrize("kind", ["export", "site"])
def test_what_is_folded_can_be_touched_on_a_phone(pages, opened, kind):
    page = opened(pages(kind, SOME[1]), PHONE)
    awake(page)
    sizes = page.evaluate("""() => [...document.querySelectorAll(":is(main, article) summary")]
        .filter(e => e.checkVisibility()).map(e => e.getBoundingClientRect())
        .map(({width, height}) => Math.min(width, height))""")
    assert len(sizes) > 5 and min(sizes) >= 43.95


def test_code_is_never_visible_before_it_is_folded(browser, exported):
    context = browser.new_context(viewport={"width": PHONE, "height": 900})
    page = context.new_page()
    page.add_init_script(
        """window.most = 0;
        const look = () => {
          most = Math.max(most, document.querySelectorAll("details.rk-code[open]").length);
          requestAnimationFrame(look);
        };
        look();"""
    )
    page.goto(exported[SOME[2]].as_uri())
    page.evaluate(NEXT_FRAME)
    assert page.locator(PARTS).count() > 10 and page.evaluate("most") == 0
    context.close()


# --- Formulas of outputs --------------------------------------------------------------------------


def outputs(text, lenient=True):
    view = View(NOTEBOOKS, lenient=lenient)
    (cell,) = view.cells(notebook(latex(text)))
    return str(cell["outputs"][0]["html"]), view.remarks


def test_latex_outputs_become_formulas():
    for tex, block in ((r"$\displaystyle \frac{1}{2}$", True), ("$$x^2$$", True), ("$x$", False)):
        shown, remarks = outputs(tex)
        assert shown.startswith("<math") and ('display="block"' in shown) == block
        assert "$" not in shown and "\\" not in shown and remarks == []
    assert outputs(r"\[ x^2 \]")[0].startswith('<math display="block">')
    words, _ = outputs("<b>so</b> $x$ & $y$ hold")
    assert words.count("<math") == 2 and "&lt;b&gt;so&lt;/b&gt; " in words and " &amp; " in words


def test_invalid_latex_is_shown_as_it_was_typed_with_a_note():
    shown, remarks = outputs(r"$\nonsense$")
    assert shown == r"<code>$\nonsense$</code>"
    assert len(remarks) == 1 and "as it was typed" in remarks[0]
    with pytest.raises(ValueError, match="nonsense"):
        outputs(r"$\nonsense$", lenient=False)


@pytest.mark.parametrize(
    "text",
    [
        "$" * 90_000,
        "$x$ " * 20_000,
        "$" + "\\a" * 20_000 + "$",
        "\\[" * 20_000,
        "\\begin{a}" * 5_000,
        "$" + "{" * 1_000 + "}" * 1_000 + "$",
        "$\\text{<script>hacked=1</script>}$ <script>hacked=1</script> \u202e",
        r"$\href{javascript:hacked}{x}$",
    ],
)
def test_malicious_latex_is_harmless(text):
    shown, _ = outputs(text)
    assert "<script" not in shown and "href" not in shown.replace("\\href", "")
    assert "\u202e" not in shown and len(shown) < 1_000_000


# --- Paper ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["export", "site"])
def test_formulas_and_code_fit_on_paper(pages, opened, kind):
    for lab in SOME if kind == "site" else (*SOME, "documents/004_six_axis_arm"):
        page = opened(pages(kind, lab), PAPER)
        page.emulate_media(media="print")
        page.evaluate(NEXT_FRAME)
        out = page.evaluate(
            """() => [...document.querySelectorAll(":is(main, article) :is(math, pre, mo, mi)")]
            .filter(e => e.checkVisibility() && e.getBoundingClientRect().right > innerWidth + 1)
            .map(e => e.textContent.slice(0, 60))"""
        )
        assert out == [], lab
        assert page.evaluate("() => document.documentElement.scrollWidth") <= PAPER
        assert not page.get_by_text("Skip to content").is_visible()


def test_views_and_figures_are_not_split_across_pages(pages, opened):
    page = opened(pages("export", SOME[1]), PAPER)
    page.emulate_media(media="print")
    for kind in (".robokin-player", ".jp-OutputArea img", ".jp-OutputArea-child", "math"):
        said = page.locator(kind).first.evaluate("e => getComputedStyle(e).breakInside")
        assert said.startswith("avoid"), kind


# --- Screen readers and wording -------------------------------------------------------------------

RULES = {"label-content-name-mismatch": {"enabled": True}}


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("lab", SOME)
def test_screen_reader_can_use_an_exported_lab(exported, opened, lab, scheme):
    page = opened(exported[lab].as_uri(), WIDE, color_scheme=scheme)
    awake(page)
    violations = Axe().run(page, options={"rules": RULES}).response["violations"]
    if scheme == "light":  # also test what scrolls on a phone; views are tested elsewhere
        phone, more = opened(exported[lab].as_uri(), PHONE), {"exclude": [[".robokin-player"]]}
        violations += (
            Axe().run(phone, context=more, options={"rules": RULES}).response["violations"]
        )
    assert {rule["id"]: [n["html"][:160] for n in rule["nodes"]] for rule in violations} == {}


def test_folded_cells_and_table_corners_of_the_site_have_accessible_names(pages, opened):
    page = opened(pages("site", SOME[1]), WIDE)
    rules = [*RULES, "empty-table-header", "summary-name", "scrollable-region-focusable"]
    options = {"runOnly": {"type": "rule", "values": rules}}
    assert Axe().run(page, options=options).response["violations"] == []


def test_pages_do_not_tell_their_readers_to_use_jupyter(pages, small, exported):
    for kind in ("export", "site"):
        for lab in SOME:
            path = exported[lab] if kind == "export" else small / f"{lab}.html"
            text = path.read_text(encoding="utf-8")
            assert STILL not in text and ASLEEP not in text
    index = (small / "searchindex.js").read_text(encoding="utf-8")
    found = json.loads(index[index.index("{") : index.rindex("}") + 1])
    assert len(found["terms"]) > 500
    says = found["terms"].get("trust", [])  # lab 06 says that some formulas are to be trusted
    for k in [says] if isinstance(says, int) else says:
        page = (small / f"{found['docnames'][k]}.html").read_text(encoding="utf-8")
        assert "to be trusted" in page and "trust the notebook" not in page


def test_without_scripts_a_still_picture_is_labelled_as_one(exported, opened):
    page = opened(exported[SOME[0]].as_uri(), WIDE, java_script_enabled=False)
    said = page.locator(".robokin-player > p:empty").first
    assert "still picture" in said.evaluate("p => getComputedStyle(p, '::after').content")
    page.emulate_media(media="print")
    assert said.evaluate("p => getComputedStyle(p, '::after').content") == "none", "shown on paper"
    assert not page.locator(".robokin-unguessed > summary").first.is_visible(), "shown on paper"
