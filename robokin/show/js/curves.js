// The curves: columns of panels over one time axis.

import {
  clear,
  colors,
  font,
  hit,
  jointColor,
  number,
  polygon,
  prepared,
  spot,
  stroke,
  tiled,
  upright,
  words,
} from "./canvas.js";

/** @import {Box, Context, Pixel} from "./canvas.js" */
/** @import {Scale} from "./page.js" */

/**
 * @typedef {object} Panel
 * @property {string} label
 * @property {{unit: string, scale: Scale, joints: number[]}[]} axes
 * @property {Float64Array[]} curves  of each joint, over the times
 * @property {Set<number>} gaps  samples after which the lines break
 * @property {?number[][]} limits  [low, high], of each joint
 * @property {number[][]} near  [joint, 0 low or 1 high]: the limits to show
 * @property {Mark[]} marks
 * @property {number[]} now  of each joint
 * @property {string} [where]  in what size and theme it was when places for its words were found
 * @property {Note[]} [words]
 */
/** @typedef {{title: string, panels: Panel[]}} Column  of panels over one time axis */
/** @typedef {{time: number, text: string}} Mark  a broken line; a text is written beside it */
/** @typedef {[text: string, place: Box, color: string, size: number, weight?: string]} Note */
/** @typedef {ArrayLike<number>} Times  in s, rising */
/** @typedef {(value: number) => number} Place  of a time or a value, on the canvas */
/** @typedef {ReturnType<typeof curvesView>} CurvesView */
/** @typedef {[left: number, right: number, top: number, bottom: number]} Sides */

/**
 * Draws columns of panels.
 *
 * draw(columns, times, ticks, now)  one picture
 * timeAt(x, y, held)                the time of a place on the canvas, in the column under it or,
 *                                   with `held`, in that column whatever the place; and the number
 *                                   of the column
 *
 * @param {HTMLCanvasElement} canvas
 * @param {number[][]} patterns  the dashes of the joints' lines
 */
export function curvesView(canvas, patterns) {
  /** @type {[left: number, width: number, t0: number, t1: number, x: number, y: number][]} */
  let spans = [];

  /**
   * @param {Column[]} columns
   * @param {Times} times
   * @param {Scale} ticks
   * @param {number} now
   */
  function draw(columns, times, ticks, now) {
    const ready = prepared(canvas);
    if (!ready) return;
    const [g, w, h] = ready;
    const t0 = times[0],
      t1 = times[times.length - 1];
    spans = [];
    const [across, rows] = tiled(columns.length, w);
    columns.forEach((column, c) => {
      const width = w / across,
        height = h / rows,
        titled = columns.length > 1;
      const left = (c % across) * width,
        above = Math.floor(c / across) * height;
      const right = column.panels.some(p => p.axes.length > 1) ? 46 : 16;
      const room = Math.max(48, 14 + widest(g, column));
      /** @type {[number, number]} */
      const area = [left + room, width - room - right];
      const below = legend(
        g,
        patterns,
        column,
        left + room,
        width - room - right,
        above + (titled ? 36 : 14),
      );
      if (titled) words(g, column.title, left + room, above + 14, colors.ink, 13, "left", "600");
      const bottom = above + height - 24,
        count = column.panels.length,
        tall = (bottom - below) / count;
      /** @type {Place} */
      const x = t => area[0] + (area[1] * (t - t0)) / (t1 - t0);
      spans.push([area[0], area[1], t0, t1, left, above]);
      column.panels.forEach((panel, k) => {
        const top = below + k * tall + 26;
        drawPanel(
          g,
          patterns,
          panel,
          x,
          area,
          top,
          below + (k + 1) * tall - top - 4,
          times,
          ticks,
          now,
        );
      });
      const [first, step, n, decimals] = ticks;
      for (let i = 0; i < n; i++) {
        const t = first + i * step;
        if (t < t0 - 1e-9 || t > t1 + 1e-9) continue;
        const unit = t + step > t1 + 1e-9 ? " s" : "";
        words(
          g,
          number(t, decimals) + unit,
          x(t) + (unit ? 4 : 0),
          bottom + 16,
          colors.soft,
          11,
          "center",
        );
      }
    });
  }

  /**
   * @param {number} px
   * @param {number} py
   * @param {number} [held]
   * @returns {[time: number, column: number]}
   */
  function timeAt(
    px,
    py,
    held = spans.findLastIndex(([, , , , left, above]) => px >= left && py >= above),
  ) {
    const [left, width, t0, t1] = spans[Math.max(0, held)];
    return [t0 + (t1 - t0) * Math.min(1, Math.max(0, (px - left) / width)), Math.max(0, held)];
  }

  return {draw, timeAt};
}

/** Joint colours fit for words. @type {(color: string) => string} */
const shade = color => `color-mix(in srgb, ${color} 60%, ${colors.ink})`;
/** @type {(patterns: number[][], j: number, width: number) => number[]} */
const dashes = (patterns, j, width) => patterns[j % patterns.length].map(x => x * width);

/**
 * How wide the numbers beside the panels are.
 * @param {Context} g
 * @param {Column} column
 */
