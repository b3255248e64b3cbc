// Rotations as roll, pitch and yaw, and values as Python code.

import {plain} from "./blanks.js";
import {product} from "./rotations.js";

/** @import {PageUnit, Unit} from "./page.js" */

/**
 * @param {number} x  degrees
 */
export const radians = x => (x * Math.PI) / 180;

/**
 * @param {number} x  radians
 */
export const degrees = x => (x * 180) / Math.PI;

/**
 * A rotation about a unit vector.
 * @param {number[]} axis
 * @param {number} angle
 * @returns {number[]}  w, x, y, z
 */
export const aboutAxis = ([x, y, z], angle) => {
  const s = Math.sin(angle / 2);
  return [Math.cos(angle / 2), x * s, y * s, z * s];
};

/**
 * A quaternion scaled to length 1.
 * @param {number[]} q
 */
export const normal = q => {
  const length = Math.sqrt(q.reduce((sum, x) => sum + x * x, 0));
  return q.map(x => x / length);
};

/**
 * The rotation with these angles, as Quaternion.from_roll_pitch_yaw returns it.
 * @param {number[]} turns  roll, pitch, yaw
 */
export const rotationOf = ([roll, pitch, yaw]) =>
  product(
    product(aboutAxis([0, 0, 1], yaw), aboutAxis([0, 1, 0], pitch)),
    aboutAxis([1, 0, 0], roll),
  );

/**
 * The angles of a transform, as Quaternion.as_roll_pitch_yaw returns them: at a pitch of a quarter
 * turn, roll is set to zero.
 * @param {number[]} m  12 numbers
 */
export function rollPitchYaw(m) {
  const flat = Math.sqrt(m[0] * m[0] + m[4] * m[4]),
    pitch = Math.atan2(-m[8], flat);
  if (flat < 1e-9) return [0, pitch, Math.atan2(-m[1], m[5])];
  return [Math.atan2(m[9], m[10]), pitch, Math.atan2(m[4], m[0])];
}

/**
 * Joint values as Python code: "90.0 * deg, ...".
 * @param {PageUnit[]} units
 * @param {number[]} q
 */
export const inUnits = (units, q) =>
  q.map((x, j) => `${plain(x / units[j].size, 3)} * ${units[j].code}`).join(", ");

/**
 * A place as Python code, to a thousandth of a millimetre.
 * @param {number[]} place
 * @param {Pick<Unit, "size">} unit
 */
export const lengths = (place, unit) => place.map(x => plain(x / unit.size, unit.size < 1 ? 3 : 6));

/**
 * The values of a target that fill the blanks in a line of code.
 * @param {{place: number[], turns?: number[], angle?: number}} state
 * @param {Unit} unit
 * @returns {Object<string, string>}
 */
export const inCode = (state, unit) => ({
  ...Object.fromEntries(lengths(state.place, unit).map((text, k) => ["xyz"[k], text])),
  ...(state.turns
    ? {
        roll: plain(degrees(state.turns[0]), 3),
        pitch: plain(degrees(state.turns[1]), 3),
        yaw: plain(degrees(state.turns[2]), 3),
      }
    : {}),
  ...(state.angle === undefined ? {} : {angle: plain(degrees(state.angle), 3)}),
});
