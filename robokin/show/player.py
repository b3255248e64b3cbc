"""The player: an arm that moves beside its curves, in any browser, without a kernel and without a
network.

`animate` works everything out once, at full resolution, and hands the page whole numbers: joint
values, speeds and accelerations of some hundred samples, and for every slider value the numbers
worth reading. `player.js` draws them.
"""

import base64
import hashlib
import html
import json

import numpy as np
from matplotlib.ticker import MaxNLocator

from .._validate import floats, instance
from ..arms import Arm
from ..units import deg, mm
from . import plots
from .panels import near_limits
from .samples import samples
from .scene import INK, SOFT, STRAIGHT, VIEW, Scene, arm_points, named_targets, project, reach

SAMPLES, SAMPLES_UNDER_SLIDER = 241, 121  # per motion in the page, both ends included
# what joint values, speeds and accelerations of all motions may take; at least 41 samples
DATA_BYTES = 570_000
NOTHING = -32768  # the whole number that stands for "no value here"
# added before rounding: an exact half falls the same way on every processor
TIE = 2e-7 * np.sqrt(2)
MARK = "<!-- robokin player -->"  # what tells our own saved files from others'


def animate(
    arm,
    t,
    q,
    *,
    targets=(),
    slider=None,
    switch=None,
    title=None,
    points=(),
    circles=(),
    names=None,
):
    """A `Player` of the motion q (samples, n) at the times t (samples,); it shows itself at the end
    of a cell.

    arm      an Arm, or several side by side: then q and `names` are lists of the same length
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
    numbers.
    """
    arms, names, motions = _arms(arm, q, names)
    t = _times(t)
    slider, switch = _slider(slider), _switch(switch)
    lead = tuple(len(control["values"]) for control in (switch, slider) if control)
    motions = [
        _motions(a, m, lead, len(t), n) for a, m, n in zip(arms, motions, names, strict=True)
    ]
    targets = named_targets(targets)
    marks = _marks(points, circles)
    tracks = [samples(m, t, a.prismatic) for a, m in zip(arms, motions, strict=True)]
    data = _page(arms, names, t, tracks, targets, marks, slider, switch, title)
    for page in data["arms"]:
        page["data"] = [base64.b64encode(values).decode() for values in page["data"]]
    still = _still(arms, names, [track.q[0] for track in tracks], targets, marks, data)
    return Player(data, still)


