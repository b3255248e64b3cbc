// The Jacobian and results that follow from it: joint speeds, the distance from a singularity, and
// the ellipsoid of tool velocities. The reference is in arms/arm.py and arms/dexterity.py.

import {cross, frames, origin, plus, turned} from "./kinematics.js";

/** @import {ArmData, PageLink} from "./page.js" */

/**
 * The geometric Jacobian at the flange: three rows of velocity, three of angular velocity.
 * @param {PageLink[]} chain
 * @param {number[]} q
 * @returns {number[][]}  6 rows of n
 */
export function jacobian(chain, q) {
  /** @type {number[][]} */
  const joints = [],
    ends = frames(chain, q, joints),
    tip = origin(ends[ends.length - 1]);
  const columns = chain.map((link, i) => {
    const axis = turned(joints[i], link.axis);
    if (link.prismatic) return [...axis, 0, 0, 0];
    return [...cross(axis, plus(tip, origin(joints[i]), -1)), ...axis];
  });
  return [0, 1, 2, 3, 4, 5].map(row => columns.map(column => column[row]));
}

/**
 * The joint speeds of an arm with six joints that give the flange a velocity. They are not finite
 * where the Jacobian has no inverse.
 * @param {PageLink[]} chain
 * @param {number[]} q
 * @param {number[]} velocity  m/s, then rad/s
 * @returns {number[]}  rad/s, m/s if prismatic
 */
export function jointSpeeds(chain, q, velocity) {
  const rows = jacobian(chain, q).map((row, i) => [...row, velocity[i]]);
  for (let k = 0; k < rows.length; k++) {
    // Gauss-Jordan elimination with partial pivoting
    const next = rows.reduce(
      (best, row, i) => (i > k && Math.abs(row[k]) > Math.abs(rows[best][k]) ? i : best),
      k,
    );
    [rows[k], rows[next]] = [rows[next], rows[k]];
    const pivot = rows[k];
    for (const row of rows) {
      const share = row === pivot ? 0 : row[k] / pivot[k];
      for (let j = k; j < row.length; j++) row[j] -= share * pivot[j];
    }
  }
  return rows.map((row, k) => row[row.length - 1] / row[k]);
}

/**
 * @param {number[]} a
 * @param {number[]} b
 */
const inner = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);

/**
 * Rotates vectors in pairs until all are perpendicular (one-sided Jacobi, Hestenes 1958), and
 * returns them, their lengths, and the rows of the rotation. The lengths are the singular values.
 * They are accurate to the last digits even near zero, unlike the square roots of eigenvalues.
 * @param {number[][]} vectors
 */
function squared(vectors) {
  const turns = vectors.map((_, i) => vectors.map((_, j) => Number(i === j)));
  const a = vectors.map(vector => [...vector]);
  for (let sweep = 0, again = true; again && sweep < 30; sweep++) {
    again = false;
    for (let i = 0; i < a.length; i++)
      for (let j = i + 1; j < a.length; j++) {
        const p = inner(a[i], a[i]),
          q = inner(a[j], a[j]),
          r = inner(a[i], a[j]);
        if (Math.abs(r) <= 1e-15 * Math.sqrt(p * q)) continue;
        again = true;
        const zeta = (q - p) / (2 * r);
        const t = (zeta < 0 ? -1 : 1) / (Math.abs(zeta) + Math.sqrt(1 + zeta * zeta));
        const c = 1 / Math.sqrt(1 + t * t),
          s = c * t;
        for (const rows of [a, turns])
          for (let k = 0; k < rows[i].length; k++) {
            const [x, y] = [rows[i][k], rows[j][k]];
            [rows[i][k], rows[j][k]] = [c * x - s * y, s * x + c * y];
          }
      }
  }
  return {vectors: a, lengths: a.map(vector => Math.sqrt(inner(vector, vector))), turns};
}

/**
 * The smallest singular value of the Jacobian, with lengths divided by the arm's reach. It says how
 * slowly the tool moves in its worst direction, and is 0 at a singularity. It is NaN if q has NaN.
 * @param {ArmData} arm
 * @param {number[]} q
 * @returns {number}
 */
export function distance_from_singularity(arm, q) {
  if (q.some(Number.isNaN)) return NaN;
  const whole = jacobian(arm.chain, q),
    {reach, prismatic} = arm;
  const rows = arm.movable.map(r =>
    whole[r].map((x, j) => (r < 3 ? x / reach : x) * (prismatic[j] ? reach : 1)),
  );
  const columns = q.map((_, j) => rows.map(row => row[j]));
  return Math.min(...squared(rows.length < q.length ? rows : columns).lengths);
}

/**
 * The semi-axes of the ellipsoid of tool velocities for joint speeds of norm 1, in rad/s or, for
 * prismatic joints, in multiples of the arm's reach per second. With `held`, only joint speeds that
 * do not rotate the tool are included, as in velocity_ellipsoid of dexterity.py.
 * @param {ArmData} arm
 * @param {number[]} q
 * @param {boolean} held
 * @returns {number[][]}  three vectors in m/s, the longest first
 */
export function ellipsoid({chain, reach, prismatic}, q, held) {
  const rows = jacobian(chain, q).map(row => row.map((x, j) => (prismatic[j] ? reach * x : x)));
  const moves = rows.slice(0, 3);
  const {lengths, turns} = squared(
    held && chain.length > 3 ? without(moves, rows.slice(3)) : moves,
  );
  return [0, 1, 2]
    .sort((i, j) => lengths[j] - lengths[i])
    .map(i => turns[i].map(part => part * lengths[i]));
}

/**
 * Removes from vectors their components in the space that others span.
 * @param {number[][]} vectors
 * @param {number[][]} others
 */
function without(vectors, others) {
  const span = squared(others),
    least = 1e-9 * Math.max(...span.lengths);
  const units = span.vectors
    .map((way, k) => way.map(x => x / span.lengths[k]))
    .filter((_, k) => span.lengths[k] > least);
  return vectors.map(vector =>
    units.reduce((rest, unit) => {
      const part = inner(rest, unit);
      return rest.map((x, k) => x - part * unit[k]);
    }, vector),
  );
}
