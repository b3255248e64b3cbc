"""Compare the speed of this version with that of the first one.

    python tests/benchmarks/bench_editions.py --rounds 5          all, about five minutes
    python tests/benchmarks/bench_editions.py ik fk --rounds 9    cases whose names contain a word
    python tests/benchmarks/bench_editions.py --old v1.0          compared with another commit

The first version is commit 2461cda, unpacked into a temporary folder. Each version runs in its own
process, which measures calls on one thread, in processor time; the two take turns, so that a busy
machine slows both equally. The script prints medians over the rounds; where their ratio and the
ratio of the fastest rounds differ by more than 10 %, it prints both, and the latter counts.

Aims: at most 1.10 times the first version's time, and 1.05 times for inverse kinematics; `import
robokin` at most 1.15 times `import numpy` (the fastest of 20 new processes each). A star marks
results above the aim. Nothing is asserted: look at the stars, and run those cases again alone.
"""

import argparse
import io
import os
import statistics
import subprocess
import sys
import tarfile
import tempfile
from functools import partial
from pathlib import Path
from time import process_time  # CPU time of this process alone

for _library in ("OMP", "OPENBLAS", "MKL"):  # before NumPy starts its threads
    os.environ[f"{_library}_NUM_THREADS"] = "1"

import numpy as np

import robokin as rk  # the version on PYTHONPATH

ROOT = Path(__file__).resolve().parent.parent.parent
OLD = "2461cda"
LIMIT, LIMIT_IK, LIMIT_IMPORT = 1.10, 1.05, 1.15
BATCH = 0.03  # seconds per measurement
BATCHES = 3  # measurements, of which the fastest counts
MANY, SAMPLES = 10_000, 2001


# ---- The process of one version


def serve():
    """Measure on request: read a line "name count", and print the seconds that one call takes."""
    found = {}
    for part in (kinematics, motions, jobs, figures):
        try:
            found |= part()
        except (ImportError, AttributeError) as error:  # this version lacks what the part measures
            print(f"{part.__name__} left out: {error}", file=sys.stderr)
    print(*found, sep="\n", end="\n\n", flush=True)
    for line in sys.stdin:
        name, count = line.rsplit(" ", 1)
        call = found[name]
        spans = []
        for _ in range(BATCHES):
            start = process_time()
            for _ in range(int(count)):
                call()
            spans.append(process_time() - start)
        print(min(spans) / int(count), flush=True)


# Each function returns a dict that maps a name to the call to measure. It tries both the old and
# the new names.


def kinematics():
    """Arms and transforms."""
    found, rng = {}, np.random.default_rng(10)
    for name, arm in arms().items():
        low, high = arm.limits.T
        q = low + (high - low) * rng.uniform(0, 1, (MANY, len(low)))
        poses = arm.fk(q)
        asked = {"": poses if len(low) > 3 else poses.translation.copy()}
        if name == "SCARA":
            angle = q[:, :3].sum(axis=-1)
            asked = {"": _scara_pose()(poses.translation, angle), " (poses)": poses}
        for what, target in asked.items():
            found[f"ik {name}{what}, {MANY}"] = partial(arm.ik, target)
            found[f"ik {name}{what}, 1"] = partial(arm.ik, target[5])
        if name in ("IRB-140", "SCARA", "elbow arm"):
            for what in ("fk", "frames", "jacobian"):
                found[f"{what} {name}, {MANY}"] = partial(getattr(arm, what), q)
                found[f"{what} {name}, 1"] = partial(getattr(arm, what), q[5])
        if name == "IRB-140":
            rows = arm.ik(poses)
            found[f"within, {MANY}"] = partial(rk.within, arm, q)
            found["within, 1"] = partial(rk.within, arm, q[5])
            found[f"nearest, {MANY}"] = partial(rk.nearest, arm, rows, q)
            found["nearest, 1"] = partial(rk.nearest, arm, rows[5], q[5])
            many, angles = poses, q[:, 0]
    one, two, _ = stations()
    matrix, points = many.as_matrix(), rng.normal(size=(MANY, 3))
    return found | {
        f"Transform @ Transform, {MANY}": lambda: many @ many,
        "Transform @ Transform, 1": lambda: one @ two,
        f"Transform @ points, {MANY}": lambda: many @ points,
        "Transform @ point, 1": lambda: one @ points[0],
        f"inverse, {MANY}": many.inverse,
        "inverse, 1": one.inverse,
        f"from_matrix, {MANY}": lambda: rk.Transform.from_matrix(matrix),
        "from_matrix, 1": lambda: rk.Transform.from_matrix(matrix[0]),
        f"as_matrix, {MANY}": many.as_matrix,
        f"Transform(), {MANY}": lambda: rk.Transform(many.rotation, points),
        "Transform(), 1": lambda: rk.Transform(translation=(0.1, 0.2, 0.3)),
        f"from_angle_axis, {MANY}": lambda: rk.Quaternion.from_angle_axis(angles, (0, 0, 1)),
        "from_angle_axis, 1": lambda: rk.Quaternion.from_angle_axis(0.3, (0, 0, 1)),
        "poses[5]": lambda: many[5],
    }


