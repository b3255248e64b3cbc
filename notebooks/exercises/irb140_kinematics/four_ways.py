"""The conditions of exercise 2; its text is in the Markdown file beside it."""

from typing import Any

import numpy as np

from robokin import IRB140, Transform, explain, mm, within
from robokin.course.exercises import in_words
from robokin.course.function import Fault
from robokin.course.slips import METRES

from .shared import L0, L1, L4, Floats, Z

COUNT = 1
CLOSE = 30 * mm  # the triangle does not close at smaller distances
WAYS = "Without its limits, the arm reaches this pose in {count} ways."
GOAL = {
    "wanted": 4,
    "holds": WAYS + " Do all of them have front −1?",
    "open": WAYS + " The exercise asks for {wanted}.",
}


def form(answer: Any, given: Any) -> Transform:
    """Return the answer if it is one pose. ValueError: it is not."""
    if isinstance(answer, Transform) and answer.shape == ():
        return answer
    hint = ""
    with np.errstate(all="ignore"):
        if np.shape(answer) == (6,):
            hint = ": six numbers are a posture; IRB140.fk(q) gives its pose"
        elif np.shape(answer) == (3,):
            hint = ": a position without an orientation"
        elif np.shape(answer) == (4, 4):
            hint = "; Transform.from_matrix turns it into one"
    raise ValueError(f"Wanted one Transform, got {in_words(answer)}{hint}.")


def faults(pose: Transform, given: Any) -> list[Fault]:
    """Exactly the four rows with front -1 have to exist, and no two may be the same posture."""
    distance = float(np.linalg.norm(pose.translation))
    if distance > 5:
        far = f"Your flange is {distance:.0f} m away from the base. {METRES}"
        return [("mm for m", far)]
    rows = IRB140.ik(pose)
    exists = np.asarray(np.isfinite(rows).all(axis=-1))
    count = int(exists.sum())
    if count == 0:
        return [("no way: out of reach", f"No row of ik exists. {explain(IRB140, pose, 0)}")]
    usable = int(within(IRB140, rows).all(axis=-1).sum())
    if count == 8 and usable == 4:
        says = (
            "Four rows are inside the limits, but all eight exist. Count a row even if a joint is "
            f"past its limit, because it still reaches the pose. {measured(pose)}"
        )
        return [("limits counted", says)]
    if count != 4:
        return [too_many(pose, count)]
    if exists[:4].any():
        says = (
            "Four rows exist, but they have front +1: your target is too far away for an arm that "
            "faces away. The exercise asks for the other four rows. A triangle also fails to close "
            "if the wrist centre is too close to the shoulder."
        )
        return [("the rows that face the target", says)]
    names = [
        name for name, holds in IRB140.geometry.singularities(rows[exists]).items() if holds.any()
    ]
    if names:
        says = (
            f"The right four rows exist, but the pose is at a singularity ({', '.join(names)}), "
            "where two rows are the same posture or joints are free. Move the pose a little."
        )
        return [("rows twice: a singular pose", says)]
    return []


def too_many(pose: Transform, count: int) -> Fault:
    """Not four rows: the distances of the wrist centre, and what to ask about them."""
    where = measured(pose)
    if from_shoulder(pose.translation, +1) < CLOSE:
        says = (
            "You put the flange near the shoulder, but the triangle ends at the wrist centre, "
            f"65 mm behind the flange. {where}"
        )
        return "the flange instead of the wrist centre", says
    if abs(from_shoulder(np.asarray(pose @ (-L4 * Z)), +1) - CLOSE) < 0.01 * mm:
        says = (
            f"{where} At exactly 30 mm, the triangle still closes: the arm is folded, and its two "
            "elbow positions coincide. Choose a smaller distance."
        )
        return "exactly at the edge", says
    says = (
        f"{count} rows of ik exist. {where} At which distances does the triangle close with front "
        "−1, but not with front +1?"
    )
    return "all eight ways" if count == 8 else f"{count} ways", says


def measured(pose: Transform) -> str:
    """Where the wrist centre of the pose is, and how far from the shoulder with each front flag."""
    centre = np.asarray(pose @ (-L4 * Z))
    facing, away = (from_shoulder(centre, front) / mm for front in (+1, -1))
    place = ", ".join(str(round(x / mm)) for x in centre.tolist())
    return (
        f"The wrist centre of your pose is at ({place}) mm. Its distance d from the shoulder is "
        f"{facing:.1f} mm with front +1, and {away:.1f} mm with front −1."
    )


def from_shoulder(point: Floats, front: int) -> float:
    """The distance d, in metres, of a point (3,) from the shoulder with this front flag."""
    return float(np.hypot(front * np.hypot(point[0], point[1]) - L1, point[2] - L0))
