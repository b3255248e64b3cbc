"""The close-up of the motion explorer in a real browser: the reader pulls the path of a corner away
from the via point, and the numbers in the page match those computed here.
"""

import re
from math import comb

import numpy as np
import pytest
import test_explorers
from canvas_words import RECORD, faults
from test_explorers import GOAL, IRB140, POSES, SAMPLES, SCARA, START, VIA

import robokin
from robokin import ScaraPose, Transform, blend, deg, follow, mm, record
from robokin.show import motion_explorer
from robokin.show.joiner import script

context, opened = test_explorers.context, test_explorers.opened  # fixtures
ROW, SECONDS = 1, 20
D = np.linalg.norm(START.translation - 2 * VIA.translation + GOAL.translation)


def corner(arm=IRB140, *stations, row=ROW):
    stations = stations or (START, VIA, GOAL)
    return motion_explorer(arm, *stations, row, law="linear", duration=SECONDS, close_up=True)


def located(pose):
    return pose.position if isinstance(pose, ScaraPose) else pose.translation


def path(stations, fraction, s, kind):
    """Return the places (samples, 3) of a path for the path parameter s, with Bernstein
    polynomials.
    """
    start, via, goal = map(located, stations)
    first, last = via + 2 * fraction * (start - via), via + 2 * fraction * (goal - via)
    shares = [0.0, 1.0] if kind == "parabola" else [0.0, 0.4, 0.8]
    points = [first + x * (via - first) for x in shares]
    points += [last + x * (via - last) for x in shares[::-1] if x < 1]
    n, x = len(points) - 1, np.clip((s - 0.5 + fraction) / (2 * fraction), 0, 1)[:, None]
    curve = sum(comb(n, k) * (1 - x) ** (n - k) * x**k * p for k, p in enumerate(points))
    line = np.where(s[:, None] < 0.5, via + (1 - 2 * s[:, None]) * (start - via), 0)
    line += np.where(s[:, None] < 0.5, 0, via + (2 * s[:, None] - 1) * (goal - via))
    return np.where(abs(s[:, None] - 0.5) < fraction, curve, line)


def nearest(stations, fraction, kind):
    """Return the least distance of a path from via, and the place with this distance."""
    places = path(stations, fraction, np.linspace(0, 1, 20_001), kind)
    away = np.linalg.norm(places - located(stations[1]), axis=-1)
    return away.min(), places[away.argmin()]


def numbers(shown):
    """Return the distance from via in mm, the joint that accelerates most, and its acceleration in
    °/s².
    """
    shown.look()  # the acceleration is told in the frame after a release, not during a drag
    told = shown.rk.locator(".rk-told").inner_text().replace("−", "-")
    assert "NaN" not in told
    near = re.search(r"The path passes (\S+) mm from via\.", told)
    hard = re.search(r"Joint (\d) accelerates most: (\S+)°/s²\.", told)
    return float(near[1]), int(hard[1]), float(hard[2])


def wanted(fraction, kind="parabola", seconds=SECONDS):
    """Compute the same numbers from 20 001 samples of the motion."""
    t = np.linspace(0, seconds, 20_001)
    q = follow(IRB140, IRB140.ik(blend(START, VIA, GOAL, fraction, t / seconds, corner=kind)), ROW)
    a = abs(record(IRB140, t, q).a).max(axis=0) / deg
    return nearest((START, VIA, GOAL), fraction, kind)[0] / mm, int(a.argmax()) + 1, a.max()


def shows(shown, fraction, kind="parabola", seconds=SECONDS):
    near, joint, most = numbers(shown)
    away, worst, greatest = wanted(fraction, kind, seconds)
    assert near == pytest.approx(away, abs=0.051)
    assert joint == worst
    assert most == pytest.approx(greatest, abs=0.051, rel=2e-3)


def box(shown):
    shown.look()  # a key changes the box in the next frame
    return float(shown.rk.get_by_label("blend, exactly").input_value())


# --- Numbers --------------------------------------------------------------------------------------

# The distance from via and its place, the place of the path's middle, and the accelerations.
MOTIONS = """([code, data, asked]) => {
  const {$blended, $corner_picture} = new Function(code + "return {$blended, $corner_picture}")();
  const corner = $corner_picture.cornerOf(data);
  return asked.map(([blend, duration, law, kind, row]) => {
    const state = {...data, blend, duration, law, corner: kind, row};
    const {near, a} = $blended.motionOf(data, state);
    const most = data.units.map(({size}, j) => $blended.most(a, j) / size);
    return [parseFloat(near.text), ...near.place,
      ...corner.middle(blend, data.corners[kind]), ...most];
  });
}"""


