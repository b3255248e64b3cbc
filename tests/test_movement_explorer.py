"""The movement explorer in a real browser: the sum S of the angle changes, its terms, its kinks,
its least value and the total of two targets match independent formulas and searches.
"""

import re

import numpy as np
import pytest
import test_explorers
from canvas_words import NEXT
from scipy.optimize import brentq

from robokin import IRB140, deg, three_lever
from robokin.show import movement_explorer
from robokin.show.joiner import script

context, opened = test_explorers.context, test_explorers.opened  # fixtures
ARM = three_lever(1.0)
UNEVEN = three_lever((0.9, 1.1, 0.6))
STAND, TASKS = np.array([60, 120, 120]) * deg, [(2.4, 0.4), (-2.0, 1.4)]
SQUARE, PLACE = np.array([90, 90, 90]) * deg, (1.8, 0.6)
NAMES = ["gamma", "beta", "alpha"]


def posture(K, alpha, lengths=(1, 1, 1)):
    """Return the postures (..., 3) for the complex number K, with B to the left of OK and A to the
    left of BK.
    """
    a, b, c = lengths
    KB, KO = abs(b - c * np.exp(1j * alpha)), abs(K)
    along = (KO**2 + a**2 - KB**2) / (2 * KO)
    B = K / KO * (along + 1j * np.sqrt(np.maximum(0, a**2 - along**2)))
    A = B + (K - B) * b / (b - c * np.exp(1j * alpha))
    gamma = np.angle(K) + np.angle(B / K)
    return np.stack([gamma, np.angle((A - B) / -B) % (2 * np.pi), alpha], axis=-1)


def kinks_of(K, before, ends, lengths=(1, 1, 1)):
    """Return a list of (joint, alpha) for which an angle has its previous value. They are found as
    sign changes on a grid and then refined.
    """
    alphas = np.linspace(*ends, 801)
    change = posture(K, alphas, lengths) - before
    found = []
    for k, j in np.argwhere(np.diff(np.sign(change), axis=0)):

        def gap(alpha, j=j):
            return posture(K, alpha, lengths)[j] - before[j]

        found.append((int(j), brentq(gap, alphas[k], alphas[k + 1], xtol=1e-12)))
    return sorted(found)


@pytest.fixture(scope="module")
def levers(context):
    """Return a function that calls one of levers.js: `levers(name, *arguments)`."""
    page = context.new_page()
    page.goto("about:blank")
    page.add_script_tag(content=f"{script('levers')}\nwindow.levers = $levers;")
    yield lambda name, *given: page.evaluate(
        "([name, given]) => given.map(each => levers[name](...each))", [name, [*given]]
    )
    page.close()


@pytest.mark.parametrize("arm", [ARM, UNEVEN], ids=["equal", "unequal"])
def test_page_finds_every_kink(levers, arm):
    rng = np.random.default_rng(5)
    lengths, data = arm.levers, movement_explorer(arm, SQUARE, (1.4, 0.7)).data["arm"]
    calls, wanted = [], []
    while len(calls) < 500:
        K = rng.uniform(arm.geometry.inner, arm.reach) * np.exp(1j * rng.uniform(0, np.pi))
        before, ends = rng.uniform(20, 170, 3) * deg, np.array(arm.alpha_range((K.real, K.imag)))
        if np.isnan(ends).any() or np.ptp(ends) < 0.1:
            continue
        calls.append([data, {"place": [K.real, K.imag, 0]}, before.tolist()])
        wanted.append(kinks_of(K, before, ends + [1e-6, -1e-6], lengths))
    got = levers("kinks", *calls)
    for one, other in zip(got, wanted, strict=True):
        found = sorted((kink["joint"], kink["alpha"]) for kink in one)
        assert [j for j, _ in found] == [j for j, _ in other]
        assert np.allclose([x for _, x in found], [x for _, x in other], atol=1e-6)
    counts = np.bincount([len(each) for each in wanted])
    assert (counts[:4] > 10).all(), counts


