"""A script that records the text on the canvases of a page, and a check that finds faults in it."""

import re
from dataclasses import dataclass

# The text drawn on each canvas since it was last cleared: its string, size in CSS px, colour, box
# on the page, the mean colour of the pixels below, and whether an outline was drawn first. Also the
# joints, which are the boxes of the shapes that were filled with the colour of a joint, and the
# links, which are the ends of the lines in their colour.
RECORD = """
(() => {
  const words = new WeakMap(), outlined = new WeakMap(), joints = new WeakMap();
  const links = new WeakMap();
  const kept = (map, {canvas}) => map.get(canvas) ?? map.set(canvas, []).get(canvas);
  const proto = CanvasRenderingContext2D.prototype;
  const {fillText, strokeText, clearRect, fill, stroke, beginPath, ellipse, lineTo, moveTo} = proto;
  let traced = [];
  const trace = (g, x, y, r) => {
    const {a, b, c, d, e, f} = g.getTransform(), size = Math.hypot(a, b);
    const ratio = g.canvas.width / (g.canvas.clientWidth || g.canvas.width);
    traced.push([a * x + c * y + e, b * x + d * y + f, r * size].map(value => value / ratio));
  };
  proto.beginPath = function () {
    traced = [];
    return beginPath.call(this);
  };
  proto.ellipse = function (x, y, a, b, ...more) {
    trace(this, x, y, Math.max(a, b));
    return ellipse.call(this, x, y, a, b, ...more);
  };
  proto.lineTo = function (x, y) {
    trace(this, x, y, 0);
    return lineTo.call(this, x, y);
  };
  proto.moveTo = function (x, y) {
    trace(this, x, y, 0);
    return moveTo.call(this, x, y);
  };
  proto.stroke = function (...all) {
    const link = getComputedStyle(this.canvas).getPropertyValue("--rk-link").trim();
    if (this.strokeStyle === link.toLowerCase() && this.globalAlpha === 1)
      kept(links, this).push(traced.slice(-2).flatMap(p => p.slice(0, 2)));
    return stroke.apply(this, all);
  };
  proto.fill = function (...all) {
    const style = getComputedStyle(this.canvas), color = String(this.fillStyle).toLowerCase();
    const paint = [1, 2, 3, 4, 5, 6].map(k => style.getPropertyValue(`--rk-joint${k}`).trim());
    if (traced.length && paint.some(each => each.toLowerCase() === color)) {
      const [left, top] = [0, 1].map(k => Math.min(...traced.map(p => p[k] - p[2])));
      const [right, bottom] = [0, 1].map(k => Math.max(...traced.map(p => p[k] + p[2])));
      kept(joints, this).push([left, top, right - left, bottom - top]);
    }
    return fill.apply(this, all);
  };
  proto.clearRect = function (...box) {
    words.set(this.canvas, []);
    joints.set(this.canvas, []);
    links.set(this.canvas, []);
    return clearRect.apply(this, box);
  };
  proto.strokeText = function (text, x, y) {
    outlined.set(this.canvas, [text, x, y, this.strokeStyle].join());
    return strokeText.call(this, text, x, y);
  };
  proto.fillText = function (text, x, y) {
    const {a, d, e, f} = this.getTransform(), size = parseFloat(this.font.match(/([\\d.]+)px/)[1]);
    const ratio = this.canvas.width / (this.canvas.clientWidth || this.canvas.width);
    const m = this.measureText(text), shift = {center: 0.5, right: 1, end: 1}[this.textAlign] ?? 0;
    const width = m.width * a / ratio, left = (x * a + e) / ratio - shift * width;
    const up = m.actualBoundingBoxAscent, down = m.actualBoundingBoxDescent;
    const top = (y * d + f) / ratio - up * d / ratio, height = (up + down) * d / ratio;
    const outline = (outlined.get(this.canvas) || "").startsWith([text, x, y].join());
    let ground = null;
    if (!outline && width > 0 && height > 0) {
      const {data} = this.getImageData(left * ratio, top * ratio, Math.max(1, width * ratio),
                                       Math.max(1, height * ratio));
      ground = [0, 1, 2, 3].map(k => {
        let sum = 0;
        for (let i = k; i < data.length; i += 4) sum += data[i];
        return sum * 4 / data.length;
      });
    }
    kept(words, this).push({
      text, size: size * d / ratio, color: this.fillStyle, box: [left, top, width, height], ground,
    });
    return fillText.call(this, text, x, y);
  };
  window.canvasWords = () => [...document.querySelectorAll("canvas")]
    .filter(canvas => canvas.checkVisibility() && canvas.clientWidth)
    .map(canvas => ({
      view: canvas.closest("[data-player]")?.dataset.player ?? "",
      kind: canvas.closest(".rk")?.className ?? "",
      paper: getComputedStyle(canvas).getPropertyValue("--rk-paper").trim(),
      width: canvas.clientWidth, height: canvas.clientHeight,
      words: words.get(canvas) ?? [], joints: joints.get(canvas) ?? [],
      links: links.get(canvas) ?? [],
      handles: [...(canvas.closest(".rk-space")?.querySelectorAll("[data-handle]") ?? [])]
        .filter(node => node.checkVisibility())
        .map(node => {
          const [one, all] = [node, canvas].map(each => each.getBoundingClientRect());
          return [one.left - all.left, one.top - all.top, one.width, one.height];
        }),
    }));
})();
"""
# `canvas.lines`: the points (px), colour, width and dash of all lines in the last picture, and the
# pieces of each line, which begin with a move
LINES = """{
  const pen = CanvasRenderingContext2D.prototype;
  const {clearRect, beginPath, moveTo, lineTo, stroke} = pen;
  Object.assign(pen, {
    clearRect(...all) { this.canvas.lines = []; return clearRect.apply(this, all); },
    beginPath() { this.pieces = []; return beginPath.call(this); },
    moveTo(x, y) { this.pieces.push([[x, y]]); return moveTo.call(this, x, y); },
    lineTo(x, y) {
      if (!this.pieces.length) this.pieces.push([]);
      this.pieces.at(-1).push([x, y]);
      return lineTo.call(this, x, y);
    },
    stroke() {
      const width = +this.lineWidth.toFixed(2); // a canvas keeps 32 bits of it
      const [pieces, color, dash] = [this.pieces, this.strokeStyle, this.getLineDash()];
      this.canvas.lines?.push({points: pieces.flat(), pieces, color, width, dash});
      return stroke.call(this);
    },
  });
}"""
# Moves the sliders of all visible views to place i of n. Each slider goes its own way, so that the
# places are not all on one line.
MOVE = """([i, n]) => {
  for (const view of document.querySelectorAll(".robokin-player"))
    [...view.querySelectorAll("input[type=range]:not([inert] *)")]
      .filter(slider => slider.checkVisibility() && !slider.disabled)
      .forEach((slider, k) => {
        const share = ((i / (n - 1)) * (k + 1) + 0.3 * k) % 1.0001;
        slider.value = +slider.min + share * (slider.max - slider.min);
        slider.dispatchEvent(new Event("input", {bubbles: true}));
      });
}"""
# Waits until the next picture is drawn
NEXT = "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
SIZE, CONTRAST = 10, 4.5
OVERLAP = 1.5  # the overlap allowed for two boxes, in px
ROUND = 0.15  # the part of the box of a round joint or handle that its corners leave free


