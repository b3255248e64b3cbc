"""The panels of curves in a page: their scales and the limits that they show."""

from collections.abc import Sequence

import numpy as np

from .._arrays import Floats, Ints
from ..arms.arm import Arm
from ..units import deg
from .numbers import packed, scale, scales
from .page import Axis, PagePanel, PageQuantity, Unit, Watch
from .panels import near_limits

# The number of steps in the greatest joint value, speed and acceleration. Joint values have finer
# steps, because the arm is drawn from them, too.
FINEST = (32000, 16000, 8000)


def joint_panel(
    arms: Sequence[Arm], curves: Sequence[Floats], unit: Unit, order: int, watch: Watch
) -> PagePanel:
    """Return the scales of one panel, for revolute and prismatic joints, and the limits that it
    shows.

    All motions share one scale, and the panel shows each limit that any motion comes near to, so
    that the scale and the limits do not change while a slider moves. Limits that some motion
    exceeds come first, since their labels take the first places. The limits of joints that are not
    watched are not shown.
    """
    per = ("", "/s", "/s²")[order]
    # for each arm, the least and greatest values: two arrays (motions, n)
    ends = [(np.fmin.reduce(c, axis=1), np.fmax.reduce(c, axis=1)) for c in curves]
    ranges = {}
    for key in ("turn", "shift"):
        least, greatest = (
            [x[:, arm.prismatic == (key == "shift")] for arm, x in zip(arms, both, strict=True)]
            for both in zip(*ends, strict=True)
        )
        if sum(x.shape[1] for x in least):
            ranges[key] = (
                float(np.nan_to_num(np.fmin.reduce(np.concatenate(least, axis=1), axis=None))),
                float(np.nan_to_num(np.fmax.reduce(np.concatenate(greatest, axis=1), axis=None))),
            )
    axes: dict[str, Axis] = {}
    seen = {}  # the lowest and highest tick of each axis
    for key, chosen in zip(ranges, scales(list(ranges.values())), strict=True):
        axes[key] = {"unit": ("°" if key == "turn" else unit["name"]) + per, "scale": chosen}
        low, step, count, _ = chosen
        seen[key] = low, low + step * (count - 1)
    near = []
    for arm, pair in zip(arms, ends, strict=True):
        limits = arm.limits if order == 0 else arm.speed_limits if order == 1 else None
        shown = past = np.zeros((len(arm.links), 2), dtype=bool)
        if limits is not None:
            limits = limits if order == 0 else limits[:, None] * [-1, 1]
            limits = limits / np.where(arm.prismatic, unit["size"], deg)[:, None]
            ticks = np.array([seen["shift" if x else "turn"] for x in arm.prismatic])
            shown = np.any(near_limits(limits, *pair, ticks[:, 0], ticks[:, 1]), axis=0)
            most = np.stack([-np.fmin.reduce(pair[0]), np.fmax.reduce(pair[1])], axis=-1)
            past = (most - limits * [-1, 1]).round(2) > 0  # in ° or mm; less is due to rounding
        if watch["joints"] is not None:
            shown[[j for j in range(len(shown)) if j not in watch["joints"]]] = False
        near.append(sorted(np.argwhere(shown).tolist(), key=lambda at: not past[tuple(at)]))
    word = ("angle" if "turn" in ranges else "position", "speed", "acceleration")[order]
    return {
        "label": f"{word}, {next(iter(axes.values()))['unit']}",
        "near": near,
        "axes": axes,
    }


def quantity_panel(name: str, values: Floats, kept: Ints) -> PageQuantity:
    """Return the panel of a quantity (arms, motions, samples)."""
    finite = values[np.isfinite(values)]
    whole = bool(len(finite) == values.size and (finite % 1 == 0).all())
    # coarse steps are exact for whole numbers, and need less room
    finest = 2 * max(1, abs(finite).max()) if whole else FINEST[0]
    return {
        "label": name,
        "scale": scale(*((finite.min(), finite.max()) if len(finite) else (0, 1))),
        "steps": whole,
        "values": [packed(one[:, kept, None], finest) for one in values],
    }
