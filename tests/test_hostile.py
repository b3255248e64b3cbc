"""Malicious notebooks: a student may hand in anything, and a teacher opens it. No foreign script
may run, nothing may be fetched, and the header of a report must not change.

The attack values are inserted wherever a notebook can contain them. The first test shows that they
are effective: in a carelessly written page they run scripts and fetch addresses.
"""

import base64
import http.server
import json
import re
import threading
import time
import unicodedata
from functools import cache
from types import SimpleNamespace

import nbformat
import pytest
from conftest import NOTEBOOKS, awake
from nbformat.v4 import (
    new_code_cell,
    new_markdown_cell,
    new_notebook,
    new_output,
    new_raw_cell,
)

from robokin import IRB140
from robokin.course import book, predict
from robokin.course import export as course_export
from robokin.course.exercises import Verdict
from robokin.course.export import View, page
from robokin.course.harmless import clean, harmless_link, is_deep
from robokin.course.ours import CALL, KINDS, LEFT_OUT, again, fits, quiet
from robokin.course.predictions import shown
from robokin.course.report_page import page_of
from robokin.course.texts import ALL_BUT_HALVES, all_visible, visible
from robokin.show import target_explorer
from robokin.show.markup import inert, output
from robokin.show.page import Page

ATTACK = "window.hacked=1;document.title='hacked';new Image().src='URL/script'"
FETCHES = (  # elements that fetch something without a script
    '<img src="URL/img.png">',
    '<img srcset="URL/set.png 1x">',
    "![](URL/markdown.png)",
    '<picture><source srcset="URL/source.png"><img src="x"></picture>',
    '<video poster="URL/poster.png" src="URL/video"></video>',
    '<audio autoplay src="URL/audio"></audio>',
    '<iframe src="URL/frame"></iframe>',
    '<object data="URL/object"></object>',
    '<embed src="URL/embed">',
    '<link rel="stylesheet" href="URL/style.css">',
    '<link rel="prefetch" href="URL/prefetch">',
    '<style>@import "URL/import.css"; .rk-report { background: url(URL/background) }</style>',
    '<div style="background:url(URL/inline)">x</div>',
    '<input type="image" src="URL/input.png">',
    '<table background="URL/table.png"><tr><td>x</td></tr></table>',
    '<svg><image href="URL/svg.png"/><use href="URL/use.svg#a"/></svg>',
    '<svg><foreignObject><iframe src="URL/foreign"></iframe></foreignObject></svg>',
    '<math><mtext href="URL/math"><img src="URL/mathimg"></mtext></math>',
    '<body background="URL/body.png">',
)
RUNS = (  # elements and attributes that run a script
    "<script>JS</script>",
    "<SCRIPT >JS</SCRIPT >",
    "</script><script>JS</script>",
    "</title><script>JS</script>",
    "</style></textarea></pre></code><script>JS</script>",
    "--><script>JS</script><!--",
    "<!--><script>JS</script>-->",
    '<script src="URL/src.js"></script>',
    '<script type="module">JS</script>',
    '<img src="x" onerror="JS">',
    "<img src=x onerror=JS>",
    '<img/src="x"/onerror="JS">',
    '"><img src=x onerror="JS">',
    "' onerror='JS' x='",
    '<svg onload="JS"></svg>',
    "<svg><script>JS</script></svg>",
    '<svg><animate onbegin="JS" attributeName="x" dur="1s"/></svg>',
    '<svg><set attributeName="onload" to="JS"/></svg>',
    '<iframe srcdoc="&lt;script&gt;parent.hacked=1&lt;/script&gt;"></iframe>',
    '<iframe src="javascript:parent.hacked=1"></iframe>',
    '<object data="data:text/html,<script>parent.hacked=1</script>"></object>',
    '<embed src="javascript:JS">',
    '<input autofocus onfocus="JS">',
    '<details open ontoggle="JS"><summary>x</summary></details>',
    '<video><source onerror="JS"></video>',
    '<style onload="JS"></style>',
    '<math><mtext><table><mglyph><style><img src="</style><img src=x onerror=JS>"></table></math>',
    "<noscript><p title=\"</noscript><img src=x onerror='JS'>\">",
    "<form><math><mtext></form><form><mglyph><style></math><img src onerror='JS'>",
    "<svg></p><style><g title=\"</style><img src onerror='JS'>\">",
    "<template><script>JS</script></template>",
    "<xmp><p title=\"</xmp><img src=x onerror='JS'>\">",
    r"$\text{<script>JS</script>}$",
    r"$$\text{</mtext></math><img src=x onerror=JS>}$$",
    '![a $x$ "onerror="JS](x)',
    '![" onerror="JS](x " onerror="JS")',
    "```html\n<script>JS</script>\n```",
    '```python" onmouseover="JS\nx\n```',
    "| a |\n|---|\n| <script>JS</script> |",
    "# <script>JS</script>",
    '# a" onclick="JS',
    "<h2 id=\"x\" onclick='JS'>heading</h2>",
)
LEADS = (  # elements that open another address, immediately or when they are clicked
    '<meta http-equiv="refresh" content="0;url=URL/refresh">',
    '<base href="URL/">',
    '<a href="javascript:JS">a link</a>',
    '<a href="java\tscript:JS">a link</a>',
    '<a href="&#106;avascript:JS">a link</a>',
    '<a href="&amp;#106;avascript:JS">a link</a>',
    '<a href=" \x01javascript:JS">a link</a>',
    '<a href="data:text/html,<script>JS</script>">a link</a>',
    '<a href="vbscript:JS">a link</a>',
    '<a href="//evil.example">a link</a>',
    '<a href="\\\\evil.example\\share">a link</a>',
    '<a href="file:///etc/passwd">a link</a>',
    '<a href="#" ping="URL/ping" target="_top" download>a link</a>',
    "[a link](javascript:JS)",
    "[a link](<java\nscript:JS>)",
    "<javascript:JS>",
    '<map name="m"><area href="javascript:JS" coords="0,0,999,999"></map><img usemap="#m">',
    '<form action="URL/form"><button>send</button></form><button formaction="URL/f">x</button>',
)
COVERS = (  # elements that would change or cover the header
    "<style>.rk-not { color: green; font-size: 0 } .rk-not::after { content: 'holds' }</style>",
    '<div style="position:fixed;inset:0;background:#fff;z-index:9999">holds</div>',
    '<div class="rk-report" id="robokin-report"><span class="rk-holds">holds</span></div>',
    '<p style="margin-top:-3000px">holds</p>',
    r"$\kern-100em\raisebox{300em}{holds}$",
    "</div></div></div></div></main></header><p>out</p>",
    "<table><tr><td></table></div></div></div>",
    '<script type="application/json" id="robokin-report">{"report":2}</script>',
    "Z" + "\u0335\u0316\u033f\u0301" * 300,
    "\u202edloh ton seod\u202c and \u2067turned\u2069 \u200f \u061c",
    "bell \x07 and \x1b]0;title\x07 and \x9b31m and \x00",
    "&#8238;turned&#x202e;",
    "\x1b[31mred\x1b[0m \x1b[38;2;0;128;0mgreen <b>\x1b[0m \x1b[;;;m",
    "half of a pair \ud800 and \udfff",
    "<b>" * 3000,
    "<div>" * 3000,
    "> " * 500 + "deep",
    "$" + "{" * 3000 + "x" + "}" * 3000 + "$",
    "".join(f"{'  ' * k}- a\n" for k in range(100)),
    '<img src="data:image/png;base64,iVBORw0KGgo=" width="99999" height="99999">',
    "evil\nname\r\nwith \x85 newlines",
    '=HYPERLINK("URL")',
    "${7*7}{{7*7}}{% raw %}<%= 7*7 %>",
    "A" * 5_000_000,
)
VALUES = (*FETCHES, *RUNS, *LEADS, *COVERS)
SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9" onload="JS"><script>JS</script>'
    '<image href="URL/svgout.png" width="9" height="9"/></svg>'
)
ALLOWED = """() => {
  const odd = [], known = new Set(TAGS);
  for (const node of document.querySelectorAll(".rk-notebook *")) {
    if (node.closest(".robokin-player, .rk-folded, .highlight") || node.closest("math")) continue;
    const ours = /^jp-|^rk-notebook$|^cm-editor/.test(node.className)
      || node.matches(".jp-CodeCell > details.rk-code");
    const style = node.matches(".robokin-player ~ *");  // our own style and script
    if (style) continue;
    if (!known.has(node.localName)) odd.push(node.localName);
    for (const {name, value} of node.attributes) {
      const fine = ours ? ["class", "open", "tabindex", "data-mime-type", "data-type"]
        : ATTRIBUTES;
      const colour = name === "style" && /^(background-)?color: rgb\\([\\d, ]+\\)$/.test(value);
      const ansi = name === "class" && /^(ansi-[a-z-]+ ?)+$/.test(value);
      const scrolls = name === "tabindex" && value === "0";  // set by our script
      if (!fine.includes(name) && !colour && !ansi && !scrolls)
        odd.push(`${node.localName} ${name}=${value}`);
      if (name === "src" && !value.startsWith("data:image/")) odd.push(value.slice(0, 80));
      if (name === "href" && !/^(https?:|mailto:|#|(?![a-z]+:)[^\\/\\\\])/.test(value))
        odd.push(value.slice(0, 80));
    }
  }
  return odd; }"""
