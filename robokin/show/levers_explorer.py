"""The explorers of an arm with three levers, which reaches a point with a family of postures."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import floats, instance, short
from ..arms.planar import ThreeLeverArm
from ..units import deg, length_unit, mm
from . import plots
from .camera import extent
from .charts import curves
from .explorer import TAKE, Explorer, arm_page, control, imports, number, picture
from .explorer_page import LeversPage
from .palette import DASHES, INK
from .scene import Scene

MOST = 20  # maximum number of targets
TERMS = tuple(f"|\N{GREEK CAPITAL LETTER DELTA}{letter}|" for letter in "γβα")
NOWHERE = "No posture reaches this point: "
SAYS: Mapping[str, str] = {
    "takeAlpha": "joint A, the gripper stays in place",
    "nextTarget": "next target",
    "least": "Least S",
    "begin": "Begin here",
    "again": "Start again",
    "costSays": "gamma {gamma}°, beta {beta}°, alpha {alpha}°: S = {S}°. The least S is "
    "{least}°, at alpha = {best}°.",
    "termSays": "gamma {gamma}°, beta {beta}°, alpha {alpha}°: S = {terms} {equals} {S}°; the "
    "longest turn is {longest}°. The least S is {least}°, at alpha = {best}°: {why}",
    "sumSays": " With the earlier {before}°, the total is {all}°. The longest turns add up to "
    "{longest}°.",
    "stays": "{names} keeps its value.",
    "stay": "{names} keep their values.",
    "atEnd": "an end of its range.",
    "isLevel": "the curve of S has a horizontal tangent there.",
    "curveSays": "S for alpha from {low}° to {high}°. The least S is {least}°, at {best}°.",
    "nowhere": "outside the allowed reach",
    "kink": "A kink at {alpha}°, where {name} keeps its value.",
}


def levers_explorer(arm: ThreeLeverArm) -> Explorer:
    """Return the `target_explorer` of an arm with three levers."""
    name, size = length_unit(extent(arm))
    place = np.array([0.55, 0.35]) * extent(arm)
    before, _ = arm.least(place, arm.limits.mean(axis=-1))
    where = ", ".join(number(x, 0 if size == mm else 3) for x in place / size)
    summary = (
        f"{arm.name} and a point that can be moved, at ({where}) {name}, with a free angle: gamma, "
        f"beta, alpha {', '.join(number(x, 1) for x in before / deg)}°."
    )
    data = _page(arm, f"{arm.name}: move the point", summary, before, place[None], before[None], ())
    return Explorer(data, picture(summary, arm, before))


def movement_explorer(arm: ThreeLeverArm, previous: ArrayLike, target: ArrayLike) -> Explorer:
    """Show how far the joints of an arm with three levers must turn to reach a target: the sum S of
    the angle changes from the posture `previous` (3,), as a curve over the free angle alpha, with
    its three terms |d gamma|, |d beta| and |d alpha|. Rings mark the kinks of S, where a term is
    zero, and a diamond marks the least value of S.

    The reader chooses alpha by dragging joint A or the curve, and can also drag the target.
    The button *Begin here* makes the current posture the previous one. If there are several targets
    (k, 2), in metres, it also moves on to the next target, and the page adds up the changes. Raises
    ValueError if `previous` is not one posture, if there is no target, or if the arm does not reach
    a target. Raises TypeError if the arm does not have three levers.
    """
    instance(arm, ThreeLeverArm, "arm")
    before, places = floats(previous, "previous", 3), floats(target, "target", 2)
    if before.ndim != 1:
        raise ValueError(f"previous: wanted one posture (3,), got shape {before.shape}")
    if places.ndim > 2 or not 0 < places.size <= 2 * MOST:
        wanted = f"a point (2,), or at most {MOST} points (k, 2)"
        raise ValueError(f"target: wanted {wanted}, got shape {places.shape}")
    places = places.reshape(-1, 2)
    for place in places:
        if why := arm.out_of_reach(place):
            raise ValueError(f"target: wanted points in reach, got {short(place.tolist())}: {why}")
    name, size = length_unit(extent(arm))
    best, S = arm.least(places[0], before)
    least = number(float(S) / deg, 1)
    where = ", ".join(number(x, 0 if size == mm else 3) for x in places[0] / size)
    summary = (
        f"{arm.name} and the sum S of the angle changes from gamma, beta, alpha "
        f"{', '.join(number(x, 1) for x in before / deg)}° to the point ({where}) {name}, over the "
        f"free angle alpha: S is least, {least}°, at {number(best[2] / deg, 1)}°."
    )
    rows = arm.family(places[:, None], np.linspace(*arm.alpha_range(places), 3, axis=-1))
    seen = np.concatenate([before[None], rows.reshape(-1, 3)])
    title = f"{arm.name}: least movement"
    data = _page(arm, title, summary, before, places, seen, TERMS)
    return Explorer(data, _still(summary, arm, before, places[0]))


def _page(
    arm: ThreeLeverArm,
    title: str,
    summary: str,
    before: Floats,
    places: Floats,
    seen: Floats,
    terms: tuple[str, ...],
) -> LeversPage:
    """Return the data of a page with the previous posture (3,) and the targets (k, 2). The picture
    has room for the postures `seen` (n, 3).
    """
    name, size = length_unit(extent(arm))
    most = float(np.ceil(1.05 * extent(arm) / (50 * mm)) * 50 * mm / size)
    step = 1 if size == mm else 0.001
    controls = [control(letter, name, -most, most, step) for letter in "xy"]
    controls.append(control("alpha", "°", 0, 180, 1))
    unequal = len(set(arm.geometry.levers)) > 1
    if unequal:
        low, high = (
            np.round(share * arm.reach / (50 * mm)) * 50 * mm / size for share in (0.1, 0.6)
        )
        controls += [
            control(f"lever {lever}", name, low, high, step) for lever in ("OB", "BA", "AK")
        ]
    unit = " * mm" if size == mm else ""
    page = arm_page(
        arm,
        title,
        summary,
        controls,
        seen,
        meant=TAKE + "S is counted from the dashed posture.",
        code=f"{imports(arm, *['three_lever'] * unequal)}\n"
        f"{'arm = three_lever(({levers}))' if unequal else '# arm = three_lever(...)'}\n"
        f"q = arm.family(({{x}}{unit}, {{y}}{unit}), {{alpha}} * deg)",
    )
    page["words"] |= dict(SAYS) | reasons(arm)
    return {
        "kind": "levers",
        **page,
        "q": before.tolist(),
        "targets": [{"place": [*map(float, place), 0.0]} for place in places],
        "curve": {
            "title": f"S = {' + '.join(terms)}" if terms else "S, the sum of the angle changes",
            "axis": "free angle alpha",
            "terms": list(terms),
            "dashes": DASHES[: len(terms)],
        },
    }


def reasons(arm: ThreeLeverArm) -> dict[str, str]:
    """The sentences of a page about a point that is out of reach, as in `out_of_reach`."""
    unequal = len(set(arm.geometry.levers)) > 1
    what = "|OB \N{MINUS SIGN} BA| + AK" if unequal else "one lever"
    return {
        "tooNear": f"This course allows only points farther from the base than {what} ({{inner}}); "
        "this one lies {distance} from it.",
        "tooFar": f"{NOWHERE}it lies {{distance}} from the base, farther than three levers "
        "({reach}).",
        "pastGamma": f"{NOWHERE}every posture for it has gamma outside 0° to 180°.",
    }


def _still(summary: str, arm: ThreeLeverArm, before: Floats, place: Floats) -> plots.Figure:
    """Draw the arm in the previous posture and in the one with the least S, next to the curve."""
    fig = plots.figure(summary, width=8, height=4)
    scene = Scene(fig.add_axes((0, 0, 0.5, 1)), size=extent(arm), flat=True)
    scene.base()
    best, S = arm.least(place, before)
    scene.arm(arm, before, "between")
    scene.arm(arm, best, "last")
    scene.finish()
    alphas = np.linspace(*arm.alpha_range(place), 361)
    change = abs(arm.family(place, alphas) - before) / deg
    ax: Any = fig.add_axes((0.59, 0.15, 0.38, 0.72))
    curves(
        ax,
        alphas / deg,
        dict(zip(TERMS, change.T, strict=True)),
        joints=range(3),
        xlabel="free angle alpha, °",
        ylabel="change, °",
        title="S and its terms",
    )
    ax.plot(alphas / deg, change.sum(axis=-1), color=INK, lw=2.4)
    ax.plot(best[2] / deg, S / deg, "D", color=INK, markersize=7)
    return fig
