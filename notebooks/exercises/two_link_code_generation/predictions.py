"""The facts behind the predictions of two links and generated code."""

import importlib
import math
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import numpy as np

from robokin import deg, two_link

from .budget import operations
from .shared import LONG, MINUS, SHORT, Floats

NEAR = {"l1": 0.7, "l2": 1.0, "d": 0.5}  # p2
QUADRANTS = {  # p3
    "right and above": (0.9, 0.7),
    "left and above": (-0.9, 0.7),
    "left and below": (-0.9, -0.7),
    "right and below": (0.9, -0.7),
}
GAP = 1e-3  # p5: m inside the rim


def below(value: float, limits: Mapping[str, float]) -> str:
    """The name of the first limit that is above a value."""
    return next(name for name, limit in limits.items() if value < limit)


@cache
def p1() -> dict[str, Any]:
    x = np.linspace(-2, 2, 1601)
    tips = np.stack([x, np.full(len(x), 0.2)], axis=-1)
    exists = np.isfinite(two_link(LONG, SHORT).ik(tips)).all(axis=(-1, -2))
    times = int(np.count_nonzero(np.diff(exists.astype(int))))
    return {"times": times, "right": {0: "never", 2: "twice", 3: "three times", 4: "four"}[times]}


def p2() -> dict[str, Any]:
    l1, l2, d = NEAR.values()
    a = (d**2 + l1**2 - l2**2) / (2 * d**2)
    facts = {"share": a, "h": math.sqrt(l1**2 / d**2 - a**2), "at": abs(a) * d}
    right = below(a, {"behind the base": 0, "nearer to the base": 0.4, "middle": np.inf})
    return NEAR | facts | {"ratio": l1 / (l1 + l2) * 100, "right": right}


def quadratic(x3: float, y3: float, k: int = 0) -> Floats:
    """The elbow by the quadratic formula for equal links of 1 m, with coordinate k eliminated."""
    u, v = np.float64((x3, y3)[k]), np.float64((x3, y3)[1 - k])
    with np.errstate(all="ignore"):
        d2 = u * u + v * v
        other = (v * d2 + np.sqrt(u * u * d2 * (4 - d2))) / (2 * d2)
        gone = (d2 - 2 * v * other) / (2 * u)
    return np.array([gone, other] if k == 0 else [other, gone])


def on_right(x3: float, y3: float, k: int) -> bool:
    elbow = quadratic(x3, y3, k)
    return bool(x3 * elbow[1] - y3 * elbow[0] < 0)


def p3() -> dict[str, Any]:
    one, two, three, four = (on_right(*tip, 1) for tip in QUADRANTS.values())
    over_x3, over_y3 = one != two or three != four, two != three or one != four
    names = {(True, False): "x3 = 0", (False, True): "y3 = 0", (True, True): "both lines"}
    return {"right": names.get((over_x3, over_y3), "none")}


def p4() -> dict[str, Any]:
    x, y = quadratic(1e-300, 1.0)
    off = float(np.hypot(x, y))
    right = "no elbow" if np.isfinite(off) else "infinity"
    right = "NaN" if np.isnan([x, y]).any() else "right elbow" if abs(off - 1) < 1e-9 else right
    return {"x": abs(x), "y": y, "off": off, "right": right}


def p5() -> dict[str, Any]:
    q1, q2 = two_link(1, 1).ik((2 - GAP, 0))[0]
    facts = {"q2": q2 / deg, "q1": abs(q1) / deg, "linear": GAP / deg, "half": GAP / 2 / deg}
    facts["radians"] = float(q2)
    return facts | {"right": "q2"}


@cache
def p6() -> dict[str, Any]:
    sp: Any = importlib.import_module("sympy")
    x1, y1, x3, y3 = sp.symbols("x1 y1 x3 y3", real=True)
    l1, l2 = sp.symbols("l1 l2", positive=True)
    dx, dy = x3 - x1, y3 - y1
    d2 = dx**2 + dy**2
    a = (d2 + l1**2 - l2**2) / (2 * d2)
    h = sp.sqrt(l1**2 / d2 - a**2)
    right = [x1 + a * dx + h * dy, y1 + a * dy - h * dx]
    left = [x1 + a * dx - h * dy, y1 + a * dy + h * dx]
    facts: dict[str, Any] = {}
    for name, elbows in (("both", right + left), ("one", right)):
        steps, rest = sp.cse(elbows, symbols=sp.numbered_symbols("t"))
        facts[f"{name}_plain"] = sum(operations(str(each)) for each in elbows)
        facts[name] = sum(operations(str(each)) for each in [*(s for _, s in steps), *rest])
    one, both = facts["one"], facts["both"]
    facts |= {"half": both // 2, "quarter": facts["one_plain"] / 2, "saved": both - one}
    names = {"nearly as many": one, "half": facts["half"], "half as written": facts["quarter"]}
    named = next(name for name, count in names.items() if abs(count - one) < 1)
    return facts | {"factor": facts["both_plain"] / both, "right": named}


def listing(x3: float, y3: float, length: float, cast: Callable[[float], float]) -> dict[str, Any]:
    """The results of the program of section 6 and its temporaries, as C computes them."""
    with np.errstate(all="ignore"):
        t1, t3, t7 = (np.float64(cast(v * v)) for v in (x3, y3, length))
        t5 = np.float64(cast(t1 + t3))
        t11 = np.sqrt(t1 * t5 * (4 * t7 - t5))
        x2 = (t1 * t5 - y3 * t11) / x3 / t5 / 2
    return {"t1": t1, "t3": t3, "t5": t5, "t7": t7, "t11": t11, "x2": x2}


def p7() -> dict[str, Any]:
    whole, made = listing(0.5, 0.7, 1, float)["x2"], listing(0.5, 0.7, 1, int)
    right = "the same" if abs(made["x2"] - whole) < 1e-9 else "some tenths"
    right = "NaN" if np.isnan(made["x2"]) else right
    return {"told": f"{whole:.3f}".translate(MINUS), "t5": made["t5"], "right": right}


def under_root(x: Floats, y: Floats) -> Floats:
    """h squared for tips beside the base at 0, as the program of section 5 computes it."""
    t1, t3, t4 = LONG**2, x * x, y * y
    t5, t6 = t3 + t4, 2 * t3 + 2 * t4
    t7 = -(SHORT**2) + t1 + t5
    h2: Floats = t1 / t5 - t7 * t7 / (t6 * t6)
    return h2


def share_of_turn() -> Floats:
    """The values of u in the question: the tangent of half the direction of the tip."""
    return np.arange(-360, 361) / 360


def on_rim(u: Floats) -> tuple[Floats, Floats]:
    """The tips x, y of the stretched arm."""
    # only sums, products and quotients: the last digit of cos depends on the machine
    return 1.7 * (1 - u * u) / (1 + u * u), 1.7 * (2 * u) / (1 + u * u)


@cache
def p8() -> dict[str, Any]:
    x, y = on_rim(share_of_turn())
    h2 = under_root(x, y)
    plain = (
        LONG**2 / (x * x + y * y)
        - (LONG**2 - SHORT**2 + x * x + y * y) ** 2 / (2 * x * x + 2 * y * y) ** 2
    )
    lost, share = int((h2 < 0).sum()), 100 * float((h2 < 0).mean())
    facts = {"count": len(h2), "lost": lost, "above": int((h2 > 0).sum())}
    facts |= {"zero": int((h2 == 0).sum()), "plain": int((plain < 0).sum())}
    right = below(share, {"a few": 5, "a good part": 70, "all": np.inf}) if lost else "none"
    return facts | {"most": float(abs(h2).max()), "right": right}