def numbers(text):
    """Return the numbers in the sentence below the curve, and what it says about the place where S
    is least.
    """
    form = (
        r"gamma (.*)°, beta (.*)°, alpha (.*)°: S = (.*)° \+ (.*)° \+ (.*)° ([=≈]) (.*)°; "
        r"the longest turn is (.*)°\. The least S is (.*)°, at alpha = (.*)°: ([^.]*)\."
        r"(?: With the "
        r"earlier (.*)°, the total is (.*)°\. The longest turns add up to (.*)°\.)?"
    )
    *values, where, before, total, longest = re.fullmatch(form, text).groups()
    equals = values.pop(6)  # as printed: the rounded terms may add up to another value
    adds_up = abs(sum(map(float, values[3:6])) - float(values[6])) < 0.01
    assert equals == ("=" if adds_up else "≈")
    return [float(x) for x in values], where, *[x and float(x) for x in (before, total, longest)]


def shows(shown, before, turned=None, longest=0.0):
    """Assert that the page shows what is computed here; return the posture and S in radians.
    `turned` and `longest` are the sums of S and of the longest turns of the earlier targets.
    """
    seen = shown.look()
    values, where, earlier, total, largest = numbers(seen.says)
    code = shown.code(seen)
    K = complex(*[float(x) for x in re.search(r"family\(\((\S+), (\S+)\)", seen.code).groups()])
    q = posture(K, code["q"][2])
    change = abs(q - before)
    told = [*q / deg, *change / deg, change.sum() / deg, change.max() / deg]
    assert values[:8] == pytest.approx(told, abs=0.06)
    ends = np.array(ARM.alpha_range((K.real, K.imag)))
    fine = np.linspace(*ends, 20001)
    rows = posture(K, fine)
    S = abs(rows - before).sum(axis=-1)
    best = S.argmin()
    assert values[8] == pytest.approx(S[best] / deg, abs=0.06)
    near = fine[S < S[best] + 2e-3 * deg] / deg
    assert near[0] - 0.1 < values[9] < near[-1] + 0.1
    kept = [NAMES[j] for j in np.flatnonzero(abs(rows[best] - before) < 0.02 * deg)]
    at_end = best in (0, len(fine) - 1)
    wanted = (
        f"{' and '.join(kept)} keep" if kept else "an end of its range" if at_end else "the curve"
    )
    assert where.startswith(wanted)
    assert (earlier is None) == (turned is None)
    if turned is not None:
        sums = [turned, turned + change.sum(), longest + change.max()]
        assert [earlier, total, largest] == pytest.approx(np.array(sums) / deg, abs=0.06)
    heard = shown.rk.locator(".rk-curves").get_attribute("aria-label").replace("\u2212", "-")
    told = re.findall(r"A kink at (\S+)°, where (\w+) keeps its value\.", heard)
    kinks = kinks_of(K, before, ends)
    assert sorted((NAMES.index(name), float(at)) for at, name in told) == [
        (j, pytest.approx(alpha / deg, abs=0.06)) for j, alpha in kinks
    ]
    scene = shown.rk.locator("canvas").first.get_attribute("aria-label")
    assert scene.endswith(seen.says), "the accessible name of the scene is out of date"
    return q, change.sum()


def test_page_shows_the_terms_the_kinks_and_the_least_sum(opened):
    shown = opened(movement_explorer(ARM, SQUARE, PLACE), ARM)
    pictures = [shown.look().pixels]
    shows(shown, SQUARE)
    least_at = set()
    for x, y, alpha in [(1.8, 0.6, 100), (2.3, -0.4, 150), (2.8, 0.4, 175), (-2.0, 1.4, 90)]:
        for name, value in {"x": x, "y": y, "alpha": alpha}.items():
            shown.type(name, value)
        shows(shown, SQUARE)
        least_at.add(numbers(shown.look().says)[1].split()[-1])
        pictures.append(shown.look().pixels)
    assert least_at == {"value", "there", "range"}, (
        "the least S should be at a kink, a level place and an end of the range"
    )
    assert len({tuple(each) for each in pictures}) == len(pictures), "the picture has not changed"
    shown.press("free", "Home")
    shown.rk.get_by_role("button", name="Least S").click()
    q, S = shows(shown, SQUARE)
    assert S == pytest.approx(ARM.least(PLACE, SQUARE)[1], abs=1e-4) and q[0] == pytest.approx(
        90 * deg, abs=1e-4
    )


