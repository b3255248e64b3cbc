"""The exercise and the predictions of lab 14: lines that miss no object pass, and mistakes in other
lines are named.
"""

import math
import re

import numpy as np
import pytest

from robokin.course import book, check, variant
from robokin.course.questions import filled

LAB = book.lab("conveyor")
CORNER, BIN = (0.35, -0.45), (0.15, -0.45)
ENDS, SPEED = ("first_come_in", "first_come_out"), "one_arm_speed"
Y = np.linspace(-0.4, 0.4, 161)


def joints(x, y, z):
    """Return the joint values of the arm, computed from the triangle of its links."""
    l1, l2, rho, d = 0.5, 0.4, math.hypot(x, y), math.hypot(x, y, z)
    beta = math.acos((l1**2 + d**2 - l2**2) / (2 * l1 * d))
    q3 = math.asin((l1**2 + l2**2 - d**2) / (2 * l1 * l2))
    return math.atan2(y, x), math.atan2(rho, z) - beta, q3


def ways(place):
    stand = joints(*place, 0.25)
    turns = [np.subtract(joints(0.6, y, 0.05), stand) for y in Y]
    return 15 / 8 * abs(np.array(turns)).max(axis=-1) / 2


def missed(v, gap, spread, seed, place, arms, first_come=False):
    """Return how many objects this number of arms misses, computed without the package."""
    steps = np.random.default_rng(seed).permutation(np.linspace(-1, 1, 200))
    left, takes = np.cumsum(gap * (1 + spread * steps)) / v, ways(place)
    for k in range(arms):
        # each window begins where the one before it ends; all arms are free at time 0
        free, rest = 0.0, [*(left + k * (Y[-1] - Y[0]) / v)]
        while True:
            at = np.array(rest)[:, None] + (Y - Y[0]) / v
            in_time = at >= free + takes
            if not len(rest) or not in_time.any():
                break
            first = in_time.argmax(axis=-1)
            back = np.where(
                in_time.any(axis=-1), at[range(len(rest)), first] + takes[first], np.inf
            )
            pick = int(np.isfinite(back).argmax() if first_come else back.argmin())
            free = back[pick]
            del rest[pick]
        left = np.array(rest) - k * (Y[-1] - Y[0]) / v
        if not len(left):
            break
    return len(left)


def last_speed(own, place, seeds=None, **rule):
    """Return the speed in mm/s up to which one arm misses none, in steps of 5 mm/s."""
    speed, belt = 5, (own["gap"], own["spread"])
    while not any(
        missed((speed + 5) / 1000, *belt, seed, place, **{"arms": 1} | rule)
        for seed in seeds or own["seeds"]
    ):
        speed += 5
    return speed


def line(own, place, arms, least=None):
    bound = math.ceil(2 * ways(place).min() * own["v"] / own["gap"])
    numbers = own["v"], own["gap"], own["spread"]
    lost = sum(missed(*numbers, seed, place, bound) for seed in own["seeds"])
    late = [
        sum(missed(*numbers, seed, (place[0], y), arms, first_come=True) for seed in own["seeds"])
        for y in (-0.45, 0.45)
    ]
    least = bound if least is None else least
    counts = {"least": least, "missed": lost, "arms": arms, SPEED: last_speed(own, place)}
    return {"bin": list(place)} | counts | dict(zip(ENDS, late, strict=True))


@pytest.mark.parametrize("who", [f"student {k}" for k in range(8)])
def test_no_belt_works_with_the_bin_of_the_lab(who):
    own = variant("conveyor", who)
    numbers = own["v"], own["gap"], own["spread"]
    seeds, most = own["seeds"], own["most"]
    assert len(set(seeds)) == 3 and check("conveyor.1", line(own, CORNER, most), who=who).holds
    assert line(own, CORNER, most)["least"] < most, "the bound is enough"
    assert line(own, CORNER, most)["missed"] > 0
    assert not any(missed(*numbers, seed, CORNER, most) for seed in seeds)
    assert any(missed(*numbers, seed, CORNER, most - 1) for seed in seeds)
    assert any(missed(*numbers, seed, BIN, most) for seed in seeds)
    assert check("conveyor.1", line(own, BIN, most), who=who).mistake in (
        "too few arms",
        "the bound is not enough",
    )


