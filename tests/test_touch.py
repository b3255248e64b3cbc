"""Narrow screens and touch screens: sliders, handles and the size of controls, in a real browser
with real touch events.
"""

from dataclasses import replace

import numpy as np
import pytest
import test_clearance_explorer
import test_explorers
import test_live
import test_paths_explorer
import test_predictions
import test_singularity_explorer
import test_tour_explorer
from test_browser import NEXT_FRAME
from test_explorers import GOAL, IRB140, LOADER, SCARA, START, VIA

from robokin import three_lever, two_link
from robokin.course.predictions import Asked
from robokin.show import (
    animate,
    crossing_explorer,
    elbow_explorer,
    joint_explorer,
    motion_explorer,
    motor_explorer,
    movement_explorer,
    plan_explorer,
    rotation_explorer,
    target_explorer,
    tour_explorer,
)

context, opened = test_explorers.context, test_explorers.opened  # fixtures
T = np.linspace(0, 2, 41)
TURN = T[:, None] * np.array([0.5, 0.3, -0.4, 1, 1, 1])


def player():
    motions = [TURN, TURN / 2, TURN / 3]
    return animate(IRB140, T, motions, slider=("part", [1, 2, 3]), title="A turn of every joint")


def question():
    return Asked("made.p1", replace(test_predictions.words(), view=player), None)


EXPLORERS = {
    "joint": lambda: joint_explorer(IRB140, singular=True),
    "target": lambda: target_explorer(IRB140),
    "motion": lambda: motion_explorer(IRB140, START, VIA, GOAL),
}
VIEWS = EXPLORERS | {
    "corner": lambda: motion_explorer(IRB140, START, VIA, GOAL, close_up=True),
    "player": player,
    "zone": lambda: target_explorer(SCARA, zone=True),
    "levers": lambda: movement_explorer(three_lever(0.3), [1.5, 1.5, 2], (0.495, 0.315)),
    "elbow": lambda: elbow_explorer(IRB140),
    "crossing": lambda: crossing_explorer(two_link(1, 1), (0.6, 0.8), divisor="x3"),
    "motor": motor_explorer,
    "plan": lambda: plan_explorer(test_live.ARM, test_live.START, (1.9, 0.3), (1.2, 1.3)),
    "tour": lambda: tour_explorer(test_tour_explorer.CIRCLE),
    "rotation": lambda: rotation_explorer(1.2, (0.6, 0, 0.8), (0.1, 0, 0)),
    "singularity": test_singularity_explorer.view,
    "clearance": test_clearance_explorer.view,
    "paths": test_paths_explorer.view,
    "question": question,
}
each_view = pytest.mark.parametrize("kind", VIEWS)


class Finger:
    """A finger on a page, which sends the events of a touch screen."""

    def __init__(self, page):
        self.page, self.session = page, page.context.new_cdp_session(page)

    def send(self, what, *at):
        points = [{"x": at[0], "y": at[1]}] if at else []
        self.session.send("Input.dispatchTouchEvent", {"type": what, "touchPoints": points})

    def swipe(self, x, y, dx, dy, count=8):
        """Touch a place, move by (dx, dy) in equal steps, and lift the finger."""
        self.send("touchStart", x, y)
        for i in range(1, count + 1):
            self.send("touchMove", x + dx * i / count, y + dy * i / count)
        self.send("touchEnd")
        self.page.evaluate(NEXT_FRAME)

    def tap(self, x, y):
        self.swipe(x, y, 0, 0, 0)


@pytest.fixture
def phone(browser):
    context = browser.new_context(
        viewport={"width": 390, "height": 700}, has_touch=True, is_mobile=True
    )
    context.add_init_script(test_explorers.WATCH)
    yield context
    context.close()


def answered(page):
    """Answer the question of a page, if there is one, and wait for the view behind it."""
    if page.locator(".rk-ask").count():
        page.locator(".rk-option").last.tap()
        page.get_by_role("button", name="This is my guess").tap()
        page.locator(".rk-player").wait_for()


# --- Sliders --------------------------------------------------------------------------------------

# Adds space for scrolling, and records the values that the sliders report.
LISTEN = """() => {
  document.body.style.padding = "1000px 0";
  window.told = [];
  document.addEventListener("input", event => told.push(+event.target.value));
}"""


