"""The exercises and predictions of lab 05: correct answers in every style pass, mistakes are named,
and the answers to the predictions are computed by another method.
"""

import re

import numpy as np
import pytest

from robokin import SCARA, ScaraPose, blend, deg, follow, lin, mm
from robokin.course import book, check, variant
from robokin.course.questions import filled

LAB = book.lab("scara_motion")
TURN = 2 * np.pi
LOW, HIGH = SCARA.limits.T


# --- Exercise 1: the least rotation of the tool ---------------------------------------------------


def _by_list(q0, position, angle):
    rows = SCARA.ik(ScaraPose(position, angle))
    q = next(r for r in rows if (r[1] >= 0) == (q0[1] >= 0))
    found = []
    for k in range(-8, 9):
        q3 = q[2] + k * TURN
        if LOW[2] <= q3 <= HIGH[2]:
            turn = abs(q[0] + q[1] + q3 - sum(q0[:3]))
            found.append((turn, [q[0], q[1], q3, q[3]]))
    return min(found)[1]


def _by_rounding(q0, position, angle):
    x, y, z = position
    r = np.hypot(x, y)
    side = 1 if q0[1] >= 0 else -1
    q2 = side * np.arccos((r**2 - 0.2**2 - 0.25**2) / (2 * 0.2 * 0.25))
    q1 = np.arctan2(y, x) - np.arctan2(0.25 * np.sin(q2), 0.2 + 0.25 * np.cos(q2))
    q1 = (q1 + np.pi) % TURN - np.pi
    now = q0[:3].sum()
    end = angle + TURN * np.round((now - angle) / TURN)
    q3 = end - q1 - q2
    while q3 > 400 * deg:
        q3 -= TURN
    while q3 < -400 * deg:
        q3 += TURN
    return np.array([[q1, q2, q3, 0.2202 - z]]).round(9)


@pytest.mark.parametrize("answer", [_by_list, _by_rounding])
def test_least_rotation_found_by_other_methods_passes(answer):
    assert check("scara_motion.1", answer).holds


def _posture(q0, position, angle):
    return SCARA.ik(ScaraPose(position, angle))[SCARA.branch(1 if q0[1] >= 0 else -1)].copy()


def _wrap(x):
    return (x + np.pi) % TURN - np.pi


def _joint(q0, position, angle):
    q = _posture(q0, position, angle)
    q[2] = q0[2] + _wrap(q[2] - q0[2])
    return q


def _raw(q0, position, angle):
    return _posture(q0, position, angle)


def _end_of_lin(q0, position, angle):
    row = SCARA.branch(1 if q0[1] >= 0 else -1)
    start = ScaraPose(SCARA.fk(q0).translation, sum(q0[:3]))
    path = lin(start, ScaraPose(position, angle), np.linspace(0, 1, 201))
    return follow(SCARA, SCARA.ik(path), row)[-1]


def _no_limits(q0, position, angle):
    q = _posture(q0, position, angle)
    now = q0[:3].sum()
    q[2] = now + _wrap(angle - now) - q[0] - q[1]
    return q


def _clipped(q0, position, angle):
    q = _no_limits(q0, position, angle)
    q[2] = np.clip(q[2], -400 * deg, 400 * deg)
    return q


def _q3_is_angle(q0, position, angle):
    q = _posture(q0, position, angle)
    q[2] = angle
    return q


def _q3_is_short_angle(q0, position, angle):
    q = _posture(q0, position, angle)
    q[2] = q0[2] + _wrap(angle - q0[2])
    return q


def _row_zero(q0, position, angle):
    q = SCARA.ik(ScaraPose(position, angle))[0].copy()
    now = q0[:3].sum()
    ends = [angle + k * TURN for k in range(-6, 7)]
    ends = [e for e in ends if LOW[2] <= e - q[0] - q[1] <= HIGH[2]]
    q[2] = min(ends, key=lambda e: abs(e - now)) - q[0] - q[1]
    return q


def _in_360(q0, position, angle):
    q = _no_limits(q0, position, angle)
    while q[2] > HIGH[2]:
        q[2] -= 360
    while q[2] < LOW[2]:
        q[2] += 360
    return q


