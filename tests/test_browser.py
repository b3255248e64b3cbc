"""Players in a real browser: running in JupyterLab, in trusted and untrusted notebooks, exported
and saved.

The tests read what a reader would see: the pixels of the canvases and the text of the table.
"""

import html
import io
import json
import platform
import re
from pathlib import Path
from types import SimpleNamespace
from urllib.parse import urlsplit

import nbformat
import numpy as np
import pytest
from conftest import NOTEBOOKS, awake, until
from PIL import Image

from robokin import IRB140, Transform, deg, mm, ptp
from robokin.show import animate

PLAYER = "div.robokin-player"
LIVE = ("00_start_here", "03_irb140_motion")
LABS = [path.stem for path in sorted(NOTEBOOKS.glob("*.ipynb"))]
COMPANIONS = [f"documents/{path.stem}" for path in sorted(NOTEBOOKS.glob("documents/*.ipynb"))]
# Script that returns the faults of all players at once: each slider must change the picture and
# restore the first picture at its first value, and the clock must run and stop.
ALIVE = """async selector => {
  const wrong = {}, players = [...document.querySelectorAll(selector)];
  const frames = () => new Promise(done =>
    requestAnimationFrame(() => requestAnimationFrame(done)));
  const hash = canvas => {
    const {width, height} = canvas;
    const data = canvas.getContext("2d").getImageData(0, 0, width, height).data;
    return new Uint32Array(data.buffer).reduce((h, x) => (Math.imul(31, h) + x) | 0, 7);
  };
  const seen = player => [...[...player.querySelectorAll("canvas")].map(hash),
    player.querySelector("table")?.textContent].join();
  const see = async () => { await frames(); return players.map(seen); };
  const sliders = players.map(player =>
    [...player.querySelectorAll("input[type=range]:not([inert] *)")]);
  const say = (k, what) => (wrong[k] ||= []).push(what);
  for (let i = 0; i < Math.max(...sliders.map(all => all.length)); i++) {
    const set = value => sliders.forEach(all => {
      if (!all[i]) return;
      value(all[i]);
      all[i].dispatchEvent(new Event("input", {bubbles: true}));
    });
    set(slider => { slider.value = slider.min; });
    const first = await see();
    set(slider => { slider.value = slider.max; });
    const last = await see();
    // both ends may show the same posture
    set(slider => { slider.value = (+slider.min + +slider.max) / 2; });
    const before = await see();
    set(slider => { slider.value = slider.min; });
    const again = await see();
    players.forEach((_, k) => {
      if (!sliders[k][i]) return;
      if (first[k] === last[k] && first[k] === before[k]) say(k, `slider ${i} changes nothing`);
      if (first[k] !== again[k]) say(k, `slider ${i} does not restore the picture`);
    });
  }
  const buttons = players.map(player =>
    [...player.querySelectorAll("button")].find(
      button => /play|pause/i.test(button.ariaLabel || button.textContent)));
  const still = await see(), end = performance.now() + 10000;
  buttons.forEach(button => button.click());
  let moved = await see();
  while (moved.some((one, k) => one === still[k]) && performance.now() < end) moved = await see();
  moved.forEach((one, k) => one === still[k] && say(k, "play does not start the motion"));
  buttons.forEach(button => button.click());
  const paused = await see();
  await new Promise(done => setTimeout(done, 200));
  (await see()).forEach((one, k) => one !== paused[k] && say(k, "pause does not stop the motion"));
  players.forEach((player, k) => sliders[k].length || say(k, "the player has no time slider"));
  return wrong;
}"""
NEXT_FRAME = "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"


@pytest.fixture
def page(browser):
    """A page that records the errors in its console (`page.errors`) and the requests to other
    machines (`page.outside`).
    """
    context = browser.new_context(viewport={"width": 1280, "height": 1000})
    page = context.new_page()
    page.errors, page.outside = [], []

    def answer(route):
        page.outside.append(route.request.url)
        route.abort()

    context.route(
        lambda url: (
            urlsplit(url).scheme in ("http", "https", "ws", "wss")
            and urlsplit(url).hostname not in ("127.0.0.1", "localhost")
        ),
        answer,
    )
    page.on(
        "console",
        lambda message: (
            message.type == "error"
            and page.errors.append(f"{message.text} ({message.location.get('url', '')})")
        ),
    )
    page.on("pageerror", lambda error: page.errors.append(str(error)))
    yield page
    context.close()


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    """The file of a player with a slider and a switch, as `save` writes it."""
    path = tmp_path_factory.mktemp("saved") / "player.html"
    t = np.linspace(0, 4, 401)
    q = [
        [
            ptp(np.zeros(6), goal * deg * np.array([90, 30, -60, 45, 60, 120]), (t / 4) ** power)
            for goal in (0.25, 0.5, 0.75, 1)
        ]
        for power in (1, 2)
    ]
    target = Transform(translation=(400 * mm, 100 * mm, 600 * mm))
    animate(
        IRB140,
        t,
        np.array(q),
        targets=[target],
        slider=("share", [0.25, 0.5, 0.75, 1.0]),
        switch=("law", ["even", "rising"]),
        title="A turn of every joint",
    ).save(path)
    return path