def sliders(page):
    """The sliders that can be moved; the sliders of a view without its kernel cannot."""
    page.evaluate(LISTEN)
    return [
        slider
        for slider in page.locator("input[type=range]:visible").all()
        if not slider.evaluate("e => e.closest('[inert]') !== null")
    ]


# Waits until the page has stopped after a swipe, and scrolls to an element.
REST = """async e => {
  for (let still = 0, last = -1; still < 5; last = scrollY) {
    await new Promise(requestAnimationFrame);
    still = scrollY === last ? still + 1 : 0;
  }
  e.scrollIntoView({block: "center"});
  told.length = 0;
}"""


def middle(slider, share=0.5):
    """A place on a slider, after scrolling the slider to the middle of the screen."""
    slider.evaluate(REST)
    box = slider.bounding_box()
    return box["x"] + share * box["width"], box["y"] + box["height"] / 2


@each_view
def test_vertical_swipe_on_a_slider_scrolls_the_page_and_a_sideways_drag_moves_the_slider(
    opened, phone, kind
):
    page = opened(VIEWS[kind](), within=phone).page
    answered(page)
    finger, found = Finger(page), sliders(page)
    assert found
    values = "[...document.querySelectorAll('input[type=range]')].map(e => e.value)"
    for k, slider in enumerate(found):
        share, dx, dy = ((0.9, 0, -160), (0.1, 30, -150), (0.9, -20, 120))[k % 3]
        x, y = middle(slider, share)
        before, top = page.evaluate(values), page.evaluate("scrollY")
        finger.swipe(x, y, dx, dy)
        page.wait_for_function("top => Math.abs(scrollY - top) > 50", arg=top)
        assert page.evaluate("told") == [], "a swipe moves the slider"
        assert page.evaluate(values) == before
        x, y = middle(slider)
        start, top = float(slider.input_value()), page.evaluate("scrollY")
        low, high = (float(slider.get_attribute(name)) for name in ("min", "max"))
        way = 1 if start < (low + high) / 2 else -1
        finger.swipe(x, y, 120 * way, 10)
        end = float(slider.input_value())
        assert way * (end - start) > 0, "a sideways drag does not move the slider"
        assert page.evaluate("scrollY") == top
        told = page.evaluate("told")
        assert told[-1] == end and (np.diff([start, *told]) * way > 0).all(), "the slider jumps"


def test_finger_moves_a_position_in_fine_steps(opened, phone):
    for make, names, unit in (
        (lambda: target_explorer(IRB140), ("x", "y", "z"), 1),
        (lambda: target_explorer(SCARA), ("x", "y", "z"), 1),
        (lambda: motion_explorer(IRB140, START, VIA, GOAL), ("via x", "via y", "via z"), 1),
        (lambda: target_explorer(LOADER), ("x", "y", "z"), 1e-3),  # in metres
        (lambda: target_explorer(three_lever(0.3)), ("x", "y"), 1),
    ):
        shown = opened(make(), within=phone)
        finger = Finger(shown.page)
        sliders(shown.page)
        for name in names:
            slider = shown.rk.locator(f"input[type=range][aria-label^='{name},']")
            x, y = middle(slider)
            finger.swipe(x, y, -60, 0, 60)
            told = np.array(shown.page.evaluate("told"))
            assert len(told) > 20, "the drag reports too few values"
            assert 0 < np.ptp(told) <= 5 * unit * 60, name
            assert abs(np.diff(told)).max() <= 5.001 * unit, (
                "the value changes by more than 5 mm per pixel"
            )


