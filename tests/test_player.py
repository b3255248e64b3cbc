"""The player: the data of the page agree with the arrays, and the drawing in the browser agrees
with the data.
"""

import base64
import json
import os
import re
from dataclasses import replace
from operator import ne
from types import SimpleNamespace

import numpy as np
import pytest
from canvas_words import COVERED
from conftest import awake, until
from matplotlib.patches import Circle, Polygon
from matplotlib.text import Text

from robokin import (
    IRB140,
    Arm,
    Link,
    Quaternion,
    Transform,
    blend,
    deg,
    differentiate,
    follow,
    linear,
    mm,
    record,
    spbu_arm,
)
from robokin.show import animate, joint_explorer, motor_explorer, plot_joints
from robokin.show.camera import arm_points, project
from robokin.show.joiner import script
from robokin.show.markup import STILL
from robokin.show.palette import AXIS_COLORS, css

X, Y, Z = np.eye(3)
ROW = IRB140.branch(+1, +1, -1)
# The motion of document 001, tasks 3 and 4, and its values in errata S1.
START = Transform(Quaternion.from_angle_axis(90 * deg, -X), (0.2, 0.4, 0.2))
VIA = Transform(Quaternion.from_angle_axis(45 * deg, Y), (0.65, -0.1, 0.8))
GOAL = Transform(Quaternion.from_angle_axis(90 * deg, Y), (0.3, 0.3, 0.5))
T = np.linspace(0, 20, 2001)
CORNER_JUMP = np.array(
    [
        0.107946862582,
        0.457852830604,
        0.920011415539,
        0.030116525407,
        -0.456073919364,
        -0.216939050457,
    ]
)
GREATEST_SPEED = {
    0: [
        0.167925134190,
        0.254172899579,
        0.546579628640,
        0.184156326854,
        0.377072039796,
        0.254664472000,
    ],
    0.1: [
        0.167925134190,
        0.189357070983,
        0.268949725020,
        0.184156326854,
        0.214674566952,
        0.254664472000,
    ],
}
GREATEST_ACCELERATION = {0.1: [0.049798, 0.073271, 0.152951, 0.048029, 0.077924, 0.091649]}
FRACTIONS = np.array([0, 0.1, 0.25, 0.5])


def arm(name, limits, *links):
    """An arm without an inverse."""
    return Arm(name, SimpleNamespace(links=links, target=Transform, reach=0.9), limits)


PLANAR = arm(
    "Two links",
    [[-3, 3], [-2, 2]],
    Link(axis=Z),
    Link(Transform(translation=(0.5, 0, 0)), Z, after=Transform(translation=(0.4, 0, 0))),
)
SCARA = arm(
    "Four axes",
    [[-3, 3], [-2, 2], [0, 0.18], [-6, 6]],
    Link(Transform(translation=(0, 0, 0.4)), Z),
    Link(Transform(translation=(0.25, 0, 0)), Z),
    Link(Transform(translation=(0.2, 0, 0)), -Z, prismatic=True),
    Link(axis=Z),
)


def chain(fraction, t=T, corner="parabola"):
    s = linear(t[-1])(t)
    return follow(IRB140, IRB140.ik(blend(START, VIA, GOAL, fraction, s, corner=corner)), ROW)


@pytest.fixture(scope="module")
def motions():
    return chain(FRACTIONS[:, None])


@pytest.fixture(scope="module")
def blended(motions):
    return animate(IRB140, T, motions, targets=[START, VIA, GOAL], slider=("blend", FRACTIONS))


def unpacked(packed, columns, samples):
    """Decode `Packed` data value by value: (motions, samples, columns)."""
    values = iter(base64.b64decode(packed["data"]))

    def folded():
        byte = next(values)
        return byte if byte < 128 else byte - 128 + 128 * folded()

    out = []
    for step in packed["steps"]:
        table = np.empty((samples, columns))
        for j in range(columns):
            whole = slope = 0
            for i in range(samples):
                code = folded()
                slope += -(code + 1) // 2 if code % 2 else code // 2
                whole += slope
                at = step[j] if isinstance(step, list) else step
                table[i, j] = np.nan if whole == -32768 else whole * at
        out.append(table)
    assert next(values, None) is None
    return np.array(out)


def decoded(player, arm=0):
    """Joint values, speeds and accelerations (motions, samples, n) in the units shown."""
    data = player.data["arms"][arm]
    size = len(data["chain"]), len(player.data["times"])
    return [unpacked(packed, *size) for packed in data["motion"]]


def steps_of(player, arm=0):
    """The rounding steps of joint values, speeds and accelerations: (motions, n or 1) each."""
    return [
        np.array(packed["steps"]).reshape(len(packed["steps"]), -1)
        for packed in player.data["arms"][arm]["motion"]
    ]


def kept(player, t=T):
    return np.abs(t[:, None] - player.data["times"]).argmin(axis=0)


# --- The data of the page -------------------------------------------------------------------------


def test_page_stores_the_motion_to_within_its_rounding_step(blended, motions):
    q, v, a = decoded(blended)
    steps = steps_of(blended)
    at = kept(blended)
    assert at[0] == 0 and at[-1] == 2000 and len(at) <= 121 and (np.diff(at) > 0).all()
    assert abs(q - motions[:, at] / deg).max() <= 0.5001 * steps[0].max() <= 0.005
    speeds = np.gradient(motions, T, axis=1, edge_order=2)
    assert abs(v - speeds[:, at] / deg).max() <= 0.5001 * steps[1].max() <= 0.005
    inner = (at > 2) & (at < 1998)
    accelerations = np.gradient(speeds, T, axis=1)[:, at] / deg
    error = abs(a - accelerations)[:, inner]
    assert error[1:].max() <= 0.5001 * steps[2].max() <= 0.005
    assert np.nanmax(error[0]) <= 0.5001 * steps[2].max()
    assert set(at[np.isnan(a[0]).any(axis=-1)]) <= {999, 1000, 1001} and np.isnan(a[0]).any()


def test_rounding_steps_belong_to_the_series_1_2_5(blended):
    for steps in steps_of(blended):
        assert all(re.fullmatch(r"[125]e[-+]\d\d", f"{step:.0e}") for step in steps.flat)


def test_greatest_speeds_and_accelerations_match_the_errata(blended):
    arm = blended.data["arms"][0]
    for fraction, wanted in GREATEST_SPEED.items():
        got = arm["speed"][FRACTIONS.tolist().index(fraction)]
        # The forward differences of the errata and our central ones are half a step apart. Before
        # the corner joint 3 gains 21.5 °/s every second: 0.11 °/s in half a step, plus the rounding
        # of the digit shown.
        assert np.allclose(got, np.array(wanted) / deg, rtol=0, atol=0.16)
        share = arm["share"][FRACTIONS.tolist().index(fraction)]
        assert np.allclose(share, 100 * np.array(wanted) / IRB140.speed_limits, rtol=0, atol=0.6)
    for fraction, wanted in GREATEST_ACCELERATION.items():
        assert np.allclose(
            arm["acceleration"][FRACTIONS.tolist().index(fraction)],
            np.array(wanted) / deg,
            atol=0.08,
        )


def test_printed_value_plot_and_player_agree(blended, motions):
    """Regression (row A8): at blend 0.5 the player showed 3.24 °/s², and the cell next to it
    printed 3.23.
    """
    k, slow = 3, np.linspace(0, 20, 1001)
    q = motions[k, ::2]
    printed = [abs(differentiate(q, slow, order)).max(axis=0) / deg for order in (1, 2)]
    assert f"{printed[1][2]:.2f}" == "3.23"
    arm = animate(IRB140, slow, q).data["arms"][0]
    assert arm["speed"][0] == pytest.approx(printed[0], abs=0.051)
    assert arm["acceleration"][0] == pytest.approx(printed[1], abs=0.0051)
    for plot in (
        plot_joints(IRB140, slow, q, *(differentiate(q, slow, order) for order in (1, 2))),
        plot_joints(record(IRB140, slow, q)),
    ):
        assert f"Greatest speed {printed[0].max():.3g} °/s (q6)." in plot.alt
        assert "Greatest acceleration 3.23 °/s² (q3)." in plot.alt


