"""The zone of a SCARA: its sides and areas agree with the inverse kinematics, and an explorer shows
it from above.
"""

import numpy as np
import pytest
import test_explorers
import test_twin
from matplotlib.path import Path

from robokin import IRB140, SCARA, Arm, ScaraPose, deg, explain, mm, scara_arm, three_lever, within
from robokin.show import target_explorer
from robokin.show.things import Zone

context, opened, twin = test_explorers.context, test_explorers.opened, test_twin.twin  # fixtures


def scara(upper, fore, first, second):
    """Return a SCARA whose joints 1 and 2 have these limits in degrees."""
    limits = np.array([first, second, (-400, 400), (0, 10)]) * deg
    return scara_arm("other", 0.3, upper, fore, limits)


ARMS = {
    "SCARA": SCARA,
    "uneven limits": scara(0.3, 0.2, (-50, 130), (-100, 140)),
    "equal levers": scara(0.2, 0.2, (-120, 120), (-160, 160)),
    "one elbow": scara(0.2, 0.3, (-100, 90), (20, 150)),
    "bends to the right": scara(0.2, 0.3, (-100, 90), (-150, -30)),
    "folds": scara(0.2, 0.3, (-90, 90), (-180, 180)),
    "turns around": scara(0.2, 0.25, (-270, 270), (-140, 140)),
}
every_arm = pytest.mark.parametrize("name", ARMS)


def outlines(zone):
    return [np.concatenate([points for _, points in around])[:, :2] for around in zone.sides]


def to_line(points, line):
    """Return the distances of points (n, 2) from a polyline (k, 2)."""
    start, way = line[:-1], np.diff(line, axis=0)
    length = np.maximum((way**2).sum(axis=-1), 1e-30)
    share = (((points[:, None] - start) * way).sum(axis=-1) / length).clip(0, 1)
    return np.linalg.norm(start + share[..., None] * way - points[:, None], axis=-1).min(axis=-1)


@every_arm
def test_areas_contain_the_places_with_a_row_of_ik_inside_the_limits(name):
    arm, rng = ARMS[name], np.random.default_rng(4)
    places = rng.uniform(-1.1, 1.1, (1500, 2)) * arm.reach
    rows = arm.ik(ScaraPose(np.column_stack([places, np.full(1500, 0.25)])))
    wanted = within(arm, rows)[..., :2].all(axis=-1)  # (1500, 2): each elbow
    areas = outlines(Zone(arm))
    clear = np.min([to_line(places, np.vstack([line, line[:1]])) for line in areas], axis=0)
    clear = clear > 1e-3 * arm.reach  # the arcs are polylines
    assert clear.mean() > 0.9 and wanted.any() and not wanted.all()
    got = np.array([Path(line).contains_points(places) for line in areas])
    kept = wanted.T[wanted.any(axis=0)]
    assert len(got) == len(kept) and (got == kept)[:, clear].all()


@every_arm
def test_named_joint_is_at_its_limit_on_every_side(name):
    """The reference values come from the law of cosines."""
    arm, named = ARMS[name], set()
    l1, l2 = arm.geometry.upper, arm.geometry.fore
    for around in Zone(arm).sides:
        bends = []
        for joint, points in around:
            x, y = points.T[:2]
            cosine = (x**2 + y**2 - l1**2 - l2**2) / (2 * l1 * l2)
            assert (points[:, 2] == 0).all() and (abs(cosine) < 1 + 1e-9).all()
            bend = np.arccos(cosine.clip(-1, 1))
            inner = np.arctan2(l2 * np.sin(bend), l1 + l2 * np.cos(bend))
            both = np.stack([np.arctan2(y, x) - inner, np.arctan2(y, x) + inner])
            if joint == 0:
                off = abs(np.exp(1j * both[..., None]) - np.exp(1j * arm.limits[0])).min(axis=0)
                assert (off.max(axis=0) < 1e-6).any()
            elif joint == 1:
                assert abs(bend[:, None] - abs(arm.limits[1])).max(axis=0).min() < 1e-6
            elif "around" not in name:
                assert np.allclose(abs(cosine), 1)
            bends += bend.tolist()
            named.add(joint)
        assert np.ptp(bends) > 1
    assert 1 in named or name == "folds"


def test_labels_state_the_limits_at_the_right_places():
    labels = dict(Zone(SCARA).labels)
    assert list(labels) == ["q1 = 140°", "q2 = ±150°", "q1 = −140°"]
    for text, at in labels.items():
        joint, value = int(text[1]) - 1, text.split()[2].rstrip("°").replace("−", "-")
        rows = SCARA.ik(ScaraPose([*at[:2], 0.1]))[:, joint] / deg
        wanted = [float(value.replace("±", sign)) for sign in ("", "-")]
        assert abs(rows[:, None] - wanted).min(axis=0).max() < 1e-6