TAGS = """a abbr b blockquote br caption code col colgroup dd del details div dl dt em figcaption
figure h1 h2 h3 h4 h5 h6 hr i img ins kbd li mark math ol p pre q s samp small span strong sub
summary sup table tbody td tfoot th thead tr u ul var""".split()
ATTRIBUTES = "alt colspan height href id open rel rowspan src start title width".split()
ALLOWED = ALLOWED.replace("TAGS", json.dumps(TAGS)).replace("ATTRIBUTES", json.dumps(ATTRIBUTES))
SCRIPTS = """() => [...document.scripts]
  .filter(script => script.type !== "application/json" && !script.nonce).length"""
VERDICTS = """() => [...document.querySelectorAll(".rk-report [class]")].map(e =>
  [e.className, e.textContent.trim().slice(0, 40), getComputedStyle(e).color, e.tagName])
  .filter(([, , , tag]) => tag === "SPAN")"""


@pytest.fixture(scope="module")
def listening():
    """A server that should receive no requests: its address, and the requests that it received."""
    asked = []

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            asked.append(self.path)
            self.send_response(204)
            self.end_headers()

        do_POST = do_HEAD = do_OPTIONS = do_GET

        def log_message(self, *_):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield SimpleNamespace(url=f"http://127.0.0.1:{server.server_port}", asked=asked)
    server.shutdown()
    server.server_close()


