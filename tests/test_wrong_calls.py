"""Invalid calls of every public callable: each argument in turn is replaced by each of the wrong
values below.

A call may raise only ValueError or TypeError, with a message from robokin and not from NumPy; no
call may take longer than `SECONDS`, and NumPy must not warn. `test_wrong_input.py` checks the
messages.
"""

import datetime
import decimal
import fractions
import inspect
import signal
import time
import traceback
import warnings
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure as MatplotlibFigure

import robokin
from robokin import (
    IRB140,
    SCARA,
    Arm,
    ClosedFormArm,
    Link,
    Quaternion,
    ScaraPose,
    ThreeLeverArm,
    TimeLaw,
    Transform,
    arms,
    blend,
    deg,
    dh_links,
    differentiate,
    distance_from_singularity,
    elbow_arm,
    explain,
    follow,
    itmo_arm,
    lin,
    lin_lin,
    linear,
    loader_arm,
    motion,
    nearest,
    ptp,
    quintic,
    representative,
    scara_arm,
    singular_values,
    spbu_arm,
    spherical_wrist,
    three_lever,
    trapezoidal,
    turning_base,
    two_link,
    within,
)
from robokin import show as figures
from robokin.jobs import conveyor, moving, obstacles, redundancy, steppers, visit_collect
from robokin.show import things

SECONDS = 5
FOREIGN = "not robokin's words"
PACKAGE = str(Path(robokin.__file__).parent)
MODULES = (
    robokin,
    arms,
    motion,
    figures,
    visit_collect,
    conveyor,
    obstacles,
    moving,
    redundancy,
    steppers,
)
OPERATORS = ("__matmul__", "__getitem__", "__call__")

# ---- Correct calls


def _fields(value):
    """The arguments of a dataclass."""
    return {name: getattr(value, name) for name in value.__dataclass_fields__}


T = Transform(Quaternion.from_angle_axis(0.3, (0, 0, 1)), (0.4, 0.1, 0.5))
HIGHER = Transform(T.rotation, (0.4, -0.1, 0.6))
TURN = T.rotation
BATCH = lin(T, HIGHER, [0, 0.5, 1])
PLACE = ScaraPose((0.3, 0.1, 0.15), 0.5)
S = np.array([0.0, 0.25, 1.0])
SIX = np.array([0.1, 0.2, -0.3, 0.4, 0.5, 0.6])
TIMES = np.linspace(0, 1, 6)
MOTION = SIX + 0.1 * TIMES[:, None]
SPEEDS = differentiate(MOTION, TIMES)
LAW = quintic(2.0)
LEVERS = three_lever(0.5)
FOLDED = np.array([90.0, 60, 90]) * deg
OPENED = np.array([60.0, 90, 120]) * deg
POINT = np.array([0.6, 0.5])
OBSTACLE = np.array([0.2, 1.1])
PATH = np.stack([FOLDED, OPENED, FOLDED])
POSITIONING = spbu_arm(2.0, 1.5)
LINKS = LEVERS.links
SERVED = np.array([[1.0, 0.5, 1.0], [0.8, -0.5, 1.2]])
TASK = visit_collect.Task(2.0, 1.5, 20.0, [0.5, 0.5, 0.5], [1.0, 0.0, 1.0], SERVED, "visit")
RESULT = visit_collect.visit(TASK)
TASK_DATA = dict(
    zip(
        visit_collect.KEYS,
        (2.0, 1.5, 20.0, [0.5] * 3, [1.0, 0.0, 1.0], SERVED.tolist(), "visit"),
        strict=True,
    )
)
TASK_FILE = Path(__file__).parent.parent / "notebooks" / "tasks" / "example_3.json"
LOADER = loader_arm(1.2, 1.0)
STATIONS = np.array([[1.5, 0.2, 0.3], [0.9, 0.9, 0.6]])
PULSES = np.array([10.0, 8, 12])
MOVE = steppers.synchronised([0, 0, 0], [40, -20, 8])
STEPPER = steppers.Stepper()
PLAN = obstacles.plan(LEVERS, FOLDED, POINT)
CHOICES = redundancy.methods(OBSTACLE, 1)
TASK_OF_LEVERS = dict(arm=LEVERS, target=POINT, previous=FOLDED)
RECORDING = motion.record(IRB140, TIMES, np.where(TIMES[:, None] < 0.5, MOTION, MOTION + 2))
RECORDINGS = motion.record(IRB140, TIMES, np.stack([MOTION, MOTION]))
PAGE = "page.html, in a folder of the test"
PLOT = figures.figure("words").subplots()
SKETCH, CORNERS = figures.Sketch("words"), np.array([[0, 0], [0.3, 0.2], [0.5, 0.1]])
PLAYER = figures.animate(IRB140, TIMES, MOTION)
EXPLORER = figures.joint_explorer(IRB140)

