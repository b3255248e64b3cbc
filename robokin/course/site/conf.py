"""The configuration of Sphinx; `build` in __init__.py arranges its input and runs it.

Outputs are the stored ones, formulas become MathML as in exported pages, and docstrings are plain
text.
"""

import json
import re
from pathlib import Path, PurePosixPath
from typing import Any

from docutils import nodes
from sphinx.util import logging

import robokin.course
from robokin.course.book import find
from robokin.course.export import mathml, named
from robokin.course.ours import quiet
from robokin.show.palette import PAGE

project = html_title = "robokin labs"
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.githubpages"]
templates_path = ["templates"]

nb_execution_mode = "off"
nb_merge_streams = True
nb_ipywidgets_js: dict[str, Any] = {}  # empty, since it would be loaded from the network
nb_code_prompt_show = nb_code_prompt_hide = "code"
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 3
myst_heading_slug_func = "robokin.course.site.anchor"
myst_update_mathjax = False
html_math_renderer = "mathml"

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # shapes, units and frames are in the docstrings
autodoc_default_options = {"members": True}
add_module_names = False

html_theme = "furo"
LINKS = ("color-brand-primary", "color-brand-content", "color-brand-visited")
html_theme_options = {
    "top_of_page_buttons": [],
    "light_css_variables": dict.fromkeys(LINKS, PAGE["accent"][0]),
    "dark_css_variables": dict.fromkeys(LINKS, PAGE["accent"][1]),
}
SHARED = PurePosixPath(robokin.course.__file__).parent / "templates"  # also used by exported pages
html_static_path = ["static", f"{SHARED}/narrow.css", f"{SHARED}/narrow.js"]
html_css_files = ["narrow.css", "site.css", "cells.css"]
html_js_files = ["site.js"]
html_favicon = "static/arm.svg"
html_copy_source = html_show_sourcelink = html_show_copyright = False
html_use_index = html_domain_indices = False

LAB = re.compile(r"\d\d_\w+")
SIZES = "sizes.json"  # next to this file: the sizes of the files in python/, by `build`


def setup(app: Any) -> dict[str, bool]:
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    app.connect("source-read", _in_other_words)
    app.connect("source-read", _own_name)
    app.connect("doctree-read", _numbered)
    app.connect("doctree-resolved", _to_the_section)
    app.connect("doctree-resolved", _foldable)
    app.connect("doctree-resolved", _findable)
    app.connect("html-page-context", _runnable)
    app.connect("autodoc-skip-member", _not_ours)
    app.connect("autodoc-process-docstring", _as_it_is)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


# --- Formulas -------------------------------------------------------------------------------------


def _inline(translator: Any, node: nodes.Element) -> None:
    _formula(translator, node, block=False)


def _block(translator: Any, node: nodes.Element) -> None:
    _formula(translator, node, block=True)


def _formula(translator: Any, node: nodes.Element, block: bool) -> None:
    try:
        made = mathml(node.astext(), block)
        in_head = isinstance(node.parent.parent, nodes.entry) and len(node.parent) == 1
        translator.body.append(named(made) if in_head else made)
    except ValueError as error:
        logging.getLogger(__name__).warning(str(error), location=node)
    raise nodes.SkipNode


# --- Words of a notebook that are different on the site -------------------------------------------

# A line or program, and the comment below it with its words on the site (removed if there are none)
OTHER_WORDS = re.compile(
    r"^(?:```\w*\n(?:(?!```).*\n)*```|.*)\n *<!-- on the site:(.*?)-->(\n|\Z)", re.M
)


def _in_other_words(app: Any, docname: str, source: list[str]) -> None:
    if not str(app.env.doc2path(docname)).endswith(".ipynb"):
        return
    notebook = json.loads(source[0])
    for cell in notebook["cells"]:
        if cell["cell_type"] == "markdown":
            cell["source"] = OTHER_WORDS.sub(_replaced, "".join(cell["source"]))
        elif _kind("".join(cell["source"]))["reports"]:
            cell["outputs"] = []  # they say what to do in JupyterLab
    source[0] = json.dumps(notebook, ensure_ascii=False)


def _replaced(found: re.Match[str]) -> str:
    words = found[1].strip()
    return words + found[2] if words else ""


# --- Links to sections: "[02 §3](02_irb140_kinematics.ipynb)" -------------------------------------


def _own_name(app: Any, docname: str, source: list[str]) -> None:
    """Adapt a notebook to the site. A companion refers to itself as #. Links to our source become
    links to the reference. Sentences on how to start a view in JupyterLab are removed.
    """
    source[0] = quiet(source[0])
    source[0] = source[0].replace("](#)", f"]({PurePosixPath(docname).name}.ipynb)")
    up = "../" * docname.count("/")
    source[0] = re.sub(
        r"\]\((?:\.\./)+(robokin(?:/\w+){1,2})(?:/\w+)?\.py\)",  # link to the job's package
        lambda link: f"]({up}api/{link[1].replace('/', '.')}.rst)",
        source[0],
    )


def _numbered(app: Any, doctree: nodes.document) -> None:
    for section in doctree.findall(nodes.section):
        number = re.match(r"(\d+)\. ", section[0].astext())
        if number and section.parent is not doctree:
            section["ids"].append(f"section-{number[1]}")