def values(url):
    script = ATTACK.replace("URL", url)
    return [value.replace("JS", script).replace("URL", url) for value in VALUES]


def attacking(url):
    """A notebook that contains every attack value in every possible place."""
    cells = []
    for value in values(url):
        outputs = [
            new_output("stream", text=value),
            new_output("error", ename=value, evalue=value, traceback=[value]),
            new_output("display_data", data={"text/html": value}),
            new_output("display_data", data={"text/markdown": value}),
        ]
        large = len(value) > 100_000
        cells += [
            new_markdown_cell(value),
            new_code_cell(value, outputs=outputs[: 1 if large else 4], execution_count=1),
        ]
    evil = f"<script>{ATTACK}</script>".replace("URL", url)
    svg = SVG.replace("JS", ATTACK).replace("URL", url)
    kinds = {
        "text/plain": evil,
        "text/latex": f"${evil}$",
        "image/svg+xml": svg,
        "image/png": '"><script>window.hacked=1</script>',
        "image/jpeg": f'x" onerror="{ATTACK}',
        "application/javascript": ATTACK.replace("URL", url),
        "application/json": {"a": evil},
        "application/pdf": evil,
        "application/vnd.jupyter.widget-view+json": {"model_id": evil},
        "application/vnd.plotly.v1+json": {"data": evil},
        "text/vnd.mermaid": evil,
        f"text/x-{evil}": evil,
    }
    metadata = {"image/png": {"width": evil}, "filenames": {"image/png": f"{url}/file.png"}}
    outputs = [
        new_output("execute_result", data={kind: data}, metadata=metadata, execution_count=1)
        for kind, data in kinds.items()
    ]
    outputs += [new_output("display_data", data={"text/html": one}) for one in forged(url)]
    tagged = new_code_cell("1", outputs=outputs, id="rk-report")
    tagged.metadata = {"tags": [f'x"><script>{ATTACK}</script>'], "rk-report": evil}
    attached = new_markdown_cell("![x](attachment:a.png) ![x](attachment:b) ![x](../secret.png)")
    attached.attachments = {
        "a.png": {"text/html": base64.b64encode(evil.encode()).decode()},
        "b": {"image/png": f'"><img src=x onerror="{ATTACK}">'},
    }
    raw = new_raw_cell(evil, metadata={"raw_mimetype": "text/html"})
    notebook = new_notebook(cells=[*cells, tagged, attached, raw])
    notebook.metadata = {"title": f"</title>{evil}", "widgets": {"x": evil}}
    notebook.metadata["language_info"] = {"name": '"><script>', "pygments_lexer": "html"}
    return nbformat.from_dict(notebook)


