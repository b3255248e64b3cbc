"""The motor explorer in a real browser: it shows what `Stepper` computes for the same motor,
whichever controls are used, without a kernel or a network.
"""

import json
import re
from functools import cache

import numpy as np
import pytest
import test_explorers
from axe_playwright_python.sync_playwright import Axe
from conftest import until

from robokin.jobs.steppers import Stepper, phases, ramp
from robokin.show import motor_explorer
from robokin.show.joiner import script
from robokin.show.motors import WORDS

context, opened = test_explorers.context, test_explorers.opened  # fixtures
MOTORS = {
    "table 1": Stepper(),
    "table 2": Stepper("active", "bipolar", 2, "two-phase"),
    "half steps": Stepper("active", "bipolar", 5, "half-step"),
    "passive": Stepper("passive", "unipolar", 3, "two-phase", damping=1e-4),
    "at once": Stepper("passive", "unipolar", 6, rise=0.0),
}


@cache
def told(motor):
    """The data of the page."""
    return motor_explorer(motor).data


@pytest.fixture(scope="module")
def rotor(context):
    """`rotor(name, motor, load, load_inertia, *arguments)` calls the page's function `name` and
    returns its value.
    """
    page = context.new_page()
    page.goto("about:blank")
    page.add_script_tag(content=f"{script('rotor')}\nwindow.rotor = $rotor;")

    def call(name, motor, load, load_inertia, *arguments):
        data = told(motor)
        kind = data["kinds"][data["opening"]["kind"]]["motors"][data["opening"]["motor"]]
        given = kind | data["own"] | {"rules": data["rules"], "load": load}
        given |= {"currents": kind["currents"][motor.drive]}
        given["inertia"] += load_inertia
        return page.evaluate(
            "([name, text, rest]) => rotor[name](JSON.parse(text), ...rest)",
            [name, json.dumps(given), [*arguments]],
        )

    yield call
    page.close()


@pytest.mark.parametrize("name", MOTORS)
def test_page_and_python_simulations_agree(rotor, name):
    motor, seen = MOTORS[name], set()
    for frequency, load, load_inertia, sign in (
        (60, 0.0, 0.0, 1),
        (90, 0.006, 4e-7, 1),
        (450, 0.0, 5e-6, -1),
    ):
        times = np.arange(1, 25) / frequency
        ours = motor.run(times, np.full(24, sign), load, load_inertia)
        page = rotor("run", motor, load, load_inertia, times.tolist(), sign)
        assert page["t"] == pytest.approx(ours.t, abs=1e-12)
        assert page["angle"] == pytest.approx(ours.angle, abs=1e-6)
        assert page["lost"] == ours.lost
        assert np.ptp(page["angle"]) > 0.03  # the rotor has turned
        seen.add(ours.lost != 0)
    assert seen == {False, True}
    for what, value in (
        ("holdingTorque", motor.holding_torque),
        ("startingTorque", motor.starting_torque),
        ("stepOf", motor.step),
    ):
        assert rotor(what, motor, 0.0, 0.0) == pytest.approx(value)
    if name in ("table 1", "passive"):
        assert rotor("startFrequency", motor, 0.002, 3e-7, 48) == motor.start_frequency(0.002, 3e-7)


@pytest.mark.parametrize(
    "asked", [(48, 40, 200, 0.15), (20, 50, 400, 0.3), (1, 10, 90, 2), (7, 9, 9, 0)]
)
def test_page_ramps_match_those_of_python(context, asked):
    page = context.new_page()
    page.add_script_tag(content=f"{script('rotor')}\nwindow.rotor = $rotor;")
    times = page.evaluate("asked => rotor.ramp(...asked)", [*asked])
    page.close()
    assert times == pytest.approx(ramp(*asked), abs=1e-12)


def lost(shown):
    """The lost steps according to the explorer and to Python, and the results of the Python code
    that the explorer offers for copying.
    """
    seen = shown.look()
    said = re.search(r"(\d+)(?: of 48)? steps lost", seen.says)
    assert said or "no steps lost" in seen.says
    code = shown.code(seen)
    return int(said[1]) if said else 0, code["run"].lost, code


