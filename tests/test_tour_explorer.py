"""The tour explorer: Python's answers to random tasks, the page's tours in the reader's order, and
the view in JupyterLab with a kernel and in a file without one.
"""

import itertools
import json
import math
import re

import nbformat
import numpy as np
import pytest

from robokin import spbu_arm
from robokin.jobs.visit_collect import Task, best_visit, collect, visit, workspace
from robokin.show import live, tour_explorer
from robokin.show.joiner import script
from robokin.show.tour_explorer import WHILE_HELD, answered

SPEEDS = np.array([0.2, 0.2, 0.2])
FOUR = 4 * np.array([[np.cos(a), np.sin(a), 0.5] for a in (0, 1.0, -1.1, -1.2, -1.3)])
CIRCLE = Task(5, 4, 7.5, SPEEDS, FOUR[0], FOUR[1:], "visit")


def asked(**changes):
    opening = {"l1": 5.0, "l2": 4.0, "T": 7.5, "kind": "visit", "held": False}
    return opening | {"p0": FOUR[0].tolist(), "points": FOUR[1:].tolist()} | changes


def some(rng, count):
    """Random points around an arm with a reach of 9 m, some of them out of reach."""
    return rng.uniform([-8, -8, -1], [8, 8, 6], size=(count, 3))


# --- Answers from Python --------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["visit", "collect"])
def test_random_tasks_with_unreachable_points_are_answered(kind):
    rng, tours, away, lost = np.random.default_rng(15), 0, 0, 0
    for _ in range(150):
        l1, l2, T = rng.uniform([0.5, 0.5, 0], [9, 9, 60])
        p0, *points = some(rng, rng.integers(2, 10)).tolist()
        question = asked(l1=l1, l2=l2, T=T, kind=kind, p0=p0, points=points)
        told = answered(question, SPEEDS)
        inside = workspace(l1, l2, [p0, *points]).all(axis=-1)
        assert (told["start"], told["reached"]) == (inside[0], inside[1:].tolist())
        named = [note.split(" is ")[0] for note in told["notes"] if " the tool dips " not in note]
        names = ["p0", *(f"Point {i}" for i in range(len(points)))]
        assert named == [name for name, fine in zip(names, inside, strict=True) if not fine]
        away += not inside.all()
        if not (inside[0] and inside[1:].any()):
            assert told["greedy"] is told["best"] is None
            continue
        tours += 1
        for tour in (told["greedy"], told["best"]):
            assert len(set(tour["order"])) == len(tour["order"])
            assert all(inside[1 + i] for i in tour["order"])
            assert (np.diff([0, *tour["times"]]) >= 0).all()
            assert tour["t"][-1] <= T * (1 + 1e-6)
            # the arm stops at the correct places at the reported times
            stops = spbu_arm(l1, l2).fk(tour["q"].astype(float)).translation
            step = 2 if kind == "collect" else 1
            assert np.allclose(stops[::step][0], p0, rtol=0, atol=1e-5)
            served = np.array(points)[tour["order"]].reshape(-1, 3)
            assert np.allclose(stops[1::step], served, rtol=0, atol=1e-5)
            assert np.allclose(tour["t"][step::step], tour["times"], rtol=0, atol=1e-5)
        few, many = len(told["greedy"]["order"]), len(told["best"]["order"])
        assert many >= few
        if many == few and few:
            assert told["best"]["times"][-1] <= told["greedy"]["times"][-1] + 1e-9
        lost += many > few
    assert tours > 30 and away > 100, "too few cases"
    assert (lost > 3) == (kind == "visit"), "cheapest first is optimal, but nearest first is not"


