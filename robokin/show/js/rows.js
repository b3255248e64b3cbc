// Rows of joint values, and the distance that determines whether a row exists.

/** Whether a row of joint values exists. @param {number[]} q @returns {boolean} */
export const exists = q => !q.some(Number.isNaN);

/** A row that does not exist. @param {number} n  the number of joints @returns {number[]} */
export const nowhere = n => new Array(n).fill(NaN);

/** @param {number} x @param {number} low @param {number} high @returns {number} */
export const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/**
 * The length of (x, y), as in Python's `distance`.
 * @param {number} x
 * @param {number} y
 * @returns {number}
 */
export function distance2(x, y) {
  const scale = Math.max(Math.abs(x), Math.abs(y), 1e-300);
  x /= scale;
  y /= scale;
  return scale * Math.sqrt(x * x + y * y);
}

/**
 * The option with the least travel from q; NaN if there is none.
 * @param {number[][]} options
 * @param {number[]} q
 * @returns {number[]}
 */
export function leastTravel(options, q) {
  let best = options[0],
    shortest = Infinity;
  for (const option of options) {
    const travel = option.reduce((sum, value, j) => sum + Math.abs(value - q[j]), 0);
    if (travel < shortest) [best, shortest] = [option, travel];
  }
  return best;
}
