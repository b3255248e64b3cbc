"""Numbers, form and faults of exercise 2: a program as text; its text is in the Markdown file
beside it.
"""

import ast
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from robokin import mm
from robokin.course.exercises import in_words
from robokin.course.told import apart
from robokin.course.variants import Numbers, dice

from .shared import Floats

COUNT = 3  # both elbows, and the budget
OUTPUTS = ("xr", "yr", "xl", "yl")
BUDGET = 23
NEARLY = 35 * mm  # a program whose elbows are off by less is called nearly right
SIGNS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "**"}
TIPS = np.array([(0.9, 0.4), (-0.5, 0.8), (0.2, -0.9), (-0.7, -0.6), (0.1, 1.1), (1.1, -0.1)])


def given(who: Any) -> Numbers:
    """A student's arm: its base, and two different lengths."""
    roll = dice("two_link_code_generation", who)
    x, y = (1 - 2 * roll.randrange(2)) * 0.05, (1 - 2 * roll.randrange(2)) * 0.05
    long, less = roll.randrange(60, 91, 5) / 100, roll.randrange(10, 31, 5) / 100
    l1, l2 = (long, long - less) if roll.randrange(2) else (long - less, long)
    x, y = x * roll.randrange(1, 5), y * roll.randrange(1, 5)
    numbers = {"base_x": x, "base_y": y, "l1": l1, "l2": l2}
    numbers = {name: round(value, 2) for name, value in numbers.items()}
    units = dict.fromkeys(numbers, ("m", 1.0)) | {"budget": ("operations", 1)}
    return Numbers(numbers | {"budget": BUDGET}, units)


def operations(program: str) -> int:
    """The number of operations: + - * / **, roots, and minus signs except those of constants."""
    nodes = list(ast.walk(ast.parse(program)))
    signs = [node.operand for node in nodes if isinstance(node, ast.UnaryOp)]
    return sum(isinstance(node, (ast.BinOp, ast.Call)) for node in nodes) + sum(
        not isinstance(operand, ast.Constant) for operand in signs
    )


@dataclass(frozen=True)
class Program:
    """What a verdict shows instead of the whole text."""

    lines: int

    def __repr__(self) -> str:
        return f"a program of {self.lines} lines"


def plain(answer: Any) -> Any:
    lines = [line for line in answer.splitlines() if line.strip()] if type(answer) is str else []
    return Program(len(lines)) if len(lines) > 1 else answer


def form(answer: Any, given: Any) -> str:
    if isinstance(answer, (list, tuple)) and all(isinstance(line, str) for line in answer):
        answer = "\n".join(answer)
    if not isinstance(answer, str):
        raise ValueError(
            f"wanted the text of a program, lines such as 'dx = x3 - 0.2', got {in_words(answer)}"
        )
    lines = "\n".join(line.strip() for line in answer.replace(";", "\n").splitlines())
    try:
        tree = ast.parse(lines)
    except (SyntaxError, ValueError) as error:
        raise ValueError(f"this is not Python: {error}") from None
    for node in tree.body:
        plain = isinstance(node, ast.Assign) and len(node.targets) == 1
        if not (plain and isinstance(node.targets[0], ast.Name)):  # type: ignore[attr-defined]
            raise ValueError(f"wanted lines `name = expression` only, got: {ast.unparse(node)}")
    values(lines, (0.5, 0.6))
    missing = [name for name in OUTPUTS if not re.search(rf"^{name} *=", lines, re.M)]
    if missing:
        raise ValueError(f"the program never sets {', '.join(missing)}")
    return lines


