"""Views fit on a screen and their text is readable, in the exported labs and in one lab in
JupyterLab. `benchmarks/fit.py` measures every lab in JupyterLab.
"""

import re

import nbformat
import pytest
from canvas_words import MOVE, NEXT, faults
from canvas_words import RECORD as WORDS
from conftest import NOTEBOOKS, awake
from fitting import RECORD as SIZES
from fitting import SCREEN, sizes, walked

LABS = [path.stem for path in sorted(NOTEBOOKS.glob("*.ipynb"))]
# Returns the sentences of visible players that do not fit into their boxes
CUT = """() => [...document.querySelectorAll(".rk-player .rk-says")]
  .filter(box => box.clientHeight && box.scrollHeight > box.clientHeight + 1)
  .map(box => box.innerText)"""


def opened(browser, path, width, theme):
    page = browser.new_page(viewport={"width": width, "height": 900}, color_scheme=theme)
    page.add_init_script(WORDS + SIZES)
    page.goto(path.as_uri())
    awake(page)
    page.evaluate(NEXT)
    page.wait_for_function(
        "() => canvasWords().every(each => each.words.length || each.kind.includes('rk-plan'))"
    )
    return page


@pytest.mark.parametrize("lab", LABS)
def test_views_fit_and_their_text_is_readable_on_a_laptop_and_on_a_phone(browser, exported, lab):
    """At 1036 px, an output is as wide as in JupyterLab with its file browser open."""
    for width, theme in ((1036, "light"), (900, "dark"), (390, "dark")):
        page = opened(browser, exported[lab], width, theme)
        assert faults(page) == [], f"{width} px, {theme}"
        written = page.evaluate("canvasWords().flatMap(each => each.words).length")
        assert written > 20, "no text was recorded"
        hidden = page.evaluate(CUT)
        assert not hidden, f"{width} px: sentences of a player are cut: {hidden}"
        found = sizes(page)
        assert found, "no view is open"
        for view in found if width == 1036 else ():
            wide = 860 if "rk-ask" in view["kind"] else 894  # narrower for reading
            assert view["width"] == pytest.approx(wide, abs=1)
            assert 60 < view["height"] <= view["most"], view
            if "rk-player" in view["kind"]:
                assert view["plot"] >= 180 and view["canvas"] >= 180, view
        page.close()


@pytest.mark.parametrize("lab", LABS)
def test_no_word_hides_another_word_a_link_a_joint_or_a_handle(browser, exported, lab):
    """At ten places of all sliders, which move at the same time. Where handles leave little room,
    one word in ten pictures of a lab may touch something, and two on a phone.
    """
    for width, theme, allowed in ((1036, "light", 1), (390, "dark", 2)):
        page = opened(browser, exported[lab], width, theme)
        found = []
        for place in range(10):
            page.evaluate(MOVE, [place, 10])
            page.evaluate(NEXT)
            found += [(place, fault) for fault in faults(page)]
        words = page.evaluate("canvasWords().flatMap(canvas => canvas.words)")
        assert len(words) > 5, "no words were recorded"
        assert len(found) <= allowed, f"{width} px: {found}"
        page.close()


def test_planted_faults_on_a_canvas_are_detected(browser):
    page = browser.new_page()
    page.add_init_script(WORDS)
    page.goto(
        "data:text/html,<style>canvas{--rk-paper:%23ffffff;--rk-joint2:%23d55e00;"
        "--rk-link:%234b5563}button{position:absolute;left:200px;top:60px}</style>"
        "<div class=rk-space style=position:absolute><canvas width=300 height=150></canvas>"
        "<button data-handle=a>a</button></div>"
    )
    page.evaluate(
        """() => {
          const g = document.querySelector("canvas").getContext("2d");
          const write = (text, x, y, size, color) => {
            g.font = `${size}px sans-serif`; g.fillStyle = color; g.fillText(text, x, y); };
          write("good", 10, 30, 12, "#000000");
          write("small", 60, 30, 8, "#000000");
          write("pale", 120, 30, 12, "#bbbbbb");
          g.fillStyle = "#333333"; g.fillRect(160, 10, 60, 30);
          write("dark", 165, 30, 12, "#000000");
          write("outside", 280, 60, 12, "#000000");
          write("first", 10, 100, 12, "#000000");
          write("second", 20, 104, 12, "#000000");
          g.fillStyle = "#d55e00"; g.beginPath(); g.ellipse(100, 70, 9, 4, 0.5, 0, 7); g.fill();
          g.strokeStyle = "#4b5563"; g.beginPath(); g.moveTo(120, 140); g.lineTo(180, 110);
          g.stroke();
          write("joint", 95, 74, 12, "#000000");
          write("link", 140, 130, 12, "#000000");
          write("handle", 205, 75, 12, "#000000");
        }"""
    )
    assert {(fault.text, fault.why.split(" ")[0]) for fault in faults(page)} == {
        ("small", "8.0"),
        ("pale", "contrast"),
        ("dark", "contrast"),
        ("outside", "cut"),
        ("second", "over"),
        ("joint", "on"),
        ("link", "on"),
        ("handle", "on"),
    }
    page.evaluate("""() => {
        const g = document.querySelector("canvas").getContext("2d"); g.clearRect(0, 0, 300, 150);
        g.font = "12px sans-serif"; g.fillStyle = "#000000"; g.fillText("good", 10, 30); }""")
    assert faults(page) == []
    page.close()


def test_views_fit_next_to_the_file_browser_of_jupyterlab(browser, jupyter):
    lab = "05_scara_motion.ipynb"
    context = browser.new_context(viewport=SCREEN)
    page = context.new_page()
    page.add_init_script(WORDS + SIZES)
    jupyter.trust(lab)
    jupyter.open(page, lab)
    page.locator(".robokin-player").first.wait_for()
    panel = page.locator(".jp-WindowedPanel-outer, .jp-Notebook").first.bounding_box()
    assert panel["width"] < 1100, "the file browser is closed"
    found = [view for view in walked(page) if "rk-ask" not in view["kind"]]
    outputs = [
        output["data"]["text/html"]
        for cell in nbformat.read(NOTEBOOKS / lab, as_version=4).cells
        for output in cell.get("outputs", ())
        if 'class="robokin-player"' in output.get("data", {}).get("text/html", "")
    ]
    call = re.compile(r"^\$(\w+)\.(?:play|ask|explore|show)\(", re.M)
    calls = [call.findall(output) for output in outputs]  # a question contains the call of its view
    count = sum("prediction" not in names for names in calls)
    assert len(found) == count >= 5
    for view in found:
        assert view["width"] < 920 and view["height"] <= view["most"] <= panel["height"], view
    context.close()
