"""`python -m robokin.course site`: every page is opened in a real browser, and every link is
checked.
"""

import importlib
import inspect
import json
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from types import SimpleNamespace
from urllib.parse import unquote, urlsplit

import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import NOTEBOOKS, REPOSITORY, ROOT, awake, until
from test_browser import NEXT_FRAME, PLAYER, _opens, _seen, _settled
from test_export import FETCHED, formulas

from robokin.course import site as making
from robokin.course.__main__ import main
from robokin.course.site import conf

PATHS = [*sorted(NOTEBOOKS.glob("*.ipynb")), *sorted(NOTEBOOKS.glob("documents/*.ipynb"))]
NAMES = [path.relative_to(NOTEBOOKS).with_suffix("").as_posix() for path in PATHS]
LABS = [name for name in NAMES if "/" not in name]
MODULES = making._modules()
PAGES = ["index", "hand_in", *NAMES, "api/index", *(f"api/{name}" for name in MODULES), "search"]
WIDTHS = (1366, 900, 390)


def command(folder, **more):
    return subprocess.run(
        [sys.executable, "-m", "robokin.course", "site", str(folder)],
        text=True,
        capture_output=True,
        timeout=900,
        **more,
    )


class Parsed(HTMLParser):
    """The addresses that a page loads, its links, its anchors, and its text without scripts."""

    def __init__(self, text):
        super().__init__()
        self.loads, self.links, self.ids, self.words, self.count = [], [], {""}, [], {}
        self.headings, self.nameless = [], []
        self.silent = self.article = False
        self.feed(text)
        self.text = " ".join("".join(self.words).split())

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        if attrs.get("id"):
            self.ids.add(attrs["id"])
        if tag == "a" and "href" in attrs:
            self.links.append(attrs["href"])
        elif FETCHED.get(tag) in attrs and attrs.get("rel") not in ("next", "prev", "search"):
            self.loads.append(attrs[FETCHED[tag]])
        if tag == "img" and not attrs.get("alt", "").strip():
            self.nameless.append(attrs.get("src", "")[:80])
        self.headings += [int(level) for level in re.findall("^h([1-6])$", tag)]
        self.silent = tag in ("script", "style")
        self.article = self.article or tag == "article"
        if self.article:
            self.words.append(" " * (tag in ("dd", "dt", "p")))
            kind = f"{tag}.hide" if "hide" in (attrs.get("class") or "").split() else tag
            self.count[kind] = self.count.get(kind, 0) + 1

    def handle_endtag(self, tag):
        self.silent = False
        self.article = self.article and tag != "article"

    def handle_data(self, data):
        if self.article and not self.silent:
            self.words.append(data)


@pytest.fixture(scope="session")
def parsed(site):
    """Every page, parsed, by name."""
    return {
        path.relative_to(site).with_suffix("").as_posix(): Parsed(path.read_text(encoding="utf-8"))
        for path in site.rglob("*.html")
    }


def test_site_has_exactly_the_expected_pages(parsed):
    assert sorted(parsed) == sorted(PAGES)


def test_all_links_resolve(site, parsed):
    wrong = []
    for name, page in parsed.items():
        here = site / f"{name}.html"
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme in ("http", "https"):
                continue
            to = (here.parent / unquote(parts.path)).resolve() if parts.path else here
            known = parsed.get(to.relative_to(site.resolve()).with_suffix("").as_posix())
            found = to.is_file() and (not known or unquote(parts.fragment) in known.ids)
            if not found:
                wrong.append(f"{name}: {link}")
    assert wrong == []


def test_pages_load_nothing_from_other_hosts(site, parsed):
    for name, page in parsed.items():
        for address in page.loads:
            parts = urlsplit(address)
            assert parts.scheme in ("", "data") and not parts.netloc, f"{name}: {address}"
            if not parts.scheme:
                assert (site / f"{name}.html").parent.joinpath(parts.path).is_file(), address
    for style in site.rglob("*.css"):
        assert not re.search(r"@import|url\(['\"]?(https?:)?//", style.read_text()), style


def test_exercises_are_copied_unchanged(site):
    folder = NOTEBOOKS / "exercises"
    files = [p for p in folder.rglob("*") if p.is_file() and "__pycache__" not in p.parts]
    copies = [p for p in (site / "exercises").rglob("*") if p.is_file()]
    assert len(files) == len(copies) > 100
    for file in files:
        assert (site / "exercises" / file.relative_to(folder)).read_bytes() == file.read_bytes()


