// The greatest speeds and accelerations of a motion, including those between its samples.

import {refinedMaximum} from "./motion.js";

const NODES = [-2, -1, 0, 1, 2],
  FINE = 2e-4, // node spacing, as a fraction of the whole motion
  SHARE = 200; // the spacing is also at most 1 / SHARE of an interval

/** The number of decimals that rounding errors do not affect. @type {(x: number) => number} */
export const decimalsOf = x => (Math.abs(x) < 1e4 ? 1 : 0);

/**
 * The time at which an increasing law reaches s.
 * @param {(t: number) => number} law
 * @param {number} duration
 * @param {number} s
 */
export function timeOf(law, duration, s) {
  let [low, high] = [0, duration];
  for (let i = 0; i < 60; i++) {
    const middle = (low + high) / 2;
    if (law(middle) < s) low = middle;
    else high = middle;
  }
  return high;
}

/**
 * A quantity of a motion, and a value of about the same size as its greatest.
 * @typedef {{of: (slopes: number[][]) => number, about: number}} Quantity  of the speeds and the
 *   accelerations of all joints
 */

/**
 * The greatest value of each quantity, with two more accurate decimals than `decimalsOf` returns,
 * and the speeds and accelerations of all joints there.
 * @param {(t: number) => number[]} posture  NaN if there is none, or it is uncertain
 * @param {number[]} ends  the ends of the intervals, increasing: an acceleration or a speed may
 *   jump there
 * @param {Quantity[]} quantities
 * @returns {?{value: number, slopes: number[][]}[]}  null if the search for one of them does not
 *   converge, or a posture is uncertain
 */
export function peaks(posture, ends, quantities) {
  const last = /** @type {number} */ (ends.at(-1));
  /** @type {{value: number, slopes: number[][]}[]} */
  const best = quantities.map(() => ({value: -Infinity, slopes: []}));
  let sure = true;
  // the shortest first: it is usually the corner, and what it reaches shortens the other searches
  const parts = ends.slice(1).map((high, k) => [ends[k], high]);
  parts.sort(([a, b], [c, d]) => b - a - (d - c));
  for (const [low, high] of parts) {
    if (!(high - low > 1e-9 * last)) continue;
    const h = Math.min(FINE * last, (high - low) / SHARE);
    /** @type {Map<number, number[][]>} */
    const known = new Map();
    /** @type {(t: number) => number[][]} */
    const slopesAt = t => {
      const found = known.get(t) || slopes(posture, t, low + 2 * h, high - 2 * h, h);
      known.set(t, found);
      sure &&= !found[0].some(Number.isNaN);
      return found;
    };
    for (const [n, {of, about}] of quantities.entries()) {
      const {value, at} = refinedMaximum(
        t => of(slopesAt(t)),
        low,
        high,
        decimalsOf(about),
        best[n].value,
      );
      if (!sure || Number.isNaN(value)) return null;
      if (value > best[n].value) best[n] = {value, slopes: slopesAt(at)};
    }
  }
  return best;
}

/**
 * Speeds and accelerations at t, from the polynomials through five postures. The middle posture is
 * at t or, if t is outside `low` to `high`, at the nearer of the two.
 * @param {(t: number) => number[]} posture
 * @param {number} t
 * @param {number} low
 * @param {number} high
 * @param {number} h  the time from posture to posture
 */
function slopes(posture, t, low, high, h) {
  const middle = Math.min(Math.max(t, low), high),
    u = (t - middle) / h;
  const [a, b, c, d, e] = NODES.map(k => posture(middle + k * h));
  const speeds = [],
    accelerations = [];
  for (let j = 0; j < c.length; j++) {
    const [odd, wide] = [d[j] - b[j], e[j] - a[j]],
      [even, far] = [d[j] - 2 * c[j] + b[j], e[j] - 2 * c[j] + a[j]];
    // the coefficients of the polynomial in u
    const p1 = (8 * odd - wide) / 12,
      p2 = (16 * even - far) / 24,
      p3 = (wide - 2 * odd) / 12,
      p4 = (far - 4 * even) / 24;
    speeds.push((p1 + u * (2 * p2 + u * (3 * p3 + u * 4 * p4))) / h);
    accelerations.push((2 * p2 + u * (6 * p3 + u * 12 * p4)) / (h * h));
  }
  return [speeds, accelerations];
}
