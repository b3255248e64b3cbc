"""Statements of lab 09 about its views, checked by intersecting circles."""

import math

import numpy as np
import pytest
from test_true_statements_b import ARM, asked, cells, race_of_the_cell, said
from test_true_statements_b import run as run_cells
from test_true_statements_c import flat, numbers
from test_true_statements_g import family, gripper, least_from, quietly

from robokin import deg
from robokin.course import answers, book
from robokin.jobs.obstacles import clearance
from robokin.jobs.redundancy import methods, race

FIRST, BEHIND = complex(2.4, 0.4), complex(-2.0, 1.4)
STAND, SQUARE = np.array([60, 120, 120]) * deg, np.array([90, 90, 90]) * deg


def ends(K):
    """Return the range of alpha at K for which gamma stays below 180 degrees."""
    alphas = np.linspace(math.acos((5 - abs(K) ** 2) / 4), math.pi, 4001)
    kept = [alpha for alpha in alphas if family(K, alpha)[0] <= math.pi + 1e-9]
    return kept[0], kept[-1]


def in_circles(K, alphas):
    return np.array([family(K, alpha) for alpha in alphas])


def test_only_ring_1_keeps_the_distance_of_the_gripper_from_the_base():
    assert "Which circle has its centre at the base O?" in flat("09", "chain")
    assert "Ring 1: it turns the whole arm about O." in flat("09", "chain-look")
    q = np.array([100, 110, 120]) * deg
    far = [abs(gripper(q + 0.1 * np.eye(3)[k])) - abs(gripper(q)) for k in range(3)]
    assert abs(far[0]) < 1e-12 and min(map(abs, far[1:])) > 0.01


def test_two_levers_are_in_line_at_both_ends_of_the_range():
    words = flat("09", "range-formula")
    assert "For this target, two levers are in line in each of them" in words
    assert "BA and AK at $\\alpha = 180°$, and OB and BA at the lowest $\\alpha$, where" in words
    K = complex(0.55, 0.35) * 3  # where the view opens
    low, high = ends(K)
    assert high == math.pi and family(K, low)[1] == pytest.approx(math.pi, abs=1e-6)


def test_range_disappears_within_reach_as_section_3_says():
    x, first, last = numbers(
        r"set x to (\S+) and move the y slider from (\S+) down to (\S+): the curve plotted against "
        r"\$\\alpha\$ gets shorter and disappears",
        flat("09", "limits-look"),
    )
    wide = []
    for y in np.linspace(first, last, 56):
        K = complex(x, y)
        assert 1 < abs(K) < 3, "no arm reaches it, whatever its limits are"
        alphas = np.linspace(math.acos((5 - abs(K) ** 2) / 4), math.pi, 4001)
        wide.append(sum(family(K, alpha)[0] >= 0 for alpha in alphas))  # else past 180 degrees
    assert (np.diff(wide) <= 0).all() and wide[0] > 20 * max(wide[-1], 1) and wide[-1] == 0


def test_with_b_on_the_other_side_beta_would_be_negative():
    words = flat("09", "angles-formula")
    assert "would be negative, because $KO > L$ makes" in words
    assert r"$\cos\beta_1 < \frac{KB}{2L} = \cos\beta_2$" in words
    for KO in np.linspace(1.001, 2.999, 60):
        for alpha in np.linspace(math.acos((5 - KO**2) / 4), math.pi, 60):
            KB = 2 * math.sin(alpha / 2)
            beta_1 = math.acos(max(-1, min(1, (KB**2 + 1 - KO**2) / (2 * KB))))
            assert (math.pi - alpha) / 2 - beta_1 < 0
            assert math.cos(beta_1) < KB / 2 + 1e-12
            assert math.cos((math.pi - alpha) / 2) == pytest.approx(KB / 2)


def test_beta_falls_from_180_degrees_within_its_limits():
    words = flat("09", "limits")
    assert r"between 0° and 180° ($\beta$ falls from 180° as $\alpha$ grows)" in words
    for KO in np.linspace(1.001, 2.999, 60):
        alphas = np.linspace(math.acos((5 - KO**2) / 4), math.pi, 400)
        beta = in_circles(KO, alphas)[:, 1]
        assert beta[0] == pytest.approx(math.pi, abs=1e-6)
        assert (np.diff(beta) < 0).all() and beta[-1] >= 0


