"""Labs, companions and exercises take their colours from the palette and never hard-code one."""

import ast
import json
import re
from pathlib import Path

import matplotlib
import numpy as np
import pytest
from canvas_words import contrast, rgb
from matplotlib.colors import is_color_like

from robokin.show import JOINT_STYLES, bars, curves, figure, palette

ROOT = Path(__file__).parents[1] / "notebooks"
NOTEBOOKS = sorted([*ROOT.glob("*.ipynb"), *ROOT.glob("documents/*.ipynb")])
EXERCISES = sorted(ROOT.glob("exercises/*/*.py"))
# Arguments and keys that contain a colour. Neither "none" nor a colour map (cmap) is a colour.
HOLDERS = re.compile(r"c|fc|ec|mec|mfc|\w*colors?", re.I)
# these accept a format such as "k--"
DRAWN = {"plot", "step", "loglog", "semilogx", "semilogy", "errorbar"}
FORMAT = re.compile(r"(?=.*[bgrcmykw])[bgrcmykw]?[-:.,ov^<>12348spP*hH+xXDd|_]*[bgrcmykw]?")


def typed(source):
    """The colours that Python code hard-codes, as (line, colour)."""
    tree = ast.parse("\n".join(re.sub(r"^%.*", "", line) for line in source.splitlines()))
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and _plain(node.value):
            found.add((node.lineno, node.value))
        for holder, value in _held(node):
            if HOLDERS.fullmatch(holder):
                found |= {
                    (part.lineno, part.value)
                    for part in ast.walk(value)
                    if isinstance(part, ast.Constant) and _any(part.value)
                }
        if isinstance(node, ast.Call) and getattr(node.func, "attr", "") in DRAWN:
            found |= {
                (part.lineno, part.value)
                for part in node.args
                if isinstance(part, ast.Constant)
                and isinstance(part.value, str)
                and FORMAT.fullmatch(part.value)
            }
    return sorted(found)


def _held(node):
    """The names and values of the arguments of a call and of the items of a dict."""
    if isinstance(node, ast.Call):
        yield from ((word.arg or "", word.value) for word in node.keywords)
    if isinstance(node, ast.Dict):
        for key, value in zip(node.keys, node.values, strict=True):
            yield str(getattr(key, "value", "")), value


def _plain(text):
    """Whether a text can only be a colour: a colour code, a grey level or a name of at least three
    letters.
    """
    coded = re.fullmatch(r"#([0-9A-Fa-f]{3,4}){1,2}|C\d|(tab|xkcd):.*|0?\.\d+", text)
    return bool(coded) or (
        len(text) > 2 and text.isalpha() and is_color_like(text) and text != "none"
    )


def _any(value):
    return isinstance(value, str) and value != "none" and is_color_like(value)


def code(path):
    if path.suffix == ".py":
        return path.read_text(encoding="utf-8")
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return "\n".join("".join(c["source"]) for c in cells if c["cell_type"] == "code")


@pytest.mark.parametrize(
    "path", [*NOTEBOOKS, *EXERCISES], ids=lambda p: f"{p.parent.name}/{p.name}"
)
def test_no_colour_is_hard_coded(path):
    assert typed(code(path)) == []


PLANTED = (
    'ax.plot(x, y, color="#0072B2")',
    'ax.plot(x, y, color="#07b")',
    'ax.plot(x, y, "k--")',
    'ax.plot(x, y, "b")',
    'ax.axhspan(0, 1, color="0.75")',
    'ax.fill(x, y, facecolor="white", hatch="//")',
    'ax.annotate("a", p, arrowprops={"color": "r"})',
    'for style, color in zip(("-", "--"), ("C0", "C1")):\n    ax.plot(x, style, color=color)',
    'looks = ("red", "-"), ("tab:blue", "--")',
    'ax.scatter(x, y, c=["g", "k"])',
    'shade = "0.9"',
)
INNOCENT = (
    'ax.plot(x, y, "o--", color=INK, label="b")',
    'ax.annotate("c", p)',
    'print("black at K, red at K2")',
    'names = ["a", "b", "c"]',
    'ax.fill(x, y, facecolor="none", edgecolor=PAPER)',
    'numbers(q, ".3f")',
    'ax.imshow(z, cmap="viridis")',
)


@pytest.mark.parametrize("source", PLANTED)
def test_hard_coded_colours_are_detected(source):
    assert typed(f"x = 1\n{source}"), source


@pytest.mark.parametrize("source", INNOCENT)
def test_words_that_are_not_colours_are_ignored(source):
    assert typed(source) == []


# --- Roles ----------------------------------------------------------------------------------------

TEXT = ("INK", "REMARK", "ALARM", "FIRST", "SECOND", "THIRD")
GROUNDS = ("PAPER", "AREA", "FIRST_AREA", "SECOND_AREA", "THIRD_AREA")


def in_the_dark(color):
    """A colour of a picture as a dark page shows it: the filter `invert(1) hue-rotate(180deg)`,
    computed with the matrix of W3C, Filter Effects Module 1, section 11.1, and then the blend mode
    `screen` with the page's paper colour.
    """
    red, green, blue = 0.213, 0.715, 0.072
    turn = 2 * np.array([[red, green, blue]] * 3) - np.eye(3)
    shown = np.clip(turn @ (1 - np.array(rgb(color)) / 255), 0, 1)
    paper = np.array(rgb(palette.PAGE["paper"][1])) / 255
    return 255 * (1 - (1 - shown) * (1 - paper))


