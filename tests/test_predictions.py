"""Predictions: the text of a page before and after each choice. Choices are made by mouse and by
keyboard, typed, remembered, and printed in the notebook.
"""

import re
from dataclasses import replace

import numpy as np
import pytest
import test_browser
from axe_playwright_python.sync_playwright import Axe
from conftest import awake, until
from playwright.sync_api import expect

from robokin import IRB140, deg
from robokin.course import book
from robokin.course.predictions import ASLEEP, UNGUESSED, Asked
from robokin.course.questions import Option, Prediction, filled
from robokin.show import animate, figure

REASON = "Half the distance costs 12.5 units."


def words(view=lambda: "The view opens.\nIt has two lines."):
    return Prediction(
        question="What does half the distance cost? It is {now:.1f} now.",
        options=(
            Option("the same", "It does not.", "distance does not matter", "At a tenth it is {x}."),
            Option("twice as much", "Half the distance costs {cost} units."),
            Option(
                "half as much", "It goes the other way.", "in proportion", "At double it is {x}."
            ),
        ),
        facts=lambda: {"now": 6.25, "cost": 6.25 * 2, "x": 99},
        right=lambda facts: int(facts["cost"] > facts["now"]),
        view=view,
    )


TYPED = Prediction(
    question="How long is it?",
    options=(
        Option("{half:.0f}", "You took the radius.", "radius for diameter", "A ball of 10 is 20."),
        Option("{whole:.0f}", "Twice the radius."),
        Option("{long:.0f}", "You took the way round.", "way round", "Round it is more."),
    ),
    facts=lambda: {"half": 100, "whole": 200.0, "long": 628.3},
    right=lambda facts: 1,
    view=lambda: "The view opens.",
    unit="mm",
    within=0.05,
)


page = test_browser.page


@pytest.fixture
def opened(browser, tmp_path):
    """`opened(asked, width)` opens a saved page with the question; the page must not
    report errors.
    """
    contexts, errors = [], []

    def made(asked, width=900, within=None, **options):
        context = within or browser.new_context(viewport={"width": width, "height": 800}, **options)
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda m: m.type == "error" and errors.append(m.text))
        page.on("pageerror", lambda error: errors.append(str(error)))
        # pages that share a browser's storage need the same address
        path = tmp_path / ("one.html" if within else f"{len(contexts)}.html")
        asked.save(path)
        page.goto(path.as_uri())
        if options.get("java_script_enabled", True):
            awake(page)
        return page

    yield made
    for context in contexts:
        context.close()
    assert errors == []


def seen(page):
    return page.locator(".robokin-player").first.inner_text()


def guess(page):
    return page.get_by_role("button", name="This is my guess")


@pytest.mark.parametrize("width", [900, 390])
@pytest.mark.parametrize("k", range(3))
def test_every_option_can_be_chosen_and_gets_a_reply(opened, k, width):
    asked = Asked("made.p1", words(), None)
    page = opened(asked, width)
    before = seen(page)
    assert "It is 6.2 now." in before and "twice as much" in before
    for hidden in ("view opens", REASON, "No: ", "in proportion", "99"):
        assert hidden not in before, "a part of the reply is shown before the choice"
    assert guess(page).is_disabled()
    page.get_by_label(f"{'abc'[k]})").check()
    assert "view opens" not in seen(page), "a choice is not yet a guess"
    guess(page).click()
    after = seen(page)
    assert REASON in after and "view opens" in after and "It has two lines." in after
    option = asked.options[k]
    assert option.reason in after and "Saved in this browser only." in after
    assert "predict(" not in after, "the reply must not suggest editing a folded cell"
    assert ("No: " in after) == (k != 1) and ("Right." in after) == (k == 1)
    if k != 1:
        assert option.confusion in after and option.second in after
        assert "The right answer is b) twice as much." in after
    rows = page.locator(".rk-option").all_inner_texts()
    assert [("right" in row, "your guess" in row) for row in rows] == [
        (i == 1, i == k) for i in range(3)
    ]
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_questions_can_be_answered_by_keyboard_alone(opened):
    page = opened(Asked("made.p1", words(), None))
    page.keyboard.press("Tab")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Enter")
    assert "No: in proportion." in seen(page)
    assert page.evaluate("document.activeElement.textContent") == "Ask me again"
    page.keyboard.press("Enter")
    assert "view opens" not in seen(page) and guess(page).is_disabled()
    page.keyboard.press("Space")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    assert "No: distance does not matter." in seen(page)


