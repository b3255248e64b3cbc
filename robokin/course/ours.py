"""Regenerate the outputs of robokin in a notebook. Only the kind and the data of an output are
read; the data are validated, and the script comes from this version of robokin. A script in a
notebook is never copied.
"""

import hashlib
import html
import json
import re
from collections.abc import Mapping
from dataclasses import replace
from functools import cache, lru_cache
from types import NoneType, UnionType
from typing import (
    Any,
    Literal,
    NamedTuple,
    Union,
    get_args,
    get_origin,
    get_type_hints,
    is_typeddict,
)

from markupsafe import Markup

from ..show.explorer_page import PageExplorer
from ..show.markup import STILL as IN_JUPYTER
from ..show.markup import figure_image, inert, output, still_image
from ..show.motors import PageMotors
from ..show.page import Page, PageCurves
from .book import find
from .exercises import Verdict
from .harmless import png
from .predictions import ASLEEP, Asked, shown
from .questions import Prediction
from .texts import all_visible, visible

MARK = 'class="robokin-player"'
LEFT_OUT = Markup("<p>An output of robokin that cannot be read is left out here.</p>")
ASK = "prediction.ask"
EXPLORERS = [get_args(get_type_hints(page)["kind"])[0] for page in get_args(PageExplorer)]
KINDS: dict[str, Any] = {
    "player.play": Page,
    "joint_curves.show": PageCurves,
    "motor_explorer.explore": PageMotors,
    **{f"{kind}_explorer.explore": PageExplorer for kind in EXPLORERS},
}
CALL = re.compile(r'^\$(\w+\.\w+)\("[0-9a-f]{12}", (.*)\);$', re.M)
STILL = re.compile(r'src="data:image/png;base64,([A-Za-z0-9+/]+={0,2})"')
FIGURE = re.compile(  # older notebooks store only the image
    r'(?:<div class="robokin-figure( robokin-spatial)?">)?'
    r'<img alt="([^"<>]*)" width="(\d{1,5})" height="(\d{1,5})" '
    r'(?:style="[^"<>]*min-width:(\d{1,5})px[^"<>]*" )?'
    r'src="data:image/png;base64,([A-Za-z0-9+/]+={0,2})">(?:</div>\s*<style>[^<]*</style>)?\s*'
)
VERDICT = re.compile(
    r'<div role="status" style="[^"]*"><b>(\w+\.\w+): '
    r"(holds|does not hold|not answered yet|not judged)\.</b>"
    r'((?:<div style="padding-left:[02]em">[^<>]*</div>)*)</div>'
)
LINE = re.compile(r'<div style="padding-left:([02])em">([^<>]*)</div>')


def quiet(text: str) -> str:
    """Return HTML or JSON without the sentences that tell a reader of JupyterLab how to start a
    view, since our pages start views automatically.
    """
    return text.replace(IN_JUPYTER, "").replace(ASLEEP, "")


def again(text: str, nonce: str, choices: Mapping[str, str] | None = None) -> Markup | None:
    """Return an output of robokin as this version writes it, or None if it is not one.

    nonce    the nonce of the page's scripts
    choices  a dict that maps predictions to the choices shown when the page opens; None means the
             choice in the output
    """
    figure = FIGURE.fullmatch(text)
    if figure:
        return _figure(*figure.groups())
    verdict = VERDICT.fullmatch(text)
    if verdict:
        return _verdict(*verdict.groups())
    if MARK not in text:
        return None
    try:
        calls = list(CALL.finditer(text))
        if not calls:
            return LEFT_OUT
        # A question contains the output that answers it, with a call of its own.
        call = next((each for each in calls if each[1] == ASK), calls[0])
        data = json.loads(call[2], parse_constant=_refused, object_hook=_ordinary)
        if call[1] == ASK:
            return Markup(quiet(_question(data, nonce, choices)))
        if not fits(data, KINDS.get(call[1], NoneType)) or _kind(data, call[1]) != call[1]:
            return LEFT_OUT
        found = STILL.search(text)
        data = all_visible(data)
        still = still_image(png(found[1] if found else ""), data["alt"])
        data = inert(data)
    except (ValueError, KeyError, TypeError, RecursionError):
        return LEFT_OUT
    # a hash of the data, so that different outputs never share an id in the page
    name = hashlib.sha256(data.encode()).hexdigest()[:12]
    return Markup(output(call[1], name, data, quiet(still), nonce))


