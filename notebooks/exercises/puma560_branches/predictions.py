"""The facts behind the predictions: p1() for p1, with the name of the right answer as "right"."""

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import numpy as np

from robokin import PUMA560, Quaternion, Transform, blend, deg, differentiate, lin, mm, quintic
from robokin.motion import refined_maximum

from .shared import (
    D3,
    FORE,
    OFFSET,
    REST,
    UPPER,
    Floats,
    X,
    Y,
    Z,
    excess,
    near,
    serves,
    tracks,
    usable,
)

MINUS = str.maketrans("-", "\N{MINUS SIGN}")
SPEED = 100 * mm


def pose(x: float, y: float, z: float) -> Transform:
    return Transform(Quaternion.from_angle_axis(90 * deg, Y), np.array([x, y, z]) * mm)


# the line of section 6 of the lab, and a via point
START, GOAL, VIA = pose(550, 600, 800), pose(550, -200, 1100), pose(600, -100, 1000)


def nearest(value: float, guesses: Mapping[str, float]) -> str:
    """The name of the guess that is closest to a value."""
    return min(guesses, key=lambda name: abs(guesses[name] - value))


def waists(rho: float) -> Floats:
    """Both values of joint 1 for a wrist centre straight ahead, degrees: front and behind."""
    return PUMA560.ik(pose(rho / mm, 0, 900))[[0, 4], 0] / deg


@cache
def p2() -> dict[str, Any]:
    front, behind = waists(2 * D3)
    turn = abs(behind - front)
    one = (180 + turn) / 2
    guesses = {"opposite": 180, "lost once": one, "lost twice": turn, "in proportion": 90}
    return {"right": nearest(turn, guesses), "rho": 2 * D3 / mm, "turn": turn, "one": one}


NAMED = (0, 100, -20, 0, 30, 0)  # the posture of p9, degrees


@cache
def p9() -> dict[str, Any]:
    """The name is that of the row of `ik` with the same first five joints, up to whole turns."""
    q = np.array(NAMED) * deg
    off = np.sin((PUMA560.ik(PUMA560.fk(q)) - q) / 2)[:, :5]
    front, elbow, wrist = PUMA560.branches[int(abs(off).max(axis=-1).argmin())]
    side, height = "RIGHTY" if front > 0 else "LEFTY", "ABOVE" if front * elbow < 0 else "BELOW"
    gamma = q[2] + OFFSET
    return {
        "right": f"{side} {height} {'NOFLIP' if wrist > 0 else 'FLIP'}",
        "q": str(NAMED).translate(MINUS),
        "r": f"{(UPPER * np.cos(q[1]) + FORE * np.cos(q[1] + gamma)) / mm:.0f}".translate(MINUS),
        "gamma": gamma / deg,
    }


def random_poses(rng: np.random.Generator, shape: tuple[int, ...]) -> Transform:
    """Wrist centres spread uniformly over the box around the reach of the stretched arm, and
    orientations uniformly over all rotations.
    """
    wxyz = rng.normal(size=(*shape, 4))
    far = float(np.hypot(UPPER + FORE, D3))
    place = 671.83 * mm * Z + rng.uniform(-far, far, size=(*shape, 3))
    return Transform(Quaternion(wxyz / np.linalg.norm(wxyz, axis=-1, keepdims=True)), place)


@cache
def left_shares() -> Floats:
    """Shares of reachable poses with 0 to 8 rows inside the limits, %."""
    rows = PUMA560.ik(random_poses(np.random.default_rng(560), (8000,)))
    rows = rows[np.isfinite(rows).all(axis=(1, 2))]
    count = usable(rows).sum(axis=-1)
    return 100 * np.bincount(count, minlength=9) / len(count)


def p4() -> dict[str, Any]:
    shares = left_shares()
    guesses = {"less than 1 %": 1, "one in ten": 10, "a third": 33, "more than half": 60}
    facts = {"none": shares[0], "all": shares[8], "mean": shares @ np.arange(9) / 100}
    return facts | {"right": nearest(shares[0], guesses)}


NEAR = [0, 60, -93, 0, 6, 0], [0, 60, -170, 0, 0.6, 0]  # postures A and B, degrees


@cache
def p5() -> dict[str, Any]:
    facts: dict[str, Any] = {}
    for name, q_deg in zip(("both", "one"), NEAR, strict=True):
        q = np.array(q_deg) * deg
        facts[f"det_{name}"] = 1e4 * abs(float(np.linalg.det(PUMA560.jacobian(q))))
        facts[f"sigma_{name}"] = float(near(q))
        facts[name] = str(q_deg).translate(MINUS)
    ratio = facts["sigma_both"] / facts["sigma_one"]
    names = ("A is nearer", "about the same", "B is nearer")
    return facts | {"right": names[int(ratio > 0.6) + int(ratio >= 1.6)], "ratio": ratio}


def stretched(m: float) -> Transform:
    far = (UPPER + FORE) ** 2 - (600 * mm - 671.83 * mm) ** 2 + D3**2
    down = Quaternion.from_angle_axis(180 * deg, X)
    return Transform(down, np.array([np.sqrt(far) - m, 0, 600 * mm]))


