"""Views that open after the guess, for the predictions of this lab."""

from typing import Any

import numpy as np

from robokin import mm
from robokin.jobs.conveyor import ALONG, GAP, serve, spaced, ways_from
from robokin.show import figure
from robokin.show.palette import COMPARED, FIRST_AREA, INK, PAPER, REMARK, SECOND_AREA

from .predictions import SPEEDS, p1, p2, p3, p9
from .shared import COUNT


def p1_view() -> Any:
    facts = p1()
    return (
        f"{facts['c']:.2f} s for each object x {facts['rate']:.2f} objects a second = "
        f"{facts['load']:.2f} s of work each second.\nRounded up: {facts['up']} arms."
    )


def p2_view() -> Any:
    facts = p2()
    says = (
        "Where one arm meets its objects, plotted over time. By the rule back soonest it takes "
        f"{facts['soon']}, most of them where they come in; by the rule first come "
        f"{facts['first']}, most of them near the far end of the window."
    )
    fig = figure(says, height=3.4)
    ax = fig.subplots()
    stream = spaced(COUNT, GAP, 0.5)
    for first_come, (color, _) in zip((False, True), COMPARED, strict=False):
        (trips,) = serve(stream, 150 * mm, ALONG, ways_from(), first_come=first_come)
        ax.plot(trips.meets, ALONG[trips.places] / mm, "ov"[first_come], color=color, ms=4)
        name = "first come" if first_come else "back soonest"
        ax.text(208, np.median(ALONG[trips.places]) / mm, name, color=color, va="center")
    ax.set(xlabel="time, s", ylabel="position along the belt, mm", xlim=(0, 265), ylim=(-430, 430))
    ax.set(xticks=range(0, 201, 50), yticks=range(-400, 401, 200))
    ax.set_yticklabels(["in, bin: −400", "−200", "0", "200", "out: 400"])
    ax.set_title(f"{facts['soon']} objects near the bin, or {facts['first']} far from it")
    fig.tight_layout()
    return fig


def p3_view() -> Any:
    facts = p3()
    soonest, takes, c = facts["soonest"], facts["takes"], facts["c"]
    says = (
        f"The {COUNT} objects, shared out among the arms. Back soonest: {len(soonest)} arms take "
        f"{' and '.join(map(str, soonest))}, {c:.1f} s each. First come: {len(takes)} arms take "
        f"{', '.join(map(str, takes))}; only the last of them needs {c:.1f} s for each, the others "
        f"about {facts['costs'][0]:.1f} s."
    )
    fig = figure(says, height=2.6)
    ax = fig.subplots()
    costs = [[c] * len(soonest), facts["costs"]]
    for row, (shares, times) in enumerate(zip((soonest, takes), costs, strict=True)):
        done = 0
        for k, (share, time) in enumerate(zip(shares, times, strict=True), 1):
            color = (FIRST_AREA, SECOND_AREA)[row]
            ax.barh(-row, share, 0.7, done, color=color, edgecolor=PAPER, lw=2)
            each = f"arm {k}: {share} objects,\n{time:.2f} s each"
            ax.text(done + share / 2, -row, each, color=INK, ha="center", va="center")
            done += share
    ax.set(xlabel="objects, arm after arm", xlim=(0, COUNT), yticks=[0, -1])
    ax.set_yticklabels(["back soonest", "first come"])
    ax.set_title(f"{len(soonest)} arms that are back soonest, or {len(takes)} that serve in order")
    fig.tight_layout()
    return fig


def p9_view() -> Any:
    facts = p9()
    even, uneven = facts["even"], facts["uneven"]
    says = (
        f"Objects missed of 200 over the belt speed. Evenly spaced: none up to {even} "
        f"mm/s. Unevenly spaced: none up to {uneven} mm/s, then more and more."
    )
    fig = figure(says, height=3.4)
    ax = fig.subplots()
    for name, (color, line) in zip(("even", "uneven"), COMPARED, strict=False):
        lost = facts["lost"][name]
        ax.plot(SPEEDS, lost, line, color=color, lw=2.2, marker="o", ms=4)
        higher = lost[-1] == max(facts["lost"]["even"][-1], facts["lost"]["uneven"][-1])
        ax.text(142, lost[-1] + (3 if higher else -3), name, color=color, va="center")
    ax.axvline(facts["rule"], color=REMARK, ls=":", lw=1.3)
    ax.text(facts["rule"] - 1, 45, "c v / g = 1", color=REMARK, ha="right")
    ax.set(xlabel="belt speed, mm/s", ylabel="objects missed of 200", xlim=(58, 150), ylim=(-2, 58))
    ax.set_title(f"None missed up to {even} mm/s evenly spaced, {uneven} unevenly")
    fig.tight_layout()
    return fig
