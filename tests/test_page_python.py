"""The comparison of the page's Python with CPython (page_python.py) finds every difference."""

import copy
import json

import page_python
import pytest
from page_python import Lab, Named, apart

PAGE = 'window.x;\n$player.play("0123456789ab", {data});\n'
VERDICT = {"text": "lab.1: holds.", "holds": True, "mistake": None, "points": 1.0}


def view(**data):
    return {
        "output_type": "execute_result",
        "data": {"text/html": PAGE.replace("{data}", json.dumps(data)), "text/plain": "Player"},
    }


@pytest.fixture
def lab(tmp_path, monkeypatch):
    """A lab with two cells and the same answers from both Pythons."""
    monkeypatch.setattr(page_python, "EXPECTED", [])
    sources = ["print(first)", "animate(second)"]
    cells = [{"cell_type": "code", "source": [text]} for text in sources]
    (tmp_path / "01_lab.ipynb").write_text(json.dumps({"cells": cells}))
    lab = Lab(tmp_path / "01_lab.ipynb")
    printed = {"output_type": "stream", "name": "stdout", "text": "22 %\n"}
    shown = [[printed], [view(q=[0.5, None], name="arm")]]
    lab.here = {"cells": [{"outputs": each} for each in shown], "verdicts": {"lab.1: NaN": VERDICT}}
    lab.there = copy.deepcopy(lab.here)
    return lab


def test_equal_answers_have_no_difference(lab, capsys):
    assert page_python.report([lab]) == 0
    assert "0 differences" in capsys.readouterr().out
    assert lab.counts() == (2, 1, 1, 1)


@pytest.mark.parametrize("kind", ["error", "text", "view", "verdict", "cpython"])
def test_a_difference_must_be_named(lab, kind, monkeypatch, capsys):
    one, two = (cell["outputs"] for cell in lab.there["cells"])
    if kind == "error":
        one[:] = [{"output_type": "error", "ename": "NameError", "evalue": "x"}]
    elif kind == "cpython":
        lab.here["cells"][0]["outputs"] = [{"output_type": "error", "ename": "E", "evalue": "x"}]
        one[0]["text"] = ""
    elif kind == "text":
        one[0]["text"] = "21 %\n"
    elif kind == "view":
        two[0] = view(q=[0.5 + 1e-8, None], name="arm")
    else:
        lab.there["verdicts"]["lab.1: NaN"] = VERDICT | {"mistake": "radians"}
    assert page_python.report([lab]) == 1
    assert "NOT EXPECTED" in capsys.readouterr().out
    where = {"view": "animate(", "verdict": "lab.1: NaN"}.get(kind, "print(")
    named = Named("01_lab", kind, where, "a reason")
    monkeypatch.setattr(page_python, "EXPECTED", [named])
    assert page_python.report([lab]) == 0
    assert "a reason" in capsys.readouterr().out
    monkeypatch.setattr(page_python, "EXPECTED", [named, named._replace(where="another")])
    assert page_python.report([lab]) == 1, "a difference that is no more must not stay in the list"


@pytest.mark.parametrize(
    "one, other, place",
    [
        ({"a": [1, {"b": 2.0}]}, {"a": [1, {"b": 2.0 + 1e-10}]}, None),
        ({"a": [1, {"b": 2.0}]}, {"a": [1, {"b": 2.1}]}, "view.a[1].b"),
        ({"a": [1, 2]}, {"a": [1]}, "view.a"),
        ({"a": 1}, {"b": 1}, "view"),
        ([None, "x"], [None, "y"], "view[1]"),
        ([0], [None], "view[0]"),
        (["q = 2.2261521378281240"], ["q = 2.2261521378281235"], None),
        (["q = 2.2261521378281240"], ["q = 2.2261521478281240"], "view[0]"),
        (["q = 2.2261521378281240"], ["p = 2.2261521378281240"], "view[0]"),
        ([1], [True], "view[0]"),
        ([1.0], [float("nan")], "view[0]"),
    ],
)
def test_the_first_difference_of_two_views_is_found(one, other, place):
    found = apart(one, other)
    assert found is None if place is None else found.startswith(f"{place}:")


@pytest.mark.parametrize("ci, status", [("", 0), ("true", 1)])
def test_without_files_it_fails_only_under_ci(ci, status, monkeypatch, capsys):
    def assets(folder):
        raise ValueError("pyodide: could not be fetched")

    monkeypatch.setenv("CI", ci)
    monkeypatch.setattr(page_python.files, "assets", assets)
    assert page_python.main(["00"]) == status
    assert "not run: no files: pyodide" in capsys.readouterr().out
