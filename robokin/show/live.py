"""Views that need a kernel: the page draws, and Python answers its questions.

A view is an `explorer.Explorer` whose script (`js/live.js`) sends questions. It stores the first
answer, so that it can be drawn without a kernel: in a saved notebook, in an exported page and in
print. Without a kernel, the view is inactive and says so. A widget without a view of its own
activates it: the model of the widget finds the view in the page. A page without a kernel therefore
still shows everything that is stored.
"""

import base64
import contextlib
import json
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from . import plots
from .explorer import Explorer
from .joiner import script
from .markup import inert

Question: TypeAlias = dict[str, Any]
Answer: TypeAlias = dict[str, Any]

TYPES = ("uint8", "uint16", "int16", "float32")
WORDS = {
    "asleep": "Inactive: this view needs Python. Run its cell to activate it. Until then, "
    "it shows the result of the last run.",
    "waiting": "No answer from Python yet. It may be busy with another cell; if the kernel was "
    "restarted, run this cell again.",
    "failed": "Python could not answer: {error}.",
}


class Live(Explorer):
    """An explorer that asks a kernel. It displays itself in a notebook; `save` writes it as a page,
    in which it is inactive.

    data    a `page.PlanPage` or `TourPage`, without `first`; its words may replace those of this
            module
    still   the still picture, as in every `Explorer`
    first   the question that is asked first; its answer is stored
    answer  a function that maps a question (JSON values) to an answer, a dict of JSON values and
            arrays of the TYPES. It is called on every move of the pointer, in its own thread
    """

    def __init__(
        self,
        data: dict[str, Any],
        still: plots.Figure,
        first: Question,
        answer: Callable[[Question], Answer],
    ) -> None:
        content, buffers = split_arrays(answer(first))
        words = {**WORDS, **data["words"]}
        data = data | {"words": words, "first": stored(content, buffers), "question": first}
        super().__init__(data, still)
        self.answer = answer

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        _wake(self.id, self.answer)
        return super()._repr_mimebundle_(include, exclude)


def split_arrays(answer: Any) -> tuple[Any, list[bytes]]:
    """Split an answer into JSON values and its arrays. Each array is replaced by {"array": its
    index, "type", "shape"}. Raises ValueError if the type of an array is not in TYPES.
    """
    buffers: list[bytes] = []

    def walk(value: Any) -> Any:
        if isinstance(value, np.ndarray):
            if str(value.dtype) not in TYPES:
                wanted = ", ".join(TYPES)
                raise ValueError(f"answer: wanted arrays of {wanted}, got {value.dtype}")
            little = value.astype(value.dtype.newbyteorder("<"))
            buffers.append(little.tobytes())
            kind = {"type": str(value.dtype), "shape": list(value.shape)}
            return {"array": len(buffers) - 1, **kind}
        if isinstance(value, dict):
            return {key: walk(each) for key, each in value.items()}
        if isinstance(value, (list, tuple)):
            return [walk(each) for each in value]
        return value

    return walk(answer), buffers


def stored(content: Any, buffers: list[bytes]) -> Any:
    """Return the result of `split_arrays` as JSON values only, with arrays in base64."""
    if isinstance(content, dict) and "array" in content:
        return content | {"array": base64.b64encode(buffers[content["array"]]).decode()}
    if isinstance(content, dict):
        return {key: stored(each, buffers) for key, each in content.items()}
    if isinstance(content, list):
        return [stored(each, buffers) for each in content]
    return content


# --- The widget -----------------------------------------------------------------------------------

_awake: dict[str, Any] = {}  # the widget of each view, by id; running the cell again replaces it
_answers: dict[str, Callable[[Question], Answer]] = {}  # of each view that has been shown


def answered(place: str, question: Question) -> Any:
    """Return the answer to a question of the view with this id, with arrays in base64."""
    return stored(*_replied(_answers[place], question))


def _replied(answer: Callable[[Question], Answer], question: Question) -> tuple[Any, list[bytes]]:
    """Return an answer and its arrays, or {"error": the reason why there is none}."""
    try:
        content, buffers = split_arrays(answer(question))
        inert(content)
    except Exception as error:  # the view shows it, since this thread's output is not visible
        content, buffers = {"error": f"{type(error).__name__}: {error}"}, []
    return content, buffers


def _wake(place: str, answer: Callable[[Question], Answer]) -> None:
    """Answer all questions that this view of the page asks from now on."""

    def reply(model: Any, message: Any, _: Any) -> None:
        content, buffers = _replied(answer, message["question"])
        model.send({"to": message["to"], "n": message["n"], "answer": content}, buffers)

    _answers[place] = answer

    if place in _awake:
        _awake.pop(place).close()
    model = (
        f"{script('waking')}\nexport default {{initialize: $waking.model({json.dumps(place)})}};"
    )
    with contextlib.suppress(ModuleNotFoundError):  # in a web page, which asks `answered`
        _awake[place] = unseen(model, reply)


def unseen(page: str, hear: Callable[[Any, Any, Any], None]) -> Any:
    """Return a widget without a view. `page` is a module whose default export has
    `initialize({model})`. `hear` is called with the widget, a message from that model, and the
    buffers of the message.
    """
    from anywidget import AnyWidget  # imported here because it loads ipywidgets

    made = AnyWidget(_esm=page)
    made.on_msg(hear)
    return made