def motions():
    """Paths, laws, derivatives, and following a branch."""
    start, via, goal = stations()
    s = np.linspace(0, 1, 2000)
    there = _scara_pose()((0.3, 0.1, 0.1), 1.0), _scara_pose()((0.1, 0.3, 0.1), -1.0)
    zero = np.zeros(6)
    arm, t, rows, motion = a_motion()
    far = rk.Transform(translation=(900, 0, 500))
    found = {
        "lin, 2000": lambda: rk.lin(start, goal, s),
        "lin, 1": lambda: rk.lin(start, goal, 0.3),
        "lin SCARA, 2000": lambda: rk.lin(*there, s),
        "lin_lin, 2000": lambda: rk.lin_lin(start, via, goal, s),
        "blend parabola, 2000": lambda: rk.blend(start, via, goal, 0.1, s),
        "blend quintic, 2000": lambda: rk.blend(start, via, goal, 0.1, s, corner="quintic"),
        "lerp, 2000": lambda: start.lerp(goal, s),
        "slerp, 2000": lambda: start.rotation.slerp(goal.rotation, s),
        "ptp, 2000": lambda: rk.ptp(zero, motion[0], s),
        f"follow, {SAMPLES}": lambda: rk.follow(arm, rows, 0),
        "explain, usable": lambda: rk.explain(arm, start, 0),
        "explain, out of reach": lambda: rk.explain(arm, far, 0),
        f"differentiate, {SAMPLES}": lambda: rk.differentiate(motion, t),
        f"differentiate twice, {SAMPLES}": lambda: rk.differentiate(motion, t, 2),
    }
    for law in (rk.linear, rk.trapezoidal, rk.quintic):
        found[f"law {law.__name__}, {SAMPLES}"] = partial(law(5.0), t)
        found[f"law {law.__name__}, made"] = partial(law, 5.0)
    return found


