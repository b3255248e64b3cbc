// Labels for the marks and limits of a panel of curves, placed where they hide the curves least.

import {colors, font, hit, jointColor, number} from "./canvas.js";

/** @import {Box, Context} from "./canvas.js" */
/** @import {Line, Mark, Note, Panel, Place, Sides, Times} from "./panel.js" */

/** The colour of a line. @type {(line: Line) => string} */
export const lineColor = ({joint}) => (joint < 0 ? colors.ink : jointColor(joint));

/** A joint's colour, changed so that text in it is readable. @type {(color: string) => string} */
export const shade = color => `color-mix(in srgb, ${color} 60%, ${colors.ink})`;

/**
 * The text of a panel. It is placed once for each size and theme, and not again at every redraw.
 * @param {Context} g
 * @param {Panel} panel
 * @param {Place[]} ys  the height of a value, for each line
 * @param {Times} times
 * @param {Place} x
 * @param {Sides} sides
 */
export function panelWords(g, panel, ys, times, x, sides) {
  const where = [...sides, colors.ink].join();
  if (panel.where !== where) {
    const notes = noted(g, panel.marks, x, sides);
    panel.where = where;
    panel.words = [...notes, ...limitWords(g, panel, ys, times, x, sides, notes)];
  }
  return panel.words ?? [];
}

/**
 * The text of the marks, in at most three lines.
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
 * The text of the limits: next to their lines, clear of other text and almost clear of the curves.
 * At most three limits have text. A limit for which there is no such place has only its band.
 * @param {Context} g
 * @param {Panel} panel
 * @param {Place[]} ys  the height of a value, for each line
 * @param {Times} times
 * @param {Place} x
 * @param {Sides} sides
 * @param {Note[]} notes
 */
function limitWords(g, panel, ys, times, x, [left, right, top, bottom], notes) {
  /** @type {Note[]} */
  const found = [];
  /** @type {(k: number, side: number) => number} */
  const limitOf = (k, side) => panel.lines[k].limits?.[side] ?? NaN;
  const each = (right - left) / times.length,
    lines = panel.near.map(([k, side]) => ys[k](limitOf(k, side)));
  g.font = font(10);
  panel.near.forEach(([which, side], k) => {
    const line = panel.lines[which],
      limit = limitOf(which, side),
      at = lines[k],
      {unit} = panel.axes[line.axis];
    const value = number(limit, +!Number.isInteger(limit)),
      gap = unit[0] === "\u00B0" ? "" : " ";
    const text = `q${line.joint + 1} limit ${value}${gap}${unit}`;
    const w = g.measureText(text).width,
      taken = [...notes, ...found].map(([, place]) => place);
    /** @type {?Box} */
    let best = null;
    let least = 16; // pixels of curves that the text may cover
    for (const y of side ? [at - 13, at + 2] : [at + 2, at - 13]) {
      if (y < top + 1 || y + 11 > bottom - 1) continue;
      const crossed = 20 * lines.filter(line => line > y && line < y + 11).length;
      /** @type {number[]} */
      const beside = [];
      panel.lines.forEach(({values}, i) => {
        const on = ys[i];
        values.forEach((v, sample) => {
          if (on(v) > y - 1 && on(v) < y + 12) beside.push(x(times[sample]));
        });
      });
      for (let px = left + 5; px + w + 5 < right; px += 6) {
        if (hit([px - 4, y, w + 8, 11], taken)) continue;
        const cost = each * beside.filter(cx => cx > px - 3 && cx < px + w + 3).length + crossed;
        if (cost < least) [best, least] = [[px, y, w, 11], cost];
      }
    }
    if (best && found.length < 3) found.push([text, best, shade(lineColor(line)), 10]);
  });
  return found;
}