def values(
    program: str, tip: Sequence[float], sqrt: Callable[..., Any] = np.sqrt
) -> dict[str, Any]:
    """All values after the program, which is interpreted here: only arithmetic and roots."""
    known: dict[str, Any] = {"x3": np.float64(tip[0]), "y3": np.float64(tip[1])}

    def value(node: Any) -> Any:
        if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
            return np.float64(node.value)
        if isinstance(node, ast.Name):
            if node.id not in known:
                raise ValueError(f"{node.id} is used before it is set; x3 and y3 are given")
            return known[node.id]
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.UAdd)):
            return -value(node.operand) if isinstance(node.op, ast.USub) else value(node.operand)
        if isinstance(node, ast.BinOp) and type(node.op) in SIGNS:
            a, b = value(node.left), value(node.right)
            with np.errstate(all="ignore"):
                power = sqrt(a) if b == 0.5 else a**b
                results = {"+": a + b, "-": a - b, "*": a * b, "/": a / b, "**": power}
            return results[SIGNS[type(node.op)]]
        if isinstance(node, ast.Call) and len(node.args) == 1 and not node.keywords:
            if re.fullmatch(r"((math|np|numpy|sp)\.)?sqrt", ast.unparse(node.func)):
                with np.errstate(all="ignore"):
                    return sqrt(value(node.args[0]))
        raise ValueError(f"wanted + - * / ** and sqrt alone, got: {ast.unparse(node)}")

    for node in ast.parse(program).body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            known[node.targets[0].id] = value(node.value)
    return known


def in_reach(arm: Mapping[str, float]) -> Floats:
    """Tips in reach, all around the base."""
    low, high = abs(arm["l1"] - arm["l2"]), arm["l1"] + arm["l2"]
    shares = np.linspace(0.15, 0.9, len(TIPS))
    ways = TIPS / np.linalg.norm(TIPS, axis=-1, keepdims=True)
    base = np.array([arm["base_x"], arm["base_y"]])
    tips: Floats = base + (low + shares * (high - low))[:, None] * ways
    return tips


RIGHT = """
dx = x3 - base_x; dy = y3 - base_y
d2 = dx*dx + dy*dy
K = (l1**2 - l2**2) / 2; a = 0.5 + K / d2
L = l1**2; h = sqrt(L / d2 - a*a)
px = base_x + a*dx; py = base_y + a*dy
u = h*dy; v = h*dx
xr = px + u; yr = py - v; xl = px - u; yl = py + v
"""


def lines(program: str) -> Iterator[list[str]]:
    """The name and the expression of each line."""
    return (line.strip().split(" = ") for line in re.split("[;\n]", program) if line)


def written(
    arm: Mapping[str, float], tips: Floats, slip: str = "", sqrt: Callable[..., Any] = np.sqrt
) -> Any:
    """The elbows (tips, 4) of the correct program, with the lines of `slip` in place of its own."""
    known: dict[str, Any] = {**arm, "x3": tips[:, 0], "y3": tips[:, 1], "sqrt": sqrt}
    instead = dict(lines(slip))
    with np.errstate(all="ignore"):
        for name, line in lines(RIGHT):
            known[name] = eval(instead.get(name, line), known)
    return np.stack([known[name] for name in OUTPUTS], axis=-1)


