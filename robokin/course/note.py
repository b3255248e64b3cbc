"""Text that a call shows below its cell."""

import html
from urllib.parse import quote


class Note(str):
    """A string that a notebook displays without quotes. `file` is the name of a file next to the
    notebook; where this name occurs in the text, it becomes a link.
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
