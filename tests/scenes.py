"""Players and explorers whose scenes are compared with those of an earlier version.

tests/data/scenes_11a2279.json is reference data. This script wrote it with the package of commit
11a2279, in which `targets`, `marks` and `faces` were still separate:

    git archive 11a2279 robokin | tar -x -C /tmp/old
    PYTHONPATH=/tmp/old python tests/scenes.py tests/data/scenes_11a2279.json
"""

import json
import sys
from pathlib import Path

import numpy as np

from robokin import IRB140, SCARA, Quaternion, ScaraPose, Transform, deg, spbu_arm, three_lever
from robokin.jobs.visit_collect import Task
from robokin.show import (
    animate,
    joint_explorer,
    motion_explorer,
    plan_explorer,
    target_explorer,
    tour_explorer,
)

T = np.linspace(0, 2, 61)
TURNED = np.linspace(0, 1, 61)[:, None] * np.array([50, 30, -40, 60, 50, 20]) * deg
CIRCLING = np.stack([0.4 * np.cos(3 * T), 0.4 * np.sin(3 * T), 0.3 + 0.1 * T], axis=-1)
GONE = np.where(T[:, None] > 1.5, np.nan, CIRCLING)
BELT = [[0.7, -1, 0.1], [0.8, -1, 0.1], [0.8, 2, 0.1], [0.7, 2, 0.1]]
AHEAD = Quaternion.from_angle_axis(90 * deg, (0, 1, 0))
VIA = Transform(AHEAD, (0.6, 0.1, 0.7))


def players():
    """Players with every kind of thing: at rest, and moving with time, a slider and a switch."""
    moving = Transform(AHEAD, CIRCLING)
    yield (
        "all",
        animate(
            [IRB140, IRB140],
            T,
            [TURNED, TURNED[::-1]],
            targets={"part": moving, "via": VIA},
            points={"bin": (1, 0, 0), "seen": GONE, "flat": (0.3, 0.2)},
            circles={"ball": (CIRCLING, 0.07), "still": ((0.5, -0.4, 0.2), 0.05)},
            names=["left", "right"],
            bases=[[0.2, -0.5], [0.2, 0.7]],
            faces=[BELT, [[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0]]],
            readings={"bin": np.floor(3 * T), "seen": np.round(T / 4, 2)},
            floor=True,
        ),
    )
    values = {"slider": ("blend", [0, 0.1, 0.2]), "switch": ("way", ["a", "b"])}
    q = np.stack([TURNED * share for share in (0.5, 0.6, 0.7, 0.8, 0.9, 1)]).reshape(2, 3, 61, 6)
    places = np.arange(18.0).reshape(2, 3, 1, 3) / 20
    yield (
        "slider",
        animate(
            IRB140,
            T,
            q,
            targets={"via": Transform(translation=places), "goal": IRB140.fk(q[1, 2, -1])},
            points=[places + CIRCLING],
            circles=[(places, 0.05)],
            **values,
        ),
    )
    yield "plain", animate(spbu_arm(0.4, 0.5), T, TURNED[:, :3], points=[(0.2, 0.1, 0.3)])
    yield "stations", animate(IRB140, T, TURNED, targets=[IRB140.fk(TURNED[-1]), VIA, moving[0]])


def explorers():
    """One explorer of each kind, and the variants whose scenes differ."""
    arm, start = three_lever((1.2, 1, 0.8)), (0.9, 1.6, 1.2)
    yield "joint", joint_explorer(IRB140, TURNED[-1])
    yield "target", target_explorer(IRB140)
    yield "target of a SCARA", target_explorer(SCARA)
    yield "target of three joints", target_explorer(spbu_arm(0.4, 0.5))
    yield "levers", target_explorer(arm)
    stations = [Transform(AHEAD, (0.515, y, 0.702)) for y in (-0.2, 0, 0.2)]
    yield "motion", motion_explorer(IRB140, *stations)
    poses = [ScaraPose((0.4, y, 0.05), 10 * deg) for y in (-0.2, 0, 0.2)]
    yield "motion of a SCARA", motion_explorer(SCARA, *poses)
    yield "plan", plan_explorer(three_lever((1, 1, 1)), start, (1.9, 0.3), (1.2, 1.3))
    at = 4 * np.array([[np.cos(a), np.sin(a), 0.5] for a in (0, 1.0, -1.1, -1.2, -1.3)])
    yield "tour", tour_explorer(Task(5, 4, 7.5, np.full(3, 0.2), at[0], at[1:], "visit"))


def scenes():
    """The scenes of the pages by name; the name of an explorer begins with "explorer"."""
    found = {f"player, {name}": made.data["scene"] for name, made in players()}
    return found | {f"explorer, {name}": made.data["scene"] for name, made in explorers()}


if __name__ == "__main__":
    lines = [f"{json.dumps(name)}: {json.dumps(scene)}" for name, scene in scenes().items()]
    Path(sys.argv[1]).write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")
