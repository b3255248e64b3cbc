"""Views that ask a kernel, in a real JupyterLab. With a kernel, they show Python's answer for the
last position; without one, they show the stored answer and a note that they are inactive.
"""

import itertools
import re
import subprocess
import sys

import nbformat
import numpy as np
import pytest
import test_browser
from axe_playwright_python.sync_playwright import Axe
from conftest import ROOT, until

from robokin import deg, three_lever
from robokin.course.export import export
from robokin.jobs.obstacles import clearance, distances, keeps, plan, via_path
from robokin.jobs.obstacles.planner import CIRCLES
from robokin.jobs.obstacles.posture_grid import NEVER, coarse_search
from robokin.show import joiner, live, markup, plan_explorer
from robokin.show.plan_explorer import AWAY, FORBIDDEN, STEP

quiet = test_browser.page  # records errors and requests to other hosts
ARM = three_lever(1.0)
START = ARM.family((1.2, 1.7), 118 * deg)
CELL = """\
from robokin import deg, three_lever
from robokin.show import plan_explorer

arm = three_lever(1.0)
start = arm.family((1.2, 1.7), 118 * deg)
plan_explorer(arm, start, (1.9, 0.3), (1.2, 1.3))"""
ASLEEP = live.WORDS["asleep"]
NAME = "live.ipynb"
CLIPBOARD = """
const clipboard = {writeText: async text => { window.copied = text; }};
Object.defineProperty(navigator, "clipboard", {value: clipboard});
"""


# --- Answers to questions -------------------------------------------------------------------------


def questions(count, seed=15):
    rng = np.random.default_rng(seed)
    start = START
    for _ in range(count):
        target, obstacle = rng.uniform((-1, -0.5), (2.5, 2.2)), rng.uniform((-1, 0), (2.2, 2))
        q = {"posture": start.tolist(), "target": target.tolist(), "obstacle": obstacle.tolist()}
        yield q | {"distance": rng.uniform(0.05, 0.2), "way": 0, "sides": True}
        start = plan(ARM, start, target).posture


def test_answer_and_drawing_match_the_plan():
    answer, ways = plan_explorer(ARM, START, (1.9, 0.3), (1.2, 1.3)).answer, set()
    for question in questions(25):
        known = plan(ARM, *(question[k] for k in ("posture", "target", "obstacle", "distance")))
        said = answer(question)
        assert (said["way"], said["words"]) == (known.way, known.words)
        assert said["kept"] == known.found
        np.testing.assert_array_equal(said["path"], known.path)
        moments = said["moments"].astype(float)
        np.testing.assert_allclose(moments[[0, -1]], known.path[[0, -1]], atol=1e-6)
        turned = abs(np.diff(moments, axis=0)).sum()
        assert turned == pytest.approx(known.cost, rel=0.2, abs=1e-5)  # the path drawn cuts corners
        if known.found:
            near = distances(ARM, moments, question["obstacle"])
            assert near.min() >= question["distance"] - 1e-6
            assert f"S = {known.cost / deg:.0f}°" in said["result"]
            assert f"{known.clearance.min() * 1000:.1f} mm" in said["result"]
        else:
            assert said["result"] == "No: the arm does not move."
        ways.add(known.way)
    assert {"direct", "search", "none"} <= ways