def test_plot_and_player_report_the_same_problems(motions):
    """The motion has a corner, a jump by 360°, samples beyond both kinds of limits, and a gap."""
    q = motions[0].copy()
    q[1500:, 3] += 2 * np.pi
    q[:, 1] += 130 * deg
    q[300:400] = np.nan
    t = T / 25
    recording = record(IRB140, t, q)
    plot, player = plot_joints(recording), animate(recording)
    [notes] = [" ".join(x) for x in player.data["arms"][0]["notes"].values()]
    for word in ("speed limit", "limit"):
        told = re.findall(rf"q(\d) exceeds its {word} in (\d+) of 2001", notes)
        said = re.search(rf"Joint \d past its {word} in \d+ of 2001 samples[^.]*", plot.alt)[0]
        assert told and len(told) == len(re.findall("oint", said))
        assert all(re.search(rf"oint {j}( past its {word})? in {n}\b", said) for j, n in told)
    assert "q4 jumps by 360.0° at 0.60 s" in notes and "q4 jumps by 360° at 0.6 s" in plot.alt
    [[at, words]] = player.data["arms"][0]["jumps"]["0"]
    jump = float(re.search(r"jumps by ([\d.]+) °/s", words)[1])
    assert f"the speed jumps, by up to {jump:.0f} °/s (q3)" in plot.alt
    assert f"None at {at:g} s" in plot.alt
    table = player.data["arms"][0]["acceleration"][0]
    assert all(str(x).startswith("jump") for x in table) and "Spike" not in plot.alt
    assert "No solution in 100 of 2001" in notes
    drawn = plot.axes[0].lines[0].get_ydata()
    assert (np.isnan(drawn) == recording.missing).all()


def test_recording_is_animated_like_its_arrays(blended, motions):
    again = animate(
        record(IRB140, T, motions), targets=[START, VIA, GOAL], slider=("blend", FRACTIONS)
    )
    assert again.text == blended.text
    words = ("corner", ["a", "b"])
    both = np.stack([motions, motions[::-1]])
    made = animate(record(IRB140, T, both), slider=("blend", FRACTIONS), switch=words)
    assert made.text == animate(IRB140, T, both, slider=("blend", FRACTIONS), switch=words).text
    assert set(made.data["arms"][0]["jumps"]) == {"0", "7"}
    pair = [record(IRB140, T, motions[k]) for k in (1, 3)]
    made = animate(pair, names=["near", "far"])
    given = animate([IRB140, IRB140], T, [motions[1], motions[3]], names=["near", "far"])
    assert made.text == given.text


def test_joint_values_can_be_lists():
    t, q = [0, 1, 2], np.linspace(0, 0.2, 18).reshape(3, 6)
    assert animate(IRB140, t, q.tolist()).text == animate(IRB140, t, q).text
    both = np.stack([q, 2 * q])
    slow = animate(IRB140, t, both.tolist(), slider=("x", [1, 2]))
    assert slow.text == animate(IRB140, t, both, slider=("x", [1, 2])).text
    assert animate([IRB140], t, (q,)).text == animate([IRB140], t, [q.tolist()]).text


def test_player_shows_the_speeds_stored_in_a_recording(motions):
    """If a recording contains exact speeds, the player shows these."""
    exact = record(IRB140, T, motions[1])
    slow = replace(exact, v=exact.v / 2)
    speeds = [animate(one).data["arms"][0]["speed"][0] for one in (exact, slow)]
    assert np.allclose(np.array(speeds[0]) / 2, speeds[1], atol=0.051)


def test_unblended_corner_is_a_speed_jump_without_acceleration(blended):
    arm = blended.data["arms"][0]
    assert arm["acceleration"][0] == [f"jump {x:.1f} °/s" for x in abs(CORNER_JUMP) / deg]
    assert arm["jumps"] == {"0": [[10.0, "speed jumps by 52.7 °/s"]]}
    assert all(isinstance(x, float) for row in arm["acceleration"][1:] for x in row)
    # If the scale included the spike, it would reach thousands of degrees per second squared.
    low, step, count, _ = blended.data["panels"][2]["axes"]["turn"]["scale"]
    assert -100 < low < 0 < low + step * (count - 1) < 100


def test_distance_to_the_via_point_is_the_smallest_along_the_path(blended, motions):
    path = IRB140.fk(motions).translation
    wanted = np.linalg.norm(path - VIA.translation, axis=-1).min(axis=-1)
    for (distance, *place), least in zip(blended.data["arms"][0]["via"], wanted, strict=True):
        assert distance == pytest.approx(least / mm, abs=0.051)
        assert np.linalg.norm(place - VIA.translation) == pytest.approx(least, abs=2e-4)
    # the unblended path passes through the via point, but the blended one does not
    assert wanted[0] < 1e-9 < 0.03 < wanted[1]


def test_missing_solutions_leave_gaps_in_the_curves(motions):
    q = motions[1].copy()
    q[600:900] = np.nan
    player = animate(IRB140, T, q)
    at = kept(player)
    for values in decoded(player):
        assert (np.isnan(values[0]).all(axis=-1) == ((at >= 600) & (at < 900))).all()
    arm = player.data["arms"][0]
    assert arm["notes"]["0"] == ["No solution in 300 of 2001 samples."] and not arm["leaps"]


def test_motion_without_any_solution_is_shown(motions):
    player = animate(IRB140, T, np.full((2001, 6), np.nan), targets=[START, VIA, GOAL])
    assert player.data["arms"][0]["notes"]["0"] == ["No solution in 2001 of 2001 samples."]
    assert player.data["arms"][0]["via"] == [None] and "<img" in player.html


def test_jump_by_two_pi_breaks_the_curve_and_does_not_count_as_speed(motions):
    q = motions[1].copy()
    q[1200:, 3] += 2 * np.pi
    player = animate(IRB140, T, q)
    arm = player.data["arms"][0]
    [[when, words]] = arm["leaps"]["0"]
    assert (
        when == pytest.approx(11.995) and words.startswith("q4 jumps by 36") and words.endswith("°")
    )
    assert arm["speed"][0] == animate(IRB140, T, motions[1]).data["arms"][0]["speed"][0]
    [gap] = arm["gaps"]["0"]
    times = player.data["times"]
    assert times[gap] <= 11.99 < 12.0 <= times[gap + 1] <= 12.001


def test_teeth_of_a_sawtooth_count_as_jumps_in_position_and_not_as_speed():
    """As in lab 12, where C code casts to int: each tooth is less than a tenth of a radian high and
    far from the next one.
    """
    t = np.linspace(0, 5, 500)
    teeth = [82, 146, 199, 246, 289, 328]
    q = np.zeros((500, 6))
    q[:, 0] = 0.2 * t - 0.07 * np.searchsorted(teeth, np.arange(500))
    arm = animate(IRB140, t, q).data["arms"][0]
    assert [words for _, words in arm["leaps"]["0"]] == ["q1 jumps by 4.0°"] * 6
    [note] = arm["notes"]["0"]
    assert note.startswith("Jumps in position: q1 jumps by 4.0° at 0.83 s; ")
    assert note.endswith("; and 3 more.") and not arm["jumps"]
    assert arm["speed"][0][0] == pytest.approx(0.2 / deg, abs=0.05)
    assert abs(arm["acceleration"][0][0]) < 0.1


@pytest.mark.parametrize(
    "t, words",
    [
        (T, "greatest values of 2001 samples, every 0.01 s"),
        (np.array([0, 0.01, 0.03, 0.04]), "greatest values of 4 samples, at most 0.02 s apart"),
    ],
)
def test_table_states_how_its_maxima_were_sampled(t, words):
    assert animate(IRB140, t, np.zeros((len(t), 6))).data["sampled"] == words


def test_samples_that_exceed_a_limit_are_counted(motions):
    q = motions[1].copy()
    q[:, 1] += 130 * deg
    over = int((q[:, 1] > IRB140.limits[1, 1]).sum())
    most = (q[:, 1].max() - IRB140.limits[1, 1]) / deg
    assert 0 < over < 2001
    [note] = animate(IRB140, T, q).data["arms"][0]["notes"]["0"]
    when = f"from {T[-over]:.2f} to 20.00 s"
    assert note == f"q2 exceeds its limit in {over} of 2001 samples, {when}, by up to {most:.1f}°."
    fast = animate(IRB140, T / 25, motions[1]).data["arms"][0]["notes"]["0"]
    assert any("exceeds its speed limit" in note for note in fast)


@pytest.mark.parametrize(
    "past, words", [(0.02, "0.020°"), (0.25, "0.25°"), (1.0, "1.0°"), (12.34, "12.3°")]
)
def test_excess_has_two_significant_digits(past, words):
    q = np.zeros((2001, 6))
    q[:, 1] = np.linspace(0, IRB140.limits[1, 1] + past * deg, 2001)
    [note] = animate(IRB140, T, q).data["arms"][0]["notes"]["0"]
    assert note.endswith(f"by up to {words}.")


def test_limits_are_shown_for_joints_near_them():
    q = np.zeros((3, 2001, 6))
    # the limit is 180 degrees
    q[:, :, 0] = np.linspace(0, 1, 2001) * np.array([[100], [120], [130]]) * deg
    q[1, :, 1] = np.linspace(0, -89, 2001) * deg  # the limit is -90 degrees
    q[2, :, 2] = np.linspace(0, 60, 2001) * deg  # beyond the limit of 50 degrees
    slow, fast = (
        animate(IRB140, t, q, slider=("x", [0, 1, 2])).data["panels"]
        # joint 1 turns at 195 degrees/s; its limit is 200 degrees/s
        for t in (T, np.linspace(0, 130 / 195, 2001))
    )
    # joint 3 first, because it exceeds its limit
    assert [panel["near"] for panel in slow] == [[[[2, 1], [1, 0]]], [[]], [[]]]
    assert [panel["near"] for panel in fast] == [[[[2, 1], [1, 0]]], [[[0, 1]]], [[]]]


