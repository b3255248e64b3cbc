"""The HTML of views and figures: a still picture, and the script that replaces it. The module
`saving` writes it to files.
"""

import base64
import html
import json
import re
from typing import Any

from .joiner import compressed, script, style
from .palette import still_css

STILL = (
    "A still picture. To see it move: run all cells (Run > Run All Cells), or trust the notebook "
    "(Ctrl+Shift+C, then Trust Notebook)."
)
# a string, the sign of -0.0, or what ends 1.0
WHOLE = re.compile(r'("(?:[^"\\]|\\.)*")|-(?=0\.0[,\]}])|(?<=\d)\.0(?=[,\]}])')


def inert(data: Any) -> str:
    """Return `data` as JSON that is safe inside a script, with 1 for 1.0 and 0 for -0.0. Raises
    ValueError if JSON cannot represent it.
    """
    try:
        text = json.dumps(data, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
        text.encode()
    except (TypeError, ValueError, RecursionError) as error:
        raise ValueError(f"data: wanted values that JSON can represent ({error})") from None
    text = WHOLE.sub(lambda found: found[1] or "", text)
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def still_image(png: bytes, alt: str) -> str:
    """Return the still picture that is shown until a player or an explorer starts."""
    image = base64.b64encode(png).decode()
    return (
        f'<img alt="{html.escape(alt)}" style="max-width:100%" '
        f'src="data:image/png;base64,{image}"><p>{STILL}</p>'
    )


def figure_image(
    png: bytes, alt: str, width: int, height: int, least: int, spatial: bool = False
) -> str:
    """Return a figure of `width` x `height` pixels that follows the theme and the width of the
    page. It is never narrower than `least` pixels; on a narrower page, it scrolls. The content of a
    `spatial` view is in its middle, so an exported page is first scrolled there.
    """
    image = base64.b64encode(png).decode()
    kind = "robokin-figure robokin-spatial" if spatial else "robokin-figure"
    return (
        f'<div class="{kind}"><img alt="{html.escape(alt)}" width="{width}" '
        f'height="{height}" style="max-width:min(100%,{width}px);min-width:{least}px;height:auto" '
        f'src="data:image/png;base64,{image}"></div>\n'
        f"<style>{still_css()}{style('elements')}\n</style>\n"
    )


def output(call: str, name: str, text: str, still: str, nonce: str = "") -> str:
    """Return a piece of HTML that contains `still` and the script that replaces it. `text` is a
    `Page`, `PageExplorer` or `PageQuestion` as JSON. `call` names the module and its function, such
    as "player.play". `nonce` is the nonce of a page whose security policy forbids scripts without
    it.
    """
    module, _ = call.split(".")
    key, bytes_of_script = compressed(module)
    tag = f"script nonce={nonce}" if nonce else "script"
    return (
        f'<div class="robokin-player" data-player="{name}">{still}</div>\n'
        f"<style>{still_css()}{style('elements')}\n</style>\n"
        f"<{tag}>(() => {{\n{script('loader')}\n"
        f'$loader.start("{name}", "{key}", "{bytes_of_script}", ${module} => {{\n'
        f'${call}("{name}", {text});\n}});\n}})();</script>\n'
    )
