"""Visit and collect: how many points the arm of source 000 can visit or collect in a given time.

A task is a JSON file with exactly the document's keys:

    L1, L2   lengths of the links, m        p0     where the tool starts, m: [x, y, z]
    T        time allowed, s                pi     the points, m: [[x, y, z], ...]
    q'       maximum joint speeds, rad/s    task   "visit": go from point to point; "collect": bring
             each back to p0

    task = read_task("notebooks/tasks/example_3.json")
    print(report(task, visit(task)))

All solutions are on the document's principal branch, row 0 of `spbu_arm(l1, l2).ik` (errata S0-d: a
second solution may exist within the same limits, and may be nearer). A joint that is free at a
point (joint 1 on axis 1; also joint 2 where equal links are folded onto the origin) keeps its value
when the arm arrives. A joint that is free at the start takes its value from the first target at
which it is not free (errata S0-p). Source: 000, "Определение границ рабочей области", "Нахождение
времени", appendix 1; errata S0.
"""

from .arm import (
    lowest,
    misfit,
    out_of_workspace,
    principal_postures,
    travel_time,
    workspace,
)
from .report_text import POINTS_SHOWN, report
from .solver import (
    ABOVE_LIMIT,
    EXACT_LIMIT,
    NEAREST_LIMIT,
    Result,
    answer,
    best_visit,
    collect,
    itinerary,
    visit,
)
from .task import FAULTS_SHOWN, KEYS, TASK_LIMIT, Task, TaskError, faults, read_task

__all__ = [
    "ABOVE_LIMIT",
    "EXACT_LIMIT",
    "FAULTS_SHOWN",
    "KEYS",
    "NEAREST_LIMIT",
    "POINTS_SHOWN",
    "TASK_LIMIT",
    "Result",
    "Task",
    "TaskError",
    "answer",
    "best_visit",
    "collect",
    "faults",
    "itinerary",
    "lowest",
    "misfit",
    "out_of_workspace",
    "principal_postures",
    "read_task",
    "report",
    "travel_time",
    "visit",
    "workspace",
]
