"""Statements of labs 07 to 13, checked by a second calculation: each test reads the number from its
cell or prediction, so that text and number cannot diverge.
"""

import functools
import inspect
import json
import math
import re
from itertools import pairwise

import numpy as np
import pytest
from conftest import NOTEBOOKS
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from robokin import PUMA560, Quaternion, Transform, deg, loader_arm, mm, three_lever
from robokin.course import variant
from robokin.course.book import find
from robokin.course.book import lab as content
from robokin.course.questions import filled
from robokin.jobs import redundancy
from robokin.jobs.obstacles import keeps, way_round
from robokin.jobs.steppers import SLOWEST, Stepper, ramp
from robokin.jobs.visit_collect import Task, travel_time, workspace
from robokin.show import motor_explorer

ARM = three_lever(1.0)
K1 = np.array([1.9, 0.3])
Q0 = ARM.family((1.2, 1.7), 118 * deg)
DISTANCE = 1 / 7
sampled_tasks = content("obstacle_avoidance").module("predictions")["sampled_tasks"]


@functools.cache
def cells(lab):
    (path,) = [*NOTEBOOKS.glob(f"{lab}_*.ipynb"), *NOTEBOOKS.glob(f"documents/{lab}_*.ipynb")]
    book = json.loads(path.read_text(encoding="utf-8"))
    return {cell["id"]: "".join(cell["source"]) for cell in book["cells"]}


def said(lab, cell, pattern):
    """The groups of a pattern that matches in a cell; numerals are converted to numbers."""
    match = re.search(pattern, re.sub(r"\s+", " ", cells(lab)[cell]))
    assert match, f"{lab} {cell}: no {pattern!r}"
    return [as_number(each) for each in match.groups()]


def as_number(word):
    try:
        return float(word.replace("\N{MINUS SIGN}", "-"))
    except ValueError:
        return word


def run(lab, *names, changed=()):
    """Run some cells of a lab in this order and return their names; `changed` replaces text in
    them.
    """
    made = {}
    for name in names:
        source = cells(lab)[name]
        for old, new in changed:
            source = source.replace(old, new)
        exec(compile(source, name, "exec"), made)
    return made


def tries(lab, cell):
    """The values after `# try`."""
    (line,) = [x for x in cells(lab)[cell].splitlines() if "# try" in x]
    return eval("[" + line.split("# try")[1] + "]", {"np": np, "mm": mm, "deg": deg})


def asked(name):
    return filled(find(name, "predictions"))


# --- Lab 07 ---------------------------------------------------------------------------------------


def wrist_speeds(q_deg):
    """The semi-axes of the ellipsoid of all flange velocities, computed by finite differences."""
    q = np.array(q_deg) * deg
    steps = 1e-6 * np.eye(6)
    places = PUMA560.fk(np.stack([q + steps, q - steps])).translation
    return np.linalg.svd((places[0] - places[1]).T / 2e-6)[1]


def test_joint_5_flattens_the_ellipsoid_of_the_held_tool_and_joint_3_that_of_the_free_tool():
    five, most, least, *stated, three = said(
        "07",
        "near-look",
        r"joint 5 to (\S+): the shortest semi-axis goes from (\S+) mm/s to (\S+)\..*for every "
        r"\$q_5\$ \((\S+), (\S+) and (\S+) mm/s\).*joint 3 to (\S+)°: the ellipsoid becomes",
    )
    before = wrist_speeds([0, 60, -170, 0, 40, 0])
    assert before == pytest.approx(np.array(stated) * mm, abs=0.5 * mm)
    for q5 in np.linspace(-100, 100, 21):
        assert wrist_speeds([0, 60, -170, 0, q5, 0]) == pytest.approx(before, rel=1e-6)
    for q5, wanted in ((40, most), (five, least)):
        J = PUMA560.jacobian(np.array([0, 60, -170, 0, q5, 0]) * deg)
        still = np.linalg.svd(J[3:])[2][3:].T
        assert np.linalg.svd(J[:3] @ still)[1][2] == pytest.approx(wanted * mm, abs=0.5 * mm)
    flat = wrist_speeds([0, 60, three, 0, five, 0])
    assert flat[2] / flat[0] < 0.002 < before[2] / before[0]


def test_speeds_grow_by_the_stated_factors_ten_times_closer_to_a_singularity():
    pattern = r"grows by a factor of (\S+) at the wrist \(as \$1/m\$\), and by (\S+) at the elbow"
    told = said("07", "cross-look", pattern)
    told += said(
        "07", "why", r"Farther out, .*: from 100 to 10 mm, it grows by a factor of (\d+\.\d)"
    )
    d3, l2, l3 = 150.05, 431.8, np.hypot(431.8, 20.3)  # mm
    h = 600 - 671.83
    farthest = np.sqrt((l2 + l3) ** 2 - h**2 + d3**2)  # from axis 1, with the arm stretched

    def shoulder(m):  # the rate of the angle of the tangent to the circle of radius d3
        return d3 * 100 / ((d3 + m) * np.sqrt(2 * d3 * m + m * m)) / deg

    def elbow(m):  # s^2 = l2^2 + l3^2 + 2 l2 l3 cos(bend), and s ds = rho drho
        rho = farthest - m
        s = np.sqrt(rho**2 + h**2 - d3**2)
        bend = np.arccos((s * s - l2**2 - l3**2) / (2 * l2 * l3))
        return rho * 100 / (l2 * l3 * np.sin(bend)) / deg

    aligned = PUMA560.fk(np.array([0, 60, -170, 0, 0, 0]) * deg)

    def wrist(m):  # computed by finite differences of the inverse
        u = np.linspace(-m, m, 2001)[:, None] * [0, 1e-3, 0]
        poses = Transform(aligned.rotation, aligned.translation + u + [0, 0, m * mm])
        q6 = np.unwrap(PUMA560.ik(poses)[:, 3, 5])
        return abs(np.diff(q6)).max() / (2 * m / 2000) * 100 / deg

    assert "from 1 to 0.1 mm" in cells("07")["cross-look"]
    own = [f(0.1) / f(1) for f in (wrist, elbow, shoulder)]
    assert round(own[1], 1) == round(own[2], 1)
    assert [round(x, 1) for x in (*own[:2], shoulder(10) / shoulder(100))] == told
    tiny = [f(1e-7) / f(1e-6) for f in (shoulder, elbow)]
    assert tiny == pytest.approx([np.sqrt(10)] * 2, rel=1e-3)


