"""The exercise and the predictions of lab 13: feasible ramps pass, and mistakes in other ramps are
named.
"""

import contextlib
import io
import json
import math
import re
from dataclasses import replace

import numpy as np
import pytest
from conftest import NOTEBOOKS
from scipy.integrate import solve_ivp

from robokin.course import book, check, variant
from robokin.course.questions import filled
from robokin.jobs.steppers import Stepper, ramp

TURN = 2 * math.pi
LAB = book.lab("rotor")
MOTOR, WEAK = Stepper(rise=0), Stepper(torque=0.016, rise=0)


def made_steps(motor, times, load_inertia):
    """Return the number of steps that a magnet rotor makes in wave drive, computed with SciPy."""
    state, angles = [0.0, 0.0], [0.0, *times, times[-1] + 2]
    inertia = motor.inertia + load_inertia
    for k, (a, b) in enumerate(zip(angles, angles[1:], strict=False)):
        state = solve_ivp(
            lambda t, s, k=k: (
                s[1],
                (motor.torque * math.sin(k * TURN / 4 - s[0]) - motor.damping * s[1]) / inertia,
            ),
            (a, b),
            state,
            rtol=1e-6,
            atol=1e-6,
        ).y[:, -1]
    return round(state[0] / (TURN / 4))


@pytest.mark.parametrize("who", [f"student {k}" for k in range(12)])
def test_every_student_needs_a_ramp_and_can_find_one(who):
    own = variant("rotor", who)
    load = own["load_inertia"]
    assert 1e-6 <= load < 4.1e-6 and 48 / MOTOR.start_frequency(load_inertia=load) > own["within"]
    f, swing = WEAK.start_frequency(load_inertia=load), math.sqrt((1e-6 + load) / WEAK.torque)
    assert 0 <= own["within"] - 0.75 * 48 / f < 0.01  # three quarters, rounded up
    assert 1.3 < 48 / own["within"] / f < 1.34  # hint 2: about 1.3
    assert (0.6 + 1.6) / 2 < 48 / own["within"] / f < 1.6
    made = {"start": 0.6 * f, "end": 1.6 * f, "seconds": 9 * swing}
    assert check("rotor.1", made, who=who).holds
    hasty = made | {"start": 1.01 * f}
    assert not check("rotor.1", hasty, who=who).holds


def test_few_ramps_pass_that_ignore_the_load():
    """The time allowed is so short that a guess in round numbers hardly ever passes."""
    guesses = [(s, e, t) for s in (20, 40, 60) for e in (100, 120, 160) for t in (0.1, 0.2, 0.3)]
    who = ["Ada", "Bo", "Cy"]
    held = [
        check("rotor.1", dict(zip(("start", "end", "seconds"), g, strict=True), who=w), who=w).holds
        for w in who
        for g in guesses
    ]
    assert 0 < sum(held) < 0.15 * len(held)


def test_verdict_agrees_with_a_second_integrator():
    own = variant("rotor", "Ada")
    f, load = WEAK.start_frequency(load_inertia=own["load_inertia"]), own["load_inertia"]
    seen = set()
    for start, end, seconds in (
        (0.6, 1.6, 0.16),
        (0.6, 1.6, 0.05),
        (0.9, 2.2, 0.1),
        (0.5, 1.4, 0.3),
    ):
        times = ramp(48, start * f, end * f, seconds)
        fits = times[-1] <= own["within"]
        makes = all(made_steps(motor, times, load) == 48 for motor in (MOTOR, WEAK))
        made = {"start": start * f, "end": end * f, "seconds": seconds}
        assert check("rotor.1", made, who="Ada").holds == (fits and makes)
        seen.add((fits, makes))
    assert {(True, True), (True, False)} <= seen


def test_mistakes_in_ramps_are_named():
    own = variant("rotor", "Ada")
    load = own["load_inertia"]
    f, strong = (motor.start_frequency(load_inertia=load) for motor in (WEAK, MOTOR))
    wrong = {
        "no ramp": (1.4 * f, 1.4 * f, 0.1),
        "begins too fast": (1.2 * strong, 1.6 * strong, 0.2),
        "too steep or too fast": (0.6 * f, 3 * f, 0.05),
        "too slow": (0.5 * f, 0.9 * f, 0.1),
        "milliseconds for seconds": (0.6 * f, 1.6 * f, 160),
    }
    told = {}
    for name, (start, end, seconds) in wrong.items():
        verdict = check("rotor.1", {"start": start, "end": end, "seconds": seconds}, who="Ada")
        assert verdict.mistake == name and verdict.points < 1
        told[name] = " ".join(verdict.says)
    mean = math.ceil(48 / own["within"])
    assert f"at least {mean} pulses/s: raise `end`" in told["too slow"]
    top = math.sqrt((0.6 * f) ** 2 + 48 * f / 160)  # where the ramp turns, after 24 pulses
    reached = int(re.search(r"reaches only (\d+)", told["milliseconds for seconds"])[1])
    assert reached == pytest.approx(top, abs=1)
    slow = check("rotor.1", {"start": 0.6 * f, "end": 1.6 * f, "seconds": 0.35}, who="Ada")
    assert slow.mistake == "too slow" and "shorten the ramp" in slow.says[0]
    # the shortest ramp on which the motor loses no steps is too short for the weak motor
    edge = next(
        r
        for r in np.arange(0.02, 0.5, 0.01)
        if not MOTOR.run(ramp(48, 0.6 * f, 1.6 * f, r), np.ones(48), 0, load).lost
    )
    made = {"start": 0.6 * f, "end": 1.6 * f, "seconds": edge}
    assert check("rotor.1", made, who="Ada").mistake == "only with the full torque"
    wrong = {"start": "60", "end": 90, "seconds": 1}
    assert check("rotor.1", wrong, who="Ada").mistake == "another kind or shape"
    wrong = check("rotor.1", {"start": 90, "end": 40, "seconds": 0.1}, who="Ada")
    assert wrong.mistake == "start and end exchanged" and wrong.points == 0
    assert len(wrong.says) == 1 and "90 pulses/s" in wrong.says[0]


