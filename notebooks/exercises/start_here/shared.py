"""Code that exercises and predictions of this lab share."""

from typing import Any

from robokin import IRB140, mm


def place(q: Any) -> Any:
    """The position of the flange, in mm."""
    return IRB140.fk(q).translation / mm


def minus(text: str) -> str:
    return text.replace("-", "\N{MINUS SIGN}")