@pytest.mark.parametrize("stroke", [(0.0, 0.18), (0.05, 0.06), (-0.03, 0.2), (0.1, 0.1)])
def test_two_scales_in_one_panel_share_their_zero_and_their_ticks(stroke):
    q = np.stack(
        [
            np.sin(T / 3),
            2 * np.cos(T / 4),
            np.linspace(*stroke, len(T)) + 0.01 * np.sin(T),
            0.1 * T,
        ],
        axis=-1,
    )
    panels = [panel["axes"] for panel in animate(SCARA, T, q).data["panels"]]
    for panel, unit in zip(panels, ("", "/s", "/s²"), strict=True):
        (low, step, count, _), (low2, step2, count2, _) = (
            panel["turn"]["scale"],
            panel["shift"]["scale"],
        )
        assert (panel["turn"]["unit"], panel["shift"]["unit"]) == (f"°{unit}", f"mm{unit}")
        assert (
            count == count2
            and low / step == pytest.approx(low2 / step2)
            and low <= 0 <= low + step * (count - 1)
        )
    angles, places = (panels[0][kind]["scale"] for kind in ("turn", "shift"))
    for values, (low, step, count, _) in ((q[:, [0, 1, 3]] / deg, angles), (q[:, 2] / mm, places)):
        assert low <= values.min() + 1e-6 and values.max() <= low + step * (count - 1) + 1e-6


def test_prismatic_joints_have_their_own_scale_in_millimetres():
    q = np.stack([np.sin(T / 3), np.cos(T / 4), 0.09 + 0.05 * np.sin(T), 0.1 * T], axis=-1)
    player = animate(SCARA, T, q)
    panel = player.data["panels"][1]["axes"]
    assert (panel["turn"]["unit"], panel["shift"]["unit"]) == ("°/s", "mm/s")
    assert decoded(player)[0][0, 0, 2] == pytest.approx(90, abs=0.01)
    assert player.data["arms"][0]["speed"][0][2] == pytest.approx(50, abs=0.1)
    assert player.data["scene"]["flat"] is None


def test_planar_arm_is_viewed_perpendicularly_to_its_plane():
    q = np.stack([np.sin(T / 3), np.cos(T / 4)], axis=-1)
    assert animate(PLANAR, T, q).data["scene"]["flat"] == 2
    assert animate(IRB140, T, 0.1 * np.ones((2001, 6))).data["scene"]["flat"] is None


def test_camera_stands_where_the_caller_puts_it(motions):
    scene = animate(IRB140, T, motions[1], view=(-0.5, 0.25)).data["scene"]
    assert scene["view"] == [-0.5, 0.25]
    plain = animate(IRB140, T, motions[1]).data["scene"]
    assert {**scene, "view": 0} == {**plain, "view": 0} and plain["view"] != scene["view"]
    for wrong in (0.5, [0.1, 0.2, 0.3], [[0.1, 0.2]], "above", [np.nan, 0]):
        with pytest.raises(ValueError, match="view: wanted"):
            animate(IRB140, T, motions[1], view=wrong)


def test_everything_drawn_is_in_view(blended, motions):
    """The few points in the data enclose all postures seen from any side, within a rounding error
    of 5 mm.
    """
    seen = np.array(blended.data["scene"]["seen"])
    points = IRB140.frames(motions[:, ::20]).translation.reshape(-1, 3)
    flange = IRB140.fk(motions[:, ::20])  # the flange is drawn with its axes
    tips = [
        (flange.rotation @ axis) * 0.13 * blended.data["scene"]["size"] + flange.translation
        for axis in (X, Y, Z)
    ]
    points = np.concatenate([points, np.reshape(tips, (-1, 3))])
    for k in range(24):
        side = np.array([np.cos(k), np.sin(k), np.sin(3 * k)])
        assert (points @ side).max() <= (seen @ side).max() + 0.06 * np.linalg.norm(side)
    assert len(seen) <= 100


def test_still_picture_has_the_view_and_scale_of_the_scene(motions):
    """The lines of the picture include the first and last postures of both arms, projected as in
    player.js.
    """
    player = animate(
        [IRB140, IRB140],
        T,
        [motions[1], motions[3]],
        names=["near", "far"],
        targets=[START, VIA, GOAL],
    )
    (azimuth, elevation), ends = player.data["scene"]["view"], []
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0])
    up = np.array(
        [
            -np.sin(elevation) * np.cos(azimuth),
            -np.sin(elevation) * np.sin(azimuth),
            np.cos(elevation),
        ]
    )
    for ax, q in zip(player.still.axes, (motions[1], motions[3]), strict=True):
        drawn = [np.column_stack(line.get_data()) for line in ax.lines]
        for posture in (q[0], q[-1]):
            points = arm_points(IRB140, posture)
            wanted = np.stack([points @ right, points @ up], axis=-1)
            assert any(
                line.shape == wanted.shape and np.allclose(line, wanted, atol=1e-3)
                for line in drawn
            )
        assert max(map(len, drawn)) > 500  # the path, from more samples than the page contains
        ends.append([*ax.get_xlim(), *ax.get_ylim()])
    assert np.allclose(*ends)


def test_several_arms_share_clock_and_scales(motions):
    player = animate([IRB140, IRB140], T, [motions[1], motions[3]], names=["near", "far"])
    assert [arm["name"] for arm in player.data["arms"]] == ["near", "far"]
    for k in (0, 1):
        assert abs(decoded(player, k)[0] - motions[[1, 3][k], kept(player)] / deg).max() < 0.01


def test_extreme_motion_does_not_reduce_the_precision_of_the_others(motions):
    """Each motion has its own rounding step: if the motion for one slider value is ten times as
    fast, the others are not rounded more coarsely.
    """
    alone = animate(IRB140, T, motions[1:3], slider=("blend", FRACTIONS[1:3]))
    wild = motions[1:].copy()
    wild[2] += 0.3 * np.sin(40 * T)[:, None]
    both = animate(IRB140, T, wild, slider=("blend", FRACTIONS[1:]))
    for a, b in zip(steps_of(alone), steps_of(both), strict=True):
        assert (a == b[:2]).all()
    assert steps_of(both)[2][2] > 100 * steps_of(both)[2][1]


# --- Marks that move ------------------------------------------------------------------------------

CIRCLING = np.stack([0.4 * np.cos(T), 0.4 * np.sin(T), 0.3 + 0 * T], axis=-1)


def moved(player, kind, columns):
    """The path of the only mark or target: (motions or 1, samples or 1, columns)."""
    [thing] = player.data["scene"]["things"]
    assert thing["kind"] == kind
    way = thing["pose" if kind == "target" else "at"]
    values = unpacked(way, columns, way["samples"])
    assert len(values) == way["motions"]
    return values


def test_a_point_can_move_with_time(motions):
    path = CIRCLING.copy()
    path[1500:] = np.nan
    player = animate(IRB140, T, motions[1], points={"ball": path})
    way, at = moved(player, "mark", 3), kept(player)
    assert way.shape == (1, len(at), 3)
    assert np.allclose(way[0], path[at], rtol=0, atol=1e-4, equal_nan=True)
    assert np.isnan(way[0][at >= 1500]).all()
    still = animate(IRB140, T, motions[1], points={"ball": CIRCLING[0]})
    [ball] = still.data["scene"]["things"]
    assert ball == {"kind": "mark", "name": "ball", "radius": 0.0, "at": [0.4, 0.0, 0.3]}
    balls = animate(IRB140, T, motions[1], circles=[(CIRCLING, 0.07)])
    [ball], view = balls.still.findobj(Circle), balls.data["scene"]["view"]
    assert ball.radius == 0.07 and np.allclose(ball.center, project(CIRCLING[-1], view))
    assert len(player.data["scene"]["things"][0]["at"]["data"]) < 1100  # about one byte per value


def test_marks_can_move_with_slider_and_switch(motions):
    q = np.stack([motions[:2], motions[2:]])
    words = {"slider": ("x", [1, 2]), "switch": ("y", ["a", "b"])}
    at = np.arange(12.0).reshape(2, 2, 1, 3) / 20
    player = animate(IRB140, T, q, circles=[(at, 0.05)], **words)
    assert np.allclose(moved(player, "mark", 3), at.reshape(4, 1, 3), atol=1e-4)
    assert player.data["scene"]["things"][0]["radius"] == 0.05
    paths = CIRCLING + at
    player = animate(IRB140, T, q, points=[paths], **words)
    assert np.allclose(
        moved(player, "mark", 3), paths.reshape(4, -1, 3)[:, kept(player)], atol=1e-4
    )
    player = animate(IRB140, T, q, points=[CIRCLING], **words)  # the same path in all motions
    assert moved(player, "mark", 3).shape[0] == 1


