"""Sanitise other people's text for a page. It may not contain scripts, styles, addresses that are
fetched, our classes or ids, or characters that change the direction of text.
"""

import base64
import binascii
import html
import re
from collections import Counter
from collections.abc import Callable, Iterator
from functools import partial
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

from bleach.html5lib_shim import Filter
from bleach.sanitizer import Cleaner
from markupsafe import Markup

from .texts import visible

LONG = 100_000  # maximum number of characters of a text that is shown
DEEP = 100  # maximum nesting depth of elements, since the parser takes quadratic time

TAGS = frozenset(
    "a abbr b blockquote br caption code col colgroup dd del details div dl dt em figcaption "
    "figure h1 h2 h3 h4 h5 h6 hr i img ins kbd li mark ol p pre q s samp small span strong sub "
    "summary sup table tbody td tfoot th thead tr u ul var".split()
)
HEADINGS = frozenset(f"h{k}" for k in range(1, 7))
VOID = {"br", "col", "hr", "img"}
HIDDEN = ("script", "style")  # their content is not text and is removed with them
ALIGNED = re.compile(r"text-align: ?(left|right|center);?")
PICTURES = {".png": "png", ".jpg": "jpeg", ".jpeg": "jpeg", ".gif": "gif", ".svg": "svg+xml"}
INLINE = re.compile(r"data:image/(png|jpeg|gif|webp|svg\+xml);base64,([A-Za-z0-9+/]+={0,2})")
MATH = frozenset(
    "math menclose merror mfrac mi mmultiscripts mn mo mover mpadded mphantom mprescripts mroot "
    "mrow mspace msqrt mstyle msub msubsup msup mtable mtd mtext mtr munder munderover".split()
)
MATH_ATTRIBUTES = frozenset(
    "accent accentunder columnalign columnlines columnspacing depth display displaystyle fence "
    "form height largeop linethickness lspace mathvariant maxsize minsize movablelimits notation "
    "rowspacing rspace scriptlevel separator stretchy symmetric voffset width".split()
)
MATH_STYLE = re.compile(
    r"(?:(?:text-align|justify-items): ?[a-z]+;|(?:padding|margin)-(?:left|right): ?"
    r"-?[\d.]{1,12}(?:em)?;|border-(?:top|bottom|left|right): ?[\d.]+em (?:solid|dashed);)*"
)


def shortened(text: str, most: int = LONG) -> str:
    """Truncate a long text and append its length."""
    return text if len(text) <= most else f"{text[:most]}\n... shortened: {len(text)} characters"


def is_deep(markup: str) -> bool:
    """Return whether more than DEEP elements may be open at the same time."""
    left: Counter[str] = Counter()
    depth = 0
    for slash, name in re.findall(r"<(/?)([A-Za-z][^\s/>]*)", markup):
        name = name.lower()
        if name not in TAGS or name in VOID:
            continue
        if not slash:
            left[name] += 1
            depth += 1
        elif left[name]:
            left[name] -= 1
            depth -= 1
        if depth > DEEP:
            return True
    return False


def clean(
    markup: str,
    picture: Callable[[str], str | None] = lambda address: None,
    plain: Callable[[str], str] = str,
) -> str:
    """Return the HTML with only the allowed elements and attributes.

    picture  a function that converts the address of a picture to a `data:` address, or returns None
             to leave the picture out
    plain    a function that is first applied to the values of attributes
    """
    last = partial(_Attributes, picture=picture, plain=plain)
    cleaner = Cleaner(
        tags=TAGS | {*HIDDEN},
        attributes=_allowed,
        protocols={"http", "https", "mailto", "data", "attachment"},
        strip=True,
        filters=[last],
        css_sanitizer=_Alignment(),
    )
    return str(cleaner.clean(markup))


ATTRIBUTES = {
    "a": ("href", "title"),
    "abbr": ("title",),
    "details": ("open",),
    "img": ("src", "alt", "title", "width", "height"),
    "ol": ("start",),
    "td": ("colspan", "rowspan"),
    "th": ("colspan", "rowspan"),
}


def _allowed(tag: str, name: str, value: str) -> bool:
    if name == "style":
        return tag in ("td", "th") and bool(ALIGNED.fullmatch(value))
    if name in ("width", "height", "colspan", "rowspan", "start"):
        return name in ATTRIBUTES.get(tag, ()) and bool(re.fullmatch(r"\d{1,4}", value))
    if name == "id":
        return tag in HEADINGS and not re.match("rk|robokin", value, re.I)
    return name in ATTRIBUTES.get(tag, ())


class _Alignment:
    def sanitize_css(self, style: str) -> str:
        return style if ALIGNED.fullmatch(style) else ""


