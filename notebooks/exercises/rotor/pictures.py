"""Views that open after the guess, for the predictions of this lab."""

from typing import Any

import numpy as np

from robokin import deg
from robokin.show import curves, figure
from robokin.show.palette import COMPARED, INK, REMARK, SOFT

from .predictions import missed, p1
from .shared import MOTOR


def p8_view() -> Any:
    away = np.linspace(-180, 180, 361)
    says = (
        "The torque over the angle from the rotor to the field. A magnet is pulled hardest at 90 "
        "degrees and comes to rest at one angle only. Plain iron is not pulled at 90 degrees at "
        "all and rests at 0 and at 180."
    )
    fig = figure(says, 6.4, 3.2)
    ax = fig.subplots()
    curves(
        ax,
        away,
        {"magnet": np.sin(away * deg), "plain iron": np.sin(2 * away * deg)},
        xlabel="field ahead of the rotor, °",
        ylabel="torque, fraction of the greatest",
        title="A quarter turn ahead pulls a magnet, not plain iron",
    )
    ax.axvline(90, color=INK, lw=1, ls=":")
    ax.axhline(0, color=SOFT, lw=0.8, zorder=0)
    ax.legend(fontsize=9, loc="center left", bbox_to_anchor=(1, 0.5))
    ax.set_xticks(range(-180, 181, 90))
    fig.tight_layout()
    return fig


def p10_view() -> Any:
    rest, ramped = ({f: n for f, n in ways.items() if n} for ways in missed().values())
    says = (
        f"Steps lost of 48 over the frequency. Without a ramp {min(rest.values())} to 48 are lost "
        f"from {min(rest)} pulses per second on, with a ramp {min(ramped.values())} to "
        f"{max(ramped.values())} from {min(ramped)} on, and always a multiple of 4."
    )
    fig = figure(says, 6.4, 3.2)
    ax = fig.subplots()
    for j, (name, ways) in enumerate(missed().items()):
        color, dash = COMPARED[j]
        ax.plot(list(ways), list(ways.values()), "os"[j], ls=dash, color=color, ms=5, label=name)
    ax.legend(fontsize=9)
    ax.set(xlabel="frequency, pulses/s", ylabel="steps lost of 48", yticks=range(0, 49, 8))
    ax.set_title("Lost steps come in fours; a ramp loses fewer")
    ax.grid(axis="y", lw=0.5)
    fig.tight_layout()
    return fig


def p1_view() -> Any:
    facts = p1()
    times = np.arange(1, 8)  # inertia of rotor and load, in that of the rotor
    tops = [MOTOR.start_frequency(load_inertia=(k - 1) * MOTOR.inertia) for k in times]
    root = facts["alone"] / np.sqrt(times)
    says = (
        f"The maximum start frequency over the moment of inertia. Alone it is {facts['alone']:.0f} "
        f"pulses per second, with four times the inertia {facts['loaded']:.0f}, a little above "
        f"{facts['half']:.0f}, which the root alone would give."
    )
    fig = figure(says, 6.4, 3.2)
    ax = fig.subplots()
    (color, dash), *_ = COMPARED
    ax.plot(times, tops, dash, color=color, marker="o", ms=5)
    ax.plot(times, root, ":", color=REMARK)
    ax.text(times[-1], tops[-1] + 12, "the motor", color=color, ha="right")
    ax.text(times[-1], root[-1] - 12, "one over the root", color=REMARK, ha="right")
    ax.set(
        xlabel="inertia of rotor and load, times the rotor's", ylabel="start frequency, pulses/s"
    )
    ax.set(ylim=(0, 140), xticks=times)
    ax.set_title(f"Four times the inertia: {facts['loaded']:.0f} instead of {facts['alone']:.0f}")
    fig.tight_layout()
    return fig