def inside(place):
    """For poses with a horizontal tool at places (..., 3) in mm, return which joints (..., 8, 6)
    are inside their limits after some whole turns, and which poses are in reach.
    """
    level = Quaternion.from_angle_axis(90 * deg, [0, 1, 0])
    rows = PUMA560.ik(Transform(level, np.array(place) * mm))
    low, high = PUMA560.limits.T
    turns = rows[..., None] + 2 * np.pi * np.arange(-2, 3)
    fits = ((turns >= low[:, None]) & (turns <= high[:, None])).any(axis=-1)
    return fits, np.isfinite(rows).all(axis=(-2, -1))


def test_rows_are_usable_where_the_first_view_says():
    one, other = said("07", "title", r"in (\w+) ways, but only (\w+) are inside")
    (straight,) = said("07", "count", r"At y = 0, (\w+) rows are usable")
    assert re.search(r"y_target = (\S+)", cells("07")["eight-words"])[1] == "0"
    assert "[550 * mm, 0 * mm, 800 * mm]" in cells("07")["opening"]
    fits, reach = inside([550, 0, 800])
    assert reach and (one, other, straight) == ("eight", "three", "three")
    assert fits.all(axis=-1).sum() == 3
    (average,) = said("07", "count-look", r"The average is about ([\d.]+)\. ")
    assert average == round(content("puma560_branches").module("predictions")["p4"]()["mean"], 1)
    low, high, *behind = said(
        "07", "able", r"From y = (\S+) to (\S+) mm, and from (\S+) to (\S+) mm\. At y = 0"
    )
    told = "joint 1 is past its limit in rows 4 to 7, and joint 4 in rows 3 and 7."
    assert told in cells("07")["able"]
    assert fits[:, 0].tolist() == [True] * 4 + [False] * 4
    assert np.flatnonzero(~fits[:, 3]).tolist() == [3, 7]
    y = np.arange(-800, 801)
    fits, reach = inside(np.stack([0 * y + 550, y, 0 * y + 800], axis=-1))
    every = fits.all(axis=(-2, -1))
    stated = ((y >= low) & (y <= high)) | ((y <= behind[0]) & (y >= behind[1]))
    assert (every == stated).all() and not reach[y > high].any() and not reach[y < behind[1]].any()
    place = said("07", "count-look", r"x = (\S+), y = (\S+), z = (\S+) mm, joint 5 is past its")
    fits, reach = inside(place)
    assert reach and not fits[:, 4].any()


# --- Lab 08 ---------------------------------------------------------------------------------------


def test_nearest_first_rule_loses_as_often_as_stated():
    made = run("08", "visit-explorer", "visit-code", "visit-count")
    first, last = made["drawn"][0], made["drawn"][-1]
    worse = 0
    for seed in range(first, last + 1):
        rng = np.random.default_rng(seed)
        points = rng.uniform([-9, -9, 0], [9, 9, 9], size=(84, 3))
        points = points[workspace(5, 4, points).all(axis=-1)][:8]
        task = Task(5, 4, rng.uniform(15, 40), [0.2] * 3, points[0], points[1:], "visit")
        legs = travel_time(task.q[:, None], task.q, task.speeds)
        # for each subset and each last point: the least time to visit the subset and end there
        best = np.full((256, 8), np.inf)
        best[1, 0] = 0
        for visited in range(1, 256, 2):
            for stop in range(1, 8):
                if not visited >> stop & 1:
                    time = (best[visited] + legs[:, stop]).min()
                    best[visited | 1 << stop, stop] = min(best[visited | 1 << stop, stop], time)
        most = max(s.bit_count() - 1 for s in range(256) if best[s].min() <= task.T)
        here, spent, left = 0, 0.0, set(range(1, 8))
        while left:
            near = min(left, key=lambda stop: legs[here, stop])  # noqa: B023
            spent += legs[here, near]
            if spent > task.T:
                break
            here = near
            left.remove(near)
        worse += 7 - len(left) < most
    assert made["beaten"] == worse < (last - first + 1) / 2
    told = r"(So \*?nearest first\*? usually does as well as the best order)"
    assert said("08", "visit-count-look", told)


# --- Lab 09 ---------------------------------------------------------------------------------------


def race_of_the_cell(count):
    seed, many = said("09", "race-code", r"default_rng\((\d+)\)\.uniform\(0, np\.pi, \((\d+), 3\)")
    obstacle = np.array(said("09", "race-code", r"race_obstacle = .*, \(([\d.]+), ([\d.]+)\)"))
    dice = int(said("09", "race-code", r"seed=(\d+)")[0])
    places = np.random.default_rng(int(seed)).uniform(0, np.pi, (int(many), 3))
    angles = np.cumsum(places - [0, np.pi, np.pi], axis=1)
    places = np.stack([np.cos(angles).sum(axis=1), np.sin(angles).sum(axis=1)], axis=-1)
    reached = [x for x in places if np.isfinite(ARM.alpha_range(x)[0])]
    return np.array(reached[:count]), obstacle, dice


def test_noise_in_the_last_bit_does_not_change_the_race(monkeypatch):
    places, obstacle, _ = race_of_the_cell(40)
    start, rng, exact = np.array([60, 120, 120]) * deg, np.random.default_rng(1), {}
    measured = redundancy.distances

    def noisy(*given):
        d = measured(*given)
        return d + rng.uniform(-1, 1, np.shape(d)) * 4e-16

    for noise in (None, 1, 2):
        if noise:
            monkeypatch.setattr(redundancy, "distances", noisy)
        rule = redundancy.distance_rule(obstacle)
        run_ = redundancy.race({"rule": rule}, ARM, places, start)["rule"]
        exact[noise] = run_.turns.sum() / deg, run_.failed.sum()
        assert exact[noise] == pytest.approx(exact[None], abs=1e-6)


def test_random_choice_turns_the_joints_more_by_the_stated_factor():
    question, options, right = asked("three_levers.p10")
    places, _, seed = race_of_the_cell(100)
    assert question.startswith("An arm visits 100 targets")
    assert "uniformly from 0° to 180°" in question
    stand = {name: np.array([60, 120, 120]) * deg for name in ("least", "dice", "equal")}
    turned, dice = dict.fromkeys(stand, 0.0), np.random.default_rng(seed)

    def least(place, before):
        """The best posture of a sweep over the family and of two finer sweeps near the best row."""
        low, high = ARM.alpha_range(place)
        for count in (8001, 101, 101):
            alphas = np.linspace(low, high, count)
            rows = ARM.family(place, alphas)
            k = abs(rows - before).sum(axis=-1).argmin()
            low, high = alphas[max(k - 1, 0)], alphas[min(k + 1, count - 1)]
        return rows[k]

    def equal(place, before):
        low, high = ARM.alpha_range(place, limited=False)

        def gap(alpha):
            _, beta, alpha = ARM.family(place, alpha)
            return beta - alpha

        q = ARM.family(place, brentq(gap, low, high))
        return q if 0 <= q[0] <= np.pi else least(place, before)

    for place in places:
        low, high = ARM.alpha_range(place)
        new = {
            "least": least(place, stand["least"]),
            "dice": ARM.family(place, low + (high - low) * dice.random()),
            "equal": equal(place, stand["equal"]),
        }
        for name, q in new.items():
            turned[name] += abs(q - stand[name]).sum() / deg
            stand[name] = q
    times = turned["dice"] / turned["least"]
    assert options[right].text == f"About {times:.1f} times as much."
    text = " ".join([question, options[right].reason])
    told = re.search(r"turn by (\d+)° per task on average.* adds (\d+)°.* takes (\d+) % more", text)
    wide = np.diff(ARM.alpha_range(places), axis=0).mean() / deg
    assert f"the range of alpha at a target is {wide:.0f}° wide on average" in question
    own = [turned["least"], turned["dice"] - turned["least"]]
    own.append(1e4 * (turned["equal"] / turned["least"] - 1))
    assert [round(x / 100) for x in own] == [int(x) for x in told.groups()]