@pytest.mark.parametrize(
    ("typed", "says"),
    [
        ("200", "Right. Twice the radius."),
        ("191", "Right."),
        ("98", "No: radius for diameter."),
        ("640", "No: way round."),
        ("-5", "No."),
        ("0", "The right answer is 200 mm."),
    ],
)
def test_page_and_notebook_judge_numbers_identically(opened, typed, says):
    page = opened(Asked("made.p2", TYPED, None))
    assert "100" not in seen(page) and "200" not in seen(page)
    page.get_by_label("your guess, mm").fill(typed)
    guess(page).click()
    assert says in seen(page)
    assert says in repr(Asked("made.p2", TYPED, float(typed)))


def test_page_remembers_and_forgets_choices(opened, browser):
    context = browser.new_context()
    asked = Asked("made.p1", words(), None)
    page = opened(asked, within=context)
    page.get_by_label("c)").check()
    guess(page).click()
    assert "You guessed here before" not in seen(page)
    again = opened(asked, within=context)
    assert "No: in proportion." in seen(again) and "view opens" in seen(again)
    assert "You guessed here before. Saved in this browser only." in seen(again)
    again.get_by_role("button", name="Ask me again").click()
    again.get_by_label("b)").check()
    guess(again).click()
    assert "before" not in seen(again)
    later = opened(asked, within=context)
    assert "Right." in seen(later)
    later.get_by_role("button", name="Clear").click()
    assert "view opens" not in seen(later) and "view opens" not in seen(
        opened(asked, within=context)
    )


def test_page_works_when_storage_is_forbidden(opened, browser):
    context = browser.new_context()
    context.add_init_script(
        "Object.defineProperty(window, 'localStorage', {get() { throw new Error('no'); }});"
    )
    page = opened(Asked("made.p1", words(), None), within=context)
    page.get_by_label("b)").check()
    guess(page).click()
    assert REASON in seen(page) and "Saved on this page only." in seen(page)


def test_question_can_occur_twice_in_a_page(opened):
    """The script runs a second time, as it does in JupyterLab after "New View for Cell Output"."""
    asked = Asked("made.p1", words(), None)
    page = opened(asked)
    page.evaluate(
        "html => document.body.append(document.createRange().createContextualFragment(html))",
        asked.html,
    )
    asks = page.locator(".rk-ask")
    until(lambda: asks.count() == 2, "the question does not appear a second time", page)
    one, other = asks.all()
    one.get_by_label("a)").check()
    other.get_by_label("c)").check()
    assert one.get_by_label("a)").is_checked() and other.get_by_label("c)").is_checked()
    guess(one).click()
    assert "No: distance does not matter." in one.inner_text()
    assert "No: " not in other.inner_text() and other.get_by_label("c)").is_checked()


def test_choice_in_the_notebook_opens_the_view_at_once(opened):
    asked = Asked("made.p1", words(), "a")
    page = opened(asked)
    text = seen(page)
    for line in repr(asked).split("\n")[-2:]:
        assert line in text
    assert "Your choice: a." in repr(asked) and "view opens" in text
    assert not page.get_by_role("button").count() and "For your report" not in text
    right = Asked("made.p1", words(), "b")
    assert repr(right).endswith(f"Right. {REASON}")


def test_a_view_can_be_a_figure_or_a_player(opened):
    t = np.linspace(0, 2, 41)
    q = t[:, None] * deg * np.array([45, 30, -30, 20, 10, 5])
    fig = figure("An empty figure with a long alternative text for the reader.", 6, 2)
    for made in (fig, animate(IRB140, t, q, title="A turn")):
        page = opened(Asked("made.p1", words(lambda made=made: made), None))
        assert page.locator("img, canvas").filter(visible=True).count() == 0
        page.get_by_label("b)").check()
        guess(page).click()
        if made is fig:
            assert page.locator("img").get_attribute("alt") == fig.alt
        else:
            page.locator(".rk-scene").wait_for()
            page.get_by_label("time", exact=True).fill("200")
            expect(page.locator(".rk-ask .rk .rk-value").first).to_have_text("1.00 s")
            # the style of a player does not affect the question
            again = page.get_by_role("button", name="Ask me again").bounding_box()
            assert again["width"] > 100 and 30 < again["height"] < 50


def test_page_without_scripts_shows_the_question(opened):
    page = opened(Asked("made.p1", words(), None), java_script_enabled=False)
    text = seen(page)
    assert "It is 6.2 now." in text and "c) half as much" in text and ASLEEP in text
    assert "view opens" not in text and REASON not in text


def moving():
    t = np.linspace(0, 2, 41)
    q = t[:, None] * deg * np.array([45, 30, -30, 20, 10, 5])
    return animate(IRB140, t, q, title="A turn")


