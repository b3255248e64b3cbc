"""What a report says, read from its page and validated: anybody can edit a report."""

import json
from datetime import datetime
from typing import Any

from .book import lab

DATA = '<script type="application/json" id="robokin-report">'
STATES = ("holds", "does not hold", "unanswered", "failed", "not judged")


def report_data(text: str) -> dict[str, Any] | None:
    """What the page of a report says; None: it is no report. ValueError: it is a broken one."""
    start = text.find(DATA)
    if start < 0:
        return None
    try:
        data, _ = json.JSONDecoder().raw_decode(text, start + len(DATA))
        good = (
            data["report"] == 2
            and all(isinstance(data[n], str) for n in ("who", "title", "file", "numbers"))
            and datetime.fromisoformat(data["made"]).tzinfo is not None
            and (data["lab"] is None or lab(data["lab"]))
            and all(map(_is_exercise, data["exercises"]))
            and all(map(_is_prediction, data["predictions"]))
            and all(isinstance(remark, str) for remark in data["remarks"])
            and isinstance(data["guesses_came"], bool)
        )
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise ValueError(f"a report that cannot be read: {type(error).__name__}: {error}") from None
    if not good:
        raise ValueError("a report that cannot be read: its data are not what a report has")
    found: dict[str, Any] = data
    return found


def _is_exercise(each: dict[str, Any]) -> bool:
    return (
        all(isinstance(each[n], str) for n in ("id", "task"))
        and each["state"] in STATES
        and isinstance(each["objective"], int)
        and isinstance(each["points"], (int, float))
        and 0 <= each["points"] <= 1
        and all(each[n] is None or isinstance(each[n], str) for n in ("mistake", "case"))
        and all(isinstance(line, str) for line in each["says"])
    )


def _is_prediction(each: dict[str, Any]) -> bool:
    return (
        isinstance(each["id"], str)
        and each["right"] in (None, True, False)
        and all(each[n] is None or isinstance(each[n], str) for n in ("choice", "confusion"))
        and (each["when"] is None or datetime.fromisoformat(each["when"]).tzinfo is not None)
        and all(isinstance(guess, str) for guess in each["later"])
    )