@pytest.mark.parametrize("path", PATHS, ids=NAMES)
def test_a_notebook_is_on_its_page_and_can_be_downloaded(path, site, parsed):
    name = path.relative_to(NOTEBOOKS).with_suffix("").as_posix()
    page, cells = parsed[name], json.loads(path.read_text(encoding="utf-8"))["cells"]
    written = sum("text/latex" in o.get("data", ()) for c in cells for o in c.get("outputs", ()))
    assert page.count.get("math", 0) == len(list(formulas(path))) + written
    folded = sum("hide-input" in cell["metadata"].get("tags", ()) for cell in cells)
    assert page.count.get("details.hide", 0) == folded
    code = " ".join("".join(c["source"]) for c in cells if c["cell_type"] == "code").split()
    assert set(code) <= set(page.text.split())
    assert path.name in page.links
    assert (site / f"{name}.ipynb").read_bytes() == path.read_bytes()


def test_every_page_names_the_repository(parsed):
    for name, page in parsed.items():
        assert page.links.count(REPOSITORY) == 1, name


def test_hand_in_page_has_the_commands_of_the_readme():
    program = re.compile(r"```(?:sh|powershell)\n.*?```", re.S)
    page = (making.HERE / "hand_in.md").read_text(encoding="utf-8")
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert program.findall(page) == program.findall(readme)[:2]


NOT_HERE = "Run All|Trust Notebook|Ctrl\\+|Esc, then|in a terminal|on the site:"


def test_pages_do_not_tell_the_reader_to_use_jupyterlab_commands(parsed):
    start = (NOTEBOOKS / "00_start_here.ipynb").read_text(encoding="utf-8")
    assert {*re.findall(NOT_HERE, start)} == {*NOT_HERE.replace("\\", "").split("|")}
    for name, page in parsed.items():
        assert not re.search(f".{{0,60}}({NOT_HERE})", page.text), name


@pytest.mark.parametrize(
    "text, there",
    [
        ("a\nb\n<!-- on the site: c d -->\ne", "a\nc d\ne"),
        ("a\nb\n<!-- on the site: -->\ne", "a\ne"),
        ("a\n<!-- on the site: c -->", "c"),
        ("- a\n  <!-- on the site: - b -->\n- c", "- b\n- c"),
        ("a\n```sh\nb\n\nc\n```\n<!-- on the site: -->\nd", "a\nd"),
        ("```sh\na\n```\nb\n<!-- on the site: c -->", "```sh\na\n```\nc"),
        ("a\n<!-- b -->\nc", "a\n<!-- b -->\nc"),
    ],
)
def test_a_notebook_has_other_words_on_the_site(text, there):
    cells = [{"cell_type": kind, "source": text.splitlines(True)} for kind in ("markdown", "code")]
    source = [json.dumps({"cells": cells})]
    app = SimpleNamespace(env=SimpleNamespace(doc2path=lambda name: f"{name}.ipynb"))
    conf._in_other_words(app, "lab", source)
    words, code = ("".join(cell["source"]) for cell in json.loads(source[0])["cells"])
    assert words == there and code == text


def test_pictures_have_alt_text_and_headings_are_ordered(parsed):
    for name, page in parsed.items():
        assert page.nameless == [], name
        assert name == "search" or page.headings[0] == 1 and page.headings.count(1) == 1, name
        steps = zip(page.headings[:-1], page.headings[1:], strict=True)
        assert all(after <= before + 1 for before, after in steps), name
    assert sum(map(len, (page.headings for page in parsed.values()))) > 200


def test_links_to_sections_lead_to_them(parsed):
    named = re.compile(r"\[[^]]*§(\d+)\]\(([\w./]*\.ipynb|#)\)")
    for name, path in zip(NAMES, PATHS, strict=True):
        sections = [section for section, _ in named.findall(path.read_text(encoding="utf-8"))]
        led = [to.partition("#section-")[2] for to in parsed[name].links if "#section-" in to]
        assert led == sections, name
    assert any("#section-" in to for to in parsed["documents/001_irb140_and_scara"].links)


@pytest.mark.parametrize("module", MODULES)
def test_every_docstring_is_in_the_reference(module, parsed):
    page, module = parsed[f"api/{module}"], importlib.import_module(module)
    public = getattr(module, "__all__", None) or [n for n in vars(module) if not n.startswith("_")]
    things = [module]
    for thing in (getattr(module, name) for name in public):
        if not (inspect.isclass(thing) or inspect.isfunction(thing)):
            continue
        if hasattr(module, "__all__") or thing.__module__ == module.__name__:
            things.append(thing)
            if inspect.isclass(thing):
                own = (one for name, one in vars(thing).items() if not name.startswith("_"))
                things += [one for one in own if _of_robokin(one)]
    for thing in things:
        for words in (inspect.getdoc(thing) or "").replace("`", "").split("\n"):
            assert " ".join(words.split()) in page.text.replace("`", ""), (thing, words)


