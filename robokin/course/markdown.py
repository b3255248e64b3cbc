"""The Markdown that teachers write: the exercises and objectives of a lab."""

import re
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

Edit = tuple[str, str]  # a piece of the solution, which must occur once, and its replacement


class Wrong(NamedTuple):
    """A mistake: its name, a sentence, and one or more wrong programs, each as edits to the
    solution or as a complete text. Also used for the correct programs of an exercise in writing a
    test.
    """

    name: str
    says: str
    programs: tuple[tuple[Edit, ...] | str, ...]
    lines: tuple[int, ...]  # the line number of each program in the file


class BadFile(ValueError):
    """Raised if a teacher's file cannot be used. The message is "FILE, line 3: why"."""

    def __init__(self, file: str, line: int | None, why: str) -> None:
        super().__init__(f"{file}, line {line}: {why}" if line else f"{file}: {why}")


class Text(NamedTuple):
    """An exercise as written. `parts` maps the headings of the other sections to (line, text)."""

    file: str
    number: str
    title: str
    objective: int
    task: str
    hints: tuple[str, ...]
    parts: dict[str, tuple[int, str]]

    def code(self, part: str) -> tuple[int, str]:
        """The program in a section, and its first line. Raises BadFile if there is none."""
        line, text = self.parts.get(part, (0, ""))
        found = CODE.search(text)
        if not found:
            raise BadFile(
                self.file, line - 1 if line else None, f"wanted a section {part!r} with a program"
            )
        return line + text.count("\n", 0, found.start(1)), found[1]

    def prose(self, part: str) -> str:
        """The text of a section on one line."""
        return one_line(self.parts.get(part, (0, ""))[1])

    def wrong(self, part: str = "Mistakes") -> list[Wrong]:
        """The mistakes of a section, or the correct programs of a test."""
        line, text = self.parts.get(part, (0, ""))
        starts = [found.start() for found in re.finditer(r"^\*\*", _blank(text), re.M)]
        return [
            _mistake(self.file, line + text.count("\n", 0, a), text[a:b])
            for a, b in pairwise([*starts, len(text)])
        ]


CODE = re.compile(r"^```python\n(.*?)^```", re.M | re.S)
ITEM = re.compile(r"^- (.*?)(?=^- |^#+ |\Z)", re.M | re.S)
EDIT = re.compile(r"(`+)(.+?)\1 (?:→|->) (?:(`+)(.+?)\3|nothing)(?:, (?=`)|$)")


def read(file: Path) -> str:
    """Read the text of a file. Raises BadFile if it cannot be read or is not UTF-8."""
    try:
        return file.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        raise BadFile(f"{file}", line, "this is not UTF-8") from None
    except OSError as error:
        raise BadFile(f"{file}", None, f"{error.strerror}") from None


def why(error: Exception) -> str:
    """The text of an error without its location, which is reported separately."""
    return f"{type(error).__name__}: {getattr(error, 'msg', error)}"


def one_line(text: str) -> str:
    """The text with single spaces between its words."""
    return " ".join(text.split())


def exercise(file: str, text: str) -> Text:
    """Parse an exercise. Raises BadFile if its header is invalid."""
    places = [found.start() for found in re.finditer("^## ", _blank(text), re.M)]
    head, rest = text[: places[0] if places else None], {}
    for a, b in pairwise([*places, len(text)]):
        heading, _, part = text[a:b].partition("\n")
        rest[heading[3:].strip()] = text.count("\n", 0, a) + 2, part
    found = re.match(r"\s*# (\w+)\. (.+)\n+Objective (\d)\.(.*)", head, re.S)
    if not found:
        raise BadFile(file, 1, "wanted '# 1. TITLE', an empty line, 'Objective 1. TASK'")
    number, title, objective, task = found.groups()
    _, hints = rest.pop("Hints", (0, ""))
    texts = tuple(map(_hint, re.split(r"^\d\. ", hints, flags=re.M)[1:]))
    return Text(file, number, title.strip(), int(objective), one_line(task), texts, rest)


def objectives(text: str) -> tuple[str, ...]:
    """The objectives of a lab, which are the numbered lines."""
    return tuple(map(one_line, re.split(r"^\d\. ", text, flags=re.M)[1:]))


def _hint(text: str) -> str:
    """A hint: its text on one line, followed by its program, if any."""
    found = CODE.search(text)
    if not found:
        return one_line(text)
    code = "\n".join(f"    {line}".rstrip() for line in found[1].rstrip().split("\n"))
    rest = one_line(text[found.end() :])
    return "\n".join(filter(None, [one_line(text[: found.start()]), code, rest]))


def _mistake(file: str, line: int, block: str) -> Wrong:
    programs: list[tuple[Edit, ...] | str] = []
    lines = []
    for found in CODE.finditer(block):
        programs.append(found[1])
        lines.append(line + block.count("\n", 0, found.start(1)))
    block = _blank(block)
    words = re.split(r"^(?:- |#+ )", block, maxsplit=1, flags=re.M)[0]
    head = re.fullmatch(r"\*\*(.+?)\*\*(.*)", one_line(words))
    if not head:
        raise BadFile(file, line, f"wanted '**name.** A sentence.', got {one_line(words)[:60]!r}")
    for found in ITEM.finditer(block):
        lines.append(line + block.count("\n", 0, found.start()))
        text = one_line(found[1])
        pairs = [(old, new or "") for _, old, _, new in EDIT.findall(text)]
        if not pairs or EDIT.sub("", text):
            raise BadFile(file, lines[-1], f"wanted `right` → `wrong`, got {text!r}")
        programs.append(tuple(pairs))
    return Wrong(head[1].removesuffix("."), head[2].strip(), tuple(programs), tuple(lines))


def _blank(text: str) -> str:
    """The text with its programs blanked out, since a comment in a program is not a heading."""
    return CODE.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)
