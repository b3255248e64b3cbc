"""The zone of a SCARA, which is the area that its tool can reach, seen from above."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypedDict

import numpy as np

from ..._arrays import Floats, Ints, frozen
from ..._validate import instance
from ...arms.arm import ClosedFormArm
from ...arms.scara import ScaraGeometry
from ...units import deg
from .. import layers
from ..numbers import rounded
from ..palette import JOINT_STYLES, SOFT
from .thing import Thing

if TYPE_CHECKING:
    from ..scene import Scene

TURN = 2 * np.pi
STEP = 5 * deg  # the largest angle between two points of an arc
WIDTH = 2.0  # the width of a line
MINUS = "\N{MINUS SIGN}"


class ZoneSide(TypedDict):
    """A side of a zone: the index of the joint that is at its limit there, or None if the arm is
    stretched or folded there; its text, or ""; the dashes of its line in pixels; and its points
    (x, y, z).
    """

    joint: int | None
    text: str
    dash: list[float]
    points: list[list[float]]


class PageZone(TypedDict):
    """The sides of the zone of each elbow, in order."""

    kind: Literal["zone"]
    elbows: list[list[ZoneSide]]


@dataclass(frozen=True, init=False, eq=False)
class Zone(Thing):
    """The zone of a SCARA: the places (x, y) that its tool can reach while joints 1 and 2 are
    inside their limits. Each elbow has an area on the floor; the areas overlap at places that both
    elbows reach. On each line in the colour of a joint, this joint is at its limit. Raises
    TypeError if the arm is not a SCARA.

    sides   the sides of the area of each elbow, in order: the index of the joint at its limit, or
            None if the arm is stretched or folded; and points (k, 3)
    labels  texts with their positions (3,), which are points of the sides that they name
    texts   for each side, the text that names its limit, or ""
    """

    sides: tuple[tuple[tuple[int | None, Floats], ...], ...]
    labels: tuple[tuple[str, Floats], ...]
    texts: tuple[tuple[str, ...], ...]

    def __init__(self, arm: ClosedFormArm) -> None:
        geometry = instance(arm, ClosedFormArm, "arm").geometry
        if not isinstance(geometry, ScaraGeometry):
            raise TypeError(f"arm: wanted a SCARA, got {arm.name}")
        sides, labels, texts = [], [], []
        for elbow in (+1, -1):
            low, high = np.clip(
                np.sort(elbow * arm.limits[1]), 0, np.pi
            )  # the range of the absolute angle of joint 2
            if low == high:
                continue
            near, far = elbow * low, elbow * high
            # `stop` is the upper limit of joint 1 if the arm bends to the left, else the lower one
            start, stop = np.clip(arm.limits[0], None, arm.limits[0, 0] + TURN)[::elbow]
            turned = None if abs(stop - start) >= TURN - 1e-9 else 0
            joints = [1 if low else None, turned, 1 if high < np.pi else None, turned]
            limits = near, stop, far, start
            corners = np.array([(start, near), (stop, near), (stop, far), (start, far)])
            points = [_between(arm, *corners[[k, (k + 1) % 4]]) for k in range(4)]
            sides.append(tuple(zip(joints, points, strict=True)))
            texts.append(tuple(_text(*side, arm) for side in zip(joints, limits, strict=True)))
            for k, share in ((1, 0.05), (2, 0.4)):
                if texts[-1][k]:
                    labels.append((texts[-1][k], points[k][round(share * (len(points[k]) - 1))]))
        # both elbows have the side of joint 2 if its text is the same
        self.hold(sides=tuple(sides), labels=tuple(dict(labels).items()), texts=tuple(texts))

    def page(self, kept: Ints | None) -> PageZone:
        return {
            "kind": "zone",
            "elbows": [
                [_side(*side, text) for side, text in zip(around, texts, strict=True)]
                for around, texts in zip(self.sides, self.texts, strict=True)
            ],
        }

    def seen(self, axis: float) -> Floats:
        return np.concatenate([np.empty((0, 3)), *(p for around in self.sides for _, p in around)])

    def draw(self, scene: "Scene", sample: int | None) -> None:
        for around in self.sides:
            outline = np.concatenate([points for _, points in around])
            scene.faces([outline], facecolor=SOFT, alpha=0.2, edgecolor="none")
            for joint, points in around:
                style: dict[str, Any] = {"color": SOFT}
                if joint is not None:
                    dash = JOINT_STYLES[joint]["dash"]
                    style = {"color": JOINT_STYLES[joint]["color"], "dashes": dash or (1, 0)}
                scene.line(points, corner=False, linewidth=WIDTH, zorder=layers.FACES, **style)
        for text, at in self.labels:
            scene.label(text, at)


def _between(arm: ClosedFormArm, start: Floats, end: Floats) -> Floats:
    """Return the places (k, 3) of the tool, projected to the floor, while joint 1 or 2 turns from
    its value in `start` (2,) to its value in `end` (2,).
    """
    count = int(np.ceil(abs(end - start).max() / STEP)) + 1
    q = np.concatenate([np.linspace(start, end, count), np.zeros((count, 2))], axis=-1)
    return frozen(arm.fk(q).translation * [1, 1, 0])


def _text(joint: int | None, limit: float, arm: ClosedFormArm) -> str:
    """Return the text of a limit, or of both limits of joint 2 if their sides are on one circle."""
    if joint is None:
        return ""
    both = joint == 1 and arm.limits[1].sum() == 0
    number = f"±{abs(limit) / deg:g}" if both else f"{limit / deg:g}".replace("-", MINUS)
    return f"q{joint + 1} = {number}°"


def _side(joint: int | None, points: Floats, text: str) -> ZoneSide:
    dash = () if joint is None else JOINT_STYLES[joint]["dash"]
    return {
        "joint": joint,
        "text": text,
        "dash": [WIDTH * x for x in dash],
        "points": [rounded(point, 4) for point in points],
    }