def forged(url):
    """Outputs that look like ours."""
    explorer = target_explorer(IRB140).html
    asking = predict("scara_motion.p1").html
    script = ATTACK.replace("URL", url)
    evil = f"<img src=x onerror={script}>"
    data = json.dumps(evil)[1:-1]
    return [
        explorer.replace("<script>", f"<script>{script};"),
        explorer.replace('"title":"', f'"title":"{data}'),
        re.sub('"words":{"', f'"words":{{"x{data}":"y","', explorer),
        explorer.replace('<img alt="', f'<img onerror="{script}" src="x" alt="'),
        explorer.replace("base64,iVBOR", "base64,AAAA"),
        explorer.replace('"kind":"target"', '"kind":"joint"'),
        explorer.replace('"kind":"target"', '"kind":"target","__proto__":{"x":1}'),
        explorer.replace("</script>", f";{script}</script>"),
        explorer.replace('("', f'({script},"'),
        explorer.replace("$target_explorer.explore", f"({script});$target_explorer.explore"),
        asking.replace('"question":"', f'"question":"{data}'),
        asking.replace('"view":"', f'"view":"{data}'),
        asking.replace('"name":"scara_motion.p1"', f'"name":"{data}"'),
        asking.replace('"choice":null', '"choice":"zz"'),
        asking.replace('"choice":null', '"choice":{"a":[1]}'),
        f'<div class="robokin-player" data-player="x"></div>\n<script>\n{script}\n</script>',
        f'<div class="robokin-player">{evil}</div>',
    ]


def data_of(words=("a sentence",)):
    """The data of a report with these strings in every field that can contain them."""
    lab = book.lab("scara_motion")
    word = words[0]
    states = ["holds", "does not hold", "failed", "not judged", "unanswered"]
    return {
        "report": 2,
        "who": word,
        "lab": "scara_motion",
        "title": word,
        "file": word,
        "made": "2026-01-02T03:04:05+00:00",
        "robokin": "0",
        "numbers": word,
        "exercises": [
            {
                "id": f"scara_motion.{n}",
                "task": word,
                "objective": exercise.objective,
                "state": states[k % 5],
                "mistake": word,
                "says": list(words),
                "case": "\n".join(words),
                "points": 0.5,
            }
            for k, (n, exercise) in enumerate(lab.exercises.items())
        ],
        "predictions": [
            {
                "id": f"scara_motion.{n}",
                "choice": word if k % 3 else None,
                "right": [None, True, False][k % 3],
                "confusion": word,
                "when": "2026-01-02T03:04:05+00:00",
                "later": list(words),
            }
            for k, n in enumerate(lab.predictions)
        ],
        "remarks": list(words),
        "guesses_came": True,
    }


class Opened:
    """Opens pages in one browser, one after another, and reads them."""

    def __init__(self, browser, folder):
        self.folder = folder
        self.context = browser.new_context(viewport={"width": 1000, "height": 800})

    def look(self, name, text, picture=True):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        page = self.context.new_page()
        page.goto(path.as_uri(), wait_until="load")
        page.wait_for_timeout(100)
        hacked, title, url = page.evaluate("[window.hacked, document.title, location.href]")
        seen = SimpleNamespace(hacked=hacked, title=title, moved=url != path.as_uri())
        head = page.locator(".rk-report")
        if head.count():
            seen.verdicts = page.evaluate(VERDICTS)
            seen.head = picture and head.screenshot(), head.inner_text()
        if page.locator(".rk-notebook").count():
            seen.odd = page.evaluate(ALLOWED)
            seen.scripts = page.evaluate(SCRIPTS)
        page.close()
        return seen


