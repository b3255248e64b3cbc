"""Export a notebook as one page that needs no network and no Python: formulas are MathML, code is
highlighted, folded cells stay folded, and players, explorers and predictions work.

The page is harmless even if the notebook is hostile. Of each cell, we use only the text, the
number, and whether it is folded. Outputs of robokin are generated again (`ours.py`); all other
outputs are sanitised (`harmless.py`) or shown as text. Only scripts with the page's nonce run.
nbconvert provides the styles and the Markdown parser.
"""

import html
import re
import secrets
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import jinja2
import nbformat
from markupsafe import Markup
from math_core import LatexError, LatexToMathML
from nbconvert.exporters import HTMLExporter, TemplateExporter
from nbconvert.filters import Highlight2HTML, ansi2html
from nbconvert.filters.markdown_mistune import IPythonRenderer, MarkdownWithMath

from .._validate import short
from ..show.saving import write_page
from .harmless import (
    INLINE,
    clean,
    file_as_picture,
    image,
    is_deep,
    odd_in_math,
    shortened,
)
from .ours import again
from .texts import LINES, visible

FORMULAS = LatexToMathML(fancy_error=False)
TEX = 2_000  # maximum number of characters in a formula; the parser recurses at each brace
# Maximum number of characters to parse as Markdown, HTML or Python, per piece and per page: the
# libraries take up to 10 s per megabyte. Text beyond these limits is shown as it was typed.
PIECE, ROOM = 50_000, 150_000
MOST = 200  # maximum number of robokin outputs in a page
OPENERS = ("\\\\[", "\\\\(", "\\begin{")  # the parser searches for the end of each of these
TEXTS = ("text/latex", "text/plain")
LATEX = re.compile(r"\$\$([^$]+)\$\$|\$((?:[^$\\]|\\.)+)\$", re.S)  # $$ ... $$, $ ... $
IMAGES = ("image/svg+xml", "image/png", "image/jpeg", "image/gif", "image/webp")
FIRST = ("text/html", "text/markdown", "image/svg+xml", "text/latex", *IMAGES[1:], "text/plain")


def mathml(tex: str, block: bool = False) -> str:
    """Convert a TeX formula to MathML. Raises ValueError if the formula cannot be read."""
    tex = visible(tex.strip())
    if len(tex) > TEX:
        raise ValueError(f"formula {short(tex)}: wanted at most {TEX} characters, got {len(tex)}")
    try:
        made = str(FORMULAS.convert_with_local_state(tex, displaystyle=block))
    except LatexError as error:
        raise ValueError(f"formula {short(tex)}: {error}") from None
    if odd := odd_in_math(made):
        raise ValueError(f"formula {short(tex)}: {', '.join(odd)} is not allowed in a page")
    return made


def named(formula: str) -> str:
    """Give a formula that is a single letter an accessible name. Otherwise, a column heading with
    nothing else in it would have no name, since axe and some screen readers ignore text in MathML.
    """
    letter = re.fullmatch("<math><mi>(\\w)</mi></math>", formula)
    return f'<math aria-label="{letter[1]}"><mi>{letter[1]}</mi></math>' if letter else formula


