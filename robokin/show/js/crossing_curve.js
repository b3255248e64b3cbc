// The curves below the numbers of the crossing explorer. They plot the eliminated coordinate of
// both elbows against the coordinate of the tip that changes.

import {clear, colors, number, prepared, spot, stroke, upright, write} from "./canvas.js";
import {placeLabels} from "./labels.js";

/** @import {Box, Context, Pixel, Point} from "./canvas.js" */
/** @import {Tracks} from "./crossing.js" */
/** @import {CrossingExplorer, Found, State} from "./crossing_explorer.js" */
/** @import {Label} from "./labels.js" */
/** @import {Unit} from "./page.js" */

const MARGIN = {left: 34, right: 12, top: 26, bottom: 20}; // px

/**
 * Draws the curves.
 * @param {HTMLCanvasElement} canvas
 * @param {CrossingExplorer} data
 * @param {State} state
 * @param {Found} found
 * @returns {?{at: (px: number) => number}}  the coordinate of the tip at a horizontal position
 */
export function drawCurves(canvas, data, {tip}, {tracks, meets, elbows, formula, crossing}) {
  const ready = prepared(canvas);
  if (!ready) return null;
  const [g, w, h] = ready,
    {arm, divisor, controls, unit, eliminated, rows} = data,
    {l1, reach, base} = arm.geometry,
    k = divisor ?? 0,
    {name: along, low, high} = controls[k],
    far = Math.max(high * unit.size - base[k], base[k] - low * unit.size); // wherever the tip is
  const [left, right, top, bottom] = [MARGIN.left, w - MARGIN.right, MARGIN.top, h - MARGIN.bottom],
    [middle, centre] = [(left + right) / 2, (top + bottom) / 2];
  /** @type {(u: number) => number} */
  const x = u => middle + ((right - left) / 2) * (u / far);
  /** @type {(at: Point) => number} */
  const y = at => centre - ((bottom - top) / 2.2) * ((at[k] - base[k]) / l1);
  /** @type {(at: Point) => number} */
  const u = at => at[k] - base[k];
  const tick = tickOf(unit, base[k]);
  const name = `${eliminated} of both elbows over ${along}, both in ${unit.name}`;
  write(g, name, 4, 14, colors.ink, 12, "left", "600");
  for (const value of [-l1, 0, l1]) {
    const level = centre - ((bottom - top) / 2.2) * (value / l1);
    stroke(
      g,
      [
        [left, level],
        [right, level],
      ],
      colors.grid,
      1,
    );
    write(g, tick(value), left - 4, level + 4, colors.soft, 11, "right");
  }
  upright(g, x(0), top, bottom, colors.line, 1);
  for (const value of [-reach, 0, reach]) {
    write(g, tick(value), x(value), bottom + 15, colors.soft, 11, "center");
  }
  for (const {u: us, right: r, left: l, which} of tracks) {
    /** @type {(way: Point[]) => Pixel[]} */
    const line = way => way.map((at, i) => [x(us[i]), y(at)]);
    if (divisor !== null) stroke(g, line([r, l][which]), clear(colors.ghost, 0.35), 9);
    stroke(g, line(r), colors.accent, 2);
    stroke(g, line(l), colors.near, 2, [7, 4]);
  }
  if (crossing.length)
    stroke(
      g,
      crossing.map(at => [x(0), y(at)]),
      colors.alarm,
      2.2,
      [4, 4],
    );
  upright(g, x(u(tip)), top, bottom, colors.soft, 1, [1.5, 4]);
  for (const {at, tip: place} of meets)
    spot(g, [x(u(place)), y(at)], 4, colors.paper, colors.ink, 1.5);
  elbows.forEach((at, i) => spot(g, [x(u(tip)), y(at)], 3.5, [colors.accent, colors.near][i]));
  if (formula) spot(g, [x(u(tip)), y(formula)], 5, colors.ink);
  nameCurves(g, rows, tracks, x, y, [left, MARGIN.top - 6, right - left, bottom - top + 6]);
  return {at: px => base[k] + ((px - middle) / ((right - left) / 2)) * far};
}

/**
 * The coordinate at a distance from the base, as text.
 * @param {Unit} unit
 * @param {number} base
 * @returns {(value: number) => string}
 */
const tickOf = (unit, base) => value => {
  const shown = (value + base) / unit.size,
    isTenth = Math.abs(10 * shown - Math.round(10 * shown)) < 1e-6;
  return number(shown, unit.size < 1 ? 0 : isTenth ? 1 : 2);
};

/**
 * Writes the names of both elbows beside their curves, where they cover nothing, each apart from
 * the other curve.
 * @param {Context} g
 * @param {string[]} names
 * @param {Tracks[]} tracks
 * @param {(u: number) => number} x
 * @param {(at: Point) => number} y
 * @param {Box} room
 */
function nameCurves(g, names, tracks, x, y, room) {
  const curves = [true, false].map(right =>
      tracks.map(({u, ...both}) =>
        (right ? both.right : both.left).map(/** @returns {Pixel} */ (at, i) => [x(u[i]), y(at)]),
      ),
    ),
    middle = [0.5, 0.4, 0.6, 0.3, 0.7];
  if (!tracks[1]) return;
  const labels = curves.map((parts, k) => {
    const along = parts.flatMap(own => middle.map(share => own[Math.floor(share * own.length)])),
      apart = curves[1 - k].flat(),
      [, other] = curves[1 - k];
    /** @type {Label} */
    const label = {
      text: names[k],
      at: along[0],
      along,
      apart,
      color: [colors.accent, colors.near][k],
      away: [0, along[0][1] > other[other.length >> 1][1] ? 5 : -5],
    };
    return label;
  });
  placeLabels(g, labels, room);
}
