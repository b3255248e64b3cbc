"""The tour explorer. The reader changes the points, the start and the links, and chooses an order
of the points; Python computes the greedy tour and the best one.

The page draws, and asks a kernel whenever something moves (see `live`). The tour in the reader's
order is computed in the page. As in a `Task`, points are numbered from 0. All the text of the page
is in this module.
"""

import re
from collections.abc import Sequence

import numpy as np

from .._arrays import Bools, Floats, Ints
from .._validate import instance, short
from ..arms import Arm, spbu_arm
from ..arms.geometry import ROUNDING
from ..jobs.visit_collect import (
    Result,
    Task,
    best_visit,
    collect,
    itinerary,
    lowest,
    out_of_workspace,
    visit,
    workspace,
)
from ..jobs.visit_collect.arm import UNDER
from ..units import deg, length_unit
from . import plots
from .camera import best_view, chain, extent, scene_data
from .explorer import control
from .explorer_page import TourPage
from .live import Answer, Live, Question
from .numbers import rounded
from .page import PageScene
from .palette import INK, JOINT_STYLES
from .scene import Scene
from .things import Mark

MOST = 12  # maximum number of points: the page stays legible, and the best order takes about 10 ms
WHILE_HELD = 10  # with more points, the best order is computed only after the reader lets go
KINDS = ("visit", "collect")
TOURS = ("greedy", "best", "yours")
GREEDY, BEST = JOINT_STYLES[1]["color"], JOINT_STYLES[0]["color"]
WORDS = {
    "task": "task",
    "tour": "tour",
    "order": "order and times (s)",
    "visit": "Your order visits {count} of {n} in {t} s.",
    "collect": "Your order brings {count} of {n} in {t} s.",
    "late": "too late:",
    "rank": ", number {rank} in your order",
    "clear": "Clear order",
    "veiled": "The best order appears when all points are in your order.",
    "scene": "An arm and {n} points.",
    "asleep": "Inactive: moving the points needs Python. Run this cell to activate it. Until then, "
    "you can tap the points in your own order, and play the tours.",
    "count": "within T",
    "time": "time, s",
    "add": "Add a point",
    "remove": "Remove point {k}",
    "copy": "Copy as Python",
    "copied": "Copied",
    "takeStart": "p0, in the plane of the screen",
    "takePoint": "point {k}, in the plane of the screen",
    "away": "out of reach",
}
MEANT = (
    "Tap the points in your own order, or drag them. Tap a point again to remove it from "
    "your order. A drag moves a point or p0 in the plane of the screen; turn the view for "
    "another direction. Click a row of the table to choose its tour. The dotted circle "
    "shows how far the arm reaches on the floor; a wide red band shows where the tool dips under "
    "the floor."
)


def tour_explorer(task: Task, *, best: bool = True) -> Live:
    """Show the start and the points of a task, which the reader can drag, with sliders for the
    links and the time and a menu for visit or collect. The page draws the greedy tour (`visit`,
    `collect`), the best one (`best_visit`) and the one in the order in which the reader taps the
    points, as paths of the tool. It compares them in a table, and has a clock that moves the arm
    along any of them. With `best=False`, the best tour appears once all points are in the reader's
    order.

    The explorer asks the kernel (see `live`); the reader's order and the clock also work without a
    kernel. Raises TypeError if `task` is not a Task, and ValueError if it has more than MOST points
    or `best` is not a bool.
    """
    count = len(instance(task, Task, "task").points)
    if count > MOST:
        raise ValueError(f"task: wanted at most {MOST} points, got {count}")
    if not isinstance(best, bool):
        raise ValueError(f"best: wanted True or False, got {short(best)}")

    def answer(question: Question) -> Answer:
        return answered(question, task.speeds)

    first: Question = {
        "l1": task.l1,
        "l2": task.l2,
        "T": task.T,
        "kind": task.kind,
        "p0": task.p0.tolist(),
        "points": task.points.tolist(),
        "held": False,
    }
    arm, told = spbu_arm(task.l1, task.l2), answer(first)
    if not best:
        told |= {"best": None, "says": f"{told['alone']} {WORDS['veiled']}"}
    name, size = length_unit(extent(arm))
    length = 1.0 if name == "m" else 10.0
    reach = extent(arm) / size
    least = min(0.1 * reach, task.l1 / size, task.l2 / size)
    alt = " ".join([WORDS["scene"].format(n=count), told["says"], *told["notes"]])
    still = _picture(alt, arm, task, told, told["says"] if best else told["alone"])
    data: TourPage = {
        "kind": "tour",
        "title": "Which order is best? Tap the points",
        "summary": alt,
        "alt": alt,
        "unit": {"name": name, "size": size, "code": name},
        "scene": _scene(arm, task),
        "controls": [
            control("L1", name, least, reach, 0.1 * length, 2),
            control("L2", name, least, reach, 0.1 * length, 2),
            control("T", "s", 0, max(10, np.ceil(task.T / 2.5) * 10), 0.1, 2),
        ],
        "words": WORDS,
        "kinds": list(KINDS),
        "tours": list(TOURS),
        "best": best,
        "speeds": task.speeds.tolist(),
        "slack": ROUNDING,
        "most": MOST,
        "spare": [rounded(p, 4) for p in _spare(task)],
        "meant": MEANT,
        "code": "from robokin.jobs.visit_collect import Task\n"
        f"task = Task({{l1}}, {{l2}}, T={{T}}, speeds={task.speeds.tolist()},\n"
        '            p0={p0},\n            points={points},\n            kind="{kind}")',
    }
    return Live(dict(data), still, first, answer)