def test_tours_match_those_of_the_package_for_the_points_in_reach():
    points = [[2, 3, 2], [20, 0, 0], [1, 3, 3], [-4, 1, 3], [0, 5, -1], [4, -3, 1]]
    question, kept = asked(points=points, T=40), [0, 2, 3, 5]
    for kind, rules in {"visit": (visit, best_visit), "collect": (collect, collect)}.items():
        told = answered(question | {"kind": kind}, SPEEDS)
        task = Task(5, 4, 40, SPEEDS, FOUR[0], [points[i] for i in kept], kind)
        for name, rule in zip(("greedy", "best"), rules, strict=True):
            result = rule(task)
            assert told[name]["order"] == [kept[i] for i in result.order]
            assert told[name]["times"] == list(result.times)


def test_best_order_of_many_points_is_computed_only_after_release():
    rng = np.random.default_rng(4)
    cloud = some(rng, 60)
    cloud = cloud[workspace(5, 4, cloud).all(axis=-1)][: WHILE_HELD + 1].tolist()
    for count, held in itertools.product((WHILE_HELD, WHILE_HELD + 1), (False, True)):
        told = answered(asked(points=cloud[:count], T=25, held=held), SPEEDS)
        assert (told["best"] is None) == (held and count > WHILE_HELD)
        assert ("let go" in told["says"]) == (told["best"] is None)


def test_loss_of_the_greedy_tour_is_reported():
    # errata S0-q: going to the nearest point first costs two points
    said = answered(asked(), SPEEDS)["says"]
    assert said == "Greed loses 2 points: nearest first visits 1 of 4, and the best order 3."
    assert "loses nothing" in answered(asked(T=20), SPEEDS)["says"]
    assert "loses no points, but it loses 9.50 s" in answered(asked(T=16.2), SPEEDS)["says"]
    away = asked(points=[*FOUR[1:].tolist(), [0, 0, 12]])
    assert "3 in reach" not in answered(away, SPEEDS)["says"]
    assert "1 of 4 in reach" in answered(away, SPEEDS)["says"]


def test_no_best_collecting_order_is_given_for_a_start_on_axis_1():
    told = answered(asked(kind="collect", p0=[0, 0, 6.5], T=60), SPEEDS)
    assert told["best"] is None and "on axis 1" in told["says"] and told["greedy"]["order"]
    assert answered(asked(p0=[0, 0, 6.5], T=60), SPEEDS)["best"]["order"]


def test_tour_below_the_floor_is_reported_with_its_depth():
    # errata S0-u
    low = asked(p0=[6, 0, 1], points=[[1.05, 0, 0.1]], T=60)
    wanted = "Between p0 and point 0 the tool dips under the floor, down to −1.02 m."
    assert answered(low, SPEEDS)["notes"] == [wanted]
    assert answered(low | {"kind": "collect"}, SPEEDS)["notes"] == [wanted], (
        "wanted a single report"
    )
    assert answered(low | {"l1": 4.0, "l2": 5.0}, SPEEDS)["notes"] == [], (
        "the tool never dips for l1 <= l2"
    )


def test_stored_output_is_small_and_has_alt_text():
    explorer = tour_explorer(CIRCLE)
    assert len(explorer.html) < 59_000
    assert "Greed loses 2 points" in explorer.data["alt"] and explorer.data["alt"] in explorer.html
    assert explorer.still.alt == explorer.data["alt"]


def test_best_order_is_hidden_until_the_reader_has_an_order():
    explorer = tour_explorer(CIRCLE, best=False)
    wanted = (
        "Nearest first visits 1 of 4. The best order appears when all points are in your order."
    )
    assert explorer.still.alt == explorer.data["alt"] == f"An arm and 4 points. {wanted}"
    assert explorer.still.texts[0].get_text() == "Nearest first visits 1 of 4."
    for best in (1, "no", None, np.array([True])):
        with pytest.raises(ValueError, match="best: wanted True or False, got"):
            tour_explorer(CIRCLE, best=best)


