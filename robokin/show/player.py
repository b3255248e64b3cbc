"""The player: an arm that moves beside its curves, in any browser, without a kernel and without a
network.

`animate` works everything out once, at full resolution, and hands the page whole numbers: joint
values, speeds and accelerations of some hundred samples, and for every slider value the numbers
worth reading. `player.js` draws them.
"""

import base64
import contextlib
import hashlib
import html
import json
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

import numpy as np
from matplotlib.ticker import MaxNLocator

from .._arrays import ArrayLike, Bools, Floats, Ints
from .._validate import floats, instance, length, short
from ..arms.arm import Arm
from ..arms.link import Link
from ..motion.derivatives import rising
from ..motion.recording import Jump, Recording, record
from ..transform import Transform
from ..units import deg, length_unit, mm
from . import plots
from .panels import near_limits
from .scene import (
    INK,
    SOFT,
    STRAIGHT,
    VIEW,
    Scene,
    Targets,
    View,
    arm_points,
    extent,
    flange,
    in_sight,
    named_targets,
    plain,
    project,
    several,
)

SAMPLES, SAMPLES_UNDER_SLIDER = 241, 121  # per motion in the page, both ends included
# what joint values, speeds and accelerations of all motions may take; at least 41 samples
DATA_BYTES = 570_000
NOTHING = -32768  # the whole number that stands for "no value here"
# added before rounding: an exact half falls the same way on every processor
TIE = 2e-7 * np.sqrt(2)
MARK = "<!-- robokin player -->"  # what tells our own saved files from others'

Page: TypeAlias = dict[str, Any]  # what the page draws, as JSON takes it
Mark: TypeAlias = tuple[str, Floats, float]  # name, centre (3,), radius: 0 for a point
Scale: TypeAlias = tuple[float, float, int, int]  # lowest tick, step, number of ticks, decimals


def animate(
    arm: Arm | Recording | Sequence[Arm] | Sequence[Recording],
    t: ArrayLike | None = None,
    q: ArrayLike | Sequence[ArrayLike] | None = None,
    *,
    targets: Targets = (),
    slider: tuple[str, ArrayLike] | None = None,
    switch: tuple[str, Sequence[str]] | None = None,
    title: str | None = None,
    points: Iterable[ArrayLike] | Mapping[Any, ArrayLike] = (),
    circles: Iterable[Any] | Mapping[Any, Any] = (),
    names: Sequence[str] | None = None,
) -> "Player":
    """A `Player` of the motion q (samples, n) at the times t (samples,); it shows itself at the end
    of a cell.

        animate(arm, t, q), animate([arm, other], t, [q, q_other])
        animate(record(arm, t, q)), animate([recording, other])

    arm      an Arm, or several side by side: then q and `names` are lists of the same length. Or
             recordings, of the same times: then t and q are theirs
    t, q     full resolution (2001 samples, say): speeds, accelerations and the numbers below the
             curves come from all samples, and only what is drawn is thinned. Unwrapped angles
             (`follow`); a NaN row is "no solution here".
    targets  Transforms in a list (start and goal; start, via and goal), or a dict of name ->
             Transform. A target called "via" gets its smallest distance from the path.
    slider   (name, values): q is then (values, samples, n), and the page has a slider for the value
    switch   (name, [words]): q has one more leading axis, one motion for each word, and the page
             has a menu
    points   places to mark: a list or a dict name -> (x, y, z); circles the same with (centre,
             radius): spheres, or discs where the arm is planar. Metres, base coordinates.
    ValueError: shapes that do not fit, fewer than three samples, times that do not rise, infinite
    numbers. TypeError: an arm or a target of another kind.
    """
    sliding, switching = _slider(slider), _switch(switch)
    lead = tuple(len(control["values"]) for control in (switching, sliding) if control)
    tracks, names = _tracks(arm, t, q, lead, names)
    named, marks = named_targets(targets), _marks(points, circles)
    for name, pose in named.items():
        floats(pose.translation, f"target {name}")  # a pose that does not exist has no place
    title = " and ".join(dict.fromkeys(names)) if title is None else plain(title, "title")
    data = _page(names, tracks, named, marks, sliding, switching, title)
    for page in data["arms"]:
        page["data"] = [base64.b64encode(values).decode() for values in page["data"]]
    still = _still(names, [(track.arm, track.q[0]) for track in tracks], named, marks, data)
    return Player(data, still)


