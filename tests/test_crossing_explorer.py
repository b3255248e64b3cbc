"""The crossing explorer in a real browser: the elbows, the formula and its jump match independent
calculations, and the sentences match the picture.
"""

import re

import numpy as np
import pytest
import test_explorers
from axe_playwright_python.sync_playwright import Axe
from canvas_words import COVERED, LINES, RECORD, faults

from robokin import SCARA, three_lever, two_link
from robokin.show import crossing_explorer
from robokin.show.joiner import script

context, opened = test_explorers.context, test_explorers.opened  # fixtures
NONE = ["\N{EN DASH}"] * 2
FIRST = crossing_explorer(two_link(1, 1), (0.6, 0.8), divisor="x3")


def crossed(base, tip, l1, l2):
    """Return the right and the left elbow (2, 2): the intersections of two circles, from components
    along and across the line from the base to the tip. Source: document 002, (1); lab 12.
    """
    way = np.subtract(tip, base)
    d2 = way @ way
    a = (d2 + l1**2 - l2**2) / (2 * d2)
    h = np.sqrt(l1**2 / d2 - a**2)
    return base + a * way + h * np.outer([1, -1], [way[1], -way[0]])


# --- Numbers --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "base, l1, l2", [((0, 0), 1, 1), ((0.2, -0.1), 1, 0.7), ((0, 0), 0.4, 0.9)]
)
def test_page_elbows_are_the_intersections_of_two_circles(context, base, l1, l2):
    """Compare 1000 tips, some of which are out of reach. With the plus sign, the formula returns
    the elbow that has the greater remaining coordinate.
    """
    arm, rng = two_link(l1, l2, base), np.random.default_rng(12)
    tips = base + (l1 + l2) * rng.uniform(-1.05, 1.05, (1000, 2))
    page = context.new_page()
    page.add_script_tag(content=f"{script('crossing')}\nwindow.at = $crossing;")
    view = crossing_explorer(arm, np.add(base, (0, 0.9 * (l1 + l2))))
    found = page.evaluate(
        "([arm, tips]) => tips.map(([x, y]) => [at.elbowsAt(arm, [x, y, 0]), "
        "at.byRoot(arm, [x, y, 0], 0), at.byRoot(arm, [x, y, 0], 1)])",
        [view.data["arm"], tips.tolist()],
    )
    tracks = page.evaluate(
        "([arm, tips]) => tips.map(([x, y]) => [0, 1].map(k => at.tracksAt(arm, [x, y, 0], k)))",
        [view.data["arm"], tips[:40].tolist()],
    )
    page.close()
    reached = 0
    for tip, (elbows, *formulas) in zip(tips, found, strict=True):
        d = np.hypot(*(tip - base))
        if not abs(l1 - l2) <= d <= l1 + l2:
            assert elbows == []
            continue
        reached += 1
        wanted = crossed(base, tip, l1, l2)
        assert np.array(elbows)[:, :2] == pytest.approx(wanted, abs=1e-7)
        for k, formula in enumerate(formulas):
            kept = wanted[wanted[:, 1 - k].argmax()]
            assert formula[:2] == pytest.approx(kept, abs=1e-6)
    assert 300 < reached < 900
    count = 0
    for tip, each in zip(tips, tracks, strict=False):
        for k, parts in enumerate(each):
            for part in parts:
                count += len(part["u"])
                for u, right, left in zip(part["u"], part["right"], part["left"], strict=True):
                    moved = np.array(tip)
                    moved[k] = base[k] + u
                    radius = np.hypot(*(moved - base))
                    if abs(l1 - l2) + 1e-6 < radius < l1 + l2 - 1e-6:
                        both = crossed(base, moved, l1, l2)
                        assert [right[:2], left[:2]] == pytest.approx(both, abs=1e-6)
                        kept = both[part["which"]]
                        if abs(u) > 1e-6:
                            assert kept[1 - k] == pytest.approx(both[:, 1 - k].max(), abs=1e-6)
    assert count > 4000


# --- View -----------------------------------------------------------------------------------------


def moved(shown, x, y):
    shown.type("x3", x)
    shown.type("y3", y)
    return shown.look()


def numbers(seen):
    return [[float(cell) for cell in row[1:]] for row in seen.rows]


