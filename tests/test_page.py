"""The page: its colours are defined once, its script is joined from modules, and its packed numbers
can be decoded.
"""

import base64
import json
import re
import subprocess
import zlib

import numpy as np
import pytest
from conftest import NODE, ROOT
from test_player import unpacked

from robokin.show import JOINT_STYLES, joiner, markup, palette
from robokin.show.numbers import packed

FOLDER = ROOT / "robokin" / "show" / "js"
SCRIPTS = sorted(FOLDER.glob("*.js"))
SHEETS = sorted(FOLDER.glob("*.css"))
COLOUR = r"#[0-9A-Fa-f]{3,8}\b|rgba?\(|hsla?\("


# --- Colours --------------------------------------------------------------------------------------


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.name)
def test_scripts_contain_no_colours(path):
    text = path.read_text(encoding="utf-8")
    assert not re.findall(COLOUR, text) and not re.findall(r'"(?:white|black)"', text)


@pytest.mark.parametrize("path", SHEETS, ids=lambda path: path.name)
def test_style_sheets_contain_no_colours(path):
    text = path.read_text(encoding="utf-8")
    assert not re.findall(COLOUR, text) and not re.findall(r"\b(?:white|black)\b(?!-)", text)
    assert "font-family" not in text and path.with_suffix(".js").is_file(), (
        "no script with this name"
    )


def test_figures_take_their_colours_from_the_palette():
    for path in (ROOT / "robokin" / "show").glob("*.py"):
        if path.name != "palette.py":
            assert not re.findall(r'"#[0-9A-F]{6}"', path.read_text(encoding="utf-8")), path.name


def test_scripts_use_exactly_the_colours_of_the_palette():
    text = (ROOT / "robokin/show/js/canvas.js").read_text(encoding="utf-8")
    listed = re.search(r"export const colors = \{(.*?)\};", text, re.S)[1]
    assert re.findall(r"(\w+): \"\"", listed) == [*palette.PAGE]
    used = "".join(path.read_text(encoding="utf-8") for path in [*SCRIPTS, *SHEETS])
    assert set(re.findall(r"--rk-(\w+)", used)) <= {*palette.PAGE, *palette.STILL, "font"}
    assert set(re.findall(r"\bcolors\.(\w+)", used)) <= set(palette.PAGE)


def test_text_has_enough_contrast_in_both_themes():
    """The contrast with the background is at least 4.5 for text and 3 for lines (WCAG AA; W3C,
    2008).
    """

    def light(color):
        parts = np.array([int(color[i : i + 2], 16) for i in (1, 3, 5)]) / 255
        linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
        return linear @ [0.2126, 0.7152, 0.0722]

    for k in (0, 1):
        lights = {name: light(pair[k]) for name, pair in palette.PAGE.items()}
        for name, least in (("ink", 7), ("soft", 4.5), ("alarm", 4.5), ("near", 4.5), ("path", 7)):
            low, high = sorted([lights[name], lights["paper"]])
            assert (high + 0.05) / (low + 0.05) >= least, (name, k)
    assert [palette.PAGE[f"joint{i + 1}"][0] for i in range(6)] == [
        s["color"] for s in JOINT_STYLES
    ]


# --- The data ------------------------------------------------------------------------------------


def test_data_contain_no_decimals_of_whole_numbers():
    """They would make a page longer. Strings are unchanged, and so are data that are read and
    written again: JSON has -0, but Python reads it as 0.
    """
    data = {"a, 1.0]": [1.0, -20.0, 1.05, 0.0, 1e16, '2.0,"-0.0,', "\\"], "b": -0.0, "c": -10.0}
    text = markup.inert(data)
    assert json.loads(text) == data
    assert text == r'{"a, 1.0]":[1,-20,1.05,0,1e+16,"2.0,\"-0.0,","\\"],"b":0,"c":-10}'
    assert markup.inert(json.loads(text)) == text


# --- The joiner -----------------------------------------------------------------------------------