def test_minimum_of_s_is_where_section_4_says():
    words = flat("09", "least-sweep")
    far, behind = complex(2.8, 0.4), BEHIND
    assert "Far out, at (2.8, 0.4) m, S is lowest where its curve is flat." in words
    assert "Behind the base, at (−2.0, 1.4) m, it is lowest at an end of the range." in words
    for K in (far, behind):
        low, high = ends(K)
        S, q = least_from(K, SQUARE)
        assert abs(q - SQUARE).min() > 1 * deg, "an angle has its previous value"
        from_end = min(q[2] - low, high - q[2])
        assert (from_end > 5 * deg) if K is far else (from_end < 1e-3)
        if K is far:
            near = [abs(family(K, q[2] + step) - SQUARE).sum() - S for step in (-1e-3, 1e-3)]
            assert max(near) < 1e-5, "not flat"


def test_kink_of_gamma_has_the_least_sum_for_the_target_of_section_4():
    made = quietly("09", "least-explorer", "least-code")
    K = complex(*made["target"])
    S, q = least_from(K, made["previous"])
    assert [made["S_kink"], made["kink"]] == pytest.approx([S, q[2]], abs=1e-6)
    assert family(K, made["kink"])[0] == pytest.approx(made["previous"][0], abs=1e-9)
    found = [made["sweep"](made["target"], made["previous"], step * deg)[1] for step in (2, 1, 0.1)]
    assert made["width"] == 2 * deg and "# try 1 * deg, 0.1 * deg" in cells("09")["least-code"]
    assert found[0] > S + 0.1 * deg and sorted(found)[::-1] == found, "a finer sweep is worse"


def test_share_of_moves_to_a_kink_holds_for_other_random_moves():
    _, options, right = asked("three_levers.p6")
    share, low, high, near, far = numbers(
        r"in (\S+) % of \d+ random moves the least S is at a kink\..*with every angle between "
        r"(\S+)° and (\S+)° and K (\S+) m to (\S+) m from O",
        options[right].reason,
    )
    rng, kept, reached = np.random.default_rng(40), 0, 0
    while reached < 300:
        before = rng.uniform(low, high, 3) * deg
        K = gripper(before)
        if not near < abs(K) < far:
            continue
        place = K + 0.1 * np.exp(2j * np.pi * rng.random())
        q, S = ARM.least((place.real, place.imag), before)
        if np.isfinite(S):
            reached, kept = reached + 1, kept + bool((abs(q - before) < 1e-6).any())
    assert 100 * kept / reached == pytest.approx(share, abs=3)


def test_only_one_sum_of_the_angles_has_a_minimum_inside_the_range():
    words = flat("09", "least-exact")
    assert "six of these eight sums only rise or only fall (we do not prove this)" in words
    assert "only $\\alpha + \\beta - \\gamma$ has a minimum inside the range" in words
    seen, turning = set(), set()
    for KO in np.linspace(1.02, 2.98, 40):
        q = in_circles(KO, np.linspace(math.acos((5 - KO**2) / 4), math.pi, 2001)[1:-1])
        for signs in np.stack(np.meshgrid(*[[-1, 1]] * 3), axis=-1).reshape(-1, 3):
            total = q @ signs
            inside = (total[1:-1] < total[:-2] - 1e-12) & (total[1:-1] < total[2:] - 1e-12)
            if inside.any():
                seen.add(tuple(signs.tolist()))
            steps = np.diff(total)
            if steps.min() < -1e-9 and steps.max() > 1e-9:
                turning.add(tuple(signs.tolist()))
    assert seen == {(-1, 1, 1)}, "in the order gamma, beta, alpha"
    assert turning == {(-1, 1, 1), (1, -1, -1)}


def test_times_of_the_fastest_and_of_the_least_movement_are_as_stated():
    alpha, longest, least = numbers(
        r"At \$\\alpha = (\S+)°\$\. Above it, \$\|\\Delta\\alpha\|\$ is larger; below it, "
        r"\$\|\\Delta\\beta\|\$\. The largest turn is (\S+)° there, and (\S+)° with the least S\.",
        flat("09", "cost-look"),
    )
    alphas = np.linspace(*ends(FIRST), 40001)
    change = abs(in_circles(FIRST, alphas) - STAND) / deg
    best = change.max(axis=1).argmin()
    assert [alphas[best] / deg, change[best].max()] == pytest.approx([alpha, longest], abs=0.05)
    assert change[best, 1] == pytest.approx(change[best, 2], abs=0.02), "beta and alpha cross"
    assert (change[best + 10 :, 2] > change[best, 2]).all(), "alpha turns more above it"
    assert (change[: best - 10, 1] > change[best, 1]).all(), "beta turns more below it"
    turned = abs(least_from(FIRST, STAND)[1] - STAND).max() / deg
    assert turned == pytest.approx(least, abs=0.05)
    _, options, right = asked("three_levers.p8")
    told = r"after (\S+) s\. The one with the least S takes (\S+) s\."
    time, later = numbers(told, options[right].text)
    assert [change[best].max() / 30, turned / 30] == pytest.approx([time, later], abs=0.005)
    words = flat("09", "cost-look")
    (twice,) = numbers(
        r"If the motor at A is twice as fast, the fastest move goes to \$\\alpha = (\S+)°\$", words
    )
    times = (change / [1, 1, 2]).max(axis=1)
    assert alphas[times.argmin()] / deg == pytest.approx(twice, abs=0.05)