def test_unchecked_paths_are_judged_by_lever_clearance():
    answer = plan_explorer(ARM, START, (1.9, 0.3), (1.2, 1.3)).answer
    seen = set()
    for question in questions(12, seed=3):
        posture, target, H, wanted = (
            np.array(question[k]) for k in ("posture", "target", "obstacle", "distance")
        )
        for way in (1, 2):
            said = answer(question | {"way": way})
            if way == 1:
                first = max(wanted, 1 / 7)
                radii = [first, *(r for r in CIRCLES if r > first)]
                paths = [via_path(ARM, posture, target, H, r) for r in radii]
                room = [clearance(ARM, p, H).min() if np.isfinite(p).all() else -1 for p in paths]
                path = paths[int(np.argmax(np.minimum(room, wanted)))]
                told = re.search(r"K2 and K3, ([\d.]+) mm", said["words"])
                if told:  # picture and sentence are about the same circle
                    drawn = np.hypot(*(np.array(said["via"]) - H).T)
                    assert drawn == pytest.approx([float(told[1]) / 1000] * 2, abs=6e-5)
                    seen.add("told")
            else:
                path = np.stack([posture, ARM.least(target, posture)[0]])
            if np.isnan(path).any():
                assert not said["kept"] and "reach" in said["result"]
                continue
            np.testing.assert_allclose(said["path"], path)
            kept = bool(keeps(ARM, path[:-1], path[1:], H, wanted).all())
            assert said["kept"] == kept == ("not safe" not in said["result"])
            seen.add((way, kept))
    assert seen == {(1, True), (1, False), (2, True), (2, False), "told"}


def test_cube_of_postures_agrees_with_distances_and_a_simple_search():
    question = next(questions(1)) | {"obstacle": [1.2, 1.3], "target": [1.9, 0.3]}
    said = plan_explorer(ARM, START, (1.9, 0.3), (1.2, 1.3)).answer(question)
    cube, n = said["cube"], len(said["cube"])
    grid = STEP * np.stack(np.meshgrid(*[np.arange(n)] * 3, indexing="ij"), axis=-1)
    near = distances(ARM, grid, question["obstacle"]).min(axis=-1)
    np.testing.assert_array_equal(cube == FORBIDDEN, near < question["distance"])
    begun, around = tuple(np.argwhere(cube == 0)[0]), abs(grid - question["posture"])
    assert (cube == 0).sum() == 1 and around[begun].max() <= STEP
    known, front = {begun: 0}, [begun]  # repeats the search, one posture at a time
    while front:
        later = []
        for cell, joint, side in itertools.product(front, range(3), (-1, 1)):
            other = (*cell[:joint], cell[joint] + side, *cell[joint + 1 :])
            if not 0 <= other[joint] < n or other in known or cube[other] == FORBIDDEN:
                continue
            if keeps(ARM, grid[cell], grid[other], question["obstacle"], question["distance"]):
                known[other] = known[cell] + 1
                later.append(other)
        front = later
    curve = said["curve"].astype(float)
    goals = {tuple(cell) for cell in np.round(curve / STEP).astype(int).tolist()}
    arrives = min(known[cell] for cell in goals & set(known))
    assert said["most"] == arrives and 5 < arrives < 40
    wanted = np.where(cube == FORBIDDEN, FORBIDDEN, AWAY)
    for cell, count in known.items():
        wanted[cell] = count if count <= arrives else AWAY
    np.testing.assert_array_equal(cube, wanted)
    assert (cube < AWAY).sum() > 300
    tips = ARM.points(curve)[:, 3]
    np.testing.assert_allclose(tips, np.tile(question["target"], (len(tips), 1)), atol=1e-5)


def test_there_is_no_wave_where_there_is_no_plan():
    """In steps of 12 degrees, the search arrives, but on a way that does not keep the distance."""
    question = next(questions(1)) | {"obstacle": [0.0, 1.3], "target": [1.9, 0.3]}
    question |= {"posture": START.tolist(), "distance": 1 / 7}
    said = plan_explorer(ARM, START, (1.9, 0.3), (1.2, 1.3)).answer(question)
    places = (np.array(question[key]) for key in ("posture", "target", "obstacle"))
    steps, free, _ = coarse_search(ARM, *places, 1 / 7, STEP)
    assert (steps < NEVER).sum() > 1000 and said["way"] == "none"
    assert said["most"] == 0 and not (said["cube"] < AWAY).any()
    np.testing.assert_array_equal(said["cube"] == AWAY, free)


# --- Arrays in messages and files -----------------------------------------------------------------