@pytest.mark.parametrize(
    "task",
    [
        Task(5, 4, 0, SPEEDS, FOUR[0], FOUR[1:], "visit"),
        Task(5, 4, 60, SPEEDS, [0, 0, 6.5], FOUR[1:], "collect"),
        Task(0.5, 8, 20, SPEEDS, [0, 8, 1], [[8, 0, 1]], "visit"),
        Task(0.005, 0.004, 60, SPEEDS, FOUR[0] / 1000, FOUR[1:] / 1000, "visit"),
    ],
    ids=["no time", "p0 on axis 1", "a short link", "millimetres"],
)
def test_explorer_opens_with_any_task(task):
    explorer = tour_explorer(task)
    low, high = ([spec[key] for spec in explorer.data["controls"]] for key in ("low", "high"))
    size = explorer.data["unit"]["size"]
    for value, least, most in zip((task.l1 / size, task.l2 / size, task.T), low, high, strict=True):
        assert least <= value <= most
    added = asked(l1=task.l1, l2=task.l2, p0=task.p0.tolist(), points=explorer.data["spare"])
    assert sum(answered(added, SPEEDS)["reached"]) >= 10, (
        "the points that can be added must be reachable"
    )
    assert len(explorer.html) < 62_000


# --- Tours in the reader's order, which the page computes -----------------------------------------


def by_hand(question, order):
    """Return the points of a tour with their times. A free joint (NaN) keeps its previous value."""
    served = workspace(question["l1"], question["l2"], question["points"]).all(axis=-1)
    task = Task(*(question[key] for key in ("l1", "l2", "T")), SPEEDS, question["p0"],
                np.array(question["points"])[served], question["kind"])  # fmt: skip
    rows = dict(zip(np.flatnonzero(served).tolist(), task.q[1:], strict=True))
    order = [k for k in order if served[k]]
    stops = [task.q[0]]
    for k in order:
        stops += [rows[k], task.q[0]] if task.kind == "collect" else [rows[k]]
    spent, moves = 0.0, []
    now = [next((q[j] for q in stops if not np.isnan(q[j])), 0.0) for j in range(3)]
    for q in stops:
        new = [a if np.isnan(b) else b for a, b in zip(now, q, strict=True)]
        spent += max(abs(a - b) / v for a, b, v in zip(new, now, SPEEDS, strict=True))
        now = new
        moves.append(spent)
    return list(zip(order, moves[2::2] if task.kind == "collect" else moves[1:], strict=True))


def test_page_times_of_1000_orders_match_python(browser):
    page, rng = opened(browser), np.random.default_rng(21)
    page.goto("about:blank")
    page.add_script_tag(content=f"{script('own_tour')}\nwindow.found = $own_tour.found;")
    page_data = tour_explorer(CIRCLE).data
    data = {key: page_data[key] for key in ("words", "slack")} | {"speeds": SPEEDS.tolist()}
    calls, wanted, on_axis = [], [], 0
    while len(calls) < 1000:
        points = some(rng, rng.integers(2, 9)).round(3)
        points[rng.uniform(size=len(points)) < 0.2, :2] = 0
        p0 = [0, 0, 6.5] if rng.uniform() < 0.1 else [4, 0, 2]
        kind = ("visit", "collect")[len(calls) % 2]
        question = asked(T=rng.uniform(5, 60), kind=kind, p0=p0, points=points.tolist())
        if not workspace(5, 4, points).all(axis=-1).any():
            continue
        order = rng.permutation(len(points))[: rng.integers(1, len(points) + 1)].tolist()
        told = live.stored(*live.split_arrays(answered(question, SPEEDS)))
        told |= {"greedy": None, "best": None}
        calls.append([data, {"order": order, "best": True}, {"answer": told, "question": question}])
        wanted.append(by_hand(question, order))
        on_axis += any(math.hypot(*points[k][:2]) == 0 for k, _ in wanted[-1])
    got = page.evaluate("all => all.map(each => window.found(...each))", calls)
    page.close()
    late = 0
    for (*_, heard), made, reached in zip(calls, got, wanted, strict=True):
        T, (_, _, mine), (_, _, cells) = heard["question"]["T"], made["tours"], made["cells"]
        if not reached:
            assert mine is None and cells[0] == "–"
            continue
        told = re.findall(r"(\d+)\xa0\(([\d.]+)\)", cells[0])
        assert [int(k) for k, _ in told] == [k for k, _ in reached]
        assert [float(t) for _, t in told] == pytest.approx([t for _, t in reached], abs=0.00501)
        fit = [(k, t) for k, t in reached if t <= T]
        assert mine["order"] == [k for k, _ in fit] and cells[1] == str(len(fit))
        assert mine["times"] == pytest.approx([t for _, t in fit], abs=1e-9)
        assert ("too late: " in cells[0]) == (len(fit) < len(reached))
        assert float(cells[2]) == pytest.approx(fit[-1][1] if fit else 0, abs=0.00501)
        late += len(fit) < len(reached)
    assert on_axis > 100 and 200 < late < 900, "too few cases"


