"""Nothing that is drawn hides a number, a letter or the directions of the base, on a phone and with
all sliders at their ends. `test_fit.py` tests this for the words of whole labs.
"""

import numpy as np
import pytest
import test_player
from canvas_words import COVERED, LINES, NEXT, RECORD, faults
from conftest import awake

from robokin import (
    IRB140,
    ITMO6R,
    PUMA560,
    SCARA,
    Quaternion,
    Transform,
    deg,
    follow,
    lin,
    linear,
    loader_arm,
    mm,
    ptp,
    quintic,
    three_lever,
    turning_base,
)
from robokin.jobs.steppers import Stepper
from robokin.show import (
    animate,
    clearance_explorer,
    elbow_explorer,
    joint_explorer,
    motor_explorer,
    movement_explorer,
    paths_explorer,
    rotation_explorer,
)
from robokin.show.palette import PAGE

page = test_player.page
PHONE = 390, 324  # px: the page of a view; one whose view is as narrow as that of a lab
LEVERS = three_lever(1.0)
# Moves sliders to values
TO_VALUES = """values => {
  for (const slider of document.querySelectorAll("input[type=range]")) {
    const value = values[slider.ariaLabel.split(",")[0]];
    if (value === undefined) continue;
    slider.value = value;
    slider.dispatchEvent(new Event("input", {bubbles: true}));
  }
}"""
# `canvas.rings`: the centres of the rings on paths, and `canvas.spots`: the centres and radii of
# all discs, in the last picture
RINGS = """{
  const pen = CanvasRenderingContext2D.prototype, {clearRect, arc} = pen;
  pen.clearRect = function (...all) {
    this.canvas.rings = [];
    this.canvas.spots = [];
    return clearRect.apply(this, all);
  };
  pen.arc = function (x, y, r, ...more) {
    if (r === 4.5) this.canvas.rings.push([x, y]);
    this.canvas.spots.push([x, y, r]);
    return arc.call(this, x, y, r, ...more);
  };
}"""
# Moves all sliders whose name begins with a text to the same end
TO_END = """([end, name]) => {
  for (const slider of document.querySelectorAll("input[type=range]"))
    if (slider.checkVisibility() && slider.ariaLabel.startsWith(name)) {
      slider.value = slider[end];
      slider.dispatchEvent(new Event("input", {bubbles: true}));
    }
}"""


def shown(page, view, tmp_path, width, end, name, *scripts):
    """Open a view on a phone, with all sliders whose name begins with `name` at one end."""
    for script in scripts:
        page.add_init_script(script)
    page.set_viewport_size({"width": width, "height": 900})
    view.save(tmp_path / "view.html")
    page.goto((tmp_path / "view.html").as_uri())
    awake(page)
    page.evaluate(TO_END, [end, name])
    page.evaluate(NEXT)
    return page


def two_tasks():
    """Two arms, one above the other, whose tools begin near the lower right corner."""
    t = np.linspace(0, 3, 61)
    begin = np.array([60, 120, 120]) * deg
    first = LEVERS.least((2.4, 0.4), begin)[0]
    ends = [first, LEVERS.least((-2.1, 1.2), first)[0]]
    q = np.stack([ptp(begin, end, t / 3) for end in ends])
    watched = {"turned so far, °": [np.zeros(q.shape[:2])] * 2}
    return animate([LEVERS] * 2, t, [q, q], slider=("end", [0, 1]), joints=[], quantities=watched)


def turned():
    """The tip of v is in the lower right corner."""
    return rotation_explorer(0, axis=(-0.8, -0.6, 0), v=(0.09, -0.02, -0.08))


def chain():
    return joint_explorer(turning_base(LEVERS), np.array([0, 100, 110, 120]) * deg)


@pytest.mark.parametrize("end", ["min", "max"])
@pytest.mark.parametrize("width", PHONE)
@pytest.mark.parametrize("view", [two_tasks, chain, turned])
def test_directions_of_the_base_are_apart_from_the_arm(page, tmp_path, view, width, end):
    shown(page, view(), tmp_path, width, end, "", LINES)
    lines = page.evaluate("document.querySelector('canvas').lines")
    axes = [PAGE[name][0].lower() for name in "xyz"]
    corners = [
        line["points"][0] for line in lines if line["width"] == 1.4 and line["color"] in axes
    ]
    assert corners, "the directions are not drawn"
    drawn = np.concatenate([along(line) for line in lines if line["width"] >= 1.8])
    assert len(drawn) > 100
    for corner in corners:
        assert np.linalg.norm(drawn - corner, axis=-1).min() > 30