@dataclass
class Fault:
    """Unreadable text on a canvas, and the reason."""

    text: str
    why: str
    kind: str


def faults(page):
    """The faults of all text on the visible canvases of a page."""
    found = []
    for canvas in page.evaluate("canvasWords()"):
        paper = rgb(canvas["paper"])
        seen = [word for word in canvas["words"] if word["text"].strip()]
        for k, word in enumerate(seen):
            text, kind = word["text"], canvas["kind"]
            if word["size"] < SIZE - 0.01:
                found.append(Fault(text, f"{word['size']:.1f} px", kind))
            ground = below(word["ground"], paper)
            ratio = contrast(rgb(word["color"]), ground)
            if ratio < CONTRAST:
                found.append(Fault(text, f"contrast {ratio:.1f}", kind))
            left, top, width, height = word["box"]
            if (
                left < -1
                or top < -1
                or left + width > canvas["width"] + 1
                or top + height > canvas["height"] + 1
            ):
                found.append(Fault(text, "cut at the edge", kind))
            for other in seen[:k]:
                if other["text"] != text and reach(word["box"], other["box"]) > OVERLAP:
                    found.append(Fault(text, f"over {other['text']!r}", kind))
            still = text.startswith("grid ") or word["size"] < 11
            for name in () if still or "rk-motor" in kind else ("joints", "handles"):
                for x, y, w, h in canvas[name]:
                    core = (x + ROUND * w, y + ROUND * h, (1 - 2 * ROUND) * w, (1 - 2 * ROUND) * h)
                    if reach(word["box"], core) > OVERLAP:
                        found.append(Fault(text, f"on one of the {name}", kind))
            # the scale and the compass keep their corners, where an arm or a handle may come; the
            # names on the parts of a motor belong there
            if not still and any(crosses(word["box"], link) for link in canvas["links"]):
                found.append(Fault(text, "on a link", kind))
    return found