# --- The explorer in a page -----------------------------------------------------------------------

FRAMES = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
COPIES = """
const clipboard = {writeText: async text => { window.copied = text; }};
Object.defineProperty(navigator, "clipboard", {value: clipboard});
"""


def opened(browser, width=1366):
    page = browser.new_page(viewport={"width": width, "height": 900})
    page.complaints = []
    page.on("pageerror", lambda error: page.complaints.append(str(error)))
    page.on(
        "console",
        lambda line: (
            line.type == "error" and page.complaints.append(f"{line.text} {line.location}")
        ),
    )
    page.add_init_script(COPIES)
    return page


def cells(page):
    """Return the cells of the table: rows for the greedy, the best and the reader's tour."""
    rows = page.locator(".rk-tours tbody tr")
    return [
        [cell.replace("\xa0", " ") for cell in row.locator("td").all_inner_texts()]
        for row in rows.all()
    ]


def handle(page, name):
    return page.locator(f"[data-handle='{name}']")


def test_only_the_clock_and_taps_work_in_a_saved_page(browser, tmp_path):
    tour_explorer(CIRCLE).save(tmp_path / "tour.html")
    page = opened(browser, 390)
    page.goto(f"file://{tmp_path}/tour.html")
    page.locator(".rk-asleep", has_text="Inactive").wait_for()
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    greedy, best = visit(CIRCLE), best_visit(CIRCLE)
    assert [row[1:] for row in cells(page)[:2]] == [
        [str(len(r.order)), f"{r.time:.2f}"] for r in (greedy, best)
    ]
    assert page.locator(".rk-side").evaluate("e => e.inert")
    # without Python, no point moves
    one, place = handle(page, "1"), handle(page, "1").get_attribute("aria-label")
    box = one.bounding_box()
    page.mouse.move(box["x"] + 5, box["y"] + 5)
    page.mouse.down()
    page.mouse.move(box["x"] + 60, box["y"] + 40)
    page.mouse.up()
    for key in ("ArrowUp", "Home"):
        one.press(key)
    page.evaluate(FRAMES)
    assert one.get_attribute("aria-label") == place and cells(page)[2][0] == "–"

    picture = "document.querySelector('.rk-scene').toDataURL()"
    scrub = page.get_by_role("slider", name="time")
    seen = set()
    for result, row in ((greedy, 0), (best, 1)):
        page.locator(".rk-choose").nth(row).click()
        for share in (0, 0.3, 0.75, 0.83, 1):
            scrub.fill(str(round(400 * share)))
            page.evaluate(FRAMES)
            seen.add(page.evaluate(picture))
            at = round(400 * share) / 400 * CIRCLE.T
            served = {i for i, t in zip(result.order, result.times, strict=True) if t <= at}
            full = page.locator(".rk-served").evaluate_all("all => all.map(e => +e.dataset.handle)")
            assert set(full) == served
    assert len(seen) == 7, (
        "wanted one picture at the start, two on the greedy tour and four on the best one"
    )
    scrub.fill("0")
    page.get_by_role("button", name="play").click()
    page.wait_for_function("+document.querySelector('.rk-clock input').value > 10")
    page.get_by_role("button", name="pause").click()
    assert not page.complaints
    page.close()