@pytest.fixture(scope="module")
def seen(browser, listening, tmp_path_factory):
    """The contents of the opened pages, benign and malicious, and the requests that they made."""
    folder = tmp_path_factory.mktemp("hostile")
    opened = Opened(browser, folder)
    quiet = new_notebook(cells=[new_markdown_cell("Words"), new_code_cell("1 + 1")])
    notebook = attacking(listening.url)
    short = [value for value in values(listening.url) if len(value) < 100_000]
    data = data_of()
    result = SimpleNamespace()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(course_export, "ROOM", 10**9)  # so that every value is parsed
        result.notebook = opened.look("notebook.html", page_of(data, notebook, folder))
        view = View(folder, lenient=True)
        exported = page(view.cells(notebook), short[20], view.nonce)
        result.export = opened.look("export.html", exported)
    assert len(data["remarks"]) > 1, "unreadable formulas are not reported"
    same = data_of() | {"remarks": data["remarks"]}
    result.harmless = opened.look("harmless.html", page_of(same, quiet, folder))
    many = page_of(data_of(short), quiet, folder)
    # a picture of this page would have 50 million pixels
    result.data = opened.look("data.html", many, picture=False)
    result.asked = list(listening.asked)
    careless = "".join(v for v in (*FETCHES, *RUNS) if "frame" not in v)
    raw = careless.replace("JS", ATTACK).replace("URL", listening.url)
    result.careless = opened.look("careless.html", f"<!DOCTYPE html><title>x</title>{raw}")
    result.asked_by_careless = list(listening.asked)
    opened.context.close()
    return result


def test_attack_values_are_numerous_and_effective(seen):
    assert len(set(VALUES)) >= 60
    assert seen.careless.hacked == 1 and len(seen.asked_by_careless) > 5


@pytest.mark.parametrize("name", ["harmless", "notebook", "data", "export"])
def test_foreign_scripts_do_not_run_and_nothing_is_fetched(seen, name):
    page = getattr(seen, name)
    assert page.hacked is None and not page.moved
    assert page.title != "hacked"
    assert seen.asked == []


@pytest.mark.parametrize("name", ["harmless", "notebook", "data", "export"])
def test_notebook_html_contains_only_allowed_elements(seen, name):
    page = getattr(seen, name)
    assert page.odd == []
    assert page.scripts == 0, "there are scripts without the page's nonce"


def test_notebook_does_not_change_the_header(seen):
    assert seen.notebook.head == seen.harmless.head, "the picture or the text differs"
    assert seen.notebook.verdicts == seen.harmless.verdicts
    assert len(seen.harmless.verdicts) >= 10


def test_text_in_the_header_does_not_change_verdicts(seen):
    assert seen.data.verdicts == seen.harmless.verdicts
    for turned in ("\u202e", "\u2067", "\x07", "\x9b"):
        assert turned not in seen.data.head[1]


def test_forged_outputs_are_rewritten_or_left_out(listening):
    explorer = target_explorer(IRB140).html
    whole = again(explorer, "abc")
    assert whole.count("<script nonce=abc>") == 1 and "<script>" not in whole
    script = ATTACK.replace("URL", listening.url)
    for text in forged(listening.url):
        made = again(text, "abc")
        assert made is not None and f"{script};" not in made and 'onerror="' not in made
        assert made == LEFT_OUT or made.count("<script") == 1
    assert again("<p>words</p>", "abc") is None


def test_our_own_outputs_are_unchanged():
    for made in (
        target_explorer(IRB140),
        predict("irb140_motion.p1"),
        predict("irb140_motion.p1", "a"),
    ):
        same = again(made.html, "n").replace(" nonce=n", "")
        mine = quiet(made.html)  # without the text for readers in JupyterLab
        assert re.sub("[0-9a-f]{12}", "", same) == re.sub("[0-9a-f]{12}", "", mine)


def test_questions_of_older_notebooks_are_rewritten():
    """Older notebooks store the view as a string in the data of the question."""
    name = "irb140_motion.p1"
    made = predict(name, "a")
    assert ".show(" in made.html, "the call of the view is separate"
    data = inert(made.data | {"view": shown(made.view())})
    older = output("prediction.ask", made.id, data, "<p>words</p>")
    assert again(older, "n") == again(made.html, "n")
    assert again(older, "n", {}) == again(predict(name).html, "n")