def test_advice_on_lost_steps_names_the_number_to_change():
    """The check says which number to change, and such a change helps."""
    own = variant("rotor", "Ada")
    load = own["load_inertia"]
    f, strong = (motor.start_frequency(load_inertia=load) for motor in (WEAK, MOTOR))

    def loses(start, end, seconds):
        times = ramp(48, start, end, seconds)
        return any(m.run(times, np.ones(48), 0, load).lost for m in (MOTOR, WEAK))

    def named(*numbers):
        return dict(zip(("start", "end", "seconds"), numbers, strict=True))

    def says(*numbers):
        return check("rotor.1", named(*numbers), who="Ada").says[0]

    assert loses(1.4 * f, 1.4 * f, 0.1) and "has to rise" in says(1.4 * f, 1.4 * f, 0.1)
    fast = 1.05 * strong, 1.5 * strong, 0.25
    assert loses(*fast) and f"cannot follow {fast[0]:.0f} pulses/s: lower `start`" in says(*fast)
    near = 0.95 * f, 1.6 * f, 0.16
    assert loses(*near) and "begins too close" in says(*near) and "lower `start`" in says(*near)
    between = (f + strong) / 2, 2 * f, 0.2  # both motors lose steps, but only one cannot start
    assert MOTOR.run(ramp(48, *between), np.ones(48), 0, load).lost
    assert f"the weaker motor follows at most {f:.0f} pulses/s: lower `start`" in says(*between)
    for at in (between, (1.1 * f, 3 * f, 0.05)):
        assert check("rotor.1", named(*at), who="Ada").mistake == "begins too fast"
    rises = 0.95 * f, 3 * f, 0.05  # no start helps: the rise is the cause
    assert all(loses(k * f, *rises[1:]) for k in np.linspace(0.05, 1, 20))
    assert check("rotor.1", named(*rises), who="Ada").mistake == "too steep or too fast"
    flat = check("rotor.1", named(0.9 * f, 0.9 * f, 0), who="Ada")
    assert flat.mistake == "no ramp" and "has to rise" in flat.says[0]
    assert loses(0.9 * f, 0.9 * f, 0) is False and "s are allowed" in flat.says[0]
    assert not any(loses(k * f, *near[1:]) for k in (0.6, 0.5))
    steep = 0.6 * f, 2 * f, 0.05
    assert loses(*steep) and "raise `seconds`, or lower `end`" in says(*steep)
    assert not loses(*steep[:2], 0.25) and not loses(0.6 * f, 0.9 * f, 0.05)


def test_four_times_the_inertia_needs_twice_the_friction_to_halve_the_frequency():
    """If J, b and t are multiplied by 4, 2 and 2, the equation of motion remains the same."""
    options, right = filled(LAB.predictions["p1"])[1:]
    top = MOTOR.start_frequency()
    assert options[right].text.startswith("About half")
    assert "halved, to 63 pulses/s. The motor reaches 72 pulses/s" in options[right].reason
    assert MOTOR.start_frequency(load_inertia=3e-6) == 72 > top / 2
    more = replace(MOTOR, damping=2 * MOTOR.damping)
    assert more.start_frequency(load_inertia=3e-6) == top / 2 == 63


def test_shortest_ramp_for_the_load_is_as_stated():
    lab = json.loads((NOTEBOOKS / "13_rotor.ipynb").read_text(encoding="utf-8"))
    (text,) = ["".join(cell["source"]) for cell in lab["cells"] if cell["id"] == "ramp-answer"]
    said = re.search(r"(\d+) ms\. But from (\d+) to (\d+) ms, steps are lost again", text)
    least, again, until = map(int, said.groups())
    kept = [
        ms
        for ms in range(0, 301, 10)
        if made_steps(MOTOR, ramp(48, 40, 160, ms / 1000), 3e-6) == 48
    ]
    assert kept == [least, *range(until + 10, 301, 10)] and again == least + 10