def test_taps_build_the_readers_order(browser, tmp_path):
    tour_explorer(CIRCLE, best=False).save(tmp_path / "tour.html")
    page = opened(browser)
    page.goto(f"file://{tmp_path}/tour.html")
    page.locator(".rk-asleep").wait_for()
    assert cells(page)[1:] == [["–"] * 3] * 2
    order = []
    for name, key in (("3", None), ("0", "Enter"), ("2", "Space"), ("0", None), ("1", None)):
        handle(page, name).press(key) if key else handle(page, name).click()
        page.evaluate(FRAMES)
        k = int(name)
        order = [each for each in order if each != k] if k in order else [*order, k]
        reached = by_hand(asked(), order)
        count = sum(t <= CIRCLE.T for _, t in reached)
        assert re.findall(r"(\d) \(", cells(page)[2][0]) == [str(each) for each in order]
        assert cells(page)[2][1:] == [str(count), f"{([0] + [t for _, t in reached])[count]:.2f}"]
        assert (
            page.locator(".rk-says").inner_text().startswith(f"Your order visits {count} of 4 in ")
        )
        assert cells(page)[1] == ["–"] * 3, "the best order appeared too early"
        said = page.locator(".rk-scene").get_attribute("aria-label")
        assert f"Your order visits {count} of 4 in " in said
        wanted = f"number {order.index(k) + 1} in your order" if k in order else "2.00 m"
        assert handle(page, name).get_attribute("aria-label").endswith(wanted)
    handle(page, "0").click()  # now the order contains all points
    page.evaluate(FRAMES)
    assert cells(page)[1] == told(CIRCLE, best_visit)[0]
    assert page.locator(".rk-says").inner_text().endswith("visits 1 of 4, and the best order 3.")
    page.get_by_role("button", name="Clear order").click()
    page.evaluate(FRAMES)
    assert cells(page)[2] == ["–"] * 3 and cells(page)[1] == told(CIRCLE, best_visit)[0]
    assert not page.complaints
    page.close()


def test_view_with_a_kernel_agrees_with_python(browser, jupyter):
    code = f"""
import numpy as np
from robokin.jobs.visit_collect import Task
from robokin.show import tour_explorer
tour_explorer(Task(5, 4, 7.5, [0.2] * 3, {FOUR[0].tolist()}, {FOUR[1:].tolist()}, "visit"))"""
    v4 = nbformat.v4
    lab = v4.new_notebook(
        cells=[v4.new_markdown_cell("# Tours", id="head"), v4.new_code_cell(code, id="tours")],
        metadata={
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}
        },
    )
    nbformat.write(lab, jupyter.labs / "tours.ipynb")
    page = opened(browser)
    jupyter.open(page, "tours.ipynb")
    jupyter.run_all(page, "tours.ipynb")
    root = page.locator(".robokin-player[data-awake]")
    root.wait_for()
    # use the same view throughout, since a view that JupyterLab recreates has the initial values
    root.evaluate("root => root.setAttribute('data-held', '')")
    root = page.locator(".robokin-player[data-awake][data-held]")
    before = len(page.complaints)  # JupyterLab's own errors
    _drags(page, root)
    _typed(page, root)
    _out_of_reach(page, root)
    _many(page, root)
    assert page.complaints[before:] == []
    page.close()


# A kernel that answers at the times and in the order that the test chooses.
WAKE = """root => root.dispatchEvent(new CustomEvent("robokin-wake", {
  detail: (n, question) => (window.asked ||= []).push({n, question}),
}))"""
ANSWER = """(root, detail) =>
  root.dispatchEvent(new CustomEvent("robokin-answer", {detail: {...detail, buffers: []}}))"""