def _in_degrees(q0, position, angle):
    return _by_list(q0, position, angle * deg)


def _list_without_limits(q0, position, angle):
    q = _posture(q0, position, angle)
    ends = [angle + k * TURN for k in (-1, 0, 1)]
    q[2] = min(ends, key=lambda e: abs(e - q0[:3].sum())) - q[0] - q[1]
    return q


def _three_turns(q0, position, angle):
    q = _posture(q0, position, angle)
    ends = [q[2] + k * TURN for k in (-1, 0, 1) if LOW[2] <= q[2] + k * TURN <= HIGH[2]]
    q[2] = min(ends, key=lambda e: abs(e - q0[2]))
    return q


def _largest(q0, position, angle):
    q = _posture(q0, position, angle)
    ends = [q[2] + k * TURN for k in (-2, -1, 0, 1, 2) if LOW[2] <= q[2] + k * TURN <= HIGH[2]]
    q[2] = max(ends, key=lambda e: abs(q[0] + q[1] + e - q0[:3].sum()))
    return q


def _least_signed(q0, position, angle):
    q = _posture(q0, position, angle)
    ends = [q[2] + k * TURN for k in (-2, -1, 0, 1, 2) if LOW[2] <= q[2] + k * TURN <= HIGH[2]]
    q[2] = min(ends, key=lambda e: q[0] + q[1] + e - q0[:3].sum())
    return q


def _nearest_zero(q0, position, angle):
    q = _posture(q0, position, angle)
    ends = [q[2] + k * TURN for k in (-2, -1, 0, 1, 2) if LOW[2] <= q[2] + k * TURN <= HIGH[2]]
    q[2] = min(ends, key=lambda e: abs(q[0] + q[1] + e))
    return q


def _plus_the_turn(q0, position, angle):
    q = _posture(q0, position, angle)
    q[2] = q0[2] + _wrap(angle - q0[:3].sum())
    return q


def _plus_elbow(q0, position, angle):
    q = SCARA.ik(ScaraPose(position, angle))[SCARA.branch(+1)].copy()
    now = q0[:3].sum()
    q[2] = now + _wrap(angle - now) - q[0] - q[1]
    return q


def _tool_angle_returned(q0, position, angle):
    q = _by_list(q0, position, angle)
    return [q[0], q[1], q[0] + q[1] + q[2], q[3]]


def _start_moves(q0, position, angle):
    q = _posture(q0, position, angle)
    now = _wrap(q0[:3].sum())
    q[2] = now + _wrap(angle - now) - q[0] - q[1]
    return q


def _stroke_in_mm(q0, position, angle):
    q = _by_list(q0, position, angle)
    return [*q[:3], q[3] / mm]


def _all_in_degrees(q0, position, angle):
    q = _by_list(q0, position, angle)
    return [*np.rad2deg(q[:3]), q[3]]


def _degrees_without_limits(q0, position, angle):
    return np.degrees(_no_limits(q0, position, angle))


def _nearest_row(q0, position, angle):
    rows = SCARA.ik(ScaraPose(position, angle))
    q = rows[np.argmin(np.linalg.norm(rows - q0, axis=1))].copy()
    now = q0[:3].sum()
    ends = [q[2] + k * TURN for k in range(-3, 4)]
    ends = [e for e in ends if LOW[2] <= e <= HIGH[2]]
    q[2] = min(ends, key=lambda e: abs(q[0] + q[1] + e - now))
    return q


def _zero_is_negative(q0, position, angle):
    q = SCARA.ik(ScaraPose(position, angle))[SCARA.branch(1 if q0[1] > 0 else -1)]
    ends = [q[2] + k * TURN for k in range(-3, 4)]
    ends = [e for e in ends if LOW[2] <= e <= HIGH[2]]
    now = sum(q0[:3])
    return [*q[:2], min(ends, key=lambda e: abs(q[0] + q[1] + e - now)), q[3]]


def _zero_is_negative_and_ik_as_it_is(q0, position, angle):
    return SCARA.ik(ScaraPose(position, angle))[SCARA.branch(1 if q0[1] > 0 else -1)]