@pytest.mark.parametrize("asked", [words(moving), TYPED], ids=["letters", "number"])
def test_answer_can_be_shown_without_a_guess_and_a_guess_can_follow(opened, asked):
    """The control for the answer does not record a guess, and "Ask me again" shows it again."""
    asked = Asked("made.p1", asked, None)
    page = opened(asked)
    page.get_by_text(UNGUESSED).focus()
    page.keyboard.press("Enter")
    awake(page)
    right = asked.options[asked.right]
    assert right.reason in seen(page) and "your guess" not in seen(page)
    assert page.evaluate("localStorage.length") == 0 and page.get_by_role(
        "status"
    ).all_inner_texts() == [""]
    if asked.unit is None:
        page.locator(".rk-scene").wait_for()
        page.get_by_label("c)").check()
    else:
        page.get_by_label("your guess").fill("100")
    guess(page).click()
    assert seen(page).count(right.reason) == 1 and "No: " in seen(page)
    assert not page.get_by_text(UNGUESSED).is_visible()
    assert page.locator(".rk-scene").count() == (asked.unit is None), "the view has moved"
    page.get_by_role("button", name="Ask me again").click()
    assert right.reason not in seen(page) and page.get_by_text(UNGUESSED).is_visible()


@pytest.mark.parametrize("scripts", [True, False])
def test_answer_and_picture_are_printed(opened, scripts):
    page = opened(Asked("made.p1", words(moving), None), java_script_enabled=scripts)
    # in print layout the view is visible, so Chromium may start it before it prints the page
    picture = page.locator(".robokin-view").locator("img, .rk-scene").first
    assert not picture.is_visible() and not page.get_by_text(REASON).is_visible()
    page.emulate_media(media="print")
    expect(picture).to_be_visible()
    assert page.get_by_text(REASON).is_visible() and page.get_by_text("half as much").is_visible()


def test_a_guessed_number_is_printed(opened):
    page = opened(Asked("made.p2", replace(TYPED, view=moving), None))
    field = page.get_by_label("your guess, mm")
    field.fill("100")
    guess(page).click()
    page.locator(".rk-scene").wait_for()  # a player hides its own fields on paper
    page.emulate_media(media="print")
    assert field.is_visible() and field.input_value() == "100"


def test_focus_stays_on_the_control_for_the_answer_when_the_question_starts(browser, tmp_path):
    """The Tab key reaches the control of a question that is far down the page, and the question's
    script starts only then.
    """
    path = tmp_path / "far.html"
    Asked("made.p1", words(), None).save(path)
    far = re.sub("(<body[^>]*>)", r'\1<div style="height:5000px"></div>', path.read_text())
    path.write_text(far)
    page = browser.new_page()
    page.goto(path.as_uri())
    assert page.locator(".rk-ask").count() == 0
    page.keyboard.press("Tab")
    page.locator(".rk-ask").wait_for()
    assert page.evaluate("document.activeElement.textContent") == UNGUESSED
    page.keyboard.press("Enter")
    expect(page.get_by_text(REASON)).to_be_visible()
    page.close()


def test_answer_can_be_shown_without_scripts(opened):
    page = opened(Asked("made.p1", words(moving), None), java_script_enabled=False)
    page.get_by_text(UNGUESSED).click()
    assert page.locator("img").is_visible() and REASON in seen(page)
    html = Asked("made.p1", words(moving), None).html
    assert html.count(moving().text) == 1 and html.count("data:image/png") == 1


def test_question_with_a_choice_has_no_control_for_the_answer(opened):
    page = opened(Asked("made.p1", words(moving), "a"))
    awake(page)
    assert page.get_by_text(UNGUESSED).count() == 0 and page.locator(".rk-scene").is_visible()
    assert seen(page).count(REASON) == 1


def test_markup_is_escaped(opened):
    asked = Prediction(
        question="Is 1 < 2 & <b>3</b>?",
        options=(Option("<i>yes</i>", "</script>"), Option("no", "a", "b", "c")),
        facts=dict,
        right=lambda facts: 0,
    )
    page = opened(Asked("made.p1", asked, None))
    assert "Is 1 < 2 & <b>3</b>?" in seen(page) and "<i>yes</i>" in seen(page)
    page.get_by_label("a)").check()
    guess(page).click()
    assert "</script>" in seen(page)


# the kinds and sources of a cell and of the cells before and after it
ASKS = "Which joints move at a constant speed?"  # in irb140_motion.p1, whose code is folded
NEIGHBOURS = """cell => [cell.previousElementSibling, cell, cell.nextElementSibling].map(e =>
  e && [e.classList.contains("jp-CodeCell"),
        e.querySelector(".jp-InputArea")?.innerText.slice(0, 80)])"""