class _Attributes(Filter):  # type: ignore[misc]
    """The last step of `clean`: make invisible characters visible, and links and pictures
    harmless.
    """

    def __init__(self, source: Any, picture: Any, plain: Any) -> None:
        super().__init__(source)
        self.picture, self.plain = picture, plain

    def __iter__(self) -> Iterator[dict[str, Any]]:
        hidden = ""
        for token in super().__iter__():
            kind, name = token["type"], token.get("name")
            if hidden:
                hidden = "" if (kind, name) == ("EndTag", hidden) else hidden
            elif name in HIDDEN and kind != "Entity":
                hidden = name if kind == "StartTag" else ""
            elif kind == "Characters":
                yield token | {"data": visible(token["data"])}
            elif kind == "Entity":
                meant = html.unescape(f"&{name};")
                shown = visible(meant)
                yield token if shown == meant else {"type": "Characters", "data": shown}
            elif kind in ("StartTag", "EmptyTag"):
                yield self._element(token)
            else:
                yield token

    def _element(self, token: dict[str, Any]) -> dict[str, Any]:
        values = {
            name: self.plain(html.unescape(value)) for (_, name), value in token["data"].items()
        }
        if token["name"] == "a":
            address = harmless_link(values.pop("href", ""))
            if address:
                values["href"] = address
                values["rel"] = "noopener noreferrer"
        if token["name"] == "img":
            found = self.picture(values.pop("src", ""))
            words = visible(values.pop("alt", "")) or "a picture without a description"
            if found is None:
                return {"type": "Characters", "data": f"[{words}]"}
            values |= {"alt": words, "src": found}
        # the serializer mistakes an ampersand for the beginning of an entity
        data = {(None, n): visible(v).replace("&", "&amp;") for n, v in values.items()}
        return token | {"data": data}


def harmless_link(address: str) -> str:
    """Return the address if a reader may follow it, otherwise "". Web and mail addresses, pages
    next to this one (a notebook becomes its page) and places on this page are allowed.
    """
    address = re.sub(r"[\0-\x1f\x7f-\x9f]", "", address).strip().replace(" ", "%20")
    scheme = re.match(r"([^/?#]*):", address)
    if scheme:
        return address if scheme[1].lower() in ("http", "https", "mailto") else ""
    if address.startswith(("/", "\\")):
        return ""
    return re.sub(r"\.ipynb(?=#|$)", ".html", address)


def image(kind: str, data: str, alt: str) -> Markup:
    """Return the picture of an output as an <img>. `data` is in base64, or the text of an SVG,
    which in an <img> runs no script and fetches nothing. Raises ValueError if it is not a picture.
    """
    if kind == "image/svg+xml":
        data = base64.b64encode(data.encode(errors="replace")).decode()
    address = f"data:{kind};base64,{''.join(data.split())}"
    if not INLINE.fullmatch(address):
        raise ValueError(f"{kind}: not in base64")
    return Markup('<img alt="{}" src="{}">').format(visible(alt), address)


def file_as_picture(address: str, folder: Path) -> str | None:
    """A picture in `folder` or a subfolder as a `data:` address; None if there is none."""
    kind = PICTURES.get(Path(address).suffix.lower())
    try:
        path = (folder / address).resolve()
        if kind is None or not path.is_relative_to(folder.resolve()) or not path.is_file():
            return None
        return f"data:image/{kind};base64,{base64.b64encode(path.read_bytes()).decode()}"
    except (OSError, ValueError):  # ValueError: an invalid file name
        return None


def png(data: str) -> bytes:
    """Return the bytes of a PNG in base64. Raises ValueError if it is not a PNG."""
    try:
        found = base64.b64decode(data, validate=True)
    except binascii.Error as error:
        raise ValueError(f"not base64: {error}") from None
    if not found.startswith(b"\x89PNG\r\n\x1a\n"):
        raise ValueError("not a PNG")
    return found


class _Elements(HTMLParser):
    """Collect the parts of MathML that are not allowed."""

    def __init__(self, markup: str) -> None:
        super().__init__()
        self.odd: list[str] = []
        self.feed(markup)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in MATH:
            self.odd.append(tag)
        for name, value in attrs:
            fits = name in MATH_ATTRIBUTES and re.fullmatch(r"[\w.+\- ]*", value or "")
            if not (fits or name == "style" and MATH_STYLE.fullmatch(value or "")):
                self.odd.append(name)

    def handle_comment(self, data: str) -> None:
        self.odd.append("a comment")

    def handle_decl(self, decl: str) -> None:
        self.odd.append("a declaration")

    def handle_pi(self, data: str) -> None:
        self.odd.append("an instruction")

    def unknown_decl(self, data: str) -> None:
        self.odd.append("a declaration")


def odd_in_math(markup: str) -> list[str]:
    """The parts of MathML that are not allowed; there should be none."""
    return _Elements(markup).odd
