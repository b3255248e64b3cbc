"""The content of the figures, read back from their lines, and their output in a notebook: the alt
text and a small picture.
"""

import io
import json
import math
import re
import subprocess
import sys
from html.parser import HTMLParser
from types import SimpleNamespace

import matplotlib
import matplotlib.colors
import nbformat
import numpy as np
import pytest
from machines import MACHINES, oracle
from matplotlib.text import Text
from nbconvert import HTMLExporter
from PIL import Image

from robokin import (
    IRB140,
    ITMO6R,
    Arm,
    Link,
    Quaternion,
    Transform,
    blend,
    deg,
    differentiate,
    follow,
    lin_lin,
    linear,
    mm,
    record,
)
from robokin.arms.dexterity import velocity_ellipsoid
from robokin.show import (
    JOINT_STYLES,
    Sketch,
    figure,
    plot_frames,
    plot_joints,
    plot_postures,
    plot_velocity_ellipsoid,
)
from robokin.show.arguments import named_targets
from robokin.show.camera import arm_points, project
from robokin.show.plots import palette_png
from robokin.show.scene import number

X, Y, Z = np.eye(3)
DOWN = Quaternion.from_angle_axis(np.pi / 2, -X)
START = Transform(DOWN, np.array([200, 400, 200]) * mm)
VIA = Transform(Quaternion.from_angle_axis(np.pi / 4, Y), np.array([650, -100, 800]) * mm)
GOAL = Transform(Quaternion.from_angle_axis(np.pi / 2, Y), np.array([300, 300, 500]) * mm)
T = np.linspace(0, 20, 2001)
ROW = IRB140.branch(+1, +1, -1)
LINKS = tuple(Link(axis=Z, after=Transform(translation=(length, 0, 0))) for length in (1.5, 1.2))
PLANAR = Arm(
    "two links", SimpleNamespace(links=LINKS, target=np.ndarray, reach=2.7), [(-np.pi, np.pi)] * 2
)


def law_of_listing_1(t, total=20.0):
    """The motion of 001, listing 1: along y, then along x, while the tool turns about y."""
    share = t / total
    x = np.where(share < 0.5, 200, 200 + (share - 0.5) * 500)
    y = np.where(share < 0.5, 50 + 1000 * share, 550)
    return Transform(
        Quaternion.from_angle_axis(share * np.pi / 2, Y),
        np.stack([x, y, 500 + 0 * t], axis=-1) * mm,
    )


def curves(ax):
    """The joint curves of a panel: a dict that maps names to arrays (samples, 2)."""
    return {
        line.get_label(): np.column_stack(line.get_data())
        for line in ax.lines
        if re.fullmatch(r"q\d", line.get_label())
    }


def words(ax):
    return " ".join(text.get_text() for text in ax.texts).replace("\n", " ")


@pytest.fixture(scope="module")
def corner():
    return follow(IRB140, IRB140.ik(lin_lin(START, VIA, GOAL, linear(20.0)(T))), ROW)


@pytest.fixture(scope="module")
def rounded():
    return follow(IRB140, IRB140.ik(blend(START, VIA, GOAL, 0.1, linear(20.0)(T))), ROW)


@pytest.fixture(scope="module")
def figures(rounded):
    v, a = differentiate(rounded, T), differentiate(rounded, T, 2)
    return {
        "joints": plot_joints(
            IRB140, T, rounded, v, a, title="Joint 3 brakes hardest at the corner"
        ),
        "postures": plot_postures(
            IRB140, rounded, targets=[START, VIA, GOAL], title="The path misses the via point"
        ),
        "frames": plot_frames(
            IRB140.frames(rounded[0]), names=list("abcdefg"), chain=True, title="A chain"
        ),
        "own": figure("Nothing to see & nothing <said>"),
    }


# --- Joint curves ---------------------------------------------------------------------------------


def test_curves_equal_the_given_values_in_degrees(rounded):
    v, a = differentiate(rounded, T), differentiate(rounded, T, 2)
    panels = plot_joints(IRB140, T, rounded, v, a).axes
    assert len(panels) == 3
    for ax, values in zip(panels, (rounded, v, a), strict=True):
        drawn = curves(ax)
        assert list(drawn) == [f"q{i}" for i in range(1, 7)]
        for i, curve in enumerate(drawn.values()):
            np.testing.assert_array_equal(curve[:, 0], T)
            np.testing.assert_allclose(
                curve[:, 1], [math.degrees(x) for x in values[:, i]], rtol=1e-12, atol=1e-12
            )
    assert all(ax.get_xlim() == (0, 20) for ax in panels)