def test_dragging_the_tip_moves_both_elbows(opened):
    shown, stops = opened(FIRST), []
    x, y = shown.look().handles["tip"]["at"]

    def each(seen, stop):
        tip = [float(t) for t in re.findall(r"-?[\d.]+", seen.handles["tip"]["name"])]
        right, left, formula = numbers(seen)
        assert [right, left] == pytest.approx(crossed((0, 0), tip, 1, 1), abs=6e-4)
        upper = max(right, left, key=lambda elbow: elbow[1])
        assert formula == upper
        assert np.hypot(*np.subtract(seen.handles["tip"]["at"], stop)) < 2
        stops.append((*tip, *seen.pixels))

    start = shown.look()
    shown.drag("tip", (x + 30, y + 20), (x - 100, y + 40), (x - 90, y + 160), each=each)
    assert len(set(stops)) == 3
    shown.press("tip", "Home")
    assert shown.look().rows == start.rows and shown.look().pixels == start.pixels
    box = shown.rk.locator(".rk-curves").bounding_box()
    shown.page.mouse.click(box["x"] + 0.3 * box["width"], box["y"] + box["height"] / 2)
    seen = shown.look()
    assert -1.1 < seen.boxes["x3"] < -0.5 and seen.boxes["y3"] == start.boxes["y3"]


def test_keys_move_the_tip_and_the_code_gives_the_same_elbows(opened):
    shown = opened(FIRST, two_link(1, 1))
    shown.press("tip", "ArrowLeft", "Shift+ArrowUp", "ArrowDown")
    seen = shown.look()
    assert seen.boxes == {"x3": 0.59, "y3": 0.89}
    assert "np.array([0.59, 0.89])" in seen.code
    assert numbers(seen)[:2] == pytest.approx(crossed((0, 0), (0.59, 0.89), 1, 1), abs=6e-4)
    shown.slide("x3", -9)
    shown.type("y3", 9)
    assert shown.look().boxes == {"x3": -2.1, "y3": 2.1}, "the tip left the picture"


def test_formula_switches_elbows_when_the_tip_crosses_the_line(opened):
    shown, told = opened(FIRST), {}
    for y in (-1.2, 0.4, 1.73):
        jump = re.compile(r"it jumps by (\d\.\d+) m at x3 = 0\.")
        for x in (-0.01, 0.01):
            seen = moved(shown, x, y)
            told[x > 0, y] = re.search(r"returns the (\w+) elbow", seen.says)[1]
            assert float(jump.search(seen.says)[1]) == pytest.approx(
                np.hypot(*np.diff(crossed((0, 0), (0, y), 1, 1), axis=0)[0]), abs=6e-4
            )
            assert f"{told[x > 0, y]} elbow: formula" in seen.words[0]
        seen = moved(shown, 0, y)
        assert "divides 0 by 0 and returns no number" in seen.says and seen.rows[2][1:] == NONE
    # above the base, the upper elbow is the left one where the tip is on the right
    assert told == {(r, y): ["right", "left"][r] for r in (False, True) for y in (-1.2, 0.4, 1.73)}
    other = opened(crossing_explorer(two_link(1, 1), (-0.8, 0.5), divisor="y3"))
    sides = [re.search(r"the (\w+) elbow", moved(other, -0.8, y).says)[1] for y in (0.01, -0.01)]
    assert sides == ["right", "left"] and "at y3 = 0." in other.look().says


def test_singular_and_unreachable_tips_are_explained(opened):
    shown = opened(crossing_explorer(two_link(1, 0.7), (-0.9, 0.2)))
    assert "formula" not in shown.rk.inner_text() and shown.look().says == ""
    assert "the two elbows meet at 4 places" in shown.look().scene
    for (x, y), says in {
        (1.7, 0): "The arm is stretched: both elbows coincide.",
        (0, -0.3): "The arm is folded: both elbows coincide.",
        (1.5, 1.5): "Out of reach: the tip is 421.3 mm beyond the reach of the arm.",
        (0.1, 0): "Out of reach: the tip is 200.0 mm too close to the base.",
    }.items():
        seen = moved(shown, x, y)
        assert seen.says == says
        assert seen.rows[0][1:] == seen.rows[1][1:]
        assert (seen.rows[0][1:] == NONE) == says.startswith("Out")
    one = "Along the dotted line, it does not jump: the two elbows are one at x3 = 0."
    for l2, x, rim, inside in ((0.4, 0.9, 0.6, 0.61), (0.7, 0.9, -0.3, -0.31), (0.7, 0, 1.7, 1.69)):
        shown = opened(crossing_explorer(two_link(1, l2), (0.9, 0.6), divisor="x3"))
        assert moved(shown, x, rim).says.endswith(one), rim
        assert re.search(r"it jumps by 0\.[1-9]\d* m at x3 = 0\.$", moved(shown, x, inside).says)
    gap = opened(crossing_explorer(two_link(1, 0.7), (-0.9, 0.2), divisor="x3")).look().says
    assert gap.endswith(
        "The dotted line does not cross x3 = 0 within reach, so the formula does not jump."
    )


