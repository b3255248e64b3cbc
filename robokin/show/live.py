"""Explorers: sliders that ask the kernel, and an arm that answers at once.

`joint_explorer` moves the joints, `target_explorer` the target (every branch of `ik` drawn, with a
verdict each), and `motion_explorer` a via point with its blend, time law and branch. Ordinary
ipywidgets sliders stand above one anywidget view, which draws with the code of the player
(`js/live.js`).

A notebook without a kernel shows a still picture and one sentence. They are an output of their own,
because a stored widget view shows nothing and hides what else is in its output; the live view
covers them.
"""

import hashlib
import html
import itertools
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypeAlias

import anywidget
import ipywidgets
import numpy as np
import traitlets

from .. import (
    Arm,
    ClosedFormArm,
    Quaternion,
    ScaraPose,
    TimeLaw,
    Transform,
    blend,
    distance_from_singularity,
    explain,
    follow,
    linear,
    nearest,
    quintic,
    record,
    representative,
    trapezoidal,
    within,
)
from .._arrays import ArrayLike, Bools, Floats
from .._validate import instance
from ..units import deg, length_unit, mm
from . import plots
from .camera import arm_points, chain, extent, matrix, posture, scene_data, stations
from .given import named_targets
from .page import script
from .palette import DASHES, css
from .player import page_data, still_picture
from .scene import Scene

Pose: TypeAlias = Transform | ScaraPose
Picture: TypeAlias = dict[str, Any]  # what the view draws
Controls: TypeAlias = dict[str, Any]  # name -> ipywidgets slider or menu

SAMPLES = 241  # of a motion: enough for its speeds, few enough to answer while the slider moves
LAWS: dict[str, Callable[[float], TimeLaw]] = {
    "quintic": quintic,
    "trapezoidal": trapezoidal,
    "linear": linear,
}
CORNERS = {"parabola (C1)": "parabola", "quintic (C2)": "quintic"}
RUN = "Run this cell to move the sliders."
NEAREST = "nearest"
MEANT = (
    "Distance from singularity: the smallest singular value of the Jacobian, lengths divided by "
    "the arm's reach "
    "so that it has no unit. It says how little the tool moves in its worst direction; 0 is a "
    "singularity."
)
TURNS = "Roll, pitch and yaw turn about the base's x, then y, then z axis."


def joint_explorer(arm: Arm) -> "JointExplorer":
    """A slider per joint within its limits; the arm with all its frames, the flange in numbers, and
    how near it is to a singularity. Starts at zero, or at the limit nearest to it. Returns an
    `Explorer`; at the end of a cell it shows itself. TypeError: not an Arm.

    Roll, pitch and yaw are turns about the fixed x, y and z axes of the base, in this order: R = Rz
    Ry Rx (at a pitch of +-90 degrees roll and yaw turn about the same line, and roll is given as
    zero).
    """
    return JointExplorer(arm)


def target_explorer(arm: ClosedFormArm) -> "TargetExplorer":
    """Sliders for the target; every branch of `ik` drawn, the chosen one strongly, with a row of a
    table for each.

    Six-axis arms: x, y, z in mm and roll, pitch, yaw in degrees as in `joint_explorer`. SCARA: x,
    y, z and the tool's angle. Positioning arms: x, y, z. The menu chooses a branch, or the usable
    one nearest to the last posture. Returns an `Explorer`. TypeError: an arm without `ik`.
    """
    return TargetExplorer(arm)


def motion_explorer(arm: ClosedFormArm, start: Pose, via: Pose, goal: Pose) -> "MotionExplorer":
    """A blended motion past `via`: sliders for the via point, the blend and the duration, menus for
    the time law, the corner and the branch; arm, curves and numbers follow. Poses are what `arm.ik`
    takes (Transform, or ScaraPose for a SCARA), one of each. Returns an `Explorer`. ValueError: a
    batch of poses. TypeError: other poses, an arm without `ik`.
    """
    return MotionExplorer(arm, start, via, goal)


class View(anywidget.AnyWidget):
    """The picture in the page. `stage` stands still; `picture` changes as a whole, so no view shows
    half of an answer.

    `still` is the id of the still picture that it covers.
    """

    _esm = f"{script('live')}\nexport default {{render: $live.render}};\n"
    stage = traitlets.Dict().tag(sync=True)
    picture = traitlets.Dict().tag(sync=True)
    still = traitlets.Unicode().tag(sync=True)


