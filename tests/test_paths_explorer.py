"""The paths explorer in a real browser: its moves match robokin.jobs.steppers, its lengths match
independent measurements, and the reader can drag the goal.
"""

import re

import numpy as np
import pytest
import test_explorers
import test_twin
from axe_playwright_python.sync_playwright import Axe

from robokin import IRB140, deg, loader_arm, mm
from robokin.jobs.steppers import (
    counts,
    joint_values,
    out_of_reach,
    station_postures,
    straight,
    synchronised,
    unsynchronised,
)
from robokin.show import paths_explorer

context, opened, twin = test_explorers.context, test_explorers.opened, test_twin.twin  # fixtures
A, B = 0.45, 0.30
LOADER = loader_arm(A, B)
START, GOAL, RATIO = np.array([600, -350, 50]) * mm, np.array([50, 250, 350]) * mm, [10, 40, 40]


def view(goal=GOAL, ratio=RATIO):
    return paths_explorer(LOADER, START, goal, ratio)


def gripper(q):
    """Return the position of the gripper, computed from two rods of lengths A and B that meet at
    the angle beta.
    """
    alpha, gamma, beta = np.moveaxis(q, -1, 0)
    ahead = A * np.cos(gamma) + B * np.cos(gamma + beta - np.pi)
    height = A * np.sin(gamma) + B * np.sin(gamma + beta - np.pi)
    return np.stack([ahead * np.cos(alpha), ahead * np.sin(alpha), height], axis=-1)


def measured(move, ratio, goal):
    """Return [duration, length, greatest distance from the line, pulses] of a move, and the motors
    that reverse.
    """
    t = np.union1d(np.linspace(0, move.duration, 1501), move.t)
    path = gripper(joint_values(move(t), ratio))
    way = goal - START
    share = ((path - START) @ way / (way @ way)).clip(0, 1)
    off = np.linalg.norm(path - START - share[:, None] * way, axis=-1).max()
    length = np.linalg.norm(np.diff(path, axis=0), axis=-1).sum()
    signs = [signs for _, signs in move.pulses()]
    reverse = [j + 1 for j, each in enumerate(signs) if np.ptp([*each, *each[:1]] or [0]) > 0]
    return [move.duration, length, off, sum(map(len, signs))], reverse


def ways(goal, ratio=RATIO):
    """Return a dict that maps the letters of the paths to the results of `measured`."""
    if out_of_reach(LOADER, goal):
        return {}
    stations = counts(station_postures(LOADER, [START, goal]), ratio)
    found = {
        "a": measured(unsynchronised(*stations), ratio, goal),
        "d": measured(synchronised(*stations), ratio, goal),
    }
    try:
        line = measured(straight(LOADER, START, goal, ratio), ratio, goal)
    except ValueError:
        return found
    return found | {"c" if line[1] else "b": line}


# --- Numbers --------------------------------------------------------------------------------------


def test_page_moves_match_python_for_a_thousand_goals(twin):
    rng = np.random.default_rng(11)
    goals = rng.uniform([-0.75, -0.75, -0.05], [0.75, 0.75, 0.75], (1000, 3))
    for ratio in (RATIO, [40, 20, 20]):
        some = goals[: 1000 if ratio == RATIO else 60]
        got = twin.page.evaluate(
            """async ([data, goals]) => {
              const {waysOf} = await import("/paths_explorer.js");
              return goals.map(goal => waysOf(data, goal).ways.map(way => way && [
                [way.t.at(-1), way.length, way.off, way.sent], way.reversing.map(j => j + 1),
              ]));
            }""",
            [view(ratio=ratio).data, some.tolist()],
        )
        letters = []
        for goal, rows in zip(some, got, strict=True):
            wanted = ways(goal, ratio)
            assert {k for k, row in zip("abcd", rows, strict=True) if row} == set(wanted)
            letters.append("".join(sorted(wanted)))
            for letter, (numbers, motors) in wanted.items():
                found, reversing = rows["abcd".index(letter)]
                assert reversing == motors
                assert found[0] == pytest.approx(numbers[0], abs=1e-9) and found[3] == numbers[3]
                assert found[1:3] == pytest.approx(numbers[1:3], abs=2e-4)
        assert set(letters) == {"", "abd", "acd", "ad"}, "a kind of goal does not occur"