def test_a_target_can_move(motions):
    carried = IRB140.fk(motions[1])
    for given, motion in ((carried, motions[1]), (IRB140.fk(motions[1:3]), motions[1:3])):
        extra = {"slider": ("x", [1, 2])} if motion.ndim == 3 else {}
        player = animate(IRB140, T, motion, targets={"part": given}, **extra)
        way, at = moved(player, "target", 12), kept(player)
        wanted = given.as_matrix()[..., at, :3, :].reshape(-1, len(at), 12)
        assert np.allclose(way, wanted, rtol=0, atol=1.1e-4)
    gone = motions[1].copy()
    gone[:100] = np.nan
    player = animate(IRB140, T, motions[1], targets={"part": IRB140.fk(gone)})
    assert np.isnan(moved(player, "target", 12)[0, 0]).all()


def test_distance_to_the_via_point_of_each_motion_is_shown(motions):
    place = np.array([[[0.6, 0, 0.8]], [[0.65, -0.1, 0.8]]])
    via = Transform(translation=place)
    pair = motions[[1, 1]]
    player = animate(IRB140, T, pair, targets={"via": via}, slider=("x", [1, 2]))
    path = IRB140.fk(motions[1]).translation
    for (near, *at), centre in zip(player.data["arms"][0]["via"], place[:, 0], strict=True):
        least = np.linalg.norm(path - centre, axis=-1).min()
        assert near == pytest.approx(least / mm, abs=0.06)
        assert np.linalg.norm(at - centre) == pytest.approx(least, abs=2e-4)
    moving = animate(IRB140, T, motions[1], targets={"via": IRB140.fk(motions[1])})
    assert moving.data["arms"][0]["via"] is None


def test_all_positions_of_moving_things_are_in_view(motions):
    path = 3 * CIRCLING
    player = animate(IRB140, T, motions[1], circles=[(path, 0.2)])
    seen = np.array(player.data["scene"]["seen"])
    for side in np.eye(3):
        assert (seen @ side).max() >= (path @ side).max() + 0.19


@pytest.mark.parametrize(
    "change, message",
    [
        ({"points": [CIRCLING[:7]]}, r"points: wanted shape \(2001, 3\).*got \(7, 3\)"),
        ({"points": [CIRCLING[:, :2]]}, "points: wanted points of shape"),
        ({"points": [np.stack([CIRCLING] * 3)]}, r"wanted shape \(2001, 3\)"),
        ({"points": [np.full((2001, 3), np.inf)]}, "finite"),
        ({"points": [(np.nan, 0, 0)]}, "finite"),
        ({"circles": [(CIRCLING[:5], 0.1)]}, "circles: wanted shape"),
        ({"circles": [(CIRCLING, np.ones(2001))]}, "radius"),
        ({"points": [1e10 * CIRCLING]}, "points: wanted at most"),
        (
            {"targets": {"a": Transform(translation=CIRCLING[:9])}},
            r"target a: wanted shape \(2001,\) or \(1,\), got \(9,\)",
        ),
        ({"targets": {"a": Transform(translation=np.zeros((2, 2001, 3)))}}, "target a: wanted"),
    ],
)
def test_marks_with_wrong_shapes_are_refused(motions, change, message):
    with pytest.raises(ValueError, match=message):
        animate(IRB140, T, motions[1], **change)


# --- Several arms in one picture, faces, readings -------------------------------------------------

BASES = np.array([[0.2, -0.5], [0.2, 0.7], [0.2, 1.9]])
BELT = [[0.7, -1, 0.1], [0.8, -1, 0.1], [0.8, 2, 0.1], [0.7, 2, 0.1]]


def test_arms_on_bases_share_one_picture(motions):
    three = [motions[k] for k in (1, 2, 3)]
    alone = animate(IRB140, T, motions[1]).data["scene"]
    scene = animate([IRB140] * 3, T, three, bases=BASES, faces=[BELT]).data["scene"]
    assert alone["bases"] is None and alone["things"] == []
    assert scene["bases"] == [[*base, 0] for base in BASES.tolist()]
    assert scene["things"] == [{"kind": "faces", "corners": [BELT]}]
    seen = np.array(scene["seen"])
    for base, q in zip(BASES, three, strict=True):
        tool = IRB140.fk(q).translation + [*base, 0]
        for side in np.concatenate([np.eye(3), -np.eye(3)]):
            assert (seen @ side).max() >= (tool @ side).max() - 0.02
    assert seen[:, 1].min() <= -0.99 and seen[:, 1].max() >= 1.99  # the belt


def test_still_picture_has_every_arm_at_its_base(motions):
    one = animate(IRB140, T, motions[1])
    pair = animate([IRB140] * 2, T, [motions[1]] * 2, bases=BASES[:2], faces=[BELT])
    assert len(one.still.axes) == len(pair.still.axes) == 1
    view = pair.data["scene"]["view"]
    tip = project(IRB140.fk(motions[1][-1]).translation + np.pad(BASES[:2], ((0, 0), (0, 1))), view)
    drawn = np.concatenate([line.get_xydata() for line in pair.still.axes[0].lines])
    for place in tip:
        assert np.linalg.norm(drawn - place, axis=-1).min() < 1e-9
    corners = project(np.array(BELT), view)
    assert any(
        len(patch.get_xy()) == 5 and np.allclose(patch.get_xy()[:4], corners)
        for patch in pair.still.findobj(Polygon)
    )


def test_only_arms_at_different_places_show_no_frames_of_their_tools(motions):
    for other, framed in ((BASES[0], True), (BASES[1], False)):
        made = animate([IRB140] * 2, T, [motions[1]] * 2, bases=np.stack([BASES[0], other]))
        colors = {line.get_color() for line in made.still.axes[0].lines}
        assert set(AXIS_COLORS) <= colors if framed else not set(AXIS_COLORS) & colors


def test_arms_on_bases_show_no_distance_to_the_via_point(motions):
    via = {"via": IRB140.fk(motions[1][900])}
    pair = [IRB140] * 2, T, [motions[1]] * 2
    assert animate(*pair, targets=via).data["arms"][0]["via"]
    assert animate(*pair, targets=via, bases=BASES[:2]).data["arms"][0]["via"] is None


def test_a_reading_is_exact_and_keeps_its_decimals(motions):
    count, clock = np.floor(3 * T), np.round(T + 0.25, 2)
    clock[:40] = np.nan
    player = animate(
        IRB140,
        T,
        motions[1],
        points={"bin": (1, 0, 0), "s": CIRCLING},
        readings={"bin": count, "s": clock},
    )
    readings = {thing["name"]["name"]: thing["name"] for thing in player.data["scene"]["things"]}
    for name, values, decimals in (("bin", count, 0), ("s", clock, 2)):
        way = readings[name]
        got = unpacked(way, 1, way["samples"])[0, :, 0]
        assert np.allclose(got, values[kept(player)], rtol=0, atol=1e-3, equal_nan=True)
        assert way["decimals"] == decimals
    words = [text.get_text() for text in player.still.findobj(Text)]
    assert f"bin: {count[-1]:.0f}" in words and f"s: {clock[-1]:.2f}" in words


@pytest.mark.parametrize(
    "change, message",
    [
        ({"bases": [[0, 0]]}, r"bases: wanted x and y for each of several arms, \(2, 2\)"),
        ({"bases": np.zeros((2, 3))}, "bases: wanted x and y"),
        ({"bases": [[0, 0], [0, np.nan]]}, "bases: wanted finite"),
        ({"faces": [BELT[:2]]}, "faces: wanted 3 to 100 corners"),
        ({"faces": BELT}, "faces: wanted 3 to 100 corners"),
        ({"faces": 7}, "faces: wanted a list of polygons"),
        ({"readings": {"nobody": T}}, "readings: wanted names of points or circles, got 'nobody'"),
        ({"readings": [T]}, "readings: wanted a dict"),
        ({"readings": {"p": T[:7]}}, r"reading p: wanted shape \(2001,\).*got \(7,\)"),
        ({"readings": {"p": 1e10 * T}}, "reading p: wanted numbers up to"),
    ],
)
def test_invalid_things_are_refused(motions, change, message):
    with pytest.raises(ValueError, match=message):
        animate([IRB140] * 2, T, [motions[1]] * 2, points={"p": (0, 0, 0)}, **change)
    with pytest.raises(ValueError, match="bases: wanted x and y for each of several arms"):
        animate(IRB140, T, motions[1], bases=[[0, 0]])


# --- Size and reproducibility ---------------------------------------------------------------------


def test_rounding_errors_do_not_change_the_page(blended, motions):
    again = animate(IRB140, T, motions, targets=[START, VIA, GOAL], slider=("blend", FRACTIONS))
    assert again.html == blended.html
    noise = 1 + 1e-15 * np.random.default_rng(1).standard_normal(motions.shape)
    other = animate(
        IRB140, T, motions * noise, targets=[START, VIA, GOAL], slider=("blend", FRACTIONS)
    )
    assert other.text == blended.text and repr(other) == repr(blended)
    assert animate(IRB140, T, motions[1]).id != animate(IRB140, T, motions[2]).id


