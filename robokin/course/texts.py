"""Make invisible characters in other people's text visible."""

import functools
import re
from typing import Any

# A character class of `re`: control characters, characters that change the direction of writing or
# end a line, zero-width marks, tags and lone surrogates. It does not contain joiners, which
# Persian, Hindi and emoji need.
UNSEEN = (
    "\0-\x1f\x7f-\x9f\xad\u061c\u180e\u200b\u200e\u200f\u2028-\u202e\u2060-\u206f\ufeff"
    "\ufff9-\ufffb\ud800-\udfff\U0001bca0-\U0001bca3\U0001d173-\U0001d17a\U000e0000-\U000e007f"
)
LINES = "\t\n"  # control characters that a multi-line text needs
ALL_BUT_HALVES = "^\ud800-\udfff"  # a file cannot contain a lone surrogate
DEEP = 100  # maximum depth of nested lists


def visible(text: str, kept: str = LINES, most: int | None = None) -> str:
    r"""The text with an escape, such as \x1b or \u202e, for each invisible character. `kept` is a
    character class of `re` with characters to keep. A text longer than `most` characters is
    truncated.
    """
    if most is not None and len(text) > most:
        text = f"{text[:most]} ... shortened"
    if kept == LINES:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    return _unseen(kept).sub(lambda found: ascii(found[0])[1:-1], text)


def all_visible(value: Any, kept: str = LINES, depth: int = 0) -> Any:
    """Apply `visible` to all strings of a JSON value. Raises ValueError if the value is nested too
    deeply.
    """
    if isinstance(value, str):
        return visible(value, kept)
    if not isinstance(value, (dict, list, tuple)):
        return value
    if depth == DEEP:
        raise ValueError(f"nested deeper than {DEEP} levels")
    if isinstance(value, dict):
        return {visible(k, kept): all_visible(v, kept, depth + 1) for k, v in value.items()}
    return [all_visible(each, kept, depth + 1) for each in value]


@functools.cache
def _unseen(kept: str) -> re.Pattern[str]:
    return re.compile(f"[{UNSEEN}](?<![{kept}])" if kept else f"[{UNSEEN}]")