def _of_robokin(one):
    return inspect.isfunction(one) and one.__module__.startswith("robokin")


# --- Pages in a browser ---------------------------------------------------------------------------


@pytest.fixture(scope="module")
def address(site_address):
    return site_address


@pytest.fixture(scope="module")
def page(browser, address):
    """One page for all tests. It records console errors in `errors` and requests to other hosts in
    `outside`.
    """
    context = browser.new_context(viewport={"width": 1366, "height": 900}, color_scheme="light")
    page = context.new_page()
    page.errors, page.outside = [], []
    page.on("request", lambda r: _foreign(r.url, address) and page.outside.append(r.url))
    page.on("console", lambda m: m.type == "error" and page.errors.append(f"{page.url}: {m.text}"))
    page.on("pageerror", lambda error: page.errors.append(f"{page.url}: {error}"))
    yield page
    context.close()


def _foreign(url, address):
    return not url.startswith((address, "data:", "blob:", "file:"))


@pytest.mark.parametrize("name", PAGES)
def test_a_page_fits_three_widths_without_errors(page, address, name):
    page.set_viewport_size({"width": WIDTHS[0], "height": 900})
    page.goto(f"{address}{name}.html")
    awake(page)
    for width in WIDTHS:
        page.set_viewport_size({"width": width, "height": 900})
        page.evaluate(NEXT_FRAME)
        wide = page.evaluate("() => document.documentElement.scrollWidth")
        assert wide <= width, f"{width} px: {_too_wide(page)}"
    words = page.locator("article").evaluate("""article => {
        const copy = article.cloneNode(true);
        for (const node of copy.querySelectorAll("pre, code, script, style, math")) node.remove();
        return copy.textContent; }""")
    raw = re.search(r"\$[^$]*\$|\\\(|\\[a-zA-Z]{2,}|\\begin", words)
    assert not raw, f"TeX that is not rendered: {raw[0]}"
    assert page.outside == [] and page.errors == []


def _too_wide(page):
    return page.evaluate("""() => [...document.querySelectorAll("article *")]
        .filter(node => node.getBoundingClientRect().right > innerWidth + 1)
        .slice(0, 5).map(node => node.outerHTML.slice(0, 200))""")


@pytest.mark.parametrize("lab", ["index", *LABS])
def test_arm_can_be_dragged(page, address, lab):
    page.set_viewport_size({"width": 1366, "height": 900})
    page.goto(f"{address}{lab}.html")
    awake(page)
    players = [one for one in page.locator(PLAYER).all() if one.locator("canvas").count()]
    assert players
    # views that need a kernel are disabled here; taps on their points do not move them
    held = page.locator(f"{PLAYER} .rk-handle:not([inert] *, .rk-taps *)")
    slides = f"{PLAYER} :is(.rk-slide input[type=range], .rk-long input):not([inert] *)"
    held = (held if held.count() else page.locator(slides)).first
    held.scroll_into_view_if_needed()
    page.evaluate(NEXT_FRAME)
    before = [_seen(one) for one in players]
    box = held.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 40, y - 25, steps=4)
    page.mouse.up()
    page.evaluate(NEXT_FRAME)
    moved = [i for i, one in enumerate(players) if _seen(one) != before[i]]
    assert len(moved) == 1, "only the arm that is dragged should move"
    for question in page.locator(".rk-ask").all()[:1]:
        _opens(question)
    assert page.outside == [] and page.errors == []


def test_theme_applies_to_the_arms(page, address):
    page.goto(f"{address}index.html")
    awake(page)
    player = page.locator(PLAYER).first
    seen, paper = (
        _settled(page, player).pixels,
        "e => getComputedStyle(e).getPropertyValue('--rk-paper')",
    )
    light, looks = player.evaluate(paper), set()
    for _ in range(3):
        page.locator(".theme-toggle:visible").first.click()
        page.evaluate(NEXT_FRAME)
        theme = page.evaluate("() => document.body.dataset.theme")
        looks.add(theme)
        assert (player.evaluate(paper) == light) == (theme != "dark")
        assert (_seen(player).pixels == seen) == (theme != "dark")
    assert looks == {"auto", "light", "dark"}
    page.emulate_media(color_scheme="dark")
    page.evaluate(NEXT_FRAME)
    follows = page.evaluate("() => document.body.dataset.theme") == "auto"
    assert (player.evaluate(paper) != light) == follows
    page.emulate_media(color_scheme="light")


