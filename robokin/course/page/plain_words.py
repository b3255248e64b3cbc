"""What a page cannot do, in plain words."""

import re

JUPYTERLAB = "Run this cell in JupyterLab."
MISSING = {
    "IPython": "JupyterLab's own parts",
    "PIL": "Pillow",
    "anywidget": "widgets",
    "ipywidgets": "widgets",
    "matplotlib": "Matplotlib",
    "scipy": "SciPy",
    "sympy": "SymPy",
}
COMMAND = re.compile(r"^\s*([!%].*)$", re.M)
TOO_LARGE = ("Maximum allowed dimension exceeded", "array is too big", "Maximum allowed size")


def told(error: BaseException, source: str) -> tuple[str, str]:
    """Return the name of an error and its message, in plain words where a page is the reason."""
    kind, says = type(error).__name__, str(error)
    if isinstance(error, SyntaxError):
        if command := COMMAND.search(source):
            says = f"{command[1].strip()} is a command for Jupyter. A page runs only Python."
            return kind, says
        return kind, error.msg or says
    if isinstance(error, ModuleNotFoundError) and error.name:
        top = error.name.partition(".")[0]
        if top in MISSING:
            return kind, f"{error.name}: a page has no {MISSING[top]}. {JUPYTERLAB}"
        return kind, f"{error.name}: a page has only Python, NumPy and robokin. {JUPYTERLAB}"
    if isinstance(error, MemoryError) or says.startswith(TOO_LARGE):
        return "MemoryError", f"There is not enough memory for this. {says}".strip()
    if isinstance(error, OSError) and "emscripten" in says:
        return kind, f"A page cannot start other programs. {JUPYTERLAB}"
    if isinstance(error, FileNotFoundError):
        return kind, f"{error.filename}: a page has no files beside the lab. {JUPYTERLAB}"
    if isinstance(error, SystemExit):
        return kind, "The cell ended Python's program, which does nothing here."
    return kind, says
