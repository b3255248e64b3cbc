"""Compare the player with Matplotlib's `to_jshtml`, and time its blend slider in a real browser.

    python tests/benchmarks/bench_player.py            100 frames, slider
    python tests/benchmarks/bench_player.py --long     also 1000 frames (Matplotlib takes minutes)

The scene is the chain of source 001, tasks 3 and 4 (errata S1, "chain"), with the arm and three
panels of curves. The build time includes the still picture. The slider has 51 blends x 2 corners of
2001 samples. The script measures the time from a key press to its paint, and counts the pictures
painted for 30 key presses, one every 33 ms.
"""

import shutil
import statistics
import sys
import tempfile
import time
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.animation import FuncAnimation
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from robokin import IRB140, Quaternion, Transform, blend, deg, differentiate, follow, linear
from robokin.show import JOINT_STYLES, animate

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from conftest import BROWSERS, FLAGS

X, Y, Z = np.eye(3)
START = Transform(Quaternion.from_angle_axis(90 * deg, -X), (0.2, 0.4, 0.2))
VIA = Transform(Quaternion.from_angle_axis(45 * deg, Y), (0.65, -0.1, 0.8))
GOAL = Transform(Quaternion.from_angle_axis(90 * deg, Y), (0.3, 0.3, 0.5))
# The time of the picture that follows a key press is taken in a task after the next frame, when the
# picture is on the screen.
LISTEN = """() => {
    window.pressed = []; window.painted = [];
    const range = document.querySelector('[aria-label=blend]');
    range.addEventListener('keydown', () => { window.key = performance.now(); }, true);
    range.addEventListener('input', () => {
        const key = window.key;
        requestAnimationFrame(() => { const c = new MessageChannel();
            c.port1.onmessage = () => window.pressed.push(performance.now() - key);
            c.port2.postMessage(0); });
    });
    const canvas = document.querySelector('.rk-curves').getContext('2d'), wipe = canvas.clearRect;
    canvas.clearRect = function (...a) {
        window.painted.push(performance.now()); return wipe.apply(this, a); };
    range.focus();
}"""
# The page itself sends the keys, at even intervals; otherwise, delays in the browser driver would
# be counted as ours.
KEYS = """async () => {
    const range = document.querySelector('[aria-label=blend]');
    range.value = 0; window.painted = [];
    const start = performance.now();
    for (let i = 0; i < 30; i++) {
        while (performance.now() < start + 33 * i) await new Promise(done => setTimeout(done, 1));
        range.stepUp();
        range.dispatchEvent(new Event('input', {bubbles: true}));
    }
    await new Promise(done => setTimeout(done, 100));
    return window.painted.length;
}"""


def motion(fraction, t, corner="parabola"):
    poses = blend(START, VIA, GOAL, fraction, linear(t[-1])(t), corner=corner)
    return follow(IRB140, IRB140.ik(poses), IRB140.branch(+1, +1, -1))


def jshtml(t, q):
    """The build time (s) and the size (bytes) of the same scene in Matplotlib."""
    begin = time.perf_counter()
    figure = Figure(figsize=(9, 4.5))
    FigureCanvasAgg(figure)
    scene = figure.add_subplot(1, 2, 1, projection="3d")
    points, path = IRB140.frames(q).translation, IRB140.fk(q).translation
    scene.plot(*path.T, lw=1)
    scene.set(xlim=(-0.2, 0.8), ylim=(-0.5, 0.5), zlim=(0, 1))
    [arm] = scene.plot(*points[0].T, lw=5, marker="o")
    cursors = []
    for k, values in enumerate((q, differentiate(q, t), differentiate(q, t, 2))):
        ax = figure.add_subplot(3, 2, 2 * k + 2)
        for j, style in enumerate(JOINT_STYLES):
            ax.plot(t, values[:, j] / deg, color=style["color"])
        cursors.append(ax.axvline(0, color="k"))

    def draw(i):
        arm.set_data_3d(*points[i].T)
        for cursor in cursors:
            cursor.set_xdata([t[i], t[i]])

    with matplotlib.rc_context({"animation.embed_limit": 500}):
        text = FuncAnimation(figure, draw, frames=len(t)).to_jshtml()
    return time.perf_counter() - begin, len(text.encode())


def player(t, q):
    """The median build time (s) of five players, and the size (bytes) of a player."""
    times = []
    for _ in range(5):
        begin = time.perf_counter()
        text = animate(IRB140, t, q, targets=[START, VIA, GOAL]).html
        times.append(time.perf_counter() - begin)
    return statistics.median(times), len(text.encode())


def compare(frames):
    t = np.linspace(0, 20, frames)
    q = motion(0.1, t)
    player(t, q)  # warm up: load fonts and modules
    (ours, our_bytes), (theirs, their_bytes) = player(t, q), jshtml(t, q)
    print(
        f"{frames} frames: player {1e3 * ours:.0f} ms, {our_bytes / 1e3:.0f} kB; to_jshtml "
        f"{theirs:.1f} s, "
        f"{their_bytes / 1e6:.1f} MB; ratios {theirs / ours:.0f} and {their_bytes / our_bytes:.0f}"
    )


def slider():
    t, fractions = np.linspace(0, 20, 2001), np.linspace(0, 0.5, 51)
    q = np.stack([motion(fractions[:, None], t, corner) for corner in ("parabola", "quintic")])
    begin = time.perf_counter()
    made = animate(
        IRB140,
        t,
        q,
        targets=[START, VIA, GOAL],
        slider=("blend", fractions),
        switch=("corner", ["parabola (C1)", "quintic (C2)"]),
    )
    size = len(made.html.encode())
    seconds = time.perf_counter() - begin
    print(
        f"blend slider, 51 x 2 motions of 2001 samples: built in {seconds:.2f} s, "
        f"{size / 1e3:.0f} kB"
    )
    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        print("no Chromium: the slider is not measured")
        return
    from playwright.sync_api import sync_playwright

    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        made.save(Path(folder) / "player.html")
        browser = playwright.chromium.launch(executable_path=path, headless=True, args=FLAGS)
        page = browser.new_page(viewport={"width": 900, "height": 900})
        page.goto((Path(folder) / "player.html").as_uri())
        page.get_by_label("blend", exact=True).wait_for()
        page.evaluate(LISTEN)
        for _ in range(20):
            page.keyboard.press("ArrowRight")
            page.wait_for_timeout(120)
        pressed = page.evaluate("pressed")
        painted = page.evaluate(KEYS)
        browser.close()
    print(
        f"key press to paint: median {statistics.median(pressed):.1f} ms of {len(pressed)} "
        f"(longest {max(pressed):.1f}); 30 key presses, one every 33 ms: {painted} pictures"
    )


if __name__ == "__main__":
    compare(100)
    slider()
    if "--long" in sys.argv:
        compare(1000)