def _to_the_section(app: Any, doctree: nodes.document, docname: str) -> None:
    for link in doctree.findall(nodes.reference):
        number = re.search(r"§(\d+)$", link.astext())
        if number and re.search(r"\.html$|^$", link.get("refuri", "no")):
            link["refuri"] += f"#section-{number[1]}"


# --- Code that a narrow screen folds (narrow.js), as in exported pages ----------------------------


def _foldable(app: Any, doctree: nodes.document, docname: str) -> None:
    for code in list(doctree.findall(nodes.container)):
        hidden = not isinstance(code.parent, nodes.container)  # myst-nb puts it into `details`
        if code.get("nb_element") == "cell_code_source" and not hidden:
            opened = nodes.raw("", OPENED, format="html")
            closed = nodes.raw("", "</details>", format="html")
            code.parent.replace(code, [opened, code, closed])


OPENED = '<details class="rk-code" open><summary>code</summary>'


# --- Cells that run in the page (lab.js) ----------------------------------------------------------


def _findable(app: Any, doctree: nodes.document, docname: str) -> None:
    for cell in doctree.findall(nodes.container):
        if LAB.fullmatch(docname) and cell.get("nb_element") == "cell_code":
            cell["ids"].append(_place(cell["cell_index"]))


def _place(k: int) -> str:
    return f"code-{k}"


def _runnable(app: Any, pagename: str, template: str, context: Any, doctree: Any) -> None:
    """Write the code cells of a lab and the sizes of Python's files into its page."""
    if not LAB.fullmatch(pagename):
        return
    notebook = Path(app.env.doc2path(pagename))
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    code = [
        {"place": _place(k), "id": cell["id"], "source": source, **_kind(source)}
        for k, cell in enumerate(cells)
        if cell["cell_type"] == "code" and (source := "".join(cell["source"]))
    ]
    made = json.loads(Path(app.srcdir, SIZES).read_text(encoding="utf-8"))
    sympy = any("sympy" in cell["source"] for cell in code)
    parts: dict[str, list[Any]] = {"python": [], "sympy": []}
    for name, size in made["sizes"].items():
        kind = "sympy" if name.startswith("sympy") else "python"
        if name.endswith(".gz") and (kind == "python" or sympy):
            parts[kind].append({"name": name, "size": size})
    lab = {"file": notebook.name, "version": made["version"], "cells": code} | parts
    context["lab"] = json.dumps(lab).replace("<", "\\u003c")


def _kind(source: str) -> dict[str, Any]:
    """What a page has to know of a cell that asks, reports or checks. The help for an exercise is
    its hints and then its solution, as text, so that the page shows them without Python.
    """
    called = re.search(r"""^(predict|report|check)\((?:["']([\w.]+)["'])?""", source, re.M)
    call, name = called.groups() if called else ("", None)
    helps: list[str] = []
    if call == "check" and name:
        hints = range(1, 1 + len(find(name, "exercises").hints))
        helps = [str(robokin.course.hint(name, n)) for n in hints]
        helps.append(str(robokin.course.solution(name)))
    return {"asks": call == "predict", "reports": call == "report", "helps": helps}


# --- Docstrings -----------------------------------------------------------------------------------

ENTRY = re.compile(r"(\S+(?: \S+)*) {2,}(\S.*)")  # a name, two or more spaces, its meaning


def _not_ours(app: Any, what: str, name: str, thing: Any, skip: bool, options: Any) -> bool | None:
    """Skip members that a class inherits from a library or a tuple."""
    home = getattr(thing, "__module__", None) or "robokin"
    foreign = isinstance(home, str) and not home.startswith("robokin")
    return True if foreign or str(thing.__doc__).startswith("Alias for field") else None


def _as_it_is(app: Any, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """Convert a docstring to reST: paragraphs of text, lists of names, and the rest (examples)
    unchanged.
    """
    made: list[str] = []
    for block in re.split(r"\n\s*\n", "\n".join(lines).strip()):
        if entries := _entries(block):
            for entry, meaning in entries:
                made += [f"``{entry}``", f"    {_words(meaning)}"]
        elif re.search(r"^ |^>>>|\S {2,}\S", block, re.M):
            made += [".. code-block:: none", "", *("    " + line for line in block.splitlines())]
        else:
            made.append(_words(block))
        made.append("")
    lines[:] = made


def _entries(block: str) -> list[tuple[str, str]]:
    """Return the names and meanings if a block is a list of them, otherwise an empty list. A single
    regular expression would take hours for a block that is almost such a list.
    """
    found: list[tuple[str, str]] = []
    for line in block.splitlines():
        entry = ENTRY.fullmatch(line)
        if entry:
            found.append((entry[1], entry[2]))
        elif found and line.startswith("  "):
            found[-1] = (found[-1][0], f"{found[-1][1]}\n{line}")
        else:
            return []
    return found


def _words(text: str) -> str:
    """Convert plain text to reST without markup, except that text between backticks is code."""
    pieces = re.split("``?([^`]+)``?", " ".join(text.split()))
    pieces[::2] = (re.sub(r"([^\w\s])", r"\\\1", words) for words in pieces[::2])
    pieces[1::2] = (rf"\ ``{code}``\ " for code in pieces[1::2])
    return "".join(pieces)
