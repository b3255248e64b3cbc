"""Nothing in the figures of the predictions hides a word."""

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text
from test_clear_letters import aside

from robokin import IRB140, deg
from robokin.course import book
from robokin.show import Sketch, plot_postures
from robokin.show.palette import AXIS_COLORS, GRID


def struck(figure):
    """The words of a figure that a line goes through, apart from the floor's grid and from words
    on paper of their own.
    """
    figure.canvas.draw()
    found = []
    for ax in figure.axes:
        curves = [
            line.get_transform().transform(np.stack(line.get_data(), axis=-1).astype(float))
            for line in ax.lines
            if line.get_linestyle() != "None" and line.get_color() != GRID
        ]
        for text in ax.texts:
            if not text.get_text().strip() or text.get_bbox_patch():
                continue
            left, low, right, high = Text.get_window_extent(text).extents
            if any(inside(curve, (left + 1, low + 2), (right - 1, high - 2)) for curve in curves):
                found.append(text.get_text())
    return found


def inside(curve, low, high):
    """Whether a polyline (k, 2) goes through a box."""
    begin, way = curve[:-1], np.diff(curve, axis=0)
    points = begin + np.linspace(0, 1, 100)[:, None, None] * way
    return bool(np.any(np.all((points > low) & (points < high), axis=-1)))


@pytest.mark.parametrize("lab", book.labs())
def test_no_line_goes_through_a_word_of_a_figure(lab):
    views = {number: each.view() for number, each in book.labs()[lab].predictions.items()}
    figures = {number: view for number, view in views.items() if isinstance(view, Figure)}
    assert {number: words for number, view in figures.items() if (words := struck(view))} == {}


def test_line_stops_at_a_word_of_a_sketch():
    sketch = Sketch("A link on the floor.")
    sketch.levers([(0.3, 0.2), (0, 0), (0.3, 0)], ["", "O1", "O2"])
    sketch.ax.axhline(0, color="red", lw=2, zorder=1)
    sketch.canvas.draw()
    picture = np.asarray(sketch.canvas.buffer_rgba())[::-1].astype(int)
    red = (picture[..., 0] > 200) & (picture[..., 1] < 120)
    assert red.sum() > 100
    for text in sketch.ax.texts[1:]:
        left, low, right, high = np.round(Text.get_window_extent(text).extents).astype(int)
        assert right - left > 10 and not red[low + 1 : high - 1, left + 1 : right - 1].any()


@pytest.mark.parametrize("joint", range(6))
def test_first_and_last_posture_are_named_where_they_differ(joint):
    """Also if only the wrist moves; joint 6 moves no point of the arm."""
    q = np.zeros((21, 6))
    q[:, 4] = 30 * deg
    q[:, joint] += np.linspace(0, 60, 21) * deg
    figure = plot_postures(IRB140, q)
    figure.canvas.draw()
    centres = {
        text.get_text(): Text.get_window_extent(text).get_points().mean(axis=0)
        for text in figure.axes[0].texts
    }
    letters = [centres[each] for each in "xyz" if each in centres]
    assert len(letters) >= 2
    assert ("first" in centres) == ("last" in centres) == (joint < 5)
    if joint in (3, 4):
        for name in ("first", "last"):
            assert np.linalg.norm(centres[name] - letters, axis=-1).min() < 120


@pytest.mark.parametrize("swing", [-60, -30, 45, 60, 90])
def test_letters_are_at_the_axes_of_the_last_posture(swing):
    """The frame of the first posture has no letters, and is as near."""
    q = np.zeros((41, 6))
    q[:, 4] = np.linspace(0, swing, 41) * deg
    figure = plot_postures(IRB140, q)
    figure.canvas.draw()
    [ax] = figure.axes
    for letter, color in zip("xyz", AXIS_COLORS, strict=True):
        first, last = (
            line.get_transform().transform(np.stack(line.get_data(), axis=-1))
            for line in ax.lines
            if line.get_color() == color
        )
        for text in ax.texts:
            if text.get_text() == letter:
                place = Text.get_window_extent(text).get_points().mean(axis=0)
                assert aside(place, last) < min(36, aside(place, first)), letter
                assert (place - last[1]) @ (last[1] - last[0]) > 0, letter


def test_two_postures_with_one_flange_are_told_apart():
    rows = IRB140.ik(IRB140.fk(np.array([0, 20, -30, 20, 40, 0]) * deg))
    names = [
        {text.get_text() for text in plot_postures(IRB140, rows[::2][:count]).axes[0].texts}
        for count in (1, 2, 4)
    ]
    assert [{"first", "last"} <= each for each in names] == [False, True, False]