# For each "name" or "name (case)": the callable, all its arguments with legal values, and then the
# names of the arguments to replace, if not all. Names from robokin.jobs begin with the name of
# their module.
CALLS = {
    # robokin
    "Quaternion": (Quaternion, dict(wxyz=np.array([0.6, 0.8, 0, 0]))),
    "Quaternion.identity": (Quaternion.identity, dict(shape=(2,))),
    "Quaternion.from_angle_axis": (
        Quaternion.from_angle_axis,
        dict(angle=np.array([0.1, 0.2]), axis=np.array([0, 0.6, 0.8])),
    ),
    "Quaternion.from_matrix": (Quaternion.from_matrix, dict(matrix=TURN.as_matrix())),
    "Quaternion.from_roll_pitch_yaw": (
        Quaternion.from_roll_pitch_yaw,
        dict(roll=np.array([0.1, 0.2]), pitch=0.3, yaw=0.4),
    ),
    "Quaternion.angle_to": (TURN.angle_to, dict(other=BATCH.rotation)),
    "Quaternion.slerp": (TURN.slerp, dict(goal=Quaternion.identity(), s=S)),
    "Quaternion.__matmul__": (lambda other: TURN @ other, dict(other=TURN)),
    "Quaternion.__matmul__ (points)": (lambda other: TURN @ other, dict(other=np.ones((2, 3)))),
    "Quaternion.__matmul__ (from the right)": (lambda other: other @ TURN, dict(other=TURN)),
    "Quaternion.__getitem__": (lambda index: BATCH.rotation[index], dict(index=1)),
    "Transform": (Transform, dict(rotation=TURN, translation=np.array([0.1, 0.2, 0.3]))),
    "Transform.identity": (Transform.identity, dict(shape=(2,))),
    "Transform.from_matrix": (Transform.from_matrix, dict(matrix=T.as_matrix())),
    "Transform.lerp": (T.lerp, dict(goal=HIGHER, s=S)),
    "Transform.__matmul__": (lambda other: T @ other, dict(other=BATCH)),
    "Transform.__matmul__ (points)": (lambda other: T @ other, dict(other=np.ones((2, 3)))),
    "Transform.__matmul__ (from the right)": (lambda other: other @ T, dict(other=T)),
    "Transform.__getitem__": (lambda index: BATCH[index], dict(index=1)),
    "ScaraPose": (ScaraPose, dict(position=np.array([0.3, 0.1, 0.1]), angle=0.4)),
    "ScaraPose.lerp": (PLACE.lerp, dict(goal=ScaraPose((0.2, 0.1, 0.1)), s=S)),
    "ScaraPose.__getitem__": (lambda index: PLACE.lerp(PLACE, S)[index], dict(index=1)),
    "Link": (Link, dict(before=T, axis=np.array([0, 0.6, 0.8]), after=T, prismatic=False)),
    "Arm": (
        Arm,
        dict(
            name="arm",
            geometry=LEVERS.geometry,
            limits=LEVERS.limits,
            speed_limits=np.ones(3),
        ),
    ),
    "Arm (links)": (Arm, dict(name="arm", geometry=LINKS, limits=LEVERS.limits)),
    "ClosedFormArm": (
        ClosedFormArm,
        dict(
            name="arm",
            geometry=SCARA.geometry,
            limits=SCARA.limits,
            speed_limits=np.ones(4),
        ),
    ),
    "ThreeLeverArm": (
        ThreeLeverArm,
        dict(
            name="arm",
            geometry=LEVERS.geometry,
            limits=LEVERS.limits,
            speed_limits=np.ones(3),
        ),
    ),
    "ClosedFormArm.branch": (lambda flags: IRB140.branch(+1, -1, flags), dict(flags=1)),
    "ClosedFormArm.branch (SCARA)": (lambda flags: SCARA.branch(flags), dict(flags=1)),
    "Arm.fk": (IRB140.fk, dict(q=SIX)),
    "Arm.fk (SCARA)": (SCARA.fk, dict(q=SIX[:4])),
    "Arm.frames": (IRB140.frames, dict(q=SIX)),
    "Arm.jacobian": (IRB140.jacobian, dict(q=MOTION)),
    "ClosedFormArm.ik": (IRB140.ik, dict(pose=T)),
    "ClosedFormArm.ik (SCARA)": (SCARA.ik, dict(pose=PLACE)),
    "ClosedFormArm.ik (points)": (POSITIONING.ik, dict(pose=SERVED)),
    "ClosedFormArm.ik (plane)": (two_link(0.5, 0.4).ik, dict(pose=POINT)),
    "ThreeLeverArm.points": (LEVERS.points, dict(q=PATH)),
    "ThreeLeverArm.alpha_range": (LEVERS.alpha_range, dict(point=POINT, limited=True)),
    "ThreeLeverArm.family": (LEVERS.family, dict(point=POINT, alpha=np.array([1.5, 2.0]))),
    "ThreeLeverArm.table": (LEVERS.table, dict(point=POINT, step=1 * deg, limited=True)),
    "ThreeLeverArm.sweep": (
        LEVERS.sweep,
        dict(point=POINT, previous=FOLDED, step=1 * deg, limited=True),
    ),
    "ThreeLeverArm.least": (LEVERS.least, dict(point=POINT, previous=FOLDED, limited=True)),
    "ThreeLeverArm.out_of_reach": (LEVERS.out_of_reach, dict(point=POINT)),
    "dh_links": (
        dh_links,
        dict(
            a=np.array([0, 0.3]),
            alpha=np.array([1.57, 0]),
            d=np.zeros(2),
            theta=np.zeros(2),
            prismatic=[True, False],
            modified=False,
        ),
    ),
    "elbow_arm": (
        elbow_arm,
        dict(
            name="arm",
            links=POSITIONING.links,
            limits=POSITIONING.limits,
            speed_limits=np.ones(3),
        ),
    ),
    "spherical_wrist": (
        spherical_wrist,
        dict(name="arm", links=IRB140.links, limits=IRB140.limits, speed_limits=np.ones(6)),
    ),
    "scara_arm": (
        scara_arm,
        dict(
            name="arm",
            height=0.3,
            upper=0.2,
            fore=0.25,
            limits=SCARA.limits,
            speed_limits=np.ones(4),
        ),
    ),
    "itmo_arm": (itmo_arm, dict(d1=0.1, a2=0.1, d4=0.2, d6=0.2)),
    "loader_arm": (loader_arm, dict(A=1.2, B=1.0)),
    "spbu_arm": (spbu_arm, dict(l1=2.0, l2=1.5)),
    "three_lever": (three_lever, dict(L=0.5)),
    "three_lever (unequal)": (three_lever, dict(L=np.array([0.5, 0.4, 0.3]))),
    "turning_base": (turning_base, dict(arm=LEVERS)),
    "two_link": (two_link, dict(l1=0.5, l2=0.4, base=np.array([0.1, 0.2]))),
    "explain": (explain, dict(arm=IRB140, pose=T, row=1)),
    "explain (SCARA)": (explain, dict(arm=SCARA, pose=PLACE, row=1)),
    "explain (points)": (explain, dict(arm=POSITIONING, pose=SERVED[0], row=3)),
    "explain (plane)": (explain, dict(arm=two_link(0.5, 0.4), pose=POINT, row=0)),
    "follow": (follow, dict(arm=IRB140, rows=IRB140.ik(BATCH), row=0)),
    "nearest": (nearest, dict(arm=IRB140, rows=IRB140.ik(T), q=SIX)),
    "representative": (representative, dict(arm=IRB140, q=SIX)),
    "representative (SCARA)": (representative, dict(arm=SCARA, q=SIX[:4])),
    "unwrapped": (arms.unwrapped, dict(arm=IRB140, q=SIX, near=MOTION)),
    "total_length": (arms.total_length, dict(arm=IRB140)),
    "singular_values": (singular_values, dict(arm=IRB140, q=MOTION)),
    "distance_from_singularity": (distance_from_singularity, dict(arm=SCARA, q=SIX[:4])),
    "within": (within, dict(arm=IRB140, q=SIX)),
    "within (SCARA)": (within, dict(arm=SCARA, q=SIX[:4])),
    "lin": (lin, dict(start=T, goal=HIGHER, s=S)),
    "lin (SCARA)": (lin, dict(start=PLACE, goal=PLACE, s=S)),
    "lin_lin": (lin_lin, dict(start=T, via=HIGHER, goal=T, s=S)),
    "blend": (
        blend,
        dict(start=T, via=HIGHER, goal=T, fraction=0.1, s=S, corner="quintic"),
    ),
    "ptp": (ptp, dict(q0=SIX, q1=SIX + 0.1, s=S)),
    "TimeLaw": (TimeLaw, dict(duration=2.0, progress=np.sin)),
    "TimeLaw.__call__": (LAW, dict(t=TIMES)),
    "linear": (linear, dict(duration=2.0)),
    "quintic": (quintic, dict(duration=2.0)),
    "trapezoidal": (trapezoidal, dict(duration=2.0, ramp=0.2)),
    "differentiate": (differentiate, dict(values=MOTION, t=TIMES, order=2)),
    "refined_maximum": (
        motion.refined_maximum,
        dict(function=np.sin, low=0.0, high=2.0, decimals=2),
        "low",
        "high",
        "decimals",
    ),
    "shortest_duration": (
        motion.shortest_duration,
        dict(arm=IRB140, path=lambda s: ptp(SIX, SIX + 0.1, s), law=quintic),
        "arm",
    ),
    "Maximum": (motion.Maximum, dict(value=1.0, at=0.0)),
    "record": (motion.record, dict(arm=IRB140, t=TIMES, q=MOTION)),
    "Recording": (motion.Recording, _fields(RECORDING)),
    "Jump": (motion.Jump, _fields(RECORDING.leaps[0])),
    "Extreme": (motion.Extreme, dict(value=SIX, time=SIX)),
    "Recording.__getitem__": (lambda index: RECORDINGS[index], dict(index=1)),
    # robokin.show
    "animate": (
        figures.animate,
        dict(
            arm=IRB140,
            t=TIMES,
            q=MOTION,
            targets=[T],
            slider=None,
            switch=None,
            title="title",
            points={"p": (0.1, 0.2, 0.3)},
            circles=[((0.1, 0.2, 0.3), 0.1)],
            names=None,
            floor=False,
            bases=None,
            faces=[[(0, 0, 0), (1, 0, 0), (0, 1, 0)]],
            readings={"p": TIMES},
            things=[things.Mark((0.1, 0.2, 0.3), "mark")],
            watch="v",
            joints=[1, 3],
            quantities={"distance, mm": TIMES},
            view=(-0.5, 0.4),
        ),
    ),
    "animate (controls)": (
        figures.animate,
        dict(
            arm=[IRB140, IRB140],
            t=TIMES,
            q=[np.broadcast_to(MOTION, (2, 2, 6, 6))] * 2,
            targets={"via": T},
            slider=("blend", np.array([0.0, 0.1])),
            switch=("corner", ["parabola", "quintic"]),
            title=None,
            points=(),
            circles=(),
            names=["one", "two"],
            bases=np.array([[0.0, 0.0], [0.0, 1.0]]),
        ),
        "q",
        "slider",
        "switch",
        "names",
        "bases",
    ),
    "Player": (figures.Player, dict(data=PLAYER.data, still=PLAYER.still, film=PLAYER.film)),
    "Explorer": (figures.Explorer, dict(data=EXPLORER.data, still=EXPLORER.still)),
    "Player.save": (lambda path: PLAYER.save(path), dict(path=PAGE)),
    "Output.save": (lambda path: EXPLORER.save(path), dict(path=PAGE)),
    "figure": (figures.figure, dict(alt="words", width=3, height=2)),
    "joint_explorer": (
        figures.joint_explorer,
        dict(arm=IRB140, q=SIX, singular=True, wrist=True),
    ),
    "elbow_explorer": (figures.elbow_explorer, dict(arm=IRB140)),
    "crossing_explorer": (
        figures.crossing_explorer,
        dict(arm=two_link(1, 1), tip=np.array([0.5, 0.5]), divisor="x3"),
    ),
    "target_explorer": (figures.target_explorer, dict(arm=SCARA, target=PLACE, zone=True)),
    "tour_explorer": (figures.tour_explorer, dict(task=TASK, best=True)),
    "motion_explorer": (
        figures.motion_explorer,
        dict(
            arm=SCARA,
            start=PLACE,
            via=ScaraPose((0.2, 0.2, 0.1)),
            goal=ScaraPose((0.1, 0.3, 0.1)),
            row=1,
            law="linear",
            duration=4.0,
            close_up=True,
        ),
    ),
    "rotation_explorer": (
        figures.rotation_explorer,
        dict(angle=1.0, axis=(0.0, 0.0, 1.0), v=(0.1, 0.0, 0.2)),
    ),
    "plan_explorer": (
        figures.plan_explorer,
        dict(arm=LEVERS, posture=FOLDED, target=POINT, obstacle=OBSTACLE),
    ),
    "clearance_explorer": (
        figures.clearance_explorer,
        dict(arm=LEVERS, posture=FOLDED, target=POINT, obstacle=OBSTACLE, via=POINT[None]),
    ),
    "conveyor_player": (
        figures.conveyor_player,
        dict(
            v=0.2,
            spread=np.array([0.0, 0.5, 1.0]),
            arms=3,
            rules=False,
            bin_place=np.array([0.15, -0.45, 0.25]),
            gap=0.15,
            seed=8,
        ),
    ),
    "singularity_explorer": (
        figures.singularity_explorer,
        dict(arm=IRB140, q=np.zeros(6), way=(0.0, 1.0, 1.0), most=0.02, step=0.001),
    ),
    "paths_explorer": (
        figures.paths_explorer,
        dict(
            arm=LOADER,
            start=(1.0, 0.5, 0.3),
            goal=(0.8, 0.9, 0.2),
            per_degree=(10.0, 40.0, 40.0),
        ),
    ),
    "motor_explorer": (figures.motor_explorer, dict(motor=STEPPER, alone=True, frequency=100.0)),
    "movement_explorer": (
        figures.movement_explorer,
        dict(arm=LEVERS, previous=FOLDED, target=POINT),
    ),
    "bars": (
        figures.bars,
        dict(ax=PLOT, values={"a": 1.0}, form="{:g} s", xlabel="t, s", title="t"),
    ),
    "curves": (
        figures.curves,
        dict(ax=PLOT, x=TIMES, values={"a": TIMES}, joints=[0], xlabel="x", ylabel="y", title="t"),
    ),
    "plot_frames": (
        figures.plot_frames,
        dict(frames=BATCH, names=["a", "b", "c"], title="t", size=0.1, chain=True, alt="words"),
    ),
    "plot_joints": (
        figures.plot_joints,
        dict(arm=IRB140, t=TIMES, q=MOTION, v=SPEEDS, a=SPEEDS, title="title", alt="words"),
    ),
    "plot_postures": (
        figures.plot_postures,
        dict(arm=IRB140, q=MOTION, targets=[T, HIGHER], title="title", alt="words"),
    ),
    "plot_velocity_ellipsoid": (
        figures.plot_velocity_ellipsoid,
        dict(arm=IRB140, q=SIX, title="title", alt="words"),
    ),
    "Sketch": (
        figures.Sketch,
        dict(alt="words", title="t", unit="mm", x="x", y="y", width=3.0, height=2.0),
    ),
    "Sketch.levers": (SKETCH.levers, dict(points=CORNERS, names=["O", "A"], dashed=False)),
    "Sketch.point": (SKETCH.point, dict(place=CORNERS[0], name="K", away=(0, 1))),
    "Sketch.length": (SKETCH.length, dict(start=CORNERS[0], end=CORNERS[1], name="d", right=False)),
    "Sketch.angle": (
        SKETCH.angle,
        dict(centre=CORNERS[0], start=0.0, end=1.0, name="q1", radius=0.1),
    ),
    # robokin.jobs
    "visit_collect.workspace": (visit_collect.workspace, dict(l1=2.0, l2=1.5, points=SERVED)),
    "visit_collect.out_of_workspace": (
        visit_collect.out_of_workspace,
        dict(l1=2.0, l2=1.5, point=SERVED[0]),
    ),
    "visit_collect.principal_postures": (
        visit_collect.principal_postures,
        dict(l1=2.0, l2=1.5, points=SERVED),
    ),
    "visit_collect.misfit": (
        visit_collect.misfit,
        dict(l1=2.0, l2=1.5, q=TASK.q[1:], points=SERVED),
    ),
    "visit_collect.travel_time": (
        visit_collect.travel_time,
        dict(q_from=TASK.q, q_to=TASK.q[0], speeds=np.ones(3), short_way=False),
    ),
    "visit_collect.lowest": (
        visit_collect.lowest,
        dict(l1=2.0, l2=1.5, q_from=TASK.q, q_to=TASK.q[0]),
    ),
    "visit_collect.Task": (
        visit_collect.Task,
        dict(
            l1=2.0,
            l2=1.5,
            T=20.0,
            speeds=np.ones(3),
            p0=SERVED[0],
            points=SERVED,
            kind="visit",
            remarks=("a remark",),
        ),
    ),
    "visit_collect.read_task": (visit_collect.read_task, dict(path=str(TASK_FILE))),
    "visit_collect.faults": (visit_collect.faults, dict(data=TASK_DATA)),
    "visit_collect.Result": (
        visit_collect.Result,
        dict(order=(0, 1), times=(1.0, 2.0), left=()),
    ),
    "visit_collect.collect": (
        visit_collect.collect,
        dict(task=TASK, short_way=False, above_floor=False),
    ),
    "visit_collect.visit": (
        visit_collect.visit,
        dict(task=TASK, short_way=False, above_floor=False),
    ),
    "visit_collect.best_visit": (
        visit_collect.best_visit,
        dict(task=TASK, short_way=False, above_floor=False),
    ),
    "visit_collect.itinerary": (
        visit_collect.itinerary,
        dict(task=TASK, result=RESULT, short_way=False),
    ),
    "visit_collect.answer": (visit_collect.answer, dict(task=TASK, above_floor=False)),
    "visit_collect.report": (visit_collect.report, dict(task=TASK, result=RESULT)),
    "conveyor.spaced": (conveyor.spaced, dict(count=4, gap=0.15, spread=0.5, seed=3)),
    "conveyor.ways_from": (conveyor.ways_from, dict(bin_place=np.array([0.2, -0.3, 0.2]))),
    "conveyor.Trips": (conveyor.Trips, _fields(conveyor.serve([0.1], 0.1, S, S + 1)[0])),
    "conveyor.serve": (
        conveyor.serve,
        dict(offsets=S, v=0.1, window=S, ways=S + 1, arms=2, pitch=2.0, first_come=False),
    ),
    "obstacles.in_quadrilateral": (
        obstacles.in_quadrilateral,
        dict(arm=LEVERS, q0=FOLDED, q1=OPENED, H=OBSTACLE),
    ),
    "obstacles.swept": (obstacles.swept, dict(arm=LEVERS, q0=FOLDED, q1=OPENED, H=OBSTACLE)),
    "obstacles.locate": (
        obstacles.locate,
        dict(P=POINT, Q=OBSTACLE, from_P=0.6, from_Q=0.7),
    ),
    "obstacles.distances": (obstacles.distances, dict(arm=LEVERS, q=PATH, H=OBSTACLE)),
    "obstacles.clearance": (obstacles.clearance, dict(arm=LEVERS, path=PATH, H=OBSTACLE)),
    "obstacles.keeps": (
        obstacles.keeps,
        dict(arm=LEVERS, a=FOLDED, b=PATH, H=OBSTACLE, distance=0.05),
    ),
    "obstacles.via_points": (
        obstacles.via_points,
        dict(K=POINT, K1=np.array([-0.5, 0.7]), H=OBSTACLE, radius=0.1),
    ),
    "obstacles.via_path": (
        obstacles.via_path,
        dict(arm=LEVERS, q0=FOLDED, target=POINT, H=OBSTACLE, radius=0.1, limited=True),
    ),
    "obstacles.way_round": (
        obstacles.way_round,
        dict(arm=LEVERS, q0=FOLDED, target=POINT, H=OBSTACLE, distance=0.05),
    ),
    "obstacles.way_round (two obstacles)": (
        obstacles.way_round,
        dict(arm=LEVERS, q0=FOLDED, target=POINT, H=[OBSTACLE, -OBSTACLE], distance=0.05),
        "H",
    ),
    "obstacles.Plan": (
        obstacles.Plan,
        _fields(PLAN),
    ),
    "obstacles.plan": (
        obstacles.plan,
        dict(arm=LEVERS, posture=FOLDED, target=POINT, obstacle=OBSTACLE, distance=0.05),
    ),
    "moving.plan_moving": (
        moving.plan_moving,
        dict(
            arm=LEVERS,
            posture=FOLDED,
            target=POINT,
            obstacle=OBSTACLE,
            velocity=np.array([0.3, 0.2]),
            speed=1.0,
            distance=0.05,
        ),
    ),
    "obstacles.along": (obstacles.along, dict(path=PATH, s=S)),
    "redundancy.race": (
        redundancy.race,
        dict(methods=CHOICES, arm=LEVERS, targets=np.array([POINT, POINT]), start=FOLDED),
    ),
    "redundancy.methods": (redundancy.methods, dict(obstacle=OBSTACLE, seed=1)),
    "redundancy.least_movement": (redundancy.least_movement, TASK_OF_LEVERS),
    "redundancy.pseudo_inverse": (redundancy.pseudo_inverse, TASK_OF_LEVERS),
    "redundancy.gradient_projection": (redundancy.gradient_projection, TASK_OF_LEVERS),
    "redundancy.equal_angles": (redundancy.equal_angles, TASK_OF_LEVERS),
    "redundancy.random_choice": (redundancy.random_choice, dict(seed=1, obstacle=OBSTACLE)),
    "redundancy.distance_rule": (redundancy.distance_rule, dict(obstacle=OBSTACLE)),
    "redundancy.RaceResult": (
        redundancy.RaceResult,
        dict(postures=PATH, turns=S, failed=np.zeros(3, dtype=bool), seconds=0.1),
    ),
    "steppers.out_of_reach": (steppers.out_of_reach, dict(arm=LOADER, point=STATIONS[0])),
    "steppers.station_postures": (steppers.station_postures, dict(arm=LOADER, points=STATIONS)),
    "steppers.shortest_turn": (steppers.shortest_turn, dict(start=0.1, goal=S)),
    "steppers.counts": (steppers.counts, dict(q=PATH, per_degree=PULSES)),
    "steppers.joint_values": (
        steppers.joint_values,
        dict(positions=np.array([10.0, 20, 30]), per_degree=PULSES),
    ),
    "steppers.Move": (steppers.Move, dict(t=MOVE.t, positions=MOVE.positions)),
    "steppers.Move.__call__": (MOVE, dict(t=TIMES)),
    "steppers.frequencies": (steppers.frequencies, dict(pulses=PULSES, limit=400.0)),
    "steppers.unsynchronised": (
        steppers.unsynchronised,
        dict(start=np.zeros(3), goal=PULSES, limit=400.0),
    ),
    "steppers.synchronised": (
        steppers.synchronised,
        dict(start=np.zeros(3), goal=PULSES, limit=400.0),
    ),
    "steppers.straight": (
        steppers.straight,
        dict(arm=LOADER, start=STATIONS[0], goal=STATIONS[1], per_degree=PULSES, limit=400.0),
    ),
    "steppers.phases": (steppers.phases, dict(drive="wave", motor="bipolar", windings=3)),
    "steppers.Stepper": (steppers.Stepper, _fields(STEPPER)),
    "steppers.Stepper.run": (
        STEPPER.run,
        dict(times=[0.01, 0.02], signs=[1, -1], load=0.001, load_inertia=1e-7),
    ),
    "steppers.Stepper.start_frequency": (
        STEPPER.start_frequency,
        dict(load=0.001, load_inertia=1e-7, pulses=8),
    ),
    "steppers.RotorMotion": (steppers.RotorMotion, _fields(STEPPER.run([0.01], [1]))),
    "steppers.ramp": (steppers.ramp, dict(pulses=9, start=20.0, end=90.0, seconds=0.1)),
    "steppers.energised": (
        steppers.energised,
        dict(table=steppers.phases("wave", "unipolar"), signs=np.array([1, 1, -1]), row=1),
    ),
}