def aligned(m: float) -> Transform:
    pose = PUMA560.fk(np.array([0, 60, -170, 0, 0, 0]) * deg)
    return Transform(pose.rotation, pose.translation + m * Z)


def beside(m: float) -> Transform:
    return Transform(translation=np.array([D3 + m, 0, 1200 * mm]))


# name -> row, miss m -> the pose nearest to the singularity, direction, whether it goes on
LINES: dict[str, tuple[int, Callable[[float], Transform], Floats, bool]] = {
    "wrist": (3, aligned, Y, True),
    "elbow": (3, stretched, X, False),
    "shoulder, towards": (2, beside, -X, False),
    "shoulder, past": (2, beside, Y, True),
}


def price(name: str, m: float) -> tuple[float, float]:
    """The greatest joint speed on a line, rad/s, refined until it stands, and the smallest distance
    from singularity.
    """
    row, middle, direction, goes_on = LINES[name]
    pose, end = middle(m), 1 if goes_on else 0
    twist = np.append(SPEED * direction, np.zeros(3))

    def joints(x: Floats) -> Floats:
        u = 200 * mm * x**3  # dense near the singularity
        poses = Transform(pose.rotation, pose.translation + u[:, None] * direction)
        return np.asarray(PUMA560.ik(poses)[:, row])

    def fastest(x: Floats) -> Floats:
        twists = np.tile(twist, (len(x), 1))[..., None]
        rates = np.linalg.solve(PUMA560.jacobian(joints(x)), twists)[..., 0]
        return np.asarray(abs(rates).max(axis=-1) / deg)

    distance = float(near(joints(np.linspace(-1, end, 201))).min())
    return refined_maximum(fastest, -1, end, 1).value * deg, distance


@cache
def p6() -> dict[str, Any]:
    past, distance = price("shoulder, past", 1 * mm)
    guesses = {  # rad/s
        ("over", "speed over distance"): SPEED / (1 * mm),
        ("towards", "as towards the axis"): price("shoulder, towards", 1 * mm)[0],
        ("past", "less than the worst"): past,
        ("worst", "the worst direction"): SPEED / PUMA560.reach / distance,
    }
    right = nearest(0, {name: np.log(x / past) for (_, name), x in guesses.items()})
    plane = np.arccos(D3 / (D3 + 1 * mm)) / deg  # between the arm's plane and the tangent
    facts = {fact: x / deg for (fact, _), x in guesses.items()}
    held = np.linalg.inv(PUMA560.jacobian(PUMA560.ik(beside(1 * mm))[2]))[:, :3]  # no rotation
    facts["single"] = SPEED * abs(held @ np.linalg.svd(held)[2][0]).max() / deg
    facts |= {"near": distance, "plane": plane, "ceiling": 2 * SPEED / D3 / deg}
    return facts | {"right": right}


RULES: dict[str, Callable[[Floats], Floats]] = {
    "nearest to the rest posture": lambda q: abs(q - REST).sum(axis=-1),
    "widest margin to the limits": lambda q: excess(q).max(axis=-1),
    "farthest from singularities": lambda q: -near(q).round(9),
}


PAIRS = 3000  # of random poses, the ends of lines


@cache
def p7() -> dict[str, Any]:
    rng = np.random.default_rng(7)
    ends = random_poses(rng, (2, PAIRS))
    ends = ends[:, np.isfinite(PUMA560.ik(ends)).all(axis=(0, 2, 3))]
    rows = PUMA560.ik(lin(ends[0][:, None], ends[1][:, None], np.linspace(0, 1, 81)))
    rows = rows[np.isfinite(rows).all(axis=(1, 2, 3))]  # (lines, 81, 8, 6)
    followed = tracks(rows)  # (lines, 8, 81, 6)
    served = serves(followed)
    can = served.any(axis=-1)
    facts: dict[str, Any] = {"lines": int(can.sum()), "pairs": PAIRS}
    for k, rule in enumerate(RULES.values()):
        pick = np.where(usable(rows[:, 0]), rule(followed[:, :, 0]), np.inf).argmin(axis=-1)
        missed = ~served[np.arange(len(rows)), pick][can]
        facts[f"rule{k}"] = 100 * missed.mean()
    guesses = {"none": 0, "a few": 5, "four in ten": 40, "nearly all": 85}
    facts["tens"] = 10 * round(facts["rule0"] / 10)
    share = facts["rule0"] / 100
    facts["scatter"] = 100 * np.sqrt(share * (1 - share) / facts["lines"])  # standard deviation
    return facts | {"right": nearest(facts["rule0"], guesses)}


@cache
def twins() -> tuple[Floats, Floats]:
    """Times and the motions (2, samples, 6) of rows 0 and 1 past the via point."""
    t = np.linspace(0, 10, 501)
    return t, tracks(PUMA560.ik(blend(START, VIA, GOAL, 0.1, quintic(10)(t))))[:2]


@cache
def p8() -> dict[str, Any]:
    t, both = twins()
    zero, one = abs(differentiate(both, t)).max(axis=(1, 2)) / deg
    over = excess(both[0]).max()
    right = "faster"
    if abs(zero - one) < 1e-6 * one:
        right = "past a limit" if over > 0 else "inside as well"
    bend = abs(both[0][:, 4]).min()
    return {"right": right, "one": np.ceil(one), "by": over / deg, "bend": bend / deg}
