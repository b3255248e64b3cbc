"""Re-execute notebooks from top to bottom and store them in a fixed form.

    python tests/execute_notebooks.py                          all of notebooks/
    python tests/execute_notebooks.py notebooks/00_start_here.ipynb ...

Each notebook runs in a fresh kernel. The stored form depends only on its cells: it has no widget
state or timestamps, streams are joined, and a picture with unchanged pixels keeps its old bytes
(another version of zlib compresses the same pixels differently). A diff therefore shows only what
changed, and a second run changes nothing. A notebook that fails is reported and left unchanged, the
others continue, and the exit status is 1.
"""

import argparse
import base64
import hashlib
import io
import os
import re
import sys
import time
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError
from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
KEPT_CELL_METADATA = ("tags", "reason", "jupyter")
METADATA = {
    "kernelspec": {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"},
    # JupyterLab writes this when a kernel has started; if it differs, the lab counts as unsaved.
    # `version` is the reader's Python version, so no stored value is correct for all readers.
    "language_info": {
        "codemirror_mode": {"name": "ipython", "version": 3},
        "file_extension": ".py",
        "mimetype": "text/x-python",
        "name": "python",
        "nbconvert_exporter": "python",
        "pygments_lexer": "ipython3",
        "version": "3.11.7",
    },
}
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
ANSI = re.compile("\x1b\\[[0-9;]*m")  # colours of a traceback
PNG = re.compile("iVBORw0KGgo[A-Za-z0-9+/]+=*")  # base64 of the eight bytes that begin every PNG


def notebooks():
    """The paths of all labs and of the companions to the documents."""
    top = ROOT / "notebooks"  # not recursive, since JupyterLab keeps checkpoints in a subfolder
    return [*sorted(top.glob("*.ipynb")), *sorted(top.glob("documents/*.ipynb"))]


def execute(path, timeout=120):
    """Run the notebook at `path` and store it; return True if its bytes changed. If a cell fails,
    its error is raised.
    """
    before = path.read_bytes()
    notebook = nbformat.reads(before.decode(), as_version=4)
    pictures = dict(_pictures(notebook))
    ignored = {
        cell.id: (cell.source, cell.outputs)
        for cell in notebook.cells
        if cell.get("outputs") and "nbval-ignore-output" in cell.metadata.get("tags", ())
    }
    client = NotebookClient(
        notebook,
        timeout=timeout,
        kernel_name="python3",
        coalesce_streams=True,
        record_timing=False,
        store_widget_state=False,
        resources={"metadata": {"path": str(path.parent)}},
    )
    client.execute()
    # an output that no test compares, such as a timing, is updated only if its cell has changed
    for cell in notebook.cells:
        if cell.id in ignored and ignored[cell.id][0] == cell.source:
            cell.outputs = ignored[cell.id][1]
    after = (normalised(notebook, pictures) + "\n").encode()
    if after != before:
        path.write_bytes(after)
    return after != before


def normalised(notebook, pictures):
    """The text of an executed notebook in the stored form. A picture whose pixels are in `pictures`
    (pixels -> base64) keeps its old bytes.
    """
    notebook.metadata = nbformat.from_dict(METADATA)
    notebook.nbformat, notebook.nbformat_minor = 4, 5
    count = 0
    for cell in notebook.cells:
        cell.metadata = nbformat.from_dict(
            {k: v for k, v in cell.metadata.items() if k in KEPT_CELL_METADATA}
        )
        if cell.cell_type != "code":
            continue
        cell.execution_count = None
        if cell.source.strip():
            count += 1
            cell.execution_count = count
        for output in cell.outputs:
            if output.output_type == "execute_result":
                output.execution_count = count
            # A widget is useless without its kernel: a reader would see an error instead.
            output.get("data", {}).pop(WIDGET_VIEW, None)
            for kind, value in output.get("data", {}).items():
                if isinstance(value, str):
                    output.data[kind] = PNG.sub(lambda m: pictures.get(_pixels(m[0]), m[0]), value)
    return nbformat.writes(notebook, version=4).rstrip("\n")


def _pictures(notebook):
    for cell in notebook.cells:
        for output in cell.get("outputs", ()):
            for value in output.get("data", {}).values():
                for text in PNG.findall(value) if isinstance(value, str) else ():
                    yield _pixels(text), text


def _pixels(text):
    """The pixels of a PNG (base64), and its resolution in pixels per inch."""
    try:
        image = Image.open(io.BytesIO(base64.b64decode(text)))
        shown = image.convert("RGBA")
    except Exception:  # base64 that only looks like a PNG is left unchanged
        return text
    return shown.size, image.info.get("dpi"), hashlib.sha256(shown.tobytes()).hexdigest()


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("notebooks", nargs="*", type=Path)
    paths = parser.parse_args(arguments).notebooks or notebooks()
    # Suppress a warning that would end up in the outputs.
    os.environ.setdefault("PYDEVD_DISABLE_FILE_VALIDATION", "1")
    failed = []
    for path in paths:
        start = time.perf_counter()
        try:
            what = "stored" if execute(path.resolve()) else "unchanged"
        except (
            CellExecutionError,
            CellTimeoutError,
            DeadKernelError,
            OSError,
            ValueError,
        ) as error:
            failed.append(path.name)
            what = f"FAILED, left as it was\n{ANSI.sub('', str(error))}"
        print(f"{path.name}: {time.perf_counter() - start:.1f} s, {what}", flush=True)
    if failed:
        print(f"{len(failed)} of {len(paths)} notebooks failed: {', '.join(failed)}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
