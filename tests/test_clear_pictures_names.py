"""A name in a picture stands at what it names, on a phone and with all sliders at their ends: a
limit at its own arc of a zone, and a length at its own line. Dashes stay dashes.
"""

import itertools

import numpy as np
import pytest
import test_clear_pictures
from canvas_words import LINES, RECORD
from test_clear_letters import aside
from test_clear_pictures import PHONE, along, shown

from robokin import IRB140, ITMO6R, PUMA560, SCARA, ScaraPose, deg, follow, mm, scara_arm, two_link
from robokin.jobs.visit_collect import Task
from robokin.show import (
    animate,
    crossing_explorer,
    elbow_explorer,
    target_explorer,
    tour_explorer,
)
from robokin.show.palette import PAGE
from robokin.show.things import Zone

page = test_clear_pictures.page


LINK = "lu", "lw"


def explored():
    return target_explorer(SCARA, ScaraPose([0.25, 0, 0.2]), zone=True)


def other_stop():
    limits = SCARA.limits.copy()
    limits[1] = -145 * deg, 145 * deg
    arm = scara_arm("SCARA with another stop", 220.2 * mm, 200 * mm, 250 * mm, limits)
    return target_explorer(arm, ScaraPose([0.25, 0, 0.1]), zone=True)


def circles():
    """An arm in space, whose tool goes once around a circle."""
    t = np.linspace(0, 20, 401)
    circle = np.stack([np.cos(t * np.pi / 10), np.sin(t * np.pi / 10), 0 * t], axis=-1)
    targets = [ScaraPose([0.2, 0, 0.1] + r * circle, 0.0) for r in (0.05, 0.1)]
    laps = [follow(SCARA, SCARA.ik(target), SCARA.branch(+1)) for target in targets]
    return animate(
        SCARA, t, np.array(laps), slider=("radius, mm", [50, 100]), things=[Zone(SCARA)], joints=[2]
    )


@pytest.mark.parametrize("end", ["none", "min", "max"])
@pytest.mark.parametrize("width", [*PHONE, 914])
@pytest.mark.parametrize(
    ("view", "name"),
    [
        *itertools.product((explored, other_stop), ("x", "y", "angle")),
        *itertools.product([circles], ("radius", "time")),
    ],
)
def test_text_of_a_limit_is_next_to_its_own_side_of_the_zone(
    page, tmp_path, view, name, width, end
):
    """It is nearer to this side than to a side of the same colour, and no name is left out."""
    shown(page, view(), tmp_path, width, end, name, LINES, RECORD)
    [lines, words] = page.evaluate(
        "[document.querySelector('canvas').lines, canvasWords()[0].words]"
    )
    first, second = (
        [line for line in lines if line["color"] == color and line["width"] == 2]
        for color in (PAGE[f"joint{k}"][0].lower() for k in (1, 2))
    )
    assert len(first) == 4 and len(second) == 2
    # each elbow draws its sides in the same order: q1 at one limit, q2, q1 at the other
    limits = "q1 = 140°", "q1 = −140°", "q1 = −140°", "q1 = 140°"
    texts = {w["text"]: w for w in words if w["text"].startswith("q") and "=" in w["text"]}
    assert len(texts) == 3 and texts.keys() - {*limits} <= {"q2 = ±150°", "q2 = ±145°"}
    for text, word in texts.items():
        own, others = second, []
        if text in limits:
            own, others = (
                [line for limit, line in zip(limits, first, strict=True) if (limit == text) == same]
                for same in (True, False)
            )
        far = distance(word["box"], own)
        assert far < 19, text
        assert not others or far < distance(word["box"], others), text
        assert not any(line["width"] == 1 and line["color"] == word["color"] for line in lines)


@pytest.mark.parametrize("view", [explored, circles])
def test_dashes_of_one_elbow_do_not_fill_the_gaps_of_the_other(page, tmp_path, view):
    """Parts of both circles of q2 coincide."""
    shown(page, view(), tmp_path, 900, "none", "none", LINES)
    lines = page.evaluate("document.querySelector('canvas').lines")
    orange, paper = (PAGE[name][0].lower() for name in ("joint2", "paper"))
    sides = [k for k, line in enumerate(lines) if line["color"] == orange and line["dash"]]
    assert len(sides) == 2
    for k in sides:
        below = lines[k - 1]
        assert below["color"] == paper and below["points"] == lines[k]["points"]


def distance(box, lines):
    """The distance of a box from the nearest of several lines."""
    drawn = np.concatenate([along(line) for line in lines])
    return np.linalg.norm(nearest(box, drawn) - drawn, axis=-1).min()