def test_tap_mouse_and_keyboard_move_a_slider_as_they_move_a_plain_one(opened, phone):
    """The reference is a slider that the page's scripts do not control."""
    page = opened(joint_explorer(IRB140), within=phone).page
    ours = sliders(page)[0]
    page.evaluate(
        """() => {
          const ours = document.querySelector("input[type=range]"), plain = ours.cloneNode();
          plain.id = "plain";
          ours.after(plain);
          plain.value = ours.value;
          ours.parentElement.style.gridTemplateColumns = "1fr 120px 120px";
        }"""
    )
    plain = page.locator("#plain")
    finger = Finger(page)
    for slider in (ours, plain):
        x, y = middle(slider, 0.8)
        finger.tap(x, y)
    assert ours.input_value() == plain.input_value() and float(ours.input_value()) > 90
    for slider in (ours, plain):
        slider.press("ArrowLeft")
        slider.press("ArrowLeft")
    assert ours.input_value() == plain.input_value()
    x, y = middle(ours, 0.3)
    finger.swipe(x, y, 60, 0)
    for slider in (ours, plain):
        x, y = middle(slider, 0.3)
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 30, y + 40, steps=3)
        page.mouse.up()
    assert ours.input_value() == plain.input_value()


# --- Handles --------------------------------------------------------------------------------------

BOXES = """rk => {
  const box = e => {
    const r = e.getBoundingClientRect();
    return [r.left, r.top, r.right, r.bottom];
  };
  const seen = [...rk.querySelectorAll(".rk-handle")].filter(e => e.checkVisibility());
  return [box(rk.querySelector(".rk-scene")),
    Object.fromEntries(seen.map(e => [e.dataset.handle, box(e)]))];
}"""


@pytest.mark.parametrize("kind", EXPLORERS)
def test_a_switch_chooses_the_handles_where_there_is_no_room_for_all(opened, phone, kind):
    wide = opened(EXPLORERS[kind](), IRB140)
    every = set(wide.look().handles)
    assert len(every) > 5 and not wide.rk.locator(".rk-chooser").is_visible()
    shown = opened(EXPLORERS[kind](), IRB140, within=phone)
    assert len(shown.look().handles) <= 4, "too many handles are shown, so they overlap"
    names = shown.rk.locator(".rk-chooser button")
    seen = []
    for name in names.all():
        name.tap()
        handles = set(shown.look().handles)
        assert 2 < len(handles) <= 4 and name.get_attribute("aria-pressed") == "true"
        assert shown.rk.locator(".rk-chooser [aria-pressed=true]").count() == 1
        one = sorted(handles)[0]
        before = shown.look()
        shown.press(one, "ArrowRight")
        assert shown.look().code != before.code
        seen += handles
    assert sorted(seen) == sorted(every), "a handle is never shown, or shown twice"
    shown.page.set_viewport_size({"width": 1280, "height": 700})
    assert set(shown.look().handles) == every


@pytest.mark.parametrize("touch", [True, False])
def test_paper_has_a_small_number_for_every_ring(opened, phone, context, touch):
    """Paper is narrow, but it has no switch and no fingers."""
    shown = opened(joint_explorer(IRB140), within=phone if touch else context)
    shown.look()
    shown.page.evaluate("""() => {
      window.rings = [];
      const {stroke} = CanvasRenderingContext2D.prototype;
      CanvasRenderingContext2D.prototype.stroke = function (...all) {
        if (Math.abs(this.lineWidth - 1.6) < 0.01 && /rgba|#.{8}/.test(this.strokeStyle))
          rings.push(this.strokeStyle);  // a ring
        return stroke.apply(this, all);
      };
    }""")
    shown.page.set_viewport_size({"width": 640, "height": 900})
    shown.look()
    shown.page.evaluate("rings.length = 0")
    shown.page.emulate_media(media="print")
    shown.look()
    _, boxes = shown.rk.evaluate(BOXES)
    assert sorted(boxes) == [f"q{j}" for j in range(1, 7)]
    sizes = [[x1 - x0, y1 - y0] for x0, y0, x1, y1 in boxes.values()]
    assert np.array(sizes) == pytest.approx(26, abs=0.01)
    assert len(set(shown.page.evaluate("rings"))) >= 6


def test_a_few_handles_need_no_switch(opened, phone):
    for make, count in ((lambda: joint_explorer(SCARA), 4), (lambda: target_explorer(LOADER), 4)):
        shown = opened(make(), within=phone)
        assert len(shown.look().handles) == count
        assert not shown.rk.locator(".rk-chooser").is_visible()


