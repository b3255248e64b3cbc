"""What a caller gives a figure or a player, looked at before anything is drawn."""

import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import floats, instance, length, short, text
from ..arms.arm import Arm
from ..motion.derivatives import rising
from ..motion.recording import Jump, Recording, record
from ..transform import Transform
from .camera import HORIZON, Mark
from .numbers import tidy
from .page import Slider, Switch

Targets: TypeAlias = Transform | Iterable[Transform] | Mapping[Any, Transform]

LONGEST = 2000  # letters of a title or a name


def named_targets(targets: Targets) -> dict[str, Transform]:
    """`targets` as a dict of name -> Transform. A list of one is the target, of two start and goal,
    of three start, via and goal; more are numbered P1, P2, ... TypeError: other things than poses.
    ValueError: a batch of poses under one name.
    """
    named = posed(targets)
    for name, pose in named.items():
        if pose.shape:
            raise ValueError(
                f"target {name}: wanted one single pose, got a batch of shape {pose.shape}"
            )
    return named


def posed(targets: Targets) -> dict[str, Transform]:
    """As `named_targets`, batches of poses let through."""
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


def in_sight(lengths: Floats, name: str) -> Floats:
    """Lengths (...) in metres, if a figure can hold them; ValueError otherwise. NaN passes."""
    if (abs(lengths) > HORIZON).any():
        raise ValueError(f"{name}: wanted at most {HORIZON:g} m, got {np.nanmax(abs(lengths)):g} m")
    return lengths


def several(
    value: Any, name: str, what: str, most: int = 100, error: type[Exception] = ValueError
) -> list[Any]:
    """What is in `value`, if it is a list or the like; else the error, which says that `what` was
    wanted. ValueError: more of them than there is room for in a figure.
    """
    alone = isinstance(value, (str, bytes)) or (isinstance(value, np.ndarray) and not value.ndim)
    if alone or not isinstance(value, Iterable):
        raise error(f"{name}: wanted {what}, got {short(value)}")
    found = list(itertools.islice(value, most + 1))
    if len(found) > most:
        raise ValueError(f"{name}: wanted at most {most}, got more")
    return found


def yes(value: Any, name: str) -> bool:
    """True or False. ValueError: anything else."""
    if not isinstance(value, (bool, np.bool_)):
        raise ValueError(f"{name}: wanted True or False, got {short(value)}")
    return bool(value)


def plain(value: Any, name: str) -> str:
    """`value`, if it is words for a figure or a page; ValueError otherwise. Half characters (lone
    surrogates), which no file can hold, are replaced by the sign for what cannot be shown.
    """
    if len(text(value, name)) > LONGEST:
        raise ValueError(f"{name}: wanted at most {LONGEST} letters, got {len(value)}")
    return str(value).encode("utf-16", "surrogatepass").decode("utf-16", "replace")


# --- What a player is given -----------------------------------------------------------------------


def tracks(
    arm: Any, t: Any, q: Any, lead: tuple[int, ...], names: Any
) -> tuple[list[Recording], list[str]]:
    """A recording for each arm, its motions in a row (C, N, n), and the names; whether one arm was
    given or several, or recordings.
    """
    several = isinstance(arm, (list, tuple))
    given = list(arm) if several else [arm]
    recorded = bool(given) and all(isinstance(one, Recording) for one in given)
    arms = [one.arm if recorded else instance(one, Arm, "arm") for one in given]
    if names is not None and not several:
        raise ValueError("names: wanted only with a list of arms; one arm has its own name")
    if recorded and (t is not None or q is not None):
        raise ValueError("t and q: wanted none beside recordings, which have their own")
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
                raise ValueError(f"recording of {name}: wanted the same times as of {named[0]}")
            tracks.append(_in_a_row(track))
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
    """The switch before the slider, then samples and joints."""
    wanted = (*lead, count, len(arm.limits))
    if q.shape != wanted:
        axes = ", ".join(["switch", "slider", "samples", "joints"][2 - len(lead) :])
        raise ValueError(f"{name}: wanted shape {wanted} ({axes}), got {q.shape}")


def _in_a_row(recording: Recording) -> Recording:
    """The same with its motions in one row: (C, N, n)."""
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
    """(name, values) as the page gets it."""
    if value is None:
        return None
    label, given = _pair(value, "slider", "values")
    values = floats(given, "slider values")
    if values.ndim != 1 or len(values) < 2:
        raise ValueError(f"slider values: wanted at least two numbers, got shape {values.shape}")
    if (values[1:] <= values[:-1]).any():
        raise ValueError("slider values: wanted rising numbers")
    decimals = next(
        (d for d in range(6) if np.allclose(values, values.round(d), rtol=0, atol=1e-9)), 6
    )
    return {"label": label, "values": [tidy(v, decimals) for v in values], "decimals": decimals}


