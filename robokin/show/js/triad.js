// Draws the axes of a frame, and the directions of the base's axes in a free corner.

import {colors, haloed, stroke, write} from "./canvas.js";
import {dot, origin, plus} from "./kinematics.js";
import {freest} from "./labels.js";

/** @import {Camera} from "./camera.js" */
/** @import {Box, Context, Pixel} from "./canvas.js" */
/** @import {Label} from "./labels.js" */

/** The names of the axes of a frame, and of their colours. */
export const AXES = /** @type {const} */ (["x", "y", "z"]);

/**
 * Draws the axes of a frame; returns the letters at their tips, without those of axes that point
 * at the camera.
 * @param {Context} g
 * @param {Camera} cam
 * @param {number[]} pose  12 numbers
 * @param {number} length
 * @param {number} width
 * @returns {Label[]}
 */
export function triad(g, cam, pose, length, width) {
  const p = origin(pose),
    from = cam.to(p);
  const axes = AXES.map((name, k) => ({name, way: [pose[k], pose[4 + k], pose[8 + k]]}));
  axes.sort((m, n) => dot(m.way, cam.toward) - dot(n.way, cam.toward));
  const letters = axes.flatMap(({name, way}) => {
    const tip = cam.to(plus(p, way, length)),
      [dx, dy] = [tip[0] - from[0], tip[1] - from[1]],
      long = Math.hypot(dx, dy),
      away = /** @type {Pixel} */ ([dx, dy].map(d => (3 * d) / long));
    haloed(g, [from, tip], colors[name], width);
    if (long <= 0.35 * length * cam.scale) return [];
    return [{text: name, at: tip, color: colors[name], weight: "600", away, tip: from}];
  });
  return letters.reverse();
}

/**
 * Draws the directions of the base's x, y and z in the corner of a cell where they hide least of
 * what is already drawn.
 * @param {Context} g
 * @param {Camera} cam
 * @param {Box} cell
 */
export function compass(g, cam, [left, top, wide, tall]) {
  const [right, high] = [left + wide - 34, top + 62],
    [x, y] = freest([
      [right, top + tall - 34],
      [right, high],
      [left + 34, high],
    ]);
  AXES.forEach(name => {
    const [dx, dy] = cam.along(AXES.map(axis => Number(axis === name))).map(d => d / cam.scale),
      l = Math.hypot(dx, dy);
    if (l < 0.1) return;
    /** @type {(r: number) => Pixel} */
    const at = r => [x + r * dx, y + r * dy];
    stroke(g, [[x, y], at(18)], colors[name], 1.4);
    const [px, py] = at(18 + 7 / l);
    write(g, name, px, py + 3.5, colors[name], 10, "center");
  });
}