def test_id_does_not_depend_on_the_picture(blended):
    assert blended.id in blended.html and "iVBOR" not in blended.text


def test_page_is_small(motions):
    q = np.broadcast_to(motions[1], (2, 51, *motions[1].shape))
    values = np.linspace(0, 0.5, 51)
    player = animate(
        IRB140,
        T,
        q,
        targets=[START, VIA, GOAL],
        slider=("blend", values),
        switch=("corner", ["a", "b"]),
    )
    assert 110 <= len(player.data["times"]) <= 121
    assert len(player.html.encode()) < 400_000
    assert len(animate(IRB140, T, motions[1]).html.encode()) < 56_000


def test_mime_bundle_has_html_and_text(blended):
    bundle = blended._repr_mimebundle_()
    assert set(bundle) == {"text/html", "text/plain"}
    farthest = blended.data["arms"][0]["via"][3][0]
    assert bundle["text/plain"] == (
        "Player of IRB-140: 20 s, blend 0 to 0.5 in 4 values, greatest speed of 2001 samples "
        f"31.2 °/s (joint 3), smallest distance from the via point 0 to {farthest:g} mm."
    )
    picture = (
        r'<img alt="IRB-140 in the first and last posture[^"]*" '
        r'[^>]*src="data:image/png;base64,'
    )
    assert re.search(picture, bundle["text/html"])


def test_data_cannot_end_the_script(motions):
    player = animate(IRB140, T, motions[1], title="</script><b>", points={"<!--": (0.1, 0.2, 0.3)})
    script = player.html.split("<script>")[1]
    assert script.count("</script>") == 1 and "<!--" not in script and "<b>" not in script
    assert json.loads(player.text)["title"] == "</script><b>"


# --- Saving and invalid calls ---------------------------------------------------------------------


def test_save_writes_one_page_and_keeps_other_files(tmp_path, blended):
    page = tmp_path / "player.html"
    blended.save(page)
    blended.save(str(page))  # a saved player may be replaced
    text = page.read_text(encoding="utf-8")
    assert blended.html in text and not re.search(r"(src|href)=.?(https?:)?//", text)
    other = tmp_path / "notes.html"
    other.write_text("my notes")
    with pytest.raises(ValueError, match="nothing is overwritten"):
        blended.save(other)
    assert other.read_text() == "my notes"
    with pytest.raises(ValueError, match="ends in .html"):
        blended.save(tmp_path / "player.txt")


@pytest.mark.parametrize("there", ["dangling link", "link", "link to a player", "folder"])
def test_save_never_writes_through_links_or_folders(tmp_path, blended, there):
    page, target = tmp_path / "player.html", tmp_path / "target.html"
    if there == "folder":
        page.mkdir()
    else:
        page.symlink_to(target)
    if there == "link":
        target.write_text("mine")
    if there == "link to a player":
        blended.save(target)
    before = {path: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()}
    with pytest.raises(ValueError, match="nothing is overwritten"):
        blended.save(page)
    assert {path: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()} == before
    assert page.is_symlink() or page.is_dir()


def test_page_is_saved_completely_or_not_at_all(tmp_path, blended, monkeypatch):
    page = tmp_path / "player.html"
    blended.save(page)
    before = page.read_bytes()
    assert page.stat().st_mode & 0o777 == 0o666 & ~_umask()

    def full(*_):
        raise OSError("no space left on device")

    monkeypatch.setattr("os.replace", full)
    with pytest.raises(OSError, match="no space"):
        blended.save(page)
    assert page.read_bytes() == before and list(tmp_path.iterdir()) == [page]


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


ODD = 'a $\\frac{ b$ \ud800 <b> & "c"'


def test_titles_and_names_are_plain_text(motions):
    """Titles are not read as formulas or markup; lone surrogates become replacement characters."""
    player = animate(
        [IRB140, IRB140],
        T,
        [motions[1], motions[1]],
        title=ODD,
        names=[ODD, "b"],
        targets={ODD: START},
        points={ODD: (0.1, 0.2, 0.3)},
        switch=None,
    )
    shown = ODD.replace("\ud800", "\ufffd")
    assert player.data["title"] == shown and player.data["arms"][0]["name"] == shown
    assert json.loads(player.text)["title"] == shown
    drawn = [text for text in player.still.findobj(Text) if "frac" in text.get_text()]
    assert len(drawn) >= 4 and not any(text.get_parse_math() for text in drawn)
    assert shown in drawn[0].get_text() and "<img" in player.html


@pytest.mark.parametrize(
    "change, kind, message",
    [
        ({"arm": "IRB140"}, TypeError, "arm: wanted an Arm"),
        ({"arm": []}, ValueError, "one array for each of 0 arms"),
        ({"arm": [IRB140, 3]}, TypeError, "arm: wanted an Arm"),
        ({"t": []}, ValueError, "at least three times"),
        ({"t": None}, ValueError, "t: wanted numbers"),
        ({"t": T[:2], "q": np.zeros((2, 6))}, ValueError, "at least three times"),
        ({"t": T[::-1]}, ValueError, "increasing times"),
        ({"t": np.full(2001, np.nan)}, ValueError, "t: wanted finite"),
        ({"q": np.zeros((2001, 5))}, ValueError, r"wanted shape \(2001, 6\)"),
        ({"q": np.zeros((2000, 6))}, ValueError, r"wanted shape \(2001, 6\) \(samples, joints\)"),
        ({"q": np.full((2001, 6), np.inf)}, ValueError, "finite"),
        ({"q": "no"}, ValueError, "wanted numbers"),
        (
            {"slider": ("blend", [0, 0.1])},
            ValueError,
            r"wanted shape \(2, 2001, 6\) \(slider, samples, joints\)",
        ),
        ({"slider": ("blend", [0.1])}, ValueError, "at least two"),
        ({"slider": ("blend", [0.1, 0.1])}, ValueError, "increasing"),
        ({"slider": "blend"}, ValueError, r"slider: wanted \(name, values\)"),
        ({"slider": 3}, ValueError, r"slider: wanted \(name, values\)"),
        ({"switch": ("corner", ["one"])}, ValueError, "at least two strings"),
        ({"switch": ("corner", [1, 2])}, ValueError, "switch: wanted a string"),
        ({"switch": ("corner", ["one", "two"])}, ValueError, r"wanted shape \(2, 2001, 6\)"),
        ({"names": ["x"]}, ValueError, "names: allowed only with a list"),
        ({"arm": [IRB140, IRB140]}, ValueError, "one array for each of 2 arms"),
        (
            {"arm": [IRB140], "q": [np.zeros((2001, 6))], "names": ["a", "b"]},
            ValueError,
            "wanted 1 names",
        ),
        ({"arm": [IRB140], "q": [np.zeros((2001, 6))], "names": 3}, ValueError, "wanted 1 names"),
        ({"arm": [IRB140], "q": [np.zeros((2001, 6))], "names": [3]}, ValueError, "names: wanted"),
        ({"targets": [(1, 2, 3)]}, TypeError, "target"),
        ({"targets": None}, TypeError, "targets: wanted Transforms, got None"),
        ({"targets": "start"}, TypeError, "targets: wanted Transforms"),
        ({"title": 3}, ValueError, "title: wanted a string"),
        ({"title": "x" * 3000}, ValueError, "title: wanted at most 2000 characters"),
        ({"points": [(1, 2, 3, 4)]}, ValueError, "points: wanted points of shape"),
        ({"points": None}, ValueError, "points: wanted a list"),
        ({"circles": [3]}, ValueError, "circles: wanted"),
        ({"circles": 3}, ValueError, "circles: wanted"),
        ({"circles": [((0, 0, 0), -1)]}, ValueError, "radius"),
    ],
)
def test_errors_name_the_invalid_argument_and_say_what_is_wanted(change, kind, message):
    call = {"arm": IRB140, "t": T, "q": np.zeros((2001, 6))} | change
    arm, t, q = call.pop("arm"), call.pop("t"), call.pop("q")
    with pytest.raises(kind, match=message):
        animate(arm, t, q, **call)


def test_invalid_recordings_are_refused(motions):
    one = record(IRB140, T, motions[1])
    for wrong, message in (
        (lambda: animate(one, T), "not allowed with recordings"),
        (lambda: animate(one, slider=("x", [1, 2])), r"wanted shape \(2, 2001, 6\)"),
        (lambda: animate(record(IRB140, T[:2], motions[1, :2])), "at least three times"),
        (lambda: animate([one, record(IRB140, 2 * T, motions[1])]), "the same times"),
    ):
        with pytest.raises(ValueError, match=message):
            wrong()
    with pytest.raises(TypeError, match="wanted an Arm"):
        animate([one, IRB140])


@pytest.mark.parametrize("path", [None, 3, "", "player.txt", b"player.html", ".html"])
def test_file_name_without_html_is_refused(blended, path):
    with pytest.raises(ValueError, match="ends in .html"):
        blended.save(path)