# Results that only robokin makes, and functions that accept anything and describe what is wrong
# with it.
LENIENT = (
    "Recording",
    "Jump",
    "Extreme",
    "Maximum",
    "obstacles.Plan",
    "redundancy.RaceResult",
    "visit_collect.faults",
    "conveyor.Trips",
    "steppers.RotorMotion",
)

# ---- Wrong values

HUGE = 10**400
NEARLY_NUMBERS = np.zeros(4 * 10**6)
NEARLY_NUMBERS[-1] = np.nan
MANY = np.zeros(300_000)


def deep(depth=5000):
    value = [1.0]
    for _ in range(depth):
        value = [value]
    return value


def ragged():
    return [[1.0, 2.0], [3.0]]


class Sulky:
    """An object whose repr fails."""

    def __repr__(self):
        raise RuntimeError("no")


# For each name: a function that makes the value, since some values can be used only once.
WRONG = {
    "None": lambda: None,
    "empty string": lambda: "",
    "a word": lambda: "abc",
    "a word that NumPy reads as a number": lambda: "90",
    "a word with a zero byte": lambda: "a\0b.html",
    "half of a surrogate pair": lambda: "\ud800",
    "an invalid formula": lambda: "a $\\frac{ b$",
    "words": lambda: ["1", "2", "3"],
    "bytes": lambda: b"12",
    "True": lambda: True,
    "NumPy's True": lambda: np.True_,
    "-1": lambda: -1,
    "0": lambda: 0,
    "0.0": lambda: 0.0,
    "-0.5": lambda: -0.5,
    "1.5": lambda: 1.5,
    "seven": lambda: 7,
    "degrees": lambda: 90,
    "a million radians": lambda: 1e6,
    "1e17": lambda: 1e17,
    "1e300": lambda: 1e300,
    "1e-300": lambda: 1e-300,
    "1e-9": lambda: 1e-9,
    "NaN": lambda: np.nan,
    "infinite": lambda: np.inf,
    "minus infinity": lambda: -np.inf,
    "a million": lambda: 10**6,
    "a million million": lambda: 10**12,
    "10**400": lambda: HUGE,
    "-10**400": lambda: -HUGE,
    "10**400 in a list": lambda: [HUGE, 1, 1],
    "a fraction": lambda: fractions.Fraction(1, 3),
    "a decimal": lambda: decimal.Decimal("0.1"),
    "complex": lambda: 1 + 2j,
    "complex array": lambda: np.array([1, 2, 3j]),
    "masked": lambda: np.ma.masked_array([1.0, 2, 3], [False, True, False]),
    "date": lambda: datetime.date(2020, 1, 1),
    "datetime64": lambda: np.array(["2020-01-01"] * 3, dtype="datetime64[D]"),
    "timedelta64": lambda: np.array([1, 2, 3], dtype="timedelta64[s]"),
    "record array": lambda: np.zeros(3, dtype=[("x", float), ("y", int)]),
    "array of objects": lambda: np.array([None, 1, {}], dtype=object),
    "array without axes": lambda: np.array(0.5),
    "empty list": lambda: [],
    "empty rows": lambda: np.empty((0, 3)),
    "rows of nothing": lambda: np.empty((3, 0)),
    "five by five by five": lambda: np.zeros((5, 5, 5)),
    "two numbers": lambda: (0.1, 0.2),
    "three numbers": lambda: [0.1, 0.2, 0.3],
    "seven numbers": lambda: np.arange(7.0),
    "identity of four": lambda: np.eye(4),
    "NaN everywhere": lambda: np.full((4, 6), np.nan),
    "ragged": ragged,
    "nested five thousand times": deep,
    "many numbers": lambda: MANY,
    "millions of numbers, one NaN": lambda: NEARLY_NUMBERS,
    "a list that holds itself": lambda: (lambda a: a.append(a) or a)([1.0]),
    "object": object,
    "a list of an object": lambda: [object()],
    "a pair of objects": lambda: (object(), object()),
    "a word and an object": lambda: ("word", object()),
    "empty dict": dict,
    "dict": lambda: {"x": 1.0},
    "dict of an object": lambda: {"x": object()},
    "dict with a wrong key": lambda: {(1, 2): None},
    "set": lambda: {1.0, 2.0},
    "function": lambda: lambda *_: 1 / 0,
    "class": lambda: int,
    "class of ours": lambda: Transform,
    "module": lambda: np,
    "generator": lambda: (i for i in range(3)),
    "range": lambda: range(3),
    "slice": lambda: slice(None, "a"),
    "ellipsis": lambda: ...,
    "an index out of range": lambda: 10**5,
    "a pair of indices": lambda: (0, 0),
    "an arm": lambda: IRB140,
    "a SCARA": lambda: SCARA,
    "three levers": lambda: LEVERS,
    "a positioning arm": lambda: POSITIONING,
    "a pose": lambda: T,
    "poses": lambda: BATCH,
    "a list of poses": lambda: [T, None],
    "a missing pose": lambda: IRB140.fk(np.full(6, np.nan)),
    "a rotation": lambda: TURN,
    "rotations": lambda: BATCH.rotation,
    "a SCARA's pose": lambda: PLACE,
    "a law": lambda: LAW,
    "a link": Link,
    "links": lambda: IRB140.links[:2],
    "a task": lambda: TASK,
    "a result": lambda: visit_collect.Result((7,), (1.0,), ()),
    "a move": lambda: MOVE,
    "a plan": lambda: PLAN,
    "a path": lambda: Path("no/such.html"),
    "something whose repr fails": Sulky,
}


