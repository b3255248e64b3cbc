"""Compare the speed of robokin with that of other libraries: inverse kinematics, a straight motion
and forward kinematics, as ratios within one run.

    python -m venv /tmp/peers && /tmp/peers/bin/pip install -r tests/benchmarks/peers.txt -e .
    /tmp/peers/bin/python tests/benchmarks/bench_kinematics.py [rounds]

To see the result for a processor without AVX-512, set the environment variable
NPY_DISABLE_CPU_FEATURES="X86_V4 AVX512_ICL". A peer that is not installed is reported and left out.

Everything runs on one thread of one processor core. Our call and the peer's are timed in turn. Each
gets its input in the form that suits it best; preparing the input and freeing the result are not
timed. "Times as fast" is the median over the rounds of (peer's time / our time); "best" compares
the shortest times; "again" uses our second call in a row, whose code and data are still in the
cache. The aims apply to the first call. "Compiled part" is a private function behind a peer's
documented call; it is compared as well, although users do not call it.
"""

import gc
import os
import sys
from importlib import import_module
from importlib.metadata import version
from time import perf_counter, process_time

# before NumPy and the peers start their threads
for _library in ("OMP", "OPENBLAS", "MKL", "RAYON"):
    os.environ[f"{_library}_NUM_THREADS"] = "1"

import numpy as np  # noqa: E402

from robokin import IRB140, PUMA560, lin  # noqa: E402

POSES, SAMPLES, SINGULAR = 10_000, 2_000, 1_000
PEERS = {
    "py_opw_kinematics": "py-opw-kinematics",
    "eaik": "EAIK",
    "roboticstoolbox": "roboticstoolbox-python",
}
# The parameters of the two arms for OPW (metres, radians). In its zero posture the arm is stretched
# upwards and all axes point along +y or +z; the offsets and the flipped axes convert this to ours.
# `fk_case` prints the distance between the two flanges.
OPW = {
    "IRB-140": {
        "a1": 0.070,
        "a2": 0.0,
        "b": 0.0,
        "c1": 0.352,
        "c2": 0.350,
        "c3": 0.380,
        "c4": 0.065,
        "offsets": (0, 0, -np.pi / 2, 0, 0, 0),
        "flip_axes": (False, True, False, False, False, False),
    },
    "PUMA 560": {
        "a1": 0.0,
        "a2": 0.0203,
        "b": -0.15005,
        "c1": 0.67183,
        "c2": 0.4318,
        "c3": 0.4318,
        "c4": 0.0,
        "offsets": (0, -np.pi / 2, np.pi / 2, 0, 0, 0),
        "flip_axes": (False, True, True, False, True, False),
    },
}


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 60
    here = installed()
    level = describe_processor()
    cases = [ik_case(arm, here) for arm in (IRB140, PUMA560)]
    cases += [lin_case(here), *(fk_case(arm, here) for arm in (IRB140, PUMA560))]
    for case in cases:  # before the process is bound to one core, which would hide extra threads
        case["threads"] = {
            name: threads(call) for name, call in {"robokin": case["ours"], **case["peers"]}.items()
        }
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    for case in cases:
        report(case, rounds, level)


def installed():
    """Return the installed peers by module name, and print the names of the missing ones."""
    here = {}
    for module, package in PEERS.items():
        try:
            here[module] = import_module(module)
            print(f"{package} {version(package)}")
        except Exception as error:  # not installed, or incompatible with this NumPy
            print(f"{package}: left out, it cannot be imported ({error})")
    return here


def describe_processor():
    """Print the SIMD level that NumPy uses; return the width of its registers in bits, 512 or
    256.
    """
    found = np.show_config(mode="dicts")["SIMD Extensions"]["found"]
    wide = any("512" in feature or feature == "X86_V4" for feature in found)
    y, x = np.random.default_rng(0).normal(size=(2, 4096))
    best = min(clock(lambda: np.arctan2(y, x)) for _ in range(200))
    print(
        f"NumPy {np.__version__}, vector level {' '.join(found)} "
        f"({'AVX-512' if wide else 'no AVX-512'}); "
        f"arctan2 {best / len(x) * 1e9:.1f} ns per element\n"
    )
    return 512 if wide else 256


# ---- the cases -----------------------------------------------------------------------------------


