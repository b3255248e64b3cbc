"""Guesses from a page: while a kernel is running, a student's guesses are saved next to the
notebook, in `.robokin/guesses.json`, and a report reads them there.

    {"guesses": 1, "notebooks": {"03_irb140_motion.ipynb": {"irb140_motion.p1":
        [["b: joint 3", time]]}}}

A choice is a number, or a letter with the name of the option; the name remains valid if the options
are reordered.

Each kernel has one widget without a view, which receives guesses from the page (js/guesses.js) and
confirms each of them. The notebook does not store this widget.
"""

import ast
import contextlib
import json
import os
import re
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from .._validate import short
from .book import find, home, ids, lab_of
from .copies import alone, write
from .predictions import worked_out
from .questions import chosen_option

if TYPE_CHECKING:
    from .handed_in import HandedIn

FOLDER, FILE = ".robokin", "guesses.json"
LARGE = 1_000_000  # maximum number of bytes in a file of guesses; usually there are a few thousand
NAME = re.compile(r"\w{1,60}\.p[0-9]{1,3}", re.ASCII)
IN_LINE = re.compile(r"(?:\w{1,60}\.)?p[0-9]{1,3}", re.ASCII)
CHOICE = re.compile(r"[a-f](?:: [^\r\n]{1,60})?|[-+.eE0-9]{1,30}")  # "b", "b: joint 3", "-290"
ASKED = re.compile(rb"""predict\(\s*\\?["'](\w{1,60}\.p[0-9]{1,3})""")  # a call in a notebook
PATIENCE = 10  # seconds to wait for another kernel that is writing

Kept: TypeAlias = dict[str, list[tuple[str, str | None]]]  # guesses and times by prediction


def read_guesses(path: Path) -> Kept | None:
    """The saved guesses for the notebook at `path`: {prediction: [(choice, time), ...]}, in
    chronological order; None if there are none. The guesses of a renamed notebook are found, too.

    Raises ValueError if the file cannot be used.
    """
    try:
        notebooks = _stored(path.parent / FOLDER / FILE)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise ValueError(f"{FOLDER}/{FILE} cannot be used: {reason}") from None
    kept = notebooks.get(_name(notebooks, path), {})
    return {name: made for name, made in kept.items() if _known(name)} or None


def keep(path: Path, made: Iterable[tuple[str, str, str]]) -> None:
    """Add guesses (prediction, choice, time) to those saved for the notebook at `path`, without
    duplicates. An unreadable file is renamed and kept.

    Raises ValueError if the file is full or another kernel does not stop writing, and OSError if,
    for example, permission is missing.
    """
    own = path.parent / FOLDER
    own.mkdir(exist_ok=True)
    file = own / FILE
    with alone(own / "guesses.lock", PATIENCE):
        try:
            notebooks = _stored(file)
        except ValueError:
            os.rename(file, _free(own))
            notebooks = {}
        before = json.dumps(notebooks, sort_keys=True)
        kept = notebooks.setdefault(path.name, notebooks.pop(_name(notebooks, path), {}))
        for name, choice, time in made:
            guesses = kept.setdefault(name, [])
            when = _moment(time)
            if all((choice, when) != (c, _moment(t)) for c, t in guesses):
                guesses.append((choice, _written(when.astimezone())))
            guesses.sort(key=lambda guess: _moment(guess[1]))
        if json.dumps(notebooks, sort_keys=True) == before:
            return
        text = json.dumps({"guesses": 1, "notebooks": notebooks}, indent=1, sort_keys=True) + "\n"
        if len(text) > LARGE:
            raise ValueError(f"{FOLDER}/{FILE} is full")
        write(own / "guesses.new", text.encode())
        os.replace(own / "guesses.new", file)


def parse_line(text: str) -> dict[str, str]:
    """Parse the line copied from a page: "p1 b, p3 a, p5 -290" gives {"p1": "b", ...}, in order. A
    prediction from another lab is written with its full id. Raises ValueError if the format is
    wrong, and TypeError if the argument is not a string.
    """
    if not isinstance(text, str):
        raise TypeError(f"guesses: wanted the line copied from a page, got {short(text)}")
    found: dict[str, str] = {}
    for part in text.split(",") if text.strip() else ():
        number, _, choice = part.strip().partition(" ")
        choice = choice.strip()
        if not IN_LINE.fullmatch(number) or not CHOICE.fullmatch(choice):
            raise ValueError(f'guesses: wanted choices such as "p1 b, p5 -290", got {short(part)}')
        if number in found:
            raise ValueError(f"guesses: wanted one choice for each prediction, got {number} twice")
        found[number] = choice
    return found


# --- Results of guesses ---------------------------------------------------------------------------