def test_joint_a_follows_the_pointer_and_the_gripper_stays_in_place(opened):
    shown = opened(movement_explorer(ARM, SQUARE, PLACE), ARM)
    start = shown.take("alpha")
    alphas = []
    for step in ((-20, 4), (-60, 4), (-100, 20), (-100, 500)):
        shown.page.mouse.move(*(start + step))
        q, _ = shows(shown, SQUARE)
        alphas.append(q[2])
        at = np.array(shown.look().handles["alpha"]["at"])
        A = pixels_of(shown, ARM.points(q)[2])
        assert np.linalg.norm(at - A) < 3, "the handle is not at joint A"
    shown.page.mouse.up()
    assert len(set(alphas)) == 4 and np.ptp(alphas) > 20 * deg
    assert {name: shown.look().boxes[name] for name in "xy"} == {"x": 1.8, "y": 0.6}
    shown.press("alpha", "Home")
    assert shown.look().boxes["alpha"] == 90
    shown.press("alpha", "ArrowRight", "Shift+ArrowUp", "ArrowLeft")
    assert shown.look().boxes["alpha"] == pytest.approx(100, abs=1e-9)
    curve = shown.rk.locator(".rk-curves").bounding_box()
    for share in (0.5, 0.7):
        shown.page.mouse.click(curve["x"] + share * curve["width"], curve["y"] + 100)
        alphas.append(shows(shown, SQUARE)[0][2])
    assert alphas[-1] > alphas[-2] + 20 * deg


def pixels_of(shown, place):
    """Return the pixels of a point (2,) of the plane, from those of both ends of the arm."""
    base = np.zeros(2)
    gripper = np.array([shown.look().boxes[name] for name in "xy"])
    there = np.array(shown.look().handles["free"]["at"])
    box = shown.rk.locator("canvas").first.bounding_box()
    seen = np.array(shown.data["scene"]["seen"])[:, :2]
    scale = (np.array([box["width"] - 40, box["height"] - 54]) / np.ptp(seen, axis=0)).min()
    return there + (np.asarray(place) - gripper + base) * scale * [1, -1]


def test_page_adds_up_the_angle_changes_of_two_targets(opened):
    shown = opened(movement_explorer(ARM, STAND, TASKS), ARM)
    first = shown.look()
    shown.rk.get_by_role("button", name="Least S").click()
    one, S = shows(shown, STAND)
    longest = abs(one - STAND).max()
    shown.rk.get_by_role("button", name="Begin here").click()
    assert [shown.look().boxes[name] for name in "xy"] == list(TASKS[1])
    shows(shown, one, S, longest)
    shown.rk.get_by_role("button", name="Least S").click()
    two, more = shows(shown, one, S, longest)
    longest += abs(two - one).max()
    assert (S + more) / deg == pytest.approx(225.9, abs=0.06)
    shown.rk.get_by_role("button", name="Begin here").click()  # there is no third target
    _, rest = shows(shown, two, S + more, longest)
    assert rest < 1e-3
    shown.rk.get_by_role("button", name="Start again").click()
    again = shown.look()
    assert (again.says, again.boxes, again.pixels) == (first.says, first.boxes, first.pixels)


def test_narrow_range_fills_the_width_of_the_curve(opened):
    shown = opened(movement_explorer(ARM, SQUARE, (-2.0, 1.4)), ARM)
    low, high = np.array(ARM.alpha_range((-2.0, 1.4))) / deg
    curve, chosen = shown.rk.locator(".rk-curves").bounding_box(), []
    for share in (0.3, 0.5, 0.7):
        shown.page.mouse.click(curve["x"] + share * curve["width"], curve["y"] + 100)
        chosen.append(shows(shown, SQUARE)[0][2] / deg)
    assert high - low < 15 and low < chosen[0] and chosen[2] < high
    assert (np.diff(chosen) > 2).all()