SHARE = "a = 0.5 + K / d2 with K = (l1² − l2²) / 2."
HEIGHT = "h = sqrt(l1² / d2 − a²), with d2 = dx² + dy²."
WAY = "dx = x3 − base_x and dy = y3 − base_y"
# a sentence, then the mistakes to which it applies, each with the lines that replace correct ones
KNOWN = """
xr, yr are the elbow on the right, seen from the base towards the tip.
  the sides swapped: xr = px - u; yr = py + v; xl = px + u; yl = py - v
xr is the x of the right elbow.
  x and y swapped: xr = py - v; yr = px + u; xl = py + v; yl = px - u
Both pairs are the right elbow: change the sign of h.
  one elbow twice: xl = px + u; yl = py - v
Both pairs are the left elbow: change the sign of h.
  one elbow twice: xr = px - u; yr = py + v
Your base is not at the origin.
  the base left out: dx = x3; dy = y3; px = a*dx; py = a*dy
Your elbows are relative to your base: add it.
  the base not added at the end: px = a*dx; py = a*dy
l1 is the length of the link on the base.
  the links swapped: K = (l2**2 - l1**2) / 2; L = l2**2
Your links have different lengths, so a is not 1/2.
  equal links assumed: a = 0.5
This is the arm of the lab. Use your own base and lengths.
  the lab's arm: dx = x3 - 0.2; dy = y3 + 0.1; K = 0.255; L = 1; px = a*dx + 0.2; py = a*dy - 0.1
"""
SLIPS = f"""
{SHARE}
  K not halved: K = l1**2 - l2**2
  K halved twice: K = (l1**2 - l2**2) / 4
  the sign of K: K = (l2**2 - l1**2) / 2
  a sum of squares in K: K = (l1**2 + l2**2) / 2
  no squares in K: K = (l1 - l2) / 2
  the square of the difference in K: K = (l1 - l2)**2 / 2
  only l2² halved in K: K = l1**2 - l2**2 / 2
  0.5 left out of a: a = K / d2
  1 instead of 0.5 in a: a = 1 + K / d2
  0.5 divided by d2, too: a = (0.5 + K) / d2
  K not divided by d2: a = 0.5 + K
  K times d2: a = 0.5 + K * d2
  K divided by d, not by d2: a = 0.5 + K / sqrt(d2)
  a minus in a: a = K / d2 - 0.5
{HEIGHT}
  a not squared: h = sqrt(L / d2 - a)
  2 a instead of a²: h = sqrt(L / d2 - 2*a)
  plus instead of minus under the root: h = sqrt(L / d2 + a*a)
  a² − l1² / d2 under the root: h = sqrt(a*a - L / d2)
  the root left out: h = L / d2 - a*a
  l1² not divided by d2: h = sqrt(L - a*a)
  a² divided by d2, too: h = sqrt((L - a*a) / d2)
  l1² times d2: h = sqrt(L * d2 - a*a)
  l1 instead of l1²: L = l1
  l2² instead of l1²: L = l2**2
Your h is a length, but it multiplies dx and dy: divide it by d. {HEIGHT}
  h in metres: h = sqrt(L - a*a*d2)
{HEIGHT}
  h halved: h = sqrt(L / d2 - a*a) / 2
  h twice: h = sqrt(L / d2 - a*a) * 2
  d instead of d2: d2 = sqrt(dx*dx + dy*dy)
  minus instead of plus in d2: d2 = dx*dx - dy*dy
  the square of the sum instead of d2: d2 = (dx + dy)**2
  dx twice in d2: d2 = 2*dx*dx
  dy twice in d2: d2 = 2*dy*dy
{WAY}: the direction goes from the base to the tip.
  the direction from tip to base: dx = base_x - x3; dy = base_y - y3
{WAY}. Subtract the base even if it is negative.
  the base added to the tip: dx = x3 + base_x; dy = y3 + base_y
dx = x3 − base_x: subtract the base even if it is negative.
  the base added to x3: dx = x3 + base_x
dy = y3 − base_y: subtract the base even if it is negative.
  the base added to y3: dy = y3 + base_y
{WAY}.
  the base left out of dx and dy: dx = x3; dy = y3
dx = x3 − base_x.
  the base left out of dx: dx = x3
dy = y3 − base_y.
  the base left out of dy: dy = y3
You used the base with the wrong sign. {WAY}; at the end, add base_x and base_y.
  the sign of the base: dx = x3 + base_x; dy = y3 + base_y; px = a*dx - base_x; py = a*dy - base_y
You used base_x with the wrong sign: dx = x3 − base_x and px = base_x + a dx.
  the sign of base_x: dx = x3 + base_x; px = a*dx - base_x
You used base_y with the wrong sign: dy = y3 − base_y and py = base_y + a dy.
  the sign of base_y: dy = y3 + base_y; py = a*dy - base_y
{WAY}.
  base_x and base_y swapped: dx = x3 - base_y; dy = y3 - base_x
px = base_x + a dx and py = base_y + a dy: go from the base along the line to the tip.
  1/2 instead of a in the foot: px = base_x + dx / 2; py = base_y + dy / 2
  no a in the foot: px = base_x + dx; py = base_y + dy
  the foot measured from the tip: px = x3 + a*dx; py = y3 + a*dy
  the foot on the other side of the base: px = base_x - a*dx; py = base_y - a*dy
  dx and dy swapped in the foot: px = base_x + a*dy; py = base_y + a*dx
  dx instead of dy in the foot: py = base_y + a*dx
The direction across is (dy, −dx): xr = px + h dy, yr = py − h dx; on the left the signs change.
  along instead of across: u = h*dx; v = h*dy
  across without a direction: u = h; v = h
  a wrong sign in the direction across: yr = py + v; yl = py - v
  the sign in xl: xl = px + u
  the sign in yl: yl = py - v
  the sign in xr: xr = px - u
  the sign in yr: yr = py + v
"""


