"""Units: multiply by one to come in, divide by it to go out.

Inside robokin a length is in metres and an angle in radians. A lesson writes ``352 * mm`` and ``90
* deg``.
"""

from math import pi

mm = 1e-3
deg = pi / 180