# Anything with a truth value works as a flag: only a value without one is wrong.
FLAGS = ("None", "a word", "object", "masked", "record array", "empty rows", "seven numbers")


def derived(value):
    """Wrong (and some legal) values made from the legal value of an argument: a dict that maps
    names to values.
    """
    if isinstance(value, (bool, str, bytes, dict)) or value is None:
        return {}
    try:
        array = np.array(value, dtype=float)
    except (TypeError, ValueError):
        return {}
    if not array.size:
        return {}

    def one(other, dtype=float):
        changed = array.astype(dtype)
        changed.reshape(-1)[-1:] = other
        return changed

    last = (slice(None),) * max(array.ndim - 1, 0)
    with np.errstate(all="ignore"):
        scaled = {"a million times": array * 1e6, "1e200 times": array * 1e200, "zeros": array * 0}
    made = scaled | {
        "with a NaN": one(np.nan),
        "with an infinite number": one(np.inf),
        "with 1e300": one(1e300),
        "with 10**400": one(HUGE, object).tolist(),
        "with None": one(None, object),
        "with a word": one("x", object).tolist(),
        "as strings": array.astype(str),
        "complex": array + 0j,
        "truly complex": array + 1j,
        "masked": np.ma.masked_array(array, np.ones(array.shape, dtype=bool)),
        "in degrees": array / deg,
        "negative": -array,
        "of bool": array.astype(bool),
        "with an additional axis": array[None],
        "twice": np.stack([array, array]),
        "five times": np.stack([array] * 5),
    }
    if array.ndim:
        made |= {
            "one shorter": array[(*last, slice(None, -1))],
            "an empty part": array[:0],
            "the first item": array[:1],
            "flat": array.reshape(-1),
            "transposed": array.T,
            "reversed": array[::-1],
            "in a list with a shorter one": [*array.tolist(), []],
        }
    return made


