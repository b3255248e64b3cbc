"""What tests/page_python.py runs in CPython and, unchanged, in the page: the cells of a lab
in one session, and answers to its exercises.
"""

import json
import sys
import time
import warnings


def cells(sources):
    """The outputs of each cell, and the seconds that it took."""
    from robokin.course.page.session import Session

    session, made = Session(), []
    for k, source in enumerate(sources):
        first = time.perf_counter()
        outputs = session.run(source, k)["outputs"]
        made.append({"outputs": outputs, "seconds": time.perf_counter() - first})
    return made


def verdicts(calls):
    """The verdict on each answer, by exercise and answer: the text, the mistake and the points.
    `calls` has the text of each exercise's call of `check` in its lab.
    """
    import numpy as np

    from robokin.course import book, check, edits
    from robokin.course.function import Function

    made = {}
    trivial = {"0": 0, "NaN": np.nan, "zeros": np.zeros(6), "a dict": {}, "a string": "answer"}
    trivial |= {"a function that returns True": lambda *given: True, "nothing": ...}
    for name, call in calls.items():
        exercise = book.find(name, "exercises")
        given = {}
        if isinstance(exercise, Function):
            function = edits.function_name(name, 1, exercise.solution)
            for wrong in exercise.own:
                text = wrong.text(exercise.solution)
                key = wrong.name
                while key in given:
                    key += "'"
                given[key] = edits.run(text, exercise.code)[function]
        for key, answer in {**given, **trivial}.items():
            made[f"{name}: {key}"] = _verdict(check(name, answer, who="your name"))
        space = {"check": check}
        exec(compile(exercise.solution, name, "exec"), space)
        space.setdefault("who", "your name")
        made[f"{name}: the solution"] = _verdict(eval(call, space))
    return made


def _verdict(verdict):
    text = repr(verdict)
    return {
        "text": text,
        "holds": verdict.holds,
        "mistake": verdict.mistake,
        "points": verdict.points,
    }


def answer(line):
    """The answer to a question, both as JSON: {"cells": sources} or {"verdicts": calls}."""
    ((what, given),) = json.loads(line).items()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return json.dumps({"cells": cells, "verdicts": verdicts}[what](given))


if __name__ == "__main__":  # one question a line; what the cells print goes to stderr
    out, sys.stdout = sys.stdout, sys.stderr
    for line in sys.stdin:
        print(answer(line), file=out, flush=True)