@dataclass(frozen=True)
class Guess:
    """The result of a prediction.

    choice  the first guess, which is the one that counts; None if no guess was made (then `right`
            is None, too)
    when    its time, if known
    later   the later guesses, in order
    """

    id: str
    choice: str | None = None
    right: bool | None = None
    confusion: str | None = None
    when: str | None = None
    later: tuple[str, ...] = ()


def guesses(handed: "HandedIn", remarks: list[str] | None = None) -> tuple[Guess, ...]:
    """Return the results of the predictions of the notebook's lab without running any code. Guesses
    saved by a kernel come first, then those in the line copied from a page, then the choice in the
    cell. If an older notebook contains predictions that have since moved to another lab, those with
    a guess come last. Unusable guesses are reported in `remarks`.
    """
    kept: Kept = {}
    pasted: dict[str, str] = {}
    remarks = [] if remarks is None else remarks
    try:
        kept = read_guesses(handed.path) or {}
    except ValueError as error:
        remarks.append(f"{error}.")
    try:
        pasted = parse_line(handed.guesses)
    except ValueError as error:
        remarks.append(f"{error}.")
    own = ids(handed.lab, "predictions") if handed.lab else []
    moved = [p for p in handed.asked if p.startswith(f"{handed.lab}.") and p not in own]
    made = []
    for name in [*own, *moved]:
        line, call = pasted.get(name.partition(".")[2], pasted.get(name)), handed.choices.get(name)
        others = [line, _literal(call.answer) if call else None]
        timeless = [(choice, None) for choice in others if choice is not None]
        guess = _guess(name, [*kept.get(name, ()), *timeless])
        made += [guess] if guess.choice is not None or name in own else []
    if handed.lab and not any(each.choice for each in made):
        remarks += _beside(handed.path, handed.lab)
    return tuple(made)


def _beside(path: Path, slug: str) -> list[str]:
    """The remark on a notebook without guesses if exactly one other notebook of its lab has some.
    We do not use those, since they may belong to another student or another attempt.
    """
    found = []
    with contextlib.suppress(OSError, ValueError):  # `remarks` already has the error
        for name, kept in _stored(path.parent / FOLDER / FILE).items():
            first = {p: made[0][0] for p, made in kept.items() if made and _known(p)}
            mine = {p.partition(".")[2]: c for p, c in first.items() if home(p) == slug}
            if mine and name != path.name:
                found.append((name, ", ".join(f"{number} {c}" for number, c in mine.items())))
    return [
        f"No guesses are saved for {path.name}, but some are for {name}, in the same folder. If "
        "they are yours, hand them in with the report cell of the lab: "
        f'report(who, guesses="{line}")'
        for name, line in found
        if len(found) == 1
    ]


def _literal(text: str) -> str:
    """A choice as written in a cell, without its quotes."""
    try:
        return str(ast.literal_eval(text))[:40]
    except (ValueError, TypeError, SyntaxError, MemoryError, RecursionError):
        return text[:40]


def _guess(name: str, made: Sequence[tuple[str, str | None]]) -> Guess:
    """The result of a prediction with these guesses and times. A guess without a time is listed
    only if no other guess is equal to it.
    """
    if not made:
        return Guess(name)
    choice, when = made[0]
    seen, later = {_value(choice)}, []
    for other, known in made[1:]:
        if known or _value(other) not in seen:
            later.append(other)
        seen.add(_value(other))
    guess = Guess(name, choice, False, "no choice that can be read", when, tuple(later))
    prediction = find(name, "predictions")
    _, options, right = worked_out(name)
    try:
        at = chosen_option(prediction, options, right, float(choice) if prediction.unit else choice)
    except (ValueError, TypeError):
        return guess
    if at == right:
        return replace(guess, right=True, confusion=None)
    return replace(guess, confusion=options[at].confusion if at >= 0 else None)


def _value(choice: str) -> str | float:
    try:
        return float(choice)  # 90 and 90.0 are equal
    except ValueError:
        return choice.partition(":")[0]  # "b" and "b: joint 3" are equal, too


# --- The file of guesses --------------------------------------------------------------------------


def _stored(file: Path) -> dict[str, Kept]:
    """The content of a file of guesses, by notebook; {} if there is none. Raises ValueError if it
    cannot be used.
    """
    if not os.path.lexists(file):
        return {}
    if not file.is_file():
        raise ValueError("it is not a regular file")
    with open(file, "rb") as opened:
        content = opened.read(LARGE + 1)
    if len(content) > LARGE:
        raise ValueError(f"it has more than {LARGE} bytes")
    try:
        data = json.loads(content)
        if data["guesses"] != 1:
            raise ValueError(f"guesses: wanted version 1, got {short(data['guesses'])}")
        return {
            str(notebook): {_id(name): _sorted(made) for name, made in kept.items()}
            for notebook, kept in data["notebooks"].items()
        }
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
        raise ValueError(f"{type(error).__name__}: {short(str(error))}") from None


