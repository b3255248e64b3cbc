"""Code that exercises and predictions of this lab share."""

import numpy as np

from robokin.jobs.steppers import Stepper

PULSES = 48
ONES = np.ones(PULSES)
MOTOR = Stepper(torque=0.02, inertia=1e-6, damping=6e-5, rise=0)  # the motor of the lab
