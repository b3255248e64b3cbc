"""The exercises of lab 11: correct answers in different styles pass, and mistakes are named."""

import json
import math
import re

import numpy as np
import pytest
from conftest import NOTEBOOKS

from robokin import deg, loader_arm
from robokin.course import book, check, predict, solution, variant
from robokin.jobs.steppers import counts, frequencies, shortest_turn, station_postures

A, B, E = 0.45, 0.3, 0.1
LOADER = loader_arm(A, B)
TURN = 2 * math.pi
LAB = book.lab("motor_synchronisation")


def short(d):
    return d - TURN * round(d / TURN)


def posture(alpha, guard=True, beta=lambda b: b):
    """A program that computes alpha with the given function. Without the guard against rounding
    errors, math.acos raises an error.
    """

    def program(point, before):
        x, y, z = map(float, point)
        u = math.sqrt(x * x + y * y) - E
        h = math.sqrt(u * u + z * z)
        if guard and not A - B <= h <= A + B:
            return [math.nan] * 3
        inside = math.acos((A * A + B * B - h * h) / (2 * A * B))
        gamma = math.acos((A * A + h * h - B * B) / (2 * A * h)) + math.atan2(z, u)
        return [alpha(x, y, before), gamma, beta(inside)]

    return program


def right(x, y, before):
    return before if x == y == 0 else before + short(math.atan2(y, x) - before)


def in_degrees(x, y, before):
    """Subtract multiples of 360, as in the lab's program in degrees, from an angle in radians."""
    d = math.atan2(y, x) - before
    return before if x == y == 0 else before + d - 360 * round(d / 360)


def by_loops(x, y, before):
    alpha = before if x == y == 0 else math.atan2(y, x)
    while alpha - before > math.pi:
        alpha -= TURN
    while alpha - before < -math.pi:
        alpha += TURN
    return alpha


def by_package(point, before):
    """Use the inverse of a loader without a shoulder offset, in the plane of the arm."""
    x, y, z = point
    q = LOADER.ik([abs(np.hypot(x, y) - E), 0, z])[LOADER.branch(1, -1)]
    if np.isnan(q).any():
        return np.nan
    gamma = q[1] if np.hypot(x, y) >= E else q[1] + np.pi - 2 * math.atan2(z, E - np.hypot(x, y))
    alpha = before + shortest_turn(before, np.arctan2(y, x)) if x or y else before
    return [[alpha, gamma % TURN, abs(q[2])]]


def only_calls(point, before):
    """Call the functions as in the lab and ignore the shoulder offset."""
    q = LOADER.ik(point)[LOADER.branch(1, -1)]
    return [before + shortest_turn(before, q[0]), q[1], q[2]]


def test_removing_only_two_turns_is_not_enough():
    def few(x, y, before):
        ends = [math.atan2(y, x) + k * TURN for k in range(-2, 3)]
        return before if x == y == 0 else min(ends, key=lambda a: abs(a - before))

    verdict = check("motor_synchronisation.1", posture(few))
    assert not verdict.holds and verdict.mistake == "at most two turns are subtracted"


@pytest.mark.parametrize("answer", [posture(right), posture(by_loops), by_package])
def test_correct_postures_pass_in_every_style(answer):
    assert check("motor_synchronisation.1", answer).holds


@pytest.mark.parametrize(
    ("answer", "name"),
    [
        (posture(right, guard=False), "an error instead of NaN"),
        (posture(lambda x, y, b: math.atan2(y, x)), "alpha does not continue from before"),
        (posture(lambda x, y, b: b + short(math.atan2(y, x) - b)), "on the axis"),
        (only_calls, "the shoulder is left out"),
        (posture(lambda x, y, b: right(x, y, b) % TURN), "alpha from 0° to 360°"),
        (posture(lambda x, y, b: 0 if x == y == 0 else right(x, y, b) - b), "the turn instead"),
        (posture(right, beta=lambda b: math.pi - b), "the exterior angle at the elbow"),
        (
            posture(right, guard=False, beta=lambda b: math.pi - b),
            "the exterior angle at the elbow",
        ),
        (lambda p, b: np.degrees(posture(right)(p, b)), "degrees for radians"),
    ],
)
def test_mistakes_in_postures_are_named(answer, name):
    verdict = check("motor_synchronisation.1", answer)
    assert not verdict.holds and name in verdict.mistake