def test_mistakes_in_lines_are_named():
    own = variant("conveyor", "Ada")
    most, right = own["most"], line(own, CORNER, own["most"])
    assert check("conveyor.1", right, who="Ada").holds
    near, far = (right[end] for end in ENDS)
    assert near > far
    load = 2 * ways(CORNER).min() * own["v"] / own["gap"]
    numbers = own["v"], own["gap"], own["spread"]
    first = missed(*numbers, own["seeds"][0], CORNER, right["least"])
    assert 0 < first < right["missed"]
    wrong = {
        "rounded down": right | {"least": math.floor(load)},
        "another bound": right | {"least": 30},
        "one stream of three": right | {"missed": first},
        "taken for missed": right | {"missed": 600 - right["missed"]},
        "another number of missed objects": right | {"missed": right["missed"] + 1},
        "another number under first come": right | {ENDS[0]: near + 1},
        "first come, taken for missed": right | {ENDS[0]: 600 - near},
        "the two ends swapped": right | {ENDS[0]: far, ENDS[1]: near},
        "more arms than allowed": line(own, CORNER, most + 1),
        "too few arms": line(own, BIN, 1),  # more than one arm would be busy all the time
        "no number of arms for a line": right | {"arms": 0},
        "millimetres for metres": right | {"bin": [350, -450]},
        "the bin is somewhere else": right | {"bin": [0.5, -0.45]},
        "another kind or shape": right | {"arms": 2.5},
    }
    for name, answer in wrong.items():
        verdict = check("conveyor.1", answer, who="Ada")
        assert verdict.mistake == name and verdict.points < 1, (name, verdict)
    for changed in (
        {"bin": [0.35]}, {"bin": "corner"}, {"least": "2"}, {ENDS[0]: [near, far]},
        {ENDS[1]: 0.5}, {ENDS[1]: -1},
    ):  # fmt: skip
        verdict = check("conveyor.1", right | changed, who="Ada")
        assert verdict.mistake == "another kind or shape"
    assert not check("conveyor.1", right | {"arms": ...}, who="Ada").answered


@pytest.mark.parametrize(("who", "place"), [("Ada", (0.35, 0.45)), ("student 11", CORNER)])
def test_mistakes_in_the_speed_of_one_arm_are_named(who, place):
    own = variant("conveyor", who)
    right = line(own, place, own["most"])
    speed = right[SPEED]
    average = own["gap"] / (2 * ways(place).min()) * 1000
    fastest = max(last_speed(own, place, [seed]) for seed in own["seeds"])
    wrong = {
        "only the average": math.floor(average / 5) * 5,
        "the first speed with a miss": speed + 5,
        "the speed of one stream": fastest,
        "the speed of all arms": last_speed(own, place, arms=own["most"]),
        "the bin of the lab": last_speed(own, BIN),
        "the speed of the belt": round(1000 * own["v"]),
        "another speed of one arm": speed - 10,
    }
    assert wrong["only the average"] > fastest > speed, "uneven gaps cost speed in every stream"
    for name, number in wrong.items():
        verdict = check("conveyor.1", right | {SPEED: number}, who=who)
        assert name in verdict.mistake and not verdict.holds, (name, verdict)
        assert verdict.says[0].startswith(f"{SPEED}: At ")
        lost = [missed(number / 1000, own["gap"], own["spread"], seed, place, 1)
                for seed in own["seeds"]]  # fmt: skip
        told = f"At {number} mm/s, one arm with your bin misses {sum(lost)} of the 600 objects."
        assert (told in verdict.says[0]) == any(lost)
        if not any(lost):
            assert f"At {number + 5} mm/s, one arm with your bin misses none" in verdict.says[0]
    for number in (0, speed + 2):
        verdict = check("conveyor.1", right | {SPEED: number}, who=who)
        assert f"Wanted a multiple of 5 mm/s, got {number}." in verdict.says[0]
    verdict = check("conveyor.1", right | {SPEED: speed / 1000}, who=who)
    assert "one_arm_speed: wanted a whole number of mm/s" in verdict.says[0]
    says = check("conveyor.1", right, who=who).says[2]
    assert f"none up to {speed} mm/s. The average alone would allow {average:.0f} mm/s" in says


def test_first_come_is_faster_for_one_arm_of_a_students_belt():
    """Its speed is named if it is given instead."""
    own, who = variant("conveyor", "student 8"), "student 8"
    speed = last_speed(own, CORNER, first_come=True)
    right = line(own, CORNER, own["most"])
    assert speed != right[SPEED]
    verdict = check("conveyor.1", right | {SPEED: speed}, who=who)
    assert "the speed under first come" in verdict.mistake


