"""Where exercises and predictions are found by their ids: "irb140_motion.1" is exercise 1 of the
lab whose file is called irb140_motion, whatever its number; "irb140_motion.p2" a prediction.
"""

import importlib
from types import ModuleType
from typing import Any

LABS = (
    "start_here",
    "frames_and_quaternions",
    "irb140_kinematics",
    "irb140_motion",
    "scara_kinematics",
    "scara_motion",
    "spherical_wrist",
    "puma560_branches",
    "visit_and_collect",
    "three_levers",
    "obstacle_avoidance",
    "motor_synchronisation",
    "two_link_code_generation",
)


def lab(name: Any) -> ModuleType:
    """The file of a lab: OBJECTIVES, EXERCISES, PREDICTIONS, `given`. ValueError: none such."""
    if name not in LABS:
        raise ValueError(f"lab: wanted one of {', '.join(LABS)}, got {name!r}")
    return importlib.import_module(f".{name}", __package__)


def titled(name: str) -> str:
    """A lab as people call it: "lab 03, irb140 motion"."""
    return f"lab {LABS.index(name):02}, {name.replace('_', ' ')}"


def find(name: Any, what: str) -> Any:
    """The exercise or prediction with an id. `what`: EXERCISES or PREDICTIONS. ValueError: none
    such.
    """
    slug, dot, number = str(name).partition(".")
    if slug not in LABS or not dot:
        known = ", ".join(LABS)
        raise ValueError(f'id: wanted a lab and a number, "{LABS[0]}.1", of {known}; got {name!r}')
    entries = getattr(lab(slug), what)
    if number not in entries:
        known = ", ".join(f"{slug}.{key}" for key in entries)
        raise ValueError(f"id: wanted one of {known}, got {name!r}")
    return entries[number]
