"""Find the cells that a cell needs, by the names that it reads."""

import ast
import contextlib
import dis
from collections.abc import Collection, Sequence
from functools import cache
from types import CodeType

SETS = (ast.Assign, ast.Import, ast.ImportFrom, ast.FunctionDef, ast.ClassDef, ast.Expr)
ASKS = {"check", "predict"}
DRAWS = {"Sketch", "figure", "plot_frames", "plot_postures", "plot_velocity_ellipsoid"}


def needs(sources: Sequence[str], i: int, have: Collection[str]) -> list[int]:
    """Return the indices of the cells above cell i that must run before it, in order: for each name
    that it reads and that is not in `have`, the last cell that sets the name, and what that cell
    needs. A cell that checks an answer or asks a question never runs for another one, and a cell
    that draws a picture only if no other cell sets the name.
    """
    quiet: dict[str, list[int]] = {}  # the cells that set a name, in the order of the lab
    drawn: dict[str, list[int]] = {}
    for k, source in enumerate(sources[:i]):
        called = calls(source)
        for name in set() if called & ASKS else names(source)[1]:
            (drawn if called & DRAWS else quiet).setdefault(name, []).append(k)
    found: set[int] = set()
    waiting = [i]
    while waiting:
        k = waiting.pop()
        for name in names(sources[k])[0].difference(have):
            for setting in (quiet, drawn):
                if above := [n for n in setting.get(name, ()) if n < k]:
                    if above[-1] not in found:
                        waiting.append(above[-1])
                    found.add(above[-1])
                    break
    return sorted(found)


@cache
def calls(source: str) -> set[str]:
    """Return the names of the functions that a cell calls, but not those that its own functions
    call. A cell with a syntax error calls none.
    """
    found: set[str] = set()
    with contextlib.suppress(SyntaxError, ValueError):
        waiting: list[ast.AST] = [ast.parse(source)]
        while waiting:
            node = waiting.pop()
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                found.add(node.func.id)
            if not isinstance(node, (ast.FunctionDef, ast.Lambda, ast.ClassDef)):
                waiting.extend(ast.iter_child_nodes(node))
    return found


@cache
def names(source: str) -> tuple[set[str], set[str]]:
    """Return the names that a cell reads before it sets them, and those that it sets. A cell with a
    syntax error has none.
    """
    try:
        tree = ast.parse(source)
        return reads(tree.body, set()), global_names(compile(tree, "cell", "exec"))[1]
    except (SyntaxError, ValueError):
        return set(), set()


def reads(body: Sequence[ast.stmt], sure: set[str]) -> set[str]:
    """Return the global names that statements read before they set them. The names in `sure` are
    already set.
    """
    found: set[str] = set()
    for statement in body:
        if isinstance(statement, ast.For):  # it sets its variables before its body reads them
            own = {node.id for node in ast.walk(statement.target) if isinstance(node, ast.Name)}
            found |= read_by(statement.iter) - sure
            found |= reads([*statement.body, *statement.orelse], sure | own)
            continue
        if isinstance(statement, ast.If):
            found |= read_by(statement.test) - sure
            found |= reads(statement.body, sure) | reads(statement.orelse, sure)
            continue
        # in a loop, since the statement may contain `continue` or `break`
        loop = ast.fix_missing_locations(ast.While(ast.Constant(True), [statement], []))
        read, written = global_names(compile(ast.Module([loop], []), "cell", "exec"))
        found |= read - sure
        sure = sure | written if isinstance(statement, SETS) else sure  # others may not run
    return found


def read_by(expression: ast.expr) -> set[str]:
    """Return the global names that an expression reads."""
    return global_names(compile(ast.Expression(expression), "cell", "eval"))[0]


def global_names(code: CodeType) -> tuple[set[str], set[str]]:
    """Return the global names that a piece of code reads, and those that it sets. The names that a
    function reads count where the function is defined.
    """
    read, written = set(), set()
    for step in dis.get_instructions(code):
        if step.opname in ("LOAD_NAME", "LOAD_GLOBAL", "LOAD_FROM_DICT_OR_GLOBALS"):
            read.add(step.argval)
        elif step.opname in ("STORE_NAME", "STORE_GLOBAL", "DELETE_NAME", "DELETE_GLOBAL"):
            written.add(step.argval)
    for inner in code.co_consts:
        if isinstance(inner, CodeType):
            read |= global_names(inner)[0]
    return read, written