function widest(g, {panels}) {
  g.font = font(11);
  return Math.max(
    ...panels.flatMap(
      ({
        axes: [
          {
            scale: [low, step, count, decimals],
          },
        ],
      }) =>
        [low, low + (count - 1) * step].map(value => g.measureText(number(value, decimals)).width),
    ),
  );
}

/**
 * Names with their lines, above the panels, evenly in as many rows as it takes.
 * @param {Context} g
 * @param {number[][]} patterns
 * @param {Column} column
 * @param {number} left
 * @param {number} width
 * @param {number} y
 * @returns {number}  where the panels may begin
 */
function legend(g, patterns, column, left, width, y) {
  const joints = column.panels[0].curves.length,
    rows = Math.ceil((joints * 38) / width),
    inRow = Math.ceil(joints / rows);
  const each = Math.min(56, width / inRow),
    long = each - 30;
  for (let j = 0; j < joints; j++) {
    const x = left + (j % inRow) * each,
      row = y + 16 * Math.floor(j / inRow);
    stroke(
      g,
      [
        [x, row - 4],
        [x + long, row - 4],
      ],
      jointColor(j),
      2.2,
      dashes(patterns, j, 2.2),
    );
    words(g, `q${j + 1}`, x + long + 4, row, colors.ink, 12);
  }
  return y + 16 * (rows - 1) + 2;
}

/**
 * @param {Context} g
 * @param {number[][]} patterns
 * @param {Panel} panel
 * @param {Place} x
 * @param {[left: number, width: number]} area
 * @param {number} top
 * @param {number} height
 * @param {Times} times
 * @param {Scale} ticks
 * @param {number} now
 */
function drawPanel(g, patterns, panel, x, [left, width], top, height, times, ticks, now) {
  const right = left + width,
    bottom = top + height,
    limits = panel.limits ?? [];
  /** @type {Place[]} */
  const ys = [];
  /** @type {string[]} */
  const units = [];
  const scales = panel.axes.map(({scale: [low, step, count], unit, joints}) => {
    /** @type {Place} */
    const y = v => bottom - (height * (v - low)) / (step * (count - 1));
    for (const j of joints) {
      ys[j] = y;
      units[j] = unit;
    }
    return y;
  });
  words(g, panel.label, left - 40, top - 8, colors.ink, 12, "left", "600");
  g.save();
  g.beginPath();
  g.rect(left, top - 1, width, height + 2);
  g.clip();
  const [low, step, count] = panel.axes[0].scale;
  for (let i = 0; i < count; i++) {
    const y = scales[0](low + i * step);
    stroke(
      g,
      [
        [left, y],
        [right, y],
      ],
      Math.abs(low + i * step) < step / 9 ? colors.line : colors.grid,
      1,
    );
  }
  for (let i = 0; i < ticks[2]; i++)
    upright(g, x(ticks[0] + i * ticks[1]), top, bottom, colors.grid, 1);
  for (const [j, side] of panel.near)
    band(g, ys[j](limits[side][j]), side ? 1 : -1, left, right, jointColor(j));
  for (const {time} of panel.marks) upright(g, x(time), top, bottom, colors.alarm, 1.2, [3, 3]);
  ys.forEach((y, j) => curve(g, patterns, panel, j, times, x, y));
  g.restore();
  g.lineWidth = 1;
  g.strokeStyle = colors.rim;
  g.strokeRect(left, top, width, height);
  panel.axes.forEach(({scale: [low, step, count, decimals], unit, joints}, k) => {
    const color = k && joints.length === 1 ? shade(jointColor(joints[0])) : colors.soft;
    for (let i = 0; i < count; i++) {
      const y = scales[k](low + i * step) + 4;
      words(
        g,
        number(low + i * step, decimals),
        k ? right + 6 : left - 6,
        y,
        color,
        11,
        k ? "left" : "right",
      );
    }
    if (k)
      words(
        g,
        `${joints.map(j => `q${j + 1}`).join(" and ")}, ${unit}`,
        right + 42,
        top - 8,
        color,
        12,
        "right",
        "600",
      );
  });
  // The places of words are looked for once in a size and a theme, not in every picture.
  const where = [left, top, width, height, colors.ink].join();
  if (panel.where !== where) {
    /** @type {Sides} */
    const rect = [left, right, top, bottom];
    const notes = noted(g, panel.marks, x, rect);
    panel.where = where;
    panel.words = [...notes, ...limitWords(g, panel, ys, units, times, x, rect, notes)];
  }
  for (const [text, [px, py, , h], color, size, weight] of panel.words ?? [])
    words(g, text, px, py + h - 2, color, size, "left", weight);
  upright(g, x(now), top, bottom, colors.ink, 1.4);
  ys.forEach((y, j) => {
    const at = y(panel.now[j]);
    if (at > top - 3 && at < bottom + 3) spot(g, [x(now), at], 4, jointColor(j));
  });
  for (const {time, text} of panel.marks)
    if (text)
      for (const [y, tip] of [
        [top, top + 7],
        [bottom, bottom - 7],
      ])
        polygon(
          g,
          [
            [x(time) - 5, y],
            [x(time) + 5, y],
            [x(time), tip],
          ],
          colors.alarm,
        );
}