def test_360_degrees_in_a_program_in_radians_is_mentioned():
    verdict = check("motor_synchronisation.1", posture(in_degrees))
    assert not verdict.holds and "In radians, a whole turn is 2 pi." in " ".join(verdict.says)


STOPS = ("start", "goal", "home", "start")


def move(who):
    """A student's numbers, the four postures of the cycle, and the smallest gears."""
    own = variant("motor_synchronisation", who)
    ends = np.reshape([own[f"{end}_{x}"] for end in STOPS for x in "xyz"], (4, 3))
    reach = np.array([A + B, A + B, B])  # from each joint to the end of the stretched arm
    least = np.ceil(reach * 0.9 * deg / own["miss"] - 1e-9)
    return own, station_postures(LOADER, ends), least


def sent(q, gears):
    return np.diff(counts(q, np.array(gears) / 1.8), axis=0)


def pulses(q, gears):
    return abs(sent(q, gears)[0])


def drive(q, gears, omega):
    return {"gears": gears, "pulses": sent(q, gears), "frequencies": omega}


@pytest.mark.parametrize("who", [f"student {k}" for k in range(30)])
def test_every_student_has_a_feasible_move(who):
    own, q, least = move(who)
    for gears in (least, least + [0, 1, 2]):
        answer = drive(q, gears, list(frequencies(pulses(q, gears), own["most"])))
        assert check("motor_synchronisation.2", answer, who=who).holds
    alpha = (q[:, 0] + np.pi) % TURN - np.pi
    assert abs(np.diff(alpha)[0]) > np.pi, "the move does not cross 180°"
    assert q[-1] == pytest.approx(q[0], abs=1e-12), "the cycle winds joint 1 up"
    assert drifts(q, least).any(), "the cycle does not drift if every move is rounded"
    shortest = pulses(q, least).max() / own["most"]
    assert shortest < own["seconds"] < 1.2 * shortest + 0.11, "the limit does not bind"
    fine = np.ceil(1.5 * least)
    answer = drive(q, fine, frequencies(pulses(q, fine), own["most"]))
    assert check("motor_synchronisation.2", answer, who=who).mistake == "geared too high"
    answer = drive(q, least, frequencies(pulses(q, least), own["most"])) | {
        "pulses": np.rint(np.diff(q / deg * least / 1.8, axis=0))
    }
    verdict = check("motor_synchronisation.2", answer, who=who)
    assert not verdict.holds and verdict.mistake == "every move rounded"
    [k, off] = re.search(
        r"After one cycle, motor (\d) is (\d+) pulses? from", " ".join(verdict.says)
    ).groups()
    assert abs(drifts(q, least)[int(k) - 1]) == float(off) == abs(drifts(q, least)).max()


def drifts(q, gears):
    """The pulses left over after one cycle if every move is rounded."""
    return np.rint(np.diff(q / deg * gears / 1.8, axis=0)).sum(axis=0)


def test_mistakes_in_drives_are_named():
    own, q, gears = move("Ada")
    most = own["most"]
    n = pulses(q, gears)
    turns = abs(np.diff(q, axis=0)[0])
    wrong = {
        "one frequency for all": (gears, np.full(3, most)),
        "equal products": (gears, n.min() / n * most),
        "above the limit": (gears, frequencies(n, 1.2 * most)),
        "slower than the limit asks": (gears, frequencies(n, 0.5 * most)),
        "geared too high": (9 * gears, frequencies(n, most)),
        "too coarse": (gears - 1, frequencies(n, most)),
        "the gears left out": (gears + [0, 5, 8], turns / turns.max() * most),
    }
    for name, (r, omega) in wrong.items():
        answer = drive(q, r, omega)
        assert check("motor_synchronisation.2", answer, who="Ada").mistake == name