def test_page_reports_the_lost_steps_that_python_finds(opened):
    shown = opened(motor_explorer())
    assert lost(shown)[:2] == (44, 44) and "44 lost" in shown.look().words[1]
    shown.slide("frequency", 100)
    assert lost(shown)[:2] == (0, 0) and "|0 lost" in shown.look().words[1]
    shown.slide("frequency", 200)
    shown.type("load inertia", 10)
    shown.choose("drive", 1)
    told, ours, code = lost(shown)
    assert told == ours == 48 and code["motor"].drive == "two-phase"
    shown.type("ramp time", 150)
    assert lost(shown)[:2] == (0, 0)
    shown.type("load torque", 10)
    told, ours, code = lost(shown)
    assert told == ours > 0
    facts = shown.look().rows[-5:]
    start = code["motor"].start_frequency(0.01, 1e-6)
    assert facts[0][1] == "90°" and facts[1][1].startswith("28.3\u00a0mN\u00a0m")
    assert facts[3][1] == f"{start:.0f}\u00a0pulses/s" and facts[4][1] == "333\u00a0pulses/s"
    shown.choose("rotor, feed", 2)
    told, ours, code = lost(shown)
    assert told == ours and code["motor"].rotor == "passive" and code["motor"].windings == 4


def test_page_tells_when_the_last_pulse_comes_and_why_there_is_no_ramp(opened):
    shown = opened(motor_explorer())

    def last():
        seen = shown.look()
        found = re.match(r"48 pulses in ([\d,.]+)\sms, (.*?):.* ste", seen.says)
        ours = 1000 * shown.code(seen)["times"][-1]
        assert float(found[1].replace(",", "")) == pytest.approx(ours, abs=0.5)
        return found[2]

    assert last() == "160 per second from the first to the last"
    shown.type("ramp time", 190)
    assert last().startswith("from 40 up to 160 per second")
    shown.type("ramp from", 200)
    assert last() == "160 per second from the first to the last (no ramp"
    assert "(no ramp: it would begin at 200): 44 of 48" in shown.look().says


@pytest.mark.parametrize("motor", [Stepper(), MOTORS["table 2"]], ids=["table 1", "table 2"])
def test_a_motor_alone_has_no_others_in_its_menus(opened, motor):
    whole, alone = motor_explorer(motor), motor_explorer(motor, alone=True)
    [kind] = alone.data["kinds"]
    [only] = kind["motors"]
    assert (kind["rotor"], kind["motor"]) == (motor.rotor, motor.motor)
    assert only["windings"] == motor.windings and repr(alone) == repr(whole)
    assert len(whole.data["kinds"]) == 3
    one, all_ = opened(alone), opened(whole)
    assert lost(one)[:2] == lost(all_)[:2]
    shown = {
        name: (len(view.rk.locator("select:visible").all()), properties(view))
        for name, view in (("alone", one), ("whole", all_))
    }
    names = [WORDS[key] for key in ("step", "startFrequency")]
    assert shown["alone"] == (shown["whole"][0] - 2, names) and len(shown["whole"][1]) == 5
    assert all(f" {name}" in alone.data["meant"] for name in names), "a property is not explained"
    for view, offers in ((one, 0), (all_, 1)):
        for name in ("load torque", "load inertia", "ramp from", "ramp time"):
            assert view.rk.get_by_text(name, exact=True).count() == offers
        assert view.rk.get_by_text("frequency", exact=True).count() == 1


def properties(view):
    """The names of the motor's properties beside the phase table."""
    return view.rk.locator(".rk-facts tbody tr th").all_inner_texts()


def test_view_opens_with_the_frequency_that_is_asked_for(opened):
    motor = Stepper()
    for frequency, fine in ((100, True), (200, False)):
        made = motor_explorer(motor, frequency=frequency)
        assert f"48 pulses at {frequency} per second: {'no' if fine else ''}" in repr(made)
        shown = opened(made)
        told, ours, _ = lost(shown)
        assert told == ours and (told == 0) == fine
        assert f" ms, {frequency} per second from the first" in shown.look().says.replace(
            "\u00a0", " "
        )
    for frequency in (9, 501, np.nan, "fast"):
        with pytest.raises(ValueError, match="^frequency: wanted"):
            motor_explorer(motor, frequency=frequency)


@pytest.mark.parametrize("motor", [Stepper(), MOTORS["table 2"]], ids=["table 1", "table 2"])
def test_tables_match_those_of_the_document(opened, motor):
    shown = opened(motor_explorer(motor))
    marks = [[cell == "+" for cell in row[1:]] for row in shown.look().rows[:4]]
    assert (np.array(marks) == (phases(motor.drive, motor.motor) == 1)).all()
    assert np.sum(marks) == (4 if motor.motor == "unipolar" else 8)