class Explorer(ipywidgets.VBox):
    """Sliders above a view. Each kind has `_answer`, the picture for the values of its sliders (a
    dict of bytes, words and numbers), `_words`, the same in rounded words, and `_draw_still`, the
    figure for a reader without a kernel.

    groups    names of controls that stand below each other
    controls  dict of name -> ipywidgets slider or menu: `explorer.controls["q1"].value = 30` moves
              the arm, too
    """

    controls: Controls = {}  # of one that was refused
    _answer: Callable[[], Picture]
    _words: Callable[[], str]
    _draw_still: Callable[[], plots.Figure]

    def __init__(self, controls: Controls, stage: Picture, groups: Iterable[Iterable[str]]) -> None:
        self.controls = controls
        self._lock, self._tickets = threading.RLock(), itertools.count(1)
        self._asked = self._answered = 0
        self._view = View(stage=stage)
        column = {"flex": "1 1 300px", "max_width": "460px"}
        columns = [
            ipywidgets.VBox([controls[name] for name in group], layout=column) for group in groups
        ]
        rows = {"display": "flex", "flex_flow": "row wrap", "grid_gap": "0 18px"}
        super().__init__([ipywidgets.Box(columns, layout=rows), self._view])
        self.add_class("robokin-explorer")
        self._answer_now()
        self._view.still = hashlib.sha256(self._words().encode()).hexdigest()[:12]
        for control in controls.values():
            control.observe(self._changed, "value")

    def close(self) -> None:
        """Take every view of it from the page. The sliders can still be moved by code; nobody sees
        it.
        """
        for widget in (*self.controls.values(), *self.children):
            widget.close()
        super().close()

    def _changed(self, _: Any) -> None:
        # Messages of the page come in another thread than the cells run in. Whoever gets the lock
        # answers to the newest values of all sliders; who waited meanwhile finds that done, and the
        # last value is never left out.
        ticket = self._asked = next(self._tickets)
        with self._lock:
            if self._answered < ticket:
                self._answer_now()

    def _answer_now(self) -> None:
        # before the sliders are read: what changes from here on is answered by the next
        asked = self._asked
        # The page compares bytes badly: the number tells one picture from the next.
        self._view.picture = {**self._answer(), "serial": asked}
        self._answered = asked

    def _ipython_display_(self) -> None:
        import IPython.display

        display: Any = IPython.display.display
        with self._lock:
            still, words = self._draw_still(), self._words()
        image = still._repr_mimebundle_()["text/html"]
        page = (
            f'<div data-robokin-still="{self._view.still}">{image}<p>{html.escape(RUN)}</p></div>'
        )
        display({"text/html": page, "text/plain": f"{words} {RUN}"}, raw=True)
        # No text beside the view: a notebook is stored without it, and its tests compare the still
        # picture's words.
        view = {"version_major": 2, "version_minor": 0, "model_id": self.model_id}
        display({"application/vnd.jupyter.widget-view+json": view}, raw=True)

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={control.value!r}" for name, control in self.controls.items())
        return f"{type(self).__name__}({values})"


