"""Write pages and films to files, but never overwrite a file that robokin did not write."""

import contextlib
import html
import os
from collections.abc import Callable
from typing import Any

from .._validate import short

MARK = "<!-- robokin player -->"  # marks a file as written by robokin


def save(path: str | os.PathLike[str], title: str, body: str) -> None:
    """Write one self-contained page, completely or not at all. Raises ValueError if the name does
    not end in .html, or if the file exists and is not a saved player.
    """
    head = (
        '<!DOCTYPE html>\n<html lang="en">\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width">\n'
        '<meta name="color-scheme" content="light dark">\n'
        f"<title>{html.escape(title)}</title>\n"
    )
    body = (
        f'<body style="max-width:1200px;margin:16px auto;padding:0 8px">\n{body}</body>\n</html>\n'
    )
    write_page(path, head + body)


def write_page(path: str | os.PathLike[str], page: str) -> None:
    """Write a complete page, which begins with its doctype, completely or not at all. Raises
    ValueError if the name does not end in .html, or if the file exists and robokin did not write
    it.
    """
    doctype, _, rest = page.partition("\n")
    write(path, ".html", lambda: f"{doctype}\n{MARK}\n{rest}".encode())


def write(path: str | os.PathLike[str], ending: str, content: Callable[[], bytes]) -> None:
    """Write a file that has MARK near its beginning, completely or not at all. Raises ValueError if
    the name does not end in `ending`, or if the file exists and robokin did not write it.
    """
    name = _file(path, ending)
    if os.path.lexists(name) and not _ours(name):
        raise ValueError(
            f"path: {short(name)} exists and is not a saved player; nothing is overwritten"
        )
    _write(name, content())


def _file(path: Any, ending: str) -> str:
    """Return `path` as a string. Raises ValueError if it does not end in `ending`, or if its folder
    does not exist.
    """
    name = os.fspath(path) if isinstance(path, (str, os.PathLike)) else None
    if not isinstance(name, str) or os.path.splitext(name)[1] != ending or "\0" in name:
        raise ValueError(f"path: wanted a name that ends in {ending}, got {short(path)}")
    folder = os.path.dirname(name) or os.curdir
    if not os.path.isdir(folder):
        raise ValueError(f"path: wanted a folder that exists, got {short(folder)}")
    return name


def _ours(name: str) -> bool:
    """Return whether the file is a saved player and not a link to one."""
    if os.path.islink(name) or not os.path.isfile(name):
        return False
    with open(name, "rb") as file:
        return MARK.encode() in file.read(1000)  # in a GIF the mark follows the colour table


def _write(name: str, content: bytes) -> None:
    """Write to a temporary file first, so that the file is never incomplete."""
    beside = os.path.join(os.path.dirname(name), f".{os.urandom(8).hex()}.part")
    try:
        with open(beside, "xb") as file:
            file.write(content)
        os.replace(beside, name)
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            os.remove(beside)
        raise