def test_prismatic_joints_have_separate_panels_in_millimetres():
    arm = MACHINES[[m.arm.name for m in MACHINES].index("SCARA")].arm
    t = np.linspace(0, 1, 50)
    q = arm.limits[:, 0] + np.sin(3 * t)[:, None] * np.ptp(arm.limits, axis=1) * 0.9
    left, right = plot_joints(arm, t, q).axes
    shifting = int(np.flatnonzero(arm.prismatic)[0])
    assert set(curves(right)) == {f"q{shifting + 1}"} and len(curves(left)) == 3
    np.testing.assert_allclose(
        curves(right)[f"q{shifting + 1}"][:, 1], q[:, shifting] * 1000, rtol=1e-12
    )
    assert "mm" in right.get_ylabel() and "°" in left.get_ylabel()


def test_joints_differ_in_colour_and_dash_pattern(rounded):
    lines = [
        line
        for line in plot_joints(IRB140, T, rounded).axes[0].lines
        if line.get_label().startswith("q")
    ]
    assert [matplotlib.colors.to_hex(line.get_color()).upper() for line in lines] == [
        "#0072B2",
        "#D55E00",
        "#009E73",
        "#CC79A7",
        "#E69F00",
        "#56B4E9",
    ]
    assert len({style["dash"] for style in JOINT_STYLES}) == 6 and JOINT_STYLES[0]["dash"] == ()


def test_violations_of_task_1_are_counted_and_marked():
    """Errata S1-h: 673 of the document's 2000 samples exceed a limit, the last one at t = 6.72."""
    t = np.arange(0, 20, 0.01)
    q = follow(IRB140, IRB140.ik(law_of_listing_1(t)), IRB140.branch(1, 1, 1))
    case = oracle("trajectories_irb140")["cases"][0]
    np.testing.assert_allclose(q[::100][1:], [s["q"] for s in case["samples"]][1:20], atol=1e-9)
    assert case["law"] == "task1" and case["limit_violation_count"] == 673
    # A second count, with the limits in degrees from listing 1:
    past3, past5 = np.degrees(q[:, 2]) > 50, np.degrees(q[:, 4]) > 115
    assert (past3 | past5).sum() == 673 and t[past3 | past5].max() == pytest.approx(6.72)
    fig = plot_joints(IRB140, t, q)
    ax = fig.axes[0]
    for text in (words(ax), fig.alt.lower()):
        assert f"joint 5 past its limit in 673 of 2000 samples, joint 3 in {past3.sum()}" in text
        assert "inside its limits" not in text
    marked = [line.get_ydata() for line in ax.lines if line.get_linewidth() > 4]
    for values, past in zip(marked, (past3, past5), strict=True):
        np.testing.assert_array_equal(np.isfinite(values), past)
    assert "limit of q5: 115°" in words(ax) and "limit of q3: 50°" in words(ax)


def test_motion_inside_its_limits_has_no_marks(rounded):
    ax = plot_joints(IRB140, T, rounded).axes[0]
    assert "every joint inside its limits" in words(ax)
    assert not [line for line in ax.lines if line.get_linewidth() > 4]


def test_distant_limits_do_not_flatten_the_curves(rounded):
    for ax, values in zip(
        plot_joints(IRB140, T, rounded, differentiate(rounded, T)).axes,
        (rounded, differentiate(rounded, T)),
        strict=True,
    ):
        low, high = ax.get_ylim()
        assert np.ptp(values / deg) > 0.8 * (high - low)


def test_speeds_above_the_limit_are_counted():
    t = np.linspace(0, 2, 401)
    q = np.zeros((401, 6))
    q[:, 1] = np.sin(4 * t)  # its speed exceeds 200 deg/s where 4 |cos 4 t| > 3.49
    v = np.zeros_like(q)
    v[:, 1] = 4 * np.cos(4 * t)
    count = sum(abs(4 * math.cos(4 * x)) > math.radians(200) for x in t)
    assert 0 < count < 401
    ax = plot_joints(IRB140, t, q, v).axes[1]
    assert f"joint 2 past its speed limit in {count} of 401 samples" in words(ax)
    assert "limit of q2: 200 °/s" in words(ax) and "limit of q2: −200 °/s" in words(ax)


def test_percentage_of_the_speed_limit_is_shown(rounded):
    v = differentiate(rounded, T)
    share = max(abs(v[k, i]) / IRB140.speed_limits[i] for k in range(len(T)) for i in range(6))
    assert f"at most {100 * share:.2g} % of the speed limit (q3)" in words(
        plot_joints(IRB140, T, rounded, v).axes[1]
    )