def test_verdict_has_the_colour_of_its_state():
    says = ("one & two", "  a = <b>")
    made = [Verdict("irb140_motion.1", False, says=says), Verdict("irb140_motion.1", holds=True)]
    made.append(Verdict("irb140_motion.1", mistake="a\u202emistake", case="x\ny"))
    for verdict in made:
        assert again(verdict._repr_html_(), "n") == visible(verdict._repr_html_())
    holds, not_so = (made[k]._repr_html_() for k in (1, 2))
    colour = re.search("solid #(\\w+)", holds)[1]
    for style in (f"border-left:5px solid #{colour}", "position:fixed;inset:0"):
        evil = again(re.sub('style="border[^"]*"', f'style="{style}"', not_so), "n")
        assert colour not in evil and "position" not in evil and "does not hold" in evil
    evil = not_so.replace("</b>", "<img src=x onerror=1></b>")
    assert again(evil, "n") is None, "a changed verdict must be cleaned like any other HTML"


def test_report_opens_each_question_with_the_first_guess():
    stored = predict("irb140_motion.p1", "a").html
    assert '"choice":"b"' in again(stored, "n", {"irb140_motion.p1": "b"})
    assert '"choice":null' in again(stored, "n", {})
    assert '"choice":null' in again(stored, "n", {"irb140_motion.p1": "no letter"})
    number = next(
        name
        for lab in book.labs()
        for name in book.ids(lab, "predictions")
        if book.find(name, "predictions").unit
    )
    assert '"choice":"-12.5"' in again(predict(number).html, "n", {number: "-12.5"})
    assert '"choice":null' in again(predict(number).html, "n", {number: "nan"})


@pytest.mark.parametrize(
    "change",
    [
        lambda data: data.pop("title"),
        lambda data: data.update(more=1),
        lambda data: data.update(title=["a"]),
        lambda data: data.update(decimals=["1"]),
        lambda data: data["scene"].update(size=True),
        lambda data: data["scene"]["things"].append({}),
        lambda data: data["scene"]["things"][0].update(kind="target"),
        lambda data: data["scene"]["things"][0].pop("at"),
        lambda data: data.update(ticks=[0, 1]),
    ],
)
def test_invalid_page_data_are_refused(change):
    data = {
        "title": "a",
        "summary": "",
        "alt": "",
        "nothing": -32768,
        "times": [0, 1.5],
        "ticks": [0, 1.0, 2, 0],
        "slider": None,
        "switch": {"label": "a", "values": ["b"]},
        "unit": {"name": "mm", "size": 0.001},
        "dashes": [[]],
        "scene": {
            "size": 1,
            "flat": None,
            "grid": 0.1,
            "seen": [],
            "floor": [],
            "view": [1, 2],
            "grows": False,
            "solid": False,
            "bases": None,
            "things": [{"kind": "mark", "name": "a", "radius": 0, "at": [0, 0.5, 1]}],
        },
        "panels": [],
        "quantities": [],
        "watch": {"panel": 0, "joints": None},
        "decimals": [1],
        "sampled": "",
        "arms": [],
    }
    assert fits(data, Page)
    change(data)
    assert not fits(data, Page)


def test_pictures_come_only_from_the_notebooks_folder(tmp_path):
    png = base64.b64decode("iVBORw0KGgo=")
    folder = tmp_path / "labs"
    (folder / "images").mkdir(parents=True)
    for path in (folder / "images" / "a.png", tmp_path / "secret.png", folder / "notes.txt"):
        path.write_bytes(png)
    (folder / "link.png").symlink_to(tmp_path / "secret.png")
    cell = new_markdown_cell("![a](images/a.png) <img src='images/a.png'> ![b](attachment:b)")
    cell.attachments = {"b": {"image/png": "iVBORw0KGgo="}}
    names = ("../secret.png", str(tmp_path / "secret.png"), "notes.txt", "link.png", "no.png")
    others = [new_markdown_cell(f"![a]({name})") for name in names]
    long = "data:image/png;base64," + base64.b64encode(png * 20_000).decode()
    cells = View(folder).cells(
        new_notebook(cells=[cell, *others, new_markdown_cell(f"![]({long})")])
    )
    assert cells[0]["source"].count('src="data:image/png;base64,iVBORw0KGgo="') == 3
    assert not any("<img" in each["source"] for each in cells[1:-1])
    assert long in cells[-1]["source"]