def test_search_finds_pages(page, address):
    page.goto(f"{address}search.html?q=singularity")
    results = page.locator("#search-results li")
    until(lambda: results.count() > 3, "nothing is found", page)
    assert page.locator("#search-results a[href*='06_spherical_wrist']").count()
    page.goto(f"{address}search.html?q=nonsensical")
    page.locator("#search-results").get_by_text("did not match any documents").wait_for()
    assert page.outside == [] and page.errors == []


def test_site_works_from_a_folder(page, site):
    page.goto((site / "index.html").as_uri())
    page.locator(f"{PLAYER}[data-ready] canvas").first.wait_for()
    assert page.outside == [] and page.errors == []


@pytest.mark.parametrize("name", ["index", "00_start_here"])
def test_screen_reader_can_use_the_site(page, address, name):
    page.goto(f"{address}{name}.html")
    awake(page)
    found = {
        rule["id"]: [node["html"][:160] for node in rule["nodes"]]
        for rule in Axe().run(page).response["violations"]
        if rule["impact"] != "minor"
    }
    assert found == {}


# --- The command ----------------------------------------------------------------------------------


def test_the_notes_for_teachers_can_be_left_out(tmp_path, monkeypatch):
    notebooks = [path for path in PATHS if path.name != "teaching.ipynb"]
    assert len(notebooks) == len(PATHS) - 1
    source = tmp_path / "source"
    making._gather(NOTEBOOKS, notebooks, source)
    words = (source / "index.md").read_text()
    assert "documents/glossary" in words and "You teach" in words
    for file in source.rglob("*.ipynb"):
        words += file.read_text(encoding="utf-8")
    assert "teaching.ipynb" not in words and "documents/teaching" not in words
    asked = []
    monkeypatch.setattr(making, "build", lambda *given: asked.append(given) or "")
    for more in ([], ["--no-teaching"], ["--repository", REPOSITORY]):
        assert main(["site", str(tmp_path), *more]) == 0
    assert asked == [(tmp_path, True, ""), (tmp_path, False, ""), (tmp_path, True, REPOSITORY)]


def test_the_answers_to_the_oral_questions_are_folded(page, address):
    page.goto(f"{address}/documents/teaching.html")
    answers = page.locator("details", has=page.get_by_text("Answer", exact=True))
    assert answers.count() == len(LABS) - 1  # lab 00 has no oral question
    first = answers.first.locator("p").first
    assert not first.is_visible()
    answers.first.locator("summary").click()
    assert first.is_visible()


def test_other_files_are_kept(tmp_path):
    (tmp_path / "mine.txt").write_text("mine")
    run = command(tmp_path)
    assert run.returncode == 1 and "nothing was overwritten" in run.stderr
    assert "Traceback" not in run.stderr and str(tmp_path) in run.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]
    file = tmp_path / "mine.txt"
    with pytest.raises(ValueError, match="nothing was overwritten"):
        making._older(file)


@pytest.mark.parametrize(
    "address",
    [
        "http://example.org/robokin",
        "https://example.org",
        "example.org/robokin",
        "https://me:secret@example.org/robokin",
        'https://example.org/"onclick="',
        "https://example.org/robokin\n",
        "https://example.org/robokin?a=1",
    ],
)
def test_an_address_that_is_not_a_repository_is_refused(address, tmp_path):
    with pytest.raises(ValueError, match="repository: wanted an address such as https.*, got"):
        making.build(tmp_path / "site", repository=address)
    assert not (tmp_path / "site").exists()


def laid(folder, **files):
    for name, text in files.items():
        path = folder / name.replace("__", "/").replace("_", ".")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


def read(folder):
    return {
        path.relative_to(folder).as_posix(): path.read_text()
        for path in folder.rglob("*")
        if path.is_file() and path.name != making.MARK
    }