def along(line):
    """Points on a line (k, 2)."""
    points = np.array(line["points"], float).reshape(-1, 2)
    shares = np.linspace(0, 1, 20)[:, None, None]
    return (points[:-1] + shares * np.diff(points, axis=0)).reshape(-1, 2)


@pytest.mark.parametrize("end", ["min", "max"])
@pytest.mark.parametrize("width", PHONE)
def test_no_joint_axis_goes_through_the_scale(page, tmp_path, width, end):
    shown(page, joint_explorer(ITMO6R), tmp_path, width, end, "")
    page.evaluate(COVERED, ["^grid", [f"joint{j}" for j in range(1, 7)]])
    page.evaluate(TO_END, [end, ""])
    page.evaluate(NEXT)
    covered = page.evaluate("covered")
    assert covered and not any(pixels for _, pixels in covered), covered


def paths():
    return paths_explorer(
        loader_arm(0.45, 0.30), (0.6, -0.35, 0.05), (0.05, 0.25, 0.35), [10, 40, 40]
    )


@pytest.mark.parametrize("width", PHONE)
@pytest.mark.parametrize("end", ["min", "max"])
@pytest.mark.parametrize("goal", [(-320, 160, 640), (50, 250, 350), (200, 250, 100)])
def test_all_paths_are_in_the_picture_and_no_letter_stands_on_a_ring(
    page, tmp_path, goal, end, width
):
    shown(page, paths(), tmp_path, width, "min", "time", LINES, RECORD, RINGS)
    page.evaluate(TO_VALUES, dict(zip("xyz", goal, strict=True)))
    page.evaluate(NEXT)
    page.evaluate(TO_END, [end, "time"])
    page.evaluate(NEXT)
    canvas = page.evaluate(
        """() => {
          const canvas = document.querySelector("canvas");
          const {clientWidth: width, clientHeight: height, lines, rings} = canvas;
          return {width, height, lines, rings, words: canvasWords()[0].words};
        }"""
    )
    drawn = [line for line in canvas["lines"] if len(line["points"]) > 20 and line["width"] >= 2]
    assert len(drawn) == 3
    for line in drawn:
        points = np.array(line["points"])
        assert (points > 0).all() and (points < [canvas["width"], canvas["height"]]).all()
    letters = [word["box"] for word in canvas["words"] if word["text"] in ("a", "c", "d")]
    assert len(letters) == 3 and canvas["rings"]
    for left, top, wide, high in letters:
        for ring in canvas["rings"]:
            nearest = np.clip(ring, [left, top], [left + wide, top + high])
            assert np.linalg.norm(nearest - ring) > 4.5


def test_letter_of_a_handle_outside_the_picture_is_opaque(page, tmp_path):
    shown(page, paths(), tmp_path, PHONE[0], "max", "z")
    handle = page.locator(".rk-outside").first
    looks = handle.evaluate(
        """node => {
          const {backgroundColor} = getComputedStyle(node, "::before");
          return [getComputedStyle(node).opacity, backgroundColor];
        }"""
    )
    assert looks == ["1", "rgb(255, 255, 255)"]


def race(joints=None):
    """Two arms that start together, with two words at their tools."""
    t = np.linspace(0, 2, 41)
    begin, end = np.array([[63, 30, 15, -90, -63, -45], [-56, 20, 10, -60, -80, -20]]) * deg
    runs = [[ptp(begin, share * end, linear(time)(t)) for share in (0.6, 1)] for time in (1, 2)]
    tools = [IRB140.fk(np.array(run)).translation for run in runs]
    clock = np.broadcast_to(t, (2, 41))
    names = ["LIN", "PTP"]
    return animate(
        [IRB140] * 2,
        t,
        runs,
        names=names,
        bases=np.zeros((2, 2)),
        points={f"{name}, s": each for name, each in zip(names, tools, strict=True)},
        readings={f"{name}, s": clock for name in names},
        targets={"start": IRB140.fk(begin), "goal": IRB140.fk(end)},
        slider=("share", [0.6, 1]),
        quantities={"way, m": [each[..., 2] for each in tools]},
        joints=joints,
    )


