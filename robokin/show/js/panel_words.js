// Labels for the marks and limits of a panel of curves, placed where they hide the curves least.

import {colors, font, hit, jointColor, number, shade} from "./canvas.js";

/** @import {Box, Context} from "./canvas.js" */
/** @import {Line, Mark, Note, Panel, Place, Sides, Times} from "./panel.js" */

const MOST = 16, // pixels of curves: no text covers so many
  BAND = 8; // px: farther from its limit, a band is too faint to claim a text

/** The colour of a line. @type {(line: Line) => string} */
export const lineColor = ({joint}) => (joint < 0 ? colors.ink : jointColor(joint));

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
    const cost = cover(panel, ys, times, x, sides),
      notes = noted(g, panel.marks, x, sides, cost);
    panel.where = where;
    panel.words = [...notes, ...limitWords(g, panel, ys, sides, notes, cost)];
  }
  return panel.words ?? [];
}

/**
 * For a row of text, a function of the left end and the width of the text: how many pixels of
 * curves it covers, and 20 more for each limit that it crosses and for each band that it touches,
 * except its own.
 * @param {Panel} panel
 * @param {Place[]} ys
 * @param {Times} times
 * @param {Place} x
 * @param {Sides} sides
 */
function cover({lines, near}, ys, times, x, [left, right]) {
  const each = (right - left) / times.length,
    levels = near.map(([k, side]) => ys[k](lines[k].limits?.[side] ?? NaN));
  /** @type {(y: number, high: number, own?: number) => (px: number, w: number) => number} */
  return (y, high, own = NaN) => {
    const hidden = levels.filter((level, i) => {
      const [above, below] = near[i][1] ? [BAND, 0] : [0, BAND];
      return level !== own && level > y - below && level < y + high + above;
    });
    const crossed = 20 * hidden.length;
    /** @type {number[]} */
    const xs = [];
    lines.forEach(({values}, i) =>
      values.forEach((v, sample) => {
        if (ys[i](v) > y - 1 && ys[i](v) < y + high + 1) xs.push(x(times[sample]));
      }),
    );
    return (px, w) => each * xs.filter(cx => cx > px - 3 && cx < px + w + 3).length + crossed;
  };
}

/** @typedef {ReturnType<typeof cover>} Cost */

/**
 * The text of at most three marks: next to their lines, almost clear of the curves and clear of the
 * limits; without the name of the arm, or only the size of the jump, where there is no room for
 * more. The sentences above the panels tell what has no such place.
 * @param {Context} g
 * @param {Mark[]} marks
 * @param {Place} x
 * @param {Sides} sides
 * @param {Cost} cost
 */
function noted(g, marks, x, [left, right, top, bottom], cost) {
  /** @type {Note[]} */
  const notes = [];
  g.font = font(11, 600);
  for (const {time, text} of marks) {
    /** @type {?Box} */
    let best = null;
    let least = MOST;
    for (const words of [text, text.replace(/^.*: /, ""), text.replace(/^.* by /, "")]) {
      if (!text || best || notes[2]) continue;
      const w = g.measureText(words).width,
        taken = notes.map(([, place]) => place);
      for (let y = top + 5; y + 11 < bottom; y += 6) {
        const over = cost(y, 11);
        for (const px of [x(time) + 6, x(time) - w - 6])
          if (px > left && px + w < right && over(px, w) < least && !hit([px, y, w, 11], taken))
            [best, least] = [[px, y, w, 11], over(px, w)];
      }
      if (best) notes.push([words, best, colors.alarm, 11, "600"]);
    }
  }
  return notes;
}

/**
 * The text of the limits: next to their lines, clear of other text and almost clear of the curves;
 * without the word "limit" where there is room only for the rest. A limit for which there is no
 * such place has only its band.
 * @param {Context} g
 * @param {Panel} panel
 * @param {Place[]} ys  the height of a value, for each line
 * @param {Sides} sides
 * @param {Note[]} notes
 * @param {Cost} cost
 */
function limitWords(g, panel, ys, [left, right, top, bottom], notes, cost) {
  /** @type {Note[]} */
  const found = [];
  g.font = font(10);
  for (const [which, side] of panel.near) {
    const line = panel.lines[which],
      limit = line.limits?.[side] ?? NaN,
      at = ys[which](limit),
      {unit} = panel.axes[line.axis];
    const value = number(limit, +!Number.isInteger(limit)),
      gap = unit[0] === "\u00B0" ? "" : " ";
    const taken = [...notes, ...found].map(([, place]) => place);
    /** @type {?Box} */
    let best = null;
    let least = MOST;
    for (const word of ["limit ", ""]) {
      const text = `q${line.joint + 1} ${word}${value}${gap}${unit}`,
        w = g.measureText(text).width;
      for (const y of side ? [at - 13, at + 2] : [at + 2, at - 13]) {
        if (y < top + 1 || y + 11 > bottom - 1) continue;
        const over = cost(y, 11, at);
        for (let px = left + 5; px + w + 5 < right; px += 6)
          if (over(px, w) < least && !hit([px - 4, y, w + 8, 11], taken))
            [best, least] = [[px, y, w, 11], over(px, w)];
      }
      if (best) {
        found.push([text, best, shade(lineColor(line)), 10]);
        break;
      }
    }
  }
  return found;
}