def switch(value: Any) -> Switch | None:
    """(name, words) as the page gets it."""
    if value is None:
        return None
    label, values = _pair(value, "switch", "words")
    if not isinstance(values, (list, tuple)) or len(values) < 2:
        raise ValueError(f"switch: wanted a list of at least two words, got {short(values)}")
    return {"label": label, "values": [plain(word, "switch") for word in values]}


def targets_over_time(targets: Targets, lead: tuple[int, ...], count: int) -> dict[str, Transform]:
    """As `named_targets`, but a target may move: of shape (samples,), (*lead, samples) or
    (*lead, 1), which becomes (motions or 1, samples or 1). NaN where it is not there.
    """
    found = posed(targets)
    for name, pose in found.items():
        if pose.shape:
            moving = _moving(pose.shape, lead, count, f"target {name}")
            found[name] = pose[tuple(np.indices(pose.shape).reshape(-1, *moving))]
        floats(pose.translation, f"target {name}", finite=not pose.shape)
    return found


def marks(points: Any, circles: Any, lead: tuple[int, ...], count: int) -> list[Mark]:
    """Points are circles without a radius. What moves is of shape (motions or 1, samples or 1,
    3).
    """
    found = [(name, _place(p, "points", lead, count), 0.0) for name, p in _named(points, "points")]
    for name, circle in _named(circles, "circles"):
        if not isinstance(circle, (list, tuple)) or len(circle) != 2:
            raise ValueError(f"circles: wanted (centre, radius), got {short(circle)}")
        radius = in_sight(np.array(length(circle[1], "radius")), "radius")
        found.append((name, _place(circle[0], "circles", lead, count), float(radius)))
    return found


def standing(bases: Any, count: int) -> Floats | None:
    """Where `count` arms stand in one space: (count, 2)."""
    if bases is None:
        return None
    found = in_sight(floats(bases, "bases"), "bases")
    if count < 2 or found.shape != (count, 2):
        wanted = f"x and y for each of several arms, ({max(count, 2)}, 2)"
        raise ValueError(f"bases: wanted {wanted}, got {short(bases)}")
    return found


def polygons(faces: Any) -> list[Floats]:
    """The corners (k, 3) of each face."""
    found = []
    for face in several(faces, "faces", "a list of polygons"):
        corners = in_sight(floats(face, "faces", 3), "faces")
        if corners.ndim != 2 or not 3 <= len(corners) <= 100:
            raise ValueError(f"faces: wanted 3 to 100 corners (x, y, z), got {short(face)}")
        found.append(corners)
    return found


def readings(
    values: Any, marks: Sequence[Mark], lead: tuple[int, ...], count: int
) -> dict[str, Floats]:
    """Name of a mark -> numbers (motions or 1, samples or 1)."""
    if not isinstance(values, Mapping):
        raise ValueError(f"readings: wanted a dict name -> numbers, got {short(values)}")
    found = {}
    for name, given in several(values.items(), "readings", "a dict name -> numbers"):
        if name not in [mark[0] for mark in marks]:
            raise ValueError(f"readings: wanted names of points or circles, got {short(name)}")
        numbers = floats(given, f"reading {name}", finite=False)
        found[name] = numbers.reshape(*_moving(numbers.shape, lead, count, f"reading {name}"))
        if (abs(found[name]) > HORIZON).any():
            raise ValueError(f"reading {name}: wanted numbers up to {HORIZON:g}")
    return found


def _named(places: Any, name: str) -> list[tuple[str, Any]]:
    what = "a list or a dict of them"
    if isinstance(places, Mapping):
        return [(plain(str(k), name), v) for k, v in several(places.items(), name, what)]
    return [("", value) for value in several(places, name, what, most=1000)]


def _place(point: ArrayLike, name: str, lead: tuple[int, ...], count: int) -> Floats:
    """(3,), or (motions or 1, samples or 1, 3) of one that moves."""
    place = floats(point, name, finite=False)
    if place.ndim > 1 and place.shape[-1] == 3:
        return in_sight(place.reshape(*_moving(place.shape[:-1], lead, count, name, (3,)), 3), name)
    if place.shape not in ((2,), (3,)):
        raise ValueError(f"{name}: wanted places (x, y, z), got shape {place.shape}")
    floats(place, name)
    return in_sight(np.append(place, [0.0] * (3 - len(place))), name)


def _moving(
    shape: tuple[int, ...], lead: tuple[int, ...], count: int, name: str, last: tuple[int, ...] = ()
) -> tuple[int, int]:
    """(motions or 1, samples or 1) of leading axes and samples; `last` is for the words alone."""
    wanted = dict.fromkeys([(count,), (*lead, count), (*lead, 1)])
    if shape not in wanted:
        shapes = " or ".join(str((*one, *last)) for one in wanted)
        raise ValueError(f"{name}: wanted shape {shapes}, got {(*shape, *last)}")
    return math.prod(shape[:-1]), shape[-1]
