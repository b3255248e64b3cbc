"""Measure how much of a screen the views of a page need."""

# JupyterLab at 1366 x 768 with its file browser open shows 647 px of a notebook, 914 px wide.
SCREEN = {"width": 1366, "height": 768}
MOST = {
    "rk-wide": 600,
    "rk-several": 600,
    "rk-figure": 640,
}  # px for several arms in one scene, and side by side; for joint curves
ONE = 560  # px for one arm and for every explorer
PLOT, ARM, FRAME = 180, 150, 300  # px of the large panel and of the arm in a frame of 300 x 300

# Records the frame of each panel that is drawn on each canvas.
RECORD = """
(() => {
  const frames = new WeakMap(), {strokeRect, clearRect} = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.clearRect = function (...box) {
    frames.set(this.canvas, []);
    return clearRect.apply(this, box);
  };
  CanvasRenderingContext2D.prototype.strokeRect = function (...box) {
    frames.get(this.canvas)?.push(box);
    return strokeRect.apply(this, box);
  };
  window.viewSizes = () => [...document.querySelectorAll(".robokin-player .rk")]
    .filter(view => view.checkVisibility())
    .map(view => {
      const box = view.getBoundingClientRect();
      const heights = [...view.querySelectorAll("canvas")].map(canvas => canvas.clientHeight);
      const plots = [...view.querySelectorAll("canvas")]
        .flatMap(canvas => (frames.get(canvas) ?? []).map(frame => frame[3]));
      return {
        kind: view.className, width: box.width, height: box.height,
        names: [view, ...view.querySelectorAll(".rk-views")].map(each => each.className).join(" "),
        canvas: Math.max(0, ...heights), plot: Math.max(0, ...plots),
        title: view.querySelector(".rk-title")?.textContent ?? "",
      };
    });
})();
"""


def sizes(page):
    """The size of every visible view of a page, with the greatest height allowed."""
    found = page.evaluate("viewSizes()")
    for view in found:
        view["most"] = max((MOST[name] for name in MOST if name in view["names"]), default=ONE)
    return found


def walked(page):
    """The sizes of all views of a notebook in JupyterLab. The function scrolls through the
    notebook, since JupyterLab draws only what is near the screen.
    """
    scroller = page.locator(".jp-WindowedPanel-outer").first
    found, end = {}, False
    for place in range(400):
        scroller.evaluate("(panel, top) => { panel.scrollTop = top; }", 400 * place)
        page.wait_for_timeout(250)  # a view starts when it is half a screen away
        for view in sizes(page):
            found[view["kind"], view["title"]] = view
        if end:
            return list(found.values())
        end = scroller.evaluate(
            "panel => panel.scrollTop + panel.clientHeight >= panel.scrollHeight - 2"
        )
    raise AssertionError("scrolling did not reach the end of the notebook")
