"""Measure how much of a screen the views of every lab need in JupyterLab, at 1366 x 768 with the
file browser open, and report the views that need more than is allowed.

    python tests/benchmarks/fit.py [notebooks/03_irb140_motion.ipynb ...]

The stored outputs are trusted and nothing is run. For each view, the script prints the height in
px, the height allowed, the tallest canvas and the tallest panel of curves.
"""

import shutil
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from conftest import BROWSERS, FLAGS, NOTEBOOKS, JupyterLab
from fitting import RECORD, SCREEN, walked
from playwright.sync_api import sync_playwright


def main(paths):
    wrong = 0
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        home = Path(folder)
        shutil.copytree(NOTEBOOKS, home / "labs")
        chromium = next(filter(None, map(shutil.which, BROWSERS)))
        browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
        with JupyterLab(home, home / "labs") as jupyter:
            for path in paths:
                page = browser.new_page(viewport=SCREEN)
                page.add_init_script(RECORD)
                jupyter.trust(path.name)
                jupyter.open(page, path.name)
                for view in walked(page):
                    if "rk-ask" in view["kind"]:
                        continue
                    over = view["height"] > view["most"]
                    wrong += over
                    print(
                        f"{path.stem[:2]} {view['kind'][6:]:9} {view['height']:6.0f} of "
                        f"{view['most']}  canvas {view['canvas']:4.0f}  plot {view['plot']:4.0f}  "
                        f"{'TOO TALL ' if over else ''}{view['title']}",
                        flush=True,
                    )
                page.close()
        browser.close()
    print(f"{wrong} views are too tall")


if __name__ == "__main__":
    main([Path(each) for each in sys.argv[1:]] or sorted(NOTEBOOKS.glob("*.ipynb")))