def test_the_arm_with_arctan2_stays_within_its_limits_and_the_other_does_not():
    question, _, _ = asked("three_levers.p4")
    first, last = map(
        int, re.search(r"on a circle around O, from (\d+)° to (\d+)°", question).groups()
    )
    facts = content("three_levers").module("predictions")
    RING, SAMPLE = facts["RING"], facts["SAMPLE"]
    KB = 2 * np.sin(SAMPLE / 2)  # gamma is the direction of K plus a constant angle
    gamma_1 = np.arccos((RING**2 + 1 - KB**2) / (2 * RING)) / deg
    beta = np.arccos((KB**2 + 1 - RING**2) / (2 * KB)) + (np.pi - SAMPLE) / 2
    assert 0 < first + gamma_1 and last + gamma_1 < 180 and 0 < beta < np.pi
    assert 90 + gamma_1 - 180 < 0, "the other arm exceeds its limit behind 90°"
    assert ARM.family((0, RING), SAMPLE)[:2] == pytest.approx([(90 + gamma_1) * deg, beta])


# --- Lab 10 ---------------------------------------------------------------------------------------


def lever_distance(q, H, lever=slice(None)):
    """The least distance from H to the levers, shape (...), in postures of shape (..., 3)."""
    angles = np.cumsum(q - np.array([0, np.pi, np.pi]), axis=-1)
    along = np.stack([np.cos(angles), np.sin(angles)], axis=-1)  # unit vectors, shape (..., 3, 2)
    feet = np.cumsum(along, axis=-2) - along
    u = np.clip(((H - feet) * along).sum(axis=-1), 0, 1)
    return np.linalg.norm(feet + u[..., None] * along - H, axis=-1)[..., lever].min(axis=-1)


def least_distance(path, H, count=2001):
    """The smallest distance along a path: the minimum of each segment's samples, refined."""
    found = []
    for a, b in pairwise(np.asarray(path)):
        s = np.linspace(0, 1, count)
        d = lever_distance(a + s[:, None] * (b - a), H)
        k = d.argmin()
        ends = s[max(k - 1, 0)], s[min(k + 1, count - 1)]
        best = minimize_scalar(
            lambda x: lever_distance(a + x * (b - a), H),  # noqa: B023
            bounds=ends,
            method="bounded",
            options={"xatol": 1e-12},
        )
        found += [d[k], best.fun]
    return min(found)


def direct(start, target=K1):
    return np.stack([start, ARM.least(target, start)[0]])


def test_distances_are_proven_with_the_stated_numbers_of_intervals():
    made = run("10", "whole-explorer", "whole-setup", "whole-code")
    proven, H = made["proven"], made["H_motion"]
    a, b = made["q0"], made["q_end"]
    many, yes, edge, more, truth = said(
        "10",
        "whole-look",
        r"(\d+) are enough to prove (\d+) mm, but (\d+) mm takes (\d+), because the true "
        r"clearance, (\S+) mm",
    )
    (no,) = said("10", "whole-look", r"and (\d+) mm fails halfway\.")
    assert proven(a, b, H, yes * mm) == (True, many)
    assert proven(a, b, H, edge * mm) == (True, more)
    assert proven(a, b, H, no * mm) == (False, 2)
    assert lever_distance((a + b) / 2, H) < no * mm
    assert round(least_distance([a, b], H) / mm, 1) == truth
    assert {yes * mm, edge * mm, no * mm} <= set(tries("10", "whole-code"))
    room = lever_distance(a, H)
    assert room > 1 and proven(a, a, H, 0.9 * room) == (True, 1), (
        "this motion does not move the arm"
    )
    assert proven(a, a, H, 1.1 * room) == (False, 1)


def test_movement_depends_on_the_required_distance_as_stated():
    made = run("10", "setup", "control-code")
    control, H = made["control"], np.array([1.2, 1.3])
    text = r"S grows with this distance, from (\d+)° at (\d+) mm to (\d+)° at (\d+) mm, "
    low, near, high, far, falls, to, stays = said(
        "10",
        "often-look",
        text + r"but it falls once, between (\d+) and (\d+) mm.* At (\d+) mm, the arm "
        r"does not",
    )
    asks = eval(re.search(r"asks = (np\.array\(.*?\))", cells("10")["control-player"])[1])
    S = {}
    for each in asks:
        path, _ = control(Q0, K1, H, each)
        S[round(each / mm)] = abs(np.diff(path, axis=0)).sum() / deg
        if len(path) > 1:
            assert least_distance(path, H) >= each - 1e-9
            assert ARM.points(path[-1])[3] == pytest.approx(K1, abs=1e-9)
    assert [*S] == sorted(S) and [*S][0] == near and [*S][-2:] == [far, stays]
    assert round(S[near]) == low and round(S[far]) == high and S[stays] == 0
    ways = [*S.items()][:-1]
    down = [(a, b) for (a, x), (b, y) in pairwise(ways) if y < x]
    assert down == [(falls, to)]
    assert lever_distance(Q0, H) < stays * mm, "at the start the distance is already smaller"