UNPACK = """([content, buffers]) => {
  const plain = x => Array.isArray(x) ? x.map(plain) : !x || typeof x !== "object" ? x
    : x.values ? {kind: x.values.constructor.name, shape: x.shape, values: Array.from(x.values)}
    : Object.fromEntries(Object.entries(x).map(([k, v]) => [k, plain(v)]));
  const views = buffers && buffers.map(text => {
    const bytes = Uint8Array.from(" " + atob(text), letter => letter.charCodeAt(0));
    return new DataView(bytes.buffer, 1);  // at an odd offset
  });
  return plain($live.joinArrays(content, views));
}"""


def test_arrays_reach_the_page_unchanged_by_message_and_by_file(browser):
    rng = np.random.default_rng(2)
    arrays = {
        "bytes": rng.integers(0, 256, (3, 4, 5)).astype(np.uint8),
        "turned": rng.integers(0, 65536, (4, 3)).astype(np.uint16).T,
        "thin": rng.integers(-32768, 32768, 21).astype(np.int16)[::2],
        "real": rng.normal(size=(2, 7)).astype(np.float32),
        "none": np.empty((0, 3), dtype=np.float32),
    }
    content, buffers = live.split_arrays(
        {"words": "ä", "list": [1, None, arrays["thin"]], **arrays}
    )
    text = [live.stored({"array": k}, buffers)["array"] for k in range(len(buffers))]
    assert markup.inert(live.stored(content, buffers))
    tab = browser.new_page()
    tab.evaluate(f"() => {{ {joiner.script('live')}; window.$live = $live; }}")
    for sent in ([live.stored(content, buffers), None], [content, text]):
        got = tab.evaluate(UNPACK, sent)
        assert got["words"] == "ä" and got["list"][:2] == [1, None]
        assert got["list"][2] == got["thin"]
        for name, array in arrays.items():
            kind = f"{array.dtype.name.capitalize()}Array"
            assert (got[name]["kind"], got[name]["shape"]) == (kind, list(array.shape))
            np.testing.assert_array_equal(got[name]["values"], array.ravel())
    tab.close()
    with pytest.raises(ValueError, match="answer: wanted arrays of uint8"):
        live.split_arrays({"x": np.zeros(3)})


# --- Live views in JupyterLab ---------------------------------------------------------------------


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    """A notebook with the plan explorer, run and stored."""
    path = tmp_path_factory.mktemp("stored") / NAME
    v4 = nbformat.v4
    cells = [v4.new_markdown_cell("# Live", id="title"), v4.new_code_cell(CELL, id="cell")]
    cells.append(v4.new_code_cell("print(1 + 1)", id="last"))
    kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    nbformat.write(v4.new_notebook(cells=cells, metadata={"kernelspec": kernel}), path)
    script = [sys.executable, ROOT / "tests" / "execute_notebooks.py", path]
    subprocess.run(script, check=True, capture_output=True)
    return path