def _stroke_in_both_angles(q0, position, angle):
    q = SCARA.ik(ScaraPose(position, angle))[SCARA.branch(1 if q0[1] >= 0 else -1)]
    low, high = SCARA.limits[2]
    turns = q[2] + 2 * np.pi * np.arange(-4, 5)
    turns = turns[(turns >= low - 1e-9) & (turns <= high + 1e-9)]
    return [*q[:2], min(turns, key=lambda x: abs(q[0] + q[1] + x + q[3] - q0.sum())), q[3]]


@pytest.mark.parametrize(("most", "name"), [(2, "only two turns"), (3, "only three turns")])
def test_too_few_turns_are_reported(most, name):
    def few(q0, position, angle):
        q = _posture(q0, position, angle)
        ends = [angle + k * TURN - q[0] - q[1] for k in sorted(range(-most, most + 1), key=abs)]
        inside = [e for e in ends if LOW[2] <= e <= HIGH[2]] or ends
        q[2] = min(inside, key=lambda e: abs(e + q[0] + q[1] - q0[:3].sum()))
        return q

    assert check("scara_motion.1", few).mistake == name


def test_message_about_a_case_states_degrees_and_the_side_of_the_elbow():
    case = check("scara_motion.1", _zero_is_negative).case
    assert "joint 2 is at 0.0° in q0 (treated as positive)" in case
    case = check("scara_motion.1", _degrees_without_limits).case
    assert "which is right in degrees" in case and "5156" not in case
    assert "the elbow ends on the other side" in check("scara_motion.1", _nearest_row).case


@pytest.mark.parametrize(
    ("answer", "word"),
    [
        (_degrees_without_limits, "degrees for radians"),
        (_nearest_row, "the nearer posture, elbow changed"),
        (_zero_is_negative, "joint 2 at 0 is treated as negative"),
        (
            _zero_is_negative_and_ik_as_it_is,
            "joint 2 at 0 is treated as negative, and the row of ik",
        ),
        (_stroke_in_both_angles, "joint 4 is added to both angles"),
        (_joint, "joint 3"),
        (_three_turns, "joint 3"),
        (_raw, "row of ik"),
        (_end_of_lin, "by LIN"),
        (_no_limits, "limits"),
        (_clipped, "clipped"),
        (_q3_is_angle, "joint 3"),
        (_q3_is_short_angle, "joint 3"),
        (_row_zero, "elbow"),
        (_in_degrees, "degrees"),
        (_list_without_limits, "one turn"),
        (_largest, "longest"),
        (_least_signed, "lowest"),
        (_nearest_zero, "wrapped"),
        (_plus_the_turn, "joints 1 and 2 of the start"),
        (_plus_elbow, "elbow +1"),
        (_tool_angle_returned, "tool's angle"),
        (_start_moves, "start is wrapped"),
        (_stroke_in_mm, "mm"),
        (_all_in_degrees, "all angles in degrees"),
        (_in_360, "360"),
    ],
)
def test_mistakes_in_the_rotation_are_named(answer, word):
    verdict = check("scara_motion.1", answer)
    assert not verdict.holds and verdict.case
    assert verdict.mistake and word in verdict.mistake, verdict


# --- Exercise 2: a limit test ---------------------------------------------------------------------


def _loops(q, limits, lengths):
    for posture in q:
        for value, (low, high), length in zip(posture, limits, lengths, strict=True):
            size = 0.001 if length else np.pi / 180
            if not low * size <= value <= high * size:
                return False
    return True


def _in_si(limits, lengths):
    return np.array(limits).T * [0.001 if length else np.pi / 180 for length in lengths]


def _middles(q, limits, lengths):
    low, high = _in_si(limits, lengths)
    return np.all(abs(q - (low + high) / 2) <= (high - low) / 2 + 1e-9)


def _extremes(q, limits, lengths):
    low, high = _in_si(limits, lengths)
    return bool((q.min(axis=0) >= low).all() and (q.max(axis=0) <= high).all())


def _slack(q, limits, lengths):
    low, high = _in_si(limits, lengths)
    return not (~((q >= low - 9e-7) & (q <= high + 9e-7))).any()


