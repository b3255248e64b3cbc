// Rotations as quaternions [w, x, y, z], and poses. The reference is in quaternion.py and
// transform.py.

import {fk, origin} from "./kinematics.js";

/** @import {ArmData, PagePose} from "./page.js" */

/**
 * The Hamilton product: first b, then a.
 * @param {number[]} a
 * @param {number[]} b
 * @returns {number[]}
 */
export const product = ([aw, ax, ay, az], [bw, bx, by, bz]) => [
  aw * bw - ax * bx - ay * by - az * bz,
  aw * bx + ax * bw + ay * bz - az * by,
  aw * by - ax * bz + ay * bw + az * bx,
  aw * bz + ax * by - ay * bx + az * bw,
];

/**
 * The transform with this rotation and this place.
 * @param {number[]} rotation  w, x, y, z
 * @param {number[]} [place]
 * @returns {number[]}  12 numbers
 */
export function matrix([w, x, y, z], [px, py, pz] = [0, 0, 0]) {
  const x2 = 2 * x,
    y2 = 2 * y,
    z2 = 2 * z,
    wx = w * x2,
    wy = w * y2,
    wz = w * z2;
  const xx = x * x2,
    xy = x * y2,
    xz = x * z2,
    yy = y * y2,
    yz = y * z2,
    zz = z * z2;
  return [
    1 - (yy + zz),
    xy - wz,
    xz + wy,
    px,
    xy + wz,
    1 - (xx + zz),
    yz - wx,
    py,
    xz - wy,
    yz + wx,
    1 - (xx + yy),
    pz,
  ];
}

/**
 * The rotation of a transform, computed from its largest component (Shepperd 1978).
 * @param {number[]} m  12 numbers
 * @returns {number[]}  w, x, y, z; the largest one is positive
 */
export function quaternion([xx, xy, xz, , yx, yy, yz, , zx, zy, zz]) {
  const wx = zy - yz,
    wy = xz - zx,
    wz = yx - xy,
    sxy = yx + xy,
    sxz = xz + zx,
    syz = zy + yz;
  const rows = [
    [1 + xx + yy + zz, wx, wy, wz],
    [wx, 1 + xx - yy - zz, sxy, sxz],
    [wy, sxy, 1 - xx + yy - zz, syz],
    [wz, sxz, syz, 1 - xx - yy + zz],
  ];
  let largest = 0;
  for (let k = 1; k < 4; k++) if (rows[k][k] > rows[largest][largest]) largest = k;
  const row = rows[largest];
  const length = Math.sqrt(row.reduce((sum, part) => sum + part * part, 0));
  return row.map(part => part / length);
}

/**
 * Interpolates from a (s = 0) to b (s = 1) along the shorter arc, at constant angular velocity.
 * @param {number[]} a
 * @param {number[]} b
 * @param {number} s
 * @returns {number[]}
 */
export function slerp(a, b, s) {
  let same = 0,
    less = 0,
    more = 0;
  for (let i = 0; i < 4; i++) same += a[i] * b[i];
  // so that rounding errors do not determine the direction of a half turn
  const sign = same < -1e-14 ? -1 : 1;
  for (let i = 0; i < 4; i++) {
    const apart = a[i] - sign * b[i],
      beside = a[i] + sign * b[i];
    less += apart * apart;
    more += beside * beside;
  }
  const angle = 2 * Math.atan2(Math.sqrt(less), Math.sqrt(more)),
    whole = Math.sin(angle);
  const ofA = angle === 0 ? 1 - s : Math.sin((1 - s) * angle) / whole;
  const ofB = sign * (angle === 0 ? s : Math.sin(s * angle) / whole);
  return a.map((part, i) => ofA * part + ofB * b[i]);
}

/**
 * The pose of the tool in a posture, of the type of the arm's targets.
 * @param {ArmData} arm
 * @param {number[]} q
 * @returns {PagePose}
 */
export function pose(arm, q) {
  const m = fk(arm.chain, q),
    place = origin(m);
  if (arm.target === "Transform") return {rotation: quaternion(m), place};
  return arm.target === "ScaraPose" ? {place, angle: Math.atan2(m[4], m[0])} : {place};
}
