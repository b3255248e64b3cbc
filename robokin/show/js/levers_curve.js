// The sum S of the angle changes of three levers as a curve over the free angle alpha, with its
// terms, its kinks and its least value.

import {
  colors,
  jointColor,
  level,
  number,
  polygon,
  prepared,
  spot,
  stroke,
  upright,
  write,
} from "./canvas.js";
import {degrees, radians} from "./turns.js";

/** @import {Context, Pixel} from "./canvas.js" */
/** @import {Kink} from "./levers.js" */

/**
 * The sum S of the angle changes for one point.
 * @typedef {object} Costs
 * @property {number} low  the lowest alpha with which the arm reaches the point
 * @property {number} high  the highest one
 * @property {number} alpha  the chosen value
 * @property {number[]} limits  the limits of the joint with the angle alpha
 * @property {number[]} q  the posture with the chosen alpha
 * @property {number[]} changes  its angle changes
 * @property {number[]} best  the posture with the least S
 * @property {number[]} fewest  its angle changes
 * @property {Kink[]} kinks  the kinks of S
 * @property {(alpha: number) => number[]} at  returns the angle changes with any alpha
 */
/** @typedef {(value: number) => number} Place */
/**
 * @typedef {{g: Context, left: number, right: number, top: number, bottom: number, x: Place,
 *   y: Place}} Plot
 */
/**
 * How S is drawn: its name, the name of alpha, the names of its terms if they are drawn too, and
 * the dashes of their lines.
 * @typedef {{title: string, axis: string, terms: string[], dashes: number[][]}} Look
 */

const MARGIN = {left: 44, right: 54, top: 26, bottom: 34}, // px
  LINE = 12; // px: the height of a line of text

/** @type {(changes: number[]) => number} */
export const total = changes => changes.reduce((sum, change) => sum + change, 0);

/**
 * The part of the axis of alpha that shows the range, and a little on both sides.
 * @param {Costs} costs
 */
const closeUp = ({low, high, limits: [first, last]}) => {
  const gap = Math.max((high - low) / 10, radians(1));
  return [Math.max(first, low - gap), Math.min(last, high + gap)];
};

/**
 * Draws S. With terms, the axis of alpha covers only the range, to show the shape of S. Otherwise
 * it covers the limits of the joint, to show how the range grows and shrinks.
 * @param {HTMLCanvasElement} canvas
 * @param {Look} look
 * @param {?Costs} costs
 * @returns {?{alphaAt: (px: number) => number}}  the alpha at a horizontal position
 */
export function drawCosts(canvas, look, costs) {
  const ready = prepared(canvas);
  if (!ready) return null;
  const [g, w, h] = ready;
  write(g, look.title, 6, 14, colors.ink, 12, "left", "600");
  if (!costs) return null;
  const {low, high, alpha, best, kinks, at} = costs,
    whole = look.terms.length > 0,
    limits = whole ? closeUp(costs) : costs.limits;
  const alphas = Array.from({length: 121}, (_, i) => low + ((high - low) * i) / 120);
  const corners = [...alphas, best[2], ...(whole ? kinks.map(kink => kink.alpha) : [])];
  const samples = corners.sort((a, b) => a - b),
    rows = samples.map(at),
    sums = rows.map(total);
  const least = whole ? 0 : Math.min(...sums),
    most = Math.max(...sums, 1e-9);
  const plot = plotOf(g, w, h, limits, [least, Math.max(most, least + 1e-9)]),
    {x, y, top, bottom} = plot;
  drawLevels(plot, whole ? [0, total(costs.fewest), most] : [least, most]);
  upright(g, x(best[2]), top, bottom, colors.near, 1.4, [4, 3]);
  /** @type {(values: number[]) => Pixel[]} */
  const line = values => values.map((value, i) => [x(samples[i]), y(value)]);
  const terms = look.terms.map((_, j) => rows.map(row => row[j]));
  terms.forEach((term, j) =>
    stroke(
      g,
      line(term),
      jointColor(j),
      1.8,
      look.dashes[j].map(x => 1.8 * x),
    ),
  );
  stroke(g, line(sums), colors.ink, 2.2);
  if (whole) {
    drawKinks(plot, costs);
    const ends = [...terms, sums].map(values => y(values[values.length - 1]));
    tellLines(plot, x(high) + 6, look, ends);
  }
  upright(g, x(alpha), top, bottom, colors.ink, 1.4);
  diamond(g, [x(best[2]), y(total(costs.fewest))]);
  spot(g, [x(alpha), y(total(costs.changes))], 4.5, colors.accent);
  drawAngles(plot, {...costs, limits});
  write(g, look.axis, (plot.left + plot.right) / 2, bottom + 28, colors.soft, 11, "center");
  return {
    alphaAt: px =>
      limits[0] + ((limits[1] - limits[0]) * (px - plot.left)) / (plot.right - plot.left),
  };
}

