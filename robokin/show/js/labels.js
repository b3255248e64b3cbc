// Labels next to their points.

import {font, hit, write} from "./canvas.js";

/** @import {Box, Context, Pixel} from "./canvas.js" */

/** @typedef {{text: string, at: Pixel, color: string, weight?: string}} Label */

/**
 * Writes each label next to its point, where it covers as little as possible of other labels, lines
 * and the edge.
 * @param {Context} g
 * @param {Label[]} labels
 * @param {Pixel[]} taken
 * @param {Box} room
 * @param {Box[]} written  other texts, which no label covers
 */
export function placeLabels(g, labels, taken, [left, top, width, height], written) {
  const done = [...written];
  for (const label of labels) {
    g.font = font(12, label.weight);
    const w = g.measureText(label.text).width + 4,
      h = 16,
      [px, py] = label.at;
    let best = [NaN, NaN, NaN]; // the lowest cost, and its left and top
    for (const gap of [5, 14, 26, 40])
      for (let k = 0; k < 12; k++) {
        const c = Math.cos((k * Math.PI) / 6),
          s = -Math.sin((k * Math.PI) / 6);
        const x = px + c * (gap + w / 2) - w / 2,
          y = py + s * (gap + h / 2) - h / 2;
        let cost = gap / 6 + (1 - c) / 2 + (1 + s) / 2;
        for (const [qx, qy] of taken)
          if (qx > x - 3 && qx < x + w + 3 && qy > y - 2 && qy < y + h + 2) cost += 3;
        if (hit([x, y, w, h], done)) cost += 100;
        cost +=
          3 *
          (Math.max(0, left - x) +
            Math.max(0, x + w - left - width) +
            Math.max(0, top - y) +
            Math.max(0, y + h - top - height));
        if (!(cost >= best[0])) best = [cost, x, y];
      }
    const [, x, y] = best;
    done.push([x, y, w, h]);
    write(g, label.text, x + 2, y + 12, label.color, 12, "left", label.weight);
  }
}
