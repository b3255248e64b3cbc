"""The words of a player's panels and table are next to what they name, and say what is true."""

import itertools
import re

import numpy as np
import pytest
import test_player
from canvas_words import LINES, NEXT, RECORD
from conftest import awake
from test_clear_pictures import PHONE, RINGS, TO_END, TO_VALUES, shown

from robokin import (
    IRB140,
    PUMA560,
    SCARA,
    ScaraPose,
    blend,
    deg,
    differentiate,
    follow,
    spbu_arm,
    two_link,
)
from robokin.show import animate, elbow_explorer, joint_explorer, plot_joints
from robokin.show.palette import PAGE

page = test_player.page
ARM = two_link(2.5, 2.5)


def teeth():
    """Joint 1 of one arm jumps where t² is a whole number, as in lab 12."""
    t = np.linspace(1, 3.5, 500)
    smooth = np.stack([2 - 0.4 * t, 0.4 * t - 2.5], axis=-1)
    jumping = smooth - np.outer(0.1 * (t**2 % 1), [1, 0])
    return animate([ARM] * 2, t, [jumping, smooth], names=["with (int)", "with double"])


@pytest.mark.parametrize("width", [*PHONE, 1366])
def test_text_of_a_jump_is_beside_its_line(page, tmp_path, width):
    """Where there is no room for the name of the arm, it is left out: the sentence above has it."""
    shown(page, teeth(), tmp_path, width, "none", "none", LINES, RECORD)
    [lines, words] = page.evaluate(
        "[document.querySelectorAll('canvas')[1].lines, canvasWords()[1].words]"
    )
    alarm = PAGE["alarm"][0].lower()
    marks = [line["points"][0][0] for line in lines if line["color"] == alarm and line["dash"]]
    texts = [word for word in words if "jumps by" in word["text"]]
    assert len(texts) == 3
    for word, x in zip(texts, marks, strict=False):
        left, _, wide, _ = word["box"]
        assert 5 < max(left - x, x - left - wide) < 7, word["text"]
    assert texts[0]["text"].startswith("with (int): ") or width < 390


@pytest.mark.parametrize("width", [*PHONE, 900])
def test_size_of_a_jump_is_at_its_line_even_without_room_for_words(page, tmp_path, width):
    t = np.linspace(0, 20, 1001)
    stations = ScaraPose([(0.2, 0.3, 0.12), (0.4, 0.1, 0), (0.2, -0.2, 0.2)], [0, np.pi, np.pi / 2])
    q = follow(SCARA, SCARA.ik(blend(*stations, 0, t / 20)), SCARA.branch(+1))
    plot = plot_joints(SCARA, t, q, differentiate(q, t))
    page.add_init_script(RECORD)
    page.set_viewport_size({"width": width, "height": 900})
    (tmp_path / "view.html").write_text(
        f"<!doctype html><meta charset=utf-8>{plot._repr_mimebundle_()['text/html']}"
    )
    page.goto((tmp_path / "view.html").as_uri())
    awake(page)
    page.wait_for_function("canvasWords()[0]?.words.length > 0")
    texts = [word["text"] for word in page.evaluate("canvasWords()[0].words")]
    near = np.array([10 - 2e-6, 10 - 1e-6, 10, 10 + 1e-6])
    before = follow(SCARA, SCARA.ik(blend(*stations, 0, near / 20)), SCARA.branch(+1))[:, 2]
    slopes = np.diff(before) / np.diff(near) / deg
    size = f"{abs(slopes[2] - slopes[1]):.1f} °/s"
    assert [text for text in texts if text.endswith(size)] == [
        "speed jumps by " * (width == 900) + size
    ]


def counting(arms=1):
    """Arms that turn at a constant speed, of two, and count their turns by 0.1 rad."""
    t = np.linspace(0, 2, 401)
    turned = np.outer([0.75, 1], t)
    q = np.stack([turned, -turned], axis=-1)
    numbers = {"count": np.floor(10 * turned + 1e-9), "turned, rad": turned}
    return animate(
        [ARM] * arms,
        t,
        [q] * arms,
        joints=[],
        slider=("speed", [0.75, 1]),
        quantities={name: [each] * arms if arms > 1 else each for name, each in numbers.items()},
    )


def test_counts_have_steps_and_other_quantities_do_not(page, tmp_path):
    """A count of 2.6 does not exist: the dot is at a whole number, too."""
    count, turned = counting().data["quantities"]
    assert (count["steps"], turned["steps"]) == (True, False)
    t = np.array(counting().data["times"])
    [numbers] = count["values"]
    found = test_player.unpacked(numbers, 1, len(t))[..., 0]
    assert found.tolist() == np.floor(np.outer([7.5, 10], t) + 1e-9).tolist(), "inexact counts"
    shown(page, counting(), tmp_path, 900, "max", "speed", LINES, RINGS)
    for panel, whole in (("count", True), ("turned, rad", False)):
        page.get_by_label("large panel").select_option(panel)
        for tick in (3, 77, 151, 222, 299, 371):
            page.evaluate(TO_VALUES, {"time": tick})
            page.evaluate(NEXT)
            [lines, spots] = page.evaluate(
                "(({lines, spots}) => [lines, spots])(document.querySelectorAll('canvas')[1])"
            )
            # the faint curve of the opening motion is thinner
            curves = [line["points"] for line in lines if len(line["points"]) > 20]
            assert len(curves) == 4, "two panels, two curves each"
            large = curves[:2] if whole else curves[2:]
            for points in large:
                moves = np.diff(points, axis=0)
                assert ((moves == 0).any(axis=1).all()) == whole
            points = np.array(large[1])
            x, y, _ = [spot for spot in spots if spot[2] == 4][0 if whole else 1]
            if whole:
                assert y == points[points[:, 0] <= x][-1, 1]
            else:
                assert y == pytest.approx(np.interp(x, *points.T), abs=0.01)


