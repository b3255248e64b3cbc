"""The letters of the tool's axes: each is at the end of its own axis or has a line to it, and none
is left out while there is room.
"""

import numpy as np
import pytest
import test_player
from canvas_words import LINES, MOVE, NEXT, RECORD
from test_clear_pictures import LEVERS, PHONE, shown
from test_clear_rings import tour

from robokin import IRB140, SCARA, ScaraPose, deg, mm, turning_base
from robokin.show import joint_explorer, target_explorer
from robokin.show.palette import PAGE

page = test_player.page
WIDTHS = [PHONE[0], 914]
AXES = {PAGE[name][0].lower(): name for name in "xyz"}


def scara():
    return joint_explorer(SCARA, [40 * deg, 60 * deg, -70 * deg, 120 * mm])


def opening_of_lab_4():
    """No axis lies behind another."""
    return joint_explorer(SCARA, [40 * deg, 60 * deg, -15 * deg, 120 * mm])


def bent():
    return joint_explorer(turning_base(LEVERS), np.array([0, 100, 110, 120]) * deg)


def irb140():
    return joint_explorer(IRB140)


def circled():
    return target_explorer(SCARA, ScaraPose([0.25, 0, 0.2]), zone=True)


def seen(page):
    """The tool's axes, as a dict from letters to begin and end, and the letters, as a dict from
    letters to centres, in px.
    """
    lines = page.evaluate("document.querySelector('canvas').lines")
    ends = [
        (line["width"], AXES[line["color"]], np.array(line["points"], float))
        for line in lines
        if line["color"] in AXES and line["width"] != 1.4 and len(line["points"]) == 2
    ]
    tool = {name: points for width, name, points in ends if width == 3}
    words = {
        word["text"]: np.array(word["box"][:2]) + np.array(word["box"][2:]) / 2
        for word in page.evaluate("canvasWords()[0].words")
        if word["text"] in ("x", "y", "z") and word["size"] > 11
    }
    return tool, words


def led(page, name, centre, end):
    """Whether a thin line in the colour of an axis leads from its letter to its end."""
    return any(
        AXES.get(line["color"]) == name
        and line["width"] == 1
        and np.linalg.norm(line["points"][0] - centre) < 13
        and np.linalg.norm(line["points"][1] - end) < 7
        for line in page.evaluate("document.querySelector('canvas').lines")
    )


def aside(place, line):
    """The distance of a place from a line."""
    begin, end = line
    way = end - begin
    share = np.clip((place - begin) @ way / max(way @ way, 1e-9), 0, 1)
    return np.linalg.norm(place - begin - share * way)


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("view", [irb140, scara, bent])
def test_letter_is_beyond_the_end_of_its_axis_and_nearest_to_this_axis(page, tmp_path, view, width):
    """It is left out if there is no room: a letter elsewhere would name another line."""
    shown(page, view(), tmp_path, width, "min", "none", RECORD, LINES)
    letters = 0
    for place in range(12):
        page.evaluate(MOVE, [place, 12])
        page.evaluate(NEXT)
        tool, words = seen(page)
        assert len(tool) == 3
        letters += len(words)
        for name, centre in words.items():
            begin, end = tool[name]
            far = np.linalg.norm(centre - end)
            assert far < 24 or far < 60 and led(page, name, centre, end), (place, name)
            assert (centre - end) @ (end - begin) > 0
            far = {other: aside(centre, line) for other, line in tool.items()}
            assert min(far, key=far.get) == name, (place, name, far)
    assert letters > 12


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize(
    ("view", "slider", "wanted"),
    [
        (scara, "none", "xz"),
        (opening_of_lab_4, "none", "xyz"),
        (bent, "q4", "xy"),
        (bent, "none", "xy"),
    ],
)
def test_letter_is_drawn_where_there_is_room_near_the_end(
    page, tmp_path, view, slider, wanted, width
):
    """Also at the edge of the picture and beyond a joint or a ring at the end of the axis."""
    shown(page, view(), tmp_path, width, "max", slider, RECORD, LINES)
    _, words = seen(page)
    assert set(wanted) <= set(words)


@pytest.mark.parametrize(
    ("view", "slider", "end", "letter", "width"),
    [
        *((opening_of_lab_4, "q2", "min", "z", width) for width in WIDTHS),
        (irb140, "q3", "min", "y", 914),
        (circled, "angle", "min", "x", 914),
    ],
)
def test_letter_without_room_near_the_end_is_farther_away_and_has_a_line_to_it(
    page, tmp_path, view, slider, end, letter, width
):
    """Also where a joint or a ring with another letter is at the end."""
    shown(page, view(), tmp_path, width, end, slider, RECORD, LINES)
    tool, words = seen(page)
    assert led(page, letter, words[letter], tool[letter][1])


def test_axis_with_its_letter_in_a_ring_at_its_end_has_no_second_letter(page, tmp_path):
    shown(page, circled(), tmp_path, WIDTHS[1], "none", "angle", RECORD, LINES)
    _, words = seen(page)
    assert not words


@pytest.mark.parametrize("width", WIDTHS)
def test_axis_below_the_ring_of_a_tour_has_no_letter(page, tmp_path, width):
    shown(page, tour(), tmp_path, width, "max", "time", RECORD, LINES)
    _, words = seen(page)
    assert set(words) == {"x"}