/**
 * The area of the plot on a canvas, whose axes cover the limits of alpha and these values.
 * @param {Context} g
 * @param {number} w
 * @param {number} h
 * @param {number[]} limits
 * @param {number[]} values  the least and the greatest
 * @returns {Plot}
 */
function plotOf(g, w, h, limits, [least, most]) {
  const [left, right] = [MARGIN.left, w - MARGIN.right],
    [top, bottom] = [MARGIN.top, h - MARGIN.bottom],
    room = most - least;
  return {
    g,
    left,
    right,
    top,
    bottom,
    x: alpha => left + ((right - left) * (alpha - limits[0])) / (limits[1] - limits[0]),
    y: value => bottom - ((bottom - top) * (value - least + 0.05 * room)) / (1.1 * room),
  };
}

/**
 * Draws a horizontal line for each value, and labels it if there is room.
 * @param {Plot} plot
 * @param {number[]} values
 */
function drawLevels({g, left, right, bottom, y}, values) {
  level(g, bottom, left, right, colors.grid, 1);
  /** @type {number[]} */
  const taken = [];
  for (const value of values.toSorted((a, b) => b - a)) {
    level(g, y(value), left, right, colors.grid, 1);
    if (taken.some(py => Math.abs(py - y(value)) < LINE)) continue;
    taken.push(y(value));
    const text = `${number(degrees(value), 0)}\u00B0`;
    write(g, text, left - 5, y(value) + 4, colors.soft, 11, "right");
  }
}

/**
 * Draws two rings at each kink: one on S, and one on the term that is zero.
 * @param {Plot} plot
 * @param {Costs} costs
 */
function drawKinks({g, x, y}, {kinks, at}) {
  for (const {alpha, joint} of kinks) {
    const S = total(at(alpha)),
      color = jointColor(joint);
    upright(g, x(alpha), y(S), y(0), color, 1.2, [2, 3]);
    for (const value of [0, S]) spot(g, [x(alpha), y(value)], 4, colors.paper, color, 2);
  }
}

/**
 * Writes the names of the terms and of S next to the ends of their lines, one below the other, each
 * with a piece of its line.
 * @param {Plot} plot
 * @param {number} px
 * @param {Look} look
 * @param {number[]} ends  px, of the terms and of S
 */
function tellLines({g, top, bottom}, px, {terms, dashes}, ends) {
  const names = [...terms, "S"].map((text, j) => ({text, j, py: ends[j] + 4}));
  names.sort((a, b) => a.py - b.py);
  names.forEach((name, k) => {
    name.py = Math.max(name.py, k ? names[k - 1].py + LINE : top);
  });
  let most = bottom;
  for (const name of names.toReversed()) {
    name.py = Math.min(name.py, most);
    most = name.py - LINE;
  }
  for (const {text, j, py} of names) {
    const [color, dash] = j < terms.length ? [jointColor(j), dashes[j]] : [colors.ink, []];
    level(
      g,
      py - 4,
      px,
      px + 13,
      color,
      1.8,
      dash.map(x => 1.8 * x),
    );
    write(g, text, px + 17, py, colors.ink, 11);
  }
}

/** @param {Context} g @param {Pixel} place */
function diamond(g, [x, y]) {
  /** @type {Pixel[]} */
  const corners = [
    [x, y - 6],
    [x + 6, y],
    [x, y + 6],
    [x - 6, y],
  ];
  polygon(g, corners, colors.near, colors.paper, 1.5);
}

/**
 * Writes both ends of the range of the free angle below the axis, side by side if the range is
 * narrow, and each limit for which there is room.
 * @param {Plot} plot
 * @param {Costs} costs
 */
function drawAngles({g, x, bottom}, {low, high, limits}) {
  /** @type {(value: number, decimals: number, color: string, gap: number) => void} */
  const name = (value, decimals, color, gap) => {
    const align = gap ? (gap < 0 ? "right" : "left") : "center",
      text = `${number(degrees(value), decimals)}\u00B0`;
    write(g, text, x(value) + gap, bottom + 14, color, 11, align);
  };
  const room = 60; // px: the width of the text at one end, and half the width of a limit
  const gap = x(high) - x(low) < room ? 3 : 0;
  name(low, 1, colors.ink, -gap);
  name(high, 1, colors.ink, gap);
  if (x(low) > x(limits[0]) + room) name(limits[0], 0, colors.soft, 0);
  if (x(high) < x(limits[1]) - room) name(limits[1], 0, colors.soft, 0);
}