def test_solution_has_its_bin_where_the_objects_go_out_if_it_can():
    """For some belts, that end needs one arm more than the other; the solution then changes it."""
    solution = book.find("conveyor.1", "exercises").solution
    found = {}
    for who in ("your name", "Ada", "student 11"):
        space = {}
        exec(solution.replace('"your name"', repr(who)), space)
        assert check("conveyor.1", space["my_line"], who=who).holds
        own, out = space["own"], (0.35, 0.45)
        numbers = own["v"], own["gap"], own["spread"]
        enough = not any(missed(*numbers, seed, out, own["most"]) for seed in own["seeds"])
        found[who] = space["my_line"]["bin"][1]
        assert found[who] == (0.45 if enough else -0.45)
    assert set(found.values()) == {0.45, -0.45}


def test_mistakes_that_give_the_same_number_are_all_named():
    """The time of one way gives a bound of one arm, and so does rounding down."""
    own, who = variant("conveyor", "Anna Petrova"), "Anna Petrova"
    c = 2 * ways(CORNER).min()
    load = c * own["v"] / own["gap"]
    assert math.floor(load) == math.ceil(load / 2) == 1 and math.ceil(load) == 2
    verdict = check("conveyor.1", line(own, CORNER, own["most"], least=1), who=who)
    assert verdict.mistake == "rounded down or the time of one way"
    assert "More than one mistake gives 1." in verdict.says[0]
    assert "You rounded" in verdict.says[0] and "You used the time of one way." in verdict.says[0]
    # a wrong bound is one mistake: what so many arms miss follows from it
    numbers = own["v"], own["gap"], own["spread"]
    lost = sum(missed(*numbers, seed, CORNER, 1) for seed in own["seeds"])
    for change in ({}, {"missed": lost}):
        follows = line(own, CORNER, own["most"], least=1) | change
        verdict = check("conveyor.1", follows, who=who)
        assert verdict.mistake == "rounded down or the time of one way"
        assert len(verdict.says) == 1


@pytest.mark.parametrize("who", ["your name", "Anna Petrova", "Chen Li"])
def test_a_count_that_is_off_by_one_is_refused(who):
    own = variant("conveyor", who)
    right = line(own, CORNER, own["most"])
    assert check("conveyor.1", right, who=who).holds
    near, far = (right[end] for end in ENDS)
    for more in (-1, 1, 9):
        changes = {"missed": right["missed"] + more, ENDS[0]: near + more, ENDS[1]: far + abs(more)}
        for change in ({key: value} for key, value in changes.items()):
            assert not check("conveyor.1", right | change, who=who).holds, change


def test_mistakes_under_first_come_are_named():
    own, who = variant("conveyor", "Anna Petrova"), "Anna Petrova"
    numbers, right = (own["v"], own["gap"], own["spread"]), line(own, CORNER, own["most"])
    counts = [
        [missed(*numbers, seed, CORNER, arms, first_come=True) for seed in own["seeds"]]
        for arms in (right["least"], right["arms"])
    ]
    wrong = {
        "back soonest instead of first come": 0,
        "first come by another number of arms": sum(counts[0]),
        "first come, one stream of three": counts[1][0],
    }
    assert len({*wrong.values(), sum(counts[1])}) == 4
    for name, number in wrong.items():
        verdict = check("conveyor.1", right | {ENDS[0]: number}, who=who)
        assert verdict.mistake == name and verdict.says[0].startswith("first_come_in: "), name
    # an answer with too many arms, which counts with the right number of them
    more = line(own, CORNER, right["arms"] + 1)
    assert more[ENDS[0]] != right[ENDS[0]]
    verdict = check("conveyor.1", more | {end: right[end] for end in ENDS}, who=who)
    assert verdict.mistake == "first come by another number of arms"
    # a bin that is not at an end has a count of its own
    own_bin = (0.35, -0.3)
    answer = line(own, own_bin, right["arms"])
    count = sum(
        missed(*numbers, seed, own_bin, right["arms"], first_come=True) for seed in own["seeds"]
    )
    for end in ENDS:
        assert count != answer[end]
        verdict = check("conveyor.1", answer | {end: count}, who=who)
        assert verdict.mistake == "your own bin instead of one at the end"
        assert verdict.says[0].startswith(f"{end}: ")


