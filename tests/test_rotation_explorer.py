"""The rotation explorer in a real browser: the vector v, the product q v and the rotated vector
q v q* match SciPy and independent formulas.
"""

import itertools
import json
import re

import numpy as np
import pytest
import test_explorers
from scipy.spatial.transform import Rotation

from robokin import deg, mm
from robokin.show import rotation_explorer
from robokin.show.joiner import script

context, opened = test_explorers.context, test_explorers.opened  # fixtures
AXIS, V = np.array([0.6, 0, 0.8]), np.array([100, 0, 0]) * mm


def explorer(angle=70 * deg, axis=AXIS, v=V):
    return rotation_explorer(angle, axis, v)


def about(axis, angle):
    return Rotation.from_rotvec(np.outer(angle, axis))


def vector(data, tilt):
    """Return the vectors v at these angles (k,) from the axis: the axis is rotated towards v about
    their common normal.
    """
    axis, across = np.array(data["axis"]), np.array(data["across"])
    return data["length"] * about(np.cross(axis, across), tilt).apply(axis)


def one_side(axis, angle, v):
    """Return the real part and the vector part of q v (k, 4), computed from the components of v
    along the axis and perpendicular to it.
    """
    along = v @ axis
    part = along[:, None] * axis
    across = about(axis, angle / 2).apply(v - part)
    real = -np.sin(angle / 2) * along
    return np.column_stack([real, np.cos(angle / 2)[:, None] * part + across])


# --- Numbers --------------------------------------------------------------------------------------

PRODUCTS = """([code, data, asked]) => {
  const {products} = new Function(code + "return $rotation_explorer")();
  return asked.map(([angle, tilt]) => {
    const {v, q, left, whole} = products(data, angle, tilt);
    return [...v, ...q, ...left, ...whole];
  });
}"""


@pytest.mark.parametrize(
    ("axis", "v"),
    [(AXIS, V), ([0, 0, 1], [0, 0, 3.0]), (np.array([1, -2, 2]) / 3, [-0.05, 0.4, 0.3])],
    ids=["oblique", "v on the axis", "another"],
)
def test_products_match_scipy(browser, axis, v):
    data, rng = explorer(axis=axis, v=v).data, np.random.default_rng(3)
    angle = np.append(rng.uniform(0, 4 * np.pi, 1000), [0, np.pi, 2 * np.pi, 4 * np.pi])
    tilt = np.append(rng.uniform(0, 2 * np.pi / 3, 1000), [0, np.pi / 2, 0, np.pi / 2])
    page = browser.new_page()
    asked = np.column_stack([angle, tilt]).tolist()
    got = np.array(page.evaluate(PRODUCTS, [script("rotation_explorer"), data, asked]))
    page.close()
    n, at = np.array(data["axis"]), vector(data, tilt)
    halves = np.column_stack([np.cos(angle / 2), np.outer(np.sin(angle / 2), n)])
    whole = np.column_stack([0 * angle, about(n, angle).apply(at)])
    wanted = np.column_stack([at, halves, one_side(n, angle, at), whole])
    assert got.shape == wanted.shape == (1004, 15)
    np.testing.assert_allclose(got, wanted, rtol=0, atol=4e-12 * max(1, data["length"]))
    opening = vector(data, np.array(data["angles"][1:]))[0]
    np.testing.assert_allclose(opening, v, rtol=0, atol=1e-9 * data["length"])


def test_page_shows_numbers_that_match_scipy(opened):
    shown = opened(explorer())
    for angle, tilt in ((70, None), (200, 30), (359, 90), (0, 75), (360, 60), (501, 119), (720, 0)):
        shown.type("θ", angle)
        if tilt is not None:
            shown.type("φ", tilt)
        tells(shown, shown.look())


def tells(shown, seen):
    """Assert that the table, the real part, the sentence, the accessible name and the code agree
    with SciPy at the angles of the sliders.
    """
    angle, tilt = (np.array([float(seen.told[name].rstrip(" °"))]) for name in "θφ")
    if tilt == 53.1:
        tilt = np.array([np.arccos(0.6) / deg])
    v = vector(shown.data, tilt * deg)
    left = one_side(AXIS, angle * deg, v)[0]
    whole = about(AXIS, angle * deg).apply(v)[0]
    half = angle[0] * deg / 2
    q = [np.cos(half), *(np.sin(half) * AXIS)]
    rows = [[float(cell) for cell in row[1:]] for row in seen.rows]
    for found, wanted, off in zip(
        rows,
        (q, [0, *v[0] / mm], left / mm, [0, *whole / mm]),
        (6e-4, 0.06, 0.06, 0.06),
        strict=True,
    ):
        assert found == pytest.approx(wanted, abs=off)
    big = shown.rk.locator(".rk-real b").inner_text().replace("−", "-")
    assert float(big.removesuffix(" mm")) == rows[2][0]
    name = shown.rk.locator(".rk-scene").get_attribute("aria-label").replace("−", "-")
    assert f"q v: real part {rows[2][0]:.1f}, vector part" in name
    assert seen.says.replace("−", "-") in name
    assert ", ".join(f"{x:.1f}" for x in rows[3][1:]) in name
    if "Perpendicular" in seen.says:
        turned = re.findall(r"by (\S+)°", seen.says)
        assert [float(x) for x in turned] == pytest.approx([angle[0] / 2, angle[0]], abs=0.051)
    space = shown.code(seen)
    assert space["q"] @ space["v"] == pytest.approx(whole, abs=1e-5)
    return angle[0], tilt[0], rows


# --- Input ----------------------------------------------------------------------------------------