@pytest.mark.parametrize("width", [*PHONE, 1366])
def test_line_from_a_word_to_its_point_goes_through_no_other_word(page, tmp_path, width):
    shown(page, race(), tmp_path, width, "min", "", LINES, RECORD, RINGS)
    [lines, words, spots] = page.evaluate(
        """() => {
          const {lines, spots} = document.querySelector("canvas");
          return [lines, canvasWords()[0].words, spots];
        }"""
    )
    tools = [spot[:2] for spot in spots if spot[2] == 3.6]
    soft = PAGE["soft"][0].lower()
    leaders = [line for line in lines if line["width"] == 1 and line["color"] == soft]
    assert [word["text"] for word in words if word["text"].endswith("0.00")], "no readings"
    assert leaders or width == 324, "no word is far from its point"
    for line in leaders:  # it ends at its point
        assert np.linalg.norm(np.subtract(tools, line["points"][-1]), axis=-1).min() < 6.1
    for left, top, wide, high in [word["box"] for word in words if word["box"][2]]:
        for x, y in np.concatenate([along(line) for line in leaders or ()] or [[[-1, -1]]]):
            assert not (left < x < left + wide and top < y < top + high)


@pytest.mark.parametrize("joints", [None, []])
def test_legend_has_the_lines_of_the_arms_and_names_the_faint_curves(page, tmp_path, joints):
    """Where dashes stand for joints, only its width tells which arm a line belongs to."""
    faint = "faint: the opening motion"
    shown(page, race(joints), tmp_path, 900, "min", "share", LINES, RECORD)
    for end, moved in (("min", False), ("max", True)):
        page.evaluate(TO_END, [end, "share"])
        page.evaluate(NEXT)
        [lines, words] = page.evaluate(
            "[document.querySelectorAll('canvas')[1].lines, canvasWords()[1].words]"
        )
        assert (faint in [word["text"] for word in words]) == moved
        ink = PAGE["ink"][0].lower()
        for width in (2.6, 1.4):
            arm = [line for line in lines if line["color"] == ink and line["width"] == width]
            sample, *curves = [
                line["dash"] for line in arm if len(line["points"]) > 2 or length(line) == 24
            ]
            assert curves and all(curve == sample for curve in curves)
            assert bool(sample) == (width == 1.4 and joints == [])


@pytest.mark.parametrize("end", ["min", "max"])
@pytest.mark.parametrize("width", [*PHONE, 1366])
def test_text_of_a_limit_touches_no_band_of_another_limit(page, tmp_path, width, end):
    """Six limits of a PUMA 560 are in one panel, those of joint 6 (at -266 and 266 degrees) on both
    sides of zero. A band begins at its limit and leads away from zero.
    """
    level = Quaternion.from_angle_axis(90 * deg, [0, 1, 0])
    t = np.linspace(0, 1, 101)
    start, goal = Transform(level, [(0.55, 0.6, 0.8), (0.55, -0.2, 1.1)])
    rows = PUMA560.ik(lin(start, goal, t))
    motions = np.stack([follow(PUMA560, rows, k) for k in range(8)])
    view = animate(PUMA560, t, motions, slider=("row", np.arange(8)))
    shown(page, view, tmp_path, width, end, "row", LINES, RECORD)
    [lines, words] = page.evaluate(
        "[document.querySelectorAll('canvas')[1].lines, canvasWords()[1].words]"
    )
    joints = [PAGE[f"joint{k}"][0].lower() for k in range(1, 7)]
    limits = [
        (joints.index(line["color"]) + 1, line["points"][0][1])
        for line in lines
        if line["width"] == 1 and line["color"] in joints
    ]
    zero = np.mean([y for joint, y in limits if joint == 6])
    texts = [word for word in words if "limit" in word["text"]]
    assert len(limits) == 7 and len(texts) >= 3
    for word in texts:
        own = int(word["text"][1])
        _, top, _, high = word["box"]
        for joint, y in limits:
            band = sorted([y, y + np.sign(y - zero) * 8])
            assert joint == own or band[0] > top + high or band[1] < top, (word["text"], joint)
        assert min(abs(y - top - high / 2) for joint, y in limits if joint == own) < 12