def explained(
    table: str, arm: Any, tips: Floats, found: Any, most: int = 1, sqrt: Any = np.sqrt
) -> tuple[str, str] | None:
    """The name and sentence of the mistake in a table that gives these elbows, or of up to `most`
    if several give the same.
    """
    fitting, says = [], ""
    for line in table.strip().split("\n"):
        name, _, step = line.strip().partition(": ")
        if not line.startswith(" "):
            says = line
        elif np.allclose(found, written(arm, tips, step, sqrt), rtol=0, atol=1e-6):
            fitting.append((name, says))
    if not fitting:
        return None
    names, sentences = (list(dict.fromkeys(each)) for each in zip(*fitting[:most], strict=True))
    return " or ".join(names), " Or: ".join(sentences)


def slip(arm: Any, tips: Floats, program: str) -> tuple[str, str] | None:
    """Name and sentence of a common mistake or a slip in one step; None: correct or unknown."""
    found = elbows(program, tips)
    if named := explained(KNOWN, arm, tips, found):
        return named
    if np.allclose(found, written(arm, tips), rtol=0, atol=1e-6):
        return None
    # with complex roots, different slips differ even where the elbows are NaN
    unreal = elbows(program, tips, np.emath.sqrt)
    named = explained(SLIPS, arm, tips, unreal, most=2, sqrt=np.emath.sqrt)
    if not named and not np.isfinite(found).any():
        return (
            "NaN",
            "It returns NaN for every tip that we tried. In reach, l1² / d2 is greater than a².",
        )
    return named


def elbows(program: str, tips: Floats, sqrt: Callable[..., Any] = np.sqrt) -> Any:
    """The elbows (tips, 4) of a program."""
    known = [values(program, tip, sqrt) for tip in tips]
    return np.array([[each[name] for name in OUTPUTS] for each in known])


def faults(program: str, given: Any) -> list[tuple[str, str]]:
    tips = in_reach(given)
    found = elbows(program, tips)
    right, named = written(given, tips), slip(given, tips, program)
    most = float(abs(found - right).max())
    if not named and 1e-6 < most < NEARLY:
        off = apart(most / mm, 0)[0]
        says = f"Your elbows are off by up to {off} mm; the task asks for a micrometre."
        named = "nearly right", says + " Do your constants have enough digits?"
    faults: list[tuple[str, str]] = []
    for k, name in ((0, "right"), (2, "left")):
        off = abs(found[:, k : k + 2] - right[:, k : k + 2]).max(axis=-1)
        if not (off <= 1e-6).all():
            n = int((~(off <= 1e-6)).argmax())
            at, is_at = apart(right[n, k : k + 2], found[n, k : k + 2], 3)
            says = (
                f"For the tip ({tips[n, 0]:.4g}, {tips[n, 1]:.4g}) the {name} elbow is at ({at}); "
                f"your program returns ({is_at})."
            )
            why = f"{named[1]} " if named and not faults else ""
            faults.append((named[0] if named else f"another {name} elbow", why + says))
    count = operations(program)
    if count > given["budget"]:
        raw = count > 60
        says = f"It has {count} operations, and {given['budget']} are allowed. " + (
            "Take out the common subexpressions first."
            if raw
            else "What do you compute twice? What is a constant of your arm?"
        )
        faults.append(("no temporaries" if raw else "too many operations", says))
    return faults
