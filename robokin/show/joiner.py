"""One script and one style sheet from modules of the folder js: an output has no files beside it to
import from.
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

IMPORT = re.compile(r'import\s*\{\s*([\w$]+(?:,\s*[\w$]+)*),?\s*\}\s*from\s*"\./(\w+)\.js";')
EXPORT = re.compile(r"export\s+((?:async\s+)?function|const|class)\s+([\w$]+)")

BLANK = re.compile(r"(?:\s|//.*|/\*[\s\S]*?\*/)+")
TEMPLATE = re.compile(r"[`}](?:[^`\\$]|\\[\s\S]|\$(?!\{))*(?:`|\$\{)")  # to its end or its next ${
REGULAR = re.compile(r"/(?![*/])(?:[^/\\\[\n]|\\.|\[(?:[^\]\\\n]|\\.)*\])+/\w*")
OTHER = re.compile(r"""[\w$]+|"(?:[^"\\\n]|\\[\s\S])*"|'(?:[^'\\\n]|\\[\s\S])*'|(?!/\*)[^"'`]""")
VALUE = re.compile(r"""[\w$)\]}"'`]""")  # what ends in it is divided by a slash that follows
NO_VALUES = {"return", "typeof", "case", "in", "delete", "void", "throw", "else", "do", "await"}
CSS_BLANK = re.compile(r"\s*(?:/\*[\s\S]*?\*/\s*)+|\s+")
CSS_SIGN = re.compile(r" ?([{};,>]) ?|(?<=[\w-])(:) ")  # blanks beside it mean nothing
CSS_LINE = re.compile(r"(.{160,}?[{};])(?!\})")
NEEDS_BLANK = re.compile(r"[\w$]{2}|[-+/<!]{2}|\d\.")  # else two tokens would become another one


@cache  # a lab has twenty outputs
def script(name: str) -> str:
    """The module `name` of the folder js and all that it imports, each once and in its own scope,
    as one script: `$name` holds what it exports. An output's is `call` of `player.Output` and
    `explorer.Explorer`. Without comments, which only people read, without blanks that code does
    not need, and in few lines: in a notebook each costs ten bytes more. A line ends behind `;`,
    `,` or a brace only, so every statement of a module has to end with `;` or a brace.

    ValueError: an import or an export of another form than `import {a, b} from "./x.js";` and
    `export function`, `const` or `class`; a comment or a literal that does not end.
    """
    return "\n".join(_modules(name).values())


@cache
def compressed(name: str) -> tuple[str, str]:
    """The script of the module `name` as `loader.js` takes it: its key, a hash of its text, and the
    script itself, compressed by zlib, in base64. The script adds the style sheets of `name` to
    the page and returns what the module exports.
    """
    sheet = json.dumps(style(name), ensure_ascii=False)
    text = (
        'const sheet = document.createElement("style");\n'
        f"sheet.textContent = {sheet};\ndocument.head.append(sheet);\n"
        f"{script(name)}\nreturn ${name};"
    ).encode()
    # A hash of the text: another zlib compresses the same text to other bytes.
    return hashlib.sha256(text).hexdigest()[:12], base64.b64encode(zlib.compress(text, 9)).decode()


@cache
def style(name: str) -> str:
    """The style sheets x.css of all modules x of `script(name)`, in the same order: the sheet of a
    module follows those of what it imports. Without comments and blanks that it does not need.
    """
    sheets = [files(__package__).joinpath("js", f"{module}.css") for module in _modules(name)]
    text = "\n".join(sheet.read_text(encoding="utf-8") for sheet in sheets if sheet.is_file())
    text = CSS_SIGN.sub(r"\1\2", CSS_BLANK.sub(" ", text)).replace(";}", "}").strip()
    return CSS_LINE.sub(r"\1\n", text)


def _modules(name: str) -> dict[str, str]:
    """The script of each module that `name` needs, itself the last."""
    modules: dict[str, str] = {}
    _add(modules, name, (), f"{name}.js")
    return modules


def _add(modules: dict[str, str], name: str, importers: tuple[str, ...], place: str) -> None:
    """Put `name` behind what it imports."""
    file = files(__package__).joinpath("js", f"{name}.js")
    if name in importers or not file.is_file():
        raise ValueError(f"{place}: there is no module {name}.js, or it imports itself")
    text = file.read_text(encoding="utf-8")
    exports: list[str] = []
    pieces: list[tuple[str, str]] = []  # tokens, and the blank before each
    before, end = ";", 0
    for token, at in _tokens(text, name):
        if at < end:  # a part of an import
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
                    raise ValueError(f"{_place(text, len(text), name)}: an import does not end")
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
    """Tokens in lines: a statement of the module itself begins one, within it they get long."""
    lines, before, depth = [""], "", 0
    for token, gap in pieces:
        begins = "\n" in gap and before in (";", "{", "}") and token != "}"  # a statement
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
    """Words, signs and literals with the places where they begin, without comments and blanks. Of
    a template literal each part between the expressions is one, with its quotes or braces.
    """
    at, before = 0, ""
    braces: list[str] = []  # those that are open: "{", or "${" in a template
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
                f"{_place(text, at, name)}: a comment or a literal does not end: {wrong}"
            )
        before = found[0]
        yield before, at
        at = found.end()
        if before[0] == "}":
            del braces[-1:]
        if before[-1] == "{":
            braces.append(before[-2:])
    if braces:
        raise ValueError(f"{_place(text, at, name)}: a brace does not end")


def _place(text: str, at: int, name: str) -> str:
    return f"{name}.js, line {len(text[: at + 1].splitlines())}"