@pytest.mark.parametrize("width", [*PHONE, 1366])
def test_ends_of_the_range_of_alpha_are_named_where_the_curve_ends(page, tmp_path, width):
    view = movement_explorer(LEVERS, np.array([90, 90, 90]) * deg, (1.8, 0.6))
    shown(page, view, tmp_path, width, "none", "none", LINES, RECORD)
    [lines, words] = page.evaluate(
        "[document.querySelectorAll('canvas')[1].lines, canvasWords()[1].words]"
    )
    [curve] = [line["points"] for line in lines if line["width"] == 2.2]
    for text, (x, _) in (("69.5°", curve[0]), ("180.0°", curve[-1])):
        [[left, _, wide, _]] = [word["box"] for word in words if word["text"] == text]
        assert abs(left + wide / 2 - x) < 1, text


@pytest.mark.parametrize("width", PHONE)
def test_letters_of_the_links_are_next_to_their_links(page, tmp_path, width):
    """From the side, the links are the column, the upper arm l2 and the forearm l3."""
    shown(page, elbow_explorer(ITMO6R), tmp_path, width, "none", "none", RECORD)
    [links, words] = page.evaluate("[canvasWords()[0].links, canvasWords()[0].words]")
    links.sort(key=lambda line: line[0] + line[2])
    assert len(links) == 3
    for k, text in ((1, "l2"), (2, "l3")):
        [[left, top, wide, high]] = [word["box"] for word in words if word["text"] == text]
        middle = [left + wide / 2, top + high / 2]
        far = [
            np.linalg.norm(along({"points": np.reshape(link, (2, 2))}) - middle, axis=-1).min()
            for link in links
        ]
        assert np.argmin(far) == k and far[k] < 36, (text, far)


def length(line):
    """The length of a line with two points in px."""
    points = np.reshape(line["points"], (-1, 2))
    return round(float(np.linalg.norm(np.diff(points, axis=0))))


def test_unit_on_the_right_is_beside_the_name_of_the_panel(page, tmp_path):
    t = np.linspace(0, 2, 41)
    goal = np.array([60 * deg, 90 * deg, 0, 0.1])
    view = animate(SCARA, t, ptp(np.array([0, 30 * deg, 0, 0.0]), goal, t / 2))
    shown(page, view, tmp_path, PHONE[1], "min", "none", RECORD)
    words = [word for canvas in page.evaluate("canvasWords()") for word in canvas["words"]]
    names = [word for word in words if word["text"].startswith("acceleration,")]
    units = [word for word in words if word["text"].endswith("mm/s²")]
    assert len(names) == 1 and len(units) == 1, str([w["text"] for w in words])
    (left, _, wide, _), (begin, *_) = names[0]["box"], units[0]["box"]
    assert left + wide < begin


@pytest.mark.parametrize("width", [*PHONE, 1366])
def test_row_of_the_posture_is_always_named_at_the_edge(page, tmp_path, width):
    t, names = np.linspace(0, 4, 41), ["near", "far"]
    down = Quaternion.from_angle_axis(180 * deg, [0, 1, 0])
    ends = [Transform(down, [[x, y, 0.2] for x in (0.35, 0.5)]) for y in (-0.35, 0.35)]
    poses = ends[0][:, None].lerp(ends[1][:, None], quintic(4.0)(t))
    q = follow(IRB140, IRB140.ik(poses), IRB140.branch(+1, +1, +1))
    # one arm with a slider, and two arms side by side or one above the other
    one = animate(IRB140, t, q, slider=("x, m", [0.35, 0.5]))
    long = ["the first of two long names", "the second of them"]
    pairs = [(animate([IRB140] * 2, t, list(q), names=each), 2) for each in (names, long)]
    for view, count in ((one, 1), *pairs):
        shown(page, view, tmp_path, width, "min", "x", RECORD)
        for end in ("min", "max"):
            page.evaluate(TO_END, [end, "x"])
            page.evaluate(NEXT)
            [canvas, *_] = page.evaluate("canvasWords()")
            rows = [word for word in canvas["words"] if word["text"] == "row 0: +1 +1 +1"]
            assert len(rows) == count
            assert faults(page) == []
            assert count == 2 or rows[0]["box"][1] > canvas["height"] - 22


@pytest.mark.parametrize("width", [*PHONE, 914])
def test_no_part_of_a_ring_is_between_two_words(page, tmp_path, width):
    """The red ring around a joint would look like an apostrophe: past'its limit."""
    t, end = np.linspace(0, 1, 21), [150 * deg, 160 * deg, 410 * deg, 200 * mm]
    view = animate(SCARA, t, ptp(np.zeros(4), np.array(end), t))
    shown(page, view, tmp_path, width, "none", "none")
    page.evaluate(COVERED, ["past its limit", ["alarm"]])
    page.evaluate(TO_END, ["max", ""])
    page.evaluate(NEXT)
    covered = page.evaluate("covered")
    assert len(covered) >= 3 and not any(pixels for _, pixels in covered), covered