def _in_degrees_and_mm(q, limits, lengths):
    shown = np.where(lengths, 1000 * q, np.degrees(q))
    return bool(((shown >= limits[:, 0]) & (shown <= limits[:, 1])).all())


@pytest.mark.parametrize("answer", [_loops, _middles, _extremes, _slack, _in_degrees_and_mm])
def test_correct_limit_tests_pass_in_every_style(answer):
    assert check("scara_motion.2", answer).holds


def _forgetful(q, limits, lengths):
    return _loops(q[:, :-1], limits[:-1], lengths[:-1])


def _stroke_last(q, limits, lengths):
    return _loops(q, limits, [False, False, False, True])


def _wraps(q, limits, lengths):
    return _loops(np.where(lengths, q, _wrap(q)), limits, lengths)


def _wraps_by_sine(q, limits, lengths):
    return _loops(np.where(lengths, q, np.arctan2(np.sin(q), np.cos(q))), limits, lengths)


def _labs_arm(q, limits, lengths):
    return bool(((q >= SCARA.limits[:, 0]) & (q <= SCARA.limits[:, 1])).all())


def _some(chosen):
    """Return a function that tests only the chosen samples."""
    return lambda q, limits, lengths: _loops(chosen(q), limits, lengths)


def _compared(within):
    """Return a function that compares all values with the limits, converted to rad and m."""
    return lambda q, limits, lengths: within(q, *_in_si(limits, lengths))


@pytest.mark.parametrize(
    ("answer", "word"),
    [
        (_forgetful, "the last joint is never tested"),
        (_stroke_last, "only the last axis is a length"),
        (_labs_arm, "the limits of this lab's arm"),
        (_wraps, "wrapped"),
        (_wraps_by_sine, "wrapped"),
        (_some(lambda q: q[[0, -1]]), "only the ends"),
        (_some(lambda q: q[::2]), "samples are left out"),
        (_some(lambda q: q[::3]), "samples are left out"),
        (_some(lambda q: q[::5]), "samples are left out"),
        (_some(lambda q: [*q[::10], q[-1]]), "samples are left out"),
        (_compared(lambda q, low, high: not ((q < low) | (q > high)).any()), "NaN passes"),
        (_some(lambda q: q[~np.isnan(q).any(axis=1)]), "NaN passes"),
        (_compared(lambda q, low, high: bool(((q > low) & (q < high)).all())), "themselves"),
        (lambda *case: not _loops(*case), "swapped"),
        (lambda *case: False, "one answer to everything"),
        (lambda *case: True, "one answer to everything"),
        (_compared(lambda q, low, high: (q >= low) & (q <= high)), "another kind"),
        (
            _compared(lambda q, low, high: bool(((q >= low - 1e-3) & (q <= high + 1e-3)).all())),
            "a margin too wide",
        ),
        (
            _compared(lambda q, low, high: not ((q < low - 1e-4) | (q > high + 1e-4)).any()),
            "a margin too wide, and NaN",
        ),
        (
            lambda q, limits, lengths: bool(((q >= limits[:, 0]) & (q <= limits[:, 1])).all()),
            "limits in degrees and mm",
        ),
    ],
)
def test_mistakes_in_limit_tests_are_named(answer, word):
    verdict = check("scara_motion.2", answer)
    assert not verdict.holds and verdict.case and word in verdict.mistake, verdict


def test_a_case_of_the_limit_test_shows_lengths_as_booleans():
    told = check("scara_motion.2", _forgetful).case
    assert re.search(r"lengths = \[False, False, False, True\]", told), told


@pytest.mark.parametrize("joint", [1, 2, 3])
def test_verdict_names_the_joint_that_is_never_tested(joint):
    def one_left_out(q, limits, lengths):
        q = q.copy()
        q[~np.isnan(q).any(axis=1), joint - 1] = _in_si(limits, lengths).mean(axis=0)[joint - 1]
        return _loops(q, limits, lengths)

    verdict = check("scara_motion.2", one_left_out)
    assert verdict.mistake == f"joint {joint} is never tested", verdict