def test_sums_in_the_question_about_time_agree_with_its_turns_and_with_the_view():
    question, _, _ = asked("three_levers.p8")
    turn = r"(\S+)°"
    told = numbers(
        rf"gamma turns by {turn}, beta by {turn} and alpha by {turn}, so S is about {turn}\. In "
        rf"the other posture, they turn by {turn}, {turn} and {turn}, so S is about {turn}\.",
        question,
    )
    alphas = np.linspace(*ends(FIRST), 40001)
    change = abs(in_circles(FIRST, alphas) - STAND) / deg
    for k, row in ((0, change.sum(axis=1).argmin()), (4, change.max(axis=1).argmin())):
        assert change[row] == pytest.approx(told[k : k + 3], abs=0.05)
        assert round(sum(told[k : k + 3])) == round(change[row].sum()) == told[k + 3]


def test_best_first_posture_costs_what_section_6_says():
    words = f"{flat('09', 'greed-try')} {flat('09', 'greed-hand')}"
    (lost,) = numbers(
        r"may be expensive later: in section 6, it costs (\S+)° more\.", flat("09", "title")
    )
    (greedy,) = numbers(r"the joints of the greedy arm turn by (\S+)° in total", words)
    best, now, then, total, less, more = numbers(
        r"Take α = (\S+)°\. The first task then costs (\S+)° and the second (\S+)°, which makes "
        r"(\S+)° in total: β almost keeps its value in the second task\. The greedy arm turns "
        r"(\S+)° less in the first task and (\S+)° more in the second",
        words,
    )
    targets = r"\[\(2\.4, 0\.4\), \((\S+), (\S+)\)\]"
    second = complex(*said("09", "greed-explorer", targets))
    assert second == complex(*said("09", "greed-code", f"pair = {targets}"))
    one, q = least_from(FIRST, STAND)
    two, _ = least_from(second, q)
    assert (one + two) / deg == pytest.approx(greedy, abs=0.05)
    assert "and α already has its best value" in words, "the view moves alpha into its range"
    end = least_from(second, q)[1]
    assert end[0] == pytest.approx(math.pi, abs=1e-3) and end[2] < q[2]
    alphas = np.linspace(*ends(FIRST), 241)
    ways = [(abs(family(FIRST, a) - STAND).sum(), family(FIRST, a)) for a in alphas]
    sums = np.array([cost + least_from(second, q)[0] for cost, q in ways])
    assert alphas[sums.argmin()] / deg == pytest.approx(best, abs=0.4)
    assert abs(best - STAND[2] / deg) > 5, "the view starts with the answer"
    first = family(FIRST, best * deg)
    cost, (rest, then_q) = abs(first - STAND).sum(), least_from(second, first)
    assert abs(then_q - first)[1] < 0.1 * deg, "beta does not keep its value"
    assert [cost / deg, rest / deg, (cost + rest) / deg] == pytest.approx(
        [now, then, total], abs=0.05
    )
    assert (cost + rest) / deg < sums.min() / deg + 0.1
    assert round((one + two - cost - rest) / deg) == lost
    assert [(cost - one) / deg, (two - rest) / deg] == pytest.approx([less, more], abs=0.05)


