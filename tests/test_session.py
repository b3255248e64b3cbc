"""The Python that runs cells in a page: which cells a cell needs, and what a cell shows."""

import json
import subprocess
import sys

import pytest
import sympy

from robokin.course.page.cells import needs
from robokin.course.page.session import CUT, MOST, Session, mime_bundle

LAB = [
    "import numpy as np\nfrom robokin import IRB140",
    "a = 1",
    "b = a + 1",
    "a = 3",
    "def twice(x):\n    return b * x",
    "predict('x.p1')\nc = 5",
    "figure('f')\nd = 6",
    "d = 7",
    "fig = Sketch('g')\ne = a",
]


@pytest.mark.parametrize(
    ("source", "have", "wanted"),
    [
        ("a", (), [3]),
        ("b", (), [1, 2]),  # the cell above `b` that sets a, not the last one
        ("twice(2)", (), [1, 2, 4]),
        ("twice(2)", ("a",), [2, 4]),
        ("twice(2)", ("b",), [4]),
        ("a = 5\nprint(a)", (), []),
        ("a = a + 1", (), [3]),
        ("a += 1", (), [3]),
        ("[a for a in range(3)]", (), []),
        ("for a in range(3):\n    print(a)", (), []),
        ("if 1:\n    a = 2\n    print(a)", (), []),
        ("if 1:\n    a = 2\nprint(a)", (), [3]),
        ("if b:\n    a = 2\nelse:\n    print(a)", (), [1, 2, 3]),
        ("def f():\n    return np.pi", (), [0]),
        ("lambda: [np.pi for _ in range(3)]", (), [0]),
        ("c", (), []),  # a question never runs for another cell
        ("d", (), [7]),
        ("e", (), [3, 8]),  # only a picture's cell sets it
        ("print(len('a'))", (), []),
        ("if a: (", (), []),
    ],
)
def test_needed_cells_set_the_names(source, have, wanted):
    assert needs([*LAB, source, "a = 9"], len(LAB), have) == wanted


def test_needed_cells_need_no_others():
    found = needs([*LAB, "twice(d)"], len(LAB), ())
    session = Session()
    for k in found:
        assert session.run(LAB[k], k)["outputs"] == []
    (output,) = session.run("twice(d)", len(LAB))["outputs"]
    assert output["data"] == {"text/plain": "14"}


def shown(source, session=None):
    outputs = (session or Session()).run(source, 3)["outputs"]
    assert json.loads(json.dumps(outputs)) == outputs
    return outputs


def text(source):
    return [each.get("text") or each["data"]["text/plain"] for each in shown(source)]


def test_outputs_come_in_order():
    code = "import sys\nprint(1)\nprint(2, file=sys.stderr)\ndisplay('x')\nprint(3)\n4"
    assert text(code) == ["1\n", "2\n", "'x'", "3\n", "4"]
    kinds = ["stream", "stream", "display_data", "stream", "execute_result"]
    assert [each["output_type"] for each in shown(code)] == kinds


@pytest.mark.parametrize(
    "source", ["1;", "1 ; # said", "None", "x = 1", "", "# nothing", "print()"]
)
def test_no_result_is_shown(source):
    assert [each["output_type"] for each in shown(source)] == ["stream"] * (source == "print()")


def test_a_semicolon_in_a_comment_or_string_does_not_hush():
    assert text("';'") == ["';'"] and text("1 # ;") == ["1"]


def test_values_show_what_a_notebook_shows():
    session = Session()
    session.run("class Loud:\n    def _repr_html_(self):\n        return '<b>!</b>'", 0)
    session.run("class Many:\n    def _repr_mimebundle_(self):\n        return {'a/b': '1'}", 0)
    (loud,), (many,) = shown("Loud()", session), shown("Many()", session)
    assert loud["data"]["text/html"] == "<b>!</b>" and "Loud" in loud["data"]["text/plain"]
    assert many["data"] == {"a/b": "1"}
    (kind,) = shown("Loud", session)  # the class, not an object
    assert set(kind["data"]) == {"text/plain"}


def test_names_are_those_that_cells_have_set():
    session = Session()
    assert session.run("a, _b = 1, 2\nimport math", 0)["names"] == ["_b", "a", "math"]
    assert session.run("del a\n1/0", 1)["names"] == ["_b", "math"]


def error(source, session=None):
    outputs = shown(source, session)
    assert outputs[-1]["output_type"] == "error"
    return outputs[-1]