@pytest.fixture
def slow(browser, tmp_path):
    """An active explorer: its page, its element, a function that returns the questions so far, and
    a function that answers one of them.
    """
    tour_explorer(CIRCLE).save(tmp_path / "tour.html")
    page = opened(browser)
    page.goto(f"file://{tmp_path}/tour.html")
    root = page.locator(".robokin-player")
    page.locator(".rk-asleep").wait_for()
    root.evaluate(WAKE)

    def asked():
        page.evaluate(FRAMES)
        return page.evaluate("window.asked || []")

    def answer(one):
        content = live.stored(*live.split_arrays(answered(one["question"], SPEEDS)))
        root.evaluate(ANSWER, {"n": one["n"], "answer": content})
        page.evaluate(FRAMES)

    yield page, root, asked, answer
    assert not page.complaints
    page.close()


def typed(page, label, value):
    box = page.get_by_label(label)
    box.fill(value)
    assert box.input_value() == value, "something else has the focus"
    box.press("Enter")


def test_late_answer_does_not_undo_changes(slow):
    page, _, asked, answer = slow
    typed(page, "T, s, exactly", "29")
    typed(page, "L1, m, exactly", "4.5")
    early = asked()
    typed(page, "L2, m, exactly", "4.2")
    for one in early:
        answer(one)
        task = shown_task(page)
        assert (task.T, task.l1, task.l2) == (29, 4.5, 4.2)
    last = asked()[-1]
    assert [last["question"][key] for key in ("T", "l1", "l2")] == [29, 4.5, 4.2]
    answer(last)
    answer(early[0])
    task = shown_task(page)
    assert (task.T, task.l1, task.l2) == (29, 4.5, 4.2)
    assert cells(page)[:2] == told(task, visit, best_visit)


@pytest.mark.parametrize("between", ["sleeps", "wakes twice"])
def test_unanswered_questions_are_repeated(slow, between):
    """If they were not repeated, the tours would not match the points shown until the next move."""
    page, root, asked, answer = slow
    typed(page, "T, s, exactly", "29")
    (lost,) = asked()
    if between == "sleeps":
        root.evaluate("root => root.dispatchEvent(new CustomEvent('robokin-sleep'))")
    root.evaluate(WAKE)
    again = asked()[1:]
    assert [one["question"] for one in again] == [lost["question"]]
    answer(again[0])
    assert cells(page)[:2] == told(shown_task(page), visit, best_visit)
    root.evaluate(WAKE)
    assert len(asked()) == 2, "answered questions are not asked again"


def settled(page, root):
    """Wait until the last question is asked, answered and shown."""
    page.evaluate(FRAMES)
    page.wait_for_function(
        "root => root.dataset.asked === root.dataset.answered", arg=root.element_handle()
    )
    page.evaluate(FRAMES)


def shown_task(page):
    """The task that the page shows, read with its button "Copy as Python"."""
    page.evaluate("window.copied = null")
    page.get_by_role("button", name="Copy as Python").click()
    space = {}
    exec(page.wait_for_function("window.copied").json_value(), space)
    return space["task"]


def told(task, *rules):
    rows = []
    for rule in rules:
        result = rule(task)
        order = ", ".join(f"{i} ({t:.2f})" for i, t in zip(result.order, result.times, strict=True))
        rows.append([order or "–", str(len(result.order)), f"{result.time:.2f}"])
    return rows


def drag(page, root, name, dx, dy, drop=True):
    box = handle(page, name).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(1, 9):
        page.mouse.move(x + dx * k / 8, y + dy * k / 8)
        page.wait_for_timeout(12)
    if drop:
        page.mouse.up()
    settled(page, root)


