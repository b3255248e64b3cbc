"""What a player lets its reader watch: the large panel, the joints, named quantities, the initial
curve, limits that are exceeded, and the row of `ik`. The tests also check how much of the screen
all this needs.
"""

import numpy as np
import pytest
import test_clearance_explorer
import test_paths_explorer
import test_singularity_explorer
from conftest import awake
from test_player import FRACTIONS, GOAL, ROW, SCARA, START, VIA, T, chain, ink, kept, unpacked

from robokin import IRB140, PUMA560, deg, follow, lin, mm, ptp, quintic, three_lever
from robokin import SCARA as WITH_ROWS
from robokin.show import (
    animate,
    elbow_explorer,
    joint_explorer,
    motion_explorer,
    motor_explorer,
    target_explorer,
)
from robokin.show.joiner import script

CLOCK = np.linspace(0, 6, 601)
TURNING = ptp([0, 0, 0, 0, 30 * deg, 0], [1, 0.5, 0.4, 1, 1, 2], quintic(6)(CLOCK))
PLAIN = {"targets": [START, VIA, GOAL], "slider": ("blend", FRACTIONS)}
HALVES = ptp([0, 0, 0, 0, 30 * deg, 0], [1, 0.4, 1.4, 1, 1, 2], quintic(6)(CLOCK))  # q3 to 80°


@pytest.fixture(scope="module")
def motions():
    return chain(FRACTIONS[:, None])


@pytest.fixture
def page(browser):
    """A page as wide as an output of JupyterLab with its file browser open, on a screen 1366 px
    wide.
    """
    page = browser.new_page(viewport={"width": 914, "height": 647})
    said = []
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("console", lambda m: said.append(m.text) if m.type in ("error", "warning") else None)
    # record the frames of panels and the text of each canvas's newest picture: the page may draw
    # twice after a resize, because a scroll bar then changes the width
    page.add_init_script("""
        window.drawn = new Map();
        const {clearRect, strokeRect, fillText} = CanvasRenderingContext2D.prototype;
        CanvasRenderingContext2D.prototype.clearRect = function (...box) {
          drawn.set(this.canvas, {frames: [], words: []});
          return clearRect.apply(this, box); };
        CanvasRenderingContext2D.prototype.strokeRect = function (...box) {
          drawn.get(this.canvas)?.frames.push(box);
          return strokeRect.apply(this, box); };
        CanvasRenderingContext2D.prototype.fillText = function (text, ...place) {
          drawn.get(this.canvas)?.words.push(text);
          return fillText.call(this, text, ...place); };""")
    yield page
    page.close()
    assert said == []


def opened(page, view, tmp_path, curves=True):
    view.save(tmp_path / "view.html")
    page.goto((tmp_path / "view.html").as_uri())
    page.add_style_tag(content="body { margin: 0; max-width: none; padding: 0 }")
    awake(page)
    return anew(page) if curves else None


def anew(page):
    """The frames of the panels and the text of one new picture."""
    page.evaluate("drawn.clear()")
    page.set_viewport_size({"width": 1827 - page.viewport_size["width"], "height": 647})
    ink(page, ".rk-curves")
    return page.evaluate("""() => {
      const pictures = [...drawn].filter(([canvas]) => canvas.isConnected);
      const curves = pictures.filter(([canvas]) => canvas.className === "rk-curves");
      return [curves.flatMap(([, picture]) => picture.frames),
              pictures.flatMap(([, picture]) => picture.words)]; }""")


# --- Room on the screen ---------------------------------------------------------------------------


def two_arms(motions):
    return animate([IRB140, IRB140], T, [motions, motions[::-1]], names=["A", "B"], **PLAIN)


def in_one_space(_, other=(0, 1)):
    return animate([IRB140] * 2, CLOCK, [TURNING] * 2, names=["A", "B"], bases=[[0, 0], other])


VIEWS = {
    "one arm": (lambda q: animate(IRB140, T, q, **PLAIN), 560),
    "two arms": (two_arms, 600),
    "one space": (in_one_space, 640),
    "one place": (lambda _: in_one_space(_, (0, 0)), 560),
    "motion explorer": (lambda _: motion_explorer(IRB140, START, VIA, GOAL), 560),
    "corner": (lambda _: motion_explorer(IRB140, START, VIA, GOAL, close_up=True), 560),
}


