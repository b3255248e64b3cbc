"""Read the data of a report from its page and validate them, since anybody can edit a report, and
it contains the results of a student's code.

Validated data contain only ids of the lab's own exercises and predictions; an exercise's task and
objective come from robokin. Every text has a limited length, and invisible characters are written
as escapes, so that no text can contain hidden characters, break a line of a table or change the
direction of writing. The texts are still untrusted, and a page must escape them.
"""

import json
from collections.abc import Callable
from datetime import datetime
from typing import Any

from .._validate import short
from .book import MORE, find, home, ids, labs
from .texts import visible
from .variants import normalised

DATA = '<script type="application/json" id="robokin-report">'
STATES = ("holds", "does not hold", "unanswered", "failed", "not judged")
# maximum number of characters in a name, in a line and in a multi-line text
NAME, LINE, TEXT = 200, 2_000, 20_000
MANY = 200  # maximum number of entries in a list
YEAR_3000 = 32_503_680_000  # seconds; some systems cannot represent later times
JOINERS = "\u200c\u200d"  # invisible characters that names in Persian or Hindi need


def report_data(text: str) -> dict[str, Any] | None:
    """Return the data in the page of a report, or None if it is not a report. Raises ValueError if
    it is a broken report.
    """
    start = text.find(DATA)
    if start < 0:
        return None
    if not text.rstrip().endswith("</html>"):
        raise ValueError("a report that cannot be read: it is truncated")
    try:
        data, _ = json.JSONDecoder().raw_decode(text, start + len(DATA))
        return validated(data)
    except RecursionError:
        reason = "its data are nested too deeply"
    except ValueError as error:
        reason = str(error)
    raise ValueError(f"a report that cannot be read: {reason}")


def validated(data: Any) -> dict[str, Any]:
    """Return a report's data in the form of version 2; version 1 lacks later guesses and the times
    of guesses. Raises ValueError if they are not the data of a report.
    """
    if not isinstance(data, dict) or data.get("report") not in (1, 2):
        raise ValueError("its data are not in a format that this version of robokin knows")
    old, slug = data["report"] == 1, data.get("lab")
    if slug is not None and not (isinstance(slug, str) and slug in labs()):
        raise ValueError(f"lab: wanted the name of a known lab, got {short(slug)}. {MORE}")
    who = _text(data, "who", TEXT)
    if len(who) > NAME:
        raise ValueError(f"who: wanted at most {NAME} characters, got {len(who)}")
    normalised(who.strip(JOINERS))  # raises ValueError if nothing is visible
    guesses = _known(data, slug, "predictions", lambda each: _prediction(each, old))
    return {
        "report": 2,
        "who": who,
        "lab": slug,
        "title": _text(data, "title", NAME),
        "file": _text(data, "file", 2 * NAME),
        "made": _time(data, "made"),
        "robokin": _text(data, "robokin", NAME),
        "numbers": _text(data, "numbers", TEXT, "\n"),
        "exercises": _known(data, slug, "exercises", _exercise),
        "predictions": guesses,
        "remarks": _texts(data, "remarks"),
        "guesses_came": any(each["choice"] for each in guesses)
        if old
        else _one_of(data, "guesses_came", (True, False)),
    }


def counted(data: dict[str, Any]) -> list[dict[str, Any]]:
    """The predictions that a report must list; an optional one is listed if it was made."""
    return [
        each
        for each in data["predictions"]
        if each["choice"] is not None or not find(each["id"], "predictions").optional
    ]


def _exercise(each: dict[str, Any]) -> dict[str, Any]:
    exercise = find(each["id"], "exercises")
    points: Any = each.get("points")
    if type(points) not in (int, float) or not 0 <= points <= 1:  # NaN fails this
        raise ValueError(f"points: wanted a number from 0 to 1, got {short(points)}")
    return {
        "id": each["id"],
        "task": exercise.task,
        "objective": exercise.objective,
        "state": _one_of(each, "state", STATES),
        "mistake": _text_or_none(each, "mistake"),
        "says": _texts(each, "says", "\n"),
        "case": _text_or_none(each, "case", TEXT, "\n"),
        "points": float(points),
    }