def test_corner_does_not_flatten_the_accelerations(corner):
    """Errata S1-m: at the corner the acceleration is the jump in speed divided by the step."""
    a = differentiate(corner, T, 2)
    fig = plot_joints(IRB140, T, corner, differentiate(corner, T), a)
    ax = fig.axes[2]
    greatest = abs(a).max() / deg
    away = abs(T - 10) > 0.05
    assert greatest > 2000
    assert ax.get_ylim()[1] - ax.get_ylim()[0] < 3 * np.ptp(a[away] / deg)
    assert (
        f"spike at 10 s: speed jump / step, up to {greatest:.0f} °/s² (q3)" in words(ax)
        and "Spike" in fig.alt
    )
    # the spike is still drawn
    assert max(abs(curve[:, 1]).max() for curve in curves(ax).values()) == pytest.approx(greatest)
    assert "spike" not in words(fig.axes[1])  # a jump in speed does not count as a spike


def test_no_acceleration_is_shown_at_a_speed_jump(corner):
    found = record(IRB140, T, corner)
    fig = plot_joints(found)
    assert len(fig.axes) == 3
    for ax, values in zip(fig.axes, (found.q, found.v, found.a), strict=True):
        for i, curve in enumerate(curves(ax).values()):
            np.testing.assert_allclose(curve[:, 1], values[:, i] / deg, rtol=1e-12, atol=1e-12)
    assert np.isnan(curves(fig.axes[2])["q3"][1000, 1])
    # Errata S1, "chain": the speed of joint 3 jumps by 0.92001 rad/s.
    said = f"None at 10 s: the speed jumps, by up to {math.degrees(0.920011415539):.1f} °/s (q3)."
    assert said in fig.alt and "spike" not in fig.alt.lower()
    assert "the speed jumps" in words(fig.axes[2]) and "jumps" not in words(fig.axes[1])


def test_given_values_replace_those_of_the_recording(corner):
    found, a = record(IRB140, T, corner), differentiate(corner, T, 2)
    fig = plot_joints(found, a=a)
    assert "spike at 10 s: speed jump / step" in words(fig.axes[2])
    drawn = {line.get_label(): line.get_ydata() for line in fig.axes[2].lines}
    np.testing.assert_allclose(drawn["q3"], a[:, 2] / deg, rtol=1e-12, atol=1e-12)
    # speeds that are not given come from the recording
    assert "Greatest speed 31.2 °/s (q3)." in fig.alt
    slow = plot_joints(found, v=found.v / 2)
    assert "Greatest speed 15.6 °/s (q3)." in slow.alt and "None at 10 s" in slow.alt
    # accelerations from a caller who also knows them at the jump
    exact = np.where(np.isnan(found.a), 0.1, found.a)
    calm = plot_joints(IRB140, T, corner, found.v, exact).alt
    assert "spike" not in calm.lower() and "None at" not in calm


def test_two_kinds_of_spikes_are_distinguished():
    q = np.zeros((2001, 6))
    q[:, 3] = np.where(T < 5, 0, 0.05 * (T - 5))
    q[1400:, 5] += 2 * np.pi
    v, a = differentiate(q, T), differentiate(q, T, 2)
    fig = plot_joints(IRB140, T, q, v, a)
    assert f"spike at 14 s: angle jump / step, up to {math.pi / 0.01 / deg:.0f} °/s (q6)" in words(
        fig.axes[1]
    )
    said = words(fig.axes[2])
    assert f"spike at 14 s: angle jump / step, up to {math.pi / 2e-4 / deg:.0f} °/s² (q6)" in said
    assert f"spike at 5 s: speed jump / step, up to {0.05 / 0.02 / deg:.0f} °/s² (q4)" in said
    assert "Greatest acceleration 0 °/s²." in fig.alt
    for ax in fig.axes[1:]:
        low, high = ax.get_ylim()
        assert high - low < 10


def test_ordinary_values_do_not_count_as_spikes():
    """The caller gives the correct speed at each jump in position."""
    q, v = np.zeros((2001, 6)), np.zeros((2001, 6))
    v[:, 3] = np.cos(T)
    q[:, 3] = (np.sin(T) + 3) % 3.5
    assert len(record(IRB140, T, q).leaps) > 2
    fig = plot_joints(IRB140, T, q, v)
    assert "spike" not in fig.alt and "Greatest speed 57.3 °/s (q4)." in fig.alt


def test_jumps_in_position_are_reported_with_their_size():
    arm = MACHINES[[m.arm.name for m in MACHINES].index("SCARA")].arm
    t = np.linspace(0, 1, 101)
    q = np.zeros((101, 4))
    stroke, turning = int(np.flatnonzero(arm.prismatic)[0]), int(np.flatnonzero(~arm.prismatic)[0])
    q[:, stroke] = 0.3
    q[40:, stroke] = 0.1
    for k, size in ((20, 90), (50, -90), (70, 30), (90, 45)):
        q[k:, turning] += size * deg
    left, right = plot_joints(arm, t, q).axes
    assert f"q{stroke + 1} jumps by 200 mm at 0.395 s" in words(right)
    assert f"q{turning + 1} jumps by up to 90° at 4 places" in words(left)