@pytest.mark.parametrize("name", TEXT)
def test_text_colours_are_readable_on_light_and_dark_pages(name):
    color = getattr(palette, name)
    for ground in GROUNDS[:2] if name != "INK" else GROUNDS:
        on = getattr(palette, ground)
        assert contrast(rgb(color), rgb(on)) >= 4.5, (name, ground)
        assert contrast(in_the_dark(color), in_the_dark(on)) >= 4.5, (name, ground, "dark")


def test_colours_for_comparisons_differ_from_the_colours_of_joints():
    joints = [rgb(style["color"]) for style in JOINT_STYLES]
    compared = [rgb(color) for color, _ in palette.COMPARED]
    for k, color in enumerate(compared):
        others = [*joints, *compared[:k], *compared[k + 1 :], rgb(palette.ALARM)]
        assert min(np.linalg.norm(np.subtract(color, other)) for other in others) > 60, color
    assert len({dash for _, dash in palette.COMPARED}) == len(compared)


# --- The common style -----------------------------------------------------------------------------

T = np.linspace(0, 1, 5)


def test_every_title_is_bold_and_left_aligned():
    fig = figure("Two plots, one title for both.")
    one, two = fig.subplots(1, 2)
    one.set_title("By set_title")
    two.set(title="By set, and so long that it needs a second line of words")
    above = fig.suptitle("Above both")
    for text, ax in ((one._left_title, one), (two._left_title, two), (above, None)):
        assert text.get_fontweight() == "bold" and text.get_color() == palette.INK
        assert text.get_horizontalalignment() == "left" and text.get_text()
        assert ax is None or ax.get_title() == text.get_text()
    assert two.get_title().count("\n") == 1
    fig.tight_layout()
    for text in (one._left_title, two._left_title, above):
        assert text.get_window_extent().x1 <= fig.bbox.width


def test_long_title_of_a_plot_drawn_to_scale_fits_in_the_figure():
    fig = figure("A square.", 7, 3)
    ax = fig.subplots()
    ax.set(aspect="equal", title="Links of 4 and 5 m serve all out to 9 m, but for a round hole")
    fig.tight_layout()
    box = ax._left_title.get_window_extent()
    assert box.x0 >= 0 and box.x1 <= fig.bbox.width and box.y1 <= fig.bbox.height


def test_figure_style_does_not_change_the_settings_of_matplotlib():
    before = dict(matplotlib.rcParams)
    ax = figure("A plot.").subplots()
    assert ax.plot(T, T)[0].get_color() == palette.FIRST
    assert dict(matplotlib.rcParams) == before


def test_curves_differ_in_colour_and_dash_pattern_and_keep_their_values():
    ax = figure("Curves.").subplots()
    given = {name: k * T**2 for k, name in enumerate("abcd", start=1)}
    curves(ax, T, given, xlabel="t, s", ylabel="s, m", title="Four")
    for line, (name, values) in zip(ax.lines, given.items(), strict=True):
        assert line.get_label() == name
        np.testing.assert_array_equal(line.get_xydata(), np.stack([T, values], axis=-1))
    assert len({line.get_color() for line in ax.lines}) == 4
    assert len({line.get_linestyle() for line in ax.lines}) == 4
    assert [text.get_text() for text in ax.get_legend().get_texts()] == list(given)
    assert (ax.get_xlabel(), ax.get_ylabel(), ax.get_title()) == ("t, s", "s, m", "Four")


def test_curves_of_joints_have_the_colours_of_the_joints():
    ax = figure("Joints.").subplots()
    curves(ax, T, {"q6": T, "q2": 1 - T}, joints=(5, 1))
    assert [line.get_color() for line in ax.lines] == [JOINT_STYLES[i]["color"] for i in (5, 1)]
    alone = figure("One curve.").subplots()
    curves(alone, T, {"q6": T})
    assert alone.get_legend() is None


def test_bars_have_the_lengths_and_labels_of_their_values():
    ax = figure("Bars.").subplots()
    bars(ax, {"before": 12.0, "after": 3.5}, "{:.1f} ms", xlabel="time, ms", title="Faster")
    assert [bar.get_width() for bar in ax.patches] == [12, 3.5]
    assert [text.get_text() for text in ax.texts] == ["12.0 ms", "3.5 ms"]
    assert [label.get_text() for label in ax.get_yticklabels()] == ["before", "after"]
    assert ax.yaxis_inverted()


@pytest.mark.parametrize(
    "wrong, said",
    [
        (lambda ax: curves(ax, T, [T]), "dict"),
        (lambda ax: curves(ax, T, {"a": T[1:]}), r"shape \(samples,\)"),
        (lambda ax: curves(ax, T, dict.fromkeys("abcde", T)), "at most 4 curves, got 5"),
        (lambda ax: curves(ax, T, {"a": T}, joints=[6]), "from 0 to 5, got 6"),
        (lambda ax: bars(ax, {}), "dict"),
        (lambda ax: bars(ax, {"a": 1}, "{1}"), "form: wanted"),
    ],
)
def test_errors_name_the_invalid_value(wrong, said):
    with pytest.raises(ValueError, match=said):
        wrong(figure("Nothing.").subplots())