def answered(question: Question, speeds: Floats) -> Answer:
    """Return the answer for a task that the reader has set up. Points out of reach are left out.

    question      l1, l2, T, kind, p0, points as in a `Task`; held: whether the reader is dragging
    speeds        (3,) greatest joint speeds, rad/s

    chain         the links of the arm, for the page's `frames`
    reached       whether each point is in the workspace
    start         whether p0 is in the workspace
    postures      the joint values of p0 and of each point; None: out of reach, or a free joint
    greedy, best  each tour: t (k,) and q (k, 3) at every stop, `order` and `times` of the points
                  served, `cells` of the table; None if there is no tour, or none yet
    says          what the greedy tour loses
    alone         a sentence: how many points the greedy tour visits or collects
    among         the number of points in reach, as text
    notes         the points out of reach, and where the tool dips below the floor
    """
    l1, l2 = question["l1"], question["l2"]
    points = np.array(question["points"], dtype=float).reshape(-1, 3)
    inside: Bools = np.all(workspace(l1, l2, np.vstack([question["p0"], points])), axis=-1)
    said: Answer = {
        "chain": chain(spbu_arm(l1, l2).links),
        "start": bool(inside[0]),
        "reached": inside[1:].tolist(),
        "postures": [None] * len(inside),
        "greedy": None,
        "best": None,
        "notes": _lost(l1, l2, question["p0"], points, inside),
    }
    served = np.flatnonzero(inside[1:])
    if not inside[0] or not len(served):
        none = "There is no tour."
        return said | {"says": none, "alone": none, "among": "0"}
    kind = question["kind"]
    task = Task(l1, l2, question["T"], speeds, question["p0"], points[served], kind)
    results = {"greedy": collect(task) if kind == "collect" else visit(task)}
    on_axis = bool(np.isnan(task.q[0]).any())
    if kind == "collect" and not on_axis:
        results["best"] = results["greedy"]  # the greedy choice is optimal: errata S0-r
    elif kind == "visit" and not (question["held"] and len(served) > WHILE_HELD):
        results["best"] = best_visit(task)
    for k, q in zip([0, *(served + 1)], task.q.tolist(), strict=True):
        said["postures"][k] = [None if np.isnan(x) else x for x in q]
    for name, result in results.items():
        said[name], dips = _tour(task, result, served)
        if dips and dips not in said["notes"]:
            said["notes"].append(dips)
    among = f"{len(served)}" if inside.all() else f"{len(served)} in reach"
    alone = _alone(task, results["greedy"], among)
    return said | {"says": _says(task, results, among), "alone": alone, "among": among}


# --- Sentences and tours for the page -------------------------------------------------------------


def _alone(task: Task, greedy: Result, n: str) -> str:
    """Say how many of the points the greedy tour visits or collects. `n` is their number."""
    does = "Cheapest first brings" if task.kind == "collect" else "Nearest first visits"
    return f"{does} {len(greedy.order)} of {n}."


def _says(task: Task, results: dict[str, Result], n: str) -> str:
    """Say in one sentence what the greedy tour loses; `n` is the number of points, as text."""
    greedy, best = results["greedy"], results.get("best")
    few = len(greedy.order)
    if task.kind == "collect":
        if best is None:
            return f"Cheapest first brings {few} of {n}; p0 is on axis 1: more may be possible."
        told = f"Cheapest first brings {few} of {n} in {greedy.time:.2f} s"
        return f"{told}; no choice brings more objects."
    if best is None:
        return f"{_alone(task, greedy, n)} The best order appears when you let go."
    if lost := len(best.order) - few:
        return (
            f"Greed loses {_points(lost)}: nearest first visits {few} of {n}, and the best order "
            f"{few + lost}."
        )
    late = greedy.time - best.time
    if round(late, 2):
        return f"Greed loses no points, but it loses {late:.2f} s: both visit {few} of {n}."
    return f"Greed loses nothing: nearest first visits {few} of {n}, and no order is better."


def _points(count: int) -> str:
    return f"{count} point{'s' if count > 1 else ''}"


