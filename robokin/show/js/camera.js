// The camera of a page, which converts metres in base coordinates to CSS pixels on a canvas. (For
// figures see camera.py and scene.py.)

import {cross, dot, plus} from "./kinematics.js";

/** @import {Box, Pixel, Point} from "./canvas.js" */

/**
 * @typedef {object} Camera  a parallel projection
 * @property {number} scale  pixels per metre
 * @property {Point} toward  the direction to the camera
 * @property {(p: Point) => Pixel} to  the place of a point on the canvas
 * @property {(v: Point) => Pixel} along  the direction of a vector on the canvas
 * @property {(dx: number, dy: number) => Point} across  the displacement in space, perpendicular to
 *   the line of sight, for a displacement in pixels
 */

/**
 * The camera that fits points into a rectangle [left, top, width, height].
 * @param {number[]} view  azimuth and elevation
 * @param {Point[]} corners
 * @param {Box} box
 * @returns {Camera}
 */
export function camera([azimuth, elevation], corners, box) {
  const ca = Math.cos(azimuth),
    sa = Math.sin(azimuth),
    ce = Math.cos(elevation),
    se = Math.sin(elevation);
  return facing([-sa, ca, 0], [-se * ca, -se * sa, ce], corners, box);
}

/**
 * The same camera, for the perpendicular unit vectors that point right and up in the picture.
 * @param {Point} right
 * @param {Point} up
 * @param {Point[]} corners
 * @param {Box} box
 * @returns {Camera}
 */
export function facing(right, up, corners, [left, top, width, height]) {
  const xs = corners.map(p => dot(p, right)),
    ys = corners.map(p => dot(p, up));
  const x0 = Math.min(...xs),
    x1 = Math.max(...xs),
    y0 = Math.min(...ys),
    y1 = Math.max(...ys);
  const scale = Math.max(1e-9, Math.min(width / (x1 - x0 || 1), height / (y1 - y0 || 1)));
  const cx = left + (width - scale * (x0 + x1)) / 2,
    cy = top + (height + scale * (y0 + y1)) / 2;
  return {
    scale,
    toward: cross(right, up),
    to: p => [cx + scale * dot(p, right), cy - scale * dot(p, up)],
    along: v => [scale * dot(v, right), -scale * dot(v, up)],
    across: (dx, dy) => right.map((r, k) => (dx * r - dy * up[k]) / scale),
  };
}

/**
 * The same camera for the coordinates of an arm at `base`.
 * @param {Camera} cam
 * @param {Point} base
 * @returns {Camera}
 */
export const movedTo = (cam, base) => ({...cam, to: p => cam.to(plus(p, base))});