@pytest.mark.parametrize("lab", LIVE)
def test_player_works_in_jupyterlab(browser, jupyter, page, lab):
    jupyter.open(page, f"{lab}.ipynb")
    jupyter.run_all(page, f"{lab}.ipynb")
    players = page.locator(PLAYER)
    until(
        lambda: players.count() == _stored_players(lab),
        f"{lab}: the players did not appear",
        page,
    )
    awake(page)
    player = players.filter(has=page.locator(".rk-player")).first  # not an explorer
    player.scroll_into_view_if_needed()
    assert player.locator("img").count() == 0, "the still picture was not removed"
    for slider in _sliders(player):
        _moves(page, player, slider)
    _plays(page, player)
    assert page.outside == [] and page.errors == []


def test_opening_a_lab_does_not_mark_it_as_changed(jupyter, page):
    tab = page.locator(".lm-TabBar-tab.lm-mod-current[data-type='document-title']")
    for lab in LIVE:
        # set the reader's Python version: no stored lab can contain the correct one for every
        # reader
        name = _variant(jupyter, f"opened_{lab}.ipynb", lab)
        notebook = json.loads((jupyter.labs / name).read_text())
        notebook["metadata"]["language_info"]["version"] = platform.python_version()
        (jupyter.labs / name).write_text(json.dumps(notebook))
        jupyter.open(page, name)
        page.get_by_text("| Idle").first.wait_for()
        page.wait_for_timeout(1500)  # the status of widgets and the language appears later
        assert tab.count() == 1 and "jp-mod-dirty" not in tab.get_attribute("class"), name
    page.locator(".jp-CodeCell .cm-content").first.click()
    page.keyboard.type("# mine")
    until(lambda: "jp-mod-dirty" in tab.get_attribute("class"), "the change is not marked", page)


def test_theme_change_redraws_every_canvas(jupyter, page):
    jupyter.open(page, "00_start_here.ipynb")
    jupyter.run_all(page, "00_start_here.ipynb")
    player = page.locator(PLAYER).first
    player.scroll_into_view_if_needed()
    _sliders(player)
    before = _settled(page, player)
    for theme, light in (("JupyterLab Dark", "false"), ("JupyterLab Light", "true")):
        page.get_by_role("menuitem", name="Settings", exact=True).click()
        for item in ("Theme", theme):
            label = page.locator(".lm-Menu-itemLabel").get_by_text(item, exact=True)
            label.hover()
        label.click()
        page.locator(f"body[data-jp-theme-light='{light}']").wait_for(state="attached")
        until(
            lambda light=light: (_seen(player) == before) == (light == "true"),
            f"the player does not follow {theme}",
            page,
        )
    assert page.errors == []


def test_arrow_keys_reach_the_slider_and_not_the_notebook(jupyter, page):
    jupyter.open(page, "03_irb140_motion.ipynb")
    jupyter.run_all(page, "03_irb140_motion.ipynb")
    page.locator(PLAYER).first.wait_for()
    awake(page)
    player = page.locator(PLAYER).filter(has=page.get_by_label("blend", exact=True)).first
    player.scroll_into_view_if_needed()
    slider = _slider(player, "blend")
    slider.focus()
    active = (
        "() => [...document.querySelectorAll('.jp-Cell')].findIndex(cell => "
        "cell.matches('.jp-mod-active'))"
    )
    cell, before, seen = page.evaluate(active), slider.input_value(), _seen(player)
    for key in ("ArrowRight", "ArrowUp", "ArrowRight"):
        slider.press(key)
    page.evaluate(NEXT_FRAME)
    after = _seen(player)
    assert float(slider.input_value()) == float(before) + 3 * float(
        slider.get_attribute("step") or 1
    )
    assert after.pixels != seen.pixels and after.numbers != seen.numbers
    for key in ("ArrowDown", "ArrowLeft", "ArrowLeft"):
        slider.press(key)
    page.evaluate(NEXT_FRAME)
    assert _seen(player) == seen, "the same value shows a different picture"
    assert (
        page.evaluate(active) == cell
        and page.evaluate("() => document.activeElement.type") == "range"
    )


