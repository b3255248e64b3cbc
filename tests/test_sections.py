"""A reader who comes back the next day runs one section only: it works without the others, or after
those that its text names.
"""

import json
import os
import shutil
import subprocess
import sys

from conftest import NOTEBOOKS
from test_notebooks import every_lab, sections_of, with_sections_to_run_first

# Runs each list of cells without the names of the others, and prints the errors. One process for
# all of them: a kernel takes longer to start than most sections take to run.
ALONE = """
import contextlib, io, json, sys
from IPython.core.interactiveshell import InteractiveShell

shell, failed = InteractiveShell.instance(), []
for title, cells in json.load(sys.stdin):
    shell.reset(new_session=False)
    for source in cells:
        with contextlib.redirect_stdout(io.StringIO()):
            done = shell.run_cell(source, store_history=False)
        error = done.error_before_exec or done.error_in_exec
        if error is not None:
            failed.append([title, source[:80], repr(error)])
print(json.dumps(failed))
"""


@every_lab
def test_section_runs_without_the_sections_that_its_text_does_not_name(lab, tmp_path):
    lists = list(_lists(lab))
    assert len(lists) > 2, "no sections found"
    assert _errors(lists, tmp_path) == []


def test_a_missing_section_is_found(tmp_path):
    lists = [("one", ["import numpy as np\nx = np.pi"]), ("two", ["y = 1", "print(x + y)"])]
    [(title, source, error)] = _errors(lists, tmp_path)
    assert (title, source) == ("two", "print(x + y)") and error.startswith("NameError")


def _lists(lab):
    """For each section, its title and the cells to run."""
    sections = sections_of(lab)
    for title, (_, own) in sections.items():
        if own:
            yield title, [each.source for each in with_sections_to_run_first(sections, title)]


def _errors(lists, folder):
    """The errors of the cells, each as the title of its section, its beginning and the error. A
    cell may write into the folder.
    """
    here = folder / "notebooks"
    shutil.copytree(NOTEBOOKS, here)
    done = subprocess.run(
        [sys.executable, "-c", ALONE],
        input=json.dumps(list(lists)),
        cwd=here,
        env={**os.environ, "MPLBACKEND": "Agg"},
        capture_output=True,
        text=True,
        check=True,
    )
    return json.loads(done.stdout.splitlines()[-1])
