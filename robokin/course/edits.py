"""Wrong programs made from the correct one by edits to its text: the mistakes of the exercise and
common slips, alone and in pairs.
"""

import ast
import copy
import re
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from itertools import accumulate, combinations, pairwise
from typing import Any, NamedTuple

import numpy as np

from .markdown import BadFile, Edit, Wrong

Span = tuple[int, int, str]  # start, end, replacement


class Variant(NamedTuple):
    """A wrong program: its name, a sentence, and its edits to the solution or its complete text."""

    name: str
    says: str
    change: tuple[Span, ...] | str

    def text(self, solution: str) -> str:
        """The text of the wrong program."""
        return self.change if isinstance(self.change, str) else _edited(solution, self.change)


def own(
    file: str, name: str, programs: Sequence[str], mistakes: Sequence[Wrong]
) -> list[tuple[Variant, str]]:
    """Return each mistake of an exercise as a variant, with the first correct program that it fits.
    All programs define `name`. Raises ValueError, with a sentence for each mistake that fits none
    of the programs.
    """
    found, misfits = [], []
    for each in mistakes:
        for line, wrong in zip(each.lines, each.programs, strict=True):
            base = next((p for p in programs if not _misfit(p, wrong, name)), programs[0])
            if why := _misfit(base, wrong, name):
                misfits.append(f"{BadFile(file, line, f'{each.name!r}: {why}')}")
            else:
                change = wrong if isinstance(wrong, str) else _spans(base, wrong)
                found.append((Variant(each.name, each.says, change), base))
    if misfits:
        raise ValueError("\n".join(misfits))
    return found


def pairs(variants: Sequence[Variant]) -> Iterator[Variant]:
    """All pairs of mistakes whose edits do not overlap."""
    for a, b in combinations(variants, 2):
        if isinstance(a.change, str) or isinstance(b.change, str) or a.name == b.name:
            continue
        both = sorted((*a.change, *b.change))
        if _apart(both):
            says = a.says if a.says == b.says else f"{a.says} And: {b.says}"
            yield Variant(f"{a.name}, and {b.name}", says, tuple(both))


def _edited(text: str, change: Sequence[Span]) -> str:
    for start, end, new in sorted(change, reverse=True):
        text = text[:start] + new + text[end:]
    return text


def _apart(change: Sequence[Span]) -> bool:
    return all(one[1] <= two[0] for one, two in pairwise(sorted(change)))


def _spans(solution: str, edits: tuple[Edit, ...]) -> tuple[Span, ...]:
    return tuple((at := solution.index(old), at + len(old), new) for old, new in edits)


def _misfit(solution: str, wrong: tuple[Edit, ...] | str, name: str) -> str:
    """The reason why this change to the solution does not give a valid program; "" if it does."""
    if isinstance(wrong, str):
        text = wrong
        if not re.search(rf"^(?:def |class )?{name}\b", text, re.M):
            return f"the program does not define {name}"
    else:
        for old, _ in wrong:
            if solution.count(old) != 1:
                times = f"{solution.count(old)} times"
                return f"`{old}` occurs {times} in the solution, wanted once"
        change = _spans(solution, wrong)
        if not _apart(change):
            return "its pieces overlap"
        text = _edited(solution, change)
    try:
        ast.parse(text)
    except SyntaxError as error:
        return f"not Python: {error.msg}"
    return ""


# --- Common slips --------------------------------------------------------------------------

SLIPS = {
    "sign": "A plus sign should be a minus sign, or the other way round.",
    "order of a product": "Two factors of a product are in the wrong order. In A @ B, the "
    "right factor is applied first, as seen from the base.",
    "element-wise product": "`*` multiplies element by element; the product of matrices is `@`.",
    "inverse left out": "You need an inverse somewhere, but you use the original.",
    "arcsin for atan2": "The angle is computed from its sine alone, which gives only half of all "
    "directions. Use arctan2 of sine and cosine.",
    "x and y swapped": "arctan2 takes y first, then x.",
    "sine for cosine": "A sine is used instead of a cosine, or a cosine instead of a sine.",
    "a root left out": "A square root is missing.",
    "a square left out": "A square is missing.",
    "absolute value left out": "A difference has a sign: take its absolute value.",
    "least for greatest": "You take the minimum instead of the maximum, or the other way round.",
    "any for all": "It uses any where all is needed, or the other way round.",
    "a factor of two": "A factor of two is missing, or there is one too many.",
    "the limit itself": "A value exactly at its limit is on the wrong side: < for <=, for example.",
    "an index off by one": "It uses the element next to the correct one.",
    "the long way round": "A joint makes one whole turn too many: two joint values that differ by "
    "360 degrees put the arm in the same place.",
}
SWAPPED = {
    "min": ("max", "least for greatest"),
    "max": ("min", "least for greatest"),
    "argmin": ("argmax", "least for greatest"),
    "argmax": ("argmin", "least for greatest"),
    "sin": ("cos", "sine for cosine"),
    "cos": ("sin", "sine for cosine"),
    "all": ("any", "any for all"),
    "any": ("all", "any for all"),
}
SIGNS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}
EDGES = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}