def grid_wave(step, H):
    """The number of steps from the grid posture nearest to q0 to the nearest one with a proven last
    step, and the path: by Dijkstra's algorithm on the graph of all proven steps. (None, None) if
    there is no such path.
    """
    size = round(180 / step) + 1
    cube = np.stack(np.meshgrid(*[np.arange(size)] * 3, indexing="ij"), axis=-1) * step * deg
    number = np.arange(size**3).reshape(size, size, size)
    rows, cols = [], []
    for joint in range(3):
        postures, numbers = np.moveaxis(cube, joint, 0), np.moveaxis(number, joint, 0)
        sure = keeps(ARM, postures[:-1], postures[1:], H, DISTANCE)
        rows.append(numbers[:-1][sure])
        cols.append(numbers[1:][sure])
    rows, cols = np.concatenate(rows), np.concatenate(cols)
    start = tuple(np.rint(Q0 / (step * deg)).astype(int))
    if least_distance([Q0, cube[start]], H) < DISTANCE:
        return None, None
    curve = ARM.family(K1, np.linspace(*ARM.alpha_range(K1), 200))
    ends = cube[tuple(np.rint(curve / (step * deg)).astype(int).T)]
    sure = [least_distance(pair, H, 101) >= DISTANCE for pair in zip(ends, curve, strict=True)]
    graph = coo_array((np.ones(len(rows)), (rows, cols)), shape=(size**3, size**3)).tocsr()
    steps, before = dijkstra(graph, False, number[start], return_predecessors=True)
    goals = number[tuple(np.rint(ends[sure] / (step * deg)).astype(int).T)]
    goal = goals[steps[goals].argmin()]
    if not np.isfinite(steps[goal]):
        return None, None
    way = [goal]
    while way[-1] != number[start]:
        way.append(before[way[-1]])
    last = curve[sure][steps[goals].argmin()]
    path = [Q0, *cube.reshape(-1, 3)[way[::-1]], last]
    return int(steps[goal]), np.array(path)


def test_wavefront_search_starts_and_ends_in_proven_postures(capsys):
    H = np.array([1.2, 1.3])
    question, _, _ = asked("obstacle_avoidance.p6")
    wanted, path = grid_wave(10, H)
    assert int(re.search(r"After (\d+) steps of 10°", question)[1]) == wanted
    assert least_distance(path, H) >= DISTANCE
    assert ARM.points(path[-1])[3] == pytest.approx(K1, abs=1e-9), "the gripper is at the target"
    for step in (10, *tries("10", "cube-run")):
        capsys.readouterr()
        names = "setup", "cube-setup", "cube-code", "cube-run"
        run("10", *names, changed=[("step = 10", f"step = {step}")])
        printed = capsys.readouterr().out
        steps, _ = grid_wave(step, H)
        cannot = re.search(r"cannot start: .* comes within (\d+) mm", printed)
        came = re.search(r"comes to one after (\d+) steps", printed)
        assert (came and int(came[1])) == steps
        assert bool(cannot) == (step == 20) == ("to none" in printed)
        if cannot:
            first = np.rint(Q0 / (step * deg)) * step * deg
            near = least_distance([Q0, first], H) / mm
            assert round(near) == int(cannot[1]) and near < DISTANCE / mm


def test_search_finds_no_path_on_a_15_degree_grid_but_finds_one_on_a_5_degree_grid():
    question, options, _ = asked("obstacle_avoidance.p8")
    H = np.array([0.5, 1.0])
    assert "(0.5, 1) m" in question and "steps of 15°" in question
    assert grid_wave(15, H) == (None, None)
    path = way_round(ARM, Q0, K1, H, DISTANCE)
    assert least_distance(path, H) >= DISTANCE
    S = abs(np.diff(path, axis=0)).sum() / deg
    assert f"S = {S:.0f}°" in options[0].reason


def test_the_documents_test_finds_as_few_obstacles_as_stated():
    question, options, right = asked("obstacle_avoidance.p1")
    for words in (
        "uniformly from 0° to 180°",
        "from 1.1 to 2.9 m",
        "from 0° to 120°",
        "box around",
    ):
        assert words in options[right][1]
    assert "makes 8 drawings, each with H in the middle" in question
    path = pytest.importorskip("matplotlib.path").Path

    def found_in(tasks):
        """How many points H are inside the quadrilateral, and how many of these the test finds."""
        inside = found = 0
        for (A, K), (A1, K_1), H in tasks:
            if path([A, K, K_1, A1]).contains_point(H):
                inside += 1
                y = [line(P, Q, H[0]) for P, Q in ((A1, K_1), (A, K))]
                x = [line(P[::-1], Q[::-1], H[1]) for P, Q in ((A, A1), (K, K_1))]
                found += y[0] < H[1] < y[1] and x[0] < H[0] < x[1]
        return inside, found

    def line(P, Q, x):
        return P[1] + (x - P[0]) * (Q[1] - P[1]) / (Q[0] - P[0])

    def drawn(rng, count):
        q, phi = rng.uniform(0, np.pi, (count, 3)), rng.uniform(0, 120, count) * deg
        target = rng.uniform(1.1, 2.9, count) * [np.cos(phi), np.sin(phi)]
        ends = ARM.points(np.stack([q, ARM.least(target.T, q)[0]], axis=1))[:, :, 2:]
        for pair in ends:
            corners = pair.reshape(-1, 2)
            yield *pair, rng.uniform(corners.min(axis=0), corners.max(axis=0))

    inside, found = found_in(drawn(np.random.default_rng(77), 1500))
    told = re.match(
        r"(\d+) of (\d+)\..* in 1500 random motions, H was inside the quadrilateral (\d+) times, "
        r"and the test found it (\d+) times",
        options[right][1],
    )
    seen, drawings, many, few = map(int, told.groups())
    p = few / many
    assert p < 0.1 and abs(found / inside - p) < 3 * np.sqrt(2 * p * (1 - p) / inside)
    A, K, K_1, A1 = np.array([(0.8, 1.5), (1.75, 1.7), (1.85, 0.5), (0.9, 0.6)])
    assert (
        "drawn = np.array([(0.8, 1.5), (1.75, 1.7), (0.9, 0.6), (1.85, 0.5)])"
        in (cells("10")["drawing-tools"])
    )
    same, upper = [], []
    for mirrored in (1, -1):
        for quarters in range(4):
            turn = np.linalg.matrix_power([[0, 1], [-1, 0]], quarters)
            a, k, k1, a1 = (np.array([A, K, K_1, A1]) * (mirrored, 1)) @ turn
            H = np.mean([a, k, k1, a1], axis=0)
            same.append(found_in([((a, k), (a1, k1), H)]))
            upper.append(line(a1, k1, H[0]) < H[1] < line(a, k, H[0]))
    assert np.sum(same, axis=0).tolist() == [drawings, seen] and same[0] == (1, 1)
    assert upper[4], "mirrored left and right, AK is still the upper line"


