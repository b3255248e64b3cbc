"""Choices that remain valid when the order of the options changes."""

import pytest

from robokin.course import book
from robokin.course.guesses import CHOICE
from robokin.course.predictions import chosen
from robokin.course.questions import LETTERS, chosen_option, filled, prediction

NAME = "puma560_branches.p2"


def test_option_name_takes_precedence_over_its_letter():
    found = book.find(NAME, "predictions")
    _, options, right = filled(found)
    for k, option in enumerate(options):
        for letter in LETTERS[: len(options)]:
            made = f"{letter}: {option.name}"
            assert CHOICE.fullmatch(made) and chosen_option(found, options, right, made) == k
            assert chosen(NAME, made) == f"{LETTERS[k]}) {option.text}"
            assert chosen_option(found, options, right, f"{letter}: gone") == LETTERS.index(letter)
            assert chosen_option(found, options, right, letter) == LETTERS.index(letter)
    for wrong in ("z", "", ": ", "z: gone", 1, None):
        with pytest.raises(ValueError, match="choice: wanted one of a, b, c, d"):
            chosen_option(found, options, right, wrong)
        assert not isinstance(wrong, str) or chosen(NAME, wrong) == wrong


def test_a_line_may_end_inside_the_name_of_a_fact():
    text = (
        "It turns by {at the\nstop:.1f}°.\n\n- `one` **{at\n  the stop:.1f}** Right.\n"
        "- `two` **Two.** No. *You swapped them:* Then it would be {at the\n  stop:.0f}.\n"
    )
    code = {"p1": lambda: {"at the stop": 12.34, "right": "one"}}
    _, asked = prediction("a.md", 1, "p1", text, code)
    question, options, right = filled(asked)
    assert question == "It turns by 12.3°." and right == 0
    assert options[0].text == "12.3" and options[1].second == "Then it would be 12."