def test_table_of_half_step_drive_is_shown_whole(opened):
    shown = opened(motor_explorer(Stepper(drive="half-step")))
    assert shown.look().rows[7][0] == "8"
    hidden = shown.rk.locator(".rk-lines").evaluate("box => box.scrollHeight - box.clientHeight")
    assert hidden <= 0


def test_rotor_responds_to_dragging_and_to_pulses(opened):
    shown = opened(motor_explorer())
    state = shown.rk.locator(".rk-state")
    resting = shown.look()
    assert resting.chosen == 0 and resting.handles["rotor"]["name"] == "rotor, rotor 0°"
    box = shown.rk.locator("canvas").first.bounding_box()
    centre = np.array([box["x"] + box["width"] / 2, box["y"] + box["height"] / 2])
    angles = []

    def each(seen, stop):
        angles.append(int(re.search(r"(-?\d+)°", seen.handles["rotor"]["name"])[1]))

    ways = (60, 120, 170, 230)
    stops = [
        centre + 90 * np.array([np.cos(w * np.pi / 180), -np.sin(w * np.pi / 180)]) for w in ways
    ]
    seen = shown.drag("rotor", *stops, each=each)
    assert angles == pytest.approx(ways, abs=2) and seen.pixels[0] != resting.pixels[0]
    # past half a turn the rotor jumps to the next position where a1 holds it: four steps ahead
    shown.page.wait_for_function(
        "document.querySelector('.rk-state').textContent.includes('Steps ahead: 4.')"
    )
    shown.rk.get_by_role("button", name="Begin again").click()
    shown.rk.get_by_role("button", name="+1 pulse").click()
    assert shown.look().chosen == 1 and state.inner_text().startswith("Pulses sent: 1.")
    shown.rk.get_by_role("button", name="1 pulse").first.press("Enter")  # one pulse back
    shown.rk.get_by_role("button", name="1 pulse").first.press("Enter")
    assert shown.look().chosen == 3 and "Pulses sent: \u22121." in state.inner_text()
    shown.rk.get_by_role("button", name="Begin again").click()
    # the button of the third row of the table
    shown.rk.get_by_role("button", name="3", exact=True).click()
    assert shown.look().chosen == 2 and "Pulses sent: 2." in state.inner_text()
    shown.rk.get_by_role("button", name="Begin again").click()
    before = shown.look()
    shown.handle("rotor").focus()
    shown.page.keyboard.down("ArrowLeft")
    assert "5°" in shown.look().handles["rotor"]["name"] and "holding" in state.inner_text()
    shown.page.keyboard.up("ArrowLeft")
    run = shown.rk.get_by_role("button", name="Run 48 pulses")
    run.click()
    sent = lambda: int(re.search(r"\d+", state.inner_text())[0])  # noqa: E731
    until(lambda: sent() > 0, "no pulse is sent", shown.page)
    after = shown.look()
    assert after.pixels[0] != before.pixels[0] and "44" in after.says
    shown.rk.get_by_role("button", name="Stop").click()
    shown.slide("frequency", 100)  # the run no longer fits the settings
    shown.look()
    assert state.inner_text().startswith("Pulses sent: 0.")
    shown.type("load torque", 30)  # mN m, more than the holding torque of 20 mN m
    shown.look()
    assert state.inner_text() == "This row does not hold the load."
    assert "The load slips back" in shown.look().says


def test_page_works_offline_and_axe_finds_no_problems(browser, opened):
    with browser.new_context(viewport={"width": 390, "height": 800}, color_scheme="dark") as small:
        small.add_init_script(test_explorers.WATCH)
        asked = []
        small.on("request", lambda request: asked.append(request.url))
        shown = opened(motor_explorer(MOTORS["half steps"]), within=small)
        shown.look()
        assert all(url.startswith("file:") for url in asked) and asked
        assert shown.page.evaluate("document.documentElement.scrollWidth") <= 390
        found = (
            Axe().run(shown.page, options={"resultTypes": ["violations"]}).response["violations"]
        )
        bad = [v["id"] for v in found if v["impact"] in ("serious", "critical")]
        assert bad == [], bad
        shown.page.close()