def test_long_bursts_do_not_count_as_spikes(rounded):
    a = differentiate(rounded, T, 2)
    ax = plot_joints(IRB140, T, rounded, None, a).axes[1]
    low, high = ax.get_ylim()
    assert low < a.min() / deg and a.max() / deg < high and "spike" not in words(ax)


def test_constant_motion_is_drawn_flat():
    """Rounding errors of a constant speed must not fill the panel."""
    t = np.linspace(0, 1, 101)
    noise = 1e-13 * np.random.default_rng(1).normal(size=(101, 6))
    fig = plot_joints(IRB140, t, np.zeros((101, 6)), None, noise)
    low, high = fig.axes[1].get_ylim()
    assert high - low > 1e-3
    # rounding errors must not decide which joint is named
    assert "Greatest acceleration 0 °/s²." in fig.alt


def test_jump_by_a_whole_turn_is_drawn_and_reported():
    raw = IRB140.ik(lin_lin(START, VIA, GOAL, linear(20.0)(T)))[:, IRB140.branch(1, 1, 1)]
    fig = plot_joints(IRB140, T, raw, differentiate(raw, T))
    at = T[1:][abs(np.diff(raw[:, 3])) > 6]
    assert len(at) == 1  # errata S1-e: at 12.50 s
    assert f"q4 jumps by 360° at {at[0]:.1f} s" in words(fig.axes[0])
    np.testing.assert_array_equal(curves(fig.axes[0])["q4"][:, 1], raw[:, 3] / deg)
    assert "angle jump / step" in words(fig.axes[1])
    low, high = fig.axes[1].get_ylim()
    assert high - low < 100  # the spike is 18 000 deg/s


def test_gaps_in_a_motion_remain_gaps_in_its_curves(rounded):
    q = rounded.copy()
    q[600:800] = np.nan
    q[1500:] = np.nan
    fig = plot_joints(IRB140, T, q, differentiate(q, T))
    drawn = curves(fig.axes[0])["q1"][:, 1]
    np.testing.assert_array_equal(np.isnan(drawn), np.isnan(q[:, 0]))
    # the curves do not reach the right edge, where their names would be
    assert fig.axes[0].get_legend() is not None
    assert "nan" not in fig.alt.lower()


def test_names_at_the_ends_of_curves_do_not_overlap(rounded):
    # six curves that end at the same point
    fig = plot_joints(IRB140, T, rounded, differentiate(rounded, T) * 0)
    fig.canvas.draw()
    renderer = fig.canvas.get_renderer()
    for ax in fig.axes:
        boxes = sorted(
            (box.y0, box.y1)
            for text in ax.texts
            if re.fullmatch(r"q\d", text.get_text())
            # the box of the text alone, without its leader line
            for box in [Text.get_window_extent(text, renderer)]
        )
        assert len(boxes) == 6 and all(
            low[1] <= high[0] + 1 for low, high in zip(boxes, boxes[1:], strict=False)
        )


@pytest.mark.parametrize(
    "bad, kind",
    [
        (lambda q: plot_joints(IRB140, T[:-1], q), ValueError),
        (lambda q: plot_joints(IRB140, T[::-1], q), ValueError),
        (lambda q: plot_joints(IRB140, T[:1], q[:1]), ValueError),
        (lambda q: plot_joints(IRB140, T, q[:, :5]), ValueError),
        (lambda q: plot_joints(IRB140, T, q, q[:-1]), ValueError),
        (lambda q: plot_joints(IRB140, T, q, title=3), ValueError),
        (lambda q: plot_joints(IRB140, T, None), ValueError),
        (lambda q: plot_joints("IRB140", T, q), TypeError),
        (lambda q: plot_joints(record(IRB140, T, q), T), ValueError),
        (lambda q: plot_joints(record(IRB140, T, q[None])), ValueError),
        (lambda q: plot_postures(IRB140, q[:, :5]), ValueError),
        (lambda q: plot_postures(IRB140, q * np.nan), ValueError),
        (lambda q: plot_postures(IRB140, q, targets=[START.as_matrix()]), TypeError),
        (lambda q: plot_postures(IRB140, q, targets=None), TypeError),
        (lambda q: plot_postures(IRB140, q, title=3), ValueError),
        (lambda q: plot_frames([]), ValueError),
        (lambda q: plot_frames(START.as_matrix()), TypeError),
        (lambda q: plot_frames(3), TypeError),
        (lambda q: plot_frames([START, GOAL], names=["one"]), ValueError),
        (lambda q: plot_frames(START, names=3), ValueError),
        (lambda q: plot_frames(START, names=[3]), ValueError),
        (lambda q: plot_frames(START, size=-1), ValueError),
        (lambda q: plot_frames(START, size=0), ValueError),
        (lambda q: figure(""), ValueError),
        (lambda q: figure("Wide", width=101), ValueError),
    ],
)
def test_errors_name_the_invalid_argument(bad, kind, rounded):
    with pytest.raises(kind, match="wanted .*got|not allowed"):
        bad(rounded)


