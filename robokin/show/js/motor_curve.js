// Draws steps over time: those sent to a motor, and those that its rotor made.

import {fill} from "./blanks.js";
import {lastOf} from "./bench.js";
import {colors, number, prepared, stroke, upright, write} from "./canvas.js";
import {placeLabels} from "./labels.js";
import {stepOf} from "./rotor.js";

/** @import {PageMotors} from "./page.js" */
/** @import {Bench} from "./bench.js" */
/** @import {Context, Pixel} from "./canvas.js" */

/** @typedef {{g: Context, left: number, right: number, top: number, bottom: number}} Panel */
/** @typedef {(value: number) => number} Place */

/**
 * Draws the steps sent as a staircase, the rotor's steps as a line, and the time cursor.
 * @param {HTMLCanvasElement} canvas
 * @param {PageMotors["words"]} says
 * @param {Bench} bench
 */
export function drawCurve(canvas, says, bench) {
  const ready = prepared(canvas);
  if (!ready) return;
  const [g, w, h] = ready,
    {t, angle, sent} = bench.run(),
    step = stepOf(bench.motor);
  /** @type {Panel} */
  const panel = {g, left: 48, right: w - 46, top: 26, bottom: h - 32},
    {left, right, top, bottom} = panel;
  const made = angle.map(a => (a - angle[0]) / step),
    low = Math.min(0, ...sent, ...made),
    high = Math.max(1, ...sent, ...made);
  /** @type {Place} */
  const x = time => left + ((right - left) * time) / lastOf(t);
  /** @type {Place} */
  const y = value => bottom - ((bottom - top) * (value - low)) / (high - low);
  write(g, says.curveTitle, 6, 14, colors.ink, 12, "left", "600");
  drawLines(panel, y, [lastOf(sent), 0, low, high]);
  const stairs = sent.flatMap((n, i) => corners(i, n, sent, t).map(([a, b]) => [x(a), y(b)]));
  stroke(g, /** @type {Pixel[]} */ (stairs), colors.soft, 1.6, [4, 2]);
  const line = made.map(/** @returns {Pixel} */ (value, i) => [x(t[i]), y(value)]);
  stroke(g, line, colors.accent, 2);
  tellEnds(panel, says, y, lastOf(sent), lastOf(made));
  write(g, "0", left, bottom + 14, colors.soft, 11, "center");
  write(g, number(1000 * lastOf(t), 0), right, bottom + 14, colors.soft, 11, "center");
  write(g, says.curveTime, (left + right) / 2, bottom + 26, colors.soft, 11, "center");
  const {shown, time} = bench.clock;
  if (shown) upright(g, x(time), top, bottom, colors.ink, 1.2);
}

/**
 * The corners of the staircase at sample i: times and steps.
 * @param {number} i
 * @param {number} n
 * @param {number[]} sent
 * @param {number[]} t
 */
function corners(i, n, sent, t) {
  if (i && sent[i - 1] !== n)
    return [
      [t[i - 1], sent[i - 1]],
      [t[i - 1], n],
    ];
  return i === 0 || i === sent.length - 1 ? [[t[i], n]] : [];
}

/**
 * Draws horizontal lines at the given values, where there is room for their numbers.
 * @param {Panel} panel
 * @param {Place} y
 * @param {number[]} values
 */
function drawLines({g, left, right}, y, values) {
  const marked = values.map(Math.round);
  for (const [i, value] of marked.entries()) {
    if (marked.slice(0, i).some(other => Math.abs(y(value) - y(other)) <= 12)) continue;
    /** @type {Pixel[]} */
    const line = [
      [left, y(value)],
      [right, y(value)],
    ];
    stroke(g, line, colors.grid, 1);
    write(g, number(value, 0), left - 5, y(value) + 4, colors.soft, 11, "right");
  }
}

/**
 * Writes the names at the ends of both lines, and the lost steps between or beside them.
 * @param {Panel} panel
 * @param {PageMotors["words"]} says
 * @param {Place} y
 * @param {number} sent
 * @param {number} made
 */
function tellEnds({g, left, right, top, bottom}, says, y, sent, made) {
  /** @type {[number, number]} */
  const ends = [y(sent), y(made)];
  const close = Math.abs(ends[0] - ends[1]) < 13;
  write(g, says.sent, right + 4, ends[0] + (close ? -2 : 4), colors.soft, 11);
  write(g, says.made, right + 4, ends[1] + (close ? 11 : 4), colors.accent, 11);
  const lost = Math.round(Math.abs(sent - made));
  if (lost) upright(g, right - 6, ...ends, colors.alarm, 1.6);
  placeLabels(
    g,
    [
      {
        text: fill(says.gap, {lost}),
        at: [right - 6, (ends[0] + ends[1]) / 2],
        color: lost ? colors.alarm : colors.soft,
        weight: "600",
        away: [-1, 0],
      },
    ],
    [left, top, right - left, bottom - top],
  );
}