@every_arm
def test_every_side_at_a_limit_has_the_text_of_this_limit(name):
    """It names both limits of joint 2 only if both elbows have a side on the same circle."""
    arm = ARMS[name]
    low, high = (arm.limits[:2] / deg).T.round(9)
    for around, texts in zip(Zone(arm).sides, Zone(arm).texts, strict=True):
        for (joint, points), text in zip(around, texts, strict=True):
            if joint is None:
                assert text == ""
                continue
            assert text[:5] == f"q{joint + 1} = "
            value = float(text[5:-1].replace("−", "-").replace("±", ""))
            assert value in (low[joint], high[joint])
            assert ("±" in text) == (joint == 1 and low[1] == -high[1])
            rows = arm.ik(ScaraPose([*points[len(points) // 2][:2], 0.25]))[:, joint] / deg
            off = rows - value if "±" not in text else abs(rows) - value
            assert abs((off + 180) % 360 - 180).min() < 1e-6


def test_zone_of_another_arm_is_refused():
    for call, words in (
        (lambda: Zone(IRB140), "arm: wanted a SCARA, got IRB-140"),
        (lambda: Zone(Arm("links", SCARA.links, SCARA.limits)), "arm: wanted a ClosedFormArm"),
        (lambda: target_explorer(IRB140, zone=True), "arm: wanted a SCARA"),
        (lambda: target_explorer(three_lever(0.3), zone=True), "arm: wanted a"),
    ):
        with pytest.raises(TypeError, match=words):
            call()
    with pytest.raises(ValueError, match="zone: wanted True or False"):
        target_explorer(SCARA, zone=1)


# --- The explorer ---------------------------------------------------------------------------------


def test_page_finds_the_nearest_limit_of_joints_1_and_2(twin):
    rng = np.random.default_rng(5)
    q = rng.uniform(*SCARA.limits.T, (1000, 4))
    got = twin(
        "return nested(a, 4).flatMap(q => {"
        "const {joint, side, room} = nearestLimit(arm, q, [0, 1]); return [joint, side, room]})",
        SCARA,
        q,
        shape=(1000, 3),
    )
    margins = np.stack([q[:, 0] - SCARA.limits[0, 0], SCARA.limits[0, 1] - q[:, 0]])
    margins = np.vstack([margins, [q[:, 1] - SCARA.limits[1, 0], SCARA.limits[1, 1] - q[:, 1]]])
    which = margins.argmin(axis=0)
    assert len(set(which)) == 4 and margins.min() > 0
    assert np.array_equal(got[:, :2], np.stack([which // 2, which % 2], axis=-1))
    assert np.allclose(got[:, 2], margins.min(axis=0), atol=1e-12)


def told(arm, seen):
    """Check what the explorer says about joints 1 and 2 at the target in its input fields."""
    x, y, z = (seen.boxes[name] * mm for name in "xyz")
    rows = arm.ik(ScaraPose([x, y, z], seen.boxes["angle"] * deg))
    usable, text = within(arm, rows).all(axis=-1), seen.says
    row = int(text.split("Row ")[1][0])
    assert explain(arm, ScaraPose([x, y, z], seen.boxes["angle"] * deg), row)[:40] in text
    if not usable[row]:
        assert "from its limit" not in text
        return None
    margins = abs(arm.limits[:2] - rows[row, :2, None]) / deg
    joint = int(margins.min(axis=1).argmin())
    assert f"Joint {joint + 1} is {margins.min():.1f}° from its limit of" in text
    return margins.min()


def test_dragging_the_target_finds_the_hole_and_the_joint_stops(opened):
    shown = opened(target_explorer(SCARA, zone=True), SCARA)
    first = shown.look()
    assert told(SCARA, first) > 30 and first.says in shown.data["summary"]
    assert "z" not in first.handles and {"free", "x", "y", "angle"} <= first.handles.keys()
    words = first.words[0].split("|")
    assert {"q1 = 140°", "q1 = −140°", "q2 = ±150°"} <= set(words)
    start = np.array(first.handles["free"]["at"])
    ahead = shown.drag("free", start - [60, 0])  # towards the column
    moved = first.boxes["x"] - ahead.boxes["x"]
    assert moved > 20 and abs(ahead.boxes["y"]) < 0.5, "the drag also changed y"
    into = start - [60 * 150 / moved, 0]  # x is 100 mm
    hole = shown.drag("free", into)
    assert told(SCARA, hole) is None and "q2 past its limit" in hole.words[0]
    assert hole.rows[0][1] == hole.rows[1][1] == "past limit: q2"
    for place, word in ((("x", -430), "q1 past its limit"), (("x", 470), "no solution")):
        shown.type(*place)
        assert word in shown.look().words[0]
    shown.type("x", 250)
    for name, value in (("y", 100), ("y", -300), ("x", -100)):
        shown.type(name, value)
        assert told(SCARA, shown.look()) > 0
    shown.press("free", "Home")
    assert shown.look().boxes == first.boxes
