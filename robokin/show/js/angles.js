// Whole turns, and rounding as in NumPy.

export const TURN = 2 * Math.PI;

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