EXPLORERS = {
    "joints": lambda: joint_explorer(IRB140),
    "target of eight rows": lambda: target_explorer(IRB140),
    "target of two rows": lambda: target_explorer(WITH_ROWS),
    "zone of a SCARA": lambda: target_explorer(WITH_ROWS, zone=True),
    "three levers": lambda: target_explorer(three_lever((0.3, 0.2, 0.4))),
    "elbow": lambda: elbow_explorer(IRB140),
    "motor": motor_explorer,
    "singularity": test_singularity_explorer.view,
    "clearance": test_clearance_explorer.view,
    "paths": test_paths_explorer.view,
}


@pytest.mark.parametrize("view", EXPLORERS)
def test_explorer_fits_on_the_screen(page, tmp_path, view):
    opened(page, EXPLORERS[view](), tmp_path, curves=False)
    box = page.locator(".rk").bounding_box()
    assert box["width"] > 880 and 400 < box["height"] <= 560
    canvas = page.locator(".rk canvas").first
    assert canvas.bounding_box()["height"] >= 220
    assert len(canvas.evaluate("canvas => canvas.toDataURL()")) > 9000, "the picture is empty"


@pytest.mark.parametrize("view", VIEWS)
def test_view_fits_on_the_screen_with_a_large_panel(page, motions, tmp_path, view):
    make, height = VIEWS[view]
    frames, _ = opened(page, make(motions), tmp_path)
    box = page.locator(".rk").bounding_box()
    assert box["width"] > 880 and box["height"] <= height
    assert max(h for _, _, _, h in frames) >= 180


def test_notes_do_not_move_the_pictures(page, tmp_path):
    q = np.stack([HALVES, TURNING])  # the first motion exceeds a limit
    opened(page, animate(IRB140, CLOCK, q, slider=("x", [0, 1])), tmp_path)
    before = page.locator(".rk-scene").bounding_box()
    assert "q3 exceeds its limit" in page.locator(".rk-says").inner_text()
    page.get_by_label("x", exact=True).fill("1")
    assert page.locator(".rk-says").inner_text() == ""
    assert page.locator(".rk-scene").bounding_box() == before


@pytest.mark.parametrize("count", [1, 3, 4, 6])
def test_panels_share_the_height(page, count):
    """The large panel gets its full height if there is room, and no small panel is too low."""
    for room in (150, 210, 300, 480, 900):
        for large in range(count):
            shown = page.evaluate(
                "([code, ...given]) => new Function(code + 'return $curves')().heights(...given)",
                [script("player"), count, large, room],
            )
            heights = dict(shown)
            assert large in heights and list(heights) == sorted(heights)
            assert sum(heights.values()) + 22 * len(heights) == pytest.approx(room)
            assert heights[large] >= min(180, room - 22)
            assert all(h >= 34 for k, h in heights.items() if k != large)


# --- Large panels, faint curves and quantities ----------------------------------------------------


def test_reader_chooses_the_large_panel(page, motions, tmp_path):
    opened(page, animate(IRB140, T, motions, watch="a", **PLAIN), tmp_path)
    menu = page.get_by_label("large panel")
    assert menu.input_value() == "2"
    for large in range(3):
        menu.select_option(str(large))
        frames, words = anew(page)
        heights = [h for _, _, _, h in frames][-3:]  # those of the last picture, if there are two
        assert len(heights) == 3 and np.argmax(heights) == large
        assert {"angle, °", "speed, °/s", "acceleration, °/s²"} <= set(words)


def panels_of(page, player, value, choice=0):
    """The panels that the page makes for a motion, with their lines and marks."""
    return page.evaluate(
        """([code, data, value, choice]) => {
          const {$motions} = new Function(code + 'return {$motions}')();
          const {panels} = $motions.motionsOf(data).choose(value, choice);
          return panels.map(({label, axes, lines, near, marks}) => ({label, axes, near, marks,
            lines: lines.map(line => ({...line, gaps: [...line.gaps], values: [...line.values],
              opening: line.opening &&
                [[...line.opening.values], [...line.opening.gaps]]}))})); }""",
        [script("player"), player.data, value, choice],
    )


def test_unwatched_joints_are_faint_and_show_no_limits(page):
    player = animate(IRB140, CLOCK, HALVES, joints=[1, 2])
    for panel in panels_of(page, player, 0):
        assert [line["faint"] for line in panel["lines"]] == [j > 1 for j in range(6)]
        assert panel["near"] == []
    [position, *_] = panels_of(page, animate(IRB140, CLOCK, HALVES, joints=[3]), 0)
    assert position["near"] == [[2, 1]]