def test_live_view_starts_after_run_all_and_shows_the_last_position(jupyter, quiet, stored):
    (jupyter.labs / NAME).write_bytes(stored.read_bytes())
    quiet.add_init_script(CLIPBOARD)
    jupyter.open(quiet, NAME)
    jupyter.run_all(quiet, NAME)
    awake(quiet)
    before = quiet.locator(".rk-result").inner_text()
    ways = set()
    for name, way in (("H", (60, 20)), ("K", (-70, 50)), ("K1", (-90, -20)), ("H", (-150, 60))):
        x, y = middle(quiet, name)
        quiet.mouse.move(x, y)
        quiet.mouse.down()
        quiet.mouse.move(x + way[0], y + way[1], steps=12)
        quiet.mouse.up()
        ways.add(shows_what_python_says(quiet))
    assert quiet.locator(".rk-result").inner_text() != before and len(ways) > 1
    quiet.locator("[data-handle=K1]").press("Shift+ArrowUp")
    quiet.get_by_role("slider", name="distance, mm", exact=True).press("ArrowRight")
    shows_what_python_says(quiet)
    quiet.locator("[data-handle=H]").press("Home")
    asked = int(quiet.locator(".robokin-player").get_attribute("data-asked"))
    quiet.locator("[data-handle=H]").evaluate(QUICK, 200)
    shows_what_python_says(quiet)
    now = int(quiet.locator(".robokin-player").get_attribute("data-asked"))
    assert now - asked < 200, "the view did not skip positions that the pointer passed quickly"
    assert quiet.errors == [] and quiet.outside == []

    # a restarted kernel has no connection to the page
    quiet.get_by_role("menuitem", name="Kernel", exact=True).click()
    quiet.get_by_role("menuitem", name="Restart Kernel").first.click()
    quiet.locator(".jp-Dialog .jp-mod-accept").click()
    asleep(quiet)
    quiet.get_by_text("| Idle").first.wait_for()
    quiet.locator(".jp-CodeCell").first.click(position={"x": 300, "y": 10})
    quiet.keyboard.press("Control+Enter")
    awake(quiet)
    quiet.locator("[data-handle=H]").press("Shift+ArrowUp")
    shows_what_python_says(quiet)
    seen = quiet.locator(".rk-result").inner_text()

    # The notebook is saved and opened again without that kernel.
    quiet.locator(".jp-CodeCell .cm-content").first.click()
    quiet.keyboard.press("Control+s")
    tab = quiet.locator(".lm-TabBar-tab.lm-mod-current[data-type='document-title']")
    until(lambda: "jp-mod-dirty" not in tab.get_attribute("class"), "not saved", quiet)
    jupyter.open(quiet, NAME)
    quiet.locator(".rk canvas").first.wait_for()
    quiet.get_by_text("| Idle").first.wait_for()
    asleep(quiet)
    assert quiet.locator(".rk-result").inner_text() != seen, (
        "the last picture was stored, not that of the run"
    )
    assert quiet.get_by_text("Error displaying widget").count() == 0
    assert quiet.errors == [] and quiet.outside == []


# Moves the pointer ten times per frame, which is too fast for a view.
QUICK = """(node, count) => new Promise(done => {
  const r = node.getBoundingClientRect(), x = r.x + r.width / 2, y = r.y + r.height / 2;
  const tell = (type, clientX, clientY) =>
    node.dispatchEvent(new PointerEvent(type, {pointerId: 1, clientX, clientY}));
  node.setPointerCapture = () => {};  // a pointer that does not exist cannot be captured
  tell("pointerdown", x, y);
  let i = 0;
  const go = () => {
    for (let k = 0; k < 10; k++, i++)
      tell("pointermove", x - 70 * Math.sin(i / 20) ** 2, y + 40 * Math.sin(i / 9));
    if (i < count) return requestAnimationFrame(go);
    tell("pointerup", x, y);
    done();
  };
  go();
})"""


def middle(tab, name):
    box = tab.locator(f"[data-handle={name}]").bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def awake(tab):
    tab.locator(".robokin-player[data-awake]").wait_for()
    assert tab.locator(".rk-asleep").is_hidden()
    assert tab.locator(".rk-handles[inert], .rk-side[inert]").count() == 0


def asleep(tab):
    tab.get_by_text(ASLEEP).wait_for()
    assert tab.locator(".robokin-player[data-awake]").count() == 0
    assert tab.locator(".rk-handles[inert]").count() == tab.locator(".rk-side[inert]").count() == 1
    pictures = tab.locator(".rk canvas").evaluate_all("all => all.map(c => c.toDataURL().length)")
    assert len(pictures) == 2 and min(pictures) > 3000