/**
 * The words of the marks, in at most three lines.
 * @param {Context} g
 * @param {Mark[]} marks
 * @param {Place} x
 * @param {Sides} sides
 */
function noted(g, marks, x, [left, right, top]) {
  /** @type {Note[]} */
  const notes = [];
  g.font = font(11, 600);
  for (const {time, text} of marks) {
    if (!text) continue;
    const w = g.measureText(text).width;
    const px = x(time) + w + 12 > right ? Math.max(left + 3, x(time) - 6 - w) : x(time) + 6;
    const place = [0, 1, 2]
      .map(k => /** @type {Box} */ ([px, top + 14 * k + 4, w, 12]))
      .find(
        place =>
          !hit(
            place,
            notes.map(note => note[1]),
          ),
      );
    if (place) notes.push([text, place, colors.alarm, 11, "600"]);
  }
  return notes;
}

/**
 * The words of the limits, as above: beside their lines, off other words and, nearly, off the
 * curves. At most three; where there is no such place, the band alone has to do.
 * @param {Context} g
 * @param {Panel} panel
 * @param {Place[]} ys  of each joint
 * @param {string[]} units  of each joint
 * @param {Times} times
 * @param {Place} x
 * @param {Sides} sides
 * @param {Note[]} notes
 */
function limitWords(g, panel, ys, units, times, x, [left, right, top, bottom], notes) {
  /** @type {Note[]} */
  const found = [];
  const limits = panel.limits ?? [],
    each = (right - left) / times.length,
    lines = panel.near.map(([j, side]) => ys[j](limits[side][j]));
  g.font = font(10);
  panel.near.forEach(([j, side], k) => {
    const limit = limits[side][j],
      at = lines[k],
      unit = units[j];
    const value = number(limit, +!Number.isInteger(limit)),
      gap = unit[0] === "\u00B0" ? "" : " ";
    const text = `q${j + 1} limit ${value}${gap}${unit}`;
    const w = g.measureText(text).width,
      taken = [...notes, ...found].map(([, place]) => place);
    /** @type {?Box} */
    let best = null;
    let least = 16; // pixels of curves that the words may cover
    for (const y of side ? [at - 13, at + 2] : [at + 2, at - 13]) {
      if (y < top + 1 || y + 11 > bottom - 1) continue;
      const crossed = 20 * lines.filter(line => line > y && line < y + 11).length;
      /** @type {number[]} */
      const beside = [];
      panel.curves.forEach((curve, i) => {
        const on = ys[i];
        curve.forEach((v, k) => {
          if (on(v) > y - 1 && on(v) < y + 12) beside.push(x(times[k]));
        });
      });
      for (let px = left + 5; px + w + 5 < right; px += 6) {
        if (hit([px - 4, y, w + 8, 11], taken)) continue;
        const cost = each * beside.filter(cx => cx > px - 3 && cx < px + w + 3).length + crossed;
        if (cost < least) [best, least] = [[px, y, w, 11], cost];
      }
    }
    if (best && found.length < 3) found.push([text, best, shade(jointColor(j)), 10]);
  });
  return found;
}

/**
 * The near side of what lies beyond a limit, a strip above (side 1) or below it.
 * @param {Context} g
 * @param {number} at
 * @param {number} side  1 or -1
 * @param {number} left
 * @param {number} right
 * @param {string} color
 */
function band(g, at, side, left, right, color) {
  const fade = g.createLinearGradient(0, at, 0, at - 12 * side);
  fade.addColorStop(0, clear(color, 0.35));
  fade.addColorStop(1, clear(color, 0.05));
  g.fillStyle = fade;
  g.fillRect(left, at, right - left, -12 * side);
  stroke(
    g,
    [
      [left, at],
      [right, at],
    ],
    color,
    1,
  );
}

/**
 * @param {Context} g
 * @param {number[][]} patterns
 * @param {Panel} panel
 * @param {number} j
 * @param {Times} times
 * @param {Place} x
 * @param {Place} y
 */
function curve(g, patterns, panel, j, times, x, y) {
  const color = jointColor(j);
  /** @type {(?Pixel)[]} */
  const points = [];
  /** @type {(?Pixel)[]} */
  const beyond = [];
  panel.curves[j].forEach((value, i) => {
    /** @type {?Pixel} */
    const p = Number.isNaN(value) ? null : [x(times[i]), y(value)];
    const over =
      p && panel.limits && (value < panel.limits[0][j] - 1e-3 || value > panel.limits[1][j] + 1e-3);
    points.push(p);
    beyond.push(over ? p : null);
    if (panel.gaps.has(i)) {
      points.push(null);
      beyond.push(null);
    }
  });
  if (beyond.some(p => p)) stroke(g, beyond, clear(colors.alarm, 0.35), 7);
  g.lineCap = "butt";
  stroke(g, points, color, 2, dashes(patterns, j, 2));
  g.lineCap = "round";
}
