"""The exercise and the predictions of lab 13: feasible ramps pass, and mistakes in other ramps are
named.
"""

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
    made = {"start": 0.6 * f, "end": 1.6 * f, "seconds": 10 * swing}
    assert check("rotor.1", made, who=who).holds


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
    for name, (start, end, seconds) in wrong.items():
        verdict = check("rotor.1", {"start": start, "end": end, "seconds": seconds}, who="Ada")
        assert verdict.mistake == name and verdict.points < 1
    # the shortest ramp on which the motor loses no steps is too short for the weak motor
    edge = next(
        r
        for r in np.arange(0.02, 0.5, 0.01)
        if not MOTOR.run(ramp(48, 0.6 * f, 1.6 * f, r), np.ones(48), 0, load).lost
    )
    made = {"start": 0.6 * f, "end": 1.6 * f, "seconds": edge}
    assert check("rotor.1", made, who="Ada").mistake == "only with the full torque"
    for wrong in (
        {"start": 90, "end": 40, "seconds": 0.1},
        {"start": "60", "end": 90, "seconds": 1},
    ):
        assert check("rotor.1", wrong, who="Ada").mistake == "another kind or shape"


def test_four_times_the_inertia_needs_twice_the_friction_to_halve_the_frequency():
    """If J, b and t are multiplied by 4, 2 and 2, the equation of motion remains the same."""
    options, right = filled(LAB.predictions["p1"])[1:]
    top = MOTOR.start_frequency()
    assert options[right].text.startswith("Up to 72 pulses/s")
    assert MOTOR.start_frequency(load_inertia=3e-6) == 72 > top / 2
    more = replace(MOTOR, damping=2 * MOTOR.damping)
    assert more.start_frequency(load_inertia=3e-6) == top / 2 == 63


def test_shortest_ramp_for_the_load_is_as_stated():
    lab = json.loads((NOTEBOOKS / "13_rotor.ipynb").read_text(encoding="utf-8"))
    (text,) = ["".join(cell["source"]) for cell in lab["cells"] if cell["id"] == "load-take"]
    said = re.search(r"(\d+) ms\. But from (\d+) to (\d+) ms, steps are lost again", text)
    least, again, until = map(int, said.groups())
    kept = [
        ms
        for ms in range(100, 301, 10)
        if made_steps(MOTOR, ramp(48, 40, 160, ms / 1000), 3e-6) == 48
    ]
    assert kept == [least, *range(until + 10, 301, 10)] and again == least + 10


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