def jobs():
    """Visits, obstacles, motors."""
    from robokin.jobs import obstacles, steppers
    from robokin.jobs import visit_collect as vc

    rng = np.random.default_rng(11)
    draw = rng.uniform([-np.pi, -0.4, -0.9], [np.pi, 0.9, 0.5], (300, 3))
    places = arms()["elbow arm"].fk(draw).translation
    places = places[places[:, 2] > 0]

    def task(count, T, kind):
        return vc.Task(5.0, 4.0, T, (0.2,) * 3, places[0], places[1 : count + 1], kind)

    visits, collects, few = (
        task(100, 1e6, "visit"),
        task(100, 1e6, "collect"),
        task(12, 60, "visit"),
    )
    visited = vc.visit(visits)
    levers, folded = rk.three_lever(0.5), np.array([90.0, 60, 90]) * rk.deg
    point, H, near = np.array([0.6, 0.5]), np.array([0.2, 1.1]), np.array([0.25, 0.5])
    path, alphas = np.stack([folded, folded + 0.5, folded - 0.5, folded]), np.linspace(1, 3, 1000)
    move = steppers.synchronised([0, 0, 0], [4000, -2000, 800])
    loader, ends = arms()["loader"], np.array([[1.5, 0.2, 0.3], [0.9, 0.9, 0.6]])
    per_degree, motion = np.array([10.0, 8, 12]), a_motion()[3][:, :3]
    return {
        "Task, 100": lambda: task(100, 1e6, "visit"),
        "visit, 100": lambda: vc.visit(visits),
        "collect, 100": lambda: vc.collect(collects),
        "best_visit, 12": lambda: vc.best_visit(few),
        "itinerary, 100": lambda: vc.itinerary(visits, visited),
        "least, 1": lambda: levers.least(point, folded),
        "family, 1000": lambda: levers.family(point, alphas),
        "table, 0.01 degrees": lambda: levers.table(point),
        "sweep, 0.01 degrees": lambda: levers.sweep(point, folded),
        "plan, direct": lambda: obstacles.plan(levers, folded, point, H, 0.05),
        "plan, search": lambda: obstacles.plan(levers, folded, point, near, 0.05),
        "clearance, 3 parts": lambda: obstacles.clearance(levers, path, H),
        f"counts, {SAMPLES}": lambda: steppers.counts(motion, per_degree),
        "pulses, 6800": move.pulses,
        "straight": lambda: steppers.straight(loader, *ends, per_degree),
    }


def figures():
    """Figures and players."""
    from robokin import show

    start, via, goal = targets = stations()
    arm, t, _, q = a_motion()
    v, a = rk.differentiate(q, t), rk.differentiate(q, t, 2)
    blends, few = np.linspace(0, 0.4, 5), t[::4]
    s = rk.quintic(5.0)(few)
    many = np.stack([rk.follow(arm, arm.ik(rk.blend(start, via, goal, b, s)), 0) for b in blends])
    return {
        "plot_joints, q v a": lambda: show.plot_joints(arm, t, q, v, a),
        "plot_joints, q": lambda: show.plot_joints(arm, t, q),
        "plot_postures": lambda: show.plot_postures(arm, q, targets=targets),
        "animate": lambda: show.animate(arm, t, q, targets=targets),
        "animate with slider": lambda: show.animate(
            arm, few, many, targets=targets, slider=("blend", blends)
        ),
    }


def arms():
    return {
        "IRB-140": rk.IRB140,
        "PUMA 560": rk.PUMA560,
        "DH arm": rk.ITMO6R,
        "elbow arm": rk.spbu_arm(5.0, 4.0),
        "loader": rk.loader_arm(1.2, 1.0),
        "two links": rk.two_link(0.5, 0.4),
        "SCARA": rk.SCARA,
    }


def stations():
    """Start, via and goal of a motion."""
    places = (0.5, (0.5, 0.1, 0.5)), (1.0, (0.5, -0.1, 0.6)), (1.5, (0.4, -0.2, 0.4))
    return [
        rk.Transform(rk.Quaternion.from_angle_axis(angle, (0, 1, 0)), place)
        for angle, place in places
    ]


def a_motion():
    """Arm, times, rows of `ik` and joint values of a blended motion."""
    law = rk.quintic(5.0)
    t = np.linspace(0, law.duration, SAMPLES)
    rows = rk.IRB140.ik(rk.blend(*stations(), 0.1, law(t)))
    return rk.IRB140, t, rows, rk.follow(rk.IRB140, rows, 0)


def _scara_pose():
    return getattr(rk, "ScaraPose", None) or rk.Target


# ---- Comparison of the two versions


