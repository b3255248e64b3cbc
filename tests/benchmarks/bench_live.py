"""Explorers in a real browser with a real kernel, against `interact` and a re-plot of the same
content.

    python tests/benchmarks/bench_live.py

Per explorer (IRB-140, all branches drawn): key press to paint, median of 20; 30 keys at one per 33
ms, and how long after the last one the picture still changes. In the same run the same for
`interact` with a Matplotlib figure of the same content: arm in space, branches and their numbers,
curves. For that, paint is when the new image is decoded.
"""

import shutil
import statistics
import sys
import tempfile
from pathlib import Path

import nbformat

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from conftest import FLAGS, JupyterLab

POSES = """\
start = Transform(Quaternion.from_angle_axis(90 * deg, (-1, 0, 0)), (0.2, 0.4, 0.2))
via = Transform(Quaternion.from_angle_axis(45 * deg, (0, 1, 0)), (0.65, -0.1, 0.8))
goal = Transform(Quaternion.from_angle_axis(90 * deg, (0, 1, 0)), (0.3, 0.3, 0.5))
"""
HEAD = (
    """\
import numpy as np
import matplotlib.pyplot as plt
from ipywidgets import interact
from robokin import *
from robokin.show import joint_explorer, motion_explorer, target_explorer

def draw(ax, *postures):
    for i, q in enumerate(postures):
        style = {"lw": 5, "color": "k"} if i == 0 else {"lw": 2, "color": "0.7"}
        ax.plot(*IRB140.frames(q).translation.T, marker="o", **style)
    ax.set(xlim=(-0.8, 0.8), ylim=(-0.8, 0.8), zlim=(0, 1.6))
"""
    + POSES
)
CELLS = {
    "joint": (
        "joint_explorer(IRB140)",
        """\
def joints(q1=0, q2=0):
    q = np.array([q1, q2, 0, 0, 0, 0]) * deg
    draw(plt.figure(figsize=(6, 4.5)).add_subplot(projection="3d"), q)
    plt.show()
    pose = IRB140.fk(q)
    print(pose.translation / mm, pose.rotation.wxyz, np.linalg.svd(IRB140.jacobian(q))[1][-1])
interact(joints, q1=(-180, 180), q2=(-90, 110));""",
    ),
    "target": (
        "target_explorer(IRB140)",
        """\
def target(x=400, y=100):
    pose = Transform(Quaternion.from_angle_axis(90 * deg, (0, 1, 0)), (x * mm, y * mm, 0.6))
    rows = IRB140.ik(pose)
    rows = rows[~np.isnan(rows[:, 0])]
    draw(plt.figure(figsize=(6, 4.5)).add_subplot(projection="3d"), *rows)
    plt.show()
    print(rows / deg, within(IRB140, rows))
interact(target, x=(-900, 900), y=(-900, 900));""",
    ),
    "motion": (
        "motion_explorer(IRB140, start, via, goal)",
        """\
def motion(x=650, fraction=0.1):
    t = np.linspace(0, 5, 401)
    moved = Transform(via.rotation, (x * mm, -0.1, 0.8))
    poses = blend(start, moved, goal, fraction, quintic(5.0)(t))
    q = follow(IRB140, IRB140.ik(poses), 0)
    fig = plt.figure(figsize=(9, 4.5))
    draw(fig.add_subplot(1, 2, 1, projection="3d"), q[-1], q[0])
    for k, values in enumerate((q, differentiate(q, t), differentiate(q, t, 2))):
        fig.add_subplot(3, 2, 2 * k + 2).plot(t, values / deg)
    plt.show()
    print(abs(differentiate(q, t)).max(axis=0) / deg)
interact(motion, x=(300, 900), fraction=(0, 0.5, 0.01));""",
    ),
}