def test_areas_outside_the_quadrilateral_are_as_stated():
    question, options, right = asked("obstacle_avoidance.p2")
    start, end = direct(np.array([150, 120, 120]) * deg)
    assert "from (150°, 120°, 120°) to K1 = (1.9, 0.3) m" in question
    assert f"{abs(end - start).sum() / deg:.0f}°" in question
    (A, K), (A1, K_1) = ARM.points(np.stack([start, end]))[:, 2:]
    path = pytest.importorskip("matplotlib.path").Path
    quad = path([A, K, K_1, A1])
    points = np.stack(np.meshgrid(np.arange(-0.9, 1.92, 0.0071), np.arange(0.28, 2.02, 0.0071)), -1)
    points = points.reshape(-1, 2)
    levers = ARM.points(start + np.linspace(0, 1, 401)[:, None] * (end - start))[:, 2:]
    strips = (path([a, b, d, c]) for (a, b), (c, d) in pairwise(levers))
    over = np.any([strip.contains_points(points) for strip in strips], axis=0)
    missed = over & ~quad.contains_points(points)
    told = r"(\S+) of (\S+) m² .* is (\d+) %\..* there are (\S+) m² of the quadrilateral that"
    out, area, share, false = map(float, re.match(told, options[right].reason).groups())
    cell = 0.0071**2
    assert 100 * missed.sum() / over.sum() == pytest.approx(share, abs=0.6)
    own = [missed.sum(), over.sum(), (quad.contains_points(points) & ~over).sum()]
    assert np.array(own) * cell == pytest.approx([out, area, false], abs=0.0065)


def test_six_samples_miss_the_minimum():
    question, options, right = asked("obstacle_avoidance.p4")
    path, H = direct(np.array([150, 120, 120]) * deg), np.array([1.65, 1.1])
    assert "(1.65, 1.1) m" in question and "from (150°, 120°, 120°) to K1" in question
    seen = lever_distance(path[0] + np.linspace(0, 1, 6)[:, None] * (path[1] - path[0]), H).min()
    true = least_distance(path, H)
    (least,) = re.findall(r"more than (\d+) mm away", question)
    assert 0 < seen / mm - int(least) < 1, "a lower bound is never rounded up"
    assert options[0].text.startswith(f"About {seen / mm:.0f} mm: ")
    assert options[right].reason.startswith(
        f"It is {true / mm:.0f} mm, {(seen - true) / mm:.0f} mm less than"
    )
    assert "the ends of lever AK move by about half a metre, so the distance can fall by more " in (
        options[1].reason
    )
    steps = np.diff(
        ARM.points(path[0] + np.linspace(0, 1, 6)[:, None] * (path[1] - path[0])), axis=0
    )
    assert np.hypot(*np.moveaxis(steps[:, 2:], -1, 0)) == pytest.approx(0.515, abs=0.05)
    assert seen - true > 100 * mm


def test_task_prints_degrees_but_holds_radians():
    given = variant("obstacle_avoidance", "your name")
    path_form = content("obstacle_avoidance").module("past_a_bar")["form"]
    words = (
        "`my_task` prints degrees and, for the distance, millimetres; its values are in radians "
    )
    assert words + "and metres." in " ".join(cells("10")["task-2"].split())
    assert re.search(r"^distance +100 mm$", repr(given), re.M) and given["distance"] == 0.1
    for name in ("gamma", "beta", "alpha", "most"):
        (printed,) = re.findall(rf"^{name} +(\S+) °", repr(given), re.M)
        assert given[name] / deg == pytest.approx(float(printed), abs=1e-3)
        assert float(printed) > 4 * np.pi > given[name]
    (most,) = said("10", "task-2", r"at most (\d+) postures")
    (points,) = said("10", "task-2", r"at most (\d+) points")
    path, bar = np.zeros((int(most), 3)), np.zeros((int(points), 2))
    assert [len(part) for part in path_form((path, bar), given)] == [most, points]
    for longer in ((np.zeros((int(most) + 1, 3)), bar), (path, np.zeros((int(points) + 1, 2)))):
        with pytest.raises(ValueError, match=rf"at most ({most:.0f}|{points:.0f}) of them"):
            path_form(longer, given)


# --- Lab 11 ---------------------------------------------------------------------------------------


def test_rounded_positions_stay_within_half_a_pulse():
    _, options, right = asked("motor_synchronisation.p7")
    alone, expected, counted = map(
        float,
        re.match(
            r"In one run, it is (\d+)\. .* is (\d+), .* the error is at most ([\d.]+):",
            options[right].reason,
        ).groups(),
    )
    walk = np.cumsum(np.random.default_rng(1).uniform(-20, 20, (10_001, 3)), axis=0) * [10, 40, 40]
    off = walk - np.floor(walk + 0.5)
    assert abs(off).max() <= 0.5 == counted and abs(off).max() > 0.45
    ways = np.diff(walk, axis=0)
    drift = np.cumsum(np.floor(ways + 0.5) - ways, axis=0) - off[0]
    assert round(abs(drift).max()) == alone and round(np.sqrt(10_000 / 12)) == expected
    assert "within half a pulse" in cells("11")["drift-look"]


def test_start_frequency_and_lost_steps_are_as_stated(capsys):
    torque, inertia, damping = said("13", "missed-code", r"M, J, b = (\S+), (\S+), (\S+) #")
    made = run("13", "missed-code")
    top = int(re.search(r"start frequency: (\d+) pulses/s", capsys.readouterr().out)[1])
    motor = made["motor"]

    def steps(tempo):
        """The number of steps that the rotor makes, integrated pulse by pulse with SciPy."""
        state, times = [0.0, 0.0], [*(np.arange(1, 49) / tempo), 48 / tempo + 0.4]
        for k, (a, b) in enumerate(pairwise([0.0, *times])):
            pull = k * np.pi / 2
            state = solve_ivp(
                lambda t, s: (s[1], (torque * np.sin(pull - s[0]) - damping * s[1]) / inertia),  # noqa: B023
                (a, b),
                state,
                rtol=1e-6,
                atol=1e-6,
            ).y[:, -1]
        return round(state[0] / (np.pi / 2))

    assert steps(top) == 48 > steps(top + 1)
    top_said, after, lost = said(
        "13", "missed-look", r"At (\d+) pulses .* at (\d+) it loses (\d+)\."
    )
    assert (top_said, after, lost) == (top, top + 1, 48 - steps(top + 1))
    pace, mNm = said("13", "load-torque", r"at (\d+) pulses/s, with a load torque of (\d+) mN m")
    held = motor.run(np.arange(1, 49) / pace, np.ones(48), load=mNm / 1000)
    assert held.lost == 0 and motor.run(np.arange(1, 49) / 100, np.ones(48), load=mNm / 1000).lost
    for view in ("load-hand", "load-explorer"):
        assert "motor_explorer(motor)" in cells("13")[view] and run("13", view)["motor"] == motor
    assert motor == made["Stepper"](rise=0), "the motor of the first view"
    assert repr(motor_explorer(motor)).endswith("44 steps lost.")
    _, options, _ = asked("motor_synchronisation.p10")
    assert f"loses {48 - steps(160)} of 48" in options[2].reason
    few = int(re.search(r"loses (\d+) of 48", options[3].reason)[1])
    tempos = range(60, 281, 10)
    lost = {
        motor.run(ramp(48, *x), np.ones(48)).lost for f in tempos for x in ((f, f, 0), (40, f, 0.1))
    }
    assert min(lost - {0}) == few
    start, tempo, made = map(
        int,
        re.search(
            r"all 48 at (\d+) pulses per second and above, .* at (\d+) it makes (\d+) steps",
            options[3].reason,
        ).groups(),
    )
    assert steps(tempo) == made > 0 and tempos.start < start < tempos.stop
    every = {f: motor.run(np.arange(1, 49) / f, np.ones(48)).lost for f in tempos}
    assert every[start - 10] < 48 and {n for f, n in every.items() if f >= start} == {48}


