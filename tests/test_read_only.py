"""Visible arrays are read-only copies of the arguments.

A separate process tries assignments that a student might make, on everything that can be reached
from the robots and from the values of a lesson, before it computes anything. Each assignment raises
an error or changes nothing, and `ik` is correct afterwards.
"""

import copy
import dataclasses
import hashlib
import importlib
import json
import pickle
import pkgutil
import subprocess
import sys
from functools import partial
from types import MappingProxyType

import numpy as np
import pytest
from machines import reach

import robokin
from robokin import (
    IRB140,
    ITMO6R,
    PUMA560,
    SCARA,
    Arm,
    Link,
    Quaternion,
    ScaraPose,
    TimeLaw,
    Transform,
    elbow_arm,
    follow,
    lin,
    loader_arm,
    nearest,
    quintic,
    record,
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
from robokin._arrays import Sealed
from robokin.jobs import obstacles, steppers
from robokin.jobs.conveyor import serve
from robokin.jobs.visit_collect import KEYS, Result, Task, itinerary, visit
from robokin.motion import differentiate
from robokin.show import JOINT_STYLES

A = Transform(Quaternion.from_angle_axis(0.3, (0, 0, 1)), (0.4, 0.1, 0.5))
B = Transform(Quaternion.from_angle_axis(0.4, (0, 1, 0)), (0.3, -0.2, 0.6))
TIMES = np.linspace(0, 1, 9)
HOME = np.array([90.0, 60, 90]) * robokin.deg
POINTS = np.array([[1.0, 0.5, 1.0], [0.8, -0.5, 1.2]])
MACHINES = {
    "IRB140": IRB140,
    "SCARA": SCARA,
    "PUMA560": PUMA560,
    "ITMO6R": ITMO6R,
    "spbu_arm": spbu_arm(2.0, 1.5),
    "loader_arm": loader_arm(1.2, 1.0),
    "two_link": two_link(0.5, 0.4),
}


def task():
    return Task(2.0, 1.5, 20.0, [0.5] * 3, [1.0, 0.0, 1.0], POINTS.tolist(), "visit")


def recording():
    """A recording with a gap, a jump in position and a jump in speed."""
    q = np.sin(TIMES)[:, None] * np.ones(6) + 2 * (TIMES > 0.8)[:, None]
    q[3] = np.nan
    return record(IRB140, TIMES, q)


def plan():
    return obstacles.plan(three_lever(0.5), HOME, (0.6, 0.5), (0.2, 1.1))


# For each name: a function that makes the object. The robots come first, before their inverse is
# used.
ROOTS = {
    **{name: lambda arm=arm: arm for name, arm in MACHINES.items()},
    "three_lever": lambda: three_lever(0.5),
    "three_lever, unequal": lambda: three_lever((0.5, 0.4, 0.3)),
    "arm without an inverse": lambda: Arm("links", three_lever(0.5).links, [(0, 1)] * 3),
    "turning_base": lambda: turning_base(three_lever(0.5)),
    "Link": Link,
    "identity": Transform,
    "pose": lambda: Transform(A.rotation, (0.1, 0.2, 0.3)),
    "poses": lambda: lin(A, B, TIMES),
    "one of many poses": lambda: lin(A, B, TIMES)[1],
    "some poses": lambda: lin(A, B, TIMES)[2:4],
    "inverse": A.inverse,
    "product": lambda: A @ B,
    "fk": lambda: IRB140.fk(np.zeros((2, 6))),
    "frames": lambda: IRB140.frames(np.zeros(6)),
    "from a matrix": lambda: Transform.from_matrix(np.eye(4)),
    "identities": lambda: Transform.identity((2,)),
    "quaternion": lambda: Quaternion([0.6, 0.8, 0, 0]),
    "quaternions": lambda: A.rotation.slerp(B.rotation, TIMES),
    "no turn": Quaternion.identity,
    "SCARA's pose": lambda: ScaraPose((0.3, 0.1, 0.1), 0.5),
    "SCARA's poses": lambda: lin(ScaraPose((0.3, 0.1, 0.1)), ScaraPose((0.1, 0.3, 0.1)), TIMES),
    "quintic": lambda: quintic(2.0),
    "trapezoidal": lambda: trapezoidal(2.0),
    "recording": recording,
    "recordings": lambda: record(SCARA, TIMES, np.zeros((2, 9, 4))),
    "task": task,
    "result": lambda: visit(task()),
    "trips": lambda: serve([0.1, 0.4], 0.1, [0, 0.1], [0.5, 0.6])[0],
    "stepper": steppers.Stepper,
    "move": lambda: steppers.synchronised([0, 0, 0], [40, -20, 8]),
    "run of a rotor": lambda: steppers.Stepper().run([0.01], [1]),
    "plan": plan,
    "JOINT_STYLES": lambda: JOINT_STYLES,
    "COLUMNS": lambda: steppers.COLUMNS,
    "KEYS": lambda: KEYS,
    "LEVERS": lambda: obstacles.LEVERS,
}

# Values that contain an array: for each name, a function that makes the value, and the array.
KEEPS = {
    "Quaternion": (Quaternion, [[0.6, 0.8, 0, 0], [1, 0, 0, 0]]),
    "Quaternion.from_matrix": (Quaternion.from_matrix, np.eye(3)),
    "Transform": (lambda p: Transform(A.rotation, p), [1.0, 2, 3]),
    "Transform, many rotations": (lambda p: Transform(Quaternion.identity((2,)), p), [1.0, 2, 3]),
    "Transform.from_matrix": (Transform.from_matrix, [np.eye(4)] * 2),
    "ScaraPose": (ScaraPose, [0.3, 0.1, 0.1]),
    "ScaraPose's angle": (lambda angle: ScaraPose((0.3, 0.1, 0.1), angle), [0.1, 0.2]),
    "Link": (lambda axis: Link(axis=axis), [0.0, 0.6, 0.8]),
    "limits": (lambda limits: spherical_wrist("x", IRB140.links, limits), IRB140.limits),
    "speed limits": (lambda v: spherical_wrist("x", IRB140.links, IRB140.limits, v), np.ones(6)),
    "limits of a SCARA": (lambda limits: scara_arm("x", 0.2, 0.2, 0.3, limits), SCARA.limits),
    "limits of an elbow": (
        lambda limits: elbow_arm("x", MACHINES["spbu_arm"].links, limits),
        MACHINES["spbu_arm"].limits,
    ),
    "base": (lambda base: two_link(0.5, 0.4, base), [0.1, 0.2]),
    "times of a recording": (lambda t: record(IRB140, t, np.ones((9, 6))), TIMES),
    "joints of a recording": (lambda q: record(IRB140, TIMES, q), np.ones((9, 6))),
    "times of a move": (lambda t: steppers.Move(t, np.array([[0.0], [2], [4]])), [0.0, 1, 2]),
    "positions of a move": (lambda p: steppers.Move(np.arange(3.0), p), [[0.0], [2], [4]]),
    "speeds of a task": (
        lambda v: Task(2.0, 1.5, 20.0, v, [1.0, 0.0, 1.0], POINTS, "visit"),
        [0.5] * 3,
    ),
    "points of a task": (
        lambda p: Task(2.0, 1.5, 20.0, [0.5] * 3, [1.0, 0.0, 1.0], p, "visit"),
        POINTS,
    ),
    "posture of a plan": (lambda q: obstacles.plan(three_lever(0.5), q, (0.6, 0.5)), HOME),
}

# Functions that return an array: the caller may change it without changing the next result.
GIVES = {
    "ik": lambda: IRB140.ik(A),
    "within": lambda: within(IRB140, np.ones(6)),
    "nearest": lambda: nearest(IRB140, IRB140.ik(A), np.ones(6)),
    "representative": lambda: representative(IRB140, np.ones(6)),
    "singular values": lambda: singular_values(IRB140, np.ones(6)),
    "ik of a SCARA": lambda: SCARA.ik(ScaraPose((0.3, 0.1, 0.1))),
    "jacobian": lambda: IRB140.jacobian(np.ones(6)),
    "matrix": A.as_matrix,
    "point": lambda: A @ np.ones(3),
    "axis": lambda: A.rotation.as_angle_axis()[1],
    "phases": lambda: steppers.phases("wave", "unipolar"),
    "follow": lambda: follow(IRB140, IRB140.ik(lin(A, B, TIMES)), 0),
    "differentiate": lambda: differentiate(np.ones((9, 2)), TIMES),
    "itinerary": lambda: itinerary(TASK, visit(TASK))[1],
    "law": lambda: LAW(TIMES),
    "table": lambda: LEVERS.table((0.6, 0.5), 0.1),
    "family": lambda: LEVERS.family((0.6, 0.5), 2.0),
    "pulses": lambda: MOVE.pulses()[0][0],
}
TASK, LAW, LEVERS = task(), quintic(1.0), three_lever(0.5)
MOVE = steppers.synchronised([0, 0, 0], [40, -20, 8])


@pytest.fixture(scope="module")
def tried():
    """The output of two new processes: one attempts every write, the other attempts none."""
    runs = [
        subprocess.Popen([sys.executable, __file__, how], stdout=subprocess.PIPE, text=True)
        for how in ("attack", "look")
    ]
    answers = [run.communicate(timeout=120)[0] for run in runs]
    assert not any(run.returncode for run in runs)
    return [json.loads(answer) for answer in answers]


@pytest.mark.parametrize("root", ROOTS)
def test_assignments_raise_or_change_nothing(tried, root):
    assert tried[0]["changed"][root] == []
    after, untouched = (answer["seen"][root] for answer in tried)
    assert after == untouched and len(after) > 0


def test_ik_is_unchanged_by_attempts_to_write(tried):
    after, untouched = (answer["ik"] for answer in tried)
    assert after == untouched
    assert max(after["error"].values()) < 1e-9 and len(after["error"]) == len(MACHINES)


@pytest.mark.parametrize("name", KEEPS)
def test_arguments_are_copied(name):
    make, given = KEEPS[name]
    given = np.array(given, dtype=float)
    value = make(given)
    before = dict(_seen(value))
    given += 1  # the caller can still change its own array
    assert before and dict(_seen(value)) == before


@pytest.mark.parametrize("name", GIVES)
def test_changes_to_a_result_do_not_affect_later_results(name):
    first = GIVES[name]()
    before = first.copy()
    first[...] = 99
    np.testing.assert_array_equal(GIVES[name](), before)


SEALED = (
    "robokin.quaternion",
    "robokin.transform",
    "robokin.arms",
    "robokin.motion",
    "robokin.jobs",
)
COPIES = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    "pickle": lambda value: pickle.loads(pickle.dumps(value)),
}