# --- In a browser ---------------------------------------------------------------------------------


@pytest.fixture
def page(browser):
    """A page that must not report errors or send requests to other hosts."""
    page = browser.new_page(viewport={"width": 900, "height": 900})
    complaints = []
    page.on(
        "console", lambda m: complaints.append(m.text) if m.type in ("error", "warning") else None
    )
    page.on("pageerror", lambda e: complaints.append(str(e)))
    page.on(
        "request",
        lambda r: (
            None if r.url.startswith(("file:", "data:", "about:")) else complaints.append(r.url)
        ),
    )
    yield page
    page.close()
    assert complaints == []


def show(page, player, tmp_path):
    player.save(tmp_path / "player.html")
    page.goto((tmp_path / "player.html").as_uri())
    awake(page)
    page.get_by_role("button", name="play").wait_for()
    return page


def ink(page, selector):
    """A hash of the content of a canvas after the next frame."""
    return page.evaluate(
        """selector => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() =>
        done(document.querySelector(selector).toDataURL()))))""",
        selector,
    )


@pytest.mark.parametrize("arm", [IRB140, SCARA, PLANAR], ids=lambda arm: arm.name)
def test_the_page_computes_the_frames_of_the_arm(page, arm):
    q = np.random.default_rng(7).uniform(arm.limits[:, 0], arm.limits[:, 1], (50, len(arm.links)))
    player = animate(arm, T, np.linspace(q[0], q[1], 2001))
    got = page.evaluate(
        "([script, chain, q]) => q.map(row => new Function(script + 'return $kinematics')()"
        ".frames(chain, row))",
        [script("player"), player.data["arms"][0]["chain"], q.tolist()],
    )
    assert np.allclose(
        np.reshape(got, (50, -1, 3, 4)), arm.frames(q).as_matrix()[..., :3, :], rtol=0, atol=2e-8
    )


def test_the_slider_changes_arm_curves_and_numbers(page, blended, tmp_path):
    show(page, blended, tmp_path)
    assert page.locator("img").count() == 0  # the still picture is gone
    page.get_by_label("time", exact=True).fill("200")
    seen = [(ink(page, ".rk-scene"), ink(page, ".rk-curves"), page.locator("table").inner_text())]
    assert blended.data["sampled"] in seen[0][2]
    assert (
        "jump 52.7" in seen[0][2]
        and "speed jumps at 10.00 s" in page.locator(".rk-notes").inner_text()
    )
    slider = page.get_by_label("blend", exact=True)
    slider.focus()
    for _ in FRACTIONS[1:]:
        page.keyboard.press("ArrowRight")
        seen.append(
            (ink(page, ".rk-scene"), ink(page, ".rk-curves"), page.locator("table").inner_text())
        )
    for part in zip(*seen, strict=True):
        assert len(set(part)) == len(FRACTIONS)
    assert page.locator(".rk-value").first.inner_text() == "0.50"
    arm = blended.data["arms"][0]
    for j in range(6):
        assert f"{arm['speed'][3][j]:.1f} ({arm['share'][3][j]}\u00a0%)" in seen[3][2]
        assert f"{arm['acceleration'][3][j]:.1f}" in seen[3][2]
    said = page.locator(".rk-says").inner_text()
    assert said == f"The path passes {arm['via'][3][0]:.1f} mm from via."


def test_player_can_be_played_paused_and_scrubbed_by_keyboard_alone(page, blended, tmp_path):
    show(page, blended, tmp_path)
    time = page.get_by_label("time", exact=True)
    assert time.input_value() == "0"
    page.wait_for_timeout(200)
    assert time.input_value() == "0"  # no autoplay
    for _ in range(7):  # the tab order: slider, button, time, playback, panel, numbers, scene
        page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.className") == "rk-scene"
    before = ink(page, ".rk-scene")
    page.keyboard.press("ArrowRight")
    turned = ink(page, ".rk-scene")
    page.keyboard.press("Home")
    assert turned != before == ink(page, ".rk-scene")
    begun = page.evaluate("performance.now()")
    page.keyboard.press("Space")
    until(lambda: int(time.input_value()) > 5, "it does not play", page)
    assert page.get_by_role("button", name="pause").count() == 1
    page.keyboard.press("Space")
    stopped = time.input_value()
    seconds = (page.evaluate("performance.now()") - begun) / 1000
    assert 5 < int(stopped) <= min(400, 20 * seconds + 1)  # 400 ticks are 20 s
    page.wait_for_timeout(200)
    assert time.input_value() == stopped
    for _ in range(4):
        page.keyboard.press("Shift+Tab")
    page.keyboard.press("ArrowRight")
    assert time.input_value() == str(int(stopped) + 1)
    page.keyboard.press("End")
    ink(page, ".rk-scene")
    assert page.get_by_text("20.00 s").count() == 1


def test_a_motion_ends_soon_after_everything_has_come_to_rest(page, tmp_path):
    """A race: the axis has room for the slowest of its motions, and no other one waits for it."""
    t = np.linspace(0, 2, 201)
    ends = np.array([0.5, 1.9, 0.8])
    q = np.minimum(t / ends[:, None], 1)[..., None] * np.ones(6) * 0.5
    place = np.array([0.2, 0, 0.1]) * np.minimum(t / [[0.5], [1.9], [1.6]], 1)[..., None]
    still = np.zeros_like(q[:1])
    motions = animate(
        IRB140,
        t,
        np.concatenate([q, still]),
        slider=("motion", range(4)),
        points={"box": np.concatenate([place, place[:1] * 0])},
    )
    show(page, motions, tmp_path)
    time, slider = page.get_by_label("time", exact=True), page.get_by_label("motion", exact=True)
    for k, end in enumerate([0.6, 2, 1.7, 2]):  # the box of the third moves on without the arm
        slider.fill(str(k))
        time.press("End")
        ink(page, ".rk-scene")
        shown = float(re.search(r"([\d.]+) s", time.get_attribute("aria-valuetext"))[1])
        assert shown == pytest.approx(end, abs=0.03)
    slider.fill("0")
    page.get_by_role("button", name="play").click()
    page.get_by_role("button", name="play").wait_for(timeout=20_000)  # it has played to the end
    ink(page, ".rk-scene")
    assert time.input_value() == "400" and page.get_by_text("0.60 s").count() == 1


def test_controls_have_names_and_their_key_presses_do_not_reach_jupyterlab(page, blended, tmp_path):
    show(page, blended, tmp_path)
    controls = page.locator("input, select, button, canvas[tabindex]")
    assert controls.count() >= 5
    for i in range(controls.count()):
        assert controls.nth(i).get_attribute("data-lm-suppress-shortcuts") == "true"
        assert controls.nth(i).get_attribute("aria-label")
    assert page.locator("canvas[role=img][aria-label]").count() == 2
    assert page.locator("[aria-live], [role=status], output").count() == 0


def test_dragging_turns_the_arm_and_sets_the_time(page, blended, tmp_path):
    show(page, blended, tmp_path)
    before = ink(page, ".rk-scene")
    box = page.locator(".rk-scene").bounding_box()
    page.mouse.move(box["x"] + 100, box["y"] + 100)
    page.mouse.down()
    page.mouse.move(box["x"] + 160, box["y"] + 120)
    page.mouse.up()
    assert ink(page, ".rk-scene") != before
    page.locator(".rk-scene").dblclick()
    assert ink(page, ".rk-scene") == before
    box = page.locator(".rk-curves").bounding_box()
    page.mouse.click(box["x"] + box["width"] - 16, box["y"] + 100)  # the right end of the time axis
    ink(page, ".rk-curves")
    assert int(page.get_by_label("time", exact=True).input_value()) > 390


def test_two_copies_of_a_player_are_independent(page, blended, tmp_path):
    page.set_content(blended.html + blended.html)
    awake(page)
    assert page.get_by_role("button", name="play").count() == 2
    page.get_by_label("blend", exact=True).nth(1).fill("3")
    ink(page, ".rk-scene")
    assert [v.inner_text() for v in page.locator(".rk-row:not(.rk-clock) .rk-value").all()] == [
        "0.00",
        "0.50",
    ]


def test_removed_player_requests_no_more_frames(page, blended, tmp_path):
    page.add_init_script("""window.asked = 0; const ask = window.requestAnimationFrame;
        window.requestAnimationFrame = f => { window.asked++; return ask.call(window, f); };""")
    show(page, blended, tmp_path)
    page.get_by_role("button", name="play").click()
    until(lambda: page.evaluate("asked") > 3, "it does not play", page)
    page.evaluate("document.querySelector('.robokin-player').remove()")
    page.wait_for_timeout(150)
    asked = page.evaluate("asked")
    page.wait_for_timeout(300)
    assert page.evaluate("asked") == asked