class Edition:
    """A process that runs one version of the package."""

    def __init__(self, folder):
        self.process = subprocess.Popen(
            [sys.executable, __file__, "--serve"],
            env=os.environ | {"PYTHONPATH": str(folder), "PYTHONWARNINGS": "ignore"},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self.names = []
        while name := self._answer():
            self.names.append(name)

    def time(self, name, count):
        print(name, count, file=self.process.stdin, flush=True)
        return float(self._answer())

    def _answer(self):
        line = self.process.stdout.readline()
        if not line:
            sys.exit(f"the process of a version ended with exit status {self.process.wait()}")
        return line.strip()

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def main():
    arguments = _arguments()
    with tempfile.TemporaryDirectory(prefix="robokin-editions-") as folder:
        packed = subprocess.run(
            ["git", "archive", arguments.old, "robokin"], cwd=ROOT, capture_output=True, check=True
        ).stdout
        tarfile.open(fileobj=io.BytesIO(packed)).extractall(folder, filter="data")
        worst = compare(folder, arguments)
        if not arguments.words or "import" in arguments.words:
            imports(folder)
    print(f"{worst} above the limits" if worst else "nothing above the limits")


def compare(folder, arguments):
    """Print a line for every case and return how many are above their limit."""
    old, new = Edition(folder), Edition(ROOT)
    names = [n for n in new.names if not arguments.words or any(w in n for w in arguments.words)]
    for name in set(names) - set(old.names):
        print(f"only in this version: {name}")
    names = [name for name in names if name in old.names]
    counts = {n: max(1, round(BATCH / max(old.time(n, 1), 1e-7))) for n in names}
    for name in names:  # warm up
        new.time(name, 1)
    spans = {name: ([], []) for name in names}
    for k in range(arguments.rounds):
        for name in names:
            pair = list(zip((old, new), spans[name], strict=True))
            for edition, found in pair if k % 2 else pair[::-1]:
                found.append(edition.time(name, counts[name]))
    old.close(), new.close()
    print(f"{'':34} {'old':>10} {'new':>10}  {'ratio':>6}  of the fastest")
    above = 0
    for name, (before, after) in spans.items():
        ratio = statistics.median(after) / statistics.median(before)
        fastest = min(after) / min(before)
        apart = max(ratio, fastest) > 1.1 * min(ratio, fastest)
        limit = LIMIT_IK if name.startswith("ik ") else LIMIT
        high = (fastest if apart else ratio) > limit
        above += high
        print(
            f"{name:34} {_span(statistics.median(before))} {_span(statistics.median(after))}  "
            f"{ratio:6.2f}  {f'{fastest:6.2f}' if apart else '      '}  {'*' if high else ''}"
        )
    return above


def imports(folder):
    """Print the cost of the import relative to NumPy's, measured in turn in new processes."""
    timed = "import time; s = time.process_time(); import {}; print(time.process_time() - s)"
    spans = {"numpy": [], "old": [], "new": []}
    # Write byte code, as on a student's machine, even if the environment forbids it.
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    with tempfile.TemporaryDirectory() as cache:
        environment |= {"PYTHONPYCACHEPREFIX": cache}
        for _ in range(21):
            for name, module, path in (
                ("numpy", "numpy", folder),
                ("old", "robokin", folder),
                ("new", "robokin", ROOT),
            ):
                run = subprocess.run(
                    [sys.executable, "-c", timed.format(module)],
                    env=environment | {"PYTHONPATH": str(path)},
                    text=True,
                    capture_output=True,
                    check=True,
                )
                spans[name].append(float(run.stdout))
    # the first run, which writes the byte code, does not count
    numpy, old, new = (min(values[1:]) for values in spans.values())
    print(
        f"import: NumPy {numpy * 1e3:.1f} ms, old {old / numpy:.3f} times that, new "
        f"{new / numpy:.3f}{' *' if new / numpy > LIMIT_IMPORT else ''}"
    )


def _span(seconds):
    unit, size = ("s", 1) if seconds >= 1 else ("ms", 1e-3) if seconds >= 1e-3 else ("us", 1e-6)
    return f"{seconds / size:7.2f} {unit:2}"


def _arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("words", nargs="*", help="only cases whose name contains one of these")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--old", default=OLD, help="the commit to compare with")
    return parser.parse_args()


if __name__ == "__main__":
    serve() if sys.argv[1:] == ["--serve"] else main()
