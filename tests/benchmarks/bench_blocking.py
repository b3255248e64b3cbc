"""Measure how long the scripts of an exported lab block a slow phone when its page opens.

    python tests/benchmarks/bench_blocking.py [notebooks/03_irb140_motion.ipynb ...]

The page opens in Chromium, 390 px wide, with the processor slowed down by a factor of four. The
total blocking time is the time by which each long task exceeds 50 ms, summed over the first 5 s.
The page with its scripts and the page without them are opened in turn, five times each.
The script prints the medians and their difference. Aim: a difference of at most 300 ms.
"""

import re
import shutil
import statistics
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from conftest import BROWSERS, FLAGS, NOTEBOOKS
from playwright.sync_api import sync_playwright

from robokin.course.export import export

ROUNDS, THROTTLE, SECONDS = 5, 4, 5
COUNT = """
window.blocked = 0;
new PerformanceObserver(list => {
  for (const task of list.getEntries()) window.blocked += Math.max(0, task.duration - 50);
}).observe({type: "longtask", buffered: true});
"""


def blocking(browser, page_file):
    """The total blocking time of a page in ms."""
    context = browser.new_context(viewport={"width": 390, "height": 844})
    page = context.new_page()
    page.add_init_script(COUNT)
    client = context.new_cdp_session(page)
    client.send("Emulation.setCPUThrottlingRate", {"rate": THROTTLE})
    page.goto(page_file.as_uri())
    page.wait_for_timeout(1000 * SECONDS)
    spent = page.evaluate("window.blocked")
    context.close()
    return spent


def main(paths):
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        chromium = next(filter(None, map(shutil.which, BROWSERS)))
        browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
        for path in paths:
            page = Path(folder) / f"{path.stem}.html"
            export(path, page)
            bare = page.with_suffix(".bare.html")
            bare.write_text(re.sub(r"(?s)<script.*?</script>", "", page.read_text()))
            times = [(blocking(browser, page), blocking(browser, bare)) for _ in range(ROUNDS)]
            whole, without = (statistics.median(each) for each in zip(*times, strict=True))
            rest = (
                f"{without:.0f} ms without scripts, difference {whole - without:.0f} ms (aim 300)"
            )
            print(f"{path.stem}: {whole:.0f} ms, {rest}")


if __name__ == "__main__":
    main([Path(arg) for arg in sys.argv[1:]] or sorted(NOTEBOOKS.glob("[0-9]*.ipynb")))