@pytest.mark.parametrize("width", [360, 800, 1400])
def test_limit_labels_do_not_overlap(page, tmp_path, width):
    """Six joints move from limit to limit; the labels have units and do not overlap."""
    s = np.sin(np.outer(T, np.arange(1, 7)) / 4)
    q = IRB140.limits.mean(axis=-1) + s * np.diff(IRB140.limits, axis=-1).T / 2 * 0.99
    page.add_init_script("""window.written = [];
        const write = CanvasRenderingContext2D.prototype.fillText;
        CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
            if (/limit/.test(text)) window.written.push([text, x, y, this.measureText(text).width]);
            return write.call(this, text, x, y); };""")
    page.set_viewport_size({"width": width, "height": 900})
    show(page, animate(IRB140, T, q), tmp_path)
    page.evaluate("written.length = 0")
    page.get_by_label("time", exact=True).fill("10")
    ink(page, ".rk-curves")
    written = page.evaluate("written")
    assert written or width == 360
    for k, (text, x, y, w) in enumerate(written):
        assert re.fullmatch("q[1-6] limit −?[0-9.]+°(/s)?", text)
        assert not any(
            x < x2 + w2 and x2 < x + w and abs(y - y2) < 10 for _, x2, y2, w2 in written[:k]
        )


@pytest.mark.parametrize("jumps", [(1.13, 4.87), tuple(np.arange(0.83, 6, 0.6))])
@pytest.mark.parametrize("width", [390, 900])
def test_message_about_a_jump_does_not_cover_a_curve(page, tmp_path, width, jumps):
    """Joint 2 of one arm jumps, that of the other does not, near the top of the panel."""
    t = np.linspace(0, 6, 1500)
    still = np.stack([-1 - 0.1 * t, np.full_like(t, 1.7)], axis=-1)
    jumping = still - np.outer(np.searchsorted(jumps, t) % 2, [0, 0.6 if len(jumps) > 2 else 3])
    page.set_viewport_size({"width": width, "height": 900})
    both = animate([PLANAR, PLANAR], t, [jumping, still], names=["jumps", "does not"])
    show(page, both, tmp_path)
    page.evaluate(COVERED, ["jumps by", ["joint1", "joint2"]])
    page.get_by_label("time", exact=True).fill("0.1")
    ink(page, ".rk-curves")
    covered = page.evaluate("covered")
    assert covered
    assert [text for text, pixels in covered if pixels > 50] == []


@pytest.mark.parametrize("width", [360, 500, 900, 1400])
def test_nothing_is_cut_off_at_any_width(page, blended, tmp_path, width):
    page.set_viewport_size({"width": width, "height": 900})
    show(page, blended, tmp_path)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    boxes = [page.locator(s).bounding_box() for s in (".rk-scene", ".rk-curves")]
    # side by side on a wide page, otherwise one above the other
    assert (boxes[0]["y"] == boxes[1]["y"]) == (width >= 900)
    assert all(box["width"] > 250 and box["height"] > 250 for box in boxes)


def test_page_without_scripts_shows_the_still_picture(browser, blended, tmp_path):
    blended.save(tmp_path / "player.html")
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((tmp_path / "player.html").as_uri())
    box = page.get_by_role("img", name="IRB-140 in the first and last posture").bounding_box()
    assert box["width"] > 400 and box["height"] > 200
    context.close()


def test_marks_move_on_the_page(page, motions, tmp_path):
    """The arm does not move; only the mark changes with time and slider, and it is missing where it
    is NaN.
    """
    q = np.broadcast_to(motions[1, 0], (2, 2001, 6))
    path = np.stack([CIRCLING, CIRCLING + [0, 0, 0.2]])
    path[:, 1500:] = np.nan
    player = animate(IRB140, T, q, points={"ball": path}, slider=("x", [1, 2]))
    page.add_init_script("""window.written = [];
        const write = CanvasRenderingContext2D.prototype.fillText;
        CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
            window.written.push(text);
            return write.call(this, text, x, y); };""")
    show(page, player, tmp_path)
    clock, seen = page.get_by_label("time", exact=True), set()
    for slider in "01":
        page.get_by_label("x", exact=True).fill(slider)
        for ticks in ("0", "100", "200"):
            clock.fill(ticks)
            ink(page, ".rk-scene")
            page.evaluate("written.length = 0")
            clock.fill(str(int(ticks) + 1))
            seen.add(ink(page, ".rk-scene"))
            assert "ball" in page.evaluate("written")
    assert len(seen) == 6
    page.evaluate("written.length = 0")
    clock.fill("390")  # the clock ends soon after the mark is gone
    ink(page, ".rk-scene")
    assert page.evaluate("written.length") and "ball" not in page.evaluate("written")


def test_arms_on_bases_are_drawn_separately_and_readings_change(page, tmp_path):
    """Two arms do not move; the test checks where they and their points are drawn, and when the
    readings change.
    """
    arm, t = spbu_arm(0.5, 0.4), np.linspace(0, 4, 41)
    q = np.broadcast_to([0.2, 0.4, 0.3], (41, 3))
    count = np.floor(t)
    player = animate(
        [arm, arm],
        t,
        [q, q],
        bases=[[0, 0], [0, 2]],
        faces=[[[0.5, -1, 0], [0.6, -1, 0], [0.6, 3, 0], [0.5, 3, 0]]],
        points={"left": (0, 0, 0), "right": (0, 2, 0)},
        readings={"right": count},
    )
    page.add_init_script("""window.written = [];
        const write = CanvasRenderingContext2D.prototype.fillText;
        CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
            window.written.push([text, x, y]);
            return write.call(this, text, x, y); };
        window.spots = [];
        const arc = CanvasRenderingContext2D.prototype.arc;
        CanvasRenderingContext2D.prototype.arc = function (x, y, r, ...rest) {
            if (this.canvas.className.includes("rk-scene")) window.spots.push([x, y, r]);
            return arc.call(this, x, y, r, ...rest); };""")
    show(page, player, tmp_path)
    clock = page.get_by_label("time", exact=True)
    for ticks, said in (
        ("0", "right: 0"),
        ("95", "right: 0"),
        ("100", "right: 1"),
        ("395", "right: 3"),
    ):
        clock.fill("1")
        ink(page, ".rk-scene")
        page.evaluate("written.length = spots.length = 0")
        clock.fill(ticks)
        ink(page, ".rk-scene")
        words = [text for text, *_ in page.evaluate("written")]
        assert said in words and "left" in words
        assert sum(word.startswith("right") for word in words) == 1
    spots = np.array(page.evaluate("spots"))
    points, tools = (spots[abs(spots[:, 2] - radius) < 1e-6][:, :2] for radius in (3.5, 3.6))
    assert len(points) == len(tools) == 2
    assert np.allclose(tools[1] - tools[0], points[1] - points[0], atol=1e-6)
    assert np.linalg.norm(points[1] - points[0]) > 100


PAINTED = """selector => {
    const canvas = document.querySelector(selector), w = canvas.width, h = canvas.height;
    const data = w && h ? canvas.getContext('2d').getImageData(0, 0, w, h).data : [];
    return data.filter((value, i) => i % 4 === 3 && value).length; }"""


def test_picture_is_drawn_again_after_the_player_has_been_hidden(page, blended, tmp_path):
    """As during a theme change in JupyterLab, a picture is requested while the player is hidden;
    afterwards the player has its old size again, so that no resize is reported.
    """
    canvases = (".rk-scene", ".rk-curves")
    move = """() => {
        const slider = document.querySelector('.robokin-player input');
        slider.value = 100;
        slider.dispatchEvent(new Event('input')); }"""
    show(page, blended, tmp_path)
    before = [ink(page, canvas) for canvas in canvases]
    page.evaluate(move)
    moved = [ink(page, canvas) for canvas in canvases]
    assert all(a != b for a, b in zip(before, moved, strict=True))
    show(page, blended, tmp_path)
    page.evaluate(f"""() => {{
        ({move})();
        const root = document.querySelector('.robokin-player');
        root.style.display = 'none';
        requestAnimationFrame(() => {{ root.style.display = ''; }}); }}""")
    until(
        lambda: [ink(page, canvas) for canvas in canvases] == moved,
        "the player still shows the picture from before it was hidden",
        page,
    )


def test_theme_follows_jupyterlab_or_the_system(page, blended, tmp_path):
    show(page, blended, tmp_path)
    theme = "name => { document.body.dataset.jpThemeLight = name; }"
    paper = "() => getComputedStyle(document.querySelector('.rk')).backgroundColor"

    def seen():
        return ink(page, ".rk-scene"), ink(page, ".rk-curves"), page.evaluate(paper)

    light = seen()
    page.emulate_media(color_scheme="dark")
    until(lambda: all(map(ne, light, seen())), "it stays light", page)
    dark = seen()
    page.evaluate(theme, "true")
    until(lambda: seen() == light, "it stays dark", page)
    page.emulate_media(color_scheme="light")
    page.evaluate(theme, "false")
    until(lambda: seen() == dark, "it stays light", page)
    page.evaluate(theme, "true")
    until(lambda: seen() == light, "it stays dark", page)


