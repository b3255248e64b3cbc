"""The clearance explorer in a real browser: its numbers match `clearance` and `along`, and the
reader can move the obstacle and the via points.
"""

import re
from functools import cache

import numpy as np
import pytest
import test_explorers
import test_twin
from axe_playwright_python.sync_playwright import Axe

from robokin import IRB140, deg, mm, three_lever
from robokin.jobs.obstacles import along, clearance
from robokin.show import clearance_explorer
from robokin.units import in_words

context, opened, twin = test_explorers.context, test_explorers.opened, test_twin.twin  # fixtures
ARM, UNEVEN = three_lever(1.0), three_lever((0.9, 1.1, 0.6))
START = ARM.family((1.2, 1.7), 118 * deg)
K1, H = (1.9, 0.3), (1.2, 1.3)
VIAS = [(1.05, 1.3), (1.05, 1.2)]
KEPT = 1 / 7
STAND, TARGET = np.array([100, 110, 100]) * deg, np.array([0.7, 0.1])


def view(vias=VIAS, place=H):
    return clearance_explorer(ARM, START, K1, place, vias)


def path_through(places, arm=ARM, start=START):
    path = [start]
    for place in places:
        path.append(arm.least(place, path[-1])[0])
    return np.array(path)


def far(arm, q, place):
    """Return the distances (..., 3) of a place from the levers, by projection on each lever."""
    points = arm.points(q)
    P, way = points[..., :-1, :], np.diff(points, axis=-2)
    u = np.clip(((place - P) * way).sum(axis=-1) / (way**2).sum(axis=-1), 0, 1)
    return np.linalg.norm(P + u[..., None] * way - place, axis=-1)


# --- Numbers --------------------------------------------------------------------------------------


@cache
def tasks(arm):
    """Return 500 motions past random obstacles, half of them through two via points: the states of
    the page, and rows with the clearance of each lever, the distance at a moment, and S.
    """
    rng, states, rows = np.random.default_rng(7), [], []
    while len(states) < 500:
        angles, shares = rng.uniform(0, np.pi, 2), rng.uniform(0.45, 0.95, 2)
        vias = (arm.reach * shares * np.exp(1j * angles)).view(float).reshape(2, 2)
        vias = vias[: 2 * (len(states) % 2)]
        if np.isnan(arm.alpha_range(vias)).any():
            continue
        path = path_through([*vias, TARGET * arm.reach], arm, STAND)
        place, share = rng.uniform(-0.3, 0.7, 2) * arm.reach, rng.random()
        flat = [[*via, 0] for via in vias.tolist()]
        states.append({"vias": flat, "obstacle": [*place, 0], "share": share})
        now = far(arm, along(path, share), place).min()
        S = abs(np.diff(path, axis=0)).sum()
        rows.append([*clearance(arm, path, place).min(axis=0), now, S])
    return states, np.array(rows)


@pytest.mark.parametrize("arm", [ARM, UNEVEN], ids=["equal", "unequal"])
def test_page_clearances_of_random_motions_match_python(twin, arm):
    states, wanted = tasks(arm)
    data = clearance_explorer(arm, STAND, TARGET * arm.reach, (0.5, 0.5)).data
    found = np.array(
        twin.page.evaluate(
            """async ([data, states]) => {
              const {paths, foundOf} = await import("/clearance_explorer.js");
              const pathAt = paths(data);
              return states.map(state => {
                const {least, now, motion} = foundOf(data, pathAt(state.vias), state);
                return [least.distance, least.share, least.index, now.distance, motion.S];
              });
            }""",
            [data, states],
        )
    )
    least, index = wanted[:, :3].min(axis=1), found[:, 2].astype(int)
    assert abs(found[:, 0] - least).max() < 1e-5 > abs(found[:, 3:] - wanted[:, 3:]).max()
    assert abs(wanted[np.arange(len(wanted)), index] - least).max() < 1e-5
    assert (least > 1e-3).sum() > 200 and (least < 1e-5).sum() > 50 and len(set(index)) == 3
    for state, (distance, share, *_) in zip(states[::5], found[::5], strict=True):
        vias = [via[:2] for via in state["vias"]]
        q = along(path_through([*vias, TARGET * arm.reach], arm, STAND), share)
        assert far(arm, q, state["obstacle"][:2]).min() == pytest.approx(distance, abs=1e-6)