def test_dragging_a_ring_around_the_axis_rotates_v(opened):
    shown = opened(explorer(250 * deg))
    opposite = np.array(shown.look().handles["angle"]["at"])
    shown.type("θ", 70)
    start = np.array(shown.look().handles["angle"]["at"])
    centre, radius = (start + opposite) / 2, (start - opposite) / 2
    stops = [
        centre + about([0, 0, 1], [-k * 30 * deg]).apply([*radius, 0])[0, :2] for k in range(1, 13)
    ]
    seen = []
    shown.drag("angle", *stops, each=lambda now, _: seen.append(tells(shown, now)[0]))
    assert (np.diff(seen) > 0).all() and seen[-1] > 300, (
        "the angle does not follow the ring around the axis"
    )
    assert all(angle == round(angle) for angle in seen)


def test_real_part_is_zero_if_v_is_perpendicular_to_the_axis(opened):
    shown = opened(explorer())
    start = np.array(shown.look().handles["tilt"]["at"])
    seen = shown.drag("tilt", start + [-5, 40], start + [-25, 80], start + [-60, 130])
    assert tells(shown, seen)[1] > 80
    shown.type("φ", 90)
    for angle in (10, 123, 340, 600):
        shown.type("θ", angle)
        seen = shown.look()
        assert tells(shown, seen)[2][2][0] == 0 and "the real part is 0 for every θ" in seen.says


def test_keys_change_both_angles(opened):
    shown = opened(explorer())
    shown.press("angle", "ArrowRight", "ArrowUp", "Shift+ArrowLeft")
    shown.press("tilt", "Shift+ArrowRight", "ArrowDown")
    seen = shown.look()
    assert seen.told == {"θ": "62.0 °", "φ": "62.1 °"}
    assert "θ 62.0°" in seen.handles["angle"]["name"] and "φ 62.1°" in seen.handles["tilt"]["name"]
    shown.press("angle", "Home")
    shown.press("tilt", "Home")
    assert shown.look().told == {"θ": "70.0 °", "φ": "53.1 °"}
    shown.press("angle", *["Shift+ArrowLeft"] * 8)
    assert shown.look().told["θ"] == "0.0 °"


def test_special_angles_are_explained(opened):
    shown = opened(explorer())
    for angle, tilt, words in (
        (0, 60, "q is 1: both products are v."),
        (720, 60, "q is 1: both products are v."),
        (360, 60, "q is −1: q v is −v, but q v q* is v."),
        (77, 0, "v lies on the axis n, so q v q* is v for every θ."),
        (77, 90, "v is perpendicular to n, so the real part is 0 for every θ."),
    ):
        shown.type("θ", angle)
        shown.type("φ", tilt)
        seen = shown.look()
        tells(shown, seen)
        assert words in seen.says.replace("\xa0", " "), (angle, tilt)


def test_lengths_have_a_unit_and_products_are_not_broken(opened):
    """The numbers of q have no unit. A line that ends after "q v" would name another product."""
    shown = opened(explorer())
    rows = [row[0].replace("\xa0", " ") for row in shown.look().rows]
    assert rows == ["q", "v, mm", "q v, mm", "q v q*, mm"]
    for node in shown.rk.locator("th, .rk-says, .rk-meant").all():
        assert "q v" not in node.inner_text() and "v q*" not in node.inner_text()


def test_view_has_alt_text_and_fits_on_screen_and_paper(opened, browser):
    made = explorer()
    assert made.data["alt"] in made.html and made.still.alt == made.data["alt"] == repr(made)
    assert "real part −34.4, vector part (81.9, 45.9, 0.0) mm. q v q*: (57.9, 75.2, 31.6)" in repr(
        made
    )
    assert len(made.html) < 56_000 and "NaN" not in json.dumps(made.data)
    for width in (914, 390):
        narrow = browser.new_context(viewport={"width": width, "height": 900})
        narrow.add_init_script(test_explorers.WATCH)
        shown = opened(made, within=narrow)
        seen, box = shown.look(), shown.rk.bounding_box()
        assert box["width"] <= width and (width == 390 or box["height"] <= 560), box
        assert all(word in seen.words[0].split("|") for word in ("v", "q v", "q v q*", "n"))
        shown.page.emulate_media(media="print")
        assert shown.look().rows == seen.rows
        assert shown.rk.locator(".rk-handle:visible").count() == 2  # as on the screen
        boxes = shown.rk.locator("input:visible")
        assert boxes.count() == shown.rk.locator(".rk-slide input[type=number]").count() > 0
        narrow.close()


# --- Invalid calls --------------------------------------------------------------------------------


def test_invalid_calls_are_refused():
    two = np.array([V, V])
    for given, words in (
        (dict(angle=-0.1), "angle: wanted 0 to 4 pi"),
        (dict(angle=13), "angle: wanted 0 to 4 pi"),
        (dict(angle=[1, 2]), "angle: wanted"),
        (dict(axis=[0, 0, 2]), "axis: wanted one unit vector, got"),
        (dict(axis=np.eye(3)), "axis: wanted one unit vector"),
        (dict(v=two), "v: wanted one vector"),
        (dict(v=[0, 0, 0]), "v: wanted one vector"),
        (dict(v=[1e300, 0, 0]), "v: wanted one vector"),
        (dict(v=-V), "v: wanted a vector at most 120° away from the axis, got 126.9°"),
        (dict(v="up"), "v: wanted"),
    ):
        with pytest.raises(ValueError, match=f"^{re.escape(words)}"):
            explorer(**given)
    for axis, v in itertools.product(np.eye(3), np.eye(3)):
        data = explorer(axis=axis, v=v).data
        assert np.dot(data["axis"], data["across"]) == pytest.approx(0, abs=1e-12)
