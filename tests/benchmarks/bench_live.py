"""Compare explorers that ask a kernel with `interact`, which redraws a figure with the same
content.

    python tests/benchmarks/bench_live.py

In JupyterLab a handle is dragged with 60 pointer moves at 60 per second. The script measures the
time from a move to the paint of the first answer that includes it (median, 90th percentile). Then
it measures the time from one key press to the paint, for the explorer and, in the same run, for
`interact` with a Matplotlib figure with the same content. Aim: at least 4 times as fast. Then it
drags 1000 times and compares the memory of page and kernel before and after. Aims: no errors in the
console, and at most 2 MB (page) and 5 MB (kernel) more.
"""

import math
import shutil
import statistics
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import nbformat
import psutil
from bench_explorers import theirs
from conftest import BROWSERS, FLAGS, JupyterLab


class Case(NamedTuple):
    """`cell` shows the explorer, `handle` is dragged; `interact` draws the same in Matplotlib."""

    cell: str
    handle: str
    interact: str


CASES = {
    "plan": Case(
        """\
from robokin import deg, three_lever
from robokin.show import plan_explorer
arm = three_lever(1.0)
start = arm.family((1.2, 1.7), 118 * deg)
live = plan_explorer(arm, start, (1.9, 0.3), (1.2, 1.3))
live""",
        "H",
        """\
import numpy as np
import matplotlib.pyplot as plt
from ipywidgets import interact
def planned(x=1.2, y=1.3):
    print("x =", x)
    said = live.answer(live.data["question"] | {"obstacle": [x, y]})  # the same numbers
    fig = plt.figure(figsize=(9, 4))
    plane, cube = fig.add_subplot(1, 2, 1), fig.add_subplot(1, 2, 2, projection="3d")
    for points in arm.points(said["moments"].astype(float)):
        plane.plot(*points.T, color="C0", lw=0.5)
    plane.plot(*arm.points(start).T, color="k", lw=4, marker="o")
    plane.add_patch(plt.Circle((x, y), 1 / 7, color="0.8"))
    plane.set(aspect="equal", title=said["result"])
    cube.voxels(said["cube"] == 255, facecolors="0.7")
    cube.scatter(*np.argwhere(said["cube"] == said["most"]).T, s=4)
    cube.plot(*(said["moments"] / (12 * deg)).T, lw=2)
    plt.show()
interact(planned, x=(0.5, 2.0, 0.02), y=(0.5, 2.0, 0.02));""",
    ),
    "tour": Case(
        """\
import numpy as np
from robokin import spbu_arm
from robokin.jobs.visit_collect import Task, workspace
from robokin.show import tour_explorer
arm = spbu_arm(5, 4)
cloud = np.random.default_rng(3).uniform([-6, -6, 0.3], [6, 6, 5], size=(60, 3))
cloud = cloud[workspace(5, 4, cloud).all(axis=-1)][:11]
live = tour_explorer(Task(5, 4, 25, [0.2] * 3, cloud[0], cloud[1:], "visit"))
live""",
        "'0'",
        """\
import matplotlib.pyplot as plt
from ipywidgets import interact
def toured(x=2.0, y=3.0):
    print("x =", x)
    points = [[x, y, 2.0], *cloud[2:].tolist()]
    said = live.answer(live.data["question"] | {"points": points})  # the same numbers
    ax = plt.figure(figsize=(6, 4.5)).add_subplot(projection="3d")
    for name, style in (("greedy", "C1--"), ("best", "C0-")):
        t, q = said[name]["t"], said[name]["q"].astype(float)
        way = np.stack([np.interp(np.linspace(0, t[-1], 200), t, joint) for joint in q.T], axis=-1)
        ax.plot(*arm.fk(way).translation.T, style)
        print(said[name]["cells"])
        for rank, k in enumerate(said[name]["order"], 1):
            va = "top" if name == "best" else "bottom"
            ax.text(*points[k], f"{rank}.", color=style[:2], va=va)
    ax.plot(*arm.frames(q[0]).translation.T, "k-o", lw=5)
    ax.scatter(*np.array(points).T)
    for k, (px, py, pz) in enumerate(points):
        ax.plot([px, px], [py, py], [0, pz], "k:", lw=1)
        ax.text(px, py, pz, f"{k} ", ha="right")
    turn = np.linspace(0, 2 * np.pi, 73)
    ax.plot(9 * np.cos(turn), 9 * np.sin(turn), 0 * turn, "k:", lw=1)
    ax.set(title=said["says"])
    plt.show()
interact(toured, x=(-6.0, 6.0, 0.1), y=(-6.0, 6.0, 0.1));""",
    ),
}