class View:
    """The cells of a notebook as a page shows them.

    folder   the folder with its pictures
    choices  a dict that maps predictions to the choices shown when the page opens; None means the
             choices in the notebook
    lenient  if True, an unreadable formula is shown as it was typed and noted in `remarks`;
             otherwise it raises a ValueError
    """

    def __init__(
        self, folder: Path, choices: Mapping[str, str] | None = None, lenient: bool = False
    ) -> None:
        self.folder, self.choices, self.lenient = folder, choices, lenient
        self.nonce = secrets.token_hex(16)
        self.remarks: list[str] = []
        self._room = ROOM
        self._ours = 0  # number of robokin outputs so far
        self._highlight = Highlight2HTML(pygments_lexer="python")

    def cells(self, notebook: Any) -> list[dict[str, Any]]:
        """The data of each cell for the template."""
        return [self._cell(cell, k) for k, cell in enumerate(notebook.cells, 1)]

    def _cell(self, cell: Any, k: int) -> dict[str, Any]:
        if cell.cell_type == "code":
            return self._code(cell)
        if cell.cell_type == "markdown":
            return self._markdown_cell(cell, k)
        return {"kind": "markdown", "source": _as_typed(str(cell.source))}

    def _markdown_cell(self, cell: Any, k: int) -> dict[str, Any]:
        name = f"cell {k} of the file"
        source = self._markdown(cell.source, name, cell.get("attachments", {}))
        return {"kind": "markdown", "source": source}

    def _code(self, cell: Any) -> dict[str, Any]:
        count = cell.get("execution_count")
        folded = cell.metadata.get("jupyter", {})
        return {
            "kind": "code",
            "count": count if isinstance(count, int) else None,
            "folded": isinstance(folded, dict) and folded.get("source_hidden") is True,
            "source": self._python(cell.source),
            "outputs": [self._output(output) for output in cell.outputs],
        }

    def _affords(self, text: str) -> bool:
        """Return whether a piece of text may be parsed; if so, count its characters."""
        if len(text) > min(PIECE, self._room):
            return False
        self._room -= len(text)
        return True

    # --- Sources ----------------------------------------------------------------------------------

    def _python(self, source: str) -> Markup:
        text = visible(shortened(source))
        # the lexer takes quadratic time for consecutive empty lines
        if self._affords(text) and not re.search(r"\n(?:[ \t\f]{0,200}\n){50}", text):
            return Markup(self._highlight(text))
        return Markup('<div class="highlight"><pre>{}</pre></div>').format(text)

    def _markdown(self, source: str, name: str, attachments: Any = None) -> Markup:
        renderer = Renderer(self, name)
        pictures: dict[str, str] = {}

        def kept(found: re.Match[str]) -> str:
            pictures[f"{len(pictures)}"] = found[0]
            return f"attachment:{renderer.mark}{len(pictures) - 1}"

        text = visible(shortened(INLINE.sub(kept, source)))
        if self._affords(text) and sum(map(text.count, OPENERS)) <= 100:
            made = str(MarkdownWithMath(renderer=renderer).render(text))
            if self._affords(made) and not is_deep(made):
                pictures |= _attached(attachments)
                return self._cleaned(made, renderer, pictures)
        return _as_typed(source)

    def _cleaned(self, made: str, renderer: "Renderer", pictures: Mapping[str, str]) -> Markup:
        def picture(address: str) -> str | None:
            scheme, _, name = address.partition(":")
            if scheme == "attachment":
                return pictures.get(name.removeprefix(renderer.mark))
            if INLINE.fullmatch(address):
                return address
            return file_as_picture(address, self.folder)

        return Markup(renderer.filled(clean(made, picture, renderer.plain)))

    # --- Outputs ----------------------------------------------------------------------------------

    def _output(self, output: Any) -> dict[str, Any]:
        kind = output.output_type
        if kind == "stream":
            mime = "text/plain" if output.name == "stdout" else "application/vnd.jupyter.stderr"
            return _shown("RenderedText", mime, _coloured(output.text))
        if kind == "error":
            text = "\n".join(output.traceback) or f"{output.ename}: {output.evalue}"
            return _shown("RenderedText", "application/vnd.jupyter.stderr", _coloured(text))
        return self._data(output.data) | {"result": kind == "execute_result"}

    def _data(self, data: Mapping[str, Any]) -> dict[str, Any]:
        """The template data for the best representation of an output."""
        for mime in FIRST:
            text = data.get(mime)
            if not isinstance(text, str):
                continue
            if mime == "text/html":
                return _shown("RenderedHTMLCommon jp-RenderedHTML", mime, self._html(text))
            if mime == "text/markdown":
                made = self._markdown(text, "an output")
                return _shown("RenderedHTMLCommon jp-RenderedMarkdown", mime, made)
            if mime == "text/latex":
                return _shown("RenderedLatex", mime, self._latex(text))
            if mime == "text/plain":
                return _shown("RenderedText", mime, _coloured(text))
            try:
                kind = "RenderedSVG" if "svg" in mime else "RenderedImage"
                return _shown(kind, mime, image(mime, text, "a picture without a description"))
            except ValueError:
                continue
        names = ", ".join(shortened(visible(str(name)), 80) for name in list(data)[:5])
        return _shown("RenderedText", "text/plain", f"An output is left out here: {names}.")

    def _latex(self, text: str) -> Markup:
        """Convert text with formulas between dollar signs, as written by SymPy, or a single
        formula.
        """
        text = visible(shortened(text))
        if not self._affords(text) or text.count("$") > 100:
            return _as_typed(text)
        if "$" not in text:
            text = "$$" + text.strip().removeprefix("\\[").removesuffix("\\]") + "$$"
        renderer = Renderer(self, "an output")
        made, end = Markup(), 0
        for found in LATEX.finditer(text):
            made += text[end : found.start()]
            tex = found[1] or found[2]
            block = bool(found[1]) or tex.lstrip().startswith("\\displaystyle")  # by SymPy
            made += Markup(renderer.filled(renderer._formula(tex, "$$" if block else "$")))
            end = found.end()
        return made + text[end:]

    def _html(self, text: str) -> Markup:
        made = again(text, self.nonce, self.choices) if self._ours <= MOST else None
        if made is not None:
            self._ours += 1
            return made
        if not self._affords(text) or is_deep(text):
            return _as_typed(text)
        return self._cleaned(text, Renderer(self, "an output"), {})


