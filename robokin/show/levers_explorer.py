"""The explorer of an arm that reaches a point with a family of postures."""

import numpy as np

from ..arms.planar import ThreeLeverArm
from ..units import deg, length_unit, mm
from .camera import extent
from .explorer import TAKE, Explorer, arm_page, control, imports, number, picture
from .page import LeversPage


def levers_explorer(arm: ThreeLeverArm) -> Explorer:
    """Return the `target_explorer` of an arm with three levers."""
    name, size = length_unit(extent(arm))
    place = np.array([0.55, 0.35, 0.0]) * extent(arm)
    before, _ = arm.least(place, arm.limits.mean(axis=-1))
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
    where = ", ".join(number(x, 0 if size == mm else 3) for x in place[:2] / size)
    summary = (
        f"{arm.name} and a point to be moved, at ({where}) {name}, with a free angle: gamma, beta, "
        f"alpha {', '.join(number(x, 1) for x in before / deg)}°."
    )
    unit = " * mm" if size == mm else ""
    page = arm_page(
        arm,
        f"{arm.name}: move the point",
        summary,
        controls,
        before[None],
        meant=TAKE + "S is counted from the dashed posture.",
        code=f"{imports(arm, *['three_lever'] * unequal)}\n"
        f"{'arm = three_lever(({levers}))' if unequal else '# arm = three_lever(...)'}\n"
        f"q = arm.family(({{x}}{unit}, {{y}}{unit}), {{alpha}} * deg)",
    )
    data: LeversPage = {
        "kind": "levers",
        **page,
        "q": before.tolist(),
        "target": {"place": place.tolist()},
    }
    return Explorer(data, picture(summary, arm, before))