@pytest.fixture
def modules(tmp_path, monkeypatch):
    """Write modules into a separate folder for the joiner."""
    (tmp_path / "js").mkdir()
    monkeypatch.setattr(joiner, "files", lambda _: tmp_path)

    def write(sheets=(), **texts):
        for name, text in texts.items():
            (tmp_path / "js" / f"{name}.js").write_text(text)
        for name, text in dict(sheets).items():
            (tmp_path / "js" / f"{name}.css").write_text(text)
        forget()

    def forget():
        joiner.script.cache_clear()
        joiner.style.cache_clear()
        joiner.compressed.cache_clear()

    yield write
    forget()


def run(script, ending):
    """Run the script in Node and return the value of the expression `ending` at its end."""
    code = f"{script}\nconsole.log(JSON.stringify({ending}));"
    done = subprocess.run([NODE, "-e", code], text=True, capture_output=True, check=True)
    return done.stdout.strip()


def test_commas_after_the_last_item_are_left_out(modules):
    modules(top="export const all = [\n  1,\n  {\n    a: [2, 3],\n  },\n];\n")
    assert "all=[1,{a:[2,3]}];" in joiner.script("top")


def test_each_module_is_included_once_in_its_own_scope(modules):
    modules(
        base="// words\nconst hidden = 2;\nexport const twice = x => hidden * x;\n",
        left='import {twice} from "./base.js";\n\nconst hidden = 1;\n'
        "export function left() { return twice(hidden); }\n",
        top='/**\n * words\n */\nimport {left} from "./left.js";\nimport {\n  twice,\n} from '
        '"./base.js";\nexport class Top {}\nexport async function late() {}\n'
        "export const CSS = `\n  & p { margin: 0; }\n`, hidden = 3;\n"
        "export const all = () => [left(), twice(hidden)];\n",
        other="export const never = 1;\n",
    )
    script = joiner.script("top")
    assert script.count("const $base") == 1 and "words" not in script and "never" not in script
    assert run(script, "[$top.all(), Object.keys($top), $top.CSS]") == (
        '[[2,6],["Top","late","CSS","all"],"\\n  & p { margin: 0; }\\n"]'
    )


@pytest.mark.parametrize(
    "code, value",
    [
        ('/** @type {number} */ (found)[0] = "cast";', '["cast","b"]'),
        ("found[0] = 2\n  * 3;", '[6,"b"]'),
        ("found[0] = 8 // half\n  / 2 /* of it */ / 1;", '[4,"b"]'),
        ('found[0] = "// \\" /*"; found[1] = \'" // */\';', '["// \\" /*","\\" // */"]'),
        (r"found = '//\'/*'.match(/['\"`/]\/*/g); // words", """["//","'/"]"""),
        (r"found = /[/*]\//.test('*/') ? 6 / 3 : 0 / 1;", "2"),
        ("found[0] = `// ${`/* ${{a: '}`'}.a} */`} \\`\n  // ${1 /* one */ + 1}`;", None),
        ("found = [1 - -1, 1 + +1, 2 - - 1]; let i = 1; found[3] = i++ + ++i;", "[2,2,3,4]"),
        ("found = (() => { return typeof /x/; })();", '"object"'),
        ("function one() { return 1; }\nfound = one() / 2; /* a\nb */ found /= 1;", "0.5"),
        ("found = [1,\n[, ,\n],\n((a, b,\n) => a)({c: [2, ,\n],\n}.c,\n),\n];", None),
        ("found = /* a */function(){return 1}/* b */() in/* c */[0, 1];", "true"),
    ],
)
def test_comments_are_removed_and_code_is_kept(modules, code, value):
    text = f'let found = ["a", "b"];\n{code}\n'
    plain = run(text, "found")
    assert plain == value or value is None and ("// " in plain or plain.count("null") == 3)
    modules(top=f"{text}export const all = () => found;\n")
    assert run(joiner.script("top"), "$top.all()") == plain


def test_a_compressed_script_adds_its_style_sheets_and_returns_its_module(modules):
    modules({"base": "b { margin: 0 }"}, base="export const one = 1;\n")
    key, text = joiner.compressed("base")
    code = zlib.decompress(base64.b64decode(text)).decode()
    document = "const sheets = [], document = {createElement: () => ({}), "
    document += "head: {append: sheet => sheets.push(sheet.textContent)}};"
    head = f"{document}\nconst found = (() => {{{code}}})();"
    assert json.loads(run(head, "[found.one, sheets]")) == [1, [palette.css() + "b{margin:0}"]]
    modules({"base": "b { margin: 1px }"}, base="export const one = 1;\n")
    assert joiner.compressed("base")[0] != key, "wanted a different key for a different text"