# --- Spatial views --------------------------------------------------------------------------------


def test_cube_is_drawn_with_true_proportions(figures):
    """The corners of a cube in pixels. By Gauss's theorem of axonometry, a picture is a scaled
    orthographic projection if a^2 + b^2 + c^2 = 0 for the images of the axes as complex numbers.
    """
    for name in ("postures", "frames"):
        ax = figures[name].axes[0]
        figures[name].canvas.draw()
        pixels = ax.transData.transform(project(np.array([[0, 0, 0], X, Y, Z]) * 0.3))
        edges = (pixels[1:] - pixels[0]) @ [1, 1j]
        assert abs((edges**2).sum()) < 1e-9 * (abs(edges) ** 2).sum()
        assert edges[2].real == pytest.approx(0, abs=1e-6) and edges[2].imag > 0  # z is up


def test_figure_of_postures_shows_the_path_and_the_arm(figures, rounded):
    lines = [np.column_stack(line.get_data()) for line in figures["postures"].axes[0].lines]
    flange = project(IRB140.fk(rounded).translation)
    assert any(
        line.shape == flange.shape and np.allclose(line, flange, atol=1e-12) for line in lines
    )
    for k in (0, -1):
        posture = project(arm_points(IRB140, rounded[k]))
        assert any(
            line.shape == posture.shape and np.allclose(line, posture, atol=1e-12) for line in lines
        )
    assert {"start", "via", "goal", "first", "last", "x", "y", "z"} <= {
        text.get_text() for text in figures["postures"].axes[0].texts
    }


@pytest.mark.parametrize("machine", MACHINES, ids=repr)
def test_links_join_the_frames_of_every_arm(machine):
    q = np.random.default_rng(3).uniform(-1, 1, (4, len(machine.arm.links)))
    points = arm_points(machine.arm, q)
    np.testing.assert_allclose(points[:, ::2], machine.arm.frames(q).translation, atol=1e-12)
    for i, link in enumerate(
        machine.arm.links
    ):  # the rotation of a joint does not move the joint itself
        if not link.prismatic:
            turned = q.copy()
            turned[:, i] += 1
            np.testing.assert_allclose(
                arm_points(machine.arm, turned)[:, 2 * i + 1], points[:, 2 * i + 1], atol=1e-12
            )


@pytest.mark.parametrize("arm", [*(m.arm for m in MACHINES), PLANAR], ids=lambda arm: arm.name)
def test_view_fills_its_figure_and_is_not_cut_off(arm):
    q = np.linspace(0.1, 0.9, 40)[:, None] * np.where(arm.prismatic, arm.limits[:, 1], 1.0)
    fig = plot_postures(arm, q, targets=[arm.fk(q[0]), arm.fk(q[-1])], title="A title")
    ink = np.asarray(Image.open(io.BytesIO(palette_png(fig))).convert("L")) < 250
    assert (
        not ink[:, :2].any() and not ink[:, -2:].any() and not ink[:2].any() and not ink[-2:].any()
    )
    rows, columns = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    assert len(rows) > 0.9 * ink.shape[0] - 40 and np.ptp(columns) > 0.8 * ink.shape[1]
    renderer = fig.canvas.get_renderer()
    for text in fig.axes[0].texts:
        box = text.get_window_extent(renderer)
        assert box.x0 >= 0 and box.y0 >= 0 and box.x1 <= ink.shape[1] and box.y1 <= ink.shape[0], (
            text
        )


def test_scale_is_in_metres_for_a_large_arm(figures):
    q = np.linspace(0, 1, 20)[:, None] * [1, -0.5]
    large = words(plot_postures(PLANAR, q).axes[0])
    assert re.search(r"grid 0\.\d+ m\b", large) and "mm" not in large
    assert re.search(r"floor grid \d+ mm", words(figures["postures"].axes[0]))
    # A planar arm is seen from above: x to the right, y up.
    lines = [np.column_stack(line.get_data()) for line in plot_postures(PLANAR, q).axes[0].lines]
    tip = np.column_stack(
        [
            1.5 * np.cos(q[:, 0]) + 1.2 * np.cos(q.sum(1)),
            1.5 * np.sin(q[:, 0]) + 1.2 * np.sin(q.sum(1)),
        ]
    )
    assert any(line.shape == tip.shape and np.allclose(line, tip) for line in lines)


