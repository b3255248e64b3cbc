// The recording of a motion: its speeds and accelerations, and the jumps in position and speed, as
// in motion/recording.py.

import {differentiate} from "./motion.js";

/** @import {JumpRules} from "./page.js" */

/**
 * The speeds v and accelerations a of joint values q (samples, n), for each unbroken piece; the
 * missing samples, the breaks, and the jumps in speed.
 * @param {number[][]} q  NaN where there is no posture
 * @param {number[]} t  seconds, increasing
 * @param {boolean[]} prismatic
 * @param {JumpRules} rules
 */
export function record(q, t, prismatic, rules) {
  const missing = q.map(row => row.some(Number.isNaN)),
    steps = leaps(q, t, prismatic, rules);
  const gaps = steps.map((row, i) => row.includes(true) || missing[i] || missing[i + 1]);
  const speeds = gaps.map((gap, i) =>
    q[i].map((x, j) => (gap ? NaN : (q[i + 1][j] - x) / (t[i + 1] - t[i]))),
  );
  const [v, a] = derivatives(q, t, gaps),
    jumps = speedJumps(speeds, t);
  for (const {first, last, joints} of jumps)
    for (let i = Math.max(first - 1, 0); i < Math.min(last + 2, q.length); i++)
      a[i] = a[i].map((x, j) => (joints[j] ? NaN : x));
  return {v, a, missing, gaps, jumps};
}

/** @type {(q: number[][], t: number[], gaps: boolean[]) => [v: number[][], a: number[][]]} */
function derivatives(q, t, gaps) {
  const nothing = () => q.map(row => row.map(() => NaN)),
    v = nothing(),
    a = nothing();
  const ends = [0, ...gaps.flatMap((gap, i) => (gap ? [i + 1] : [])), q.length];
  ends.slice(1).forEach((end, k) => {
    const begin = ends[k];
    if (end - begin < 3) return;
    const times = t.slice(begin, end),
      speeds = differentiate(q.slice(begin, end), times);
    v.splice(begin, end - begin, ...speeds);
    a.splice(begin, end - begin, ...differentiate(speeds, times));
  });
  return [v, a];
}

/**
 * The jumps in the speeds between samples: changes far greater than the changes next to them. The
 * result contains the samples, the time and the joints of each jump.
 * @param {number[][]} speeds  (samples - 1, n)
 * @param {number[]} t
 */
function speedJumps(speeds, t) {
  const greatest = speeds[0].map((_, j) =>
    speeds.reduce((most, row) => (Math.abs(row[j]) > most ? Math.abs(row[j]) : most), 0),
  );
  const change = speeds.slice(1).map((row, i) => row.map((x, j) => Math.abs(x - speeds[i][j])));
  /** @type {(i: number, times: number, share: number) => boolean[]} */
  const stands = (i, times, share) =>
    change[i].map((x, j) => {
      const beside = [i - 2, i + 2].map(k => change[k]?.[j] ?? NaN);
      return x > times * Math.max(...beside) + share * greatest[j] + 1e-9;
    });
  const sure = change.flatMap((_, i) => (stands(i, 8, 0.01).includes(true) ? [i] : []));
  /** @type {number[][]} */
  const groups = [];
  for (const i of sure)
    if (groups.length && i - groups[groups.length - 1][1] <= 2) groups[groups.length - 1][1] = i;
    else groups.push([i, i]);
  return groups.map(([low, high]) => {
    // a corner between two samples causes two changes, one of which may be small
    const first = low - Number(stands(low - 1, 3, 0).includes(true)),
      last = high + Number(stands(high + 1, 3, 0).includes(true));
    const rows = change.slice(first, last + 1).map((_, k) => stands(first + k, 3, 0));
    return {
      first: first + 1,
      last: last + 1,
      time: (t[first + 1] + t[last + 1]) / 2,
      joints: greatest.map((_, j) => rows.some(row => row[j])),
    };
  });
}

/**
 * Whether each joint jumps in position between each sample and the next, by the rule of `record`.
 * @param {number[][]} q  (samples, n), NaN where there is no posture
 * @param {number[]} t  seconds, increasing
 * @param {boolean[]} prismatic
 * @param {JumpRules} rules
 * @returns {boolean[][]}  (samples - 1, n)
 */
export function leaps(q, t, prismatic, {least, few}) {
  const columns = prismatic.map((shifts, j) => {
    const steps = q.slice(1).map((row, i) => row[j] - q[i][j]);
    const speeds = steps.map((step, i) => step / (t[i + 1] - t[i]));
    const changes = speeds.slice(1).map((speed, i) => Math.abs(speed - speeds[i]));
    const sorted = changes.filter(Number.isFinite).sort((a, b) => a - b);
    const noise = sorted.length < few ? 0 : 10 * sorted[Math.floor(sorted.length / 4)];
    /** @type {(i: number, left: number, right: number) => boolean} */
    const stands = (i, left, right) =>
      isOutside(speeds, i, left, right, Math.max(least / (t[i + 1] - t[i]), noise));
    /** @type {(i: number) => boolean} */
    const turnsBack = i => speeds[i] * speeds[i + 1] < 0 && stands(i, 1, 2) && stands(i + 1, 2, 1);
    return steps.map(
      (step, i) =>
        (Math.abs(step) > Math.PI && !shifts) ||
        stands(i, 1, 1) ||
        turnsBack(i) ||
        turnsBack(i - 1),
    );
  });
  return q.slice(1).map((_, i) => columns.map(column => column[i]));
}

/**
 * Whether a speed is outside the range of the `left` speeds before it and the `right` speeds after
 * it by more than `most`, and cannot belong to a quick motion.
 * @param {number[]} speeds
 * @param {number} i
 * @param {number} left
 * @param {number} right
 * @param {number} most
 */
function isOutside(speeds, i, left, right, most) {
  // most speeds are near one beside them: this is decided without the search below
  if (Math.abs(speeds[i] - speeds[i - left]) <= most) return false;
  if (Math.abs(speeds[i] - speeds[i + right]) <= most) return false;
  const neighbours = [
    [i - left, -1],
    [i + right, 1],
  ].filter(([k]) => Number.isFinite(speeds[k]));
  const beside = neighbours.map(([k]) => speeds[k]);
  const [low, high] = [Math.min(...beside), Math.max(...beside)];
  const out = Math.max(speeds[i] - high, low - speeds[i]);
  if (!(out > most)) return false;
  let near = high - low,
    far = near;
  for (const [k, side] of neighbours) {
    const on = [1, 2].map(m => Math.abs(speeds[k + m * side] - speeds[k])).filter(Number.isFinite);
    if (!on.length) continue;
    near = Math.max(near, Math.min(...on));
    far = Math.max(far, ...on);
  }
  const both = neighbours.length === 2,
    times = Math.abs(speeds[i]) / Math.max(...beside.map(Math.abs));
  const alone = both && out > 8 * far,
    crowd = out > 8 * near && times > (both ? 3 : 10);
  return alone || crowd;
}
