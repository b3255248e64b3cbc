"""Choices that remain valid when the order of the options changes."""

import pytest

from robokin.course import book
from robokin.course.guesses import CHOICE
from robokin.course.predictions import chosen
from robokin.course.questions import LETTERS, Option, Prediction, chosen_option, filled

NAME = "puma560_branches.p2"


def test_option_name_takes_precedence_over_its_letter():
    prediction = book.find(NAME, "predictions")
    _, options, right = filled(prediction)
    for k, option in enumerate(options):
        for letter in LETTERS[: len(options)]:
            made = f"{letter}: {option.name}"
            assert CHOICE.fullmatch(made) and chosen_option(prediction, options, right, made) == k
            assert chosen(NAME, made) == f"{LETTERS[k]}) {option.text}"
            assert chosen_option(prediction, options, right, f"{letter}: gone") == LETTERS.index(
                letter
            )
            assert chosen_option(prediction, options, right, letter) == LETTERS.index(letter)
    for wrong in ("z", "", ": ", "z: gone", 1, None):
        with pytest.raises(ValueError, match="choice: wanted one of a, b, c, d"):
            chosen_option(prediction, options, right, wrong)
        assert not isinstance(wrong, str) or chosen(NAME, wrong) == wrong


def test_a_line_may_end_inside_the_name_of_a_fact():
    whole = "It turns by {at the stop:.1f}°."
    for written in (
        whole,
        whole.replace("the stop", "the\n  stop"),
        whole.replace("{at ", "{at\n"),
    ):
        asked = Prediction(
            question=written,
            options=[Option(written, written, None, written, "one")],
            facts=lambda: {"at the stop": 12.34},
            right=lambda facts: 0,
        )
        question, [option], right = filled(asked)
        assert right == 0 and option.confusion is None
        assert {question, option.text, option.reason, option.second} == {"It turns by 12.3°."}
