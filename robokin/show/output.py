"""A piece of a page that is animated by a script in the browser."""

import hashlib
import os
import re
from typing import Any

from .._validate import instance, short
from . import plots
from .drawing import DRAWS
from .markup import inert, output, still_image
from .saving import save


class Output:
    """A piece of a page that is animated by a script in the browser. It displays itself in a
    notebook; `save` writes it as a page.

    data    the data of the page, which JSON can represent
    still   the figure that is shown until the script runs, in print, and in an untrusted
            notebook
    call    the module in js/ and its function that shows the piece, such as "player.play"
    """

    call = "player.play"

    def __init__(self, data: Any, still: plots.Figure) -> None:
        if not isinstance(data, dict):
            raise ValueError(f"data: wanted a dict, got {short(data)}")
        self.data, self.still = data, instance(still, plots.Figure, "still")
        self.text = inert(data)
        # The name is a hash of the data and not of the picture, because another version of zlib may
        # compress the same pixels to different bytes. Floats are rounded, because their last bits
        # depend on the processor.
        agreed = re.sub(r"-?\d+\.\d{10,}(e-?\d+)?", lambda x: f"{float(x[0]):.9f}", self.text)
        self.id = hashlib.sha256(agreed.encode()).hexdigest()[:12]

    @property
    def html(self) -> str:
        """The HTML of the player: the still picture, and the script that replaces it."""
        return self._in_page()

    def _in_page(self, nonce: str = "") -> str:
        """Return the HTML for a page whose security policy permits only scripts with this nonce."""
        still = still_image(plots.palette_png(self.still), self.data["alt"]) if DRAWS else ""
        return output(self.call, self.id, self.text, still, nonce)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write one self-contained page, completely or not at all. Raises ValueError if the name
        does not end in .html, or if the file exists and is not a saved player.
        """
        save(path, self.data["title"], self.html)

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        return {"text/html": self.html, "text/plain": repr(self)}

    def __repr__(self) -> str:
        return str(self.data["summary"])
