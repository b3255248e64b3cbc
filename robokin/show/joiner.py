"""Join modules of the folder js into one script and one style sheet, because an output cannot
import files.
"""

import base64
import hashlib
import json
import re
import zlib
from collections.abc import Iterator
from functools import cache
from importlib.resources import files

from .._validate import short
from .palette import css

IMPORT = re.compile(r'import\s*\{\s*([\w$]+(?:,\s*[\w$]+)*),?\s*\}\s*from\s*"\./(\w+)\.js";')
EXPORT = re.compile(r"export\s+((?:async\s+)?function|const|class)\s+([\w$]+)")

BLANK = re.compile(r"(?:\s|//.*|/\*[\s\S]*?\*/)+")
# a part of a template literal, up to its end or the next ${
TEMPLATE = re.compile(r"[`}](?:[^`\\$]|\\[\s\S]|\$(?!\{))*(?:`|\$\{)")
REGULAR = re.compile(r"/(?![*/])(?:[^/\\\[\n]|\\.|\[(?:[^\]\\\n]|\\.)*\])+/\w*")
OTHER = re.compile(r"""[\w$]+|"(?:[^"\\\n]|\\[\s\S])*"|'(?:[^'\\\n]|\\[\s\S])*'|(?!/\*)[^"'`]""")
VALUE = re.compile(r"""[\w$)\]}"'`]""")  # a slash after one of these is a division
NO_VALUES = {"return", "typeof", "case", "in", "delete", "void", "throw", "else", "do", "await"}
CSS_BLANK = re.compile(r"\s*(?:/\*[\s\S]*?\*/\s*)+|\s+")
CSS_SIGN = re.compile(r" ?([{};,>]) ?|(?<=[\w-])(:) ")  # spaces next to these signs have no meaning
CSS_LINE = re.compile(r"(.{160,}?[{};])(?!\})")
NEEDS_BLANK = re.compile(r"[\w$]{2}|[-+/<!]{2}|\d\.")  # without a space the two tokens would merge


@cache  # since a lab has about twenty outputs, but only a few different scripts
def script(name: str) -> str:
    """Return the module `name` of the folder js and all its imports as one script, in which `$name`
    holds the exports of the module. Each module occurs once, in its own scope. `call` in
    `output.Output` and `explorer.Explorer` names the module of an output. Comments and unnecessary
    whitespace are removed. The lines are long, because every additional line costs ten bytes in a
    notebook. A line ends only after `;`, `,` or a brace, so every statement of a module must end
    with `;` or a brace.

    Raises ValueError if an import or an export has a form other than `import {a, b} from "./x.js";`
    and `export function`, `const` or `class`, or if a comment or a literal is not closed.
    """
    return "\n".join(_modules(name).values())


@cache
def compressed(name: str) -> tuple[str, str]:
    """Return the script of the module `name` in the form that `loader.js` reads: its key, which is
    a hash of its text, and the script itself, compressed with zlib and encoded in base64. The
    script adds the palette and the style sheets of `name` to the page and returns the exports of
    the module.
    """
    sheet = json.dumps(css() + style(name), ensure_ascii=False)
    text = (
        'const sheet = document.createElement("style");\n'
        f"sheet.textContent = {sheet};\ndocument.head.append(sheet);\n"
        f"{script(name)}\nreturn ${name};"
    ).encode()
    # The key is a hash of the text, because another version of zlib may compress the same text to
    # different bytes.
    return hashlib.sha256(text).hexdigest()[:12], base64.b64encode(zlib.compress(text, 9)).decode()


@cache
def style(name: str) -> str:
    """Return the style sheets x.css of all modules x in `script(name)`, in the same order, so that
    the sheet of a module follows those of its imports. Comments and unnecessary whitespace are
    removed.
    """
    sheets = [files(__package__).joinpath("js", f"{module}.css") for module in _modules(name)]
    text = "\n".join(sheet.read_text(encoding="utf-8") for sheet in sheets if sheet.is_file())
    text = CSS_SIGN.sub(r"\1\2", CSS_BLANK.sub(" ", text)).replace(";}", "}").strip()
    return CSS_LINE.sub(r"\1\n", text)


