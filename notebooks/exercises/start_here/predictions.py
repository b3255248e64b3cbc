"""The numbers of this lab's prediction; its text is in the Markdown file beside it."""

from functools import cache
from typing import Any

import numpy as np

from robokin import deg

from .shared import minus, place

YOURS = (-20, -10, 0, 30, 0)  # q2 to q6, in degrees, as the lab has them
ANGLE = 40  # degrees, joint 1
NAMES = ("behind, left", "right", "behind, right", "exchanged")


def turned(angle: float) -> Any:
    return np.array([angle, *YOURS]) * deg


@cache
def p1() -> dict[str, Any]:
    (x, y, z), (x1, y1, _) = place(turned(ANGLE)), place(turned(-ANGLE))
    options = [(-x, y), (x, -y), (-x, -y), (y, x)]
    facts: dict[str, Any] = {"angle": ANGLE, "x": f"{x:.0f}", "y": f"{y:.0f}", "z": f"{z:.0f}"}
    for k, (a, b) in enumerate(options):
        facts[f"option{k}"] = minus(f"x = {a:.0f} mm, y = {b:.0f} mm")
        facts[f"at{k}"] = minus(f"{np.arctan2(b, a) / deg:.0f}°")  # the angle of joint 1 there
    facts["right"] = NAMES[int(np.argmin([np.hypot(a - x1, b - y1) for a, b in options]))]
    return facts
