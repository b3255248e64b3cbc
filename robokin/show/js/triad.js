// Draws the axes of a frame, and the directions of the base's axes in a corner.

import {colors, hit, stroke, write} from "./canvas.js";
import {dot, origin, plus} from "./kinematics.js";

/** @import {Camera} from "./camera.js" */
/** @import {Box, Context, Pixel} from "./canvas.js" */

/** The names of the axes of a frame, and of their colours. */
export const AXES = /** @type {const} */ (["x", "y", "z"]);

/**
 * Draws the axes of a frame.
 * @param {Context} g
 * @param {Camera} cam
 * @param {number[]} pose  12 numbers
 * @param {number} length
 * @param {number} width
 * @param {number} alpha
 * @param {Box[]} [letters]  if given, letters are written where they do not cover these boxes, and
 *   their own boxes are added
 * @returns {Pixel[]}  their tips on the screen
 */
export function triad(g, cam, pose, length, width, alpha, letters) {
  const p = origin(pose),
    from = cam.to(p),
    before = g.globalAlpha;
  const axes = AXES.map((name, k) => ({name, way: [pose[k], pose[4 + k], pose[8 + k]]}));
  axes.sort((m, n) => dot(m.way, cam.toward) - dot(n.way, cam.toward));
  g.globalAlpha = before * alpha;
  const tips = axes.map(({name, way}) => {
    const tip = cam.to(plus(p, way, length));
    stroke(g, [from, tip], colors.paper, width + 2);
    stroke(g, [from, tip], colors[name], width);
    return {name, tip};
  });
  if (letters)
    for (const {name, tip} of [...tips].reverse()) {
      const d = [tip[0] - from[0], tip[1] - from[1]],
        l = Math.hypot(...d);
      if (l <= 0.35 * length * cam.scale) continue;
      const [x, y] = [tip[0] + (8 * d[0]) / l, tip[1] + (8 * d[1]) / l];
      /** @type {Box} */
      const box = [x - 5, y - 6, 10, 13];
      if (hit(box, letters)) continue;
      write(g, name, x, y + 4, colors[name], 12, "center", "600");
      letters.push(box);
    }
  g.globalAlpha = before;
  return tips.map(({tip}) => tip);
}

/**
 * Draws the directions of the base's x, y and z in a corner; returns the boxes of the letters.
 * @param {Context} g
 * @param {Camera} cam
 * @param {Pixel} corner
 */
export function compass(g, cam, [x, y]) {
  /** @type {Box[]} */
  const letters = [];
  [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ].forEach((axis, k) => {
    const [dx, dy] = cam.along(axis),
      l = Math.hypot(dx, dy) / cam.scale;
    if (l < 0.1) return;
    /** @type {Pixel} */
    const tip = [x + (18 * dx) / cam.scale, y + (18 * dy) / cam.scale];
    stroke(g, [[x, y], tip], colors[AXES[k]], 1.4);
    const [px, py] = [tip[0] + (7 * dx) / cam.scale / l, tip[1] + (7 * dy) / cam.scale / l];
    write(g, AXES[k], px, py + 3.5, colors[AXES[k]], 10, "center");
    letters.push([px - 4, py - 5, 8, 11]);
  });
  return letters;
}