# ---- The tests


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    return str(tmp_path_factory.mktemp("page") / "page.html")


@pytest.mark.parametrize("name", CALLS)
def test_invalid_calls_are_refused_with_our_messages(name, page):
    call, right, *chosen = CALLS[name]
    right = {key: page if value is PAGE else value for key, value in right.items()}
    _, complaint = _outcome(call, right)
    assert not complaint, f"the correct call: {complaint}"
    complaints = {}  # (argument, complaint) -> kinds of wrong values
    for argument in chosen or right:
        value = right[argument]
        wrong = WRONG | {kind: lambda bad=bad: bad for kind, bad in derived(value).items()}
        if isinstance(value, bool):
            wrong = {kind: WRONG[kind] for kind in FLAGS}
        for kind, make in wrong.items():
            error, complaint = _outcome(call, right | {argument: make()})
            if complaint.startswith(FOREIGN) and isinstance(value, bool):
                complaint = ""  # a flag needs a truth value, and an array has none
            elif complaint and name.split()[0].endswith("__getitem__"):
                # `[]` follows NumPy and Python: an index out of range is an IndexError
                complaint = "" if "IndexError" in complaint or FOREIGN in complaint else complaint
            elif kind == "object" and not complaint and name not in LENIENT and "__" not in name:
                complaint = _against_the_rule(argument, value, error)
            if complaint:
                complaints.setdefault((argument, complaint), []).append(kind)
    assert not complaints, "".join(
        f"\n{argument}: {complaint}\n    for {'; '.join(kinds)}"
        for (argument, complaint), kinds in complaints.items()
    )