def test_ramps_lose_steps_where_the_lab_says():
    """Shorter ramps than the shortest one lose steps on the ramp; longer ones lose them after it,
    when the lag passes half a turn.
    """

    def lost_at(ms):
        "The time in ms at which the lag first exceeds half a turn."
        run = MOTOR.run(ramp(48, 40, 160, ms / 1000), np.ones(48), 0, 3e-6)
        behind = run.due - run.angle > math.pi
        return 1000 * run.t[behind.argmax()] if behind.any() else None

    for ms in (140, 150, 160):
        assert lost_at(ms) < ms
    for ms in (180, 190, 200):
        assert lost_at(ms) > ms
    assert lost_at(170) is lost_at(210) is None


def test_only_the_long_ramp_saves_every_step():
    """What to look at when other ramp times are tried."""
    lab = json.loads((NOTEBOOKS / "13_rotor.ipynb").read_text(encoding="utf-8"))
    source = {cell["id"]: "".join(cell["source"]) for cell in lab["cells"]}
    short, long, alone, end = re.search(
        r"\$t_r\$ = (\S+) and (\S+): only (\S+) loses no step, but this ramp no longer reaches "
        r"(\d+)\.",
        source["ramp-look"],
    ).groups()
    assert {short, long} < set(re.findall(r"[\d.]*\d", source["ramp-code"].split("# try")[1]))
    lost, tops = {}, {}
    for t_r in (short, long):
        times = ramp(48, 40, 160, float(t_r))
        lost[t_r] = [48 - made_steps(MOTOR, times, load) for load in (0, 3e-6)]
        tops[t_r] = 1 / np.diff(times).min()
    assert lost[long] == [0, 0] and alone == long and sum(lost[short]) > 0
    assert tops[long] < 0.95 * int(end) < tops[short]


@pytest.mark.parametrize("ms", [50, 100, 200, 300])
def test_a_short_move_does_not_reach_the_frequency_of_its_ramp(ms):
    """The cell prints the highest frequency. Half of the pulses are sent on the way up."""
    lab = json.loads((NOTEBOOKS / "13_rotor.ipynb").read_text(encoding="utf-8"))
    (code,) = ["".join(cell["source"]) for cell in lab["cells"] if cell["id"] == "ramp-code"]
    names = {}
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(code.replace("t_r = 0.1", f"t_r = {ms / 1000}"), names)
    printed = int(re.search(r"the ramp reaches (\d+) pulses/s", out.getvalue())[1])
    top = math.sqrt(40**2 + 2 * 24 * 120 / (ms / 1000))
    assert 0.985 * min(160, top) < printed <= math.ceil(min(160, top))


def test_step_of_the_iron_rotor_is_as_derived():
    """The poles are half as far apart as the windings are in the ring of the pulls."""
    lab = json.loads((NOTEBOOKS / "13_rotor.ipynb").read_text(encoding="utf-8"))
    source = {cell["id"]: "".join(cell["source"]) for cell in lab["cells"]}
    call = re.search(r"Stepper\(.*\)(?=\))", source["pull-explorer"])[0]
    motor = eval(call, {"Stepper": Stepper})
    said = re.search(
        r"same after (\d+)°.*\\sin (\d)\(.*, (\d+)° apart.*is (\d+)° − (\d+)° = (\d+)°",
        source["deeper-iron"],
    )
    tooth, teeth, pole, first, second, step = map(int, said.groups())
    assert teeth == motor.periods and tooth == 360 / teeth == second
    assert first == pole == 360 / (2 * motor.windings)
    assert f"field turns by {pole}°, the rotor by {step}°" in source["deeper-iron"]
    assert step == pole - tooth == pytest.approx(math.degrees(motor.step))


def test_second_integrator_also_loses_steps_in_multiples_of_four():
    # p10 is computed with SciPy; the time constant of the windings is left out, since it does not
    # change the result
    def lost(frequency):
        theta, omega, since, ends = (
            0.0,
            0.0,
            0.0,
            [*np.arange(1, 49) / frequency, 48 / frequency + 1],
        )
        for k, end in enumerate(ends):
            found = solve_ivp(
                lambda _, y, k=k: [
                    y[1],
                    (0.02 * math.sin(k * TURN / 4 - y[0]) - 6e-5 * y[1]) / 1e-6,
                ],
                (since, end),
                (theta, omega),
                rtol=1e-7,
                atol=1e-9,
            )
            (theta, omega), since = found.y[:, -1], end
        return 48 - theta / (TURN / 4)

    answers = [lost(f) for f in (100, 150, 200)]
    assert answers == pytest.approx([4 * round(n / 4) for n in answers], abs=0.01)
    assert round(answers[0]) == 0 and all(4 < n < 49 for n in answers[1:])
    options, right = filled(LAB.predictions["p10"])[1:]
    assert options[right].text.startswith("Only 4, 8, 12")