def test_a_load_torque_holds_the_rotor_back_as_stated():
    """The rotor rests where the pull of the field is the load; a pulse adds 90° to the lag."""
    weight, of, held = said(
        "13",
        "load",
        r"with (\d+) mN m .* \$M\$ is (\d+) mN m.*\*load torque\* in the view below to (\d+) mN",
    )
    lag, sine, pulls = said(
        "13", "load-torque", r"The lag is (\d+)°: \$M \\sin (\d+)°\$ is (\d+) mN m"
    )
    makes, fails = said("13", "load", r"Then type (\d+) and press .* type (\d+) and press")
    slow, tempo = said(
        "13", "load-torque", r"With (\d+) mN m, it cannot follow even (\d+) pulses/s"
    )
    least, after, step, pull, most = said(
        "13",
        "load-torque",
        r"With (\d+) mN m, the weight runs away.* lag is (\d+)° \+ (\d+)°, .* pulls with only "
        r"(\d+) mN m.* makes a step from rest, here (\S+) mN m, is its \*starting torque\*",
    )
    motor = run("13", "load-hand")["motor"]
    assert slow == makes and tempo == SLOWEST and motor.start_frequency(slow / 1000) == 0
    assert abs(after_pulses(motor, slow / 1000, tempo)) > 4
    torque = 1000 * motor.torque
    assert (weight, of, sine) == (held, torque, lag) and pulls == held
    assert torque * math.sin(math.radians(lag)) == pytest.approx(held)
    assert least == fails and step == math.degrees(motor.step)
    assert after == round(math.degrees(math.asin(fails / torque)))
    assert pull == round(torque * math.cos(math.asin(fails / torque))) < fails
    assert most == round(1000 * motor.starting_torque, 1) and makes < most < fails
    # the lag after the pulse of a load that the motor can just move is as far from 90° as before it
    assert 1000 * motor.starting_torque == pytest.approx(torque * math.sin(math.pi / 4))
    for load, backwards in ((makes, False), (fails, True)):
        end = one_pulse(motor, load / 1000)
        rest = math.pi / 2 - math.asin(load / torque)
        assert end < -2 * math.pi if backwards else end == pytest.approx(rest, abs=1e-3)


def one_pulse(motor, load):
    """The angle of the rotor half a second after one pulse, from rest under this load; SciPy."""
    rest = -math.asin(load / motor.torque)

    def moves(_, state):
        drag = motor.damping * state[1] + load
        return state[1], (motor.torque * math.sin(math.pi / 2 - state[0]) - drag) / motor.inertia

    return solve_ivp(moves, (0, 0.5), (rest, 0), rtol=1e-8, atol=1e-8).y[0, -1]


def after_pulses(motor, load, tempo):
    """How many of 48 steps a magnet loses under this load, without rounding; SciPy."""
    bent = math.asin(load / motor.torque)
    state, times = (-bent, 0.0), [*(np.arange(1, 49) / tempo), 48 / tempo + 0.4]

    def moves(_, state, field):
        drag = motor.damping * state[1] + load
        return state[1], (motor.torque * math.sin(field - state[0]) - drag) / motor.inertia

    for k, (a, b) in enumerate(pairwise([0.0, *times])):
        field = (k * math.pi / 2,)
        state = solve_ivp(moves, (a, b), state, rtol=1e-8, atol=1e-8, args=field).y[:, -1]
    return 48 - (state[0] + bent) / (math.pi / 2)


def test_loaded_magnet_has_a_resonance_below_its_start_frequency():
    """The lab says so next to the frequency in the view, which bisection finds."""
    mNm, top, below = said(
        "13",
        "load-torque",
        r"With (\d+) mN m, it has a resonance: its maximum start frequency is (\d+) pulses/s, but "
        r"at (\d+) it loses steps",
    )
    motor = run("13", "load-hand")["motor"]
    assert motor.start_frequency(mNm / 1000) == top > below
    lost = [after_pulses(motor, mNm / 1000, tempo) for tempo in (below, top, top + 1)]
    assert lost[1] == pytest.approx(0, abs=0.01) and min(lost[0], lost[2]) > 4


def lost_at(motor, tempos, each):
    """How many of 48 steps a motor loses at each of these frequencies, with `each` steps of the
    Runge-Kutta method from pulse to pulse.
    """
    rows, ahead = len(motor.currents), motor.periods
    theta = omega = np.zeros(len(tempos))

    def slopes(theta, omega, row):
        pull = motor.torque * np.sin(2 * np.pi * row / rows - ahead * theta)
        return omega, (pull - motor.damping * omega) / motor.inertia

    rest = 10 * 2 * motor.inertia / motor.damping  # s
    spans = [(k, 1 / np.array(tempos) / each, each) for k in range(48)]
    for row, h, count in (*spans, (48, 1e-4, math.ceil(rest / 1e-4))):
        for _ in range(count):
            v0, a0 = slopes(theta, omega, row)
            v1, a1 = slopes(theta + h / 2 * v0, omega + h / 2 * a0, row)
            v2, a2 = slopes(theta + h / 2 * v1, omega + h / 2 * a1, row)
            v3, a3 = slopes(theta + h * v2, omega + h * a2, row)
            theta = theta + h / 6 * (v0 + 2 * v1 + 2 * v2 + v3)
            omega = omega + h / 6 * (a0 + 2 * a1 + 2 * a2 + a3)
    return dict(zip(tempos, (48 - np.rint(theta / motor.step)).astype(int), strict=True))