@pytest.mark.parametrize("who", ["Ada", "Bo", "Cy", "Di"])
def test_mistakes_in_the_pulses_of_a_cycle_are_named(who):
    own, q, gears = move(who)
    right = sent(q, gears)
    answer = drive(q, gears, frequencies(abs(right[0]), own["most"]))
    due = q / deg * gears / 1.8
    long = np.column_stack([(q[:, 0] + np.pi) % TURN - np.pi, q[:, 1:]])
    wrong = {
        "pulses that are not whole": [np.diff(due, axis=0), right + 0.5],
        "every move rounded": [np.rint(np.diff(due, axis=0))],
        "the signs of the pulses": [abs(right), -right],
        "the long way round": [sent(long, gears)],
        "positions truncated": [np.diff(cut(due), axis=0) for cut in (np.trunc, np.floor)],
        "positions instead of pulses": [np.rint(due[:3]), np.rint(due[1:])],
        "the gears left out": [np.diff(np.rint(q / deg / 1.8), axis=0)],
        "degrees for pulses": [np.rint(np.diff(q / deg, axis=0))],
        "rows and columns swapped": [right.T],
        "wrong pulses": [right + [[0, 0, 0], [0, 7, 0], [0, -7, 0]], np.zeros((3, 3))],
    }
    for name, programs in wrong.items():
        for each in programs:
            verdict = check("motor_synchronisation.2", answer | {"pulses": each}, who=who)
            assert not verdict.holds and verdict.mistake == name, (name, verdict)
            if name != "wrong pulses":
                continue
            assert not each.any() or "motor 2 end 7 pulses from the position nearest to home" in (
                " ".join(verdict.says)
            )
    for each in (right.tolist(), right.astype(float), right.astype(int)):
        assert check("motor_synchronisation.2", answer | {"pulses": each}, who=who).holds
    for each in (right[:2], right[0], "none"):
        verdict = check("motor_synchronisation.2", answer | {"pulses": each}, who=who)
        assert verdict.mistake == "another kind or shape", verdict
    verdict = check("motor_synchronisation.2", answer | {"pulses": ...}, who=who)
    assert not verdict.holds and not verdict.answered


def test_shoulder_taken_along_x_and_none_for_no_posture_are_named():
    def along_x(point, before):
        x, y, z = map(float, point)
        u = math.hypot(x - E, y)
        h = math.hypot(u, z)
        if not A - B <= h <= A + B:
            return np.full(3, np.nan)
        gamma = math.acos((A * A + h * h - B * B) / (2 * A * h)) + math.atan2(z, u)
        return [right(x, y, before), gamma, math.acos((A * A + B * B - h * h) / (2 * A * B))]

    def nothing(point, before):
        q = np.array(posture(right)(point, before))
        return None if np.isnan(q).any() else q

    verdict = check("motor_synchronisation.1", along_x)
    assert verdict.mistake == "the shoulder along x"
    verdict = check("motor_synchronisation.1", nothing)
    assert not verdict.holds and verdict.mistake == "None instead of NaN"
    assert any("return three NaNs" in line for line in verdict.says)


@pytest.mark.parametrize("signs", [(-1, -1, -1), (1, -1, 1), (1, 1, -1)])
def test_negative_frequencies_do_not_hold(signs):
    own, q, gears = move("Ada")
    omega = frequencies(pulses(q, gears), own["most"])
    answer = drive(q, gears, omega * signs)
    verdict = check("motor_synchronisation.2", answer, who="Ada")
    assert not verdict.holds and any("positive" in line for line in verdict.says)
    assert check("motor_synchronisation.2", {**answer, "frequencies": omega}, who="Ada").holds


@pytest.mark.parametrize(
    ("question", "number", "told"),
    [
        ("p2", 190, "after the first turn"),
        ("p4", 250, "do not share"),
        ("p9", 43.2, "two full steps"),
    ],
)
def test_wrong_numbers_in_predictions_are_named(question, number, told):
    reply = str(predict(f"motor_synchronisation.{question}", number))
    assert told in " ".join(reply.split())


