"""A figure of how fast an arm's tool can move in each direction."""

from typing import Any

import numpy as np

from .._arrays import ArrayLike, Floats
from .._validate import warn_if_degrees
from ..arms.arm import Arm
from ..arms.dexterity import velocity_ellipsoid
from ..units import length_unit
from . import layers
from .camera import arm_points, extent, flange, is_flat
from .checks import if_given, samples, sentence
from .drawing import Polygon
from .palette import ALARM, INK, TRACE
from .plots import Figure
from .scene import Scene, number

MOST = 3  # maximum number of postures side by side
MARK = 0.16  # half the length of the red line for a short semi-axis, in arm lengths
ROUND = np.linspace(0, 2 * np.pi, 73)


def plot_velocity_ellipsoid(
    arm: Arm, q: ArrayLike, *, title: str | None = None, alt: str | None = None
) -> Figure:
    """Plot an arm in one posture q (n,), or in up to three postures (k, n) side by side. Each arm
    is drawn with the ellipsoid of the tool-point velocities that result from joint speeds of norm 1
    rad/s that do not rotate the tool. (The tool of an arm with up to three joints may rotate.)

    All panels have the same scales for lengths and velocities. The semi-axes are labelled with
    their speeds. A semi-axis shorter than a twentieth of the longest one is marked by a dashed red
    line: the tool can hardly move in that direction. `robokin.arms.dexterity.velocity_ellipsoid`
    returns the numbers.

    Raises ValueError if there are more than three postures, or if a posture contains NaN.
    """
    q = samples(arm, q)
    if len(q) > MOST or not np.isfinite(q).all():
        raise ValueError(f"q: wanted one to {MOST} postures without NaN, got {len(q)} rows")
    warn_if_degrees(q[..., ~arm.prismatic], "q")
    title, alt = if_given(title, "title"), if_given(alt, "alt")
    axes, tool = velocity_ellipsoid(arm, q), flange(arm, q).translation
    lengths = np.linalg.norm(axes, axis=-2)
    size, flat = extent(arm), is_flat(arm, q)
    longest = float(lengths.max())
    drawn = _round(0.35 * size / longest)  # the length in metres that represents 1 m/s
    name, unit = length_unit(longest)
    words = [[f"{number(np.round(x / unit, 6), 2)} {name}/s" for x in each] for each in lengths]
    fig = Figure(alt or _alt(arm, title, words), figsize=(9, 4.6 if len(q) > 1 else 5.2))
    if title:
        style: dict[str, Any] = {"fontsize": 12, "fontweight": "bold", "color": INK}
        fig.text(0.014, 0.985, title, va="top", parse_math=False, **style)
    points = [arm_points(arm, q).reshape(-1, 3)]
    # Points on the ellipsoids, so that each ellipsoid stays inside its panel.
    across, up = (x.ravel() for x in np.meshgrid(ROUND[::3], ROUND[::3]))
    ball = np.stack([np.cos(up) * np.cos(across), np.cos(up) * np.sin(across), np.sin(up)])
    points += [tool[i] + drawn * (axes[i] @ ball).T for i in range(len(q))]
    seen = np.concatenate(points)
    width, (measure_name, measure) = 1 / len(q), length_unit(size)
    for i, posture in enumerate(q):
        ax = fig.add_axes((i * width, 0, width, 0.92 if title else 1))
        scene = Scene(ax, size, flat=flat)
        scene.like = {**scene.like, "seen": seen}
        scene.corners.append(seen)
        scene.base()
        scene.arm(arm, posture, "first")
        _ellipsoid(scene, tool[i], drawn * axes[i])
        for k, way in enumerate(_ways(axes[i]).T):
            tip = tool[i] + drawn * axes[i, :, k]
            seen_as = np.linalg.norm(scene.project(way))  # zero if `way` points at the camera
            if seen_as > 1e-9 and lengths[i, k] < longest / 20:
                tip = tool[i] + MARK * size * way
                ends = [tool[i] - MARK * size * way, tip]
                scene.line(
                    ends,
                    color=ALARM,
                    linewidth=1.4,
                    linestyle=(0, (4, 2)),
                    zorder=layers.PATH + 0.5,
                )
                scene.label(words[i][k], tip, ALARM)
            elif lengths[i, k] > 0:
                scene.label(words[i][k], tip, TRACE)
        drawn_as = f"1 m/s is drawn {number(drawn / measure)} {measure_name} long"
        scene.finish(drawn_as if i == 0 else "")
    return fig


def _ways(axes: Floats) -> Floats:
    """Return the directions of the semi-axes (3, k). A zero semi-axis has a direction, too, if the
    other two are not zero. An undefined direction is NaN.
    """
    lengths = np.linalg.norm(axes, axis=0)
    there = lengths > 1e-9 * lengths.max()
    ways = np.full(axes.shape, np.nan)
    ways[:, there] = axes[:, there] / lengths[there]
    if there.sum() == 2:
        one, two = ways[:, there].T
        ways[:, ~there] = np.cross(one, two)[:, None]
    return ways


def _ellipsoid(scene: Scene, centre: Floats, axes: Floats) -> None:
    """Draw an ellipsoid: its filled outline, the three ellipses through pairs of its semi-axes (3,
    3), and the semi-axes.
    """
    flat = scene.project(axes.T).T  # shape (2, 3)
    ways, lengths, _ = np.linalg.svd(flat, full_matrices=False)
    ring = (ways * lengths) @ np.stack([np.cos(ROUND), np.sin(ROUND)])
    outline = (scene.project(centre)[:, None] + ring).T
    scene.drawn.append((outline, 1))  # so that labels avoid the outline
    scene.ax.add_patch(
        Polygon(
            outline,
            facecolor=TRACE,
            edgecolor=TRACE,
            alpha=0.18,
            linewidth=1.2,
            zorder=layers.LAST + 0.5,
        )
    )
    for a, b in ((0, 1), (1, 2), (0, 2)):
        ellipse = np.outer(np.cos(ROUND), axes[:, a]) + np.outer(np.sin(ROUND), axes[:, b])
        scene.line(
            centre + ellipse, corner=False, color=TRACE, linewidth=0.7, zorder=layers.LAST + 0.6
        )
    for axis in axes.T:
        scene.line([centre - axis, centre + axis], color=TRACE, linewidth=1.8, zorder=layers.FRAMES)


def _alt(arm: Arm, title: str | None, words: list[list[str]]) -> str:
    facts = sentence(title)
    facts.append(
        f"{arm.name} with the velocity ellipsoid of its tool, for joint speeds of 1 rad/s."
    )
    for i, each in enumerate(words):
        facts.append(f"Posture {i + 1}: semi-axes {', '.join(each)}.")
    return " ".join(facts)


def _round(x: float) -> float:
    """Return the greatest number of the series 1, 2, 5, 10, 20, ... that does not exceed x."""
    power = 10.0 ** np.floor(np.log10(x))
    return float(power * max(step for step in (1, 2, 5) if step * power <= x * 1.0001))