def test_every_public_callable_is_in_the_table():
    wanted = dict(_public())
    called = {}
    for name, (_, arguments, *_) in CALLS.items():
        called.setdefault(name.split()[0], set()).update(arguments)
    assert set(wanted) - set(called) == set(), "not in the table"
    assert set(called) - set(wanted) == set(), "in the table, but not public"
    for name, parameters in wanted.items():
        if name.split(".")[-1] not in OPERATORS:
            assert parameters <= called[name], (
                f"{name}: {parameters - called[name]} are missing in the table"
            )


def test_errors_that_are_not_ours_are_detected():
    # The detector must find planted errors.
    with np.errstate(all="warn"):
        for call, seen in (
            (lambda x: next(i for i in iter(int, 1) if i), "took longer"),
            (lambda x: np.float64(0) / 0, "RuntimeWarning"),
            (lambda x: {}[x], "KeyError"),
            (lambda x: len(None), FOREIGN),
        ):
            assert seen in _outcome(call, {"x": 1}, seconds=0.2)[1]


# ---- Helpers


class TooLong(BaseException):
    """Raised by the time limit in the middle of a call."""


def _outcome(call, arguments, seconds=SECONDS):
    """The error that a call raises (or None), and a sentence about what is wrong with
    it (or "").
    """
    error, complaint, start = None, "", time.process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", UserWarning)  # allow warnings about probable mistakes
        try:
            with _watch(seconds):
                call(**arguments)
        except (ValueError, TypeError) as caught:
            error = caught
            complaint = _foreign(caught)
        except TooLong:
            complaint = f"took longer than {seconds} s"
        except Exception as caught:
            complaint = f"{type(caught).__name__}: {caught}"[:200]
    if not complaint and time.process_time() - start > seconds:
        complaint = f"took {time.process_time() - start:.1f} s"
    return error, complaint