@pytest.mark.parametrize("width", [*PHONE, 914])
@pytest.mark.parametrize(
    ("place", "vias"),
    [
        ((1.2, 1.3), [(1, 1.3), (1, 1.2)]),
        ((1.4, 1.1), [(1.264, 1.055), (1.279, 1.025)]),  # almost together, and soon the moment
    ],
)
def test_words_of_the_distance_curve_are_beside_the_curve_and_its_lines(
    page, tmp_path, width, place, vias
):
    """The required distance hides no part of the curve; a name is next to its dotted line, and not
    on the line of the current moment.
    """
    start = LEVERS.family((1.2, 1.7), 118 * deg)
    view = clearance_explorer(LEVERS, start, (1.9, 0.3), place, vias)
    shown(page, view, tmp_path, width, "none", "none", LINES, RECORD)
    [lines, words] = page.evaluate(
        "[document.querySelectorAll('canvas')[1].lines, canvasWords()[1].words]"
    )
    boxes = {word["text"]: word["box"] for word in words}
    curve = np.concatenate([along(line) for line in lines if len(line["points"]) > 20])
    left, top, wide, high = boxes["143 mm"]
    inside = (curve > [left, top]).all(axis=-1) & (curve < [left + wide, top + high]).all(axis=-1)
    assert len(curve) > 100 and not inside.any()
    [now] = [
        line["points"][0][0]
        for line in lines
        if line["width"] == 1.4 and line["color"] == PAGE["ink"][0].lower()
    ]
    for name in ("K2", "K3"):
        left, _, wide, _ = boxes[name]
        assert not left < now < left + wide, name


@pytest.mark.parametrize("width", [*PHONE, 914])
def test_disc_of_the_required_distance_is_larger_than_its_ring(page, tmp_path, width):
    start = LEVERS.family((1.2, 1.7), 118 * deg)
    view = clearance_explorer(LEVERS, start, (1.9, 0.3), (1.2, 1.3))
    shown(page, view, tmp_path, width, "none", "none", RINGS)
    ring = page.evaluate(
        """() => {
          const ring = getComputedStyle(document.querySelector("[data-handle=H]"), "::before");
          return parseFloat(ring.width) / 2 + parseFloat(ring.borderTopWidth);
        }"""
    )
    largest = max(r for _, _, r in page.evaluate("document.querySelector('canvas').spots"))
    assert ring < largest - 2


@pytest.mark.parametrize("width", [*PHONE, 914])
@pytest.mark.parametrize("pulses", [10, 60, 333])
def test_lost_steps_are_written_beside_the_curves(page, tmp_path, width, pulses):
    shown(page, motor_explorer(Stepper(rise=0)), tmp_path, width, "none", "none")
    page.evaluate(COVERED, [" lost", ["accent", "soft"]])
    page.evaluate(TO_VALUES, {"frequency": pulses})
    page.evaluate(NEXT)
    covered = page.evaluate("covered")
    assert covered and not any(pixels for _, pixels in covered), covered


@pytest.mark.parametrize("width", [*PHONE, 914])
@pytest.mark.parametrize("end", ["min", "max", "none"])
def test_letters_of_v_and_its_image_are_beside_their_rings(page, tmp_path, end, width):
    """Also where both tips are at one point, so that one ring makes room for the other."""
    view = rotation_explorer(120 * deg, axis=(0.6, 0, 0.8), v=(0.1, 0, 0))
    shown(page, view, tmp_path, width, end, "", RECORD)
    [words, handles] = page.evaluate("[canvasWords()[0].words, canvasWords()[0].handles]")
    rings = [np.array([left + wide / 2, top + high / 2]) for left, top, wide, high in handles]
    for own, text in enumerate(["q v q*", "v"]):
        [[left, top, wide, high]] = [word["box"] for word in words if word["text"] == text]
        nearest = [np.clip(ring, [left, top], [left + wide, top + high]) for ring in rings]
        far = np.linalg.norm(np.subtract(nearest, rings), axis=-1)
        assert np.argmin(far) == own and far[own] < handles[own][2] / 2 + 18, (text, far)
