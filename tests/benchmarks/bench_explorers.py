"""Compare explorers and the player's slider with `interact` and a redrawn figure in a real browser.

    python tests/benchmarks/bench_explorers.py

A handle is dragged with 60 pointer moves at 60 per second. The script measures the time from a move
to its paint (median, 90th percentile, number of painted moves), on a page of 1366 x 768 px and, by
touch, on a page 390 px wide. In the same run it measures the blend slider of a player, dragged in
the same way, and `interact` with a Matplotlib figure of the same content in JupyterLab, from a key
press to the new image. Aims: at most 1.2 times the time of the player's slider (for the motion 2.5
times); at least 6 times as fast as `interact`; 45 of 60 moves painted (motion 24), by touch 40
(motion 18).
"""

import asyncio
import math
import shutil
import statistics
import sys
import tempfile
import time
from pathlib import Path

import nbformat
import numpy as np

from robokin import (
    IRB140,
    SCARA,
    Quaternion,
    Transform,
    blend,
    deg,
    follow,
    loader_arm,
    quintic,
    three_lever,
    two_link,
)
from robokin.show import (
    animate,
    clearance_explorer,
    joint_explorer,
    motion_explorer,
    movement_explorer,
    paths_explorer,
    singularity_explorer,
    target_explorer,
)

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from conftest import BROWSERS, FLAGS, JupyterLab

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

def draw(ax, *postures):
    for i, q in enumerate(postures):
        style = {"lw": 5, "color": "k"} if i == 0 else {"lw": 2, "color": "0.7"}
        ax.plot(*IRB140.frames(q).translation.T, marker="o", **style)
    ax.set(xlim=(-0.8, 0.8), ylim=(-0.8, 0.8), zlim=(0, 1.6))
"""
    + POSES
)
CELLS = {
    "joint": """\
def joints(q1=0, q2=0):
    q = np.array([q1, q2, 0, 0, 0, 0]) * deg
    draw(plt.figure(figsize=(6, 4.5)).add_subplot(projection="3d"), q)
    plt.show()
    pose = IRB140.fk(q)
    print(pose.translation / mm, pose.rotation.wxyz, np.linalg.svd(IRB140.jacobian(q))[1][-1])
interact(joints, q1=(-180, 180), q2=(-90, 110));""",
    "target": """\
def target(x=400, y=100):
    pose = Transform(Quaternion.from_angle_axis(90 * deg, (0, 1, 0)), (x * mm, y * mm, 0.6))
    rows = IRB140.ik(pose)
    rows = rows[~np.isnan(rows[:, 0])]
    draw(plt.figure(figsize=(6, 4.5)).add_subplot(projection="3d"), *rows)
    plt.show()
    print(rows / deg, within(IRB140, rows))
interact(target, x=(-900, 900), y=(-900, 900));""",
    "motion": """\
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
}

# `painted` collects a time for every picture: for a canvas when it is cleared for a new drawing,
# and for an image when a new one has been decoded. The time is read in a later task, after the
# picture has appeared on the screen.
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
# The time from a move to the task after the frame that shows it. Several moves in one frame count
# as one, timed from the first.
PAINTS = """() => {
    window.paints = [];
    let since = Infinity, asked = false;
    const soon = () => {
        if (asked || since === Infinity) return;
        asked = true;
        const begun = since, c = new MessageChannel();
        since = Infinity;
        c.port1.onmessage = () => { asked = false; window.paints.push(performance.now() - begun); };
        c.port2.postMessage(0);
    };
    for (const type of ['pointermove', 'input'])
        document.addEventListener(type, e => { since = Math.min(since, e.timeStamp); }, true);
    const g = document.querySelector('canvas').getContext('2d'), wipe = g.clearRect;
    g.clearRect = function (...a) { soon(); return wipe.apply(this, a); };
}"""


async def paced(send):
    """Send 60 moves at a rate of 60 per second."""
    start, sent = time.perf_counter(), []
    for i in range(60):
        sent.append(asyncio.ensure_future(send(i)))
        await asyncio.sleep(max(0, start + (i + 1) / 60 - time.perf_counter()))
    await asyncio.gather(*sent)


async def dragged(page, target, touch=None, slider=False):
    """The times in ms from a move to its paint, for the last of three drags of an element."""
    await page.evaluate(PAINTS)
    for _ in range(3):
        box = await page.locator(target).bounding_box()
        x, y = box["x"] + (8 if slider else box["width"] / 2), box["y"] + box["height"] / 2
        await page.evaluate("window.paints.length = 0")

        def place(i, x=x, y=y, box=box):
            if slider:
                return x + (i + 1) / 60 * (box["width"] - 20), y
            turn = i / 60 * 2 * math.pi
            return x + 40 * math.sin(turn), y + 30 * (1 - math.cos(turn))

        if touch:
            await touch("touchStart", x, y)
            await paced(lambda i: touch("touchMove", *place(i)))
            await page.wait_for_timeout(200)
            await touch("touchEnd")
        else:
            await page.mouse.move(x, y)
            await page.mouse.down()
            await paced(lambda i: page.mouse.move(*place(i)))
            await page.wait_for_timeout(200)
            await page.mouse.up()
        await page.wait_for_timeout(100)
    return sorted(await page.evaluate("window.paints"))


def told(name, paints, slider):
    middle = statistics.median(paints)
    print(
        f"{name}: move to paint, median {middle:.1f} ms ({middle / slider:.2f} of the player's "
        f"slider), nine of ten within {paints[int(0.9 * (len(paints) - 1))]:.0f} ms, "
        f"{len(paints)} of 60 painted",
        flush=True,
    )
    return middle