def test_scales_do_not_change_and_the_initial_curve_remains_visible(page, motions):
    player = animate(IRB140, T, motions, **PLAIN)
    first = panels_of(page, player, 0)
    assert all(line["opening"] is None for panel in first for line in panel["lines"])
    for value in range(1, len(FRACTIONS)):
        for panel, begun in zip(panels_of(page, player, value), first, strict=True):
            assert panel["axes"] == begun["axes"]
            for line, old in zip(panel["lines"], begun["lines"], strict=True):
                assert line["opening"] == [old["values"], old["gaps"]]
                assert old["values"] != line["values"]


def test_initial_curve_breaks_where_its_motion_breaks(page):
    torn = TURNING.copy()
    torn[300:, 3] += 1
    player = animate(IRB140, CLOCK, np.stack([torn, TURNING]), slider=("x", [0, 1]))
    for panel in panels_of(page, player, 1):
        for line in panel["lines"]:
            (gap,) = line["opening"][1]
            assert line["gaps"] == []
            assert player.data["times"][gap] < 3 <= player.data["times"][gap + 1]


def test_quantity_has_its_own_panel(page, motions, tmp_path):
    away = np.linalg.norm(IRB140.fk(motions).translation - VIA.translation, axis=-1) / mm
    player = animate(IRB140, T, motions, quantities={"distance to via, mm": away}, **PLAIN)
    [data] = player.data["quantities"]
    low, step, count, _ = data["scale"]
    assert low <= away.min() and away.max() <= low + step * (count - 1)
    [numbers] = data["values"]
    found = unpacked(numbers, 1, len(player.data["times"]))[..., 0]
    assert abs(found - away[:, kept(player)]).max() <= 0.51 * max(numbers["steps"])
    assert player.data["watch"]["panel"] == 3
    frames, words = opened(page, player, tmp_path)
    assert "distance to via, mm" in words and max(h for *_, h in frames) >= 180
    one = animate(IRB140, T, motions, quantities={"distance to via, mm": away[0]}, **PLAIN)
    for value in range(len(FRACTIONS)):  # the curve is the same for every value of the slider
        [line] = panels_of(page, one, value)[3]["lines"]
        assert np.allclose(line["values"], away[0, kept(one)], atol=0.5)


def test_player_that_watches_no_joint_shows_only_its_quantities(page, tmp_path):
    turned = np.abs(np.diff(HALVES, axis=0, prepend=HALVES[:1])).sum(axis=1).cumsum() / deg
    several = {"turned, °": [turned, turned / 2], "left, °": [turned[::-1], turned]}
    player = animate(
        [IRB140] * 2, CLOCK, [HALVES] * 2, names=["A", "B"], joints=[], quantities=several
    )
    frames, words = opened(page, player, tmp_path)
    assert len(frames) == 2 and {"turned, °", "left, °", "A", "B"} <= set(words)
    assert not {"q1", "angle, °", "speed, °/s"} & set(words), "curves of joints"
    menu = page.get_by_label("large panel")
    assert menu.locator("option").all_inner_texts() == ["turned, °", "left, °"]
    large = frames[0][3]
    assert large > frames[1][3] and menu.input_value() == "0"
    menu.select_option("1")
    frames, _ = anew(page)
    assert frames[0][3] < frames[1][3] == large
    with pytest.raises(ValueError, match=r"watch: wanted one of \('d',\), got 'q'"):
        animate(IRB140, CLOCK, HALVES, joints=[], watch="q", quantities={"d": turned})


# --- Limits, rows and marks -----------------------------------------------------------------------


def test_arm_shows_the_joints_that_exceed_a_limit(page, tmp_path):
    player = animate(IRB140, CLOCK, HALVES)
    opened(page, player, tmp_path)
    past = HALVES[:, 2] > 50 * deg
    assert 0 < past.sum() < len(past)
    [note] = player.data["arms"][0]["notes"]["0"]
    assert f"from {CLOCK[past.argmax()]:.2f} to 6.00 s" in note
    seen = []
    for tick in range(0, 401, 20):
        page.get_by_label("time", exact=True).fill(str(tick))
        _, words = anew(page)
        seen.append("q3 past its limit" in words)
        assert not any("past its limit" in word and word[:2] != "q3" for word in words)
    moments = np.interp(np.linspace(0, 6, 21), CLOCK, HALVES[:, 2])
    assert seen == (moments > 50 * deg).tolist()


@pytest.mark.parametrize("arm", [IRB140, PUMA560], ids=lambda arm: arm.name)
def test_row_of_every_posture_is_named(arm):
    """The motion goes through all rows of a pose, one after the other."""
    pose = arm.fk([0.3, -0.4, 0.5, 0.6, 0.7, 0.8])
    rows = arm.ik(pose)
    q = np.repeat(rows, 10, axis=0)
    t = 0.1 * np.arange(len(q))
    player = animate(arm, t, q)
    said, samples = player.data["arms"][0]["rows"], kept(player, t)
    signs = [" ".join(f"{flag:+d}" for flag in flags) for flags in arm.branches]
    wanted = [
        [int((samples >= 10 * k).argmax()), f"row {k}: {sign}".replace("-", "−")]
        for k, sign in enumerate(signs)
    ]
    assert [list(map(list, motion)) for motion in said] == [wanted]