def test_resonance_of_the_iron_rotor_is_where_the_lab_says():
    """It loses steps there with every step of integration; how many, depends on this step."""
    call = re.search(r"Stepper\(.*\)(?=\))", cells("13")["pull-explorer"])[0]
    motor = eval(call, {"Stepper": Stepper})
    first, last = said("13", "deeper-iron", r"\*frequency\* from (\d+) down to (\d+)")
    low, high, below, above = said(
        "13",
        "deeper-iron",
        r"every whole number of pulses/s from (\d+) to (\d+), it loses steps, in threes, .* "
        r"swings (\d+) to (\d+) times per second",
    )
    band = range(int(low), int(high) + 1)
    assert len(motor.currents) == 3 and last < low < high < first
    counts = set()
    for each in (150, 200, 300):
        lost = lost_at(motor, [band[0] - 1, *band, band[-1] + 1], each)
        assert lost[band[0] - 1] == lost[band[-1] + 1] == 0
        assert all(lost[f] > 0 for f in band) and not any(n % 3 for n in lost.values())
        counts.add(tuple(lost.values()))
    assert len(counts) > 1
    assert all(motor.run(np.arange(1, 49) / f, np.ones(48)).lost > 0 for f in band)
    spring = motor.periods * motor.torque / motor.inertia
    slower = spring - (motor.damping / 2 / motor.inertia) ** 2
    assert below < math.sqrt(slower) / 2 / math.pi < math.sqrt(spring) / 2 / math.pi < above
    (top,) = said("13", "deeper-iron", r"Bisection misses this: .* start frequency is (\d+)\.")
    assert motor.start_frequency() == top > high


def test_magnet_of_the_lab_has_no_resonance_below_its_start_frequency():
    least, top = said(
        "13",
        "missed-look",
        r"Without a load, this motor loses none at any whole number of pulses/s from (\d+) to "
        r"(\d+)\.",
    )
    motor = run("13", "load-hand")["motor"]
    lost = lost_at(motor, range(int(least), int(top) + 2), 400)
    assert lost.pop(int(top) + 1) > 0 and set(lost.values()) == {0}


def test_half_steps_are_lost_in_multiples_of_eight():
    (call,) = re.findall(r"Stepper\([^()]*\)", cells("13")["half-explorer"])
    motor = eval(call, {"Stepper": Stepper})
    assert "its table has eight rows" in cells("13")["missed-look"]
    assert "A multiple of eight" in cells("13")["half-look"] and len(motor.currents) == 8
    lost = {f: motor.run(np.arange(1, 49) / f, np.ones(48)).lost for f in range(160, 501, 20)}
    assert lost[160] == 0 and max(lost.values()) > 0 and not any(n % 8 for n in lost.values())


def test_pulses_in_half_of_the_ramp_are_as_stated():
    ms, f0, f1, t_r = said(
        "13", "ramp", r"first (\d+) ms of a ramp from (\d+) to (\d+) pulses/s in (\S+) s\?"
    )
    start, slope, due, after = said(
        "13",
        "ramp-look",
        r"\$(\d+) \\cdot 0.05 \+ .*\\cdot (\d+) \\cdot 0.05\^2 = (\S+)\$ steps are due after "
        r"(\d+) ms: three pulses have come",
    )
    t = ms / 1000
    assert (start, after) == (f0, ms) and slope == pytest.approx((f1 - f0) / t_r)
    assert due == pytest.approx(f0 * t + slope * t * t / 2) and math.floor(due) == 3
    assert np.sum(ramp(48, f0, f1, t_r) <= t) == 3


def test_labs_on_motors_do_not_mention_missing_tables():
    question, _, _ = asked("motor_synchronisation.p10")
    texts = [question, *cells("11").values(), *cells("13").values()]
    assert not [text for text in texts if re.search(r"\btable \d", text)]


def test_every_suggested_cycle_drifts():
    arm, per_degree = loader_arm(450 * mm, 300 * mm), np.array([10, 40, 40])
    for stakes in ([420, -180, 420], *tries("11", "drift-code")):
        points = np.array([[600, -350, 50], stakes, [50, 250, 350]]) * mm
        x, y, z = points.T
        h = np.linalg.norm(points, axis=1)
        beta = np.arccos((0.45**2 + 0.3**2 - h**2) / (2 * 0.45 * 0.3))
        gamma = np.arccos((0.45**2 - 0.3**2 + h**2) / (0.9 * h)) + np.arcsin(z / h)
        q = np.stack([np.arctan2(y, x), gamma, beta], axis=-1)
        assert arm.fk(q).translation == pytest.approx(points)
        ways = (np.roll(q, -1, axis=0) - q) / deg * per_degree
        assert np.rint(ways).sum(axis=0).any(), f"nothing drifts with {stakes}"


# --- Lab 12 ---------------------------------------------------------------------------------------


def test_elbow_formula_is_exact_at_every_point_but_one_and_jumps_there():
    assert "right at every point of a path except one" in cells("12")["title"]
    made = run("12", "sides-setup")
    sp = pytest.importorskip("sympy")
    x, y, link = sp.symbols("x y l", positive=True)
    for side in (1, -1):  # the cell's formula in symbols, with x3 = side * x
        d2 = x**2 + y**2
        y2 = (y * d2 + sp.sqrt(x**2 * d2 * (4 * link**2 - d2))) / (2 * d2)
        x2 = (d2 - 2 * y * y2) / (2 * side * x)
        rest = [x2**2 + y2**2 - link**2, (x2 - side * x) ** 2 + (y2 - y) ** 2 - link**2]
        assert [sp.simplify(each) for each in rest] == [0, 0]
    elbow = made["elbow_by_root"]
    shown = re.search(
        r"\$\$y_2 = (.*?), \\qquad x_2 = (.*?)\.\$\$", cells("12")["elimination-look"]
    )
    given = {"x_3": -0.7, "y_3": 0.9, "l": 1.1, "d": np.hypot(-0.7, 0.9), "sqrt": np.sqrt}
    for name, formula in zip(("y_2", "x_2"), shown.groups(), strict=True):
        for old, new in ((r"\,", "*"), ("^", "**"), (r"\frac", ""), ("}{", ")/("), ("\\", "")):
            formula = formula.replace(old, new)
        given[name] = eval(formula.replace("{", "(").replace("}", ")"), {}, given)
    assert [given["x_2"], given["y_2"]] == pytest.approx(elbow(-0.7, 0.9, 1.1))
    for height in np.arange(0.4, 1.7, 0.2):
        left, right = (elbow(side * 1e-3, height, 1.0) for side in (-1, 1))
        assert left[0] * right[0] < 0, "the elbows should be on different sides"
        with np.errstate(invalid="ignore", divide="ignore"):
            assert not np.isfinite(elbow(np.float64(0), height, 1.0)[0])
    x_tips = run("12", "derive-line", "derive-check", "sides-setup", "sides-player")["x_tips"]
    assert (x_tips != 0).all() and (x_tips[:, :-1] * x_tips[:, 1:] < 0).sum(axis=1).tolist() == [
        2
    ] * 4


@functools.cache
def generated():
    """Return the programs that the lab generates in sections 2 and 5 and under More."""
    pytest.importorskip("sympy")
    names = (
        "derive-line derive-check elimination-code sides-setup sides-code count-operations "
        "count-code edges-judge"
    )
    return run("12", *names.split())