def test_errors_name_the_line_and_no_other_file():
    session = Session()
    session.run("def f(x):\n    return 1 / x", 1)
    found = error("a = 1\n\nf(a - 1)", session)
    assert (found["ename"], found["evalue"]) == ("ZeroDivisionError", "division by zero")
    assert found["traceback"] == [
        "cell, line 3",
        "    f(a - 1)",
        "another cell, line 2",
        "    return 1 / x",
        "ZeroDivisionError: division by zero",
    ]


def test_errors_inside_robokin_name_the_line_of_the_cell():
    found = error("from robokin import IRB140\nIRB140.fk([1, 2])")
    assert found["ename"] == "ValueError" and "q" in found["evalue"]
    assert found["traceback"][:2] == ["cell, line 2", "    IRB140.fk([1, 2])"]
    assert "session.py" not in str(found) and "arm.py" not in str(found)


def test_syntax_errors_name_the_line():
    found = error("a = 1\nb = (2\nc = 3")
    assert found["traceback"] == [
        "cell, line 2",
        "    b = (2",
        f"SyntaxError: {found['evalue']}",
    ]


@pytest.mark.parametrize(
    ("source", "meant"),
    [
        ("from robokin import IRB140\nIRB140.branh(1, 1, 1)", "branch"),
        ("swing = 1\nprint(swimg)", "swing"),
        ("pritn(1)", "print"),
        ("import math\nmath.qqqqqqqqqq", None),
    ],
)
def test_a_misspelled_name_has_pythons_suggestion(source, meant):
    says = error(source)["evalue"]
    assert says.endswith(f". Did you mean: '{meant}'?") if meant else "Did you" not in says


def test_endless_recursion_is_short():
    found = error("def f():\n    f()\nf()")
    assert found["ename"] == "RecursionError" and len(found["traceback"]) < 12


@pytest.mark.parametrize(
    ("source", "kind", "words"),
    [
        ("input('name? ')", "RuntimeError", "cannot ask for input"),
        ("x = 1\n!pip install scipy", "SyntaxError", "!pip install scipy is a command for Jupyter"),
        ("%timeit 1", "SyntaxError", "%timeit 1 is a command for Jupyter"),
        ("import tensorflow_of_old", "ModuleNotFoundError", "only Python, NumPy and robokin"),
        ("raise OSError(138, 'emscripten does not support processes.')", "OSError", "programs"),
        ("open('tasks/one.json')", "FileNotFoundError", "no files beside the lab"),
        ("import numpy as np\nnp.ones(10**17)", "MemoryError", "not enough memory"),
        ("raise ValueError('Maximum allowed dimension exceeded')", "MemoryError", "memory"),
        ("raise SystemExit", "SystemExit", "does nothing"),
    ],
)
def test_what_a_page_cannot_do_is_said(source, kind, words):
    found = error(source)
    assert found["ename"] == kind and words in found["evalue"]


@pytest.mark.parametrize("name", ["matplotlib", "scipy.optimize", "ipywidgets", "IPython.display"])
def test_missing_libraries_are_named(name, monkeypatch):
    monkeypatch.setitem(sys.modules, name.partition(".")[0], None)
    monkeypatch.setitem(sys.modules, name, None)
    found = error(f"import {name}")
    assert found["ename"] == "ModuleNotFoundError" and "JupyterLab" in found["evalue"]
    assert "a page has no" in found["evalue"]


def test_too_much_output_is_cut():
    outputs = shown("for _ in range(300):\n    print('x' * 10_000)\n'end'")
    assert sum(len(each["text"]) for each in outputs) < MOST + 1000
    assert outputs[-1]["text"] == CUT + "\n"


def test_a_warning_is_shown_on_each_run():
    code = (  # in a process of its own, since pytest collects warnings
        "from robokin.course.page.session import Session\nsession = Session()\n"
        "for _ in range(2):\n    cell = 'import warnings\\nwarnings.warn(\"odd\")'\n"
        "    print(session.run(cell, 3)['outputs'][0]['text'])"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.split("\n\n")[:2] == ["UserWarning: odd (cell, line 2)"] * 2


def test_streams_are_given_back():
    before = sys.stdout, sys.stderr
    Session().run("import sys\nsys.stdout = None\n1/0", 0)
    assert (sys.stdout, sys.stderr) == before


def test_a_formula_of_sympy_is_shown_as_mathml():
    x = sympy.Symbol("x_1")
    data = mime_bundle(sympy.sqrt(x) / 2)
    assert data["text/plain"] == "sqrt(x_1)/2"
    assert "<msub><mi>x</mi><mi>1</mi></msub>" in data["text/html"]
    assert data["text/html"].startswith("<math") and "<msqrt>" in data["text/html"]
