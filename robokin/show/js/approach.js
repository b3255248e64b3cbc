// The distance of the levers of an arm from a point H during a motion. The reference implementation
// is jobs/obstacles/collision.py.

import {clamp, distance2} from "./rows.js";

/** @import {Pixel, Point} from "./canvas.js" */
/** @import {ThreeLeverArm} from "./levers.js" */

/**
 * A motion through postures, between which every joint turns evenly. Properties: the postures, the
 * fraction of S at each of them, S in radians, the fractions of the samples, and O, B, A, K at each
 * sample.
 * @typedef {object} Motion
 * @property {number[][]} path
 * @property {number[]} ends
 * @property {number} S
 * @property {number[]} shares
 * @property {Pixel[][]} points  in metres
 */
/** @typedef {{distance: number, place: Pixel}} Near  the point of a lever nearest to H, in m */
/**
 * The least distance of a lever or of the gripper (index 3), and the fraction of the motion at
 * which it occurs.
 * @typedef {Near & {index: number, share: number}} Least
 */

const SAMPLES = 240,
  GOLDEN = (Math.sqrt(5) - 1) / 2,
  SAME = 2e-6, // m: if two distances differ by less, the first of the two levers is named
  ROUNDS = 40; // of the golden-section search, which shrink its interval by a factor of 1e-8

/**
 * The points O, B, A and K in metres.
 * @param {ThreeLeverArm} arm
 * @param {number[]} q
 */
export function jointsOf({geometry: {levers}}, q) {
  /** @type {Pixel[]} */
  const points = [[0, 0]];
  let direction = Math.PI;
  q.forEach((angle, j) => {
    const [x, y] = points[j];
    direction += angle - Math.PI;
    points.push([x + levers[j] * Math.cos(direction), y + levers[j] * Math.sin(direction)]);
  });
  return points;
}

/**
 * Returns the motion through these postures.
 * @param {ThreeLeverArm} arm
 * @param {number[][]} path
 * @returns {Motion}
 */
export function motionOf(arm, path) {
  const sums = [0];
  for (let k = 1; k < path.length; k++)
    sums.push(path[k].reduce((sum, x, j) => sum + Math.abs(x - path[k - 1][j]), sums[k - 1]));
  const S = sums[sums.length - 1],
    ends = sums.map(sum => sum / (S || 1));
  const even = Array.from({length: SAMPLES + 1}, (_, i) => i / SAMPLES),
    shares = [...even, ...ends.slice(1, -1)].sort((a, b) => a - b);
  const points = shares.map(share => jointsOf(arm, postureAt({path, ends}, share)));
  return {path, ends, S, shares, points};
}

/**
 * Returns the posture at a fraction of S, as `along` in planner.py does.
 * @param {Pick<Motion, "path" | "ends">} motion
 * @param {number} share
 */
export function postureAt({path, ends}, share) {
  let k = 0;
  while (k < path.length - 2 && share > ends[k + 1]) k++;
  const from = path[k],
    to = path[k + 1] ?? from,
    span = ends[k + 1] - ends[k];
  const part = span > 0 ? clamp((share - ends[k]) / span, 0, 1) : 0;
  return from.map((x, j) => x + part * (to[j] - x));
}

/**
 * Returns the nearest point to H of each lever and of the gripper.
 * @param {Pixel[]} points  O, B, A, K
 * @param {Point} H
 * @returns {Near[]}
 */
function nearOf(points, [x, y]) {
  /** @type {Pixel[]} */
  const places = points.slice(1).map(([bx, by], j) => {
    const [ax, ay] = points[j],
      [wx, wy] = [bx - ax, by - ay];
    const u = clamp(((x - ax) * wx + (y - ay) * wy) / (wx * wx + wy * wy), 0, 1);
    return [ax + u * wx, ay + u * wy];
  });
  return [...places, points[3]].map(place => ({
    place,
    distance: distance2(place[0] - x, place[1] - y),
  }));
}

/**
 * The nearest lever at a fraction of the motion.
 * @param {ThreeLeverArm} arm
 * @param {Motion} motion
 * @param {Point} H
 * @param {number} share
 * @returns {Least}
 */
export function nearestAt(arm, motion, H, share) {
  const each = nearOf(jointsOf(arm, postureAt(motion, share)), H).slice(0, 3),
    index = each.reduce((best, {distance}, k) => (distance < each[best].distance ? k : best), 0);
  return {...each[index], index, share};
}

/**
 * The distances of the nearest lever and of the gripper at all samples, in metres, and the least
 * distance of each.
 * @param {ThreeLeverArm} arm
 * @param {Motion} motion
 * @param {Point} H
 */
export function approachOf(arm, motion, H) {
  const rows = motion.points.map(points => nearOf(points, H).map(({distance}) => distance)),
    found = [0, 1, 2, 3].map(k => leastOf(arm, motion, H, rows, k));
  return {
    levers: rows.map(row => Math.min(row[0], row[1], row[2])),
    gripper: rows.map(row => row[3]),
    least: found
      .slice(0, 3)
      .reduce((best, one) => (one.distance < best.distance - SAME ? one : best)),
    gripperLeast: found[3],
  };
}

/**
 * The least distance of one lever or of the gripper. A golden-section search refines every sample
 * whose distance is not greater than those of its neighbours.
 * @param {ThreeLeverArm} arm
 * @param {Motion} motion
 * @param {Point} H
 * @param {number[][]} rows
 * @param {number} index
 * @returns {Least}
 */
function leastOf(arm, motion, H, rows, index) {
  const {shares} = motion,
    last = shares.length - 1;
  /** @type {(share: number) => Least} */
  const at = share => ({
    ...nearOf(jointsOf(arm, postureAt(motion, share)), H)[index],
    index,
    share,
  });
  let best = at(0);
  for (let i = 0; i <= last; i++) {
    const here = rows[i][index];
    if (here > rows[Math.max(0, i - 1)][index] || here > rows[Math.min(last, i + 1)][index])
      continue;
    let [low, high] = [shares[Math.max(0, i - 1)], shares[Math.min(last, i + 1)]];
    for (let round = 0; round < ROUNDS; round++) {
      const [a, b] = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
      if (at(a).distance < at(b).distance) high = b;
      else low = a;
    }
    for (const one of [at((low + high) / 2), at(shares[i])])
      if (one.distance < best.distance) best = one;
  }
  return best;
}