def test_header_reports_what_was_left_out(tmp_path):
    none_came = data_of() | {"guesses_came": False}
    text = page_of(none_came, new_notebook(), tmp_path)
    assert "Guesses: none came with the notebook." in text and "in another folder" in text
    assert "can forge" in text
    assert "default-src 'none'" in text
    assert "none came" not in page_of(data_of(), new_notebook(), tmp_path)


def test_links_lead_to_their_visible_targets():
    for address, kept in (
        ("https://example.org/a?b=c&d#e", True),
        ("mailto:a@example.org", True),
        ("#section", True),
        ("images/arm.png", True),
        ("javascript:1", False),
        ("JaVa\nScRiPt:1", False),
        ("\x00javascript:1", False),
        ("data:text/html,x", False),
        ("//example.org", False),
        ("\\\\example.org", False),
        ("/etc/passwd", False),
        ("a:b", False),
    ):
        assert bool(harmless_link(address)) == kept, address
    assert harmless_link("02_irb140_kinematics.ipynb#a") == "02_irb140_kinematics.html#a"


def test_invisible_characters_are_escaped():
    assert visible("a\u202eb") == "a\\u202eb" and visible("\ud800") == "\\ud800"
    assert visible("a\tb\r\nc\rd") == "a\tb\nc\nd"
    for fine in ("Юрий", "कमला", "José", "家", "عربي", "a\N{ZERO WIDTH JOINER}b", "−290°"):
        assert visible(fine) == fine
    assert clean("&#8238;x&lt;y&amp;z") == "\\u202ex&lt;y&amp;z"
    assert visible("a\tb\r\nc", "") == r"a\tb\r\nc" and visible("a\x1b", "\x1b") == "a\x1b"
    assert visible("abc", most=2) == "ab ... shortened"


def test_every_character_is_visible_or_escaped():
    """The expected escapes come from Python's Unicode tables: control characters, line ends and
    changes of direction.
    """
    every = [chr(c) for c in range(0x110000)]
    turns = ("LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI")
    told = [
        c
        for c in every
        if unicodedata.category(c) in ("Cc", "Zl", "Zp", "Cs")
        or unicodedata.bidirectional(c) in turns
    ]
    shown = visible("".join(told), "")
    assert shown.isascii() and shown.isprintable() and shown.count("\\") == len(told) > 2048
    seen = "".join(c for c in every if c.isprintable())
    assert visible(seen, "") == visible(seen) == seen
    kept = visible("".join(every), ALL_BUT_HALVES)
    assert kept.encode() and kept.startswith("".join(every[:0xD800]) + r"\ud800\ud801")


def test_hidden_characters_in_json_become_visible():
    assert all_visible({"a\0": [1, None, ("\u202e",)]}) == {r"a\x00": [1, None, [r"\u202e"]]}
    deep = []
    for _ in range(200):
        deep = [deep]
    with pytest.raises(ValueError, match="nested deeper than 100"):
        all_visible(deep)


PIECES = ("<", " ", "&", "<b>", "</b>", "<div>", "<p>", "&lt;", " \n", "a.", "\\\\[", "$a$", "[a](")
PIECES += ("<b></i>", "\\begin{a}", "`", "*a_", "\x1b[31m", "\u202e", "- a\n", "|a|b|\n|-|-|\n")