class Player:
    """An arm and its curves, animated by the browser. Shows itself in a notebook; `save` writes it
    as a page.

    data    what the page draws, as JSON takes it; decoding rules at the head of `player.js`
    still   the figure that stands in its place until the script runs, in print and in an untrusted
            notebook
    """

    def __init__(self, data: Page, still: plots.Figure) -> None:
        if not isinstance(data, dict):
            raise ValueError(f"data: wanted a dict, got {short(data)}")
        self.data, self.still = data, instance(still, plots.Figure, "still")
        try:
            text = json.dumps(data, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
            text.encode()
        except (TypeError, ValueError, RecursionError) as error:
            raise ValueError(f"data: wanted what JSON can hold ({error})") from None
        self.text = (
            text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")
        )
        # Of the data and not of the picture: another zlib packs the same pixels into other bytes.
        self.id = hashlib.sha256(self.text.encode()).hexdigest()[:12]

    @property
    def html(self) -> str:
        """The player as a piece of HTML: the still picture, and the script that replaces it."""
        png = base64.b64encode(plots.palette_png(self.still)).decode()
        alt = html.escape(self.data["alt"])
        return (
            f'<div class="robokin-player" data-player="{self.id}"><img alt="{alt}" '
            f'style="max-width:100%" '
            f'src="data:image/png;base64,{png}"></div>\n'
            f'<script>(() => {{\n{_script()}\nplay("{self.id}", {self.text});\n}})();</script>\n'
        )

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write one self-contained page: wholly or not at all. ValueError: not a .html file, or one
        that is there and not a saved player.
        """
        name = _file(path)
        if os.path.lexists(name) and not _ours(name):
            raise ValueError(
                f"path: {short(name)} exists and is not a saved player; nothing is overwritten"
            )
        head = (
            f'<!DOCTYPE html>\n{MARK}\n<html lang="en">\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width">\n'
            f"<title>{html.escape(self.data['title'])}</title>\n"
        )
        body = (
            f'<body style="max-width:1200px;margin:16px auto;padding:0 '
            f'8px">\n{self.html}</body>\n</html>\n'
        )
        _write(name, (head + body).encode())

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        return {"text/html": self.html, "text/plain": repr(self)}

    def __repr__(self) -> str:
        return str(self.data["summary"])


# --- What the caller gives ------------------------------------------------------------------------


def _tracks(
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


def _slider(slider: Any) -> Page | None:
    if slider is None:
        return None
    label, given = _pair(slider, "slider", "values")
    values = floats(given, "slider values")
    if values.ndim != 1 or len(values) < 2:
        raise ValueError(f"slider values: wanted at least two numbers, got shape {values.shape}")
    if (values[1:] <= values[:-1]).any():
        raise ValueError("slider values: wanted rising numbers")
    decimals = next(
        (d for d in range(6) if np.allclose(values, values.round(d), rtol=0, atol=1e-9)), 6
    )
    return {"label": label, "values": [_tidy(v, decimals) for v in values], "decimals": decimals}


def _switch(switch: Any) -> Page | None:
    if switch is None:
        return None
    label, values = _pair(switch, "switch", "words")
    if not isinstance(values, (list, tuple)) or len(values) < 2:
        raise ValueError(f"switch: wanted a list of at least two words, got {short(values)}")
    return {"label": label, "values": [plain(value, "switch") for value in values]}


def _marks(points: Any, circles: Any) -> list[Mark]:
    """Points are circles without a radius."""
    marks = [(name, _place(p, "points"), 0.0) for name, p in _named(points, "points")]
    for name, circle in _named(circles, "circles"):
        if not isinstance(circle, (list, tuple)) or len(circle) != 2:
            raise ValueError(f"circles: wanted (centre, radius), got {short(circle)}")
        radius = in_sight(np.array(length(circle[1], "radius")), "radius")
        marks.append((name, _place(circle[0], "circles"), float(radius)))
    return marks


def _named(places: Any, name: str) -> list[tuple[str, Any]]:
    what = "a list or a dict of them"
    if isinstance(places, Mapping):
        return [(plain(str(k), name), v) for k, v in several(places.items(), name, what)]
    return [("", value) for value in several(places, name, what, most=1000)]


def _place(point: ArrayLike, name: str) -> Floats:
    point = floats(point, name)
    if point.shape not in ((2,), (3,)):
        raise ValueError(f"{name}: wanted places (x, y, z), got shape {point.shape}")
    return in_sight(np.append(point, [0.0] * (3 - len(point))), name)


# --- What the page gets ---------------------------------------------------------------------------


def _page(
    names: Sequence[str],
    tracks: Sequence[Recording],
    targets: Mapping[str, Transform],
    marks: Sequence[Mark],
    slider: Page | None,
    switch: Page | None,
    title: str,
    scene: Page | None = None,
) -> Page:
    """What the page draws; joint values, speeds, accelerations as bytes. `scene`: the one of
    `_scene`, if at hand.
    """
    arms, t = [track.arm for track in tracks], tracks[0].t
    motions, size = len(tracks[0]), max(extent(arm) for arm in arms)
    unit: Page = dict(zip(("name", "size"), length_unit(size), strict=True))
    units = [np.where(arm.prismatic, unit["size"], deg) for arm in arms]
    alone = motions == 1 and scene is None  # else what is drawn changes while a slider moves
    kept = _thin(len(t), tracks, SAMPLES if alone else SAMPLES_UNDER_SLIDER)
    curves = [
        [x / u for x in (track.q, track.v, track.a)] for track, u in zip(tracks, units, strict=True)
    ]
    via = targets.get("via")
    page: Page = {
        "title": title,
        "times": [_tidy(x, 6) for x in t[kept]],
        "slider": slider,
        "switch": switch,
        "unit": unit,
        "styles": [dict(style) for style in plots.JOINT_STYLES],
        "scene": scene
        or _scene(arms, [track.q[:, kept] for track in tracks], targets, marks, size),
        "panels": [_panel(arms, [c[k] for c in curves], unit, k) for k in range(3)],
        "decimals": [_decimals([c[k] for c in curves]) for k in (1, 2)],
        "arms": [],
    }
    for arm, name, track, curve, u in zip(arms, names, tracks, curves, units, strict=True):
        steps, blobs = zip(*(_encoded(x[:, kept], arm.prismatic) for x in curve), strict=True)
        page["arms"].append(
            {
                "name": name,
                "chain": _chain(arm.links),
                "limits": [_rounded(arm.limits.T[i] / u, 3) for i in (0, 1)],
                "speedLimits": None
                if arm.speed_limits is None
                else _rounded(arm.speed_limits / u, 3),
                "steps": steps,
                "data": blobs,
                "via": _closest(arm, track.q, via, unit["size"]) if via is not None else None,
                **_numbers(track, u, unit["name"], page["decimals"]),
                **_flaws(track, kept, u, unit["name"]),
            }
        )
    page["ticks"] = _scale(t[0], t[-1])
    page["summary"], page["alt"] = _words(page, t, targets)
    return page


def _chain(links: Iterable[Link]) -> list[Page]:
    return [
        {
            "before": _matrix(link.before),
            "axis": _rounded(link.axis),
            "after": _matrix(link.after),
            "prismatic": link.prismatic,
        }
        for link in links
    ]


def _thin(count: int, tracks: Sequence[Recording], wanted: int) -> Ints:
    """Which samples the page gets: evenly spread, and those on both sides of every jump."""
    values = sum(track.q.shape[0] * track.q.shape[2] for track in tracks)
    wanted = min(count, wanted, max(41, int(DATA_BYTES / (3 * values * 2 * 4 / 3))))
    extra: set[int] = set()
    for track in tracks:
        for jump in track.jumps:
            extra.update((jump.first - 2, jump.first, jump.last, jump.last + 2))
        for motion in track.gaps[np.any(track.gaps, axis=-1)]:
            edges = np.flatnonzero(motion[1:] != motion[:-1]) + 1
            extra.update(
                np.concatenate(
                    [edges, edges + 1] + [[i, i + 1] for i in np.flatnonzero(motion)[:1]]
                ).tolist()
            )
    extra = {i for i in extra if 0 < i < count - 1}
    if len(extra) > wanted // 3:
        extra = set()
    even = np.floor(np.linspace(0, count - 1, wanted - len(extra)) + 0.5 + TIE).astype(int)
    return np.array(sorted({*even.tolist(), *extra}))


def _encoded(values: Floats, prismatic: Bools) -> tuple[list[float], bytes]:
    """(motions, samples, n) as whole numbers of 16 bits, little-endian, and the step of each
    joint.
    """
    steps = np.ones(values.shape[-1])
    for kind in (prismatic, ~prismatic):
        if kind.any():
            greatest = np.nanmax(
                abs(values[..., kind]), initial=0, where=~np.isnan(values[..., kind])
            )
            steps[kind] = _step(greatest * (1 + TIE) / 32000)
    whole = np.floor(values / steps + 0.5 + TIE)
    whole = np.where(np.isnan(whole), NOTHING, whole).astype("<i2")
    return [float(f"{step:.0e}") for step in steps], whole.tobytes()


def _step(least: float) -> float:
    """The first number of the series 1, 2, 5, 10, ... that is not below `least`, from a millionth
    on.
    """
    least = max(least, 1e-6)
    power = 10.0 ** np.floor(np.log10(least) + 1e-12)
    return float(next(power * k for k in (1, 2, 5, 10) if power * k >= least * (1 - 1e-12)))


def _panel(arms: Sequence[Arm], curves: Sequence[Floats], unit: Page, order: int) -> Page:
    """Scales of one panel: [lowest tick, step, number of ticks, decimals] for turning ("turn") and
    shifting joints, and for each arm the limits [joint, 0 lower or 1 upper] that the panel shows
    ("near").

    All motions share one scale, unless most of them would fill less than a third of it: then each
    has its own. The limits are those that come near in any motion, so that they stay while a slider
    moves.
    """
    per = ("", "/s", "/s²")[order]
    # (motions, n) each
    ends = [(np.fmin.reduce(c, axis=1), np.fmax.reduce(c, axis=1)) for c in curves]
    ranges, own = {}, False
    for key in ("turn", "shift"):
        low, high = (
            np.concatenate(
                [
                    pair[k][:, arm.prismatic == (key == "shift")]
                    for arm, pair in zip(arms, ends, strict=True)
                ],
                axis=1,
            )
            for k in (0, 1)
        )
        if low.shape[1]:
            low, high = (
                np.nan_to_num(np.fmin.reduce(low, axis=1)),
                np.nan_to_num(np.fmax.reduce(high, axis=1)),
            )
            own |= bool(np.median(high - low) < (high.max() - low.min()) / 3)
            ranges[key] = low, high
    if not own:
        ranges = {key: ([low.min()], [high.max()]) for key, (low, high) in ranges.items()}
    scales = [
        _scales(both)
        for both in zip(*(zip(*pair, strict=True) for pair in ranges.values()), strict=True)
    ]
    word = ("angle" if "turn" in ranges else "position", "speed", "acceleration")[order]
    panel: Page = {"own": own, "near": []}
    seen = {}  # (motions, 2) lowest and highest tick
    for key, of in zip(ranges, zip(*scales, strict=True), strict=True):
        unique = sorted(set(of))
        panel[key] = {
            "unit": ("°" if key == "turn" else unit["name"]) + per,
            "scales": unique,
            "of": [unique.index(scale) for scale in of] if own else None,
        }
        panel.setdefault("label", f"{word}, {panel[key]['unit']}")
        seen[key] = np.array([(low, low + step * (count - 1)) for low, step, count, _ in of])
    for arm, pair in zip(arms, ends, strict=True):
        limits = arm.limits if order == 0 else arm.speed_limits if order == 1 else None
        shown = np.zeros((len(arm.links), 2), dtype=bool)
        if limits is not None:
            limits = limits if order == 0 else limits[:, None] * [-1, 1]
            limits = limits / np.where(arm.prismatic, unit["size"], deg)[:, None]
            ticks = np.stack([seen["shift" if x else "turn"] for x in arm.prismatic], axis=1)
            shown = np.any(near_limits(limits, *pair, ticks[..., 0], ticks[..., 1]), axis=0)
        panel["near"].append(np.argwhere(shown).tolist())
    return panel


def _scales(ranges: Sequence[Any]) -> list[Scale]:
    """The scale for one range (low, high); or for two in one panel, with zeros and ticks at the
    same heights.
    """
    ranges = [[float(f"{x:.6g}") if abs(x) > 1e-6 else 0.0 for x in ends] for ends in ranges]
    if len(ranges) == 1:
        return [_scale(*ranges[0])]
    best: list[Scale] = []
    most = 0.0
    for below, above in ((i, n - i) for n in range(2, 6) for i in range(n + 1)):
        if all((below or low >= 0) and (above or high <= 0) for low, high in ranges):
            least = [max(high / (above or 1), -low / (below or 1)) for low, high in ranges]
            steps = [float(f"{_step(x):.6g}") if x else 1.0 for x in least]
            filled = sum(
                (max(high, 0) - min(low, 0)) / step
                for (low, high), step in zip(ranges, steps, strict=True)
            )
            if filled / (below + above) > most * 1.001 or not best:
                best, most = (
                    [_ticks(-below * x, x, below + above + 1) for x in steps],
                    filled / (below + above),
                )
    return best


def _scale(low: float, high: float) -> Scale:
    """Matplotlib's choice of ticks, the outermost ones at or beyond the data."""
    low, high = (float(f"{x:.6g}") if abs(x) > 1e-6 else 0.0 for x in (low, high))
    if high - low < 1e-6 * max(abs(low), abs(high), 1e-3):
        pad = 0.5 * max(abs(low), 1.0)
        low, high = low - pad, high + pad
    ticks = MaxNLocator(nbins=4, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    return _ticks(float(f"{ticks[0]:.6g}"), float(f"{ticks[1] - ticks[0]:.6g}"), len(ticks))


def _ticks(low: float, step: float, count: int) -> Scale:
    """(lowest tick, step, number of ticks, decimals to write them with)"""
    return (
        low + 0.0,
        step,
        count,
        next(d for d in range(12) if abs(step - round(step, d)) < 1e-9 * step),
    )


def _decimals(curves: Iterable[Floats]) -> int:
    """How many decimals show the greatest value of this quantity with three digits; at least
    one.
    """
    greatest = max(np.nanmax(abs(c), initial=0, where=~np.isnan(c)) for c in curves)
    return 1 if greatest >= 10 else 2 if greatest >= 1 else 3


def _numbers(track: Recording, units: Floats, length: str, decimals: Sequence[int]) -> Page:
    """For every motion and joint: greatest speed, its share of the limit in percent, greatest
    acceleration.
    """
    arm, limits = track.arm, track.arm.speed_limits
    speed = np.nan_to_num(track.greatest_speed.value)
    acceleration = np.nan_to_num(track.greatest_acceleration.value) / units
    rows: list[list[float | str]] = [[_tidy(x, decimals[1]) for x in row] for row in acceleration]
    jumps = np.zeros_like(speed)
    for jump in track.jumps:
        jumps[jump.motion] = np.fmax(jumps[jump.motion], abs(jump.by) / units)
    for motion, joint in np.argwhere(jumps > 0):
        name = length if arm.prismatic[joint] else "°"
        rows[motion][joint] = (
            f"jump {_tidy(jumps[motion, joint], decimals[0]):.{decimals[0]}f} {name}/s"
        )
    share = None
    if limits is not None:
        share = [[int(_tidy(x, 0)) for x in row] for row in 100 * speed / limits]
    return {
        "speed": [[_tidy(x, decimals[0]) for x in row] for row in speed / units],
        "share": share,
        "acceleration": rows,
    }


def _closest(arm: Arm, q: Floats, via: Transform, unit: float) -> list[list[float] | None]:
    """For every motion [smallest distance from the via point in the length unit, x, y, z of that
    place in metres].

    The path is the polyline through all samples; NaN interrupts it. None where there is no path.
    """
    place = via.translation
    path = flange(arm, q).translation - place
    side = np.diff(path, axis=1)
    length = (side**2).sum(axis=-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        along = np.clip(np.where(length > 0, -(path[:, :-1] * side).sum(axis=-1) / length, 0), 0, 1)
    near = path[:, :-1] + along[..., None] * side
    distance = np.where(np.isnan(near[..., 0]), np.inf, np.linalg.norm(near, axis=-1))
    best = distance.argmin(axis=-1)
    found: list[list[float] | None] = []
    for c, i in enumerate(best):
        d = distance[c, i]
        found.append(
            [_tidy(d / unit, 1 if unit == mm else 3), *_rounded(near[c, i] + place, 4)]
            if np.isfinite(d)
            else None
        )
    return found


def _flaws(track: Recording, kept: Ints, units: Floats, length: str) -> Page:
    """What is wrong with each motion, for those with something wrong: gaps between kept samples,
    jumps to mark with their words, sentences to read.
    """
    gaps: dict[int, list[int]] = {}
    jumps: dict[int, list[Any]] = {}
    leaps: dict[int, list[Any]] = {}
    notes: dict[int, list[str]] = {}
    arm, count = track.arm, len(track.t)

    def amount(value: float, j: int, per: str = "") -> str:
        space, value = "" if not arm.prismatic[j] and not per else " ", abs(value) / units[j]
        # One decimal, or two significant digits.
        decimals = int(np.clip(1 - np.floor(np.log10(value * (1 + TIE) or 1)), 1, 9))
        unit = length if arm.prismatic[j] else "°"
        return f"{_tidy(value, decimals):.{decimals}f}{space}{unit}{per}"

    def worst(jump: Jump) -> int:
        return int((abs(jump.by) / units).argmax())

    for c, motion in enumerate(track.gaps):
        inside = np.add.reduceat(motion, kept[:-1]) if motion.any() else np.zeros(1)
        if inside.any():
            gaps[c] = np.flatnonzero(inside).tolist()
    for jump in track.jumps:
        j = worst(jump)
        words = f"speed jumps by {amount(jump.by[j], j, '/s')}"
        jumps.setdefault(jump.motion[0], []).append([_tidy(jump.time, 6), words])
    for c, marked in jumps.items():
        times = ", ".join(f"{when:.2f}" for when, _ in marked[:3])
        more = f" and {len(marked) - 3} more times" if len(marked) > 3 else ""
        notes.setdefault(c, []).append(
            f"The speed jumps at {times} s{more}: there is no acceleration there, and a "
            "finite-difference value would only tell the time step."
        )
    for jump in track.leaps:
        j = worst(jump)
        words = f"q{j + 1} jumps by {amount(jump.by[j], j)}"
        leaps.setdefault(jump.motion[0], []).append([_tidy(jump.time, 6), words])
    for c, marked in leaps.items():
        first = "; ".join(f"{text} at {when:.2f} s" for when, text in marked[:3])
        more = f"; and {len(marked) - 3} more" if len(marked) > 3 else ""
        notes.setdefault(c, []).append(f"Jumps of position: {first}{more}.")
    for c in range(len(track)):
        for j, excess in enumerate(track.excess[c].T):
            if (excess > 0).any():
                notes.setdefault(c, []).append(
                    f"q{j + 1} is past its limit in {(excess > 0).sum()} of {count} samples, "
                    f"by up to {amount(np.nanmax(excess), j)}."
                )
        for j, excess in enumerate(track.speed_excess[c].T):
            if (excess > 0).any():
                notes.setdefault(c, []).append(
                    f"q{j + 1} is past its speed limit in {(excess > 0).sum()} of {count} samples."
                )
        if track.missing[c].any():
            notes.setdefault(c, []).append(
                f"No solution in {track.missing[c].sum()} of {count} samples."
            )
    found: dict[str, dict[int, Any]] = {"gaps": gaps, "jumps": jumps, "leaps": leaps}
    found["notes"] = notes
    return {
        name: {str(c): value for c, value in sorted(flaws.items())} for name, flaws in found.items()
    }


def _scene(
    arms: Sequence[Arm],
    postures: Sequence[Floats],
    targets: Mapping[str, Transform],
    marks: Sequence[Mark],
    size: float,
) -> Page:
    """Where the camera stands, what it has to see, the floor and what lies in the space."""
    flat, foot = _plane(arms), 0.08 * size * np.array([[-1], [1]])
    parts = [arm_points(arm, q).reshape(-1, 3) for arm, q in zip(arms, postures, strict=True)]
    tools = [flange(arm, q) for arm, q in zip(arms, postures, strict=True)]
    tips = [
        (pose[..., None] @ (0.13 * size * np.eye(3))).reshape(-1, 3)
        for pose in (*tools, *targets.values())
    ]
    parts += [pose.translation[None] for pose in targets.values()]
    parts += [centre + radius * sign * np.eye(3) for _, centre, radius in marks for sign in (1, -1)]
    across = [k for k in range(3) if k != (2 if flat is None else flat)]
    seen = np.concatenate([*(foot * np.eye(3)[k] for k in across), *parts])
    low, high = np.nanmin(seen, axis=0), np.nanmax(seen, axis=0)
    step = _step(max(*(high - low)[across], size / 3) * (1 + TIE) / 8)
    low[across] = np.floor(low[across] / step + 0.1) * step
    high[across] = np.ceil(high[across] / step - 0.1) * step
    low[2] = min(low[2], 0.0) if flat is None and low[2] < -0.01 * size else 0.0
    places = np.concatenate([pose.translation.reshape(-1, 3) for pose in tools])
    return {
        "size": _tidy(size, 4),
        "flat": flat,
        "grid": _tidy(step, 6),
        "seen": _outermost(np.concatenate([seen, *tips])),
        "floor": [_rounded(low, 4), _rounded(high, 4)],
        "view": _rounded(_view(places, flat), 4),
        "targets": _stations(targets),
        "marks": [
            {"name": name, "at": _rounded(centre), "radius": radius}
            for name, centre, radius in marks
        ],
    }


def _stations(targets: Mapping[str, Transform]) -> list[Page]:
    return [{"name": name, "pose": _matrix(pose)} for name, pose in targets.items()]


def _outermost(points: Floats) -> list[list[float]]:
    """The points (k, 3) that a camera has to see, some fifty: those farthest out in evenly spread
    directions.

    Rounded first, so that which of two equal ones is taken does not depend on noise.
    """
    points = np.floor(points[np.isfinite(points).all(axis=-1)] * 200 + 0.5 + TIE).astype(np.int64)
    x, y, z = (points - points.min(axis=0)).T
    # One number for each place: a hundred times faster to sort than rows.
    points = points[np.unique((x << 40) + (y << 20) + z, return_index=True)[1]] / 200
    k = np.arange(100) + 0.5
    z, turn = 1 - 2 * k / 100, k * np.pi * (1 + 5**0.5)
    across = np.sqrt(1 - z**2)
    directions = np.round(np.stack([across * np.cos(turn), across * np.sin(turn), z], axis=-1), 3)
    return [
        _rounded(points[i], 3)
        for i in sorted(set((directions @ points.T).argmax(axis=-1).tolist()))
    ]


def _view(tools: Floats, flat: int | None) -> View:
    """Azimuth and elevation of the camera: straight at a plane, else from where the tool's path
    spreads widest, on the tool's side of the base.
    """
    if flat is not None:
        return STRAIGHT[flat]
    tools = tools[np.isfinite(tools).all(axis=-1)]
    if not len(tools):
        return VIEW
    spread, centre = np.cov(tools.T) if len(tools) > 1 else np.eye(3), tools.mean(axis=0)
    best, most = VIEW, 0.0
    # In these steps no side of the floor ever lies along the line of sight.
    for azimuth in VIEW[0] + np.array([0, 30, 90, 120, 180, 210, 270, 300]) * deg:
        screen = project(np.eye(3), (azimuth, VIEW[1])).T
        area = np.sqrt(max(np.linalg.det(screen @ spread @ screen.T), 0)) + 0.05 * (
            screen[0] @ spread @ screen[0]
        )
        toward = centre @ [np.cos(azimuth), np.sin(azimuth), 0]
        area *= 1 + 0.3 * np.tanh(5 * toward / (np.linalg.norm(centre) + 1e-9))
        if area > 1.05 * most:  # the small margin keeps noise from choosing between two equal ones
            best, most = (azimuth, VIEW[1]), area
    return best


def _plane(arms: Sequence[Arm]) -> int | None:
    """0, 1 or 2 if every arm can move only in the plane where that coordinate is zero, else
    None.
    """
    for axis in (2, 1, 0):
        if all(
            abs(
                arm_points(arm, np.linspace(0.1, 0.9, 5 * len(arm.links)).reshape(5, -1))[..., axis]
            ).max()
            < 1e-9
            for arm in arms
        ):
            return axis
    return None


def _words(page: Page, t: Floats, targets: Iterable[str]) -> tuple[str, str]:
    """The player in one sentence, rounded, and the alternative text of its still picture."""
    who = " and ".join(dict.fromkeys(arm["name"] for arm in page["arms"]))
    parts = [f"{_tidy(t[-1] - t[0], 3):g} s"]
    if page["slider"]:
        values = page["slider"]["values"]
        parts.append(
            f"{page['slider']['label']} {values[0]:g} to {values[-1]:g} in {len(values)} values"
        )
    if page["switch"]:
        parts.append(f"{page['switch']['label']} {' or '.join(page['switch']['values'])}")
    for arm in page["arms"]:
        label = f"{arm['name']}: " if len(page["arms"]) > 1 else ""
        speeds = arm["speed"]
        fastest = max(range(len(speeds[0])), key=lambda j: max(row[j] for row in speeds))
        unit = page["unit"]["name"] if arm["chain"][fastest]["prismatic"] else "°"
        parts.append(
            f"{label}greatest speed {max(row[fastest] for row in speeds):g} {unit}/s (joint "
            f"{fastest + 1})"
        )
        if arm["via"] and any(arm["via"]):
            near = [v[0] for v in arm["via"] if v]
            ends = f"{min(near):g}" if min(near) == max(near) else f"{min(near):g} to {max(near):g}"
            parts.append(
                f"{label}smallest distance from the via point {ends} {page['unit']['name']}"
            )
    summary = f"Player of {who}: {', '.join(parts)}."
    through = f" past {', '.join(targets)}" if targets else ""
    alt = f"{who} in the first and the last posture, with the path of the tool{through}. {summary}"
    return summary, alt


# --- The still picture ----------------------------------------------------------------------------


def _still(
    names: Sequence[str],
    motions: Sequence[tuple[Arm, Floats]],
    targets: Mapping[str, Transform],
    marks: Sequence[Mark],
    page: Page,
) -> plots.Figure:
    """The first and the last posture of each arm with the path of its tool."""
    count = len(motions)
    figure = plots.figure(page["alt"], width=4.5 * count if count > 1 else 6.4, height=4.5)
    figure.text(
        0.016,
        0.985,
        page["title"],
        fontsize=11,
        fontweight="bold",
        va="top",
        parse_math=False,
    )
    for k, (arm, q) in enumerate(motions):
        ax = figure.add_axes((k / count, 0, 1 / count, 0.93))
        scene = Scene(ax, size=page["scene"]["size"], like=page["scene"])
        exists = np.flatnonzero(np.isfinite(q).all(axis=-1))
        path = flange(arm, q[np.linspace(0, len(q) - 1, min(len(q), 1001)).astype(int)]).translation
        scene.base()
        if len(exists):
            scene.arm(arm, q[exists[0]], "first")
            scene.arm(arm, q[exists[-1]], "last")
            scene.triad(flange(arm, q[exists[-1]]), width=2.4)
        if np.isfinite(path).all(axis=-1).any():
            scene.trace(path)
        for name, pose in targets.items():
            scene.triad(pose, name)
        for name, centre, _ in marks:
            scene.line([centre], linestyle="none", marker="o", color=SOFT, markersize=5)
            if name:
                scene.label(name, centre)
        scene.finish()
        if count > 1:
            ax.text(
                0.03,
                1,
                names[k],
                transform=ax.transAxes,
                fontsize=10,
                fontweight="bold",
                color=INK,
                va="top",
                parse_math=False,
            )
    return figure


# --- Rounding, the same on every processor --------------------------------------------------------


def _tidy(x: float, decimals: int) -> float:
    """x rounded; an exact half and the noise around it always go up, and there is no minus zero."""
    scale = 10.0**decimals
    return float(np.floor(float(x) * scale + 0.5 + TIE) / scale) + 0.0


def _rounded(values: ArrayLike, decimals: int = 9) -> list[float]:
    return [_tidy(x, decimals) for x in np.ravel(values)]


def _matrix(pose: Transform) -> list[float]:
    """The upper three rows of the homogeneous matrix, one after the other."""
    return _rounded(pose.as_matrix()[:3])


def _script(name: str = "player.js") -> str:
    """A script of this folder without the lines that only people read, as it stands in every
    output.
    """
    from importlib.resources import files

    lines = files(__package__).joinpath(name).read_text(encoding="utf-8").splitlines()
    return "\n".join(line for line in map(str.strip, lines) if line and not line.startswith("//"))


# --- Files ----------------------------------------------------------------------------------------


def _file(path: Any) -> str:
    """`path` as a name that ends in .html."""
    name = os.fspath(path) if isinstance(path, (str, os.PathLike)) else None
    if not isinstance(name, str) or os.path.splitext(name)[1] != ".html" or "\0" in name:
        raise ValueError(f"path: wanted a name that ends in .html, got {short(path)}")
    folder = os.path.dirname(name) or os.curdir
    if not os.path.isdir(folder):
        raise ValueError(f"path: wanted a folder that exists, got {short(folder)}")
    return name


def _ours(name: str) -> bool:
    """Whether a saved player lies there: itself, and not a link to it."""
    if os.path.islink(name) or not os.path.isfile(name):
        return False
    with open(name, "rb") as file:
        return MARK.encode() in file.read(200)


def _write(name: str, content: bytes) -> None:
    """Beside it first, so that a reader, or a full disk, never sees half of it."""
    beside = os.path.join(os.path.dirname(name), f".{os.urandom(8).hex()}.html.part")
    try:
        with open(beside, "xb") as file:
            file.write(content)
        os.replace(beside, name)
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            os.remove(beside)
        raise