def _prediction(each: dict[str, Any], old: bool) -> dict[str, Any]:
    choice, right = _text_or_none(each, "choice"), _one_of(each, "right", (None, True, False))
    if (choice is None) != (right is None):
        wanted = "None if there is no choice, otherwise True or False"
        raise ValueError(f"right: wanted {wanted}, got {right} for the choice {short(choice)}")
    return {
        "id": each["id"],
        "choice": choice,
        "right": right,
        "confusion": _text_or_none(each, "confusion"),
        "when": None if old or each.get("when") is None else _time(each, "when"),
        "later": [] if old else _texts(each, "later"),
    }


def _known(
    data: dict[str, Any],
    slug: str | None,
    what: str,
    checked: Callable[[dict[str, Any]], dict[str, Any]],
) -> list[dict[str, Any]]:
    """Return the entries for the lab's exercises or predictions, in the order of the lab. If an
    older report contains predictions that have since moved to another lab, those with a guess come
    last.
    """
    known = ids(slug, what) if slug else []
    found: dict[str, dict[str, Any]] = {}
    for each in _list(data, what):
        name = each.get("id") if isinstance(each, dict) else None
        if not isinstance(name, str) or name in found or not _belongs(name, slug, what):
            raise ValueError(f"{what}: wanted each id of the lab {slug} once, got {short(name)}")
        try:
            found[name] = checked(each)
        except ValueError as error:
            raise ValueError(f"{name}: {error}") from None
    late = [name for name in found if name not in known and found[name]["choice"] is not None]
    return [found[name] for name in [*known, *late] if name in found]


def _belongs(name: str, slug: str | None, what: str) -> bool:
    """Return whether an exercise or a prediction belongs to a lab, or did before it moved."""
    own, from_here = home(name), name.startswith(f"{slug}.")
    return own in labs() and (own == slug or from_here) and name in ids(own, what)


def _one_of(data: dict[str, Any], name: str, known: tuple[Any, ...]) -> Any:
    value = data.get(name)
    if not any(value is each or (isinstance(value, str) and value == each) for each in known):
        raise ValueError(f"{name}: wanted one of {', '.join(map(str, known))}, got {short(value)}")
    return value


def _list(data: dict[str, Any], name: str) -> list[Any]:
    value = data.get(name)
    if not isinstance(value, (list, tuple)):
        raise ValueError(f"{name}: wanted a list, got {short(value)}")
    if len(value) > MANY:
        raise ValueError(f"{name}: wanted at most {MANY} entries, got {len(value)}")
    return list(value)


def _texts(data: dict[str, Any], name: str, ends: str = "") -> list[str]:
    return [_text({name: each}, name, LINE, ends) for each in _list(data, name)]


def _text_or_none(data: dict[str, Any], name: str, most: int = LINE, ends: str = "") -> str | None:
    return None if data.get(name) is None else _text(data, name, most, ends)


def _text(data: dict[str, Any], name: str, most: int, ends: str = "") -> str:
    value = data.get(name)
    if not isinstance(value, str):
        raise ValueError(f"{name}: wanted a string, got {short(value)}")
    return visible(value, ends, most)


def _time(data: dict[str, Any], name: str) -> str:
    """A date and time with its UTC offset, in the form that `datetime` writes."""
    try:
        when = datetime.fromisoformat(data.get(name, ""))
        good = when.tzinfo is not None and 0 <= when.timestamp() < YEAR_3000
    except (TypeError, ValueError, OverflowError):
        good = False
    if not good:
        raise ValueError(f"{name}: wanted a date with a UTC offset, got {short(data.get(name))}")
    return when.isoformat()
