"""The player: an arm that moves next to its curves, in any browser, without a kernel or a network.

`animate` computes everything once, at full resolution, and stores compact numbers in the page:
joint values, speeds and accelerations of about a hundred samples, and the table of greatest values
for every slider value. `js/player.js` draws them; the module `page` describes the data.
"""

import os
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import floats, instance, short
from ..arms.arm import Arm
from ..motion.recording import Recording
from ..transform import Transform
from ..units import deg, length_unit
from . import arguments, findings, plots
from .arguments import Targets
from .camera import apart, chain, extent, flange, scene_data, standing
from .checks import plain, yes
from .film import Film
from .numbers import NOTHING, decimals, packed, rounded, scale, thin, tidy
from .output import Output
from .page import Page, PageArm, PageScene, Slider, Switch, Unit, Watch
from .page_panels import FINEST, joint_panel, quantity_panel
from .palette import DASHES, INK
from .saving import write
from .scene import Scene
from .things import Target, Thing

SAMPLES, SAMPLES_UNDER_SLIDER = 241, 121  # samples per motion in the page, including both ends
NO_READINGS: Mapping[str, ArrayLike] = MappingProxyType({})


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
    floor: bool = False,
    bases: ArrayLike | None = None,
    faces: Iterable[ArrayLike] = (),
    readings: Mapping[str, ArrayLike] = NO_READINGS,
    things: Iterable[Thing] = (),
    watch: str | None = None,
    joints: Iterable[int] | None = None,
    quantities: Mapping[str, Any] = NO_READINGS,
    view: ArrayLike | None = None,
) -> "Player":
    """Return a `Player` of the motion q (samples, n) at the times t (samples,). It displays itself
    at the end of a cell.

        animate(arm, t, q), animate([arm, other], t, [q, q_other])
        animate(record(arm, t, q)), animate([recording, other])

    arm      an Arm, or a list of arms to draw side by side: then q and `names` are lists of the
             same length. Or recordings with the same times, which have their own t and q
    t, q     the motion at full resolution (such as 2001 samples). Speeds, accelerations and the
             numbers below the curves come from all samples; the page draws only some of them.
             Angles are unwrapped (see `follow`); a NaN row means "no solution here"
    targets  a list of Transforms (start and goal; start, via and goal), or a dict that maps names
             to Transforms. For a target called "via", the player shows its smallest distance from
             the path
    slider   (name, values): q is then (values, samples, n), and the page has a slider for the value
    switch   (name, [words]): q has one more leading axis, one motion for each word, and the page
             has a menu
    points   places to mark: a list of (x, y, z), or a dict that maps names to them, in metres and
             base coordinates
    circles  the same with (centre, radius), drawn as spheres, or as discs if the arm is planar
    floor    if True, the floor is at height 0 and hides what is below it; otherwise it is below
             everything
    bases    the places of several arms in one picture: (arms, 2), x and y in m; targets,
             points, circles and faces are then in coordinates of the floor. Named points
             can label the arms. At different places, the arms show no frames of their tools
    faces    polygons to draw behind the arms, such as a conveyor belt: corners (k, 3), m
    readings changing numbers to write after the names of points: a dict that maps names to arrays
             (samples,) or arrays with the leading axes of q; each number stays until the next
             sample
    things   anything else to draw, of the kinds in `robokin.show.things` or of your own kinds
    watch    the large panel: "q", "v", "a", or the name of a quantity; None: the first quantity or,
             if there is none, q. The reader can choose another panel
    joints   the joints to watch, counted from one; the curves of other joints are faint. None: all
             joints. An empty list: there are no curves of joints, only those of `quantities`
    quantities  numbers with a panel of their own, such as a distance: a dict that maps "name, unit"
             to an array (samples,) or an array with the leading axes of q; for several arms, to a
             list with one array for each
    view     the azimuth and elevation of the camera in radians. None: the direction from which the
             path of the tool appears largest

    Points, centres of circles and targets may move. The place of a point or centre then has the
    shape (samples, 3) or, with the leading axes of q, (..., samples, 3). If the place depends only
    on slider and switch, its shape is (..., 1, 3). A moving target is a Transform with one of these
    shapes without the 3. NaN means that the thing is missing. The distance from "via" is not shown
    if "via" moves with time, or with `bases`. Several arms side by side share targets, points,
    circles and faces.

    Raises ValueError if shapes do not match, there are fewer than three samples, the times do not
    increase, or a number is infinite. Raises TypeError if an arm or a target is of another type.
    """
    sliding, switching = arguments.slider(slider), arguments.switch(switch)
    lead = tuple(len(control["values"]) for control in (switching, sliding) if control)
    tracks, names = arguments.tracks(arm, t, q, lead, names)
    count = len(tracks[0].t)
    drawn = arguments.things(targets, points, circles, faces, readings, things)
    numbers = arguments.quantities(quantities, len(tracks), lead, count)
    looked = arguments.watch(watch, joints, list(numbers), [track.arm for track in tracks])
    for thing in drawn:
        thing.fit(lead, count)
    camera = None if view is None else floats(view, "view", 2)
    if camera is not None and camera.ndim != 1:
        raise ValueError(f"view: wanted an azimuth and an elevation in radians, got {short(view)}")
    title = " and ".join(dict.fromkeys(names)) if title is None else plain(title, "title")
    solid = yes(floor, "floor")
    stands = arguments.bases(bases, len(tracks))
    data = page_data(
        names, tracks, drawn, numbers, looked, sliding, switching, title, solid, stands, camera
    )
    motions = [(track.arm, track.q[0]) for track in tracks]
    still = still_picture(names, motions, drawn, data["scene"], title, data["alt"], stands)
    film = Film(tracks[0].t, motions, drawn, data["scene"], title, stands)
    return Player(data, still, film)


