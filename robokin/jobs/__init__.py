"""Jobs: tasks for arms and their motors, and the programs that solve them.

Import the package of the job, for instance `from robokin.jobs.visit_collect import read_task`;
`python -m robokin.jobs FOLDER` solves task files. Everything is kinematics except the rotor in
`robokin.jobs.steppers`, where we integrate the torque.
"""