def test_question_in_jupyterlab_works_and_its_keys_trigger_no_notebook_commands(jupyter, page):
    """The notebook is trusted and has never run: the question works by keyboard, and none of its
    keys triggers a notebook command.
    """
    name = test_browser._variant(jupyter, "asked.ipynb")
    jupyter.trust(name)
    jupyter.open(page, name)
    cell = page.locator(".jp-CodeCell").filter(has_text=ASKS)
    cell.scroll_into_view_if_needed()
    question = cell.locator(".rk-ask")
    question.wait_for()
    beside = [cell.evaluate(NEIGHBOURS)]
    first = question.locator("input[type=radio]").first
    first.focus()
    for key in ("b", "a", "x", "d", "d", "m", "z"):
        page.keyboard.press(key)
    page.keyboard.press("ArrowDown")
    page.keyboard.press("ArrowUp")
    assert "limits" not in question.locator(".rk-answer").inner_text()
    page.keyboard.press("Enter")
    expect(question.locator(".rk-answer")).to_contain_text("inverse kinematics is not linear")
    question.locator(".rk-answer").scroll_into_view_if_needed()  # a view starts near the screen
    question.locator(".rk-answer canvas").wait_for()
    beside.append(cell.evaluate(NEIGHBOURS))
    assert beside[0] == beside[1] and beside[0][1] and first.is_visible(), (
        "a cell was added or removed"
    )
    assert page.errors == [] and page.outside == []


def test_untrusted_question_in_jupyterlab_explains_how_to_answer(jupyter, page):
    name = test_browser._variant(jupyter, "not_asked.ipynb")
    jupyter.open(page, name)
    cell = page.locator(".jp-CodeCell").filter(has_text=ASKS)
    cell.scroll_into_view_if_needed()
    cell.get_by_text(ASLEEP).wait_for()
    text = cell.inner_text()
    assert "d) None of them: a straight line" in text
    assert "The inverse kinematics is not linear" not in text
    assert cell.locator(".rk-ask").count() == 0 and page.errors == []


@pytest.mark.parametrize("lab", ["02_irb140_kinematics", "03_irb140_motion"])
def test_questions_of_an_exported_lab_work_on_a_phone(browser, exported, lab):
    """The page is opened from a file at a width of 390 px and operated by touch; then every
    question is answered again by keyboard.
    """
    context = browser.new_context(viewport={"width": 390, "height": 844}, has_touch=True)
    page = context.new_page()
    page.route(re.compile("^https?:"), lambda route: route.abort())
    page.goto(exported[lab].as_uri())
    awake(page)
    questions = page.locator(".rk-ask")
    questions.first.wait_for()
    assert questions.count() == len(book.lab(lab[3:]).predictions)
    for question in questions.all():
        answer = question.locator(":scope > .rk-answer")
        typed = question.locator("fieldset input[type=number]")
        if typed.count():
            typed.tap()
            typed.fill("3")
        else:
            question.locator(".rk-option").last.tap()
        question.get_by_role("button", name="This is my guess").tap()
        assert "ight" in answer.inner_text()
        assert question.bounding_box()["width"] <= 390
        assert answer.evaluate("e => e.scrollWidth <= e.clientWidth + 1")
        question.get_by_role("button", name="Ask me again").press("Enter")
        assert answer.inner_text() == ""
        field = question.locator("fieldset input").first
        field.press("3" if typed.count() else "Space")
        field.press("Enter")
        assert "ight" in answer.inner_text()
    context.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_no_serious_problems(opened, scheme):
    for choice, is_opened in ((None, False), (None, True), ("a", False)):
        page = opened(Asked("made.p1", words(), choice), color_scheme=scheme)
        page.locator(".rk-ask").wait_for()
        if is_opened:
            page.get_by_text(UNGUESSED).click()
        found = Axe().run(page, context=".rk").response["violations"]
        assert [
            (r["id"], r["nodes"][0]["html"][:100], r["nodes"][0].get("failureSummary", "")[:300])
            for r in found
            if r["impact"] in ("serious", "critical")
        ] == []


def test_invalid_choices_are_refused():
    for prediction, choice in ((words(), "d"), (words(), ""), (words(), 1), (TYPED, "b")):
        with pytest.raises(ValueError, match="choice: wanted"):
            Asked("made.p1", prediction, choice)
    question, options, right = filled(words())
    assert right == 1 and options[1].reason == REASON and "6.2" in question
