"""The explorer of plans: an arm of three levers with a target and an obstacle to drag.

The page draws, and a kernel plans: see `live`. Next to the plane is the cube of all postures. It
shows the body of forbidden postures, and a breadth-first search that passes this body on its way to
the curve of the postures that reach the target. The cube has steps of `STEP` and is only for
display; `robokin.jobs.obstacles.plan` searches in finer steps.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from .._arrays import ArrayLike, Bools, Floats
from .._validate import floats, instance
from ..arms.planar import ThreeLeverArm
from ..jobs.obstacles import LEVERS, Plan, along, clearance, in_quadrilateral, plan, swept
from ..jobs.obstacles.posture_grid import NEVER, coarse_search
from ..jobs.obstacles.ways import nearest_approach, unchecked_path
from ..units import deg, in_words, length_unit, mm
from . import plots
from .camera import extent, project, scene_data
from .drawing import LineCollection, PolyCollection
from .explorer import control
from .explorer_page import PlanPage
from .live import Answer, Live, Question
from .palette import ALARM, INK, JOINT_STYLES, PALE, SOFT
from .things import Mark
from .twin import arm_data

SEEN = -1.6, 0.4  # azimuth and elevation of the camera of the cube, as in plan_cube.js
STEP = 12 * deg  # the step between neighbouring postures in the cube
MOMENTS = 41  # number of postures of a motion in the page data
FORBIDDEN, AWAY = 255, 254  # values of cells: too near the obstacle; free, but not reached
WAYS = ("the plan", "two via points", "direct")
UNCHECKED = {WAYS[1]: "via points", WAYS[2]: "direct"}  # the names that `unchecked_path` uses
TITLE = "From K to K1, past an obstacle H"
MEANT = (
    "Drag K, K1 and H, or move them with the arrow keys. The cube contains all postures in steps "
    "of 12° (the plan searches in finer ones). In the grey body, a lever is too near to H; the "
    "squares are the wave of the search (without a plan, there is none), the triangles are the "
    "target, and the line is the path."
)
WORDS: Mapping[str, str] = {
    "K": "K, where the gripper starts",
    "K1": "K1, the target",
    "H": "H, the obstacle",
    "way": "way",
    "quadrilaterals": "quadrilaterals",
    "search": "search",
    "steps": "{n} of {most} steps",
    "motion": "motion",
    "share": "{share} % of the way",
    "play": "Play",
    "pause": "Pause",
    "cube": "The cube of postures. Arrow keys turn it, and Home resets it.",
    "copy": "Copy as Python",
    "copied": "Copied",
}


def plan_explorer(
    arm: ThreeLeverArm, posture: ArrayLike, target: ArrayLike, obstacle: ArrayLike
) -> Live:
    """Show the start K, the target K1 and the obstacle H, which the reader can drag, and the
    distance that all levers must keep from H (a seventh of a lever at first). On every move, a
    kernel answers with the result of `plan`: the path and the reason for it, the area that the
    levers sweep, and where they come nearest to H. The reader can also ask for a motion through two
    via points or for the direct motion. The search can be played in the cube of postures, and the
    motion in the plane.

    posture (3,) in radians is the start; target and obstacle (2,) are in metres. Raises ValueError
    if `plan` refuses the arguments, and TypeError if the arm does not have three levers.
    """
    instance(arm, ThreeLeverArm, "arm")
    distance, H = arm.lever / 7, floats(obstacle, "obstacle")
    if H.ndim != 1:
        raise ValueError(f"obstacle: wanted one point (2,), got shape {H.shape}")
    known = plan(arm, posture, target, H, distance)
    start, K1 = floats(posture, "posture"), floats(target, "target")
    first = {
        "posture": start.tolist(),
        "target": K1[:2].tolist(),
        "obstacle": H[:2].tolist(),
        "distance": distance,
        "way": 0,
        "sides": False,
    }
    answer = _answer(arm, first)
    what = "a target and an obstacle that can be moved"
    summary = f"{arm.name}, {what}. {known.words} {answer['result']}"
    return Live(
        dict(_page(arm, first, known, summary)),
        _picture(arm, first, answer, summary),
        first,
        lambda question: _answer(arm, question),
    )


# --- The kernel's answer --------------------------------------------------------------------------


def _answer(arm: ThreeLeverArm, question: Question) -> Answer:
    """Return the answer that the page shows.

    result, words   the result in a sentence; the reason, in the words of `plan`
    way, kept       `way` of the plan; whether the path shown keeps the distance
    path            (k, 3) postures; only the start if the arm does not move
    moments         (MOMENTS, 3) postures along the path; the start twice if the arm does not move
    via             (k, 2) the gripper's via points
    nearest         where the levers come nearest to H: [the place on the lever, words]
    direct          the quadrilaterals AK and BA of the direct motion and a sentence about them;
                    None if the question does not ask for them, or if they do not exist
    cube            the number of search steps to each posture, or FORBIDDEN, or AWAY
    most, curve     the number of search steps to show; the postures (k, 3) that reach the target
    """
    start, K1, H = (np.array(question[key]) for key in ("posture", "target", "obstacle"))
    distance, way = question["distance"], WAYS[question["way"]]
    known = plan(arm, start, K1, H, distance)
    path, each = known.path, known.clearance
    if way != WAYS[0]:
        path = unchecked_path(arm, UNCHECKED[way], start, K1, H, distance)
        each = clearance(arm, path, H) if len(path) > 1 else each[:0]
    lever, near, place = nearest_approach(arm, path, each, H)
    result, kept = _result(known, way, path, lever, near, distance)
    by_points = way == WAYS[1] or (way == WAYS[0] and known.way == "via points")
    cube, most, curve = _cube(arm, known, start, K1, H, distance)
    return {
        "result": result,
        "words": known.words,
        "way": known.way,
        "kept": kept,
        "path": path.tolist(),
        "moments": _moments(path).astype(np.float32),
        "via": arm.points(path[1:-1])[:, 3].tolist() if by_points else [],
        "nearest": [place.tolist(), f"{LEVERS[lever]} {near / mm:.0f} mm"],
        "direct": _direct(arm, start, K1, H) if question["sides"] else None,
        "cube": cube,
        "most": most,
        "curve": curve.astype(np.float32),
    }


def _moments(path: Floats) -> Floats:
    if len(path) == 1:
        return np.repeat(path, 2, axis=0)
    return along(path, np.linspace(0, 1, MOMENTS))


def _result(
    known: Plan, way: str, path: Floats, lever: int, near: float, distance: float
) -> tuple[str, bool]:
    """Return the result in one sentence, and whether the distance is kept."""
    if len(path) == 1:
        some = "K2, K3 and K1 are not all within"
        out = "K1 is outside" if way == "direct" else some
        return (
            "No: the arm does not move." if way == WAYS[0] else f"No: {out} the allowed reach."
        ), False
    S = f"S = {abs(np.diff(path, axis=0)).sum() / deg:.0f}° (direct {known.least / deg:.0f}°)"
    far = f"comes within {in_words(near)} of H" if near else "hits H"
    kept = near >= distance
    name = known.way if way == WAYS[0] else f"{way}, {'safe' if kept else 'not safe'}"
    return f"{name[0].upper()}{name[1:]}: {S}, lever {LEVERS[lever]} {far}.", kept


def _direct(arm: ThreeLeverArm, start: Floats, target: Floats, H: Floats) -> dict[str, Any] | None:
    goal = arm.least(target, start)[0]
    if np.isnan(goal).any():
        return None
    (_, B, A, K), (_, B1, A1, K1) = arm.points(start), arm.points(goal)
    inside = [name for name, yes in in_quadrilateral(arm, start, goal, H).items() if yes]
    over = [name for name, yes in swept(arm, start, goal, H).items() if yes]
    lies = (
        f"H lies in the quadrilateral of {' and '.join(inside)}"
        if inside
        else ("H lies in neither quadrilateral")
    )
    passes = f"{' and '.join(over)} truly" if over else "no lever"
    return {
        "quadrilaterals": np.stack([[A, K, K1, A1], [B, A, A1, B1]]).tolist(),
        "says": f"{lies}; in the direct motion, {passes} "
        f"{'pass' if len(over) > 1 else 'passes'} over H.",
    }


def _cube(
    arm: ThreeLeverArm, known: Plan, start: Floats, K1: Floats, H: Floats, distance: float
) -> tuple[Any, int, Floats]:
    """Return the result of `coarse_search` for the page: the cube (n, n, n), the number of steps in
    which the search reaches the target's curve (or ends without reaching it), and the curve (k, 3).
    Without a plan, there are no steps: in steps of `STEP`, the search may find a way that is none.
    """
    steps, free, curve = coarse_search(arm, start, K1, H, distance, STEP)
    reached = (steps < NEVER) & known.found
    cube = np.where(reached, np.minimum(steps, AWAY - 1), np.where(free, AWAY, FORBIDDEN))
    return cube.astype(np.uint8), int(steps.max(initial=0, where=reached)), curve


# --- Page data ------------------------------------------------------------------------------------


def _page(arm: ThreeLeverArm, first: Question, known: Plan, summary: str) -> PlanPage:
    size = extent(arm)
    name, unit = length_unit(size)
    marks = [Mark(first["target"]), Mark(first["obstacle"], radius=first["distance"])]
    scene = scene_data([arm], [_moments(np.array(known.path))[None]], marks, size, grows=True)
    scene["things"] = []  # the script of the page adds them
    L = arm.lever
    return {
        "kind": "plan",
        "title": TITLE,
        "summary": summary,
        "alt": summary,
        "meant": MEANT,
        "arm": arm_data(arm),
        "unit": {"name": name, "size": unit, "code": name},
        "scene": scene,
        "controls": [control("distance", "mm", 20 * L, 400 * L, L)],
        "branches": list(WAYS),
        "forbidden": FORBIDDEN,
        "words": dict(WORDS),
        "code": "from robokin.jobs.obstacles import plan\n# arm = three_lever(...)\n"
        "plan(arm, ({posture}), ({target}), ({obstacle}), {distance})\n",
    }


# --- The still picture ----------------------------------------------------------------------------


def _picture(arm: ThreeLeverArm, first: Question, answer: Answer, alt: str) -> plots.Figure:
    """Draw the plane, and the cube next to it."""
    fig = plots.figure(alt, width=4.4, height=2.1)
    blue, orange, green = (style["color"] for style in JOINT_STYLES[:3])
    plane, cube = fig.add_axes((0, 0, 0.58, 0.9)), fig.add_axes((0.6, 0, 0.4, 0.9))
    points = arm.points(answer["moments"].astype(float))
    K1, H = first["target"], np.array(first["obstacle"])
    turn = np.linspace(0, 2 * np.pi, 73)
    disc = H + first["distance"] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    plane.fill(*disc.T, color="0.88")
    # a few lines in one colour keep the file small
    plane.add_collection(LineCollection(list(points[::4]), color=PALE, linewidth=0.8))
    plane.plot(*points[:, 3].T, color=blue)
    plane.plot(*points[-1].T, color=SOFT, linewidth=3, marker="o", markerfacecolor="white")
    plane.plot(*points[0].T, color=INK, linewidth=4, marker="o", markerfacecolor="white")
    plane.plot(*H, "X", color=ALARM, markersize=8)
    for text, (x, y) in (("K", points[0, 3]), ("K1", K1), ("H", H)):
        plane.annotate(text, (x, y), (7, 5), textcoords="offset points")
    ends = np.pi * np.stack(np.meshgrid((0, 1), (0, 1), (0, 1), indexing="ij"), axis=-1)
    edges = [np.moveaxis(ends, j, 2).reshape(4, 2, 3) for j in range(3)]
    lines = list(project(np.concatenate(edges), SEEN))
    cube.add_collection(LineCollection(lines, color="0.75", linewidth=0.8))
    faces, shades = _body(answer["cube"] == FORBIDDEN)
    cube.add_collection(
        PolyCollection(
            list(project(faces, SEEN)), facecolors=shades, linewidth=0, antialiased=False
        )
    )
    cube.plot(*project(answer["curve"], SEEN).T, "^", color=green, markersize=3)
    path = project(np.array(answer["path"]), SEEN)
    cube.plot(*path.T, color=orange, linewidth=2)
    cube.plot(*path[0], "o", color=INK)
    for text, place in (("γ", (90, 0, -12)), ("β", (192, 90, 0)), ("α", (-24, 0, 90))):
        x, y = project(np.array(place) * deg, SEEN)
        cube.annotate(text, (x, y), ha="center", va="center")
    for ax in (plane, cube):
        ax.set_aspect("equal")
        ax.set_axis_off()
    fig.text(0.016, 0.975, TITLE, fontsize=10, fontweight="bold", va="top")
    return fig


def _body(blocked: Bools) -> tuple[Floats, list[str]]:
    """Return the visible faces of the forbidden body, the farthest first: corners (n, 4, 3) in
    radians, and their colours.
    """
    (ca, ce), (sa, se) = np.cos(SEEN), np.sin(SEEN)
    toward = np.array([ce * ca, ce * sa, se])
    faces, shades = [], []
    for axis, shade in enumerate(("0.62", "0.7", "0.82")):
        side = 1 if toward[axis] > 0 else -1
        beside = np.roll(blocked, -side, axis=axis)
        np.moveaxis(beside, axis, 0)[-1 if side > 0 else 0] = False
        middle = np.argwhere(blocked & ~beside) + 0.5 * side * np.eye(3)[axis]
        a, b = 0.5 * np.delete(np.eye(3), axis, axis=0)
        ring = np.stack([a + b, a - b, -a - b, b - a])
        faces.append(np.clip((middle[:, None] + ring) * STEP, 0, np.pi))
        shades += [shade] * len(middle)
    every = np.concatenate(faces)
    order = (every.mean(axis=1) @ toward).argsort(kind="stable")
    return every[order], [shades[k] for k in order]