@pytest.mark.parametrize("end", [0, 1])
def test_verdict_names_the_length_limits_that_are_never_tested(end):
    def one_side(q, limits, lengths):
        limits = limits.copy()
        limits[lengths, end] = (-9e9, 9e9)[end]
        return _loops(q, limits, lengths)

    name = f"the {('lower', 'upper')[end]} limits of lengths are never tested"
    assert check("scara_motion.2", one_side).mistake == name


def test_message_about_a_case_of_the_limit_test_states_the_excess():
    law = LAB.module("limits_kept")["law"]
    sheet = np.array([[-140, 140], [-150, 150], [-400, 400], [0, 180]]), np.arange(4) == 3
    q = np.tile([0.1, 0.5, 0.2, 0.1], (3, 1))
    for joint, value, told in (
        (3, -2e-6, "joint 4 is at −0.0000020 m, 0.002 mm below its limit of 0 mm"),
        (2, LOW[2] - 2e-6, "joint 3 is at −6.9813190 rad, 0.0001° below its limit of −400°"),
        (0, HIGH[0] + 5 * deg, "joint 1 is at 2.5307274 rad, 5.0° above its limit of 140°"),
    ):
        bad = q.copy()
        bad[1, joint] = value
        assert told in law((bad, *sheet), True, False)
        assert law((bad, *sheet), False, False) is None
    bad[1, 0] = HIGH[0] - 1e-7
    told = law((bad, *sheet), False, True)
    assert "joint 1 is at 2.4434609 rad, its limit is 2.4434610 rad" in told


# --- Exercise 3: an individual blend --------------------------------------------------------------


def _least(mine):
    h1, h2 = mine["start_z"] - mine["via_z"], mine["goal_z"] - mine["via_z"]
    return (40.2 * mm - mine["via_z"]) * (h1 + h2) / (2 * h1 * h2), h1 + h2


@pytest.mark.parametrize("more", [1.0001, 1.05, 1.1])
def test_every_student_has_a_feasible_blend(more):
    for who in range(40):
        mine = variant("scara_motion", who)
        b, both = _least(mine)
        assert 0.05 < b < 0.45
        needed = np.sqrt(both / (more * b * mine["acceleration"]))
        assert needed > 5  # so that rounding up to a tenth of a second adds less than 2 %
        for duration in (needed, needed * 1.019, np.ceil(10 * needed) / 10):
            design = {"blend": more * b, "duration": duration}
            assert check("scara_motion.3", design, who=who).holds, (who, mine)
        for factor, name in ((0.99, "too fast"), (1.021, "slower than needed")):
            design = {"blend": more * b, "duration": needed * factor}
            assert check("scara_motion.3", design, who=who).mistake == name
        # for every name, the check detects heights that are measured from the table instead of from
        # via
        over_table = mine["start_z"] + mine["goal_z"]
        assert np.sqrt(over_table / both) > 1.025


def test_joints_1_to_3_stay_inside_their_limits_for_all_blends():
    start, via, goal = (LAB.module("shared")[name] for name in ("START", "VIA", "GOAL"))
    for b in np.linspace(0, 0.5, 11):
        path = blend(start, via, goal, b, np.linspace(0, 1, 1001))
        q = LAB.module("shared")["joints"](path)[:, :3]
        assert ((q > LOW[:3]) & (q < HIGH[:3])).all()
        higher = ScaraPose(path.position + [0, 0, 0.1], path.angle)
        assert np.allclose(SCARA.ik(higher)[..., :3], SCARA.ik(path)[..., :3], rtol=0, atol=1e-12)


def test_mistakes_in_the_design_are_named():
    mine = variant("scara_motion", "Ada")
    b, both = _least(mine)

    def told(blend_, factor):
        shortest = np.sqrt(both / (blend_ * mine["acceleration"]))
        design = {"blend": blend_, "duration": factor * shortest}
        verdict = check("scara_motion.3", design, who="Ada")
        assert not verdict.holds
        return verdict.mistake

    assert told(0.95 * b, 1) == "past the stroke's limit"
    assert told(min(1.6 * b, 0.5), 1) == "too far from via"
    assert told(1.05 * b, 0.7) == "too fast"
    assert told(1.05 * b, 1.1) == "slower than needed"
    assert told(0.6, 1) == "no such blend"
    assert told(100 * b, 1) == "another kind or shape"
    assert told(1.05 * b, -1) == "no such duration"