def test_newer_site_replaces_an_older_one(tmp_path):
    older = laid(tmp_path / "older", index_html="1", labs__gone_html="1", labs__kept_html="1")
    newer = laid(tmp_path / "newer", index_html="2", labs__kept_html="2", new__new_html="2")
    folder = tmp_path / "site"
    making._put(older, folder)
    assert read(folder) == read(older)
    laid(folder, CNAME="mine", labs__mine_txt="mine")
    making._put(newer, folder)
    assert read(folder) == read(newer) | {"CNAME": "mine", "labs/mine.txt": "mine"}
    before = read(folder)
    laid(folder, labs__gone_html="mine")
    with pytest.raises(ValueError, match=r"gone.html: not a file of the site"):
        making._put(older, folder)
    assert read(folder) == before | {"labs/gone.html": "mine"}


@pytest.mark.parametrize("stop", range(8))
def test_next_build_completes_an_interrupted_build(tmp_path, monkeypatch, stop):
    older = laid(tmp_path / "older", index_html="1", gone_html="1")
    newer = laid(tmp_path / "newer", index_html="2", new_html="2", newest_html="2")
    folder = tmp_path / "site"
    making._put(older, folder)
    left, replace, copy = iter(range(stop)), making.os.replace, making.shutil.copyfile

    def stopping(work):
        def step(*given):
            if next(left, None) is None:
                raise KeyboardInterrupt
            return work(*given)

        return step

    with monkeypatch.context() as patch:
        patch.setattr(making.os, "replace", stopping(replace))
        patch.setattr(making.shutil, "copyfile", stopping(copy))
        try:
            making._put(newer, folder)
        except KeyboardInterrupt:
            assert stop < 6
            known = {*read(older), *read(newer), f"{making.MARK}.part"}
            assert set(read(folder)) <= known
            assert all(text in "12" for text in read(folder).values())
    making._put(newer, folder)
    assert read(folder) == read(newer)


def test_files_outside_the_site_are_not_removed(tmp_path):
    newer = laid(tmp_path / "newer", index_html="1")
    laid(tmp_path, precious_txt="mine")
    folder = laid(tmp_path / "site", index_html="0")
    names = ("index.html", "../precious.txt", str(tmp_path / "precious.txt"))
    (folder / making.MARK).write_text("\n".join(names))
    making._put(newer, folder)
    assert (tmp_path / "precious.txt").read_text() == "mine"


def test_missing_requirements_are_reported(tmp_path, monkeypatch):
    with monkeypatch.context() as patch:
        patch.setattr(making, "find_spec", lambda name: None)
        with pytest.raises(ValueError, match=r"sphinx.*pip install '\.\[site\]'"):
            making.build(tmp_path / "site")
    with monkeypatch.context() as patch:
        patch.setattr(making.robokin, "__file__", str(tmp_path / "robokin" / "__init__.py"))
        with pytest.raises(ValueError, match="no labs"):
            making.build(tmp_path / "site")
    assert not (tmp_path / "site").exists()
    lab = tmp_path / "01_lab.ipynb"
    for text, reason in (
        ("no notebook", "not a notebook"),
        ("{}", "not a notebook"),
        (json.dumps({"cells": [{"source": ["# A title without a claim"]}]}), "a claim"),
    ):
        lab.write_text(text)
        with pytest.raises(ValueError, match=f"01_lab.*{reason}"):
            making._entry(lab)


def test_unreadable_formulas_and_broken_links_are_reported(tmp_path):
    notebook = json.loads((NOTEBOOKS / "documents" / "glossary.ipynb").read_text(encoding="utf-8"))
    source, heading = tmp_path / "source", "3. How does one go back?"
    source.mkdir()
    for name in ("conf.py", "static", "templates"):
        from_there = making.HERE / name
        copy = shutil.copytree if from_there.is_dir() else shutil.copyfile
        copy(from_there, source / name)
    back = making.anchor(heading)
    texts = {
        "index": f"# Title\n\n[there](#{back}), $\\nonsense$ here\n\n## {heading}",
        "other": f"# Other\n\n[a](index.ipynb#{back}), [b](index.ipynb#nowhere)",
    }
    for name, text in texts.items():
        cells = [notebook["cells"][0] | {"source": [text]}]
        (source / f"{name}.ipynb").write_text(json.dumps(notebook | {"cells": cells}))
    said = making._run(source, tmp_path / "made")
    assert re.search(r"index\.ipynb.*nonsense", said) and re.search(r"other.*nowhere", said)
    assert back not in said and str(tmp_path) not in said
    page = Parsed((tmp_path / "made" / "index.html").read_text(encoding="utf-8"))
    assert back in page.ids, "wanted the same anchor as in JupyterLab"
    assert "here" in page.text and "nonsense" not in page.text
    assert "index.ipynb" in page.links and "" not in page.links
    assert "needs robokin" not in page.text, "the site was built without an address"