def test_shift_enter_and_ctrl_s_work_from_a_control_as_from_a_cell(jupyter, page):
    jupyter.open(page, "00_start_here.ipynb")
    jupyter.run_all(page, "00_start_here.ipynb")
    page.locator(PLAYER).first.wait_for()
    awake(page)
    active = (
        "() => [...document.querySelectorAll('.jp-Cell')].findIndex(cell => "
        "cell.matches('.jp-mod-active'))"
    )
    # by its id: while the cell makes its view again, the first view is that of another cell
    name = page.locator(PLAYER).first.get_attribute("data-player")
    view, unsaved = page.locator(f"[data-player='{name}']"), page.locator(".jp-mod-dirty")
    for control in ("[data-handle]", "button"):
        view.wait_for(state="attached")
        awake(page)
        view.scroll_into_view_if_needed()
        node = view.locator(control).locator("visible=true").first
        view.evaluate("node => node.toggleAttribute('data-old', true)")
        node.hover()
        page.mouse.down()  # a click in its output makes the view's cell the active one
        page.mouse.up()
        node.focus()
        cell = page.evaluate(active)
        node.press("ArrowRight")
        assert page.evaluate(active) == cell, f"{control}: an arrow left the cell"
        until(lambda: unsaved.count() > 0, "there is nothing to save", page)
        node.press("Control+s")
        until(lambda: unsaved.count() == 0, f"{control}: Ctrl+S does not save", page)
        node.press("Shift+Enter")
        until(
            lambda cell=cell: page.evaluate(active) == cell + 1,
            f"{control}: Shift+Enter does not go to the next cell",
            page,
        )
        page.locator("[data-old]").wait_for(state="detached")  # the cell makes its view again
    assert page.errors == []


def test_players_of_a_trusted_notebook_play_before_any_cell_runs(jupyter, page):
    name = _variant(jupyter, "trusted.ipynb")
    jupyter.trust(name)
    jupyter.open(page, name)
    player = page.locator(PLAYER).first
    player.locator("canvas").first.wait_for()
    assert player.locator("img").count() == 0
    for slider in _sliders(player):
        _moves(page, player, slider)
    assert page.outside == [] and page.errors == []


def test_untrusted_notebook_shows_still_pictures(jupyter, page):
    jupyter.open(page, _variant(jupyter, "untrusted.ipynb"))
    stored = re.findall(
        r'<div class="robokin-player"[^>]*><img alt="([^"]*)"', _html_outputs("03_irb140_motion")
    )
    for alt in stored:
        still = page.get_by_alt_text(html.unescape(alt), exact=True).first
        still.wait_for(state="attached")
        still.evaluate("image => image.closest('details')?.setAttribute('open', '')")
        still.scroll_into_view_if_needed()
        until(still.is_visible, "the still picture is not visible", page)
        box = still.bounding_box()
        assert box["width"] > 300 and still.evaluate("image => image.naturalWidth") > 300
    assert stored and page.locator("canvas").count() == 0, "a script of an untrusted notebook ran"
    assert page.outside == [] and page.errors == []