def test_motors_reverse_at_the_places_that_geometry_gives(twin):
    """Beta depends only on the distance from joint 2, so motor 3 reverses at the foot of the
    perpendicular on the line. Gamma comes from the two rods, and alpha never turns back on a line.
    """
    rng = np.random.default_rng(12)
    goals = [GOAL, *rng.uniform([-0.6, -0.6, 0], [0.6, 0.6, 0.6], (300, 3))]
    rows = twin.page.evaluate(
        """async ([data, goals]) => {
          const {waysOf} = await import("/paths_explorer.js");
          return goals.map(goal => waysOf(data, goal).ways.map(way => way?.turned ?? []));
        }""",
        [view().data, np.array(goals).tolist()],
    )
    share, met = np.linspace(0, 1, 20001), []
    for goal, (a, b, c, d) in zip(goals, rows, strict=True):
        assert not (a or b or d), "only path c has reversals"
        line = START + share[:, None] * (goal - START)
        x, y, z = line.T
        h = np.linalg.norm(line, axis=1)
        inside = ((A**2 - B**2 + h**2) / (2 * A * h)).clip(-1, 1)
        gamma = np.arccos(inside) + np.arctan2(z, np.hypot(x, y))
        extremes = share[1:-1][np.diff(gamma)[1:] * np.diff(gamma)[:-1] < 0]
        for turned in c:
            at = np.linalg.norm(turned["at"] - START) / np.linalg.norm(goal - START)
            foot = -START @ (goal - START) / ((goal - START) @ (goal - START))
            expected = {1: extremes, 2: [foot]}[turned["motor"]]
            assert min(abs(np.array(expected) - at)) < 2e-3
            met.append(turned["motor"])
    assert [turned["motor"] for turned in rows[0][2]] == [1, 2]
    assert met.count(1) > 20 and met.count(2) > 20


def told(seen):
    """Return the table as a dict that maps letters to numbers, and the motors that reverse."""
    rows = {row[0][0]: row[1:] for row in seen.rows}
    return {
        letter: ([float(x) for x in row[:4]], [int(x) for x in re.findall(r"\d", row[4])])
        for letter, row in rows.items()
        if row[0] != "\u2013"
    }


def shows(shown):
    """Assert that the table and the sentences match Python for the displayed goal."""
    seen = shown.look()
    goal = np.array([seen.boxes[letter] for letter in "xyz"]) * mm
    exact = re.search(r", \[([^\]]*)\]\]\) \* mm", seen.code)
    goal = np.array([float(x) for x in exact[1].split(",")]) * mm
    wanted, found = ways(goal), told(seen)
    assert set(found) == set(wanted)
    for letter, (numbers, motors) in wanted.items():
        time, length, off, sent = numbers
        assert found[letter][0] == pytest.approx(
            [time, length / mm, off / mm, sent], rel=0, abs=0.51
        )
        assert found[letter][0][0] == pytest.approx(time, abs=0.0051)
        assert found[letter][0][2] == pytest.approx(off / mm, abs=0.06)
        assert found[letter][1] == motors
    for letter in wanted:
        [heard] = re.findall(rf" {letter} is (\d+) mm long\.", seen.scene)
        assert int(heard) == found[letter][0][1]
    assert seen.says in seen.scene
    if "a" in wanted:
        same = f"a and d take {wanted['a'][0][0]:.2f} s."
        assert seen.says.startswith(same) and wanted["a"][0][0] == wanted["d"][0][0]
        space = shown.code(seen) if len(wanted) == 3 else {}
        for name, letter in (("a", "a"), ("d", "d")) if space else ():
            assert space[name].duration == pytest.approx(wanted[letter][0][0], abs=1e-9)
    else:
        assert seen.says.startswith("There is no path: ")
    return seen, wanted


def test_sentences_name_the_straight_path_or_explain_why_there_is_none(opened):
    shown = opened(view(), LOADER)
    _, first = shows(shown)
    assert first["c"][1] == [2, 3]

    def move(*place):
        for letter, value in zip("xyz", place, strict=True):
            shown.type(letter, value)
        return shows(shown)

    seen, _ = move(150, -250, 300)
    assert seen.says.endswith("no motor reverses, so it is path b.")
    seen, found = move(400, 200, 100)
    who = re.search(r": (motors?) (.*) reverses?, so it is path c\.", seen.says)
    assert who[2] == " and ".join(map(str, found["c"][1]))
    assert who[1] == "motors" * (len(found["c"][1]) > 1) or "motor"
    seen, _ = move(-500, 300, 100)
    share, gap = re.search(
        r"at (\d+)\xa0% of it, the point is (\S+) mm too near", seen.says
    ).groups()
    middle = START + int(share) / 100 * (np.array([-500, 300, 100]) * mm - START)
    assert np.linalg.norm(middle) / mm == pytest.approx(150 - float(gap), abs=5)
    assert float(gap) > 10
    for place, why in (
        ((50, 20, 10), "95.2 mm too near to joint 2"),
        ((600, 600, 100), "too far"),
        ((400, 100, -20), "the goal is under the floor"),
    ):
        seen, found = move(*place)
        assert not found and why.split("too far")[0] in seen.says
        assert "no solution" in seen.words[0]
    assert np.hypot(np.hypot(50, 20), 10) == pytest.approx(150 - 95.2, abs=0.06)


# --- Input ----------------------------------------------------------------------------------------