def everybody(solution: str) -> list[Variant]:
    """The common slips in the functions of this program, except in functions that may loop
    forever after a slip.
    """
    lines = [0, *accumulate(len(line.encode()) for line in solution.splitlines(keepends=True))]
    raw = solution.encode()

    def place(node: Any) -> tuple[int, int]:
        begin, end = lines[node.lineno - 1], lines[node.end_lineno - 1]
        return begin + node.col_offset, end + node.end_col_offset

    def said(node: Any) -> str:
        return f"({raw[slice(*place(node))].decode()})"

    found = []
    functions = [
        list(ast.walk(n)) for n in ast.parse(solution).body if isinstance(n, ast.FunctionDef)
    ]
    ending = (nodes for nodes in functions if not any(isinstance(n, ast.While) for n in nodes))
    for node in (n for nodes in ending for n in nodes):
        for name, spot, new in (*_in_sums(node, said), *_in_calls(node, said)):
            start, end = (len(raw[:at].decode()) for at in place(spot))
            found.append(Variant(name, SLIPS[name], ((start, end, new),)))
    return found


def _in_sums(node: Any, said: Callable[[Any], str]) -> Iterator[tuple[str, Any, str]]:
    """Yield slips in arithmetic and comparisons: the name, the node to replace, its replacement."""
    match node:
        case ast.BinOp(op=ast.Add() | ast.Sub(), left=a, right=b):
            sign = "-" if isinstance(node.op, ast.Add) else "+"
            yield "sign", node, f"({said(a)} {sign} {said(b)})"
        case ast.UnaryOp(op=ast.USub(), operand=a) if not isinstance(a, ast.Constant):
            yield "sign", node, said(a)
        case ast.BinOp(op=ast.MatMult(), left=a, right=b):
            yield "order of a product", node, f"({said(b)} @ {said(a)})"
            yield "element-wise product", node, f"({said(a)} * {said(b)})"
        case ast.BinOp(op=ast.Pow(), left=a, right=ast.Constant(2)):
            yield "a square left out", node, said(a)
        case ast.BinOp(op=ast.Mult() | ast.Div(), left=a, right=ast.Constant(2)):
            yield "a factor of two", node, said(a)
        case ast.BinOp(op=ast.Mult(), left=ast.Constant(2), right=b):
            yield "a factor of two", node, said(b)
        case ast.Compare(ops=ops) if all(type(op) in SIGNS for op in ops):
            terms = [f" {said(term)}" for term in node.comparators]
            for k in range(len(ops)):
                signs = [SIGNS[type(op)] for op in ops]
                signs[k] = EDGES[signs[k]]
                rest = (f" {s}{t}" for s, t in zip(signs, terms, strict=True))
                yield "the limit itself", node, f"({said(node.left)}{''.join(rest)})"
        case ast.Subscript(slice=ast.Constant(value=int(k))):
            for other in (k + 1, k - 1):
                if other >= 0:
                    yield "an index off by one", node, f"{said(node.value)}[{other}]"


def _in_calls(node: Any, said: Callable[[Any], str]) -> Iterator[tuple[str, Any, str]]:
    """Yield slips in function calls: the name, the node to replace, its replacement."""
    match node:
        case ast.Call(func=ast.Attribute(value=a, attr="inverse"), args=[]):
            yield "inverse left out", node, said(a)
        case ast.Call(func=ast.Attribute(attr="arctan2"), args=[y, x]):
            yield "x and y swapped", node, f"np.arctan2({said(x)}, {said(y)})"
            sine = f"{said(y)} / np.hypot({said(y)}, {said(x)})"
            yield "arcsin for atan2", node, f"np.arcsin({sine})"
        case ast.Call(func=ast.Attribute(attr="sqrt"), args=[a]):
            yield "a root left out", node, said(a)
        case ast.Call(func=ast.Name(id="wrapped"), args=[a, *_]):
            yield "the long way round", node, said(a)
        case ast.Call(func=ast.Name(id="abs"), args=[a]):
            yield "absolute value left out", node, said(a)
        case ast.Call(func=ast.Attribute(value=a, attr=name)) if name in SWAPPED:
            other, slip = SWAPPED[name]
            yield slip, node.func, f"{said(a)}.{other}"
        case ast.Call(func=ast.Name(id=name)) if name in SWAPPED:
            other, slip = SWAPPED[name]
            yield slip, node.func, other