class Renderer(IPythonRenderer):
    """Convert Markdown to HTML. The HTML will be sanitised, so formulas and highlighted code are
    stored separately and represented by marks that nobody can guess.
    """

    def __init__(self, view: View, name: str) -> None:
        super().__init__(escape=False, exclude_anchor_links=True)
        self.view, self.name = view, name
        self.mark = f"rk{secrets.token_hex(12)}x"
        self.kept: list[tuple[str, str]] = []  # (source as typed, HTML)

    def inline_math(self, body: str) -> str:
        return self._formula(body, "$")

    def block_math(self, body: str) -> str:
        return self._formula(body, "$$")

    def block_code(self, code: str, info: str | None = None) -> str:
        made = super().block_code(code, info) if info and not info.startswith("mermaid") else ""
        if not made.startswith('<div class="highlight">'):  # an unknown language
            made = str(Markup("<pre><code>{}</code></pre>").format(code))
        return f"<div>{self._keep(code, made)}</div>\n"

    def heading(self, text: str, level: int, **attrs: Any) -> str:
        """Render a heading with JupyterLab's anchor."""
        words = re.sub("<[^>]*>", "", html.unescape(self.plain(text))).strip()
        return f'<h{level} id="{html.escape(words.replace(" ", "-"))}">{text}</h{level}>\n'

    def table_cell(self, text: str, align: str | None = None, head: bool = False) -> str:
        tag = "th" if head and text else "td"  # an empty corner cell is not a header
        if head and (formula := re.fullmatch(f"{self.mark}(\\d+)x", text)):
            typed, made = self.kept[int(formula[1])]
            self.kept[int(formula[1])] = typed, named(made)
        style = f' style="text-align: {align}"' if align else ""
        return f"<{tag}{style}>{text}</{tag}>\n"

    def block_html(self, html: str) -> str:
        return f"{html}\n"

    def inline_html(self, html: str) -> str:
        return html

    def image(self, text: str, url: str, title: str | None = None) -> str:
        return str(Markup('<img alt="{}" src="{}">').format(text, url))

    def plain(self, text: str) -> str:
        """Replace the marks with the text as it was typed."""
        return re.sub(f"{self.mark}(\\d+)x", lambda place: self.kept[int(place[1])][0], text)

    def filled(self, text: str) -> str:
        """Replace the marks with HTML."""
        return re.sub(f"{self.mark}(\\d+)x", lambda place: self.kept[int(place[1])][1], text)

    def _formula(self, body: str, dollars: str) -> str:
        tex = html.unescape(body)
        typed = f"{dollars}{tex}{dollars}"
        try:
            return self._keep(typed, mathml(tex, block=dollars == "$$"))
        except ValueError as error:
            if not self.view.lenient:
                raise
            if len(self.view.remarks) < 20:
                self.view.remarks.append(
                    f"{self.name}: a formula is shown as it was typed: {error}."
                )
            return self._keep(typed, str(Markup("<code>{}</code>").format(typed)))

    def _keep(self, typed: str, made: str) -> str:
        self.kept.append((typed, made))
        return f"{self.mark}{len(self.kept) - 1}x"