def test_slider_program_that_a_reader_copies_draws_the_motion_of_its_blend(jupyter, page):
    """The program in lab 03, pasted into an empty cell: the picture changes when the slider is
    dragged, and is the one that Python draws for the number next to the slider.
    """
    lab = nbformat.read(NOTEBOOKS / "03_irb140_motion.ipynb", as_version=4)
    [text] = [cell.source for cell in lab.cells if cell.id == "own-slider"]
    [program] = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
    new = nbformat.v4
    cells = [new.new_markdown_cell("# Mine"), new.new_code_cell("")]
    notebook = new.new_notebook(cells=cells, metadata=lab.metadata)
    nbformat.write(notebook, Path(jupyter.labs, "slider.ipynb"))
    jupyter.open(page, "slider.ipynb")
    page.get_by_text("| Idle").first.wait_for()
    page.locator(".jp-CodeCell .cm-content").first.click()
    page.keyboard.insert_text(program)
    page.keyboard.press("Shift+Enter")
    picture = page.locator(".jp-OutputArea img.widget-image")
    picture.wait_for()
    first = _pixels_of(picture)
    handle = page.locator(".jp-OutputArea .noUi-handle").bounding_box()
    x, y = handle["x"] + handle["width"] / 2, handle["y"] + handle["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 60, y, steps=3)
    page.mouse.up()
    shown = float(page.locator(".widget-readout").inner_text())
    assert shown > 0.1
    made = {}
    exec(program, made)
    opening = _image(made["picture"].value)
    made["slider"].value = shown
    wanted = _image(made["picture"].value)
    assert (first == opening).all() and (wanted != opening).any()
    until(lambda: np.array_equal(_pixels_of(picture), wanted), "another picture is shown", page)
    assert page.errors == []


def _pixels_of(picture):
    """The pixels of an image in the page."""
    return _image(
        bytes(
            picture.evaluate(
                """async image => {
                  const file = await fetch(image.src);
                  return [...new Uint8Array(await file.arrayBuffer())];
                }"""
            )
        )
    )


def _image(file):
    return np.asarray(Image.open(io.BytesIO(file)))


@pytest.mark.parametrize("lab", [*LABS, *COMPANIONS])
def test_players_of_exported_labs_work_offline(page, exported, lab):
    page.goto(exported[lab].as_uri())
    awake(page)
    players = page.locator(PLAYER)
    assert players.count() == _stored_players(lab)
    assert players.count() > 0 or lab in COMPANIONS
    for question in page.locator(".rk-ask").all():
        _opens(question)
    played, views = [], 0
    for player in players.all():  # players behind a question are included
        if player.locator(":scope > .rk-ask").count():
            continue
        player.locator("canvas").first.wait_for()
        if player.locator(":scope > .rk-figure").count():
            continue  # joint curves without controls
        asleep = player.locator(".rk-asleep").count()  # inactive without a kernel
        if player.locator(".rk-handle").count() and not asleep:
            _answers(page, player)
            continue
        if asleep:
            assert player.locator(".rk-handles:is([inert], .rk-taps)").count() == 1
        player.evaluate("e => e.classList.add('played')")
        views += 1
        played += [] if asleep else [player]
    if views:
        assert page.evaluate(ALIVE, ".played") == {}
    if played:
        for slider in _sliders(played[0]):  # tested below with keys and mouse
            _moves(page, played[0], slider)
        _plays(page, played[0])
    assert page.outside == [] and page.errors == []
    for prose in page.locator(".jp-RenderedMarkdown").all_inner_texts():
        assert not re.search(r"\$|\\[a-z]+", prose), f"TeX is not rendered: {prose}"


def test_saved_player_sends_no_requests(page, saved):
    requests = []
    page.on("request", lambda request: requests.append(request.url))
    page.goto(saved.as_uri())
    awake(page)
    player = page.locator(PLAYER)
    for slider in _sliders(player):
        _moves(page, player, slider)
    menu = player.get_by_label("law", exact=True)
    seen = _seen(player)
    menu.select_option("rising")
    page.evaluate(NEXT_FRAME)
    after = _seen(player)
    assert after.pixels != seen.pixels and after.numbers != seen.numbers
    _plays(page, player)
    assert [url for url in requests if not url.startswith(("data:", "blob:"))] == [saved.as_uri()]
    assert page.errors == []


def test_keyboard_reaches_every_control(page, saved):
    page.goto(saved.as_uri())
    awake(page)
    controls = page.locator(PLAYER).locator("button, input, select, .rk-scene")
    # controls: view, play, time, speed, panel, numbers, slider, switch
    assert controls.count() == 8
    reached = set()
    for _ in range(controls.count() + 1):
        page.keyboard.press("Tab")
        reached |= {
            i
            for i, control in enumerate(controls.all())
            if control.evaluate("element => element === document.activeElement")
        }
    assert len(reached) == controls.count()
    for name in ("play", "time", "playback speed", "large panel", "numbers", "share", "law"):
        assert page.get_by_label(name, exact=True).count() == 1, f"wanted one control called {name}"


# --- Helpers: user actions and visible content ----------------------------------------------------


def _seen(player):
    """The pixels of all canvases and the text of the table."""
    pixels = player.evaluate(
        "e => [...e.querySelectorAll('canvas')].map(canvas => canvas.toDataURL())"
    )
    assert pixels and all(len(one) > 2000 for one in pixels), "a canvas is empty"
    table = player.locator("table")  # the lever explorer has sentences instead of a table
    words = (table.first if table.count() else player).inner_text()
    return SimpleNamespace(pixels=pixels, numbers=words)


def _settled(page, player):
    """Return the visible content once it no longer changes: views above the player may still move
    or widen it.
    """
    seen = _seen(player)
    for _ in range(20):
        page.wait_for_timeout(300)
        before, seen = seen, _seen(player)
        if before == seen:
            return seen
    pytest.fail("the picture keeps changing")


def _sliders(player):
    player.locator("canvas").first.wait_for()
    sliders = player.locator("input[type=range]:not([inert] *)").all()
    assert sliders, "the player does not even have its time slider"
    return sliders


def _slider(player, label):
    return player.get_by_role("slider", name=re.compile(label, re.I)).first


def _moves(page, player, slider):
    """Assert that keys and mouse change the value and the picture, and that the picture depends
    only on the value.
    """
    slider.scroll_into_view_if_needed()
    slider.focus()
    slider.press("End")  # a clock paused within the first tick would ignore Home
    slider.press("Home")
    page.evaluate(NEXT_FRAME)
    first, value = _seen(player), slider.input_value()
    slider.press("End")
    page.evaluate(NEXT_FRAME)
    seen = [_seen(player).pixels]
    assert slider.input_value() != value
    # the first and last value may give the same motion, if they rotate a target by a whole turn
    slider.press("ArrowLeft")
    page.evaluate(NEXT_FRAME)
    seen.append(_seen(player).pixels)
    assert any(pixels != first.pixels for pixels in seen)
    box = slider.bounding_box()
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.9 * box["width"], middle)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.5 * box["width"], middle, steps=4)
    page.mouse.up()
    page.evaluate(NEXT_FRAME)
    between = float(slider.input_value())
    assert float(value) < between < float(slider.get_attribute("max"))
    slider.press("Home")
    page.evaluate(NEXT_FRAME)
    assert _seen(player) == first


