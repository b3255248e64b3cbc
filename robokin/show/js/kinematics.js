// Chains: rigid transforms as 12 numbers (the rows of [R | p]), rotations as quaternions [w, x, y,
// z], the frames of a posture, and the Jacobian. The reference is in quaternion.py, transform.py,
// arms/arm.py and arms/dexterity.py.
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

export const TURN = 2 * Math.PI;
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
 * The frames of a posture: the base and the frame after each link, of which the last is the flange.
 * If given, `joints` and `moved` receive the frame of each joint before and after its own motion.
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
 * The nearest integer, with halves to even as in NumPy; Math.round rounds halves up.
 * @param {number} x
 * @returns {number}
 */
export function rint(x) {
  const down = Math.floor(x),
    rest = x - down;
  return rest < 0.5 || (rest === 0.5 && down % 2 === 0) ? down : down + 1;
}

/**
 * The angle nearest to `near` that differs from `angle` by whole turns.
 * @param {number} angle
 * @param {number} [near]
 * @returns {number}
 */
export const wrapped = (angle, near = 0) => angle - TURN * rint((angle - near) / TURN);

/**
 * Hamilton's product: first b, then a.
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
  // the margin keeps rounding errors from choosing the direction of a half turn
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
 * The flange in base coordinates.
 * @param {PageLink[]} chain
 * @param {number[]} q
 * @returns {number[]}  12 numbers
 */
export const fk = (chain, q) => /** @type {number[]} */ (frames(chain, q).at(-1));

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
 * @param {number[]} a
 * @param {number[]} b
 */
const inner = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);

/**
 * Rotates vectors in pairs until all are perpendicular (one-sided Jacobi, Hestenes 1958), and
 * returns them, their lengths, and the rows of the rotation. The lengths are the singular values,
 * accurate to the last digits even near zero, where the root of an eigenvalue is not.
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
          [rows[i], rows[j]] = [
            rows[i].map((x, k) => c * x - s * rows[j][k]),
            rows[j].map((y, k) => s * rows[i][k] + c * y),
          ];
      }
  }
  return {vectors: a, lengths: a.map(vector => Math.sqrt(inner(vector, vector))), turns};
}

/**
 * How slowly the tool moves in its worst direction: the smallest singular value of the Jacobian,
 * with lengths divided by the arm's reach; 0 is a singularity; NaN in, NaN out.
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
 * The semi-axes of the ellipsoid of tool velocities for joint speeds of norm 1: rad/s, and reaches
 * per second for prismatic joints. With `held`, of the joint speeds that do not rotate the tool, as
 * in velocity_ellipsoid of dexterity.py.
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