def sealed_classes():
    """The dataclasses of the packages in `SEALED`."""
    found = {}
    for module in pkgutil.walk_packages(robokin.__path__, "robokin."):
        if module.name.startswith(SEALED) and not module.name.endswith("__main__"):
            for value in vars(importlib.import_module(module.name)).values():
                if isinstance(value, type) and dataclasses.is_dataclass(value):
                    found[value.__name__] = value
    return list(found.values())


def _values(value):
    """A value and all values inside it."""
    yield value
    inside = value if isinstance(value, tuple) else vars(value).values() if _ours(value) else ()
    for each in inside:
        yield from _values(each)


@pytest.fixture(scope="module")
def examples():
    """One value of each class, including values that are cached on first use, by class."""
    found = {}
    for make in ROOTS.values():
        for value in _values(make()):
            found.setdefault(type(value), value)
    for value in found.values():
        dict(_seen(value))
    return found


@pytest.mark.parametrize("kind", sealed_classes(), ids=lambda kind: kind.__name__)
@pytest.mark.parametrize("how", COPIES)
def test_copies_are_read_only_too(examples, kind, how):
    assert issubclass(kind, Sealed) and kind.__dataclass_params__.frozen
    assert kind.__setattr__ is not kind.__mro__[1].__setattr__, (
        "a frozen base class protects only itself"
    )
    value = COPIES[how](examples[kind])
    assert dict(_seen(value)) == dict(_seen(examples[kind]))
    for name in [*vars(value), "another"]:
        with pytest.raises(AttributeError):
            setattr(value, name, 1)
        with pytest.raises(AttributeError):
            delattr(value, name)
    arrays = [one for one in _values(value) if isinstance(one, np.ndarray)]
    assert arrays or kind in (TimeLaw, Result, steppers.Stepper)
    assert not any(array.flags.writeable for array in arrays)


