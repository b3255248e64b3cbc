"""The singularity explorer: its numbers match Python, and it explains the singular pose."""

import json
import re
from functools import cache

import numpy as np
import pytest
import test_explorers
import test_twin
from axe_playwright_python.sync_playwright import Axe

from robokin import IRB140, ITMO6R, SCARA, Transform, deg, follow, mm
from robokin.show import singularity_explorer

context, opened, twin = test_explorers.context, test_explorers.opened, test_twin.twin  # fixtures
HIT = np.array([0, 90, -90, 0, 0, 0]) * deg
ALONG, BESIDE = np.array([[0, 1, 1], [0, -1, 1]]) / np.sqrt(2)
PLACES = np.linspace(-100, 100, 2001)  # mm, in steps of 0.1


def view(**changes):
    return singularity_explorer(ITMO6R, HIT, (0, 1, 1), **changes)


def line(miss, places=PLACES):
    """Return the poses on the line; the arguments are in mm."""
    hit = ITMO6R.fk(HIT)
    shift = places[..., None] * ALONG + miss * BESIDE
    return Transform(hit.rotation, hit.translation + shift * mm)


@cache
def passing(miss):
    """Return the motion along the line, found with `ik` and `follow`, and the speed of joint 4 in
    rad/s from the Jacobian, which is NaN in the singular pose.
    """
    row = ITMO6R.branch(+1, -1, +1)
    q = follow(ITMO6R, ITMO6R.ik(line(miss)), row)
    free = abs(q[:, 4]) < 1e-6
    speed = np.full(len(q), np.nan)
    velocity = np.array([*100 * mm * ALONG, 0, 0, 0])
    speed[~free] = np.linalg.solve(ITMO6R.jacobian(q[~free]), velocity)[:, 3]
    return q, speed


# --- The numbers ----------------------------------------------------------------------------------


def test_motion_along_the_line_matches_python(twin):
    """Compare all places of six lines, more than a thousand."""
    misses = (0, 1, 2, 7, 16, 50)
    asked = [[place, miss] for miss in misses for place in range(-100, 101)]
    found = twin.page.evaluate(
        """async ([data, asked]) => {
          const {lineOf} = await import("/singularity_explorer.js");
          return asked.map(([place, miss]) => {
            const {q, speed} = lineOf(data, miss)(place);
            return [...q, speed];
          });
        }""",
        [view().data, asked],
    )
    wanted = np.concatenate([np.column_stack(passing(miss))[::10] for miss in misses])
    found, free = np.array(found), np.isnan(wanted[:, 6])
    assert len(wanted) > 1000 and free.sum() == 1
    test_twin.close(found[:, 6], wanted[:, 6], 1e-7)
    test_twin.close(found[~free], wanted[~free], 1e-7)
    # where joints 4 and 6 are free, page and package continue from different previous samples
    test_twin.close(found[free, :6], wanted[free, :6], 1e-4)
    assert abs(wanted[~free, 6]).max() == pytest.approx(100)


@pytest.mark.parametrize("miss", [1, 2, 16, 50])
def test_speed_is_the_time_derivative_of_joint_4(miss):
    """The derivative is computed from places 0.1 mm (1 ms) apart, without the Jacobian."""
    q, speed = passing(miss)
    change = np.gradient(q[:, 3], PLACES / 100)
    assert np.allclose(change[1:-1], speed[1:-1], rtol=0.01, atol=1e-3)
    # the greatest speed is the tool's speed divided by the miss
    assert abs(speed).max() == pytest.approx(100 / miss, rel=0.003)