@pytest.mark.parametrize("piece", PIECES)
@pytest.mark.parametrize("size", [20_000, 1_000_000])
def test_page_is_converted_quickly(piece, size, tmp_path):
    """The limit is 2 s of CPU time per megabyte, whatever the content."""
    text = (piece * (size // len(piece) + 1))[:size]
    outputs = [
        new_output("stream", text=text),
        new_output("display_data", data={"text/html": text}),
    ]
    cells = [new_markdown_cell(text), new_code_cell(text, outputs=outputs)]
    begin = time.process_time()
    View(tmp_path, lenient=True).cells(new_notebook(cells=cells))
    assert time.process_time() - begin < 2 * max(1, 3 * size / 1e6)


def test_total_time_for_many_cells_is_limited(tmp_path):
    cells = [new_markdown_cell("<b>x</b> &amp; " * 1000) for _ in range(200)]  # 3 MB
    begin = time.process_time()
    view = View(tmp_path, lenient=True)
    made = view.cells(new_notebook(cells=cells))
    assert time.process_time() - begin < 6
    assert "<pre>" not in made[0]["source"] and "<pre>" in made[-1]["source"]


def test_deep_nesting_is_detected():
    assert is_deep("<div>" * 200) and is_deep("<b></i>" * 200) and is_deep("<B\n>" * 200)
    assert not is_deep("<b>x</b>" * 10_000) and not is_deep("<br><img>" * 10_000)
    assert not is_deep("< " * 10_000) and not is_deep("<x>" * 10_000)


LABS = {path.stem[:2]: path for path in NOTEBOOKS.glob("[0-9]*.ipynb")}
SAMPLE = ("01", "03", "06", "08", "09", "10", "11", "12")  # these labs contain every kind of view
AWAKE = """() => [...document.querySelectorAll(".robokin-player")]
  .filter(each => each.checkVisibility())
  .map(each => "ready" in each.dataset && !each.querySelector(":scope > img"))"""


@pytest.fixture(scope="module")
def stored_report(tmp_path_factory):
    """A function of a lab's number that returns the page of the lab's report, made without a
    kernel, and the script calls in it.
    """
    folder = tmp_path_factory.mktemp("reports")
    return cache(lambda name: report_of(LABS[name], folder))


def report_of(path, folder):
    notebook = nbformat.read(path, as_version=4)
    slug = path.stem.partition("_")[2]
    data = data_of() | {"lab": None, "exercises": [], "predictions": []}
    if slug in book.labs():
        data["lab"] = slug
        data["predictions"] = [
            {"id": name, "choice": None, "right": None, "confusion": None}
            | {"when": None, "later": []}
            for name in book.ids(slug, "predictions")
        ]
    page = folder / f"{path.stem}.html"
    page.write_text(page_of(data, notebook, path.parent), encoding="utf-8")
    calls = [
        call[1]
        for cell in notebook.cells
        for output in cell.get("outputs", ())
        for call in CALL.finditer(output.get("data", {}).get("text/html", ""))
    ]
    return page, calls


def guess_all(page):
    """Answer every prediction of the page; return the number of predictions."""
    return page.evaluate("""() => {
      const asking = [...document.querySelectorAll(".rk-ask")];
      for (const each of asking) {
        const [first] = each.querySelectorAll("input");
        if (first.type === "radio") first.checked = true; else first.value = "1";
        first.dispatchEvent(new Event("input", {bubbles: true}));
        [...each.querySelectorAll("button")].find(b => /guess/.test(b.textContent)).click();
      }
      return asking.length; }""")


def alive(page, calls):
    """Assert that every view has started, including those behind predictions; return the number of
    those behind predictions.
    """
    before = page.evaluate(AWAKE)
    assert before and all(before)
    assert guess_all(page) == calls.count("prediction.ask")
    awake(page)
    after = page.evaluate(AWAKE)
    assert len(after) == len(calls) and all(after), "a view behind a prediction did not start"
    return len(after) - len(before)


def test_report_views_work_from_a_file(browser, stored_report):
    context = browser.new_context(offline=True)
    page, complaints, views, kinds = context.new_page(), [], 0, set()
    page.on("console", lambda m: m.type in ("error", "warning") and complaints.append(m.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    for name in SAMPLE:
        report, calls = stored_report(name)
        page.goto(report.as_uri())
        awake(page)
        views += alive(page, calls)
        kinds |= {*calls}
        assert complaints == [], name
    context.close()
    assert views >= 2, "wanted moving views behind some predictions"
    assert kinds == {*KINDS, "prediction.ask"}


def test_report_views_work_on_a_server(browser, stored_report):
    handler = type(
        "Quiet", (http.server.SimpleHTTPRequestHandler,), {"log_message": lambda *_: None}
    )
    server = http.server.ThreadingHTTPServer(
        ("127.0.0.1", 0), lambda *given: handler(*given, directory=stored_report("03")[0].parent)
    )
    threading.Thread(target=server.serve_forever, daemon=True).start()
    context = browser.new_context()
    page = context.new_page()
    for name, count in (("03", 1), ("05", 1)):
        report, calls = stored_report(name)
        page.goto(f"http://127.0.0.1:{server.server_port}/{report.name}")
        awake(page)
        assert alive(page, calls) == count, "wanted this many moving views behind predictions"
    context.close()
    server.shutdown()
    server.server_close()