def test_both_arms_of_the_player_differ_for_the_stated_targets():
    words = flat("09", "greed-look")
    one, *first, two, greed, plan = numbers(
        r"For (\d+)° \(greedy (\S+)°, planned (\S+)°\) and (\d+)° \((\S+)° and (\S+)°\)\. There "
        r"the planning arm has opened",
        words,
    )
    wanted = [one, two]
    made = run_cells("09", "greed-code", "greed-player")
    greedy, planned = (q[:, 600] for q in made["player_motions"])  # after 3 s
    apart = abs(greedy - planned).max(axis=1) / deg > 1
    assert made["player_angles"][apart].tolist() == wanted
    opened = (planned - greedy)[apart]
    assert (opened[:, 1] > 20 * deg).all() and (opened[:, 2] < -20 * deg).all()
    turns = [abs(np.diff(q, axis=1)).sum(axis=(1, 2)) / deg for q in made["player_motions"]]
    assert np.array(turns)[:, apart] == pytest.approx(
        np.transpose([first, [greed, plan]]), abs=0.05
    )
    assert "joints=[], quantities=" in cells("09")["greed-player"]


def test_random_choice_stays_away_from_the_obstacle_in_the_tasks_that_it_solves():
    words = flat("09", "race-look")
    assert "In the tasks that it solves, random choice never comes closer than $L/7$" in words
    places, obstacle, seed = race_of_the_cell(100)
    rules = {"random choice": methods(obstacle, seed=seed)["random choice"]}
    made = race(rules, ARM, places, STAND)["random choice"]
    away = clearance(ARM, np.vstack([STAND, made.postures]), obstacle).min(axis=-1)
    assert away[~made.failed].min() >= 1 / 7 > away[made.failed].min()


def test_check_of_exercise_2_stops_after_the_stated_time():
    (seconds,) = numbers(
        r"a test that takes more than (\S+) s for one program", flat("09", "yourturn-2")
    )
    assert seconds == answers.SECONDS


def test_angle_to_compute_before_exercise_2_is_right():
    words = flat("09", "yourturn-2")
    assert r"the least S is where $\beta$ keeps its value of 120°" in words
    half, OA, KO, one, two, alpha = numbers(
        r"OA = 2L\\sin (\S+)° = (\S+)\$ m and \$KO = (\S+)\$ m\. The angle at A is (\S+)° in the "
        r"triangle O, B, A and (\S+)° in O, A, K, so \$\\alpha = (\S+)°\$",
        words,
    )
    S, q = least_from(FIRST, STAND)
    assert q[1] == pytest.approx(STAND[1], abs=1e-6) and q[2] / deg == pytest.approx(
        alpha, abs=0.05
    )
    B = np.exp(1j * q[0])
    A = B + np.exp(1j * (q[0] + q[1] - np.pi))
    assert half == 60 and [abs(A), abs(FIRST)] == pytest.approx([OA, KO], abs=5e-4)
    at_A = [abs(np.angle((x - A) / -A)) / deg for x in (B, FIRST)]
    assert at_A == pytest.approx([one, two], abs=0.05) and one + two == pytest.approx(alpha)


def test_folded_arm_is_nearer_to_the_base_than_a_lever():
    *q, far = numbers(
        r"Set `q_deg = \[(\d+), (\d+), (\d+)\]` in section 1: the arm folds, and K is (\S+) m from "
        r"the base, less than \$L\$",
        flat("09", "folded-look"),
    )
    assert f"[{q[0]:.0f}, {q[1]:.0f}, {q[2]:.0f}]" in cells("09")["chain-code"]
    assert abs(gripper(np.array(q) * deg)) == pytest.approx(far, abs=0.005)


def test_weights_reduce_the_change_of_gamma_by_the_stated_amount():
    after, before = numbers(
        r"turns by (\S+)° instead of (\S+)°\.", flat("09", "deeper-more").replace("$", "")
    )
    start, K = np.array([100, 110, 120]) * deg, complex(1.8, 0.6)
    alphas = np.linspace(*ends(K), 20001)
    change = abs(in_circles(K, alphas) - start)
    heavy = np.array([27, 8, 1])  # moments of inertia of the stretched arm: 9, 8/3 and 1/3
    turns = [change[(change @ w).argmin(), 0] / deg for w in (heavy, np.ones(3))]
    assert turns == pytest.approx([after, before], abs=0.05)


