"""Views that open after the guess, for the predictions of this lab."""

from typing import Any

from robokin import IRB140
from robokin.show import joint_explorer

from .predictions import ANGLE, turned


def p1_view() -> Any:
    return joint_explorer(IRB140, turned(-ANGLE))