class Player:
    """An arm and its curves, animated by the browser. Shows itself in a notebook; `save` writes it
    as a page.

    data    what the page draws, as JSON takes it; decoding rules at the head of `player.js`
    still   the figure that stands in its place until the script runs, in print and in an untrusted
            notebook
    """

    def __init__(self, data, still):
        self.data, self.still = data, still
        text = json.dumps(data, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
        self.text = (
            text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")
        )
        # Of the data and not of the picture: another zlib packs the same pixels into other bytes.
        self.id = hashlib.sha256(self.text.encode()).hexdigest()[:12]

    @property
    def html(self):
        """The player as a piece of HTML: the still picture, and the script that replaces it."""
        png = base64.b64encode(plots.palette_png(self.still)).decode()
        alt = html.escape(self.data["alt"])
        return (
            f'<div class="robokin-player" data-player="{self.id}"><img alt="{alt}" '
            f'style="max-width:100%" '
            f'src="data:image/png;base64,{png}"></div>\n'
            f'<script>(() => {{\n{_script()}\nplay("{self.id}", {self.text});\n}})();</script>\n'
        )

    def save(self, path):
        """Write one self-contained page. ValueError: not a .html file, or one that is there and not
        a saved player.
        """
        from pathlib import Path

        path = Path(path)
        if path.suffix != ".html":
            raise ValueError(f"path: wanted a name that ends in .html, got {str(path)!r}")
        if path.exists() and not (path.is_file() and MARK.encode() in path.read_bytes()[:200]):
            raise ValueError(
                f"path: {str(path)!r} exists and is not a saved player; nothing is overwritten"
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
        path.write_text(head + body, encoding="utf-8")

    def _repr_mimebundle_(self, include=None, exclude=None):
        return {"text/html": self.html, "text/plain": repr(self)}

    def __repr__(self):
        return self.data["summary"]


# --- What the caller gives ------------------------------------------------------------------------


def _arms(arm, q, names):
    """Lists of arms, names and joint values, whether one arm was given or several."""
    if not isinstance(arm, (list, tuple)):
        instance(arm, Arm, "arm")
        if names is not None:
            raise ValueError("names: wanted only with a list of arms; one arm has its own name")
        return [arm], [arm.name], [q]
    if not arm or not isinstance(q, (list, tuple)) or len(q) != len(arm):
        got = len(q) if isinstance(q, (list, tuple)) else type(q).__name__
        raise ValueError(f"q: wanted a list with one array for each of {len(arm)} arms, got {got}")
    for one in arm:
        instance(one, Arm, "arm")
    names = [one.name for one in arm] if names is None else [str(name) for name in names]
    if len(names) != len(arm):
        raise ValueError(f"names: wanted {len(arm)} names, one for each arm, got {len(names)}")
    return list(arm), names, list(q)


def _times(t):
    t = floats(t, "t")
    if t.ndim != 1 or len(t) < 3:
        raise ValueError(f"t: wanted at least three times, got shape {t.shape}")
    if (np.diff(t) <= 0).any():
        raise ValueError("t: wanted rising times, got a step that is not positive")
    return t


def _motions(arm, q, lead, count, name):
    """q as (motions, samples, n), the switch before the slider."""
    q = floats(q, f"q of {name}", finite=False)
    wanted = (*lead, count, len(arm.links))
    if q.shape != wanted:
        axes = ", ".join(["switch", "slider"][-len(lead) :] if lead else [])
        raise ValueError(
            f"q of {name}: wanted shape {wanted} ({axes + ', ' if axes else ''}samples, joints), "
            f"got {q.shape}"
        )
    return q.reshape(-1, *wanted[-2:])


def _pair(value, name, what):
    if not (isinstance(value, (list, tuple)) and len(value) == 2 and isinstance(value[0], str)):
        raise ValueError(f"{name}: wanted (name, {what}), got {value!r:.60}")
    return value


def _slider(slider):
    if slider is None:
        return None
    label, values = _pair(slider, "slider", "values")
    values = floats(values, "slider values")
    if values.ndim != 1 or len(values) < 2:
        raise ValueError(f"slider values: wanted at least two numbers, got shape {values.shape}")
    if (np.diff(values) <= 0).any():
        raise ValueError("slider values: wanted rising numbers")
    decimals = next(
        (d for d in range(6) if np.allclose(values, values.round(d), rtol=0, atol=1e-9)), 6
    )
    return {"label": label, "values": [_tidy(v, decimals) for v in values], "decimals": decimals}


def _switch(switch):
    if switch is None:
        return None
    label, values = _pair(switch, "switch", "words")
    if isinstance(values, str) or len(values) < 2 or not all(isinstance(v, str) for v in values):
        raise ValueError(f"switch: wanted a list of at least two words, got {values!r:.60}")
    return {"label": label, "values": list(values)}


def _marks(points, circles):
    """Points are circles without a radius: [(name, centre (3,), radius)]."""
    named = points.items() if isinstance(points, dict) else [("", p) for p in points]
    marks = [(str(name), _place(p, "points"), 0.0) for name, p in named]
    for name, circle in (
        circles.items() if isinstance(circles, dict) else [("", c) for c in circles]
    ):
        if len(circle) != 2:
            raise ValueError(f"circles: wanted (centre, radius), got {circle!r:.60}")
        radius = floats(circle[1], "radius")
        if radius.shape or radius <= 0:
            raise ValueError(f"radius: wanted one positive number, got {circle[1]!r:.60}")
        marks.append((str(name), _place(circle[0], "circles"), float(radius)))
    return marks


def _place(point, name):
    point = floats(point, name)
    if point.shape not in ((2,), (3,)):
        raise ValueError(f"{name}: wanted places (x, y, z), got shape {point.shape}")
    return np.append(point, [0.0] * (3 - len(point)))


# --- What the page gets ---------------------------------------------------------------------------


def _page(arms, names, t, tracks, targets, marks, slider, switch, title, scene=None):
    """What the page draws; joint values, speeds, accelerations as bytes. `scene`: the one of
    `_scene`, if at hand.
    """
    motions, size = len(tracks[0].q), max(reach(arm) for arm in arms)
    unit = {"name": "mm", "size": mm} if size <= 2 else {"name": "m", "size": 1}
    units = [np.where(arm.prismatic, unit["size"], deg) for arm in arms]
    alone = motions == 1 and scene is None  # else what is drawn changes while a slider moves
    kept = _thin(len(t), tracks, SAMPLES if alone else SAMPLES_UNDER_SLIDER)
    curves = [
        [x / u for x in (track.q, track.v, track.a)] for track, u in zip(tracks, units, strict=True)
    ]
    via = targets.get("via")
    page = {
        "title": title if title is not None else " and ".join(dict.fromkeys(names)),
        "times": [_tidy(x, 6) for x in t[kept]],
        "slider": slider,
        "switch": switch,
        "unit": unit,
        "styles": plots.JOINT_STYLES,
        "scene": scene
        or _scene(arms, [track.q[:, kept] for track in tracks], targets, marks, size),
        "panels": [_panel(arms, [c[k] for c in curves], unit, k) for k in range(3)],
        "decimals": [_decimals(arms, curves, k) for k in (1, 2)],
        "arms": [],
    }
    for arm, name, track, curve, u in zip(arms, names, tracks, curves, units, strict=True):
        steps, blobs = zip(*(_encoded(x[:, kept], arm.prismatic) for x in curve), strict=True)
        page["arms"].append(
            {
                "name": name,
                "chain": _chain(arm),
                "limits": [_rounded(arm.limits.T[i] / u, 3) for i in (0, 1)],
                "speedLimits": None
                if arm.speed_limits is None
                else _rounded(arm.speed_limits / u, 3),
                "steps": steps,
                "data": blobs,
                "via": _closest(arm, track.q, via, unit["size"]) if via is not None else None,
                **_numbers(arm, t, track, curve, u, unit["name"], page["decimals"]),
                **_flaws(arm, t, kept, track, u, unit["name"]),
            }
        )
    page["ticks"] = _scale(t[0], t[-1])
    page["summary"], page["alt"] = _words(page, t, targets)
    return page


def _chain(arm):
    return [
        {
            "before": _matrix(link.before),
            "axis": _rounded(link.axis),
            "after": _matrix(link.after),
            "prismatic": link.prismatic,
        }
        for link in arm.links
    ]


def _thin(count, tracks, wanted):
    """Which samples the page gets: evenly spread, and those on both sides of every jump."""
    values = sum(track.q.shape[0] * track.q.shape[2] for track in tracks)
    wanted = min(count, wanted, max(41, int(DATA_BYTES / (3 * values * 2 * 4 / 3))))
    extra = set()
    for track in tracks:
        for _, first, last, *_ in track.jumps:
            extra.update((first - 2, first, last, last + 2))
        for motion in track.breaks[track.breaks.any(axis=-1)]:
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


def _encoded(values, prismatic):
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


def _step(least):
    """The first number of the series 1, 2, 5, 10, ... that is not below `least`, from a millionth
    on.
    """
    least = max(least, 1e-6)
    power = 10.0 ** np.floor(np.log10(least) + 1e-12)
    return next(power * k for k in (1, 2, 5, 10) if power * k >= least * (1 - 1e-12))


def _panel(arms, curves, unit, order):
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
    panel = {"own": own, "near": []}
    for key, of in zip(ranges, zip(*scales, strict=True), strict=True):
        unique = sorted(set(of))
        panel[key] = {
            "unit": ("°" if key == "turn" else unit["name"]) + per,
            "scales": unique,
            "of": [unique.index(scale) for scale in of] if own else None,
        }
        panel.setdefault("label", f"{word}, {panel[key]['unit']}")
        ranges[key] = np.array([(low, low + step * (count - 1)) for low, step, count, _ in of])
    for arm, pair in zip(arms, ends, strict=True):
        limits = arm.limits if order == 0 else arm.speed_limits if order == 1 else None
        shown = np.zeros((len(arm.links), 2), dtype=bool)
        if limits is not None:
            limits = limits if order == 0 else limits[:, None] * [-1, 1]
            limits = limits / np.where(arm.prismatic, unit["size"], deg)[:, None]
            seen = np.stack(
                [ranges["shift" if shifts else "turn"] for shifts in arm.prismatic], axis=1
            )
            shown = near_limits(limits, *pair, seen[..., 0], seen[..., 1]).any(axis=0)
        panel["near"].append(np.argwhere(shown).tolist())
    return panel


def _scales(ranges):
    """The scale for one range (low, high); or for two in one panel, with zeros and ticks at the
    same heights.
    """
    ranges = [[float(f"{x:.6g}") if abs(x) > 1e-6 else 0.0 for x in ends] for ends in ranges]
    if len(ranges) == 1:
        return [_scale(*ranges[0])]
    best, most = None, 0.0
    for below, above in ((i, n - i) for n in range(2, 6) for i in range(n + 1)):
        if all((below or low >= 0) and (above or high <= 0) for low, high in ranges):
            least = [max(high / (above or 1), -low / (below or 1)) for low, high in ranges]
            steps = [float(f"{_step(x):.6g}") if x else 1.0 for x in least]
            filled = sum(
                (max(high, 0) - min(low, 0)) / step
                for (low, high), step in zip(ranges, steps, strict=True)
            )
            if filled / (below + above) > most * 1.001 or best is None:
                best, most = (
                    [_ticks(-below * x, x, below + above + 1) for x in steps],
                    filled / (below + above),
                )
    return best


def _scale(low, high):
    """Matplotlib's choice of ticks, the outermost ones at or beyond the data."""
    low, high = (float(f"{x:.6g}") if abs(x) > 1e-6 else 0.0 for x in (low, high))
    if high - low < 1e-6 * max(abs(low), abs(high), 1e-3):
        pad = 0.5 * max(abs(low), 1.0)
        low, high = low - pad, high + pad
    ticks = MaxNLocator(nbins=4, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    return _ticks(float(f"{ticks[0]:.6g}"), float(f"{ticks[1] - ticks[0]:.6g}"), len(ticks))


def _ticks(low, step, count):
    """(lowest tick, step, number of ticks, decimals to write them with)"""
    return (
        low + 0.0,
        step,
        count,
        next(d for d in range(12) if abs(step - round(step, d)) < 1e-9 * step),
    )


def _decimals(arms, curves, k):
    """How many decimals show the greatest value of this quantity with three digits; at least
    one.
    """
    greatest = max(np.nanmax(abs(c[k]), initial=0, where=~np.isnan(c[k])) for c in curves)
    return 1 if greatest >= 10 else 2 if greatest >= 1 else 3


def _numbers(arm, t, track, curve, units, length, decimals):
    """For every motion and joint: greatest speed, its share of the limit in percent, greatest
    acceleration.
    """
    speed = np.nanmax(abs(curve[1]), axis=1, initial=0, where=~np.isnan(curve[1]))
    acceleration = np.nanmax(abs(curve[2]), axis=1, initial=0, where=~np.isnan(curve[2]))
    for motion, _, _, before, after in track.jumps:
        speed[motion] = np.fmax(speed[motion], np.fmax(abs(before), abs(after)) / units)
    rows = [[_tidy(x, decimals[1]) for x in row] for row in acceleration]
    jumps = np.zeros_like(speed)
    for motion, _, _, before, after in track.jumps:
        jumps[motion] = np.fmax(jumps[motion], abs(after - before) / units)
    for motion, joint in np.argwhere(jumps > 0):
        name = length if arm.prismatic[joint] else "°"
        rows[motion][joint] = (
            f"jump {_tidy(jumps[motion, joint], decimals[0]):.{decimals[0]}f} {name}/s"
        )
    share = None
    if arm.speed_limits is not None:
        share = [[int(_tidy(x, 0)) for x in row] for row in 100 * speed * units / arm.speed_limits]
    return {
        "speed": [[_tidy(x, decimals[0]) for x in row] for row in speed],
        "share": share,
        "acceleration": rows,
    }


def _closest(arm, q, via, unit):
    """For every motion [smallest distance from the via point in the length unit, x, y, z of that
    place in metres].

    The path is the polyline through all samples; NaN interrupts it. None where there is no path.
    """
    place = via.translation
    path = arm.fk(q).translation - place
    side = np.diff(path, axis=1)
    length = (side**2).sum(axis=-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        along = np.clip(np.where(length > 0, -(path[:, :-1] * side).sum(axis=-1) / length, 0), 0, 1)
    near = path[:, :-1] + along[..., None] * side
    distance = np.where(np.isnan(near[..., 0]), np.inf, np.linalg.norm(near, axis=-1))
    best = distance.argmin(axis=-1)
    found = []
    for c, i in enumerate(best):
        d = distance[c, i]
        found.append(
            [_tidy(d / unit, 1 if unit == mm else 3), *_rounded(near[c, i] + place, 4)]
            if np.isfinite(d)
            else None
        )
    return found


def _flaws(arm, t, kept, track, units, length):
    """What is wrong with each motion, for those with something wrong: gaps between kept samples,
    jumps to mark with their words, sentences to read.
    """
    gaps, jumps, leaps, notes = {}, {}, {}, {}
    joints = range(len(arm.links))

    def amount(values, j, per=""):
        space, value = "" if not arm.prismatic[j] and not per else " ", abs(values[j]) / units[j]
        # One decimal, or two significant digits.
        decimals = int(np.clip(1 - np.floor(np.log10(value * (1 + TIE) or 1)), 1, 9))
        unit = length if arm.prismatic[j] else "°"
        return f"{_tidy(value, decimals):.{decimals}f}{space}{unit}{per}"

    for c, breaks in enumerate(track.breaks):
        inside = np.add.reduceat(breaks, kept[:-1]) if breaks.any() else np.zeros(1)
        if inside.any():
            gaps[c] = np.flatnonzero(inside).tolist()
    for c, first, last, before, after in track.jumps:
        worst = max(joints, key=lambda j: abs(after - before)[j] / units[j])
        when = (t[first] + t[last]) / 2
        words = f"speed jumps by {amount(after - before, worst, '/s')}"
        jumps.setdefault(c, []).append([_tidy(when, 6), words])
    for c, marked in jumps.items():
        times = ", ".join(f"{when:.2f}" for when, _ in marked[:3])
        more = f" and {len(marked) - 3} more times" if len(marked) > 3 else ""
        notes.setdefault(c, []).append(
            f"The speed jumps at {times} s{more}: there is no acceleration there, and a "
            "finite-difference value would only tell the time step."
        )
    for c, i, steps in track.leaps:
        worst = max(joints, key=lambda j: abs(steps[j]) / units[j])
        text = f"q{worst + 1} jumps by {amount(steps, worst)}"
        leaps.setdefault(c, []).append([_tidy((t[i] + t[i + 1]) / 2, 6), text])
    for c, marked in leaps.items():
        first = "; ".join(f"{text} at {when:.2f} s" for when, text in marked[:3])
        more = f"; and {len(marked) - 3} more" if len(marked) > 3 else ""
        notes.setdefault(c, []).append(f"Jumps of position: {first}{more}.")
    low, high = arm.limits[:, 0] - plots.SLACK, arm.limits[:, 1] + plots.SLACK
    over = np.fmax(low - track.q, track.q - high)
    fast = abs(track.v) - (np.inf if arm.speed_limits is None else arm.speed_limits * (1 + 1e-9))
    missing = np.isnan(track.q).any(axis=-1)
    for c in np.flatnonzero(
        missing.any(axis=-1) | (over > 0).any(axis=(1, 2)) | (fast > 0).any(axis=(1, 2))
    ):
        for j in joints:
            count = int((over[c, :, j] > 0).sum())
            if count:
                most = np.nanmax(over[c], axis=0, initial=0, where=~np.isnan(over[c]))
                notes.setdefault(c, []).append(
                    f"q{j + 1} is past its limit in {count} of {len(t)} samples, "
                    f"by up to {amount(most, j)}."
                )
        for j in joints:
            count = int((fast[c, :, j] > 0).sum())
            if count:
                notes.setdefault(c, []).append(
                    f"q{j + 1} is past its speed limit in {count} of {len(t)} samples."
                )
        if missing[c].any():
            notes.setdefault(c, []).append(
                f"No solution in {int(missing[c].sum())} of {len(t)} samples."
            )
    return {
        name: {str(int(c)): value for c, value in sorted(found.items())}
        for name, found in (("gaps", gaps), ("jumps", jumps), ("leaps", leaps), ("notes", notes))
    }


def _scene(arms, postures, targets, marks, size):
    """Where the camera stands, what it has to see, the floor and what lies in the space."""
    flat, foot = _plane(arms), 0.08 * size * np.array([[-1], [1]])
    seen = [arm_points(arm, q).reshape(-1, 3) for arm, q in zip(arms, postures, strict=True)]
    tools = [arm.fk(q) for arm, q in zip(arms, postures, strict=True)]
    tips = [
        (pose[..., None] @ (0.13 * size * np.eye(3))).reshape(-1, 3)
        for pose in (*tools, *targets.values())
    ]
    seen += [pose.translation[None] for pose in targets.values()]
    seen += [centre + radius * sign * np.eye(3) for _, centre, radius in marks for sign in (1, -1)]
    seen = np.concatenate(
        [foot * np.eye(3)[k] for k in range(3) if k != (2 if flat is None else flat)] + seen
    )
    low, high = np.nanmin(seen, axis=0), np.nanmax(seen, axis=0)
    across = [k for k in range(3) if k != (2 if flat is None else flat)]
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


def _stations(targets):
    return [{"name": name, "pose": _matrix(pose)} for name, pose in targets.items()]


def _outermost(points):
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


def _view(tools, flat):
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


def _plane(arms):
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


def _words(page, t, targets):
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


def _still(arms, names, postures, targets, marks, page):
    """The first and the last posture of each arm with the path of its tool."""
    figure = plots.figure(page["alt"], width=4.5 * len(arms) if len(arms) > 1 else 6.4, height=4.5)
    figure.text(0.016, 0.985, page["title"], fontsize=11, fontweight="bold", va="top")
    for k, (arm, q) in enumerate(zip(arms, postures, strict=True)):
        ax = figure.add_axes((k / len(arms), 0, 1 / len(arms), 0.93))
        scene = Scene(ax, size=page["scene"]["size"], like=page["scene"])
        exists = np.flatnonzero(np.isfinite(q).all(axis=-1))
        path = arm.fk(q[np.linspace(0, len(q) - 1, min(len(q), 1001)).astype(int)]).translation
        scene.base()
        if len(exists):
            scene.arm(arm, q[exists[0]], "first")
            scene.arm(arm, q[exists[-1]], "last")
            scene.triad(arm.fk(q[exists[-1]]), width=2.4)
        if np.isfinite(path).all(axis=-1).any():
            scene.trace(path)
        for name, pose in targets.items():
            scene.triad(pose, name)
        for name, centre, _ in marks:
            scene.line([centre], linestyle="none", marker="o", color=SOFT, markersize=5)
            if name:
                scene.label(name, centre)
        scene.finish()
        if len(arms) > 1:
            ax.text(
                0.03,
                1,
                names[k],
                transform=ax.transAxes,
                fontsize=10,
                fontweight="bold",
                color=INK,
                va="top",
            )
    return figure


# --- Rounding, the same on every processor --------------------------------------------------------


def _tidy(x, decimals):
    """x rounded; an exact half and the noise around it always go up, and there is no minus zero."""
    scale = 10.0**decimals
    return float(np.floor(float(x) * scale + 0.5 + TIE) / scale) + 0.0


def _rounded(values, decimals=9):
    return [_tidy(x, decimals) for x in np.ravel(values)]


def _matrix(pose):
    """The upper three rows of the homogeneous matrix, one after the other."""
    return _rounded(pose.as_matrix()[:3])


def _script(name="player.js"):
    """A script of this folder without the lines that only people read, as it stands in every
    output.
    """
    from importlib.resources import files

    lines = files(__package__).joinpath(name).read_text(encoding="utf-8").splitlines()
    return "\n".join(line for line in map(str.strip, lines) if line and not line.startswith("//"))