def test_attack_detects_writable_arrays():
    # The attack must detect writable arrays, lists and attributes of an object.
    class Open:
        def __init__(self):
            self.array, self.items, self.word = np.zeros(2), [{"x": 1}], "a"

    Open.__module__ = "robokin.open"
    changed = []
    _attack(lambda: value, "value", changed, {}) if (value := Open()) else None
    assert {"value.array[...]", "value.items.append", "value.items[0][...]", "value.word ="} <= set(
        changed
    )
    assert value.array.tolist() == [0, 0] and value.items == [{"x": 1}] and value.word == "a"


# ---- The process that tries the assignments


def main(how):
    roots, changed = {}, {}
    for name, make in ROOTS.items():
        roots[name] = root = make()
        changed[name] = []
        if how == "attack":
            _attack(lambda root=root: root, name, changed[name], {})
    errors, digests = {}, {}
    for name, arm in MACHINES.items():
        q = np.array([[0.1, 0.2, -0.3, 0.4, 0.5, 0.6], [1, 0.5, 1, -1, 1, 2]])[:, : len(arm.limits)]
        pose = arm.fk(q)
        rows = arm.ik(pose)
        again = arm.fk(rows[~np.isnan(rows).any(axis=-1)]).translation
        apart = np.linalg.norm(again[:, None] - pose.translation, axis=-1).min(axis=-1)
        nearest = abs(np.sin((rows - q[:, None]) / 2)).max(axis=-1)
        errors[name] = float(max(apart.max() / reach(arm), np.nanmin(nearest, axis=-1).max()))
        digests[name] = _text(rows)
    seen = {name: list(_seen(root)) for name, root in roots.items()}
    json.dump(
        {"changed": changed, "seen": seen, "ik": {"error": errors, "rows": digests}}, sys.stdout
    )


