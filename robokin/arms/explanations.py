"""All sentences that `explain` (in `branches.py`) can return. A page uses them, too.

The facts are in braces. {what} is the point to be positioned, {gap} a length with its unit,
{degrees} an angle. The others are {row}, {flags}, {reason}, {hint}, {facts}, {joint}, {value},
{over} and {limit}.
"""

SENTENCES = {
    # whole sentences
    "missing": "Row {row} ({flags}) does not exist: {reason}{hint}",
    "usable": "Row {row} ({flags}) is usable: it is inside every limit and not singular.",
    "usable but": "Row {row} ({flags}) is usable, but {facts}.",
    "not usable": "Row {row} ({flags}) is not usable: {facts}.",
    "millimetres": "; lengths are in metres: did you mean millimetres (350 * mm)?",
    # why a row does not exist
    "stretched": "{what} is {gap} beyond the reach of the arm",
    "folded": "{what} is {gap} too near to joint 2",
    "axis": "{what} is {gap} too near to axis 1",
    "base": "{what} is {gap} too near to the base",
    "plane": "{what} is {gap} off the plane z = 0",
    "tilted": "the tool is tilted by {degrees:.1f}°, and a SCARA's tool stays upright",
    # a joint that exceeds its limit
    "past": "joint {joint} is at {value}, {over} past its limit of {limit}",
    # singularities
    "shoulder": "{what} is as near to axis 1 as it can be (shoulder singularity), where the front "
    "and back rows meet",
    "elbow": "the arm is stretched or folded (elbow singularity), where the two elbow rows "
    "coincide",
    "wrist": "axes 4 and 6 are in line (wrist singularity), so only the combined rotation of "
    "joints 4 and 6 is fixed",
}
