"""A figure of joint curves over time. In a notebook, the page draws the curves."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from .._arrays import ArrayLike, Floats, sealed
from .._validate import floats
from ..arms.arm import Arm
from ..motion.recording import Recording, record
from ..units import deg, mm
from . import findings
from .arguments import in_a_row
from .checks import if_given, samples, sentence
from .numbers import NOTHING, packed, scale, thin, tidy
from .output import Output
from .page import CurvePanel, PageCurves, PagePanel, Unit, Watch
from .page_panels import FINEST, joint_panel
from .palette import DASHES
from .panels import draw_panel, lay_out, without_spikes
from .plots import Figure
from .scene import number

SAMPLES = 241  # samples in the page, including both ends
ALL: Watch = {"panel": 0, "joints": None}


class Curves(Output):
    """Joint curves in a page. `data` is a `page.PageCurves`."""

    call = "joint_curves.show"


class JointFigure(Figure):
    """A figure of joint curves. A notebook shows its `page`, which draws the same curves in the
    theme and the width of the notebook; the figure itself is the still picture.
    """

    page: PageCurves

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        return Curves(self.page, self)._repr_mimebundle_() | {"text/plain": self.alt}

    def _in_page(self, nonce: str = "") -> str:
        """Return the HTML for a page whose security policy permits only scripts with this nonce."""
        return Curves(self.page, self)._in_page(nonce)


def plot_joints(
    arm: Arm | Recording,
    t: ArrayLike | None = None,
    q: ArrayLike | None = None,
    v: ArrayLike | None = None,
    a: ArrayLike | None = None,
    *,
    title: str | None = None,
    alt: str | None = None,
) -> "JointFigure":
    """Plot joint values over time and, if given, speeds and accelerations, each in its own panel,
    with a common time axis.

        plot_joints(arm, t, q), plot_joints(arm, t, q, v), plot_joints(arm, t, q, v, a)
        plot_joints(record(arm, t, q))      all three, with the speeds and accelerations of the
                                            recording

    t (samples,) is in seconds; q, v and a (samples, n) are in radians and metres. They are drawn as
    they are: NaN leaves a gap, and a jump by a whole turn is drawn as a jump. Prismatic joints have
    panels of their own, in mm. A limit is shaded if its joint comes near it; samples that exceed it
    are marked and counted. Samples are compared with the limits as they are drawn; q + 360 degrees
    may still be inside the limits (see `within`). Jumps are those that `record` finds.
    Differentiating a jump leaves a lone spike in v or a. A spike does not affect the scale: it
    extends beyond the panel, and the heading of the panel says so.

    A notebook shows the curves in the colours and the width of the page, with prismatic joints on
    an axis on the right; `savefig` writes the figure to a file.
    """
    title, alt = if_given(title, "title"), if_given(alt, "alt")
    given = {kind: values for kind, values in (("v", v), ("a", a)) if values is not None}
    if isinstance(arm, Recording):
        if t is not None or q is not None:
            raise ValueError("t and q: not allowed with a recording, which has its own")
        if arm.shape:
            raise ValueError(f"recording: wanted a single motion, got shape {arm.shape}")
        recording, kinds = arm, ["q", "v", "a"]
    else:
        q = samples(arm, q)
        recording, kinds = record(arm, floats(t, "t"), q), ["q", *given]
    arm = recording.arm
    drawn = {"q": recording.q, "v": recording.v, "a": recording.a}
    drawn |= {k: samples(arm, values, k, len(recording.t)) for k, values in given.items()}
    judged: dict[str, Any] = {k: sealed(without_spikes(recording, k, drawn[k])) for k in given}
    recording = replace(recording, **judged)
    groups = [
        (np.flatnonzero(arm.prismatic == shifts), unit, size)
        for shifts, unit, size in ((False, "°", deg), (True, "mm", mm))
        if (arm.prismatic == shifts).any()
    ]
    fig = JointFigure("", figsize=(9, (0.45 if title else 0.1) + 0.45 + 2.05 * len(kinds)))
    grid = fig.subplots(
        len(kinds),
        len(groups),
        sharex=True,
        squeeze=False,
        width_ratios=[1.7, 1] if len(groups) > 1 else None,
    )
    panels = [
        draw_panel(ax, recording, drawn[kind], kind, joints, unit, size)
        for kind, line in zip(kinds, grid, strict=True)
        for (joints, unit, size), ax in zip(groups, line, strict=True)
    ]
    for ax in grid[-1]:
        ax.set_xlabel("t, s", labelpad=2)
    lay_out(fig, panels, title)
    duration = number(recording.t[-1] - recording.t[0])
    facts = [f"{arm.name}, joint curves over {duration} s."]
    facts += [fact for panel in panels for fact in panel.facts]
    fig.alt = alt or " ".join([*sentence(title), *facts])
    notes = [(fact, panel.alarm) for panel in panels for fact in panel.facts[1:]]
    fig.page = curves_page(recording, drawn, kinds, title or "", fig.alt, notes)
    return fig


def curves_page(
    recording: Recording,
    drawn: Mapping[str, Floats],
    kinds: Sequence[str],
    title: str,
    alt: str,
    notes: list[tuple[str, bool]],
) -> PageCurves:
    """Return the data of the page: the curves `drawn` (samples, n) of these kinds. The scales are
    those of the recording, in which spikes are NaN.
    """
    arm, t = recording.arm, recording.t
    track = in_a_row(recording)
    unit: Unit = {"name": "mm", "size": mm}
    units = np.where(arm.prismatic, mm, deg)
    spikes = [np.isfinite(drawn[k]) & np.isnan(getattr(recording, k)) for k in kinds]
    kept = np.union1d(thin(len(t), [track], SAMPLES), np.flatnonzero(np.any(spikes, axis=(0, 2))))
    flaws = findings.flaws(track, kept, units, "mm")
    jumps, leaps = (flaws[key].get("0", []) for key in ("jumps", "leaps"))
    panels: list[CurvePanel] = []
    for order, kind in enumerate(kinds):
        values = getattr(track, kind) / units
        limits = arm.limits if kind == "q" else arm.speed_limits if kind == "v" else None
        if kind == "v" and limits is not None:
            limits = limits[:, None] * [-1, 1]
        panel = joint_panel([arm], [values], unit, "qva".index(kind), ALL)
        last = order == len(kinds) - 1  # the text for a jump in speed is in the last panel
        panels.append(
            {
                **panel,
                "values": packed(
                    _in_view(drawn[kind][kept] / units, arm, panel)[None],
                    FINEST["qva".index(kind)],
                    (arm.prismatic, ~arm.prismatic),
                ),
                "limits": None if limits is None else np.round(limits / units[:, None], 3).tolist(),
                "marks": [
                    *((time, "" if order else text) for time, text in leaps),
                    *((time, text if last else "") for time, text in jumps),
                ],
            }
        )
    return {
        "title": title,
        "summary": alt,
        "alt": alt,
        "nothing": NOTHING,
        "times": [tidy(x, 6) for x in t[kept]],
        "ticks": scale(t[0], t[-1]),
        "dashes": DASHES,
        "prismatic": arm.prismatic.tolist(),
        "gaps": flaws["gaps"].get("0", []),
        "panels": panels,
        "notes": notes,
    }


def _in_view(values: Floats, arm: Arm, panel: PagePanel) -> Floats:
    """Return the values (samples, n), clipped far outside the panel, because a spike of thousands
    would make the steps of `packed` coarse.
    """
    ends = []
    for shifts in arm.prismatic:
        low, step, count, _ = panel["axes"]["shift" if shifts else "turn"]["scale"]
        height = step * (count - 1)
        ends.append((low - height, low + 2 * height))
    clipped: Floats = np.clip(values, *np.transpose(ends))
    return clipped
