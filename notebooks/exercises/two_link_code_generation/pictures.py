"""Views that open after the guess, for the predictions of this lab."""

import math
from typing import Any

import numpy as np

from robokin import deg, two_link
from robokin.show import Sketch, crossing_explorer, figure
from robokin.show.palette import ALARM, FIRST

from . import predictions as of
from .shared import LONG, MINUS, SHORT, Floats


def p1_view() -> Any:
    return crossing_explorer(two_link(LONG, SHORT), (-0.9, 0.2))


def p2_view() -> Any:
    facts = of.p2()
    base, tip = (0.0, 0.0), (facts["d"], 0.0)
    elbows = [(facts["share"] * facts["d"], side * facts["h"] * facts["d"]) for side in (-1, 1)]
    sketch = Sketch(
        f"Both elbows of the folded arm: the line through them crosses the x axis at "
        f"{elbows[0][0]:.2f} m, behind the base.",
        title=f"The line of the elbows, {facts['at']:.2f} m behind the base",
        unit="m",
    )
    for elbow, dashed in zip(elbows, (False, True), strict=True):
        sketch.levers([base, elbow, tip], dashed=dashed)
    sketch.length(elbows[1], elbows[0])
    sketch.point(base, "base", away=(1, 1))
    sketch.point(tip, "tip", away=(0, 1))
    sketch.ax.margins(0.3)
    return sketch


def p3_view() -> Any:
    return crossing_explorer(two_link(1, 1), (0.8, 0.6), divisor="y3")


def expanded(x3: float, y3: float) -> Floats:
    """As `quadratic`, but as SymPy writes it: not factored under the root."""
    a, b = 4 * x3**2 + 4 * y3**2, -4 * x3**2 * y3 - 4 * y3**3
    c = -4 * x3**2 + x3**4 + 2 * x3**2 * y3**2 + y3**4
    y2 = (4 * x3**2 * y3 + 4 * y3**3 + math.sqrt(max(-4 * a * c + b**2, 0))) / (2 * a)
    return np.array([(x3**2 + y3**2 - 2 * y3 * y2) / 2 / x3, y2])


def p4_view() -> str:
    lines = [
        "Links of 1 m, tip at (x3, 1): how far is the computed elbow from the base? First by "
        "`elbow_by_root` of section 4, then by `root_code` of the next cell, the same formula with "
        "the root multiplied out."
    ]
    for x3 in (1e-3, 1e-6, 1e-9, 1e-12, 1e-300):
        factored, multiplied = (np.hypot(*rule(x3, 1.0)) for rule in (of.quadratic, expanded))
        lines.append(f"x3 = {x3:.0e} m: {factored:.6f} m, {multiplied:.6f} m")
    return "\n".join(lines).translate(MINUS)


def p5_view() -> str:
    lines = ["Two links of 1 m, the tip inside the rim by"]
    for gap in (1e-1, 1e-2, 1e-3, 1e-4):
        _, q2 = two_link(1, 1).ik((2 - gap, 0))[0]
        lines.append(f"{gap * 1e3:g} mm: q2 = {q2 / deg:.2f}\N{DEGREE SIGN}")
    return "\n".join(lines)


def p6_view() -> str:
    f = of.p6()
    return (
        f"Both elbows: {f['both_plain']} operations as written, {f['both']} with temporaries.\n"
        f"The right elbow alone: {f['one_plain']} as written, {f['one']} with temporaries."
    )


def p7_view() -> str:
    lines = []
    for name, cast in (("with (int)", int), ("without", float)):
        values = of.listing(0.5, 0.7, 1, cast).items()
        numbers = ", ".join(f"{key} = {value:.4g}" for key, value in values)
        lines.append(f"{name}: {numbers.replace('nan', 'NaN')}")
    return "\n".join(lines).translate(MINUS)


def p8_view() -> Any:
    facts, u = of.p8(), of.share_of_turn()
    h2 = of.under_root(*of.on_rim(u))
    lost = h2 < 0
    picture = figure(
        f"The square of h for {facts['count']} directions of the stretched arm: below 0 for "
        f"{facts['lost']} (the root is NaN), above 0 for {facts['above']}, and exactly 0 "
        f"for {facts['zero']}.",
        height=3.2,
    )
    ax = picture.subplots()
    turns = 2 * np.arctan(u) / deg
    ax.plot(turns[~lost], h2[~lost] * 1e16, ".", color=FIRST, ms=3)
    ax.plot(turns[lost], h2[lost] * 1e16, "x", color=ALARM, ms=4)
    ax.set_xlabel("direction of the tip, \N{DEGREE SIGN}")
    ax.set_ylabel("square of h (no unit), 1e\N{MINUS SIGN}16")
    ax.set_title(f"No answer at the crosses: {facts['lost']} of {facts['count']} tips")
    picture.tight_layout()
    return picture