@pytest.mark.parametrize("of_size", [False, True])
def test_reply_gives_both_postures_in_degrees_and_does_not_give_away_the_rule(of_size):
    def low(point, before):
        """Takes the elevation from arcsin, or from abs(u): it is never above 90 degrees."""
        alpha, gamma, beta = posture(right)(point, before)
        u = np.hypot(*point[:2]) - E
        h = np.hypot(u, point[2])
        low = math.atan2(point[2], abs(u)) if of_size else math.asin(point[2] / h)
        return [alpha, gamma - math.atan2(point[2], u) + low, beta]

    verdict = check("motor_synchronisation.1", low)
    assert verdict.mistake == "gamma 2 never above 90°"
    assert not any("You used arcsin" in line for line in verdict.says)
    asked, given = re.search(
        r"α, γ, β should be (.*) degrees, not (.*); your", verdict.case
    ).groups()
    asked, given = (np.array([float(x) for x in each.split(", ")]) for each in (asked, given))
    point, before = np.array([0, 0, 0.4]), given[0] * deg
    assert asked == pytest.approx(np.degrees(posture(right)(point, before)), abs=0.01)
    assert given == pytest.approx(np.degrees(low(point, before)), abs=0.01)
    assert not any("arctan2" in line for line in verdict.says)


def test_error_in_a_test_of_phases_is_said_to_be_in_the_test():
    def shapeless(windings):
        return bool((np.asarray(windings("wave", [1, 1, -1])) + np.ones((4, 4)) > 0).all())

    verdict = check("motor_synchronisation.3", shapeless)
    assert "the row before the first pulse is missing" in verdict.case
    assert verdict.says[0].startswith(
        "Your test has to return True or False; it raises ValueError: "
    )


def test_programs_missed_by_a_partial_test_are_named():
    space = {}
    exec(solution("motor_synchronisation.3"), space)
    whole = space["windings_are_right"]
    forward = check(
        "motor_synchronisation.3", lambda w: whole(lambda drive, signs: w(drive, abs(signs)))
    )
    assert not forward.holds
    only_wave = check(
        "motor_synchronisation.3", lambda w: len(np.asarray(w("wave", [1, 1, -1]))) == 4
    )
    assert only_wave.mistake.startswith("accepts: ")


def looking(rows):
    """A test of the magnetic fields in some rows; `rows` selects two or more of the row numbers."""
    signs = np.array([1] * 11 + [-1] * 21 + [1] * 3 + [-1, 1])

    def test(windings):
        for drive, step, on in (
            ("wave", 90, {1}),
            ("two-phase", 90, {2}),
            ("half-step", 45, {1, 2}),
        ):
            told = np.asarray(windings(drive, signs), dtype=float)
            if told.ndim != 2 or told.shape[1] != 4 or not np.isin(told, (0, 1)).all():
                return False
            seen = np.array(rows(np.arange(len(told))))
            if not {*told[seen].sum(axis=1)} <= on:
                return False
            field = told[seen] @ np.array([1, 1j, -1, -1j])
            if (abs(field) < 0.5).any():
                return False
            at = np.concatenate([[0], np.cumsum(signs)])[seen]
            if abs(field[1:] / field[:-1] * np.exp(-1j * deg * step * np.diff(at))).min() < 0.5:
                return False
            off = np.angle(field[1:] / field[:-1] * np.exp(-1j * deg * step * np.diff(at)))
            if abs(off).max() > 1e-6:
                return False
        return True

    return test


@pytest.mark.parametrize(
    ("rows", "name"),
    [
        (lambda k: [k[0], k[-1]], "right in the first and the last row"),
        (lambda k: k[:-1], "the last pulse is lost"),
        (lambda k: k[:15], "it stops halfway"),
    ],
)
def test_test_must_check_every_row(rows, name):
    verdict = check("motor_synchronisation.3", looking(rows))
    test = looking(rows)
    exercise = LAB.exercises["3"]
    named = {name: text for name, _, text in exercise.wrongs}
    accepted = [named[name], *(text for _, text in exercise.rights)]
    assert all(test(exercise.program(text)) for text in accepted)
    assert not verdict.holds and verdict.mistake.startswith("accepts: ")