def fits(value: Any, kind: Any) -> bool:
    """Return whether a value from JSON matches a type, such as those in page.py."""
    origin, inner = get_origin(kind), get_args(kind)
    if kind is Any:
        return True
    if is_typeddict(kind):
        hints = _hints(kind)
        return (
            isinstance(value, dict)
            and kind.__required_keys__ <= value.keys() <= hints.keys()
            and all(fits(each, hints[key]) for key, each in value.items())
        )
    if origin in (Union, UnionType):
        return any(fits(value, each) for each in inner)
    if origin is Literal:
        return isinstance(value, str) and value in inner
    if origin is list:
        return isinstance(value, list) and all(fits(each, inner[0]) for each in value)
    if origin is tuple:
        inner = inner[:1] * len(value) if inner[-1] is ... else inner
        return isinstance(value, list) and len(value) == len(inner) and all(map(fits, value, inner))
    if origin is dict:
        return isinstance(value, dict) and all(fits(each, inner[1]) for each in value.values())
    if kind is float:
        return isinstance(value, (int, float)) and not isinstance(value, bool)
    if kind is int:
        return isinstance(value, int) and not isinstance(value, bool)
    return isinstance(value, kind)


@cache
def _hints(table: Any) -> dict[str, Any]:
    return get_type_hints(table)


def _kind(data: dict[str, Any], call: str) -> str:
    """The name of the function in the page's script that takes these data."""
    return f"{data['kind']}_explorer.explore" if "kind" in data else call


def _refused(word: str) -> None:
    raise ValueError(f"{word} is not a JSON number")


def _ordinary(table: dict[str, Any]) -> dict[str, Any]:
    if "__proto__" in table:  # JavaScript would set the prototype instead of a key
        raise ValueError("__proto__ is not allowed as a key")
    return table


def _figure(
    spatial: str | None, alt: str, width: str, height: str, least: str | None, data: str
) -> Markup:
    try:
        image = png(data)
    except ValueError:
        return LEFT_OUT
    alt = visible(html.unescape(alt))
    sizes = int(width), int(height), int(least or width)
    return Markup(figure_image(image, alt, *sizes, spatial=spatial is not None))


def _verdict(name: str, word: str, lines: str) -> Markup:
    """Render a stored verdict with its own text and the colour of its state."""
    says = [
        ("  " if indent == "2" else "") + visible(html.unescape(line))
        for indent, line in LINE.findall(lines)
    ]
    made = Verdict(name, word in ("holds", "does not hold"), word == "holds", says=tuple(says))
    return Markup(made._repr_html_())


def _question(data: Any, nonce: str, choices: Mapping[str, str] | None) -> str:
    """Return the HTML of a prediction. Raises ValueError, KeyError or TypeError if this fails."""
    name = data["name"]
    prediction = _prepared(str(name), nonce)
    choice = data.get("choice") if choices is None else choices.get(name)
    try:
        return Asked(name, prediction, _choice(prediction, choice))._in_page(nonce)
    except ValueError:  # an invalid choice
        return Asked(name, prediction, None)._in_page(nonce)


class Ready(NamedTuple):
    """A view that is already HTML."""

    html: str

    def _in_page(self, nonce: str) -> str:
        """Return the HTML unchanged."""
        return self.html


@lru_cache(256)
def _prepared(name: str, nonce: str) -> Prediction:
    """Return a prediction with its facts and view, which are computed once for each page."""
    prediction: Prediction = find(name, "predictions")
    facts, view = prediction.facts(), Ready(shown(prediction.view(), nonce))
    return replace(prediction, facts=lambda: facts, view=lambda: view)


def _choice(prediction: Prediction, choice: Any) -> Any:
    """Convert a choice from text: a letter or a number. Raises ValueError if it is neither."""
    if choice is None or prediction.unit is None:
        return choice
    number = float(choice)
    return int(number) if number.is_integer() else number