def _attack(fetch, path, changed, known):
    """Try to overwrite everything reachable from the value that `fetch` returns; successful writes
    are undone and recorded in `changed`.
    """
    value = fetch()
    if id(value) in known or path.count(".") + path.count("[") > 12:
        return
    known[id(value)] = value
    if isinstance(value, np.ndarray):
        _attack_array(fetch, path, changed)
    elif isinstance(value, (list, dict)):
        _attack_container(value, path, changed)
    if isinstance(value, (tuple, list)):
        for i in range(len(value)):
            _attack(lambda i=i: value[i], f"{path}[{i}]", changed, known)
    elif isinstance(value, (dict, MappingProxyType)):
        for key in list(value):
            _attack(lambda key=key: value[key], f"{path}[{key!r}]", changed, known)
    elif _ours(value):
        stored = list(getattr(value, "__dict__", ()))  # existing values come before computed ones
        for name in [*stored, *sorted(set(dir(value)) - set(stored))]:
            if not name.startswith("__"):
                _attack_name(value, name, path, changed)
                if not callable(getattr(value, name)):
                    _attack(partial(getattr, value, name), f"{path}.{name}", changed, known)
        if getattr(value, "shape", ()):
            _attack(lambda: value[0], f"{path}[0]", changed, known)


def _attack_array(fetch, path, changed):
    before = fetch().copy()
    other = ~before if before.dtype == bool else before + 1 if before.dtype.kind in "iuf" else None
    if other is None or not before.size:
        return

    def assign(array):
        array[...] = other

    def add(array):
        array += 1

    def fill(array):
        array.fill(99)

    def sort(array):
        array[...] = np.sort(array, axis=None)[::-1].reshape(array.shape)

    for name, act in (("[...]", assign), (" +=", add), (".fill", fill), (" sorted", sort)):
        array = fetch()
        try:
            act(array)
        except (ValueError, TypeError):
            continue
        if not np.array_equal(fetch(), before, equal_nan=before.dtype.kind == "f"):
            changed.append(path + name)
            array[...] = before


def _attack_container(value, path, changed):
    before = value.copy()
    if isinstance(value, list):
        value.append(99)
        changed.append(f"{path}.append")
        value[:] = before
    else:
        value["new"] = 99
        changed.append(f"{path}[...]")
        value.clear()
        value.update(before)


def _attack_name(value, name, path, changed):
    def same():
        now = getattr(value, name, changed)
        return now is before or (not callable(before) and list(_seen(now)) == list(_seen(before)))

    before = getattr(value, name)
    stored = name in getattr(value, "__dict__", ())
    for how, act in (
        (" =", lambda: setattr(value, name, 99)),
        (" del", lambda: delattr(value, name)),
    ):
        try:
            act()
        except (AttributeError, TypeError):  # FrozenInstanceError is an AttributeError
            continue
        if not same():
            changed.append(f"{path}.{name}{how}")
            if stored:
                object.__setattr__(value, name, before)
            elif name in getattr(value, "__dict__", ()):
                object.__delattr__(value, name)


def _seen(value, path="", depth=0):
    """Everything visible in a value, as pairs of path and text."""
    if isinstance(value, (tuple, list)):
        for i, item in enumerate(value):
            yield from _seen(item, f"{path}[{i}]", depth + 1)
    elif isinstance(value, (dict, MappingProxyType)):
        for key, item in value.items():
            yield from _seen(item, f"{path}[{key!r}]", depth + 1)
    elif _ours(value) and depth < 12:
        for name in dir(value):
            item = getattr(value, name)
            if not name.startswith("_") and not callable(item):
                yield from _seen(item, f"{path}.{name}", depth + 1)
    else:
        yield [path, _text(value)]


def _text(value):
    if isinstance(value, np.ndarray):
        numbers = np.ascontiguousarray(value)
        return f"{value.dtype} {value.shape} {hashlib.sha256(numbers.tobytes()).hexdigest()}"
    return f"{type(value).__name__} {value!r}"


def _ours(value):
    return type(value).__module__.startswith("robokin")


if __name__ == "__main__":
    main(sys.argv[1])
