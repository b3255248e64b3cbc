"""Curves and bars in a plot, in the style of all our figures.

fig = figure("The follower lags throughout.")
curves(fig.subplots(), t, {"leader": one, "follower": two}, xlabel="t, s", ylabel="q1, °")
fig
"""

from collections.abc import Mapping, Sequence
from typing import Any

from .._arrays import ArrayLike
from .._validate import floats, instance, number, short, whole
from .checks import plain, several
from .drawing import Axes
from .palette import COMPARED, FIRST, JOINT_STYLES

LOOKS = [(style["color"], (0, style["dash"])) for style in JOINT_STYLES]  # joints 1 to 6


def curves(
    ax: Axes,
    x: ArrayLike,
    values: Mapping[str, ArrayLike],
    *,
    joints: Sequence[int] | None = None,
    xlabel: str = "",
    ylabel: str = "",
    title: str = "",
) -> None:
    """Draw up to four named curves, each with its own colour and dash pattern, and a legend if
    there are several curves.

    x       (samples,)
    values  a dict that maps each name to values (samples,); NaN leaves a gap
    joints  the joint of each curve, from 0 to 5, which determines its colour and dash pattern; with
            `joints`, there may be up to six curves
    xlabel, ylabel  quantity and unit, as in "t, s"
    """
    named = _named(values)
    looks: list[Any] = list(COMPARED)
    if joints is not None:
        looks = [LOOKS[whole(i, "joints", 0, 5)] for i in several(joints, "joints", "joints", 6)]
    if len(named) > len(looks):
        raise ValueError(f"values: wanted at most {len(looks)} curves, got {len(named)}")
    at = floats(x, "x")
    _labels(instance(ax, Axes, "ax"), xlabel, ylabel, title)
    for (name, value), (color, dash) in zip(named.items(), looks, strict=False):
        y = floats(value, f"values: {name}", finite=False)
        if at.ndim != 1 or y.shape != at.shape:
            raise ValueError(
                f"values: wanted {name} and x of the same shape (samples,), "
                f"got {y.shape} and {at.shape}"
            )
        ax.plot(at, y, color=color, ls=dash, lw=2.2, label=name)
    if len(named) > 1:
        ax.legend()


def bars(
    ax: Axes,
    values: Mapping[str, float],
    form: str = "{:g}",
    *,
    xlabel: str = "",
    title: str = "",
) -> None:
    """Draw a horizontal bar for each name, from top to bottom, with its value at the end.

    values  a dict that maps each name to a number
    form    the format of a value, as in "{:.1f} ms"
    xlabel  quantity and unit
    """
    lengths = {name: number(value, f"values: {name}") for name, value in _named(values).items()}
    try:
        written = [plain(form, "form").format(value) for value in lengths.values()]
    except (ValueError, LookupError, AttributeError, TypeError):
        raise ValueError(
            f'form: wanted a format such as "{{:.1f}} ms", got {short(form)}'
        ) from None
    _labels(instance(ax, Axes, "ax"), xlabel, "", title)
    ax.bar_label(ax.barh(list(lengths), list(lengths.values()), color=FIRST), written, padding=4)
    ax.invert_yaxis()
    ax.margins(x=0.25)


def _named(values: Any) -> dict[str, Any]:
    if not isinstance(values, Mapping) or not values:
        raise ValueError(f"values: wanted a dict that maps names to values, got {short(values)}")
    return {plain(key, "values"): value for key, value in values.items()}


def _labels(ax: Axes, xlabel: str, ylabel: str, title: str) -> None:
    ax.set_xlabel(plain(xlabel, "xlabel"))
    ax.set_ylabel(plain(ylabel, "ylabel"))
    ax.set_title(plain(title, "title"))