@pytest.mark.parametrize("arm", [IRB140, SCARA], ids=lambda arm: arm.name)
def test_page_numbers_match_python(browser, arm):
    """Compare a thousand motions with random blends, durations, laws, corners and branches."""
    rng, stations = np.random.default_rng(8), POSES[arm]
    data = corner(arm, *stations, row=0).data
    asked = [
        [b, seconds, int(law), int(kind), int(row)]
        for b, seconds, law, kind, row in zip(
            rng.uniform(0.005, 0.5, 500),
            rng.uniform(0.5, 20, 500),
            rng.integers(0, 3, 500),
            rng.integers(0, 2, 500),
            rng.integers(0, len(arm.branches), 500),
            strict=True,
        )
    ]
    page = browser.new_page()
    got = np.array(page.evaluate(MOTIONS, [script("motion_explorer"), data, asked]))
    page.close()
    units = np.array([unit["size"] for unit in data["units"]])
    for found, (b, seconds, law, kind, row) in zip(got, asked, strict=True):
        law, kind = getattr(robokin, data["laws"][law])(seconds), data["corners"][kind]
        away, place = nearest(stations, b, kind)
        assert found[0] == pytest.approx(away / mm, abs=0.0502)
        # near the minimum, the distance hardly changes along the path
        assert np.linalg.norm(found[1:4] - place) < 2e-3
        [middle] = path(stations, b, np.array([0.5]), kind)
        assert np.allclose(found[4:7], middle, rtol=0, atol=1e-12)
        t = np.linspace(0, seconds, SAMPLES)
        q = follow(arm, arm.ik(blend(*stations, b, law(t), corner=kind)), row)
        with np.errstate(all="ignore"):
            a = np.fmax.reduce(abs(record(arm, t, q).a), axis=0) / units
        assert np.allclose(found[7:], a, rtol=1e-6, atol=1e-6)


def test_opening_values_follow_from_the_formula():
    said = repr(corner())
    away, _ = nearest((START, VIA, GOAL), 0.1, "parabola")
    assert float(re.search(r"passes (\S+) mm from via\.$", said)[1]) == round(away / mm, 1)
    assert away < 0.05 * D  # the least distance is less than the distance in the middle of the path


# --- Input ----------------------------------------------------------------------------------------


def test_ring_pulls_the_path_away_from_via(opened):
    shown = opened(corner(), IRB140)
    shows(shown, 0.1)
    start = shown.take("blend")
    pulled = []
    for dx in (-40, -90, 60):
        shown.page.mouse.move(*(start + (dx, 7)), steps=3)
        seen = shown.look()
        assert abs(seen.handles["blend"]["at"][0] - start[0] - dx) < 2, (
            "the ring does not follow the pointer"
        )
        pulled.append((dx, box(shown)))
    shown.page.mouse.up()
    shows(shown, box(shown))
    # the ring moves like the middle of the path, which moves by |D| / 2 for each unit of blend
    slopes = [(b - 0.1) / dx for dx, b in pulled]
    assert max(slopes) < 0 and np.ptp(slopes) < 0.05 * abs(np.mean(slopes))


def test_keys_move_the_ring_between_its_limits(opened):
    shown = opened(corner(), IRB140)
    start = shown.look()
    for key, value in (
        ("ArrowLeft", 0.11),
        ("ArrowUp", 0.12),
        ("ArrowRight", 0.11),
        ("ArrowDown", 0.1),
        ("Shift+ArrowLeft", 0.2),
    ):
        shown.press("blend", key)
        seen = shown.look()
        assert box(shown) == value
        assert seen.handles["blend"]["name"].startswith(f"blend, {value:.3f}, ")
    shows(shown, 0.2)
    shown.press("blend", *["Shift+ArrowLeft"] * 4)
    assert box(shown) == 0.5
    shows(shown, 0.5)
    shown.press("blend", "Home")
    assert shown.look().pixels == start.pixels and box(shown) == 0.1


def test_every_input_changes_the_numbers(opened):
    shown = opened(corner(), IRB140)
    seen, unlike = [shown.look()], 0
    for change, values in (
        (lambda: shown.slide("blend", 0.03), (0.03,)),
        (lambda: shown.choose("corner", 1), (0.03, "quintic")),
        (lambda: shown.type("duration", 10), (0.03, "quintic", 10)),
        (lambda: shown.type("blend", 0.3), (0.3, "quintic", 10)),
    ):
        change()
        seen.append(shown.look())
        shows(shown, *values)
        spoken = shown.rk.locator("canvas").first.get_attribute("aria-label")
        assert spoken.startswith("Close-up of the corner. The path passes ")
        assert seen[-1].pixels[1] != seen[-2].pixels[1], "the curves have not changed"
        unlike += seen[-1].pixels[0] != seen[-2].pixels[0]
        words = seen[-1].words[0].split("|")
        assert {"via", "from start", "to goal", f"{numbers(shown)[0]:.1f} mm"} <= set(words)
    assert unlike == 3, (
        "the picture of the corner changed with the duration, or not with a blend or corner"
    )
    assert shown.rk.get_by_label("via x").count() == 0