@pytest.mark.parametrize("arm", [IRB140, PUMA560, ITMO6R])
@pytest.mark.parametrize("name", ["r", "z"])
@pytest.mark.parametrize("end", ["none", "min", "max"])
@pytest.mark.parametrize("width", [*PHONE, 900])
def test_length_is_next_to_its_own_line_or_has_a_line_to_it(page, tmp_path, arm, name, end, width):
    shown(page, elbow_explorer(arm), tmp_path, width, end, name, LINES, RECORD)
    [lines, words] = page.evaluate(
        "[document.querySelector('canvas').lines, canvasWords()[0].words]"
    )
    [[place, [joint2, corner, point]]] = [
        (k, line["points"]) for k, line in enumerate(lines) if line["dash"] == [5, 4]
    ]
    links = [k for k, line in enumerate(lines) if line["color"] == PAGE["link"][0].lower()]
    assert all(k < place for k in links), "a link covers u or w"
    named = {"d": [joint2, point], "u": [joint2, corner], "w": [corner, point]}
    others = []
    for line in lines:
        if line["dash"] == [8, 7]:
            other = line["points"][1]
            elbow = mirrored(joint2, point, other)
            named |= {"l2": [joint2, elbow], "l3": [elbow, point]}
            others = [[joint2, other], [other, point]]
    found = {word["text"].split()[0]: word["box"] for word in words}
    assert named.keys() <= found.keys()
    colors = [PAGE[name][0].lower() for name in ("soft", "ink")]
    leaders = [
        line["points"]
        for line in lines
        if line["width"] == 1 and line["color"] in colors and not line["dash"]
    ]
    for length, own in named.items():
        far = [distance(found[length], [{"points": line}]) for line in (own, *others)]
        # the links l2 and l3 may cover u and w
        rest = [
            line for key, line in named.items() if key != length and length[0] + key not in LINK
        ]
        far += [distance(found[length], [{"points": line}]) for line in rest]
        led = any(
            distance(found[length], [{"points": leader}]) < 6
            and aside(np.array(leader[1]), np.array(own)) < 1
            for leader in leaders
        )
        assert led or far[0] == min(far) and far[0] < 30, (length, far)
    if width == 900:
        to_joint = np.linalg.norm(nearest(found["joint"], np.array(joint2)) - joint2)
        [column] = [line["points"][:2] for line in lines if line["width"] == 6]
        assert to_joint <= max(19, distance(found["joint"], [{"points": column}]))


def mirrored(a, b, place):
    """The mirror image of a place in the line from a to b."""
    a, way, place = np.array(a), np.subtract(b, a), np.array(place)
    foot = a + way * (way @ (place - a)) / (way @ way)
    return (2 * foot - place).tolist()


def nearest(box, places):
    left, top, wide, high = box
    return np.clip(places, [left, top], [left + wide, top + high])


def crossings():
    """The track of the left elbow turns back at its ends."""
    return crossing_explorer(two_link(1.0, 1.0), (0.6, 0.8), divisor="x3")


def collected():
    """The arm brings each point to p0, and goes there and back on the same way."""
    points = [[2.16, 3.37, 2], [1.81, -3.56, 2], [1.45, -3.73, 2], [1.07, -3.85, 2]]
    task = Task(5, 4, T=25, speeds=[0.2] * 3, p0=[4, 0, 2], points=points, kind="collect")
    return tour_explorer(task, best=False)


@pytest.mark.parametrize(
    ("view", "dash", "name"),
    [(crossings, "7,4", "none"), (crossings, "7,4", "x3"), (collected, "7,7", "time")],
)
@pytest.mark.parametrize("width", [PHONE[0], 900])
def test_dashed_line_does_not_run_back_over_itself(page, tmp_path, view, dash, name, width):
    """Its dashes would fill the gaps."""
    shown(page, view(), tmp_path, width, "max", name, LINES)
    dashed = "dash => document.querySelector('canvas').lines.filter(x => x.dash.join() === dash)"
    lines = [line["pieces"] for line in page.evaluate(dashed, dash)]
    assert lines
    for pieces in lines:
        starts, ends = (
            np.concatenate([piece[part] for piece in map(np.array, pieces) if len(piece) > 1])
            for part in (slice(-1), slice(1, None))
        )
        ways = ends - starts
        long = np.linalg.norm(ways, axis=-1)
        assert long.sum() > 20
        for k in np.flatnonzero(long > 0.2):
            to = starts[k] + ways[k] / 2 - starts[:k]
            share = (to * ways[:k]).sum(axis=-1) / np.maximum(long[:k] ** 2, 1e-9)
            off = np.linalg.norm(to - share.clip(0, 1)[:, None] * ways[:k], axis=-1)
            assert not ((off < 1) & (ways[:k] @ ways[k] < 0)).any()
