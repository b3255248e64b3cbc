"""The conveyor player draws objects, arms and labels where the belt and the arms put them."""

import numpy as np
import pytest

from robokin import mm, spbu_arm
from robokin.jobs.conveyor import ALONG, BIN, GAP, LINKS, WINDOW, serve, spaced, ways_from
from robokin.show import conveyor_player

SPREADS = [0.0, 0.8]
BEGIN = 116  # so many objects have come in when the clock starts
START = BEGIN * 0.15 / 0.25  # s: when the clock of the four arms starts


@pytest.fixture(scope="module")
def drawn():
    """The arguments that the player passes to `animate`, for four arms at 250 mm/s."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("robokin.show.conveyor.animate", lambda *given, **named: (given, named))
        return conveyor_player(0.25, SPREADS, 4)


def lanes(named, k):
    return np.array([lane[k] for lane, _ in named["circles"]])


def test_objects_lie_on_the_belt_or_hang_on_a_tool(drawn):
    (machines, clock, motions), named = drawn
    feet = named["bases"]
    tools = [
        machine.fk(q).translation + [*foot, -30 * mm]
        for machine, q, foot in zip(machines, motions, feet, strict=True)
    ]
    for k, spread in enumerate(SPREADS):
        offsets = spaced(200, GAP, spread)
        held = 0
        for lane in lanes(named, k):
            for t, place in zip(START + clock[::40], lane[::40], strict=True):
                if np.isnan(place).all():
                    continue
                where = ALONG[0] + 0.25 * t - offsets
                belt = np.stack([0 * where + 0.6, where, 0 * where + 20 * mm], axis=-1)
                on_belt = np.linalg.norm(belt - place, axis=-1).min() < 1e-9
                n = int((t - START) / (clock[1] - clock[0]) + 0.5)
                on_tool = min(np.linalg.norm(tool[k][n] - place) for tool in tools) < 1e-9
                assert on_belt or on_tool
                held += on_tool and not on_belt
        assert held > 5


def test_every_object_on_the_drawn_belt_is_shown_and_none_jumps(drawn):
    (_, clock, _), named = drawn
    for k, spread in enumerate(SPREADS):
        offsets = spaced(200, GAP, spread)
        trips = serve(offsets, 0.25, ALONG, ways_from(), arms=4, pitch=1.0)
        meets = np.full(200, np.inf)
        for each in trips:
            meets[each.objects] = each.meets
        places = lanes(named, k)
        for n in (0, 500, 1200):
            y = ALONG[0] + 0.25 * (START + clock[n]) - offsets
            waiting = y[(y > -0.6) & (y < 3.6) & (START + clock[n] < meets)]
            seen = places[:, n][np.isfinite(places[:, n, 0])]
            for at in waiting:
                assert abs(seen[:, 1] - at).min() < 1e-9
        with np.errstate(invalid="ignore"):
            steps = np.linalg.norm(np.diff(places, axis=1), axis=-1)
        assert np.nanmax(steps) < 20 * mm  # 4 m/s in 5 ms


def test_arms_start_at_their_bins_and_move_without_jumps(drawn):
    (_, _, motions), named = drawn
    arm = spbu_arm(*LINKS)
    assert len(motions) == 4
    for q in motions:
        assert abs(np.diff(q, axis=1)).max() <= 2.0 * 0.005 * (1 + 1e-9)  # rad, at 2 rad/s
        at = arm.fk(q).translation
        assert np.linalg.norm(at - BIN, axis=-1).min() < 1e-6
    walls = [face for face in named["faces"] if np.ptp(np.array(face)[:, 2])]
    assert len(walls) == 16  # four walls of four bins


def test_player_shows_a_belt_of_ones_own(monkeypatch):
    monkeypatch.setattr("robokin.show.conveyor.animate", lambda *given, **named: (given, named))
    own, gap = [0.35, -0.3, 0.25], 0.17
    (_, clock, motions), named = conveyor_player(0.21, SPREADS, 2, bin_place=own, gap=gap, seed=82)
    start = BEGIN * gap / 0.21
    brought = named["quantities"]["objects brought"]
    walls = np.array([face for face in named["faces"] if np.ptp(np.array(face)[:, 2])])
    for k, spread in enumerate(SPREADS):
        stream = spaced(200, gap, spread, seed=82)
        trips = serve(stream, 0.21, ALONG, ways_from(own), arms=2, pitch=1.0)
        # the last arm is the first that `animate` gets
        for i, (each, foot) in enumerate(zip(trips, named["bases"][::-1], strict=True)):
            tool = spbu_arm(*LINKS).fk(motions[1 - i][k]).translation
            assert np.linalg.norm(tool - own, axis=-1).min() < 1e-6
            box = walls.reshape(2, -1, 3)[i]
            assert box[:, :2].mean(axis=0) == pytest.approx(foot + own[:2])
            wanted = [((start < each.backs) & (each.backs <= start + t)).sum() for t in clock]
            assert brought[1 - i][k].tolist() == wanted and wanted[-1]


def test_arm_in_the_title_has_the_first_curve(drawn):
    """The first curve has the strongest line."""
    _, named = drawn
    assert named["names"] == ["arm 4", "arm 3", "arm 2", "arm 1"] and "arm 4" in named["title"]
    counts = {mark.name: mark.reading for mark in named["things"] if mark.reading}
    lost = counts.pop("missed").rows
    brought, past = named["quantities"].values()
    assert lost.shape == (2, 1201, 1) and lost[..., 0].tolist() == past[0].tolist()
    for name, foot, each in zip(named["names"], named["bases"], brought, strict=True):
        assert foot == pytest.approx([0, int(name[-1]) - 1])
        assert counts[name].rows[..., 0].tolist() == each.tolist()


def test_title_asks_for_what_the_view_counts(monkeypatch):
    monkeypatch.setattr("robokin.show.conveyor.animate", lambda *given, **named: named["title"])
    assert conveyor_player(0.2, SPREADS, 3) == "200 mm/s: how many objects does arm 3 bring?"
    alone = conveyor_player(0.2, SPREADS, 1, rules=True)
    assert alone == "200 mm/s: how many objects does one arm bring?"
    faster = conveyor_player([0.1, 0.2], 0.5, 1)
    assert faster == "Spread 0.5: how many objects does one arm miss?"
    assert conveyor_player([0.1, 0.2], 1, 2) == "Spread 1: how many objects do 2 arms miss?"
    # two arms miss some, so that is the question
    assert conveyor_player(0.2, [0, 1], 2) == "200 mm/s: how many objects do 2 arms miss?"
    monkeypatch.setattr("robokin.show.conveyor.animate", lambda *given, **named: named["names"])
    for spread in (1, 0.1):
        assert conveyor_player(0.2, [0, spread], 2) == ["arm 2", "arm 1"]
    monkeypatch.setattr(
        "robokin.show.conveyor.animate", lambda *given, **named: list(named["quantities"])
    )
    asked = "objects brought", "objects that passed the arm"
    assert conveyor_player(0.2, [0, 1], 2) == [*reversed(asked)]
    assert conveyor_player([0.1, 0.2], 0.5, 2) == [*reversed(asked)]
    assert conveyor_player(0.2, [0, 0.1], 2) == [*asked]
    # four arms miss some only under "first come"
    assert conveyor_player(0.2, [0, 1], 4, rules=True) == [*asked]


def test_curves_count_the_objects_that_each_arm_leaves(monkeypatch):
    """Until they are out of its window; those of the last arm are missed."""
    monkeypatch.setattr("robokin.show.conveyor.animate", lambda *given, **named: (given, named))
    (_, clock, _), named = conveyor_player(0.25, SPREADS, 3, rules=True)
    past = named["quantities"]["objects that passed the arm"]
    for rule, k in np.ndindex(2, 2):
        offsets = spaced(200, GAP, SPREADS[k])
        trips = serve(offsets, 0.25, ALONG, ways_from(), arms=3, pitch=1.0, first_come=rule == 1)
        for arm in range(3):
            taken = np.concatenate([each.objects for each in trips[: arm + 1]])
            out = (np.delete(offsets, taken) + arm + 0.8) / 0.25 - START
            wanted = [((out > 0) & (out <= t)).sum() for t in clock]
            assert past[2 - arm][rule, k].tolist() == wanted
            assert rule == 0 or wanted[-1], "under first come, objects pass all three"


@pytest.mark.parametrize("arms", [1, 3])
def test_arrow_on_the_belt_points_in_its_direction(monkeypatch, arms):
    """Before the first window, and in the middle of the belt."""
    monkeypatch.setattr("robokin.show.conveyor.animate", lambda *given, **named: (given, named))
    (_, clock, _), named = conveyor_player(0.2, SPREADS, arms)
    faces = list(map(np.array, named["faces"]))
    [arrow] = [face for face in faces if len(face) > 4]
    belt = max(faces, key=lambda face: np.ptp(face[:, 1]))
    low, high = belt.min(axis=0), belt.max(axis=0)
    assert (arrow >= low).all() and (arrow <= high).all() and arrow[:, 1].max() < ALONG[0]
    assert arrow[:, 0].mean() == pytest.approx(WINDOW[0, 0])
    tip = arrow[arrow[:, 1].argmax()]
    assert (arrow[:, 1] == tip[1]).sum() == 1 and tip[0] == WINDOW[0, 0]
    [lane] = [lane[0] for lane, _ in named["circles"][:1]]
    moves = np.diff(lane[np.isfinite(lane).all(axis=-1)][:10], axis=0)
    assert (moves[:, 1] > 0).all(), "objects move towards the tip"
    assert np.ptp(arrow[:, 0]) > np.ptp(arrow[arrow[:, 1] == arrow[:, 1].min(), 0])


def test_missed_objects_are_counted_and_have_a_dot(monkeypatch):
    """Each one gets its dot when it leaves the window."""
    monkeypatch.setattr("robokin.show.conveyor.animate", lambda *given, **named: (given, named))
    speeds = [0.08, 0.1, 0.13]
    (_, clock, _), named = conveyor_player(speeds, 0.5, 1, rules=True)
    assert clock[0] == 0 and clock[-1] == 6
    assert named["slider"][0] == "belt speed, mm/s"
    assert named["slider"][1] == pytest.approx([80, 100, 130])
    assert list(named["quantities"]) == ["objects missed", "objects brought"]
    told = next(mark for mark in named["things"] if mark.name == "missed")
    offsets, missed = spaced(200, GAP, 0.5), named["quantities"]["objects missed"]
    assert told.reading.rows[..., 0].tolist() == missed.reshape(6, -1).tolist()
    for rule in (0, 1):
        for k, v in enumerate(speeds):
            (trips,) = serve(offsets, v, ALONG, ways_from(), first_come=rule == 1)
            gone = (np.delete(offsets, trips.objects) + 0.8) / v - BEGIN * GAP / v
            wanted = [((gone > 0) & (gone <= t)).sum() for t in clock]
            assert missed[rule, k].tolist() == wanted
            dots = np.array([lane[rule, k] for lane in named["points"]])
            for n in range(0, 1201, 100):
                left = 0.4 + v * (clock[n] - gone)
                left = left[(left > 0.4) & (left <= 0.6)]
                seen = dots[:, n][np.isfinite(dots[:, n, 0])]
                assert sorted(seen[:, 1]) == pytest.approx(sorted(left))
                assert np.allclose(seen[:, [0, 2]], [0.6, 20 * mm])
    assert missed[..., -1].tolist() == [[0, 1, 1], [0, 3, 4]]


def test_camera_does_not_depend_on_the_bin():
    views = [
        conveyor_player(0.21, SPREADS, 3, bin_place=[0.15, y, 0.25]).data["scene"]["view"]
        for y in (-0.45, 0, 0.45)
    ]
    assert views[0] == views[1] == views[2]


def test_labels_stand_where_nothing_moves(drawn):
    """Each count is above its own arm, and each name of a window in front of its own window."""
    (_, _, motions), named = drawn
    feet, arm = named["bases"][::-1], spbu_arm(*LINKS)
    marks = {mark.name: mark.at.rows[0, 0] for mark in named["things"]}
    arms, windows = ([f"{what} {k + 1}" for k in range(4)] for what in ("arm", "window"))
    assert list(marks) == [*arms, "missed", *windows, "in", "out"]
    top = max(arm.frames(q).translation[..., 2].max() for q in motions)
    strips = [np.array(face) for face in named["faces"] if np.array(face)[:, 0].min() > 0.66]
    belt = max((np.array(face) for face in named["faces"]), key=lambda face: np.ptp(face[:, 1]))
    assert len(strips) == 4 and np.allclose(belt[:, 0].mean(), WINDOW[0, 0])
    for k, (foot, strip) in enumerate(zip(feet, strips, strict=True)):
        assert marks[f"arm {k + 1}"][:2] == pytest.approx(foot)
        assert marks[f"arm {k + 1}"][2] > top
        # the strip is beside the belt and as long as the window
        assert strip[:, 0].min() > belt[:, 0].max()
        assert sorted({*strip[:, 1]}) == pytest.approx(foot[1] + ALONG[[0, -1]])
        assert marks[f"window {k + 1}"][0] > strip[:, 0].max()
        assert marks[f"window {k + 1}"][1] == pytest.approx(foot[1])
    # the ends of the row of windows, and the end of the belt
    for name, strip in (("in", strips[0][:, 1].min()), ("out", strips[-1][:, 1].max())):
        assert marks[name][1] == pytest.approx(strip) and marks[name][0] > strips[0][:, 0].max()
    assert marks["missed"][1] > belt[:, 1].max()


def test_travel_time_depends_on_the_bin():
    near, far = ways_from([0.35, -0.45, 0.25]), ways_from([0.15, 0, 0.25])
    assert near.min() < ways_from().min() < far.min() and near.argmin() < 40 < far.argmin()
    for wrong in ([0, 0, 0.5], [2, 0, 0], [0.1, 0.2], [np.nan, 0, 0]):
        with pytest.raises(ValueError, match="bin_place: wanted"):
            ways_from(wrong)


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        (dict(v=200), "v: wanted a number from 0.02 to 0.5 m/s, or 2 to 6 increasing ones, got"),
        (dict(v=[0.1, 0.6], spread=0.5), "v: wanted a number from 0.02 to 0.5 m/s"),
        (dict(v=[0.2, 0.1], spread=0.5), "v: wanted a number from 0.02 to 0.5 m/s"),
        (dict(v=[], spread=0.5), "v: wanted a number from 0.02 to 0.5 m/s"),
        (dict(spread=[0.5]), "spread: wanted a number from 0 to 1, or 2 to 6 increasing ones"),
        (dict(spread=[1, 0.5, 0]), "spread: wanted a number from 0 to 1, or 2 to 6 increasing"),
        (dict(spread=[0, 1.5]), "spread: wanted a number from 0 to 1"),
        (dict(spread=[[0, 1]]), "spread: wanted a number from 0 to 1"),
        (dict(spread=0.5), "v and spread: wanted one number and one list, got two numbers"),
        (dict(v=[0.1, 0.2]), "v and spread: wanted one number and one list, got two lists"),
        (dict(arms=0), "arms: wanted"),
        (dict(rules="first come"), "rules: wanted True or False"),
        (dict(bin_place=[2, 0, 0]), "bin_place: wanted a place"),
        (dict(gap=-0.1), "gap: wanted one positive length in metres"),
        (dict(gap=150), "gap: wanted 0.1 to 0.5 m, got 150"),
        (dict(seed=0.5), "seed: wanted a whole number"),
    ],
)
def test_invalid_arguments_are_refused(wrong, says):
    with pytest.raises(ValueError, match=says):
        conveyor_player(**wrong)