def test_frames_are_drawn_at_their_positions():
    fig = plot_frames([START, VIA], names=["start", "via"], size=0.1)
    lines = [np.column_stack(line.get_data()) for line in fig.axes[0].lines]
    for pose in (Transform(), START, VIA):  # the base frame is drawn too
        for axis in np.eye(3):
            edge = project(
                np.stack([pose.translation, pose.translation + 0.1 * (pose.rotation @ axis)])
            )
            assert any(
                line.shape == (2, 2) and np.allclose(line, edge, atol=1e-12) for line in lines
            )
    assert {"base", "start", "via"} <= {text.get_text() for text in fig.axes[0].texts}
    assert "start at (200, 400, 200) mm" in fig.alt and "via at (650, −100, 800) mm" in fig.alt


def test_frames_with_a_common_origin_are_named_at_their_axes():
    turns = Transform(Quaternion.from_angle_axis(np.arange(0, 91, 30) * deg, Z))
    texts = {
        text.get_text()
        for text in plot_frames(turns, names=["0°", "30°", "60°", "90°"]).axes[0].texts
    }
    assert {"x 0°", "x 30°", "x 60°", "x 90°"} <= texts


@pytest.mark.parametrize(
    "value, text",
    [
        (0.0, "0"),
        (-1e-13, "0"),
        (-12.345, "−12.3"),
        (999.96, "1000"),
        (17993.2, "17993"),
        (0.05, "0.05"),
        (62.5, "62.5"),
    ],
)
def test_numbers_are_formatted_readably(value, text):
    assert number(value) == text


def test_targets_have_names():
    assert list(named_targets([START])) == ["target"] and list(named_targets(START)) == ["target"]
    assert list(named_targets([START, GOAL])) == ["start", "goal"]
    assert list(named_targets((START, VIA, GOAL))) == ["start", "via", "goal"]
    assert named_targets({"bin": GOAL}) == {"bin": GOAL} and named_targets(()) == {}
    assert len(named_targets([START] * 5)) == 5


# --- Output in a notebook -------------------------------------------------------------------------


class Images(HTMLParser):
    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attributes):
        if tag == "img":
            self.found.append(dict(attributes))


# --- Velocity ellipsoids --------------------------------------------------------------------------


@pytest.mark.parametrize("machine", MACHINES, ids=repr)
def test_ellipsoid_contains_all_velocities_at_constant_orientation(machine):
    """For random joint speeds that keep the tool's orientation, from a null space computed here, no
    velocity is outside the ellipsoid, and one nearly reaches the end of its longest semi-axis.
    """
    arm = machine.arm
    rng = np.random.default_rng(6)
    q = rng.uniform(-1, 1, len(arm.links))
    axes = velocity_ellipsoid(arm, q)
    ways, longest = np.linalg.svd(axes)[0], np.linalg.norm(axes[:, 0])
    assert (np.diff(np.linalg.norm(axes, axis=0)) <= 0).all()
    jacobian = arm.jacobian(q)
    jacobian[:, arm.prismatic] *= arm.reach
    held = jacobian[3:] if len(arm.links) > 3 else np.zeros((1, len(arm.links)))
    _, sizes, rows = np.linalg.svd(held)
    free = rows[(sizes > 1e-9).sum() :]
    speeds = rng.normal(size=(4000, len(free))) @ free
    speeds /= np.linalg.norm(speeds, axis=-1, keepdims=True)
    seen = speeds @ jacobian[:3].T @ ways
    lengths = np.maximum(np.linalg.norm(axes, axis=0), 1e-9)
    assert ((seen / lengths) ** 2).sum(axis=-1).max() < 1 + 1e-6
    assert 0.9 * longest < np.linalg.norm(seen, axis=-1).max() < longest * (1 + 1e-9)


def test_ellipsoid_of_a_singular_wrist_loses_one_direction():
    q = np.array([[20, 70, -60, 30, 50, 10], [20, 70, -60, 30, 0, 10]]) * deg
    lengths = np.linalg.norm(velocity_ellipsoid(ITMO6R, q), axis=-2)
    assert lengths[0].min() > 0.02 and lengths[1, :2].min() > 0.02 and lengths[1, 2] < 1e-12
    assert np.isnan(velocity_ellipsoid(ITMO6R, np.full(6, np.nan))).all()


