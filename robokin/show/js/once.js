// A dashed line that runs back over itself: its dashes would fill each other's gaps.

/** @import {Pixel} from "./canvas.js" */

/**
 * The points of a line without the parts that run back over an earlier part, up to one pixel.
 * @param {Pixel[]} points
 * @returns {(?Pixel)[]}
 */
export function once(points) {
  /** @type {[...Pixel, ...Pixel][]} */
  const kept = []; // the begin and the way of each part
  return points.flatMap(([x, y], i) => {
    const [u, v] = points[i - 1] ?? [x, y],
      [dx, dy] = [x - u, y - v];
    const again = kept.some(([px, py, a, b]) => {
      const [c, d] = [u + dx / 2 - px, v + dy / 2 - py],
        size = a * a + b * b,
        share = a * c + b * d;
      return a * dx + b * dy < 0 && share >= 0 && share <= size && (a * d - b * c) ** 2 < size;
    });
    kept.push([u, v, dx, dy]);
    return again ? [null, [x, y]] : [[x, y]];
  });
}