class JointExplorer(Explorer):
    """See `joint_explorer`. `q` (n,) is the posture shown."""

    def __init__(self, arm: Arm) -> None:
        self.arm = instance(arm, Arm, "arm")
        controls: Controls = {}
        for i, (low, high) in enumerate(arm.limits / _units(arm)[:, None]):
            low, high = np.ceil(low - 1e-6), np.floor(high + 1e-6)
            unit = (
                "mm" if arm.prismatic[i] and extent(arm) <= 2 else "m" if arm.prismatic[i] else "°"
            )
            controls[f"q{i + 1}"] = _slider(f"q{i + 1}, {unit}", low, high, min(max(0, low), high))
        rows = [
            (f"position, {_length(arm)[0]}", "xyz", 1 if _length(arm)[1] == mm else 3),
            ("orientation, °", ("roll", "pitch", "yaw"), 1),
            ("quaternion", "wxyz", 4),
            ("distance from singularity", [""], 3),
        ]
        stage = _stage(
            arm, "joint", f"{arm.name}: move the joints", "The arm with the frames of its joints."
        )
        stage |= {
            "rows": [[name, list(heads), decimals] for name, heads, decimals in rows],
            "meant": f"{TURNS} {MEANT}",
        }
        names, half = list(controls), (len(controls) + 1) // 2
        super().__init__(controls, stage, [names[:half], names[half:]])

    @property
    def q(self) -> Floats:
        """The posture of the sliders (n,), in radians and metres."""
        q: Floats = np.array([control.value for control in self.controls.values()])
        return q * _units(self.arm)

    def _answer(self) -> Picture:
        q = self.q
        pose = self.arm.fk(q)
        numbers = [
            *pose.translation / _length(self.arm)[1],
            *np.array(pose.rotation.as_roll_pitch_yaw()) / deg,
            *_one_sign(pose.rotation.wxyz),
            distance_from_singularity(self.arm, q),
        ]
        return {"q": _bytes(q), "numbers": _bytes(numbers), "faded": False, "says": self._says(q)}

    def _says(self, q: Floats) -> str:
        names = _singular(self.arm, q)
        return f"Singular: {' and '.join(names)}." if names else "Not singular."

    def _words(self) -> str:
        q = self.q
        values = ", ".join(
            f"{c.description.split(',')[0]} {_number(c.value, 0)}" for c in self.controls.values()
        )
        place = ", ".join(
            _number(x / _length(self.arm)[1], 1 if _length(self.arm)[1] == mm else 3)
            for x in self.arm.fk(q).translation
        )
        return (
            f"{self.arm.name} with a slider for each joint, at {values}: the flange is at "
            f"({place}) "
            f"{_length(self.arm)[0]}. {self._says(q)}"
        )

    def _draw_still(self) -> plots.Figure:
        frames = self.arm.frames(self.q)
        return _picture(
            self._words(), self.arm, self.q, frames=[frames[i] for i in range(len(self.arm.links))]
        )


class TargetExplorer(Explorer):
    """See `target_explorer`. After every change:

    target   Transform or ScaraPose of the sliders
    rows     (branches, n): each branch with its joints inside their limits where they can be, else
             as little past them as they can; NaN where none exists
    q        (n,): the posture shown; where the chosen branch does not exist, the one before
    """

    def __init__(self, arm: ClosedFormArm) -> None:
        self.arm = instance(arm, ClosedFormArm, "arm")
        self._kind = arm.target
        place, turns, self.q = _showcase(arm, self._kind)
        name, size = _length(arm)
        most = np.ceil(1.05 * extent(arm) / (50 * mm)) * 50 * mm / size
        step = 5 if size == mm else 0.005
        controls = {
            letter: _slider(f"{letter}, {name}", -most, most, x / size, step)
            for letter, x in zip("xyz", place, strict=True)
        }
        controls |= {
            turn: _slider(f"{turn}, °", -180, 180, angle / deg)
            for turn, angle in zip(_turns(self._kind), turns, strict=True)
        }
        self._names = [_flags(arm, k) for k in range(len(arm.branches))]
        controls["branch"] = _menu("branch", [NEAREST, *self._names])
        turning = not arm.prismatic.any()
        units = ["°" if not shifts else name for shifts in arm.prismatic]
        alt = "The arm in every posture that reaches the target."
        stage = _stage(arm, "target", f"{arm.name}: move the target", alt)
        stage |= {
            "oriented": self._kind is not np.ndarray,
            "branches": self._names,
            "meant": (f"{TURNS} " if self._kind is Transform else "") + MEANT,
            "heads": [
                "branch",
                "verdict",
                *(f"q{i + 1} {unit}" for i, unit in enumerate(units)),
                "distance from singularity",
                f"travel, {'°' if turning else 'rad + m'}",
            ],
        }
        self._travel_unit = deg if turning else 1.0
        names = [*_turns(self._kind)]
        rest = [names, ["branch"]] if self._kind is Transform else [[*names, "branch"]]
        super().__init__(controls, stage, [["x", "y", "z"], *rest])

    @property
    def target(self) -> Pose:
        """What the sliders ask for."""
        value = {name: control.value for name, control in self.controls.items()}
        place = np.array([value[letter] for letter in "xyz"]) * _length(self.arm)[1]
        turns = np.array([value[turn] for turn in _turns(self._kind)]) * deg
        return _asked(self._kind, place, turns)

    def _answer(self) -> Picture:
        arm, last, target = self.arm, self.q, self.target
        # One row at a time: each takes its own values q + 2 pi k, inside the limits where it can.
        rows = nearest(arm, arm.ik(target)[:, None, :], last)
        exists, inside = ~np.isnan(rows[:, 0]), within(arm, rows)
        self.rows = rows = np.where(inside, rows, representative(arm, rows))
        usable = exists & np.all(inside, axis=-1)
        travel = abs(rows - last).sum(axis=-1)
        wanted = self.controls["branch"].value
        among = usable if usable.any() else exists
        chosen = (
            self._names.index(wanted)
            if wanted != NEAREST
            else int(np.where(among, travel, np.inf).argmin())
        )
        if exists[chosen]:
            self.q = rows[chosen]
        self._chosen, self._exists, self._usable = chosen, exists, usable
        pose = _pose(target)
        return {
            "q": _bytes(self.q),
            "rows": _bytes(rows),
            "past": _bytes(exists[:, None] & ~inside),
            "near": _bytes(distance_from_singularity(arm, rows)),
            "travel": _bytes(travel / self._travel_unit),
            "pose": _bytes(matrix(pose)),
            "chosen": chosen if exists[chosen] else -1,
            "faded": not exists[chosen],
            "verdicts": [self._verdict(k, inside[k]) for k in range(len(rows))],
            "says": self._says(target),
        }

    def _verdict(self, k: int, inside: Bools) -> str:
        if not self._exists[k]:
            return "does not exist"
        if not inside.all():
            return f"past limit: {', '.join(f'q{i + 1}' for i in np.flatnonzero(~inside))}"
        return "usable, singular" if _singular(self.arm, self.rows[k]) else "usable"

    def _says(self, target: Pose) -> str:
        """How many are usable, and the reason in words: of the chosen row or, if none is usable, of
        the one that is nearest to it.
        """
        count, row = int(self._usable.sum()), self._chosen
        if count:
            return (
                f"{count} of {len(self.rows)} branches {'is' if count == 1 else 'are'} usable. "
                f"{explain(self.arm, target, row)}"
            )
        if self.controls["branch"].value == NEAREST and not self._exists.any():
            gaps = [self.arm.geometry.gap(target, k) for k in range(len(self.rows))]
            row = int(np.argmin(np.round([gap.metres for gap in gaps], 9)))
        return f"No branch is usable. {explain(self.arm, target, row)}"

    def _words(self) -> str:
        values = ", ".join(
            f"{c.description} {_number(c.value, 0 if _length(self.arm)[1] == mm else 3)}"
            for name, c in self.controls.items()
            if name != "branch"
        )
        return (
            f"{self.arm.name} with sliders for its target, at {values}: "
            f"{int(self._exists.sum())} of "
            f"{len(self.rows)} branches exist, {int(self._usable.sum())} are usable."
        )

    def _draw_still(self) -> plots.Figure:
        others = [q for k, q in enumerate(self.rows) if self._exists[k] and k != self._chosen]
        targets = {"target": _pose(self.target)}
        return _picture(self._words(), self.arm, self.q, others, targets=targets)