# For each move, the time until the page shows the first answer to a later question. It ends with
# the task that follows the frame.
PAINTS = """root => {
  const moves = [];
  window.paints = [];
  for (const type of ["pointermove", "keydown"])
    document.addEventListener(type, e => moves.push({at: e.timeStamp}), true);
  new MutationObserver(changes => changes.forEach(({attributeName: name}) => {
    if (name === "data-asked")
      for (const move of moves) move.asked ??= +root.dataset.asked;
    if (name === "data-answered") requestAnimationFrame(() => {
      const n = +root.dataset.answered, channel = new MessageChannel();
      channel.port1.onmessage = () => {
        const now = performance.now();
        for (const move of moves) if (move.asked <= n) {
          window.paints.push(now - move.at);
          move.asked = Infinity;
        }
      };
      channel.port2.postMessage(0);
    });
  })).observe(root, {attributes: true});
}"""
# The same for a slider that is dragged to the right: the number x printed in an image shows which
# moves it includes.
THEIR_PAINTS = """cell => {
  const moves = [], slider = cell.querySelector("[role=slider]");
  const now = () => +slider.getAttribute("aria-valuenow");
  const shown = () => +(cell.innerText.match(/x = (-?[\\d.]+)/g) || ["NaN"]).at(-1).slice(4);
  window.paints = [];
  const noted = e => setTimeout(() => moves.push([e.timeStamp, now()]));
  document.addEventListener("pointermove", noted, true);
  new MutationObserver(changes => changes.forEach(({addedNodes}) => addedNodes.forEach(node => {
    for (const img of node.querySelectorAll ? [node, ...node.querySelectorAll("img")] : [])
      if (img.tagName === "IMG") img.decode().then(() => requestAnimationFrame(() => {
        const x = shown(), channel = new MessageChannel();
        channel.port1.onmessage = () => {
          for (const move of moves) if (move[1] <= x + 1e-9) {
            window.paints.push(performance.now() - move[0]);
            move[1] = Infinity;
          }
        };
        channel.port2.postMessage(0);
      }), () => {});
  }))).observe(cell, {childList: true, subtree: true});
}"""
DRAGS = """(node, count) => new Promise(done => {
  const r = node.getBoundingClientRect(), x = r.x + r.width / 2, y = r.y + r.height / 2;
  const tell = (type, clientX, clientY) =>
    node.dispatchEvent(new PointerEvent(type, {pointerId: 1, clientX, clientY}));
  node.setPointerCapture = () => {};
  let i = 0;
  const go = () => {
    tell("pointerdown", x, y);
    for (let k = 0; k < 5; k++)
      tell("pointermove", x + 8 * k * Math.sin(i), y + 8 * k * Math.cos(i / 3));
    tell("pointerup", x, y);
    node.dispatchEvent(new KeyboardEvent("keydown", {key: "Home", bubbles: true}));
    if (++i < count) requestAnimationFrame(go); else done();
  };
  go();
})"""


def ours(page, root, handle):
    """The times in ms from a move to its paint, in the second of two drags."""
    root.evaluate(PAINTS)
    box = root.locator(f"[data-handle={handle}]").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    for _ in range(2):
        page.evaluate("window.paints.length = 0")
        page.mouse.move(x, y)
        page.mouse.down()
        begun = time.perf_counter()
        for i in range(60):
            turn = (i + 1) / 60 * 2 * math.pi
            page.mouse.move(x + 30 * math.sin(turn), y + 20 * (1 - math.cos(turn)))
            page.wait_for_timeout(max(0, 1000 * (begun + (i + 1) / 60 - time.perf_counter())))
        page.wait_for_timeout(1500)
        page.mouse.up()
        page.wait_for_timeout(500)
    return sorted(page.evaluate("window.paints"))


