"""Stepper motors: the pulses of a move and their times, the windings that they switch on and off,
and whether the rotor follows them.

Example: the motors of the log loader (source 003, paper 1), from the points of a job to the pulses:

    arm = loader_arm(1.2, 1.0)
    q = station_postures(arm, points)        # (stations, 3); `out_of_reach` says why one is NaN
    n = counts(q, per_degree)                # (stations, 3) whole pulses: the motor positions
    move = synchronised(n[0], n[1])          # or unsynchronised, or straight
    q_t = joint_values(move(t), per_degree)  # joint values at the times t, to draw
    move.pulses()                            # for each motor: times and directions
    Stepper().run(times, signs).lost         # the number of steps that the rotor lost

The position of a motor is counted in pulses from the joint's zero. Whole pulses are computed from
these positions and never from the angle of a single move, so that rounding errors do not add up
over many moves. Source: 003, II.3 (the motors) and paper 1; errata S3-p to S3-t.
"""

from .moves import (
    LIMIT,
    Move,
    counts,
    frequencies,
    joint_values,
    out_of_reach,
    shortest_turn,
    station_postures,
    straight,
    synchronised,
    unsynchronised,
)
from .phase_table import COLUMNS, energised, phases
from .rotor import FASTEST, FINE, NEARLY, ROTORS, SETTLED, SLOWEST, RotorMotion, Stepper, ramp

__all__ = [
    "COLUMNS",
    "FASTEST",
    "FINE",
    "LIMIT",
    "NEARLY",
    "ROTORS",
    "SETTLED",
    "SLOWEST",
    "Move",
    "RotorMotion",
    "Stepper",
    "counts",
    "energised",
    "frequencies",
    "joint_values",
    "out_of_reach",
    "phases",
    "ramp",
    "shortest_turn",
    "station_postures",
    "straight",
    "synchronised",
    "unsynchronised",
]