@pytest.mark.parametrize("who", ["Ada L.", "Anna Petrova", "student 1"])
def test_every_correct_answer_shows_that_the_place_of_the_bin_decides(who):
    """Also with a bin for which the bound is enough and first come misses none."""
    own = variant("conveyor", who)
    for place in (CORNER, (0.35, 0.0), (0.35, 0.45)):
        answer = line(own, place, own["most"])
        verdict = check("conveyor.1", answer, who=who)
        near, far = (answer[end] for end in ENDS)
        assert verdict.holds and near > 10 * (far + 1), (place, verdict)
        enough = "not enough" if answer["missed"] else "enough"
        assert f"the bound of {answer['least']} is {enough} for these" in verdict.says[1]
        assert (
            f"{near} objects with the bin where the objects come in, and {far} with"
            in (verdict.says[3])
        )


def test_reply_says_why_the_rule_makes_no_difference():
    who = "Student 7"
    own = variant("conveyor", who)
    for place in (CORNER, (0.35, 0.0), (0.35, 0.45)):
        answer = line(own, place, own["most"])
        assert [answer[end] for end in ENDS] == [0, 0]
        verdict = check("conveyor.1", answer, who=who)
        load = 2 * ways(CORNER).min() * own["v"] / own["gap"]
        assert verdict.holds and load < 0.65 * own["most"], "the arms are idle a third of the time"
        assert "the load is too small for the rule to matter" in verdict.says[3]
        assert f"c v / g is only {load:.2f}, so the {own['most']} arms" in verdict.says[3]


def test_answer_of_the_old_form_is_told_the_new_keys():
    """Older copies of the lab asked for two numbers under one key."""
    own = variant("conveyor", "Ada")
    answer = line(own, CORNER, own["most"])
    old = {key: n for key, n in answer.items() if key not in ENDS} | {"first_come": [20, 0]}
    verdict = check("conveyor.1", old, who="Ada")
    assert verdict.mistake == "another kind or shape" and "y = −0.45 m" in verdict.says[0]
    assert all(f'"{end}"' in verdict.says[0] for end in ENDS)
    newer = {key: n for key, n in answer.items() if key != SPEED}
    verdict = check("conveyor.1", newer, who="Ada")
    assert verdict.mistake == "another kind or shape"
    assert f'also wanted "{SPEED}", the belt speed in mm/s' in verdict.says[0]


@pytest.mark.parametrize(("place", "arms"), [(CORNER, 1), (BIN, 1), (BIN, 2), (BIN, 3)])
def test_too_few_arms_are_told_what_they_miss(place, arms):
    own = variant("conveyor", "Ada")
    numbers = own["v"], own["gap"], own["spread"]
    lost = {seed: missed(*numbers, seed, place, arms) for seed in own["seeds"]}
    verdict = check("conveyor.1", line(own, place, arms), who="Ada")
    found = re.findall(r"miss(?:es)? (\d+) objects? of the stream with seed (\d+)\.", repr(verdict))
    if not any(lost.values()):
        assert not found
    else:
        [(count, seed)] = found
        assert int(count) == lost[int(seed)] == max(lost.values())
        assert ("one arm misses" if arms == 1 else f"{arms} arms miss ") in repr(verdict)


def test_too_many_arms_at_a_good_bin_are_named():
    """The place of the bin is not the mistake."""
    own = variant("conveyor", "Ada L.")
    verdict = check("conveyor.1", line(own, (0.35, 0.45), own["most"] + 2), who="Ada L.")
    assert verdict.mistake == "more arms than allowed"
    assert "fewer arms already miss none" in verdict.says[0]
    assert "other places" not in repr(verdict)
    bad = line(own, (0.15, -0.45), own["most"] + 2)
    assert "Try other places for the bin" in check("conveyor.1", bad, who="Ada L.").says[0]


def test_numbers_used_in_the_predictions_are_correct():
    c = 2 * ways(BIN).min()
    _, options, right = filled(LAB.predictions["p1"])
    assert float(options[right].text) == math.ceil(c * 0.25 / 0.15) == 3
    [slip] = [each for each in options if "mm/s by m" in each.reason]
    assert float(slip.text) == pytest.approx(c * 250 / 0.15, abs=0.5)
    _, options, right = filled(LAB.predictions["p2"])
    soon = 200 - missed(0.15, 0.15, 0.5, 8, BIN, 1)
    first, free, done = np.cumsum(0.15 * (1 + 0.5 * np.random.default_rng(8).permutation(
        np.linspace(-1, 1, 200)))) / 0.15, 0.0, 0  # fmt: skip
    for arrival in first:  # the objects in the order in which they come
        at = arrival + (Y - Y[0]) / 0.15
        in_time = np.flatnonzero(at >= free + ways(BIN))
        if len(in_time):
            free, done = at[in_time[0]] + ways(BIN)[in_time[0]], done + 1
    assert (
        options[right].reason.startswith(f"It takes {soon} instead of {done}. ") and soon > 2 * done
    )
    lost = {v: missed(v / 1000, 0.15, 0.5, 8, BIN, 1) for v in (85, 90, 95)}
    _, options, right = filled(LAB.predictions["p9"])
    assert lost[85] == lost[90] == 0 < lost[95] and "90 mm/s" in options[right].text
    facts = LAB.module("predictions")["p9"]()
    assert (facts["even"], facts["uneven"]) == (120, 90) and facts["rule"] > facts["even"]
    spreads = {"even_fast": 0, "uneven_fast": 0.5}
    assert facts["fast"] == 140
    for name, spread in spreads.items():
        assert facts[name] == missed(0.14, 0.15, spread, 8, BIN, 1)
    # the range over other orders of the same gaps
    assert (facts["least"], facts["greatest"]) == (80, 90)
    assert facts["first"] == 95


