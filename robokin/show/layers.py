"""The layers of a figure, from back to front, as values of Matplotlib's `zorder`."""

FLOOR = 0.0
SHADOW = 0.5
FACES = 0.6
BASE = 1.0  # also for balls and for lines down to the floor
BETWEEN = POINTS = 2.0  # postures between the first and the last one
FIRST, LAST = 4.0, 5.0  # the first and the last posture
PATH = 6.0
FRAMES = 7.0
ORIGINS = 8.0
LABELS = 9.0