def test_shown_numbers_match_python(opened):
    shown = opened(view(), ITMO6R)
    q, speed = passing(2)
    shown.type("miss", 2)
    for place in (-100, -7, -1, 0, 3, 100):
        shown.type("place", place)
        seen = shown.look()
        wanted = abs(speed[10 * (place + 100)])
        value, same = numbers(shown)
        assert value == pytest.approx(wanted / (2 * np.pi), abs=0.0051)
        assert same == pytest.approx(wanted / deg, abs=0.51)
        assert abs(shown.code(seen)["rates"][3]) == pytest.approx(wanted, rel=1e-6)
        bend = abs(q[10 * (place + 100), 4]) / deg
        assert f"{np.hypot(place, 2):.0f} mm from" in seen.says and f"{bend:.1f}°" in seen.says
        turned = float(
            re.search(r"Joint 4 is at (\S+)°", seen.says)[1].replace("\N{MINUS SIGN}", "-")
        )
        assert abs((turned - q[10 * (place + 100), 3] / deg + 180) % 360 - 180) <= 0.51
        told = shown.rk.locator("canvas").evaluate_all("all => all.map(e => e.ariaLabel)")
        assert seen.says in told[0] and f"{value:.2f} turns/s" in told[1] and "7.96" in told[1]


def numbers(shown):
    """Return the speed in turns/s and in degrees per second."""
    words = shown.rk.locator(".rk-speed b, .rk-speed b + span").all_inner_texts()
    return float(words[0].removesuffix(" turns/s")), float(words[1].strip("= °/s"))


# --- Input ----------------------------------------------------------------------------------------


def test_dragged_tool_follows_the_pointer_along_the_line(opened):
    shown = opened(view(), ITMO6R)
    shown.type("miss", 10)
    camera = shown.take("tool")
    seen = []
    for step in (30, 60, 90):  # px to the right and up: the line rises on the screen
        shown.page.mouse.move(*(camera + (0.6 * step, -step)), steps=3)
        seen.append(shown.look().boxes["place"])
        at = shown.look().handles["tool"]["at"]
        assert abs(np.array(at) - camera - (0.6 * step, -step)).max() < 25
    shown.page.mouse.up()
    assert -100 < seen[0] < seen[1] < seen[2]
    place = seen[-1]
    assert numbers(shown)[0] == pytest.approx(
        abs(passing(10)[1][round(10 * (place + 100))]) / (2 * np.pi), abs=0.0051
    )
    shown.page.mouse.move(*camera)
    shown.drag("tool", (camera[0] - 300, camera[1] + 300))
    assert shown.look().boxes["place"] == -100, "the tool left the line"


def test_keys_move_the_tool_by_1_and_10_mm(opened):
    shown = opened(view(), ITMO6R)
    for keys, place in (
        (["ArrowRight"], -99),
        (["Shift+ArrowUp"], -89),
        (["ArrowDown", "ArrowLeft"], -91),
        (["Shift+ArrowRight"] * 30, 100),
        (["Home"], -100),
    ):
        shown.press("tool", *keys)
        seen = shown.look()
        assert seen.boxes["place"] == place
        assert seen.handles["tool"]["name"] == f"tool along the line, {place} mm"


def test_a_finger_drags_the_tool(browser, opened):
    phone = browser.new_context(viewport={"width": 390, "height": 700}, has_touch=True)
    phone.add_init_script(test_explorers.WATCH)
    shown = opened(view(), ITMO6R, within=phone)
    finger = phone.new_cdp_session(shown.page)
    before = shown.look()
    x, y = before.handles["tool"]["at"]
    for k in range(7):
        at = [{"x": x + 6 * k, "y": y - 10 * k}]
        kind = "touchMove" if k else "touchStart"
        finger.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": at})
    finger.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    after = shown.look()
    assert after.boxes["place"] > -70 and shown.page.evaluate("scrollY") == 0
    scene, number = (shown.rk.locator(x).bounding_box() for x in (".rk-scene", ".rk-speed b"))
    assert number["y"] + number["height"] - scene["y"] < 400, (
        "the number and the tool do not fit on one screen"
    )
    phone.close()


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_view_has_no_accessibility_violations(opened, theme):
    shown = opened(view(), ITMO6R)
    shown.page.emulate_media(color_scheme=theme)
    for place in (-100, 0):
        shown.type("place", place)
        shown.look()
        assert Axe().run(shown.page, context=".rk").response["violations"] == []


