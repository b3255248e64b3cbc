"""Run the code cells of labs through `Session`, as a page does: without Matplotlib and the other
packages that a page lacks, and without questions. Prints a line of JSON for each cell: [lab, index,
outputs].

    python tests/without.py notebooks/03_irb140_motion.ipynb ...
"""

import json
import os
import sys
from pathlib import Path

LACKS = ("matplotlib", "PIL", "anywidget", "ipywidgets", "IPython", "scipy", "traitlets")


def main(paths):
    sys.modules.update(dict.fromkeys(LACKS))  # `import` raises ModuleNotFoundError
    from robokin.course.page.cells import calls
    from robokin.course.page.session import Session

    for path in paths:
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        os.chdir(path.parent)
        session = Session()
        sources = ["".join(each["source"]) for each in cells if each["cell_type"] == "code"]
        for k, source in enumerate(sources):
            if "predict" not in calls(source):
                print(json.dumps([path.stem, k, session.run(source, k)["outputs"]]), flush=True)


if __name__ == "__main__":
    main([Path(name).resolve() for name in sys.argv[1:]])