def test_messages_about_drives_show_different_numbers_and_not_the_answer():
    own, q, gears = move("Ada")
    n = pulses(q, gears)
    high = drive(q, 9 * gears, frequencies(n, own["most"]))
    told = " ".join(check("motor_synchronisation.2", high, who="Ada").says)
    for gear in gears:
        assert f" {gear:.0f} " not in told
    slow = drive(q, gears, frequencies(n, 0.5 * own["most"]))
    told = " ".join(check("motor_synchronisation.2", slow, who="Ada").says)
    assert f"{n.max() / own['most']:.2f}" not in told
    fast = drive(q, gears, frequencies(n, 1.0001 * own["most"]))
    told = " ".join(check("motor_synchronisation.2", fast, who="Ada").says)
    runs, allowed = re.search(r"runs at (.*) pulses/s; at most (.*) are allowed\.$", told).groups()
    assert runs != allowed
    text = drive(q, gears, [1, 2, 3]) | {"gears": ["50", "50", "50"]}
    assert check("motor_synchronisation.2", text, who="Ada").mistake == "another kind or shape"


def lab_sources():
    [path] = NOTEBOOKS.glob("11_*.ipynb")
    stored = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return {cell["id"]: "".join(cell["source"]) for cell in stored}


def test_lab_view_of_a_cycle_says_whether_it_drifts():
    sources, space = lab_sources(), {}
    exec(sources["your-turn-stub-2"], space)
    exec(sources["your-turn-cycle"], space)
    assert space["my_title"].startswith("Write")
    _, q, gears = move("your name")
    rounded = np.rint(np.diff(q / deg * gears / 1.8, axis=0))
    assert drifts(q, gears).any()
    long = np.column_stack([(q[:, 0] + np.pi) % TURN - np.pi, q[:, 1:]])
    for pulses_, told in (
        (sent(q, gears), "nothing drifts"),
        (rounded, "After 200 of your cycles"),
        (sent(long, gears), "takes the long way"),
        (np.zeros((3, 3)), "miss a point"),
        ([1, 2, 3], "Write"),
    ):
        space["my_drive"] = {"gears": gears, "pulses": pulses_, "frequencies": [1, 1, 1]}
        exec(sources["your-turn-cycle"], space)
        assert told in space["my_title"], (told, space["my_title"])
    space["my_drive"]["pulses"] = rounded
    exec(sources["your-turn-cycle"], space)
    off = float(re.search(r"is (\S+) mm from start", space["my_title"])[1])
    later = np.rint(q[0] / deg * gears / 1.8) + 200 * drifts(q, gears)
    ends = LOADER.fk(np.stack([later / (gears / 1.8) * deg, q[0]])).translation
    assert off == pytest.approx(1000 * np.linalg.norm(ends[1] - ends[0]), abs=0.06)


def test_right_answer_moves_the_gripper_in_the_lab_view_to_the_goal():
    sources = lab_sources()
    space = {}
    exec(sources["your-turn-stub-1"], space)
    exec(sources["your-turn-player"], space)
    assert space["own_title"].startswith("Write")
    for answer, told in (
        (lambda point, before: np.full(3, np.nan), "Three angles put the gripper at the goal"),
        (lambda point, before: [1, 2], "Three angles put the gripper at the goal"),
        (lambda point, before: posture(right)(point, before) + np.ones(3), "Your posture misses"),
        (posture(lambda x, y, b: math.atan2(y, x)), "joint 1 takes the long way"),
    ):
        space["next_posture"] = answer
        exec(sources["your-turn-player"], space)
        assert told in space["own_title"]
    space["next_posture"] = posture(right)
    exec(sources["your-turn-player"], space)
    arrived = space["own_arm"].fk(space["own_way"][-1]).translation
    assert arrived == pytest.approx(space["own_goal"], abs=1e-9)
    assert abs(space["own_end"][0] - space["own_q"][0]) < np.pi
    assert abs(space["own_end"][0]) > np.pi, "the turn does not cross 180 degrees"
