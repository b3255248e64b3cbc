"""Run cells as Jupyter runs them, without IPython, and return their outputs."""

import ast
import builtins
import contextlib
import importlib
import io
import linecache
import re
import sys
import tokenize
import types
import warnings
from collections.abc import Callable, Iterator
from typing import Any, TypeAlias

from .plain_words import told

Output: TypeAlias = dict[str, Any]

MOST = 1_000_000  # characters of output that a cell may show
CUT = "The cell shows more than 1 MB. The rest is left out."
FRAMES = 4  # lines of a traceback
OWN = ("display", "input")  # names that the session sets


class Session:
    """The names and the live views of one page."""

    def __init__(self) -> None:
        # The name is that of a script, so that functions and classes of a cell say where they are
        # from as they do in Jupyter.
        self.space = types.ModuleType("__main__").__dict__
        self.space |= {"__builtins__": builtins, "display": self._display, "input": _no_input}
        self.shown = _Shown()

    def names(self) -> list[str]:
        """Return the names that the cells have set so far."""
        return sorted(name for name in self.space if not name.startswith("__") and name not in OWN)

    def run(self, source: str, k: int) -> dict[str, Any]:
        """Run a cell and return {"outputs": what it shows, "names": the names set so far}.

        outputs  in the form of a notebook file: stream, display_data, execute_result, error. A
                 figure that cannot be drawn here has the type application/x-robokin-figure
        k        the index of the cell; its frames in a traceback are known by it
        """
        self.shown = shown = _Shown()
        name = f"<cell {k}>"
        linecache.cache[name] = (len(source), None, source.splitlines(keepends=True), name)
        self.space.pop("__warningregistry__", None)  # a warning is shown on each run
        with _streams(shown):
            try:
                value = self._value(source, name)
                if value is not None and not _hushed(source):
                    self.space["_"] = value
                    data = mime_bundle(value)
                    shown.add(
                        {"output_type": "execute_result", "execution_count": None, "data": data}
                    )
            except BaseException as error:  # SystemExit, too
                shown.outputs.append(_error(error, source, name))
        return {"outputs": shown.all(), "names": self.names()}

    def ask(self, view: str, question: dict[str, Any]) -> dict[str, Any]:
        """Return the answer to a question of a live view, with its arrays in base64, or {"error":
        why there is none}.
        """
        from ...show.live import answered

        answer: dict[str, Any] = answered(view, question)
        return answer

    def _value(self, source: str, name: str) -> Any:
        """Run a cell and return the value of its last expression."""
        body = ast.parse(source, name).body
        last = body[-1] if body and isinstance(body[-1], ast.Expr) else None
        exec(compile(ast.Module(body[: len(body) - bool(last)], []), name, "exec"), self.space)
        if last is None:
            return None
        return eval(compile(ast.Expression(last.value), name, "eval"), self.space)

    def _display(self, *values: Any, **_: Any) -> None:
        for value in values:
            data = mime_bundle(value)
            self.shown.add({"output_type": "display_data", "data": data})


def mime_bundle(value: Any) -> dict[str, Any]:
    """Return what a notebook would show for a value, by media type."""
    made = getattr(value, "_repr_mimebundle_", None)
    if callable(made) and not isinstance(value, type):
        return dict(made())
    data = {"text/plain": repr(value)}
    html = getattr(value, "_repr_html_", None)
    if callable(html) and not isinstance(value, type) and (text := html()) is not None:
        data["text/html"] = text
    if type(value).__module__.startswith("sympy."):
        written = importlib.import_module("sympy.printing.mathml").mathml
        formula = written(value, printer="presentation")
        data["text/html"] = f'<math display="block">{formula}</math>'
    return data


class _Shown:
    """The outputs of a cell, up to MOST characters."""

    def __init__(self) -> None:
        self.outputs: list[Output] = []
        self.size = 0

    def write(self, stream: str, text: str) -> None:
        room = MOST - self.size
        self.size += len(text)
        text = text[: max(room, 0)]
        last = self.outputs[-1] if self.outputs else {}
        if last.get("name") == stream:
            last["text"] += text
        elif text:
            self.outputs.append({"output_type": "stream", "name": stream, "text": text})

    def add(self, output: Output) -> None:
        self.size += sum(len(str(each)) for each in output["data"].values())
        if self.size <= MOST:
            self.outputs.append({**output, "metadata": {}})

    def all(self) -> list[Output]:
        if self.size > MOST:
            self.outputs.append({"output_type": "stream", "name": "stderr", "text": CUT + "\n"})
        return self.outputs


class _Stream(io.TextIOBase):
    def __init__(self, name: str, write: Callable[[str, str], None]) -> None:
        self.called, self.then = name, write

    def write(self, text: str) -> int:
        self.then(self.called, text)
        return len(text)

    def writable(self) -> bool:
        return True


@contextlib.contextmanager
def _streams(shown: _Shown) -> Iterator[None]:
    before = sys.stdout, sys.stderr, warnings.formatwarning
    sys.stdout = _Stream("stdout", shown.write)
    sys.stderr = _Stream("stderr", shown.write)
    warnings.formatwarning = _warning
    try:
        yield
    finally:
        sys.stdout, sys.stderr, warnings.formatwarning = before


def _warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    line: str | None = None,
) -> str:
    where = f" (cell, line {lineno})" if filename.startswith("<cell ") else ""
    return f"{category.__name__}: {message}{where}\n"


def _hushed(source: str) -> bool:
    """Return whether the last character of the code, apart from comments, is a semicolon."""
    code = [
        token.string
        for token in tokenize.generate_tokens(io.StringIO(source).readline)
        if token.type not in (tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.ENDMARKER)
    ]
    return bool(code) and code[-1] == ";"


def _no_input(prompt: str = "") -> str:
    raise RuntimeError("A page cannot ask for input. Write the value into the cell.")


def _error(error: BaseException, source: str, name: str) -> Output:
    """Return an error as an output. Its traceback has the lines of cells only."""
    kind, says = told(error, source)
    says += _suggestion(error)
    lines = []
    if isinstance(error, SyntaxError) and error.filename == name:
        lines += _line(error.lineno or 1, name)
    else:
        trace, found = error.__traceback__, []
        while trace is not None:
            file = trace.tb_frame.f_code.co_filename
            if file.startswith("<cell "):
                place = "cell" if file == name else "another cell"
                found.append(_line(trace.tb_lineno, file, place))
            trace = trace.tb_next
        if len(found) > FRAMES:
            found = [*found[:1], ["..."], *found[1 - FRAMES :]]
        lines = [line for lines in found for line in lines]
    return {
        "output_type": "error",
        "ename": kind,
        "evalue": says,
        "traceback": [*lines, f"{kind}: {says}" if says else kind],
    }


def _suggestion(error: BaseException) -> str:
    """Return Python's suggestion for a misspelled name. Python adds it only when it prints."""
    if not isinstance(error, (AttributeError, NameError)):
        return ""
    with contextlib.redirect_stderr(io.StringIO()) as printed:
        sys.__excepthook__(type(error), error, error.__traceback__)
    found = re.search(r"\. Did you mean: '.*'\?$", printed.getvalue().rstrip())
    return found[0] if found else ""


def _line(number: int, file: str, place: str = "cell") -> list[str]:
    text = linecache.getline(file, number).strip()
    return [f"{place}, line {number}", *([f"    {text}"] if text else [])]