def _sorted(made: list[list[str]]) -> list[tuple[str, str | None]]:
    guesses = sorted((_moment(time), _choice(choice)) for choice, time in made)
    return [(choice, _written(moment)) for moment, choice in guesses]


def _written(moment: datetime) -> str:
    return moment.isoformat(timespec="milliseconds")


def _id(name: Any) -> str:
    if not isinstance(name, str) or not NAME.fullmatch(name):
        raise ValueError(f"wanted a prediction, got {short(name)}")
    return name


def _choice(choice: Any) -> str:
    if not isinstance(choice, str) or not CHOICE.fullmatch(choice):
        raise ValueError(f"wanted a choice, got {short(choice)}")
    return choice


def _moment(time: Any) -> datetime:
    """Parse a time with its UTC offset. Raises ValueError if this is impossible."""
    try:
        moment = datetime.fromisoformat(time)
        moment.astimezone(UTC)
        if moment.tzinfo is not None:
            return moment
    except (ValueError, TypeError, OverflowError):
        pass
    raise ValueError(f"wanted a time with its UTC offset, got {short(time)}")


def _known(name: str) -> bool:
    with contextlib.suppress(ValueError):
        return bool(find(name, "predictions"))
    return False


def _name(notebooks: dict[str, Kept], path: Path) -> str:
    """Return the name under which the guesses of a notebook are stored: its own name or, if it was
    renamed, its previous name. The notebook counts as renamed if exactly one name with guesses
    belongs to the same lab, shares a prediction with the notebook, and is no longer a file.
    """
    if path.name in notebooks:
        return path.name
    gone = [name for name in notebooks if not os.path.lexists(os.path.join(path.parent, name))]
    content = path.read_bytes() if gone and path.is_file() else b""
    asked = {found.decode() for found in ASKED.findall(content)}
    mine = (name for name in gone if not asked.isdisjoint(notebooks[name]))
    own = [name for name in mine if lab_of(notebooks[name]) == lab_of(asked)]
    return own[0] if len(own) == 1 else path.name


def _free(folder: Path) -> Path:
    """A free name for an unreadable file."""
    n = 1
    while os.path.lexists(folder / f"guesses.broken{n}.json"):
        n += 1
    return folder / f"guesses.broken{n}.json"


# --- The widget that listens to the page ----------------------------------------------------------

_hub: Any = None  # the widget of this kernel


def listen() -> None:
    """Receive guesses from the page from now on, if this is the kernel of an open notebook."""
    global _hub
    own = own_notebook()
    if _hub is not None or own is None or "ROBOKIN_JUDGE" in os.environ:
        return
    with contextlib.suppress(Exception):  # a question also works without the widget
        from ..show.joiner import script
        from ..show.live import unseen

        page = f"{script('guesses')}\nexport default $guesses;"
        _hub = unseen(page, lambda model, message, _: model.send(_told(message, own)))


def own_notebook() -> Path | None:
    """The path of the notebook in which this code runs, with the name that it had when the kernel
    started. Jupyter's server and VS Code provide the path; programs that run a notebook without a
    page do not.
    """
    ipython = sys.modules.get("IPython")
    space = getattr(ipython.get_ipython() if ipython else None, "user_ns", {})
    name = space.get("__vsc_ipynb_file__") or os.environ.get("JPY_SESSION_NAME")
    return Path(name) if name and str(name).endswith(".ipynb") else None


def _told(message: Any, own: Path) -> dict[str, Any]:
    """Return the reply to a message from the page. The message is {"n": its number, "path": the
    notebook's path in the page, or None, "guesses": [[prediction, choice, time], ...]}. The reply
    contains the saved first guess at each of these predictions, since it may come from another
    browser.
    """
    try:
        made = [(_id(name), _choice(choice), time) for name, choice, time in message["guesses"]]
        path = _called(message["path"], own)
        keep(path, made)
        saved = read_guesses(path) or {}
        first = {name: saved[name][0][0] for name, _, _ in made if name in saved}
    except Exception as error:  # the page shows the error; here, it would go unnoticed
        reason = getattr(error, "strerror", None) or error
        return {"n": message["n"], "error": str(reason)}
    return {"n": message["n"], "first": first}


def _called(path: str | None, own: Path) -> Path:
    """Return the notebook's path with its current name. `path`, from the page, is relative to the
    server's folder. Raises ValueError if the notebook cannot be found.
    """
    if path is not None:
        for folder in own.parents:
            if (folder / path.lstrip("/")).is_file():
                return folder / path.lstrip("/")
    elif own.is_file():
        return own
    raise ValueError(f"Python cannot find {short(path or own.name)}")
