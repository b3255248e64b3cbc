"""Run all code cells of labs through `Session`, as a page does: without Matplotlib and the other
packages that a page lacks. Prints one JSON line for each cell: [lab, index, outputs].

    python tests/without.py notebooks/03_irb140_motion.ipynb ...
"""

import json
import os
import sys
from pathlib import Path

LACKS = ("matplotlib", "PIL", "anywidget", "ipywidgets", "IPython", "scipy", "sympy", "traitlets")


def main(paths):
    sys.modules.update(dict.fromkeys(LACKS))  # `import` raises ModuleNotFoundError
    from robokin.course.page.session import Session

    for path in paths:
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        os.chdir(path.parent)
        session, k = Session(), 0
        for cell in cells:
            if cell["cell_type"] == "code":
                shown = session.run("".join(cell["source"]), k)["outputs"]
                print(json.dumps([path.stem, k, shown]), flush=True)
                k += 1


if __name__ == "__main__":
    main([Path(name).resolve() for name in sys.argv[1:]])