def test_rounds_repeat_or_drift_as_stated():
    words = flat("09", "deeper-more")
    assert (
        "For 19 of them, the postures were repeating by the seventh round at the latest." in words
    )
    assert "For one list, they were still changing after fourteen rounds." in words
    rng, settled = np.random.default_rng(0), []
    while len(settled) < 20:
        r, phi = rng.uniform(1.2, 2.8, 5), rng.uniform(0, 120, 5) * deg
        places = np.stack([r * np.cos(phi), r * np.sin(phi)], axis=-1)
        if np.isnan(ARM.alpha_range(places)[0]).any():
            continue
        q, rounds = np.array([90, 120, 120]) * deg, []
        for _ in range(14):
            rounds.append([q := ARM.least(K, q)[0] for K in places])
        change = abs(np.diff(rounds, axis=0)).max(axis=(1, 2)) / deg
        moving = change > 1e-6
        assert (moving[1:] <= moving[:-1]).all(), (
            "the arm changes again after a round without a change"
        )
        settled.append(1 + int(moving.sum()))
    assert sorted(settled)[-2:] == [7, 14]


def test_pair_that_planning_cannot_improve_turns_only_gamma_in_its_second_task():
    words = flat("09", "greed-hand")
    assert "its targets are equally far from O, so task 2 turns $\\gamma$ alone" in words
    made = quietly("09", "greed-code")
    pair = [
        FIRST,
        complex(*said("09", "greed-code", r"# try \[\(2\.4, 0\.4\), \((\S+), (\S+)\)\]")),
    ]
    assert abs(pair[0]) == pytest.approx(abs(pair[1]), abs=1e-12)
    places = [(K.real, K.imag) for K in pair]
    greedy = made["one_by_one"](STAND, places)
    turned = abs(greedy[2] - greedy[1])
    assert turned[0] == pytest.approx(np.pi / 2) and turned[1:].max() < 1e-6
    # every plan of a fine grid
    first, second = (in_circles(K, np.linspace(*ends(K), 241)) for K in pair)
    turns = abs(first[:, None] - second).sum(axis=-1) + abs(first - STAND).sum(axis=-1)[:, None]
    assert turns.min() > abs(np.diff(greedy, axis=0)).sum() - 1e-6


def test_time_of_section_5_is_that_of_the_slowest_joint():
    source = cells("09")["cost-time"]
    assert "speeds = [30, 30, 30]  # try [30, 30, 60], [30, 60, 30]" in source
    made = quietly("09", "cost-time")
    alphas = np.linspace(*ends(FIRST), 40001)
    change = abs(in_circles(FIRST, alphas) - STAND) / deg
    assert made["T"].min() == pytest.approx(change.max(axis=1).min() / 30, abs=1e-3)
    assert made["T_least"] == pytest.approx(
        abs(least_from(FIRST, STAND)[1] - STAND).max() / deg / 30, abs=1e-4
    )


def test_wrong_programs_of_exercise_2_are_on_and_off_the_curve():
    words = flat("09", "yourturn-3")
    assert "they choose a different point on the curve S" in words
    assert "Others miss K or exceed a limit, so their postures are not on the curve." in words
    rng, tasks = np.random.default_rng(7), []
    while len(tasks) < 12:
        K = rng.uniform(1.1, 2.9) * np.exp(1j * rng.uniform(0, 145) * deg)
        if np.isfinite(ARM.alpha_range((K.real, K.imag))[0]):
            tasks.append((K, rng.uniform(20, 170, 3) * deg))
    on = []
    exercise = book.find("three_levers.2", "exercises")
    for _, _, text in exercise.wrongs:
        program = exercise.program(text)
        found = [np.asarray(program(np.array([K.real, K.imag]), q), dtype=float) for K, q in tasks]
        on.append(
            all(
                q.min() > -1e-9 and q.max() < np.pi + 1e-9 and abs(gripper(q) - K) < 1e-6
                for q, (K, _) in zip(found, tasks, strict=True)
            )
        )
    assert sum(on) > len(on) / 2 and len(on) - sum(on) >= 7


def test_most_postures_of_a_program_without_the_limit_of_gamma_are_within_it():
    exercise = book.find("three_levers.2", "exercises")
    ((_, words, text),) = [each for each in exercise.wrongs if "limit of gamma" in each[0]]
    low, high = numbers(r"directions of (\S+)° to (\S+)°\)", words)
    assert "even there, most of its postures are within the limits" in " ".join(words.split())
    program, rng, past = exercise.program(text), np.random.default_rng(8), []
    while len(past) < 100:
        K = rng.uniform(1.1, 2.9) * np.exp(1j * rng.uniform(low, high) * deg)
        if np.isfinite(ARM.alpha_range((K.real, K.imag))[0]):
            q = program(np.array([K.real, K.imag]), rng.uniform(20, 170, 3) * deg)
            past.append(q[0] > np.pi + 1e-6)
    assert 0.05 < np.mean(past) < 0.5
