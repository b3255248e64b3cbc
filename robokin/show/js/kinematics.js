// Kinematic chains: rigid transforms as 12 numbers (the rows of [R | p]), and the frames of a
// posture. The reference is in transform.py and arms/arm.py.
//
// A pose is {rotation, place} (target "Transform"), {place, angle} ("ScaraPose") or {place}
// ("point"). An arm is the result of `arm_data` in twin.py; the scripts contain no arm data.

/** @import {ArmData, Inverse, PageLink, PagePose, With} from "./page.js" */

/**
 * An arm with this geometry.
 * @template {Inverse} G
 * @typedef {ArmData & {geometry: G}} ArmOf
 */
/**
 * An arm with `ik`.
 * @typedef {With<ArmData, "branches" | "carried" | "sentences">} ClosedFormArm
 */
/** @typedef {With<PagePose, "rotation">} TransformPose */
/** @typedef {With<PagePose, "angle">} ScaraPose */

export const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/**
 * The composition of two transforms: first b, then a.
 * @param {number[]} a  12 numbers
 * @param {number[]} b  12 numbers
 * @returns {number[]}  12 numbers
 */
export function compose(a, b) {
  const c = new Array(12);
  for (let r = 0; r < 12; r += 4)
    for (let k = 0; k < 4; k++)
      c[r + k] = a[r] * b[k] + a[r + 1] * b[4 + k] + a[r + 2] * b[8 + k] + (k === 3 ? a[r + 3] : 0);
  return c;
}

/**
 * The motion of a joint at q: a rotation about its axis, or a translation along it.
 * @param {Pick<PageLink, "axis" | "prismatic">} link
 * @param {number} q  radians, metres if prismatic
 * @returns {number[]}  12 numbers
 */
export function motion({axis: [x, y, z], prismatic}, q) {
  if (prismatic) return [1, 0, 0, x * q, 0, 1, 0, y * q, 0, 0, 1, z * q];
  const c = Math.cos(q),
    s = Math.sin(q),
    v = 1 - c;
  return [
    c + x * x * v,
    x * y * v - z * s,
    x * z * v + y * s,
    0,
    y * x * v + z * s,
    c + y * y * v,
    y * z * v - x * s,
    0,
    z * x * v - y * s,
    z * y * v + x * s,
    c + z * z * v,
    0,
  ];
}

/**
 * The frames of a posture: the base and the frame after each link, the last of which is the flange.
 * If they are given, `joints` and `moved` receive the frame of each joint before and after its own
 * motion.
 * @param {PageLink[]} chain
 * @param {number[]} q
 * @param {number[][]} [joints]
 * @param {number[][]} [moved]
 * @returns {number[][]}  n + 1 times 12 numbers
 */
export function frames(chain, q, joints = [], moved = []) {
  const all = [IDENTITY];
  chain.forEach((link, i) => {
    joints[i] = compose(all[i], link.before);
    moved[i] = compose(joints[i], motion(link, q[i]));
    all.push(compose(moved[i], link.after));
  });
  return all;
}

/**
 * The polyline of the links: base, joint 1, end of link 1, joint 2, ..., flange, as in arm_points
 * of camera.py.
 * @param {PageLink[]} chain
 * @param {number[]} q
 * @returns {number[][]}
 */
export function polyline(chain, q) {
  /** @type {number[][]} */
  const joints = [],
    ends = frames(chain, q, joints);
  return ends.flatMap((end, i) => (i < joints.length ? [end, joints[i]] : [end])).map(origin);
}

/** @param {number[]} m  12 numbers @returns {number[]} */
export const origin = m => [m[3], m[7], m[11]];
/** v rotated by m. @param {number[]} m @param {number[]} v @returns {number[]} */
export const turned = (m, [x, y, z]) => [
  m[0] * x + m[1] * y + m[2] * z,
  m[4] * x + m[5] * y + m[6] * z,
  m[8] * x + m[9] * y + m[10] * z,
];
/** a + k b. @param {number[]} a @param {number[]} b @param {number} [k] @returns {number[]} */
export const plus = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
/** @param {number[]} a @param {number[]} b @returns {number} */
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
/** @param {number[]} a @param {number[]} b @returns {number[]} */
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
/** @param {number[]} a @param {number[]} b @returns {number} */
export const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/**
 * The flange in base coordinates.
 * @param {PageLink[]} chain
 * @param {number[]} q
 * @returns {number[]}  12 numbers
 */
export const fk = (chain, q) => /** @type {number[]} */ (frames(chain, q).at(-1));
