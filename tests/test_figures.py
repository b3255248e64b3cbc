"""Figures in a page: they adapt to its theme and its width, and remain readable."""

import io
import re

import numpy as np
import pytest
from PIL import Image

from robokin import IRB140, deg, ptp, quintic
from robokin.course.ours import again
from robokin.show import animate, figure, plot_frames, plot_joints, plot_postures

T = np.linspace(0, 6, 601)
Q = ptp([0, 0, 0, 0, 30 * deg, 0], [1, 0.4, 1.4, 1, 1, 2], quintic(6)(T))
VIEWPORT = "<!doctype html><meta name=viewport content='width=device-width'>"


def made(fig):
    return fig._repr_mimebundle_()["text/html"]


@pytest.fixture(scope="module")
def figures():
    few = figure("A figure with words of ten and of nine points.", width=9, height=2)
    ax = few.subplots()
    ax.set_title("ten points", fontsize=10)
    ax.set_xticks([0, 1], ["a", "b"], fontsize=9)
    ax.set_yticks([0, 1], ["", " "], fontsize=2)  # blank labels need not be readable
    return {
        "postures": plot_postures(IRB140, Q, title="A motion of six joints"),
        "joints": plot_joints(IRB140, T, Q),
        "frames": plot_frames(IRB140.fk(Q[::200]), names=list("abcd")),
        "own": few,
    }


def brightness(page, selector):
    """The median brightness, from 0 to 1, of the part of the page that shows an element."""
    shot = Image.open(io.BytesIO(page.locator(selector).screenshot())).convert("L")
    return float(np.median(np.asarray(shot))) / 255


# --- Theme ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["postures", "joints", "frames", "own", "still"])
def test_pictures_are_dark_on_a_dark_page_and_light_in_print(browser, figures, kind):
    html = animate(IRB140, T, Q).html if kind == "still" else made(figures[kind])
    context = browser.new_context(color_scheme="dark", java_script_enabled=False)
    page = context.new_page()
    page.set_content(f"{VIEWPORT}<body>{html}</body>")
    assert brightness(page, "img") < 0.2
    page.emulate_media(color_scheme="light")
    assert brightness(page, "img") > 0.9
    page.emulate_media(color_scheme="dark", media="print")
    assert brightness(page, "img") > 0.9
    page.close()
    context.close()


@pytest.mark.parametrize("light", ["false", "true"])
def test_jupyterlab_theme_overrides_the_system_theme(browser, figures, light):
    page = browser.new_page(color_scheme="dark" if light == "true" else "light")
    page.set_content(f"<body data-jp-theme-light={light}>{made(figures['own'])}</body>")
    assert (brightness(page, "img") < 0.2) == (light == "false")
    page.close()


def test_red_green_and_blue_axes_keep_their_hues_on_a_dark_page(browser, figures):
    page = browser.new_page(color_scheme="dark")
    page.set_content(f"<body>{made(figures['frames'])}</body>")
    shot = Image.open(io.BytesIO(page.locator("img").screenshot())).convert("RGB")
    red, green, blue = (np.asarray(shot, dtype=float)[..., k] for k in range(3))
    for most, one, other in [(red, green, blue), (green, red, blue), (blue, red, green)]:
        assert ((most > one + 40) & (most > other + 20) & (most > 120)).sum() > 200
    page.close()


# --- Width ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["postures", "frames", "own"])
def test_figure_text_is_at_least_ten_pixels_high_even_on_a_phone(browser, figures, kind):
    fig = figures[kind]
    fig.canvas.draw()
    sizes = [
        t.get_fontsize()
        for t in fig.findobj(lambda a: hasattr(a, "get_fontsize"))
        if t.get_text().strip() and t.get_visible()
    ]
    page = browser.new_page(viewport={"width": 390, "height": 700})
    page.set_content(f"{VIEWPORT}<body>{made(fig)}</body>")
    image = page.locator("img").bounding_box()
    scale = image["width"] / (fig.get_figwidth() * 100)
    assert min(sizes) * 100 / 72 * scale >= 9.99
    assert image["height"] / image["width"] == pytest.approx(
        fig.get_figheight() / fig.get_figwidth(), rel=0.01
    )
    assert page.evaluate("document.documentElement.scrollWidth") <= 390, "the page scrolls sideways"
    box = page.locator(".robokin-figure")
    assert box.evaluate("e => e.scrollWidth > e.clientWidth") == (image["width"] > 374)
    page.set_viewport_size({"width": 1366, "height": 700})
    assert page.locator("img").bounding_box()["width"] == pytest.approx(
        fig.get_figwidth() * 100, abs=1
    )
    page.close()


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_shadow_marks_each_side_on_which_a_wide_figure_is_cut_off(browser, theme):
    fig = figure("An empty figure that is wide.", width=9, height=2)
    fig.text(0.5, 0.5, "word", fontsize=8)
    page = browser.new_page(viewport={"width": 390, "height": 700}, color_scheme=theme)
    page.set_content(f"{VIEWPORT}<body>{made(fig)}</body>")
    box = page.locator(".robokin-figure")

    def contrast():
        """Whether the left edge and the right edge contrast with the middle."""
        page.wait_for_timeout(100)
        shot = np.asarray(Image.open(io.BytesIO(box.screenshot())).convert("L"), dtype=float)
        row = shot[20]
        return abs(row[1] - row[60]) > 25, abs(row[-2] - row[60]) > 25

    assert contrast() == (False, True)
    box.evaluate("e => e.scrollLeft = e.scrollWidth")
    assert contrast() == (True, False)
    box.evaluate("e => e.scrollLeft = e.scrollWidth / 4")
    assert contrast() == (True, True)
    page.set_viewport_size({"width": 1366, "height": 700})
    assert contrast() == (False, False)
    page.close()


# --- Notebooks that are handed in -----------------------------------------------------------------


def test_report_shows_the_figures_of_the_notebook_without_injected_code(figures):
    html = made(figures["own"])
    assert again(html, "nonce") == html
    alone = re.search(r"<img [^>]*>", html)[0]  # the form that older notebooks contain
    older = re.sub(r'style="[^"]*" ', "", alone)
    assert "min-width:900px" in again(older, "nonce") and "robokin-figure" in again(older, "nonce")
    evil = html.replace("<style>", "<style>@import url(https://example.org/x.css);")
    assert again(evil, "nonce") == html
    inside = made(figures["postures"])
    assert "robokin-spatial" in inside and again(inside, "nonce") == inside
    assert "robokin-spatial" not in html
    assert again(html.replace('style="', 'style="position:fixed;'), "nonce") == html
    assert again(html + "<script>alert(1)</script>", "nonce") is None