@pytest.mark.parametrize(("arms", "faint"), [(1, 2), (2, 4), (3, 0)])
def test_no_faint_curves_among_those_of_many_arms(page, tmp_path, arms, faint):
    shown(page, counting(arms), tmp_path, 900, "max", "speed", LINES, RECORD)
    [lines, words] = page.evaluate(
        "[document.querySelectorAll('canvas')[1].lines, canvasWords()[1].words]"
    )
    curves = [line for line in lines if len(line["points"]) > 20]
    assert len(curves) == 2 * arms + faint
    told = "faint: the opening motion" in [word["text"] for word in words]
    assert told == (faint > 0)


@pytest.mark.parametrize("width", [390, 352, 336, 324])
def test_limit_is_named_also_where_there_is_little_room(page, tmp_path, width):
    """Three limits; the curves of joints 5 and 6 run along that of joint 5."""
    t = np.linspace(0, 20, 201)
    times = [0, 5, 10, 15, 20]
    angles = [[15, 55, 75, 65, 55], [40, 8, -25, -30, -40], [60, 40, 0, -12, -30]]
    angles += [[-180, -160, -137, -121, -97], [112, 110, 98, 78, 54], [165, 130, 118, 120, 103]]
    q = np.stack([np.interp(t, times, each) for each in angles], axis=-1) * deg
    shown(page, animate(IRB140, t, q), tmp_path, width, "none", "none", RECORD)
    texts = [w["text"] for w in page.evaluate("canvasWords()[1].words") if w["size"] == 10]
    named = {text.split()[0] for text in texts if re.match(r"q\d .*°$", text)}
    assert named == {"q3", "q4", "q5"}


@pytest.mark.parametrize("size", [-302.1, -180.5, -20, 179, 302.1, 360])
def test_jump_by_more_than_half_a_turn_has_its_short_way(size):
    """A wrapped angle may jump by almost a whole turn where the arm moves little."""
    t = np.linspace(0, 2, 401)
    q = np.outer(t > 1.001, [0, 1]) * size * deg
    [note] = animate(ARM, t, q).data["arms"][0]["notes"]["0"][-1:]
    by, *short = map(float, re.findall(r"([\d.]+)°", note))
    turn = np.exp(1j * q[-1, 1])
    assert by == pytest.approx(abs(size)) and bool(short) == (abs(size) > 180)
    assert not short or short == [pytest.approx(abs(np.angle(turn, deg=True)), abs=0.05)]


def test_table_says_that_jumps_in_position_are_left_out():
    t = np.linspace(0, 2, 401)
    steady = np.outer(t, [0.1, 0.2])
    leaping = steady + np.outer(t > 1.001, [0, 1])
    said = [animate(ARM, t, q).data["sampled"] for q in (steady, leaping)]
    assert said[1] == said[0] + ", without the jumps in position"
    assert animate([ARM] * 2, t, [steady, leaping]).data["sampled"] == said[1]


@pytest.mark.parametrize("width", [*PHONE, 352, 620, 700, 820, 860, 900])
@pytest.mark.parametrize("view", [elbow_explorer, joint_explorer])
@pytest.mark.parametrize("arm", [IRB140, PUMA560, spbu_arm(5, 4)])
def test_numbers_with_names_are_neither_cut_off_nor_broken(page, tmp_path, arm, view, width):
    """At 352 px, a view is as wide as in a lab on a phone of 390 px."""
    names = ["r", "z"] if view is elbow_explorer else [f"q{j + 1}" for j in range(len(arm.links))]
    shown(page, view(arm), tmp_path, width, "none", "none")
    for end, name in [("none", "none"), *itertools.product(("min", "max"), names)]:
        page.evaluate(TO_END, [end, name])
        page.evaluate("() => new Promise(requestAnimationFrame)")
        tables = page.evaluate(
            """[...document.querySelectorAll(".rk-few, .rk-elbow .rk-table")].map(table => [
              table.scrollWidth - table.clientWidth,
              ...[...table.querySelectorAll("td")].map(cell => {
                const range = document.createRange();
                range.selectNodeContents(cell);
                return new Set([...range.getClientRects()].map(box => box.top)).size;
              }),
            ])"""
        )
        for over, *lines in tables:
            assert over == 0 or width == 324, (over, end, name)
            assert max(lines) == 1, (end, name)