# --- Running programs -----------------------------------------------------------------------------


def function_name(file: str, line: int, program: str) -> str:
    """The name of the last function that a program defines at its top level. `line` is the
    program's first line in the file. Raises BadFile if it defines no function or is not valid
    Python.
    """
    try:
        top = ast.parse(program).body
    except SyntaxError as error:
        raise BadFile(file, line + (error.lineno or 1) - 1, f"not Python: {error.msg}") from None
    names = [each.name for each in top if isinstance(each, ast.FunctionDef)]
    if not names:
        raise BadFile(file, line, "wanted a program that defines a function")
    return names[-1]


def run(text: str, also: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Run a program and return its names."""
    found: dict[str, Any] = dict(also or {})
    exec(compile(text, "<solution>", "exec"), found)
    return found


class Steps:
    """A solution split into the statements of its function, so that thousands of wrong programs run
    quickly. Each wrong program consists of compiled statements and begins after those that it
    shares with the solution, with its own copies of all values that a statement may change. A
    solution that returns in more than one place cannot be split, and neither can one that assigns a
    function to a name, since that function may use later names. Such a solution is compiled again
    for each wrong program.
    """

    def __init__(self, solution: str, also: Mapping[str, Any]) -> None:
        self.solution, self.also = solution, also
        top = [n for n in ast.parse(solution).body if isinstance(n, ast.FunctionDef)][-1]
        self.name, self.inputs = top.name, [each.arg for each in top.args.args]
        lines = [0, *accumulate(map(len, solution.splitlines(keepends=True)))]
        self.spans = [(lines[n.lineno - 1], lines[n.end_lineno or 0]) for n in top.body]
        self.before = run(solution[: lines[top.lineno - 1]], also)
        returns = [n for n in ast.walk(top) if isinstance(n, ast.Return)]
        alone = len({a for a, _ in self.spans}) == len(self.spans)  # one statement per line
        late = (ast.Lambda, ast.GeneratorExp)
        kept = any(isinstance(n, ast.Assign) and isinstance(n.value, late) for n in top.body)
        self.plain = returns == top.body[-1:] and alone and not kept
        self.names: dict[Any, dict[str, Any]] = {}

    def program(self, variant: Variant) -> Callable[..., Any]:
        """Return the wrong program. It does not change its inputs."""
        change = () if isinstance(variant.change, str) else variant.change
        inside = [any(a <= start and end <= b for a, b in self.spans) for start, end, _ in change]
        if not (self.plain and change and all(inside)):
            program = run(variant.text(self.solution), self.also)[self.name]
            return lambda *case: program(*copy.deepcopy(case))
        steps: list[Any] = []
        same = 0
        for a, b in self.spans:
            mine = [(start - a, end - a, new) for start, end, new in change if a <= start < b]
            same += not mine and same == len(steps)
            steps.append(_step(_edited(self.solution[a:b], mine)))

        def stepped(*case: Any) -> Any:
            names = self._after(same, case)
            for step in steps[same:]:
                exec(step, names)
            return names["returned"]

        return stepped

    def _after(self, count: int, case: tuple[Any, ...]) -> dict[str, Any]:
        """All names after `count` statements of the solution, copied for a single use."""
        key = count, tuple(map(id, case))
        if key not in self.names:
            names = dict(zip(self.inputs, case, strict=True))
            if count:
                names = self._after(count - 1, case)
                exec(_step(self.solution[slice(*self.spans[count - 1])]), names)
            self.names[key] = {k: v for k, v in names.items() if v is not self.before.get(k, ...)}
        memo: dict[int, Any] = {}  # two names for the same array still refer to one array
        mine = self.names[key].items()
        return self.before | {
            k: copy.deepcopy(v, memo) if isinstance(v, CHANGEABLE) else v for k, v in mine
        }


CHANGEABLE = (np.ndarray, list, dict, set)


@cache
def _step(text: str) -> Any:
    text = textwrap.dedent(text)
    return compile(re.sub(r"^return\b", "returned =", text), "<solution>", "exec")