def _drags(page, root):
    seen = [cells(page)]
    for name, dx, dy in (("3", -60, -20), ("3", 150, 10), ("p0", 40, -30), ("0", -30, -40)):
        was = handle(page, name).bounding_box()
        drag(page, root, name, dx, dy)
        task = shown_task(page)
        assert cells(page)[:2] == told(task, visit, best_visit)
        seen.append(cells(page))
        assert handle(page, name).bounding_box() != was
    assert len({json.dumps(each) for each in seen}) == 5, "nothing followed the pointer"


def _typed(page, root):
    for label, value in (
        ("T, s, exactly", "29"),
        ("L1, m, exactly", "4.5"),
        ("L2, m, exactly", "4.2"),
    ):
        typed(page, label, value)
        settled(page, root)
    task = shown_task(page)
    assert (task.T, task.l1, task.l2) == (29, 4.5, 4.2)
    assert cells(page)[:2] == told(task, visit, best_visit)
    page.get_by_label("task").select_option("1")
    settled(page, root)
    task = shown_task(page)
    assert task.kind == "collect" and cells(page)[:2] == told(task, collect, collect)
    page.get_by_label("task").select_option("0")
    handle(page, "1").focus()
    for key in ("ArrowUp", "Shift+ArrowLeft", "ArrowRight"):
        handle(page, "1").press(key)
    settled(page, root)
    moved = shown_task(page)
    assert not np.allclose(moved.points[1], task.points[1])
    assert cells(page)[:2] == told(moved, visit, best_visit)
    handle(page, "1").press("Home")
    settled(page, root)
    assert np.allclose(shown_task(page).points[1], FOUR[2], rtol=0, atol=1e-4)


def _out_of_reach(page, root):
    within = shown_task(page)
    drag(page, root, "2", 10, 190, drop=False)
    assert "rk-away" in handle(page, "2").get_attribute("class")
    assert (
        page.locator(".rk-notes li")
        .first.inner_text()
        .startswith("Point 2 is under the floor: z = −")
    )
    rest = Task(
        within.l1,
        within.l2,
        within.T,
        SPEEDS,
        within.p0,
        np.delete(within.points, 2, axis=0),
        "visit",
    )
    renumbered = {0: 0, 1: 1, 2: 3}
    for row, rule in zip(cells(page)[:2], (visit, best_visit), strict=True):
        order = [int(i) for i in re.findall(r"(\d+) \(", row[0])]
        assert order == [renumbered[i] for i in rule(rest).order]
    page.mouse.up()
    handle(page, "2").press("Home")
    settled(page, root)
    assert page.locator(".rk-notes li").count() == 0
    drag(page, root, "p0", 0, 250)
    assert page.locator(".rk-says").inner_text() == "There is no tour."
    assert [row[0] for row in cells(page)] == ["–"] * 3
    handle(page, "p0").press("Home")
    settled(page, root)


def _many(page, root):
    while page.get_by_role("button", name="Add a point").is_enabled():
        page.get_by_role("button", name="Add a point").click()
        settled(page, root)
    task = shown_task(page)
    assert len(task.points) == 12 and cells(page)[:2] == told(task, visit, best_visit)
    drag(page, root, "4", 15, 12, drop=False)
    assert cells(page)[1] == ["–"] * 3 and "let go" in page.locator(".rk-says").inner_text()
    page.mouse.up()
    settled(page, root)
    task = shown_task(page)
    assert cells(page)[:2] == told(task, visit, best_visit)
    for left in (11, 10):
        page.get_by_role("button", name="Remove point").click()
        settled(page, root)
        assert handle(page, str(left - 1)).count() and not handle(page, str(left)).count()
    drag(page, root, "1", 25, 8, drop=False)
    assert cells(page)[1][0] != "–", "no best order of ten points while one is held"
    page.mouse.up()
    settled(page, root)
    assert cells(page)[:2] == told(shown_task(page), visit, best_visit)
