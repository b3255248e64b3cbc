"""Check the arguments of figures and players before anything is drawn."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

import numpy as np

from .._arrays import Floats
from .._validate import choice, floats, instance, length, short, whole
from ..arms.arm import Arm
from ..motion.derivatives import rising
from ..motion.recording import Jump, Recording, record
from ..transform import Transform
from .checks import in_sight, plain, several
from .numbers import tidy
from .page import Slider, Switch, Watch
from .things import Faces, Mark, Target, Thing
from .things.thing import as_place, as_reading

Targets: TypeAlias = Transform | Iterable[Transform] | Mapping[Any, Transform]


def named_targets(targets: Targets) -> dict[str, Transform]:
    """Return `targets` as a dict that maps each name to a Transform. In a list, a single pose is
    named target, two poses are named start and goal, three are named start, via and goal, and more
    are named P1, P2, ... Raises TypeError if an item is not a pose, and ValueError if it is a batch
    of poses.
    """
    named = posed(targets)
    for name, pose in named.items():
        if pose.shape:
            raise ValueError(
                f"target {name}: wanted a single pose, got a batch of shape {pose.shape}"
            )
    return named


def posed(targets: Targets) -> dict[str, Transform]:
    """Do the same as `named_targets`, but accept batches of poses."""
    if isinstance(targets, Transform):
        targets = list(targets) if targets.shape else [targets]
    if isinstance(targets, Mapping):
        pairs = several(targets.items(), "targets", "Transforms")
        named = {plain(str(name), "targets"): pose for name, pose in pairs}
    else:
        poses = several(targets, "targets", "Transforms", error=TypeError)
        names = {1: ["target"], 2: ["start", "goal"], 3: ["start", "via", "goal"]}.get(
            len(poses), [f"P{i + 1}" for i in range(len(poses))]
        )
        named = dict(zip(names, poses, strict=True))
    for name, pose in named.items():
        in_sight(instance(pose, Transform, f"target {name}").translation, f"target {name}")
    return named


# --- Arguments of a player -----------------------------------------------------------------------


def tracks(
    arm: Any, t: Any, q: Any, lead: tuple[int, ...], names: Any
) -> tuple[list[Recording], list[str]]:
    """Return a recording for each arm, with its motions along one axis (motions, samples, n), and
    the names of the arms. The caller may pass one arm, several arms, or recordings.
    """
    several = isinstance(arm, (list, tuple))
    given = list(arm) if several else [arm]
    recorded = bool(given) and all(isinstance(one, Recording) for one in given)
    arms = [one.arm if recorded else instance(one, Arm, "arm") for one in given]
    if names is not None and not several:
        raise ValueError("names: allowed only with a list of arms; a single arm has its own name")
    if recorded and (t is not None or q is not None):
        raise ValueError("t and q: not allowed with recordings, which have their own")
    motions = [q] if not several else q if not recorded else [None] * len(arms)
    if not (arms and isinstance(motions, (list, tuple)) and len(motions) == len(arms)):
        wanted = f"a list with one array for each of {len(arms)} arms"
        raise ValueError(f"q: wanted {wanted}, got {short(q)}")
    named, t = _names(names, arms), rising(given[0].t if recorded else t)
    tracks = []
    for track, motion, name in zip(given, motions, named, strict=True):
        if recorded:
            _shaped(track.q, lead, len(t), track.arm, f"recording of {name}")
            if not np.array_equal(track.t, t):
                raise ValueError(f"recording of {name}: wanted the same times as for {named[0]}")
            tracks.append(in_a_row(track))
        else:
            motion = floats(motion, f"q of {name}", finite=False)
            _shaped(motion, lead, len(t), track, f"q of {name}")
            tracks.append(record(track, t, motion.reshape(-1, *motion.shape[-2:])))
    return tracks, named


def _names(names: Any, arms: Sequence[Arm]) -> list[str]:
    if names is None:
        return [plain(arm.name, "name") for arm in arms]
    if not isinstance(names, (list, tuple)) or len(names) != len(arms):
        raise ValueError(f"names: wanted {len(arms)} names, one for each arm, got {short(names)}")
    return [plain(name, "names") for name in names]


def _shaped(q: Floats, lead: tuple[int, ...], count: int, arm: Arm, name: str) -> None:
    """Check that the axes of q are switch, slider, samples and joints."""
    wanted = (*lead, count, len(arm.limits))
    if q.shape != wanted:
        axes = ", ".join(["switch", "slider", "samples", "joints"][2 - len(lead) :])
        raise ValueError(f"{name}: wanted shape {wanted} ({axes}), got {q.shape}")


def in_a_row(recording: Recording) -> Recording:
    """Return the recording with its motions along one axis: (motions, samples, n)."""
    lead = recording.shape

    def placed(jumps: Iterable[Jump]) -> tuple[Jump, ...]:
        return tuple(
            replace(jump, motion=(int(np.ravel_multi_index(jump.motion, lead)) if lead else 0,))
            for jump in jumps
        )

    q, v, a = (x.reshape(-1, *x.shape[-2:]) for x in (recording.q, recording.v, recording.a))
    missing, gaps = (x.reshape(-1, x.shape[-1]) for x in (recording.missing, recording.gaps))
    leaps, jumps = placed(recording.leaps), placed(recording.jumps)
    return replace(recording, q=q, v=v, a=a, missing=missing, gaps=gaps, leaps=leaps, jumps=jumps)


def _pair(value: Any, name: str, what: str) -> tuple[str, Any]:
    if not (isinstance(value, (list, tuple)) and len(value) == 2 and isinstance(value[0], str)):
        raise ValueError(f"{name}: wanted (name, {what}), got {short(value)}")
    return plain(value[0], name), value[1]


def slider(value: Any) -> Slider | None:
    """Return a slider (name, values) as page data."""
    if value is None:
        return None
    label, given = _pair(value, "slider", "values")
    values = floats(given, "slider values")
    if values.ndim != 1 or len(values) < 2:
        raise ValueError(f"slider values: wanted at least two numbers, got shape {values.shape}")
    if (values[1:] <= values[:-1]).any():
        raise ValueError("slider values: wanted increasing numbers")
    decimals = next(
        (d for d in range(6) if np.allclose(values, values.round(d), rtol=0, atol=1e-9)), 6
    )
    return {"label": label, "values": [tidy(v, decimals) for v in values], "decimals": decimals}


def switch(value: Any) -> Switch | None:
    """Return a switch (name, words) as page data."""
    if value is None:
        return None
    label, values = _pair(value, "switch", "words")
    if not isinstance(values, (list, tuple)) or len(values) < 2:
        raise ValueError(f"switch: wanted a list of at least two strings, got {short(values)}")
    return {"label": label, "values": [plain(word, "switch") for word in values]}


def things(
    targets: Targets, points: Any, circles: Any, faces: Any, readings: Any, more: Any
) -> list[Thing]:
    """Return the things that the arguments of `animate` describe, and after them the things in
    `more`, which may be of any kind. Raises TypeError if an item of `more` is not a `Thing`.
    """
    polygons = Faces(faces)
    found: list[Thing] = [Target(pose, name) for name, pose in posed(targets).items()]
    found += _marks(points, circles, readings)
    found += [polygons] if polygons.corners else []
    given = several(more, "things", "a list of things", error=TypeError)
    return found + [instance(one, Thing, "things") for one in given]  # type: ignore[type-abstract]


def quantities(given: Any, arms: int, lead: tuple[int, ...], samples: int) -> dict[str, Floats]:
    """Return the quantities as a dict that maps each name to values (arms, motions, samples)."""
    if not isinstance(given, Mapping):
        raise ValueError(
            f"quantities: wanted a dict that maps names to numbers, got {short(given)}"
        )
    found = {}
    for name, value in several(given.items(), "quantities", "a dict that maps names to numbers"):
        name = plain(name, "quantities")
        each = [value] if arms == 1 else value
        if not isinstance(each, (list, tuple)) or len(each) != arms:
            wanted = f"a list with one array for each of {arms} arms"
            raise ValueError(f"quantity {name}: wanted {wanted}, got {short(value)}")
        rows = [floats(one, f"quantity {name}", finite=False) for one in each]
        for row in rows:
            if row.shape not in ((samples,), (*lead, samples)):
                wanted = f"shape {(samples,)} or {(*lead, samples)}"
                raise ValueError(f"quantity {name}: wanted {wanted}, got {row.shape}")
        stack = np.stack([np.broadcast_to(row, (*lead, samples)) for row in rows])
        found[name] = stack.reshape(arms, -1, samples)
    return found


def watch(panel: Any, joints: Any, names: list[str], arms: Sequence[Arm]) -> Watch:
    """Return the panel and the joints to watch as page data."""
    kinds = ["q", "v", "a", *names]
    panel = (names or kinds)[0] if panel is None else panel
    chosen = None
    if joints is not None:
        most = max(len(arm.links) for arm in arms)
        chosen = [whole(j, "joints", 1, most) - 1 for j in several(joints, "joints", "numbers")]
    if chosen == [] and not names:
        raise ValueError("joints: an empty list is only for a player with quantities")
    panel = choice(panel, "watch", names if chosen == [] else kinds)
    return {"panel": kinds.index(panel), "joints": chosen}


def bases(value: Any, count: int) -> Floats | None:
    """Return the positions of `count` arms in one scene: (count, 2)."""
    if value is None:
        return None
    found = in_sight(floats(value, "bases"), "bases")
    if count < 2 or found.shape != (count, 2):
        wanted = f"x and y for each of several arms, ({max(count, 2)}, 2)"
        raise ValueError(f"bases: wanted {wanted}, got {short(value)}")
    return found


def _marks(points: Any, circles: Any, readings: Any) -> list[Mark]:
    """Return points and circles as marks. A point is a circle without a radius."""
    if not isinstance(readings, Mapping):
        raise ValueError(
            f"readings: wanted a dict that maps names to numbers, got {short(readings)}"
        )
    read = {}
    for name, given in several(readings.items(), "readings", "a dict that maps names to numbers"):
        read[name] = as_reading(given, f"reading {name}")
    found = [
        Mark(as_place(at, "points"), name, reading=read.get(name))
        for name, at in _named(points, "points")
    ]
    for name, circle in _named(circles, "circles"):
        if not isinstance(circle, (list, tuple)) or len(circle) != 2:
            raise ValueError(f"circles: wanted (centre, radius), got {short(circle)}")
        at = as_place(circle[0], "circles")
        found.append(Mark(at, name, length(circle[1], "radius"), read.get(name)))
    for name in read.keys() - {mark.name for mark in found}:
        raise ValueError(f"readings: wanted names of points or circles, got {short(name)}")
    return found


def _named(places: Any, name: str) -> list[tuple[str, Any]]:
    what = f"a list or a dict of {name}"
    if isinstance(places, Mapping):
        return [(plain(str(k), name), v) for k, v in several(places.items(), name, what)]
    return [("", value) for value in several(places, name, what, most=1000)]