@pytest.mark.parametrize("touch", [True, False])
def test_handles_stay_inside_the_scene_and_can_be_grasped_there(opened, phone, context, touch):
    shown = opened(target_explorer(IRB140), IRB140, within=phone if touch else context)
    grasped, names = 0, ("x", "y", "z", "roll", "pitch", "yaw")
    for place, turns in (
        ((250, -50, 950), (-30, 15, -15)),
        ((200, 0, 1180), (0, 0, 0)),
        ((0, 0, 1180), (90, 0, 0)),
        ((600, 500, 100), (180, 0, 40)),
        ((-600, -600, 50), (180, 80, -90)),
    ):
        for name, value in zip(names, (*place, *turns), strict=True):
            shown.type(name, value)
        for group in shown.rk.locator(".rk-chooser button").all():
            if touch:
                group.tap()
            start = shown.look()
            (left, top, right, bottom), boxes = shown.rk.evaluate(BOXES)
            for name, box in boxes.items():
                assert left - 0.1 <= box[0] and box[2] <= right + 0.1, (name, place)
                assert top - 0.1 <= box[1] and box[3] <= bottom + 0.1, (name, place)
                edge = min(box[0] - left, box[1] - top, right - box[2], bottom - box[3])
                if edge > 0.1:
                    continue
                x, y = (box[0] + box[2]) / 2, (box[1] + box[3]) / 2
                dx, dy = (left + right) / 2 - x, (top + bottom) / 2 - y
                shown.handle(name).focus()
                if touch:
                    Finger(shown.page).swipe(x, y, 0.5 * dx, 0.5 * dy)
                else:
                    shown.page.mouse.move(x, y)
                    shown.page.mouse.down()
                    shown.page.mouse.move(x + 0.5 * dx, y + 0.5 * dy, steps=4)
                    shown.page.mouse.up()
                grasped += shown.look().code != start.code
                shown.press(name, "Home")
    assert grasped > 0, "no handle was at the edge"


def test_a_handle_draws_less_than_can_be_touched(opened, phone):
    """What stands below the outer 8 px of a handle stays visible."""
    for kind in ("joint", "tour", "plan", "levers"):
        shown = opened(VIEWS[kind](), within=phone)
        sizes = shown.rk.locator("[data-handle]:visible").evaluate_all(
            """all => all.map(handle => {
              const {width, borderStyle, borderTopWidth} = getComputedStyle(handle, "::before");
              const {background, borderWidth} = getComputedStyle(handle);
              const drawn = parseFloat(width) + 2 * parseFloat(borderTopWidth);
              return [handle.getBoundingClientRect().width, drawn, borderStyle, borderWidth,
                      background.startsWith("rgba(0, 0, 0, 0)")]; })"""
        )
        assert len(sizes) >= 2
        for touched, drawn, line, own, clear in sizes:
            assert touched >= 43.9 and 20 < drawn < 28.1
            assert line != "none" and own == "0px" and clear


# --- Sizes ----------------------------------------------------------------------------------------

# The controls smaller than 44 px. A label is part of its check box or radio button.
SMALL = """() => [...document.querySelectorAll(
    "button, select, input, textarea, summary, a[href], [role=button], [role=slider]")]
  .filter(e => e.checkVisibility())
  .map(e => [e, (/checkbox|radio/.test(e.type) && e.closest("label") || e).getBoundingClientRect()])
  .filter(([, {width, height}]) => Math.min(width, height) < 43.95)
  .map(([e, {width, height}]) => [e.outerHTML.slice(0, 90), width, height])"""


@pytest.mark.parametrize("width, touch", [(390, True), (390, False), (1100, True)])
@each_view
def test_every_control_is_large_enough_for_touch(browser, opened, kind, width, touch):
    context = browser.new_context(viewport={"width": width, "height": 800}, has_touch=touch)
    context.add_init_script(test_explorers.WATCH)
    page = opened(VIEWS[kind](), within=context).page
    page.evaluate(NEXT_FRAME)
    controls = page.locator(".rk :is(button, input, select, summary):visible").count()
    assert page.evaluate(SMALL) == [] and controls >= 4
    if kind == "question":
        page.locator(".rk-option").last.click()
        page.get_by_role("button", name="This is my guess").click()
        page.locator(".rk-player").wait_for()
    if kind in ("player", "question"):
        page.get_by_role("button", name="numbers").click()
    for hint in page.locator("summary:visible").all():
        hint.click()
    assert page.evaluate(SMALL) == []
    context.close()