def test_the_table_near_zero_uses_the_formulas_of_the_lab():
    made = generated()
    lines = find("two_link_code_generation.p4", "predictions").view().split("\n")
    assert "elbow_by_root" in lines[0] and "root_code" in lines[0]
    for line in lines[1:]:
        x3, one, two = re.match(r"x3 = (\S+) m: (\S+) m, (\S+) m$", line).groups()
        x3 = as_number(x3)
        own = [np.hypot(*rule(x3, 1.0, 1.0)) for rule in (made["elbow_by_root"], made["root_code"])]
        assert [f"{x:.6f}" for x in own] == [one, two]


def test_errors_near_the_line_x3_0_are_as_stated():
    """A tip above the base whose x3 is tiny; the elbow should be 1 m from the base and the tip."""
    made = generated()

    def error(rule, x3):
        elbow = rule(x3, 1.0, 1.0)
        return max(abs(np.hypot(*elbow) - 1), abs(np.hypot(elbow[0] - x3, elbow[1] - 1) - 1))

    x3, off = said(
        "12",
        "edges-look",
        r"(\S+) nm from \$x_3 = 0\$, the formula of section 3 makes the links (\S+) nm too short",
    )
    elbow = made["elbow_by_root"](x3 * 1e-9, 1.0, 1.0)
    for end in ((0, 0), (x3 * 1e-9, 1.0)):
        assert round(1e9 * (1 - np.hypot(*(elbow - np.array(end))))) == off
    assert made["edges"][f"{x3:.0f} nm off x3 = 0"][0] == (x3 * 1e-9, 1.0)
    off, power = said(
        "12", "sides-look", r"makes link 1 (\S+) µm too short at \$10\^\{(-\d+)\}\$ m"
    )
    assert round(1e6 * (1 - np.hypot(*made["elbow_by_root"](10**power, 1.0, 1.0)))) == off
    power, far = said(
        "12", "sides-look", r"at \$10\^\{(-\d+)\}\$ m its elbow is already only (\S+) m"
    )
    assert abs(np.hypot(*made["root_code"](10**power, 1.0, 1.0)) - far) < 1e-6
    assert error(made["root_code"], 1e3 * 10**power) < 1e-5
    for rule in (made["elbow_by_root"], made["root_code"]):
        assert error(rule, np.cos(np.pi / 2)) > 0.1


def test_the_table_near_zero_does_not_depend_on_the_unknown_tried_in_section_3():
    pytest.importorskip("sympy")
    names = ("derive-line", "derive-check", "elimination-code", "sides-setup", "sides-code")
    tried = {k: cells("12")[k].replace("gone = x2 ", "gone = y2 ") for k in names}
    assert tried["elimination-code"] != cells("12")["elimination-code"]
    other: dict = {}
    for text in tried.values():
        exec(text, other)
    for x3 in (1.0, 1e-6, 1e-9):
        assert other["root_code"](x3, 1.0, 1.0) == generated()["root_code"](x3, 1.0, 1.0)


def test_rounding_at_the_limit_of_reach_loses_the_stated_number_of_answers():
    made = generated()
    question, options, right = asked("two_link_code_generation.p8")
    count = int(re.search(r"We take (\d+) tips", question)[1])
    u = eval(re.search(r"`(np\.arange.*?)`", question)[1], {"np": np})
    tips = {"x3": 1.7 * (1 - u**2) / (1 + u**2), "y3": 1.7 * (2 * u) / (1 + u**2)}
    assert len(u) == count and np.allclose(np.hypot(*tips.values()), 1.7, rtol=0, atol=1e-15)
    given = tips | {"x1": 0, "y1": 0, "l1": 1.0, "l2": 0.7, "sqrt": np.sqrt}
    with np.errstate(invalid="ignore"):
        exec(made["written"](made["general"]), given)
        plain = eval(str(made["general"][0]), {k: given[k] for k in given if k[0] in "xyls"})
    told = re.search(r"for (\d+) of (\d+) tips.* for (\d+)\.", options[right].reason)
    assert [np.isnan(given["out0"]).sum(), count, np.isnan(plain).sum()] == [
        int(x) for x in told.groups()
    ]
    singly = [0, 0]  # the same programs for one tip at a time
    for x3, y3 in zip(*tips.values(), strict=True):
        one = given | {"x3": x3, "y3": y3}
        with np.errstate(invalid="ignore"):
            exec(made["written"](made["general"]), one)
            first = eval(str(made["general"][0]), {k: one[k] for k in one if k[0] in "xyls"})
        singly = [singly[0] + np.isnan(one["out0"]), singly[1] + np.isnan(first)]
    assert "so are both counts" in options[right].reason
    assert all(x != int(y) for x, y in zip(singly, told.groups()[::2], strict=True)), singly


def test_lab_and_exercise_3_state_the_same_accuracy():
    (power,) = said("12", "your-turn-3", r"to within \$10\^\{(-\d+)\}\$ m")
    promise = find("two_link_code_generation.3", "exercises").promise
    assert f"within 1e{power:.0f} m" in promise


# --- The documents --------------------------------------------------------------------------------


def test_sections_named_in_the_companion_cover_the_signed_angle():
    (row,) = [x for x in cells("001")["rows"].splitlines() if x.startswith("| S1-01 |")]
    assert "signed `angle_to` about an axis" in row and "Quaternion.angle_to" not in row
    assert "[here §1]" in row and "[02 More]" in row
    assert "listing" not in inspect.getdoc(Quaternion.angle_to)
    texts = [*cells("02").values()]  # in the lab's order
    at = next(k for k, text in enumerate(texts) if "def angle_to(one, two, axis)" in text)
    heading = [line for text in texts[:at] for line in text.splitlines() if line[:3] == "## "][-1]
    assert heading == "## More"
    Vector = run("001", "setup", "vector")["Vector"]
    for turn in (30, 150, -40, -170):
        u, v = Vector(1, 0, 0), Vector(np.cos(turn * deg), np.sin(turn * deg), 0)
        assert u.angle_to(v, Vector(0, 0, 1)) / deg == pytest.approx(turn)


def test_the_race_includes_the_five_methods_of_part_one():
    (line,) = [x for x in cells("003")["lost"].splitlines() if x.startswith("| I |")]
    many, first, second = re.search(r"compares (\w+) methods of (\S+) and (\S+) ", line).groups()
    makers = [
        redundancy.pseudo_inverse,
        redundancy.gradient_projection,
        redundancy.equal_angles,
        redundancy.random_choice,
        redundancy.distance_rule,
    ]
    sources = [re.search(r"003, (I\.\d(?:\.\d)?)", inspect.getdoc(each))[1] for each in makers]
    assert many == "five" and {*sources} == {first, second}
    assert len(redundancy.methods((1, 1), 0)) == 1 + len(makers)