def test_without_a_blend_the_speed_jumps(opened):
    shown = opened(corner(), IRB140)
    shown.press("blend", *["ArrowRight"] * 12)
    assert box(shown) == 0
    shown.look()  # draws the next frame, and checks that no text contains NaN
    told = shown.rk.locator(".rk-told").inner_text()
    assert "passes 0.0 mm from via." in told and "NaN" not in told
    assert "The speed jumps at 10.00 s, so there is no finite acceleration." in told
    assert "accelerates most" not in told
    shown.press("blend", "ArrowLeft")
    shown.look()  # waits until the page has drawn the change
    shows(shown, 0.01)


def test_the_stroke_is_not_compared_with_the_angles(opened):
    """A SCARA's joint 4 accelerates in mm/s², so no joint is said to accelerate most."""
    places = [(0.2, 0.3, 0.12), (0.4, 0.1, 0), (0.2, -0.2, 0.2)]
    stations = ScaraPose(places, np.array([0, 180, 90]) * deg)
    shown = opened(corner(SCARA, *stations, row=SCARA.branch(+1)), SCARA)
    for fraction in (0.1, 0.268):
        shown.type("blend", fraction)
        says = shown.look().says
        assert ("q4 exceeds its limit" in says) == (fraction < 0.2)
        told = shown.rk.locator(".rk-told").inner_text()
        turns = re.search(r"Joint (\d) accelerates at up to (\S+)°/s²\.", told)
        t = np.linspace(0, SECONDS, 20_001)
        q = follow(SCARA, SCARA.ik(blend(*stations, fraction, t / SECONDS)), SCARA.branch(+1))
        most = abs(record(SCARA, t, q).a).max(axis=0) / [deg, deg, deg, mm]
        assert int(turns[1]) == most[:3].argmax() + 1
        assert float(turns[2]) == pytest.approx(most[:3].max(), abs=0.051, rel=2e-3)
        assert "accelerates most" not in told


@pytest.mark.parametrize("width", [390, 914])
def test_numbers_of_both_scales_are_whole_for_a_short_motion(browser, opened, width):
    places = [(0.2, 0.3, 0.12), (0.4, 0.1, 0), (0.2, -0.2, 0.2)]
    stations = ScaraPose(places, np.array([0, 180, 90]) * deg)
    with browser.new_context(viewport={"width": width, "height": 800}) as small:
        small.add_init_script(RECORD)
        shown = opened(corner(SCARA, *stations, row=SCARA.branch(+1)), SCARA, within=small)
        shown.type("duration", 0.5)
        shown.look()
        words = [
            word["text"] for each in shown.page.evaluate("canvasWords()") for word in each["words"]
        ]
        assert any(re.fullmatch("−[0-9]{5}", text) for text in words)
        assert faults(shown.page) == []
        shown.page.close()


def test_opening_curves_are_drawn_and_named_once_the_motion_differs(browser, opened):
    with browser.new_context(viewport={"width": 900, "height": 800}) as wide:
        wide.add_init_script(RECORD)
        shown = opened(corner(), IRB140, within=wide)
        blend_slider = shown.rk.get_by_role("slider", name="blend").first
        opening = float(blend_slider.input_value())
        for value, differs in ((opening, False), (opening + 0.1, True), (opening, False)):
            shown.type("blend", value)
            shown.look()
            words = {
                word["text"]
                for each in shown.page.evaluate("canvasWords()")
                for word in each["words"]
            }
            assert "q3" in words and ("faint: the opening motion" in words) == differs
        shown.page.close()


def test_page_reports_a_motion_out_of_reach(opened):
    far = Transform(VIA.rotation, (0.9, -0.1, 0.8))
    shown = opened(corner(IRB140, START, far, GOAL), IRB140)
    assert re.search(r"No solution in \d+ of 241 samples\.", shown.look().says)
    assert "no solution" in shown.look().words[2].split("|")


def test_every_canvas_follows_the_theme_and_is_printed(opened):
    shown = opened(corner(), IRB140)
    light = shown.look().pixels
    shown.page.emulate_media(color_scheme="dark")
    dark = shown.look().pixels
    assert len(light) == 3 and all(a != b for a, b in zip(light, dark, strict=True))
    shown.page.emulate_media(media="print", color_scheme="dark")
    shown.look()
    assert shown.rk.locator("canvas:visible").count() == 3
    assert shown.rk.locator(".rk-told").is_visible()
    assert shown.rk.locator(".rk-handle:visible").count() == 1  # the ring at the middle of the path
    boxes = shown.rk.locator("input:visible")
    assert boxes.count() == 2 and all(box.get_attribute("type") == "number" for box in boxes.all())


def test_invalid_calls_are_refused():
    beyond = Transform(GOAL.rotation, 2 * VIA.translation - START.translation)
    for stations in ((START, VIA, beyond), (START, START, GOAL), (START, GOAL, GOAL)):
        with pytest.raises(ValueError, match="close_up: wanted a corner at via, got start, via"):
            corner(IRB140, *stations)
    with pytest.raises(ValueError, match="close_up: wanted True or False, got 1"):
        motion_explorer(IRB140, START, VIA, GOAL, close_up=1)
    back = corner(IRB140, START, VIA, Transform(GOAL.rotation, START.translation))
    # a motion that returns along the same line has a corner, too
    assert back.data["close_up"] is True