def _answers(page, player):
    """Assert that a slider and a key press on a handle change the picture and the text of an
    explorer.
    """
    for held in (player.locator("input[type=range]").first, player.locator(".rk-handle").first):
        held.scroll_into_view_if_needed()
        held.focus()
        page.evaluate(NEXT_FRAME)
        before, words = _seen(player), player.inner_text()
        if held.get_attribute("aria-label") == "time":
            held.press("End")  # the clock shows the beginning of a short run as 0.00 s
        page.keyboard.down("Shift")
        for _ in range(5):  # the key stays down, since a released rotor springs back
            page.keyboard.down("ArrowRight")
        until(
            lambda before=before, words=words: (
                _seen(player).pixels != before.pixels and player.inner_text() != words
            ),
            "an explorer does not respond",
            page,
        )
        for key in ("ArrowRight", "Shift"):
            page.keyboard.up(key)


def _plays(page, player):
    """Assert that the play button starts and stops the arm."""
    speed = player.get_by_label("playback speed", exact=True)
    if speed.count():  # slowly: a motion that ended before the second click would start again
        speed.first.select_option(index=0)
    button = player.get_by_role("button", name=re.compile("play|pause", re.I)).first
    pauses = player.get_by_role("button", name=re.compile("pause", re.I))
    seen = _seen(player)
    button.click()
    until(
        lambda: _seen(player).pixels != seen.pixels, "the play button does not start the arm", page
    )
    assert pauses.count(), "the motion has ended"
    button.click()
    page.evaluate(NEXT_FRAME)
    assert not pauses.count()
    seen = _seen(player)
    page.wait_for_timeout(200)
    assert _seen(player) == seen, "the pause button does not stop the arm"


def _html_outputs(lab):
    """All HTML outputs stored in a lab."""
    cells = nbformat.read(NOTEBOOKS / f"{lab}.ipynb", as_version=4).cells
    return "\n".join(
        o.get("data", {}).get("text/html", "") for cell in cells for o in cell.get("outputs", ())
    )


def _opens(question):
    """Make a guess, and assert that the prediction replies to it."""
    assert not question.locator(".rk-answer").inner_text()
    typed = question.locator("fieldset input[type=number]")
    if typed.count():
        typed.fill("1")
    else:
        question.locator("input[type=radio]").first.check()
    question.get_by_role("button", name="This is my guess").click()
    assert "ight" in question.locator(".rk-answer").inner_text()


def _stored_players(lab):
    return len(re.findall('<div class="robokin-player"', _html_outputs(lab)))


def _variant(jupyter, name, lab="03_irb140_motion"):
    """Make a copy of a lab with one more cell, so that it has its own signature; return the name
    for `jupyter.open`.
    """
    notebook = json.loads(Path(jupyter.labs, f"{lab}.ipynb").read_text(encoding="utf-8"))
    notebook["cells"].append(
        {"cell_type": "markdown", "id": "variant", "metadata": {}, "source": [name]}
    )
    Path(jupyter.labs, name).write_text(json.dumps(notebook), encoding="utf-8")
    return name