class _watch:
    """Raise TooLong after a few seconds of CPU time, if the system has such a timer."""

    def __init__(self, seconds):
        self.seconds = seconds

    def __enter__(self):
        if hasattr(signal, "setitimer"):
            self.before = signal.signal(signal.SIGPROF, self._ring)
            signal.setitimer(signal.ITIMER_PROF, self.seconds)

    def __exit__(self, *_):
        if hasattr(signal, "setitimer"):
            signal.setitimer(signal.ITIMER_PROF, 0)
            signal.signal(signal.SIGPROF, self.before)

    def _ring(self, *_):
        raise TooLong


def _foreign(error):
    """A complaint if an error message is not from robokin, or else ""."""
    text = "; ".join(str(fault)[:200] for fault in getattr(error, "faults", [error])[:3])
    if not text or len(text) > 500:
        return f"{type(error).__name__} of {len(text)} characters"
    last = traceback.extract_tb(error.__traceback__)[-1]
    ours = last.filename.startswith(PACKAGE) and last.line.startswith("raise")
    # Python itself rejects an operator applied to incompatible operands.
    python = isinstance(error, TypeError) and last.name == "<lambda>" and "operand" in text
    return "" if ours or python else f"{FOREIGN}: {type(error).__name__}: {text}"[:200]