def ik_case(arm, here):
    """All branches of many poses. The aim is relative to the fastest peer."""
    rng = np.random.default_rng(6)
    pose = arm.fk(rng.uniform(-np.pi, np.pi, (POSES, 6)))
    q = rng.uniform(-np.pi, np.pi, (SINGULAR, 6))
    q[:, 4] = 0
    singular = arm.fk(q)
    rows, notes = arm.ik(pose), []
    notes.append(
        f"robokin: {exist(rows).sum()} solutions, {exist(arm.ik(singular)).sum() / SINGULAR:.2f} "
        f"per pose "
        "where joint 5 is 0"
    )
    peers = {}
    for prepare, unpack in ((opw_ik, opw_rows), (eaik_ik, eaik_rows)):
        for name, call in prepare(arm, pose, here).items():
            peers[name] = call
            theirs = unpack(call())
            few = unpack(prepare(arm, singular, here)[name]())
            unknown, missed = disagreement(rows, theirs)
            notes.append(
                f"{name}: {exist(theirs).sum()} solutions, {unknown} not among ours, {missed} of "
                f"ours missed; "
                f"{exist(few).sum() / SINGULAR:.2f} per pose where joint 5 is 0"
            )
    return {
        "title": f"IK, all branches, {POSES} poses, {arm.name}",
        "count": POSES,
        "ours": lambda: arm.ik(pose),
        "peers": peers,
        "notes": notes,
        "mark": {512: 5, 256: 2},
    }


def lin_case(here):
    """A straight motion between two poses of the PUMA 560."""
    start, goal = PUMA560.fk(np.random.default_rng(7).uniform(-1, 1, (2, 6)))
    s = np.linspace(0, 1, SAMPLES)
    peers, notes = {}, []
    if "roboticstoolbox" in here:
        toolbox, SE3 = here["roboticstoolbox"], import_module("spatialmath").SE3
        first, last = SE3(start.as_matrix()), SE3(goal.as_matrix())
        peers["roboticstoolbox ctraj(s=s)"] = lambda: toolbox.ctraj(first, last, s=s)
        away = abs(
            np.array(toolbox.ctraj(first, last, s=s).A) - lin(start, goal, s).as_matrix()
        ).max()
        notes.append(f"greatest difference of a matrix element: {away:.0e}")
    return {
        "title": f"LIN, {SAMPLES} poses",
        "count": SAMPLES,
        "ours": lambda: lin(start, goal, s),
        "peers": peers,
        "notes": notes,
        "mark": {512: 250, 256: 250},
    }


def fk_case(arm, here):
    """The flange pose of many postures."""
    q = np.random.default_rng(8).uniform(-np.pi, np.pi, (POSES, 6))
    peers = {}
    if "py_opw_kinematics" in here:
        robot = opw_robot(arm, here)
        peers["opw batch_forward"] = lambda: robot.batch_forward(q)
        peers["opw batch_forward, compiled part"] = lambda: robot._robot.batch_forward(q)
    # the peer's IRB-140 is a different model, with an upper arm of 360 mm
    if "roboticstoolbox" in here and arm is PUMA560:
        robot2 = here["roboticstoolbox"].models.DH.Puma560()
        chain = robot2.ets()
        peers["roboticstoolbox ETS eval (compiled)"] = lambda: chain.eval(q)
        peers["roboticstoolbox fkine"] = lambda: robot2.fkine(q)
    want, notes = arm.fk(q).as_matrix(), []
    for name, call in peers.items():
        theirs = call()
        theirs = (
            theirs.as_matrix()
            if hasattr(theirs, "as_matrix")
            else np.array(getattr(theirs, "A", theirs))
        )
        away = abs(theirs.reshape(want.shape) - want).max()
        notes.append(f"{name}: greatest difference of a matrix element {away:.0e}")
    return {
        "title": f"FK, {POSES} joint rows, {arm.name}",
        "count": POSES,
        "ours": lambda: arm.fk(q),
        "peers": peers,
        "notes": notes,
        "mark": {},
    }


# ---- calls to the peers --------------------------------------------------------------------------


def opw_robot(arm, here):
    opw = here["py_opw_kinematics"]
    return opw.Robot(opw.KinematicModel(**OPW[arm.name]), degrees=False)


def opw_ik(arm, pose, here):
    """This peer's function `reach`, which returns all eight rows: called as documented, and also
    without its wrapper, which is faster.

    It also computes a singular value for every row inside the limits, which takes most of its time
    and is not needed here. We therefore pass limits that no row satisfies.
    """
    if "py_opw_kinematics" not in here:
        return {}
    robot, matrices = opw_robot(arm, here), pose.as_matrix()
    rigid = import_module("scipy.spatial.transform").RigidTransform.from_matrix(matrices)
    flat = np.ascontiguousarray(matrices.reshape(-1, 16))
    never = np.tile([9.0, 9.1], (6, 1))
    pairs = [tuple(pair) for pair in never]
    return {
        "opw reach": lambda: robot.reach(rigid, joint_limits=never, threads=1).joints,
        "opw reach, compiled part": lambda: robot._robot.reach(flat, pairs, None, 1)[0],
    }


