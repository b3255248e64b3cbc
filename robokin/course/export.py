"""A notebook as one page that needs no network and no Python: its formulas are MathML, its code is
coloured, what is folded stays folded, players, explorers and predictions are alive.

nbconvert does the work; here stands what it does not do: formulas without a script from a network,
folded cells, links from page to page.
"""

import html
import re
from pathlib import Path
from typing import Any

import jinja2
import nbformat
from math_core import LatexError, LatexToMathML
from nbconvert.exporters import HTMLExporter
from nbconvert.filters.markdown_mistune import IPythonRenderer, MarkdownWithMath

from .._validate import short
from ..show.page import write_page

TEMPLATE = """\
{% extends 'lab/index.html.j2' %}
{% block html_head_js_requirejs %}{% endblock %}
{% block html_head_js_mathjax %}{% endblock %}
{% block html_head_js_mermaidjs %}{% endblock %}
{% block jupyter_widgets %}{% endblock %}
{% block body_header %}
{{ super() }}
<script>
{ const dark = matchMedia("(prefers-color-scheme: dark)"), body = document.body;
  const tell = () => { body.dataset.jpThemeLight = String(!dark.matches); };
  dark.addEventListener("change", tell);
  tell(); }
</script>
{% endblock %}
{% block html_head_css %}
<style>
@media screen and (prefers-color-scheme: dark) {
{% include 'static/theme-dark.css' %}
}
main { max-width: 1000px; margin: auto; }
details.rk-folded > summary { cursor: pointer; color: #5F6B76; font-size: 13px; margin: 4px 0; }
math { font-family: "Cambria Math", "STIX Two Math", "Latin Modern Math",
  "DejaVu Math TeX Gyre", math; }
math[display=block], p:has(> math) { overflow-x: auto; overflow-y: hidden; }
math[display=block] { padding: 2px 0; }
.jp-RenderedHTMLCommon table { display: block; overflow-x: auto; }
.jp-OutputArea-output { overflow-x: auto; }
@media (max-width: 700px) {
  .jp-InputPrompt, .jp-OutputPrompt { display: none; }
  body.jp-Notebook { padding: 4px; }
}
</style>
{% endblock %}
{% block input_group %}
{% if cell.metadata.get('jupyter', {}).get('source_hidden') %}
<details class="rk-folded"><summary>code</summary>{{ super() }}</details>
{% else %}{{ super() }}{% endif %}
{% endblock %}
"""


FORMULAS = LatexToMathML(fancy_error=False)


def mathml(tex: str, block: bool = False) -> str:
    """A formula in TeX as MathML. ValueError: a formula that cannot be read."""
    try:
        return str(FORMULAS.convert_with_local_state(tex.strip(), displaystyle=block))
    except LatexError as error:
        raise ValueError(f"formula {short(tex)}: {error}") from None


class Renderer(IPythonRenderer):
    """Markdown to HTML, formulas to MathML."""

    def inline_math(self, body: str) -> str:
        return mathml(html.unescape(body))

    def block_math(self, body: str) -> str:
        return mathml(html.unescape(body), block=True)

    def link(self, text: str, url: str, title: str | None = None) -> str:
        """Other notebooks are pages beside this one."""
        here = not re.match(r"[a-z]+:|#", url)
        url = re.sub(r"\.ipynb(?=#|$)", ".html", url) if here else url
        return str(super().link(text, url, title))


class Exporter(HTMLExporter):
    """nbconvert's page, without anything that it would fetch."""

    def default_filters(self) -> Any:
        yield from super().default_filters()
        yield ("markdown2html", _rendered)


@jinja2.pass_context
def _rendered(context: Any, source: str) -> str:
    cell = context.get("cell", {})
    renderer = Renderer(
        escape=False,
        attachments=cell.get("attachments", {}),
        embed_images=True,
        path=context.get("resources", {}).get("metadata", {}).get("path", ""),
        anchor_link_text="¶",
    )
    return str(MarkdownWithMath(renderer=renderer).render(source))


def page(notebook: Any, title: str, folder: Path) -> str:
    """The page of a notebook (nbformat's), as text. Pictures are looked for in `folder`."""
    resources = {"metadata": {"name": title, "path": str(folder)}}
    loader = jinja2.DictLoader({"robokin.html.j2": TEMPLATE})
    exporter = Exporter(template_file="robokin.html.j2", extra_loaders=[loader])
    made, _ = exporter.from_notebook_node(notebook, resources)
    return str(made)


def read(path: Path) -> Any:
    """The notebook at `path`, as nbformat has it. ValueError: it is none, or cannot be read."""
    try:
        notebook = nbformat.read(path, as_version=4)
        nbformat.validate(notebook)
    except OSError as error:
        raise ValueError(f"{error.strerror}") from None
    except Exception as error:  # JSON, Unicode and schema errors of several libraries
        reason = str(error).partition("\n")[0]
        raise ValueError(f"not a notebook: {reason}") from None
    return notebook


def export(path: Path, to: Path) -> None:
    """Write the notebook at `path` as the page `to`, wholly or not at all. ValueError: no notebook,
    a formula that cannot be read, a file in the way that is no page of ours.
    """
    write_page(to, page(read(path), path.stem, path.parent))