def test_views_of_one_kind_share_a_script(browser):
    pages = [markup.output("prediction.ask", k * 12, "0", "<p>words</p>") for k in "ab"]
    called = "globalThis.called = [];"
    pages = [
        re.sub(r"\$prediction\.ask\((.*)\);", r"called.push([\1, $prediction]);", one)
        for one in pages
    ]
    tab = browser.new_page()
    tab.set_content(f"<script>{called}</script>{pages[0]}{pages[1]}")
    tab.wait_for_function("called.length == 2")
    assert sorted(tab.evaluate("called.map(([id]) => id[0])")) == ["a", "b"]  # in any order
    assert tab.evaluate("called.map(([, , module]) => typeof module.ask)") == ["function"] * 2
    assert tab.evaluate("called[0][2] === called[1][2]")
    tab.close()


def test_views_start_one_at_a_time_with_a_frame_in_between(browser):
    """This also holds after a view that failed to start."""
    pages = [markup.output("prediction.ask", k * 12, "0", "<p>words</p>") for k in "abc"]
    starts = "{starts.push(frames); if (starts.length == 2) throw new Error('on purpose')}"
    pages = [re.sub(r"\$prediction\.ask\(.*\);", starts, one) for one in pages]
    count = "globalThis.starts = []; globalThis.frames = 0;"
    count += "(function next() { frames++; requestAnimationFrame(next); })();"
    tab = browser.new_page()
    tab.set_content(f"<script>{count}</script>{''.join(pages)}")
    tab.wait_for_function("starts.length == 3")
    first, second, third = tab.evaluate("starts")
    assert first < second < third
    tab.close()


@pytest.mark.parametrize(
    ("call", "still"),
    [
        ("player.play", markup.still_image(b"", "an arm")),
        ("prediction.ask", "<p>Which joint is the fastest?</p><p>a) joint 1</p><p>Run this.</p>"),
    ],
)
def test_old_browser_shows_the_still_picture_and_a_reason(browser, call, still):
    tab = browser.new_page()
    tab.set_content(
        "<script>delete globalThis.DecompressionStream</script>"
        + markup.output(call, "a" * 12, "{}", still)
    )
    tab.get_by_text("This view needs a browser from 2023 or later.").wait_for()
    place = tab.locator(".robokin-player")
    assert place.locator("p").all_inner_texts()[:-1] == re.findall("<p>(.*?)</p>", still)[:-1]
    assert place.locator("img").count() == still.count("<img")
    tab.close()


def test_unterminated_literal_is_refused_with_file_and_line(modules):
    for text in ("const a = 'b;", "const a = `b${c;", "const a = `b;", "/* b", "let a = /b;"):
        modules(top=f"// words\n{text}\n")
        with pytest.raises(ValueError, match=r"top\.js, line 2: .* is not closed"):
            joiner.script("top")


@pytest.mark.parametrize(
    "text, message",
    [
        ('import base from "./base.js";', r"top\.js, line 2: wanted an import of names"),
        ('import {a as b} from "./base.js";', r"top\.js, line 2"),
        ('import * as base from "./base.js";', r"top\.js, line 2"),
        ('import {a} from "https://x.y/base.js";', r"top\.js, line 2"),
        ("import {a,\n  b}", r"top\.js, line 3: an import has no semicolon"),
        ("export default 3;", r"top\.js, line 2: wanted an export of one name"),
        ("export {a};", r"top\.js, line 2"),
        ('import {a} from "./none.js";', r"top\.js, line 2: there is no module none\.js"),
        ('import {a} from "./top.js";', r"top\.js, line 2: .* imports itself"),
    ],
)
def test_unsupported_import_is_refused_with_file_and_line(modules, text, message):
    modules(base="export const a = 1;\n", top=f"// words\n{text}\n")
    with pytest.raises(ValueError, match=message):
        joiner.script("top")