def test_a_click_on_the_curve_moves_the_tool(opened):
    shown = opened(view(), ITMO6R)
    box = shown.rk.locator(".rk-curves").bounding_box()
    shown.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    assert abs(shown.look().boxes["place"]) < 25


def test_joint_4_is_free_in_the_singular_pose(opened):
    shown = opened(view(), ITMO6R)
    before = shown.look()
    shown.type("place", 0)
    seen = shown.look()
    text = shown.rk.inner_text()
    assert "free" in shown.rk.locator(".rk-speed").inner_text() and "Joint 4 is free" in seen.says
    assert "NaN" not in text and "turns/s" not in shown.rk.locator(".rk-speed").inner_text()
    assert seen.pixels != before.pixels and np.isfinite(shown.code(seen)["rates"]).all()
    shown.type("place", 1)
    assert "Joint 4 is free" not in shown.look().says and numbers(shown) == (0, 0)


def test_joint_4_hardly_turns_on_the_line_through_the_singular_pose():
    """Joint 6 can undo the rotation of joint 4, so the pose does not determine joint 4."""
    _, speed = passing(0)
    assert 0.05 < np.nanmax(abs(speed)) < 5 * deg and np.isnan(speed).sum() == 1
    q = HIT + np.linspace(-3, 3, 7)[:, None] * np.array([0, 0, 0, 1, 0, -1])
    assert abs(ITMO6R.fk(q).as_matrix() - ITMO6R.fk(HIT).as_matrix()).max() < 1e-12


# --- Arguments ------------------------------------------------------------------------------------


def test_slider_offers_only_the_requested_misses(opened):
    shown = opened(view(most=2 * mm, step=2 * mm), ITMO6R)
    for typed, taken in ((2, 2), (0.9, 0), (1.1, 2), (40, 2), (-3, 0)):
        shown.type("miss", typed)
        assert shown.look().boxes["miss"] == taken


@pytest.mark.parametrize(
    "changes, error, words",
    [
        (dict(arm=SCARA), TypeError, "arm: wanted an arm with a spherical wrist, got SCARA"),
        (dict(q=HIT + 0.1), ValueError, "q: wanted one posture .* with a wrist singularity"),
        (dict(q=np.zeros(6)), ValueError, "no other, got .* and elbow and wrist"),
        (dict(q=[HIT, HIT]), ValueError, "got shape .2, 6."),
        (dict(way=(1, 0, 0)), ValueError, "way: wanted a direction .* not along axis 4"),
        (dict(way=(1, 1, 0)), ValueError, "way: wanted a line that the arm can follow"),
        (dict(most=2 * mm, step=3 * mm), ValueError, "got 2 mm in steps of 3 mm"),
        (dict(most=0.5 * mm, step=0.5 * mm), ValueError, "steps of whole millimetres"),
        (dict(most=201 * mm), ValueError, "wanted 1 to 200 steps"),
        (dict(most=150 * mm), ValueError, "got no posture at .* with a miss of"),
    ],
)
def test_invalid_lines_are_refused(changes, error, words):
    given = dict(arm=ITMO6R, q=HIT, way=(0, 1, 1)) | changes
    with pytest.raises(error, match=words):
        singularity_explorer(**given)


def test_other_arms_with_a_spherical_wrist_can_be_shown():
    data = singularity_explorer(IRB140, np.zeros(6), (0, 1, 1)).data
    json.dumps(data, allow_nan=False)
    along, beside = np.array(data["along"]), np.array(data["beside"])
    assert np.allclose([along @ along, beside @ beside, along @ beside], [1, 1, 0])
    assert np.allclose(data["pose"]["place"], IRB140.fk(np.zeros(6)).translation)