@pytest.mark.parametrize("divisor, kept", [("x3", "y2"), ("y3", "x2")])
@pytest.mark.parametrize("base", [(0, 0), (0.2, -0.1)])
def test_formula_keeps_its_elbow_on_a_line_through_the_base(opened, base, divisor, kept):
    """With equal links, the two elbows beside the base are two link lengths apart. The formula
    keeps one of them on such a line, and on every other line it jumps from one to the other.
    """
    k, value = ("x3", "y3").index(divisor), np.array(base)[("x3", "y3").index(divisor)]
    beside = np.add(base, [(-1e-6, 0), (1e-6, 0)] if k == 0 else [(0, -1e-6), (0, 1e-6)])
    pairs = [crossed(base, tip, 1, 1) for tip in beside]
    assert all(np.hypot(*(one - two)) > 1.99 for one, two in pairs)
    formula = [pair[pair[:, 1 - k].argmax()] for pair in pairs]  # with the plus sign of the root
    assert formula[0] == pytest.approx(formula[1], abs=1e-5)
    start = np.add(base, (0.9, 0.6))
    shown = opened(crossing_explorer(two_link(1, 1, base), start, divisor=divisor))
    line = f"{divisor} = {value:g}".replace("-", "\N{MINUS SIGN}")
    keeps = (
        f"Along the dotted line, it does not jump at {line}: on both sides, the formula returns "
        f"the elbow with the greater {kept}."
    )
    tip = np.add(base, (0.5, 0) if k == 0 else (0, 0.5))
    seen = moved(shown, *tip)
    assert re.search(r"^The formula returns the (right|left) elbow\. ", seen.says)
    assert seen.says.endswith(keeps) and "are one" not in seen.says
    beside_line = moved(shown, *np.add(tip, (0, 0.01) if k == 0 else (0.01, 0))).says
    assert beside_line.endswith(f"it jumps by 2.000 m at {line}.")
    says = moved(shown, *base).says
    assert says.startswith(
        "The tip is on the base: the arm is folded, and every point of the circle around the base "
        "is an elbow. The view shows one of them."
    )
    assert "coincide" not in says and says.endswith(keeps)


def test_tip_on_the_base_has_no_two_elbows(opened):
    shown = opened(crossing_explorer(two_link(1, 1), (0.5, 0.5)))
    seen = moved(shown, 0, 0)
    assert seen.says.startswith("The tip is on the base") and "coincide" not in seen.says
    assert "ight elbow at" not in seen.scene and "both elbows" not in seen.words[0]
    assert "one of the elbows" in seen.words[0]


def test_legend_explains_rings_and_red_dashes():
    assert "A ring marks a place where the two elbows meet." in FIRST.data["meant"]
    assert "The red dashes go from one end of the jump to the other." in FIRST.data["meant"]
    assert "red" not in crossing_explorer(two_link(1, 1), (0.6, 0.8)).data["meant"]


def test_accessible_name_describes_the_picture(opened):
    seen = opened(FIRST).look()
    assert seen.scene.startswith(repr(FIRST)) and seen.scene.endswith(seen.says)
    right, left = crossed((0, 0), (0.6, 0.8), 1, 1)
    numbers = [
        float(x.replace("\N{MINUS SIGN}", "-"))
        for x in re.findall(r"\N{MINUS SIGN}?\d\.\d+", repr(FIRST))
    ]
    assert numbers == pytest.approx([0.6, 0.8, *right, *left], abs=6e-4)
    assert FIRST.still.alt == FIRST.data["alt"]


PLACES = (
    (0.6, 0.8),
    (0, 0.8),
    (-0.3, 0.1),
    (0, 0),
    (1.2, 1.6),
    (2.1, -2.1),
    (-1.9, 0),
    (0.1, -1.95),
)


@pytest.mark.parametrize("width, theme", [(914, "light"), (390, "dark")])
def test_labels_are_readable_wherever_the_tip_is(browser, opened, width, theme):
    with browser.new_context(
        viewport={"width": width, "height": 800}, color_scheme=theme, has_touch=width < 400
    ) as small:
        small.add_init_script(test_explorers.WATCH + RECORD)
        shown = opened(FIRST, within=small)
        for place in PLACES:
            moved(shown, *place)
            assert faults(shown.page) == [], place
        assert shown.page.evaluate("document.documentElement.scrollWidth") <= width
        if width > 900:
            assert shown.rk.bounding_box()["height"] <= 560
        found = Axe().run(shown.page, context=".rk").response["violations"]
        assert [v["id"] for v in found if v["impact"] in ("serious", "critical")] == []
        shown.page.close()