# `painted` collects a time for every picture: a canvas is wiped before it is drawn, an image is new
# and decoded. The stamp is taken in a task after the frame, when it is on the screen.
WATCH = """cell => {
    window.painted = [];
    const soon = () => { const c = new MessageChannel();
        c.port1.onmessage = () => window.painted.push(performance.now()); c.port2.postMessage(0); };
    const canvas = cell.querySelector('canvas');
    if (canvas) {
        const g = canvas.getContext('2d'), wipe = g.clearRect;
        if (!g.watched) g.clearRect = function (...a) { soon(); return wipe.apply(this, a); };
        g.watched = true;
    } else new MutationObserver(changes => {
        for (const change of changes) for (const node of change.addedNodes)
            for (const img of node.querySelectorAll ? [node, ...node.querySelectorAll('img')] : [])
                if (img.tagName === 'IMG')
                    img.decode().then(() => requestAnimationFrame(soon), () => {});
    }).observe(cell, {childList: true, subtree: true});
    const handle = cell.querySelector('[role=slider]');
    handle.focus();
    if (!handle.watched)
        handle.addEventListener('keydown', () => { window.key = performance.now(); }, true);
    handle.watched = true;
}"""
# Keys come from the page itself, at even times: the driver's own delays would count as ours.
KEYS = """async (cell) => {
    const handle = cell.querySelector('[role=slider]');
    window.painted = [];
    const start = performance.now();
    for (let i = 0; i < 30; i++) {
        while (performance.now() < start + 33 * i) await new Promise(done => setTimeout(done, 1));
        const key = {key: 'ArrowRight', bubbles: true, cancelable: true};
        handle.dispatchEvent(new KeyboardEvent('keydown', key));
    }
    const last = performance.now();
    await new Promise(done => setTimeout(done, 12000 * !cell.querySelector('canvas') + 1500));
    return [window.painted.length, Math.max(...window.painted) - last];
}"""


def measure(page, cell):
    """Median and greatest time from key to paint in ms, pictures of 30 fast keys, ms until the last
    of them.
    """
    cell.scroll_into_view_if_needed()
    page.wait_for_timeout(500)
    element = cell.element_handle()
    page.evaluate(WATCH, element)
    times = []
    for i in range(23):
        page.evaluate("() => { window.painted = []; }")
        page.keyboard.press("ArrowRight" if i % 2 else "ArrowLeft")
        page.wait_for_function("() => window.painted.length", timeout=10_000)
        times.append(page.evaluate("() => window.painted[0] - window.key"))
        page.wait_for_timeout(250)
    pictures, settled = page.evaluate(KEYS, element)
    return statistics.median(times[3:]), max(times[3:]), pictures, settled


def main():
    path = next(
        filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
    )
    if path is None:
        raise SystemExit("no Chromium on this machine")
    from playwright.sync_api import sync_playwright

    v4, sources = nbformat.v4, [HEAD, *(source for pair in CELLS.values() for source in pair)]
    cells = [v4.new_markdown_cell("# Explorers", id="title")]
    cells += [v4.new_code_cell(source, id=f"cell-{i}") for i, source in enumerate(sources)]
    kernel = {
        "kernelspec": {
            "display_name": "Python 3 (ipykernel)",
            "language": "python",
            "name": "python3",
        }
    }
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        labs = Path(folder) / "labs"
        labs.mkdir()
        nbformat.write(v4.new_notebook(cells=cells, metadata=kernel), labs / "live.ipynb")
        with JupyterLab(Path(folder), labs) as lab:
            browser = playwright.chromium.launch(executable_path=path, headless=True, args=FLAGS)
            page = browser.new_page(viewport={"width": 1280, "height": 1000})
            lab.open(page, "live.ipynb")
            lab.run_all(page, "live.ipynb")
            page.wait_for_timeout(2000)
            code = page.locator(".jp-CodeCell")
            for i, name in enumerate(CELLS):
                ours, theirs = (measure(page, code.nth(1 + 2 * i + k)) for k in (0, 1))
                print(
                    f"{name}: key press to paint, median {ours[0]:.0f} ms (greatest "
                    f"{ours[1]:.0f}), interact and "
                    f"re-plot {theirs[0]:.0f} ms: ratio {theirs[0] / ours[0]:.1f}; 30 keys at "
                    f"one per 33 ms: "
                    f"{ours[2]} pictures, settled {ours[3]:.0f} ms after the last (interact: "
                    f"{theirs[2]}, "
                    f"{theirs[3]:.0f} ms)",
                    flush=True,
                )
            browser.close()


if __name__ == "__main__":
    main()