class MotionExplorer(Explorer):
    """See `motion_explorer`. `t` (241,) and `q` (241, n) are the motion shown, NaN where there is
    none.
    """

    def __init__(self, arm: ClosedFormArm, start: Pose, via: Pose, goal: Pose) -> None:
        self.arm = instance(arm, ClosedFormArm, "arm")
        wanted: type[Pose] = ScaraPose if arm.target is ScaraPose else Transform
        for name, pose in (("start", start), ("via", via), ("goal", goal)):
            if instance(pose, wanted, name).shape:
                raise ValueError(
                    f"{name}: wanted one single pose, got a batch of shape {pose.shape}"
                )
        self._ends, self._via = (start, goal), via
        name, size = _length(arm)
        most = np.ceil(1.05 * extent(arm) / (50 * mm)) * 50 * mm / size
        step = 5 if size == mm else 0.005
        place = _pose(via).translation / size
        controls = {
            f"via {letter}": _slider(f"via {letter}, {name}", -most, most, x, step)
            for letter, x in zip("xyz", place, strict=True)
        }
        self._names = [_flags(arm, k) for k in range(len(arm.branches))]
        controls |= {
            "blend": _slider("blend", 0, 0.5, 0.1, 0.01, ".2f"),
            "duration": _slider("duration, s", 0.5, 20, 5, 0.5, ".1f"),
            "law": _menu("time law", list(LAWS)),
            "corner": _menu("corner", list(CORNERS)),
            "branch": _menu("branch", self._names),
        }
        self.controls = controls
        motions = [self._motion(row)[1] for row in range(len(self._names))]
        # The first branch with the most samples that are usable.
        controls["branch"].value = self._names[
            int(np.argmax([np.all(within(arm, posture(arm, q)), axis=-1).sum() for q in motions]))
        ]
        alt = f"{arm.name} moves from start past via to goal."
        stage = _stage(
            arm,
            "motion",
            f"{arm.name}: a blended motion",
            alt,
            [_pose(pose) for pose in (start, via, goal)],
        )
        groups = [["via x", "via y", "via z", "blend"], ["duration", "law", "corner", "branch"]]
        super().__init__(controls, stage, groups)

    def _motion(self, row: int) -> tuple[Floats, Floats, Pose]:
        value = {name: control.value for name, control in self.controls.items()}
        place = np.array([value[f"via {letter}"] for letter in "xyz"]) * _length(self.arm)[1]
        via: Any = (
            ScaraPose(place, self._via.angle)
            if isinstance(self._via, ScaraPose)
            else Transform(self._via.rotation, place)
        )
        law = LAWS[value["law"]](value["duration"])
        t = np.linspace(0, law.duration, SAMPLES)
        poses = blend(
            self._ends[0],
            via,
            self._ends[1],
            value["blend"],
            law(t),
            corner=CORNERS[value["corner"]],
        )
        return t, follow(self.arm, self.arm.ik(poses), row), via

    def _answer(self) -> Picture:
        arm = self.arm
        self.t, self.q, via = self._motion(self._names.index(self.controls["branch"].value))
        self._targets = named_targets([_pose(p) for p in (self._ends[0], via, self._ends[1])])
        page: Picture = {
            **page_data(
                [arm.name],
                [record(arm, self.t, self.q[None])],
                self._targets,
                [],
                None,
                None,
                self._view.stage["title"],
                scene=self._view.stage["scene"],
            ),
            "scene": {"targets": stations(self._targets)},
        }
        for key in ("unit", "dashes"):
            del page[key]  # the stage has them
        del page["arms"][0]["chain"]
        self._page = page
        return {"page": page}

    def _words(self) -> str:
        summary = self._page["summary"].removeprefix("Player of ")
        return f"A blended motion with sliders for via point, blend and duration. {summary}"

    def _draw_still(self) -> plots.Figure:
        stage = self._view.stage
        return still_picture(
            [self.arm.name],
            [(self.arm, self.q)],
            self._targets,
            [],
            stage["scene"],
            stage["title"],
            self._words(),
        )