class Player(Output):
    """An arm and its curves, animated in the browser: see `animate`. `data` is a `page.Page`."""

    def __init__(self, data: Any, still: plots.Figure, film: Film) -> None:
        super().__init__(data, still)
        self.film = instance(film, Film, "film")

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write one self-contained page (.html), or the scene without the curves as an animated
        picture (.gif: 640 pixels, at most 12 frames per second and 120 frames, with the first value
        of a slider or menu). Raises ValueError if the name has another extension, if the file
        exists and is not a saved player, or if the picture is larger than 3 MB.
        """
        name = os.fspath(path) if isinstance(path, (str, os.PathLike)) else ""
        if isinstance(name, str) and os.path.splitext(name)[1] == ".gif":
            write(path, ".gif", self.film.gif)
        else:
            super().save(path)


# --- Page data ------------------------------------------------------------------------------------


def page_data(
    names: Sequence[str],
    tracks: Sequence[Recording],
    things: Sequence[Thing],
    quantities: Mapping[str, Floats],
    watch: Watch,
    slider: Slider | None,
    switch: Switch | None,
    title: str,
    solid: bool,
    bases: Floats | None,
    view: Floats | None,
) -> Page:
    """Return the data of the page."""
    arms, t = [track.arm for track in tracks], tracks[0].t
    motions, size = len(tracks[0]), max(extent(arm) for arm in arms)
    name, length = length_unit(size)
    unit: Unit = {"name": name, "size": length}
    units = [np.where(arm.prismatic, length, deg) for arm in arms]
    kept = thin(len(t), tracks, SAMPLES if motions == 1 else SAMPLES_UNDER_SLIDER)
    curves = [
        [x / u for x in (track.q, track.v, track.a)] for track, u in zip(tracks, units, strict=True)
    ]
    digits = [decimals([c[k] for c in curves]) for k in (1, 2)]
    targets = {thing.name: thing.way.rows for thing in things if isinstance(thing, Target)}
    via = targets.get("via")
    if bases is not None or via is not None and via.shape[1] > 1:
        via = None  # a target that moves with time has no single place
    drawn: list[PageArm] = [
        {
            "name": name,
            "chain": chain(arm.links),
            "limits": [rounded(arm.limits.T[i] / u, 3) for i in (0, 1)],
            "speedLimits": None if arm.speed_limits is None else rounded(arm.speed_limits / u, 3),
            "motion": [
                packed(x[:, kept], finest, (arm.prismatic, ~arm.prismatic))
                for x, finest in zip(curve, FINEST, strict=True)
            ],
            "rows": findings.rows(arm, track.q[:, kept]),
            "via": None if via is None else findings.closest(arm, track.q, via[..., 3::4], length),
            **findings.greatest(track, u, unit["name"], digits),
            **findings.flaws(track, kept, u, unit["name"]),
        }
        for arm, name, track, curve, u in zip(arms, names, tracks, curves, units, strict=True)
    ]
    postures = [track.q[:, kept] for track in tracks]
    scene = scene_data(arms, postures, things, size, kept, solid=solid, bases=bases)
    if view is not None:
        scene["view"] = rounded(view, 4)
    summary, alt = findings.summary_and_alt(drawn, t, targets, unit, slider, switch)
    return {
        "title": title,
        "summary": summary,
        "alt": alt,
        "nothing": NOTHING,
        "times": [tidy(x, 6) for x in t[kept]],
        "ticks": scale(t[0], t[-1]),
        "slider": slider,
        "switch": switch,
        "unit": unit,
        "dashes": DASHES,
        "scene": scene,
        "panels": [joint_panel(arms, [c[k] for c in curves], unit, k, watch) for k in range(3)],
        "quantities": [quantity_panel(name, x, kept) for name, x in quantities.items()],
        "watch": watch,
        "decimals": digits,
        "sampled": findings.sampled(t, any(arm["leaps"] for arm in drawn)),
        "arms": drawn,
    }


# --- The still picture ----------------------------------------------------------------------------


def still_picture(
    names: Sequence[str],
    motions: Sequence[tuple[Arm, Floats]],
    things: Sequence[Thing],
    scene_page: PageScene,
    title: str,
    alt: str,
    bases: Floats | None = None,
) -> plots.Figure:
    """Draw the first and the last posture of each arm with the path of its tool, and moving things
    at their last places.
    """
    count = 1 if bases is not None else len(motions)
    height = 4.5 if bases is None else 3.4
    figure = plots.figure(alt, width=4.5 * count if count > 1 else 6.4, height=height)
    figure.text(
        0.016,
        0.985,
        title,
        fontsize=11,
        fontweight="bold",
        va="top",
        parse_math=False,
    )
    feet = standing(bases, len(motions))
    for k in range(count):
        ax = figure.add_axes((k / count, 0, 1 / count, 0.93))
        scene = Scene(ax, size=scene_page["size"], like=scene_page)
        for i in range(len(motions)) if count == 1 else [k]:
            _still_arm(scene, *motions[i], feet[i], framed=not apart(bases))
        for thing in things:
            thing.draw(scene, -1)
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


def _still_arm(scene: Scene, arm: Arm, q: Floats, base: Floats, *, framed: bool) -> None:
    """Draw the first and last posture of one arm at `base`, the path of its tool, and its last
    frame if `framed`.
    """
    exists = np.flatnonzero(np.isfinite(q).all(axis=-1))
    path = flange(arm, q[np.linspace(0, len(q) - 1, min(len(q), 1001)).astype(int)]).translation
    scene.base(base)
    if len(exists):
        scene.arm(arm, q[exists[0]], "first", base)
        scene.arm(arm, q[exists[-1]], "last", base)
        if framed:
            scene.triad(Transform(translation=base) @ flange(arm, q[exists[-1]]), width=2.4)
    if np.isfinite(path).all(axis=-1).any():
        scene.trace(path + base)