def test_canvases_have_at_most_two_device_pixels_per_pixel(browser, blended, tmp_path):
    blended.save(tmp_path / "player.html")
    page = browser.new_page(viewport={"width": 900, "height": 900}, device_scale_factor=3)
    page.goto((tmp_path / "player.html").as_uri())
    awake(page)
    for selector in (".rk-scene", ".rk-curves"):
        ink(page, selector)
        assert page.evaluate(
            "s => { const c = document.querySelector(s); return c.width / c.clientWidth; }",
            selector,
        ) == pytest.approx(2, abs=0.01)
    page.close()


def test_still_picture_explains_how_to_start_the_view(page, browser, blended, tmp_path):
    show(page, blended, tmp_path)
    assert page.get_by_text("trust the notebook").count() == 0
    context = browser.new_context(java_script_enabled=False)
    still = context.new_page()
    still.goto((tmp_path / "player.html").as_uri())
    assert still.get_by_text(STILL).is_visible()
    context.close()


def test_view_that_another_one_pushes_away_starts_when_the_reader_comes_near(page):
    """The second view is close to the visible part of the page until the first one starts."""
    page.set_viewport_size({"width": 390, "height": 600})
    views = [joint_explorer(spbu_arm(0.4, 0.5)), joint_explorer(IRB140)]
    first, second = (re.sub("<img[^>]*>", "", view.html) for view in views)
    content = f"{first}<div style='height:500px'></div>{second}"
    places, started = page.locator("[data-player]"), page.locator("[data-player][data-ready]")
    page.set_content(re.sub("(?s)<script.*?</script>", "", content))
    assert places.nth(1).bounding_box()["y"] < 1.5 * 600
    page.set_content(content)
    started.wait_for()
    page.wait_for_timeout(300)  # long enough for the second view, if it had its turn
    assert places.nth(1).bounding_box()["y"] > 1.5 * 600 and started.count() == 1
    page.mouse.wheel(0, 500)
    until(lambda: started.count() == 2, "the second view did not start", page)


def test_a_view_that_occurs_twice_does_not_stop_the_others(page):
    twice, other = (joint_explorer(arm).html for arm in (spbu_arm(0.4, 0.5), IRB140))
    page.set_content(f"{twice}{other}{twice}")
    started = page.locator("[data-player][data-ready]")
    until(lambda: page.mouse.wheel(0, 300) or started.count() == 3, "a view did not start", page)


def test_a_view_starts_next_to_one_of_an_older_notebook(page):
    """JupyterLab shows all notebooks in one window, and older ones share less in it."""
    older = "<script>globalThis.robokinTurn = {last: Promise.resolve()}</script>"
    page.set_content(older + joint_explorer(IRB140).html)
    page.locator("[data-player][data-ready] canvas").first.wait_for()


def test_a_view_that_is_removed_before_its_turn_does_not_stop_the_others(page):
    gone, other = (joint_explorer(arm).html for arm in (spbu_arm(0.4, 0.5), IRB140))
    watch = """<script>{
        const Observer = IntersectionObserver;
        globalThis.IntersectionObserver = class extends Observer {
            observe(place) {
                super.observe(place);
                // the second observer of the first view asks whether it is still close
                if (place.id === "gone" && globalThis.asked++) place.remove();
            }
        };
        globalThis.asked = 0;
    }</script>"""
    first = gone.replace('<div class="robokin-player"', '<div id="gone" class="robokin-player"', 1)
    page.set_content(watch + first + other)
    until(lambda: page.evaluate("asked") == 2, "the first view was not asked", page)
    page.locator("[data-player][data-ready] canvas").first.wait_for()
    assert page.locator("#gone").count() == 0


def test_page_that_cannot_draw_keeps_the_still_picture(page, blended, tmp_path):
    page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    for output in (blended, joint_explorer(IRB140), motor_explorer()):
        output.save(tmp_path / "still.html")
        page.goto((tmp_path / "still.html").as_uri())
        page.wait_for_timeout(100)
        assert page.get_by_text(STILL).is_visible() and page.locator("img").is_visible()
        assert page.locator("canvas").count() == 0


def test_scene_projects_points_and_can_hold_its_camera_still(page, blended):
    """For handles over the canvas, `cameras` projects points in the same way as the picture. While
    the scene is held, a target that leaves the picture does not move anything else.
    """
    scene = blended.data["scene"] | {"grows": True, "unit": blended.data["unit"]}
    page.set_content(
        f"<style>{css()}</style><div class='rk'><canvas style='width:400px;height:300px'></div>"
        f"<script>{script('scene')}</script>"
    )
    got = page.evaluate(
        """([scene, chain]) => {
            const canvas = document.querySelector("canvas"), view = $scene.sceneView(canvas, scene);
            $canvas.readColors(canvas);
            const arm = {name: "", chain, q: [0, 0, 0, 0, 0, 0]};
            const seen = () => {
                const room = view.draw(scene.view, [arm], "");
                const [camera] = view.cameras(), [x, y] = camera.to([0, 0, 0]);
                const [ax, ay] = camera.to(camera.across(30, -20));
                return [room, x, y, ax - x, ay - y];
            };
            const found = [seen()];
            view.hold(true);
            scene.things = [$target.frame("far", [1, 0, 0, 3, 0, 1, 0, 3, 0, 0, 1, 0])];
            found.push(seen());
            view.hold(false);
            found.push(seen());
            canvas.style.display = "none";
            return [...found, view.draw(scene.view, [arm], "")];
        }""",
        [scene, blended.data["arms"][0]["chain"]],
    )
    first, held, after, hidden = got
    assert first[0] is True and 0 < first[1] < 400 and 0 < first[2] < 300
    assert np.allclose(first[3:], (30, -20))
    assert held == first and after[1:3] != first[1:3] and hidden is False


def test_solid_floor_hides_objects_below_it(page):
    """The tool goes below the arm's base. The floor is below the tool, or at height 0 with `floor`.
    A floor at height 0 hides the parts of the arm below it and does not change the others.
    """
    t, turn = np.linspace(0, 2, 41), np.linspace(0, 1, 41)[:, None]
    q = turn * np.array([60, 100, 70]) * deg - np.array([0, 20, 20]) * deg
    arm = spbu_arm(0.4, 0.5)
    assert arm.fk(q).translation[-1, 2] < -0.2 < arm.fk(q).translation[0, 2]
    assert animate(arm, t, q).data["scene"]["floor"][0][2] < -0.2
    data = animate(arm, t, q, floor=True).data
    scene = data["scene"] | {"unit": data["unit"]}
    assert scene["floor"][0][2] == 0 and scene["solid"]
    page.set_content(
        f"<style>{css()}</style><div class='rk'><canvas style='width:400px;height:300px'></div>"
        f"<script>{script('scene')}</script>"
    )
    seen = page.evaluate(
        """([scene, chain, postures]) => {
            const canvas = document.querySelector("canvas");
            canvas.getContext("2d", {willReadFrequently: true});
            $canvas.readColors(canvas);
            return [true, false].map(solid => postures.map(q => {
                const view = $scene.sceneView(canvas, {...scene, solid});
                view.draw(scene.view, [{name: "", chain, q}], "");
                const {width, height} = canvas;
                const data = canvas.getContext("2d").getImageData(0, 0, width, height).data;
                let count = 0;
                for (let i = 0; i < data.length; i += 4)
                    if (data[i] === 0x4b && data[i + 1] === 0x59 && data[i + 2] === 0x66) count++;
                return count;
            }));
        }""",
        [scene, data["arms"][0]["chain"], q[[0, -1]].tolist()],
    )
    (above, hidden), (same, bare) = seen
    assert above == same > 300 and 0 < hidden < 0.8 * bare


def test_picture_requested_early_is_drawn_in_colour(page, blended):
    """A picture is requested in the same task that creates the player, before any canvas has a
    size.
    """
    page.set_content(
        "<script>new MutationObserver((_, watch) => {const input = document.querySelector('input');"
        "if (input) {watch.disconnect(); input.dispatchEvent(new Event('input'));}})"
        f".observe(document, {{childList: true, subtree: true}});</script>{blended.html}"
    )
    awake(page)
    assert ink(page, ".rk-curves") and page.evaluate(PAINTED, ".rk-curves") > 5000


def test_limits_that_are_exceeded_come_before_those_that_are_near():
    """The labels of limits that a motion exceeds take the first places."""
    q = np.zeros((2001, 6))
    q[:, 0] = np.linspace(-178, 178, 2001) * deg  # near to both limits of 180 degrees
    q[:, 1] = np.linspace(-89, 0, 2001) * deg  # near to the limit of -90 degrees
    q[:, 2] = np.linspace(0, 57, 2001) * deg  # beyond the limit of 50 degrees
    panel = animate(IRB140, T, q).data["panels"][0]
    assert panel["near"] == [[[2, 1], [0, 0], [0, 1], [1, 0]]]