def test_style_sheet_follows_those_of_imported_modules(modules):
    rules = ".a {\n  color: red;\n\n  & > .b:hover, & :is(p, q) { margin: 0 -1px; }\n}\n"
    media = "@media (width > 1px) {\n  .c { width: calc(1px + 2px); }\n}"
    modules(
        {"top": f"/* a; */\n{rules}", "base": media, "other": ".no {}"},
        base="export const one = 1;\n",
        top='import {one} from "./base.js";\nexport const two = one;\n',
        other="export const never = 1;\n",
    )
    assert joiner.style("top") == (
        "@media (width>1px){.c{width:calc(1px + 2px)}}"
        ".a{color:red;&>.b:hover,& :is(p,q){margin:0 -1px}}"
    )
    assert joiner.style("other") == ".no{}" and joiner.style("base").startswith("@media")


def test_joined_style_sheets_match_the_files_in_a_browser(browser):
    """The test compares all rules of all style sheets, as Chromium serialises them.

    Newer versions of Chromium keep the spaces of a value that contains `var()`.
    """
    tab = browser.new_page()
    tab.set_content("<style id=sheet></style>")
    rules = """text => {
        const sheet = document.getElementById("sheet");
        sheet.textContent = text;
        const plain = text => text.replace(/\\s+/g, " ").replace(/ ?([(),]) ?/g, "$1");
        return [...sheet.sheet.cssRules].map(rule => plain(rule.cssText));
    }"""
    views = "motor_explorer", "elbow_explorer", "tour_explorer", "plan_explorer", "prediction"
    for name in views:
        text = joiner.style(name)
        order = [path.stem for path in SHEETS if f"const ${path.stem} " in joiner.script(name)]
        order.sort(key=lambda stem: joiner.script(name).index(f"const ${stem} "))
        files = "\n".join((FOLDER / f"{stem}.css").read_text(encoding="utf-8") for stem in order)
        assert tab.evaluate(rules, text) == tab.evaluate(rules, files) != []
        assert max(map(len, text.splitlines())) < 400 and "/*" not in text
    tab.close()


def test_scripts_contain_no_style_sheets():
    for path in [*SCRIPTS, *(ROOT / "robokin" / "show").glob("*.py")]:
        text = path.read_text(encoding="utf-8")
        assert not re.search(r"\{[^{}]*\b(?:padding|margin|display|border): ?[\w-]+;", text), path


def test_player_contains_only_used_modules_and_no_comments():
    script = joiner.script("player")
    assert not re.search(r"const \$(stage|handles|inverse|\w+_explorer) ", script)
    assert script.count("(() => {\n") >= 6 and "\n\n" not in script
    for path in SCRIPTS:
        for words in re.findall(r"^ *(?://|/?\*\*?) (\w.{15,}[^*/])", path.read_text(), re.M):
            assert words not in script
    assert sorted(map(len, script.splitlines()))[-10] < 400, "the lines are too long to read"


# --- Packed numbers -------------------------------------------------------------------------------


def test_packed_numbers_are_accurate_to_half_a_step():
    random = np.random.default_rng(3)
    values = np.cumsum(random.normal(size=(4, 50, 3)), axis=1) * [[[1]], [[1e-3]], [[40]], [[0]]]
    values[2, 10:20, 1] = np.nan
    shifts = np.array([False, True, False])
    out = packed(values, 16000, (shifts, ~shifts))
    back = unpacked(out, 3, 50)
    assert (np.isnan(back) == np.isnan(values)).all()
    for k in range(4):
        for group in (shifts, ~shifts):
            greatest = np.nanmax(abs(values[k][:, group]))
            error = np.nanmax(abs(back[k] - values[k])[:, group])
            assert error <= max(greatest / 16000 * 2.5, 1e-6) * 0.51


def test_smooth_curves_take_about_one_byte_per_value():
    t = np.linspace(0, 1, 121)[:, None]
    values = np.array([np.sin(2 * np.pi * t + k) * (k + 1) for k in range(5)])
    assert len(packed(values, 16000)["data"]) < 1.2 * values.size * 4 / 3
