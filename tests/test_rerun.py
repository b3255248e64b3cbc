"""Readers run cells repeatedly: every cell can run again, and every value after `# try` can be
tried.

This module tests one value for each `# try`; `python tests/rerun.py --seed 1` tries all of them and
also runs the cells in a random order.
"""

import json

import pytest
import rerun
from conftest import NOTEBOOKS

PATHS = [*sorted(NOTEBOOKS.glob("*.ipynb")), *sorted(NOTEBOOKS.glob("documents/*.ipynb"))]
forks = pytest.mark.skipif(not rerun.FORKS, reason="values are tried in a forked process")
# Python 3.12 warns about forking a process that has threads; the children here only compute
pytestmark = pytest.mark.filterwarnings("ignore:.*multi-threaded.*fork:DeprecationWarning")


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_cells_run_again_with_other_values(path):
    """No cell shows a different output when it runs again, and no value breaks a cell or makes its
    text false.
    """
    _, tried, again = rerun.faults(path, sample=True)
    assert tried == [] and again == []


def test_reused_names_are_detected(tmp_path):
    path = _lab(tmp_path, "a = 1", "print(a + 1)", "a = 5", "def f():\n    return b", "b = 2")
    assert rerun.faults(path) == (0, [], ["[2] printed '6' on a later run and '2' on the first"])
    assert rerun.faults(_lab(tmp_path, "a = 1", "print(a + 1)", "b = 5")) == (0, [], [])
    fault = rerun.faults(_lab(tmp_path, "a = 1", "print(a)", "del a\nc = 1"))[2][0]
    assert "NameError" in fault


def test_loop_does_not_read_a_variable_that_it_sets_first():
    cell = rerun.Cell("for a, b in pairs:\n    c = a + d\n    e(b, c)\nfor f in f:\n    g += f")
    assert cell.reads == {"pairs", "d", "e", "f", "g"}
    assert cell.writes == {"a", "b", "c", "f", "g"}
    cell = rerun.Cell(
        "for a in b:\n    if a:\n        continue\n    if c:\n        break\n    d = a"
    )
    assert cell.reads == {"b", "c"} and cell.writes == {"a", "d"}


FIGURE = "from robokin.show import figure\nfig = figure({alt})\nfig.subplots().plot([0, a])\nfig"


@forks
def test_failing_values_and_hard_coded_numbers_are_detected(tmp_path):
    def faults(*cells):
        return rerun.faults(_lab(tmp_path, *cells))[:2]

    assert faults("a = 1  # try 2, 3", FIGURE.format(alt='f"Up to {a}, q1 and axis 2"')) == (2, [])
    count, [two, three] = faults("a = 1  # try 2, 3", FIGURE.format(alt='"Up to 1"'))
    assert count == 2 and "a = 3: [2] has the hard-coded text 'Up to 1' in 'Up to 1'" in three
    # this cell does not depend on the value, so its text does not have to change
    assert faults("a = 1\nc = 1  # try 2", FIGURE.format(alt='"Up to 1"')) == (1, [])
    count, [fault] = faults("a = 1  # try 0, 5", "print(1 / a)", "b = 1")
    assert count == 2 and "a = 0: cell 2: ZeroDivisionError" in fault
    [fault] = faults("a = 1  # try other values")[1]
    assert "invalid syntax" in fault
    # a cell that depends on the value may need a cell that does not
    assert faults("a = 1  # try 2", "b = 3", "print(a + b)") == (1, [])
    # a name that a cell sets again no longer depends on the value
    assert faults("a = 1  # try 0", "a = 2", "print(1 / a)") == (1, [])
    assert faults("a = 1  # try 0", "if a:\n    a = 2", "print(1 / a)")[1]
    assert faults("a = 1  # try 0", "def f():\n    return 1 / a", "b = 2", "print(f() + b)")[1]
    assert faults("a = [1]\nb = 1  # try 0", "a[0] = b", "a.append(2)", "print(1 / a[0])")[1]
    # changes made with one value are undone: the next value starts from the state after the cells
    # above
    assert faults("x = [1]", "a = 1  # try 2, 3\nx.append(a)", "assert len(x) == 2")[1] == []


def _lab(folder, *sources):
    path = folder / "lab.ipynb"
    cells = [{"cell_type": "code", "source": source.splitlines(True)} for source in sources]
    path.write_text(json.dumps({"cells": cells}))
    return path