def _lost(l1: float, l2: float, p0: Sequence[float], points: Floats, inside: Bools) -> list[str]:
    """Say why p0 and points are out of reach, to the precision of a drag."""

    def told(p: Sequence[float] | Floats) -> str:
        reasons = "; ".join(out_of_workspace(l1, l2, p))
        return re.sub(r"-?\d+\.\d+", lambda x: _number(float(x[0]), ".4g"), reasons)

    named = {"p0": p0} | {f"Point {i}": p for i, p in enumerate(points)}
    return [
        f"{name} {told(p)}."
        for (name, p), fine in zip(named.items(), inside, strict=True)
        if not fine
    ]


def _tour(task: Task, result: Result, served: Ints) -> tuple[Answer, str]:
    """Return a tour for the page, and a sentence that says where the tool dips deepest below the
    floor, or "".
    """
    t, q = itinerary(task, result)
    order = [int(served[i]) for i in result.order]
    stops = ["p0"]
    for i in order:
        stops += [f"point {i}", "p0"] if task.kind == "collect" else [f"point {i}"]
    z = lowest(task.l1, task.l2, q[:-1], q[1:])
    dips = ""
    if len(z) and z.min() < -UNDER * (task.l1 + task.l2):
        k = int(z.argmin())
        ends = " and ".join(sorted(stops[k : k + 2]))  # the path back has the same ends
        dips = f"Between {ends} the tool dips under the floor, down to {_number(z[k], '.2f')} m."
    parts = [f"{i}\N{NO-BREAK SPACE}({at:.2f})" for i, at in zip(order, result.times, strict=True)]
    tour = {
        "t": t.astype(np.float32),
        "q": q.astype(np.float32),
        "order": order,
        "times": list(result.times),
        "cells": [", ".join(parts) or "\N{EN DASH}", str(len(order)), f"{result.time:.2f}"],
    }
    return tour, dips


def _number(x: float, form: str) -> str:
    return f"{x:{form}}".replace("-", "\N{MINUS SIGN}")


# --- The scene and the still picture --------------------------------------------------------------


def _scene(arm: Arm, task: Task) -> PageScene:
    """Return a scene with room for the points and their surroundings, seen from their side. The
    picture zooms out for anything outside.
    """
    places = np.vstack([task.p0, task.points])
    ring = np.arange(0, 360, 30) * deg
    out = max(1.2 * np.hypot(*places.T[:2]).max(), 0.65 * extent(arm))
    around = out * np.stack([np.cos(ring), np.sin(ring), 0 * ring], axis=-1)
    marks = [Mark(p) for p in (*around, *places)]
    scene = scene_data([arm], [task.q[None, :1]], marks, extent(arm), solid=True, grows=True)
    scene["things"] = []  # the script of the page adds them
    scene["view"] = rounded([best_view(places, None)[0], 40 * deg], 4)
    return scene


def _spare(task: Task) -> Floats:
    """Return places (MOST, 3) for added points: all around the arm, each rotated by the golden
    angle from the previous one.
    """
    turn = np.arange(MOST) * np.pi * (3 - 5**0.5)
    rise = np.linspace(5, 55, MOST) * deg
    d = abs(task.l1 - task.l2) + 0.6 * (task.l1 + task.l2 - abs(task.l1 - task.l2))
    places: Floats = d * np.stack(
        [np.cos(turn) * np.cos(rise), np.sin(turn) * np.cos(rise), np.sin(rise)], axis=-1
    )
    return places


def _picture(alt: str, arm: Arm, task: Task, told: Answer, title: str) -> plots.Figure:
    """Draw the arm at the start, and the tours in `told`, under a title of one line."""
    fig = plots.figure(alt, width=6.4, height=4.5)
    fig.text(0.016, 0.985, title, fontsize=10, fontweight="bold", va="top")
    scene = Scene(fig.add_axes((0, 0, 1, 0.93)), size=extent(arm), like=_scene(arm, task))
    scene.base()
    scene.arm(arm, told["greedy"]["q"][0].astype(float), "first")
    for name, color, style in (("best", BEST, "-"), ("greedy", GREEDY, (0, (4, 2)))):
        if told[name]:
            t, q = told[name]["t"], told[name]["q"].astype(float)
            share = np.linspace(0, t[-1], 400)
            ways = np.stack([np.interp(share, t, joint) for joint in q.T], axis=-1)
            scene.line(arm.fk(ways).translation, color=color, linewidth=2, linestyle=style)
    for name, p in zip(["p0", *map(str, range(MOST))], [task.p0, *task.points], strict=False):
        scene.drop(p)
        scene.line([p], linestyle="none", marker="o", color=INK, markersize=5)
        scene.label(name, p)
    scene.finish("dashed: greedy, solid: best")
    return fig