def theirs_dragged(page, cell):
    """The times in ms from a move to its paint, for 60 moves of the slider of `interact`."""
    cell.scroll_into_view_if_needed()
    page.wait_for_timeout(500)
    cell.evaluate(THEIR_PAINTS)
    box = cell.locator("[role=slider]").first.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.wait_for_timeout(1500)
    page.evaluate("window.paints.length = 0")
    begun = time.perf_counter()
    for i in range(60):
        page.mouse.move(x + i + 1, y)
        page.wait_for_timeout(max(0, 1000 * (begun + (i + 1) / 60 - time.perf_counter())))
    page.wait_for_timeout(4000)
    page.mouse.up()
    return sorted(page.evaluate("window.paints"))


def pressed(page, root, handle):
    """The median time in ms from a key press to the paint of its answer."""
    page.evaluate("window.paints.length = 0")
    for i in range(13):
        root.locator(f"[data-handle={handle}]").press("ArrowRight" if i % 2 else "ArrowLeft")
        page.wait_for_timeout(600)
    return statistics.median(page.evaluate("window.paints")[3:])


def memory(page, lab):
    """The memory that the page and the kernel use, in megabytes."""
    session = page.context.new_cdp_session(page)
    for _ in range(3):
        session.send("HeapProfiler.collectGarbage")
    used = session.send("Runtime.getHeapUsage")["usedSize"]
    session.detach()
    children = psutil.Process(lab.process.pid).children(recursive=True)
    kernel = sum(p.memory_info().rss for p in children if "ipykernel" in " ".join(p.cmdline()))
    return used / 1e6, kernel / 1e6


def main():
    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        raise SystemExit("no Chromium on this machine")
    from playwright.sync_api import sync_playwright

    v4 = nbformat.v4
    kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    for name, case in CASES.items():
        cells = [v4.new_markdown_cell("# live", id="title")]
        cells += [v4.new_code_cell(x, id=f"c{i}") for i, x in enumerate((case.cell, case.interact))]
        with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
            labs = Path(folder) / "labs"
            labs.mkdir()
            notebook = v4.new_notebook(cells=cells, metadata={"kernelspec": kernel})
            nbformat.write(notebook, labs / "live.ipynb")
            with JupyterLab(Path(folder), labs) as lab:
                browser = playwright.chromium.launch(
                    executable_path=path, headless=True, args=FLAGS
                )
                page, errors = browser.new_page(viewport={"width": 1366, "height": 1000}), []
                page.on("console", lambda m, e=errors: m.type == "error" and e.append(m.text))
                page.on("pageerror", lambda error, e=errors: e.append(str(error)))
                lab.open(page, "live.ipynb")
                lab.run_all(page, "live.ipynb")
                root = page.locator(".robokin-player[data-awake]")
                root.wait_for(timeout=30_000)
                root.scroll_into_view_if_needed()
                paints = ours(page, root, case.handle)
                fast = statistics.median(paints)
                print(
                    f"{name}: move to the paint of its answer, median {fast:.0f} ms, nine of ten "
                    f"within {paints[int(0.9 * (len(paints) - 1))]:.0f} ms ({len(paints)} moves)",
                    flush=True,
                )
                key = pressed(page, root, case.handle)
                theirs_paints = theirs_dragged(page, page.locator(".jp-CodeCell").nth(1))
                slow = statistics.median(theirs_paints)
                print(
                    f"{name}: interact, dragged in the same way, median {slow:.0f} ms "
                    f"({len(theirs_paints)} moves): {slow / fast:.1f} times as long",
                    flush=True,
                )
                slow = theirs(page, page.locator(".jp-CodeCell").nth(1))
                print(
                    f"{name}: from a key press {key:.0f} ms, interact {slow:.0f} ms: "
                    f"{slow / key:.1f} times as long",
                    flush=True,
                )
                root.scroll_into_view_if_needed()
                node = root.locator(f"[data-handle={case.handle}]")
                used = []
                for drags in (200, 1000):  # the first 200 are a warm-up
                    node.evaluate(DRAGS, drags)
                    page.wait_for_timeout(3000)
                    used.append(memory(page, lab))
                (page0, kernel0), (page1, kernel1) = used
                print(
                    f"{name}: 1000 drags, page {page0:.1f} -> {page1:.1f} MB, kernel "
                    f"{kernel0:.1f} -> {kernel1:.1f} MB, {len(errors)} errors {errors[:3]}"
                )
                browser.close()


if __name__ == "__main__":
    main()
