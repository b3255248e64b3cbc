"""Text that a call shows below its cell."""

import html
from urllib.parse import quote


class Note(str):
    """A string that displays itself without quotes. `file` is a file next to the notebook; its name
    in the text becomes a link to it.
    """

    file = ""

    def __repr__(self) -> str:
        return str(self)

    def _repr_html_(self) -> str | None:
        if not self.file:
            return None
        name = html.escape(self.file)
        link = f'<a href="{html.escape(quote(self.file))}" target="_blank">{name}</a>'
        return "<br>".join(html.escape(self).replace(name, link, 1).split("\n"))
