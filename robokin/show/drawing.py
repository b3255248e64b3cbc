"""What we use of Matplotlib and Pillow. In a web page there is no Matplotlib: then the same names
are blank. A blank takes any call and draws nothing, so a figure has only its alternative text, and
players and explorers have no still picture.
"""

from typing import TYPE_CHECKING, Any

import numpy as np

try:
    from matplotlib import rc_context as rc_context
    from matplotlib.axes import Axes as Axes
    from matplotlib.backends.backend_agg import FigureCanvasAgg as FigureCanvasAgg
    from matplotlib.collections import LineCollection as LineCollection
    from matplotlib.collections import PolyCollection as PolyCollection
    from matplotlib.figure import Figure as Figure
    from matplotlib.lines import Line2D as Line2D
    from matplotlib.patches import Circle as Circle
    from matplotlib.patches import Polygon as Polygon
    from matplotlib.patches import Wedge as Wedge
    from matplotlib.rcsetup import cycler as cycler
    from matplotlib.text import Text as Text
    from matplotlib.ticker import MaxNLocator as MaxNLocator
    from matplotlib.transforms import offset_copy as offset_copy
    from PIL import Image as Image

    DRAWS = True
except ModuleNotFoundError:
    DRAWS = False

MISSING = (
    "robokin.show: there is no Matplotlib; to install it, run pip install '.[show]' at the top of "
    "a clone of robokin"
)
STORED = "The picture of the stored run: your numbers are not in it."


def require() -> None:
    """Raise ImportError if there is no Matplotlib."""
    if not DRAWS:
        raise ImportError(MISSING, name="matplotlib")


class Blank:
    """Takes any call and draws nothing."""

    def __init__(self, *args: Any, **keywords: Any) -> None:
        pass

    def __call__(self, *args: Any, **keywords: Any) -> "Blank":
        return Blank()

    def __getattr__(self, name: str) -> "Blank":
        if name.startswith("_"):
            raise AttributeError(name)
        return Blank()

    def __getitem__(self, key: Any) -> "Blank":
        return Blank()

    def __enter__(self) -> "Blank":
        return self

    def __exit__(self, *args: Any) -> None:
        pass


class BlankFigure(Blank):
    """A figure without a picture."""

    def subplots(
        self, rows: int = 1, columns: int = 1, squeeze: bool = True, **keywords: Any
    ) -> Any:
        """Return one plot or an array of plots."""
        plots = np.full((rows, columns), Blank(), dtype=object)
        if not squeeze:
            return plots
        return plots[0, 0] if plots.size == 1 else plots.squeeze()

    def add_subplot(self, *args: Any, **keywords: Any) -> Blank:
        """Return a plot."""
        return Blank()

    def suptitle(self, *args: Any, **keywords: Any) -> Blank:
        """Write nothing."""
        return Blank()

    def get_figwidth(self) -> float:
        """Return a width in inches."""
        return 9.0

    def savefig(self, *args: Any, **keywords: Any) -> None:
        """Raise ImportError."""
        require()


if not DRAWS and not TYPE_CHECKING:
    Figure, rc_context, cycler = BlankFigure, Blank, Blank
    Axes = FigureCanvasAgg = LineCollection = PolyCollection = Line2D = Circle = Blank
    Polygon = Text = MaxNLocator = Wedge = offset_copy = Image = Blank