def test_four_arms_that_serve_in_order_take_what_the_prediction_says():
    """The objects are evenly spaced; each arm gets what the arms before it let pass."""
    facts, c = LAB.module("predictions")["p3"](), 2 * ways(BIN).min()
    left, takes, costs = 0.15 * np.arange(1, 201), [], []
    while len(left):
        free, spots, rest = 0.0, [], []
        for arrival in left / 0.2:
            at = arrival + (Y - Y[0]) / 0.2
            in_time = np.flatnonzero(at >= free + ways(BIN) - 1e-9)
            if len(in_time):
                free = at[in_time[0]] + ways(BIN)[in_time[0]]
                spots.append(in_time[0])
            else:
                rest.append(arrival * 0.2)
        left = np.array(rest)
        takes.append(len(spots))
        costs.append(2 * ways(BIN)[spots].mean())
    assert facts["takes"] == takes == [50, 50, 49, 51] and facts["arms"] == 4
    assert facts["costs"] == pytest.approx(costs) and min(costs[:3]) > 2 * c
    assert facts["gets"] == [200, 150, 100, 51] and costs[3] == pytest.approx(c)
    assert facts["missed_by_two"] == 100 and facts["missed_by_three"] == 51
    assert sum(facts["soonest"]) == 200 and facts["least"] == 2


@pytest.mark.parametrize("who", ["your name", "Ada", "student 11"])
def test_numbers_of_another_bin_are_recognised(who):
    """Of a bin at an end of the window, or of the lab's bin; one wrong number has its own name."""
    own = variant("conveyor", who)
    for old, new in (((0.35, 0.45), BIN), (CORNER, (0.3, 0.0)), ((0.15, 0.45), (0.35, 0.45))):
        right = line(own, old, own["most"])
        verdict = check("conveyor.1", right | {"bin": list(new)}, who=who)
        assert verdict.mistake == "the numbers of another bin" and verdict.points < 1
        x, y = (f"{each:g}".replace("-", "−") for each in old)
        said = f"The counts and the speed fit the bin [{x}, {y}] instead. You may have changed"
        assert said in verdict.says[0] and len(verdict.says) == 1
        verdict = check("conveyor.1", right | {"bin": list(new), SPEED: 5}, who=who)
        assert not verdict.holds and "another bin" not in verdict.mistake
    verdict = check("conveyor.1", line(own, BIN, own["most"] + 1), who=who)
    assert "another bin" not in verdict.mistake


def test_too_few_arms_are_one_mistake():
    """The counts under first come may be those of enough arms."""
    for who in ("Ada", "Anna Petrova"):
        own = variant("conveyor", who)
        right = line(own, CORNER, own["most"])
        verdict = check("conveyor.1", right | {"arms": right["least"]}, who=who)
        assert verdict.mistake == "the bound is not enough" and len(verdict.says) == 1
        follows = line(own, CORNER, right["least"])
        verdict = check("conveyor.1", follows, who=who)
        assert verdict.mistake == "the bound is not enough" and len(verdict.says) == 1
        both = right | {"arms": right["least"], ENDS[0]: right[ENDS[0]] + 1}
        assert len(check("conveyor.1", both, who=who).says) == 2


def test_reply_to_there_and_back_counted_twice_is_correct():
    _, options, _ = filled(LAB.predictions["p1"])
    replies = {float(each.text): each for each in options}
    assert math.ceil(2 * 2 * ways(BIN).min() * 0.25 / 0.15) == 5
    assert f"{2 * ways(BIN).min():.2f} s already includes the way back." in replies[5].reason
    assert replies[5].confusion == "you counted there and back twice"