def test_row_stays_the_same_through_a_singularity_and_is_missing_without_an_inverse():
    """Joint 5 crosses zero at sample 50: two rows coincide there, and the wrist's flag changes."""
    q = ptp([0.2, 0.1, 0.3, 0, -0.5, 0], [0.2, 0.1, 0.3, 0, 0.5, 0], np.linspace(0, 1, 101))
    [runs] = animate(IRB140, np.linspace(0, 1, 101), q).data["arms"][0]["rows"]
    assert [words[:5] for _, words in runs] == ["row 1", "row 0"]
    assert runs[0][0] == 0 and runs[1][0] in (50, 51)
    swing = np.outer(np.sin(np.linspace(0, 2 * np.pi, 101)), [0, 0, 0, 0.1, 0.4, 0])
    for q in (swing, -swing):
        [runs] = animate(IRB140, np.linspace(0, 1, 101), q).data["arms"][0]["rows"]
        names = [words for _, words in runs]
        assert names[0] == names[-1] == "rows 0, 1: +1 +1 ±1", "no sign at the ends is determined"
        assert {words[:5] for words in names[1:-1]} == {"row 0", "row 1"} and len(names) == 4
    levers = animate(three_lever(1.0), CLOCK, np.full((601, 3), 1.0) + CLOCK[:, None] / 20)
    assert levers.data["arms"][0]["rows"] is None
    plain = animate(SCARA, CLOCK, np.full((601, 4), 0.1) + CLOCK[:, None] / 100)
    assert plain.data["arms"][0]["rows"] is None


def test_row_is_shown_below_the_arm(page, tmp_path):
    q = follow(IRB140, IRB140.ik(lin(START, GOAL, np.linspace(0, 1, 101))), ROW)
    _, words = opened(page, animate(IRB140, np.linspace(0, 2, 101), q), tmp_path)
    signs = " ".join(f"{flag:+d}" for flag in IRB140.branches[ROW]).replace("-", "−")
    assert f"row {ROW}: {signs}" in words


def test_each_mark_names_its_arm(page):
    """Two arms share each panel: the label of a jump names its arm, and a limit is shown once."""
    jump = TURNING.copy()
    jump[300:, 3] += 1
    player = animate([IRB140] * 2, CLOCK, [TURNING, jump], names=["smooth", "torn"])
    panels = panels_of(page, player, 0)
    for panel in panels:
        assert [line["arm"] for line in panel["lines"]] == [0] * 6 + [1] * 6
        assert [line["joint"] for line in panel["lines"]] == [*range(6)] * 2
    widths = page.evaluate(
        "code => [0, 1, 2].map(new Function(code + 'return $panel')().strength)", script("player")
    )
    assert widths[0] > 1.5 * widths[1] > 2.5 * widths[2] > 0, "arms cannot be told apart"
    words = [mark["text"] for panel in panels for mark in panel["marks"] if mark["text"]]
    assert words and all(text.startswith("torn: ") for text in words)
    both = animate([IRB140] * 2, CLOCK, [HALVES, HALVES], names=["A", "B"])
    assert panels_of(page, both, 0)[0]["near"] == [[2, 1]]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"watch": "speed"}, r"watch: wanted one of \('q', 'v', 'a'\), got 'speed'"),
        ({"watch": 1}, "watch: wanted one of"),
        ({"joints": [0]}, "joints: wanted a whole number from 1 to 6"),
        ({"joints": 3}, "joints: wanted numbers"),
        ({"joints": []}, "joints: an empty list is only for a player with quantities"),
        ({"quantities": [1, 2]}, "quantities: wanted a dict"),
        ({"quantities": {"d": np.zeros(5)}}, r"quantity d: wanted shape \(601,\)"),
        ({"quantities": {3: np.zeros(601)}}, "quantities: wanted a string"),
    ],
)
def test_invalid_arguments_are_refused(given, words):
    with pytest.raises(ValueError, match=words):
        animate(IRB140, CLOCK, TURNING, **given)
    with pytest.raises(ValueError, match="quantity d: wanted a list with one array for each of 2"):
        animate([IRB140] * 2, CLOCK, [TURNING] * 2, quantities={"d": np.zeros(601)})
