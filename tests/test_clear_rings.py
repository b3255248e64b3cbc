"""A ring away from its point has a visible line to it; the ring of a target is on the target."""

import numpy as np
import pytest
import test_player
from canvas_words import NEXT, contrast, rgb
from test_clear_pictures import RINGS, TO_END, shown

from robokin import IRB140, Quaternion, Transform, deg
from robokin.jobs.visit_collect import Task
from robokin.show import target_explorer, tour_explorer

page = test_player.page
# For each ring: its classes, its centre (px), the end of its line (null without one), the place
# where the line begins as a distance from the centre, and the line's colour
LED = """() => [...document.querySelectorAll(".rk-handle")]
  .filter(node => node.checkVisibility())
  .map(node => {
    const [own, after] = [getComputedStyle(node), getComputedStyle(node, "::after")];
    const [x, y] = own.transform.match(/[^,(]+/g).slice(-2).map(parseFloat);
    const [, a, b, , , e, f] = (after.transform.match(/[^,(]+/g) ?? []).map(parseFloat);
    const long = after.content !== "none" && Math.hypot(a, b) >= 1;
    return {
      looks: node.className.split(" "), centre: [x, y], color: after.borderTopColor,
      end: long ? [x + e + a, y + f + b] : null, begin: Math.hypot(e, f),
    };
  })"""
SPOTS = "document.querySelector('canvas').spots"


def tour():
    points = [[2.16, 3.37, 2], [1.81, -3.56, 2], [1.45, -3.73, 2], [1.07, -3.85, 2]]
    task = Task(5, 4, T=7.5, speeds=[0.2] * 3, p0=[4, 0, 2], points=points, kind="visit")
    return tour_explorer(task)


@pytest.mark.parametrize("end", ["min", "max"])
@pytest.mark.parametrize("width", [390, 324])
def test_ring_far_from_its_point_has_a_line_to_it(page, tmp_path, width, end):
    shown(page, tour(), tmp_path, width, end, "time", RINGS)
    led = [ring for ring in page.evaluate(LED) if ring["end"]]
    spots = [spot[:2] for spot in page.evaluate(SPOTS)]
    assert len(led) >= 2
    for ring in led:
        assert np.linalg.norm(np.subtract(spots, ring["end"]), axis=-1).min() < 1.5
        assert 12 < ring["begin"] < 14, "the line begins in the ring"


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_line_of_a_filled_ring_is_seen_on_the_paper(page, tmp_path, theme):
    page.emulate_media(color_scheme=theme)
    shown(page, tour(), tmp_path, 390, "max", "time")
    rings = page.evaluate(LED)
    led = [ring for ring in rings if ring["end"] and "rk-served" in ring["looks"]]
    paper = page.evaluate(
        "getComputedStyle(document.querySelector('canvas')).getPropertyValue('--rk-paper')"
    )
    assert len(led) >= 2
    for ring in led:
        assert contrast(rgb(ring["color"]), rgb(paper.strip())) > 4.5


def turned_target():
    turn = Quaternion.from_angle_axis(90 * deg, [0, 1, 0])
    return target_explorer(IRB140, Transform(turn, [0.35, 0.15, 0.75]))


def moved_target():
    turn = Quaternion.from_roll_pitch_yaw(-30 * deg, 15 * deg, -15 * deg)
    return target_explorer(IRB140, Transform(turn, [0.25, -0.05, 0.95]))


@pytest.mark.parametrize("width", [390, 324, 900])
@pytest.mark.parametrize("name", ["x", "y", "z"])
@pytest.mark.parametrize("view", [turned_target, moved_target])
def test_ring_of_a_target_stands_on_it_and_no_line_ends_in_blank_paper(
    page, tmp_path, view, name, width
):
    """Nothing is drawn where an arrow or an arc would be without the other rings."""
    shown(page, view(), tmp_path, width, "none", name, RINGS)
    for end in ("min", "max"):
        page.evaluate(TO_END, [end, name])
        page.evaluate(NEXT)
        rings, spots = page.evaluate(LED), [spot[:2] for spot in page.evaluate(SPOTS)]
        [free] = [ring["centre"] for ring in rings if "rk-free" in ring["looks"]]
        assert np.linalg.norm(np.subtract(spots, free), axis=-1).min() < 1, end
        assert len(rings) > 3 and not any(ring["end"] for ring in rings), end
