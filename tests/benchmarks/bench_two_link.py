"""Measure how much faster SymPy's code becomes when it computes common subexpressions only once.

    python tests/benchmarks/bench_two_link.py [rounds]

For both elbows of the two-link arm (lab 12) and a million targets in NumPy, "naive" evaluates the
four expressions one by one, and "generated" computes every common subexpression once. Both are
measured for the document's formula (equal links at the origin, with the denominator of y2
corrected) and for the general solution, in turn, on one thread. The script prints the largest
difference between the results and the median of (naive / generated). Scalar calls are timed as
well.
"""

import os
import statistics
import sys
from pathlib import Path
from time import perf_counter

for _library in ("OMP", "OPENBLAS", "MKL"):  # before NumPy starts its threads
    os.environ[f"{_library}_NUM_THREADS"] = "1"
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import numpy as np
import sympy as sp
from test_two_link import document, general, operations, targets

TARGETS = 1_000_000
SCALAR = 20_000


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 11
    rows = targets(TARGETS)
    offset, l1 = rows[:, 2:4] - rows[:, :2], rows[:, 4]
    length = np.linalg.norm(offset, axis=1) * 0.6  # so that equal links reach every target
    cases = {
        "document, equal links on the origin": (
            document()[0],
            document()[2],
            [*offset.T, np.maximum(length, l1)],
        ),
        "general solution": (*general(), list(rows.T)),
    }
    print(
        f"NumPy {np.__version__}, SymPy {sp.__version__}, {TARGETS} targets, median of {rounds} "
        f"rounds"
    )
    for name, (symbols, expressions, columns) in cases.items():
        naive, generated = (
            sp.lambdify(symbols, expressions, "numpy", cse=cse) for cse in (False, True)
        )
        apart = max(
            abs(a - b).max() for a, b in zip(naive(*columns), generated(*columns), strict=True)
        )
        before, after = operations(expressions)
        arrays = in_turns(naive, generated, columns, rounds)
        in_math = [
            each(sp.lambdify(symbols, expressions, "math", cse=cse)) for cse in (False, True)
        ]
        scalars = in_turns(*in_math, [np.array(columns).T[:SCALAR].tolist()], rounds)
        print(
            f"{name}: {before} -> {after} operations ({before / after:.1f} times fewer), results "
            f"within {apart:.1e}"
        )
        for what, times, count in (("arrays", arrays, TARGETS), ("one by one", scalars, SCALAR)):
            ratio = statistics.median(a / b for a, b in times)
            slow, fast = (
                statistics.median(column) / count * 1e9 for column in zip(*times, strict=True)
            )
            print(
                f"    {what}: naive {slow:.0f} ns, generated {fast:.0f} ns per target: "
                f"{ratio:.1f} times as fast"
            )


def each(call):
    """A function that makes the call for one row after another."""
    return lambda rows: [call(*row) for row in rows]


def in_turns(first, second, arguments, rounds):
    """The times of both calls in seconds: [(first, second), ...]."""
    times = []
    for _ in range(rounds):
        pair = []
        for call in (first, second):
            begin = perf_counter()
            call(*arguments)
            pair.append(perf_counter() - begin)
        times.append(pair)
    return times


if __name__ == "__main__":
    main()