def _modules(name: str) -> dict[str, str]:
    """Return the scripts of all modules that `name` needs; its own script comes last."""
    modules: dict[str, str] = {}
    _add(modules, name, (), f"{name}.js")
    return modules


def _add(modules: dict[str, str], name: str, importers: tuple[str, ...], place: str) -> None:
    """Add the script of `name` to `modules`, after the scripts of its imports."""
    file = files(__package__).joinpath("js", f"{name}.js")
    if name in importers or not file.is_file():
        raise ValueError(f"{place}: there is no module {name}.js, or it imports itself")
    text = file.read_text(encoding="utf-8")
    exports: list[str] = []
    pieces: list[tuple[str, str]] = []  # each token, and the whitespace before it
    before, end = ";", 0
    for token, at in _tokens(text, name):
        if at < end:  # part of an import
            continue
        begins = before in (";", "}")
        if begins and token == "export":
            found = EXPORT.match(text, at)
            if not found:
                wrong = short(text[at:].splitlines()[0])
                place = _place(text, at, name)
                raise ValueError(f"{place}: wanted an export of one name, got {wrong}")
            exports.append(found[2])
            continue
        gap, end = text[end:at], at + len(token)
        if begins and token == "import":
            found = IMPORT.match(text, at)
            if not found:
                wrong, ends, _ = text[at:].partition(";")
                if not ends:
                    raise ValueError(f"{_place(text, len(text), name)}: an import has no semicolon")
                wrong, place = short(" ".join(wrong.split())), _place(text, at, name)
                raise ValueError(f"{place}: wanted an import of names, got {wrong}")
            if found[2] not in modules:
                _add(modules, found[2], (*importers, name), _place(text, at, name))
            token, end = f"const{{{''.join(found[1].split())}}}=${found[2]};", found.end()
        pieces.append((token, gap))
        before = token[-1]
    names = ",".join(exports)
    modules[name] = f"const ${name} = (() => {{\n{_laid(pieces)}\nreturn{{{names}}};}})();"


def _laid(pieces: list[tuple[str, str]]) -> str:
    """Lay out tokens in lines: a top-level statement begins a new line, and inner statements share
    long lines. A comma that Prettier puts after the last item of a list is left out.
    """
    lines, before, depth = [""], "", 0
    for token, gap in pieces:
        if "\n" in gap and token[0] in ")]}" and re.search(r"[^,[],$", lines[-1]):
            lines[-1] = lines[-1][:-1]  # a comma after the last item
        begins = "\n" in gap and before in (";", "{", "}") and token != "}"  # a new statement
        width = len(lines[-1])
        if begins and (not depth or width > 100) or width > 200 and before in (";", "{", ","):
            lines.append("")
        elif gap and NEEDS_BLANK.match(before + token[0]):
            lines[-1] += " "
        lines[-1] += token
        before = token[-1]
        depth += (before in "([{") - (token[0] in ")]}")
    return "\n".join(lines)


def _tokens(text: str, name: str) -> Iterator[tuple[str, int]]:
    """Yield words, symbols and literals with their positions, but no comments or whitespace. Each
    part of a template literal between expressions is one token, with its quotes or braces.
    """
    at, before = 0, ""
    braces: list[str] = []  # the open braces: "{", or "${" in a template
    while at < len(text):
        blank = BLANK.match(text, at)
        if blank:
            at = blank.end()
            continue
        if text[at] == "`" or text[at] == "}" and braces[-1:] == ["${"]:
            form = TEMPLATE
        elif text[at] == "/" and (not VALUE.search(before[-1:]) or before in NO_VALUES):
            form = REGULAR
        else:
            form = OTHER
        found = form.match(text, at)
        if not found:
            wrong = short(text[at:].splitlines()[0])
            raise ValueError(
                f"{_place(text, at, name)}: a comment or a literal is not closed: {wrong}"
            )
        before = found[0]
        yield before, at
        at = found.end()
        if before[0] == "}":
            del braces[-1:]
        if before[-1] == "{":
            braces.append(before[-2:])
    if braces:
        raise ValueError(f"{_place(text, at, name)}: a brace is not closed")


def _place(text: str, at: int, name: str) -> str:
    return f"{name}.js, line {len(text[: at + 1].splitlines())}"
