// Plots the distance of the nearest lever from an obstacle during a motion, with the required
// distance and the least distance.

import {
  clear,
  colors,
  font,
  number,
  polygon,
  prepared,
  spot,
  stroke,
  upright,
  write,
} from "./canvas.js";
import {placeLabels} from "./labels.js";
import {scale} from "./ticks.js";

/** @import {Context, Pixel} from "./canvas.js" */
/** @import {Least, Motion} from "./approach.js" */

/** @typedef {(value: number) => number} Place */
/**
 * What the curve shows: the motion, the distances of the nearest lever and of the gripper at its
 * samples, the least distance of a lever, the required distance, the current moment, and the names
 * of the via points.
 * @typedef {object} Shown
 * @property {Motion} motion
 * @property {number[]} levers
 * @property {number[]} gripper
 * @property {Least} least
 * @property {number} wanted
 * @property {Least} now
 * @property {string[]} vias
 */
/**
 * @typedef {{g: Context, left: number, right: number, top: number, bottom: number, x: Place,
 *   y: Place}} Plot
 */

const MARGIN = {left: 40, right: 14, top: 50, bottom: 34}, // px
  DASH = [6, 4];

/** A length in millimetres. @param {number} metres */
const inMm = metres => 1000 * metres;

/**
 * Draws the curve or, if there is no motion, only its title.
 * @param {HTMLCanvasElement} canvas
 * @param {Record<string, string>} words
 * @param {?Shown} shown
 * @returns {?{shareAt: (px: number) => number}}  the fraction at a horizontal position
 */
export function drawApproach(canvas, words, shown) {
  const ready = prepared(canvas);
  if (!ready) return null;
  const [g, w, h] = ready;
  write(g, words.curveTitle, 6, 14, colors.ink, 12, "left", "600");
  if (!shown) return null;
  const {motion, levers, gripper, least, wanted, now} = shown,
    most = inMm(Math.max(...levers, 1.5 * wanted)),
    ticks = scale(0, most),
    plot = plotOf(g, w, h, ticks[1] * (ticks[2] - 1)),
    {left, right, top, bottom, x, y} = plot;
  drawLegend(g, words, left);
  drawAxes(plot, ticks, words.motionAxis);
  g.save();
  g.beginPath();
  g.rect(left, top, right - left, bottom - top);
  g.clip();
  g.fillStyle = clear(colors.alarm, 0.1);
  g.fillRect(left, y(wanted), right - left, bottom - y(wanted));
  /** @type {(values: number[]) => Pixel[]} */
  const line = values => values.map((value, i) => [x(motion.shares[i]), y(value)]);
  stroke(g, line(gripper), colors.soft, 1.8, DASH);
  stroke(g, line(levers), colors.ink, 2.2);
  const past = levers.map(value => (value < wanted ? value : NaN));
  stroke(g, line(past), colors.alarm, 3.4);
  g.restore();
  stroke(
    g,
    [
      [left, y(wanted)],
      [right, y(wanted)],
    ],
    colors.alarm,
    1.4,
  );
  drawVias(plot, shown);
  upright(g, x(now.share), top, bottom, colors.ink, 1.4);
  spot(g, [x(now.share), y(now.distance)], 4.5, colors.accent);
  drawLeast(plot, least);
  drawWanted(plot, wanted);
  return {shareAt: px => (px - left) / (right - left)};
}

/**
 * The area of the plot on a canvas, for distances up to `most` millimetres.
 * @param {Context} g
 * @param {number} w
 * @param {number} h
 * @param {number} most
 * @returns {Plot}
 */
function plotOf(g, w, h, most) {
  const [left, right] = [MARGIN.left, w - MARGIN.right],
    [top, bottom] = [MARGIN.top, h - MARGIN.bottom];
  return {
    g,
    left,
    right,
    top,
    bottom,
    x: share => left + (right - left) * share,
    y: value => bottom - ((bottom - top) * inMm(value)) / most,
  };
}

/**
 * Draws the legend of the two lines.
 * @param {Context} g
 * @param {Record<string, string>} words
 * @param {number} left
 */
function drawLegend(g, words, left) {
  let px = left;
  for (const [text, color, dash] of /** @type {[string, string, number[]][]} */ ([
    [words.anyLever, colors.ink, []],
    [words.gripper, colors.soft, DASH],
  ])) {
    stroke(
      g,
      [
        [px, 26],
        [px + 20, 26],
      ],
      color,
      2,
      dash,
    );
    write(g, text, px + 25, 30, colors.ink, 11);
    g.font = font(11);
    px += 40 + g.measureText(text).width;
  }
}

/**
 * Draws the grid with the numbers of both axes.
 * @param {Plot} plot
 * @param {import("./page.js").Scale} ticks  of the distances, in mm
 * @param {string} axis
 */
function drawAxes({g, left, right, top, bottom, x, y}, [low, step, count, decimals], axis) {
  for (let i = 0; i < count; i++) {
    const py = y((low + i * step) / 1000);
    stroke(
      g,
      [
        [left, py],
        [right, py],
      ],
      i ? colors.grid : colors.line,
      1,
    );
    write(g, number(low + i * step, decimals), left - 5, py + 4, colors.soft, 11, "right");
  }
  for (const percent of [0, 25, 50, 75, 100]) {
    upright(g, x(percent / 100), top, bottom, colors.grid, 1);
    write(g, String(percent), x(percent / 100), bottom + 14, colors.soft, 11, "center");
  }
  write(g, axis, (left + right) / 2, bottom + 28, colors.soft, 11, "center");
}

/**
 * Draws a dotted line where the gripper is at a via point, and writes its name above it. Names that
 * would overlap make room on the side away from the current moment, whose line has no name.
 * @param {Plot} plot
 * @param {Shown} shown
 */
function drawVias({g, top, bottom, x}, {motion: {ends}, vias, now}) {
  const places = vias.map((_, k) => x(ends[k + 1])),
    side = x(now.share) > places[places.length - 1] ? -1 : 1;
  let before = -Infinity;
  for (const k of side > 0 ? vias.keys() : [...vias.keys()].reverse()) {
    upright(g, places[k], top, bottom, colors.soft, 1.2, [2, 3]);
    before = Math.max(before + 22, side * places[k]);
    write(g, vias[k], side * before, top - 4, colors.soft, 11, "center");
  }
}

/**
 * Writes the required distance next to its line, where there is most room.
 * @param {Plot} plot
 * @param {number} wanted
 */
function drawWanted({g, left, right, top, bottom, y}, wanted) {
  const along = [0, 1, 2, 3, 4, 5, 6].map(
    /** @returns {Pixel} */ k => [left + 24 + (k / 6) * (right - left - 48), y(wanted)],
  );
  const text = `${number(inMm(wanted), 0)} mm`,
    look = {color: colors.alarm, weight: "600", near: true};
  placeLabels(g, [{text, at: along[0], along, ...look}], [left, top, right - left, bottom - top]);
}

/**
 * Draws a diamond at the least distance.
 * @param {Plot} plot
 * @param {Least} least
 */
function drawLeast({g, x, y}, {share, distance}) {
  const [px, py] = [x(share), y(distance)];
  /** @type {Pixel[]} */
  const corners = [
    [px, py - 6],
    [px + 6, py],
    [px, py + 6],
    [px - 6, py],
  ];
  polygon(g, corners, colors.near, colors.paper, 1.5);
}
