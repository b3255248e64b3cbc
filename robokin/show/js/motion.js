// Paths, time laws and derivatives, as in motion/paths.py, laws.py, derivatives.py, maximum.py.

import {slerp} from "./rotations.js";

/** @import {PagePose} from "./page.js" */

const STEPS = 64,
  AROUND = 8,
  MOST = 200;

/**
 * @param {number} s
 */
const clipped = s => Math.min(Math.max(s, 0), 1);

/**
 * Interpolates from pose a (s = 0) to pose b (s = 1): on a straight line, at constant angular
 * velocity.
 * @param {PagePose} a
 * @param {PagePose} b
 * @param {number} s
 * @returns {PagePose}
 */
export function lerp(a, b, s) {
  /** @type {PagePose} */
  const there = {place: a.place.map((from, k) => from + (b.place[k] - from) * s)};
  if (a.rotation && b.rotation) there.rotation = slerp(a.rotation, b.rotation, s);
  if (a.angle !== undefined && b.angle !== undefined)
    there.angle = a.angle + (b.angle - a.angle) * s;
  return there;
}

/**
 * The straight motion between two poses, at s in [0, 1].
 * @param {PagePose} start
 * @param {PagePose} goal
 * @param {number} s
 * @returns {PagePose}
 */
export const lin = (start, goal, s) => lerp(start, goal, clipped(s));

/**
 * The point-to-point motion: all joints move linearly from q0 to q1, at s in [0, 1].
 * @param {number[]} q0
 * @param {number[]} q1
 * @param {number} s
 * @returns {number[]}
 */
export const ptp = (q0, q1, s) => q0.map((value, j) => value + clipped(s) * (q1[j] - value));

/**
 * Two straight motions with a corner that is rounded for |s - 1/2| < `fraction`.
 * @param {PagePose} start
 * @param {PagePose} via
 * @param {PagePose} goal
 * @param {number} fraction  a number in [0, 0.5]
 * @param {number} s
 * @param {"parabola"|"quintic"} [corner]
 * @returns {PagePose}
 */
export function blend(start, via, goal, fraction, s, corner = "parabola") {
  const share = clipped(s),
    b = fraction;
  const x = b > 0 ? clipped((share - 0.5 + b) / (2 * b)) : Number(share >= 0.5);
  const first = lerp(start, via, Math.min(2 * share, 1 - 2 * b));
  if (x === 0) return first;
  const last = lerp(via, goal, Math.max(2 * share - 1, 2 * b));
  let poses = [first, via, last];
  if (corner === "quintic") {
    poses = [
      first,
      lerp(first, via, 0.4),
      lerp(first, via, 0.8),
      lerp(last, via, 0.8),
      lerp(last, via, 0.4),
      last,
    ];
  }
  // de Casteljau: interpolate between neighbours
  while (poses.length > 1) poses = poses.slice(1).map((pose, i) => lerp(poses[i], pose, x));
  return poses[0];
}

/**
 * Two consecutive straight motions, which meet at `via` for s = 1/2.
 * @param {PagePose} start
 * @param {PagePose} via
 * @param {PagePose} goal
 * @param {number} s
 * @returns {PagePose}
 */
export const lin_lin = (start, via, goal, s) => blend(start, via, goal, 0, s);

/**
 * Makes the law s(t) over `duration` seconds from `progress`, which maps t / duration to s.
 * @param {number} duration
 * @param {(x: number) => number} progress
 * @returns {(t: number) => number}
 */
const timeLaw = (duration, progress) => t =>
  clipped(progress(Math.min(Math.max(t, 0), duration) / duration));

/**
 * The law of constant speed.
 * @param {number} duration  seconds
 * @returns {function(number): number}  s at t
 */
export const linear = duration => timeLaw(duration, x => x);

/**
 * The law of constant acceleration, constant speed and constant deceleration.
 * @param {number} duration  seconds
 * @param {number} [ramp]  each ramp as a fraction of the duration, at most 0.5
 * @returns {function(number): number}  s at t
 */
export const trapezoidal = (duration, ramp = 0.25) =>
  timeLaw(duration, x => {
    const left = Math.min(x, 1 - x),
      up = Math.min(left, ramp);
    const s = (1 / (1 - ramp)) * ((up * up) / (2 * ramp) + (left - up));
    return x > 0.5 ? 1 - s : s;
  });

/**
 * The law whose speed and acceleration are zero at both ends.
 * @param {number} duration  seconds
 * @returns {function(number): number}  s at t
 */
export const quintic = duration => timeLaw(duration, x => x * x * x * (10 + x * (6 * x - 15)));

/**
 * The derivative of samples by central differences, one-sided at both ends. A missing sample (NaN)
 * spreads to its neighbours.
 * @param {number[][]} values  at least three rows of n
 * @param {number[]} t  seconds, increasing
 * @param {number} [order]
 * @returns {number[][]}
 */
export function differentiate(values, t, order = 1) {
  if (order > 1) values = differentiate(values, t, order - 1);
  const last = t.length - 1;
  return values.map((row, i) => {
    // the slope at t[i] of the parabola through three samples
    const k = Math.min(Math.max(i, 1), last - 1),
      h = t[k] - t[k - 1],
      g = t[k + 1] - t[k];
    const x = t[i] - t[k];
    const [a, b, c] = [
      (2 * x - g) / (h * (h + g)),
      -(2 * x + h - g) / (h * g),
      (2 * x + h) / (g * (h + g)),
    ];
    return row.map((value, j) =>
      Number.isNaN(value) ? NaN : a * values[k - 1][j] + b * values[k][j] + c * values[k + 1][j],
    );
  });
}

/**
 * The greatest value of `quantity` between low and high, accurate enough to be shown with this many
 * decimals, and where it is, as in Python's `refined_maximum`. `quantity` is NaN where it has no
 * value.
 * @param {(x: number) => number} quantity
 * @param {number} low
 * @param {number} high
 * @param {number} decimals
 * @param {number} [known]  a value reached elsewhere: only a greater one is searched for, and if
 *   there is none, the value returned is this one
 * @returns {{value: number, at: number}}  NaN if there is no value, or the search does not converge
 */
export function refinedMaximum(quantity, low, high, decimals, known = -Infinity) {
  const fine = 0.5 * 10 ** -(decimals + 2);
  const nothing = {value: NaN, at: NaN};
  let best = {value: known, at: NaN};
  /** @type {number[][]} */
  const stretches = [[Infinity, low, high]];
  for (let looked = 0; looked < MOST; looked++) {
    const [hope, start, stop] = stretches.pop() || [-Infinity, 0, 0];
    if (hope === -Infinity || hope < best.value + fine)
      return best.value === -Infinity ? nothing : best;
    const steps = looked ? AROUND : STEPS;
    const at = Array.from({length: steps + 1}, (_, k) => start + (stop - start) * (k / steps));
    const values = at.map(quantity);
    values.forEach((value, i) => {
      if (Number.isNaN(value)) return;
      if (value > best.value) best = {value, at: at[i]};
      const [from, to] = [Math.max(i - 1, 0), Math.min(i + 1, steps)];
      const near = values.slice(from, to + 1).filter(x => !Number.isNaN(x));
      if (value === Math.max(...near))
        stretches.push([2 * value - Math.min(...near), at[from], at[to]]);
    });
    stretches.sort(([a, from], [b, to]) => a - b || from - to);
  }
  return nothing;
}