def test_name_of_the_target_gives_its_place_in_millimetres(opened):
    shown = opened(movement_explorer(ARM, SQUARE, (1.65, 1.05)), ARM)
    assert shown.rk.locator(".rk-free").get_attribute("aria-label").endswith(", 1.650, 1.050 m")


@pytest.mark.parametrize("arm", [ARM, UNEVEN, three_lever(4.0)], ids=["equal", "unequal", "large"])
def test_page_says_why_a_point_is_out_of_reach(opened, arm):
    inside = np.array([0.6, 0.3]) * arm.reach
    shown = opened(movement_explorer(arm, SQUARE, inside), arm)
    for x, y in ((0.2, 0.1), (0.9, 0.7), (-0.9, 0.1), (0.5, -0.8)):
        place = (np.array([x, y]) * arm.reach).round(3)
        for name, value in zip("xy", place.tolist(), strict=True):
            shown.type(name, value)
        why = arm.out_of_reach(place).replace("0 to 180 degrees", "0° to 180°")
        said = ["every posture for it has"] if "posture" in why else [why]
        if "does not allow" in why:  # the page says the rule first, then the distance
            said = ["allows only points farther", *re.findall(r"[\d.]+ m+", why)]
        assert why and all(each in shown.look().says for each in said)
    shown.rk.get_by_role("button", name="Least S").click()
    shown.rk.get_by_role("button", name="Begin here").click()
    shown.press("free", "Home")
    assert numbers(shown.look().says)[2] is None, "a posture that does not exist was accepted"


@pytest.mark.parametrize(
    ("given", "error", "says"),
    [
        ((IRB140, SQUARE, PLACE), TypeError, "arm: wanted"),
        ((ARM, SQUARE[:2], PLACE), ValueError, "previous: wanted shape"),
        ((ARM, [SQUARE, SQUARE], PLACE), ValueError, "previous: wanted one posture"),
        ((ARM, SQUARE, (1.8, 0.6, 0)), ValueError, "target: wanted shape"),
        ((ARM, SQUARE, np.empty((0, 2))), ValueError, r"target: wanted a point \(2,\), or at most"),
        ((ARM, SQUARE, np.ones((2, 2, 2))), ValueError, "target: wanted a point"),
        ((ARM, SQUARE, [PLACE, (0.3, 0.2)]), ValueError, "got .0.3, 0.2.: it lies 360.6 mm from"),
        ((ARM, SQUARE, (np.nan, 1)), ValueError, "target: wanted finite numbers"),
    ],
)
def test_invalid_arguments_are_refused(given, error, says):
    with pytest.raises(error, match=says):
        movement_explorer(*given)


def test_degrees_for_radians_cause_a_warning():
    with pytest.warns(UserWarning, match="previous"):
        movement_explorer(ARM, (90, 90, 90), PLACE)


def test_angles_are_named_only_where_a_posture_reaches_the_point(opened):
    """The letters of gamma and beta are at their joints; that of alpha is on its ring."""
    shown = opened(movement_explorer(ARM, SQUARE, PLACE))
    ring, scene = shown.page.locator(".rk-handles .rk-joint"), shown.rk.locator("canvas").first

    def named():
        return {"γ", "β"} & set(scene.evaluate("canvas => canvas.words"))

    shown.page.evaluate(NEXT)
    assert ring.is_visible() and named() == {"γ", "β"}
    for letter, value in (("x", -1.2), ("y", 0.5)):
        shown.type(letter, value)
    shown.page.evaluate(NEXT)
    assert "No posture reaches this point" in shown.page.locator(".rk-says").inner_text()
    assert not ring.is_visible() and not named()
    shown.type("y", 1.6)
    shown.page.evaluate(NEXT)
    assert ring.is_visible() and named() == {"γ", "β"}