# --- What an arm can be asked for -----------------------------------------------------------------


def _pose(target: Pose) -> Transform:
    return target.as_transform() if isinstance(target, ScaraPose) else target


def _turns(kind: type) -> tuple[str, ...]:
    return {Transform: ("roll", "pitch", "yaw"), ScaraPose: ("angle",)}.get(kind, ())


def _showcase(arm: ClosedFormArm, kind: type) -> tuple[Floats, Floats, Floats]:
    """A target that shows much: most branches usable, far from singularities, in front of the arm
    and above the floor. (Where there is none, the one in the middle of all limits.)

    Place (3,), turns in radians, and the posture (n,) that it was made of; all on the grid of the
    sliders.
    """
    middle, size = arm.limits.mean(axis=-1), extent(arm)
    best, most = (arm.fk(middle).translation, _turned(arm.fk(middle), kind), middle), -1.0
    for q in _spread(arm, 160):
        pose = arm.fk(q)
        place = np.round(pose.translation / (50 * mm)) * 50 * mm
        if place[0] < 0.2 * size or (kind is Transform and place[2] < 0.1 * size):
            continue
        turns = np.round(_turned(pose, kind) / (15 * deg)) * 15 * deg
        rows = arm.ik(_asked(kind, place, turns))
        usable = np.all(within(arm, rows), axis=-1)
        if usable.any():
            near = np.nanmin(distance_from_singularity(arm, rows))
            score = usable.sum() + float(np.round(near, 6))
            if score > most:
                best = place, turns, nearest(arm, rows[usable], np.zeros(len(arm.links)))
                most = score
    return best


def _asked(kind: type, place: Floats, turns: Floats) -> Pose:
    """The target of this kind with its place (3,) and the turns of its sliders in radians."""
    if kind is ScaraPose:
        return ScaraPose(place, turns[0])
    if kind is Transform:
        return Transform(Quaternion.from_roll_pitch_yaw(*turns), place)
    return Transform(translation=place)