def test_several_ellipsoids_share_one_scale():
    q = np.array([[20, 70, -60, 30, 50, 10], [20, 70, -60, 30, 1, 10]]) * deg
    fig = plot_velocity_ellipsoid(ITMO6R, q, title="A $1 title")
    scales = []
    fig.canvas.draw()
    for ax in fig.axes:
        scales.append(np.linalg.norm(np.diff(ax.transData.transform([(0, 0), (1, 0)]), axis=0)))
        rim = ax.transData.transform(ax.patches[-1].get_xy())  # the outline
        box = ax.get_window_extent()
        assert (rim.min(axis=0) > box.min).all() and (rim.max(axis=0) < box.max).all()
    assert len(fig.axes) == 2 and scales[0] == pytest.approx(scales[1])
    lengths = np.linalg.norm(velocity_ellipsoid(ITMO6R, q), axis=-2) / mm
    assert f"Posture 1: semi-axes {lengths[0, 0]:.0f} mm/s" in fig.alt and "A $1 title." in fig.alt
    alarm = [t for ax in fig.axes for t in ax.texts if t.get_color() == "#B3261E"]
    assert [t.get_text() for t in alarm] == [f"{number(lengths[1, 2], 2)} mm/s"]
    assert "1 m/s is drawn" in words(fig.axes[0])
    flat = plot_velocity_ellipsoid(PLANAR, [0.3, 1.2], alt="All calm.")
    assert flat.alt == "All calm." and len(flat.axes) == 1
    for bad in (np.full(6, np.nan), np.zeros((4, 6))):
        with pytest.raises(ValueError, match="q: wanted one to 3 postures"):
            plot_velocity_ellipsoid(ITMO6R, bad)


def test_alt_text_reaches_the_exported_page(figures):
    outputs = [
        nbformat.v4.new_output("execute_result", data=fig._repr_mimebundle_(), execution_count=1)
        for fig in figures.values()
    ]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("fig", outputs=outputs)])
    page = Images()
    page.feed(HTMLExporter().from_notebook_node(notebook)[0])
    assert [image["alt"] for image in page.found] == [fig.alt for fig in figures.values()]
    for image, fig in zip(page.found, figures.values(), strict=True):
        assert (
            image["src"].startswith("data:image/png;base64,")
            and int(image.get("width", 900)) <= 900
        )
        assert fig._repr_mimebundle_()["text/plain"] == fig.alt == repr(fig)


def test_alt_text_reaches_the_page_of_an_untrusted_notebook(figures, browser):
    """test_browser checks what JupyterLab's sanitizer keeps; this test checks that a browser reads
    the alt text back.
    """
    page = browser.new_page()
    page.set_content(figures["own"]._repr_mimebundle_()["text/html"])
    assert (
        page.get_by_role("img", name="Nothing to see & nothing <said>").evaluate(
            "i => i.naturalWidth"
        )
        == 900
    )
    page.close()


def test_pictures_are_small_and_use_a_colour_palette(figures):
    for name, fig in figures.items():
        data = palette_png(fig)
        image = Image.open(io.BytesIO(data))
        assert image.format == "PNG" and image.mode == "P" and len(data) < 60_000, (name, len(data))
        assert (
            image.size == tuple(np.round(fig.get_size_inches() * 100).astype(int))
            and image.width <= 900
        )
        colours = np.asarray(image.convert("RGB")).reshape(-1, 3).astype(int)
        if name == "postures":  # thin lines keep their colours
            for want in ((0xC6, 0x28, 0x28), (0x2E, 0x7D, 0x32), (0x1F, 0x55, 0xC4)):
                assert abs(colours - want).max(axis=1).min() <= 4


def test_alt_text_does_not_depend_on_rounding(rounded):
    v = differentiate(rounded, T)
    moved = rounded + 1e-14 * np.random.default_rng(5).normal(size=rounded.shape)
    assert (
        plot_joints(IRB140, T, rounded, v).alt
        == plot_joints(IRB140, T, moved, differentiate(moved, T)).alt
    )
    assert plot_postures(IRB140, rounded).alt == plot_postures(IRB140, moved).alt
    home = IRB140.frames(np.zeros(6))
    assert plot_frames(home).alt == plot_frames(IRB140.frames(np.full(6, 1e-15))).alt
    assert "−0" not in plot_frames(home).alt


ODD = "a $\\frac{ b$ \ud800 _c_ & <d>"