async def ours(path, folder):
    """Print all results; return the median time to paint of each explorer."""
    from playwright.async_api import async_playwright

    start = Transform(Quaternion.from_angle_axis(90 * deg, (-1, 0, 0)), (0.2, 0.4, 0.2))
    via = Transform(Quaternion.from_angle_axis(45 * deg, (0, 1, 0)), (0.65, -0.1, 0.8))
    goal = Transform(Quaternion.from_angle_axis(90 * deg, (0, 1, 0)), (0.3, 0.3, 0.5))
    values, law = np.linspace(0, 0.5, 26), quintic(20.0)
    t = np.linspace(0, law.duration, 2001)
    q = np.stack([follow(IRB140, IRB140.ik(blend(start, via, goal, b, law(t))), 1) for b in values])
    pages = {
        "slider": (animate(IRB140, t, q, slider=("blend", values)), "input[aria-label=blend]"),
        "joint": (joint_explorer(IRB140), "[data-handle=q2]"),
        "target, 8 branches": (target_explorer(IRB140), "[data-handle=free]"),
        "SCARA": (target_explorer(SCARA), "[data-handle=free]"),
        "planar": (target_explorer(two_link(0.3, 0.2)), "[data-handle=free]"),
        "movement": (
            movement_explorer(three_lever(1), [1.5] * 3, (1.8, 0.6)),
            "[data-handle=free]",
        ),
        "singularity": (
            singularity_explorer(IRB140, np.zeros(6), (0, 1, 1)),
            "[data-handle=tool]",
        ),
        "clearance": (
            clearance_explorer(
                three_lever(1), [1.9, 2.2, 2], (1.9, 0.3), (1.2, 1.3), [(0.7, 1.8), (1.0, 1.2)]
            ),
            "[data-handle=K2]",
        ),
        "paths": (
            paths_explorer(
                loader_arm(0.45, 0.3), (0.6, -0.35, 0.05), (0.05, 0.25, 0.35), (10, 40, 40)
            ),
            "[data-handle=free]",
        ),
        "motion, 241 samples": (motion_explorer(IRB140, start, via, goal), "[data-handle=via]"),
    }
    found = {}
    async with async_playwright() as playwright:
        browser = await playwright.chromium.launch(executable_path=path, headless=True, args=FLAGS)
        slider = math.nan
        for name, (output, handle) in pages.items():
            output.save(folder / "page.html")
            page = await browser.new_page(viewport={"width": 1366, "height": 768})
            await page.goto((folder / "page.html").as_uri())
            await page.wait_for_timeout(600)
            paints = await dragged(page, handle, slider=name == "slider")
            slider = statistics.median(paints) if name == "slider" else slider
            found[name] = told(name, paints, slider)
            await page.close()
            if name == "slider":
                continue
            context = await browser.new_context(
                viewport={"width": 390, "height": 844},
                has_touch=True,
                is_mobile=True,
                device_scale_factor=3,
            )
            page = await context.new_page()
            await page.goto((folder / "page.html").as_uri())
            await page.wait_for_timeout(600)
            session = await context.new_cdp_session(page)

            async def touch(kind, x=None, y=None, session=session):
                points = [] if x is None else [{"x": x, "y": y}]
                await session.send(
                    "Input.dispatchTouchEvent", {"type": kind, "touchPoints": points}
                )

            told(f"{name}, 390 px by touch", await dragged(page, handle, touch), slider)
            await context.close()
        await browser.close()
    return found


def theirs(page, cell):
    """The median time in ms from a key press to the new image of `interact`."""
    cell.scroll_into_view_if_needed()
    page.wait_for_timeout(500)
    page.evaluate(WATCH, cell.element_handle())
    times = []
    for i in range(13):
        page.evaluate("() => { window.painted = []; }")
        page.keyboard.press("ArrowRight" if i % 2 else "ArrowLeft")
        page.wait_for_function("() => window.painted.length", timeout=10_000)
        times.append(page.evaluate("() => window.painted[0] - window.key"))
        page.wait_for_timeout(250)
    return statistics.median(times[3:])


def main():
    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        raise SystemExit("no Chromium on this machine")
    v4 = nbformat.v4
    cells = [v4.new_markdown_cell("# interact", id="title")]
    cells += [
        v4.new_code_cell(source, id=f"cell-{i}") for i, source in enumerate([HEAD, *CELLS.values()])
    ]
    kernel = {
        "kernelspec": {
            "display_name": "Python 3 (ipykernel)",
            "language": "python",
            "name": "python3",
        }
    }
    with tempfile.TemporaryDirectory() as folder:
        medians = asyncio.run(ours(path, Path(folder)))
        labs = Path(folder) / "labs"
        labs.mkdir()
        nbformat.write(v4.new_notebook(cells=cells, metadata=kernel), labs / "interact.ipynb")
        from playwright.sync_api import sync_playwright

        with sync_playwright() as playwright, JupyterLab(Path(folder), labs) as lab:
            browser = playwright.chromium.launch(executable_path=path, headless=True, args=FLAGS)
            page = browser.new_page(viewport={"width": 1366, "height": 1000})
            lab.open(page, "interact.ipynb")
            lab.run_all(page, "interact.ipynb")
            page.wait_for_timeout(2000)
            for i, name in enumerate(CELLS):
                slow = theirs(page, page.locator(".jp-CodeCell").nth(1 + i))
                fast = next(median for key, median in medians.items() if key.startswith(name))
                print(f"{name}: interact {slow:.0f} ms, {slow / fast:.1f} times as long")
            browser.close()


if __name__ == "__main__":
    main()
