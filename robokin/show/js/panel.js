// One panel of curves: the curves of some joints over time, with their limits and breaks.

import {
  clear,
  colors,
  jointColor,
  number,
  polygon,
  spot,
  stroke,
  upright,
  write,
} from "./canvas.js";
import {panelWords, shade} from "./panel_words.js";

/** @import {Box, Context, Pixel} from "./canvas.js" */
/** @import {Scale} from "./page.js" */

/**
 * @typedef {object} Panel
 * @property {string} label
 * @property {{unit: string, scale: Scale, joints: number[]}[]} axes
 * @property {Float64Array[]} curves  one for each joint, over the times
 * @property {Set<number>} gaps  samples after which the lines break
 * @property {?number[][]} limits  [low, high], each with a number for every joint
 * @property {number[][]} near  the limits to show: [joint, 0 for low or 1 for high]
 * @property {Mark[]} marks
 * @property {number[]} now  the current value of each joint
 * @property {string} [where]  the size and theme for which its words were placed
 * @property {Note[]} [words]
 */
/** @typedef {{time: number, text: string}} Mark  a dashed line with a text beside it */
/** @typedef {[text: string, place: Box, color: string, size: number, weight?: string]} Note */
/** @typedef {ArrayLike<number>} Times  increasing times in s */
/** @typedef {(value: number) => number} Place  where a time or a value is on the canvas */
/** @typedef {[left: number, right: number, top: number, bottom: number]} Sides */
/**
 * What a panel is drawn on: the canvas, the dashes of the joints' lines, the times and their
 * places, and the sides of the panel.
 * @typedef {{g: Context, patterns: number[][], times: Times, x: Place, sides: Sides}} Ground
 */

/** @type {(patterns: number[][], j: number, width: number) => number[]} */
export const dashes = (patterns, j, width) => patterns[j % patterns.length].map(x => x * width);

/**
 * @param {Ground} ground
 * @param {Panel} panel
 * @param {Scale} ticks  the scale of the time axis
 * @param {number} now
 */
export function drawPanel(ground, panel, ticks, now) {
  const {g, times, x, sides} = ground,
    [left, right, top, bottom] = sides,
    limits = panel.limits ?? [];
  /** @type {Place[]} */
  const ys = [];
  const scales = panel.axes.map(({scale: [low, step, count], joints}) => {
    /** @type {Place} */
    const y = v => bottom - ((bottom - top) * (v - low)) / (step * (count - 1));
    for (const j of joints) ys[j] = y;
    return y;
  });
  write(g, panel.label, left - 40, top - 8, colors.ink, 12, "left", "600");
  g.save();
  g.beginPath();
  g.rect(left, top - 1, right - left, bottom - top + 2);
  g.clip();
  drawGrid(ground, panel.axes[0].scale, scales[0], ticks);
  for (const [j, side] of panel.near)
    band(g, ys[j](limits[side][j]), side ? 1 : -1, left, right, jointColor(j));
  for (const {time} of panel.marks) upright(g, x(time), top, bottom, colors.alarm, 1.2, [3, 3]);
  ys.forEach((y, j) => curve(ground, panel, j, y));
  g.restore();
  g.lineWidth = 1;
  g.strokeStyle = colors.rim;
  g.strokeRect(left, top, right - left, bottom - top);
  drawScales(ground, panel, scales);
  for (const [text, [px, py, , h], color, size, weight] of panelWords(
    g,
    panel,
    ys,
    times,
    x,
    sides,
  ))
    write(g, text, px, py + h - 2, color, size, "left", weight);
  upright(g, x(now), top, bottom, colors.ink, 1.4);
  ys.forEach((y, j) => {
    const at = y(panel.now[j]);
    if (at > top - 3 && at < bottom + 3) spot(g, [x(now), at], 4, jointColor(j));
  });
  for (const {time, text} of panel.marks) if (text) drawMark(ground, x(time));
}

/**
 * Draws lines at the ticks of the first scale and of the time.
 * @param {Ground} ground
 * @param {Scale} scale
 * @param {Place} y
 * @param {Scale} ticks
 */
function drawGrid({g, x, sides: [left, right, top, bottom]}, [low, step, count], y, ticks) {
  for (let i = 0; i < count; i++) {
    const value = low + i * step,
      color = Math.abs(value) < step / 9 ? colors.line : colors.grid;
    /** @type {Pixel[]} */
    const line = [
      [left, y(value)],
      [right, y(value)],
    ];
    stroke(g, line, color, 1);
  }
  for (let i = 0; i < ticks[2]; i++)
    upright(g, x(ticks[0] + i * ticks[1]), top, bottom, colors.grid, 1);
}

/**
 * Writes the numbers of the scales: the first scale on the left, a second one on the right.
 * @param {Ground} ground
 * @param {Panel} panel
 * @param {Place[]} scales
 */
function drawScales({g, sides: [left, right, top]}, {axes}, scales) {
  axes.forEach(({scale: [low, step, count, decimals], unit, joints}, k) => {
    const color = k && joints.length === 1 ? shade(jointColor(joints[0])) : colors.soft,
      px = k ? right + 6 : left - 6;
    for (let i = 0; i < count; i++) {
      const value = low + i * step;
      write(g, number(value, decimals), px, scales[k](value) + 4, color, 11, k ? "left" : "right");
    }
    if (!k) return;
    const text = `${joints.map(j => `q${j + 1}`).join(" and ")}, ${unit}`;
    write(g, text, right + 42, top - 8, color, 12, "right", "600");
  });
}

/** Draws a triangle at each end of a mark's line. @type {(ground: Ground, x: number) => void} */
function drawMark({g, sides: [, , top, bottom]}, x) {
  for (const [y, tip] of [
    [top, top + 7],
    [bottom, bottom - 7],
  ]) {
    /** @type {Pixel[]} */
    const corners = [
      [x - 5, y],
      [x + 5, y],
      [x, tip],
    ];
    polygon(g, corners, colors.alarm);
  }
}

/**
 * Draws a strip beyond a limit, above (side 1) or below it.
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
 * @param {Ground} ground
 * @param {Panel} panel
 * @param {number} j
 * @param {Place} y
 */
function curve({g, patterns, times, x}, panel, j, y) {
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
