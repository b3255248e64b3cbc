"""The curves that a notebook shows for `plot_joints`, compared with the motion and the figure."""

import json
import re

import numpy as np
import pytest
from conftest import awake
from test_player import unpacked

from robokin import IRB140, SCARA, deg, differentiate, mm, ptp, quintic, record
from robokin.course.ours import again
from robokin.show import plot_joints

T = np.linspace(0, 6, 2001)
Q = ptp([0, 0, 0, 0, 30 * deg, 0], [1, 0.4, 1.4, 1, 1, 2], quintic(6)(T))  # q3 to 80°
PAST = (Q[:, 2] > 50 * deg).sum()
SLIDING = ptp([0, 0, 0, 0.02], [1, -2, 3, 0.2], quintic(6)(T))


def html(fig):
    return fig._repr_mimebundle_()["text/html"]


def values(fig, k):
    """The curves (samples, n) of panel k of the page, in rad and m."""
    page = fig.page
    n, count = len(page["prismatic"]), len(page["times"])
    units = np.where(page["prismatic"], mm, deg)
    return unpacked(page["panels"][k]["values"], n, count)[0] * units


def at(fig, whole):
    """The values (samples, n) of a whole motion at the times of the page."""
    return np.stack([np.interp(fig.page["times"], T, column) for column in whole.T], axis=-1)


def test_two_samples_are_enough_for_a_plot():
    fig = plot_joints(IRB140, [0, 2], [[0.0] * 6, [0.5] * 6])
    np.testing.assert_allclose(values(fig, 0), [[0.0] * 6, [0.5] * 6], atol=1e-4)
    assert "joint curves" in html(fig)


@pytest.mark.parametrize(("arm", "q"), [(IRB140, Q), (SCARA, SLIDING)])
def test_curves_of_the_page_match_the_motion(arm, q):
    fig, found = plot_joints(record(arm, T, q)), record(arm, T, q)
    for k, whole in enumerate([found.q, found.v, found.a]):
        assert abs(whole).max() > 0.1
        np.testing.assert_allclose(
            values(fig, k), at(fig, whole), rtol=0, atol=2e-4 * abs(whole).max()
        )
    few = plot_joints(arm, T, q, 2 * found.v)  # the caller's own speeds, even if they are wrong
    assert len(few.page["panels"]) == 2
    np.testing.assert_allclose(values(few, 1), 2 * at(few, found.v), rtol=0, atol=1e-3)


def test_speed_and_joint_limits_match_those_of_the_arm():
    panels = plot_joints(record(IRB140, T, Q)).page["panels"]
    np.testing.assert_allclose(panels[0]["limits"], IRB140.limits / deg, atol=6e-4)
    speeds = np.stack([-IRB140.speed_limits, IRB140.speed_limits], axis=-1) / deg
    np.testing.assert_allclose(panels[1]["limits"], speeds, atol=6e-4)
    assert panels[2]["limits"] is None
    assert panels[0]["near"] == [[[2, 1]]], "joint 3 exceeds its upper limit"


def test_missing_postures_and_jumps_break_the_curves():
    q = Q.copy()
    q[500:700] = np.nan
    q[1200:, 3] += 360 * deg
    fig = plot_joints(IRB140, T, q, differentiate(q, T))
    times = np.array(fig.page["times"])
    missing = np.isnan(values(fig, 0)).all(axis=1)
    assert 1 < missing.sum() and ((times[missing] > 1.49) & (times[missing] < 2.11)).all()
    jump = times[1:][[i for i in fig.page["gaps"] if times[i] > 3]]
    assert len(jump) == 1 and abs(jump[0] - T[1200]) < 0.03
    first, second = (panel["marks"] for panel in fig.page["panels"])
    assert [text for _, text in first if text] == ["q4 jumps by 360.0°"]
    assert [time for time, _ in second] == [time for time, _ in first]
    alarms = [text for text, alarm in fig.page["notes"] if alarm]
    assert "joint 4 in 801" in alarms[0], "wanted the samples 1200 to 2000 of joint 4"


def test_spike_is_cut_off_and_does_not_reduce_the_precision_of_the_other_curves():
    q = Q.copy()
    q[1000:, 3] += 360 * deg
    naive = np.gradient(q, T, axis=0)  # includes a jump of 360° in one step
    assert abs(naive / deg).max() > 50_000
    fig = plot_joints(IRB140, T, q, naive)
    panel, drawn = fig.page["panels"][1], values(fig, 1) / deg
    low, step, count, _ = panel["axes"]["turn"]["scale"]
    high = low + step * (count - 1)
    assert high < 100 and drawn[:, 3].max() > 1.5 * high, "the spike should extend beyond the panel"
    others = [j for j in range(6) if j != 3]
    np.testing.assert_allclose(drawn[:, others], at(fig, naive)[:, others] / deg, atol=0.01)


def test_notes_are_the_sentences_of_the_alt_text():
    fig = plot_joints(record(IRB140, T, Q), title="Too far")
    assert fig.alt.startswith("Too far. IRB-140, joint curves over 6 s.")
    notes = dict(fig.page["notes"])
    assert all(note in fig.alt for note in notes)
    assert [note for note, alarm in notes.items() if alarm] == [
        f"Joint 3 past its limit in {PAST} of 2001 samples."
    ]


# --- In a browser ---------------------------------------------------------------------------------

RECORD = """
    window.written = [];
    const {fillText} = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...place) {
      written.push(text); return fillText.call(this, text, ...place); };"""


@pytest.mark.parametrize("width", [914, 390])
def test_browser_draws_curves_with_axes_limits_and_notes(browser, width):
    page = browser.new_page(viewport={"width": width, "height": 900})
    said = []
    page.on("pageerror", lambda error: said.append(str(error)))
    page.add_init_script(RECORD)
    fig = plot_joints(record(IRB140, T, Q), title="Joint 3 goes too far")
    page.route(
        "**/*",
        lambda route: route.fulfill(
            body=f"<!doctype html>{html(fig)}", content_type="text/html; charset=utf-8"
        ),
    )
    page.goto("http://robokin.test/")
    awake(page)
    canvas = page.locator("canvas")
    page.wait_for_function("written.length > 20")
    words = page.evaluate("written")
    assert {"angle, °", "speed, °/s", "acceleration, °/s²", "q6", "q3 limit 50°", "6 s"} <= {*words}
    assert page.get_by_text("Joint 3 goes too far").is_visible()
    assert page.get_by_text(f"Joint 3 past its limit in {PAST} of 2001 samples.").is_visible()
    assert canvas.get_attribute("aria-label") == fig.alt and page.locator("img").count() == 0
    assert canvas.bounding_box()["height"] > 500
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    page.close()
    assert said == []


def test_report_draws_curves_only_from_their_data():
    fig = plot_joints(record(IRB140, T, Q), title="Mine")
    text = html(fig)
    made = again(text, "n0nce")
    assert made is not None and "<script nonce=n0nce>" in made
    call = re.compile(r'^\$joint_curves\.show\("\w+", (.*)\);$', re.M)
    assert json.loads(call.search(made)[1]) == json.loads(call.search(text)[1])
    evil = again(text.replace("$loader.start(", "alert(1);$loader.start(", 1), "n0nce")
    assert "alert(1)" not in evil
    missing = again(text.replace('"gaps":', '"gasp":', 1), "n0nce")
    assert "canvas" not in missing and "left out" in missing
