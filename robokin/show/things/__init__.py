"""The things in a scene besides arms: one module and one script (js/) for each kind.

CONTRIBUTING.md describes how to add a kind.
"""

from typing import TypeAlias

from .faces import Faces, PageFaces
from .mark import Mark, PageMark
from .target import PageTarget, Target
from .thing import Thing
from .zone import PageZone, Zone

__all__ = ["Faces", "Mark", "PageThing", "Target", "Thing", "Zone"]

# The kinds, in the order in which a page draws them.
PageThing: TypeAlias = PageFaces | PageZone | PageMark | PageTarget