def reach(one, other):
    """The overlap of two boxes in px; negative if they do not overlap."""
    (x, y, w, h), (u, v, a, b) = one, other
    return min(min(x + w, u + a) - max(x, u), min(y + h, v + b) - max(y, v))


def crosses(box, line):
    """Whether the middle of a link passes through a box."""
    x, y, w, h = box
    a, b, c, d = line
    return any(
        x < a + k / 50 * (c - a) < x + w and y < b + k / 50 * (d - b) < y + h for k in range(51)
    )


def below(ground, paper):
    if ground is None:  # an outline in the colour of the paper
        return paper
    share = ground[3] / 255
    return [share * g + (1 - share) * p for g, p in zip(ground, paper, strict=False)]


def rgb(color):
    """The components of a colour as CSS or a canvas writes it."""
    if color.startswith("#"):
        return [int(color[i : i + 2], 16) for i in (1, 3, 5)]
    values = [float(x) for x in re.findall(r"[\d.]+", color.replace("color(srgb", ""))]
    return [255 * x for x in values[:3]] if color.startswith("color(") else values[:3]


def contrast(one, other):
    """The contrast of two colours (WCAG 2)."""

    def light(color):
        parts = [c / 255 for c in color]
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    high, low = sorted((light(one), light(other)), reverse=True)
    return (high + 0.05) / (low + 0.05)


# From now on `window.covered` has, for each text that matches a pattern, how many pixels in these
# colours its box covers when it is written.
COVERED = """([pattern, names]) => {
  window.covered = [];
  const {strokeText} = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.strokeText = function (text, x, y) {
    if (RegExp(pattern).test(text)) {
      const {a, e, f} = this.getTransform(), style = getComputedStyle(this.canvas);
      const m = this.measureText(text), shift = {center: 0.5, right: 1}[this.textAlign] ?? 0;
      const up = m.actualBoundingBoxAscent, down = m.actualBoundingBoxDescent;
      const wide = a * m.width, high = a * (up + down);
      // a copy, since Chromium warns about a canvas that is read often
      const copy = new OffscreenCanvas(wide, high).getContext("2d", {willReadFrequently: true});
      copy.drawImage(this.canvas, -a * (x - shift * m.width) - e, -a * (y - up) - f);
      const {data} = copy.getImageData(0, 0, wide, high);
      const wanted = names.map(name => style.getPropertyValue(`--rk-${name}`).trim().slice(1))
        .map(hex => [0, 2, 4].map(k => parseInt(hex.slice(k, k + 2), 16)));
      let count = 0;
      for (let i = 0; i < data.length; i += 4)
        count += data[i + 3] > 200 &&
          wanted.some(rgb => rgb.every((c, k) => Math.abs(c - data[i + k]) < 30));
      window.covered.push([text, count / a]);
    }
    return strokeText.call(this, text, x, y);
  };
}"""
