// Two links and the limits of their reach, as in arms/geometry.py.

/** @import {Tolerances} from "./page.js" */

/** @typedef {{kind: string, metres: number}} Gap  which limit is exceeded, and by how much */

export const SIGNS = [1, -1];

/**
 * The triangle of two links whose ends are d apart, computed with half angles (see `two_levers`);
 * null if there is none.
 * @param {number} upper
 * @param {number} fore
 * @param {number} d
 * @param {Tolerances} tolerances
 */
export function twoLevers(upper, fore, d, {ROUNDING}) {
  const slack = ROUNDING * (upper + fore),
    fold = d - Math.abs(upper - fore);
  let stretch = upper + fore - d;
  if (!(stretch >= -slack && fold >= -slack)) return null;
  stretch = Math.max(stretch, 0);
  const around = upper + fore + d;
  const short = Math.max(d - (upper - fore), 0),
    long = Math.max(d + (upper - fore), 0);
  return {
    ahead: 2 * Math.atan2(Math.sqrt(stretch * short), Math.sqrt(around * long)),
    turn: 2 * Math.atan2(Math.sqrt(stretch * around), Math.sqrt(short * long)),
  };
}

/**
 * The limit that is exceeded most. `borders` maps the name of each limit to the metres beyond it.
 * @param {Object<string, number>} borders
 * @returns {Gap}
 */
export function worst(borders) {
  const [kind, metres] = Object.entries(borders).reduce((a, b) => (b[1] > a[1] ? b : a));
  return {kind, metres: Math.max(metres, 0)};
}
