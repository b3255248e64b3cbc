"""The examples in docstrings are correct: each runs with NumPy as `np`, the public names of
`robokin` and those of its own module or job.
"""

import doctest
import importlib
import inspect
import io

import numpy as np
import pytest

import robokin

PACKAGES = ("robokin", "robokin.arms", "robokin.motion", "robokin.show")
JOBS = tuple(
    f"robokin.jobs.{job}"
    for job in ("visit_collect", "conveyor", "obstacles", "moving", "redundancy", "steppers")
)
NAMES = {"np": np, **{name: getattr(robokin, name) for name in robokin.__all__}}
HOW = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS


def public():
    """The functions and classes of the packages and jobs, and the modules that define them, by
    name.
    """
    found = {}
    for module in map(importlib.import_module, (*PACKAGES, *JOBS)):
        found[module.__name__] = module
        for name in getattr(module, "__all__", vars(module)):
            value = getattr(module, name)
            home = getattr(value, "__module__", "")
            ours = home == module.__name__ or hasattr(module, "__all__")
            if ours and name[0] != "_" and (inspect.isclass(value) or inspect.isroutine(value)):
                found[f"{home}.{name}"] = value
                found[home] = importlib.import_module(home)
    return found


PUBLIC = public()


def examples(name):
    """The examples in the docstring of a public name, and of its methods."""
    value = PUBLIC[name]
    module = value if inspect.ismodule(value) else inspect.getmodule(value)
    if module.__package__ in JOBS:  # the examples of a job use its public names
        module = PUBLIC[module.__package__]
    names = {key: item for key, item in vars(module).items() if key[0] != "_"} | NAMES
    finder = doctest.DocTestFinder(recurse=not inspect.ismodule(value), exclude_empty=True)
    return [test for test in finder.find(value, name, globs=names) if test.examples]


@pytest.mark.parametrize("name", [name for name in PUBLIC if examples(name)])
def test_docstring_examples_are_correct(name):
    said = io.StringIO()
    runner = doctest.DocTestRunner(optionflags=HOW)
    for test in examples(name):
        runner.run(test, out=said.write, clear_globs=False)
    assert runner.summarize(verbose=False).failed == 0, said.getvalue()


def test_wrong_example_is_detected():
    test = doctest.DocTestParser().get_doctest(">>> deg * 180\n3.0\n", dict(NAMES), "x", None, 0)
    assert doctest.DocTestRunner(optionflags=HOW).run(test, out=lambda _: None).failed == 1