def shows(shown):
    """Assert that the page agrees with the copied code, run in Python; return the distance."""
    seen = shown.look()
    code = shown.code(seen)
    path, place = np.array(code["path"]), eval(re.search(r"path, (\(.*?\))\)", seen.code)[1])
    least = clearance(ARM, path, place).min(axis=0)
    assert code["least"] == pytest.approx(least)
    number, where = shown.rk.locator(".rk-least b, .rk-least b + span").all_inner_texts()
    assert float(number.removesuffix(" mm")) == pytest.approx(least.min() / mm, abs=0.06)
    lever, percent = re.search(r"lever (\w\w).* after (\d+) %", where).groups()
    assert least[["OB", "BA", "AK"].index(lever)] == pytest.approx(least.min(), abs=1e-5)
    q = along(path, np.linspace(0, 1, 4001))
    assert seen.says.startswith("All levers stay" if least.min() >= KEPT else "Too near")
    gripper = np.hypot(*(ARM.points(q)[:, 3] - place).T).min()
    S = abs(np.diff(path, axis=0)).sum() / deg
    told = re.search(r"H is ([\d.]+) mm\. All joint turns add up to S = ([\d.]+)°", seen.says)
    assert [float(x) for x in told.groups()] == pytest.approx([gripper / mm, S], abs=0.3)
    near = far(ARM, along(path, int(percent) / 100 + np.linspace(-0.006, 0.006, 25)), place).min()
    assert near == pytest.approx(least.min(), abs=5 * mm)
    curve = shown.rk.locator(".rk-curves").get_attribute("aria-label")
    assert f"distance, {number}, is at lever {lever} after {percent} %" in curve
    assert seen.says in shown.rk.locator(".rk-scene").get_attribute("aria-label")
    return least.min() / mm


def test_dragging_the_letters_updates_the_distance(opened):
    shown = opened(view(), ARM)
    found, pictures = [shows(shown)], [shown.look().pixels]
    for letter, way in (("K2", (-60, -70)), ("K3", (-10, 20)), ("H", (90, 60))):
        at = shown.take(letter)
        for share in (0.5, 1):
            shown.page.mouse.move(*(at + share * np.array(way)))
            found.append(shows(shown))
            pictures.append(shown.look().pixels)
            there = np.array(shown.look().handles[letter]["at"])
            assert np.linalg.norm(there - at - share * np.array(way)) < 2
        shown.page.mouse.up()
    assert len({tuple(each) for each in pictures}) == 7, "the picture has not changed"
    assert max(found) > 1000 * KEPT > min(found)
    for letter in ("K2", "K3", "H"):
        shown.press(letter, "Home")
    assert shows(shown) == found[0] < 0.05


def test_keys_move_letters_by_1_and_10_cm(opened):
    shown = opened(view(), ARM)
    shown.press("H", "ArrowRight", "Shift+ArrowUp", "ArrowDown", "Shift+ArrowLeft")
    assert "H, the obstacle, 1.110, 1.390 m" in shown.look().handles["H"]["name"]
    shown.press("K3", "Shift+ArrowDown")
    assert "1.050, 1.100 m" in shown.look().handles["K3"]["name"]
    # the coordinates of the letter that has the focus are in a corner of the scene
    layer = shown.rk.locator(".rk-handles")
    assert layer.get_attribute("data-at") == "K3: 1.050, 1.100 m"
    shown.rk.locator("[data-handle=H]").focus()
    shown.look()
    assert layer.get_attribute("data-at") == "H: 1.110, 1.390 m"
    shows(shown)


def test_arm_follows_the_curve_and_a_button_returns_to_the_nearest_moment(opened):
    shown = opened(view(), ARM)
    first = shown.look()
    nearest = first.boxes["motion"]
    curve = shown.rk.locator(".rk-curves").bounding_box()
    shown.page.mouse.click(curve["x"] + curve["width"] / 2, curve["y"] + 100)
    assert 40 < shown.look().boxes["motion"] < 55 != nearest
    assert shown.look().pixels != first.pixels
    path = np.array(shown.code()["path"])
    for percent in (0, 25, 100):
        shown.type("motion", percent)
        each = far(ARM, along(path, percent / 100), H)
        lever, near = ["OB", "BA", "AK"][each.argmin()], each.min()
        assert f"{lever} {near / mm:.0f} mm" in shown.look().words[0]
        said = f"The picture shows {percent} % of the motion: lever {lever} is {in_words(near)}"
        assert shown.look().says.endswith(f"{said} from H.")
    shown.rk.get_by_role("button", name="Nearest moment").click()
    again = shown.look()
    assert (again.boxes["motion"], again.pixels) == (nearest, first.pixels)
    assert again.says == first.says and "The picture shows" not in first.says