def shows_what_python_says(tab):
    """Wait until all questions are answered, check the text and numbers for the last one, and
    return the `way` of its plan.
    """
    still = "e => [e.dataset.asked, e.dataset.answered, e.querySelector('.rk-result').textContent]"
    seen = [None]

    def rests():
        tab.wait_for_timeout(200)
        now = tab.locator(".robokin-player").evaluate(still)
        same, seen[0] = now == seen[0] and now[0] == now[1], now
        return same

    until(rests, "the answers keep changing", tab)
    tab.get_by_role("button", name="Copy as Python").click()
    space = {"arm": ARM}
    lines = tab.evaluate("window.copied").replace("\nplan(", "\nknown = plan(")
    exec(lines, space)
    known = space["known"]
    assert tab.locator(".rk-says").inner_text() == known.words
    verdict = tab.locator(".rk-result").inner_text()
    if known.found:
        S, near = re.search(r"S = (\d+)° .*lever .*?([\d.]+) mm of H\.$", verdict).groups()
        assert f"{known.cost / deg:.0f}" == S
        assert f"{known.clearance.min() * 1000:.1f}" == near
    else:
        assert verdict == "No: the arm does not move."
    return known.way


# --- Stored and exported views --------------------------------------------------------------------


def test_exported_page_is_inactive_except_for_parts_that_need_no_kernel(quiet, stored, tmp_path):
    export(stored, tmp_path / "live.html")
    quiet.goto((tmp_path / "live.html").as_uri())
    asleep(quiet)
    player = quiet.locator(".robokin-player")
    test_browser._plays(quiet, player)
    for slider in test_browser._sliders(player):
        test_browser._moves(quiet, player, slider)
    cube = quiet.locator(".rk-cube")
    before = cube.evaluate("e => e.toDataURL()")
    cube.press("ArrowRight")
    quiet.evaluate(test_browser.NEXT_FRAME)
    assert cube.evaluate("e => e.toDataURL()") != before, "the cube cannot be turned"
    found = Axe().run(quiet, context=".rk").response["violations"]
    assert [rule["id"] for rule in found if rule["impact"] in ("serious", "critical")] == []
    assert quiet.errors == [] and quiet.outside == []


def test_letters_go_back_when_the_kernel_has_ended(quiet, tmp_path):
    """The last answer stays on the screen, so its obstacle and its target do, too."""
    plan_explorer(ARM, START, (1.9, 0.3), (1.2, 1.3)).save(tmp_path / "plan.html")
    quiet.goto((tmp_path / "plan.html").as_uri())
    player, H = quiet.locator(".robokin-player"), quiet.locator("[data-handle=H]")
    quiet.locator(".robokin-player[data-ready]").wait_for()  # before that, no one hears the event
    player.evaluate("""e => e.dispatchEvent(new CustomEvent(
      "robokin-wake", {detail: () => { throw new Error("no kernel"); }}))""")
    quiet.locator(".robokin-player[data-awake]").wait_for()
    H.press("Shift+ArrowRight")
    asleep(quiet)
    until(
        lambda: H.get_attribute("aria-label") == "H, the obstacle, 1.200, 1.300 m", "moved", quiet
    )


def test_stored_picture_is_small_and_nbval_passes(stored):
    notebook = nbformat.read(stored, as_version=4)
    assert set(notebook.metadata) == {"kernelspec", "language_info"}
    [output] = notebook.cells[1].outputs
    html = output.data["text/html"]
    assert set(output.data) == {"text/html", "text/plain"} and len(html.encode()) < 61_000
    assert re.search(r'<img alt="[^"]{60,}" [^>]*src="data:image/png;base64,', html)
    assert "widget" not in stored.read_text()
    rules = ROOT / "tests" / "nbval_sanitize.cfg"
    options = ["-p", "no:cacheprovider", "--override-ini", "addopts=", "--nbval"]
    options += ["--nbval-current-env", "--nbval-sanitize-with", rules]
    command = [sys.executable, "-m", "pytest", *options, stored]
    run = subprocess.run(command, cwd=stored.parent, text=True, capture_output=True)
    assert run.returncode == 0, run.stdout[-3000:]