def _turned(pose: Transform, kind: type) -> Floats:
    """The turns that sliders have for this kind of target."""
    turns = np.array(pose.rotation.as_roll_pitch_yaw())
    return turns if kind is Transform else turns[2:] if kind is ScaraPose else turns[:0]


def _spread(arm: Arm, count: int) -> Floats:
    """Postures (count, n) spread evenly between the limits: Weyl's sequence of square roots."""
    roots = np.sqrt([2, 3, 5, 7, 11, 13])[np.arange(len(arm.links)) % 6]
    shares = (np.arange(1, count + 1)[:, None] * roots) % 1
    return arm.limits[:, 0] + shares * (arm.limits[:, 1] - arm.limits[:, 0])


def _singular(arm: Arm, q: Floats) -> list[str]:
    """The names of the singularities at one posture; an arm without an inverse has none for
    them.
    """
    if not isinstance(arm, ClosedFormArm):
        return []
    found = arm.geometry.singularities(q).items()
    return [f"{name} singularity" for name, holds in found if holds]


def _flags(arm: ClosedFormArm, k: int) -> str:
    flags = " ".join(f"{flag:+d}" for flag in arm.branches[k]).replace("-", "\N{MINUS SIGN}")
    return f"{k}: {flags}"


# --- What the page gets ---------------------------------------------------------------------------


def _stage(arm: Arm, kind: str, title: str, alt: str, poses: Sequence[Transform] = ()) -> Picture:
    """What stands still: the chain, and a scene that holds what the arm reaches above the floor and
    not too far out. (The page shrinks the picture for what leaves it.)
    """
    name, size = _length(arm)
    postures = _spread(arm, 2000)
    points = arm_points(arm, postures)
    near = (points[..., 2] > -0.01 * extent(arm)) & (
        np.hypot(points[..., 0], points[..., 1]) < 0.5 * extent(arm)
    )
    scene = scene_data(
        [arm], [postures[near.all(axis=-1)][None]], named_targets(poses), [], extent(arm)
    ) | {"grows": True}
    return {
        "kind": kind,
        "title": title,
        "alt": alt,
        "name": arm.name,
        "chain": chain(arm.links),
        "scene": scene,
        "dashes": DASHES,
        "css": css(),
        "unit": {"name": name, "size": size},
    }


def _slider(
    name: str, low: float, high: float, value: float, step: float = 1, form: str | None = None
) -> Any:
    form = form or (".0f" if step >= 1 else ".3f")
    return ipywidgets.FloatSlider(
        round(value, 9),
        min=low,
        max=high,
        step=step,
        description=name,
        readout_format=form,
        style={"description_width": "74px"},
        layout={"width": "auto"},
    )


def _menu(name: str, words: Sequence[str]) -> Any:
    return ipywidgets.Dropdown(
        options=words,
        description=name,
        style={"description_width": "74px"},
        layout={"width": "auto"},
    )


def _length(arm: Arm) -> tuple[str, float]:
    """The unit of lengths: its name, and its size in metres."""
    return length_unit(extent(arm))


def _units(arm: Arm) -> Floats:
    """The unit of each joint, in radians or metres."""
    return np.where(arm.prismatic, _length(arm)[1], deg)


def _bytes(values: ArrayLike) -> bytes:
    return np.asarray(values, dtype="<f8").tobytes()


def _one_sign(wxyz: Floats) -> Floats:
    return -wxyz if wxyz[0] < 0 else wxyz


def _number(value: float, decimals: int) -> str:
    text = f"{np.floor(value * 10**decimals + 0.5 + 1e-7) / 10**decimals + 0.0:.{decimals}f}"
    return text.replace("-", "\N{MINUS SIGN}")


def _picture(
    alt: str,
    arm: Arm,
    q: Floats,
    others: Sequence[Floats] = (),
    targets: Mapping[str, Transform] | None = None,
    frames: Sequence[Transform] = (),
) -> plots.Figure:
    """One posture, strongly, and others faintly."""
    fig = plots.figure(alt, width=6.4, height=4.5)
    scene = Scene(fig.add_axes((0, 0, 1, 1)), size=extent(arm))
    scene.base()
    for other in others:
        scene.arm(arm, other, "between")
    scene.arm(arm, q, "last")
    for frame in frames:
        scene.triad(frame, length=0.08 * extent(arm))
    scene.triad(arm.fk(q), width=2.4)
    for name, pose in (targets or {}).items():
        scene.triad(pose, name)
    scene.finish()
    return fig