# --- Answers to the predictions -------------------------------------------------------------------


def test_answers_to_predictions_agree_with_other_calculations():
    right = {name: filled(p)[1][filled(p)[2]].text for name, p in LAB.predictions.items()}
    assert right["p1"] == "Joint 3 alone: the others only set the position."
    assert right["p2"] == "Joint 4 alone: the tool rises or descends evenly."
    assert right["p3"] == "x and y."
    assert right["p4"] == "In LIN alone: the line decides what the joints do."
    assert right["p7"] == "Joint 3: 410° becomes 50°."
    assert float(right["p5"]) == -90 / 5 - 60 / 5
    assert float(right["p6"]) == 180
    assert float(right["p8"]) == pytest.approx(2 * 0.4 * 60 * 180 / 240, abs=0.5)
    assert "0.35" in right["p9"] and right["p10"] == "It falls to half."


def test_corners_of_different_blends_differ_only_in_scale():
    start, via, goal = (LAB.module("shared")[name] for name in ("START", "VIA", "GOAL"))
    x = np.linspace(0, 1, 11)
    for corner in ("parabola", "quintic"):
        shapes = [
            blend(start, via, goal, b, 0.5 - b + 2 * b * x, corner=corner) for b in (0.1, 0.2, 0.5)
        ]
        ways = [(shape.position - via.position) for shape in shapes]
        assert np.allclose(2 * ways[0], ways[1], rtol=0, atol=1e-12)
        assert np.allclose(5 * ways[0], ways[2], rtol=0, atol=1e-12)


@pytest.mark.parametrize("times", [1, 2])
@pytest.mark.parametrize("line", ["start_z", "goal_z"])
def test_duration_from_the_height_of_one_line_is_named(line, times):
    mine = variant("scara_motion", "Ada")
    least, both = _least(mine)
    seen = times * (mine[line] - mine["via_z"])
    assert abs(np.sqrt(seen / both) - 1) > 0.05
    b = 1.01 * least
    design = {"blend": b, "duration": np.sqrt(seen / (b * mine["acceleration"]))}
    verdict = check("scara_motion.3", design, who="Ada")
    assert verdict.mistake == "the height of one line alone"
    assert "from 2 h1 / T to \N{MINUS SIGN}2 h2 / T" in " ".join(verdict.says)


@pytest.mark.parametrize(
    ("spoil", "name"),
    [
        (lambda t: t**2, "the root is forgotten"),
        (lambda t: t / 2, "half of the duration"),
        (lambda t: 2 * t, "twice the duration"),
        (lambda t: t / 1000**0.5, "mm instead of m"),
        (lambda t: t * 1000**0.5, "mm instead of m"),
        (lambda t: 1.3 * t, "slower than needed"),
        (lambda t: 0.9 * t, "too fast"),
        (lambda t: 0.508 * t, "too fast"),  # not exactly half, so the cause is unknown
        (lambda t: 1.97 * t, "slower than needed"),
    ],
)
def test_slips_in_the_duration_are_named(spoil, name):
    mine = variant("scara_motion", "Ada")
    h1, h2 = (mine[z] - mine["via_z"] for z in ("start_z", "goal_z"))
    b = 1.01 * (40.2 * mm - mine["via_z"]) / 2 * (h1 + h2) / (h1 * h2)
    shortest = np.sqrt((h1 + h2) / (b * mine["acceleration"]))
    assert check("scara_motion.3", {"blend": b, "duration": 1.005 * shortest}, who="Ada").holds
    verdict = check("scara_motion.3", {"blend": b, "duration": spoil(shortest)}, who="Ada")
    assert not verdict.holds and verdict.mistake == name


def test_test_of_a_single_posture_gets_a_hint_about_arrays():
    def one_posture(q, limits, lengths):
        return all(
            low <= x <= high for x, low, high in zip(q, *_in_si(limits, lengths), strict=False)
        )

    verdict = check("scara_motion.2", one_posture)
    assert not verdict.holds and ".all() or .any()" in " ".join([*verdict.says, verdict.case])