def _against_the_rule(argument, value, error):
    """A complaint if an object() is accepted or is refused with the wrong exception. TypeError is
    correct where an object of a class is wanted, ValueError where numbers or strings are wanted,
    and either for a path, for which both are accepted; a flag may be anything.
    """
    if isinstance(value, bool) or (argument == "path" and error is not None):
        return ""
    if error is None:
        return "accepted"
    one = next(iter(value), None) if isinstance(value, (tuple, list)) else value
    kind = type(one).__module__.startswith("robokin") or callable(one)
    wanted = TypeError if kind else ValueError
    return "" if isinstance(error, wanted) else f"{type(error).__name__}, not {wanted.__name__}"


@cache
def _public():
    """Every public callable and its parameters: functions, constructors, methods and operators of
    the public classes and of the machines' classes.
    """
    found = {}
    for module in MODULES:
        job = module.__name__.startswith("robokin.jobs.")
        prefix = f"{module.__name__.split('.')[-1]}." if job else ""
        names = getattr(module, "__all__", None) or [
            name
            for name, value in vars(module).items()
            if getattr(value, "__module__", None) == module.__name__ and name[0] != "_"
        ]
        for name in names:
            value = getattr(module, name)
            if inspect.isfunction(value):
                found[prefix + name] = _parameters(value)
            elif inspect.isclass(value) and not issubclass(value, Exception):
                found[prefix + name] = _parameters(value)
                _methods(value, found, prefix)
            elif isinstance(value, Arm):
                _methods(type(value), found, "")
    for arm in (LEVERS, POSITIONING, LOADER, two_link(1, 1)):
        _methods(type(arm), found, "")
    return tuple(found.items())


def _methods(kind, found, prefix):
    for name in dir(kind):
        member = getattr(kind, name)
        member = getattr(member, "__func__", member)  # the function of a class method
        ours = getattr(member, "__module__", None) or ""
        # Matplotlib checks the arguments of its own methods, also where ours extend them.
        theirs = issubclass(kind, MatplotlibFigure) and hasattr(MatplotlibFigure, name)
        public = (name[0] != "_" or name in OPERATORS) and not theirs
        if public and ours.startswith("robokin") and inspect.isfunction(member):
            if parameters := _parameters(member) - {"self", "cls"}:
                found[prefix + member.__qualname__] = parameters


def _parameters(call):
    return set(inspect.signature(call).parameters)
