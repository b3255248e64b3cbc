// Ticks of a scale, as in `scale` of numbers.py, which uses Matplotlib's rule.

/** @import {Scale} from "./page.js" */

const PARTS = 4,
  STEPS = [0.1, 0.2, 0.25, 0.5, 1, 2, 2.5, 5, 10, 20];

/** Rounds to six digits, and rounding errors to zero. @type {(x: number) => number} */
const digits = x => (Math.abs(x) > 1e-6 ? Number(x.toPrecision(6)) : 0);

/**
 * The scale for values from low to high, with the outermost ticks at or beyond them.
 * @param {number} low
 * @param {number} high
 * @returns {Scale}
 */
export function scale(low, high) {
  [low, high] = [digits(low), digits(high)];
  if (high - low < 1e-6 * Math.max(Math.abs(low), Math.abs(high), 1e-3)) {
    const pad = 0.5 * Math.max(Math.abs(low), 1);
    [low, high] = [low - pad, high + pad];
  }
  const middle = (low + high) / 2,
    far = Math.abs(middle) / (high - low) >= 100;
  const offset = far ? Math.sign(middle) * 10 ** Math.floor(Math.log10(Math.abs(middle))) : 0,
    power = 10 ** Math.floor(Math.log10((high - low) / PARTS));
  const [from, to] = [low - offset, high - offset],
    steps = STEPS.map(step => step * power);
  let k = steps.findIndex(step => step >= (to - from) / PARTS);
  for (; ; k--) {
    const step = steps[k],
      first = Math.floor(from / step) * step,
      begin = whole((from - first) / step, offset / step, Math.floor),
      end = whole((to - first) / step, offset / step, Math.ceil);
    const ticks = Array.from({length: end - begin + 1}, (_, i) => (begin + i) * step + first);
    if (k && ticks.filter(x => x >= from && x <= to).length < 2) continue;
    const [least, next] = ticks.map(x => x + offset);
    return named(Number(least.toPrecision(6)), Number((next - least).toPrecision(6)), ticks.length);
  }
}

/**
 * A number of steps, rounded so that rounding errors do not move it past an integer.
 * @param {number} x
 * @param {number} offset  the offset in steps: the larger it is, the larger the rounding errors
 * @param {(x: number) => number} round  rounds down or up
 */
function whole(x, offset, round) {
  const noise = offset
      ? Math.min(0.4999, Math.max(1e-10, 10 ** (Math.log10(Math.abs(offset)) - 12)))
      : 1e-10,
    near = Math.round(x);
  return Math.abs(x - near) < noise ? near : round(x);
}

/**
 * Adds the decimals that the ticks need.
 * @type {(low: number, step: number, count: number) => Scale}
 */
function named(low, step, count) {
  let decimals = 0;
  while (Math.abs(step - Number(step.toFixed(decimals))) >= 1e-9 * step) decimals++;
  return [low + 0, step, count, decimals];
}