def _shown(kind: str, mime: str, made: str) -> dict[str, Any]:
    return {"kind": kind, "mime": mime, "html": made, "result": False}


def _as_typed(text: str) -> Markup:
    return Markup("<pre>{}</pre>").format(visible(shortened(text)))


def _coloured(text: str) -> Markup:
    """Render terminal text with its colours."""
    made = ansi2html(visible(shortened(text), LINES + "\x1b"))
    return Markup(made.replace("\x1b", "\\x1b"))


def _attached(attachments: Any) -> Iterator[tuple[str, str]]:
    """Yield (name, `data:` address) for each picture attached to a cell."""
    for name, kinds in attachments.items() if isinstance(attachments, dict) else ():
        for kind, data in kinds.items() if isinstance(kinds, dict) else ():
            address = f"data:{kind};base64,{''.join(str(data).split())}"
            if INLINE.fullmatch(address):
                yield name, address


class Exporter(HTMLExporter):
    """nbconvert's HTML exporter, with our cells."""

    def from_notebook_node(self, nb: Any, resources: Any = None, **kw: Any) -> Any:
        """As in HTMLExporter, but without parsing the resulting page."""
        for name in ("highlight_code", "filter_data_type"):  # replaces filters of HTMLExporter
            self.register_filter(name, lambda value: value)
        return TemplateExporter.from_notebook_node(self, nb, resources, **kw)


def page(cells: list[dict[str, Any]], title: str, nonce: str, header: str = "") -> str:
    """Return the page of a notebook's cells as text; `header` is the HTML above them."""
    resources = {
        "metadata": {"name": visible(title)},
        "nonce": nonce,
        "cells": cells,
        "header": header,
    }
    loader = jinja2.PackageLoader("robokin.course", "templates")
    exporter = Exporter(template_file="notebook.html.j2", extra_loaders=[loader])
    made, _ = exporter.from_notebook_node(nbformat.v4.new_notebook(), resources)
    return str(made)


def read(path: Path) -> Any:
    """Read the notebook at `path` with nbformat. Raises ValueError if it is not a notebook or
    cannot be read.
    """
    try:
        notebook = nbformat.read(path, as_version=4)
        nbformat.validate(notebook, relax_add_props=True)  # older notebooks may have cell ids, too
    except OSError as error:
        raise ValueError(f"{error.strerror}") from None
    except AttributeError:  # raised by nbformat if the JSON is a list or a number
        raise ValueError("not a notebook: its JSON is not an object") from None
    except Exception as error:  # JSON, Unicode and schema errors from several libraries
        lines = [line for line in visible(str(error)[:2000]).splitlines() if line.strip()]
        reason = lines[0][:300] if lines else type(error).__name__
        raise ValueError(f"not a notebook: {reason}") from None
    return notebook


def export(path: Path, to: Path) -> None:
    """Write the notebook at `path` as the page `to`, atomically. Raises ValueError if it is not a
    notebook, a formula cannot be read, or `to` is an existing file that is not one of our pages.
    """
    view = View(path.parent)
    write_page(to, page(view.cells(read(path)), path.stem, view.nonce))