def opw_rows(result):
    return result


def eaik_ik(arm, pose, here):
    """`IK_batched` with one worker, on a list of matrices. Its model has no fixed rotation after
    axis 6, so this rotation is removed from the poses.
    """
    if "eaik" not in here:
        return {}
    frames = arm.frames(np.zeros(6))
    joints = [frames[i] @ link.before for i, link in enumerate(arm.links)]
    axes = np.array(
        [joint.rotation @ link.axis for joint, link in zip(joints, arm.links, strict=True)]
    )
    points = np.array(
        [np.zeros(3), *(joint.translation for joint in joints), frames[6].translation]
    )
    robot = import_module("eaik.IK_HP").HPRobot(axes, np.diff(points, axis=0))
    matrices = pose.as_matrix()
    matrices[:, :3, :3] = matrices[:, :3, :3] @ frames[6].rotation.as_matrix().T
    matrices = list(matrices)
    return {"EAIK IK_batched": lambda: robot.IK_batched(matrices, num_worker_threads=1)}


def eaik_rows(result):
    """The exact solutions of EAIK (not its least-squares ones) as rows (N, most, 6), with NaN."""
    rows = np.full((len(result), max(one.num_solutions() for one in result), 6), np.nan)
    for row, one in zip(rows, result, strict=True):
        exact = one.Q[~np.asarray(one.is_LS, dtype=bool)]
        row[: len(exact)] = exact
    return rows


# ---- agreement, time, report ---------------------------------------------------------------------


def exist(rows):
    return ~np.isnan(rows).any(axis=-1)


def disagreement(ours, theirs):
    """Return how many of the peer's rows are not among ours, and how many of ours are not among the
    peer's, modulo 2 pi and within 1e-6.
    """
    away = 0.0
    for i in range(6):
        difference = ours[:, :, None, i] - theirs[:, None, :, i]
        away = np.maximum(away, abs(difference - 2 * np.pi * np.round(difference / (2 * np.pi))))
    same = away < 1e-6  # NaN never matches
    return (exist(theirs) & ~same.any(axis=1)).sum(), (exist(ours) & ~same.any(axis=2)).sum()


def clock(call):
    start = perf_counter()
    result = call()  # noqa: F841  (freed after the clock is read)
    return perf_counter() - start


def threads(call):
    """Processor time divided by wall time: 1 for one busy thread, less if other processes use the
    processor.
    """
    call()
    cpu, wall = process_time(), perf_counter()
    for _ in range(3):
        call()
    return (process_time() - cpu) / (perf_counter() - wall)


def race(ours, theirs, rounds):
    """The times in seconds (rounds, 3) of our call, a second call of ours and the peer's call, in
    turn. There are fewer rounds if a round takes a long time.
    """
    gc.collect()
    gc.disable()
    times = [(clock(ours), clock(ours), clock(theirs))]
    for _ in range(min(rounds, max(3, int(10 / sum(times[0])))) - 1):
        times.append((clock(ours), clock(ours), clock(theirs)))
    gc.enable()
    return np.array(times)


def report(case, rounds, level):
    print(case["title"])
    scale, lowest = 1e6 / case["count"], np.inf
    for name, call in case["peers"].items():
        times = race(case["ours"], call, rounds)
        first, again, peer = np.median(times, axis=0) * scale
        first_best, _, peer_best = times.min(axis=0) * scale
        ratio, ratio_again = np.median(times[:, 2:] / times[:, :2], axis=0)
        lowest = min(lowest, ratio)
        print(
            f"  {name:36s} {peer:7.3f} us each (best {peer_best:.3f}), "
            f"robokin {first:.3f} (best {first_best:.3f}, again {again:.3f}): "
            f"{ratio:6.2f} times as fast (best {peer_best / first_best:.2f}, again "
            f"{ratio_again:.2f}), "
            f"{len(times)} rounds"
        )
    if not case["peers"]:
        best = min(clock(case["ours"]) for _ in range(rounds))
        print(f"  no peer; robokin best {best * scale:.3f} us each")
    elif level in case["mark"]:
        mark = case["mark"][level]
        print(
            f"  {lowest:.2f} times as fast as the fastest peer, the aim is {mark}: "
            f"{'reached' if lowest >= mark else 'NOT reached'}"
        )
    for note in case["notes"]:
        print(f"  {note}")
    print(
        "  processor time / wall time: "
        + ", ".join(f"{name} {x:.2f}" for name, x in case["threads"].items())
        + "\n"
    )


if __name__ == "__main__":
    main()
