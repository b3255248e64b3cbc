"""All colours of figures and pages, and the styles of the joints.

The root elements of a page have the colours as CSS custom properties (`--rk-ink`, ...), in one
light and one dark set, and the font (`--rk-font`); the scripts read them from there. Figures use
light colours.
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

# Colours and dash patterns of joints 1 to 6; the dashes are on/off lengths in line widths. The
# colours are from Okabe and Ito, Color Universal Design, 2008. Colour-blind readers can distinguish
# them, and the dashes remain distinct in grey print. PAGE, below, has the colours of dark pages.
JOINT_STYLES: tuple[Mapping[str, Any], ...] = tuple(
    MappingProxyType({"color": color, "dash": dash})  # read-only, because it is shared
    for color, dash in (
        ("#0072B2", ()),
        ("#D55E00", (5, 1.8)),
        ("#009E73", (1.6, 1.3)),
        ("#CC79A7", (6, 1.6, 1.4, 1.6)),
        ("#E69F00", (2.8, 1.2)),
        ("#56B4E9", (0.9, 1.4)),
    )
)
DASHES = [list(style["dash"]) for style in JOINT_STYLES]  # for pages
AXIS_COLORS = ("#C62828", "#2E7D32", "#1F55C4")  # x, y, z of a triad: red, green, blue
ALARM, TRACE, PALE = "#B3261E", "#0072B2", "#B3D4E8"  # PALE: a trace in the background

# Colours of figures by role: lines and text, postures from strong to faint, and the floor.
INK, SOFT, FAINT, GRID = "#2F3A45", "#87939F", "#C3CAD1", "#DDE2E7"
REMARK, SCALE = "#5A6672", "#6B7681"
PANEL_GRID, SHADOW, FOOT = "#E9ECEF", "#EDEFF2", "#D5DAE0"
PAPER, AREA = "#FFFFFF", "#E3E7EB"  # AREA: the floor, an obstacle, values beyond a limit
# Colours for things that are compared and are not joints. They are readable as text on light and
# dark pages, and differ from the colours of the joints. The areas are for the same things, behind
# text.
FIRST, SECOND, THIRD = "#5B3FB8", "#8A5A00", "#A3127C"
FIRST_AREA, SECOND_AREA, THIRD_AREA = "#D4C9F2", "#F0DDB6", "#F2D3E8"
COMPARED = ((FIRST, "-"), (SECOND, "--"), (THIRD, ":"), (INK, "-."))  # with line styles
TITLE: Mapping[str, Any] = MappingProxyType({"fontweight": "bold", "color": INK})

FONT = "system-ui,-apple-system,'Segoe UI','Liberation Sans',sans-serif"  # the font of pages
# The colours of pages by name: (light, dark), six digits each.
PAGE: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "paper": ("#FFFFFF", "#1B2026"),  # the background, and the outlines that separate lines
        "ink": ("#1F2933", "#E4E9EE"),
        "soft": ("#5F6B76", "#A3AFBA"),
        "line": ("#C9D0D6", "#56616C"),
        "grid": ("#E4E8EB", "#343D46"),
        "border": ("#D5DADF", "#3B4550"),
        "rim": ("#9AA5AF", "#66727E"),  # the border of a panel of curves
        "alarm": (ALARM, "#FF8A80"),
        "path": ("#1B2A41", "#D3DEEE"),
        "near": ("#9C4A00", "#FFB26B"),  # the line from the path to the via point
        "accent": ("#0072B2", "#5AB4EA"),
        "chosen": ("#E3EEF6", "#26384A"),
        "button": ("#F4F6F8", "#2A323A"),
        "hover": ("#E8ECEF", "#36404A"),
        "rest": ("#A9B3BC", "#5E6A76"),  # the border of a button
        # the arm: outline, body and highlight of links and of the rods of prismatic joints
        "edge": ("#27323C", "#0C1014"),
        "link": ("#4B5966", "#7C8A97"),
        "shine": ("#7D8B98", "#B3BFCA"),
        "rodEdge": ("#5F6B76", "#0C1014"),
        "rod": ("#AEB8C1", "#A8B3BD"),
        "rodShine": ("#D5DCE2", "#DDE4EA"),
        "hub": ("#FFFFFF", "#E4E9EE"),  # the middle of a joint, the dot of the flange
        "foot": ("#D3D9DE", "#3A444E"),
        "footEdge": ("#8A96A1", "#6E7B87"),
        "ghost": ("#475563", "#9AA8B5"),
        "ballShine": ("#E2BD8C", "#E8C698"),
        "ball": ("#B07C3E", "#B98747"),
        "ballEdge": ("#7A5426", "#E2BD8C"),
        "x": (AXIS_COLORS[0], "#FF7B72"),
        "y": (AXIS_COLORS[1], "#6CC573"),
        "z": (AXIS_COLORS[2], "#82AAFF"),
        **{
            f"joint{i + 1}": (style["color"], dark)
            for i, (style, dark) in enumerate(
                zip(
                    JOINT_STYLES,
                    # the dark colours of joints 1 to 6
                    ("#3D9BDC", "#F0803C", "#2BBF94", "#DE97BF", "#F0B840", "#8CCBF2"),
                    strict=True,
                )
            )
        },
    }
)


# How a still picture, which is drawn on white, is shown in a light and in a dark page. Inverting
# turns red into cyan, and rotating the hue by half a turn turns it back.
STILL = {
    "still": ("none", "invert(1) hue-rotate(180deg)"),
    "blend": ("multiply", "screen"),  # so that white blends into the page
    "shade": ("#0005", "#fff5"),  # at an edge where a figure is cut off
}


def css() -> str:
    """Return the palette and the font of running views as CSS. The colours are dark if JupyterLab,
    or a page exported from it, says so; if it says nothing, they follow the reader's system. They
    are light in print.
    """
    return _themes(":is(.robokin-player,.rk)", f"--rk-font:{FONT};", {**PAGE, **STILL})


def still_css() -> str:
    """Return the colours that a page needs before a view runs, as CSS that follows the same rules.
    Each stored view repeats them, so there are few.
    """
    roots = ":is(.robokin-player,.robokin-figure)"
    return _themes(roots, "", {**{name: PAGE[name] for name in ("paper", "ink")}, **STILL})


def _themes(roots: str, font: str, colors: Mapping[str, tuple[str, str]]) -> str:
    light, dark = (
        ";".join(f"--rk-{name}:{pair[k]}" for name, pair in colors.items()) for k in (0, 1)
    )
    dark = f"{dark};color-scheme:dark"
    return (
        f"{roots}{{{font}{light};color-scheme:light}}\n"
        f"@media screen{{[data-jp-theme-light=false] {roots}{{{dark}}}}}\n"
        "@media screen and (prefers-color-scheme:dark)"
        f"{{body:not([data-jp-theme-light]) {roots}{{{dark}}}}}\n"
    )
