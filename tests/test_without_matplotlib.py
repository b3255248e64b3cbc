"""robokin.show without Matplotlib, as in a web page."""

import json
import re
import subprocess
import sys

import numpy as np
import pytest
from conftest import NOTEBOOKS, ROOT
from matplotlib.ticker import MaxNLocator
from without import LACKS

from robokin.course.page.cells import ASKS, calls, needs
from robokin.course.page.session import Session
from robokin.show.drawing import STORED
from robokin.show.numbers import scale

STILL = re.compile(r'(<div class="robokin-player" data-player="\w+">)<img [^>]*><p>[^<]*</p>')
FIGURE = "application/x-robokin-figure"
# Cells that need more than a page has; the text above each of them says so.
NAMED = [
    ("00_start_here", "import ipywidgets"),
    ("08_visit_and_collect", "import json\nimport shutil"),
    ("11_motor_synchronisation", "import numpy as np\nfrom scipy.optimize"),
]
LABS = sorted(NOTEBOOKS.glob("*.ipynb"))


def code_cells(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]


def without(*arguments):
    """What Python prints without the packages that a page lacks."""
    run = subprocess.run([sys.executable, *arguments], cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return run.stdout


def in_python(code):
    return without("-c", f"import sys\nsys.modules.update(dict.fromkeys({LACKS}))\n{code}")


def without_still(outputs):
    """Outputs as in a page: players have no still picture, and figures only their text."""
    for output in outputs:
        data = output.get("data", {})
        html = data.get("text/html", "")
        if "data-player" in html:
            data["text/html"] = STILL.sub(r"\1", html, count=1)
        elif "robokin-figure" in html:
            output["data"] = {"text/plain": data["text/plain"], FIGURE: STORED}
    return outputs


@pytest.mark.parametrize("lab", ["05_scara_motion", "14_conveyor"])
def test_cells_show_the_same_with_and_without_matplotlib(lab, monkeypatch):
    """The text is the same, and players and explorers are the same but for the still picture."""
    path = NOTEBOOKS / f"{lab}.ipynb"
    sources, figures, players = code_cells(path), 0, 0
    monkeypatch.chdir(path.parent)
    monkeypatch.setattr("robokin.course._verdicts", {})  # other tests check exercises, too
    session = Session()
    for line in without("tests/without.py", str(path)).splitlines():
        _, k, outputs = json.loads(line)
        assert outputs == without_still(session.run(sources[k], k)["outputs"]), sources[k]
        shown = [each.get("data", {}) for each in outputs]
        figures += any(FIGURE in data for data in shown)
        players += any("data-player" in data.get("text/html", "") for data in shown)
    assert figures and players > 1


@pytest.mark.parametrize("path", LABS, ids=lambda path: path.stem)
def test_no_cell_needs_a_cell_that_does_not_run_in_a_page(path):
    sources = code_cells(path)
    lacking = re.compile(rf"^\s*(import|from) ({'|'.join(LACKS)})\b", re.M)
    for i, source in enumerate(sources):
        for k in needs(sources, i, ()):
            assert not lacking.search(sources[k]), f"{sources[k]}\n\nis needed by\n\n{source}"
            assert not calls(sources[k]) & ASKS
        if lacking.search(source):
            begins = [begin for lab, begin in NAMED if lab == path.stem]
            assert any(source.startswith(begin) for begin in begins), source


@pytest.mark.parametrize(("lab", "begin"), NAMED)
def test_text_says_which_cells_do_not_run_on_the_website(lab, begin):
    cells = json.loads((NOTEBOOKS / f"{lab}.ipynb").read_text(encoding="utf-8"))["cells"]
    texts = ["".join(cell["source"]) for cell in cells]
    (k,) = [k for k, text in enumerate(texts) if text.startswith(begin)]
    assert re.search(
        r"not run on the website|website, this cell does not run|runs only in JupyterLab",
        texts[k - 1],
    )


def test_each_cell_alone_with_what_it_needs_shows_the_same():
    sources, whole, alone = code_cells(NOTEBOOKS / "13_rotor.ipynb"), Session(), 0
    for i, source in enumerate(sources):
        wanted = whole.run(source, i)["outputs"]
        if not calls(source) & {"predict", "progress"}:
            session = Session()
            for k in needs(sources, i, ()):
                session.run(sources[k], k)
            assert session.run(source, i)["outputs"] == wanted, source
            alone += bool(wanted)
    assert alone > 3


@pytest.mark.parametrize("path", LABS, ids=lambda path: path.stem)
def test_a_number_to_change_changes_more_than_a_picture(path):
    """In a page, pictures do not follow the reader's numbers. So after each `# try`, a text or a
    view of this cell or of a cell that depends on it does.
    """
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    cells = [cell for cell in cells if cell["cell_type"] == "code"]
    sources = ["".join(cell["source"]) for cell in cells]
    for i, source in enumerate(sources):
        if "# try" in source:
            reached = [k for k in range(i, len(cells)) if k == i or i in needs(sources, k, ())]
            outputs = [output for k in reached for output in cells[k]["outputs"]]
            assert any(
                output["output_type"] == "stream"
                or "robokin-figure" not in (shown := str(output["data"]))
                or 'class="robokin-player"' in shown  # its style names figures, too
                for output in outputs
            ), source


# --- Calls that need Matplotlib -------------------------------------------------------------------

MOTION = "import numpy as np\nfrom robokin import SCARA\nfrom robokin import show\n"
MOTION += "t = np.linspace(0, 1, 41)\nq = np.linspace([0, 0.5, 0, 0], [1, 1, 1, 0.1], 41)\n"


@pytest.mark.parametrize(
    "call",
    [
        "show.plot_postures(SCARA, q).savefig('x.png')",
        "show.animate(SCARA, t, q).save('x.gif')",
        "show.plots.palette_png(show.figure('words'))",
    ],
)
def test_calls_that_make_a_picture_say_what_to_install(call, tmp_path):
    told = in_python(
        f"import os; os.chdir({str(tmp_path)!r})\n{MOTION}"
        f"try:\n    {call}\nexcept ImportError as error:\n    print(error)\n"
    )
    assert re.search(r"no Matplotlib.*'\.\[show\]' at the top of a clone", told)
    assert [*tmp_path.iterdir()] == []


def test_a_player_can_be_saved_as_a_page(tmp_path):
    page = tmp_path / "page.html"
    in_python(f"{MOTION}show.animate(SCARA, t, q).save({str(page)!r})")
    assert "<script" in page.read_text(encoding="utf-8")


def test_plots_take_the_calls_of_a_lab():
    told = in_python(
        "from robokin.show import bars, curves, figure\n"
        "fig = figure('One two.')\nfor ax in fig.subplots(2, 3, sharex=True).flat:\n"
        "    ax.set(title='x')\n    curves(ax, [0, 1], {'a': [1, 2], 'b': [2, 3]})\n"
        "bars(fig.subplots(), {'a': 1.0})\nfig.suptitle('t')\n"
        "one, two = fig.subplots(1, 2)\none.spines[:].set_color('red')\n"
        "print(fig, len(fig.subplots(2, 1)), fig.subplots(1, 1, squeeze=False).shape)"
    )
    assert told == "One two. 2 (1, 1)\n"


def test_plots_still_refuse_invalid_calls():
    told = in_python(
        "from robokin.show import curves, figure\n"
        "try:\n    curves(figure('f').subplots(), [0, 1], {'a': [1, 2, 3]})\n"
        "except ValueError as error:\n    print(error)"
    )
    assert "same shape" in told


# --- Ticks ----------------------------------------------------------------------------------------


LOCATOR = MaxNLocator(nbins=4, steps=[1, 2, 2.5, 5, 10])


def matplotlib_ticks(low, high):
    """The lowest tick, the step and the number of ticks; `scale` rounds its range like this."""
    low, high = (float(f"{x:.6g}") if abs(x) > 1e-6 else 0.0 for x in (low, high))
    if high - low < 1e-6 * max(abs(low), abs(high), 1e-3):
        pad = 0.5 * max(abs(low), 1.0)
        low, high = low - pad, high + pad
    ticks = LOCATOR.tick_values(low, high)
    return float(f"{ticks[0]:.6g}") + 0.0, float(f"{ticks[1] - ticks[0]:.6g}"), len(ticks)


@pytest.mark.parametrize("kind", ["any", "whole", "far from zero"])
def test_ticks_equal_those_of_matplotlib(kind):
    rng = np.random.default_rng(140)
    for _ in range(20_000):
        if kind == "any":
            low, high = np.sort(rng.uniform(-1, 1, 2) * 10 ** rng.uniform(-4, 5))
        elif kind == "whole":
            low, high = np.sort(rng.integers(-100, 101, 2) * 10.0 ** rng.integers(-4, 4))
        else:
            low = rng.uniform(-1, 1) * 10 ** rng.uniform(-3, 5)
            high = low + abs(low) * 10 ** rng.uniform(-6.5, 1)
        assert scale(low, high)[:3] == matplotlib_ticks(low, high), (low, high)


# --- Live views -----------------------------------------------------------------------------------


def test_session_answers_the_questions_of_a_live_view():
    lab = code_cells(NOTEBOOKS / "10_obstacle_avoidance.ipynb")
    source = next(source for source in lab if "plan_explorer(" in source)
    told = in_python(
        "import json\nfrom robokin.course.page.session import Session\nsession = Session()\n"
        f"session.run({source!r}, 0)\nsession.run({source!r}, 0)\n"
        "from robokin.show.live import _answers\n(view,) = _answers\n"
        "shown = session.run('_', 1)['outputs'][0]['data']['text/html']\n"
        "data = json.loads(shown[shown.index('{\"kind\"') : shown.rindex(');\\n});')])\n"
        "asked = data['question']\n"
        "print(json.dumps([view, shown, data['first'], session.ask(view, asked),\n"
        "    session.ask(view, asked | {'target': [0.5, 1.5]}), session.ask(view, {})]))"
    )
    view, shown, first, same, other, wrong = json.loads(told)
    assert f'data-player="{view}"' in shown
    assert same == first and other != first and set(other) == set(first)
    assert wrong == {"error": "KeyError: 'posture'"}
