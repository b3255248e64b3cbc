"""Measure how long a check takes, and test whether every student's design task can be solved.

    python tests/benchmarks/bench_checks.py            the solution and every listed wrong answer
    python tests/benchmarks/bench_checks.py 1000       also 1000 variants of every design task

Aims: a median below 0.3 s and no time above 2 s; an endless loop is reported within 5 s; the method
of the solution solves every variant.
"""

import contextlib
import io
import json
import re
import statistics
import sys
import time
from pathlib import Path

from robokin.course import book, check, solution
from robokin.course.catch import Catch
from robokin.course.function import Function


def timed(name, answer, **who):
    begin = time.perf_counter()
    verdict = check(name, answer, **who)
    return time.perf_counter() - begin, verdict


def endless(*inputs):
    while True:
        pass


def answers(name, exercise):
    """The solution, and every listed wrong answer."""
    space = {}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(solution(name), space)
    if isinstance(exercise, (Function, Catch)):
        made = [v for k, v in space.items() if callable(v) and k in CALLS[name]]
        yield from made
        if isinstance(exercise, Function):
            yield from (exercise.steps.program(variant) for variant in exercise.own)
    else:
        yield from (v for k, v in space.items() if k in CALLS[name])


def calls():
    """A dict that maps each exercise to the name that its lab passes to `check` as the answer."""
    found = {}
    for path in (Path(__file__).parents[2] / "notebooks").glob("*.ipynb"):
        code = "\n".join("".join(c["source"]) for c in json.loads(path.read_text())["cells"])
        found |= dict(re.findall(r'^check\("([\w.]+)", (\w+)', code, re.M))
    return found


CALLS = calls()


def checks():
    everything = []
    for lab in book.labs():
        for n, exercise in book.lab(lab).exercises.items():
            name = f"{lab}.{n}"
            times = [timed(name, each, who="your name")[0] for each in answers(name, exercise)]
            everything += times
            print(
                f"{name:20} {len(times):4} answers: median {statistics.median(times):.3f} s, "
                f"longest {max(times):.3f} s"
            )
            if isinstance(exercise, (Function, Catch)):
                seconds, verdict = timed(name, endless)
                print(
                    f"{'':20} an endless loop: reported after {seconds:.2f} s ({verdict.mistake})"
                )
    print(f"all: median {statistics.median(everything):.3f} s, longest {max(everything):.3f} s")


def variants(count):
    for lab in book.labs():
        for n, exercise in book.lab(lab).exercises.items():
            if not getattr(exercise, "given", None):
                continue
            name = f"{lab}.{n}"
            text, solved, begin = solution(name), 0, time.perf_counter()
            for k in range(count):
                space, who = {}, f"student {k}"
                with contextlib.redirect_stdout(io.StringIO()):
                    exec(re.sub(r"^who = .*$", f"who = {who!r}", text, flags=re.M), space)
                solved += check(name, space[CALLS[name]], who=who).holds
            seconds = time.perf_counter() - begin
            print(f"{name}: {solved} of {count} variants solved, {seconds:.0f} s")


if __name__ == "__main__":
    checks()
    if len(sys.argv) > 1:
        variants(int(sys.argv[1]))