def test_titles_and_names_are_plain_text(rounded):
    """Titles are not interpreted as formulas unless requested; lone surrogates are replaced."""
    shown = ODD.replace("\ud800", "\ufffd")
    figs = [
        plot_joints(IRB140, T, rounded, title=ODD, alt=ODD),
        plot_postures(IRB140, rounded, targets={ODD: START}, title=ODD),
        plot_frames([START, VIA], names=[ODD, "b"], title=ODD),
        plot_frames(START, names=[ODD], alt=ODD),
        figure(ODD),
    ]
    for fig, count in zip(figs, (1, 2, 2, 1, 0), strict=True):
        assert fig._repr_mimebundle_()["text/plain"].encode()
        texts = [text for text in fig.findobj(Text) if "frac" in text.get_text()]
        assert len(texts) == count and not any(text.get_parse_math() for text in texts)
        assert all(shown in text.get_text() for text in texts)
    assert figs[0].alt == figs[3].alt == figs[4].alt == shown
    assert shown in figs[1].alt and shown in figs[2].alt


def test_postures_in_degrees_cause_a_warning(recwarn):
    plot_postures(IRB140, np.full((5, 6), 13.0))  # a motion may turn many times
    assert not recwarn.list
    for q in ([0, 45, 0, 0, 0, 0], [[0, 0, 0, 0, 0, 0], [0, 90, 0, 0, 0, 0]]):
        with pytest.warns(UserWarning, match="q: .* rad is many turns; did you mean degrees"):
            plot_postures(IRB140, q)


def test_caller_can_set_the_alt_text(rounded):
    assert plot_joints(IRB140, T, rounded, alt="All calm.").alt == "All calm."
    assert (
        plot_postures(IRB140, rounded, alt="All calm.").alt
        == plot_frames(START, alt="All calm.").alt
        == "All calm."
    )


def test_plots_do_not_import_pyplot():
    code = (
        "import sys, numpy as np, robokin.show as p; from robokin import IRB140; "
        "t = np.linspace(0, 1, 50); p.plot_joints(IRB140, t, np.zeros((50, "
        "6)))._repr_mimebundle_(); "
        "p.plot_postures(IRB140, np.zeros(6)); import json; print(json.dumps(sorted(sys.modules)))"
    )
    loaded = json.loads(
        subprocess.run(
            [sys.executable, "-c", code], capture_output=True, text=True, check=True
        ).stdout
    )
    assert "matplotlib.figure" in loaded and "matplotlib.pyplot" not in loaded


# --- Sketches -------------------------------------------------------------------------------------


def test_sketch_is_drawn_to_scale():
    sketch = Sketch("Two levers.", title="Bent", x="ahead", y="up")
    corners = np.array([[0, 0], [0.3, 0.4], [0.6, 0.1]])
    sketch.levers(corners, ["O", "A", "K"])
    sketch.length(corners[0], corners[2], "d")
    sketch.angle(corners[1], -2 * np.pi / 3, np.pi / 6, "q2", radius=0.1)
    sketch.point((0.7, 0.5), "target")
    sketch.canvas.draw()
    ax = sketch.ax
    one, two, joints, length, begin, arc, point = (line.get_xydata() / 1000 for line in ax.lines)
    np.testing.assert_allclose([*one, two[1]], corners)
    np.testing.assert_allclose(joints, corners)
    np.testing.assert_allclose(length, corners[[0, 2]])
    np.testing.assert_allclose(np.linalg.norm(arc - corners[1], axis=-1), 0.1)
    ways = (arc - corners[1])[[0, -1]]
    np.testing.assert_allclose(np.arctan2(*ways.T[::-1]), [-2 * np.pi / 3, np.pi / 6])
    np.testing.assert_allclose(np.linalg.det([begin[1] - begin[0], ways[0]]), 0, atol=1e-12)
    np.testing.assert_allclose(point, [[0.7, 0.5]])
    x, y = np.diff(ax.transData.transform([[0, 0], [1, 1]]), axis=0)[0]
    assert abs(x / y - 1) < 1e-6
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("ahead, mm", "up, mm")


def test_names_in_a_sketch_are_next_to_their_objects():
    sketch = Sketch("Two levers.", unit="m")
    corners = np.array([[0, 0], [3, 4], [6, 1]])
    sketch.levers(corners, list("OAK"))
    sketch.length(corners[0], corners[2], "d")
    sketch.angle((0, 0), 0, np.arctan2(4, 3), "q1", radius=1)
    names = {text.get_text(): text for text in sketch.ax.texts if text.get_text()}
    assert set(names) == {"O", "A", "K", "d", "q1"}
    for name, corner in zip("OAK", corners, strict=True):
        np.testing.assert_allclose(names[name].xy, corner)
        away = np.array(names[name].get_position())  # offset in pixels from the corner
        assert away @ (corner - corners.mean(axis=0)) > 0
    assert names["d"].get_position()[1] > 0 and names["q1"].get_position()[0] > 0