def test_dragging_the_goal_changes_paths_and_numbers(opened):
    shown = opened(view(), LOADER)
    start = np.array(shown.look().handles["free"]["at"])
    found = []
    shown.drag(
        "free",
        *(start + step for step in ([0, 20], [20, 60], [60, 90])),
        each=lambda *_: found.append(shows(shown)[1]["d"][0]),
    )
    assert len({tuple(each) for each in found}) == 3
    shown.press("free", "Home")
    seen = shown.look()
    assert [seen.boxes[x] for x in "xyz"] == [50, 250, 350]
    shown.press("y", "ArrowUp", "Shift+ArrowUp", "ArrowDown")
    assert shown.look().boxes["y"] == pytest.approx(300, abs=1e-6)
    shows(shown)


def test_arm_follows_the_chosen_path_and_the_clock(opened):
    shown = opened(view(), LOADER)
    pictures = [shown.look().pixels]
    assert shown.look().chosen == 3
    for row in ("a", "c", "b", "d"):
        shown.rk.get_by_role("button", name=re.compile(f"^{row}:")).click()
        seen = shown.look()
        assert seen.chosen == "abcd".index("c" if row == "b" else row)
        pictures.append(seen.pixels)
        named = [word for word in seen.words[0].split("|") if word.endswith("reverses")]
        assert named == ["motor 2 reverses", "motor 3 reverses"] * (row in "cb")
    assert len({tuple(each) for each in pictures}) == 3, "the arm does not follow the chosen path"
    shown.slide("time", 400)
    seen = shown.look()
    assert float(seen.told["time"].removesuffix(" s")) == pytest.approx(
        ways(GOAL)["c"][0][0], abs=0.01
    )
    assert {"a", "c", "d", "start", "goal"} <= set(seen.words[0].split("|"))
    assert seen.pixels not in pictures


def test_first_play_begins_at_the_start(opened):
    shown = opened(view(), LOADER)
    now = lambda: float(shown.look().told["time"].removesuffix(" s"))  # noqa: E731
    opening = now()
    shown.page.evaluate(
        """async () => {
          const button = document.querySelector(".rk-clock button");
          button.click();
          await new Promise(requestAnimationFrame);
          button.click();
        }"""
    )
    assert now() < opening, "a frame adds at most half a second"
    assert opening > 1.5


def test_goal_at_the_start_is_named(opened):
    shown = opened(view(), LOADER)
    for letter, value in zip("xyz", START / mm, strict=True):
        shown.type(letter, value)
    assert shown.look().says == "The goal is less than one pulse from the start."


def test_view_has_no_accessibility_violations(opened):
    shown = opened(view(), LOADER)
    found = Axe().run(shown.page, context=".rk")
    assert not found.response["violations"], found.generate_report()


# --- Invalid calls --------------------------------------------------------------------------------


def test_summary_states_the_times_and_lengths_of_the_paths():
    made = view()
    for letter, ((time, length, *_), _) in ways(GOAL).items():
        assert f"{letter} {time:.2f} s and {length / mm:.0f} mm" in repr(made)
    assert made.still.alt == made.data["alt"]
    other = paths_explorer(LOADER, START, (0.15, -0.25, 0.3), 20)
    assert " b " in repr(other) and other.data["per_degree"] == [20, 20, 20]


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (dict(arm=IRB140), TypeError, "arm: wanted"),
        (dict(start=(0.05, 0.02, 0.01)), ValueError, "start: wanted a point in reach.*too near"),
        (dict(goal=(0.4, 0.1, -0.2)), ValueError, "goal: wanted a point in reach.*floor"),
        (dict(goal=[GOAL, GOAL]), ValueError, r"goal: wanted one point \(3,\)"),
        (dict(goal=(-0.5, 0.3, 0.1)), ValueError, "start and goal: wanted a line inside"),
        (dict(per_degree=(10, 0, 40)), ValueError, "per_degree: wanted positive"),
        (dict(per_degree=(10, 40)), ValueError, "per_degree: wanted one number or three"),
    ],
)
def test_invalid_calls_are_refused(call, error, words):
    right = dict(arm=LOADER, start=START, goal=GOAL, per_degree=RATIO)
    with pytest.raises(error, match=words):
        paths_explorer(**(right | call))


def test_joint_1_takes_the_shortest_turn(twin):
    """The start and the goal are on different sides of the direction of 180 degrees, across which
    joint 1 moves the short way.
    """
    start, goal = np.array([[-500, 100, 100], [-400, -200, 200]]) * mm
    data = paths_explorer(LOADER, start, goal, RATIO).data
    q = twin.page.evaluate(
        """async data => {
          const {postures} = await import("/stepper_moves.js");
          return postures(data, [data.start, data.goal, [0, 0, 0.5]]);
        }""",
        data,
    )
    wanted = station_postures(LOADER, [start, goal, (0, 0, 0.5)])
    assert np.allclose(q, wanted, rtol=0, atol=1e-12)
    assert wanted[1, 0] > 180 * deg and wanted[2, 0] == wanted[1, 0]