@pytest.mark.parametrize("arm", [two_link(1, 1), two_link(1, 0.7)], ids=["equal", "unequal"])
@pytest.mark.parametrize("divisor", ["x3", "y3"])
@pytest.mark.parametrize("width", [390, 914])
def test_names_beside_the_curves_cover_neither_a_curve_nor_a_point(
    browser, opened, width, divisor, arm
):
    with browser.new_context(viewport={"width": width, "height": 800}) as small:
        shown = opened(crossing_explorer(arm, (0.9, 0.6), divisor=divisor), within=small)
        shown.page.evaluate(COVERED, ["^(right|left) elbow$", ["accent", "near", "alarm"]])
        for place in ((0.9, 0.6), (0.8, 0.6), (-0.3, 0.4), (0.2, -1.4)):
            shown.page.evaluate("covered.length = 0")
            moved(shown, *place)
            covered = shown.page.evaluate("covered")
            assert {text for text, _ in covered} == {"right elbow", "left elbow"}
            assert [each for each in covered if each[1] > 12] == [], place
        shown.page.close()


@pytest.mark.parametrize(
    "l1, l2, base, radii",
    [(1, 0.7, (0, 0), [1.7, 0.3]), (0.45, 0.65, (0.15, -0.1), [1.1, 0.2]), (1, 1, (0, 0), [2])],
)
def test_both_rims_of_the_reach_are_drawn_and_labelled(browser, opened, l1, l2, base, radii):
    view = crossing_explorer(two_link(l1, l2, base), np.add(base, (0, 0.8)))
    with browser.new_context(viewport={"width": 914, "height": 800}) as small:
        small.add_init_script(f"{RECORD}\n{LINES}")
        shown = opened(view, within=small)
        shown.look()
        words = shown.page.evaluate("canvasWords().flatMap(each => each.words.map(w => w.text))")
        lines = shown.page.evaluate(
            "[...document.querySelectorAll('canvas')].flatMap(each => each.lines ?? [])"
        )
        shown.page.close()
    assert [text for text in words if re.fullmatch(r"\S+ m", text)] == [f"{r} m" for r in radii]
    rims = [np.array(line["points"]) for line in lines if len(line["points"]) == 121]
    wide = [float(np.ptp(rim[:, 0])) for rim in rims if np.allclose(rim[0], rim[-1])]
    assert np.array(wide) / wide[0] == pytest.approx(np.array(radii) / radii[0])


def test_the_red_dashes_have_the_length_that_the_sentence_states(browser, opened):
    with browser.new_context(viewport={"width": 914, "height": 800}) as small:
        small.add_init_script(RECORD)
        shown = opened(FIRST, within=small)
        for y in (0.8, -1.73, 1.99, 0):
            says = moved(shown, 0.6 if abs(y) < 1.9 else 0.1, y).says
            words = shown.page.evaluate(
                "canvasWords().flatMap(each => each.words.map(w => w.text))"
            )
            told = re.findall(r"jumps by (\S+) m", says)
            assert [float(text[:-2]) for text in words if re.fullmatch(r"\S+ m", text)][
                : len(told)
            ] == [float(each) for each in told]
            assert bool(told) == (y != 0) and words.count("2 m") == 1
        shown.page.close()


# --- Arguments ------------------------------------------------------------------------------------


def test_small_arm_is_shown_in_millimetres(opened):
    shown = opened(crossing_explorer(two_link(0.2, 0.1, (0.05, 0)), (0.2, 0.1), divisor="x3"))
    right, left, _ = numbers(shown.look())
    assert [right, left] == pytest.approx(1e3 * crossed((0.05, 0), (0.2, 0.1), 0.2, 0.1), abs=0.06)
    assert "at x3 = 50." in shown.look().says


@pytest.mark.parametrize("arm", [SCARA, three_lever(0.3), "Two links"])
def test_arm_that_is_not_two_links_is_refused(arm):
    with pytest.raises(TypeError, match="arm: wanted"):
        crossing_explorer(arm, (0.2, 0.2))


@pytest.mark.parametrize(
    "change, says",
    [
        ({"tip": (3, 0)}, "tip: wanted a point in reach, got"),
        ({"tip": [(0.5, 0.5)]}, "tip: wanted one point"),
        ({"divisor": "x2"}, "divisor: wanted"),
    ],
)
def test_invalid_arguments_are_refused(change, says):
    with pytest.raises(ValueError, match=says):
        crossing_explorer(**{"arm": two_link(1, 1), "tip": (0.5, 0.5), **change})