@pytest.mark.parametrize("width", [390, 1036])
def test_height_stays_when_the_slider_first_moves(opened, width):
    shown = opened(view(), ARM)
    shown.page.set_viewport_size({"width": width, "height": 900})
    shown.look()
    heights = [shown.rk.bounding_box()["height"]]
    for percent in (0, 37, 100):
        shown.type("motion", percent)
        assert "The picture shows" in shown.look().says
        heights.append(shown.rk.bounding_box()["height"])
    assert max(heights) - min(heights) < 1, "the page below the view jumps"


def test_page_names_the_point_that_is_out_of_reach_and_says_why(opened):
    shown = opened(view(), ARM)
    shown.press("K3", *["Shift+ArrowDown"] * 9)  # (1.05, 0.3)
    shows(shown)
    shown.press("K3", *["Shift+ArrowLeft"] * 5)
    said = shown.look().says
    assert said == (
        "K3: This course allows only points farther from the base than one lever (1000.0 mm); this "
        "one lies 626.5 mm from it."
    )
    assert ARM.out_of_reach((0.55, 0.3)).startswith("it lies 626.5 mm from the base, not farther")
    assert "no path" in shown.rk.inner_text()
    for name in (".rk-scene", ".rk-curves"):
        assert said in shown.rk.locator(name).get_attribute("aria-label")
    shown.press("K3", "Home")
    shown.press("H", *["Shift+ArrowDown"] * 13, *["Shift+ArrowLeft"] * 12)  # onto the base
    assert shows(shown) < 0.05


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_view_has_no_accessibility_violations(opened, theme):
    shown = opened(view(), ARM)
    shown.page.emulate_media(color_scheme=theme)
    for letter in ("K2", "K3"):
        shown.look()
        assert Axe().run(shown.page, context=".rk").response["violations"] == []
        shown.press(letter, *["Shift+ArrowLeft"] * 4)


# --- Arguments ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "changes, error, says",
    [
        (dict(arm=IRB140), TypeError, "arm: wanted"),
        (dict(posture=[START, START]), ValueError, "posture: wanted a single posture"),
        (dict(posture=[-0.1, 1, 1]), ValueError, "posture: wanted three angles from 0 to 180"),
        (dict(target=(0.3, 0.2)), ValueError, "target: wanted a point in reach, .*360.6 mm from"),
        (dict(via=[(1.2, 0.8), (4, 0)]), ValueError, "via: wanted a point in reach, got .4.0, 0.0"),
        (dict(via=(1.2, 0.8)), ValueError, r"via: wanted at most 4 points \(k, 2\), got shape"),
        (dict(via=[(1.2, 0.8)] * 5), ValueError, r"got shape \(5, 2\)"),
        (dict(obstacle=[H, H]), ValueError, "obstacle: wanted a single point"),
    ],
)
def test_invalid_arguments_are_refused(changes, error, says):
    given = dict(arm=ARM, posture=START, target=K1, obstacle=H) | changes
    with pytest.raises(error, match=says):
        clearance_explorer(**given)


def test_summary_describes_the_still_picture():
    near, wide = view().data["summary"], view([(0.7, 1.8), (1.0, 1.2)]).data["summary"]
    assert near.endswith("lever BA of Three levers comes within 0.0 mm of H, nearer than the "
                         "required 142.9 mm.")  # fmt: skip
    least = clearance(ARM, path_through([(0.7, 1.8), (1.0, 1.2), K1]), H).min()
    assert f"within {least / mm:.1f} mm of H, farther than the required 142.9 mm." in wide
    assert clearance_explorer(ARM, START, K1, H).data["title"] == "From K to K1, past an obstacle H"
